//! A saved episode goes on as if it had never stopped.

use crate::episode_common::{ConeHunt, Speaker, agent, field, hunt, script};
use simworld_agents::episode::{Episode, EpisodeError, EpisodeSnapshot};
use simworld_core::seed::Seed;

fn fresh() -> Episode<ConeHunt> {
    hunt(ConeHunt::default(), script(), Seed(5)).expect("the hunt begins")
}

fn step(episode: &mut Episode<ConeHunt>, steps: u32) {
    for _ in 0..steps {
        episode.step().expect("nothing fails");
    }
}

#[test]
fn save_load_and_go_on_equals_a_straight_run() {
    let mut straight = fresh();
    step(&mut straight, 130);
    // In the middle of a walk, of a sentence, of a wait and while seated.
    for pause in [1, 12, 33, 60, 90, 105] {
        let mut first = fresh();
        step(&mut first, pause);
        let bytes = postcard::to_stdvec(&first.save().expect("it can be saved")).expect("a snapshot is data");
        let snapshot: EpisodeSnapshot = postcard::from_bytes(&bytes).expect("a snapshot reads back");
        let mut second = fresh();
        second.restore(snapshot).expect("the parts are the same");
        step(&mut second, 130 - pause);
        assert_eq!(straight.trail()[pause as usize..], *second.trail(), "paused after {pause}");
        assert_eq!(straight.returns(), second.returns());
    }
}

#[test]
fn a_snapshot_of_other_agents_is_refused() {
    let mut first = fresh();
    step(&mut first, 3);
    let (simulation, ids) = field();
    let alone = vec![agent(ids[0], Speaker::default())];
    let mut other = Episode::new(simulation, ConeHunt::default(), alone, Seed(5)).expect("it begins");
    let refused = other.restore(first.save().expect("it can be saved"));
    assert!(matches!(refused, Err(EpisodeError::Agents { .. })));
}
