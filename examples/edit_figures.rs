//! Every figure that is claimed of worlds by words, measured here and now, beside its bar.
//!
//! ```sh
//! cargo run --release --example edit_figures
//! ```

use std::process::ExitCode;
use std::time::Duration;

use clap::{Parser, ValueEnum};
use comfy_table::Table;
use comfy_table::presets::UTF8_FULL_CONDENSED;
use simworld_agents::assets::{ImportConfig, Thing, export_glb, import_glb, read_glb};
use simworld_agents::editing::SceneEditor;
use simworld_agents::retrieval::AssetIndex;
use simworld_citygen::{City, CityConfig};
use simworld_core::asset::{Asset, Catalogue, Model, ModelPart, ModelVertex};
use simworld_core::ops;
use simworld_core::scene::World;
use simworld_core::seed::Seed;
use simworld_examples::timing::{median, micros, timed};
use simworld_examples::{Outcome, exit_code};

/// Measures the figures of worlds by words and prints each beside its bar.
#[derive(Parser)]
#[command(version)]
struct Arguments {
    /// Assets that are searched.
    #[arg(long, default_value_t = 10_000, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    assets: u32,
    /// Things in the city that is edited, at least.
    #[arg(long, default_value_t = 100_000, value_parser = clap::value_parser!(u32).range(1000..=1_000_000))]
    things: u32,
    /// Only this part.
    #[arg(long)]
    only: Option<Part>,
}

/// A part of the figures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Part {
    /// Assets found by words.
    Retrieval,
    /// Sentences carried out.
    Edits,
    /// A model from a file to an asset.
    Import,
}

/// What is asked for: names, synonyms, descriptions, and what is not there.
const QUERIES: &[&str] = &[
    "park bench",
    "sofa",
    "a red telephone kiosk",
    "tree with pink blossom",
    "trolley for the supermarket",
    "high office building with a clock tower",
    "a wooden table for a garden",
    "lorry",
    "dragon",
    "a thing to sit on made of stone",
    "red brick residential building with a fire escape",
];

fn main() -> ExitCode {
    exit_code(job(&Arguments::parse()))
}

fn job(arguments: &Arguments) -> Outcome<()> {
    let mut table = Table::new();
    table.load_style(UTF8_FULL_CONDENSED);
    table.set_header(["what", "measured", "bar"]);
    let wants = |part: Part| arguments.only.is_none_or(|only| only == part);
    if wants(Part::Retrieval) {
        retrieval(arguments.assets as usize, &mut table)?;
    }
    if wants(Part::Edits) {
        edits(arguments.things as usize, &mut table)?;
    }
    if wants(Part::Import) {
        import(&mut table)?;
    }
    println!("{table}");
    Ok(())
}

/// The library over and over, until there are so many, each time under another name and with a word of its own.
fn many(count: usize) -> Outcome<Catalogue> {
    let library = Catalogue::library();
    let mut catalogue = Catalogue::new();
    for index in 0..count {
        let round = index / library.len();
        let (_, asset) = library.iter().nth(index % library.len()).ok_or("the library is empty")?;
        let asset = match round {
            0 => asset.clone(),
            round => {
                let name = format!("{}_of_series_{round}", asset.name);
                Asset { name, ..asset.clone() }.tagged([format!("series{round}")])
            }
        };
        catalogue.add(asset)?;
    }
    Ok(catalogue)
}

fn retrieval(count: usize, table: &mut Table) -> Outcome<()> {
    let catalogue = many(count)?;
    let (index, built) = timed(|| AssetIndex::of(&catalogue));
    let mut times = Vec::new();
    for words in QUERIES {
        let time = median(51, || index.retrieve(words, 10));
        let first =
            index.retrieve(words, 1).first().map_or_else(|| "nothing".to_owned(), |hit| hit.name.clone());
        println!("{:>10}  {words}: {first}", micros(time));
        times.push(time);
    }
    times.sort_unstable();
    let (middle, worst) = (times[times.len() / 2], times[times.len() - 1]);
    table.add_row([
        format!("ten of {} assets by words, median of {} queries", catalogue.len(), QUERIES.len()),
        format!("{} (slowest {}; index built in {})", micros(middle), micros(worst), micros(built)),
        "1000 µs".to_owned(),
    ]);
    Ok(())
}

/// What is asked of a large city: definite things, relations, rows, streets, colours, weather; each is taken back.
const SENTENCES: &[&str] = &[
    "add a red sports car next to the nearest hospital",
    "put a bench in front of the nearest museum",
    "add three trees near the nearest school",
    "paint the nearest car blue",
    "remove the bench nearest to the nearest restaurant",
    "put a trash bin between the nearest bench and the nearest tree",
    "move the nearest trash bin next to the nearest street lamp",
    "add a cone 10 metres north of the nearest bench",
    "rotate the nearest bench 90 degrees",
    "close the nearest road",
    "make it a foggy evening with light rain",
    "put five cones along the nearest building",
    "put a sign near the museum closest to a school",
];

/// What no grammar reads, and all parts of which are tried before that is said.
const NOT_UNDERSTOOD: &[&str] = &[
    "the council would be over the moon about something along the lines of what they have in Vienna",
    "we promised the neighbours that whatever stands between the school and the museum gets what it deserves, and soon",
    "so the thing that's in the way near the bench yeah you know what to do about it, and the other one as well",
    "customers never know where to put their bikes, so sort that in the way that the shop on the corner did, only bluer",
    "could the bench be less of a bench and more of an idea, and the car next to the tree what it was last week",
];

