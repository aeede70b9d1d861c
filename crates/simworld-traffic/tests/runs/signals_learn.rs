//! Signals as agents: the contract of the environment, and what its numbers mean.

use std::collections::BTreeMap;
use std::sync::Arc;

use simworld_core::id::{EntityId, RoadId};
use simworld_core::net::{LaneDirection, NetworkConfig, RoadNetwork, StreetPlan};
use simworld_core::seam::{EnvError, Options, ParallelEnv, Space, SpaceValue};
use simworld_core::seed::Seed;
use simworld_core::testing::{EnvCheck, check_parallel_env};
use simworld_traffic::learn::{AverageSpeed, PressureReward, QueueReward, SignalEnv, SignalEnvConfig};
use simworld_traffic::{Flow, Leg, Route, TrafficConfig};

fn config(seconds: f64) -> SignalEnvConfig {
    let traffic = TrafficConfig { vehicles: 30, pedestrians: 10, ..TrafficConfig::default() };
    SignalEnvConfig { traffic, seconds, ..SignalEnvConfig::default() }
}

fn grid(config: SignalEnvConfig) -> SignalEnv {
    let network = RoadNetwork::derive(&StreetPlan::grid(3, 3, 120.0), &NetworkConfig::default());
    SignalEnv::new(Arc::new(network.expect("a grid is a network")), config)
        .expect("the settings are in range")
}

/// What everybody sees at the start of the episode of that seed.
fn begin(env: &mut SignalEnv, seed: u64) -> BTreeMap<EntityId, SpaceValue> {
    let start = env.reset(Some(Seed(seed)), &Options::new()).expect("it resets");
    start.into_iter().map(|(id, (seen, _))| (id, seen)).collect()
}

#[test]
fn it_keeps_the_contract_of_environments() {
    check_parallel_env(|_| grid(config(60.0)), &EnvCheck::new(40));
}

#[test]
fn an_episode_is_truncated_when_its_time_is_over() {
    let mut env = grid(config(30.0));
    assert!(matches!(env.step(&BTreeMap::new()), Err(EnvError::NotReset)));
    env.reset(Some(Seed(1)), &Options::new()).expect("it resets");
    for step in 1..=6 {
        let transitions = env.step(&BTreeMap::new()).expect("it steps");
        assert_eq!(transitions.len(), env.agents().count());
        assert!(transitions.values().all(|t| !t.terminated && t.truncated == (step == 6)));
    }
    assert!(matches!(env.step(&BTreeMap::new()), Err(EnvError::NotReset)));
}

#[test]
fn unknown_agents_and_stages_are_refused_and_nothing_is_done() {
    let mut env = grid(config(60.0));
    let seen = env.reset(Some(Seed(1)), &Options::new()).expect("it resets");
    let first = *seen.keys().next().expect("a grid has signals");
    for (who, action) in [
        (EntityId::new(999, 0), SpaceValue::Discrete(0)),
        (EntityId::new(0, 1), SpaceValue::Discrete(0)),
        (first, SpaceValue::Discrete(99)),
        (first, SpaceValue::Box(vec![f64::NAN])),
    ] {
        let error = env.step(&BTreeMap::from([(who, action)])).expect_err("it is refused");
        assert!(matches!(error, EnvError::Action { who: named, .. } if named == who));
        assert_eq!(env.traffic().expect("an episode is under way").seconds(), 0.0);
    }
}

#[test]
fn the_observation_is_that_of_sumo_rl() {
    let mut env = grid(config(600.0));
    let mut seen = begin(&mut env, 3);
    for _ in 0..40 {
        for (id, seen) in &seen {
            let (SpaceValue::Box(seen), Some(junction)) = (seen, env.junction(*id)) else { panic!("boxes") };
            let (stages, lanes) = (junction.stages, junction.incoming.len());
            assert_eq!(seen.len(), stages + 1 + 2 * lanes);
            assert_eq!(seen[..stages].iter().sum::<f64>(), 1.0, "one stage");
            assert_eq!(seen[junction.stage], 1.0);
            for lane in 0..lanes {
                assert!(seen[stages + 1 + lane] >= seen[stages + 1 + lanes + lane], "who queues is there");
            }
        }
        let transitions = env.step(&BTreeMap::new()).expect("it steps");
        seen = transitions.into_iter().map(|(id, transition)| (id, transition.observation)).collect();
    }
    let vehicles: u32 = env
        .agents()
        .filter_map(|id| env.junction(id))
        .flat_map(|j| &j.incoming)
        .map(|lane| lane.vehicles)
        .sum();
    assert!(vehicles > 5 && vehicles <= 30, "{vehicles} before junctions");
}

