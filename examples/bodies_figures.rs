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
    BUILDINGS, Crowd, Loop, PlainWalkers, Quarter, Rival, SOLIDS, Threads, mujoco_boxes, mujoco_trot,
    our_boxes, our_step, our_trot, our_walkers, plain_boxes,
};
use simworld_examples::timing::timed;
use simworld_examples::{exit_code, processor};
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
    /// What a city takes, in a process of its own: memory that was used before would count for nothing.
    #[arg(long, hide = true)]
    solids: Option<Solids>,
}

/// Which fixed solids of a city are in the engine.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Solids {
    /// All of them.
    Whole,
    /// Those near ten points, and near bodies.
    Streamed,
}

/// A part of the figures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Part {
    /// The same bodies with and without us.
    Overhead,
    /// A city of a million fixed solids, and cities of several sizes.
    City,
    /// The same city whole, and streamed around ten points.
    Streaming,
    /// People on foot.
    People,
    /// Cars on tyres.
    Cars,
    /// People, dogs and cars, near and far.
    Mixed,
    /// Robot dogs.
    Dogs,
    /// The trot of a robot dog beside that of the same dog in `MuJoCo`.
    Trot,
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
    let parts: [(Part, Measure); 9] = [
        (Part::Overhead, overhead),
        (Part::City, city),
        (Part::Streaming, |share, rows| {
            streaming(share, rows);
            Ok(())
        }),
        (Part::People, people),
        (Part::Cars, cars),
        (Part::Mixed, mixed),
        (Part::Dogs, dogs),
        (Part::Trot, trot),
        (Part::Snapshots, snapshots),
    ];
    if let Some(solids) = arguments.solids {
        println!("{}", city_of(solids, share)?);
        return Ok(());
    }
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
    let before = processor::of_process();
    let (done, time) = timed(work);
    done?;
    let taken = before.zip(processor::of_process()).map(|(before, after)| (after - before) * 1e3);
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

/// Steps that one of two things takes before it is the other's turn: longer than the ticks of several milliseconds in which some systems
/// count processor time, and shorter than a machine that others use keeps its speed.
const STRIDE: usize = 5;

/// Processor times of a step of two things, ms, in the mean of their first steps: both are made anew in each turn, several of a kind, and go on side by side, a few
/// steps each, now one and now the other first.
fn in_turns<A, B>(
    (turns, copies, steps): (usize, usize, usize),
    ours: &(impl Fn() -> Result<A, ProvingError>, impl Fn(&mut A) -> Result<(), ProvingError>),
    plain: &(impl Fn() -> B, impl Fn(&mut B)),
) -> Result<Vec<[f64; 2]>, ProvingError> {
    let turn = |number: usize| {
        let mut several = (0..copies).map(|_| ours.0()).collect::<Result<Vec<A>, _>>()?;
        let mut others: Vec<B> = (0..copies).map(|_| plain.0()).collect();
        let mut taken = [0.0; 2];
        for stride in 0..2 * (steps / STRIDE) {
            let which = (number + stride / 2 + stride) % 2;
            let spent = cost(copies * steps, || {
                if which == 0 {
                    several.iter_mut().try_for_each(|one| (0..STRIDE).try_for_each(|_| ours.1(one)))
                } else {
                    for other in &mut others {
                        (0..STRIDE).for_each(|_| plain.1(other));
                    }
                    Ok(())
                }
            })?;
            taken[which] += spent.processor;
        }
        Ok(taken)
    };
    // The first is not counted: the memory of the process grows in it.
    turn(0)?;
    (0..turns).map(turn).collect()
}

/// What one takes in relation to the other: the mean of all turns, and the median ratio of them with the least and the greatest.
fn compared(turns: &[[f64; 2]]) -> String {
    let mean = |which: usize| turns.iter().map(|turn| turn[which]).sum::<f64>() / turns.len() as f64;
    let mut ratios: Vec<f64> = turns.iter().map(|[ours, theirs]| ours / theirs).collect();
    ratios.sort_by(f64::total_cmp);
    let [low, median, high] = [0, ratios.len() / 2, ratios.len() - 1].map(|place| ratios[place]);
    let (ours, theirs) = (mean(0), mean(1));
    format!(
        "{ours:.2} ms over {theirs:.2} ms: {:.2}; {} turns {median:.2} ({low:.2} to {high:.2})",
        ours / theirs,
        turns.len()
    )
}

