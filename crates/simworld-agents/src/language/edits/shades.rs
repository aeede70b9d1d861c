//! Shades by their names: "tangerine" is orange, "jet-black" black and "lilac" purple.
//!
//! Things have one of eleven colours, and people know many more. A shade stands for the one of the eleven whose hue it has by the CSS named colours,
//! or that it is called after ("bottle green"). Beige, khaki, rust and others that people see as different colours are none here. What is first
//! of all a plant, a dish or a metal is a shade only where a thing is said to have it: "paint the van plum", and not "plant a plum tree".

use std::sync::LazyLock;

use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{longest, longest_phrase};
use super::super::phrases::{Index, Phrases};
use super::forms::{word, word_at};
use super::respelt::is_name;

/// Shades wherever they stand, and the colours that they are of.
#[rustfmt::skip]
const SHADE_ROWS: &[(&[&str], &str)] = &[
    (&["maroon", "burgundy", "ruby", "vermilion", "vermillion", "carmine", "claret", "oxblood", "ruby red", "cherry red", "blood red", "brick red", "wine red", "tomato red", "cardinal red", "signal red", "pillar box red",
        "fire engine red", "bright red", "fiery red", "crimson red", "scarlet red", "cadmium red"], "red"),
    (&["tangerine", "burnt orange", "pumpkin orange", "carrot orange", "tangerine orange", "traffic orange", "bright orange"], "orange"),
    (&["lemon yellow", "canary yellow", "mustard yellow", "golden yellow", "sunflower yellow", "sunshine yellow", "banana yellow", "bright yellow", "butter yellow"], "yellow"),
    (&["emerald", "jade", "viridian", "emerald green", "jade green", "lime green", "olive green", "bottle green", "forest green", "sea green", "mint green", "moss green", "grass green", "pea green", "apple green", "racing green",
        "british racing green", "sage green", "pine green", "leaf green", "fir green", "neon green", "bright green"], "green"),
    (&["azure", "cobalt", "sapphire", "ultramarine", "cerulean", "turquoise", "teal", "cyan", "aqua", "aquamarine", "navy blue", "sky blue", "baby blue", "royal blue", "midnight blue", "powder blue", "ice blue", "steel blue",
        "electric blue", "cobalt blue", "azure blue", "sapphire blue", "cornflower blue", "petrol blue", "peacock blue", "ocean blue", "marine blue", "duck egg blue", "bright blue"], "blue"),
    (&["lilac", "mauve", "amethyst", "royal purple", "lavender purple", "imperial purple", "aubergine purple", "lilac purple", "bright purple"], "purple"),
    (&["fuchsia", "magenta", "cerise", "hot pink", "shocking pink", "salmon pink", "rose pink", "baby pink", "candy pink", "bubblegum pink", "bright pink", "neon pink"], "pink"),
    (&["umber", "sepia", "mahogany", "chocolate brown", "coffee brown", "chestnut brown", "nut brown", "hazel brown", "earth brown", "walnut brown", "dark brown"], "brown"),
    (&["ivory", "alabaster", "off white", "snow white", "pearl white", "milk white", "ivory white", "eggshell white", "cream white", "lily white", "pure white", "bone white", "chalk white", "antique white", "brilliant white", "snowy white",
        "milky white", "creamy white"], "white"),
    (&["anthracite", "gunmetal", "slate grey", "slate gray", "charcoal grey", "charcoal gray", "ash grey", "ash gray", "battleship grey", "battleship gray", "silver grey", "silver gray", "steel grey", "steel gray", "dove grey", "dove gray", "pearl grey", "pearl gray",
        "mouse grey", "mouse gray", "stone grey", "stone gray"], "grey"),
    (&["ebony", "jet black", "coal black", "raven black", "ink black", "inky black", "midnight black", "ebony black", "piano black"], "black"),
];
static SHADES: LazyLock<Index<&'static str>> = LazyLock::new(|| Index::of(SHADE_ROWS));

/// Shades that are something else as well, and the colours that they are of.
#[rustfmt::skip]
const LIKE_ROWS: &[(&[&str], &str)] = &[
    (&["cherry", "wine", "tomato", "strawberry"], "red"),
    (&["apricot", "pumpkin", "carrot"], "orange"),
    (&["lemon", "mustard", "canary", "banana", "gold"], "yellow"),
    (&["olive", "mint"], "green"),
    (&["plum", "aubergine", "lavender"], "purple"),
    (&["rose", "salmon"], "pink"),
    (&["chocolate", "coffee", "chestnut", "walnut", "tan"], "brown"),
    (&["charcoal", "slate"], "grey"),
];
static LIKE: LazyLock<Index<&'static str>> = LazyLock::new(|| Index::of(LIKE_ROWS));

