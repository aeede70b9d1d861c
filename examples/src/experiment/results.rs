//! What came of an experiment.

use std::fmt;

use serde::Serialize;

use super::findings::Finding;
use super::preset::Preset;
use super::table::{Table, file_stem};
use super::trial::Trial;
use super::{competition, main_run, persona, sweep};
use crate::delivery::{OutputError, OutputFolder};

/// A chart, as SVG.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Chart {
    /// What it shows, which is also its name in files.
    pub title: String,
    /// How to read it.
    pub caption: String,
    /// The picture.
    #[serde(skip)]
    pub svg: String,
}

/// Tables, charts and findings of an experiment.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Results {
    /// The tables.
    pub tables: Vec<Table>,
    /// The charts.
    pub charts: Vec<Chart>,
    /// The claims of the paper, and what the trials say of them.
    pub findings: Vec<Finding>,
}

impl Results {
    /// Of the trials of a preset.
    pub fn of(preset: Preset, trials: &[Trial]) -> Self {
        match preset {
            Preset::Main | Preset::Scale => main_run::results(trials),
            Preset::Competition => competition::results(trials),
            Preset::Orders => sweep::results(trials, "order volume", sweep::OF_ORDERS),
            Preset::Money => sweep::results(trials, "initial money $", sweep::OF_MONEY),
            Preset::Persona => persona::results(trials),
        }
    }

    /// Writes tables as CSV, charts as SVG, and everything but the pictures as JSON.
    ///
    /// # Errors
    /// The folder cannot be written to.
    pub fn write(&self, folder: &OutputFolder) -> Result<(), OutputError> {
        for table in &self.tables {
            folder.write(format!("{}.csv", table.file_stem()), table.to_csv())?;
        }
        for chart in &self.charts {
            folder.write(format!("{}.svg", file_stem(&chart.title)), &chart.svg)?;
        }
        let json = serde_json::to_string_pretty(self).expect("results are plain data with string keys");
        folder.write("results.json", json)?;
        Ok(())
    }
}

impl fmt::Display for Results {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for table in &self.tables {
            writeln!(f, "{}\n", table.to_terminal())?;
        }
        writeln!(f, "What the paper says, and what these trials say of it:")?;
        for finding in &self.findings {
            writeln!(f, "  {finding}")?;
        }
        Ok(())
    }
}
