// How rays walk a scene: a tree over what stands still, one over what moves, and one in each mesh, all of nodes with four children. A view
// ray's direction has planar depth one, so the parameter along it is the planar depth.
struct View {
    globals: Globals,
    // The eye from the origin of the trees; w: near.
    eye: vec4f,
    // far, min_pixels, the longer focal length in pixels; w: 1 if everything is seen at its finest level.
    limits: vec4f,
    // First pixel, pitch, width, height.
    span: vec4u,
    // Slot plus one of who is hidden; the root of the tree of what moves; slot plus one of who alone is seen, or 0; 1 if rays are
    // parallel.
    hidden: vec4u,
}

struct Node {
    codes: vec4u,
    low_x: vec4f,
    low_y: vec4f,
    low_z: vec4f,
    high_x: vec4f,
    high_y: vec4f,
    high_z: vec4f,
}

// An instance; see raycast/bodies.rs.
struct Placed {
    center: vec3f,
    radius: f32,
    low: vec3f,
    root: u32,
    high: vec3f,
    speck: u32,
    first: vec3u,
    few: f32,
    next: vec3u,
    order: u32,
}

@group(0) @binding(0) var<storage, read> views: array<View>;
@group(0) @binding(1) var<storage, read> instances: array<Instance>;
@group(0) @binding(2) var<storage, read> tree: array<Node>;
@group(0) @binding(3) var<storage, read> placed: array<Placed>;
@group(0) @binding(4) var<storage, read> pieces: array<vec4u>;

// The view at hand: where it is among the views, and what a walk asks of it.
var<private> view: u32;
var<private> eye: vec3f;
var<private> limits: vec4f;
var<private> parallel: bool;
// What is still to be looked at, and from where along the ray on: codes of the trees over instances, above them those of a mesh. Here, and not in
// the functions that use them, because there each call would set all of it to zero.
var<private> stack: array<vec2u, 96>;

const NOTHING: u32 = 0xffffffffu;
const IS_LEAF: u32 = 0x80000000u;
const NO_SHADOW: u32 = 0x80000000u;
const FAR_AWAY: f32 = 3.0e38;
const FAR_KEY: u32 = 0x7f000000u;
// Nodes of equal depth may both hold what is seen, where two surfaces lie in one plane.
const TIE: f32 = 1.00001;

struct Found {
    t: f32,
    number: u32,
    // The piece at which the triangle begins.
    triangle: u32,
}

// A ray in the frame of an instance, or of the trees.
struct Ray {
    origin: vec3f,
    direction: vec3f,
    inverse: vec3f,
}

fn ray_of(origin: vec3f, direction: vec3f) -> Ray {
    let least = select(vec3f(-1e-12), vec3f(1e-12), direction >= vec3f(0.0));
    let safe = select(direction, least, abs(direction) < vec3f(1e-12));
    return Ray(origin, direction, 1.0 / safe);
}

// Three coordinates of four boxes.
struct Four {
    x: vec4f,
    y: vec4f,
    z: vec4f,
}

// Where a ray comes into each of four boxes, or FAR_AWAY if it does not before `limit`.
fn enter_four(ray: Ray, low: Four, high: Four, start: f32, limit: f32) -> vec4f {
    let ax = (low.x - ray.origin.x) * ray.inverse.x;
    let bx = (high.x - ray.origin.x) * ray.inverse.x;
    let ay = (low.y - ray.origin.y) * ray.inverse.y;
    let by = (high.y - ray.origin.y) * ray.inverse.y;
    let az = (low.z - ray.origin.z) * ray.inverse.z;
    let bz = (high.z - ray.origin.z) * ray.inverse.z;
    let first = max(max(min(ax, bx), min(ay, by)), max(min(az, bz), vec4f(start)));
    // A little longer, so that rounding loses nothing.
    let last = min(min(max(ax, bx), max(ay, by)), min(max(az, bz), vec4f(limit))) * 1.000001;
    return select(vec4f(FAR_AWAY), first, first <= last);
}

// Whether a ray comes into a box before `limit`.
fn enters(ray: Ray, low: vec3f, high: vec3f, start: f32, limit: f32) -> bool {
    let a = (low - ray.origin) * ray.inverse;
    let b = (high - ray.origin) * ray.inverse;
    let near = min(a, b);
    let far = max(a, b);
    return max(max(near.x, near.y), max(near.z, start)) <= min(min(far.x, far.y), min(far.z, limit)) * 1.000001;
}

fn one_of(four: vec4u, key: u32) -> u32 {
    let pair = select(four.xy, four.zw, (key & 2u) != 0u);
    return select(pair.x, pair.y, (key & 1u) != 0u);
}

