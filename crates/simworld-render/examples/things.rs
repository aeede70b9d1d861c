//! A catalogue: one of everything that is drawn, in rows, as PNG files.
//!
//! ```sh
//! cargo run --release -p simworld-render --example things -- out/things
//! ```

use std::path::PathBuf;
use std::sync::Arc;

use simworld_core::asset::Catalogue;
use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::environment::Environment;
use simworld_core::geometry::{Point3, Twist, Vector3, pose_facing};
use simworld_core::scene::{
    Attachment, EntityDesc, EntityKind, GESTURE, Gesture, Place, Role, Scene, Shape, World,
};
use simworld_render::{AntiAliasing, Frame, RenderConfig, Renderer};

const HELP: &str = "\
Draws a catalogue of everything that simworld-render knows, one PNG file a sheet.

usage: things [FOLDER] [SHEET]...

FOLDER  where the pictures go; out/things without it
SHEET   people, actions, vehicles, buildings, street, props, trees; all without one";

type Outcome<T> = Result<T, Box<dyn std::error::Error>>;

fn main() -> Outcome<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if arguments.iter().any(|argument| argument == "--help" || argument == "-h") {
        println!("{HELP}");
        return Ok(());
    }
    let folder = PathBuf::from(arguments.first().map_or("out/things", String::as_str));
    let wanted = arguments.get(1..).unwrap_or_default();
    let config = RenderConfig { anti_aliasing: AntiAliasing::Msaa4, ..RenderConfig::default() };
    let mut renderer = Renderer::new(&config)?;
    std::fs::create_dir_all(&folder)?;
    for (name, sheet) in SHEETS {
        if !wanted.is_empty() && !wanted.iter().any(|sheet| sheet == name) {
            continue;
        }
        let (world, eye, target) = sheet()?;
        let camera = Camera::looking_at(eye, target, Intrinsics::from_fov(1280, 720, 0.8)?);
        let mut frame = Frame::new();
        renderer.render(&world, &camera, &mut frame)?;
        let path = folder.join(format!("{name}.png"));
        frame.write_png(&path)?;
        println!("{:10} {:4} entities  {}", name, world.len(), path.display());
    }
    println!("drawn on {}", renderer.adapter());
    Ok(())
}

type Sheet = (World, Point3, Point3);

