// Sidewalks, and what grows.
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
