//! Say how the city is to change, and see it before and after.
//!
//! ```sh
//! cargo run --release --example edit
//! cargo run --release --example edit -- --say "add a red sports car next to the nearest hospital" --say undo
//! cargo run --release --example edit -- --scene examples/assets/scenes/harbour.scene.toml --say "put a bin next to the fountain"
//! cargo run --release --example edit -- --library examples/assets/harbour --say "put a buoy next to a bench"
//! cargo run --release --example edit -- --generator offline --say "put a tall three-legged wooden stool next to a bench"
//! cargo run --release --example edit -- --show-catalogue catalogue.svg
//! cargo run --release --example edit -- --show-made made.svg
//! ```

use std::io::{BufRead, IsTerminal, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;
use simworld_agents::assets::ImportConfig;
use simworld_agents::editing::{Difference, Edited, Placing, ReadBy, SceneEditor};
use simworld_agents::generation::{HunyuanConfig, HunyuanGenerator, ProceduralGenerator};
use simworld_agents::library::{LOCK, Library, LibraryLimits};
use simworld_agents::model::{OpenAiChat, OpenAiConfig};
use simworld_agents::scenes::file::SceneFile;
use simworld_agents::thought::ModelReader;
use simworld_core::asset::{Asset, Catalogue};
use simworld_core::clock::Clock;
use simworld_core::geometry::{Point2, planar};
use simworld_core::id::EntityId;
use simworld_core::scene::{Scene, World};
use simworld_core::seed::Seed;
use simworld_examples::city::{Source, make};
use simworld_examples::edit::{Plan, View, contact_sheet, made_sheet};
use simworld_examples::written::Written;
use simworld_examples::{Outcome, exit_code};

/// Type how the scene is to change: "put two benches in front of the school", "paint them blue", "make it a foggy evening".
///
/// Besides sentences: "undo", "redo", "why" (what was tried, and what spoke against it), "where else" (other places that
/// would do), "quit". The pictures before.svg, after.svg and why.svg are written as it goes and, with a graphics adapter,
/// before.png and after.png.
#[derive(Parser)]
#[command(version)]
struct Arguments {
    /// A saved city; without one a small one is grown.
    #[arg(long, value_name = "FILE.simcity")]
    city: Option<PathBuf>,
    /// A scene that is written by hand, in place of a city; docs/scenes.md has every key.
    #[arg(long, value_name = "FILE.scene.toml", conflicts_with = "city")]
    scene: Option<PathBuf>,
    /// Seed of the city and of where things are put; a scene that is written by hand has its own.
    #[arg(long, default_value_t = 7)]
    seed: u64,
    /// A sentence to carry out instead of reading from the terminal; may be given several times.
    #[arg(long, value_name = "SENTENCE")]
    say: Vec<String>,
    /// Asks a language model behind this OpenAI-compatible address (http or https) what the grammar does not understand.
    #[arg(long, value_name = "URL")]
    model: Option<String>,
    /// The model's name, where the server has several.
    #[arg(long, value_name = "NAME", default_value = "model")]
    model_name: String,
    /// Makes what no asset is: "offline" by a grammar of everyday things, or a server that speaks the protocol of Hunyuan3D-2 at this
    /// address (http or https).
    #[arg(long, value_name = "offline|URL", value_parser = maker)]
    generator: Option<Maker>,
    /// From where the scene is looked at, m east and north: what "here" and "the nearest" mean.
    #[arg(long, value_name = "X,Y", value_parser = point, default_value = "0,0", allow_hyphen_values = true)]
    from: Point2,
    /// Metres from the middle of a picture to its edge.
    #[arg(long, default_value_t = 40.0, value_parser = reach)]
    reach: f64,
    /// A folder of assets with a library.toml, beside those that come with simworld; may be given several times.
    #[arg(long, value_name = "DIR")]
    library: Vec<PathBuf>,
    /// Writes the library.lock of every such folder anew, before it is read.
    #[arg(long, requires = "library")]
    lock: bool,
    /// Draws everything that can be added into a picture, and does nothing else.
    #[arg(long, value_name = "FILE.svg")]
    show_catalogue: Option<PathBuf>,
    /// Draws one of everything that the offline generator makes from words into a picture, and does nothing else.
    #[arg(long, value_name = "FILE.svg")]
    show_made: Option<PathBuf>,
    /// The folder to write to.
    #[arg(long, value_name = "DIR", default_value = "out/edit")]
    out: PathBuf,
}

/// Who makes what no asset is.
#[derive(Clone, Debug)]
enum Maker {
    Offline,
    Server(String),
}

fn maker(text: &str) -> Result<Maker, String> {
    match text {
        "offline" => Ok(Maker::Offline),
        url if url.starts_with("http://") || url.starts_with("https://") => Ok(Maker::Server(url.to_owned())),
        _ => Err("give \"offline\", or an address such as http://127.0.0.1:8081".to_owned()),
    }
}

fn point(text: &str) -> Result<Point2, String> {
    let parts: Vec<f64> = text.split(',').filter_map(|part| part.trim().parse().ok()).collect();
    match parts[..] {
        [x, y] if x.is_finite() && y.is_finite() => Ok(Point2::new(x, y)),
        _ => Err("give two numbers with a comma between, such as 120,-40".to_owned()),
    }
}

fn reach(text: &str) -> Result<f64, String> {
    let reach: f64 = text.parse().map_err(|_| "give a number of metres".to_owned())?;
    if (5.0..=2000.0).contains(&reach) { Ok(reach) } else { Err("give 5 to 2000 m".to_owned()) }
}

fn main() -> ExitCode {
    exit_code(job(&Arguments::parse()))
}

/// What can be added: what comes with simworld, and the folders.
fn catalogue(arguments: &Arguments) -> Outcome<Catalogue> {
    let mut catalogue = Catalogue::library();
    for folder in &arguments.library {
        let lock = folder.join(LOCK);
        if arguments.lock && lock.exists() {
            std::fs::remove_file(&lock)?;
        }
        let library = Library::read(folder, &ImportConfig::default(), &LibraryLimits::default())?;
        if arguments.lock {
            std::fs::write(&lock, library.lock())?;
        }
        library.add_to(&mut catalogue)?;
        println!("{}: {} assets", library.name, library.assets.len());
    }
    Ok(catalogue)
}

fn job(arguments: &Arguments) -> Outcome<()> {
    let catalogue = catalogue(arguments)?;
    if let Some(path) = &arguments.show_catalogue {
        std::fs::write(path, contact_sheet(&catalogue).to_string())?;
        println!("{} assets in {}", catalogue.len(), path.display());
        return Ok(());
    }
    if let Some(path) = &arguments.show_made {
        std::fs::write(path, made_sheet()?.to_string())?;
        println!("What is made from words is in {}", path.display());
        return Ok(());
    }
    let (world, editor) = match &arguments.scene {
        Some(path) => written(arguments, path, catalogue)?,
        None => grown(arguments, catalogue)?,
    };
    simworld_examples::folder::make_folder(&arguments.out)?;
    let view = View::new().inspect_err(|reason| eprintln!("plans alone: {reason}")).ok();
    println!("a scene of {} things; type how it is to change", world.len());
    let mut desk = Desk { arguments, world, editor, view };
    if arguments.say.is_empty() {
        desk.listen()
    } else {
        for sentence in &arguments.say {
            println!("> {sentence}");
            desk.hear(sentence)?;
        }
        Ok(())
    }
}

/// A saved city, or a small one.
fn grown(arguments: &Arguments, catalogue: Catalogue) -> Outcome<(World, SceneEditor)> {
    let source = Source::saved_or_small(arguments.city.as_ref());
    let city = make(&source, Seed(arguments.seed).stream("city").seed())?.city;
    let mut world = World::new();
    city.populate(&mut world)?;
    Ok((world, editor(arguments, arguments.seed, catalogue)?.looking_from(arguments.from)))
}

/// A scene that is written by hand; what is wrong with how its things stand is told, and they stand so.
fn written(arguments: &Arguments, path: &Path, catalogue: Catalogue) -> Outcome<(World, SceneEditor)> {
    let scene = SceneFile::read(path)?;
    let editor = editor(arguments, scene.seed, catalogue)?;
    let written = Written::with(scene, Clock::default(), editor)?;
    written.tell();
    // What the user says is looked at from where the user says, wherever the file looked from last.
    Ok((written.loaded.world, written.loaded.editor.looking_from(arguments.from)))
}

/// The editor, with who reads and who makes.
fn editor(arguments: &Arguments, seed: u64, catalogue: Catalogue) -> Outcome<SceneEditor> {
    let mut editor = SceneEditor::new(Seed(seed)).with_catalogue(catalogue);
    if let Some(url) = &arguments.model {
        let config = OpenAiConfig {
            base_url: url.clone(),
            model: arguments.model_name.clone(),
            ..OpenAiConfig::default()
        };
        editor = editor.with_reader(ModelReader::new(Box::new(OpenAiChat::new(config)?)));
    }
    match &arguments.generator {
        None => {}
        Some(Maker::Offline) => editor = editor.with_generator(ProceduralGenerator::new()),
        Some(Maker::Server(url)) => {
            let config = HunyuanConfig { base_url: url.clone(), ..HunyuanConfig::default() };
            editor = editor.with_generator(HunyuanGenerator::new(config)?);
        }
    }
    Ok(editor)
}

struct Desk<'a> {
    arguments: &'a Arguments,
    world: World,
    editor: SceneEditor,
    view: Option<View>,
}

