//! More turns of phrase by their kin: what looks smashing in a colour, who is let pause somewhere, what somebody would not say no to, the sun that is just
//! coming up, "just the one to begin with", and the only animal that is here.
//!
//! All but what is put plainly first is tried only where a sentence was refused in every other way, and counts only if what it comes to is granted.

use simworld_core::id::EntityId;

use super::super::lexer::{Lexeme, is_mark, word_of};
use super::super::lexicon::{category, is_animate, longest, longest_phrase};
use super::super::names::Names;
use super::super::numbers;
use super::super::paint::PAINTS;
use super::super::phrases::Phrases;
use super::forms::{is_same, word, word_at};
use super::kin_later_turns::{FIRST_WHOLE, PARTS, SUN, WHOLE};
use super::retold::{by_turn, last_mark, told_by};
use super::statements::{clauses, rest_of};
use super::unusual_first::points_back;
use super::words::{SKIES, VERBS};

/// By these nothing may be wanted.
const DENIES: &[&str] = &["dont", "doesnt", "didnt", "nobody", "noone", "doubt"];
/// Who speaks is no place, and has no colour.
const SPEAKERS: &[&str] = &["i", "we", "you"];
/// What "it" and the like look good in is not known here.
const PRONOUNS: &[&str] = &["it", "he", "she", "they", "that", "this", "i", "we", "you"];
/// Before what somebody thinks.
#[rustfmt::skip]
const OPINIONS: &Phrases = &Phrases::of(&["i reckon", "we reckon", "i think", "we think", "i bet", "i say", "we say", "i feel", "we feel", "i believe", "i guess", "i know", "i find", "i swear", "i reckon that", "we reckon that", "i think that", "we think that", "i bet that", "i feel that", "we feel that", "i believe that", "i find that", "i swear that", "if you ask me", "personally", "honestly"]);
#[rustfmt::skip]
const WOULD_LOOK: &Phrases = &Phrases::of(&["would look", "might look", "could look", "will look", "would be", "would seem", "d look", "would surely look", "would certainly look", "would definitely look", "would really look", "would just look"]);
/// How much better, and how good.
#[rustfmt::skip]
const DEGREES: &Phrases = &Phrases::of(&["miles", "tons", "loads", "heaps", "streets", "leagues", "lots", "oceans", "a lot", "a bit", "a tad", "a touch", "a whole lot", "a good deal", "a great deal", "a world", "worlds", "way", "far", "much", "so", "so much", "ten times", "a hundred times", "a thousand times", "a million times", "even", "ever so", "really", "very", "absolutely", "simply", "just", "truly", "utterly",
    "positively", "rather", "quite", "pretty", "bloody", "damn", "darn", "proper", "well", "dead", "right", "totally", "mighty", "jolly", "infinitely", "vastly", "considerably", "infinitely more", "far more", "much more", "way more", "so much more", "more", "downright"]);
#[rustfmt::skip]
const GOOD: &[&str] = &["good", "great", "better", "best", "nice", "nicer", "lovely", "lovelier", "smashing", "cracking", "stunning", "dashing", "ripping", "spiffing", "striking", "fetching", "charming", "amazing", "ravishing", "dazzling", "ace", "fab", "mint", "class", "sick", "brill", "brilliant", "wicked", "smart", "smarter", "cool", "cooler", "gorgeous", "fine", "finer", "sharp", "sharper",
    "sweet", "sweeter", "superb", "fantastic", "wonderful", "prettier", "pretty", "neat", "neater", "grand", "grander", "dandy", "splendid", "marvellous", "marvelous", "magnificent", "terrific", "tremendous", "fabulous", "glorious", "beautiful", "elegant", "divine", "perfect", "excellent", "delightful", "exquisite", "classy", "classier", "stylish", "tidy", "belting", "corking", "epic", "awesome",
    "incredible", "sublime", "lush", "bonny", "cheerful", "jolly", "cute", "cuter", "adorable", "attractive", "handsome"];
