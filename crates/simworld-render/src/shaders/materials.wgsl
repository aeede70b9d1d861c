// What surfaces are made of.
struct Finish {
    albedo: vec3f,
    // Its own light, in shares of the albedo.
    emission: f32,
    // How much of a clear coat or pane it has, which mirrors, 0 to 1.
    gloss: f32,
    // Of the surface under that: perceptual roughness (its square is the slope of GGX), and whether it is metal.
    roughness: f32,
    metallic: f32,
}

// Rough, dull and dark at night.
fn matte(albedo: vec3f) -> Finish {
    return Finish(albedo, 0.0, 0.0, 0.85, 0.0);
}

// The body of a thing, by the code of look/mod.rs: its roughness, and 2 more where it is bare metal; dull without one.
fn made_of(albedo: vec3f, code: f32) -> Finish {
    if (code <= 0.0) {
        return matte(albedo);
    }
    let metallic = f32(code >= 2.0);
    return Finish(albedo, 0.0, 0.0, clamp(code - 2.0 * metallic, 0.03, 1.0), metallic);
}

// The materials of mesh/builder.rs; `color` and `second` are those of the instance, with its state in the w of the first and, where no pattern
// paints it, what it is made of in that of the other.
fn finish_of(material: u32, color: vec4f, second: vec4f, seed: f32, plain: bool) -> Finish {
    let night = globals.sun_direction.w;
    let aspect = color.w;
    let skin = mix(vec3f(0.42, 0.24, 0.15), vec3f(0.72, 0.47, 0.33), fract(seed * 11.0));
    let hair = mix(vec3f(0.012, 0.009, 0.008), vec3f(0.2, 0.11, 0.04), pow(fract(seed * 23.0), 2.0));
    switch material {
        case 1u: { return matte(second.rgb); }
        case 2u: { return Finish(vec3f(0.012, 0.017, 0.022), 0.0, 1.0, 0.05, 0.0); }
        case 3u: { return matte(vec3f(0.016)); }
        case 4u: { return Finish(vec3f(0.32, 0.33, 0.34), 0.0, 0.0, 0.55, 1.0); }
        case 5u: { return matte(vec3f(0.13, 0.08, 0.045)); }
        case 6u: { return matte(skin); }
        case 7u: { return matte(hair); }
        case 8u: { return Finish(vec3f(0.8, 0.8, 0.76), 0.15 + 1.6 * night, 0.6, 0.2, 0.0); }
        case 9u: { return Finish(vec3f(0.5, 0.012, 0.01), 0.1 + 1.0 * night, 0.5, 0.2, 0.0); }
        case 10u: { return Finish(vec3f(0.9, 0.8, 0.6), 0.1 + 2.4 * night, 0.0, 0.6, 0.0); }
        case 11u: { return Finish(mix(vec3f(0.11, 0.012, 0.01), vec3f(1.0, 0.04, 0.02), f32(aspect == 1.0)), 1.6 * f32(aspect == 1.0), 0.2, 0.3, 0.0); }
        case 12u: { return Finish(mix(vec3f(0.1, 0.06, 0.008), vec3f(1.0, 0.5, 0.02), f32(aspect == 2.0)), 1.6 * f32(aspect == 2.0), 0.2, 0.3, 0.0); }
        case 13u: { return Finish(mix(vec3f(0.008, 0.07, 0.03), vec3f(0.03, 1.0, 0.35), f32(aspect == 3.0)), 1.6 * f32(aspect == 3.0), 0.2, 0.3, 0.0); }
        case 14u: { return matte(vec3f(0.7, 0.68, 0.64)); }
        case 15u: { return Finish(vec3f(0.03, 0.031, 0.034), 0.0, 0.1, 0.5, 0.0); }
        case 16u: { return Finish(color.rgb, 0.0, 0.5, 0.5, 0.0); }
        case 17u: { return matte(vec3f(0.08, 0.16, 0.045)); }
        default: { return made_of(color.rgb, select(0.0, second.w, plain)); }
    }
}
