// Walls of buildings.

// A wall as its painter sees it: where the point is on the wall, how the wall is divided, and where the view ray meets
// the panes, which lie behind the wall.
struct Wall {
    // Columns and storeys, and what a pixel covers of them.
    cell: vec2f,
    step: vec2f,
    // The same behind the wall, in the plane of the panes.
    pane: vec2f,
    // Metres along the wall from its middle, and up.
    at: vec2f,
    footprint: vec2f,
    // Size of a cell, m.
    bay: vec2f,
    // A number of this window.
    chance: f32,
    ground_floor: bool,
}

// How deep panes lie behind the wall, m.
fn reveal_depth(kind: f32, seed: f32) -> f32 {
    return select(mix(0.1, 0.24, fract(seed * 53.0)), 0.03, kind == 3.0);
}

fn wall_of(hit: Hit, kind: f32, height: f32, storeys: f32) -> Wall {
    var w: Wall;
    let seed = hit.size.w;
    let along_y = abs(hit.body_normal.x) > abs(hit.body_normal.y);
    let width = select(hit.size.x, hit.size.y, along_y);
    let wide = select(mix(2.4, 3.6, fract(seed * 7.0)), 1.5, kind == 3.0);
    let columns = max(1.0, round(width / wide));
    w.bay = vec2f(width / columns, height / storeys);
    w.at = vec2f(select(hit.body.x, hit.body.y, along_y), hit.body.z);
    w.footprint = vec2f(select(hit.footprint.x, hit.footprint.y, along_y), hit.footprint.z);
    let origin = vec2f(-0.5 * width, 0.0);
    w.cell = (w.at - origin) / w.bay;
    w.step = w.footprint / w.bay;
    // The view ray goes on to the panes; from far away that is less than a pixel.
    let ray = hit.relative / max(length(hit.relative), 1e-6);
    let tangent = cross(vec3f(0.0, 0.0, 1.0), hit.normal);
    let to_u = select(-sign(hit.body_normal.y), sign(hit.body_normal.x), along_y);
    let inwards = max(-dot(ray, hit.normal), 0.12);
    let shift = vec2f(dot(ray, tangent) * to_u, ray.z) / inwards * reveal_depth(kind, seed);
    w.pane = (w.at + shift - origin) / w.bay;
    w.chance = hash3(vec3i(vec2i(floor(w.cell)), i32(seed * 8192.0) + i32(along_y) * 7));
    w.ground_floor = w.cell.y < 1.0;
    return w;
}

// The corners of the windows of a wall, in shares of a cell: low x, low y, high x, high y.
fn window_of(w: Wall, kind: f32, seed: f32, storeys: f32) -> vec4f {
    let style = fract(seed * 13.0);
    if (w.ground_floor && kind == 1.0) {
        return vec4f(0.05, 0.1, 0.95, 0.68);
    }
    if (kind == 3.0) {
        return vec4f(0.03, select(0.24, 0.02, style > 0.5), 0.97, 0.985);
    }
    if (kind == 4.0) {
        return vec4f(0.02, 0.66, 0.98, 0.86);
    }
    let ribbon = style > 0.78 && storeys > 3.5 && kind != 2.0;
    let half = select(mix(0.2, 0.31, fract(seed * 29.0)), 0.47, ribbon);
    return vec4f(0.5 - half, select(mix(0.22, 0.34, style), 0.32, ribbon), 0.5 + half, select(mix(0.78, 0.86, style), 0.84, ribbon));
}

// Brick, plaster, panels or sheet metal.
fn masonry(s: Surface, w: Wall, kind: f32, seed: f32) -> vec3f {
    let weather = 0.9 + 0.16 * noise2(w.at * 0.5 + seed * 91.0) - 0.08 * smoothstep(1.2, 0.0, w.at.y);
    var albedo = s.albedo * weather;
    let style = fract(seed * 17.0);
    if (kind == 4.0) {
        let rib = abs(fract(w.at.x * 4.0) - 0.5) * 2.0;
        return albedo * mix(0.8 + 0.3 * rib, 0.95, saturate(w.footprint.x * 5.0));
    }
    if (style < 0.45) {
        // Courses of bricks, each row half a brick on.
        let row = floor(w.at.y / 0.075);
        let brick = vec2f(w.at.x / 0.24 + 0.5 * fract(row * 0.5) * 2.0, w.at.y / 0.075);
        let near = saturate(1.6 - w.footprint.y * 26.0);
        let joint = max(bands(brick.x, 0.0, 0.06, w.footprint.x / 0.24), bands(brick.y, 0.0, 0.16, w.footprint.y / 0.075));
        let tone = hash3(vec3i(vec2i(floor(brick)), 3)) - 0.5;
        return albedo * (1.0 + near * (0.22 * tone)) + near * joint * (vec3f(0.34, 0.32, 0.29) - albedo) * 0.55;
    }
    if (style > 0.8) {
        let joint = max(bands(w.cell.x, 0.0, 0.012, w.step.x), bands(w.cell.y, 0.0, 0.014, w.step.y));
        return albedo * (1.0 - 0.4 * joint);
    }
    return albedo;
}

