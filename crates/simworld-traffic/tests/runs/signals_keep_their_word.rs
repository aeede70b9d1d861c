//! Whatever a policy wants: no conflicting greens, no green cut short, yellow and clearance in full; and the policies do
//! what their names say.

use std::sync::{Arc, Mutex};

use simworld_core::id::{ConnectionId, RoadId};
use simworld_core::net::{Aspect, LaneDirection, NetworkConfig, RoadNetwork, SignalGroup, StreetPlan};
use simworld_core::seed::{Seed, StreamRng};
use simworld_core::traffic::SignalTiming;
use simworld_traffic::signal::{Actuated, FixedTime, JunctionView, MaxPressure, SignalPolicy};
use simworld_traffic::vehicle::VehicleKind;
use simworld_traffic::{Leg, Route, Traffic, TrafficConfig};

const DT: f64 = 0.1;

fn grid() -> Arc<RoadNetwork> {
    Arc::new(
        RoadNetwork::derive(&StreetPlan::grid(3, 3, 120.0), &NetworkConfig::default())
            .expect("a grid is a network"),
    )
}

fn traffic(vehicles: u32, pedestrians: u32) -> Traffic {
    let config = TrafficConfig { vehicles, pedestrians, ..TrafficConfig::default() };
    Traffic::new(grid(), &config, Seed(2)).expect("the settings are in range")
}

/// Wants any stage at any time, and now and then one that does not exist.
struct Whim(StreamRng);

impl SignalPolicy for Whim {
    fn next_stage(&mut self, junction: &JunctionView<'_>) -> usize {
        self.0.below(junction.stages.len() + 1)
    }
}

/// Steps traffic and watches that its signals stay safe, whoever operates them; returns how often they changed.
fn watch(
    traffic: &mut Traffic,
    steps: u32,
    (green, yellow): (f64, f64),
    mut operate: impl FnMut(&mut Traffic, u32),
) -> u32 {
    let network = Arc::clone(traffic.network());
    let is_walker = |index: usize| {
        network.crossings.iter().any(|crossing| crossing.signal.is_some_and(|group| group.index() == index))
    };
    let mut shown = vec![(Aspect::Red, 1e9); network.signal_groups()];
    let mut changes = 0;
    for step in 0..steps {
        operate(traffic, step);
        traffic.step(DT);
        for (index, (aspect, now)) in shown.iter_mut().zip(traffic.signals()).enumerate() {
            aspect.1 += DT;
            if aspect.0 == *now {
                continue;
            }
            let (old, lasted) = (aspect.0, aspect.1);
            *aspect = (*now, 0.0);
            changes += 1;
            if step < 1000 {
                continue; // the first stage may have begun before the start
            }
            assert!((old, *now) != (Aspect::Green, Aspect::Red), "group {index}: no yellow at step {step}");
            assert!(old != Aspect::Green || lasted > green - 0.1, "group {index}: green of {lasted} s");
            // The yellow of the plan for vehicles; a strip of 7 m at 1 m/s for people.
            let least = if is_walker(index) { 6.9 } else { yellow - 0.1 };
            assert!(old != Aspect::Yellow || lasted > least, "group {index}: yellow of {lasted} s");
        }
        let green = |id: ConnectionId| {
            let signal = network.connections[id.index()].signal;
            signal.is_some_and(|group| traffic.signals()[group.index()] == Aspect::Green)
        };
        for (index, connection) in network.connections.iter().enumerate() {
            let own = ConnectionId::from_index(index);
            for other in connection.conflicts.iter().filter(|other| green(own) && green(**other)) {
                let settled = connection.yields_to.contains(other)
                    || network.connections[other.index()].yields_to.contains(&own);
                assert!(settled, "conflicting greens at step {step}");
            }
        }
    }
    changes
}

