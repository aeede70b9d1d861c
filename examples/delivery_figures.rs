//! The figures of the delivery economy, measured here and now.
//!
//! ```sh
//! cargo run --release --example delivery_figures
//! cargo run --release --example delivery_figures -- --only scale --couriers 20 --couriers 200
//! ```

use clap::{Parser, ValueEnum};
use rayon::prelude::*;
use serde_json::json;
use simworld_agents::model::{ChatModel, ChatReply, ChatRequest, Part as Content, Scripted};
use simworld_core::clock::Tick;
use simworld_core::scene::Scene;
use simworld_core::seed::Seed;
use simworld_examples::delivery::{
    Brain, RunConfig, Thinkers, Watch, assemble, assemble_with, make_city, run_seed,
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
    /// Numbers of couriers whose steps are compared [default: 20, 200, 2000 and 10000].
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
        let all = [20, 200, 2000, 10_000];
        let couriers = if arguments.couriers.is_empty() { &all[..] } else { &arguments.couriers };
        let steps: Vec<f64> =
            couriers.iter().map(|count| scale(*count, arguments.steps)).collect::<Result<_, _>>()?;
        growth("couriers", couriers, &steps);
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

/// Couriers in a city of their size, with traffic: what a step takes, s.
fn scale(couriers: u32, steps: u64) -> Result<f64, Fault> {
    let config = RunConfig { steps: 2 * steps, ..at_scale(&RunConfig::default(), couriers) };
    let measured = measure(&config, steps)?;
    let bar = if couriers == 10_000 { "; bar: 1" } else { "" };
    println!(
        "{couriers} couriers ({} with bodies under physics at the start), {} people: {:.1} µs a courier and step, {:.2} ms a \
         step, {:.1} times real time{bar} ({})",
        measured.physical,
        config.delivery.orders.customers,
        measured.step * 1e6 / f64::from(couriers),
        measured.step * 1e3,
        0.1 / measured.step,
        measured.did
    );
    Ok(measured.step)
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
            "from {} to {} {what}: {more:.0} times as many, {longer:.1} times the time; linear is at most {more:.0}",
            counts[0], counts[1]
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
    let report = assembly.episode.task().report();
    let (bids, delivered) = report
        .map_or((0, 0), |report| (report.couriers.iter().map(|row| row.bids).sum::<u32>(), report.delivered));
    let orders = assembly.episode.task().orders().len();
    let did = format!("{orders} orders, {bids} bids, {delivered} delivered");
    Ok(Measured { step: time.as_secs_f64() / steps as f64, physical, did })
}

/// The main setting with twenty couriers whose model takes a second of the simulation for each answer.
fn requests(steps: u64) -> Result<(), Fault> {
    let mut config = RunConfig { steps, frames: 0, policies: vec![Brain::Model], ..RunConfig::default() };
    config.model.thinking.latency = 1.0;
    let (city, _) = make_city(&config)?;
    let model = || Ok(Box::new(Scripted::rule(|request| Ok(busy(request)))) as Box<dyn ChatModel>);
    let thinkers = Thinkers::with_backend(&config.model, Seed(config.seed), model)?;
    let mut assembly = assemble_with(&config, &city, Seed(config.seed), Some(thinkers))?;
    while !assembly.episode.is_over() {
        assembly.episode.step()?;
    }
    let Some(usage) = assembly.thinkers.as_ref().map(|thinkers| thinkers.usage(steps)) else { return Ok(()) };
    let report = assembly.episode.task().report();
    let (bids, delivered) = report
        .map_or((0, 0), |report| (report.couriers.iter().map(|row| row.bids).sum::<u32>(), report.delivered));
    println!(
        "a model that answers in 1 s, {} couriers, {steps} steps: {} requests of the paper's {}, 1/{:.1}; bar: 1/50 ({bids} \
         bids, {delivered} delivered)",
        usage.couriers,
        usage.requests,
        usage.paper_requests,
        usage.paper_requests as f64 / usage.requests.max(1) as f64
    );
    Ok(())
}

/// A model that works: it goes where it is going, delivers before it fetches, fetches before it bids, and bids two thirds of what
/// is offered.
fn busy(request: &ChatRequest) -> ChatReply {
    let Some(schema) = request.schema.as_ref().filter(|schema| schema.name != "thought") else {
        return ChatReply::of(r#"{"thought": "There is work to do."}"#);
    };
    let deed = &schema.json["properties"]["deed"];
    let branches = deed["anyOf"].as_array().map_or(std::slice::from_ref(deed), Vec::as_slice);
    let find = |act: &str| branches.iter().find(|branch| branch["properties"]["act"]["enum"][0] == act);
    let goes = request.messages[1]
        .content
        .iter()
        .any(|part| matches!(part, Content::Text(text) if text.contains("on the way to")));
    let acts: &[&str] = if goes { &["bid_order"] } else { &["deliver_order", "pick_up_order", "bid_order"] };
    let chosen = acts.iter().find_map(|act| Some((*act, find(act)?)));
    let deed = match chosen {
        Some((act, branch)) => {
            let fields = &branch["properties"];
            let mut deed = json!({ "act": act, "order": fields["order"]["enum"][0] });
            if let Some(most) = fields["cents"]["maximum"].as_i64() {
                deed["cents"] = json!((most * 2 / 3).max(1));
            }
            deed
        }
        None => json!({ "act": "do_nothing" }),
    };
    ChatReply::of(json!({ "because": "it pays", "deed": deed }).to_string())
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
