//! What a folder holds: a finished run or experiment, read back from its files.

use std::path::{Path, PathBuf};

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use simworld_agents::delivery::DeliveryReport;
use simworld_core::event::Event;
use simworld_core::id::EntityId;
use simworld_core::seed::Seed;
use thiserror::Error;

use super::words::count;
use crate::delivery::{
    AssembleError, ConfigError, LogError, OutputError, OutputFolder, Player, RunConfig, SeedReport, Track,
    auctions_of, players, read_log, read_track,
};
use crate::experiment::{Arm, Preset, PresetError, Trial, recorded};

/// The file that says what an experiment compares.
const INDEX: &str = "experiment.json";
/// What the only setting of a run by itself is called.
const RUN: &str = "run";

/// Why there is no report.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ReportError {
    /// The folder holds nothing to report.
    #[error("{path} holds no run and no experiment: give the folder that one was written to")]
    Nothing {
        /// The folder.
        path: PathBuf,
    },
    /// A run that did not come to its end.
    #[error("{path} is not there: the run was cut off; run it again, or give --resume to an experiment")]
    Unfinished {
        /// The file that a finished run has.
        path: PathBuf,
    },
    /// A file that cannot be read.
    #[error("{path}: {source}")]
    File {
        /// Which file.
        path: PathBuf,
        /// Why.
        source: std::io::Error,
    },
    /// A file that says something else than what it should.
    #[error("{path}: {source}; it was edited, or written by another version")]
    Contents {
        /// Which file.
        path: PathBuf,
        /// What is wrong with it.
        source: serde_json::Error,
    },
    /// An experiment of another version.
    #[error(transparent)]
    Preset(#[from] PresetError),
    /// Settings that cannot be used.
    #[error(transparent)]
    Config(#[from] ConfigError),
    /// A log that cannot be read.
    #[error(transparent)]
    Log(#[from] LogError),
    /// The city cannot be made again.
    #[error("the city of the run cannot be made again: {0}")]
    City(#[from] AssembleError),
    /// The page cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
}

/// What an experiment compares.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Index {
    preset: String,
    /// Name and level of each setting, in order.
    settings: Vec<(String, f64)>,
}

/// Writes down what an experiment compares, so that it can be reported from its folder alone.
///
/// # Errors
/// The folder cannot be written to.
pub fn keep_index(preset: Preset, arms: &[Arm], folder: &OutputFolder) -> Result<(), OutputError> {
    let settings = arms.iter().map(|arm| (arm.name.clone(), arm.level)).collect();
    let index = Index { preset: preset.to_string(), settings };
    let text = serde_json::to_string_pretty(&index).expect("an index is plain data");
    folder.write(INDEX, text).map(|_| ())
}

/// Whether a folder holds a run or an experiment.
pub fn holds_run(path: &Path) -> bool {
    path.join(INDEX).exists() || path.join("config.toml").exists()
}

/// A finished run or experiment.
pub(super) struct Finished {
    /// `None` for a run by itself.
    pub(super) preset: Option<Preset>,
    pub(super) arms: Vec<Arm>,
    pub(super) trials: Vec<Trial>,
    /// The run that is shown on maps.
    pub(super) shown: Option<Shown>,
    /// Why none is, if none is.
    pub(super) unseen: String,
}

/// A recorded run.
pub(super) struct Shown {
    pub(super) arm: Arm,
    pub(super) seed: Seed,
    pub(super) players: Vec<Player>,
    pub(super) report: DeliveryReport,
    pub(super) events: Vec<Event>,
    pub(super) track: Track,
    /// Why its log ends early, if it does.
    broken_off: Option<String>,
}

impl Finished {
    /// Reads a folder.
    ///
    /// # Errors
    /// It holds no finished run, or a file that cannot be used.
    pub(super) fn read(path: &Path) -> Result<Self, ReportError> {
        if path.join(INDEX).exists() {
            return Self::experiment(path);
        }
        if path.join("config.toml").exists() {
            return Self::run(path);
        }
        Err(ReportError::Nothing { path: path.to_owned() })
    }

    fn experiment(path: &Path) -> Result<Self, ReportError> {
        let index: Index = json(&path.join(INDEX))?;
        let preset: Preset = index.preset.parse()?;
        let arm = |(name, level): (String, f64)| {
            let config = RunConfig::read(&path.join(format!("{name}.toml")))?;
            Ok::<_, ConfigError>(Arm { name, level, config })
        };
        let arms: Vec<Arm> = index.settings.into_iter().map(arm).collect::<Result<_, _>>()?;
        let mut trials: Vec<Trial> = Vec::new();
        for arm in &arms {
            for seed in seeds(&arm.config) {
                trials.push(json(&path.join(format!("trials/{}-seed-{}.json", arm.name, seed.0)))?);
            }
        }
        let of =
            |arm: &Arm, seed: Seed| trials.iter().find(|trial| trial.arm == arm.name && trial.seed == seed.0);
        let shown = match recorded(&arms).and_then(|(arm, seed)| Some((arm, seed, of(arm, seed)?))) {
            Some((arm, seed, trial)) => Shown::read(path, arm, seed, trial.report.clone())?,
            None => Err(String::new()),
        };
        Ok(Self::with(Some(preset), arms, trials, shown))
    }

    fn run(path: &Path) -> Result<Self, ReportError> {
        let config = RunConfig::read(&path.join("config.toml"))?;
        let arm = Arm { name: RUN.to_owned(), level: 0.0, config };
        let mut trials = Vec::new();
        let mut shown = Err(String::new());
        for (rank, seed) in seeds(&arm.config).enumerate() {
            let folder = path.join(format!("seed-{}", seed.0));
            let (report, couriers): (SeedReport, Option<DeliveryReport>) = json(&folder.join("report.json"))?;
            let Some(couriers) = couriers else { continue };
            let log = read_log(&folder.join("events.jsonl"))?;
            let ids: Vec<EntityId> = couriers.couriers.iter().map(|row| row.courier).collect();
            if rank == 0 {
                shown = Shown::read(path, &arm, seed, couriers.clone())?;
            }
            trials.push(Trial {
                arm: arm.name.clone(),
                level: arm.level,
                seed: seed.0,
                digest: report.digest,
                physical: report.physical,
                model: report.model,
                metrics: report.metrics.into_iter().map(|metric| (metric.name, metric.value)).collect(),
                report: couriers,
                players: players(&arm.config, seed),
                auctions: auctions_of(&log.events, &ids),
            });
        }
        Ok(Self::with(None, vec![arm], trials, shown))
    }

    fn with(
        preset: Option<Preset>,
        arms: Vec<Arm>,
        trials: Vec<Trial>,
        shown: Result<Shown, String>,
    ) -> Self {
        let (shown, unseen) = match shown {
            Ok(shown) => (Some(shown), String::new()),
            Err(reason) => (None, reason),
        };
        Self { preset, arms, trials, shown, unseen }
    }

    /// What the page is called.
    pub(super) fn title(&self) -> String {
        match self.preset {
            Some(preset) => format!("simworld: the {preset} experiment"),
            None => "simworld: a delivery run".to_owned(),
        }
    }

    /// What was asked, and how much was run.
    pub(super) fn lead(&self) -> String {
        let question = match self.preset {
            Some(preset) => preset.question(),
            None => "Couriers bid, carry, share, invest and tire in a generated city.",
        };
        let Some(arm) = self.arms.first() else { return question.to_owned() };
        let RunConfig { agents, steps, vehicles, pedestrians, .. } = arm.config;
        format!(
            "{question} {agents} couriers, {vehicles} vehicles and {pedestrians} pedestrians, {steps} steps; {} of {}.",
            count(self.trials.len(), "run"),
            count(self.arms.len(), "setting")
        )
    }
}

impl Shown {
    /// The recorded run of a seed; the reason in words if it left no track.
    fn read(
        path: &Path,
        arm: &Arm,
        seed: Seed,
        report: DeliveryReport,
    ) -> Result<Result<Self, String>, ReportError> {
        let folder = path.join(format!("seed-{}", seed.0));
        let file = folder.join("track.jsonl");
        if !file.exists() {
            return Ok(Err(format!(
                "{} is not there, so the page has no map, no replay, no timelines and no stories: run it again to have them.",
                file.display()
            )));
        }
        let (log, track) = (read_log(&folder.join("events.jsonl"))?, read_track(&file)?);
        let players = players(&arm.config, seed);
        Ok(Ok(Self {
            arm: arm.clone(),
            seed,
            players,
            report,
            events: log.events,
            track,
            broken_off: log.broken_off,
        }))
    }

    /// What a courier is called.
    pub(super) fn name(&self, courier: usize) -> String {
        self.track.couriers.get(courier).map_or_else(|| "?".to_owned(), |courier| courier.name.clone())
    }

    /// Which run this is, in words.
    pub(super) fn which(&self) -> String {
        let mut text = match self.arm.name.as_str() {
            RUN => format!("Recorded with seed {}.", self.seed.0),
            name => format!("The recorded run: setting {name}, seed {}.", self.seed.0),
        };
        if let Some(reason) = &self.broken_off {
            text.push_str(" Its log ends early: ");
            text.push_str(reason);
            text.push('.');
        }
        text
    }
}

fn seeds(config: &RunConfig) -> impl Iterator<Item = Seed> {
    let first = config.seed;
    (0..u64::from(config.seeds)).map(move |index| Seed(first.wrapping_add(index)))
}

fn json<T: DeserializeOwned>(path: &Path) -> Result<T, ReportError> {
    let bytes = std::fs::read(path).map_err(|source| match source.kind() {
        std::io::ErrorKind::NotFound => ReportError::Unfinished { path: path.to_owned() },
        _ => ReportError::File { path: path.to_owned(), source },
    })?;
    serde_json::from_slice(&bytes).map_err(|source| ReportError::Contents { path: path.to_owned(), source })
}
