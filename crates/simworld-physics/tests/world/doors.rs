//! Doors swing on their hinges under what pushes them, and are opened at their handles.
#![allow(clippy::unwrap_used)]

use crate::common::{Stage, at};
use simworld_core::action::Action;
use simworld_core::geometry::{Point3, Pose, Vector3};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape};
use simworld_core::seam::Dynamics;
use simworld_physics::{Door, DoorConfig, Latch, PhysicsError};

/// Four centimetres thick, a metre wide, two metres high, 20 kg; faces east.
fn leaf() -> Shape {
    Shape::cuboid(0.04, 1.0, 2.0)
}

fn hang(stage: &mut Stage, pose: Pose, config: DoorConfig) -> EntityId {
    let desc =
        EntityDesc::new(EntityKind::Door, pose, leaf()).weighing(20.0).accessed_at(config.handle(&leaf()));
    let id = stage.world.spawn(desc).unwrap();
    stage.physics.add_door(&stage.world, id, config).unwrap();
    id
}

fn door(stage: &Stage, id: EntityId) -> &Door {
    stage.physics.body_as(id).unwrap()
}

fn free() -> DoorConfig {
    DoorConfig { latch: Latch::Nothing, damping: 0.0, swing: [-2.0, 2.0], ..DoorConfig::default() }
}

#[test]
fn what_strikes_a_leaf_gives_it_its_angular_momentum() {
    let mut stage = Stage::new();
    let id = hang(&mut stage, at(0.0, 0.0, 0.0), free());
    // 20 kg a metre wide: 20 / 3 kg m²; the hinge is at y = 0.5.
    assert!((door(&stage, id).inertia() - 20.0 / 3.0).abs() < 0.01);
    let arm = 0.8;
    let ball = stage.ball(Point3::new(-0.5, 0.5 - arm, 0.9), Vector3::new(6.0, 0.0, 0.0), 1.0);
    for _ in 0..20 {
        stage.tick(1.0 / 60.0);
    }
    let speed = door(&stage, id).speed();
    let left = stage.velocity(ball).x;
    let lost = arm * (6.0 - left);
    assert!(speed > 0.3, "{speed}");
    assert!((speed * 20.0 / 3.0 - lost).abs() < 0.05 * lost, "{} N m s and {lost}", speed * 20.0 / 3.0);
}

#[test]
fn a_closer_closes_by_its_formula() {
    let mut stage = Stage::new();
    let config = DoorConfig { closer: 12.0, damping: 40.0, hold: 1.0, hand: 60.0, ..free() };
    let id = hang(&mut stage, at(0.0, 0.0, 0.0), config);
    stage.world.set_attribute(id, "open", Some(true.into())).unwrap();
    stage.run(60);
    // Held for a second from when it was told, then let go: I a'' + c a' + k a = 0.
    let (mut angle, mut speed) = (door(&stage, id).angle(), door(&stage, id).speed());
    assert!(angle > 0.05, "{angle}");
    for _ in 0..20 {
        stage.run(1);
        for _ in 0..1000 {
            speed += (-12.0 * angle - 40.0 * speed) / (20.0 / 3.0) * 1e-4;
            angle += speed * 1e-4;
        }
        assert!((door(&stage, id).angle() - angle).abs() < 0.01, "{} {angle}", door(&stage, id).angle());
    }
}

#[test]
fn a_latched_door_is_opened_at_its_handle_and_no_other_way() {
    let mut stage = Stage::new();
    let id = hang(&mut stage, at(2.0, 0.0, 0.0), DoorConfig::default());
    let walker = stage.person(at(0.0, -0.4, 0.0));
    stage.tell(walker, Action::MoveForward { speed: 1.3 });
    stage.run(40);
    assert!(stage.position(walker).x < 1.8 && door(&stage, id).is_latched());
    stage.tell(walker, Action::Stop);
    stage.run(1);
    stage.tell(walker, Action::OpenDoor { door: id });
    let mut most: f64 = 0.0;
    for _ in 0..30 {
        stage.run(1);
        most = most.max(door(&stage, id).angle());
    }
    assert!(most > 1.4 && most < 1.52, "{most}");
    stage.tell(walker, Action::MoveForward { speed: 1.3 });
    stage.run(25);
    assert!(stage.position(walker).x > 2.5, "{}", stage.position(walker));
    stage.tell(walker, Action::Stop);
    stage.run(80);
    assert!(!door(&stage, id).is_latched(), "nothing closes it by itself");
    stage.world.set_attribute(id, "open", Some(false.into())).unwrap();
    stage.run(60);
    assert!(door(&stage, id).is_latched() && door(&stage, id).angle() == 0.0);
    let closed = *stage.world.entity(id).unwrap().pose;
    assert!((closed.translation.vector - at(2.0, 0.0, 0.0).translation.vector).norm() < 1e-9);
}

