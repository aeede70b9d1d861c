//! What is told so that neither the whole of a sentence nor its parts are understood, told again in plainer words.
//!
//! A table of patterns turns common turns of phrase into orders ("from A to B, one every 5 m" is "every 5 m between A and B"), and
//! clauses that only say why are left out. This is tried last, and what it makes is read as any sentence: what stays unclear stays
//! refused. No clause is left out that asks for something by itself, denies something, or that a pronoun of the rest may be about.

use super::super::compass::DIRECTIONS;
use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{category, longest, longest_phrase};
use super::super::paint::PAINTS;
use super::super::phrases::Phrases;
use super::chatty::{CHATTY, CHATTY_FIRST};
use super::forms::{word_at, words_at};
use super::parse::Reader;
use super::polite::CODA;
use super::sayings::SAYINGS;
use super::turns::{ASIDES, BEFORE_ALL, FILLERS, TURNS};
use super::words::{VERBS, Way};

/// Puts what would be misunderstood plainly, and leaves out what is said by the way.
pub(super) fn in_plain_words(lexemes: &mut Vec<Lexeme>) {
    super::occasions::leave_out(lexemes);
    let asides = without(lexemes, ASIDES);
    if asides.iter().any(|lexeme| !is_mark(lexeme)) {
        *lexemes = asides;
    }
    *lexemes = told_by(lexemes, &[BEFORE_ALL, CHATTY_FIRST]);
}

/// What begins a clause that says why or what for, behind a request.
#[rustfmt::skip]
const WHY: &Phrases = &Phrases::of(&["because", "until", "since", "so that", "otherwise", "or else", "lest", "in case", "given that", "now that", "seeing that", "seeing as", "considering", "even though", "although", "though", "so people", "so everybody", "so everyone", "so nobody",
    "so visitors", "so kids", "so children", "so students", "so customers", "so guests", "so tourists", "so the", "so we", "so i", "so you", "so they", "so he", "so she", "so it", "so my", "so our", "so no one", "so folks", "so passers", "as people", "as we", "as i", "as they", "as the", "as there", "as everybody", "as everyone",
    "as he", "as she", "as it", "as my", "as our", "as nobody", "as some", "as many", "for we", "for they", "for there", "for everybody", "for it", "whereas", "in order to", "in order that", "in preparation for", "in honour of", "in honor of", "cause", "cos", "coz", "the way", "that way", "this way", "or", "before", "to help", "to keep", "to make", "to give", "to let", "to stop", "to welcome", "to remind", "to celebrate", "to brighten", "to see", "to prevent", "to avoid", "to protect", "to ensure", "to show", "to watch", "to mark", "to catch", "to warn", "to cheer", "to attract", "to feed", "to light", "to look", "to block", "to guide", "to allow", "to be able"]);
/// Verbs of what is so, and what may stand before one.
#[rustfmt::skip]
const IS: &Phrases = &Phrases::of(&["is", "are", "was", "were", "am", "has", "have", "had", "will", "wont", "would", "can", "cant", "cannot", "could", "couldnt", "do", "dont", "does", "doesnt", "did", "didnt", "isnt", "arent", "wasnt", "havent", "hasnt", "may", "might",
    "im", "its", "thats", "theyre", "were", "theres", "ive", "weve", "theyve", "shes", "hes", "youre", "well", "mustnt", "shouldnt", "never", "always", "keep", "keeps", "go", "goes", "get", "gets", "come", "comes", "know", "knows", "love", "loves", "like", "likes", "wait", "say", "says", "think", "feel", "look", "leaves", "leave", "need", "needs",
    "want", "wants", "make", "makes", "use", "see", "gives", "distract", "meet", "bring", "help", "helps", "starts", "run", "play", "sit", "walk", "stop", "tend"]);
