//! The lines along which rows stand: streets, the sides of a thing, the line between two, circles; and where along them.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use simworld_core::geometry::{Point2, direction, heading};
use simworld_core::id::RoadId;
use simworld_core::net::polyline;

use super::edit::{Line, Spacing};
use super::error::EditError;
use super::land::Streets;
use super::sample::{Sampler, Spot};
use super::solid::Solid;
use super::stand::ROADSIDE;

/// Off a kerb or a wall things of a row are tried so far, m.
const OFFS: [f64; 7] = [0.5, 0.8, 1.2, 1.8, 2.4, 3.2, 4.2];
/// Between things of a row there is a hand's breadth, m.
pub(super) const HAND: f64 = 0.1;
/// More things in a row are refused.
const MOST: usize = 1000;

/// A way along which a row may stand: where a station along it is, at a distance off it.
pub(super) struct Track<'a> {
    /// m.
    pub(super) length: f64,
    /// Whether its end is its beginning.
    pub(super) is_ring: bool,
    /// So far off what the row is along its things are tried, m.
    pub(super) offs: Vec<f64>,
    pub(super) spot: Box<dyn Fn(f64, f64) -> Option<Spot> + 'a>,
}

/// Where along a track things stand, m; refuses distances that no row has.
pub(super) fn stations(track: &Track<'_>, spacing: Spacing, extent: f64) -> Result<Vec<f64>, EditError> {
    let length = track.length;
    let impossible = |what: String, why: String| Err(EditError::Impossible { what, why });
    match spacing {
        Spacing::Every(step) => {
            let what = format!("a row with one every {step:.2} m");
            if step.is_nan() || step < extent + HAND {
                return impossible(
                    what,
                    format!("each of them is {extent:.1} m long; name a greater distance"),
                );
            }
            if step > length {
                return impossible(what, format!("there are only {length:.0} m; name a smaller distance"));
            }
            let whole = (length / step + 1e-9).floor();
            // A ring is closed, so that it is shared evenly by as many as come closest to the distance and have room.
            let nearest = (length / step).round().max(1.0);
            let has_room = length / nearest >= extent + HAND;
            let count = if track.is_ring && has_room { nearest } else { whole } as usize;
            if count > MOST {
                return impossible(
                    what,
                    format!("that would be {count} things; at most {MOST} stand in a row"),
                );
            }
            if track.is_ring {
                return Ok((0..count).map(|rank| rank as f64 / count as f64 * length).collect());
            }
            let rest = length - count as f64 * step;
            Ok((0..count).map(|rank| rest * 0.5 + (rank as f64 + 0.5) * step).collect())
        }
        Spacing::Count(count) => {
            if count == 0 || count as usize > MOST {
                let what = format!("a row of {count} things");
                return impossible(what, format!("name one to {MOST}"));
            }
            // A ring ends where it begins, and a line half a step before its end.
            let first = if track.is_ring { 0.0 } else { 0.5 };
            let share = |rank: u32| (f64::from(rank) + first) / f64::from(count);
            Ok((0..count).map(|rank| share(rank) * length).collect())
        }
    }
}

/// The ways along which a row may stand, the likeliest first; `None` if what it is along is not there.
pub(super) fn tracks<'a>(sampler: &'a Sampler<'a>, line: &'a Line) -> Option<Vec<Track<'a>>> {
    let solid = |id| sampler.scene.entity(id).map(|entity| Solid::of(&entity));
    match line {
        Line::Road { roads, .. } | Line::RoadSide { roads, .. } => {
            let streets = sampler.streets?;
            if roads.is_empty() || roads.iter().any(|road| road.index() >= streets.network().roads.len()) {
                return None;
            }
            let chains = chains(streets, roads);
            Some([false, true].map(|left| roadside(sampler, streets, chains.clone(), left)).into())
        }
        Line::Along { anchor } => Some(long_sides(sampler, solid(*anchor)?)),
        Line::Between { one, other } => Some(straight(sampler, solid(*one)?, solid(*other)?)),
        Line::Around { anchor } => Some(rings(sampler, solid(*anchor)?)),
    }
}

/// The pieces of a street in their order, each with whether it is followed backwards.
type Chain = Vec<(RoadId, bool)>;

/// Puts the pieces of a street one behind the other; what hangs on nothing comes behind.
fn chains(streets: &Streets, roads: &[RoadId]) -> Chain {
    let ends = |road: RoadId| (streets.road(road).from, streets.road(road).to);
    let mut left: Vec<RoadId> = roads.to_vec();
    left.sort_unstable();
    left.dedup();
    let mut chain = Chain::new();
    let mut at = None;
    while !left.is_empty() {
        let next = at.and_then(|at| left.iter().position(|road| ends(*road).0 == at || ends(*road).1 == at));
        let index = next.unwrap_or_else(|| {
            // An end of the street: a junction at which only one of the pieces ends.
            let touching =
                |place| left.iter().filter(|road| ends(**road).0 == place || ends(**road).1 == place).count();
            let is_end = |road: &RoadId| touching(ends(*road).0) == 1 || touching(ends(*road).1) == 1;
            left.iter().position(is_end).unwrap_or(0)
        });
        let road = left.remove(index);
        let (from, to) = ends(road);
        let backwards = match at.filter(|at| *at == from || *at == to) {
            Some(at) => at == to,
            None => {
                left.iter().any(|other| ends(*other).0 == from || ends(*other).1 == from)
                    && !left.iter().any(|other| ends(*other).0 == to || ends(*other).1 == to)
            }
        };
        at = Some(if backwards { from } else { to });
        chain.push((road, backwards));
    }
    chain
}