fn facade(hit: Hit, base: Surface) -> Surface {
    var s = base;
    let kind = hit.extra.x;
    let seed = hit.size.w;
    let height = hit.size.z - select(0.9, 2.2, kind == 2.0);
    if (abs(hit.body_normal.z) > 0.5 || hit.paint > 0.5 || hit.body.z > height + 0.001) {
        return s;
    }
    let storeys = select(hit.extra.y, max(1.0, round(height / 3.1)), hit.extra.y < 0.5);
    let w = wall_of(hit, kind, height, storeys);
    s.albedo = masonry(s, w, kind, seed);
    let trim_color = mix(s.albedo * 1.3 + 0.05, vec3f(0.72, 0.7, 0.66), 0.6);
    let accent = mix(vec3f(0.05, 0.18, 0.2), vec3f(0.45, 0.08, 0.04), step(0.5, fract(seed * 41.0)));
    let shop = kind == 1.0;
    let front = hit.body_normal.x > 0.5;
    let below = f32(w.cell.y < storeys);
    // The door is where the front's middle is.
    let entrance = front && w.ground_floor;
    let door = band(abs(w.at.x), -1.0, 0.62, w.footprint.x) * band(w.at.y, -1.0, 2.25, w.footprint.y) * f32(entrance);
    let casing = band(abs(w.at.x), -1.0, 0.78, w.footprint.x) * band(w.at.y, -1.0, 2.42, w.footprint.y) * f32(entrance);
    let clear = (1.0 - band(abs(w.at.x), -1.0, 1.1, w.footprint.x) * f32(entrance && !shop)) * below;
    // Surrounds and sills stand before the wall, the pane lies behind it.
    let window = window_of(w, kind, seed, storeys);
    let edge = select(0.085, 0.0, kind > 2.5) / w.bay;
    let surround = bands(w.cell.x, window.x - edge.x, window.z + edge.x, w.step.x) * bands(w.cell.y, window.y - edge.y, window.w + edge.y, w.step.y) * clear;
    let sill = bands(w.cell.x, window.x - 1.6 * edge.x, window.z + 1.6 * edge.x, w.step.x) * bands(w.cell.y, window.y - 1.6 * edge.y, window.y, w.step.y) * clear * f32(kind < 2.5);
    let opening = bands(w.cell.x, window.x, window.z, w.step.x) * bands(w.cell.y, window.y, window.w, w.step.y) * clear;
    s.albedo = mix(s.albedo, trim_color, surround * f32(fract(seed * 5.0) > 0.3));
    s.albedo = mix(s.albedo, vec3f(0.6, 0.59, 0.56), sill * 0.9);
    s = glazing(hit, s, w, window, opening, kind);
    // A cornice between storeys, a plinth at the foot, a fascia over the shop.
    let cornice = bands(w.cell.y + 0.02, 0.0, 0.05, w.step.y) * f32(fract(seed * 13.0) < 0.5 && kind < 3.0) * below * (1.0 - opening);
    s.albedo = mix(s.albedo, trim_color, cornice * 0.8);
    s.albedo *= mix(1.0, 0.62, band(w.at.y, -1.0, 0.45, w.footprint.y) * f32(!shop) * (1.0 - opening));
    let fascia = band(w.cell.y, 0.72, 0.94, w.step.y) * f32(shop && front);
    s.albedo = mix(s.albedo, accent, fascia);
    // Letters, as far as one does not read them.
    let letter = hash3(vec3i(i32(floor(w.at.x * 3.2)), i32(floor(w.at.y * 8.0)), i32(seed * 999.0)));
    let written = fascia * band(abs(w.at.x), -1.0, 2.2, w.footprint.x) * band(w.cell.y, 0.78, 0.89, w.step.y) * f32(letter > 0.4);
    s.albedo = mix(s.albedo, vec3f(0.8, 0.78, 0.7), written * 0.85);
    s.emissive += vec3f(0.9, 0.8, 0.6) * written * globals.sun_direction.w * 0.8;
    let leaf = mix(vec3f(0.12, 0.05, 0.025), accent * 0.6, step(0.4, fract(seed * 3.0)));
    let panel = band(abs(abs(w.at.x) - 0.3), -1.0, 0.2, w.footprint.x) * (band(w.at.y, 0.25, 1.0, w.footprint.y) + band(w.at.y, 1.15, 2.0, w.footprint.y));
    s.albedo = mix(s.albedo, trim_color, casing * (1.0 - f32(shop) * opening));
    s.albedo = mix(s.albedo, leaf * (1.0 - 0.35 * panel), door);
    s.gloss *= 1.0 - door;
    s.emissive *= 1.0 - door * 0.9;
    return s;
}

