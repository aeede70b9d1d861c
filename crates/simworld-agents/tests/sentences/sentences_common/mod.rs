//! The cities and the town of `tests/sentences`, the notation of plans, and the score of what people say in them.

pub(crate) mod city;
pub(crate) mod notation;
pub(crate) mod outcome;

use crate::tables::lines_of;
use city::City;
use simworld_agents::language::{AmbiguityPolicy, GrammarPlanner};
use simworld_core::intent::Intent;
use simworld_core::seam::{Plan, PlanError, Planner};
use simworld_core::value::Value;

/// The cities in which people speak to a walker.
pub(crate) const CITIES: [&str; 3] = ["harbour", "oldtown", "campus"];
/// Those, the town in which they speak to a driver, and twelve that came later.
pub(crate) const PLACES: [&str; 16] = [
    "harbour",
    "oldtown",
    "campus",
    "town",
    "park",
    "station",
    "depot",
    "market",
    "airport",
    "campsite",
    "lakeside",
    "zoo",
    "beach",
    "farm",
    "fairground",
    "waterside",
];
/// The sets of sentences in the order in which they came; each is `PLACE.SET.toml`.
const SETS: [&str; 35] = [
    "sentences",
    "paraphrases",
    "unheard",
    "later",
    "fifth",
    "sixth",
    "seventh",
    "eighth",
    "ninth",
    "tenth",
    "eleventh",
    "twelfth",
    "thirteenth",
    "fourteenth",
    "fifteenth",
    "sixteenth",
    "seventeenth",
    "eighteenth",
    "nineteenth",
    "twentieth",
    "twentyfirst",
    "twentysecond",
    "twentythird",
    "twentyfourth",
    "twentyfifth",
    "twentysixth",
    "twentyseventh",
    "twentyeighth",
    "twentyninth",
    "thirtieth",
    "thirtyfirst",
    "thirtysecond",
    "thirtythird",
    "thirtyfourth",
    "thirtyfifth",
];

/// One thing that is said, and what it means.
pub(crate) struct Said {
    pub(crate) family: String,
    pub(crate) words: String,
    /// A plan, `! kind ~ part` for an answer, or `? a | b` for a question back.
    pub(crate) meaning: String,
    /// What the world shows afterwards, where that is stated.
    pub(crate) outcome: Option<String>,
}

/// Everything that is said in a city.
pub(crate) fn said_in(city: &str) -> Vec<Said> {
    let said: Vec<Said> = SETS.iter().flat_map(|set| said_in_file(&format!("{city}.{set}"))).collect();
    assert!(!said.is_empty(), "nothing is said in {city}");
    said
}

/// Everything of which it is stated what the world shows afterwards, in whatever file of the place it stands, scored or not.
pub(crate) fn outcomes_in(place: &str) -> Vec<Said> {
    let folder = format!("{}/tests/sentences", env!("CARGO_MANIFEST_DIR"));
    let entries = std::fs::read_dir(&folder).unwrap_or_else(|error| panic!("{folder}: {error}"));
    let mut files: Vec<String> = entries
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .filter_map(|file| file.strip_suffix(".toml").map(str::to_owned))
        .filter(|file| file.split_once('.').is_some_and(|(of, set)| of == place && set != "city"))
        .collect();
    // The order in which a folder is listed is the file system's.
    files.sort_unstable();
    files.iter().flat_map(|file| said_in_file(file)).filter(|said| said.outcome.is_some()).collect()
}

/// What is said in a city by ourselves, of which all is to be right.
pub(crate) fn taught_in(city: &str) -> Vec<Said> {
    said_in_file(&format!("{city}.own"))
}

fn said_in_file(name: &str) -> Vec<Said> {
    let said = lines_of(&format!("sentences/{name}.toml")).into_iter().map(|[family, words, line]| {
        let (meaning, outcome) = match line.split_once(" -> ") {
            Some((meaning, outcome)) => (meaning.to_owned(), Some(outcome.to_owned())),
            None => (line, None),
        };
        Said { family, words, meaning, outcome }
    });
    said.collect()
}

/// What is made of one sentence.
pub(crate) fn understand(planner: &GrammarPlanner, city: &City, said: &Said) -> Result<Plan, PlanError> {
    let intent = if said.family == "call" { call(&said.words) } else { Intent::Words(said.words.clone()) };
    let mut planner = if said.family == "dog" { planner.spoken_by(city.me) } else { *planner };
    planner.plan(&intent, &city.world, city.spoken_to(&said.family))
}

/// `name(key = "text", key = 1.5)`.
fn call(text: &str) -> Intent {
    let (name, rest) = text.split_once('(').expect("a call has brackets");
    let args = rest.strip_suffix(')').expect("a call has brackets");
    let mut intent = Intent::call(name);
    for argument in args.split(", ").filter(|argument| !argument.is_empty()) {
        let (key, value) = argument.split_once(" = ").expect("an argument has a value");
        let value = match value.strip_prefix('"') {
            Some(text) => Value::Text(text.trim_end_matches('"').to_owned()),
            None => Value::Number(value.parse().expect("a value is a text or a number")),
        };
        intent = intent.arg(key, value);
    }
    intent
}

/// How an answer compares with what was expected of it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Verdict {
    Right,
    /// Another plan than the one expected, or a plan where an answer was expected: the body would do something wrong.
    WrongAction(String),
    /// An answer where a plan was expected, or an answer that misses the point.
    WrongAnswer(String),
}

/// Plans for what is said, and judges what comes of it.
pub(crate) fn verdict(city: &City, said: &Said) -> Verdict {
    let got = understand(&GrammarPlanner::default(), city, said);
    let Some(meant) = said.meaning.strip_prefix("? ") else { return judge(city, said, &got) };
    // Who is told to ask names all that could be meant; who is not takes the first of them.
    let mut meant: Vec<&str> = meant.split(" | ").collect();
    let first = meant[0];
    let asked = understand(&GrammarPlanner::with_policy(AmbiguityPolicy::Ask), city, said);
    let mut named = match asked {
        Err(PlanError::Ambiguous { candidates, .. }) => {
            candidates.iter().map(|(id, _)| city.key(*id)).collect::<Vec<_>>()
        }
        Err(error) => return Verdict::WrongAnswer(error.to_string()),
        Ok(plan) => return Verdict::WrongAction(notation::show(&plan, city)),
    };
    let taken = got.as_ref().is_ok_and(|plan| notation::show(plan, city).contains(first));
    named.sort_unstable();
    meant.sort_unstable();
    if named == meant && taken {
        Verdict::Right
    } else {
        Verdict::WrongAnswer(format!("asked for {named:?}, by default took {got:?}"))
    }
}

pub(crate) fn judge(city: &City, said: &Said, got: &Result<Plan, PlanError>) -> Verdict {
    match (said.meaning.strip_prefix("! "), got) {
        (None, Ok(plan)) => {
            let shown = notation::show(plan, city);
            if shown == said.meaning { Verdict::Right } else { Verdict::WrongAction(shown) }
        }
        (Some(expected), Err(error)) => {
            let (kind, part) = expected.split_once(" ~ ").unwrap_or((expected, ""));
            let answer = error.to_string();
            let right =
                notation::kind_of(error) == kind && answer.to_lowercase().contains(&part.to_lowercase());
            if right { Verdict::Right } else { Verdict::WrongAnswer(answer) }
        }
        (Some(_), Ok(plan)) => Verdict::WrongAction(notation::show(plan, city)),
        (None, Err(error)) => Verdict::WrongAnswer(error.to_string()),
    }
}
