//! A schedule: who departs when, on what route, by name.

use std::collections::BTreeMap;

use simworld_core::seed::{Seed, Stream};

use super::agenda::{Agenda, Beat};
use super::itinerary::{Names, Surroundings, Travellers};
use super::timetable::{Departures, Service, Timetable};
use super::{Flow, Itinerary, PersonFlow, VehicleChoice, Whereabouts};
use crate::output::Recorder;
use crate::{Route, Stop, Traffic, TrafficError};

/// One vehicle that is to depart.
#[derive(Clone, Debug, PartialEq)]
pub struct Departing {
    /// What it is called in outputs.
    pub name: String,
    /// When it departs, s after the start.
    pub depart: f64,
    /// Its way.
    pub route: Route,
    /// Its kind or type.
    pub vehicle: VehicleChoice,
    /// Where it stops on its way.
    pub stops: Vec<Stop>,
    /// The line that it is of, for those who ride; empty if none.
    pub line: String,
}

impl Departing {
    /// A vehicle that makes no stops.
    pub fn new(name: impl Into<String>, depart: f64, route: Route, vehicle: VehicleChoice) -> Self {
        Self { name: name.into(), depart, route, vehicle, stops: Vec::new(), line: String::new() }
    }
}

/// Vehicles that keep coming, with names: `name.0`, `name.1` and so on.
#[derive(Clone, Debug)]
struct Series {
    name: String,
    flow: Flow,
    vehicle: VehicleChoice,
    line: String,
    beat: Beat,
}

/// Who departs when. [`feed`](Self::feed) it to the traffic before every step.
///
/// ```
/// use std::sync::Arc;
/// use simworld_core::id::RoadId;
/// use simworld_core::net::{LaneDirection, NetworkConfig, RoadNetwork, StreetPlan};
/// use simworld_core::seed::Seed;
/// use simworld_traffic::vehicle::VehicleKind;
/// use simworld_traffic::{Departing, Leg, Route, Schedule, Traffic, TrafficConfig};
/// let network = Arc::new(RoadNetwork::derive(&StreetPlan::crossroads(100.0), &NetworkConfig::default())?);
/// let empty = TrafficConfig { vehicles: 0, pedestrians: 0, ..TrafficConfig::default() };
/// let mut traffic = Traffic::new(network, &empty, Seed(1))?;
/// let way = [Leg::new(RoadId(0), LaneDirection::Backward), Leg::new(RoadId(2), LaneDirection::Forward)];
/// let mut schedule = Schedule::new(Seed(1));
/// schedule.add(Departing::new("bus 7", 5.0, Route(way.to_vec()), VehicleKind::Bus.into()));
/// for _ in 0..600 {
///     schedule.feed(&mut traffic)?;
///     traffic.step(0.1);
/// }
/// assert_eq!(traffic.counters().entered, 1);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Schedule {
    departing: Vec<Option<Departing>>,
    due: Agenda,
    series: Vec<Series>,
    next_of_series: Agenda,
    /// Names of those who were sent and have not entered, by the number that the traffic gave them.
    outside: BTreeMap<u64, Names>,
    /// Those under way, by number.
    present: BTreeMap<u32, Names>,
    travellers: Travellers,
    /// What has a line and halts, for those who look for a way by it.
    services: Vec<Service>,
    /// When they halt where; made when somebody is under way, and anew when a service was added.
    timetable: Option<Timetable>,
    stream: Stream,
}

impl Schedule {
    /// Nobody yet; random arrivals are drawn from the seed.
    pub fn new(seed: Seed) -> Self {
        Self {
            departing: Vec::new(),
            due: Agenda::default(),
            series: Vec::new(),
            next_of_series: Agenda::default(),
            outside: BTreeMap::new(),
            present: BTreeMap::new(),
            travellers: Travellers::default(),
            services: Vec::new(),
            timetable: None,
            stream: seed.stream("traffic/schedule"),
        }
    }

    /// Adds one vehicle.
    pub fn add(&mut self, departing: Departing) {
        self.due.add(departing.depart, self.departing.len());
        let once = Departures { first: departing.depart, headway: 1.0, until: f64::INFINITY, number: 1 };
        self.offer(service(&departing.line, &departing.route, &departing.stops, once));
        self.departing.push(Some(departing));
    }

    /// Adds a flow whose vehicles have names, at most `number` of them.
    ///
    /// # Errors
    /// A rate that is not more than 0, or times that are none.
    pub fn add_flow(&mut self, name: impl Into<String>, flow: Flow, number: u64) -> Result<(), TrafficError> {
        let vehicle = flow.kind.unwrap_or_default().into();
        self.add_flow_of(name, flow, vehicle, number)
    }

    /// The same with vehicles of a kind or type, whatever the flow says.
    ///
    /// # Errors
    /// Those of [`add_flow`](Self::add_flow).
    pub fn add_flow_of(
        &mut self,
        name: impl Into<String>,
        flow: Flow,
        vehicle: VehicleChoice,
        number: u64,
    ) -> Result<(), TrafficError> {
        flow.validate()?;
        let index = self.series.len();
        let stream = self.stream.indexed(index as u64);
        let Flow { per_hour, arrivals, until, .. } = flow;
        let beat = Beat { per_hour, arrivals, until, number, drawn: 0, stream };
        if let Some(first) = beat.first(flow.from) {
            self.next_of_series.add(first, index);
        }
        self.series.push(Series { name: name.into(), flow, vehicle, line: String::new(), beat });
        Ok(())
    }

