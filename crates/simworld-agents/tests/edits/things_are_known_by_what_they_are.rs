//! What was put somewhere by a name is known by that name from then on; and what is said along changes nothing of a request.

use simworld_agents::editing::{Edit, SceneEditor};
use simworld_core::geometry::Point2;
use simworld_core::scene::{Scene, World};
use simworld_core::seed::Seed;

use crate::city::City;

/// An editor on the campus, and its scene.
fn campus() -> (SceneEditor, World) {
    let city = City::read("campus");
    (SceneEditor::new(Seed(7)).looking_as(city.me, &city.world), city.world)
}

/// What is made of an asset.
fn made_of(world: &World, asset: &str) -> Vec<simworld_core::id::EntityId> {
    let id = world.assets().and_then(|assets| assets.find(asset)).unwrap();
    world.iter().filter(|entity| entity.info.asset == Some(id)).map(|entity| entity.id).collect()
}

#[test]
fn what_was_added_is_spoken_of_later() {
    let (mut editor, mut world) = campus();
    editor.say("put a police car near the clinic and two food trucks near the library", &mut world).unwrap();
    let (car, trucks) = (made_of(&world, "police_car"), made_of(&world, "food_truck"));
    let done = editor.say("paint the police car green", &mut world).unwrap();
    assert!(matches!(&done.edits[..], [Edit::Paint { things, .. }] if *things == car), "{:?}", done.edits);
    let counted = editor.say("how many food trucks are there?", &mut world).unwrap();
    let [Edit::Count { things, .. }] = &counted.edits[..] else { panic!("{:?}", counted.edits) };
    assert!(things.len() == 2 && trucks.iter().all(|truck| things.contains(truck)), "{things:?}");
    // Cars that are none of the police stay what they are.
    editor.say("remove the police car", &mut world).unwrap();
    assert!(made_of(&world, "police_car").is_empty());
    let error = editor.say("remove the police car", &mut world).unwrap_err();
    assert!(error.to_string().contains("police car"), "{error}");
}

#[test]
fn what_a_sentence_makes_it_may_speak_of() {
    let (mut editor, mut world) = campus();
    editor.say("put a sundial next to the clinic and paint the sundial blue", &mut world).unwrap();
    let [sundial] = made_of(&world, "sundial")[..] else { panic!("one was asked for") };
    let [red, _, blue] = world.entity(sundial).unwrap().info.color.unwrap();
    assert!(blue > red);
}

#[test]
fn what_is_said_along_changes_nothing() {
    let said = |words: &str| {
        let (mut editor, mut world) = campus();
        let before = world.len();
        editor.say(words, &mut world).map(|done| (format!("{:?}", done.edits), world.len() - before))
    };
    let plain = said("add a cone next to the statue").unwrap();
    for along in [
        "add a cone next to the statue. Safety first!",
        "add a cone next to the statue, the inspector insists",
        "add a cone next to the statue, that would look nice",
        "add a cone next to the statue. Any cone will do.",
        "add a cone next to the statue, spring is coming",
        "Me, add a cone next to the statue, no rush",
    ] {
        assert_eq!(said(along).as_ref(), Ok(&plain), "{along}");
    }
    // What may change it is no remark.
    for more in
        ["add a cone next to the statue, not too close", "add a cone next to the statue, upside down again"]
    {
        assert!(said(more).is_err(), "{more}");
    }
}

#[test]
fn places_may_be_told_in_figures_and_the_whole_scene_by_its_name() {
    let (mut editor, mut world) = campus();
    editor.say("drop a cone at x = -5, y = -15", &mut world).unwrap();
    let [cone] = made_of(&world, "cone")[..] else { panic!("one was asked for") };
    let away = (world.entity(cone).unwrap().planar() - Point2::new(-5.0, -15.0)).norm();
    assert!(away < 0.1, "{away} m off");
    let nothing =
        editor.say("add a bench here unless there is already a truck anywhere on campus", &mut world);
    assert!(matches!(&nothing.unwrap().edits[..], [Edit::Leave { .. }]));
    let counted = editor.say("how many cars does the campus have?", &mut world).unwrap();
    assert!(matches!(&counted.edits[..], [Edit::Count { things, .. }] if things.len() == 3));
}
