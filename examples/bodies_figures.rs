//! Every figure that is claimed of what bodies cost, measured here and now, beside its bar and beside the engine alone.
//!
//! ```sh
//! cargo run --release --example bodies_figures
//! ```

use std::process::ExitCode;
use std::time::Duration;

use clap::{Parser, ValueEnum};
use comfy_table::Table;
use comfy_table::presets::UTF8_FULL_CONDENSED;
use simworld_core::geometry::Point3;
use simworld_core::scene::World;
use simworld_core::seam::Dynamics;
use simworld_examples::bodies::{
    BUILDINGS, Crowd, PlainWalkers, Quarter, SOLIDS, Threads, our_boxes, our_step, our_walkers, plain_boxes,
};
use simworld_examples::exit_code;
use simworld_examples::timing::timed;
use simworld_physics::PhysicsDynamics;
use simworld_physics::proving::{Fleet, Pack, ProvingError};
use simworld_physics::rapier::prelude::PhysicsWorld;

/// Measures what bodies cost and prints each figure beside its bar.
#[derive(Parser)]
struct Arguments {
    /// Every number of bodies, blocks and steps is this share of what the bar is for.
    #[arg(long, default_value_t = 1.0)]
    share: f64,
    /// Only this part.
    #[arg(long)]
    only: Option<Part>,
}

/// A part of the figures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Part {
    /// The same bodies with and without us.
    Overhead,
    /// A city of a million fixed solids, and cities of several sizes.
    City,
    /// People on foot.
    People,
    /// Cars on tyres.
    Cars,
    /// People, dogs and cars, near and far.
    Mixed,
    /// Robot dogs.
    Dogs,
    /// Saving and taking up.
    Snapshots,
}

fn main() -> ExitCode {
    exit_code(job(&Arguments::parse()))
}

type Rows = Vec<[String; 3]>;

fn job(arguments: &Arguments) -> Result<(), ProvingError> {
    type Measure = fn(f64, &mut Rows) -> Result<(), ProvingError>;
    let share = if (1e-4..=1.0).contains(&arguments.share) { arguments.share } else { 1.0 };
    let parts: [(Part, Measure); 7] = [
        (Part::Overhead, overhead),
        (Part::City, city),
        (Part::People, people),
        (Part::Cars, cars),
        (Part::Mixed, mixed),
        (Part::Dogs, dogs),
        (Part::Snapshots, snapshots),
    ];
    let mut rows = Rows::new();
    for (part, measure) in parts {
        if arguments.only.is_none_or(|only| only == part) {
            eprintln!("{part:?} ...");
            measure(share, &mut rows)?;
        }
    }
    let mut table = Table::new();
    table.load_style(UTF8_FULL_CONDENSED);
    table.set_header(["what", "measured", "bar"]);
    table.add_rows(rows);
    println!("{table}");
    Ok(())
}

/// A number of things, by the share that is measured.
fn some(of: usize, share: f64) -> usize {
    ((of as f64 * share).round() as usize).max(1)
}

fn ms(time: Duration) -> f64 {
    time.as_secs_f64() * 1e3
}

/// What all threads have taken of the processors so far, s; Linux only. It does not count what others do on the same machine.
fn processor_time() -> Option<f64> {
    let tasks = std::fs::read_dir("/proc/self/task").ok()?;
    let taken = tasks.flatten().filter_map(|task| {
        let line = std::fs::read_to_string(task.path().join("schedstat")).ok()?;
        line.split_whitespace().next()?.parse::<f64>().ok()
    });
    Some(taken.sum::<f64>() * 1e-9)
}

/// What a step takes, ms.
#[derive(Clone, Copy, Debug)]
struct Cost {
    /// By the clock.
    clock: f64,
    /// Of the processors; by the clock where that is not known.
    processor: f64,
}

impl Cost {
    const NONE: Self = Self { clock: f64::INFINITY, processor: f64::INFINITY };

    fn least(self, other: Self) -> Self {
        Self { clock: self.clock.min(other.clock), processor: self.processor.min(other.processor) }
    }
}

/// What some work takes in the mean of so many steps.
fn cost(steps: usize, work: impl FnOnce() -> Result<(), ProvingError>) -> Result<Cost, ProvingError> {
    let before = processor_time();
    let (done, time) = timed(work);
    done?;
    let taken = before.zip(processor_time()).map(|(before, after)| (after - before) * 1e3);
    let clock = ms(time);
    Ok(Cost { clock: clock / steps as f64, processor: taken.unwrap_or(clock) / steps as f64 })
}

/// The least mean cost of a step in several runs of some steps: what the machine does when it does nothing else.
fn per_step(
    runs: usize,
    steps: usize,
    mut step: impl FnMut() -> Result<(), ProvingError>,
) -> Result<Cost, ProvingError> {
    (0..runs)
        .try_fold(Cost::NONE, |best, _| Ok(best.least(cost(steps, || (0..steps).try_for_each(|_| step()))?)))
}

