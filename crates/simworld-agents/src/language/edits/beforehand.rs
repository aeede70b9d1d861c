//! Asides that are left out before a sentence is read, since what stands beside them would be misunderstood or lost with them: what stands between two
//! dashes, a list of things of which something is told, a question of nobody, what for, and an hour that is a reason.

use super::super::lexer::{Lexeme, Token, is_mark, word_of};
use super::super::lexicon::{category, longest, longest_phrase};
use super::super::names::Names;
use super::super::phrases::Phrases;
use super::finite::is_auxiliary;
use super::forms::word;
use super::remarked::plain_noun;
use super::statements::{Clause, asks, asks_nothing, is_pronoun, stands_alone, tells, with_noun};
use super::words::{ABOUT_IT, VERBS, WAYS};

/// What asks to be told something.
const ASKING: &Phrases = &Phrases::of(&[
    "how many",
    "tell me",
    "tell us",
    "just tell me",
    "show me",
    "list",
    "count",
    "which",
    "what",
]);

/// Leaves out such asides, one kind after the other.
pub(super) fn leave_out(words: &str, lexemes: &mut Vec<Lexeme>, names: &Names<'_>) {
    without_dashed(words, lexemes, names);
    without_told_lists(lexemes, names);
    without_rhetorical(words, lexemes);
    without_sake(lexemes);
    without_occasion(lexemes);
    asked_about(words, lexemes);
}

/// "That bus? Give it a lick of paint": the order with what was asked about in the place of its pronoun.
fn asked_about(words: &str, lexemes: &mut Vec<Lexeme>) {
    let Some(noun) = plain_noun(lexemes) else { return };
    let is_asked = lexemes
        .get(noun)
        .is_some_and(|mark| is_mark(mark) && words.get(mark.start..mark.end).is_some_and(|said| said == "?"));
    let has_pronoun = lexemes.iter().skip(noun).any(is_pronoun);
    if is_asked && has_pronoun {
        *lexemes = with_noun(&lexemes[noun + 1..], &lexemes[..noun]);
    }
}

/// "It's lunchtime, so ...": an hour that is told as a reason is none that is wished for.
fn without_occasion(lexemes: &mut Vec<Lexeme>) {
    #[rustfmt::skip]
    const OCCASIONS: &Phrases = &Phrases::of(&["its lunchtime", "it is lunchtime", "its lunch time", "its teatime", "its dinner time", "its dinnertime", "its bedtime", "its rush hour", "it is rush hour", "its closing time", "its almost noon", "its nearly noon", "its almost night", "its nearly night", "its getting late", "its getting dark", "it gets dark", "its market day", "it is market day", "its fish market day", "its harvest time", "its recess", "its break time", "its playtime"]);
    let Some(words) = longest_phrase(lexemes, OCCASIONS) else { return };
    let is_reason = lexemes.get(words).is_some_and(is_mark) && word(lexemes, words + 1) == "so";
    if is_reason && lexemes.len() > words + 2 {
        lexemes.drain(..words + 2);
    }
}

/// "For the sake of the photograph move the statue": what for, before an order.
fn without_sake(lexemes: &mut Vec<Lexeme>) {
    /// What it is for takes no more words.
    const LONGEST: usize = 6;
    #[rustfmt::skip]
    const SAKES: &Phrases = &Phrases::of(&["for the sake of the", "for the sake of my", "for the sake of our", "for the sake of a", "for the sake of", "for the benefit of the", "for the benefit of", "in the interest of", "in the interests of", "in honour of the", "in honor of the", "in the name of"]);
    let Some(sake) = longest_phrase(lexemes, SAKES) else { return };
    let may_begin = |at: &usize| longest(&lexemes[*at..], &VERBS).is_some();
    let order = (sake + 1..lexemes.len().min(sake + LONGEST)).find(may_begin);
    if let Some(order) = order.filter(|order| !lexemes[..*order].iter().any(is_mark)) {
        lexemes.drain(..order);
    }
}

