//! A whole place by words: say what it is to be like, and see it.
//!
//! ```sh
//! cargo run --release --example scene
//! cargo run --release --example scene -- --words "a village of thirty houses by a river, in the fog" --out out/village
//! cargo run --release --example scene -- --words "a city of 300 houses with an old town in the middle, factories in the east and a cathedral" --out out/city
//! cargo run --release --example scene -- --words "a wooded island with a fishing village and a lighthouse" --out out/island
//! cargo run --release --example scene -- --words "a wilderness with mountains, a lake and a hut" --out out/wild
//! cargo run --release --example scene -- --spec out/scene/scene.toml
//! ```

use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::Duration;

use clap::Parser;
use simworld_agents::model::{OpenAiChat, OpenAiConfig};
use simworld_agents::scenes::{GrammarSceneReader, SceneReader, SceneReading};
use simworld_agents::thought::ModelSceneReader;
use simworld_citygen::landscape::Landscape;
use simworld_citygen::settlement::Settlement;
use simworld_core::geometry::Point2;
use simworld_core::net::polyline;
use simworld_core::scene::{EntityKind, Scene, World};
use simworld_core::seed::Seed;
use simworld_core::spec::{SceneKind, SceneSpec};
use simworld_examples::edit::{Plan, View};
use simworld_examples::timing::timed;
use simworld_examples::{Outcome, exit_code};

/// Makes a place from a sentence or a file: how many houses, how its streets are, what it has, and its weather. A city, a
/// countryside, a wilderness or an island.
///
/// Writes scene.toml (what was understood, to be changed by hand and given back with --spec), plan.svg, of a city city.simcity
/// (streets and houses, for --city of other examples) and, with a graphics adapter, scene.png. What was not understood is said.
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
        read_spec(path)?
    } else {
        let reading = read(arguments)?;
        if !reading.unread.is_empty() {
            println!("not understood: {}", reading.unread.join(", "));
        }
        for remark in &reading.remarks {
            println!("{remark}");
        }
        reading.spec
    };
    simworld_examples::folder::make_folder(&arguments.out)?;
    std::fs::write(arguments.out.join("scene.toml"), toml::to_string(&spec)?)?;
    let mut world = World::new();
    if spec.kind == SceneKind::City {
        let place = Settlement::build(&spec, Seed(arguments.seed))?;
        place.city.save(&arguments.out.join("city.simcity"))?;
        place.populate(&mut world)?;
        tell(&spec, &place, &world);
    } else {
        let (place, built) = timed(|| Landscape::build(&spec, Seed(arguments.seed)));
        let place = place?;
        let (populated, peopled) = timed(|| place.populate(&mut world));
        populated?;
        tell_land(&place, &world, [built, built + peopled]);
    }
    draw(arguments, &spec, &world)
}

/// A spec from a file, or which file it is that is none.
fn read_spec(path: &Path) -> Outcome<SceneSpec> {
    let text = std::fs::read_to_string(path).map_err(|error| {
        format!("{}: {error}; give --spec a scene.toml that this example wrote", path.display())
    })?;
    Ok(toml::from_str(&text).map_err(|error| format!("{}: {error}", path.display()))?)
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
    for landmark in &place.landmarks {
        println!("{}, {:.0} m east and {:.0} m north", landmark.name, landmark.middle.x, landmark.middle.y);
    }
    for district in &place.city.config.zoning.districts {
        let houses = place.city.buildings.iter().filter(|building| district.form.holds(building.center));
        println!("{} houses: {} district", houses.count(), district.kind.as_str().replace('_', " "));
    }
    for remark in &place.remarks {
        println!("{remark}");
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

fn tell_land(place: &Landscape, world: &World, [built, placed]: [Duration; 2]) {
    let (low, high) = place.ground.extent();
    let heights = &place.ground.data().heights;
    let highest = heights.iter().copied().fold(f32::NEG_INFINITY, f32::max);
    println!(
        "{:.0} by {:.0} m of land and water, up to {highest:.0} m; {} buildings",
        high.x - low.x,
        high.y - low.y,
        place.buildings().count()
    );
    let trails: f64 = place.network.footpaths.iter().map(|way| polyline::length(&way.path)).sum();
    let roads = place
        .network
        .roads
        .iter()
        .map(|road| polyline::length(&road.centerline))
        .fold(0.0, |all, length| all + length);
    println!("{roads:.0} m of road, {trails:.0} m of ways for walkers");
    for area in &place.areas {
        println!("{} ({})", area.name, area.used_as);
    }
    let trees = world.iter().filter(|entity| entity.kind == EntityKind::Tree).count();
    println!(
        "{trees} trees of {} things; made in {:.2} s, in the world after {:.2} s",
        place.things.len(),
        built.as_secs_f64(),
        placed.as_secs_f64()
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
    // All of the land, if the place has some.
    let (middle, reach) = world.ground().map_or((middle, reach), |land| {
        let (low, high) = land.extent();
        (nalgebra::center(&low, &high), (high - low).max() * 0.5)
    });
    // The words are those of the default where a spec is made.
    let asked = if arguments.spec.is_some() { spec.kind.as_str() } else { &arguments.words };
    let title = spec.title.as_deref().unwrap_or(asked);
    let plan = Plan { middle, reach, title, touched: &[], placings: &[] };
    std::fs::write(arguments.out.join("plan.svg"), plan.draw(world).to_string())?;
    match View::new() {
        Ok(mut view) => view.write(
            world,
            middle,
            reach * if world.ground().is_some() { 1.15 } else { 1.5 },
            &arguments.out.join("scene.png"),
        )?,
        Err(reason) => eprintln!("a plan alone: {reason}"),
    }
    println!("written to {}", arguments.out.display());
    Ok(())
}
