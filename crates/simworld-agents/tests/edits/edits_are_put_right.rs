//! What people put right while they speak, places that are told by what stood there, words that are written as they sound, what is told of the weather,
//! and proposals and slang that are tried last: each comes to the edits of its plain order, and what is none of them stays as it was.

use crate::city::City;
use crate::edits_are_chatted::{edits_of, mean};
use simworld_agents::editing::{Edit, SceneEditor};
use simworld_core::seed::Seed;

/// What is said second comes to the same as a plain order does behind the same first sentence.
fn means_behind(city: &str, first: &str, plain: &str, said: &[&str]) {
    let city = City::read(city);
    let second = |words: &str| {
        let mut world = city.world.clone();
        let mut editor = SceneEditor::new(Seed(7)).looking_as(city.me, &world);
        editor.say(first, &mut world).unwrap_or_else(|error| panic!("{first}: {error}"));
        editor.say(words, &mut world).map(|done| done.edits).map_err(|error| error.to_string())
    };
    let meant = second(plain).unwrap_or_else(|error| panic!("{plain}: {error}"));
    for words in said {
        assert_eq!(second(words).as_ref(), Ok(&meant), "{words}");
    }
}

#[test]
fn what_is_put_right_behind_a_sound_gives_way() {
    mean(
        "campus",
        "move the red bench five metres south",
        &[
            "move the blue bench, hmm, the red bench, I mean, five metres south",
            "move the blue bench, no, the red bench, I mean, five metres south",
            "move the blue bench, er, the red bench five metres south",
            "move the red bench, I mean, five metres south",
            "move the red bench six, um, five metres south",
            "move the red bench five metres north, sorry, south",
        ],
    );
    mean("quarter", "remove the red bench", &["remove the blue bench, er, the red bench"]);
    mean(
        "quarter",
        "paint the red bench blue",
        &["paint the red bench green, or rather blue", "paint the red bench green, hmm, blue"],
    );
    mean("quarter", "put three stools by the fountain", &["put two, no, three stools by the fountain"]);
}

#[test]
fn places_and_lengths_that_are_put_right_give_way() {
    mean(
        "quarter",
        "put a weather station ten metres south of the Town Hall",
        &[
            "Hmm, a weather station, say, ten metres south of the Town Hall.",
            "put a weather station, let's say, ten metres south of the Town Hall",
            "put a weather station ten metres north, sorry, south of the Town Hall",
            "put a weather station five metres south, no, ten metres south of the Town Hall",
        ],
    );
    mean(
        "oldtown",
        "put a bird bath between Carol and Dmitri",
        &[
            "put a bird bath between Carol and, hmm, Dmitri",
            "put a bird bath between Carol and, sorry, Dmitri",
            "put a bird bath between Carol and, let me think, Dmitri",
        ],
    );
    mean("quarter", "put a stool at the fountain", &["put a stool at, let's see, the fountain"]);
}

/// Two things that are listed are two, whatever sound stands between them.
#[test]
fn what_is_listed_is_not_put_right() {
    mean("quarter", "remove the red car and the white car", &["remove the red car, um, and the white car"]);
    mean(
        "quarter",
        "put a stool by the fountain and a barrel by the statue",
        &["put a stool by the fountain and, um, a barrel by the statue"],
    );
}

#[test]
fn places_are_told_by_what_stood_there() {
    mean(
        "campus",
        "move the red scooter next to the hydrant and put a traffic barrel where it stood",
        &[
            "Move the red scooter next to the hydrant and put a traffic barrel in the scooter's old place.",
            "Move the red scooter next to the hydrant and put a traffic barrel where the scooter used to stand.",
        ],
    );
    means_behind(
        "campus",
        "remove the scooter",
        "put a traffic barrel at (5, -6)",
        &[
            "put a traffic barrel in the scooter's old place",
            "put a traffic barrel where the scooter used to stand",
            "put a traffic barrel where the scooter was",
        ],
    );
    means_behind(
        "oldtown",
        "turn Bruno around",
        "move him next to Eve",
        &["he belongs beside Eve", "he must stand beside Eve"],
    );
    mean("campus", "put a stool next to the maple", &["put a stool at the maple's foot"]);
    mean("campus", "move the table next to the maple", &["set the table down at the maple's foot"]);
    mean("campus", "make the red bench face the hydrant", &["have the red bench face the hydrant"]);
    mean(
        "campus",
        "move the statue in front of the library",
        &["the statue wants to be in front of the library"],
    );
}

