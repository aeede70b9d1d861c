//! The schema of an answer: edits over the ids, assets and streets that were recalled, and nothing else.

use serde_json::Value;

use super::super::schema::{any_of, integer, list, object, one_of, words};
use super::Recalled;
use crate::language::named_colors;

/// Relations that one thing stands in to another.
pub(super) const RELATIONS: [&str; 15] = [
    "next_to",
    "near",
    "far_from",
    "in_front_of",
    "behind",
    "left_of",
    "right_of",
    "on_top_of",
    "inside",
    "along",
    "at_corner_of",
    "across_from",
    "on_block_of",
    "in_middle_of",
    "at_edge_of",
];
/// What sky may be asked for.
pub(super) const SKIES: [&str; 9] =
    ["as_it_is", "clear", "cloudy", "light_rain", "rain", "heavy_rain", "snow", "fog", "thick_fog"];
/// The farthest that a point may be, cm: 100 km.
const FAR: i64 = 10_000_000;

pub(super) fn schema(known: &Recalled) -> Value {
    let edits = any_of(branches(known));
    object([("cannot", words(200)), ("edits", list(&edits, 0, 6))])
}

fn act(name: &str) -> Value {
    one_of([name])
}

/// Every kind of edit that is possible with what there is.
fn branches(known: &Recalled) -> Vec<Value> {
    let mut all =
        vec![object([("do", act("weather")), ("sky", one_of(SKIES)), ("minutes", integer(-1, 1439))])];
    let places = list(&place(known), 0, 3);
    if !known.assets.is_empty() {
        let colors: Vec<&str> =
            std::iter::once("as_it_is").chain(named_colors().map(|(name, _)| name)).collect();
        let make = |name| {
            [("do", act(name)), ("asset", one_of(known.assets.clone())), ("color", one_of(colors.clone()))]
        };
        let [a, b, c] = make("add");
        all.push(object([
            a,
            b,
            c,
            ("count", integer(1, 50)),
            ("percent", integer(20, 400)),
            ("places", places.clone()),
        ]));
        if let Some(line) = line(known) {
            let [a, b, c] = make("row");
            // Either so many, or one every so many centimetres; zero says that the other counts.
            all.push(object([
                a,
                b,
                c,
                ("line", line),
                ("count", integer(0, 200)),
                ("every", integer(0, 50_000)),
            ]));
        }
    }
    if !known.streets.is_empty() {
        let streets = list(&one_of(known.streets.keys().cloned()), 1, 4);
        all.push(object([("do", act("close_streets")), ("streets", streets.clone())]));
        all.push(object([("do", act("open_streets")), ("streets", streets)]));
    }
    if !known.things.is_empty() {
        all.extend(of_things(known, &places));
    }
    all
}

fn id(known: &Recalled) -> Value {
    one_of(known.things.iter().map(|(id, _)| id.clone()))
}

/// Edits of what is there.
fn of_things(known: &Recalled, places: &Value) -> Vec<Value> {
    let (thing, things) = (id(known), list(&id(known), 1, 30));
    let colors = one_of(named_colors().map(|(name, _)| name));
    vec![
        object([("do", act("remove")), ("things", things.clone())]),
        object([("do", act("move")), ("things", things.clone()), ("places", list(&place(known), 1, 3))]),
        object([("do", act("rotate")), ("things", things.clone()), ("degrees", integer(-180, 180))]),
        object([("do", act("face")), ("things", things.clone()), ("towards", thing.clone())]),
        object([("do", act("swap")), ("one", thing.clone()), ("other", thing.clone())]),
        object([("do", act("paint")), ("things", things.clone()), ("color", colors)]),
        object([("do", act("scale")), ("things", things.clone()), ("percent", integer(5, 2000))]),
        object([
            ("do", act("copy")),
            ("thing", thing.clone()),
            ("count", integer(1, 50)),
            ("places", places.clone()),
        ]),
        object([("do", act("name")), ("thing", thing.clone()), ("name", words(60))]),
        object([("do", act("list")), ("things", things.clone())]),
        object([("do", act("count")), ("things", list(&id(known), 0, 60))]),
        object([("do", act("describe")), ("thing", thing)]),
    ]
}

/// A place: one branch for each way to name one.
fn place(known: &Recalled) -> Value {
    let mut all = vec![
        object([("is", act("here"))]),
        object([("is", act("at")), ("east", integer(-FAR, FAR)), ("north", integer(-FAR, FAR))]),
    ];
    if !known.things.is_empty() {
        let thing = id(known);
        all.push(object([("is", one_of(RELATIONS)), ("of", thing.clone())]));
        all.push(object([("is", act("between")), ("of", thing.clone()), ("and", thing.clone())]));
        let offset = [("of", thing), ("distance", integer(1, 50_000)), ("degrees", integer(-180, 180))];
        all.push(object([("is", act("offset"))].into_iter().chain(offset)));
    }
    if !known.streets.is_empty() {
        let street = one_of(known.streets.keys().cloned());
        all.push(object([("is", act("along_street")), ("street", street)]));
    }
    any_of(all)
}

/// Along what a row stands.
fn line(known: &Recalled) -> Option<Value> {
    let mut all = Vec::new();
    if !known.things.is_empty() {
        let thing = id(known);
        all.push(object([("is", one_of(["along", "around"])), ("of", thing.clone())]));
        all.push(object([("is", act("between")), ("of", thing.clone()), ("and", thing)]));
    }
    if !known.streets.is_empty() {
        let street = one_of(known.streets.keys().cloned());
        all.push(object([("is", one_of(["along_street", "both_sides_of_street"])), ("street", street)]));
    }
    (!all.is_empty()).then(|| any_of(all))
}
