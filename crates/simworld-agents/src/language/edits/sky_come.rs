//! Skies among other requests: "and let fog roll in" makes it foggy wherever it stands; "a clear sky at noon, and a parasol near the chair", "a foggy dawn
//! over the water" and "rain and noon light at the same time" are skies that are asked for.
//!
//! The first says the same in every sentence, and would be taken for part of a name or of a place. The others are tried only where a sentence was refused.

use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{longest, longest_phrase};
use super::super::phrases::Phrases;
use super::forms::{word, words_at};
use super::retold::is_new;
use super::words::SKIES;

/// Before a sky that is let come.
const LET: &[&str] = &["let", "have"];
const ARTICLES: &[&str] = &["the", "a", "an", "some"];
/// How it comes.
#[rustfmt::skip]
const COMES: &Phrases = &Phrases::of(&["roll in", "roll over", "roll up", "come in", "come down", "come rolling in", "drift in", "drift over", "drift by", "creep in", "creep up", "move in", "set in", "settle", "settle in", "blow in", "blow over", "sweep in", "sweep over", "fall", "fall down", "pour down", "descend", "close in", "gather", "hang low",
    "seep in", "steal in", "slide in", "float in", "billow in", "wash in", "waft in"]);
/// Whence it comes, or over what it hangs: the sky is everywhere.
#[rustfmt::skip]
const OVER: &[&str] = &["over", "across", "above", "from", "off", "upon", "up from", "in from", "in over"];
const OURS: &[&str] = &["the", "our", "this", "that", "my"];
#[rustfmt::skip]
const WIDE: &[&str] = &["water", "sea", "bay", "harbour", "harbor", "river", "city", "town", "quay", "campus", "roofs", "rooftops", "hills", "fields", "place", "scene", "land", "docks", "port", "country", "countryside", "lake", "waves", "quarter", "horizon", "village", "houses", "ocean", "coast", "estuary", "valley", "mountains", "square", "plaza", "piazza", "marketplace", "market", "park", "gardens", "streets", "alleys", "lanes", "canal", "canals", "pier", "jetty", "cobbles", "cobblestones", "courtyard", "lawns", "meadows", "buildings", "treetops", "trees", "chimneys", "everything", "everyone", "everybody", "us", "neighbourhood", "district", "marsh", "moor"];
/// Before a sky that is asked for.
#[rustfmt::skip]
const LEADS: &Phrases = &Phrases::of(&["give me", "give us", "i want", "we want", "id like", "wed like", "i would like", "we would like", "lets have", "let us have", "let me have", "i need", "we need", "can we have", "could we have", "can i have", "could i have", "may i have", "may we have", "id love", "wed love", "i would love", "we would love",
    "please give me", "please give us", "i am after", "im after", "we are after", "how about"]);
/// Between and behind what is said of it.
#[rustfmt::skip]
const BETWEEN: &[&str] = &["a", "an", "the", "some", "and", "but", "with", "at", "in", "of", "very", "nice", "lovely", "light", "sky", "skies", "weather"];
/// That it is so all at once.
#[rustfmt::skip]
const TOGETHER: &Phrases = &Phrases::of(&["at the same time", "at one and the same time", "at once", "all at once", "both at once", "together", "simultaneously", "both", "both together", "combined"]);

/// "Let fog roll in" makes it foggy.
pub(super) fn in_plain_words(lexemes: &mut Vec<Lexeme>) {
    let mut at = 0;
    while at < lexemes.len() {
        if let Some((sky, end)) = let_come(lexemes, at) {
            let place = lexemes[at].clone();
            let told: Vec<Lexeme> = words_at(&place, "make it").chain(sky).collect();
            lexemes.splice(at..end, told);
        }
        at += 1;
    }
}

/// The sky that is let come here, and where the words end that say so.
fn let_come(lexemes: &[Lexeme], at: usize) -> Option<(Vec<Lexeme>, usize)> {
    let is_begun = at == 0 || is_mark(&lexemes[at - 1]) || JOINTS.contains(&word(lexemes, at - 1));
    let lets = longest_phrase(&lexemes[at..], LET).filter(|_| is_begun)?;
    let from = at + lets + longest_phrase(lexemes.get(at + lets..)?, ARTICLES).unwrap_or(0);
    let (_, words) = longest(lexemes.get(from..)?, &SKIES)?;
    let comes = from + words + longest_phrase(lexemes.get(from + words..)?, COMES)?;
    let end = behind_wide(lexemes, comes);
    ends(lexemes, end).then(|| (lexemes[from..from + words].to_vec(), end))
}

/// Words behind which an order may begin, and between two.
const JOINTS: &[&str] = &["and", "then", "please", "also", "so", "but", "now"];

/// Whether a request may end here.
fn ends(lexemes: &[Lexeme], at: usize) -> bool {
    lexemes.get(at).is_none_or(is_mark) || JOINTS.contains(&word(lexemes, at))
}

