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
    results.tables.extend(bodies(trials));
    results.tables.extend(models(trials));
    results
}

/// Which couriers had bodies under physics, where not all did.
fn bodies(trials: &[Trial]) -> Option<Table> {
    let all: u32 = trials.iter().map(|trial| trial.players.len() as u32).sum();
    let physical: u32 = trials.iter().map(|trial| trial.physical).sum();
    let mut table = Table::new("Bodies at the start", &["body", "couriers"]);
    table.add("under physics, near the middle of the city", [physical.to_string()]);
    table.add("a point that moves at the speed it is told, beyond", [(all - physical).to_string()]);
    (physical < all).then_some(table)
}

/// What models were asked, where couriers think with any.
fn models(trials: &[Trial]) -> Option<Table> {
    let header = ["seed", "couriers", "requests", "the paper's", "answered", "failed", "tokens", "cost $"];
    let mut table = Table::new("Models", &header);
    for trial in trials {
        if let Some(usage) = &trial.model {
            let counts = [usage.requests, usage.paper_requests, usage.answered, usage.failed];
            let tokens = usage.prompt_tokens + usage.completion_tokens;
            let counts = counts.into_iter().chain([tokens]).map(|count| count.to_string());
            let cells = [usage.couriers.to_string()].into_iter().chain(counts);
            table.add(trial.seed.to_string(), cells.chain([format!("{:.4}", usage.cost)]));
        }
    }
    (!table.rows.is_empty()).then_some(table)
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
