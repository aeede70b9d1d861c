// A unit vector in 32 bits: octahedral coordinates, two numbers of 16 bits.
fn octahedral(normal: vec3f) -> vec2f {
    let plane = normal.xy / (abs(normal.x) + abs(normal.y) + abs(normal.z));
    let folded = (1.0 - abs(plane.yx)) * select(vec2f(-1.0), vec2f(1.0), plane >= vec2f(0.0));
    return select(plane, folded, normal.z < 0.0);
}

// Straight up would be 0, which stands for nothing; it has a code of its own, that no other normal has.
fn packed_normal(normal: vec3f) -> u32 {
    let packed = pack2x16snorm(octahedral(normal));
    return select(packed, 0x80008000u, packed == 0u);
}
