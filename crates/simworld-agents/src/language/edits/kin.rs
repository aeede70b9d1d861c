//! Turns of phrase by their kin: what looks good in a colour, what a place is crying out for, what was unloaded and is to be shown somewhere, what is kept
//! away from something, and what who learns the language says so.
//!
//! They are tried where a sentence was refused in every other way, along with who is told of ([`super::told_of`]) and skies that are asked for
//! ([`super::sky_come`]), and count only if what they come to is granted. So nothing that is understood is read otherwise.

use super::super::lexer::{Lexeme, Token, is_mark, word_of};
use super::super::lexicon::{category, is_animate, longest, longest_phrase};
use super::super::names::Names;
use super::super::paint::PAINTS;
use super::super::phrases::Phrases;
use super::forms::{is_same, word, word_at, words_at};
use super::kin_turns::{PARTS, WHOLE};
use super::retold::{by_turn, last_mark, told_by};
use super::statements::{clauses, rest_of};
use super::unusual_first::points_back;
use super::{Focus, kin_later, sky_come, slips, talked, told_of};
use crate::editing::Stock;

/// Words in the place of others that say the same.
#[rustfmt::skip]
const PLAIN: &[(&[&str], &str)] = &[
    (&["at side of", "on side of", "by side of", "to side of", "at the side from", "next of", "next from", "in beside", "in next to"], "next to"),
    (&["near of", "near from", "nearby to", "nearby of"], "near"), (&["close of", "close from"], "close to"), (&["in front from", "in the front of"], "in front of"),
    (&["lamp of street", "light of street", "lantern of street"], "street lamp"), (&["lamps of street", "lights of street", "lanterns of street"], "street lamps"),
    (&["box where people post their letters", "box where people post letters", "box where one posts letters", "box where one posts ones letters", "box where you post letters", "box where you post your letters", "box where we post letters", "box where we post our letters", "box people post their letters in", "box people post letters in", "box for posting letters", "box to post letters in", "box where letters are posted", "box where the letters go"], "mailbox"),
    (&["wee", "teeny", "titchy", "teensy", "weeny", "ickle"], "small"),
];
/// At the end of a part, and says nothing of what is asked for.
#[rustfmt::skip]
const TAILS: &Phrases = &Phrases::of(&["for a change", "for once", "against the glare", "against the sun", "against the rain", "against the cold", "against the heat", "against the wind", "against the snow", "against the weather", "against thieves", "against the dark", "against the boredom"]);
/// Parts that are sayings, whole.
#[rustfmt::skip]
const CODAS: &Phrases = &Phrases::of(&["wouldnt it", "wouldnt they", "wouldnt he", "wouldnt she", "go on then", "go on", "so do it", "so do it please", "so please do it", "do it please", "you do it please", "you do it", "so you do it", "so go ahead", "go ahead", "so go for it", "go for it", "so get on with it", "get on with it", "it would be good", "that would be good",
    "it would be nice", "that would be nice", "it would be great", "that would be great", "it would be lovely", "that would be lovely", "the band starts soon", "ta", "innit", "so why not", "so chop chop", "so get to it", "what are you waiting for", "just for scale", "for scale", "for size", "for comparison", "just for comparison", "for perspective", "just for fun", "just for show", "just for effect", "for effect", "just for the look of it", "for the look of it", "just for a laugh", "just because", "just so we see how big it is", "for a sense of scale"]);
/// These begin parts that are remarks.
#[rustfmt::skip]
const REMARKS: &Phrases = &Phrases::of(&["the poor thing", "poor thing", "the poor dear", "poor dear", "the poor man", "the poor woman", "the poor soul", "poor soul", "the poor girl", "the poor boy", "the poor chap", "poor chap", "the poor love", "this i have said", "i have said this", "i have said it", "ive said this", "ive said it", "i said it already", "i said this already", "i already said", "i have already said", "ive already said", "this i said",
    "i told you already", "i told you this", "as i have said"]);
