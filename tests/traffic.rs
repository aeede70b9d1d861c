//! What the soaks of the traffic share: cities, who has touched whom, and which cases a machine runs.

use std::path::PathBuf;
use std::sync::Arc;

use rayon::prelude::*;
use simworld_citygen::osm::{Place, PlaceOptions};
use simworld_citygen::{City, CityConfig, Style};
use simworld_core::geometry::Obb;
use simworld_core::id::{LaneId, RoadId};
use simworld_core::net::{LaneDirection, RoadNetwork};
use simworld_core::seed::Seed;
use simworld_traffic::{Body, Leg, Route, Router, Traffic};

/// Whether soaks run whole: `SIMWORLD_SOAK=1`.
pub fn is_whole() -> bool {
    std::env::var_os("SIMWORLD_SOAK").is_some()
}

/// Runs cases in parallel, those of this shard alone: `SIMWORLD_SOAK_SHARD=3/16` is the fourth of sixteen. Returns what they
/// say, in order.
pub fn each_case<T: Send>(cases: usize, run: impl Fn(usize) -> T + Sync + Send) -> Vec<T> {
    let shard = std::env::var("SIMWORLD_SOAK_SHARD").unwrap_or_else(|_| "0/1".to_owned());
    let parts = shard.split_once('/').and_then(|(own, of)| Some((own.parse().ok()?, of.parse().ok()?)));
    let (own, of): (usize, usize) = parts.expect("SIMWORLD_SOAK_SHARD is written as 3/16");
    assert!(own < of, "SIMWORLD_SOAK_SHARD: shards are counted from 0");
    (own..cases).into_par_iter().step_by(of).with_max_len(1).map(run).collect()
}

/// A city by its number: all styles in turn, each from a seed of its own.
pub fn grown(number: usize, segments: u32) -> Arc<RoadNetwork> {
    let style = Style::ALL[number % Style::ALL.len()];
    let config = CityConfig { roads: style.roads(segments), ..CityConfig::default() };
    City::generate(&config, Seed(1 + number as u64)).expect("any seed grows a city").network
}

/// The streets of a real place, from the folder that `SIMWORLD_DATA` names; says so where they are not there.
pub fn real(file: &str) -> Option<Arc<RoadNetwork>> {
    let path = std::env::var_os("SIMWORLD_DATA").map(|folder| PathBuf::from(folder).join(file));
    let Some(path) = path.filter(|path| path.exists()) else {
        println!("skipped: {file} is not at hand; set SIMWORLD_DATA to the folder of the extracts");
        return None;
    };
    let place = Place::read(&path).expect("a real extract is read");
    let city = City::from_place(&place, &PlaceOptions::default(), &CityConfig::default(), Seed(1));
    Some(city.expect("a real extract makes a city").0.network)
}

/// Length of all lanes on which motor vehicles drive, km.
pub fn lane_kilometres(network: &RoadNetwork) -> f64 {
    network.lanes.iter().filter(|lane| lane.is_driven()).map(|lane| lane.length / 1000.0).sum()
}

/// Quickest routes between legs on which vehicles can begin and end.
pub struct Trips {
    router: Router,
    legs: Vec<Leg>,
}

impl Trips {
    /// Between all legs of a network that are long enough for any vehicle.
    pub fn new(network: &RoadNetwork) -> Self {
        let is_end = |leg: &Leg| {
            let lanes = leg.lanes(network).iter().map(|lane: &LaneId| &network.lanes[lane.index()]);
            lanes.clone().count() > 0 && lanes.into_iter().all(|lane| lane.length > 25.0)
        };
        let directions = [LaneDirection::Forward, LaneDirection::Backward];
        let legs = (0..network.roads.len() as u32)
            .flat_map(|road| directions.map(|direction| Leg::new(RoadId(road), direction)));
        Self { router: Router::new(network), legs: legs.filter(is_end).collect() }
    }

    /// The route of a number: the same number has the same route.
    pub fn route(&self, number: u64) -> Route {
        let mut rng = Seed(7).stream("soak/trips").indexed(number).rng();
        loop {
            let ends = [0; 2].map(|_| self.legs[rng.below(self.legs.len())]);
            if ends[0] != ends[1]
                && let Some(route) = self.router.quickest(ends[0], ends[1])
            {
                return route;
            }
        }
    }
}

/// Pairs of vehicles that touch, on the same level.
pub fn touching(traffic: &Traffic, bodies: &mut Vec<Body>) -> Vec<(u32, u32)> {
    let network = traffic.network();
    bodies.clear();
    bodies.extend(traffic.vehicles());
    let lanes = network.lanes.len();
    let mut levels = vec![0; bodies.iter().map(|body| body.id as usize + 1).max().unwrap_or(0)];
    for (id, track, _, _) in traffic.stations() {
        let track = track as usize;
        let lane = if track < lanes { track } else { network.connections[track - lanes].to.index() };
        levels[id as usize] = network.roads[network.lanes[lane].road.index()].level;
    }
    bodies.sort_by(|a, b| a.pose.translation.x.total_cmp(&b.pose.translation.x));
    let solids: Vec<Obb> = bodies.iter().map(|body| body.shape.obb(&body.pose)).collect();
    let mut pairs = Vec::new();
    for (index, a) in bodies.iter().enumerate() {
        let x = a.pose.translation.x;
        let ahead =
            (index + 1..bodies.len()).take_while(|other| bodies[*other].pose.translation.x - x < 19.0);
        for other in ahead {
            let b = &bodies[other];
            let near = (b.pose.translation.y - a.pose.translation.y).abs() < 19.0;
            if near
                && levels[a.id as usize] == levels[b.id as usize]
                && solids[index].footprints_overlap(&solids[other])
            {
                pairs.push((a.id, b.id));
            }
        }
    }
    pairs
}
