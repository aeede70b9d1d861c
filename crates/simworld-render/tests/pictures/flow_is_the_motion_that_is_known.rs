//! Optical flow is where a point of a body is on the picture now, minus where it was.

use crate::common::{looking_east, put, renderer};
use simworld_core::camera::Camera;
use simworld_core::geometry::{Point2, Point3, Pose, Twist, Vector3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
use simworld_render::{Frame, OpticalFlow, RenderConfig, RenderError};

/// The middle of the face that looks west, and points around it, in the body frame of a box of 2 x 3 x 2 m.
fn face() -> Vec<Point3> {
    let across = (-4..=4).map(|k| f64::from(k) * 0.3);
    across.flat_map(|y| [0.3, 0.9, 1.4, 1.8].map(|z| Point3::new(-1.0, y, z))).collect()
}

fn tilted(shift: [f64; 3], turn: f64) -> Camera {
    let mut camera = looking_east(1.2, 128, 96);
    let motion = Pose::from_parts(
        Vector3::from(shift).into(),
        nalgebra::UnitQuaternion::from_euler_angles(0.5 * turn, turn, -turn),
    );
    camera.world_from_optical = motion * camera.world_from_optical;
    camera
}

/// Compares the flow with two projections of points that are fixed to the body.
fn compare(frame: &Frame, body: EntityId, poses: [Pose; 2], cameras: [Camera; 2]) {
    let mut checked = 0;
    for point in face() {
        let at = |k: usize| cameras[k].project(&(poses[k] * point)).expect("it is ahead");
        let ((before, _), (now, _)) = (at(0), at(1));
        let (x, y) = (now.x.floor() as u32, now.y.floor() as u32);
        if now.x < 0.0 || now.y < 0.0 || frame.entity_at(x, y) != Some(body) {
            continue;
        }
        let [u, v] = frame.flow[y as usize * frame.width as usize + x as usize].map(f64::from);
        let expected = now - before;
        // The middle of the pixel is up to 0.7 pixels beside the point, and flow changes from pixel to pixel.
        let off = (Point2::new(u, v) - Point2::from(expected)).norm();
        assert!(off < 0.06 + 0.03 * expected.norm(), "{point}: ({u}, {v}) is not {expected}");
        checked += 1;
    }
    assert!(checked > 12, "only {checked} points were seen");
}

#[test]
fn bodies_and_cameras_that_move_give_the_flow_of_their_motion() {
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    let still = [tilted([0.0; 3], 0.0); 2];
    let moved = [tilted([0.0; 3], 0.0), tilted([0.4, -0.3, 0.2], 0.03)];
    let start = pose_facing(Point3::new(9.0, 0.3, 0.2), 0.1);
    let end = pose_facing(Point3::new(8.4, 0.9, 0.3), 0.22);
    for (poses, cameras) in [([start, end], still), ([start, start], moved), ([start, end], moved)] {
        let mut world = World::new();
        put(&mut world, EntityKind::Ground, [0.0, 0.0, -1.0], 0.0, Shape::cuboid(300.0, 300.0, 1.0));
        let shape = Shape::cuboid(2.0, 3.0, 2.0);
        let body = world.spawn(EntityDesc::new(EntityKind::Prop, poses[0], shape)).expect("a solid");
        let (mut frame, mut flow) = (Frame::new(), OpticalFlow::new());
        renderer.render(&world, &cameras[0], &mut frame).expect("drawn");
        flow.measure(&world, &cameras[0], &mut frame).expect("measured");
        assert!(frame.flow.iter().flatten().all(|part| part.abs() < 1e-3), "nothing has moved yet");
        world.set_motion(body, poses[1], Twist::ZERO).expect("it lives");
        renderer.render(&world, &cameras[1], &mut frame).expect("drawn");
        flow.measure(&world, &cameras[1], &mut frame).expect("measured");
        compare(&frame, body, poses, cameras);
    }
}

#[test]
fn the_sky_turns_with_the_camera_and_does_not_shift() {
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    let world = World::new();
    let (mut frame, mut flow) = (Frame::new(), OpticalFlow::new());
    let cameras = [tilted([0.0; 3], 0.0), tilted([5.0, 1.0, 0.0], 0.0), tilted([5.0, 1.0, 0.0], 0.02)];
    let mut middle = Vec::new();
    for camera in &cameras {
        renderer.render(&world, camera, &mut frame).expect("drawn");
        flow.measure(&world, camera, &mut frame).expect("measured");
        middle.push(frame.flow[48 * 128 + 64]);
    }
    assert!(middle[1].iter().all(|part| part.abs() < 1e-3), "{:?}", middle[1]);
    // 0.02 rad to the left and as much down: by the focal length of 64 pixels, to the right and up.
    assert!((middle[2][0] + 1.28).abs() < 0.1 && middle[2][1].abs() > 1.0, "{:?}", middle[2]);
}

/// Who was not on the picture before is carried back along its velocity.
#[test]
fn newcomers_come_along_their_velocity() {
    let Some(mut renderer) = renderer(&RenderConfig::default()) else { return };
    let camera = looking_east(1.0, 128, 96);
    let mut world = World::new();
    let (mut frame, mut flow) = (Frame::new(), OpticalFlow::new());
    renderer.render(&world, &camera, &mut frame).expect("drawn");
    flow.measure(&world, &camera, &mut frame).expect("measured");
    world.begin_step();
    world.finish_step();
    let mut newcomer = EntityDesc::new(
        EntityKind::Prop,
        pose_facing(Point3::new(11.0, 0.0, 0.0), 0.0),
        Shape::cuboid(2.0, 4.0, 2.0),
    );
    newcomer.twist = Twist { linear: Vector3::new(0.0, -5.0, 0.0), angular: Vector3::zeros() };
    world.spawn(newcomer).expect("a solid");
    renderer.render(&world, &camera, &mut frame).expect("drawn");
    flow.measure(&world, &camera, &mut frame).expect("measured");
    // 0.5 m to the right in 0.1 s, seen from 10 m with a focal length of 64 pixels.
    let dt = world.clock().seconds();
    let [u, v] = frame.flow[48 * 128 + 64];
    assert!((f64::from(u) - 5.0 * dt * 6.4).abs() < 0.02 && v.abs() < 1e-3, "{u} {v} after {dt} s");
}

#[test]
fn a_frame_of_another_camera_is_refused() {
    let mut frame = Frame::new();
    frame.resize(8, 6);
    let outcome = OpticalFlow::new().measure(&World::new(), &looking_east(1.0, 8, 7), &mut frame);
    assert!(matches!(outcome, Err(RenderError::OtherCamera { camera_height: 7, .. })), "{outcome:?}");
    let empty = OpticalFlow::new().measure(&World::new(), &looking_east(1.0, 8, 6), &mut Frame::new());
    assert!(matches!(empty, Err(RenderError::Frame { buffer: "depth", .. })), "{empty:?}");
}
