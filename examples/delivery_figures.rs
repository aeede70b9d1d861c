//! The figures of the delivery economy, measured here and now.
//!
//! ```sh
//! cargo run --release --example delivery_figures
//! cargo run --release --example delivery_figures -- --only scale --couriers 20 --couriers 200
//! ```

use clap::{Parser, ValueEnum};
use rayon::prelude::*;
use simworld_agents::delivery::{CourierRow, DeliveryTask, PolicyKind};
use simworld_core::clock::Tick;
use simworld_core::scene::Scene;
use simworld_core::seed::Seed;
use simworld_examples::delivery::{
    Brain, EVERYWHERE, RunConfig, Thinkers, Watch, assemble, assemble_with, make_city, reader, run_seed,
};
use simworld_examples::experiment::{Preset, at_scale};
use simworld_examples::timing::timed;

/// Measures the delivery economy and prints its figures beside their bars.
#[derive(Parser)]
#[command(version)]
struct Arguments {
    /// Only these parts; without it all.
    #[arg(long, value_enum)]
    only: Vec<Part>,
    /// Numbers of couriers whose steps are compared, ascending [default: 20, 200 and 2000].
    #[arg(long, value_parser = clap::value_parser!(u32).range(1..=10_000))]
    couriers: Vec<u32>,
    /// Steps that are measured, after as many to get going.
    #[arg(long, default_value_t = 300, value_parser = clap::value_parser!(u64).range(1..))]
    steps: u64,
    /// Steps that are played with a model.
    #[arg(long, default_value_t = 5000, value_parser = clap::value_parser!(u64).range(1..))]
    model_steps: u64,
    /// Seeds of the competition.
    #[arg(long, default_value_t = 20, value_parser = clap::value_parser!(u32).range(1..=1000))]
    seeds: u32,
}

#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Part {
    /// Time for a courier and a step, for few and for many.
    Scale,
    /// Time for a step of the preset of ten thousand couriers.
    Preset,
    /// Time for a step of two hundred couriers with few and with many orders.
    Orders,
    /// What couriers ask of a model that answers in a second, in the main setting.
    Requests,
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
        let all = [20, 200, 2000];
        let couriers = if arguments.couriers.is_empty() { &all[..] } else { &arguments.couriers };
        for town in [Town::Grows, Town::OfTheLargest] {
            for bodies in [Bodies::All, Bodies::None] {
                scale(couriers, town, bodies, arguments.steps)?;
            }
        }
    }
    if wanted(Part::Preset) {
        let config = at_scale(&RunConfig::default(), 10_000);
        let step = measure_and_tell("the preset scale", &config, arguments.steps)?;
        println!("the preset scale: {:.2} times real time; bar: 1", 0.1 / step);
    }
    if wanted(Part::Orders) {
        let volumes = [20, 200, 2000];
        let steps: Vec<f64> =
            volumes.iter().map(|count| orders(*count, arguments.steps)).collect::<Result<_, _>>()?;
        growth("orders", &volumes, &steps);
    }
    if wanted(Part::Requests) {
        requests(arguments.model_steps)?;
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

/// In what city couriers of several numbers are compared.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Town {
    /// One as dense whatever their number.
    Grows,
    /// That of the greatest number for all.
    OfTheLargest,
}

/// Who has a body under physics; the others are points.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Bodies {
    All,
    None,
}

/// So many couriers, then more, with traffic in proportion: what a step takes, and how that grows. Like is compared with like: all of
/// them have bodies, or none has.
fn scale(couriers: &[u32], town: Town, bodies: Bodies, steps: u64) -> Result<(), Fault> {
    let largest = couriers.iter().copied().max().unwrap_or_default();
    let setting = format!(
        "{}, in {}",
        if bodies == Bodies::All { "all with bodies under physics" } else { "all points" },
        if town == Town::Grows { "a city that grows with them" } else { "the city of the most" }
    );
    let step = |count: &u32| {
        let mut config = at_scale(&RunConfig::default(), *count);
        config.physical_within = if bodies == Bodies::All { EVERYWHERE } else { 0.0 };
        if town == Town::OfTheLargest {
            config.city = at_scale(&RunConfig::default(), largest).city;
        }
        measure_and_tell(&setting, &config, steps)
    };
    let times: Vec<f64> = couriers.iter().map(step).collect::<Result<_, _>>()?;
    growth(&format!("couriers, {setting}"), couriers, &times);
    Ok(())
}

