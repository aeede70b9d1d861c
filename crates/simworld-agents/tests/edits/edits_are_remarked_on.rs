//! Times with full stops, remarks that read like edits, people who should be busy somewhere, and things that are named before the order about them:
//! each comes to the edits of its plain order.

use crate::city::City;
use crate::edits_are_chatted::{edits_of, mean};
use simworld_agents::editing::SceneEditor;
use simworld_core::seed::Seed;

#[test]
fn times_with_full_stops_are_times() {
    mean(
        "harbour",
        "set the clock to 23:00",
        &["Set the clock to 11 p.m.", "set the clock to 11 p.m", "Set the clock to 11 P.M., please."],
    );
    mean(
        "harbour",
        "set the clock to 6:00",
        &["Set the clock to 6 a.m. sharp.", "set the clock to 6 am sharp"],
    );
    mean(
        "harbour",
        "set the clock to 23:00 and remove the crate",
        &["Set the clock to 11 p.m. Remove the crate."],
    );
}

#[test]
fn what_is_told_of_a_place_adds_nothing() {
    mean(
        "harbour",
        "plant a pine south of the Corner Shop",
        &[
            "Plant a pine south of the Corner Shop, it looks so bare down there.",
            "Plant a pine south of the Corner Shop, it is so empty there.",
            "Plant a pine south of the Corner Shop. That corner looks rather dull over there.",
        ],
    );
}

#[test]
fn remarks_behind_and_before_an_edit_ask_for_nothing() {
    for (city, plain, said) in [
        (
            "harbour",
            "paint the street lamp black",
            &["Paint the street lamp black; it suits the quay better."][..],
        ),
        (
            "campus",
            "turn the statue 60 degrees clockwise",
            &["Turn the statue 60 degrees clockwise, that should catch the light."],
        ),
        (
            "campus",
            "put a bicycle rack behind the Turing Library",
            &["I'd like a bicycle rack behind the Turing Library, since half of my class cycles in."],
        ),
        (
            "oldtown",
            "put a laptop on the table",
            &["Leave an open laptop on the table, as if somebody had just gone to fetch lunch."],
        ),
        (
            "oldtown",
            "put a surveillance camera at a corner of the Registry",
            &["After that burglary, put a surveillance camera at a corner of the Registry."],
        ),
    ] {
        mean(city, plain, said);
    }
    // What it should be like is no remark.
    let city = City::read("campus");
    let turned = edits_of(&city, "turn the statue 60 degrees clockwise").unwrap();
    let words = "Turn the statue 60 degrees clockwise, that should be red.";
    assert_ne!(edits_of(&city, words), Ok(turned), "{words}");
}

#[test]
fn who_sells_both_is_meant_and_who_sells_one_is_listed() {
    mean(
        "oldtown",
        "put a chef in front of Miller's Bakery",
        &["Please place a chef in front of the shop that sells bread and cake."],
    );
    let city = City::read("oldtown");
    let told = |words: &str| {
        let mut world = city.world.clone();
        let mut editor = SceneEditor::new(Seed(7)).looking_as(city.me, &world);
        editor.say(words, &mut world).map(|done| done.answer).map_err(|error| error.to_string())
    };
    let listed = told("list the buildings that sell cake");
    assert!(listed.is_ok(), "{listed:?}");
    for words in ["List every place that sells cake.", "list all the places that sell cake"] {
        assert_eq!(told(words), listed, "{words}");
    }
}

#[test]
fn who_is_to_be_busy_somewhere_is_added() {
    mean(
        "harbour",
        "add four joggers near the street lamp",
        &["Four joggers should be warming up near the street lamp."],
    );
    mean(
        "quarter",
        "add five children near the fountain",
        &["Five children should be playing near the fountain."],
    );
}

#[test]
fn what_has_to_vanish_is_removed_and_never_added() {
    mean(
        "harbour",
        "remove the scooter",
        &[
            "This scooter here, he must disappear, thank you.",
            "The scooter, it has to go.",
            "That ugly scooter, it should leave.",
        ],
    );
    mean("oldtown", "remove the yellow bicycle", &["Yellow bicycle, bye-bye!"]);
}

#[test]
fn what_is_named_first_is_what_is_missed() {
    let city = City::read("oldtown");
    let missed = edits_of(&city, "paint the windmill white").unwrap_err();
    assert_eq!(edits_of(&city, "The windmill looks shabby, paint it white."), Err(missed));
}

#[test]
fn wishes_of_others_and_factors_told_behind_are_understood() {
    for (city, plain, said) in [
        (
            "quarter",
            "make the postbox three times as big",
            &["Would love the postbox way bigger, like times three"][..],
        ),
        ("harbour", "put a boathouse anywhere", &["Be a dear and stick a boathouse wherever you fancy."]),
        (
            "oldtown",
            "put a planter near the bus stop",
            &["It would be a shame not to have a planter near the bus stop."],
        ),
        ("quarter", "move Bo near the postbox", &["Mister Bo, he must go to stand near the postbox."]),
        (
            "quarter",
            "put a newsstand across from the museum",
            &["Morning commuters would thank us for a newsstand across from the museum."],
        ),
    ] {
        mean(city, plain, said);
    }
}
