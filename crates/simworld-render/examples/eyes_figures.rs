//! How fast the eyes are on this adapter: a table of views a second and of what each costs, drawn by triangles and cast by rays, on the device and on the host.
//!
//! ```sh
//! cargo run --release -p simworld-render --example eyes_figures
//! ```
//!
//! The binary needs no files. The city is procedural: streets with buildings, trees, lamps, cars and people, 10,000 things on a square
//! kilometre; more things are a larger city.
#![expect(clippy::disallowed_methods, reason = "it measures time")]

use std::time::Instant;

use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::{Point3, Twist, Vector3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityDesc, EntityKind, Shape, World};
use simworld_core::seed::{Seed, StreamRng};
use simworld_render::{
    Backend, Culling, Frame, RenderConfig, RenderError, Renderer, ViewOptions, ViewRequest, Views,
};

const HELP: &str = "\
Views a second on this adapter, by both backends.

Usage: eyes_figures [--only TEXT] [--seconds S] [--things N] [--views N] [--agents N] [--bodies N]

  --only TEXT   rows whose name holds this text
  --seconds S   how long each row is measured, 0.05 to 600 [2]
  --things N    things in the city; the larger city has ten times as many [10000]
  --views N     views of 128 x 128 pixels in a batch [1024; 16 on a CPU]
  --agents N    agents that see at once, among the moving bodies [1000; 20 on a CPU]
  --bodies N    bodies that move in every step [10000; 1000 on a CPU]
";

type Failure = Box<dyn std::error::Error>;
/// Measures a row.
type Row = Box<dyn FnOnce(&mut Renderer) -> Result<Measured, Failure>>;

