//! Citygen alone: a city, its statistics, its map to print, and files for other programs.
//!
//! ```sh
//! cargo run --release --example city
//! cargo run --release --example city -- --style organic --size 3km --seed 7 --out city/
//! cargo run --release --example city -- --osm monaco.osm.gz --out monaco/
//! cargo run --release --example city -- --opendrive town.xodr --out town/
//! ```

use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use clap::{Parser, ValueEnum};
use indicatif::{HumanBytes, ProgressBar, ProgressStyle};
use simworld_citygen::map::MapDrawing;
use simworld_citygen::{City, Style};
use simworld_core::seed::Seed;
use simworld_examples::city::{Format, Interrupt, Size, Source, export, make};
use simworld_examples::exit_code;

/// Makes a city and writes it down: its statistics to the terminal, maps and files to a folder.
///
/// The same settings and seed give the same files, byte for byte. Ctrl-C stops; no file is left half-written.
#[derive(Parser)]
#[command(version)]
struct Arguments {
    /// Seed of the city.
    #[arg(long, default_value_t = 7)]
    seed: u64,
    /// Style of the streets: grid, mixed, organic or suburb.
    #[arg(long, default_value_t = Style::Mixed)]
    style: Style,
    /// How far the city reaches from one side to the other, such as 800m or 3km.
    #[arg(long, default_value = "1.5km")]
    size: Size,
    /// A real place: an extract of OpenStreetMap, `.osm`, `.osm.gz` or `.osm.pbf`.
    #[arg(long, value_name = "FILE", group = "source")]
    osm: Option<PathBuf>,
    /// The roads of an OpenDRIVE file, `.xodr`.
    #[arg(long, value_name = "FILE", group = "source")]
    opendrive: Option<PathBuf>,
    /// Roads from a `roads.json` of the Python release instead of grown ones.
    #[arg(long, value_name = "ROADS.json", group = "source")]
    roads: Option<PathBuf>,
    /// A saved city, to write it down anew.
    #[arg(long, value_name = "FILE.simcity", group = "source")]
    city: Option<PathBuf>,
    /// The folder to write to; files of a city there are replaced.
    #[arg(long, value_name = "DIR", default_value = "out/city")]
    out: PathBuf,
    /// What to write, separated by commas.
    #[arg(long, value_delimiter = ',', default_value = "svg,png,glb,saved")]
    formats: Vec<Kind>,
    /// The title of the map.
    #[arg(long)]
    title: Option<String>,
    /// Width of the PNG map, pixels, in [16, 20000].
    #[arg(long, value_name = "PIXELS", default_value_t = 2400)]
    png_width: u32,
}

/// What can be written.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Kind {
    /// map.svg, to print.
    Svg,
    /// map.png, to look at.
    Png,
    /// city.glb, the city in 3D.
    Glb,
    /// city.simcity, the city without loss, for `--city` of this and other examples.
    Saved,
    /// city.geojson, for geographic programs.
    Geojson,
    /// city.net.xml, the roads for SUMO.
    Sumo,
    /// city.xodr, the roads for driving simulators (OpenDRIVE 1.7).
    Opendrive,
    /// python/, the layout and world files of the Python release.
    Python,
    /// All of these.
    All,
}

impl Kind {
    fn formats(self) -> Vec<Format> {
        match self {
            Self::Svg => vec![Format::Svg],
            Self::Png => vec![Format::Png],
            Self::Glb => vec![Format::Glb],
            Self::Saved => vec![Format::Saved],
            Self::Geojson => vec![Format::GeoJson],
            Self::Sumo => vec![Format::Sumo],
            Self::Opendrive => vec![Format::OpenDrive],
            Self::Python => vec![Format::Python],
            Self::All => Format::ALL.to_vec(),
        }
    }
}

type Fault = Box<dyn std::error::Error>;

fn main() -> ExitCode {
    exit_code(job(&Arguments::parse()))
}

fn job(arguments: &Arguments) -> Result<(), Fault> {
    let (interrupt, writing) = stop_on_interrupt()?;
    let bar =
        ProgressBar::new_spinner().with_style(ProgressStyle::with_template("{spinner} {msg} {elapsed}")?);
    bar.enable_steady_tick(Duration::from_millis(100));

    bar.set_message("making the city");
    let made = make(&source(arguments), Seed(arguments.seed))?;
    let mut city = made.city;
    if arguments.title.is_some() {
        city.provenance.title.clone_from(&arguments.title);
    }
    bar.suspend(|| {
        tell(&city, &made.warnings);
        if let Some(style) = city.provenance.style {
            compare(&city, style);
        }
    });

    writing.store(true, Ordering::Relaxed);
    let map = MapDrawing::of(&city).to_string();
    let mut formats: Vec<Format> = arguments.formats.iter().flat_map(|kind| kind.formats()).collect();
    formats.sort_unstable();
    formats.dedup();
    for format in formats {
        bar.set_message(format!("writing {}", format.files()[0]));
        let written = export(&city, format, &map, arguments.png_width, &arguments.out, &interrupt)?;
        bar.suspend(|| {
            for file in written {
                println!("{:>10}  {}", HumanBytes(file.bytes).to_string(), file.path.display());
            }
        });
    }
    bar.finish_and_clear();
    Ok(())
}

/// Before the first file is begun, Ctrl-C ends the program; after that it leaves out the file that is being written.
fn stop_on_interrupt() -> Result<(Interrupt, Arc<AtomicBool>), ctrlc::Error> {
    let (interrupt, writing) = (Interrupt::default(), Arc::new(AtomicBool::new(false)));
    let (asked, has_begun) = (interrupt.clone(), Arc::clone(&writing));
    ctrlc::set_handler(move || {
        if !has_begun.load(Ordering::Relaxed) {
            // The shell's number for a program ended by Ctrl-C.
            std::process::exit(130);
        }
        asked.ask();
    })?;
    Ok((interrupt, writing))
}

fn source(arguments: &Arguments) -> Source {
    // One of them at most: they are a group.
    let saved = arguments.city.clone().map(Source::Saved);
    let place = arguments.osm.clone().map(Source::Osm);
    let driven = arguments.opendrive.clone().map(Source::OpenDrive);
    let roads = arguments.roads.clone().map(Source::Roads);
    saved.or(place).or(driven).or(roads).unwrap_or(Source::Grown(arguments.style, arguments.size))
}

fn tell(city: &City, warnings: &[String]) {
    const SHOWN: usize = 10;
    for warning in warnings.iter().take(SHOWN) {
        eprintln!("warning: {warning}");
    }
    if warnings.len() > SHOWN {
        eprintln!("warning: and {} more", warnings.len() - SHOWN);
    }
    println!("{}\n", city.report());
}

/// Marks every statistic in or out of the band of its style.
fn compare(city: &City, style: Style) {
    println!("{style} streets of real places:");
    for (name, value, range, inside) in style.band().check(&city.report().streets) {
        let mark = if inside { "in " } else { "OUT" };
        println!("  {mark} {name:<22} {value:>8.3}   {} to {}", range.start(), range.end());
    }
    println!();
}