/// The least processor times of a step of two things that are made anew and done in turns, over their first steps, ms.
fn in_turns<A, B>(
    steps: usize,
    ours: &(impl Fn() -> Result<A, ProvingError>, impl Fn(&mut A) -> Result<(), ProvingError>),
    plain: &(impl Fn() -> B, impl Fn(&mut B)),
) -> Result<[f64; 2], ProvingError> {
    let mut best = [Cost::NONE; 2];
    for _ in 0..4 {
        let mut one = ours.0()?;
        best[0] = best[0].least(cost(steps, || (0..steps).try_for_each(|_| ours.1(&mut one)))?);
        let mut other = plain.0();
        best[1] = best[1].least(cost(steps, || {
            (0..steps).for_each(|_| plain.1(&mut other));
            Ok(())
        })?);
    }
    Ok(best.map(|cost| cost.processor))
}

fn overhead(share: f64, rows: &mut Rows) -> Result<(), ProvingError> {
    let count = some(1000, share);
    let boxes = || our_boxes(count);
    let step = |(world, physics): &mut (World, PhysicsDynamics)| our_step(world, physics);
    let [ours, theirs] = in_turns(60, &(boxes, step), &(|| plain_boxes(count), PhysicsWorld::step))?;
    rows.push([
        format!("a step of {count} boxes that fall into piles for a second, over the engine alone"),
        format!("{ours:.2} ms over {theirs:.2} ms: {:.2}", ours / theirs),
        "1.15".into(),
    ]);
    let (mut world, mut physics) = our_boxes(count)?;
    for _ in 0..some(600, share) {
        our_step(&mut world, &mut physics)?;
    }
    let resting = per_step(5, 20, || our_step(&mut world, &mut physics))?;
    rows.push([
        format!("a step of {count} boxes that have come to rest"),
        format!("{:.3} ms", resting.processor),
        "next to nothing".into(),
    ]);
    let walkers = || our_walkers(count);
    let [ours, theirs] = in_turns(60, &(walkers, step), &(|| PlainWalkers::new(count), PlainWalkers::step))?;
    rows.push([
        format!("a step of {count} walkers past posts, over the engine's character controller alone"),
        format!("{ours:.2} ms over {theirs:.2} ms: {:.2}", ours / theirs),
        "1.15".into(),
    ]);
    Ok(())
}

/// The resident set, bytes; Linux only.
fn memory() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmRSS:"))?;
    Some(line.split_whitespace().nth(1)?.parse::<f64>().ok()? * 1024.0)
}

/// A hundred bodies that move: half of them people, half crates.
const ACTIVE: Crowd = Crowd { people: 50, dogs: 0, cars: 0, crates: 50 };

fn city(share: f64, rows: &mut Rows) -> Result<(), ProvingError> {
    let side = |solids: f64| (solids * share / SOLIDS as f64).sqrt().ceil().max(1.0) as usize;
    let blocks = side(1e6);
    let world = Quarter::world(blocks)?;
    let solids = blocks * blocks * SOLIDS;
    let before = memory();
    let mut made = None;
    let building = cost(1, || {
        let quarter = made.insert(Quarter::new(world, 2, ACTIVE, Threads::One)?);
        quarter.step()
    })?;
    let Some(mut quarter) = made else { return Ok(()) };
    let grown = before.zip(memory()).map(|(before, after)| (after - before) / 1e6);
    rows.push([
        format!("{solids} fixed solids: to make bodies of them"),
        format!(
            "{:.2} s of a core, {}",
            building.processor * 1e-3,
            grown.map_or("?".into(), |grown| format!("{grown:.0} MB"))
        ),
        "5 s, 1000 MB".into(),
    ]);
    let step = per_step(3, some(60, share), || quarter.step())?;
    let count = ACTIVE.people + ACTIVE.crates;
    rows.push([
        format!("a step among them with {count} bodies that move"),
        format!("{:.2} ms", step.processor),
        "1 ms".into(),
    ]);
    drop(quarter);
    let mut steps = Vec::new();
    for buildings in [1e3, 1e4, 1e5] {
        let blocks = side(buildings / BUILDINGS as f64 * SOLIDS as f64);
        let mut quarter = Quarter::new(Quarter::world(blocks)?, 2, ACTIVE, Threads::One)?;
        quarter.step()?;
        let step = per_step(5, some(60, share), || quarter.step())?;
        steps.push(format!("{:.2}", step.processor));
    }
    rows.push([
        format!("a step with {count} bodies that move, among 1 k, 10 k, 100 k buildings and 8 times as many solids"),
        format!("{} ms", steps.join(", ")),
        "by bodies, not by the city".into(),
    ]);
    Ok(())
}

/// A quarter some seconds on, so that those who meet have met.
fn warmed(blocks: usize, crowd: Crowd, threads: Threads, share: f64) -> Result<Quarter, ProvingError> {
    let mut quarter = Quarter::new(Quarter::world(blocks)?, blocks, crowd, threads)?;
    for _ in 0..some(300, share) {
        quarter.step()?;
    }
    Ok(quarter)
}

