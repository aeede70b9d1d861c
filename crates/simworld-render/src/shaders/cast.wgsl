// The ray-cast backend, in three steps: `find` what each view ray meets, `light` it by a ray towards the sun, `paint` it or `measure` it. A step knows no more than it
// needs, so that many of its rays are under way at once. Between the steps the planes of colour, depth and ids hold the triangle that was met, its
// depth, and its instance.
@group(0) @binding(5) var<storage, read_write> out_color: array<u32>;
@group(0) @binding(6) var<storage, read_write> out_depth: array<f32>;
@group(0) @binding(7) var<storage, read_write> out_who: array<u32>;
@group(0) @binding(8) var<storage, read> lights: array<vec4f>;
@group(0) @binding(9) var<storage, read_write> out_normals: array<u32>;
// Directions of length one in the optical frame, where rays are those of a table: what is depth elsewhere is a range.
@group(0) @binding(10) var<storage, read> table: array<vec4f>;

var<private> globals: Globals;
// Whether the sun reaches the point at hand, and how much is there.
var<private> lit: f32;
var<private> there: f32;

// Stands beside a triangle that the sun reaches.
const LIT: u32 = 0x80000000u;
// Whether rays are those of a table.
override TABLE: bool = false;
// Whether normals are measured.
override FACING: bool = false;

fn sky_node(index: u32) -> vec4f {
    return lights[index];
}

fn sunlit(relative: vec3f, normal: vec3f) -> f32 {
    return lit;
}

// A view ray, from where its projection begins; and where it looks, which parallel rays do not tell.
struct Sight {
    origin: vec3f,
    direction: vec3f,
    ahead: vec3f,
}

// The place of a ray in the planes; `NOTHING` beyond its view.
fn pixel_of(at: vec3u) -> u32 {
    let span = views[at.z].span;
    return select(span.x + at.y * span.y + at.x, NOTHING, at.x >= span.z || at.y >= span.w);
}

// In the optical frame, of planar depth one.
fn optical_ray(at: vec2u) -> vec3f {
    let k = views[view].globals.intrinsics;
    return vec3f((f32(at.x) + 0.5 - k.z) / k.x, (f32(at.y) + 0.5 - k.w) / k.y, 1.0);
}

fn sight_of(at: vec2u) -> Sight {
    var optical = optical_ray(at);
    if (TABLE) {
        optical = table[at.y * views[view].span.z + at.x].xyz;
    }
    return sight_along(optical);
}

fn sight_along(optical: vec3f) -> Sight {
    let aside = optical.x * views[view].globals.right.xyz + optical.y * views[view].globals.down.xyz;
    let forward = views[view].globals.forward.xyz;
    let ahead = optical.z * forward + aside;
    return Sight(select(vec3f(0.0), aside, parallel), select(ahead, forward, parallel), ahead);
}

// A triangle that was met, at a point.
struct Met {
    // From the eye, world axes.
    relative: vec3f,
    // In the body frame.
    body: vec3f,
    // Of the corners, body frame.
    normals: mat3x3f,
    // Of the surface there, world axes: of the triangle as it is drawn, and as it is smoothed.
    flat_normal: vec3f,
    normal: vec3f,
    material: u32,
    pattern: u32,
}

fn met_at(number: u32, triangle: u32, relative: vec3f) -> Met {
    let rotation = instances[number].rotation;
    let scale = instances[number].scale.xyz;
    let body = rotate(vec4f(-rotation.xyz, rotation.w), relative - from_eye(number));
    let one = triangle_at(triangle, scale, instances[number].place.w);
    let plane = cross(one.ab, one.ac);
    let apart = body - one.a;
    let share = vec2f(dot(cross(apart, one.ac), plane), dot(cross(one.ab, apart), plane)) / dot(plane, plane);
    let v = saturate(share.y);
    let u = min(saturate(share.x), 1.0 - v);
    let last = pieces[triangle + 4u];
    let at = last.w & ADDRESS;
    var normals = mat3x3f(bitcast<vec3f>(pieces[at].xyz), bitcast<vec3f>(pieces[at + 1u].xyz), bitcast<vec3f>(pieces[at + 2u].xyz));
    if (is_model(last.z)) {
        normals = mat3x3f(normalize(normals[0] / scale), normalize(normals[1] / scale), normalize(normals[2] / scale));
    }
    let normal = normalize(rotate(rotation, normals * vec3f(1.0 - u - v, u, v)));
    return Met(relative, body, normals, rotate(rotation, normalize(plane)), normal, last.z, last.w >> 28u);
}

