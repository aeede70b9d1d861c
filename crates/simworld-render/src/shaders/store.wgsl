// The pictures of models as the raster backend binds them.
@group(2) @binding(0) var store: texture_2d_array<f32>;
@group(2) @binding(1) var numbers: texture_2d_array<f32>;
@group(2) @binding(2) var coats: texture_2d<f32>;

// Of a vertex of a model, its place on the pictures, the part, and how much is there: the unit of models is zero, so these stand where other meshes
// have their offsets, alpha as what lacks of it, by half, behind the number of the part.
struct Laid {
    place: vec2f,
    part: f32,
    alpha: f32,
}

fn laid_at(offset: vec3f) -> Laid {
    let part = floor(offset.z);
    return Laid(offset.xy, part, 1.0 - 2.0 * (offset.z - part));
}

// Whether there is nothing of what is cut out, where from pixel to pixel the place goes by `across` and `down`.
fn falls_away(coat: u32, alpha: f32, place: vec2f, across: vec2f, down: vec2f) -> bool {
    let picture = picture_at(coat + COLOR_PICTURE);
    return is_hole(coat, alpha, place, level_of_picture(picture, across, down));
}
