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
    // Towards the sun; w: how far it is night.
    sun_direction: vec4f,
    // Radiance of a white surface in the sun, exposed; w: extinction of the air, 1/m.
    sun: vec4f,
    // The same under the sky alone; w: cloud cover.
    sky: vec4f,
    // Light from below; w: size of a shadow texel in m, or 0 without shadows.
    bounce: vec4f,
    zenith: vec4f,
    horizon: vec4f,
}

@group(0) @binding(0) var<uniform> globals: Globals;

struct VertexIn {
    @builtin(instance_index) index: u32,
    @location(0) anchor: vec3f,
    @location(1) offset: vec3f,
    @location(2) normal: vec3f,
    @location(3) material: u32,
    @location(4) rotation: vec4f,
    @location(5) translation: vec4f,
    @location(6) scale: vec4f,
    @location(7) color: vec4f,
    @location(8) second: vec4f,
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
