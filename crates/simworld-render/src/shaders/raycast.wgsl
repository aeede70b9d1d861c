// The ray-cast backend: two levels of trees of boxes, shading as in the raster backend. A ray's direction has planar depth one, so
// the parameter along a view ray is the planar depth.
struct View {
    globals: Globals,
    // The eye from the origin of the trees; w: near.
    eye: vec4f,
    // far, min_pixels, the longer focal length in pixels.
    limits: vec4f,
    // First pixel, pitch, width, height.
    span: vec4u,
    // Slot plus one of who is hidden; the root of the tree of what moves; slot plus one of who alone is seen, or 0; 1 if rays are
    // parallel.
    hidden: vec4u,
}

struct Node {
    low: vec3f,
    child: u32,
    high: vec3f,
    other: u32,
    other_low: vec3f,
    pad: u32,
    other_high: vec3f,
    pad_too: u32,
}

struct Placed {
    center: vec3f,
    radius: f32,
    root: u32,
    pattern: u32,
    order: u32,
    casts: u32,
}

@group(0) @binding(0) var<storage, read> views: array<View>;
@group(0) @binding(1) var<storage, read> instances: array<Instance>;
@group(0) @binding(2) var<storage, read> tree: array<Node>;
@group(0) @binding(3) var<storage, read> placed: array<Placed>;
@group(0) @binding(4) var<storage, read> pieces: array<vec4u>;
@group(0) @binding(5) var<storage, read_write> out_color: array<u32>;
@group(0) @binding(6) var<storage, read_write> out_depth: array<f32>;
@group(0) @binding(7) var<storage, read_write> out_who: array<u32>;
@group(0) @binding(8) var<storage, read> lights: array<vec4f>;

fn sky_node(index: u32) -> vec4f {
    return lights[index];
}

var<private> globals: Globals;
var<private> eye: vec3f;
var<private> limits: vec4f;
var<private> hidden: u32;
var<private> second: u32;
var<private> only: u32;
var<private> parallel: bool;
// What is still to be looked at, in the tree of a mesh and in those of instances: here, and not in the functions that use them,
// because there each call would set all of it to zero.
var<private> mesh_stack: array<u32, 28>;
var<private> tree_stack: array<u32, 36>;

const NOTHING: u32 = 0xffffffffu;
const IS_LEAF: u32 = 0x80000000u;
const FAR_AWAY: f32 = 3.0e38;

