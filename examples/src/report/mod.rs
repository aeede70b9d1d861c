//! The report of a finished run or experiment: one page of HTML, made from what lies in its folder.
//!
//! [`write_report`] reads settings, results, the event log and the track of the couriers, and writes `report.html` beside them:
//! findings, the five metrics beside the paper's, tables and charts, the map with heat and trails, a replay with a slider,
//! a timeline a courier, the stories of orders, and the settings with their hash.

mod city;
mod folder;
mod frame;
mod heat;
mod maps;
mod page;
mod palette;
mod replay;
mod story;
mod telling;
mod timeline;
mod words;

use std::path::{Path, PathBuf};

use folder::{Finished, Shown};
pub use folder::{ReportError, holds_run, keep_index};

use crate::delivery::{AssembleError, OutputFolder, make_city};
use crate::experiment::{Preset, Results};

/// Writes `report.html` into the folder of a finished run or experiment, and says where it is.
///
/// # Errors
/// The folder holds no finished run, a file in it cannot be used, or the page cannot be written.
pub fn write_report(path: &Path) -> Result<PathBuf, ReportError> {
    let finished = Finished::read(path)?;
    let results = Results::of(finished.preset.unwrap_or(Preset::Main), &finished.trials);
    let map = finished.shown.as_ref().map(map_of).transpose()?;
    let page = page::page(&finished, &results, map.as_ref());
    Ok(OutputFolder::open(path)?.write("report.html", page)?)
}

/// The city of a recorded run, made again from its settings.
fn map_of(shown: &Shown) -> Result<city::CityMap, AssembleError> {
    let (city, _) = make_city(&shown.arm.config)?;
    Ok(city::CityMap::of(&city)?)
}
