//! The thing of the catalogue that words ask for.

use simworld_core::asset::{Asset, Season};

use super::super::lexer::lex;
use super::super::lexicon::category;
use super::super::sorts::singulars;
use super::wish::NewThing;
use super::words::HARMLESS;
use crate::editing::{EditError, Make, Stock};
use crate::retrieval::{Choice, Hit, Matched};
use simworld_core::scene::EntityKind;

impl NewThing {
    /// The asset that the words ask for: its name or its kind is the noun, and it answers to all other words that mean
    /// something; or else the one that a search is sure of.
    pub(super) fn make(&self, stock: &Stock) -> Result<Make, EditError> {
        self.made(stock).map_err(|error| match error {
            // "Spaceship" is not told as "space ship".
            EditError::UnknownThing { wanted, near } if !self.text.to_lowercase().contains(&wanted) => {
                EditError::UnknownThing { wanted: self.text.clone(), near }
            }
            error => error,
        })
    }

    fn made(&self, stock: &Stock) -> Result<Make, EditError> {
        if let Some(made) = stock.made_for(&self.text) {
            return Ok(Make { name: self.name.clone(), ..Make::of(made) });
        }
        let (season, mut words) = self.season();
        // A light that somebody asks for is a lamp; traffic lights are called so.
        if let [.., last] = &mut words[..]
            && ["light", "lights"].contains(last)
            && !self
                .words
                .iter()
                .any(|word| ["traffic", "stop", "pedestrian", "signal"].contains(&word.as_str()))
        {
            *last = "lamp";
        }
        if let [.., last] = &mut words[..]
            && let Some(plain) = super::nicknames::plainly(last, stock)
        {
            *last = plain;
        }
        if let Some(asset) = self.called_by_size(&words, stock) {
            return Ok(self.made_from(asset, self.scale_of(&asset.name, 1.0, stock), season));
        }
        match self.by_noun(&words, stock) {
            Ok((asset, scale)) => Ok(self.made_from(asset, self.scale_of(&asset.name, scale, stock), season)),
            Err(left_over) => {
                let asset = self.by_search(&words, left_over, stock)?;
                // "A big obelisk" that was made is as big as that.
                let is_so =
                    |word: String| LARGE_OR_SMALL.contains(&word.as_str()) && asset.tags.contains(&word);
                let is_sized = stock.is_made(asset) && self.words_of_size().any(is_so);
                let scale = if is_sized { 1.0 } else { self.scale };
                Ok(self.made_from(asset, self.scale_of(&asset.name, scale, stock), season))
            }
        }
    }

