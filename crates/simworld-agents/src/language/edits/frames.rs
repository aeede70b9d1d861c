//! What stands before a request and says who wants it, how much and how kindly, and nothing of what: "it would be lovely if
//! you could ...", "I suggest that ...", "wouldn't it be nice if ...".
//!
//! Such a preamble is made of small words alone, so no list of whole phrases is needed. Words of denial and of condition are
//! none of them, but for the turns of politeness that hold one.

use std::collections::BTreeSet;
use std::sync::LazyLock;

use super::super::lexer::Token;
use super::super::lexicon::{category, longest_phrase};
use super::super::phrases::Phrases;
use super::parse::Reader;

/// The longest preamble, in words.
const LONGEST: usize = 16;
/// The small words of preambles.
const SMALL: &str = "a able about necessary essential important vital crucial desirable absolutely actually ahead all alright also am an and any anybody anyone appreciate are as \
     ask asking asks awesome be beg begging believe best better bit boss can care chance cheers client could course curious \
     customer dear decided definitely delighted demand do dream dude ensure everybody everyone expect fab fancy \
     fantastic favor favour feel feeling fine finally folks for get getting glad go going gonna good got gotta grand grateful \
     great guess guys had happy have having help helpful hey hi hmm hope hoping how i id idea if ill im imagine insist is \
     it itd its ive job just keen kind kindly let lets like listen little lot love lovely make mate may maybe me mean meant \
     might mind moment more much must my neat need needed needs next nice now obviously of oh ok okay opportunity order ought \
     our perfect perhaps picture plan please pleased pleasure point possible possibly prefer preferably pretty probably \
     propose quick quickly quite rather ready really reckon recommend request require required right say see seems shall \
     should simply so something sorry sort suggest suggestion suppose sure sweet task tell terribly thank thankful thanks \
     that thats the then thing think thinking this thought time to today totally trouble try trying uh um us usual very \
     wanna want wanted wants was way we wed well were what why will willing wish wishes with wonder wonderful wondering \
     would you youd your yo dreamt fun hereby officially nicer prettier cooler sir madam buddy bro pls plz see hello \
     kindness id've kids team people residents everyones super mega cute amazing marvellous splendid happier gladder prettier mate kindest somebody someone ya yer anybody glorious brilliant smart \
     wise sensible useful handy worth whole point being theyd they he she hed shed wants needs likes loves would must";
/// Turns of politeness and of wishing that hold words which else deny or ask on a condition.
#[rustfmt::skip]
const TURNS: &Phrases = &Phrases::of(&["would it be a lot of work to", "would it be much work to", "is it a lot of work to", "would it be a lot of trouble to", "would it be much trouble to", "would it be too much trouble to", "how hard would it be to", "would it be hard to", "if you dont mind", "if you do not mind", "why dont you", "why dont we", "why not", "wouldnt it be",
    "couldnt you", "couldnt we", "cant you", "cant we", "wont you", "dont you think", "do you not think", "dont forget to",
    "dont hesitate to", "shouldnt we", "shouldnt", "wouldnt", "couldnt", "isnt it time", "is it not time", "no rush but",
    "no worries but", "i wouldnt mind if", "i wouldnt mind", "we wouldnt mind", "i wouldnt say no to", "i dont suppose you could",
    "if its no trouble", "if you would be so kind", "do not forget to", "when you get a chance", "when you have a moment",
    "when you have time", "first of all", "first", "last but not least", "one more thing", "another thing", "next up", "arrange that", "arrange it so that", "arrange for it that", "see to it that", "make sure that", "ensure that", "take care that", "make it so that", "it is requested that", "it is my wish that", "it is our wish that", "it would be pleasing if", "the plan is that", "the idea is that", "i declare that", "i hereby declare that", "as your mayor", "as mayor",
    "from now on", "by the way", "on second thought", "on second thoughts", "come to think of it", "for starters",
    "to start with", "to begin with", "for a start", "here is what i want", "heres what i want", "in that case",
    "would it kill you to", "the least you could do is", "do me a solid and", "id be over the moon if", "up next",
    "do the needful and", "do me a favour", "do us a favour", "at this point", "the other thing", "there is one more thing", "theres one more thing"]);
