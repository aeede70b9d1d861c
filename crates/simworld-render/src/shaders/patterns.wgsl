// Surfaces painted from body-frame coordinates, in metres: no textures.
struct Surface {
    albedo: vec3f,
    // How much it mirrors the sky, 0 to 1.
    gloss: f32,
    emissive: vec3f,
    normal: vec3f,
}

fn facade(hit: Hit, base: Surface) -> Surface {
    var s = base;
    let size = hit.size.xyz;
    let side = abs(hit.body_normal);
    let along_y = side.x > side.y;
    let width = select(size.x, size.y, along_y);
    let u = select(hit.body.x, hit.body.y, along_y);
    let seed = hit.size.w;
    let house = hit.extra.x > 1.5;
    let shop = hit.extra.x > 0.5 && !house;
    let wall = size.z - select(0.9, 2.2, house);
    let storeys = select(hit.extra.y, max(1.0, round(wall / 3.1)), hit.extra.y < 0.5);
    let storey = wall / storeys;
    let columns = max(1.0, round(width / mix(2.4, 3.4, fract(seed * 7.0))));
    let x = (u / width + 0.5) * columns;
    let y = hit.body.z / storey;
    let du = select(hit.footprint.x, hit.footprint.y, along_y);
    let dz = hit.footprint.z;
    let dx = du / width * columns;
    let dy = dz / storey;
    if (side.z > 0.5 || hit.paint > 0.5 || hit.body.z > wall + 0.001) {
        return s;
    }
    let column = vec2i(vec2f(floor(x), floor(y)));
    let key = i32(seed * 8192.0);
    let chance = hash3(vec3i(column, key + i32(along_y) * 7));
    // Courses of brick or panels, and weather.
    let course = bands(hit.body.z * 3.0, 0.0, 0.12, dz * 3.0);
    s.albedo *= 0.93 + 0.14 * noise2(vec2f(u, hit.body.z) * 0.6 + seed * 91.0) - 0.10 * course;
    let style = fract(seed * 13.0);
    let ribbon = style > 0.72 && storeys > 3.5;
    let half = select(mix(0.22, 0.32, fract(seed * 29.0)), 0.46, ribbon);
    let ground_floor = y < 1.0;
    var low = vec2f(0.5 - half, select(mix(0.24, 0.34, style), 0.3, ribbon));
    var high = vec2f(0.5 + half, 0.84);
    if (ground_floor && shop) {
        low = vec2f(0.05, 0.1);
        high = vec2f(0.95, 0.7);
    }
    let trim = vec2f(0.09, 0.09) * vec2f(columns / width, 1.0 / storey);
    var framed = bands(x, low.x - trim.x, high.x + trim.x, dx) * bands(y, low.y - trim.y * 1.6, high.y + trim.y, dy);
    var glass = bands(x, low.x, high.x, dx) * bands(y, low.y, high.y, dy);
    // A bar down the middle of ordinary windows.
    let mullion = 1.0 - bands(x, 0.5 - trim.x * 0.3, 0.5 + trim.x * 0.3, dx) * f32(!ribbon);
    glass *= mix(mullion, 1.0, saturate(dx * 3.0 - 0.3));
    // The top storey of a house ends at its eaves.
    let below = f32(y < storeys);
    framed *= below;
    glass *= below;
    let entrance = along_y && hit.body_normal.x > 0.5 && ground_floor;
    let door = band(abs(u), -1.0, 0.62, du) * band(hit.body.z, -1.0, 2.25, dz) * f32(entrance);
    let casing = band(abs(u), -1.0, 0.76, du) * band(hit.body.z, -1.0, 2.4, dz) * f32(entrance);
    let clear = 1.0 - band(abs(u), -1.0, 1.1, du) * f32(entrance && !shop);
    framed *= clear;
    glass *= clear;
    let light_trim = mix(s.albedo * 1.35 + 0.06, vec3f(0.72, 0.7, 0.66), 0.65);
    let accent = mix(vec3f(0.05, 0.18, 0.2), vec3f(0.45, 0.08, 0.04), step(0.5, fract(seed * 41.0)));
    s.albedo = mix(s.albedo, light_trim, framed);
    // A cornice between storeys, a plinth at the foot, a sign over the shop.
    let cornice = bands(y + 0.02, 0.0, 0.05, dy) * f32(style < 0.5) * below;
    s.albedo = mix(s.albedo, light_trim, cornice * 0.8);
    s.albedo *= mix(1.0, 0.62, band(hit.body.z, -1.0, 0.45, dz) * f32(!shop));
    let sign = band(hit.body.z, storey * 0.74, storey * 0.95, dz) * f32(shop && ground_floor && along_y && hit.body_normal.x > 0.0);
    s.albedo = mix(s.albedo, accent, sign);
    let curtain = mix(vec3f(0.014, 0.02, 0.028), vec3f(0.2, 0.19, 0.17), step(0.72, chance) * 0.6);
    let reveal = 1.0 - 0.55 * smoothstep(high.y - 0.13, high.y, fract(y));
    s.albedo = mix(s.albedo, curtain * reveal, glass);
    let night = globals.sun_direction.w;
    let lit = step(fract(chance * 17.0), select(0.42, 0.9, shop && ground_floor));
    s.emissive += vec3f(1.0, 0.72, 0.38) * (0.75 * glass * lit * night * (0.5 + 0.5 * fract(chance * 5.0)));
    s.albedo = mix(s.albedo, light_trim, casing * (1.0 - glass * f32(shop)));
    s.albedo = mix(s.albedo, mix(vec3f(0.12, 0.05, 0.025), accent * 0.6, step(0.4, fract(seed * 3.0))), door);
    s.gloss = glass * (1.0 - door);
    // Panes are never quite parallel, so each mirrors another piece of sky.
    s.normal = normalize(s.normal + glass * 0.05 * (vec3f(chance, fract(chance * 9.0), fract(chance * 33.0)) - 0.5));
    return s;
}

