//! What people call things that were made for words: by these, without the address that tells one from others of its name.

use super::Asset;

/// The least length of an address: eight hexadecimal digits, of 32 bits.
const ADDRESS: usize = 8;
/// Before what something is.
const ARTICLES: [&str; 5] = ["a", "an", "the", "some", "one"];
/// Behind what something is, before how it is.
#[rustfmt::skip]
const BEHIND: [&str; 16] = ["with", "without", "of", "made", "in", "on", "from", "for", "by", "near", "under", "over", "and", "that", "which", "like"];

impl Asset {
    /// Its name in words, without the address behind it by which a generator, or a world, tells it from others that are called the same, and
    /// then without the article before it.
    ///
    /// ```
    /// use simworld_core::asset::Asset;
    /// use simworld_core::scene::{EntityKind, Shape};
    /// let called = |name: &str| Asset::new(name, EntityKind::Prop, Shape::cuboid(1.0, 1.0, 8.0)).called();
    /// assert_eq!(called("a_stone_obelisk_00ab12cd34ef"), "stone obelisk");
    /// assert_eq!(called("food_truck"), "food truck");
    /// ```
    pub fn called(&self) -> String {
        self.spoken().0.join(" ")
    }

    /// Whether its name ends with such an address.
    pub fn has_address(&self) -> bool {
        self.spoken().1
    }

    /// What it is by those words, if its name has an address: "obelisk" of "a stone obelisk with three steps".
    pub fn noun(&self) -> Option<&str> {
        let (words, has_address) = self.spoken();
        if has_address { noun_of(&words) } else { None }
    }

    /// Whether people may call it so, with blanks or underscores between the words: as it is called or, where its name has an address, by
    /// its noun behind words to which it answers.
    pub fn is_called(&self, words: &str) -> bool {
        let said: Vec<&str> = words.split([' ', '_']).filter(|word| !word.is_empty()).collect();
        let (own, has_address) = self.spoken();
        let by_noun = || match said.split_last() {
            Some((last, before)) => noun_of(&own) == Some(*last) && self.answers(before) == before.len(),
            None => false,
        };
        said == own || has_address && by_noun()
    }

    /// The words of its name, and whether an address stood behind them.
    fn spoken(&self) -> (Vec<&str>, bool) {
        let mut words: Vec<&str> = self.name.split('_').filter(|word| !word.is_empty()).collect();
        let addresses = words.iter().rev().take_while(|word| is_address(word)).count();
        if addresses == 0 || addresses == words.len() {
            return (words, false);
        }
        words.truncate(words.len() - addresses);
        if words.len() > 1 && ARTICLES.contains(&words[0]) {
            words.remove(0);
        }
        (words, true)
    }
}

fn is_address(word: &str) -> bool {
    word.len() >= ADDRESS && word.bytes().all(|letter| letter.is_ascii_hexdigit())
}

fn noun_of<'a>(words: &[&'a str]) -> Option<&'a str> {
    let end = words.iter().skip(1).position(|word| BEHIND.contains(word)).map_or(words.len(), |at| at + 1);
    words[..end].last().copied()
}

#[cfg(test)]
mod tests {
    use super::super::Catalogue;
    use super::*;
    use crate::scene::{EntityKind, Shape};

    fn asset(name: &str) -> Asset {
        Asset::new(name, EntityKind::Prop, Shape::cuboid(1.0, 1.0, 1.0))
    }

    #[test]
    fn what_was_made_is_called_by_its_words() {
        for (name, called, noun) in [
            ("obelisk_00ab12cd34ef", "obelisk", Some("obelisk")),
            ("obelisk_00ab12cd34ef_0123456789abcdef", "obelisk", Some("obelisk")),
            ("a_bench_with_a_red_seat_1a2b3c4d", "bench with a red seat", Some("bench")),
            ("lamp_post_00ab12cd34ef", "lamp post", Some("post")),
            ("of_stone_1a2b3c4d", "of stone", Some("stone")),
            ("facade_bed", "facade bed", None),
            ("soda_2", "soda 2", None),
            ("00ab12cd34ef", "00ab12cd34ef", None),
        ] {
            let asset = asset(name);
            assert_eq!((asset.called().as_str(), asset.noun()), (called, noun), "{name}");
            assert_eq!(asset.has_address(), noun.is_some(), "{name}");
        }
    }

    #[test]
    fn nothing_of_the_library_has_an_address() {
        for (_, asset) in Catalogue::library().iter() {
            assert!(!asset.has_address(), "{}", asset.name);
            assert_eq!(asset.called(), asset.name.replace('_', " "));
        }
    }

    #[test]
    fn words_before_the_noun_have_to_fit() {
        let obelisk = asset("a_tall_obelisk_1a2b3c4d").tagged(["tall", "stone"]);
        for words in ["obelisk", "stone obelisk", "tall_obelisk", "tall stone obelisk"] {
            assert!(obelisk.is_called(words), "{words}");
        }
        for words in ["", "marble obelisk", "tall", "obelisk tall", "1a2b3c4d"] {
            assert!(!obelisk.is_called(words), "{words}");
        }
        assert!(asset("food_truck").is_called("food truck") && !asset("food_truck").is_called("truck"));
    }
}
