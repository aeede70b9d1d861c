//! Whole scenes read by a model: the spec's own fields as a schema, bounded and checked like those of the grammar.

use std::sync::Arc;

use serde_json::Value;
use simworld_core::environment::{Environment, Sun};
use simworld_core::scene::Place;
use simworld_core::spec::{Amount, Height, Pattern, SceneKind, SceneSpec, Water, Width};

use super::prompts::{Prompt, Prompts, one_line};
use super::reasoner::{ModelReasoner, Question, ReasonError, Reasoner};
use super::schema::{integer, list, object, one_of, whole, words};
use crate::model::ChatModel;
use crate::scenes::{SceneError, SceneReader, SceneReading};

const KINDS: [(&str, SceneKind); 4] = [
    ("city", SceneKind::City),
    ("countryside", SceneKind::Countryside),
    ("wilderness", SceneKind::Wilderness),
    ("island", SceneKind::Island),
];
const PATTERNS: [(&str, Pattern); 4] = [
    ("mixed", Pattern::Mixed),
    ("grid", Pattern::Grid),
    ("winding", Pattern::Winding),
    ("suburb", Pattern::Suburb),
];
const WIDTHS: [(&str, Width); 3] =
    [("narrow", Width::Narrow), ("usual", Width::Usual), ("wide", Width::Wide)];
const AMOUNTS: [(&str, Amount); 4] =
    [("none", Amount::None), ("few", Amount::Few), ("usual", Amount::Usual), ("many", Amount::Many)];
const HEIGHTS: [(&str, Height); 3] = [("low", Height::Low), ("usual", Height::Usual), ("high", Height::High)];
const WATERS: [(&str, Water); 3] =
    [("harbour", Water::Harbour), ("river", Water::River), ("lake", Water::Lake)];
const SKIES: [&str; 6] = ["clear", "cloudy", "rain", "heavy_rain", "snow", "fog"];

/// Reads what a scene is to be by a language model.
///
/// ```
/// use simworld_agents::model::Scripted;
/// use simworld_agents::scenes::SceneReader;
/// use simworld_agents::thought::ModelSceneReader;
/// let answer = r#"{"cannot": "", "kind": "city", "title": "", "streets": 0, "pattern": "winding", "width": "narrow", "trees": "usual",
///     "parked": "none", "buildings": 40, "height": "low", "places": [], "squares": 1, "parks": 0, "waters": ["harbour"], "sky": "fog",
///     "minutes": 1140, "unread": []}"#;
/// let mut reader = ModelSceneReader::new(Box::new(Scripted::texts([answer])));
/// let reading = reader.read_scene("somewhere a smuggler would feel at home")?;
/// assert_eq!(reading.spec.buildings.count, Some(40));
/// # Ok::<(), simworld_agents::scenes::SceneError>(())
/// ```
pub struct ModelSceneReader {
    reasoner: Box<dyn Reasoner>,
    prompts: Arc<Prompts>,
}

impl ModelSceneReader {
    /// Asks this model with the prompts that come with the crate.
    pub fn new(model: Box<dyn ChatModel>) -> Self {
        let prompts = Arc::new(Prompts::standard());
        let reasoner = ModelReasoner::new(model).with_prompts(Arc::clone(&prompts));
        Self::with_reasoner(Box::new(reasoner), prompts)
    }

    /// Asks any reasoner.
    pub fn with_reasoner(reasoner: Box<dyn Reasoner>, prompts: Arc<Prompts>) -> Self {
        Self { reasoner, prompts }
    }

    fn question(&self, said: &str) -> Result<Question, ReasonError> {
        let shown: String = said.chars().take(2000).collect();
        Ok(Question {
            system: self.prompts.render(Prompt::Scene, &[])?,
            user: self.prompts.render(Prompt::Wish, &[("request", &one_line(&shown))])?,
            images: Vec::new(),
            name: "scene",
            schema: schema(),
        })
    }
}

impl SceneReader for ModelSceneReader {
    fn read_scene(&mut self, said: &str) -> Result<SceneReading, SceneError> {
        let failed = |fault: String| SceneError::Model { words: said.to_owned(), fault };
        let question = self.question(said).map_err(|error| failed(error.to_string()))?;
        let mut outcome = None;
        let reasoned = self.reasoner.reason(&question, &mut |answer| {
            outcome = Some(understood(answer, said)?);
            Ok(())
        });
        match (reasoned, outcome) {
            (Ok(_), Some(outcome)) => outcome,
            (Ok(_), None) => Err(failed("the reasoner did not have its answer checked".to_owned())),
            (Err(error), _) => Err(failed(error.to_string())),
        }
    }
}

