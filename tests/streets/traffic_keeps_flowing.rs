//! No gridlock: cities at moderate demand keep their speed and their throughput, nobody is lost, and whoever is stuck comes free.
//!
//! Whole, with `SIMWORLD_SOAK=1`, it is four hours of ten grown cities and of three real ones, whose extracts `SIMWORLD_DATA` names.

use std::fmt;
use std::sync::Arc;

use simworld_core::net::RoadNetwork;
use simworld_core::seed::Seed;
use simworld_tests::traffic::{Trips, each_case, grown, is_whole, lane_kilometres, real};
use simworld_traffic::signal::Actuated;
use simworld_traffic::vehicle::VehicleKind;
use simworld_traffic::{Traffic, TrafficConfig};

const DT: f64 = 0.1;
/// The real places.
const PLACES: [&str; 3] = ["monaco.osm.gz", "helsinki.osm.pbf", "campo-grande.osm.gz"];
/// Vehicles on a kilometre of lane: as on the grids on which simulators are compared.
const DENSITY: f64 = 7.5;
/// Nobody stands for longer, s.
const STUCK: f64 = 1200.0;

/// What was seen in a part of the run.
struct Part {
    /// Mean speed of all, m/s.
    speed: f64,
    crossings: u64,
    arrived: u64,
}

/// What was seen of a city.
struct Seen {
    name: String,
    vehicles: usize,
    parts: Vec<Part>,
    /// The longest that anybody stood, s.
    stood: f64,
    locks: u64,
    long_waits: u64,
}

/// Keeps so many vehicles on trips: whoever arrives is followed by another.
struct Demand {
    trips: Trips,
    wanted: usize,
    sent: u64,
}

impl Demand {
    fn keep(&mut self, traffic: &mut Traffic) {
        let present = traffic.vehicles().count() + traffic.outside();
        // At most a few at a time, so that they do not all begin together.
        for _ in present..self.wanted.min(present + 1 + self.wanted / 60) {
            let route = self.trips.route(self.sent);
            self.sent += 1;
            traffic.insert(route, VehicleKind::Car).expect("the router's routes can be driven");
        }
    }
}

/// So many who turn at random; whoever comes on a trip knows how long the streets take, as most do who drive today.
fn turning(network: &Arc<RoadNetwork>, vehicles: u32) -> Traffic {
    let config = TrafficConfig { vehicles, pedestrians: 0, informed: 1.0, ..TrafficConfig::default() };
    let mut traffic = Traffic::new(Arc::clone(network), &config, Seed(1)).expect("the settings are in range");
    traffic.set_policy(Box::new(Actuated::default()));
    traffic
}

/// Four hours of a city, or some minutes, in four parts: some turn at random, the others are on trips.
fn run(name: &str, network: &Arc<RoadNetwork>, minutes: f64) -> Seen {
    let wanted = (DENSITY * lane_kilometres(network)) as usize;
    let mut traffic = turning(network, wanted as u32 / 4);
    let placed = u64::from(traffic.placed().vehicles);
    let mut demand = Demand { trips: Trips::new(network), wanted, sent: 0 };
    let mut since: Vec<f64> = Vec::new();
    let mut seen = Seen {
        name: name.to_owned(),
        vehicles: wanted,
        parts: Vec::new(),
        stood: 0.0,
        locks: 0,
        long_waits: 0,
    };
    // A fifth of the time for it to fill.
    let part = (minutes * 600.0 / 5.0) as u64;
    for number in 0..5 {
        let before = traffic.counters();
        let (mut speeds, mut count) = (0.0, 0.0);
        for step in 0..part {
            if step % 10 == 0 {
                demand.keep(&mut traffic);
            }
            traffic.step(DT);
            let now = traffic.seconds();
            // Who enters may have the number of somebody who left.
            for id in traffic.entered() {
                since.resize(since.len().max(*id as usize + 1), now);
                since[*id as usize] = now;
            }
            if step % 10 != 0 {
                continue;
            }
            for (id, _, _, v) in traffic.stations() {
                since.resize(since.len().max(id as usize + 1), now);
                if v > 0.1 {
                    since[id as usize] = now;
                }
                seen.stood = seen.stood.max(now - since[id as usize]);
                (speeds, count) = (speeds + v, count + 1.0);
            }
        }
        let counters = traffic.counters();
        let present = traffic.vehicles().count() as u64;
        assert_eq!(
            placed + counters.entered,
            present + counters.arrived + counters.removed,
            "{name}: {counters:?}"
        );
        assert_eq!(counters.removed, 0, "{name}: nobody gives up");
        let (crossings, arrived) = (counters.crossings - before.crossings, counters.arrived - before.arrived);
        if number > 0 {
            seen.parts.push(Part { speed: speeds / count, crossings, arrived });
        }
        (seen.locks, seen.long_waits) = (counters.locks, counters.long_waits);
    }
    println!("{seen}");
    seen
}

impl fmt::Display for Seen {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, vehicles, stood, locks, long_waits, .. } = self;
        write!(f, "{name}, {vehicles} vehicles:")?;
        for Part { speed, crossings, arrived } in &self.parts {
            write!(f, " {speed:.2} m/s, {crossings} crossings, {arrived} trips;")?;
        }
        write!(f, " {long_waits} waited three minutes, at most {stood:.0} s; {locks} locks")
    }
}

/// Whether it flows at the end as at the beginning.
fn flows(seen: &Seen) -> bool {
    let (Some(first), Some(last)) = (seen.parts.first(), seen.parts.last()) else { return false };
    let keeps = |last: f64, first: f64| last > 0.7 * first;
    last.speed > 2.5
        && keeps(last.speed, first.speed)
        && keeps(last.crossings as f64, first.crossings as f64)
        && keeps(last.arrived as f64, first.arrived as f64)
        && seen.stood < STUCK
}

#[test]
fn cities_keep_flowing() {
    let (cities, minutes) = (if is_whole() { 10 } else { 2 }, 240.0);
    let seen = each_case(cities + PLACES.len(), |case| match case.checked_sub(cities) {
        None => Some(run(&format!("city {case}"), &grown(case, 150), minutes)),
        Some(place) if is_whole() => Some(run(PLACES[place], &real(PLACES[place])?, minutes)),
        Some(_) => None,
    });
    let stuck: Vec<String> =
        seen.iter().flatten().filter(|seen| !flows(seen)).map(ToString::to_string).collect();
    assert!(stuck.is_empty(), "{stuck:#?}");
}