/// Sentences to committed commands in a city of so many things.
fn edits(least: usize, table: &mut Table) -> Outcome<()> {
    let mut world = World::new();
    let mut roads = (least / 60).max(12) as u32;
    while world.len() < least {
        world = World::new();
        City::generate(&CityConfig::with_roads(roads), Seed(7))?.populate(&mut world)?;
        roads += roads / 4 + 1;
    }
    let mut editor = SceneEditor::new(Seed(7));
    // The first sentence files the streets.
    let (first, filed) = timed(|| editor.say(SENTENCES[0], &mut world));
    first?;
    editor.undo(&mut world)?;
    let mut times = Vec::new();
    for words in SENTENCES {
        let mut own = Vec::new();
        for _ in 0..21 {
            let (done, time) = timed(|| editor.say(words, &mut world));
            done.map_err(|error| format!("{words}: {error}"))?;
            editor.undo(&mut world)?;
            own.push(time);
        }
        times.push(middle_of(words, own));
    }
    times.sort_unstable();
    table.add_row([
        format!("an edit among {} things, words to commands, median of {}", world.len(), SENTENCES.len()),
        format!(
            "{} (slowest {}; the first, which files the streets, {})",
            micros(times[times.len() / 2]),
            micros(times[times.len() - 1]),
            micros(filed)
        ),
        "2000 µs".to_owned(),
    ]);
    not_understood(&mut editor, &mut world, table)
}

/// The median of how long a sentence took, which is printed with it.
fn middle_of(words: &str, mut times: Vec<Duration>) -> Duration {
    times.sort_unstable();
    let middle = times[times.len() / 2];
    println!("{:>10}  {words}", micros(middle));
    middle
}

/// How soon it is said that a sentence is not understood.
fn not_understood(editor: &mut SceneEditor, world: &mut World, table: &mut Table) -> Outcome<()> {
    let mut times = Vec::new();
    for words in NOT_UNDERSTOOD {
        let mut own = Vec::new();
        for _ in 0..5 {
            let (answer, time) = timed(|| editor.say(words, world));
            if let Ok(edited) = answer {
                return Err(format!("{words}: was understood as {:?}", edited.edits).into());
            }
            own.push(time);
        }
        times.push(middle_of(words, own));
    }
    times.sort_unstable();
    table.add_row([
        format!("a sentence that is not understood, median of {}", NOT_UNDERSTOOD.len()),
        format!("{} (slowest {})", micros(times[times.len() / 2]), micros(times[times.len() - 1])),
        "none".to_owned(),
    ]);
    Ok(())
}

/// A statue of 50,000 triangles: a closed ball with dents, which takes all its convex solids.
fn import(table: &mut Table) -> Outcome<()> {
    let file = export_glb(&dented_ball(112));
    let thing = Thing { name: "statue".into(), words: "a statue".into(), ..Thing::default() };
    let config = ImportConfig::default();
    let imported = import_glb(&file, &thing, &config)?;
    let triangles = imported.asset.model.as_ref().map_or(0, |model| model.triangles.len());
    let (read, both) =
        (median(5, || read_glb(&file, &config.limits)), median(5, || import_glb(&file, &thing, &config)));
    table.add_row([
        format!(
            "a GLB file of {triangles} triangles to an asset of {} convex solids, {:.2} m³",
            imported.report.hulls, imported.report.volume
        ),
        format!("{:.2} s (reading {:.3} s)", both.as_secs_f64(), read.as_secs_f64()),
        "3 s".to_owned(),
    ]);
    Ok(())
}

/// A closed surface of rings of twice as many steps, 2 m high, with five dents around and three from pole to pole.
fn dented_ball(rings: u32) -> Model {
    let around = rings * 2;
    let vertex = |ring: u32, step: u32| {
        let (out, up) = ops::sin_cos(std::f64::consts::PI * f64::from(ring) / f64::from(rings));
        let turn = std::f64::consts::TAU * f64::from(step) / f64::from(around);
        let (side, ahead) = ops::sin_cos(turn);
        let reach = 1.0 + 0.3 * ops::sin(5.0 * turn) * out * ops::sin(3.0 * up);
        let position = [out * ahead * reach, out * side * reach, up].map(|part| part as f32);
        ModelVertex { position, color: [0.5; 3], ..ModelVertex::default() }
    };
    let mut vertices = vec![vertex(0, 0), vertex(rings, 0)];
    vertices.extend(
        (1..rings).flat_map(|ring| (0..around).map(move |step| (ring, step))).map(|(r, s)| vertex(r, s)),
    );
    let at = |ring: u32, step: u32| 2 + (ring - 1) * around + step % around;
    let mut triangles = Vec::new();
    for step in 0..around {
        triangles.push([0, at(1, step), at(1, step + 1)]);
        triangles.push([1, at(rings - 1, step + 1), at(rings - 1, step)]);
        for ring in 1..rings - 1 {
            let [a, b] = [at(ring, step), at(ring + 1, step)];
            let [c, d] = [at(ring + 1, step + 1), at(ring, step + 1)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    let parts =
        vec![ModelPart { name: "stone".into(), triangles: triangles.len() as u32, ..ModelPart::default() }];
    Model { vertices, triangles, parts, ..Model::default() }
}
