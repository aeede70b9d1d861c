//! A street built by hand, drawn from the height of a balcony: RGB, depth, classes and instances as PNG files; in any
//! weather that has a name.
//!
//! ```sh
//! cargo run --release -p simworld-render --example street -- out/street
//! cargo run --release -p simworld-render --example street -- out/night HardRainNight
//! ```

use std::path::PathBuf;

use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::environment::{Environment, Preset};
use simworld_core::geometry::{Point3, Twist, Vector3, direction, pose_facing};
use simworld_core::scene::{EntityDesc, EntityKind, Place, Shape, World, WorldError};
use simworld_core::seed::Seed;
use simworld_render::{AntiAliasing, Frame, RenderConfig, Renderer};

const QUARTER: f64 = std::f64::consts::FRAC_PI_2;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args_os().skip(1);
    let folder = PathBuf::from(arguments.next().unwrap_or_else(|| "out/street".into()));
    let mut world = street()?;
    if let Some(name) = arguments.next() {
        let preset: Preset = name.to_string_lossy().parse()?;
        world.set_environment(preset.environment())?;
    }
    let intrinsics = Intrinsics::from_fov(1280, 720, 1.15)?;
    let views = [
        ("street", Point3::new(-1.0, 0.3, 4.0), Point3::new(30.0, 0.9, 3.3)),
        ("sidewalk", Point3::new(6.0, 6.6, 1.6), Point3::new(30.0, 6.2, 1.8)),
        ("above", Point3::new(-30.0, -42.0, 46.0), Point3::new(45.0, 6.0, 0.0)),
    ];
    let config = RenderConfig { anti_aliasing: AntiAliasing::Msaa4, ..RenderConfig::default() };
    let mut renderer = Renderer::new(&config)?;
    let mut frame = Frame::new();
    std::fs::create_dir_all(&folder)?;
    for (name, eye, target) in views {
        renderer.render(&world, &Camera::looking_at(eye, target, intrinsics), &mut frame)?;
        frame.write_png(folder.join(format!("{name}.png")))?;
        frame.write_depth_png(folder.join(format!("{name}-depth.png")))?;
        frame.write_classes_png(folder.join(format!("{name}-classes.png")))?;
        frame.write_ids_png(folder.join(format!("{name}-ids.png")))?;
    }
    println!("drawn on {}; written to {}", renderer.adapter(), folder.display());
    Ok(())
}

/// A road along x with sidewalks, houses, trees, lamps, traffic and people.
fn street() -> Result<World, WorldError> {
    let mut world = World::new();
    let mut environment = Environment::default();
    environment.sun.azimuth = 3.9;
    environment.sun.elevation = 0.98;
    environment.weather.cloud_cover = 0.35;
    // The numbers are in range, so this cannot fail.
    let _ = world.set_environment(environment);
    surfaces(&mut world)?;
    buildings(&mut world)?;
    furniture(&mut world)?;
    traffic(&mut world)?;
    people(&mut world)?;
    Ok(world)
}

fn put(world: &mut World, kind: EntityKind, at: [f64; 3], yaw: f64, shape: Shape) -> Result<(), WorldError> {
    let pose = pose_facing(Point3::new(at[0], at[1], at[2]), yaw);
    world.spawn(EntityDesc::new(kind, pose, shape)).map(|_| ())
}

/// As [`put`], on its way at 8 m/s.
fn drive(
    world: &mut World,
    kind: EntityKind,
    at: [f64; 3],
    yaw: f64,
    shape: Shape,
) -> Result<(), WorldError> {
    let pose = pose_facing(Point3::new(at[0], at[1], at[2]), yaw);
    let mut desc = EntityDesc::new(kind, pose, shape);
    let way = direction(yaw) * 8.0;
    desc.twist.linear = Vector3::new(way.x, way.y, 0.0);
    world.spawn(desc).map(|_| ())
}

fn surfaces(world: &mut World) -> Result<(), WorldError> {
    put(world, EntityKind::Ground, [60.0, 0.0, -0.15], 0.0, Shape::cuboid(900.0, 900.0, 0.05))?;
    put(world, EntityKind::Road, [60.0, 0.0, -0.13], 0.0, Shape::cuboid(300.0, 7.6, 0.05))?;
    put(world, EntityKind::Road, [47.0, 0.0, -0.132], QUARTER, Shape::cuboid(300.0, 7.6, 0.05))?;
    put(world, EntityKind::Crosswalk, [40.0, 0.0, -0.125], QUARTER, Shape::cuboid(7.6, 3.0, 0.05))?;
    for side in [1.0, -1.0] {
        for (middle, length) in [(-24.0, 134.4), (126.0, 150.4)] {
            put(
                world,
                EntityKind::Sidewalk,
                [middle, side * 5.8, -0.08],
                0.0,
                Shape::cuboid(length, 4.0, 0.08),
            )?;
        }
    }
    Ok(())
}

