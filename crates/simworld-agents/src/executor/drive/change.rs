//! From lane to lane: a look into the mirror, and what is done while there is no gap.
//!
//! A change is planned as early as it can be. Where the lane beside has no gap it is put off, as far as the last place from which
//! it still leads to the turn; there one waits, and in the end takes the way that one's own lane leads.

use serde::{Deserialize, Serialize};
use simworld_core::geometry::Point2;
use simworld_core::id::LaneId;
use simworld_core::net::{RoadNetwork, polyline};

use super::Driving;
use super::around::{STANDING, Seen};
use super::watch::{BRAKING, Own, stopping};
use crate::lanes::lane;

/// A change takes at least so much of the road, m: four metres aside at one to four, as the traffic's.
pub(super) const LEAST: f64 = 16.0;
/// How far behind the begin of a lane others come from, m.
const BEHIND: f64 = 60.0;
/// Who is farther beside the middle of a lane is not in it, m.
const IN_LANE: f64 = 2.0;
/// Nearer to the middle of the lane one is seen there, and is let in, m.
const NEARLY_IN: f64 = 1.5;
/// Who has stood beside one's rear for so long, while one waited, lets one go first, s.
const LETS_GO: f64 = 4.0;
/// Who comes from so far beside its lane crosses another to it, m; and waits for those in it who would be there within a time, s, going
/// at least this fast, m/s.
const ACROSS: f64 = 2.5;
const MEETS: f64 = 6.0;
const ROLLS: f64 = 4.0;
/// Least room before and behind, m, and time to whoever is before or behind one, s.
const ROOM: f64 = 2.0;
const AHEAD: f64 = 0.5;
const FOLLOWS: f64 = 0.8;
/// Braking that one asks of who is behind, and of oneself, m/s².
const EASILY: f64 = 2.0;

/// A change of lanes on the path.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Change {
    /// From where to where, m along the path.
    pub(super) begin: f64,
    pub(super) end: f64,
    /// Where it can begin at the latest, m along the path.
    pub(super) latest: f64,
    pub(super) from: LaneId,
    pub(super) to: LaneId,
    pub(super) is_begun: bool,
    /// How long one has stood for it, s.
    pub(super) waited: f64,
}

/// What comes of a change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Outlook {
    /// There is none near, or it is under way.
    Free,
    /// Put off: the path is to be found anew, with the change no earlier than so far ahead, m.
    Later(f64),
    /// One waits for a gap, at no more than this speed, m/s.
    Waits(f64),
}

impl Driving {
    /// Begins the next change if there is a gap for it.
    pub(super) fn look_beside(
        &mut self,
        network: &RoadNetwork,
        own: &Own<'_>,
        around: &[Seen],
        dt: f64,
    ) -> Outlook {
        let station = self.station;
        self.changes.retain(|change| change.end > station);
        self.look_again(network, own);
        let Some(change) = self.changes.first_mut().filter(|change| !change.is_begun) else {
            return Outlook::Free;
        };
        // The wheel turns towards where one will be in a moment.
        let lead = (0.6 * own.speed).clamp(4.0, 15.0) + 1.0;
        if station + lead < change.begin {
            return Outlook::Free;
        }
        if has_gap(network, own, around, change) {
            change.is_begun = true;
            return Outlook::Free;
        }
        let later = lead + 4.0 + 0.5 * own.speed;
        if station + later < change.latest {
            return Outlook::Later(later);
        }
        if own.speed < STANDING {
            change.waited += dt;
        }
        Outlook::Waits(stopping(change.latest - 5.0 - station, BRAKING))
    }

    /// Who stands before it is in the other lane looks into the mirror once more.
    fn look_again(&mut self, network: &RoadNetwork, own: &Own<'_>) {
        if let Some(change) = self.changes.first_mut().filter(|_| own.speed.abs() < STANDING) {
            let near = polyline::closest(&lane(network, change.to).path, &own.at);
            change.is_begun &= near.is_some_and(|near| near.distance < NEARLY_IN);
        }
    }

    /// Whether one comes from beside the lane, and is not in it yet.
    pub(super) fn pulls_out(&self) -> bool {
        self.changes.first().is_some_and(|change| change.from == change.to)
    }

    /// How long one has stood for the change at hand, s.
    pub(super) fn waited_beside(&self) -> f64 {
        self.changes.first().map_or(0.0, |change| change.waited)
    }
}

/// Whether a lane has room beside one, and nobody there would have to brake hard, nor oneself.
fn has_gap(network: &RoadNetwork, own: &Own<'_>, around: &[Seen], change: &Change) -> bool {
    let path = &lane(network, change.to).path;
    let Some((first, heading)) = path.first().map(|first| (*first, polyline::at(path, 0.0).1)) else {
        return false;
    };
    let before = first - simworld_core::geometry::direction(heading) * BEHIND;
    let mut line: Vec<Point2> = vec![before];
    line.extend(path);
    let Some(here) = polyline::closest(&line, &own.at) else { return false };
    let (rear, front) = (here.station - own.half_length, here.station + own.half_length);
    let v = own.speed.max(0.0);
    let crosses = change.from == change.to && here.distance > ACROSS;
    if crosses && around.iter().any(|other| comes_between(&line, here.station, here.distance, other)) {
        return false;
    }
    around.iter().filter(|other| other.kind.is_mobile()).all(|other| {
        let in_lane = if other.walks() || other.kind.is_vehicle() && other.stands() {
            polyline::closest(&line, &other.at)
                .filter(|near| near.distance < IN_LANE)
                .map(|near| near.station)
        } else {
            other.along(&line, IN_LANE)
        };
        let Some(at) = in_lane else { return true };
        let (its_rear, its_front, speed) = (at - other.half_length, at + other.half_length, other.speed());
        if other.stands() && its_front < front && change.waited > LETS_GO {
            return true;
        }
        if its_rear > front {
            let excess = (v * v - speed * speed).max(0.0) / (2.0 * EASILY);
            its_rear - front > ROOM + AHEAD * v + excess
        } else if its_front < rear {
            let excess = (speed * speed - v * v).max(0.0) / (2.0 * EASILY);
            rear - its_front > ROOM + FOLLOWS * speed + excess
        } else {
            false
        }
    })
}

/// Whether a vehicle comes towards one between one's place, at a station of a lane and so far beside it, m, and the lane.
fn comes_between(lane: &[Point2], station: f64, beside: f64, other: &Seen) -> bool {
    if !other.kind.is_vehicle() || other.stands() {
        return false;
    }
    let Some(near) = polyline::closest(lane, &other.at).filter(|near| near.distance < beside + IN_LANE)
    else {
        return false;
    };
    let along = simworld_core::geometry::direction(polyline::at(lane, near.station).1).dot(&other.ahead);
    let away = near.station - other.half_length - station;
    along < -0.5 && near.station > station && away < MEETS * other.speed().max(ROLLS)
}
