//! An answer to a spec. It conforms to the schema already; what is wrong beyond that is said to the model.

use serde_json::Value;
use simworld_core::environment::Environment;
use simworld_core::scene::Place;
use simworld_core::spec::{
    BuildingWish, DistrictKind, DistrictWish, FeatureWish, SceneSpec, SiteWish, StreetWish, Whereabouts,
};

use super::super::prompts::one_line;
use super::super::schema::whole;
use super::shape::{AMOUNTS, HEIGHTS, KINDS, PATTERNS, WATERS, WIDTHS};
use crate::language::sky_by_names;
use crate::scenes::{SceneError, SceneReading, suited};

/// The spec, or the model's word that none is asked for; a fault is worth another try.
pub(super) fn understood(answer: &Value, said: &str) -> Result<Result<SceneReading, SceneError>, String> {
    let cannot = answer["cannot"].as_str().unwrap_or_default().trim();
    if !cannot.is_empty() {
        return Ok(Err(SceneError::Nothing { words: said.to_owned(), hint: cannot.to_owned() }));
    }
    let skies = items(answer, "sky").iter().filter_map(Value::as_str);
    let mut spec = SceneSpec {
        kind: pick(&KINDS, answer, "kind"),
        title: text(answer, "title"),
        streets: StreetWish {
            count: count(answer, "streets").map(|count| count.max(2)),
            pattern: pick(&PATTERNS, answer, "pattern"),
            width: pick(&WIDTHS, answer, "width"),
            trees: pick(&AMOUNTS, answer, "trees"),
            parked: pick(&AMOUNTS, answer, "parked"),
        },
        buildings: BuildingWish {
            count: count(answer, "buildings"),
            height: pick(&HEIGHTS, answer, "height"),
        },
        features: features(answer),
        environment: sky_by_names(Environment::default(), skies, number(answer, "minutes")),
        ..SceneSpec::default()
    };
    spec.validate().map_err(|error| error.to_string())?;
    let remarks = suited(&mut spec);
    Ok(Ok(SceneReading { spec, unread: texts(answer, "unread"), remarks }))
}

fn features(answer: &Value) -> FeatureWish {
    let mut features = FeatureWish::default();
    for place in items(answer, "places") {
        let used_as = place["use"].as_str().and_then(Place::from_name);
        features.places.extend(used_as.map(|used_as| (used_as, number(place, "count").max(0) as u32)));
    }
    for landmark in items(answer, "landmarks") {
        if let (Some(name), Some(more)) = (text(landmark, "name"), count(landmark, "count")) {
            *features.landmarks.entry(name).or_insert(0) += more;
        }
    }
    features.squares = texts(answer, "squares");
    features.parks = texts(answer, "parks");
    for water in items(answer, "waters").iter().filter_map(Value::as_str) {
        let known = WATERS.iter().find(|(name, _)| *name == water).map(|(_, water)| *water);
        features.waters.extend(known.filter(|water| !features.waters.contains(water)));
    }
    features.sites = items(answer, "sites").iter().filter_map(site).collect();
    features.districts = items(answer, "districts").iter().filter_map(district).collect();
    features
}

fn site(site: &Value) -> Option<SiteWish> {
    Some(SiteWish { what: text(site, "what")?, at: whereabouts(site), by: text(site, "by") })
}

fn district(district: &Value) -> Option<DistrictWish> {
    let kind = district["kind"].as_str().and_then(DistrictKind::from_name)?;
    Some(DistrictWish { kind, at: whereabouts(district), by: text(district, "by") })
}

fn whereabouts(of: &Value) -> Whereabouts {
    of["at"].as_str().and_then(Whereabouts::from_name).unwrap_or_default()
}

fn items<'a>(of: &'a Value, field: &str) -> &'a [Value] {
    of[field].as_array().map(Vec::as_slice).unwrap_or_default()
}

/// A text in one line, if it says something.
fn text(of: &Value, field: &str) -> Option<String> {
    of[field].as_str().map(one_line).filter(|text| !text.is_empty())
}

fn texts(of: &Value, field: &str) -> Vec<String> {
    let texts = items(of, field).iter().filter_map(Value::as_str);
    texts.map(one_line).filter(|text| !text.is_empty()).collect()
}

fn pick<T: Copy + Default>(table: &[(&'static str, T)], answer: &Value, field: &str) -> T {
    let said = answer[field].as_str().unwrap_or_default();
    table.iter().find(|(name, _)| *name == said).map_or_else(T::default, |(_, value)| *value)
}

fn number(answer: &Value, field: &str) -> i64 {
    whole(&answer[field]).unwrap_or_default()
}

/// A number above zero, which says that none was asked for.
fn count(answer: &Value, field: &str) -> Option<u32> {
    u32::try_from(number(answer, field)).ok().filter(|count| *count > 0)
}
