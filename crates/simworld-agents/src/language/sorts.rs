//! What things are called after what they are made of: "the beehive", "both oaks", "the police cars".
//!
//! The classes of the lexicon are few, the assets of a catalogue are many. A thing that was made of an asset is known by the asset's
//! name as long as one of them is there, or as the sentence itself makes one. What was made for words is known by these: "the obelisk",
//! "the stone obelisk".

use std::sync::Arc;

use simworld_core::asset::{Asset, Catalogue};
use simworld_core::id::AssetId;
use simworld_core::scene::EntityKind;

use super::clause::{Reference, Target};
use super::lexer::{Lexeme, Token};
use super::lexicon::{CATEGORIES, Category, category, fits_noun, is_plural};
use super::names::Names;
use super::resolve::{Ranked, View};

/// The name of an asset has no more words than that.
const LONGEST_NAME: usize = 4;
/// "The two big red oaks".
const FARTHEST_DETERMINER: usize = 4;

/// A sort of things that a phrase begins with.
#[derive(Clone, Debug)]
pub(super) struct Sort {
    /// What things of the sort are.
    pub(super) class: &'static Category,
    /// The asset's name; of what was made for words those of them that were said, in the singular.
    pub(super) asset: Arc<String>,
    /// How many words say it.
    pub(super) words: usize,
}

/// An asset that a phrase names.
struct Found<'a> {
    asset: &'a Asset,
    /// As of a [`Sort`].
    name: String,
    words: usize,
}

impl<'a> Names<'a> {
    /// The longest name of an asset at the start of a phrase, in the singular or the plural: of one that is there, or that the
    /// sentence makes.
    pub(super) fn sort_of_asset(&self, phrase: &[Lexeme]) -> Option<Sort> {
        let is_there = |id: AssetId| self.scene.classes().is_some_and(|classes| classes.count_of(id) > 0);
        let there = || {
            let catalogue = self.scene.assets()?;
            let found = asset_at(phrase, catalogue, &is_there)?;
            catalogue.find(&found.asset.name).is_some_and(is_there).then_some(found)
        };
        let made = || {
            let (catalogue, made) = self.made.as_ref()?;
            asset_at(phrase, catalogue, &|_| true).filter(|found| made.contains(&found.name))
        };
        let Found { asset, name, words } = there().or_else(made)?;
        let class = class_of(asset)?;
        // "The oak tree".
        let again = class.words.iter().find_map(|word| fits_noun(&phrase[words..], word)).unwrap_or(0);
        Some(Sort { class, asset: Arc::new(name), words: words + again })
    }

    /// How many words at the start of a phrase are the name of an asset of the catalogue.
    pub(super) fn asset_words(&self, phrase: &[Lexeme]) -> Option<usize> {
        let (catalogue, _) = self.made.as_ref()?;
        asset_at(phrase, catalogue, &|_| true).map(|found| found.words)
    }

    /// Whether a phrase is the name of an asset of which none is there, and the sentence speaks of none that it makes.
    pub(super) fn is_sort_of_none(&self, phrase: &[Lexeme]) -> bool {
        let asset = self.made.as_ref().and_then(|(catalogue, _)| asset_at(phrase, catalogue, &|_| true));
        asset.is_some_and(|found| found.words == phrase.len())
            && self.sort_of_asset(phrase).is_none_or(|sort| sort.words < phrase.len())
    }

    /// As it is, in a sentence that may make what it speaks of later: "a beehive by the lake, and paint the beehive red".
    pub(super) fn with_made(mut self, lexemes: &[Lexeme], catalogue: &'a Catalogue) -> Self {
        let (mut new, mut made) = (Vec::new(), Vec::new());
        let mut at = 0;
        while at < lexemes.len() {
            let Some(Found { name, words, .. }) = asset_at(&lexemes[at..], catalogue, &|_| true) else {
                at += 1;
                continue;
            };
            let is_known = new.contains(&name);
            match (is_definite(&lexemes[..at]), is_known) {
                (true, true) => made.push(name),
                (false, false) => new.push(name),
                _ => {}
            }
            at += words;
        }
        self.made = Some((catalogue, made));
        self
    }
}

