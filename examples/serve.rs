//! A city served over TCP, with traffic, bodies and cameras: to clients of `UnrealCV`, and by the typed protocol.
//!
//! ```sh
//! cargo run --release --example serve
//! cargo run --release --example serve -- --scene examples/assets/scenes/harbour.scene.toml
//! python -c "import unrealcv; c = unrealcv.Client(('127.0.0.1', 9000)); c.connect(); print(c.request('vget /cameras'))"
//! ```

use std::net::SocketAddr;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;

use clap::Parser;
use simworld_agents::remote::{CameraPlace, Mount, Pace, Server, ServerConfig, SimulationStage, Token};
use simworld_core::clock::Clock;
use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::net::polyline;
use simworld_core::scene::Scene;
use simworld_core::simulation::Simulation;
use simworld_examples::served::{
    CitySettings, RenderEye, ServedError, Session, replay, simulation, simulation_of,
};
use simworld_examples::written::Written;
use simworld_examples::{Outcome, exit_code};

/// The variable of the environment that holds the token.
const TOKEN: &str = "SIMWORLD_TOKEN";

/// Serves a city to clients of `UnrealCV` and of the typed protocol. A token, which any address but that of the loopback
/// interface needs, is taken from the environment's `SIMWORLD_TOKEN`.
#[derive(Parser)]
struct Arguments {
    /// Where clients of `UnrealCV` are listened for.
    #[arg(long, default_value = "127.0.0.1:9000")]
    unrealcv: SocketAddr,
    /// Where clients of the typed protocol are listened for.
    #[arg(long, default_value = "127.0.0.1:9001")]
    typed: SocketAddr,
    /// A scene that is written by hand, in place of a city; docs/scenes.md has every key.
    #[arg(long, value_name = "FILE.scene.toml", conflicts_with_all = ["roads", "replay"])]
    scene: Option<PathBuf>,
    /// Seed of the city and its traffic; a scene that is written by hand has its own for what stands in it.
    #[arg(long, default_value_t = 7)]
    seed: u64,
    /// Roads of the city.
    #[arg(long, default_value_t = 40)]
    roads: u32,
    /// Vehicles of its traffic.
    #[arg(long, default_value_t = 40)]
    vehicles: u32,
    /// Pedestrians of its traffic.
    #[arg(long, default_value_t = 80)]
    pedestrians: u32,
    /// Length of a step, s.
    #[arg(long, default_value_t = 0.05)]
    step: f64,
    /// Seconds of the city in a second; 0 lets it step only when a client says so.
    #[arg(long, default_value_t = 1.0)]
    pace: f64,
    /// Ends after so many seconds; otherwise by Ctrl-C.
    #[arg(long)]
    seconds: Option<f64>,
    /// Writes what clients did to this file.
    #[arg(long)]
    record: Option<PathBuf>,
    /// Runs such a file again, without clients, confirms every digest, and ends.
    #[arg(long)]
    replay: Option<PathBuf>,
}

fn main() -> ExitCode {
    exit_code(job(&Arguments::parse()))
}

fn job(arguments: &Arguments) -> Outcome<()> {
    if let Some(path) = &arguments.replay {
        let session = read(path)?;
        let steps = replay(&session)?;
        println!("{steps} steps and {} commands: every digest confirmed", session.recording.commands.len());
        return Ok(());
    }
    if !(1e-4..=60.0).contains(&arguments.step) {
        return Err(format!("--step {}: give 0.0001 to 60 s", arguments.step).into());
    }
    let mut settings = CitySettings {
        seed: arguments.seed,
        roads: arguments.roads,
        scene: None,
        vehicles: arguments.vehicles,
        pedestrians: arguments.pedestrians,
        step_microseconds: (arguments.step * 1e6).round() as u64,
    };
    let city = match &arguments.scene {
        Some(path) => {
            let written = Written::read(path, Clock::new(settings.step_microseconds)?)?;
            written.tell();
            // A recorded session holds the scene itself, so that it is run again without the file.
            settings.scene = Some(written.scene.to_toml()?);
            simulation_of(written.loaded.world, &settings)?
        }
        None => simulation(&settings)?,
    };
    let server = Server::bind(ServerConfig {
        unrealcv: Some(arguments.unrealcv),
        typed: Some(arguments.typed),
        token: Token::from_environment(TOKEN)?,
        pace: if arguments.pace == 0.0 { Pace::Lockstep } else { Pace::RealTime(arguments.pace) },
        camera: overlooking(&city),
        ..ServerConfig::default()
    })?;
    for (name, address) in
        [("UnrealCV", server.unrealcv_address()), ("typed protocol", server.typed_address())]
    {
        if let Some(address) = address {
            println!("{name}: {address}");
        }
    }
    end_later(&server, arguments.seconds)?;
    let mut stage = SimulationStage::new(city);
    match RenderEye::new() {
        Ok(eye) => {
            println!("pictures are drawn on {}", eye.adapter());
            stage = stage.seen_by(Box::new(eye));
        }
        Err(error) => println!("without pictures: {error}"),
    }
    let report = server.run(&mut stage)?;
    println!("{} steps, {} requests; clients: {:?}", report.steps, report.requests, report.partings);
    if let Some(path) = &arguments.record {
        write(path, &Session { settings, recording: stage.recording() })?;
        println!("recorded to {}", path.display());
    }
    Ok(())
}

/// The first camera stands on the first road, at the height of a driver's eyes, and looks along it.
fn overlooking(city: &Simulation) -> CameraPlace {
    let road = city.world().roads().and_then(|roads| roads.roads.first());
    let (at, heading) = road.map_or_else(Default::default, |road| polyline::at(&road.centerline, 5.0));
    let pose = pose_facing(Point3::new(at.x, at.y, 2.5), heading);
    CameraPlace { mount: Mount::Free(pose), ..CameraPlace::default() }
}

/// Lets the server end by Ctrl-C, or after some time.
fn end_later(server: &Server, seconds: Option<f64>) -> Outcome<()> {
    let stopper = server.stopper();
    ctrlc::set_handler(move || stopper.stop())?;
    if let Some(seconds) = seconds {
        if !(0.0..=1e6).contains(&seconds) {
            return Err(format!("--seconds {seconds}: give 0 to 1000000").into());
        }
        let stopper = server.stopper();
        std::thread::spawn(move || {
            std::thread::sleep(Duration::from_secs_f64(seconds));
            stopper.stop();
        });
    }
    Ok(())
}

fn read(path: &Path) -> Result<Session, ServedError> {
    let file = |source| ServedError::File { path: path.to_owned(), source };
    let bytes = std::fs::read(path).map_err(file)?;
    serde_json::from_slice(&bytes).map_err(|source| ServedError::Session { path: path.to_owned(), source })
}

fn write(path: &Path, session: &Session) -> Result<(), ServedError> {
    let bytes = serde_json::to_vec(session)
        .map_err(|source| ServedError::Session { path: path.to_owned(), source })?;
    std::fs::write(path, bytes).map_err(|source| ServedError::File { path: path.to_owned(), source })
}
