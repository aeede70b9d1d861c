//! Wrapped environments keep the contract, and each wrapper does what it says.

use crate::gym_common::{Drift, Drifts};
use simworld_agents::gym::{
    ClipAction, Detail, EnvExt, EpisodeSummary, FlattenAction, FlattenObservation, FrameStack, Learning,
    Line, NormaliseObservation, NormaliseReward, Observing, ParallelEnvExt, Record, RescaleAction,
    RunningMoments, TimeLimit,
};
use simworld_core::id::EntityId;
use simworld_core::seam::{Bounds, Env, EnvError, Info, Options, ParallelEnv, Space, SpaceValue, Transition};
use simworld_core::seed::Seed;
use simworld_core::testing::{EnvCheck, check_env, check_parallel_env};

fn push(by: f64) -> SpaceValue {
    SpaceValue::Box(vec![by])
}

/// Steps under a fixed row of pushes, until the episode ends.
fn play(
    env: &mut impl Env<Observation = SpaceValue, Action = SpaceValue>,
    seed: u64,
) -> Vec<Transition<SpaceValue>> {
    env.reset(Some(Seed(seed)), &Options::new()).expect("it resets");
    let mut all: Vec<Transition<SpaceValue>> = Vec::new();
    for step in 0..500 {
        let by = if step % 3 == 0 { -0.4 } else { 0.3 };
        all.push(env.step(&push(by)).expect("it steps"));
        if all.last().is_some_and(Transition::is_last) {
            break;
        }
    }
    all
}

#[test]
fn wrapped_environments_keep_the_contract() {
    let check = EnvCheck::new(60);
    check_env(|_| TimeLimit::new(Drift::new(), 9).unwrap(), &check);
    check_env(|_| Drift::new().flatten_observation().unwrap(), &check);
    check_env(|_| Drift::new().frame_stack(4).unwrap(), &check);
    check_env(|_| Drift::new().clip_action().unwrap(), &check);
    check_env(|_| Drift::new().rescale_action(-1.0, 1.0).unwrap(), &check);
    check_env(|_| Drift::new().flatten_action().unwrap(), &check);
    check_env(|_| Drift::new().record(std::io::sink(), Detail::Steps), &check);
    check_env(
        |_| Drift::new().rescale_action(0.0, 1.0).unwrap().frame_stack(2).unwrap().time_limit(20).unwrap(),
        &check,
    );
    check_parallel_env(|_| ParallelEnvExt::time_limit(Drifts::new(), 9).unwrap(), &check);
    check_parallel_env(|_| ParallelEnvExt::observing(Drifts::new(), FrameStack::new(3)), &check);
    check_parallel_env(|_| ParallelEnvExt::observing(Drifts::new(), FlattenObservation), &check);
    check_parallel_env(|_| ParallelEnvExt::acting(Drifts::new(), ClipAction), &check);
    check_parallel_env(
        |_| ParallelEnvExt::acting(Drifts::new(), RescaleAction { low: -1.0, high: 1.0 }),
        &check,
    );
    check_parallel_env(|_| ParallelEnvExt::acting(Drifts::new(), FlattenAction), &check);
    check_parallel_env(|_| ParallelEnvExt::record(Drifts::new(), std::io::sink(), Detail::Steps), &check);
}

#[test]
fn moments_that_rest_keep_the_contract_and_those_that_learn_do_not_forget() {
    let mut taught = Drift::new().normalise_observation().unwrap();
    for seed in 0..20 {
        play(&mut taught, seed);
    }
    let map = NormaliseObservation { learning: Learning::Rests, ..taught.map().clone() };
    check_env(|_| Observing::new(Drift::new(), map.clone()).unwrap(), &EnvCheck::new(60));

    // what was learnt is data: written and read, it goes on to the same numbers
    let text = serde_json::to_string(taught.map()).unwrap();
    let mut other = Drift::new().normalise_observation().unwrap();
    let before = play(&mut other, 99);
    *other.map_mut() = serde_json::from_str(&text).unwrap();
    let (other, taught) = (play(&mut other, 99), play(&mut taught, 99));
    assert_eq!(other, taught);
    assert_ne!(before, taught);
}

