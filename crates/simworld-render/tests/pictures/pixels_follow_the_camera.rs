//! A point is drawn on the pixel that `Camera::project` names.

use crate::common::{draw, looking_east, put, renderer};
use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::{Point3, Pose, Vector3};
use simworld_core::scene::{EntityKind, Shape, World};
use simworld_render::{Frame, RenderConfig};

/// The mean position of the pixels of one slot, and how many there are.
fn centroid(frame: &Frame, slot: usize) -> (f64, f64, usize) {
    let (mut x, mut y, mut count) = (0.0, 0.0, 0_usize);
    for (index, id) in frame.ids.iter().enumerate() {
        if *id as usize == slot + 1 {
            x += (index % frame.width as usize) as f64 + 0.5;
            y += (index / frame.width as usize) as f64 + 0.5;
            count += 1;
        }
    }
    (x / count as f64, y / count as f64, count)
}

#[test]
fn balls_are_drawn_where_they_project() {
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    let mut world = World::new();
    let mut balls = Vec::new();
    for k in 0..40 {
        let t = f64::from(k);
        let center = Point3::new(14.0 + (t * 1.7) % 9.0, (t * 0.77) % 14.0 - 7.0, (t * 0.41) % 8.0 - 2.0);
        let shape = Shape::Sphere { radius: 0.15 };
        let id = put(&mut world, EntityKind::Prop, [center.x, center.y, center.z - 0.15], 0.0, shape);
        balls.push((id, center));
    }
    let cameras = [
        Intrinsics { width: 320, height: 240, fx: 200.0, fy: 200.0, cx: 160.0, cy: 120.0 },
        Intrinsics { width: 320, height: 240, fx: 260.0, fy: 170.0, cx: 95.5, cy: 181.25 },
        Intrinsics { width: 200, height: 333, fx: 150.0, fy: 240.0, cx: 120.0, cy: 340.0 },
    ];
    let roll = nalgebra::UnitQuaternion::from_euler_angles(0.3, 0.12, -0.1);
    for intrinsics in cameras {
        let pose = Pose::from_parts(Vector3::new(0.5, 0.3, 1.4).into(), roll);
        let camera = Camera::looking_along(&pose, intrinsics);
        let frame = draw(&mut renderer, &world, &camera);
        let mut seen = 0;
        for (id, center) in &balls {
            let Some((pixel, depth)) = camera.project(center) else { continue };
            let reach = 0.2 * intrinsics.fx.max(intrinsics.fy) / depth;
            let inside = |value: f64, size: u32| value > reach && value < f64::from(size) - reach;
            if !inside(pixel.x, intrinsics.width) || !inside(pixel.y, intrinsics.height) {
                continue;
            }
            let (x, y, count) = centroid(&frame, id.index());
            let expected =
                std::f64::consts::PI * 0.15 * 0.15 * intrinsics.fx * intrinsics.fy / (depth * depth);
            if (count as f64) < 0.8 * expected {
                continue; // Partly hidden behind another ball.
            }
            assert!(
                (x - pixel.x).abs() < 0.5 && (y - pixel.y).abs() < 0.5,
                "{id}: ({x}, {y}) is not {pixel}"
            );
            seen += 1;
        }
        assert!(seen > 8, "only {seen} balls were seen whole");
    }
}

#[test]
fn north_is_left_of_east_and_the_sky_is_on_top() {
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    let mut world = World::new();
    let size = Shape::cuboid(1.0, 1.0, 1.0);
    let north = put(&mut world, EntityKind::Prop, [10.0, 4.0, 1.1], 0.0, size);
    let south = put(&mut world, EntityKind::Prop, [10.0, -4.0, 1.1], 0.0, size);
    let above = put(&mut world, EntityKind::Prop, [10.0, 0.0, 4.1], 0.0, size);
    let ground = put(&mut world, EntityKind::Ground, [0.0, 0.0, -1.0], 0.0, Shape::cuboid(500.0, 500.0, 1.0));
    let frame = draw(&mut renderer, &world, &looking_east(1.6, 160, 120));
    assert!(centroid(&frame, north.index()).0 < 60.0);
    assert!(centroid(&frame, south.index()).0 > 100.0);
    assert!(centroid(&frame, above.index()).1 < 50.0);
    assert_eq!(frame.entity_at(80, 119), Some(ground));
    assert_eq!(frame.entity_at(80, 0), None);
}
