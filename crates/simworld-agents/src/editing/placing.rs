//! What became of the places that were tried for a thing, and in words why it stands where it stands.

use std::collections::BTreeMap;

use simworld_core::geometry::Pose;
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityRef, Scene};

use super::describe::called;
use super::land::{Land, LandFit};

/// So much of a score is how near a place is to where people would look first; the rest is the ground, of which the better wins
/// wherever it lies within what was asked for.
const NEARNESS: f64 = 0.1;

/// What became of a place that was tried.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Outcome {
    /// It is possible; the greater score is taken, from 0 to 1.
    Fits {
        /// A tenth of it how near it is to where people would look first, nine tenths how well the ground suits.
        score: f64,
        /// The ground.
        fit: LandFit,
    },
    /// Something stands there.
    Collides {
        /// What.
        with: EntityId,
    },
    /// It would stand in front of a door.
    Blocks {
        /// Whose.
        door: EntityId,
    },
    /// The ground is for something else.
    Land {
        /// Why not.
        why: &'static str,
    },
    /// Nothing holds it up there.
    Unsupported,
    /// Another relation that was asked for does not hold there.
    Elsewhere,
}

impl Outcome {
    /// Of a place that is possible: how far it is from where people would look first, from 0 to 1, and its ground.
    pub(super) fn fits(odd: f64, fit: LandFit) -> Self {
        Self::Fits { score: NEARNESS * (1.0 - odd) + of_ground(fit), fit }
    }

    /// What became of it, in words.
    ///
    /// ```
    /// use simworld_agents::editing::Outcome;
    /// use simworld_core::scene::World;
    /// let refused = Outcome::Land { why: "a carriageway is for traffic" };
    /// assert_eq!(refused.told(&World::new()), "a carriageway is for traffic");
    /// ```
    pub fn told(&self, scene: &dyn Scene) -> String {
        let label = |id: &EntityId| {
            let told = |entity: EntityRef<'_>| format!("{} ({id})", called(scene, &entity));
            scene.entity(*id).map_or_else(|| id.to_string(), told)
        };
        match self {
            Self::Fits { score, fit } => format!("{}: {score:.2} of 1", fit.land.told()),
            Self::Collides { with } => format!("{} is in the way", label(with)),
            Self::Blocks { door } => format!("the door of {} would be blocked", label(door)),
            Self::Land { why } => (*why).to_owned(),
            Self::Unsupported => "it would not stand safely".to_owned(),
            Self::Elsewhere => "not all that was asked holds there".to_owned(),
        }
    }
}

/// How much of a score the ground gives.
fn of_ground(fit: LandFit) -> f64 {
    (1.0 - NEARNESS) * fit.suits
}

/// A place that was tried.
#[derive(Clone, Debug, PartialEq)]
pub struct Candidate {
    /// World from body.
    pub pose: Pose,
    /// What became of it.
    pub outcome: Outcome,
}

impl Candidate {
    /// How good the place is, from 0 to 1, if it is possible.
    pub fn score(&self) -> Option<f64> {
        if let Outcome::Fits { score, .. } = self.outcome { Some(score) } else { None }
    }

    /// The ground of the place, if it is possible.
    pub fn fit(&self) -> Option<LandFit> {
        if let Outcome::Fits { fit, .. } = self.outcome { Some(fit) } else { None }
    }
}

/// What was tried for one thing, and which place was taken.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Placing {
    /// Every place, in the order of trial.
    pub candidates: Vec<Candidate>,
    /// Index of the one that was taken.
    pub taken: Option<usize>,
}

impl Placing {
    /// World from body, if a place was found.
    pub fn pose(&self) -> Option<Pose> {
        Some(self.candidates[self.taken?].pose)
    }

    /// The ground of the place that was taken.
    pub fn fit(&self) -> Option<LandFit> {
        self.candidates[self.taken?].fit()
    }

