//! The paper's experiments with the delivery task: what to run, what came of it, and the pages that show it.
//!
//! [`Preset::arms`] says which settings are compared, [`conduct`] runs every seed of each and keeps what is finished,
//! [`Results`] puts tables, charts and findings together, [`page`] is the report.

mod chart;
mod competition;
mod conduct;
mod findings;
mod main_run;
mod page;
mod persona;
mod preset;
mod results;
mod sweep;
mod table;
mod trial;

pub use conduct::{ExperimentError, conduct};
pub use findings::{Finding, Verdict};
pub use page::page;
pub use preset::{Arm, Preset};
pub use results::{Chart, Results};
pub use table::Table;
pub use trial::Trial;