// The code of the nearest child that the ray meets, while the others are put aside, the nearest of them on top; NOTHING if it meets none. Depths
// are sorted as whole numbers, whose last two bits say which child it is.
fn descend(entries: vec4f, codes: vec4u, height: ptr<function, u32>) -> u32 {
    let met = select(vec4f(FAR_AWAY), entries, codes != vec4u(NOTHING));
    let keys = (bitcast<vec4u>(met) & vec4u(0xfffffffcu)) | vec4u(0u, 1u, 2u, 3u);
    let a = min(keys.xz, keys.yw);
    let b = max(keys.xz, keys.yw);
    let first = min(a.x, a.y);
    if (first >= FAR_KEY) {
        return NOTHING;
    }
    let last = max(b.x, b.y);
    let second = min(max(a.x, a.y), min(b.x, b.y));
    let third = max(max(a.x, a.y), min(b.x, b.y));
    if (last < FAR_KEY) {
        stack[*height] = vec2u(one_of(codes, last), last);
        *height += 1u;
    }
    if (third < FAR_KEY) {
        stack[*height] = vec2u(one_of(codes, third), third);
        *height += 1u;
    }
    if (second < FAR_KEY) {
        stack[*height] = vec2u(one_of(codes, second), second);
        *height += 1u;
    }
    return one_of(codes, first);
}

// What was put aside last and is not behind what was met since; NOTHING if there is no more of it above `base`.
fn next_of(height: ptr<function, u32>, base: u32, limit: f32) -> u32 {
    while (*height > base) {
        *height -= 1u;
        let top = stack[*height];
        if (bitcast<f32>(top.y & 0xfffffffcu) <= limit) {
            return top.x;
        }
    }
    return NOTHING;
}

fn halves(words: vec2u) -> vec4f {
    return vec4f(unpack2x16float(words.x), unpack2x16float(words.y));
}

// A triangle of a mesh: its first corner and two sides from there, body frame.
struct Triangle {
    a: vec3f,
    ab: vec3f,
    ac: vec3f,
}

fn triangle_at(piece: u32, scale: vec3f, unit: f32) -> Triangle {
    let p = bitcast<vec4f>(pieces[piece]);
    let q = bitcast<vec4f>(pieces[piece + 1u]);
    let r = bitcast<vec4f>(pieces[piece + 2u]);
    let s = bitcast<vec4f>(pieces[piece + 3u]);
    let t = bitcast<vec2f>(pieces[piece + 4u].xy);
    let a = p.xyz * scale + vec3f(p.w, q.xy) * unit;
    let b = vec3f(q.zw, r.x) * scale + r.yzw * unit;
    let c = s.xyz * scale + vec3f(s.w, t) * unit;
    return Triangle(a, b - a, c - a);
}

// Meets the triangles of a leaf from outside.
fn meet_triangles(ray: Ray, code: u32, scale: vec3f, unit: f32, number: u32, start: f32, best: ptr<function, Found>) -> bool {
    let count = ((code >> 28u) & 7u) + 1u;
    let first = code & 0x0fffffffu;
    var met = false;
    for (var k = 0u; k < count; k++) {
        let at = first + k * 5u;
        let one = triangle_at(at, scale, unit);
        let p = cross(ray.direction, one.ac);
        let facing = dot(one.ab, p);
        if (facing <= 0.0) {
            continue;
        }
        let apart = ray.origin - one.a;
        let u = dot(apart, p);
        let q = cross(apart, one.ab);
        let v = dot(ray.direction, q);
        if (u < 0.0 || v < 0.0 || u + v > facing) {
            continue;
        }
        // From the plane: exact also for the large triangles of the ground.
        let normal = cross(one.ab, one.ac);
        let t = -dot(normal, apart) / dot(normal, ray.direction);
        if (t < start) {
            continue;
        }
        let old = *best;
        // Of two in one plane the one that is drawn first in the raster backend is seen.
        let tied = old.number != NOTHING && old.number != number && abs(t - old.t) <= 2e-6 * t;
        var wins = t < old.t;
        if (tied) {
            wins = comes_first(number, old.number);
        }
        if (wins) {
            *best = Found(t, number, at);
            met = true;
        }
    }
    return met;
}

fn comes_first(number: u32, other: u32) -> bool {
    let a = placed[number].order & ~NO_SHADOW;
    let b = placed[other].order & ~NO_SHADOW;
    return a < b || (a == b && (instances[number].who & 0xffffffu) < (instances[other].who & 0xffffffu));
}

fn from_eye(i: u32) -> vec3f {
    // Part by part, so that nothing is lost far from the origin.
    return (instances[i].place.xyz - views[view].globals.eye.xyz) + (instances[i].rest - views[view].globals.eye_rest.xyz);
}

