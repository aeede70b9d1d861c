//! Steps and slopes: what a person climbs and what is too high or too steep.

use crate::common::{Stage, at, ramp};
use simworld_core::action::Action;
use simworld_core::event::EventKind;
use simworld_core::scene::EntityKind;

fn climb(stage: &mut Stage, speed: f64) -> simworld_core::geometry::Point3 {
    climb_for(stage, speed, 60)
}

fn climb_for(stage: &mut Stage, speed: f64, steps: usize) -> simworld_core::geometry::Point3 {
    let walker = stage.person(at(0.0, 0.0, 0.0));
    stage.tell(walker, Action::MoveForward { speed });
    stage.run(steps);
    let fell = stage.events.iter().any(|event| matches!(event, EventKind::Fell { .. }));
    assert!(!fell, "whoever climbs stays up");
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
    for (degrees, steps) in [(10.0f64, 60), (20.0, 60), (35.0, 150), (40.0, 250), (43.0, 350)] {
        let mut stage = Stage::new();
        let (pose, shape) = ramp(1.0, degrees.to_radians());
        stage.spawn(EntityKind::Building, pose, shape);
        let there = climb_for(&mut stage, 1.34, steps);
        assert!(there.z > 0.5 && there.x > 2.0, "{degrees}°: {there}");
        let height = (there.x - 1.0) * simworld_core::ops::tan(degrees.to_radians());
        // The sole is level: its rear edge touches the slope.
        assert!(there.z < height + 0.3 && there.z > height - 0.05, "{degrees}°: {there} on {height}");
    }
}

#[test]
fn a_slope_beyond_forty_five_degrees_is_refused() {
    for degrees in [47f64, 50.0, 60.0] {
        let mut stage = Stage::new();
        let (pose, shape) = ramp(1.0, degrees.to_radians());
        stage.spawn(EntityKind::Building, pose, shape);
        let there = climb(&mut stage, 1.34);
        assert!(there.x < 1.3 && there.z < 0.3, "{degrees}°: {there}");
    }
}

#[test]
fn the_limit_of_steps_holds_from_both_sides() {
    for (height, taken) in [(0.12, true), (0.18, true), (0.24, true), (0.27, false), (0.4, false)] {
        let mut stage = Stage::new();
        stage.building(7.0, 0.0, (10.0, 4.0, height));
        let there = climb(&mut stage, 1.34);
        assert_eq!(there.x > 2.5 && (there.z - height).abs() < 0.01, taken, "{height} m: {there}");
        assert_eq!(there.x < 1.76 && there.z < 0.05, !taken, "{height} m: {there}");
    }
}

/// Time to go from one place to another eastwards, s.
fn time_between(stage: &mut Stage, walker: simworld_core::id::EntityId, from: f64, to: f64) -> f64 {
    let (mut steps, mut began) = (0, None);
    while stage.position(walker).x < to {
        stage.run(1);
        steps += 1;
        if began.is_none() && stage.position(walker).x >= from {
            began = Some(steps);
        }
        assert!(steps < 2000, "{}", stage.position(walker));
    }
    f64::from(steps - began.unwrap_or_default()) * 0.1
}

#[test]
fn stairs_up_take_longer_than_stairs_down_and_both_longer_than_the_level() {
    let mut stage = Stage::new();
    // Twenty steps up from 2 m on, a landing, and as many down from 12 m on.
    for step in 0..20 {
        let along = 0.3 * f64::from(step);
        let height = 0.17 * f64::from(step + 1);
        stage.building(2.0 + along + (16.0 - 2.0 * along) / 2.0, 0.0, (16.0 - 2.0 * along, 4.0, height));
    }
    let walker = stage.person(at(-4.0, 0.0, 0.0));
    stage.tell(walker, Action::MoveForward { speed: 1.34 });
    let level = 4.0 / time_between(&mut stage, walker, -3.0, 1.0);
    let up = 4.0 / time_between(&mut stage, walker, 3.0, 7.0);
    let down = 4.0 / time_between(&mut stage, walker, 13.0, 17.0);
    assert!((level - 1.34).abs() < 0.05, "{level}");
    assert!((0.32..0.37).contains(&(up / level)), "{up} of {level} m/s");
    assert!((0.47..0.52).contains(&(down / level)), "{down} of {level} m/s");
}

#[test]
fn slopes_are_walked_as_fast_as_tobler_found() {
    for (grade, share) in [(0.1f64, 0.705), (0.3, 0.350)] {
        let mut stage = Stage::new();
        let (pose, shape) = ramp(1.0, simworld_core::ops::atan2(grade, 1.0));
        stage.spawn(EntityKind::Building, pose, shape);
        let walker = stage.person(at(0.0, 0.0, 0.0));
        stage.tell(walker, Action::MoveForward { speed: 1.34 });
        let speed = 5.0 / time_between(&mut stage, walker, 4.0, 9.0);
        assert!((speed / 1.34 - share).abs() < 0.015, "grade {grade}: {speed} m/s");
    }
}
