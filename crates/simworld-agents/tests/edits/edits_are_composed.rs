//! Requests are composed: every way to ask, with every thing and every place, comes to the edit of the plain order.
//!
//! The plain orders are judged from outside by `edits_are_judged`; here each is put into the frames of its kind.

use crate::city::City;
use simworld_agents::editing::{Difference, Edit, SceneEditor};
use simworld_core::seed::Seed;

/// Said so in a copy of the city: the edits, or the answer why there are none.
fn edits_of(city: &City, words: &str) -> Result<Vec<Edit>, String> {
    let mut world = city.world.clone();
    let mut editor = SceneEditor::new(Seed(7)).looking_as(city.me, &world);
    editor.say(words, &mut world).map(|done| done.edits).map_err(|error| error.to_string())
}

/// What of the frames, filled with each row of words, does not come to the edits of the plain order.
fn astray(plain: &str, frames: &[&str], rows: &[&[(&str, &str)]]) -> Vec<String> {
    let city = City::read("campus");
    let fill = |frame: &str, row: &[(&str, &str)]| {
        row.iter().fold(frame.to_owned(), |words, (slot, filling)| words.replace(slot, filling))
    };
    let mut faults = Vec::new();
    for row in rows {
        let plain = fill(plain, row);
        let meant = edits_of(&city, &plain).unwrap_or_else(|error| panic!("{plain}: {error}"));
        for frame in frames {
            let words = fill(frame, row);
            let got = edits_of(&city, &words);
            if got.as_ref() != Ok(&meant) {
                faults.push(format!("{words}\n    meant {meant:?}\n    got   {got:?}"));
            }
        }
    }
    faults
}

fn holds(faults: &[String]) {
    assert!(faults.is_empty(), "{} astray:\n{}", faults.len(), faults.join("\n"));
}

#[test]
fn new_things_are_asked_for_in_many_ways() {
    let frames = [
        "there should be A B",
        "I want A B",
        "could we have A B, please?",
        "I'd love to see A B",
        "it would be nice to have A B",
        "wouldn't A look lovely B?",
        "A would look great B",
        "A B would be nice",
        "A B is missing",
        "A is needed B",
        "what we need is A B",
        "make sure there is A B",
        "residents would benefit from A B",
        "my boss wants A B",
        "how about A B?",
        "how about putting A B?",
        "B I want A",
        "B there should be A",
        "B, please put A",
        "I suggest adding A B",
        "let's have A B because people asked for it",
        "everyone is complaining. A B, please!",
        "A has to stand B",
        "A belongs B",
        "A goes B",
        "imagine A B",
        "for the shot I need A B",
        "would you mind adding A B?",
        "put A B so that people are happy",
    ];
    let mut rows: Vec<Vec<(&str, &str)>> = Vec::new();
    for thing in ["a bench", "a red sports car", "a vending machine"] {
        for place in
            ["next to the fountain", "in front of the Turing Library", "between the statue and the hydrant"]
        {
            rows.push(vec![("A", thing), ("B", place)]);
        }
    }
    let rows: Vec<&[(&str, &str)]> = rows.iter().map(Vec::as_slice).collect();
    holds(&astray("add A B", &frames, &rows));
}

#[test]
fn colours_are_asked_for_in_many_ways() {
    let frames = [
        "A should be C",
        "A would look better in C",
        "A looks better in C",
        "I'd say A looks best in C",
        "I want A C",
        "I want A painted C",
        "I'd like A to be C",
        "could A be C?",
        "what if A were C?",
        "give A a coat of C",
        "give A a fresh coat of C paint",
        "A needs a lick of C paint",
        "A must be painted C",
        "make sure A is C",
        "it would be great if A was C",
        "how about painting A C?",
        "A is ugly, make it C",
        "A? Make it C, please.",
        "paint A, if you don't mind, C",
        "A please paint C",
        "let A be C",
        "turn A C",
        "A has to become C",
        "put some C paint on A",
    ];
    let rows: [&[(&str, &str)]; 3] = [
        &[("A", "the truck"), ("C", "pink")],
        &[("A", "the hydrant"), ("C", "blue")],
        &[("A", "the car nearest to the statue"), ("C", "green")],
    ];
    holds(&astray("paint A C", &frames, &rows));
}

#[test]
fn things_are_sent_away_in_many_ways() {
    let frames = [
        "A has to go",
        "A should go",
        "I want A gone",
        "I don't need A any more",
        "I can't stand A",
        "get rid of A",
        "get A out of here",
        "throw A out",
        "take A away",
        "make A disappear",
        "A should be removed",
        "A can be thrown away",
        "A is no longer needed",
        "A? I don't need it.",
        "nobody uses A, lose it",
        "A gives me the creeps, take it away",
        "would you mind removing A?",
        "A please remove",
        "let's get rid of A, nobody likes it",
        "could somebody remove A?",
        "I would be happy if A were gone",
        "A must be deleted",
    ];
    let rows: [&[(&str, &str)]; 3] =
        [&[("A", "the truck")], &[("A", "the hydrant")], &[("A", "the red bench")]];
    holds(&astray("remove A", &frames, &rows));
}

