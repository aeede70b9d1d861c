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
    // How many drops or flakes fall before the eye.
    falling: vec4u,
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
// Nodes of seven: the codes of four children, then the least x, y and z of their boxes, then the greatest.
@group(0) @binding(2) var<storage, read> tree: array<vec4f>;
@group(0) @binding(3) var<storage, read> placed: array<Placed>;
@group(0) @binding(4) var<storage, read> pieces: array<vec4u>;

// The view at hand: where it is among the views, and what a walk asks of it.
var<private> view: u32;
var<private> eye: vec3f;
var<private> limits: vec4f;
var<private> parallel: bool;
// What a walk put aside, one entry a level: a node with those of its children that are still to be looked at, nearest first, and how far away each of them begins.
// As few as the trees may have levels (of one over instances, then of one in a mesh; see bodies.rs and shape.rs), since all of it is set to zero at the start of each ray, which
// takes longer than it looks; and not in the memory of the workgroup, which leaves room for fewer rays at a time.
const LEVELS: u32 = 24u;
var<private> aside: array<vec2u, LEVELS>;
// The same of a walk that looks for anything: a node, and below it a bit for each child.
var<private> open: array<u32, LEVELS>;

const NOTHING: u32 = 0xffffffffu;
// In the last word of a triangle: where its normals are, whether its part is cut out or blended, and whether it is blended.
const ADDRESS: u32 = 0x03ffffffu;
const IS_FILM: u32 = 0x04000000u;
const IS_CUT: u32 = 0x08000000u;
const IS_LEAF: u32 = 0x80000000u;
const NO_SHADOW: u32 = 0x80000000u;
const FAR_AWAY: f32 = 3.0e38;
const FAR_KEY: u32 = 0x7f000000u;
// Of what is blended, which triangles view rays meet, a `Films` of raycast/mod.rs: those that count as of what is cut out, none; and of that alone those that
// count, and those that are thinner.
override FILMS: u32 = 0u;
const WITHOUT_FILMS: u32 = 1u;
const COUNTED_FILMS: u32 = 2u;
const THIN_FILMS: u32 = 3u;
// Nodes of equal depth may both hold what is seen, where two surfaces lie in one plane.
const TIE: f32 = 1.00001;

struct Found {
    t: f32,
    number: u32,
    // The piece at which the triangle begins.
    triangle: u32,
}

// A ray in the frame of an instance, or of the trees. At a coordinate it is `coordinate * inverse + shift` along itself; `back` says along which
// axes it meets the greater side of a box first.
struct Ray {
    origin: vec3f,
    direction: vec3f,
    inverse: vec3f,
    shift: vec3f,
    back: vec3<bool>,
}

fn ray_of(origin: vec3f, direction: vec3f) -> Ray {
    let least = select(vec3f(-1e-12), vec3f(1e-12), direction >= vec3f(0.0));
    let safe = select(direction, least, abs(direction) < vec3f(1e-12));
    let inverse = 1.0 / safe;
    return Ray(origin, direction, inverse, -origin * inverse, inverse < vec3f(0.0));
}

// Where a ray is at the nearer and at the farther sides of four boxes.
struct Sides {
    near_x: vec4f,
    near_y: vec4f,
    near_z: vec4f,
    far_x: vec4f,
    far_y: vec4f,
    far_z: vec4f,
}

// Where a ray comes into each of four boxes, or FAR_AWAY if it does not before `limit`; empty boxes are inside out, and never come into.
fn enter_four(sides: Sides, start: f32, limit: f32) -> vec4f {
    let first = max(max(sides.near_x, sides.near_y), max(sides.near_z, vec4f(start)));
    // A little longer, so that rounding loses nothing.
    let last = min(min(sides.far_x, sides.far_y), min(sides.far_z, vec4f(limit))) * 1.000001;
    return select(vec4f(FAR_AWAY), first, first <= last);
}

// Whether a ray comes into a box before `limit`.
fn enters(ray: Ray, low: vec3f, high: vec3f, start: f32, limit: f32) -> bool {
    let a = fma(low, ray.inverse, ray.shift);
    let b = fma(high, ray.inverse, ray.shift);
    let near = min(a, b);
    let far = max(a, b);
    return max(max(near.x, near.y), max(near.z, start)) <= min(min(far.x, far.y), min(far.z, limit)) * 1.000001;
}

