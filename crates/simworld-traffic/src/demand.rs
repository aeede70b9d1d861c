//! Demand: flows and trips that enter the network, wait outside while there is no room, and leave at the end of their route.

mod activity;
mod agenda;
mod drive;
mod itinerary;
mod matrix;
mod schedule;
mod timetable;

use std::collections::{BTreeMap, VecDeque};

pub use activity::{Activity, ActivityChains, DayTimes, Person, commuters};
pub use drive::Drive;
pub use itinerary::{Itinerary, Kerb, PersonFlow, Stage, Whereabouts};
pub use matrix::{OdMatrix, TimeProfile, Zone};
pub use schedule::{Departing, Schedule};
use serde::{Deserialize, Serialize};
use simworld_core::seed::{Stream, StreamRng};
#[cfg(feature = "sumo")]
pub(crate) use timetable::beside;

use crate::line::{self, Stop};
use crate::vehicle::{Halt, Order, Then, Tracks, TypeIndex, VehicleKind, VehicleManager, draw_type};
use crate::{Counters, Leg, Route, TrafficConfig, TrafficError};

/// Whoever parks takes so long for it, s, and those behind wait (Highway Capacity Manual 2000, chapter 16: a manoeuvre blocks the
/// lane for 18 s on average).
const PARKING: f64 = 18.0;

/// How the vehicles of a flow come.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Arrivals {
    /// At even times.
    Uniform,
    /// At random, independently of one another.
    #[default]
    Poisson,
}

/// Vehicles that keep coming.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Flow {
    /// Their way; they enter at the beginning of its first leg and leave at the end of its last.
    pub route: Route,
    /// How many come, vehicles an hour, in (0, 10 000].
    pub per_hour: f64,
    /// How they come.
    pub arrivals: Arrivals,
    /// Their kind, and their type among those of that kind by the shares of the configuration; drawn from all if there is none.
    pub kind: Option<VehicleKind>,
    /// Where they stop on their way.
    pub stops: Vec<Stop>,
    /// When the first may come, s after the start.
    pub from: f64,
    /// When no more come, s after the start.
    pub until: f64,
}

impl Flow {
    /// So many vehicles an hour on a route, at random, for ever.
    pub fn new(route: Route, per_hour: f64) -> Self {
        Self {
            route,
            per_hour,
            arrivals: Arrivals::Poisson,
            kind: None,
            stops: Vec::new(),
            from: 0.0,
            until: f64::MAX,
        }
    }

    /// Checks its rate and its times.
    pub(crate) fn validate(&self) -> Result<(), TrafficError> {
        check_times(self.per_hour, self.from, self.until)
    }
}

/// Checks the rate and the times of a flow.
fn check_times(per_hour: f64, from: f64, until: f64) -> Result<(), TrafficError> {
    let checks = [
        ("per_hour", per_hour, 1e-3, 1e4, "more than 0, at most 10 000 an hour"),
        ("from", from, 0.0, f64::MAX, "0 s or later"),
        ("until", until, from, f64::MAX, "a time after from"),
    ];
    for (field, value, low, high, allowed) in checks {
        if !(low..=high).contains(&value) {
            return Err(TrafficError::Config { field, value, allowed });
        }
    }
    Ok(())
}

/// Why a trip ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum TripEnd {
    /// The vehicle came to the end of its route.
    Arrived,
    /// Somebody took it out.
    Removed,
    /// What was left of its way was closed, and there was no other; or it left the map, since no way led on to its goal from where it was.
    NoWay,
    /// It was parked at the kerb.
    Parked,
}

/// A trip that has ended.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Trip {
    /// The vehicle's number, which another may have next.
    pub id: u32,
    /// Its kind.
    pub kind: VehicleKind,
    /// Its type: a row of [`TrafficConfig::types`](crate::TrafficConfig::types).
    pub vehicle_type: usize,
    /// Why it ended.
    pub end: TripEnd,
    /// When it was to depart, s after the start.
    pub scheduled: f64,
    /// When it entered, s.
    pub entered: f64,
    /// When it left, s.
    pub left: f64,
    /// Distance driven, m.
    pub distance: f64,
    /// How long the same way takes on an empty road with green lights, s.
    pub free_time: f64,
}

impl Trip {
    /// Time lost on the way, s; without what was waited outside.
    pub fn delay(&self) -> f64 {
        self.left - self.entered - self.free_time
    }
}

/// A vehicle that waits to enter.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Departure {
    pub(crate) route: u32,
    /// Its type: a row of the table.
    pub(crate) row: TypeIndex,
    /// The speed that its driver chooses, as a share of the limit.
    pub(crate) factor: f32,
    /// The flow that it is of, for its stops.
    pub(crate) source: Option<u32>,
    pub(crate) scheduled: f64,
    pub(crate) kerbs: Kerbs,
    /// Its number among those who were sent one by one; [`OF_FLOW`] if a flow sent it.
    pub(crate) number: u64,
}

