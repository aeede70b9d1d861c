//! Lanes and sidewalks from tags.
//!
//! Sources: <https://wiki.openstreetmap.org/wiki/Lanes>, `Key:sidewalk`, `Key:cycleway`, `Street_parking`. What tags do
//! not say is taken from the kind of street.

use simworld_core::net::{CrossSection, LaneDirection, LaneKind, LaneSpec};

use super::kind::Kind;
use crate::osm::tags::{Key, Tags};

/// Most lanes each way.
const MOST_LANES: u8 = 8;
/// Widths where tags say nothing, dm: cycle lanes and tracks, parking along and across the kerb, sidewalks.
const CYCLE_LANE: u16 = 15;
const CYCLE_TRACK: u16 = 20;
const PARALLEL: u16 = 22;
const DIAGONAL: u16 = 45;
const PERPENDICULAR: u16 = 50;
const SIDEWALK: u16 = 25;
/// Least and greatest width of a lane, dm.
const LANE: (u16, u16) = (22, 45);

/// What a street is across: counts and widths in decimetres, the left before the right, seen along its course.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Profile {
    /// Lanes driven along the course, those of buses among them.
    pub(super) forward: u8,
    /// Lanes driven against it.
    pub(super) backward: u8,
    /// How many of the lanes along, and of those against, are for buses.
    pub(super) bus: [u8; 2],
    /// Width of a lane.
    pub(super) lane: u16,
    /// Width of what keeps the two directions apart.
    pub(super) median: u16,
    /// Cycle lanes at the two sides.
    pub(super) cycle: [u16; 2],
    /// Parking at the two sides.
    pub(super) parking: [u16; 2],
    /// Sidewalks at the two sides.
    pub(super) sidewalk: [u16; 2],
    /// How far the middle of the carriageway lies to the left of the line on the map.
    pub(super) shift: i16,
    /// Whether traffic keeps left.
    pub(super) is_left_hand: bool,
}

/// Which way traffic goes on a way.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum OneWay {
    No,
    Along,
    Against,
}

/// Which way traffic goes, by tags and by what a kind implies.
pub(super) fn one_way(tags: &Tags<'_>) -> OneWay {
    let first = tags.get(Key::OneWay).and_then(|value| value.split(';').next()).map(str::trim);
    match first {
        Some("yes" | "true" | "1" | "reversible" | "alternating") => OneWay::Along,
        Some("-1" | "reverse") => OneWay::Against,
        Some("no" | "false" | "0") => OneWay::No,
        _ if tags.is_any(Key::Junction, &["roundabout", "circular"]) => OneWay::Along,
        _ if tags.is_any(Key::Highway, &["motorway", "motorway_link"]) => OneWay::Along,
        _ => OneWay::No,
    }
}

impl Profile {
    /// That of a way, along its course; a way driven only against its course must be turned first.
    pub(super) fn of(tags: &Tags<'_>, kind: Kind, one_way: OneWay, is_left_hand: bool) -> Self {
        let is_one_way = one_way != OneWay::No;
        let (forward, backward) = lanes(tags, kind, is_one_way);
        let mut profile = Self {
            forward,
            backward,
            bus: bus_lanes(tags, forward, backward),
            lane: kind.lane,
            median: 0,
            cycle: sides(
                tags,
                [Key::Cycleway, Key::CyclewayBoth, Key::CyclewayLeft, Key::CyclewayRight],
                cycle_width,
            ),
            parking: parking(tags),
            sidewalk: sidewalks(tags, kind),
            shift: 0,
            is_left_hand,
        };
        if one_way == OneWay::Against {
            // Left and right are those of the way as it was drawn.
            for pair in [&mut profile.cycle, &mut profile.parking, &mut profile.sidewalk] {
                pair.swap(0, 1);
            }
        }
        profile.lane = profile.lane_width(tags, kind);
        profile
    }

