//! Places of hand-written scenes, by the city generator.

use simworld_agents::scenes::file::{PlaceError, PlaceMaker};
use simworld_citygen::landscape::Landscape;
use simworld_citygen::settlement::Settlement;
use simworld_citygen::{City, CityConfig};
use simworld_core::net::StreetPlan;
use simworld_core::scene::World;
use simworld_core::seed::Seed;
use simworld_core::spec::{SceneKind, SceneSpec};

/// The city generator: wishes become cities and lands, streets are paved and have their signals.
#[derive(Clone, Copy, Debug, Default)]
pub struct Generated;

impl PlaceMaker for Generated {
    fn wishes(&mut self, spec: &SceneSpec, seed: Seed, world: &mut World) -> Result<(), PlaceError> {
        if spec.kind == SceneKind::City {
            Settlement::build(spec, seed)?.populate(world)?;
        } else {
            Landscape::build(spec, seed)?.populate(world)?;
        }
        Ok(())
    }

    fn streets(&mut self, plan: &StreetPlan, seed: Seed, world: &mut World) -> Result<(), PlaceError> {
        let mut city = City::from_plan(plan.clone(), &CityConfig::default(), seed)?;
        // What stands beside them is written by hand.
        city.buildings.clear();
        city.elements.clear();
        city.populate(world)?;
        Ok(())
    }
}
