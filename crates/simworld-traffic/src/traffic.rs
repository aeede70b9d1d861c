//! The traffic of a network: three managers on a fixed step (the paper's Algorithm 2).

mod bodies;
mod counters;
mod foreign;
mod gap;
mod incidents;
mod interest;
mod kerbs;
mod outline;
mod reroute;
mod signals;
mod takeover;
mod takeover_walkers;
mod walkers;

use std::sync::Arc;

pub use bodies::Body;
pub use counters::Counters;
use foreign::Finder;
pub use foreign::Foreign;
pub(crate) use foreign::Obstructs;
use gap::Gaps;
pub use interest::Interest;
use serde::{Deserialize, Serialize};
use simworld_core::geometry::Point2;
use simworld_core::hash::{StateHash, StateHasher};
use simworld_core::net::{Alone, Aspect, RoadNetwork, SignalPlan, WaypointConfig, WaypointGraph, Workers};
use simworld_core::seed::{Seed, Stream};

use crate::crowd::Person;
use crate::demand::{DemandManager, Flow, Kerbs, OF_FLOW, Trip, TripEnd, VehicleChoice};
use crate::pedestrian::{self, Pedestrian, PedestrianManager, Plazas};
use crate::signal::{ByHand, Controllers, Detectors, IntersectionManager, Stage, StageShown};
use crate::vehicle::{self, Tracks, VehicleKind, VehicleManager};
use crate::{DrivingConditions, Route, Stop, TrafficConfig, TrafficError};

/// How many found a place at the start, of those asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Placed {
    /// Vehicles.
    pub vehicles: u32,
    /// Pedestrians.
    pub pedestrians: u32,
}

/// The traffic of a network.
///
/// ```
/// use std::sync::Arc;
/// use simworld_core::net::{NetworkConfig, RoadNetwork, StreetPlan};
/// use simworld_core::seed::Seed;
/// use simworld_traffic::{Traffic, TrafficConfig};
/// let network = RoadNetwork::derive(&StreetPlan::grid(3, 3, 120.0), &NetworkConfig::default())?;
/// let mut traffic = Traffic::new(Arc::new(network), &TrafficConfig::default(), Seed(1))?;
/// for _ in 0..600 { traffic.step(0.1); }
/// assert!(traffic.counters().crossings > 20);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Traffic {
    config: TrafficConfig,
    /// The settings as the conditions of now make them.
    driving: TrafficConfig,
    streams: Stream,
    tracks: Tracks,
    ways: WaypointGraph,
    plazas: Plazas,
    finder: Finder,
    signals: IntersectionManager,
    /// The plans as they were given, before anybody timed them anew by an order.
    plans: Vec<SignalPlan>,
    state: State,
    placed: Placed,
    // Buffers kept from step to step.
    walkers: Vec<u32>,
    obstacles: Vec<vehicle::Obstacle>,
    /// Bodies that are on no track.
    gathered: Vec<Foreign>,
    /// Who does the work.
    workers: Box<dyn Workers + Send + Sync>,
    gaps: Gaps,
    /// Bodies of others as people, those first that always stand.
    bodies: Vec<Person>,
    standing_bodies: usize,
    threats: Vec<f64>,
}

/// Everything that changes, for snapshots.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct State {
    vehicles: VehicleManager,
    demand: DemandManager,
    pedestrians: PedestrianManager,
    controllers: Controllers,
    by_hand: ByHand,
    detectors: Detectors,
    aspects: Vec<Aspect>,
    /// How long each group has shown its aspect, s.
    shown: Vec<f64>,
    /// What is of interest; everything if nobody says.
    interest: Option<Vec<Interest>>,
    seconds: f64,
    steps: u64,
    counters: Counters,
    conditions: DrivingConditions,
}

impl State {
    /// How many numbers vehicles have.
    pub(crate) fn numbers(&self) -> usize {
        self.vehicles.numbers()
    }

    /// How many numbers walkers have.
    pub(crate) fn walkers(&self) -> usize {
        self.pedestrians.walkers.len()
    }
}

