// Carriageways and crossings.
fn road(hit: Hit, base: Surface) -> Surface {
    var s = base;
    if (hit.body_normal.z < 0.5) {
        return s;
    }
    let p = hit.body.xy;
    let width = hit.size.y;
    let lanes = 2.0 * max(1.0, floor(width / 6.0 + 0.25));
    let lane = width / lanes;
    s.albedo = carriageway(p, lane, s.albedo);
    if (hit.extra.x < 0.5) {
        let paint = guessed_lines(p, hit.size.x, width, lanes, hit.footprint.xy);
        s.albedo = mix(s.albedo, white_paint(p), paint * 0.9);
    }
    return s;
}

// Lines where no network says what is painted: in the middle, and between lanes of the usual width.
fn guessed_lines(p: vec2f, length: f32, width: f32, lanes: f32, step: vec2f) -> f32 {
    let lane = width / lanes;
    // They end where other roads may come in: a width before the ends, and a crossing.
    let ends = band(abs(p.x), -1.0, length * 0.5 - width - 6.0, step.x);
    let dash = broken(p.x, step.x);
    var paint = 0.0;
    if (lanes > 3.0) {
        paint = band(abs(abs(p.y) - 0.15), -1.0, 0.07, step.y);
        let k = round(p.y / lane);
        let separator = band(abs(p.y - k * lane), -1.0, 0.07, step.y) * dash;
        paint = max(paint, separator * f32(abs(k) > 0.5 && abs(k) < lanes * 0.5 - 0.5));
    } else {
        paint = band(abs(p.y), -1.0, 0.07, step.y) * dash;
    }
    return paint * ends * min(1.0, 2.5 * 0.07 / max(step.y, 1e-6));
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
