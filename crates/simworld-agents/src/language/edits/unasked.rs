//! Whether a part of a sentence asks for something, for [`super::chatter`]: by what forbids, sets a condition, limits, orders or wishes in it, and by
//! whether it reads as a request; and whether, if it does not, it tells anything.

use super::super::asides::{is_finite, states_something};
use super::super::lexer::{Token, is_mark};
use super::super::lexicon::{category, longest, longest_phrase};
use super::super::numbers;
use super::super::paint::PAINTS;
use super::super::phrases::Phrases;
use super::super::talk::{begins_politely, is_bidden, is_filled, says_nothing};
use super::super::verbs::longest_verb;
use super::bare::IDLE;
use super::chatter::{DETERMINERS, Kind, Part};
use super::memo::Memo;
use super::mistaken::WAITS;
use super::parse::Reader;
use super::polite::{CODA, POLITE};
use super::says::LACKS;
use super::talk::ABSTRACT;
use super::told::{ORDERS_ANYTHING, WISHES, is_of_people};
use super::wish::Wish;
use super::words::{FACTORS, VERBS, WAYS};

/// What may stand before a part, and says nothing of it.
#[rustfmt::skip]
const LEADS: &Phrases = &Phrases::of(&["and", "so", "but", "oh", "well", "yes", "yeah", "yep", "ok", "okay", "right", "now", "anyway", "because", "since", "as", "cause", "cos", "coz", "also", "you see", "you know", "honestly", "frankly", "though", "although", "even though", "plus", "then", "still", "hey", "hi", "hello", "hiya",
    "ah", "hm", "hmm", "er", "erm", "um", "uh", "given that", "seeing that", "seeing as", "now that", "considering", "the thing is", "thing is", "the trouble is", "the point is", "you wont believe it but", "apparently", "luckily", "sadly", "unfortunately", "anyhow", "listen", "look"]);
/// By these a part forbids, sets a condition, limits, asks, or says how something should be, wherever they stand in it.
#[rustfmt::skip]
const GUARDS: &Phrases = &Phrases::of(&["if", "unless", "until", "till", "except", "excepting", "instead", "rather than", "other than", "apart from", "nothing but", "but not", "not the", "not a", "not that", "not this", "not those", "neither", "nor", "either", "please", "should", "shouldnt", "shall", "ought", "oughtnt", "mustnt", "supposed", "had better",
    "let", "lets", "let us", "would", "wouldnt", "could", "can you", "can we", "can i", "may i", "may we", "may you", "will you", "wont you", "how about", "what about", "why not", "make sure", "is to", "are to", "were to", "in case", "provided", "suppose", "supposing", "whenever", "as soon as", "as long as", "the one", "the ones", "that one", "this one",
    "the other", "the others", "the same", "i mean", "i meant", "we mean", "talking about", "speaking of", "make that", "make it", "or rather", "undo", "scratch", "cancel", "correction", "careful", "rule", "rules", "forbidden", "allowed", "belongs", "belong", "call it", "named", "called", "goes there", "goes here", "go there", "go here", "and then", "you should", "you must", "you have to", "you need to", "youre to", "you are to"]);
/// As [`GUARDS`], of what names a thing of the scene or stands behind a request: it may say how that is to be, or what is not to be done.
#[rustfmt::skip]
const LIMITS: &Phrases = &Phrases::of(&["not", "no", "never", "nobody", "none", "nothing", "nowhere", "without", "only", "just one", "each", "every", "both", "all of", "keep", "leave", "stay", "stays", "remain", "remains", "goes", "go", "gone", "going", "removed", "deleted", "painted", "moved", "replaced", "turned", "rotated", "swapped", "copied", "renamed", "closed", "shut", "opened", "reopened", "placed",
    "bigger", "smaller", "taller", "larger", "shorter", "wider", "higher", "lower", "more", "fewer", "less", "another", "again", "also", "too", "as well", "facing", "faces", "face", "looking at", "looks at", "middle", "corner", "side", "left", "right", "front", "back", "north", "south", "east", "west", "away", "apart", "metres", "meters", "here", "dont"]);
