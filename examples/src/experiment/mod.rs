//! The paper's experiments with the delivery task: what to run, what came of it, and the pages that show it.
//!
//! [`Preset::arms`] says which settings are compared, [`conduct`] runs every seed of each and keeps what is finished,
//! [`Results`] puts tables, charts and findings together; [`report`](crate::report) makes a page of them.

mod chart;
mod claims;
mod competition;
mod conduct;
mod findings;
mod main_run;
mod persona;
mod preset;
mod results;
mod rows;
mod sweep;
mod table;
mod trial;

pub use conduct::{ExperimentError, conduct, recorded};
pub use findings::{Finding, Verdict};
pub use preset::{Arm, Preset, PresetError, at_scale};
pub use results::{Chart, Results};
pub use rows::{RowsError, keep_rows};
pub use table::Table;
pub(crate) use table::escaped;
pub use trial::Trial;
