//! SUMO beside ours, on the same files: how many vehicles each moves in a second of processor time.
//!
//! `cargo run --release --example beside_sumo -- --python ~/sumo/bin/python`

use std::error::Error;
use std::path::PathBuf;
use std::time::Duration;

use clap::Parser;
use comfy_table::Table;
use indicatif::ProgressBar;
use simworld_examples::beside_sumo::{BesideError, Workload, beside};

/// The least ratio.
const BAR: f64 = 100.0;

/// Runs SUMO and ours on the same net.xml and rou.xml and prints vehicle updates a second of processor time.
#[derive(Parser)]
struct Args {
    /// A Python that has libsumo and eclipse-sumo.
    #[arg(long, default_value = "python3")]
    python: PathBuf,
    /// Junctions along each side of the grid: 10 for 1000 vehicles, 30 for 10 000, 70 for 50 000.
    #[arg(long, default_value_t = 10)]
    junctions: u32,
    /// Vehicles.
    #[arg(long, default_value_t = 1000)]
    vehicles: u32,
    /// Step, s.
    #[arg(long, default_value_t = 0.1)]
    step: f64,
    /// Simulated seconds in which vehicles enter, before those that are measured.
    #[arg(long, default_value_t = 60.0)]
    warm_up: f64,
    /// Simulated seconds that are measured.
    #[arg(long, default_value_t = 60.0)]
    measured: f64,
    /// Runs of each, of which the best counts.
    #[arg(long, default_value_t = 3)]
    repetitions: u32,
    /// Where the net.xml and the rou.xml are written.
    #[arg(long, default_value = "out/beside_sumo")]
    out: PathBuf,
}

fn main() -> Result<(), Box<dyn Error>> {
    let Args { python, junctions, vehicles, step, warm_up, measured, repetitions, out } = Args::parse();
    let workload = Workload { junctions, vehicles, step, warm_up, measured };
    let spinner = ProgressBar::new_spinner().with_message("SUMO and ours take turns");
    spinner.enable_steady_tick(Duration::from_millis(120));
    let found = beside(workload, &python, &out, repetitions);
    spinner.finish_and_clear();
    let found = match found {
        Err(absent @ BesideError::Absent { .. }) => {
            println!("SUMO is {absent}");
            return Ok(());
        }
        found => found?,
    };
    let mut table = Table::new();
    table.set_header(["", "updates", "processor time", "updates a second", "mean speed"]);
    for (name, rate) in [(format!("SUMO {}", found.version), found.sumo), ("simworld".to_owned(), found.ours)]
    {
        table.add_row([
            name,
            format!("{:.0}", rate.updates),
            format!("{:.3} s", rate.seconds),
            format!("{:.0}", rate.per_second()),
            format!("{:.2} m/s", rate.speed),
        ]);
    }
    println!(
        "{vehicles} vehicles on {junctions} x {junctions} junctions, step {step} s; files in {}",
        out.display()
    );
    println!("{table}");
    let (ratio, verdict) = (found.ratio(), if found.ratio() >= BAR { "reached" } else { "missed" });
    println!("ratio {ratio:.0}, bar {BAR}: {verdict}");
    Ok(())
}
