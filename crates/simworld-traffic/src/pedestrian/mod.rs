//! The pedestrian manager: walkers on sidewalks and crossings.
//!
//! A walker heads for its next waypoint, within the width of the walkway, and finds its way among the others as a
//! [`crowd`](crate::crowd) does. It waits at the kerb until it may walk, and never hurries back.

mod place;

use serde::{Deserialize, Serialize};
use simworld_core::geometry::{Point2, Vector2, heading};
use simworld_core::hash::StateHasher;
use simworld_core::id::{CrossingId, WaypointId};
use simworld_core::net::{Aspect, RoadNetwork, WaypointGraph};
use simworld_core::seed::Stream;

use crate::TrafficConfig;
use crate::crowd::{Crowd, Person, Wall, Wish};

/// A waypoint counts as reached within this distance, or beside it, m.
const REACHED: f64 = 0.5;
/// Room that one keeps to the edge of a walkway where there is so much, m.
const MARGIN: f64 = 0.3;
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
    /// Where it walks, of length one: the heading as a vector.
    direction: Vector2,
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
    people: Vec<Person>,
    #[serde(skip)]
    wishes: Vec<Wish>,
    #[serde(skip)]
    walkways: Vec<Walkway>,
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

    pub(crate) fn step(&mut self, sight: &Sight<'_>, config: &TrafficConfig, streams: Stream, dt: f64) {
        let mut weights = std::mem::take(&mut self.weights);
        self.people.clear();
        self.wishes.clear();
        self.walkways.clear();
        for (index, walker) in self.walkers.iter_mut().enumerate() {
            let mut walkway = walker.walkway(sight.ways);
            if walker.waits_at.is_some() || walkway.is_walked(walker.position) {
                walker.decide(sight, config, streams.indexed(index as u64), &mut weights);
                walkway = walker.walkway(sight.ways);
            }
            self.people.push(walker.person());
            self.wishes.push(walker.wish(&walkway));
            self.walkways.push(walkway);
        }
        self.weights = weights;
        let walkways = &self.walkways;
        let edges = |index: usize, at: Point2, walls: &mut Vec<Wall>| walkways[index].edges(at, walls);
        self.crowd.step(&config.walking, &mut self.people, &self.wishes, &[], &edges, dt);
        self.on_crossing.fill(0);
        self.waiting.fill(0);
        for (walker, person) in self.walkers.iter_mut().zip(&self.people) {
            walker.take_up(person);
            if let Some(crossing) = walker.crossing {
                self.on_crossing[crossing.index()] += 1;
            }
            if let Some(crossing) = walker.waits_at.filter(|crossing| shows_walk(sight, *crossing)) {
                self.waiting[crossing.index()] += 1;
            }
        }
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

    fn person(&self) -> Person {
        Person { position: self.position, direction: self.direction, speed: self.speed }
    }

    fn wish(&self, walkway: &Walkway) -> Wish {
        let direction = (walkway.target - self.position).try_normalize(1e-9).unwrap_or(self.direction);
        let speed = match (self.waits_at, self.crossing) {
            (Some(_), _) => 0.0,
            (None, Some(_)) => self.free_speed.max(CROSSING_SPEED),
            (None, None) => self.free_speed,
        };
        Wish { direction, speed }
    }

    fn take_up(&mut self, person: &Person) {
        if person.direction != self.direction {
            self.heading = heading(&person.direction);
        }
        (self.position, self.direction, self.speed) = (person.position, person.direction, person.speed);
    }

    fn walkway(&self, ways: &WaypointGraph) -> Walkway {
        let (from, to) = (ways.waypoint(self.from).position, ways.waypoint(self.to).position);
        let half = ways.edge(self.from, self.to).map_or(0.0, |edge| f64::from(edge.width) * 0.5);
        let along = (to - from).try_normalize(1e-9).unwrap_or_else(Vector2::x);
        let right = self.keep_right.min((half - MARGIN).max(0.0));
        Walkway { from, along, half, target: to + Vector2::new(along.y, -along.x) * right }
    }
}

/// The way from one waypoint to the next, for one walker.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Walkway {
    from: Point2,
    along: Vector2,
    /// Half the width, m.
    half: f64,
    /// The next waypoint, a little to the right of it.
    target: Point2,
}

impl Walkway {
    /// Whether its end is reached, or where one would wait beside others who stand there.
    fn is_walked(&self, at: Point2) -> bool {
        let offset = self.target - at;
        let aside = self.along.perp(&offset).abs();
        let beside = self.along.dot(&offset) < REACHED && aside < self.half.max(REACHED);
        beside || offset.norm_squared() < REACHED * REACHED
    }

    /// Its edges, which one does not cross outwards.
    fn edges(&self, at: Point2, walls: &mut Vec<Wall>) {
        let left = Vector2::new(-self.along.y, self.along.x);
        let aside = left.dot(&(at - self.from));
        walls.push(Wall { toward: left, distance: self.half - aside });
        walls.push(Wall { toward: -left, distance: self.half + aside });
    }
}
