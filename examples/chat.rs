//! Say what is to be done, and watch it done: the plan, its steps, the map with the way and what the eyes see.
//!
//! ```sh
//! cargo run --release --example chat
//! cargo run --release --example chat -- --say "get into the red car, drive to the hospital and get out"
//! cargo run --release --example chat -- --scene examples/assets/scenes/harbour.scene.toml --say "go to the fountain"
//! cargo run --release --example chat -- --city out/city/city.simcity --model http://127.0.0.1:8080/v1
//! ```

use std::io::{BufRead, IsTerminal, Write};
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::mpsc::{Receiver, TryRecvError, channel};

use clap::Parser;
use simworld_agents::language::GrammarPlanner;
use simworld_agents::model::{OpenAiChat, OpenAiConfig};
use simworld_agents::thought::ModelPlanner;
use simworld_citygen::City;
use simworld_core::clock::Clock;
use simworld_core::event::EventKind;
use simworld_core::intent::Intent;
use simworld_core::scene::Scene;
use simworld_core::seam::{PlanStep, Planner, Progress};
use simworld_core::seed::Seed;
use simworld_examples::chat::{Pictures, Stage, Tally, step_in_words, steps_in_words};
use simworld_examples::city::{Source, make};
use simworld_examples::written::Written;
use simworld_examples::{Outcome, exit_code};
use simworld_traffic::TrafficConfig;

/// Type a sentence, see the plan, watch it done. "stop" interrupts; the end of the input ends it.
///
/// You speak to Robin, who stands on a sidewalk; Anna, the dog Rex, a scooter, a parcel and a red car are near by. The map
/// (map.svg) and what Robin sees (eye.png, eye-TICK.png) are written as it goes. The last line says how many sentences were planned.
#[derive(Parser)]
#[command(version)]
struct Arguments {
    /// A saved city; without one a small one is grown.
    #[arg(long, value_name = "FILE.simcity")]
    city: Option<PathBuf>,
    /// A scene that is written by hand, in place of a city, with a street that has a sidewalk; docs/scenes.md has every key.
    #[arg(long, value_name = "FILE.scene.toml", conflicts_with = "city")]
    scene: Option<PathBuf>,
    /// Seed of the city and of its traffic; a scene that is written by hand has its own for what stands in it.
    #[arg(long, default_value_t = 7)]
    seed: u64,
    /// A sentence to carry out instead of reading from the terminal; may be given several times.
    #[arg(long, value_name = "SENTENCE")]
    say: Vec<String>,
    /// Plans with a language model behind this OpenAI-compatible address (http or https), instead of the grammar.
    #[arg(long, value_name = "URL")]
    model: Option<String>,
    /// The model's name, where the server has several.
    #[arg(long, default_value = "default")]
    model_name: String,
    /// The environment variable that holds the server's key, if it wants one.
    #[arg(long, value_name = "VARIABLE")]
    key: Option<String>,
    /// Other vehicles in the city.
    #[arg(long, default_value_t = 20)]
    vehicles: u32,
    /// Other people in the city.
    #[arg(long, default_value_t = 40)]
    pedestrians: u32,
    /// Seconds of the city's time between two lines of progress, with a picture each; at least 1.
    #[arg(long, default_value_t = 10, value_parser = clap::value_parser!(u64).range(1..))]
    every: u64,
    /// Seconds of the city's time after which a sentence is given up; at least 1.
    #[arg(long, default_value_t = 1800, value_parser = clap::value_parser!(u64).range(1..))]
    patience: u64,
    /// The folder to write to.
    #[arg(long, value_name = "DIR", default_value = "out/chat")]
    out: PathBuf,
}

fn main() -> ExitCode {
    exit_code(job(&Arguments::parse()))
}

fn job(arguments: &Arguments) -> Outcome<()> {
    let traffic = TrafficConfig {
        vehicles: arguments.vehicles,
        pedestrians: arguments.pedestrians,
        ..TrafficConfig::default()
    };
    let (city, stage) = stage(arguments, &traffic)?;
    simworld_examples::folder::make_folder(&arguments.out)?;
    let (pictures, missing) = Pictures::new(&arguments.out);
    if let Some(reason) = missing {
        eprintln!("no view from the eyes: {reason}");
    }
    let planner: Box<dyn Planner> = match &arguments.model {
        Some(url) => {
            let server = OpenAiConfig {
                base_url: url.clone(),
                model: arguments.model_name.clone(),
                key_variable: arguments.key.clone(),
                ..OpenAiConfig::default()
            };
            Box::new(ModelPlanner::new(Box::new(OpenAiChat::new(server)?)))
        }
        None => Box::new(GrammarPlanner::default()),
    };
    let mut chat = Chat { arguments, city, stage, pictures, planner, tally: Tally::default() };
    chat.show("the beginning")?;
    if arguments.say.is_empty() {
        chat.listen()?;
    } else {
        chat.recite()?;
    }
    println!("{}", chat.tally);
    Ok(())
}