#[test]
fn normalised_observations_have_mean_0_and_variance_1() {
    let mut env = Drift::new().time_limit(50).unwrap().normalise_observation().unwrap();
    for seed in 0..200 {
        play(&mut env, seed);
    }
    env.map_mut().learning = Learning::Rests;
    let mut shown = RunningMoments::default();
    let mut count = 0;
    for seed in 0..200 {
        for transition in play(&mut env, seed) {
            shown.see(transition.observation.as_box().unwrap());
            count += 1;
        }
    }
    assert_eq!(shown.count(), count);
    for entry in 0..2 {
        // the moments were learnt with the first observations too, which are not shown here
        assert!(shown.mean()[entry].abs() < 0.1, "mean {}", shown.mean()[entry]);
        assert!((shown.variance(entry) - 1.0).abs() < 0.15, "variance {}", shown.variance(entry));
    }
}

#[test]
fn normalised_rewards_are_over_the_spread_of_returns() {
    let gamma = 0.9;
    let mut plain = Drift::new().time_limit(50).unwrap();
    let mut env = NormaliseReward::new(Drift::new().time_limit(50).unwrap(), gamma).unwrap();
    let mut moments = RunningMoments::default();
    for seed in 0..40 {
        let (plain, scaled) = (play(&mut plain, seed), play(&mut env, seed));
        let mut sum = 0.0;
        for (plain, scaled) in plain.iter().zip(&scaled) {
            sum = sum * gamma + plain.reward;
            moments.see(&[sum]);
            assert_eq!(scaled.reward, plain.reward / moments.deviation(0));
            assert_eq!(scaled.observation, plain.observation);
        }
    }
    assert_eq!(env.moments(), &moments);
    env.set_learning(Learning::Rests);
    play(&mut env, 41);
    assert_eq!(env.moments(), &moments);
    env.set_moments(RunningMoments::default());
    assert_eq!(env.moments().count(), 0);
}

#[test]
fn a_time_limit_truncates_and_leaves_ends_of_the_task_alone() {
    let lengths: Vec<usize> = (0..40).map(|seed| play(&mut Drift::new(), seed).len()).collect();
    let (mut cut, mut whole) = (0, 0);
    for (seed, length) in lengths.iter().enumerate() {
        let transitions = play(&mut Drift::new().time_limit(12).unwrap(), seed as u64);
        let last = transitions.last().unwrap();
        assert_eq!(transitions.len(), (*length).min(12));
        assert_eq!(
            (last.terminated, last.truncated),
            (*length <= 12, *length >= 12 || transitions.len() == 12)
        );
        (cut, whole) = (cut + usize::from(*length > 12), whole + usize::from(*length < 12));
    }
    assert!(cut > 3 && whole > 3, "both happen: {lengths:?}");
    assert!(TimeLimit::new(Drift::new(), 0).is_err());
}

#[test]
fn frames_are_stacked_oldest_first_and_the_first_fills_up() {
    let (mut plain, mut env) = (Drift::new(), Drift::new().frame_stack(3).unwrap());
    for seed in [4, 5] {
        let (first, _) = plain.reset(Some(Seed(seed)), &Options::new()).unwrap();
        let first = first.as_box().unwrap().to_vec();
        let (start, _) = env.reset(Some(Seed(seed)), &Options::new()).unwrap();
        assert_eq!(start.as_box().unwrap(), first.repeat(3));
        let mut frames = vec![first.clone(), first.clone(), first];
        for _ in 0..2 {
            frames.push(plain.step(&push(0.5)).unwrap().observation.as_box().unwrap().to_vec());
            let stacked = env.step(&push(0.5)).unwrap().observation;
            assert_eq!(stacked.as_box().unwrap(), frames[frames.len() - 3..].concat());
        }
    }
    let (Space::Box { low: Bounds::Each(low), shape, .. }, _) = env.spaces() else { panic!("boxes") };
    assert_eq!((low.len(), shape), (6, vec![3, 2]));
    assert!(Drift::new().frame_stack(0).is_err());
}

