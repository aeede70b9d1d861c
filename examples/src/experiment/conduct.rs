//! Runs every seed of every setting, on all threads, and keeps what is finished.

use std::fs;
use std::path::{Path, PathBuf};

use rayon::prelude::*;
use simworld_core::seed::Seed;
use thiserror::Error;

use super::preset::Arm;
use super::trial::Trial;
use crate::delivery::{AssembleError, OutputError, OutputFolder, RunError, Watch, make_city, run_seed};

/// Why an experiment has no results.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ExperimentError {
    /// The city cannot be made.
    #[error(transparent)]
    City(#[from] AssembleError),
    /// A run failed.
    #[error("{arm}, seed {seed}: {source}")]
    Run {
        /// The setting.
        arm: String,
        /// The seed.
        seed: u64,
        /// Why.
        source: Box<RunError>,
    },
    /// The folder cannot be written to.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// The settings cannot be written.
    #[error("the settings of {arm} cannot be written: {source}")]
    Settings {
        /// The setting.
        arm: String,
        /// Why.
        source: toml::ser::Error,
    },
    /// The folder holds the results of other settings.
    #[error(
        "{path} was made with other settings: give the same ones to resume it, or another folder with --out"
    )]
    OtherSettings {
        /// The file that differs.
        path: PathBuf,
    },
    /// It was stopped; what is finished is kept.
    #[error("stopped after {done} of {all} runs: --resume {folder} goes on from there")]
    Stopped {
        /// Finished runs.
        done: usize,
        /// All of them.
        all: usize,
        /// Where they are.
        folder: PathBuf,
    },
}

/// Runs what is not finished in a folder yet; gives all trials, setting by setting and seed by seed.
///
/// # Errors
/// A run failed, was stopped, or cannot be kept; or the folder was made with other settings.
pub fn conduct(arms: &[Arm], folder: &OutputFolder, watch: &Watch) -> Result<Vec<Trial>, ExperimentError> {
    for arm in arms {
        keep_settings(arm, folder)?;
    }
    let Some(first) = arms.first() else { return Ok(Vec::new()) };
    // Arms differ in how couriers live, never in where.
    let (city, _) = make_city(&first.config)?;
    let runs: Vec<(&Arm, u64)> =
        arms.iter().flat_map(|arm| seeds(arm).map(move |seed| (arm, seed))).collect();
    let trials: Vec<Option<Trial>> = runs
        .par_iter()
        .map(|(arm, seed)| {
            let path = folder.path().join(format!("trials/{}-seed-{seed}.json", arm.name));
            if let Some(finished) = read(&path) {
                return Ok(Some(finished));
            }
            let failed = |source| ExperimentError::Run {
                arm: arm.name.clone(),
                seed: *seed,
                source: Box::new(source),
            };
            let shown = recorded(arms).is_some_and(|(shown, first)| shown == *arm && first.0 == *seed);
            let log = if shown { Some(folder.seed_folder(Seed(*seed))?) } else { None };
            let run =
                run_seed(&arm.config, &city, Seed(*seed), log.as_deref(), None, watch).map_err(failed)?;
            if watch.is_stopped() {
                return Ok(None);
            }
            let trial = Trial::of(arm, run);
            if let Some(trial) = &trial {
                write(&path, trial)?;
            }
            Ok(trial)
        })
        .collect::<Result<_, ExperimentError>>()?;
    let done = trials.iter().flatten().count();
    if done < runs.len() {
        let folder = folder.path().to_owned();
        return Err(ExperimentError::Stopped { done, all: runs.len(), folder });
    }
    Ok(trials.into_iter().flatten().collect())
}

/// The run whose events and track are kept, and which a report shows: the first seed of the setting in the middle.
pub fn recorded(arms: &[Arm]) -> Option<(&Arm, Seed)> {
    let arm = arms.get(arms.len() / 2)?;
    Some((arm, Seed(arm.config.seed)))
}

fn seeds(arm: &Arm) -> impl Iterator<Item = u64> {
    let first = arm.config.seed;
    (0..u64::from(arm.config.seeds)).map(move |index| first.wrapping_add(index))
}

/// Writes the settings of an arm, or holds them against those that are there.
fn keep_settings(arm: &Arm, folder: &OutputFolder) -> Result<(), ExperimentError> {
    let fail = |source| ExperimentError::Settings { arm: arm.name.clone(), source };
    let (name, text) = (format!("{}.toml", arm.name), arm.config.to_toml().map_err(fail)?);
    let path = folder.path().join(&name);
    match fs::read_to_string(&path) {
        Ok(there) if there == text => Ok(()),
        Ok(_) => Err(ExperimentError::OtherSettings { path }),
        Err(_) => Ok(folder.write(name, text).map(|_| ())?),
    }
}

/// A trial that was finished; one that was cut off while it was written is run again.
fn read(path: &Path) -> Option<Trial> {
    serde_json::from_slice(&fs::read(path).ok()?).ok()
}

/// Under another name first, so that a file that is there is whole.
fn write(path: &Path, trial: &Trial) -> Result<(), OutputError> {
    let fail = |source| OutputError::NotWritable { path: path.to_owned(), source };
    let text = serde_json::to_vec(trial).expect("a trial is plain data with string keys");
    let draft = path.with_extension("draft");
    let folder = path.parent().map_or(Ok(()), fs::create_dir_all);
    folder.and_then(|()| fs::write(&draft, text)).and_then(|()| fs::rename(&draft, path)).map_err(fail)
}
