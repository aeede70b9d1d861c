//! The Gym view of an episode: seeds, ends, and actions in their space.

use std::collections::BTreeMap;

use crate::episode_common::{ConeHunt, Speaker, agent, field, words};
use simworld_agents::episode::{Episode, EpisodeError, GymEpisode};
use simworld_agents::observer::GpsObserver;
use simworld_core::command::Command;
use simworld_core::id::EntityId;
use simworld_core::intent::Intent;
use simworld_core::seam::{EnvError, Options, ParallelEnv, Space};
use simworld_core::seed::Seed;

fn build(task: &ConeHunt, seed: Seed) -> Result<Episode<ConeHunt>, EpisodeError> {
    let (simulation, ids) = field();
    let agents = ids.into_iter().map(|id| agent(id, Speaker::default())).collect();
    Episode::new(simulation, task.clone(), agents, seed)
}

fn gym(task: ConeHunt) -> GymEpisode<ConeHunt, GpsObserver> {
    GymEpisode::new(GpsObserver::new(1.0, 0.1, Seed(9)), move |seed| build(&task, seed))
}

const FIRST: EntityId = EntityId::new(1, 0);
const SECOND: EntityId = EntityId::new(2, 0);

fn say(who: EntityId, intent: Intent) -> BTreeMap<EntityId, Intent> {
    BTreeMap::from([(who, intent)])
}

#[test]
fn a_seed_gives_the_whole_trajectory() {
    let trajectory = |gym: &mut GymEpisode<ConeHunt, GpsObserver>, seed| {
        let mut trace = vec![format!("{:?}", gym.reset(seed, &Options::new()).expect("it resets"))];
        let mut actions = say(FIRST, words("go to (5, 5)"));
        for _ in 0..50 {
            trace.push(format!("{:?}", gym.step(&std::mem::take(&mut actions)).expect("it steps")));
        }
        trace
    };
    let mut gym = gym(ConeHunt::default());
    let first = trajectory(&mut gym, Some(Seed(1)));
    let unseeded = trajectory(&mut gym, None);
    assert_eq!(trajectory(&mut gym, Some(Seed(1))), first);
    assert_eq!(trajectory(&mut gym, None), unseeded, "without a seed it follows from the last");
    assert_ne!(unseeded, first);
}

#[test]
fn termination_and_truncation_are_told_apart() {
    let mut timed = gym(ConeHunt { truncates_at: Some(4), ..ConeHunt::default() });
    timed.reset(Some(Seed(1)), &Options::new()).expect("it resets");
    let last = (0..4).map(|_| timed.step(&BTreeMap::new()).expect("it steps")).last().expect("four steps");
    assert!(last.values().all(|transition| transition.truncated && !transition.terminated));
    assert!(matches!(timed.step(&BTreeMap::new()), Err(EnvError::NotReset)));
    timed.reset(None, &Options::new()).expect("it resets again");
    timed.step(&BTreeMap::new()).expect("and goes on");

    let mut hunt = gym(ConeHunt::default());
    hunt.reset(Some(Seed(1)), &Options::new()).expect("it resets");
    let end = (0..900).find_map(|_| {
        let step = hunt.step(&BTreeMap::new()).expect("it steps");
        step.values().any(|transition| transition.terminated || transition.truncated).then_some(step)
    });
    let end = end.expect("the hunt ends");
    assert!(end.values().all(|transition| transition.terminated && !transition.truncated));
}

#[test]
fn rewards_come_to_those_who_earned_them() {
    let mut gym = gym(ConeHunt::default());
    gym.reset(Some(Seed(1)), &Options::new()).expect("it resets");
    let step = gym.step(&say(SECOND, Intent::call("cheer"))).expect("it steps");
    assert_eq!((step[&FIRST].reward, step[&SECOND].reward), (0.0, 10.0));
}

#[test]
fn actions_outside_the_space_change_nothing() {
    let mut gym = gym(ConeHunt::default());
    assert!(matches!(gym.step(&BTreeMap::new()), Err(EnvError::NotReset)), "not before a reset");
    gym.reset(Some(Seed(1)), &Options::new()).expect("it resets");
    let (_, Space::Text { max_length }) = gym.spaces(FIRST) else { panic!("actions are words") };
    assert_eq!(gym.spaces(FIRST), gym.spaces(FIRST));
    for actions in [say(FIRST, words(&"a".repeat(max_length + 1))), say(EntityId::new(0, 0), words("stop"))] {
        assert!(matches!(gym.step(&actions), Err(EnvError::Action { .. })));
    }
    assert_eq!(gym.episode().expect("under way").task().steps, 0);
}

#[test]
fn who_leaves_the_world_is_told_so_once() {
    let mut gym = GymEpisode::new(GpsObserver::exact(), |seed| {
        let mut episode = build(&ConeHunt::default(), seed)?;
        episode.submit(Command::Remove { id: SECOND });
        Ok(episode)
    });
    gym.reset(Some(Seed(1)), &Options::new()).expect("it resets");
    let step = gym.step(&BTreeMap::new()).expect("it steps");
    assert!(step[&SECOND].terminated && !step[&FIRST].terminated);
    let step = gym.step(&BTreeMap::new()).expect("it steps");
    assert_eq!(step.keys().copied().collect::<Vec<_>>(), [FIRST]);
    assert!(
        matches!(gym.step(&say(SECOND, words("stop"))), Err(EnvError::Action { .. })),
        "who is gone is refused"
    );
}