// Where a ray is at four coordinates along an axis.
fn along(sides: vec4f, inverse: f32, shift: f32) -> vec4f {
    return fma(sides, vec4f(inverse), vec4f(shift));
}

// The sides of the children of a node over instances.
fn sides_in_tree(ray: Ray, at: u32) -> Sides {
    let x = select(1u, 4u, ray.back.x);
    let y = select(2u, 5u, ray.back.y);
    let z = select(3u, 6u, ray.back.z);
    return Sides(
        along(tree[at + x], ray.inverse.x, ray.shift.x),
        along(tree[at + y], ray.inverse.y, ray.shift.y),
        along(tree[at + z], ray.inverse.z, ray.shift.z),
        along(tree[at + 5u - x], ray.inverse.x, ray.shift.x),
        along(tree[at + 7u - y], ray.inverse.y, ray.shift.y),
        along(tree[at + 9u - z], ray.inverse.z, ray.shift.z),
    );
}

fn halves(words: vec2u) -> vec4f {
    return vec4f(unpack2x16float(words.x), unpack2x16float(words.y));
}

// Where a ray is at four sides in a mesh along an axis, of which anchors and offsets are known.
fn along_both(anchors: vec2u, offsets: vec2u, by_anchor: f32, by_offset: f32, shift: f32) -> vec4f {
    return fma(halves(anchors), vec4f(by_anchor), fma(halves(offsets), vec4f(by_offset), vec4f(shift)));
}

// The sides of the children of a node in a mesh of that scale and unit of offsets.
fn sides_in_mesh(ray: Ray, scale: vec3f, unit: f32, node: u32) -> Sides {
    let p = pieces[node + 1u];
    let q = pieces[node + 2u];
    let r = pieces[node + 3u];
    let s = pieces[node + 4u];
    let t = pieces[node + 5u];
    let u = pieces[node + 6u];
    let a = scale * ray.inverse;
    let o = unit * ray.inverse;
    let x = ray.back.x;
    let y = ray.back.y;
    let z = ray.back.z;
    return Sides(
        along_both(select(p.xy, q.zw, x), select(s.xy, t.zw, x), a.x, o.x, ray.shift.x),
        along_both(select(p.zw, r.xy, y), select(s.zw, u.xy, y), a.y, o.y, ray.shift.y),
        along_both(select(q.xy, r.zw, z), select(t.xy, u.zw, z), a.z, o.z, ray.shift.z),
        along_both(select(q.zw, p.xy, x), select(t.zw, s.xy, x), a.x, o.x, ray.shift.x),
        along_both(select(r.xy, p.zw, y), select(u.xy, s.zw, y), a.y, o.y, ray.shift.y),
        along_both(select(r.zw, q.xy, z), select(u.zw, t.xy, z), a.z, o.z, ray.shift.z),
    );
}

fn one_of(four: vec4u, key: u32) -> u32 {
    let pair = select(four.xy, four.zw, (key & 2u) != 0u);
    return select(pair.x, pair.y, (key & 1u) != 0u);
}

// The code of a child, which is told as four times its node plus which of its children it is.
fn code_in_tree(child: u32) -> u32 {
    return bitcast<u32>(tree[(child >> 2u) * 7u][child & 3u]);
}

fn code_in_mesh(child: u32) -> u32 {
    return pieces[child >> 2u][child & 3u];
}

// A depth in ten bits, rounded down: five of its exponent, from 1/128 m on, and five behind it.
fn coarse(depth: u32) -> u32 {
    return clamp(depth >> 18u, 3840u, 4863u) - 3840u;
}

