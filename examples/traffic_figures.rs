//! How fast traffic moves: vehicle updates a CPU second beside their bars, cost against numbers, threads, memory, and a
//! city of a million vehicles and a million people against the clock.
//!
//! ```sh
//! cargo run --release --example traffic_figures            # a minute or so
//! cargo run --release --example traffic_figures -- --whole # with the rows of a million
//! ```

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

use clap::Parser;
use comfy_table::presets::UTF8_FULL_CONDENSED;
use comfy_table::{CellAlignment, Table};
use indicatif::{ProgressBar, ProgressStyle};
use simworld_citygen::AllThreads;
use simworld_core::hash::StateHash;
use simworld_core::net::{CrossSection, NetworkConfig, RoadNetwork, StreetPlan};
use simworld_core::seed::Seed;
use simworld_examples::beside_sumo::{BesideError, Workload, beside};
use simworld_traffic::validation::halls::{Halls, PEOPLE};
use simworld_traffic::{Traffic, TrafficConfig};

/// Measures how fast traffic moves and prints each rate beside its bar.
#[derive(Parser)]
struct Arguments {
    /// Also the long rows: a hundred thousand and a million vehicles, and a million vehicles with a million people.
    #[arg(long)]
    whole: bool,
    /// Seconds of traffic before anything is measured.
    #[arg(long, default_value_t = 60)]
    warm_up: u32,
    /// Seconds of traffic that each row measures, three times over: the best counts.
    #[arg(long, default_value_t = 20)]
    measured: u32,
    /// Only rows whose description contains this.
    #[arg(long, default_value = "")]
    only: String,
    /// A Python that has libsumo and eclipse-sumo, for the rows beside SUMO.
    #[arg(long, default_value = "python3")]
    python: PathBuf,
}

type Outcome<T> = Result<T, Box<dyn std::error::Error + Send + Sync>>;

/// Time of a step, s.
const DT: f64 = 0.1;
/// Vehicles on a kilometre of lane.
const DENSITY: f64 = 7.2;

fn main() -> Outcome<()> {
    let arguments = Arguments::parse();
    let mut report = Report::new(&arguments);
    rates(&arguments, &mut report)?;
    walkers(&arguments, &mut report)?;
    threads(&arguments, &mut report)?;
    city(&arguments, &mut report)?;
    beside_sumo(&arguments, &mut report)?;
    report.print();
    Ok(())
}

/// SUMO on the same files at the same step; more in the example `beside_sumo`.
fn beside_sumo(arguments: &Arguments, report: &mut Report) -> Outcome<()> {
    let (warm_up, measured) = (f64::from(arguments.warm_up), f64::from(arguments.measured));
    let sizes: &[(u32, u32)] = if arguments.whole { &[(10, 1000), (30, 10_000)] } else { &[(10, 1000)] };
    for (junctions, vehicles) in sizes.iter().copied() {
        let what = format!("updates beside SUMO's on its own files, {vehicles} vehicles, one thread");
        if !report.wants(&what) {
            continue;
        }
        let workload = Workload { junctions, vehicles, step: DT, warm_up, measured };
        let measured = match beside(workload, &arguments.python, Path::new("out/beside_sumo"), 1) {
            Ok(found) => {
                let [ours, sumo] = [found.ours, found.sumo].map(|rate| rate.per_second() / 1000.0);
                format!(
                    "{ours:.0} k/s to {sumo:.0} k/s of SUMO {}: {:.0} times",
                    found.version,
                    found.ratio()
                )
            }
            Err(absent @ BesideError::Absent { .. }) => absent.to_string(),
            Err(error) => return Err(error.into()),
        };
        report.add(&what, measured, "100 times");
    }
    Ok(())
}

/// The table, and which of its rows are asked for.
struct Report {
    table: Table,
    only: String,
}

impl Report {
    fn new(arguments: &Arguments) -> Self {
        let mut table = Table::new();
        table.load_style(UTF8_FULL_CONDENSED);
        table.set_header(["what", "measured", "bar"]);
        Self { table, only: arguments.only.clone() }
    }

    fn wants(&self, what: &str) -> bool {
        what.contains(&self.only)
    }

    fn add(&mut self, what: &str, measured: String, bar: &str) {
        self.table.add_row([what.to_owned(), measured, bar.to_owned()]);
    }