/// A name, and what makes its sheet.
type Named = (&'static str, fn() -> Outcome<Sheet>);

const SHEETS: [Named; 7] = [
    ("people", people),
    ("actions", actions),
    ("vehicles", vehicles),
    ("buildings", buildings),
    ("street", street),
    ("props", props),
    ("trees", trees),
];

/// Level ground under a sun from the left behind the camera.
fn ground() -> Outcome<World> {
    let mut world = World::new();
    let mut environment = Environment::default();
    environment.sun.azimuth = 3.7;
    environment.sun.elevation = 0.8;
    environment.weather.cloud_cover = 0.2;
    world.set_environment(environment)?;
    let pose = pose_facing(Point3::new(0.0, 0.0, -0.05), 0.0);
    world.spawn(EntityDesc::new(EntityKind::Sidewalk, pose, Shape::cuboid(900.0, 900.0, 0.05)))?;
    Ok(world)
}

/// A place in rows of `columns`, `dx` and `dy` m apart, the first row nearest to a camera in the south.
fn spot(index: usize, columns: usize, dx: f64, dy: f64) -> Point3 {
    let (row, column) = (index / columns, index % columns);
    Point3::new((column as f64 - (columns as f64 - 1.0) * 0.5) * dx, row as f64 * dy, 0.0)
}

fn person(at: Point3, yaw: f64, height: f64, speed: f64) -> EntityDesc {
    let pose = pose_facing(at, yaw);
    let shape = Shape::Capsule { radius: 0.25, height };
    let mut desc = EntityDesc::new(EntityKind::Person, pose, shape);
    desc.twist = Twist { linear: pose.rotation * Vector3::new(speed, 0.0, 0.0), angular: Vector3::zeros() };
    desc
}

fn people() -> Outcome<Sheet> {
    let mut world = ground()?;
    for k in 0..27_usize {
        let height = [1.75, 1.62, 1.86, 1.2, 1.7, 1.78, 1.55, 1.8, 1.68][k % 9];
        let speed = [0.0, 1.4, 3.4][k / 9];
        let yaw = -1.2 + 0.35 * (k % 4) as f64;
        let desc = person(spot(k, 9, 0.95, 1.9), yaw, height, speed);
        world.spawn(desc)?;
    }
    Ok((world, Point3::new(0.0, -7.2, 2.6), Point3::new(0.0, 1.2, 0.75)))
}

fn actions() -> Outcome<Sheet> {
    let mut world = ground()?;
    for (k, gesture) in Gesture::ALL.into_iter().enumerate() {
        let desc = person(spot(k, 10, 1.5, 2.0), -1.1, 1.75, 0.0);
        world.spawn(desc.with(GESTURE, gesture.as_str()))?;
    }
    let hang = |world: &mut World, child: EntityDesc, parent, role, at: [f64; 3]| -> Outcome<()> {
        let parent_from_body = pose_facing(Point3::from(at), 0.0);
        let carrier = world.entity(parent).map(|carrier| *carrier.pose).ok_or("no carrier")?;
        let mut child = child;
        child.pose = carrier * parent_from_body;
        child.attachment = Some(Attachment { parent, role, parent_from_body });
        world.spawn(child)?;
        Ok(())
    };
    let thing = |kind, shape| EntityDesc::new(kind, pose_facing(Point3::origin(), 0.0), shape);
    let desc = person(spot(4, 10, 1.5, 2.0), -1.1, 1.75, 1.2);
    let holder = world.spawn(desc)?;
    hang(
        &mut world,
        thing(EntityKind::Parcel, Shape::cuboid(0.3, 0.2, 0.25)),
        holder,
        Role::Held,
        [0.35, -0.25, 0.65],
    )?;
    let desc = person(spot(5, 10, 1.5, 2.0), -1.1, 1.75, 1.2);
    let carrier = world.spawn(desc)?;
    hang(
        &mut world,
        thing(EntityKind::Parcel, Shape::cuboid(0.45, 0.5, 0.4)),
        carrier,
        Role::Carried,
        [0.5, 0.0, 0.8],
    )?;
    let desc = person(spot(6, 10, 1.5, 2.0), -0.9, 1.75, 3.0);
    let rider = world.spawn(desc)?;
    hang(
        &mut world,
        thing(EntityKind::Scooter, Shape::cuboid(1.1, 0.45, 1.1)),
        rider,
        Role::Ridden,
        [0.0; 3],
    )?;
    let pose = pose_facing(spot(7, 10, 1.5, 2.0), -1.1);
    let bench = world.spawn(EntityDesc::new(EntityKind::Bench, pose, Shape::cuboid(0.6, 1.8, 0.85)))?;
    for y in [0.45, -0.45] {
        let sitter = person(Point3::origin(), 0.0, 1.7 + 0.1 * y, 0.0);
        hang(&mut world, sitter, bench, Role::Seated, [0.0, y, 0.425])?;
    }
    for (k, (kind, size, speed)) in [
        (EntityKind::Bicycle, [1.75, 0.6, 1.1], 5.0),
        (EntityKind::Motorcycle, [2.1, 0.8, 1.2], 9.0),
        (EntityKind::Scooter, [1.15, 0.5, 1.2], 4.0),
    ]
    .into_iter()
    .enumerate()
    {
        let pose = pose_facing(Point3::new(-4.0 + 3.0 * k as f64, 2.6, 0.0), -0.5);
        let mut desc = EntityDesc::new(kind, pose, Shape::cuboid(size[0], size[1], size[2]));
        desc.twist.linear = pose.rotation * Vector3::new(speed, 0.0, 0.0);
        world.spawn(desc)?;
    }
    Ok((world, Point3::new(0.0, -8.0, 2.4), Point3::new(0.0, 1.0, 0.7)))
}

/// Assets of the library by what they are, in rows.
fn rows(names: &[&str], columns: usize, [dx, dy]: [f64; 2], yaw: f64, speed: f64) -> Outcome<World> {
    let mut world = ground()?;
    let library = Arc::new(Catalogue::library());
    for (k, name) in names.iter().enumerate() {
        let id = library.find(name).ok_or_else(|| format!("there is no asset {name}"))?;
        let asset = library.get(id).ok_or("it was found")?.clone();
        let own = world.add_asset(asset.clone())?;
        let mut desc = asset.at(own, pose_facing(spot(k, columns, dx, dy), yaw));
        desc.twist.linear = desc.pose.rotation * Vector3::new(speed, 0.0, 0.0);
        world.spawn(desc)?;
    }
    Ok(world)
}

fn vehicles() -> Outcome<Sheet> {
    let names = [
        "small_car",
        "car",
        "suv",
        "sports_car",
        "taxi",
        "police_car",
        "pickup",
        "van",
        "ambulance",
        "truck",
        "delivery_truck",
        "garbage_truck",
        "fire_engine",
        "tanker",
        "bus",
        "double_decker",
        "coach",
        "school_bus",
    ];
    let mut world = rows(&names, 6, [7.5, 8.0], -0.65, 0.0)?;
    for (k, name) in
        ["bicycle", "motorcycle", "moped", "scooter", "robot_dog", "delivery_robot"].iter().enumerate()
    {
        let library = Catalogue::library();
        let asset = library.find(name).and_then(|id| library.get(id)).ok_or("no such asset")?.clone();
        let own = world.add_asset(asset.clone())?;
        world.spawn(asset.at(own, pose_facing(Point3::new(-8.0 + 3.2 * k as f64, -5.5, 0.0), -0.65)))?;
    }
    Ok((world, Point3::new(0.0, -22.0, 10.5), Point3::new(0.0, 5.0, 0.5)))
}

fn buildings() -> Outcome<Sheet> {
    let mut world = ground()?;
    let all: [(Place, f64, f64, i64, &str, &str); 18] = [
        (Place::Home, 10.0, 9.0, 2, "gable", "house"),
        (Place::Home, 9.0, 11.0, 1, "hip", "cottage"),
        (Place::Home, 11.0, 8.0, 3, "gable", "row_house"),
        (Place::Store, 11.0, 9.0, 2, "flat", "shop"),
        (Place::Restaurant, 12.0, 11.0, 2, "hip", "restaurant"),
        (Place::Factory, 20.0, 16.0, 1, "shed", "warehouse"),
        (Place::Home, 14.0, 18.0, 5, "flat", "apartment_block"),
        (Place::Store, 13.0, 12.0, 3, "flat", "shop_house"),
        (Place::School, 16.0, 22.0, 3, "flat", "school"),
        (Place::Hospital, 16.0, 22.0, 5, "flat", "hospital"),
        (Place::Museum, 16.0, 20.0, 3, "flat", "museum"),
        (Place::Office, 28.0, 13.0, 4, "gable", "church"),
        (Place::Office, 20.0, 22.0, 14, "flat", "office_tower"),
        (Place::Home, 18.0, 20.0, 12, "flat", "apartment_tower"),
        (Place::Office, 18.0, 22.0, 6, "flat", "office_block"),
        (Place::Office, 24.0, 24.0, 24, "flat", "skyscraper"),
        (Place::Store, 24.0, 26.0, 3, "shed", "market_hall"),
        (Place::Home, 13.0, 18.0, 4, "hip", "apartment_slab"),
    ];
    for (k, (place, depth, width, storeys, roof, name)) in all.into_iter().enumerate() {
        let at = spot(k, 6, 27.0, 34.0);
        let height = storeys as f64 * 3.2 + if roof == "flat" { 1.0 } else { 2.4 };
        let desc = EntityDesc::new(
            EntityKind::Building,
            pose_facing(at, -std::f64::consts::FRAC_PI_2 + 0.3),
            Shape::cuboid(depth, width, height),
        );
        world.spawn(
            desc.used_as(place).named(name).with("storeys", storeys).with("roof", roof).with("type", name),
        )?;
    }
    Ok((world, Point3::new(-20.0, -88.0, 42.0), Point3::new(0.0, 18.0, 6.0)))
}

fn street() -> Outcome<Sheet> {
    let names = [
        "bench",
        "park_bench",
        "stone_bench",
        "picnic_table",
        "chair",
        "table",
        "round_table",
        "parasol",
        "trash_bin",
        "wheelie_bin",
        "dumpster",
        "mailbox",
        "letter_box",
        "hydrant",
        "cone",
        "bollard",
        "stone_bollard",
        "parking_meter",
        "planter",
        "bicycle_rack",
        "sign",
        "stop_sign",
        "yield_sign",
        "speed_limit_sign",
        "street_name_sign",
        "direction_sign",
        "information_board",
        "advertising_column",
        "traffic_signal",
        "pedestrian_signal",
        "street_lamp",
        "park_lantern",
        "double_street_lamp",
        "bus_stop",
        "newsstand",
        "market_stall",
        "food_cart",
        "phone_booth",
        "vending_machine",
        "utility_box",
        "charging_point",
        "clock_post",
        "flagpole",
        "billboard",
    ];
    let world = rows(&names, 11, [2.2, 4.4], -1.1, 0.0)?;
    Ok((world, Point3::new(0.0, -24.0, 14.0), Point3::new(0.0, 4.0, 0.8)))
}

fn props() -> Outcome<Sheet> {
    let names = [
        "cardboard_box",
        "wooden_crate",
        "pallet",
        "barrel",
        "suitcase",
        "shopping_bag",
        "football",
        "bouquet",
        "umbrella",
        "road_blocker",
        "concrete_barrier",
        "crowd_barrier",
        "construction_fence",
        "guard_rail",
        "picket_fence",
        "iron_railing",
        "brick_wall",
        "scaffold",
        "ladder",
        "sand_pile",
        "pipe_stack",
        "shipping_container",
        "portable_toilet",
        "generator",
        "utility_pole",
        "manhole_cover",
        "campfire",
        "fountain",
        "statue",
        "obelisk",
        "gazebo",
        "archway",
        "well",
        "swing_set",
        "slide",
        "basketball_hoop",
        "goal",
        "stage",
        "tent",
        "snowman",
        "hay_bale",
        "rowing_boat",
        "solar_panel",
        "phone_booth",
    ];
    let world = rows(&names, 11, [3.6, 6.0], -1.1, 0.0)?;
    Ok((world, Point3::new(0.0, -36.0, 20.0), Point3::new(0.0, 5.0, 0.8)))
}

fn trees() -> Outcome<Sheet> {
    let mut world = ground()?;
    let library = Catalogue::library();
    let names = [
        "oak",
        "birch",
        "maple",
        "cherry_tree",
        "willow",
        "poplar",
        "pine",
        "spruce",
        "cypress",
        "palm_tree",
        "tree",
    ];
    for (row, season) in simworld_core::asset::Season::ALL.into_iter().enumerate() {
        for (column, name) in names.iter().enumerate() {
            let asset = library.find(name).and_then(|id| library.get(id)).ok_or("no such asset")?.clone();
            let own = world.add_asset(asset.clone())?;
            let at = Point3::new((column as f64 - 5.0) * 9.0, row as f64 * 22.0, 0.0);
            let mut desc = asset.at(own, pose_facing(at, 0.3 * row as f64));
            desc.info.color = asset.color_in(season).or(desc.info.color);
            world.spawn(desc.with("season", season.as_str()))?;
        }
    }
    Ok((world, Point3::new(0.0, -100.0, 50.0), Point3::new(0.0, 20.0, 3.0)))
}
