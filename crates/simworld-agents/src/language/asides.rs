//! What is said beside the orders and asks for nothing: "Gus has finished his session, so ...", "my knees won't do it",
//! "who's that over there?", "cool down: ...", "don't hurry so, ...". Whoever is named in it is spoken of.
//!
//! Only what cannot be an order is passed over: statements about others with a verb in them, questions that ask no favour,
//! headings, and what is not to be done. A sentence without an order besides is still not understood.

use super::clause::{Clause, Reference, Target};
use super::lexer::{Lexeme, Token, word_of};
use super::lexicon::{DETERMINERS, category, longest_phrase};
use super::numbers;
use super::parser::Parser;
use super::phrases::Phrases;
use super::politeness::NEGATIONS;
use super::verbs::longest_verb;

/// The longest aside, in tokens.
const LONGEST: usize = 24;
/// Who or what a statement is about that asks for nothing.
#[rustfmt::skip]
const SUBJECTS: &Phrases = &Phrases::of(&[
    "i", "he", "she", "it", "they", "we", "that", "this", "these", "those", "there", "somebody", "someone", "nobody",
    "everybody", "everyone", "people", "my", "his", "her", "its", "our", "their", "the", "a", "an", "some", "all",
    "im", "ive", "ill", "id", "hes", "shes", "theyre", "theyve", "theyll", "weve", "well", "its", "thats", "theres",
    "both", "no one", "most", "many", "everything", "nothing", "something", "who", "what", "here", "two",
    "three", "four", "neither", "either", "another", "each", "every",
]);
/// What makes a statement of words: a verb in a form that is no order.
#[rustfmt::skip]
const FINITE: &[&str] = &[
    "is", "are", "was", "were", "am", "has", "have", "had", "does", "did", "can", "cant", "cannot", "could", "couldnt",
    "will", "wont", "would", "wouldnt", "might", "may", "isnt", "arent", "wasnt", "werent", "hasnt", "havent", "hadnt",
    "doesnt", "didnt", "im", "ive", "ill", "hes", "shes", "its", "theyre", "theyve", "weve", "thats", "theres", "whos",
    "said", "told", "left", "lost", "forgot", "went", "came", "got", "made", "saw", "knew", "thought", "felt", "heard",
    "fancy", "crave", "looks", "seems", "feels", "hurts", "works", "lives", "knows", "says", "smells", "sounds", "hates", "loves",
    "likes", "keeps", "hurt", "ache", "aches", "hate", "love", "like", "miss", "know", "think", "guess", "suppose",
    "hope", "bet", "swear", "promise", "repeat", "recommend", "suggest", "fell", "fall", "falls", "stopped", "broke",
    "waits", "sits", "stands", "lies", "calls", "begins", "starts", "ends", "closes", "opens", "comes", "happens",
    "matters", "used", "depends", "looked", "seemed", "just", "never", "always", "aint", "ran", "took", "gave", "brought", "bought", "found",
    "overslept", "stood", "sat", "ate", "drank", "spoke", "wrote", "drove", "flew", "hid", "kept", "paid", "rang", "rode", "sang", "sent", "shook", "slept", "spent",
    "stole", "swam", "threw", "wore", "won", "woke", "began", "became", "caught", "chose", "dug", "drew", "fought", "froze", "grew", "held", "hung",
    "weigh", "weighs", "cost", "costs", "worry", "worries", "scare", "scares", "stinks", "squeaks", "itches", "bores", "annoys", "led", "lent", "meant", "met", "rose", "sold", "spilt", "stuck", "swore", "taught", "tore", "gives", "takes", "leaves", "arrives", "runs",
];
/// What asks for something, so that the words are no aside.
#[rustfmt::skip]
const ASKING: &[&str] = &[
    "must", "should", "shall", "ought", "need", "needs", "want", "wants", "if", "unless", "until", "till", "when",
    "whenever", "while", "before", "after", "please", "let", "once", "order", "ordered", "belongs", "goes", "wanted",
    "needed", "be", "request", "requests", "require", "requires", "prefer", "ask", "asked", "dont",
];
/// The same in several words.
#[rustfmt::skip]
const ASKING_SO: &Phrases = &Phrases::of(&[
    "would like", "id like", "would love", "id love", "has to", "have to", "is to", "are to", "supposed to",
    "could you", "can you", "would you", "will you", "as soon as", "as long as", "could do with", "is for",
    "you to", "is due", "to be", "had better",
]);
/// What asks for no favour.
#[rustfmt::skip]
const QUESTIONS: &Phrases = &Phrases::of(&[
    "who", "whos", "what", "whats", "where", "wheres", "which", "why", "how", "is", "isnt", "are", "arent", "was",
    "were", "does", "did", "has", "have", "had", "do", "dont", "am", "havent", "hasnt", "didnt",
]);
/// What says after the orders that there is no more to do.
#[rustfmt::skip]
const ENDS: &Phrases = &Phrases::of(&[
    "youre done", "you are done", "thats it", "that is it", "thats all", "that is all", "that will be all",
    "youre finished", "you can rest", "no slacking", "no hurry", "no rush", "no dawdling", "no buts", "no excuses",
    "no arguments", "no worries", "take your time", "you included", "not fast", "no detours", "no stopping",
    "you can call it a day", "thats what i want", "understood", "got it", "yes", "no more no less", "move move move",
    "go go go", "the end", "job done", "mission accomplished", "dismissed", "over and out", "over", "do you hear",
    "you hear", "isnt it", "arent you", "dont you", "wont you", "cheers then", "see you there", "see you then",
    "no dawdling in between", "without stopping", "no ifs no buts", "nothing else", "that is that", "thats that",
    "no more", "be careful", "mind how you go", "if you dare", "dont be late", "keep the change", "off you go",
    "none other", "and none other", "nothing else", "nobody else", "and nobody else", "and nothing else", "and thats all", "thats all i need", "thats everything", "no questions asked", "no cheating", "already", "instead", "as well", "after all", "either", "there and then", "at that", "thank goodness",
    "better safe than sorry", "the more the merrier", "the more the better", "third time lucky", "you never know", "once is not enough", "one is not enough",
    "once is never enough", "one is never enough", "two is better than one", "two are better than one", "that should do", "that should do it", "that should be enough",
    "that ought to do", "that ought to do it", "that will do", "thatll do", "thatll be enough", "that will be enough", "one wont do", "one wont be enough", "it cant hurt",
    "it wont hurt", "it never hurts", "you can never have too many", "you can never be too careful", "you cant have too many", "you can never be too sure",
    "come what may", "as usual", "as always", "why not", "just because", "trust me", "believe me",
]);

