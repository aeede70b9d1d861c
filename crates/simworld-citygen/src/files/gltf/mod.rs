//! The city as binary glTF 2.0 (GLB), for anything that shows 3D.
//!
//! One node a kind of thing, one mesh part a material: roads, junctions, sidewalks, cycle lanes and medians, crossings, markings, buildings by
//! use, roofs, street elements. Meshes have no normals, and so readers shade them flat, as the format says.
//!
//! glTF is y up: its x is our x (east), its y our z (up), its z our -y (south). the module `document` turns every vertex, and
//! nothing else does. Vertices are `f32` about the middle of the city, which the root node puts back in its place.

mod bridges;
mod buildings;
mod city;
mod document;
mod footbridges;
mod mesh;
mod strips;

use std::io::{self, Write};

use thiserror::Error;

use crate::City;

/// Why no GLB can be written.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum GltfError {
    /// The format counts bytes with 32 bits.
    #[error("the city takes {bytes} bytes, more than the {} a GLB can hold: write a part of it", u32::MAX)]
    TooLarge {
        /// What the city would take.
        bytes: u64,
    },
    /// The writer's.
    #[error(transparent)]
    Io(#[from] io::Error),
}

impl City {
    /// Writes the city as a GLB.
    ///
    /// ```
    /// use simworld_citygen::{City, CityConfig};
    /// use simworld_core::seed::Seed;
    /// let city = City::generate(&CityConfig::with_roads(8), Seed(3))?;
    /// let mut glb = Vec::new();
    /// city.write_glb(&mut glb)?;
    /// assert!(glb.starts_with(b"glTF"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// A city beyond what the format can hold, or the writer's.
    pub fn write_glb(&self, writer: &mut impl Write) -> Result<(), GltfError> {
        document::write(&city::model(self), writer)
    }
}
