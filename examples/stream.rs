//! Drives through a city without end: tiles come into reach ahead and are let go behind. Prints how fast they are made and
//! how much is held, and draws what was seen.
//!
//! `cargo run --release --example stream -- --style organic --km 20 --out stream.svg`

use std::error::Error;
use std::fmt::Write as _;
use std::path::PathBuf;
use std::time::Instant;

use clap::Parser;
use simworld_citygen::Style;
use simworld_citygen::tile::{CityStream, StreamConfig, Tile, TileConfig, TileSource, WorldStream};
use simworld_core::geometry::{Point2, direction};
use simworld_core::net::RoadClass;
use simworld_core::scene::World;
use simworld_core::seed::Seed;

/// Drives through a city without end, prints how fast its tiles are made, and draws what was seen.
#[derive(Parser)]
struct Args {
    /// grid, mixed, organic or suburb
    #[arg(long, default_value_t)]
    style: Style,
    /// Length of the drive, km, from 0.1 to 1000
    #[arg(long, default_value_t = 20.0, value_parser = kilometres)]
    km: f64,
    /// How far one sees, m
    #[arg(long, default_value_t = 600.0)]
    reach: f64,
    /// Seed of the city
    #[arg(long, default_value_t = 7)]
    seed: u64,
    /// The picture
    #[arg(long, default_value = "stream.svg")]
    out: PathBuf,
}

fn kilometres(text: &str) -> Result<f64, String> {
    let km = text.parse::<f64>().map_err(|error| error.to_string())?;
    if (0.1..=1000.0).contains(&km) { Ok(km) } else { Err("give 0.1 to 1000 km".to_owned()) }
}

#[allow(clippy::disallowed_methods, reason = "the drive is timed for the report only")]
fn main() -> Result<(), Box<dyn Error>> {
    let args = Args::parse();
    let source = TileSource::new(TileConfig::of_style(args.style), Seed(args.seed))?;
    let stream = CityStream::new(source, StreamConfig { reach: args.reach, slack: 500.0 })?;
    let (mut city, mut world) = (WorldStream::new(stream), World::new());
    let (mut tiles, mut things, mut most, mut drawing) = (0, 0, (0, 0), String::new());
    let start = Instant::now();
    for step in 0..=(args.km * 10.0) as u32 {
        let here = Point2::origin() + direction(0.12) * (f64::from(step) * 100.0);
        let changes = city.move_to(here, &mut world)?;
        for tile in &changes.entered {
            (tiles, things) = (tiles + 1, things + tile.buildings.len() + tile.elements.len());
            draw(tile, &mut drawing)?;
        }
        most = (most.0.max(city.stream().tiles().count()), most.1.max(world.len()));
    }
    let seconds = start.elapsed().as_secs_f64();
    println!("{} km of a {} city in {seconds:.2} s", args.km, args.style);
    println!(
        "{tiles} tiles made, {:.0} a second, with entering and leaving the world",
        f64::from(tiles) / seconds
    );
    println!("{things} buildings and elements seen; at most {} tiles and {} entities held", most.0, most.1);
    println!("memory of the program: {}", memory().unwrap_or_else(|| "unknown here".to_owned()));
    let (end, reach) = (direction(0.12) * (args.km * 1000.0), args.reach + 1200.0);
    let view = (-reach, -end.y - reach, end.x + 2.0 * reach, end.y + 2.0 * reach);
    let svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{:.0} {:.0} {:.0} {:.0}\" width=\"2400\">\
         <rect x=\"{0:.0}\" y=\"{1:.0}\" width=\"100%\" height=\"100%\" fill=\"#dfe3d3\"/>{drawing}\
         <path d=\"M0 0L{:.0} {:.0}\" stroke=\"#c0392b\" stroke-width=\"25\"/></svg>",
        view.0, view.1, view.2, view.3, end.x, -end.y
    );
    std::fs::write(&args.out, svg)?;
    println!("{}", args.out.display());
    Ok(())
}

/// Streets as lines and buildings as their outlines, to the metre.
fn draw(tile: &Tile, svg: &mut String) -> std::fmt::Result {
    for (class, color, width) in [(RoadClass::Local, "#fff", 12), (RoadClass::Arterial, "#f3cf7c", 18)] {
        write!(svg, "<path fill=\"none\" stroke=\"{color}\" stroke-width=\"{width}\" d=\"")?;
        for street in tile.plan.streets[..tile.extent.streets].iter().filter(|street| street.class == class) {
            line(&tile.plan.centerline(street), svg)?;
        }
        svg.push_str("\"/>");
    }
    svg.push_str("<path fill=\"#b9a98c\" d=\"");
    tile.buildings.iter().try_for_each(|building| line(&building.outline(), svg))?;
    svg.push_str("\"/>");
    Ok(())
}

fn line(points: &[Point2], svg: &mut String) -> std::fmt::Result {
    points.iter().enumerate().try_for_each(|(index, point)| {
        write!(svg, "{}{:.0} {:.0}", if index == 0 { 'M' } else { 'L' }, point.x, -point.y)
    })
}

/// The resident memory, where the system tells (Linux).
fn memory() -> Option<String> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    Some(format!("at most {}", line.trim_start_matches("VmHWM:").trim()))
}
