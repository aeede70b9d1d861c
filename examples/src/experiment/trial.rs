//! One seed of one setting.

use serde::{Deserialize, Serialize};
use simworld_agents::delivery::{CourierRow, DeliveryReport};
use simworld_core::hash::StateDigest;

use crate::delivery::{Auction, ModelUsage, Player, SeedRun};

/// What one seed of one setting came to.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trial {
    /// The name of the setting.
    pub arm: String,
    /// The quantity that is varied.
    pub level: f64,
    /// The seed.
    pub seed: u64,
    /// Couriers with bodies under physics at the start; the others were points.
    pub physical: u32,
    /// What models were asked, if couriers think with any.
    pub model: Option<ModelUsage>,
    /// The digest of the final state.
    pub digest: StateDigest,
    /// The five metrics and their kin, by name.
    pub metrics: Vec<(String, f64)>,
    /// Courier by courier.
    pub report: DeliveryReport,
    /// Who they were.
    pub players: Vec<Player>,
    /// What they bid.
    pub auctions: Vec<Auction>,
}

impl Trial {
    /// Of a finished run; `None` of one that never began.
    pub(super) fn of(arm: &super::Arm, run: SeedRun) -> Option<Self> {
        Some(Self {
            arm: arm.name.clone(),
            level: arm.level,
            seed: run.report.seed.0,
            physical: run.report.physical,
            model: run.report.model,
            digest: run.report.digest,
            metrics: run.report.metrics.into_iter().map(|metric| (metric.name, metric.value)).collect(),
            report: run.couriers?,
            players: run.players,
            auctions: run.auctions,
        })
    }

    /// A metric by name; zero if there is none of it.
    pub(crate) fn metric(&self, name: &str) -> f64 {
        self.metrics.iter().find(|metric| metric.0 == name).map_or(0.0, |metric| metric.1)
    }

    /// Each courier with who it is.
    pub(super) fn couriers(&self) -> impl Iterator<Item = (&Player, &CourierRow)> {
        self.players.iter().zip(&self.report.couriers)
    }

    /// How often all couriers together carried out an action.
    pub(super) fn actions(&self, name: &str) -> f64 {
        let counts = self.report.couriers.iter().flat_map(|row| &row.actions);
        counts.filter(|action| action.0 == name).map(|action| f64::from(action.1)).sum()
    }

    /// Every bid of the trial as a share of its ceiling: who, the share, whether it won.
    pub(super) fn bids(&self) -> impl Iterator<Item = (usize, f64, bool)> + '_ {
        self.auctions.iter().flat_map(Auction::shares)
    }
}
