//! Steps and slopes: what a person climbs and what is too high or too steep.

mod common;

use common::{Stage, at, ramp};
use simworld_core::action::Action;
use simworld_core::scene::EntityKind;

fn climb(stage: &mut Stage, speed: f64) -> simworld_core::geometry::Point3 {
    let walker = stage.person(at(0.0, 0.0, 0.0));
    stage.tell(walker, Action::MoveForward { speed });
    stage.run(60);
    stage.position(walker)
}

#[test]
fn a_low_step_is_taken() {
    let mut stage = Stage::new();
    stage.building(7.0, 0.0, (10.0, 4.0, 0.2));
    let there = climb(&mut stage, 1.0);
    assert!(there.x > 5.5, "{there}");
    assert!((there.z - 0.2).abs() < 0.01, "{there}");
}

#[test]
fn a_high_step_is_refused() {
    let mut stage = Stage::new();
    stage.building(7.0, 0.0, (10.0, 4.0, 0.6));
    let there = climb(&mut stage, 1.0);
    assert!(there.x < 1.76 && there.z < 0.05, "{there}");
}

#[test]
fn a_flight_of_stairs_is_climbed() {
    let mut stage = Stage::new();
    for step in 0..8 {
        let step = f64::from(step);
        stage.building(2.0 + step * 0.3 + 5.0, 0.0, (10.0, 4.0, 0.17 * (step + 1.0)));
    }
    let there = climb(&mut stage, 1.34);
    assert!((there.z - 8.0 * 0.17).abs() < 0.02, "{there}");
}

#[test]
fn a_gentle_slope_is_walked_up() {
    for degrees in [10.0f64, 20.0, 35.0] {
        let mut stage = Stage::new();
        let (pose, shape) = ramp(1.0, degrees.to_radians());
        stage.spawn(EntityKind::Building, pose, shape);
        let there = climb(&mut stage, 1.34);
        assert!(there.z > 0.5 && there.x > 2.0, "{degrees}°: {there}");
        let height = (there.x - 1.0) * simworld_core::ops::tan(degrees.to_radians());
        // The sole is level: its rear edge touches the slope.
        assert!(there.z < height + 0.3 && there.z > height - 0.05, "{degrees}°: {there} on {height}");
    }
}

#[test]
fn a_slope_of_fifty_degrees_is_refused() {
    let mut stage = Stage::new();
    let (pose, shape) = ramp(1.0, 50f64.to_radians());
    stage.spawn(EntityKind::Building, pose, shape);
    let there = climb(&mut stage, 1.34);
    assert!(there.x < 1.3 && there.z < 0.3, "{there}");
}
