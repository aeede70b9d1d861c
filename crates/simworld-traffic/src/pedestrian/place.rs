//! Where walkers begin.

use std::collections::BTreeMap;

use simworld_core::geometry::{Point2, Vector2, heading};
use simworld_core::id::WaypointId;
use simworld_core::net::WaypointGraph;
use simworld_core::seed::{Stream, StreamRng};

use super::{MARGIN, Pedestrian, PedestrianManager};
use crate::TrafficConfig;

/// So many places are tried for each walker.
const TRIES: u32 = 50;

/// A walkway on which one may begin: from, to, and half its width, m.
type Walkway = (WaypointId, WaypointId, f64);

impl PedestrianManager {
    /// Places walkers along walkways, apart from one another, and returns how many found a place: none without walkways.
    pub(crate) fn spawn(&mut self, ways: &WaypointGraph, config: &TrafficConfig, streams: Stream) -> u32 {
        let mut rng = streams.named("places").rng();
        let walkways: Vec<Walkway> = (0..ways.waypoints().len())
            .map(WaypointId::from_index)
            .flat_map(|from| ways.edges(from).iter().map(move |edge| (from, edge)))
            .filter(|(_, edge)| edge.crossing.is_none() && edge.length > 0.1)
            .map(|(from, edge)| (from, edge.to, f64::from(edge.width) * 0.5))
            .collect();
        let mut taken = Taken::new(2.0 * config.walking.radius);
        for index in 0..config.pedestrians {
            let free_speed = rng.normal_clamped(config.walking_speed, config.walking_deviation, 0.5, 2.5);
            let keep_right = rng.uniform(0.1, 0.8);
            let mut tries = (0..TRIES).filter_map(|_| draw(ways, &walkways, keep_right, &mut rng));
            let Some((position, direction, from, to)) = tries.find(|place| taken.take(place.0)) else {
                return index;
            };
            self.walkers.push(Pedestrian {
                position,
                heading: heading(&direction),
                speed: free_speed,
                crossing: None,
                waits_at: None,
                direction,
                free_speed,
                keep_right,
                from,
                to,
                decisions: 0,
            });
        }
        config.pedestrians
    }
}

/// A place on some walkway, and the way on from it.
fn draw(
    ways: &WaypointGraph,
    walkways: &[Walkway],
    keep_right: f64,
    rng: &mut StreamRng,
) -> Option<(Point2, Vector2, WaypointId, WaypointId)> {
    let (from, to, half) = rng.choose(walkways).copied()?;
    let (a, b) = (ways.waypoint(from).position, ways.waypoint(to).position);
    let along = (b - a).try_normalize(1e-9)?;
    let right = Vector2::new(along.y, -along.x) * keep_right.min((half - MARGIN).max(0.0));
    Some((a + (b - a) * rng.unit() + right, along, from, to))
}

/// The places that are taken, by cells so small that each holds one.
struct Taken {
    apart: f64,
    cell: f64,
    places: BTreeMap<(i64, i64), Point2>,
}

impl Taken {
    fn new(apart: f64) -> Self {
        Self { apart, cell: apart * std::f64::consts::FRAC_1_SQRT_2, places: BTreeMap::new() }
    }

    /// Takes a place; false if somebody is too near.
    fn take(&mut self, place: Point2) -> bool {
        let (column, row) = ((place.x / self.cell).floor() as i64, (place.y / self.cell).floor() as i64);
        let near = (column - 2..=column + 2)
            .flat_map(|column| self.places.range((column, row - 2)..=(column, row + 2)))
            .any(|(_, other)| (other - place).norm() <= self.apart);
        !near && self.places.insert((column, row), place).is_none()
    }
}
