//! The pedestrian manager: walkers on sidewalks and crossings.
//!
//! A walker turns towards its next waypoint by at most its turning rate and walks where it looks (the paper's model). It
//! slows down behind others, passes oncoming ones on the right, waits at the kerb until it may walk, and never hurries back.

mod crowd;

use crowd::Crowd;
use serde::{Deserialize, Serialize};
use simworld_core::geometry::{Point2, Vector2, direction, heading};
use simworld_core::hash::StateHasher;
use simworld_core::id::{CrossingId, WaypointId};
use simworld_core::net::{Aspect, RoadNetwork, WaypointGraph};
use simworld_core::ops::wrap_angle;
use simworld_core::seed::Stream;

use crate::TrafficConfig;

/// Turning rate, rad/s.
const TURNING_RATE: f64 = 4.0;
/// A waypoint counts as reached within this distance, m.
const REACHED: f64 = 0.5;
/// Nobody crosses a road more slowly, m/s: signals leave time for 1.0.
const CROSSING_SPEED: f64 = 1.25;

/// A walker.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pedestrian {
    /// Where it stands, m.
    pub position: Point2,
    /// Where it looks, radians.
    pub heading: f64,
    /// How fast it walks now, m/s.
    pub speed: f64,
    /// The crossing it is on.
    pub crossing: Option<CrossingId>,
    /// The crossing at whose kerb it waits.
    pub waits_at: Option<CrossingId>,
    free_speed: f64,
    /// How far to the right of the middle it keeps, m.
    keep_right: f64,
    from: WaypointId,
    to: WaypointId,
    decisions: u64,
}

/// All walkers.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct PedestrianManager {
    pub(crate) walkers: Vec<Pedestrian>,
    /// People on each crossing; foreign ones are added by the traffic.
    pub(crate) on_crossing: Vec<u32>,
    /// People at each kerb who may walk as far as the signal says.
    pub(crate) waiting: Vec<u32>,
    #[serde(skip)]
    crowd: Crowd,
    #[serde(skip)]
    weights: Vec<f64>,
}

/// What walkers see of vehicles and signals.
pub(crate) struct Sight<'a> {
    pub(crate) network: &'a RoadNetwork,
    pub(crate) ways: &'a WaypointGraph,
    pub(crate) aspects: &'a [Aspect],
    /// Vehicles about to pass each crossing.
    pub(crate) claims: &'a [u32],
}

impl PedestrianManager {
    pub(crate) fn new(network: &RoadNetwork) -> Self {
        let crossings = network.crossings.len();
        Self { on_crossing: vec![0; crossings], waiting: vec![0; crossings], ..Self::default() }
    }

    /// Places walkers along walkways and returns how many found a place: none without walkways.
    pub(crate) fn spawn(&mut self, ways: &WaypointGraph, config: &TrafficConfig, streams: Stream) -> u32 {
        let mut rng = streams.named("places").rng();
        let walkways: Vec<(WaypointId, WaypointId)> = (0..ways.waypoints().len())
            .map(WaypointId::from_index)
            .flat_map(|from| ways.edges(from).iter().map(move |edge| (from, edge)))
            .filter(|(_, edge)| edge.crossing.is_none() && edge.length > 0.1)
            .map(|(from, edge)| (from, edge.to))
            .collect();
        for index in 0..config.pedestrians {
            let Some((from, to)) = rng.choose(&walkways).copied() else { return index };
            let (a, b) = (ways.waypoint(from).position, ways.waypoint(to).position);
            let speed = rng.normal_clamped(config.walking_speed, config.walking_deviation, 0.5, 2.5);
            self.walkers.push(Pedestrian {
                position: a + (b - a) * rng.unit(),
                heading: heading(&(b - a)),
                speed,
                crossing: None,
                waits_at: None,
                free_speed: speed,
                keep_right: rng.uniform(0.1, 0.8),
                from,
                to,
                decisions: 0,
            });
        }
        config.pedestrians
    }

