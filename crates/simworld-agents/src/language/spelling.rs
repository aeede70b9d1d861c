//! Misspelt words: each is put right if one known word, and one only, is near enough.

use super::lexer::{Lexeme, Token};
use super::lexicon::{CATEGORIES, COPULAS, DETERMINERS, FARTHEST, MOSTS, NEAREST, RELATIONS, SIDES};
use super::paint::PAINTS;
use super::verbs::{FILLERS, JOINTS, VERBS, base_form};

/// Words that people mean though a known word is near: none of them is a misspelling.
const OTHER_WORDS: &[&str] = &[
    "beach", "bunch", "beech", "hair", "hairs", "choir", "chain", "stair", "stairs", "fair", "cable", "fable", "floor", "poor",
    "fog", "log", "dot", "hog", "free", "flee", "freeze", "lamb", "camp", "damp", "ramp", "lap", "sing", "sigh", "site",
    "size", "stone", "store", "score", "shore", "story", "stove", "ship", "shoe", "shot", "chop", "show", "bug", "bun",
    "but", "trunk", "track", "trick", "cave", "save", "gave", "have", "wall", "want", "burn", "torn", "cake", "lake",
    "make", "tale", "tape", "crop", "prop", "sir", "six", "set", "fit", "hit", "pit", "sand", "strand", "oven", "hide",
    "side", "wide", "rude", "ripe", "sun", "fun", "gun", "rum", "live", "five", "hive", "paint", "joint", "pint", "book",
    "cook", "hook", "took", "lock", "loop", "hollow", "fellow", "horse", "mouse", "dome", "hole", "hope", "stool", "pool",
    "tool", "officer", "status", "prison", "hill", "mill", "pill", "bell", "lift", "loft", "felt", "let", "light", "night",
    "fight", "sight", "tight", "bright", "eight", "pack", "rack", "sack", "bark", "greed", "greet", "queen", "screen",
    "bed", "rod", "rid", "clue", "glue", "while", "write", "block", "slack", "blank", "fist", "cast", "fast", "past",
    "list", "lost", "neat", "nest", "text", "dear", "fear", "gear", "hear", "year", "bear", "care", "cart", "card", "cat",
    "cap", "bat", "bar", "boat", "goat", "coat", "bank", "park", "barn", "tower", "town", "river", "moon", "hotel", "pub",
    "pier", "peer", "port", "hat", "man", "men", "map", "cone", "bone", "phone", "zone", "cane", "sand", "band", "hand",
    "land", "wind", "wine", "line", "lane", "pine", "mine", "tent", "rent", "best", "rest", "test", "west", "east", "vest",
    "note", "vote", "bike", "like", "hike", "kite", "bite", "bath", "path", "math", "swim", "skip", "slip", "clip", "flip",
    "climb", "fly", "try", "cry", "dry", "eat", "beat", "heat", "meat", "seal", "meal", "deal", "sell", "tell", "well",
    "roof", "room", "root", "foot", "food", "wood", "good", "fold", "gold", "hold", "cold", "sold", "told", "sink", "pink",
    "link", "drink", "think", "thing", "things", "king", "ring", "wing", "spring", "string", "trip", "strip", "steps", "stage",
    "star", "start", "stare", "state", "stay", "spot", "pot", "pots", "hot", "dig", "pig", "pigs", "big", "bag", "flag",
    "lawn", "law", "saw", "jaw", "raw", "draw", "throw", "throne", "drone", "crane", "brane", "train", "rain", "brain",
    "drain", "grain", "plain", "plane", "plate", "place", "lace", "face", "race", "pace", "space", "grace", "trace", "brick",
    "window", "widow", "ticket", "market", "basket", "pocket", "rocket", "jacket", "locker", "lover", "cover", "over", "never",
    "ever", "fever", "lever", "liver", "diver", "driver", "drive", "dive", "drove", "dove", "love", "glove", "move", "mover",
    "bin", "tin", "fin", "pin", "win", "kin", "skin", "thin", "sin", "son", "ton", "won", "ten", "pen", "den", "hen", "tree",
    "three", "there", "here", "where", "were", "these", "those", "them", "then", "than", "that", "this", "they", "their",
    "hear", "heart", "earth", "north", "south", "mouth", "moth", "both", "bath", "tomorrow", "today", "yesterday", "which",
    "what", "who", "how", "why", "when", "was", "is", "are", "be", "been", "being", "did", "does", "done", "had", "has",
    "juggle", "smile", "mile", "file", "pile", "tile", "while", "whale", "sale", "male", "pale", "table", "talk", "chalk",
];

