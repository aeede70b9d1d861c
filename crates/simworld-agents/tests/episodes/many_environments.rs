//! Environments that are stepped together: the same on any number of threads and in any process, with each way to begin anew.

use std::collections::BTreeMap;
use std::num::NonZeroUsize;
use std::process::Command;

use crate::gym_common::{Drift, Drifts, digest};
use simworld_agents::gym::{
    Boundary, EnvExt, ParallelVectorEnv, ParallelVectorStep, TimeLimit, VectorConfig, VectorEnv, VectorError,
    VectorTransition,
};
use simworld_core::hash::StateDigest;
use simworld_core::id::EntityId;
use simworld_core::seam::{
    Autoreset, Env, EnvError, Options, ParallelEnv, ParallelStart, ParallelStep, SpaceValue, Transition,
};
use simworld_core::seed::Seed;

type Limited = TimeLimit<Drift>;

const COUNT: usize = 7;

fn vector(threads: usize, autoreset: Autoreset) -> VectorEnv<Limited> {
    let config = VectorConfig { threads: NonZeroUsize::new(threads).unwrap(), autoreset };
    VectorEnv::new(COUNT, config, |_| Drift::new().time_limit(10)).unwrap()
}

/// Its own push for each environment and step.
fn pushes(step: usize) -> Vec<SpaceValue> {
    (0..COUNT).map(|index| SpaceValue::Box(vec![((step * 3 + index * 5) % 11) as f64 / 5.0 - 1.0])).collect()
}

fn run(env: &mut VectorEnv<Limited>, steps: usize) -> Vec<Vec<VectorTransition<SpaceValue>>> {
    env.reset(Some(Seed(5)), &Options::new()).unwrap();
    (0..steps).map(|step| env.step(pushes(step)).unwrap()).collect()
}

fn trail(steps: &[Vec<VectorTransition<SpaceValue>>]) -> StateDigest {
    digest(steps.iter().flatten().map(|one| &one.transition))
}

/// What one environment does alone, episode after episode.
fn alone(index: u64, steps: usize) -> Vec<Transition<SpaceValue>> {
    let mut env = Drift::new().time_limit(10).unwrap();
    env.reset(Some(Seed(5).stream("gym/vector").indexed(index).seed()), &Options::new()).unwrap();
    let mut all = Vec::new();
    for step in 0..steps {
        let transition = env.step(&pushes(step)[index as usize]).unwrap();
        if transition.is_last() {
            env.reset(None, &Options::new()).unwrap();
        }
        all.push(transition);
    }
    all
}

#[test]
fn threads_do_not_matter() {
    for autoreset in [Autoreset::NextStep, Autoreset::SameStep] {
        let one = run(&mut vector(1, autoreset), 60);
        for threads in [2, 3, 8] {
            assert_eq!(run(&mut vector(threads, autoreset), 60), one, "{threads} threads");
        }
        assert!(one.iter().flatten().any(|step| step.transition.terminated));
        assert!(one.iter().flatten().any(|step| step.transition.truncated));
    }
}

#[test]
fn each_does_what_it_does_alone() {
    let together = run(&mut vector(2, Autoreset::SameStep), 40);
    for index in 0..COUNT {
        for (step, own) in together.iter().zip(alone(index as u64, 40)) {
            let VectorTransition { transition, boundary } = &step[index];
            assert_eq!((transition.reward, transition.is_last()), (own.reward, own.is_last()));
            match boundary {
                Boundary::None => assert_eq!(*transition, own),
                Boundary::Passed { observation, info } => {
                    assert!(own.is_last());
                    assert_eq!(
                        (observation, info),
                        (&own.observation, &own.info),
                        "the last observation is carried"
                    );
                    assert_ne!(transition.observation, own.observation, "and the first of the next is shown");
                    assert!(transition.info.contains_key("start"), "with the info of the reset");
                }
                Boundary::Begun => panic!("nothing begins in a step of its own"),
            }
        }
    }
}

