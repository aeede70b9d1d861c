// Rain and snow: streaks and flakes in a box around the eye. They stand still in the world but for their fall, so that they
// pass as the eye moves; what leaves the box comes in again on its other side. They are drawn over the picture where
// nothing is nearer, and leave depth and ids alone.
const BOX: f32 = 16.0;
// How long the eye gathers the light of a drop, s.
const GATHERING: f32 = 0.03;

struct Drop {
    @builtin(position) position: vec4f,
    @location(0) across: vec2f,
    @location(1) @interpolate(flat) strength: f32,
}

@vertex
fn vertex_drop(@builtin(vertex_index) corner: u32, @builtin(instance_index) index: u32) -> Drop {
    let k = i32(index);
    let seed = vec3f(hash3(vec3i(k, 1, 7)), hash3(vec3i(k, 2, 7)), hash3(vec3i(k, 3, 7)));
    let snow = globals.fall.w;
    var place = seed * BOX + globals.drops.xyz;
    // Flakes drift to and fro.
    let sway = sin(globals.drops.w * vec2f(1.1, 0.9) * (0.6 + seed.zx) + 40.0 * seed.xy);
    place += vec3f(0.25 * snow * sway, 0.0);
    let middle = fract(place / BOX) * BOX - 0.5 * BOX;
    let distance = max(length(middle), 1e-3);
    let pixel = dot(middle, globals.forward.xyz) / globals.intrinsics.x;
    // Two triangles: corners 0 1 2 and 2 1 3.
    let which = select(corner, select(select(3u, 1u, corner == 4u), 2u, corner == 3u), corner > 2u);
    let side = f32(which & 1u) * 2.0 - 1.0;
    let end = f32(which >> 1u) * 2.0 - 1.0;
    let speed = length(globals.fall.xyz);
    let axis = select(globals.fall.xyz / max(speed, 1e-3), globals.down.xyz, snow > 0.5);
    let wide = normalize(cross(middle, axis) + vec3f(1e-6, 0.0, 0.0));
    // Never thinner than most of a pixel; what is added in width is taken from strength.
    let radius = mix(0.0020 + 0.0016 * seed.x, 0.006 + 0.009 * seed.y, snow);
    let drawn = max(radius, 0.45 * pixel);
    let length = mix(0.5 * speed * GATHERING, drawn, snow);
    let corner_place = middle + wide * (side * drawn) + axis * (end * length);
    var out: Drop;
    out.position = globals.clip_from_relative * vec4f(corner_place, 1.0);
    out.across = vec2f(side, end);
    let near = smoothstep(0.5, 1.6, distance) * smoothstep(0.5 * BOX, 0.3 * BOX, distance);
    let thin = radius / drawn;
    out.strength = near * mix(min(0.75, 1.3 * thin), 0.95 * min(1.0, thin * thin * 2.0), snow);
    return out;
}

fn drop_color(in: Drop) -> vec4f {
    let round = 1.0 - smoothstep(0.3, 1.0, length(in.across));
    let streak = (1.0 - abs(in.across.x)) * (1.0 - in.across.y * in.across.y);
    let amount = in.strength * mix(streak, round, globals.fall.w);
    // Drops and flakes send on light from all around.
    let even = globals.ambient[0].rgb * mix(1.25, 1.5, globals.fall.w) + globals.sun.rgb * 0.25;
    let lamps = vec3f(0.34, 0.31, 0.26) * globals.sun_direction.w;
    return vec4f(tone_map(even + lamps), amount);
}

@fragment
fn fragment_drop(in: Drop) -> @location(0) vec4f {
    return drop_color(in);
}

struct DropAll {
    @location(0) color: vec4f,
    @location(1) depth: f32,
    @location(2) id: u32,
}

// Depth and ids are masked.
@fragment
fn fragment_drop_all(in: Drop) -> DropAll {
    return DropAll(drop_color(in), 0.0, 0u);
}
