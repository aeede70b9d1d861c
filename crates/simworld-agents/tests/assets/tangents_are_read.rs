//! Tangents of files: which way is right on pictures of bumps, kept as long as it is true.
// what fails here fails the test
#![allow(clippy::unwrap_used)]

use crate::assets_common::{container, halves, painted_document, thing};
use serde_json::{Value, json};
use simworld_agents::assets::{
    GlbError, GlbLimits, ImportConfig, Surface, Unit, export_glb, import_glb, read_glb,
};

fn read(document: &Value, bytes: &[u8]) -> Result<Surface, GlbError> {
    read_glb(&container(document, bytes), &GlbLimits::default())
}

fn metres() -> ImportConfig {
    ImportConfig { unit: Unit::Metres, ..ImportConfig::default() }
}

/// A file of two boxes with a picture of bumps, whose vertices all look up; right is to the front, and the pictures of the second box are mirrored.
fn with_tangents() -> (Value, Vec<u8>) {
    let (mut document, mut bytes) = painted_document(&halves());
    document["materials"][0]["normalTexture"] = json!({"index": 0});
    let (up, front) = ([0.0_f32, 1.0, 0.0].repeat(16), |side: f32| [0.0, 0.0, 1.0, side].repeat(8));
    for (name, shape, numbers) in
        [("NORMAL", "VEC3", up), ("TANGENT", "VEC4", [front(1.0), front(-1.0)].concat())]
    {
        bytes.resize(bytes.len().next_multiple_of(4), 0);
        let start = bytes.len();
        bytes.extend(numbers.iter().flat_map(|number: &f32| number.to_le_bytes()));
        let view = json!({"buffer": 0, "byteOffset": start, "byteLength": bytes.len() - start});
        let views = document["bufferViews"].as_array_mut().unwrap();
        views.push(view);
        let accessor =
            json!({"bufferView": views.len() - 1, "componentType": 5126, "count": 16, "type": shape});
        let accessors = document["accessors"].as_array_mut().unwrap();
        accessors.push(accessor);
        let number = accessors.len() - 1;
        document["meshes"][0]["primitives"][0]["attributes"][name] = json!(number);
    }
    document["buffers"][0]["byteLength"] = json!(bytes.len());
    (document, bytes)
}

#[test]
fn tangents_are_read_turned_and_written() {
    let (document, bytes) = with_tangents();
    let ahead = |side: f32| [1.0, 0.0, 0.0, side];
    let wanted = [[ahead(1.0); 8], [ahead(-1.0); 8]].concat();
    assert_eq!(read(&document, &bytes).unwrap().tangents, wanted);
    // What mirrors a mesh mirrors its pictures.
    let mut mirrored = document.clone();
    mirrored["nodes"][0]["scale"] = json!([-1.0, 1.0, 1.0]);
    let turned: Vec<[f32; 4]> = wanted.iter().map(|[x, y, z, side]| [*x, *y, *z, -side]).collect();
    assert_eq!(read(&mirrored, &bytes).unwrap().tangents, turned);

    let asset = import_glb(&container(&document, &bytes), &thing("a crate"), &metres()).unwrap().asset;
    let model = asset.model.as_deref().unwrap();
    assert_eq!(model.tangents.len(), model.vertices.len());
    for (vertex, tangent) in model.vertices.iter().zip(&model.tangents) {
        // The second box lies to the left.
        assert_eq!(*tangent, ahead(if vertex.position[1] < 0.0 { 1.0 } else { -1.0 }));
    }
    let written = export_glb(model);
    assert!(gltf::Gltf::from_slice(&written).is_ok());
    assert_eq!(read_glb(&written, &GlbLimits::default()).unwrap().tangents, model.tangents);
}

/// Tangents without normals, without bumps, or under a picture that is turned, and those of surfaces whose normals were found anew.
#[test]
fn tangents_that_hold_no_longer_are_passed_over() {
    let (document, bytes) = with_tangents();
    let none = |document: &Value, bytes: &[u8]| {
        read(document, bytes).unwrap().tangents.iter().all(|tangent| *tangent == [0.0; 4])
    };
    assert!(!none(&document, &bytes));
    let mut bare = document.clone();
    bare["meshes"][0]["primitives"][0]["attributes"].as_object_mut().unwrap().remove("NORMAL");
    assert!(none(&bare, &bytes));
    let mut even = document.clone();
    even["materials"][0].as_object_mut().unwrap().remove("normalTexture");
    assert!(none(&even, &bytes));
    for (transform, holds) in [
        (json!({"offset": [0.5, 0.0], "scale": [2.0, 3.0]}), true),
        (json!({"rotation": 0.5}), false),
        (json!({"scale": [-1.0, 1.0]}), false),
    ] {
        let mut laid = document.clone();
        let extensions = json!({"KHR_texture_transform": transform});
        laid["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"] = extensions.clone();
        laid["materials"][0]["normalTexture"]["extensions"] = extensions;
        let surface = read(&laid, &bytes).unwrap();
        assert!(surface.parts[0].pictures.bumps.is_some());
        assert_eq!(surface.tangents[0] != [0.0; 4], holds, "{transform}");
    }
    // A triangle that looks inward.
    let mut turned = bytes.clone();
    let first = document["bufferViews"][1]["byteOffset"].as_u64().unwrap() as usize;
    let (b, c) = (first + 4, first + 8);
    (0..4).for_each(|byte| turned.swap(b + byte, c + byte));
    let imported = import_glb(&container(&document, &turned), &thing("a crate"), &metres()).unwrap();
    assert!(imported.report.repair.turned > 0);
    assert!(imported.asset.model.unwrap().tangents.is_empty());
    // One of another length than the vertices, and one of another shape.
    for (key, value) in [("count", json!(15)), ("type", json!("VEC3"))] {
        let mut damaged = document.clone();
        let last = damaged["accessors"].as_array().unwrap().len() - 1;
        damaged["accessors"][last][key] = value;
        assert!(matches!(
            read(&damaged, &bytes).unwrap_err(),
            GlbError::Unsupported { what: "accessor", .. }
        ));
    }
}
