//! The main job: couriers bid, carry, share, invest and tire in a generated city with traffic and physics.
//!
//! ```sh
//! cargo run --release --example delivery
//! cargo run --release --example delivery -- --replay out/delivery-1
//! cargo run --release --example delivery -- --preset competition --report out/competition
//! ```

use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use clap::Parser;
use indicatif::{MultiProgress, ProgressBar, ProgressStyle};
use simworld_agents::thought::Waking;
use simworld_examples::delivery::{Brain, Eyes, OutputFolder, RunConfig, Watch, play, replay, resume};
use simworld_examples::exit_code;
use simworld_examples::experiment::{Preset, Results, conduct, keep_rows};
use simworld_examples::report::{holds_run, keep_index, write_report};

/// Couriers at work in a generated city: they bid for orders, walk or ride them through traffic, and tire.
///
/// Prints the five metrics of the paper's delivery task, mean and standard deviation over the seeds, and writes the
/// configuration, the event log, the trail of state hashes, the track of the couriers, maps, a report to open and, where
/// there is a graphics adapter, frames. With --preset it runs an experiment of the paper instead and writes its tables,
/// charts and findings too.
#[derive(Parser)]
#[command(version)]
struct Arguments {
    /// Settings as TOML; what it leaves out keeps its default (see config.toml of any run).
    #[arg(long, value_name = "FILE.toml")]
    config: Option<PathBuf>,
    /// The first seed; the others follow it.
    #[arg(long)]
    seed: Option<u64>,
    /// How many seeds to run [default: 3].
    #[arg(long)]
    seeds: Option<u32>,
    /// Number of couriers [default: 20].
    #[arg(long)]
    agents: Option<u32>,
    /// Steps of 0.1 s [default: 5000].
    #[arg(long)]
    steps: Option<u64>,
    /// Vehicles of the traffic [default: 40].
    #[arg(long)]
    vehicles: Option<u32>,
    /// Pedestrians of the traffic [default: 80].
    #[arg(long)]
    pedestrians: Option<u32>,
    /// Roads from a `roads.json` of the Python release instead of grown ones.
    #[arg(long, value_name = "ROADS.json")]
    roads: Option<PathBuf>,
    /// A city saved by the `city` example instead of a grown one.
    #[arg(long, value_name = "FILE.simcity", conflicts_with = "roads")]
    city: Option<PathBuf>,
    /// The folder to write to; it must be new or empty [default: the first free out/delivery-N].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Writes the report of the run or experiment in this folder again; a new or empty folder is played into first.
    #[arg(long, value_name = "DIR", conflicts_with_all = ["out", "resume", "replay"])]
    report: Option<PathBuf>,
    /// Frames to render a seed, 0 for none [default: 3].
    #[arg(long)]
    frames: Option<u32>,
    /// Threads to use [default: one a core].
    #[arg(long)]
    threads: Option<usize>,
    /// An experiment: main, competition, orders, money or persona of the paper, or scale.
    #[arg(long, value_name = "NAME", conflicts_with = "replay")]
    preset: Option<Preset>,
    /// Goes on with the run of this folder by its own settings, or with --preset with its experiment; give the same settings.
    #[arg(long, value_name = "DIR", conflicts_with = "out")]
    resume: Option<PathBuf>,
    /// Who decides, dealt to the couriers in turn: policies by name, and `model` [default: the model if there is
    /// one, else the twelve policies].
    #[arg(long, value_name = "MINDS", value_delimiter = ',')]
    mind: Vec<Brain>,
    /// Couriers think with the model behind this OpenAI-compatible address.
    #[arg(long, value_name = "URL")]
    model: Option<String>,
    /// The model's name, where the server has several.
    #[arg(long, value_name = "NAME")]
    model_name: Option<String>,
    /// The environment variable that holds the server's key.
    #[arg(long, value_name = "VARIABLE")]
    model_key: Option<String>,
    /// A folder of recordings of the model, one a seed: what is on one is not asked again, and without --model nothing else is.
    #[arg(long, value_name = "DIR")]
    tape: Option<PathBuf>,
    /// A folder of templates that replace prompts of the same name.
    #[arg(long, value_name = "DIR")]
    prompts: Option<PathBuf>,
    /// Shows the model what is before the courier; needs a graphics adapter.
    #[arg(long)]
    eyes: bool,
    /// Lets couriers with a model think in every step, as in the paper.
    #[arg(long)]
    every_step: bool,
    /// Longest time between two thoughts of a courier with a model, s [default: 20].
    #[arg(long, value_name = "SECONDS")]
    think: Option<f64>,
    /// Runs the logs of this folder again and confirms every hash; all other options are ignored.
    #[arg(long, value_name = "DIR")]
    replay: Option<PathBuf>,
}

fn main() -> ExitCode {
    exit_code(job(&Arguments::parse()))
}

type Fault = Box<dyn std::error::Error>;

fn job(arguments: &Arguments) -> Result<(), Fault> {
    if let Some(threads) = arguments.threads {
        rayon::ThreadPoolBuilder::new().num_threads(threads).build_global()?;
    }
    let bars = Bars::new()?;
    let stop = stop_on_interrupt()?;
    if let Some(folder) = &arguments.replay {
        let report = replay(folder, &bars.watch(stop))?;
        println!("{report}");
        return Ok(());
    }
    if let Some(folder) = arguments.report.as_deref().filter(|folder| holds_run(folder)) {
        println!("open {}", write_report(folder)?.display());
        return Ok(());
    }
    let config = configure(arguments)?;
    if let Some(preset) = arguments.preset {
        return experiment(preset, &config, arguments, &bars, stop);
    }
    let folder = match (&arguments.resume, arguments.out.as_ref().or(arguments.report.as_ref())) {
        (Some(path), _) => OutputFolder::open(path)?,
        (None, Some(path)) => OutputFolder::create(path)?,
        (None, None) => OutputFolder::create_numbered("out/delivery")?,
    };
    let watch = bars.watch(stop);
    let report = match &arguments.resume {
        Some(_) => resume(&folder, &watch)?,
        None => play(&config, &folder, &watch)?,
    };
    bars.clear();
    println!("{report}");
    let page = write_report(folder.path())?;
    println!("written to {}; open {}", folder.path().display(), page.display());
    Ok(())
}

