//! Traffic against the figures that engineers trust: saturation flow, lost time, delay at a fixed signal, green waves,
//! turning shares. Tolerances that no manual gives are ours.

use std::sync::Arc;

use simworld_core::geometry::Point2;
use simworld_core::id::{IntersectionId, RoadId};
use simworld_core::net::{Aspect, LaneDirection, NetworkConfig, RoadNetwork, Street, StreetPlan, Turn};
use simworld_core::seed::Seed;
use simworld_traffic::signal::green_wave;
use simworld_traffic::vehicle::VehicleKind;
use simworld_traffic::{Arrivals, Flow, Leg, Route, Traffic, TrafficConfig};

const DT: f64 = 0.1;

/// Drivers who all keep to the limit: what the formulae suppose.
fn empty() -> TrafficConfig {
    let mut config = TrafficConfig { vehicles: 0, pedestrians: 0, ..TrafficConfig::default() };
    config.types.iter_mut().for_each(|row| row.speed_deviation = 0.0);
    config
}

fn crossroads(arm: f64) -> Arc<RoadNetwork> {
    Arc::new(
        RoadNetwork::derive(&StreetPlan::crossroads(arm), &NetworkConfig::default())
            .expect("a crossroads is a network"),
    )
}

/// In on the first arm and straight out on the third.
fn across() -> Route {
    let inwards = Leg::new(RoadId(0), LaneDirection::Backward);
    Route(vec![inwards, Leg::new(RoadId(2), LaneDirection::Forward)])
}

/// A crossroads whose first arm is red for `red` s, green for `green` s, and so on; its plan has no walkers' clearance.
fn signalised(arm: f64, red: f64, green: f64) -> (Traffic, f64) {
    let mut traffic = Traffic::new(crossroads(arm), &empty(), Seed(1)).expect("the settings are in range");
    let network = Arc::clone(traffic.network());
    let lane = network.roads[0].backward[0];
    let ours = network.lanes[lane.index()].outgoing[0];
    let group = network.connections[ours.index()].signal.expect("a crossroads of four has signals");
    let mut plans = traffic.plans().to_vec();
    let plan = &mut plans[0];
    plan.phases.retain(|phase| phase.yellow.is_empty() || phase.green.is_empty());
    let yellow: f64 =
        plan.phases.iter().map(|p| if p.yellow.is_empty() { 0.0 } else { p.duration }).sum::<f64>() / 2.0;
    let all_red = 2.0;
    for phase in plan.phases.iter_mut().filter(|phase| !phase.green.is_empty()) {
        // The other stage and both endings together are red to us.
        let ours = phase.green.contains(&group);
        phase.duration = if ours { green } else { red - yellow - 2.0 * all_red - yellow };
    }
    // Time begins with our red.
    let mut begins = 0.0;
    for phase in &plan.phases {
        if phase.yellow.contains(&group) {
            begins += phase.duration;
            break;
        }
        begins += phase.duration;
    }
    plan.offset = begins;
    traffic.set_plans(plans).expect("the plan is for the same groups");
    (traffic, yellow)
}

/// Times at which vehicles pass the stop line of the first arm.
fn passes(traffic: &mut Traffic, steps: usize) -> (f64, Vec<f64>) {
    let lane = traffic.network().roads[0].backward[0].0;
    let lanes = traffic.network().lanes.len() as u32;
    let mut waiting: Vec<u32> = Vec::new();
    let (mut passed, mut green_at) = (Vec::new(), f64::NAN);
    for _ in 0..steps {
        traffic.step(DT);
        let group = traffic.network().lanes[lane as usize].outgoing[0];
        let signal = traffic.network().connections[group.index()].signal.expect("it has signals");
        if green_at.is_nan() && traffic.signals()[signal.index()] == Aspect::Green {
            green_at = traffic.seconds();
        }
        let now: Vec<(u32, u32)> = traffic.stations().map(|(id, track, _, _)| (id, track)).collect();
        for (id, track) in now {
            let before = waiting.iter().position(|other| *other == id);
            if track == lane && before.is_none() {
                waiting.push(id);
            } else if let (true, Some(index)) = (track >= lanes, before) {
                waiting.remove(index);
                passed.push(traffic.seconds());
            }
        }
    }
    (green_at, passed)
}

/// Highway Capacity Manual: 1900 vehicles an hour and lane, and two seconds lost at the start.
#[test]
fn a_queue_discharges_as_the_manual_says() {
    let (mut traffic, _) = signalised(320.0, 150.0, 90.0);
    for _ in 0..22 {
        traffic.insert(across(), VehicleKind::Car).expect("the route is sound");
    }
    let (green, passed) = passes(&mut traffic, 2300);
    assert!(passed.len() >= 22, "{} of 22 passed", passed.len());
    let saturation = (passed[21] - passed[9]) / 12.0;
    let flow = 3600.0 / saturation;
    assert!((flow / 1900.0 - 1.0).abs() < 0.05, "saturation flow {flow:.0} veh/h");
    let lost = passed[3] - green - 4.0 * saturation;
    assert!((lost - 2.0).abs() < 0.6, "start-up lost time {lost:.2} s");
    println!("saturation flow {flow:.0} veh/h, start-up lost time {lost:.2} s");
    let headway = |n: usize| passed[n] - passed[n - 1];
    assert!(headway(1) > headway(4) - 0.2 && headway(4) > headway(12) - 0.2, "headways fall and settle");
}

