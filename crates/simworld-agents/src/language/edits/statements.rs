//! Statements that stand beside a request, whatever they tell: "several women told us they avoid it after dark", "eighty pensioners from Bavaria, and
//! all of them want Rembrandt!".
//!
//! The other modules know remarks by what is said in them. Here a clause is known by its shape alone: somebody or something, behind it a finite verb, and
//! nothing that asks, forbids, limits or corrects. It is tried where a sentence is refused in every other way, and counts only if the rest is granted; so no
//! order is lost that was understood. What cannot wait for that, [`super::beforehand`] leaves out.

use super::super::lexer::{Lexeme, Token, is_mark, word_of};
use super::super::lexicon::{category, longest, longest_phrase};
use super::super::names::Names;
use super::super::paint::PAINTS;
use super::super::phrases::Phrases;
use super::finite::{is_auxiliary, is_base, is_told_of_one};
use super::forms::{word, word_at};
use super::remarked::plain_noun;
use super::told::ORDERS_ANYTHING;
use super::words::{VERBS, WAYS, Way};

/// Before a statement, and says nothing of it.
#[rustfmt::skip]
const LEADS: &Phrases = &Phrases::of(&["because", "since", "as", "for", "cause", "cos", "coz", "so that", "so", "where", "when", "which", "while", "whereas", "although", "though", "even though", "seeing that", "seeing as", "given that",
    "now that", "not that", "or so", "considering", "considering that", "whenever", "wherever", "after all", "otherwise", "and", "but", "which is where", "which is when", "which is why", "which is what", "the way", "just as", "knowing that", "hoping that", "in case", "or", "who", "whose", "whom"]);
/// Of these, those behind which an order, a condition or a correction may follow as well.
const RISKY: &[&str] = &["and", "but", "or", "so", "when", "whenever", "wherever", "otherwise"];
/// What asks, forbids, limits or corrects, wherever it stands.
#[rustfmt::skip]
const ASKS: &Phrases = &Phrases::of(&["please", "should", "shall", "ought", "instead", "except", "unless", "until", "rather than", "only the", "just the", "let", "lets", "to be put", "to be moved", "to go", "not the", "no the", "make that", "make it", "can you", "could you", "would you", "will you", "can we", "could we",
    "i want a", "i want the", "i want it", "i want them", "we want a", "we want the", "i need a", "we need a", "i need the", "we need the", "id like a", "id like the", "id like it", "wed like a", "i would like a", "i would like the", "as well", "the same", "one more", "two more", "instead of", "is to", "are to", "has to", "have to", "needs to", "need to",
    "is missing", "are missing", "is needed", "are needed", "is wanted", "are wanted", "would be nice", "would look", "would suit", "id rather", "i would rather", "i mean", "i meant", "sorry", "scratch", "undo", "never mind", "forget",
    "belongs", "belong", "goes there", "go there", "goes next", "goes near", "goes by", "goes behind", "twice", "double", "half as", "bigger", "smaller", "larger", "called", "named", "facing", "too please", "also", "there must be", "there has to be", "we could use", "could use", "could do with", "would love a", "would like a", "lacks", "lack", "deserves", "deserve", "wants a", "want a", "needs a", "needs an", "need an", "want an", "wants an",
    "must be", "must stand", "must have", "must get", "must disappear", "must leave", "must come", "must move", "must vanish", "can go", "may go", "can stay", "can leave", "each", "every other", "every second", "either", "neither", "none of", "actually"]);
