//! The ways in which a sentence is understood, from the plainest to the boldest: as it stands, part by part, told in other words, by
//! the shape of its parts, with what its pronouns stand for, sentence by sentence.

use simworld_core::scene::Scene;
use simworld_core::seam::PlanError;

use super::super::clause::{Reference, Target};
use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{longest, longest_phrase};
use super::memo::Memo;
use super::parse::{Reader, UNDERSTOOD};
use super::parts::Telling;
use super::resolve::Finder;
use super::wish::{NewThing, Wish};
use super::words::{ABOUT_IT, WAYS, Way};
use super::{Focus, view_of};
use crate::editing::{Edit, EditError, Stock};

/// Places with which a sentence begins that puts something there.
#[rustfmt::skip]
const PLACES: &[&str] = &["next to", "in front of", "behind", "beside", "to the left of", "to the right of", "left of", "right of", "near", "close to", "opposite"];
/// Words for who speaks and who is spoken to.
const SELF: &[&str] = &["me", "myself", "i", "us", "you", "yourself"];

/// The wishes of a sentence, each in all its readings.
type Wishes = Vec<Vec<Wish>>;
/// A sentence in other words, with what was read of it.
type Retold = (Vec<Lexeme>, Memo);

/// That somebody has what a sentence asks for, and that what it is about first is there.
#[derive(Clone, Debug, Default)]
pub(super) struct Held {
    /// What its first wish comes to, if that is clear.
    pub(super) edits: Option<Vec<Edit>>,
}

/// The wishes of a sentence: as it stands or, if that is not understood, or asks for what nobody has or what is not there,
/// in some other way. What was found out of those that stand as they were said is kept, so that they are not worked out anew.
pub(super) fn wishes_of(
    reader: Reader<'_>,
    scene: &dyn Scene,
    stock: &Stock,
    focus: &Focus,
) -> Result<(Wishes, Option<Held>), PlanError> {
    let speaks_of_self = reader
        .lexemes
        .iter()
        .any(|lexeme| matches!(&lexeme.token, Token::Word(word) if SELF.contains(&word.as_str())));
    let is_place = longest(reader.lexemes, &WAYS).is_some_and(|(way, _)| {
        matches!(way, Way::To(_) | Way::Between | Way::Across | Way::Corner | Way::Middle | Way::Edge)
    });
    let is_side = longest(reader.lexemes, &ABOUT_IT).is_some_and(|(_, words)| words > 1);
    let begins_with_place = is_place || is_side || longest_phrase(reader.lexemes, PLACES).is_some();
    Attempts { reader, scene, stock, focus, speaks_of_self, begins_with_place }.wishes()
}

/// A sentence that is tried.
struct Attempts<'a> {
    reader: Reader<'a>,
    scene: &'a dyn Scene,
    stock: &'a Stock,
    focus: &'a Focus,
    speaks_of_self: bool,
    begins_with_place: bool,
}

