//! One quantity varied: what couriers do at each level of it.

use simworld_agents::delivery::CourierAction;
use simworld_core::evaluation::{Accumulator, bootstrap, mean};
use simworld_core::seed::Seed;

use super::chart::stacked;
use super::findings::Finding;
use super::results::{Chart, Results};
use super::table::Table;
use super::trial::Trial;

/// What is claimed of a sweep: the claim, its sign, and the figure of a trial.
pub(super) type Claim = (&'static str, f64, fn(&Trial) -> f64);

/// The claims of the paper of more orders.
pub(super) const OF_ORDERS: &[Claim] = &[
    ("More orders, fewer pick-ups a courier", -1.0, |trial| trial.actions("pick_up_order")),
    ("More orders, fewer deliveries a courier", -1.0, |trial| trial.actions("deliver_order")),
    ("More orders, more moments without action", 1.0, |trial| trial.actions("do_nothing")),
    ("More orders, more sharing", 1.0, |trial| trial.metric("sharing_count")),
];

/// The claims of the paper of more money at the start.
pub(super) const OF_MONEY: &[Claim] = &[
    ("More money, fewer bids", -1.0, |trial| trial.actions("bid_order")),
    ("More money, more pick-ups", 1.0, |trial| trial.actions("pick_up_order")),
    ("More money, more scooters", 1.0, |trial| trial.metric("investment_count")),
];

/// Metrics that a sweep shows at each level.
const METRICS: [&str; 6] =
    ["profit", "orders_per_agent", "energy_per_dollar", "sharing_count", "investment_count", "bid_win_rate"];

/// Tables, charts and findings of a sweep over a quantity.
pub(super) fn results(trials: &[Trial], quantity: &str, claims: &[Claim]) -> Results {
    let levels = levels(trials);
    let x: Vec<f64> = trials.iter().map(|trial| trial.level).collect();
    let finding = |(claim, sign, figure): &Claim| {
        let y: Vec<f64> = trials.iter().map(figure).collect();
        Finding::trend(claim, *sign, &x, &y)
    };
    Results {
        tables: vec![actions_table(trials, &levels, quantity), metrics_table(trials, &levels, quantity)],
        charts: actions_charts(trials, &levels, quantity),
        findings: claims.iter().map(finding).collect(),
    }
}

fn levels(trials: &[Trial]) -> Vec<f64> {
    let mut levels: Vec<f64> = trials.iter().map(|trial| trial.level).collect();
    levels.sort_by(f64::total_cmp);
    levels.dedup();
    levels
}

/// The values of the trials of a level.
fn at<'a>(
    trials: &'a [Trial],
    level: f64,
    figure: impl Fn(&Trial) -> f64 + 'a,
) -> impl Iterator<Item = f64> + 'a {
    trials.iter().filter(move |trial| trial.level == level).map(figure)
}

fn header<'a>(quantity: &'a str, names: &[&'a str]) -> Vec<&'a str> {
    [quantity].into_iter().chain(names.iter().copied()).collect()
}

fn actions_table(trials: &[Trial], levels: &[f64], quantity: &str) -> Table {
    let mut table = Table::new("Actions a courier at each level", &header(quantity, CourierAction::NAMES));
    for level in levels {
        let cells = CourierAction::NAMES.iter().map(|name| {
            let each = |trial: &Trial| trial.actions(name) / trial.players.len().max(1) as f64;
            at(trials, *level, each).collect::<Accumulator>().to_string()
        });
        table.add(level.to_string(), cells);
    }
    table
}

fn metrics_table(trials: &[Trial], levels: &[f64], quantity: &str) -> Table {
    let mut table = Table::new("Metrics at each level, with 95 % intervals", &header(quantity, &METRICS));
    for level in levels {
        let cells = METRICS.iter().map(|name| {
            let values: Vec<f64> = at(trials, *level, |trial| trial.metric(name)).collect();
            with_interval(&values, name)
        });
        table.add(level.to_string(), cells);
    }
    table
}

/// A mean with its interval.
pub(super) fn with_interval(values: &[f64], name: &str) -> String {
    match bootstrap(values, mean, 2000, 0.95, Seed(0).stream("intervals").named(name)) {
        Some(interval) => format!("{:.2} [{:.2}, {:.2}]", mean(values), interval.low, interval.high),
        None => "-".to_owned(),
    }
}

/// All actions, and those that are not to do nothing: most are, and would hide the others.
fn actions_charts(trials: &[Trial], levels: &[f64], quantity: &str) -> Vec<Chart> {
    let share = |name: &&str| {
        let sums = levels.iter().map(|level| at(trials, *level, |trial| trial.actions(name)).sum());
        ((*name).to_owned(), sums.collect())
    };
    let parts: Vec<(String, Vec<f64>)> = CourierAction::NAMES.iter().map(share).collect();
    let names: Vec<String> = levels.iter().map(ToString::to_string).collect();
    let busy: Vec<_> = parts.iter().filter(|part| part.0 != "do_nothing").cloned().collect();
    vec![
        Chart {
            title: format!("Actions by {quantity}"),
            caption: "What the actions of all couriers are made of.".to_owned(),
            svg: stacked(&names, &parts, quantity),
        },
        Chart {
            title: format!("Actions by {quantity}, without moments of doing nothing"),
            caption: "What is left of them when a courier that decides to do nothing is not counted."
                .to_owned(),
            svg: stacked(&names, &busy, quantity),
        },
    ]
}