impl Parser<'_> {
    /// An aside with the order behind it.
    pub(super) fn aside(&mut self) -> Option<Vec<Clause>> {
        let end = self.aside_ends()?;
        let begin = self.at;
        let mut clauses = self.names_within(end);
        self.at = end;
        self.beside.absent |= self.speaks_of_absent(begin, end, &clauses);
        let goods = self.goods_within(begin, end);
        if let Some(goods) = goods.clone() {
            self.wish_for(goods); // "I forgot my newspaper, could you buy me one"
            self.settle_wish(&clauses);
        }
        self.skip_joints();
        if self.at >= self.lexemes.len() {
            return None;
        }
        // What takes up a thing of which nobody knows which it is is no order yet.
        let next = self.segment_end();
        let takes_up = self.lexemes[self.at..next]
            .iter()
            .any(|lexeme| ["it", "him", "her", "them", "there", "one"].contains(&word_of(lexeme)));
        let begins_test =
            longest_phrase(self.rest(), &["if", "when", "as soon as", "once", "until", "unless"]).is_some();
        if clauses.is_empty() && goods.is_none() && takes_up && !begins_test {
            return None;
        }
        clauses.extend(self.statement_here()?);
        Some(clauses)
    }

    /// Passes an aside behind an order, up to the next mark; whether there was any.
    pub(super) fn skip_aside(&mut self) -> bool {
        let start = self.at;
        if let Some(words) = longest_phrase(self.rest(), ENDS) {
            self.at += words;
            if self.ends_at_mark() {
                return true;
            }
            self.at = start;
        }
        let end = self.segment_end();
        let said = self.lexemes.get(start..end).unwrap_or_default();
        if says_what_is(said) && self.may_try() && !self.understood_from(start) {
            self.at = end;
            return true;
        }
        false
    }

    /// Whether an order could be read here.
    fn understood_from(&mut self, start: usize) -> bool {
        let understood = self.statement().is_ok() && self.ends_clause();
        self.at = start;
        understood
    }

    /// Where the words up to the next mark end, or a "so" that an order follows.
    fn segment_end(&self) -> usize {
        let is_end = |at: &usize| match &self.lexemes[*at].token {
            Token::Break | Token::Comma => true,
            Token::Word(word) => word == "so" && *at > self.at + 1,
            _ => false,
        };
        (self.at..self.lexemes.len()).find(is_end).unwrap_or(self.lexemes.len())
    }

    /// Where an aside that begins here ends, if one does.
    fn aside_ends(&self) -> Option<usize> {
        let end = self.segment_end();
        let said = self.lexemes.get(self.at..end).filter(|said| !said.is_empty() && said.len() <= LONGEST)?;
        let mark = self.lexemes.get(end).and_then(|lexeme| self.words[lexeme.start..].chars().next());
        let named = category(said).is_some()
            || self.is_capital(self.at)
            || self.names.exact(said).is_some()
            || self.whose(&said[..1]).is_some();
        let stated = says_what_is(said) || named && has_finite(said) && !asks(said);
        let aside = stated
            || mark == Some('?') && is_question(said)
            || mark == Some(':') && is_heading(said)
            || is_not_to_be(said)
            || self.wishes_in_vain(self.at, end)
            || self.states(self.at, end);
        aside.then_some(end)
    }

    /// Whether what stands here is said beside the orders.
    pub(super) fn aside_begins(&self) -> bool {
        longest_verb(self.rest()).is_none() && self.aside_ends().is_some()
    }

    /// "... is the red one", "... is the second from the left": the thing as it is said to be.
    pub(super) fn said_to_be(&mut self, what: &Reference) -> Option<Reference> {
        let start = self.at;
        if self.eat_any(&["is the", "are the"]) {
            self.at -= 1;
            let mut likeness = what.clone();
            self.modifiers(&mut likeness);
            let changed = likeness != *what;
            self.eat_any(&["one", "ones"]);
            if changed && self.described(&mut likeness, 0).is_ok() && self.ends_at_mark() {
                return Some(likeness);
            }
        }
        self.at = start;
        None
    }

    /// Who and what is named on the way to a place.
    pub(super) fn names_within(&mut self, end: usize) -> Vec<Clause> {
        let mut clauses = Vec::new();
        let mut spoken_of = None;
        let whole = self.lexemes;
        self.lexemes = &whole[..end];
        while self.at < end && clauses.len() < 2 {
            let start = self.at;
            let begins = longest_phrase(self.rest(), &["the", "that", "this", "my", "a", "an"]).is_some()
                || self.is_capital(self.at)
                || category(self.rest()).is_some()
                || self.at == 0 && self.names.exact(self.rest()).is_some();
            // "Lena's birthday is today".
            let owner = self.whose(&self.lexemes[start..=start]).filter(|owner| *owner != Target::Them);
            let what = match owner {
                Some(owner) => {
                    self.at += 1;
                    Some(Reference::to(owner, self.text_from(start)))
                }
                None if begins => self.reference(0).ok(),
                None => None,
            };
            let plain =
                |what: &Reference| matches!(what.target, Target::Named(_) | Target::Any(_) | Target::Id(_));
            // "Is that Ben by the mailbox?" is about Ben, wherever he is.
            let here = |what: &Reference| self.view.find(what, super::resolve::Purpose::Any).is_ok();
            let what = what.filter(plain).map(|what| {
                let named = matches!(what.target, Target::Named(_));
                if named && !here(&what) { Reference { relation: None, ..what } } else { what }
            });
            match what {
                Some(what) if self.view.find(&what, super::resolve::Purpose::Any).is_ok() => {
                    clauses.push(Clause::Mention { what });
                    // "The nearest shop is full of people, go to the second nearest one": one of the shops.
                    spoken_of = spoken_of.or_else(|| Some((self.class, self.bearers.clone())));
                }
                _ => self.at = start + 1,
            }
        }
        self.lexemes = whole;
        if let Some(spoken_of) = spoken_of {
            (self.class, self.bearers) = spoken_of;
        }
        clauses
    }
}

