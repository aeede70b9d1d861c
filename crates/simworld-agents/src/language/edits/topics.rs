//! What is named first and pointed at then: "the robot, make that one orange", "red car: make it green", "see the chair next to the table? A
//! parasol beside that chair", "take the car nearest to Bo: next to that one ...", "of the two cafés I mean the eastern one. Put ... next to it".
//!
//! The thing itself is put in the place of the words that point at it, and what only named it is left out. What several things could be is
//! named again in its words, so that it is asked which.

use super::super::clause::Reference;
use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{category, longest, longest_phrase};
use super::super::paint::PAINTS;
use super::super::phrases::Phrases;
use super::forms::word_at;
use super::parse::Reader;
use super::resolve::Finder;
use super::words::{VERBS, WAYS};

/// Before what is spoken of.
#[rustfmt::skip]
const LEADS: &Phrases = &Phrases::of(&["see", "you see", "do you see", "can you see", "you know", "do you know", "look at", "take a look at", "consider", "regarding", "concerning", "as for", "as to", "about", "remember", "do you remember", "now", "what about", "speaking of", "talking of", "talking about", "notice", "i mean", "i am talking about", "im talking about", "i am thinking of", "im thinking of", "with regard to"]);
/// Before what is spoken of, or taken up.
const TAKES: &Phrases = &Phrases::of(&[
    "take",
    "pick",
    "find",
    "choose",
    "think of",
    "go to",
    "start from",
    "go from",
    "look for",
]);
/// "I mean", behind several things and before the one that is meant.
#[rustfmt::skip]
const MEANS: &Phrases = &Phrases::of(&["i mean", "i meant", "we mean", "i want", "im talking about", "i am talking about", "im thinking of", "i am thinking of", "take", "pick", "choose", "lets take", "i choose", "id take", "i would take", "its", "it is", "i have in mind", "im after"]);
/// Words that point at one thing alone.
const THAT_ONE: &Phrases =
    &Phrases::of(&["that one", "this one", "that very one", "this very one", "exactly that one"]);
/// Words for a thing of its sort, whatever it was called: "do you see the office? A rack behind that building".
const THAT_THING: &Phrases = &Phrases::of(&[
    "that building",
    "this building",
    "that place",
    "this place",
    "that house",
    "this house",
    "that vehicle",
    "that thing",
]);
/// Words that stand for it.
const IT: &Phrases = &Phrases::of(&["it", "him", "her"]);
/// So many topics are looked for.
const MOST: usize = 4;

/// What is spoken of, and where.
struct Topic {
    /// The first word of its part, and the mark behind it.
    from: usize,
    end: usize,
    /// The words that name it.
    said: Vec<Lexeme>,
    /// Whether "it" is it wherever it stands, or in a place alone.
    everywhere: bool,
}