// Jambs, frames and panes inside the openings.
fn glazing(hit: Hit, base: Surface, w: Wall, window: vec4f, opening: f32, kind: f32) -> Surface {
    var s = base;
    if (opening <= 0.0) {
        return s;
    }
    let seed = hit.size.w;
    let shop = kind == 1.0 && w.ground_floor;
    // The pane's own coordinates, counted from the cell of the opening.
    let local = w.pane - floor(w.cell);
    let seen = band(local.x, window.x, window.z, w.step.x) * band(local.y, window.y, window.w, w.step.y);
    let frame = 0.05 / w.bay;
    var glass = band(local.x, window.x + frame.x, window.z - frame.x, w.step.x) * band(local.y, window.y + frame.y, window.w - frame.y, w.step.y);
    let middle = 0.5 * (window.x + window.z);
    let post = 1.0 - band(local.x, middle - 0.4 * frame.x, middle + 0.4 * frame.x, w.step.x) * f32(kind < 2.5);
    let head = mix(window.y, window.w, 0.7);
    let rail = 1.0 - band(local.y, head - 0.4 * frame.y, head + 0.4 * frame.y, w.step.y) * f32(kind < 1.5 && fract(seed * 37.0) > 0.5 && !shop);
    glass *= mix(post * rail, 1.0, saturate(w.step.x * 3.0 - 0.3));
    glass *= seen;
    let jamb = base.albedo * select(0.62, 0.85, local.y < window.y);
    let frames = mix(vec3f(0.68, 0.67, 0.64), vec3f(0.05, 0.052, 0.055), step(0.5, fract(seed * 19.0) + f32(kind > 2.5)));
    var color = mix(jamb, frames, seen);
    // Behind a pane: a dark room, or a blind let down so far.
    let blind = step(0.62, w.chance) * step(1.0 - 0.7 * fract(w.chance * 7.0), (local.y - window.y) / (window.w - window.y)) * f32(!shop && kind < 2.5);
    let tint = select(vec3f(0.014, 0.02, 0.028), mix(vec3f(0.012, 0.03, 0.04), vec3f(0.03, 0.035, 0.03), fract(seed * 61.0)), kind == 3.0);
    let goods = hash3(vec3i(vec2i(floor(w.pane * vec2f(9.0, 6.0))), i32(seed * 77.0)));
    let display = vec3f(goods, fract(goods * 7.0), fract(goods * 13.0)) * 0.22 * f32(shop && local.y < 0.38 && goods > 0.35);
    color = mix(color, mix(tint + display, vec3f(0.34, 0.32, 0.28), blind), glass);
    s.albedo = mix(s.albedo, color, opening);
    let lit = step(fract(w.chance * 17.0), select(0.42, 0.95, shop));
    let warm = mix(vec3f(1.0, 0.7, 0.36), vec3f(0.9, 0.92, 1.0), f32(kind == 3.0) * step(0.4, fract(w.chance * 29.0)));
    s.emissive += warm * (0.75 * glass * opening * lit * globals.sun_direction.w * (0.4 + 0.6 * fract(w.chance * 5.0)) * (1.0 - 0.5 * blind));
    s.gloss = mix(s.gloss, glass, opening);
    // Panes are never quite parallel, so each mirrors another piece of sky.
    let tilt = vec3f(w.chance, fract(w.chance * 9.0), fract(w.chance * 33.0)) - 0.5;
    s.normal = normalize(s.normal + glass * opening * 0.04 * tilt);
    return s;
}
