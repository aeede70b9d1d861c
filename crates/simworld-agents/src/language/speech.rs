//! Orders with words in them: what is said, and to whom.

use simworld_core::seam::PlanError;

use super::clause::{Clause, Count, Reference, Target};
use super::lexer::{Lexeme, Token};
use super::lexicon::longest_phrase;
use super::parser::Parser;
use super::verbs::Verb;

/// What one says where no words are given.
const HELLO: &str = "hello";
/// What is said to whoever was spoken of.
#[rustfmt::skip]
const HELLOS: &[&str] = &[
    "hello", "hi", "goodbye", "good morning", "good evening", "good afternoon", "good night", "thanks",
    "thank you", "bye", "sorry", "good day", "bye bye", "welcome", "congratulations", "cheers", "well done",
    "happy birthday", "good luck", "goodnight", "farewell", "hey", "howdy", "cheese",
];
/// The most that is said at once, in characters.
const LONGEST_SPEECH: usize = 500;

impl Parser<'_> {
    pub(super) fn speak(&mut self, verb: Verb) -> Result<Vec<Clause>, PlanError> {
        let clause = match verb {
            Verb::Argue => {
                self.eat_any(&["with"]);
                let with = self.reference(0)?;
                if self.eat_any(&["about", "over"]) {
                    self.speech(self.lexemes.len())?; // gestures have no words
                }
                Clause::Argue { with }
            }
            Verb::Say => {
                let said = self.say()?;
                let others = self.others_greeted();
                let Clause::Say { words, .. } = &said else { return Ok(vec![said]) };
                let again: Vec<Clause> =
                    others.into_iter().map(|to| Clause::Say { to, words: words.clone() }).collect();
                return Ok([said].into_iter().chain(again).collect());
            }
            Verb::Tell => return self.tell(),
            _ => {
                self.eat_any(&["to", "with"]);
                let to = self.reference(0)?;
                let quotes = self.eat_any(&["with", "by saying", "and say", "saying"]) && self.opens_words();
                let words = if quotes || self.opens_words() || self.eat_any(&["about", "of"]) {
                    self.speech(self.lexemes.len())?
                } else {
                    HELLO.to_owned()
                };
                Clause::Say { to, words }
            }
        };
        Ok(vec![clause])
    }

    /// "Tell Anna that the shop is closed", "call out to Ben".
    fn tell(&mut self) -> Result<Vec<Clause>, PlanError> {
        let calls = self.at > 1 && ["to", "at"].contains(&self.word_before());
        self.eat_any(&["both"]);
        let to = self.reference(0)?;
        let others = self.others_told();
        self.eat_any(&[
            "that",
            "about",
            "to",
            "know that",
            "know",
            "with",
            "the following",
            "the words",
            "for me",
        ]);
        if self.eat_any(&["the same", "the same thing", "that too", "the very same", "it too", "likewise"])
            && let Some(words) = self.said.clone()
        {
            return Ok(vec![Clause::Say { to, words }]);
        }
        self.at += usize::from(self.opens_quote());
        if self.ends_clause() && calls {
            return Ok(vec![Clause::Say { to, words: HELLO.to_owned() }]);
        }
        let words = self.speech(self.lexemes.len())?;
        if !others.is_empty() {
            let all = [to].into_iter().chain(others);
            return Ok(all.map(|to| Clause::Say { to, words: words.clone() }).collect());
        }
        Ok(vec![Clause::Say { to, words }])
    }

    /// "Tell Anna and Ben that ...": whoever else is told.
    fn others_told(&mut self) -> Vec<Reference> {
        let mut others = Vec::new();
        loop {
            let start = self.at;
            self.at += usize::from(matches!(self.rest().first(), Some(Lexeme { token: Token::Comma, .. })));
            self.eat_any(&["and", "and then", "and also"]);
            let next = if self.at > start { self.somebody_here() } else { None };
            let words_follow = !self.ends_at_mark() || self.opens_quote();
            let Some(next) = next.filter(|_| words_follow) else {
                self.at = start;
                return others;
            };
            others.push(next);
        }
    }

    /// "Say hello to Anna, Ben and Eve": whoever else is named in a list that ends with "and".
    fn others_greeted(&mut self) -> Vec<Reference> {
        let start = self.at;
        let mut others = Vec::new();
        while matches!(self.rest(), [Lexeme { token: Token::Comma, .. }, _, ..]) {
            self.at += 1;
            let last = self.eat_any(&["and", "and also"]);
            self.eat_any(&["to"]);
            let Some(other) = self.somebody_here() else { break };
            others.push(other);
            if !last && longest_phrase(self.rest(), &["and"]).is_some() {
                self.at += 1;
                self.eat_any(&["to"]);
                others.extend(self.somebody_here());
                break;
            }
            if last {
                break;
            }
        }
        let list = others.len() > 1 && self.ends_clause();
        if !list {
            self.at = start;
            others.clear();
        }
        others
    }

    /// "Say good morning to Anna".
    fn say(&mut self) -> Result<Clause, PlanError> {
        let start = self.at;
        if let Some(said) = self.said_again() {
            return Ok(said);
        }
        if let Some(to) = self.addressed() {
            self.eat_any(&["that"]);
            self.at += usize::from(self.opens_quote());
            let words = self.speech(self.lexemes.len())?;
            return Ok(Clause::Say { to, words: Self::greeting(words) });
        }
        let quoted = self.quoted(self.rest()).unwrap_or(0);
        let is_break = |lexeme: &Lexeme| lexeme.token == Token::Break;
        let end = self.rest().iter().position(is_break).map_or(self.lexemes.len(), |count| self.at + count);
        let is_to = |at: &usize| {
            let after_quote = quoted > 0 && *at == start + quoted;
            longest_phrase(
                &self.lexemes[*at..],
                if after_quote { &["to", "at", "into", "towards"][..] } else { &["to"] },
            )
            .is_some()
        };
        // After words in quotation marks, whom they are said to follows at once.
        let end = if quoted > 0 { end.min(start + quoted + 3) } else { end };
        let mut whom = None;
        for to_at in (start + quoted.max(1)..end).filter(is_to) {
            self.at = to_at + 1;
            let to = self.reference(0);
            let is_somebody = to.as_ref().is_ok_and(|to| self.is_somebody(to));
            whom = Some((to_at, self.at, to));
            if is_somebody {
                break;
            }
        }
        self.at = start;
        let Some((to_at, after, to)) = whom else {
            let words = self.speech(self.lexemes.len())?;
            if quoted > 0 || HELLOS.contains(&words.to_lowercase().as_str()) {
                // "Go to Hana and say hello".
                return Ok(Clause::Say {
                    to: Reference::to(Target::Them, "them".to_owned()),
                    words: Self::greeting(words),
                });
            }
            self.at = start;
            return Err(self.not_understood("say to whom, as in \"say hello to Anna\""));
        };
        let words = Self::greeting(self.speech(to_at)?);
        let to = to?;
        self.at = after;
        Ok(Clause::Say { to, words })
    }

    /// "Say bye to Fay, then to Gus": the same words to somebody else.
    fn said_again(&mut self) -> Option<Clause> {
        let start = self.at;
        if let Some(words) = self.said.clone()
            && self.eat_any(&[
                "to",
                "the same to",
                "it to",
                "that to",
                "the same thing to",
                "likewise to",
                "so to",
            ])
        {
            if let Some(to) = self.somebody_here().filter(|_| self.ends_clause()) {
                return Some(Clause::Say { to, words });
            }
            self.at = start;
        }
        None
    }

    /// "Say to Anna that ...": whom, before the words.
    fn addressed(&mut self) -> Option<Reference> {
        let start = self.at;
        let to = if self.eat_any(&["to"]) { self.somebody_here() } else { None };
        let words_follow = to.is_some() && !self.rest().is_empty();
        if !words_follow {
            self.at = start;
        }
        to.filter(|_| words_follow)
    }

    fn greeting(words: String) -> String {
        if words.eq_ignore_ascii_case("hi") { HELLO.to_owned() } else { words }
    }

    /// Whether words between quotation marks stand here.
    fn opens_words(&self) -> bool {
        self.quoted(self.rest()).is_some()
    }

    /// "Tell Hana: the clinic is closed", with a mark before the words.
    fn opens_quote(&self) -> bool {
        let [mark, first, ..] = self.rest() else { return false };
        let is_colon = mark.token == Token::Break && self.words[mark.start..].starts_with(':');
        let quotes = self.words[mark.start..first.start].contains(['"', '\'', '“', '‘', '«', '„']);
        is_colon || matches!(mark.token, Token::Comma | Token::Break) && quotes
    }

    /// How many tokens stand between quotation marks, if one opens here.
    fn quoted(&self, said: &[Lexeme]) -> Option<usize> {
        let first = said.first()?;
        let (before, text) = self.words.split_at(first.start);
        let (closes, is_apostrophe) = match before.chars().next_back()? {
            '"' => ('"', false),
            '“' => ('”', false),
            '„' => ('“', false),
            '«' => ('»', false),
            '\'' => ('\'', true),
            '‘' => ('’', true),
            _ => return None,
        };
        // An apostrophe inside a word closes nothing.
        let mut marks = text.match_indices(closes).map(|(at, _)| at);
        let ends_word = |at: &usize| {
            !is_apostrophe
                || !text[at + closes.len_utf8()..].chars().next().is_some_and(char::is_alphanumeric)
        };
        let end = first.start + marks.find(ends_word)?;
        let count = said.iter().take_while(|lexeme| lexeme.end <= end).count();
        (count > 0).then_some(count)
    }

    /// The words as they were written, up to a token or the end of the sentence.
    pub(super) fn speech(&mut self, end: usize) -> Result<String, PlanError> {
        let said = &self.lexemes[self.at..end];
        let ends = |at: &usize| match said[*at].token {
            Token::Break => true,
            // "..., then wait" is an order again.
            Token::Comma => {
                longest_phrase(&said[at + 1..], &["then", "and then", "after that", "and"]).is_some()
            }
            _ => false,
        };
        let count = self.quoted(said).unwrap_or_else(|| (0..said.len()).find(ends).unwrap_or(said.len()));
        let (Some(first), Some(last)) = (said.first().filter(|_| count > 0), said[..count].last()) else {
            return Err(self.not_understood("say what to say"));
        };
        let words = &self.words[first.start..last.end];
        if words.chars().count() > LONGEST_SPEECH {
            return Err(self.not_understood("say it in at most 500 characters"));
        }
        self.at += count;
        self.said = Some(words.to_owned());
        Ok(words.to_owned())
    }

    /// Him, her or them: whoever was spoken of last.
    pub(super) fn somebody(&mut self) -> Option<Reference> {
        let start = self.at;
        let several = longest_phrase(
            self.rest(),
            &[
                "them",
                "both of them",
                "the two of them",
                "the three of them",
                "all of them",
                "all three",
                "each of them",
                "every one of them",
                "each one",
                "them all",
            ],
        );
        if let Some(words) = several.filter(|_| self.group.len() > 1) {
            let found = self.group.iter().map(|one| self.view.find(one, super::resolve::Purpose::Any));
            let ids: Vec<_> = found.filter_map(Result::ok).map(|found| found.id).collect();
            if ids.len() == self.group.len() {
                self.at += words;
                let count = Count::Exactly(ids.len() as u32);
                return Some(Reference { count, ..Reference::to(Target::Named(ids), self.text_from(start)) });
            }
        }
        self.eat_any(&["him", "her", "them", "he", "she", "they"])
            .then(|| Reference::to(Target::Them, self.text_from(start)))
    }

    /// Remembers whom orders are about that have one verb.
    pub(super) fn group_with(&mut self, clauses: &[Clause]) {
        let one = |what: &&Reference| {
            what.count == Count::One && what.target != Target::Them && self.is_somebody(what)
        };
        let those: Vec<Reference> = clauses.iter().filter_map(Clause::about).filter(one).cloned().collect();
        self.group.extend(those);
    }
}
