//! Goods for several people who are here: "a tea for Carol and Dmitri", "an ice cream each for Greta and Irma", "a burger for each
//! of them".

use super::clause::{Clause, Count, Reference, Target};
use super::lexer::{Lexeme, Token};
use super::parser::Parser;
use super::phrases::Phrases;
use super::shopping::Goods;

/// All of those who were spoken of.
#[rustfmt::skip]
const ALL_OF_THEM: &Phrases = &Phrases::of(&[
    "each of them", "both of them", "all of them", "them both", "them all", "the two of them", "the three of them", "every one of them", "them each",
    "each", "all three of them", "each one of them", "the both of them",
]);
/// That everybody gets one.
const EACH: &Phrases = &Phrases::of(&["each", "apiece", "alike", "respectively"]);

impl Parser<'_> {
    /// "For Carol and Dmitri", "each for Greta and Irma", "to each of them": two or more who are here, behind goods.
    pub(super) fn for_several(&mut self) -> Option<Vec<Reference>> {
        let start = self.at;
        self.eat_any(EACH);
        let found = if self.eat_any(&["for", "to", "over to"]) { self.several_here() } else { None };
        if found.is_none() {
            self.at = start;
        }
        found
    }

    fn several_here(&mut self) -> Option<Vec<Reference>> {
        let whole = self.eat_any(ALL_OF_THEM);
        if whole {
            let before = self.at;
            self.at +=
                usize::from(matches!(self.rest(), [Lexeme { token: Token::Comma | Token::Break, .. }, ..]));
            if self.at > before
                && let Some(listed) = self.listed_here()
            {
                return Some(listed);
            }
            self.at = before;
            return (self.group.len() > 1 && self.ends_clause()).then(|| self.group.clone());
        }
        self.listed_here()
    }

    /// "Carol, Dmitri and Eve".
    fn listed_here(&mut self) -> Option<Vec<Reference>> {
        let mut listed = vec![self.somebody_here()?];
        loop {
            let start = self.at;
            self.at += usize::from(matches!(self.rest(), [Lexeme { token: Token::Comma, .. }, ..]));
            self.eat_any(&["and", "and for", "and also for", "for"]);
            let next = if self.at > start { self.somebody_here() } else { None };
            let Some(next) = next else {
                self.at = start;
                break;
            };
            listed.push(next);
        }
        self.eat_any(EACH);
        (listed.len() > 1 && self.ends_clause()).then_some(listed)
    }

    /// Those who get goods one by one where "them" stands for several: "buy them a burger each".
    pub(super) fn each_of_them(&mut self, whom: Option<&Reference>) -> Option<Vec<Reference>> {
        let whom = whom.filter(|whom| whom.count != Count::One)?;
        let Target::Named(ids) = &whom.target else { return None };
        self.eat_any(EACH);
        Some(ids.iter().map(|id| Reference::to(Target::Id(*id), whom.text.clone())).collect())
    }
}

/// The purchases for several people: as many goods as there are people are one for each.
pub(super) fn shared_out(
    goods: &Goods,
    times: u32,
    at: Option<&Reference>,
    people: Vec<Reference>,
) -> Vec<Clause> {
    let times = if usize::try_from(times).is_ok_and(|times| times == people.len()) { 1 } else { times };
    let one = |whom| Clause::Buy { goods: goods.name.clone(), times, at: at.cloned(), whom: Some(whom) };
    people.into_iter().map(one).collect()
}
