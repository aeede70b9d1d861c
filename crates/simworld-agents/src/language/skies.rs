//! Weather by name, for models: the words of the grammar itself, each with what it makes of the sky, and back.

use simworld_core::environment::{Environment, Sun, Weather};

use super::edits::sky::changed;
use super::edits::words::{ENDINGS, SKY_ROWS, Sky};

/// The most words by which a sky is told.
const MOST: usize = 4;
/// Minutes of a day.
const DAY: i64 = 1440;
/// Two suns are the same by this, radians: an hour may be told by a sum or by a quotient.
const SAME: f64 = 1e-9;

/// Whatever the grammar can say of the weather, by the first of its words.
fn named() -> Vec<(String, Sky)> {
    let skies = SKY_ROWS.iter().filter(|(_, sky)| !matches!(sky, Sky::Hour(_)));
    let ends = ENDINGS.iter().filter(|(_, sky)| *sky != Sky::Clear);
    let skies = skies.map(|(words, sky)| (words[0].to_owned(), *sky));
    skies.chain(ends.map(|(words, sky)| (format!("no {}", words[0]), *sky))).collect()
}

/// The names of all weathers.
pub(crate) fn sky_names() -> Vec<String> {
    named().into_iter().map(|(name, _)| name).collect()
}

/// Sun and weather as names say, one after another, and minutes after midnight, which below zero leave the sun where it is.
pub(crate) fn sky_by_names<'a>(
    now: Environment,
    names: impl Iterator<Item = &'a str>,
    minutes: i64,
) -> Environment {
    let named = named();
    let of = |name: &str| named.iter().find(|(own, _)| own == name).map(|(_, sky)| *sky);
    let mut skies: Vec<Sky> = names.filter_map(of).collect();
    if minutes >= 0 {
        skies.push(Sky::Hour(minutes as f64 / 60.0));
    }
    changed(now, &skies)
}

/// The names and the minutes that make one sky of another; none if there are none, or too many are needed.
pub(crate) fn names_of_sky(from: Environment, to: &Environment) -> Option<(Vec<String>, i64)> {
    if from.moon != to.moon {
        return None;
    }
    let minutes = if from.sun == to.sun { -1 } else { minutes_of(&to.sun)? };
    let named = named();
    let found = (0..=MOST).find_map(|count| ways(from, &to.weather, &named, count))?;
    Some((found.into_iter().map(|index| named[index].0.clone()).collect(), minutes))
}

/// The first of the ways to a weather in so many words.
fn ways(now: Environment, wanted: &Weather, named: &[(String, Sky)], count: usize) -> Option<Vec<usize>> {
    if count == 0 {
        return (now.weather == *wanted).then(Vec::new);
    }
    named.iter().enumerate().find_map(|(index, (_, sky))| {
        let next = changed(now, &[*sky]);
        if next.weather == now.weather {
            return None;
        }
        let rest = ways(next, wanted, named, count - 1)?;
        Some(std::iter::once(index).chain(rest).collect())
    })
}

fn minutes_of(sun: &Sun) -> Option<i64> {
    (0..DAY).find(|minutes| {
        let other = Sun::at_hour(*minutes as f64 / 60.0);
        // Far less than a lux.
        let shines = (other.illuminance - sun.illuminance).abs() < 1e-3;
        shines && (other.azimuth - sun.azimuth).abs() < SAME && (other.elevation - sun.elevation).abs() < SAME
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_name_is_given_twice() {
        let mut names = sky_names();
        let all = names.len();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), all);
    }

    #[test]
    fn every_sky_of_the_grammar_comes_back_from_its_names() {
        let rows = || SKY_ROWS.iter().chain(ENDINGS).map(|(_, sky)| *sky);
        let mut count = 0;
        for first in rows() {
            for second in rows() {
                for third in [None, Some(Sky::Windy(10.0)), Some(Sky::Hour(7.0 + 20.0 / 60.0))] {
                    let skies: Vec<Sky> = [first, second].into_iter().chain(third).collect();
                    let now = changed(Environment::default(), &skies);
                    let (names, minutes) = names_of_sky(Environment::default(), &now)
                        .unwrap_or_else(|| panic!("{skies:?} has no names"));
                    let names = names.iter().map(String::as_str);
                    let again = sky_by_names(Environment::default(), names, minutes);
                    assert_eq!(again.weather, now.weather, "{skies:?}");
                    assert!((again.sun.elevation - now.sun.elevation).abs() < SAME, "{skies:?}");
                    count += 1;
                }
            }
        }
        assert!(count > 1000, "{count}");
    }
}
