// What the raster backend draws from.
@group(0) @binding(0) var<uniform> globals: Globals;
@group(0) @binding(1) var<storage, read> instances: array<Instance>;
// The sky, then grids of lamps; see sky.wgsl and lamps.wgsl.
@group(0) @binding(2) var<storage, read> lights: array<vec4f>;
