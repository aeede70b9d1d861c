//! The figures of the delivery economy, measured here and now.
//!
//! ```sh
//! cargo run --release --example delivery_figures
//! cargo run --release --example delivery_figures -- --only scale --couriers 20 --couriers 200
//! ```

use std::time::{Duration, Instant};

use clap::{Parser, ValueEnum};
use rayon::prelude::*;
use simworld_core::clock::Tick;
use simworld_core::scene::Scene;
use simworld_core::seed::Seed;
use simworld_examples::delivery::{RunConfig, Watch, assemble, make_city, run_seed};
use simworld_examples::experiment::{Preset, at_scale};

/// Measures the delivery economy and prints its figures beside their bars.
#[derive(Parser)]
#[command(version)]
struct Arguments {
    /// Only these parts; without it all.
    #[arg(long, value_enum)]
    only: Vec<Part>,
    /// Numbers of couriers whose steps are compared [default: 20, 200, 2000 and 10000].
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    couriers: Vec<u32>,
    /// Steps that are measured, after as many to get going.
    #[arg(long, default_value_t = 300, value_parser = clap::value_parser!(u64).range(1..))]
    steps: u64,
    /// Seeds of the competition.
    #[arg(long, default_value_t = 20, value_parser = clap::value_parser!(u32).range(1..=1000))]
    seeds: u32,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Part {
    /// Time for a courier and a step, for few and for many.
    Scale,
    /// The main setting, three seeds with 200 vehicles and 400 pedestrians.
    Main,
    /// The competition.
    Competition,
}

type Fault = Box<dyn std::error::Error>;

fn main() -> Result<(), Fault> {
    let arguments = Arguments::parse();
    let wanted = |part| arguments.only.is_empty() || arguments.only.contains(&part);
    if wanted(Part::Scale) {
        let all = [20, 200, 2000, 10_000];
        let couriers = if arguments.couriers.is_empty() { &all[..] } else { &arguments.couriers };
        for count in couriers {
            scale(*count, arguments.steps)?;
        }
    }
    if wanted(Part::Main) {
        let config = RunConfig { vehicles: 200, pedestrians: 400, frames: 0, ..RunConfig::default() };
        seeds("main setting, three seeds of 5000 steps, 200 vehicles, 400 pedestrians", &config, 60.0)?;
    }
    if wanted(Part::Competition) {
        let base = RunConfig { seeds: arguments.seeds, frames: 0, ..RunConfig::default() };
        let arms = Preset::Competition.arms(&base);
        let name = format!("competition, {} seeds of 1000 steps", arguments.seeds);
        seeds(&name, &arms[0].config, 180.0)?;
    }
    Ok(())
}

#[expect(clippy::disallowed_methods, reason = "measuring is what this example is for")]
fn timed<T>(work: impl FnOnce() -> T) -> (T, Duration) {
    let start = Instant::now();
    let result = work();
    (result, start.elapsed())
}

/// Couriers in a city of their size, with traffic: what a step takes.
fn scale(couriers: u32, steps: u64) -> Result<(), Fault> {
    let config = RunConfig { steps: 2 * steps, ..at_scale(&RunConfig::default(), couriers) };
    let (city, _) = make_city(&config)?;
    let mut assembly = assemble(&config, &city, Seed(config.seed))?;
    let physical = assembly.physical;
    let mut run = |to: u64| -> Result<(), Fault> {
        while assembly.episode.simulation().world().clock().tick() < Tick(to) {
            assembly.episode.step()?;
        }
        Ok(assembly.episode.task().audit()?)
    };
    run(steps)?;
    let (done, time) = timed(|| run(2 * steps));
    done?;
    let report = assembly.episode.task().report();
    let (bids, delivered) = report
        .map_or((0, 0), |report| (report.couriers.iter().map(|row| row.bids).sum::<u32>(), report.delivered));
    let step = time.as_secs_f64() / steps as f64;
    let bar = if couriers == 10_000 { "; bar: 1" } else { "" };
    println!(
        "{couriers} couriers ({physical} with bodies under physics at the start), {} people: {:.1} µs a courier and step, {:.2} \
         ms a step, {:.1} times real time{bar} ({} orders, {bids} bids, {delivered} delivered)",
        config.delivery.orders.customers,
        step * 1e6 / f64::from(couriers),
        step * 1e3,
        0.1 / step,
        assembly.episode.task().orders().len(),
    );
    Ok(())
}

/// All seeds of a setting on all threads.
fn seeds(name: &str, config: &RunConfig, bar: f64) -> Result<(), Fault> {
    let (city, _) = make_city(config)?;
    let all: Vec<u64> = (0..u64::from(config.seeds)).map(|index| config.seed + index).collect();
    let (results, time) = timed(|| {
        let run = |seed: &u64| run_seed(config, &city, Seed(*seed), None, None, &Watch::silent());
        all.par_iter().map(run).collect::<Result<Vec<_>, _>>()
    });
    let delivered: f64 =
        results?.iter().filter_map(|run| Some(f64::from(run.couriers.as_ref()?.delivered))).sum();
    println!("{name}: {time:.2?}, {delivered} delivered; bar: {bar} s");
    Ok(())
}
