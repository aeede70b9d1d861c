//! What a city is to be like.

use serde::{Deserialize, Serialize};
use simworld_core::net::{LANE_WIDTH, NetworkConfig, SIDEWALK_WIDTH};

use crate::CityError;
use crate::lot::LotConfig;
use crate::range::check;
use crate::terrain::TerrainConfig;
use crate::zoning::ZoningConfig;

/// How streets grow.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RoadConfig {
    /// Number of street segments to grow, in [2, 1 000 000]; a segment runs from junction to junction.
    pub count: u32,
    /// Mean length of a segment, m, in [60, 1000].
    pub length: f64,
    /// Length of blocks over their width, in [1, 3]: how much longer streets are along the grain than across it.
    pub aspect: f64,
    /// Blocks wider than this are divided by a street, m, in [80, 100 000].
    pub widest_block: f64,
    /// Standard deviation of the logarithm of lengths, in [0, 0.6]: the higher, the more short and very long streets.
    pub length_variation: f64,
    /// Standard deviation of a street's heading from where it is led, radians, in [0, 0.5]: 0 grows straight lines.
    pub heading_variation: f64,
    /// How firmly streets are drawn to the grain of their place, in [0, 1]: at 0 they keep their own heading.
    pub order: f64,
    /// Range to both sides within which the grain of the city turns from place to place, radians, in [0, π]: at 0 it is one
    /// grid.
    pub turning: f64,
    /// Distance over which the grain turns, m, in [50, 100 000].
    pub patch: f64,
    /// A new end nearer than this to a junction or a street is attached to it, m, in [10, 500]; at most 0.6 of the
    /// length.
    pub snap: f64,
    /// Least angle between two streets at a junction, radians, in [0.5, 1.5].
    pub least_angle: f64,
    /// Probability that a street goes on beyond a junction, in [0, 1].
    pub continuation: f64,
    /// Probability of a branch to each side, in [0, 1].
    pub branching: f64,
    /// Weight of depth against breadth, in [0, 10]: at 0 the oldest ends grow first, higher values let long streets
    /// run ahead.
    pub depth_bias: f64,
    /// Weight of the distance from the middle, in [0, 10]: at 0 arms reach out, higher values close block after block.
    pub compactness: f64,
    /// Share of the junctions at which four streets may meet, in [0, 1]; three at the others.
    pub crossroads: f64,
    /// Share of dead ends among the junctions, in [0, 1]: those beyond it are joined to what they look at, or taken away.
    pub dead_ends: f64,
    /// Share of the segments that bend between their ends, in [0, 1].
    pub bends: f64,
    /// Height of bows as a share of the length, in [0, 0.3].
    pub bow: f64,
    /// Highways that leave the middle, in [0, 4]: with 0 the first streets are arterials.
    pub highways: u32,
    /// Lanes each way of an arterial, in [1, 4].
    pub arterial_lanes: u8,
    /// Width of a driving lane, m, in [2, 6].
    pub lane_width: f64,
    /// Width of a sidewalk, m, in [1, 20].
    pub sidewalk_width: f64,
    /// Width of the parking lanes at both kerbs of local streets, m, in [0, 6]: 0 for none.
    pub parking_width: f64,
    /// Width of the cycle lanes on both sides of arterials, m, in [0, 4]: 0 for none. 6 feet are wanted, 5 are the least
    /// beside a kerb (NACTO Urban Bikeway Design Guide 2014, "Conventional bike lanes").
    pub arterial_cycle_width: f64,
    /// Width of the median of arterials, m, in [0, 20]: 0 for none. 6 feet are the least on which people wait (NACTO Urban
    /// Street Design Guide 2013, "Pedestrian safety islands").
    pub arterial_median_width: f64,
    /// Width of the parking lanes at both kerbs of arterials, m, in [0, 6]: 0 for none; 7 to 9 feet are usual (the same,
    /// "Lane width").
    pub arterial_parking_width: f64,
}

impl Default for RoadConfig {
    fn default() -> Self {
        Self {
            count: 40,
            length: 105.0,
            aspect: 1.0,
            widest_block: 180.0,
            length_variation: 0.2,
            heading_variation: 0.06,
            order: 0.6,
            turning: 0.3,
            patch: 900.0,
            snap: 45.0,
            least_angle: 1.15,
            continuation: 0.92,
            branching: 0.8,
            depth_bias: 0.5,
            compactness: 1.2,
            crossroads: 0.5,
            dead_ends: 0.17,
            bends: 0.3,
            bow: 0.05,
            highways: 0,
            arterial_lanes: 1,
            lane_width: LANE_WIDTH,
            sidewalk_width: SIDEWALK_WIDTH,
            parking_width: 2.2,
            arterial_cycle_width: 0.0,
            arterial_median_width: 0.0,
            arterial_parking_width: 0.0,
        }
    }
}

