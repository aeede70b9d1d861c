//! Models as GLB files: one mesh, a primitive for each part, colours at the vertices.

use serde_json::{Value, json};
use simworld_core::asset::{Model, ModelVertex, Paint};

/// Writes a model as a GLB file, y up and z to the front, in metres. Hulls are not written; [`read_glb`](super::read_glb) gives
/// its triangles back.
///
/// A part that takes the colour of its entity is written without colours.
pub fn export_glb(model: &Model) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut views = Vec::new();
    let mut accessors = vec![];
    let rows = |of: fn(&ModelVertex) -> [f32; 3]| model.vertices.iter().map(of).collect::<Vec<_>>();
    let turned = |[x, y, z]: [f32; 3]| [y, z, x];
    let positions: Vec<_> = rows(|vertex| vertex.position).into_iter().map(turned).collect();
    let normals: Vec<_> = rows(|vertex| vertex.normal).into_iter().map(turned).collect();
    for (index, column) in [&positions, &normals, &rows(|vertex| vertex.color)].into_iter().enumerate() {
        let view =
            append(&mut bytes, &mut views, 34_962, column.iter().flatten().flat_map(|x| x.to_le_bytes()));
        let mut accessor =
            json!({"bufferView": view, "componentType": 5126, "count": column.len(), "type": "VEC3"});
        if index == 0 {
            let fold = |from: f32, pick: fn(f32, f32) -> f32| -> [f32; 3] {
                std::array::from_fn(|axis| column.iter().map(|row| row[axis]).fold(from, pick))
            };
            accessor["min"] = json!(fold(f32::INFINITY, f32::min));
            accessor["max"] = json!(fold(f32::NEG_INFINITY, f32::max));
        }
        accessors.push(accessor);
    }
    let (mut primitives, mut materials) = (Vec::new(), Vec::new());
    for (part, triangles) in model.runs().filter(|(_, triangles)| !triangles.is_empty()) {
        let corners = triangles.as_flattened();
        let view = append(&mut bytes, &mut views, 34_963, corners.iter().flat_map(|x| x.to_le_bytes()));
        accessors.push(
            json!({"bufferView": view, "componentType": 5125, "count": corners.len(), "type": "SCALAR"}),
        );
        let mut attributes = json!({"POSITION": 0, "NORMAL": 1});
        if part.paint == Paint::Own {
            attributes["COLOR_0"] = json!(2);
        }
        materials.push(json!({"name": part.name}));
        let [indices, material] = [accessors.len() - 1, materials.len() - 1];
        primitives
            .push(json!({"attributes": attributes, "indices": indices, "material": material, "mode": 4}));
    }
    let document = json!({
        "asset": {"version": "2.0", "generator": concat!("simworld ", env!("CARGO_PKG_VERSION"))},
        "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": primitives}], "materials": materials,
        "accessors": accessors, "bufferViews": views, "buffers": [{"byteLength": bytes.len()}],
    });
    pack(&document, bytes)
}

/// Adds bytes to the buffer and a view of them; the view's number.
fn append(bytes: &mut Vec<u8>, views: &mut Vec<Value>, target: u32, more: impl Iterator<Item = u8>) -> usize {
    let start = bytes.len();
    bytes.extend(more);
    views
        .push(json!({"buffer": 0, "byteOffset": start, "byteLength": bytes.len() - start, "target": target}));
    views.len() - 1
}

/// The container: every chunk is filled up to a multiple of four bytes.
fn pack(document: &Value, mut bytes: Vec<u8>) -> Vec<u8> {
    let mut text = document.to_string().into_bytes();
    text.resize(text.len().next_multiple_of(4), b' ');
    bytes.resize(bytes.len().next_multiple_of(4), 0);
    let length = 12 + 8 + text.len() + 8 + bytes.len();
    let mut file = Vec::with_capacity(length);
    for word in [0x4654_6C67, 2, length as u32, text.len() as u32, 0x4E4F_534A] {
        file.extend(u32::to_le_bytes(word));
    }
    file.extend(text);
    for word in [bytes.len() as u32, 0x004E_4942] {
        file.extend(u32::to_le_bytes(word));
    }
    file.extend(bytes);
    file
}
