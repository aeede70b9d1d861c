//! Remarks beside an edit that are none of the edits that they read like, and orders whose things are told in a clause before them.
//!
//! How a place looks ("..., it looks so bare down there") and turns of phrase that would be misunderstood are put plainly before a sentence is read.
//! Reasons ("..., since half of my class cycles in"), effects ("..., that should catch the light"), likenesses ("..., as if ...") and causes ("After
//! that burglary, ...") are left out last of all, where a sentence is refused in every other way; and only beside something else.

use super::super::lexer::{Lexeme, Token, is_mark, word_of};
use super::super::lexicon::{category, longest, longest_phrase};
use super::super::names::Names;
use super::super::numbers;
use super::super::paint::PAINTS;
use super::super::phrases::Phrases;
use super::forms::{word, word_at};
use super::retold::{Turns, told_by};
use super::said_beside::without_last;
use super::words::VERBS;

/// Turns of phrase that would be misunderstood, in the notation of [`super::turns`].
#[rustfmt::skip]
const EARLY: &Turns = &[
    ("id|wed|i|we|- would|- love|like|want N a|- way|much|far|lots|lot|- bigger|larger ,|- like|say|maybe|perhaps|about|roughly|- times D", "make N D times as big"),
    ("id|wed|i|we|- would|- love|like|want N a|- way|much|far|lots|lot bigger|larger ,|- like|say|maybe|perhaps|about|roughly|- D times", "make N D times as big"),
    ("P a|- way|much|far|lots|lot|- bigger|larger ,|- like|say|maybe|perhaps|about|roughly|- times D", "P D times as big"),
    ("P a|- way|much|far|lots|lot bigger|larger ,|- like|say|maybe|perhaps|about|roughly|- D times", "P D times as big"),
    ("O dig|drill|bore D P", "O put D P"),
    ("folk|folks|people|visitors|tourists|everyone|everybody|guests|kids|children|students|passengers will|would|are|shall|might be|going|- needing|need|wanting|want|requiring D A", "add D A"),
    ("P put a|an A in its|his|her place , a|an K one i|- should|- say|mean|-", "P put a K A in its place"),
    ("P , he|she|they is|are getting|becoming|all wet|soaked|drenched|cold|hot", "P"),
    ("P get D A to play|sing|dance|perform|pose|stand|wait|sit|sleep|queue W", "P put D A W"),
    ("P let D A stretch|gather|rest|play|dance|sing|perform|pose|meet|assemble|queue|linger|relax|jog|exercise|practise|picnic|camp|graze|bask|loiter just|right|directly|out|around|- W", "P put D A W"),
    ("P the A that|which|who has|have D B standing|sitting|parked|lying|placed|- right|just|directly|- beside|near|behind to|- it|him|her|them", "P the A next to D B"),
    ("P , and N F", "P , and make N F"),
    // What a sentence singles out is what it goes on about.
    ("W , line up D A", "line up D A W"),
    ("which|what things|objects|items are K", "list everything that is K"),
    ("its N that|which|who A , so|- please|- B it|him|her C", "B N C"),
];
/// What is told of first, and "it" in the order behind it.
#[rustfmt::skip]
const NAMED_FIRST: &Turns = &[
    ("N looks|look|seems|seem|feels|is|are|was|were A , B it|them|him|her C", "B N C"),
    ("N looks|look|seems|seem|feels|is|are|was|were A , B it|them|him|her", "B N"),
];
/// A place, or what is there, of which somebody tells how it looks.
#[rustfmt::skip]
const PLACE_SEEMS: &Phrases = &Phrases::of(&["it looks", "it is", "its", "it seems", "it feels", "it looked", "that looks", "that is", "thats", "this looks", "this is", "that place looks", "that place is", "this place looks", "this place is", "the place looks", "the place is", "that corner looks", "that corner is", "this corner looks", "everything looks", "everything is", "things look", "all looks", "all is"]);
const REASONS_FIRST: &Phrases = &Phrases::of(&["because", "since", "as", "cause", "cos", "for"]);
#[rustfmt::skip]
const SO: &Phrases = &Phrases::of(&["so", "too", "far too", "very", "rather", "quite", "pretty", "really", "awfully", "terribly", "a bit", "a little", "so very", "just so", "just too", "always so"]);
/// How a place looks where something is missing; "dark" is a sky.
#[rustfmt::skip]
const BARE: &[&str] = &["bare", "empty", "dull", "boring", "lonely", "sad", "drab", "bleak", "naked", "plain", "dreary", "dead", "lifeless", "deserted", "ugly", "gloomy", "barren", "desolate", "dismal", "unfriendly", "unwelcoming", "forlorn", "abandoned", "shabby"];
const OVER: &[&str] = &["down", "over", "up", "out", "around", "round", "right", "back", "in"];
/// What may stand before a noun, and says nothing that has to be known.
const LOOKS: &Phrases =
    &Phrases::of(&["old", "ugly", "stupid", "silly", "rusty", "shabby", "awful", "horrible"]);
