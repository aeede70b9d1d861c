//! What was not understood, told once more in plainer words: "can we have pictures of both cars?" asks to take them, who goes "across the
//! yard to the house" goes to the house, and "so that the children see it" says what for.
//!
//! None of this is looked at where a sentence is understood as it stands.

use super::lexer::{Lexeme, Token, is_mark, word_of};
use super::lexicon::{DETERMINERS, FARTHEST, MOSTS, NEAREST, category, longest, longest_phrase};
use super::names::Names;
use super::phrases::Phrases;
use super::verbs::{base_form, longest_verb};

/// What is said for more words, or for none.
#[rustfmt::skip]
const PLAINER: &[(&str, &str)] = &[
    ("can we have pictures of", "take pictures of"), ("can i have pictures of", "take pictures of"), ("could we have pictures of", "take pictures of"),
    ("could i have pictures of", "take pictures of"), ("can we get pictures of", "take pictures of"), ("can i get pictures of", "take pictures of"),
    ("can we have photos of", "take photos of"), ("can i have photos of", "take photos of"), ("could we have photos of", "take photos of"),
    ("could i have photos of", "take photos of"), ("can we get photos of", "take photos of"), ("could we get photos of", "take photos of"),
    ("can we have a picture of", "take a picture of"), ("can i have a picture of", "take a picture of"), ("could i have a picture of", "take a picture of"),
    ("can i get a picture of", "take a picture of"), ("could i get a picture of", "take a picture of"), ("can we get a picture of", "take a picture of"),
    ("can i have a photo of", "take a photo of"), ("could i have a photo of", "take a photo of"), ("can we have a photo of", "take a photo of"),
    ("can i get a photo of", "take a photo of"), ("could we have a photo of", "take a photo of"), ("could we have a picture of", "take a picture of"),
    ("a point right between", "between"), ("a spot right between", "between"), ("a point exactly between", "between"), ("a spot exactly between", "between"),
    ("stop at a point between", "go between"), ("stop at a spot between", "go between"), ("stop right between", "go between"), ("stop exactly between", "go between"),
    ("stop between", "go between"), ("stop halfway between", "go halfway between"), ("stop midway between", "go halfway between"),
    ("run the route from", "run from"), ("walk the route from", "walk from"), ("walk the stretch from", "walk from"), ("run the stretch from", "run from"),
    ("do the route from", "walk from"), ("walk the way from", "walk from"), ("run the course from", "run from"), ("walk the path from", "walk from"),
    ("in both arms", ""), ("with both arms", ""), ("in your arms", ""), ("with both hands", ""), ("with two hands", ""), ("in two hands", ""),
    ("call at", "visit"), ("call in at", "visit"), ("look in at", "visit"), ("drop in at", "visit"),
    ("in the whole place", ""), ("in the whole town", ""), ("in the whole area", ""), ("in this whole place", ""), ("in the entire place", ""),
    ("of the whole place", ""), ("of the whole lot", ""), ("anywhere around here", ""), ("in the whole world", ""),
    ("is not just", "is not , just"), ("are not just", "are not , just"), ("does not just", "does not , just"), ("isnt just", "is not , just"),
    ("doesnt just", "does not , just"), ("arent just", "are not , just"), ("is not then", "is not , then"), ("isnt then", "is not , then"),
    ("so youre facing the other way", ""), ("so you face the other way", ""), ("so that you face the other way", ""), ("so you are facing the other way", ""),
    ("so that youre facing the other way", ""), ("so that you are facing the other way", ""), ("so you look the other way", ""),
    ("each time", ""), ("every time", ""), ("walk up to that", "walk up to it"), ("go up to that", "go up to it"), ("all three of the", "all three"),
    ("all four of the", "all four"), ("would that do", ""), ("will that do", ""), ("would that work", ""), ("does that work", ""), ("is that alright", ""),
    ("is that all right", ""), ("is that ok", ""), ("is that okay", ""), ("how about that", ""), ("what about that", ""), ("how would that be", ""),
    ("at the very end", "finally"), ("so easily", ""), ("so often", ""), ("so slowly", ""), ("so much", ""),
    ("only halfway", "halfway"), ("only half way", "halfway"), ("over and over until", "until"), ("again and again until", "until"), ("over and over again until", "until"),
    ("in order of distance", ""), ("in order of their distance", ""), ("in the order of distance", ""), ("by distance", ""),
    ("climb onto", "get on"), ("climb on to", "get on"), ("climb up on", "get on"),
];
/// Ground over which a way leads that ends elsewhere.
const GROUNDS: &[&str] = &[
    "yard",
    "courtyard",
    "forecourt",
    "grass",
    "lawn",
    "meadow",
    "field",
    "green",
    "sand",
    "gravel",
    "tarmac",
    "plaza",
    "lot",
    "pavement",
    "cobbles",
    "snow",
    "mud",
    "road",
    "street",
    "square",
    "shore",
    "beach",
    "quay",
    "waterfront",
    "promenade",
    "boardwalk",
    "riverside",
    "bank",
    "path",
    "sidewalk",
];
/// What a whole scene may be called, where nothing in it is called so.
#[rustfmt::skip]
const PLACES: &[&str] = &[
    "park", "town", "city", "village", "market", "zoo", "campus", "harbour", "airport", "beach", "campsite", "depot", "fairground", "farm", "station", "area", "place",
    "neighbourhood", "district", "world", "yard", "grounds", "vicinity", "resort", "quarter", "square",
];
/// Who is to see something, and what for nobody is told to do.
#[rustfmt::skip]
const SO_THAT: &Phrases = &Phrases::of(&[
    "so that the", "so that my", "so that our", "so that his", "so that her", "so that they", "so that he", "so that she", "so that everyone", "so that everybody", "so that people",
    "so that i", "so that we", "so the", "so my", "so our", "so they", "so everyone", "so everybody", "so people", "so he", "so she", "so we", "so i",
]);
/// What they do then.
#[rustfmt::skip]
const THEN_THEY: &[&str] = &[
    "see", "sees", "know", "knows", "hear", "hears", "notice", "notices", "find", "finds", "remember", "remembers", "laugh", "learn", "believe", "enjoy", "relax", "understand",
];
/// What was done to a thing by whoever is named before.
const DID_IT: &Phrases = &Phrases::of(&[
    "left it",
    "lost it",
    "forgot it",
    "dropped it",
    "wants it",
    "needs it",
    "misses it",
    "asked for it",
    "left it there",
    "left it behind",
    "left them",
    "lost them",
    "forgot them",
    "dropped them",
    "wants them",
    "needs them",
    "is looking for it",
    "was looking for it",
]);

