//! Nobody touches anybody and nobody runs a red, in many cities, in all weathers, while roads and lanes close and open again.
//!
//! Whole, with `SIMWORLD_SOAK=1`, it is ten million vehicle-seconds over fifty cities.

use std::collections::BTreeSet;

use simworld_core::environment::Weather;
use simworld_core::id::LaneId;
use simworld_core::net::Aspect;
use simworld_core::seed::{Seed, StreamRng};
use simworld_tests::traffic::{each_case, grown, is_whole, lane_kilometres, touching};
use simworld_traffic::signal::{Actuated, FixedTime, MaxPressure, SignalPolicy};
use simworld_traffic::vehicle::VehicleKind;
use simworld_traffic::{Closed, Closure, DrivingConditions, Leg, Traffic, TrafficConfig};

const DT: f64 = 0.1;

/// What was seen of a city.
struct Seen {
    city: usize,
    vehicle_seconds: f64,
    /// Pairs that touched, with when.
    touched: BTreeSet<(u32, u32)>,
    first: Option<f64>,
    /// Entries at red beyond those that the brakes could not prevent.
    reds: u64,
    crossings: u64,
}

/// A weather of each kind.
fn weather(number: usize) -> Weather {
    let clear = Weather::default();
    match number % 6 {
        0 => clear,
        1 => Weather { rain: 2.0, ..clear },
        2 => Weather { rain: 30.0, ..clear },
        3 => Weather { snow: 3.0, temperature: -3.0, ..clear },
        4 => Weather { visibility: 120.0, ..clear },
        _ => Weather { rain: 1.0, temperature: -1.0, ..clear },
    }
}

fn policy(number: usize) -> Box<dyn SignalPolicy + Send> {
    match number % 3 {
        0 => Box::new(FixedTime),
        1 => Box::new(Actuated::default()),
        _ => Box::new(MaxPressure::default()),
    }
}

/// Closes a road, a lane or a stretch of a lane for some minutes.
fn close_something(traffic: &mut Traffic, rng: &mut StreamRng) {
    let network = traffic.network();
    let lane = LaneId::from_index(rng.below(network.lanes.len()));
    let length = network.lanes[lane.index()].length;
    let what = match rng.below(3) {
        0 => Closed::Lane(lane),
        1 if length > 60.0 => Closed::Stretch(lane, 30.0, 45.0),
        _ => Closed::Leg(Leg::of(network, lane)),
    };
    let from = traffic.seconds();
    let closure = Closure { what, from, until: from + rng.uniform(20.0, 180.0) };
    traffic.close(closure).expect("it is a lane of the network");
}

fn drive(city: usize, vehicle_seconds: f64) -> Seen {
    let network = grown(city, 60 + 10 * (city as u32 % 7));
    let vehicles = (10.0 * lane_kilometres(&network)) as u32;
    let config = TrafficConfig { vehicles, pedestrians: 60, ..TrafficConfig::default() };
    let mut traffic = Traffic::new(network, &config, Seed(city as u64)).expect("the settings are in range");
    traffic.set_policy(policy(city));
    let network = std::sync::Arc::clone(traffic.network());
    let lanes = network.lanes.len() as u32;
    let mut rng = Seed(city as u64).stream("soak/closures").rng();
    let mut tracks = vec![u32::MAX; traffic.placed().vehicles as usize];
    let sirens: BTreeSet<u32> =
        traffic.vehicles().filter(|body| body.kind == VehicleKind::Emergency).map(|body| body.id).collect();
    let mut bodies = Vec::new();
    let mut seen =
        Seen { city, vehicle_seconds: 0.0, touched: BTreeSet::new(), first: None, reds: 0, crossings: 0 };
    let mut step = 0_u64;
    while seen.vehicle_seconds < vehicle_seconds {
        if step.is_multiple_of(3000) {
            let conditions = DrivingConditions::from_weather(&weather(city + step as usize / 3000));
            traffic.set_conditions(conditions).expect("weather makes conditions");
        }
        if step % 600 == 300 {
            close_something(&mut traffic, &mut rng);
        }
        let aspects = traffic.signals().to_vec();
        traffic.step(DT);
        step += 1;
        for (id, track, _, _) in traffic.stations() {
            let before = std::mem::replace(&mut tracks[id as usize], track);
            if track >= lanes && before < lanes {
                let way = &network.connections[(track - lanes) as usize];
                let red = way.signal.is_some_and(|group| aspects[group.index()] == Aspect::Red);
                seen.reds += u64::from(red && !sirens.contains(&id));
            }
        }
        for pair in touching(&traffic, &mut bodies) {
            seen.first.get_or_insert(traffic.seconds());
            seen.touched.insert(pair);
        }
        seen.vehicle_seconds += bodies.len() as f64 * DT;
    }
    let counters = traffic.counters();
    seen.crossings = counters.crossings;
    // Who cannot stop any more when the light turns is no offender.
    seen.reds = seen.reds.saturating_sub(counters.dilemmas);
    seen
}

#[test]
fn nobody_touches_anybody_and_nobody_runs_a_red() {
    let (cities, vehicle_seconds) = if is_whole() { (50, 1e7) } else { (4, 4e4) };
    let share = vehicle_seconds / f64::from(cities);
    let seen = each_case(cities as usize, |city| drive(city, share));
    let sum: f64 = seen.iter().map(|seen| seen.vehicle_seconds).sum();
    let crossings: u64 = seen.iter().map(|seen| seen.crossings).sum();
    println!("{} cities, {sum:.0} vehicle-seconds, {crossings} leaves to cross", seen.len());
    assert!(crossings as f64 > sum / 60.0, "traffic flows");
    let bad = seen.iter().filter(|seen| !seen.touched.is_empty() || seen.reds > 0);
    let bad: Vec<String> = bad
        .map(|Seen { city, touched, first, reds, .. }| {
            format!("city {city}: {touched:?} touch, first at {first:?} s; {reds} reds")
        })
        .collect();
    assert!(bad.is_empty(), "{bad:#?}");
}