#[test]
fn no_policy_can_make_signals_unsafe() {
    let mut traffic = traffic(30, 60);
    traffic.set_policy(Box::new(Whim(Seed(9).stream("whim").rng())));
    let changes = watch(&mut traffic, 20_000, (5.0, 3.0), |_, _| {});
    assert!(changes > 2000, "the whims were carried out: {changes}");
}

#[test]
fn no_order_can_make_signals_unsafe() {
    let mut traffic = traffic(30, 60);
    let groups = traffic.network().signal_groups();
    let mut rng = Seed(10).stream("hand").rng();
    let (mut held, mut refused) = (0, 0);
    let changes = watch(&mut traffic, 10_000, (4.0, 2.0), |traffic, step| {
        if step % 10 != 0 {
            return;
        }
        // One group too many is among them.
        let group = SignalGroup(rng.below(groups + 1) as u32);
        let done = match rng.below(4) {
            0 | 1 => traffic.hold_signal(group, rng.uniform(0.0, 40.0)),
            2 => traffic.free_signal(group),
            _ => {
                let (green, yellow, walk) =
                    (rng.uniform(5.0, 30.0), rng.uniform(2.0, 5.0), rng.uniform(4.0, 20.0));
                traffic.time_signal(group, SignalTiming { green, yellow, walk })
            }
        };
        held += u32::from(done.is_ok());
        refused += u32::from(done.is_err());
    });
    assert!(held > 300 && refused > 20, "{held} orders were carried out, {refused} refused");
    assert!(changes > 1000, "{changes}");
}

/// Vehicles of each of two ways through a crossroads, straight on, that have arrived.
fn arrived(traffic: &mut Traffic, seconds: u32) -> [u32; 2] {
    let mut arrived = [0; 2];
    for _ in 0..seconds * 10 {
        traffic.step(DT);
        for trip in traffic.ended() {
            // Cars go one way, vans the other.
            arrived[usize::from(trip.kind == VehicleKind::Van)] += 1;
        }
    }
    arrived
}

#[test]
fn drivers_go_where_a_signal_is_held_and_stand_where_it_is_not() {
    let network = RoadNetwork::derive(&StreetPlan::crossroads(100.0), &NetworkConfig::default());
    let network = Arc::new(network.expect("it is a network"));
    let config = TrafficConfig { vehicles: 0, pedestrians: 0, ..TrafficConfig::default() };
    let mut traffic =
        Traffic::new(Arc::clone(&network), &config, Seed(3)).expect("the settings are in range");
    let arm = |road, direction| Leg::new(RoadId(road), direction);
    let (mut groups, mut routes) = ([SignalGroup(0); 2], Vec::new());
    for (way, kind) in [VehicleKind::Car, VehicleKind::Van].into_iter().enumerate() {
        let (from, to) = (way as u32, way as u32 + 2);
        let legs = [arm(from, LaneDirection::Backward), arm(to, LaneDirection::Forward)];
        let lane = network.lanes[legs[0].lanes(&network)[0].index()].outgoing[0];
        groups[way] = network.connections[lane.index()].signal.expect("a crossroads has signals");
        routes.extend((0..4).map(|_| (Route(legs.to_vec()), kind)));
    }
    traffic.hold_signal(groups[0], f64::INFINITY).expect("it is there");
    assert_eq!(arrived(&mut traffic, 40), [0, 0], "what had begun ends");
    for (route, kind) in routes {
        traffic.insert(route, kind).expect("it leads across");
    }
    assert_eq!(
        arrived(&mut traffic, 120),
        [4, 0],
        "who has green for good goes, the others stand for two minutes"
    );
    traffic.hold_signal(groups[1], 60.0).expect("it is there");
    assert_eq!(arrived(&mut traffic, 60), [0, 4]);
    // What is held for a time is free after it.
    assert!(traffic.free_signal(groups[1]).is_err());
    let mut seen = [false; 2];
    for _ in 0..1200 {
        traffic.step(DT);
        for (seen, group) in seen.iter_mut().zip(groups) {
            *seen |= traffic.signals()[group.index()] == Aspect::Green;
        }
    }
    assert_eq!(seen, [true; 2], "both have their turn again");
    let error = traffic.hold_signal(SignalGroup(99), 1.0).expect_err("there are no hundred groups");
    assert_eq!(error.to_string(), "signal group 99: there is no such group");
    assert!(traffic.hold_signal(groups[0], f64::NAN).is_err());
}

