// Models of assets by rays: where on its picture a triangle was met, and what a pixel covers of that.
@group(1) @binding(0) var store: texture_2d_array<f32>;

// A part where a ray met its triangle.
struct ModelSpot {
    finish: Finish,
    glow: vec3f,
}

fn model_spot(met: Met, number: u32, triangle: u32, steps: mat2x3f) -> ModelSpot {
    let i = instances[number];
    let one = triangle_at(triangle, i.scale.xyz, i.place.w);
    let plane = cross(one.ab, one.ac);
    let square = dot(plane, plane);
    let at = pieces[triangle + 4u].w & 0x0fffffffu;
    let p = bitcast<vec4f>(pieces[at + 3u]);
    let r = bitcast<vec4f>(pieces[at + 4u]);
    let sides = mat2x2f(p.zw - p.xy, r.xy - p.xy);
    let inverse = vec4f(-i.rotation.xyz, i.rotation.w);
    // Shares of both sides, of a way in the plane of the triangle.
    let apart = met.body - one.a;
    let across = rotate(inverse, steps[0]);
    let down = rotate(inverse, steps[1]);
    let share = vec2f(dot(cross(apart, one.ac), plane), dot(cross(one.ab, apart), plane)) / square;
    let a = vec2f(dot(cross(across, one.ac), plane), dot(cross(one.ab, across), plane)) / square;
    let d = vec2f(dot(cross(down, one.ac), plane), dot(cross(one.ab, down), plane)) / square;
    let v = saturate(share.y);
    let place = p.xy + sides * vec2f(min(saturate(share.x), 1.0 - v), v);
    let coat = coat_at(coat_place(i.second.x, r.z));
    let tint = model_tint(met.material, i.color.rgb);
    return ModelSpot(model_finish(coat, tint, place, sides * a, sides * d), model_glow(coat));
}
