//! Kin of the sets' sentences: what must come of each.

use super::{Asked, Verdict, verdict};
use crate::city::City;

/// Holds what must be true of each sentence in a city, in the notation of the sets.
pub(crate) fn come_to(city: &str, said: &[(&str, &str)]) {
    let city = City::read(city);
    let wrong: Vec<String> = said
        .iter()
        .filter_map(|(words, meaning)| {
            let asked = Asked {
                set: "kin",
                family: "kin".to_owned(),
                words: (*words).to_owned(),
                meaning: (*meaning).to_owned(),
            };
            match verdict(&city, &asked) {
                Verdict::Right => None,
                Verdict::WrongEdit(why) | Verdict::WrongAnswer(why) => Some(format!("{words}: {why}")),
            }
        })
        .collect();
    assert!(wrong.is_empty(), "{} wrong:\n{}", wrong.len(), wrong.join("\n"));
}