/// What is to be done to something, behind a form of "to be".
#[rustfmt::skip]
const DONE: &[&str] = &["removed", "deleted", "painted", "moved", "replaced", "turned", "rotated", "swapped", "copied", "renamed", "repainted", "installed", "added", "placed", "planted", "put", "gone"];
/// Before that.
const TO_BE: &[&str] = &[
    "be", "been", "being", "get", "gets", "want", "wants", "need", "needs", "have", "it", "them", "him",
    "her",
];
/// What somebody has to do himself, so that it asks nobody else.
#[rustfmt::skip]
const OWN: &Phrases = &Phrases::of(&["i must", "we must", "i have to", "we have to", "i need to", "we need to", "i should", "we should", "i ought to", "i had to", "we had to", "id better", "he must", "she must", "they must", "nobody should", "no one should", "people should", "everybody should", "everyone should", "one should", "nobody must", "nobody shall", "he has to", "she has to", "they have to"]);
/// What that is, of the verbs of orders.
const OWN_DEEDS: &[&str] = &[
    "go", "be", "get", "come", "leave", "run", "catch", "see", "show", "tell", "give", "find", "drive",
    "walk", "take",
];
/// Nobody.
const NOBODY: &Phrases = &Phrases::of(&[
    "not a soul",
    "not a single",
    "not one of",
    "no one",
    "nobody",
    "no visitor",
    "no tourist",
    "no child",
    "no wonder",
]);
/// Before an order, and says nothing of it.
const PRELUDES: &Phrases = &Phrases::of(&[
    "at least",
    "at any rate",
    "in any case",
    "at the very least",
    "for a start",
    "just",
    "so",
    "that is why",
    "which is why",
    "therefore",
    "hence",
]);
/// What begins a question about the scene, or what takes back.
#[rustfmt::skip]
const BEGINS: &Phrases = &Phrases::of(&["how many", "how much", "how far", "which", "what", "where is", "where are", "wheres", "who is", "whos", "is there", "are there", "no", "not the", "not a", "wait", "rather", "or rather", "or better", "better", "dont", "do not", "never", "if", "unless", "suppose", "say", "make", "let", "then"]);
/// Who does something, in the nominative.
#[rustfmt::skip]
const SUBJECTS: &[&str] = &["i", "he", "she", "we", "they", "one", "nobody", "somebody", "someone", "everybody", "everyone", "anyone", "who", "people", "folks", "it", "you", "that", "this", "which", "nothing", "something", "everything", "none", "others", "most", "some", "many", "half", "hardly", "all", "them", "us"];
/// A subject and its auxiliary in one word.
#[rustfmt::skip]
const SHORT: &[&str] = &["im", "ive", "hes", "shes", "weve", "theyre", "theyve", "youre", "youve", "theres", "thats", "its", "ill", "theyll", "shell", "hell", "itll", "youll", "whos", "theyd", "hed", "shed", "youd"];
/// Of these, those that are something else within a clause.
const POSSESSIVES: &[&str] = &["its", "hell", "shell", "ill", "shed"];
/// Between a subject and its verb.
#[rustfmt::skip]
const ADVERBS: &[&str] = &["never", "always", "often", "just", "really", "still", "already", "only", "ever", "even", "hardly", "sometimes", "usually", "soon", "once", "both", "all", "simply", "clearly", "actually", "probably", "rarely", "seldom", "nearly", "almost", "once", "now", "finally", "constantly", "certainly", "obviously", "apparently", "secretly", "quietly", "regularly"];
/// Before a noun, so that what follows is no verb.
#[rustfmt::skip]
const BEFORE_NOUNS: &[&str] = &["a", "an", "the", "my", "our", "your", "his", "her", "its", "their", "this", "these", "those", "to", "of", "in", "on", "at", "by", "for", "with", "from", "near", "behind", "beside", "and", "or", "some", "any", "no", "two", "three", "four", "five", "six", "more", "every", "each", "new", "old", "big", "small", "tall", "little", "between", "along", "around", "next", "as", "than", "like", "into", "onto", "under", "over", "very", "about"];
/// Clauses that are sayings, whole.
#[rustfmt::skip]
const SAYINGS: &Phrases = &Phrases::of(&["lets face it", "let us face it", "i gather", "picture this", "imagine this", "heres my idea", "here is my idea", "here goes", "go on", "no ifs or buts", "no ifs and buts", "no ifs no buts", "show that", "show it", "do that", "do it", "make it so", "do so", "show me that", "that is my design", "out of shot", "out of mind", "out of sight", "third time this year", "first time this year", "second time this year", "third time this week", "if i may add something", "if i may say so", "if i may", "if you ask me", "if you must know", "would you believe it", "can you believe it",
    "atchoo", "go figure", "as they say", "so to speak", "so im told", "so i am told", "so i hear", "or so i hear", "or so im told", "or so they say", "or so it seems", "believe it or not", "mind you", "fair enough", "such is life", "thats life", "cest la vie", "what can you do", "what can i say", "what else", "who knows", "god knows", "heaven knows", "no offence", "no hard feelings", "long story",
    "say no more", "enough said", "case in point", "simple as that", "as simple as that", "plain and simple", "end of story", "full stop", "period", "job done", "done and dusted", "for what its worth", "for the record", "between you and me", "between us", "truth be told", "to be honest", "to be fair", "to be frank", "in all honesty", "rules are rules", "business is business", "safety first", "better late than never",
    "first come first served", "every single april", "every single year", "every single day", "every time", "every year", "every day", "every week", "every night", "every morning", "every evening", "year after year", "day after day", "day and night", "come rain or shine", "rain or shine", "time and again", "once again", "yet again", "all gone", "all of them gone", "long gone", "what a mess", "what a pity", "what a shame", "what a day", "what a view", "poor thing", "poor man", "poor woman", "poor devil", "lucky you", "lucky me", "silly me", "my fault", "my mistake", "no wonder", "small wonder", "hence the request", "hence the question"]);
