//! Remarks that read like wishes, and are none: "any car will do", and behind a request "spring is coming".

use super::super::lexer::{Lexeme, is_mark};
use super::super::lexicon::longest_phrase;
use super::super::phrases::Phrases;

/// Which one is left to who places it: before it, and behind it.
const ANY: &Phrases = &Phrases::of(&["any", "whichever", "whatever", "either", "anything", "anywhere"]);
#[rustfmt::skip]
const WILL_DO: &Phrases = &Phrases::of(&["will do", "would do", "is fine", "is okay", "is ok", "is good", "is good enough", "works", "does", "does it", "suffices", "is alright", "is all right", "will do nicely", "would be fine", "is fine with me", "is fine by me"]);
#[rustfmt::skip]
const SEASONS: &Phrases = &Phrases::of(&["spring", "summer", "autumn", "fall", "winter", "christmas", "easter", "halloween", "the holidays", "the season", "the festival", "the rain", "the snow", "rain", "snow"]);
/// Why something is wished for, and no order to turn the season.
#[rustfmt::skip]
const COMES: &Phrases = &Phrases::of(&["is coming", "is coming soon", "is near", "is nearly here", "is almost here", "is around the corner", "is on its way", "is here", "is approaching", "will be here soon", "starts soon", "begins soon", "is not far off"]);

/// For what room is made, which is nothing that is to be made.
#[rustfmt::skip]
const NEED_ROOM: &Phrases = &Phrases::of(&["we need the floor", "we need the space", "we need the room", "we need the spot", "we need the place", "i need the floor", "i need the space", "i need the room", "i need the spot", "they need the space", "they need the room", "we need that space", "i need that space",
    "we need that spot"]);

/// What somebody cries of, which is no slip of anything.
const CRIED: &[&str] = &[
    "mess", "shame", "pity", "sight", "racket", "nuisance", "disgrace", "relief", "hassle", "bother", "drag",
    "joke", "farce",
];

/// Leaves them out, unless nothing else is said.
pub(super) fn leave_out(lexemes: &mut Vec<Lexeme>) {
    let mut from = 0;
    while from < lexemes.len() {
        let end = lexemes[from..].iter().position(is_mark).map_or(lexemes.len(), |mark| from + mark);
        if from > 0 && is_passing(&lexemes[from..end]) {
            // With the mark before it.
            lexemes.drain(from - 1..end);
            from = from.saturating_sub(1);
        }
        from += lexemes[from..].iter().position(is_mark).map_or(lexemes.len(), |mark| mark + 1);
    }
}

fn is_passing(words: &[Lexeme]) -> bool {
    let because = longest_phrase(words, &["as", "since", "because", "for", "now that"]).unwrap_or(0);
    let words = words.get(because..).unwrap_or_default();
    let ends = |phrases: &Phrases, at: usize| longest_phrase(&words[at..], phrases) == Some(words.len() - at);
    let leaves_open = longest_phrase(words, ANY).is_some() && (1..words.len()).any(|at| ends(WILL_DO, at));
    let is_season =
        longest_phrase(words, SEASONS).is_some_and(|said| said < words.len() && ends(COMES, said));
    // "..., what a mess".
    let exclaims = longest_phrase(words, &["what a", "what an", "such a", "such an"])
        .is_some_and(|said| (said + 1..=said + 3).contains(&words.len()));
    leaves_open || is_season || exclaims || longest_phrase(words, NEED_ROOM).is_some()
}

/// What somebody finds it to be like, behind a comma: "..., like a little queue", "..., as if it were a frog". "Like the red one" says how it
/// is to be, and "something, like a bench" what is wanted.
pub(super) fn leave_out_similes(words: &str, lexemes: &mut Vec<Lexeme>) {
    const LEADS: &[&str] = &[
        ", like ",
        ", just like ",
        ", a bit like ",
        ", almost like ",
        ", sort of like ",
        ", as if ",
        ", as though ",
    ];
    const BEGINS: &[&str] = &[
        "a ", "an ", "in a ", "in the ", "in an ", "they ", "we ", "some ", "two ", "three ", "four ",
        "at a ", "on a ", "back ", "it ",
    ];
    const OF_THINGS: &Phrases =
        &Phrases::of(&["one", "ones", "that", "those", "should", "must", "please", "say"]);
    const OPEN: &Phrases = &Phrases::of(&["something", "anything", "somewhere", "someone", "somebody"]);
    let lower = words.to_ascii_lowercase();
    let found = LEADS.iter().find_map(|lead| lower.find(lead).map(|at| (at, at + lead.len(), *lead)));
    let Some((at, behind, lead)) = found else { return };
    let is_said = lead.starts_with(", as") || BEGINS.iter().any(|begin| lower[behind..].starts_with(begin));
    let is_inside = |lexeme: &Lexeme| lexeme.start > at && !is_mark(lexeme);
    let Some(first) = lexemes.iter().position(is_inside).filter(|first| is_said && *first > 0) else {
        return;
    };
    let end = (first..lexemes.len()).find(|at| is_mark(&lexemes[*at])).unwrap_or(lexemes.len());
    let any = |from: usize, to: usize, phrases: &Phrases| {
        (from..to).any(|at| longest_phrase(&lexemes[at..to], phrases).is_some())
    };
    if any(first, end, OF_THINGS) || any(0, first, OPEN) {
        return;
    }
    let from = first - usize::from(is_mark(&lexemes[first - 1]));
    if from > 0 {
        lexemes.drain(from..end);
    }
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    [ANY, WILL_DO, SEASONS, COMES, NEED_ROOM]
        .into_iter()
        .flatten()
        .flat_map(|phrase| phrase.split(' '))
        .chain(CRIED.iter().copied())
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::{Token, lex, rewritten};
    use super::*;

    #[test]
    fn what_is_said_in_passing_is_left_out_unless_it_is_all() {
        let plain = |said: &str| {
            let mut lexemes = lex(said);
            leave_out(&mut lexemes);
            let words = lexemes.iter().filter_map(|lexeme| match &lexeme.token {
                Token::Word(word) => Some(word.clone()),
                _ => None,
            });
            words.collect::<Vec<_>>().join(" ")
        };
        assert_eq!(plain("park a car here. Any car will do."), "park a car here");
        assert_eq!(plain("two beds, spring is coming, and a bench"), "two beds and a bench");
        assert_eq!(plain("any car will do"), "any car will do");
        assert_eq!(plain("make it snow, winter is here to stay"), "make it snow winter is here to stay");
    }

    #[test]
    fn what_it_is_like_is_left_out_and_what_it_is_to_be_like_is_not() {
        let plain = |said: &str| rewritten(said, |lexemes| leave_out_similes(said, lexemes));
        assert_eq!(plain("put a man here, like a little queue"), "put a man here");
        assert_eq!(plain("paint it, as if it were a frog, and go"), "paint it , and go");
        assert_eq!(plain("paint it, like the red one"), "paint it , like the red one");
        assert_eq!(plain("add something, like a bench"), "add something , like a bench");
    }
}