/// Whether something in the words asks for a deed, a time or an amount.
fn asks(said: &[Lexeme]) -> bool {
    (0..said.len()).any(|at| {
        let mine = ["i", "ill", "im", "ive"].contains(&word_of(&said[0])) && word_of(&said[at]) == "be";
        let after_all = longest_phrase(&said[at..], &["after all"]).is_some();
        ASKING.contains(&word_of(&said[at])) && !mine && !after_all
            || longest_phrase(&said[at..], ASKING_SO).is_some()
            || numbers::walked(&said[at..]).is_some_and(|(_, words)| words > 1)
    })
}

fn has_finite(said: &[Lexeme]) -> bool {
    said.iter().enumerate().skip(1).any(|(at, lexeme)| {
        let word = word_of(lexeme);
        let before = word_of(&said[at - 1]);
        // "All hands to the hydrant" states nothing.
        let plural = word.ends_with('s')
            && !["he", "she", "it", "that", "who", "nobody", "somebody", "someone"].contains(&before);
        // "Emil skipped breakfast", "my son missed the bus".
        let own = ["my", "his", "her", "our", "their"].contains(&word_of(&said[0]));
        let past = word.len() > 4
            && word.ends_with("ed")
            && (at == 1 && !own && longest_phrase(said, DETERMINERS).is_none() || at == 2 && own);
        let inflected = past || lexeme.lemma.is_some() && !word.ends_with("ing") && before != "to" && !plural;
        FINITE.contains(&word) || inflected
    }) || FINITE.contains(&word_of(&said[0])) && said.len() > 1 && word_of(&said[0]).len() > 1
}