/// What a row came to.
struct Measured {
    /// Batches a second.
    rate: f64,
    /// In each of them.
    views: usize,
    /// Seconds of all processors that a batch took, driver and all, where the system tells.
    work: Option<f64>,
    /// Seconds that each step of the last batch took on the device, where it was left there.
    steps: Vec<(&'static str, f64)>,
}

/// What was asked for.
struct Settings {
    only: String,
    seconds: f64,
    things: u32,
    views: Option<u32>,
    agents: Option<u32>,
    bodies: Option<u32>,
}

/// How a row gets its results.
#[derive(Clone, Copy)]
enum Results {
    /// Whoever goes on with them there hands that in behind them, without the host.
    OnDevice,
    /// The next batch is handed in before the last is taken.
    OnHost(ViewOptions),
}

fn main() -> Result<(), Failure> {
    let Some(settings) = settings()? else {
        print!("{HELP}");
        return Ok(());
    };
    let renderers: Result<Vec<(&str, Renderer, f64)>, RenderError> =
        [("raster", Backend::Raster), ("raycast", Backend::Raycast)]
            .into_iter()
            .map(|(name, backend)| {
                let start = Instant::now();
                let renderer = Renderer::new(&RenderConfig { backend, ..RenderConfig::default() })?;
                Ok((name, renderer, start.elapsed().as_secs_f64()))
            })
            .collect();
    let mut renderers = match renderers {
        Ok(renderers) => renderers,
        Err(error) => {
            println!("nothing measured: {error}");
            return Ok(());
        }
    };
    let adapter = renderers[0].1.adapter();
    let is_cpu =
        adapter.contains("llvmpipe") || adapter.contains("lavapipe") || adapter.contains("SwiftShader");
    println!("adapter: {adapter}; full look, shadows, 7 to 12 bytes a pixel\n");
    for (name, renderer, made) in &mut renderers {
        let [first, second] = begin(renderer)?.map(|seconds| seconds * 1e3);
        let made = *made * 1e3;
        println!(
            "{name}: made in {made:.0} ms, its first picture of a car {first:.0} ms more, the next {second:.1} ms"
        );
    }
    println!();
    println!("{:68} {:>9} {:>14} {:>20}", "what", "a second", "views a second", "ms of processor each");
    let mut measured_rows: Vec<(String, f64)> = Vec::new();
    for (name, renderer, _) in &mut renderers {
        for (what, measured) in rows(&settings, is_cpu) {
            let what = format!("{name}: {what}");
            if what.contains(&settings.only) {
                let Measured { rate, views, work, steps } = measured(renderer)?;
                let work = work.map_or_else(|| "-".to_owned(), |work| format!("{:.1}", work * 1e3));
                println!("{what:68} {rate:>9.1} {:>14.0} {work:>20}", rate * views as f64);
                for (step, seconds) in steps {
                    println!("    {step:64} {:>9.2} ms on the device", seconds * 1e3);
                }
                measured_rows.push((what, rate));
            }
        }
    }
    print_ratios(&measured_rows);
    compare_culling(&settings, is_cpu, &mut measured_rows)?;
    if measured_rows.is_empty() {
        return Err(format!("no row holds the text {:?}", settings.only).into());
    }
    Ok(())
}

/// Draws a car twice, 160 x 120 pixels; how long each took, s.
fn begin(renderer: &mut Renderer) -> Result<[f64; 2], Failure> {
    let (mut world, mut frame) = (World::new(), Frame::new());
    let pose = pose_facing(Point3::new(12.0, 0.0, 0.0), 0.0);
    world.spawn(EntityDesc::new(EntityKind::Car, pose, Shape::cuboid(4.5, 1.8, 1.5)))?;
    let ahead = Point3::new(12.0, 0.0, 0.7);
    let camera = Camera::looking_at(Point3::new(0.0, 4.0, 2.0), ahead, Intrinsics::from_fov(160, 120, 1.0)?);
    let mut taken = [0.0; 2];
    for seconds in &mut taken {
        let start = Instant::now();
        renderer.render(&world, &camera, &mut frame)?;
        *seconds = start.elapsed().as_secs_f64();
    }
    Ok(taken)
}

/// What of one picture in the small city, by triangles, the others are.
fn print_ratios(rows: &[(String, f64)]) {
    let rate = |what: &str| rows.iter().find(|(name, _)| name == what).map(|(_, rate)| *rate);
    let (small, large) = ("640 x 480 of a city, on host", "640 x 480 of a city ten times as large, on host");
    let Some(base) = rate(&format!("raster: {small}")) else { return };
    println!();
    for (name, other) in [
        ("triangles over rays", rate(&format!("raycast: {small}"))),
        ("a city over one ten times as large, by triangles", rate(&format!("raster: {large}"))),
    ] {
        if let Some(other) = other {
            println!("{name}, 640 x 480: {:.2}", base / other);
        }
    }
}

/// What of one picture by triangles culled by the host one is that the device culls; both are measured in turns, so that whatever else the machine does
/// slows them alike.
fn compare_culling(
    settings: &Settings,
    is_cpu: bool,
    measured: &mut Vec<(String, f64)>,
) -> Result<(), Failure> {
    const TURNS: u32 = 3;
    let bodies = settings.bodies.unwrap_or(if is_cpu { 1000 } else { 10_000 });
    let things = settings.things;
    let rows = [
        ("culling: 640 x 480 of a city", things, 0),
        ("culling: 640 x 480 of a city ten times as large", things * 10, 0),
        ("culling: 640 x 480 among bodies that move", things.max(bodies * 4), bodies),
    ];
    for (what, things, bodies) in rows.into_iter().filter(|(what, ..)| what.contains(&settings.only)) {
        let (mut world, mut movers) = city(things)?;
        movers.truncate(bodies as usize);
        let (view, results) = (street_views(1, 640, 480)?, Results::OnHost(ViewOptions::default()));
        let renderer = |culling| {
            Renderer::new(&RenderConfig { backend: Backend::Raster, culling, ..RenderConfig::default() })
        };
        let mut pair = [renderer(Culling::Host)?, renderer(Culling::Device)?];
        let mut rates = [0.0; 2];
        let mut work = [0.0; 2];
        for _ in 0..TURNS {
            for (index, renderer) in pair.iter_mut().enumerate() {
                let seconds = settings.seconds / f64::from(TURNS);
                let one = measure(renderer, &mut world, &movers, &view, results, seconds)?;
                rates[index] += one.rate / f64::from(TURNS);
                work[index] += one.work.unwrap_or(0.0) * 1e3 / f64::from(TURNS);
            }
        }
        let ([host, device], [host_work, device_work]) = (rates, work);
        println!(
            "{what}: by the host {host:.1} a second and {host_work:.1} ms of processor each, by the device {device:.1} and \
             {device_work:.1}; device over host {:.2}",
            device / host
        );
        measured.push((what.to_owned(), device));
    }
    Ok(())
}

/// Seconds that this process had of all processors; Linux tells them in hundredths.
fn processor_seconds() -> Option<f64> {
    let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
    // The name may hold spaces, and ends with the last bracket; user and system time are fields 14 and 15.
    let ticks: Vec<f64> = stat
        .rsplit_once(')')?
        .1
        .split_whitespace()
        .skip(11)
        .take(2)
        .filter_map(|word| word.parse().ok())
        .collect();
    (ticks.len() == 2).then(|| ticks.iter().sum::<f64>() / 100.0)
}

/// The rows of one backend, each with what measures it.
fn rows(settings: &Settings, is_cpu: bool) -> Vec<(String, Row)> {
    let fits = |asked: Option<u32>, gpu: u32, cpu: u32| asked.unwrap_or(if is_cpu { cpu } else { gpu });
    let on_host = Results::OnHost(ViewOptions::default());
    let seconds = settings.seconds;
    let mut rows = Vec::new();
    for (factor, size) in [(1, "a city"), (10, "a city ten times as large")] {
        let still = |count, width, height, results| {
            still(settings.things * factor, (count, width, height), results, seconds)
        };
        rows.push((format!("640 x 480 of {size}, on host"), still(1, 640, 480, on_host)));
        let views = fits(settings.views, 1024, 16);
        let compact = Results::OnHost(ViewOptions::compact());
        let kinds = [("on device", Results::OnDevice), ("on host", on_host), ("on host, compact", compact)];
        for (place, results) in kinds {
            let what = format!("{views} of 128 x 128 of {size}, {place}");
            rows.push((what, still(views, 128, 128, results)));
        }
    }
    let (agents, bodies) = (fits(settings.agents, 1000, 20), fits(settings.bodies, 10_000, 1000));
    let things = settings.things.max(bodies * 4);
    let moving: Row = Box::new(move |renderer| {
        let (mut world, mut movers) = city(things)?;
        movers.truncate(bodies as usize);
        measure(renderer, &mut world, &movers, &street_views(agents, 128, 128)?, on_host, seconds)
    });
    rows.push((format!("{agents} agents of 128 x 128 among {bodies} that move, on host"), moving));
    rows
}

/// A row of a city in which nothing moves: so many views of a width and height.
fn still(things: u32, (count, width, height): (u32, u32, u32), results: Results, seconds: f64) -> Row {
    Box::new(move |renderer| {
        let mut world = city(things)?.0;
        measure(renderer, &mut world, &[], &street_views(count, width, height)?, results, seconds)
    })
}

fn settings() -> Result<Option<Settings>, Failure> {
    let mut settings = Settings {
        only: String::new(),
        seconds: 2.0,
        things: 10_000,
        views: None,
        agents: None,
        bodies: None,
    };
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        if argument == "--help" || argument == "-h" {
            return Ok(None);
        }
        let value = arguments.next().ok_or_else(|| format!("{argument} wants a value; see --help"))?;
        let count = |most: u32| -> Result<u32, Failure> {
            let count: u32 = value.parse().map_err(|error| format!("{argument} {value}: {error}"))?;
            if (1..=most).contains(&count) {
                Ok(count)
            } else {
                Err(format!("{argument} takes 1 to {most}").into())
            }
        };
        match argument.as_str() {
            "--only" => settings.only = value,
            "--seconds" => {
                settings.seconds = value.parse().map_err(|error| format!("{argument} {value}: {error}"))?;
                if !(0.05..=600.0).contains(&settings.seconds) {
                    return Err("--seconds takes 0.05 to 600".into());
                }
            }
            "--things" => settings.things = count(1_000_000)?,
            "--views" => settings.views = Some(count(16_384)?),
            "--agents" => settings.agents = Some(count(16_384)?),
            "--bodies" => settings.bodies = Some(count(200_000)?),
            other => return Err(format!("{other} is not known; see --help").into()),
        }
    }
    Ok(Some(settings))
}

