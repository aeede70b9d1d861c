// What is cut out, where nothing else is wanted than its measures, its normals or its shadow.
struct CutVaryings {
    @builtin(position) position: vec4f,
    @location(0) relative: vec3f,
    @location(1) normal: vec3f,
    @location(2) place: vec2f,
    @location(3) alpha: f32,
    @location(4) @interpolate(flat) coat: u32,
    @location(5) @interpolate(flat) id: u32,
}

fn cut_varyings(corner: Corner) -> CutVaryings {
    let in = vertex_of(corner);
    let laid = laid_at(in.offset);
    var out: CutVaryings;
    out.relative = relative_point(in);
    out.position = clip_of(out.relative, layer_of(in));
    out.normal = rotate(in.rotation, body_normal(in));
    out.place = laid.place;
    out.alpha = laid.alpha;
    out.coat = coat_place(in.second.x, laid.part);
    out.id = in.who;
    return out;
}

@vertex
fn vertex_cut(corner: Corner) -> CutVaryings {
    return cut_varyings(corner);
}

@vertex
fn vertex_cut_shadow(corner: Corner) -> CutVaryings {
    var out = cut_varyings(corner);
    out.position = globals.shadow_from_relative * vec4f(out.relative, 1.0);
    return out;
}

fn cut(in: CutVaryings) {
    if (falls_away(in.coat, in.alpha, in.place, dpdx(in.place), dpdy(in.place))) {
        discard;
    }
}

struct CutMeasures {
    @location(0) depth: f32,
    @location(1) id: u32,
}

@fragment
fn fragment_cut_measures(in: CutVaryings) -> CutMeasures {
    cut(in);
    return CutMeasures(dot(in.relative, globals.forward.xyz), in.id);
}

@fragment
fn fragment_cut_normals(in: CutVaryings) -> @location(0) u32 {
    cut(in);
    return packed_normal(normalize(in.normal));
}

@fragment
fn fragment_cut_shadow(in: CutVaryings) {
    cut(in);
}