#[test]
fn the_next_step_begins_anew_and_passes_over_its_action() {
    let steps = run(&mut vector(2, Autoreset::NextStep), 60);
    for index in 0..COUNT {
        let mut ends = false;
        let mut begun = 0;
        for step in &steps {
            let VectorTransition { transition, boundary } = &step[index];
            assert_eq!(
                *boundary == Boundary::Begun,
                ends,
                "it begins when the one before has ended, and never else"
            );
            if ends {
                begun += 1;
                assert_eq!((transition.reward, transition.is_last()), (0.0, false));
                assert!(transition.info.contains_key("start"));
            }
            ends = transition.is_last();
        }
        assert!(begun >= 5, "environment {index} began {begun} times");
    }
}

#[test]
fn nobody_begins_anew_but_who_is_told_to() {
    let mut env = vector(2, Autoreset::Disabled);
    let early = env.step(pushes(0)).expect_err("nobody has begun");
    assert!(matches!(early, VectorError::Env { index: 0, source: EnvError::NotReset }));
    env.reset(Some(Seed(5)), &Options::new()).unwrap();
    let last = (0..20)
        .map(|step| env.step(pushes(step)).unwrap())
        .find(|step| step.iter().any(|one| one.transition.is_last()));
    let over: Vec<bool> =
        last.expect("they end in 10 steps").iter().map(|one| one.transition.is_last()).collect();
    let first = over.iter().position(|over| *over).unwrap();
    let refused = env.step(pushes(1)).expect_err("one is over");
    assert!(matches!(refused, VectorError::Env { index, source: EnvError::NotReset } if index == first));
    let begun = env.reset_marked(&over, None).unwrap();
    assert_eq!(begun.iter().map(Option::is_some).collect::<Vec<_>>(), over);
    assert_eq!(env.step(pushes(1)).unwrap().len(), COUNT);
    assert!(matches!(
        env.reset_marked(&[true], None),
        Err(VectorError::Count { given: 1, count: COUNT, .. })
    ));
    assert!(matches!(env.step(Vec::new()), Err(VectorError::Count { given: 0, .. })));
}

#[test]
fn options_hold_for_episodes_that_begin_by_themselves() {
    let mut env = vector(2, Autoreset::SameStep);
    let options = Options::from([("start".to_owned(), 4.0.into())]);
    let begun = env.reset(Some(Seed(1)), &options).unwrap();
    assert!(begun.iter().all(|(_, info)| info["start"] == 4.0.into()));
    let next = (0..12).flat_map(|step| env.step(pushes(step)).unwrap());
    let infos: Vec<_> =
        next.filter(|one| one.boundary != Boundary::None).map(|one| one.transition.info).collect();
    assert!(!infos.is_empty() && infos.iter().all(|info| info["start"] == 4.0.into()));
    let wrong = Options::from([("finish".to_owned(), 4.0.into())]);
    assert!(matches!(
        env.reset(None, &wrong),
        Err(VectorError::Env { index: 0, source: EnvError::Option { .. } })
    ));
}

#[test]
fn one_that_fails_is_named_and_the_rest_go_on() {
    for threads in [1, 2] {
        let config = VectorConfig { threads: NonZeroUsize::new(threads).unwrap(), ..VectorConfig::default() };
        let make = |index: usize| Ok(Drift::that_panics_at((index == 3).then_some(0.25)));
        let mut env = VectorEnv::new(5, config, make).unwrap();
        env.reset(Some(Seed(1)), &Options::new()).unwrap();
        let refused = env.step(vec![SpaceValue::Box(vec![99.0]); 5]).err().unwrap();
        assert!(matches!(refused, VectorError::Env { index: 0, source: EnvError::NotInSpace { .. } }));
        env.reset(Some(Seed(1)), &Options::new()).unwrap();
        let error = env.step(vec![SpaceValue::Box(vec![0.25]); 5]).err().unwrap().to_string();
        assert!(error.contains("environment 3") && error.contains("pushed over the edge"), "{error}");
        let again = env.reset(Some(Seed(1)), &Options::new()).err().unwrap().to_string();
        assert!(again.contains("environment 3") && again.contains("make the vector anew"), "{again}");
        assert!(env.visit(4, |drift| drift.x.abs() <= 1.0).unwrap(), "the others were reset");
        assert!(matches!(env.visit(5, |_| ()), Err(VectorError::Index { index: 5, count: 5 })));
    }
}