/// Who cannot bear something, and that he cannot.
#[rustfmt::skip]
const WHO: &Phrases = &Phrases::of(&["the missus", "my missus", "my wife", "the wife", "my husband", "my mother", "my mum", "my boss", "the boss", "the mayor", "my neighbours", "the neighbours", "my kids", "the kids", "my daughter", "my son", "my gran", "my dad", "my father", "the director", "the client", "i", "we", "everybody", "everyone"]);
#[rustfmt::skip]
const HATES: &Phrases = &Phrases::of(&["cant bear the sight of it", "cant stand the sight of it", "cannot bear the sight of it", "cannot stand the sight of it", "hates the sight of it", "hate the sight of it", "cant bear it", "cant stand it", "hates it", "hate it", "is sick of it", "are sick of it", "is sick of the sight of it", "cant abide it", "cant abide the sight of it"]);
const IT_IS: &Phrases =
    &Phrases::of(&["its", "it is", "is", "that is", "thats", "its just", "it is just", "it gets", "gets"]);
#[rustfmt::skip]
const TOO: &Phrases = &Phrases::of(&["too", "far too", "much too", "way too", "so", "very", "really", "rather", "quite", "pretty", "awfully", "terribly", "just too", "always so", "always too"]);
#[rustfmt::skip]
const STATES: &[&str] = &["dark", "hot", "cold", "quiet", "noisy", "boring", "bare", "empty", "dull", "dangerous", "lonely", "sunny", "windy", "wet", "bright", "loud", "crowded", "late", "early", "gloomy", "draughty", "chilly", "warm", "busy", "messy", "dirty", "slippery"];
/// Where or when it is so.
#[rustfmt::skip]
const WHERE: &[&str] = &["where", "there", "here", "for", "when", "without", "out", "over", "now", "today", "tonight", "around", "in", "at", "on", "by", "near", "down"];
/// By these a part asks for something.
#[rustfmt::skip]
const ASKS: &Phrases = &Phrases::of(&["so", "please", "should", "must", "put", "add", "make", "move", "remove", "paint", "let", "instead", "except", "if", "unless", "but not", "not the", "want", "need"]);
/// What somebody or something does all the time, behind its name: "the museum's crying out for a rack".
#[rustfmt::skip]
const IS_SO: &[&str] = &["so", "all", "too", "such", "desperate", "keen", "mad", "crazy", "in", "on", "short", "very"];
const ITSELF: &[&str] = &["itself", "himself", "herself", "themselves"];
/// By these nothing may be wanted: "I don't think it would look good in green".
const DENIES: &[&str] = &["dont", "doesnt", "didnt", "nobody", "noone", "doubt"];
/// A noun or a name takes no more words.
const LONGEST_NOUN: usize = 4;

/// What a sentence may have been meant to say, in plainer words: what is changed least comes first.
pub(super) fn ways(
    words: &str,
    heard: &[Lexeme],
    names: &Names<'_>,
    stock: &Stock,
    focus: &Focus,
) -> Vec<Vec<Lexeme>> {
    let said = slips::heard_and_spelt(words, heard, names, stock, &focus.streets);
    let mut ways: Vec<Vec<Lexeme>> = Vec::new();
    for way in said.iter().flat_map(|said| told(words, said, names, focus)) {
        let is_known = said.iter().chain(&ways).any(|other| is_same(other, &way));
        if !is_known && way.iter().any(|lexeme| !is_mark(lexeme)) {
            ways.push(way);
        }
    }
    ways
}

/// The words in single plainer words, by the turns, by who is told of, and by the sky that is asked for.
fn told(words: &str, said: &[Lexeme], names: &Names<'_>, focus: &Focus) -> Vec<Vec<Lexeme>> {
    let plain = reworded(words, said, names);
    let mut ways = vec![plain.clone()];
    let with_the = with_article(&plain);
    for way in std::iter::once(&plain).chain(&with_the) {
        let turned = turned(way);
        // What "it" stood for may be left out, and what was spoken of before the sentence is not meant.
        let is_open = focus.it.is_some() && points_back(&turned);
        if !is_open && !is_same(&turned, way) {
            ways.push(turned);
        }
    }
    ways.extend(sky_come::asked_for(&plain));
    ways.extend(kin_later::ways(&plain, names, focus.it.is_some()));
    // What is told of somebody is left as it was said, for whose it is is known by how it was written.
    let told = kin_later::with_pronouns(said, names);
    for way in told_of::ways(words, &told, names) {
        let plain = reworded(words, &way, names);
        ways.extend(needed(&plain, names).or_else(|| given(&plain, names)));
        ways.push(way);
        ways.push(turned(&plain));
        ways.push(plain);
    }
    ways
}