// The code of the nearest child that the ray comes into, while the others are put aside; NOTHING if it comes into none. Depths are sorted as whole
// numbers, whose last two bits say which child it is.
fn descend(node: u32, entries: vec4f, codes: vec4u, height: ptr<function, u32>) -> u32 {
    let keys = (bitcast<vec4u>(entries) & vec4u(0xfffffffcu)) | vec4u(0u, 1u, 2u, 3u);
    let a = min(keys.xz, keys.yw);
    let b = max(keys.xz, keys.yw);
    let first = min(a.x, a.y);
    if (first >= FAR_KEY) {
        return NOTHING;
    }
    let last = max(b.x, b.y);
    let second = min(max(a.x, a.y), min(b.x, b.y));
    let third = max(max(a.x, a.y), min(b.x, b.y));
    if (second < FAR_KEY) {
        // What is not met stands there as what is before it.
        let y = select(second, third, third < FAR_KEY);
        let z = select(y, last, last < FAR_KEY);
        let children = (z & 3u) << 4u | (y & 3u) << 2u | (second & 3u);
        aside[*height] = vec2u(node << 6u | children, coarse(z) << 20u | coarse(y) << 10u | coarse(second));
        *height += 1u;
    }
    return one_of(codes, first);
}

// The nearest child of the node that was put aside last, if it is not behind what was met since; NOTHING if there is no more above `base`.
fn next_of(height: ptr<function, u32>, base: u32, limit: f32) -> u32 {
    let bound = coarse(bitcast<u32>(limit));
    while (*height > base) {
        let entry = aside[*height - 1u];
        if ((entry.y & 1023u) > bound) {
            // Those behind it begin no nearer.
            *height -= 1u;
            continue;
        }
        if (((entry.x >> 2u) & 3u) == (entry.x & 3u)) {
            *height -= 1u;
        } else {
            aside[*height - 1u] = vec2u((entry.x & 0xfffffff0u) | ((entry.x >> 2u) & 15u), entry.y >> 10u);
        }
        return (entry.x >> 6u) << 2u | (entry.x & 3u);
    }
    return NOTHING;
}

fn next_in_tree(height: ptr<function, u32>, limit: f32) -> u32 {
    let next = next_of(height, 0u, limit);
    if (next == NOTHING) {
        return NOTHING;
    }
    return code_in_tree(next);
}

