// The share of the sun that reaches a point, from the shadow map.
@group(1) @binding(0) var shadow_map: texture_depth_2d;
@group(1) @binding(1) var shadow_sampler: sampler_comparison;

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