/// What never stood anywhere has no old place, and what still stands has none either.
#[test]
fn what_left_no_place_has_none() {
    let city = City::read("campus");
    for words in
        ["put a traffic barrel in the wardrobe's old place", "put a traffic barrel in the statue's old place"]
    {
        assert!(edits_of(&city, words).is_err(), "{words}");
    }
}

#[test]
fn what_is_written_as_it_sounds_is_known() {
    mean(
        "campus",
        "put a picnic table behind the kiosk",
        &["put a piknik tabel behind the kiosk", "hey can you ad a piknik tabel behnd the kiosk thx"],
    );
    mean("oldtown", "remove the taxi", &["remove the taksi", "Remve the taksi."]);
    mean("campus", "remove the scooter", &["remove the skooter"]);
    mean("quarter", "put a bench by the fountain", &["put a bnech by teh fontain"]);
    mean("campus", "put a chair next to the hydrant", &["put a chare next to the hydrant"]);
}

#[test]
fn what_sounds_otherwise_stays_unknown() {
    let city = City::read("quarter");
    for words in [
        "put an igloo in front of the Town Hall",
        "put a cannon in front of the Town Hall",
        "remove the skyooter",
    ] {
        assert!(edits_of(&city, words).is_err(), "{words}");
    }
}

#[test]
fn what_is_told_of_the_weather_changes_nothing() {
    mean(
        "quarter",
        "put a bench by the fountain",
        &[
            "We had a lovely day. Put a bench by the fountain.",
            "It was a warm evening. Put a bench by the fountain.",
            "Lovely day today, put a bench by the fountain.",
            "Put a bench by the fountain. We had a lovely day.",
            "I really love the snow. Put a bench by the fountain.",
        ],
    );
    let city = City::read("quarter");
    let sets_sky = |edits: &[Edit]| edits.iter().any(|edit| matches!(edit, Edit::SetEnvironment(_)));
    for words in [
        "We had a lovely day. Do not remove the hydrant.",
        "We had a lovely day, so don't remove the hydrant.",
    ] {
        assert!(!edits_of(&city, words).is_ok_and(|edits| sets_sky(&edits)), "{words}");
    }
    mean("quarter", "make it evening", &["it should be evening", "let it be evening"]);
    mean("quarter", "make it snow", &["let it snow", "it should snow"]);
    mean("quarter", "a foggy evening", &["make it a foggy evening"]);
}

#[test]
fn proposals_and_slang_mean_what_plain_words_do() {
    for (plain, said) in [
        (
            "remove the moped",
            &[
                "the moped needs to go",
                "the moped can go",
                "what if we got rid of the moped",
                "how about getting rid of the moped",
            ][..],
        ),
        (
            "put a bench next to the hydrant",
            &[
                "what if there were a bench next to the hydrant",
                "wouldn't it be nice if there were a bench next to the hydrant",
                "how about a bench next to the hydrant",
            ],
        ),
        (
            "move the moped next to the truck",
            &["scoot over the moped next to the truck", "what if the moped stood next to the truck"],
        ),
        ("turn the truck around", &["give the truck an about-turn", "about-turn for the truck"]),
        ("replace the moped with a bench", &["swap out the moped for a bench"]),
        ("make the statue twice as big", &["blow up the statue to twice its size"]),
        ("make the statue twenty two centimetres taller", &["make the statue a head taller"]),
        (
            "move the truck two metres back",
            &["push the truck back two metres", "push back the truck two metres"],
        ),
    ] {
        mean("campus", plain, said);
    }
}