    /// Says of which line the last flow is that was added, for those who ride.
    pub fn name_line(&mut self, line: impl Into<String>) {
        let Some(last) = self.series.last_mut() else { return };
        last.line = line.into();
        let Flow { route, stops, per_hour, from, until, .. } = &last.flow;
        let (first, headway, until, number) = (*from, 3600.0 / per_hour, *until, last.beat.number);
        let departures = Departures { first, headway, until, number };
        let service = service(&last.line, route, stops, departures);
        self.offer(service);
    }

    /// Takes note of a service, for those who look for a way by it.
    fn offer(&mut self, service: Option<Service>) {
        if let Some(service) = service {
            self.services.push(service);
            self.timetable = None;
        }
    }

    /// Adds a person who walks, waits and rides.
    pub fn add_person(&mut self, person: Itinerary) {
        self.travellers.add(person);
    }

    /// Adds people who keep coming; they are called `name.0`, `name.1` and so on.
    ///
    /// # Errors
    /// A rate that is not more than 0, or times that are none.
    pub fn add_person_flow(&mut self, name: impl Into<String>, flow: PersonFlow) -> Result<(), TrafficError> {
        self.travellers.add_flow(name.into(), flow, self.stream.named("people"))
    }

    /// The names of those who could not walk where they were to, or whose vehicle did not halt where they get out.
    pub fn stranded(&self) -> impl Iterator<Item = &str> {
        self.travellers.stranded()
    }

    /// Where those are who were added as persons.
    pub fn people(&self) -> Whereabouts {
        self.travellers.whereabouts()
    }

    /// How many single vehicles are left to depart, without those of flows.
    pub fn len(&self) -> usize {
        self.due.len()
    }

    /// Whether no single vehicle is left to depart.
    pub fn is_empty(&self) -> bool {
        self.due.is_empty()
    }

    /// Whether nobody is left to depart, of flows neither.
    pub fn is_over(&self) -> bool {
        self.due.is_empty() && self.next_of_series.is_empty()
    }

    /// Sends everybody who is due now. Returns how many.
    ///
    /// # Errors
    /// A route that cannot be driven: it is passed over.
    pub fn feed(&mut self, traffic: &mut Traffic) -> Result<usize, TrafficError> {
        let now = traffic.seconds() + 1e-9;
        let mut count = 0;
        self.welcome(traffic);
        self.feed_people(traffic);
        for trip in traffic.ended() {
            self.present.remove(&trip.id);
        }
        while let Some((time, index)) = self.due.take(now) {
            let Some(departing) = self.departing[index].take() else { continue };
            let Departing { name, route, vehicle, stops, line, .. } = departing;
            let number = traffic.insert_stopping(route, vehicle, time, stops)?;
            self.outside.insert(number, [name.clone(), name, line]);
            count += 1;
        }
        while let Some((time, index)) = self.next_of_series.take(now) {
            let series = &mut self.series[index];
            let name = format!("{}.{}", series.name, series.beat.drawn);
            if let Some(next) = series.beat.count(time) {
                self.next_of_series.add(next, index);
            }
            let (route, stops) = (series.flow.route.clone(), series.flow.stops.clone());
            let number = traffic.insert_stopping(route, series.vehicle, time, stops)?;
            self.outside.insert(number, [name, series.name.clone(), series.line.clone()]);
            count += 1;
        }
        Ok(count)
    }

    /// Tells a recorder the names of those who entered in the last step; call it before the recorder observes.
    pub fn name(&mut self, traffic: &Traffic, recorder: &mut Recorder) {
        self.welcome(traffic);
        for (id, _) in traffic.admitted() {
            if let Some([name, ..]) = self.present.get(&id) {
                recorder.name(id, name.clone());
            }
        }
    }

    /// People begin and end their stages.
    fn feed_people(&mut self, traffic: &mut Traffic) {
        if self.travellers.is_idle(traffic.seconds() + 1e-9) {
            return;
        }
        let timetable =
            self.timetable.get_or_insert_with(|| Timetable::new(traffic.network(), &self.services));
        let halting = traffic.halting().collect();
        let around = Surroundings { vehicles: &self.present, timetable, halting };
        for (number, name) in self.travellers.feed(traffic, &around) {
            self.outside.insert(number, [name.clone(), name, String::new()]);
        }
    }

    /// Takes note of who entered in the last step.
    fn welcome(&mut self, traffic: &Traffic) {
        for (id, number) in traffic.admitted() {
            if let Some(names) = number.and_then(|number| self.outside.remove(&number)) {
                self.present.insert(id, names);
            }
        }
    }
}

/// What those are offered who look for a way by a line, if it is one on which somebody could ride.
fn service(line: &str, route: &Route, stops: &[Stop], departures: Departures) -> Option<Service> {
    (!line.is_empty() && stops.len() > 1).then(|| Service {
        line: line.to_owned(),
        route: route.clone(),
        stops: stops.to_vec(),
        departures,
    })
}