impl Attempts<'_> {
    fn wishes(&self) -> Result<(Wishes, Option<Held>), PlanError> {
        if self.asks_how_to() || self.reader.is_about_texts() {
            return Err(self.reader.not_understood(UNDERSTOOD));
        }
        if let Some(nobody) = self.reader.unknown_somebody(2) {
            return Err(nobody);
        }
        let plain = plainly(&self.reader);
        if let Ok(wishes) = &plain
            && let Some(held) = self.held(wishes)
        {
            return plain.map(|wishes| (wishes, Some(held)));
        }
        self.boldly(plain).map(|wishes| (wishes, None))
    }

    /// In the other ways, where it is not understood as it stands.
    fn boldly(&self, plain: Result<Wishes, PlanError>) -> Result<Wishes, PlanError> {
        let in_parts = self.in_parts(&self.reader, Telling::Words);
        if let Some(wishes) = in_parts.as_ref().filter(|wishes| self.is_there(wishes)) {
            return Ok(wishes.clone());
        }
        let ways: Vec<Retold> =
            self.reader.retold().into_iter().map(|lexemes| (lexemes, Memo::default())).collect();
        let mut answer = None;
        let bolder = self
            .told_again(&ways, &mut answer)
            .or_else(|| self.by_shape(&self.reader))
            .or_else(|| ways.iter().find_map(|way| self.by_shape(&self.over(way))))
            .or_else(|| self.with_antecedents())
            .or_else(|| self.sentence_by_sentence(&ways))
            .or_else(|| self.told_again(&self.loosely(&ways), &mut None));
        if let Some(wishes) = bolder {
            return Ok(wishes);
        }
        // "Frida should come over here": nobody is called so, and nothing new either.
        if let Some(nobody) = self.reader.unknown_somebody(1) {
            return Err(nobody);
        }
        match answer.filter(|_| plain.is_err()) {
            Some(answer) => answer,
            None => self.at_last(plain, in_parts),
        }
    }

    /// "How do I get a wine stain out of a shirt?": a question that names nothing of the scene.
    fn asks_how_to(&self) -> bool {
        #[rustfmt::skip]
        const HOW_TO: &[&str] = &["how do i", "how do you", "how do we", "how do they", "how does one", "how does a", "how does the", "how did", "how can i", "how can you", "how can one", "how would i", "how would you", "how would one", "how should i", "how to", "how could i",
            "whats the best way to", "what is the best way to", "whats the easiest way to", "what is the easiest way to", "whats the quickest way to", "what is the quickest way to"];
        let lexemes = self.reader.lexemes;
        longest_phrase(lexemes, HOW_TO).is_some() && self.reader.names_nothing(0, lexemes.len())
    }

    fn in_parts(&self, reader: &Reader<'_>, telling: Telling) -> Option<Wishes> {
        reader.in_parts(&|wish| self.is_known(wish), &|wishes| self.is_there(wishes), telling)
    }

    /// In other words that mean the same; what is not there, or what nobody has, is noted as a better answer than that nothing is
    /// understood.
    fn told_again(&self, ways: &[Retold], answer: &mut Option<Result<Wishes, PlanError>>) -> Option<Wishes> {
        ways.iter().find_map(|way| {
            let reader = self.over(way);
            let plain = plainly(&reader);
            if plain.as_ref().is_ok_and(|wishes| self.holds(wishes)) {
                return plain.ok();
            }
            let in_parts = self.in_parts(&reader, Telling::Words).filter(|wishes| self.is_there(wishes));
            if !matches!(plain, Err(PlanError::NotUnderstood { .. })) {
                answer.get_or_insert(plain);
            }
            in_parts
        })
    }

    /// As it was said, and in other words, by the turns of people who speak loosely.
    fn loosely(&self, ways: &[Retold]) -> Vec<Retold> {
        let said = std::iter::once(self.reader.lexemes).chain(ways.iter().map(|(lexemes, _)| &lexemes[..]));
        said.filter_map(super::loose::in_plain_words).map(|lexemes| (lexemes, Memo::default())).collect()
    }

    /// By the shape of its parts. What is told along the way may have said where.
    fn by_shape(&self, reader: &Reader<'_>) -> Option<Wishes> {
        let found = self.in_parts(reader, Telling::Shape)?;
        (self.is_there(&found) && !found.iter().flatten().any(is_nowhere)).then_some(found)
    }

    fn with_antecedents(&self) -> Option<Wishes> {
        self.reader.with_antecedents(&|wish| self.is_known(wish), &|wishes| self.is_there(wishes))
    }

    fn sentence_by_sentence(&self, ways: &[Retold]) -> Option<Wishes> {
        let mut readers = std::iter::once(self.reader).chain(ways.iter().map(|way| self.over(way)));
        readers.find_map(|reader| {
            reader.of_sentences(&|wish| self.is_known(wish), &|wishes| self.is_there(wishes))
        })
    }

    /// What was read at first, where nothing better was found, or what is wrong with it.
    fn at_last(
        &self,
        plain: Result<Wishes, PlanError>,
        in_parts: Option<Wishes>,
    ) -> Result<Wishes, PlanError> {
        // What is told of a place first is not put anywhere else.
        let nowhere = |wishes: &Wishes| self.begins_with_place && wishes.iter().flatten().any(is_nowhere);
        match (plain, in_parts) {
            (Ok(wishes), _) if nowhere(&wishes) => Err(self.reader.not_understood("say where it is to go")),
            (Ok(wishes), _) | (Err(PlanError::NotUnderstood { .. }), Some(wishes)) => Ok(wishes),
            (Err(error), _) => {
                let unknown = |telling| self.reader.in_parts(&|_| true, &|_| true, telling);
                let has_parts = self.reader.lexemes.iter().rev().skip(1).any(is_mark);
                let by_shape = || {
                    let found = has_parts.then(|| unknown(Telling::Shape)).flatten()?;
                    (!found.iter().flatten().any(is_nowhere)).then_some(found)
                };
                let unknown = || unknown(Telling::Words).or_else(by_shape);
                let found = self.reader.complaint().or_else(unknown);
                let not_there = || match error {
                    PlanError::NotUnderstood { .. } => self.reader.stranger(),
                    _ => None,
                };
                found.ok_or_else(|| not_there().unwrap_or(error.clone()))
            }
        }
    }

    /// A reader of the same sentence in other words.
    fn over<'b>(&'b self, (lexemes, memo): &'b Retold) -> Reader<'b> {
        let Reader { words, names, view, .. } = self.reader;
        Reader { lexemes, memo, words, names, view, at: 0, depth: 0 }
    }

    /// Whether all wishes can be granted, as far as that is seen at once.
    fn holds(&self, wishes: &Wishes) -> bool {
        self.held(wishes).is_some()
    }

    /// What is found out of wishes that can all be granted, as far as that is seen at once.
    fn held(&self, wishes: &Wishes) -> Option<Held> {
        let are_known = wishes.iter().flatten().all(|wish| self.is_known(wish));
        are_known.then(|| self.there(wishes)).flatten()
    }

    /// Whether what the first wish is about is there. What later wishes are about may be made by earlier ones.
    fn is_there(&self, wishes: &[Vec<Wish>]) -> bool {
        self.there(wishes).is_some()
    }

    /// What the first wish comes to, if what it is about is there.
    fn there(&self, wishes: &[Vec<Wish>]) -> Option<Held> {
        let Self { scene, stock, focus, .. } = *self;
        // "In front of the place where you get books I'd like a rack": it does not stand anywhere.
        if self.begins_with_place && wishes.iter().flatten().any(is_nowhere) {
            return None;
        }
        let Some(readings) = wishes.first() else { return Some(Held::default()) };
        let finder = Finder { scene, stock, focus, view: view_of(scene, focus), settling: None };
        // The first reading that comes to edits counts, and one before it that is refused for another reason says that it is there.
        readings.iter().find_map(|wish| match finder.edits(wish) {
            Err(EditError::NotFound { .. }) => None,
            edits => Some(Held { edits: edits.ok() }),
        })
    }

    fn is_known(&self, wish: &Wish) -> bool {
        is_known(wish, self.stock, self.speaks_of_self)
    }
}