#[test]
fn those_that_cannot_be_made_are_named() {
    let config = VectorConfig { threads: NonZeroUsize::new(2).unwrap(), ..VectorConfig::default() };
    let make = |index| if index >= 2 { Err(EnvError::NotReset) } else { Ok(Drift::new()) };
    assert!(matches!(VectorEnv::new(5, config, make).err(), Some(VectorError::Env { index: 2, .. })));
    let make = |index| Drift::new().frame_stack(1 + index / 3);
    assert!(matches!(VectorEnv::new(5, config, make).err(), Some(VectorError::Spaces { index: 3 })));
    // the caller's share and another's
    for whose in [2, 3] {
        let make = move |index| {
            assert!(index != whose, "no ground to stand on");
            Ok(Drift::new())
        };
        let error = VectorEnv::new(5, config, make).err().unwrap().to_string();
        assert!(error.contains(&format!("environment {whose}")) && error.contains("no ground"), "{error}");
    }
}

/// Set in a child of this test, which prints its digest and does no more.
const CHILD: &str = "SIMWORLD_TEST_PRINT_TRAIL";

#[test]
fn processes_do_not_matter() {
    let own = trail(&run(&mut vector(2, Autoreset::NextStep), 200));
    if std::env::var_os(CHILD).is_some() {
        println!("trail={own}");
        return;
    }
    for _ in 0..2 {
        let program = std::env::current_exe().unwrap();
        let arguments = ["--exact", "many_environments::processes_do_not_matter", "--nocapture"];
        let output = Command::new(program).args(arguments).env(CHILD, "1").output().unwrap();
        let text = String::from_utf8_lossy(&output.stdout);
        let told = text.split("trail=").nth(1).and_then(|rest| rest.split_whitespace().next());
        assert_eq!(told, Some(own.to_string().as_str()), "{text}");
    }
}

// ---- several agents in each ----

type Push = BTreeMap<EntityId, SpaceValue>;

fn games(threads: usize, autoreset: Autoreset) -> ParallelVectorEnv<TimeLimit<Drifts>> {
    let config = VectorConfig { threads: NonZeroUsize::new(threads).unwrap(), autoreset };
    ParallelVectorEnv::new(COUNT, config, |_| TimeLimit::new(Drifts::new(), 14)).unwrap()
}

/// Its own push for each environment, agent and step, of those who are there.
fn push(index: usize, step: usize, present: &[EntityId]) -> Push {
    let level = |agent: &EntityId| ((step * 3 + index * 5 + agent.index() * 2) % 11) as f64 / 5.0 - 1.0;
    present.iter().map(|agent| (*agent, SpaceValue::Box(vec![level(agent)]))).collect()
}

/// Who acts after a step: whoever was not in its last, or is in an episode that has begun.
fn present(step: &ParallelVectorStep<SpaceValue>) -> Vec<EntityId> {
    match &step.begun {
        Some(start) => start.keys().copied().collect(),
        None => step.transitions.iter().filter(|(_, one)| !one.is_last()).map(|(id, _)| *id).collect(),
    }
}

type Played = (Vec<ParallelStart<SpaceValue>>, Vec<Vec<ParallelVectorStep<SpaceValue>>>);

fn play(env: &mut ParallelVectorEnv<TimeLimit<Drifts>>, steps: usize) -> Played {
    let begun = env.reset(Some(Seed(5)), &Options::new()).unwrap();
    let mut there: Vec<Vec<EntityId>> = begun.iter().map(|start| start.keys().copied().collect()).collect();
    let mut all = Vec::new();
    for step in 0..steps {
        let actions = there.iter().enumerate().map(|(index, there)| push(index, step, there)).collect();
        let stepped = env.step(actions).unwrap();
        there = stepped.iter().map(present).collect();
        all.push(stepped);
    }
    (begun, all)
}