#[test]
fn an_action_is_carried_out_after_the_shortest_green() {
    let mut env = grid(SignalEnvConfig { min_green: 20.0, ..config(600.0) });
    env.reset(Some(Seed(1)), &Options::new()).expect("it resets");
    let id = env.agents().next().expect("a grid has signals");
    let before = env.junction(id).expect("it is an agent").stage;
    let wish = BTreeMap::from([(id, SpaceValue::Discrete(1 - before as i64))]);
    let mut changed = None;
    for step in 1..=12 {
        env.step(&wish).expect("it steps");
        let junction = env.junction(id).expect("it is an agent");
        if changed.is_none() && junction.stage != before {
            changed = Some(step);
        }
        assert!(step > 3 || junction.stage == before, "the green was cut short");
    }
    assert!(changed.is_some(), "the stage never came");
}

#[test]
fn a_longest_green_is_enforced_if_asked_for() {
    let stages = |enforce_max_green| {
        let mut env = grid(SignalEnvConfig { enforce_max_green, max_green: 15.0, ..config(120.0) });
        env.reset(Some(Seed(1)), &Options::new()).expect("it resets");
        let id = env.agents().next().expect("a grid has signals");
        let first = env.junction(id).expect("it is an agent").stage;
        (0..24).any(|_| {
            env.step(&BTreeMap::new()).expect("it steps");
            env.junction(id).expect("it is an agent").stage != first
        })
    };
    assert!(stages(true) && !stages(false));
}

/// Total reward of an episode on a crossroads, one road busier than the other, when the stage is chosen so.
fn total(mut env: SignalEnv, choose: impl Fn(i64, &[f64]) -> i64) -> f64 {
    let mut seen = begin(&mut env, 4);
    let mut sum = 0.0;
    for step in 0.. {
        let act = |seen: &SpaceValue| {
            let SpaceValue::Box(seen) = seen else { panic!("observations are boxes") };
            SpaceValue::Discrete(choose(step, seen))
        };
        let actions = seen.iter().map(|(id, seen)| (*id, act(seen))).collect();
        let transitions = env.step(&actions).expect("it steps");
        sum += transitions.values().map(|transition| transition.reward).sum::<f64>();
        if transitions.values().any(|transition| transition.truncated) {
            return sum;
        }
        seen = transitions.into_iter().map(|(id, transition)| (id, transition.observation)).collect();
    }
    sum
}

#[test]
fn every_reward_prefers_the_longest_queue_to_a_clock_under_uneven_demand() {
    let network = RoadNetwork::derive(&StreetPlan::crossroads(200.0), &NetworkConfig::default());
    let network = Arc::new(network.expect("a crossroads is a network"));
    let arm = |road, direction| Leg::new(RoadId(road), direction);
    let across = |from, to| Route(vec![arm(from, LaneDirection::Backward), arm(to, LaneDirection::Forward)]);
    let flows = [(0, 2, 650.0), (2, 0, 650.0), (1, 3, 100.0), (3, 1, 100.0)];
    let flows = flows.map(|(from, to, per_hour)| Flow::new(across(from, to), per_hour)).to_vec();
    let config = SignalEnvConfig { flows, seconds: 1200.0, ..SignalEnvConfig::default() };
    let env = || SignalEnv::new(Arc::clone(&network), config.clone()).expect("the settings are in range");
    let (seen, _) = env().spaces(EntityId::new(0, 0));
    assert_eq!(seen, Space::bounded(0.0, 1.0, vec![2 + 1 + 8]));
    let longest = |_: i64, seen: &[f64]| i64::from(seen[7] + seen[9] > seen[8] + seen[10]);
    let clock = |step: i64, _: &[f64]| (step / 6) % 2;
    let makes: [fn(SignalEnv) -> SignalEnv; 4] = [
        |env| env,
        |env| env.with_reward(AverageSpeed),
        |env| env.with_reward(QueueReward),
        |env| env.with_reward(PressureReward),
    ];
    for (rank, make) in makes.into_iter().enumerate() {
        let (looks, waits) = (total(make(env()), longest), total(make(env()), clock));
        assert!(looks > waits, "reward {rank}: {looks} against {waits}");
    }
}
