//! What is painted on carriageways, by their lanes: lines, stop lines, arrows, cycle lanes; and what is let into them.
//!
//! A mark is a rectangle in the plane of its road and of its entity, so that ids and depth are those of the road. Lines are 0.12 m
//! wide, broken ones 3 m in 9, stop lines 0.4 m, arrows 5 m (the guidelines of German road marks, RMS 1980, in towns).

use simworld_core::geometry::Pose;
use simworld_core::id::RoadId;
use simworld_core::net::{LaneKind, Road};

use super::Fit;
use super::lanes::{End, Strip, end_of, strips_of, ways_of};
use crate::look::{Detail, Look};
use crate::mesh::{Drawn, MeshId};
use crate::resident;

/// The state of a road whose marks are parts of their own.
pub(super) const PAINTED: f32 = 1.0;
/// Rectangles of lines are so much wider than the line, to each side, m: far away a pixel covers more than the line.
const MARGIN: f64 = 0.3;
/// Width of lines and of stop lines, m.
const LINE: f64 = 0.12;
const STOP: f64 = 0.4;
/// Length and width of the rectangle of an arrow, m, and where its middle is before the end of the lane.
const ARROW: (f64, f64) = (5.2, 1.8);
const ARROW_BEFORE: f64 = 6.5;
/// Another arrow comes so much earlier, where there is room, m.
const ARROW_AGAIN: f64 = 26.0;
/// Length of a parking bay, m: 20 feet, as where citygen parks vehicles.
const BAY: f64 = 6.0;

/// What a mark is; the twin of the numbers in shaders/marks.wgsl.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Solid,
    Broken,
    Double,
    Stop,
    GiveWay,
    Cycle,
    Planted,
    Paved,
    Manhole,
    Gully,
    Across,
    Bicycle,
    /// Directions as [`ways_of`] gives them, and whether it is driven along the centreline.
    Arrow(u32, bool),
}

impl Kind {
    fn number(self) -> u32 {
        match self {
            Self::Solid => 1,
            Self::Broken => 2,
            Self::Double => 3,
            Self::Stop => 4,
            Self::GiveWay => 5,
            Self::Cycle => 6,
            Self::Planted => 7,
            Self::Paved => 8,
            Self::Manhole => 9,
            Self::Gully => 10,
            Self::Across => 11,
            Self::Bicycle => 12,
            Self::Arrow(ways, forward) => ways + if forward { 16 } else { 24 },
        }
    }

    /// Where it is seen: small things from near by alone.
    fn details(self) -> u8 {
        let small = matches!(self, Self::Manhole | Self::Gully | Self::Bicycle);
        if small { Detail::Near.bit() } else { Detail::Near.bit() | Detail::Middle.bit() }
    }
}

/// The layer of a mark by its state, among those that lie in one plane; the twin of `mark_layer` in shaders/surfaces.wgsl.
pub(crate) fn mark_layer(state: f32) -> u32 {
    match state as u32 & 31 {
        4 | 5 | 9 | 10 | 12 | 16.. => 0,
        6 | 7 | 8 | 11 => 2,
        _ => 1,
    }
}

/// Collects the marks of one box.
struct Painter<'a, 'b> {
    fit: &'a Fit<'b>,
    look: Look,
    out: &'a mut Vec<resident::Part>,
    /// The stations that the box covers.
    stations: (f64, f64),
    /// Width of one lane as the wheels have polished the road, m.
    lane: f64,
}

/// Paints a piece of a road.
pub(super) fn paint(fit: &Fit<'_>, road: RoadId, look: &Look, out: &mut Vec<resident::Part>) {
    let width = fit.size.y;
    let lane = width / (2.0 * (width / 6.0 + 0.25).floor().max(1.0));
    let mut painter = Painter { fit, look: *look, out, stations: fit.stations(), lane };
    let strips = strips_of(fit.network, road);
    for strip in &strips {
        painter.strip(strip);
    }
    for pair in strips.windows(2) {
        painter.between(&pair[0], &pair[1], &strips);
    }
    painter.let_in(road, &fit.network.roads[road.index()], &strips);
}

impl Painter<'_, '_> {
    /// A rectangle from station to station, its middle to the left of the centreline; cut to the box, or left out if it lies
    /// outside.
    fn add(&mut self, kind: Kind, (from, to): (f64, f64), offset: f64, width: f64) {
        let (from, to) = (from.max(self.stations.0), to.min(self.stations.1));
        let (x, y) = (self.fit.along((from + to) * 0.5), self.fit.aside(offset));
        let length = (to - from) * self.fit.slope;
        // Where the frame of the road is, for all that is the same on the mark as beside it; see `on_road` in the shader.
        let (x_code, y_code) = ((x / 0.02).round() + 250_000.0, (y / 0.01).round() + 8192.0);
        let lane = (self.lane * 100.0).round().min(1000.0);
        if length < 0.05 || !(0.0..500_000.0).contains(&x_code) || !(0.0..16_384.0).contains(&y_code) {
            return;
        }
        // As rounded, so that the shader knows the place exactly.
        let place = [(x_code - 250_000.0) * 0.02, (y_code - 8192.0) * 0.01, 0.0];
        let look = Look {
            mesh: MeshId::Mark,
            scale: [length as f32, width as f32, self.look.scale[2]],
            state: (f64::from(kind.number()) + 32.0 * x_code) as f32,
            param: (y_code + 16_384.0 * lane) as f32,
            ..self.look
        };
        let pose = self.fit.pose * Pose::translation(place[0], place[1], place[2]);
        self.out.push(resident::Part { mesh: Drawn::Own(look.mesh), pose, look, details: kind.details() });
    }

