//! Any command, sound or not, leaves a sound world: a refused one changes nothing, and an undo takes one back.

use crate::common::{any_change, any_command, bytes, contents, small_world};
use proptest::prelude::*;
use simworld_core::alteration::Alteration;
use simworld_core::asset::Asset;
use simworld_core::command::{Applied, Command};
use simworld_core::event::EventKind;
use simworld_core::geometry::{Point2, Point3, Pose, Ray, Twist, Vector3};
use simworld_core::hash::StateHash;
use simworld_core::id::EntityId;
use simworld_core::scene::{
    Attachment, EntityKind, RayCast, Role, Scene, Shape, Solidity, Visibility, World, WorldError,
};
use simworld_core::testing::check_scene;
use simworld_core::traffic::{REFUSED, TrafficOrder};

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn a_refused_command_changes_nothing(commands in prop::collection::vec(any_command(), 1..40)) {
        let mut world = small_world();
        for (index, command) in commands.iter().enumerate() {
            let before = bytes(&world);
            if let Err(error) = world.apply(command) {
                prop_assert!(before == bytes(&world), "refused with: {}", error);
                prop_assert!(!error.to_string().is_empty());
            }
            if index % 5 == 0 {
                world.finish_step();
                world.begin_step();
            }
        }
        check_scene(&world);
    }

    #[test]
    fn undone_commands_leave_no_trace(commands in prop::collection::vec(any_change(), 1..30)) {
        let mut world = small_world();
        let (before, environment) = (contents(&world), *world.environment());
        let mut undos = Vec::new();
        for command in &commands {
            if let Ok(applied) = world.apply(command) {
                undos.push(applied.undo.expect("a change can be taken back"));
            }
        }
        for undo in undos.iter().rev() {
            world.apply(undo).unwrap_or_else(|error| panic!("{undo:?} was refused: {error}"));
        }
        prop_assert_eq!(contents(&world), before);
        prop_assert_eq!(*world.environment(), environment);
        check_scene(&world);
    }

    #[test]
    fn an_undo_can_be_undone(commands in prop::collection::vec(any_change(), 1..20), last in any_change()) {
        let mut world = small_world();
        for command in &commands {
            let _ = world.apply(command);
        }
        if let Ok(applied) = world.apply(&last)
            // A spawned entity that is taken back and spawned again keeps its id.
            && let Some(undo) = applied.undo
        {
            let after = contents(&world);
            let redo = world.apply(&undo).expect("an undo goes through").undo.expect("so does its undo");
            world.apply(&redo).expect("a redo goes through");
            prop_assert_eq!(contents(&world), after);
        }
    }
}

#[test]
fn a_carrier_comes_back_with_its_load() {
    let mut world = small_world();
    let (person, parcel) = (EntityId::new(0, 0), EntityId::new(2, 0));
    let bond = Attachment { parent: person, role: Role::Held, parent_from_body: Pose::identity() };
    world.apply(&Command::Attach { child: parcel, bond: Some(bond) }).unwrap();
    let undo = world.apply(&Command::Remove { id: person }).unwrap().undo.unwrap();
    assert!(world.entity(parcel).unwrap().attachment.is_none(), "a load of nobody");
    world.apply(&undo).unwrap();
    assert_eq!(world.attached(person, Role::Held), Some(parcel));
}

#[test]
fn a_bond_that_leads_nowhere_is_refused() {
    let mut world = small_world();
    let before = world.snapshot();
    let (person, parcel) = (EntityId::new(0, 0), EntityId::new(2, 0));
    let mut nowhere = Pose::identity();
    nowhere.translation.vector = Vector3::new(f64::NAN, 0.0, 0.0);
    let bond = Attachment { parent: person, role: Role::Held, parent_from_body: nowhere };
    assert!(matches!(world.attach(parcel, Some(bond)), Err(WorldError::Pose { .. })));
    let mut twisted = Pose::identity();
    twisted.rotation.as_mut_unchecked().coords *= 1e200;
    assert!(matches!(world.set_motion(parcel, twisted, Twist::ZERO), Err(WorldError::Rotation { .. })));
    assert_eq!(world.snapshot(), before);
}

#[test]
fn the_digest_sees_every_change() {
    let base = {
        let mut world = small_world();
        world.finish_step();
        world.digest()
    };
    let id = EntityId::new(1, 0);
    let aside = Pose::translation(0.0, 1e-9, 0.0);
    let bond = Attachment { parent: EntityId::new(0, 0), role: Role::Part, parent_from_body: aside };
    let mut weather = simworld_core::environment::Environment::default();
    weather.weather.rain = 1.0;
    for change in [
        Command::Move { id, pose: aside },
        Command::Remove { id },
        Command::SetAttribute { id, key: "charge".to_owned(), value: Some(1_i64.into()) },
        Command::Attach { child: id, bond: Some(bond) },
        Command::SetEnvironment(weather),
        Command::Alter { id, alteration: Alteration::Shape(Shape::cuboid(0.5, 0.5, 1.0)) },
        Command::Alter { id, alteration: Alteration::Color(Some([0.5, 0.0, 0.0])) },
        Command::Alter { id, alteration: Alteration::Name(Some("throne".to_owned())) },
        Command::Alter { id, alteration: Alteration::Visibility(Visibility::Hidden) },
        Command::Alter { id, alteration: Alteration::Solidity(Solidity::Solid) },
        Command::Alter { id, alteration: Alteration::Solidity(Solidity::Hollow) },
    ] {
        let mut world = small_world();
        world.apply(&change).unwrap();
        world.finish_step();
        assert_ne!(world.digest(), base, "{change:?} went unnoticed");
    }
}

