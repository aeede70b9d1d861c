//! The main setting: the five metrics, and who did well.

use simworld_core::evaluation::Accumulator;

use super::competition;
use super::results::Results;
use super::sweep::with_interval;
use super::table::Table;
use super::trial::Trial;

/// Tables, charts and findings of the main setting.
pub(super) fn results(trials: &[Trial]) -> Results {
    let mut results = competition::results(trials);
    results.tables.insert(0, metrics(trials));
    results
}

fn metrics(trials: &[Trial]) -> Table {
    let mut table = Table::new("Metrics over seeds", &["metric", "mean ± std", "mean, 95 % interval"]);
    let names = trials.first().map(|trial| trial.metrics.as_slice()).unwrap_or_default();
    for (name, _) in names {
        let values: Vec<f64> = trials.iter().map(|trial| trial.metric(name)).collect();
        let summary: Accumulator = values.iter().copied().collect();
        table.add(name.as_str(), [summary.to_string(), with_interval(&values, name)]);
    }
    table
}
