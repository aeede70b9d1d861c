//! Turns of phrase that would be read as something else, put plainly before a sentence is read: what was booked and is to be kept somewhere, what
//! somebody would adore, "once she is there", "in its place" behind a move, and the thing that is named in one sentence and pointed at in the next.
//!
//! Each says the same in every sentence. Where the plainer words would speak of something by a pronoun that was named in those left out, nothing is
//! changed.

use super::super::compass::DIRECTIONS;
use super::super::lexer::{Lexeme, Token, is_mark, word_of};
use super::super::lexicon::{longest, longest_phrase};
use super::super::paint::PAINTS;
use super::super::phrases::Phrases;
use super::forms::{is_same, word, word_at, words_at};
use super::retold::{Turns, by_turn, last_mark, told_by};
use super::words::{VERBS, Verb};

/// Turns of one sentence each that leave nothing out, in the notation of [`super::turns`].
#[rustfmt::skip]
const CERTAIN: &Turns = &[
    // Who faces what, behind an order.
    ("P and then|- have|let|get her to|- face|watch V", "P and then make her face V"),
    ("P and then|- have|let|get him to|- face|watch V", "P and then make him face V"),
    ("P and then|- have|let|get it to|- face|watch V", "P and then make it face V"),
    // Off the whole scene.
    ("O get|take|clear|fetch|haul|tow N off the|our|this|that campus|quay|premises|grounds|site|property", "O remove N"),
    ("O get|take|clear|fetch|haul|tow N off the|our|this|that campus|quay|premises|grounds|site|property , Q", "O remove N , Q"),
    ("O get|take|clear|fetch|haul|tow the K H off the|our|this|that square|marketplace|market|plaza|piazza", "O remove the K H"),
    ("O get|take|clear|fetch|haul|tow the K H off the|our|this|that square|marketplace|market|plaza|piazza , Q", "O remove the K H , Q"),
];
/// Turns of one sentence each that leave something out.
#[rustfmt::skip]
const FIRST: &Turns = &[
    // What something is said for.
    ("this|it is a|an|- real|total|absolute|proper|genuine|- emergency|test|drill|joke|prank|surprise|crisis|rehearsal , so land|bring|fly D A W", "put D A W"),
    ("its a|an|- real|total|absolute|proper|genuine|- emergency|test|drill|joke|prank|surprise|crisis|rehearsal , so land|bring|fly D A W", "put D A W"),
    ("this|it is a|an|- real|total|absolute|proper|genuine|- emergency|test|drill|joke|prank|surprise|crisis|rehearsal , so P", "P"),
    ("its a|an|- real|total|absolute|proper|genuine|- emergency|test|drill|joke|prank|surprise|crisis|rehearsal , so P", "P"),
    ("i|we|ive|weve have|need|want|got|- to store|stock|stash|hoard|keep some|a|an|more|our|my|the|- X ,|- so P", "P"),
    ("P .|,|- every harbour|harbor|port|quay|city|town|village|campus|university|quarter|district|neighbourhood|film|scene needs|wants|deserves|has|should|must have|- one|some|it", "P"),
    // What somebody would adore.
    ("A would|d adore|love|enjoy|appreciate|worship|welcome D B , so|and|then please|- put|add|place|build|park|set|stick|plant it|one|them|some W", "put D B W"),
    ("wed|id|theyd all|- cheer|root|beg|pray|queue|scream|applaud for D A", "add D A"),
    ("i|we|they|everybody|everyone|people would all|- cheer|root|beg|pray|queue|scream|applaud for D A", "add D A"),
    // What was booked and is to be kept somewhere.
    ("ive|weve|i|we have|- booked|hired|rented|ordered|bought|reserved|organised|organized D A , E B ,|- and P , all|each|both|they|- to|should|must be kept|placed|put|set|parked|stored|installed|planted|erected up|- W", "put D A W and E B W and P W"),
    ("ive|weve|i|we have|- booked|hired|rented|ordered|bought|reserved|organised|organized D A and E B , all|each|both|they|- to|should|must be kept|placed|put|set|parked|stored|installed|planted|erected up|- W", "put D A W and E B W"),
    ("ive|weve|i|we have|- booked|hired|rented|ordered|bought|reserved|organised|organized D A , to be kept|placed|put|set|parked|stored|installed|planted|erected up|- W", "put D A W"),
    // Which of several is meant.
    ("P the A that|which is|stands|lies|are|stand|lie|grows W and that|which|- is|stands|are the U of|- all|them|those|these|- Q", "P the U A W Q"),
    ("i|we|id|wed need|want|require|like|would D A W whose B", "put D A W whose B"),
    ("P the|that H whose door is|stands|stays|was open|opened|ajar Q", "P the H nearest to the open door Q"),
    ("P the|that H whose door is|stands|stays|was locked|bolted Q", "P the H nearest to the locked door Q"),
    // To somebody, right next to them.
    ("P bring|move|take|send|walk|lead|escort B over|across|- to A , right|just|directly next|beside|near to|- it|him|her", "P move B next to A"),
    // What is there and should not be.
    ("theres|there is|- a|an A W and its|it|hes|shes is|- B , take|get|throw it|him|her out|away", "remove the A W"),
];
/// Turns of several sentences, told in one.
#[rustfmt::skip]
const SENTENCES: &Turns = &[
    ("you wont|would|wouldnt|will|d never|not|- believe|guess what|who|how A . D B W . Q so|then please|- add|build|put|place it|one|that", "add D B W"),
    ("guess what|who|how A . D B W . Q so|then please|- add|build|put|place it|one|that", "add D B W"),
    ("those|these|the D A ,|- right|ok|okay|yes|- . the middle one , Q so P next|near|close|beside to|- it", "P next to the middle one of the D A"),
];
/// A building that is spoken of by what it is, and pointed at then.
#[rustfmt::skip]
const THAT_BUILDING: &Turns = &[("P do|can|did you see|know|remember|notice|spot the|that A . Q that|this building|place|house", "P Q the A")];
/// What buildings are.
#[rustfmt::skip]
const BUILDINGS: &[&str] = &["office", "school", "museum", "hospital", "clinic", "shop", "store", "restaurant", "café", "cafe", "library", "bakery", "kiosk", "cottage", "lab", "gallery", "diner", "bar", "pub", "tower", "canteen"];
/// Words that speak of what was named before.
const POINTS_BACK: &[&str] = &["it", "its", "him", "her", "them", "there", "they", "that", "those"];