#[test]
fn things_are_moved_in_many_ways() {
    let frames = [
        "A should be B",
        "A belongs B",
        "A would look better B",
        "I want A B",
        "I'd like A to be B",
        "A should be moved B",
        "A needs to be B",
        "A has to stand B",
        "A is in the wrong spot, it belongs B",
        "A would be better off B",
        "make sure A is B",
        "could A stand B?",
        "would you mind moving A B?",
        "B is where A should be",
        "A, put it B",
        "A doesn't look good there, move it B",
    ];
    let mut rows: Vec<Vec<(&str, &str)>> = Vec::new();
    for thing in ["the statue", "Gus", "the red bench"] {
        for place in ["next to the fountain", "behind the kiosk", "in front of the clinic"] {
            rows.push(vec![("A", thing), ("B", place)]);
        }
    }
    let rows: Vec<&[(&str, &str)]> = rows.iter().map(Vec::as_slice).collect();
    holds(&astray("move A B", &frames, &rows));
}

#[test]
fn sizes_are_asked_for_in_many_ways() {
    let frames = [
        "A should be D",
        "I want A D",
        "could A be D?",
        "A needs to be D",
        "A would look better D",
        "would you mind making A D?",
        "what if A were D?",
        "A is not right yet, make it D",
        "please to make A D",
        "let A be D",
    ];
    let mut rows: Vec<Vec<(&str, &str)>> = Vec::new();
    for thing in ["the statue", "the hydrant"] {
        for size in ["twice as big", "half its size", "three times as tall", "one and a half times as large"]
        {
            rows.push(vec![("A", thing), ("D", size)]);
        }
    }
    let rows: Vec<&[(&str, &str)]> = rows.iter().map(Vec::as_slice).collect();
    holds(&astray("make A D", &frames, &rows));
}

#[test]
fn what_was_said_before_need_not_be_said_again() {
    let city = City::read("campus");
    let mut faults = Vec::new();
    for (short, long) in [
        (
            "add a bench next to the fountain, and one behind the kiosk",
            "add a bench next to the fountain and a bench behind the kiosk",
        ),
        (
            "put a bench next to the fountain. Another behind the kiosk.",
            "add a bench next to the fountain and a bench behind the kiosk",
        ),
        (
            "a bench by the fountain, the same behind the kiosk",
            "add a bench by the fountain and a bench behind the kiosk",
        ),
        (
            "benches: one by the fountain, one behind the kiosk",
            "add a bench by the fountain and a bench behind the kiosk",
        ),
        ("paint the truck red and the hydrant too", "paint the truck red and paint the hydrant red"),
        ("paint the truck red, same for the hydrant", "paint the truck red and paint the hydrant red"),
        ("paint the truck red. Do the same to the hydrant.", "paint the truck red and paint the hydrant red"),
        ("paint the truck red and the hydrant blue", "paint the truck red and paint the hydrant blue"),
        (
            "move the statue next to the fountain and Gus behind the kiosk",
            "move the statue next to the fountain and move Gus behind the kiosk",
        ),
        (
            "remove the black car, paint the white one pink",
            "remove the black car and paint the white car pink",
        ),
        ("swap the red bench with the blue one", "swap the red bench with the blue bench"),
        ("the truck should be red, the hydrant too", "paint the truck red and paint the hydrant red"),
    ] {
        let (meant, got) = (edits_of(&city, long), edits_of(&city, short));
        if meant.is_err() || got != meant {
            faults.push(format!("{short}\n    meant {meant:?}\n    got   {got:?}"));
        }
    }
    holds(&faults);
}

/// A wrong edit is worse than none.
#[test]
fn what_is_no_request_changes_nothing() {
    let city = City::read("campus");
    let mut faults = Vec::new();
    for words in [
        "don't remove the hydrant",
        "do not paint the truck blue",
        "never remove the hydrant",
        "I removed the hydrant yesterday",
        "did you remove the hydrant?",
        "the hydrant was removed",
        "I wonder whether the hydrant is red",
        "if the truck is blue, remove it",
        "remove the hydrant unless it is a hydrant",
        "paint the hydrant blue but only if you must frobnicate it",
        "put a bench next to the fountain, statue and hydrant",
        "put a bench next to the castle",
        "a bench by the fountain and a frobnicator by the kiosk",
        "paint the truck red and frobnicate the hydrant",
        "remove the hydrant, except on Sundays",
        "put a bench next to the fountain for each student",
        "the truck is orange",
        "the hydrant stands by the kiosk",
        "there is a bench next to the fountain",
        "truck 5 metres north please",
        "put a tree half as tall as lime next to the kiosk",
        "remove the bench by the fountain by the castle",
        "move the statue next to the fountain, but not before noon",
    ] {
        let mut world = city.world.clone();
        let mut editor = SceneEditor::new(Seed(7)).looking_as(city.me, &world);
        let said = editor.say(words, &mut world);
        if !Difference::between(&city.world, &world).is_empty() {
            faults.push(format!("{words}\n    did {:?}", said.map(|done| done.edits)));
        }
    }
    holds(&faults);
}

