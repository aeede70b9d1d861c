//! What people say who chat: whole sentences that ask for nothing, reasons, words that are taken back, slang and the language of who learns it. It
//! comes to the edits of the plain order, and what asks for nothing changes nothing.

use crate::city::City;
use simworld_agents::editing::{Difference, Edit, SceneEditor};
use simworld_core::seed::Seed;

/// Said so in a copy of the city: the edits, or the answer why there are none.
pub(crate) fn edits_of(city: &City, words: &str) -> Result<Vec<Edit>, String> {
    let mut world = city.world.clone();
    let mut editor = SceneEditor::new(Seed(7)).looking_as(city.me, &world);
    editor.say(words, &mut world).map(|done| done.edits).map_err(|error| error.to_string())
}

/// All that is said means what the plain order does.
pub(crate) fn mean(city: &str, plain: &str, said: &[&str]) {
    let city = City::read(city);
    let meant = edits_of(&city, plain).unwrap_or_else(|error| panic!("{plain}: {error}"));
    let astray: Vec<String> = said
        .iter()
        .filter_map(|said| {
            let got = edits_of(&city, said);
            (got.as_ref() != Ok(&meant)).then(|| format!("{said}\n    meant {meant:?}\n    got   {got:?}"))
        })
        .collect();
    assert!(astray.is_empty(), "{} astray:\n{}", astray.len(), astray.join("\n"));
}

#[test]
fn whole_sentences_that_ask_for_nothing_are_left_out() {
    mean(
        "quarter",
        "put a bird bath next to the postbox",
        &[
            "Granny needs to rest on the way. Put a bird bath next to the postbox.",
            "Hiya, cold hands here, put a bird bath next to the postbox",
            "My knees hurt today. I hardly slept. Put a bird bath next to the postbox.",
            "The kettle broke this morning, what a day. Put a bird bath next to the postbox, please.",
            "Choir practice tonight, I am so excited. Put a bird bath next to the postbox.",
            "We drove for six hours. A bird bath next to the postbox, please.",
            "Put a bird bath next to the postbox. My feet are killing me.",
            "Put a bird bath next to the postbox. My boss is in a foul mood.",
            "Oh dear, my train was late again. Put a bird bath next to the postbox. It rained all night.",
            "I had a wonderful breakfast. The eggs were cold. Put a bird bath next to the postbox.",
        ],
    );
}

#[test]
fn what_a_request_follows_from_is_left_out() {
    mean(
        "quarter",
        "put a bollard in front of the Old Bakery",
        &[
            "Visitors park everywhere, so put a bollard in front of the Old Bakery.",
            "Good evening, visitors park everywhere, so a bollard in front of the Old Bakery, please.",
            "Drivers ignore me, so put a bollard in front of the Old Bakery.",
            "Put a bollard in front of the Old Bakery because visitors park everywhere.",
            "Teenagers race about at night so put a bollard in front of the Old Bakery.",
        ],
    );
    mean(
        "quarter",
        "put park lanterns every twenty-five metres on both sides of Elm Street",
        &[
            "The ladies of my bridge club are afraid in the dark, so park lanterns on both sides of Elm Street, one every twenty-five metres.",
        ],
    );
    mean(
        "quarter",
        "put a forklift near the Town Hall",
        &[
            "Hello, we wait for a delivery, put a forklift near the Town Hall.",
            "Helllo, we wiat for a deliverey, put a forklfit near the Twon Hall.",
            "We are waiting for a delivery, put a forklift near the Town Hall.",
        ],
    );
}

#[test]
fn things_and_places_that_are_taken_back_give_way() {
    for (city, plain, said) in [
        // A new thing.
        (
            "quarter",
            "put a ladder behind the Old Bakery",
            &[
                "put a toolbox, sorry, a ladder, behind the Old Bakery",
                "Set a toolbox, sorry, a ladder, behind the Old Bakery.",
                "put a toolbox, let me say a ladder, behind the Old Bakery",
                "put a toolbox, no, a ladder behind the Old Bakery",
            ][..],
        ),
        (
            "oldtown",
            "put a bucket next to Carol",
            &["put a barrel, no a bucket next to Carol", "put a barrel, I mean a bucket, next to Carol"],
        ),
        // A place.
        (
            "quarter",
            "put a bucket next to the northernmost trash bin",
            &[
                "put a bucket next to the trash bin by Elm Street",
                "Next to the trash bin by Oak Street, no, the trash bin by Elm Street, put a bucket.",
                "put a bucket next to the trash bin by Oak Street, no, the trash bin by Elm Street",
            ],
        ),
        (
            "quarter",
            "put a suitcase next to Bo",
            &[
                "put a suitcase next to Ada, no, next to Bo",
                "put a suitcase next to Ada, no wait, next to Bo",
                "put a suitcase behind the statue, I mean next to Bo",
            ],
        ),
        (
            "oldtown",
            "put a guitar next to the street lamp by the green scooter",
            &["Put a guitar next to the street lamp by the black, sorry, by the green scooter."],
        ),
    ] {
        mean(city, plain, said);
    }
}

