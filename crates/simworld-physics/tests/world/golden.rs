//! The bits of a run stay what they are from commit to commit, until somebody means to change them.

use crate::common::{Stage, at};
use simworld_core::action::Action;
use simworld_core::geometry::{Point3, Vector3};
use simworld_core::hash::{StateHash, StateHasher};
use simworld_core::scene::{EntityKind, Shape};
use simworld_physics::VehicleClass;

/// What the run below comes to; whoever changes what bodies do changes this, in the same commit. Robots are not in it: the engine's
/// matrices are multiplied by what the processor has.
const GOLDEN: &str = "ea8b004f4b14dc4a";

#[test]
fn a_run_has_the_bits_that_it_had() {
    let mut stage = Stage::new();
    stage.building(12.0, 0.0, (10.0, 8.0, 0.4));
    let runner = stage.person(at(0.0, 0.0, 0.0));
    stage.tell(runner, Action::MoveForward { speed: 2.5 });
    let rider = stage.person(at(0.0, 10.0, 0.0));
    let scooter = stage.spawn(EntityKind::Scooter, at(0.8, 10.0, 0.0), Shape::cuboid(1.1, 0.5, 1.2));
    stage.tell(rider, Action::RideScooter { scooter });
    let car = stage.spawn(EntityKind::Car, at(0.0, 20.0, 0.0), Shape::cuboid(4.3, 1.8, 1.5));
    stage.physics.add_vehicle(&stage.world, car, VehicleClass::Sedan.parameters()).unwrap();
    stage.tell(car, Action::Throttle { level: 0.6 });
    for k in 0..12 {
        let place = Point3::new(40.0, 20.0 + 0.03 * f64::from(k), 0.1 + 0.25 * f64::from(k));
        stage.ball(place, Vector3::y(), 0.5);
    }
    stage.step();
    stage.tell(rider, Action::MoveForward { speed: 5.0 });
    stage.tell(rider, Action::Rotate { angle: 1.0 });
    stage.run(99);
    let mut hasher = StateHasher::new();
    stage.world.state_hash(&mut hasher);
    stage.physics.state_hash(&mut hasher);
    assert_eq!(hasher.finish().to_string(), GOLDEN);
}
