//! What a city of tiles is to be like.

use serde::{Deserialize, Serialize};

use crate::range::check;
use crate::{CityConfig, CityError, RoadConfig, Style};

/// The lattice of main streets.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct LatticeConfig {
    /// Distance between main streets, m, in [300, 1000]: the side of a superblock.
    pub spacing: f64,
    /// Superblocks along a side of a tile, in [1, 4].
    pub superblocks: u32,
    /// How far a crossing of main streets lies from its place on the lattice, as a share of the spacing, in [0, 0.15].
    pub jitter: f64,
    /// Height of the bows of main streets as a share of their length, in [0, 0.1].
    pub bow: f64,
    /// Mean distance between the places where streets may join a main street, m, in [60, 250].
    pub gates: f64,
    /// Share of those places at which a street may join from either side, in [0, 1]; from one side at the others.
    pub crossroads: f64,
}

impl Default for LatticeConfig {
    fn default() -> Self {
        Self { spacing: 500.0, superblocks: 2, jitter: 0.1, bow: 0.04, gates: 95.0, crossroads: 0.6 }
    }
}

impl LatticeConfig {
    /// Side of a tile, m.
    pub fn tile_side(&self) -> f64 {
        self.spacing * f64::from(self.superblocks)
    }
}

/// What a city of tiles is to be like.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct TileConfig {
    /// The main streets.
    pub lattice: LatticeConfig,
    /// All else. Of the roads, `count`, `highways`, `compactness` and `branching` into main streets have no meaning here:
    /// a superblock is filled.
    pub city: CityConfig,
}

impl TileConfig {
    /// The settings of a style.
    pub fn of_style(style: Style) -> Self {
        let roads = style.roads(2);
        // Within walls all that is left over is filled, so streets are longer and more of them end than in open growth. Main
        // streets in shorter pieces than the streets between them are what makes few long streets beside many short ones.
        let (lattice, roads) = match style {
            Style::Grid => (
                LatticeConfig {
                    jitter: 0.0,
                    bow: 0.0,
                    gates: 68.0,
                    crossroads: 1.0,
                    ..LatticeConfig::default()
                },
                RoadConfig {
                    length: 140.0,
                    length_variation: 0.22,
                    branching: 0.97,
                    snap: 42.0,
                    dead_ends: 0.13,
                    ..roads
                },
            ),
            Style::Mixed => (
                LatticeConfig { gates: 60.0, ..LatticeConfig::default() },
                RoadConfig { length: 120.0, dead_ends: 0.3, branching: 0.6, continuation: 0.86, ..roads },
            ),
            Style::Organic => (
                LatticeConfig {
                    jitter: 0.15,
                    bow: 0.1,
                    gates: 104.0,
                    crossroads: 0.1,
                    ..LatticeConfig::default()
                },
                RoadConfig { length: 60.0, dead_ends: 0.36, ..roads },
            ),
            Style::Suburb => (
                LatticeConfig {
                    jitter: 0.12,
                    bow: 0.08,
                    gates: 118.0,
                    crossroads: 0.1,
                    ..LatticeConfig::default()
                },
                RoadConfig {
                    dead_ends: 0.55,
                    length: 120.0,
                    crossroads: 0.38,
                    heading_variation: 0.36,
                    length_variation: 0.6,
                    bow: 0.2,
                    bends: 1.0,
                    branching: 0.12,
                    continuation: 0.5,
                    ..roads
                },
            ),
        };
        let city = CityConfig { roads, ..CityConfig::default() };
        Self { lattice, city }
    }

    /// Checks every field against its range.
    ///
    /// # Errors
    /// The first field out of range; NaN always is.
    pub fn validate(&self) -> Result<(), CityError> {
        let LatticeConfig { spacing, superblocks, jitter, bow, gates, crossroads } = &self.lattice;
        check(&[
            ("lattice.spacing", *spacing, 300.0, 1000.0, "300 to 1000 m"),
            ("lattice.superblocks", f64::from(*superblocks), 1.0, 4.0, "1 to 4"),
            ("lattice.jitter", *jitter, 0.0, 0.15, "0 to 0.15"),
            ("lattice.bow", *bow, 0.0, 0.1, "0 to 0.1"),
            ("lattice.gates", *gates, 60.0, 250.0, "60 to 250 m"),
            ("lattice.crossroads", *crossroads, 0.0, 1.0, "0 to 1"),
            ("zoning.center_radius", self.city.zoning.center_radius, 0.0, 5e4, "0 to 50 000 m"),
        ])?;
        self.city.validate()
    }
}
