//! Turning in the street: forwards to the far kerb, back to the near one, until one looks the other way.

use serde::{Deserialize, Serialize};
use simworld_core::action::Action;
use simworld_core::geometry::{Vector2, direction, heading};
use simworld_core::id::{LaneId, RoadId};
use simworld_core::net::{DrivingSide, LaneKind, RoadNetwork, polyline};
use simworld_core::scene::{EntityRef, Scene};

use super::around::{Seen, would_touch};
use super::plan::Wish;
use super::watch::Own;
use super::{CannotArrive, Driving};
use crate::lanes::{lane, lane_at};

/// Front wheels as far as they go, radians; the body stops them where its own end.
const LOCK: f64 = 0.6;
/// As fast as one turns, m/s.
const WALK: f64 = 1.5;
/// Room kept to the kerbs and to others, m.
const TO_KERB: f64 = 0.4;
const TO_OTHERS: f64 = 0.6;
const BESIDE: f64 = 0.2;
/// Within so much of the way back one drives on as ever, radians; the cosine of 25°.
pub(super) const TURNED: f64 = 0.906;
/// One backs no farther than this at a time, m.
const MOST_BACK: f64 = 6.0;
/// So long does nobody take to turn, s: one begins if nobody comes before.
const TAKES: f64 = 10.0;
/// Who comes within this time while one turns is let pass, s.
const NEAR: f64 = 2.0;
/// After so long without a gap one begins all the same, when nobody comes within half the time, s.
const IMPATIENT: f64 = 60.0;
/// One who has not come round in so long does not, s, and tries to come back; among cars that stand there may be room later, so that it
/// is tried to and fro so often.
const FAILED: f64 = 150.0;
const TURNS_BACK: u32 = 3;

/// The gear.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
enum Gear {
    /// Waiting for a gap.
    Waits,
    Forwards,
    Backwards,
}

/// Turning in the street.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Turning {
    road: RoadId,
    /// The lane that leads back, and the one that one came by.
    back: LaneId,
    from: LaneId,
    /// How often there was no room to come round, and one turned to where one looked before.
    gave_up: u32,
    gear: Gear,
    /// How long it has taken, s, and how far one has gone in this gear, m.
    spent: f64,
    gone: f64,
    /// Where the wheels point forwards: 1 is left.
    side: f64,
}

impl Turning {
    /// In the street of a lane, if it has one that leads back and nothing between; `None` if one cannot turn there.
    pub(super) fn begin(network: &RoadNetwork, own: &Own<'_>, on: LaneId) -> Option<Self> {
        let id = lane(network, on).road;
        let road = &network.roads[id.index()];
        let others = if road.forward.contains(&on) { &road.backward } else { &road.forward };
        let back = others.iter().copied().find(|other| lane(network, *other).is_driven())?;
        let parted = road.strips.iter().any(|strip| strip.kind == LaneKind::Median);
        let length = polyline::length(&road.centerline);
        let station = polyline::closest(&road.centerline, &own.at)?.station;
        // Not in a junction.
        let is_clear = station > 8.0 + own.half_length && station < length - 8.0 - own.half_length;
        let side = if network.driving_side == DrivingSide::Right { 1.0 } else { -1.0 };
        (!parted && !road.roundabout && is_clear).then_some(Self {
            road: id,
            back,
            from: on,
            gave_up: 0,
            gear: Gear::Waits,
            spent: 0.0,
            gone: 0.0,
            side,
        })
    }
}

impl Driving {
    /// A step of it.
    pub(super) fn turn_round(
        &mut self,
        scene: &dyn Scene,
        vehicle: &EntityRef<'_>,
        own: &Own<'_>,
        around: &[Seen],
        dt: f64,
        out: &mut Vec<Action>,
    ) -> Result<(), CannotArrive> {
        let (Some(network), Some(turning)) = (scene.roads(), &mut self.turning) else { return Ok(()) };
        turning.spent += dt;
        let back = turning.way_back(network, own);
        if turning.spent > FAILED {
            if own.ahead.dot(&back) < -TURNED {
                // There is no room; perhaps what was in the way is gone by now.
                let why = Some("there is no room to turn round");
                let wish = Wish { closed: self.closed.clone(), why, ..Wish::to(self.goal) };
                return self.renew(scene, vehicle, own, wish);
            }
            return turning.give_up().then_some(()).ok_or_else(|| CannotArrive::stuck(scene, own.at, None));
        }
        if own.ahead.dot(&back) > TURNED {
            out.push(Action::Brake { level: 0.3 });
            let closed = self.closed.clone();
            let on = lane_at(network, own.at, Some(heading(&own.ahead)));
            let (on, why) =
                (on.map(|on| (on.lane, 2.0)), Some("it has turned round, for the street is blocked"));
            let wish = Wish { closed, on, why, ..Wish::to(self.goal) };
            return self.renew(scene, vehicle, own, wish).map(|()| self.best = 0.0);
        }
        turning.shift(network, own, around, dt);
        // Whoever comes close meanwhile stops, or passes, first.
        let pauses = around.iter().any(|other| comes(own, other, NEAR))
            || [1.0, -1.0].iter().all(|way| turning.is_barred(network, own, around, *way));
        let (speed, side) = match turning.gear {
            Gear::Forwards | Gear::Backwards if pauses => (0.0, turning.side),
            Gear::Waits => (0.0, 1.0),
            Gear::Forwards => (WALK, turning.side),
            Gear::Backwards => (-WALK, -turning.side),
        };
        out.push(Action::Steer { angle: LOCK * side });
        out.push(pedal(own.speed, speed));
        Ok(())
    }
}