/// By these a clause may change what the rest asks for.
#[rustfmt::skip]
const CHANGES: &Phrases = &Phrases::of(&["not the", "not a", "not that", "not those", "not these", "except", "only", "unless", "instead", "rather than", "but", "please", "apart from", "other than", "but not", "if", "until", "when", "twice", "half", "double", "as well", "the same", "another", "one more", "remove", "paint", "add", "delete", "i mean",
    "scratch that", "no wait", "wait no", "actually", "correction", "sorry", "undo", "never mind", "forget it", "forget that", "stop it", "leave it", "leave them", "should", "must", "ought", "lets", "instead", "either", "neither", "or the"]);
/// Words of the rest that may be about what is left out.
const OPEN: &[&str] = &[
    "it", "its", "them", "him", "her", "his", "their", "one", "ones", "there", "they", "that", "those",
    "these", "this", "he", "she", "another", "same", "both", "other", "others", "too", "also",
];
/// What begins a request that is no order.
#[rustfmt::skip]
const REQUESTS: &Phrases = &Phrases::of(&["can", "could", "would", "will", "may", "how", "what", "which", "where", "who", "please", "let", "lets", "i want", "i need", "we need", "we want", "id like", "wed like", "i would like", "we would like", "there should", "there must", "why not", "is there", "are there", "if", "unless", "when", "and", "or", "but", "then", "id", "wed", "kindly", "no", "not"]);