#[test]
fn signals_last_as_long_as_they_are_timed() {
    let mut traffic = traffic(0, 0);
    let group = traffic.plans()[1].groups[0];
    let timing = SignalTiming { green: 40.0, yellow: 5.0, walk: 6.0 };
    traffic.time_signal(group, timing).expect("it is in range");
    let mut lasted = Vec::new();
    let (mut shown, mut since) = (traffic.signals()[group.index()], 0.0);
    for _ in 0..6000 {
        traffic.step(DT);
        since += DT;
        let now = traffic.signals()[group.index()];
        if now != shown {
            lasted.push((shown, since));
            (shown, since) = (now, 0.0);
        }
    }
    // The first had begun before, and the second is shortened to meet the clock of the new plan.
    for (aspect, wanted) in [(Aspect::Green, timing.green), (Aspect::Yellow, timing.yellow)] {
        let times = lasted.iter().filter(|(own, _)| *own == aspect);
        let times: Vec<f64> = times.map(|(_, seconds)| *seconds).skip(2).collect();
        assert!(times.len() >= 3, "{lasted:?}");
        assert!(times.iter().all(|time| (time - wanted).abs() < 0.25), "{aspect:?}: {times:?}");
    }
    for wrong in [SignalTiming { yellow: 0.5, ..timing }, SignalTiming { green: f64::NAN, ..timing }] {
        assert!(traffic.time_signal(group, wrong).is_err(), "{wrong:?}");
    }
}

#[test]
fn fixed_time_keeps_to_the_clock() {
    let mut traffic = traffic(10, 10);
    traffic.set_policy(Box::new(FixedTime));
    let plan = traffic.plans()[1].clone();
    let mut off = 0;
    for step in 1..6000 {
        traffic.step(DT);
        let mut into = (f64::from(step) * DT + plan.offset).rem_euclid(plan.cycle());
        let phase = plan
            .phases
            .iter()
            .find(|phase| {
                into -= phase.duration;
                into < 0.0
            })
            .unwrap_or(&plan.phases[0]);
        off += i32::from(plan.groups.iter().any(|g| traffic.signals()[g.index()] != phase.aspect(*g)));
    }
    // At most two steps late at each of the eight changes of a cycle: intervals end on steps, the clock does not.
    assert!(off < 2 * 8 * (600.0 / plan.cycle()).ceil() as i32, "{off} of 6000 steps differ from the clock");
}

type Ends = Arc<Mutex<Vec<(f64, f64, bool)>>>;

/// Records each stage that a policy ends: how long it was green, the longest gap, and whether others waited.
struct Recorded<P>(P, Ends);

impl<P: SignalPolicy> SignalPolicy for Recorded<P> {
    fn next_stage(&mut self, junction: &JunctionView<'_>) -> usize {
        let next = self.0.next_stage(junction);
        let gap = junction.stages[junction.current]
            .green
            .iter()
            .map(|group| junction.demand.gap[group.index()])
            .fold(f64::INFINITY, f64::min);
        let wanted = (0..junction.stages.len()).any(|s| s != junction.current && junction.demand_of(s) > 0);
        if next != junction.current {
            self.1.lock().expect("nobody panics with the lock").push((junction.elapsed, gap, wanted));
        } else if wanted {
            assert!(
                junction.elapsed < 45.1,
                "green beyond its longest while others wait: {}",
                junction.elapsed
            );
            assert!(junction.elapsed < 5.1 || gap <= 3.0 + DT, "a gap of {gap} s did not end the green");
        }
        next
    }
}

