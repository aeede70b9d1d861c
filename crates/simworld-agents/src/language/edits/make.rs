//! The thing of the catalogue that words ask for.

use simworld_core::asset::{Asset, Catalogue};
use simworld_core::scene::EntityKind;

use super::super::lexer::lex;
use super::super::lexicon::category;
use super::wish::NewThing;
use super::words::HARMLESS;
use crate::editing::{EditError, Make};

impl NewThing {
    /// The asset that the words ask for: its name, its kind or one of its tags is the noun, and it answers to all other
    /// words that mean something.
    pub(super) fn make(&self, catalogue: &Catalogue) -> Result<Make, EditError> {
        let words: Vec<&str> = self.words.iter().map(String::as_str).collect();
        for from in 0..words.len() {
            let (said, noun) = words.split_at(from);
            let mut fitting = assets_called(catalogue, noun);
            if fitting.is_empty() {
                continue;
            }
            let modifiers: Vec<&str> = said.iter().copied().filter(|word| !HARMLESS.contains(word)).collect();
            fitting.retain(|asset| asset.answers(&modifiers) == modifiers.len());
            // "A big lorry" is one of the large ones, and no larger than that.
            let is_large = |asset: &&&Asset| self.scale > 1.0 && asset.tags.iter().any(|tag| tag == "large");
            if let Some(asset) = fitting.iter().find(is_large).or(fitting.first()) {
                let scale = if is_large(&asset) { 1.0 } else { self.scale };
                let color = self.paint.map(super::super::paint::Paint::color);
                return Ok(Make { asset: asset.name.clone(), color, scale, name: self.name.clone() });
            }
            let near = format!(
                "nothing here is {}; say it without, or name it by colour and size",
                modifiers.join(" ")
            );
            return Err(EditError::UnknownThing { wanted: self.text.clone(), near });
        }
        let names: Vec<&str> = catalogue.iter().map(|(_, asset)| asset.name.as_str()).collect();
        let near = format!("it has {}", names.join(", "));
        Err(EditError::UnknownThing { wanted: words.join(" "), near })
    }
}

/// The assets that a noun of all these words may mean, the plainest first.
fn assets_called<'a>(catalogue: &'a Catalogue, noun: &[&str]) -> Vec<&'a Asset> {
    let spellings = singulars(&noun.join("_"));
    let named = |asset: &&Asset| spellings.contains(&asset.name);
    let all = || catalogue.iter().map(|(_, asset)| asset);
    let mut found: Vec<&Asset> = all().filter(named).collect();
    let lexemes = lex(&noun.join(" "));
    if let Some((class, _)) = category(&lexemes).filter(|(_, count)| *count == lexemes.len()) {
        let kinds = class.kinds();
        let mut of_kind: Vec<&Asset> = all().filter(|asset| kinds.contains(&asset.kind)).collect();
        // The one that is called as its kind is comes first: "a car" is no sports car.
        of_kind.sort_by_key(|asset| asset.name != asset.kind.as_str());
        found.extend(of_kind);
    }
    if found.is_empty() {
        let tagged = |asset: &&Asset| asset.tags.iter().any(|tag| spellings.contains(&tag.replace(' ', "_")));
        found.extend(all().filter(tagged).filter(|asset| asset.kind != EntityKind::Building));
    }
    found
}

/// A word and what it may be the plural of.
fn singulars(word: &str) -> Vec<String> {
    let mut all = vec![word.to_owned()];
    all.extend(word.strip_suffix('s').map(str::to_owned));
    all.extend(word.strip_suffix("es").map(str::to_owned));
    all.extend(word.strip_suffix("ies").map(|stem| format!("{stem}y")));
    all
}