/// Pronouns that need something before them to stand for.
const PRONOUNS: &[&str] =
    &["it", "him", "her", "them", "its", "he", "she", "they", "one", "there", "that", "those", "ones"];
/// A statement takes no fewer words.
const SHORTEST: usize = 3;

/// A part between two marks: where its words begin and end.
#[derive(Clone, Copy)]
pub(super) struct Clause {
    pub(super) from: usize,
    pub(super) end: usize,
}

/// The sentence without its statements: without all of them, without those at its end, without those at its beginning, and without mere sayings, where that
/// differs.
pub(super) fn without(lexemes: &[Lexeme], names: &Names<'_>) -> Vec<Vec<Lexeme>> {
    let clauses = clauses(lexemes);
    let said: Vec<&[Lexeme]> = clauses.iter().map(|clause| &lexemes[clause.from..clause.end]).collect();
    let mut told: Vec<bool> = said.iter().map(|clause| tells(clause, names)).collect();
    // What belongs to no order belongs to what is told beside it in the same sentence.
    for at in (0..told.len().saturating_sub(1)).rev() {
        let is_one_sentence =
            lexemes.get(clauses[at].end).is_some_and(|mark| mark.token == Token::Comma) && told[at + 1];
        told[at] |= is_one_sentence && is_about_strangers(said[at], names);
    }
    let first_kept = told.iter().position(|told| !told);
    let last_kept = told.iter().rposition(|told| !told);
    let (Some(first_kept), Some(last_kept)) = (first_kept, last_kept) else { return Vec::new() };
    let left_out = |is_out: &dyn Fn(usize) -> bool| {
        let out: Vec<Clause> =
            (0..clauses.len()).filter(|at| told[*at] && is_out(*at)).map(|at| clauses[at]).collect();
        (!out.is_empty())
            .then(|| rest_of(lexemes, &out))
            .and_then(|rest| standing_alone(lexemes, rest, &out, names))
    };
    let mut ways: Vec<Vec<Lexeme>> = Vec::new();
    let tried: [&dyn Fn(usize) -> bool; 4] =
        [&|_| true, &|at| at > last_kept, &|at| at < first_kept, &|at| is_saying(said[at])];
    for way in tried.into_iter().filter_map(left_out) {
        if !ways.iter().any(|other| other.len() == way.len()) {
            ways.push(way);
        }
    }
    ways
}

/// The rest with what its first pronoun stands for in its place, if that was left out with what was told before and is the only certain thing there.
fn standing_alone(
    lexemes: &[Lexeme],
    mut rest: Vec<Lexeme>,
    out: &[Clause],
    names: &Names<'_>,
) -> Option<Vec<Lexeme>> {
    if let Some(words) = longest_phrase(&rest, PRELUDES).filter(|words| *words < rest.len()) {
        rest.drain(..words);
    }
    if stands_alone(lexemes, &rest, out) {
        return Some(rest);
    }
    let start = rest.first()?.start;
    rest.iter().find(|lexeme| is_pronoun(lexeme))?;
    let mut nouns = out.iter().filter(|clause| lexemes[clause.from].start < start).filter_map(|clause| {
        let from = clause.from;
        let said = &lexemes[from..clause.end];
        let named = || names.exact(said).map(|(_, words)| words);
        plain_noun(said).or_else(named).map(|words| lexemes[from..from + words].to_vec())
    });
    let noun = nouns.next().filter(|_| nouns.next().is_none())?;
    Some(with_noun(&rest, &noun))
}

/// Whether a word stands for what something is done to.
pub(super) fn is_pronoun(lexeme: &Lexeme) -> bool {
    ["it", "him", "her", "them"].contains(&word_of(lexeme))
}

