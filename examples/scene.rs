//! A whole place by words: say what it is to be like, and see it.
//!
//! ```sh
//! cargo run --release --example scene
//! cargo run --release --example scene -- --words "a village of thirty houses by a river, in the fog" --out out/village
//! cargo run --release --example scene -- --spec out/scene/scene.toml
//! ```

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use simworld_agents::model::{OpenAiChat, OpenAiConfig};
use simworld_agents::scenes::{GrammarSceneReader, SceneReader, SceneReading};
use simworld_agents::thought::ModelSceneReader;
use simworld_citygen::settlement::Settlement;
use simworld_core::geometry::Point2;
use simworld_core::scene::{EntityKind, World};
use simworld_core::seed::Seed;
use simworld_core::spec::SceneSpec;
use simworld_examples::edit::{Plan, View};
use simworld_examples::{Outcome, exit_code};

/// Makes a place from a sentence or a file: how many houses, how its streets are, what it has, and its weather.
///
/// Writes scene.toml (what was understood, to be changed by hand and given back with --spec), plan.svg, city.simcity (streets and
/// houses, for --city of other examples) and, with a graphics adapter, scene.png. What was not understood is said.
#[derive(Parser)]
#[command(version)]
struct Arguments {
    /// What the place is to be like.
    #[arg(
        long,
        value_name = "SENTENCE",
        default_value = "a small harbour town with narrow streets, fifty buildings, a market square and light rain"
    )]
    words: String,
    /// A spec to make instead, as this example writes it.
    #[arg(long, value_name = "FILE.toml")]
    spec: Option<PathBuf>,
    /// Seed of everything that the words leave open.
    #[arg(long, default_value_t = 7)]
    seed: u64,
    /// Reads the sentence with a language model behind this OpenAI-compatible address (http or https) instead of the grammar.
    #[arg(long, value_name = "URL")]
    model: Option<String>,
    /// The model's name, where the server has several.
    #[arg(long, value_name = "NAME", default_value = "model")]
    model_name: String,
    /// The folder to write to.
    #[arg(long, value_name = "DIR", default_value = "out/scene")]
    out: PathBuf,
}

fn main() -> ExitCode {
    exit_code(job(&Arguments::parse()))
}

fn job(arguments: &Arguments) -> Outcome<()> {
    let spec = if let Some(path) = &arguments.spec {
        toml::from_str(&std::fs::read_to_string(path)?)?
    } else {
        let reading = read(arguments)?;
        if !reading.unread.is_empty() {
            println!("not understood: {}", reading.unread.join(", "));
        }
        reading.spec
    };
    let place = Settlement::build(&spec, Seed(arguments.seed))?;
    std::fs::create_dir_all(&arguments.out)?;
    std::fs::write(arguments.out.join("scene.toml"), toml::to_string(&spec)?)?;
    place.city.save(&arguments.out.join("city.simcity"))?;
    let mut world = World::new();
    place.populate(&mut world)?;
    tell(&spec, &place, &world);
    draw(arguments, &spec, &world)
}

fn read(arguments: &Arguments) -> Outcome<SceneReading> {
    let Some(url) = &arguments.model else { return Ok(GrammarSceneReader.read_scene(&arguments.words)?) };
    let config = OpenAiConfig {
        base_url: url.clone(),
        model: arguments.model_name.clone(),
        ..OpenAiConfig::default()
    };
    Ok(ModelSceneReader::new(Box::new(OpenAiChat::new(config)?)).read_scene(&arguments.words)?)
}

fn tell(spec: &SceneSpec, place: &Settlement, world: &World) {
    let roads = &place.city.network.roads;
    let width = roads.iter().map(|road| road.width).sum::<f64>() / roads.len().max(1) as f64;
    println!(
        "{} buildings on {} pieces of street, {width:.1} m wide",
        place.city.buildings.len(),
        roads.len()
    );
    for area in &place.areas {
        println!("{} ({}), {:.0} by {:.0} m", area.name, area.used_as, area.size.x, area.size.y);
    }
    for (used_as, count) in &spec.features.places {
        let have = place.city.buildings.iter().filter(|building| building.place == *used_as).count();
        println!("{have} of {count}: {used_as}");
    }
    let trees = world.iter().filter(|entity| entity.kind == EntityKind::Tree).count();
    let weather = spec.environment.weather;
    println!(
        "{trees} trees; rain {} mm/h, snow {} mm/h, {:.0} m to be seen",
        weather.rain, weather.snow, weather.visibility
    );
}

fn draw(arguments: &Arguments, spec: &SceneSpec, world: &World) -> Outcome<()> {
    let (low, high) =
        world.iter().filter(|entity| entity.kind == EntityKind::Building || entity.info.name.is_some()).fold(
            (Point2::new(f64::INFINITY, f64::INFINITY), Point2::new(f64::NEG_INFINITY, f64::NEG_INFINITY)),
            |(low, high), entity| {
                let (min, max) = (entity.bounds.min.xy(), entity.bounds.max.xy());
                (low.inf(&min), high.sup(&max))
            },
        );
    let middle = Point2::from((low.coords + high.coords) * 0.5);
    let reach = ((high - low).max() * 0.5 + 10.0).max(50.0);
    let title = spec.title.as_deref().unwrap_or(&arguments.words);
    let plan = Plan { middle, reach, title, touched: &[], placings: &[] };
    std::fs::write(arguments.out.join("plan.svg"), plan.draw(world).to_string())?;
    match View::new() {
        Ok(mut view) => view.write(world, middle, reach * 1.5, &arguments.out.join("scene.png"))?,
        Err(reason) => eprintln!("a plan alone: {reason}"),
    }
    println!("written to {}", arguments.out.display());
    Ok(())
}
