// Depth and ids of what is whole, where RGB is drawn apart or not at all.
struct Measured {
    @builtin(position) position: vec4f,
    // Relative to the eye, world axes, m.
    @location(0) relative: vec3f,
    @location(1) @interpolate(flat) id: u32,
}

@vertex
fn vertex_measures(corner: Corner) -> Measured {
    let in = vertex_of(corner);
    let relative = relative_point(in);
    return Measured(clip_of(relative, layer_of(in)), relative, in.who);
}

struct Measures {
    @location(0) depth: f32,
    @location(1) id: u32,
}

@fragment
fn fragment_measures(in: Measured) -> Measures {
    return Measures(dot(in.relative, globals.forward.xyz), in.id);
}
