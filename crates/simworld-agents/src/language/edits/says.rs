//! Statements of how things should be: "the taxi would look better in pink", "a bench is needed by the fountain", "the bus
//! ought to be moved behind the museum", "the museum would benefit from a tree".
//!
//! A statement is a subject, small words that say it should be so, and what should be of it. Each part is read by its kind,
//! so that any subject goes with any of them.

use simworld_core::seam::PlanError;

use super::super::clause::{Reference, Target};
use super::super::lexer::{Lexeme, Token};
use super::super::lexicon::{category, longest, longest_phrase};
use super::super::phrases::Phrases;
use super::forms::as_order;
use super::parse::{Reader, joint};
use super::wish::{NewThing, Where, Wish};
use super::words::Verb;

/// Whether a statement is one of how things should be before its verb is looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Mood {
    /// The statement has to say itself that it should be so.
    Plain,
    /// It stands in a wish: "I want the taxi pink", "make sure that the taxi is pink".
    Wished,
}

/// The small words between a subject and what is said of it.
#[rustfmt::skip]
const BETWEEN: &Phrases = &Phrases::of(&["should", "must", "ought", "to", "shall", "has", "have", "had", "needs", "need", "want", "wants", "is",
    "are", "be", "being", "been", "was", "were", "would", "could", "can", "may", "might", "will", "look", "looks", "looking",
    "feel", "feels", "become", "becomes", "turn", "turns", "get", "gets", "go", "goes", "come", "comes", "stand", "stands",
    "standing", "sit", "sits", "sitting", "belong", "belongs", "better", "nicer", "prettier", "best", "great", "good", "nice",
    "lovely", "fine", "cool", "amazing", "perfect", "much", "far", "supposed", "meant", "really", "rather", "probably", "ideally",
    "just", "also", "now", "instead", "please", "maybe", "perhaps", "both", "all", "definitely", "certainly", "surely", "simply",
    "actually", "preferably", "fantastic", "wonderful", "cuter", "fit", "work", "works", "make", "wait", "waits", "waiting", "live", "lives",
    "stay", "remain", "end", "land", "appear", "find", "itself", "themselves", "more", "beautiful", "smarter", "smart",
    "fancier", "livelier", "id", "say", "think", "i", "happier", "safer", "thats", "that", "which", "so", "well", "pretty",
    "cute", "beautifully", "somehow", "exist", "grow", "grows", "wear", "wears", "like", "likes", "love", "sure", "lie", "park", "going",
    "gonna", "suit", "help", "even", "way", "super", "again", "used", "splendid", "brilliant", "do", "spawn", "pop", "up", "walk",
    "over", "off", "kindly", "quickly", "hang", "rest", "move", "moved", "grand", "dashing", "stunning", "gorgeous", "elegant", "fresh", "festive", "cheerful", "sharp", "neat", "classy", "friendlier", "cooler", "brighter", "fresher"]);
/// Of those, the words that say that it should be.
#[rustfmt::skip]
const OUGHT: &[&str] = &["should", "must", "ought", "shall", "needs", "need", "want", "wants", "would", "could", "might", "may", "can",
    "will", "becomes", "become", "belong", "belongs", "better", "nicer", "prettier", "best", "supposed", "meant", "goes", "go",
    "gets", "get", "comes", "gonna"];
/// As [`OUGHT`], of several words.
const OUGHT_TO: &Phrases =
    &Phrases::of(&["has to", "have to", "had to", "is to", "are to", "had better", "going to"]);