impl View<'_> {
    /// "The parcel" is none that is called "suitcase", where another is there.
    pub(super) fn leave_others_out(&self, reference: &Reference, found: &mut Vec<Ranked>) {
        let Target::Any(class) = &reference.target else { return };
        if found.len() < 2 {
            return;
        }
        if class.kinds() != [EntityKind::Parcel] {
            return self.keep_those_called(class, &reference.text, found);
        }
        let is_called_so = |(_, id): &Ranked| {
            let Some(entity) = self.scene.entity(*id) else { return false };
            let last = entity.info.name.as_ref().and_then(|name| name.split_whitespace().last());
            last.is_none_or(|last| {
                class.words.iter().chain(&["letter", "envelope"]).any(|word| word.eq_ignore_ascii_case(last))
            })
        };
        if found.iter().any(is_called_so) {
            found.retain(is_called_so);
        }
    }

    /// "The two taxis" are those called "taxi", where some are: a word that says more than the kind does.
    fn keep_those_called(&self, class: &Category, text: &str, found: &mut Vec<Ranked>) {
        let own = |word: &&&str| class.kinds().iter().all(|kind| kind.as_str() != **word);
        let mut said = text.split_whitespace();
        let narrow = said.find_map(|said| {
            class.words[1..].iter().filter(own).find(|word| *said == ***word || is_plural(said, word))
        });
        let Some(word) = narrow else { return };
        let called = |(_, id): &Ranked| {
            let name = self.scene.entity(*id).and_then(|entity| entity.info.name.as_ref());
            name.and_then(|name| name.split_whitespace().last())
                .is_some_and(|last| last.eq_ignore_ascii_case(word))
        };
        if found.iter().any(called) {
            found.retain(called);
        }
    }
}

/// Whether what follows these words is spoken of as known: the last determiner says so.
fn is_definite(before: &[Lexeme]) -> bool {
    const KNOWN: &[&str] = &["the", "this", "that", "these", "those", "both", "all"];
    const NEW: &[&str] =
        &["a", "an", "one", "another", "some", "new", "two", "three", "four", "five", "six", "several"];
    let determiner = before.iter().rev().take(FARTHEST_DETERMINER).find_map(|lexeme| match &lexeme.token {
        Token::Word(word) if KNOWN.contains(&word.as_str()) => Some(true),
        Token::Word(word) if NEW.contains(&word.as_str()) => Some(false),
        Token::Word(_) => None,
        _ => Some(false),
    });
    determiner == Some(true)
}

/// The asset whose name begins the phrase, of several the longest, and how many words that are. Of several that were made for words and are
/// called the same one that is there.
fn asset_at<'a>(
    phrase: &[Lexeme],
    catalogue: &'a Catalogue,
    is_there: &dyn Fn(AssetId) -> bool,
) -> Option<Found<'a>> {
    let words: Vec<&str> = phrase
        .iter()
        .take(LONGEST_NAME)
        .map_while(|lexeme| if let Token::Word(word) = &lexeme.token { Some(word.as_str()) } else { None })
        .collect();
    let found = (1..=words.len()).rev().find_map(|count| {
        let (last, head) = words[..count].split_last()?;
        singulars(last).find_map(|last| {
            let name = head.iter().copied().chain([last.as_str()]).collect::<Vec<_>>().join("_");
            let made = || made_so(catalogue, &name, (last.as_str(), &phrase[count - 1..count]), is_there);
            let asset = catalogue.get(catalogue.find(&name).or_else(made)?)?;
            Some(Found { asset, name, words: count })
        })
    });
    // "The palm" is an asset called "palm_tree".
    let tree = || {
        let word = words.first()?;
        let name = format!("{}_tree", word.strip_suffix('s').unwrap_or(word));
        catalogue.get(catalogue.find(&name)?).map(|asset| Found { asset, name, words: 1 })
    };
    found.or_else(tree)
}

/// An asset that was made for words and is called so. A noun that has a class of its own means it only with all the words before it: "the
/// house" is no dog house.
fn made_so(
    catalogue: &Catalogue,
    name: &str,
    (noun, said): (&str, &[Lexeme]),
    is_there: &dyn Fn(AssetId) -> bool,
) -> Option<AssetId> {
    let made = catalogue.with_noun(noun);
    if made.is_empty() {
        return None;
    }
    let has_class = category(said).is_some();
    let is_meant = |id: &AssetId| {
        let is_whole = |asset: &Asset| !has_class || asset.called().replace(' ', "_") == name;
        catalogue.get(*id).is_some_and(|asset| is_whole(asset) && asset.is_called(name))
    };
    let meant = || made.iter().copied().filter(is_meant);
    meant().find(|id| is_there(*id)).or_else(|| meant().next())
}