/// Before the colour.
#[rustfmt::skip]
const IN: &Phrases = &Phrases::of(&["in", "painted", "painted in", "done in", "dressed in", "decked out in", "if painted", "if it were", "if it was", "if it were painted", "if it was painted", "when painted", "when it is", "if it is", "were it", "wearing", "as", "in a nice", "in a bright", "in a deep"]);
/// Behind it.
const BEHIND: &Phrases = &Phrases::of(&["instead", "paint", "i think", "i reckon", "i bet", "anyway"]);
/// That there is to be one only, which is said where one is asked for.
#[rustfmt::skip]
const JUST_ONE: &Phrases = &Phrases::of(&["just the one", "just one", "only one", "only the one", "the one", "one only", "just a single one", "a single one", "one will do", "one is enough", "ones enough", "one is plenty", "one would do", "one should do", "just the one for now", "just one for now", "the one for now", "one for now",
    "just the one to begin with", "just one to begin with", "the one to begin with", "one to begin with", "just the one to start with", "just one to start with", "the one to start with", "one to start with", "just the one for starters", "just one for starters", "the one for starters", "one for starters", "just the one for a start", "just the one at first", "just one at first", "no more than one", "not more than one", "just the one please", "just one please"]);
/// Before the sun that is asked for.
#[rustfmt::skip]
const ASKS: &Phrases = &Phrases::of(&["let", "have", "lets have", "let us have", "let me have", "lets see", "let us see", "let me see", "lets get", "give me", "give us", "show me", "show us", "i want", "we want", "i need", "we need", "id like", "wed like", "i would like", "we would like", "id love", "wed love", "i want to see", "we want to see", "id like to see", "wed like to see", "i would like to see", "id love to see",
    "i want to have", "id like to have", "can we have", "could we have", "can i have", "could i have"]);
/// Who is to be pitied, and is no sort of somebody.
#[rustfmt::skip]
const POOR: &[&str] = &["fellow", "chap", "lad", "lass", "bloke", "soul", "thing", "dear", "creature", "sod", "devil", "love", "beast", "mite", "lamb", "darling", "blighter", "beggar"];
const ANIMALS: &[&str] = &["animal", "creature", "pet", "critter", "beast"];
/// Assets that are animals as well as dogs are.
#[rustfmt::skip]
const OTHER_ANIMALS: &[&str] = &["cat", "horse", "cow", "donkey", "camel", "sheep", "goat", "pig", "duck", "swan", "goose", "chicken", "hen", "rooster", "pigeon", "seagull", "gull", "rabbit", "fox", "deer", "pony", "bull", "lamb", "squirrel", "hedgehog", "parrot", "owl", "elephant", "lion", "tiger", "bear", "giraffe", "zebra", "monkey", "penguin", "seal", "turtle", "frog", "llama", "alpaca", "peacock", "hamster"];

/// Puts what would be read as something else plainly.
pub(super) fn in_plain_words(lexemes: &mut Vec<Lexeme>, names: &Names<'_>) {
    pitied(lexemes, names);
    let end = last_mark(lexemes);
    let told = FIRST_WHOLE.iter().find_map(|(said, meant)| by_turn(&lexemes[..end], said, meant));
    let Some(mut told) = told else { return };
    // "Rain, and a bit of fog over the harbour" is all of the sky.
    let put = told.iter().position(|lexeme| word_of(lexeme) == "put").unwrap_or(0);
    if !(put..told.len()).any(|at| longest(&told[at..], &SKIES).is_some()) {
        told.extend_from_slice(&lexemes[end..]);
        *lexemes = told;
    }
}

/// The words with "him" in the place of "the poor fellow".
pub(super) fn with_pronouns(said: &[Lexeme], names: &Names<'_>) -> Vec<Lexeme> {
    let mut told = said.to_vec();
    pitied(&mut told, names);
    told
}

/// What a sentence may have been meant to say, in plainer words; `is_open` where something was spoken of before it.
pub(super) fn ways(plain: &[Lexeme], names: &Names<'_>, is_open: bool) -> Vec<Vec<Lexeme>> {
    let mut said = without_just_one(plain);
    only_animal(&mut said, names);
    let mut ways = Vec::new();
    if let Some(told) = turned(&said) {
        let speaks = told.iter().any(|lexeme| SPEAKERS.contains(&word_of(lexeme)));
        if !(speaks || is_open && points_back(&told)) {
            ways.push(told);
        }
    }
    if !is_same(&said, plain) {
        ways.push(said);
    }
    ways
}