#[test]
fn numbers_and_colours_that_are_taken_back_give_way() {
    for (city, plain, said) in [
        // A number.
        (
            "quarter",
            "put three stools next to the fountain",
            &[
                "put two, no, three stools next to the fountain",
                "put two, no three stools next to the fountain",
                "put two no three stools next to the fountain",
                "put two, I mean three stools next to the fountain",
                "put five, wait, three stools next to the fountain",
            ][..],
        ),
        (
            "quarter",
            "put a flagpole ten metres north of the statue",
            &["put a flagpole five, I mean ten metres north of the statue"],
        ),
        // A colour, and which of several.
        (
            "quarter",
            "paint the red bench green",
            &[
                "paint the blue, I mean the red bench green",
                "paint the blue, no, the red bench green",
                "paint the blue, sorry, red bench green",
                "paint the red bench yellow, no, green",
            ],
        ),
        (
            "quarter",
            "remove the red car",
            &["remove the white car, I mean the red", "remove the white car, sorry, I meant the red one"],
        ),
    ] {
        mean(city, plain, said);
    }
}

#[test]
fn who_sells_something_is_known_by_it() {
    mean(
        "campus",
        "put a chalkboard next to the Blue Spoon",
        &[
            "put a chalkboard next to the one that sells salad",
            "put a chalkboard next to the stand where you get coffee",
            "put a chalkboard next to the place with the soup",
            "put a chalkboard next to the building that serves a bowl of soup",
            "Next to the place that sells newspapers, no, wait, next to the one that sells salad, put a chalkboard.",
        ],
    );
    mean(
        "campus",
        "put a chalkboard next to the Kiosk",
        &[
            "put a chalkboard next to the building with the ice cream",
            "put a chalkboard next to the shop where you get ice cream",
        ],
    );
    mean(
        "oldtown",
        "put a chalkboard next to The Paper Moon",
        &[
            "put a chalkboard next to the place that has maps",
            "put a chalkboard next to the shop with the books",
        ],
    );
}

#[test]
fn a_language_that_is_learnt_is_understood() {
    mean(
        "campus",
        "put a bucket next to the clinic",
        &[
            "could the clinic have a bucket next to it",
            "could the clinic please get a bucket beside it?",
            "please to make a bucket next to the clinic",
            "it lacks a bucket next to the clinic",
            "gimme a bucket next to the clinic",
            "gizza bucket next to the clinic",
            "chuck a bucket next to the clinic",
            "plonk a bucket down next to the clinic",
        ],
    );
    mean(
        "quarter",
        "put a sundial next to the statue",
        &["Dear sir, I learn English since one year: it must to be a sundial at the side of the statue."],
    );
}

#[test]
fn rows_wishes_and_streets_are_told_loosely() {
    mean(
        "quarter",
        "put street lamps every twenty metres on both sides of Oak Street",
        &["street lamps along Oak Street on both sides, one every twenty metres"],
    );
    mean(
        "oldtown",
        "put a ladder next to the tallest lime",
        &["If one of the limes is taller than ten metres, put a ladder next to it."],
    );
    mean(
        "oldtown",
        "put a barrel next to the postbox",
        &["I'd like a barrel next to the postbox, set that up please"],
    );
    mean(
        "quarter",
        "open the closed part of Mill Lane",
        &[
            "Let the traffic through the closed part of Mill Lane again, the digging is over.",
            "let the cars through the closed part of Mill Lane again",
            "lift the closure of Mill Lane",
        ],
    );
}

#[test]
fn slang_means_what_plain_words_do() {
    for (plain, said) in [
        (
            "remove the moped",
            &[
                "get rid of the moped",
                "do away with the moped",
                "lose the moped",
                "make the moped disappear",
                "make disappear the moped",
                "boot the moped out of here",
                "turf the moped out",
                "give the moped the boot",
                "I want no moped more here",
            ][..],
        ),
        (
            "paint the moped red",
            &[
                "give the moped a coat of red",
                "slap some red on the moped",
                "splash some red paint over the moped",
                "make red the moped",
                "paint with red the moped",
                "daub the moped red",
                "the moped should get a red coat",
            ],
        ),
        (
            "move the moped next to the truck",
            &[
                "plonk the moped next to the truck",
                "hoik the moped next to the truck",
                "scooch the moped next to the truck",
                "shove the moped over next to the truck",
                "the moped it must go next to the truck",
            ],
        ),
        (
            "make the sign face the truck",
            &[
                "let the sign face the truck",
                "turn the sign that it looks at the truck",
                "the sign must look at the truck",
            ],
        ),
        (
            "swap the moped and the truck",
            &[
                "let the moped and the truck change places",
                "make the moped and the truck change place",
                "the moped and the truck must swap places",
            ],
        ),
    ] {
        mean("campus", plain, said);
    }
}

/// What seems to be talk and changes the meaning is not left out, and talk alone is no request.
#[test]
fn what_forbids_or_asks_for_nothing_changes_nothing() {
    let city = City::read("campus");
    let said = [
        "My knees hurt. Do not remove the hydrant.",
        "Visitors park everywhere.",
        "The mayor phoned me twice about this.",
        "My uncle sang all night, and my aunt danced.",
        "The doctor says I should walk more.",
        "I am tired. Put a bench next to the castle.",
        "It was a long week. Remove the hydrant, except on Sundays.",
        "Granny is fine, thanks for asking.",
        "My neighbour moved the truck yesterday.",
    ];
    let mut faults = Vec::new();
    for words in said {
        let mut world = city.world.clone();
        let mut editor = SceneEditor::new(Seed(7)).looking_as(city.me, &world);
        let done = editor.say(words, &mut world);
        if !Difference::between(&city.world, &world).is_empty() {
            faults.push(format!("{words}\n    did {:?}", done.map(|done| done.edits)));
        }
    }
    assert!(faults.is_empty(), "{} changed something:\n{}", faults.len(), faults.join("\n"));
}
