//! What is told along the way, whatever it tells: "the choir sings on Sunday", "my boss wants results", "kids draw on my wall".
//!
//! Remarks are known by their words ([`super::remarks`]). Where a sentence is not understood with these alone, its parts are looked at
//! once more by their shape: somebody or something, and behind it a verb that asks for nothing. What names nothing of the scene may be
//! told in more ways than what does. A part that may ask for something, take something back or set a condition is never passed over.

use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{category, longest, longest_phrase};
use super::super::numbers;
use super::super::paint::PAINTS;
use super::super::phrases::Phrases;
use super::parse::Reader;
use super::wish::Wish;
use super::words::{VERBS, Verb};

/// Words that take back, set conditions, or leave something out.
#[rustfmt::skip]
const TAKES_BACK: &Phrases = &Phrases::of(&["not the", "not a", "not that", "not those", "not these", "not this", "except", "only", "unless", "until", "instead", "rather than", "please", "apart from", "other than", "but not", "if",
    "i mean", "i meant", "scratch that", "no wait", "wait no", "correction", "undo", "never mind", "forget it", "forget that", "leave it", "leave them", "either", "neither", "or the", "or a", "another", "one more", "as well",
    "the same", "twice", "double", "otherwise", "make sure", "lets", "let us", "let", "each", "every second", "how about", "what about", "why not", "there should", "there must", "could you", "can you", "would you", "will you", "could we", "can we",
    "may we", "could i", "can i", "may i", "i suggest", "i propose", "id say", "is needed", "are needed", "is required", "are required", "is missing", "are missing", "no longer", "no more", "faces", "facing"]);
/// That somebody asks for something, before what it is.
#[rustfmt::skip]
pub(super) const WISHES: &Phrases = &Phrases::of(&["want", "wants", "wanted", "need", "needs", "needed", "would like", "would love", "would adore", "adore", "adores", "id like", "id love", "wed like", "wed love", "lack", "lacks", "could use", "could do with", "wish", "wishes", "fancy", "fancies",
    "deserve", "deserves", "require", "requires", "request", "requests", "ask for", "asks for", "asked for", "demand", "demands", "dream of", "long for", "should", "must", "ought", "shall", "has to", "have to", "had better", "is to", "are to",
    "should get", "should have", "prefer", "prefers", "would rather", "id rather", "expect", "expects", "belongs", "would look", "would be", "looks better", "could be", "better", "mustnt", "shouldnt", "supposed"]);
/// What begins an order that is not about the scene, or not understood.
#[rustfmt::skip]
pub(super) const ORDERS_ANYTHING: &Phrases = &Phrases::of(&["do", "make", "fix", "sort", "handle", "arrange", "improve", "decorate", "change", "use", "give", "bring", "help", "try", "surprise", "work", "deal", "find", "show", "tell", "ask", "keep", "stop", "start", "leave", "get", "let",
    "have", "dont", "never", "undo", "redo", "repeat", "finish", "build", "create", "design", "spread", "fill", "cover", "cheer", "brighten", "lighten", "clean", "tidy"]);
/// What may stand before what is told.
#[rustfmt::skip]
const SMALL: &Phrases = &Phrases::of(&["because", "since", "as", "so", "and", "but", "well", "oh", "although", "though", "while", "which", "where", "now that", "given that", "seeing that", "considering", "even though", "for", "cause", "who"]);
/// "As soon as there is a dragon" says when.
#[rustfmt::skip]
const WHEN: &Phrases = &Phrases::of(&["as soon as", "as long as", "so long as", "as far as", "as if", "as much as", "as many as", "after", "before", "until", "till", "whenever"]);
/// Who tells something of himself, or is told of.
#[rustfmt::skip]
const WHO: &Phrases = &Phrases::of(&["i", "im", "ive", "ill", "id", "we", "weve", "were", "well", "they", "theyre", "theyve", "theyll", "he", "hes", "she", "shes", "it", "its", "itll", "that", "thats", "this", "these", "those", "there", "theres", "you", "youre", "youve", "nobody", "no one", "noone",
    "everybody", "everyone", "people", "somebody", "someone", "everything", "nothing", "something", "my", "our", "his", "her", "their", "your", "folks", "kids", "children", "half the", "most", "many", "some", "all", "both", "few", "what a", "what", "how", "who", "whoever"]);
