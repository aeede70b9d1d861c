//! Rays meet what they should, at the distance that core's own boxes give.

use crate::common::{Stage, at};
use proptest::prelude::*;
use simworld_core::geometry::{Point3, Ray, Vector3, pose_facing};
use simworld_core::scene::{EntityKind, RayCast, Shape};
use simworld_physics::{PhysicsConfig, PhysicsDynamics};

fn ray(origin: (f64, f64, f64), direction: (f64, f64, f64)) -> Ray {
    let direction = Vector3::new(direction.0, direction.1, direction.2).normalize();
    Ray { origin: Point3::new(origin.0, origin.1, origin.2), direction }
}

#[test]
fn round_shapes_are_met_on_their_surface() {
    let mut stage = Stage::new();
    let pillar =
        stage.spawn(EntityKind::Tree, at(10.0, 0.0, 0.0), Shape::Cylinder { radius: 1.0, height: 5.0 });
    stage.step();
    let hit = stage.physics.cast_ray(&ray((0.0, 0.5, 1.0), (1.0, 0.0, 0.0)), 50.0, &|_| true).unwrap();
    assert_eq!(hit.entity, pillar);
    assert!((hit.distance - (10.0 - 0.75f64.sqrt())).abs() < 1e-6, "{hit:?}");
    assert!((hit.normal - Vector3::new(-(0.75f64.sqrt()), 0.5, 0.0)).norm() < 1e-3, "{hit:?}");
    // A corner of the box around the pillar is air.
    assert!(stage.physics.cast_ray(&ray((9.05, -5.0, 1.0), (0.0, 1.0, 0.0)), 4.5, &|_| true).is_none());
}

#[test]
fn filters_inside_and_reach_are_respected() {
    let mut stage = Stage::new();
    let near = stage.building(5.0, 0.0, (2.0, 2.0, 2.0));
    let far = stage.building(15.0, 0.0, (2.0, 2.0, 2.0));
    stage.step();
    let east = ray((0.0, 0.0, 1.0), (1.0, 0.0, 0.0));
    let cast = |ray: &Ray, reach: f64, skip| stage.physics.cast_ray(ray, reach, &|id| Some(id) != skip);
    assert_eq!(cast(&east, 100.0, None).map(|hit| hit.entity), Some(near));
    assert_eq!(cast(&east, 100.0, Some(near)).map(|hit| (hit.entity, hit.distance)), Some((far, 14.0)));
    assert!(cast(&east, 3.9, None).is_none());
    let inside = cast(&ray((5.0, 0.0, 1.0), (1.0, 0.0, 0.0)), 100.0, None).unwrap();
    assert_eq!((inside.entity, inside.distance), (near, 0.0));
    assert!((inside.normal + Vector3::x()).norm() < 1e-12);
    assert!(
        cast(&ray((0.0, 0.0, 1.0), (0.0, 0.0, -1.0)), 100.0, None).is_none(),
        "the ground lets rays pass"
    );
}

#[test]
fn distant_traffic_is_met_and_overlapped_like_near_traffic() {
    let mut stage = Stage::new();
    let car = stage.spawn(EntityKind::Car, at(200.0, 0.0, 0.0), Shape::cuboid(4.0, 1.8, 1.5));
    for is_near in [false, true] {
        if is_near {
            stage.person(at(195.0, 5.0, 0.0));
        }
        stage.step();
        let east = ray((100.0, 0.0, 1.0), (1.0, 0.0, 0.0));
        let hit = stage.physics.cast_ray(&east, 500.0, &|_| true).unwrap();
        assert_eq!(hit.entity, car);
        assert!((hit.distance - 98.0).abs() < 1e-9 && (hit.normal + Vector3::x()).norm() < 1e-9, "{hit:?}");
        let mut found = Vec::new();
        let ball = Shape::Sphere { radius: 1.0 };
        stage.physics.overlapping(&ball, &at(197.5, 0.0, 0.0), &mut found);
        assert_eq!(found, [car]);
        stage.physics.overlapping(&ball, &at(196.5, 0.0, 0.0), &mut found);
        assert!(found.is_empty());
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]
    #[test]
    fn boxes_are_met_where_core_says(
        boxes in proptest::collection::vec((-40.0..40.0f64, -40.0..40.0f64, -3.0..3.0f64, 0.5..8.0f64, 0.5..8.0f64), 1..40),
        rays in proptest::collection::vec((-50.0..50.0f64, -50.0..50.0f64, 0.1..6.0f64, -1.0..1.0f64, -1.0..1.0f64, -0.1..0.1f64), 30),
    ) {
        let mut stage = Stage::new();
        for (x, y, yaw, length, width) in boxes {
            let pose = pose_facing(Point3::new(x, y, 0.0), yaw);
            stage.spawn(EntityKind::Building, pose, Shape::cuboid(length, width, 5.0));
        }
        stage.physics = PhysicsDynamics::new(PhysicsConfig::default()).unwrap();
        stage.step();
        for (x, y, z, dx, dy, dz) in rays {
            prop_assume!(dx.abs() + dy.abs() > 0.01);
            let ray = ray((x, y, z), (dx, dy, dz));
            let ours = stage.physics.cast_ray(&ray, 80.0, &|_| true);
            let core = stage.world.cast_ray(&ray, 80.0, &|_| true);
            match (ours, core) {
                (Some(ours), Some(core)) => {
                    prop_assert!((ours.distance - core.distance).abs() < 1e-9, "{ours:?} {core:?}");
                    let same_face = (ours.normal - core.normal).norm() < 1e-6;
                    prop_assert!(same_face || ours.entity != core.entity || core.distance == 0.0, "{ours:?} {core:?}");
                }
                (ours, core) => prop_assert_eq!(ours, core),
            }
        }
    }
}
