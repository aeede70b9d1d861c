//! What is said in passing within a sentence and means no more than the plain words: "you see the oak, don't you?", "and then, you
//! know, go", "if you happen to be sitting", "farthest from where you are standing now".

use super::lexer::{Lexeme, Token, is_mark};
use super::lexicon::{FARTHEST, MOSTS, NEAREST, longest, longest_phrase};
use super::phrases::Phrases;

/// What is said while one thinks of the next word.
#[rustfmt::skip]
const THINKING: &Phrases = &Phrases::of(&[
    "you know", "i guess", "i think", "i suppose", "i dont know", "i dunno", "lets see", "let us see", "let me see", "let me think", "what was it",
    "whats it called", "what is it called", "whats the word", "how do you say", "how shall i put it", "as it were", "so to speak", "i believe", "lets say",
    "let us say", "say", "whats it", "what do you call it", "if you like", "why not", "i would say", "id say", "erm", "right", "okay", "well", "you see",
]);
/// What is said before an order or behind it, by its whole words: of some of them a part would be an order.
#[rustfmt::skip]
const SMALL_TALK: &Phrases = &Phrases::of(&[
    "we have to leave", "we have to leave now", "we have to go", "we have to go now", "we must leave", "we must leave now", "we must go", "we must go now", "we are leaving", "were leaving",
    "were leaving now", "we should be off", "we must be off", "we ought to be off", "wed better be off", "we are off", "time to leave", "its time to leave", "time to go", "its time to go", "we should be going", "we should get going", "somebody must be missing it", "someone must be missing it",
    "somebody must have lost it", "someone must have lost it", "somebody must have forgotten it", "someone must have forgotten it", "somebody left it behind", "someone left it behind",
    "somebody left it there", "someone left it there", "somebody forgot it", "someone forgot it", "everybody is ready", "everyone is ready", "everything is ready", "we are all ready",
    "the rain has stopped", "the rain stopped", "it has stopped raining", "its stopped raining", "it stopped raining", "the sun is out", "the sun has come out", "good to see you", "nice to see you", "lovely to see you", "great to see you", "call me silly", "call me old fashioned", "make some room", "give me a moment", "give me a second", "give me a minute", "give us a moment", "hang on", "hang on a second", "hang on a moment", "to be honest", "to be fair", "to be frank", "to tell the truth", "to tell you the truth", "truth be told", "poor boy", "poor girl", "poor thing",
    "poor soul", "poor fellow", "bless him", "bless her", "the view must be better there", "the view is better there", "it must be nicer there", "it is nicer there", "its nicer there",
]);
/// What one says to somebody before small talk, with or without a pause.
#[rustfmt::skip]
const GREETINGS: &[&str] = &["hi", "hello", "hey", "morning", "evening", "afternoon", "oh", "ah", "okay", "ok", "well", "so", "right", "look", "listen"];
/// Behind which nobody pauses unless to think.
#[rustfmt::skip]
const UNFINISHED: &[&str] = &[
    "and", "then", "or", "but", "the", "a", "an", "to", "on", "at", "with", "for", "in", "of", "by", "so", "first", "my", "that", "near", "behind", "beside",
    "towards", "into", "from", "via", "past", "about", "is", "are",
];
/// Words that compare how far things are.
#[rustfmt::skip]
const COMPARED: &[&str] = &[
    "farthest", "furthest", "away", "closest", "nearest", "distant", "far", "nearer", "closer", "farther", "further", "off", "remote",
];
/// Where who is told is, in other words than "you".
#[rustfmt::skip]
const WHERE_YOU_ARE: &Phrases = &Phrases::of(&[
    "where you are", "where youre", "where you are now", "where you are right now", "where you are at the moment", "where you are standing", "where you stand",
    "where youre standing", "where you are standing now", "where youre standing now", "where you are standing right now", "where youre standing right now", "where you stand now",
    "where you are at present", "where you currently are", "where you now are", "where you now stand", "where youre at", "your position", "your current position", "your present position",
    "your location", "your current location", "where you happen to be", "where you are sitting", "where youre sitting", "this place", "this spot", "where we are", "where we are now",
]);