/// Draws again and again; gives batches a second and the views in each.
fn measure(
    renderer: &mut Renderer,
    world: &mut World,
    movers: &[EntityId],
    requests: &[ViewRequest],
    results: Results,
    seconds: f64,
) -> Result<Measured, Failure> {
    let mut views = Views::new();
    let mut under_way = None;
    let (mut start, mut work, mut batches) = (Instant::now(), processor_seconds(), 0_u32);
    // The first two are not counted: pipelines and buffers are made in them.
    for round in 0_u32.. {
        if round == 2 {
            (start, work, batches) = (Instant::now(), processor_seconds(), 0);
        }
        if round > 2 && start.elapsed().as_secs_f64() >= seconds {
            break;
        }
        for (index, id) in movers.iter().enumerate() {
            let Some(entity) = simworld_core::scene::Scene::entity(world, *id) else { continue };
            let along = if (round + index as u32).is_multiple_of(2) { 0.1 } else { -0.1 };
            let pose = entity.pose * nalgebra::Translation3::new(along, 0.0, 0.0);
            world.set_motion(*id, pose, Twist::ZERO)?;
        }
        world.finish_step();
        match results {
            Results::OnDevice => {
                let drawn = renderer.draw_on_device(world, requests, &ViewOptions::compact())?;
                if round < 2 {
                    drawn.wait()?;
                }
            }
            Results::OnHost(options) => {
                let ticket = renderer.submit(world, requests, &options)?;
                if let Some(last) = under_way.replace(ticket) {
                    renderer.take(last, &mut views)?;
                }
            }
        }
        batches += 1;
    }
    if let Some(last) = under_way {
        renderer.take(last, &mut views)?;
    }
    let mut steps = Vec::new();
    if matches!(results, Results::OnDevice) {
        // One more, which is done when all are.
        steps = renderer.draw_on_device(world, requests, &ViewOptions::compact())?.times()?;
        batches += 1;
    }
    let elapsed = start.elapsed().as_secs_f64();
    let rate = f64::from(batches) / elapsed;
    let work = work.zip(processor_seconds()).map(|(before, after)| (after - before) / f64::from(batches));
    Ok(Measured { rate, views: requests.len(), work, steps })
}

