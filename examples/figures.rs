//! Every figure that the project claims, measured here and now.
//!
//! ```sh
//! cargo run --release --example figures
//! ```

use std::sync::Arc;

use clap::Parser;
use simworld_citygen::{City, CityConfig};
use simworld_core::net::{NetworkConfig, RoadNetwork, StreetPlan};
use simworld_core::seed::Seed;
use simworld_examples::delivery::{RunConfig, Watch, make_city, run_seed};
use simworld_examples::timing::timed;
use simworld_traffic::{Traffic, TrafficConfig};

/// Measures the figures that the project claims and prints them beside their bars.
#[derive(Parser)]
struct Arguments {
    /// Steps of the delivery run.
    #[arg(long, default_value_t = 5000)]
    steps: u64,
}

/// CPU time of the Python release for 40 roads with buildings, s: measured in 2026-11 on two cores.
const PYTHON_CITY: f64 = 5.7;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments = Arguments::parse();
    delivery(arguments.steps)?;
    city()?;
    traffic()?;
    Ok(())
}

fn delivery(steps: u64) -> Result<(), Box<dyn std::error::Error>> {
    let config = RunConfig { steps, frames: 0, ..RunConfig::default() };
    let (city, _) = make_city(&config)?;
    let (results, time) = timed(|| {
        (0..3)
            .map(|n| run_seed(&config, &city, Seed(1 + n), None, None, &Watch::silent()))
            .collect::<Result<Vec<_>, _>>()
    });
    results?;
    let each = time.as_secs_f64() / (3.0 * steps as f64) * 1e6;
    println!(
        "main job, three seeds of {steps} steps one after the other: {time:.2?} ({each:.0} µs a step); bar: 60 s"
    );
    if let Some(peak) = peak_memory() {
        println!("memory at its peak: {:.0} MB; bar: 500 MB", peak / 1e6);
    }
    Ok(())
}

/// The greatest resident set so far, bytes; Linux only.
fn peak_memory() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    let kilobytes: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(kilobytes * 1024.0)
}

fn city() -> Result<(), Box<dyn std::error::Error>> {
    let seeds = 100;
    let (cities, time) = timed(|| {
        (0..seeds)
            .map(|seed| City::generate(&CityConfig::default(), Seed(seed)))
            .collect::<Result<Vec<_>, _>>()
    });
    let buildings: usize = cities?.iter().map(|city| city.buildings.len()).sum();
    let each = time.as_secs_f64() / seeds as f64;
    println!(
        "city of 40 roads: {:.2} ms ({} buildings a city), {:.0} times as fast as the Python release; bar: 1000",
        each * 1e3,
        buildings / seeds as usize,
        PYTHON_CITY / each
    );
    let (city, time) = timed(|| City::generate(&CityConfig::with_roads(10_000), Seed(1)));
    println!("city of 10,000 roads: {time:.2?}, {} buildings", city?.buildings.len());
    Ok(())
}

fn traffic() -> Result<(), Box<dyn std::error::Error>> {
    let network = Arc::new(RoadNetwork::derive(&StreetPlan::grid(42, 42, 200.0), &NetworkConfig::default())?);
    let config = TrafficConfig { vehicles: 10_000, pedestrians: 0, ..TrafficConfig::default() };
    let mut traffic = Traffic::new(network, &config, Seed(1))?;
    for _ in 0..200 {
        traffic.step(0.1); // until everybody is under way
    }
    let before = traffic.counters().updates;
    let ((), time) = timed(|| {
        for _ in 0..300 {
            traffic.step(0.1);
        }
    });
    let rate = (traffic.counters().updates - before) as f64 / time.as_secs_f64();
    println!(
        "traffic of {} vehicles: {:.1} M vehicle updates/s on one core; bar: 1 M",
        traffic.placed().vehicles,
        rate / 1e6
    );
    Ok(())
}
