//! How much a GLB file may hold.

use serde::{Deserialize, Serialize};

/// How much a GLB file may hold; checked before memory is taken for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct GlbLimits {
    /// The most bytes of a file.
    pub bytes: u64,
    /// The most bytes of its JSON.
    pub json: u64,
    /// The most vertices, counted once for each place where a mesh stands.
    pub vertices: u64,
    /// The most triangles, counted in the same way.
    pub triangles: u64,
    /// The most nodes.
    pub nodes: u64,
    /// The most levels of nodes.
    pub depth: usize,
    /// The most pixels of all its pictures together.
    pub pixels: u64,
    /// The most numbers in the curves of its animations, counted once for each that uses them.
    pub keys: u64,
    /// The longest side of a picture that stays one, pixels: larger ones are halved until they are no longer than that. 0 to 4096; at 0
    /// pictures become colours of vertices.
    pub texture: u32,
}

impl Default for GlbLimits {
    fn default() -> Self {
        Self {
            bytes: 64 << 20,
            json: 4 << 20,
            vertices: 600_000,
            triangles: 200_000,
            nodes: 10_000,
            depth: 64,
            pixels: 6 * 4096 * 4096,
            keys: 8_000_000,
            texture: 1024,
        }
    }
}