/// Uniform delay d1 = 0.5 C (1 - λ)² / (1 - x λ) (Webster 1958; Highway Capacity Manual).
#[test]
fn delay_at_a_fixed_signal_is_websters() {
    const SATURATION: f64 = 1890.0;
    for (red, green, per_hour) in [(40.0, 40.0, 400.0), (40.0, 40.0, 700.0), (55.0, 35.0, 500.0)] {
        let (mut traffic, yellow) = signalised(320.0, red, green);
        let flow = Flow {
            arrivals: Arrivals::Uniform,
            kind: Some(VehicleKind::Car),
            ..Flow::new(across(), per_hour)
        };
        traffic.add_flow(flow).expect("the route is sound");
        let (mut sum, mut count) = (0.0, 0.0);
        for step in 0..54_000 {
            traffic.step(DT);
            for trip in traffic.ended().iter().filter(|_| step > 6000) {
                sum += trip.delay();
                count += 1.0;
            }
        }
        let cycle = red + green + yellow;
        // Drivers lose two seconds at the start and use most of the yellow.
        let effective = green + yellow - 3.0;
        let share = effective / cycle;
        let load = per_hour / (SATURATION * share);
        let expected = 0.5 * cycle * (1.0 - share) * (1.0 - share) / (1.0 - load * share);
        let found = sum / count;
        println!("cycle {cycle} s, load {load:.2}: delay {found:.1} s, by the formula {expected:.1} s");
        // What the formula leaves out is the time lost braking and pulling away again.
        assert!(
            (found / expected - 1.0).abs() < 0.25,
            "cycle {cycle} s, load {load:.2}: {found:.1} s instead of {expected:.1} s"
        );
    }
}

#[test]
fn a_green_wave_carries_a_platoon() {
    // A street with three crossings, 260 m apart.
    let nodes = (0..5).map(|i| Point2::new(f64::from(i) * 260.0, 0.0)).collect();
    let mut plan = StreetPlan { nodes, ..StreetPlan::default() };
    for i in 0..4 {
        plan.streets.push(Street::simple(i, i + 1));
    }
    for i in 1..4 {
        for y in [-120.0, 120.0] {
            plan.nodes.push(Point2::new(i as f64 * 260.0, y));
            plan.streets.push(Street::simple(i, plan.nodes.len() - 1));
        }
    }
    let network =
        Arc::new(RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("a street is a network"));
    let route = Route((0..4).map(|road| Leg::new(RoadId(road), LaneDirection::Forward)).collect());
    let way: Vec<IntersectionId> = (0..4).map(IntersectionId).collect();
    let stops = |shift: f64| {
        let mut traffic = Traffic::new(Arc::clone(&network), &empty(), Seed(2)).expect("in range");
        let mut plans = traffic.plans().to_vec();
        assert_eq!(green_wave(&network, &way, 11.5, &mut plans), 3);
        let cycle = plans[0].cycle();
        for (rank, plan) in plans.iter_mut().enumerate() {
            plan.offset += shift * rank as f64 * cycle;
        }
        traffic.set_plans(plans).expect("the plans are for the same groups");
        let mut standing = std::collections::BTreeSet::new();
        let mut sent = 0;
        for step in 0..6000_u32 {
            // Five at the beginning of every cycle, as the first green sends them on.
            if (f64::from(step) * DT).rem_euclid(cycle) < DT {
                for _ in 0..5 {
                    traffic.insert(route.clone(), VehicleKind::Car).expect("the route is sound");
                    sent += 1;
                }
            }
            traffic.step(DT);
            for (id, track, _, v) in traffic.stations() {
                // Beyond the first crossing, which meters them.
                let lane = network.lanes.get(track as usize);
                if v < 0.1 && lane.is_some_and(|lane| lane.road.0 == 1 || lane.road.0 == 2) {
                    standing.insert((id, step / 600));
                }
            }
        }
        standing.len() as f64 / f64::from(sent)
    };
    let (tuned, against) = (stops(0.0), stops(0.5));
    println!("in the wave {tuned:.2} of the platoon stop, in anti-phase {against:.2}");
    assert!(tuned < 0.1, "{tuned:.2} of the platoon stops in the wave");
    assert!(against > 0.8, "in anti-phase {against:.2} stop");
}

/// Turns are drawn by their weights: a chi-square test with two degrees of freedom, 13.8 at the 0.1 % level.
#[test]
fn turning_shares_are_the_weights() {
    let config =
        TrafficConfig { vehicles: 40, pedestrians: 0, turns: [0.5, 0.3, 0.2], ..TrafficConfig::default() };
    let network = crossroads(150.0);
    let mut traffic = Traffic::new(Arc::clone(&network), &config, Seed(6)).expect("in range");
    let lanes = network.lanes.len();
    let mut before = vec![u32::MAX; 64];
    let mut turns = [0.0_f64; 3];
    for _ in 0..60_000 {
        traffic.step(DT);
        for (id, track, _, _) in traffic.stations() {
            let old = std::mem::replace(&mut before[id as usize], track);
            if old == track || (track as usize) < lanes {
                continue;
            }
            match network.connections[track as usize - lanes].turn {
                Turn::Straight => turns[0] += 1.0,
                Turn::Right => turns[1] += 1.0,
                Turn::Left => turns[2] += 1.0,
                Turn::UTurn => {}
            }
        }
    }
    let total: f64 = turns.iter().sum();
    assert!(total > 2000.0, "{total} turns");
    let chi: f64 = turns
        .iter()
        .zip([0.5, 0.3, 0.2])
        .map(|(count, share)| (count - total * share) * (count - total * share) / (total * share))
        .sum();
    assert!(chi < 13.8, "chi-square {chi:.1} of {turns:?}");
}
