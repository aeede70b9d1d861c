//! Single words that are put plainly wherever they stand: "five metres up north", "in the direction of the statue", "the bin that is nearest to
//! the stop", "with the exception of"; and what is said while somebody thinks, within a part that goes on behind it ("I need, let me think, a bin").

use super::super::compass::DIRECTIONS;
use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{category, longest, longest_phrase};
use super::super::numbers;
use super::super::phrases::Phrases;
use super::forms::{word, words_at};
use super::words::WAYS;

/// Phrases, and the plainer ones that mean the same.
#[rustfmt::skip]
const PLAINER: &[(&Phrases, &str)] = &[
    (&Phrases::of(&["in the direction of", "into the direction of", "in direction of", "in the general direction of"]), "towards"),
    (&Phrases::of(&["hanging around near", "hanging about near", "hanging around by", "loitering near", "hanging around"]), "near"),
    (&Phrases::of(&["in the near of", "in near of", "near of", "near from", "close of", "close from"]), "near"),
    (&Phrases::of(&["wouldnt look half bad", "would not look half bad", "wouldnt look bad", "wouldnt go amiss", "would not go amiss"]), "would look nice"),
    (&Phrases::of(&["nothing would make me happier than seeing", "nothing would make me happier than", "nothing would please me more than seeing", "nothing would please me more than"]), "add"),
    (&Phrases::of(&["it has here", "has it here", "there has here", "it gives here", "gives it here"]), "are there"),
    (&Phrases::of(&["i would want", "we would want"]), "i want"),
    (&Phrases::of(&["if it makes you no trouble", "if it makes no trouble", "if it is no trouble for you"]), "please"),
    (&Phrases::of(&["per cent", "per cents", "per centum", "pct"]), "percent"),
    (&Phrases::of(&["with the exception of", "with exception of", "with the sole exception of", "excepting", "to the exclusion of"]), "except for"),
];
/// What is said while somebody thinks.
#[rustfmt::skip]
const THINKS: &Phrases = &Phrases::of(&["let me think", "let me see", "let me think a moment", "let me think for a moment", "now let me think", "whats the word", "what is the word", "whats it called", "what is it called", "how do you say", "how do you call it", "what do you call it", "whats the name", "i dont know", "i dunno", "dunno", "let us see", "lets see", "how shall i put it", "how do i put it",
    "how do i say this", "how should i say", "give me a second", "one moment", "just a second", "wait a second", "where was i", "what was it", "what was it again", "whats it called again", "what do they call it", "what shall i say", "shall we say", "lets say", "say", "you know", "hmm", "hm", "er", "erm", "um", "uh", "umm", "oh", "well", "for example", "for instance", "i guess", "i think", "maybe", "perhaps"]);
/// Words at which nothing ends.
#[rustfmt::skip]
const UNFINISHED: &Phrases = &Phrases::of(&["be", "need", "needs", "want", "wants", "add", "put", "place", "like", "have", "has", "a", "an", "the", "with", "next to", "beside", "behind", "near", "in front of", "of", "get", "build", "plant", "place", "park", "set", "remove", "delete", "paint", "move", "turn", "make", "give me", "see", "to", "between", "opposite", "by", "some", "from", "for", "my", "our", "at", "into", "onto", "towards", "another", "across from", "left of", "right of"]);

/// Puts them plainly.
pub(super) fn in_plain_words(words: &str, lexemes: &mut Vec<Lexeme>) {
    without_what_for(lexemes);
    plainer(lexemes);
    without_thinking(words, lexemes);
    straight_on(lexemes);
    that_is_nearest(lexemes);
    of_the_colour(lexemes);
}

/// "Make the bin of the colour orange": make it orange.
fn of_the_colour(lexemes: &mut Vec<Lexeme>) {
    const OF: &Phrases = &Phrases::of(&[
        "of the color",
        "of the colour",
        "in the color",
        "in the colour",
        "of color",
        "of colour",
    ]);
    let makes = lexemes.iter().position(|lexeme| lexeme.token == Token::Word("make".to_owned()));
    let Some(from) = makes else { return };
    if let Some(at) = (from + 2..lexemes.len()).find(|at| longest_phrase(&lexemes[*at..], OF).is_some()) {
        let words = longest_phrase(&lexemes[at..], OF).unwrap_or(0);
        lexemes.drain(at..at + words);
    }
}

