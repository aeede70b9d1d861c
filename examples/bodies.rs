//! Bodies on an obstacle course, vehicles beside what vehicles of their kind are known to do, and robot dogs on their motors: their
//! gait, and what many cost.
//!
//! ```sh
//! cargo run --release --example bodies -- --out out/bodies
//! ```

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use comfy_table::{Table, presets::UTF8_FULL_CONDENSED};
use indicatif::{ProgressBar, ProgressStyle};
use simworld_core::geometry::Point3;
use simworld_examples::bodies::{
    Course, Curve, Embodiment, Film, Outcome, PATIENCE, SECTIONS, braking_chart, energy_chart, gait_chart,
};
use simworld_examples::timing::timed;
use simworld_physics::proving::{Figure, Fleet, Pack, ProvingError, braking_distance, measure};
use simworld_physics::{RoadCondition, VehicleClass};

/// Sends every embodiment over an obstacle course, then measures every class of vehicles on the proving ground and prints each
/// figure beside its band.
#[derive(Parser)]
struct Arguments {
    /// Directory for the plots of braking distance, of energy and of the gait of robot dogs, and the film of the course.
    #[arg(long, default_value = "out/bodies")]
    out: PathBuf,
    /// Only this class: `small_car`, `sedan`, `suv`, `van`, `truck`, `bus` or `scooter`.
    #[arg(long)]
    class: Option<String>,
    /// Cars in the measurement of speed; 0 leaves it out.
    #[arg(long, default_value_t = 1000)]
    cars: usize,
    /// Robot dogs on their legs in the measurement of speed; 0 leaves them and their gait out.
    #[arg(long, default_value_t = 50)]
    dogs: usize,
    /// Seconds between the pictures of the film; 0 makes none.
    #[arg(long, default_value_t = 0.5)]
    film: f64,
    /// The course alone.
    #[arg(long)]
    course_only: bool,
    /// Succeed even if a figure is off its band.
    #[arg(long)]
    report_only: bool,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    match job(&arguments) {
        Ok(0) => ExitCode::SUCCESS,
        Ok(off) => {
            eprintln!("{off} figures are off their bands, or did not come through the course");
            if arguments.report_only { ExitCode::SUCCESS } else { ExitCode::FAILURE }
        }
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

/// Returns how many figures are off and how many did not come through.
fn job(arguments: &Arguments) -> Result<usize, ProvingError> {
    let classes: Vec<VehicleClass> = match &arguments.class {
        Some(name) => vec![VehicleClass::from_name(name).ok_or_else(|| unknown(name))?],
        None => VehicleClass::ALL.to_vec(),
    };
    simworld_examples::folder::make_folder(&arguments.out)?;
    let mut off = run_course(arguments)?;
    let path = arguments.out.join("energy.svg");
    std::fs::write(&path, energy_chart())?;
    println!("energy by speed: {}", path.display());
    if !arguments.course_only {
        off += proving_ground(arguments, &classes)?;
    }
    Ok(off)
}

/// Sends everybody over the course; returns how many did not come through.
fn run_course(arguments: &Arguments) -> Result<usize, ProvingError> {
    let mut course = Course::new(&Embodiment::ALL)?;
    let path = arguments.out.join("course.gif");
    let mut film = match (arguments.film > 0.0).then(|| Film::new(&path, Embodiment::ALL.len())) {
        Some(Ok(film)) => Some(film),
        Some(Err(error)) => {
            println!("no film: {error}");
            None
        }
        None => None,
    };
    let style = ProgressStyle::with_template("{msg:20} [{bar:40}] {pos}/{len} s at most")?;
    let bar = ProgressBar::new(PATIENCE as u64).with_style(style).with_message("obstacle course");
    let mut due = 0.0;
    while !course.is_over() {
        if let Some(film) = film.as_mut().filter(|_| course.time() >= due) {
            film.take(course.world(), course.runners())?;
            due += arguments.film;
        }
        course.step()?;
        bar.set_position(course.time() as u64);
    }
    bar.finish_and_clear();
    let mut table = Table::new();
    table.load_style(UTF8_FULL_CONDENSED);
    let sections = SECTIONS.iter().map(|(name, _)| format!("{name}, s"));
    let rest = ["fastest, m/s", "highest, m", "tilt, deg", "falls", "posts touched", "energy, kJ"];
    table.set_header(std::iter::once("embodiment".to_owned()).chain(sections).chain(rest.map(str::to_owned)));
    for outcome in course.outcomes() {
        table.add_row(outcome_row(outcome));
    }
    println!("{table}");
    if film.is_some() {
        println!("film of the course: {}", path.display());
    }
    Ok(course.outcomes().filter(|outcome| outcome.times.len() < SECTIONS.len()).count())
}

fn outcome_row(outcome: &Outcome) -> Vec<String> {
    let time = |index: usize| outcome.times.get(index).map_or("-".to_owned(), |time| format!("{time:.1}"));
    let mut row = vec![outcome.embodiment.name()];
    row.extend((0..SECTIONS.len()).map(time));
    row.extend([
        format!("{:.1}", outcome.fastest),
        format!("{:.2}", outcome.highest),
        format!("{:.0}", outcome.tilt.to_degrees()),
        outcome.falls.to_string(),
        outcome.touches.to_string(),
        outcome.energy.map_or(String::new(), |energy| format!("{:.1}", energy / 1000.0)),
    ]);
    row
}

/// Drives every class through the manoeuvres; returns how many figures are off.
fn proving_ground(arguments: &Arguments, classes: &[VehicleClass]) -> Result<usize, ProvingError> {
    let style = ProgressStyle::with_template("{msg:20} [{bar:40}] {pos}/{len}")?;
    let bar = ProgressBar::new(2 * classes.len() as u64).with_style(style);
    let mut table = Table::new();
    table.load_style(UTF8_FULL_CONDENSED);
    table.set_header(["vehicle", "figure", "measured", "band", "", "source of the band"]);
    let (mut off, mut curves) = (0, Vec::new());
    for class in classes.iter().copied() {
        bar.set_message(format!("{class}: manoeuvres"));
        for figure in measure(class)? {
            off += usize::from(!figure.holds());
            table.add_row(row(class, &figure));
        }
        bar.inc(1);
        bar.set_message(format!("{class}: braking"));
        curves.extend(braking_curves(class)?);
        bar.inc(1);
    }
    bar.finish_and_clear();
    println!("{table}");
    let path = arguments.out.join("braking.svg");
    std::fs::write(&path, braking_chart(&curves))?;
    println!("braking distances: {}", path.display());
    if arguments.cars > 0 {
        speed(arguments.cars)?;
    }
    if arguments.dogs > 0 {
        let path = arguments.out.join("gait.svg");
        let mut dog = Pack::new(1, 0.6)?;
        std::fs::write(&path, gait_chart(&dog.watch(5.0)?))?;
        println!("gait of a robot dog: {}", path.display());
        dogs_speed(arguments.dogs)?;
    }
    Ok(off)
}

fn unknown(name: &str) -> String {
    let known: Vec<_> = VehicleClass::ALL.iter().map(|class| class.as_str()).collect();
    format!("there is no class {name}: give one of {}", known.join(", "))
}

fn row(class: VehicleClass, figure: &Figure) -> [String; 6] {
    let Figure { name, value, low, high, source } = figure;
    let mark = if figure.holds() { "" } else { "off" };
    let band = format!("{low} to {high}");
    [class.to_string(), name.clone(), format!("{value:.2}"), band, mark.to_owned(), (*source).to_owned()]
}

/// Ways to rest from 10 km/h on, on every road.
fn braking_curves(class: VehicleClass) -> Result<Vec<Curve>, ProvingError> {
    let vehicle = class.parameters();
    let top = (vehicle.powertrain.top_speed * 3.6).min(130.0);
    let mut curves = Vec::new();
    for road in [RoadCondition::Dry, RoadCondition::Wet, RoadCondition::Snow] {
        let mut points = vec![(0.0, 0.0)];
        let mut speed = 10.0;
        while speed <= top {
            if let Some(way) = braking_distance(&vehicle, road, speed / 3.6)? {
                points.push((speed, way));
            }
            speed += 10.0;
        }
        curves.push(Curve { class, road, points });
    }
    Ok(curves)
}

/// How fast many cars are computed on one core.
fn speed(cars: usize) -> Result<(), ProvingError> {
    for (name, interest) in [("on tyres", vec![]), ("as single tracks", vec![Point3::new(0.0, 0.0, 1e5)])] {
        let mut fleet = Fleet::new(cars)?;
        fleet.physics.set_interest(&interest);
        for _ in 0..60 {
            fleet.step()?;
        }
        let mut best = f64::INFINITY;
        for _ in 0..3 {
            let (done, time) = timed(|| (0..60).try_for_each(|_| fleet.step()));
            done?;
            best = best.min(time.as_secs_f64());
        }
        println!(
            "{cars} cars {name}, 60 steps a second: {:.2} ms a step on one core, {:.1} times real time; bar: 1 \
             (mean speed {:.1} m/s)",
            best / 60.0 * 1e3,
            1.0 / best,
            fleet.mean_speed()
        );
    }
    Ok(())
}

/// How fast many robot dogs on their legs are computed.
fn dogs_speed(dogs: usize) -> Result<(), ProvingError> {
    let mut pack = Pack::new(dogs, 0.6)?;
    for _ in 0..20 {
        pack.step(0.1)?;
    }
    let mut best = f64::INFINITY;
    for _ in 0..3 {
        let (done, time) = timed(|| (0..10).try_for_each(|_| pack.step(0.1)));
        done?;
        best = best.min(time.as_secs_f64());
    }
    println!(
        "{dogs} robot dogs on twelve motors each, 200 substeps a second: {:.2} times real time; bar: 1 on two cores",
        1.0 / best
    );
    Ok(())
}
