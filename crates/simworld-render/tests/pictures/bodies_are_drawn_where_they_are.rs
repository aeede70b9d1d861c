//! Who lies, crouches or sits is drawn so, near by and from afar, and robots link by link: pixels are where the bodies are.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_3};
use std::sync::Arc;

use nalgebra::UnitQuaternion;
use simworld_core::asset::{Model, ModelPart, ModelVertex, Paint};
use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::{Point2, Point3, Pose, Twist, Vector3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::limbs::JointAngles;
use simworld_core::links::LinkForm;
use simworld_core::ops;
use simworld_core::scene::{EntityKind, Shape, World};
use simworld_render::{Backend, Frame, RenderConfig, Renderer};

use crate::common::{draw, put, renderer};

/// A camera a metre over the ground that looks east at what stands there so far away, m.
fn camera(field: f64) -> Camera {
    let intrinsics = Intrinsics::from_fov(200, 150, field).expect("a size in range");
    Camera::looking_along(&pose_facing(Point3::new(0.0, 0.0, 1.0), 0.0), intrinsics)
}

/// Of the pixels of an entity: the least and the greatest y and z that they show at the distance of its place, m; none if it has none.
fn seen(
    renderer: &mut Renderer,
    world: &World,
    id: EntityId,
    camera: &Camera,
    away: f64,
) -> Option<[[f64; 2]; 2]> {
    let frame = draw(renderer, world, camera);
    let (width, height) = (camera.intrinsics.width, camera.intrinsics.height);
    let mut range: Option<[[f64; 2]; 2]> = None;
    for (u, v) in (0..height).flat_map(|v| (0..width).map(move |u| (u, v))) {
        if frame.entity_at(u, v) != Some(id) {
            continue;
        }
        let pixel = Point2::new(f64::from(u) + 0.5, f64::from(v) + 0.5);
        let at = camera.world_from_optical * camera.intrinsics.unproject(&pixel, away);
        let [ys, zs] = range.unwrap_or([[at.y; 2], [at.z; 2]]);
        range = Some([[ys[0].min(at.y), ys[1].max(at.y)], [zs[0].min(at.z), zs[1].max(at.z)]]);
    }
    range
}

fn person(world: &mut World, away: f64) -> EntityId {
    let ground = Shape::cuboid(400.0, 400.0, 0.05);
    put(world, EntityKind::Ground, [0.0, 0.0, -0.05], 0.0, ground);
    put(world, EntityKind::Person, [away, 0.0, 0.0], FRAC_PI_2, Shape::Capsule { radius: 0.25, height: 1.75 })
}

/// So far away people are drawn near by, and as a whole figure.
const PLACES: [(f64, f64); 2] = [(5.0, 0.7), (45.0, 0.6)];

#[test]
fn who_has_fallen_lies_low() {
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    for (away, field) in PLACES {
        let camera = camera(field);
        let pixel = 2.0 * away * ops::tan(0.5 * field) / 200.0;
        let mut world = World::new();
        let id = person(&mut world, away);
        let [ys, zs] = seen(&mut renderer, &world, id, &camera, away).expect("it stands there");
        assert!(zs[1] > 1.7 - 2.0 * pixel && ys[1] - ys[0] < 0.9 + 2.0 * pixel, "upright: {ys:?}, {zs:?}");

        // On the back with the head to the north.
        let about = nalgebra::Unit::new_normalize(Vector3::new(1.0, 1.0, 1.0));
        let lying = UnitQuaternion::from_axis_angle(&about, -2.0 * FRAC_PI_3);
        let pose = Pose::from_parts(Vector3::new(away, -0.9, 0.15).into(), lying);
        world.set_motion(id, pose, Twist::ZERO).unwrap();
        world.set_joints(id, JointAngles::default()).unwrap();
        let [ys, zs] = seen(&mut renderer, &world, id, &camera, away).expect("it lies there");
        assert!(
            ys[1] - ys[0] > 1.6 - 3.0 * pixel,
            "{away} m: as long as it is tall, or but for the feet: {ys:?}"
        );
        assert!(zs[1] < 0.4 + pixel, "{away} m: nothing of it is up: {zs:?}");

        let mut joints = JointAngles::default();
        joints.left_leg.hip_flexion = FRAC_PI_2;
        world.set_joints(id, joints).unwrap();
        let [_, zs] = seen(&mut renderer, &world, id, &camera, away).expect("it lies there");
        let up = 0.15 + 1.75 * (0.245 + 0.246 + 0.039);
        assert!((zs[1] - up).abs() < 0.1 + pixel, "{away} m: a leg is up, at {up} m: {zs:?}");
    }
}

#[test]
fn who_crouches_is_low_and_who_sits_is_on_the_seat() {
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    for (away, field) in PLACES {
        let camera = camera(field);
        let pixel = 2.0 * away * ops::tan(0.5 * field) / 200.0;
        let mut world = World::new();
        let id = person(&mut world, away);
        // As physics has it of who crouches: 0.7 of the height.
        let mut joints = JointAngles { hip_drop: 0.3 * 1.75, ..JointAngles::default() };
        for leg in [&mut joints.left_leg, &mut joints.right_leg] {
            (leg.hip_flexion, leg.knee_flexion, leg.ankle_dorsiflexion) = (1.12, 2.24, 1.12);
        }
        world.set_joints(id, joints).unwrap();
        let [_, zs] = seen(&mut renderer, &world, id, &camera, away).expect("it is there");
        assert!((zs[1] - 1.225).abs() < 0.08 + pixel, "{away} m: crown at {zs:?}");
        // From afar legs are thinner than a pixel.
        assert!(away > 10.0 || zs[0].abs() < 0.08 + pixel, "soles at {zs:?}");

        // On a seat of 0.45 m, feet on the floor.
        let pose = pose_facing(Point3::new(away, 0.0, 0.45), FRAC_PI_2);
        world.set_motion(id, pose, Twist::ZERO).unwrap();
        world.set_joints(id, JointAngles::seated(1.75)).unwrap();
        let [ys, zs] = seen(&mut renderer, &world, id, &camera, away).expect("it is there");
        assert!((zs[1] - (0.45 + 0.525 * 1.75)).abs() < 0.08 + pixel, "{away} m: crown at {zs:?}");
        assert!(away > 10.0 || zs[0].abs() < 0.12 && ys[1] > 0.35, "legs ahead: {ys:?}, {zs:?}");
    }
}

/// A mast of 2 m with an arm of 3 m on it that is turned so far, on an entity that is 0.3 m wide.
fn boom(world: &mut World, turned: f64) -> EntityId {
    let id = put(world, EntityKind::Robot, [8.0, 0.0, 0.0], 0.0, Shape::cuboid(0.3, 0.3, 2.0));
    turn(world, id, turned);
    id
}

fn turn(world: &mut World, id: EntityId, turned: f64) {
    let forms: Arc<[LinkForm]> = Arc::from([
        LinkForm::solid(Shape::Cylinder { radius: 0.1, height: 2.0 }, None),
        LinkForm::solid(Shape::cuboid(3.0, 0.2, 0.2), Some([0.7, 0.05, 0.02])),
    ]);
    let arm = pose_facing(Point3::new(0.0, 0.0, 1.9), turned) * Pose::translation(1.5, 0.0, 0.0);
    world.set_links(id, &forms, &[Pose::identity(), arm]).unwrap();
}

#[test]
fn an_arm_that_turned_has_its_pixels_elsewhere() {
    for backend in [Backend::Raster, Backend::Raycast] {
        let config = RenderConfig { backend, ..RenderConfig::default() };
        let Some(mut renderer) = renderer(&config) else { return };
        let mut world = World::new();
        let id = boom(&mut world, FRAC_PI_2);
        let camera = camera(0.9);
        let range = |renderer: &mut Renderer, world: &World| {
            seen(renderer, world, id, &camera, 8.0).expect("it is there")
        };
        let [ys, zs] = range(&mut renderer, &world);
        assert!((ys[1] - 3.0).abs() < 0.12 && (ys[0] + 0.1).abs() < 0.08, "{backend:?}, to the left: {ys:?}");
        assert!((zs[1] - 2.1).abs() < 0.12 && zs[0].abs() < 0.1, "{backend:?}: {zs:?}");
        turn(&mut world, id, -FRAC_PI_2);
        let [ys, _] = range(&mut renderer, &world);
        assert!(
            (ys[0] + 3.0).abs() < 0.12 && (ys[1] - 0.1).abs() < 0.08,
            "{backend:?}, to the right: {ys:?}"
        );
    }
}

#[test]
fn an_arm_is_seen_where_its_entity_is_not() {
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    let mut world = World::new();
    let id = boom(&mut world, FRAC_PI_2);
    let intrinsics = Intrinsics::from_fov(120, 90, 0.3).expect("a size in range");
    let camera = Camera::looking_at(Point3::new(0.0, 2.8, 2.0), Point3::new(8.0, 2.8, 2.0), intrinsics);
    let frame = draw(&mut renderer, &world, &camera);
    assert_eq!(frame.entity_at(60, 45), Some(id), "the end of the arm");
}

/// A pyramid on a base of two metres by two, as a surface in the colour of whom it belongs to; so high, m.
fn pyramid(height: f32) -> Arc<Model> {
    let corners =
        [[-1.0, -1.0, 0.0], [1.0, -1.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 1.0, 0.0], [0.0, 0.0, height]];
    let up = [0.0, 0.0, 1.0];
    let vertex = |position| ModelVertex { position, normal: up, color: [1.0; 3], ..ModelVertex::default() };
    let triangles = vec![[0, 2, 1], [0, 3, 2], [0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]];
    let part = ModelPart { triangles: 6, paint: Paint::Entity, ..ModelPart::default() };
    let model =
        Model { vertices: corners.map(vertex).to_vec(), triangles, parts: vec![part], ..Model::default() };
    Arc::new(model)
}

/// At half its height a pyramid is half as wide as its base, where the box that it fills is as wide all the way up.
#[test]
fn a_link_is_drawn_as_its_surface_in_its_colour() {
    for backend in [Backend::Raster, Backend::Raycast] {
        let config = RenderConfig { backend, ..RenderConfig::default() };
        let Some(mut renderer) = renderer(&config) else { return };
        let mut world = World::new();
        let camera = Camera::looking_along(
            &pose_facing(Point3::new(0.0, 0.0, 1.0), 0.0),
            Intrinsics::from_fov(200, 150, 0.6).expect("a size in range"),
        );
        let (wide, low) = (pyramid(2.0), pyramid(1.0));
        let ids = [-2.5, 2.5]
            .map(|y| put(&mut world, EntityKind::Robot, [20.0, y, 0.0], 0.0, Shape::cuboid(0.2, 0.2, 0.2)));
        let show = |world: &mut World, models: [&Arc<Model>; 2]| {
            for ((id, model), color) in
                ids.into_iter().zip(models).zip([[0.8, 0.02, 0.02], [0.02, 0.02, 0.8]])
            {
                let height = f64::from(model.vertices[4].position[2]);
                let shape = Shape::cuboid(2.0, 2.0, height);
                let form = LinkForm { shape, model: Some(Arc::clone(model)), color: Some(color) };
                world.set_links(id, &Arc::from([form]), &[Pose::identity()]).unwrap();
            }
        };
        let width_at = |frame: &Frame, id: EntityId, z: f64| {
            let at = |y: f64| camera.project(&Point3::new(20.0, y, z)).expect("before the camera").0;
            let row = at(0.0).y as u32;
            let count = (0..200).filter(|u| frame.entity_at(*u, row) == Some(id)).count() as f64;
            count / (at(-0.5).x - at(0.5).x)
        };
        show(&mut world, [&wide, &wide]);
        let frame = draw(&mut renderer, &world, &camera);
        for (id, reddish) in ids.into_iter().zip([true, false]) {
            for (z, width) in [(0.4, 1.6), (1.0, 1.0), (1.6, 0.4)] {
                let seen = width_at(&frame, id, z);
                assert!((seen - width).abs() < 0.2, "{backend:?}: {seen} m wide at {z} m, not {width}");
            }
            let y = if reddish { -2.5 } else { 2.5 };
            let (spot, _) = camera.project(&Point3::new(19.5, y, 1.0)).expect("before the camera");
            let [r, _, b] = frame.rgb_at(spot.x as u32, spot.y as u32).expect("in the picture");
            assert!((r > b) == reddish && r.abs_diff(b) > 40, "{backend:?}: red {r}, blue {b}");
        }
        // Others of the same entities are drawn as soon as they are told.
        show(&mut world, [&wide, &low]);
        let frame = draw(&mut renderer, &world, &camera);
        assert!((width_at(&frame, ids[0], 1.0) - 1.0).abs() < 0.2, "{backend:?}");
        assert!((width_at(&frame, ids[1], 0.5) - 1.0).abs() < 0.2, "{backend:?}");
        assert_eq!(width_at(&frame, ids[1], 1.2), 0.0, "{backend:?}: nothing is up there");
    }
}
