//! Where things go, told in ways that are tried last: with the place first and the verb behind it ("left of the museum waits a yellow cab"), by what
//! used to be there ("... there used to be a phone box; bring one back"), by what comes out and what comes in its place, by what several things form
//! ("ten bollards are to form a ring about the lime"), by two places of one thing ("north of the school, but close to it, a sports hall"), to somebody
//! who is called ("off you go, Ben: stand east of the clinic"), and "left from" for "left of".
//!
//! Each comes to plainer words that are heard anew, and counts only if these are granted. What is asked is never put so.

use super::super::compass::DIRECTIONS;
use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{longest, longest_phrase};
use super::super::names::Names;
use super::super::phrases::Phrases;
use super::busy::NO_DEEDS;
use super::forms::{word, word_at};
use super::repairs::needs_anchor;
use super::retold::{Turns, before_kind_words, by_turn, is_new, is_somewhere, last_mark};
use super::words::WAYS;

/// Turns of phrase that are all that is said, and what they mean, in the notation of [`super::turns`]; "." is the end of a sentence within them.
#[rustfmt::skip]
const ALONE: &Turns = &[
    // What several things form.
    ("O D A is|are|should|shall|must|will|could|can|may|have|has|need|needs|ought to|- form|make|build|be|stand|sit|go|gather in|- a|one|- neat|perfect|wide|- ring|circle around|round|about B", "put D A in a ring around B"),
    ("O D A is|are|should|shall|must|will|could|can|may|have|has|need|needs|ought|- to|- go|goes|run|runs|stand|stands|come|comes|be|placed|put|set|- around|round|about B in a|one|- neat|perfect|wide|- ring|circle", "put D A in a ring around B"),
    ("O D A is|are|should|shall|must|will|could|can|may|have|has|need|needs|ought to|- form|make|build|be|stand in|- a|one|- neat|straight|even|- row|line between B and C", "put D A in a row between B and C"),
    ("O D A is|are|should|shall|must|will|could|can|may|have|has|need|needs|ought to|- form|make|build|be|stand in|- a|one|- neat|straight|even|- row|line from B to C", "put D A in a row between B and C"),
    // A row of one thing, told once more by what it is made of.
    ("O a|one line|row|chain|string|strip|border|avenue|hedge of A , a|one|- plant|piece|bush|shrub|flower|item|one|specimen|pot|unit every|each M ,|- from B to C", "add A every M between B and C"),
    ("O a|one line|row|chain|string|strip|border|avenue|hedge of A , a|one|- plant|piece|bush|shrub|flower|item|one|specimen|pot|unit every|each M ,|- W", "add A every M W"),
    ("from B to C , D A", "add D A between B and C"),
    // The place first.
    ("W ,|- waits|wait|stands|stand|sits|sit|lies|lie|hangs|hang|rests|rest|grows|grow|idles|idle|lurks|lurk|rises|rise|looms|parks|queues|queue|gathers|gather|towers|tower|sleeps|sleep D A", "add D A W"),
    ("W i|we wish|desire|want|need|crave|fancy|require|demand|request|like|hope for|to|- have|see|get|put|- D A", "add D A W"),
    ("W ,|- there|- used|once to|- be|was|were|stand|stood|hang|hung|grow|grew|sit|sat|lie|lay D A .|,|- so|and|then|- please|kindly|- i|we|you|lets|id|wed|- should|could|would|can|- please|- bring|put|get|set|build|plant|add|want|need|like|place it|one|them|that|another back|again|there please|again|-", "add D A W"),
    ("there|- used to be|stand|hang|grow|sit|lie D A .|,|- so|and|then|- please|kindly|- i|we|you|lets|id|wed|- should|could|would|can|- please|- bring|put|get|set|build|plant|add|want|need|like|place it|one|them|that|another back|again please|again|-", "add D A"),
    // What goes, and what comes in its place.
    ("out comes|come|goes|go|with N ,|- and|then|- D A is|are|gets|get|comes|come|goes|go|should|must|will|shall be|- set|put|built|placed|planted|moved|installed|erected|raised|parked|added|come|go|stand|- up|in|- in|at|on|to|into its|his|her|their|that|the place|stead|spot|position", "remove N and put D A in its place"),
    ("out comes|come|goes|go|with N ,|- and|then|- in comes|come|goes|go|with D A", "remove N and put D A in its place"),
    // A certain thing, taken up again by a pronoun.
    ("N i|we|id|wed want|wish|need|like|would|prefer|demand like|love|want|prefer|- to|- see|have|get|- him|her|it|them W", "move N W"),
];
/// What is said before somebody is called by name.
#[rustfmt::skip]
const CALLS: &[&str] = &["off", "you", "go", "come", "on", "hey", "oh", "dear", "right", "ok", "okay", "now", "please", "up", "get", "there", "listen", "look", "here", "well", "so", "and", "then", "hi", "hello", "my", "friend", "good", "run", "along", "quick", "hurry", "sorry", "yes"];
/// Where somebody who is called is told to be.
#[rustfmt::skip]
const GOES: &Phrases = &Phrases::of(&["stand", "wait", "sit", "go", "come", "walk", "run", "move", "stay", "step", "hop", "head", "hurry", "rest", "lie", "sit down", "lie down", "come over", "go over", "walk over", "move over", "run over", "hop over", "get yourself", "take yourself", "position yourself", "station yourself", "place yourself",
    "plant yourself", "put yourself", "go and stand", "go and sit", "go and wait", "come and stand", "come and sit", "come and wait", "go stand", "go sit", "go wait", "come stand", "come sit", "come wait", "be"]);