#[test]
fn a_digest_is_the_same_however_often_somebody_asks() {
    let id = EntityId::new(1, 0);
    let run = |asks: bool| {
        let mut world = small_world();
        for step in 0..20 {
            world.set_motion(id, Pose::translation(0.1 * f64::from(step), 2.0, 0.0), Twist::ZERO).unwrap();
            if asks {
                let _ = world.digest(); // in the middle of a step too
            }
            world.finish_step();
            if asks {
                let _ = world.digest();
            }
        }
        world
    };
    let (asked, silent) = (run(true), run(false));
    assert_eq!(asked.digest(), silent.clone().digest(), "a copy takes along what is out of date");
    assert_eq!(asked.digest(), silent.digest());
    assert_eq!(World::restore(silent.snapshot()).unwrap().digest(), silent.digest());
    let mut moved = silent.clone();
    moved.set_motion(id, Pose::translation(0.0, 3.0, 0.0), Twist::ZERO).unwrap();
    assert_ne!(moved.digest(), silent.digest(), "it covers the state as it is");
    let mark = silent.mark();
    let mut still = silent;
    let (pose, twist) = still.entity(id).map(|entity| (*entity.pose, *entity.twist)).unwrap();
    still.set_motion(id, pose, twist).unwrap();
    assert_eq!(still.touched_since(mark).unwrap().count(), 0, "who stays as it was has not changed");
}

/// Which thing a ray eastwards at a height meets, from the west of the small world.
fn met(world: &World, height: f64) -> Option<EntityKind> {
    let ray = Ray::towards(Point3::new(-5.0, 0.0, height), Point3::new(5.0, 0.0, height))?;
    let chair = |id| world.entity(id).is_some_and(|entity| entity.kind == EntityKind::Chair);
    world.cast_ray(&ray, 20.0, &chair).and_then(|hit| world.entity(hit.entity)).map(|entity| entity.kind)
}

#[test]
fn what_is_altered_is_found_and_met_as_it_is_now() {
    let mut world = small_world();
    let (id, revision) = (EntityId::new(1, 0), world.revision());
    let alter = |world: &mut World, alteration| world.apply(&Command::Alter { id, alteration });
    assert_eq!(met(&world, 2.0), None, "a chair is 0.9 m high");
    alter(&mut world, Alteration::Shape(Shape::cuboid(0.5, 3.0, 2.5))).unwrap();
    assert_eq!(met(&world, 2.0), Some(EntityKind::Chair));
    assert!(world.revision() > revision, "who keeps shapes looks anew");
    let chair = |entity: &simworld_core::scene::EntityRef<'_>| entity.kind == EntityKind::Chair;
    assert!(world.nearest(Point2::new(0.4, 2.0), 0.6, &chair).is_some(), "it is filed as broad as it is");
    alter(&mut world, Alteration::Solidity(Solidity::Hollow)).unwrap();
    assert_eq!(met(&world, 2.0), None, "one passes through it");
    for (old, new) in [("nobody", "throne"), ("throne", "stool")] {
        alter(&mut world, Alteration::Name(Some(format!("the {new}")))).unwrap();
        let names = world.names().unwrap();
        assert!(names.bearers(new).eq([id]) && names.count(old) == 0, "the index of names follows");
    }
    let before = bytes(&world);
    for (wrong, says) in [
        (Alteration::Shape(Shape::cuboid(0.5, -3.0, 2.5)), "width = -3"),
        (Alteration::Color(Some([0.0, 1.5, 0.0])), "1.5 is no share of a primary colour"),
        (Alteration::Color(Some([f32::NAN, 0.0, 0.0])), "NaN is no share"),
    ] {
        let error = alter(&mut world, wrong).unwrap_err().to_string();
        assert!(error.contains(says), "{error}");
    }
    assert_eq!(before, bytes(&world));
}

#[test]
fn an_asset_comes_by_command_and_once() {
    let mut world = small_world();
    let stool = Asset::new("stool", EntityKind::Chair, Shape::cuboid(0.4, 0.4, 0.5));
    let add = |asset: &Asset| Command::AddAsset(Box::new(asset.clone()));
    let digest = world.digest();
    for _ in 0..2 {
        assert_eq!(world.apply(&add(&stool)).unwrap(), Applied::default());
    }
    assert_eq!(world.digest(), digest, "nothing is made from it yet");
    let id = world.assets().unwrap().find("stool").unwrap();
    world.apply(&Command::Spawn(Box::new(stool.at(id, Pose::identity())))).unwrap();
    let other = Asset { mass: Some(4.0), ..stool };
    let error = world.apply(&add(&other)).unwrap_err().to_string();
    assert!(error.contains("another one"), "{error}");
}

#[test]
fn an_order_that_nobody_takes_is_refused() {
    let mut world = small_world();
    let who = EntityId::new(4, 0);
    world.apply(&Command::Traffic(TrafficOrder::TurnRound { who })).unwrap();
    world.finish_step();
    let [event] = world.events() else { panic!("one event: {:?}", world.events()) };
    let EventKind::Task { name, who: whom, data } = &event.kind else { panic!("{event:?}") };
    assert_eq!((name.as_str(), *whom), (REFUSED, Some(who)));
    assert_eq!(data["reason"].as_str(), Some("this world has no traffic"));
}
