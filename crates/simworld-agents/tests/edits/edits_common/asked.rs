//! The sets of sentences, read from their files.

use std::ffi::OsStr;
use std::path::Path;

use crate::tables::{lines_at, lines_of};

pub(crate) const CITIES: [&str; 5] = ["harbour", "oldtown", "campus", "quarter", "crescent"];
/// The sets of sentences in the order in which they came; each is `CITY.SET.toml`. Not every city has every set.
const SETS: [&str; 48] = [
    "edits",
    "later.edits",
    "third.edits",
    "fourth.edits",
    "fifth.edits",
    "sixth.edits",
    "seventh.edits",
    "eighth.edits",
    "ninth.edits",
    "tenth.edits",
    "eleventh.edits",
    "twelfth.edits",
    "thirteenth.edits",
    "fourteenth.edits",
    "fifteenth.edits",
    "sixteenth.edits",
    "seventeenth.edits",
    "eighteenth.edits",
    "nineteenth.edits",
    "twentieth.edits",
    "twentyfirst.edits",
    "twentysecond.edits",
    "twentythird.edits",
    "twentyfourth.edits",
    "twentyfifth.edits",
    "twentysixth.edits",
    "twentyseventh.edits",
    "twentyeighth.edits",
    "twentyninth.edits",
    "thirtieth.edits",
    "thirtyfirst.edits",
    "thirtysecond.edits",
    "thirtythird.edits",
    "thirtyfourth.edits",
    "thirtyfifth.edits",
    "thirtysixth.edits",
    "thirtyseventh.edits",
    "thirtyeighth.edits",
    "thirtyninth.edits",
    "fortieth.edits",
    "fortyfirst.edits",
    "fortysecond.edits",
    "fortythird.edits",
    "fortyfourth.edits",
    "fortyfifth.edits",
    "fortysixth.edits",
    "fortyseventh.edits",
    "turned.edits",
];

/// One thing that is asked, and what must then be true.
pub(crate) struct Asked {
    /// Which of [`SETS`] it is of, or our own.
    pub(crate) set: &'static str,
    pub(crate) family: String,
    pub(crate) words: String,
    pub(crate) meaning: String,
}

/// What is asked in a city: in its own file, and in those that came later, if it has them.
fn asked_in(city: &str) -> Vec<Asked> {
    SETS.iter().flat_map(|set| asked_in_set(city, set)).collect()
}

/// Of the older sets so many sentences are a sample of one.
const SAMPLED: usize = 3;
/// So many sets of a city, the newest, are left whole by a sample.
const NEWEST: usize = 2;

/// Whether everything is judged: `SIMWORLD_SOAK`.
pub(crate) fn is_whole() -> bool {
    std::env::var_os("SIMWORLD_SOAK").is_some()
}

/// As [`asked_in`]; of the older sets a sample alone, unless `SIMWORLD_SOAK` asks for the whole.
pub(crate) fn sampled_in(city: &str) -> Vec<Asked> {
    let is_whole = is_whole();
    let asked = asked_in(city);
    let mut sets: Vec<&str> = asked.iter().map(|asked| asked.set).collect();
    sets.dedup();
    let newest = sets.split_off(sets.len().saturating_sub(NEWEST));
    let asked = asked.into_iter().enumerate();
    let taken =
        asked.filter(|(index, asked)| is_whole || index % SAMPLED == 0 || newest.contains(&asked.set));
    taken.map(|(_, asked)| asked).collect()
}

/// What is asked in a city in the newest set that it has.
pub(crate) fn newest_in(city: &str) -> Vec<Asked> {
    let mut sets = SETS.iter().rev().map(|set| asked_in_set(city, set));
    sets.find(|asked| !asked.is_empty()).unwrap_or_default()
}

/// What is asked in a city in the files `CITY.*.edits.toml` of the folder that `SIMWORLD_EDITS` names.
pub(crate) fn asked_elsewhere(city: &str) -> Vec<Asked> {
    let Some(folder) = std::env::var_os("SIMWORLD_EDITS") else { return Vec::new() };
    let entries = std::fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut files: Vec<_> = entries.flatten().map(|entry| entry.path()).collect();
    files.sort();
    let is_of_city = |path: &Path| {
        let name = path.file_name().and_then(OsStr::to_str).unwrap_or_default();
        name.starts_with(&format!("{city}.")) && name.ends_with(".edits.toml")
    };
    let lines = files.iter().filter(|path| is_of_city(path)).flat_map(|path| lines_at(path));
    lines.map(|[family, words, meaning]| Asked { set: "elsewhere", family, words, meaning }).collect()
}

/// Where our own sentences are: those of the beginning, and those that came later.
const OWN: [&str; 2] = ["own.edits", "own.later.edits"];

/// What is asked in a city by ourselves, of which all is to be right.
pub(crate) fn taught_in(city: &str) -> Vec<Asked> {
    OWN.into_iter().flat_map(|set| asked_in_set(city, set)).collect()
}

/// As [`taught_in`]; of those of the beginning a sample alone, unless `SIMWORLD_SOAK` asks for the whole.
pub(crate) fn sampled_of_taught_in(city: &str) -> Vec<Asked> {
    let is_whole = is_whole();
    let asked = taught_in(city).into_iter().enumerate();
    let taken = asked.filter(|(index, asked)| is_whole || index % SAMPLED == 0 || asked.set != OWN[0]);
    taken.map(|(_, asked)| asked).collect()
}

fn asked_in_set(city: &str, set: &'static str) -> Vec<Asked> {
    let lines = lines_of(&format!("edits/{city}.{set}.toml")).into_iter();
    lines.map(|[family, words, meaning]| Asked { set, family, words, meaning }).collect()
}
