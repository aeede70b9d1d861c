// Models of assets: how their parts take light, place by place.

// The colour of a vertex: square roots of 10 bits a channel; times the colour of the entity where its part has that.
fn model_tint(material: u32, color: vec3f) -> vec3f {
    let roots = vec3f(vec3u(material >> 20u, material >> 10u, material) & vec3u(1023u)) / 1023.0;
    return roots * roots * select(vec3f(1.0), color, (material & 0x40000000u) != 0u);
}

// What a part is at a place on its pictures.
struct Spot {
    finish: Finish,
    // Its own light, which is seen by day as little as that of a lamp's glass; w: the share of the sky's light that comes there.
    glow: vec4f,
    // Its normal in the frame of the pictures: to the right, to the top, and out of the surface; zero without a picture of it.
    bump: vec3f,
    // How much of it is there by the picture of its colour.
    alpha: f32,
}

// Pictures of a part beside that of its colour, by the bits that say which there are; as many entries behind METAL_PICTURE.
const METAL: u32 = 0u;
const EMISSION: u32 = 1u;
const SHADE: u32 = 2u;
const BUMPS: u32 = 3u;

fn model_spot(coat: u32, tint: vec3f, place: vec2f, across: vec2f, down: vec2f) -> Spot {
    let first = coat_entry(coat);
    let light = coat_entry(coat + 1u);
    var spot = Spot(Finish(tint, 0.0, 0.0, first.x, first.y), vec4f(light.rgb, 1.0), vec3f(0.0), 1.0);
    let picture = picture_at(coat + COLOR_PICTURE);
    if (picture.row >= 0.0) {
        let seen = pictured(true, picture, place, level_of_picture(picture, across, down));
        spot.finish.albedo *= seen.rgb;
        spot.alpha = seen.a;
    }
    // A loop, which costs nothing on a CPU where it never runs: most parts have no such pictures.
    for (var left = u32(first.z); left != 0u; left &= left - 1u) {
        let kind = firstTrailingBit(left);
        let more = picture_at(coat + METAL_PICTURE + kind);
        let seen = pictured(kind == EMISSION, more, place, level_of_picture(more, across, down)).rgb;
        let scale = coat_entry(coat + SCALES).xy;
        switch kind {
            case METAL: {
                spot.finish.roughness *= seen.g;
                spot.finish.metallic *= seen.b;
            }
            case EMISSION: { spot.glow = vec4f(spot.glow.rgb * seen, spot.glow.w); }
            case SHADE: { spot.glow.w = 1.0 + scale.x * (seen.r - 1.0); }
            default: { spot.bump = (2.0 * seen - 1.0) * vec3f(scale.y, scale.y, 1.0); }
        }
    }
    spot.glow = vec4f(spot.glow.rgb * (0.15 + 1.6 * globals.sun_direction.w), spot.glow.w);
    return spot;
}

// The tangent of a vertex in the body frame, by its code (tangent.rs): of length 1, to the right of the pictures; w: 1 where their top is to the left of that seen from outside,
// -1 where it is to the right; zeros where there is none. What lies along a model is stretched with it.
fn tangent_of(code: u32, scale: vec3f) -> vec4f {
    if (code == 0u) {
        return vec4f(0.0);
    }
    let plane = (vec2f(vec2u(code, code >> 15u) & vec2u(32767u)) - vec2f(16383.0)) / 16383.0;
    let z = 1.0 - abs(plane.x) - abs(plane.y);
    let folded = (1.0 - abs(plane.yx)) * select(vec2f(-1.0), vec2f(1.0), plane >= vec2f(0.0));
    let way = vec3f(select(plane, folded, z < 0.0), z) * scale;
    return vec4f(normalize(way), select(1.0, -1.0, (code & 0x40000000u) != 0u));
}

// A normal as bumps tilt it, of a surface on which two ways of so many metres are such ways on its pictures, downwards as these count. The frame is
// that of the tangent, where all corners around have one, or that of the surface there; its first axis is to the right of the pictures, as glTF has it.
fn tilted(normal: vec3f, tangent: vec4f, bump: vec3f, ways: mat2x3f, steps: mat2x2f) -> vec3f {
    let turn = sign(determinant(steps));
    let right = (ways[0] * steps[1].y - ways[1] * steps[0].y) * turn;
    let below = (ways[1] * steps[0].x - ways[0] * steps[1].x) * turn;
    let is_told = abs(tangent.w) > 0.99;
    let first = select(right, tangent.xyz, is_told);
    let along = first - normal * dot(normal, first);
    let square = dot(along, along);
    let level = along * inverseSqrt(max(square, 1e-36));
    let aside = cross(normal, level);
    let found = select(-1.0, 1.0, dot(aside, below) < 0.0);
    let up = aside * select(found, sign(tangent.w), is_told);
    let leaning = level * bump.x + up * bump.y + normal * bump.z;
    let length = length(leaning);
    // Where pictures lie on a line, or have no direction at all, nothing is tilted.
    return select(normal, leaning / max(length, 1e-6), square > 1e-36 && length > 1e-3);
}
