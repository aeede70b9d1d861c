//! Shades of colours: "canary yellow" is yellow, and "make that olive" is green.
//!
//! A shade before its colour says no more than the colour. A shade alone is taken for its colour only where one stands: behind "make it" and the
//! like, behind "in", or behind what is to be painted; "the olive" and "an olive tree" stay what they are.

use super::super::lexer::{Lexeme, is_mark};
use super::super::lexicon::{category, longest, longest_phrase};
use super::super::paint::PAINTS;
use super::super::phrases::Phrases;
use super::forms::{word, word_at};

/// Colours, and what is said of their shades before them.
#[rustfmt::skip]
const BEFORE: &[(&[&str], &[&str])] = &[
    (&["yellow"], &["canary", "lemon", "mustard", "butter", "buttercup", "sunflower", "sunshine", "corn", "honey", "golden", "banana", "daffodil", "primrose", "saffron", "straw"]),
    (&["green"], &["olive", "lime", "mint", "forest", "emerald", "moss", "pea", "grass", "apple", "bottle", "sea", "jade", "sage", "leaf", "racing", "pine", "army", "hunter", "kelly", "pistachio", "avocado", "fern"]),
    (&["blue"], &["navy", "sky", "royal", "baby", "midnight", "powder", "ice", "ocean", "steel", "cobalt", "denim", "electric", "azure", "sapphire", "cornflower", "petrol", "marine", "prussian", "duck egg"]),
    (&["red"], &["cherry", "brick", "blood", "fire engine", "ruby", "wine", "tomato", "rose", "pillar box", "letterbox", "crimson", "scarlet", "cardinal", "poppy", "rust", "berry", "signal", "postbox", "ferrari"]),
    (&["orange"], &["burnt", "pumpkin", "tangerine", "carrot", "safety", "coral", "amber"]),
    (&["pink"], &["hot", "salmon", "candy", "bubblegum", "bubble gum", "rose", "shocking", "baby", "flamingo", "blush", "coral", "neon"]),
    (&["brown"], &["chocolate", "coffee", "nut", "chestnut", "hazel", "walnut", "caramel", "mud", "earth", "cinnamon"]),
    (&["white"], &["snow", "ivory", "pearl", "milk", "cream", "bone", "chalk", "lily"]),
    (&["black"], &["jet", "coal", "raven", "ebony", "ink", "soot"]),
    (&["grey", "gray"], &["slate", "steel", "ash", "charcoal", "dove", "mouse", "stone", "gunmetal", "smoke", "battleship", "elephant"]),
    (&["purple"], &["plum", "royal", "lilac", "imperial", "grape", "aubergine"]),
];
/// Shades that are said alone, with their colours.
#[rustfmt::skip]
const ALONE: &[(&[&str], &str)] = &[
    (&["olive", "khaki", "emerald", "jade", "lime", "mint"], "green"), (&["ivory", "cream"], "white"), (&["azure", "cobalt", "sapphire"], "blue"), (&["ruby", "maroon", "burgundy", "cherry"], "red"), (&["apricot", "tangerine"], "orange"),
    (&["lemon", "mustard", "canary"], "yellow"), (&["lilac", "lavender", "plum", "mauve", "aubergine"], "purple"), (&["magenta", "fuchsia"], "pink"), (&["charcoal", "slate"], "grey"), (&["ebony"], "black"), (&["chocolate", "chestnut"], "brown"),
];
/// Of those, what also grows.
#[rustfmt::skip]
const PLANTS: &[&str] = &["olive", "lime", "mint", "cherry", "apricot", "tangerine", "lemon", "lilac", "lavender", "plum", "fuchsia", "chestnut", "aubergine"];
/// Verbs that give a colour.
#[rustfmt::skip]
const PAINTS_IT: &[&str] = &["paint", "repaint", "colour", "color", "recolour", "recolor", "dye", "make", "turn", "spray", "respray", "tint", "change", "switch", "do", "have"];
/// Before a colour, and before no plant.
#[rustfmt::skip]
const LEADS: &[&str] = &["be", "become", "becomes", "go", "goes", "bright", "pale", "dark", "in"];
/// Behind a colour at the end of its part.
#[rustfmt::skip]
const ENDS: &Phrases = &Phrases::of(&["please", "instead", "too", "now", "and", "then", "thanks", "as well", "not", "again", "would", "for me"]);
/// Behind these any word may be a name.
const NAMES: &[&str] =
    &["call", "name", "rename", "christen", "label", "title", "called", "named", "baptise"];

