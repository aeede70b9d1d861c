//! Several of a sort, and then in which turn: "point at both canoes, red first, yellow second", "the two cars, the red one first".

use super::lexer::{Lexeme, Token, is_mark, word_of};
use super::lexicon::longest;
use super::paint::PAINTS;
use super::verbs::base_form;

/// How many there are, before what they are.
const COUNTS: &[(&[&str], usize)] = &[
    (&["both", "both the", "both of the", "two", "the two", "each of the two", "both those"], 2),
    (&["three", "the three", "all three", "all three of the", "all three the", "each of the three"], 3),
    (&["four", "the four", "all four", "all four of the", "all four the", "each of the four"], 4),
];
/// What else stands in such a list.
#[rustfmt::skip]
const JOINTS: &[&str] = &[
    "the", "one", "and", "then", "before", "first", "second", "third", "fourth", "next", "last", "lastly", "finally", "start", "starting", "begin", "beginning", "with",
];
/// Before or behind the only one that is told, who comes first.
const FIRST: &[&str] = &["first", "start", "starting", "begin", "beginning"];

/// Puts each of them in its turn in the place of all and the list behind.
pub(super) fn told_one_by_one(lexemes: &mut Vec<Lexeme>) {
    if !lexemes.iter().rev().skip(1).any(is_mark) {
        return; // as most sentences
    }
    let found = (0..lexemes.len()).find_map(|at| Some((at, turns_at(&lexemes[at..])?)));
    let Some((at, (words, end))) = found else { return };
    let lexeme = lexemes[at].clone();
    let told = words.into_iter().map(|word| Lexeme {
        lemma: base_form(&word),
        token: Token::Word(word),
        ..lexeme.clone()
    });
    lexemes.splice(at..at + end, told.collect::<Vec<_>>());
}

/// The same in plain words, and how many lexemes they stand for; none if no such list begins here.
fn turns_at(lexemes: &[Lexeme]) -> Option<(Vec<String>, usize)> {
    let (count, words) = longest(lexemes, COUNTS)?;
    let comma = lexemes.iter().position(is_mark)?;
    let nouns = lexemes.get(words..comma).filter(|nouns| (1..=2).contains(&nouns.len()))?;
    let noun = nouns.iter().map(word_of).collect::<Vec<_>>();
    let (last, before) = noun.split_last()?;
    let one = [before.iter().map(|word| (*word).to_owned()).collect(), vec![singular(last)?]].concat();
    // "Both barrels: blue, then red", "both cars. Start with the red one".
    let ends = |lexeme: &Lexeme| lexeme.token == Token::Break;
    let end = lexemes[comma + 1..].iter().position(ends).map_or(lexemes.len(), |end| comma + 1 + end);
    let (paints, comes_first) = paints_of(&lexemes[comma + 1..end])?;
    let the = |paint: &str| [vec!["the".to_owned(), paint.to_owned()], one.clone()].concat();
    let turns: Vec<Vec<String>> = match (&paints[..], count) {
        ([first], 2) if comes_first => vec![the(first), the("other")],
        (paints, count) if paints.len() == count => paints.iter().map(|paint| the(paint)).collect(),
        _ => return None,
    };
    Some((turns.join(&["and".to_owned(), "then".to_owned()][..]), end))
}

/// The colours of a list of turns in their order, and whether it says who comes first; none if it says anything else.
fn paints_of(list: &[Lexeme]) -> Option<(Vec<String>, bool)> {
    let (mut paints, mut first, mut at) = (Vec::new(), false, 0);
    while at < list.len() {
        if let Some((_, words)) = longest(&list[at..], PAINTS) {
            paints.push(list[at..at + words].iter().map(word_of).collect::<Vec<_>>().join(" "));
            at += words;
            continue;
        }
        let word = word_of(&list[at]);
        let passed = list[at].token == Token::Comma || JOINTS.contains(&word);
        first |= FIRST.contains(&word);
        if !passed {
            return None;
        }
        at += 1;
    }
    Some((paints, first))
}

/// One of several.
pub(super) fn singular(word: &str) -> Option<String> {
    if word == "people" {
        return Some("person".to_owned());
    }
    let hissing = ["ches", "shes", "xes", "sses", "buses"].iter().any(|end| word.ends_with(end));
    let shorter = if hissing { word.strip_suffix("es") } else { word.strip_suffix('s') };
    shorter.map(str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::super::lexer::rewritten;
    use super::*;

    #[test]
    fn lists_of_turns_are_told_one_by_one_and_others_stay() {
        for (said, told) in [
            (
                "point at both canoes, red first, yellow second",
                "point at the red canoe and then the yellow canoe",
            ),
            ("look at the two cars, the red one first", "look at the red car and then the other car"),
            (
                "wave at both scooters, the blue one before the black one",
                "wave at the blue scooter and then the black scooter",
            ),
            (
                "go to all three tents, orange, then blue, then green",
                "go to the orange tent and then the blue tent and then the green tent",
            ),
            (
                "take pictures of both barrels: blue, then red",
                "take pictures of the blue barrel and then the red barrel",
            ),
            ("look at both cars. Start with the red one", "look at the red car and then the other car"),
            ("look at both cars. Go to the red one", "look at both cars , go to the red one"),
            ("go to both benches, then sit on the red one", "go to both benches , then sit on the red one"),
            ("point at both cars, the red one", "point at both cars , the red one"),
            ("go to the two buses, quickly", "go to the two buses , quickly"),
        ] {
            assert_eq!(rewritten(said, told_one_by_one), told, "{said}");
        }
    }
}
