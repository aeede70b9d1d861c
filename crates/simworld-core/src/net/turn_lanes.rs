//! What is painted on lanes before a junction: which turns they are for.

use serde::{Deserialize, Serialize};

use super::Turn;
use crate::rare::Blank;

/// A set of turns; an empty one allows whatever the junction does.
///
/// ```
/// use simworld_core::net::{Turn, TurnSet};
/// let arrow = TurnSet::of(&[Turn::Straight, Turn::Right]);
/// assert!(arrow.allows(Turn::Right) && !arrow.allows(Turn::Left));
/// assert!(TurnSet::ANY.allows(Turn::Left));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(transparent)]
pub struct TurnSet(u8);

impl TurnSet {
    /// No arrow: whatever the junction allows.
    pub const ANY: Self = Self(0);

    /// An arrow for these turns.
    pub const fn of(turns: &[Turn]) -> Self {
        let (mut bits, mut index) = (0, 0);
        while index < turns.len() {
            bits |= Self::bit(turns[index]);
            index += 1;
        }
        Self(bits)
    }

    const fn bit(turn: Turn) -> u8 {
        match turn {
            Turn::Straight => 1,
            Turn::Right => 2,
            Turn::Left => 4,
            Turn::UTurn => 8,
        }
    }

    /// Whether there is no arrow.
    pub const fn is_any(self) -> bool {
        self.0 == 0
    }

    /// Whether one may turn so.
    pub const fn allows(self, turn: Turn) -> bool {
        self.is_any() || self.0 & Self::bit(turn) != 0
    }

    /// With left and right exchanged.
    #[must_use]
    pub const fn mirrored(self) -> Self {
        Self(self.0 & !6 | (self.0 & 2) << 1 | (self.0 & 4) >> 1)
    }

    pub(crate) const fn is_known(self) -> bool {
        self.0 < 16
    }
}

/// The ways from the lanes of a street into one of the others at a junction, where a source of roads knows them lane by
/// lane. They go before arrows and before the rules by which a junction is laid out else.
///
/// The other street is told by the direction in which it leaves: that stays true when streets get other numbers, and a
/// street that an edit adds is none of those that are known.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LaneWays {
    /// Direction in which the other street leaves the junction, radians: that one is meant which leaves nearest to it, if
    /// one does within 0.2.
    pub heading: f64,
    /// Which lane leads to which lane of that street, ascending; both are counted from the middle outwards, as in
    /// [`Road::forward`](super::Road::forward). None if nobody may go there.
    pub lanes: Vec<(u8, u8)>,
}

/// The arrows on the driven lanes of a street, for each of its two directions from left to right as drivers see them;
/// an empty list has none. And where each lane leads, where that is known.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct TurnLanes {
    /// On the lanes along the centreline, before its end.
    pub forward: Vec<TurnSet>,
    /// On the lanes against it, before its beginning.
    pub backward: Vec<TurnSet>,
    /// The ways from the lanes along the centreline at its end, one entry for each street whose ways are known.
    #[serde(default)]
    pub forward_ways: Vec<LaneWays>,
    /// The ways from the lanes against it at its beginning.
    #[serde(default)]
    pub backward_ways: Vec<LaneWays>,
}

impl Blank for TurnLanes {
    const BLANK: &'static Self = &Self {
        forward: Vec::new(),
        backward: Vec::new(),
        forward_ways: Vec::new(),
        backward_ways: Vec::new(),
    };
}

impl TurnLanes {
    /// Whether there are none at all.
    pub fn is_empty(&self) -> bool {
        self == Self::BLANK
    }

    /// What cannot be about them on a street of so many lanes each way, in words.
    pub(super) fn fault(&self, (forward, backward): (usize, usize)) -> Option<String> {
        let of_sides =
            [(&self.forward, &self.forward_ways, forward), (&self.backward, &self.backward_ways, backward)];
        of_sides.into_iter().find_map(|(arrows, ways, lanes)| {
            let is_known = arrows.len() == lanes && arrows.iter().copied().all(TurnSet::is_known);
            if !arrows.is_empty() && !is_known {
                return Some(format!("has {} arrows on {lanes} lanes: give one a lane, or none", arrows.len()));
            }
            let is_possible = |ways: &LaneWays| {
                let are_there = ways.lanes.iter().all(|(from, _)| usize::from(*from) < lanes);
                ways.heading.abs() <= 10.0 && are_there && ways.lanes.is_sorted_by(|a, b| a < b)
            };
            let fault = "has impossible ways from its lanes: give a direction, and ascending pairs of lanes that are there";
            (!ways.iter().all(is_possible)).then(|| fault.to_owned())
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mirror_exchanges_left_and_right_alone() {
        let all = [Turn::Straight, Turn::Right, Turn::Left, Turn::UTurn];
        let mirrored = |turn| match turn {
            Turn::Left => Turn::Right,
            Turn::Right => Turn::Left,
            other => other,
        };
        for bits in 1..16_u8 {
            let turns: Vec<Turn> = all
                .into_iter()
                .enumerate()
                .filter(|(bit, _)| bits >> bit & 1 == 1)
                .map(|(_, turn)| turn)
                .collect();
            let set = TurnSet::of(&turns);
            assert!(set.is_known() && set.mirrored().mirrored() == set);
            assert!(all.iter().all(|turn| set.allows(*turn) == set.mirrored().allows(mirrored(*turn))));
        }
    }
}