/// The same in plainer words; none if there are none.
pub(super) fn retold(said: &[Lexeme], names: &Names<'_>) -> Option<Vec<Lexeme>> {
    let mut lexemes = said.to_vec();
    put_plainer(&mut lexemes);
    without_a_call(&mut lexemes);
    without_occasion(&mut lexemes, names);
    across_to(&mut lexemes, names);
    within_the_whole(&mut lexemes, names);
    so_that_they_see(&mut lexemes);
    without_last_remark(&mut lexemes);
    all_of_them(&mut lexemes);
    one_of_those(&mut lexemes);
    (lexemes != said).then_some(lexemes)
}

fn put(lexemes: &mut Vec<Lexeme>, from: usize, to: usize, words: &str) {
    let Some(lexeme) = lexemes.get(from).cloned() else { return };
    let new = words.split_whitespace().map(|word| match word {
        "," => Lexeme { token: Token::Comma, lemma: None, ..lexeme.clone() },
        word => Lexeme { token: Token::Word(word.to_owned()), lemma: base_form(word), ..lexeme.clone() },
    });
    lexemes.splice(from..to, new.collect::<Vec<_>>());
}

fn put_plainer(lexemes: &mut Vec<Lexeme>) {
    let mut at = 0;
    while at < lexemes.len() {
        if let Some((plain, words)) =
            PLAINER.iter().find_map(|(said, plain)| Some((*plain, longest_phrase(&lexemes[at..], &[*said])?)))
        {
            put(lexemes, at, at + words, plain);
        }
        at += 1;
    }
}

