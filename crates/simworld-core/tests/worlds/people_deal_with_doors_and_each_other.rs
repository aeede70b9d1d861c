//! Doors, gifts, purchases and talk: what each changes, and why it is refused.

use simworld_core::action::{Action, ActionKind};
use simworld_core::event::EventKind;
use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::hash::StateHash;
use simworld_core::id::EntityId;
use simworld_core::scene::{
    EntityDesc, EntityKind, GESTURE, Gesture, InteractionError, LOCKED, OPEN, Place, Role, SELLS, Scene,
    Shape, World, check_action,
};
use simworld_core::value::Value;

fn put(world: &mut World, desc: EntityDesc) -> EntityId {
    world.spawn(desc).unwrap()
}

fn thing(kind: EntityKind, x: f64) -> EntityDesc {
    EntityDesc::new(kind, pose_facing(Point3::new(x, 0.0, 0.0), 0.0), Shape::cuboid(0.4, 0.4, 1.8))
}

fn person(world: &mut World, x: f64) -> EntityId {
    put(world, thing(EntityKind::Person, x))
}

#[test]
fn a_door_opens_and_closes_once_and_not_when_locked() {
    let mut world = World::new();
    let me = person(&mut world, 0.0);
    let door = put(&mut world, thing(EntityKind::Door, 1.0));
    let locked = put(&mut world, thing(EntityKind::Door, -1.0).with(LOCKED, true));
    world.actuate(me, Action::OpenDoor { door }).unwrap();
    assert_eq!(world.entity(door).unwrap().info.attributes.get(OPEN), Some(&Value::Bool(true)));
    let again = world.actuate(me, Action::OpenDoor { door }).unwrap_err();
    assert_eq!(again.to_string(), format!("door {door} is open already"));
    world.actuate(me, Action::CloseDoor { door }).unwrap();
    assert!(world.actuate(me, Action::CloseDoor { door }).is_err(), "closed twice");
    let refused = world.actuate(me, Action::OpenDoor { door: locked }).unwrap_err();
    assert!(matches!(refused, InteractionError::State { state: "locked", .. }), "{refused}");
}

#[test]
fn what_is_given_changes_hands() {
    let mut world = World::new();
    let (me, other) = (person(&mut world, 0.0), person(&mut world, 1.0));
    let parcel = put(&mut world, thing(EntityKind::Parcel, 0.5));
    assert!(world.actuate(me, Action::Give { to: other }).is_err(), "gave nothing");
    world.actuate(me, Action::PickUp { item: parcel }).unwrap();
    assert!(world.actuate(me, Action::Give { to: me }).is_err(), "gave to himself");
    world.actuate(me, Action::Give { to: other }).unwrap();
    assert_eq!((world.attached(me, Role::Held), world.attached(other, Role::Held)), (None, Some(parcel)));
    let second = put(&mut world, thing(EntityKind::Parcel, 0.5));
    world.actuate(me, Action::PickUp { item: second }).unwrap();
    assert!(world.actuate(me, Action::Give { to: other }).is_err(), "the other's hands are full");
}

#[test]
fn what_is_bought_is_what_is_sold() {
    let mut world = World::new();
    let me = person(&mut world, 0.0);
    let kiosk = thing(EntityKind::Building, 1.0).used_as(Place::Store).with(SELLS, "tea, map");
    let kiosk = put(&mut world, kiosk);
    let buy = |goods: &str| Action::Buy { goods: goods.to_owned(), from: kiosk };
    let refused = world.actuate(me, buy("piano")).unwrap_err();
    assert!(matches!(refused, InteractionError::NotSold { .. }), "{refused}");
    world.actuate(me, buy("tea")).unwrap();
    let tea = world.attached(me, Role::Held).unwrap();
    assert_eq!(world.entity(tea).unwrap().label(), "tea");
    let told = world
        .events()
        .iter()
        .any(|event| event.kind == EventKind::Bought { who: me, from: kiosk, item: tea });
    assert!(told, "{:?}", world.events());
    assert!(world.actuate(me, buy("map")).is_err(), "the hand is full");
}

#[test]
fn who_is_spoken_to_is_near_and_hears_the_words() {
    let mut world = World::new();
    let (me, near, far) = (person(&mut world, 0.0), person(&mut world, 6.0), person(&mut world, 60.0));
    let tree = put(&mut world, thing(EntityKind::Tree, 2.0));
    let say = |with| Action::Converse { with, words: "good day".to_owned() };
    world.actuate(me, say(near)).unwrap();
    let said = EventKind::Said { who: me, to: near, words: "good day".to_owned() };
    assert!(world.events().iter().any(|event| event.kind == said));
    assert!(matches!(world.actuate(me, say(far)), Err(InteractionError::OutOfEarshot { .. })));
    assert!(matches!(world.actuate(me, say(tree)), Err(InteractionError::WrongKind { .. })));
    world.actuate(me, Action::Argue { with: near }).unwrap();
    let argued = EventKind::Gesture { who: me, gesture: ActionKind::Argue, to: Some(near), heading: None };
    assert!(world.events().iter().any(|event| event.kind == argued));
}

