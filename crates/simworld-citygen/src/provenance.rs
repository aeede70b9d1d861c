//! Where a city comes from.

use serde::{Deserialize, Serialize};
use simworld_core::seed::Seed;

use crate::{GeoOrigin, Style};

/// Where a city comes from: what its map says at its foot, and what places it on Earth.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Provenance {
    /// The seed of its streets, buildings and elements.
    pub seed: Seed,
    /// The style of its streets, where they were grown in one.
    pub style: Option<Style>,
    /// What it is called.
    pub title: Option<String>,
    /// Whom to thank for its streets: the line that their licence asks for.
    pub credit: Option<String>,
    /// Where on Earth its origin lies; a grown city lies nowhere.
    pub origin: Option<GeoOrigin>,
}

impl Provenance {
    /// That of a grown city.
    pub const fn of_seed(seed: Seed) -> Self {
        Self { seed, style: None, title: None, credit: None, origin: None }
    }
}
