//! What people tell along the way, break off, name again or point at, beside what they ask for: it comes to the edits of the plain order,
//! and no order is lost in it.

use crate::city::City;
use crate::edits_common::come_to;
use simworld_agents::editing::{Edit, SceneEditor};
use simworld_core::seed::Seed;

/// Said so in a copy of the city: the edits, or the answer why there are none.
fn edits_of(city: &City, words: &str) -> Result<Vec<Edit>, String> {
    let mut world = city.world.clone();
    let mut editor = SceneEditor::new(Seed(7)).looking_as(city.me, &world);
    editor.say(words, &mut world).map(|done| done.edits).map_err(|error| error.to_string())
}

/// Each is said like this, and means what the plain order does.
fn mean_the_same(city: &str, pairs: &[(&str, &str)]) {
    let city = City::read(city);
    let astray: Vec<String> = pairs
        .iter()
        .filter_map(|(said, plain)| {
            let meant = edits_of(&city, plain).unwrap_or_else(|error| panic!("{plain}: {error}"));
            let got = edits_of(&city, said);
            (got.as_ref() != Ok(&meant)).then(|| format!("{said}\n    meant {meant:?}\n    got   {got:?}"))
        })
        .collect();
    assert!(astray.is_empty(), "{} astray:\n{}", astray.len(), astray.join("\n"));
}

#[test]
fn what_is_told_along_the_way_is_passed_over() {
    let city = City::read("oldtown");
    let plain = "put a stage in front of the Town Gallery";
    let meant = edits_of(&city, plain).unwrap();
    let before = [
        "The choir sings on Sunday, so",
        "Kids draw on my wall, so",
        "My dentist says I ought to smile more often, so",
        "I run the bakery, and my bins overflow every single Friday:",
        "My sister gets married on Saturday and nobody told me:",
        "The bench by the school gets wet, so",
    ];
    let behind = [
        ", the kids chose it",
        ". The rector insists on one",
        ", people queue there",
        ", we have dancers coming",
    ];
    let said = before.iter().map(|told| format!("{told} {plain}."));
    let said = said.chain(behind.iter().map(|told| format!("{plain}{told}.")));
    let astray: Vec<String> = said
        .filter_map(|said| {
            let got = edits_of(&city, &said);
            (got.as_ref() != Ok(&meant)).then(|| format!("{said}\n    got {got:?}"))
        })
        .collect();
    assert!(astray.is_empty(), "{} astray:\n{}", astray.len(), astray.join("\n"));
}

#[test]
fn what_is_broken_off_or_named_again_is_one_thing() {
    mean_the_same(
        "harbour",
        &[
            ("put a well... a bird bath next to the mailbox", "put a bird bath next to the mailbox"),
            (
                "half a dozen lobster... er, wooden barrels next to the diner",
                "six wooden barrels next to the diner",
            ),
            ("put a sign next to the mailbox, a direction sign", "put a direction sign next to the mailbox"),
            ("put something to sit on, a stool, next to Anna", "put a stool next to Anna"),
            ("put a stool next to Anna - her feet hurt", "put a stool next to Anna"),
        ],
    );
}

#[test]
fn what_is_pointed_at_is_what_was_told_of_before() {
    mean_the_same(
        "quarter",
        &[
            (
                "There's one bench in Rose Park, and my mother loves it, so put a bird bath next to that bench",
                "put a bird bath next to the bench in Rose Park",
            ),
            ("The kids race their bikes on Elm Street at night, so close it.", "close Elm Street"),
            ("The film crew is busy on River Walk, so close the street for them.", "close River Walk"),
        ],
    );
}

#[test]
fn no_order_is_lost_in_what_is_told() {
    mean_the_same(
        "quarter",
        &[
            (
                "For the street party close Elm Street and put a stage on Market Square.",
                "close Elm Street and put a stage on Market Square",
            ),
            (
                "swap the two cars, and while we're at it paint the postbox blue",
                "swap the two cars and paint the postbox blue",
            ),
            (
                "turn the red car around by 180 degrees, then rename it 'Night Line'",
                "turn the red car by 180 degrees and rename the red car 'Night Line'",
            ),
        ],
    );
    // Nobody is moved, and no letter made.
    mean_the_same(
        "campus",
        &[
            (
                "please get a park bench in front of the lab for the helpers",
                "put a park bench in front of the lab",
            ),
            ("turn Gus around so that he faces the Curie Lab", "make Gus face the Curie Lab"),
            ("move Fay next to the statue, she's posting a letter", "move Fay next to the statue"),
            (
                "three metres north of the hydrant, a direction sign",
                "a direction sign three metres north of the hydrant",
            ),
        ],
    );
    // A wish for what nobody has is not passed over.
    let unknown = edits_of(&City::read("campus"), "I want a unicorn, and put a bench next to the statue");
    assert!(unknown.is_err(), "{unknown:?}");
}