/// What somebody likes or does is no order.
#[test]
fn what_is_told_is_no_proposal() {
    let city = City::read("campus");
    for words in ["That stands next to the library.", "Those used to stand behind the statue."] {
        let moves = |edits: &[Edit]| edits.iter().any(|edit| matches!(edit, Edit::Move { .. }));
        assert!(!edits_of(&city, words).is_ok_and(|edits| moves(&edits)), "{words}");
    }
}

#[test]
fn room_that_is_left_is_a_gap() {
    mean(
        "campus",
        "put a planter with a gap of 80 cm to the statue",
        &[
            "Set down a planter so that 80 cm stay free between it and the statue.",
            "put a planter so that 80 cm remain clear between it and the statue",
            "put a planter so that 80 cm are left between it and the statue",
            "put a planter, leaving 80 cm between it and the statue",
            "put a planter leaving 80 cm free between it and the statue",
            "put a planter with 80 cm of space to the statue",
            "put a planter with 80 cm of clearance to the statue",
            "put a planter so that there is 80 cm of room between the planter and the statue",
        ],
    );
    // A clause that says where and is not understood is never left out.
    let city = City::read("campus");
    for words in [
        "put a planter so that 80 cm stay free between it and the wardrobe",
        "put a planter so that 2 metres of lawn lie between it and the statue",
    ] {
        assert!(edits_of(&city, words).is_err(), "{words}");
    }
    // What only says why still is.
    mean(
        "campus",
        "put a planter next to the statue",
        &["put a planter next to the statue so that visitors see it"],
    );
}

#[test]
fn names_end_before_another_order() {
    mean(
        "quarter",
        "name the statue Rosa and make it three times as large",
        &[
            "Name the statue Rosa and make it three times as large, the mayor insists.",
            "Name the statue Rosa and make it three times as large, my wife told me so.",
        ],
    );
    let city = City::read("quarter");
    for words in [
        "Name the statue Rosa and paint it blue, the mayor insists.",
        "Call the statue Rosa and move it next to the fountain, the mayor insists.",
    ] {
        let swallows = |edits: &[Edit]| {
            edits.iter().any(|edit| matches!(edit, Edit::Name { name, .. } if name != "Rosa"))
        };
        assert!(!edits_of(&city, words).is_ok_and(|edits| swallows(&edits)), "{words}");
    }
}

#[test]
fn what_is_kept_takes_back_the_order_about_it() {
    mean(
        "campus",
        "remove the hydrant, and stand a flagpole where the hydrant was",
        &[
            "Remove the hedge, no, keep the hedge and remove the hydrant, and stand a flagpole where the hydrant was.",
            "Remove the hedge, no wait, leave the hedge alone and remove the hydrant, and stand a flagpole where the hydrant was.",
        ],
    );
    mean("campus", "remove the hydrant", &["remove the hedge, no, keep the hedge and remove the hydrant"]);
}

#[test]
fn the_original_is_what_was_copied() {
    let city = City::read("campus");
    let copied = edits_of(&city, "copy the red bench to the left of the library").unwrap();
    let painted = edits_of(&city, "paint the red bench yellow").unwrap();
    for words in [
        "Copy the red bench to the left of the library and paint the original yellow.",
        "Copy the red bench to the left of the library, then paint the original bench yellow.",
    ] {
        assert_eq!(edits_of(&city, words), Ok([copied.clone(), painted.clone()].concat()), "{words}");
    }
    // Where nothing was copied there is no original.
    assert!(edits_of(&city, "paint the original yellow").is_err());
}