/// Verbs of what is so, in any form.
#[rustfmt::skip]
const IS: &Phrases = &Phrases::of(&["is", "are", "was", "were", "am", "isnt", "arent", "wasnt", "werent", "has", "have", "had", "hasnt", "havent", "hadnt", "will", "wont", "can", "cant", "cannot", "could", "couldnt", "would", "wouldnt", "do", "dont", "does", "doesnt", "did", "didnt", "may", "might",
    "im", "its", "thats", "theyre", "theres", "ive", "weve", "theyve", "shes", "hes", "youre", "ill", "well", "itll", "never", "always", "whos", "keep", "get", "got", "go", "come", "came", "went", "know", "love", "like", "hate", "wait", "say", "said", "think", "feel", "look", "leave", "left", "make", "made", "use", "see", "saw", "gave", "met", "ran", "sat",
    "sing", "play", "sit", "walk", "stop", "fell", "broke", "lost", "won", "told", "bought", "sold", "took", "grew", "slept", "ate", "drank", "stood", "built", "paid", "hit", "let", "kept", "wrote", "read", "thought", "knew", "heard", "bit", "beat", "held", "began", "ended", "died", "cut", "chose", "chosen", "drew", "drove", "flew", "wore", "threw", "spoke", "stole", "rode", "woke", "swam", "caught", "taught", "fought", "felt", "meant", "spent", "sent", "shut", "happen", "happens", "means", "tend", "refuse", "insist", "insists", "complain"]);
/// Words that stand between two things, or before one, and are no verb.
#[rustfmt::skip]
const NO_VERB: &[&str] = &["and", "or", "of", "in", "on", "at", "by", "to", "for", "with", "from", "as", "the", "a", "an", "very", "so", "too", "just", "near", "behind", "beside", "next", "please", "both", "all", "along", "around", "round", "between", "under", "over", "across", "into", "onto", "inside", "outside",
    "everywhere", "here", "there", "opposite", "towards", "facing", "that", "who", "which", "where", "without", "north", "south", "east", "west", "left", "right", "evenly", "apart", "instead", "away", "gone", "out", "off", "back", "one"];

/// Who is told of and is nobody in particular.
#[rustfmt::skip]
const CROWD: &Phrases = &Phrases::of(&["people", "folks", "kids", "children", "visitors", "guests", "everybody", "everyone", "customers", "students", "tourists"]);
/// Whether an order begins here, this grammar's or not, also behind a word that only says when: "then give it a twin".
fn orders_anything(words: &[Lexeme]) -> bool {
    const THEN: &Phrases =
        &Phrases::of(&["then", "and then", "after that", "afterwards", "next", "finally", "lastly", "now"]);
    let then = longest_phrase(words, THEN).unwrap_or(0);
    longest_phrase(&words[then..], ORDERS_ANYTHING).is_some()
}