#[test]
fn nothing_is_made_or_moved_that_was_not_asked_for() {
    mean_the_same(
        "oldtown",
        &[
            (
                "Remove the white van and the yellow taxi, I can't stand the noise.",
                "remove the white van and the yellow taxi",
            ),
            (
                "move the table next to the bus stop, people have to stand there for ages",
                "move the table next to the bus stop",
            ),
            (
                "Carol would love a stool next to the postbox, can you add one?",
                "put a stool next to the postbox",
            ),
            ("We're having a party: a stage next to the postbox.", "a stage next to the postbox"),
            ("Ivy Cottage is so small that people overlook it, so paint it red", "paint Ivy Cottage red"),
        ],
    );
    mean_the_same(
        "harbour",
        &[("Ben owns the scooter, so move it next to him", "move the scooter next to Ben")],
    );
}

#[test]
fn names_that_hold_an_order_or_a_denial_are_names() {
    mean_the_same(
        "quarter",
        &[
            ("put a no parking sign next to the kiosk", "put a parking sign next to the kiosk"),
            (
                "park lanterns on both sides of Elm Street every 25 metres",
                "put park lanterns on both sides of Elm Street every 25 metres",
            ),
            (
                "put a stool next to the street lamp closest to Elm Street",
                "put a stool next to the northernmost street lamp",
            ),
            (
                "close the western half of Elm Street",
                "close Elm Street between Harbour Road and Station Road",
            ),
        ],
    );
}

#[test]
fn conditions_on_what_nobody_has_hold() {
    mean_the_same(
        "oldtown",
        &[
            (
                "if there's no market stall in town, put one next to the postbox",
                "put a market stall next to the postbox",
            ),
            (
                "if there is no bicycle rack yet, put a bicycle rack next to the taxi",
                "put a bicycle rack next to the taxi",
            ),
            ("if it isn't raining, make it rain", "make it rain"),
            ("if the taxi is still there, remove it", "remove the taxi"),
        ],
    );
    let city = City::read("oldtown");
    let edits = edits_of(&city, "if there is a market stall in town, remove the taxi").unwrap();
    assert!(matches!(edits[..], [Edit::Leave { .. }]), "{edits:?}");
}

#[test]
fn neither_an_order_behind_then_nor_a_place_behind_a_comma_is_lost() {
    come_to(
        "harbour",
        &[
            (
                "Paint the blue car white, then give it a quarter turn to the right.",
                "paint car_blue white + rotate car_blue -90",
            ),
            ("Paint the blue car white, then give it a twin.", "! unknown thing ~ twin"),
            ("Paint the blue car white, then make it nicer.", "! not understood"),
            (
                "A bicycle rack, please, beside the business that sells newspapers.",
                "add bicycle_rack next_to shop",
            ),
            (
                "A bicycle rack, please, beside the frobnicator that sells newspapers.",
                "! not found ~ frobnicator",
            ),
        ],
    );
}

#[test]
fn what_somebody_thinks_is_no_wish_unless_he_likes_it() {
    come_to(
        "harbour",
        &[
            ("My sister thinks the bus would look great in green.", "paint bus green"),
            ("I don't think the bus would look good in green.", "! not understood"),
            ("Nobody thinks the bus would look good in green.", "! not understood"),
            ("I think the bus would look awful in green.", "! not understood"),
            ("The bus would look bad in green.", "! not understood"),
        ],
    );
}

#[test]
fn what_nobody_has_is_not_replaced_by_what_is_only_as_grand() {
    come_to(
        "harbour",
        &[
            ("Put a grand piano next to Anna.", "! unknown thing ~ piano"),
            (
                "I need a row of seven frobnicators between the pine and the parcel.",
                "! unknown thing ~ frobnicators",
            ),
        ],
    );
}
