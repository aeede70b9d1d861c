//! What stands before a noun: articles, numbers, colours, superlatives and places in a row.

use super::clause::{Choice, Reference, Side, Stands};
use super::lexer::{Lexeme, Token};
use super::lexicon::{DETERMINERS, FARTHEST, MOSTS, NEAREST, category, fits, longest, longest_phrase};
use super::numbers;
use super::paint::PAINTS;
use super::parser::Parser;
use super::phrases::Phrases;
use super::reference::DOOR_STATES;

/// Between a superlative and what it chooses from.
const OF_SEVERAL: &Phrases =
    &Phrases::of(&["of the", "of these", "of those", "of all the", "of all", "out of the", "among the"]);
pub(super) const FREE: &[&str] = &["free", "empty", "available", "vacant", "unoccupied"];
const INDEFINITE: &Phrases = &Phrases::of(&[
    "a",
    "an",
    "any",
    "some",
    "one of the",
    "one of",
    "another",
    "either of the",
    "either",
    "any of the",
    "any one of the",
]);
/// From the end of a row.
const FROM_BEHIND: &[(&[&str], u32)] = &[
    (
        &["last but one", "second to last", "second last", "next to last", "penultimate", "second from last"],
        2,
    ),
    (&["last but two", "third to last", "third last", "third from last"], 3),
    (&["last", "final", "very last", "endmost"], 1),
];
const MIDDLE: &[&str] = &["middle", "centre", "center", "central", "middlemost"];
/// Which of several, by where they are seen.
const OUTERMOST: &[(&[&str], Side)] = &[
    (&["leftmost", "left most", "far left", "furthest left", "farthest left", "outermost left"], Side::Left),
    (&["rightmost", "right most", "far right", "furthest right", "farthest right"], Side::Right),
];
/// On which side, before the noun.
const HANDS: &[(&[&str], Side)] =
    &[(&["left hand", "left", "lefthand"], Side::Left), (&["right hand", "right", "righthand"], Side::Right)];
/// What tells nothing from anything else of its class.
const IDLE: &Phrases = &Phrases::of(&[
    "very",
    "same",
    "said",
    "nice",
    "lovely",
    "dear",
    "good old",
    "absolute",
    "absolutely",
    "single",
    "only",
]);