#[test]
fn actions_are_clipped_and_stretched_to_the_bounds() {
    let after = |env: &mut dyn Env<Observation = SpaceValue, Action = SpaceValue>, by: f64| {
        env.reset(Some(Seed(3)), &Options::new()).unwrap();
        env.step(&push(by)).map(|transition| transition.observation)
    };
    let plain = |by| after(&mut Drift::new(), by).unwrap();
    let mut clipped = Drift::new().clip_action().unwrap();
    let mut stretched = Drift::new().rescale_action(-1.0, 1.0).unwrap();
    assert_eq!(after(&mut clipped, 77.0).unwrap(), plain(3.0));
    assert_eq!(after(&mut clipped, -77.0).unwrap(), plain(-2.0));
    assert_eq!(after(&mut clipped, 0.7).unwrap(), plain(0.7));
    assert!(matches!(after(&mut clipped, f64::NAN), Err(EnvError::NotInSpace { .. })));
    assert_eq!(after(&mut stretched, 1.0).unwrap(), plain(3.0));
    assert_eq!(after(&mut stretched, -1.0).unwrap(), plain(-2.0));
    assert_eq!(after(&mut stretched, 0.0).unwrap(), plain(0.5));
    assert!(after(&mut stretched, 1.1).is_err(), "beyond its own range");
    assert!(
        Drift::new().clip_action().unwrap().rescale_action(-1.0, 1.0).is_err(),
        "no bounds to stretch to"
    );
    assert!(Drift::new().rescale_action(1.0, 1.0).is_err());
}

/// Shows a dictionary and takes a pair.
struct Forms;

impl Env for Forms {
    type Observation = SpaceValue;
    type Action = SpaceValue;

    fn reset(&mut self, _: Option<Seed>, options: &Options) -> Result<(SpaceValue, Info), EnvError> {
        EnvError::refuse_unknown(options, &[])?;
        Ok((self.spaces().0.sample(&mut Seed(1).stream("forms").rng()), Info::new()))
    }

    fn step(&mut self, action: &SpaceValue) -> Result<Transition<SpaceValue>, EnvError> {
        let SpaceValue::Tuple(parts) = action else { panic!("unflattened before") };
        let (observation, reward) =
            (self.reset(None, &Options::new())?.0, parts[0].as_discrete().unwrap() as f64);
        Ok(Transition { observation, reward, terminated: false, truncated: false, info: Info::new() })
    }

    fn spaces(&self) -> (Space, Space) {
        let seen =
            Space::dict([("near", Space::MultiBinary { n: 2 }), ("at", Space::bounded(0.0, 9.0, vec![2]))]);
        (seen, Space::Tuple(vec![Space::Discrete { n: 3, start: 5 }, Space::discrete(2)]))
    }
}

#[test]
fn flat_forms_go_in_and_out() {
    let mut env = Forms.flatten_observation().unwrap().flatten_action().unwrap();
    let (seen, doing) = env.spaces();
    let (start, _) = env.reset(None, &Options::new()).unwrap();
    assert_eq!(seen.check(&start), Ok(()));
    assert_eq!(
        Forms.spaces().0.unflatten(start.as_box().unwrap()).unwrap(),
        Forms.reset(None, &Options::new()).unwrap().0
    );
    let action = SpaceValue::Box(vec![0.0, 1.0, 0.0, 0.0, 1.0]);
    assert_eq!(doing.check(&action), Ok(()));
    assert_eq!(env.step(&action).unwrap().reward, 6.0);
    assert!(env.step(&SpaceValue::Box(vec![0.5; 5])).is_err(), "in the box, and yet no action");
    let boxes = Forms.frame_stack(2).err().expect("no box").to_string();
    assert!(boxes.contains("FrameStack") && boxes.contains("flatten it first"), "{boxes}");
}

type Read = Line<(SpaceValue, Info), SpaceValue, Transition<SpaceValue>>;