/// Before a shade that a thing is to have.
#[rustfmt::skip]
const TO_BE: &Phrases = &Phrases::of(&["in", "be", "become", "becomes", "go", "goes", "turn", "turns", "colour", "color", "painted", "coloured", "colored"]);
/// Verbs of painting.
#[rustfmt::skip]
const PAINTS: &Phrases = &Phrases::of(&["paint", "repaint", "recolour", "recolor", "colour", "color", "dye", "tint", "respray", "spray", "make", "turn"]);
/// Verbs of wishes.
#[rustfmt::skip]
const WISHES: &Phrases = &Phrases::of(&["should", "must", "ought", "shall", "want", "like", "love", "make", "look", "looks", "would", "have", "prefer"]);
/// Before a noun, or a name of a thing.
#[rustfmt::skip]
const BEFORE_NOUN: &[&str] = &["the", "a", "an", "this", "that", "these", "those", "my", "our", "your", "its", "his", "her", "their", "some", "any", "every", "each", "all", "no", "of", "for", "with", "and", "or", "plus", "like", "than", "more", "to", "near", "by", "behind", "beside", "between", "grow", "put", "add", "plant", "old", "new", "big", "small", "little", "tall", "wild"];
/// Behind a shade that a thing is to have.
const ENDS: &Phrases = &Phrases::of(&[
    "and", "please", "too", "now", "instead", "then", "thanks", "again", "coloured", "colored",
]);

/// Puts colours in the place of their shades. Names stay as they are.
pub(super) fn in_plain_words(words: &str, lexemes: &mut Vec<Lexeme>) {
    let mut at = 0;
    while at < lexemes.len() {
        if let Some((colour, count)) = shade(words, lexemes, at) {
            let mut plain = word_at(&lexemes[at], colour);
            plain.end = lexemes[at + count - 1].end;
            lexemes.splice(at..at + count, [plain]);
        }
        at += 1;
    }
}

/// The colour of the shade that is named from a word on, and how many words name it.
fn shade(words: &str, lexemes: &[Lexeme], at: usize) -> Option<(&'static str, usize)> {
    let rest = &lexemes[at..];
    let sure = longest(rest, &SHADES).filter(|_| !is_sky(lexemes, at));
    let found = sure.or_else(|| longest(rest, &LIKE).filter(|(_, count)| is_had(lexemes, at, *count)))?;
    // "Ruby Lane" is a name wherever it stands.
    let is_written = |at: usize| {
        lexemes.get(at).is_some_and(|next| {
            matches!(next.token, Token::Word(_)) && words[next.start..].starts_with(char::is_uppercase)
        })
    };
    (!is_name(words, lexemes, at) && !is_written(at + found.1)).then_some(found)
}

/// "I want the sky blue": of no thing.
fn is_sky(lexemes: &[Lexeme], at: usize) -> bool {
    word(lexemes, at) == "sky" && at > 0 && word(lexemes, at - 1) == "the"
}

/// Whether a thing is said to have the shade that stands there: "in olive", "paint the van plum", "plum coloured".
fn is_had(lexemes: &[Lexeme], at: usize, count: usize) -> bool {
    let behind = &lexemes[at + count..];
    if longest_phrase(behind, &["coloured", "colored"]).is_some() {
        return true;
    }
    let ends = behind.first().is_none_or(is_mark) || longest_phrase(behind, ENDS).is_some();
    let before = at.checked_sub(1).map_or("", |at| word(lexemes, at));
    if !ends || before.is_empty() || BEFORE_NOUN.contains(&before) || before.ends_with("est") {
        return false;
    }
    let clause = lexemes[..at].iter().rposition(is_mark).map_or(0, |mark| mark + 1);
    let said =
        |list: &Phrases| (clause..at - 1).any(|from| longest_phrase(&lexemes[from..at], list).is_some());
    // "The shop that deals in coffee" is not brown.
    let is_to_be = TO_BE.contains(before) && clause + 1 < at && (before != "in" || said(WISHES));
    is_to_be || said(PAINTS)
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::rewritten;
    use super::*;

    fn plain(said: &str) -> String {
        rewritten(said, |lexemes| in_plain_words(said, lexemes))
    }

    #[test]
    fn shades_are_colours() {
        assert_eq!(plain("make the bus tangerine"), "make the bus orange");
        assert_eq!(plain("a jet-black cat and an off-white van"), "a black cat and an white van");
        assert_eq!(plain("paint it sky blue"), "paint it blue");
        assert_eq!(plain("paint the van plum"), "paint the van purple");
        assert_eq!(plain("all cars should be olive"), "all cars should be green");
        assert_eq!(plain("a plum-coloured van"), "a purple coloured van");
    }

    #[test]
    fn what_is_no_shade_or_a_name_stays() {
        for said in [
            "plant a plum tree",
            "paint the olive",
            "a row of lavender",
            "i want the sky blue",
            "cut down the chestnut",
            "make room for lavender",
            "the shop that deals in coffee",
            "paint the bench next to the cherry white",
        ] {
            assert_eq!(plain(said), said);
        }
        assert_eq!(plain("call the dog Ruby"), "call the dog ruby");
        assert_eq!(plain("close Emerald Street"), "close emerald street");
    }
}
