//! Timetables: when lines halt where, and the quickest journey by them and on foot.
//!
//! Rounds of rides, as in RAPTOR (Delling, Pajor and Werneck, *Round-Based Public Transit Routing*, 2012): each round finds out how early one
//! is at each stop with one ride more, by looking once along every line.

use std::collections::BTreeMap;

use simworld_core::geometry::Point2;
use simworld_core::id::LaneId;
use simworld_core::net::{RoadNetwork, polyline};

use super::itinerary::{Kerb, Stage};
use crate::{Leg, Route, Router, Stop};

/// Rides of one journey at most.
const RIDES: usize = 4;

/// How fast one walks when ways are compared, m/s (Weidmann 1993).
const WALKING: f64 = 1.34;

/// Who is so near, m, need not walk.
const HERE: f64 = 1.0;

/// When those of a line depart, s.
#[derive(Clone, Copy, Debug)]
pub(super) struct Departures {
    pub(super) first: f64,
    /// Between two of them; the mean if they come at random.
    pub(super) headway: f64,
    /// No more depart from then on.
    pub(super) until: f64,
    /// At most so many.
    pub(super) number: u64,
}

impl Departures {
    /// The first departure at a time or later.
    fn from(&self, time: f64) -> Option<f64> {
        let before = ((time - self.first) / self.headway).ceil().max(0.0);
        let departure = self.first + before * self.headway;
        (before < self.number as f64 && departure < self.until).then_some(departure)
    }
}

/// Vehicles of one line on one way.
#[derive(Clone, Debug)]
pub(super) struct Service {
    pub(super) line: String,
    pub(super) route: Route,
    pub(super) stops: Vec<Stop>,
    pub(super) departures: Departures,
}

/// Where and when a service halts, s after its departure.
#[derive(Clone, Copy, Debug)]
struct Halt {
    place: usize,
    arrives: f64,
    leaves: f64,
}

/// A place where lines halt.
#[derive(Clone, Copy, Debug)]
struct Place {
    kerb: Kerb,
    point: Point2,
}

/// How one came to a place.
#[derive(Clone, Copy, Debug)]
enum Reached {
    /// On foot from where the journey begins.
    OnFoot,
    /// On foot from another place.
    From(usize),
    /// By a service, from a place at which one was by the round before.
    By { service: usize, from: usize },
}

/// How early one is at a place, s, how one came there, and in which round.
#[derive(Clone, Copy, Debug)]
struct Label {
    time: f64,
    reached: Reached,
    round: usize,
}

/// The lines of a schedule on a network.
#[derive(Clone, Debug)]
pub(super) struct Timetable {
    places: Vec<Place>,
    services: Vec<(Service, Vec<Halt>)>,
}

impl Timetable {
    /// Free travel times between halts; a service whose way does not lead on is left out.
    pub(super) fn new(network: &RoadNetwork, services: &[Service]) -> Self {
        let mut table = Self { places: Vec::new(), services: Vec::new() };
        if services.is_empty() {
            // A router looks at the whole network.
            return table;
        }
        let router = Router::new(network);
        let mut numbers: BTreeMap<(Leg, u64), usize> = BTreeMap::new();
        for service in services {
            let Some(times) = times(network, &router, service) else { continue };
            let halts = service.stops.iter().zip(times).map(|(stop, (arrives, leaves))| {
                let kerb = (stop.leg, stop.station);
                let place = *numbers.entry((stop.leg, stop.station.to_bits())).or_insert_with(|| {
                    table.places.push(Place { kerb, point: beside(network, kerb) });
                    table.places.len() - 1
                });
                Halt { place, arrives, leaves }
            });
            let halts = halts.collect();
            table.services.push((service.clone(), halts));
        }
        table
    }

    /// When the quickest journey ends that begins at a time, s, and its stages: walks along straight lines, rides by the timetable.
    pub(super) fn journey(&self, from: Point2, to: Point2, at: f64) -> (f64, Vec<Stage>) {
        let afoot =
            |place: &Place| Label { time: at + walk(from, place.point), reached: Reached::OnFoot, round: 0 };
        let mut rounds: Vec<Vec<Label>> = vec![self.places.iter().map(afoot).collect()];
        for round in 1..=RIDES {
            let before = &rounds[round - 1];
            let Some(next) = self.ride(before, round) else { break };
            rounds.push(next);
        }
        let mut best = (at + walk(from, to), None);
        for (round, labels) in rounds.iter().enumerate().skip(1) {
            for (place, label) in labels.iter().enumerate() {
                let time = label.time + walk(self.places[place].point, to);
                if label.round == round && time < best.0 {
                    best = (time, Some((round, place)));
                }
            }
        }
        (best.0, self.stages(&rounds, best.1, from, to))
    }