impl Reader<'_> {
    /// The words told otherwise, in all ways that differ from how they were said, the nearest first.
    pub(super) fn retold(&self) -> Vec<Vec<Lexeme>> {
        let turned = told_plainly(&without(&without(self.lexemes, FILLERS), ASIDES));
        let without_why = told_plainly(&self.without_why(&turned));
        let requests = told_plainly(&self.requests(&without_why));
        let for_nobody = self.without_whom(&turned);
        let bare = self.without_idle_clauses(&turned).map(|bare| told_plainly(&bare));
        let bare_without_why = bare.as_ref().map(|bare| told_plainly(&self.without_why(bare)));
        let mut ways: Vec<Vec<Lexeme>> = Vec::new();
        let plainer = [turned, for_nobody, without_why, requests];
        for way in plainer.into_iter().chain(bare).chain(bare_without_why) {
            let said =
                |lexemes: &[Lexeme]| lexemes.iter().map(|lexeme| lexeme.token.clone()).collect::<Vec<_>>();
            let is_new =
                said(&way) != said(self.lexemes) && ways.iter().all(|other| said(other) != said(&way));
            if is_new && way.iter().any(|lexeme| !is_mark(lexeme)) {
                ways.push(way);
            }
        }
        ways
    }

    /// The words without whom or what something is for, where that names nothing: "for the helpers", "for my little ones".
    fn without_whom(&self, lexemes: &[Lexeme]) -> Vec<Lexeme> {
        const FOR: &Phrases = &Phrases::of(&[
            "for the",
            "for my",
            "for our",
            "for his",
            "for her",
            "for their",
            "for all the",
            "for those",
            "for these",
        ]);
        const LONGEST: usize = 5;
        let reader = Reader { lexemes, at: 0, ..*self };
        let mut kept: Vec<Lexeme> = Vec::with_capacity(lexemes.len());
        let mut at = 0;
        while at < lexemes.len() {
            let end = (at..lexemes.len()).find(|end| is_mark(&lexemes[*end])).unwrap_or(lexemes.len());
            let is_whom = at > 0
                && longest_phrase(&lexemes[at..], FOR).is_some()
                && end <= at + LONGEST
                && reader.names_nothing(at + 1, end);
            if is_whom {
                at = end;
            } else {
                kept.push(lexemes[at].clone());
                at += 1;
            }
        }
        kept
    }

    /// The words without the clauses that only say why, each of which ends where its sentence does or something else is asked for.
    fn without_why(&self, lexemes: &[Lexeme]) -> Vec<Lexeme> {
        let mut kept: Vec<Lexeme> = Vec::with_capacity(lexemes.len());
        for sentence in sentences(lexemes) {
            let mut rest = sentence.to_vec();
            if let Some(cut) = before_so(&rest)
                && self.is_idle_clause(&rest[..cut.0], &rest[cut.1..], true)
            {
                rest.drain(..cut.1);
            }
            let front = longest_phrase(
                &rest,
                &[
                    "because",
                    "since",
                    "as",
                    "now that",
                    "given that",
                    "seeing that",
                    "considering",
                    "while",
                    "although",
                ],
            );
            if front.is_some()
                && let Some(comma) = rest.iter().position(|lexeme| lexeme.token == Token::Comma)
                && self.is_idle_clause(&rest[..comma], &rest[comma + 1..], true)
            {
                rest.drain(..=comma);
            }
            let why = (2..rest.len()).find(|at| longest_phrase(&rest[*at..], WHY).is_some());
            if let Some(at) = why {
                let end =
                    (at + 2..rest.len()).find(|at| goes_on(&rest[*at..])).unwrap_or_else(|| last_mark(&rest));
                if at < end && self.is_idle_clause(&rest[at + 1..end], &rest[..at], false) {
                    let from = if is_mark(&rest[at - 1]) { at - 1 } else { at };
                    rest.drain(from..end);
                }
            }
            kept.extend(rest);
        }
        kept
    }

    /// The sentences and the parts between commas that ask for something, without those that only tell.
    fn requests(&self, lexemes: &[Lexeme]) -> Vec<Lexeme> {
        let mut units: Vec<&[Lexeme]> = lexemes.split_inclusive(is_mark).collect();
        let words_of =
            |unit: &[Lexeme]| unit.iter().filter(|lexeme| !is_mark(lexeme)).cloned().collect::<Vec<_>>();
        let mut at = 0;
        while at < units.len() {
            let unit = words_of(units[at]);
            let others: Vec<Lexeme> = units[at + 1..].concat();
            let is_told = units.len() > 1
                && !unit.is_empty()
                && longest(&unit, &VERBS).is_none()
                && longest_phrase(&unit, REQUESTS).is_none()
                && self.is_idle_clause(&unit, &others, at + 1 < units.len());
            if is_told {
                units.remove(at);
            } else {
                at += 1;
            }
        }
        units.concat()
    }

    /// Whether a clause tells something, asks for nothing that is understood, and leaves the rest of the sentence as it is.
    fn is_idle_clause(&self, clause: &[Lexeme], rest: &[Lexeme], is_before: bool) -> bool {
        let any =
            |phrases: &Phrases| (0..clause.len()).any(|at| longest_phrase(&clause[at..], phrases).is_some());
        let is_open =
            |lexeme: &Lexeme| matches!(&lexeme.token, Token::Word(word) if OPEN.contains(&word.as_str()));
        let paints = (0..clause.len()).any(|at| longest(&clause[at..], PAINTS).is_some());
        let may_be_about = is_before && rest.iter().any(is_open);
        let tells = || {
            let reader = Reader { lexemes: clause, at: 0, ..*self };
            reader.names_nothing(0, clause.len()) && reader.tells_with_verb(0, clause.len())
        };
        clause.len() > 1
            && longest_phrase(clause, super::told::ORDERS_ANYTHING).is_none()
            && (any(IS) || tells())
            && !any(CHANGES)
            && !super::margins::tells_room(clause)
            && !paints
            && !may_be_about
            && !self.is_wish(clause)
    }

    /// Whether words are a request by themselves.
    fn is_wish(&self, words: &[Lexeme]) -> bool {
        let memo = super::memo::Memo::default();
        Reader {
            lexemes: words,
            at: 0,
            memo: &memo,
            depth: self.depth,
            words: self.words,
            names: self.names,
            view: self.view,
        }
        .sentence()
        .is_ok()
    }
}

