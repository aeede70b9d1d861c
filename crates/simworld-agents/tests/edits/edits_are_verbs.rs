//! Shades, shares of a size, verbs that say how something is done, headings, conditions on what there is, and which of several are meant: each
//! comes to the edits of its plain order, and what may mean something else is not read so.

use crate::city::City;
use crate::edits_are_chatted::{edits_of, mean};

/// Said so nothing is changed: it is asked which is meant.
fn ask(city: &str, plain: &str, said: &[&str]) {
    let city = City::read(city);
    let is_asked = |words: &str| edits_of(&city, words).is_err_and(|error| error.starts_with("which"));
    assert!(is_asked(plain), "{plain}: {:?}", edits_of(&city, plain));
    for said in said {
        assert!(is_asked(said), "{said}: {:?}", edits_of(&city, said));
    }
}

/// Said so nothing is done as the plain order would do it.
fn differ(city: &str, plain: &str, said: &[&str]) {
    let city = City::read(city);
    let meant = edits_of(&city, plain);
    assert!(meant.is_ok(), "{plain}: {meant:?}");
    for said in said {
        assert_ne!(edits_of(&city, said), meant, "{said}");
    }
}

#[test]
fn shades_are_colours() {
    mean(
        "harbour",
        "paint all cars except the blue one orange",
        &[
            "All cars but the blue one go tangerine.",
            "All cars except the blue one should be tangerine.",
            "Paint every car but the blue one burnt orange.",
        ],
    );
    mean(
        "harbour",
        "paint the crate green",
        &["Paint the crate emerald.", "The crate should become bottle-green.", "Make the crate olive."],
    );
    mean(
        "oldtown",
        "paint both white chairs black",
        &["Both white chairs must be jet-black.", "Paint both white chairs ebony."],
    );
    mean("quarter", "paint the school white", &["Repaint the school in off-white.", "Whitewash the school."]);
    mean("campus", "put a purple parasol next to the statue", &["Put a lilac parasol next to the statue."]);
    ask("oldtown", "paint the white chair red", &["Turn the white chair maroon."]);
    ask("harbour", "paint the left-hand door purple", &["Paint the left-hand door lilac."]);
}

#[test]
fn plants_and_dishes_are_no_colours() {
    mean("campus", "add lavender next to the birch", &["Add lavender next to the birch."]);
    assert!(edits_of(&City::read("quarter"), "Plant a chocolate tree in Rose Park.").is_err());
    // A name stays as it is.
    let city = City::read("harbour");
    assert_eq!(edits_of(&city, "call the dog Ruby"), edits_of(&city, "call the dog 'Ruby'"));
}

#[test]
fn shares_of_a_size_are_sizes() {
    mean(
        "campus",
        "scale the kiosk to 90 percent",
        &[
            "Shrink the kiosk by 10 percent.",
            "Make the kiosk 10 percent smaller.",
            "Reduce the kiosk by 10 %.",
        ],
    );
    mean(
        "quarter",
        "scale the statue to 70 percent",
        &[
            "The statue is overpowering, reduce it by 30 %.",
            "Reduce the statue by 30 percent.",
            "Decrease the statue by thirty per cent.",
        ],
    );
    mean(
        "campus",
        "scale the hedge to 125 percent",
        &[
            "Twenty-five per cent bigger, the hedge.",
            "Enlarge the hedge by a quarter.",
            "The hedge should be bigger by a quarter.",
            "The hedge should be a quarter taller.",
        ],
    );
    mean("campus", "make the hedge one and a half times as big", &["Enlarge the hedge by half."]);
    ask("quarter", "make the lime bigger", &["The lime should be bigger by half."]);
    // Nothing would be left of it.
    let city = City::read("campus");
    assert!(edits_of(&city, "Shrink the kiosk by 100 percent.").is_err());
}

