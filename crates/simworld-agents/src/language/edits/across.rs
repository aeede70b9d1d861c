//! What one sentence asks for in the words of another: "the yellow bicycle goes there as well", "the table gets the same colour", "give it one",
//! "each of them gets an umbrella", "do so"; and things that were told of before ([`super::sets_told`]).
//!
//! Each comes to plainer words that are heard anew, and counts only if these are granted. What would be misread as it stands is told so first,
//! and all else where a sentence is refused.

use super::super::lexer::{Lexeme, Token, is_mark, word_of};
use super::super::lexicon::{longest, longest_phrase};
use super::super::phrases::Phrases;
use super::across_turns::{EACH_TURNS, FIRST, LATER};
use super::forms::{word_at, words_at};
use super::parse::Reader;
use super::resolve::Finder;
use super::retold::{Turns, before_kind_words, by_turn};
use super::taken_up::those;
use super::words::VERBS;

/// That what was told is to be done, as a sentence of its own.
#[rustfmt::skip]
const DO_SO: &Phrases = &Phrases::of(&["do so", "do it", "do that", "please do so", "please do that", "please do it", "make it so", "so do it", "so do that", "see to it", "please see to it", "do that please", "do it please", "do so please", "go ahead", "go ahead and do it", "make it happen", "make that happen", "get it done", "get that done"]);
/// That nothing is to be done otherwise.
#[rustfmt::skip]
const LEAVE: &Phrases = &Phrases::of(&["leave everything as it is", "leave all as it is", "leave everything as is", "leave it as it is", "leave it", "leave it be", "leave everything alone", "leave things as they are", "leave everything", "do nothing", "dont do anything", "do not do anything", "change nothing", "dont change anything", "do not change anything", "nothing changes", "everything stays as it is", "let it be", "forget it", "nothing"]);
const OTHERWISE: &Phrases = &Phrases::of(&[
    "otherwise",
    "else",
    "or else",
    "if not",
    "if it doesnt",
    "if it does not",
    "and otherwise",
]);
/// All of whom were named.
#[rustfmt::skip]
const EACH: &Phrases = &Phrases::of(&["each of them", "both of them", "each one of them", "every one of them", "each of the two", "each"]);
/// That somebody should be given something, and no more.
#[rustfmt::skip]
const NEED: &Phrases = &Phrases::of(&["need", "needs", "want", "wants", "would like", "are thirsty", "are hungry", "are tired", "are cold", "are wet", "are bored", "are waiting", "have nothing", "have no", "look tired", "look bored", "look cold", "are getting wet"]);
/// What joins a clause to the one before.
const JOINTS: &[&str] = &["and", "so", "then", "but", "afterwards", "also"];
const AFTER_THAT: &Phrases =
    &Phrases::of(&["after that", "after this", "then", "afterwards", "and then", "next"]);
/// Where goods are sold.
const SELLS: &Phrases = &Phrases::of(&["sells", "sell", "offers", "has on sale", "has for sale", "stocks"]);

