//! Things that are farther one way than another, or larger: "how many benches are further west than the maple?", "list the trees taller than the
//! lamp".
//!
//! Which they are is found in the scene and put into the words before they are read. It is asked so, or said of several that are to go or to be
//! painted; "move the bench further west than the maple" says where.

use simworld_core::id::EntityId;
use simworld_core::scene::EntityRef;

use super::super::compass::{Compass, DIRECTIONS};
use super::super::lexer::{Lexeme, Token, is_mark, word_of};
use super::super::lexicon::{longest, longest_phrase};
use super::super::paint::PAINTS;
use super::super::phrases::Phrases;
use super::follow::plural_of;
use super::forms::{word_at, words_at};
use super::parse::Reader;
use super::resolve::Finder;
use super::words::{VERBS, Verb};

/// Level is what differs by less, m, and as large what differs by less than this share.
const LEVEL: f64 = 0.05;
const ALIKE: f64 = 0.01;
/// Before a direction.
#[rustfmt::skip]
const FURTHER: &Phrases = &Phrases::of(&["further", "farther", "more", "further to the", "farther to the", "more to the", "further in the", "farther in the", "further towards the", "farther towards the", "further over to the", "further out to the", "further up", "further down"]);
/// Between a noun and what is said of it.
#[rustfmt::skip]
const COPULAS: &Phrases = &Phrases::of(&["are", "is", "stand", "stands", "lie", "lies", "sit", "sits", "grow", "grows", "are standing", "that are", "that is", "thats", "which are", "which is", "that stand", "that stands", "which stand", "which stands", "that lie", "that lies", "which lie", "which lies", "standing", "lying", "located"]);
/// Of all of whom it is said.
#[rustfmt::skip]
const ALL: &Phrases = &Phrases::of(&["all the", "all of the", "of the", "all", "every", "each", "any", "the", "those", "all those"]);

/// By what things are compared.
#[derive(Clone, Copy, PartialEq)]
enum By {
    /// How far they are in a direction.
    Compass(Compass),
    /// How tall they are or, with `false`, how short.
    Height(bool),
    /// How large, or small.
    Size(bool),
}

#[rustfmt::skip]
const SIZES: &[(&[&str], By)] = &[
    (&["taller", "higher"], By::Height(true)), (&["shorter", "lower"], By::Height(false)), (&["bigger", "larger"], By::Size(true)), (&["smaller"], By::Size(false)),
];

impl Reader<'_> {
    /// The words with the things themselves for "benches that are further west than the maple".
    pub(super) fn with_compared(&self, finder: &Finder<'_>) -> Option<Vec<Lexeme>> {
        let than = (3..self.lexemes.len()).find(|at| self.word(*at) == Some("than"))?;
        let (by, begin) = self.compared_by(than)?;
        let stop = self.before_copula(begin);
        let noun = (stop.saturating_sub(3)..stop)
            .find(|at| self.noun_at(*at).is_some_and(|words| at + words == stop))?;
        let paint = noun.checked_sub(1).filter(|at| longest(&self.lexemes[*at..noun], PAINTS).is_some());
        let noun = paint.unwrap_or(noun);
        let from = (noun.saturating_sub(3)..noun)
            .find(|at| longest_phrase(&self.lexemes[*at..noun], ALL) == Some(noun - at))
            .unwrap_or(noun);
        if !self.asks_or_means_several(from, noun, stop) {
            return None;
        }
        let (end, anchor) = self.anchor_at(than + 1, finder)?;
        // The mark behind it ends the sentence.
        let end = (than + 2..=end).rev().find(|end| !is_mark(&self.lexemes[end - 1]))?;
        let things = self.more_than((noun, stop), by, anchor, finder)?;
        let token = Token::Ids(things);
        let those =
            Lexeme { token, lemma: None, end: self.lexemes[end - 1].end, ..self.lexemes[from].clone() };
        let mut lexemes = self.lexemes.to_vec();
        lexemes.splice(from..end, [those]);
        Some(lexemes)
    }

    /// By what things are compared before "than", and where that begins.
    fn compared_by(&self, than: usize) -> Option<(By, usize)> {
        let whole = |from: usize, words: usize| from + words == than;
        if let Some((by, words)) = longest(&self.lexemes[than - 1..than], SIZES) {
            return whole(than - 1, words).then_some((by, than - 1));
        }
        (than.saturating_sub(6)..than).find_map(|at| {
            let further = at + longest_phrase(&self.lexemes[at..than], FURTHER)?;
            let (compass, words) = longest(&self.lexemes[further..than], DIRECTIONS)?;
            whole(further, words).then_some((By::Compass(compass), at))
        })
    }

    /// Where a noun ends before "that are" and the like.
    fn before_copula(&self, end: usize) -> usize {
        (end.saturating_sub(2)..end)
            .find(|at| longest_phrase(&self.lexemes[*at..end], COPULAS) == Some(end - at))
            .unwrap_or(end)
    }

    /// Whether things are asked about, or several are to go or to be painted.
    fn asks_or_means_several(&self, from: usize, noun: usize, stop: usize) -> bool {
        let verb = (from.saturating_sub(4)..from).find_map(|at| {
            longest(&self.lexemes[at..from], &VERBS)
                .filter(|(_, words)| at + words == from)
                .map(|(verb, _)| verb)
        });
        let is_several = || {
            let each = longest_phrase(&self.lexemes[from..noun], &["every", "each"]).is_some();
            each || self.word(stop - 1).is_some_and(|noun| noun.ends_with('s'))
        };
        match verb {
            Some(Verb::Count | Verb::List) => true,
            Some(Verb::Remove | Verb::Paint) => from < noun && is_several(),
            _ => false,
        }
    }

    /// Those of the things that a noun names that are more so than another.
    fn more_than(
        &self,
        (noun, stop): (usize, usize),
        by: By,
        anchor: EntityId,
        finder: &Finder<'_>,
    ) -> Option<Vec<EntityId>> {
        let (last, head) = self.lexemes.get(noun..stop)?.split_last()?;
        let said = word_of(last);
        let is_plural = said.ends_with('s') || ["people", "men", "women", "children"].contains(&said);
        let plural = if is_plural { said.to_owned() } else { plural_of(said) };
        let all: Vec<Lexeme> =
            words_at(last, "all the").chain(head.iter().cloned()).chain([word_at(last, &plural)]).collect();
        let memo = super::memo::Memo::default();
        let all = Reader { memo: &memo, ..self.over(&all) }.one_of(0, all.len()).ok()?;
        let than = self.view.scene.entity(anchor)?;
        let is_more = |id: &EntityId| {
            *id != anchor && self.view.scene.entity(*id).is_some_and(|thing| by.is_more(&thing, &than))
        };
        Some(finder.all(&[all]).ok()?.into_iter().filter(is_more).collect())
    }
}

impl By {
    /// Whether one thing is more so than another.
    fn is_more(self, one: &EntityRef<'_>, other: &EntityRef<'_>) -> bool {
        let height = |thing: &EntityRef<'_>| thing.info.shape.size().z;
        let volume = |thing: &EntityRef<'_>| {
            let size = thing.info.shape.size();
            size.x * size.y * size.z
        };
        let larger = |one: f64, other: f64| one > other * (1.0 + ALIKE);
        match self {
            Self::Compass(compass) => (one.planar() - other.planar()).dot(&compass.step()) > LEVEL,
            Self::Height(true) => larger(height(one), height(other)),
            Self::Height(false) => larger(height(other), height(one)),
            Self::Size(true) => larger(volume(one), volume(other)),
            Self::Size(false) => larger(volume(other), volume(one)),
        }
    }
}
