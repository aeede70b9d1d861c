//! Everyday words for things, for putting them somewhere and for asking: synonyms, slips that are other words, lost spaces, people as subjects, precautions
//! and wishes with the verb first. What must come of them, and what must not be read so.

use crate::city::City;
use crate::edits_are_chatted::{edits_of, mean};
use crate::edits_common::come_to;
use simworld_agents::editing::Edit;

/// None of it is carried out.
fn refused(city: &str, said: &[&str]) {
    let city = City::read(city);
    for words in said {
        let edits = edits_of(&city, words);
        assert!(edits.is_err(), "{words}: {edits:?}");
    }
}

#[test]
fn things_are_called_by_their_everyday_names() {
    come_to(
        "harbour",
        &[
            (
                "Could a burger van stand between the bus and the bus stop?",
                "add food_truck between bus bus_stop",
            ),
            ("Put a mound of sand by the pine.", "add sand_pile next_to pine"),
            ("Put a skiff next to the crate.", "add rowing_boat next_to crate"),
        ],
    );
    come_to(
        "oldtown",
        &[
            ("Let a kid wait near the door of the Lindgren School.", "add child near door_school"),
            ("Two lads should stand near the gallery.", "add boy 2 near gallery"),
        ],
    );
    come_to(
        "campus",
        &[
            ("Put a barrow next to the hedge.", "add wheelbarrow next_to hedge"),
            ("A copper on duty around the statue wouldn't go amiss.", "add police_officer near statue"),
        ],
    );
    come_to(
        "quarter",
        &[
            ("Could I have a cab across from the museum?", "add taxi across_from museum"),
            ("Could four pupils wait near Linden School?", "add student 4 near school"),
            ("Put a senior citizen near Ada.", "add elderly_person near ada"),
        ],
    );
}

#[test]
fn verbs_of_fastening_and_carrying_put_something_there() {
    mean(
        "harbour",
        "put a rowing boat south of St. Mary's Hospital",
        &["Tie up a rowboat south of St. Mary's Hospital."],
    );
    mean(
        "harbour",
        "put a doghouse beside the pine",
        &["Nail together a kennel beside the pine.", "Knock a kennel together beside the pine."],
    );
    mean(
        "oldtown",
        "put a street name sign at the corner of the Town Gallery",
        &["Screw a street name sign in at the corner of the Town Gallery."],
    );
    mean(
        "campus",
        "put a stool next to the table",
        &["Slide a stool in next to the table.", "Slip a stool in next to the table."],
    );
}

#[test]
fn who_is_sent_goes_and_who_turns_stays() {
    come_to(
        "harbour",
        &[
            (
                "Send Rex to sit beside Ben and tell Anna to look at the museum.",
                "move rex next_to ben + face anna museum",
            ),
            ("Ask Anna to wait next to the lamp.", "move anna next_to lamp"),
        ],
    );
    come_to(
        "quarter",
        &[
            (
                "Ada goes beside the statue, and Bo turns to face the fountain.",
                "move ada next_to statue + face bo fountain",
            ),
            (
                "Bo turns to face the fountain, and Ada walks over beside the statue.",
                "face bo fountain + move ada next_to statue",
            ),
        ],
    );
    come_to(
        "campus",
        &[
            (
                "Fay's legs are tired: walk her over so she's right beside the red bench.",
                "move fay next_to bench_2",
            ),
            ("Could the maple tree and the birch trade places?", "swap maple birch"),
            ("Would Fay and Gus swap seats, please?", "swap fay gus"),
        ],
    );
}

#[test]
fn wishes_may_begin_with_their_verb() {
    mean(
        "harbour",
        "paint the blue car orange",
        &[
            "It would look nicer were the blue car to be orange.",
            "Were the blue car painted orange, it would look nicer.",
        ],
    );
    mean(
        "campus",
        "add a sundial next to the hedge",
        &["It would be nice were there a sundial next to the hedge."],
    );
}