/// Of those, and of small words, the ones that make a wish of a statement behind them.
#[rustfmt::skip]
const WISHING: &[&str] = &["want", "wants", "wanted", "wanna", "like", "love", "need", "needs", "wish", "wishes", "prefer", "fancy",
    "hope", "hoping", "require", "request", "suggest", "propose", "recommend", "insist", "demand", "imagine", "picture", "sure",
    "ensure", "nice", "great", "good", "lovely", "awesome", "cool", "neat", "wonderful", "better", "best", "if", "idea",
    "happy", "glad", "grateful", "appreciate", "please", "let", "time", "could", "can", "would", "should", "wouldnt",
    "couldnt", "shouldnt", "may", "might", "must", "reckon", "plan", "see", "how", "fun", "expect", "dream", "have",
    "get", "shall", "not", "rather", "arrange", "care", "requested", "pleasing", "declare", "idea", "plan", "going", "gonna", "lets", "id", "wed", "theyd", "hed", "shed", "loves", "likes"];
/// What asks what is or was so: no request.
#[rustfmt::skip]
const QUESTIONS: &Phrases = &Phrases::of(&["you see the", "you see that", "you know the", "you know that", "you know how", "people never", "people always", "people keep", "people cant", "people dont", "im a", "im an", "i am a", "i am an", "im the", "i am the", "hes a", "shes a", "hes the", "shes the", "he is a", "she is a", "did", "does", "do you see", "do you want", "has", "had you", "are you", "is it a", "was", "were", "when did",
    "what did", "who", "where", "which", "how much", "how is", "how was", "why did", "why is", "why was", "what is", "whats",
    "what was", "what are", "is the", "are the", "do you know", "do you have any idea", "have you heard", "how do", "how does", "tell me a", "tell us a", "tell me an", "tell us an", "sing me", "sing us", "sing a", "tell a", "read me a", "write me a", "write a", "tell me why", "tell me how", "tell me when", "tell me who"]);

/// That somebody is of another opinion than what follows.
#[rustfmt::skip]
const DENIES: &Phrases = &Phrases::of(&["i dont think", "we dont think", "i do not think", "we do not think", "i dont believe", "we dont believe", "i do not believe", "i dont reckon", "i dont feel", "i dont find", "i dont imagine", "i doubt", "we doubt", "i wouldnt say", "i would not say", "nobody thinks", "nobody believes", "i never thought", "i hardly think"]);

/// "For the street party": what something is for that takes place.
#[rustfmt::skip]
const EVENTS: &Phrases = &Phrases::of(&["walk", "hunt", "sale", "reception", "fundraiser", "party", "fair", "festival", "parade", "fete", "wedding", "race", "marathon", "concert", "show", "shoot", "shooting", "film", "match", "tour", "picnic", "ceremony", "festivities", "celebration", "celebrations", "run", "day", "night", "week", "weekend", "season", "exhibition", "protest", "march", "procession", "funeral", "championship", "tournament", "rehearsal", "opening"]);
static WORDS: LazyLock<BTreeSet<&str>> = LazyLock::new(|| SMALL.split_whitespace().collect());

/// Where a request may begin.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Beginning {
    pub(super) at: usize,
    /// Whether what stands before it makes a wish of a statement.
    pub(super) wished: bool,
}

