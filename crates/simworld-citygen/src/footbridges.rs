//! The bodies of footbridges: decks and flights of stairs along their ways, railings, walls to the ground where they are low, piers where
//! they are high.

use std::collections::BTreeMap;

use simworld_core::geometry::{Point2, Vector2, bounds, direction};
use simworld_core::net::{FOOTBRIDGE_DECK, Footpath, FootpathHeights, RoadNetwork, polyline};

use crate::decks::{Pier, Span};
use crate::terrain::Ground;

/// A way this much above the ground lies on a deck, m, and one this much above it has railings.
const RAISED: f64 = 0.02;
const CARRIED: f64 = 0.3;
/// Below less free height than this nobody walks, and a wall closes it, m.
const LOW: f64 = 2.0;
/// Longest piece of a deck, the most that a piece rises, and distance between piers, m.
const LONGEST: f64 = 10.0;
const RISES: f64 = 1.0;
const PIERS: f64 = 20.0;
/// A pier keeps this distance from sidewalks and ways below, m.
const CLEAR: f64 = 1.0;
/// Room for those who walk beside a carriageway, m.
const WALK: f64 = 3.0;
/// Cosine of the sharpest bend in which the railings of one bridge lead on to those of the next.
const STRAIGHT: f64 = 0.86;
/// What is steeper than this is stairs, rise over run.
const STAIRS: f64 = 0.3;

/// A straight piece of a footbridge.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Flight {
    pub(crate) span: Span,
    /// Whether it has railings: not where another bridge branches off.
    pub(crate) has_railings: bool,
}

impl Flight {
    /// The least height free below it, m.
    fn free(&self) -> f64 {
        let [a, b] = self.above();
        a.min(b) - FOOTBRIDGE_DECK
    }

    /// How high its ends are above the ground, m.
    fn above(&self) -> [f64; 2] {
        [0, 1].map(|end| self.span.heights[end] - self.span.ground[end])
    }

    /// Whether a wall closes what is below.
    pub(crate) fn has_wall(&self) -> bool {
        let [a, b] = self.above();
        self.free() < LOW && a.max(b) > FOOTBRIDGE_DECK + 0.05
    }

    /// Whether one goes up or down on steps.
    pub(crate) fn is_stairs(&self) -> bool {
        let run = (self.span.ends[1] - self.span.ends[0]).norm();
        (self.span.heights[1] - self.span.heights[0]).abs() > STAIRS * run
    }
}

/// The body of a way for walkers above the ground.
#[derive(Clone, Debug)]
pub(crate) struct Footbridge {
    /// Its way, by index.
    pub(crate) way: usize,
    /// Half the width of its deck, m.
    pub(crate) half: f64,
    pub(crate) flights: Vec<Flight>,
    pub(crate) piers: Vec<Pier>,
}

/// All of a network, in the order of their ways; of ways on the ground the stairs with which they lead down from bridges.
pub(crate) fn footbridges(network: &RoadNetwork, ground: &Ground<'_>) -> Vec<Footbridge> {
    let heights = network.footpath_heights();
    if heights.is_level() {
        return Vec::new();
    }
    let corners = Corners::of(network, &heights);
    heights.raised().map(|(way, _)| footbridge(network, (way, &heights), &corners, ground)).collect()
}

fn footbridge(
    network: &RoadNetwork,
    (way, heights): (usize, &FootpathHeights),
    corners: &Corners,
    ground: &Ground<'_>,
) -> Footbridge {
    let footpath = &network.footpaths[way];
    let length = polyline::length(&footpath.path);
    let open = [0, 1].map(|end| corners.room(footpath, end).min(length * 0.5));
    let stations = stations(network, (way, heights), [open[0], length - open[1]]);
    let point = |station: f64| polyline::at(&footpath.path, station).0;
    let height = |station: f64| ground.height(point(station)) + heights.at(way, station);
    let flights = stations.windows(2).map(|pair| {
        let ends = [point(pair[0]), point(pair[1])];
        let heights = [height(pair[0]), height(pair[1])];
        let span = Span { ends, heights, ground: ends.map(|end| ground.height(end)) };
        let is_between = pair[0] >= open[0] - 1e-6 && pair[1] <= length - open[1] + 1e-6;
        let is_carried = (0..2).any(|end| span.heights[end] - span.ground[end] > CARRIED);
        Flight { span, has_railings: is_between && is_carried }
    });
    let is_raised = |flight: &Flight| {
        let [a, b] = flight.above();
        a.max(b) > RAISED && flight.span.ends[0] != flight.span.ends[1]
    };
    let flights = flights.filter(is_raised).collect();
    Footbridge { way, half: footpath.width * 0.5, flights, piers: piers(network, (way, heights), ground) }
}