/// The words by the first turn that they are as a whole, and then each sentence by its own.
fn turned(lexemes: &[Lexeme]) -> Vec<Lexeme> {
    if lexemes.iter().any(|lexeme| DENIES.contains(&word_of(lexeme))) {
        return lexemes.to_vec();
    }
    let end = last_mark(lexemes);
    let whole = WHOLE.iter().find_map(|(said, meant)| by_turn(&lexemes[..end], said, meant));
    match whole {
        Some(mut told) => {
            told.extend_from_slice(&lexemes[end..]);
            told
        }
        None => told_by(lexemes, &[PARTS]),
    }
}

/// "Carol need chair next to Carol": a chair is to be put there.
fn needed(lexemes: &[Lexeme], names: &Names<'_>) -> Option<Vec<Lexeme>> {
    let (_, count) = names.exact(lexemes)?;
    let said = lexemes.get(count..last_mark(lexemes))?;
    let turns = [("D A W", "put D A W"), ("H W", "put a H W")];
    turns.into_iter().find_map(|(what, meant)| {
        by_turn(said, &format!("needs|need|wants|want|lacks|misses|wishes {what}"), meant)
    })
}

/// "Get Rex a small dog right next to Rex": a small dog is to be put there.
fn given(lexemes: &[Lexeme], names: &Names<'_>) -> Option<Vec<Lexeme>> {
    const GIVE: &[&str] = &["get", "give", "bring", "buy", "fetch", "find", "lend", "hand", "grab"];
    let lead = lexemes.iter().take_while(|lexeme| matches!(word_of(lexeme), "please" | "just")).count();
    let whom = lexemes.get(lead + 1..).filter(|_| GIVE.contains(&word(lexemes, lead)))?;
    let (who, count) = names.exact(whom)?;
    let said = whom.get(count..last_mark(whom))?;
    let at_whom = said.len().checked_sub(count).and_then(|from| names.exact(&said[from..]));
    at_whom.filter(|(others, _)| *others == who).and_then(|_| by_turn(said, "D A W", "put D A W"))
}

/// "Black car would look better in orange": the black car; none if an article stands there.
fn with_article(lexemes: &[Lexeme]) -> Option<Vec<Lexeme>> {
    let place = lexemes.first()?;
    let paint = longest(lexemes, PAINTS).map_or(0, |(_, count)| count);
    category(lexemes.get(paint..)?)?;
    let mut told = vec![word_at(place, "the")];
    told.extend_from_slice(lexemes);
    Some(told)
}

/// The words in single plainer ones, without sayings and remarks beside them.
fn reworded(words: &str, said: &[Lexeme], names: &Names<'_>) -> Vec<Lexeme> {
    let mut plain = talked::reworded(said);
    with_verb(words, &mut plain, names);
    at_whose_side(words, &mut plain, names);
    names_turned(&mut plain, names);
    let mut at = 0;
    while at < plain.len() {
        if let Some((meant, count)) = longest(&plain[at..], PLAIN) {
            let place = plain[at].clone();
            plain.splice(at..at + count, words_at(&place, meant).collect::<Vec<_>>());
        }
        at += 1;
    }
    without_itself(&mut plain, names);
    without_article(&mut plain, names);
    without_tails(&mut plain);
    without_remarks(&plain)
}

