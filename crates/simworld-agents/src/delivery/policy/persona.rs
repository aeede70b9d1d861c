//! The Big Five traits, and how they bias a policy.
//!
//! The signs follow common readings of the traits and the paper's findings; the sizes are chosen. Correlating a
//! bias set here with the behaviour it sets would be circular: report what emerges (win rate, profit) instead.

use serde::{Deserialize, Serialize};
use thiserror::Error;

/// A personality: five traits, each in [-1, 1], zero for the average.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Persona {
    /// Curious rather than cautious.
    pub openness: f64,
    /// Organised rather than careless.
    pub conscientiousness: f64,
    /// Outgoing rather than reserved.
    pub extraversion: f64,
    /// Friendly rather than critical.
    pub agreeableness: f64,
    /// Nervous rather than confident.
    pub neuroticism: f64,
}

/// A trait out of range.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{name} = {value} is out of range: give -1 to 1")]
pub struct PersonaError {
    /// Which trait.
    pub name: &'static str,
    /// Its value.
    pub value: f64,
}

impl Persona {
    /// Checks that every trait is in [-1, 1].
    ///
    /// # Errors
    /// The first that is not.
    pub fn validate(&self) -> Result<(), PersonaError> {
        let traits = [
            ("openness", self.openness),
            ("conscientiousness", self.conscientiousness),
            ("extraversion", self.extraversion),
            ("agreeableness", self.agreeableness),
            ("neuroticism", self.neuroticism),
        ];
        match traits.into_iter().find(|(_, value)| !(-1.0..=1.0).contains(value)) {
            Some((name, value)) => Err(PersonaError { name, value }),
            None => Ok(()),
        }
    }

    /// Probability of bidding when there is something to bid for.
    pub(super) fn bid_rate(&self) -> f64 {
        (0.9 - 0.25 * self.conscientiousness + 0.1 * self.extraversion).clamp(0.05, 1.0)
    }

    /// Factor on every bid.
    pub(super) fn price_factor(&self) -> f64 {
        1.0 - 0.1 * self.agreeableness - 0.05 * self.conscientiousness
    }

    /// Half width of the random factor on every bid.
    pub(super) fn spread(&self) -> f64 {
        (0.03 + 0.05 * self.openness + 0.03 * self.agreeableness).max(0.0)
    }

    /// Probability of letting a moment pass.
    pub(super) fn idleness(&self) -> f64 {
        (0.05 - 0.1 * self.agreeableness - 0.1 * self.conscientiousness).clamp(0.0, 0.5)
    }

    /// Probability of offering an order, or of taking an offer, at one thought.
    pub(super) fn sharing(&self) -> f64 {
        (0.004 + 0.006 * self.agreeableness + 0.004 * self.extraversion).max(0.0)
    }

    /// How much an investment must promise, as a multiple of its price; less for the bold.
    pub(super) fn caution(&self) -> f64 {
        (1.0 + 0.4 * self.neuroticism - 0.8 * self.openness).max(0.2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_trait_out_of_range_is_named() {
        assert_eq!(Persona::default().validate(), Ok(()));
        let wild = Persona { openness: f64::NAN, ..Persona::default() };
        assert_eq!(wild.validate().unwrap_err().name, "openness");
    }
}
