//! Conditions in a model's plan: their schema, and what they stand for.

use std::collections::BTreeMap;

use serde_json::Value as Json;
use simworld_core::id::EntityId;
use simworld_core::net::Aspect;
use simworld_core::scene::{EntityKind, Place};
use simworld_core::seam::{Condition, Which};

use super::known::{Known, Use};
use super::schema::{any_of, defined, integer, list, object, one_of, whole};

/// The name of the definition that stands for any condition.
pub(super) const TOP: &str = "check";
/// The name of those that are made of no others.
const PLAIN: &str = "plain_check";
/// How near "near" may be, decimetres.
const NEAREST_FARTHEST: (i64, i64) = (1, 5000);
/// The longest time, tenths of a second: a day.
const LONGEST: i64 = 864_000;
/// The most classes or parts of one condition.
const PARTS: usize = 8;

/// The definitions of conditions on what is known.
pub(super) fn definitions(known: &Known) -> BTreeMap<String, Json> {
    let has = |wanted: Use| known.ids(wanted).next().is_some();
    let named = |name: &str| ("check", one_of([name]));
    let thing = |wanted: Use| defined(wanted.name());
    let within = || ("decimetres", integer(NEAREST_FARTHEST.0, NEAREST_FARTHEST.1));
    let classes =
        EntityKind::ALL.iter().map(|kind| kind.as_str()).chain(Place::ALL.iter().map(|place| place.as_str()));
    let classes = list(&one_of(classes), 1, PARTS);
    let which = if has(Use::Any) { any_of(vec![thing(Use::Any), classes]) } else { classes };
    let which = || ("what", which.clone());

    let mut plain: Vec<Json> = ["seated", "holds_something", "raining", "snowing", "dark"]
        .iter()
        .map(|name| object([named(name)]))
        .collect();
    plain.push(object([named("elapsed"), ("tenths", integer(1, LONGEST))]));
    plain.push(object([named("sees"), which()]));
    plain.push(object([named("near"), which(), within()]));
    plain.push(object([named("free_near"), which(), within()]));
    if has(Use::Any) {
        plain.push(object([named("in_use"), ("what", thing(Use::Any))]));
        let two = [("one", thing(Use::Any)), ("other", thing(Use::Any))];
        plain.push(object([named("together")].into_iter().chain(two).chain([within()])));
    }
    if has(Use::Item) {
        plain.push(object([named("holds"), ("what", thing(Use::Item))]));
    }
    if has(Use::Door) {
        plain.push(object([named("open"), ("what", thing(Use::Door))]));
    }
    if has(Use::Light) {
        let shows = one_of(["red", "yellow", "green"]);
        plain.push(object([named("light"), ("what", thing(Use::Light)), ("shows", shows)]));
    }
    let parts = || list(&defined(PLAIN), 1, PARTS);
    let top = vec![
        object([named("not"), ("part", defined(PLAIN))]),
        object([named("all"), ("parts", parts())]),
        object([named("any"), ("parts", parts())]),
    ];
    let tops = plain.iter().cloned().chain(top).collect();
    BTreeMap::from([(PLAIN.to_owned(), any_of(plain)), (TOP.to_owned(), any_of(tops))])
}

/// The condition of an answer that conforms.
pub(super) fn read(given: &Json, known: &Known) -> Result<Condition, String> {
    let tenths = |name: &str| whole(&given[name]).map(|tenths| tenths as f64 / 10.0).ok_or(unread(name));
    let named = |name: &'static str| thing(&given[name], known).ok_or(unread(name));
    let thing = || named("what");
    let which = || which(&given["what"], known);
    let parts = || {
        let parts = given["parts"].as_array().ok_or(unread("parts"))?;
        parts.iter().map(|part| read(part, known)).collect::<Result<Vec<_>, String>>()
    };
    Ok(match given["check"].as_str().unwrap_or_default() {
        "seated" => Condition::Seated,
        "holds_something" => Condition::Holds(None),
        "raining" => Condition::Raining,
        "snowing" => Condition::Snowing,
        "dark" => Condition::Dark,
        "elapsed" => Condition::Elapsed(tenths("tenths")?),
        "sees" => Condition::Sees(which()?),
        "near" => Condition::Near { what: which()?, within: tenths("decimetres")? },
        "free_near" => Condition::FreeNear { what: which()?, within: tenths("decimetres")? },
        "in_use" => Condition::InUse(thing()?),
        "together" => {
            Condition::Together { one: named("one")?, other: named("other")?, within: tenths("decimetres")? }
        }
        "holds" => Condition::Holds(Some(thing()?)),
        "open" => Condition::Open(thing()?),
        "light" => {
            let shows = match given["shows"].as_str() {
                Some("red") => Aspect::Red,
                Some("yellow") => Aspect::Yellow,
                Some("green") => Aspect::Green,
                _ => return Err(unread("shows")),
            };
            Condition::Signal { light: thing()?, shows }
        }
        "not" => Condition::Not(Box::new(read(&given["part"], known)?)),
        "all" => Condition::All(parts()?),
        "any" => Condition::Any(parts()?),
        _ => return Err(unread("check")),
    })
}

fn unread(name: &str) -> String {
    format!("{name} cannot be read")
}

fn thing(given: &Json, known: &Known) -> Option<EntityId> {
    given.as_str().and_then(|written| known.find(written)).map(|thing| thing.id)
}

/// A thing, or any of some classes, of which one at most is a use.
fn which(given: &Json, known: &Known) -> Result<Which, String> {
    let Some(classes) = given.as_array() else {
        return thing(given, known).map(Which::Entity).ok_or(unread("what"));
    };
    let (mut kinds, mut place) = (Vec::new(), None);
    for class in classes {
        let name = class.as_str().unwrap_or_default();
        match (EntityKind::from_name(name), Place::from_name(name)) {
            (Some(kind), _) => kinds.push(kind),
            (None, Some(used)) if place.is_none() => place = Some(used),
            (None, Some(_)) => return Err("what names two uses of places: name one".to_owned()),
            (None, None) => return Err(unread("what")),
        }
    }
    Ok(Which::Any { kinds, place })
}