impl RoadConfig {
    /// Checks every field against its range.
    ///
    /// # Errors
    /// The first field out of range; NaN always is.
    pub fn validate(&self) -> Result<(), CityError> {
        check(&[
            ("roads.count", f64::from(self.count), 2.0, 1e6, "2 to 1 000 000"),
            ("roads.length", self.length, 60.0, 1000.0, "60 to 1000 m"),
            ("roads.length_variation", self.length_variation, 0.0, 0.6, "0 to 0.6"),
            ("roads.aspect", self.aspect, 1.0, 3.0, "1 to 3"),
            ("roads.widest_block", self.widest_block, 80.0, 1e5, "80 to 100 000 m"),
            ("roads.order", self.order, 0.0, 1.0, "0 to 1"),
            ("roads.turning", self.turning, 0.0, std::f64::consts::PI, "0 to π rad"),
            ("roads.patch", self.patch, 50.0, 1e5, "50 to 100 000 m"),
            ("roads.crossroads", self.crossroads, 0.0, 1.0, "0 to 1"),
            ("roads.dead_ends", self.dead_ends, 0.0, 1.0, "0 to 1"),
            ("roads.bow", self.bow, 0.0, 0.3, "0 to 0.3"),
            ("roads.highways", f64::from(self.highways), 0.0, 4.0, "0 to 4"),
            ("roads.heading_variation", self.heading_variation, 0.0, 0.5, "0 to 0.5 rad"),
            ("roads.snap", self.snap, 10.0, self.length.min(833.0) * 0.6, "10 m to 0.6 of self.length"),
            ("roads.least_angle", self.least_angle, 0.5, 1.5, "0.5 to 1.5 rad"),
            ("roads.continuation", self.continuation, 0.0, 1.0, "0 to 1"),
            ("roads.branching", self.branching, 0.0, 1.0, "0 to 1"),
            ("roads.depth_bias", self.depth_bias, 0.0, 10.0, "0 to 10"),
            ("roads.compactness", self.compactness, 0.0, 10.0, "0 to 10"),
            ("roads.bends", self.bends, 0.0, 1.0, "0 to 1"),
            ("roads.arterial_lanes", f64::from(self.arterial_lanes), 1.0, 4.0, "1 to 4"),
            ("roads.lane_width", self.lane_width, 2.0, 6.0, "2 to 6 m"),
            ("roads.sidewalk_width", self.sidewalk_width, 1.0, 20.0, "1 to 20 m"),
            ("roads.parking_width", self.parking_width, 0.0, 6.0, "0 to 6 m"),
            ("roads.arterial_cycle_width", self.arterial_cycle_width, 0.0, 4.0, "0 to 4 m"),
            ("roads.arterial_median_width", self.arterial_median_width, 0.0, 20.0, "0 to 20 m"),
            ("roads.arterial_parking_width", self.arterial_parking_width, 0.0, 6.0, "0 to 6 m"),
        ])
    }
}

/// How buildings stand.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct BuildingConfig {
    /// Distance from the sidewalk to a façade, m, in [0.5, 50].
    pub setback: f64,
    /// Least gap between neighbours, m, in [0, 50].
    pub gap: f64,
    /// Share of the candidates that are kept, in [0, 1]; gaps are filled all the same up to this density.
    pub density: f64,
}

impl Default for BuildingConfig {
    fn default() -> Self {
        Self { setback: 2.0, gap: 0.8, density: 1.0 }
    }
}

/// How much stands along the streets.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct ElementConfig {
    /// Trees per metre of sidewalk, in [0, 1].
    pub trees: f64,
    /// Street lamps per metre, in [0, 1].
    pub lamps: f64,
    /// Benches, bins, mailboxes, hydrants, signs and the like per metre, in [0, 1].
    pub furniture: f64,
    /// Share of the parking spaces that are taken, in [0, 1].
    pub parked: f64,
    /// Trees per square metre of parks and courtyards, in [0, 0.1].
    pub green_trees: f64,
}

impl Default for ElementConfig {
    fn default() -> Self {
        Self { trees: 0.06, lamps: 0.03, furniture: 0.04, parked: 0.6, green_trees: 0.007 }
    }
}

/// What a city is to be like.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct CityConfig {
    /// How streets grow.
    pub roads: RoadConfig,
    /// What the land is used for.
    pub zoning: ZoningConfig,
    /// How blocks are divided.
    pub lots: LotConfig,
    /// How buildings stand.
    pub buildings: BuildingConfig,
    /// How much stands along the streets.
    pub elements: ElementConfig,
    /// Limits and signals.
    pub network: NetworkConfig,
    /// The heights under it.
    pub terrain: TerrainConfig,
}

impl CityConfig {
    /// A city of that many street segments, otherwise as by default.
    pub fn with_roads(count: u32) -> Self {
        Self { roads: RoadConfig { count, ..RoadConfig::default() }, ..Self::default() }
    }

    /// Checks every field against its range.
    ///
    /// # Errors
    /// The first field out of range; NaN always is.
    pub fn validate(&self) -> Result<(), CityError> {
        let Self { roads, zoning, lots, buildings, elements, network, terrain } = self;
        let checks = [
            ("buildings.setback", buildings.setback, 0.5, 50.0, "0.5 to 50 m"),
            ("buildings.gap", buildings.gap, 0.0, 50.0, "0 to 50 m"),
            ("buildings.density", buildings.density, 0.0, 1.0, "0 to 1"),
            ("elements.trees", elements.trees, 0.0, 1.0, "0 to 1 per m"),
            ("elements.lamps", elements.lamps, 0.0, 1.0, "0 to 1 per m"),
            ("elements.furniture", elements.furniture, 0.0, 1.0, "0 to 1 per m"),
            ("elements.parked", elements.parked, 0.0, 1.0, "0 to 1"),
            ("elements.green_trees", elements.green_trees, 0.0, 0.1, "0 to 0.1 per m²"),
        ];
        roads.validate()?;
        check(&checks)?;
        zoning.validate()?;
        lots.validate()?;
        terrain.validate()?;
        Ok(network.validate()?)
    }
}
