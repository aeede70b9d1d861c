//! An environment with real bodies, in a generated block among traffic: it keeps the contract over whole trajectories, is the
//! same in any thread and process, and can be learnt.

use std::num::NonZeroUsize;
use std::process::Command;
use std::sync::Arc;

use simworld_agents::gym::{EnvExt, VectorConfig, VectorEnv};
use simworld_core::hash::{StateDigest, StateHash, StateHasher};
use simworld_core::seam::{Env, EnvError, Options, SpaceValue};
use simworld_core::seed::Seed;
use simworld_core::testing::{EnvCheck, check_env};
use simworld_examples::wayfinding::{Field, Many, Policy, Wayfinding, judge, learn};

fn field() -> Arc<Field> {
    Arc::new(Field::new(Seed(1)).unwrap())
}

fn many(field: &Arc<Field>, count: usize, threads: usize, traffic: u32) -> Many {
    let config = VectorConfig { threads: NonZeroUsize::new(threads).unwrap(), ..VectorConfig::default() };
    let field = Arc::clone(field);
    let make = move |_| {
        let env = Wayfinding::new(Arc::clone(&field), traffic);
        env.map_err(|error| EnvError::Simulation(error.to_string()))?.time_limit(40)
    };
    VectorEnv::new(count, config, make).unwrap()
}

#[test]
fn it_keeps_the_contract_among_traffic() {
    let field = field();
    check_env(|_| Wayfinding::new(Arc::clone(&field), 10).unwrap(), &EnvCheck::new(20));
}

#[test]
fn starts_can_be_chosen_and_others_are_refused() {
    let field = field();
    let mut env = Wayfinding::new(Arc::clone(&field), 0).unwrap();
    let wanted = |cell: usize| Options::from([("cell".to_owned(), (cell as i64).into())]);
    let start = field.starts()[7];
    let (seen, _) = env.reset(Some(Seed(1)), &wanted(start)).unwrap();
    assert_eq!(seen, SpaceValue::Discrete(start as i64));
    let blocked = (0..256).find(|cell| !field.starts().contains(cell)).unwrap();
    assert!(matches!(env.reset(Some(Seed(1)), &wanted(blocked)), Err(EnvError::Option { .. })));
}

/// The digest of everything that four of them do among traffic.
fn trail(threads: usize) -> StateDigest {
    let mut envs = many(&field(), 4, threads, 10);
    envs.reset(Some(Seed(3)), &Options::new()).unwrap();
    let mut rng = Seed(4).stream("actions").rng();
    let mut hasher = StateHasher::new();
    for _ in 0..25 {
        let actions = (0..4).map(|_| SpaceValue::Discrete(rng.below(8) as i64)).collect();
        for step in envs.step(actions).unwrap() {
            // the place in the info is that of the body, to the last bit
            step.transition.state_hash(&mut hasher);
        }
    }
    hasher.finish()
}

/// Set in a child of this test, which prints its digest and does no more.
const CHILD: &str = "SIMWORLD_TEST_PRINT_TRAIL";

#[test]
fn threads_and_processes_do_not_matter() {
    let own = trail(2);
    if std::env::var_os(CHILD).is_some() {
        println!("trail={own}");
        return;
    }
    assert_eq!(trail(1), own);
    let arguments =
        ["--exact", "walkers_learn_by_the_contract::threads_and_processes_do_not_matter", "--nocapture"];
    let output =
        Command::new(std::env::current_exe().unwrap()).args(arguments).env(CHILD, "1").output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout);
    let told = text.split("trail=").nth(1).and_then(|rest| rest.split_whitespace().next());
    assert_eq!(told, Some(own.to_string().as_str()), "{text}");
}

#[test]
fn a_table_learns_what_chance_does_not_find() {
    let mut envs = many(&field(), 8, 2, 0);
    let lesson = learn(&mut envs, 5000, 10, Seed(1), |_| {}).unwrap();
    let chance = judge(&mut envs, Policy::Random, 40, Seed(1)).unwrap();
    let learnt = judge(&mut envs, Policy::Learnt(&lesson.table), 40, Seed(1)).unwrap();
    assert!(learnt.found > chance.found + 0.4, "{learnt:?} against {chance:?}");
    assert!(learnt.mean > chance.mean + 0.5, "{learnt:?} against {chance:?}");
    assert_eq!(lesson.curve.len(), 10);
}
