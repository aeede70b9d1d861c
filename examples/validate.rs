//! Every figure by which the traffic is held to what engineers trust, beside its band.
//!
//! ```sh
//! cargo run --release --example validate
//! cargo run --release --example validate -- --whole
//! cargo run --release --example validate -- --only ring --only doors
//! ```

use std::process::ExitCode;
use std::time::Duration;

use clap::Parser;
use indicatif::{ProgressBar, ProgressStyle};
use simworld_traffic::validation::{Effort, Figure, MEASURES, Measure, Tolerance};

/// Measures the traffic and prints every figure beside its band, with the source of the band.
///
/// The exit status is 1 if a figure is off, unless --report-only is given. Tolerances that are ours are marked with a star.
#[derive(Parser)]
#[command(version)]
struct Arguments {
    /// All seeds and settings: minutes instead of seconds.
    #[arg(long)]
    whole: bool,
    /// Only measures whose name contains this; may be given again.
    #[arg(long, value_name = "NAME")]
    only: Vec<String>,
    /// Lists the measures and ends.
    #[arg(long)]
    list: bool,
    /// Success whatever the figures are.
    #[arg(long)]
    report_only: bool,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let is_wanted = |measure: &&Measure| {
        arguments.only.is_empty() || arguments.only.iter().any(|part| measure.name.contains(part.as_str()))
    };
    let measures: Vec<&Measure> = MEASURES.iter().filter(is_wanted).collect();
    if measures.is_empty() {
        eprintln!("error: no measure has such a name: --list shows them");
        return ExitCode::FAILURE;
    }
    if arguments.list {
        for measure in measures {
            println!("{:<20} {}", measure.name, measure.about);
        }
        return ExitCode::SUCCESS;
    }
    let effort = if arguments.whole { Effort::Whole } else { Effort::Short };
    let (all, off, failed) = run(&measures, effort);
    println!("{all} figures, {off} off, {failed} measures without a figure.   * the tolerance is ours");
    if (off, failed) == (0, 0) || arguments.report_only { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// How many figures there are, how many are off, and how many measures failed.
fn run(measures: &[&Measure], effort: Effort) -> (usize, usize, usize) {
    let style = ProgressStyle::with_template("{spinner} {msg} {bar:30} {pos} of {len} {elapsed}");
    let bar = ProgressBar::new(measures.len() as u64);
    if let Ok(style) = style {
        bar.set_style(style);
    }
    bar.enable_steady_tick(Duration::from_millis(100));
    let (mut all, mut off, mut failed) = (0, 0, 0);
    for measure in measures {
        bar.set_message(measure.name);
        let figures = (measure.run)(effort);
        bar.suspend(|| println!("{}: {}", measure.name, measure.about));
        match figures {
            Ok(figures) => {
                all += figures.len();
                off += figures.iter().filter(|figure| !figure.is_ok()).count();
                bar.suspend(|| tell(&figures));
            }
            Err(error) => {
                failed += 1;
                bar.suspend(|| eprintln!("  error: {error}\n"));
            }
        }
        bar.inc(1);
    }
    bar.finish_and_clear();
    (all, off, failed)
}

fn tell(figures: &[Figure]) {
    for figure in figures {
        let mark = if figure.tolerance == Tolerance::Ours { "*" } else { " " };
        println!("  {figure} {mark}");
    }
    let mut sources: Vec<&str> =
        figures.iter().map(|figure| figure.source).filter(|source| !source.is_empty()).collect();
    sources.dedup();
    for source in sources {
        println!("      {source}");
    }
    println!();
}
