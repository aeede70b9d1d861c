//! How files become assets.

use serde::{Deserialize, Serialize};

use super::error::ImportError;
use crate::assets::glb::{GlbLimits, Moment};

/// How files become assets.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ImportConfig {
    /// How much a file may hold.
    pub limits: GlbLimits,
    /// The moment of an animation in which it is taken; at rest without one.
    pub moment: Option<Moment>,
    /// Whether it keeps its animations, and moves by them.
    pub clips: bool,
    /// What its numbers are.
    pub unit: Unit,
    /// Which way it looks.
    pub facing: Facing,
    /// The most convex solids, 1 to 64: a power of two is used fully, below four there is one.
    pub hulls: u32,
    /// Voxels along the longest side, by which it is taken apart, 16 to 128. A body falls through no gap that is narrower
    /// than one.
    pub voxels: u32,
    /// Points that lie within this share of the diagonal are one, 0 to 0.01.
    pub weld: f64,
    /// The share of edges that may lie between more than two triangles, 0 to 1, after what can be repaired is.
    pub tangled: f64,
    /// The share of edges that may belong to one triangle alone, 0 to 1.
    pub open: f64,
}

impl Default for ImportConfig {
    fn default() -> Self {
        Self {
            limits: GlbLimits::default(),
            moment: None,
            clips: true,
            unit: Unit::Guess,
            facing: Facing::AsGiven,
            hulls: 32,
            voxels: 48,
            weld: 1e-5,
            tangled: 0.005,
            open: 1.0,
        }
    }
}

/// What the numbers of a file are. A size that is asked for goes before all of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Unit {
    /// Metres, as glTF says.
    Metres,
    /// Metres or a power of ten of them, whichever makes it as large as things of its class are.
    #[default]
    Guess,
    /// Anything: it is made as long as the longest side of things of its class.
    Any,
}

/// Which way a file looks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Facing {
    /// To its front, as glTF says: z.
    #[default]
    AsGiven,
    /// A quarter to the left, if things of its class are longer than wide, and it is wider than long, or the other way
    /// round.
    ByClass,
}

impl ImportConfig {
    /// The same, if it can work.
    ///
    /// # Errors
    /// [`ImportError::Config`] names the field that is out of its range.
    pub fn checked(self) -> Result<Self, ImportError> {
        let shares = [("weld", self.weld, 0.01), ("tangled", self.tangled, 1.0), ("open", self.open, 1.0)];
        if let Some((name, value, most)) =
            shares.into_iter().find(|(_, value, most)| !(0.0..=*most).contains(value))
        {
            return Err(ImportError::Config(format!("{name} is {value}: give 0 to {most}")));
        }
        let counts = [("hulls", self.hulls, 1..=64), ("voxels", self.voxels, 16..=128)];
        match counts.into_iter().find(|(_, value, range)| !range.contains(value)) {
            Some((name, value, range)) => Err(ImportError::Config(format!(
                "{name} is {value}: give {} to {}",
                range.start(),
                range.end()
            ))),
            None => Ok(self),
        }
    }
}
