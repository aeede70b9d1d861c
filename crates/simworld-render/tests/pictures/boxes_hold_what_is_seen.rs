//! Boxes lie around what is seen, know what is hidden, and stand where the bodies do.

use std::sync::{Arc, Mutex};

use crate::common::{draw, looking_east, put, renderer, square_with_walker};
use simworld_core::camera::Intrinsics;
use simworld_core::scene::{EntityKind, Scene, Shape, World};
use simworld_core::testing::check_observer;
use simworld_render::{BoxSensor, CameraSensor, RenderConfig, boxes_of};

const NEAR: f64 = 0.05;

#[test]
fn boxes_are_tight_and_hidden_bodies_have_no_pixels() {
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    let mut world = World::new();
    let wall = put(&mut world, EntityKind::Prop, [10.0, 3.0, -1.0], 0.0, Shape::cuboid(0.5, 4.0, 5.0));
    let hidden = put(
        &mut world,
        EntityKind::Person,
        [14.0, 4.0, 0.0],
        0.0,
        Shape::Capsule { radius: 0.25, height: 1.75 },
    );
    let half = put(&mut world, EntityKind::Prop, [20.0, 2.0, 0.0], 0.0, Shape::cuboid(2.0, 2.0, 2.0));
    let free = put(&mut world, EntityKind::Prop, [15.0, -4.0, 0.0], 0.6, Shape::Sphere { radius: 1.0 });
    let outside = put(&mut world, EntityKind::Prop, [-9.0, 0.0, 0.0], 0.0, Shape::cuboid(1.0, 1.0, 1.0));
    let camera = looking_east(1.0, 128, 96);
    let frame = draw(&mut renderer, &world, &camera);
    let ids = [wall, hidden, half, free, outside];
    let boxes = boxes_of(&world, &camera, &frame, &ids, NEAR, Some(&mut renderer)).expect("boxes");
    assert_eq!(boxes.iter().map(|found| found.id).collect::<Vec<_>>(), ids);
    for found in &boxes {
        let pixels: Vec<_> = (0..96)
            .flat_map(|y| (0..128).map(move |x| (x, y)))
            .filter(|(x, y)| frame.entity_at(*x, *y) == Some(found.id))
            .collect();
        assert_eq!(found.visible_pixels as usize, pixels.len(), "{}", found.id);
        let span = found.visible.map(|b| (b.left, b.right - 1, b.top, b.bottom - 1));
        let (xs, ys) = (pixels.iter().map(|p| p.0), pixels.iter().map(|p| p.1));
        let expected = xs
            .clone()
            .min()
            .map(|left| (left, xs.max().unwrap(), ys.clone().min().unwrap(), ys.max().unwrap()));
        assert_eq!(span, expected, "{}", found.id);
    }
    let [wall, hidden, half, free, outside] = &boxes[..] else { panic!("five boxes") };
    assert!(wall.occlusion().unwrap() < 0.02 && free.occlusion().unwrap() < 0.02, "{wall:?} {free:?}");
    assert_eq!((hidden.visible, hidden.visible_pixels, hidden.occlusion()), (None, 0, Some(1.0)));
    assert!(hidden.amodal.is_some() && hidden.alone_pixels.unwrap() > 5, "{hidden:?}");
    // The wall's edge at y = 1 m, seen from 9.75 m, covers what lies left of y = 1.95 m on the near face of the other, 19 m away.
    assert!((half.occlusion().unwrap() - 0.5).abs() < 0.12, "{:?}", half.occlusion());
    assert_eq!((outside.visible, outside.amodal, outside.truncation), (None, None, 1.0));
    // A solid that is in full view fills its projection.
    let (seen, whole) = (free.visible.unwrap(), free.amodal.unwrap());
    for (a, b) in [
        (seen.left, whole.left),
        (seen.right, whole.right),
        (seen.top, whole.top),
        (seen.bottom, whole.bottom),
    ] {
        assert!(a.abs_diff(b) <= 1, "{seen:?} in {whole:?}");
    }
    assert_eq!(free.truncation, 0.0);
    let center = free.optical.pose.translation.vector;
    assert!((center - nalgebra::Vector3::new(4.0, 0.0, 15.0)).norm() < 1e-9, "{center}");
    assert_eq!(free.world, world.entity(free.id).unwrap().obb());
}

#[test]
fn what_reaches_out_of_the_picture_is_truncated_by_that_much() {
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    let mut world = World::new();
    // The left edge of the picture goes through the middle: 90° across, so y = x on the near face.
    let cut = put(&mut world, EntityKind::Prop, [10.01, 10.0, -1.0], 0.0, Shape::cuboid(0.02, 4.0, 4.0));
    let around = put(&mut world, EntityKind::Bus, [0.0, 0.0, -1.0], 0.0, Shape::cuboid(9.0, 3.0, 4.0));
    let camera = looking_east(1.0, 128, 96);
    let frame = draw(&mut renderer, &world, &camera);
    let boxes = boxes_of(&world, &camera, &frame, &[cut, around], NEAR, None).expect("boxes");
    assert!((boxes[0].truncation - 0.5).abs() < 0.01, "{:?}", boxes[0]);
    assert!(boxes[0].alone_pixels.is_none() && boxes[0].occlusion().is_none());
    // The camera is inside of the bus: its box is cut at the near plane and covers the picture.
    let all = boxes[1].amodal.unwrap();
    assert_eq!((all.left, all.top, all.right, all.bottom), (0, 0, 128, 96));
    assert!(boxes[1].truncation > 0.9);
}

#[test]
fn boxes_are_an_observation() {
    let Some(renderer) = renderer(&RenderConfig::default()) else { return };
    let renderer = Arc::new(Mutex::new(renderer));
    let (world, walker) = square_with_walker();
    let intrinsics = Intrinsics::from_fov(96, 64, 1.4).expect("a size in range");
    let make = || -> Box<dyn simworld_core::seam::Observer<Observation = Vec<simworld_render::EntityBox>>> {
        let camera = CameraSensor::sharing(Arc::clone(&renderer), intrinsics);
        Box::new(BoxSensor::new(camera, &[EntityKind::Person, EntityKind::Car, EntityKind::Bus], 60.0))
    };
    check_observer(make, &world, walker, Vec::new);
    let mut boxes = Vec::new();
    make().observe(&world, walker, &mut boxes).expect("boxes");
    assert_eq!(boxes.len(), 3, "{boxes:?}");
    assert!(boxes.iter().all(|found| found.id != walker && found.occlusion().is_some()));
}
