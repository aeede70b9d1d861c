//! A person walks as far as the speed says, wherever in the world that is.

use crate::common::{Stage, at};
use simworld_core::action::{Action, StepDirection};

#[test]
fn a_person_walks_four_metres_at_any_distance_from_the_origin() {
    for start in [0.0, 10_000.0] {
        let mut stage = Stage::new();
        let walker = stage.person(at(start, -start, 0.0));
        stage.tell(walker, Action::MoveForward { speed: 1.0 });
        stage.run(40);
        let walked = stage.position(walker);
        assert!((walked.x - start - 4.0).abs() < 1e-6, "from {start}: {walked}");
        assert!((walked.y + start).abs() < 1e-6, "from {start}: {walked}");
        assert!(walked.z.abs() < 1e-3, "the soles are on the ground: {walked}");
        assert!((stage.velocity(walker).x - 1.0).abs() < 1e-6);
    }
}

#[test]
fn a_person_walks_four_metres_along_a_wall_at_any_distance_from_the_origin() {
    for start in [0.0, 10_000.0] {
        let mut stage = Stage::new();
        // Close enough for the character controller to be asked all the way.
        stage.building(start, -start + 1.33, (40.0, 2.0, 5.0));
        let walker = stage.person(at(start, -start, 0.0));
        stage.tell(walker, Action::MoveForward { speed: 1.0 });
        stage.run(40);
        let walked = stage.position(walker);
        assert!((walked.x - start - 4.0).abs() < 1e-3, "from {start}: {walked}");
        assert!((walked.y + start).abs() < 1e-3 && walked.z.abs() < 1e-3, "from {start}: {walked}");
    }
}

#[test]
fn a_person_stops_when_told() {
    let mut stage = Stage::new();
    let walker = stage.person(at(0.0, 0.0, 0.0));
    stage.tell(walker, Action::MoveForward { speed: 1.5 });
    stage.run(10);
    stage.tell(walker, Action::Stop);
    stage.run(10);
    assert!((stage.position(walker).x - 1.5).abs() < 1e-6);
    assert_eq!(stage.velocity(walker).norm(), 0.0);
}

#[test]
fn nobody_outruns_the_top_speed() {
    let mut stage = Stage::new();
    let walker = stage.person(at(0.0, 0.0, 0.0));
    stage.tell(walker, Action::MoveForward { speed: 100.0 });
    stage.run(10);
    assert!((stage.position(walker).x - 2.5).abs() < 1e-6);
}

#[test]
fn a_turn_takes_its_time_and_ends_at_the_angle() {
    let mut stage = Stage::new();
    let walker = stage.person(at(0.0, 0.0, 0.0));
    stage.tell(walker, Action::Rotate { angle: 1.0 });
    stage.run(1);
    let yaw = |stage: &Stage| simworld_core::geometry::yaw_of(&stage.physics.state(walker).unwrap().pose);
    assert!((yaw(&stage) - 0.4).abs() < 1e-9, "4 rad/s for 0.1 s: {}", yaw(&stage));
    stage.run(5);
    assert!((yaw(&stage) - 1.0).abs() < 1e-9, "{}", yaw(&stage));
}

#[test]
fn a_single_step_goes_its_distance_sideways() {
    let mut stage = Stage::new();
    let walker = stage.person(at(0.0, 0.0, 0.0));
    stage.tell(walker, Action::Step { direction: StepDirection::Left, distance: 0.5 });
    stage.run(10);
    let there = stage.position(walker);
    assert!((there.y - 0.5).abs() < 1e-6 && there.x.abs() < 1e-6, "{there}");
}

#[test]
fn a_person_without_ground_falls() {
    let mut stage = Stage::new();
    let roof = stage.building(0.0, 0.0, (4.0, 4.0, 3.0));
    let walker = stage.person(simworld_core::geometry::pose_facing(
        simworld_core::geometry::Point3::new(0.0, 0.0, 3.0),
        0.0,
    ));
    stage.run(5);
    assert!((stage.position(walker).z - 3.0).abs() < 0.01, "stands on {roof}");
    stage.tell(walker, Action::MoveForward { speed: 2.0 });
    stage.run(16);
    let falling = stage.position(walker).z;
    assert!(falling > 0.1 && falling < 2.9, "over the edge and on the way down: {falling}");
    stage.run(10);
    assert!(stage.position(walker).z < 1.0, "it is down: {}", stage.position(walker));
    stage.run(80);
    assert!(stage.position(walker).z.abs() < 0.01, "and stands: {}", stage.position(walker));
}