#[rustfmt::skip]
const MUST: &Phrases = &Phrases::of(&["must", "should", "shall", "can", "may", "could", "has to", "have to", "had better", "needs to", "need to", "ought to"]);
#[rustfmt::skip]
const VANISHES: &Phrases = &Phrases::of(&["go", "disappear", "vanish", "leave", "go away", "go now", "disappear now", "leave now"]);
/// Before a reason that stands behind a mark.
#[rustfmt::skip]
const REASONS: &Phrases = &Phrases::of(&["since", "because", "as", "cause", "cos", "coz", "seeing that", "seeing as", "given that", "now that"]);
/// Behind "as": no reason.
#[rustfmt::skip]
const NO_REASONS: &[&str] = &["well", "big", "large", "tall", "small", "high", "wide", "far", "close", "near", "many", "much", "soon", "long", "if", "though", "before", "always", "usual"];
const AS_IF: &Phrases = &Phrases::of(&["as if", "as though", "just as if", "just as though", "almost as if"]);
/// What an edit comes to, and nothing that is to be done.
#[rustfmt::skip]
const WILL: &Phrases = &Phrases::of(&["that should", "that will", "that would", "that ought to", "that might", "that may", "thatll", "thatd", "this should", "this will", "this would", "this ought to", "this might", "which should", "which will", "which would", "which ought to", "which might", "which may", "it will", "it would", "it might", "itll", "itd"]);
/// Behind that, how something is to be.
#[rustfmt::skip]
const TO_BE: &[&str] = &["be", "go", "stand", "sit", "hang", "face", "have", "get", "become", "come", "move", "turn", "point", "look", "stay", "remain", "disappear", "vanish", "leave", "match", "need", "not", "also", "then", "belong", "cost", "measure", "wear"];
const ITS: &Phrases = &Phrases::of(&["it", "that", "this", "they", "it just", "it simply", "it really"]);
#[rustfmt::skip]
const SUITS: &Phrases = &Phrases::of(&["suits", "suit", "flatters", "becomes", "complements", "fits in", "fits better", "fits the", "goes with", "goes better with", "goes well with", "goes nicely with", "blends in", "blends", "works better", "looks better", "looks nicer", "looks smarter", "matches"]);
/// Before what happened, in front of an order.
#[rustfmt::skip]
const CAUSES: &Phrases = &Phrases::of(&["after", "because of", "thanks to", "given", "due to", "in view of", "in light of", "in the light of", "on account of", "following", "owing to", "before", "ahead of"]);
#[rustfmt::skip]
const WHOSE: &Phrases = &Phrases::of(&["the", "that", "this", "those", "these", "all that", "all this", "all the", "such", "my", "our", "your", "his", "her", "their", "a", "an", "yesterdays", "todays", "tomorrows", "last"]);
/// What happens at a time. "Before" anything else may be a place.
#[rustfmt::skip]
const EVENTS: &[&str] = &["event", "party", "festival", "parade", "market", "fair", "wedding", "storm", "rain", "winter", "summer", "lunch", "dinner", "breakfast", "visit", "inspection", "meeting", "concert", "weekend", "holidays", "rush", "night", "season", "opening", "ceremony", "race", "marathon", "election", "match", "game", "exam", "exams", "term", "celebration", "anniversary", "funeral"];
/// By these a part asks for something, forbids it or limits it.
#[rustfmt::skip]
const ASKS: &Phrases = &Phrases::of(&["please", "should", "must", "instead", "except", "only", "unless", "if", "but", "rather than", "let", "lets", "to be", "to have", "to get", "to see", "to put", "to add", "to remove", "to move", "to paint", "not the", "not a", "until", "can you", "could you", "would you", "i want", "we want", "i need", "we need", "another", "as well"]);
/// What may be open, and is the same thing then.
#[rustfmt::skip]
const OPENED: &[&str] = &["laptop", "book", "notebook", "umbrella", "parasol", "box", "crate", "toolbox", "suitcase", "magazine", "newspaper"];
/// A cause takes no more words.
const LONGEST_CAUSE: usize = 7;
/// A reason takes no fewer.
const SHORTEST_REASON: usize = 3;

/// Leaves out how a place looks, and puts plainly what would be misunderstood.
pub(super) fn in_plain_words(lexemes: &mut Vec<Lexeme>) {
    without_looks(lexemes);
    gone_by_pronoun(lexemes);
    *lexemes = told_by(lexemes, &[EARLY]);
}

