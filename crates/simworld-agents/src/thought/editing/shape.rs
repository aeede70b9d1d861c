//! The schema of an answer: edits over the ids, assets and streets that were recalled, and nothing else.

use serde_json::{Map, Value};
use simworld_core::asset::Season;

use super::super::schema::{any_of, defined, integer, list, object, one_of, words};
use super::Recalled;
use super::bearings::{compass, own_sides};
use crate::language::{named_colors, sky_names};

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
/// The colour that something has, or its asset.
pub(super) const AS_IT_IS: &str = "as_it_is";
/// The most edits of an answer.
pub(super) const MOST_EDITS: usize = 12;
/// The most places that hold together.
const PLACES: usize = 6;
/// The most new things of an edit, as many as an editor makes at once.
const MOST_MADE: i64 = 1000;
/// The farthest that a point may be, cm: 100 km.
const FAR: i64 = 10_000_000;
/// The farthest that something may be from another, cm.
const REACH: i64 = 100_000;
/// The names of the definitions: what may be changed, what something may stand to, a street or a piece of one, a place.
const THING: &str = "thing";
const ANCHOR: &str = "anchor";
const STREET: &str = "street";
const PLACE: &str = "place";

/// The schema of at most so many edits.
pub(super) fn schema(known: &Recalled, most: usize) -> Value {
    let edits = any_of(branches(known));
    let mut schema = object([("cannot", words(200)), ("edits", list(&edits, 0, most))]);
    schema["$defs"] = definitions(known).into();
    schema
}

/// What many edits have in common.
fn definitions(known: &Recalled) -> Map<String, Value> {
    let mut all = Map::new();
    let mut define = |name: &str, schema| all.insert(name.to_owned(), schema);
    define(PLACE, place(known));
    if known.subjects().next().is_some() {
        define(THING, one_of(known.subjects()));
    }
    if known.anchors().next().is_some() {
        define(ANCHOR, one_of(known.anchors()));
    }
    if !known.streets.is_empty() {
        define(STREET, one_of(known.streets.keys().cloned()));
    }
    all
}

fn act(name: &str) -> Value {
    one_of([name])
}

/// Every kind of edit that is possible with what there is.
fn branches(known: &Recalled) -> Vec<Value> {
    let sky = list(&one_of(sky_names()), 0, 6);
    let mut all = vec![
        object([("do", act("weather")), ("sky", sky), ("minutes", integer(-1, 1439))]),
        object([("do", act("tell")), ("words", words(1000))]),
    ];
    let places = list(&defined(PLACE), 0, PLACES);
    if !known.assets.is_empty() {
        let add =
            [("do", act("add")), ("count", integer(1, MOST_MADE)), ("places", places.clone())].into_iter();
        all.push(object(add.chain(make(known))));
        if let Some(line) = line(known) {
            // Either so many, or one every so many centimetres; zero says that the other counts.
            let every = [("count", integer(0, MOST_MADE)), ("every", integer(0, REACH))];
            all.push(object(
                [("do", act("row")), ("line", line)].into_iter().chain(every).chain(make(known)),
            ));
        }
    }
    if !known.streets.is_empty() {
        all.push(object([("do", act("close_streets")), ("streets", streets(known))]));
        all.push(object([("do", act("open_streets")), ("streets", streets(known))]));
    }
    if known.subjects().next().is_some() {
        all.extend(of_things(known, &places));
    }
    all
}

/// What is made: of which asset, in which colour and size, and what it is called.
fn make(known: &Recalled) -> impl Iterator<Item = (&'static str, Value)> {
    let seasons = Season::ALL.map(Season::as_str);
    let colors = std::iter::once(AS_IT_IS).chain(named_colors().map(|(name, _)| name)).chain(seasons);
    let of = [("asset", one_of(known.assets.clone())), ("color", one_of(colors)), ("name", words(100))];
    of.into_iter().chain(size())
}

