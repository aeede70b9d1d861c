// Value noise from integer hashes: the same on every adapter.
fn hash3(p: vec3i) -> f32 {
    var h = u32(p.x) * 0x8da6b343u ^ u32(p.y) * 0xd8163841u ^ u32(p.z) * 0xcb1ab31fu;
    h = (h ^ (h >> 15u)) * 0x2c1b3c6du;
    h = (h ^ (h >> 12u)) * 0x297a2d39u;
    return f32((h ^ (h >> 15u)) >> 8u) / 16777216.0;
}

fn noise2(p: vec2f) -> f32 {
    let cell = vec2i(floor(p));
    let f = fract(p);
    let w = f * f * (3.0 - 2.0 * f);
    let low = mix(hash3(vec3i(cell, 0)), hash3(vec3i(cell + vec2i(1, 0), 0)), w.x);
    let high = mix(hash3(vec3i(cell + vec2i(0, 1), 0)), hash3(vec3i(cell + vec2i(1, 1), 0)), w.x);
    return mix(low, high, w.y);
}

fn noise3(p: vec3f) -> f32 {
    let cell = vec3i(floor(p));
    let f = fract(p);
    let w = f * f * (3.0 - 2.0 * f);
    var level = vec2f(0.0);
    for (var z = 0; z < 2; z++) {
        let a = mix(hash3(cell + vec3i(0, 0, z)), hash3(cell + vec3i(1, 0, z)), w.x);
        let b = mix(hash3(cell + vec3i(0, 1, z)), hash3(cell + vec3i(1, 1, z)), w.x);
        level[z] = mix(a, b, w.y);
    }
    return mix(level.x, level.y, w.z);
}

// 1 between low and high and 0 outside, smoothed over one pixel; `step` is the change of x from pixel to pixel.
fn band(x: f32, low: f32, high: f32, step: f32) -> f32 {
    let s = max(step, 1e-6);
    return saturate((x - low) / s + 0.5) * saturate((high - x) / s + 0.5);
}

// A band that repeats with period 1, fading to its mean where the period falls below a pixel or two.
fn bands(x: f32, low: f32, high: f32, step: f32) -> f32 {
    return mix(band(fract(x), low, high, step), high - low, saturate(step * 2.0 - 0.6));
}
