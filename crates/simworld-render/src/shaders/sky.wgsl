// The sky: a gradient from horizon to zenith, the glow of the sun, clouds; below the horizon, haze over the ground.
fn sky_gradient(direction: vec3f) -> vec3f {
    let height = max(direction.z, 0.0);
    let blend = 1.0 - exp(-3.2 * sqrt(height) * (0.35 + height));
    let above = mix(globals.horizon.rgb, globals.zenith.rgb, blend);
    let below = mix(globals.horizon.rgb, globals.bounce.rgb * 1.6, smoothstep(0.0, -0.12, direction.z));
    let towards = max(dot(direction, globals.sun_direction.xyz), 0.0);
    let glow = globals.sun.rgb * (0.10 * pow(towards, 6.0) + 0.25 * pow(towards, 60.0)) * (1.0 - globals.sky.w);
    return select(above, below, direction.z < 0.0) + glow * smoothstep(-0.05, 0.02, direction.z);
}

fn cloud_density(p: vec2f) -> f32 {
    var sum = 0.0;
    var weight = 0.5;
    var q = p;
    for (var octave = 0; octave < 5; octave++) {
        sum += weight * noise2(q);
        weight *= 0.5;
        q = mat2x2f(1.6, 1.2, -1.2, 1.6) * q + vec2f(17.3, 9.1);
    }
    return sum;
}

fn sky_with_clouds(direction: vec3f) -> vec3f {
    var color = sky_gradient(direction);
    let cover = globals.sky.w;
    let towards = dot(direction, globals.sun_direction.xyz);
    color += globals.sun.rgb * 30.0 * smoothstep(0.99995, 0.99998, towards) * (1.0 - cover);
    if (direction.z > 0.0) {
        let p = direction.xy / (direction.z + 0.12) * 1.3;
        let edge = mix(0.66, 0.28, cover);
        let density = cloud_density(p);
        let amount = smoothstep(edge, edge + 0.22, density) * smoothstep(0.0, 0.14, direction.z);
        let lit = globals.horizon.rgb * 1.02 + globals.sun.rgb * 0.16 * (1.0 - cover) + globals.sun.rgb * 0.12 * pow(max(towards, 0.0), 8.0);
        let shade = mix(lit, globals.sky.rgb * 0.9 + globals.horizon.rgb * 0.15, smoothstep(edge + 0.05, edge + 0.4, density) * 0.6);
        color = mix(color, shade, amount * 0.9);
    }
    return color;
}

// The shoulder of Khronos PBR Neutral (Khronos Group, 2024): colours below 0.8 keep their hue and value, brighter ones
// are pressed together and fade to white. Its toe makes up for reflections that surfaces here do not have.
fn tone_map(color: vec3f) -> vec3f {
    let peak = max(color.r, max(color.g, color.b));
    let start = 0.8;
    if (peak < start) {
        return color;
    }
    let room = 1.0 - start;
    let pressed = 1.0 - room * room / (peak + room - start);
    let fade = 1.0 / (0.15 * (peak - pressed) + 1.0);
    return mix(vec3f(pressed), color * (pressed / peak), fade);
}
