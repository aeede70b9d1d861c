//! Remarks beside a request that read like wishes, or like something of the scene: "..., the others belong to visitors", "..., somebody ordered an
//! espresso", "..., I want to leave", "..., it must be quiet there", "..., the mayor insists", "..., for his safty".
//!
//! They are left out last of all, where a sentence is refused in every other way, at its end or at its beginning; and only beside something else.

use super::super::lexer::{Lexeme, is_mark, word_of};
use super::super::lexicon::{longest, longest_phrase};
use super::super::paint::PAINTS;
use super::super::phrases::Phrases;
use super::forms::word;
use super::retold::last_mark;
use super::words::{FACTORS, VERBS};

/// Before a remark.
#[rustfmt::skip]
const LEADS: &Phrases = &Phrases::of(&["because", "since", "as", "cause", "cos", "and", "but", "well", "you know", "you see", "after all", "sorry"]);
/// What is left of several things.
#[rustfmt::skip]
const REST: &Phrases = &Phrases::of(&["the others", "the rest", "the rest of them", "the other ones", "the remaining ones", "all the others", "all others", "these", "those", "they", "they all", "the others all", "that one", "it", "this one"]);
/// What it does that changes nothing.
#[rustfmt::skip]
const DOES: &Phrases = &Phrases::of(&["belong to", "belongs to", "belong", "belonged to", "cost", "costs", "come from", "comes from", "came from", "came with", "came here", "work for", "works for", "serve", "serves", "pay", "paid", "live", "lives", "are rented", "is rented", "are hired", "are borrowed", "is borrowed", "is ours", "are ours", "are theirs", "is theirs", "is mine", "are mine", "are not ours", "are not mine", "isnt mine", "isnt ours", "arent ours", "arent mine",
    "are from", "is from", "are for sale", "matter", "matters", "are in use", "is in use", "are in nobodys way", "bother nobody", "bothers nobody", "do no harm", "does no harm", "harm nobody", "disturb nobody", "are visitors", "are guests", "are customers", "were here first", "was here first", "were expensive", "was expensive", "have owners", "has an owner", "have a permit", "have permits"]);
/// Somebody in particular whom nobody here knows.
#[rustfmt::skip]
const SOMEBODY: &Phrases = &Phrases::of(&["somebody", "someone", "somebody there", "someone there", "somebody here", "someone here", "a guest", "one guest", "some guest", "one of the guests", "the guest", "the guests", "a customer", "the customer", "one of the customers", "a visitor", "one of the visitors", "a lady", "a gentleman", "an old man", "an old lady", "a tourist", "a neighbour", "a neighbor", "my neighbour", "my neighbor", "my friend", "a friend", "a friend of mine", "a client", "a colleague", "my colleague"]);
/// What he did.
#[rustfmt::skip]
const DID: &[&str] = &["ordered", "asked", "wanted", "forgot", "complained", "requested", "needed", "booked", "paid", "called", "phoned", "rang", "wished", "lost", "spilled", "spilt", "dropped", "tripped", "fell", "stumbled", "bought", "sold", "told", "said", "promised", "came", "arrived", "left", "insisted", "slipped", "cried", "fainted", "waited", "wrote", "noticed", "reported", "brought"];
/// Who speaks, and what he is about to do by himself.
#[rustfmt::skip]
const I_WILL: &Phrases = &Phrases::of(&["i want to", "we want to", "i need to", "we need to", "i have to", "we have to", "i must", "we must", "i would like to", "we would like to", "id like to", "wed like to", "i should", "we should", "i am about to", "im about to", "we are about to", "i am going to", "im going to", "i wish to", "i had better", "i will", "ill", "we will", "i am ready to", "im ready to", "its time to", "it is time to", "i wanna", "we wanna", "i gotta", "i have got to", "ive got to"]);
#[rustfmt::skip]
const OWN_DEEDS: &Phrases = &Phrases::of(&["leave", "go", "go home", "go away", "be going", "be off", "get going", "get home", "drive home", "drive off", "drive away", "drive", "head home", "head off", "depart", "set off", "sleep", "eat", "rest", "relax", "sit down", "lie down", "work", "think", "read", "hurry", "run", "catch my train", "catch a train", "catch the train", "go to bed", "go to work", "get to work", "travel", "have lunch", "have dinner"]);
/// When and where to; behind a deed of one's own.
#[rustfmt::skip]
const SOON: &[&str] = &["now", "soon", "today", "tonight", "home", "at", "once", "right", "away", "early", "already", "please", "then", "a", "bit", "in", "minute", "for", "while", "little", "shortly", "work"];
/// How a place is to seem.
#[rustfmt::skip]
const IT_MUST_BE: &Phrases = &Phrases::of(&["it must be", "it has to be", "it should be", "it needs to be", "it ought to be", "it shall be", "it must stay", "it must remain", "it should stay", "it should remain", "it has to stay", "that must be", "things must be", "everything must be", "all must be"]);
#[rustfmt::skip]
const SEEMING: &[&str] = &["quiet", "calm", "peaceful", "silent", "safe", "clean", "tidy", "cosy", "cozy", "comfortable", "solemn", "dignified", "pleasant", "nice", "pretty", "beautiful", "lively", "friendly", "perfect", "secure", "welcoming", "inviting", "quieter", "calmer", "safer"];
/// What may stand beside that.
#[rustfmt::skip]
const VERY: &[&str] = &["very", "really", "quite", "so", "as", "and", "there", "here", "then", "always"];
/// Before who insists.
const WHOSE: &Phrases = &Phrases::of(&["the", "our", "my", "his", "her", "their", "your"]);
#[rustfmt::skip]
const INSISTS: &Phrases = &Phrases::of(&["insists", "insisted", "insist", "insists on it", "insisted on it", "says so", "said so", "demands it", "demanded it", "wishes it", "wishes so", "wants it so", "wants it that way", "told me so", "thinks so", "asked for it", "asked me to", "begged me to", "told me to", "is adamant", "was adamant", "is very firm", "made me promise", "decided so", "ordered it so", "agrees", "agreed", "has agreed", "approves", "approved"]);
/// What something is for that changes nothing.
#[rustfmt::skip]
const SAKES: &[&str] = &["safety", "protection", "comfort", "sake", "benefit", "convenience", "health", "pleasure", "wellbeing", "amusement", "security", "privacy", "peace", "entertainment"];
const THEIRS: &[&str] =
    &["his", "her", "its", "their", "our", "my", "your", "everyones", "everybodys", "the"];