/// Without what adds nothing, and the commas around it.
fn without(lexemes: &[Lexeme], asides: &Phrases) -> Vec<Lexeme> {
    let mut kept: Vec<Lexeme> = Vec::with_capacity(lexemes.len());
    let mut at = 0;
    while at < lexemes.len() {
        if let Some(words) = longest_phrase(&lexemes[at..], asides) {
            at += words;
            let is_aside = kept.last().is_none_or(is_mark);
            while is_aside && lexemes.get(at).is_some_and(|lexeme| lexeme.token == Token::Comma) {
                at += 1;
            }
        } else {
            kept.push(lexemes[at].clone());
            at += 1;
        }
    }
    // "And, while I'm at it, a bench": the mark that is left says nothing.
    let goes_on = |lexeme: &Lexeme| matches!(&lexeme.token, Token::Word(word) if ["and", "but", "so", "then"].contains(&word.as_str()));
    let mut at = 1;
    while kept.len() < lexemes.len() && at < kept.len() {
        if kept[at].token == Token::Comma && goes_on(&kept[at - 1]) {
            kept.remove(at);
        } else {
            at += 1;
        }
    }
    kept
}

/// The sentences, each with the mark at its end.
pub(super) fn sentences(lexemes: &[Lexeme]) -> impl Iterator<Item = &[Lexeme]> {
    lexemes.split_inclusive(|lexeme| lexeme.token == Token::Break)
}

/// Where the marks at the end begin.
pub(super) fn last_mark(lexemes: &[Lexeme]) -> usize {
    lexemes.iter().rposition(|lexeme| !is_mark(lexeme)).map_or(0, |last| last + 1)
}

/// Whether something else is asked for from here on: ", and put ...", "then move ...".
fn goes_on(rest: &[Lexeme]) -> bool {
    let marks = rest.iter().take_while(|lexeme| is_mark(lexeme)).count();
    let joint =
        longest_phrase(&rest[marks..], &["and", "then", "and then", "also", "and also", "plus", "please"]);
    joint.is_some_and(|words| rest.get(marks + words..).is_some_and(|rest| longest(rest, &VERBS).is_some()))
}

/// Where a clause ends before "so", and where what follows from it begins.
fn before_so(lexemes: &[Lexeme]) -> Option<(usize, usize)> {
    let is = |at: usize, said: &str| matches!(lexemes.get(at).map(|lexeme| &lexeme.token), Some(Token::Word(word)) if word == said);
    let so = (2..lexemes.len())
        .find(|at| is(*at, "so") && !is(at + 1, "that") && !is(at + 1, "many") && !is(at + 1, "much"))?;
    let end = if lexemes[so - 1].token == Token::Comma { so - 1 } else { so };
    Some((end, so + 1))
}

/// A table of turns of phrase.
pub(super) type Turns = [(&'static str, &'static str)];

/// Each sentence by the turns of phrase of all tables.
fn told_plainly(lexemes: &[Lexeme]) -> Vec<Lexeme> {
    told_by(lexemes, &[TURNS, SAYINGS, CHATTY])
}

/// Each sentence by the first turn of phrase that it is, two of them at most.
pub(super) fn told_by(lexemes: &[Lexeme], tables: &[&Turns]) -> Vec<Lexeme> {
    let mut told = Vec::with_capacity(lexemes.len());
    let turned = |words: &[Lexeme]| {
        tables.iter().copied().flatten().find_map(|(said, meant)| by_turn(words, said, meant))
    };
    for sentence in sentences(lexemes) {
        let end = last_mark(sentence);
        let mut words = sentence[..end].to_vec();
        for _ in 0..2 {
            // "Cones from the hydrant to the bus stop every four metres, please".
            let kindly = || before_kind_words(&words).and_then(|end| turned(&words[..end]));
            if let Some(other) = turned(&words).or_else(kindly) {
                words = other;
            }
        }
        told.extend(words);
        told.extend_from_slice(&sentence[end..]);
    }
    told
}

