// Models of assets by rays: where on its pictures a triangle was met, and what a pixel covers of that.
@group(1) @binding(0) var store: texture_2d_array<f32>;
@group(1) @binding(1) var numbers: texture_2d_array<f32>;
@group(1) @binding(2) var coats: texture_2d<f32>;

// Where a triangle lies on the pictures of its part: its first corner, and the ways along two of its sides.
struct Chart {
    corner: vec2f,
    sides: mat2x2f,
    coat: u32,
    // Of the corners: alphas, and codes of tangents.
    alpha: vec3f,
    tangents: vec3u,
}

fn chart_of(triangle: u32, number: u32) -> Chart {
    let at = pieces[triangle + 4u].w & ADDRESS;
    let p = bitcast<vec4f>(pieces[at + 3u]);
    let last = pieces[at + 4u];
    let r = bitcast<vec3f>(last.xyz);
    let alpha = vec3f(vec3u(last.w, last.w >> 9u, last.w >> 18u) & vec3u(511u)) / 256.0;
    let tangents = vec3u(pieces[at].w, pieces[at + 1u].w, pieces[at + 2u].w);
    return Chart(p.xy, mat2x2f(p.zw - p.xy, r.xy - p.xy), coat_place(instances[number].second.x, r.z), alpha, tangents);
}

// Shares of both sides of a triangle that a way in its plane is.
fn shares_of(one: Triangle, way: vec3f) -> vec2f {
    let plane = cross(one.ab, one.ac);
    return vec2f(dot(cross(way, one.ac), plane), dot(cross(one.ab, way), plane)) / dot(plane, plane);
}

fn within_triangle(share: vec2f) -> vec2f {
    let v = saturate(share.y);
    return vec2f(min(saturate(share.x), 1.0 - v), v);
}

fn alpha_on(chart: Chart, share: vec2f) -> f32 {
    return dot(chart.alpha, vec3f(1.0 - share.x - share.y, share));
}

// The tangent on a triangle, world axes; zeros where its first corner has none.
fn tangent_on(chart: Chart, share: vec2f, scale: vec3f, rotation: vec4f) -> vec4f {
    if (chart.tangents.x == 0u) {
        return vec4f(0.0);
    }
    let told = tangent_of(chart.tangents.x, scale) * (1.0 - share.x - share.y)
        + tangent_of(chart.tangents.y, scale) * share.x + tangent_of(chart.tangents.z, scale) * share.y;
    return vec4f(rotate(rotation, told.xyz), told.w);
}

// The part where a ray met its triangle, its normal there, and how much of it is there.
struct Touched {
    spot: Spot,
    normal: vec3f,
    alpha: f32,
}

fn touched(met: Met, number: u32, triangle: u32, steps: mat2x3f) -> Touched {
    let i = instances[number];
    let one = triangle_at(triangle, i.scale.xyz, i.place.w);
    let chart = chart_of(triangle, number);
    let inverse = vec4f(-i.rotation.xyz, i.rotation.w);
    let across = chart.sides * shares_of(one, rotate(inverse, steps[0]));
    let down = chart.sides * shares_of(one, rotate(inverse, steps[1]));
    let share = within_triangle(shares_of(one, met.body - one.a));
    let place = chart.corner + chart.sides * share;
    let spot = model_spot(chart.coat, model_tint(met.material, i.color.rgb), place, across, down);
    let ways = mat2x3f(rotate(i.rotation, one.ab), rotate(i.rotation, one.ac));
    let tangent = tangent_on(chart, share, i.scale.xyz, i.rotation);
    return Touched(spot, tilted(met.normal, tangent, spot.bump, ways, chart.sides), alpha_on(chart, share) * spot.alpha);
}

// Whether a view ray goes on where it meets a triangle of which there is not all: through a hole, or, where what is thinner than counts is looked for, through what counts, and
// through next to nothing. The ray is in the body frame. A ray of a table is no pixel, and sees the finest level.
fn looks_through(ray: Ray, t: f32, one: Triangle, triangle: u32, number: u32) -> bool {
    let chart = chart_of(triangle, number);
    let picture = picture_at(chart.coat + COLOR_PICTURE);
    var level = 0.0;
    if (!TABLE && picture.row >= 0.0) {
        let rotation = instances[number].rotation;
        let inverse = vec4f(-rotation.xyz, rotation.w);
        let normal = rotate(rotation, normalize(cross(one.ab, one.ac)));
        let steps = steps_of(rotate(rotation, ray.direction), select(t, 1.0, parallel), normal);
        let across = chart.sides * shares_of(one, rotate(inverse, steps[0]));
        let down = chart.sides * shares_of(one, rotate(inverse, steps[1]));
        level = level_of_picture(picture, across, down);
    }
    let share = within_triangle(shares_of(one, ray.origin + ray.direction * t - one.a));
    let alpha = alpha_on(chart, share);
    let place = chart.corner + chart.sides * share;
    let hole = is_hole(chart.coat, alpha, place, level);
    if (FILMS != THIN_FILMS) {
        return hole;
    }
    var seen = alpha;
    if (picture.row >= 0.0) {
        seen *= pictured(true, picture, place, level).a;
    }
    return !hole || seen < FAINTEST;
}

// Whether the sun shines through a hole where its ray meets a triangle so far from the eye: as blurred as a pixel is wide there.
fn shines_through(ray: Ray, t: f32, one: Triangle, triangle: u32, number: u32, distance: f32) -> bool {
    let chart = chart_of(triangle, number);
    let picture = picture_at(chart.coat + COLOR_PICTURE);
    let texels = abs(determinant(chart.sides)) * f32(picture.size.x * picture.size.y);
    let wide = select(distance, 1.0, parallel) / limits.z;
    let covered = wide * wide * texels / max(length(cross(one.ab, one.ac)), 1e-20);
    let level = clamp(0.5 * log2(max(covered, 1e-12)), 0.0, f32(picture.levels - 1u));
    let share = within_triangle(shares_of(one, ray.origin + ray.direction * t - one.a));
    return is_hole(chart.coat, alpha_on(chart, share), chart.corner + chart.sides * share, level);
}