/// Puts the words of a sentence right that are unknown and near one known word; `names` are the words of names and goods.
pub(super) fn correct(lexemes: &mut [Lexeme], names: &dyn Fn() -> Vec<String>) {
    let mut known: Option<Vec<String>> = None;
    for lexeme in lexemes {
        let Token::Word(word) = &lexeme.token else { continue };
        if word.chars().count() < 3 || is_known(word) {
            continue;
        }
        let names = known.get_or_insert_with(names);
        if names.contains(word) {
            continue;
        }
        if let Some(right) = nearest(word, names) {
            lexeme.lemma = base_form(&right);
            lexeme.token = Token::Word(right);
        }
    }
}

/// Words of conditions and quantities, which stand in no table of their own.
const MORE_WORDS: &[&str] = &[
    "until", "unless", "otherwise", "else", "when", "whenever", "once", "twice", "times", "keep", "repeat", "degrees", "metres",
    "meters", "metre", "meter", "seconds", "second", "minutes", "minute", "hours", "hour", "forward", "forwards", "backward",
    "backwards", "around", "between", "before", "after", "while", "if", "see", "spot", "notice", "raining", "snowing", "green",
    "taken", "occupied", "empty", "free", "closed", "holding", "arrives", "reach", "him", "her", "them", "it", "there",
    "here", "hello", "both", "all", "every", "each", "first", "third", "fourth", "fifth", "last", "parked", "other", "one",
    "ones", "left", "right", "back", "steps", "step", "half", "towards", "toward", "into", "onto", "with", "for", "from",
    "slowly", "quickly", "yourself", "speed", "hand", "position", "point", "coordinates", "traffic", "whatever", "straight",
    "bit", "moment", "moments", "little", "short",
    "few", "sec", "secs", "mins", "briefly", "some", "time", "forth", "fro", "dozen", "hundred", "couple", "stops", "starts", "rains",
    "rain", "snows", "snow", "night", "day", "sunset", "dark", "sees", "seen", "visible", "sight", "view", "appears", "comes", "opens",
    "closes", "passed", "past", "minus", "negative", "radians", "rad", "deg", "hour", "have", "has", "had", "been", "being", "does",
    "anything", "something", "nothing", "everything", "hands", "empty", "near", "crossing", "amber", "shows", "turns", "changes",
    "goes", "becomes", "kmh", "mps", "per", "aside", "clockwise", "anticlockwise", "pace", "paces", "along", "past", "through",
    "photos", "pictures", "shots", "bottle", "bottles", "cup", "cups", "piece", "slice", "bowl", "glass", "portion", "copy", "loaf",
    "two", "three", "four", "five", "six", "seven", "eight", "nine", "ten", "twenty", "thirty", "forty", "the", "and", "you",
];

fn phrases() -> impl Iterator<Item = &'static str> {
    let classes = CATEGORIES.iter().flat_map(|category| category.words);
    let verbs = VERBS.iter().flat_map(|(words, _)| *words);
    let relations = RELATIONS.iter().flat_map(|(words, _)| *words);
    let sides = SIDES.iter().flat_map(|(words, _)| *words);
    let paints = PAINTS.iter().flat_map(|(words, _)| *words);
    let mosts = MOSTS.iter().flat_map(|(words, _)| *words);
    let lists = [FILLERS, JOINTS, COPULAS, DETERMINERS, NEAREST, FARTHEST, MORE_WORDS];
    let rest = lists.into_iter().flatten();
    classes.chain(verbs).chain(relations).chain(sides).chain(paints).chain(mosts).chain(rest).copied()
}