/// Whether somebody has what a wish asks for, whatever it stands on; and whether it moves nobody who is not spoken of.
pub(super) fn is_known(wish: &Wish, stock: &Stock, speaks_of_self: bool) -> bool {
    let is_new = |thing: &NewThing| thing.make(stock).is_ok();
    let is_viewer =
        |what: &Reference| what.target == Target::Here || ["we", "us"].contains(&what.text.as_str());
    match wish {
        // "Get a bench for the kids" moves nobody.
        Wish::Move { what, .. } => speaks_of_self || !what.iter().any(is_viewer),
        Wish::Add { things, .. } => things.iter().all(is_new),
        Wish::Replace { with: thing, .. } | Wish::Row { thing, .. } => is_new(thing),
        Wish::When { then, .. }
        | Wish::WhenPassage { then, .. }
        | Wish::WhenLarger { then, .. }
        | Wish::Given { then, .. } => is_known(then, stock, speaks_of_self),
        Wish::All(wishes) => wishes.iter().all(|wish| is_known(wish, stock, speaks_of_self)),
        _ => true,
    }
}

/// Whether something new is to stand nowhere in particular.
pub(super) fn is_nowhere(wish: &Wish) -> bool {
    matches!(wish, Wish::Add { at, .. } if at.is_empty())
}

/// As it stands.
fn plainly(reader: &Reader<'_>) -> Result<Wishes, PlanError> {
    Reader { ..*reader }.sentence()
}
