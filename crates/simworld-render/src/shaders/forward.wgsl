// Entities: RGB, planar depth and instance numbers in one pass, or RGB and the measures apart.
@group(1) @binding(0) var shadow_map: texture_depth_2d;
@group(1) @binding(1) var shadow_sampler: sampler_comparison;

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
    // Emission and gloss.
    @location(5) @interpolate(flat) finish: vec2f,
    // The body's box and its seed.
    @location(6) @interpolate(flat) size: vec4f,
    // State and parameter of the instance.
    @location(7) @interpolate(flat) extra: vec2f,
    // 0 on the surface that the pattern paints, 1 elsewhere.
    @location(8) @interpolate(flat) paint: f32,
    @location(9) @interpolate(flat) id: u32,
}

struct Finish {
    albedo: vec3f,
    emission: f32,
    gloss: f32,
}

// The materials of mesh/builder.rs.
fn finish_of(in: VertexIn) -> Finish {
    if (is_model(in)) {
        // Square roots of 10 bits a channel; times the colour of the entity where the part has that.
        let roots = vec3f(vec3u(in.material >> 20u, in.material >> 10u, in.material) & vec3u(1023u)) / 1023.0;
        let factor = select(vec3f(1.0), in.color.rgb, (in.material & 0x40000000u) != 0u);
        return Finish(roots * roots * factor, 0.0, 0.0);
    }
    let night = globals.sun_direction.w;
    let aspect = in.color.w;
    let skin = mix(vec3f(0.42, 0.24, 0.15), vec3f(0.72, 0.47, 0.33), fract(in.scale.w * 11.0));
    let hair = mix(vec3f(0.012, 0.009, 0.008), vec3f(0.2, 0.11, 0.04), pow(fract(in.scale.w * 23.0), 2.0));
    switch in.material {
        case 1u: { return Finish(in.second.rgb, 0.0, 0.0); }
        case 2u: { return Finish(vec3f(0.012, 0.017, 0.022), 0.0, 1.0); }
        case 3u: { return Finish(vec3f(0.016), 0.0, 0.0); }
        case 4u: { return Finish(vec3f(0.32, 0.33, 0.34), 0.0, 0.25); }
        case 5u: { return Finish(vec3f(0.13, 0.08, 0.045), 0.0, 0.0); }
        case 6u: { return Finish(skin, 0.0, 0.0); }
        case 7u: { return Finish(hair, 0.0, 0.0); }
        case 8u: { return Finish(vec3f(0.8, 0.8, 0.76), 0.15 + 1.6 * night, 0.6); }
        case 9u: { return Finish(vec3f(0.5, 0.012, 0.01), 0.1 + 1.0 * night, 0.5); }
        case 10u: { return Finish(vec3f(0.9, 0.8, 0.6), 0.1 + 2.4 * night, 0.0); }
        case 11u: { return Finish(mix(vec3f(0.11, 0.012, 0.01), vec3f(1.0, 0.04, 0.02), f32(aspect == 1.0)), 1.6 * f32(aspect == 1.0), 0.2); }
        case 12u: { return Finish(mix(vec3f(0.1, 0.06, 0.008), vec3f(1.0, 0.5, 0.02), f32(aspect == 2.0)), 1.6 * f32(aspect == 2.0), 0.2); }
        case 13u: { return Finish(mix(vec3f(0.008, 0.07, 0.03), vec3f(0.03, 1.0, 0.35), f32(aspect == 3.0)), 1.6 * f32(aspect == 3.0), 0.2); }
        case 14u: { return Finish(vec3f(0.7, 0.68, 0.64), 0.0, 0.0); }
        case 15u: { return Finish(vec3f(0.03, 0.031, 0.034), 0.0, 0.1); }
        default: { return Finish(in.color.rgb, 0.0, 0.0); }
    }
}

