//! Depth is planar, in metres, and exact to 1e-4.

use crate::common::{draw, looking_east, put, renderer};
use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::{Point2, Point3, pose_facing};
use simworld_core::scene::{EntityKind, Shape, World};
use simworld_render::{RenderConfig, SKY_DEPTH};

#[test]
fn a_wall_at_a_known_distance_has_that_depth_all_over() {
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    for distance in [0.3, 2.0, 10.0, 97.0, 640.0] {
        for kind in [EntityKind::Prop, EntityKind::Building] {
            let mut world = World::new();
            let size = 20.0 * distance;
            put(&mut world, kind, [distance + 5.0, 0.0, -size * 0.5], 0.0, Shape::cuboid(10.0, size, size));
            let frame = draw(&mut renderer, &world, &looking_east(0.0, 64, 48));
            for depth in &frame.depth {
                let off = (f64::from(*depth) - distance).abs() / distance;
                assert!(off < 1e-4, "{kind} at {distance} m reads {depth}");
            }
        }
    }
}

/// Also where one huge triangle reaches from under the camera to the horizon.
#[test]
fn the_ground_has_the_depth_of_a_plane() {
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    let mut world = World::new();
    put(&mut world, EntityKind::Ground, [0.0, 0.0, -1.0], 0.0, Shape::cuboid(3000.0, 3000.0, 1.0));
    let intrinsics = Intrinsics { width: 160, height: 120, fx: 100.0, fy: 120.0, cx: 40.0, cy: 20.0 };
    let eye = Point3::new(3.0, -2.0, 1.6);
    let camera = Camera::looking_at(eye, Point3::new(30.0, 7.0, 0.0), intrinsics);
    let frame = draw(&mut renderer, &world, &camera);
    let mut checked = 0;
    for y in 0..120 {
        for x in 0..160 {
            let pixel = Point2::new(f64::from(x) + 0.5, f64::from(y) + 0.5);
            let ray = camera.world_from_optical * intrinsics.unproject(&pixel, 1.0) - eye;
            let expected = -eye.z / ray.z;
            if ray.z >= 0.0 || expected > 400.0 {
                continue;
            }
            let depth = f64::from(frame.depth_at(x, y).expect("the ground is seen"));
            assert!((depth - expected).abs() < 1e-4 * expected, "({x}, {y}): {depth}, not {expected}");
            checked += 1;
        }
    }
    assert!(checked > 10_000, "only {checked} pixels");
}

#[test]
fn round_solids_are_where_bodies_collide_with_them() {
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    let shapes = [
        Shape::Cylinder { radius: 1.0, height: 4.0 },
        Shape::Capsule { radius: 1.0, height: 4.0 },
        Shape::Sphere { radius: 1.0 },
    ];
    for shape in shapes {
        let mut world = World::new();
        let base = 2.0 - shape.size().z * 0.5;
        put(&mut world, EntityKind::Prop, [9.0, 0.0, base], 0.2, shape);
        let intrinsics = Intrinsics::from_fov(65, 65, 1.2).expect("a size in range");
        let pose = pose_facing(Point3::new(0.0, 0.0, 2.0), 0.0);
        let frame = draw(&mut renderer, &world, &Camera::looking_along(&pose, intrinsics));
        // The nearest point is 8 m away; 24 sides fall short of the circle by at most 1 %.
        let depth = frame.depth_at(32, 32).expect("it is in the middle");
        assert!((7.999..8.02).contains(&depth), "{shape:?}: {depth}");
    }
}

#[test]
fn nothing_is_infinitely_far() {
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    let frame = draw(&mut renderer, &World::new(), &looking_east(1.6, 16, 12));
    assert!(frame.depth.iter().all(|depth| *depth == SKY_DEPTH));
    assert!(frame.ids.iter().all(|id| *id == 0) && frame.classes.iter().all(|class| *class == 23));
    assert!(frame.depth_at(3, 3).is_none() && frame.entity_at(3, 3).is_none());
}
