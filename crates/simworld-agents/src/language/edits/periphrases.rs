//! Things and distances that are told round about, put as they are called: "the basket for the rubbish" is the bin, "on the place of market" is on
//! the market square, "no further from the museum than 15 m" is within 15 m of it, "ten paces" are so many metres, and who is put inside the trunk of
//! a tree is put inside the tree.
//!
//! They are put so before the words are read, for they say the same in every sentence.

use simworld_core::scene::Relation;

use super::super::compass::DIRECTIONS;
use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{longest, longest_phrase};
use super::super::numbers;
use super::super::paint::PAINTS;
use super::super::phrases::Phrases;
use super::forms::{word, word_at, words_at};
use super::words::{WAYS, Way};

/// A thing that is told by what it is for, or of what it is: nouns, what stands between, what it is for, and what it is called.
type Roundabout = (&'static [&'static str], &'static [&'static str], &'static [&'static str], &'static str);

/// What stands between a thing and what it is for.
const FOR: &[&str] = &["for", "for the", "for all the", "for our", "for your", "for my"];
/// What stands between a thing and what it is of.
const OF: &[&str] = &["of", "of the"];
/// Either of the two.
const FOR_OR_OF: &[&str] = &["for", "for the", "of", "of the"];

/// Things that are told by what they are for. None of the nouns alone tells which thing it is, or it tells another.
#[rustfmt::skip]
const ROUNDABOUT: &[Roundabout] = &[
    (&["basket", "box", "bucket", "container", "can", "receptacle", "pail"], FOR, &["rubbish", "litter", "waste", "wastes", "trash", "garbage", "refuse"], "trash bin"),
    (&["box"], FOR, &["letters", "mail", "post"], "mailbox"),
    (&["stand", "rack", "holder"], FOR, &["bikes", "bicycles", "cycles", "pushbikes"], "bicycle rack"),
    (&["stop"], FOR_OR_OF, &["bus", "buses", "busses"], "bus stop"),
    (&["place", "square"], OF, &["market"], "market square"),
    (&["machine"], FOR, &["cash", "money"], "cash machine"),
    (&["machine"], FOR, &["drinks", "snacks", "sweets"], "vending machine"),
    (&["booth", "box", "cabin", "cell"], FOR_OR_OF, &["telephone", "phone", "telephones"], "phone booth"),
    (&["car"], OF, &["police"], "police car"),
    (&["light"], FOR_OR_OF, &["traffic"], "traffic light"),
    (&["tree"], FOR_OR_OF, &["christmas"], "christmas tree"),
    (&["table"], FOR_OR_OF, &["picnic", "picnics"], "picnic table"),
    (&["lamp", "lantern"], OF, &["street"], "street lamp"),
];
/// Names of assets as others say them, which would be misunderstood word by word: who says "bike stand" tells no bike to stand anywhere.
#[rustfmt::skip]
const CALLED: &[(&[&str], &str)] = &[
    (&["bike stand", "bicycle stand", "cycle stand", "bike holder"], "bicycle rack"), (&["bike stands", "bicycle stands", "cycle stands", "bike holders"], "bicycle racks"),
];
/// Before a noun.
#[rustfmt::skip]
const DETERMINERS: &[&str] = &["the", "a", "an", "this", "that", "these", "those", "our", "my", "your", "his", "her", "their", "one", "another", "each", "every", "any", "some", "no", "new", "old", "big", "small", "little"];

/// No farther from something than follows.
#[rustfmt::skip]
const NO_FARTHER: &Phrases = &Phrases::of(&["no further from", "no farther from", "not further from", "not farther from", "no further away from", "no farther away from", "not further away from", "not farther away from", "no more distant from", "not more distant from", "closer to", "nearer to"]);
/// No nearer to something than follows.
#[rustfmt::skip]
const NO_NEARER: &Phrases = &Phrases::of(&["no closer to", "no nearer to", "not closer to", "not nearer to", "further from", "farther from", "further away from", "farther away from", "more distant from"]);
/// What a distance is from takes no more words.
const LONGEST: usize = 8;

/// How long a pace is, m.
const PACE: f64 = 0.75;

/// Parts of a tree: what is put beside, upon or inside one of them is put so to the tree.
#[rustfmt::skip]
const OF_TREE: &Phrases = &Phrases::of(&["the trunk of", "the stem of", "the bole of", "the crown of", "the branches of", "the canopy of", "the bark of", "the boughs of", "the foliage of", "the hollow trunk of", "the roots of"]);
/// Parts of a building at which something may stand.
#[rustfmt::skip]
const OF_BUILDING: &Phrases = &Phrases::of(&["the wall of", "the walls of", "the outer wall of", "the outside wall of", "the facade of", "the façade of"]);

