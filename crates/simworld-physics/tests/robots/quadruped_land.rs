//! Robot dogs on legs where the ground is no plane: hills, stairs, people in the way; and saved at many moments.
#![allow(clippy::unwrap_used)]

use std::sync::Arc;

use crate::common::{Stage, at, ramp};
use simworld_core::action::Action;
use simworld_core::geometry::{Point2, Point3, Vector2, pose_facing};
use simworld_core::ground::{Cover, Ground, GroundData};
use simworld_core::ops;
use simworld_core::scene::{EntityKind, Footing};
use simworld_physics::Command;

fn forward(speed: f64) -> Command {
    Command { forward: speed, ..Command::default() }
}

/// Hills of up to 20°, 0.5 m from point to point.
fn hills() -> Arc<Ground> {
    let (columns, rows, origin) = (121, 61, Point2::new(-20.0, -15.0));
    let height = |index: u32| {
        let at = origin + Vector2::new(f64::from(index % columns), f64::from(index / columns)) * 0.5;
        (0.8 * ops::sin(0.4 * at.x) + 0.3 * ops::sin(0.5 * at.y)) as f32
    };
    let heights = (0..columns * rows).map(height).collect();
    let covers = vec![Cover::Grass; (columns * rows) as usize];
    let data = GroundData { origin, spacing: 0.5, columns, rows, heights, covers, water: None };
    Arc::new(Ground::new(data).unwrap())
}

#[test]
fn it_walks_over_hills() {
    let (mut stage, land) = (Stage::new(), hills());
    stage.world.set_ground(Arc::clone(&land));
    let start = Point3::new(-6.0, 0.5, land.height(Point2::new(-6.0, 0.5)));
    let dog = stage.legged_dog(pose_facing(start, 0.3));
    stage.run(5);
    stage.command(dog, forward(0.6));
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for _ in 0..200 {
        stage.run(1);
        assert_eq!(stage.quadruped(dog).footing(), Footing::Upright);
        let z = stage.position(dog).z;
        (low, high) = (low.min(z), high.max(z));
    }
    let place = stage.position(dog);
    println!("over hills to {place}, between {low:.2} and {high:.2} m");
    assert!((place - start).norm() > 8.0 && high - low > 0.9, "{place}, {low} to {high}");
    assert!((place.z - land.height(Point2::new(place.x, place.y))).abs() < 0.1, "{place}");
}

/// Put on a slope in any direction, it finds its feet there.
#[test]
fn it_is_put_on_a_slope_and_stands() {
    let slope = 20f64.to_radians();
    for yaw in [0.0, 1.5, 3.1, 4.0] {
        let mut stage = Stage::new();
        let (pose, shape) = ramp(0.0, slope);
        stage.spawn(EntityKind::Building, pose, shape);
        stage.run(1);
        let place = Point3::new(3.0, 0.0, 3.0 * ops::tan(slope) + 0.01);
        let dog = stage.legged_dog(pose_facing(place, yaw));
        stage.run(30);
        let moved = stage.position(dog) - place;
        println!("put on a slope, facing {yaw}: {moved}");
        assert_eq!(stage.quadruped(dog).footing(), Footing::Upright, "facing {yaw}");
        assert!(moved.norm() < 0.15 && stage.quadruped(dog).trunk_height() > 0.27, "facing {yaw}: {moved}");
        assert!(stage.events.is_empty(), "{:?}", stage.events);
    }
}

#[test]
fn it_climbs_stairs() {
    let mut stage = Stage::new();
    for step in 0..6 {
        let (run, rise) = (0.4, 0.1);
        let from = 1.0 + run * f64::from(step);
        stage.building((from + 6.0) * 0.5, 0.0, (6.0 - from, 3.0, rise * f64::from(step + 1)));
    }
    let dog = stage.legged_dog(at(0.0, 0.0, 0.0));
    stage.command(dog, forward(0.4));
    for _ in 0..130 {
        stage.run(1);
        assert_eq!(stage.quadruped(dog).footing(), Footing::Upright, "{}", stage.position(dog));
    }
    let place = stage.position(dog);
    println!("up stairs to {place}");
    assert!(place.z > 0.57 && place.x > 3.5, "{place}");
    // And backwards down again.
    stage.command(dog, forward(-0.4));
    for _ in 0..140 {
        stage.run(1);
        assert_eq!(stage.quadruped(dog).footing(), Footing::Upright, "{}", stage.position(dog));
    }
    let place = stage.position(dog);
    println!("down stairs to {place}");
    assert!(place.z.abs() < 0.03 && place.x < 0.7, "{place}");
}

/// People are no part of the solver while they stand: they stop it, and it them.
#[test]
fn a_person_in_the_way_stops_it_and_it_stays_on_its_feet() {
    let mut stage = Stage::new();
    let dog = stage.legged_dog(at(0.0, 0.0, 0.0));
    let person = stage.person(at(2.0, 0.0, 0.0));
    stage.command(dog, forward(0.4));
    stage.run(80);
    assert_eq!(stage.quadruped(dog).footing(), Footing::Upright);
    let gap = stage.position(person).x - stage.position(dog).x;
    assert!(gap > 0.3 || stage.position(dog).y.abs() > 0.3, "{gap}");
    // Now the person walks at it.
    stage.command(dog, forward(0.0));
    stage.tell(person, Action::Rotate { angle: std::f64::consts::PI });
    stage.run(15);
    stage.tell(person, Action::MoveForward { speed: 1.0 });
    stage.run(50);
    let body = stage.quadruped(dog);
    assert!(body.trunk_height().is_finite() && stage.position(dog).coords.norm() < 10.0);
}