/// That something lacks what follows.
#[rustfmt::skip]
pub(super) const LACKS: &Phrases = &Phrases::of(&["could use", "needs is", "wants is", "lacks is", "really needs is", "is missing is", "could use is", "needs", "need", "wants", "want", "lacks", "lack", "is missing", "deserves", "deserve", "should have",
    "should get", "must have", "has to have", "could do with", "can use", "ought to have", "would benefit from", "benefits from",
    "is in need of", "cries out for", "is crying out for", "is crying for", "calls for", "is short of", "would love", "would like",
    "would be happy with", "would appreciate", "requires", "require", "gets", "get", "should be given", "is in want of", "are missing",
    "are in need of", "would look good with", "would look better with", "would look nice with", "would look great with", "looks better with",
    "would look lovely with", "misses", "is lacking", "asks for", "ask for", "begs for", "is begging for", "longs for", "wishes for",
    "demand", "demands", "request", "requests", "would be better with", "would be nicer with", "would be better off with", "would be prettier with",
    "has been asking for", "have been asking for", "are asking for", "is asking for", "is waiting for", "would enjoy", "would welcome",
    "would be glad of", "would be glad about", "wanna have", "want to have", "wants to have", "would like to have", "would love to have",
    "needs to have", "need to have", "deserves to have", "should receive", "receives", "is to get", "is to have", "shall have", "might use",
    "might like", "will need", "will get", "has to get", "must get", "still needs", "really needs", "badly needs", "desperately needs",
    "urgently needs", "also needs", "still need", "really need", "badly need", "also wants", "really wants", "would profit from", "is due", "could have", "can have", "may have", "might have", "would have", "are due", "have to have", "would do well with", "would gain from", "will have", "should be provided with", "is to be given", "shall receive", "is to receive", "are to receive", "are to have", "are to get", "must receive", "would be served by", "would be improved by", "merits", "warrants", "could take", "expects", "craves", "seeks", "seek", "fancies", "fancy", "could go for", "hankers after", "yearns for", "yearn for", "hopes for", "hope for", "dreams of", "needs to get", "keep asking for", "keeps asking for", "kept asking for", "keep begging for", "keeps begging for", "are begging for", "have been begging for", "keep requesting", "ask us for", "asks us for", "asked for", "asked us for", "have asked for", "has asked for", "keep wanting", "want us to have", "never stop asking for", "are crying out for", "are longing for", "are hoping for", "is hoping for", "are waiting for"]);

/// What a statement is about.
pub(super) enum Subject {
    Things(Vec<Reference>),
    New(NewThing, Vec<Where>),
    /// "Next to the museum should be a bench".
    Place(Vec<Where>),
    /// "There should be a bench".
    There,
    /// "Painting the bench red would be nice".
    Doing,
}

impl<'a> Reader<'a> {
    /// A statement that takes all the words up to the end.
    pub(super) fn says(&self, from: usize, end: usize, mood: Mood) -> Option<Vec<Vec<Wish>>> {
        let end = self.before_politeness(from, end);
        let fancied = |cut: usize| {
            longest_phrase(&self.lexemes[cut..end], LACKS).and_then(|_| self.lacks((from, cut), end))
        };
        if let Some(wish) =
            self.goes(from, end).or_else(|| (from + 1..end.min(from + MOST_NAMED)).find_map(fancied))
        {
            return Some(vec![vec![wish]]);
        }
        (from + 1..end).find_map(|cut| {
            let between = self.between_words(cut, end);
            let is_clause = mood == Mood::Wished && self.is_certain(from);
            let may_be = is_clause
                || (1..=between).any(|words| mood == Mood::Wished || self.says_ought(cut, cut + words));
            let is_needed = || between > 0 && Reader { at: cut, ..*self }.is_needed(end);
            if !may_be && !is_needed() || self.is_inside_noun(from, cut, end) {
                return None;
            }
            let subject = self.subjects(from, cut);
            if subject.is_empty() {
                return None;
            }
            (0..=between).rev().find_map(|words| {
                let ought = mood == Mood::Wished && (words > 0 || self.is_certain(from))
                    || self.says_ought(cut, cut + words);
                let rest = Reader { at: cut + words, ..*self };
                let needed = |subject: &&Subject| {
                    matches!(subject, Subject::New(..) | Subject::Place(_))
                        && words > 0
                        && rest.is_needed(end)
                };
                subject
                    .iter()
                    .filter(|subject| ought || needed(subject))
                    .find_map(|subject| rest.predicate(subject, (from, cut), end))
                    // "The barbecue should be red" makes none.
                    .filter(|wishes| !self.is_yet_to_come(from, cut) || are_placed(wishes))
            })
        })
    }