/// "The museum's crying out", "Poor Hana's all alone": it is, and she is.
pub(super) fn with_verb(words: &str, lexemes: &mut Vec<Lexeme>, names: &Names<'_>) {
    let mut at = 0;
    while at + 1 < lexemes.len() {
        let next = word(lexemes, at + 1);
        let is_so = next.ends_with("ing") && next.len() > 4 || IS_SO.contains(&next);
        if is_so && let Some(owner) = known_owner(words, lexemes, at, names) {
            let is = word_at(&lexemes[at], "is");
            lexemes.splice(at..=at, [owner, is]);
        }
        at += 1;
    }
}

/// Whose something is that is written so, if that is somebody or something of the scene.
fn known_owner(words: &str, lexemes: &[Lexeme], at: usize, names: &Names<'_>) -> Option<Lexeme> {
    let owner = told_of::owner_at(words, &lexemes[at])?;
    let said = std::slice::from_ref(&owner);
    (category(said).is_some() || names.exact(said).is_some()).then_some(owner)
}

/// "At Ben's side" is next to Ben.
fn at_whose_side(words: &str, lexemes: &mut Vec<Lexeme>, names: &Names<'_>) {
    let found = (0..lexemes.len()).find_map(|at| {
        let is_at = matches!(word(lexemes, at), "at" | "by" | "on");
        let owner = (is_at && word(lexemes, at + 2) == "side")
            .then(|| known_owner(words, lexemes, at + 1, names))
            .flatten()?;
        Some((at, owner))
    });
    if let Some((at, owner)) = found {
        let place = lexemes[at].clone();
        let told: Vec<Lexeme> = words_at(&place, "next to").chain([owner]).collect();
        lexemes.splice(at..at + 3, told);
    }
}

/// "The lab of Curie" is the Curie Lab.
fn names_turned(lexemes: &mut Vec<Lexeme>, names: &Names<'_>) {
    let found = (0..lexemes.len().saturating_sub(2)).find_map(|at| {
        let turned = [lexemes[at + 2].clone(), lexemes[at].clone()];
        let is_name = word(lexemes, at + 1) == "of"
            && category(&lexemes[at..=at]).is_some()
            && names.exact(&turned).is_some_and(|(_, count)| count == 2);
        is_name.then_some((at, turned))
    });
    if let Some((at, turned)) = found {
        lexemes.splice(at..at + 3, turned);
    }
}

/// "On top of the taxi itself" is on top of the taxi.
fn without_itself(lexemes: &mut Vec<Lexeme>, names: &Names<'_>) {
    let found = (2..lexemes.len()).find(|at| {
        let ends_noun = |from: usize| {
            let said = &lexemes[from..*at];
            let is_noun = category(said).is_some_and(|(_, count)| count == said.len());
            let is_asset = || names.asset_words(said) == Some(said.len());
            is_noun || is_asset() || names.exact(said).is_some_and(|(_, count)| count == said.len())
        };
        ITSELF.contains(&word(lexemes, *at)) && (at.saturating_sub(LONGEST_NOUN)..*at).any(ends_noun)
    });
    if let Some(at) = found {
        lexemes.remove(at);
    }
}

/// "The Rex": somebody who has a name takes no article.
fn without_article(lexemes: &mut Vec<Lexeme>, names: &Names<'_>) {
    let is_body = |at: usize| {
        let Some((ids, _)) = lexemes.get(at + 1..).and_then(|rest| names.exact(rest)) else { return false };
        let is_animate = |id| names.scene.entity(id).is_some_and(|entity| is_animate(entity.kind));
        category(&lexemes[at + 1..]).is_none() && ids.into_iter().all(is_animate)
    };
    let found = (0..lexemes.len()).find(|at| word(lexemes, *at) == "the" && is_body(*at));
    if let Some(at) = found {
        lexemes.remove(at);
    }
}

/// "... for a change", at the end of a part that says more.
fn without_tails(lexemes: &mut Vec<Lexeme>) {
    let mut at = 2;
    while at < lexemes.len() {
        let end = at + longest_phrase(&lexemes[at..], TAILS).unwrap_or(0);
        let is_last = lexemes.get(end).is_none_or(is_mark) || word(lexemes, end) == "and";
        if end > at && is_last && !is_mark(&lexemes[at - 1]) {
            lexemes.drain(at..end);
        }
        at += 1;
    }
}