    pub(crate) fn step(&mut self, sight: &Sight<'_>, config: &TrafficConfig, streams: Stream, dt: f64) {
        self.crowd.rebuild(self.walkers.iter().map(|walker| (walker.position, walker.heading)));
        self.on_crossing.fill(0);
        self.waiting.fill(0);
        let mut weights = std::mem::take(&mut self.weights);
        for (index, walker) in self.walkers.iter_mut().enumerate() {
            let stream = streams.indexed(index as u64);
            walker.decide(sight, config, stream, &mut weights);
            walker.walk(sight, &self.crowd, index, dt);
            if let Some(crossing) = walker.crossing {
                self.on_crossing[crossing.index()] += 1;
            }
            if let Some(crossing) = walker.waits_at.filter(|crossing| shows_walk(sight, *crossing)) {
                self.waiting[crossing.index()] += 1;
            }
        }
        self.weights = weights;
    }

    /// Whether a saved state is one of this network.
    pub(crate) fn fits(&self, ways: &WaypointGraph, crossings: usize) -> bool {
        let count = ways.waypoints().len();
        let is_crossing = |id: Option<CrossingId>| id.is_none_or(|id| id.index() < crossings);
        self.on_crossing.len() == crossings
            && self.waiting.len() == crossings
            && self.walkers.iter().all(|w| {
                w.from.index().max(w.to.index()) < count && is_crossing(w.crossing) && is_crossing(w.waits_at)
            })
    }

    pub(crate) fn state_hash(&self, hasher: &mut StateHasher) {
        for walker in &self.walkers {
            hasher.f64(walker.position.x).f64(walker.position.y).f64(walker.heading).f64(walker.speed);
            hasher.u64(u64::from(walker.from.0)).u64(u64::from(walker.to.0)).u64(walker.decisions);
        }
    }
}

/// Whether the signal, if there is one, lets people begin to cross.
fn shows_walk(sight: &Sight<'_>, crossing: CrossingId) -> bool {
    match sight.network.crossings[crossing.index()].signal {
        Some(group) => sight.aspects[group.index()] == Aspect::Green,
        None => true,
    }
}

impl Pedestrian {
    /// At a waypoint: where to go on, and whether one may.
    fn decide(&mut self, sight: &Sight<'_>, config: &TrafficConfig, stream: Stream, weights: &mut Vec<f64>) {
        let reached = (self.target(sight.ways) - self.position).norm() < REACHED;
        if !reached && self.waits_at.is_none() {
            return;
        }
        if self.waits_at.is_none() {
            self.crossing = None;
            let here = self.to;
            self.decisions += 1;
            let edges = sight.ways.edges(here);
            weights.clear();
            weights.extend(edges.iter().map(|edge| match edge.crossing {
                // One turns back only where there is no other way.
                _ if edge.to == self.from && edges.len() > 1 => 0.0,
                Some(_) => config.crossing_weight,
                None => 1.0,
            }));
            let mut rng = stream.indexed(self.decisions).rng();
            let choice = rng.weighted(weights).unwrap_or(0);
            let Some(edge) = edges.get(choice) else { return };
            self.from = here;
            self.to = edge.to;
            self.waits_at = edge.crossing;
        }
        if let Some(crossing) = self.waits_at
            && shows_walk(sight, crossing)
            && sight.claims[crossing.index()] == 0
        {
            self.waits_at = None;
            self.crossing = Some(crossing);
        }
    }

    fn walk(&mut self, sight: &Sight<'_>, crowd: &Crowd, index: usize, dt: f64) {
        if self.waits_at.is_some() {
            self.speed = 0.0;
            return;
        }
        let around = crowd.ahead_of(index, self.position, self.heading);
        let wanted =
            heading(&(self.target(sight.ways) - self.position)) - if around.oncoming { 0.35 } else { 0.0 };
        let error = wrap_angle(wanted - self.heading);
        self.heading = wrap_angle(self.heading + error.clamp(-TURNING_RATE * dt, TURNING_RATE * dt));
        let free = if self.crossing.is_some() {
            self.free_speed.max(CROSSING_SPEED)
        } else {
            self.free_speed * around.freedom
        };
        // Walking where one looks, more slowly while turning, so that nobody circles round a waypoint.
        let facing = 1.0 - (error.abs() / std::f64::consts::PI).min(1.0);
        self.speed = free * (facing * facing).max(0.05);
        self.position += direction(self.heading) * (self.speed * dt);
    }

    /// The next waypoint, a little to the right of it.
    fn target(&self, ways: &WaypointGraph) -> Point2 {
        let (from, to) = (ways.waypoint(self.from).position, ways.waypoint(self.to).position);
        let along = (to - from).try_normalize(1e-9).unwrap_or_else(Vector2::x);
        to + Vector2::new(along.y, -along.x) * self.keep_right
    }
}