fn real_time(what: String, cost: Cost, bar: &str, rows: &mut Rows) {
    let Cost { clock, processor } = cost;
    let [by_clock, by_processor] = [clock, processor].map(|ms| 1000.0 / 60.0 / ms);
    let measured = format!(
        "{clock:.1} ms a step by the clock, {by_clock:.2} times real time; {processor:.1} ms of a core, {by_processor:.2}"
    );
    rows.push([what, measured, bar.into()]);
}

fn people(share: f64, rows: &mut Rows) -> Result<(), ProvingError> {
    let people = some(1000, share);
    for blocks in [16, 4] {
        let mut quarter = warmed(blocks, Crowd { people, ..Crowd::default() }, Threads::One, share)?;
        let step = per_step(5, some(60, share), || quarter.step())?;
        let blocks = blocks * blocks;
        real_time(
            format!("{people} people in the streets of {blocks} blocks, 60 steps a second, one core"),
            step,
            "1 on one core",
            rows,
        );
    }
    Ok(())
}

fn cars(share: f64, rows: &mut Rows) -> Result<(), ProvingError> {
    let cars = some(1000, share);
    let mut fleet = Fleet::new(cars)?;
    for _ in 0..some(60, share) {
        fleet.step()?;
    }
    let step = per_step(5, some(60, share), || fleet.step())?;
    real_time(format!("{cars} cars on tyres, 60 steps a second, one core"), step, "1 on one core", rows);
    Ok(())
}

fn mixed(share: f64, rows: &mut Rows) -> Result<(), ProvingError> {
    let all = some(10_000, share);
    let (people, cars) = (all * 6 / 10, all * 3 / 10);
    let crowd = Crowd { people, cars, dogs: all - people - cars, crates: 0 };
    let blocks = 30;
    // A circle in which about five hundred are.
    let extent = blocks as f64 * 80.0;
    let radius = extent * (500.0 / 10_000.0 / std::f64::consts::PI).sqrt();
    let mut quarter = Quarter::with_detail(Quarter::world(blocks)?, blocks, crowd, Threads::All, radius)?;
    quarter.physics.set_interest(&[Point3::new(extent / 2.0, extent / 2.0, 0.0)]);
    for _ in 0..some(120, share) {
        quarter.step()?;
    }
    let step = per_step(4, some(60, share), || quarter.step())?;
    let bodies: Vec<_> = quarter.physics.bodies().collect();
    let full =
        bodies.iter().filter(|id| quarter.physics.detail(**id) == Some(simworld_physics::Detail::Full));
    let full = full.count();
    real_time(
        format!(
            "{all} people, cars and dogs, the nearest {full} in full detail, 60 steps a second, all cores"
        ),
        step,
        "1 on two cores",
        rows,
    );
    Ok(())
}

fn dogs(share: f64, rows: &mut Rows) -> Result<(), ProvingError> {
    for (dogs, is_reduced, bar) in [(50, false, "1 on two cores"), (400, true, "hundreds in real time")] {
        let dogs = some(dogs, share);
        let mut pack = Pack::new(dogs, 0.6)?;
        if is_reduced {
            pack.physics.set_interest(&[Point3::new(0.0, 0.0, 1e5)]);
        }
        for _ in 0..some(20, share) {
            pack.step(0.1)?;
        }
        let step = per_step(5, some(10, share), || pack.step(0.1))?;
        let form = if is_reduced { "in the reduced form" } else { "on twelve motors, 200 substeps a second" };
        rows.push([
            format!("{dogs} robot dogs {form}"),
            format!(
                "{:.1} ms a tenth of a second by the clock, {:.2} times real time; {:.1} ms of a core",
                step.clock,
                100.0 / step.clock,
                step.processor
            ),
            bar.into(),
        ]);
    }
    Ok(())
}

fn snapshots(share: f64, rows: &mut Rows) -> Result<(), ProvingError> {
    let count = some(10_000, share);
    let (mut world, mut physics) = our_boxes(count)?;
    for _ in 0..30 {
        our_step(&mut world, &mut physics)?;
    }
    let (mut saving, mut restoring, mut saved) = (Cost::NONE, Cost::NONE, Vec::new());
    for _ in 0..5 {
        saving = saving.least(cost(1, || {
            saved = physics.save()?;
            Ok(())
        })?);
        restoring = restoring.least(cost(1, || Ok(physics.restore(&world, &saved)?))?);
    }
    let (saving, restoring, size) = (saving.processor, restoring.processor, saved.len());
    rows.push([
        format!("{count} boxes in piles: to save, to take up"),
        format!("{saving:.0} ms, {restoring:.0} ms, {:.1} MB", size as f64 / 1e6),
        "50 ms each".into(),
    ]);
    Ok(())
}
