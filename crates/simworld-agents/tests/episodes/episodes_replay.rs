//! A recorded episode runs again without its minds, through the same states.

use crate::episode_common::{ConeHunt, Speaker, hunt, script, words};
use simworld_agents::episode::Episode;
use simworld_core::clock::Tick;
use simworld_core::command::Command;
use simworld_core::record::Recording;
use simworld_core::scene::Scene;
use simworld_core::seed::Seed;

/// Fails whenever it is asked: a replay must not ask it.
fn mute() -> Speaker {
    Speaker { lines: Vec::new(), fails_at: Some(0) }
}

fn run(mut episode: Episode<ConeHunt>, steps: u64) -> Episode<ConeHunt> {
    while !episode.is_over() && episode.task().steps < steps {
        episode.step().expect("nothing fails");
    }
    episode
}

fn replay(recording: &Recording, steps: u64) -> Episode<ConeHunt> {
    let mut episode = hunt(ConeHunt::default(), mute(), Seed(8)).expect("the hunt begins");
    for _ in 0..steps {
        episode.replay_step(recording).expect("nothing fails");
    }
    episode
}

#[test]
fn the_replay_goes_through_the_same_states() {
    let first = run(hunt(ConeHunt::default(), script(), Seed(8)).expect("the hunt begins"), 120);
    // Through a file, as a log is.
    let text = serde_json::to_string(&first.recording()).expect("a recording is data");
    let recording: Recording = serde_json::from_str(&text).expect("a recording reads back");
    assert_eq!(recording.commands.len(), 3, "what the mind said, and nothing else, was recorded");
    let again = replay(&recording, first.task().steps);
    assert_eq!(first.trail().len(), 120);
    assert_eq!(first.trail(), again.trail());
    assert_eq!(first.returns(), again.returns());
    for (tick, digest) in again.trail() {
        recording.confirm(*tick, *digest).expect("every digest is the recorded one");
    }
}

#[test]
fn the_same_seed_gives_the_same_episode_and_another_seed_another() {
    let trail =
        |seed| run(hunt(ConeHunt::default(), script(), Seed(seed)).expect("it begins"), 60).trail().to_vec();
    assert_eq!(trail(1), trail(1));
    assert_ne!(trail(1), trail(2));
}

#[test]
fn a_changed_recording_leaves_the_trail_where_it_was_changed() {
    let first = run(hunt(ConeHunt::default(), script(), Seed(8)).expect("the hunt begins"), 80);
    let mut recording = first.recording();
    let said = &mut recording.commands[0];
    assert_eq!(said.tick, Tick(30));
    said.command = Command::Intend { who: first.agents()[0], intent: words("go to (3, 3)") };
    let again = replay(&recording, 80);
    let parting = first.trail().iter().zip(again.trail()).position(|(a, b)| a != b);
    assert_eq!(parting, Some(30), "the first digest after tick 30 differs, as the executor's plan does");
    assert!(again.simulation().world().entity(again.agents()[0]).is_some());
}
