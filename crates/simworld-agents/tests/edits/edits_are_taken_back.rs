//! Edits of a scene are all or nothing, can be taken back and done again, and replay.

use std::collections::BTreeMap;

use simworld_agents::editing::{
    Candidate, Difference, Edit, EditError, Editable, Fault, Line, Make, Outcome, SceneEditor, Sides,
    Spacing, Stand, faults,
};
use simworld_core::environment::Sun;
use simworld_core::geometry::{Point2, Point3, planar, pose_facing};
use simworld_core::hash::{StateDigest, StateHash};
use simworld_core::id::{EntityId, RoadId};
use simworld_core::passage::Passage;
use simworld_core::scene::{EntityDesc, EntityKind, Relation, Scene, Shape, World};
use simworld_core::seed::{Seed, StreamRng};
use simworld_core::simulation::Simulation;

use crate::city::City;
use crate::edits_common::{CITIES, newest_in};

/// The digest of a world after a step in which nothing happens.
fn digest(world: &World) -> StateDigest {
    let mut world = world.clone();
    world.begin_step();
    world.finish_step();
    world.digest()
}

/// A square of houses with furniture between them.
fn town() -> World {
    let mut world = World::new();
    for index in 0..36 {
        let at = Point3::new(f64::from(index % 6) * 30.0, f64::from(index / 6) * 30.0, 0.0);
        let house =
            EntityDesc::new(EntityKind::Building, pose_facing(at, 0.0), Shape::cuboid(10.0, 8.0, 6.0));
        world.spawn(house.named(format!("House {index}"))).expect("a house");
        let bench = pose_facing(at + simworld_core::geometry::Vector3::new(12.0, 3.0, 0.0), 0.3);
        world
            .spawn(EntityDesc::new(EntityKind::Bench, bench, Shape::cuboid(0.6, 1.8, 0.85)))
            .expect("a bench");
    }
    world
}

const ASSETS: [&str; 8] = ["bench", "tree", "sports_car", "cone", "table", "bus_stop", "person", "bicycle"];
/// Every relation that things are put into by words.
const RELATIONS: [&str; 13] = [
    "NextTo",
    "Near",
    "FarFrom",
    "InFrontOf",
    "Behind",
    "LeftOf",
    "RightOf",
    "OnTopOf",
    "Inside",
    "Between",
    "AcrossFrom",
    "Along",
    "AtCornerOf",
];
/// Every edit that changes something.
const KINDS: [&str; 13] = [
    "Add",
    "Row",
    "Remove",
    "Move",
    "Rotate",
    "Face",
    "Swap",
    "Paint",
    "Scale",
    "Copy",
    "Name",
    "SetEnvironment",
    "SetPassage",
];

/// The name of a variant, as it is printed.
fn variant(value: &impl std::fmt::Debug) -> String {
    let printed = format!("{value:?}");
    printed.split([' ', '(', '{']).next().unwrap_or_default().to_owned()
}

fn relation_of(stand: &Stand) -> String {
    match stand {
        Stand::To { relation, .. } => variant(relation),
        other => variant(other),
    }
}

/// A relation drawn from all that there are.
fn random_stand(world: &World, ids: &[EntityId], rng: &mut StreamRng) -> Stand {
    let anchor = *rng.choose(ids).expect("somebody is there");
    let other = *rng.choose(ids).expect("somebody is there");
    match rng.below(RELATIONS.len()) {
        9 => Stand::Between { one: anchor, other },
        10 => Stand::AcrossFrom { anchor },
        11 => Stand::Along { anchor },
        12 => Stand::AtCornerOf { anchor },
        index => {
            let relation = Relation::ALL[index];
            // Little has room within: the square, the park and the river.
            let grounds = world.iter().filter(|entity| entity.kind == EntityKind::Ground);
            let grounds: Vec<EntityId> = grounds.map(|entity| entity.id).collect();
            let ground = rng.choose(&grounds).filter(|_| relation == Relation::Inside);
            Stand::To { relation, anchor: ground.copied().unwrap_or(anchor) }
        }
    }
}

fn random_line(ids: &[EntityId], roads: &[RoadId], rng: &mut StreamRng) -> Line {
    let anchor = *rng.choose(ids).expect("somebody is there");
    let other = *rng.choose(ids).expect("somebody is there");
    match rng.below(5) {
        0 => Line::Road { roads: roads.to_vec(), sides: Sides::Either },
        1 => Line::Road { roads: roads.to_vec(), sides: Sides::Both },
        2 => Line::Along { anchor },
        3 => Line::Between { one: anchor, other },
        _ => Line::Around { anchor },
    }
}

