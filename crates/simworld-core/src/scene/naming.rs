//! What things are called: the words of their names, and what they sell, each with its bearers.
//!
//! A [`World`](super::World) keeps its index as it changes. The index follows from the entities alone, so it is no part
//! of a snapshot; a scene without one is read by looking at every entity.

use std::collections::{BTreeMap, BTreeSet};

use super::{EntityInfo, SELLS};
use crate::id::EntityId;
use crate::value::Value;

/// The word under which every number of a name is filed.
const NUMBER: &str = "#";

/// Punctuation, which is said in no name.
const MARKS: &str = ".,;:!?()[]\"'`“”„‘’«»-–—_";

/// The words of names and the goods on sale, in alphabetical order, with the entities that bear and sell them.
///
/// ```
/// use simworld_core::geometry::Pose;
/// use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
/// let mut world = World::new();
/// let house = EntityDesc::new(EntityKind::Building, Pose::identity(), Shape::cuboid(9.0, 9.0, 6.0));
/// let id = world.spawn(house.named("St. Mary's Hospital").with("sells", "coffee, tea"))?;
/// let names = world.names().unwrap();
/// assert!(names.bearers("marys").eq([id]) && names.bearers("mary").next().is_none());
/// assert!(names.words_from("h").eq(["hospital"]));
/// assert!(names.goods().map(|(goods, _)| goods).eq(["coffee", "tea"]));
/// # Ok::<(), simworld_core::scene::WorldError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct NameIndex {
    words: BTreeMap<Box<str>, BTreeSet<EntityId>>,
    goods: BTreeMap<Box<str>, BTreeSet<EntityId>>,
}

impl NameIndex {
    /// Files an entity under its name and what it sells.
    pub fn insert(&mut self, id: EntityId, info: &EntityInfo) {
        if let Some(name) = &info.name {
            for word in words_of(name) {
                file(&mut self.words, word, id);
            }
        }
        self.insert_goods(id, info.attributes.get(SELLS));
    }

    /// Takes an entity out again; its information is that with which it was filed.
    pub fn remove(&mut self, id: EntityId, info: &EntityInfo) {
        if let Some(name) = &info.name {
            for word in words_of(name) {
                take_out(&mut self.words, &word, id);
            }
        }
        self.remove_goods(id, info.attributes.get(SELLS));
    }

    pub(crate) fn insert_goods(&mut self, id: EntityId, sells: Option<&Value>) {
        for goods in goods_of(sells) {
            file(&mut self.goods, goods.to_owned(), id);
        }
    }

    pub(crate) fn remove_goods(&mut self, id: EntityId, sells: Option<&Value>) {
        for goods in goods_of(sells) {
            take_out(&mut self.goods, goods, id);
        }
    }

    /// Those in whose name the word stands, ascending; the word in lower case and without apostrophes.
    pub fn bearers(&self, word: &str) -> impl Iterator<Item = EntityId> {
        self.words.get(word).into_iter().flatten().copied()
    }

    /// How many bear the word in their name.
    pub fn count(&self, word: &str) -> usize {
        self.words.get(word).map_or(0, BTreeSet::len)
    }

    /// Those in whose name a number stands, ascending.
    pub fn numbered(&self) -> impl Iterator<Item = EntityId> {
        self.bearers(NUMBER)
    }

    /// The words of names that begin so, in alphabetical order.
    pub fn words_from<'a>(&'a self, beginning: &'a str) -> impl Iterator<Item = &'a str> {
        let from =
            self.words.range::<str, _>((std::ops::Bound::Included(beginning), std::ops::Bound::Unbounded));
        from.map(|(word, _)| word.as_ref()).take_while(move |word| word.starts_with(beginning))
    }

    /// What is on sale, in alphabetical order, with those who sell it, ascending.
    pub fn goods(&self) -> impl Iterator<Item = (&str, impl Iterator<Item = EntityId> + Clone)> {
        self.goods.iter().map(|(goods, sellers)| (goods.as_ref(), sellers.iter().copied()))
    }
}

fn file(map: &mut BTreeMap<Box<str>, BTreeSet<EntityId>>, key: String, id: EntityId) {
    map.entry(key.into_boxed_str()).or_default().insert(id);
}

fn take_out(map: &mut BTreeMap<Box<str>, BTreeSet<EntityId>>, key: &str, id: EntityId) {
    let Some(ids) = map.get_mut(key) else { return };
    ids.remove(&id);
    if ids.is_empty() {
        map.remove(key);
    }
}

/// What is sold, as it is written between the commas.
fn goods_of(sells: Option<&Value>) -> impl Iterator<Item = &str> {
    let text = if let Some(Value::Text(text)) = sells { text.as_str() } else { "" };
    text.split(',').map(str::trim).filter(|goods| !goods.is_empty())
}

/// The words of a name: runs of letters and digits in lower case, apostrophes left out; `&` is "and", another symbol a word of
/// its own, and a number is [`NUMBER`] unless it is a place in a row ("2nd").
fn words_of(name: &str) -> Vec<String> {
    let mut words = Vec::new();
    let mut rest = name;
    while let Some(first) = rest.chars().next() {
        let digits = rest.bytes().take_while(u8::is_ascii_digit).count();
        if digits > 0 && !is_ordinal(&rest[digits..]) {
            words.push(NUMBER.to_owned());
            rest = &rest[digits..];
        } else if first.is_alphanumeric() {
            let (word, length) = word(rest);
            words.push(word);
            rest = &rest[length..];
        } else {
            match first {
                '&' => words.push("and".to_owned()),
                mark if mark.is_whitespace() || MARKS.contains(mark) => {}
                symbol => words.push(symbol.to_string()),
            }
            rest = &rest[first.len_utf8()..];
        }
    }
    words
}

fn is_ordinal(after_digits: &str) -> bool {
    let ends = |ending: &&str| {
        after_digits.strip_prefix(*ending).is_some_and(|rest| !rest.starts_with(char::is_alphanumeric))
    };
    ["st", "nd", "rd", "th"].iter().any(ends)
}

/// The word at the start, and how many bytes it takes.
fn word(text: &str) -> (String, usize) {
    let mut word = String::new();
    let mut length = 0;
    let mut letters = text.chars().peekable();
    while let Some(letter) = letters.next() {
        let is_inner = |next: Option<&char>| next.is_some_and(|next| next.is_alphanumeric());
        if letter.is_alphanumeric() {
            word.extend(letter.to_lowercase());
        } else if !(matches!(letter, '\'' | '’') && is_inner(letters.peek())) {
            break;
        }
        length += letter.len_utf8();
    }
    (word, length)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_fall_into_words_as_they_are_said() {
        assert_eq!(
            words_of("St. Mary’s & Co, 12 2nd Ave 7eleven"),
            ["st", "marys", "and", "co", "#", "2nd", "ave", "#", "eleven"]
        );
        assert!(words_of(" -- ").is_empty());
    }
}
