// Rain and snow before rays: each group of threads gathers the streaks that may lie over its pixels, 128 at a time, and each pixel sums up how much they hide.
// The sum is of whole numbers, so that it does not depend on the order in which they were gathered.
const FALLING: u32 = 128u;
var<workgroup> gathered: array<Streak, FALLING>;
var<workgroup> count: atomic<u32>;

// A unit of the logarithm of what comes through.
const GRAIN: f32 = 65536.0;

// Whether a streak may lie over pixels from `low` to `high`.
fn may_cover(streak: Streak, low: vec2f, high: vec2f) -> bool {
    if (streak.strength <= 0.0) {
        return false;
    }
    let k = globals.intrinsics;
    var least = vec2f(FAR_AWAY);
    var greatest = vec2f(-FAR_AWAY);
    for (var corner = 0u; corner < 4u; corner++) {
        let side = f32(corner & 1u) * 2.0 - 1.0;
        let end = f32(corner >> 1u) * 2.0 - 1.0;
        let place = streak.middle + streak.wide * (side * streak.half_width) + streak.axis * (end * streak.half_length);
        let depth = dot(place, globals.forward.xyz);
        if (depth < 0.05) {
            // At those that are half behind the eye all pixels have a look.
            return dot(streak.middle, globals.forward.xyz) > 0.0;
        }
        let pixel = vec2f(dot(place, globals.right.xyz), dot(place, globals.down.xyz)) / depth * k.xy + k.zw;
        least = min(least, pixel);
        greatest = max(greatest, pixel);
    }
    return all(least <= high) && all(greatest >= low);
}

// How much a streak hides on a view ray between two depths.
fn hidden_by(streak: Streak, ray: vec3f, near: f32, depth: f32) -> f32 {
    let normal = cross(streak.wide, streak.axis);
    let slant = dot(ray, normal);
    // The ray has planar depth one, so where it meets the plane is how deep it is.
    let t = dot(streak.middle, normal) / select(slant, 1e-9, abs(slant) < 1e-9);
    let place = ray * t - streak.middle;
    let across = vec2f(dot(place, streak.wide) / streak.half_width, dot(place, streak.axis) / streak.half_length);
    if (t < near || t >= depth || any(abs(across) > vec2f(1.0))) {
        return 0.0;
    }
    return cover_of(across, streak.strength);
}

fn decoded(color: u32) -> vec3f {
    let c = unpack4x8unorm(color).rgb;
    return select(pow((c + 0.055) / 1.055, vec3f(2.4)), c / 12.92, c <= vec3f(0.04045));
}

@compute @workgroup_size(16, 16)
fn fall(@builtin(global_invocation_id) at: vec3u, @builtin(local_invocation_index) lane: u32, @builtin(workgroup_id) group: vec3u) {
    look(at.z);
    globals = views[at.z].globals;
    let pixel = pixel_of(at);
    let sight = sight_of(at.xy);
    var depth = 0.0;
    if (pixel != NOTHING) {
        depth = select(FAR_AWAY, out_depth[pixel], out_who[pixel] != 0u);
    }
    let near = views[at.z].eye.w;
    let low = vec2f(group.xy * 16u);
    let most = views[group.z].falling.x;
    var passed = 0u;
    for (var first = 0u; first < most; first += FALLING) {
        if (lane == 0u) {
            atomicStore(&count, 0u);
        }
        workgroupBarrier();
        if (lane < FALLING && first + lane < most) {
            let streak = streak_of(first + lane);
            if (may_cover(streak, low, low + 16.0)) {
                gathered[atomicAdd(&count, 1u)] = streak;
            }
        }
        workgroupBarrier();
        let there = atomicLoad(&count);
        for (var k = 0u; k < there; k++) {
            let hidden = hidden_by(gathered[k], sight.ahead, near, depth);
            if (hidden > 0.0) {
                passed += u32(-log2(max(1.0 - hidden, 1e-4)) * GRAIN + 0.5);
            }
        }
        workgroupBarrier();
    }
    if (pixel != NOTHING && passed > 0u) {
        let through = exp2(-f32(passed) / GRAIN);
        out_color[pixel] = encoded(mix(streak_color(), decoded(out_color[pixel]), through));
    }
}