    /// "A small cone" is one of those that are called so.
    fn called_by_size<'a>(&self, words: &[&str], stock: &'a Stock) -> Option<&'a Asset> {
        let sized = |size: &&&str| self.words_of_size().any(|word| word == ***size);
        let (last, head) = words.split_last()?;
        let named = |size: &str, last: &str| {
            let name = [&[size], head, &[last]].concat().join("_");
            stock.catalogue.get(stock.catalogue.find(&name)?)
        };
        let sizes = ["small", "big", "large", "tiny", "mini", "giant", "huge", "little"];
        sizes.iter().filter(sized).find_map(|size| singulars(last).find_map(|last| named(size, &last)))
    }

    /// The asset whose name or kind is the noun and which answers to all other words, and its scale; else the words to which none of
    /// those that are called so answers.
    fn by_noun<'a>(&self, words: &[&str], stock: &'a Stock) -> Result<(&'a Asset, f64), Option<String>> {
        let found = (0..words.len()).find_map(|from| {
            let (said, noun) = words.split_at(from);
            let fitting = assets_called(stock, noun);
            (!fitting.is_empty()).then_some((said, fitting))
        });
        let Some((said, mut fitting)) = found else { return Err(None) };
        let modifiers: Vec<&str> = said.iter().copied().filter(|word| !HARMLESS.contains(word)).collect();
        fitting.retain(|asset| asset.answers(&modifiers) == modifiers.len());
        // "A big lorry" is one of the large ones, and no larger than that.
        let is_large = |asset: &&&Asset| self.scale > 1.0 && asset.tags.iter().any(|tag| tag == "large");
        let asset = fitting.iter().find(is_large).or(fitting.first());
        let asset = asset.ok_or_else(|| Some(modifiers.join(" ")))?;
        Ok((asset, if is_large(&asset) { 1.0 } else { self.scale }))
    }

    /// The asset that a search is sure of: by the words, or by what they mean where somebody brought an embedder. Of a noun that is
    /// known nothing that is said may be left over, so that its words alone are searched for.
    fn by_search<'a>(
        &self,
        words: &[&str],
        left_over: Option<String>,
        stock: &'a Stock,
    ) -> Result<&'a Asset, EditError> {
        let said: Vec<&str> = words.iter().copied().filter(|word| !HARMLESS.contains(word)).collect();
        let said = said.join(" ");
        let by_words = || stock.index.choose(&said);
        let (choice, fault) = match left_over {
            Some(_) => (by_words(), None),
            None => {
                stock.choose(&said).map_or_else(|fault| (by_words(), Some(fault)), |choice| (choice, None))
            }
        };
        match (choice, left_over) {
            // "A hat" is nobody who wears one.
            (Choice::Sure(hit), _) if is_worn(&hit, stock) => Err(unknown(words, near(&[], stock))),
            (Choice::Sure(hit), _) => {
                stock.catalogue.get(hit.asset).ok_or_else(|| unknown(words, near(&[], stock)))
            }
            (Choice::Unsure(_), Some(modifiers)) => {
                let near =
                    format!("nothing here is {modifiers}; say it without, or name it by colour and size");
                Err(EditError::UnknownThing { wanted: self.text.clone(), near })
            }
            // "A soda" is any of those that are told apart by a number or an address alone.
            (Choice::Unsure(hits), None) => hits
                .first()
                .filter(|_| are_one(&hits, stock))
                .and_then(|hit| stock.catalogue.get(hit.asset))
                .ok_or_else(|| {
                    let fault = fault.map_or_else(String::new, |fault| format!("; {fault}"));
                    unknown(words, near(&hits, stock) + &fault)
                }),
        }
    }

    /// The words that are no noun, as they were said.
    fn words_of_size(&self) -> impl Iterator<Item = String> {
        let said = if self.scale == 1.0 { "" } else { self.text.as_str() };
        said.split_whitespace().map(str::to_lowercase).collect::<Vec<_>>().into_iter()
    }

    /// The words from which a generator may make it: without how many, and what it is called.
    pub(super) fn prompt(&self) -> &str {
        let text = self.text.as_str();
        let end = [" called ", " named ", " with the name "].iter().filter_map(|word| text.find(word)).min();
        let text = &text[..end.unwrap_or(text.len())];
        if self.count > 1 { text.split_once(' ').map_or(text, |(_, rest)| rest) } else { text }
    }

    fn made_from(&self, asset: &Asset, scale: f64, season: Option<Season>) -> Make {
        let of_season = season.filter(|_| asset.seasons.is_some()).and_then(|season| asset.color_in(season));
        let color = self.paint.map(super::super::paint::Paint::color).or(of_season);
        Make { asset: asset.name.clone(), color, scale, name: self.name.clone() }
    }

    /// The season that is asked for, and the other words: "an autumn maple", "a birch in winter".
    fn season(&self) -> (Option<Season>, Vec<&str>) {
        let of = |word: &str| {
            Season::ALL
                .into_iter()
                .find(|season| season.as_str() == word || word == "fall" && *season == Season::Autumn)
        };
        let words: Vec<&str> = self.words.iter().map(String::as_str).collect();
        match words.iter().find_map(|word| of(word)) {
            Some(season) if words.len() > 1 => {
                (Some(season), words.into_iter().filter(|word| of(word).is_none() && *word != "in").collect())
            }
            _ => (None, words),
        }
    }
}

