// The colour of what a view ray meets, for every backend: no derivatives, no stage inputs. A backend brings
// `sunlit(relative, normal)`, the share of the sun that reaches a point, and `painted(hit, base)`, which paints what it may meet.

// What this picture needs; folded away by the compiler where it is not.
override FEATURES: u32 = 7u;
const WITH_LAMPS: u32 = 1u;
const WITH_WATER: u32 = 2u;
const WITH_SNOW: u32 = 4u;
// Of rays alone, which meet models and everything else in one pipeline.
const WITH_MODELS: u32 = 8u;
// Of rays alone: some of these are cut out.
const WITH_CUTS: u32 = 16u;

fn surface_of(hit: Hit) -> Surface {
    let f = hit.finish;
    let base = Surface(f.albedo, f.gloss, f.albedo * f.emission + hit.glow.rgb, hit.bumped, f.roughness, f.metallic);
    return painted(hit, base);
}

// Water on a surface: what soaks is darker (S. Lagarde, Water drop, 2013), a film is smooth, and hollows of level ground
// hold puddles, which rain ripples.
fn wetted(hit: Hit, surface: Surface) -> Surface {
    var s = surface;
    let level = smoothstep(0.7, 0.95, hit.normal.z);
    let wet = globals.cover.x * mix(0.45, 1.0, level) * (1.0 - s.metallic) * (1.0 - s.gloss);
    s.albedo *= mix(1.0, 0.55, wet * saturate(s.roughness * 1.2));
    s.roughness = mix(s.roughness, 0.3, wet * 0.8);
    let flat = (hit.pattern >= 2u && hit.pattern <= 5u) || hit.pattern == 7u;
    if (flat) {
        let p = on_surface(hit);
        let hollow = noise2(p * 0.22 + 3.7) * 0.65 + noise2(p * 0.9) * 0.35;
        let edge = mix(0.85, 0.47, globals.cover.y);
        let water = smoothstep(edge, edge + 0.06, hollow) * level * f32(globals.cover.y > 0.0);
        s.albedo = mix(s.albedo, s.albedo * 0.5, water);
        s.roughness = mix(s.roughness, 0.05, water);
        s.gloss = max(s.gloss, water);
        let ring = noise2(p * 9.0 + globals.drops.w * 3.0) - noise2(p * 9.0 + vec2f(0.4, 0.0) - globals.drops.w * 2.0);
        let fade = saturate(1.0 - 12.0 * max(hit.footprint.x, hit.footprint.y));
        s.normal = normalize(mix(s.normal, hit.normal, water) + vec3f(ring, -ring, 0.0) * (0.12 * globals.cover.w * water * fade));
    }
    return s;
}

// Snow lies on what faces up, in drifts first.
fn snowed(hit: Hit, surface: Surface) -> Surface {
    var s = surface;
    let p = on_surface(hit);
    let drift = noise2(p * 0.7 + hit.size.w * 31.0) * 0.6 + noise2(p * 3.1) * 0.4;
    let depth = saturate(globals.cover.z * 12.0);
    // It slides off smooth things unless they are level.
    let lies = smoothstep(0.55 - 0.4 * depth, 0.9 - 0.35 * depth, s.normal.z * (0.75 + 0.5 * drift) - 0.4 * s.gloss);
    var amount = saturate(lies * smoothstep(0.0, 0.35, depth + 0.5 * drift - 0.4) * 1.3);
    // Wheels leave the road half bare in tracks along it.
    if (hit.pattern == 2u || hit.pattern == 4u || hit.pattern == 7u) {
        let track = noise2(vec2f(p.x * 0.06, p.y * 1.5)) * 0.75 + noise2(p * 2.3) * 0.25;
        amount *= smoothstep(0.25, 0.6, track + 0.25 * depth - 0.1);
    }
    s.albedo = mix(s.albedo, vec3f(0.78, 0.8, 0.84), amount);
    s.roughness = mix(s.roughness, 0.75, amount);
    s.gloss *= 1.0 - amount;
    s.metallic *= 1.0 - amount;
    s.normal = normalize(mix(s.normal, hit.normal, amount * 0.7));
    return s;
}

// What a surface sends to `view` of light from `towards`: Lambert, and the microfacets of Cook and Torrance with the
// distribution GGX, the visibility of Smith by E. Hammon (GDC 2017) and Schlick's Fresnel term; with the cosine, and times π.
fn reflected(s: Surface, view: vec3f, towards: vec3f) -> vec3f {
    let cosine = saturate(dot(s.normal, towards));
    let half = normalize(view + towards);
    let facing = max(dot(s.normal, view), 0.05);
    let h = saturate(dot(s.normal, half));
    let grazing = 1.0 - saturate(dot(view, half));
    let square = grazing * grazing;
    let schlick = square * square * grazing;
    let base = mix(vec3f(0.04), s.albedo, s.metallic);
    let fresnel = base + (1.0 - base) * schlick;
    let a = max(s.roughness * s.roughness, 0.003);
    let below = h * h * (a * a - 1.0) + 1.0;
    let lobe = a * a / (below * below);
    let visible = 0.5 / mix(2.0 * facing * cosine, facing + cosine, a);
    var light = s.albedo * (1.0 - s.metallic) + fresnel * (lobe * visible);
    // A coat, of water or glass or varnish, with a slope of 0.03.
    let c = h * h * (0.0009 - 1.0) + 1.0;
    light += s.gloss * (0.04 + 0.96 * schlick) * (0.0009 / (c * c)) * visible * 0.35;
    return light * cosine;
}

