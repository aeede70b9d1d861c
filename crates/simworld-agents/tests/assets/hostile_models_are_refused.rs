//! Files of strangers: whatever bytes they are, they are a surface or a typed error; nothing outside of them is read, and no
//! more memory is taken than the limits allow.
#![cfg(feature = "assets")]
// what fails in a helper fails the test
#![allow(clippy::unwrap_used)]

use crate::assets_common::{container, cuboid, dented_ball, import, plain_model, table, thing};
use proptest::prelude::*;
use serde_json::{Value, json};
use simworld_agents::assets::{GlbError, GlbLimits, ImportConfig, export_glb, import_glb, read_glb};

fn read(bytes: &[u8]) -> Result<simworld_agents::assets::Surface, GlbError> {
    read_glb(bytes, &GlbLimits::default())
}

/// The error of a cube whose document was spoilt.
fn spoilt(spoil: impl FnOnce(&mut Value)) -> GlbError {
    let (mut document, bytes) = plain_model(&cuboid([0.0; 3], [1.0; 3]));
    spoil(&mut document);
    read(&container(&document, &bytes)).unwrap_err()
}

/// The error of a cube with four bytes of its file replaced.
fn with_word(at: usize, word: u32) -> GlbError {
    let mut bytes = export_glb(&cuboid([0.0; 3], [1.0; 3]));
    bytes[at..at + 4].copy_from_slice(&word.to_le_bytes());
    read(&bytes).unwrap_err()
}

#[test]
fn lengths_that_lie_are_refused() {
    // The header's and the chunk's: 4 GB, nothing, less than a header.
    for (at, word) in
        [(8, u32::MAX), (8, 0), (8, 11), (12, u32::MAX), (12, u32::MAX - 7), (0, 7), (4, 1), (4, 3)]
    {
        let error = with_word(at, word);
        assert!(matches!(error, GlbError::Container(_)), "{at} {word}: {error}");
    }
    assert!(matches!(with_word(16, 0x004E_4942), GlbError::Container(_)), "bytes before JSON");
    assert!(matches!(with_word(12, 0), GlbError::Json(_) | GlbError::Container(_)));
    let whole = export_glb(&cuboid([0.0; 3], [1.0; 3]));
    for length in 0..whole.len() {
        assert!(read(&whole[..length]).is_err(), "the first {length} bytes");
        // With a header that tells of the loss.
        let mut cut = whole[..length].to_vec();
        if length >= 12 {
            cut[8..12].copy_from_slice(&(length as u32).to_le_bytes());
        }
        assert!(read(&cut).is_err(), "the first {length} bytes, as the header says");
    }
}

#[test]
fn no_address_is_followed() {
    // What is there can be told apart from what is not by nobody who reads the error.
    let here = std::env::current_exe().unwrap().display().to_string();
    let data = "data:application/octet-stream;base64,AAAA";
    for uri in [here.as_str(), "file:///etc/passwd", "../../../etc/passwd", "http://127.0.0.1:9/x", data, ""]
    {
        let error = spoilt(|document| document["buffers"][0]["uri"] = json!(uri));
        assert!(matches!(error, GlbError::Elsewhere { what: "buffer", index: 0, .. }), "{uri}: {error}");
        let error = spoilt(|document| document["images"] = json!([{"uri": uri}]));
        assert!(matches!(error, GlbError::Elsewhere { what: "image", index: 0, .. }), "{uri}: {error}");
    }
    let long = "x".repeat(100_000);
    let error = spoilt(|document| document["buffers"][0]["uri"] = json!(long));
    assert!(error.to_string().len() < 300, "an error repeats no books");
}