impl Reader<'_> {
    /// Where a request may begin behind a preamble, the shortest first; the start itself is the first of them.
    pub(super) fn beginnings(&self, start: usize, end: usize) -> Vec<Beginning> {
        let mut found = vec![Beginning { at: start, wished: false }];
        if longest_phrase(&self.lexemes[start..end], QUESTIONS).is_some() {
            return found;
        }
        // "I don't think the bus would look good in green" asks for the contrary.
        if longest_phrase(&self.lexemes[start..end], DENIES).is_some() {
            return Vec::new();
        }
        // "It is so hot" asks for no weather.
        if longest_phrase(&self.lexemes[start..end], super::sky::COMPLAINS).is_some() {
            return found;
        }
        // "For more light, ..." says what for.
        if self.word(start) == Some("for")
            && self
                .word(start + 1)
                .is_some_and(|word| !["me", "us", "my", "the", "this", "a", "starters"].contains(&word))
        {
            return found;
        }
        let (mut at, mut wished) = (start, false);
        while at < end && found.len() <= LONGEST {
            let rest = &self.lexemes[at..end];
            let words = if let Some(words) = longest_phrase(rest, TURNS) {
                words
            } else if let Some(words) = (at == start).then(|| self.circumstance(at, end)).flatten() {
                words
            } else if matches!(rest[0].token, Token::Comma) && at > start
                || self.word(at).is_some_and(|word| WORDS.contains(word) && !(word == "if" && at == start))
            {
                1
            } else {
                break;
            };
            wished |= words > 2 && self.word(at) == Some("from");
            wished |= (at..at + words).any(|at| self.word(at).is_some_and(|word| WISHING.contains(&word)));
            at += words;
            found.push(Beginning { at, wished });
        }
        // "The green one": an article belongs to what follows.
        let is_article =
            |at: usize| matches!(self.word(at), Some("the" | "my" | "our" | "their" | "these" | "those"));
        found.retain(|beginning| {
            beginning.at < end && (beginning.at == start || !is_article(beginning.at - 1))
        });
        found
    }

    /// "For the shot", "in my level": how many words from here say on what occasion, and name nothing that is in the scene.
    fn circumstance(&self, at: usize, end: usize) -> Option<usize> {
        let rest = &self.lexemes[at..end];
        let mut words = longest_phrase(rest, &["for", "in", "during", "as for", "at"])?;
        words += longest_phrase(
            &rest[words..],
            &[
                "the",
                "my",
                "this",
                "our",
                "that",
                "a",
                "your",
                "these",
                "next",
                "the next",
                "the last",
                "the final",
                "the new",
            ],
        )?;
        // "For the street party".
        let event = (at + words..end.min(at + words + 4))
            .take_while(|at| self.word(*at).is_some() && !self.is_place(*at))
            .find(|at| self.word(*at).is_some_and(|word| EVENTS.contains(word)));
        if let Some(event) = event.filter(|_| self.word(at) == Some("for")) {
            return Some(event + 1 - at);
        }
        let is_plain = |at: &usize| {
            let here = &self.lexemes[*at..end];
            self.word(*at).is_some()
                && !WORDS.contains(self.word(*at).unwrap_or_default())
                && category(here).is_none()
                && self.names.part(&here[..1]).is_none()
                && self.view.streets.is_none_or(|streets| streets.at(here).is_none())
                && !self.is_place(*at)
        };
        let noun = (at + words..end.min(at + words + 2)).take_while(is_plain).count();
        (noun > 0).then_some(words + noun)
    }

    /// Whether what stands before a verb says nothing of its own.
    pub(super) fn is_preamble(&self, start: usize, begin: usize) -> bool {
        start == begin || self.beginnings(start, begin + 1).iter().any(|found| found.at == begin)
    }
}

/// Whether a word says nothing of what is asked for.
pub(super) fn is_small(word: &str) -> bool {
    const NEEDED: &[&str] = &[
        "needed",
        "wanted",
        "required",
        "missing",
        "requested",
        "due",
        "wants",
        "needs",
        "belongs",
        "goes",
        "stands",
        "sits",
    ];
    WORDS.contains(word) || NEEDED.contains(&word)
}

/// Every word here, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    SMALL.split_whitespace().chain(TURNS.iter().flat_map(|phrase| phrase.split(' ')))
}