    /// How early one is everywhere with one ride more; `None` if nowhere any earlier.
    fn ride(&self, before: &[Label], round: usize) -> Option<Vec<Label>> {
        let mut labels = before.to_vec();
        for (number, (service, halts)) in self.services.iter().enumerate() {
            let mut aboard: Option<(usize, f64)> = None;
            for halt in halts {
                if let Some((from, departure)) = aboard
                    && departure + halt.arrives < labels[halt.place].time
                {
                    let reached = Reached::By { service: number, from };
                    labels[halt.place] = Label { time: departure + halt.arrives, reached, round };
                }
                let departure = service.departures.from(before[halt.place].time - halt.leaves);
                if let Some(departure) = departure
                    && aboard.is_none_or(|(_, later)| departure < later)
                {
                    aboard = Some((halt.place, departure));
                }
            }
        }
        let got_out: Vec<usize> = (0..labels.len()).filter(|place| labels[*place].round == round).collect();
        for from in &got_out {
            for to in 0..labels.len() {
                let time = labels[*from].time + walk(self.places[*from].point, self.places[to].point);
                if time < labels[to].time {
                    labels[to] = Label { time, reached: Reached::From(*from), round };
                }
            }
        }
        (!got_out.is_empty()).then_some(labels)
    }

    /// The stages that lead to a place by a round, and on to the goal.
    fn stages(
        &self,
        rounds: &[Vec<Label>],
        last: Option<(usize, usize)>,
        from: Point2,
        to: Point2,
    ) -> Vec<Stage> {
        // From the end: each stage begins where the one before it in time ends.
        let (mut stages, mut here, mut next) = (Vec::new(), to, last);
        while let Some((round, place)) = next {
            let label = rounds[round][place];
            walk_here(&mut stages, self.places[place].point, here);
            here = self.places[place].point;
            next = match label.reached {
                Reached::OnFoot => None,
                Reached::From(other) => Some((label.round, other)),
                Reached::By { service, from } => {
                    let lines = vec![self.services[service].0.line.clone()];
                    let (a, b) = (self.places[from], self.places[place]);
                    stages.push(Stage::Ride { from: a.kerb, to: b.kerb, lines });
                    here = a.point;
                    Some((label.round - 1, from))
                }
            };
        }
        walk_here(&mut stages, from, here);
        stages.reverse();
        stages
    }
}

/// A walk, where it is one.
pub(super) fn walk_here(stages: &mut Vec<Stage>, from: Point2, here: Point2) {
    if (here - from).norm() > HERE {
        stages.push(Stage::Walk { from, to: here });
    }
}

/// Time on foot between two points, s.
pub(super) fn walk(from: Point2, to: Point2) -> f64 {
    (to - from).norm() / WALKING
}

/// When a service comes to its stops, and when it leaves them, s after its departure at the beginning of its first leg.
fn times(network: &RoadNetwork, router: &Router, service: &Service) -> Option<Vec<(f64, f64)>> {
    let legs = &service.route.0;
    let (mut times, mut clock, mut at, mut station) = (Vec::new(), 0.0, 0, 0.0);
    for stop in &service.stops {
        while legs.get(at).is_some_and(|leg| *leg != stop.leg) {
            let (this, next) = (legs[at], *legs.get(at + 1)?);
            // The router's time is that of the way between them and of the next leg.
            let between = router.time(&Route(vec![this, next]))? - driven(network, next, 0.0, f64::INFINITY)?;
            clock += driven(network, this, station, f64::INFINITY)? + between.max(0.0);
            (at, station) = (at + 1, 0.0);
        }
        clock += driven(network, *legs.get(at)?, station, stop.station)?;
        let leaves = (clock + stop.dwell).max(stop.not_before);
        times.push((clock, leaves));
        (clock, station) = (leaves, stop.station);
    }
    Some(times)
}

/// The time along the outermost lane of a leg from one station to another at most, s.
pub(super) fn driven(network: &RoadNetwork, leg: Leg, from: f64, to: f64) -> Option<f64> {
    let lane = &network.lanes[leg.lanes(network).last()?.index()];
    Some((to.min(lane.length) - from).max(0.0) / lane.speed_limit)
}

/// Where a kerb is: on the outermost lane of its leg; people find the nearest walkway.
pub(crate) fn beside(network: &RoadNetwork, (leg, station): Kerb) -> Point2 {
    let lane = leg.lanes(network).last().copied().unwrap_or(LaneId(0));
    polyline::at(&network.lanes[lane.index()].path, station).0
}

#[cfg(test)]
#[path = "timetable_tests.rs"]
mod tests;
