//! Environments that are stepped together: the same on any number of threads and in any process, with each way to begin anew.

#![allow(clippy::unwrap_used, reason = "helpers of tests")]

mod gym_common;

use std::num::NonZeroUsize;
use std::process::Command;

use gym_common::{Drift, digest};
use simworld_agents::gym::{
    Boundary, EnvExt, TimeLimit, VectorConfig, VectorEnv, VectorError, VectorTransition,
};
use simworld_core::hash::StateDigest;
use simworld_core::seam::{Autoreset, Env, EnvError, Options, SpaceValue, Transition};
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
        let arguments = ["--exact", "processes_do_not_matter", "--nocapture"];
        let output = Command::new(program).args(arguments).env(CHILD, "1").output().unwrap();
        let text = String::from_utf8_lossy(&output.stdout);
        let told = text.split("trail=").nth(1).and_then(|rest| rest.split_whitespace().next());
        assert_eq!(told, Some(own.to_string().as_str()), "{text}");
    }
}
