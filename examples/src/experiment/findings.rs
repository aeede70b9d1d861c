//! Findings: what is claimed, and what the trials say of it.

use std::fmt;

use serde::Serialize;
use simworld_core::evaluation::{SignedRank, bootstrap, mean, permutation, signed_rank, spearman};
use simworld_core::seed::Seed;

/// How likely chance alone may be where a finding holds.
const SIGNIFICANT: f64 = 0.05;
/// Shuffles of a permutation test.
const SHUFFLES: u32 = 1999;

/// What the trials say of a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// The sign is the claimed one, and chance is an unlikely reason.
    Holds,
    /// The sign is the other one, and chance is an unlikely reason.
    Opposite,
    /// Chance would do as well.
    Undecided,
}

/// A claim of the paper, and what the trials say of it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Finding {
    /// The claim.
    pub claim: String,
    /// What the trials say.
    pub verdict: Verdict,
    /// By which figures.
    pub evidence: String,
}

impl Finding {
    /// Of a statistic whose sign is claimed, with the probability that chance reaches it.
    fn judged(claim: &str, claimed: f64, effect: f64, p: f64, evidence: String) -> Self {
        let verdict = match () {
            () if p > SIGNIFICANT || effect == 0.0 => Verdict::Undecided,
            () if effect * claimed > 0.0 => Verdict::Holds,
            () => Verdict::Opposite,
        };
        Self { claim: claim.to_owned(), verdict, evidence }
    }

    /// That two figures rise together (`claimed` 1) or against each other (-1).
    pub(super) fn trend(claim: &str, claimed: f64, x: &[f64], y: &[f64]) -> Self {
        let stream = Seed(0).stream("findings").named(claim);
        match (spearman(x, y), permutation(x, y, spearman, SHUFFLES, stream)) {
            (Some(rank), Some(p)) => {
                let evidence =
                    format!("Spearman's rank correlation {rank:.2} of {} pairs, {}", x.len(), probability(p));
                Self::judged(claim, claimed, rank, p, evidence)
            }
            _ => Self::silent(claim),
        }
    }

    /// That a figure of each trial is above zero (`claimed` 1) or below (-1): trials are what chance draws anew, while those who play
    /// stay the same. `what` names the figure.
    pub(super) fn across(claim: &str, claimed: f64, what: &str, figures: &[f64]) -> Self {
        let Some(SignedRank { positive, negative, p }) = signed_rank(figures) else {
            return Self::silent(claim);
        };
        let stream = Seed(0).stream("findings").named(claim);
        let interval = bootstrap(figures, mean, 2000, 0.95, stream)
            .map(|interval| format!(" [{:.2}, {:.2}]", interval.low, interval.high))
            .unwrap_or_default();
        let sided = figures.iter().filter(|figure| **figure * claimed > 0.0).count();
        let evidence = format!(
            "{what} {:.2}{interval} on average of {} seeds, with the claimed sign in {sided}, signed-rank test, {}",
            mean(figures),
            figures.len(),
            probability(p)
        );
        Self::judged(claim, claimed, positive - negative, p, evidence)
    }

    fn silent(claim: &str) -> Self {
        let evidence = "the trials do not vary in it".to_owned();
        Self { claim: claim.to_owned(), verdict: Verdict::Undecided, evidence }
    }
}

/// A probability as papers print it: one that is next to nothing is never called nothing.
fn probability(p: f64) -> String {
    if p < 0.0005 { "p < 0.001".to_owned() } else { format!("p = {p:.3}") }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Holds => "holds",
            Self::Opposite => "opposite",
            Self::Undecided => "undecided",
        })
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:<9}  {}: {}", self.verdict, self.claim, self.evidence)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_claim_holds_only_by_its_sign_and_against_chance() {
        let x: Vec<f64> = (0..12).map(f64::from).collect();
        let up: Vec<f64> = x.iter().map(|x| x * x).collect();
        assert_eq!(Finding::trend("more is more", 1.0, &x, &up).verdict, Verdict::Holds);
        assert_eq!(Finding::trend("more is less", -1.0, &x, &up).verdict, Verdict::Opposite);
        assert_eq!(Finding::trend("nothing", 1.0, &x, &[1.0; 12]).verdict, Verdict::Undecided);
        let mixed = [3.0, 1.0, 2.0, 3.0, 1.0, 2.0, 3.0, 1.0, 2.0, 3.0, 1.0, 2.0];
        assert_eq!((probability(0.000_05), probability(0.0123)), ("p < 0.001".into(), "p = 0.012".into()));
        assert_eq!(Finding::trend("chance", 1.0, &x, &mixed).verdict, Verdict::Undecided);
    }
}