/// Before that.
#[rustfmt::skip]
const KINDLY: &Phrases = &Phrases::of(&["please", "now", "just", "kindly", "quickly", "would you", "could you", "can you", "will you", "you should", "you must", "you have to", "you need to", "you go and", "would you please", "could you please", "please would you", "please could you"]);
/// Between two places of one thing, the second of which says more of the first.
#[rustfmt::skip]
const BUT: &Phrases = &Phrases::of(&["but", "yet", "though", "albeit", "but still", "yet still", "but also", "and also", "but quite", "but rather", "but right", "but only", "and still", "although", "and"]);
/// So many words are said at most before somebody's name.
const LONGEST_CALL: usize = 8;

/// What was said in plainer words, the nearest first.
pub(super) fn ways(words: &str, lexemes: &[Lexeme], names: &Names<'_>) -> Vec<Vec<Lexeme>> {
    let end = last_mark(lexemes);
    let asks = lexemes
        .get(end)
        .is_some_and(|mark| words.get(mark.start..).is_some_and(|rest| rest.starts_with('?')));
    if end == 0 || asks {
        return Vec::new();
    }
    let said = &lexemes[..end];
    let sided = side_of(words, said);
    let plain = sided.as_deref().unwrap_or(said);
    let told = [
        addressed(words, plain, names),
        in_two_ways(plain),
        busy_there(plain),
        by_table(plain),
        sided.clone(),
    ];
    told.into_iter().flatten().collect()
}

/// By the first turn that the whole of it is, words of politeness behind it or not.
fn by_table(said: &[Lexeme]) -> Option<Vec<Lexeme>> {
    let told = |words: &[Lexeme]| ALONE.iter().find_map(|(said, meant)| by_turn(words, said, meant));
    told(said).or_else(|| before_kind_words(said).and_then(|end| told(&said[..end])))
}

/// "Left from the hall" is left of it; "right from the hall to the lake" begins a way.
fn side_of(words: &str, lexemes: &[Lexeme]) -> Option<Vec<Lexeme>> {
    const CERTAIN: &[&str] = &["the", "that", "this", "my", "our", "me", "it", "him", "her"];
    const ONWARDS: &[&str] = &["to", "until", "till", "towards"];
    let at = (1..lexemes.len()).find(|at| {
        let behind = lexemes.get(at + 1..).unwrap_or_default();
        let is_name = behind.first().is_some_and(|next| is_capital(words, next));
        let leads_on = behind
            .iter()
            .take_while(|next| !is_mark(next))
            .any(|next| matches!(&next.token, Token::Word(said) if ONWARDS.contains(&said.as_str())));
        word(lexemes, *at) == "from"
            && matches!(word(lexemes, at - 1), "left" | "right")
            && (is_name || longest_phrase(behind, CERTAIN).is_some())
            && !leads_on
    })?;
    let mut told = lexemes.to_vec();
    told[at] = word_at(&lexemes[at], "of");
    Some(told)
}

/// Whether a word is written with a capital.
fn is_capital(words: &str, lexeme: &Lexeme) -> bool {
    words.get(lexeme.start..).is_some_and(|rest| rest.starts_with(char::is_uppercase))
}

