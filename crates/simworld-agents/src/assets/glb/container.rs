//! The container: a header, a chunk of JSON, and a chunk of bytes. Lengths are checked before anything is read by them.

use super::document::Document;
use super::error::GlbError;
use super::limits::GlbLimits;

const MAGIC: u32 = 0x4654_6C67;
const JSON: u32 = 0x4E4F_534A;
const BIN: u32 = 0x004E_4942;

/// Extensions that a file may require. Whoever looks at a model lights it, so that what is to be unlit is only not shiny.
const SERVED: [&str; 4] = [
    "KHR_texture_transform",
    "KHR_mesh_quantization",
    "KHR_materials_unlit",
    "KHR_materials_emissive_strength",
];

/// The document and the bytes that it refers to.
pub(super) fn open<'a>(bytes: &'a [u8], limits: &GlbLimits) -> Result<(Document, &'a [u8]), GlbError> {
    let too_many = |what, got: usize, most: u64| {
        if got as u64 > most { Err(GlbError::TooMany { what, got: got as u64, most }) } else { Ok(()) }
    };
    too_many("bytes", bytes.len(), limits.bytes)?;
    let mut rest = bytes;
    let [magic, version, length] = [word(&mut rest)?, word(&mut rest)?, word(&mut rest)?];
    if magic != MAGIC {
        return Err(container("it does not begin with \"glTF\""));
    }
    if version != 2 {
        return Err(GlbError::Container(format!("its version is {version}, not 2")));
    }
    if length as usize != bytes.len() {
        return Err(GlbError::Container(format!(
            "its header says {length} bytes, and there are {}",
            bytes.len()
        )));
    }
    let (kind, json) = chunk(&mut rest)?;
    if kind != JSON {
        return Err(container("its first chunk is not JSON"));
    }
    too_many("bytes of JSON", json.len(), limits.json)?;
    let document: Document =
        serde_json::from_slice(json).map_err(|error| GlbError::Json(error.to_string()))?;
    let mut data: &[u8] = &[];
    while !rest.is_empty() {
        let (kind, bytes) = chunk(&mut rest)?;
        // Chunks of other kinds are to be passed over.
        if kind == BIN && data.is_empty() {
            data = bytes;
        }
    }
    check(&document, limits)?;
    Ok((document, data))
}

fn check(document: &Document, limits: &GlbLimits) -> Result<(), GlbError> {
    if !document.asset.version.starts_with("2.") {
        let shown: String = document.asset.version.chars().take(20).collect();
        return Err(GlbError::Json(format!("it is glTF {shown}, not 2.0")));
    }
    let is_served = |name: &&String| SERVED.contains(&name.as_str());
    if let Some(name) = document.extensions_required.iter().find(|name| !is_served(name)) {
        return Err(GlbError::Extension { name: name.chars().take(60).collect() });
    }
    for (index, buffer) in document.buffers.iter().enumerate() {
        if let Some(uri) = &buffer.uri {
            return Err(elsewhere("buffer", index, uri));
        }
    }
    for (index, image) in document.images.iter().enumerate() {
        if let Some(uri) = &image.uri {
            return Err(elsewhere("image", index, uri));
        }
    }
    let nodes = document.nodes.len() as u64;
    if nodes > limits.nodes {
        return Err(GlbError::TooMany { what: "nodes", got: nodes, most: limits.nodes });
    }
    Ok(())
}

fn elsewhere(what: &'static str, index: usize, uri: &str) -> GlbError {
    GlbError::Elsewhere { what, index, uri: uri.chars().take(60).collect() }
}

fn chunk<'a>(rest: &mut &'a [u8]) -> Result<(u32, &'a [u8]), GlbError> {
    let length = word(rest)? as usize;
    let kind = word(rest)?;
    let (bytes, after) = rest.split_at_checked(length).ok_or_else(|| {
        GlbError::Container(format!("a chunk says {length} bytes, and {} are left", rest.len()))
    })?;
    *rest = after;
    Ok((kind, bytes))
}

fn word(rest: &mut &[u8]) -> Result<u32, GlbError> {
    let (bytes, after) =
        rest.split_first_chunk::<4>().ok_or_else(|| container("it ends in the middle of a header"))?;
    *rest = after;
    Ok(u32::from_le_bytes(*bytes))
}

fn container(what: &str) -> GlbError {
    GlbError::Container(what.to_owned())
}
