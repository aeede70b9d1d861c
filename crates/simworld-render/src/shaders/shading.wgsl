// The colour of what a view ray meets, for every backend: no derivatives, no stage inputs. A backend brings
// `sunlit(relative, normal)`, the share of the sun that reaches a point.
fn surface_of(hit: Hit) -> Surface {
    let base = Surface(hit.finish.albedo, hit.finish.gloss, hit.finish.albedo * hit.finish.emission, hit.normal);
    switch hit.pattern {
        case 1u: { return facade(hit, base); }
        case 2u: { return road(hit, base); }
        case 3u: { return sidewalk(hit, base); }
        case 4u: { return crosswalk(hit, base); }
        case 5u: { return ground(hit, base); }
        case 6u: { return foliage(hit, base); }
        default: { return base; }
    }
}

// Display light, linear sRGB from 0 to 1.
fn shade(hit: Hit) -> vec3f {
    let s = surface_of(hit);
    let distance = length(hit.relative);
    let ray = hit.relative / max(distance, 1e-6);
    let sun = globals.sun_direction.xyz;
    let facing = dot(s.normal, sun);
    let leaves = hit.pattern == 6u && hit.paint < 0.5;
    // Leaves let light through: they are lit a little from behind.
    let cosine = select(saturate(facing), saturate(facing * 0.7 + 0.3), leaves);
    var light = 0.0;
    if (cosine > 0.0) {
        light = cosine * sunlit(hit.relative, select(hit.normal, sun, leaves));
    }
    let ambient = mix(globals.bounce.rgb, globals.sky.rgb, s.normal.z * 0.5 + 0.5);
    // Nooks near the ground see less of the sky.
    let nook = mix(0.72, 1.0, smoothstep(0.0, 1.2, hit.body.z + 2.0 * abs(hit.body_normal.z)));
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
