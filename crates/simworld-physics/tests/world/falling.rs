//! Free bodies fall with g, come to rest, and report the blow.

use crate::common::Stage;
use simworld_core::event::EventKind;
use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::scene::{EntityKind, Shape};

#[test]
fn a_dropped_box_falls_with_g_and_comes_to_rest() {
    let mut stage = Stage::new();
    let pose = pose_facing(Point3::new(2.0, 3.0, 20.0), 0.4);
    let id = stage.spawn(EntityKind::Prop, pose, Shape::cuboid(0.5, 0.5, 0.5));
    stage.physics.add_rigid(&stage.world, id).unwrap();
    stage.run(10);
    assert!((stage.velocity(id).z + 9.81).abs() < 1e-6, "{}", stage.velocity(id));
    // Half g t²; the integrator's step adds at most g t dt / 2.
    let fallen = 20.0 - stage.position(id).z;
    assert!((fallen - 4.905).abs() < 9.81 * 0.05 / 2.0 + 1e-6, "{fallen}");
    stage.run(60);
    let rest = stage.position(id);
    assert!(rest.z.abs() < 0.01 && (rest.x - 2.0).abs() < 0.05, "{rest}");
    assert!(stage.velocity(id).norm() < 1e-3);
    let before = rest;
    stage.run(20);
    assert_eq!(stage.position(id), before, "a body at rest sleeps");
}

#[test]
fn a_box_on_a_box_reports_one_blow_with_its_speed() {
    let mut stage = Stage::new();
    let table = stage.building(0.0, 0.0, (2.0, 2.0, 1.0));
    let id = stage.spawn(
        EntityKind::Prop,
        pose_facing(Point3::new(0.0, 0.0, 3.0), 0.0),
        Shape::cuboid(0.4, 0.4, 0.4),
    );
    stage.physics.add_rigid(&stage.world, id).unwrap();
    stage.run(40);
    assert!((stage.position(id).z - 1.0).abs() < 0.01);
    let blows: Vec<_> = stage
        .contacts
        .iter()
        .map(|event| match event {
            EventKind::Contact { a, b, point, closing_speed, .. } => (*a, *b, *point, *closing_speed),
            other => panic!("{other:?}"),
        })
        .collect();
    assert_eq!((blows[0].0, blows[0].1), (table, id));
    assert!((blows[0].2.z - 1.0).abs() < 0.3, "at {}", blows[0].2);
    // √(2 g h) for 2 m is 6.26 m/s; the contact may be seen up to one substep early.
    assert!(blows[0].3 > 5.2 && blows[0].3 < 6.4, "{}", blows[0].3);
}
