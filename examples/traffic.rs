//! Traffic alone: an hour of a city, its figures, and pictures that an engineer would print.
//!
//! ```sh
//! cargo run --release --example traffic
//! cargo run --release --example traffic -- --city out/city/city.simcity --vehicles 5000 --pedestrians 5000 --hours 1
//! ```

use std::fs;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;
use std::time::Duration;

use clap::{Parser, ValueEnum};
use indicatif::{HumanBytes, ProgressBar, ProgressStyle};
use simworld_citygen::Style;
use simworld_core::seed::Seed;
use simworld_examples::city::{Size, Source, make};
use simworld_examples::exit_code;
use simworld_examples::traffic::{Watched, pictures, report};
use simworld_traffic::signal::{Actuated, FixedTime, MaxPressure, SelfOrganizing, SignalPolicy};
use simworld_traffic::{Traffic, TrafficConfig};

/// Lets vehicles and people go about a city, tells how it went, and draws it.
///
/// Pictures are SVG: maps of density, speed and flow, the fundamental diagram, the time-space diagram of a street, junctions
/// by level of service, and a film of the busiest junction that plays in a browser. The same settings and seed give the same
/// pictures, byte for byte.
#[derive(Parser)]
#[command(version)]
struct Arguments {
    /// A saved city, as `--example city` writes it; otherwise one is grown.
    #[arg(long, value_name = "FILE.simcity")]
    city: Option<PathBuf>,
    /// How far a grown city reaches from one side to the other.
    #[arg(long, default_value = "1.5km")]
    size: Size,
    /// Seed of the traffic, and of a grown city.
    #[arg(long, default_value_t = 7)]
    seed: u64,
    /// Vehicles.
    #[arg(long, default_value_t = 1000)]
    vehicles: u32,
    /// People on foot.
    #[arg(long, default_value_t = 1000)]
    pedestrians: u32,
    /// How long, hours.
    #[arg(long, default_value_t = 0.5)]
    hours: f64,
    /// Step of the simulation, s, in [0.01, 0.5].
    #[arg(long, default_value_t = 0.1)]
    step: f64,
    /// Who chooses the stages of the signals.
    #[arg(long, value_enum, default_value_t = Policy::Actuated)]
    policy: Policy,
    /// The folder to write to; pictures there are replaced.
    #[arg(long, value_name = "DIR", default_value = "out/traffic")]
    out: PathBuf,
}

/// A policy of the signals.
#[derive(Clone, Copy, ValueEnum)]
enum Policy {
    /// The plans of the city by the clock.
    Fixed,
    /// A green goes on while vehicles keep coming.
    Actuated,
    /// Green to the greatest pressure.
    MaxPressure,
    /// A red ends when enough have waited.
    SelfOrganizing,
}

impl Policy {
    fn boxed(self) -> Box<dyn SignalPolicy + Send> {
        match self {
            Self::Fixed => Box::new(FixedTime),
            Self::Actuated => Box::new(Actuated::default()),
            Self::MaxPressure => Box::new(MaxPressure::default()),
            Self::SelfOrganizing => Box::new(SelfOrganizing::default()),
        }
    }
}

type Fault = Box<dyn std::error::Error>;

fn main() -> ExitCode {
    exit_code(job(&Arguments::parse()))
}

fn job(arguments: &Arguments) -> Result<(), Fault> {
    if !(0.001..=1000.0).contains(&arguments.hours) {
        return Err(format!("--hours {}: give 0.001 to 1000", arguments.hours).into());
    }
    if !(0.01..=0.5).contains(&arguments.step) {
        return Err(format!("--step {}: give 0.01 to 0.5 s", arguments.step).into());
    }
    let grown = Source::Grown(Style::Mixed, arguments.size);
    let source = arguments.city.clone().map_or(grown, Source::Saved);
    let bar = ProgressBar::new_spinner();
    bar.enable_steady_tick(Duration::from_millis(100));
    bar.set_message("making the city");
    let city = make(&source, Seed(arguments.seed))?.city;
    bar.finish_and_clear();

    let config = TrafficConfig {
        vehicles: arguments.vehicles,
        pedestrians: arguments.pedestrians,
        ..TrafficConfig::default()
    };
    let mut traffic = Traffic::new(Arc::clone(&city.network), &config, Seed(arguments.seed))?;
    traffic.set_policy(arguments.policy.boxed());
    let placed = traffic.placed();
    println!(
        "{} roads, {} signals; {} of {} vehicles and {} of {} people found a place",
        city.network.roads.len(),
        city.network.signals.len(),
        placed.vehicles,
        arguments.vehicles,
        placed.pedestrians,
        arguments.pedestrians
    );
    let watched = run(&mut traffic, arguments)?;
    println!("{}", report(&traffic, &watched));
    simworld_examples::folder::make_folder(&arguments.out)?;
    for picture in pictures(&traffic, &watched) {
        let path = arguments.out.join(picture.name);
        fs::write(&path, &picture.svg)?;
        println!("{:>10}  {}", HumanBytes(picture.svg.len() as u64).to_string(), path.display());
    }
    Ok(())
}

/// Runs the traffic, and shows how far it has come.
fn run(traffic: &mut Traffic, arguments: &Arguments) -> Result<Watched, Fault> {
    let seconds = arguments.hours * 3600.0;
    let steps = (seconds / arguments.step).ceil() as u64;
    let style = "{bar:30} {msg} of simulated time, {per_sec} steps, {eta} left";
    let bar = ProgressBar::new(steps).with_style(ProgressStyle::with_template(style)?);
    let mut watched = Watched::new(traffic, seconds);
    for step in 0..steps {
        traffic.step(arguments.step);
        watched.look(traffic, arguments.step);
        if step % 50 == 0 {
            bar.set_position(step);
            bar.set_message(format!("{:.0} min", traffic.seconds() / 60.0));
        }
    }
    bar.finish_and_clear();
    Ok(watched)
}