/// The words with a noun in the place of their pronouns.
pub(super) fn with_noun(rest: &[Lexeme], noun: &[Lexeme]) -> Vec<Lexeme> {
    let said = |lexeme: &Lexeme| if is_pronoun(lexeme) { noun.to_vec() } else { vec![lexeme.clone()] };
    rest.iter().flat_map(said).collect()
}

/// "Somebody forgot a backpack; it should lie next to the chair": the order to put one there.
pub(super) fn with_what_was_left(lexemes: &[Lexeme]) -> Option<Vec<Lexeme>> {
    #[rustfmt::skip]
    const LEFT: &Phrases = &Phrases::of(&["somebody forgot", "someone forgot", "somebody left", "someone left", "somebody lost", "someone lost", "somebody dropped", "someone dropped", "somebody brought", "someone brought", "i brought", "we brought", "i bought", "we bought", "i have", "we have", "we got", "i got", "ive got", "weve got", "somebody donated", "someone donated", "somebody gave us", "someone gave us"]);
    #[rustfmt::skip]
    const PUT_IT: &Phrases = &Phrases::of(&["drop it", "put it", "lay it", "place it", "set it", "leave it", "stand it", "it should lie", "it should be", "it should stand", "it should go", "it must lie", "it must be", "it must stand", "it must go", "it belongs", "it lies", "it goes", "it is to lie", "it is to stand", "it has to lie", "it has to stand", "let it lie", "let it stand", "it should sit", "it may lie", "it can go", "it can stand"]);
    let left = longest_phrase(lexemes, LEFT)?;
    longest_phrase(&lexemes[left..], &["a", "an", "two", "three", "some"])?;
    let mark = lexemes.iter().position(is_mark)?;
    let behind = lexemes.get(mark + 1..)?;
    let put = longest_phrase(behind, PUT_IT).filter(|put| *put < behind.len())?;
    let order = word_at(&lexemes[0], "put");
    Some(
        std::iter::once(order)
            .chain(lexemes[left..mark].iter().cloned())
            .chain(behind[put..].iter().cloned())
            .collect(),
    )
}

/// The parts between marks and brackets.
pub(super) fn clauses(lexemes: &[Lexeme]) -> Vec<Clause> {
    let mut clauses = Vec::new();
    let mut from = 0;
    let ends = |lexeme: &Lexeme| is_mark(lexeme) || matches!(lexeme.token, Token::Open | Token::Close);
    let is_number = |at: usize| matches!(lexemes.get(at).map(|lexeme| &lexeme.token), Some(Token::Number(_)));
    // A comma between numbers is one of coordinates.
    let is_inner = |at: usize| at > 0 && is_number(at - 1) && is_number(at + 1);
    for at in 0..=lexemes.len() {
        let is_end = lexemes.get(at).is_none_or(ends) && !is_inner(at);
        if is_end {
            if from < at {
                clauses.push(Clause { from, end: at });
            }
            from = at + 1;
        }
    }
    clauses
}

/// Whether a part begins with a place: "a rack, please, beside the frobnicator that sells newspapers".
pub(super) fn tells_place(lexemes: &[Lexeme]) -> bool {
    let begins_with_place = |clause: &Clause| {
        longest(&lexemes[clause.from..clause.end], &WAYS).is_some_and(|(way, _)| matches!(way, Way::To(_)))
    };
    clauses(lexemes).iter().any(begins_with_place)
}

/// The rest of a sentence. Of the marks around what is left out one stays, and none where the sentence goes on with a place.
pub(super) fn rest_of(lexemes: &[Lexeme], out: &[Clause]) -> Vec<Lexeme> {
    let mut kept = vec![true; lexemes.len()];
    for clause in out {
        kept[clause.from..clause.end].fill(false);
        let before = clause.from.checked_sub(1);
        if let Some(before) = before {
            kept[before] = false;
        }
        let behind = lexemes.get(clause.end + 1..).unwrap_or_default();
        let goes_on =
            longest(behind, &WAYS).is_some() && before.is_some_and(|at| lexemes[at].token != Token::Break);
        let is_bracket = lexemes.get(clause.end).is_some_and(|lexeme| lexeme.token == Token::Close);
        if clause.end < lexemes.len() && (goes_on || is_bracket || before.is_none()) {
            kept[clause.end] = false;
        }
    }
    lexemes.iter().zip(kept).filter(|(_, kept)| *kept).map(|(lexeme, _)| lexeme.clone()).collect()
}