/// Runs an experiment, or what is left of it, and writes its results and its report.
fn experiment(
    preset: Preset,
    config: &RunConfig,
    arguments: &Arguments,
    bars: &Bars,
    stop: Arc<AtomicBool>,
) -> Result<(), Fault> {
    let folder = match (&arguments.resume, arguments.out.as_ref().or(arguments.report.as_ref())) {
        (Some(path), _) => OutputFolder::open(path)?,
        (None, Some(path)) => OutputFolder::create(path)?,
        (None, None) => OutputFolder::create_numbered(&format!("out/{preset}"))?,
    };
    let arms = preset.arms(config);
    keep_index(preset, &arms, &folder)?;
    let trials = conduct(&arms, &folder, &bars.watch(stop))?;
    bars.clear();
    let results = Results::of(preset, &trials);
    results.write(&folder)?;
    keep_rows(&trials, &folder)?;
    let path = write_report(folder.path())?;
    println!("{results}");
    println!("written to {}; open {}", folder.path().display(), path.display());
    Ok(())
}

/// The settings of the file, or the defaults, with what the command line says instead.
fn configure(arguments: &Arguments) -> Result<RunConfig, Fault> {
    let mut config = match &arguments.config {
        Some(path) => RunConfig::read(path)?,
        None => RunConfig::default(),
    };
    set(&mut config.seed, arguments.seed.as_ref());
    set(&mut config.seeds, arguments.seeds.as_ref());
    set(&mut config.agents, arguments.agents.as_ref());
    set(&mut config.steps, arguments.steps.as_ref());
    set(&mut config.vehicles, arguments.vehicles.as_ref());
    set(&mut config.pedestrians, arguments.pedestrians.as_ref());
    set(&mut config.frames, arguments.frames.as_ref());
    if arguments.roads.is_some() {
        config.roads.clone_from(&arguments.roads);
    }
    if arguments.city.is_some() {
        config.city_file.clone_from(&arguments.city);
    }
    choose_minds(&mut config, arguments)?;
    configure_model(&mut config, arguments);
    config.validate()?;
    Ok(config)
}

/// Who decides.
fn choose_minds(config: &mut RunConfig, arguments: &Arguments) -> Result<(), Fault> {
    let has_model = arguments.model.is_some() || arguments.tape.is_some();
    if !arguments.mind.is_empty() {
        config.policies.clone_from(&arguments.mind);
    } else if has_model && arguments.config.is_none() {
        config.policies = vec![Brain::Model];
    }
    if has_model && !config.policies.contains(&Brain::Model) {
        return Err(
            "nobody would think with the model: add `model` to --mind, or to `policies` of the file".into()
        );
    }
    Ok(())
}

/// How those with a model think.
fn configure_model(config: &mut RunConfig, arguments: &Arguments) {
    let model = &mut config.model;
    set(&mut model.url, arguments.model.clone().map(Some).as_ref());
    set(&mut model.name, arguments.model_name.as_ref());
    set(&mut model.key_variable, arguments.model_key.clone().map(Some).as_ref());
    set(&mut model.tape, arguments.tape.clone().map(Some).as_ref());
    set(&mut model.prompts, arguments.prompts.clone().map(Some).as_ref());
    set(&mut model.thinking.interval, arguments.think.as_ref());
    model.thinking.pause = model.thinking.pause.min(model.thinking.interval.max(0.1));
    if arguments.eyes {
        model.eyes = Eyes::Open;
    }
    if arguments.every_step {
        model.thinking.waking = Waking::EveryStep;
    }
}

/// Takes over what the command line says, if it says anything.
fn set<T: Clone>(place: &mut T, argument: Option<&T>) {
    if let Some(value) = argument {
        place.clone_from(value);
    }
}

/// Ctrl-C asks the run to stop after its step; the log is then whole.
fn stop_on_interrupt() -> Result<Arc<AtomicBool>, ctrlc::Error> {
    let stop = Arc::new(AtomicBool::new(false));
    let asked = Arc::clone(&stop);
    ctrlc::set_handler(move || asked.store(true, Ordering::Relaxed))?;
    Ok(stop)
}

/// One progress bar a seed.
struct Bars {
    all: MultiProgress,
    style: ProgressStyle,
}

impl Bars {
    fn new() -> Result<Self, Fault> {
        let style =
            ProgressStyle::with_template("{prefix:>8} {bar:40} {pos:>5}/{len} steps  {eta:>4} left  {msg}")?;
        Ok(Self { all: MultiProgress::new(), style })
    }

    fn watch(&self, stop: Arc<AtomicBool>) -> Watch {
        let (all, style) = (self.all.clone(), self.style.clone());
        Watch::new(stop, move |name, length| {
            let bar =
                all.add(ProgressBar::new(length).with_style(style.clone()).with_prefix(name.to_owned()));
            Box::new(move |step, message: &str| {
                bar.set_position(step);
                bar.set_message(message.to_owned());
            })
        })
    }

    fn clear(&self) {
        // A terminal that went away is no reason to lose the report.
        let _ = self.all.clear();
    }
}
