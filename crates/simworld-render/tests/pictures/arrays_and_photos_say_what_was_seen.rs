//! Points, distances, classes of one's own, arrays and photos all tell of the same picture.

use std::sync::{Arc, Mutex};

use crate::common::{draw, looking_east, put, renderer};
use simworld_core::action::ActionKind;
use simworld_core::camera::Intrinsics;
use simworld_core::event::EventKind;
use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::scene::{EntityDesc, EntityKind, FIELD_OF_VIEW, GAZE, Scene, Shape, World};
use simworld_core::seam::Observer;
use simworld_render::classes::{ClassTable, OwnClass};
use simworld_render::{CameraSensor, Frame, PhotoRoll, RenderConfig, RenderError};

/// Boxes in all directions, turned.
fn boxes() -> World {
    let mut world = World::new();
    put(&mut world, EntityKind::Ground, [0.0, 0.0, -1.0], 0.0, Shape::cuboid(300.0, 300.0, 1.0));
    for k in 0..12 {
        let t = f64::from(k);
        let at = [8.0 + t * 2.1, (t * 3.7) % 16.0 - 8.0, (t * 0.9) % 3.0];
        put(&mut world, EntityKind::Prop, at, t, Shape::cuboid(1.0 + t * 0.1, 1.6, 1.2));
    }
    world
}

#[test]
fn points_lie_on_the_surfaces_that_they_came_from() {
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    let world = boxes();
    let camera = looking_east(1.7, 128, 96);
    let frame = draw(&mut renderer, &world, &camera);
    let distances = frame.distances(&camera).expect("depth");
    let eye = Point3::from(camera.world_from_optical.translation.vector);
    let mut checked = 0;
    for (x, y) in (0..96).flat_map(|y| (0..128).map(move |x| (x, y))) {
        let (Some(point), Some(id)) = (frame.point_at(&camera, x, y), frame.entity_at(x, y)) else {
            assert!(distances[(y * 128 + x) as usize].is_infinite());
            continue;
        };
        let range = (point - eye).norm();
        let measured = f64::from(distances[(y * 128 + x) as usize]);
        assert!((measured - range).abs() < 1e-5 * range, "({x}, {y}): {measured}, not {range}");
        if range > 150.0 {
            continue;
        }
        let obb = world.entity(id).expect("it lives").obb();
        let local = obb.pose.inverse_transform_point(&point);
        let beyond = (local.coords.abs() - obb.half_extents).max();
        assert!(beyond.abs() < 1e-4 * range, "({x}, {y}) lies {beyond} m off {id}");
        checked += 1;
    }
    assert!(checked > 6000, "only {checked} pixels");
}

#[test]
fn own_classes_replace_those_of_cityscapes() {
    let Some(renderer) = renderer(&RenderConfig::default()) else { return };
    let mut world = crate::common::square(0.0);
    let walker = put(&mut world, EntityKind::Robot, [0.0, 0.0, 0.0], 0.0, Shape::cuboid(0.4, 0.4, 1.5));
    let class = |id, name: &str, color| OwnClass { id, name: name.into(), color };
    let table = ClassTable {
        classes: vec![
            class(0, "rest", [9, 9, 9]),
            class(3, "wheels", [0, 0, 255]),
            class(7, "air", [255; 3]),
        ],
        kinds: [(EntityKind::Car, 3), (EntityKind::Bus, 3)].into(),
        assets: std::collections::BTreeMap::new(),
        other: 0,
        sky: 7,
    };
    table.validate().expect("a sound table");
    let sensor = CameraSensor::sharing(
        Arc::new(Mutex::new(renderer)),
        Intrinsics::from_fov(128, 96, 1.4).expect("a size in range"),
    );
    let (mut frame, mut own) = (Frame::new(), Frame::new());
    sensor.clone().observe(&world, walker, &mut frame).expect("seen");
    sensor.classed_by(Arc::new(table.clone())).observe(&world, walker, &mut own).expect("seen");
    let translate = |class: &u8| match class {
        23 => 7,
        26 | 28 => 3,
        _ => 0,
    };
    assert_eq!(own.classes, frame.classes.iter().map(translate).collect::<Vec<u8>>());
    assert!(own.classes.contains(&3) && own.classes.contains(&7));
    let file = own.classes_png_by(&table).expect("a frame");
    let reader = png::Decoder::new(std::io::Cursor::new(&file)).read_info().expect("a PNG");
    assert_eq!(reader.info().palette.as_ref().expect("a palette")[9..12], [0, 0, 255]);
    // Class and instance in one number.
    let labels = own.labels().expect("few entities");
    for (index, label) in labels.iter().enumerate() {
        assert_eq!((label >> 24, label & 0xff_ffff), (u32::from(own.classes[index]), own.ids[index]));
    }
    own.ids[5] = 1 << 24;
    assert!(matches!(own.labels(), Err(RenderError::Label { id: 16_777_216 })));
}