#[test]
fn what_reads_like_a_wish_and_is_none_is_left_out() {
    for (city, plain, said) in [
        (
            "campus",
            "remove all the cars except the black one",
            &[
                "Remove all the cars except the black one, the others belong to visitors.",
                "Remove all the cars except the black one, they belong to visitors.",
            ][..],
        ),
        (
            "oldtown",
            "put a coffee cup on the table",
            &[
                "Put a coffee cup on the table, somebody ordered an espresso.",
                "Put a coffee cup on the table, a guest ordered an espresso.",
                "Put a coffee cup on the table, someone just asked for an espresso.",
            ],
        ),
        (
            "oldtown",
            "erect a war memorial at least 30 metres away from the bus stop",
            &[
                "Raise a war memorial at least 30 metres away from the bus stop, it must be quiet there.",
                "raise a war memorial at least 30 metres away from the bus stop",
            ],
        ),
    ] {
        mean(city, plain, said);
    }
    let city = City::read("quarter");
    assert_eq!(
        edits_of(&city, "Bring the car here, I want to leave."),
        edits_of(&city, "bring the car here"),
        "which car is asked"
    );
    // What is ordered alone is ordered, and what the others should be is no remark.
    mean("quarter", "put a bench here", &["somebody ordered a bench here"]);
    let city = City::read("campus");
    let remove = edits_of(&city, "remove all the cars except the black one").unwrap();
    let words = "Remove all the cars except the black one, the others should be green.";
    assert_ne!(edits_of(&city, words), Ok(remove), "{words}");
}

#[test]
fn what_is_asked_of_texts_is_not_understood() {
    let city = City::read("quarter");
    for words in [
        "Translate this paragraph into Finnish for me.",
        "Please translate the letter into German.",
        "Could you translate this into French?",
        "Summarise this article.",
    ] {
        let answer = edits_of(&city, words).unwrap_err();
        assert!(answer.starts_with("cannot understand"), "{words}: {answer}");
    }
    // To translate a thing is to move it.
    mean("quarter", "move the statue two metres north", &["translate the statue two metres north"]);
}

#[test]
fn names_of_assets_are_known_with_slips_in_each_word() {
    mean(
        "harbour",
        "put a shipping container behind the museum",
        &["Palce a shiping contaner behnd the musuem, quikly", "put a shiping contaner behind the museum"],
    );
    mean(
        "quarter",
        "put a concrete barrier behind Bo",
        &["put a concrte barier behnd Bo, for his safty", "put a concrte barier behind Bo"],
    );
}

#[test]
fn roundabout_wishes_mean_what_plain_words_do() {
    for (city, plain, said) in [
        (
            "harbour",
            "put an advertising column within 20 feet of the hydrant",
            &[
                "An advertising column is fine, but no more than 20 feet from the hydrant.",
                "An advertising column is ok, but at most 20 feet from the hydrant.",
                "An advertising column would be fine, but not further than 20 feet from the hydrant.",
            ][..],
        ),
        (
            "harbour",
            "put a generator behind St. Mary's Hospital",
            &[
                "We would all sleep better if a generator stood behind St. Mary's Hospital.",
                "I'd be happier if a generator stood behind St. Mary's Hospital.",
            ],
        ),
        (
            "harbour",
            "put a small dog to the left of Anna",
            &["Me wanting that Anna has one small dog at left side of her."],
        ),
        (
            "oldtown",
            "paint the van pink",
            &[
                "My eyes would much rather see the van in pink.",
                "I would rather see the van painted pink.",
                "My wife would prefer to see the van in pink.",
            ],
        ),
        (
            "quarter",
            "put a book to the left of Ada",
            &["Ada she is needing one book, on left of her please.", "Ada she needs a book, at left of her"],
        ),
    ] {
        mean(city, plain, said);
    }
    // What would make nobody happier is not wished for.
    let city = City::read("harbour");
    let words = "We would all be sad if a generator stood behind St. Mary's Hospital.";
    assert!(edits_of(&city, words).is_err(), "{words}");
}
