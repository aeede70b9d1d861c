//! The view from above has the same scale everywhere, and north is up.

use std::sync::{Arc, Mutex};

use crate::common::{difference, put, renderer, square};
use simworld_core::geometry::{Point2, Point3};
use simworld_core::scene::{EntityKind, Scene, Shape, World};
use simworld_core::testing::check_observer;
use simworld_render::{Backend, Frame, LevelOfDetail, MapSensor, MapView, RenderConfig};

#[test]
fn roofs_and_ground_fall_where_they_are_at_any_height() {
    for backend in [Backend::Raster, Backend::Raycast] {
        roofs_and_ground_fall_right(backend);
    }
}

fn roofs_and_ground_fall_right(backend: Backend) {
    let Some(mut renderer) = renderer(&RenderConfig { backend, ..RenderConfig::default() }) else { return };
    let mut world = World::new();
    put(&mut world, EntityKind::Ground, [0.0, 0.0, -1.0], 0.0, Shape::cuboid(300.0, 300.0, 1.0));
    // Low and high boxes far from the middle: parallel rays see no wall.
    let low = put(&mut world, EntityKind::Prop, [18.0, 10.0, 0.0], 0.0, Shape::cuboid(4.0, 2.0, 1.0));
    let high = put(&mut world, EntityKind::Prop, [-20.0, -11.0, 0.0], 0.4, Shape::cuboid(3.0, 3.0, 30.0));
    let map =
        MapView { center: Point2::new(1.0, 2.0), top: 50.0, metres_per_pixel: 0.5, width: 128, height: 96 };
    let mut frame = Frame::new();
    map.draw(&mut renderer, &world, &mut frame).expect("drawn");
    for y in 0..96 {
        for x in 0..128 {
            let point = map.point_at(&frame, x, y).expect("there is ground everywhere");
            let owner = [low, high].into_iter().find(|id| {
                let obb = world.entity(*id).expect("it lives").obb();
                let local =
                    obb.pose.inverse_transform_point(&Point3::new(point.x, point.y, obb.pose.translation.z));
                (local.coords.abs() - obb.half_extents).xy().max() < 0.0
            });
            let expected = owner.map_or(0.0, |id| world.entity(id).expect("it lives").bounds.max.z);
            assert!((point.z - expected).abs() < 1e-3, "({x}, {y}) is at {point}, not {expected} m high");
            assert!(owner.is_none() || frame.entity_at(x, y) == owner);
        }
    }
    // 4 m by 2 m at half a metre a pixel, north-east of the middle.
    let pixels: Vec<(u32, u32)> = (0..96)
        .flat_map(|y| (0..128).map(move |x| (x, y)))
        .filter(|(x, y)| frame.entity_at(*x, *y) == Some(low))
        .collect();
    assert_eq!(pixels.len(), 32);
    assert!(pixels.iter().all(|(x, y)| (94..102).contains(x) && (30..34).contains(y)), "{pixels:?}");
}

/// Colours, ids and depth of a map are those of either backend.
#[test]
fn triangles_and_rays_draw_the_same_map() {
    let map = MapView {
        center: Point2::new(14.0, 0.0),
        top: 40.0,
        metres_per_pixel: 0.25,
        width: 192,
        height: 128,
    };
    let world = square(0.0);
    let mut drawn = Vec::new();
    for backend in [Backend::Raster, Backend::Raycast] {
        let config =
            RenderConfig { backend, level_of_detail: LevelOfDetail::Finest, ..RenderConfig::default() };
        let Some(mut renderer) = renderer(&config) else { return };
        let mut frame = Frame::new();
        map.draw(&mut renderer, &world, &mut frame).expect("drawn");
        drawn.push(frame);
    }
    let [raster, rays] = &drawn[..] else { panic!("two frames") };
    let pixels = raster.ids.len() as f64;
    let apart = raster.ids.iter().zip(&rays.ids).filter(|(a, b)| a != b).count() as f64 / pixels;
    let deep = raster.depth.iter().zip(&rays.depth).filter(|(a, b)| (*a - *b).abs() > 1e-3 * **a).count();
    let (mean, differing) = difference(&raster.rgb, &rays.rgb, 24);
    println!("ids differ on {apart}, depth on {deep} pixels, colours by {mean}, {differing}");
    assert!(apart <= 2e-3 && deep as f64 / pixels <= 2e-3, "{apart} {deep}");
    assert!(mean < 1.5 && differing < 0.02, "colours differ by {mean}, {differing}");
}

#[test]
fn a_map_is_an_observation_around_its_wearer() {
    let Some(renderer) = renderer(&RenderConfig::default()) else { return };
    let renderer = Arc::new(Mutex::new(renderer));
    let world = square(0.0);
    let car = world.iter().find(|entity| entity.kind == EntityKind::Car).expect("a car").id;
    let make = || -> Box<dyn simworld_core::seam::Observer<Observation = Frame>> {
        Box::new(MapSensor::new(Arc::clone(&renderer), [96, 96], 0.25))
    };
    check_observer(make, &world, car, Frame::new);
    let mut frame = Frame::new();
    make().observe(&world, car, &mut frame).expect("seen");
    assert_eq!(frame.entity_at(48, 48), Some(car), "it is in the middle of its own map");
    // 4.5 m by 1.8 m at a quarter of a metre: 18 by 7.2 pixels.
    let pixels = frame.ids.iter().filter(|id| **id as usize == car.index() + 1).count();
    assert!((90..=150).contains(&pixels), "{pixels}");
}