impl Desk<'_> {
    fn listen(&mut self) -> Outcome<()> {
        let live = std::io::stdin().is_terminal();
        let mut lines = std::io::stdin().lock().lines();
        loop {
            if live {
                print!("> ");
                std::io::stdout().flush()?;
            }
            let Some(line) = lines.next().transpose()? else { return Ok(()) };
            if !live {
                println!("> {line}");
            }
            match line.trim() {
                "" => {}
                "quit" | "exit" => return Ok(()),
                said => self.hear(said)?,
            }
        }
    }

    fn hear(&mut self, said: &str) -> Outcome<()> {
        let before = self.world.clone();
        match said.trim().to_lowercase().as_str() {
            "undo" => match self.editor.undo(&mut self.world)? {
                Some(what) => println!("  taken back: {what}"),
                None => println!("  there is nothing to take back"),
            },
            "redo" => match self.editor.redo(&mut self.world)? {
                Some(what) => println!("  done again: {what}"),
                None => println!("  there is nothing to do again"),
            },
            "why" | "why?" => return self.why(),
            "where else" | "where else?" => {
                self.where_else();
                return Ok(());
            }
            _ => match self.editor.say(said, &mut self.world) {
                Ok(edited) => self.tell(&edited),
                Err(answer) => {
                    println!("  {answer}");
                    return Ok(());
                }
            },
        }
        self.draw(&before, said)
    }

    fn tell(&self, edited: &Edited) {
        if edited.read_by == ReadBy::Reader {
            println!("  the model understood {:?}", edited.edits);
        }
        if let Some(answer) = &edited.answer {
            println!("  {answer}");
        }
        for id in &edited.made {
            if let Some(thing) = self.world.entity(*id) {
                let at = thing.planar();
                let asset = thing.info.asset.and_then(|asset| self.world.assets()?.get(asset));
                let name = thing.info.name.clone().or(asset.map(Asset::called));
                let name = name.unwrap_or_else(|| thing.label().to_owned());
                println!("  {name} ({id}) at ({:.1}, {:.1})", at.x, at.y);
            }
        }
        let others = edited.edits.len().saturating_sub(edited.made.len());
        if edited.made.is_empty() && edited.answer.is_none() && others > 0 {
            println!("  done");
        }
    }

    /// What was tried for the last thing, in words and as a picture.
    fn why(&self) -> Outcome<()> {
        let Some(placing) = self.editor.last_placings().last() else {
            println!("  nothing was put anywhere yet");
            return Ok(());
        };
        if let Some(explained) = placing.explained() {
            println!("  {explained}");
        }
        let fitting = placing.alternatives().len() + usize::from(placing.taken.is_some());
        println!(
            "  {} places were tried, {fitting} would do; against the others: {}",
            placing.candidates.len(),
            placing.reasons(&self.world)
        );
        let middle = placing.pose().or(placing.candidates.first().map(|candidate| candidate.pose));
        if let Some(middle) = middle.map(|pose| planar(&pose)) {
            let plan = Plan {
                middle,
                reach: self.arguments.reach,
                title: "places that were tried",
                touched: &[],
                placings: self.editor.last_placings(),
            };
            std::fs::write(self.arguments.out.join("why.svg"), plan.draw(&self.world).to_string())?;
        }
        Ok(())
    }

    fn where_else(&self) {
        let others = self.editor.last_placings().last().map(Placing::alternatives).unwrap_or_default();
        if others.is_empty() {
            println!("  nowhere else");
        }
        for candidate in others.iter().take(5) {
            let at = planar(&candidate.pose);
            println!("  at ({:.1}, {:.1})", at.x, at.y);
        }
    }

    /// Both states around what changed.
    fn draw(&mut self, before: &World, title: &str) -> Outcome<()> {
        let changed = Difference::between(before, &self.world);
        let touched: Vec<EntityId> = changed
            .added
            .iter()
            .chain(&changed.removed)
            .chain(&changed.moved)
            .chain(&changed.altered)
            .copied()
            .collect();
        let place =
            |world: &World| touched.iter().find_map(|id| world.entity(*id)).map(|thing| thing.planar());
        let middle = place(&self.world).or(place(before)).unwrap_or(self.arguments.from);
        for (name, world) in [("before", before), ("after", &self.world)] {
            let plan = Plan { middle, reach: self.arguments.reach, title, touched: &touched, placings: &[] };
            std::fs::write(self.arguments.out.join(format!("{name}.svg")), plan.draw(world).to_string())?;
            if let Some(view) = &mut self.view {
                view.write(
                    world,
                    middle,
                    self.arguments.reach * 0.7,
                    &self.arguments.out.join(format!("{name}.png")),
                )?;
            }
        }
        Ok(())
    }
}
