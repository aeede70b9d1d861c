// The pictures of models: what a table says of each part, and the texels of its pictures. Both backends look up the same texels and reckon
// alike; what a pixel covers each of them brings along. The twin of coats.rs and gpu/texels.rs, which bind `store` (colours, in linear light),
// `numbers` (the same texels as they are) and `coats`.

// Texels in a row of the store, rows in a layer; entries in a row of the table.
const ROW: u32 = 1024u;
// Entries of a part.
const ENTRIES: u32 = 12u;
// Of these, where its pictures stand, and how much has to be there at each level of the first of them.
const COLOR_PICTURE: u32 = 2u;
const METAL_PICTURE: u32 = 3u;
// How far shade counts, and how steep bumps are.
const SCALES: u32 = 7u;
const CUTOFFS: u32 = 8u;

fn coat_entry(at: u32) -> vec4f {
    return textureLoad(coats, vec2u(at % ROW, at / ROW), 0);
}

// Where the coat of a part of an asset's model stands.
fn coat_place(asset: f32, part: f32) -> u32 {
    return u32(coat_entry(u32(asset)).x) + ENTRIES * u32(part);
}

// A picture of a part.
struct Picture {
    // First row; below zero without one.
    row: f32,
    // Texels each way, and how many levels there are, each of half the size.
    size: vec2u,
    levels: u32,
    // What lies beyond its sides, and beyond its top and bottom: 0 it again, 1 mirrored, 2 its edge.
    wrap: vec2u,
}

fn picture_at(at: u32) -> Picture {
    let e = coat_entry(at);
    let code = u32(e.w);
    return Picture(e.x, vec2u(e.yz), code >> 4u, vec2u(code & 3u, (code >> 2u) & 3u));
}

fn texel_at(is_color: bool, first: u32, size: vec2u, at: vec2i) -> vec4f {
    let index = first + u32(at.y) * size.x + u32(at.x);
    let place = vec2u(index % ROW, (index / ROW) % ROW);
    if (is_color) {
        return textureLoad(store, place, index / (ROW * ROW), 0);
    }
    return textureLoad(numbers, place, index / (ROW * ROW), 0);
}

// A coordinate brought into [0, 1].
fn folded(place: f32, wrap: u32) -> f32 {
    if (wrap == 2u) {
        return saturate(place);
    }
    if (wrap == 1u) {
        return 1.0 - abs(1.0 - (place - 2.0 * floor(place * 0.5)));
    }
    return place - floor(place);
}

// The texel of a coordinate that may be one beyond an edge.
fn neighbour(at: i32, count: i32, wrap: u32) -> i32 {
    return clamp(select(at, (at + count) % count, wrap == 0u), 0, count - 1);
}

// Between the four texels around a place.
fn blended(is_color: bool, first: u32, size: vec2u, place: vec2f, wrap: vec2u) -> vec4f {
    let at = place * vec2f(size) - 0.5;
    let low = floor(at);
    let part = at - low;
    let count = vec2i(size);
    let x = vec2i(neighbour(i32(low.x), count.x, wrap.x), neighbour(i32(low.x) + 1, count.x, wrap.x));
    let y = vec2i(neighbour(i32(low.y), count.y, wrap.y), neighbour(i32(low.y) + 1, count.y, wrap.y));
    let above = mix(texel_at(is_color, first, size, vec2i(x.x, y.x)), texel_at(is_color, first, size, vec2i(x.y, y.x)), part.x);
    let below = mix(texel_at(is_color, first, size, vec2i(x.x, y.y)), texel_at(is_color, first, size, vec2i(x.y, y.y)), part.x);
    return mix(above, below, part.y);
}

// At which level a picture is as blurred as a pixel is wide: from pixel to pixel the place goes by `across` and `down`.
fn level_of_picture(picture: Picture, across: vec2f, down: vec2f) -> f32 {
    let a = across * vec2f(picture.size);
    let b = down * vec2f(picture.size);
    return clamp(0.5 * log2(max(max(dot(a, a), dot(b, b)), 1e-12)), 0.0, f32(picture.levels - 1u));
}

// A picture at a place, at a level of it.
fn pictured(is_color: bool, picture: Picture, place: vec2f, level: f32) -> vec4f {
    let fine = min(u32(level), picture.levels - 1u);
    var first = u32(picture.row) * ROW;
    var size = picture.size;
    for (var k = 0u; k < fine; k++) {
        first += size.x * size.y;
        size = max(size / 2u, vec2u(1u));
    }
    let within = vec2f(folded(place.x, picture.wrap.x), folded(place.y, picture.wrap.y));
    let color = blended(is_color, first, size, within, picture.wrap);
    let rest = level - f32(fine);
    if (rest <= 0.0 || fine + 1u >= picture.levels) {
        return color;
    }
    let coarse = blended(is_color, first + size.x * size.y, max(size / 2u, vec2u(1u)), within, picture.wrap);
    return mix(color, coarse, rest);
}

// How much has to be there at a level of the picture of its colour, so that as much of the part is there as at the finest.
fn cutoff_at(coat: u32, level: f32) -> f32 {
    let fine = u32(level);
    let a = coat_entry(coat + CUTOFFS + (fine >> 2u))[fine & 3u];
    let next = min(fine + 1u, 15u);
    let b = coat_entry(coat + CUTOFFS + (next >> 2u))[next & 3u];
    return mix(a, b, level - f32(fine));
}

// Less of what is blended changes no eighth bit of a colour.
const FAINTEST: f32 = 0.002;

// Whether there is nothing of a part that is cut out, where its vertices have so much alpha and its picture is seen at that level.
fn is_hole(coat: u32, alpha: f32, place: vec2f, level: f32) -> bool {
    let cutoff = coat_entry(coat).w;
    let picture = picture_at(coat + COLOR_PICTURE);
    if (picture.row < 0.0) {
        return alpha < cutoff;
    }
    return cutoff >= 0.0 && alpha * pictured(true, picture, place, level).a < cutoff_at(coat, level);
}