/// An edit drawn from everything that can be asked.
fn random_edit(world: &World, rng: &mut StreamRng) -> Edit {
    let ids: Vec<EntityId> = world.iter().map(|entity| entity.id).collect();
    let thing = *rng.choose(&ids).expect("somebody is there");
    let other = *rng.choose(&ids).expect("somebody is there");
    let stands = vec![random_stand(world, &ids, rng)];
    let make = Make::of(*rng.choose(&ASSETS).expect("there are some"));
    let streets = world.roads().map_or(0, |network| network.roads.len());
    let roads = vec![RoadId::from_index(rng.below(streets))];
    match rng.below(20) {
        0..=3 => Edit::Add { make, count: 1 + rng.below(3) as u32, stands },
        4 | 5 => Edit::Move { things: vec![thing], stands },
        6 | 7 => Edit::Copy { thing, count: 1 + rng.below(2) as u32, stands },
        8 => {
            let spacing = if rng.chance(0.5) {
                Spacing::Count(2 + rng.below(4) as u32)
            } else {
                Spacing::Every(rng.uniform(8.0, 25.0))
            };
            Edit::Row { make, line: random_line(&ids, &roads, rng), spacing }
        }
        9 | 10 => Edit::Remove { things: vec![thing] },
        11 => Edit::Rotate { things: vec![thing], angle: rng.uniform(-3.0, 3.0) },
        12 => Edit::Face { things: vec![thing], towards: other },
        13 => Edit::Swap { one: thing, other },
        14 => Edit::Paint { things: vec![thing], color: [0.1, 0.2, 0.3] },
        15 => Edit::Scale { things: vec![thing], factor: rng.uniform(0.6, 1.6) },
        16 => Edit::Name { thing, name: format!("Thing {}", rng.below(100)) },
        17 => {
            let mut environment = *world.environment();
            environment.sun = Sun::at_hour(rng.uniform(0.0, 24.0));
            environment.weather.rain = rng.uniform(0.0, 30.0);
            Edit::SetEnvironment(environment)
        }
        18 => {
            let passage = if rng.chance(0.5) { Passage::Closed } else { Passage::Open };
            Edit::SetPassage { roads, passage }
        }
        _ => random_question(thing, rng),
    }
}

fn random_question(thing: EntityId, rng: &mut StreamRng) -> Edit {
    match rng.below(4) {
        0 => Edit::Count { what: "thing".to_owned(), things: vec![thing] },
        1 => Edit::List { things: vec![thing] },
        2 => Edit::Describe { thing },
        _ => Edit::Leave { why: "nobody asked for anything".to_owned() },
    }
}

/// In what relations an edit is to put things.
fn stands_in(edit: &Edit) -> &[Stand] {
    match edit {
        Edit::Add { stands, .. } | Edit::Move { stands, .. } | Edit::Copy { stands, .. } => stands,
        _ => &[],
    }
}

/// Everything that hangs in the air or is sunk into what it stands on.
fn unsupported(world: &World) -> Vec<EntityId> {
    let hangs = |thing: &EntityId| {
        faults(world, *thing).iter().any(|fault| matches!(fault, Fault::Unsupported { .. }))
    };
    world.iter().map(|entity| entity.id).filter(hangs).collect()
}

#[test]
fn a_thousand_edits_of_every_kind_are_taken_back_to_the_bit() {
    let mut world = City::read("quarter").world;
    let start = digest(&world);
    let mut editor = SceneEditor::new(Seed(3));
    let mut rng = Seed(5).stream("tests/edits").rng();
    let mut done: BTreeMap<String, usize> = BTreeMap::new();
    let mut held: BTreeMap<String, usize> = BTreeMap::new();
    for rank in 0..1000 {
        let before = digest(&world);
        let edit = random_edit(&world, &mut rng);
        match editor.edit(std::slice::from_ref(&edit), &mut world) {
            Ok(edited) => {
                *done.entry(variant(&edit)).or_default() += 1;
                for stand in stands_in(&edit) {
                    *held.entry(relation_of(stand)).or_default() += 1;
                }
                for thing in edited.made {
                    assert_eq!(faults(&world, thing), [], "{edit:?}");
                }
            }
            Err(_) => assert_eq!(digest(&world), before, "what failed changed nothing: {edit:?}"),
        }
        if rank % 100 == 99 {
            assert_eq!(unsupported(&world), [], "after {rank} edits, the last of which was {edit:?}");
        }
    }
    let all: usize = done.values().sum();
    assert!(all > 500, "only {all} of 1000 edits were possible: {done:?}");
    assert!(KINDS.iter().all(|kind| done.contains_key(*kind)), "{done:?}");
    assert!(RELATIONS.iter().all(|relation| held.contains_key(*relation)), "{held:?}");
    let end = digest(&world);
    while editor.undo(&mut world).expect("nothing else changed the world").is_some() {}
    assert_eq!(digest(&world), start);
    while editor.redo(&mut world).expect("nothing else changed the world").is_some() {}
    assert_eq!(digest(&world), end);
}