/// "It's cold here, so add a campfire" sets no weather, and who says "I'm drawing a map, how many doors are there?" adds none.
fn without_what_for(lexemes: &mut Vec<Lexeme>) {
    #[rustfmt::skip]
    const FEELS: &Phrases = &Phrases::of(&["its cold", "it is cold", "its so cold", "it is so cold", "its freezing", "it is freezing", "its chilly", "it is chilly", "its hot", "it is hot", "its so hot", "it is so hot", "its warm", "it is warm",
        "its boiling", "it is boiling", "its really cold", "its really hot", "its very cold", "its very hot", "its dark", "it is dark", "its so dark", "it is so dark"]);
    const HERE: &Phrases = &Phrases::of(&[
        "here",
        "out here",
        "out",
        "outside",
        "in here",
        "over here",
        "there",
        "today",
        "tonight",
    ]);
    const DOING: &Phrases = &Phrases::of(&[
        "im",
        "i am",
        "were",
        "we are",
        "ive been",
        "i have been",
        "ill be",
        "i want to",
        "i have to",
        "i need to",
    ]);
    let Some(mark) = lexemes.iter().position(is_mark) else { return };
    // A greeting before it.
    let from = if mark <= 2 && longest_phrase(lexemes, FEELS).is_none() { mark + 1 } else { 0 };
    let rest = lexemes.get(from..).unwrap_or_default();
    if let Some(words) = longest_phrase(rest, FEELS) {
        let behind = words + longest_phrase(&rest[words..], HERE).unwrap_or(0);
        let comma = usize::from(rest.get(behind).is_some_and(is_mark));
        if longest_phrase(&rest[behind + comma..], &["so"]).is_some() {
            lexemes.drain(from..=from + behind + comma);
        }
        return;
    }
    let asks =
        |at: &usize| is_mark(&lexemes[at - 1]) && longest_phrase(&lexemes[*at..], &["how many"]).is_some();
    if longest_phrase(rest, DOING).is_some()
        && let Some(at) = (from + 2..lexemes.len()).find(asks)
    {
        let said = &lexemes[from..at - 1];
        if !said.iter().any(is_mark) {
            lexemes.drain(from..at);
        }
    }
}

fn plainer(lexemes: &mut Vec<Lexeme>) {
    let mut at = 0;
    while at < lexemes.len() {
        let found = PLAINER
            .iter()
            .find_map(|(said, plain)| longest_phrase(&lexemes[at..], *said).map(|words| (words, *plain)));
        if let Some((words, plain)) = found {
            let place = lexemes[at].clone();
            let plain: Vec<Lexeme> = words_at(&place, plain).collect();
            lexemes.splice(at..at + words, plain);
        }
        at += 1;
    }
}

/// "I need, let me think, a bin": where nothing can end, what is said between two commas goes with both of them.
fn without_thinking(words: &str, lexemes: &mut Vec<Lexeme>) {
    let mut at = 1;
    while at + 1 < lexemes.len() {
        let unfinished = (at.saturating_sub(3)..at)
            .any(|from| longest_phrase(&lexemes[from..at], UNFINISHED) == Some(at - from))
            || is_between(lexemes, at);
        let is_soft = |mark: &Lexeme| is_mark(mark) && !is_end(words, mark);
        if unfinished && is_soft(&lexemes[at]) {
            let behind = at + lexemes[at..].iter().take_while(|mark| is_soft(mark)).count();
            let thought = longest_phrase(&lexemes[behind.min(lexemes.len())..], THINKS)
                .map(|count| behind + count)
                .filter(|end| lexemes.get(*end).is_some_and(is_soft));
            let end = thought.map(|end| end + lexemes[end..].iter().take_while(|mark| is_soft(mark)).count());
            // The sound between the commas may be left out already.
            let between = words.get(lexemes[at - 1].end..lexemes.get(behind).map_or(0, |next| next.start));
            let sounded =
                behind > at + 1 || between.is_some_and(|between| between.chars().any(char::is_alphabetic));
            if let Some(end) = end.or((sounded && behind < lexemes.len()).then_some(behind)) {
                lexemes.drain(at..end);
            }
        }
        at += 1;
    }
}