/// The stage in a saved city, or a small one; or in a scene that is written by hand, which is no city.
fn stage(arguments: &Arguments, traffic: &TrafficConfig) -> Outcome<(Option<City>, Stage)> {
    let seed = Seed(arguments.seed);
    if let Some(path) = &arguments.scene {
        let written = Written::read(path, Clock::default())?;
        written.tell();
        return Ok((None, Stage::in_world(written.loaded.world, traffic, seed)?));
    }
    let source = Source::saved_or_small(arguments.city.as_ref());
    let city = make(&source, seed.stream("city").seed())?.city;
    let stage = Stage::new(&city, traffic, seed)?;
    Ok((Some(city), stage))
}

struct Chat<'a> {
    arguments: &'a Arguments,
    city: Option<City>,
    stage: Stage,
    pictures: Pictures,
    planner: Box<dyn Planner>,
    tally: Tally,
}

impl Chat<'_> {
    /// Carries out the sentences of the command line.
    fn recite(&mut self) -> Outcome<()> {
        let (_, nobody) = channel();
        for sentence in &self.arguments.say {
            println!("> {sentence}");
            self.carry_out(sentence, &nobody)?;
        }
        Ok(())
    }

    /// Carries out what is typed, until the input ends. At a terminal a new line interrupts what is being done.
    fn listen(&mut self) -> Outcome<()> {
        let live = std::io::stdin().is_terminal();
        let (said, lines) = channel();
        let (_, nobody) = channel();
        std::thread::spawn(move || {
            for line in std::io::stdin().lock().lines().map_while(Result::ok) {
                if said.send(line).is_err() {
                    return;
                }
            }
        });
        let mut next: Option<String> = None;
        loop {
            if live && next.is_none() {
                print!("> ");
                std::io::stdout().flush()?;
            }
            let Some(sentence) = next.take().or_else(|| lines.recv().ok()) else { return Ok(()) };
            if sentence.trim().is_empty() {
                continue;
            }
            if !live {
                println!("> {sentence}");
            }
            next = self.carry_out(&sentence, if live { &lines } else { &nobody })?;
        }
    }

    /// Plans and does it; what was said meanwhile, if anything was.
    fn carry_out(&mut self, sentence: &str, lines: &Receiver<String>) -> Outcome<Option<String>> {
        let intent = Intent::Words(sentence.to_owned());
        let answer = self.planner.plan(&intent, self.stage.world(), self.stage.me());
        self.tally.count(&answer);
        let plan = match answer {
            Ok(plan) => plan,
            Err(answer) => {
                println!("  {answer}");
                return Ok(None);
            }
        };
        for line in steps_in_words(self.stage.world(), &plan.steps) {
            println!("  {line}");
        }
        self.stage.start(plan)?;
        let mut under_way: Option<PlanStep> = None;
        for tick in 1..=self.arguments.patience * 10 {
            if self.stage.under_way() != under_way.as_ref() {
                under_way = self.stage.under_way().cloned();
                if let Some(step) = &under_way {
                    println!("  [{}] {}", self.time(), step_in_words(self.stage.world(), step));
                }
            }
            let (progress, events) = self.stage.step()?;
            for event in &events {
                self.report(event);
            }
            match progress {
                Progress::Done => return self.end("done", sentence),
                Progress::Failed { reason } => return self.end(&format!("given up: {reason}"), sentence),
                _ => {}
            }
            if tick.is_multiple_of(self.arguments.every * 10) {
                self.show(sentence)?;
                let here = self.stage.here();
                println!("  [{}] at ({:.0}, {:.0})", self.time(), here.x, here.y);
            }
            match lines.try_recv() {
                Ok(said) => {
                    self.stage.interrupt();
                    println!("  [{}] interrupted", self.time());
                    return Ok(Some(said).filter(|said| said.trim() != "stop"));
                }
                Err(TryRecvError::Empty | TryRecvError::Disconnected) => {}
            }
        }
        self.stage.interrupt();
        self.end("given up: it takes longer than --patience", sentence)
    }

    fn end(&mut self, how: &str, sentence: &str) -> Outcome<Option<String>> {
        self.show(sentence)?;
        println!("  [{}] {how}", self.time());
        Ok(None)
    }

    fn report(&self, event: &EventKind) {
        let name = |id: &simworld_core::id::EntityId| {
            self.stage.world().entity(*id).map_or_else(|| id.to_string(), |entity| entity.label().to_owned())
        };
        match event {
            EventKind::Said { who, to, words } => {
                println!("  [{}] {} to {}: {words:?}", self.time(), name(who), name(to));
            }
            EventKind::Bought { item, .. } => println!("  [{}] bought {}", self.time(), name(item)),
            EventKind::ActionFailed { action, reason, .. } => {
                println!("  [{}] cannot {action}: {reason}", self.time());
            }
            EventKind::Gesture { gesture, .. } => println!("  [{}] {gesture}", self.time()),
            _ => {}
        }
    }

    fn show(&mut self, title: &str) -> Outcome<()> {
        self.pictures.map(self.city.as_ref(), &self.stage, title)?;
        Ok(self.pictures.eye(&self.stage)?)
    }

    fn time(&self) -> String {
        format!("{:.1} s", self.stage.world().clock().seconds())
    }
}
