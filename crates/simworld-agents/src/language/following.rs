//! Following somebody by where one is to be: "stay on Fido's heels", "keep on her tail", "walk in his footsteps".

use super::clause::{Clause, Pace, Reference, Target};
use super::lexer::{Lexeme, Token};
use super::lexicon::{category, longest_phrase};
use super::parser::Parser;
use super::phrases::Phrases;

/// What leads to whose heels.
#[rustfmt::skip]
const ON: &Phrases = &Phrases::of(&[
    "stay on", "stay at", "stay close on", "stay hot on", "stay hard on", "keep on", "keep at", "keep close on",
    "keep hot on", "stick on", "stick to", "stay right on", "follow on", "follow at", "follow hard on", "follow hot on",
    "follow close on", "follow in", "walk in", "be on", "be at", "be hot on", "remain on", "remain at", "walk on",
    "walk at", "run at", "trot at", "trot on", "come at", "get on", "hang on", "hang on to", "dog", "tread in",
    "hot on", "hard on",
]);
const HEELS: &Phrases = &Phrases::of(&[
    "heels",
    "heel",
    "tail",
    "trail",
    "track",
    "tracks",
    "footsteps",
    "footstep",
    "steps",
    "coattails",
    "wake",
]);
/// No name has more words.
const LONGEST: usize = 4;

impl Parser<'_> {
    /// "Stay on Fido's heels".
    pub(super) fn on_heels(&mut self) -> Option<Vec<Clause>> {
        let from = self.at + longest_phrase(self.rest(), ON)?;
        let last = self.lexemes.len().min(from + LONGEST + 1);
        let heels = (from + 1..last).find(|at| longest_phrase(&self.lexemes[*at..], HEELS).is_some())?;
        let target = self.whose(&self.lexemes[from..heels])?;
        let text = super::lexer::written(self.words, &self.lexemes[from..heels]).to_owned();
        self.at = heels + 1;
        Some(vec![Clause::Follow { whom: Reference::to(target, text), pace: Pace::Usual }])
    }

    /// Whose it is by the words before a noun: "his", "Fido's", "the dog's".
    pub(super) fn whose(&self, owner: &[Lexeme]) -> Option<Target> {
        if longest_phrase(owner, &["his", "her", "their", "its"]) == Some(owner.len()) {
            return Some(Target::Them);
        }
        let last = owner.last()?;
        let written = &self.words[last.start..last.end];
        if !written.contains(['\'', '’']) {
            return None;
        }
        let mut owner = owner.to_vec();
        if let Some(Lexeme { token: Token::Word(word), .. }) = owner.last_mut()
            && word.ends_with('s')
        {
            word.pop();
        }
        let owner = &owner[longest_phrase(&owner, &["the", "that", "this"]).unwrap_or(0)..];
        if let Some((ids, words)) = self.names.exact(owner) {
            return (words == owner.len()).then_some(Target::Named(ids));
        }
        category(owner).filter(|(_, words)| *words == owner.len()).map(|(class, _)| Target::Any(class))
    }
}
