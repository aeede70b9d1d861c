//! A schedule: who departs when, on what route, by name.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};

use simworld_core::seed::{Seed, Stream, StreamRng};

use super::itinerary::{Names, Travellers};
use super::{Flow, Itinerary, VehicleChoice, Whereabouts};
use crate::output::Recorder;
use crate::{Arrivals, Route, Stop, Traffic, TrafficError};

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
    /// At most so many.
    number: u64,
    line: String,
    drawn: u64,
    stream: Stream,
}

/// When somebody is due: the bits of a time that is not negative are in its order.
type Due = Reverse<(u64, usize)>;

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
    due: BinaryHeap<Due>,
    series: Vec<Series>,
    next_of_series: BinaryHeap<Due>,
    /// Names of those who were sent and have not entered, by the number that the traffic gave them.
    outside: BTreeMap<u64, Names>,
    /// Those under way, by number.
    present: BTreeMap<u32, Names>,
    travellers: Travellers,
    stream: Stream,
}

fn due(time: f64, index: usize) -> Due {
    Reverse((time.max(0.0).to_bits(), index))
}

impl Schedule {
    /// Nobody yet; random arrivals are drawn from the seed.
    pub fn new(seed: Seed) -> Self {
        Self {
            departing: Vec::new(),
            due: BinaryHeap::new(),
            series: Vec::new(),
            next_of_series: BinaryHeap::new(),
            outside: BTreeMap::new(),
            present: BTreeMap::new(),
            travellers: Travellers::default(),
            stream: seed.stream("traffic/schedule"),
        }
    }

    /// Adds one vehicle.
    pub fn add(&mut self, departing: Departing) {
        self.due.push(due(departing.depart, self.departing.len()));
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
        let line = String::new();
        let series = Series { name: name.into(), flow, vehicle, number, line, drawn: 0, stream };
        let first =
            series.flow.from + if series.flow.arrivals == Arrivals::Poisson { series.wait() } else { 0.0 };
        if number > 0 && first < series.flow.until {
            self.next_of_series.push(due(first, index));
        }
        self.series.push(series);
        Ok(())
    }

    /// Says of which line the last flow is that was added, for those who ride.
    pub fn name_line(&mut self, line: impl Into<String>) {
        if let Some(last) = self.series.last_mut() {
            last.line = line.into();
        }
    }

    /// Adds a person who walks, waits and rides.
    pub fn add_person(&mut self, person: Itinerary) {
        self.travellers.add(person);
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
        self.travellers.feed(traffic, &self.present);
        for trip in traffic.ended() {
            self.present.remove(&trip.id);
        }
        while let Some((time, index)) = take_due(&mut self.due, now) {
            let Some(departing) = self.departing[index].take() else { continue };
            let Departing { name, route, vehicle, stops, line, .. } = departing;
            let number = traffic.insert_stopping(route, vehicle, time, stops)?;
            self.outside.insert(number, [name.clone(), name, line]);
            count += 1;
        }
        while let Some((time, index)) = take_due(&mut self.next_of_series, now) {
            let series = &mut self.series[index];
            let name = format!("{}.{}", series.name, series.drawn);
            series.drawn += 1;
            let next = time + series.wait();
            if series.drawn < series.number && next < series.flow.until {
                self.next_of_series.push(due(next, index));
            }
            let series = &self.series[index];
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

    /// Takes note of who entered in the last step.
    fn welcome(&mut self, traffic: &Traffic) {
        for (id, number) in traffic.admitted() {
            if let Some(names) = number.and_then(|number| self.outside.remove(&number)) {
                self.present.insert(id, names);
            }
        }
    }
}

fn take_due(heap: &mut BinaryHeap<Due>, now: f64) -> Option<(f64, usize)> {
    let Reverse((bits, _)) = heap.peek()?;
    if f64::from_bits(*bits) > now {
        return None;
    }
    heap.pop().map(|Reverse((bits, index))| (f64::from_bits(bits), index))
}

impl Series {
    /// Time to the next of them, s.
    fn wait(&self) -> f64 {
        let rate = self.flow.per_hour / 3600.0;
        let mut rng: StreamRng = self.stream.indexed(self.drawn).rng();
        match self.flow.arrivals {
            Arrivals::Uniform => 1.0 / rate,
            Arrivals::Poisson => rng.exponential(rate),
        }
    }
}
