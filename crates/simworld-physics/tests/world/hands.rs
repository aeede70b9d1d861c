//! What hands are told is a command: it is recorded, replayed and rolled back bit for bit, and bounded by the arm.
#![allow(clippy::unwrap_used)]

use crate::common::{PERSON, Stage, at};
use simworld_core::action::{Action, ActionKind};
use simworld_core::command::Command;
use simworld_core::event::EventKind;
use simworld_core::geometry::{Point3, Vector3, pose_facing};
use simworld_core::hash::StateHash;
use simworld_core::id::EntityId;
use simworld_core::record::Recording;
use simworld_core::scene::{EntityDesc, EntityKind, Role, Scene, Shape, World};
use simworld_core::simulation::Simulation;
use simworld_physics::{CartConfig, HumanoidConfig, PhysicsConfig, PhysicsDynamics, PhysicsError};

/// Two people so far apart, the first with a parcel of that mass in the hand.
fn pair(apart: f64, mass: f64) -> (Stage, EntityId, EntityId, EntityId) {
    let mut stage = Stage::new();
    let who = stage.person(at(0.0, 0.0, 0.0));
    let other = stage.person(at(apart, 0.0, 3.1));
    let desc = EntityDesc::new(EntityKind::Parcel, at(0.5, 0.0, 0.0), Shape::cuboid(0.2, 0.15, 0.1));
    let parcel = stage.world.spawn(desc.weighing(mass)).unwrap();
    stage.tell(who, Action::PickUp { item: parcel });
    stage.run(2);
    (stage, who, other, parcel)
}

fn is_met(stage: &Stage, one: EntityId, other: EntityId) -> bool {
    stage.contacts.iter().any(
        |event| matches!(event, EventKind::Contact { a, b, .. } if [*a, *b] == [one.min(other), one.max(other)]),
    )
}

/// What was refused, and why.
fn failure(stage: &Stage, kind: ActionKind) -> Option<String> {
    stage.events.iter().rev().find_map(|event| match event {
        EventKind::ActionFailed { action, reason, .. } if *action == kind => Some(reason.clone()),
        _ => None,
    })
}

#[test]
fn what_is_thrown_at_somebody_meets_him_whether_he_stands_or_walks() {
    for (apart, speed) in [(3.0, 0.0), (8.0, 0.0), (15.0, 0.0), (8.0, 1.2)] {
        let (mut stage, who, other, parcel) = pair(apart, 1.0);
        // Across the line of the throw.
        stage.tell(other, Action::Rotate { angle: 1.5 });
        stage.run(10);
        stage.tell(other, Action::MoveForward { speed });
        stage.run(5);
        stage.tell(who, Action::ThrowTo { to: other });
        stage.run(25);
        assert!(
            stage
                .events
                .iter()
                .any(|event| matches!(event, EventKind::Thrown { item, .. } if *item == parcel))
        );
        assert!(
            is_met(&stage, other, parcel),
            "{apart} m away at {speed} m/s: it lies at {}",
            stage.position(parcel)
        );
    }
}

#[test]
fn the_arm_bounds_the_throw_by_the_mass_of_what_is_thrown() {
    // Half (m + 0.64 kg) v² is 200 J.
    for mass in [0.2, 1.0, 5.0, 14.0_f64] {
        let most = (400.0 / (mass + 0.64)).sqrt();
        let (mut stage, who, _, parcel) = pair(30.0, mass);
        let error = stage.physics.throw(&mut stage.world, who, Vector3::x() * (1.01 * most)).unwrap_err();
        assert!(matches!(error, PhysicsError::Weak { .. }), "{error}");
        stage.tell(who, Action::Throw { velocity: Vector3::x() * (1.01 * most) });
        stage.run(1);
        assert!(failure(&stage, ActionKind::Throw).unwrap().contains("the arm gives"));
        assert_eq!(stage.world.attached(who, Role::Held), Some(parcel), "it is held as before");
        stage.tell(who, Action::Throw { velocity: Vector3::x() * (0.99 * most) });
        stage.run(1);
        assert!((stage.velocity(parcel).x - 0.99 * most).abs() < 0.01, "{}", stage.velocity(parcel));
    }
    // 30 m are too far for 5 kg.
    let (mut stage, who, other, _) = pair(30.0, 5.0);
    stage.tell(who, Action::ThrowTo { to: other });
    stage.run(1);
    assert!(failure(&stage, ActionKind::ThrowTo).unwrap().contains("the arm gives"));
}

#[test]
fn what_cannot_be_done_is_refused_with_a_reason() {
    let (mut stage, who, other, parcel) = pair(0.7, 1.0);
    stage.tell(who, Action::ThrowTo { to: other });
    stage.tell(who, Action::Grasp { thing: other, both_hands: false });
    stage.tell(who, Action::LetGo);
    stage.run(1);
    assert!(failure(&stage, ActionKind::ThrowTo).unwrap().contains("too near"));
    assert!(failure(&stage, ActionKind::Grasp).unwrap().contains("no free thing"));
    assert!(failure(&stage, ActionKind::LetGo).unwrap().contains("hold of nothing"));
    assert!(stage.world.actuate(who, Action::ThrowTo { to: parcel }).is_err(), "thrown at itself");
    assert!(stage.world.actuate(who, Action::Throw { velocity: Vector3::x() * f64::NAN }).is_err());
    assert!(
        stage.world.actuate(who, Action::Grasp { thing: parcel, both_hands: false }).is_err(),
        "it is in the hand"
    );
    assert!(stage.world.actuate(other, Action::ThrowTo { to: who }).is_err(), "holds nothing");
}