fn buildings(world: &mut World) -> Result<(), WorldError> {
    let mut rng = Seed(5).stream("example/street").rng();
    let uses = [Place::Store, Place::Home, Place::Office, Place::Restaurant, Place::Home, Place::Office];
    let colors = [
        [0.62, 0.5, 0.38],
        [0.5, 0.2, 0.13],
        [0.66, 0.6, 0.52],
        [0.3, 0.36, 0.4],
        [0.58, 0.42, 0.26],
        [0.46, 0.46, 0.45],
        [0.42, 0.16, 0.11],
    ];
    for side in [1.0, -1.0] {
        let mut x = -70.0;
        let mut count = if side > 0.0 { 0 } else { 3 };
        while x < 190.0 {
            let width = rng.uniform(11.0, 17.0);
            let depth = rng.uniform(11.0, 14.0);
            let (from, to) = (x, x + width);
            x = to + if rng.chance(0.3) { rng.uniform(1.0, 4.0) } else { 0.0 };
            if to > 37.0 && from < 57.0 {
                x = x.max(57.0);
                continue;
            }
            let place = uses[count % uses.len()];
            let storeys = if place == Place::Office {
                4.0 + (rng.unit() * 6.0).floor()
            } else {
                2.0 + (rng.unit() * 3.0).floor()
            };
            let middle = Point3::new((from + to) * 0.5, side * (8.0 + depth * 0.5), 0.0);
            let pose = pose_facing(middle, -side * QUARTER);
            let shape = Shape::cuboid(depth, width, storeys * 3.2 + 1.0);
            let desc = EntityDesc::new(EntityKind::Building, pose, shape)
                .used_as(place)
                .colored(colors[(count * 3 + 1) % colors.len()]);
            world.spawn(desc)?;
            count += 1;
        }
    }
    Ok(())
}

fn furniture(world: &mut World) -> Result<(), WorldError> {
    for side in [1.0, -1.0] {
        for k in 0..11 {
            let x = -48.0 + 16.0 * f64::from(k);
            if (36.0..58.0).contains(&x) {
                continue;
            }
            let height = 5.6 + 0.35 * f64::from((k * 7 + if side > 0.0 { 2 } else { 0 }) % 5);
            put(
                world,
                EntityKind::Tree,
                [x, side * 4.3, 0.0],
                0.9 * f64::from(k),
                Shape::Cylinder { radius: 0.18, height },
            )?;
            let lamp = Shape::Cylinder { radius: 0.09, height: 6.5 };
            put(world, EntityKind::StreetLamp, [x + 8.0, side * 4.2, 0.0], -side * QUARTER, lamp)?;
        }
        let facing = -side * QUARTER;
        put(world, EntityKind::Bench, [11.0, side * 7.3, 0.0], facing, Shape::cuboid(0.6, 1.8, 0.85))?;
        put(world, EntityKind::Bench, [-14.0, side * 7.3, 0.0], facing, Shape::cuboid(0.6, 1.8, 0.85))?;
        put(
            world,
            EntityKind::TrashBin,
            [13.2, side * 4.4, 0.0],
            facing,
            Shape::Cylinder { radius: 0.25, height: 0.9 },
        )?;
        put(world, EntityKind::Mailbox, [22.0, side * 7.5, 0.0], facing, Shape::cuboid(0.4, 0.5, 1.2))?;
        put(
            world,
            EntityKind::Hydrant,
            [4.0, side * 4.25, 0.0],
            facing,
            Shape::Cylinder { radius: 0.15, height: 0.8 },
        )?;
        put(world, EntityKind::Shrub, [27.5, side * 7.3, 0.0], 0.4, Shape::cuboid(1.4, 1.4, 1.1))?;
        let post = Shape::Cylinder { radius: 0.08, height: 3.5 };
        put(
            world,
            EntityKind::TrafficSignal,
            [38.2 + 17.6 * f64::from(u8::from(side > 0.0)), -side * 4.3, 0.0],
            if side > 0.0 { 0.0 } else { std::f64::consts::PI },
            post,
        )?;
    }
    put(
        world,
        EntityKind::Sign,
        [33.0, -4.3, 0.0],
        std::f64::consts::PI,
        Shape::Cylinder { radius: 0.05, height: 2.6 },
    )?;
    put(world, EntityKind::BusStop, [20.0, -7.1, 0.0], QUARTER, Shape::cuboid(1.4, 4.0, 2.5))?;
    put(world, EntityKind::Table, [16.6, 7.2, 0.0], 0.2, Shape::cuboid(0.8, 0.8, 0.75))?;
    put(world, EntityKind::Chair, [15.8, 7.2, 0.0], 0.0, Shape::cuboid(0.5, 0.5, 0.9))?;
    put(world, EntityKind::Chair, [17.4, 7.2, 0.0], std::f64::consts::PI, Shape::cuboid(0.5, 0.5, 0.9))?;
    for x in [29.0, 30.2, 31.4] {
        put(world, EntityKind::Cone, [x, -3.4, -0.08], 0.0, Shape::Cylinder { radius: 0.18, height: 0.7 })?;
    }
    Ok(())
}

