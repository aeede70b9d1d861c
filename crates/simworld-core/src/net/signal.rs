//! Traffic signals as data: groups, phases, plans.

use serde::{Deserialize, Serialize};

use super::Few;
use crate::id::IntersectionId;

/// What a signal shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Aspect {
    /// Stop; for pedestrians "don't walk".
    #[default]
    Red,
    /// Stop if you can; for pedestrians "finish crossing, do not start".
    Yellow,
    /// Go, giving way where others have priority; for pedestrians "walk".
    Green,
}

/// A set of signal heads that always show the same aspect; an index into [`Scene::signals`].
///
/// [`Scene::signals`]: crate::scene::Scene::signals
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(transparent)]
pub struct SignalGroup(pub u32);

impl SignalGroup {
    /// Its position in the array of aspects.
    pub const fn index(self) -> usize {
        self.0 as usize
    }
}

/// One interval of a plan during which no aspect changes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Phase {
    /// How long it lasts, s.
    pub duration: f64,
    /// Groups that show green, ascending.
    pub green: Few<SignalGroup>,
    /// Groups that show yellow, ascending; all others of the plan show red.
    pub yellow: Few<SignalGroup>,
}

impl Phase {
    /// What a group of this plan shows during the phase.
    pub fn aspect(&self, group: SignalGroup) -> Aspect {
        if self.green.binary_search(&group).is_ok() {
            Aspect::Green
        } else if self.yellow.binary_search(&group).is_ok() {
            Aspect::Yellow
        } else {
            Aspect::Red
        }
    }
}

/// The timing plan of one signalised intersection: phases in a cycle.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SignalPlan {
    /// Where it stands.
    pub intersection: IntersectionId,
    /// The groups it governs, ascending.
    pub groups: Vec<SignalGroup>,
    /// Time into the cycle at tick zero, s.
    pub offset: f64,
    /// The phases, in order.
    pub phases: Vec<Phase>,
}

impl SignalPlan {
    /// The length of the cycle, s.
    pub fn cycle(&self) -> f64 {
        self.phases.iter().map(|phase| phase.duration).sum()
    }
}