    /// The width of a lane: what is left of the carriageway, if its width is known.
    fn lane_width(&self, tags: &Tags<'_>, kind: Kind) -> u16 {
        let lanes = u16::from(self.forward + self.backward);
        let known = tags.metres(Key::Width).filter(|width| *width < 60.0);
        let Some(width) = known else {
            // One lane for both directions: two narrow ones, so that people can pass each other at a walk.
            let is_narrow = lanes == 2 && tags.count(Key::Lanes) == Some(1);
            return if is_narrow { LANE.0 } else { kind.lane };
        };
        let beside: u16 = self.cycle.iter().chain(&self.parking).sum();
        let room = ((width * 10.0) as u16).saturating_sub(beside);
        (room / lanes).clamp(LANE.0, LANE.1)
    }

    /// The same street seen from its other end.
    pub(super) fn mirrored(&self) -> Self {
        let swap = |[left, right]: [u16; 2]| [right, left];
        Self {
            forward: self.backward,
            backward: self.forward,
            bus: [self.bus[1], self.bus[0]],
            cycle: swap(self.cycle),
            parking: swap(self.parking),
            sidewalk: swap(self.sidewalk),
            shift: -self.shift,
            ..*self
        }
    }

    /// Width between the kerbs, m.
    pub(super) fn carriageway(&self) -> f64 {
        let lanes = u16::from(self.forward + self.backward) * self.lane;
        let beside: u16 = self.cycle.iter().chain(&self.parking).sum();
        let median = if self.median < 3 { 0 } else { self.median };
        f64::from(lanes + beside + median) * 0.1
    }

    /// As a cross-section; the line on the map is the middle of the carriageway, unless it is shifted.
    pub(super) fn section(&self) -> CrossSection {
        use LaneDirection::{Backward, Both, Forward};
        let width = |decimetres: u16| f64::from(decimetres) * 0.1;
        let mut lanes = Vec::with_capacity(12);
        let mut push = |kind, direction, decimetres: u16| {
            if decimetres > 0 {
                lanes.push(LaneSpec { kind, direction, width: width(decimetres) });
            }
        };
        // Beside one-way traffic everything goes its way.
        let (left, right) = match (self.forward, self.backward) {
            (_, 0) => (Forward, Forward),
            (0, _) => (Backward, Backward),
            _ if self.is_left_hand => (Forward, Backward),
            _ => (Backward, Forward),
        };
        let count = |direction| if direction == Forward { self.forward } else { self.backward };
        let bus = |direction| self.bus[usize::from(direction == Backward)].min(count(direction));
        push(LaneKind::Sidewalk, Both, self.sidewalk[0]);
        push(LaneKind::Parking, left, self.parking[0]);
        push(LaneKind::Cycle, left, self.cycle[0]);
        if left != right {
            // Buses keep to the kerb.
            for rank in 0..count(left) {
                push(if rank < bus(left) { LaneKind::Bus } else { LaneKind::Driving }, left, self.lane);
            }
            // Less is a double line.
            push(LaneKind::Median, Both, if self.median < 3 { 0 } else { self.median });
        }
        for rank in (0..count(right)).rev() {
            push(if rank < bus(right) { LaneKind::Bus } else { LaneKind::Driving }, right, self.lane);
        }
        push(LaneKind::Cycle, right, self.cycle[1]);
        push(LaneKind::Parking, right, self.parking[1]);
        push(LaneKind::Sidewalk, Both, self.sidewalk[1]);
        let middle = width(self.sidewalk[0]) + self.carriageway() * 0.5;
        CrossSection { reference: middle + f64::from(self.shift) * 0.1, lanes }
    }
}