#[test]
fn what_several_things_share_is_read_for_each() {
    let plain = "put a bench next to the statue and a bench next to the fountain";
    let frames = [
        "put a bench next to both the statue and the fountain",
        "put a bench next to each of the statue and the fountain",
        "put benches next to the statue and the fountain",
    ];
    holds(&astray(plain, &frames, &[&[]]));
    let frames =
        ["put between the bin and the hydrant a chair", "between the bin and the hydrant, set a chair"];
    holds(&astray("put a chair between the bin and the hydrant", &frames, &[&[]]));
    let frames = ["everything red should be blue", "paint all the red things blue"];
    holds(&astray("paint everything red blue", &frames, &[&[]]));
}

#[test]
fn questions_denials_and_conditions_that_do_not_hold_change_nothing() {
    let city = City::read("quarter");
    let said = [
        "is Mill Lane closed?",
        "which streets are closed?",
        "is it raining?",
        "will it rain?",
        "is there a cinema?",
        "do we have a cinema?",
        "is the postbox red?",
        "how tall is the statue?",
        "don't move the statue",
        "leave the red bench alone",
        "if there's a cinema, put a bench in front of it and paint it red",
        "if it rains, put an umbrella next to Ada",
        "close Elm Street if Oak Street is closed",
        "Ada wants to sit down",
        "for more light",
        "remove the cone as soon as there is a dragon",
    ];
    for words in said {
        let mut world = city.world.clone();
        let mut editor = SceneEditor::new(Seed(7)).looking_as(city.me, &world);
        let answer = editor.say(words, &mut world);
        assert!(Difference::between(&city.world, &world).is_empty(), "{words}: {answer:?}");
    }
}

/// A city, what is said with a second thought, and the plain order of it.
#[rustfmt::skip]
const SECOND_THOUGHTS: &[(&str, &str, &str)] = &[
    ("campus", "put a bench by the fountain, a red one", "put a red bench by the fountain"),
    ("campus", "put a bench near the Kiosk, and make it a blue one", "put a blue bench near the Kiosk"),
    ("campus", "two chairs near the statue, white ones please", "two white chairs near the statue"),
    ("campus", "I need four bollards more, close to the Campus Clinic", "put four bollards close to the Campus Clinic"),
    ("campus", "put a bin next to the statue, or no, next to the hedge", "put a bin next to the hedge"),
    ("campus", "paint the white car red, sorry, I meant the black one", "paint the black car red"),
    ("campus", "paint all the cars blue, not the green one", "paint all the cars blue except the green one"),
    ("campus", "benches: turn the red one around and paint the blue one white", "turn the red bench around and paint the blue bench white"),
    ("campus", "about the cars, remove the green one and paint the black one red", "remove the green car and paint the black car red"),
    ("campus", "the cars: the white one has to go", "remove the white car"),
    ("campus", "a dog for Fay, and one for Gus", "put a dog next to Fay and a dog next to Gus"),
    ("campus", "next to the Kiosk, two parking meters and a bench", "put two parking meters next to the Kiosk and a bench next to the Kiosk"),
    ("campus", "it is so hot, Fay needs a parasol", "put a parasol next to Fay"),
    ("campus", "would it be a lot of work to put a tree behind Blue Spoon?", "put a tree behind Blue Spoon"),
    ("campus", "Hana, face the statue", "turn Hana towards the statue"),
    ("campus", "rename the dog, he is Rex from now on", "rename the dog Rex"),
    ("campus", "I don't like the colour of the red bench, make it green", "paint the red bench green"),
    ("campus", "there are no bins near North Tower. Could you add two?", "put two bins near North Tower"),
    ("oldtown", "chairs: paint the two white ones green and throw the red one out", "paint the two white chairs green and remove the red chair"),
    ("oldtown", "the bus stop has no bin", "put a bin next to the bus stop"),
    ("oldtown", "the red chair stays, the white ones go", "remove the white chairs"),
    ("oldtown", "the yellow taxi and the white van: swap them", "swap the yellow taxi and the white van"),
    ("oldtown", "the van is parked the wrong way round, turn it", "turn the van around"),
];

/// What comes to mind a moment later belongs to what was asked, and makes nothing more.
#[test]
fn afterthoughts_and_corrections_belong_to_what_was_asked() {
    let mut faults = Vec::new();
    for (name, said, plain) in SECOND_THOUGHTS {
        let city = City::read(name);
        let (meant, got) = (edits_of(&city, plain), edits_of(&city, said));
        if meant.is_err() || got != meant {
            faults.push(format!("{said}\n    meant {meant:?}\n    got   {got:?}"));
        }
    }
    holds(&faults);
}
