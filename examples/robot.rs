//! Robots from files at work: a six-axis arm from URDF reaches for places, a robot on wheels from MJCF drives an eight. Any other
//! file is read, weighed, let fall and drawn with `--look-at`.
//!
//! ```sh
//! cargo run --release --example robot -- --out out/robot
//! ```

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;
use comfy_table::{Table, presets::UTF8_FULL_CONDENSED};
use simworld_core::geometry::Point3;
use simworld_examples::folder::make_folder;
use simworld_examples::robot::{ARM, Bench, ROVER, Reach, Roll, picture, reach, roll};
use simworld_physics::RobotConfig;
use simworld_physics::robot::{ImportOptions, mjcf, urdf};
use simworld_render::{RenderConfig, RenderError, Renderer};

/// How far the tip may be from its target, m, and how far a speed from what was told, as a share.
const NEAR: f64 = 0.005;
const LIKE: f64 = 0.1;

/// Has an arm reach for places and a robot on wheels drive an eight, both from files of the repository, prints what became
/// of it and draws it.
#[derive(Parser)]
struct Arguments {
    /// Directory for the picture.
    #[arg(long, default_value = "out/robot")]
    out: PathBuf,
    /// Reads this file instead, `.urdf` or MJCF as `.xml`, with its meshes from its folder; says what it holds and what was
    /// approximated, lets it stand for two seconds, and draws it as it is seen then.
    #[arg(long)]
    look_at: Option<PathBuf>,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let done = match &arguments.look_at {
        Some(path) => look_at(path, &arguments.out).map(|()| 0),
        None => run(&arguments.out),
    };
    match done {
        Ok(0) => ExitCode::SUCCESS,
        Ok(off) => {
            eprintln!("{off} targets were missed, or speeds not kept");
            ExitCode::FAILURE
        }
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(out: &Path) -> Result<usize, Box<dyn std::error::Error>> {
    make_folder(out)?;
    let (reaches, rolls) = (reach(ARM)?, roll(ROVER)?);
    println!("An arm from URDF reaches for five places:\n{}", reach_table(&reaches));
    println!("A robot on wheels from MJCF drives an eight:\n{}", roll_table(&rolls));
    let path = out.join("robot.svg");
    std::fs::write(&path, picture(&reaches, &rolls))?;
    println!("{}", path.display());
    let missed = reaches.iter().filter(|reach| reach.off() > NEAR).count();
    let unlike = |roll: &&Roll| {
        let [speed, turning] = [0, 1].map(|part| (roll.done[part] - roll.told[part]).abs());
        speed > LIKE * roll.told[0].abs() || turning > LIKE * roll.told[1].abs().max(0.5)
    };
    Ok(missed + rolls.iter().filter(unlike).count())
}

fn table(header: &[&str]) -> Table {
    let mut table = Table::new();
    table.load_style(UTF8_FULL_CONDENSED).set_header(header);
    table
}

fn reach_table(reaches: &[Reach]) -> Table {
    let mut table = table(&["target, m", "tip, m", "off", "most effort"]);
    for reach in reaches {
        let place = |place: &nalgebra::Vector3<f64>| format!("{:.3} {:.3} {:.3}", place.x, place.y, place.z);
        let off = format!("{:.1} mm", 1e3 * reach.off());
        table.add_row([
            place(&reach.target),
            place(&reach.tip),
            off,
            format!("{:.0} %", 100.0 * reach.effort),
        ]);
    }
    table
}

fn roll_table(rolls: &[Roll]) -> Table {
    let mut table = table(&["stretch", "told", "done"]);
    for roll in rolls {
        let words = |[speed, turning]: [f64; 2]| format!("{speed:.3} m/s, {turning:.3} rad/s");
        table.add_row([roll.name.to_owned(), words(roll.told), words(roll.done)]);
    }
    table
}

fn look_at(path: &Path, out: &Path) -> Result<(), Box<dyn std::error::Error>> {
    let text = std::fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))?;
    let folder = path.parent().map(Path::to_owned);
    let options = ImportOptions { folder, ..ImportOptions::default() };
    let is_urdf = path.extension().is_some_and(|end| end.eq_ignore_ascii_case("urdf"));
    let read = if is_urdf { urdf::from_str(&text, &options) } else { mjcf::from_str(&text, &options) };
    let read = read.map_err(|error| format!("{}: {error}", path.display()))?;
    for note in &read.report {
        println!("{note}");
    }
    let description = read.description;
    let mut table = table(&["joint", "moves", "from and to", "effort"]);
    for joint in &description.joints {
        let limits = joint.limits.map_or("-".to_owned(), |[low, high]| format!("{low:.3} {high:.3}"));
        let effort = joint.effort.map_or("-".to_owned(), |effort| format!("{effort:.1}"));
        table.add_row([joint.name.clone(), format!("{:?}", joint.kind).to_lowercase(), limits, effort]);
    }
    println!("{table}");
    println!("{}: {} links, {:.3} kg", description.name, description.links.len(), description.mass());
    let first = description.links.first().map(|link| link.name.clone()).unwrap_or_default();
    let mut bench = Bench::new(RobotConfig::from(description), Point3::origin())?;
    (0..20).try_for_each(|_| bench.step(0.1))?;
    if let Some(pose) = bench.robot().link_pose(&first) {
        let at = pose.translation.vector;
        println!("after two seconds without a command {first} is at {:.3} {:.3} {:.3} m", at.x, at.y, at.z);
    }
    draw(&bench, path, out)
}

/// Writes what the robot of a file looks like; without an adapter it says what is missing, and that is all.
fn draw(bench: &Bench, path: &Path, out: &Path) -> Result<(), Box<dyn std::error::Error>> {
    let mut renderer = match Renderer::new(&RenderConfig::default()) {
        Ok(renderer) => renderer,
        Err(error @ RenderError::NoAdapter { .. }) => {
            println!("not drawn: {error}");
            return Ok(());
        }
        Err(error) => return Err(error.into()),
    };
    make_folder(out)?;
    let name = path.file_stem().map_or_else(|| "robot".into(), |name| name.to_string_lossy());
    let picture = out.join(format!("{name}.png"));
    bench.portrait(&mut renderer, [800, 600])?.write_png(&picture)?;
    println!("{}", picture.display());
    Ok(())
}
