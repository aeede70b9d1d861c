//! A scene as a model answers it.

use serde_json::{Value, json};
use simworld_core::environment::Environment;
use simworld_core::spec::{FeatureWish, SceneSpec};

use super::super::schema::check;
use super::super::unsayable::Unsayable;
use super::shape::{AMOUNTS, HEIGHTS, KINDS, NOTHING, PATTERNS, WATERS, WIDTHS, name_of, schema};
use crate::language::names_of_sky;
use crate::scenes::SceneReading;

/// A reading as a model answers it, by the schema of [`ModelSceneReader`](super::ModelSceneReader): to show one by example, to train
/// it, and the proof that it can say what the grammar says. Remarks are no part of it, for they follow from the spec.
///
/// ```
/// use simworld_agents::scenes::{GrammarSceneReader, SceneReader};
/// use simworld_agents::thought::scene_answer;
/// let reading = GrammarSceneReader.read_scene("a town with a cathedral in the north and light rain")?;
/// let answer = scene_answer(&reading)?;
/// assert_eq!(answer["sky"][0], "light rain");
/// assert_eq!(answer["sites"][0]["at"], "north");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// The schema has no words for some of it: more than its bounds, a sky or a landmark that no word of the grammar has.
pub fn scene_answer(reading: &SceneReading) -> Result<Value, Unsayable> {
    let SceneReading { spec, unread, .. } = reading;
    let mut answer = features(&spec.features)?;
    let (sky, minutes) = names_of_sky(Environment::default(), &spec.environment)
        .ok_or_else(|| Unsayable::new("such a sun or weather"))?;
    let streets = &spec.streets;
    let kind = named(name_of(&KINDS, spec.kind), "such a kind of place")?;
    let rest = json!({
        "cannot": "",
        "kind": kind,
        "title": spec.title.as_deref().unwrap_or_default(),
        "streets": streets.count.unwrap_or(0),
        "pattern": named(name_of(&PATTERNS, streets.pattern), "such a pattern")?,
        "width": named(name_of(&WIDTHS, streets.width), "such a width")?,
        "trees": named(name_of(&AMOUNTS, streets.trees), "so many trees")?,
        "parked": named(name_of(&AMOUNTS, streets.parked), "so many cars")?,
        "buildings": spec.buildings.count.unwrap_or(0),
        "height": named(name_of(&HEIGHTS, spec.buildings.height), "such a height")?,
        "sky": sky,
        "minutes": minutes,
        "unread": unread,
    });
    if let (Some(answer), Value::Object(rest)) = (answer.as_object_mut(), rest) {
        answer.extend(rest);
    }
    check(&answer, &schema()).map_err(|mismatch| Unsayable::new(format!("that: {mismatch}")))?;
    // What the schema takes for one line may be several.
    if has_odd_blanks(spec) {
        return Err(Unsayable::new("names with other blanks than one between words"));
    }
    Ok(answer)
}

fn features(features: &FeatureWish) -> Result<Value, Unsayable> {
    let FeatureWish { places, squares, parks, waters, landmarks, sites, districts } = features;
    let waters = waters.iter().map(|water| named(name_of(&WATERS, *water), "such a water"));
    let waters = waters.collect::<Result<Vec<_>, _>>()?;
    let places = places.iter().map(|(place, count)| json!({ "use": place.as_str(), "count": count }));
    // None of a landmark is as if nobody had named it.
    let landmarks = landmarks.iter().filter(|(_, count)| **count > 0);
    let landmarks = landmarks.map(|(name, count)| json!({ "name": name, "count": count }));
    let sites =
        sites.iter().map(|site| json!({ "what": site.what, "at": site.at.as_str(), "by": site.by.as_deref().unwrap_or(NOTHING) }));
    let districts = districts.iter().map(|district| {
        json!({ "kind": district.kind.as_str(), "at": district.at.as_str(), "by": district.by.as_deref().unwrap_or(NOTHING) })
    });
    Ok(json!({
        "places": places.collect::<Vec<_>>(),
        "landmarks": landmarks.collect::<Vec<_>>(),
        "squares": squares,
        "parks": parks,
        "waters": waters,
        "sites": sites.collect::<Vec<_>>(),
        "districts": districts.collect::<Vec<_>>(),
    }))
}

fn named(name: Option<&'static str>, what: &str) -> Result<&'static str, Unsayable> {
    name.ok_or_else(|| Unsayable::new(what))
}

fn has_odd_blanks(spec: &SceneSpec) -> bool {
    let names = spec.title.iter().chain(&spec.features.squares).chain(&spec.features.parks);
    let mut names = names.chain(spec.features.sites.iter().map(|site| &site.what));
    names.any(|name| name.is_empty() || super::super::prompts::one_line(name) != *name)
}
