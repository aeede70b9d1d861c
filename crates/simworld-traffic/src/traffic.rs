//! The traffic of a network: three managers on a fixed step (the paper's Algorithm 2).

mod foreign;

use std::sync::Arc;

use foreign::Finder;
pub use foreign::Foreign;
use serde::{Deserialize, Serialize};
use simworld_core::geometry::{Point2, Pose, Twist, Vector2, Vector3, direction, heading, pose_facing};
use simworld_core::hash::{StateHash, StateHasher};
use simworld_core::net::{Aspect, RoadNetwork, SignalPlan, WaypointConfig, WaypointGraph, polyline};
use simworld_core::scene::Shape;
use simworld_core::seed::{Seed, Stream};

use crate::demand::{DemandManager, Flow, Trip};
use crate::pedestrian::{self, Pedestrian, PedestrianManager};
use crate::signal::{Controllers, Detectors, IntersectionManager, SignalPolicy};
use crate::vehicle::{self, Tracks, VehicleKind, VehicleManager};
use crate::{DrivingConditions, Route, TrafficConfig, TrafficError};

/// Where a body is held to its lane, as shares of its length from the front.
const FRONT_AXLE: f64 = 0.1;
const REAR_AXLE: f64 = 0.95;

/// What was counted since the start; the first two say how much was done, the others what went less than well.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Counters {
    /// Vehicle updates.
    pub updates: u64,
    /// Leaves to cross an intersection.
    pub crossings: u64,
    /// Steps in which a vehicle went on at red because it could no longer stop.
    pub dilemmas: u64,
    /// Times that a vehicle was held at a stop line by more than its brakes.
    pub forced_stops: u64,
    /// Times that a vehicle had stood for three minutes.
    pub long_waits: u64,
    /// Lane changes.
    pub lane_changes: u64,
    /// Vehicles that took another route because they could not get into the lane of theirs, or to undo a lock.
    pub rerouted: u64,
    /// Rings of full lanes, each waiting for the next, that were found and undone.
    pub locks: u64,
    /// Vehicles that entered a junction without room behind it to undo a lock.
    pub passes: u64,
    /// Vehicles that entered after the start.
    pub entered: u64,
    /// Vehicles that came to the end of their route.
    pub arrived: u64,
    /// Vehicles that were taken out.
    pub removed: u64,
}

/// How many found a place at the start, of those asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Placed {
    /// Vehicles.
    pub vehicles: u32,
    /// Pedestrians.
    pub pedestrians: u32,
}

/// A vehicle as others see it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// Its number, from zero.
    pub id: u32,
    /// Its kind.
    pub kind: VehicleKind,
    /// Its type: a row of [`TrafficConfig::types`].
    pub vehicle_type: usize,
    /// Its solid.
    pub shape: Shape,
    /// World from body: the origin is the middle of its bottom.
    pub pose: Pose,
    /// Velocity.
    pub twist: Twist,
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
    finder: Finder,
    signals: IntersectionManager,
    state: State,
    placed: Placed,
    // Buffers kept from step to step.
    walkers: Vec<u32>,
    obstacles: Vec<(u32, f64)>,
}

/// Everything that changes, for snapshots.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct State {
    vehicles: VehicleManager,
    demand: DemandManager,
    pedestrians: PedestrianManager,
    controllers: Controllers,
    detectors: Detectors,
    aspects: Vec<Aspect>,
    /// How long each group has shown its aspect, s.
    shown: Vec<f64>,
    seconds: f64,
    steps: u64,
    counters: Counters,
    conditions: DrivingConditions,
}

impl State {
    /// How many numbers vehicles have.
    pub(crate) fn numbers(&self) -> usize {
        self.vehicles.paths.len()
    }
}

impl Traffic {
    /// Places vehicles and pedestrians; [`placed`](Self::placed) says how many found room.
    ///
    /// # Errors
    /// A setting out of range.
    pub fn new(network: Arc<RoadNetwork>, config: &TrafficConfig, seed: Seed) -> Result<Self, TrafficError> {
        config.validate()?;
        let streams = seed.stream("traffic");
        let signals = IntersectionManager::new(&network);
        let (crossings, groups) = (network.crossings.len(), network.signal_groups());
        let ways = WaypointGraph::walkable(&network, &WaypointConfig { step: 25.0, offset: 0.0 })?;
        let mut pedestrians = PedestrianManager::new(&network);
        let tracks = Tracks::new(network, config);
        let mut vehicles = VehicleManager::new(&tracks);
        let placed = Placed {
            vehicles: vehicles.spawn(&tracks, config, streams.named("vehicles")),
            pedestrians: pedestrians.spawn(&ways, config, streams.named("pedestrians")),
        };
        let mut traffic = Self {
            config: config.clone(),
            driving: config.conditions.applied(config),
            streams,
            finder: Finder::new(&tracks),
            walkers: vec![0; crossings],
            signals,
            tracks,
            ways,
            state: State { vehicles, pedestrians, conditions: config.conditions, ..State::default() },
            placed,
            obstacles: Vec::new(),
        };
        traffic.state.detectors = Detectors::new(groups);
        traffic.restart_signals();
        Ok(traffic)
    }

