// Models of assets: how their parts take light, place by place.

// The colour of a vertex: square roots of 10 bits a channel; times the colour of the entity where its part has that.
fn model_tint(material: u32, color: vec3f) -> vec3f {
    let roots = vec3f(vec3u(material >> 20u, material >> 10u, material) & vec3u(1023u)) / 1023.0;
    return roots * roots * select(vec3f(1.0), color, (material & 0x40000000u) != 0u);
}

// What a part is at a place on its pictures.
struct Spot {
    finish: Finish,
    // Its own light, which is seen by day as little as that of a lamp's glass; w: the share of the sky's light that comes there.
    glow: vec4f,
}

fn model_spot(coat: u32, tint: vec3f, place: vec2f, across: vec2f, down: vec2f) -> Spot {
    let first = coat_entry(coat);
    let light = coat_entry(coat + 1u);
    var albedo = tint;
    let picture = picture_at(coat + COLOR_PICTURE);
    if (picture.row >= 0.0) {
        albedo *= pictured(true, picture, place, level_of_picture(picture, across, down)).rgb;
    }
    return Spot(Finish(albedo, 0.0, 0.0, first.x, first.y), vec4f(light.rgb * (0.15 + 1.6 * globals.sun_direction.w), 1.0));
}
