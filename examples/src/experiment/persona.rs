//! Character and conduct: how the five traits go together with what couriers do and achieve.
//!
//! Some traits bias a policy by design, so their correlation with the conduct that they bias is no discovery; what emerges,
//! such as wins and profit, is. Each claim is held against shuffled couriers, for whom nothing but chance is at work.

use nalgebra::{DMatrix, DVector};
use simworld_agents::delivery::{CourierRow, Persona};
use simworld_core::evaluation::{Accumulator, pearson, quantile};
use simworld_core::seed::Seed;

use super::chart::{Scale, heat};
use super::findings::Finding;
use super::results::{Chart, Results};
use super::table::Table;
use super::trial::Trial;

/// Samples of the bootstrap of a regression.
const ROUNDS: usize = 1000;

/// A trait: its name, and how much a persona has of it.
type Trait = (&'static str, fn(&Persona) -> f64);

/// The traits.
const TRAITS: [Trait; 5] = [
    ("openness", |persona| persona.openness),
    ("conscientiousness", |persona| persona.conscientiousness),
    ("extraversion", |persona| persona.extraversion),
    ("agreeableness", |persona| persona.agreeableness),
    ("neuroticism", |persona| persona.neuroticism),
];

/// A courier of a trial: its traits and its conduct.
struct Sample {
    traits: [f64; 5],
    conduct: Vec<f64>,
}

/// What is seen of a courier.
const CONDUCT: [&str; 10] = [
    "bids",
    "bid / ceiling",
    "spread of bids",
    "win rate",
    "pick-ups",
    "deliveries",
    "idle moments",
    "shared",
    "scooters",
    "profit",
];

/// Claims of the paper: trait, conduct, sign.
const CLAIMS: [(&str, &str, &str, f64); 7] = [
    ("The conscientious bid less", "conscientiousness", "bids", -1.0),
    ("The conscientious pick up more", "conscientiousness", "pick-ups", 1.0),
    ("The conscientious win more of their bids", "conscientiousness", "win rate", 1.0),
    ("The agreeable are idle less", "agreeableness", "idle moments", -1.0),
    ("The agreeable win more of their bids", "agreeableness", "win rate", 1.0),
    ("The disagreeable bid in a narrow range", "agreeableness", "spread of bids", 1.0),
    ("The open deliver less", "openness", "deliveries", -1.0),
];

/// Tables, charts and findings of personas.
pub(super) fn results(trials: &[Trial]) -> Results {
    let samples: Vec<Sample> = trials.iter().flat_map(samples).collect();
    let find = |name: &str| CONDUCT.iter().position(|conduct| *conduct == name).unwrap_or(0);
    let trait_of = |name: &str| TRAITS.iter().position(|known| known.0 == name).unwrap_or(0);
    let finding = |(claim, character, conduct, sign): &(&str, &str, &str, f64)| {
        let (x, y) = (column(&samples, trait_of(character)), behaviour(&samples, find(conduct)));
        Finding::trend(claim, *sign, &x, &y)
    };
    Results {
        tables: vec![regressions(&samples)],
        charts: vec![correlations(&samples)],
        findings: CLAIMS.iter().map(finding).collect(),
    }
}

fn samples(trial: &Trial) -> Vec<Sample> {
    let mut bids = vec![Accumulator::default(); trial.players.len()];
    for (who, share, _) in trial.bids() {
        bids[who].push(share);
    }
    let sample = |((player, row), bids): ((&crate::delivery::Player, &CourierRow), &Accumulator)| {
        let idle = row.actions.iter().find(|action| action.0 == "do_nothing").map_or(0, |action| action.1);
        let rate = f64::from(row.won) / f64::from(row.bids.max(1));
        Sample {
            traits: TRAITS.map(|(_, of)| of(&player.persona)),
            conduct: vec![
                f64::from(row.bids),
                bids.mean(),
                bids.deviation(),
                rate,
                f64::from(row.picked_up),
                f64::from(row.delivered),
                f64::from(idle),
                f64::from(row.shared),
                f64::from(row.scooters),
                row.profit.dollars(),
            ],
        }
    };
    trial.couriers().zip(&bids).map(sample).collect()
}

fn column(samples: &[Sample], character: usize) -> Vec<f64> {
    samples.iter().map(|sample| sample.traits[character]).collect()
}

fn behaviour(samples: &[Sample], conduct: usize) -> Vec<f64> {
    samples.iter().map(|sample| sample.conduct[conduct]).collect()
}

fn correlations(samples: &[Sample]) -> Chart {
    let row = |character: usize| -> Vec<Option<f64>> {
        let traits = column(samples, character);
        (0..CONDUCT.len()).map(|conduct| pearson(&traits, &behaviour(samples, conduct))).collect()
    };
    let values: Vec<Vec<Option<f64>>> = (0..TRAITS.len()).map(row).collect();
    let names = TRAITS.map(|(name, _)| name.to_owned());
    Chart {
        title: "Traits and conduct".to_owned(),
        caption: format!(
            "Pearson's correlation over {} couriers; empty where conduct does not vary.",
            samples.len()
        ),
        svg: heat(&names, &CONDUCT.map(str::to_owned), &values, Scale { middle: 0.0, reach: 0.6 }),
    }
}

/// What a trait that is greater by one adds to each conduct, all others equal, with its interval.
fn regressions(samples: &[Sample]) -> Table {
    let header: Vec<&str> = ["conduct"].into_iter().chain(TRAITS.map(|(name, _)| name)).collect();
    let mut table = Table::new("Regression on the traits, with 95 % intervals", &header);
    for (conduct, name) in CONDUCT.iter().enumerate() {
        let rows: Vec<usize> = (0..samples.len()).collect();
        let Some(whole) = regression(samples, conduct, &rows) else { continue };
        let draws = resampled(samples, conduct, name);
        let cells = (0..TRAITS.len()).map(|character| {
            let values: Vec<f64> = draws.iter().map(|draw| draw[character]).collect();
            match (quantile(&values, 0.025), quantile(&values, 0.975)) {
                (Some(low), Some(high)) => format!("{:.2} [{low:.2}, {high:.2}]", whole[character]),
                _ => format!("{:.2}", whole[character]),
            }
        });
        table.add(*name, cells);
    }
    table
}

/// Slopes of samples drawn with replacement (Efron 1979).
fn resampled(samples: &[Sample], conduct: usize, name: &str) -> Vec<[f64; 5]> {
    let mut rng = Seed(0).stream("regression").named(name).rng();
    let mut draw = || {
        let rows: Vec<usize> = (0..samples.len()).map(|_| rng.below(samples.len())).collect();
        regression(samples, conduct, &rows)
    };
    (0..ROUNDS).filter_map(|_| draw()).collect()
}

/// Least squares with an intercept; `None` where the traits do not vary apart from each other.
fn regression(samples: &[Sample], conduct: usize, rows: &[usize]) -> Option<[f64; 5]> {
    let design = DMatrix::from_fn(rows.len(), TRAITS.len() + 1, |row, column| {
        if column == 0 { 1.0 } else { samples[rows[row]].traits[column - 1] }
    });
    let seen = DVector::from_iterator(rows.len(), rows.iter().map(|row| samples[*row].conduct[conduct]));
    let slopes = (design.transpose() * &design).cholesky()?.solve(&(design.transpose() * seen));
    Some(std::array::from_fn(|character| slopes[character + 1]))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_regression_finds_the_slopes_that_made_the_values() {
        let mut rng = Seed(5).stream("traits").rng();
        let slopes = [2.0, -1.0, 0.0, 0.5, 3.0];
        let samples: Vec<Sample> = (0..200)
            .map(|_| {
                let traits: [f64; 5] = std::array::from_fn(|_| rng.uniform(-1.0, 1.0));
                let value: f64 = traits.iter().zip(slopes).map(|(x, slope)| x * slope).sum();
                Sample { traits, conduct: vec![4.0 + value + rng.normal(0.0, 0.1)] }
            })
            .collect();
        let rows: Vec<usize> = (0..200).collect();
        let found = regression(&samples, 0, &rows).unwrap();
        for (found, made) in found.into_iter().zip(slopes) {
            assert!((found - made).abs() < 0.05, "{found} for {made}");
        }
        assert_eq!(
            regression(&samples[..3], 0, &[0, 1, 2]).filter(|s| s.iter().all(|x| x.is_finite())),
            None
        );
    }
}
