//! What an editor can add: a catalogue, with what is looked up in it for every sentence, made once.

use std::collections::{BTreeMap, BTreeSet};

use simworld_core::asset::{Asset, AssetError, Catalogue};
use simworld_core::command::Command;
use simworld_core::geometry::Point3;
use simworld_core::id::AssetId;
use simworld_core::scene::{EntityDesc, EntityKind, Scene, World};

use super::apply::Applier;
use super::error::EditError;
use crate::retrieval::AssetIndex;

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
}

impl Stock {
    pub(super) fn new(catalogue: Catalogue) -> Self {
        let index = AssetIndex::of(&catalogue);
        let (mut words, mut joined) = (BTreeSet::new(), BTreeMap::new());
        for (_, asset) in catalogue.iter() {
            words.extend(asset.name.split('_').map(str::to_owned));
            words.extend(asset.tags.iter().cloned());
            if asset.name.contains('_') {
                joined.entry(asset.name.replace('_', "")).or_insert_with(|| asset.name.clone());
            }
        }
        Self { catalogue, index, words, joined, made: BTreeMap::new() }
    }

    /// Keeps an asset that was made for words; those words mean it from now on.
    pub(super) fn keep(&mut self, words: String, asset: Asset) -> Result<(), AssetError> {
        let name = asset.name.clone();
        self.catalogue.add(asset)?;
        self.made.insert(words, name);
        Ok(())
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

impl Applier<'_> {
    /// The id that an asset has in the world, to which it is added where it is not there. Where the world has another one of its name,
    /// it is added under a name that ends with its content address. What no entity is made from has no effect, so that it may stay
    /// when the sentence fails.
    pub(super) fn stocked(&mut self, asset: &Asset) -> Result<Option<AssetId>, EditError> {
        let mut wanted = asset.clone();
        if find(self.scene.world(), &wanted).is_some_and(|(_, is_same)| !is_same) {
            let address = asset.content_id().to_string();
            let kept = wanted.name.len().min(NAME - ADDRESS - 1);
            wanted.name = format!("{}_{}", &wanted.name[..kept], &address[..ADDRESS]);
        }
        if find(self.scene.world(), &wanted).is_none() {
            self.change(&Command::AddAsset(Box::new(wanted.clone())))?;
        }
        Ok(find(self.scene.world(), &wanted).map(|(id, _)| id))
    }
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