// Meets the mesh of an instance; the origin is relative to the eye.
fn meet_mesh(number: u32, root: u32, origin: vec3f, direction: vec3f, start: f32, shadow: bool, base: u32, best: ptr<function, Found>) -> bool {
    let rotation = instances[number].rotation;
    let inverse = vec4f(-rotation.xyz, rotation.w);
    let ray = ray_of(rotate(inverse, origin - from_eye(number)), rotate(inverse, direction));
    let scale = instances[number].scale.xyz;
    let unit = instances[number].place.w;
    var height = base;
    var code = root;
    var met = false;
    loop {
        while ((code & IS_LEAF) == 0u) {
            let codes = pieces[code];
            let p = pieces[code + 1u];
            let q = pieces[code + 2u];
            let r = pieces[code + 3u];
            let s = pieces[code + 4u];
            let t = pieces[code + 5u];
            let u = pieces[code + 6u];
            var low = Four(halves(p.xy) * scale.x + halves(s.xy) * unit, halves(p.zw) * scale.y + halves(s.zw) * unit, halves(q.xy) * scale.z + halves(t.xy) * unit);
            var high = Four(halves(q.zw) * scale.x + halves(t.zw) * unit, halves(r.xy) * scale.y + halves(u.xy) * unit, halves(r.zw) * scale.z + halves(u.zw) * unit);
            // Flat boxes have some thickness, so that rounding loses nothing.
            let thick = Four(1e-5 * (abs(low.x) + abs(high.x)) + 1e-6, 1e-5 * (abs(low.y) + abs(high.y)) + 1e-6, 1e-5 * (abs(low.z) + abs(high.z)) + 1e-6);
            low = Four(low.x - thick.x, low.y - thick.y, low.z - thick.z);
            high = Four(high.x + thick.x, high.y + thick.y, high.z + thick.z);
            let entries = enter_four(ray, low, high, start * 0.999, (*best).t * TIE);
            code = descend(entries, codes, &height);
            if (code == NOTHING) {
                code = next_of(&height, base, (*best).t * TIE);
            }
        }
        if (code == NOTHING) {
            break;
        }
        met = meet_triangles(ray, code, scale, unit, number, start, best) || met;
        if (met && shadow) {
            break;
        }
        code = next_of(&height, base, (*best).t * TIE);
    }
    return met;
}

// At which level of detail an entity is seen in a ball that is so many pixels across, as `Detail::of` in look/mod.rs decides.
fn level_of(radius: f32, pixels: f32) -> u32 {
    let size = pixels * select(1.0, 0.3, radius > 8.5);
    return select(select(2u, 1u, size < 80.0), 0u, size < 28.0);
}

// Whether the picture shows somebody of whom a ball of so many pixels is so far away, as the raster backend decides.
fn is_shown(number: u32, distance: f32, radius: f32, pixels: f32) -> bool {
    let hidden = views[view].hidden;
    if (hidden.x != NOTHING || hidden.z != 0u) {
        let slot = instances[number].who & 0xffffffu;
        if (slot == hidden.x || (hidden.z != 0u && slot != hidden.z)) {
            return false;
        }
    }
    return distance - radius <= limits.x && pixels >= limits.y;
}

// Meets the instances of a leaf, those of the level at which they are seen from the eye; shadows are thrown by the same.
fn meet_leaf(leader: u32, world: Ray, origin: vec3f, start: f32, shadow: bool, base: u32, best: ptr<function, Found>) -> bool {
    let distance = length(placed[leader].center - eye);
    let radius = placed[leader].radius;
    let pixels = 2.0 * radius * limits.z / select(max(max(distance, radius), 1e-9), 1.0, parallel);
    var counts = (placed[leader].order & NO_SHADOW) == 0u;
    if (!shadow) {
        counts = is_shown(leader, distance, radius, pixels);
    }
    if (!counts) {
        return false;
    }
    let finest = limits.w != 0.0;
    let level = select(level_of(radius, pixels), 2u, finest);
    var number = placed[leader].first[level];
    var met = false;
    while (number != NOTHING) {
        if (enters(world, placed[number].low, placed[number].high, start * 0.999, (*best).t * TIE)) {
            let root = select(placed[number].root, placed[number].speck, pixels < placed[number].few && !finest);
            met = meet_mesh(number, root, origin, world.direction, start, shadow, base, best) || met;
            if (met && shadow) {
                break;
            }
        }
        number = placed[number].next[level];
    }
    return met;
}

// The first thing on a ray, or anything that throws a shadow.
fn trace(origin: vec3f, direction: vec3f, start: f32, shadow: bool) -> Found {
    var best = Found(FAR_AWAY * 0.1, NOTHING, 0u);
    let ray = ray_of(eye + origin, direction);
    stack[0] = vec2u(views[view].hidden.y, 0u);
    var height = 1u;
    var code = 0u;
    loop {
        while ((code & IS_LEAF) == 0u) {
            let low = Four(tree[code].low_x, tree[code].low_y, tree[code].low_z);
            let high = Four(tree[code].high_x, tree[code].high_y, tree[code].high_z);
            let entries = enter_four(ray, low, high, start * 0.999, best.t * TIE);
            code = descend(entries, tree[code].codes, &height);
            if (code == NOTHING) {
                code = next_of(&height, 0u, best.t * TIE);
            }
        }
        if (code == NOTHING) {
            break;
        }
        if (meet_leaf(code & ~IS_LEAF, ray, origin, start, shadow, height, &best) && shadow) {
            break;
        }
        code = next_of(&height, 0u, best.t * TIE);
    }
    return best;
}

// Makes a view the one at hand.
fn look(index: u32) {
    view = index;
    eye = views[index].eye.xyz;
    limits = views[index].limits;
    parallel = views[index].hidden.w == 1u;
}