/// "The windmill looks shabby, paint it white": the order with what was told of first in the place of "it".
pub(super) fn with_what_is_named(lexemes: &[Lexeme]) -> Vec<Lexeme> {
    told_by(lexemes, &[NAMED_FIRST])
}

/// A sentence without such remarks, if there are any.
pub(super) fn without(lexemes: &[Lexeme], names: &Names<'_>) -> Option<Vec<Lexeme>> {
    let mut kept = lexemes.to_vec();
    without_last(&mut kept, is_remark);
    if let Some(mark) = kept.iter().position(|lexeme| lexeme.token == Token::Comma)
        && is_cause(&kept[..mark], names)
        && is_order(&kept[mark + 1..])
    {
        kept.drain(..=mark);
    }
    without_open(&mut kept);
    let is_left = kept.iter().any(|lexeme| !is_mark(lexeme));
    (is_left && kept.len() < lexemes.len()).then_some(kept)
}

/// "This scooter here, he must disappear": the order to remove it. A clause that says more than what is meant is left as it is.
fn gone_by_pronoun(lexemes: &mut Vec<Lexeme>) {
    let begins = |at: &usize| *at == 0 || lexemes[at - 1].token == Token::Break;
    let found = (0..lexemes.len()).filter(begins).find_map(|from| {
        let noun = plain_noun(&lexemes[from..])?;
        let here = from + noun + longest_phrase(&lexemes[from + noun..], &["here", "there"]).unwrap_or(0);
        lexemes.get(here).filter(|mark| mark.token == Token::Comma)?;
        let who = here + 1 + longest_phrase(&lexemes[here + 1..], &["it", "he", "she", "they"])?;
        let must = who + longest_phrase(&lexemes[who..], MUST)?;
        let goes = must + longest_phrase(&lexemes[must..], VANISHES)?;
        lexemes.get(goes).is_none_or(is_mark).then_some((from, from + noun, goes))
    });
    if let Some((from, noun, end)) = found {
        lexemes.drain(noun..end);
        let remove = word_at(&lexemes[from], "remove");
        lexemes.insert(from, remove);
    }
}

/// How many words name a certain thing by its class, with its colour at most.
pub(super) fn plain_noun(lexemes: &[Lexeme]) -> Option<usize> {
    let mut at = longest_phrase(lexemes, &["the", "this", "that", "my", "our", "these", "those"])?;
    at += longest_phrase(&lexemes[at..], LOOKS).unwrap_or(0);
    at += longest(&lexemes[at..], PAINTS).map_or(0, |(_, words)| words);
    category(&lexemes[at..]).map(|(_, words)| at + words)
}

/// "..., it looks so bare down there", behind something else.
fn without_looks(lexemes: &mut Vec<Lexeme>) {
    let mut from = 1;
    while let Some(mark) = lexemes.iter().skip(from).position(is_mark).map(|mark| from + mark) {
        let next = lexemes[mark + 1..].iter().position(is_mark).map(|next| mark + 1 + next);
        let end = next.unwrap_or(lexemes.len());
        if tells_looks(&lexemes[mark + 1..end]) {
            lexemes.drain(mark..end);
            from = mark;
        } else {
            from = mark + 1;
        }
    }
}

/// Whether a clause only tells how bare it looks somewhere.
fn tells_looks(clause: &[Lexeme]) -> bool {
    let mut at = longest_phrase(clause, REASONS_FIRST).unwrap_or(0);
    let Some(seems) = longest_phrase(&clause[at..], PLACE_SEEMS) else { return false };
    at += seems;
    at += longest_phrase(&clause[at..], SO).unwrap_or(0);
    let is_bare = |lexeme: &Lexeme| BARE.contains(&word_of(lexeme));
    let looks = clause[at..].iter().take_while(|lexeme| is_bare(lexeme) || word_of(lexeme) == "and").count();
    let place = at + looks;
    let Some((last, over)) = clause[place..].split_last() else { return false };
    clause[at..place].iter().any(is_bare)
        && matches!(word_of(last), "here" | "there")
        && over.iter().all(|lexeme| OVER.contains(&word_of(lexeme)))
}

/// Whether a clause behind a mark asks for nothing.
fn is_remark(clause: &[Lexeme]) -> bool {
    longest_phrase(clause, AS_IF).is_some_and(|words| is_idle(&clause[words..]))
        || is_reason(clause)
        || is_effect(clause)
        || suits(clause)
}