impl Parser<'_> {
    /// Articles, numbers, colours and superlatives before a noun.
    pub(super) fn modifiers(&mut self, reference: &mut Reference) {
        while !self.stands_for_noun()
            && (self.quantity(reference) || self.selection(reference) || self.likeness(reference))
        {}
    }

    /// "The white one": no modifier, but what stands for a noun.
    fn stands_for_noun(&self) -> bool {
        (self.class.is_some() || self.bearers.is_some())
            && longest_phrase(self.rest(), &["one", "ones"]).is_some()
            && category(self.rest().get(1..).unwrap_or_default()).is_none()
            && longest_phrase(self.rest().get(1..).unwrap_or_default(), OF_SEVERAL).is_none()
            && longest_phrase(self.rest(), &["one of the", "one of"]).is_none()
    }

    /// How many, and whether a certain one.
    fn quantity(&mut self, reference: &mut Reference) -> bool {
        use super::clause::Count;
        if let Some((count, words)) = self.peek_count() {
            reference.count = count;
            self.at += words;
            return true;
        }
        if longest_phrase(self.rest(), &["everybody", "everyone"]).is_some() {
            reference.count = Count::All;
            return false;
        }
        if self.eat_any(&["other", "another"]) {
            reference.traits.other = true;
            return true;
        }
        if self.eat_any(INDEFINITE) {
            reference.indefinite = true;
            if self.at > 1 && fits(&self.lexemes[self.at - 2..], "of the").is_some() {
                self.at += numbers::count(self.rest()).map_or(0, |(_, words)| words); // "one of the two trees"
            }
            return true;
        }
        self.eat_any(DETERMINERS)
    }

    /// Which of several.
    fn selection(&mut self, reference: &mut Reference) -> bool {
        if let Some((place, words)) = longest(self.rest(), FROM_BEHIND).filter(|(place, _)| *place > 1) {
            reference.choose(Choice::Farthest);
            reference.place = reference.place.max(place);
            self.at += words;
        } else if self.eat_any(&["next nearest", "next closest", "second next"]) {
            reference.choose(Choice::Nth(2));
        } else if let Some(nth) = self.peek_ordinal() {
            self.at += 1;
            // "The first two doors" are the nearest.
            let several = nth == 1 && numbers::count(self.rest()).is_some();
            reference.choose(if several { Choice::Nearest } else { Choice::Nth(nth) });
        } else if self.eat_any(NEAREST)
            || longest_phrase(self.rest(), &["next"]).is_some_and(|words| self.noun_follows(words))
                && self.eat_any(&["next"])
        {
            // "The first stall is closed, try the next one".
            reference.traits.other |=
                self.word_before() == "next" && longest_phrase(self.rest(), &["one"]).is_some();
            reference.choose(Choice::Nearest);
        } else if let Some((place, words)) = longest(self.rest(), FROM_BEHIND) {
            reference.choose(Choice::Farthest);
            reference.place = reference.place.max(place);
            self.at += words;
        } else if self.eat_any(FARTHEST) {
            reference.choose(Choice::Farthest);
        } else if reference.choice != Choice::Open && self.of_several() {
        } else if self.names_follow() {
            return false;
        } else if let Some(choice) = self.compass_choice() {
            reference.choose(choice);
        } else if let Some((side, words)) = longest(self.rest(), OUTERMOST) {
            reference.choose(Choice::Side(side));
            self.at += words;
        } else if let Some(words) = longest_phrase(self.rest(), MIDDLE)
            .filter(|words| self.noun_follows(*words) || self.ends_after(*words))
        {
            reference.choose(Choice::Middle);
            self.at += words;
        } else if let Some(((measure, most), words)) = longest(self.rest(), MOSTS) {
            reference.choose(Choice::Most(measure, most));
            self.at += words;
        } else if let Some((side, words)) = longest(self.rest(), HANDS)
            .filter(|(_, words)| self.noun_follows(*words) && reference.relation.is_none())
        {
            reference.relation = Some(Stands::Side(side));
            self.at += words;
        } else {
            return false;
        }
        true
    }

    /// What the thing is like.
    fn likeness(&mut self, reference: &mut Reference) -> bool {
        if self.eat_any(FREE) {
            reference.traits.free = true;
        } else if self.names_follow() {
            return false;
        } else if let Some((paint, words)) = self.peek_paint() {
            reference.traits.paint = Some(paint);
            self.at += words;
        } else if self.eat_any(&["parked"]) {
            reference.traits.parked = true;
        } else if let Some((state, words)) = longest(self.rest(), DOOR_STATES) {
            reference.traits.state = Some(state);
            self.at += words;
        } else {
            let idle = longest_phrase(self.rest(), IDLE)
                .filter(|_| self.names.exact(self.rest()).is_none())
                .or_else(|| self.weighs_little());
            self.at += idle.unwrap_or(0);
            return idle.is_some();
        }
        true
    }

    /// "The smaller of the two boxes", "the shorter one of the trees"; what they are called follows.
    fn of_several(&mut self) -> bool {
        let start = self.at;
        self.eat_any(&["one", "ones"]);
        if !self.eat_any(OF_SEVERAL) {
            self.at = start;
            return false;
        }
        self.at += numbers::count(self.rest()).map_or(0, |(_, words)| words);
        true
    }

    fn peek_ordinal(&self) -> Option<u32> {
        let nth = numbers::ordinal(self.rest())?;
        // "One second" is a time, and nobody calls a thing "second" alone.
        let follows = matches!(self.rest().get(1).map(|lexeme| &lexeme.token), Some(Token::Word(_)));
        let spoken_of = self.class.is_some() || self.bearers.is_some();
        (follows || spoken_of).then_some(nth)
    }

    /// Whether nothing, or "of the three", follows so many words.
    fn ends_after(&self, words: usize) -> bool {
        let after = self.rest().get(words..).unwrap_or_default();
        !matches!(after.first(), Some(Lexeme { token: Token::Word(_), .. }))
            || longest_phrase(after, OF_SEVERAL).is_some()
            || longest_phrase(after, &["one of the", "one of these", "one of those"]).is_some()
    }

    fn noun_follows(&self, words: usize) -> bool {
        let after = self.rest().get(words..).unwrap_or_default();
        category(after).is_some()
            || (self.class.is_some() || self.bearers.is_some())
                && longest_phrase(after, &["one", "ones"]).is_some()
    }

    /// Whether a name begins here with what else would be an adjective: "Blue Spoon", "Little Italy".
    fn names_follow(&self) -> bool {
        let adjective =
            longest(self.rest(), MOSTS).map(|(_, words)| words).or(self.peek_paint().map(|(_, words)| words));
        let Some(words) = adjective else { return false };
        let after = &self.rest()[words..];
        let is_plain = category(after).is_some() && !self.is_capital(self.at);
        !is_plain && self.names.exact(self.rest()).is_some_and(|(_, count)| count > words)
    }

    /// Whether the token is written with a capital, as names are.
    pub(super) fn is_capital(&self, at: usize) -> bool {
        let written: Option<&Lexeme> = self.lexemes.get(at);
        let first = written.and_then(|lexeme| self.words[lexeme.start..].chars().next());
        at > 0 && first.is_some_and(char::is_uppercase)
    }

    /// A colour at the cursor that says what a thing is like and not what a light shows.
    pub(super) fn peek_paint(&self) -> Option<(super::paint::Paint, usize)> {
        let found = longest(self.rest(), PAINTS)?;
        let is_word = matches!(self.rest().first()?.token, Token::Word(_));
        // "The tallest lime" is a tree.
        let is_sort = category(&self.rest()[found.1..]).is_none()
            && self.names.sort_of_asset(self.rest()).is_some_and(|sort| sort.words == found.1);
        (is_word && !is_sort && fits(self.rest(), "dark").is_none()).then_some(found)
    }
}

impl Reference {
    /// Takes a choice; a place in a row before it counts in its order: "the second tallest".
    pub(super) fn choose(&mut self, choice: Choice) {
        self.choice = match (self.choice, choice) {
            (nth @ Choice::Nth(_), Choice::Nearest) => nth,
            (Choice::Nth(nth), other) => {
                self.place = nth;
                other
            }
            (_, other) => other,
        };
    }
}
