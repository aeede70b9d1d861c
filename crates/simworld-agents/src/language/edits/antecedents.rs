//! What a pronoun stands for where what was told before is no remark that is known: "Gus would kill for a coffee: a coffee cup by his
//! side", "Eve dropped her ice cream, bless her; put a bin next to her".
//!
//! This is tried where a sentence is not understood otherwise. The words behind a mark are read by themselves, with what was told of before
//! the mark in the place of their pronouns. What stands before the mark may tell anything, but orders nothing, sets no condition and
//! takes nothing back; it names what the pronoun stands for, somebody for "him" and a thing for "it".

use super::super::clause::{Reference, Target};
use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::longest_phrase;
use super::super::phrases::Phrases;
use super::forms::word_at;
use super::parse::Reader;
use super::parts::Telling;
use super::told::ORDERS_ANYTHING;
use super::wish::Wish;

/// As many marks are tried.
const MOST_MARKS: usize = 3;
/// By these what stands before a mark asks for something, or changes what is asked for.
#[rustfmt::skip]
const ASKS: &Phrases = &Phrases::of(&["if", "unless", "until", "except", "instead", "i mean", "i meant", "scratch that", "no wait", "wait no", "correction", "undo", "never mind", "forget it", "please", "could you", "can you", "would you", "will you", "how about", "what about", "why not", "should", "must", "ought", "shall",
    "lets", "let us", "has to be", "have to be", "has to go", "have to go", "needs to be", "needs to go", "is to be", "are to be", "rather than", "only", "not the", "as well", "too"]);
/// Words for somebody.
const SOMEBODY: &[&str] = &["him", "her", "he", "she"];
/// Words for a thing.
const SOMETHING: &[&str] = &["it", "that", "this"];
/// Words for several.
const SEVERAL: &[&str] = &["them", "those", "they", "both"];
/// What may stand for what.
struct Told {
    somebody: Vec<Vec<Lexeme>>,
    something: Option<Vec<Lexeme>>,
    all: Vec<Vec<Lexeme>>,
    noun: Option<Vec<Lexeme>>,
}

impl Reader<'_> {
    /// The wishes behind a mark, with what was told of before it in the place of their pronouns.
    pub(super) fn with_antecedents(
        &self,
        is_known: &dyn Fn(&Wish) -> bool,
        is_there: &dyn Fn(&[Vec<Wish>]) -> bool,
    ) -> Option<Vec<Vec<Wish>>> {
        let marks = (2..self.lexemes.len().saturating_sub(2)).filter(|at| is_mark(&self.lexemes[*at]));
        marks.take(MOST_MARKS).find_map(|mark| {
            let told = self.told_up_to(mark)?;
            let order = told.put_into(&self.lexemes[mark + 1..])?;
            let memo = super::memo::Memo::default();
            let reader = Reader { lexemes: &order, at: 0, memo: &memo, ..*self };
            let plain = Reader { ..reader }.sentence().ok();
            let plain = plain.filter(|wishes| wishes.iter().flatten().all(is_known) && is_there(wishes));
            let found = plain.or_else(|| {
                reader.in_parts(is_known, is_there, Telling::Words).filter(|wishes| is_there(wishes))
            })?;
            let is_nowhere = |wish: &Wish| matches!(wish, Wish::Add { at, .. } if at.is_empty());
            (!found.iter().flatten().any(is_nowhere)).then_some(found)
        })
    }

    /// What is told of before a mark, if that orders nothing.
    fn told_up_to(&self, mark: usize) -> Option<Told> {
        let words = &self.lexemes[..mark];
        let asks = (0..mark).any(|at| {
            let begins = at == 0 || is_mark(&self.lexemes[at - 1]);
            longest_phrase(&words[at..], ASKS).is_some()
                || begins && longest_phrase(&words[at..], ORDERS_ANYTHING).is_some()
        });
        let tells = self.tells_with_verb(0, mark)
            || (1..mark).any(|at| self.word(at).is_some_and(super::remarks::is_state));
        if asks || self.orders_here(0, mark) || !tells {
            return None;
        }
        let mut told = Told { somebody: Vec::new(), something: None, all: Vec::new(), noun: None };
        let mut at = 0;
        while at < mark {
            // "Fay's legs are tired": of Fay.
            if let Some(owner) = self.owner_at(at) {
                told.somebody.push(owner);
                at += 2;
                continue;
            }
            let Some((thing, after)) = self.named_at(at, mark) else {
                at += 1;
                continue;
            };
            let said = words[at..after].to_vec();
            // "There's a helicopter in the park": it is not the park, nor is it known.
            let is_unknown = (0..at).any(|at| matches!(self.word(at), Some("a" | "an" | "some" | "another")));
            let is_somebody = self.is_somebody(&thing);
            if is_unknown && !is_somebody {
                at = after;
                continue;
            }
            if is_somebody {
                told.somebody.push(said.clone());
            } else {
                told.something.get_or_insert_with(|| said.clone());
            }
            told.all.push(said);
            at = after;
        }
        // "My boys are mad about dinosaurs, put one here" makes no boy.
        let noun = self.noun_lacking(0, mark).or_else(|| self.asset_in(0, mark));
        told.noun = noun.filter(|noun| !super::follow::is_crowd(noun));
        Some(told)
    }

    /// Somebody whose something is named here: "Fay's".
    fn owner_at(&self, at: usize) -> Option<Vec<Lexeme>> {
        let lexeme = &self.lexemes[at];
        let written = self.words.get(lexeme.start..lexeme.end)?;
        let is_owner = written.ends_with("'s") || written.ends_with("’s");
        let stem = self.word(at)?.strip_suffix('s').filter(|_| is_owner)?;
        let owner = vec![word_at(lexeme, stem)];
        let (ids, _) = self.names.exact(&owner)?;
        self.is_somebody(&Reference::to(Target::Named(ids), stem.to_owned())).then_some(owner)
    }
}

