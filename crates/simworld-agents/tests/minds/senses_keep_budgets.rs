//! Any set of senses is told within a budget of tokens, shared by weight, and nothing of it is wasted.

use proptest::prelude::*;
use simworld_agents::observer::{
    Describe, Feedback, GpsObserver, SceneGraphObserver, Sense, Senses, tokens_in,
};
use simworld_core::clock::Tick;
use simworld_core::event::{Event, EventKind};
use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
use simworld_core::seam::{ObserveError, Observer, SpaceValue};

/// A street of benches with names, and somebody on it.
fn street(benches: usize) -> (World, EntityId) {
    let mut world = World::new();
    let at = |x, y| pose_facing(Point3::new(x, y, 0.0), 0.0);
    let body = Shape::Capsule { radius: 0.25, height: 1.8 };
    let me = world.spawn(EntityDesc::new(EntityKind::Person, at(0.0, 0.0), body)).expect("there is room");
    for index in 0..benches {
        let bench =
            EntityDesc::new(EntityKind::Bench, at(3.0 + index as f64, 2.0), Shape::cuboid(0.6, 1.8, 0.8));
        world.spawn(bench.named(format!("bench of the {index}th donor"))).expect("there is room");
    }
    (world, me)
}

fn said(to: EntityId, words: &str) -> Event {
    let kind = EventKind::Said { who: EntityId::new(9, 0), to, words: words.to_owned() };
    Event { tick: Tick(0), kind }
}

fn all_senses() -> Senses {
    Senses::new()
        .with("receiver", GpsObserver::exact())
        .with_sense("since then", 2.0, Feedback::default())
        .with("in sight", SceneGraphObserver::new(100.0))
}

/// An observer that says more than it may.
struct Chatter;
#[derive(Default)]
struct Chat;

impl Describe for Chat {
    fn describe(&self, _: usize) -> String {
        "many words that nobody asked for\n".repeat(50)
    }
}

impl Observer for Chatter {
    type Observation = Chat;

    fn observe(&mut self, _: &dyn Scene, _: EntityId, _: &mut Chat) -> Result<(), ObserveError> {
        Ok(())
    }
}

#[test]
fn with_room_enough_everything_is_told() {
    let (world, me) = street(5);
    let mut senses = all_senses();
    senses.tell("task", "deliver order 3\n".to_owned());
    assert_eq!(senses.names().collect::<Vec<_>>(), ["receiver", "since then", "in sight", "task"]);
    senses.perceive(&world, me).expect("somebody is there");
    senses.notice(&[said(me, "hello"), said(EntityId::new(7, 0), "not for you")], me);
    let prompt = senses.prompt(10_000);
    for part in
        ["[receiver]\n(0.0, 0.0)", "- #9 said to you: \"hello\"", "4th donor", "[task]\ndeliver order 3"]
    {
        assert!(prompt.contains(part), "{part} is missing in {prompt}");
    }
    assert!(!prompt.contains("not for you"));
    senses.told();
    assert!(!senses.prompt(10_000).contains("since then"), "feedback is told once");
    let values = senses.values();
    assert!(matches!(values.get("receiver"), Some(SpaceValue::Box(numbers)) if numbers.len() == 5));
    assert!(!values.contains_key("in sight"));
}

#[test]
fn what_one_does_not_need_the_others_have() {
    let (world, me) = street(40);
    let mut senses = all_senses();
    senses.perceive(&world, me).expect("somebody is there");
    let prompt = senses.prompt(300);
    // The receiver and the feedback need a few tokens: nearly all of the 300 go to what is in sight.
    assert!((270..=300).contains(&tokens_in(&prompt)), "{} tokens: {prompt}", tokens_in(&prompt));
    let shown = prompt.matches("donor").count();
    assert!(shown >= 9 && prompt.contains(&format!("... and {} more", 40 - shown)), "{prompt}");
}

#[test]
fn the_newest_feedback_is_kept() {
    let (world, me) = street(0);
    let mut senses = Senses::new().with_sense("since then", 1.0, Feedback::default());
    senses.perceive(&world, me).expect("somebody is there");
    let events: Vec<Event> = (0..200).map(|index| said(me, &format!("word {index}"))).collect();
    senses.notice(&events, me);
    let prompt = senses.prompt(60);
    assert!(prompt.contains("word 199") && !prompt.contains("word 100"), "{prompt}");
    let mut again = Senses::new().with_sense("since then", 1.0, Feedback::default());
    assert!(again.restore(&senses.save()) && again.prompt(60) == prompt);
    assert!(!again.restore(&[]) && !again.restore(&[vec![255]]));
}

#[test]
fn a_sense_of_the_same_name_takes_the_place_of_the_first() {
    let senses = all_senses().with("receiver", SceneGraphObserver::new(5.0));
    assert_eq!(senses.names().collect::<Vec<_>>(), ["receiver", "since then", "in sight"]);
    let (world, _) = street(0);
    let nobody = EntityId::new(99, 0);
    assert_eq!(all_senses().perceive(&world, nobody), Err(ObserveError::Missing { id: nobody }));
}

/// Senses may be sent to the thread of a mind.
const fn is_send<T: Send>() {}
const _: () = is_send::<Senses>();
const _: () = is_send::<Box<dyn Sense>>();

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn no_budget_is_exceeded(budget in 0_usize..600, benches in 0_usize..30, words in ".{0,300}", weight in 0.0_f64..9.0) {
        let (world, me) = street(benches);
        let mut senses = all_senses().with_sense("heavy", weight, Feedback::default()).with("chatter", Chatter);
        senses.tell("task", words.clone());
        senses.perceive(&world, me).expect("somebody is there");
        senses.notice(&[said(me, &words)], me);
        let prompt = senses.prompt(budget);
        prop_assert!(tokens_in(&prompt) <= budget, "{} of {budget}: {prompt}", tokens_in(&prompt));
    }
}