/// What begins a part that forbids, sets a condition, or says which is meant.
#[rustfmt::skip]
pub(super) const BEGINS: &Phrases = &Phrases::of(&["dont", "do not", "never", "not", "no", "none", "when", "once", "which", "who", "whose", "whom", "where", "wherever", "while youre", "otherwise", "after", "before", "by the time", "the moment", "as soon as", "as long as", "during", "or", "nor", "for", "with", "that is", "by", "of", "in", "on", "at", "to", "than", "like", "say", "maybe", "perhaps", "preferably", "ideally", "especially", "namely"]);
/// What begins a part that takes back what stands before it.
#[rustfmt::skip]
const TAKES_BACK: &Phrases = &Phrases::of(&["no", "nope", "nah", "wait", "hang on", "hold on", "sorry", "oops", "whoops", "actually", "or rather", "or no", "oh no", "ah no", "well no", "i mean", "i meant", "make that", "make it", "scratch that", "strike that", "correction", "on second thought", "on second thoughts", "come to think of it", "thinking about it", "or better", "not that", "not the", "not a", "but not", "instead"]);
/// As [`TAKES_BACK`], of all that was asked for.
const CANCELS: &Phrases = &Phrases::of(&[
    "never mind",
    "nevermind",
    "forget it",
    "forget that",
    "forget about it",
    "forget what i said",
    "ignore that",
    "ignore what i said",
    "disregard that",
    "cancel that",
    "cancel it",
    "undo that",
    "undo it",
    "take that back",
    "i take that back",
    "i take it back",
]);
/// Begins a question.
#[rustfmt::skip]
const QUESTIONS: &Phrases = &Phrases::of(&["how", "what", "whats", "who", "whos", "why", "when", "where", "wheres", "which", "do you", "do they", "dont you", "does", "did", "didnt", "is it", "isnt it", "is that", "isnt that", "is this", "isnt this", "are you", "arent you", "are they", "is he", "is she", "have you", "havent you", "has", "hasnt", "were you", "was it", "wasnt it", "wasnt that", "am i", "guess what", "guess who"]);
/// Of those, what asks of the scene.
#[rustfmt::skip]
const ASKS_OF_SCENE: &Phrases = &Phrases::of(&["how many", "how much", "how tall", "how big", "how high", "how far", "how wide", "how about", "which", "where", "wheres", "what is", "whats", "what are", "what about", "what if", "what do we have", "what have we", "what can", "what stands", "do you see", "does it", "does the", "does this", "does that", "has the", "has this"]);
/// Who has to do something that is done to nothing here.
#[rustfmt::skip]
const WE: &[&str] = &["i", "im", "ive", "ill", "we", "weve", "were", "they", "theyve", "people", "everyone", "everybody", "folks", "somebody", "someone", "nobody", "kids", "you"];
/// That somebody has to do something, or wants to.
#[rustfmt::skip]
const HAS_TO: &Phrases = &Phrases::of(&["must", "has to", "have to", "had to", "need to", "needs to", "needed to", "want to", "wants to", "wanted to", "wanna", "got to", "gotta", "going to", "gonna", "like to", "love to", "hopes to", "hope to", "hoping to"]);
/// What is done to things, or how they are to be.
#[rustfmt::skip]
const DOES: &Phrases = &Phrases::of(&["be", "go", "stand", "sit", "have", "get", "become", "look", "face", "turn", "move", "disappear", "vanish", "leave", "stay", "remain", "come", "wear", "change", "match", "fit", "point", "see", "close", "open", "make", "put"]);
/// How something is to seem, before words that say no more than that.
const SEEMS: &Phrases = &Phrases::of(&["look", "looks", "feel", "feels", "be", "seem", "become"]);
/// Words of that kind.
#[rustfmt::skip]
const NICER: &[&str] = &["nicer", "nice", "better", "prettier", "pretty", "livelier", "lively", "friendlier", "friendly", "safer", "safe", "cosier", "cosy", "cozy", "tidier", "tidy", "cleaner", "clean", "happier", "happy", "lovelier", "lovely", "good", "great", "beautiful", "welcoming", "cheerful", "festive", "fun", "comfortable", "perfect", "special", "more", "less", "a", "bit", "little", "so", "much", "as", "really", "very", "dull", "boring", "empty", "for", "everyone", "everybody", "visitors", "people", "guests", "them", "us", "me", "here", "again", "and"];
/// Before a noun and without a verb: no order begins so.
#[rustfmt::skip]
const BEFORE_NOUNS: &[&str] = &["in", "on", "at", "for", "with", "after", "before", "over", "by", "from", "under", "during", "since", "what", "such", "quite", "all", "half", "thats", "its", "heres", "theres", "too", "about", "like", "as", "so", "and", "or", "of", "always", "never"];
/// What is told of in a clause of its own.
const PRONOUNS: &[&str] =
    &["it", "its", "they", "theyre", "that", "thats", "this", "these", "those", "he", "she", "one"];
