//! Past what stands in the way: beside it where there is room and nobody comes, else by other roads.

use simworld_core::geometry::{Point2, Vector2, direction};
use simworld_core::id::LaneId;
use simworld_core::net::{Aspect, polyline};
use simworld_core::scene::{EntityRef, Scene};

use super::Driving;
use super::around::{STANDING, Seen, meets, would_touch};
use super::plan::{Wish, smooth};
use super::turn_round::Turning;
use super::watch::{BRAKING, Obstacle, Own};
use crate::lanes::{beside, lane_at};

/// Room to the side of what one passes, m.
const BESIDE: f64 = 0.7;
/// The farthest that one goes to the left, m: not more than the lane of those who come towards one.
const MOST_ASIDE: f64 = 4.5;
/// Length over which one goes out to the left and back again, m.
const RAMP: f64 = 8.0;
/// Who reaches no farther aside than this keeps to its lane, m, and anybody who needs no more than that aside; who pulls out and needs no
/// more than this to the left comes into it; the room to the side then, m, the length over which one goes there and back, m, and how
/// long one looks at it first, s.
const IN_LANE: f64 = 2.1;
const DODGE: f64 = 1.2;
const PULLS_OUT: f64 = 2.5;
/// So far to the right one goes past who has come to stand nose to nose with one, m: a little over the edge of the lane.
const MAKES_WAY: f64 = 1.7;
const DODGE_BESIDE: f64 = 0.5;
const DODGE_RAMP: f64 = 5.0;
pub(super) const DODGES: f64 = 1.5;
/// The speed at which one passes, m/s, and the time that is left when one is back, s.
const PASSES_AT: f64 = 4.0;
const SPARE: f64 = 2.0;
/// How far one backs to have room to pull out, m.
const BACK: f64 = 5.0;
/// Who is so near beside one does not go on past one, m.
const HEMS: f64 = 0.4;
/// Who stands so near to a line, or behind another, waits himself, m.
const AT_LINE: f64 = 25.0;
const BEHIND: f64 = 8.0;
/// In a queue one looks for other roads only each so many times that nothing has gone on.
const PATIENCE: u32 = 4;
/// A light holds up a queue of this length, m.
const AT_LIGHT: f64 = 80.0;

impl Driving {
    /// How far aside one would go past what stands at a side of one's lane, as who is parked does, m to the left, negative to the
    /// right; `None` where that is no place in one's lane, nor, while one pulls out, towards it.
    pub(super) fn dodged(&self, own: &Own<'_>, obstacle: &Obstacle) -> Option<f64> {
        let room = own.half_width + DODGE_BESIDE;
        let (left, right) = ((obstacle.left + room).max(0.0), (obstacle.right - room).min(0.0));
        let aside = if left <= -right { left } else { right };
        let dodge = DODGE.max(IN_LANE - own.half_width);
        let farthest = if self.pulls_out() { PULLS_OUT } else { dodge };
        let nearest = if obstacle.comes { MAKES_WAY } else { dodge };
        Some(aside).filter(|_| obstacle.stands && (-nearest..=farthest).contains(&aside))
    }

    /// Whether what stands ahead waits for a light.
    pub(super) fn waits_at_light(&self, scene: &dyn Scene, obstacle: &Obstacle) -> bool {
        let Some(network) = scene.roads() else { return false };
        let line = self.lines.iter().find(|line| line.station > obstacle.begin);
        let signal = line.and_then(|line| {
            let near = line.station - obstacle.begin < AT_LIGHT;
            network.connections[line.turn.index()].signal.filter(|_| near)
        });
        signal.is_some_and(|group| scene.signals().get(group.index()) != Some(&Aspect::Green))
    }

    /// Whether what stands ahead waits for a junction, or behind somebody who does.
    pub(super) fn is_queue(&self, obstacle: &Obstacle, around: &[Seen]) -> bool {
        if obstacle.comes {
            return false;
        }
        let line = self.lines.iter().find(|line| line.station > obstacle.begin);
        let beyond = polyline::slice(&self.path, obstacle.end + 0.5, obstacle.end + BEHIND);
        let others = around.iter().filter(|other| other.id != obstacle.id && other.kind.is_vehicle());
        line.is_some_and(|line| line.station - obstacle.end < AT_LINE)
            || others.clone().any(|other| {
                let near = polyline::closest(&beyond, &other.at);
                near.is_some_and(|near| near.distance < other.half_length.max(1.5))
            })
    }

    /// Tries something: bends the path round it, backing for room before, or takes other roads; if nothing helps, waits on.
    pub(super) fn get_past(
        &mut self,
        scene: &dyn Scene,
        vehicle: &EntityRef<'_>,
        own: &Own<'_>,
        around: &[Seen],
        obstacle: &Obstacle,
    ) {
        let dodged = self.dodged(own, obstacle);
        let dodges = dodged.is_some();
        let queue = !dodges && self.is_queue(obstacle, around);
        if !obstacle.stands || (queue && !self.tries.is_multiple_of(PATIENCE)) {
            return;
        }
        let ramp = if dodges { DODGE_RAMP } else { RAMP };
        let aside = dodged.unwrap_or(obstacle.left + own.half_width + BESIDE);
        let room = obstacle.begin - own.half_length - self.station;
        let (begin, end) = (obstacle.begin - own.half_length - ramp, obstacle.end + own.half_length + ramp);
        // Beyond a line there may be a junction.
        let is_street =
            dodges || self.lines.iter().all(|line| line.station > end + 5.0 || line.station < self.station);
        let is_passable = is_street && !queue && aside <= MOST_ASIDE;
        if is_passable && self.is_clear(own, around, begin, end, aside) {
            if room < ramp * 0.75 && !would_touch(own, around, (-2.0, 0.0), 0.2) {
                self.backing = BACK;
            }
            self.bend((begin.max(self.station - BACK), end), aside, ramp);
            return;
        }
        let is_time = queue || self.tries.is_multiple_of(PATIENCE);
        let goes_round = is_time && self.drive_round(scene, vehicle, own, obstacle);
        if !goes_round && (self.is_in_junction() || obstacle.comes || is_hemmed_in(own, around)) {
            // Two who stand nose to nose both wait for the other to go, and so do one who has swung out and who stands beside it.
            self.back_off(own, around);
        }
    }

