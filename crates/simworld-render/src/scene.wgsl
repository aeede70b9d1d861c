// One pass to colour, planar depth and ids. Coordinates are camera-relative, in metres, world axes.

struct View {
    // Rows of the rotation from world axes to the optical frame; w unused.
    right: vec4<f32>,
    down: vec4<f32>,
    forward: vec4<f32>,
    // 2 fx / width, 2 fy / height, 2 cx / width - 1, 2 cy / height - 1
    projection: vec4<f32>,
    // Towards the sun; w is the near plane, m.
    sun: vec4<f32>,
    sun_color: vec4<f32>,
    // Light of the sky from above; w is the extinction of the air, 1/m.
    sky_light: vec4<f32>,
    // Rows of the map from camera-relative points to the shadow map, in [-1, 1]; depth in [0, 1] from the sun.
    shadow_x: vec4<f32>,
    shadow_y: vec4<f32>,
    shadow_z: vec4<f32>,
};

@group(0) @binding(0) var<uniform> view: View;
@group(1) @binding(0) var shadow_map: texture_depth_2d;
@group(1) @binding(1) var shadow_sampler: sampler_comparison;

struct Vertex {
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) part: u32,
    @location(3) x: vec3<f32>,
    @location(4) y: vec3<f32>,
    @location(5) z: vec3<f32>,
    @location(6) origin: vec3<f32>,
    @location(7) size: vec3<f32>,
    @location(8) color: vec3<f32>,
    @location(9) id: u32,
    @location(10) class_id: u32,
    @location(11) look: u32,
};

struct Fragment {
    @builtin(position) clip: vec4<f32>,
    @location(0) point: vec3<f32>,
    @location(1) normal: vec3<f32>,
    // In the body frame, m.
    @location(2) local: vec3<f32>,
    @location(3) local_normal: vec3<f32>,
    @location(4) @interpolate(flat) color: vec3<f32>,
    @location(5) @interpolate(flat) size: vec3<f32>,
    @location(6) @interpolate(flat) part: u32,
    @location(7) @interpolate(flat) id: u32,
    @location(8) @interpolate(flat) class_id: u32,
    @location(9) @interpolate(flat) look: u32,
};

fn place(v: Vertex) -> vec3<f32> {
    return v.x * v.position.x + v.y * v.position.y + v.z * v.position.z + v.origin;
}

@vertex
fn vertex_main(v: Vertex) -> Fragment {
    let point = place(v);
    let optical = vec3(dot(view.right.xyz, point), dot(view.down.xyz, point), dot(view.forward.xyz, point));
    var out: Fragment;
    // Reversed depth with the far plane at infinity: depth = near / distance.
    out.clip = vec4(
        view.projection.x * optical.x + view.projection.z * optical.z,
        -(view.projection.y * optical.y + view.projection.w * optical.z),
        view.sun.w,
        optical.z,
    );
    out.point = point;
    // The axes are scaled by the size, so a normal is divided by its square.
    let s2 = v.size * v.size;
    out.normal = v.x * (v.normal.x / s2.x) + v.y * (v.normal.y / s2.y) + v.z * (v.normal.z / s2.z);
    out.local = v.position * v.size;
    out.local_normal = v.normal;
    out.color = v.color;
    out.size = v.size;
    out.part = v.part;
    out.id = v.id;
    out.class_id = v.class_id;
    out.look = v.look;
    return out;
}

@vertex
fn vertex_shadow(v: Vertex) -> @builtin(position) vec4<f32> {
    let point = vec4(place(v), 1.0);
    return vec4(dot(view.shadow_x, point), dot(view.shadow_y, point), dot(view.shadow_z, point), 1.0);
}

fn sky(direction: vec3<f32>) -> vec3<f32> {
    let up = max(direction.z, 0.0);
    let horizon = vec3(0.62, 0.7, 0.78);
    let zenith = vec3(0.13, 0.3, 0.62);
    let glow = pow(max(dot(direction, view.sun.xyz), 0.0), 24.0);
    let base = mix(horizon, zenith, pow(up, 0.55));
    return (base + vec3(0.35, 0.27, 0.15) * glow) * view.sky_light.rgb * 1.9;
}