#[test]
fn all_but_some_are_changed() {
    come_to(
        "oldtown",
        &[("Make the chairs blue, all but the red one.", "paint chair_a blue + paint chair_c blue")],
    );
    come_to("quarter", &[("Remove the lamps, all except the southernmost one.", "remove lamp_2 lamp_3")]);
}

#[test]
fn visitors_are_told_what_is_there() {
    come_to(
        "oldtown",
        &[
            ("Tell my visitors something about the bookshop.", "describe bookshop"),
            ("Tell the children a bit more about the bookshop.", "describe bookshop"),
        ],
    );
}

#[test]
fn what_goes_is_gone_and_what_was_lost_is_wanted_anew() {
    come_to(
        "oldtown",
        &[
            ("Make vanish for me the green scooter, thank you.", "remove scooter_1"),
            (
                "Whip away the red chair, it wobbles, and put a stool where it stood.",
                "remove chair_b + add stool|bar_stool at (12, -6)",
            ),
        ],
    );
    come_to(
        "quarter",
        &[
            (
                "My barrow got stolen, so put a new one near the lime tree nearest to the statue.",
                "add wheelbarrow near lime_2",
            ),
            ("Do me the postbox in green, my friend.", "paint postbox green"),
        ],
    );
}

#[test]
fn precautions_are_no_conditions() {
    come_to(
        "campus",
        &[
            (
                "Uproot the hydrant, then, just in case of a blaze, put a fire extinguisher in its place.",
                "remove hydrant + add fire_extinguisher at (2, 9)",
            ),
            ("In case of an emergency, put a ladder next to the hedge.", "add ladder next_to hedge"),
        ],
    );
    // Whether it rains is a condition, and it does not.
    let edits = edits_of(&City::read("campus"), "In case of rain, put an umbrella next to Fay.");
    let is_added =
        edits.as_ref().is_ok_and(|edits| edits.iter().any(|edit| matches!(edit, Edit::Add { .. })));
    assert!(!is_added, "{edits:?}");
}

#[test]
fn skies_suit_what_they_are_asked_for() {
    come_to(
        "harbour",
        &[
            ("A clear, starry night would suit my story.", "weather clear & hour 23"),
            ("A misty, foggy dawn would be perfect for my film.", "weather fog & hour 6"),
            ("Can you mkae it sno?", "weather snow"),
        ],
    );
}

#[test]
fn slips_are_put_right() {
    come_to(
        "harbour",
        &[
            ("put a wodden barel nextto the oak", "add wooden_barrel next_to oak"),
            ("paintthe hydrant purpel", "paint hydrant purple"),
        ],
    );
    come_to(
        "oldtown",
        &[
            ("put a bukcet nextto the postbocks", "add bucket next_to postbox"),
            ("ad a hay bail bside the bakry", "add hay_bale next_to bakery"),
            ("pain the grean bench orenge", "paint bench_church orange"),
        ],
    );
    come_to(
        "campus",
        &[
            ("Plaese put a flour pot besidde the statue", "add flower_pot next_to statue"),
            ("paintthe hegde purpel", "paint hedge purple"),
        ],
    );
}

#[test]
fn who_is_named_twice_is_turned_once() {
    mean(
        "campus",
        "turn the blue bench a quarter turn to the left",
        &["Spin the blue bench, sorry, yes, the blue one, a quarter turn to the left."],
    );
}

#[test]
fn what_only_tells_or_is_unknown_stays_refused() {
    refused(
        "harbour",
        &[
            "Tell my wife that I love her.",
            "Tell my wife about the accident.",
            "My bike got stolen.",
            "Land a spaceship beside the mailbox.",
            "Send Walter to sit beside Ben.",
        ],
    );
    // Which of several is asked.
    refused("quarter", &["Pain the lime orange.", "Tie a balloon up next to the lamp."]);
}
