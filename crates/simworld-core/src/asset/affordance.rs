//! Affordances: what one can do with a thing.

use std::fmt;

use serde::{Deserialize, Serialize};

use crate::scene::EntityKind;

/// Something that one can do with a thing.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Affordance {
    /// To sit down on it.
    Sit,
    /// To open and close it.
    Open,
    /// To take it into one hand.
    PickUp,
    /// To take it into both arms.
    Carry,
    /// To stand on it and ride it.
    Ride,
    /// To get into it, or on to it, and drive it.
    Enter,
}

impl Affordance {
    /// Every affordance, in the order of declaration.
    pub const ALL: &'static [Self] =
        &[Self::Sit, Self::Open, Self::PickUp, Self::Carry, Self::Ride, Self::Enter];

    /// The name in files.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Sit => "sit",
            Self::Open => "open",
            Self::PickUp => "pick_up",
            Self::Carry => "carry",
            Self::Ride => "ride",
            Self::Enter => "enter",
        }
    }
}

impl fmt::Display for Affordance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.as_str())
    }
}

/// A set of affordances; in files it is a list.
///
/// ```
/// use simworld_core::asset::{Affordance, AffordanceSet};
/// let couch = AffordanceSet::of(&[Affordance::Sit]);
/// assert!(couch.contains(Affordance::Sit) && !couch.contains(Affordance::Ride));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(from = "Vec<Affordance>", into = "Vec<Affordance>")]
pub struct AffordanceSet(u8);

impl AffordanceSet {
    /// Nothing can be done with it.
    pub const NONE: Self = Self(0);

    /// The set of these.
    pub const fn of(affordances: &[Affordance]) -> Self {
        let (mut bits, mut index) = (0, 0);
        while index < affordances.len() {
            bits |= 1 << affordances[index] as u8;
            index += 1;
        }
        Self(bits)
    }

    /// What one can do with a thing of that kind, where its asset does not say.
    pub const fn of_kind(kind: EntityKind) -> Self {
        use Affordance::{Carry, Enter, Open, PickUp, Ride, Sit};
        match kind {
            EntityKind::Parcel => Self::of(&[PickUp, Carry]),
            EntityKind::Chair => Self::of(&[Sit, Carry]),
            EntityKind::Bench => Self::of(&[Sit]),
            EntityKind::Cone | EntityKind::Prop => Self::of(&[Carry]),
            EntityKind::Scooter => Self::of(&[Ride]),
            EntityKind::Door | EntityKind::Building => Self::of(&[Open]),
            EntityKind::Car
            | EntityKind::Truck
            | EntityKind::Bus
            | EntityKind::Motorcycle
            | EntityKind::Bicycle => Self::of(&[Enter]),
            _ => Self::NONE,
        }
    }

    /// Whether it is in the set.
    pub const fn contains(self, affordance: Affordance) -> bool {
        self.0 & (1 << affordance as u8) != 0
    }

    /// Whether there is none.
    pub const fn is_empty(self) -> bool {
        self.0 == 0
    }

    /// Those of the set, in the order of declaration.
    pub fn iter(self) -> impl Iterator<Item = Affordance> {
        Affordance::ALL.iter().copied().filter(move |affordance| self.contains(*affordance))
    }
}

impl From<Vec<Affordance>> for AffordanceSet {
    fn from(affordances: Vec<Affordance>) -> Self {
        Self::of(&affordances)
    }
}

impl From<AffordanceSet> for Vec<Affordance> {
    fn from(set: AffordanceSet) -> Self {
        set.iter().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_set_is_a_list_in_files() {
        let set = AffordanceSet::of(&[Affordance::PickUp, Affordance::Sit, Affordance::Sit]);
        let text = serde_json::to_string(&set).unwrap();
        assert_eq!(text, r#"["sit","pick_up"]"#);
        assert_eq!(serde_json::from_str::<AffordanceSet>(&text).unwrap(), set);
        for affordance in Affordance::ALL {
            assert_eq!(serde_json::to_string(affordance).unwrap(), format!("\"{affordance}\""));
        }
        assert!(AffordanceSet::NONE.is_empty() && AffordanceSet::NONE.iter().next().is_none());
    }
}