    /// Gives the signals another policy than [`FixedTime`](crate::signal::FixedTime); it decides from the next step on.
    pub fn set_policy(&mut self, policy: Box<dyn SignalPolicy + Send>) {
        self.signals.set_policy(policy);
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

    /// Sends a vehicle on a route; it enters when there is room at the beginning of the first leg.
    ///
    /// # Errors
    /// A route that cannot be driven, or a kind of which the configuration has no type.
    pub fn insert(&mut self, route: Route, kind: VehicleKind) -> Result<(), TrafficError> {
        route.validate(&self.tracks.network)?;
        self.driving.has_type(kind)?;
        let State { vehicles, demand, seconds, .. } = &mut self.state;
        if let Some(entry) = route.0.first().copied() {
            let route = vehicles.add_route(route);
            demand.add_trip(entry, route, kind, (&self.driving, self.streams), *seconds);
        }
        Ok(())
    }

    /// Takes a vehicle out, wherever it is; false if there is none of that number.
    pub fn remove(&mut self, id: u32) -> bool {
        let State { vehicles, counters, seconds, .. } = &mut self.state;
        let removed = vehicles.remove(&self.tracks, &self.driving, id, *seconds);
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

    /// Gives the signals other plans, for the same groups; they begin at once, where their clocks stand now.
    ///
    /// # Errors
    /// Plans that are not for the same intersections and groups, or that have a phase without duration.
    pub fn set_plans(&mut self, plans: Vec<SignalPlan>) -> Result<(), TrafficError> {
        let own = self.signals.plans();
        let differs = |(old, new): (&SignalPlan, &SignalPlan)| {
            old.intersection != new.intersection
                || old.groups != new.groups
                || !new.offset.is_finite()
                || new.phases.iter().any(|phase| !(phase.duration > 0.0 && phase.duration.is_finite()))
        };
        let other = own.iter().zip(&plans).position(differs);
        if let Some(plan) = other.or((own.len() != plans.len()).then_some(own.len().min(plans.len()))) {
            return Err(TrafficError::Plan { plan });
        }
        self.signals.set_plans(plans);
        self.restart_signals();
        Ok(())
    }

    /// One step of `dt` s.
    pub fn step(&mut self, dt: f64) {
        self.step_among(&[], dt);
    }

    /// One step of `dt` s among bodies that are not the traffic's own: drivers stop for them.
    pub fn step_among(&mut self, foreign: &[Foreign], dt: f64) {
        self.finder.find(&self.tracks, foreign, &mut self.walkers, &mut self.obstacles);
        for (count, own) in self.walkers.iter_mut().zip(&self.state.pedestrians.on_crossing) {
            *count += own;
        }
        self.update_vehicles(dt);
        self.update_pedestrians(dt);
        self.state.steps += 1;
        // Counted, not accumulated, so that long runs keep their phase.
        self.state.seconds = self.state.steps as f64 * dt;
        self.update_signals(dt);
    }

    fn update_vehicles(&mut self, dt: f64) {
        let State { vehicles, demand, pedestrians, counters, shown, seconds, .. } = &mut self.state;
        vehicles.entered.clear();
        vehicles.ended.clear();
        demand.step(vehicles, &self.tracks, &self.driving, self.streams, *seconds, counters);
        let sight = vehicle::Sight {
            aspects: &self.signals.aspects,
            shown,
            walkers: &self.walkers,
            waiting: &pedestrians.waiting,
            obstacles: &self.obstacles,
        };
        let streams = self.streams.named("vehicles");
        vehicles.step(&self.tracks, &self.driving, streams, &sight, (*seconds, dt), counters);
    }

    fn update_pedestrians(&mut self, dt: f64) {
        let State { vehicles, pedestrians, .. } = &mut self.state;
        let sight = pedestrian::Sight {
            network: &self.tracks.network,
            ways: &self.ways,
            aspects: &self.signals.aspects,
            claims: &vehicles.claims,
        };
        pedestrians.step(&sight, &self.driving, self.streams.named("pedestrians"), dt);
    }

    fn update_signals(&mut self, dt: f64) {
        let State { vehicles, pedestrians, controllers, detectors, seconds, .. } = &mut self.state;
        detectors.look(&self.tracks, vehicles, &pedestrians.waiting, &self.tracks.network, dt);
        self.signals.step(controllers, *seconds, detectors.demand(), dt);
        let State { aspects, shown, .. } = &mut self.state;
        for ((old, new), shown) in aspects.iter_mut().zip(&self.signals.aspects).zip(shown) {
            *shown = if old == new { *shown + dt } else { 0.0 };
            *old = *new;
        }
    }

    fn restart_signals(&mut self) {
        self.state.controllers = self.signals.start(self.state.seconds);
        self.signals.show(&self.state.controllers);
        self.state.aspects.clone_from(&self.signals.aspects);
        self.state.shown = vec![0.0; self.signals.aspects.len()];
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

    /// The network.
    pub fn network(&self) -> &Arc<RoadNetwork> {
        &self.tracks.network
    }

    /// The walkers, by number.
    pub fn pedestrians(&self) -> &[Pedestrian] {
        &self.state.pedestrians.walkers
    }

    /// The vehicles, in the order of their tracks.
    pub fn vehicles(&self) -> impl Iterator<Item = Body> {
        self.state.vehicles.iter().map(|(track, vehicle)| {
            let length = vehicle.length();
            let row = self.driving.vehicle_type(vehicle.row);
            // The rear may still be on the track before. Steered front wheels and a rear that hardly swings out.
            let front = self.point(track, vehicle.id, vehicle.s - FRONT_AXLE * length);
            let rear = self.point(track, vehicle.id, vehicle.s - REAR_AXLE * length);
            let yaw = heading(&(front - rear));
            let ahead = direction(yaw);
            let left = Vector2::new(-ahead.y, ahead.x);
            let middle =
                rear + (front - rear) * ((REAR_AXLE - 0.5) / (REAR_AXLE - FRONT_AXLE)) + left * vehicle.shift;
            let ahead = ahead * vehicle.v;
            Body {
                id: vehicle.id,
                kind: row.kind,
                vehicle_type: usize::from(vehicle.row),
                shape: row.shape(),
                pose: pose_facing(simworld_core::geometry::Point3::new(middle.x, middle.y, 0.0), yaw),
                twist: Twist { linear: Vector3::new(ahead.x, ahead.y, 0.0), angular: Vector3::zeros() },
            }
        })
    }

    fn point(&self, track: u32, id: u32, station: f64) -> Point2 {
        let path = self.tracks.path(track);
        if station >= 0.0 {
            return polyline::at(path, station).0;
        }
        let before = self.state.vehicles.paths[id as usize].before;
        if before == track {
            // At the start a vehicle has come from nowhere: its lane is continued backwards.
            let (start, yaw) = polyline::at(path, 0.0);
            return start + direction(yaw) * station;
        }
        let length = self.tracks.length[before as usize];
        if station + length >= 0.0 {
            return polyline::at(self.tracks.path(before), station + length).0;
        }
        let (start, yaw) = polyline::at(self.tracks.path(before), 0.0);
        start + direction(yaw) * (station + length)
    }

    /// Where each vehicle is: the lane or connection it is on, and its front on it, m. Lanes are numbered as in the network,
    /// connections after them.
    pub fn stations(&self) -> impl Iterator<Item = (u32, u32, f64, f64)> {
        self.state.vehicles.iter().map(|(track, vehicle)| (vehicle.id, track, vehicle.s, vehicle.v))
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
            && people == self.placed.pedestrians as usize
            && state.aspects.len() == self.signals.aspects.len()
            && state.shown.len() == state.aspects.len()
            && state.detectors.gap.len() == state.aspects.len()
            && self.signals.fits(&state.controllers)
            && state.pedestrians.fits(&self.ways, self.walkers.len());
        if fits {
            self.signals.aspects.clone_from(&state.aspects);
            self.driving = state.conditions.applied(&self.config);
            self.state = state;
        }
        fits
    }
}

impl StateHash for Traffic {
    fn state_hash(&self, hasher: &mut StateHasher) {
        hasher.u64(self.state.steps);
        self.state.vehicles.state_hash(hasher);
        self.state.pedestrians.state_hash(hasher);
        for aspect in &self.state.aspects {
            hasher.u64(*aspect as u64);
        }
        for controller in &self.state.controllers {
            controller.state_hash(hasher);
        }
        for gap in &self.state.detectors.gap {
            hasher.f64(*gap);
        }
    }
}