/// What nobody can foresee in a run, such as the order of a map that is seeded anew, would differ from one telling to the next.
#[test]
fn every_tenth_sentence_of_the_newest_set_does_the_same_when_it_is_said_again() {
    let mut told = 0;
    for name in CITIES {
        let city = City::read(name);
        for asked in newest_in(name).iter().step_by(10) {
            let say = || {
                let mut world = city.world.clone();
                let mut editor = SceneEditor::new(Seed(7)).looking_as(city.me, &world);
                let outcome = editor.say(&asked.words, &mut world);
                (outcome, digest(&world))
            };
            assert_eq!(say(), say(), "{name}: {:?}", asked.words);
            told += 1;
        }
    }
    assert!(told >= 16, "only {told} sentences");
}

#[test]
fn a_sentence_that_fails_in_the_middle_changes_nothing() {
    let mut world = town();
    let before = world.clone();
    let mut editor = SceneEditor::new(Seed(3));
    let refused = editor.say("add a tree next to House 3 and a bench next to the swimming pool", &mut world);
    assert!(matches!(refused, Err(EditError::NotFound { .. })), "{refused:?}");
    assert!(Difference::between(&before, &world).is_empty());
    assert_eq!(editor.undo(&mut world), Ok(None), "there is nothing to take back");
}

#[test]
fn the_same_words_and_seed_give_the_same_scene() {
    let say = |seed| {
        let mut world = town();
        let mut editor = SceneEditor::new(Seed(seed));
        for words in [
            "add three trees near House 7",
            "put a red sports car behind House 20",
            "make the car next to House 20 blue",
        ] {
            // The last may be refused where the car stands far behind; that too is the same each time.
            let _ = editor.say(words, &mut world);
        }
        digest(&world)
    };
    assert_eq!(say(1), say(1));
    assert_ne!(say(1), say(2));
}

#[test]
fn edits_of_a_running_world_replay() {
    let mut run = Simulation::new(town());
    run.set_trail_interval(1);
    let mut editor = SceneEditor::new(Seed(9)).looking_from(Point2::new(60.0, 60.0));
    for words in ["add two cones near House 14", "remove House 15", "move a bench behind House 16"] {
        run.begin_step();
        editor.say(words, &mut run).expect(words);
        run.finish_step().expect("nothing moves");
    }
    run.begin_step();
    editor.undo(&mut run).expect("nothing else changed the world");
    run.finish_step().expect("nothing moves");

    let mut again = Simulation::new(town());
    again.set_trail_interval(1);
    for tick in 0..4 {
        let now = run.recording().commands.iter().filter(|stamped| stamped.tick.0 == tick);
        now.for_each(|stamped| again.submit(stamped.command.clone()));
        again.step().expect("nothing moves");
    }
    assert_eq!(again.recording().trail, run.recording().trail);
    assert_eq!(digest(again.world()), digest(Editable::world(&run)));
}

#[test]
fn it_says_why_a_thing_has_no_room_and_where_it_would_have() {
    let mut world = town();
    let mut editor = SceneEditor::new(Seed(3));
    let refused = editor.say("put a bus at (0, 0)", &mut world).expect_err("a house is there");
    let EditError::NoRoom { why, relaxed, .. } = &refused else { panic!("{refused}") };
    assert!(why.contains("House 0"), "{why}");
    assert!(relaxed.contains("there is room around (0.0, 0.0)"), "{relaxed}");
    assert_eq!(editor.last_placings().len(), 1, "what was tried can be looked at");
    assert!(world.iter().all(|entity| entity.kind != EntityKind::Bus));
}

#[test]
fn it_says_where_else_a_thing_would_stand_and_the_best_of_it_first() {
    let mut world = town();
    let start = world.clone();
    let mut editor = SceneEditor::new(Seed(3));
    let made = editor.say("put a bench behind House 14", &mut world).expect("there is room").made[0];
    let mut desc = world.entity(made).expect("it was made").to_desc();
    desc.info.asset = None;
    let placing = editor.last_placings().last().expect("it was put somewhere").clone();
    assert_eq!(placing.pose(), Some(desc.pose), "it stands where it was put");
    let score = |candidate: &Candidate| match candidate.outcome {
        Outcome::Fits { score, .. } => score,
        ref other => panic!("nothing stands there: {other:?}"),
    };
    let taken = placing.taken.map(|index| score(&placing.candidates[index])).expect("it was put somewhere");
    let others = placing.alternatives();
    assert!(others.len() > 3, "only {} other places", others.len());
    assert!(others.windows(2).all(|pair| score(pair[0]) >= score(pair[1])), "the best comes first");
    for other in others {
        assert!(score(other) <= taken && other.pose != desc.pose);
        // House 14 stands at (60, 60) and looks east: behind it is the quarter to the west, up to 30 m from its wall.
        let way = planar(&other.pose) - Point2::new(60.0, 60.0);
        assert!(way.x < 0.0 && way.y.abs() <= way.x.abs() && way.norm() <= 37.0, "{way}");
        let mut there = start.clone();
        let thing = there.spawn(EntityDesc { pose: other.pose, ..desc.clone() }).expect("it is a bench");
        assert_eq!(faults(&there, thing), []);
    }
}
