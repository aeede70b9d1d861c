//! What an editor can add: a catalogue, with what is looked up in it for every sentence, made once.

use std::collections::{BTreeMap, BTreeSet};

use simworld_core::asset::{Asset, AssetError, Catalogue};
use simworld_core::command::Command;
use simworld_core::geometry::Point3;
use simworld_core::id::AssetId;
use simworld_core::scene::{EntityDesc, EntityKind, Scene, World};

use super::apply::Applier;
use super::error::EditError;
use crate::generation::Made;
use crate::retrieval::{AssetIndex, Choice, EmbedError, Meaning, telling};

/// Before a door one stands so far off, m.
const STEP: f64 = 0.5;
/// The longest name of an asset, and how much of its content address tells it from another of its name.
const NAME: usize = 64;
const ADDRESS: usize = 16;

/// A catalogue and its indices.
#[derive(Clone, Debug)]
pub(crate) struct Stock {
    pub(crate) catalogue: Catalogue,
    pub(crate) index: AssetIndex,
    /// Every word of a name or a tag.
    words: BTreeSet<String>,
    /// Names of several words by how they look when they are written as one.
    joined: BTreeMap<String, String>,
    /// The assets that were made for words, by those words.
    made: BTreeMap<String, String>,
    /// What is asked where words alone find nothing for sure, if somebody brought it.
    meaning: Option<Meaning>,
}

impl Stock {
    pub(crate) fn new(catalogue: Catalogue) -> Self {
        let index = AssetIndex::of(&catalogue);
        let (mut words, mut joined) = (BTreeSet::new(), BTreeMap::new());
        for (_, asset) in catalogue.iter() {
            words.extend(asset.name.split('_').map(str::to_owned));
            words.extend(asset.tags.iter().cloned());
            if asset.name.contains('_') {
                joined.entry(asset.name.replace('_', "")).or_insert_with(|| asset.name.clone());
            }
        }
        Self { catalogue, index, words, joined, made: BTreeMap::new(), meaning: None }
    }

    /// With an embedder that is asked where words alone find nothing for sure.
    pub(super) fn with_meaning(mut self, meaning: Option<Meaning>) -> Self {
        self.meaning = meaning;
        self
    }

    /// The embedder, for another catalogue.
    pub(super) fn meaning_anew(&self) -> Option<Meaning> {
        self.meaning.as_ref().map(Meaning::anew)
    }

    /// Keeps what was made for words from a prompt. Those words mean it from now on, and others that say the same of it find it
    /// as they find any asset.
    pub(super) fn keep(&mut self, said: String, prompt: &str, made: Made) -> Result<(), AssetError> {
        let asset = called_after(prompt, made);
        let name = asset.name.clone();
        let known = self.catalogue.len();
        let id = self.catalogue.add(asset)?;
        self.made.insert(said, name);
        if self.catalogue.len() > known {
            self.learn(id);
        }
        Ok(())
    }

    /// Takes a new asset into the indices. How rare a word is changes for all, so that the index is made anew; what was made took longer.
    fn learn(&mut self, id: AssetId) {
        let Some(asset) = self.catalogue.get(id) else { return };
        let name = asset.called();
        for said in std::iter::once(&name).chain(&asset.tags) {
            let parts: Vec<&str> = said.split([' ', '_', '-']).filter(|part| !part.is_empty()).collect();
            self.words.extend(parts.iter().map(|part| (*part).to_owned()));
            if parts.len() > 1 {
                self.joined.entry(parts.concat()).or_insert_with(|| parts.join("_"));
            }
        }
        self.meaning = self.meaning.as_ref().map(|meaning| meaning.grown(asset));
        self.index = AssetIndex::of(&self.catalogue);
    }

    /// What words mean: by themselves or, where they find nothing for sure, by what an embedder holds for near.
    ///
    /// # Errors
    /// The embedder fails.
    pub(crate) fn choose(&self, words: &str) -> Result<Choice, EmbedError> {
        match &self.meaning {
            Some(meaning) => meaning.choose(words, &self.index, &self.catalogue),
            None => Ok(self.index.choose(words)),
        }
    }

    /// Whether an asset was made for words.
    pub(crate) fn is_made(&self, asset: &Asset) -> bool {
        self.made.values().any(|made| *made == asset.name)
    }

    /// The asset that was made for words.
    pub(crate) fn made_for(&self, words: &str) -> Option<&str> {
        self.made.get(words).map(String::as_str)
    }

    /// Every word of a name or a tag, in order.
    pub(crate) fn words(&self) -> impl Iterator<Item = &str> {
        self.words.iter().map(String::as_str)
    }

    /// Whether a word is one of a name or a tag.
    pub(crate) fn has_word(&self, word: &str) -> bool {
        self.words.contains(word)
    }

    /// The name of several words that is written as one: `sportscar`.
    pub(crate) fn name_written_as(&self, word: &str) -> Option<&str> {
        let singular = || word.strip_suffix('s').and_then(|word| self.joined.get(word));
        self.joined.get(word).or_else(singular).map(String::as_str)
    }
}

