// Models of assets: how their parts take light, and the pictures on them. Both backends look up the same texels and reckon alike; what a pixel
// covers each of them brings along. The twin of coats.rs.

// First entry of the table in `lights`, behind the sky.
const COATS: u32 = 144u;
// Texels in a row of the store, rows in a layer.
const ROW: u32 = 1024u;

// How a part takes light.
struct Coat {
    roughness: f32,
    metallic: f32,
    // First row of its picture; below zero without one.
    row: f32,
    // What lies beyond its sides, and beyond its top and bottom: 0 it again, 1 mirrored, 2 its edge.
    wrap: vec2u,
    emission: vec3f,
    // Texels each way, and how many levels there are, each of half the size.
    size: vec2u,
    levels: u32,
}

// Entries of a part.
const ENTRIES: u32 = 3u;

// Where the coat of a part of an asset's model stands.
fn coat_place(asset: f32, part: f32) -> u32 {
    return COATS + u32(lights[COATS + u32(asset)].x) + ENTRIES * u32(part);
}

fn coat_at(at: u32) -> Coat {
    let a = lights[at];
    let b = lights[at + 1u];
    let c = lights[at + 2u];
    return Coat(a.x, a.y, a.z, vec2u(u32(a.w) & 3u, u32(a.w) >> 2u), b.xyz, vec2u(c.xy), u32(c.z));
}

// The colour of a vertex: square roots of 10 bits a channel; times the colour of the entity where its part has that.
fn model_tint(material: u32, color: vec3f) -> vec3f {
    let roots = vec3f(vec3u(material >> 20u, material >> 10u, material) & vec3u(1023u)) / 1023.0;
    return roots * roots * select(vec3f(1.0), color, (material & 0x40000000u) != 0u);
}

// Linear light: the format of the store says that it is sRGB.
fn texel_at(first: u32, size: vec2u, at: vec2i) -> vec3f {
    let index = first + u32(at.y) * size.x + u32(at.x);
    return textureLoad(store, vec2u(index % ROW, (index / ROW) % ROW), index / (ROW * ROW), 0).rgb;
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
fn blended(first: u32, size: vec2u, place: vec2f, wrap: vec2u) -> vec3f {
    let at = place * vec2f(size) - 0.5;
    let low = floor(at);
    let part = at - low;
    let count = vec2i(size);
    let x = vec2i(neighbour(i32(low.x), count.x, wrap.x), neighbour(i32(low.x) + 1, count.x, wrap.x));
    let y = vec2i(neighbour(i32(low.y), count.y, wrap.y), neighbour(i32(low.y) + 1, count.y, wrap.y));
    let above = mix(texel_at(first, size, vec2i(x.x, y.x)), texel_at(first, size, vec2i(x.y, y.x)), part.x);
    let below = mix(texel_at(first, size, vec2i(x.x, y.y)), texel_at(first, size, vec2i(x.y, y.y)), part.x);
    return mix(above, below, part.y);
}

// The picture of a coat at a place, as blurred as a pixel is wide there: from pixel to pixel the place goes by `across` and `down`.
fn pictured(coat: Coat, place: vec2f, across: vec2f, down: vec2f) -> vec3f {
    let a = across * vec2f(coat.size);
    let b = down * vec2f(coat.size);
    let most = f32(coat.levels - 1u);
    let level = clamp(0.5 * log2(max(max(dot(a, a), dot(b, b)), 1e-12)), 0.0, most);
    let fine = min(u32(level), coat.levels - 1u);
    var first = u32(coat.row) * ROW;
    var size = coat.size;
    for (var k = 0u; k < fine; k++) {
        first += size.x * size.y;
        size = max(size / 2u, vec2u(1u));
    }
    let within = vec2f(folded(place.x, coat.wrap.x), folded(place.y, coat.wrap.y));
    let color = blended(first, size, within, coat.wrap);
    let rest = level - f32(fine);
    if (rest <= 0.0 || fine + 1u >= coat.levels) {
        return color;
    }
    let coarse = blended(first + size.x * size.y, max(size / 2u, vec2u(1u)), within, coat.wrap);
    return mix(color, coarse, rest);
}

// What a part is made of at a place on its picture.
fn model_finish(coat: Coat, tint: vec3f, place: vec2f, across: vec2f, down: vec2f) -> Finish {
    var albedo = tint;
    if (coat.row >= 0.0) {
        albedo *= pictured(coat, place, across, down);
    }
    return Finish(albedo, 0.0, 0.0, coat.roughness, coat.metallic);
}

// Its own light, which is seen by day as little as that of a lamp's glass.
fn model_glow(coat: Coat) -> vec3f {
    return coat.emission * (0.15 + 1.6 * globals.sun_direction.w);
}