fn asphalt(p: vec2f, albedo: vec3f) -> vec3f {
    let near = noise2(p * 14.0);
    let patches = noise2(p * 0.23) * 0.6 + noise2(p * 1.1 + 7.0) * 0.4;
    return albedo * (0.78 + 0.22 * near + 0.28 * patches);
}

fn road(hit: Hit, base: Surface) -> Surface {
    var s = base;
    let length = hit.size.x;
    let width = hit.size.y;
    let p = hit.body.xy;
    let dx = hit.footprint.x;
    let dy = hit.footprint.y;
    if (hit.body_normal.z < 0.5) {
        return s;
    }
    s.albedo = asphalt(p, s.albedo);
    let lanes = 2.0 * max(1.0, floor(width / 6.0 + 0.25));
    let lane = width / lanes;
    // Wheel tracks are polished darker.
    let track = abs(fract((p.y + width * 0.5) / lane * 2.0) - 0.5);
    s.albedo *= 0.92 + 0.12 * smoothstep(0.1, 0.4, track);
    // Markings end where other roads may come in: a width before the ends, and a crossing.
    let ends = band(abs(p.x), -1.0, length * 0.5 - width - 6.0, dx);
    let dash = bands(p.x / 9.0, 0.0, 0.36, dx / 9.0);
    let line = 0.07;
    var paint = 0.0;
    if (lanes > 3.0) {
        paint = band(abs(abs(p.y) - 0.15), -1.0, line, dy);
        let k = round(p.y / lane);
        let separator = band(abs(p.y - k * lane), -1.0, line, dy) * dash;
        paint = max(paint, separator * f32(abs(k) > 0.5 && abs(k) < lanes * 0.5 - 0.5));
    } else {
        paint = band(abs(p.y), -1.0, line, dy) * dash;
    }
    // Thin lines far away cover a part of a pixel.
    paint *= ends * min(1.0, 2.5 * line / max(dy, 1e-6));
    s.albedo = mix(s.albedo, vec3f(0.62) * (0.75 + 0.25 * noise2(p * 6.0)), paint * 0.9);
    return s;
}

fn crosswalk(hit: Hit, base: Surface) -> Surface {
    var s = base;
    let p = hit.body.xy;
    let period = hit.size.x / max(1.0, round(hit.size.x / 1.0));
    let x = (p.x + hit.size.x * 0.5) / period;
    let stripes = bands(x, 0.25, 0.75, hit.footprint.x / period);
    if (hit.body_normal.z < 0.5) {
        return s;
    }
    s.albedo = asphalt(p, s.albedo);
    s.albedo = mix(s.albedo, vec3f(0.66) * (0.72 + 0.28 * noise2(p * 5.0)), stripes * 0.92);
    return s;
}

fn sidewalk(hit: Hit, base: Surface) -> Surface {
    var s = base;
    let p = hit.body.xy;
    let slab = p / vec2f(1.2, 0.8) + vec2f(0.0, 0.5);
    let step = hit.footprint.xy / vec2f(1.2, 0.8);
    if (hit.body_normal.z < 0.5) {
        s.albedo *= 1.15;
        return s;
    }
    let joint = max(bands(slab.x, 0.0, 0.022, step.x), bands(slab.y, 0.0, 0.033, step.y));
    let tone = hash3(vec3i(vec2i(floor(slab)), 5));
    s.albedo *= 0.86 + 0.14 * mix(tone, 0.5, saturate(step.x * 1.5)) + 0.12 * noise2(p * 0.5) - 0.3 * joint;
    let kerb = smoothstep(hit.size.y * 0.5 - 0.2, hit.size.y * 0.5 - 0.17, abs(p.y));
    s.albedo = mix(s.albedo, vec3f(0.5, 0.49, 0.47), kerb * 0.8);
    return s;
}

fn ground(hit: Hit, base: Surface) -> Surface {
    var s = base;
    let p = hit.body.xy;
    let wide = noise2(p * 0.035) * 0.6 + noise2(p * 0.13) * 0.4;
    let fine = noise2(p * 2.3) * 0.5 + noise2(p * 9.0) * 0.5;
    s.albedo *= mix(vec3f(0.8, 0.85, 0.75), vec3f(1.3, 1.15, 0.9), wide) * (0.75 + 0.5 * fine);
    return s;
}

fn foliage(hit: Hit, base: Surface) -> Surface {
    var s = base;
    if (hit.paint > 0.5) {
        return s;
    }
    let p = hit.body * (9.0 / sqrt(max(hit.size.z, 1.0)));
    let coarse = noise3(p * 0.8 + hit.size.w * 50.0);
    let fine = noise3(p * 3.1);
    let leaf = vec3f(fine, noise3(p * 3.1 + 19.0), noise3(p * 3.1 + 41.0)) - 0.5;
    s.normal = normalize(s.normal + leaf * 1.1);
    s.albedo *= (0.45 + 0.8 * coarse) * (0.6 + 0.8 * fine);
    return s;
}