fn hit_of(met: Met, number: u32, triangle: u32, direction: vec3f) -> Hit {
    let i = instances[number];
    let depth = max(dot(met.relative, globals.forward.xyz), 1e-6);
    let ray = select(met.relative / depth, direction, parallel);
    let steps = steps_of(ray, select(depth, 1.0, parallel), met.flat_normal);
    var finish: Finish;
    var glow = vec4f(0.0, 0.0, 0.0, 1.0);
    var bumped = met.normal;
    if ((FEATURES & WITH_MODELS) != 0u && is_model(met.material)) {
        let touched = touched(met, number, triangle, steps);
        finish = touched.spot.finish;
        there = touched.alpha;
        glow = touched.spot.glow;
        bumped = touched.normal;
    } else {
        finish = finish_of(met.material, i.color, i.second, i.scale.w, met.pattern == 0u);
    }
    let extra = vec2f(i.color.w, i.second.w);
    let footprint = footprint_of(steps, i.rotation);
    return Hit(met.relative, met.normal, met.body, met.normals[0], finish, i.scale, extra, f32(met.material != 0u), met.pattern, footprint, glow, bumped);
}

fn encoded(color: vec3f) -> u32 {
    let c = saturate(color);
    let curve = 1.055 * pow(c, vec3f(1.0 / 2.4)) - 0.055;
    return pack4x8unorm(vec4f(select(curve, 12.92 * c, c <= vec3f(0.0031308)), 1.0));
}

@compute @workgroup_size(8, 8)
fn find(@builtin(global_invocation_id) at: vec3u) {
    let pixel = pixel_of(at);
    if (pixel == NOTHING) {
        return;
    }
    look(at.z);
    if ((FEATURES & WITH_CUTS) != 0u) {
        globals = views[at.z].globals;
    }
    let sight = sight_of(at.xy);
    let found = trace(sight.origin, sight.direction, views[view].eye.w, FAR_AWAY * 0.1);
    // Parallel rays end at the far plane, as clip space does there.
    let is_far = parallel && found.t > limits.x;
    out_color[pixel] = found.triangle;
    out_depth[pixel] = found.t;
    out_who[pixel] = select(found.number, NOTHING, is_far);
}

// Whether the sun reaches what was met.
fn is_lit(met: Met) -> bool {
    let sun = views[view].globals.sun_direction.xyz;
    // Leaves let light through.
    let normal = select(met.normal, sun, met.pattern == 6u && met.material == 0u);
    var reaches = dot(normal, sun) > 0.0;
    if (reaches && views[view].globals.bounce.w != 0.0) {
        let lift = 0.005 + 2e-4 * length(met.relative);
        reaches = !is_blocked(met.relative + normal * lift, sun, 1e-3);
    }
    return reaches;
}

@compute @workgroup_size(8, 8)
fn light(@builtin(global_invocation_id) at: vec3u) {
    let pixel = pixel_of(at);
    if (pixel == NOTHING) {
        return;
    }
    look(at.z);
    let number = out_who[pixel];
    if (number == NOTHING) {
        return;
    }
    let triangle = out_color[pixel];
    let sight = sight_of(at.xy);
    let met = met_at(number, triangle, sight.origin + sight.direction * out_depth[pixel]);
    if (is_lit(met)) {
        out_color[pixel] = triangle | LIT;
    }
}

// In larger groups, whose rays share more of what paints them.
@compute @workgroup_size(16, 16)
fn paint(@builtin(global_invocation_id) at: vec3u) {
    let pixel = pixel_of(at);
    if (pixel == NOTHING) {
        return;
    }
    look(at.z);
    let number = out_who[pixel];
    let sight = sight_of(at.xy);
    globals = views[at.z].globals;
    if (number == NOTHING) {
        out_color[pixel] = encoded(tone_map(sky_with_clouds(normalize(sight.ahead))));
        out_depth[pixel] = 0.0;
        out_who[pixel] = 0u;
        return;
    }
    let code = out_color[pixel];
    lit = f32(code >> 31u);
    let triangle = code & ~LIT;
    let met = met_at(number, triangle, sight.origin + sight.direction * out_depth[pixel]);
    out_color[pixel] = encoded(shade(hit_of(met, number, triangle, sight.direction)));
    out_who[pixel] = instances[number].who;
}

// In place of `paint` where colour is not wanted: who it is, or the normals, which leave everything else as it is for what follows.
@compute @workgroup_size(16, 16)
fn measure(@builtin(global_invocation_id) at: vec3u) {
    let pixel = pixel_of(at);
    if (pixel == NOTHING) {
        return;
    }
    look(at.z);
    let number = out_who[pixel];
    if (FACING) {
        var facing = 0u;
        if (number != NOTHING) {
            let sight = sight_of(at.xy);
            let point = sight.origin + sight.direction * out_depth[pixel];
            facing = packed_normal(met_at(number, out_color[pixel] & ~LIT, point).normal);
        }
        out_normals[pixel] = facing;
        return;
    }
    if (number == NOTHING) {
        out_depth[pixel] = 0.0;
        out_who[pixel] = 0u;
        return;
    }
    out_who[pixel] = instances[number].who;
}