/// How soon it is to be done.
#[rustfmt::skip]
const QUICKLY: &[&str] = &["quickly", "immediately", "urgently", "instantly", "promptly", "swiftly", "carefully", "pronto"];
/// From this length on two slips are forgiven.
const LONG: usize = 8;
/// So many remarks are left out at each end.
const MOST: usize = 2;

/// Leaves out the last clauses that are such remarks.
pub(super) fn without_last(lexemes: &mut Vec<Lexeme>, is_remark: impl Fn(&[Lexeme]) -> bool) {
    for _ in 0..MOST {
        let end = last_mark(lexemes);
        if let Some(mark) = lexemes[..end].iter().rposition(is_mark)
            && is_remark(&lexemes[mark + 1..end])
        {
            lexemes.drain(mark..end);
        }
    }
}

/// A sentence without such remarks at its end and its beginning, if there are any.
pub(super) fn without(lexemes: &[Lexeme]) -> Option<Vec<Lexeme>> {
    let mut kept = lexemes.to_vec();
    without_last(&mut kept, is_remark);
    for _ in 0..MOST {
        let end = last_mark(&kept);
        if let Some(mark) = kept[..end].iter().position(is_mark)
            && is_remark(&kept[..mark])
        {
            kept.drain(..=mark);
        }
    }
    let is_left = kept.iter().any(|lexeme| !is_mark(lexeme));
    (is_left && kept.len() < lexemes.len()).then_some(kept)
}

/// Whether a clause is a remark that is known here.
fn is_remark(clause: &[Lexeme]) -> bool {
    let mut start = 0;
    while let Some(words) = longest_phrase(&clause[start..], LEADS) {
        start += words;
    }
    let clause = &clause[start..];
    is_of_the_rest(clause)
        || is_of_somebody(clause)
        || is_own_deed(clause)
        || is_of_the_place(clause)
        || is_insisted(clause)
        || is_for_whose_sake(clause)
        || matches!(clause, [only] if is_near(word_of(only), QUICKLY))
}

/// "The others belong to visitors".
fn is_of_the_rest(clause: &[Lexeme]) -> bool {
    let rest = longest_phrase(clause, REST).map_or(&[][..], |words| &clause[words..]);
    let does = (0..rest.len().min(2))
        .find_map(|at| longest_phrase(&rest[at..], DOES).filter(|_| at == 0 || is_small(word_of(&rest[0]))));
    does.is_some() && asks_for_nothing(rest)
}

fn is_small(word: &str) -> bool {
    ["all", "still", "just", "only", "mostly", "really", "already", "both", "do"].contains(&word)
}

/// "Somebody ordered an espresso".
fn is_of_somebody(clause: &[Lexeme]) -> bool {
    let Some(words) = longest_phrase(clause, SOMEBODY) else { return false };
    let has = ["has", "had", "just", "already"].contains(&word(clause, words));
    let verb = words + usize::from(has);
    let rest = clause.get(verb + 1..).unwrap_or_default();
    DID.contains(&word(clause, verb)) && asks_for_nothing(rest)
}

