// Normals of surfaces as they are modelled, before any painting.
struct Facing {
    @builtin(position) position: vec4f,
    @location(0) normal: vec3f,
}

@vertex
fn vertex_normals(corner: Corner) -> Facing {
    let in = vertex_of(corner);
    return Facing(globals.clip_from_relative * vec4f(relative_point(in), 1.0), rotate(in.rotation, body_normal(in)));
}

@fragment
fn fragment_normals(in: Facing) -> @location(0) u32 {
    return packed_normal(normalize(in.normal));
}