/// Lanes along and against.
fn lanes(tags: &Tags<'_>, kind: Kind, is_one_way: bool) -> (u8, u8) {
    let count = |key| tags.count(key).filter(|lanes| *lanes > 0).map(|lanes| lanes.min(64) as u8);
    let turns = |key| tags.get(key).map(|value| value.split('|').count().min(64) as u8);
    let along = count(Key::LanesForward).or_else(|| turns(Key::TurnLanesForward));
    let against = count(Key::LanesBackward).or_else(|| turns(Key::TurnLanesBackward));
    let all = count(Key::Lanes);
    let within = |lanes: u8| lanes.clamp(1, MOST_LANES);
    if is_one_way {
        return (within(all.or_else(|| turns(Key::TurnLanes)).or(along).unwrap_or(kind.lanes)), 0);
    }
    let (forward, backward) = match (along, against, all) {
        (Some(along), Some(against), _) => (along, against),
        (Some(along), None, Some(all)) => (along, all.saturating_sub(along)),
        (None, Some(against), Some(all)) => (all.saturating_sub(against), against),
        (Some(along), None, None) => (along, kind.lanes),
        (None, Some(against), None) => (kind.lanes, against),
        (None, None, Some(all)) => (all.div_ceil(2), all / 2),
        (None, None, None) => (kind.lanes, kind.lanes),
    };
    (within(forward), within(backward))
}

/// Lanes for buses along and against; cars keep at least one.
fn bus_lanes(tags: &Tags<'_>, forward: u8, backward: u8) -> [u8; 2] {
    let own = tags.count(Key::LanesBus).or_else(|| tags.count(Key::LanesPsv)).unwrap_or(0);
    let beside = u32::from(tags.is_any(Key::Busway, &["lane", "right", "left", "both"]));
    let wanted = own.max(beside).min(8) as u8;
    [forward, backward]
        .map(|lanes| if backward > 0 { wanted.div_ceil(2) } else { wanted }.min(lanes.saturating_sub(1)))
}

/// The widths that the values of some keys mean: those for both sides, then left and right.
fn sides(tags: &Tags<'_>, keys: [Key; 4], width: impl Fn(&str) -> u16) -> [u16; 2] {
    let value = |key| tags.get(key).map(&width);
    let both = value(keys[1]).or_else(|| value(keys[0])).unwrap_or(0);
    [value(keys[2]).unwrap_or(both), value(keys[3]).unwrap_or(both)]
}

fn cycle_width(value: &str) -> u16 {
    match value {
        "lane" | "opposite_lane" | "buffered_lane" | "both" => CYCLE_LANE,
        "track" | "opposite_track" => CYCLE_TRACK,
        _ => 0,
    }
}

fn parking(tags: &Tags<'_>) -> [u16; 2] {
    let width = |value: &str| match value {
        "parallel" | "lane" | "street_side" | "half_on_kerb" | "marked" | "yes" => PARALLEL,
        "diagonal" => DIAGONAL,
        "perpendicular" => PERPENDICULAR,
        _ => 0,
    };
    let new = sides(tags, [Key::ParkingBoth, Key::ParkingBoth, Key::ParkingLeft, Key::ParkingRight], width);
    let old = [Key::ParkingLaneBoth, Key::ParkingLaneBoth, Key::ParkingLaneLeft, Key::ParkingLaneRight];
    if new == [0, 0] { sides(tags, old, width) } else { new }
}

/// Sidewalks. One that is drawn as a way of its own is still the sidewalk of its street.
fn sidewalks(tags: &Tags<'_>, kind: Kind) -> [u16; 2] {
    let usual = if kind.has_sidewalks { SIDEWALK } else { 0 };
    let [left, right] = match tags.get(Key::Sidewalk) {
        Some("both" | "yes" | "separate") => [SIDEWALK, SIDEWALK],
        Some("left") => [SIDEWALK, 0],
        Some("right") => [0, SIDEWALK],
        Some("no" | "none") => [0, 0],
        _ => [usual, usual],
    };
    let value = |key| match tags.get(key) {
        Some("no" | "none") => Some(0),
        Some("yes" | "separate") => Some(SIDEWALK),
        _ => None,
    };
    let both = value(Key::SidewalkBoth);
    [value(Key::SidewalkLeft).or(both).unwrap_or(left), value(Key::SidewalkRight).or(both).unwrap_or(right)]
}
