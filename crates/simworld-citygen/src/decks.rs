//! The bodies of bridges: decks along their streets, parapets, abutments where a deck is near the ground, piers elsewhere.

use simworld_core::geometry::{Point2, Vector2, bounds, direction};
use simworld_core::id::RoadId;
use simworld_core::net::{LaneKind, Road, RoadNetwork, Side, polyline};

use crate::element::Element;
use crate::terrain::{DECK, Ground};

/// A street this much above the ground lies on a deck, m, and one this much above it has parapets.
const RAISED: f64 = 0.02;
const CARRIED: f64 = 0.3;
/// Below less free height than this a deck lies on an abutment, m.
const ABUTMENT: f64 = 2.0;
/// Longest piece of a deck, and distance between piers, m.
const LONGEST: f64 = 10.0;
const PIERS: f64 = 20.0;
/// A pier keeps this distance from streets below, m.
const CLEAR: f64 = 1.0;

/// A straight piece of a deck.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Span {
    /// Its ends on the centreline, m.
    pub(crate) ends: [Point2; 2],
    /// Height of the carriageway at its ends above the ground level of the world, m.
    pub(crate) heights: [f64; 2],
    /// Height of the ground below its ends, m.
    pub(crate) ground: [f64; 2],
}

impl Span {
    /// The least height free below it, m.
    fn free(&self) -> f64 {
        (self.heights[0] - self.ground[0]).min(self.heights[1] - self.ground[1]) - DECK
    }

    /// Whether it lies on an abutment.
    pub(crate) fn is_on_ground(&self) -> bool {
        self.free() < ABUTMENT
    }

    /// Whether it leaves the ground.
    pub(crate) fn is_raised(&self) -> bool {
        (0..2).any(|end| self.heights[end] - self.ground[end] > RAISED)
    }

    /// Whether one could fall off it.
    pub(crate) fn is_carried(&self) -> bool {
        (0..2).any(|end| self.heights[end] - self.ground[end] > CARRIED)
    }
}

/// A column below a deck.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pier {
    /// Where it stands, m.
    pub(crate) at: Point2,
    /// The way across the bridge.
    pub(crate) across: Vector2,
    /// Heights of its foot and its top, m.
    pub(crate) heights: (f64, f64),
}

/// The body of a street above the ground.
#[derive(Clone, Debug)]
pub(crate) struct Bridge {
    pub(crate) road: RoadId,
    /// How far the deck reaches to the left and to the right of the centreline, m.
    pub(crate) sides: (f64, f64),
    pub(crate) spans: Vec<Span>,
    pub(crate) piers: Vec<Pier>,
    /// Stations between which parapets stand: not before the junctions at its ends.
    pub(crate) between: (f64, f64),
}

impl Bridge {
    /// The walkways on the deck: each the left and the right edge, to the left of the centreline, m.
    pub(crate) fn walks(&self, road: &Road) -> impl Iterator<Item = (f64, f64)> {
        let (left, right) = (road.left_kerb, road.right_kerb);
        [(self.sides.0, left), (-right, -self.sides.1)].into_iter().filter(|(a, b)| a - b > 0.1)
    }
}

/// The bridges of a network: all streets above the ground, in their order.
pub(crate) fn bridges(network: &RoadNetwork, ground: &Ground<'_>) -> Vec<Bridge> {
    let above = network.roads.iter().enumerate().filter(|(_, road)| road.level > 0);
    above.map(|(index, _)| bridge(network, RoadId::from_index(index), ground)).collect()
}

/// Takes away what stands below decks: trees and lamps are higher than the room there.
pub(crate) fn clear_below(network: &RoadNetwork, elements: &mut Vec<Element>) {
    let above = network.roads.iter().enumerate().filter(|(_, road)| road.level > 0);
    let decks: Vec<(&Road, f64)> = above
        .map(|(index, road)| {
            let id = RoadId::from_index(index);
            (road, reach(network, id, Side::Left).max(reach(network, id, Side::Right)) + CLEAR)
        })
        .collect();
    if decks.is_empty() {
        return;
    }
    elements.retain(|element| {
        decks.iter().all(|(road, reach)| {
            let (low, high) = extent(road);
            let gap = (low - element.position).sup(&(element.position - high)).max();
            gap > *reach
                || polyline::closest(&road.centerline, &element.position)
                    .is_none_or(|near| near.distance > *reach)
        })
    });
}

