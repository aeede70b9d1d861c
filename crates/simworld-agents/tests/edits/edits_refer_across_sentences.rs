//! What one sentence tells of and another takes up: pronouns, "the other", "the middle one", "the same colour", "there as well", "where it stood"; what must
//! come of them, and what must not be read so.

use crate::city::City;
use crate::edits_are_chatted::{edits_of, mean};
use crate::edits_common::come_to;

#[test]
fn one_of_several_that_were_told_of_is_told_from_the_others() {
    come_to(
        "harbour",
        &[
            (
                "There are two red cars: paint the western one black and remove the other.",
                "paint car_rust black + remove car_red",
            ),
            ("There are two chairs: paint the eastern one green.", "paint chair_oak green"),
            ("Of the two trees, the taller one has to be felled.", "remove pine"),
            ("Of the two trees, the smaller one has to be felled.", "remove oak"),
        ],
    );
    come_to(
        "campus",
        &[
            (
                "Three cars stand in a row. Delete the middle one and paint the other two yellow.",
                "remove car_2 + paint car_1 yellow + paint car_3 yellow",
            ),
            (
                "There are three cars: paint the black one red and the others blue.",
                "paint car_2 red + paint car_1 blue + paint car_3 blue",
            ),
        ],
    );
    come_to(
        "oldtown",
        &[
            (
                "I see three limes before me. Put a ladder next to the third from the left.",
                "add ladder next_to lime_2",
            ),
            (
                "I see three limes before me. Put a ladder next to the first from the left.",
                "add ladder next_to lime_1",
            ),
        ],
    );
    come_to(
        "quarter",
        &[
            (
                "Paint the southernmost of the three street lamps red and the northernmost blue.",
                "paint lamp_1 red + paint lamp_3 blue",
            ),
            (
                "Of the two cars, one is parked nearer to the chair. Put a suitcase beside that car.",
                "add suitcase next_to car_red",
            ),
            ("Half of the birches can go: keep the western one.", "remove birch_2"),
        ],
    );
}

#[test]
fn what_is_told_of_is_it() {
    come_to(
        "harbour",
        &[(
            "There's a red car somewhere behind me. Leave a jerry can next to it.",
            "add jerry_can next_to car_rust",
        )],
    );
    come_to(
        "oldtown",
        &[(
            "There's a street lamp to the west of me. Take it away, then paint the other one green and make it twice as large.",
            "remove lamp_1 + paint lamp_2 green + scale lamp_2 2",
        )],
    );
    come_to(
        "campus",
        &[
            (
                "There is a building here that sells ice cream. Place a parasol behind it.",
                "add parasol behind kiosk",
            ),
            ("Look at the library. Its door should be green.", "paint door_lib green"),
        ],
    );
    come_to(
        "quarter",
        &[
            ("Not far from me there is a cone. Set a toolbox beside it.", "add toolbox next_to cone"),
            ("The eastern half of Mill Lane is closed. Open it again.", "open mill_b"),
        ],
    );
}

#[test]
fn what_is_gone_leaves_its_place() {
    come_to(
        "oldtown",
        &[(
            "Remove both parcels. In place of the bigger one I want a flower pot.",
            "remove box_small box_big + add flower_pot at (-6, 5)",
        )],
    );
    come_to(
        "quarter",
        &[(
            "Both cars can go, but leave a bicycle rack where the white one was.",
            "remove car_red car_white + add bicycle_rack at (128, 60)",
        )],
    );
    come_to(
        "campus",
        &[(
            "Take the orange truck away. Where it stood I want a food truck, and a picnic table beside the kiosk as well.",
            "remove truck + add food_truck at (45, -15) + add picnic_table next_to kiosk",
        )],
    );
}

#[test]
fn others_get_the_same() {
    come_to(
        "harbour",
        &[(
            "Paint both chairs white. The table gets the same colour.",
            "paint chair_quay white + paint chair_oak white + paint table white",
        )],
    );
    come_to(
        "oldtown",
        &[
            (
                "Move the van next to the Registry. The yellow bicycle goes there as well.",
                "move van next_to office + move bike next_to office",
            ),
            (
                "The Paper Moon has no cash machine. Give it one, right beside the building.",
                "add cash_machine next_to bookshop",
            ),
        ],
    );
    come_to("campus", &[("Give the fountain the same colour as the truck.", "paint fountain orange")]);
}

#[test]
fn each_of_those_who_were_named_gets_one() {
    come_to(
        "campus",
        &[(
            "Gus and Hana should change places. After that, each of them gets an umbrella right next to them.",
            "swap gus hana + add umbrella next_to gus + add umbrella next_to hana",
        )],
    );
    come_to(
        "quarter",
        &[(
            "Ada and Bo need something to sit on, so a stool for each of them, right next to them.",
            "add stool|bar_stool next_to ada + add stool|bar_stool next_to bo",
        )],
    );
}

#[test]
fn comparisons_and_directions_say_which() {
    come_to(
        "harbour",
        &[("If the pine is taller than the oak, remove the smaller of the two.", "remove oak")],
    );
    come_to(
        "oldtown",
        &[
            ("Swap the mailbox with the bin that is nearer to me.", "swap postbox bin_1"),
            ("Any chair that is not white yet should become white.", "paint chair_b white"),
        ],
    );
    come_to(
        "quarter",
        &[
            (
                "Begin with the southernmost street lamp and paint every other one orange.",
                "paint lamp_1 orange + paint lamp_3 orange",
            ),
            ("Put a doctor next to the bin that stands north of the school.", "add doctor next_to bin_2"),
        ],
    );
    come_to(
        "campus",
        &[(
            "If the kiosk sells newspapers, put a newspaper box next to it; otherwise leave everything as it is.",
            "add newspaper_box next_to kiosk",
        )],
    );
}

#[test]
fn turns_of_phrase_go_across_sentences() {
    mean(
        "oldtown",
        "paint the taxi green",
        &[
            "The taxi, it would please me more in green. Do so.",
            "The taxi, it would suit me better in green.",
        ],
    );
    mean("oldtown", "move Bruno next to Eve", &["Shoo Bruno over so he's right beside Eve, would you?"]);
    come_to(
        "harbour",
        &[("Leave a gap of two metres between the hydrant and a new bucket.", "add bucket gap hydrant 2")],
    );
    come_to(
        "quarter",
        &[(
            "Copy the red bench two times and put both copies near the Town Hall.",
            "copy bench_red 2 near hall",
        )],
    );
}

#[test]
fn what_nothing_decides_is_no_edit() {
    for (city, words) in [
        // None of two is in the middle, and both are as tall as each other.
        ("harbour", "There are two red cars: paint the middle one black."),
        ("quarter", "Of the two birches, the taller one has to be felled."),
        ("harbour", "Do you know a good joke?"),
    ] {
        assert!(edits_of(&City::read(city), words).is_err(), "{words}");
    }
}

#[test]
fn what_is_told_beside_a_request_stays_so() {
    come_to(
        "oldtown",
        &[
            ("Remove both parcels.", "remove box_small box_big"),
            ("Of the chairs only the red one stays, remove the others.", "remove chair_a chair_c"),
        ],
    );
    come_to(
        "harbour",
        &[(
            "There's nothing on the table yet, is there? Lay a newspaper on it.",
            "add newspaper on_top_of table",
        )],
    );
}
