//! Every figure that is claimed of minds, measured here and now, beside its bar.
//!
//! ```sh
//! cargo run --release --example minds_figures
//! ```

use std::num::NonZeroUsize;
use std::process::ExitCode;
use std::sync::Arc;
use std::time::Duration;

use clap::{Parser, ValueEnum};
use comfy_table::Table;
use comfy_table::presets::UTF8_FULL_CONDENSED;
use simworld_agents::asynchronous::{AsynchronousConfig, AsynchronousEpisode, FreeMind, Pace};
use simworld_agents::episode::Episode;
use simworld_agents::gym::{VectorConfig, VectorEnv};
use simworld_agents::language::GrammarPlanner;
use simworld_agents::mind::Silent;
use simworld_agents::observer::{SceneGraph, SceneGraphObserver};
use simworld_core::event::EventKind;
use simworld_core::id::EntityId;
use simworld_core::intent::Intent;
use simworld_core::scene::Scene;
use simworld_core::seam::{EnvError, Observer, Options, Planner, SpaceValue};
use simworld_core::seed::Seed;
use simworld_examples::minds::{Bodies, Crowd, Dawdler, Promenade, SENTENCES, Speaker};
use simworld_examples::timing::{median, micros, timed};
use simworld_examples::wayfinding::{Field, Wayfinding};
use simworld_examples::{Outcome, exit_code};

/// Measures the figures of minds and prints each beside its bar.
#[derive(Parser)]
struct Arguments {
    /// Rule-driven agents in one city.
    #[arg(long, default_value_t = 1000)]
    agents: usize,
    /// Minds at their own pace.
    #[arg(long, default_value_t = 200)]
    minds: usize,
    /// Time that they are watched for, s.
    #[arg(long, default_value_t = 20.0)]
    seconds: f64,
    /// Small cities that are stepped together.
    #[arg(long, default_value_t = 16)]
    cities: usize,
    /// Only this part.
    #[arg(long)]
    only: Option<Part>,
}

/// A part of the figures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Part {
    /// Sentences and sight.
    Language,
    /// Many agents in one city.
    Crowd,
    /// What the driver itself takes.
    Driver,
    /// Many cities together.
    Cities,
    /// Minds in threads of their own.
    OwnPace,
}

fn main() -> ExitCode {
    exit_code(job(&Arguments::parse()))
}

fn job(arguments: &Arguments) -> Outcome<()> {
    let mut table = Table::new();
    table.load_style(UTF8_FULL_CONDENSED);
    table.set_header(["what", "measured", "bar"]);
    let wants = |part: Part| arguments.only.is_none_or(|only| only == part);
    if wants(Part::Language) {
        language(&mut table)?;
    }
    if wants(Part::Crowd) {
        crowd(arguments, &mut table)?;
    }
    if wants(Part::Driver) {
        driver(&mut table)?;
    }
    if wants(Part::Cities) {
        cities(arguments, &mut table)?;
    }
    if wants(Part::OwnPace) {
        own_pace(arguments, &mut table)?;
    }
    println!("{table}");
    Ok(())
}

fn language(table: &mut Table) -> Outcome<()> {
    let crowd = Crowd::new(100, 220, Bodies::None, Seed(1))?;
    let (world, me) = (crowd.simulation.world(), crowd.people[0]);
    let count = world.len();
    let mut times = Vec::new();
    let mut understood = 0;
    for words in SENTENCES {
        let intent = Intent::Words(words.to_owned());
        understood += usize::from(GrammarPlanner::default().plan(&intent, world, me).is_ok());
        times.push((median(101, || GrammarPlanner::default().plan(&intent, world, me)), words));
    }
    times.sort_unstable();
    let ((middle, _), (worst, _)) = (times[times.len() / 2], times[times.len() - 1]);
    for (time, words) in times {
        println!("{:>10}  {words}", micros(time));
    }
    table.add_row([
        format!(
            "a sentence to a plan among {count} entities, median of {} ({understood} planned)",
            SENTENCES.len()
        ),
        format!("{} (slowest {})", micros(middle), micros(worst)),
        "50 µs".to_owned(),
    ]);
    let mut graph = SceneGraph::default();
    for (name, mut observer) in [
        ("all round, 50 m", SceneGraphObserver::new(50.0)),
        (
            "120 degrees, occlusion, 50 m",
            SceneGraphObserver::new(50.0).with_field_of_view(2.094).with_occlusion(),
        ),
    ] {
        let people = &crowd.people;
        let mut next = 0;
        let time = median(501, || {
            next += 1;
            observer.observe(world, people[next % people.len()], &mut graph)
        });
        table.add_row([format!("a scene graph, {name}"), micros(time), "50 µs".to_owned()]);
    }
    Ok(())
}

fn crowd(arguments: &Arguments, table: &mut Table) -> Outcome<()> {
    let crowd = Crowd::new(arguments.agents, 120, Bodies::Physical, Seed(1))?;
    let bodies = crowd.bodies.clone();
    // Everybody says something every 10 s, and has said so before the time is taken.
    let mut episode = crowd.episode(|index| Speaker::new(index, 100))?;
    for _ in 0..100 {
        episode.step()?;
    }
    bodies.set(Duration::ZERO);
    let (mut planned, mut moving) = (0, 0);
    let (stepped, time) = timed(|| {
        (0..300).try_for_each(|_| {
            episode.step()?;
            planned += episode.events().iter().filter(|event| is_taken_up(&event.kind)).count();
            moving += on_the_move(&episode);
            Ok::<_, Box<dyn std::error::Error>>(())
        })
    });
    stepped?;
    let share = bodies.get().as_secs_f64() / time.as_secs_f64();
    table.add_row([
        format!(
            "{} agents plan, act and move at 10 Hz, among {} entities",
            arguments.agents,
            episode.simulation().world().len()
        ),
        format!(
            "{:.2} times real time ({:.0} % of it bodies); {planned} steps of plans begun, {:.0} % on the move",
            30.0 / time.as_secs_f64(),
            share * 100.0,
            moving as f64 / (300 * arguments.agents) as f64 * 100.0
        ),
        "1".to_owned(),
    ]);
    Ok(())
}