/// Whether the rest says something, and no pronoun in it stands for what was left out before it.
pub(super) fn stands_alone(lexemes: &[Lexeme], rest: &[Lexeme], out: &[Clause]) -> bool {
    let Some(start) = rest.first().map(|lexeme| lexeme.start) else { return false };
    let is_headless = out.iter().any(|clause| lexemes[clause.from].start < start);
    let pronoun = rest.iter().position(|lexeme| PRONOUNS.contains(&word_of(lexeme)));
    let is_named = |end: usize| (0..end).any(|at| category(&rest[at..end]).is_some());
    rest.iter().any(|lexeme| !is_mark(lexeme)) && !(is_headless && pronoun.is_some_and(|at| !is_named(at)))
}

/// Whether a clause tells something and asks for nothing.
pub(super) fn tells(clause: &[Lexeme], names: &Names<'_>) -> bool {
    if is_saying(clause) {
        return true;
    }
    if is_purpose(clause, names) {
        return true;
    }
    let lead = longest_phrase(clause, LEADS);
    let rest = &clause[lead.unwrap_or(0)..];
    let first = word(clause, 0);
    let is_risky = lead == Some(1) && RISKY.contains(&first);
    let may_be_order = (lead.is_none() || is_risky) && begins_order(rest) && !has_subject(rest);
    let is_question = lead.is_none()
        && longest_phrase(clause, BEGINS).is_some()
        && longest_phrase(clause, NOBODY).is_none();
    let is_condition = (lead.is_none() || is_risky) && rest.iter().any(|lexeme| word_of(lexeme) == "if");
    // "Or the one by the oak", "and the lamp is too dark".
    let may_go_on = is_risky
        && longest_phrase(rest, &["the", "a", "an", "one", "it", "not", "no"]).is_some()
        && names_thing(rest, names);
    let is_relative = ["which", "who", "that"].contains(&first) && is_told_of_one(word(rest, 0));
    rest.len() >= SHORTEST - usize::from(lead.is_some())
        && !(is_question || may_be_order || is_condition || may_go_on)
        && asks_nothing(rest, names)
        && (is_relative || has_finite(rest))
}

/// "To liven up the quay a little": what for, by a verb that orders nothing.
fn is_purpose(clause: &[Lexeme], names: &Names<'_>) -> bool {
    #[rustfmt::skip]
    const DEEDS: &[&str] = &["liven", "brighten", "cheer", "improve", "calm", "slow", "celebrate", "mark", "honour", "spruce", "freshen", "entertain", "scare", "deter", "invite", "greet", "serve", "feed", "shade", "shield", "beautify", "break", "soften", "hide", "discourage", "help", "guide"];
    let Some(to) = longest_phrase(clause, &["to", "in order to", "so as to", "just to"]) else {
        return false;
    };
    let deed = &clause[to..];
    let is_deed = DEEDS.contains(&word(deed, 0)) || is_base(word(deed, 0)) && longest(deed, &VERBS).is_none();
    is_deed && asks_nothing(deed, names)
}

fn is_saying(clause: &[Lexeme]) -> bool {
    longest_phrase(clause, SAYINGS) == Some(clause.len())
}

/// Whether a clause names nothing that is known, and has no verb: "the cobbler", "eighty pensioners from Bavaria".
fn is_about_strangers(clause: &[Lexeme], names: &Names<'_>) -> bool {
    let is_known = |at: usize| {
        let rest = &clause[at..];
        category(rest).is_some()
            || names.exact(rest).is_some()
            || names.asset_words(rest).is_some()
            || longest(rest, &VERBS).is_some()
            || longest(rest, PAINTS).is_some()
            || longest(rest, &WAYS).is_some_and(|(_, words)| words > 1)
    };
    let is_question = longest_phrase(clause, BEGINS).is_some();
    !is_question && !(0..clause.len()).any(|at| is_known(at) || longest_phrase(&clause[at..], ASKS).is_some())
}

/// Whether an order may begin here, of this grammar or not: "do what a good host would do".
fn begins_order(clause: &[Lexeme]) -> bool {
    let next = word(clause, 1);
    let is_imperative = is_base(word(clause, 0)) && !is_auxiliary(next) && !is_told_of_one(next);
    is_imperative || longest(clause, &VERBS).is_some() || longest_phrase(clause, ORDERS_ANYTHING).is_some()
}

