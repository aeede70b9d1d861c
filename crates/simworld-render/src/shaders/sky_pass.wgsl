// Fills what no entity covers: RGB alone, at infinity.
@vertex
fn vertex_sky(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    let corner = vec2f(f32((index << 1u) & 2u), f32(index & 2u));
    return vec4f(corner * 2.0 - 1.0, 0.0, 1.0);
}

fn direction_of(position: vec4f) -> vec3f {
    let k = globals.intrinsics;
    let across = (position.x - k.z) / k.x;
    let down = (position.y - k.w) / k.y;
    return normalize(globals.forward.xyz + across * globals.right.xyz + down * globals.down.xyz);
}

struct SkyAll {
    @location(0) color: vec4f,
    @location(1) depth: f32,
    @location(2) id: u32,
}

@fragment
fn fragment_sky_all(@builtin(position) position: vec4f) -> SkyAll {
    return SkyAll(vec4f(tone_map(sky_with_clouds(direction_of(position))), 1.0), 0.0, 0u);
}

@fragment
fn fragment_sky(@builtin(position) position: vec4f) -> @location(0) vec4f {
    return vec4f(tone_map(sky_with_clouds(direction_of(position))), 1.0);
}
