//! Several that are nearest to something: "the two benches nearest to the fountain", "the three lamps closest to Ada".
//!
//! Which they are is found in the scene and put into the words before they are read. If the last of them is no nearer than the next that
//! is left out, nothing decides, and the words stay as they are.

use simworld_core::id::EntityId;

use super::super::lexer::{Lexeme, Token};
use super::super::lexicon::{category, longest_phrase};
use super::super::numbers;
use super::super::phrases::Phrases;
use super::super::relate::gap;
use super::follow::plural_of;
use super::forms::{word, word_at, words_at};
use super::parse::Reader;
use super::resolve::Finder;

/// As near is what differs by less, m.
const ALIKE: f64 = 0.05;
/// What something is nearest to has no more words than that.
const LONGEST: usize = 6;
#[rustfmt::skip]
const NEAREST: &Phrases = &Phrases::of(&["nearest to", "closest to", "nearest", "closest", "that are nearest to", "that are closest to", "which are nearest to", "which are closest to", "that stand nearest to", "that stand closest to", "thats nearest to", "thats closest to", "standing nearest to", "standing closest to"]);

impl Reader<'_> {
    /// The words with the things themselves for "the two benches nearest to the fountain".
    pub(super) fn with_several_nearest(&self, finder: &Finder<'_>) -> Option<Vec<Lexeme>> {
        (0..self.lexemes.len().saturating_sub(4)).find_map(|at| {
            let the = longest_phrase(&self.lexemes[at..], &["the", "those", "these", "both"])?;
            let (count, number) = numbers::count(&self.lexemes[at + the..])?;
            let noun = at + the + number;
            let words = self.noun_at(noun)?;
            let behind = noun + words;
            let nearest = behind + longest_phrase(self.lexemes.get(behind..)?, NEAREST)?;
            let (end, anchor) = self.anchor_at(nearest, finder)?;
            let things = self.nearest_of((noun, words), count as usize, anchor, finder)?;
            let place = self.lexemes[at].clone();
            let token = Token::Ids(things);
            let those = Lexeme { token, lemma: None, end: self.lexemes[end - 1].end, ..place };
            let mut lexemes = self.lexemes.to_vec();
            lexemes.splice(at..end, [those]);
            Some(lexemes)
        })
    }

    /// How many words a noun of things has that stands here.
    pub(super) fn noun_at(&self, at: usize) -> Option<usize> {
        let rest = self.lexemes.get(at..)?;
        category(rest)
            .map(|(_, words)| words)
            .or_else(|| super::follow::species(rest.first()?).map(|_| 1))
            .filter(|words| *words > 0)
    }

    /// What something is near that is named here, if it is one thing, and where its name ends.
    pub(super) fn anchor_at(&self, from: usize, finder: &Finder<'_>) -> Option<(usize, EntityId)> {
        let most = self.lexemes.len().min(from + LONGEST);
        (from + 1..=most).rev().find_map(|end| {
            let anchor = self.one_of(from, end).ok()?;
            let found = finder.all(&[anchor]).ok()?;
            if let [only] = found[..] { Some((end, only)) } else { None }
        })
    }

    /// So many of such things as are nearest to another.
    fn nearest_of(
        &self,
        (noun, words): (usize, usize),
        count: usize,
        anchor: EntityId,
        finder: &Finder<'_>,
    ) -> Option<Vec<EntityId>> {
        let place = &self.lexemes[noun];
        let (last, head) = self
            .last_noun(noun, noun + words)?
            .split_last()
            .map(|(last, head)| (last.clone(), head.to_vec()))?;
        let plural = plural_of(word(std::slice::from_ref(&last), 0));
        let all: Vec<Lexeme> =
            words_at(place, "all the").chain(head).chain([word_at(place, &plural)]).collect();
        let memo = super::memo::Memo::default();
        let all = Reader { memo: &memo, ..self.over(&all) }.one_of(0, all.len()).ok()?;
        let near = self.view.scene.entity(anchor)?;
        let mut ranked: Vec<(f64, EntityId)> = finder
            .all(&[all])
            .ok()?
            .into_iter()
            .filter(|id| *id != anchor)
            .filter_map(|id| Some((gap(&near, &self.view.scene.entity(id)?), id)))
            .collect();
        ranked.sort_by(|one, other| one.0.total_cmp(&other.0));
        let decides =
            ranked.len() == count || ranked.len() > count && ranked[count].0 - ranked[count - 1].0 > ALIKE;
        (count > 1 && decides).then(|| ranked[..count].iter().map(|(_, id)| *id).collect())
    }
}