/// Where words of politeness begin behind the last comma, if nothing else stands there.
pub(super) fn before_kind_words(words: &[Lexeme]) -> Option<usize> {
    let comma = words.iter().rposition(|lexeme| lexeme.token == Token::Comma).filter(|comma| *comma > 0)?;
    (longest_phrase(&words[comma + 1..], CODA) == Some(words.len() - comma - 1)).then_some(comma)
}

/// What the words mean by a turn of phrase, if they are one.
pub(super) fn by_turn(words: &[Lexeme], said: &str, meant: &str) -> Option<Vec<Lexeme>> {
    let pattern: Vec<&str> = said.split(' ').collect();
    // Most patterns have a word that the sentence has not.
    let is_said =
        |word: &&str| words.iter().any(|lexeme| matches!(&lexeme.token, Token::Word(own) if own == word));
    let may_fit = |part: &&str| {
        part.len() == 1 && !["a", "i"].contains(part)
            || part.split('|').any(|word| matches!(word, "-" | "," | ".") || is_said(&word))
    };
    if !pattern.iter().all(may_fit) {
        return None;
    }
    let mut bound = Vec::new();
    if !fits(words, 0, &pattern, &mut bound) {
        return None;
    }
    let place = words.first()?;
    let mut made = Vec::new();
    for part in meant.split(' ') {
        if let Some((_, from, to)) = bound.iter().find(|(name, ..)| *name == part) {
            made.extend_from_slice(&words[*from..*to]);
        } else if part == "," {
            made.push(Lexeme { token: Token::Comma, lemma: None, ..place.clone() });
        } else {
            made.extend(words_at(place, part));
        }
    }
    // "On Anna's left" keeps its side.
    if let Some(at) =
        made.iter().position(|lexeme| matches!(&lexeme.token, Token::Word(word) if word == "left"))
        && words.iter().any(|lexeme| matches!(&lexeme.token, Token::Word(word) if word == "right"))
        && !words.iter().any(|lexeme| matches!(&lexeme.token, Token::Word(word) if word == "left"))
    {
        made[at] = word_at(&made[at], "right");
    }
    Some(made)
}

type Bound<'p> = Vec<(&'p str, usize, usize)>;

/// Whether all words from one on are what a pattern says; the words of its capitals are kept.
fn fits<'p>(words: &[Lexeme], at: usize, pattern: &[&'p str], bound: &mut Bound<'p>) -> bool {
    let Some((first, rest)) = pattern.split_first() else { return at == words.len() };
    let is_any = first.len() == 1 && first.starts_with(|letter: char| letter.is_ascii_uppercase());
    if !is_any {
        let here = words.get(at).is_some_and(|lexeme| match &lexeme.token {
            Token::Comma => first.split('|').any(|said| said == ","),
            Token::Break => first.split('|').any(|said| said == "."),
            Token::Word(word) => first.split('|').any(|said| said == word),
            _ => false,
        });
        let is_left_out = first.split('|').any(|word| word == "-");
        return here && fits(words, at + 1, rest, bound) || is_left_out && fits(words, at, rest, bound);
    }
    let is_open = ["O", "P", "Q"].contains(first);
    let least = usize::from(!is_open);
    let most = if ["M", "D", "E", "X"].contains(first) { 3 } else { words.len() - at };
    for count in least..=most.min(words.len() - at) {
        let part = &words[at..at + count];
        // The comma of "(3, 4)" ends nothing.
        let ends = |at: usize| is_mark(&words[at]) && !(at > 1 && words[at - 2].token == Token::Open);
        if !is_open && (at..at + count).any(ends) {
            break;
        }
        if *first == "M" && !is_measure(part)
            || ["D", "E"].contains(first) && !is_new(part)
            || *first == "O" && !may_order(part)
            || !is_of_kind(first, part)
        {
            continue;
        }
        bound.push((first, at, at + count));
        if fits(words, at + count, rest, bound) {
            return true;
        }
        bound.pop();
    }
    false
}