impl Traffic {
    /// Places vehicles and pedestrians; [`placed`](Self::placed) says how many found room.
    ///
    /// # Errors
    /// A setting out of range, or a network that does not hold together.
    pub fn new(network: Arc<RoadNetwork>, config: &TrafficConfig, seed: Seed) -> Result<Self, TrafficError> {
        config.validate()?;
        network.check()?;
        let streams = seed.stream("traffic");
        let (crossings, groups) = (network.crossings.len(), network.signal_groups());
        let ways = WaypointGraph::walkable(&network, &WaypointConfig { step: 25.0, offset: 0.0 })?;
        let plazas = Plazas::new(&network, &ways);
        let mut pedestrians = PedestrianManager::new(&network);
        let tracks = Tracks::new(network, config);
        let signals = IntersectionManager::new(&tracks.network);
        let mut vehicles = VehicleManager::new(&tracks);
        let placed = Placed {
            vehicles: vehicles.spawn(&tracks, config, streams.named("vehicles")),
            pedestrians: pedestrians.spawn(&ways, config, streams.named("pedestrians")),
        };
        let mut traffic = Self {
            config: config.clone(),
            driving: config.conditions.applied(config),
            streams,
            gaps: Gaps::new(&tracks),
            bodies: Vec::new(),
            standing_bodies: 0,
            threats: Vec::new(),
            finder: Finder::new(&tracks),
            walkers: vec![0; crossings],
            plans: signals.plans().to_vec(),
            signals,
            tracks,
            ways,
            plazas,
            state: State { vehicles, pedestrians, conditions: config.conditions, ..State::default() },
            placed,
            obstacles: Vec::new(),
            gathered: Vec::new(),
            workers: Box::new(Alone),
        };
        traffic.state.detectors = Detectors::new(groups);
        traffic.restart_signals();
        Ok(traffic)
    }

    /// Gives the work of each step to threads. However many they are, the result is the same to the bit; without this one
    /// thread does it all.
    pub fn set_workers(&mut self, workers: Box<dyn Workers + Send + Sync>) {
        self.workers = workers;
    }

    /// Adds vehicles that keep coming.
    ///
    /// # Errors
    /// A route that cannot be driven, a setting out of range, or a kind of which the configuration has no type.
    pub fn add_flow(&mut self, flow: Flow) -> Result<(), TrafficError> {
        if let Some(kind) = flow.kind {
            self.driving.has_type(kind)?;
        }
        let State { vehicles, demand, .. } = &mut self.state;
        demand.add_flow(flow, &self.tracks, vehicles, self.streams)
    }

    /// Sets road and weather; everybody drives as they allow from the next step on.
    ///
    /// # Errors
    /// A condition out of range.
    pub fn set_conditions(&mut self, conditions: DrivingConditions) -> Result<(), TrafficError> {
        conditions.validate()?;
        if conditions != self.driving.conditions {
            self.driving = conditions.applied(&self.config);
            self.state.conditions = conditions;
        }
        Ok(())
    }

    /// Road and weather.
    pub fn conditions(&self) -> DrivingConditions {
        self.driving.conditions
    }

    /// Sends a vehicle of a kind on a route; it enters when there is room at the beginning of the first leg. Returns how many
    /// were sent before, by which [`admitted`](Self::admitted) tells when it enters.
    ///
    /// # Errors
    /// A route that cannot be driven, or a kind of which the configuration has no type.
    pub fn insert(&mut self, route: Route, kind: VehicleKind) -> Result<u64, TrafficError> {
        self.insert_scheduled(route, kind.into(), self.state.seconds)
    }

    /// The same for a vehicle of a kind or type that was to depart at another time than now, s after the start: its trip tells
    /// how long it waited since.
    ///
    /// # Errors
    /// A route that cannot be driven, a kind or type that the configuration has not, or a time that is not finite.
    pub fn insert_scheduled(
        &mut self,
        route: Route,
        vehicle: VehicleChoice,
        scheduled: f64,
    ) -> Result<u64, TrafficError> {
        self.insert_between(route, vehicle, scheduled, Kerbs::default())
    }

    /// The same for a vehicle that makes stops on its way.
    ///
    /// # Errors
    /// Those of [`insert_scheduled`](Self::insert_scheduled), and a stop that it cannot make.
    pub fn insert_stopping(
        &mut self,
        route: Route,
        vehicle: VehicleChoice,
        scheduled: f64,
        stops: Vec<Stop>,
    ) -> Result<u64, TrafficError> {
        let route = route.outside(&self.tracks);
        route.validate(&self.tracks.network)?;
        crate::line::validate(&stops, &route, &self.tracks.network)?;
        let number = self.insert_scheduled(route, vehicle, scheduled)?;
        self.state.demand.stop_at(number, stops);
        Ok(number)
    }

