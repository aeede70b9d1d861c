//! Minds against minds: who bids what, who wins, and against whom.

use std::collections::BTreeMap;

use simworld_core::evaluation::{Accumulator, Groups};

use super::chart::{Dots, Scale, heat, violins};
use super::claims;
use super::results::{Chart, Results};
use super::table::Table;
use super::trial::Trial;
use crate::delivery::Brain;

/// What the bids of a policy came to.
#[derive(Clone, Debug, Default)]
pub(super) struct Bidding {
    /// Bids as shares of the ceiling.
    pub(super) shares: Accumulator,
    /// One for each bid that won, zero for the others.
    pub(super) wins: Accumulator,
    /// The shares of those that won.
    pub(super) winning: Accumulator,
    dots: Dots,
}

/// Tables, charts and findings of bidding.
pub(super) fn results(trials: &[Trial]) -> Results {
    let policies = policies(trials);
    let bidding = bidding(trials);
    let wins = wins(trials);
    Results {
        tables: vec![by_policy(trials, &policies, &bidding)],
        charts: vec![violin_chart(&policies, &bidding), matrix(&policies, &wins)],
        findings: claims::findings(trials),
    }
}

/// The policies that play, in the order of declaration.
fn policies(trials: &[Trial]) -> Vec<Brain> {
    let plays = |policy: &Brain| trials.iter().any(|t| t.players.iter().any(|p| p.policy == *policy));
    Brain::all().filter(plays).collect()
}

pub(super) fn bidding(trials: &[Trial]) -> BTreeMap<Brain, Bidding> {
    let mut all: BTreeMap<Brain, Bidding> = BTreeMap::new();
    for trial in trials {
        for (who, share, won) in trial.bids() {
            let bidding = all.entry(trial.players[who].policy).or_default();
            bidding.shares.push(share);
            bidding.wins.push(f64::from(u8::from(won)));
            bidding.winning.extend(won.then_some(share));
            bidding.dots.push((share, won));
        }
    }
    all
}

/// How often one policy won where another bid too.
pub(super) fn wins(trials: &[Trial]) -> BTreeMap<(Brain, Brain), u32> {
    let mut wins = BTreeMap::new();
    for trial in trials {
        for auction in &trial.auctions {
            let Some(winner) = auction.winner else { continue };
            for (loser, _) in auction.bids.iter().filter(|bid| bid.0 != winner) {
                let pair = (trial.players[winner].policy, trial.players[*loser].policy);
                *wins.entry(pair).or_default() += u32::from(pair.0 != pair.1);
            }
        }
    }
    wins
}

fn by_policy(trials: &[Trial], policies: &[Brain], bidding: &BTreeMap<Brain, Bidding>) -> Table {
    let mut profits: Groups<Brain> = Groups::default();
    let mut delivered: Groups<Brain> = Groups::default();
    for (player, row) in trials.iter().flat_map(Trial::couriers) {
        profits.push(player.policy, row.profit.dollars());
        delivered.push(player.policy, f64::from(row.delivered));
    }
    let header = ["policy", "bids", "bid / ceiling", "won", "win rate", "profit $", "delivered"];
    let mut table = Table::new("Bids, wins and profit by policy", &header);
    for policy in policies {
        let Bidding { shares, wins, .. } = bidding.get(policy).cloned().unwrap_or_default();
        let of = |groups: &Groups<Brain>| groups.get(policy).map_or("-".to_owned(), ToString::to_string);
        table.add(
            policy.as_str(),
            [
                shares.count().to_string(),
                shares.to_string(),
                format!("{:.0}", wins.sum()),
                format!("{:.2}", wins.mean()),
                of(&profits),
                of(&delivered),
            ],
        );
    }
    table
}

fn violin_chart(policies: &[Brain], bidding: &BTreeMap<Brain, Bidding>) -> Chart {
    let groups: Vec<(String, Dots)> = policies
        .iter()
        .map(|policy| {
            let dots = bidding.get(policy).map_or_else(Dots::default, |bidding| bidding.dots.clone());
            (policy.as_str().to_owned(), dots)
        })
        .collect();
    Chart {
        title: "Bids by policy".to_owned(),
        caption: "Bids as shares of the ceiling price; coloured dots are those that won.".to_owned(),
        svg: violins(&groups, (0.0, 1.0), "bid / ceiling"),
    }
}

fn matrix(policies: &[Brain], wins: &BTreeMap<(Brain, Brain), u32>) -> Chart {
    let names: Vec<String> = policies.iter().map(ToString::to_string).collect();
    let count = |a: Brain, b: Brain| f64::from(wins.get(&(a, b)).copied().unwrap_or_default());
    let share = |a: Brain, b: Brain| {
        let both = count(a, b) + count(b, a);
        (both > 0.0).then(|| count(a, b) / both)
    };
    let values: Vec<Vec<Option<f64>>> =
        policies.iter().map(|a| policies.iter().map(|b| share(*a, *b)).collect()).collect();
    Chart {
        title: "Wins and losses".to_owned(),
        caption: "How often the policy of a row won where both bid and one of them won.".to_owned(),
        svg: heat(&names, &names, &values, Scale { middle: 0.5, reach: 0.5 }),
    }
}