/// What one environment does alone, for as many steps as its episodes take.
fn play_alone(index: usize, steps: usize) -> Vec<ParallelStep<SpaceValue>> {
    let mut env = TimeLimit::new(Drifts::new(), 14).unwrap();
    let seed = Seed(5).stream("gym/vector").indexed(index as u64).seed();
    let mut there: Vec<EntityId> =
        ParallelEnv::reset(&mut env, Some(seed), &Options::new()).unwrap().into_keys().collect();
    let mut all = Vec::new();
    for step in 0..steps {
        let stepped = ParallelEnv::step(&mut env, &push(index, step, &there)).unwrap();
        there.retain(|agent| stepped.get(agent).is_some_and(|one| !one.is_last()));
        if there.is_empty() {
            there = ParallelEnv::reset(&mut env, None, &Options::new()).unwrap().into_keys().collect();
        }
        all.push(stepped);
    }
    all
}

#[test]
fn games_of_several_do_not_mind_threads_and_do_what_they_do_alone() {
    let (begun, one) = play(&mut games(1, Autoreset::SameStep), 60);
    assert!(begun.iter().all(|start| start.len() == 3));
    for threads in [2, 3, 8] {
        assert_eq!(play(&mut games(threads, Autoreset::SameStep), 60), (begun.clone(), one.clone()));
    }
    let (mut alone_ones, mut together_left) = (0, 0);
    for index in 0..COUNT {
        for (step, own) in one.iter().zip(play_alone(index, 60)) {
            assert_eq!(step[index].transitions, own);
            alone_ones += usize::from(own.len() < 3);
            let is_last = own.values().all(Transition::is_last);
            together_left += usize::from(is_last && step[index].begun.is_some());
            assert!(step[index].begun.is_none() || is_last, "an episode ends with its last agent");
        }
    }
    assert!(alone_ones > 20, "in {alone_ones} steps somebody was gone before the others");
    assert!(together_left >= COUNT * 3, "{together_left} episodes ended");
}

#[test]
fn games_of_several_begin_anew_in_the_next_step_or_when_told() {
    let (_, steps) = play(&mut games(2, Autoreset::NextStep), 60);
    for index in 0..COUNT {
        let (mut is_over, mut gone, mut begun) = (false, 0, 0);
        for step in &steps {
            let ParallelVectorStep { transitions, begun: start } = &step[index];
            assert_eq!((start.is_some(), transitions.is_empty()), (is_over, is_over));
            gone = if is_over { 0 } else { gone + transitions.values().filter(|one| one.is_last()).count() };
            begun += usize::from(is_over);
            is_over = gone == 3;
        }
        assert!(begun >= 3, "environment {index} began {begun} times");
    }
    let mut env = games(2, Autoreset::Disabled);
    assert!(env.step(vec![Push::new(); COUNT]).is_err(), "nobody has begun");
    env.reset(Some(Seed(5)), &Options::new()).unwrap();
    for _ in 0..14 {
        env.step(vec![Push::new(); COUNT]).unwrap();
    }
    let refused = env.step(vec![Push::new(); COUNT]).expect_err("all are over");
    assert!(matches!(refused, VectorError::Env { index: 0, source: EnvError::NotReset }));
    let marks: Vec<bool> = (0..COUNT).map(|index| index != 2).collect();
    let begun = env.reset_marked(&marks, None).unwrap();
    assert_eq!(begun.iter().map(Option::is_some).collect::<Vec<_>>(), marks);
    let ghost = EntityId::new(9, 0);
    assert!(env.reset_marked(&[true; COUNT], None).is_ok());
    let mut actions = vec![Push::new(); COUNT];
    actions[4].insert(ghost, SpaceValue::Box(vec![0.0]));
    let error = env.step(actions).expect_err("nobody of that name plays");
    assert!(matches!(error, VectorError::Env { index: 4, .. }), "{error}");
    assert_eq!(env.spaces(0, EntityId::new(1, 0)).unwrap(), Drift::new().spaces());
    assert_eq!((env.len(), env.is_empty()), (COUNT, false));
}