/// Whether the first words are a subject, so that no order begins here.
fn has_subject(clause: &[Lexeme]) -> bool {
    SUBJECTS.contains(&word(clause, 0)) || SHORT.contains(&word(clause, 0))
}

/// Whether something of the scene, or something that could be made, is spoken of.
fn names_thing(clause: &[Lexeme], names: &Names<'_>) -> bool {
    (0..clause.len()).any(|at| category(&clause[at..]).is_some() || names.exact(&clause[at..]).is_some())
}

/// Whether nothing in a clause asks, orders, forbids or corrects, or says of what colour something is to be.
pub(super) fn asks_nothing(clause: &[Lexeme], names: &Names<'_>) -> bool {
    let begins_with_it = ["it", "they", "this", "that"].contains(&word(clause, 0));
    // "The mechanic must reach it" is so, and "the bench must reach the wall" is asked for.
    let must = clause.iter().position(|lexeme| word_of(lexeme) == "must");
    if must.is_some_and(|must| names_thing(&clause[..must], names)) {
        return false;
    }
    let is_coloured = begins_with_it && (0..clause.len()).any(|at| longest(&clause[at..], PAINTS).is_some());
    let is_placed = begins_with_it
        && names_thing(clause, names)
        && (1..clause.len()).any(|at| longest(&clause[at..], &WAYS).is_some_and(|(_, words)| words > 1));
    !is_coloured && !is_placed && !asks(clause)
}

/// Whether a word of asking stands in a clause, or an order behind "and".
pub(super) fn asks(clause: &[Lexeme]) -> bool {
    let own = longest_phrase(clause, OWN).filter(|words| {
        let deed = &clause[*words..];
        longest(deed, &VERBS).is_none() || OWN_DEEDS.contains(&word(deed, 0))
    });
    let clause = &clause[own.map_or(0, |words| clause.len().min(words + 1))..];
    let orders = |at: usize| {
        at > 0
            && ["and", "then", "so"].contains(&word(clause, at - 1))
            && !is_auxiliary(word(clause, at))
            && longest(&clause[at..], &VERBS).is_some()
    };
    let is_done =
        |at: usize| at > 0 && DONE.contains(&word(clause, at)) && TO_BE.contains(&word(clause, at - 1));
    let is_more = |at: usize| word(clause, at) == "another" && category(&clause[at + 1..]).is_some();
    (0..clause.len())
        .any(|at| longest_phrase(&clause[at..], ASKS).is_some() || orders(at) || is_done(at) || is_more(at))
}

/// Whether a finite verb stands behind somebody or something.
fn has_finite(clause: &[Lexeme]) -> bool {
    let is_short = |at: usize| {
        SHORT.contains(&word(clause, at)) && (at == 0 || !POSSESSIVES.contains(&word(clause, at)))
    };
    (0..clause.len()).any(is_short)
        || (1..clause.len()).any(|at| {
            let said = word(clause, at);
            let before = word(clause, at - 1);
            let subject = if ADVERBS.contains(&before) && at > 1 { word(clause, at - 2) } else { before };
            let is_noun = category(&clause[at..]).is_some() && !SUBJECTS.contains(&subject);
            if said.is_empty() || BEFORE_NOUNS.contains(&before) || is_noun {
                return false;
            }
            let of_several = subject.ends_with('s') || SUBJECTS.contains(&subject);
            is_auxiliary(said) || said == "must" || is_told_of_one(said) || of_several && is_base(said)
        })
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::lex;
    use super::{asks, has_finite};

    #[test]
    fn a_statement_has_a_finite_verb() {
        for said in [
            "several women told us they avoid it after dark",
            "the valet mixed up ticket 14 and ticket 41",
            "at present one stares into nettles",
            "everyone misses the 5 o'clock bus",
            "where no visitor ever strays",
            "the owner is a butcher",
        ] {
            assert!(has_finite(&lex(said)), "{said}");
        }
        for said in [
            "a lamp by the kiosk",
            "two benches near the red cars",
            "the red one",
            "the lamps along the river",
        ] {
            assert!(!has_finite(&lex(said)), "{said}");
        }
    }

    #[test]
    fn what_asks_is_known() {
        for said in [
            "the lamp should go too",
            "it belongs by the oak",
            "the others are to be red",
            "and then remove the oak",
        ] {
            assert!(asks(&lex(said)), "{said}");
        }
    }
}
