// The sky: what air and aerosol scatter by the table of light.rs, clouds, fog, and the glow of the night. Radiances are π
// times themselves and exposed, as everywhere.

// Nodes of the table, SKY_ACROSS and SKY_UP of light.rs, and the asymmetry of atmosphere.rs.
const ACROSS: u32 = 9u;
const UP: u32 = 16u;
const ASYMMETRY: f32 = 0.8;

// The place of the azimuth from the sun or moon in the table.
fn sky_column(direction: vec3f) -> f32 {
    let flat = direction.xy * inverseSqrt(max(dot(direction.xy, direction.xy), 1e-12));
    let around = dot(flat, globals.source_flat.xy);
    return sqrt(max(0.5 - 0.5 * around, 0.0)) * f32(ACROSS - 1u);
}

// Aerosol throws light forwards (Henyey and Greenstein).
fn phase(cosine: f32) -> f32 {
    let below = 1.0 + ASYMMETRY * ASYMMETRY - 2.0 * ASYMMETRY * cosine;
    return (1.0 - ASYMMETRY * ASYMMETRY) / (12.566371 * below * sqrt(below));
}

fn with_aerosol(node: vec4f, direction: vec3f, up: f32) -> vec3f {
    let color = mix(globals.aerosol_low.rgb, globals.aerosol_high.rgb, up);
    return node.rgb + color * (node.a * phase(dot(direction, globals.sun_direction.xyz)));
}

// The sky above the horizon without clouds.
fn clear_sky(direction: vec3f) -> vec3f {
    let column = sky_column(direction);
    let row = sqrt(saturate(direction.z)) * f32(UP - 1u);
    let c = min(u32(column), ACROSS - 2u);
    let r = min(u32(row), UP - 2u);
    let right = column - f32(c);
    let k = r * ACROSS + c;
    let low = mix(sky_node(k), sky_node(k + 1u), right);
    let high = mix(sky_node(k + ACROSS), sky_node(k + ACROSS + 1u), right);
    return with_aerosol(mix(low, high, row - f32(r)), direction, row / f32(UP - 1u));
}

// Clouds as an even cover, by the share of the sky that they have: the overcast sky of the CIE.
fn clouded(clear: vec3f, z: f32) -> vec3f {
    return clear * (1.0 - globals.overcast.w) + globals.overcast.rgb * ((1.0 + 2.0 * z) / 3.0) + globals.night_sky.rgb;
}

fn fogged(sky: vec3f, z: f32) -> vec3f {
    return mix(sky, globals.fog.rgb, 1.0 - exp(-globals.aerosol_low.w / max(z, 0.01)));
}

// What the air scatters into a line of sight near the ground: the horizon under it, and fog.
fn haze(direction: vec3f) -> vec3f {
    let column = sky_column(direction);
    let c = min(u32(column), ACROSS - 2u);
    let flat = vec3f(direction.xy * inverseSqrt(max(dot(direction.xy, direction.xy), 1e-12)), 0.0);
    let node = mix(sky_node(c), sky_node(c + 1u), column - f32(c));
    return mix(clouded(with_aerosol(node, flat, 0.0), 0.0), globals.fog.rgb, globals.fog.w);
}

// The sky without the shapes of clouds, as surfaces mirror it; below the horizon what the ground sends back.
fn sky_gradient(direction: vec3f) -> vec3f {
    let z = max(direction.z, 0.0);
    let above = fogged(clouded(clear_sky(vec3f(direction.xy, z)), z), z);
    return mix(above, globals.bounce.rgb, smoothstep(0.0, -0.1, direction.z));
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

// Clouds as shapes, drifting with the wind: dense ones are dark below, thin ones shine around the sun.
fn with_clouds(clear: vec3f, direction: vec3f) -> vec3f {
    let cover = globals.overcast.w;
    if (cover <= 0.0 || direction.z <= 0.0) {
        return clear;
    }
    let p = direction.xy / (direction.z + 0.1) * 1.3 + globals.source_flat.zw;
    let edge = mix(0.72, 0.18, cover);
    let density = cloud_density(p);
    let amount = smoothstep(edge, edge + 0.16, density);
    let towards = dot(direction, globals.sun_direction.xyz);
    let thick = smoothstep(edge + 0.05, edge + 0.4, density);
    // Light that comes through and around: the beam on thin clouds, the sky's light in all.
    let even = globals.overcast.rgb / max(cover, 0.05) * ((1.0 + 2.0 * direction.z) / 3.0);
    let beam = globals.sun.rgb * (0.3 + 0.5 * phase(towards)) * (1.0 - 0.75 * thick);
    let lit = even * mix(1.15, 0.75, thick) + beam * (1.0 - 0.8 * cover) + clear * 0.25;
    let far = smoothstep(0.0, 0.12, direction.z);
    let spread = clouded(clear, direction.z) - globals.night_sky.rgb;
    return mix(spread, mix(clear, lit, amount), far);
}

// Stars in a grid of directions; some are brighter.
fn stars(direction: vec3f) -> f32 {
    let scaled = direction * 90.0;
    let cell = vec3i(floor(scaled));
    let chance = hash3(cell);
    let off = vec3f(hash3(cell + 71), hash3(cell + 137), hash3(cell + 211)) - 0.5;
    let distance = length(fract(scaled) - 0.5 - off * 0.5);
    return smoothstep(0.09, 0.02, distance) * step(0.93, chance) * (0.3 + 14.0 * (chance - 0.93));
}

// The disc of sun or moon; the moon is drawn as large as a careful eye would have it.
fn disc(direction: vec3f) -> vec3f {
    let towards = dot(direction, globals.sun_direction.xyz);
    let night = globals.sun_direction.w;
    let size = mix(0.99996, 0.99985, night);
    let shine = mix(30.0, 60.0, night);
    return globals.sun.rgb * shine * smoothstep(size, mix(size, 1.0, 0.4), towards);
}

fn sky_with_clouds(direction: vec3f) -> vec3f {
    let z = max(direction.z, 0.0);
    let cover = globals.overcast.w;
    let open = 1.0 - cover;
    var clear = clear_sky(vec3f(direction.xy, z)) + disc(direction) * open;
    clear += vec3f(0.85, 0.9, 1.0) * stars(direction) * globals.sun_direction.w * 0.3 * open;
    let above = fogged(with_clouds(clear, direction) + globals.night_sky.rgb, z);
    return mix(above, haze(direction), smoothstep(0.02, 0.0, direction.z));
}

// Khronos PBR Neutral (Khronos Group, 2024): colours below 0.8 keep their hue, brighter ones are pressed together and fade
// to white. Its toe, which takes the mirrored 4 % of dielectrics away, is left out: fog must keep its contrasts.
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