/// Streets every 100 m with what stands along them; what moves is given beside.
fn city(things: u32) -> Result<(World, Vec<EntityId>), Failure> {
    let side = (f64::from(things) * 100.0).sqrt().max(200.0);
    let mut rng = Seed(7).stream("examples/eyes").rng();
    let mut world = World::new();
    let mut movers = Vec::new();
    let mut put = |kind: EntityKind, at: [f64; 3], yaw: f64, shape: Shape| {
        let pose = pose_facing(Point3::new(at[0], at[1], at[2]), yaw);
        world.spawn(EntityDesc::new(kind, pose, shape))
    };
    put(EntityKind::Ground, [0.0, 0.0, -1.1], 0.0, Shape::cuboid(side + 400.0, side + 400.0, 1.0))?;
    let streets = (side / 100.0) as i32;
    for street in -streets / 2..=streets / 2 {
        let y = f64::from(street) * 100.0;
        put(EntityKind::Road, [0.0, y, -0.1], 0.0, Shape::cuboid(side, 8.0, 0.1))?;
        for beside in [-6.0, 6.0] {
            put(EntityKind::Sidewalk, [0.0, y + beside, -0.1], 0.0, Shape::cuboid(side, 4.0, 0.2))?;
        }
    }
    for _ in 0..things {
        let street = rng.uniform(f64::from(-streets / 2), f64::from(streets / 2)).round() * 100.0;
        let (kind, beside, shape) = thing(&mut rng);
        let side_of = if rng.uniform(0.0, 1.0) < 0.5 { 1.0 } else { -1.0 };
        let at =
            [rng.uniform(-0.5, 0.5) * side, street + side_of * beside, if beside < 4.0 { 0.0 } else { 0.1 }];
        let yaw = if side_of > 0.0 { std::f64::consts::PI } else { 0.0 };
        let turned = if kind == EntityKind::Building { yaw + std::f64::consts::FRAC_PI_2 } else { yaw };
        let id = put(kind, at, turned, shape)?;
        if kind.is_mobile() {
            movers.push(id);
        }
    }
    world.finish_step();
    Ok((world, movers))
}

/// What stands or goes along a street, and how far from its middle.
fn thing(rng: &mut StreamRng) -> (EntityKind, f64, Shape) {
    match rng.uniform(0.0, 100.0) as u32 {
        0..15 => {
            let (width, depth) = (rng.uniform(9.0, 22.0), rng.uniform(9.0, 14.0));
            (EntityKind::Building, 9.5 + depth * 0.5, Shape::cuboid(depth, width, rng.uniform(6.0, 30.0)))
        }
        15..40 => {
            let height = rng.uniform(4.0, 9.0);
            (EntityKind::Tree, rng.uniform(7.2, 30.0), Shape::Cylinder { radius: 0.15, height })
        }
        40..50 => (EntityKind::StreetLamp, 4.6, Shape::Cylinder { radius: 0.09, height: 6.0 }),
        50..56 => (EntityKind::Bench, 7.4, Shape::cuboid(0.6, 1.8, 0.85)),
        56..60 => (EntityKind::TrashBin, 4.9, Shape::Cylinder { radius: 0.3, height: 1.0 }),
        60..80 => (EntityKind::Car, 2.0, Shape::cuboid(4.4, 1.8, 1.5)),
        _ => (EntityKind::Person, rng.uniform(4.8, 7.2), Shape::Capsule { radius: 0.25, height: 1.75 }),
    }
}

/// Cameras at the height of eyes, on the sidewalks of the middle.
fn street_views(count: u32, width: u32, height: u32) -> Result<Vec<ViewRequest>, Failure> {
    let mut rng = Seed(8).stream("examples/eyes").rng();
    let intrinsics = Intrinsics::from_fov(width, height, 1.4)?;
    let one = |_| {
        let eye =
            Point3::new(rng.uniform(-90.0, 90.0), if rng.uniform(0.0, 1.0) < 0.5 { 5.5 } else { -5.5 }, 1.7);
        let ahead = Vector3::new(
            if rng.uniform(0.0, 1.0) < 0.5 { 30.0 } else { -30.0 },
            rng.uniform(-12.0, 12.0),
            0.0,
        );
        ViewRequest::from(Camera::looking_at(eye, eye + ahead, intrinsics))
    };
    Ok((0..count).map(one).collect())
}
