//! Where streets come from: growth, a file, or a mind of one's own.

use simworld_core::net::StreetPlan;
use simworld_core::seed::Seed;

use crate::{CityError, RoadConfig, growth, name};

/// A source of streets; everything else of a city follows from them.
///
/// # Implementing it
///
/// A town of one ring and its spokes:
///
/// ```
/// use simworld_citygen::{City, CityConfig, CityError, RoadSource};
/// use simworld_core::geometry::{Point2, direction};
/// use simworld_core::net::{Street, StreetPlan};
/// use simworld_core::seed::Seed;
///
/// struct RingTown { spokes: usize, radius: f64 }
///
/// impl RoadSource for RingTown {
///     fn streets(&self, _: Seed) -> Result<StreetPlan, CityError> {
///         let mut plan = StreetPlan { nodes: vec![Point2::origin()], ..StreetPlan::default() };
///         for spoke in 0..self.spokes {
///             let angle = std::f64::consts::TAU * spoke as f64 / self.spokes as f64;
///             plan.nodes.push(Point2::origin() + direction(angle) * self.radius);
///             plan.streets.push(Street::simple(0, spoke + 1));
///             plan.streets.push(Street::simple(spoke + 1, (spoke + 1) % self.spokes + 1));
///         }
///         Ok(plan)
///     }
/// }
///
/// let town = City::from_source(&RingTown { spokes: 6, radius: 180.0 }, &CityConfig::default(), Seed(1))?;
/// assert_eq!(town.network.roads.len(), 12);
/// assert!(!town.buildings.is_empty());
/// # Ok::<(), CityError>(())
/// ```
pub trait RoadSource {
    /// The streets for a seed: the same for the same seed, meeting only at nodes.
    ///
    /// # Errors
    /// What the source cannot do.
    fn streets(&self, seed: Seed) -> Result<StreetPlan, CityError>;
}

/// Growth.
impl RoadSource for RoadConfig {
    fn streets(&self, seed: Seed) -> Result<StreetPlan, CityError> {
        self.validate()?;
        let mut plan = growth::grow(self, seed);
        plan.make_turning_room();
        name::streets(&mut plan, seed);
        Ok(plan)
    }
}

/// A plan that is there already.
impl RoadSource for StreetPlan {
    fn streets(&self, _: Seed) -> Result<StreetPlan, CityError> {
        self.validate()?;
        Ok(self.clone())
    }
}