impl Turning {
    /// Where the lane that one turns to leads, of length one.
    fn way_back(&self, network: &RoadNetwork, own: &Own<'_>) -> Vector2 {
        let path = &lane(network, self.back).path;
        let near = polyline::closest(path, &own.at);
        near.map_or_else(|| -own.ahead, |near| direction(polyline::at(path, near.station).1))
    }

    /// Turns to where one looked before, so that one does not drive on from across the street; false if that was tried often enough.
    fn give_up(&mut self) -> bool {
        if self.gave_up >= TURNS_BACK {
            return false;
        }
        std::mem::swap(&mut self.back, &mut self.from);
        (self.gear, self.spent, self.gone, self.side) = (Gear::Waits, 0.0, 0.0, -self.side);
        self.gave_up += 1;
        true
    }

    /// Changes gear where there is no room any more, and begins when nobody comes.
    fn shift(&mut self, network: &RoadNetwork, own: &Own<'_>, around: &[Seen], dt: f64) {
        self.gone += own.speed.abs() * dt;
        let gear = match self.gear {
            Gear::Waits => {
                let time = if self.spent > IMPATIENT { TAKES * 0.5 } else { TAKES };
                if around.iter().any(|other| comes(own, other, time)) {
                    return;
                }
                Gear::Forwards
            }
            Gear::Forwards if self.is_barred(network, own, around, 1.0) => Gear::Backwards,
            Gear::Backwards if self.gone > MOST_BACK || self.is_barred(network, own, around, -1.0) => {
                Gear::Forwards
            }
            same => same,
        };
        if gear != self.gear {
            (self.gear, self.gone) = (gear, 0.0);
        }
    }

    /// Whether there is no room any more before the vehicle (1) or behind it (-1).
    fn is_barred(&self, network: &RoadNetwork, own: &Own<'_>, around: &[Seen], way: f64) -> bool {
        let road = &network.roads[self.road.index()];
        let left = Vector2::new(-own.ahead.y, own.ahead.x);
        let end = own.at + own.ahead * (own.half_length * way);
        let corners = [end + left * own.half_width, end - left * own.half_width];
        // Those that move outwards: a rear may stand over the kerb that it came from.
        let at_kerb = corners.iter().any(|corner| {
            let Some(now) = polyline::closest(&road.centerline, corner) else { return false };
            let soon = corner + own.ahead * (way * 0.3);
            let Some(soon) = polyline::closest(&road.centerline, &soon) else { return false };
            let outwards = soon.lateral.abs() > now.lateral.abs();
            let kerb = if now.lateral > 0.0 { road.left_kerb } else { road.right_kerb };
            outwards && now.lateral.abs() > kerb - TO_KERB
        });
        at_kerb || would_touch(own, around, (way * TO_OTHERS, LOCK * self.side * way), BESIDE)
    }
}

/// Whether a vehicle comes to where one is within a time, s.
fn comes(own: &Own<'_>, other: &Seen, time: f64) -> bool {
    let way = own.at - other.at;
    let (distance, speed) = (way.norm(), other.speed());
    let towards = other.velocity.dot(&way) > 0.7 * speed * distance;
    other.kind.is_mobile() && !other.stands() && towards && distance < own.half_length + 6.0 + speed * time
}

/// The pedal for a slow speed forwards or backwards, m/s.
fn pedal(speed: f64, wanted: f64) -> Action {
    if wanted == 0.0 || speed * wanted < -0.05 {
        return Action::Brake { level: 0.6 };
    }
    let level = (0.4 * (wanted - speed)).clamp(-0.5, 0.5);
    // Against the way one goes it is the brake that slows.
    if level * wanted < 0.0 {
        Action::Brake { level: level.abs().min(0.3) }
    } else {
        Action::Throttle { level }
    }
}