impl Reader<'_> {
    /// The words in plainer ones, where they would be misread as they stand; the likeliest first.
    pub(super) fn across_first(&self, finder: &Finder<'_>) -> Vec<Vec<Lexeme>> {
        let told = self.told_of(finder).and_then(|told| self.taken_up(&told, finder));
        let done = without_do_so(self.lexemes);
        let done = done.and_then(|said| turned(&said, FIRST).or_else(|| turned(&said, LATER)));
        told.into_iter()
            .chain(self.halved(finder))
            .chain(self.given_to_each())
            .chain(turned(self.lexemes, FIRST))
            .chain(done)
            .collect()
    }

    /// As [`Self::across_first`], where a sentence is refused.
    pub(super) fn across_later(&self, finder: &Finder<'_>) -> Vec<Vec<Lexeme>> {
        let within = self.told_within(finder).and_then(|told| {
            let mut said = self.lexemes[..told.from].to_vec();
            said.extend(self.taken_up(&told, finder)?);
            Some(said)
        });
        let plain = without_otherwise(self.lexemes);
        let sells = self.over(plain.as_deref().unwrap_or(self.lexemes)).if_it_sells(finder);
        within
            .into_iter()
            .chain(turned(self.lexemes, LATER))
            .chain(self.with_directed(finder))
            .chain(sells)
            .chain(plain)
            .chain(without_do_so(self.lexemes))
            .collect()
    }

    /// "Each of them gets an umbrella right next to them": one for each of those who were named before.
    fn given_to_each(&self) -> Option<Vec<Lexeme>> {
        let each = (2..self.lexemes.len()).find(|at| longest_phrase(&self.lexemes[*at..], EACH).is_some())?;
        let named = self.named_before_each(each);
        if named.len() < 2 {
            return None;
        }
        let begin = (0..=each).rev().find(|at| {
            *at == 0 || is_mark(&self.lexemes[at - 1]) || JOINTS.contains(&word_of(&self.lexemes[at - 1]))
        })?;
        let begin = begin + usize::from(JOINTS.contains(&word_of(&self.lexemes[begin])));
        let end = (each..self.lexemes.len())
            .find(|at| self.lexemes[*at].token == Token::Break)
            .unwrap_or(self.lexemes.len());
        let order = turned(self.lexemes.get(begin..end)?, EACH_TURNS)?;
        let (_, to) = order.split_last()?;
        let mut said = self.before_each(begin);
        for (rank, who) in named.iter().enumerate() {
            if rank > 0 {
                said.push(word_at(&self.lexemes[each], "and"));
            }
            said.extend_from_slice(to);
            said.extend_from_slice(who);
        }
        said.extend_from_slice(&self.lexemes[end..]);
        Some(said)
    }

    /// Those who are named before a word, each once.
    fn named_before_each(&self, before: usize) -> Vec<&[Lexeme]> {
        let mut named: Vec<&[Lexeme]> = Vec::new();
        let mut at = 0;
        while at < before {
            let Some((_, words)) =
                self.names.exact(&self.lexemes[at..before]).filter(|(_, words)| *words > 0)
            else {
                at += 1;
                continue;
            };
            let who = &self.lexemes[at..at + words];
            if named.iter().all(|other| !super::forms::is_same(other, who)) {
                named.push(who);
            }
            at += words;
        }
        named
    }

    /// What is asked for before a clause, with a mark behind it; nothing if it only tells what somebody needs.
    fn before_each(&self, begin: usize) -> Vec<Lexeme> {
        let mut said = self.lexemes[..begin].to_vec();
        loop {
            while said.last().is_some_and(|last| is_mark(last) || JOINTS.contains(&word_of(last))) {
                said.pop();
            }
            let after =
                (0..said.len()).find(|at| longest_phrase(&said[*at..], AFTER_THAT) == Some(said.len() - at));
            match after {
                Some(at) => said.truncate(at),
                None => break,
            }
        }
        let needs = (0..said.len()).any(|at| longest_phrase(&said[at..], NEED).is_some());
        let orders = (0..said.len()).any(|at| {
            let begins = at == 0 || is_mark(&said[at - 1]);
            begins && longest(&said[at..], &VERBS).is_some()
        });
        if needs && !orders {
            said.clear();
        }
        if let Some(last) = said.last().cloned() {
            said.push(Lexeme { token: Token::Break, lemma: None, ..last });
        }
        said
    }

    /// "If the kiosk sells newspapers, put a rack next to it": the order, about the kiosk, if it does.
    fn if_it_sells(&self, finder: &Finder<'_>) -> Option<Vec<Lexeme>> {
        (self.word(0) == Some("if")).then_some(())?;
        let comma = self.lexemes.iter().position(is_mark)?;
        let (sells, goods) = (2..comma)
            .find_map(|at| longest_phrase(&self.lexemes[at..comma], SELLS).map(|words| (at, at + words)))?;
        let seller = finder.one(&self.one_of(1, sells).ok()?).ok()?;
        let place = &self.lexemes[0];
        let all: Vec<Lexeme> = words_at(place, "all the buildings that sell")
            .chain(self.lexemes[goods..comma].iter().cloned())
            .collect();
        let memo = super::memo::Memo::default();
        let all = Reader { memo: &memo, ..self.over(&all) }.one_of(0, all.len()).ok()?;
        finder.all(&[all]).ok()?.contains(&seller).then_some(())?;
        let mut said = self.lexemes[comma + 1..].to_vec();
        // What else is to be done otherwise is not to be done.
        if (0..said.len()).any(|at| longest_phrase(&said[at..], OTHERWISE).is_some()) {
            return None;
        }
        if let Some(it) = said.iter().position(|lexeme| word_of(lexeme) == "it") {
            said[it] = those(&said[it], &[seller]);
        }
        Some(said)
    }
}

