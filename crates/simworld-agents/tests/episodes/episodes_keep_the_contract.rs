//! An episode as an environment keeps the contract of environments over whole trajectories, and goes the same way in any process.

use std::collections::BTreeMap;
use std::process::Command as Process;

use crate::episode_common::{ConeHunt, Speaker, agent, field, hunt, script, words};
use simworld_agents::episode::{Episode, EpisodeError, GymEpisode};
use simworld_agents::observer::{GpsFix, GpsObserver};
use simworld_core::command::Command;
use simworld_core::hash::{StateDigest, StateHash, StateHasher};
use simworld_core::id::EntityId;
use simworld_core::intent::Intent;
use simworld_core::seam::{
    EnvError, Options, ParallelEnv, ParallelStart, ParallelStep, Space, SpaceValue, Transition,
};
use simworld_core::seed::Seed;
use simworld_core::testing::{EnvCheck, check_parallel_env};

const FIRST: EntityId = EntityId::new(1, 0);
const SECOND: EntityId = EntityId::new(2, 0);

/// What may be said: a call that the task answers, orders that are carried out, and one that nobody understands.
const LINES: [&str; 6] = [
    "cheer",
    "go to (5, 5)",
    "go to the nearest cone",
    "go to the nearest chair and sit down",
    "wait 2 seconds",
    "abracadabra",
];

/// Whether the second walker is there to the end.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Second {
    Stays,
    LeavesAtOnce,
}

/// The hunt as an environment whose observations and actions are members of its spaces: a fix is five numbers, and what is said is any
/// text, or one of [`LINES`].
struct Spoken {
    env: GymEpisode<ConeHunt, GpsObserver>,
    actions: Space,
}

impl Spoken {
    /// Whatever may be said; most of it is not understood.
    fn freely(task: ConeHunt, second: Second) -> Self {
        let env =
            GymEpisode::new(GpsObserver::new(1.0, 0.1, Seed(9)), move |seed| build(&task, seed, second));
        let (_, actions) = env.spaces(FIRST);
        Self { env, actions }
    }

    /// One of the lines.
    fn by_lines(task: ConeHunt, second: Second) -> Self {
        Self { actions: Space::discrete(LINES.len() as u64), ..Self::freely(task, second) }
    }
}

fn build(task: &ConeHunt, seed: Seed, second: Second) -> Result<Episode<ConeHunt>, EpisodeError> {
    let (simulation, ids) = field();
    let agents = ids.into_iter().map(|id| agent(id, Speaker::default())).collect();
    let mut episode = Episode::new(simulation, task.clone(), agents, seed)?;
    if second == Second::LeavesAtOnce {
        episode.submit(Command::Remove { id: SECOND });
    }
    Ok(episode)
}

/// The intent of an action that is in its space.
fn intent(action: &SpaceValue) -> Intent {
    match action {
        SpaceValue::Discrete(index) => match LINES[*index as usize] {
            "cheer" => Intent::call("cheer"),
            line => words(line),
        },
        SpaceValue::Text(text) => words(text),
        other => panic!("{other:?} was checked"),
    }
}

fn numbers(fix: GpsFix) -> SpaceValue {
    let GpsFix { position, heading, speed } = fix;
    SpaceValue::Box(vec![position.x, position.y, position.z, heading, speed])
}

impl ParallelEnv for Spoken {
    type Observation = SpaceValue;
    type Action = SpaceValue;

    fn reset(
        &mut self,
        seed: Option<Seed>,
        options: &Options,
    ) -> Result<ParallelStart<SpaceValue>, EnvError> {
        let start = self.env.reset(seed, options)?;
        Ok(start.into_iter().map(|(id, (fix, info))| (id, (numbers(fix), info))).collect())
    }

    fn step(
        &mut self,
        actions: &BTreeMap<EntityId, SpaceValue>,
    ) -> Result<ParallelStep<SpaceValue>, EnvError> {
        let mut said = BTreeMap::new();
        for (who, action) in actions {
            let checked = self.actions.check(action);
            checked.map_err(|source| EnvError::Action { who: *who, source })?;
            said.insert(*who, intent(action));
        }
        let step = self.env.step(&said)?;
        Ok(step.into_iter().map(|(id, one)| (id, one.map(numbers))).collect())
    }