/// Every single word that the grammar knows, in alphabetical order.
fn vocabulary() -> &'static [&'static str] {
    static WORDS: std::sync::OnceLock<Vec<&'static str>> = std::sync::OnceLock::new();
    WORDS.get_or_init(|| {
        let mut words: Vec<&str> = phrases().flat_map(|phrase| phrase.split(' ')).chain(OTHER_WORDS.iter().copied()).collect();
        words.sort_unstable();
        words.dedup();
        words
    })
}

fn is_known(word: &str) -> bool {
    let listed = |word: &str| vocabulary().binary_search(&word).is_ok();
    listed(word)
        || word.strip_suffix('s').is_some_and(listed)
        || word.strip_suffix("es").is_some_and(listed)
        || word.strip_suffix("ies").is_some_and(|stem| listed(&format!("{stem}y")))
        || base_form(word).is_some()
}

/// How one spelling comes from another, the likeliest slip first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Slip {
    /// Letters out of order.
    Swapped,
    /// A letter too many or too few.
    Count,
    /// Another letter: it may be another word.
    Letter,
}

/// The known word nearest to one that is not: at most one edit, or two in seven letters. Of several as near the
/// likelier slip is taken, then what the grammar knows; if that leaves two, or a word of no meaning here, none is.
fn nearest(word: &str, names: &[String]) -> Option<String> {
    let length = word.chars().count();
    let tolerance = if length < 7 { 1 } else { 2 };
    let mut best: Vec<&str> = Vec::new();
    let mut least = (usize::MAX, Slip::Letter, true);
    for candidate in vocabulary().iter().copied().chain(names.iter().map(String::as_str)) {
        if candidate.len().abs_diff(word.len()) > tolerance || candidate.len() < 3 || !alike(word, candidate) {
            continue;
        }
        let distance = strsim::osa_distance(word, candidate);
        let slip = match candidate.chars().count() == length {
            true if is_anagram(word, candidate) => Slip::Swapped,
            true => Slip::Letter,
            false => Slip::Count,
        };
        if distance > tolerance || length == 3 && slip == Slip::Letter {
            continue;
        }
        let rank = (distance, slip, OTHER_WORDS.contains(&candidate));
        if rank < least {
            least = rank;
            best.clear();
        }
        if rank == least && !best.contains(&candidate) {
            best.push(candidate);
        }
    }
    match best[..] {
        [one] if !least.2 => Some(one.to_owned()),
        _ => None,
    }
}

/// Slips keep the first letter, or swap it with the second.
fn alike(word: &str, candidate: &str) -> bool {
    let (mut a, mut b) = (word.chars(), candidate.chars());
    let (a0, b0, a1, b1) = (a.next(), b.next(), a.next(), b.next());
    a0 == b0 || (a0 == b1 && a1 == b0)
}

fn is_anagram(a: &str, b: &str) -> bool {
    let sorted = |text: &str| {
        let mut letters: Vec<char> = text.chars().collect();
        letters.sort_unstable();
        letters
    };
    sorted(a) == sorted(b)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_are_put_right_and_other_words_left_alone() {
        let none: Vec<String> = Vec::new();
        for (slip, right) in [("musem", "museum"), ("chiar", "chair"), ("pikc", "pick"), ("nearst", "nearest"), ("teh", "the")]
        {
            assert_eq!(nearest(slip, &none).as_deref(), Some(right), "{slip}");
        }
        for word in ["beach", "peer", "boat", "horse", "floor"] {
            assert!(is_known(word), "{word} is a word of its own");
        }
    }
}