/// What a step of a run takes, s, and prints it.
fn measure_and_tell(what: &str, config: &RunConfig, steps: u64) -> Result<f64, Fault> {
    let config = RunConfig { steps: 2 * steps, ..config.clone() };
    let Measured { step, physical, did } = measure(&config, steps)?;
    println!(
        "{} couriers, {what} ({physical} with bodies at the start, {} streets, {} vehicles, {} pedestrians): {:.1} µs a courier \
         and step, {:.2} ms a step ({did})",
        config.agents,
        config.city.roads.count,
        config.vehicles,
        config.pedestrians,
        step * 1e6 / f64::from(config.agents),
        step * 1e3,
    );
    Ok(step)
}

/// Two hundred couriers and so many orders at the start, with as many to follow: what a step takes, s.
fn orders(count: u32, steps: u64) -> Result<f64, Fault> {
    let mut config = RunConfig { steps: 2 * steps, ..at_scale(&RunConfig::default(), 200) };
    let usual = config.delivery.orders.initial;
    config.delivery.orders.initial = count;
    config.delivery.orders.per_customer_hour *= f64::from(count) / f64::from(usual);
    let measured = measure(&config, steps)?;
    println!(
        "200 couriers, {count} orders at the start: {:.2} ms a step ({})",
        measured.step * 1e3,
        measured.did
    );
    Ok(measured.step)
}

/// What a step costs beyond the first of the sizes, for each more of them: constant where the cost is linear.
fn growth(what: &str, counts: &[u32], steps: &[f64]) {
    for (counts, steps) in counts.windows(2).zip(steps.windows(2)) {
        let (more, longer) = (f64::from(counts[1]) / f64::from(counts[0]), steps[1] / steps[0]);
        println!(
            "from {} to {} {what}: {more:.0} times as many, {longer:.1} times the time, {:.2} times for each; linear is at most \
             {more:.0}",
            counts[0],
            counts[1],
            longer / more
        );
    }
}

struct Measured {
    /// Mean time of a step, s.
    step: f64,
    physical: u32,
    did: String,
}

/// Steps once to get going, and as often again on the clock.
fn measure(config: &RunConfig, steps: u64) -> Result<Measured, Fault> {
    let (city, _) = make_city(config)?;
    let mut assembly = assemble(config, &city, Seed(config.seed))?;
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
    let task = assembly.episode.task();
    let did = format!("{} orders, {}", task.orders().len(), did(task));
    Ok(Measured { step: time.as_secs_f64() / steps as f64, physical, did })
}

/// The main setting with twenty couriers whose model takes a second of the simulation for each answer, beside as many that work as
/// it does without a model.
fn requests(steps: u64) -> Result<(), Fault> {
    let mut config = RunConfig { steps, frames: 0, policies: vec![Brain::Model], ..RunConfig::default() };
    config.model.thinking.latency = 1.0;
    let (city, _) = make_city(&config)?;
    let (mut requests, mut papers) = (0, 0);
    for seed in (0..u64::from(config.seeds)).map(|index| Seed(config.seed + index)) {
        let thinkers = Thinkers::with_backend(&config.model, seed, || Ok(reader()))?;
        let mut read = assemble_with(&config, &city, seed, Some(thinkers))?;
        let without = RunConfig { policies: vec![Brain::Policy(PolicyKind::ValueDensity)], ..config.clone() };
        let mut reckoned = assemble(&without, &city, seed)?;
        for assembly in [&mut read, &mut reckoned] {
            while !assembly.episode.is_over() {
                assembly.episode.step()?;
            }
        }
        let Some(usage) = read.thinkers.as_ref().map(|thinkers| thinkers.usage(steps)) else { continue };
        (requests, papers) = (requests + usage.requests, papers + usage.paper_requests);
        println!(
            "seed {}: couriers whose model reads its prompt {}; those of the same policy without {}",
            seed.0,
            did(read.episode.task()),
            did(reckoned.episode.task())
        );
    }
    println!(
        "a model that answers in 1 s, {} couriers, {steps} steps, {} seeds: {requests} requests of the paper's {papers}, \
         1/{:.1}; bar: 1/50",
        config.agents,
        config.seeds,
        papers as f64 / requests.max(1) as f64
    );
    Ok(())
}

/// What came of a run, in words.
fn did(task: &DeliveryTask) -> String {
    let Some(report) = task.report() else { return "nothing".to_owned() };
    let sum = |figure: fn(&CourierRow) -> f64| report.couriers.iter().map(figure).sum::<f64>();
    format!(
        "{} bids, {} won, {} delivered, {:.2} $ earned",
        sum(|row| f64::from(row.bids)),
        sum(|row| f64::from(row.won)),
        report.delivered,
        sum(|row| row.earned.dollars())
    )
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
