//! What follows an order and only says why: "..., they're short-handed", "so the truck gets past", "for the report".
//!
//! It is passed over if it is no order, states something with a subject and a verb, and asks for nothing.

use super::blocks::{IF, UNLESS, UNTIL, WHEN, WHILE};
use super::lexer::{Lexeme, Token, word_of};
use super::lexicon::{category, longest_phrase};
use super::numbers;
use super::parser::Parser;
use super::phrases::Phrases;
use super::politeness::{filler, joint};
use super::verbs::longest_verb;

/// The longest statement, in tokens.
const LONGEST: usize = 16;
/// What asks somebody for something, or says when.
#[rustfmt::skip]
const ASKING: &Phrases = &Phrases::of(&[
    "must", "should", "shall", "ought", "if", "unless", "until", "till", "when", "whenever", "while", "please", "let",
    "once", "as soon as", "as long as", "belongs", "goes to", "goes in", "to be", "you to", "you have to", "you need to",
    "you will", "you would", "you could", "you are to", "we have to", "we need to", "has to", "needs to", "need to be",
    "could you", "can you", "would you", "will you", "had better", "supposed to", "is for", "is to", "are to", "due at",
    "otherwise", "else", "i mean", "i meant", "make that", "instead", "dont forget", "is ordered", "before you", "after you", "then", "dont", "do not", "never",
]);
/// What somebody would have: it is asked for.
#[rustfmt::skip]
const WISHES: &Phrases = &Phrases::of(&[
    "i need", "i want", "i would like", "id like", "i fancy", "i could do with", "we need", "we want", "i will have",
    "ill have", "i would love", "id love",
]);
/// Who or what a statement is about.
#[rustfmt::skip]
const SUBJECTS: &Phrases = &Phrases::of(&[
    "i", "you", "he", "she", "it", "we", "they", "that", "this", "there", "these", "those", "im", "ive", "ill", "id",
    "youre", "youve", "hes", "shes", "its", "thats", "theres", "theyre", "theyve", "weve", "were", "nobody", "no one",
    "somebody", "someone", "everybody", "everyone", "everything", "nothing", "something", "one of them", "some of them",
    "none of them", "all of them", "both of them", "the first one", "the other one", "the closest one", "the nearest one",
    "my", "your", "his", "her", "our", "their", "the", "a", "an", "some", "people", "who", "what",
]);
/// A verb that states.
#[rustfmt::skip]
const STATES: &Phrases = &Phrases::of(&[
    "is", "are", "was", "were", "am", "has", "have", "had", "does", "do", "did", "can", "cant", "cannot", "could", "couldnt",
    "will", "wont", "wouldnt", "might", "may", "isnt", "arent", "wasnt", "werent", "hasnt", "havent", "hadnt", "doesnt",
    "didnt", "said", "told", "lost", "forgot", "went", "came", "got", "made", "saw", "knew", "thought", "felt",
    "heard", "look", "looks", "looked", "seem", "seems", "seemed", "feel", "feels", "sound", "sounds", "smell", "smells",
    "want", "wants", "need", "needs", "like", "likes", "love", "loves", "hate", "hates", "know", "knows", "think", "thinks",
    "guess", "hope", "live", "lives", "work", "works", "keeps", "keep", "hurts", "hurt", "ache", "aches", "flickers", "leaks",
    "wobbles", "squeaks", "creaks", "rattles", "closes", "opens", "starts", "begins", "ends", "stops", "sells", "costs",
    "comes", "leaves", "arrives", "departs", "drives", "go", "takes", "gets", "get", "goes", "says", "asked", "called", "promised", "bet", "swear", "miss", "misses", "fell",
    "broke", "died", "ran", "im", "ive", "hes", "shes", "its", "thats", "theres", "theyre", "theyve", "weve", "youre", "youve",
    "used", "cut", "ate", "drank", "burnt", "slept", "woke", "caught", "bit", "tore", "won", "grew", "stole", "hit", "froze", "met", "paid", "sold", "sent", "sleeps", "eats", "drinks", "just", "always", "never", "must be", "meet", "fits", "helps", "matters", "moved", "barks", "bites", "deserve",
    "deserves", "belong", "prefer", "prefers", "missed", "spilt", "spilled", "dropped", "needed", "wanted", "whos", "whats",
]);

/// Subject and verb in one word.
#[rustfmt::skip]
const CONTRACTED: &Phrases = &Phrases::of(&[
    "im", "ive", "ill", "hes", "shes", "its", "thats", "theres", "theyre", "theyve", "theyll", "weve", "youre", "youve",
    "were",
]);
/// Behind which a verb in its third person is no plural.
const PRONOUNS: &[&str] = &[
    "i",
    "you",
    "he",
    "she",
    "it",
    "we",
    "they",
    "that",
    "who",
    "nobody",
    "somebody",
    "someone",
    "everybody",
    "one",
];