/// What somebody has or wants that is no thing, beside [`ABSTRACT`].
#[rustfmt::skip]
const VAGUE: &[&str] = &["lot", "lots", "bit", "few", "couple", "while", "minute", "moment", "second", "hour", "day", "days", "week", "year", "time", "headache", "call", "visit", "idea", "point", "word", "clue", "job", "holiday", "hand", "favour", "favor", "problem", "problems", "trouble", "help", "sleep", "lunch", "life", "laugh", "smile", "visitors", "guests", "people", "complaints", "tourists"];
/// A fragment without a verb has no more words.
const LONGEST_FRAGMENT: usize = 8;

impl Reader<'_> {
    fn behind_leads(&self, part: Part) -> usize {
        let mut start = part.from;
        while let Some(words) = longest_phrase(&self.lexemes[start..part.to], LEADS)
            && start + words < part.to
        {
            start += words;
        }
        start
    }

    /// What a part is said for, by itself.
    pub(super) fn kind_of(&self, part: Part, asked: bool, is_known: &dyn Fn(&Wish) -> bool) -> Kind {
        let (start, to) = (self.behind_leads(part), part.to);
        let words = &self.lexemes[start..to];
        if asked && longest_phrase(words, CANCELS).is_some() {
            return Kind::TakesBack;
        }
        if says_nothing(words) || says_nothing(&self.lexemes[part.from..to]) || self.is_courtesy(start, to) {
            return Kind::Idle;
        }
        if asked && self.takes_back(start, to) {
            return Kind::TakesBack;
        }
        if self.is_polite(start, to) {
            return Kind::Idle;
        }
        let is_question = self.is_question(part, start);
        if is_question || self.is_idle_order(start, to) {
            let asks = if is_question {
                longest_phrase(words, ASKS_OF_SCENE).is_some()
                    || (start..to).any(|at| self.is_guard(at, start, to))
            } else {
                self.has_order(start + 1, to)
            };
            return if asks || self.names_any(start, to) { Kind::Asks } else { Kind::Tells };
        }
        // "We are waiting for a delivery" would read as a wish.
        if longest_phrase(words, WAITS).is_some() && !self.is_guarded(start, to, false) {
            return Kind::Tells;
        }
        // "Lovely day today" would read as one too.
        if self.tells_of_sky(start, to) {
            return Kind::Tells;
        }
        let named = !self.names_nothing(start, to);
        // "..., it stands near the school" says where.
        let says_where = asked && named && self.word(start).is_some_and(|word| PRONOUNS.contains(&word));
        let asks = says_where
            || (part.from..start).any(|at| self.is_guard(at, part.from, to))
            || self.is_guarded(start, to, named || asked)
            || self.orders_something(start, to)
            || self.wants_something(start, to)
            || self.has_to_be(start, to)
            || self.is_request(start, to, is_known);
        if !asks && self.tells_something(start, to, (named, asked)) { Kind::Tells } else { Kind::Asks }
    }

    /// "Sorry about the mess", "for the record": said out of politeness, whatever stands behind it, where nothing is named or ordered.
    fn is_courtesy(&self, start: usize, to: usize) -> bool {
        begins_politely(&self.lexemes[start..to])
            && !self.names_any(start, to)
            && !(start..to).any(|at| self.is_guard(at, start, to))
            && !self.has_order(start + 1, to)
    }

    /// Whether nothing but politeness is said.
    fn is_polite(&self, start: usize, to: usize) -> bool {
        let words = &self.lexemes[start..to];
        let whole = |phrases: &Phrases| longest_phrase(words, phrases) == Some(words.len());
        let is_limit = |word: &str| {
            ["instead", "only", "but", "too", "also", "again", "somewhere", "anywhere"].contains(&word)
        };
        let limits = (start..to).any(|at| self.word(at).is_some_and(is_limit));
        (whole(CODA) || whole(POLITE) || is_filled(words)) && !limits
    }

    /// Whether a part asks something: it begins so, or a question mark stands behind it.
    fn is_question(&self, part: Part, start: usize) -> bool {
        let mark = self.lexemes.get(part.to).filter(|lexeme| is_mark(lexeme));
        let is_marked =
            mark.and_then(|mark| self.words.get(mark.start..)).is_some_and(|rest| rest.starts_with('?'));
        is_marked || longest_phrase(&self.lexemes[start..part.to], QUESTIONS).is_some()
    }

    /// "Let me think", "trust me": it reads like an order, and is none.
    fn is_idle_order(&self, start: usize, to: usize) -> bool {
        longest_phrase(&self.lexemes[start..to], IDLE).is_some()
    }

    /// Whether a verb of an order stands anywhere.
    fn has_order(&self, from: usize, to: usize) -> bool {
        (from..to).any(|at| longest(&self.lexemes[at..to], &VERBS).is_some())
    }

    /// Whether a guard stands here; "as if" is none.
    fn is_guard(&self, at: usize, start: usize, to: usize) -> bool {
        let as_if = at > start && self.word(at - 1) == Some("as") && self.word(at) == Some("if");
        longest_phrase(&self.lexemes[at..to], GUARDS).is_some() && !as_if
    }

    fn is_guarded(&self, start: usize, to: usize, is_close: bool) -> bool {
        let limits = |at: usize| {
            let rest = &self.lexemes[at..to];
            longest_phrase(rest, LIMITS).is_some()
                || longest(rest, PAINTS).is_some()
                || longest(rest, &FACTORS).is_some()
                || numbers::count(rest).is_some()
        };
        longest_phrase(&self.lexemes[start..to], BEGINS).is_some()
            || (start..to).any(|at| self.is_guard(at, start, to) || is_close && limits(at))
    }

    /// Whether something is ordered, whatever it is: a verb in its plain form stands first, or behind "and" and the like.
    fn orders_something(&self, start: usize, to: usize) -> bool {
        #[rustfmt::skip]
        const OWN: &[&str] = &["i", "we", "im", "id", "wed", "ill", "well", "ive", "weve", "there", "theres", "it", "its", "they", "theyre", "he", "she", "that", "thats", "this"];
        let words = &self.lexemes[start..to];
        let first = self.word(start).unwrap_or_default();
        let is_stated = OWN.contains(&first)
            || self.word(start + 1).is_some_and(|next| start + 1 < to && is_finite(next));
        let is_verb = longest(words, &VERBS).is_some()
            || longest_phrase(words, ORDERS_ANYTHING).is_some()
            || longest_verb(words).is_some()
            || is_bidden(first);
        let you = first == "you" && longest(words.get(1..).unwrap_or_default(), &VERBS).is_some();
        !is_stated && is_verb || you || self.orders_here(start, to)
    }

    /// Whether what was asked for is taken back, or put right. "No bus ever comes" does neither.
    fn takes_back(&self, start: usize, to: usize) -> bool {
        let words = &self.lexemes[start..to];
        let said = longest_phrase(words, TAKES_BACK).unwrap_or(0);
        let rest = &words[said..];
        let is_no = said == 1 && self.word(start) == Some("no");
        let is_put_right = || {
            rest.is_empty()
                || longest_phrase(rest, &["a", "an", "the", "not", "that", "this", "make", "it"]).is_some()
                || numbers::count(rest).is_some()
                || longest(rest, PAINTS).is_some()
                || longest(rest, &VERBS).is_some()
                || longest(rest, &WAYS).is_some()
        };
        said > 0 && (!is_no || is_put_right())
    }

    /// Whether something is wished for that may be a thing: "a unicorn" is, and "a rest" is none.
    fn wants_something(&self, start: usize, to: usize) -> bool {
        const ARTICLES: &Phrases = &Phrases::of(&[
            "a", "an", "some", "more", "another", "any", "the", "my", "our", "it", "them", "one",
        ]);
        const ENDS: &[&str] = &[
            "for", "of", "with", "to", "and", "after", "before", "from", "so", "that", "now", "today", "on",
            "in",
        ];
        let is_end = |at: &usize| self.word(*at).is_none_or(|word| ENDS.contains(&word));
        (start..to).any(|at| {
            let rest = &self.lexemes[at..to];
            let Some(words) = longest_phrase(rest, LACKS).max(longest_phrase(rest, WISHES)) else {
                return false;
            };
            let behind = at + words;
            let article = longest_phrase(&self.lexemes[behind..to], ARTICLES);
            let count = numbers::count(&self.lexemes[behind..to]).map(|(_, words)| words);
            let Some(noun) = article.max(count).map(|words| behind + words) else { return false };
            let end = (noun..to).find(is_end).unwrap_or(to);
            // "We'd like the walk to look nicer", and "I miss the old days".
            let is_to_seem = end < to && self.word(end) == Some("to") && self.seems(end + 1, to);
            let is_known = self.word(behind).is_some_and(|word| ["the", "my", "our"].contains(&word));
            if is_to_seem || is_known && !self.names_any(behind, end) {
                return false;
            }
            let last = if end > noun { self.word(end - 1) } else { None };
            !last.is_some_and(|last| ABSTRACT.contains(&last) || VAGUE.contains(&last))
        })
    }

    /// "It has to stand by the door": whether something is to be so; what somebody has to do by himself is not, nor how a place is to seem.
    fn has_to_be(&self, start: usize, to: usize) -> bool {
        let is_we = self.word(start).is_some_and(|word| WE.contains(&word));
        (start..to).any(|at| {
            let Some(words) = longest_phrase(&self.lexemes[at..to], HAS_TO) else { return false };
            let verb = at + words;
            let rest = &self.lexemes[verb..to];
            let orders = longest(rest, &VERBS).is_some() && self.names_any(verb, to);
            orders || !is_we && longest_phrase(rest, DOES).is_some() && !self.seems(verb, to)
        })
    }

    /// "Look nicer for visitors", and no more than that.
    fn seems(&self, from: usize, to: usize) -> bool {
        let words = longest_phrase(&self.lexemes[from..to], SEEMS);
        words.is_some_and(|words| {
            from + words < to
                && (from + words..to).all(|at| self.word(at).is_some_and(|word| NICER.contains(&word)))
        })
    }

    /// Whether a part is a request by itself. What nobody has is one where it is told of as something new.
    pub(super) fn is_request(&self, start: usize, to: usize, is_known: &dyn Fn(&Wish) -> bool) -> bool {
        let memo = Memo::default();
        let words = &self.lexemes[start..to];
        let Ok(wishes) = (Reader { lexemes: words, at: 0, memo: &memo, ..*self }).sentence() else {
            return false;
        };
        let is_new = longest_phrase(words, &["a", "an", "some", "another", "one", "more"]).is_some()
            || numbers::count(words).is_some();
        is_new || wishes.iter().flatten().all(is_known)
    }

    /// Whether somebody or something is said to be or to do something; before a request also without a verb, where nothing is named.
    fn tells_something(&self, start: usize, to: usize, (named, asked): (bool, bool)) -> bool {
        if self.many_do(start, to) {
            return true;
        }
        if named && self.one_begins(start, to) {
            return self.is_remark(start, to);
        }
        states_something(&self.lexemes[start..to])
            || self.tells_with_verb(start, to)
            || self.is_remark(start, to)
            || !asked && !named && self.is_fragment(start, to)
    }

    /// "Visitors park everywhere": several of whom none is a thing, and behind them a word that may be a verb.
    fn many_do(&self, start: usize, to: usize) -> bool {
        #[rustfmt::skip]
        const CROWD: &[&str] = &["people", "folks", "kids", "children", "visitors", "guests", "customers", "students", "tourists", "pupils", "patients", "drivers", "cyclists", "pedestrians", "parents", "neighbours", "residents", "teenagers", "locals", "shoppers", "commuters", "strangers", "everybody", "everyone"];
        const NO_VERBS: &[&str] = &[
            "please",
            "everywhere",
            "here",
            "there",
            "somewhere",
            "now",
            "again",
            "too",
            "instead",
            "today",
        ];
        let rest = &self.lexemes[start..to];
        let Some(first) = self.word(start) else { return false };
        let is_plural = first.len() > 3 && first.ends_with('s') && !first.ends_with("ss");
        let is_thing = || {
            category(rest).is_some_and(|(class, _)| !is_of_people(class))
                || self.names.asset_words(rest).is_some()
        };
        let may_be_verb = |word: &str| {
            !NO_VERBS.contains(&word)
                && !super::frames::is_small(word)
                && !super::says::is_between(word)
                && !self.is_place(start + 1)
        };
        (CROWD.contains(&first) || is_plural && !is_thing())
            && start + 1 < to
            && self.word(start + 1).is_some_and(may_be_verb)
    }

    /// "Cold hands here", "choir practice tonight": some words of which none is an order, and by which nothing is counted, placed or named.
    fn is_fragment(&self, start: usize, to: usize) -> bool {
        let words = &self.lexemes[start..to];
        let (first, second) =
            (self.word(start).unwrap_or_default(), self.word(start + 1).unwrap_or_default());
        let is_object = DETERMINERS.contains(&second) || ["it", "them", "him", "me", "us"].contains(&second);
        let is_told = is_finite(first)
            || first.ends_with("ed")
            || first.ends_with("ing")
            || BEFORE_NOUNS.contains(&first);
        (2..=LONGEST_FRAGMENT).contains(&words.len())
            && (!is_object || is_told)
            && !DETERMINERS.contains(&first)
            && words.iter().all(|lexeme| matches!(lexeme.token, Token::Word(_)))
            && numbers::number(words).is_none()
            && longest_phrase(words, &["more", "no", "any", "over there", "somewhere", "anywhere"]).is_none()
            && !self.is_place(start)
            && !self.names_any(start, to)
            && longest(words, PAINTS).is_none()
            && longest(words, &FACTORS).is_none()
    }

    /// Whether a thing, somebody, a street or what could be made is named.
    pub(super) fn names_any(&self, from: usize, to: usize) -> bool {
        (from..to).any(|at| {
            let rest = &self.lexemes[at..to];
            let behind_article =
                at > from && self.word(at - 1).is_some_and(|word| DETERMINERS.contains(&word));
            behind_article && self.names.asset_words(rest).is_some()
                || category(rest).is_some()
                || super::follow::species(&self.lexemes[at]).is_some()
                || self.names.exact(rest).is_some()
                || self.view.streets.is_some_and(|streets| streets.at(rest).is_some())
        })
    }
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    let phrases =
        [LEADS, GUARDS, LIMITS, BEGINS, TAKES_BACK, CANCELS, QUESTIONS, ASKS_OF_SCENE, HAS_TO, DOES];
    let phrases = phrases.into_iter().flatten().flat_map(|phrase| phrase.split(' '));
    phrases.chain(NICER.iter().copied())
}
