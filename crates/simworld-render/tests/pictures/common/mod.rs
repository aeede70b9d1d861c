//! What the tests of the renderer share.
#![allow(unreachable_pub, reason = "a helper of tests")]

pub(crate) mod models;

use std::sync::Arc;

use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::{Point2, Point3, heading, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::net::{CrossSection, NetworkConfig, RoadNetwork, StreetPlan};
use simworld_core::scene::{EntityDesc, EntityKind, Shape, World};
use simworld_render::{Frame, RenderConfig, RenderError, Renderer};

/// A renderer, or `None` with the reason printed where there is no adapter; with `SIMWORLD_REQUIRE_ADAPTER=1` a
/// missing adapter is a failure.
pub(crate) fn renderer(config: &RenderConfig) -> Option<Renderer> {
    match Renderer::new(config) {
        Ok(renderer) => Some(renderer),
        Err(error @ RenderError::NoAdapter { .. }) => {
            let required = std::env::var_os("SIMWORLD_REQUIRE_ADAPTER").is_some_and(|value| value == "1");
            assert!(!required, "an adapter is required here, but: {error}");
            println!("skipped: {error}");
            None
        }
        Err(error) => panic!("the renderer cannot be made: {error}"),
    }
}

/// Puts an entity into the world.
pub(crate) fn put(world: &mut World, kind: EntityKind, at: [f64; 3], yaw: f64, shape: Shape) -> EntityId {
    let pose = pose_facing(Point3::new(at[0], at[1], at[2]), yaw);
    world.spawn(EntityDesc::new(kind, pose, shape)).expect("a solid in the world")
}

/// A camera `height` m over the origin that looks east.
pub(crate) fn looking_east(height: f64, width: u32, image_height: u32) -> Camera {
    let intrinsics =
        Intrinsics::from_fov(width, image_height, std::f64::consts::FRAC_PI_2).expect("a size in range");
    Camera::looking_along(&pose_facing(Point3::new(0.0, 0.0, height), 0.0), intrinsics)
}

/// Draws one frame.
pub(crate) fn draw(renderer: &mut Renderer, world: &World, camera: &Camera) -> Frame {
    let mut frame = Frame::new();
    renderer.render(world, camera, &mut frame).unwrap_or_else(|error| panic!("not drawn: {error}"));
    frame
}

/// A small place with one of everything, `shift` m east and north of the origin.
pub(crate) fn square(shift: f64) -> World {
    let mut world = World::new();
    let mut place = |kind, [x, y, z]: [f64; 3], yaw, shape| {
        put(&mut world, kind, [x + shift, y + shift, z], yaw, shape);
    };
    let quarter = std::f64::consts::FRAC_PI_2;
    place(EntityKind::Ground, [0.0, 0.0, -0.10], 0.0, Shape::cuboid(400.0, 400.0, 0.05));
    place(EntityKind::Road, [30.0, -3.0, -0.08], 0.0, Shape::cuboid(120.0, 7.0, 0.05));
    place(EntityKind::Sidewalk, [30.0, 2.5, -0.05], 0.0, Shape::cuboid(120.0, 4.0, 0.05));
    place(EntityKind::Crosswalk, [14.0, -3.0, -0.07], quarter, Shape::cuboid(7.0, 3.0, 0.05));
    place(EntityKind::Building, [24.0, 11.0, 0.0], -quarter, Shape::cuboid(12.0, 16.0, 14.0));
    place(EntityKind::Building, [30.0, -14.0, 0.0], quarter, Shape::cuboid(10.0, 12.0, 8.0));
    place(EntityKind::Tree, [12.0, 1.2, 0.0], 0.3, Shape::Cylinder { radius: 0.18, height: 5.0 });
    place(EntityKind::StreetLamp, [18.0, 1.0, 0.0], -quarter, Shape::Cylinder { radius: 0.09, height: 6.0 });
    place(EntityKind::Car, [11.0, -4.4, -0.03], 0.0, Shape::cuboid(4.5, 1.8, 1.5));
    place(EntityKind::Bus, [26.0, -1.6, -0.03], 2.0 * quarter, Shape::cuboid(11.0, 2.5, 3.0));
    place(EntityKind::Person, [7.0, 2.2, 0.0], 2.5, Shape::Capsule { radius: 0.25, height: 1.75 });
    place(EntityKind::Bench, [8.5, 4.2, 0.0], -quarter, Shape::cuboid(0.6, 1.8, 0.85));
    place(EntityKind::Prop, [6.0, -1.2, 0.0], 0.4, Shape::cuboid(0.8, 0.8, 0.8));
    world
}

/// Surfaces of a network as a city lays them: boxes along its roads, which cover their junctions, its crossings and sidewalks.
pub(crate) fn streets(network: RoadNetwork) -> World {
    let mut world = World::new();
    put(&mut world, EntityKind::Ground, [0.0, 0.0, -0.08], 0.0, Shape::cuboid(400.0, 400.0, 0.05));
    let mut along = |kind, path: &[Point2], half: f64, beyond: f64, top: f64| {
        for ends in path.windows(2) {
            let (way, middle) = (ends[1] - ends[0], nalgebra::center(&ends[0], &ends[1]));
            let shape = Shape::cuboid(way.norm() + 2.0 * beyond, 2.0 * half, 0.05);
            put(&mut world, kind, [middle.x, middle.y, top - 0.05], heading(&way), shape);
        }
    };
    for road in &network.roads {
        let half = road.left_kerb.max(road.right_kerb);
        along(EntityKind::Road, &road.centerline, half, half, -0.02);
    }
    for crossing in &network.crossings {
        along(EntityKind::Crosswalk, &[crossing.start, crossing.end], crossing.width * 0.5, 0.0, -0.01);
    }
    for walk in &network.sidewalks {
        along(EntityKind::Sidewalk, &walk.path, walk.width * 0.5, 0.0, 0.0);
    }
    for corner in network.intersections.iter().flat_map(|place| &place.corners) {
        along(EntityKind::Sidewalk, corner, 1.5, 0.0, 0.0);
    }
    world.set_roads(Arc::new(network));
    world
}

/// Where two streets of two lanes each way cross, with signals, cycle lanes and places to park.
pub(crate) fn crossroads() -> World {
    let mut plan = StreetPlan::crossroads(90.0);
    plan.sections[0] = CrossSection::two_way(2, 2).with_cycle_lanes(1.8).with_parking(2.2);
    streets(RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("a sound plan"))
}

/// The camera of [`square`].
pub(crate) fn square_camera(shift: f64, width: u32, height: u32) -> Camera {
    let intrinsics = Intrinsics::from_fov(width, height, 1.3).expect("a size in range");
    let eye = Point3::new(shift, shift, 2.4);
    Camera::looking_at(eye, Point3::new(shift + 14.0, shift + 0.4, 1.9), intrinsics)
}

/// Mean absolute difference of two byte buffers, and the share of bytes that differ by more than `limit`.
pub(crate) fn difference(a: &[u8], b: &[u8], limit: u8) -> (f64, f64) {
    assert_eq!(a.len(), b.len(), "pictures of two sizes");
    let (mut sum, mut count) = (0_u64, 0_usize);
    for (x, y) in a.iter().zip(b) {
        let apart = x.abs_diff(*y);
        sum += u64::from(apart);
        count += usize::from(apart > limit);
    }
    (sum as f64 / a.len() as f64, count as f64 / a.len() as f64)
}

/// The square, and somebody on it.
pub(crate) fn square_with_walker() -> (World, EntityId) {
    let mut world = square(0.0);
    let walker = put(
        &mut world,
        EntityKind::Person,
        [1.0, 2.0, 0.0],
        0.1,
        Shape::Capsule { radius: 0.25, height: 1.75 },
    );
    (world, walker)
}