/// "I want to leave".
fn is_own_deed(clause: &[Lexeme]) -> bool {
    let Some(will) = longest_phrase(clause, I_WILL) else { return false };
    let Some(deed) = longest_phrase(&clause[will..], OWN_DEEDS) else { return false };
    clause[will + deed..].iter().all(|lexeme| SOON.contains(&word_of(lexeme)))
}

/// "It must be quiet there": how a place is to seem, and nothing more.
fn is_of_the_place(clause: &[Lexeme]) -> bool {
    longest_phrase(clause, IT_MUST_BE).is_some_and(|words| {
        let is_seeming = |lexeme: &Lexeme| SEEMING.contains(&word_of(lexeme));
        let seems = &clause[words..];
        seems.iter().any(is_seeming)
            && seems.iter().all(|lexeme| is_seeming(lexeme) || VERY.contains(&word_of(lexeme)))
    })
}

/// "The mayor insists", "my wife told me to".
fn is_insisted(clause: &[Lexeme]) -> bool {
    /// Who that is takes no more words.
    const LONGEST: usize = 2;
    let whose = longest_phrase(clause, WHOSE).unwrap_or(0);
    (whose + 1..=whose + LONGEST).any(|at| {
        clause
            .get(at..)
            .is_some_and(|rest| !rest.is_empty() && longest_phrase(rest, INSISTS) == Some(rest.len()))
    })
}

/// "For his safety", however it is written.
fn is_for_whose_sake(clause: &[Lexeme]) -> bool {
    match clause {
        [first, whose, sake] => {
            word_of(first) == "for" && THEIRS.contains(&word_of(whose)) && is_near(word_of(sake), SAKES)
        }
        [first, whose, own, sake] => {
            let is_own = word_of(own) == "own" && THEIRS.contains(&word_of(whose));
            word_of(first) == "for" && is_own && (is_near(word_of(sake), SAKES) || word_of(sake) == "good")
        }
        _ => false,
    }
}

/// Whether a word is one of some, or a slip of one.
fn is_near(said: &str, words: &[&str]) -> bool {
    let letters = said.chars().count();
    let allowed = if letters >= LONG { 2 } else { 1 };
    letters > 3 && words.iter().any(|word| strsim::osa_distance(said, word) <= allowed)
}

/// Whether nothing in the rest of a remark orders, wishes, limits or colours anything.
fn asks_for_nothing(rest: &[Lexeme]) -> bool {
    #[rustfmt::skip]
    const ASKS: &Phrases = &Phrases::of(&["please", "should", "must", "instead", "except", "only", "unless", "if", "not the", "but", "rather", "let", "lets", "to be", "to have", "to get", "to see", "to put", "to add", "to remove", "to move", "to paint", "gone", "removed", "moved", "painted", "too", "as well", "also", "more", "another"]);
    let asks = |at: usize| {
        longest_phrase(&rest[at..], ASKS).is_some()
            || longest(&rest[at..], PAINTS).is_some()
            || longest(&rest[at..], &FACTORS).is_some()
    };
    let orders = |at: usize| {
        ["and", "then", "so", "please"].contains(&word(rest, at))
            && rest.get(at + 1..).is_some_and(|rest| longest(rest, &VERBS).is_some())
    };
    !(0..rest.len()).any(|at| asks(at) || orders(at))
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::lex;
    use super::{is_remark, without};

    #[test]
    fn what_asks_for_nothing_is_a_remark() {
        for said in [
            "the others belong to visitors",
            "the rest are ours",
            "somebody ordered an espresso",
            "a guest just asked for it",
            "I want to leave",
            "because we have to go home soon",
            "it must be quiet there",
            "the mayor insists",
            "my wife told me to",
            "for his safty",
            "quikly",
        ] {
            assert!(is_remark(&lex(said)), "{said}");
        }
    }

    #[test]
    fn what_may_ask_for_something_is_none() {
        for said in [
            "the others should be green",
            "the rest can go",
            "the others white",
            "somebody should order a bench",
            "somebody ordered a red bench",
            "I want to see a bench",
            "we want to move the statue",
            "it must be red",
            "it must be twice as big",
            "the mayor insists on a bench",
            "for his dog",
            "quietly remove it",
        ] {
            assert!(!is_remark(&lex(said)), "{said}");
        }
    }

    #[test]
    fn what_is_said_alone_stays() {
        assert!(without(&lex("somebody ordered an espresso")).is_none());
        assert!(without(&lex("it must be quiet there.")).is_none());
    }
}