fn bridge(network: &RoadNetwork, id: RoadId, ground: &Ground<'_>) -> Bridge {
    let road = &network.roads[id.index()];
    let sides = (reach(network, id, Side::Left), reach(network, id, Side::Right));
    let stations = stations(road);
    let place = |station: f64| polyline::at(&road.centerline, station).0;
    let spans = stations
        .windows(2)
        .map(|pair| {
            let ends = [place(pair[0]), place(pair[1])];
            let heights = [network.height(id, pair[0]), network.height(id, pair[1])];
            Span { ends, heights, ground: ends.map(|end| ground.height(end)) }
        })
        .collect();
    let length = polyline::length(&road.centerline);
    let lane = road.forward.iter().chain(&road.backward).next().map(|lane| &network.lanes[lane.index()].path);
    let station = |point: Option<&Point2>| {
        point.and_then(|point| polyline::closest(&road.centerline, point)).map(|near| near.station)
    };
    let lane = lane.map(Vec::as_slice).unwrap_or_default();
    let (a, b) = (station(lane.first()).unwrap_or(0.0), station(lane.last()).unwrap_or(length));
    let piers = piers(network, id, length, ground);
    Bridge { road: id, sides, spans, piers, between: (a.min(b), a.max(b)) }
}

/// How far a street reaches to one side, m: to the outer edge of its sidewalk.
fn reach(network: &RoadNetwork, id: RoadId, side: Side) -> f64 {
    let road = &network.roads[id.index()];
    let (kerb, sign) = if side == Side::Left { (road.left_kerb, 1.0) } else { (road.right_kerb, -1.0) };
    let beside =
        road.strips.iter().filter(|strip| strip.kind == LaneKind::Verge && strip.offset * sign > kerb);
    let verges: f64 = beside.map(|strip| strip.width).sum();
    kerb + verges + network.sidewalk(id, side).map_or(0.0, |walk| walk.width)
}

/// Where a deck bends, and places between so that no piece is long.
fn stations(road: &Road) -> Vec<f64> {
    let mut bends = vec![0.0];
    for pair in road.centerline.windows(2) {
        bends.push(bends[bends.len() - 1] + (pair[1] - pair[0]).norm());
    }
    let length = bends[bends.len() - 1];
    bends.extend(road.profile.iter().map(|(station, _)| station.min(length)));
    bends.sort_by(f64::total_cmp);
    bends.dedup_by(|a, b| *a - *b < 0.05);
    let mut stations = vec![0.0];
    for pair in bends.windows(2) {
        let count = ((pair[1] - pair[0]) / LONGEST).ceil().max(1.0);
        stations
            .extend((1..=count as u32).map(|part| pair[0] + (pair[1] - pair[0]) * f64::from(part) / count));
    }
    stations
}

/// Piers where the deck is high, but none in the way of those who drive or walk below.
fn piers(network: &RoadNetwork, id: RoadId, length: f64, ground: &Ground<'_>) -> Vec<Pier> {
    let road = &network.roads[id.index()];
    let below: Vec<&Road> =
        network.roads.iter().filter(|other| other.level < road.level && is_near(road, other)).collect();
    let is_free = |at: Point2| {
        below.iter().all(|other| {
            let reach = other.left_kerb.max(other.right_kerb) + WALK + CLEAR;
            polyline::closest(&other.centerline, &at).is_none_or(|near| near.distance > reach)
        })
    };
    let count = (length / PIERS).floor() as u32;
    (1..=count)
        .map(|rank| f64::from(rank) * length / f64::from(count + 1))
        .filter_map(|station| {
            let (at, along) = polyline::at(&road.centerline, station);
            let heights = (ground.height(at), network.height(id, station) - DECK);
            let is_high = heights.1 - heights.0 > ABUTMENT;
            (is_high && is_free(at)).then(|| {
                let along = direction(along);
                Pier { at, across: Vector2::new(-along.y, along.x), heights }
            })
        })
        .collect()
}

/// Room for those who walk beside a carriageway, m.
const WALK: f64 = 3.0;

/// Whether the rectangles around two streets come near each other.
fn is_near(a: &Road, b: &Road) -> bool {
    let (a, b) = (extent(a), extent(b));
    (b.0 - a.1).sup(&(a.0 - b.1)).max() < 30.0
}

/// The rectangle around a centreline, least and greatest corner.
fn extent(road: &Road) -> (Point2, Point2) {
    bounds(&road.centerline).unwrap_or_default()
}