    /// "The black car goes": whole.
    fn goes(&self, from: usize, end: usize) -> Option<Wish> {
        #[rustfmt::skip]
        const GOES: &Phrases = &Phrases::of(&["goes", "is no longer needed", "isnt needed", "is not needed", "is not wanted", "isnt wanted", "is superfluous", "is unnecessary",
            "is surplus to requirements", "is no longer wanted", "are no longer needed", "arent needed", "are not needed", "has got to go", "have got to go",
            "has outlived its usefulness", "can go", "is one too many", "is of no use", "is no use", "is obsolete", "is no longer required", "is not required",
            "shouldnt be here", "should not be here", "shouldnt be there", "should not be there", "has no business here", "has no place here", "has served its time",
            "doesnt belong here", "does not belong here", "doesnt belong there", "does not belong there", "must not stay", "cannot stay", "cant stay", "may not stay",
            "mustnt stay", "shouldnt stay", "should not stay", "wont be needed", "will not be needed", "is to go", "isnt wanted here", "is not wanted here"]);
        (from + 1..end).find_map(|cut| {
            let rest = &self.lexemes[cut..end];
            let goes = longest_phrase(rest, GOES) == Some(rest.len()) && self.is_definite(from);
            let what = if goes { self.things(from, cut).ok() } else { None };
            what.map(|what| Wish::Remove { what })
        })
    }

    /// What is not there, of what should be so: "the helicopter has to go".
    pub(super) fn missing(&self, from: usize, end: usize) -> Option<PlanError> {
        longest_phrase(&self.lexemes[from..end], &["the", "that", "this", "these", "those"])?;
        (from + 2..end).take(6).find_map(|cut| {
            let between = self.between_words(cut, end);
            let ought = between > 0 && self.says_ought(cut, cut + between) || self.word(cut) == Some("goes");
            match if ought { self.things(from, cut) } else { return None } {
                Err(error @ PlanError::NotFound { .. }) => Some(error),
                _ => None,
            }
        })
    }

    /// What the words before a verb may be.
    fn subjects(&self, from: usize, cut: usize) -> Vec<Subject> {
        let mut found = Vec::new();
        if longest_phrase(&self.lexemes[from..cut], &["there", "it", "here"]) == Some(cut - from) {
            if self.word(from) == Some("there") {
                found.push(Subject::There);
            }
            if self.word(from) != Some("it") {
                return found;
            }
        }
        let stop = self.before_politeness(from, cut);
        let is_gerund = self.word(from).is_some_and(|word| word.ends_with("ing"))
            && as_order(&self.lexemes[from..cut]).is_some();
        if is_gerund {
            found.push(Subject::Doing);
        }
        if self.is_definite(from)
            && let Ok(things) = self.things(from, stop)
        {
            found.push(Subject::Things(things));
        }
        // "In front of the gallery there must stand a postbox".
        let stop = if stop > from + 1
            && self.is_place(from)
            && matches!(self.word(stop - 1), Some("there" | "it"))
        {
            stop - 1
        } else {
            stop
        };
        let sub = self.up_to(stop);
        if self.is_place(from) {
            let mut reader = Reader { at: from, ..sub };
            if let Ok(places) = reader.places(stop)
                && reader.at >= stop
            {
                found.push(Subject::Place(places));
            }
        } else if !self.is_definite(from)
            || self.is_bare_plural(from, stop)
            || found.is_empty() && (self.is_unknown(from, stop) || self.is_yet_to_come(from, stop))
        {
            let mut reader = Reader { at: from, ..sub };
            if let Ok(thing) = reader.new_thing(stop) {
                let places = if reader.at < stop && reader.is_place(reader.at) {
                    reader.places(stop).ok()
                } else {
                    Some(Vec::new())
                };
                if let Some(places) = places.filter(|_| reader.at >= stop) {
                    found.push(Subject::New(thing, places));
                }
            }
        }
        found
    }

    /// Whether the words may name something that is not here: "excavator", with nothing certain and no small word before it.
    pub(super) fn is_unknown(&self, from: usize, end: usize) -> bool {
        let is_said = |at: usize| {
            self.word(at).is_none_or(|word| BETWEEN.contains(word) || super::frames::is_small(word))
        };
        !(from..end).any(|at| self.is_certain(at)) && !(from..end).any(is_said)
    }

    /// Whether something is spoken of as if it were there, which is not, and could be: "the barbecue should go north of the statue".
    fn is_yet_to_come(&self, from: usize, end: usize) -> bool {
        let Some(words) = longest_phrase(&self.lexemes[from..end], &["the", "the new"]) else { return false };
        let noun = from + words;
        // What is called new is, whoever may have it.
        let may_be = || words > 1 || self.names.asset_words(&self.lexemes[noun..end]) == Some(end - noun);
        let is_there = || match self.one_of(from, end) {
            Ok(what) => self.how_many(&what) > 0,
            Err(error) => !matches!(error, PlanError::NotFound { .. }),
        };
        noun < end && may_be() && !is_there()
    }