struct Found {
    t: f32,
    number: u32,
    // The piece at which the triangle begins.
    triangle: u32,
    u: f32,
    v: f32,
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

// Where a ray comes into a box, or FAR_AWAY if it does not before `limit`.
fn enter(ray: Ray, low: vec3f, high: vec3f, start: f32, limit: f32) -> f32 {
    let a = (low - ray.origin) * ray.inverse;
    let b = (high - ray.origin) * ray.inverse;
    let near = min(a, b);
    let far = max(a, b);
    let first = max(max(near.x, near.y), max(near.z, start));
    // A little longer, so that rounding loses nothing.
    let last = min(min(far.x, far.y), min(far.z, limit)) * 1.000001;
    return select(FAR_AWAY, first, first <= last);
}

fn f32s(piece: u32) -> vec3f {
    return bitcast<vec3f>(pieces[piece].xyz);
}

// A corner of a triangle in the body frame.
fn corner_of(piece: u32, scale: vec3f, unit: f32) -> vec3f {
    return f32s(piece) * scale + f32s(piece + 1u) * unit;
}

// Meets the triangles of a leaf from outside.
fn meet_leaf(ray: Ray, code: u32, scale: vec3f, unit: f32, number: u32, start: f32, best: ptr<function, Found>) -> bool {
    let count = ((code >> 28u) & 7u) + 1u;
    let first = code & 0x0fffffffu;
    var met = false;
    for (var k = 0u; k < count; k++) {
        let at = first + k * 9u;
        let a = corner_of(at, scale, unit);
        let ab = corner_of(at + 2u, scale, unit) - a;
        let ac = corner_of(at + 4u, scale, unit) - a;
        let p = cross(ray.direction, ac);
        let facing = dot(ab, p);
        if (facing <= 0.0) {
            continue;
        }
        let apart = ray.origin - a;
        let u = dot(apart, p);
        let q = cross(apart, ab);
        let v = dot(ray.direction, q);
        if (u < 0.0 || v < 0.0 || u + v > facing) {
            continue;
        }
        // From the plane: exact also for the large triangles of the ground.
        let normal = cross(ab, ac);
        let t = -dot(normal, apart) / dot(normal, ray.direction);
        if (t < start) {
            continue;
        }
        let old = *best;
        // Of two in one plane the one that is drawn first in the raster backend is seen.
        let tied = old.number != NOTHING && old.number != number && abs(t - old.t) <= 2e-6 * t;
        let wins = select(t < old.t, comes_first(number, old.number), tied);
        if (wins) {
            *best = Found(t, number, at, u / facing, v / facing);
            met = true;
        }
    }
    return met;
}

fn comes_first(number: u32, other: u32) -> bool {
    let a = placed[number].order;
    let b = placed[other].order;
    return a < b || (a == b && (instances[number].who & 0xffffffu) < (instances[other].who & 0xffffffu));
}

fn from_eye(i: u32) -> vec3f {
    // Part by part, so that nothing is lost far from the origin.
    return (instances[i].place.xyz - globals.eye.xyz) + (instances[i].rest - globals.eye_rest.xyz);
}

// Meets one instance; the origin is relative to the eye.
fn meet_instance(number: u32, origin: vec3f, direction: vec3f, start: f32, shadow: bool, best: ptr<function, Found>) -> bool {
    let rotation = instances[number].rotation;
    let inverse = vec4f(-rotation.xyz, rotation.w);
    let ray = ray_of(rotate(inverse, origin - from_eye(number)), rotate(inverse, direction));
    let scale = instances[number].scale.xyz;
    let unit = instances[number].place.w;
    var height = 0;
    var node = placed[number].root;
    var met = false;
    loop {
        var entries = vec2f(FAR_AWAY);
        var codes = vec2u(NOTHING);
        for (var side = 0u; side < 2u; side++) {
            let at = node + side * 4u;
            let head = pieces[at];
            if (head.w == NOTHING) {
                continue;
            }
            let low = bitcast<vec3f>(head.xyz) * scale + f32s(at + 2u) * unit;
            let high = f32s(at + 1u) * scale + f32s(at + 3u) * unit;
            // Flat boxes have some thickness, so that rounding loses nothing.
            let thick = 1e-5 * (abs(low) + abs(high)) + 1e-6;
            let entry = enter(ray, low - thick, high + thick, start * 0.999, (*best).t);
            if (entry == FAR_AWAY) {
                continue;
            }
            if ((head.w & IS_LEAF) != 0u) {
                met = meet_leaf(ray, head.w, scale, unit, number, start, best) || met;
                if (met && shadow) {
                    return true;
                }
            } else {
                entries[side] = entry;
                codes[side] = head.w;
            }
        }
        let swap = entries.y < entries.x;
        let near = select(codes.x, codes.y, swap);
        let far = select(codes.y, codes.x, swap);
        if (near != NOTHING) {
            if (far != NOTHING && height < 28) {
                mesh_stack[height] = far;
                height++;
            }
            node = near;
        } else if (height > 0) {
            height--;
            node = mesh_stack[height];
        } else {
            break;
        }
    }
    return met;
}

// Whether the picture shows it at all, as the raster backend decides.
fn is_shown(number: u32) -> bool {
    let slot = instances[number].who & 0xffffffu;
    if (slot == hidden || (only != 0u && slot != only)) {
        return false;
    }
    let distance = length(placed[number].center - eye);
    let radius = placed[number].radius;
    let pixels = 2.0 * radius * limits.z / select(max(max(distance, radius), 1e-9), 1.0, parallel);
    return distance - radius <= limits.x && pixels >= limits.y;
}

// The first thing on a ray, or anything that throws a shadow.
fn trace(origin: vec3f, direction: vec3f, start: f32, shadow: bool) -> Found {
    var best = Found(FAR_AWAY * 0.1, NOTHING, 0u, 0.0, 0.0);
    let ray = ray_of(eye + origin, direction);
    var height = 1;
    tree_stack[0] = second;
    var node = 0u;
    loop {
        let n = tree[node];
        let codes = vec2u(n.child, n.other);
        var entries = vec2f(FAR_AWAY);
        if (n.child != NOTHING) {
            entries.x = enter(ray, n.low, n.high, start * 0.999, best.t);
        }
        if (n.other != NOTHING) {
            entries.y = enter(ray, n.other_low, n.other_high, start * 0.999, best.t);
        }
        let swap = u32(entries.y < entries.x);
        var next = NOTHING;
        for (var k = 0u; k < 2u; k++) {
            let side = k ^ swap;
            if (entries[side] == FAR_AWAY || entries[side] > best.t * 1.00001) {
                continue;
            }
            let code = codes[side];
            if ((code & IS_LEAF) == 0u) {
                if (next == NOTHING) {
                    next = code;
                } else if (height < 36) {
                    tree_stack[height] = code;
                    height++;
                }
                continue;
            }
            let number = code & 0x7fffffffu;
            var counts = placed[number].casts != 0u;
            if (!shadow) {
                counts = is_shown(number);
            }
            if (counts && meet_instance(number, origin, direction, start, shadow, &best) && shadow) {
                return best;
            }
        }
        if (next != NOTHING) {
            node = next;
        } else if (height > 0) {
            height--;
            node = tree_stack[height];
        } else {
            break;
        }
    }
    return best;
}

// The share of the sun that reaches a point: a ray decides.
fn sunlit(relative: vec3f, normal: vec3f) -> f32 {
    if (globals.bounce.w == 0.0) {
        return 1.0;
    }
    let lift = 0.005 + 2e-4 * length(relative);
    let start = relative + normal * lift;
    return select(0.0, 1.0, trace(start, globals.sun_direction.xyz, 1e-3, true).number == NOTHING);
}

// The normals at the corners of a triangle, body frame.
fn corner_normals(triangle: u32, scale: vec3f) -> mat3x3f {
    let a = f32s(triangle + 6u);
    let b = f32s(triangle + 7u);
    let c = f32s(triangle + 8u);
    if (is_model(pieces[triangle].w)) {
        return mat3x3f(normalize(a / scale), normalize(b / scale), normalize(c / scale));
    }
    return mat3x3f(a, b, c);
}

// The normal where a ray met a triangle, world axes.
fn normal_of(found: Found, normals: mat3x3f) -> vec3f {
    let mean = normals * vec3f(1.0 - found.u - found.v, found.u, found.v);
    return normalize(rotate(instances[found.number].rotation, mean));
}

fn hit_of(found: Found, origin: vec3f, direction: vec3f) -> Hit {
    let i = instances[found.number];
    let inverse = vec4f(-i.rotation.xyz, i.rotation.w);
    let scale = i.scale.xyz;
    let unit = i.place.w;
    let relative = origin + direction * found.t;
    let body = rotate(inverse, relative - from_eye(found.number));
    let material = pieces[found.triangle].w;
    let normals = corner_normals(found.triangle, scale);
    let corner = corner_of(found.triangle, scale, unit);
    let plane = cross(corner_of(found.triangle + 2u, scale, unit) - corner, corner_of(found.triangle + 4u, scale, unit) - corner);
    let depth = max(dot(relative, globals.forward.xyz), 1e-6);
    let ray = select(relative / depth, direction, parallel);
    let footprint = footprint_of(ray, select(depth, 1.0, parallel), rotate(i.rotation, normalize(plane)), i.rotation);
    let finish = finish_of(material, i.color, i.second, i.scale.w);
    let extra = vec2f(i.color.w, i.second.w);
    return Hit(relative, normal_of(found, normals), body, normals[0], finish, i.scale, extra, f32(material != 0u), placed[found.number].pattern, footprint);
}

fn encoded(color: vec3f) -> u32 {
    let c = saturate(color);
    let curve = 1.055 * pow(c, vec3f(1.0 / 2.4)) - 0.055;
    return pack4x8unorm(vec4f(select(curve, 12.92 * c, c <= vec3f(0.0031308)), 1.0));
}

// Whether colour is wanted.
override SHADED: bool = true;
// Without colour: whether normals are wanted where colour would be.
override FACING: bool = false;
// Without colour: whether the rays are those of a table, which lies where lights would be. Its rays have length one in the
// optical frame, so that what is depth elsewhere is a range.
override TABLE: bool = false;

@compute @workgroup_size(8, 8)
fn cast_views(@builtin(global_invocation_id) at: vec3u) {
    let span = views[at.z].span;
    if (at.x >= span.z || at.y >= span.w) {
        return;
    }
    globals = views[at.z].globals;
    eye = views[at.z].eye.xyz;
    limits = views[at.z].limits;
    hidden = views[at.z].hidden.x;
    second = views[at.z].hidden.y;
    only = views[at.z].hidden.z;
    parallel = views[at.z].hidden.w == 1u;
    let k = globals.intrinsics;
    var optical = vec3f((f32(at.x) + 0.5 - k.z) / k.x, (f32(at.y) + 0.5 - k.w) / k.y, 1.0);
    if (TABLE) {
        optical = lights[at.y * span.z + at.x].xyz;
    }
    let aside = optical.x * globals.right.xyz + optical.y * globals.down.xyz;
    let sight = optical.z * globals.forward.xyz + aside;
    let origin = select(vec3f(0.0), aside, parallel);
    let direction = select(sight, globals.forward.xyz, parallel);
    let found = trace(origin, direction, views[at.z].eye.w, false);
    let pixel = span.x + at.y * span.y + at.x;
    // Parallel rays end at the far plane, as clip space does there.
    if (found.number == NOTHING || (parallel && found.t > limits.x)) {
        out_who[pixel] = 0u;
        out_depth[pixel] = 0.0;
        if (SHADED) {
            out_color[pixel] = encoded(tone_map(sky_with_clouds(normalize(sight))));
        } else if (FACING) {
            out_color[pixel] = 0u;
        }
        return;
    }
    out_who[pixel] = instances[found.number].who;
    out_depth[pixel] = found.t;
    if (SHADED) {
        out_color[pixel] = encoded(shade(hit_of(found, origin, direction)));
    } else if (FACING) {
        let scale = instances[found.number].scale.xyz;
        out_color[pixel] = packed_normal(normal_of(found, corner_normals(found.triangle, scale)));
    }
}