/// Puts them plainly.
pub(super) fn in_plain_words(words: &str, lexemes: &mut Vec<Lexeme>) {
    misspelt(lexemes);
    that_is_beyond(lexemes);
    without_own_day(words, lexemes);
    once_there(lexemes);
    where_it_was(lexemes);
    which_was_there(lexemes);
    let end = last_mark(lexemes);
    let tables = if sees_building(lexemes) { [SENTENCES, THAT_BUILDING] } else { [SENTENCES, &[]] };
    let mut turns = tables.into_iter().flatten();
    if let Some(told) = turns.find_map(|(said, meant)| by_turn(&lexemes[..end], said, meant))
        && !points_back(&told)
    {
        lexemes.splice(..end, told);
    }
    *lexemes = told_by(lexemes, &[CERTAIN]);
    let told = told_by(lexemes, &[FIRST]);
    if !is_same(&told, lexemes) && !points_back(&told) {
        *lexemes = told;
    }
}

/// "Do you see the old office ...": whether a building is what is asked about.
fn sees_building(lexemes: &[Lexeme]) -> bool {
    let is_building = |at: usize| BUILDINGS.contains(&word(lexemes, at));
    (0..lexemes.len()).any(|at| {
        let is_the = matches!(word(lexemes, at + 2), "the" | "that");
        word(lexemes, at) == "you" && is_the && (is_building(at + 3) || is_building(at + 4))
    })
}

/// Whether a word speaks of what was named before.
pub(super) fn points_back(lexemes: &[Lexeme]) -> bool {
    lexemes.iter().any(|lexeme| POINTS_BACK.contains(&word_of(lexeme)))
}

