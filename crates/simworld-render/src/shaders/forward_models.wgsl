// Models of assets by triangles: as forward.wgsl, with a place on a picture.
@group(2) @binding(0) var store: texture_2d_array<f32>;

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
}

@vertex
fn vertex_model(corner: Corner) -> ModelVaryings {
    let in = vertex_of(corner);
    let relative = relative_point(in);
    let normal = body_normal(in);
    var out: ModelVaryings;
    out.position = clip_of(relative, layer_of(in));
    out.relative = relative;
    out.normal = rotate(in.rotation, normal);
    out.body = body_point(in);
    // The unit of models is zero: what are offsets elsewhere is the place on the picture, and the part.
    out.place = in.offset.xy;
    out.body_normal = normal;
    out.tint = model_tint(in.material, in.color.rgb);
    out.size = in.scale;
    out.extra = vec2f(in.color.w, in.second.w);
    out.coat = coat_place(in.second.x, in.offset.z);
    out.id = in.who;
    return out;
}

fn model_color(in: ModelVaryings) -> vec4f {
    let across = dpdx(in.place);
    let down = dpdy(in.place);
    let footprint = fwidth(in.body);
    let coat = coat_at(in.coat);
    let finish = model_finish(coat, in.tint, in.place, across, down);
    let hit = Hit(in.relative, normalize(in.normal), in.body, in.body_normal, finish, in.size, in.extra, 1.0, PATTERN, footprint, model_glow(coat));
    return vec4f(shade(hit), 1.0);
}

@fragment
fn fragment_model_all(in: ModelVaryings) -> All {
    return All(model_color(in), dot(in.relative, globals.forward.xyz), in.id);
}

@fragment
fn fragment_model_color(in: ModelVaryings) -> @location(0) vec4f {
    return model_color(in);
}