impl Reader<'_> {
    /// Whether a part tells something, asks for nothing, and leaves what is asked for as it is.
    pub(super) fn is_told(&self, from: usize, end: usize, is_known: &dyn Fn(&Wish) -> bool) -> bool {
        let ends = self.lexemes.get(end).is_none_or(is_mark) || self.word(end).is_some();
        let mut start = from;
        while let Some(words) = longest_phrase(&self.lexemes[start..end], SMALL)
            && start + words < end
        {
            start += words;
        }
        let words = &self.lexemes[start..end];
        // What an order follows from asks for nothing itself: "it must stay free, so put the bench elsewhere".
        let leads = self.leads_to_order(end);
        let may_change = || {
            if leads {
                self.sets_a_condition(start, end) || self.wishes_for_known(start, end)
            } else {
                self.may_take_back(start, end) || self.wishes_for(start, end)
            }
        };
        let tells = || {
            let names_nothing = self.names_nothing(start, end);
            names_nothing && (leads || self.tells_anything(start, end))
                || self.tells_of_what_is_here(start, end, leads)
        };
        ends && words.len() > 1
            && !self.goes_on_within(from, end)
            // "Do what a good host would do" is an order, though nobody knows which.
            && !(start..end).any(|at| {
                (at == start || is_mark(&self.lexemes[at - 1])) && orders_anything(&self.lexemes[at..end])
            })
            && longest_phrase(&self.lexemes[from..end], WHEN).is_none()
            && longest_phrase(words, WHEN).is_none()
            && longest_phrase(words, &["if", "when", "unless", "should", "in case", "suppose", "once"])
                .is_none()
            && !self.orders_here(start, end)
            && !may_change()
            && tells()
            && !self.is_read_as_wish(from, end, is_known)
            && !self.is_read_as_wish(start, end, is_known)
    }

    /// Whether "so" follows and then an order, or what may be one: "..., so paint it".
    pub(super) fn leads_to_order(&self, end: usize) -> bool {
        let marks = self.lexemes[end..].iter().take_while(|lexeme| is_mark(lexeme)).count();
        let so = longest_phrase(
            &self.lexemes[end + marks..],
            &["so", "which is why", "thats why", "therefore", "hence"],
        );
        so.is_some_and(|words| {
            !matches!(
                self.word(end + marks + words),
                Some("that" | "many" | "much" | "they" | "we" | "it" | "people")
            )
        })
    }

    /// "The teenagers drop everything on the ground": who does what, before a verb that orders nothing.
    pub(super) fn others_do(&self, start: usize, verb: usize) -> bool {
        let before = &self.lexemes[start..verb];
        let the = longest_phrase(before, &["the", "my", "our", "these", "those"]);
        longest_phrase(before, CROWD).is_some()
            || the.is_some() && self.word(verb - 1).is_some_and(|word| word.ends_with('s'))
    }

    fn sets_a_condition(&self, from: usize, end: usize) -> bool {
        const CONDITIONS: &Phrases = &Phrases::of(&[
            "if",
            "unless",
            "until",
            "instead",
            "rather than",
            "i mean",
            "i meant",
            "scratch that",
            "no wait",
            "wait no",
            "correction",
            "undo",
            "never mind",
            "forget it",
            "forget that",
            "please",
            "could you",
            "can you",
            "would you",
            "will you",
            "how about",
            "what about",
            "otherwise",
        ]);
        (from..end).any(|at| longest_phrase(&self.lexemes[at..end], CONDITIONS).is_some())
    }

    /// "I want a unicorn": a wish for something new.
    pub(super) fn wishes_for_new(&self, from: usize, end: usize) -> bool {
        (from..end).any(|at| {
            longest_phrase(&self.lexemes[at..end], WISHES).is_some_and(|words| {
                let rest = &self.lexemes[at + words..end];
                numbers::count(rest).is_some() || longest_phrase(rest, &["a", "an", "some", "more"]).is_some()
            })
        })
    }

    /// As [`Self::wishes_for_new`], of something that somebody has: nobody has "a home of his own".
    fn wishes_for_known(&self, from: usize, end: usize) -> bool {
        let article = (from + 1..end).rev().find(|at| matches!(self.word(*at), Some("a" | "an")));
        let is_unknown = article.is_some_and(|at| {
            let noun = &self.lexemes[at + 1..end];
            // "A home of his own".
            noun.iter().any(|word| word.token == Token::Word("own".to_owned()))
                || !(0..noun.len().min(3)).any(|at| {
                    category(&noun[at..]).is_some() || self.names.asset_words(&noun[at..]).is_some()
                })
        });
        self.wishes_for_new(from, end) && !is_unknown
    }

    pub(super) fn is_read_as_wish(&self, from: usize, end: usize, is_known: &dyn Fn(&Wish) -> bool) -> bool {
        let mut reader = Reader { at: from, ..self.up_to(end) };
        reader.wish(end).is_ok_and(|wishes| wishes.iter().flatten().all(is_known))
    }

    pub(super) fn may_take_back(&self, from: usize, end: usize) -> bool {
        (from..end).any(|at| {
            let rest = &self.lexemes[at..end];
            // "The red bench gets wet" is no colour that is asked for.
            let is_coloured = longest(rest, PAINTS)
                .is_some_and(|(_, words)| rest.get(words..).is_none_or(|rest| category(rest).is_none()));
            // "We are wanting it late at night" is no word about anything else.
            // "Ben freezes every night" is one.
            let is_adverb = at > from
                && matches!(
                    self.word(at - 1),
                    Some("every" | "last" | "all" | "at" | "the" | "this" | "that" | "each" | "in")
                );
            let is_sky = !is_adverb && longest(rest, &super::words::SKIES).is_some()
                || super::sky::hour(rest).is_some_and(|(_, words)| words > 1);
            // "They only ever saw its back".
            let is_only = self.word(at) == Some("only")
                && at > from
                && longest_phrase(&self.lexemes[from..at], WHO).is_some();
            is_sky
                || longest_phrase(rest, TAKES_BACK).is_some() && !is_only
                || is_coloured
                || numbers::length(rest).is_some_and(|(_, words)| words > 1)
        })
    }

    /// Whether an order stands where one may, understood or not.
    pub(super) fn orders_here(&self, from: usize, end: usize) -> bool {
        (from..end).any(|at| {
            let may = at == from
                || is_mark(&self.lexemes[at - 1])
                || matches!(
                    self.word(at - 1),
                    Some("and" | "then" | "please" | "just" | "now" | "so" | "also" | "kindly" | "or")
                );
            // "I need to know" is no order; what "I need a bench" is, is looked at elsewhere.
            let is_own = matches!(
                self.word(at),
                Some("i" | "we" | "im" | "id" | "wed" | "ill" | "well" | "there" | "theres")
            );
            may && !is_own
                && longest(&self.lexemes[at..end], &VERBS).is_some_and(|(verb, _)| {
                    at == from || !matches!(verb, Verb::Name | Verb::Describe | Verb::List | Verb::Count)
                })
        })
    }

    /// "The museum wants a tree": a wish, whatever is wished for.
    fn wishes_for(&self, from: usize, end: usize) -> bool {
        let nobody_here = self.names_nothing(from, end);
        let is_somebody = longest_phrase(&self.lexemes[from..end], WHO).is_some();
        let new = |at: usize| {
            let rest = &self.lexemes[at.min(end)..end];
            numbers::count(rest).is_some() || longest_phrase(rest, &["a", "an", "some"]).is_some()
        };
        // "People have to stand there", "she must be thirsty".
        let must_be = longest_phrase(
            &self.lexemes[from..end],
            &["he must be", "she must be", "they must be", "it must be", "you must be", "everybody must be"],
        );
        let is_state = must_be.is_some_and(|words| {
            from + words + 1 == end
                && self.word(from + words).is_some_and(|word| !word.ends_with("ed") && !word.ends_with("er"))
        });
        if nobody_here && (is_state || longest_phrase(&self.lexemes[from..end], CROWD).is_some()) {
            return self.wishes_for_new(from, end);
        }
        (from..end).any(|at| {
            // "Bo gets a stool" is a wish, and "the bench gets wet" none; and "the black car goes" is one.
            if longest_phrase(&self.lexemes[at..end], &["gets", "goes"]).is_some() {
                return new(at + 1) || at + 1 >= end || self.is_place(at + 1);
            }
            let Some(words) = longest_phrase(&self.lexemes[at..end], WISHES) else { return false };
            // "I need to know for the party" asks for nothing that is here.
            let rest = &self.lexemes[at + words..end];
            let asks = numbers::count(rest).is_some()
                || longest_phrase(
                    rest,
                    &[
                        "a",
                        "an",
                        "some",
                        "more",
                        "the",
                        "it",
                        "them",
                        "him",
                        "her",
                        "that",
                        "this",
                        "be",
                        "go",
                        "disappear",
                        "stand",
                        "look",
                        "have",
                    ],
                )
                .is_some();
            asks || rest.is_empty() || !nobody_here || !is_somebody
        })
    }

    /// Whether no thing, name, street or place of the scene, and none that could be new, is spoken of.
    pub(super) fn names_nothing(&self, from: usize, end: usize) -> bool {
        let named = |at: usize| {
            let rest = &self.lexemes[at..end];
            category(rest).is_some_and(|(class, _)| !is_of_people(class))
                || self.names.exact(rest).is_some()
                || self.view.streets.is_some_and(|streets| streets.at(rest).is_some())
                || !matches!(self.word(at), Some("there" | "here"))
                    && self.is_place(at)
                    && self.places_to(at, end).is_some()
        };
        !(from..end).any(named)
    }

    /// Somebody or something, and a verb of any kind; or a call of few words.
    fn tells_anything(&self, from: usize, end: usize) -> bool {
        let words = &self.lexemes[from..end];
        let is_call = words.len() <= 7
            && (self.lexemes.get(end).is_none_or(|mark| mark.token == Token::Break)
                || self.lexemes.get(end + 1..).is_some_and(|rest| longest(rest, &VERBS).is_some()))
            && words.iter().all(|word| matches!(word.token, Token::Word(_)));
        // Behind a request it might say how: "..., not too close".
        let is_before = self.lexemes[end..].iter().any(|lexeme| !is_mark(lexeme));
        let is_heading =
            is_call && is_before && longest_phrase(words, &["a", "an", "one", "two", "some"]).is_none();
        is_heading || self.tells_with_verb(from, end)
    }

    /// Somebody or something, and a verb of any kind.
    pub(super) fn tells_with_verb(&self, from: usize, end: usize) -> bool {
        let words = &self.lexemes[from..end];
        (from..end).any(|at| self.word(at).is_some_and(|word| IS.contains(word)))
            || longest_phrase(words, WHO).is_some() && words.len() > 2
            || self.has_a_verb(from, end)
    }

    /// "The bench by the museum gets wet": what is there, and what is so of it or what somebody does with it.
    fn tells_of_what_is_here(&self, from: usize, end: usize, leads: bool) -> bool {
        let words = &self.lexemes[from..end];
        let is_new =
            longest_phrase(words, &["a", "an", "some", "one"]).is_some() || numbers::count(words).is_some();
        if is_new || words.len() < 3 || self.is_place(from) {
            return false;
        }
        let has_verb = (from + 1..end)
            .any(|at| self.word(at).is_some_and(|word| super::remarks::is_state(word) || IS.contains(word)));
        // "The kids race their bikes on Elm Street".
        let is_somebody = longest_phrase(words, WHO).is_some_and(|who| {
            let own = self.word(from + who - 1).unwrap_or_default();
            !["all", "both", "some", "most", "many", "few", "that", "this", "these", "those", "what", "how"]
                .contains(&own)
        });
        // "The bench near the museum gets wet".
        let behind = || {
            let mut parser = self.parser(from, end);
            parser.reference(0).is_ok()
                && self.is_certain(from)
                && parser.at + 1 < end
                && self.word(parser.at).is_some_and(|word| {
                    !NO_VERB.contains(&word)
                        && word.ends_with('s')
                        && !is_of_an_order(word)
                        && category(&self.lexemes[parser.at..end]).is_none()
                })
        };
        leads || has_verb || is_somebody || self.has_a_verb(from, end) || behind()
    }

    /// "The choir sings", "cyclists fall": a noun, and behind it a word that is no small one and asks for nothing.
    fn has_a_verb(&self, from: usize, end: usize) -> bool {
        let the = longest_phrase(
            &self.lexemes[from..end],
            &["the", "my", "our", "your", "his", "her", "their", "this", "that", "those", "these"],
        )
        .unwrap_or(0);
        let is_plural =
            |at: usize| self.word(at).is_some_and(|word| word.ends_with('s') && !word.ends_with("ss"));
        (from + the + 1..end.min(from + the + 4)).any(|at| {
            let Some(word) = self.word(at) else { return false };
            let many = is_plural(at - 1) && (the > 0 || at == from + 1 || at == from + 2);
            let is_of_one = the > 0 && (word.ends_with('s') && !word.ends_with("ss") || word.ends_with("ed"));
            let is_verb = !NO_VERB.contains(&word)
                && category(&self.lexemes[at..end]).is_none()
                && !is_of_an_order(word)
                && !self.is_place(at);
            is_verb && (many || is_of_one) && at + 1 < end + usize::from(is_of_one)
        })
    }
}

/// "Moves", "moved": a form of an order's verb, by which something may be asked for.
fn is_of_an_order(word: &str) -> bool {
    let stems = [word.strip_suffix("es"), word.strip_suffix('s')];
    VERBS.begins(word)
        || super::forms::is_form(word)
        || stems.into_iter().flatten().any(|stem| stem.len() > 2 && VERBS.begins(stem))
}

/// Whether a class is of people alone.
pub(super) fn is_of_people(class: &super::super::lexicon::Category) -> bool {
    use simworld_core::scene::EntityKind;
    !class.kinds().is_empty() && class.kinds().iter().all(|kind| *kind == EntityKind::Person)
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    [TAKES_BACK, WISHES, WHO, IS].into_iter().flatten().flat_map(|phrase| phrase.split(' '))
}
