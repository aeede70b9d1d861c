//! Models and files for tests of imports.
// each test file uses its part, and what fails here fails the test
#![allow(unreachable_pub, clippy::unwrap_used)]

use serde_json::{Value, json};
use simworld_agents::assets::{ImportConfig, ImportError, Imported, Thing, import_glb};
use simworld_core::asset::{Model, ModelPart, ModelVertex};
use simworld_core::ops;

pub const RED: [f32; 3] = [0.5, 0.02, 0.02];

/// A model of one part; the importer makes the normals and the hulls.
pub fn model(points: &[[f32; 3]], triangles: &[[u32; 3]]) -> Model {
    let vertex =
        |position: &[f32; 3]| ModelVertex { position: *position, color: RED, ..ModelVertex::default() };
    Model {
        vertices: points.iter().map(vertex).collect(),
        triangles: triangles.to_vec(),
        parts: vec![ModelPart {
            name: "all".into(),
            triangles: triangles.len() as u32,
            ..ModelPart::default()
        }],
        ..Model::default()
    }
}

/// A box between two corners: eight points, twelve triangles that look outward.
pub fn cuboid(low: [f32; 3], high: [f32; 3]) -> Model {
    let points: Vec<[f32; 3]> = (0..8)
        .map(|corner| {
            std::array::from_fn(|axis| if corner >> axis & 1 == 0 { low[axis] } else { high[axis] })
        })
        .collect();
    let sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles: Vec<[u32; 3]> =
        sides.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
    model(&points, &triangles)
}

/// Several models as one, each a part.
pub fn together(models: &[Model]) -> Model {
    let mut all = Model::default();
    for model in models {
        let first = all.vertices.len() as u32;
        all.vertices.extend(&model.vertices);
        all.triangles.extend(model.triangles.iter().map(|triangle| triangle.map(|vertex| first + vertex)));
        all.parts.extend(model.parts.iter().cloned());
    }
    all
}

/// A table of a top and four legs that stand 2 cm below it, so that no two parts touch.
pub fn table() -> Model {
    let leg = |x: f32, y: f32| cuboid([x, y, 0.0], [x + 0.06, y + 0.06, 0.68]);
    together(&[
        cuboid([0.0, 0.0, 0.7], [0.8, 1.2, 0.75]),
        leg(0.0, 0.0),
        leg(0.74, 0.0),
        leg(0.0, 1.14),
        leg(0.74, 1.14),
    ])
}

/// A ball of about as many triangles, with dents, closed.
pub fn dented_ball(triangles: usize, radius: f64) -> Model {
    let rings = ((triangles as f64 / 4.0).sqrt() as usize).max(3);
    let around = rings * 2;
    let place = |ring: usize, step: usize| {
        let (polar, turn) = (
            std::f64::consts::PI * ring as f64 / rings as f64,
            std::f64::consts::TAU * step as f64 / around as f64,
        );
        let reach = radius * (1.0 + 0.12 * ops::sin(5.0 * turn) * ops::sin(3.0 * polar));
        let ((out, up), (side, ahead)) = (ops::sin_cos(polar), ops::sin_cos(turn));
        let at = [out * ahead, out * side, up];
        at.map(|part| (part * reach) as f32)
    };
    let mut points = vec![[0.0, 0.0, radius as f32], [0.0, 0.0, -radius as f32]];
    points.extend((1..rings).flat_map(|ring| (0..around).map(move |step| place(ring, step))));
    let at = |ring: usize, step: usize| (2 + (ring - 1) * around + step % around) as u32;
    let mut faces = Vec::new();
    for step in 0..around {
        faces.push([0, at(1, step), at(1, step + 1)]);
        faces.push([1, at(rings - 1, step + 1), at(rings - 1, step)]);
        for ring in 1..rings - 1 {
            let [a, b, c, d] =
                [at(ring, step), at(ring + 1, step), at(ring + 1, step + 1), at(ring, step + 1)];
            faces.extend([[a, b, c], [a, c, d]]);
        }
    }
    model(&points, &faces)
}

