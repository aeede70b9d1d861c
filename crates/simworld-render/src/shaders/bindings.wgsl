// What the raster backend draws from.
@group(0) @binding(0) var<uniform> globals: Globals;
// The grids of lamps behind the sky; see lamps.wgsl.
@group(0) @binding(1) var<storage, read> lights: array<vec4f>;
// The sky alone: software fetches from uniforms many pixels at a time, and from storage one by one.
@group(0) @binding(2) var<uniform> sky_table: array<vec4f, 144>;

fn sky_node(index: u32) -> vec4f {
    return sky_table[index];
}

// A corner of a mesh, and the instance that it belongs to; the twin of the layouts in gpu/pipelines.rs.
struct Corner {
    @location(0) anchor: vec3f,
    @location(1) offset: vec3f,
    @location(2) normal: vec3f,
    @location(3) material: u32,
    @location(4) rotation: vec4f,
    @location(5) place: vec4f,
    @location(6) rest: vec3f,
    @location(7) who: u32,
    @location(8) scale: vec4f,
    @location(9) color: vec4f,
    @location(10) second: vec4f,
}

fn vertex_of(corner: Corner) -> VertexIn {
    // Part by part, so that nothing is lost far from the origin.
    let from_eye = (corner.place.xyz - globals.eye.xyz) + (corner.rest - globals.eye_rest.xyz);
    return VertexIn(corner.anchor, corner.offset, corner.normal, corner.material, corner.rotation,
        vec4f(from_eye, corner.place.w), corner.scale, corner.color, corner.second, corner.who);
}