    /// Takes a vehicle out, wherever it is; false if there is none of that number.
    pub fn remove(&mut self, id: u32) -> bool {
        let State { vehicles, counters, seconds, .. } = &mut self.state;
        let removed = vehicles.remove(&self.tracks, &self.driving, id, TripEnd::Removed, *seconds);
        counters.removed += u64::from(removed);
        removed
    }

    /// Vehicles that wait outside because there is no room.
    pub fn outside(&self) -> usize {
        self.state.demand.outside()
    }

    /// The vehicles that entered in the last step.
    pub fn entered(&self) -> &[u32] {
        &self.state.vehicles.entered
    }

    /// Of those who [entered](Self::entered) in the last step the numbers that [`insert`](Self::insert) gave them; `None` for
    /// those of flows.
    pub fn admitted(&self) -> impl Iterator<Item = (u32, Option<u64>)> + '_ {
        let numbers = self.state.demand.admitted.iter().map(|number| (*number != OF_FLOW).then_some(*number));
        self.state.vehicles.entered.iter().copied().zip(numbers)
    }

    /// The trips that ended in the last step, and since then by [`remove`](Self::remove).
    pub fn ended(&self) -> &[Trip] {
        &self.state.vehicles.ended
    }

    /// Time since the start, s.
    pub fn seconds(&self) -> f64 {
        self.state.seconds
    }

    /// The plans of the signals.
    pub fn plans(&self) -> &[SignalPlan] {
        self.signals.plans()
    }

    /// The stages of a plan; none of one that does not exist or has no green.
    pub fn stages(&self, plan: usize) -> &[Stage] {
        self.signals.stages(plan)
    }

    /// The stage that the signals of a plan are in; `None` if it has none.
    pub fn stage(&self, plan: usize) -> Option<StageShown> {
        let controller = self.state.controllers.get(plan)?;
        (!self.stages(plan).is_empty()).then(|| controller.shown())
    }

    /// One step of `dt` s; one that is not positive and finite is none, and changes nothing.
    pub fn step(&mut self, dt: f64) {
        self.step_among(&[], dt);
    }

    /// One step of `dt` s among bodies that are not the traffic's own: drivers stop for them, walkers go round them, and
    /// nobody steps on to a crossing before one that will not stop. Bodies that are nowhere, or not of this world's size, are not
    /// seen.
    pub fn step_among(&mut self, foreign: &[Foreign], dt: f64) {
        if !(dt > 0.0 && dt.is_finite()) {
            return;
        }
        let bodies = self.gather(foreign);
        self.finder.find(&self.tracks, &self.gathered, &mut self.walkers, &mut self.obstacles);
        for (count, own) in self.walkers.iter_mut().zip(&self.state.pedestrians.on_crossing) {
            *count += own;
        }
        self.update_vehicles(dt);
        self.update_pedestrians(bodies, dt);
        self.state.steps += 1;
        // Counted, not accumulated, so that long runs keep their phase.
        self.state.seconds = self.state.steps as f64 * dt;
        self.update_signals(dt);
    }

    /// Where a thing whose upper side is so high at a place, m, reaches into what vehicles sweep.
    pub(crate) fn obstructs(&self, body: &Foreign, top: &dyn Fn(Point2) -> f64) -> Obstructs {
        if body.is_sound() { self.finder.obstructs(&self.tracks, body, top) } else { Obstructs::Nothing }
    }

    /// Whether a body stands where everybody drives, and not beside a lane.
    pub(crate) fn is_on_a_track(&self, body: &Foreign) -> bool {
        body.is_sound() && self.finder.is_on_a_track(&self.tracks, body)
    }

    fn update_vehicles(&mut self, dt: f64) {
        let State { vehicles, demand, pedestrians, counters, shown, seconds, steps, .. } = &mut self.state;
        vehicles.entered.clear();
        vehicles.ended.clear();
        let streams = self.streams.named("vehicles");
        vehicles.mind_closures(&self.tracks, &self.driving, streams, *seconds, counters);
        demand.step(vehicles, &self.tracks, &self.driving, self.streams, *seconds, counters);
        let at = vehicle::Moment { now: *seconds, dt, step: *steps };
        vehicles.pass_obstacles(&self.tracks, &self.driving, &mut self.obstacles, at, counters);
        let sight = vehicle::Sight {
            aspects: &self.signals.aspects,
            shown,
            walkers: &self.walkers,
            waiting: &pedestrians.waiting,
            obstacles: &self.obstacles,
        };
        vehicles.step(&self.tracks, &self.driving, streams, sight, at, counters, &*self.workers);
    }

    /// Walkers among so many of the gathered bodies.
    fn update_pedestrians(&mut self, bodies: usize, dt: f64) {
        let foreign = &self.gathered[..bodies];
        outline::threats(&self.tracks.network, &self.finder, foreign, &mut self.threats);
        self.bodies.truncate(self.standing_bodies);
        for body in foreign {
            outline::outline(body, self.config.walking.radius, &self.ways, &mut self.bodies);
        }
        let State { vehicles, pedestrians, counters, steps, seconds, interest, .. } = &mut self.state;
        pedestrians.entered.clear();
        pedestrians.ended.clear();
        let (aspects, tracks, vehicles) = (&self.signals.aspects, &self.tracks, &*vehicles);
        let sight = pedestrian::Sight {
            network: &tracks.network,
            ways: &self.ways,
            plazas: &self.plazas,
            aspects,
            claims: &|crossing| vehicles.claims(crossing),
            gap: &|crossing| self.gaps.time(tracks, vehicles, aspects, crossing),
            threats: &self.threats,
        };
        let around = pedestrian::Surroundings {
            workers: &*self.workers,
            config: &self.driving,
            bodies: &self.bodies,
            interest: interest.as_deref(),
        };
        let time = pedestrian::Time { steps: *steps, seconds: *seconds, dt };
        pedestrians.step(&sight, &around, self.streams.named("pedestrians"), time, counters);
    }

    /// The settings it was made with.
    pub fn config(&self) -> &TrafficConfig {
        &self.config
    }

    /// How many found a place at the start.
    pub fn placed(&self) -> Placed {
        self.placed
    }

    /// What was counted since the start.
    pub fn counters(&self) -> Counters {
        self.state.counters
    }

    /// What every signal group shows.
    pub fn signals(&self) -> &[Aspect] {
        &self.signals.aspects
    }

    /// The network on which one drives: the one that it was made with, or, where junctions are
    /// [near one another](crate::TrafficConfig::join_nearer), one in which they are joined. Tracks are numbered by this one; only
    /// connections and signal plans have other numbers than in the one that was given.
    pub fn network(&self) -> &Arc<RoadNetwork> {
        &self.tracks.network
    }

    /// Memory that the vehicles take with all that is kept for their steps, bytes; the network and the routes are not theirs.
    pub fn vehicle_bytes(&self) -> usize {
        self.state.vehicles.bytes()
    }

    /// Memory that the walkers take with all that is kept for their steps, bytes; the network is not theirs.
    pub fn walker_bytes(&self) -> usize {
        self.state.pedestrians.bytes()
    }

    /// The walkers, by number; some may have [left](Pedestrian::is_present).
    pub fn pedestrians(&self) -> &[Pedestrian] {
        &self.state.pedestrians.walkers
    }

    pub(crate) fn state(&self) -> &State {
        &self.state
    }

    /// Takes up a saved state; false if it is not that of this network and configuration.
    pub(crate) fn set_state(&mut self, state: State) -> bool {
        let types = self.driving.types.len();
        let vehicles = state.vehicles.fits(&self.tracks, types);
        let people = state.pedestrians.walkers.len();
        let fits = vehicles
            && state.demand.fits(&self.tracks, state.vehicles.route_count(), types)
            && state.conditions.validate().is_ok()
            && people >= self.placed.pedestrians as usize
            && state.aspects.len() == self.signals.aspects.len()
            && state.shown.len() == state.aspects.len()
            && state.interest.iter().flatten().all(Interest::is_sound)
            && state.detectors.fits(state.aspects.len())
            && self.signals.fits(&state.controllers)
            && state.by_hand.fits(&|plan| self.stages(plan).len())
            && state.pedestrians.fits(&self.ways, self.walkers.len());
        if fits {
            self.signals.aspects.clone_from(&state.aspects);
            self.driving = state.conditions.applied(&self.config);
            self.state = state;
            self.retime();
            self.mark_far();
        }
        fits
    }
}

impl StateHash for Traffic {
    fn state_hash(&self, hasher: &mut StateHasher) {
        hasher.u64(self.state.steps);
        self.state.vehicles.state_hash(&self.tracks, hasher);
        self.state.pedestrians.state_hash(hasher);
        for aspect in &self.state.aspects {
            hasher.u64(*aspect as u64);
        }
        for controller in &self.state.controllers {
            controller.state_hash(hasher);
        }
        self.state.by_hand.state_hash(hasher);
        self.state.detectors.state_hash(hasher);
    }
}