    /// Whether "can" and the like belong to a noun here: "a garbage can is missing".
    fn is_inside_noun(&self, from: usize, cut: usize, end: usize) -> bool {
        (from..cut).any(|at| category(&self.lexemes[at..end]).is_some_and(|(_, words)| at + words > cut))
    }

    /// Whether a certain thing is spoken of from here: by an article, a name or a pronoun.
    pub(super) fn is_certain(&self, from: usize) -> bool {
        #[rustfmt::skip]
        const CERTAIN: &Phrases = &Phrases::of(&["the", "that", "this", "these", "those", "my", "our", "your", "both", "all", "every", "each", "it", "them", "him", "her", "any",
            "his", "their", "its", "either", "he", "she", "they", "everybody", "everyone"]);
        longest_phrase(&self.lexemes[from..], CERTAIN).is_some()
            || matches!(self.lexemes.get(from), Some(Lexeme { token: Token::Id(_) | Token::Ids(_), .. }))
            || self.names.exact(&self.lexemes[from..]).is_some()
    }

    /// Whether the words say that something is missing.
    fn is_needed(&self, end: usize) -> bool {
        #[rustfmt::skip]
        const NEEDED: &Phrases = &Phrases::of(&["needed", "wanted", "missing", "required", "due", "overdue", "lacking", "requested", "order", "called", "must", "desired"]);
        (self.at..end).any(|at| self.word(at).is_some_and(|word| NEEDED.contains(word)))
    }

