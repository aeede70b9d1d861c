// Models of assets by triangles: as forward.wgsl, with a place on pictures.

// Whether what is drawn is cut out, or blended.
override CUT: bool = false;
// Which layer of what is blended it is, a `Layer` of gpu/pipelines.rs: 1 for what counts, 2 for what is thinner.
override LAYER: u32 = 0u;

struct ModelVaryings {
    @builtin(position) position: vec4f,
    // Relative to the eye, world axes, m.
    @location(0) relative: vec3f,
    @location(1) normal: vec3f,
    // In the body frame, m.
    @location(2) body: vec3f,
    @location(3) place: vec2f,
    @location(4) @interpolate(flat) body_normal: vec3f,
    @location(5) @interpolate(flat) tint: vec3f,
    @location(6) @interpolate(flat) size: vec4f,
    @location(7) @interpolate(flat) extra: vec2f,
    @location(8) @interpolate(flat) coat: u32,
    @location(9) @interpolate(flat) id: u32,
    @location(10) alpha: f32,
    // World axes; see `tangent_of`.
    @location(11) tangent: vec4f,
}

@vertex
fn vertex_model(corner: Corner, @location(11) tangent: u32) -> ModelVaryings {
    let in = vertex_of(corner);
    let relative = relative_point(in);
    let normal = body_normal(in);
    var out: ModelVaryings;
    out.position = clip_of(relative, layer_of(in));
    out.relative = relative;
    out.normal = rotate(in.rotation, normal);
    out.body = body_point(in);
    let laid = laid_at(in.offset);
    out.place = laid.place;
    out.alpha = laid.alpha;
    out.body_normal = normal;
    out.tint = model_tint(in.material, in.color.rgb);
    out.size = in.scale;
    out.extra = vec2f(in.color.w, in.second.w);
    out.coat = coat_place(in.second.x, laid.part);
    out.id = in.who;
    let told = tangent_of(tangent, in.scale.xyz);
    out.tangent = vec4f(rotate(in.rotation, told.xyz), told.w);
    return out;
}

fn model_color(in: ModelVaryings) -> vec4f {
    let across = dpdx(in.place);
    let down = dpdy(in.place);
    let footprint = fwidth(in.body);
    let ways = mat2x3f(dpdx(in.relative), dpdy(in.relative));
    if (CUT && falls_away(in.coat, in.alpha, in.place, across, down) != (LAYER == 2u)) {
        discard;
    }
    let spot = model_spot(in.coat, in.tint, in.place, across, down);
    let there = in.alpha * spot.alpha;
    if (LAYER == 2u && there < FAINTEST) {
        discard;
    }
    let normal = normalize(in.normal);
    let bumped = tilted(normal, in.tangent, spot.bump, ways, mat2x2f(across, down));
    let hit = Hit(in.relative, normal, in.body, in.body_normal, spot.finish, in.size, in.extra, 1.0, PATTERN, footprint, spot.glow, bumped);
    return vec4f(shade(hit), select(1.0, there, LAYER != 0u));
}

@fragment
fn fragment_model_all(in: ModelVaryings) -> All {
    return All(model_color(in), dot(in.relative, globals.forward.xyz), in.id);
}

@fragment
fn fragment_model_color(in: ModelVaryings) -> @location(0) vec4f {
    return model_color(in);
}
