//! Traffic against the figures that engineers trust: the measures of `simworld_traffic::validation`, which hold their own bands and
//! sources, and the delay of whole trips. `--example validate` prints them all.

use std::sync::Arc;

use simworld_core::id::RoadId;
use simworld_core::net::{LaneDirection, NetworkConfig, RoadNetwork, StreetPlan};
use simworld_core::seed::Seed;
use simworld_traffic::validation::{Effort, Figure, MEASURES};
use simworld_traffic::vehicle::VehicleKind;
use simworld_traffic::{Arrivals, Flow, Leg, Route, Traffic, TrafficConfig};

/// All figures of a measure; all settings with `SIMWORLD_SOAK=1`.
fn figures(name: &str) -> Vec<Figure> {
    let measure = MEASURES.iter().find(|measure| measure.name == name).expect("the measure is listed");
    let effort = if std::env::var("SIMWORLD_SOAK").is_ok() { Effort::Whole } else { Effort::Short };
    let figures = (measure.run)(effort).expect("its set-up is sound");
    assert!(!figures.is_empty(), "{name} has figures");
    figures
}

/// Every figure of a measure is in its band.
fn holds(name: &str) {
    let figures = figures(name);
    for figure in &figures {
        println!("{figure}");
    }
    let off: Vec<&Figure> = figures.iter().filter(|figure| !figure.is_ok()).collect();
    assert!(off.is_empty(), "off: {off:#?}");
}

#[test]
fn a_queue_discharges_as_the_manual_says() {
    holds("queue discharge");
}

#[test]
fn flow_on_a_ring_is_that_of_the_model() {
    holds("ring");
}

#[test]
fn followers_keep_the_equilibrium_gap() {
    holds("equilibrium gap");
}

#[test]
fn platoons_are_as_stable_as_the_theory_says() {
    holds("platoon");
}

#[test]
fn a_green_wave_carries_a_platoon() {
    holds("green wave");
}

#[test]
fn actuated_greens_end_as_they_should() {
    holds("actuated signal");
}

#[test]
fn policies_that_look_do_better_under_uneven_demand() {
    holds("uneven demand");
}

#[test]
fn turning_shares_are_the_weights() {
    holds("turning shares");
}

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