fn roadside<'a>(sampler: &'a Sampler<'a>, streets: &'a Streets, chain: Chain, left: bool) -> Track<'a> {
    let lengths: Vec<f64> =
        chain.iter().map(|(road, _)| polyline::length(&streets.road(*road).centerline)).collect();
    let length = lengths.iter().sum();
    let half = sampler.item.half;
    let parks = sampler.item.kind.is_vehicle();
    let spot = move |station: f64, off: f64| {
        let mut station = station;
        let index = lengths.iter().position(|length| {
            let here = station <= *length;
            station -= if here { 0.0 } else { *length };
            here
        })?;
        let (id, backwards) = chain[index];
        let road = streets.road(id);
        // The left of the street as it is followed is the right of a piece that is followed backwards.
        let (station, left) = if backwards { (lengths[index] - station, !left) } else { (station, left) };
        let kerb = if left { road.left_kerb } else { road.right_kerb };
        let offset = if parks { kerb - half.y - off * 0.3 } else { kerb + off + half.x };
        (station >= 0.0 && offset - kerb <= ROADSIDE)
            .then(|| sampler.on_edge(road, station, left, offset, 0.0))
    };
    Track { length, is_ring: false, offs: OFFS.to_vec(), spot: Box::new(spot) }
}

/// Both long sides; all four of a square.
fn long_sides<'a>(sampler: &'a Sampler<'a>, anchor: Solid) -> Vec<Track<'a>> {
    let half = anchor.half();
    let outwards: &[f64] = if half.x >= half.y { &[FRAC_PI_2, -FRAC_PI_2] } else { &[0.0, PI] };
    let side = |outward: &f64| {
        let out = direction(*outward);
        let along = direction(outward - FRAC_PI_2);
        let (deep, wide) = if half.x >= half.y { (half.y, half.x) } else { (half.x, half.y) };
        let yaw = sampler.yaw(anchor.yaw() + outward, &anchor);
        let own = if sampler.item.kind.is_vehicle() { sampler.item.half.y } else { sampler.item.half.x };
        let spot = move |station: f64, off: f64| {
            let local = out * (deep + off + own) + along * (station - wide);
            let at = anchor.world(Point2::from(local));
            (station.abs() <= wide * 2.0).then_some(Spot { at, base: anchor.base(), yaw, odd: 0.0 })
        };
        let offs = OFFS.iter().copied().filter(|off| off + own * 2.0 <= 4.0 + own).collect();
        Track {
            length: wide * 2.0,
            is_ring: false,
            offs,
            spot: Box::new(spot) as Box<dyn Fn(f64, f64) -> Option<Spot>>,
        }
    };
    outwards.iter().map(side).collect()
}

/// From edge to edge of two things, on the line between them or beside it.
fn straight<'a>(sampler: &'a Sampler<'a>, one: Solid, other: Solid) -> Vec<Track<'a>> {
    let along = other.planar() - one.planar();
    let length = along.norm().max(1e-6);
    let way = along / length;
    let beside = simworld_core::geometry::Vector2::new(-way.y, way.x);
    let yaw = if sampler.item.kind.is_vehicle() { heading(&way) } else { heading(&way) + FRAC_PI_2 };
    let room = (length / 3.0).max(2.0) * 0.95;
    let asides = (0..20).map(|rank| f64::from((rank + 1) / 2) * if rank % 2 == 1 { 0.5 } else { -0.5 });
    let track = |aside: f64| {
        // Beside the line the row begins and ends where the line does.
        let from = edge(&one, way).min(length * 0.45);
        let to = length - edge(&other, -way).min(length * 0.45);
        let spot = move |station: f64, _: f64| {
            let at = one.planar() + way * (from + station) + beside * aside;
            Some(Spot { at, base: one.base(), yaw, odd: 0.0 })
        };
        Track {
            length: to - from,
            is_ring: false,
            offs: vec![0.0],
            spot: Box::new(spot) as Box<dyn Fn(f64, f64) -> Option<Spot>>,
        }
    };
    asides.filter(|aside| aside.abs() <= room).map(track).collect()
}

/// From the middle of a thing to its edge in a direction, m.
fn edge(solid: &Solid, way: simworld_core::geometry::Vector2) -> f64 {
    solid.corners().into_iter().map(|corner| (corner - solid.planar()).dot(&way)).fold(0.0, f64::max)
}

/// Circles around a thing, the narrowest first.
fn rings<'a>(sampler: &'a Sampler<'a>, anchor: Solid) -> Vec<Track<'a>> {
    let least = anchor.half().norm() + sampler.item.half.norm();
    let ring = |(gap, turn): (f64, f64)| {
        let radius = least + gap;
        let spot = move |station: f64, _: f64| {
            let way = anchor.yaw() + turn + station / radius;
            let at = anchor.planar() + direction(way) * radius;
            Some(Spot { at, base: anchor.base(), yaw: sampler.yaw(way, &anchor), odd: 0.0 })
        };
        let spot: Box<dyn Fn(f64, f64) -> Option<Spot>> = Box::new(spot);
        Track { length: TAU * radius, is_ring: true, offs: vec![0.0], spot }
    };
    let gaps = [0.8, 1.2, 1.8, 2.5, 3.5, 5.0, 7.0, 10.0, 12.5, 15.0];
    gaps.into_iter().flat_map(|gap| [0.0, 0.13, 0.26].map(|turn| (gap, turn))).map(ring).collect()
}