/// Puts them as they are called.
pub(super) fn in_plain_words(lexemes: &mut Vec<Lexeme>) {
    otherwise_called(lexemes);
    by_what_it_is_for(lexemes);
    than_so_far(lexemes);
    in_metres(lexemes);
    of_the_whole(lexemes);
}

/// "Bike stand" is the bicycle rack.
fn otherwise_called(lexemes: &mut Vec<Lexeme>) {
    let mut at = 0;
    while at < lexemes.len() {
        if let Some((plain, words)) = longest(&lexemes[at..], CALLED) {
            put(lexemes, at..at + words, plain);
        }
        at += 1;
    }
}

/// "The basket for the rubbish" is the bin.
fn by_what_it_is_for(lexemes: &mut Vec<Lexeme>) {
    let mut at = 1;
    while at < lexemes.len() {
        let found = ROUNDABOUT.iter().find_map(|told| Some((told_so(lexemes, at, told)?, told.3)));
        if let Some((end, plain)) = found.filter(|_| is_led(lexemes, at)) {
            let said = word(lexemes, at);
            let plain = if said.ends_with('s') { format!("{plain}s") } else { plain.to_owned() };
            put(lexemes, at..end, &plain);
        }
        at += 1;
    }
}

/// Where the words end that begin with the noun and tell a thing so.
fn told_so(lexemes: &[Lexeme], at: usize, (nouns, links, what, _): &Roundabout) -> Option<usize> {
    let said = word(lexemes, at);
    let is_noun = |noun: &&str| {
        said == *noun || said.strip_suffix('s') == Some(*noun) || said.strip_suffix("es") == Some(*noun)
    };
    if !nouns.iter().any(is_noun) {
        return None;
    }
    let from = at + 1 + longest_phrase(lexemes.get(at + 1..)?, *links)?;
    what.contains(&word(lexemes, from)).then_some(from + 1)
}

/// Whether an article, a number or a colour stands before a noun: "stop for the bus" is none.
fn is_led(lexemes: &[Lexeme], at: usize) -> bool {
    let before = &lexemes[at - 1..at];
    DETERMINERS.contains(&word(lexemes, at - 1))
        || numbers::count(before).is_some()
        || longest(before, PAINTS).is_some()
}

/// "No further from the museum than 15 m" is within 15 m of the museum.
fn than_so_far(lexemes: &mut Vec<Lexeme>) {
    let mut at = 0;
    while at < lexemes.len() {
        let rest = &lexemes[at..];
        let near = longest_phrase(rest, NO_FARTHER).map(|words| (words, "within", "of"));
        let far = || longest_phrase(rest, NO_NEARER).map(|words| (words, "at least", "from"));
        let found = near.or_else(far).and_then(|(words, before, between)| {
            let from = at + words;
            let than = (from + 1..lexemes.len().min(from + 1 + LONGEST))
                .take_while(|than| !is_mark(&lexemes[than - 1]))
                .find(|than| word(lexemes, *than) == "than")?;
            let (_, count) = numbers::length(lexemes.get(than + 1..)?)?;
            Some((from, than, than + 1 + count, before, between))
        });
        if let Some((from, than, end, before, between)) = found {
            let place = lexemes[at].clone();
            let told: Vec<Lexeme> = words_at(&place, before)
                .chain(lexemes[than + 1..end].to_vec())
                .chain([word_at(&place, between)])
                .chain(lexemes[from..than].to_vec())
                .collect();
            lexemes.splice(at..end, told);
        }
        at += 1;
    }
}

