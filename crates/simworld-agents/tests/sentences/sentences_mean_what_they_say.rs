//! What sentences and calls mean, as a table: words on the left, steps on the right.

use proptest::prelude::*;
use simworld_agents::language::GrammarPlanner;
use simworld_core::action::Action;
use simworld_core::geometry::{Point3, Pose, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::intent::Intent;
use simworld_core::scene::{Attachment, EntityDesc, EntityKind, Place, Role, Shape, World};
use simworld_core::seam::{Goal, Plan, PlanError, PlanStep, Planner};
use simworld_core::testing::check_planner;
use simworld_core::value::Value;

fn at(x: f64, y: f64) -> Pose {
    pose_facing(Point3::new(x, y, 0.0), 0.0)
}

/// #0 me, #1 and #2 chairs, #3 a bench by the museum, #4 a parcel, #5 Harbour Museum, #6 a hospital far from it and
/// #7 one near it, #8 Salt and Pepper Diner, #9 a scooter, #10 a car, #11 a tree, #12 and #13 two Elm Cafés, #14 a
/// person named courier 3.
fn town() -> (World, EntityId) {
    let mut world = World::new();
    let person = Shape::Capsule { radius: 0.25, height: 1.8 };
    let me = world.spawn(EntityDesc::new(EntityKind::Person, at(0.0, 0.0), person)).expect("a sound person");
    let chair = |x, y| EntityDesc::new(EntityKind::Chair, at(x, y), Shape::cuboid(0.5, 0.5, 0.9));
    let house = |x, y| EntityDesc::new(EntityKind::Building, at(x, y), Shape::cuboid(10.0, 10.0, 8.0));
    let things = [
        chair(20.0, 0.0),
        chair(8.0, 3.0),
        EntityDesc::new(EntityKind::Bench, at(60.0, 33.0), Shape::cuboid(0.6, 1.8, 0.8)),
        EntityDesc::new(EntityKind::Parcel, at(-6.0, 0.0), Shape::cuboid(0.3, 0.3, 0.3)),
        house(60.0, 40.0).used_as(Place::Museum).named("Harbour Museum"),
        house(-40.0, 0.0).used_as(Place::Hospital).named("St. Mary's Hospital"),
        house(60.0, 60.0).used_as(Place::Hospital).named("Northgate Clinic"),
        house(0.0, -80.0).used_as(Place::Restaurant).named("Salt and Pepper Diner"),
        EntityDesc::new(EntityKind::Scooter, at(4.0, -4.0), Shape::cuboid(1.1, 0.45, 1.1)),
        EntityDesc::new(EntityKind::Car, at(12.0, -9.0), Shape::cuboid(4.5, 1.8, 1.5)),
        EntityDesc::new(EntityKind::Tree, at(22.0, 1.0), Shape::Cylinder { radius: 0.3, height: 6.0 }),
        house(150.0, 0.0).used_as(Place::Restaurant).named("Elm Café"),
        house(-150.0, 90.0).used_as(Place::Restaurant).named("Elm Café"),
        EntityDesc::new(EntityKind::Person, at(30.0, 30.0), person).named("courier 3"),
    ];
    for thing in things {
        world.spawn(thing).expect("a sound thing");
    }
    (world, me)
}

fn show(plan: &Plan) -> String {
    let step = |step: &PlanStep| match step {
        PlanStep::Navigate { to: Goal::Entity(id), speed, .. } => match speed {
            Some(speed) => format!("run {id} at {speed}"),
            None => format!("go {id}"),
        },
        PlanStep::Navigate { to: Goal::Point(point), .. } => format!("go ({:.1}, {:.1})", point.x, point.y),
        PlanStep::Act(Action::SitDown { seat }) => format!("sit {seat}"),
        PlanStep::Act(Action::PickUp { item }) => format!("take {item}"),
        PlanStep::Act(Action::CarryHeavy { item }) => format!("carry {item}"),
        PlanStep::Act(Action::RideScooter { scooter }) => format!("ride {scooter}"),
        PlanStep::Act(Action::EnterCar { car }) => format!("enter {car}"),
        PlanStep::Act(Action::WaveHand { to }) => format!("wave {to}"),
        PlanStep::Act(Action::Rotate { angle }) => format!("turn {:.0}", angle.to_degrees()),
        PlanStep::Act(Action::Step { direction, distance }) => format!("step {direction:?} {distance}"),
        PlanStep::Act(Action::ThrowTo { to }) => format!("throw to {to}"),
        PlanStep::Face { to: Goal::Entity(id) } => format!("face {id}"),
        PlanStep::Act(action) => action.kind().to_string(),
        PlanStep::Wait { seconds } => format!("wait {seconds}"),
        other => format!("{other:?}"),
    };
    plan.steps.iter().map(step).collect::<Vec<_>>().join(", ")
}

fn plan(words: &str) -> Result<Plan, PlanError> {
    let (world, me) = town();
    GrammarPlanner::default().plan(&Intent::Words(words.to_owned()), &world, me)
}

fn check(table: &[(&str, &str)]) {
    for (words, steps) in table {
        match plan(words) {
            Ok(plan) => assert_eq!(show(&plan), *steps, "{words}"),
            Err(error) => panic!("{words}: {error}"),
        }
    }
}

#[test]
fn verbs_have_their_steps() {
    check(&[
        ("go to the nearest chair and sit down", "go #2, sit #2"),
        ("Sit.", "go #2, sit #2"),
        ("sit on the nearest chair", "go #2, sit #2"),
        ("take a seat by the museum", "go #3, sit #3"),
        ("sit down, then stand up", "go #2, sit #2, stand up"),
        ("crouch", "crouch"),
        ("please duck down", "crouch"),
        ("squat down and wait three seconds, then stand up", "crouch, wait 3, stand up"),
        ("go to the museum, crouch and take a photo", "go #5, crouch, take photo"),
        ("pick up the parcel", "go #4, take #4"),
        ("pick the package up and bring it to the museum", "go #4, take #4, go #5, drop off"),
        ("deliver the parcel to the museum", "go #4, take #4, go #5, drop off"),
        ("take the box to Harbour Museum; wait 5 s", "go #4, take #4, go #5, drop off, wait 5"),
        ("carry the chair next to the tree to (3, 4)", "go #1, carry #1, go (3.0, 4.0), put down heavy"),
        ("run to #1", "run #1 at 2.5"),
        ("stop", "stop"),
        ("wait for two minutes", "wait 120"),
        ("stay here for 3 seconds", "wait 3"),
        ("wait a second", "wait 1"),
        ("ride the scooter to the museum", "go #9, ride #9, go #5"),
        ("get in the car, then get out", "go #10, enter #10, exit car"),
        ("enter the museum", "go #5"),
        ("turn left and take two steps", "turn 90, step Forward 2"),
        ("step back 1.5 m", "step Backward 1.5"),
        ("turn around", "turn 180"),
        ("wave at courier 3", "wave #14"),
        ("take a photo", "take photo"),
    ]);
}

#[test]
fn things_are_thrown_at_people() {
    let thrown = "go #4, take #4, go #14, face #14, throw to #14";
    check(&[
        ("throw the parcel to courier 3", thrown),
        ("pick up the parcel and throw it to courier 3", thrown),
        ("toss the parcel over to courier 3", thrown),
        ("throw courier 3 the parcel", thrown),
        (
            "take the parcel, then chuck it at courier 3 and wait 2 s",
            "go #4, take #4, go #14, face #14, throw to #14, wait 2",
        ),
    ]);
    let error = plan("throw it to courier 3").unwrap_err().to_string();
    assert!(error.contains("\"it\" could stand for"), "{error}");
}

#[test]
fn things_are_found_by_kind_name_place_id_and_point() {
    check(&[
        ("go to the farthest chair", "go #1"),
        ("walk to Harbour Museum", "go #5"),
        ("go to HARBOUR MUSEUM!", "go #5"),
        ("go to the harbor museum", "go #5"),
        ("go to Harbuor Musuem", "go #5"),
        ("go to Northgate", "go #7"),
        ("go to St. Mary's Hospital and wait 1 second", "go #6, wait 1"),
        ("go to salt and pepper diner and sit", "go #8, go #1, sit #1"),
        ("go to the hospital", "go #6"),
        ("go to the hospital near the museum", "go #7"),
        ("go to the nearest hospital near a museum", "go #7"),
        ("go to the chair next to the tree", "go #1"),
        ("go to Elm Café", "go #12"),
        ("navigate to (10, -3)", "go (10.0, -3.0)"),
        ("go to #3", "go #3"),
        ("go behind the car", "go (9.2, -9.0)"),
    ]);
}

#[test]
fn later_orders_start_where_earlier_ones_end() {
    check(&[
        ("go to the museum and sit down", "go #5, go #3, sit #3"),
        ("go to the car, then go to the chair, then go there", "go #10, go #1, go #1"),
        ("sit down and then go to the museum", "go #2, sit #2, stand up, go #5"),
        ("go to the chair and sit on it", "go #2, sit #2"),
    ]);
}

#[test]
fn politeness_is_no_order() {
    check(&[
        ("Could you please go to the nearest bench, thank you", "go #3"),
        ("hey, I want you to stop now please", "stop"),
        ("First go to the bench. Then, finally, wait 2 seconds!", "go #3, wait 2"),
    ]);
}

#[test]
fn what_is_not_understood_is_said() {
    for (words, parts) in [
        ("", &["go to"][..]),
        ("juggle", &["juggle", "pick up"]),
        ("go to the chair and juggle", &["\"juggle\"", "pick up"]),
        ("go to the chair tomorrow", &["tomorrow"]),
        ("go to", &["say what"]),
        ("wait", &["how long"]),
        ("wait 0 seconds", &["more than 0"]),
        ("wait 1e9 years", &["end here"]),
        ("go to the zoo", &["no zoo", "chair #2 at 8 m"]),
        ("go to the beach", &["no beach", "bench"]),
        ("go to the mailbox", &["no mailbox", "near are"]),
        ("go to #99", &["no #99"]),
        ("sit on the tree", &["no seat"]),
        ("sit on it", &["it", "name it first"]),
        ("go there", &["there", "name it first"]),
        ("drop off the parcel", &["parcel in hand", "hands are empty"]),
        ("pick up the museum", &["cannot be taken"]),
        ("go to (1, nan)", &["(x, y)"]),
        ("go to (1e99, 2)", &["(x, y)"]),
        ("go to (1, 99999999999999)", &["(x, y)"]),
        (
            "go to the chair by the chair by the chair by the chair by the chair by the chair",
            &["at most four"],
        ),
    ] {
        let error = plan(words).map(|plan| show(&plan)).expect_err(words).to_string();
        for part in parts {
            assert!(error.contains(part), "{words:?} gave {error:?} without {part:?}");
        }
    }
}

#[test]
fn taken_seats_and_parcels_are_left_alone() {
    let (mut world, me) = town();
    let neighbour = EntityId::new(14, 0);
    let bond = |parent, role| Some(Attachment { parent, role, parent_from_body: Pose::identity() });
    world.attach(neighbour, bond(EntityId::new(2, 0), Role::Seated)).unwrap();
    world.attach(EntityId::new(4, 0), bond(neighbour, Role::Held)).unwrap();
    let plan = |words: &str| GrammarPlanner::default().plan(&Intent::Words(words.to_owned()), &world, me);
    assert_eq!(show(&plan("sit down").unwrap()), "go #1, sit #1");
    let error = plan("pick up the parcel").unwrap_err().to_string();
    assert!(error.contains("free") && error.contains("in use"), "{error}");
}

#[test]
fn what_is_in_hand_is_put_down() {
    let (mut world, me) = town();
    let bond = |role| Some(Attachment { parent: me, role, parent_from_body: Pose::identity() });
    world.attach(EntityId::new(4, 0), bond(Role::Held)).unwrap();
    world.attach(EntityId::new(1, 0), bond(Role::Carried)).unwrap();
    let plan = |words: &str| {
        show(&GrammarPlanner::default().plan(&Intent::Words(words.to_owned()), &world, me).unwrap())
    };
    assert_eq!(plan("put it down").as_str(), "put down heavy");
    assert_eq!(plan("drop off the parcel at the museum"), "go #5, drop off");
    assert_eq!(plan("put down the chair and drop the parcel"), "put down heavy, drop off");
}

#[test]
fn calls_mean_the_same_as_words() {
    let (world, me) = town();
    let chair = EntityId::new(1, 0);
    let call = |call: Intent| GrammarPlanner::default().plan(&call, &world, me).map(|plan| show(&plan));
    let table = [
        (Intent::call("navigate").arg("to", chair), "go #1"),
        (Intent::call("navigate").arg("to", "the nearest chair"), "go #2"),
        (Intent::call("navigate").arg("x", 1.5).arg("y", -2_i64), "go (1.5, -2.0)"),
        (Intent::call("navigate").arg("to", chair).arg("speed", 1.0), "run #1 at 1"),
        (Intent::call("agent_sit_down"), "go #2, sit #2"),
        (Intent::call("sit_down").arg("seat", chair), "go #1, sit #1"),
        (Intent::call("pick_up").arg("item", "parcel"), "go #4, take #4"),
        (
            Intent::call("throw").arg("to", "courier 3").arg("item", "parcel"),
            "go #4, take #4, go #14, face #14, throw to #14",
        ),
        (Intent::call("wait").arg("seconds", 2.5), "wait 2.5"),
        (Intent::call("stand_up"), "stand up"),
        (Intent::call("crouch"), "crouch"),
        (Intent::call("turn").arg("angle", 1.0), "turn 57"),
    ];
    for (intent, steps) in table {
        assert_eq!(call(intent.clone()), Ok(steps.to_owned()), "{intent}");
    }
    for (intent, part) in [
        (Intent::call("fly"), "use navigate"),
        (Intent::call("navigate"), "give either to, or x and y"),
        (Intent::call("navigate").arg("x", f64::NAN).arg("y", 1.0), "x = NaN"),
        (Intent::call("navigate").arg("to", true), "must be an entity"),
        (Intent::call("navigate").arg("to", "chair and bench"), "more than one"),
        (Intent::call("stop").arg("now", true), "no argument \"now\""),
        (Intent::call("wait"), "seconds is missing"),
        (Intent::call("wait").arg("seconds", "five"), "give a number"),
        (Intent::call("pick_up").arg("item", EntityId::new(77, 0)), "no #77"),
        (Intent::call("drop_off"), "hands are empty"),
    ] {
        let error = call(intent.clone()).unwrap_err().to_string();
        assert!(error.contains(part), "{intent} gave {error:?}");
    }
}

#[test]
fn the_planner_seam_is_kept() {
    let (world, me) = town();
    let mut understood =
        vec![Intent::Words("go to the nearest chair and sit down".to_owned()), Intent::call("stop")];
    understood.push(Intent::call("navigate").arg("to", Value::Entity(EntityId::new(3, 0))));
    check_planner(|| Box::new(GrammarPlanner::default()), &world, me, &understood);
}

/// A plan that comes out is one an executor can take: finite numbers and living entities.
fn is_sound(plan: &Plan) -> bool {
    let sound = |step: &PlanStep| match step {
        PlanStep::Navigate { to: Goal::Point(point), within, .. } => {
            point.iter().all(|number| number.is_finite()) && *within > 0.0
        }
        PlanStep::Wait { seconds } => seconds.is_finite() && *seconds > 0.0,
        _ => true,
    };
    !plan.steps.is_empty() && plan.steps.iter().all(sound)
}

const SENTENCES: &[&str] = &[
    "go to the hospital near the museum and then sit down on the nearest free bench",
    "Please pick up the parcel, bring it to (10, -3.5) and wait for 5 seconds.",
    "ride the scooter to St. Mary's Hospital; get off, turn left 45 degrees and step back 2 m",
    "run to #12.1 and drop off the package next to the tree to the left of the car",
];

proptest! {
    #[test]
    fn any_text_gives_a_sound_plan_or_an_answer(words in "\\PC{0,120}") {
        match plan(&words) {
            Ok(plan) => prop_assert!(is_sound(&plan), "{words:?} gave {plan:?}"),
            Err(error) => prop_assert!(!error.to_string().is_empty()),
        }
    }

    #[test]
    fn any_heap_of_known_words_gives_a_sound_plan_or_an_answer(
        words in prop::collection::vec(
            prop::sample::select(
                "go to the nearest chair and then sit down on it pick up parcel drop off at (10 , -3 ) near next by \
                 left of museum wait 5 seconds #4 there please put ride scooter get off turn back step . ;"
                    .split(' ').collect::<Vec<_>>()),
            0..30),
    ) {
        let words = words.join(" ");
        match plan(&words) {
            Ok(plan) => prop_assert!(is_sound(&plan), "{words:?} gave {plan:?}"),
            Err(error) => prop_assert!(!error.to_string().is_empty()),
        }
    }

    #[test]
    fn a_mangled_sentence_gives_a_sound_plan_or_an_answer(
        sentence in prop::sample::select(SENTENCES.to_vec()),
        cut in 0_usize..90,
        drop in 0_usize..6,
        insert in "\\PC{0,6}",
    ) {
        let letters: Vec<char> = sentence.chars().collect();
        let cut = cut.min(letters.len());
        let head: String = letters[..cut].iter().collect();
        let tail: String = letters[(cut + drop).min(letters.len())..].iter().collect();
        if let Ok(plan) = plan(&format!("{head}{insert}{tail}")) {
            prop_assert!(is_sound(&plan), "{plan:?}");
        }
    }
}