/// Puts plain words in the place of what is said in passing.
pub(super) fn plainly(lexemes: &mut Vec<Lexeme>, text: &str) {
    if text.contains('?') {
        without_tags(lexemes, text);
        which_one(lexemes);
    }
    without_small_talk(lexemes);
    without_a_look(lexemes);
    without_how_amiss(lexemes);
    without_asking_for_a_nod(lexemes);
    let mut at = 0;
    while at < lexemes.len() {
        match &lexemes[at].token {
            Token::Comma if at > 0 => thinks(lexemes, at),
            Token::Word(word) if at > 0 && (word == "no" || word == "sorry" || word == "wait") => {
                comma_again(lexemes, at, text);
            }
            Token::Word(word) if word == "happen" || word == "happens" => happens(lexemes, at),
            Token::Word(word) if word == "from" || word == "to" => from_you(lexemes, at),
            Token::Word(word) if word == "get" && word_at(lexemes, at + 1) == "between" => {
                put_words(lexemes, at, at + 1, &["go"]);
            }
            _ => {}
        }
        at += 1;
    }
}

fn word_at(lexemes: &[Lexeme], at: usize) -> &str {
    match lexemes.get(at).map(|lexeme| &lexeme.token) {
        Some(Token::Word(word)) => word,
        _ => "",
    }
}

/// "The red canoe is too near the water, so lift it": what is amiss with a thing names no other that "it" could stand for.
fn without_how_amiss(lexemes: &mut Vec<Lexeme>) {
    let is = |at: &usize| {
        ["is", "are", "stands", "lies", "sits"].contains(&word_at(lexemes, *at))
            && word_at(lexemes, at + 1) == "too"
            && ["near", "close", "far"].contains(&word_at(lexemes, at + 2))
    };
    let Some(at) = (1..lexemes.len()).find(is) else { return };
    let Some(end) = (at..lexemes.len()).find(|at| is_mark(&lexemes[*at])) else { return };
    put_words(lexemes, at + 1, end, &["here"]);
}

fn put_words(lexemes: &mut Vec<Lexeme>, from: usize, to: usize, words: &[&str]) {
    let lexeme = lexemes[from].clone();
    let new = words.iter().map(|word| Lexeme {
        token: Token::Word((*word).to_owned()),
        lemma: super::verbs::base_form(word),
        ..lexeme.clone()
    });
    lexemes.splice(from..to, new.collect::<Vec<_>>());
}

/// "We have to leave now, get into the car": what is between two marks and asks for nothing.
fn without_small_talk(lexemes: &mut Vec<Lexeme>) {
    let mut at = 0;
    while at < lexemes.len() {
        let begins = at == 0 || is_mark(&lexemes[at - 1]) || greets(lexemes, at - 1);
        let said = if begins { longest_phrase(&lexemes[at..], SMALL_TALK) } else { None };
        let end = said.map(|words| at + words);
        match end {
            Some(end) if lexemes.get(end).is_some_and(is_mark) && end + 1 < lexemes.len() => {
                lexemes.drain(at..=end);
            }
            Some(end) if at > 0 && lexemes[end..].iter().all(is_mark) => {
                lexemes.drain(at - 1..end);
            }
            _ => at += 1,
        }
    }
}

/// "These bags weigh a ton, you know. Sit down": what is said at the end of a sentence and means nothing.
fn without_asking_for_a_nod(lexemes: &mut Vec<Lexeme>) {
    #[rustfmt::skip]
    const NODDED: &Phrases = &Phrases::of(&[
        "you know", "you see", "i believe", "i suppose", "i guess", "i think", "mind you", "innit", "ha", "haha", "lol", "eh", "i tell you", "believe me", "isnt it", "wasnt it", "arent they",
        "werent they", "isnt he", "isnt she", "doesnt it", "dont they", "havent they", "hasnt it", "is not it", "was not it", "are not they",
    ]);
    let mut at = 1;
    while at + 1 < lexemes.len() {
        if lexemes[at].token == Token::Comma
            && let Some(words) = longest_phrase(&lexemes[at + 1..], NODDED)
            && lexemes.get(at + 1 + words).is_some_and(|end| end.token == Token::Break)
        {
            lexemes.drain(at..at + 1 + words);
        }
        at += 1;
    }
}