    /// A whole mark that is not cut: it is there if its middle is.
    fn put(&mut self, kind: Kind, station: f64, offset: f64, (length, width): (f64, f64)) {
        if (self.stations.0..self.stations.1).contains(&station) {
            let half = length * 0.5;
            let kept = std::mem::replace(&mut self.stations, (f64::NEG_INFINITY, f64::INFINITY));
            self.add(kind, (station - half, station + half), offset, width);
            self.stations = kept;
        }
    }

    fn line(&mut self, kind: Kind, stations: (f64, f64), offset: f64) {
        let wide = if kind == Kind::Double { 0.3 } else { 0.0 };
        self.add(kind, stations, offset, LINE + wide + 2.0 * MARGIN);
    }

    /// What is painted within a strip, and at its end.
    fn strip(&mut self, strip: &Strip) {
        match strip.kind {
            LaneKind::Cycle => {
                self.add(Kind::Cycle, strip.stations, strip.offset, strip.width);
                let before = if strip.forward { -12.0 } else { 12.0 };
                self.put(Kind::Bicycle, strip.end() + before, strip.offset, (1.8, 1.1));
            }
            LaneKind::Median => {
                let kind = if strip.width >= 1.8 { Kind::Planted } else { Kind::Paved };
                self.add(kind, strip.stations, strip.offset, strip.width);
            }
            LaneKind::Parking => self.bays(strip),
            kind if kind.is_driven() => self.lane_end(strip),
            _ => {}
        }
    }

    /// The lines between the places of a strip where one parks.
    fn bays(&mut self, strip: &Strip) {
        let (from, to) = strip.stations;
        let count = ((to - from) / BAY).floor().max(0.0);
        let start = from + (to - from - count * BAY) * 0.5;
        for bay in 0..=count as u32 {
            let size = (LINE + 2.0 * MARGIN, strip.width);
            self.put(Kind::Across, start + f64::from(bay) * BAY, strip.offset, size);
        }
    }

    /// Stop line and arrows.
    fn lane_end(&mut self, strip: &Strip) {
        let Some(lane) = strip.lane else { return };
        let back = if strip.forward { -1.0 } else { 1.0 };
        let kind = match end_of(self.fit.network, lane) {
            End::Nothing => None,
            End::Stop => Some(Kind::Stop),
            End::GiveWay => Some(Kind::GiveWay),
        };
        if let Some(kind) = kind {
            let station = strip.end() + back * STOP * 0.5;
            self.put(kind, station, strip.offset, (STOP + 2.0 * MARGIN, strip.width));
        }
        let road = &self.fit.network.roads[self.fit.network.lanes[lane.index()].road.index()];
        let beside = if strip.forward { &road.forward } else { &road.backward };
        let ways = ways_of(self.fit.network, lane);
        let length = strip.stations.1 - strip.stations.0;
        for before in [ARROW_BEFORE, ARROW_BEFORE + ARROW_AGAIN] {
            if beside.len() > 1 && ways != 0 && before + ARROW.0 < length {
                self.put(Kind::Arrow(ways, strip.forward), strip.end() + back * before, strip.offset, ARROW);
            }
        }
    }

    /// The line between two strips, the left one first.
    fn between(&mut self, left: &Strip, right: &Strip, all: &[Strip]) {
        if (left.right() - right.left()).abs() > 0.3 {
            return;
        }
        let stations = (left.stations.0.max(right.stations.0), left.stations.1.min(right.stations.1));
        let border = (left.right() + right.left()) * 0.5;
        let driven = [left, right].map(|strip| strip.kind.is_driven());
        let kind = match driven {
            [true, true] if left.forward == right.forward => Kind::Broken,
            [true, true] if all.iter().filter(|strip| strip.kind.is_driven()).count() > 2 => Kind::Double,
            [true, true] => Kind::Broken,
            [false, false] => return,
            _ => Kind::Solid,
        };
        self.line(kind, stations, border);
    }

    /// Manholes in the lanes, and gullies before the kerbs.
    fn let_in(&mut self, road: RoadId, data: &Road, strips: &[Strip]) {
        let driven: Vec<&Strip> = strips.iter().filter(|strip| strip.kind.is_driven()).collect();
        let Some((from, to)) = driven.first().map(|strip| strip.stations) else { return };
        // A number of the road's own.
        let mix =
            |k: u32| (road.0.wrapping_mul(0x9e37_79b9) ^ k.wrapping_mul(0x85eb_ca6b)).rotate_left(13) >> 8;
        for k in 0..((to - from) / 45.0) as u32 {
            let station = from + 20.0 + f64::from(k) * 45.0 + f64::from(mix(k) % 100) * 0.08;
            let strip = driven[mix(k + 77) as usize % driven.len()];
            self.put(Kind::Manhole, station, strip.offset + 0.2, (0.8, 0.8));
        }
        for k in 0..((to - from) / 28.0) as u32 {
            let station = from + 6.0 + f64::from(k) * 28.0;
            for offset in [data.left_kerb - 0.26, 0.26 - data.right_kerb] {
                self.put(Kind::Gully, station, offset, (0.5, 0.36));
            }
        }
    }
}
