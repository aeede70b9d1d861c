//! Heights along ways for walkers that pass over streets: decks, and the ramps and stairs that lead to them.
//!
//! A network says on which level a way lies, and no more; its height follows from that. A way above the ground is a
//! storey a level high, and higher where that is not enough to pass below it. It begins on the ground where it meets ways
//! or sidewalks there, and climbs from there as a ramp; as stairs where it is a flight of steps, or where a ramp would not be high
//! enough over a street. Where even stairs have not the room, the ways on the ground that lead on from there begin with a part
//! of them; and where there are none, they are as steep as they have to be.

mod climb;
mod passages;

use super::{RoadNetwork, polyline};
use climb::Climb;

/// Height free between a carriageway and a footbridge, m: 17 feet, a foot more than below other bridges, for a footbridge
/// does not bear much of a blow (AASHTO, A Policy on Geometric Design of Highways and Streets, 2011, section 8.2.9).
pub const FOOTBRIDGE_HEADROOM: f64 = 5.1;
/// Thickness of the deck of a footbridge, m.
pub const FOOTBRIDGE_DECK: f64 = 0.4;
/// A way lies so much higher than one of the level below, m: high enough to pass over a carriageway.
pub const FOOTBRIDGE_STOREY: f64 = FOOTBRIDGE_HEADROOM + FOOTBRIDGE_DECK;
/// Steepest ramp, rise over run (Americans with Disabilities Act Standards for Accessible Design, 2010, 405.2).
pub const RAMP_GRADE: f64 = 1.0 / 12.0;
/// Grade of stairs, rise over run: steps of 150 mm on 300 mm (Highways England, CD 353, Design criteria for footbridges).
pub const STAIRS_GRADE: f64 = 0.5;

/// Lower than this is on the ground, m.
const LEAST: f64 = 1e-9;

/// Heights along the ways for walkers of a network, above the ground there: see [`RoadNetwork::footpath_heights`].
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FootpathHeights {
    /// By way: station and height, m, where it bends, both ends included; none of a way on the ground. None at all if all are.
    profiles: Vec<Vec<(f64, f64)>>,
}

impl FootpathHeights {
    /// Whether no way leaves the ground.
    pub fn is_level(&self) -> bool {
        self.profiles.is_empty()
    }

    /// Where the height of a way bends, by its index in [`RoadNetwork::footpaths`]: station along it and height above the
    /// ground, m, ascending, from end to end, and straight between. None of a way that lies on the ground.
    pub fn profile(&self, way: usize) -> &[(f64, f64)] {
        self.profiles.get(way).map_or(&[], Vec::as_slice)
    }

    /// The height of a way at a station along it, m above the ground; stations outside are those of its ends.
    pub fn at(&self, way: usize, station: f64) -> f64 {
        height(self.profile(way), station)
    }

    /// The ways that leave the ground, ascending, each with its [`profile`](Self::profile).
    pub fn raised(&self) -> impl Iterator<Item = (usize, &[(f64, f64)])> {
        let all = self.profiles.iter().map(Vec::as_slice).enumerate();
        all.filter(|(_, profile)| !profile.is_empty())
    }
}

/// The height at a station of a profile, m.
fn height(profile: &[(f64, f64)], station: f64) -> f64 {
    let next = profile.partition_point(|(at, _)| *at <= station);
    let after = profile.get(next).or(profile.last());
    let before = next.checked_sub(1).map_or(profile.first(), |index| profile.get(index));
    let (Some(before), Some(after)) = (before, after) else { return 0.0 };
    let span = after.0 - before.0;
    let share = if span > 0.0 { ((station - before.0) / span).clamp(0.0, 1.0) } else { 0.0 };
    before.1 + (after.1 - before.1) * share
}

impl RoadNetwork {
    /// The heights along its ways for walkers, above the ground: a function of the network alone.
    ///
    /// ```
    /// use simworld_core::geometry::Point2;
    /// use simworld_core::net::*;
    /// let mut network = RoadNetwork::derive(&StreetPlan::crossroads(100.0), &NetworkConfig::default())?;
    /// let path = [(50.0, -90.0), (50.0, 90.0)].map(|(x, y)| Point2::new(x, y)).to_vec();
    /// network.footpaths.push(Footpath { path, width: 3.0, level: 1, joins: [true; 2], ..Footpath::default() });
    /// let heights = network.footpath_heights();
    /// // A ramp from either end to the middle of the street that it crosses, 90 m on.
    /// assert_eq!(heights.at(0, 0.0), 0.0);
    /// assert!((heights.at(0, 48.0) - 4.0).abs() < 1e-9);
    /// assert_eq!(heights.at(0, 90.0), FOOTBRIDGE_HEADROOM + FOOTBRIDGE_DECK);
    /// # Ok::<(), NetworkError>(())
    /// ```
    pub fn footpath_heights(&self) -> FootpathHeights {
        if self.footpaths.iter().all(|way| way.level <= 0) {
            return FootpathHeights::default();
        }
        let passages = passages::of(self);
        FootpathHeights { profiles: Climb::of(self, &passages).profiles(&passages) }
    }
}

/// Length of a way, m.
fn length(network: &RoadNetwork, way: usize) -> f64 {
    polyline::length(&network.footpaths[way].path)
}

#[cfg(test)]
mod tests;