@vertex
fn vertex_main(in: VertexIn) -> Varyings {
    let finish = finish_of(in);
    let relative = relative_point(in);
    var out: Varyings;
    out.position = globals.clip_from_relative * vec4f(relative, 1.0);
    out.relative = relative;
    let normal = body_normal(in);
    out.normal = rotate(in.rotation, normal);
    out.body = body_point(in);
    out.body_normal = normal;
    out.albedo = finish.albedo;
    out.finish = vec2f(finish.emission, finish.gloss);
    out.size = in.scale;
    out.extra = vec2f(in.color.w, in.second.w);
    out.paint = f32(in.material != 0u);
    out.id = in.index + 1u;
    return out;
}

fn sunlit(relative: vec3f, normal: vec3f) -> f32 {
    let texel = globals.bounce.w;
    if (texel == 0.0) {
        return 1.0;
    }
    let slant = 1.0 - saturate(dot(normal, globals.sun_direction.xyz));
    let lifted = relative + normal * texel * (1.0 + 1.5 * slant) + globals.sun_direction.xyz * 0.02;
    let p = globals.shadow_from_relative * vec4f(lifted, 1.0);
    let uv = p.xy * vec2f(0.5, -0.5) + 0.5;
    let edge = max(abs(p.x), abs(p.y));
    if (edge > 0.999 || p.z > 1.0) {
        return 1.0;
    }
    let size = 1.0 / f32(textureDimensions(shadow_map).x);
    var sum = 0.0;
    for (var k = 0; k < 4; k++) {
        let shift = (vec2f(f32(k & 1), f32(k >> 1)) - 0.5) * 1.3 * size;
        sum += textureSampleCompareLevel(shadow_map, shadow_sampler, uv + shift, p.z);
    }
    return mix(sum * 0.25, 1.0, smoothstep(0.9, 0.999, edge));
}

fn surface_of(in: Varyings) -> Surface {
    let base = Surface(in.albedo, in.finish.y, in.albedo * in.finish.x, normalize(in.normal));
    switch PATTERN {
        case 1u: { return facade(in, base); }
        case 2u: { return road(in, base); }
        case 3u: { return sidewalk(in, base); }
        case 4u: { return crosswalk(in, base); }
        case 5u: { return ground(in, base); }
        case 6u: { return foliage(in, base); }
        default: { return base; }
    }
}

fn shade(in: Varyings) -> vec3f {
    let s = surface_of(in);
    let distance = length(in.relative);
    let ray = in.relative / max(distance, 1e-6);
    let sun = globals.sun_direction.xyz;
    let facing = dot(s.normal, sun);
    let leaves = PATTERN == 6u && in.paint < 0.5;
    // Leaves let light through: they are lit a little from behind.
    let cosine = select(saturate(facing), saturate(facing * 0.7 + 0.3), leaves);
    var light = 0.0;
    if (cosine > 0.0) {
        light = cosine * sunlit(in.relative, select(normalize(in.normal), sun, leaves));
    }
    let ambient = mix(globals.bounce.rgb, globals.sky.rgb, s.normal.z * 0.5 + 0.5);
    // Nooks near the ground see less of the sky.
    let nook = mix(0.72, 1.0, smoothstep(0.0, 1.2, in.body.z + 2.0 * abs(in.body_normal.z)));
    var color = s.albedo * (globals.sun.rgb * light + ambient * nook) + s.emissive;
    if (s.gloss > 0.0) {
        let mirrored = reflect(ray, s.normal);
        let grazing = 1.0 - saturate(dot(s.normal, -ray));
        let fresnel = 0.07 + 0.93 * pow(grazing, 5.0);
        let spark = pow(saturate(dot(mirrored, sun)), 250.0) * 6.0 * f32(light > 0.0);
        color += s.gloss * fresnel * (sky_gradient(mirrored) + globals.sun.rgb * spark);
    }
    let through = exp(-globals.sun.w * distance);
    let haze = sky_gradient(normalize(vec3f(ray.xy, 0.02)));
    return tone_map(mix(haze, color, through));
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
    return All(vec4f(shade(in), 1.0), planar_depth(in), in.id);
}

@fragment
fn fragment_color(in: Varyings) -> @location(0) vec4f {
    return vec4f(shade(in), 1.0);
}

struct Measures {
    @location(0) depth: f32,
    @location(1) id: u32,
}

@fragment
fn fragment_measures(in: Varyings) -> Measures {
    return Measures(planar_depth(in), in.id);
}