/// Where a deck bends or its railings end, and places between so that no piece is long or rises by much.
fn stations(
    network: &RoadNetwork,
    (way, heights): (usize, &FootpathHeights),
    railings: [f64; 2],
) -> Vec<f64> {
    let mut bends = vec![0.0];
    for pair in network.footpaths[way].path.windows(2) {
        bends.push(bends[bends.len() - 1] + (pair[1] - pair[0]).norm());
    }
    let length = bends[bends.len() - 1];
    bends.extend(heights.profile(way).iter().map(|(station, _)| station.min(length)));
    bends.extend(railings);
    bends.sort_by(f64::total_cmp);
    bends.dedup_by(|a, b| *a - *b < 0.02);
    let mut stations = vec![0.0];
    for pair in bends.windows(2) {
        let rise = (heights.at(way, pair[1]) - heights.at(way, pair[0])).abs();
        let count = ((pair[1] - pair[0]) / LONGEST).max(rise / RISES).ceil().max(1.0);
        let parts = (1..=count as u32).map(|part| f64::from(part) / count);
        stations.extend(parts.map(|share| pair[0] + (pair[1] - pair[0]) * share));
    }
    stations
}

/// Which bridges meet at their ends, above the ground.
struct Corners(BTreeMap<[u64; 2], Vec<(Vector2, f64)>>);

impl Corners {
    fn of(network: &RoadNetwork, heights: &FootpathHeights) -> Self {
        let mut met: BTreeMap<[u64; 2], Vec<(Vector2, f64)>> = BTreeMap::new();
        for (way, profile) in heights.raised() {
            let footpath = &network.footpaths[way];
            for (end, bend) in [(0, profile.first()), (1, profile.last())] {
                let is_high = bend.is_some_and(|(_, height)| *height > CARRIED);
                if let Some((at, outwards)) = end_of(footpath, end).filter(|_| is_high) {
                    met.entry(key(at)).or_default().push((outwards, footpath.width));
                }
            }
        }
        Self(met)
    }

    /// How far from an end of a way the railings begin, so that one comes to the others that end there, m.
    fn room(&self, footpath: &Footpath, end: usize) -> f64 {
        let Some((at, _)) = end_of(footpath, end) else { return 0.0 };
        match self.0.get(&key(at)).map(Vec::as_slice) {
            None | Some([] | [_]) => 0.0,
            Some([a, b]) if a.0.dot(&b.0) < -STRAIGHT => 0.0,
            Some(all) => all.iter().map(|(_, width)| *width).fold(0.0, f64::max) * 0.5 + 0.1,
        }
    }
}

fn key(at: Point2) -> [u64; 2] {
    [at.x.to_bits(), at.y.to_bits()]
}

/// An end of a way and the direction in which it leaves there.
fn end_of(footpath: &Footpath, end: usize) -> Option<(Point2, Vector2)> {
    let (at, inner) = match (footpath.path.as_slice(), end) {
        ([at, inner, ..], 0) | ([.., inner, at], 1) => (*at, *inner),
        _ => return None,
    };
    Some((at, (at - inner).try_normalize(1e-9)?))
}

/// Piers where the deck is high, but none in the way of those who drive or walk below.
fn piers(network: &RoadNetwork, (way, heights): (usize, &FootpathHeights), ground: &Ground<'_>) -> Vec<Pier> {
    let footpath = &network.footpaths[way];
    let length = polyline::length(&footpath.path);
    let is_free = |at: Point2| {
        let is_near = |path: &[Point2], reach: f64| {
            let (low, high) = bounds(path).unwrap_or_default();
            (low - at).sup(&(at - high)).max() <= reach
                && polyline::closest(path, &at).is_some_and(|near| near.distance <= reach)
        };
        let mut roads = network.roads.iter().filter(|road| road.level < footpath.level);
        let mut ways = network.footpaths.iter().filter(|way| way.level < footpath.level);
        !roads.any(|road| is_near(&road.centerline, road.left_kerb.max(road.right_kerb) + WALK + CLEAR))
            && !ways.any(|way| is_near(&way.path, way.width * 0.5 + CLEAR))
    };
    let count = (length / PIERS).floor() as u32;
    (1..=count)
        .map(|rank| f64::from(rank) * length / f64::from(count + 1))
        .filter_map(|station| {
            let (at, along) = polyline::at(&footpath.path, station);
            let above = heights.at(way, station) - FOOTBRIDGE_DECK;
            let foot = ground.height(at);
            (above > LOW && is_free(at)).then(|| {
                let along = direction(along);
                Pier { at, across: Vector2::new(-along.y, along.x), heights: (foot, foot + above) }
            })
        })
        .collect()
}