/// Where a trip begins and ends beside the road: the stations of parking places, m from the beginning of the lanes of the first
/// and of the last leg. Without one the vehicle enters at the beginning of its first leg, or leaves at the end of its last.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Kerbs {
    /// Where its front stands when it departs.
    pub from: Option<f64>,
    /// Where it parks.
    pub to: Option<f64>,
}

/// The number of those whom flows send.
pub(crate) const OF_FLOW: u64 = u64::MAX;

/// Which vehicle is sent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum VehicleChoice {
    /// One of a kind: its type is drawn among those of that kind by the shares of the configuration.
    Kind(VehicleKind),
    /// One of the type in that row of [`TrafficConfig::types`](crate::TrafficConfig::types).
    Type(usize),
}

impl From<VehicleKind> for VehicleChoice {
    fn from(kind: VehicleKind) -> Self {
        Self::Kind(kind)
    }
}

impl VehicleChoice {
    /// Whether the configuration has such a vehicle.
    pub(crate) fn validate(self, config: &TrafficConfig) -> Result<(), TrafficError> {
        match self {
            Self::Kind(kind) => config.has_type(kind),
            Self::Type(row) if row < config.types.len() => Ok(()),
            Self::Type(row) => Err(TrafficError::Config {
                field: "vehicle type",
                value: row as f64,
                allowed: "a row of TrafficConfig::types",
            }),
        }
    }
}

impl Departure {
    /// A vehicle of a kind or type, or of any.
    fn draw(
        config: &TrafficConfig,
        choice: Option<VehicleChoice>,
        route: u32,
        scheduled: f64,
        rng: &mut StreamRng,
    ) -> Self {
        let row = match choice {
            Some(VehicleChoice::Type(row)) => row as TypeIndex,
            Some(VehicleChoice::Kind(kind)) => draw_type(&config.types, |row| row.kind == kind, rng),
            None => draw_type(&config.types, |_| true, rng),
        };
        Self {
            route,
            row,
            factor: config.vehicle_type(row).draw_factor(rng),
            source: None,
            scheduled,
            kerbs: Kerbs::default(),
            number: OF_FLOW,
        }
    }
}

/// A flow with its clock.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Source {
    flow: Flow,
    route: u32,
    next: f64,
    drawn: u64,
}

/// All that wants to enter.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct DemandManager {
    sources: Vec<Source>,
    /// First come, first served, at the beginning of each leg.
    outside: BTreeMap<Leg, VecDeque<Departure>>,
    /// Who waits in a parking place beside a leg, in the order in which they came.
    parked: Vec<(Leg, Departure)>,
    /// How many were sent one by one.
    sent: u64,
    /// The stops of those of them who have any and are outside.
    stops: BTreeMap<u64, Vec<Stop>>,
    /// The numbers of those who entered in the last step, in their order.
    #[serde(skip)]
    pub(crate) admitted: Vec<u64>,
}

impl DemandManager {
    pub(crate) fn add_flow(
        &mut self,
        mut flow: Flow,
        tracks: &Tracks,
        vehicles: &mut VehicleManager,
        streams: Stream,
    ) -> Result<(), TrafficError> {
        flow.route = flow.route.outside(tracks);
        flow.route.validate(&tracks.network)?;
        flow.validate()?;
        line::validate(&flow.stops, &flow.route, &tracks.network)?;
        let route = vehicles.add_route(flow.route.clone());
        let mut source = Source { next: flow.from, flow, route, drawn: 0 };
        if source.flow.arrivals == Arrivals::Poisson {
            source.next += source.wait(&mut source.stream(streams, self.sources.len()));
        }
        self.sources.push(source);
        Ok(())
    }

    /// Sends one vehicle and returns its number.
    pub(crate) fn add_trip(
        &mut self,
        entry: Leg,
        route: u32,
        vehicle: VehicleChoice,
        (config, streams): (&TrafficConfig, Stream),
        (scheduled, kerbs): (f64, Kerbs),
    ) -> u64 {
        let number = self.sent;
        self.sent += 1;
        let mut rng = streams.named("trips").indexed(number).rng();
        let departure = Departure::draw(config, Some(vehicle), route, scheduled, &mut rng);
        let departure = Departure { kerbs, number, ..departure };
        if kerbs.from.is_some() {
            self.parked.push((entry, departure));
        } else {
            self.outside.entry(entry).or_default().push_back(departure);
        }
        number
    }

    /// Gives one of those who were sent its stops.
    pub(crate) fn stop_at(&mut self, number: u64, stops: Vec<Stop>) {
        if !stops.is_empty() {
            self.stops.insert(number, stops);
        }
    }

    /// Vehicles that wait outside, or in a parking place.
    pub(crate) fn outside(&self) -> usize {
        self.outside.values().map(VecDeque::len).sum::<usize>() + self.parked.len()
    }

