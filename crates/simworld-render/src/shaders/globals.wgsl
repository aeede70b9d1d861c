// What one picture is drawn with; the twin of `Globals` in gpu/globals.rs. World axes, relative to the eye, metres.
struct Globals {
    clip_from_relative: mat4x4f,
    shadow_from_relative: mat4x4f,
    // Optical axes in the world: right, down, forward.
    right: vec4f,
    down: vec4f,
    forward: vec4f,
    // fx, fy, cx, cy, in pixels.
    intrinsics: vec4f,
    // Towards the sun, or at night towards the moon; w: how far it is night.
    sun_direction: vec4f,
    // Radiance of a white surface that faces it by its light alone, exposed; w: extinction of the air at the eye, 1/m.
    sun: vec4f,
    // Irradiance by spherical harmonics.
    ambient: array<vec4f, 9>,
    // Clouds overhead; w: the share of the sky that they cover.
    overcast: vec4f,
    // The sky's own glow; w: how fast the air thins out upwards, 1/m.
    night_sky: vec4f,
    // What fog scatters towards the eye; w: its share at the horizon.
    fog: vec4f,
    // Colours of what aerosol scatters near the horizon and overhead; w: vertical optical depth of fog.
    aerosol_low: vec4f,
    aerosol_high: vec4f,
    // Light from below; w: size of a shadow texel in m, or 0 without shadows.
    bounce: vec4f,
    // The eye in the world, and what that float leaves over.
    eye: vec4f,
    eye_rest: vec4f,
    // The unit vector in the plane towards sun or moon; then how far the clouds have drifted.
    source_flat: vec4f,
    // Wetness, share of puddles, depth of snow in m; w: how much rain stirs the puddles.
    cover: vec4f,
    // Where rain and snow have fallen to, modulo their box, m; w: time, s.
    drops: vec4f,
    // How they fall, m/s; w: 0 for rain, 1 for snow.
    fall: vec4f,
    // Least corner of the grid of lamps relative to the eye, m; w: its first entry in `lights`, 0 without lamps.
    lamp_grid: vec4f,
}

// One drawn thing; the twin of `Instance` in resident/instance.rs.
struct Instance {
    rotation: vec4f,
    // Where it is in the world, and the unit of offsets.
    place: vec4f,
    // What the float of the place leaves over.
    rest: vec3f,
    // Slot of the entity plus one, and its class from bit 24 on.
    who: u32,
    scale: vec4f,
    color: vec4f,
    second: vec4f,
}

// A corner of a mesh, with the instance that it belongs to.
struct VertexIn {
    anchor: vec3f,
    offset: vec3f,
    normal: vec3f,
    material: u32,
    rotation: vec4f,
    // From the eye, and the unit of offsets.
    translation: vec4f,
    scale: vec4f,
    color: vec4f,
    second: vec4f,
    who: u32,
}

fn rotate(q: vec4f, v: vec3f) -> vec3f {
    let t = 2.0 * cross(q.xyz, v);
    return v + q.w * t + cross(q.xyz, t);
}

// Whether the vertex is one of an asset's model: its material is a colour.
fn is_model(material: u32) -> bool {
    return (material & 0x80000000u) != 0u;
}

// Its normal in the body frame; models are stretched to the box of the instance, and their normals with them.
fn body_normal(in: VertexIn) -> vec3f {
    return select(in.normal, normalize(in.normal / in.scale.xyz), is_model(in.material));
}

// The vertex in the body frame, m.
fn body_point(in: VertexIn) -> vec3f {
    return in.anchor * in.scale.xyz + in.offset * in.translation.w;
}

// The vertex in world axes, relative to the eye, m.
fn relative_point(in: VertexIn) -> vec3f {
    return in.translation.xyz + rotate(in.rotation, body_point(in));
}

// How far below the top of what lies in its plane a surface counts as lying: the uppermost layer is 0. Those of surfaces stand
// negated where others have their parameter. Their edges are below all of them, or they would show through the plane.
fn layer_of(in: VertexIn) -> f32 {
    let layer = max(-in.second.w, 0.0);
    return select(layer, layer + 20.0, layer > 0.0 && in.normal.z < 0.5);
}

// Clip space of a vertex. Of surfaces in one plane that of the lower layer is to be seen, though rounding makes their z differ
// from row to row: so their z, and nothing else of them, is that of planes a hair below one another.
fn clip_of(relative: vec3f, layer: f32) -> vec4f {
    var clip = globals.clip_from_relative * vec4f(relative, 1.0);
    let height = max(abs(relative.z), 0.05);
    clip.z *= height / (height + layer * (0.0004 + 2e-6 * height));
    return clip;
}