// Irradiance of the sky and the ground by the harmonics of light.rs.
fn irradiance(n: vec3f) -> vec3f {
    return max(globals.ambient[0].rgb + globals.ambient[1].rgb * n.y + globals.ambient[2].rgb * n.z
        + globals.ambient[3].rgb * n.x + globals.ambient[4].rgb * (n.x * n.y) + globals.ambient[5].rgb * (n.y * n.z)
        + globals.ambient[6].rgb * (3.0 * n.z * n.z - 1.0) + globals.ambient[7].rgb * (n.x * n.z)
        + globals.ambient[8].rgb * (n.x * n.x - n.y * n.y), vec3f(0.0));
}

// What a surface mirrors of sky and street: sharp under a coat and on smooth ground, blurred on rough surfaces; the share
// by B. Karis (Physically Based Shading on Mobile, 2014).
fn mirrored(s: Surface, view: vec3f, ambient: vec3f, dull: bool) -> vec3f {
    let facing = saturate(dot(s.normal, view));
    let r = vec4f(-1.0, -0.0275, -0.572, 0.022) * s.roughness + vec4f(1.0, 0.0425, 1.04, -0.04);
    let a = min(r.x * r.x, exp2(-9.28 * facing)) * r.x + r.y;
    let share = vec2f(-1.04, 1.04) * a + r.zw;
    let base = mix(vec3f(0.04), s.albedo, s.metallic);
    if (dull) {
        return ambient * (base * share.x + share.y);
    }
    let ray = reflect(-view, s.normal);
    // Streets stand around: low rays meet walls as bright as the ground, not the horizon.
    let sky = mix(globals.bounce.rgb * 1.2 + ambient * 0.15, sky_gradient(ray), smoothstep(0.0, 0.45, ray.z));
    let blurred = mix(sky, ambient, smoothstep(0.15, 0.75, s.roughness));
    let grazing = 1.0 - facing;
    let coat = s.gloss * (0.045 + 0.955 * (grazing * grazing) * (grazing * grazing) * grazing);
    return blurred * (base * share.x + share.y) * (1.0 - coat) + sky * coat;
}

// Share of light that comes through the air over a way: extinction as at the eye, thinning out above it. Along level
// rays that is Koschmieder's law.
fn clear_share(relative: vec3f, distance: f32) -> f32 {
    let rise = max(relative.z, 0.0) * globals.night_sky.w;
    let thinned = select((1.0 - exp(-rise)) / max(rise, 1e-4), 1.0 - 0.5 * rise, rise < 1e-3);
    return exp(-globals.sun.w * distance * thinned);
}

// Display light, linear sRGB from 0 to 1.
fn shade(hit: Hit) -> vec3f {
    var s = surface_of(hit);
    if ((FEATURES & WITH_WATER) != 0u) {
        s = wetted(hit, s);
    }
    if ((FEATURES & WITH_SNOW) != 0u) {
        s = snowed(hit, s);
    }
    let distance = length(hit.relative);
    let ray = hit.relative / max(distance, 1e-6);
    let sun = globals.sun_direction.xyz;
    let leaves = hit.pattern == 6u && hit.paint < 0.5;
    var color = s.emissive;
    // Leaves let light through: they are lit a little from behind.
    let facing = dot(s.normal, sun);
    if (leaves) {
        let cosine = saturate(facing * 0.7 + 0.3);
        color += s.albedo * globals.sun.rgb * (cosine * sunlit(hit.relative, sun));
    } else if (facing > 0.0 && (hit.pattern != 8u || dot(hit.normal, sun) > 0.0)) {
        // Bumps turn nothing to a sun that is behind the surface.
        color += reflected(s, -ray, sun) * globals.sun.rgb * sunlit(hit.relative, hit.normal);
    }
    // Nooks near the ground see less of the sky.
    let nook = mix(0.72, 1.0, smoothstep(0.0, 1.2, hit.body.z + 2.0 * abs(hit.body_normal.z)));
    let ambient = irradiance(s.normal) * nook;
    // Streets and leaves are too rough to mirror anything, unless they are wet.
    let dull = hit.pattern >= 2u && hit.pattern <= 6u && (FEATURES & WITH_WATER) == 0u;
    color += (s.albedo * (1.0 - s.metallic) * ambient + mirrored(s, -ray, ambient, dull)) * hit.glow.w;
    if ((FEATURES & WITH_LAMPS) != 0u) {
        color += lamp_light(s, hit.relative, -ray);
    }
    return tone_map(mix(haze(ray), color, clear_share(hit.relative, distance)));
}