/// What a word may be the plural of, and itself first.
pub(super) fn singulars(word: &str) -> impl Iterator<Item = String> {
    const ENDINGS: [(&str, &str); 5] = [("ies", "y"), ("ves", "f"), ("ves", "fe"), ("es", ""), ("s", "")];
    let stems = ENDINGS
        .into_iter()
        .filter_map(|(ending, singular)| Some(format!("{}{singular}", word.strip_suffix(ending)?)))
        .filter(|stem| stem.len() > 2);
    std::iter::once(word.to_owned()).chain(stems.collect::<Vec<_>>())
}

/// The class of what an asset is.
fn class_of(asset: &Asset) -> Option<&'static Category> {
    let by_use = asset.place.and_then(|place| CATEGORIES.iter().find(|class| class.place() == Some(place)));
    let by_kind = || {
        let is_plain = |class: &&Category| class.kinds() == [asset.kind] && asset.kind != EntityKind::Ground;
        CATEGORIES.iter().find(is_plain)
    };
    by_use.or_else(by_kind)
}

#[cfg(test)]
mod tests {
    use simworld_core::geometry::{Point2, Pose};
    use simworld_core::scene::{Shape, World};

    use super::super::lexer::lex;
    use super::*;

    #[test]
    fn a_sort_is_known_while_one_is_there_or_is_made() {
        let catalogue = Catalogue::library();
        let mut world = World::new();
        let hive = catalogue.get(catalogue.find("beehive").unwrap()).unwrap();
        let id = world.add_asset(hive.clone()).unwrap();
        let names = |world: &World, words: &str| {
            let names = Names::new(world, Point2::origin(), 100.0);
            names.sort_of_asset(&lex(words)).map(|sort| (sort.asset.to_string(), sort.words))
        };
        assert_eq!(names(&world, "beehives by the lake"), None);
        let hive = world.spawn(hive.at(id, Pose::identity())).unwrap();
        assert_eq!(names(&world, "beehives by the lake"), Some(("beehive".to_owned(), 1)));
        assert_eq!(names(&world, "police cars"), None);
        let made = Names::new(&world, Point2::origin(), 100.0)
            .with_made(&lex("two police cars by the lake and paint the police cars red"), &catalogue);
        assert!(made.sort_of_asset(&lex("police cars")).is_some_and(|sort| sort.words == 2));
        world.remove(hive).unwrap();
        assert_eq!(names(&world, "beehives by the lake"), None);
    }

    #[test]
    fn what_was_made_for_words_is_known_by_them() {
        let mut world = World::new();
        let made = |name: &str, tag: &str| {
            Asset::new(name, EntityKind::Prop, Shape::cuboid(1.0, 1.0, 2.0)).tagged([tag])
        };
        let mut add = |asset: Asset| {
            let id = world.add_asset(asset.clone()).unwrap();
            world.spawn(asset.at(id, Pose::identity())).unwrap()
        };
        let stone = add(made("obelisk_00ab12cd34ef", "stone"));
        add(made("a_marble_obelisk_1a2b3c4d", "marble"));
        add(made("dog_house_00ab12cd34ef", "kennel"));
        let said = |world: &World, words: &str| {
            let names = Names::new(world, Point2::origin(), 100.0);
            names.sort_of_asset(&lex(words)).map(|sort| (sort.asset.to_string(), sort.words))
        };
        let sort = |name: &str, words| Some((name.to_owned(), words));
        assert_eq!(said(&world, "obelisk red"), sort("obelisk", 1));
        assert_eq!(said(&world, "obelisks"), sort("obelisk", 1));
        assert_eq!(said(&world, "stone obelisk"), sort("stone_obelisk", 2));
        assert_eq!(said(&world, "wooden obelisk"), None, "there is none");
        assert_eq!(said(&world, "dog house"), sort("dog_house", 2));
        assert_eq!(said(&world, "house"), None, "a house is no dog house");
        world.remove(stone).unwrap();
        assert_eq!(said(&world, "stone obelisk"), None);
        assert_eq!(said(&world, "obelisk"), sort("obelisk", 1), "the other one is there");
    }
}
