//! For tests: a car that waits at its line beside a stream.

use std::sync::Arc;

use simworld_core::geometry::Point2;
use simworld_core::id::LaneId;
use simworld_core::net::{Alone, NetworkConfig, RoadNetwork, StreetPlan, Turn};
use simworld_core::ops;
use simworld_core::seed::Seed;

use crate::vehicle::clock::Moment;
use crate::vehicle::manager::{Vehicle, VehicleManager};
use crate::vehicle::queues::path::Path;
use crate::vehicle::scene::Sight;
use crate::vehicle::tracks::Tracks;
use crate::{Counters, Leg, Route, TrafficConfig};

/// The step at which the stream has come to the crossing.
const BEGINS: u32 = 300;

/// What comes of a car that waits beside a stream.
pub(super) struct Wait {
    /// When it goes, s, if it does in 200 s.
    pub(super) goes: Option<f64>,
    pub(super) counters: Counters,
    /// The hardest braking of the stream by 20 s after that, m/s².
    pub(super) braking: f32,
}

/// A crossing without lights of two streets at an angle, where a car has stood at its line for so long, s, beside a stream of one in so many
/// tenths of a second, which has priority, or over which he has.
pub(super) fn waits(stood: f64, every: u32, angle: f64, is_owed: bool) -> Wait {
    let config = NetworkConfig { signals_from_roads: 0, ..NetworkConfig::default() };
    let network = RoadNetwork::derive(&crossing(angle), &config).expect("it is a plan");
    // Who has stood long can take no other way.
    let config = TrafficConfig { turns: [1.0, 0.0, 0.0], ..TrafficConfig::default() };
    let tracks = Tracks::new(Arc::new(network), &config);
    let mut vehicles = VehicleManager::new(&tracks);
    let is_straight = |way: usize| tracks.network.connections[way].turn == Turn::Straight;
    let mut pairs = (0..tracks.ways.len()).flat_map(|way| {
        tracks.conflicts[way].iter().map(move |other| (way, other.way as usize, other.yields))
    });
    let pair = pairs.find(|(own, other, yields)| *yields && is_straight(*own) && is_straight(*other));
    let (minor, major, _) = pair.expect("one street has priority");
    let (own, stream) = if is_owed { (major, minor) } else { (minor, major) };
    let put = |vehicles: &mut VehicleManager, way: usize, s: f64, v: f64, stood: f64| {
        let lane = tracks.ways[way].from;
        let legs = [lane, tracks.lane_after(way)].map(|lane| Leg::of(&tracks.network, LaneId(lane)));
        let route = vehicles.add_route(Route(legs.to_vec()));
        let id = vehicles.numbers() as u32;
        let car = Vehicle::new(config.vehicle_type(0), 0, 1.0, id, s);
        let car = Vehicle { v, stood, next: way as u32, ..car };
        vehicles.whereabouts.push(lane);
        vehicles.storage.add(lane, &car, &config);
        vehicles.push(&tracks, lane, car, Path::new(lane, route, 0.0, 0.0));
    };
    let before = tracks.ways[own].from;
    let line = tracks.length[before as usize] - 0.5;
    let zeros = vec![0; tracks.network.crossings.len()];
    let sight = Sight { aspects: &[], shown: &[], walkers: &zeros, waiting: &zeros, obstacles: &[] };
    let mut wait = Wait { goes: None, counters: Counters::default(), braking: 0.0 };
    for step in 0..BEGINS + 2000 {
        if step == BEGINS {
            put(&mut vehicles, own, line, 0.0, stood);
        }
        let lane = tracks.ways[stream].from;
        let has_room = vehicles.queue(&tracks, lane).last().is_none_or(|last| last.s > 25.0);
        if step % every == 0 && has_room {
            put(&mut vehicles, stream, 5.0, 8.0, 0.0);
        }
        let at = Moment { now: f64::from(step) * 0.1, dt: 0.1, step: u64::from(step) };
        vehicles.step(&tracks, &config, Seed(1).stream("cars"), sight, at, &mut wait.counters, &Alone);
        let comers = vehicles.queue(&tracks, lane).iter().map(|comer| -comer.acceleration);
        wait.braking = comers.fold(wait.braking, f32::max);
        let waited = at.now - f64::from(BEGINS) * 0.1;
        if step > BEGINS && vehicles.queue(&tracks, before).is_empty() {
            wait.goes = wait.goes.or(Some(waited));
        }
        // Who has priority comes down to his speed behind him.
        if wait.goes.is_some_and(|goes| waited > goes + 20.0) {
            break;
        }
    }
    wait
}

/// Two streets of one lane a direction that cross at an angle.
fn crossing(angle: f64) -> StreetPlan {
    let mut plan = StreetPlan::crossroads(150.0);
    let (sin, cos) = ops::sin_cos(angle);
    for (node, sign) in [(2, 1.0), (4, -1.0)] {
        plan.nodes[node] = Point2::new(sign * 150.0 * cos, sign * 150.0 * sin);
    }
    plan
}
