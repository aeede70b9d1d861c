//! Edits among talk: what opens and closes it, negations that add nothing, what is put right a sentence later, states that are wished, and questions of where,
//! which and how far: what must come of them, and what must not be read so.

use simworld_agents::editing::SceneEditor;
use simworld_core::seed::Seed;

use crate::city::City;
use crate::edits_are_chatted::{edits_of, mean};
use crate::edits_common::come_to;

/// What is answered to a question.
fn answer(city: &str, words: &str) -> String {
    let city = City::read(city);
    let mut world = city.world.clone();
    let mut editor = SceneEditor::new(Seed(7)).looking_as(city.me, &world);
    let edited = editor.say(words, &mut world).unwrap_or_else(|error| panic!("{words}: {error}"));
    edited.answer.unwrap_or_default()
}

#[test]
fn what_opens_and_closes_a_talk_is_left_out() {
    mean(
        "oldtown",
        "A waiter next to the table and a street musician near Spot 7.",
        &[
            "Okay, Merlin, listen: a waiter next to the table and a street musician near Spot 7, and not a soul more than that.",
            "Listen up: a waiter next to the table and a street musician near Spot 7, and not one more.",
        ],
    );
    come_to(
        "quarter",
        &[
            (
                "Put a wheelie bin behind the building that sells bread, and thank you in advance.",
                "add wheelie_bin behind bakery",
            ),
            (
                "Put a wheelie bin behind the Old Bakery, there's a good fellow.",
                "add wheelie_bin behind bakery",
            ),
        ],
    );
    come_to("campus", &[("Jump the clock forward to eleven p.m., there's a good chap.", "hour 23")]);
}

#[test]
fn negations_that_add_nothing_are_left_out() {
    come_to(
        "oldtown",
        &[
            (
                "I want a pair of beehives near Ivy Cottage, and not a word to the neighbours!",
                "add beehive 2 near house_2",
            ),
            ("Put a guitar beside the table. Not on it, beside it.", "add guitar next_to table_cafe"),
            (
                "Make a copy of the green bench and put it next to Carol; the old one may stay where it is.",
                "copy bench_church next_to carol",
            ),
        ],
    );
    come_to(
        "campus",
        &[
            ("How many benches have we got on the campus? Don't add any, I only want to know.", "count 3"),
            (
                "Exactly ten metres north of the statue I need an obelisk, not a metre less.",
                "add obelisk off statue 10 north",
            ),
        ],
    );
    come_to(
        "harbour",
        &[(
            "We don't need another bench. What we do need is a drinking fountain close to Anna.",
            "add drinking_fountain near anna",
        )],
    );
}

#[test]
fn what_is_put_right_later_is_meant() {
    come_to(
        "campus",
        &[(
            "Set down a yellow suitcase south of the hydrant. Actually no, make that north of it.",
            "add suitcase yellow north_of hydrant",
        )],
    );
    come_to(
        "quarter",
        &[
            (
                "Could we have a swing set, oh wait, my mistake, a seesaw west of the statue?",
                "add seesaw west_of statue",
            ),
            (
                "Open a parasol, I mean place one, beside the bench that is closest to the chair.",
                "add parasol next_to bench_blue",
            ),
        ],
    );
}

#[test]
fn states_are_wished_in_many_words() {
    come_to(
        "quarter",
        &[
            ("The hydrant, I am preferring it in the colour blue.", "paint hydrant blue"),
            ("How about a snowman to keep Ada company, right at her side?", "add snowman next_to ada"),
            (
                "Somewhere on the edge of Rose Park a drinking fountain would be welcome, please add one.",
                "add drinking_fountain edge park",
            ),
        ],
    );
    come_to(
        "oldtown",
        &[
            ("I would be having a great happiness if it would be snowing.", "weather snow"),
            (
                "We're shooting the ghost scene at ten p.m. in thick fog, so set that up, will you?",
                "weather fog & hour 22",
            ),
            ("Give the robot a proper name at last, let's say 'Bolt'.", "name robot 'Bolt'"),
            (
                "The taxi should be moved three metres further west than where it stands now.",
                "move taxi at (-38, -5)",
            ),
            (
                "What a lovely morning this is! Would you put a market stall west of Carol?",
                "add market_stall west_of carol",
            ),
        ],
    );
    come_to(
        "harbour",
        &[
            ("Excuse me, is missing one barbecue near of Anna, please to put.", "add barbecue near anna"),
            (
                "For the smuggler film I need a string of seven wooden barrels, evenly spread, between the pine and the parcel.",
                "row wooden_barrel|barrel x7 between pine parcel",
            ),
            (
                "Swap Anna and Ben, and turn the bus right round, 180 degrees.",
                "swap anna ben + rotate bus 180",
            ),
        ],
    );
}

#[test]
fn what_can_go_goes_one_after_the_other() {
    come_to(
        "campus",
        &[
            (
                "Right, let's tidy up a bit. The bin can go, the sign can go, and Fido should be moved next to Hana.",
                "remove bin sign + move fido next_to hana",
            ),
            ("The bin can go, the sign must go too.", "remove bin sign"),
        ],
    );
    come_to("quarter", &[("They're digging up the western half of Oak Street, so close it.", "close oak_a")]);
}

#[test]
fn where_and_which_and_who_are_asked_in_many_words() {
    come_to(
        "campus",
        &[
            ("Where has Gus got to?", "describe gus"),
            ("Where has Gus wandered off to?", "describe gus"),
            ("Where on earth has Fido gone?", "describe fido"),
            ("Which buildings on this campus are offices?", "list lab tower"),
        ],
    );
    come_to("harbour", &[("Which people are in the scene besides me? I've lost track.", "list anna ben")]);
}

#[test]
fn distances_are_answered() {
    come_to(
        "harbour",
        &[
            ("How far is it from me to the Harbour Museum, roughly?", ""),
            ("How far is it to the Harbour Museum?", ""),
            ("What is the distance between the oak and the pine?", ""),
            ("How far apart are Anna and Ben?", ""),
            ("How far is the hydrant from the cone?", ""),
            ("How far is the mailbox?", "describe mailbox"),
            ("How far is it from the oak to the lighthouse?", "! not found"),
        ],
    );
    // From the outside of the one to the outside of the other.
    let told = answer("harbour", "How far is it from the oak to the pine?");
    assert!(told.contains("52 m") && told.matches("(#").count() == 2, "{told}");
}

#[test]
fn what_is_not_talk_alone_is_not_left_out() {
    let city = City::read("campus");
    for words in [
        "Not a word to the neighbours.",
        "Excuse me, Merlin, thank you in advance.",
        "How far is it from love to hate?",
        "Where has the time gone?",
    ] {
        assert!(edits_of(&city, words).is_err(), "{words}");
    }
    // What there is enough of is not taken away.
    mean("campus", "remove the sign", &["We don't need another sign. Remove the sign."]);
}