/// "Oh look, Samira's there!": nobody is told to look at anything.
fn without_a_call(lexemes: &mut Vec<Lexeme>) {
    let calls = ["oh look", "look", "ah look", "hey look", "oh listen", "oh see", "see"];
    if let Some(words) = longest_phrase(lexemes, &calls)
        && lexemes.get(words).is_some_and(is_mark)
    {
        lexemes.drain(..=words);
    }
}

/// "For the calendar, photograph ...": what something is for stands before the order and names nothing that is here.
fn without_occasion(lexemes: &mut Vec<Lexeme>, names: &Names<'_>) {
    const LONGEST: usize = 6;
    let Some(mark) = lexemes.iter().position(is_mark).filter(|mark| (3..=LONGEST).contains(mark)) else {
        return;
    };
    let what = &lexemes[1..mark];
    let determined = longest_phrase(what, DETERMINERS).is_some();
    let something = |at: usize| {
        names.exact(&what[at..]).is_some()
            || category(&what[at..]).is_some_and(|(_, words)| at + words == what.len())
    };
    if word_of(&lexemes[0]) == "for" && determined && !(0..what.len()).any(something) {
        lexemes.drain(..=mark);
    }
}

/// "Across the yard to the house": where the way ends is told.
fn across_to(lexemes: &mut Vec<Lexeme>, names: &Names<'_>) {
    let mut at = 1;
    while at + 3 < lexemes.len() {
        let across = longest_phrase(
            &lexemes[at..],
            &[
                "across the",
                "over the",
                "through the",
                "right across the",
                "straight across the",
                "along the",
                "all along the",
            ],
        );
        if let Some(words) = across
            && let Some(ground) = lexemes.get(at + words).filter(|ground| GROUNDS.contains(&word_of(ground)))
            && names.exact(std::slice::from_ref(ground)).is_none()
            && longest_phrase(&lexemes[at + words + 1..], &["to", "over to", "towards", "into"]).is_some()
        {
            lexemes.drain(at..=at + words);
            if word_of(&lexemes[at - 1]) == "cut" {
                put(lexemes, at - 1, at, "go");
            }
        }
        at += 1;
    }
}

/// "The shortest tree in the park", where nothing is called a park: of all that are here.
fn within_the_whole(lexemes: &mut Vec<Lexeme>, names: &Names<'_>) {
    let most = |at: usize| {
        let rest = &lexemes[at..];
        longest(rest, MOSTS).is_some()
            || longest_phrase(rest, NEAREST).is_some()
            || longest_phrase(rest, FARTHEST).is_some()
    };
    let Some(first) = (0..lexemes.len()).find(|at| most(*at)) else { return };
    let mut at = first + 2;
    while at + 2 < lexemes.len() {
        let within = longest_phrase(
            &lexemes[at..],
            &["in the", "in this", "of the", "in our", "on the", "on this", "in the whole", "in this whole"],
        );
        if let Some(words) = within
            && let Some(place) = lexemes.get(at + words).filter(|place| PLACES.contains(&word_of(place)))
            && names.exact(std::slice::from_ref(place)).is_none()
            && lexemes
                .get(at + words + 1)
                .is_none_or(|next| is_mark(next) || ["and", "then"].contains(&word_of(next)))
        {
            lexemes.drain(at..=at + words);
        } else {
            at += 1;
        }
    }
}

/// "Point at it so that the children see it": why.
fn so_that_they_see(lexemes: &mut Vec<Lexeme>) {
    let mut at = 2;
    while at + 2 < lexemes.len() {
        if longest_phrase(&lexemes[at..], SO_THAT).is_some() && !is_mark(&lexemes[at - 1]) {
            let end = lexemes[at..].iter().position(is_mark).map_or(lexemes.len(), |mark| at + mark);
            if lexemes[at..end].iter().any(|lexeme| THEN_THEY.contains(&word_of(lexeme))) {
                lexemes.drain(at..end);
            }
        }
        at += 1;
    }
}

