//! Where vehicles are parked along a street: on the strips for it, and where there is none at the kerb.

use std::f64::consts::{FRAC_PI_2, PI};

use simworld_core::geometry::{Point2, direction};
use simworld_core::id::{LaneId, RoadId};
use simworld_core::net::{LaneKind, Road, RoadClass, Strip, polyline};
use simworld_core::ops::{sin_cos, wrap_angle};
use simworld_core::scene::EntityKind;

use super::land::{Land, Streets, offset_along};
use super::solid::Solid;

/// Between what is parked and the kerb, m.
const KERB_GAP: f64 = 0.15;
/// What stands no farther from a kerb is parked at it, m: a third of a metre is usual, and the rest is for slips.
const AT_KERB: f64 = 0.5;
/// What has room on a strip stands out of it by no more than this, m: more than what is left between it and the kerb.
const SLIP: f64 = 0.2;
/// What is parked is turned by no more than this from its lane, radians.
const ALONG_LANE: f64 = 0.2;

/// Whether such things are parked on streets: whatever drives there, bicycles apart.
pub(super) const fn parks(kind: EntityKind) -> bool {
    matches!(kind, EntityKind::Car | EntityKind::Truck | EntityKind::Bus | EntityKind::Motorcycle)
}

impl Streets {
    /// Where a vehicle of that half width, m, is parked beside a station of a road, on its left or on its right, and which way it
    /// looks there, radians from east; none where nobody parks.
    pub(super) fn parking_at(
        &self,
        id: RoadId,
        station: f64,
        left: bool,
        half_width: f64,
    ) -> Option<(Point2, f64)> {
        let road = self.road(id);
        let side = if left { 1.0 } else { -1.0 };
        let is_there = |strip: &&Strip| {
            let is_left = strip.offset >= middle(road);
            strip.kind == LaneKind::Parking
                && is_left == left
                && (strip.stations.0..=strip.stations.1).contains(&station)
        };
        let offset = match road.strips.iter().find(is_there) {
            Some(strip) => {
                // What is wider than the strip stands out into the lane, and not onto the sidewalk.
                let (own, edge) = (strip.offset * side, strip.width * 0.5);
                own.min(own + edge - half_width - KERB_GAP)
            }
            None if has_kerb(road) => kerb(road, left) - half_width - KERB_GAP,
            None => return None,
        };
        let (foot, along) = polyline::at(&road.centerline, station);
        let at = foot + direction(along + FRAC_PI_2) * (side * offset);
        Some((at, wrap_angle(along + self.turn_of(road, left)?)))
    }

    /// As what a thing is parked where it stands: on a strip for that, or at the kerb and along its lane.
    pub(super) fn parked(&self, roads: &[RoadId], solid: &Solid) -> Option<Land> {
        let at = solid.planar();
        roads.iter().find_map(|id| {
            let road = self.road(*id);
            let offset = offset_along(&road.centerline, at)?;
            if !(-road.right_kerb..=road.left_kerb).contains(&offset) {
                return None;
            }
            let station = polyline::closest(&road.centerline, &at)?.station;
            let (_, along) = polyline::at(&road.centerline, station);
            let is_on = |strip: &Strip| {
                strip.kind == LaneKind::Parking
                    && (offset - strip.offset).abs() <= strip.width * 0.5
                    && (strip.stations.0..=strip.stations.1).contains(&station)
            };
            if let Some(strip) = road.strips.iter().find(|strip| is_on(strip)) {
                // Either way round is parked.
                let (aside, _) = sin_cos(solid.yaw() - along);
                let is_parked = is_on_strip(road, strip, solid, aside.abs() <= ALONG_LANE);
                return is_parked.then_some(Land::Parking);
            }
            let left = offset >= middle(road);
            let turned = wrap_angle(solid.yaw() - along - self.turn_of(road, left)?);
            let room = room_to_kerb(road, left, solid);
            let is_parked = has_kerb(road) && turned.abs() <= ALONG_LANE && (0.0..=AT_KERB).contains(&room);
            is_parked.then_some(Land::Kerbside)
        })
    }

