// What a view ray meets: all that shading knows of it. Each backend fills one in, from varyings or from a ray cast.
struct Hit {
    // The point, relative to the eye, world axes, m.
    relative: vec3f,
    // The surface's normal for shading: unit length, world axes.
    normal: vec3f,
    // The point in the body frame, m.
    body: vec3f,
    // The normal of the triangle's corner, body frame.
    body_normal: vec3f,
    finish: Finish,
    // The body's box, m, and its seed.
    size: vec4f,
    // State and parameter of the instance.
    extra: vec2f,
    // 0 on the surface that the pattern paints, 1 elsewhere.
    paint: f32,
    // A `Pattern` of mesh/mod.rs.
    pattern: u32,
    // How far each body coordinate goes from a pixel to the next: steps across and down together, m.
    footprint: vec3f,
    // Light of its own, beside that of its finish; w: the share of the sky's light that comes there.
    glow: vec4f,
    // The normal as bumps tilt it.
    bumped: vec3f,
}

// How far a point on a plane goes from a pixel to the next, across and down, world axes, for backends without derivatives: as the view ray moves by
// a pixel, depth * (axis - ray * (normal . axis) / (normal . ray)), ray and axis of planar depth one. Parallel rays spread no further with
// depth: theirs is one.
fn steps_of(ray: vec3f, depth: f32, normal: vec3f) -> mat2x3f {
    let slant = dot(normal, ray);
    let steep = select(min(slant, -1e-4), max(slant, 1e-4), slant > 0.0);
    let across = (globals.right.xyz - ray * (dot(normal, globals.right.xyz) / steep)) * (depth / globals.intrinsics.x);
    let down = (globals.down.xyz - ray * (dot(normal, globals.down.xyz) / steep)) * (depth / globals.intrinsics.y);
    return mat2x3f(across, down);
}

// The footprint of a pixel in the body.
fn footprint_of(steps: mat2x3f, rotation: vec4f) -> vec3f {
    let inverse = vec4f(-rotation.xyz, rotation.w);
    return abs(rotate(inverse, steps[0])) + abs(rotate(inverse, steps[1]));
}
