//! What is told of the weather and the hour beside a request, and asks for neither: "we had a lovely day", "it was a warm evening", "I love the snow",
//! "lovely day today, put ...".
//!
//! The clause is looked at as it was written, whatever was made of its words since. What is told alone asks ("it is a foggy morning"), and so does what is told beside
//! other words of the sky.

use super::super::lexer::{Lexeme, lex, word_of};
use super::super::lexicon::{longest, longest_phrase};
use super::parse::Reader;
use super::words::{SKIES, VERBS, Verb};

/// Before what is told.
#[rustfmt::skip]
const LEADS: &[&str] = &["oh", "ah", "well", "and", "but", "yes", "yeah", "hello", "hi", "hey", "wow", "because", "cause", "as", "since", "you", "know", "honestly", "indeed", "really"];
/// By these a clause wishes, though it speaks of what was.
#[rustfmt::skip]
const WISHES: &[&str] = &["if", "wish", "wished", "imagine", "pretend", "only", "would", "id", "wed", "should", "could", "please", "like", "hoping", "hoped", "thinking", "wondering", "dreaming", "rather", "supposed", "meant", "time", "let", "lets", "make", "until", "unless"];
/// Who likes something, how much, and that he does.
const WHO: &[&str] =
    &["i", "we", "they", "you", "everybody", "everyone", "people", "kids", "children", "visitors"];
const HOW: &[&str] =
    &["just", "really", "so", "always", "do", "also", "simply", "all", "still", "absolutely"];
#[rustfmt::skip]
const LIKES: &[&str] = &["love", "loves", "like", "likes", "enjoy", "enjoys", "hate", "hates", "adore", "adores", "loved", "liked", "enjoyed", "hated"];
/// That something is so.
const FRAMES: &[&str] =
    &["it", "its", "is", "isnt", "aint", "thats", "that", "this", "such", "quite", "what", "todays"];
const ARTICLES: &[&str] = &["a", "an", "the"];
/// What is said of a day in passing. "Good evening" is a greeting, and known elsewhere.
#[rustfmt::skip]
const PRAISE: &[&str] = &["lovely", "nice", "beautiful", "wonderful", "gorgeous", "glorious", "great", "fine", "splendid", "perfect", "pleasant", "delightful", "fabulous"];
#[rustfmt::skip]
const TIMES: &[&str] = &["day", "morning", "afternoon", "evening", "night", "weather", "sunshine", "summer", "winter", "spring", "autumn", "sunset", "sunrise"];
/// Behind it.
#[rustfmt::skip]
const TAILS: &[&str] = &["today", "tonight", "here", "outside", "out", "again", "isnt", "is", "it", "not", "innit", "we", "are", "were", "having", "everybody", "everyone", "folks", "so", "far", "there", "indeed", "for", "the", "time", "of", "year", "this", "that", "has", "been", "being", "turned", "to", "be", "truly", "really"];

impl Reader<'_> {
    /// Whether the clause in which some words stand only tells what the sky was or is like.
    pub(super) fn is_sky_told(&self, from: usize, end: usize) -> bool {
        let place = |at: usize| self.lexemes.get(at).map(|lexeme| (lexeme.start, lexeme.end));
        let (Some((first, _)), Some((_, last))) = (place(from), end.checked_sub(1).and_then(place)) else {
            return false;
        };
        let Some(clause) = clause_around(self.words, first, last).map(lex) else { return false };
        let said: Vec<&str> = clause.iter().map(word_of).collect();
        let had = said.iter().position(|word| *word == "had");
        if had.is_some_and(|had| !matches!(said.get(had + 1), Some(&("better" | "in")))) {
            return true;
        }
        (is_past(&said) || is_liked(&said) || is_praised(&said)) && asks_elsewhere(self.words, first, last)
    }
}

/// The clause around some bytes, as it was written.
fn clause_around(words: &str, first: usize, last: usize) -> Option<&str> {
    let is_end = |at: usize, letter: char| match letter {
        ',' | '.' | ';' | ':' | '!' | '?' | '\n' | '–' | '—' => true,
        // A hyphen ends nothing, and a dash does.
        '-' => words[..at].ends_with(' ') && words[at + 1..].starts_with(' '),
        _ => false,
    };
    let start = words.get(..first)?.char_indices().rev().find(|(at, letter)| is_end(*at, *letter));
    let start = start.map_or(0, |(at, letter)| at + letter.len_utf8());
    let stop = words.get(last..)?.char_indices().find(|(at, letter)| is_end(last + at, *letter));
    words.get(start..stop.map_or(words.len(), |(at, _)| last + at))
}

