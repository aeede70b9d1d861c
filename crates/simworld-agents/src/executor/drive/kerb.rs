//! Where to stop: the free place at the kerb nearest to where one wants to be.

use std::ops::ControlFlow;

use serde::{Deserialize, Serialize};
use simworld_core::geometry::{Aabb, Point2, direction};
use simworld_core::id::{EntityId, LaneId};
use simworld_core::net::{LaneKind, RoadNetwork, polyline};
use simworld_core::ops::wrap_angle;
use simworld_core::scene::{EntityKind, Scene};

use super::plan::longer_than_a_car;
use crate::lanes::{OnLane, lane};

/// Room between the vehicle and the kerb, m.
const TO_KERB: f64 = 0.3;
/// Room before and behind a parked vehicle, m: enough to pull out.
const GAP: f64 = 2.0;
/// Room behind it through which a car pulls in forwards, m: nearer than this the path in is so far to the right that one would not
/// come past who is parked there.
const APPROACH: f64 = 11.0;
/// How far from where one wants to be one looks for a place, m.
const NEARBY: f64 = 80.0;
/// Who pulls in swings its nose out to the right by so much, m, before it stands straight.
const SWING: f64 = 0.5;
/// Nearer to the middle of the lane than this one need not pull in, m.
const ASIDE: f64 = 0.5;
/// Nobody parks so near a junction, m.
const JUNCTION: f64 = 6.0;
/// Nor at the inside of a bend that turns by more than this over so many metres to both sides, radians: buses cut it (of 11.5 m in a bend
/// of 80 m by 0.2 m).
const BENT: f64 = 0.2;
const BEND: f64 = 8.0;

/// A place to stop: on the lane, and how far to its right, m.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Berth {
    pub(super) on: OnLane,
    pub(super) aside: f64,
}

impl Berth {
    /// Whether a vehicle of that size has room to come there, and to leave.
    pub(super) fn is_free(
        &self,
        scene: &dyn Scene,
        network: &RoadNetwork,
        who: &[EntityId],
        size: (f64, f64),
    ) -> bool {
        let (middle, heading) = pose(network, self.on.lane, self.on.station, self.aside);
        let (ahead, reach) = (direction(heading), size.0 * 0.5 + GAP);
        let approach = APPROACH * longer_than_a_car(size.0);
        let behind = size.0 * 0.5 + if self.aside > ASIDE { approach } else { GAP };
        let mut free = true;
        let _ = scene.visit(&Aabb::column_around(middle, reach.max(behind)), &mut |other| {
            if who.contains(&other.id)
                || other.attachment.is_some()
                || !other.is_solid()
                || other.kind == EntityKind::Building
            {
                return ControlFlow::Continue(());
            }
            let corners = other.obb().footprint().map(|corner| {
                let offset = corner - middle;
                (offset.dot(&ahead), ahead.perp(&offset))
            });
            let span = |of: fn(&(f64, f64)) -> f64| {
                corners
                    .iter()
                    .map(of)
                    .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)))
            };
            let (along, across) = (span(|c| c.0), span(|c| c.1));
            let half = size.1 * 0.5 + 0.1;
            let swing = if self.aside > ASIDE && along.1 < -size.0 * 0.5 { SWING } else { 0.0 };
            free = along.1 < -behind || along.0 > reach || across.1 < -half - swing || across.0 > half;
            if free { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        });
        free
    }
}

/// The free place nearest to a place on a lane for a vehicle of that size, at a station after `first`; in the lane itself if
/// the kerb is taken.
pub(super) fn berth(
    scene: &dyn Scene,
    network: &RoadNetwork,
    who: &[EntityId],
    (on, first): (&OnLane, f64),
    size: (f64, f64),
) -> Berth {
    let aside = to_the_right(network, on, size.1);
    let length = lane(network, on.lane).length;
    let high = (length - JUNCTION - size.0 * 0.5).max(length * 0.5);
    let low = JUNCTION.min(length * 0.5).max(first).min(high);
    let step = size.0 * 0.5;
    let mut shift = 0.0;
    while shift <= NEARBY {
        for station in [on.station + shift, on.station - shift] {
            let place = OnLane { station: station.clamp(low, high), ..*on };
            let berth = Berth { on: place, aside };
            if !is_inside_bend(network, &place) && berth.is_free(scene, network, who, size) {
                return berth;
            }
        }
        shift += step;
    }
    Berth { on: OnLane { station: on.station.clamp(low, high), ..*on }, aside: 0.0 }
}

/// Whether a lane bends to its right there.
fn is_inside_bend(network: &RoadNetwork, on: &OnLane) -> bool {
    let path = &lane(network, on.lane).path;
    let [before, behind] = [-BEND, BEND].map(|offset| polyline::at(path, on.station + offset).1);
    wrap_angle(behind - before) < -BENT
}

/// How far to the right of the middle of the lane a vehicle stands at the kerb, m: on the strip for parked vehicles where
/// there is one, else at the edge of the lane, so that no cycle lane is blocked.
fn to_the_right(network: &RoadNetwork, on: &OnLane, width: f64) -> f64 {
    let own = lane(network, on.lane);
    let road = &network.roads[own.road.index()];
    let at = polyline::at(&own.path, on.station).0;
    let forward = road.forward.contains(&on.lane);
    let Some(near) = polyline::closest(&road.centerline, &at) else { return 0.0 };
    // Positive to the right of the way one goes.
    let (middle, kerb) =
        if forward { (-near.lateral, road.right_kerb) } else { (near.lateral, road.left_kerb) };
    let is_beside = |offset: f64| if forward { -offset > middle } else { offset > middle };
    let mut strips = road.strips.iter().filter(|strip| is_beside(strip.offset));
    let parks = strips.clone().any(|strip| strip.kind == LaneKind::Parking);
    let outermost = own.width * 0.5 + middle + 0.5 >= kerb || strips.next().is_none();
    let edge = if parks || outermost { kerb - middle } else { own.width * 0.5 };
    (edge - width * 0.5 - TO_KERB).max(0.0)
}

/// The middle of the vehicle there, and the way it looks.
pub(super) fn pose(network: &RoadNetwork, id: LaneId, station: f64, aside: f64) -> (Point2, f64) {
    let (point, heading) = polyline::at(&lane(network, id).path, station);
    let ahead = direction(heading);
    (point + simworld_core::geometry::Vector2::new(ahead.y, -ahead.x) * aside, heading)
}
