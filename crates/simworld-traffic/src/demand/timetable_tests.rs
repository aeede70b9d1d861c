//! Journeys are the quickest that there are: beside every other with two rides at most.

use simworld_core::id::RoadId;
use simworld_core::net::{LaneDirection, NetworkConfig, RoadNetwork, StreetPlan};
use simworld_core::seed::{Seed, StreamRng};

use super::*;

fn grid() -> RoadNetwork {
    RoadNetwork::derive(&StreetPlan::grid(4, 4, 800.0), &NetworkConfig::default()).unwrap()
}

/// A line over a way between two legs that halts in the middle of each leg.
fn service(network: &RoadNetwork, line: usize, ends: (u32, u32), departures: Departures) -> Option<Service> {
    let leg = |end: u32| {
        let direction = if end.is_multiple_of(2) { LaneDirection::Forward } else { LaneDirection::Backward };
        Leg::new(RoadId(end / 2 % network.roads.len() as u32), direction)
    };
    let route = Router::new(network).quickest(leg(ends.0), leg(ends.1))?;
    let stops = route.0.iter().map(|leg| Stop::new(*leg, 150.0, 15.0)).collect();
    Some(Service { line: format!("{line}"), route, stops, departures })
}

/// When one is there by walks, rides and walks, at the earliest: every pair of halts of every line, and of every two.
fn earliest(table: &Timetable, from: Point2, to: Point2, at: f64) -> f64 {
    fn on(table: &Timetable, from: Point2, to: Point2, at: f64, rides: usize) -> f64 {
        let mut best = at + walk(from, to);
        if rides == 0 {
            return best;
        }
        for (service, halts) in &table.services {
            for (index, entry) in halts.iter().enumerate() {
                let there = at + walk(from, table.places[entry.place].point);
                let Some(departure) = service.departures.from(there - entry.leaves) else { continue };
                for exit in &halts[index + 1..] {
                    let out = table.places[exit.place].point;
                    best = best.min(on(table, out, to, departure + exit.arrives, rides - 1));
                }
            }
        }
        best
    }
    on(table, from, to, at, 2)
}

/// When stages end that begin at a time, as their timetable says.
fn end(table: &Timetable, stages: &[Stage], from: Point2, to: Point2, at: f64) -> f64 {
    let (mut clock, mut here, mut rides) = (at, from, 0);
    for stage in stages {
        match stage {
            Stage::Walk { from, to } => {
                assert!((from - here).norm() <= HERE, "a walk begins where one is");
                (clock, here) = (clock + walk(*from, *to), *to);
            }
            Stage::Ride { from, to, lines } => {
                let of_line = table.services.iter().filter(|(service, _)| lines.contains(&service.line));
                let arrivals = of_line.filter_map(|(service, halts)| {
                    let kerb = |halt: &&Halt| table.places[halt.place].kerb;
                    let entry = halts.iter().find(|halt| kerb(halt) == *from)?;
                    let exit = halts.iter().find(|halt| kerb(halt) == *to)?;
                    let point = table.places[entry.place].point;
                    assert!((point - here).norm() <= HERE, "one gets in where one is");
                    Some((
                        service.departures.from(clock - entry.leaves)? + exit.arrives,
                        table.places[exit.place].point,
                    ))
                });
                (clock, here) = arrivals.min_by(|a, b| a.0.total_cmp(&b.0)).expect("one comes");
                rides += 1;
            }
            other => panic!("{other:?}"),
        }
    }
    assert!(rides <= RIDES && (to - here).norm() <= HERE);
    clock
}

/// Six to nine lines across the grid, every half a minute to four minutes.
fn lines(network: &RoadNetwork, rng: &mut StreamRng) -> Vec<Service> {
    (0..6 + rng.below(4))
        .filter_map(|line| {
            let departures = Departures {
                first: rng.uniform(0.0, 300.0),
                headway: rng.uniform(30.0, 240.0),
                until: 3000.0,
                number: 1 + rng.below(20) as u64,
            };
            service(network, line, (rng.below(48) as u32, rng.below(48) as u32), departures)
        })
        .collect()
}

#[test]
fn no_other_journey_is_quicker() {
    let network = grid();
    let mut with_rides = [0; RIDES + 1];
    for case in 0..150 {
        let mut rng = Seed(case).stream("journeys").rng();
        let services = lines(&network, &mut rng);
        let table = Timetable::new(&network, &services);
        assert_eq!(table.services.len(), services.len());
        let mut point = || Point2::new(rng.uniform(0.0, 2400.0), rng.uniform(0.0, 2400.0));
        let (from, to) = (point(), point());
        let at = rng.uniform(0.0, 600.0);
        let (_, stages) = table.journey(from, to, at);
        let (takes, least) = (end(&table, &stages, from, to, at), earliest(&table, from, to, at));
        // Up to steps that are so short that nobody walks them.
        assert!(takes <= least + 2.0, "case {case}: {takes} s for {least}: {stages:?}");
        with_rides[stages.iter().filter(|stage| matches!(stage, Stage::Ride { .. })).count()] += 1;
    }
    assert!(with_rides[..3].iter().all(|cases| *cases > 5), "{with_rides:?}");
}

#[test]
fn times_are_those_of_the_router_and_the_halts() {
    let network = grid();
    let departures = Departures { first: 100.0, headway: 300.0, until: 1000.0, number: 9 };
    let service = service(&network, 7, (0, 21), departures).unwrap();
    let table = Timetable::new(&network, std::slice::from_ref(&service));
    let halts = &table.services[0].1;
    assert!(halts.len() > 3 && table.places.len() == halts.len());
    let driven: f64 = halts.windows(2).map(|pair| pair[1].arrives - pair[0].leaves).sum();
    let route = Router::new(&network).time(&service.route).unwrap();
    // From the middle of the first leg to that of the last, where the router goes from end to end: all legs are alike.
    assert!((driven / route - 1.0).abs() < 0.05, "{driven} s and {route} s");
    assert!(halts.iter().all(|halt| (halt.leaves - halt.arrives - 15.0).abs() < 1e-9));
    assert_eq!(
        [0.0, 100.0, 100.1, 650.0, 999.0].map(|time| departures.from(time)),
        [Some(100.0), Some(100.0), Some(400.0), Some(700.0), None],
        "no more from 1000 s on"
    );
}
