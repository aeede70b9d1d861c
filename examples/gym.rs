//! Somebody learns to find a door among the things of a generated block, by the Gym interface: with a real body, from nothing
//! but rewards.
//!
//! ```sh
//! cargo run --release --example gym
//! ```

use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;
use std::time::Instant;

use clap::Parser;
use comfy_table::Table;
use comfy_table::presets::UTF8_FULL_CONDENSED;
use indicatif::{ProgressBar, ProgressStyle};
use simworld_agents::gym::{EnvExt, VectorConfig, VectorEnv};
use simworld_core::seam::EnvError;
use simworld_core::seed::Seed;
use simworld_examples::wayfinding::{Field, Many, Policy, Run, Wayfinding, curve_chart, judge, learn};
use simworld_examples::{Outcome, exit_code};

/// Learns a table of headings by Q-learning, beside a policy of chance, and draws how the reward grows.
#[derive(Parser)]
struct Arguments {
    /// Directory for the picture.
    #[arg(long, default_value = "out/gym")]
    out: PathBuf,
    /// How many seeds are learnt with, one after the other.
    #[arg(long, default_value_t = 2)]
    seeds: u64,
    /// Steps of all environments together, for each seed.
    #[arg(long, default_value = "12000")]
    steps: NonZeroUsize,
    /// Environments that are stepped together.
    #[arg(long, default_value = "8")]
    environments: NonZeroUsize,
    /// Threads that step them; no result depends on it.
    #[arg(long, default_value = "2")]
    threads: NonZeroUsize,
    /// Steps after which an episode is truncated.
    #[arg(long, default_value_t = 60)]
    limit: u64,
    /// Seed of the city.
    #[arg(long, default_value_t = 1)]
    city: u64,
    /// Vehicles, and as many people, that are about.
    #[arg(long, default_value_t = 0)]
    traffic: u32,
}

/// Episodes that a policy is judged by.
const JUDGED: usize = 200;
/// Points of a curve.
const POINTS: usize = 20;

fn main() -> ExitCode {
    exit_code(job(&Arguments::parse()))
}

#[expect(clippy::disallowed_methods, reason = "says how long learning took")]
fn job(arguments: &Arguments) -> Outcome<()> {
    simworld_examples::folder::make_folder(&arguments.out)?;
    let field = Arc::new(Field::new(Seed(arguments.city))?);
    println!(
        "a block of 40 m by 40 m: {} of 256 cells have something in them, {} to begin in",
        field.blocked(),
        field.starts().len()
    );
    let mut table = Table::new();
    table.load_style(UTF8_FULL_CONDENSED);
    table.set_header(["seed", "policy", "mean reward", "door found", "steps an episode", "learnt in"]);
    let (mut runs, mut drawing) = (Vec::new(), String::new());
    for seed in 0..arguments.seeds {
        let mut envs = environments(arguments, &field)?;
        let start = Instant::now();
        let bar = ProgressBar::new(arguments.steps.get() as u64).with_message(format!("seed {seed}"));
        bar.set_style(ProgressStyle::with_template("{msg} [{bar:40}] {pos}/{len} steps {elapsed}")?);
        let tell = |done| bar.set_position(done as u64);
        let lesson = learn(&mut envs, arguments.steps.get(), POINTS, Seed(seed), tell)?;
        let time = start.elapsed();
        bar.finish_and_clear();
        for (name, policy, time) in [
            ("chance", Policy::Random, String::new()),
            ("learnt", Policy::Learnt(&lesson.table), format!("{:.1} s", time.as_secs_f64())),
        ] {
            let judged = judge(&mut envs, policy, JUDGED, Seed(seed))?;
            table.add_row([
                seed.to_string(),
                name.to_owned(),
                format!("{:.3}", judged.mean),
                format!("{:.0} %", judged.found * 100.0),
                format!("{:.1}", judged.length),
                time,
            ]);
            if name == "chance" {
                runs.push(Run { seed, curve: lesson.curve.clone(), chance: judged.mean });
            }
        }
        drawing = field.drawing(|cell| lesson.table.best(cell));
    }
    println!("{table}\nthe last table, north up:\n{drawing}");
    let path = arguments.out.join("reward.svg");
    std::fs::write(&path, curve_chart(&runs))?;
    println!("how the reward grows: {}", path.display());
    Ok(())
}

fn environments(arguments: &Arguments, field: &Arc<Field>) -> Outcome<Many> {
    let config = VectorConfig { threads: arguments.threads, ..VectorConfig::default() };
    let (field, traffic, limit) = (Arc::clone(field), arguments.traffic, arguments.limit);
    let make = move |_| {
        let env = Wayfinding::new(Arc::clone(&field), traffic);
        env.map_err(|error| EnvError::Simulation(error.to_string()))?.time_limit(limit)
    };
    Ok(VectorEnv::new(arguments.environments.get(), config, make)?)
}
