//! The report of a run: the five metrics over seeds, beside the paper's rows.

use std::fmt;

use comfy_table::presets::UTF8_FULL_CONDENSED;
use comfy_table::{Cell, CellAlignment, Table};
use serde::{Deserialize, Serialize};
use simworld_core::evaluation::Accumulator;
use simworld_core::hash::StateDigest;
use simworld_core::seam::Metric;
use simworld_core::seed::Seed;

use super::thinkers::ModelUsage;

/// What one seed came to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SeedReport {
    /// The seed.
    pub seed: Seed,
    /// Finished steps.
    pub steps: u64,
    /// The task's figures of merit.
    pub metrics: Vec<Metric>,
    /// The digest of the final state.
    pub digest: StateDigest,
    /// Couriers with bodies under physics at the start; the others were points.
    pub physical: u32,
    /// What models were asked, if couriers think with any.
    pub model: Option<ModelUsage>,
}

impl SeedReport {
    /// The value of a metric; `None` if the task has none of that name.
    pub fn metric(&self, name: &str) -> Option<f64> {
        self.metrics.iter().find(|metric| metric.name == name).map(|metric| metric.value)
    }
}

/// The columns of the paper's table: heading, and the metric's name.
pub const COLUMNS: [(&str, &str); 5] = [
    ("profit $", "profit"),
    ("successful orders", "orders_per_agent"),
    ("energy efficiency", "energy_per_dollar"),
    ("sharing", "sharing_count"),
    ("investment", "investment_count"),
];

/// The paper's table: twenty agents of one model, 5000 steps, three seeds.
pub const PAPER: [(&str, [&str; 5]); 9] = [
    ("DeepSeek-V3", ["69.48 ± 16.77", "2.10 ± 0.47", "0.34 ± 0.07", "2.33 ± 0.47", "8.00 ± 3.00"]),
    ("Claude-3.5-Sonnet", ["69.07 ± 20.69", "2.73 ± 1.10", "0.54 ± 0.20", "11.33 ± 8.39", "9.00 ± 3.46"]),
    ("GPT-4o", ["43.91 ± 14.16", "1.63 ± 0.43", "0.30 ± 0.06", "0.67 ± 0.47", "4.67 ± 0.47"]),
    ("Gemini-2.5-Flash", ["42.42 ± 3.10", "2.10 ± 0.17", "0.17 ± 0.04", "2.67 ± 1.25", "2.00 ± 2.00"]),
    ("Gemini-2.0-Flash", ["28.72 ± 12.04", "1.53 ± 0.58", "0.11 ± 0.03", "0.67 ± 0.47", "0.67 ± 1.00"]),
    ("Qwen3-32B", ["24.73 ± 7.95", "1.37 ± 0.13", "0.40 ± 0.17", "1.33 ± 0.47", "5.33 ± 2.06"]),
    ("DeepSeek-Prover-V2", ["21.66 ± 7.18", "0.67 ± 0.14", "0.42 ± 0.03", "7.33 ± 8.39", "1.00 ± 1.00"]),
    ("QwQ", ["17.31 ± 4.07", "0.87 ± 0.20", "0.41 ± 0.20", "0.33 ± 0.47", "3.33 ± 2.52"]),
    ("GPT-4o-mini", ["0.00 ± 0.00", "0.00 ± 0.00", "0.00 ± 0.00", "0.00 ± 0.00", "0.00 ± 0.00"]),
];

/// What a run came to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RunReport {
    /// Who played, in words.
    pub players: String,
    /// One entry a seed.
    pub seeds: Vec<SeedReport>,
}

impl RunReport {
    /// A metric over the seeds; `None` if the task has none of that name.
    pub fn figure(&self, name: &str) -> Option<Accumulator> {
        let values: Option<Accumulator> = self.seeds.iter().map(|seed| seed.metric(name)).collect();
        values.filter(|figure| figure.count() > 0)
    }

    /// The table of the five metrics, this run first, then the paper's rows.
    pub fn table(&self) -> Table {
        let right = |text: &str| Cell::new(text).set_alignment(CellAlignment::Right);
        let mut table = Table::new();
        table.load_style(UTF8_FULL_CONDENSED);
        table.set_header([""].into_iter().chain(COLUMNS.map(|(heading, _)| heading)));
        let ours =
            COLUMNS.map(|(_, name)| self.figure(name).map_or("-".to_owned(), |figure| figure.to_string()));
        let label = format!("simworld: {}", self.players);
        table.add_row([Cell::new(label)].into_iter().chain(ours.iter().map(|cell| right(cell))));
        for (model, cells) in PAPER {
            let label = Cell::new(format!("paper: {model}"));
            table.add_row([label].into_iter().chain(cells.map(right)));
        }
        table
    }

    /// Every metric of the task, for each seed and over all.
    pub fn details(&self) -> Table {
        let mut table = Table::new();
        table.load_style(UTF8_FULL_CONDENSED);
        let seeds = self.seeds.iter().map(|seed| format!("seed {}", seed.seed.0));
        table.set_header(
            ["metric".to_owned(), "unit".to_owned()]
                .into_iter()
                .chain(seeds)
                .chain(["mean ± std".to_owned()]),
        );
        let Some(first) = self.seeds.first() else { return table };
        for metric in &first.metrics {
            let values = self
                .seeds
                .iter()
                .map(|seed| seed.metric(&metric.name).map_or("-".to_owned(), |value| format!("{value:.2}")));
            let over_all = self.figure(&metric.name).map_or("-".to_owned(), |figure| figure.to_string());
            let row = [metric.name.clone(), metric.unit.clone()].into_iter().chain(values).chain([over_all]);
            table.add_row(row.map(Cell::new).enumerate().map(|(column, cell)| {
                if column > 1 { cell.set_alignment(CellAlignment::Right) } else { cell }
            }));
        }
        table
    }
}

impl fmt::Display for RunReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.table())?;
        writeln!(
            f,
            "Profit, successful orders and energy efficiency are means per agent; sharing and investment are \
             counts over all agents.\nEnergy efficiency is energy consumed per dollar earned, as the paper defines it; \
             its inverse stands below.\n"
        )?;
        for seed in &self.seeds {
            if let Some(usage) = &seed.model {
                writeln!(f, "Seed {}: {usage}.\n", seed.seed.0)?;
            }
        }
        writeln!(f, "{}", self.details())
    }
}
