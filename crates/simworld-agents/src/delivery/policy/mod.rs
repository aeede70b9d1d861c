//! Couriers without a model: twelve ways of bidding on one way of working, biased by a persona.
//!
//! They stand in for the paper's twelve models. A mind thinks when something happened that concerns it, after a
//! short reaction time, and at least every few seconds; it never thinks every step.

mod bidding;
mod mind;
mod pace;
mod persona;

use serde::{Deserialize, Serialize};
use simworld_core::seed::Stream;

pub use mind::CourierMind;
pub use persona::{Persona, PersonaError};

use super::DeliveryTask;
use crate::mind::Mind;

/// How a courier bids.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum PolicyKind {
    /// What it costs, and 10 % more.
    CostPlusLow,
    /// What it costs, and 35 % more.
    CostPlusMedium,
    /// What it costs, and 80 % more.
    CostPlusHigh,
    /// Always close under the ceiling.
    FixedNarrow,
    /// Anything from a third of the ceiling to all of it.
    WideRandom,
    /// A margin that rises with every win and falls with every loss.
    WinRateAdaptive,
    /// A share of the ceiling learnt by exponential weights (EXP3, Auer et al. 2002).
    Exp3,
    /// Just under the last winning share of the ceiling, but not under cost.
    BestResponse,
    /// Only orders close by.
    NearestOnly,
    /// The order that is worth most for each metre.
    ValueDensity,
    /// Whatever wins.
    Lowballer,
    /// Almost nothing.
    NearlyInactive,
}

impl PolicyKind {
    /// Every policy, in the order of declaration.
    pub const ALL: [Self; 12] = [
        Self::CostPlusLow,
        Self::CostPlusMedium,
        Self::CostPlusHigh,
        Self::FixedNarrow,
        Self::WideRandom,
        Self::WinRateAdaptive,
        Self::Exp3,
        Self::BestResponse,
        Self::NearestOnly,
        Self::ValueDensity,
        Self::Lowballer,
        Self::NearlyInactive,
    ];

    /// The name in files and tables.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::CostPlusLow => "cost_plus_low",
            Self::CostPlusMedium => "cost_plus_medium",
            Self::CostPlusHigh => "cost_plus_high",
            Self::FixedNarrow => "fixed_narrow",
            Self::WideRandom => "wide_random",
            Self::WinRateAdaptive => "win_rate_adaptive",
            Self::Exp3 => "exp3",
            Self::BestResponse => "best_response",
            Self::NearestOnly => "nearest_only",
            Self::ValueDensity => "value_density",
            Self::Lowballer => "lowballer",
            Self::NearlyInactive => "nearly_inactive",
        }
    }

    /// A mind of this policy; give every courier a stream of its own.
    pub fn mind(self, persona: Persona, stream: Stream) -> Box<dyn Mind<DeliveryTask>> {
        Box::new(CourierMind::new(self, persona, stream))
    }
}

impl std::fmt::Display for PolicyKind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.as_str())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_serde() {
        for kind in PolicyKind::ALL {
            assert_eq!(serde_json::to_string(&kind).unwrap(), format!("\"{kind}\""));
        }
    }
}