/// "..., Ruth left it", "..., the other one's too bright": behind an order.
fn without_last_remark(lexemes: &mut Vec<Lexeme>) {
    let end = lexemes.iter().rposition(|lexeme| !is_mark(lexeme)).map_or(0, |last| last + 1);
    let Some(mark) = lexemes[..end].iter().rposition(is_mark).filter(|mark| *mark > 1) else { return };
    let said = &lexemes[mark + 1..end];
    let of_the_other = longest_phrase(
        said,
        &[
            "the other one is",
            "the other is",
            "the others are",
            "the other ones are",
            "the other ones",
            "the others",
        ],
    );
    let did = said.len() > 2
        && longest_verb(said).is_none()
        && (1..=2).any(|at| {
            said.get(at..)
                .and_then(|rest| longest_phrase(rest, DID_IT))
                .is_some_and(|words| at + words == said.len())
        });
    let idle = of_the_other.is_some_and(|words| words < said.len())
        && !(0..said.len()).any(|at| longest_verb(&said[at..]).is_some());
    if did || idle {
        lexemes.truncate(mark);
    }
}

/// "Grandma loves cars, so photograph all three of them": those of which one was told.
fn all_of_them(lexemes: &mut Vec<Lexeme>) {
    const LIKES: &[&str] = &[
        "loves", "likes", "adores", "collects", "paints", "draws", "love", "like", "adore", "collect",
        "paint", "draw",
    ];
    let Some(mark) = lexemes.iter().position(|lexeme| is_mark(lexeme) || word_of(lexeme) == "so") else {
        return;
    };
    let [.., verb, noun] = &lexemes[..mark] else { return };
    let (told, noun) = (LIKES.contains(&word_of(verb)), noun.clone());
    if !told || category(std::slice::from_ref(&noun)).is_none() {
        return;
    }
    let Some(them) = (mark..lexemes.len()).find(|at| longest_phrase(&lexemes[*at..], &["of them"]).is_some())
    else {
        return;
    };
    lexemes.splice(them..them + 2, [noun]);
    let behind =
        lexemes[mark..].iter().take_while(|lexeme| is_mark(lexeme) || word_of(lexeme) == "so").count();
    lexemes.drain(..mark + behind);
}

/// "Of the lime trees, go to the one closest to Dmitri": one of those that were told first.
fn one_of_those(lexemes: &mut Vec<Lexeme>) {
    const MOST: usize = 5;
    let Some(first) = longest_phrase(lexemes, &["of the", "of all the", "out of the", "among the"]) else {
        return;
    };
    let Some(mark) =
        lexemes.iter().position(is_mark).filter(|mark| (first + 1..=first + MOST).contains(mark))
    else {
        return;
    };
    let Some(one) = super::in_turn::singular(word_of(&lexemes[mark - 1])) else { return };
    let mut noun = lexemes[first..mark].to_vec();
    if let Some(last) = noun.last_mut() {
        last.token = Token::Word(one);
    }
    if let Some(at) = (mark..lexemes.len()).find(|at| longest_phrase(&lexemes[*at..], &["the one"]).is_some())
    {
        lexemes.splice(at + 1..at + 2, noun);
        lexemes.drain(..=mark);
    }
}

#[cfg(test)]
mod tests {
    use super::super::lexer::rewritten;
    use super::*;

    #[test]
    fn what_was_not_understood_is_told_in_plainer_words() {
        let world = simworld_core::scene::World::new();
        let names = Names::new(&world, simworld_core::geometry::Point2::origin(), 100.0);
        for (said, plain) in [
            ("Can we have pictures of both cars?", "take pictures of both cars ,"),
            ("Oh look, Samira is there! Wave to her", "samira is there , wave to her"),
            ("For the calendar, photograph the oak", "photograph the oak"),
            ("Head across the yard to the Brook House", "head to the brook house"),
            ("the shortest tree in the park, please", "the shortest tree , please"),
            ("point at the mill so that the children see it!", "point at the mill ,"),
            ("take the basket, Ruth left it.", "take the basket"),
            ("go to the lamp by the sack, the other one is too bright", "go to the lamp by the sack"),
            ("Grandma loves cars, so photograph all three of them", "photograph all three cars"),
            ("of the lime trees, go to the one closest to Dmitri", "go to the lime tree closest to dmitri"),
            ("go to the bench in the park", "go to the bench in the park"),
            ("walk across the bridge to the mill", "walk across the bridge to the mill"),
        ] {
            let told = rewritten(said, |lexemes| {
                if let Some(plain) = retold(lexemes, &names) {
                    *lexemes = plain;
                }
            });
            assert_eq!(told, plain, "{said}");
        }
    }
}