/// Without the parts that are sayings and remarks, if something else is left.
fn without_remarks(lexemes: &[Lexeme]) -> Vec<Lexeme> {
    let out: Vec<_> = clauses(lexemes)
        .into_iter()
        .filter(|clause| clause.from > 0 && is_remark(&lexemes[clause.from..clause.end]))
        .collect();
    let rest = rest_of(lexemes, &out);
    if out.is_empty() || rest.iter().all(is_mark) { lexemes.to_vec() } else { rest }
}

/// Whether a part is a saying, or tells how somebody or it is there.
fn is_remark(clause: &[Lexeme]) -> bool {
    let asks = || (0..clause.len()).any(|at| longest_phrase(&clause[at..], ASKS).is_some());
    let hates = || {
        let who = longest_phrase(clause, WHO)?;
        longest_phrase(clause.get(who..)?, HATES)
    };
    longest_phrase(clause, CODAS) == Some(clause.len())
        || hates().is_some() && !asks()
        || longest_phrase(clause, REMARKS).is_some() && !asks()
        || tells_state(clause) && !(1..clause.len()).any(|at| is_order(clause, at))
}

/// Whether a word asks for something; "so dark" does not.
fn is_order(clause: &[Lexeme], at: usize) -> bool {
    word(clause, at) != "so" && longest_phrase(&clause[at..], ASKS).is_some()
}

/// "It is far too dark where she stands".
fn tells_state(clause: &[Lexeme]) -> bool {
    let found = || {
        let is = longest_phrase(clause, IT_IS)?;
        let too = is + longest_phrase(clause.get(is..)?, TOO)?;
        let is_state = STATES.contains(&word(clause, too));
        let rest = clause.get(too + 1..)?;
        let is_there = rest.is_empty() || WHERE.contains(&word(rest, 0));
        let is_plain = rest.iter().all(|lexeme| matches!(lexeme.token, Token::Word(_)));
        Some(is_state && is_there && is_plain)
    };
    found().unwrap_or(false)
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::rewritten;
    use super::*;

    fn plain(said: &str) -> String {
        rewritten(said, |lexemes| *lexemes = turned(&without_remarks(lexemes)))
    }

    #[test]
    fn turns_are_told_plainly() {
        for (said, meant) in [
            (
                "light a campfire, but keep it at least 25 metres away from the diner",
                "add a campfire at least 25 metres from the diner",
            ),
            ("the bus would look dead good in green, wouldn't it? go on then", "paint the bus green"),
            ("i reckon the postbox would look ace in purple, so do it", "paint the postbox purple"),
            ("would be nice if the white truck became orange", "paint the white truck orange"),
            (
                "the crew unloaded eleven cardboard boxes; show them near the van",
                "put eleven cardboard boxes near the van",
            ),
            ("kindly make to disappear the chair", "kindly remove the chair"),
            ("a wee dog by the postbox wouldn't go amiss", "add a wee dog by the postbox"),
            (
                "copy the lamp to the north of anna, it is far too dark where she stands",
                "copy the lamp to the north of anna",
            ),
            ("who or what is spot 7", "describe spot 7"),
            ("have eve gawp at the van", "make eve face the van"),
            ("bucketing down, that's what i need out there", "make it bucketing down"),
            ("from the sky it must fall rain now", "make it rain"),
            ("remove all oaks except those taller than 10 m", "remove all oaks shorter than 10 m"),
        ] {
            assert_eq!(plain(said), meant, "{said}");
        }
    }

    #[test]
    fn what_says_something_else_stays() {
        for said in [
            "the crew unloaded the boxes , move them near the van",
            "make it dark , it is too bright so put a lamp here",
            "the bus would look good near the oak",
            "have eve stand at the van",
            "put a lamp here , it is next to the bench",
            "i dont think the bus would look good in green",
        ] {
            assert_eq!(plain(said), said);
        }
    }
}
