//! People on crossings and before them: who turns or drives over one gives way to them.

use serde::{Deserialize, Serialize};
use simworld_core::geometry::Point2;
use simworld_core::id::CrossingId;
use simworld_core::net::{Connection, Crossing, RoadNetwork, polyline};

use super::around::{STANDING, Seen};
use super::watch::{BRAKING, Own, stopping};

/// Room between the nose and the strip, m.
const ROOM: f64 = 0.8;
/// How long ahead one foresees where those are who walk, s.
const FORESIGHT: f64 = 3.0;
/// Room to each side of the vehicle that people have, m.
const BESIDE: f64 = 1.0;
/// Who waits at a kerb without lights is let across, for so long at most, s.
const POLITE: f64 = 6.0;
/// So near to the end of a strip one waits to cross it, m.
const AT_KERB: f64 = 1.2;
/// Harder than this nobody brakes for who only comes nearer, m/s².
const HARD: f64 = 5.0;

/// A crossing that a way passes over, m along it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Strip {
    crossing: CrossingId,
    /// Where a nose stands before it, and where a rear is beyond it.
    stop: f64,
    end: f64,
}

/// The crossings on a way, in its order.
pub(super) fn strips(network: &RoadNetwork, way: &Connection) -> Vec<Strip> {
    let of = |id: &CrossingId| {
        let crossing = &network.crossings[id.index()];
        let mut station = 0.0;
        for piece in way.path.windows(2) {
            let span = (piece[1] - piece[0]).norm();
            if let Some((share, _)) = polyline::crossing(piece[0], piece[1], crossing.start, crossing.end) {
                let (middle, half) = (station + share * span, crossing.width * 0.5 + ROOM);
                return Some(Strip { crossing: *id, stop: middle - half, end: middle + half });
            }
            station += span;
        }
        None
    };
    let mut strips: Vec<Strip> = way.crossings.iter().filter_map(of).collect();
    strips.sort_by(|a, b| a.stop.total_cmp(&b.stop));
    strips
}

impl Strip {
    /// The speed for who is over the line already: before the strip one lets those go who are, or will be, where one drives.
    pub(super) fn hold(
        &self,
        network: &RoadNetwork,
        own: &Own<'_>,
        around: &[Seen],
        path: &[Point2],
        line: f64,
        front: f64,
    ) -> f64 {
        let room = line + self.stop - front;
        if !(-0.5..=25.0).contains(&room) || own.speed * own.speed > 2.0 * HARD * (room + ROOM).max(0.0) {
            return f64::INFINITY; // on it, or it is too late
        }
        let crossing = &network.crossings[self.crossing.index()];
        let over = polyline::slice(path, line + self.stop, line + self.end);
        let half = own.half_width + BESIDE;
        let is_in_way = |other: &&Seen| {
            let now = on_strip(crossing, other.at);
            let times = [0.0, 0.25, 0.5, 0.75, 1.0].map(|share| share * FORESIGHT);
            let reaches = |time: &f64| {
                let at = other.at + other.velocity * *time;
                on_strip(crossing, at)
                    && polyline::closest(&over, &at).is_some_and(|near| near.distance < half)
            };
            other.walks() && (now || steps_on(crossing, other)) && times.iter().any(reaches)
        };
        if around.iter().any(|other| is_in_way(&other)) { stopping(room, BRAKING) } else { f64::INFINITY }
    }
}

/// Whether somebody is on a crossing that a way passes over, steps on to it, or, without lights, waits to; `waited` is how long
/// one has let them already, s.
pub(super) fn cross(network: &RoadNetwork, turn: &Connection, around: &[Seen], waited: f64) -> bool {
    turn.crossings.iter().any(|id| {
        let crossing = &network.crossings[id.index()];
        around.iter().filter(|other| other.walks()).any(|other| {
            on_strip(crossing, other.at)
                || steps_on(crossing, other)
                || (crossing.signal.is_none() && waited < POLITE && waits_at(crossing, other))
        })
    })
}

/// Whether a place is on the carriageway where the strip is.
fn on_strip(crossing: &Crossing, at: Point2) -> bool {
    let strip = [crossing.start, crossing.end];
    let length = (crossing.end - crossing.start).norm();
    polyline::closest(&strip, &at).is_some_and(|near| {
        near.station > 0.1 && near.station < length - 0.1 && near.distance < crossing.width * 0.5 + 0.4
    })
}

fn steps_on(crossing: &Crossing, other: &Seen) -> bool {
    on_strip(crossing, other.at + other.velocity)
}

/// Whether somebody stands at the kerb and looks across.
fn waits_at(crossing: &Crossing, other: &Seen) -> bool {
    let across = crossing.end - crossing.start;
    [(crossing.start, across), (crossing.end, -across)].iter().any(|(kerb, way)| {
        other.speed() < STANDING
            && (other.at - kerb).norm() < AT_KERB
            && other.ahead.dot(way) > 0.7 * way.norm()
    })
}