/// Either a percentage or a height, cm; zero says that the other counts.
fn size() -> [(&'static str, Value); 2] {
    [("percent", integer(0, 2000)), ("height", integer(0, REACH))]
}

fn streets(known: &Recalled) -> Value {
    let most = known.streets.len().clamp(1, 64);
    list(&defined(STREET), 1, most)
}

/// Edits of what is there.
fn of_things(known: &Recalled, places: &Value) -> Vec<Value> {
    let (thing, anchor) = (defined(THING), defined(ANCHOR));
    let most = known.subjects().count();
    let things = list(&thing, 1, most);
    let colors = one_of(named_colors().map(|(name, _)| name));
    let scaled = [("do", act("scale")), ("things", things.clone())].into_iter().chain(size());
    vec![
        object([("do", act("remove")), ("things", things.clone())]),
        object([("do", act("move")), ("things", things.clone()), ("places", places.clone())]),
        object([("do", act("rotate")), ("things", things.clone()), ("degrees", integer(-3600, 3600))]),
        object([("do", act("face")), ("things", things.clone()), ("towards", anchor.clone())]),
        object([("do", act("face_compass")), ("things", things.clone()), ("side", one_of(compass()))]),
        object([("do", act("swap")), ("one", thing.clone()), ("other", thing.clone())]),
        object([("do", act("paint")), ("things", things.clone()), ("color", colors)]),
        object([("do", act("paint_like")), ("things", things), ("like", anchor)]),
        object(scaled),
        object([
            ("do", act("copy")),
            ("thing", thing.clone()),
            ("count", integer(1, MOST_MADE)),
            ("places", places.clone()),
        ]),
        object([("do", act("name")), ("thing", thing.clone()), ("name", words(100))]),
        object([("do", act("list")), ("things", list(&thing, 0, most))]),
        object([("do", act("count")), ("what", words(200)), ("things", list(&thing, 0, most))]),
        object([("do", act("describe")), ("thing", thing)]),
    ]
}

/// A place: one branch for each way to name one.
fn place(known: &Recalled) -> Value {
    let point = || [("east", integer(-FAR, FAR)), ("north", integer(-FAR, FAR))].into_iter();
    let mut all = vec![
        object([("is", act("here"))]),
        object([("is", act("at"))].into_iter().chain(point())),
        object([("is", act("around"))].into_iter().chain(point())),
    ];
    if known.anchors().next().is_some() {
        all.extend(beside_things());
    }
    if !known.streets.is_empty() {
        let ends = ("side", one_of(compass()));
        all.push(object([("is", act("along_street")), ("streets", streets(known))]));
        all.push(object([("is", act("end_of_street")), ("streets", streets(known)), ends]));
        all.push(side_of_street(known));
    }
    if !known.junctions.is_empty() {
        let junction = one_of(known.junctions.keys().cloned());
        all.push(object([("is", act("at_junction")), ("junction", junction)]));
    }
    any_of(all)
}

fn side_of_street(known: &Recalled) -> Value {
    let side = ("side", one_of(compass().chain(["left", "right"])));
    object([("is", act("on_side_of_street")), ("streets", streets(known)), side])
}

/// Places by what stands there.
fn beside_things() -> Vec<Value> {
    let of = || ("of", defined(ANCHOR));
    let far = |name: &'static str| (name, integer(-FAR, FAR));
    let reach = |name: &'static str| (name, integer(0, REACH));
    let to = ("to", defined(ANCHOR));
    vec![
        object([("is", one_of(RELATIONS)), of()]),
        object([("is", act("between")), of(), ("and", defined(ANCHOR))]),
        object([("is", act("offset")), of(), reach("distance"), ("degrees", integer(-180, 180))]),
        object([
            ("is", act("offset_to_side")),
            of(),
            reach("distance"),
            ("side", one_of(compass().chain(own_sides()))),
        ]),
        object([("is", act("on_side_of")), of(), ("side", one_of(compass()))]),
        object([("is", act("apart_from")), of(), reach("least"), reach("most")]),
        object([("is", act("in_place_of")), of()]),
        object([("is", act("shifted")), of(), far("east"), far("north")]),
        object([("is", act("shifted_as_turned")), of(), far("forward"), far("left")]),
        object([("is", act("nearer")), of(), to.clone(), ("distance", integer(-REACH, REACH))]),
        object([("is", act("halfway")), of(), to]),
    ]
}

/// Along what a row stands.
fn line(known: &Recalled) -> Option<Value> {
    let mut all = Vec::new();
    if known.anchors().next().is_some() {
        let thing = defined(ANCHOR);
        all.push(object([("is", one_of(["along", "around"])), ("of", thing.clone())]));
        all.push(object([("is", act("between")), ("of", thing.clone()), ("and", thing)]));
    }
    if !known.streets.is_empty() {
        let along = one_of(["along_street", "both_sides_of_street"]);
        all.push(object([("is", along), ("streets", streets(known))]));
        all.push(side_of_street(known));
    }
    (!all.is_empty()).then(|| any_of(all))
}