/// The words by the first turn of a table that they are, with all their sentences, and with politeness behind them or without.
fn turned(lexemes: &[Lexeme], table: &Turns) -> Option<Vec<Lexeme>> {
    let end = lexemes.iter().rposition(|lexeme| !is_mark(lexeme))? + 1;
    let words = &lexemes[..end];
    let by = |words: &[Lexeme]| table.iter().find_map(|(said, meant)| by_turn(words, said, meant));
    by(words).or_else(|| by(&words[..before_kind_words(words)?]))
}

/// Without "do so" at the end.
fn without_do_so(lexemes: &[Lexeme]) -> Option<Vec<Lexeme>> {
    let end = lexemes.iter().rposition(|lexeme| !is_mark(lexeme))? + 1;
    let mark = lexemes[..end].iter().rposition(is_mark).filter(|mark| *mark > 2)?;
    let is_so = longest_phrase(&lexemes[mark + 1..end], DO_SO) == Some(end - mark - 1);
    is_so.then(|| lexemes[..mark].to_vec())
}

/// Without "otherwise leave everything as it is" behind a condition.
fn without_otherwise(lexemes: &[Lexeme]) -> Option<Vec<Lexeme>> {
    let end = lexemes.iter().rposition(|lexeme| !is_mark(lexeme))? + 1;
    longest_phrase(lexemes, &["if", "unless", "in case", "should", "provided"])?;
    let mark = (3..end).find(|at| {
        let otherwise =
            at + 1 + longest_phrase(lexemes.get(at + 1..).unwrap_or_default(), OTHERWISE).unwrap_or(end);
        let leave = lexemes.get(otherwise..end).unwrap_or_default();
        let comma = usize::from(leave.first().is_some_and(is_mark));
        is_mark(&lexemes[*at]) && longest_phrase(&leave[comma..], LEAVE) == Some(leave.len() - comma)
    })?;
    Some(lexemes[..mark].to_vec())
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    let phrases = [DO_SO, LEAVE, NEED, SELLS].into_iter().flatten().flat_map(|phrase| phrase.split(' '));
    let turns = [FIRST, LATER].into_iter().flatten().flat_map(|(said, _)| said.split([' ', '|']));
    phrases.chain(turns.filter(|word| word.len() > 1))
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::rewritten;
    use super::*;

    fn plain(said: &str, table: &Turns) -> String {
        rewritten(said, |lexemes| {
            if let Some(plain) = turned(lexemes, table) {
                *lexemes = plain;
            }
        })
    }

    #[test]
    fn turns_go_across_sentences() {
        for (said, meant) in [
            (
                "move the van next to the registry. the yellow bicycle goes there as well.",
                "move the van next to the registry , and move the yellow bicycle next to the registry",
            ),
            (
                "paint both chairs white. the table gets the same colour.",
                "paint both chairs white , and paint the table white",
            ),
            ("the eastern half of mill lane is closed. open it again.", "open the eastern half of mill lane"),
            ("look at the library. its door should be green.", "the door of the library should be green"),
            (
                "the paper moon has no cash machine. give it one, right beside the building.",
                "put a cash machine beside the paper moon",
            ),
            ("put a bench by carol. put a bin there too", "put a bench by carol , put a bin there too"),
        ] {
            assert_eq!(plain(said, FIRST), meant, "{said}");
        }
    }

    #[test]
    fn what_is_refused_is_told_plainly() {
        for (said, meant) in [
            (
                "any chair that is not white yet should become white",
                "paint every chair that is not white white",
            ),
            (
                "begin with the southernmost street lamp and paint every other one orange",
                "paint every second street lamp orange , starting with the southernmost one",
            ),
            (
                "leave a gap of two metres between the hydrant and a new bucket",
                "put a bucket two metres from the hydrant",
            ),
            (
                "copy the red bench two times and put both copies near the hall",
                "make two copies of the red bench near the hall",
            ),
            ("any chair should become white", "any chair should become white"),
        ] {
            assert_eq!(plain(said, LATER), meant, "{said}");
        }
    }
}