    fn spaces(&self, agent: EntityId) -> (Space, Space) {
        (self.env.spaces(agent).0, self.actions.clone())
    }
}

#[test]
fn the_contract_is_kept_whatever_is_said_and_whoever_leaves() {
    let check = EnvCheck::new(40);
    let timed = || ConeHunt { truncates_at: Some(25), ..ConeHunt::default() };
    check_parallel_env(|_| Spoken::freely(ConeHunt::default(), Second::Stays), &check);
    check_parallel_env(|_| Spoken::freely(timed(), Second::LeavesAtOnce), &check);
    for second in [Second::Stays, Second::LeavesAtOnce] {
        check_parallel_env(|_| Spoken::by_lines(ConeHunt::default(), second), &check);
        check_parallel_env(|_| Spoken::by_lines(timed(), second), &check);
    }
}

/// Random lines of everybody who is there, with the state of the whole episode after each step.
fn digest_of_lines(seed: Seed, steps: usize) -> StateDigest {
    let mut env = Spoken::by_lines(ConeHunt::default(), Second::Stays);
    let mut hasher = StateHasher::new();
    let start = env.reset(Some(seed), &Options::new()).unwrap();
    let mut present: Vec<EntityId> = start.keys().copied().collect();
    let mut rng = seed.stream("lines").rng();
    for step in 0..steps {
        if present.is_empty() {
            break;
        }
        // Something new every three seconds, so that orders get somewhere before the next.
        let speaks = step % 30 == 0;
        let said: BTreeMap<_, _> =
            present.iter().filter(|_| speaks).map(|id| (*id, env.actions.sample(&mut rng))).collect();
        let transitions = env.step(&said).unwrap();
        for (id, transition) in &transitions {
            transition.state_hash(hasher.u64((*id).into()));
        }
        env.env.episode().unwrap().state_hash(&mut hasher);
        present.retain(|id| !transitions.get(id).is_some_and(Transition::is_last));
    }
    hasher.finish()
}

/// An episode in which minds speak: every digest of its trail, and every reward.
fn digest_of_minds(seed: Seed, steps: u64) -> StateDigest {
    let mut episode = hunt(ConeHunt::default(), script(), seed).unwrap();
    let mut hasher = StateHasher::new();
    while !episode.is_over() && episode.task().steps < steps {
        for reward in &episode.step().unwrap().rewards {
            hasher.f64(*reward);
        }
    }
    assert_eq!(episode.trail().len() as u64, episode.task().steps, "each step leaves a digest");
    for (tick, digest) in episode.trail() {
        hasher.u64(tick.0).u64(digest.0);
    }
    hasher.finish()
}

/// Set in a child of this test, which prints its digests and does no more.
const CHILD: &str = "SIMWORLD_TEST_PRINT_TRAIL";

#[test]
fn processes_do_not_matter() {
    let digests = |seed| [digest_of_minds(Seed(seed), 200), digest_of_lines(Seed(seed), 300)];
    let own = digests(8);
    let shown = format!("{}/{}", own[0], own[1]);
    if std::env::var_os(CHILD).is_some() {
        println!("trail={shown}");
        return;
    }
    let another = digests(9);
    assert!(another[0] != own[0] && another[1] != own[1], "digests that tell seeds apart");
    // Threads beside it change nothing either.
    let beside: Vec<_> = (0..3).map(|_| std::thread::spawn(move || digests(8))).collect();
    for thread in beside {
        assert_eq!(thread.join().unwrap(), own);
    }
    for _ in 0..2 {
        let arguments = ["--exact", "episodes_keep_the_contract::processes_do_not_matter", "--nocapture"];
        let program = std::env::current_exe().unwrap();
        let output = Process::new(program).args(arguments).env(CHILD, "1").output().unwrap();
        let text = String::from_utf8_lossy(&output.stdout);
        let told = text.split("trail=").nth(1).and_then(|rest| rest.split_whitespace().next());
        assert_eq!(told, Some(shown.as_str()), "{text}");
    }
}