/// Whether words are what a capital of the table stands for.
fn is_of_kind(capital: &str, words: &[Lexeme]) -> bool {
    let whole = |found: Option<usize>| found == Some(words.len());
    match capital {
        "K" => whole(longest(words, PAINTS).map(|(_, count)| count)),
        "G" => longest(words, &VERBS).is_none(),
        "H" => {
            category(words).is_some_and(|(_, count)| count == words.len())
                || matches!(words, [only] if super::follow::species(only).is_some())
        }
        "F" => {
            let times = || super::sizes::factor_in_numbers(words).map(|(_, count)| count);
            whole(longest(words, &super::words::FACTORS).map(|(_, count)| count)) || whole(times())
        }
        "Y" | "Z" => {
            whole(longest(words, &super::words::SKIES).map(|(_, count)| count))
                || whole(super::sky::hour(words).map(|(_, count)| count))
        }
        "U" => matches!(words, [Lexeme { token: Token::Word(word), .. }] if word.ends_with("est")),
        "W" => is_somewhere(words),
        "R" => whole(longest(words, &super::words::WAYS).map(|(_, count)| count)),
        "N" | "V" => {
            words.len() > 1
                && longest_phrase(words, &["the", "that", "this", "my", "our", "these", "those", "both"])
                    .is_some()
        }
        "X" => !(0..words.len()).any(|at| longest(&words[at..], &super::words::WAYS).is_some()),
        _ => true,
    }
}

/// "Behind the school", and neither "behind" nor "behind the".
pub(super) fn is_somewhere(words: &[Lexeme]) -> bool {
    let is_compass = longest(words, DIRECTIONS).is_some_and(|(_, count)| {
        longest_phrase(&words[count..], &["of"]).is_some_and(|of| words.len() > count + of + 1)
    });
    is_compass
        || longest(words, &super::words::WAYS).is_some_and(|(way, count)| {
            let rest = &words[count..];
            let the = longest_phrase(rest, &["the", "a", "an", "my", "our", "this", "that"]).unwrap_or(0);
            match way {
                Way::Here | Way::There => rest.is_empty() || is_somewhere(rest),
                _ => !super::repairs::needs_anchor(way) || rest.len() > the,
            }
        })
}

/// Whether an order may follow: "they have a bench" is none.
fn may_order(words: &[Lexeme]) -> bool {
    words.last().is_none_or(|last| {
        is_mark(last)
            || matches!(&last.token, Token::Word(word) if ["please", "kindly", "you", "and", "then", "so", "now", "just", "also", "lets", "to"].contains(&word.as_str()))
    })
}

/// "A", "one", "a pair of", "two".
pub(super) fn is_new(words: &[Lexeme]) -> bool {
    let article = longest_phrase(words, &["a", "an", "one", "some", "another"]) == Some(words.len());
    article || super::super::numbers::count(words).is_some_and(|(_, count)| count == words.len())
}

/// "Five metres".
fn is_measure(words: &[Lexeme]) -> bool {
    const UNITS: &[&str] =
        &["m", "metre", "metres", "meter", "meters", "feet", "foot", "ft", "yards", "yard", "steps", "paces"];
    let unit = |lexeme: &Lexeme| matches!(&lexeme.token, Token::Word(word) if UNITS.contains(&word.as_str()));
    words.len() > 1
        && words.last().is_some_and(unit)
        && super::super::numbers::number(words).is_some_and(|(_, count)| count + 1 == words.len())
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    let phrases = [FILLERS, ASIDES, WHY, IS, CHANGES, REQUESTS]
        .into_iter()
        .flatten()
        .flat_map(|phrase| phrase.split(' '));
    let turns = TURNS.iter().flat_map(|(said, _)| said.split([' ', '|']));
    phrases.chain(turns.filter(|word| word.len() > 1))
}