#[test]
fn what_refers_to_nothing_is_refused() {
    type Spoil = fn(&mut Value);
    let missing: [Spoil; 8] = [
        |document| document["scene"] = json!(7),
        |document| document["scenes"] = json!([]),
        |document| document["scenes"][0]["nodes"] = json!([0, u32::MAX]),
        |document| document["nodes"][0]["mesh"] = json!(usize::MAX),
        |document| document["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = json!(99),
        |document| document["meshes"][0]["primitives"][0]["material"] = json!(3),
        |document| document["accessors"][0]["bufferView"] = json!(1_000_000),
        |document| document["bufferViews"][1]["buffer"] = json!(5),
    ];
    for (index, spoil) in missing.into_iter().enumerate() {
        let error = spoilt(spoil);
        assert!(matches!(error, GlbError::Missing { .. }), "{index}: {error}");
    }
    let bounds: [Spoil; 7] = [
        |document| document["bufferViews"][0]["byteLength"] = json!(u64::MAX),
        |document| document["bufferViews"][0]["byteOffset"] = json!(u64::MAX),
        |document| document["accessors"][0]["count"] = json!(9),
        |document| document["accessors"][1]["byteOffset"] = json!(u64::MAX - 3),
        |document| document["accessors"][1]["count"] = json!(u64::MAX / 4),
        |document| document["bufferViews"][0]["byteStride"] = json!(u64::MAX),
        |document| document["buffers"][0]["byteLength"] = json!(4),
    ];
    for (index, spoil) in bounds.into_iter().enumerate() {
        let error = spoilt(spoil);
        assert!(matches!(error, GlbError::Bounds { .. }), "{index}: {error}");
    }
    let (document, mut bytes) = plain_model(&cuboid([0.0; 3], [1.0; 3]));
    let last = bytes.len() - 4;
    bytes[last..].copy_from_slice(&8u32.to_le_bytes());
    let error = read(&container(&document, &bytes)).unwrap_err();
    assert!(matches!(error, GlbError::Missing { what: "vertex", index: 8, count: 8 }), "{error}");
    // Views may lie over each other: this reads the indices as positions, within the bytes.
    let error = spoilt(|document| {
        document["bufferViews"][0]["byteOffset"] = json!(48);
        document["bufferViews"][1] = document["bufferViews"][0].clone();
        document["accessors"][1]["count"] = json!(24);
    });
    assert!(matches!(error, GlbError::Missing { what: "vertex", .. }), "{error}");
}

#[test]
fn what_is_not_read_is_refused_and_says_so() {
    type Spoil = fn(&mut Value);
    let refused: [Spoil; 11] = [
        |document| document["accessors"][0]["sparse"] = json!({"count": 1}),
        |document| drop(document["accessors"][0].as_object_mut().unwrap().remove("bufferView")),
        |document| document["accessors"][0]["componentType"] = json!(5122),
        |document| document["accessors"][0]["type"] = json!("VEC2"),
        |document| document["accessors"][1]["componentType"] = json!(5126),
        |document| document["accessors"][1]["count"] = json!(0),
        |document| document["accessors"][1]["count"] = json!(35),
        |document| document["bufferViews"][0]["byteStride"] = json!(8),
        |document| document["meshes"][0]["primitives"][0]["mode"] = json!(1),
        |document| document["meshes"][0]["primitives"][0]["targets"] = json!([{"POSITION": 0}]),
        |document| document["meshes"][0]["primitives"][0]["attributes"] = json!({}),
    ];
    for (index, spoil) in refused.into_iter().enumerate() {
        let error = spoilt(spoil);
        assert!(matches!(error, GlbError::Unsupported { .. }), "{index}: {error}");
    }
    let error = spoilt(|document| {
        document["extensionsRequired"] = json!(["KHR_texture_transform", "KHR_draco_mesh_compression"]);
    });
    assert_eq!(error, GlbError::Extension { name: "KHR_draco_mesh_compression".into() });
    let unread: [Spoil; 5] = [
        |document| document["asset"]["version"] = json!("1.0"),
        |document| document["nodes"] = json!("none"),
        |document| document["accessors"][0]["count"] = json!(-1),
        |document| document["accessors"][0]["byteOffset"] = json!(0.5),
        |document| *document = json!([]),
    ];
    for (index, spoil) in unread.into_iter().enumerate() {
        let error = spoilt(spoil);
        assert!(matches!(error, GlbError::Json(_)), "{index}: {error}");
    }
    let deep = format!("{}{}", "[".repeat(100_000), "]".repeat(100_000));
    let (document, bytes) = plain_model(&cuboid([0.0; 3], [1.0; 3]));
    let text = document.to_string().replacen('{', &format!("{{\"extras\":{deep},"), 1);
    let mut file = container(&Value::Null, &bytes);
    file.splice(20..24, text.bytes().chain(std::iter::repeat_n(b' ', text.len().wrapping_neg() % 4)));
    let json_length = (text.len().next_multiple_of(4) as u32).to_le_bytes();
    file[12..16].copy_from_slice(&json_length);
    let length = (file.len() as u32).to_le_bytes();
    file[8..12].copy_from_slice(&length);
    assert!(read(&file).is_ok(), "what is passed over may be as deep as it likes");
}

#[test]
fn trees_end() {
    let tree = |nodes: Value, roots: Value| {
        spoilt(|document| {
            document["nodes"] = nodes;
            document["scenes"][0]["nodes"] = roots;
        })
    };
    for (nodes, roots) in [
        (json!([{"children": [0], "mesh": 0}]), json!([0])),
        (json!([{"children": [1]}, {"children": [2]}, {"children": [1], "mesh": 0}]), json!([0])),
        (json!([{"mesh": 0}]), json!([0, 0])),
        (json!([{"children": [2]}, {"children": [2]}, {"mesh": 0}]), json!([0, 1])),
    ] {
        let error = tree(nodes, roots);
        assert!(matches!(error, GlbError::Tree { .. }), "{error}");
    }
    let deep: Vec<Value> =
        (1..=200).map(|child| json!({"children": [child]})).chain([json!({"mesh": 0})]).collect();
    assert!(matches!(tree(json!(deep), json!([0])), GlbError::Tree { node: 64, .. }));
    for spoil in [
        json!([{"mesh": 0, "scale": [1e300, 1e300, 1e300]}]),
        json!([{"mesh": 0, "translation": [1e10, 0.0, 0.0]}]),
        json!([{"mesh": 0, "rotation": [0.0, 0.0, 0.0, 0.0]}]),
        json!([{"children": [1], "scale": [1e200, 1, 1]}, {"mesh": 0, "scale": [1e200, 1, 1]}]),
    ] {
        let error = tree(spoil, json!([0]));
        assert!(matches!(error, GlbError::Number { .. }), "{error}");
    }
    assert_eq!(tree(json!([{}]), json!([0])), GlbError::Empty);
}

#[test]
fn little_files_do_not_become_large() {
    // A thousand nodes that show one mesh of a thousand triangles.
    let (mut document, bytes) = plain_model(&dented_ball(1000, 1.0));
    document["nodes"] = json!(vec![json!({"mesh": 0}); 1000]);
    document["scenes"][0]["nodes"] = json!((0..1000).collect::<Vec<u32>>());
    let error = read(&container(&document, &bytes)).unwrap_err();
    assert!(matches!(error, GlbError::TooMany { what: "triangles", most: 200_000, .. }), "{error}");
    // And one of many vertices and one triangle.
    document["accessors"][1]["count"] = json!(3);
    let few = GlbLimits { vertices: 10_000, ..GlbLimits::default() };
    let error = read_glb(&container(&document, &bytes), &few).unwrap_err();
    assert!(matches!(error, GlbError::TooMany { what: "vertices", most: 10_000, .. }), "{error}");
    document["nodes"] = json!(vec![json!({}); 10_001]);
    let error = read(&container(&document, &bytes)).unwrap_err();
    assert!(matches!(error, GlbError::TooMany { what: "nodes", .. }), "{error}");
    let tiny = GlbLimits { bytes: 100, ..GlbLimits::default() };
    assert!(matches!(
        read_glb(&[0; 101], &tiny),
        Err(GlbError::TooMany { what: "bytes", got: 101, most: 100 })
    ));
    let no_json = GlbLimits { json: 10, ..GlbLimits::default() };
    let error = read_glb(&export_glb(&table()), &no_json).unwrap_err();
    assert!(matches!(error, GlbError::TooMany { what: "bytes of JSON", .. }), "{error}");
}

#[test]
fn numbers_that_are_none_are_refused() {
    for bits in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 3e38] {
        let (document, mut bytes) = plain_model(&cuboid([0.0; 3], [1.0; 3]));
        bytes[12..16].copy_from_slice(&bits.to_le_bytes());
        let error = read(&container(&document, &bytes)).unwrap_err();
        assert!(matches!(error, GlbError::Number { .. }), "{bits}: {error}");
    }
}