#[test]
fn records_tell_the_whole_story() {
    let mut env = Drift::new().time_limit(15).unwrap().record(Vec::new(), Detail::Steps);
    let mut all: Vec<Vec<Transition<SpaceValue>>> = (0..3).map(|seed| play(&mut env, seed)).collect();
    env.reset(None, &Options::new()).unwrap();
    all.push(vec![env.step(&push(0.0)).unwrap()]);
    env.reset(None, &Options::new()).unwrap();
    assert_eq!(env.episodes().len(), 4);
    let broken = &env.episodes()[3];
    assert_eq!((broken.steps, broken.terminated, broken.truncated, broken.seed), (1, false, false, None));
    let summaries: Vec<EpisodeSummary> = env.episodes().to_vec();
    for (transitions, summary) in all.iter().zip(&summaries).take(3) {
        assert_eq!(summary.steps, transitions.len() as u64);
        assert_eq!(summary.total, transitions.iter().map(|t| t.reward).sum::<f64>());
        let last = transitions.last().unwrap();
        assert_eq!(last.info["episode_return"], summary.total.into());
        assert_eq!(last.info["episode_length"], (summary.steps as i64).into());
        assert_eq!((summary.terminated, summary.truncated), (last.terminated, last.truncated));
    }
    // read back, the lines are the trajectories
    let text = String::from_utf8(env.into_writer()).unwrap();
    let lines: Vec<Read> = text.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let told = lines
        .iter()
        .filter_map(|line| if let Line::Step { transition, .. } = line { Some(transition) } else { None });
    assert!(told.eq(all.iter().flatten()));
    let ends =
        lines.iter().filter_map(|line| if let Line::Episode(summary) = line { Some(summary) } else { None });
    assert!(ends.eq(&summaries));
    assert_eq!(lines.iter().filter(|line| matches!(line, Line::Reset { .. })).count(), 5);
}

#[test]
fn records_of_several_agents_tell_who_got_what() {
    let mut env = Record::new(TimeLimit::new(Drifts::new(), 400).unwrap(), Vec::new(), Detail::Episodes);
    ParallelEnv::reset(&mut env, Some(Seed(1)), &Options::new()).unwrap();
    let mut sums = [0.0; 3];
    let mut steps = 0;
    while env.episodes().is_empty() {
        for (id, transition) in ParallelEnv::step(&mut env, &std::collections::BTreeMap::new()).unwrap() {
            sums[id.index()] += transition.reward;
            let told = transition.info.get("episode_return").cloned();
            assert_eq!(told, transition.is_last().then(|| sums[id.index()].into()));
        }
        steps += 1;
    }
    let summary = &env.episodes()[0];
    assert_eq!((summary.steps, summary.returns.len()), (steps, 3));
    for (index, sum) in sums.iter().enumerate() {
        assert_eq!(summary.returns[&EntityId::new(index as u32, 0)], *sum);
    }
    assert_eq!(String::from_utf8(env.into_writer()).unwrap().lines().count(), 1);
}

/// A disk that is full.
struct Full;

impl std::io::Write for Full {
    fn write(&mut self, _: &[u8]) -> std::io::Result<usize> {
        Err(std::io::Error::other("no space left"))
    }
    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_record_that_cannot_be_written_says_so() {
    let error = Drift::new().record(Full, Detail::Steps).reset(Some(Seed(1)), &Options::new()).unwrap_err();
    assert!(error.to_string().contains("no space left"), "{error}");
}

#[test]
fn moments_of_several_agents_are_their_own() {
    let mut env = ParallelEnvExt::observing(Drifts::new(), NormaliseObservation::default());
    env.reset(Some(Seed(1)), &Options::new()).unwrap();
    for _ in 0..3 {
        env.step(&std::collections::BTreeMap::new()).unwrap();
    }
    let counts: Vec<u64> = env.maps().values().map(|map| map.moments.count()).collect();
    assert_eq!(counts, [4, 4, 4]);
    let means: Vec<f64> = env.maps().values().map(|map| map.moments.mean()[0]).collect();
    assert!(means[0] != means[1] && means[1] != means[2]);
}