/// "Which boat is nearest the shop? Go to that one": the one that is asked for.
fn which_one(lexemes: &mut Vec<Lexeme>) {
    const MOST: usize = 3;
    let Some(end) = lexemes.iter().position(|lexeme| lexeme.token == Token::Break) else { return };
    let is_which = |at: &usize| word_at(lexemes, *at) == "which" && word_at(lexemes, at + 1) != "of";
    let Some(which) = (0..end).find(is_which) else { return };
    let is = (which + 2..end.min(which + 2 + MOST)).find(|at| word_at(lexemes, *at) == "is");
    let Some(is) = is.filter(|_| end + 1 < lexemes.len() && (which == 0 || is_mark(&lexemes[which - 1])))
    else {
        return;
    };
    let from = is + 1 + usize::from(word_at(lexemes, is + 1) == "the");
    let rest = &lexemes[from..end];
    let most = longest_phrase(rest, NEAREST)
        .or_else(|| longest_phrase(rest, FARTHEST))
        .or_else(|| longest(rest, MOSTS).map(|(_, words)| words));
    let Some(most) = most else { return };
    let noun = &lexemes[which + 1..is];
    let the = Lexeme { token: Token::Word("the".to_owned()), lemma: None, ..lexemes[which].clone() };
    // "The nearest boat", "the boat nearest the shop".
    let told = if from + most == end { [&[the], rest, noun].concat() } else { [&[the], noun, rest].concat() };
    lexemes.splice(which..end, told);
}

/// "Look, somebody forgot the bucket!": nobody is told to look at anything.
fn without_a_look(lexemes: &mut Vec<Lexeme>) {
    #[rustfmt::skip]
    const SOMEBODY: &[&str] = &[
        "somebody", "someone", "nobody", "everybody", "everyone", "there", "theres", "i", "im", "ive", "its", "he", "hes", "she", "shes", "we", "weve", "they", "theyre",
    ];
    let calls = ["look", "listen"].contains(&word_at(lexemes, 0)) && lexemes.get(1).is_some_and(is_mark);
    if calls && SOMEBODY.contains(&word_at(lexemes, 2)) {
        lexemes.drain(..2);
    }
}

/// Whether nothing but a greeting was said before: "hi, um, we have to leave".
fn greets(lexemes: &[Lexeme], at: usize) -> bool {
    GREETINGS.contains(&word_at(lexemes, at)) && (at == 0 || is_mark(&lexemes[at - 1]))
}

/// "..., isn't it?", "..., right?": what asks for a nod.
fn without_tags(lexemes: &mut Vec<Lexeme>, text: &str) {
    #[rustfmt::skip]
    const NODS: &Phrases = &Phrases::of(&[
        "right", "correct", "yeah", "yes", "no", "eh", "huh", "innit", "is that right", "am i right", "isnt that so", "dont you think", "wouldnt you say",
        "do you agree", "dont you agree", "you know", "you see", "see", "agreed", "true",
    ]);
    const DOES: &Phrases = &Phrases::of(&[
        "is", "are", "was", "were", "does", "has", "have", "do", "did", "can", "will", "would", "could",
        "dont", "wont", "cant", "couldnt", "wouldnt", "didnt", "havent", "hadnt", "shouldnt", "isnt",
        "arent", "doesnt", "hasnt", "wasnt", "werent",
    ]);
    const WHO: &[&str] = &["it", "he", "she", "they", "there", "that", "you", "we", "i", "this"];
    let mut at = 2;
    while at < lexemes.len() {
        let asked = lexemes[at].token == Token::Break && text[lexemes[at].start..].starts_with('?');
        let from =
            lexemes[..at].iter().rposition(|lexeme| matches!(lexeme.token, Token::Comma | Token::Break));
        if let (true, Some(from)) = (asked, from.filter(|from| *from > 0)) {
            let said = &lexemes[from + 1..at];
            let verb = longest_phrase(said, DOES).unwrap_or(0);
            let not = usize::from(word_at(said, verb) == "not");
            let tag = verb > 0 && said.len() == verb + not + 1 && WHO.contains(&word_at(said, verb + not));
            // "Could you" and the like are asked of who is told, and have a reading of their own.
            let favour = ["will", "would", "could", "can", "wont"].contains(&word_at(said, 0))
                && word_at(said, verb + not) == "you"
                && at + 1 == lexemes.len();
            let nod = longest_phrase(said, NODS) == Some(said.len()) && !said.is_empty();
            if lexemes[from].token == Token::Comma && (tag && !favour || nod) {
                lexemes.drain(from..at);
                at = from;
            }
        }
        at += 1;
    }
}