/// "Thre barels": before several it is a number, and else "there".
fn misspelt(lexemes: &mut [Lexeme]) {
    for at in 0..lexemes.len().saturating_sub(1) {
        let plain = match word(lexemes, at) {
            "trun" => "turn",
            "tword" => "towards",
            "thre" if is_several(word(lexemes, at + 1)) => "three",
            _ => continue,
        };
        lexemes[at] = word_at(&lexemes[at].clone(), plain);
    }
}

/// "The cottage that's east of Ivy Cottage" is the one that is east of it.
fn that_is_beyond(lexemes: &mut Vec<Lexeme>) {
    let found = (1..lexemes.len()).find(|at| {
        let rest = &lexemes[at + 1..];
        let behind = longest(rest, DIRECTIONS).and_then(|(_, count)| rest.get(count..));
        word(lexemes, *at) == "thats" && behind.is_some_and(|rest| longest_phrase(rest, &["of"]).is_some())
    });
    if let Some(at) = found {
        let place = lexemes[at].clone();
        lexemes.splice(at..=at, words_at(&place, "that is").collect::<Vec<_>>());
    }
}

/// Whether a word ends like a plural.
fn is_several(word: &str) -> bool {
    word.len() > 3 && word.ends_with('s') && !word.ends_with("ss")
}

/// "It's Sports Day!": a day with a name of its own, beside something else.
fn without_own_day(words: &str, lexemes: &mut Vec<Lexeme>) {
    const TODAY: &Phrases = &Phrases::of(&["its", "it is", "today is", "todays", "tomorrow is", "its our"]);
    let is_capital =
        |lexeme: &Lexeme| words.get(lexeme.start..).is_some_and(|rest| rest.starts_with(char::is_uppercase));
    let mut from = 0;
    while from < lexemes.len() {
        let end =
            (from..lexemes.len()).find(|at| lexemes[*at].token == Token::Break).unwrap_or(lexemes.len());
        let said = &lexemes[from..end];
        let name = longest_phrase(said, TODAY).map_or(&said[..0], |today| &said[today..]);
        let is_day = matches!(name.len(), 2 | 3)
            && name.last().is_some_and(|last| matches!(word_of(last), "day" | "week") && is_capital(last))
            && name.first().is_some_and(is_capital);
        let others = lexemes[..from].iter().chain(&lexemes[end..]).any(|lexeme| !is_mark(lexeme));
        if is_day && others {
            lexemes.drain(from..lexemes.len().min(end + 1));
            return;
        }
        from = end + 1;
    }
}

/// "And once she is there have her face the hall": then.
fn once_there(lexemes: &mut Vec<Lexeme>) {
    #[rustfmt::skip]
    const ONCE: &Phrases = &Phrases::of(&["once she is there", "once shes there", "once he is there", "once hes there", "once it is there", "once its there", "once they are there", "once theyre there", "once there", "once she stands there", "once he stands there", "once it stands there",
        "when she is there", "when shes there", "when he is there", "when hes there", "when it is there", "when they are there", "when theyre there", "as soon as she is there", "as soon as he is there", "as soon as it is there", "as soon as they are there", "once it is in place", "once its in place", "once that is done", "once thats done", "when that is done", "when thats done",
        "after that is done", "once she has arrived", "once he has arrived", "once they have arrived", "once shes arrived", "once hes arrived"]);
    let found = (1..lexemes.len()).find_map(|at| {
        let count = longest_phrase(&lexemes[at..], ONCE)?;
        let is_begun = is_mark(&lexemes[at - 1]) || word(lexemes, at - 1) == "and";
        let end = at + count;
        let end = end + usize::from(lexemes.get(end).is_some_and(|mark| mark.token == Token::Comma));
        let orders = longest(lexemes.get(end..)?, &VERBS).is_some();
        (is_begun && orders).then_some(at..end)
    });
    if let Some(once) = found {
        let then = word_at(&lexemes[once.start], "then");
        lexemes.splice(once, [then]);
    }
}