fn overhead(share: f64, rows: &mut Rows) -> Result<(), ProvingError> {
    let step = |(world, physics): &mut (World, PhysicsDynamics)| our_step(world, physics);
    for (count, turns, copies) in [(some(1000, share), 10, 5), (some(10_000, share), 4, 1)] {
        let ours = (|| our_boxes(count), step);
        let by_hand = in_turns((turns, copies, 60), &ours, &(|| Loop::new(plain_boxes(count)), Loop::step))?;
        rows.push([
            format!("a step of {count} boxes that fall into piles for a second, over a loop by hand that reads motions and contacts"),
            compared(&by_hand),
            "1.15".into(),
        ]);
        let alone = in_turns((turns, copies, 60), &ours, &(|| plain_boxes(count), PhysicsWorld::step))?;
        rows.push(["the same over the engine's step alone".into(), compared(&alone), "-".into()]);
    }
    let count = some(1000, share);
    rows.push([
        format!("a step of {count} such boxes in MuJoCo with its own settings"),
        match mujoco_boxes(count, 60) {
            Rival::Measured(ms) => format!("{ms:.2} ms"),
            Rival::Absent => "not measured: the Python package mujoco is not there".into(),
            Rival::Failed(why) => format!("not measured: {why}"),
        },
        "-".into(),
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
    let turns = in_turns((4, 1, 60), &(walkers, step), &(|| PlainWalkers::new(count), PlainWalkers::step))?;
    rows.push([
        format!("a step of {count} walkers past posts, over the engine's character controller alone"),
        compared(&turns),
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

/// Blocks to the side of a city of so many solids.
fn side(solids: f64, share: f64) -> usize {
    (solids * share / SOLIDS as f64).sqrt().ceil().max(1.0) as usize
}

/// What a city of a million solids takes of time and memory.
fn city_of(solids: Solids, share: f64) -> Result<String, ProvingError> {
    let blocks = side(1e6, share);
    let world = Quarter::world(blocks)?;
    let before = memory();
    let mut made = None;
    let building = cost(1, || {
        let quarter = made.insert(Quarter::new(world, 2, ACTIVE, Threads::One)?);
        if solids == Solids::Streamed {
            let apart = blocks as f64 * 8.0;
            let points: Vec<_> = (0..10).map(|k| 80.0 + f64::from(k) * apart).collect();
            let points: Vec<_> = points.iter().map(|at| Point3::new(*at, *at, 0.0)).collect();
            quarter.physics.set_interest(&points);
        }
        quarter.step()
    })?;
    let Some(mut quarter) = made else { return Ok(String::new()) };
    let grown = before.zip(memory()).map(|(before, after)| (after - before) / 1e6);
    let step = per_step(3, some(60, share), || quarter.step())?;
    let grown = grown.map_or("?".into(), |grown| format!("{grown:.0} MB"));
    Ok(format!("{:.2} s of a core, {grown}, {:.2} ms a step", building.processor * 1e-3, step.processor))
}

fn streaming(share: f64, rows: &mut Rows) {
    let measured = |solids: &str| {
        let share = share.to_string();
        let output = std::process::Command::new(std::env::current_exe().ok()?)
            .args(["--share", &share, "--solids", solids])
            .output()
            .ok()?;
        let said = String::from_utf8_lossy(&output.stdout).trim().to_owned();
        output.status.success().then_some(said)
    };
    let solids = side(1e6, share).pow(2) * SOLIDS;
    for (name, what) in [("whole", "all in the engine"), ("streamed", "streamed around ten points")] {
        rows.push([
            format!("{solids} fixed solids, {what}: to make bodies of them, and a step"),
            measured(name).unwrap_or_else(|| "not measured".into()),
            "-".into(),
        ]);
    }
}

fn city(share: f64, rows: &mut Rows) -> Result<(), ProvingError> {
    let blocks = side(1e6, share);
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
        let blocks = side(buildings / BUILDINGS as f64 * SOLIDS as f64, share);
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

fn trot(share: f64, rows: &mut Rows) -> Result<(), ProvingError> {
    let seconds = (10.0 * share).max(0.5);
    for speed in [0.5, 1.0] {
        let ours = our_trot(speed, seconds)?;
        let what = format!("a robot dog told to trot at {speed} m/s, {seconds} s");
        rows.push([what.clone(), ours.to_string(), "-".into()]);
        let (measured, apart) = match mujoco_trot(speed, seconds) {
            Rival::Measured(theirs) => {
                let (higher, faster) = (ours.height - theirs.height, ours.speed / theirs.speed - 1.0);
                let apart = format!("trunk {:+.1} mm, speed {:+.1} %", higher * 1e3, faster * 100.0);
                (theirs.to_string(), apart)
            }
            Rival::Absent => ("not measured: the Python package mujoco is not there".into(), "-".into()),
            Rival::Failed(why) => (format!("not measured: {why}"), "-".into()),
        };
        rows.push([format!("{what}: the same dog and control in MuJoCo"), measured, "-".into()]);
        rows.push([format!("{what}: ours against that"), apart, "20 mm, 30 %".into()]);
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