impl Reader<'_> {
    /// The words with what was named first in the place of what points at it.
    pub(super) fn with_topics(&self, finder: &Finder<'_>) -> Option<Vec<Lexeme>> {
        let mut told: Option<Vec<Lexeme>> = None;
        for _ in 0..MOST {
            let lexemes = told.as_deref().unwrap_or(self.lexemes);
            let reader = Reader { lexemes, at: 0, ..*self };
            let begins = |at: &usize| *at == 0 || lexemes[at - 1].token == Token::Break;
            let next = (0..lexemes.len()).filter(begins).find_map(|from| {
                let topic = reader.topic_at(from)?;
                reader.pointed_at(&topic, finder)
            });
            let Some(next) = next else { break };
            told = Some(next);
        }
        // "Right in front of it, that's the spot for a box": with the thing in it, this is a turn of phrase.
        told.map(|mut lexemes| {
            super::casual::in_plain_words(&mut lexemes);
            lexemes
        })
    }

    /// The topic that a part names and says nothing else of.
    fn topic_at(&self, from: usize) -> Option<Topic> {
        let end = (from + 1..self.lexemes.len()).find(|at| is_mark(&self.lexemes[*at]))?;
        if let Some(said) = self.one_of_several(from, end) {
            return Some(Topic { from, end, said, everywhere: true });
        }
        let words = &self.lexemes[from..end];
        let lead = longest_phrase(words, LEADS);
        let takes = longest_phrase(words, TAKES);
        let noun = from + lead.or(takes).unwrap_or(0);
        let is_title = noun == from && self.ends_title(end) && self.is_title(from, end);
        let is_certain = noun < end
            && longest_phrase(&self.lexemes[noun..end], &["the", "that", "this", "my", "our", "your"])
                .is_some();
        if !is_certain && !is_title {
            return None;
        }
        let mut said = self.lexemes[noun..end].to_vec();
        if is_title && !is_certain {
            said.insert(0, word_at(&self.lexemes[from], "the"));
        }
        let named = self.over(&said).one_of(0, said.len()).is_ok();
        let everywhere = lead.is_some() && self.lexemes[end].token == Token::Break || is_title;
        named.then_some(Topic { from, end, said, everywhere })
    }

    /// "Of the two cafés I mean the eastern one": the eastern café.
    fn one_of_several(&self, from: usize, end: usize) -> Option<Vec<Lexeme>> {
        let words = &self.lexemes[from..end];
        let of = longest_phrase(
            words,
            &["of the", "of those", "of these", "among the", "from the", "of our", "out of the"],
        )?;
        let number = super::super::numbers::count(&words[of..]).map_or(0, |(_, count)| count);
        let noun = of + number;
        let cut = (noun + 1..words.len()).find(|at| longest_phrase(&words[*at..], MEANS).is_some())?;
        let mark = usize::from(is_mark(&words[cut - 1]));
        let which = cut + longest_phrase(&words[cut..], MEANS)?;
        let the = longest_phrase(&words[which..], &["the", "that"])?;
        let one = words.len() - 1;
        if words[one].token != Token::Word("one".to_owned()) || which + the >= one {
            return None;
        }
        let mut said = vec![word_at(&words[0], "the")];
        said.extend_from_slice(&words[which + the..one]);
        said.extend_from_slice(&words[noun..cut - mark]);
        let last = said.last_mut()?;
        if let Token::Word(word) = &mut last.token
            && let Some(stem) = word.strip_suffix('s').map(str::to_owned)
        {
            *last = word_at(last, &stem);
        }
        Some(said)
    }

    /// Whether a colon stands behind a part.
    fn ends_title(&self, end: usize) -> bool {
        self.words.get(self.lexemes[end].start..).is_some_and(|rest| rest.starts_with(':'))
    }

    /// "Red car", "statue": a noun with its colour and no article.
    fn is_title(&self, from: usize, end: usize) -> bool {
        let words = &self.lexemes[from..end];
        let paint = longest(words, PAINTS).map_or(0, |(_, count)| count);
        let the = longest_phrase(words, &["the"]).unwrap_or(0);
        let noun = words.get(paint.max(the)..).unwrap_or_default();
        let is_noun = category(noun).is_some_and(|(_, count)| count == noun.len());
        is_noun && longest(words, &VERBS).is_none() || the > 0
    }

    /// The words with a topic in the place of what points at it, and without the part that named it.
    fn pointed_at(&self, topic: &Topic, finder: &Finder<'_>) -> Option<Vec<Lexeme>> {
        let begin = topic.end + 1;
        // Behind a comma it is pointed at at once: "that oak, the tallest one, deserves a bench next to it" is about the oak.
        let stop = match self.lexemes[topic.end].token {
            Token::Comma => (begin..self.lexemes.len()).find(|at| is_mark(&self.lexemes[*at]))?,
            _ => self.sentence_end(begin.min(self.lexemes.len())),
        };
        let mut told = self.lexemes[..topic.from].to_vec();
        let one = self.over(&topic.said).one_of(0, topic.said.len()).ok()?;
        let mut changed = false;
        let mut at = begin;
        while at < stop {
            if let Some(words) = self.points(at, topic) {
                told.extend(topic.thing_or_words(&one, finder));
                at += words;
                changed = true;
            } else {
                told.push(self.lexemes[at].clone());
                at += 1;
            }
        }
        told.extend_from_slice(&self.lexemes[stop.min(self.lexemes.len())..]);
        changed.then_some(told)
    }

    /// How many words point at the topic from here on.
    fn points(&self, at: usize, topic: &Topic) -> Option<usize> {
        let rest = &self.lexemes[at..];
        let that = longest_phrase(rest, &["that", "this"]).filter(|_| has_noun(&topic.said, rest.get(1)));
        let it = longest_phrase(rest, IT).filter(|_| topic.everywhere || self.is_behind_way(at));
        let sort = longest_phrase(rest, THAT_THING).filter(|_| topic.everywhere);
        longest_phrase(rest, THAT_ONE).or(that.map(|_| 2)).or(it).or(sort)
    }

    /// Whether a word of place ends before a word.
    fn is_behind_way(&self, at: usize) -> bool {
        (at.saturating_sub(4)..at)
            .any(|from| longest(&self.lexemes[from..at], &WAYS).is_some_and(|(_, words)| from + words == at))
    }
}

impl Topic {
    /// The thing itself if it is one, or else the words that name it.
    fn thing_or_words(&self, one: &Reference, finder: &Finder<'_>) -> Vec<Lexeme> {
        match (finder.one(one), self.said.first()) {
            (Ok(id), Some(place)) => vec![Lexeme { token: Token::Id(id), lemma: None, ..place.clone() }],
            _ => self.said.clone(),
        }
    }
}

/// Whether a word is the noun among words that name a thing.
fn has_noun(said: &[Lexeme], word: Option<&Lexeme>) -> bool {
    const FARTHEST: usize = 5;
    word.is_some_and(|word| {
        let is_noun = category(std::slice::from_ref(word)).is_some();
        is_noun && said.iter().take(FARTHEST).any(|own| own.token == word.token)
    })
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    [LEADS, TAKES, MEANS, THAT_ONE, THAT_THING].into_iter().flatten().flat_map(|phrase| phrase.split(' '))
}