impl Told {
    /// The words of an order with what was told of for their pronouns; none if they have no pronoun, or one that stands for nothing.
    fn put_into(&self, order: &[Lexeme]) -> Option<Vec<Lexeme>> {
        let is = |at: usize, words: &[&str]| matches!(order.get(at).map(|lexeme| &lexeme.token), Some(Token::Word(word)) if words.contains(&word.as_str()));
        let mut plain = Vec::with_capacity(order.len() + 4);
        let mut changed = false;
        let mut at = 0;
        let mut pronouns: Vec<&Token> = Vec::new();
        while at < order.len() {
            let place = &order[at];
            let for_one = if is(at, SOMEBODY) {
                // "Bo is facing away from Ada, turn him towards her": each pronoun is of one of them.
                let rank = pronouns.iter().position(|known| **known == place.token).unwrap_or_else(|| {
                    pronouns.push(&place.token);
                    pronouns.len() - 1
                });
                self.somebody.get(rank).or(self.somebody.first())?
            } else if is(at, SOMETHING) && Self::is_alone(order, at) {
                self.something.as_ref().or(self.somebody.first())?
            } else if is(at, SEVERAL) && Self::is_alone(order, at) {
                let [one, other] = &self.all[..] else { return None };
                plain.extend(one.iter().cloned());
                plain.push(word_at(place, "and"));
                other
            } else if at > 0
                && is(at, &["one"])
                && is(at - 1, &["put", "add", "place", "set", "build", "plant"])
            {
                plain.push(word_at(place, "a"));
                self.noun.as_ref()?
            } else {
                plain.push(place.clone());
                at += 1;
                continue;
            };
            plain.extend(for_one.iter().cloned());
            changed = true;
            at += 1;
        }
        changed.then_some(plain)
    }

    /// Whether a word stands for a thing, and says not which: "that bench" does.
    fn is_alone(order: &[Lexeme], at: usize) -> bool {
        order.get(at + 1).is_none_or(|next| {
            is_mark(next)
                || super::super::lexicon::category(std::slice::from_ref(next)).is_none()
                    && longest_phrase(
                        std::slice::from_ref(next),
                        &["is", "would", "should", "s", "was", "way", "of", "bit", "part", "stretch"],
                    )
                    .is_none()
        })
    }
}