/// The words by the first turn that they are; none if they are none.
fn turned(said: &[Lexeme]) -> Option<Vec<Lexeme>> {
    if said.iter().any(|lexeme| DENIES.contains(&word_of(lexeme))) {
        return None;
    }
    let end = last_mark(said);
    let words = &said[..end];
    let whole = || WHOLE.iter().find_map(|(turn, meant)| by_turn(words, turn, meant));
    if let Some(mut told) = looks_good(words).or_else(|| sun(words)).or_else(whole) {
        told.extend_from_slice(&said[end..]);
        return Some(told);
    }
    let told = told_by(said, &[PARTS]);
    (!is_same(&told, said)).then_some(told)
}

/// "The red scooter would look miles better in white": it is to be painted so.
fn looks_good(words: &[Lexeme]) -> Option<Vec<Lexeme>> {
    let from = longest_phrase(words, OPINIONS).unwrap_or(0);
    let from = from + usize::from(words.get(from).is_some_and(is_mark));
    let (would, count) =
        (from + 1..words.len()).find_map(|at| Some((at, longest_phrase(&words[at..], WOULD_LOOK)?)))?;
    let subject = &words[from..would];
    let is_pronoun = subject.len() == 1 && PRONOUNS.contains(&word(subject, 0));
    if is_pronoun || subject.iter().any(is_mark) || longest(subject, &VERBS).is_some() {
        return None;
    }
    let mut at = would + count;
    while let Some(degree) = longest_phrase(words.get(at..)?, DEGREES) {
        at += degree;
    }
    // "Pretty" and "jolly" are degrees, and are said of what looks so as well.
    let is_good = GOOD.contains(&word(words, at));
    let good = if is_good { at + 1 } else { at };
    if !is_good && !GOOD.contains(&word(words, at - 1)) {
        return None;
    }
    let paint = good + longest_phrase(words.get(good..)?, IN)?;
    let (_, length) = longest(words.get(paint..)?, PAINTS)?;
    let end = paint + length;
    let behind = longest_phrase(&words[end..], BEHIND).unwrap_or(0);
    (end + behind == words.len()).then(|| {
        let mut told = vec![word_at(&words[0], "paint")];
        told.extend_from_slice(subject);
        told.extend_from_slice(&words[paint..end]);
        told
    })
}

/// "Let's have the sun just coming up": dawn.
fn sun(words: &[Lexeme]) -> Option<Vec<Lexeme>> {
    let asked = words.get(longest_phrase(words, ASKS)?..)?;
    SUN.iter().find_map(|(said, meant)| by_turn(asked, said, meant))
}

/// "A solar panel on the roof, just the one to begin with": one, where no more are asked for.
fn without_just_one(lexemes: &[Lexeme]) -> Vec<Lexeme> {
    let out: Vec<_> = clauses(lexemes)
        .into_iter()
        .filter(|clause| clause.from > 0)
        .filter(|clause| {
            let said = &lexemes[clause.from..clause.end];
            longest_phrase(said, JUST_ONE) == Some(said.len())
        })
        .collect();
    let rest = rest_of(lexemes, &out);
    let is_several = (0..rest.len()).any(|at| numbers::count(&rest[at..]).is_some());
    let is_one = rest.iter().any(|lexeme| matches!(word_of(lexeme), "a" | "an" | "one"));
    if out.is_empty() || is_several || !is_one { lexemes.to_vec() } else { rest }
}

/// "The animal": the dog, where nothing else is here that is one.
fn only_animal(lexemes: &mut [Lexeme], names: &Names<'_>) {
    let is_here = |name: &&str| {
        let found = names.scene.assets().and_then(|catalogue| catalogue.find(name));
        found.is_some_and(|id| names.scene.classes().is_some_and(|classes| classes.count_of(id) > 0))
    };
    let found = (1..lexemes.len()).find(|at| {
        matches!(word(lexemes, at - 1), "the" | "that" | "this") && ANIMALS.contains(&word(lexemes, *at))
    });
    if let Some(at) = found.filter(|_| !OTHER_ANIMALS.iter().any(is_here)) {
        lexemes[at] = word_at(&lexemes[at], "dog");
    }
}

