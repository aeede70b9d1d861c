//! Classes of things: how large they are, what they are made of, and how much of them is that.
//!
//! Models come without a unit that can be trusted, and without a mass: what they are called says both, roughly.

mod rows;

use simworld_core::asset::Material;
use simworld_core::scene::EntityKind;

/// A class of things.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SizePrior {
    /// Its name.
    pub name: &'static str,
    /// What entities of it are.
    pub kind: EntityKind,
    /// Length, width and height of a typical one, m.
    pub size: [f64; 3],
    /// How many times longer, wider or higher, or less so, one may be; above 1.
    pub spread: f64,
    /// What it is made of.
    pub material: Material,
    /// Which share of the room inside its surface is that, in (0, 1]; none if it is fixed to the ground.
    pub solid: Option<f64>,
}

impl SizePrior {
    /// Every class.
    pub fn all() -> impl Iterator<Item = Self> {
        rows::ROWS.iter().map(prior)
    }

    /// The class that words name: "a wooden bench with a red back" is a bench. The last name before what it has, holds or
    /// stands on counts, the longest of several.
    pub fn of(words: &str) -> Option<Self> {
        let lower = words.to_lowercase();
        let words: Vec<&str> =
            lower.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty()).collect();
        let end = words.iter().position(|word| ASIDES.contains(word)).unwrap_or(words.len());
        find(&words[..end]).or_else(|| find(&words))
    }

    /// The class whose name is most like a word of some words.
    pub fn nearest(words: &str) -> Self {
        let likeness = |row: &rows::Row| {
            let names = row.0.iter();
            names
                .flat_map(|name| {
                    words.split_whitespace().map(|word| strsim::jaro_winkler(name, &word.to_lowercase()))
                })
                .fold(0.0, f64::max)
        };
        let best = rows::ROWS.iter().reduce(|a, b| if likeness(b) > likeness(a) { b } else { a });
        prior(best.unwrap_or(&rows::ROWS[0]))
    }

    /// How heavy a cubic metre within its surface is, kg/m³; none if it is fixed to the ground.
    pub fn bulk_density(&self) -> Option<f64> {
        self.solid.map(|share| share * self.material.density())
    }
}

/// What follows these is not the thing itself.
const ASIDES: &[&str] = &[
    "with", "without", "on", "in", "of", "for", "from", "that", "which", "holding", "like", "under", "full",
    "beside",
];

fn find(words: &[&str]) -> Option<SizePrior> {
    let mut best: Option<(usize, usize, &rows::Row)> = None;
    for row in rows::ROWS {
        for name in row.0 {
            let parts: Vec<&str> = name.split(' ').collect();
            let is_named = |at: &[&str]| at.iter().zip(&parts).all(|(word, part)| is_one(word, part));
            let Some(at) = words.windows(parts.len()).rposition(is_named) else { continue };
            let found = (at + parts.len(), parts.len());
            if best.is_none_or(|(end, long, _)| found > (end, long)) {
                best = Some((found.0, found.1, row));
            }
        }
    }
    best.map(|(_, _, row)| prior(row))
}

/// The word, or its plural.
fn is_one(word: &str, name: &str) -> bool {
    let plural = |ending: &str| word.strip_suffix(ending).is_some_and(|stem| stem == name);
    word == name || plural("s") || plural("es")
}

fn prior((names, kind, size, spread, material, solid): &rows::Row) -> SizePrior {
    SizePrior {
        name: names[0],
        kind: *kind,
        size: *size,
        spread: *spread,
        material: *material,
        solid: *solid,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_head_of_the_words_names_the_class() {
        for (words, class) in [
            ("a wooden bench with a red table", "bench"),
            ("a car", "car"),
            ("an old fire engine", "truck"),
            ("a traffic light", "traffic light"),
            ("a picnic table", "picnic table"),
            ("two picnic tables", "picnic table"),
            ("a statue of a horse", "statue"),
            ("a tall green lamp post", "lamp post"),
            ("a wooden market stall", "market stall"),
            ("a street-lamp", "lamp post"),
        ] {
            assert_eq!(SizePrior::of(words).map(|prior| prior.name), Some(class), "{words}");
        }
        assert_eq!(SizePrior::of("a quantum flux"), None);
        assert_eq!(SizePrior::nearest("a bensh").name, "bench");
    }

    /// Mass of a typical thing by the table, with the part of its box that such things fill, against a band as weighed.
    #[test]
    fn typical_things_weigh_what_they_weigh() {
        for (words, filled, band) in [
            ("car", 0.55, 900.0..2000.0),
            ("bus", 0.85, 8_000.0..16_000.0),
            ("bicycle", 0.03, 8.0..25.0),
            ("motorcycle", 0.15, 120.0..300.0),
            ("bench", 0.15, 20.0..80.0),
            ("chair", 0.1, 3.0..12.0),
            ("barrel", 0.75, 25.0..60.0),
            ("trash bin", 0.78, 10.0..50.0),
            ("traffic cone", 0.35, 2.0..5.0),
            ("person", 0.19, 50.0..100.0),
            ("dog", 0.25, 10.0..50.0),
            ("horse", 0.22, 350.0..700.0),
        ] {
            let class = SizePrior::of(words).unwrap();
            let mass = class.size.iter().product::<f64>() * filled * class.bulk_density().unwrap();
            assert!(band.contains(&mass), "a {words} of {mass} kg");
        }
    }

    #[test]
    fn every_class_is_sound() {
        let mut names: Vec<&str> = rows::ROWS.iter().flat_map(|row| row.0).copied().collect();
        let count = names.len();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), count, "each name is of one class");
        for class in SizePrior::all() {
            assert!(class.size.iter().all(|side| (0.05..60.0).contains(side)), "{}", class.name);
            assert!(
                class.spread > 1.0 && class.solid.is_none_or(|share| share > 0.0 && share <= 1.0),
                "{}",
                class.name
            );
        }
    }
}
