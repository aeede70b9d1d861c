//! Who makes the place of a scene file: a generator, which this crate does not know.

use std::sync::Arc;

use simworld_core::geometry::{Point2, Point3, Vector2, pose_facing};
use simworld_core::net::{NetworkConfig, RoadNetwork, StreetPlan};
use simworld_core::scene::{EntityDesc, EntityKind, Shape, World};
use simworld_core::seed::Seed;
use simworld_core::spec::SceneSpec;

/// Why a place cannot be made.
pub type PlaceError = Box<dyn std::error::Error + Send + Sync>;

/// Empty ground is so thick, m; its top is at height 0.
const THICKNESS: f64 = 0.05;
/// Ground beyond the outermost street, m.
const MARGIN: f64 = 120.0;

/// Makes places in a world: the seam to a generator.
///
/// # Implementing it
///
/// The city generator behind it, as the examples have it, is four lines: `Settlement::build` or `Landscape::build` and `populate` for
/// wishes, `City::from_plan` and `populate` for streets.
pub trait PlaceMaker {
    /// Makes what is wished for, with its roads, its ground and its weather; the same for the same seed.
    ///
    /// # Errors
    /// What cannot be made.
    fn wishes(&mut self, spec: &SceneSpec, seed: Seed, world: &mut World) -> Result<(), PlaceError>;

    /// Builds streets on level ground at height 0, and nothing beside them; the same for the same seed.
    ///
    /// # Errors
    /// Streets that cannot be built.
    fn streets(&mut self, plan: &StreetPlan, seed: Seed, world: &mut World) -> Result<(), PlaceError>;
}

/// Makes no places. Streets are there for traffic, planners and editors, on plain ground on which nobody sees them.
#[derive(Clone, Copy, Debug, Default)]
pub struct NoPlaces;

impl PlaceMaker for NoPlaces {
    fn wishes(&mut self, _: &SceneSpec, _: Seed, _: &mut World) -> Result<(), PlaceError> {
        Err("nobody here makes places: load the scene with a generator, or leave out [place]".into())
    }

    fn streets(&mut self, plan: &StreetPlan, _: Seed, world: &mut World) -> Result<(), PlaceError> {
        let network = RoadNetwork::derive(plan, &NetworkConfig::default())?;
        if let Some((low, high)) = network.bounds() {
            let margin = Vector2::repeat(MARGIN);
            world.spawn(ground(low - margin, high + margin, None))?;
        }
        world.set_roads(Arc::new(network));
        Ok(())
    }
}

/// Level ground at height 0 between two corners.
pub(super) fn ground(low: Point2, high: Point2, color: Option<[f32; 3]>) -> EntityDesc {
    let (middle, size) = (nalgebra::center(&low, &high), high - low);
    let pose = pose_facing(Point3::new(middle.x, middle.y, -THICKNESS), 0.0);
    let desc = EntityDesc::new(EntityKind::Ground, pose, Shape::cuboid(size.x, size.y, THICKNESS));
    match color {
        Some(color) => desc.colored(color),
        None => desc,
    }
}