/// Where "over the water" ends, if it stands here.
fn behind_wide(lexemes: &[Lexeme], at: usize) -> usize {
    let found = || {
        let over = at + longest_phrase(lexemes.get(at..)?, OVER)?;
        let noun = over + longest_phrase(lexemes.get(over..)?, OURS).unwrap_or(0);
        // "Over the old town", "over Market Square".
        let last = noun + usize::from(WIDE.contains(&word(lexemes, noun + 1)));
        WIDE.contains(&word(lexemes, last)).then_some(last + 1)
    };
    found().unwrap_or(at)
}

/// A sentence in which a sky is asked for at the beginning, with that put plainly; none if it is not so.
pub(super) fn asked_for(lexemes: &[Lexeme]) -> Option<Vec<Lexeme>> {
    let place = lexemes.first()?;
    let lead = longest_phrase(lexemes, LEADS);
    let (sky, behind) = sky_of(lexemes, lead.unwrap_or(0))?;
    let wide = behind_wide(lexemes, behind);
    let end = wide + lexemes.get(wide..).and_then(|rest| longest_phrase(rest, TOGETHER)).unwrap_or(0);
    let more = new_behind(lexemes, end);
    let is_whole = end > behind && ends(lexemes, end);
    if more.is_none() && !is_whole || lead.is_none() && end == behind {
        return None;
    }
    let mut told: Vec<Lexeme> = words_at(place, "make it").chain(sky).collect();
    if let Some(more) = more {
        told.push(Lexeme { token: Token::Comma, lemma: None, ..place.clone() });
        told.extend(words_at(place, "and put"));
        told.extend_from_slice(&lexemes[more..]);
    } else {
        told.extend_from_slice(&lexemes[end..]);
    }
    Some(told)
}

/// All that is said of the sky from a word on, and where that ends.
fn sky_of(lexemes: &[Lexeme], from: usize) -> Option<(Vec<Lexeme>, usize)> {
    let (mut told, mut at, mut end) = (Vec::new(), from, from);
    while let Some(rest) = lexemes.get(at..).filter(|rest| !rest.is_empty()) {
        let hour = || super::sky::hour(rest).map(|(_, words)| words).filter(|_| !told.is_empty());
        if let Some(words) = longest(rest, &SKIES).map(|(_, words)| words).or_else(hour) {
            told.extend_from_slice(&rest[..words]);
            at += words;
            end = at;
        } else if BETWEEN.contains(&word(lexemes, at)) {
            at += 1;
            // "Noon light" is one word for it, and "rain and" goes on.
            if ["light", "sky", "skies", "weather"].contains(&word(lexemes, at - 1)) && end + 1 == at {
                end = at;
            }
        } else {
            break;
        }
    }
    (!told.is_empty()).then_some((told, end))
}

/// Where the new things begin that are asked for along with a sky: "..., and a parasol near the chair".
fn new_behind(lexemes: &[Lexeme], end: usize) -> Option<usize> {
    let mark = end + usize::from(lexemes.get(end).is_some_and(|lexeme| lexeme.token == Token::Comma));
    let and = longest_phrase(lexemes.get(mark..)?, &["and", "plus", "with", "along with", "as well as"])?;
    let from = mark + and;
    let is_number = (1..=2).any(|words| lexemes.get(from..from + words).is_some_and(is_new));
    // "And a foggy morning" is more of the sky, and is none of the things.
    (is_number && longest(lexemes.get(from + 1..)?, &SKIES).is_none()).then_some(from)
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::rewritten;
    use super::{asked_for, in_plain_words};

    #[test]
    fn weather_is_let_come() {
        for (said, meant) in [
            (
                "swap anna and ben, call the dog captain, and let fog roll in",
                "swap anna and ben , call the dog captain , and make it fog",
            ),
            ("let the snow fall and remove the bin", "make it snow and remove the bin"),
            ("let thick fog drift in from the sea", "make it thick fog"),
            ("let fog roll in over the square", "make it fog"),
            (
                "let the mist creep in over market square and remove the bin",
                "make it mist and remove the bin",
            ),
            // These say something else.
            ("let the snow fall on the bench", "let the snow fall on the bench"),
            ("let the ball roll in", "let the ball roll in"),
            ("i let the night fall", "i let the night fall"),
            ("let it rain", "let it rain"),
        ] {
            assert_eq!(rewritten(said, in_plain_words), meant, "{said}");
        }
    }

    #[test]
    fn a_sky_is_asked_for_beside_other_things() {
        let plain = |said: &str| rewritten(said, |lexemes| *lexemes = asked_for(lexemes).unwrap_or_default());
        for (said, meant) in [
            (
                "lets have a clear sky at noon, and a parasol near the red chair",
                "make it clear sky noon , and put a parasol near the red chair",
            ),
            ("give me a foggy dawn over the water", "make it foggy dawn"),
            ("id like rain and noon light at the same time", "make it rain noon"),
            // These are said otherwise, or say something else.
            ("give me a foggy dawn", ""),
            ("give me a bench and a foggy dawn", ""),
            ("a dark night and a bench", ""),
            ("i want snow on the bench and a lamp", ""),
        ] {
            assert_eq!(plain(said), meant, "{said}");
        }
    }
}