/// "Ten paces north of me": so many metres. "Three steps" may be stairs, unless they lead somewhere.
fn in_metres(lexemes: &mut Vec<Lexeme>) {
    const PACES: &[&str] = &["pace", "paces", "stride", "strides"];
    const STEPS: &[&str] = &["step", "steps"];
    #[rustfmt::skip]
    const LEAD: &Phrases = &Phrases::of(&["to the left", "to the right", "to its left", "to its right", "left", "right", "forward", "forwards", "back", "backwards"]);
    // Who is to come closer by so many steps comes so many metres closer, as whoever walks does.
    #[rustfmt::skip]
    const CLOSER: &Phrases = &Phrases::of(&["closer", "nearer", "towards", "toward", "away", "from", "further", "farther", "off", "back from", "more away"]);
    let mut at = 0;
    while at < lexemes.len() {
        let found = numbers::number(&lexemes[at..]).filter(|(_, words)| {
            let unit = at + words;
            let behind = lexemes.get(unit + 1..).unwrap_or_default();
            let leads = || longest_phrase(behind, LEAD).is_some() || longest(behind, DIRECTIONS).is_some();
            let is_one = *words == 1 && matches!(word(lexemes, at), "a" | "an");
            let said = word(lexemes, unit);
            !is_one
                && longest_phrase(behind, CLOSER).is_none()
                && (PACES.contains(&said) || STEPS.contains(&said) && leads())
        });
        if let Some((number, words)) = found {
            let unit = word_at(&lexemes[at + words], "metres");
            let metres = Lexeme { token: Token::Number(number * PACE), lemma: None, ..lexemes[at].clone() };
            lexemes.splice(at..=at + words, [metres, unit]);
        }
        at += 1;
    }
}

/// "Inside the trunk of the lime" is inside the lime, behind a word of place and nowhere else: a trunk may be painted by itself.
fn of_the_whole(lexemes: &mut Vec<Lexeme>) {
    let mut at = 1;
    while at < lexemes.len() {
        let way = (at.saturating_sub(5)..at).find_map(|from| {
            longest(&lexemes[from..], &WAYS).filter(|(_, words)| from + words == at).map(|(way, _)| way)
        });
        let beside = matches!(
            way,
            Some(Way::To(Relation::NextTo | Relation::Near) | Way::At | Way::Along | Way::Between)
        );
        let rest = &lexemes[at..];
        let words = longest_phrase(rest, OF_TREE)
            .filter(|_| way.is_some())
            .or_else(|| longest_phrase(rest, OF_BUILDING).filter(|_| beside));
        if let Some(words) = words {
            lexemes.drain(at..at + words);
        }
        at += 1;
    }
}

/// Puts other words in the place of some, word by word where there are as many.
fn put(lexemes: &mut Vec<Lexeme>, range: std::ops::Range<usize>, plain: &str) {
    let places: Vec<Lexeme> = lexemes[range.clone()].to_vec();
    let Some(last) = places.last() else { return };
    let told: Vec<Lexeme> = plain
        .split(' ')
        .enumerate()
        .map(|(rank, part)| word_at(places.get(rank).unwrap_or(last), part))
        .collect();
    lexemes.splice(range, told);
}

/// The words of distances, for the spelling: no pace is a place.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    ["pace", "paces", "stride", "strides"].into_iter()
}

#[cfg(test)]
mod tests {
    use super::super::super::lexer::rewritten;
    use super::in_plain_words;

    fn plain(said: &str) -> String {
        rewritten(said, in_plain_words)
    }

    #[test]
    fn things_are_told_by_what_they_are_for() {
        assert_eq!(plain("remove the basket for the rubbish"), "remove the trash bin");
        assert_eq!(plain("add two baskets for litter by the oak"), "add two trash bins by the oak");
        assert_eq!(plain("on the place of market"), "on the market square");
        assert_eq!(plain("the stop of the bus"), "the bus stop");
        assert_eq!(plain("bike stand opposite the kiosk"), "bicycle rack opposite the kiosk");
        for same in [
            "stop for the bus",
            "the basket for the picnic",
            "a box for the parcel",
            "the place for the market",
        ] {
            assert_eq!(plain(same), same);
        }
    }

    #[test]
    fn distances_are_told_behind_than() {
        assert_eq!(plain("no further from the museum than 15 m"), "within 15 m of the museum");
        assert_eq!(plain("no closer to the oak than five metres"), "at least five metres from the oak");
        for same in
            ["closer to the oak than the lamp", "the bench nearer to the kiosk", "no closer to the oak"]
        {
            assert_eq!(plain(same), same);
        }
    }

    #[test]
    fn paces_are_metres() {
        assert_eq!(plain("a tent ten paces north of me"), "a tent 7.5 metres north of me");
        assert_eq!(plain("move it four steps to the left"), "move it 3 metres to the left");
        assert_eq!(plain("add three steps in front of the museum"), "add three steps in front of the museum");
    }

    #[test]
    fn what_is_put_to_a_part_is_put_to_the_whole() {
        assert_eq!(plain("put it inside the trunk of the lime"), "put it inside the lime");
        assert_eq!(plain("against the wall of the museum"), "against the museum");
        for same in ["paint the trunk of the lime white", "on the wall of the museum"] {
            assert_eq!(plain(same), same);
        }
    }
}
