//! Normals are the outward ones of the solids, in the world frame.

use crate::common::{looking_east, put, renderer};
use simworld_core::scene::{EntityKind, Scene, Shape, World};
use simworld_render::{Backend, Channels, Frame, RenderConfig, ViewOptions, ViewRequest, Views};

fn normals(world: &World, backend: Backend) -> Option<(Frame, simworld_core::camera::Camera)> {
    let mut renderer = renderer(&RenderConfig { backend, ..RenderConfig::default() })?;
    let camera = looking_east(1.7, 128, 96);
    let options = ViewOptions {
        channels: ViewOptions::default().channels | Channels::NORMALS,
        ..ViewOptions::default()
    };
    let (mut views, mut frame) = (Views::new(), Frame::new());
    renderer.render_views(world, &[ViewRequest::from(camera)], &options, &mut views).expect("drawn");
    assert!(views.copy_frame(0, &mut frame));
    let mut plain = Frame::new();
    renderer.render(world, &camera, &mut plain).expect("drawn");
    assert_eq!((&plain.ids, &plain.depth, &plain.rgb), (&frame.ids, &frame.depth, &frame.rgb));
    assert!(plain.normals.is_empty(), "nobody asked for them");
    Some((frame, camera))
}

#[test]
fn boxes_and_balls_have_the_normals_of_their_surfaces() {
    for backend in [Backend::Raster, Backend::Raycast] {
        normals_are_right(backend);
    }
}

fn normals_are_right(backend: Backend) {
    let mut world = World::new();
    put(&mut world, EntityKind::Ground, [0.0, 0.0, -1.0], 0.0, Shape::cuboid(300.0, 300.0, 1.0));
    for k in 0..6 {
        let t = f64::from(k);
        put(&mut world, EntityKind::Prop, [9.0 + t, 1.6 * t - 6.0, 0.1 * t], t, Shape::cuboid(1.0, 1.2, 1.1));
    }
    let ball = put(&mut world, EntityKind::Prop, [6.0, 2.0, 0.6], 0.3, Shape::Sphere { radius: 1.0 });
    let Some((frame, camera)) = normals(&world, backend) else { return };
    let (mut flat, mut round) = (0, 0);
    for (index, normal) in frame.normals.iter().enumerate() {
        let (x, y) = (index as u32 % 128, index as u32 / 128);
        let normal = nalgebra::Vector3::from(normal.map(f64::from));
        let (Some(id), Some(point)) = (frame.entity_at(x, y), frame.point_at(&camera, x, y)) else {
            assert_eq!(normal.norm(), 0.0, "the sky has none");
            continue;
        };
        let entity = world.entity(id).expect("it lives");
        assert!((normal.norm() - 1.0).abs() < 1e-4);
        let local = entity.obb().pose.inverse_transform_point(&point);
        if id == ball {
            // 16 rings of 24 sides: the shading normal is within a few degrees of the ball's.
            assert!(normal.dot(&(entity.pose.rotation * local.coords).normalize()) > 0.99, "({x}, {y})");
            round += 1;
            continue;
        }
        let half = entity.obb().half_extents;
        // The face is the one whose plane is nearest; at edges two are.
        let beyond = local.coords.abs() - half;
        let own = entity.pose.rotation.inverse() * normal;
        let axis = own.iamax();
        assert!(own.amax() > 0.9999 && beyond[axis].abs() < 1e-2, "({x}, {y}): {own} at {local}");
        assert!(own[axis] * local[axis] > 0.0, "it looks outward");
        flat += 1;
    }
    assert!(flat > 5000 && round > 100, "{backend:?}: {flat} {round}");
}
