//! Orders that are done over again: "do that twice", "then do it again", "once more", "do the same with the statue".

use simworld_core::action::StepDirection;
use simworld_core::seam::PlanError;

use super::clause::{Clause, Reference, Target};
use super::lexer::{Lexeme, Token};
use super::lexicon::longest_phrase;
use super::numbers;
use super::parser::Parser;
use super::phrases::Phrases;
use super::politeness::joint;
use super::repeats::repeat;

/// Doing what was said last, before how often.
#[rustfmt::skip]
const DO_SO: &Phrases = &Phrases::of(&[
    "and do it all", "do it all", "all of it", "and all of it", "and do all that", "and do all of that", "do all that", "do all of that", "and do all this", "do all this",
    "and repeat all that", "and repeat all of that", "repeat all that", "and again", "and repeat this",
    "repeat this", "repeat the whole thing", "and repeat the whole thing", "and repeat", "repeat",
    "and do the whole thing", "do the whole thing", "do so", "all of that", "all that", "do it", "and do it",
    "do that", "and do that", "do this", "and do this", "and do so", "repeat it", "and repeat it",
    "repeat that", "and repeat that", "do both", "lets do both", "and do both", "do them all", "do the lot", "and that",
    "and all that", "and all of that", "and the whole thing", "the whole thing", "this", "that", "all this", "all of this",
    "and this", "lets do that", "lets do it", "lets do this", "do these", "do that whole thing", "same again", "and the same",
]);

/// Doing it once more, where no number follows.
#[rustfmt::skip]
const ONCE_MORE: &Phrases = &Phrases::of(&[
    "do that again", "do it again", "do so again", "do this again", "do the same again", "do the same thing again", "do exactly the same again",
    "do all that again", "do all of that again", "do it all again", "do it all over again", "do that all over again", "do the whole thing again",
    "do everything again", "once more", "one more time", "once again", "again", "repeat", "repeat it", "repeat that", "repeat this", "repeat all that",
    "repeat all of that", "repeat everything", "repeat the whole thing", "repeat it all", "same again", "the same again", "do that once more",
    "do it once more", "do that one more time", "do it one more time", "do this once more", "do this one more time", "repeat it once", "repeat that once",
    "all over again", "do the lot again", "start over", "start all over again", "start again from the beginning", "do it over", "do it a second time",
    "do that a second time", "a second time", "do it over again", "all that again", "all of that again", "the whole thing again", "the same once more",
    "same thing again", "the same thing again", "do them again", "do both again", "do it all once more", "do all that once more", "repeat once", "repeat once more",
]);
/// Words of those that are about all that was said.
const WHOLE: &[&str] = &["all", "whole", "that", "this", "repeat", "everything", "lot", "over", "start"];
/// Doing the same, before to whom or with what.
#[rustfmt::skip]
const THE_SAME: &Phrases = &Phrases::of(&[
    "do the same", "do the same thing", "do exactly the same", "do just the same", "do likewise", "do so", "do that", "do it", "the same", "same",
    "the same thing", "same thing", "the very same", "likewise", "repeat that", "repeat it", "repeat this", "the same again", "do this", "ditto",
]);
const WITH: &[&str] = &["with", "to", "for", "at", "again with", "again at", "again for", "again to"];