/// Type, shape and bytes of an NPY file, read by its own rules.
fn read(file: &[u8]) -> (String, Vec<usize>, &[u8]) {
    assert_eq!(&file[..8], b"\x93NUMPY\x01\x00");
    let length = usize::from(u16::from_le_bytes([file[8], file[9]]));
    let text = std::str::from_utf8(&file[10..10 + length]).expect("a dictionary");
    let descr = text.split('\'').nth(3).expect("a type").to_owned();
    let shape = text.split(['(', ')']).nth(1).expect("a shape");
    let shape = shape.split(',').filter_map(|part| part.trim().parse().ok()).collect();
    (descr, shape, &file[10 + length..])
}

#[test]
fn arrays_are_read_back_as_they_were() {
    let mut frame = Frame::new();
    frame.resize(3, 2);
    frame.rgb = (0..18).collect();
    frame.depth = vec![0.5, 1.25, 3e9, f32::INFINITY, 1e-3, 7.0];
    frame.ids = vec![1, 70_000, 3, 0, 5, 6];
    frame.flow = vec![[1.5, -2.0]; 6];
    let file = frame.depth_npy().expect("a frame");
    let (descr, shape, bytes) = read(&file);
    let depths: Vec<f32> =
        bytes.chunks_exact(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
    assert_eq!((descr.as_str(), shape, depths), ("<f4", vec![2, 3], frame.depth.clone()));
    let file = frame.ids_npy().expect("a frame");
    let (descr, shape, bytes) = read(&file);
    assert_eq!((descr.as_str(), shape, &bytes[4..8]), ("<u4", vec![2, 3], &70_000_u32.to_le_bytes()[..]));
    let file = frame.rgb_npy().expect("a frame");
    assert_eq!(read(&file), ("|u1".to_owned(), vec![2, 3, 3], &frame.rgb[..]));
    let file = frame.flow_npy().expect("a frame");
    let (_, shape, bytes) = read(&file);
    assert_eq!((shape, bytes.len(), &bytes[4..8]), (vec![2, 3, 2], 48, &(-2.0_f32).to_le_bytes()[..]));
    assert_eq!(read(&frame.classes_npy().expect("a frame")).2, &[23; 6]);
    assert_eq!(read(&frame.labels_npy().expect("a frame")).2[..4], [1, 0, 0, 23]);
    frame.flow.clear();
    assert!(matches!(frame.flow_npy(), Err(RenderError::Frame { buffer: "flow", .. })));
}

#[test]
fn who_takes_a_photo_gets_what_it_looks_at() {
    let Some(renderer) = renderer(&RenderConfig::default()) else { return };
    let mut world = crate::common::square(0.0);
    let shape = Shape::Capsule { radius: 0.25, height: 1.75 };
    let tourist = |gaze: f64, angle: f64| {
        EntityDesc::new(EntityKind::Person, pose_facing(Point3::new(0.0, -1.0, 0.0), 0.2), shape)
            .with(GAZE, gaze)
            .with(FIELD_OF_VIEW, angle)
    };
    let plain = world.spawn(tourist(0.0, 1.4)).expect("a person");
    let upward = world.spawn(tourist(0.7, 0.4)).expect("a person");
    let camera = CameraSensor::sharing(
        Arc::new(Mutex::new(renderer)),
        Intrinsics::from_fov(96, 64, 1.0).expect("a size in range"),
    );
    let (wide, high) =
        (camera.camera(&world, plain).expect("there"), camera.camera(&world, upward).expect("there"));
    let ahead = high.world_from_optical * nalgebra::Vector3::z();
    assert!((ahead.z - simworld_core::ops::sin(0.7)).abs() < 1e-9, "it looks up: {ahead}");
    assert!(high.intrinsics.fx > 3.0 * wide.intrinsics.fx, "who focuses sees nearer");

    let folder = tempfile::tempdir().expect("a folder");
    let mut roll = PhotoRoll::new(camera.clone(), folder.path());
    world.begin_step();
    for who in [plain, upward] {
        world.emit(EventKind::Gesture { who, gesture: ActionKind::TakePhoto, to: None, heading: None });
        world.emit(EventKind::Gesture { who, gesture: ActionKind::WaveHand, to: None, heading: None });
    }
    let photos = roll.develop(&world, world.events()).expect("developed");
    assert_eq!(photos.iter().map(|(photo, _)| photo.who).collect::<Vec<_>>(), [plain, upward]);
    let (photo, path) = &photos[1];
    assert_eq!(photo.camera, high);
    let mut seen = Frame::new();
    camera.clone().observe(&world, upward, &mut seen).expect("seen");
    assert_eq!(photo.frame, seen);
    let file = std::fs::read(path).expect("it is there");
    let mut reader = png::Decoder::new(std::io::Cursor::new(&file)).read_info().expect("a PNG");
    let text = reader.info().uncompressed_latin1_text[0].clone();
    assert_eq!((text.keyword.as_str(), text.text.as_str()), ("Description", photo.description().as_str()));
    let told: serde_json::Value = serde_json::from_str(&text.text).expect("JSON");
    assert_eq!(told["who"], u64::from(upward));
    assert_eq!(told["fx"].as_f64(), Some(high.intrinsics.fx));
    let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
    reader.next_frame(&mut pixels).expect("an image");
    assert_eq!(pixels, seen.rgb);
}
