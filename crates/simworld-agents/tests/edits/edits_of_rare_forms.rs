//! Forms that few sentences have: conditions on doors, places and colours that are said again by a part of them, points in words, what goes where
//! something was that moved, and orders around which something rare is said. What must come of them, and what must not be read so.

use crate::city::City;
use crate::edits_are_chatted::{edits_of, mean};
use crate::edits_common::come_to;

#[test]
fn conditions_on_doors_are_kept() {
    come_to(
        "oldtown",
        &[
            (
                "If the bakery door is open, have a chef standing next to the bakery.",
                "add chef next_to bakery",
            ),
            (
                "If the door of the bakery is open, put a chef in front of Miller's Bakery.",
                "add chef in_front_of bakery",
            ),
            ("If the door of the bakery is shut, put a cash machine next to it.", ""),
            ("Unless the bakery's door is open, put a chef in front of the bakery.", ""),
        ],
    );
    come_to(
        "campus",
        &[
            (
                "If the door of the lab is locked, put a traffic cone in front of it.",
                "add any cone in_front_of door_lab",
            ),
            ("If the door of the lab isn't locked, put a bench next to the statue.", ""),
            ("If the library door is locked, put a bench next to the statue.", ""),
        ],
    );
}

#[test]
fn what_goes_in_the_place_of_what_moved_goes_where_it_was() {
    come_to(
        "oldtown",
        &[
            (
                "Move the postbox next to the bus stop and put a phone booth in its place.",
                "move postbox next_to stop + add phone_booth at (5, 8)",
            ),
            (
                "Remove the postbox and put a phone booth in its place.",
                "remove postbox + add phone_booth at (5, 8)",
            ),
        ],
    );
    come_to(
        "quarter",
        &[(
            "The red car is parked terribly. Could you move it behind the Town Hall and put a picnic table where the car was?",
            "move car_red behind hall + add picnic_table at (172, 60)",
        )],
    );
}

#[test]
fn places_and_colours_are_said_again_by_a_part() {
    come_to(
        "oldtown",
        &[
            (
                "Drive the taxi to the east of the white van, no, sorry, to the west of it, and paint the taxi black.",
                "move taxi west_of van + paint taxi black",
            ),
            (
                "Paint the taxi black and the van green - sorry, the van blue.",
                "paint taxi black + paint van blue",
            ),
        ],
    );
    come_to(
        "harbour",
        &[(
            "Put a picnic table beside the tree by the hospital, no, hang on, beside the tree closest to the hydrant.",
            "add picnic_table next_to oak",
        )],
    );
    come_to(
        "quarter",
        &[(
            "Move the red bench into the park and repaint the blue one green",
            "move bench_red inside park + paint bench_blue green",
        )],
    );
}

#[test]
fn points_and_distances_are_told_in_words() {
    come_to(
        "campus",
        &[
            ("Plant a tree at 25 east, 18 north.", "add any tree at (25, 18)"),
            ("Plant a tree at 18 north and 25 east.", "add any tree at (25, 18)"),
            (
                "The cable is short: place the generator no further than 400 cm from the charging station.",
                "add generator within charger 4",
            ),
        ],
    );
    come_to(
        "harbour",
        &[(
            "Move the scooter so there is a gap of three metres to the hydrant, I nearly tripped over it.",
            "move scooter gap hydrant 3",
        )],
    );
}

