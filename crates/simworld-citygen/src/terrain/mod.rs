//! Terrain: heights under a city, streets graded to what vehicles climb, and the ground that follows both.
//!
//! The height of the land is a [`HeightField`]: [`Terrain`] of seeded noise, or a [`Raster`] of measured heights. Streets
//! cut and fill it until none is steeper than its class allows ([`elevations`]); the [`Ground`] meets the streets where
//! they are and the land elsewhere. Where streets pass over one another they are raised until there is room below
//! ([`raise_bridges`]). A city is flat unless its configuration says otherwise.

mod bridges;
mod grade;
mod ground;
mod raster;

pub use bridges::{BridgeWarning, DECK, HEADROOM, raise_bridges};
pub use grade::elevations;
pub use ground::Ground;
pub(crate) use ground::REACH;
pub use raster::{Raster, RasterError};
use serde::{Deserialize, Serialize};
use simworld_core::geometry::Point2;
use simworld_core::net::{NetworkError, RoadClass, StreetPlan};
use simworld_core::seed::Seed;

use crate::CityError;
use crate::range::check;
use crate::zoning::ValueNoise;

/// The heights under a city, and how steep its streets may be.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct TerrainConfig {
    /// Greatest difference in height between valleys and hills, m, in [0, 1000]; 0 is flat.
    pub relief: f64,
    /// Distance from hill to hill, m, in [100, 50 000].
    pub wavelength: f64,
    /// Steepest grade of local streets, rise over run, in [0.01, 0.4].
    pub local_grade: f64,
    /// Steepest grade of arterials and highways, in [0.01, 0.4].
    pub arterial_grade: f64,
}

impl Default for TerrainConfig {
    fn default() -> Self {
        Self { relief: 0.0, wavelength: 900.0, local_grade: 0.15, arterial_grade: 0.08 }
    }
}

impl TerrainConfig {
    /// Checks every field against its range.
    ///
    /// # Errors
    /// The first field out of range; NaN always is.
    pub fn validate(&self) -> Result<(), CityError> {
        check(&[
            ("terrain.relief", self.relief, 0.0, 1000.0, "0 to 1000 m"),
            ("terrain.wavelength", self.wavelength, 100.0, 5e4, "100 to 50 000 m"),
            ("terrain.local_grade", self.local_grade, 0.01, 0.4, "0.01 to 0.4"),
            ("terrain.arterial_grade", self.arterial_grade, 0.01, 0.4, "0.01 to 0.4"),
        ])
    }

    /// The steepest grade of a class, rise over run.
    pub const fn grade(&self, class: RoadClass) -> f64 {
        match class {
            RoadClass::Local => self.local_grade,
            RoadClass::Arterial | RoadClass::Highway => self.arterial_grade,
        }
    }
}

/// Heights over the plane.
///
/// # Implementing it
///
/// ```
/// use simworld_citygen::terrain::HeightField;
/// use simworld_core::geometry::Point2;
/// struct Slope(f64);
/// impl HeightField for Slope {
///     fn height(&self, point: Point2) -> f64 {
///         self.0 * point.x
///     }
/// }
/// assert_eq!(Slope(0.1).height(Point2::new(50.0, 3.0)), 5.0);
/// ```
pub trait HeightField {
    /// The height at a point, m: finite, and the same whenever it is asked for.
    fn height(&self, point: Point2) -> f64;
}

/// Hills of seeded noise: a function of the seed and the point alone.
#[derive(Clone, Debug)]
pub struct Terrain {
    relief: f64,
    hills: ValueNoise,
    knolls: ValueNoise,
}

/// Share of the relief that is in hills a quarter as wide.
const KNOLLS: f64 = 0.15;

impl Terrain {
    /// The terrain of a seed; the configuration is taken as valid.
    pub fn new(config: &TerrainConfig, seed: Seed) -> Self {
        let stream = seed.stream("citygen/terrain");
        Self {
            relief: config.relief,
            hills: ValueNoise::new(stream.named("hills"), config.wavelength * 0.5),
            knolls: ValueNoise::new(stream.named("knolls"), config.wavelength * 0.125),
        }
    }
}

/// Heights in [0, relief).
impl HeightField for Terrain {
    fn height(&self, point: Point2) -> f64 {
        if self.relief <= 0.0 {
            return 0.0;
        }
        self.relief * ((1.0 - KNOLLS) * self.hills.at(point) + KNOLLS * self.knolls.at(point))
    }
}

/// Gives a plan its heights, where it has none: those of the land, and of bridges what they need to pass over.
///
/// # Errors
/// A plan that cannot be built.
pub(crate) fn raise(
    plan: &mut StreetPlan,
    config: &TerrainConfig,
    seed: Seed,
) -> Result<Vec<BridgeWarning>, NetworkError> {
    if config.relief > 0.0 && plan.elevations.is_empty() {
        plan.validate()?;
        plan.elevations = elevations(plan, &Terrain::new(config, seed), config);
    }
    let passes_over = plan.streets.iter().any(|street| street.level > 0);
    if !passes_over || plan.streets.iter().any(|street| !street.profile.is_empty()) {
        return Ok(Vec::new());
    }
    plan.validate()?;
    Ok(raise_bridges(plan, config))
}
