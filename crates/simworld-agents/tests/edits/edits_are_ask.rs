//! What is asked in other words, times by their minutes, scenes that are set by their weather, shades of colours, and what is taken back as a whole: what
//! must come of them, and what must not be read so.

use crate::city::City;
use crate::edits_are_chatted::{edits_of, mean};
use crate::edits_common::come_to;

#[test]
fn who_sells_something_is_listed_and_what_one_can_buy_is_described() {
    come_to(
        "campus",
        &[
            ("Who sells ice cream?", "list kiosk"),
            ("Where can I get a salad?", "list canteen"),
            ("What can one buy at the Blue Spoon?", "describe canteen"),
            ("What do they sell at the Kiosk?", "describe kiosk"),
        ],
    );
    come_to("harbour", &[("Where do they have newspapers for sale?", "list shop")]);
    come_to("oldtown", &[("My group is hungry: where do they sell cake?", "list cafe bakery")]);
}

#[test]
fn which_and_who_and_where_are_questions_about_the_scene() {
    come_to(
        "harbour",
        &[
            ("Which is the tallest tree?", "list pine"),
            ("Which building lies furthest south?", "list diner"),
            ("Which places are called Elm Café?", "list elm_east elm_west"),
            ("Which door can't I get through because it's locked?", "list door_l3"),
            ("Where is Ben hanging around?", "describe ben"),
            ("Chairs and tables together, how many is that?", "count 3"),
        ],
    );
    come_to("campus", &[("Is there a fountain somewhere?", "list fountain")]);
    come_to("oldtown", &[("List all the people except me.", "list carol dmitri eve")]);
    come_to(
        "quarter",
        &[("Which trees grow in Rose Park?", "list lime_1 lime_2"), ("Who's in the park?", "list ada")],
    );
}

#[test]
fn what_is_farther_one_way_or_taller_is_counted() {
    come_to(
        "campus",
        &[
            ("How many benches are further west than the maple?", "count 2"),
            ("Which cars are farther east than the black car?", "list car_3"),
        ],
    );
    come_to("quarter", &[("How many limes are taller than the statue?", "count 2")]);
}

#[test]
fn minutes_are_told_from_the_hour() {
    come_to(
        "campus",
        &[
            ("Set the clock to quarter to nine in the evening.", "hour 20.75"),
            ("Set the clock to a quarter past seven in the morning.", "hour 7.25"),
            ("Make it half past six in the evening.", "hour 18.5"),
        ],
    );
    come_to("quarter", &[("Quarter past five in the afternoon, with showers.", "weather rain & hour 17.25")]);
}

#[test]
fn scenes_are_set_by_their_weather() {
    come_to(
        "harbour",
        &[
            ("A sea mist rolls in.", "weather fog"),
            ("High noon, not a cloud in the sky.", "weather clear & hour 12"),
        ],
    );
    come_to(
        "oldtown",
        &[
            ("Enough of the bad weather, clear the sky.", "weather clear"),
            ("Put on sum fogg.", "weather fog"),
        ],
    );
    come_to("campus", &[("For the opening shot I want thick fog at first light.", "weather fog & hour 6")]);
}

#[test]
fn shades_are_their_colours_and_trees_are_trees() {
    mean(
        "harbour",
        "The hydrant ought to be white, the mailbox yellow.",
        &["The hydrant ought to be white, the mailbox canary yellow."],
    );
    mean("oldtown", "paint the van green", &["Paint the van olive green."]);
    come_to("oldtown", &[("Plant an olive tree next to Rose Cottage.", "add olive_tree next_to house_1")]);
}

#[test]
fn what_is_taken_back_as_a_whole_changes_nothing() {
    come_to(
        "campus",
        &[
            ("Put a bench by the statue... oh, forget it, leave all as it is.", ""),
            ("Paint the statue red, scratch that.", ""),
        ],
    );
    come_to("quarter", &[("Paint the school yellow... no, never mind, leave it.", "")]);
}

#[test]
fn who_is_set_facing_somebody_looks_there_and_stays() {
    come_to(
        "oldtown",
        &[("First call the dog Caesar, then set him facing Eve.", "name bruno 'Caesar' + face bruno eve")],
    );
}

#[test]
fn copies_are_of_what_is_there_and_go_where_all_of_them_go() {
    come_to(
        "harbour",
        &[("Copy the street lamp to a spot 10 m north of the old one.", "copy lamp off lamp 10 north")],
    );
    come_to(
        "quarter",
        &[("One more fountain like the one we have, east of the kiosk.", "copy fountain east_of kiosk")],
    );
}

#[test]
fn nothing_else_is_touched() {
    mean(
        "oldtown",
        "add a kindergarten west of the gallery",
        &["Add a kindergarten west of the gallery and don't touch anything else."],
    );
}

#[test]
fn what_is_no_question_about_the_scene_stays_refused() {
    let city = City::read("harbour");
    for words in [
        "Who won the regatta last year?",
        "Which is the best way to live?",
        "Where do they sell dreams?",
        "Who sells dreams?",
    ] {
        assert!(edits_of(&city, words).is_err(), "{words}");
    }
}