impl Parser<'_> {
    /// "... and do it twice", "..., then do that again": the order before, or all of the sentence.
    pub(super) fn done_again(&mut self, clauses: &mut Vec<Clause>, whole: usize, group: usize) -> bool {
        if clauses.is_empty() {
            return false;
        }
        let start = self.at;
        let mark =
            usize::from(matches!(self.rest(), [Lexeme { token: Token::Comma | Token::Break, .. }, ..]));
        let again = mark + longest_phrase(&self.rest()[mark..], DO_SO).unwrap_or(0);
        if again > mark
            && let Some((times, count)) = numbers::times(&self.rest()[again..])
            && longest_phrase(&self.rest()[again + count..], &["more"]).is_none()
        {
            let all = self.says_one_of(again, &["all", "whole", "that", "this", "repeat", "so"])
                || self.rest()[..again].iter().any(|lexeme| lexeme.token == Token::Break);
            let both = self.says_one_of(again, &["both", "lot", "everything", "these"]);
            self.at += again + count;
            // "Go to the bakery, then to the mailbox, and do it twice": one is there after the first time.
            let all = all || group > whole && matches!(clauses.last(), Some(Clause::Go { .. }));
            let from = if both { 0 } else { whole };
            repeat(clauses, if all { from } else { group }, times, all);
            return true;
        }
        self.at += mark;
        let joined = self.joins_again();
        if let Some(words) = longest_phrase(self.rest(), ONCE_MORE) {
            let all = self.says_one_of(words, WHOLE) || mark > 0;
            let lone = words == 1 && self.peeks("again");
            self.at += words;
            self.skip_fillers();
            // "Go there again" is no second time.
            if self.ends_there() && !(lone && joined == 0) {
                // "Turn left, and again, and again": once more than before.
                if let (true, Some(Clause::Repeat { times, .. })) = (lone, clauses.last_mut()) {
                    *times += 1;
                    return true;
                }
                let all = all || group > whole && matches!(clauses.last(), Some(Clause::Go { .. }));
                repeat(clauses, if all { whole } else { group }, 2, all);
                return true;
            }
        }
        // "Take a photo of the well and then another one".
        let repeatable = clauses.last().is_some_and(Clause::is_repeatable);
        if joined > 0
            && repeatable
            && self.eat_any(&[
                "another one",
                "one more",
                "another",
                "another photo",
                "one more photo",
                "another picture",
            ])
            && self.ends_there()
        {
            repeat(clauses, clauses.len() - 1, 2, false);
            return true;
        }
        self.at = start;
        false
    }

    /// "Three rounds: fountain, statue".
    pub(super) fn rounds_of(&self) -> Option<(u32, usize)> {
        let (number, words) = numbers::number(self.rest()).filter(|(number, _)| number.fract() == 0.0)?;
        let unit = longest_phrase(
            &self.rest()[words..],
            &["rounds", "round", "laps", "trips", "times around", "times round"],
        )?;
        let colon = matches!(self.rest().get(words + unit), Some(Lexeme { token: Token::Break, .. }));
        (colon && (1.0..=100.0).contains(&number)).then_some((number as u32, words + unit))
    }

    /// "... once it is dark": when, and not how often.
    pub(super) fn when_it_is(&self) -> bool {
        let after = self.rest().get(1..).unwrap_or_default();
        let subject = longest_phrase(
            after,
            &["it", "its", "the", "he", "she", "they", "there", "you", "everybody", "nobody"],
        );
        self.peeks("once") && subject.is_some()
    }

    /// Whether nothing follows that would say how often, how long or with what.
    fn ends_there(&self) -> bool {
        self.ends_at_mark() || joint(self.rest()).is_some()
    }

    /// Whether one of the words stands among so many that follow.
    fn says_one_of(&self, count: usize, words: &[&str]) -> bool {
        self.rest()[..count]
            .iter()
            .any(|lexeme| matches!(&lexeme.token, Token::Word(word) if words.contains(&word.as_str())))
    }

    /// Passes "and", "then" and the like before what is done again; how many words.
    fn joins_again(&mut self) -> usize {
        let start = self.at;
        while self.eat_any(&[
            "and",
            "then",
            "and then",
            "after that",
            "afterwards",
            "now",
            "please",
            "finally",
            "next",
            "but",
            "also",
            "lastly",
        ]) {}
        self.at - start
    }

    /// "Wave to Agnes and do the same to Boris": the orders before, about somebody or something else.
    pub(super) fn done_to_another(&mut self, clauses: &mut Vec<Clause>, group: usize) -> bool {
        let start = self.at;
        self.at +=
            usize::from(matches!(self.rest(), [Lexeme { token: Token::Comma | Token::Break, .. }, ..]));
        self.joins_again();
        let from = if group < clauses.len() { group } else { clauses.len().saturating_sub(1) };
        let about = clauses.get(from..).and_then(|done| done.iter().find_map(Clause::about)).cloned();
        let same = self.eat_any(THE_SAME)
            && self.eat_any(WITH)
            && longest_phrase(self.rest(), &["me", "us"]).is_none();
        let other = if same && about.is_some() { self.reference(0).ok() } else { None };
        if let Some((about, other)) = about.zip(other)
            && self.ends_clause()
            && let Some(again) = about_another(&clauses[from..], &about, &other)
        {
            clauses.extend(again);
            return true;
        }
        self.at = start;
        false
    }

    /// After "keep": an order that goes on.
    pub(super) fn keep(&mut self) -> Result<Vec<Clause>, PlanError> {
        let mut body = self.order()?;
        if let [Clause::Step { direction: StepDirection::Forward, .. }] = body[..] {
            body = vec![Clause::Forward];
        }
        Ok(body)
    }
}

/// The orders with another thing in place of the one that they are about; none if one cannot be told so.
fn about_another(done: &[Clause], about: &Reference, other: &Reference) -> Option<Vec<Clause>> {
    let mut replaced = false;
    let mut again = Vec::new();
    for clause in done {
        let mut clause = clause.clone();
        if let Clause::Repeat { times, body } = &clause {
            let body = about_another(body, about, other)?;
            again.push(Clause::Repeat { times: *times, body });
            replaced = true;
            continue;
        }
        if let Some(what) = clause.about_mut().filter(|what| what.target == about.target) {
            *what = other.clone();
            replaced = true;
        }
        again.push(clause);
    }
    replaced.then_some(again)
}

/// "You are needed at the fountain, go there" says one thing twice.
pub(super) fn goes_there(clauses: &mut Vec<Clause>, before: usize, stated: bool) {
    let there =
        matches!(&clauses[before..], [Clause::Go { to, side: None, .. }] if to.target == Target::There);
    if stated && there && before > 0 {
        clauses.pop();
    }
}

/// "Follow the dog, but stop when you see the mailbox": what never ends by itself is done until then.
pub(super) fn stops_then(clauses: &mut Vec<Clause>) {
    if let [.., Clause::Follow { .. } | Clause::Forward, Clause::Until { body, .. }, Clause::Stop] =
        &clauses[..]
        && body.is_empty()
    {
        clauses.pop();
        let until = clauses.pop();
        let goes_on = clauses.pop();
        if let (Some(Clause::Until { test, .. }), Some(goes_on)) = (until, goes_on) {
            clauses.push(Clause::Until { test, body: vec![goes_on] });
        }
    }
}
