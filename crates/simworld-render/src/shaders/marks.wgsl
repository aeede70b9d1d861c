// What is painted on roads; the twin of look/street/marks.rs.
fn marked(hit: Hit, base: Surface) -> Surface {
    if (hit.body_normal.z < 0.5) {
        return base;
    }
    return mark(hit, base, on_surface(hit));
}

// One mark: paint on asphalt, a surface of its own, or iron; `p` is the point in the frame of the road.
fn mark(hit: Hit, base: Surface, p: vec2f) -> Surface {
    var s = base;
    let kind = mark_of(hit.extra.x);
    let at = hit.body.xy;
    let step = hit.footprint.xy;
    let half = hit.size.xy * 0.5;
    s.albedo = carriageway(p, f32(u32(hit.extra.y) >> 14u) * 0.01, s.albedo);
    var paint = 0.0;
    switch kind {
        case 1u: { paint = band(abs(at.y), -1.0, HALF_LINE, step.y) * thin(step.y); }
        case 2u: { paint = band(abs(at.y), -1.0, HALF_LINE, step.y) * thin(step.y) * broken(p.x, step.x); }
        case 3u: { paint = band(abs(abs(at.y) - 0.15), -1.0, HALF_LINE, step.y) * thin(step.y); }
        case 4u: { paint = band(abs(at.x), -1.0, half.x - 0.3, step.x) * band(abs(at.y), -1.0, half.y - 0.1, step.y); }
        case 5u: { paint = band(abs(at.x), -1.0, half.x - 0.3, step.x) * bands(at.y / 0.9, 0.2, 0.8, step.y / 0.9); }
        case 6u: {
            s.albedo = asphalt(p, vec3f(0.23, 0.052, 0.036));
        }
        case 7u: {
            let fine = noise2(p * 2.3) * 0.5 + noise2(p * 9.0) * 0.5;
            let edge = band(abs(at.y), half.y - 0.18, half.y + 1.0, step.y);
            s.albedo = mix(vec3f(0.1, 0.16, 0.055) * (0.75 + 0.5 * fine), vec3f(0.42, 0.41, 0.39), edge);
            s.roughness = 0.9;
        }
        case 8u: {
            let stone = hash3(vec3i(vec2i(floor(p * 4.0)), 9));
            s.albedo = vec3f(0.3, 0.29, 0.28) * (0.85 + 0.3 * mix(stone, 0.5, saturate(step.x * 4.0)));
        }
        case 9u: { s = cover(s, at, step); }
        case 10u: { s = grate(s, at, half, step); }
        case 11u: { paint = band(abs(at.x), -1.0, HALF_LINE, step.x) * thin(step.x); }
        case 12u: { paint = bicycle(select(at, -at, p.x < 0.0), step); }
        default: {
            // Arrows of lanes against the centreline are turned round.
            paint = arrow(select(at, -at, kind >= 24u), kind & 7u, step);
        }
    }
    s.albedo = mix(s.albedo, white_paint(p), paint * 0.9);
    return s;
}

// The lid of a manhole: iron, with a rim and knobs.
fn cover(base: Surface, at: vec2f, step: vec2f) -> Surface {
    var s = base;
    let r = length(at);
    let pixel = max(step.x, step.y);
    let lid = band(r, -1.0, 0.34, pixel);
    let knobs = bands(at.x / 0.09, 0.2, 0.7, step.x / 0.09) * bands(at.y / 0.09, 0.2, 0.7, step.y / 0.09);
    let rim = band(r, 0.28, 0.31, pixel);
    s.albedo = mix(s.albedo, vec3f(0.05, 0.047, 0.043) * (0.7 + 0.9 * knobs) * (1.0 - 0.6 * rim), lid);
    s.roughness = mix(s.roughness, 0.5, lid);
    return s;
}

// A gully: bars over a dark hole.
fn grate(base: Surface, at: vec2f, half: vec2f, step: vec2f) -> Surface {
    var s = base;
    let whole = band(abs(at.x), -1.0, half.x - 0.02, step.x) * band(abs(at.y), -1.0, half.y - 0.02, step.y);
    let slots = bands(at.x / 0.075, 0.25, 0.75, step.x / 0.075) * band(abs(at.y), -1.0, half.y - 0.06, step.y);
    s.albedo = mix(s.albedo, mix(vec3f(0.07, 0.066, 0.06), vec3f(0.008), slots), whole);
    s.roughness = mix(s.roughness, 0.55, whole);
    return s;
}

// The share of a pixel within a triangle along the x axis, from its base at `low` to its tip at `high`.
fn tip(x: f32, y: f32, low: f32, high: f32, half: f32, step: vec2f) -> f32 {
    let slope = half / (high - low);
    let inside = (high - x) * slope - abs(y);
    return saturate(inside / max(step.y + step.x * slope, 1e-6) + 0.5) * saturate((x - low) / max(step.x, 1e-6) + 0.5);
}

// An arrow along x, with a head for each way: 1 left, 2 straight on, 4 right.
fn arrow(at: vec2f, ways: u32, step: vec2f) -> f32 {
    let straight = (ways & 2u) != 0u;
    var paint = band(at.x, -2.5, select(0.5, 1.3, straight), step.x) * band(abs(at.y), -1.0, 0.08, step.y);
    if (straight) {
        paint = max(paint, tip(at.x, at.y, 1.3, 2.5, 0.33, step));
    }
    for (var side = 0u; side < 2u; side++) {
        if ((ways & select(4u, 1u, side == 0u)) == 0u) {
            continue;
        }
        let y = select(-at.y, at.y, side == 0u);
        // Out of the shaft aslant, then the head.
        let bent = at.x - 0.35 - 0.9 * y;
        let shaft = band(abs(bent), -1.0, 0.16, step.x + step.y) * band(y, 0.0, 0.42, step.y);
        let head = tip(y, at.x - 0.75, 0.4, 0.85, 0.55, step.yx);
        paint = max(paint, max(shaft, head));
    }
    return paint;
}

// Two wheels and a frame.
fn bicycle(at: vec2f, step: vec2f) -> f32 {
    let pixel = max(step.x, step.y);
    let line = 0.035;
    let wheel = min(abs(length(at - vec2f(-0.3, 0.28)) - 0.2), abs(length(at - vec2f(-0.3, -0.28)) - 0.2));
    let bars = min(stroke(at, vec2f(-0.3, 0.28), vec2f(0.1, 0.1)), min(stroke(at, vec2f(-0.3, -0.28), vec2f(0.12, -0.16)), stroke(at, vec2f(0.1, 0.1), vec2f(0.12, -0.16))));
    let frame = min(bars, min(stroke(at, vec2f(-0.3, 0.0), vec2f(0.1, 0.1)), stroke(at, vec2f(-0.3, 0.0), vec2f(0.12, -0.16))));
    return saturate((line - min(wheel, frame)) / max(pixel, 1e-6) + 0.5);
}

// How far a point is from a line between two others.
fn stroke(at: vec2f, a: vec2f, b: vec2f) -> f32 {
    let way = b - a;
    return length(at - a - way * saturate(dot(at - a, way) / dot(way, way)));
}