/// "Off you go, Ben: stand east of the clinic": who is called is moved.
fn addressed(words: &str, lexemes: &[Lexeme], names: &Names<'_>) -> Option<Vec<Lexeme>> {
    let is_call = |lexeme: &Lexeme| match &lexeme.token {
        Token::Word(said) => CALLS.contains(&said.as_str()),
        _ => is_mark(lexeme),
    };
    let (who, behind) = (0..lexemes.len().min(LONGEST_CALL)).find_map(|at| {
        let (ids, count) = names.exact(&lexemes[at..]).filter(|_| is_capital(words, &lexemes[at]))?;
        let is_called = ids.len() == 1 && lexemes.get(at + count).is_some_and(is_mark);
        (is_called && lexemes[..at].iter().all(is_call)).then_some((at, at + count))
    })?;
    let mut from = behind + lexemes[behind..].iter().take_while(|lexeme| is_mark(lexeme)).count();
    from += longest_phrase(lexemes.get(from..)?, KINDLY).unwrap_or(0);
    from += longest_phrase(lexemes.get(from..)?, GOES)?;
    from += longest_phrase(lexemes.get(from..)?, &["over", "right", "just", "directly", "down", "up"])
        .filter(|_| !is_somewhere(&lexemes[from..]))
        .unwrap_or(0);
    let place = lexemes.get(from..)?;
    if !is_somewhere(place) || place.iter().any(is_mark) {
        return None;
    }
    let mut told = vec![word_at(&lexemes[who], "move")];
    told.extend_from_slice(&lexemes[who..behind]);
    told.extend_from_slice(place);
    Some(told)
}

/// "North of the school, but close to it, a sports hall": a new thing in two ways to one.
fn in_two_ways(lexemes: &[Lexeme]) -> Option<Vec<Lexeme>> {
    let way = way_at(lexemes)?;
    let is_but = |at: usize| longest_phrase(&lexemes[at..], BUT);
    let ends = (way + 1..lexemes.len()).find(|at| {
        is_mark(&lexemes[*at])
            || longest_phrase(&lexemes[*at..], &["but", "yet", "though", "albeit"]).is_some()
    })?;
    let but = ends + usize::from(is_mark(&lexemes[ends]));
    let second = but + is_but(but.min(lexemes.len() - 1))?;
    let other = way_at(lexemes.get(second..)?)?;
    let it = second + other;
    if !matches!(word(lexemes, it), "it" | "him" | "her" | "them") {
        return None;
    }
    let from = it + 1 + usize::from(lexemes.get(it + 1).is_some_and(is_mark));
    let rest = lexemes.get(from..)?;
    let is_one = (1..=3).any(|count| rest.len() > count && is_new(&rest[..count]));
    if !is_one || rest.iter().any(is_mark) {
        return None;
    }
    let mut told = vec![word_at(&lexemes[0], "add")];
    told.extend_from_slice(rest);
    told.extend_from_slice(&lexemes[..ends]);
    told.push(word_at(&lexemes[but], "and"));
    told.extend_from_slice(&lexemes[second..it]);
    told.extend_from_slice(&lexemes[way..ends]);
    Some(told)
}

/// How many words say how something stands to what follows them: "north of", "close to".
fn way_at(lexemes: &[Lexeme]) -> Option<usize> {
    let compass = || {
        let the = longest_phrase(lexemes, &["to the", "just", "on the"]).unwrap_or(0);
        let (_, words) = longest(&lexemes[the..], DIRECTIONS)?;
        let of = longest_phrase(&lexemes[the + words..], &["of", "from"])?;
        Some(the + words + of)
    };
    longest(lexemes, &WAYS).filter(|(way, _)| needs_anchor(*way)).map(|(_, words)| words).or_else(compass)
}

/// "Near the shop a couple of tourists are loitering": who is busy there is new.
fn busy_there(lexemes: &[Lexeme]) -> Option<Vec<Lexeme>> {
    const AROUND: &Phrases = &Phrases::of(&["about", "around", "there", "idly", "quietly", "patiently"]);
    let is = (3..lexemes.len()).find(|at| {
        let deed = word(lexemes, at + 1);
        matches!(word(lexemes, *at), "is" | "are") && deed.ends_with("ing") && !NO_DEEDS.contains(&deed)
    })?;
    let behind = lexemes.get(is + 2..)?;
    if !behind.is_empty() && longest_phrase(behind, AROUND) != Some(behind.len()) {
        return None;
    }
    let (place, who) = (2..is).find_map(|cut| {
        let who = cut + usize::from(lexemes[cut].token == Token::Comma);
        let begins = (1..=3).any(|count| who + count < is && is_new(&lexemes[who..who + count]));
        (begins && is_somewhere(&lexemes[..cut])).then_some((cut, who))
    })?;
    if lexemes[..place].iter().chain(&lexemes[who..is]).any(is_mark) {
        return None;
    }
    let mut told = vec![word_at(&lexemes[0], "add")];
    told.extend_from_slice(&lexemes[who..is]);
    told.extend_from_slice(&lexemes[..place]);
    Some(told)
}
