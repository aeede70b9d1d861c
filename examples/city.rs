//! Citygen alone: a grown city, its map and its statistics.
//!
//! ```sh
//! cargo run --release --example city -- --roads 200 --out city.svg
//! ```

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use simworld_citygen::{City, CityConfig};
use simworld_core::seed::Seed;

/// Grows a city and draws its map.
#[derive(Parser)]
struct Arguments {
    /// Seed of the city.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Number of street segments.
    #[arg(long, default_value_t = 40)]
    roads: u32,
    /// The map to write.
    #[arg(long, default_value = "out/city.svg")]
    out: PathBuf,
    /// Also writes the streets as a roads.json of the Python release.
    #[arg(long, value_name = "ROADS.json")]
    roads_file: Option<PathBuf>,
}

fn main() -> ExitCode {
    match job(&Arguments::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn job(arguments: &Arguments) -> Result<(), Box<dyn std::error::Error>> {
    let city = City::generate(&CityConfig::with_roads(arguments.roads), Seed(arguments.seed))?;
    if let Some(folder) = arguments.out.parent() {
        std::fs::create_dir_all(folder)?;
    }
    std::fs::write(&arguments.out, city.svg())?;
    if let Some(path) = &arguments.roads_file {
        std::fs::write(path, simworld_citygen::python::write(&city.roads_file()))?;
    }
    println!("{}", city.report());
    println!("drawn to {}", arguments.out.display());
    Ok(())
}