fn sunlight(point: vec3<f32>, facing: f32) -> f32 {
    let p = vec4(point, 1.0);
    let map = vec3(dot(view.shadow_x, p), dot(view.shadow_y, p), dot(view.shadow_z, p));
    let uv = vec2(map.x * 0.5 + 0.5, 0.5 - map.y * 0.5);
    let inside = all(abs(map.xy) < vec2(0.99)) && map.z < 1.0;
    let bias = 0.0006 + 0.0018 * (1.0 - clamp(facing, 0.0, 1.0));
    let texel = 1.0 / f32(textureDimensions(shadow_map).x);
    var lit = 0.0;
    for (var dy = -1; dy <= 1; dy++) {
        for (var dx = -1; dx <= 1; dx++) {
            let at = uv + vec2(f32(dx), f32(dy)) * texel;
            lit += textureSampleCompareLevel(shadow_map, shadow_sampler, at, map.z - bias);
        }
    }
    return select(1.0, lit / 9.0, inside);
}

// A hash of two whole numbers to [0, 1].
fn random(p: vec2<f32>) -> f32 {
    return fract(sin(dot(p, vec2(12.9898, 78.233))) * 43758.547);
}

fn facade(in: Fragment) -> vec4<f32> {
    if (in.local_normal.z > 0.5) {
        let edge = min(in.size.x * 0.5 - abs(in.local.x), in.size.y * 0.5 - abs(in.local.y));
        return vec4(select(vec3(0.16, 0.155, 0.15), in.color * 0.8, edge < 0.35), 0.0);
    }
    let front = abs(in.local_normal.x) > 0.5;
    let across = select(in.local.x + in.size.x * 0.5, in.local.y + in.size.y * 0.5, front);
    let width = select(in.size.x, in.size.y, front);
    let bays = max(round(width / 2.8), 1.0);
    let bay = across / width * bays;
    let storey = in.local.z / 3.2;
    let cell = vec2(fract(bay), fract(storey));
    let is_roof_edge = in.local.z > in.size.z - 0.6;
    let number = vec2(floor(bay), floor(storey));
    if (is_roof_edge) {
        return vec4(in.color * 0.7, 0.0);
    }
    if (storey < 1.0 && in.local_normal.x > 0.5) {
        // The ground floor of the front: a door in the middle and shop windows.
        let from_middle = abs(across - width * 0.5);
        if (from_middle < 0.8 && in.local.z < 2.4) {
            return vec4(vec3(0.09, 0.05, 0.03), 0.0);
        }
        if (cell.x > 0.1 && cell.x < 0.9 && in.local.z > 0.5 && in.local.z < 2.6 && from_middle > 1.2) {
            return vec4(vec3(0.06, 0.075, 0.085), 0.6);
        }
        return vec4(in.color * 0.55, 0.0);
    }
    if (cell.x > 0.24 && cell.x < 0.76 && cell.y > 0.28 && cell.y < 0.8) {
        let warm = random(number + vec2(f32(in.id) * 0.37, 0.0));
        let glass = mix(vec3(0.035, 0.05, 0.07), vec3(0.1, 0.115, 0.12), warm);
        return vec4(glass, 0.7);
    }
    let sill = cell.x > 0.2 && cell.x < 0.8 && cell.y > 0.22 && cell.y <= 0.28;
    return vec4(select(in.color, in.color * 1.25, sill), 0.0);
}