    /// By how much the outermost lane on a side of a road is turned from its centreline, radians: not at all, or right round.
    fn turn_of(&self, road: &Road, left: bool) -> Option<f64> {
        let outward = |lane: &LaneId| {
            let path = &self.network().lanes[lane.index()].path;
            let (half_way, _) = polyline::at(path, polyline::length(path) * 0.5);
            let lateral = polyline::closest(&road.centerline, &half_way)?.lateral;
            Some(if left { lateral } else { -lateral })
        };
        let forward = road.forward.last().and_then(outward);
        let backward = road.backward.last().and_then(outward);
        match (forward, backward) {
            (Some(forward), Some(backward)) => Some(if forward >= backward { 0.0 } else { PI }),
            (Some(_), None) => Some(0.0),
            (None, Some(_)) => Some(PI),
            (None, None) => None,
        }
    }
}

/// Whether one may stop at the kerb of a road: not on what is for through traffic, nor in a roundabout, on a bridge or in a
/// tunnel.
fn has_kerb(road: &Road) -> bool {
    road.class != RoadClass::Highway && !road.roundabout && road.level == 0
}

/// How far the middle of the carriageway lies to the left of the centreline, m.
fn middle(road: &Road) -> f64 {
    (road.left_kerb - road.right_kerb) * 0.5
}

/// How far the carriageway reaches to a side of the centreline, m.
fn kerb(road: &Road, left: bool) -> f64 {
    if left { road.left_kerb } else { road.right_kerb }
}

/// Whether a thing with its middle on a strip is parked there. What has room on it is on it; what is wider stands along it, at its
/// outer edge, and out into the lane.
fn is_on_strip(road: &Road, strip: &Strip, solid: &Solid, is_along: bool) -> bool {
    let side = if strip.offset >= middle(road) { 1.0 } else { -1.0 };
    let outward = |corner| offset_along(&road.centerline, corner).map_or(f64::INFINITY, |off| off * side);
    let offsets = solid.corners().map(outward);
    let most = offsets.into_iter().fold(f64::NEG_INFINITY, f64::max);
    let least = offsets.into_iter().fold(f64::INFINITY, f64::min);
    let (own, edge) = (strip.offset * side, strip.width * 0.5);
    let room = own + edge - most;
    if most - least <= strip.width {
        room >= 0.0 && least >= own - edge - SLIP
    } else {
        is_along && (0.0..=AT_KERB).contains(&room)
    }
}