/// Whether the words state something of somebody else, and ask for nothing.
pub(super) fn says_what_is(said: &[Lexeme]) -> bool {
    !said.is_empty()
        && said.len() <= LONGEST
        && longest_phrase(said, SUBJECTS).is_some()
        && has_finite(said)
        && !asks(said)
}

/// Whether a verb in a form that orders nothing stands in the words, behind who it is about.
pub(super) fn states_something(said: &[Lexeme]) -> bool {
    longest_phrase(said, SUBJECTS).is_some() && has_finite(said) && longest_verb(said).is_none()
}

/// Whether a word is such a form.
pub(super) fn is_finite(word: &str) -> bool {
    FINITE.contains(&word)
}

fn is_question(said: &[Lexeme]) -> bool {
    let about_you = said.iter().take(3).any(|lexeme| ["you", "we"].contains(&word_of(lexeme)));
    longest_phrase(said, QUESTIONS).is_some() && !about_you && !asks(said)
}

/// "Cool down:", "test cycle:": what follows says all that is to be done.
fn is_heading(said: &[Lexeme]) -> bool {
    const MOST: usize = 7;
    said.len() <= MOST
        && said.iter().all(|lexeme| matches!(lexeme.token, Token::Word(_) | Token::Number(_)))
        && !asks(said)
        && longest_phrase(said, NEGATIONS).is_none()
        && !(0..said.len()).any(|at| {
            numbers::times(&said[at..]).is_some()
                || numbers::number(&said[at..]).is_some_and(|(number, _)| number > 1.0)
                || numbers::duration(&said[at..]).is_some_and(|(_, words)| words > 1)
        })
        && longest_phrase(said, &["every", "each", "repeat", "rain", "dry", "in case", "when"]).is_none()
}

/// "Don't hurry so": what is not to be done, unless it is to be done later.
fn is_not_to_be(said: &[Lexeme]) -> bool {
    const LATER: &[&str] = &["until", "till", "unless", "before", "without", "if", "when", "but", "while"];
    let left_alone = said.last().is_some_and(|last| ["alone", "be"].contains(&word_of(last)))
        && longest_phrase(said, &["leave", "let"]).is_some()
        || longest_phrase(
            said,
            &[
                "skip",
                "ignore",
                "hands off",
                "keep off",
                "keep your hands off",
                "disregard",
                "beware of",
                "mind",
                "careful with",
                "watch out for",
                "no need for",
                "to hell with",
            ],
        )
        .is_some();
    let negated = longest_phrase(
        said,
        &[
            "dont",
            "do not",
            "never",
            "no need to",
            "you neednt",
            "never mind",
            "nevermind",
            "nvm",
            "forget",
            "neither",
            "no more",
            "you mustnt",
            "you must not",
            "not",
        ],
    )
    .is_some();
    (left_alone || negated && longest_verb(said).is_none())
        && !said.iter().any(|lexeme| LATER.contains(&word_of(lexeme)))
}
