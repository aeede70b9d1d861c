//! What can be wrong with a scene file by itself, before anything is made of it: all of it, not the first alone.

use simworld_core::spec::SceneSpec;

use super::colour::Colour;
use super::error::{Fault, Problems, Where};
use super::facing::Facing;
use super::items::shortened;
use super::rows::{Say, Thing};
use super::scene::SceneFile;
use super::sky::Sky;

/// Things and sentences of a file at the most, all of each row counted.
pub const MOST_THINGS: u64 = 10_000;
/// Sentences of a file at the most.
pub const MOST_SAYS: u64 = 200;
/// Things and streets are so far from the origin at the most, m.
pub const FARTHEST: f64 = 100_000.0;
/// The longest name, and the longest sentence, in characters.
const LONGEST_NAME: usize = 100;
const LONGEST_SENTENCE: usize = 2000;

/// Everything that is wrong with the file as a whole and with its rows one by one; names and streets apart.
pub(super) fn check(scene: &SceneFile) -> Problems {
    let mut problems = Problems::default();
    whole(scene, &mut problems);
    place(scene, &mut problems);
    let things: u64 = scene.things.iter().map(|thing| u64::from(thing.many())).sum();
    for (what, count, most) in
        [("things", things, MOST_THINGS), ("rows of [[say]]", scene.says.len() as u64, MOST_SAYS)]
    {
        if count > most {
            problems.push(scene.place_of(None, ""), Fault::TooMany { what, count, most });
        }
    }
    // Of more rows than are allowed it is not told what else is wrong with each.
    for (row, thing) in scene.things.iter().enumerate().take(MOST_THINGS as usize) {
        for fault in of_thing(thing) {
            problems.push(thing_at(scene, row), fault);
        }
    }
    for (row, say) in scene.says.iter().enumerate().take(MOST_SAYS as usize) {
        for fault in of_say(say) {
            problems.push(say_at(scene, row), fault);
        }
    }
    problems
}

/// Where a row of things is.
fn thing_at(scene: &SceneFile, row: usize) -> Where {
    let thing = &scene.things[row];
    let label = match &thing.name {
        Some(name) => format!("[[thing]] {} ({} {:?})", row + 1, shortened(&thing.asset), shortened(name)),
        None => format!("[[thing]] {} ({})", row + 1, shortened(&thing.asset)),
    };
    scene.place_of(thing.line.0, label)
}

/// Where a sentence is.
pub(super) fn say_at(scene: &SceneFile, row: usize) -> Where {
    scene.place_of(scene.says[row].line.0, format!("[[say]] {}", row + 1))
}

fn whole(scene: &SceneFile, problems: &mut Problems) {
    let at = || scene.place_of(None, "");
    if let Some(fault) = scene.title.as_deref().and_then(|title| text("title", title, LONGEST_NAME)) {
        problems.push(at(), fault);
    }
    let has_streets = !scene.streets.is_empty();
    for (clash, told) in [
        (
            scene.place.is_some() && scene.ground.is_some(),
            "[place] brings its own ground: leave out [place] or [ground]",
        ),
        (
            scene.place.is_some() && has_streets,
            "[place] brings its own streets: leave out [place] or every [[street]]",
        ),
        (
            scene.ground.is_some() && has_streets,
            "[[street]] rows bring ground of their own: leave out [ground]",
        ),
    ] {
        if clash {
            problems.push(at(), Fault::Keys(told));
        }
    }
}

fn place(scene: &SceneFile, problems: &mut Problems) {
    let origin = &scene.origin.0;
    if let Some(Err(error)) = scene.place.as_ref().map(SceneSpec::validate) {
        problems.push(scene.place_of(origin.place, "[place]"), error);
    }
    if let Some(ground) = &scene.ground {
        let allowed = "1 to 20 000 m each way";
        let sides =
            [("ground.size, west to east", ground.size.x), ("ground.size, south to north", ground.size.y)];
        let sides = sides.into_iter().filter_map(|(key, side)| number(key, side, (1.0, 20_000.0), allowed));
        for fault in sides.chain(ground.colour.and_then(colour)) {
            problems.push(scene.place_of(origin.ground, "[ground]"), fault);
        }
    }
    if let Some(Err(fault)) = scene.environment.as_ref().map(Sky::environment) {
        problems.push(scene.place_of(origin.environment, "[environment]"), fault);
    }
}