    /// Other places that would do, the best first.
    pub fn alternatives(&self) -> Vec<&Candidate> {
        let others = self.candidates.iter().enumerate().filter(|(index, _)| Some(*index) != self.taken);
        let mut fitting: Vec<(f64, &Candidate)> =
            others.filter_map(|(_, candidate)| Some((candidate.score()?, candidate))).collect();
        fitting.sort_by(|a, b| b.0.total_cmp(&a.0));
        fitting.into_iter().map(|(_, candidate)| candidate).collect()
    }

    /// Why the place was taken: what the ground there is for, what that and its nearness are worth, and on what ground the other
    /// places lie that would do. None where no place was taken.
    pub fn explained(&self) -> Option<String> {
        let taken = &self.candidates[self.taken?];
        let (score, fit) = (taken.score()?, taken.fit()?);
        let how = match fit {
            LandFit { astray: true, .. } => "for want of better ground",
            LandFit { suits, .. } if suits >= 1.0 => "as it should",
            _ => "which will do",
        };
        let (ground, nearness) = (of_ground(fit), score - of_ground(fit));
        let mut grounds: BTreeMap<Land, usize> = BTreeMap::new();
        for candidate in self.candidates.iter().filter_map(Candidate::fit) {
            *grounds.entry(candidate.land).or_default() += 1;
        }
        let all: usize = grounds.values().sum();
        let told: Vec<String> =
            grounds.iter().map(|(land, count)| format!("{count} {}", land.told())).collect();
        Some(format!(
            "it stands {}, {how}: {score:.2} of 1, of which {ground:.2} for the ground and {nearness:.2} for how near that is to \
             where one looks first; of {all} places that would do {}",
            fit.land.told(),
            told.join(", ")
        ))
    }

    /// What spoke against the places that were thrown out, the most frequent reason first.
    pub fn reasons(&self, scene: &dyn Scene) -> String {
        let mut counts: BTreeMap<String, usize> = BTreeMap::new();
        for candidate in self.candidates.iter().filter(|candidate| candidate.score().is_none()) {
            *counts.entry(candidate.outcome.told(scene)).or_default() += 1;
        }
        let mut counts: Vec<_> = counts.into_iter().collect();
        counts.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
        let all = self.candidates.len();
        let said: Vec<String> =
            counts.iter().take(3).map(|(why, count)| format!("{why} at {count} of {all} places")).collect();
        if said.is_empty() { "no such place".to_owned() } else { said.join(", ") }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn on(land: Land, suits: f64, odd: f64) -> Candidate {
        let fit = LandFit { land, suits, astray: suits < 0.4 };
        Candidate { pose: Pose::identity(), outcome: Outcome::fits(odd, fit) }
    }

    #[test]
    fn better_ground_is_worth_more_than_the_nearest_place_on_worse() {
        let steps = [0.0, 0.15, 0.3, 0.5, 0.7, 0.85, 1.0];
        for pair in steps.windows(2) {
            let (near, far) = (on(Land::Lot, pair[0], 0.0), on(Land::Lot, pair[1], 1.0));
            assert!(near.score() < far.score(), "{pair:?}");
        }
        assert_eq!(on(Land::Green, 1.0, 0.0).score(), Some(1.0));
        assert!(on(Land::Green, 1.0, 0.2).score() > on(Land::Green, 1.0, 0.4).score());
    }

    #[test]
    fn the_ground_and_its_worth_are_told() {
        let placing = Placing {
            candidates: vec![
                on(Land::Lot, 0.3, 0.0),
                on(Land::Paving, 0.7, 0.2),
                Candidate { pose: Pose::identity(), outcome: Outcome::Elsewhere },
                on(Land::Lot, 0.3, 0.5),
            ],
            taken: Some(1),
        };
        let told = placing.explained().expect("a place was taken");
        assert!(told.contains("it stands on paving, which will do: 0.71 of 1"), "{told}");
        assert!(told.contains("0.63 for the ground and 0.08 for how near"), "{told}");
        assert!(
            told.contains("of 3 places that would do 2 on open ground beside a street, 1 on paving"),
            "{told}"
        );
        let astray = Placing { taken: Some(0), ..placing };
        assert!(astray.explained().is_some_and(|told| told.contains("for want of better ground")));
        assert_eq!(Placing::default().explained(), None);
    }
}
