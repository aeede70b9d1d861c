// Rain and snow: streaks and flakes in a box around the eye. They stand still in the world but for their fall, so that they
// pass as the eye moves; what leaves the box comes in again on its other side.
const BOX: f32 = 16.0;
// How long the eye gathers the light of a drop, s.
const GATHERING: f32 = 0.03;

// A streak or flake: a rectangle that faces the eye.
struct Streak {
    // From the eye, world axes, m.
    middle: vec3f,
    // Unit vectors across it and along it, at right angles; and how far it reaches from the middle, m.
    wide: vec3f,
    axis: vec3f,
    half_width: f32,
    half_length: f32,
    // How much of what is behind it hides at most, 0 to 1.
    strength: f32,
}

fn streak_of(index: u32) -> Streak {
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
    let speed = length(globals.fall.xyz);
    let axis = select(globals.fall.xyz / max(speed, 1e-3), globals.down.xyz, snow > 0.5);
    let wide = normalize(cross(middle, axis) + vec3f(1e-6, 0.0, 0.0));
    // Never thinner than most of a pixel; what is added in width is taken from strength.
    let radius = mix(0.0020 + 0.0016 * seed.x, 0.006 + 0.009 * seed.y, snow);
    let drawn = max(radius, 0.45 * pixel);
    let half_length = mix(0.5 * speed * GATHERING, drawn, snow);
    let near = smoothstep(0.5, 1.6, distance) * smoothstep(0.5 * BOX, 0.3 * BOX, distance);
    let thin = radius / drawn;
    let strength = near * mix(min(0.75, 1.3 * thin), 0.95 * min(1.0, thin * thin * 2.0), snow);
    return Streak(middle, wide, axis, drawn, half_length, strength);
}

// How much of what is behind a streak hides, where it is met: shares of its half width and half length from its middle.
fn cover_of(across: vec2f, strength: f32) -> f32 {
    let round = 1.0 - smoothstep(0.3, 1.0, length(across));
    let streak = (1.0 - abs(across.x)) * (1.0 - across.y * across.y);
    return strength * mix(streak, round, globals.fall.w);
}

// The colour of drops and flakes, which send on light from all around.
fn streak_color() -> vec3f {
    let even = globals.ambient[0].rgb * mix(1.25, 1.5, globals.fall.w) + globals.sun.rgb * 0.25;
    let lamps = vec3f(0.34, 0.31, 0.26) * globals.sun_direction.w;
    return tone_map(even + lamps);
}