    /// As this reader, with nothing behind the end.
    pub(super) fn up_to(&self, end: usize) -> Reader<'a> {
        Reader { lexemes: &self.lexemes[..end], ..*self }
    }

    /// How many small words stand from here on.
    fn between_words(&self, at: usize, end: usize) -> usize {
        let looks_at = |at: usize| {
            matches!(self.word(at), Some("look" | "looks" | "looking" | "turn" | "turns"))
                && matches!(self.word(at + 1), Some("at" | "to" | "towards" | "toward"))
        };
        (at..end)
            .take_while(|at| self.word(*at).is_some_and(|word| BETWEEN.contains(word)) && !looks_at(*at))
            .count()
    }

    fn says_ought(&self, from: usize, to: usize) -> bool {
        (from..to).any(|at| {
            self.word(at).is_some_and(|word| OUGHT.contains(&word))
                || longest_phrase(&self.lexemes[at..to], OUGHT_TO).is_some()
        })
    }

    /// Somebody who is no thing of the scene, and what he wants: "residents would benefit from a bench opposite the museum".
    pub(super) fn others_want(&self, start: usize, end: usize) -> Option<Vec<Vec<Wish>>> {
        let end = self.before_politeness(start, end);
        (start + 1..end.min(start + MOST_NAMED)).find_map(|cut| {
            let words = longest_phrase(&self.lexemes[cut..end], LACKS)?;
            let at = cut + words;
            if !self.is_nobody_here(start, cut) || at >= end || self.word(at) == Some("somewhere") {
                return None;
            }
            if self.is_definite(at) && !self.is_bare_plural(at, end) {
                return self.says(at, end, Mood::Wished).or_else(|| self.small_clause(at, end));
            }
            let mut wishes = self.all_added(at, end)?;
            // "The clinic staff would love a table out the back": of the clinic.
            let whose = self.owner_among(start, cut).map(super::wish::Anchor::Thing);
            for place in wishes.iter_mut().flatten().flat_map(Wish::places_mut) {
                if let (Some(anchor), Some(whose)) = (place.anchor_mut(), &whose)
                    && (anchor.is_it() || anchor.is_the_building())
                {
                    *anchor = whose.clone();
                }
            }
            Some(wishes)
        })
    }

    /// The one thing of the scene that is named among who wants something: "the clinic staff".
    fn owner_among(&self, from: usize, cut: usize) -> Option<Reference> {
        (from..cut).find_map(|at| {
            let mut parser = self.parser(at, cut);
            let thing = parser.reference(0).ok().filter(|thing| parser.at > at && !is_it(thing))?;
            (self.how_many(&thing) == 1).then_some(thing)
        })
    }

    /// Whether words name somebody, and nothing that is in the scene: no order, no number, no place.
    fn is_nobody_here(&self, from: usize, cut: usize) -> bool {
        #[rustfmt::skip]
        const DENIES: &[&str] = &["nobody", "noone", "not", "no", "never", "none", "if", "unless", "dont", "doesnt"];
        let is_word = |at: usize| {
            self.word(at).is_some()
                && (!self.is_place(at) || matches!(self.word(at), Some("at" | "of" | "from" | "in" | "on")))
                && longest(&self.lexemes[at..cut], &super::words::VERBS)
                    .is_none_or(|(verb, _)| matches!(verb, Verb::Name | Verb::Describe | Verb::List))
        };
        (from..cut).all(is_word)
            && (from..cut).all(|at| self.word(at).is_none_or(|word| !DENIES.contains(&word)))
            && self.one_of(from, cut).is_err()
    }

    /// "The taxi pink", "the bench next to the fountain": what somebody wants of a thing.
    pub(super) fn small_clause(&self, from: usize, end: usize) -> Option<Vec<Vec<Wish>>> {
        let end = self.before_politeness(from, end);
        if !self.is_definite(from) {
            return None;
        }
        (from + 1..end).rev().find_map(|cut| {
            if joint(&self.lexemes[cut - 1..end]).is_some() {
                return None;
            }
            let what = self.things(from, cut).ok()?;
            let mark = usize::from(super::super::lexer::is_mark(&self.lexemes[cut]));
            let rest = Reader { at: (cut + mark).min(end), ..self.up_to(end) };

            rest.predicate(&Subject::Things(what), (from, cut), end)
        })
    }

    /// "The taxi pink, please": without a verb, what a thing is to look like, and not where it stands.
    fn is_look(wishes: &[Vec<Wish>]) -> bool {
        wishes.iter().flatten().all(|wish| {
            matches!(
                wish,
                Wish::Paint { .. } | Wish::Scale { .. } | Wish::Resize { .. } | Wish::Remove { .. }
            )
        })
    }

    /// As [`Self::small_clause`], where nobody says that it is wanted.
    pub(super) fn bare_clause(&self, from: usize, end: usize) -> Option<Vec<Vec<Wish>>> {
        let is_noun = category(&self.lexemes[from..end]).is_some_and(|(_, words)| from + words < end);
        if !self.is_certain(from) && !is_noun {
            return None;
        }
        self.small_clause(from, end).filter(|wishes| Self::is_look(wishes))
    }

    /// Reads an order that was put together from the words of a sentence: all of it, and without any of the readings that
    /// put orders together.
    pub(super) fn read_plainly(&self, order: &[Lexeme]) -> Option<Vec<Vec<Wish>>> {
        if self.depth >= DEEPEST {
            return None;
        }
        let mut reader = Reader { depth: DEEPEST, ..self.over(order) };
        let end = reader.before_politeness(0, order.len());
        reader.wish(end).ok().filter(|_| reader.at >= end)
    }

    /// As [`Self::read_plainly`], with all readings.
    pub(super) fn read_anew(&self, order: &[Lexeme]) -> Option<Vec<Vec<Wish>>> {
        if self.depth >= DEEPEST {
            return None;
        }
        let mut reader = Reader { depth: self.depth + 1, ..self.over(order) };
        let end = reader.before_politeness(0, order.len());
        reader.wish(end).ok().filter(|_| reader.at >= end)
    }
}

/// Whether it is one of the small words between a subject and what is said of it.
pub(super) fn is_between(word: &str) -> bool {
    BETWEEN.contains(word)
}

/// Who wants something has no more words.
const MOST_NAMED: usize = 9;
/// Orders that are put together are not put together once more.
pub(super) const DEEPEST: u8 = 3;

/// Whether new things are asked for, all of which stand somewhere.
fn are_placed(wishes: &[Vec<Wish>]) -> bool {
    wishes.iter().flatten().all(|wish| matches!(wish, Wish::Add { at, .. } if !at.is_empty()))
}

/// Whether a reference says nothing but what was spoken of.
pub(super) fn is_it(reference: &Reference) -> bool {
    matches!(reference.target, Target::It | Target::Them)
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    let lists = [BETWEEN, OUGHT_TO, LACKS];
    lists.into_iter().flatten().flat_map(|phrase| phrase.split(' '))
}