impl Parser<'_> {
    /// "To" before what is done there: "go to the kiosk to buy water".
    pub(super) fn skip_purpose(&mut self) -> bool {
        const PURPOSES: &Phrases = &Phrases::of(&[
            "to",
            "in order to",
            "so as to",
            "so you can",
            "so that you can",
            "so you could",
            "where you can",
            "where you",
            "there to",
            "and there",
        ]);
        let purpose = longest_phrase(self.rest(), PURPOSES)
            .filter(|words| longest_verb(self.rest().get(*words..).unwrap_or_default()).is_some());
        self.at += purpose.unwrap_or(0);
        purpose.is_some()
    }

    /// Whether something may still be read on trial.
    pub(super) fn may_try(&mut self) -> bool {
        let left = self.tries.checked_sub(1);
        self.tries = left.unwrap_or(0);
        left.is_some()
    }

    /// "You look like you need a rest, ...": what is said of who hears it, before an order.
    pub(super) fn skip_opening(&mut self) {
        let end = self.mark_from(self.at);
        let follows = end + 1 < self.lexemes.len();
        if longest_phrase(self.rest(), &["you", "youre", "youve"]).is_some() && follows {
            let _ = self.lacks(end) || self.skip_statement();
        } else if follows && self.peeks("we") {
            self.lacks(end);
        }
    }

    /// "You could do with some exercise, ...": what nobody here sells or is; whether that was said up to there.
    fn lacks(&mut self, end: usize) -> bool {
        #[rustfmt::skip]
        const LACKS: &Phrases = &Phrases::of(&[
            "you could do with", "you could use", "you look like you need", "you look like you could use", "you look as if you need", "you look like you could do with",
            "you need", "you really need", "you deserve", "youve earned", "you have earned", "we could do with", "we could all do with", "we could use", "we all need",
            "you must need", "you probably need", "you can use", "you look like",
        ]);
        let Some(words) = longest_phrase(self.rest(), LACKS) else { return false };
        let known = |at: usize| {
            let rest = &self.lexemes[at..end];
            category(rest).is_some() || self.names.goods(rest).is_some() || self.names.exact(rest).is_some()
        };
        let from = self.at + words;
        let what = from < end && longest_phrase(&self.lexemes[from..end], &["to", "not"]).is_none();
        let lacks = what && !(from..end).any(known);
        if lacks {
            self.at = end;
        }
        lacks
    }

    /// "Careful, ...", "not so fast, ...", "right, ...": what is called out before an order; whether there was any.
    pub(super) fn skip_warning(&mut self) -> bool {
        #[rustfmt::skip]
        const WARNINGS: &Phrases = &Phrases::of(&[
            "careful", "be careful", "hurry", "hurry up", "watch out", "look out", "quick", "come quick", "mind your step", "watch your step", "heads up",
        ]);
        // An order of their own where no other follows.
        #[rustfmt::skip]
        const CALLS: &Phrases = &Phrases::of(&[
            "not so fast", "not so quick", "not so quickly", "not yet", "whoa", "woah", "easy", "easy now", "easy there", "easy does it", "steady", "steady on", "steady now",
            "hold your horses", "hang on", "hold on", "hang on a second", "hang on a minute", "hang on a moment", "hang on a sec", "hold on a second", "hold on a minute",
            "hold on a moment", "hold on a sec", "one moment", "one second", "one sec", "one minute", "just a moment", "just a second", "just a sec", "just a minute",
            "calm down", "relax", "no rush", "no hurry", "no need to hurry", "no need to rush", "no need to run", "theres no rush", "theres no hurry", "there is no rush",
            "there is no hurry", "lets see", "let us see", "let me see", "let me think", "lets think", "where were we", "where was i", "ah yes", "right", "right now then",
            "okay right", "a second", "a moment", "a sec", "look", "so right", "now then", "never mind that",
        ]);
        let start = self.at;
        // "Let's" alone is politeness.
        if longest_phrase(self.rest(), CALLS).is_none() {
            self.skip_joints();
        }
        let begin = self.at;
        let said = self.eat_any(WARNINGS);
        let called = !said && self.eat_any(CALLS);
        let marked = matches!(self.rest(), [Lexeme { token: Token::Comma | Token::Break, .. }, _, ..]);
        if said && marked {
            return true;
        }
        if called && marked {
            while self.rest().first().is_some_and(super::lexer::is_mark) {
                self.at += 1;
            }
            if longest_phrase(self.rest(), CALLS).is_none() {
                self.skip_joints();
            }
            let again = longest_phrase(self.rest(), CALLS).is_some()
                || longest_phrase(self.rest(), &["there is", "theres", "here is", "that is", "thats"])
                    .is_some();
            if again || longest_verb(self.rest()).is_some() || self.begins_block() {
                return self.at > begin;
            }
        }
        self.at = start;
        false
    }

    /// Passes statements behind an order, each with the mark before it: "you" would be passed over as politeness.
    pub(super) fn skip_statements(&mut self) {
        let is_mark = |at: usize| {
            matches!(self.lexemes.get(at), Some(Lexeme { token: Token::Comma | Token::Break, .. }))
        };
        let passed = self.at > 0 && is_mark(self.at - 1) && !is_mark(self.at);
        if passed && self.at < self.lexemes.len() {
            self.skip_statement();
        }
        while matches!(self.rest(), [Lexeme { token: Token::Comma | Token::Break, .. }, _, ..]) {
            self.at += 1;
            if !self.skip_statement() {
                self.at -= 1;
                return;
            }
        }
    }

    /// Passes a statement behind an order, up to the next mark; whether there was any.
    fn skip_statement(&mut self) -> bool {
        let (start, end) = (self.at, self.mark_from(self.at));
        if !self.states(start, end) && !self.wishes_in_vain(start, end) {
            return false;
        }
        let idle = self.is_under_way(start, end);
        if idle || self.may_try() && !self.is_order(start) {
            self.at = end;
            return true;
        }
        false
    }

    /// "... so the truck gets past", "... so that everybody sees it".
    pub(super) fn skip_outcome(&mut self) -> bool {
        let Some(so) = longest_phrase(self.rest(), &["so", "so that", "such that"]) else { return false };
        let (start, end) = (self.at, self.mark_from(self.at));
        let from = start + so;
        // "... so we can put up our tent": what we do then is nothing that is asked for.
        let ours = [
            "we can",
            "we could",
            "we may",
            "i can",
            "i could",
            "they can",
            "they could",
            "he can",
            "she can",
        ];
        if longest_phrase(&self.lexemes[from..], &ours).is_some() {
            self.at = end;
            return true;
        }
        let stated = from < end
            && longest_phrase(
                &self.lexemes[from..],
                &["you", "we", "then", "please", "go", "long as", "far as"],
            )
            .is_none()
            && longest_verb(&self.lexemes[from..]).is_none()
            && self.says(from, end);
        if stated && self.may_try() && !self.is_order(from) {
            self.at = end;
            return true;
        }
        false
    }

    /// "... for the report", "... for my album": what for, where it is nothing that is here.
    pub(super) fn skip_use(&mut self) -> bool {
        let determiner =
            ["for the", "for my", "for our", "for his", "for her", "for their", "for a", "for an"];
        let Some(words) = longest_phrase(self.rest(), &determiner) else { return false };
        let (from, end) = (self.at + words, self.mark_from(self.at));
        let what = self.lexemes.get(from..end).unwrap_or_default();
        let unknown = (1..=3).contains(&what.len())
            && what.iter().all(|lexeme| matches!(lexeme.token, Token::Word(_)))
            && category(what).is_none()
            && self.names.exact(what).is_none()
            && self.names.goods(what).is_none()
            && numbers::duration(&self.lexemes[self.at + 1..]).is_none();
        if unknown {
            self.at = end;
        }
        unknown
    }

    pub(super) fn mark_from(&self, from: usize) -> usize {
        let is_mark = |at: &usize| match &self.lexemes[*at].token {
            Token::Break | Token::Comma => true,
            // "They go so fast" ends at no "so".
            Token::Word(word) => {
                let after = &self.lexemes[at + 1..];
                let how = longest_phrase(
                    after,
                    &["fast", "quickly", "slow", "slowly", "much", "many", "long", "well"],
                );
                let follows = longest_verb(after).is_some()
                    || filler(after).is_some()
                    || longest_phrase(after, SUBJECTS).is_some()
                    || after.is_empty();
                word == "so" && *at > from && how.is_none() && follows
            }
            _ => false,
        };
        (from..self.lexemes.len()).find(is_mark).unwrap_or(self.lexemes.len())
    }

    /// Whether the words state something and ask for nothing.
    pub(super) fn states(&self, from: usize, end: usize) -> bool {
        let said = &self.lexemes[from..end];
        if (0..said.len()).any(|at| {
            joint(&said[at..]).is_some_and(|words| at == 0 || longest_verb(&said[at + words..]).is_some())
        }) {
            return false; // "they are late and go home" goes on with an order
        }
        let about = longest_phrase(said, SUBJECTS).is_some()
            || self.is_capital(from) && longest_verb(said).is_none()
            || self.is_contracted(from)
            || self.stated_at(from, end).is_some_and(|at| at <= from + 3) && longest_verb(said).is_none();
        let what_for = longest_phrase(said, WISHES).is_some_and(|words| {
            longest_phrase(&said[words..], &["to", "it", "them", "that", "this", "him", "her"]).is_none()
        });
        about && !what_for && self.says(from, end)
    }

    pub(super) fn says(&self, from: usize, end: usize) -> bool {
        let said = &self.lexemes[from..end];
        !said.is_empty()
            && said.len() <= LONGEST
            && self.stated_at(from, end).is_some()
            && !(0..said.len()).any(|at| {
                [ASKING, IF, UNLESS, UNTIL, WHILE, WHEN]
                    .iter()
                    .any(|list| longest_phrase(&said[at..], list).is_some())
            })
            && (longest_phrase(said, &["you can"]).is_none()
                || longest_phrase(said, &["you can see", "you can hear", "you can tell"]).is_some())
    }

    /// Where the verb of a statement is.
    fn stated_at(&self, from: usize, end: usize) -> Option<usize> {
        (from..end).find(|at| {
            let (lexeme, here) = (&self.lexemes[*at], &self.lexemes[*at..]);
            let before = if *at > from { word_of(&self.lexemes[at - 1]) } else { "" };
            let somebody = PRONOUNS.contains(&before);
            let past = lexeme.lemma.is_some()
                && (somebody && word_of(lexeme).ends_with('s') || word_of(lexeme).ends_with("ed"));
            let verb = longest_phrase(here, STATES).is_some()
                || somebody && longest_phrase(here, &["left", "put", "set"]).is_some();
            *at > from && (verb || past && before != "the")
                || *at == from && longest_phrase(here, CONTRACTED).is_some()
                || self.is_contracted(*at)
        })
    }

    /// "I need some cash", "I fancy something cold": what is wished for and is nothing that is here.
    pub(super) fn wishes_in_vain(&self, from: usize, end: usize) -> bool {
        let said = &self.lexemes[from..end];
        let Some(words) = longest_phrase(said, WISHES) else { return false };
        let unknown = |at: usize| {
            let rest = &self.lexemes[at..];
            category(rest).is_none() && self.names.goods(rest).is_none() && self.names.exact(rest).is_none()
        };
        said.len() > words
            && said.len() <= LONGEST
            && longest_phrase(&said[words..], &["you", "somebody", "someone", "to"]).is_none()
            && (from + words..end).all(unknown)
    }

    /// "Grandma's waiting", "doctor's orders": "'s" behind what is neither here nor anybody here.
    fn is_contracted(&self, at: usize) -> bool {
        let lexeme = &self.lexemes[at];
        let written = &self.words[lexeme.start..lexeme.end];
        let whose = self.lexemes.get(at + 1..).is_some_and(|after| category(after).is_some())
            && self.whose(&self.lexemes[at..=at]).is_some();
        written.contains(['\'', '’']) && !word_of(lexeme).ends_with("nt") && !whose
    }

    /// "We're leaving", "they are waiting": nothing that somebody else is told to do.
    fn is_under_way(&self, from: usize, end: usize) -> bool {
        let said = &self.lexemes[from..end];
        let about = longest_phrase(
            said,
            &[
                "we are", "i am", "they are", "he is", "she is", "im", "theyre", "hes", "shes", "it is",
                "its", "were", "weve",
            ],
        );
        about.is_some_and(|words| {
            let verb = said.get(words).is_some_and(|lexeme| word_of(lexeme).ends_with("ing"));
            verb && said.len() <= words + 2
                && said
                    .get(words + 1)
                    .is_none_or(|last| ["now", "already", "soon", "late", "again"].contains(&word_of(last)))
        })
    }

    /// Whether an order could be read from there.
    fn is_order(&mut self, from: usize) -> bool {
        let start = std::mem::replace(&mut self.at, from);
        let kept = (
            self.class,
            self.bearers.clone(),
            self.verb,
            self.previous,
            self.scope.clone(),
            (self.wanted.clone(), self.wished, self.wished_by.clone()),
        );
        let understood = self.statement().is_ok() && self.ends_clause();
        self.at = start;
        (self.class, self.bearers, self.verb, self.previous, self.scope) =
            (kept.0, kept.1, kept.2, kept.3, kept.4);
        (self.wanted, self.wished, self.wished_by) = kept.5;
        understood
    }
}