/// Steps until somebody's arms are still again; how many that were.
fn steps_of_gesture(world: &mut World, who: EntityId) -> u32 {
    let mut steps = 0;
    while world.entity(who).unwrap().gesture().is_some() {
        world.finish_step();
        world.begin_step();
        steps += 1;
        assert!(steps < 1000, "it never ends");
    }
    steps
}

#[test]
fn gestures_are_seen_and_end() {
    let mut world = World::new();
    let (me, other) = (person(&mut world, 0.0), person(&mut world, 3.0));
    let say = |words: &str| Action::Converse { with: other, words: words.to_owned() };
    let before = world.entity(me).unwrap().info.clone();
    for (action, gesture, seconds) in [
        (Action::WaveHand { to: other }, Gesture::Wave, 2.5),
        (Action::PointDirection { heading: 2.0 }, Gesture::Point, 2.5),
        (Action::Argue { with: other }, Gesture::Argue, 4.0),
        (say("yes"), Gesture::Talk, 1.5),
        (say(&"word ".repeat(20)), Gesture::Talk, 8.0),
    ] {
        let steps = u32::try_from(world.clock().ticks_in(seconds)).unwrap();
        world.actuate(me, action.clone()).unwrap();
        let entity = world.entity(me).unwrap();
        assert_eq!(entity.gesture(), Some(gesture), "{action:?}");
        assert_eq!(entity.pointing(), (gesture == Gesture::Point).then_some(2.0), "{action:?}");
        assert_eq!(steps_of_gesture(&mut world, me), steps, "{action:?}");
        assert_eq!(world.entity(me).unwrap().info, &before, "nothing is left of {action:?}");
    }
}

#[test]
fn a_gesture_ends_with_the_next_that_needs_the_arms() {
    let mut world = World::new();
    let (me, other) = (person(&mut world, 0.0), person(&mut world, 3.0));
    let parcel = put(&mut world, thing(EntityKind::Parcel, 0.5));
    let gesture = |world: &World| world.entity(me).unwrap().gesture();
    world.actuate(me, Action::WaveHand { to: other }).unwrap();
    world.actuate(me, Action::MoveForward { speed: 1.0 }).unwrap();
    assert_eq!(gesture(&world), Some(Gesture::Wave), "one waves while one walks");
    world.actuate(me, Action::Argue { with: other }).unwrap();
    assert_eq!(gesture(&world), Some(Gesture::Argue));
    assert!(world.actuate(me, Action::DropOff).is_err());
    assert_eq!(gesture(&world), Some(Gesture::Argue), "what is refused ends nothing");
    world.actuate(me, Action::PickUp { item: parcel }).unwrap();
    assert_eq!(gesture(&world), None);
    // One that somebody sets by hand has no end.
    world.set_attribute(me, GESTURE, Some(Gesture::Point.as_str().into())).unwrap();
    for _ in 0..100 {
        world.finish_step();
    }
    assert_eq!(gesture(&world), Some(Gesture::Point));
}

#[test]
fn a_saved_gesture_ends_when_it_would_have_ended() {
    let mut world = World::new();
    let (me, other) = (person(&mut world, 0.0), person(&mut world, 3.0));
    world.actuate(me, Action::WaveHand { to: other }).unwrap();
    for _ in 0..10 {
        world.finish_step();
    }
    let mut resumed = World::restore(world.snapshot()).unwrap();
    assert_eq!(steps_of_gesture(&mut resumed, me), steps_of_gesture(&mut world, me));
    assert_eq!(resumed.digest(), world.digest());
}

#[test]
fn checking_an_action_changes_nothing_and_agrees_with_doing_it() {
    let mut world = World::new();
    let me = person(&mut world, 0.0);
    let things: Vec<EntityId> =
        EntityKind::ALL.iter().map(|kind| put(&mut world, thing(*kind, 1.0).with(SELLS, "tea"))).collect();
    for thing in things {
        for kind in ActionKind::ALL {
            let action = simworld_core::testing::sample_action(*kind, thing);
            let mut trial = World::restore(world.snapshot()).unwrap();
            let checked = check_action(&world, me, &action);
            assert_eq!(trial.actuate(me, action.clone()), checked, "{action:?}");
        }
    }
}