    /// Lets come who is due, and enter who has room.
    pub(crate) fn step(
        &mut self,
        vehicles: &mut VehicleManager,
        tracks: &Tracks,
        config: &TrafficConfig,
        streams: Stream,
        now: f64,
        counters: &mut Counters,
    ) {
        self.admitted.clear();
        for index in 0..self.sources.len() {
            self.draw(index, config, streams, now);
        }
        self.outside.retain(|leg, queue| {
            // The queue of a flow is kept for those who come next; of trips there may be no other from that leg.
            let mut is_over = false;
            while let Some(departure) = queue.front() {
                if !vehicles.enter(tracks, config, *leg, departure, now) {
                    break;
                }
                is_over = departure.source.is_none();
                self.admitted.push(departure.number);
                let source = departure.source.and_then(|source| self.sources.get(source as usize));
                let own = self.stops.remove(&departure.number).unwrap_or_default();
                let stops = source.map_or(&own[..], |source| &source.flow.stops);
                give_halts(vehicles, (tracks, config), departure, stops);
                queue.pop_front();
                counters.entered += 1;
            }
            !(is_over && queue.is_empty())
        });
        let (admitted, stops) = (&mut self.admitted, &mut self.stops);
        self.parked.retain(|(leg, departure)| {
            let place = (*leg, departure.kerbs.from.unwrap_or_default());
            let departs = vehicles.pull_out(tracks, config, place, departure, now);
            if departs {
                admitted.push(departure.number);
                let own = stops.remove(&departure.number).unwrap_or_default();
                give_halts(vehicles, (tracks, config), departure, &own);
                counters.entered += 1;
            }
            !departs
        });
    }

    fn draw(&mut self, index: usize, config: &TrafficConfig, streams: Stream, now: f64) {
        let source = &mut self.sources[index];
        while source.next <= now && source.next < source.flow.until {
            let mut rng = source.stream(streams, index);
            let kind = source.flow.kind.map(VehicleChoice::Kind);
            let mut departure = Departure::draw(config, kind, source.route, source.next, &mut rng);
            departure.source = Some(index as u32);
            let entry = source.flow.route.0.first().copied();
            source.drawn += 1;
            source.next += source.wait(&mut rng);
            if let Some(entry) = entry {
                self.outside.entry(entry).or_default().push_back(departure);
            }
        }
    }

    /// Whether a saved state is one of this network.
    pub(crate) fn fits(&self, tracks: &Tracks, routes: usize, types: usize) -> bool {
        let known = |route: u32| (route as usize) < routes;
        let is_type =
            |departure: &Departure| usize::from(departure.row) < types && departure.factor.is_finite();
        self.sources.iter().all(|source| {
            known(source.route)
                && source.next.is_finite()
                && source.flow.per_hour > 0.0
                && source.flow.route.validate(&tracks.network).is_ok()
                && line::validate(&source.flow.stops, &source.flow.route, &tracks.network).is_ok()
        }) && self.outside.iter().all(|(leg, queue)| {
            !leg.lanes(&tracks.network).is_empty()
                && queue.iter().all(|departure| known(departure.route) && is_type(departure))
        }) && self.parked.iter().all(|(leg, departure)| {
            !leg.lanes(&tracks.network).is_empty()
                && known(departure.route)
                && is_type(departure)
                && departure.kerbs.from.is_some_and(f64::is_finite)
        }) && self.stops.values().flatten().all(|stop| {
            !stop.leg.lanes(&tracks.network).is_empty() && stop.station.is_finite() && stop.dwell >= 0.0
        })
    }
}

/// Tells the one who entered last where it stops on its way, and where it parks.
fn give_halts(
    vehicles: &mut VehicleManager,
    (tracks, config): (&Tracks, &TrafficConfig),
    departure: &Departure,
    stops: &[Stop],
) {
    let Some(id) = vehicles.entered.last().copied() else { return };
    if !stops.is_empty() {
        let halts = stops.iter().map(|stop| Halt::at(stop, departure.scheduled, Then::GoOn));
        vehicles.order(tracks, config, id, halts, Order::Last);
    }
    if let (Some(station), Some(leg)) = (departure.kerbs.to, vehicles.last_leg(departure.route)) {
        let place = Stop::new(leg, station, PARKING);
        vehicles.order(tracks, config, id, [Halt::at(&place, 0.0, Then::Park)], Order::Last);
    }
}

impl Source {
    fn stream(&self, streams: Stream, index: usize) -> StreamRng {
        streams.named("flows").indexed(index as u64).indexed(self.drawn).rng()
    }

    fn wait(&self, rng: &mut StreamRng) -> f64 {
        let rate = self.flow.per_hour / 3600.0;
        match self.flow.arrivals {
            Arrivals::Uniform => 1.0 / rate,
            Arrivals::Poisson => rng.exponential(rate),
        }
    }
}