// Colour and how much of the sky it mirrors.
fn surface(in: Fragment) -> vec4<f32> {
    switch in.look {
        case 1u: { return facade(in); }
        case 2u: {
            let along = in.size.x * 0.5 - abs(in.local.x);
            let dash = fract(in.local.x / 6.0) < 0.5 && abs(in.local.y) < 0.08 && along > 16.0;
            let edge = abs(abs(in.local.y) - in.size.y * 0.5 + 0.25) < 0.06 && along > 12.0;
            let grain = random(floor(in.local.xy * 9.0)) * 0.012;
            return vec4(select(in.color + grain, vec3(0.55, 0.54, 0.48), dash || edge), 0.02);
        }
        case 3u: {
            let stripe = fract((in.local.x + in.size.x * 0.5) / 1.0) < 0.5;
            return vec4(select(in.color, vec3(0.6, 0.6, 0.57), stripe), 0.02);
        }
        case 4u: {
            let tile = fract(in.local.xy / 1.2);
            let joint = tile.x < 0.03 || tile.y < 0.03;
            let shade = 0.94 + 0.12 * random(floor(in.local.xy / 1.2));
            return vec4(in.color * select(shade, 0.72, joint), 0.0);
        }
        case 5u: {
            let patches = random(floor(in.local.xy / 3.0)) * 0.25 + random(floor(in.local.xy / 0.6)) * 0.15;
            return vec4(in.color * (0.8 + patches), 0.0);
        }
        default: {}
    }
    switch in.part {
        case 1u: { return vec4(0.03, 0.04, 0.05, 0.7); }
        case 2u: { return vec4(0.025, 0.025, 0.027, 0.0); }
        case 3u: {
            let speckle = random(floor(in.local.xz * 14.0) + floor(in.local.yy * 14.0));
            return vec4(in.color * (0.7 + 0.6 * speckle), 0.0);
        }
        case 4u: { return vec4(0.45, 0.27, 0.18, 0.0); }
        case 5u: { return vec4(0.9, 0.86, 0.7, 0.0); }
        case 6u: { return vec4(0.12, 0.075, 0.045, 0.0); }
        case 7u: { return vec4(0.05, 0.06, 0.1, 0.0); }
        default: { return vec4(in.color, 0.08); }
    }
}

struct Output {
    @location(0) color: vec4<f32>,
    @location(1) depth: f32,
    @location(2) ids: vec2<u32>,
};

// Khronos PBR neutral is meant for products; this curve keeps highlights of a street soft (Narkowicz 2015).
fn tone(x: vec3<f32>) -> vec3<f32> {
    return clamp((x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14), vec3(0.0), vec3(1.0));
}

@fragment
fn fragment_main(in: Fragment) -> Output {
    let normal = normalize(in.normal);
    let distance = length(in.point);
    let looking = in.point / max(distance, 1e-6);
    let facing = dot(normal, view.sun.xyz);
    let look = surface(in);
    let sun = max(facing, 0.0) * sunlight(in.point + normal * 0.05, facing);
    let from_sky = 0.5 + 0.5 * normal.z;
    let bounce = vec3(0.12, 0.11, 0.09) * (0.5 - 0.5 * normal.z);
    let ambient = view.sky_light.rgb * from_sky + view.sun_color.rgb * bounce * 0.25;
    var light = look.rgb * (view.sun_color.rgb * sun + ambient);
    let mirror = pow(1.0 - max(dot(-looking, normal), 0.0), 4.0) * 0.9 + 0.1;
    light += sky(reflect(looking, normal)) * look.a * mirror;
    let clear = exp(-view.sky_light.w * distance);
    light = mix(sky(normalize(vec3(looking.xy, 0.02))), light, clear);
    var out: Output;
    out.color = vec4(tone(light), 1.0);
    out.depth = 1.0 / in.clip.w;
    out.ids = vec2(in.id, in.class_id);
    return out;
}

struct SkyFragment {
    @builtin(position) clip: vec4<f32>,
    @location(0) ndc: vec2<f32>,
};

@vertex
fn vertex_sky(@builtin(vertex_index) index: u32) -> SkyFragment {
    let corner = vec2(f32((index << 1u) & 2u), f32(index & 2u)) * 2.0 - 1.0;
    var out: SkyFragment;
    out.clip = vec4(corner, 0.0, 1.0);
    out.ndc = corner;
    return out;
}

@fragment
fn fragment_sky(in: SkyFragment) -> Output {
    let x = (in.ndc.x - view.projection.z) / view.projection.x;
    let y = (-in.ndc.y - view.projection.w) / view.projection.y;
    let direction = normalize(view.right.xyz * x + view.down.xyz * y + view.forward.xyz);
    let veil = exp(-view.sky_light.w * 4000.0 * (0.15 + max(direction.z, 0.0)));
    var out: Output;
    out.color = vec4(tone(mix(sky(normalize(vec3(direction.xy, 0.02))), sky(direction), veil)), 1.0);
    out.depth = bitcast<f32>(0x7f800000u);
    out.ids = vec2(0u, 23u);
    return out;
}