    /// Whether one's rear, at least, is between a line and the end of the way across behind it.
    fn is_in_junction(&self) -> bool {
        self.lines.first().is_some_and(|line| line.is_passed)
    }

    /// Takes other roads; from the street itself one turns back, but not across a junction. Whether there is such a way.
    fn drive_round(
        &mut self,
        scene: &dyn Scene,
        vehicle: &EntityRef<'_>,
        own: &Own<'_>,
        obstacle: &Obstacle,
    ) -> bool {
        let Some(network) = scene.roads() else { return false };
        let (point, heading) = polyline::at(&self.path, obstacle.begin);
        let leg = |at: Point2, heading: f64| -> Option<LaneId> {
            beside(network, lane_at(network, at, Some(heading))?.lane).first().copied()
        };
        let Some(blocked) = leg(point, heading) else { return false };
        let mut closed = self.closed.clone();
        closed.push(blocked);
        let here = polyline::at(&self.path, self.station);
        if leg(here.0, here.1) == Some(blocked) {
            // There is no other way on; perhaps there is one back.
            self.turning = if self.is_in_junction() { None } else { Turning::begin(network, own, blocked) };
            if self.turning.is_some() {
                self.closed = closed;
            }
            return self.turning.is_some();
        }
        let wish = Wish { closed, why: Some("something stands in the way"), ..Wish::to(self.goal) };
        self.renew(scene, vehicle, own, wish).is_ok()
    }

    /// Moves the path to the left between two stations.
    fn bend(&mut self, (begin, end): (f64, f64), aside: f64, ramp: f64) {
        const STEP: f64 = 1.0;
        let (begin, length) = (begin.max(0.0), polyline::length(&self.path));
        let end = end.min(length);
        let mut bent = polyline::slice(&self.path, 0.0, begin);
        let count = ((end - begin) / STEP).ceil().max(1.0) as u32;
        for step in 1..=count {
            let along = (end - begin) * f64::from(step) / f64::from(count);
            let out =
                smooth((along / ramp).min(1.0)) * smooth(((end - begin - along) / ramp).clamp(0.0, 1.0));
            let (point, heading) = polyline::at(&self.path, begin + along);
            bent.push(point + left_of(heading) * (aside * out));
        }
        bent.extend(polyline::slice(&self.path, end, length).into_iter().skip(1));
        // What lies beyond is as much farther away as the way round is longer.
        self.shift(end, polyline::length(&bent) - length);
        self.path = bent;
    }

    /// Whether the way round is free of things, nobody comes towards one before one is back, and nobody from behind.
    fn is_clear(&self, own: &Own<'_>, around: &[Seen], begin: f64, end: f64, aside: f64) -> bool {
        // What is beside one already is left behind.
        let first = begin.max(self.station + own.half_length).min(end);
        let corridor = polyline::offset(&polyline::slice(&self.path, first, end), aside);
        let time = (end - self.station.min(begin)) / PASSES_AT + SPARE;
        around.iter().all(|other| {
            let in_way = other.corners.iter().any(|corner| {
                let near = polyline::closest(&corridor, corner);
                near.is_some_and(|near| near.distance < own.half_width + BESIDE * 0.5)
            });
            !in_way && !self.comes(other, (begin, end), aside, time)
        })
    }

    /// Whether a vehicle drives into the way round meanwhile, towards one or from behind.
    fn comes(&self, other: &Seen, (begin, end): (f64, f64), aside: f64, time: f64) -> bool {
        if !other.kind.is_vehicle() || other.stands() {
            return false;
        }
        let speed = other.speed().max(5.0); // it may accelerate
        let reach = speed * time + other.half_length;
        let around = polyline::slice(&self.path, begin - reach, end + reach);
        let lane = polyline::offset(&around, aside);
        let Some(near) = polyline::closest(&lane, &other.at).filter(|near| near.distance < 2.0) else {
            return false;
        };
        let along = direction(polyline::at(&lane, near.station).1).dot(&other.velocity);
        let first = (begin - reach).max(0.0);
        let station = first + near.station;
        if along < -STANDING {
            station > begin && station - speed * time < end
        } else {
            let braking = other.speed() * other.speed() / (2.0 * BRAKING);
            station < end && station + other.half_length + braking > begin
        }
    }
}

/// Whether a vehicle stands beside one, or before one's corner, and has no room to go on.
fn is_hemmed_in(own: &Own<'_>, around: &[Seen]) -> bool {
    around.iter().any(|other| {
        let is_behind = (other.at - own.at).dot(&own.ahead) < -own.half_length - other.half_length * 0.5;
        other.kind.is_vehicle() && other.stands() && !is_behind && meets(&own.solid, &other.solid, HEMS)
    })
}

fn left_of(heading: f64) -> Vector2 {
    let ahead = direction(heading);
    Vector2::new(-ahead.y, ahead.x)
}