/// "Between Carol and": the other of the two is still to come, where any other "and" may begin a remark.
pub(super) fn is_between(lexemes: &[Lexeme], at: usize) -> bool {
    let clause = lexemes[..at].iter().rposition(is_mark).map_or(0, |mark| mark + 1);
    at > clause
        && word(lexemes, at - 1) == "and"
        && (clause..at - 1).any(|from| word(lexemes, from) == "between")
}

/// Whether a mark is one that ends a sentence.
fn is_end(words: &str, mark: &Lexeme) -> bool {
    mark.token == Token::Break
        && words.get(mark.start..).is_some_and(|rest| rest.starts_with(['.', '!', '?', ';', ':']))
}

/// "Five metres up north", "three steps further to the left": so far north, and so far to the left.
fn straight_on(lexemes: &mut Vec<Lexeme>) {
    const ON: &Phrases = &Phrases::of(&[
        "up",
        "down",
        "over",
        "out",
        "further",
        "farther",
        "due",
        "straight",
        "directly",
        "further up",
        "further down",
        "more",
        "right",
        "across",
        "along",
        "on",
        "further on",
        "up to the",
        "over to the",
        "further to the",
        "down to the",
        "up towards the",
        "towards the",
        "up towards",
        "straight to the",
    ]);
    let mut at = 1;
    while at + 1 < lexemes.len() {
        let measure = (at.saturating_sub(3)..at).any(|from| {
            numbers::length(&lexemes[from..at]).is_some_and(|(_, words)| words > 1 && from + words == at)
        });
        let on = longest_phrase(&lexemes[at..], ON).filter(|_| measure);
        let is_way =
            |from: usize| lexemes.get(from..).is_some_and(|rest| longest(rest, DIRECTIONS).is_some());
        if let Some(words) = on.filter(|words| is_way(at + words)) {
            lexemes.drain(at..at + words);
        }
        at += 1;
    }
}

/// "The bin that is nearest to the stop" is the bin nearest to it.
fn that_is_nearest(lexemes: &mut Vec<Lexeme>) {
    const THAT_IS: &Phrases = &Phrases::of(&[
        "that is",
        "thats",
        "that are",
        "which is",
        "which are",
        "that stands",
        "which stands",
        "that lies",
        "who is",
        "whos",
        "who stands",
        "that sits",
        "located",
        "standing",
        "situated",
    ]);
    const FARTHEST: usize = 6;
    let mut at = 2;
    while at + 2 < lexemes.len() {
        let that = longest_phrase(&lexemes[at..], THAT_IS).filter(|words| {
            matches!(word(lexemes, at + words), "nearest" | "closest")
                && word(lexemes, at + words + 1) == "to"
        });
        let is_noun = (at.saturating_sub(3)..at)
            .any(|from| category(&lexemes[from..at]).is_some_and(|(_, words)| from + words == at));
        // "The tree in the park that's closest to Ada" is no park.
        let of_place = (at.saturating_sub(FARTHEST)..at - 1).any(|from| {
            longest(&lexemes[from..], &WAYS).is_some() && super::phrased::ends_which(lexemes, from)
        });
        if let Some(words) = that.filter(|_| is_noun && !of_place) {
            lexemes.drain(at..at + words);
        }
        at += 1;
    }
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    let plainer = PLAINER.iter().flat_map(|(said, _)| said.iter());
    plainer.chain(THINKS).flat_map(|phrase| phrase.split(' '))
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::rewritten;
    use super::*;

    fn plain(said: &str) -> String {
        rewritten(said, |lexemes| in_plain_words(said, lexemes))
    }

    #[test]
    fn what_is_said_while_thinking_goes_with_its_commas() {
        assert_eq!(plain("by the office I need, let me think, a bin"), "by the office i need a bin");
        assert_eq!(plain("put it at, let's see, the fountain"), "put it at the fountain");
        assert_eq!(plain("a bin between carol and, let me think, dmitri"), "a bin between carol and dmitri");
        assert_eq!(plain("add a bench, let me think, and a bin"), "add a bench , let me think , and a bin");
    }

    #[test]
    fn directions_and_the_nearest_are_told_plainly() {
        assert_eq!(plain("push it five metres up north"), "push it five metres north");
        assert_eq!(plain("the bin that is nearest to the stop"), "the bin nearest to the stop");
    }
}