#[test]
fn what_is_said_around_an_order_leaves_it_as_it_is() {
    come_to(
        "harbour",
        &[
            (
                "One more thing for the street party: a stage near the museum and a street musician beside the mailbox",
                "add stage near museum + add street_musician next_to mailbox",
            ),
            ("Strike the cone and the crate, neither is in this scene.", "remove cone crate"),
            ("Lay an anchor to the west of the crate; every harbour needs one.", "add anchor west_of crate"),
            (
                "Anything in the way of trees taller than ten metres spoils the view of the fireworks, cut it down.",
                "remove pine",
            ),
            ("wooden crate at (-15, 15)", "add wooden_crate at (-15, 15)"),
            ("Let's surprise everyone and park a bus inside the Corner Shop!", "! impossible"),
            (
                "This is an emergency, so land a helicopter next to the mailbox.",
                "! unknown thing ~ helicopter",
            ),
        ],
    );
    come_to(
        "campus",
        &[
            (
                "Move Fay beside the statue, and once she is there have her face the library.",
                "move fay next_to statue + face fay library",
            ),
            ("My daughter says to paint the car purple.", "? car_1 | car_2 | car_3"),
            (
                "I'm not fussy about the model, honestly, any old car will do, just so long as it's white and it ends up near Maple House.",
                "add any car white near dorm",
            ),
            (
                "Story time at the fountain! Six stools spread evenly all round it.",
                "row stool x6 around fountain",
            ),
        ],
    );
    come_to(
        "quarter",
        &[
            (
                "I have booked one market stall, one food cart and one parasol, all to be kept inside Market Square.",
                "add market_stall inside square + add food_cart inside square + add parasol inside square",
            ),
            (
                "Two picnic tables inside the park and a barbecue next to the statue. It's Sports Day!",
                "add picnic_table 2 inside park + add barbecue next_to statue",
            ),
            ("Both cars, the red and the white, have to be removed.", "remove car_red car_white"),
            (
                "I have to store some apples, so put a wooden crate by the oak closest to the cone.",
                "add wooden_crate next_to oak_2",
            ),
            ("Give my thriller a snowy night.", "weather snow & hour 23"),
            ("Hide Ada inside the statue!", "! impossible"),
        ],
    );
}

#[test]
fn which_is_meant_is_said_before() {
    come_to(
        "oldtown",
        &[
            (
                "Beside the lime tree that stands north of the robot and is the tallest of all, plant a rose bush.",
                "add rose_bush next_to lime_3",
            ),
            ("I need a girl in front of the building whose door is open", "add girl in_front_of bakery"),
        ],
    );
    come_to(
        "campus",
        &[(
            "Hi again. Do you see the office whose door is locked? I need a bicycle rack to the left of that building.",
            "add bicycle_rack left_of lab",
        )],
    );
    mean(
        "quarter",
        "put a utility box next to the middle one of the three street lamps on Station Road",
        &[
            "Those three street lamps on Station Road, right? The middle one, the one between the other two, keeps buzzing, so put a utility box next to it.",
        ],
    );
}

#[test]
fn the_one_that_was_there_is_none_of_the_new_ones() {
    come_to(
        "quarter",
        &[
            (
                "Three deck chairs around the statue, an orange parasol beside Ada, and a flower pot on the chair.",
                "add deck_chair 3 near statue + add parasol orange next_to ada + add flower_pot on_top_of chair",
            ),
            (
                "Put two folding chairs next to the statue and remove the chair.",
                "add folding_chair 2 next_to statue + remove chair",
            ),
        ],
    );
}

#[test]
fn words_that_are_asked_for_are_none_of_the_scene() {
    come_to(
        "campus",
        &[
            ("By the way, do you know a good recipe for pancakes?", "! not understood"),
            ("Tell me a good joke, I've had a long day.", "! not understood"),
        ],
    );
    come_to("quarter", &[("please send an e-mail to my boss", "! not understood")]);
}

#[test]
fn what_decides_nothing_stays_refused() {
    for (city, words) in [
        ("campus", "If the door is locked, put a bench next to the statue."),
        ("campus", "Plant a tree at 25 east, 18 west."),
        ("oldtown", "Drive the taxi to the east of the unicorn, no, sorry, to the west of it."),
        ("quarter", "Move the red bench into the park and paint the white car and the pink one green."),
        ("harbour", "Hide the unicorn behind the museum."),
    ] {
        assert!(edits_of(&City::read(city), words).is_err(), "{words}");
    }
}