/// "A single chair for a party of thirty, are they joking? Put ...": what is asked of nobody, before an order.
fn without_rhetorical(words: &str, lexemes: &mut Vec<Lexeme>) {
    #[rustfmt::skip]
    const ASKED_OF_NOBODY: &Phrases = &Phrases::of(&["are they", "are you", "is he", "is she", "is this a joke", "is that a joke", "are we", "am i", "who does that", "who did that", "who does he", "who do they", "what were they", "what was he", "what is this", "seriously", "really", "how come", "is that all", "is that it", "whats the point", "what is the point"]);
    let is_question = |lexeme: &Lexeme| {
        is_mark(lexeme) && words.get(lexeme.start..lexeme.end).is_some_and(|said| said == "?")
    };
    let Some(end) = lexemes.iter().position(is_question) else { return };
    let from = lexemes[..end].iter().rposition(is_mark).map_or(0, |mark| mark + 1);
    let rest = lexemes[end + 1..].to_vec();
    let is_order = longest(&rest, &VERBS).is_some();
    let is_idle = longest_phrase(&lexemes[from..end], ASKED_OF_NOBODY).is_some() && !asks(&lexemes[..end]);
    if from > 0 && is_idle && is_order && stands_alone(lexemes, &rest, &[Clause { from: 0, end }]) {
        *lexemes = rest;
    }
}

/// "Put a newspaper — my wife hates it when I read over breakfast — on the table".
fn without_dashed(words: &str, lexemes: &mut Vec<Lexeme>, names: &Names<'_>) {
    let is_dash = |at: usize| {
        let between =
            words.get(lexemes[at - 1].end..lexemes[at].start.max(lexemes[at - 1].end)).unwrap_or_default();
        let own = words.get(lexemes[at].start..lexemes[at].end).unwrap_or_default();
        [between, own]
            .iter()
            .any(|said| said.contains(['—', '–']) || said.contains(" - ") || said.contains("--"))
    };
    let dashes: Vec<usize> = (1..lexemes.len()).filter(|at| is_dash(*at)).collect();
    let found = dashes.windows(2).find_map(|pair| {
        let &[first, second] = pair else { return None };
        let from = first + usize::from(is_mark(&lexemes[first]));
        let behind = second + usize::from(is_mark(&lexemes[second]));
        let goes_on = lexemes.get(behind..).is_some_and(|rest| {
            longest(rest, &WAYS).is_some() || longest(rest, &ABOUT_IT).is_some() || word(rest, 0) == "to"
        });
        let aside = lexemes.get(from..second)?;
        (goes_on && !aside.is_empty() && tells(aside, names)).then_some((first, behind))
    });
    if let Some((first, behind)) = found {
        lexemes.drain(first..behind);
    }
}

/// "Hydrants, signs and benches are another department's headache; ...".
fn without_told_lists(lexemes: &mut Vec<Lexeme>, names: &Names<'_>) {
    let Some(end) = lexemes.iter().position(|lexeme| lexeme.token == Token::Break) else { return };
    let Some(is_left) = lexemes.get(end + 1).map(|lexeme| !is_mark(lexeme)) else { return };
    let list = &lexemes[..end];
    let verb = list.iter().position(|lexeme| is_auxiliary(word_of(lexeme))).filter(|verb| *verb > 0);
    let Some(verb) = verb else { return };
    let is_thing =
        |at: usize| category(&list[at..verb]).is_some() || names.asset_words(&list[at..verb]).is_some();
    let is_list = list[..verb].iter().any(is_mark) && is_thing(0) && word(list, 0).ends_with('s');
    let told: Vec<Lexeme> = list[verb - 1..].to_vec();
    let order = longest(&lexemes[end + 1..], &VERBS).is_some()
        || longest_phrase(&lexemes[end + 1..], ASKING).is_some();
    if is_left && is_list && order && asks_nothing(&told, names) && !list[verb..].iter().any(is_mark) {
        lexemes.drain(..=end);
    }
}