/// "It was a warm evening".
fn is_past(said: &[&str]) -> bool {
    said.contains(&"was") && !said.iter().any(|word| WISHES.contains(word))
}

/// "I love the snow", and neither "I'd love snow" nor "I love to see it snow".
fn is_liked(said: &[&str]) -> bool {
    const WOULD: &[&str] = &["would", "could", "should", "please", "if", "to", "id", "wed"];
    let who = behind(said, LEADS);
    let Some((_, rest)) = who.split_first().filter(|(who, _)| WHO.contains(who)) else { return false };
    behind(rest, HOW).first().is_some_and(|word| LIKES.contains(word))
        && !said.iter().any(|word| WOULD.contains(word))
}

/// "Lovely day today", "it's such a nice evening"; "a lovely evening" alone may be wanted.
fn is_praised(said: &[&str]) -> bool {
    let rest = behind(said, LEADS);
    let frames = rest.len() - behind(rest, FRAMES).len();
    let rest = &rest[frames..];
    let articles = rest.len() - behind(rest, ARTICLES).len();
    let praised = &rest[articles..];
    let times = behind(praised, PRAISE);
    let Some((_, tail)) = times.split_first().filter(|(time, _)| TIMES.contains(time)) else { return false };
    times.len() < praised.len()
        && tail.iter().all(|word| TAILS.contains(word))
        && (frames > 0 || articles == 0 || !tail.is_empty())
}

/// The words behind those that stand first.
fn behind<'a, 'b>(said: &'a [&'b str], first: &[&str]) -> &'a [&'b str] {
    let count = said.iter().take_while(|word| first.contains(word)).count();
    &said[count..]
}

/// Whether something else than a sky is ordered before some bytes or behind them.
fn asks_elsewhere(words: &str, first: usize, last: usize) -> bool {
    let parts = [words.get(..first), words.get(last..)];
    let others: Vec<Vec<Lexeme>> = parts.into_iter().flatten().map(lex).collect();
    let any = |fits: &dyn Fn(&[Lexeme]) -> bool| {
        others.iter().any(|part| (0..part.len()).any(|at| fits(&part[at..])))
    };
    // "I love rain, make it so" orders that.
    let orders = |rest: &[Lexeme]| {
        longest(rest, &VERBS).is_some_and(|(verb, count)| {
            verb != Verb::Make || longest_phrase(&rest[count..], &["it", "that", "this"]).is_none()
        })
    };
    any(&orders) && !any(&|rest| longest(rest, &SKIES).is_some())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn is_told(words: &str, clause: &str) -> bool {
        let first = words.find(clause).unwrap();
        let last = first + clause.len();
        let clause = lex(clause_around(words, first, last).unwrap());
        let said: Vec<&str> = clause.iter().map(word_of).collect();
        (is_past(&said) || is_liked(&said) || is_praised(&said)) && asks_elsewhere(words, first, last)
    }

    #[test]
    fn what_is_told_beside_an_order_is_no_wish() {
        for (words, clause) in [
            ("It was a warm evening. Put a bench here.", "It was a warm evening"),
            ("Put a bench here, I really love the snow", "I really love the snow"),
            ("Lovely day today, put a bench here", "Lovely day"),
            ("Oh, it's such a nice evening - remove the bin", "a nice evening"),
            ("Nice weather we are having. Remove the bin.", "Nice weather"),
        ] {
            assert!(is_told(words, clause), "{words}");
        }
    }

    #[test]
    fn what_is_wished_or_told_alone_is_one() {
        for (words, clause) in [
            ("I wish it was evening, and put a bench here", "it was evening"),
            ("I'd love snow, and put a bench here", "I'd love snow"),
            ("a lovely evening, and put a bench here", "a lovely evening"),
            ("I love autumn! Give me a rainy dusk.", "I love autumn"),
            ("It was a warm evening.", "It was a warm evening"),
            ("a foggy evening, and put a bench here", "a foggy evening"),
            ("I love rain, make it so", "I love rain"),
            ("we need more light, put a lamp here", "we need more light"),
        ] {
            assert!(!is_told(words, clause), "{words}");
        }
    }

    #[test]
    fn a_clause_ends_at_marks_and_dashes_alone() {
        let words = "we had a well-lit party - make it night, please";
        let first = words.find("make").unwrap();
        assert_eq!(clause_around(words, first, first + "make it night".len()), Some(" make it night"));
        assert_eq!(clause_around(words, 0, 6), Some("we had a well-lit party "));
    }
}