/// A GLB file of any JSON and any bytes, with lengths that are right.
pub fn container(document: &Value, bytes: &[u8]) -> Vec<u8> {
    let mut text = document.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    let mut bytes = bytes.to_vec();
    bytes.resize(bytes.len().next_multiple_of(4), 0);
    let words = |words: &[u32]| words.iter().flat_map(|word| word.to_le_bytes()).collect::<Vec<u8>>();
    let length = (28 + text.len() + bytes.len()) as u32;
    [
        words(&[0x4654_6C67, 2, length, text.len() as u32, 0x4E4F_534A]),
        text,
        words(&[bytes.len() as u32, 0x004E_4942]),
        bytes,
    ]
    .concat()
}

/// The JSON and the bytes of one mesh: positions, then indices of 32 bits.
pub fn plain(points: &[[f32; 3]], indices: &[u32]) -> (Value, Vec<u8>) {
    let mut bytes: Vec<u8> = points.as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect();
    let split = bytes.len();
    bytes.extend(indices.iter().flat_map(|x| x.to_le_bytes()));
    let document = json!({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": points.len(), "type": "VEC3"},
            {"bufferView": 1, "componentType": 5125, "count": indices.len(), "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteLength": split},
            {"buffer": 0, "byteOffset": split, "byteLength": bytes.len() - split},
        ],
        "buffers": [{"byteLength": bytes.len()}],
    });
    (document, bytes)
}

/// The JSON and the bytes of a model, as other programs write them: in the axes of glTF, positions and indices alone.
pub fn plain_model(model: &Model) -> (Value, Vec<u8>) {
    let points: Vec<[f32; 3]> =
        model.vertices.iter().map(|vertex| vertex.position).map(|[x, y, z]| [y, z, x]).collect();
    plain(&points, model.triangles.as_flattened())
}

pub fn thing(words: &str) -> Thing {
    Thing { name: "thing".into(), words: words.into(), ..Thing::default() }
}

pub fn import(bytes: &[u8], words: &str) -> Result<Imported, ImportError> {
    import_glb(bytes, &thing(words), &ImportConfig::default())
}

/// The JSON and the bytes of a bar of two bones that bends: 0.4 by 0.4 and 2 m high in the axes of glTF (y up), its foot on one
/// joint, its head on another at 1 m, which an animation turns by a quarter about z from second 1 to second 3.
pub fn bending_bar(interpolation: &str) -> (Value, Vec<u8>) {
    let mut bar = plain_model(&cuboid([-0.2, -0.2, 0.0], [0.2, 0.2, 2.0]));
    let heads: Vec<u8> = cuboid([-0.2, -0.2, 0.0], [0.2, 0.2, 2.0])
        .vertices
        .iter()
        .map(|vertex| u8::from(vertex.position[2] > 1.0))
        .collect();
    let floats = |numbers: &[f32]| numbers.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<u8>>();
    let unit =
        |shift: f32| [1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, shift, 0.0, 1.0];
    let (rest, turned) = ([0.0, 0.0, 0.0, 1.0], [0.0, 0.0, 0.5f32.sqrt(), 0.5f32.sqrt()]);
    let flat = [0.0; 4];
    let keys: Vec<[f32; 4]> = match interpolation {
        "CUBICSPLINE" => vec![flat, rest, flat, flat, turned, flat],
        _ => vec![rest, turned],
    };
    let columns: [(Vec<u8>, u32, usize, &str); 5] = [
        (heads.iter().flat_map(|joint| [*joint, 0, 0, 0]).collect(), 5121, 8, "VEC4"),
        (floats(&[1.0, 0.0, 0.0, 0.0].repeat(8)), 5126, 8, "VEC4"),
        (floats(&[unit(0.0), unit(-1.0)].concat()), 5126, 2, "MAT4"),
        (floats(&[1.0, 3.0]), 5126, 2, "SCALAR"),
        (floats(keys.as_flattened()), 5126, keys.len(), "VEC4"),
    ];
    for (column, (more, kind, count, shape)) in columns.into_iter().enumerate() {
        let (document, bytes) = (&mut bar.0, &mut bar.1);
        let view = json!({"buffer": 0, "byteOffset": bytes.len(), "byteLength": more.len()});
        document["bufferViews"].as_array_mut().unwrap().push(view);
        let accessor =
            json!({"bufferView": column + 2, "componentType": kind, "count": count, "type": shape});
        document["accessors"].as_array_mut().unwrap().push(accessor);
        bytes.extend(more);
        document["buffers"][0]["byteLength"] = json!(bytes.len());
    }
    let document = &mut bar.0;
    document["meshes"][0]["primitives"][0]["attributes"]["JOINTS_0"] = json!(2);
    document["meshes"][0]["primitives"][0]["attributes"]["WEIGHTS_0"] = json!(3);
    // Where the node of a skin stands is nothing to it.
    document["nodes"] = json!([
        {"mesh": 0, "skin": 0, "translation": [50.0, 0.0, 0.0]},
        {"children": [2]},
        {"translation": [0.0, 1.0, 0.0]},
    ]);
    document["scenes"] = json!([{"nodes": [0, 1]}]);
    document["skins"] = json!([{"joints": [1, 2], "inverseBindMatrices": 4}]);
    document["animations"] = json!([{
        "channels": [{"sampler": 0, "target": {"node": 2, "path": "rotation"}}],
        "samplers": [{"input": 5, "output": 6, "interpolation": interpolation}],
    }]);
    bar
}