    fn print(mut self) {
        if let Some(column) = self.table.column_mut(1) {
            column.set_cell_alignment(CellAlignment::Right);
        }
        println!("{}", self.table);
        println!(
            "Steps of {DT} s on signalised grids: 200 m blocks, two lanes a direction, {DENSITY} vehicles a km of lane."
        );
    }
}

/// A square grid that holds so many vehicles at the density of all rows, with so many walkers.
fn grid(vehicles: u32, pedestrians: u32) -> Outcome<Traffic> {
    // n x n junctions have 2 n (n - 1) blocks of four lanes of 0.2 km.
    let blocks = f64::from(vehicles) / DENSITY / 0.8;
    let columns = (0.5 + (0.25 + blocks / 2.0).sqrt()).round() as usize;
    let mut plan = StreetPlan::grid(columns, columns, 200.0);
    plan.sections[0] = CrossSection::two_way(2, 2);
    let network = RoadNetwork::derive_with(&plan, &NetworkConfig::default(), &AllThreads)?;
    let config = TrafficConfig { vehicles, pedestrians, ..TrafficConfig::default() };
    let traffic = Traffic::new(Arc::new(network), &config, Seed(42))?;
    let placed = traffic.placed();
    if (placed.vehicles, placed.pedestrians) != (vehicles, pedestrians) {
        return Err(format!("not everybody found a place: {placed:?}").into());
    }
    Ok(traffic)
}

/// Steps on for so many seconds of traffic.
fn run(traffic: &mut Traffic, seconds: u32, what: &str) {
    let style = ProgressStyle::with_template("{msg} [{bar:30}] {percent} %")
        .unwrap_or_else(|_| ProgressStyle::default_bar());
    let bar = ProgressBar::new(u64::from(seconds)).with_style(style).with_message(what.to_owned());
    for _ in 0..seconds {
        for _ in 0..10 {
            traffic.step(DT);
        }
        bar.inc(1);
    }
    bar.finish_and_clear();
}

/// CPU time of this thread, s; of the clock where the system does not tell.
#[expect(clippy::disallowed_methods, reason = "measuring is what this example is for")]
fn cpu_seconds(start: Instant) -> f64 {
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = told.and_then(|told| told.split_whitespace().next()?.parse::<f64>().ok());
    nanoseconds.map_or_else(|| Instant::now().duration_since(start).as_secs_f64(), |ns| ns * 1e-9)
}

#[expect(clippy::disallowed_methods, reason = "measuring is what this example is for")]
fn now() -> Instant {
    Instant::now()
}

/// The least CPU time and the least time by the clock of three runs, s.
fn best(traffic: &mut Traffic, seconds: u32, what: &str) -> (f64, f64) {
    let mut least = (f64::INFINITY, f64::INFINITY);
    for _ in 0..3 {
        let start = now();
        let before = cpu_seconds(start);
        run(traffic, seconds, what);
        least = (least.0.min(cpu_seconds(start) - before), least.1.min(start.elapsed().as_secs_f64()));
    }
    least
}

fn rates(arguments: &Arguments, report: &mut Report) -> Outcome<()> {
    let mut reference = None;
    let sizes: &[u32] = if arguments.whole { &[10_000, 1_000, 100_000, 1_000_000] } else { &[10_000, 1_000] };
    for vehicles in sizes.iter().copied() {
        let what = format!("{} vehicles, one thread", thousands(vehicles));
        if !report.wants(&what) {
            continue;
        }
        let mut traffic = grid(vehicles, 0)?;
        run(&mut traffic, arguments.warm_up, &what);
        let (time, _) = best(&mut traffic, arguments.measured, &what);
        let rate = f64::from(vehicles) * f64::from(arguments.measured) / DT / time;
        let relative = *reference.get_or_insert(rate) / rate;
        let measured = format!("{:.2} M updates/CPU s", rate / 1e6);
        report.add(&what, measured, "5 M, aim 10 M");
        report.add("  cost of one against the first row", format!("{relative:.2}"), "about 1");
        let bytes = traffic.vehicle_bytes() as f64 / f64::from(vehicles);
        report.add("  memory of a vehicle", format!("{bytes:.0} B"), "256 B");
    }
    Ok(())
}

