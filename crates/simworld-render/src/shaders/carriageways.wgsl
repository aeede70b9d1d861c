// What roads are of, and what they are painted with.
fn asphalt(p: vec2f, albedo: vec3f) -> vec3f {
    let near = noise2(p * 14.0);
    let patches = noise2(p * 0.23) * 0.6 + noise2(p * 1.1 + 7.0) * 0.4;
    return albedo * (0.78 + 0.22 * near + 0.28 * patches);
}

// Asphalt, darker where wheels have polished it.
fn carriageway(p: vec2f, lane: f32, albedo: vec3f) -> vec3f {
    let track = abs(fract(p.y / lane * 2.0) - 0.5);
    return asphalt(p, albedo) * (0.92 + 0.12 * smoothstep(0.1, 0.4, track));
}

fn white_paint(p: vec2f) -> vec3f {
    return vec3f(0.62) * (0.75 + 0.25 * noise2(p * 6.0));
}

// Half the width of a line, m.
const HALF_LINE: f32 = 0.06;

// Thin lines far away cover a part of a pixel.
fn thin(step: f32) -> f32 {
    return min(1.0, 2.5 * HALF_LINE / max(step, 1e-6));
}

fn broken(x: f32, step: f32) -> f32 {
    return bands(x / 9.0, 0.0, 0.36, step / 9.0);
}
