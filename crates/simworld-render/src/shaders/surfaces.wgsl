// What surfaces are painted as, from body-frame coordinates, in metres: no textures.
struct Surface {
    albedo: vec3f,
    // How much of a clear coat or pane it has, 0 to 1.
    gloss: f32,
    emissive: vec3f,
    normal: vec3f,
    // Under the gloss; see `Finish`.
    roughness: f32,
    metallic: f32,
}

// What a mark is: 1 to 15, and from 16 on arrows by the ways they show.
fn mark_of(state: f32) -> u32 {
    return select(0u, u32(state) & 31u, state >= 32.0);
}

// Marks lie in the plane of their road: over it, lines that end before others over surfaces, and below those.
fn mark_layer(state: f32) -> f32 {
    switch mark_of(state) {
        case 0u, 4u, 5u, 9u, 10u, 12u: { return 0.0; }
        case 6u, 7u, 8u, 11u: { return 2.0; }
        default: { return select(1.0, 0.0, mark_of(state) >= 16u); }
    }
}

// A point of a surface in its own frame; of marks in that of their road, so that they are weathered as what they lie on.
fn on_surface(hit: Hit) -> vec2f {
    if (hit.pattern != 7u) {
        return hit.body.xy;
    }
    let x = f32(u32(hit.extra.x) >> 5u) - 250000.0;
    let y = f32(u32(hit.extra.y) & 16383u) - 8192.0;
    return hit.body.xy + vec2f(x * 0.02, y * 0.01);
}