/// "And then, you know, go": what is said where the sentence has to go on.
fn thinks(lexemes: &mut Vec<Lexeme>, comma: usize) {
    if !UNFINISHED.contains(&word_at(lexemes, comma - 1)) {
        return;
    }
    if let Some(words) = longest_phrase(&lexemes[comma + 1..], THINKING)
        && matches!(lexemes.get(comma + 1 + words), Some(Lexeme { token: Token::Comma, .. }))
    {
        let said_twice = word_at(lexemes, comma + 2 + words) == word_at(lexemes, comma - 1);
        lexemes.drain(comma - usize::from(said_twice)..comma + 2 + words);
    }
}

/// "The statue, oh no, the well": the comma that went with the sound behind it.
fn comma_again(lexemes: &mut Vec<Lexeme>, at: usize, text: &str) {
    let (end, start) = (lexemes[at - 1].end, lexemes[at].start);
    let marked =
        |at: usize| matches!(lexemes.get(at), Some(Lexeme { token: Token::Comma | Token::Break, .. }));
    if !marked(at - 1) && marked(at + 1) && text.get(end..start).is_some_and(|between| between.contains(','))
    {
        lexemes.insert(at, Lexeme { token: Token::Comma, lemma: None, start: end, end: start });
    }
}

/// "You happen to be sitting" is "you are sitting".
fn happens(lexemes: &mut Vec<Lexeme>, at: usize) {
    if word_at(lexemes, at + 1) != "to" {
        return;
    }
    let asked = (1..=4).any(|back| at >= back && word_at(lexemes, at - back) == "should");
    if word_at(lexemes, at + 2) != "be" {
        lexemes.drain(at..at + 2);
    } else if asked {
        lexemes.drain(at..at + 2); // "should you happen to be sitting"
    } else {
        let is = if word_at(lexemes, at) == "happens" { "is" } else { "are" };
        put_words(lexemes, at, at + 3, &[is]);
    }
}

/// "Farthest from where you are now" is "farthest from you".
fn from_you(lexemes: &mut Vec<Lexeme>, at: usize) {
    if at == 0 || !COMPARED.contains(&word_at(lexemes, at - 1)) {
        return;
    }
    if let Some(words) = longest_phrase(&lexemes[at + 1..], WHERE_YOU_ARE) {
        put_words(lexemes, at + 1, at + 1 + words, &["you"]);
    }
}

#[cfg(test)]
mod tests {
    use super::super::lexer::rewritten;
    use super::*;

    #[test]
    fn what_is_said_in_passing_is_said_plainly() {
        for (said, plain) in [
            ("You see the oak, don't you? Point at it", "you see the oak , point at it"),
            (
                "There is a slide here somewhere, right? Look at it",
                "there is a slide here somewhere , look at it",
            ),
            ("and then, you know, go", "and then go"),
            ("the, what's it called, the bench", "the bench"),
            ("if you happen to be sitting", "if you are sitting"),
            ("if it happens to be raining", "if it is raining"),
            ("the bench farthest from where you are standing now", "the bench farthest from you"),
            ("Which boat is nearest the shop? Go to it", "the boat nearest the shop , go to it"),
            ("Which tree is the tallest? Go to it", "the tallest tree , go to it"),
            ("turn left, right, left", "turn left , right , left"),
            ("go to where you are now", "go to where you are now"),
            ("these bags weigh a ton, you know. Sit down", "these bags weigh a ton , sit down"),
            ("the forecast was awful, wasn't it. Sit down", "the forecast was awful , sit down"),
            ("turn left, you know", "turn left , you know"),
            ("Hi we have to leave now, get into the red car", "hi get into the red car"),
        ] {
            assert_eq!(rewritten(said, |lexemes| plainly(lexemes, said)), plain, "{said}");
        }
    }
}
