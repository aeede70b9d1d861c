//! The schema of a scene: every field of the spec, with the names of its values.

use serde_json::Value;
use simworld_core::scene::Place;
use simworld_core::spec::{Amount, DistrictKind, Height, Pattern, SceneKind, Water, Whereabouts, Width};

use super::super::schema::{integer, list, object, one_of, words};
use crate::language::scenes::landmark_names;
use crate::language::sky_names;

pub(super) const KINDS: [(&str, SceneKind); 4] = [
    ("city", SceneKind::City),
    ("countryside", SceneKind::Countryside),
    ("wilderness", SceneKind::Wilderness),
    ("island", SceneKind::Island),
];
pub(super) const PATTERNS: [(&str, Pattern); 4] = [
    ("mixed", Pattern::Mixed),
    ("grid", Pattern::Grid),
    ("winding", Pattern::Winding),
    ("suburb", Pattern::Suburb),
];
pub(super) const WIDTHS: [(&str, Width); 3] =
    [("narrow", Width::Narrow), ("usual", Width::Usual), ("wide", Width::Wide)];
pub(super) const AMOUNTS: [(&str, Amount); 4] =
    [("none", Amount::None), ("few", Amount::Few), ("usual", Amount::Usual), ("many", Amount::Many)];
pub(super) const HEIGHTS: [(&str, Height); 3] =
    [("low", Height::Low), ("usual", Height::Usual), ("high", Height::High)];
pub(super) const WATERS: [(&str, Water); 3] =
    [("harbour", Water::Harbour), ("river", Water::River), ("lake", Water::Lake)];
/// What a site or a district says of what it is not beside.
pub(super) const NOTHING: &str = "";

/// A name of a table.
pub(super) fn name_of<T: Copy + PartialEq>(table: &[(&'static str, T)], value: T) -> Option<&'static str> {
    table.iter().find(|(_, own)| *own == value).map(|(name, _)| *name)
}

fn names<T>(table: &[(&'static str, T)]) -> Value {
    one_of(table.iter().map(|(name, _)| *name))
}

pub(super) fn schema() -> Value {
    let uses = || Place::ALL.iter().map(|place| place.as_str());
    let place = object([("use", one_of(uses())), ("count", integer(0, 100))]);
    let landmark = object([("name", one_of(landmark_names())), ("count", integer(1, 8))]);
    let waters = || WATERS.iter().map(|(name, _)| *name);
    let at = one_of(Whereabouts::ALL.map(Whereabouts::as_str));
    let beside = std::iter::once(NOTHING)
        .chain(uses())
        .chain(landmark_names())
        .chain(waters())
        .chain(["square", "park"]);
    let site = object([("what", words(60)), ("at", at.clone()), ("by", one_of(beside))]);
    let kind = one_of(DistrictKind::ALL.map(DistrictKind::as_str));
    let along = one_of(std::iter::once(NOTHING).chain(waters()));
    object([
        ("cannot", words(200)),
        ("kind", names(&KINDS)),
        ("title", words(60)),
        ("streets", integer(0, 20_000)),
        ("pattern", names(&PATTERNS)),
        ("width", names(&WIDTHS)),
        ("trees", names(&AMOUNTS)),
        ("parked", names(&AMOUNTS)),
        ("buildings", integer(0, 20_000)),
        ("height", names(&HEIGHTS)),
        ("places", list(&place, 0, Place::ALL.len())),
        ("landmarks", list(&landmark, 0, 16)),
        ("squares", list(&words(60), 0, 16)),
        ("parks", list(&words(60), 0, 16)),
        ("waters", list(&names(&WATERS), 0, 4)),
        ("sites", list(&site, 0, 16)),
        ("districts", list(&object([("kind", kind), ("at", at), ("by", along)]), 0, 9)),
        ("sky", list(&one_of(sky_names()), 0, 6)),
        ("minutes", integer(-1, 1439)),
        ("unread", list(&words(60), 0, 40)),
    ])
}
