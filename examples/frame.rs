//! Render, fed by a generated city: a street to PNG, with depth and classes beside it.
//!
//! ```sh
//! cargo run --release --example frame -- --out out/frame
//! ```

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use simworld_citygen::{City, CityConfig};
use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::{Point3, direction};
use simworld_core::net::polyline;
use simworld_core::scene::World;
use simworld_core::seam::Dynamics;
use simworld_core::seed::Seed;
use simworld_examples::exit_code;
use simworld_render::{Frame, RenderConfig, Renderer};
use simworld_traffic::{TrafficConfig, TrafficDynamics};

/// Renders a street of a generated city: colour, depth and classes.
#[derive(Parser)]
struct Arguments {
    /// Seed of the city.
    #[arg(long, default_value_t = 7)]
    seed: u64,
    /// Pixels across.
    #[arg(long, default_value_t = 1280)]
    width: u32,
    /// Pixels down.
    #[arg(long, default_value_t = 720)]
    height: u32,
    /// The road to stand on.
    #[arg(long, default_value_t = 0)]
    road: usize,
    /// Height of the camera, m.
    #[arg(long, default_value_t = 5.5)]
    eye: f64,
    /// The folder to write to.
    #[arg(long, default_value = "out/frame")]
    out: PathBuf,
}

fn main() -> ExitCode {
    exit_code(job(&Arguments::parse()))
}

fn job(arguments: &Arguments) -> Result<(), Box<dyn std::error::Error>> {
    let city = City::generate(&CityConfig::default(), Seed(arguments.seed))?;
    let mut world = World::new();
    city.populate(&mut world)?;
    let config = TrafficConfig { vehicles: 60, pedestrians: 160, ..TrafficConfig::default() };
    let mut traffic = TrafficDynamics::new(&mut world, &config, Seed(arguments.seed))?;
    for _ in 0..300 {
        traffic.step(&mut world, 0.1)?;
        world.finish_step();
    }
    let roads = &city.network.roads;
    let road = roads.get(arguments.road).ok_or_else(|| {
        format!(
            "there is no road {}: this city has {} (give --road 0 to {})",
            arguments.road,
            roads.len(),
            roads.len() - 1
        )
    })?;
    let (start, heading) = polyline::at(&road.centerline, 10.0);
    let right = direction(heading - 1.571) * 1.2;
    let eye = Point3::new(start.x + right.x, start.y + right.y, arguments.eye);
    let ahead = direction(heading - 0.03) * 40.0;
    let target = Point3::new(eye.x + ahead.x, eye.y + ahead.y, 2.8);
    let intrinsics = Intrinsics::from_fov(arguments.width, arguments.height, 1.25)?;
    let mut renderer = Renderer::new(&RenderConfig::default())?;
    let mut frame = Frame::new();
    renderer.render(&world, &Camera::looking_at(eye, target, intrinsics), &mut frame)?;
    simworld_examples::folder::make_folder(&arguments.out)?;
    frame.write_png(arguments.out.join("rgb.png"))?;
    std::fs::write(arguments.out.join("depth.png"), frame.depth_png()?)?;
    std::fs::write(arguments.out.join("classes.png"), frame.classes_png()?)?;
    println!("drawn on {}; written to {}", renderer.adapter(), arguments.out.display());
    Ok(())
}
