//! Meshes to GLB: a JSON chunk that describes, a binary chunk that holds, and the one place where z up becomes y up.

use std::io::Write;

use serde_json::{Value, json};

use super::GltfError;
use super::city::{Material, Model};
use super::mesh::Mesh;

/// Numbers of the format.
const GLB_MAGIC: u32 = 0x4654_6c67;
const GLB_VERSION: u32 = 2;
const JSON_CHUNK: u32 = 0x4e4f_534a;
const BINARY_CHUNK: u32 = 0x004e_4942;
const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// East, north, up to glTF's x, y (up), z.
pub(super) const fn y_up([x, y, z]: [f32; 3]) -> [f32; 3] {
    [x, z, -y]
}

pub(super) fn write(model: &Model, writer: &mut impl Write) -> Result<(), GltfError> {
    let meshes: Vec<&Mesh> = model
        .nodes
        .iter()
        .flat_map(|node| &node.parts)
        .map(|(_, mesh)| mesh)
        .filter(|m| !is_empty(m))
        .collect();
    let binary: u64 = meshes.iter().map(|mesh| bytes_of(mesh)).sum();
    let mut json = describe(model, binary).to_string();
    while !json.len().is_multiple_of(4) {
        json.push(' ');
    }
    let total = 12 + 8 + json.len() as u64 + 8 + binary;
    let total32 = u32::try_from(total).map_err(|_| GltfError::TooLarge { bytes: total })?;
    for number in [GLB_MAGIC, GLB_VERSION, total32, json.len() as u32, JSON_CHUNK] {
        writer.write_all(&number.to_le_bytes())?;
    }
    writer.write_all(json.as_bytes())?;
    for number in [binary as u32, BINARY_CHUNK] {
        writer.write_all(&number.to_le_bytes())?;
    }
    for mesh in meshes {
        for position in &mesh.positions {
            for number in y_up(*position) {
                writer.write_all(&number.to_le_bytes())?;
            }
        }
        for index in &mesh.indices {
            writer.write_all(&index.to_le_bytes())?;
        }
    }
    Ok(())
}

fn is_empty(mesh: &Mesh) -> bool {
    mesh.indices.is_empty()
}

fn bytes_of(mesh: &Mesh) -> u64 {
    12 * mesh.positions.len() as u64 + 4 * mesh.indices.len() as u64
}

/// The lists of a document that grow part by part.
#[derive(Default)]
struct Lists {
    views: Vec<Value>,
    accessors: Vec<Value>,
    materials: Vec<Value>,
    meshes: Vec<Value>,
    nodes: Vec<Value>,
    /// Where the next mesh begins in the binary chunk.
    offset: u64,
}

fn describe(model: &Model, binary: u64) -> Value {
    let mut lists = Lists::default();
    // The root comes first; its children follow.
    lists.nodes.push(Value::Null);
    for node in &model.nodes {
        let parts = node.parts.iter().filter(|(_, mesh)| !is_empty(mesh));
        let primitives: Vec<Value> = parts.map(|(material, mesh)| lists.primitive(material, mesh)).collect();
        if !primitives.is_empty() {
            lists.nodes.push(json!({ "name": node.name, "mesh": lists.meshes.len() }));
            lists.meshes.push(json!({ "name": node.name, "primitives": primitives }));
        }
    }
    let children: Vec<usize> = (1..lists.nodes.len()).collect();
    // f64: the place of a city may be far from the origin.
    let translation = [model.middle.x, 0.0, -model.middle.y];
    lists.nodes[0] = json!({ "name": model.name, "children": children, "translation": translation });
    json!({
        "asset": { "version": "2.0", "generator": concat!("simworld-citygen ", env!("CARGO_PKG_VERSION")) },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": lists.nodes,
        "meshes": lists.meshes,
        "materials": lists.materials,
        "accessors": lists.accessors,
        "bufferViews": lists.views,
        "buffers": [{ "byteLength": binary }],
    })
}

impl Lists {
    fn primitive(&mut self, material: &Material, mesh: &Mesh) -> Value {
        let (low, high) = bounds(mesh);
        let positions = self.accessor(
            mesh.positions.len(),
            12,
            ARRAY_BUFFER,
            json!({ "componentType": FLOAT, "type": "VEC3", "min": low, "max": high }),
        );
        let indices = self.accessor(
            mesh.indices.len(),
            4,
            ELEMENT_ARRAY_BUFFER,
            json!({ "componentType": UNSIGNED_INT, "type": "SCALAR" }),
        );
        let [red, green, blue] = material.color;
        self.materials.push(json!({
            "name": material.name,
            "pbrMetallicRoughness": {
                "baseColorFactor": [red, green, blue, 1.0],
                "metallicFactor": 0.0,
                "roughnessFactor": material.roughness,
            },
        }));
        json!({
            "attributes": { "POSITION": positions },
            "indices": indices,
            "material": self.materials.len() - 1,
        })
    }

    /// Adds an accessor with a view of its own, and says its index.
    fn accessor(&mut self, count: usize, size: u64, target: u32, mut accessor: Value) -> usize {
        let length = count as u64 * size;
        accessor["bufferView"] = json!(self.views.len());
        accessor["count"] = json!(count);
        self.accessors.push(accessor);
        self.views.push(json!({
            "buffer": 0, "byteOffset": self.offset, "byteLength": length, "target": target,
        }));
        self.offset += length;
        self.accessors.len() - 1
    }
}

/// Least and greatest coordinates, y up.
fn bounds(mesh: &Mesh) -> ([f32; 3], [f32; 3]) {
    let ends = ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
    mesh.positions.iter().map(|position| y_up(*position)).fold(ends, |(low, high), point| {
        let pick = |f: fn(f32, f32) -> f32, a: [f32; 3]| [0, 1, 2].map(|axis| f(a[axis], point[axis]));
        (pick(f32::min, low), pick(f32::max, high))
    })
}