fn next_in_mesh(height: ptr<function, u32>, base: u32, limit: f32) -> u32 {
    let next = next_of(height, base, limit);
    if (next == NOTHING) {
        return NOTHING;
    }
    return code_in_mesh(next);
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

// Where a ray meets a triangle from outside; less than 0 if it does not.
fn meet_triangle(ray: Ray, one: Triangle) -> f32 {
    let p = cross(ray.direction, one.ac);
    let facing = dot(one.ab, p);
    if (facing <= 0.0) {
        return -1.0;
    }
    let apart = ray.origin - one.a;
    let u = dot(apart, p);
    let q = cross(apart, one.ab);
    let v = dot(ray.direction, q);
    if (u < 0.0 || v < 0.0 || u + v > facing) {
        return -1.0;
    }
    // From the plane: exact also for the large triangles of the ground.
    let normal = cross(one.ab, one.ac);
    return -dot(normal, apart) / dot(normal, ray.direction);
}

// How many triangles a leaf has, and the piece at which the first of them begins.
fn triangles_of(code: u32) -> vec2u {
    return vec2u(((code >> 28u) & 7u) + 1u, code & 0x0fffffffu);
}

// Meets the triangles of a leaf.
fn meet_triangles(ray: Ray, code: u32, scale: vec3f, unit: f32, number: u32, start: f32, best: ptr<function, Found>) {
    let run = triangles_of(code);
    for (var k = 0u; k < run.x; k++) {
        let at = run.y + k * 5u;
        let one = triangle_at(at, scale, unit);
        let t = meet_triangle(ray, one);
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
        if ((FEATURES & WITH_CUTS) != 0u && wins) {
            wins = is_there(ray, t, one, at, number);
        }
        if (wins) {
            *best = Found(t, number, at);
        }
    }
}

// Whether a ray meets anything where it meets a triangle.
fn is_there(ray: Ray, t: f32, one: Triangle, triangle: u32, number: u32) -> bool {
    let last = pieces[triangle + 4u].w;
    let is_film = (last & IS_FILM) != 0u;
    if ((FILMS == WITHOUT_FILMS && is_film) || (FILMS >= COUNTED_FILMS && !is_film)) {
        return false;
    }
    return (last & IS_CUT) == 0u || !looks_through(ray, t, one, triangle, number);
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

// A ray of the trees, relative to the eye, in the body frame of an instance.
fn body_ray(number: u32, origin: vec3f, direction: vec3f) -> Ray {
    let rotation = instances[number].rotation;
    let inverse = vec4f(-rotation.xyz, rotation.w);
    return ray_of(rotate(inverse, origin - from_eye(number)), rotate(inverse, direction));
}

// Meets the mesh of an instance; the origin is relative to the eye.
fn meet_mesh(number: u32, root: u32, origin: vec3f, direction: vec3f, start: f32, base: u32, best: ptr<function, Found>) {
    let ray = body_ray(number, origin, direction);
    let scale = instances[number].scale.xyz;
    let unit = instances[number].place.w;
    var height = base;
    var code = root;
    loop {
        while ((code & IS_LEAF) == 0u) {
            let entries = enter_four(sides_in_mesh(ray, scale, unit, code), start * 0.999, (*best).t * TIE);
            code = descend(code, entries, pieces[code], &height);
            if (code == NOTHING) {
                code = next_in_mesh(&height, base, (*best).t * TIE);
            }
        }
        if (code == NOTHING) {
            break;
        }
        meet_triangles(ray, code, scale, unit, number, start, best);
        code = next_in_mesh(&height, base, (*best).t * TIE);
    }
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

// How far away the entity of a leaf is, and how many pixels the ball around it is across.
struct Sighting {
    distance: f32,
    radius: f32,
    pixels: f32,
}

fn sighting_of(leader: u32) -> Sighting {
    let distance = length(placed[leader].center - eye);
    let radius = placed[leader].radius;
    let pixels = 2.0 * radius * limits.z / select(max(max(distance, radius), 1e-9), 1.0, parallel);
    return Sighting(distance, radius, pixels);
}

// The level of detail of a leaf.
fn level_in(sighting: Sighting) -> u32 {
    return select(level_of(sighting.radius, sighting.pixels), 2u, limits.w != 0.0);
}

// The root of the mesh of an instance.
fn root_of(number: u32, sighting: Sighting) -> u32 {
    return select(placed[number].root, placed[number].speck, sighting.pixels < placed[number].few && limits.w == 0.0);
}

// Meets the instances of a leaf, those of the level at which they are seen from the eye.
fn meet_leaf(leader: u32, world: Ray, origin: vec3f, start: f32, base: u32, best: ptr<function, Found>) {
    let sighting = sighting_of(leader);
    if (!is_shown(leader, sighting.distance, sighting.radius, sighting.pixels)) {
        return;
    }
    let level = level_in(sighting);
    var number = placed[leader].first[level];
    while (number != NOTHING) {
        if (enters(world, placed[number].low, placed[number].high, start * 0.999, (*best).t * TIE)) {
            meet_mesh(number, root_of(number, sighting), origin, world.direction, start, base, best);
        }
        number = placed[number].next[level];
    }
}

// The first thing on a ray before `limit`; the tree of what moves comes behind that of what stands.
fn trace(origin: vec3f, direction: vec3f, start: f32, limit: f32) -> Found {
    var best = Found(limit, NOTHING, 0u);
    let ray = ray_of(eye + origin, direction);
    var rest = views[view].hidden.y;
    var height = 0u;
    var code = 0u;
    loop {
        while ((code & IS_LEAF) == 0u) {
            let at = code * 7u;
            let entries = enter_four(sides_in_tree(ray, at), start * 0.999, best.t * TIE);
            code = descend(code, entries, bitcast<vec4u>(tree[at]), &height);
            if (code == NOTHING) {
                code = next_in_tree(&height, best.t * TIE);
            }
        }
        if (code != NOTHING) {
            meet_leaf(code & ~IS_LEAF, ray, origin, start, height, &best);
            code = next_in_tree(&height, best.t * TIE);
        }
        if (code == NOTHING) {
            if (rest == NOTHING) {
                break;
            }
            code = rest;
            rest = NOTHING;
        }
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