fn traffic(world: &mut World) -> Result<(), WorldError> {
    let road = -0.08;
    let car = Shape::cuboid(4.5, 1.8, 1.5);
    for x in [13.5, 24.0, 33.5, 78.0, 104.0] {
        drive(world, EntityKind::Car, [x, -1.9, road], 0.0, car)?;
    }
    for x in [-4.0, 15.5, 60.0, 84.0, 92.0] {
        drive(world, EntityKind::Car, [x, 1.9, road], std::f64::consts::PI, car)?;
    }
    drive(world, EntityKind::Bus, [26.0, 1.9, road], std::f64::consts::PI, Shape::cuboid(11.0, 2.5, 3.0))?;
    put(world, EntityKind::Truck, [62.0, -1.9, road], 0.0, Shape::cuboid(5.6, 2.0, 2.5))?;
    put(world, EntityKind::Car, [45.0, 11.0, road], -QUARTER, car)?;
    put(world, EntityKind::Bicycle, [10.5, -3.2, road], 0.0, Shape::cuboid(1.75, 0.5, 1.1))?;
    put(world, EntityKind::Scooter, [9.0, 4.6, 0.0], 0.8, Shape::cuboid(1.1, 0.45, 1.1))?;
    put(world, EntityKind::Motorcycle, [24.0, -4.6, 0.0], 0.5, Shape::cuboid(2.1, 0.75, 1.15))
}

fn people(world: &mut World) -> Result<(), WorldError> {
    let mut rng = Seed(11).stream("example/people").rng();
    for k in 0..44 {
        let side = if k % 2 == 0 { 1.0 } else { -1.0 };
        let yaw = if rng.chance(0.5) { 0.0 } else { std::f64::consts::PI };
        let at = Point3::new(rng.uniform(-2.0, 130.0), side * rng.uniform(5.0, 6.9), 0.0);
        if (41.0..54.0).contains(&at.x) {
            continue;
        }
        let shape = Shape::Capsule { radius: 0.25, height: rng.uniform(1.58, 1.92) };
        let mut desc = EntityDesc::new(EntityKind::Person, pose_facing(at, yaw), shape);
        let way = direction(yaw) * rng.uniform(0.0, 1.5);
        desc.twist = Twist { linear: Vector3::new(way.x, way.y, 0.0), angular: Vector3::zeros() };
        world.spawn(desc)?;
    }
    for (y, yaw) in [(-1.2, QUARTER), (2.2, -QUARTER)] {
        let shape = Shape::Capsule { radius: 0.25, height: 1.75 };
        let mut desc =
            EntityDesc::new(EntityKind::Person, pose_facing(Point3::new(40.0, y, -0.07), yaw), shape);
        desc.twist.linear = Vector3::new(0.0, yaw.signum() * 1.3, 0.0);
        world.spawn(desc)?;
    }
    let courier = EntityDesc::new(
        EntityKind::Person,
        pose_facing(Point3::new(9.6, 5.8, 0.0), 0.15),
        Shape::Capsule { radius: 0.25, height: 1.78 },
    );
    let mut courier = courier.colored([0.85, 0.3, 0.02]);
    courier.twist.linear.x = 1.4;
    world.spawn(courier)?;
    put(world, EntityKind::Parcel, [9.95, 5.85, 0.95], 0.15, Shape::cuboid(0.3, 0.36, 0.24))?;
    put(world, EntityKind::Dog, [14.0, 5.3, 0.0], 0.3, Shape::cuboid(0.9, 0.3, 0.6))?;
    put(world, EntityKind::Robot, [19.0, 5.0, 0.0], 3.0, Shape::cuboid(0.7, 0.5, 0.9))
}
