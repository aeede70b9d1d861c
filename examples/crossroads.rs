//! Traffic alone: a hand-written crossroads, drawn as letters, with what passed in ten minutes.
//!
//! ```sh
//! cargo run --release --example crossroads
//! ```

use std::process::ExitCode;
use std::sync::Arc;

use clap::Parser;
use simworld_core::net::{NetworkConfig, RoadNetwork, StreetPlan};
use simworld_core::seed::Seed;
use simworld_examples::exit_code;
use simworld_traffic::{Traffic, TrafficConfig};

/// Runs the traffic of one crossroads and draws it.
#[derive(Parser)]
struct Arguments {
    /// Seed of the traffic.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Vehicles to place.
    #[arg(long, default_value_t = 24)]
    vehicles: u32,
    /// Pedestrians to place.
    #[arg(long, default_value_t = 30)]
    pedestrians: u32,
    /// Simulated time, s.
    #[arg(long, default_value_t = 600.0)]
    seconds: f64,
}

/// Columns and rows of the drawing, and metres a column.
const SIZE: (usize, usize, f64) = (77, 37, 2.1);

fn main() -> ExitCode {
    exit_code(job(&Arguments::parse()))
}

fn job(arguments: &Arguments) -> Result<(), Box<dyn std::error::Error>> {
    let network = Arc::new(RoadNetwork::derive(&StreetPlan::crossroads(90.0), &NetworkConfig::default())?);
    let (vehicles, pedestrians) = (arguments.vehicles, arguments.pedestrians);
    let config = TrafficConfig { vehicles, pedestrians, ..TrafficConfig::default() };
    let mut traffic = Traffic::new(network, &config, Seed(arguments.seed))?;
    let placed = traffic.placed();
    println!("placed {} of {vehicles} vehicles and {} pedestrians", placed.vehicles, placed.pedestrians);
    if !(arguments.seconds > 0.0 && arguments.seconds <= 1e7) {
        return Err(format!(
            "--seconds {} is out of range: give more than 0, at most 1e7",
            arguments.seconds
        )
        .into());
    }
    for _ in 0..(arguments.seconds / 0.1).round() as u64 {
        traffic.step(0.1);
    }
    println!("{}", draw(&traffic));
    let counters = traffic.counters();
    println!(
        "{} vehicles crossed; red lights passed because nobody could stop: {}",
        counters.crossings, counters.dilemmas
    );
    Ok(())
}

/// Seen from above, north up: lanes as dots, vehicles as heads, walkers as o.
fn draw(traffic: &Traffic) -> String {
    let (columns, rows, metres) = SIZE;
    let mut picture = vec![vec![' '; columns]; rows];
    let mut put = |x: f64, y: f64, letter: char| {
        // A letter is about twice as high as it is wide.
        let column = (x / metres + columns as f64 * 0.5).floor();
        let row = (rows as f64 * 0.5 - y / (2.0 * metres)).floor();
        if (0.0..columns as f64).contains(&column) && (0.0..rows as f64).contains(&row) {
            picture[row as usize][column as usize] = letter;
        }
    };
    for lane in &traffic.network().lanes {
        for step in 0..(lane.length / metres) as u32 {
            let (point, _) = simworld_core::net::polyline::at(&lane.path, f64::from(step) * metres);
            put(point.x, point.y, '.');
        }
    }
    for walker in traffic.pedestrians() {
        put(walker.position.x, walker.position.y, 'o');
    }
    for body in traffic.vehicles() {
        let yaw = simworld_core::geometry::yaw_of(&body.pose);
        let heads = ['>', '^', '<', 'v'];
        let quarter = (yaw / std::f64::consts::FRAC_PI_2).round().rem_euclid(4.0) as usize;
        put(body.pose.translation.x, body.pose.translation.y, heads[quarter % 4]);
    }
    let lines: Vec<String> = picture.into_iter().map(|row| row.into_iter().collect::<String>()).collect();
    lines.join("\n")
}