/// What was made, with the words of its prompt among those by which people ask for it; not those that it does not show.
fn called_after(prompt: &str, made: Made) -> Asset {
    let Made { asset, unused } = made;
    let is_new = |word: &String| {
        let is_shown = !unused.iter().any(|unused| unused.eq_ignore_ascii_case(word));
        is_shown && asset.answers(&[word.as_str()]) == 0
    };
    let new: Vec<String> = telling(prompt).into_iter().filter(is_new).collect();
    asset.tagged(new)
}

impl Applier<'_> {
    /// The id that an asset has in the world, to which it is added where it is not there. Where the world has another one of its name,
    /// it is added under a name that ends with its content address. What no entity is made from has no effect, so that it may stay
    /// when the sentence fails.
    pub(super) fn stocked(&mut self, asset: &Asset) -> Result<Option<AssetId>, EditError> {
        let wanted = called_in(self.scene.world(), asset);
        if find(self.scene.world(), &wanted).is_none() {
            self.change(&Command::AddAsset(Box::new(wanted.clone())))?;
        }
        Ok(find(self.scene.world(), &wanted).map(|(id, _)| id))
    }
}

/// An asset under the name that it has in a world, or is to have: its own or, where the world has another one of that name, one that
/// ends with its content address.
pub(crate) fn called_in(world: &World, asset: &Asset) -> Asset {
    let mut wanted = asset.clone();
    if find(world, &wanted).is_some_and(|(_, is_same)| !is_same) {
        let address = asset.content_id().to_string();
        let kept = wanted.name.len().min(NAME - ADDRESS - 1);
        wanted.name = format!("{}_{}", &wanted.name[..kept], &address[..ADDRESS]);
    }
    wanted
}

/// The asset of a name in a world, and whether it is the same.
fn find(world: &World, wanted: &Asset) -> Option<(AssetId, bool)> {
    let assets = world.assets()?;
    let id = assets.find(&wanted.name)?;
    Some((id, assets.get(id) == Some(wanted)))
}

/// Where one stands to enter a new building, in its own frame: before the middle of its front.
pub(super) fn door_of(desc: &EntityDesc) -> Option<Point3> {
    let front = desc.info.shape.size().x * 0.5;
    (desc.kind == EntityKind::Building).then(|| Point3::new(front + STEP, 0.0, 0.0))
}

#[cfg(test)]
mod tests {
    use simworld_core::scene::Shape;

    use super::*;

    fn obelisk() -> Made {
        let asset = Asset::new("obelisk_00ab12cd34ef", EntityKind::Prop, Shape::cuboid(1.4, 1.4, 8.0));
        Made {
            asset: asset.tagged(["obelisk", "wooden", "needle stone"]),
            unused: vec!["candlelight".to_owned()],
        }
    }

    fn sure(stock: &Stock, words: &str) -> Option<String> {
        match stock.choose(words).unwrap() {
            Choice::Sure(hit) => Some(hit.name),
            Choice::Unsure(_) => None,
        }
    }

    #[test]
    fn what_was_made_is_found_by_other_words_that_say_the_same() {
        let mut stock = Stock::new(Catalogue::standard());
        assert_eq!(sure(&stock, "wooden obelisk"), None);
        let prompt = "a tall green wooden obelisk by candlelight";
        stock.keep(prompt.to_owned(), prompt, obelisk()).unwrap();
        let name = Some("obelisk_00ab12cd34ef");
        assert_eq!(stock.made_for(prompt), name);
        for words in ["obelisk", "wooden obelisk", "a tall obelisk", "green obelisks", "obelisk like that"] {
            assert_eq!(sure(&stock, words).as_deref(), name, "{words}");
        }
        assert_eq!(sure(&stock, "marble obelisk"), None, "it is none");
        assert_eq!(sure(&stock, "obelisk by candlelight"), None, "it does not show that");
    }

    #[test]
    fn the_words_of_what_was_made_are_known_to_the_spelling() {
        let mut stock = Stock::new(Catalogue::standard());
        assert!(!stock.has_word("obelisk"));
        stock.keep("an obelisk".to_owned(), "an obelisk", obelisk()).unwrap();
        assert!(stock.has_word("obelisk") && stock.has_word("needle"));
        assert!(!stock.has_word("00ab12cd34ef"), "an address is no word");
        assert_eq!(stock.name_written_as("needlestone"), Some("needle_stone"));
    }

    #[test]
    fn what_was_made_twice_is_kept_once() {
        let mut stock = Stock::new(Catalogue::standard());
        let before = stock.catalogue.len();
        for said in ["an obelisk", "one obelisk"] {
            stock.keep(said.to_owned(), "an obelisk", obelisk()).unwrap();
        }
        assert_eq!(stock.catalogue.len(), before + 1);
        assert!(stock.made_for("one obelisk").is_some());
    }
}