/// "Since half of my class cycles in".
fn is_reason(clause: &[Lexeme]) -> bool {
    longest_phrase(clause, REASONS).is_some_and(|words| {
        let rest = &clause[words..];
        let is_likened = word(clause, words - 1) == "as" && NO_REASONS.contains(&word(rest, 0));
        rest.len() >= SHORTEST_REASON && !is_likened && is_idle(rest)
    })
}

/// "That should catch the light", and not "that should be red".
fn is_effect(clause: &[Lexeme]) -> bool {
    longest_phrase(clause, WILL).is_some_and(|words| {
        let rest = &clause[words..];
        !word(rest, 0).is_empty() && !TO_BE.contains(&word(rest, 0)) && is_idle(rest) && !is_painted(rest)
    })
}

/// "It suits the quay better".
fn suits(clause: &[Lexeme]) -> bool {
    let Some(its) = longest_phrase(clause, ITS) else { return false };
    let rest = &clause[its..];
    longest_phrase(rest, SUITS).is_some() && is_idle(rest) && !is_painted(rest)
}

fn is_painted(rest: &[Lexeme]) -> bool {
    (0..rest.len()).any(|at| longest(&rest[at..], PAINTS).is_some())
}

/// Whether nothing is asked for, and something is said.
fn is_idle(rest: &[Lexeme]) -> bool {
    let orders = |at: usize| {
        at > 0
            && matches!(word(rest, at - 1), "and" | "then" | "so")
            && longest(&rest[at..], &VERBS).is_some()
    };
    !rest.is_empty() && !(0..rest.len()).any(|at| longest_phrase(&rest[at..], ASKS).is_some() || orders(at))
}

/// "After that burglary": what happened, and no place.
fn is_cause(clause: &[Lexeme], names: &Names<'_>) -> bool {
    let Some(lead) = longest_phrase(clause, CAUSES) else { return false };
    let noun = &clause[lead..];
    let Some(last) = noun.last().map(word_of) else { return false };
    let is_timed = !["before", "ahead"].contains(&word(clause, 0)) || EVENTS.contains(&last);
    let is_thing = |at: usize| {
        let rest = &noun[at..];
        category(rest).is_some_and(|(_, words)| words == rest.len())
            || names.asset_words(rest).is_some_and(|words| words == rest.len())
            || names.exact(rest).is_some()
            || numbers::count(rest).is_some()
    };
    is_timed
        && clause.len() <= LONGEST_CAUSE
        && longest_phrase(noun, WHOSE).is_some_and(|words| words < noun.len())
        && !(0..noun.len()).any(is_thing)
}

/// Whether an order begins.
fn is_order(rest: &[Lexeme]) -> bool {
    let polite = longest_phrase(rest, &["please", "kindly", "could you", "can you", "would you"]);
    longest(&rest[polite.unwrap_or(0)..], &VERBS).is_some()
}

/// "An open laptop" is a laptop.
fn without_open(lexemes: &mut Vec<Lexeme>) {
    let found = (1..lexemes.len().saturating_sub(1)).find(|at| {
        matches!(word(lexemes, at - 1), "a" | "an")
            && matches!(word(lexemes, *at), "open" | "opened" | "closed")
            && OPENED.contains(&word(lexemes, at + 1))
    });
    if let Some(at) = found {
        let article = word_at(&lexemes[at - 1], "a");
        lexemes.splice(at - 1..=at, [article]);
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::{lex, rewritten};
    use super::{in_plain_words, is_remark};

    #[test]
    fn what_would_be_misunderstood_is_put_plainly() {
        for (said, meant) in [
            ("plant a pine by the oak, it looks so bare down there", "plant a pine by the oak"),
            ("this scooter here, he must disappear, thank you", "remove this scooter , thank you"),
            ("the bench, it has to go", "remove the bench"),
            ("would love the postbox way bigger, like times three", "make the postbox three times as big"),
            (
                "put a bench there, it looks so red down there",
                "put a bench there , it looks so red down there",
            ),
            ("that bench is ugly, it has to go", "that bench is ugly , it has to go"),
            ("the statue, it must go to the oak", "the statue , it must go to the oak"),
        ] {
            assert_eq!(rewritten(said, in_plain_words), meant, "{said}");
        }
    }

    #[test]
    fn reasons_effects_and_likenesses_ask_for_nothing() {
        for said in [
            "it suits the quay better",
            "that should catch the light",
            "since half of my class cycles in",
            "as if somebody had just gone to fetch lunch",
        ] {
            assert!(is_remark(&lex(said)), "{said}");
        }
        for said in [
            "that should be red",
            "it suits the red bench",
            "since it should be red",
            "as big as the oak",
            "because I left and paint it red",
        ] {
            assert!(!is_remark(&lex(said)), "{said}");
        }
    }
}