#[test]
fn verbs_say_how_something_is_done() {
    for (city, plain, said) in [
        (
            "harbour",
            "put a rowing boat behind the diner",
            &["Beach a rowing boat behind the diner.", "Moor a rowing boat behind the diner."][..],
        ),
        ("quarter", "put a bust at the edge of the park", &["Unveil a bust at the edge of the park."]),
        ("harbour", "remove the red car near the bus stop", &["Crush the red car near the bus stop."]),
        (
            "campus",
            "turn Fay towards the statue and turn Gus around",
            &["Turn Fay so that she faces the statue, then have Gus do an about-turn."],
        ),
        ("campus", "turn Gus around", &["Gus should do an about-turn.", "About-turn, Gus!"]),
        (
            "oldtown",
            "copy the robot near the gallery",
            &["Please do one time more the robot, near of the gallery."],
        ),
        (
            "quarter",
            "remove the lamps except the southernmost one",
            &["Take the lamps down, except for the southernmost one."],
        ),
    ] {
        mean(city, plain, said);
    }
    ask("oldtown", "remove the scooter", &["Wheel away the scooter.", "Wheel the scooter away."]);
    ask("harbour", "remove the restaurant", &["The restaurant is up for demolition."]);
    ask("harbour", "remove the door on my right", &["The door on my right can go."]);
}

#[test]
fn what_cannot_be_stays_refused_and_what_goes_somewhere_is_not_gone() {
    let city = City::read("harbour");
    let shark = edits_of(&city, "Release a shark beside the crate.").unwrap_err();
    assert!(shark.contains("shark"), "{shark}");
    assert!(edits_of(&city, "Stuff the bus inside the hydrant.").is_err());
    differ(
        "harbour",
        "remove the scooter",
        &["Wheel the scooter next to the crate.", "Wheel away the scooter behind the diner."],
    );
    differ("harbour", "remove the crate", &["Take up the crate and put it next to the oak."]);
}

#[test]
fn a_heading_names_what_is_there() {
    mean(
        "harbour",
        "turn the bench near the museum 45 degrees to the left",
        &[
            "Bench near the museum: 45 degrees to the left.",
            "The bench near the museum: 45 degrees to the left.",
        ],
    );
    mean("campus", "turn Gus around", &["Gus: a half turn."]);
    // What is listed is new.
    differ(
        "harbour",
        "turn the crate 45 degrees to the left",
        &["A crate: 45 degrees to the left.", "Crate: next to the oak."],
    );
}

#[test]
fn what_there_is_is_asked_in_many_words() {
    mean(
        "quarter",
        "turn the statue 90 degrees clockwise",
        &[
            "If the park has a statue, turn it clockwise by 90°.",
            "Provided the park has got a statue, turn it clockwise by 90°.",
        ],
    );
    for (city, words) in [
        ("harbour", "If the harbour has got a windmill, knock it down."),
        ("oldtown", "Provided that a tractor is about, shift it north of the bakery."),
        ("campus", "If a snowman is standing anywhere, take it away."),
    ] {
        let city = City::read(city);
        let plain = edits_of(&city, "If there is a windmill, remove it.");
        assert!(plain.is_ok(), "{plain:?}");
        let edits = edits_of(&city, words);
        assert!(edits.as_ref().is_ok_and(|edits| edits.len() == plain.unwrap().len()), "{words}: {edits:?}");
    }
}

#[test]
fn which_of_several_are_meant() {
    for (city, plain, said) in [
        (
            "oldtown",
            "name the smallest lime Junior",
            &["Name the one tree under 8.5 m Junior.", "Name the tree shorter than 8.5 m Junior."][..],
        ),
        (
            "quarter",
            "name the nearest oak Methuselah",
            &[
                "Whichever oak is nearest to me should be called Methuselah.",
                "Name whichever oak is nearest to me Methuselah.",
            ],
        ),
        (
            "campus",
            "remove every car but the green one",
            &[
                "Every car bar the green one has to disappear.",
                "Every car barring the green one has to go.",
                "Remove all cars bar the green one.",
            ],
        ),
        (
            "quarter",
            "cut down all limes shorter than ten metres",
            &[
                "Cut down the limes unless they are taller than 10 metres.",
                "Cut down the limes if they are shorter than 10 metres.",
                "Cut down every lime unless it is taller than 10 metres.",
            ],
        ),
        (
            "quarter",
            "make all oaks taller than eight metres half as big",
            &["Oaks taller than eight metres are to be halved in size."],
        ),
    ] {
        mean(city, plain, said);
    }
    // Which lime this is about is open.
    differ(
        "quarter",
        "cut down all limes shorter than ten metres",
        &["Cut down the lime unless it is taller than 10 metres."],
    );
}