#[test]
fn actuated_greens_end_on_a_gap_or_at_their_longest() {
    let ends = Ends::default();
    let mut traffic = traffic(50, 40);
    traffic.set_policy(Box::new(Recorded(Actuated::default(), Arc::clone(&ends))));
    for _ in 0..12_000 {
        traffic.step(DT);
    }
    let ends = ends.lock().expect("nobody panics with the lock");
    assert!(ends.len() > 100, "{}", ends.len());
    for (green, gap, wanted) in ends.iter() {
        assert!(*green > 4.9 && *wanted, "ended after {green} s for nobody");
        assert!(*gap > 3.0 || *green > 44.9, "ended after {green} s with a gap of {gap} s");
    }
    let by_gap = ends.iter().filter(|(green, _, _)| *green < 44.9).count();
    assert!(by_gap * 2 > ends.len(), "at moderate demand most greens end on a gap");
}

/// Crossings of intersections in half an hour with a policy.
fn throughput(policy: Box<dyn SignalPolicy + Send>, vehicles: u32) -> u64 {
    // Most go straight on, and the long sides of the grid have twice the lanes' length of the short ones.
    let network = RoadNetwork::derive(&StreetPlan::grid(5, 3, 150.0), &NetworkConfig::default())
        .expect("a grid is a network");
    let config =
        TrafficConfig { vehicles, pedestrians: 20, turns: [0.8, 0.1, 0.1], ..TrafficConfig::default() };
    let mut traffic = Traffic::new(Arc::new(network), &config, Seed(4)).expect("the settings are in range");
    traffic.set_policy(policy);
    for _ in 0..18_000 {
        traffic.step(DT);
    }
    traffic.counters().crossings
}

#[test]
fn policies_that_look_do_better_than_the_clock() {
    let fixed = throughput(Box::new(FixedTime), 90);
    let actuated = throughput(Box::new(Actuated::default()), 90);
    let pressure = throughput(Box::new(MaxPressure::default()), 90);
    assert!(actuated > fixed * 105 / 100, "actuated {actuated}, fixed {fixed}");
    assert!(pressure > fixed * 105 / 100, "max-pressure {pressure}, fixed {fixed}");
}

/// Answers as [`FixedTime`] does, and wants to be asked in every step.
struct Asked(FixedTime);

impl SignalPolicy for Asked {
    fn next_stage(&mut self, junction: &JunctionView<'_>) -> usize {
        self.0.next_stage(junction)
    }

    fn watches(&self) -> bool {
        false
    }
}

#[test]
fn who_need_not_be_asked_would_have_answered_the_same() {
    let run = |policy: Box<dyn SignalPolicy + Send>| {
        let mut traffic = traffic(0, 0);
        traffic.set_policy(policy);
        let mut rng = Seed(11).stream("hand").rng();
        let mut shown = Vec::new();
        for step in 0..8000 {
            // Held and freed within greens and endings, timed anew, and put back by a plan of one's own.
            let group = SignalGroup(rng.below(traffic.network().signal_groups()) as u32);
            match step % 400 {
                100 => drop(traffic.hold_signal(group, rng.uniform(0.0, 50.0))),
                230 => drop(traffic.free_signal(group)),
                310 => {
                    let timing = SignalTiming { green: rng.uniform(5.0, 30.0), yellow: 3.0, walk: 6.0 };
                    traffic.time_signal(group, timing).expect("its times are in range");
                }
                399 if step > 4000 => {
                    let mut plans = traffic.plans().to_vec();
                    for plan in &mut plans {
                        plan.offset += 7.3;
                    }
                    traffic.set_plans(plans).expect("they are for the same groups");
                }
                _ => {}
            }
            traffic.step(DT);
            shown.push(traffic.signals().to_vec());
        }
        shown
    };
    let (rests, asked) = (run(Box::new(FixedTime)), run(Box::new(Asked(FixedTime))));
    let differs = rests.iter().zip(&asked).position(|(rests, asked)| rests != asked);
    assert_eq!(differs, None, "the step from which on they differ");
}
