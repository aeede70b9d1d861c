// Normals of surfaces as they are modelled, before any painting: octahedral, two numbers of 16 bits.
struct Facing {
    @builtin(position) position: vec4f,
    @location(0) normal: vec3f,
}

@vertex
fn vertex_normals(corner: Corner) -> Facing {
    let in = vertex_of(corner);
    return Facing(globals.clip_from_relative * vec4f(relative_point(in), 1.0), rotate(in.rotation, body_normal(in)));
}

fn octahedral(normal: vec3f) -> vec2f {
    let plane = normal.xy / (abs(normal.x) + abs(normal.y) + abs(normal.z));
    let folded = (1.0 - abs(plane.yx)) * select(vec2f(-1.0), vec2f(1.0), plane >= vec2f(0.0));
    return select(plane, folded, normal.z < 0.0);
}

@fragment
fn fragment_normals(in: Facing) -> @location(0) u32 {
    // Straight up would be 0, which stands for nothing; it has a code of its own, that no other normal has.
    let packed = pack2x16snorm(octahedral(normalize(in.normal)));
    return select(packed, 0x80008000u, packed == 0u);
}