/// People between walls at one per m², and walkers of a city with their memory.
fn walkers(arguments: &Arguments, report: &mut Report) -> Outcome<()> {
    let what = "10 k people between walls, 1 per m², one thread";
    if report.wants(what) {
        let mut halls = Halls::new(1);
        let mut least = f64::INFINITY;
        for round in 0..=3 {
            let before = cpu_seconds(now());
            for _ in 0..arguments.measured * 10 {
                halls.step(DT);
            }
            // The first round is for them to mix.
            if round > 0 {
                least = least.min(cpu_seconds(now()) - before);
            }
        }
        let rate = PEOPLE as f64 * f64::from(arguments.measured) / DT / least;
        report.add(what, format!("{:.2} M agent-steps/CPU s", rate / 1e6), "2 M");
    }
    let what = "100 k walkers of a city, one thread";
    if report.wants(what) {
        let count = 100_000;
        let plan = StreetPlan::grid(60, 60, 200.0);
        let network = RoadNetwork::derive_with(&plan, &NetworkConfig::default(), &AllThreads)?;
        let config = TrafficConfig { vehicles: 0, pedestrians: count, ..TrafficConfig::default() };
        let mut traffic = Traffic::new(Arc::new(network), &config, Seed(42))?;
        run(&mut traffic, arguments.warm_up / 4, what);
        let (time, _) = best(&mut traffic, (arguments.measured / 4).max(1), what);
        let rate = f64::from(count) * f64::from((arguments.measured / 4).max(1)) / DT / time;
        report.add(what, format!("{:.2} M agent-steps/CPU s", rate / 1e6), "-");
        let bytes = traffic.walker_bytes() as f64 / f64::from(count);
        report.add("  memory of a walker: itself, its cell, its decision", format!("{bytes:.0} B"), "150 B");
    }
    Ok(())
}

fn thousands(count: u32) -> String {
    if count >= 1_000_000 { format!("{} M", count / 1_000_000) } else { format!("{} k", count / 1000) }
}

/// The same traffic on one, two and eight threads.
fn threads(arguments: &Arguments, report: &mut Report) -> Outcome<()> {
    let vehicles = if arguments.whole { 100_000 } else { 10_000 };
    let what = format!("{} vehicles, two threads", thousands(vehicles));
    if !report.wants(&what) {
        return Ok(());
    }
    let (mut times, mut digests) = (Vec::new(), Vec::new());
    for count in [1, 2, 8] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build()?;
        let mut traffic = grid(vehicles, 0)?;
        traffic.set_workers(Box::new(AllThreads));
        let (_, time) = pool.install(|| {
            run(&mut traffic, arguments.warm_up, &what);
            best(&mut traffic, arguments.measured, &what)
        });
        times.push(time);
        digests.push(traffic.digest());
    }
    let same = digests.iter().all(|digest| *digest == digests[0]);
    report.add(&what, format!("{:.2} times as fast as one", times[0] / times[1]), "1.7");
    report.add("  eight threads", format!("{:.2} times as fast as one", times[0] / times[2]), "-");
    report.add("  the same bits on 1, 2 and 8 threads", if same { "yes" } else { "NO" }.to_owned(), "yes");
    Ok(())
}

/// Vehicles and as many people in one city, on two threads against the clock: everybody near, and everybody far from
/// interest.
fn city(arguments: &Arguments, report: &mut Report) -> Outcome<()> {
    let count = if arguments.whole { 1_000_000 } else { 10_000 };
    let what = format!("{0} vehicles and {0} people, two threads", thousands(count));
    if !report.wants(&what) {
        return Ok(());
    }
    let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build()?;
    let mut traffic = grid(count, count)?;
    traffic.set_workers(Box::new(AllThreads));
    for (interest, name) in [(None, "everybody decides in each step"), (Some(Vec::new()), "all far")] {
        traffic.set_interest(interest)?;
        let seconds = (arguments.measured / 4).max(1);
        let (_, time) = pool.install(|| {
            run(&mut traffic, seconds, &what);
            best(&mut traffic, seconds, &what)
        });
        let factor = format!("{:.2} times real time", f64::from(seconds) / time);
        report.add(&format!("{what}, {name}"), factor, if name == "all far" { "1" } else { "-" });
    }
    Ok(())
}
