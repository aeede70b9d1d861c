// Entities: RGB, planar depth, and who it is, in one pass, or RGB alone.

// The painting of this pipeline, a `Pattern` of mesh/mod.rs.
override PATTERN: u32 = 0u;

struct Varyings {
    @builtin(position) position: vec4f,
    // Relative to the eye, world axes, m.
    @location(0) relative: vec3f,
    @location(1) normal: vec3f,
    // In the body frame, m.
    @location(2) body: vec3f,
    @location(3) @interpolate(flat) body_normal: vec3f,
    @location(4) @interpolate(flat) albedo: vec3f,
    // Emission, gloss, roughness, metallic.
    @location(5) @interpolate(flat) finish: vec4f,
    // The body's box and its seed.
    @location(6) @interpolate(flat) size: vec4f,
    // State and parameter of the instance.
    @location(7) @interpolate(flat) extra: vec2f,
    // 0 on the surface that the pattern paints, 1 elsewhere.
    @location(8) @interpolate(flat) paint: f32,
    @location(9) @interpolate(flat) id: u32,
}

@vertex
fn vertex_main(corner: Corner) -> Varyings {
    let in = vertex_of(corner);
    let finish = finish_of(in.material, in.color, in.second, in.scale.w, PATTERN == 0u);
    let relative = relative_point(in);
    var out: Varyings;
    out.position = clip_of(relative, layer_of(in) + select(0.0, mark_layer(in.color.w), PATTERN == 7u));
    out.relative = relative;
    let normal = body_normal(in);
    out.normal = rotate(in.rotation, normal);
    out.body = body_point(in);
    out.body_normal = normal;
    out.albedo = finish.albedo;
    out.finish = vec4f(finish.emission, finish.gloss, finish.roughness, finish.metallic);
    out.size = in.scale;
    out.extra = vec2f(in.color.w, in.second.w);
    out.paint = f32(in.material != 0u);
    out.id = in.who;
    return out;
}

fn hit_of(in: Varyings) -> Hit {
    let finish = Finish(in.albedo, in.finish.x, in.finish.y, in.finish.z, in.finish.w);
    let normal = normalize(in.normal);
    return Hit(in.relative, normal, in.body, in.body_normal, finish, in.size, in.extra, in.paint, PATTERN, fwidth(in.body), vec4f(0.0, 0.0, 0.0, 1.0), normal);
}

fn planar_depth(in: Varyings) -> f32 {
    return dot(in.relative, globals.forward.xyz);
}

struct All {
    @location(0) color: vec4f,
    @location(1) depth: f32,
    @location(2) id: u32,
}

@fragment
fn fragment_all(in: Varyings) -> All {
    return All(vec4f(shade(hit_of(in)), 1.0), planar_depth(in), in.id);
}

@fragment
fn fragment_color(in: Varyings) -> @location(0) vec4f {
    return vec4f(shade(hit_of(in)), 1.0);
}