fn is_taken_up(kind: &EventKind) -> bool {
    matches!(kind, EventKind::StepBegun { .. })
}

/// How many agents move by now.
fn on_the_move(episode: &Episode<Promenade>) -> usize {
    /// Slower than this one stands, m/s.
    const STANDS: f64 = 0.1;
    let world = episode.simulation().world();
    let moves = |id: &&EntityId| world.entity(**id).is_some_and(|body| body.twist.ground_speed() > STANDS);
    episode.agents().iter().filter(moves).count()
}

fn driver(table: &mut Table) -> Outcome<()> {
    let agents = 1000;
    let mut episode = Crowd::new(agents, 60, Bodies::None, Seed(1))?.episode(|_| Silent)?;
    let time = median(301, || episode.step().is_ok());
    table.add_row([
        format!("the driver, {agents} agents that want nothing, an agent a step"),
        format!("{:.0} ns", time.as_secs_f64() * 1e9 / agents as f64),
        "1 µs".to_owned(),
    ]);
    Ok(())
}

fn cities(arguments: &Arguments, table: &mut Table) -> Outcome<()> {
    let field = Arc::new(Field::new(Seed(1))?);
    let vector = |threads: usize| -> Outcome<VectorEnv<_>> {
        let config = VectorConfig {
            threads: NonZeroUsize::new(threads).ok_or("no thread")?,
            ..VectorConfig::default()
        };
        let field = Arc::clone(&field);
        let make = move |_| {
            Wayfinding::new(Arc::clone(&field), 100).map_err(|error| EnvError::Simulation(error.to_string()))
        };
        let mut envs = VectorEnv::new(arguments.cities, config, make)?;
        envs.reset(Some(Seed(1)), &Options::new())?;
        Ok(envs)
    };
    // Both take the same steps in turns, so that a machine that is slower for a while is so for both.
    let (mut alone, mut together) = (vector(1)?, vector(2)?);
    let (mut one, mut two, mut ratios) = (Vec::new(), Vec::new(), Vec::new());
    for step in 0..96 {
        let actions = vec![SpaceValue::Discrete(step % 8); arguments.cities];
        let (stepped, time_alone) = timed(|| alone.step(actions.clone()));
        stepped?;
        let (stepped, time_together) = timed(|| together.step(actions));
        stepped?;
        one.push(time_alone.as_secs_f64());
        two.push(time_together.as_secs_f64());
        ratios.push(time_alone.as_secs_f64() / time_together.as_secs_f64());
    }
    table.add_row([
        format!("{} small cities with traffic, two threads against one", arguments.cities),
        format!(
            "{:.2} times ({:.1} ms to {:.1} ms a step), median of {}",
            middle(&mut ratios),
            middle(&mut one) * 1e3,
            middle(&mut two) * 1e3,
            ratios.len()
        ),
        "1.7".to_owned(),
    ]);
    Ok(())
}

/// The middle of some numbers, which are sorted for it.
fn middle(numbers: &mut [f64]) -> f64 {
    numbers.sort_by(f64::total_cmp);
    numbers[numbers.len() / 2]
}

fn own_pace(arguments: &Arguments, table: &mut Table) -> Outcome<()> {
    let crowd = Crowd::new(arguments.minds, 60, Bodies::Physical, Seed(1))?;
    let people = crowd.people.clone();
    let minds: Vec<(EntityId, FreeMind<Promenade>)> = people
        .iter()
        .map(|id| {
            let rng = Seed(1).stream("minds").indexed(u64::from(*id)).rng();
            (*id, Box::new(Dawdler::new(rng, Duration::from_secs(5))) as FreeMind<Promenade>)
        })
        .collect();
    let config = AsynchronousConfig {
        pace: Pace::RealTime { factor: 1.0 },
        patience: Duration::from_secs(6),
        ..AsynchronousConfig::default()
    };
    let episode = crowd.episode(|_| Silent)?;
    let mut run = AsynchronousEpisode::new(episode, minds, config, Promenade::clone)?;
    for _ in 0..(arguments.seconds * 10.0).round() as u64 {
        run.step()?;
    }
    let accounts = run.accounts();
    let (episode, ending) = run.finish();
    let recorded = episode.recording().commands.len() as u64;
    let ms = |time: Duration| time.as_secs_f64() * 1e3;
    table.add_row([
        format!(
            "{} minds that think 1 ms to 5 s: how late a tick begins, of {}",
            arguments.minds, ending.pace.ticks
        ),
        format!("at most {:.2} ms, mean {:.2} ms", ms(ending.pace.worst), ms(ending.pace.mean())),
        "5 ms".to_owned(),
    ]);
    let lost = accounts.handed_in() - accounts.applied() - accounts.late() - accounts.refused();
    let twice = recorded.saturating_sub(accounts.applied());
    table.add_row([
        format!("of {} intents: lost, used twice", accounts.handed_in()),
        format!("{lost}, {twice} ({} used, {} refused at the end)", accounts.applied(), accounts.refused()),
        "0, 0".to_owned(),
    ]);
    Ok(())
}