/// "Dmitri looks knackered, get the poor fellow an armchair": get him one, where nobody and nothing else is named before.
fn pitied(lexemes: &mut Vec<Lexeme>, names: &Names<'_>) {
    let found = (2..lexemes.len()).find_map(|at| {
        let old = at + 2 + usize::from(matches!(word(lexemes, at + 2), "old" | "little"));
        let is_poor = word(lexemes, at) == "the"
            && word(lexemes, at + 1) == "poor"
            && POOR.contains(&word(lexemes, old))
            && lexemes.get(old + 1).is_some_and(|next| !is_mark(next));
        is_poor.then_some((at, old + 1))
    });
    let Some((at, end)) = found else { return };
    let before = &lexemes[..at];
    let mut bodies: Vec<EntityId> = Vec::new();
    let mut from = 0;
    while from < before.len() {
        let Some((ids, count)) = names.exact(&before[from..]) else {
            if category(&before[from..]).is_some() {
                return;
            }
            from += 1;
            continue;
        };
        bodies.extend(ids);
        from += count.max(1);
    }
    bodies.dedup();
    let is_body = |id: &EntityId| names.scene.entity(*id).is_some_and(|entity| is_animate(entity.kind));
    if matches!(&bodies[..], [only] if is_body(only)) {
        let whom = word_at(&lexemes[at], if word(lexemes, end - 1) == "lass" { "her" } else { "him" });
        lexemes.splice(at..end, [whom]);
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::rewritten;
    use super::*;

    fn plain(said: &str) -> String {
        rewritten(said, |lexemes| {
            let said = without_just_one(lexemes);
            *lexemes = turned(&said).unwrap_or(said);
        })
    }

    #[test]
    fn turns_are_told_plainly() {
        for (said, meant) in [
            ("i reckon the red scooter would look miles better in white", "paint the red scooter white"),
            ("the red bench would look smashing in purple", "paint the red bench purple"),
            ("the taxi would look ever so pretty in pink", "paint the taxi pink"),
            ("have a jogger pause near the cone", "put a jogger near the cone"),
            (
                "a trio of tourists should gather around the traffic light",
                "put a trio of tourists around the traffic light",
            ),
            ("lets have the sun just coming up, you know, dawn", "make it dawn"),
            ("i want the sun going down", "make it dusk"),
            ("bruno wouldnt say no to a doghouse at his side", "put a doghouse next to bruno"),
            ("ada is needing a large dog who sits by her", "put a large dog by ada"),
            (
                "make it rain and give gus an umbrella i mean, put one right beside him",
                "make it rain and put an umbrella beside gus",
            ),
            (
                "me, i like it more when the taxi has the colour green. you change it, please",
                "paint the taxi green",
            ),
            (
                "it would be very kind if one garbage truck come and stay near the hydrant",
                "put one garbage truck near the hydrant",
            ),
            ("a student wants shade, so let one stand near the lime", "put a student near the lime"),
            ("a student wants a chair, so let one stand near the lime", "put a chair near the lime"),
            (
                "id like a solar panel on the roof, just the one to begin with",
                "id like a solar panel on the roof",
            ),
        ] {
            assert_eq!(plain(said), meant, "{said}");
        }
    }

    #[test]
    fn what_says_something_else_stays() {
        for said in [
            "the red bench would look awful in purple",
            "it would look smashing in purple",
            "the red bench would look smashing near the oak",
            "i dont think the red bench would look smashing in purple",
            "have a bus stop near the cone",
            "bruno would refuse a doghouse at his side",
            "i like it more when the taxi is green",
            "it would be bad if a dog came and sat near anna",
            "put two benches here , just the one to begin with",
            "i love the sun coming up",
        ] {
            assert_eq!(plain(said), said);
        }
    }
}