/// Between a kerb and the corner of a thing that is nearest to it, m; below zero where it stands beyond.
fn room_to_kerb(road: &Road, left: bool, solid: &Solid) -> f64 {
    let side = if left { 1.0 } else { -1.0 };
    let outward = |corner| offset_along(&road.centerline, corner).map_or(f64::INFINITY, |off| off * side);
    kerb(road, left) - solid.corners().map(outward).into_iter().fold(f64::NEG_INFINITY, f64::max)
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use simworld_core::geometry::Point3;
    use simworld_core::net::{CrossSection, DrivingSide, NetworkConfig, RoadNetwork, StreetPlan};
    use simworld_core::scene::Shape;

    use super::*;

    /// A crossroads with arms of 100 m; the first road leads east.
    fn streets(section: CrossSection, keeps: DrivingSide) -> Streets {
        let mut plan = StreetPlan::crossroads(100.0);
        plan.sections[0] = section;
        plan.driving_side = keeps;
        Streets::of(&Arc::new(RoadNetwork::derive(&plan, &NetworkConfig::default()).unwrap()))
    }

    fn car(x: f64, y: f64, yaw: f64) -> Solid {
        Solid::standing(Shape::cuboid(4.4, 1.8, 1.4), Point3::new(x, y, 0.0), yaw)
    }

    fn parked(streets: &Streets, solid: &Solid) -> Option<Land> {
        streets.parked(&streets.roads_near(solid.planar()), solid)
    }

    #[test]
    fn without_a_strip_one_parks_at_the_kerb_and_along_the_lane() {
        for (keeps, ahead) in [(DrivingSide::Right, false), (DrivingSide::Left, true)] {
            let mut section = CrossSection::two_way(1, 1);
            if keeps == DrivingSide::Left {
                section.lanes.reverse();
            }
            let streets = streets(section, keeps);
            for left in [false, true] {
                let (at, yaw) = streets.parking_at(RoadId::from_index(0), 60.0, left, 0.9).unwrap();
                // The kerb lies 3.5 m from the middle: the nearer side of the car 15 cm from it.
                let side = if left { 1.0 } else { -1.0 };
                assert!((at - Point2::new(60.0, side * 2.45)).norm() < 1e-9, "{at}");
                // On the right of the street traffic goes on along it where it keeps right.
                let wanted = if left == ahead { 0.0 } else { PI };
                assert!(wrap_angle(yaw - wanted).abs() < 1e-9, "{keeps:?} {left}: {yaw}");
                assert_eq!(parked(&streets, &car(at.x, at.y, yaw)), Some(Land::Kerbside));
            }
        }
    }

    #[test]
    fn who_stands_in_the_lane_across_it_or_against_it_is_not_parked() {
        let streets = streets(CrossSection::two_way(1, 1), DrivingSide::Right);
        assert_eq!(parked(&streets, &car(60.0, -2.45, 0.0)), Some(Land::Kerbside));
        assert_eq!(parked(&streets, &car(60.0, -1.5, 0.0)), None, "in the lane");
        assert_eq!(parked(&streets, &car(60.0, -2.45, PI)), None, "against it");
        assert_eq!(parked(&streets, &car(60.0, -1.0, FRAC_PI_2)), None, "across it");
        assert_eq!(parked(&streets, &car(60.0, -3.0, 0.0)), None, "on the sidewalk by a wheel");
    }

    #[test]
    fn a_strip_is_parked_on_either_way_round_and_what_is_wide_stands_out_of_it() {
        let streets = streets(CrossSection::two_way(1, 1).with_parking(2.0), DrivingSide::Right);
        // The strips reach from 3.5 m to 5.5 m.
        for yaw in [0.0, PI] {
            assert_eq!(parked(&streets, &car(60.0, -4.45, yaw)), Some(Land::Parking));
        }
        assert_eq!(parked(&streets, &car(60.0, -4.45, FRAC_PI_2)), None, "across it");
        assert_eq!(parked(&streets, &car(60.0, -3.9, 0.0)), None, "half in the lane");
        let lorry = |y| Solid::standing(Shape::cuboid(8.5, 2.5, 3.4), Point3::new(60.0, y, 0.0), 0.0);
        assert_eq!(parked(&streets, &lorry(-4.1)), Some(Land::Parking));
        assert_eq!(parked(&streets, &lorry(-3.6)), None, "too far from the kerb");
        let (at, _) = streets.parking_at(RoadId::from_index(0), 60.0, false, 1.25).unwrap();
        assert!((at.y + 4.1).abs() < 1e-9, "the outer side is 15 cm from the kerb: {at}");
    }

    #[test]
    fn on_a_one_way_street_both_sides_look_ahead() {
        let streets = streets(CrossSection::two_way(2, 0), DrivingSide::Right);
        // The carriageway lies to the right of the line from which it is measured.
        for (left, y) in [(true, -1.05), (false, -5.95)] {
            let (at, yaw) = streets.parking_at(RoadId::from_index(0), 60.0, left, 0.9).unwrap();
            assert!((at.y - y).abs() < 1e-9 && yaw.abs() < 1e-9, "{at}, {yaw}");
            assert_eq!(parked(&streets, &car(at.x, at.y, yaw)), Some(Land::Kerbside));
        }
    }
}