/// Whether a search found somebody by what they have on.
fn is_worn(hit: &Hit, stock: &Stock) -> bool {
    let is_person = stock.catalogue.get(hit.asset).is_some_and(|asset| asset.kind == EntityKind::Person);
    let in_name = |(_, matched): &(String, Matched)| *matched != Matched::Tag;
    is_person
        && !hit.because.iter().any(in_name)
        && hit.because.iter().any(|(word, _)| WORN.contains(&word.as_str()))
}

/// Words of size, which a generator heeds by itself.
#[rustfmt::skip]
const LARGE_OR_SMALL: &[&str] = &["huge", "giant", "gigantic", "enormous", "massive", "big", "large", "great", "small", "little", "mini", "tiny", "miniature"];

/// What people wear or carry.
const WORN: &[&str] =
    &["hat", "helmet", "vest", "uniform", "coat", "suit", "apron", "bag", "backpack", "hardhat", "hard"];

fn unknown(words: &[&str], near: String) -> EditError {
    EditError::UnknownThing { wanted: words.join(" "), near }
}

/// What people call what was found.
fn called(hit: &Hit, stock: &Stock) -> String {
    stock.catalogue.get(hit.asset).map_or_else(|| hit.name.replace('_', " "), Asset::called)
}

/// Whether all that was found is called the same but for a number, or for the address of what was made.
fn are_one(hits: &[Hit], stock: &Stock) -> bool {
    let stem = |hit: &Hit| {
        let called = called(hit, stock);
        called.trim_end_matches(|letter: char| letter.is_ascii_digit()).trim_end().to_owned()
    };
    let first = hits.first().map(stem);
    // "A grand piano" is none of the buildings that are grand.
    let fits = |hit: &Hit| hit.is_whole || hit.because.iter().any(|(_, by)| *by == Matched::Meaning);
    let is_so = |hit: &Hit| fits(hit) && Some(stem(hit)) == first && stem(hit) != hit.name.replace('_', " ");
    hits.len() > 1 && hits.iter().all(is_so)
}

/// What an answer says of what is near.
fn near(hits: &[Hit], stock: &Stock) -> String {
    let mut names: Vec<String> = Vec::new();
    for name in hits.iter().map(|hit| called(hit, stock)) {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    match &names[..] {
        [] => "nothing in it is called so; say what it looks like, or what it is for".to_owned(),
        [only] => format!("the nearest is {only}; say that if it will do"),
        [head @ .., last] => format!("near are {} and {last}; say which will do", head.join(", ")),
    }
}

/// The assets that a noun of all these words may mean, the plainest first.
fn assets_called<'a>(stock: &'a Stock, noun: &[&str]) -> Vec<&'a Asset> {
    let catalogue = &stock.catalogue;
    let spellings: Vec<String> = singulars(&noun.join("_")).collect();
    let found = spellings.iter().filter_map(|name| catalogue.get(catalogue.find(name)?));
    let mut found: Vec<&Asset> = found.collect();
    let lexemes = lex(&noun.join(" "));
    if let Some((class, _)) = category(&lexemes).filter(|(_, count)| *count == lexemes.len()) {
        let kinds = class.kinds();
        let all = catalogue.iter().map(|(_, asset)| asset);
        let mut of_kind: Vec<&Asset> = all.filter(|asset| kinds.contains(&asset.kind)).collect();
        // The one that is called as its kind is comes first: "a car" is no sports car.
        of_kind.sort_by_key(|asset| asset.name != asset.kind.as_str());
        // "A fire truck" is a fire engine, and not any truck.
        let narrower = found.is_empty().then(|| stock.index.choose(&noun.join(" ")));
        let meant = match narrower {
            Some(Choice::Sure(hit)) => catalogue.get(hit.asset).filter(|asset| {
                // "A postbox" is as plain as "a letter box", and "a hatchback" is a small car.
                let is_plain =
                    noun.len() == 1 && class.words.contains(&asset.name.replace('_', " ").as_str());
                kinds.contains(&asset.kind) && !is_plain
            }),
            _ => None,
        };
        found.extend(meant);
        found.extend(of_kind);
    }
    found
}