#[test]
fn many_large_triangles_take_no_longer_than_few() {
    // Each spans the whole: in a grid of 128 cells a side, a box around each would be two million cells.
    let mut model = cuboid([0.0; 3], [1.0; 3]);
    for layer in 0..1500u16 {
        let first = model.vertices.len() as u32;
        let at = f32::from(layer) / 1500.0;
        for position in [[0.0, at, 0.0], [1.0, 1.0 - at, at], [at, 1.0, 1.0]] {
            model.vertices.push(simworld_core::asset::ModelVertex { position, ..model.vertices[0] });
        }
        model.triangles.push([first, first + 1, first + 2]);
    }
    model.parts[0].triangles = model.triangles.len() as u32;
    let config = ImportConfig { voxels: 128, tangled: 1.0, ..ImportConfig::default() };
    let imported = import_glb(&export_glb(&model), &thing("crate"), &config).unwrap();
    assert!(!imported.asset.model.unwrap().hulls.is_empty());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(if std::env::var_os("SIMWORLD_SOAK").is_some() { 20_000 } else { 100 }))]

    #[test]
    fn any_bytes_are_a_surface_or_an_error(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        let _ = read(&bytes);
    }

    #[test]
    fn changed_files_are_an_asset_or_an_error(
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6),
        plain in any::<bool>(),
    ) {
        let cube = cuboid([0.0; 3], [1.0; 3]);
        let mut bytes = if plain {
            let (document, bytes) = plain_model(&cube);
            container(&document, &bytes)
        } else {
            export_glb(&cube)
        };
        for (at, byte) in changes {
            let at = at.index(bytes.len());
            bytes[at] = byte;
        }
        if let Ok(imported) = import(&bytes, "crate") {
            prop_assert!(imported.asset.validate().is_ok());
        }
    }

    #[test]
    fn any_triangles_are_an_asset_or_an_error(
        points in prop::collection::vec(prop::array::uniform3(-1.0f32..1.0), 3..12),
        corners in prop::collection::vec(prop::array::uniform3(any::<prop::sample::Index>()), 1..24),
    ) {
        let triangles: Vec<[u32; 3]> =
            corners.iter().map(|triangle| triangle.map(|corner| corner.index(points.len()) as u32)).collect();
        let (document, bytes) = plain_model(&crate::assets_common::model(&points, &triangles));
        let any = ImportConfig { tangled: 1.0, voxels: 16, ..ImportConfig::default() };
        if let Ok(imported) = import_glb(&container(&document, &bytes), &thing("crate"), &any) {
            prop_assert!(imported.asset.validate().is_ok());
            let report = imported.report;
            prop_assert!(report.volume > 0.0 && report.center_of_mass.iter().all(|x| x.is_finite()));
        }
    }
}