#[test]
fn a_door_that_closes_by_itself_latches_and_says_so() {
    let mut stage = Stage::new();
    let config = DoorConfig { closer: 8.0, damping: 10.0, hold: 3.0, ..DoorConfig::default() };
    let id = hang(&mut stage, at(0.0, 0.0, 0.0), config);
    stage.world.set_attribute(id, "open", Some(true.into())).unwrap();
    stage.run(25);
    assert!(door(&stage, id).angle() > 1.2, "{}", door(&stage, id).angle());
    stage.run(120);
    assert!(door(&stage, id).is_latched() && !stage.world.entity(id).unwrap().is_open());
    // And once more, though it has been shut.
    stage.world.set_attribute(id, "open", Some(true.into())).unwrap();
    stage.run(25);
    assert!(door(&stage, id).angle() > 1.2);
}

#[test]
fn the_ends_of_its_way_are_held() {
    let mut stage = Stage::new();
    let config = DoorConfig { swing: [-0.5, 1.0], ..free() };
    let id = hang(&mut stage, at(0.0, 0.0, 0.0), config);
    stage.ball(Point3::new(-1.0, -0.4, 0.9), Vector3::new(30.0, 0.0, 0.0), 3.0);
    let [mut low, mut high] = [0.0_f64; 2];
    for _ in 0..300 {
        stage.tick(1.0 / 60.0);
        low = low.min(door(&stage, id).angle());
        high = high.max(door(&stage, id).angle());
    }
    assert!(high > 0.9 && high < 1.05 && low > -0.55, "{low} {high}");
}

#[test]
fn somebody_walks_through_a_swing_door() {
    let mut stage = Stage::new();
    let id = hang(&mut stage, at(2.0, 0.0, 0.0), DoorConfig { closer: 4.0, damping: 4.0, ..free() });
    let walker = stage.person(at(0.0, -0.25, 0.0));
    stage.tell(walker, Action::MoveForward { speed: 1.2 });
    let mut most: f64 = 0.0;
    for _ in 0..60 {
        stage.run(1);
        most = most.max(door(&stage, id).angle());
    }
    assert!(stage.position(walker).x > 3.0 && most > 0.3, "{} {most}", stage.position(walker));
    stage.tell(walker, Action::Stop);
    stage.run(100);
    assert!(door(&stage, id).angle().abs() < 0.05, "{}", door(&stage, id).angle());
}

#[test]
fn doors_are_the_same_bits_over_snapshot_and_restore() {
    let make = || {
        let mut stage = Stage::new();
        let id = hang(&mut stage, at(0.0, 0.0, 0.3), DoorConfig { closer: 5.0, ..DoorConfig::default() });
        (stage, id)
    };
    let (mut one, id) = make();
    one.world.set_attribute(id, "open", Some(true.into())).unwrap();
    one.run(10);
    let (saved, world) = (one.physics.save().unwrap(), one.world.clone());
    one.run(40);
    let (mut two, _) = make();
    two.world = world;
    two.physics.restore(&two.world, &saved).unwrap();
    two.run(40);
    assert_eq!(one.physics.save().unwrap(), two.physics.save().unwrap());
}

#[test]
fn what_is_no_door_is_refused() {
    let mut stage = Stage::new();
    let id = stage.spawn(EntityKind::Door, at(0.0, 0.0, 0.0), Shape::cuboid(1.0, 1.0, 2.0));
    let error = stage.physics.add_door(&stage.world, id, DoorConfig::default()).unwrap_err();
    assert!(matches!(error, PhysicsError::Shape { .. }), "{error}");
    let config = DoorConfig { swing: [0.5, 1.0], ..DoorConfig::default() };
    assert!(stage.physics.add_door(&stage.world, id, config).unwrap_err().to_string().contains("swing"));
    let handle = DoorConfig::default().handle(&leaf());
    assert!((handle - Point3::new(0.0, -0.43, 1.0)).norm() < 1e-9, "{handle}");
}