/// Somebody with a ball, somebody else, and a cart, under a simulation that records.
fn recorded() -> (Simulation, [EntityId; 4]) {
    let mut world = World::new();
    let mut put = |desc: EntityDesc| world.spawn(desc).unwrap();
    let one = put(EntityDesc::new(EntityKind::Person, at(0.0, 0.0, 0.0), PERSON));
    let two = put(EntityDesc::new(EntityKind::Person, at(9.0, 0.5, 3.0), PERSON));
    let ball = EntityDesc::new(EntityKind::Parcel, at(0.5, 0.0, 0.0), Shape::Sphere { radius: 0.1 });
    let ball = put(ball.weighing(0.4));
    let cart = pose_facing(Point3::new(10.2, 4.0, 0.0), 0.0);
    let cart = put(EntityDesc::new(EntityKind::Prop, cart, Shape::cuboid(0.9, 0.55, 0.6)).weighing(50.0));
    let mut physics = PhysicsDynamics::new(PhysicsConfig::default()).unwrap();
    for id in [one, two] {
        physics.add_humanoid(&world, id, HumanoidConfig::default()).unwrap();
    }
    physics.add_cart(&world, cart, CartConfig::default()).unwrap();
    let mut simulation = Simulation::new(world);
    simulation.add_dynamics("physics", Box::new(physics));
    simulation.set_trail_interval(1);
    (simulation, [one, two, ball, cart])
}

/// What is told in which step.
fn script([one, two, ball, cart]: [EntityId; 4]) -> Vec<(u64, EntityId, Action)> {
    vec![
        (1, one, Action::PickUp { item: ball }),
        (3, one, Action::ThrowTo { to: two }),
        (20, two, Action::Rotate { angle: -1.43 }),
        (28, two, Action::MoveForward { speed: 1.2 }),
        (55, two, Action::Stop),
        (60, one, Action::MoveForward { speed: 1.0 }),
        (90, one, Action::Stop),
        (100, two, Action::Grasp { thing: cart, both_hands: true }),
        (101, two, Action::MoveForward { speed: 0.8 }),
        (130, two, Action::LetGo),
    ]
}

#[test]
fn a_recording_that_throws_and_grasps_is_replayed_bit_for_bit() {
    let (mut simulation, ids) = recorded();
    let script = script(ids);
    let [_, two, ball, cart] = ids;
    let (mut before, mut met) = (0.0, false);
    for step in 0..160 {
        for (_, who, action) in script.iter().filter(|(at, ..)| *at == step) {
            simulation.submit(Command::Actuate { who: *who, action: action.clone() });
        }
        if step == 100 {
            before = simulation.world().entity(cart).unwrap().position().y;
            // Beside the cart's handle, wherever the walk ended.
            let handle = simulation.world().entity(cart).unwrap().position() - Vector3::new(0.9, 0.0, 0.0);
            simulation.submit(Command::Move { id: two, pose: pose_facing(handle, 0.0) });
        }
        simulation.step().unwrap();
        met |= simulation.world().events().iter().any(
            |event| matches!(event.kind, EventKind::Contact { a, b, .. } if [a, b] == [two.min(ball), two.max(ball)]),
        );
    }
    assert!(met, "the ball meets whom it was thrown at");
    let pushed = simulation.world().entity(cart).unwrap().position();
    assert!(pushed.x > 11.5 && (pushed.y - before).abs() < 0.5, "the cart was pushed: {pushed}");
    let recording: Recording = simulation.recording().clone();
    let (mut replay, _) = recorded();
    for _ in 0..160 {
        let tick = replay.world().clock().tick();
        for command in recording.commands_at(tick) {
            replay.submit(command.clone());
        }
        replay.step().unwrap();
        recording.confirm(replay.world().clock().tick(), replay.digest()).unwrap();
    }
}

#[test]
fn a_state_with_something_in_the_air_is_taken_up_by_a_fresh_physics_and_rolled_back() {
    let run = |simulation: &mut Simulation, ids, steps: std::ops::Range<u64>| {
        for step in steps {
            for (_, who, action) in script(ids).iter().filter(|(at, ..)| *at == step) {
                simulation.submit(Command::Actuate { who: *who, action: action.clone() });
            }
            simulation.step().unwrap();
        }
        simulation.digest()
    };
    let (mut simulation, ids) = recorded();
    run(&mut simulation, ids, 0..2);
    let held = simulation.save().unwrap();
    run(&mut simulation, ids, 2..8);
    let flying = simulation.save().unwrap();
    let whole = run(&mut simulation, ids, 8..60);
    let (mut fresh, _) = recorded();
    fresh.restore(flying.clone()).unwrap();
    assert_eq!(run(&mut fresh, ids, 8..60), whole, "a fresh physics goes on");
    simulation.restore(held).unwrap();
    assert_eq!(run(&mut simulation, ids, 2..60), whole, "from before the throw");
    simulation.restore(flying).unwrap();
    assert_eq!(run(&mut simulation, ids, 8..60), whole, "from the air");
}