fn names<T>(table: &[(&'static str, T)]) -> Value {
    one_of(table.iter().map(|(name, _)| *name))
}

fn schema() -> Value {
    let place =
        object([("use", one_of(Place::ALL.iter().map(|place| place.as_str()))), ("count", integer(0, 100))]);
    object([
        ("cannot", words(200)),
        ("kind", names(&KINDS)),
        ("title", words(60)),
        ("streets", integer(0, 2000)),
        ("pattern", names(&PATTERNS)),
        ("width", names(&WIDTHS)),
        ("trees", names(&AMOUNTS)),
        ("parked", names(&AMOUNTS)),
        ("buildings", integer(0, 5000)),
        ("height", names(&HEIGHTS)),
        ("places", list(&place, 0, 10)),
        ("squares", integer(0, 8)),
        ("parks", integer(0, 8)),
        ("waters", list(&names(&WATERS), 0, 3)),
        ("sky", one_of(SKIES)),
        ("minutes", integer(-1, 1439)),
        ("unread", list(&words(40), 0, 8)),
    ])
}

fn pick<T: Copy + Default>(table: &[(&'static str, T)], answer: &Value, field: &str) -> T {
    let said = answer[field].as_str().unwrap_or_default();
    table.iter().find(|(name, _)| *name == said).map_or_else(T::default, |(_, value)| *value)
}

fn number(answer: &Value, field: &str) -> i64 {
    whole(&answer[field]).unwrap_or_default()
}

/// The spec, or the model's word that none is asked for; a fault is worth another try.
fn understood(answer: &Value, said: &str) -> Result<Result<SceneReading, SceneError>, String> {
    let cannot = answer["cannot"].as_str().unwrap_or_default().trim();
    if !cannot.is_empty() {
        return Ok(Err(SceneError::Nothing { words: said.to_owned(), hint: cannot.to_owned() }));
    }
    let count = |field| u32::try_from(number(answer, field)).ok().filter(|count| *count > 0);
    let mut spec = SceneSpec { kind: pick(&KINDS, answer, "kind"), ..SceneSpec::default() };
    let title = answer["title"].as_str().map(one_line).filter(|title| !title.is_empty());
    spec.title = title;
    spec.streets.count = count("streets").map(|count| count.max(2));
    spec.streets.pattern = pick(&PATTERNS, answer, "pattern");
    spec.streets.width = pick(&WIDTHS, answer, "width");
    spec.streets.trees = pick(&AMOUNTS, answer, "trees");
    spec.streets.parked = pick(&AMOUNTS, answer, "parked");
    spec.buildings.count = count("buildings");
    spec.buildings.height = pick(&HEIGHTS, answer, "height");
    for place in answer["places"].as_array().into_iter().flatten() {
        let used_as = place["use"].as_str().and_then(Place::from_name);
        spec.features.places.extend(used_as.map(|used_as| (used_as, number(place, "count").max(0) as u32)));
    }
    let numbered = |name: &str, count: u32| (1..=count).map(|number| format!("{name} {number}")).collect();
    spec.features.squares = numbered("Square", count("squares").unwrap_or(0));
    spec.features.parks = numbered("Park", count("parks").unwrap_or(0));
    for water in answer["waters"].as_array().into_iter().flatten().filter_map(Value::as_str) {
        let known = WATERS.iter().find(|(name, _)| *name == water).map(|(_, water)| *water);
        spec.features.waters.extend(known.filter(|water| !spec.features.waters.contains(water)));
    }
    spec.environment = environment(answer);
    spec.validate().map_err(|error| error.to_string())?;
    let texts = answer["unread"].as_array().into_iter().flatten().filter_map(Value::as_str);
    Ok(Ok(SceneReading { spec, unread: texts.map(one_line).filter(|text| !text.is_empty()).collect() }))
}

fn environment(answer: &Value) -> Environment {
    let mut environment = Environment::default();
    let weather = &mut environment.weather;
    match answer["sky"].as_str().unwrap_or_default() {
        "cloudy" => weather.cloud_cover = 0.95,
        "rain" => (weather.rain, weather.cloud_cover) = (4.0, 0.95),
        "heavy_rain" => (weather.rain, weather.cloud_cover) = (20.0, 0.95),
        "snow" => (weather.snow, weather.cloud_cover, weather.temperature) = (3.0, 0.95, -1.0),
        "fog" => (weather.visibility, weather.cloud_cover) = (200.0, 1.0),
        _ => {}
    }
    let minutes = number(answer, "minutes");
    if minutes >= 0 {
        environment.sun = Sun::at_hour(minutes as f64 / 60.0);
    }
    environment
}