/// "Move the postbox next to the stop and put a phone booth in its place": where it was before.
fn where_it_was(lexemes: &mut Vec<Lexeme>) {
    #[rustfmt::skip]
    const IN_ITS_PLACE: &Phrases = &Phrases::of(&["in its place", "in its stead", "in its spot", "in its old place", "in its old spot", "in its former place", "at its old place", "in the old place"]);
    let found = (2..lexemes.len())
        .find_map(|at| longest_phrase(&lexemes[at..], IN_ITS_PLACE).map(|count| (at, count)));
    let Some((at, count)) = found else { return };
    let begins = |from: usize| {
        from == 0
            || is_mark(&lexemes[from - 1])
            || matches!(word(lexemes, from - 1), "and" | "then" | "so" | "please" | "just" | "you")
    };
    let orders: Vec<(usize, Verb)> = (0..at)
        .filter(|from| begins(*from))
        .filter_map(|from| longest(&lexemes[from..at], &VERBS).map(|(verb, words)| (from + words, verb)))
        .collect();
    let [.., (moved, Verb::Move), (_, Verb::Put | Verb::Add)] = orders[..] else { return };
    let moves = orders.iter().filter(|(_, verb)| *verb == Verb::Move).count();
    if moves == 1 && matches!(word(lexemes, moved), "the" | "that" | "this" | "my" | "our") {
        let place = lexemes[at].clone();
        lexemes.splice(at..at + count, words_at(&place, "where it was").collect::<Vec<_>>());
    }
}

/// "The red car is in the way, move it, and put a table where the car was": it is the red one that was there.
fn which_was_there(lexemes: &mut Vec<Lexeme>) {
    let found = (3..lexemes.len().saturating_sub(3)).find_map(|at| {
        let is_where = word(lexemes, at) == "where" && word(lexemes, at + 1) == "the";
        let was = matches!(word(lexemes, at + 3), "was" | "stood" | "sat" | "lay" | "had" | "used");
        let noun = word(lexemes, at + 2);
        if !is_where || !was || noun.is_empty() {
            return None;
        }
        let is_paint = |paint: usize| longest(&lexemes[paint..=paint], PAINTS).is_some();
        let paints: Vec<usize> = (1..at - 1)
            .filter(|paint| word(lexemes, paint - 1) == "the" && word(lexemes, paint + 1) == noun)
            .filter(|paint| is_paint(*paint))
            .collect();
        let first = *paints.first()?;
        let is_one = paints.iter().all(|paint| word(lexemes, *paint) == word(lexemes, first));
        is_one.then(|| (at + 2, lexemes[first].clone()))
    });
    if let Some((at, paint)) = found {
        lexemes.insert(at, paint);
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::rewritten;
    use super::*;

    fn plain(said: &str) -> String {
        rewritten(said, |lexemes| in_plain_words(said, lexemes))
    }

    #[test]
    fn what_would_be_misread_is_put_plainly() {
        for (said, meant) in [
            (
                "Move the postbox next to the stop and put a booth in its place.",
                "move the postbox next to the stop and put a booth where it was ,",
            ),
            (
                "Move Fay beside the statue, and once she is there have her face the library.",
                "move fay beside the statue , and then make her face the library ,",
            ),
            (
                "The red car is bad. Move it behind the hall and put a table where the car was.",
                "the red car is bad , move it behind the hall and put a table where the red car was ,",
            ),
            (
                "I have booked one stall, one cart and one tent, all to be kept inside Market Square.",
                "put one stall inside market square and one cart inside market square and one tent inside market square ,",
            ),
            ("A bench by the oak. It's Sports Day!", "a bench by the oak ,"),
            ("put thre barels here", "put three barels here"),
        ] {
            assert_eq!(plain(said), meant, "{said}");
        }
    }

    #[test]
    fn what_says_something_else_stays() {
        for (said, meant) in [
            ("remove the sign and put a tree in its place", "remove the sign and put a tree in its place"),
            ("it's a rainy day. add a bench", "its a rainy day , add a bench"),
            (
                "the school would love a tree, so put one behind it",
                "the school would love a tree , so put one behind it",
            ),
            ("put a bin where the car was", "put a bin where the car was"),
            ("is thre a bench", "is thre a bench"),
        ] {
            assert_eq!(plain(said), meant, "{said}");
        }
    }
}