fn of_thing(thing: &Thing) -> Vec<Fault> {
    let mut faults: Vec<Fault> = Vec::new();
    faults.extend(text("asset", &thing.asset, LONGEST_NAME));
    faults.extend(thing.name.as_deref().and_then(|name| text("name", name, LONGEST_NAME)));
    faults.extend(thing.on.as_deref().and_then(|name| text("on", name, LONGEST_NAME)));
    if let Some(at) = thing.at {
        let aside = (-FARTHEST, FARTHEST);
        faults.extend(number("at, east", at.x, aside, "metres within ±100 000"));
        faults.extend(number("at, north", at.y, aside, "metres within ±100 000"));
        faults.extend(at.z.and_then(|z| number("at, up", z, (-10_000.0, 10_000.0), "metres within ±10 000")));
    }
    if let Some(Facing::Degrees(degrees)) = thing.facing {
        faults.extend(number(
            "facing",
            degrees,
            (-360.0, 360.0),
            "-360 to 360 degrees counter-clockwise from east",
        ));
    }
    faults.extend(thing.colour.and_then(colour));
    faults.extend(thing.scale.and_then(|scale| number("scale", scale, (0.05, 20.0), "0.05 to 20")));
    if let Some(count) = thing.count {
        faults.extend(number("count", f64::from(count), (1.0, 1000.0), "1 to 1000"));
    }
    if let Some(step) = thing.step {
        faults.extend(number("step, east", step.x, (-1000.0, 1000.0), "metres within ±1000"));
        faults.extend(number("step, north", step.y, (-1000.0, 1000.0), "metres within ±1000"));
    }
    faults.extend(together(thing).map(Fault::Keys));
    faults
}

/// What does not go together in a row of things, or is missing.
fn together(thing: &Thing) -> Option<&'static str> {
    match (thing.many() > 1, thing.step.is_some()) {
        (true, false) => Some("count needs step: write step = [x, y], how far it is from one to the next, m"),
        (false, true) => Some("step is for several things: write count, or leave step out"),
        _ if thing.at.is_none() && thing.on.is_none() => {
            Some("it is nowhere: write at = [x, y] in metres, or on = the name of what it stands on")
        }
        _ => None,
    }
}

fn of_say(say: &Say) -> Vec<Fault> {
    let mut faults: Vec<Fault> = text("words", &say.words, LONGEST_SENTENCE).into_iter().collect();
    if let Some(from) = say.from {
        faults.extend(number("from, east", from.x, (-FARTHEST, FARTHEST), "metres within ±100 000"));
        faults.extend(number("from, north", from.y, (-FARTHEST, FARTHEST), "metres within ±100 000"));
    }
    faults
}

/// A number that is out of its range; NaN always is.
pub(super) fn number(
    key: &'static str,
    value: f64,
    (low, high): (f64, f64),
    allowed: &'static str,
) -> Option<Fault> {
    (!(low..=high).contains(&value)).then_some(Fault::Number { key, value, allowed })
}

/// A text that is none.
pub(super) fn text(key: &'static str, value: &str, most: usize) -> Option<Fault> {
    let why = if value.trim().is_empty() {
        "is empty: write it, or leave the key out if it may be"
    } else if value.chars().count() > most {
        "is too long: make it shorter"
    } else if value.chars().any(char::is_control) {
        "has control characters: write plain text on one line"
    } else {
        return None;
    };
    Some(Fault::Text { key, value: shortened(value), why })
}

/// A colour that is none.
fn colour(colour: Colour) -> Option<Fault> {
    let Colour::Linear(channels) = colour else { return None };
    let wrong = channels.into_iter().find(|channel| !(0.0..=1.0).contains(channel))?;
    Some(Fault::Number { key: "colour", value: f64::from(wrong), allowed: "three numbers from 0 to 1" })
}