/// Puts the colours in the place of their shades.
pub(super) fn in_plain_words(words: &str, lexemes: &mut Vec<Lexeme>) {
    let is_name = |lexeme: &Lexeme| words[lexeme.start..].starts_with(char::is_uppercase);
    let mut at = 0;
    while at < lexemes.len() {
        let is_named = at > 0 && is_name(&lexemes[at]);
        if let Some(shade) = before_colour(lexemes, at).filter(|_| !is_named) {
            lexemes.drain(at..at + shade);
        } else if let Some(colour) = alone(lexemes, at).filter(|_| !is_named) {
            lexemes[at] = word_at(&lexemes[at].clone(), colour);
        }
        at += 1;
    }
}

/// How many words of a shade stand before its colour: "canary yellow".
fn before_colour(lexemes: &[Lexeme], at: usize) -> Option<usize> {
    BEFORE.iter().find_map(|(colours, shades)| {
        let shade = longest_phrase(&lexemes[at..], *shades)?;
        colours.contains(&word(lexemes, at + shade)).then_some(shade)
    })
}

/// The colour of a shade that is said alone: "make that olive", "paint the van olive".
fn alone(lexemes: &[Lexeme], at: usize) -> Option<&'static str> {
    let (colour, _) = longest(&lexemes[at..=at], ALONE)?;
    let before = at.checked_sub(1)?;
    let behind = &lexemes[at + 1..];
    let ends = behind.first().is_none_or(is_mark) || longest_phrase(behind, ENDS).is_some();
    let begin = lexemes[..at].iter().rposition(is_mark).map_or(0, |mark| mark + 1);
    let said = |list: &[&str]| (begin..at).any(|at| list.contains(&word(lexemes, at)));
    if !ends || (0..at).any(|at| NAMES.contains(&word(lexemes, at))) {
        return None;
    }
    let is_plant = PLANTS.contains(&word(lexemes, at));
    let is_led = match word(lexemes, before) {
        // "Paint that lime" is about a tree.
        "that" | "this" | "these" | "those" => word(lexemes, before.wrapping_sub(1)) == "make",
        "it" | "them" | "him" | "her" | "to" | "into" => said(PAINTS_IT),
        // "Red and olive", and no olive beside a willow.
        "and" | "or" => before > 0 && longest(&lexemes[before - 1..before], PAINTS).is_some(),
        // "Plant the bed in lavender", "there should be lavender".
        lead if LEADS.contains(&lead) => !is_plant || said(PAINTS_IT) && !said(&["there", "here"]),
        _ => said(PAINTS_IT) && ends_noun(lexemes, at),
    };
    is_led.then_some(colour)
}

/// Whether a noun of a class ends before a word: "the van", "the street lamp".
fn ends_noun(lexemes: &[Lexeme], at: usize) -> bool {
    (at.saturating_sub(3)..at)
        .any(|from| category(&lexemes[from..at]).is_some_and(|(_, words)| from + words == at))
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::rewritten;
    use super::in_plain_words;

    fn plain(said: &str) -> String {
        rewritten(said, |lexemes| in_plain_words(said, lexemes))
    }

    #[test]
    fn shades_are_their_colours() {
        for (said, meant) in [
            ("the mailbox canary yellow", "the mailbox yellow"),
            ("paint it duck egg blue", "paint it blue"),
            ("paint the van black , make that olive", "paint the van black , make that green"),
            ("paint the van olive", "paint the van green"),
            ("the car should be khaki and the bin red", "the car should be green and the bin red"),
            ("a bench in charcoal , please", "a bench in grey , please"),
        ] {
            assert_eq!(plain(said), meant, "{said}");
        }
    }

    #[test]
    fn what_bears_the_name_of_a_shade_is_none() {
        for said in [
            "plant an olive",
            "plant an olive tree by the bench",
            "paint that lime",
            "paint the tallest lime blue",
            "remove the olive and the lime",
            "plant a willow and olive",
            "put an ice cream van here",
            "call the dog olive",
            "plant the bed in lavender",
            "there should be lavender",
        ] {
            assert_eq!(plain(said), said, "{said}");
        }
    }
}
