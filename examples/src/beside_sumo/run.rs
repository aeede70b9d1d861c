//! Runs of either simulator.

use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Arc;
use std::time::Instant;

use simworld_core::seed::Seed;
use simworld_traffic::sumo::{SumoDemand, SumoNet};
use simworld_traffic::{Traffic, TrafficConfig};

use super::files::Files;
use super::{BesideError, Rate, Workload};
use crate::processor;

/// What SUMO does: warm up, then count vehicles and processor time.
const SCRIPT: &str = r#"
import sys, time, libsumo
net, routes, step, warm, steps = sys.argv[1:6]
libsumo.start(["sumo", "-n", net, "-r", routes, "--step-length", step, "--no-step-log", "true",
    "--no-warnings", "true", "--seed", "42", "--xml-validation", "never"])
for _ in range(int(warm)):
    libsumo.simulationStep()
began, updates = time.process_time(), 0
for _ in range(int(steps)):
    libsumo.simulationStep()
    updates += libsumo.vehicle.getIDCount()
seconds = time.process_time() - began
ids = libsumo.vehicle.getIDList()
speed = sum(libsumo.vehicle.getSpeed(i) for i in ids) / max(1, len(ids))
print(libsumo.getVersion()[1].replace("SUMO ", ""), updates, seconds, speed)
"#;

/// Runs a program and returns what it printed.
pub(super) fn output_of(program: &'static str, command: &mut Command) -> Result<String, BesideError> {
    let output = command.output()?;
    if !output.status.success() {
        let message = String::from_utf8_lossy(&output.stderr).trim().to_owned();
        return Err(BesideError::Program { program, message });
    }
    Ok(String::from_utf8_lossy(&output.stdout).into_owned())
}

/// Where SUMO is.
pub(super) fn sumo_home(python: &Path) -> Result<PathBuf, BesideError> {
    let mut ask = Command::new(python);
    ask.args(["-c", "import libsumo, sumo; print(sumo.SUMO_HOME)"]);
    let home =
        output_of("python", &mut ask).map_err(|_| BesideError::Absent { python: python.to_owned() })?;
    Ok(PathBuf::from(home.trim()))
}

fn steps(workload: Workload) -> (u32, u32) {
    let count = |seconds: f64| (seconds / workload.step).round().max(1.0) as u32;
    (count(workload.warm_up), count(workload.measured))
}

/// One run of SUMO, and its version.
pub(super) fn sumo(workload: Workload, python: &Path, files: &Files) -> Result<(Rate, String), BesideError> {
    let (warm, measured) = steps(workload);
    let mut run = Command::new(python);
    run.arg("-c").arg(SCRIPT).arg(&files.net).arg(&files.routes);
    run.args([workload.step.to_string(), warm.to_string(), measured.to_string()]);
    let printed = output_of("libsumo", &mut run)?;
    let failed = || BesideError::Program { program: "libsumo", message: printed.clone() };
    // Other things may be printed before.
    let words: Vec<&str> = printed.lines().last().ok_or_else(failed)?.split(' ').collect();
    let number = |place: usize| words.get(place).and_then(|word| word.parse::<f64>().ok()).ok_or_else(failed);
    let rate = Rate { updates: number(1)?, seconds: number(2)?, speed: number(3)? };
    Ok((rate, words[0].to_owned()))
}

/// One run of ours, on one thread.
pub(super) fn ours(workload: Workload, files: &Files) -> Result<Rate, BesideError> {
    let net = SumoNet::open(&files.net)?;
    let (mut schedule, warnings) = SumoDemand::open(&files.routes)?.schedule(&net, Seed(42))?;
    if let Some(warning) = warnings.first() {
        return Err(BesideError::Program { program: "the reader of routes", message: warning.to_string() });
    }
    let config = TrafficConfig { vehicles: 0, pedestrians: 0, join_nearer: 0.0, ..TrafficConfig::default() };
    let mut traffic = Traffic::new(Arc::new(net.network), &config, Seed(42))?;
    let (warm, measured) = steps(workload);
    for _ in 0..warm {
        schedule.feed(&mut traffic)?;
        traffic.step(workload.step);
    }
    let (began, before) = (Clock::now(), traffic.counters().updates);
    for _ in 0..measured {
        schedule.feed(&mut traffic)?;
        traffic.step(workload.step);
    }
    let seconds = began.elapsed();
    let updates = (traffic.counters().updates - before) as f64;
    let speeds: Vec<f64> = traffic.stations().map(|(_, _, _, speed)| speed).collect();
    let speed = speeds.iter().sum::<f64>() / speeds.len().max(1) as f64;
    Ok(Rate { updates, seconds, speed })
}

/// Processor time of this thread, where the system tells it, or else time.
struct Clock {
    on_processor: Option<f64>,
    began: Instant,
}

impl Clock {
    #[expect(clippy::disallowed_methods, reason = "measuring is what this is for")]
    fn now() -> Self {
        Self { on_processor: processor::of_thread(), began: Instant::now() }
    }

    fn elapsed(&self) -> f64 {
        let used = self.on_processor.zip(processor::of_thread()).map(|(before, after)| after - before);
        used.unwrap_or_else(|| self.began.elapsed().as_secs_f64())
    }
}