/// A slab whose left half looks at the left half of a picture, as one mesh of two boxes that share no vertex.
pub fn painted_document(picture: &[u8]) -> (Value, Vec<u8>) {
    let slab =
        together(&[cuboid([0.0, 0.0, 0.0], [0.5, 0.6, 0.5]), cuboid([0.0, 0.7, 0.0], [0.5, 1.3, 0.5])]);
    let (mut document, mut bytes) = plain_model(&slab);
    let places: Vec<f32> =
        (0..16).flat_map(|vertex| if vertex < 8 { [0.25, 0.5] } else { [0.75, 0.5] }).collect();
    let add = |document: &mut Value, bytes: &mut Vec<u8>, more: &[u8]| {
        document["bufferViews"]
            .as_array_mut()
            .unwrap()
            .push(json!({"buffer": 0, "byteOffset": bytes.len(), "byteLength": more.len()}));
        bytes.extend(more);
        document["buffers"][0]["byteLength"] = json!(bytes.len());
    };
    let places: Vec<u8> = places.iter().flat_map(|x| x.to_le_bytes()).collect();
    add(&mut document, &mut bytes, &places);
    add(&mut document, &mut bytes, picture);
    document["accessors"]
        .as_array_mut()
        .unwrap()
        .push(json!({"bufferView": 2, "componentType": 5126, "count": 16, "type": "VEC2"}));
    document["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = json!(2);
    document["meshes"][0]["primitives"][0]["material"] = json!(0);
    document["materials"] = json!([{"pbrMetallicRoughness": {
        "baseColorFactor": [0.5, 1.0, 1.0, 1.0], "baseColorTexture": {"index": 0}}}]);
    document["textures"] = json!([{"source": 0}]);
    document["images"] = json!([{"bufferView": 3, "mimeType": "image/png"}]);
    (document, bytes)
}

/// The same as a file.
pub fn painted(picture: &[u8]) -> Vec<u8> {
    let (document, bytes) = painted_document(picture);
    container(&document, &bytes)
}

/// Red on the left, and sRGB 188 of blue on the right.
pub fn halves() -> Vec<u8> {
    let mut png = Vec::new();
    let mut encoder = png::Encoder::new(&mut png, 2, 1);
    encoder.set_color(png::ColorType::Rgb);
    encoder.write_header().unwrap().write_image_data(&[255, 0, 0, 0, 0, 188]).unwrap();
    png
}
