//! Phrases that say which of several is meant, put as they are read: "the trees over ten metres" are those that are taller, "the statue's
//! nearest tree" is the tree nearest to the statue, "the benches that aren't on the square" are all but those on it.
//!
//! They are put so before the words are read, for they say the same in every sentence.

use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{category, longest, longest_phrase};
use super::super::names::Names;
use super::super::numbers;
use super::super::phrases::Phrases;
use super::buyers;
use super::follow::species;
use super::forms::{word, word_at, words_at};
use super::words::{VERBS, Verb, WAYS};

/// A clause between two commas is no longer than that.
const LONGEST_CLAUSE: usize = 11;
/// Before a noun of which it is said which are meant.
const WHICH: &[&str] = &["the", "all", "every", "any", "which", "what", "those", "these", "each", "no", "of"];
/// What is not meant, behind a comma that adds nothing.
#[rustfmt::skip]
const EXCEPT: &Phrases = &Phrases::of(&["except the", "except for the", "except that", "except for that", "except those", "except for those", "apart from the", "apart from that", "other than the", "with the exception of the", "excluding the", "except my", "except for my"]);
/// Of what there is too much, where "to" is a slip.
#[rustfmt::skip]
const TOO_MUCH: &[&str] = &["small", "big", "tall", "short", "large", "high", "low", "dark", "bright", "loud", "dull", "tiny", "huge", "narrow", "wide", "ugly", "cold", "hot", "far", "boring", "plain", "old", "heavy", "little", "late", "early"];

/// Puts the words so.
pub(super) fn in_plain_words(words: &str, lexemes: &mut Vec<Lexeme>, names: &Names<'_>) {
    super::likened::in_plain_words(lexemes);
    told_besides(lexemes);
    of_whom(words, lexemes);
    nearest_to(lexemes, names);
    by_measure(lexemes);
    not_there(lexemes);
    named_twice(lexemes);
    exclaimed(words, lexemes);
    needed_for(lexemes);
    beside_somebody(lexemes);
    nearest_of_place(lexemes);
    both_of_them(lexemes);
    offers(lexemes, names);
    sellers(lexemes);
    of_one_noun(lexemes);
    let is = |lexeme: &Lexeme, word: &str| matches!(&lexeme.token, Token::Word(own) if own == word);
    let mut at = 1;
    while at + 1 < lexemes.len() {
        if is(&lexemes[at], "too") && is(&lexemes[at - 1], "next") && is_begun(&lexemes[at + 1]) {
            lexemes[at] = word_at(&lexemes[at].clone(), "to");
        }
        // "Remove the bins, except for the one by the stop".
        if at > 1 && lexemes[at].token == Token::Comma && longest_phrase(&lexemes[at + 1..], EXCEPT).is_some()
        {
            lexemes.remove(at);
        } else if is(&lexemes[at], "to")
            && (is(&lexemes[at - 1], "is") || is(&lexemes[at - 1], "are") || is(&lexemes[at - 1], "its"))
            && matches!(&lexemes[at + 1].token, Token::Word(word) if TOO_MUCH.contains(&word.as_str()))
            && lexemes.get(at + 2).is_none_or(|next| is_mark(next) || is(next, "and") || is(next, "for"))
        {
            lexemes[at] = word_at(&lexemes[at].clone(), "too");
        }
        at += 1;
    }
}

/// "Delete the sign, which nobody reads, and ...": the clause between two commas tells and asks for nothing; where it says where
/// something is, it says which is meant.
fn told_besides(lexemes: &mut Vec<Lexeme>) {
    #[rustfmt::skip]
    const ASKS: &Phrases = &Phrases::of(&["should", "must", "needs", "need", "has to", "have to", "ought", "would", "could", "can", "goes", "is to", "are to", "shall", "wants", "lacks", "deserves"]);
    const IS: &Phrases = &Phrases::of(&["is", "are", "stands", "stand", "sits", "is parked", "is standing"]);
    let mut at = 1;
    while at + 3 < lexemes.len() {
        // "The van green and, why not, the taxi pink".
        if lexemes[at].token == Token::Comma
            && longest_phrase(&lexemes[at + 1..], &["why not"]).is_some()
            && lexemes[at + 3].token == Token::Comma
        {
            lexemes.drain(at..=at + 3);
            continue;
        }
        let begins = lexemes[at].token == Token::Comma && matches!(word(lexemes, at + 1), "which" | "who");
        let end = lexemes[at + 1..].iter().position(is_mark).map(|mark| at + 1 + mark);
        let Some(end) = end.filter(|end| {
            begins
                && lexemes[*end].token == Token::Comma
                && end - at <= LONGEST_CLAUSE
                && end + 1 < lexemes.len()
        }) else {
            at += 1;
            continue;
        };
        let clause = &lexemes[at + 2..end];
        let where_it_is = longest_phrase(clause, IS).filter(|is| longest(&clause[*is..], &WAYS).is_some());
        if where_it_is.is_some() {
            lexemes.remove(end);
            lexemes.remove(at);
        } else if longest_phrase(clause, ASKS).is_none() {
            let next = &lexemes[end + 1..];
            let goes_on = longest_phrase(
                next,
                &[
                    "and", "then", "but", "so", "plus", "or", "the", "a", "an", "please", "could", "can",
                    "would",
                ],
            )
            .is_some()
                || longest(next, &VERBS).is_some();
            lexemes.drain(if goes_on { at..end } else { at..end + 1 });
        }
        at += 1;
    }
}

/// "The statue's nearest tree", "at the clinic's front", "the library's door".
fn of_whom(words: &str, lexemes: &mut Vec<Lexeme>) {
    let is_owner = |lexeme: &Lexeme| {
        let written = words.get(lexeme.start..lexeme.end).unwrap_or_default();
        written.ends_with("'s") || written.ends_with("’s")
    };
    let mut at = 1;
    while at + 1 < lexemes.len() {
        let next = word(lexemes, at + 1).to_owned();
        let is_end = |at: usize| {
            lexemes.get(at).is_none_or(|lexeme| is_mark(lexeme) || matches!(&lexeme.token, Token::Word(word) if ["and", "please", "then", "too", "would", "will", "thanks"].contains(&word.as_str())))
        };
        if !is_owner(&lexemes[at]) {
            at += 1;
            continue;
        }
        let place = lexemes[at].clone();
        let from = (at.saturating_sub(3)..at)
            .rev()
            .find(|from| matches!(word(lexemes, *from), "the" | "that" | "this" | "our" | "my"))
            .unwrap_or(at);
        let stem = word(lexemes, at).strip_suffix('s').unwrap_or_default().to_owned();
        let owner: Vec<Lexeme> = lexemes[from..at].iter().cloned().chain([word_at(&place, &stem)]).collect();
        let noun = category(&lexemes[at + 2..]).map_or(0, |(_, words)| words);
        if matches!(next.as_str(), "nearest" | "closest") && noun > 0 {
            let said = lexemes[at + 2..at + 2 + noun].to_vec();
            let plain: Vec<Lexeme> = std::iter::once(word_at(&place, "the"))
                .chain(said)
                .chain(words_at(&place, "nearest to"))
                .chain(owner)
                .collect();
            lexemes.splice(from..at + 2 + noun, plain);
        } else if next == "front"
            && from > 0
            && is_end(at + 2)
            && matches!(word(lexemes, from - 1), "for" | "at" | "to" | "on" | "by")
        {
            let plain: Vec<Lexeme> = words_at(&place, "in front of").chain(owner).collect();
            lexemes.splice(from - 1..at + 2, plain);
        } else if matches!(next.as_str(), "entrance" | "doorstep" | "doorway") {
            lexemes.splice(from..at + 2, owner);
        } else if next == "door" && from < at {
            let plain: Vec<Lexeme> = words_at(&place, "the door of").chain(owner).collect();
            lexemes.splice(from..at + 2, plain);
        }
        at += 1;
    }
}

/// "The bench Gus is closest to" is the bench nearest to Gus.
fn nearest_to(lexemes: &mut Vec<Lexeme>, names: &Names<'_>) {
    let found = (2..lexemes.len().saturating_sub(2)).find_map(|is| {
        let says = matches!(word(lexemes, is), "is" | "stands" | "sits" | "lives")
            && matches!(word(lexemes, is + 1), "closest" | "nearest")
            && word(lexemes, is + 2) == "to";
        // "The bench is closest to the fountain" says so of the bench.
        let behind = lexemes.get(is + 3..).unwrap_or_default();
        let is_open = longest_phrase(
            behind,
            &["the", "a", "an", "my", "our", "this", "that", "it", "him", "her", "me", "us", "them"],
        )
        .is_none()
            && names.exact(behind).is_none();
        if !says || !is_open {
            return None;
        }
        let ends_noun = |at: usize| {
            (at.saturating_sub(3)..at)
                .any(|from| category(&lexemes[from..at]).is_some_and(|(_, words)| from + words == at))
        };
        (is.saturating_sub(5).max(1)..is).find_map(|who| {
            let that = usize::from(matches!(word(lexemes, who - 1), "that" | "which"));
            let is_whole = names.exact(&lexemes[who..is]).is_some_and(|(_, words)| who + words == is)
                || matches!(word(lexemes, who), "the" | "my" | "our");
            (is_whole && ends_noun(who - that)).then_some((who, that, is))
        })
    });
    let Some((who, that, is)) = found else { return };
    let place = lexemes[is].clone();
    let somebody = lexemes[who..is].to_vec();
    let plain: Vec<Lexeme> = words_at(&place, "nearest to").chain(somebody).collect();
    lexemes.splice(who - that..is + 3, plain);
}

/// Whether a noun of things ends before a word that says which are meant.
pub(super) fn ends_which(lexemes: &[Lexeme], at: usize) -> bool {
    (at.saturating_sub(2)..at).rev().any(|from| {
        let noun = category(&lexemes[from..at]).is_some_and(|(_, words)| from + words == at)
            || from + 1 == at && species(&lexemes[from]).is_some();
        noun && (from.saturating_sub(3)..from).any(|at| WHICH.contains(&word(lexemes, at)))
    })
}

/// "All trees over ten metres" are those that are taller.
fn by_measure(lexemes: &mut Vec<Lexeme>) {
    let mut at = 1;
    while at + 2 < lexemes.len() {
        let than = match word(lexemes, at) {
            "over" | "above" => "taller than",
            "under" | "below" => "shorter than",
            _ => {
                at += 1;
                continue;
            }
        };
        let noun = if matches!(word(lexemes, at - 1), "are" | "is") { at - 1 } else { at };
        let measure = numbers::length(&lexemes[at + 1..]).filter(|(_, words)| *words > 1);
        if let Some((_, words)) = measure.filter(|_| ends_which(lexemes, noun)) {
            let behind = at + 1 + words;
            let tall =
                longest_phrase(lexemes.get(behind..).unwrap_or_default(), &["tall", "high", "in height"]);
            lexemes.drain(behind..behind + tall.unwrap_or(0));
            let place = lexemes[at].clone();
            let plain: Vec<Lexeme> = words_at(&place, than).collect();
            lexemes.splice(at..=at, plain);
        }
        at += 1;
    }
}

/// "All benches that aren't on the square" are all but those on it.
fn not_there(lexemes: &mut Vec<Lexeme>) {
    #[rustfmt::skip]
    const NOT: &Phrases = &Phrases::of(&["that are not", "that arent", "that is not", "that isnt", "which are not", "which arent", "which isnt", "which is not", "not"]);
    let mut at = 1;
    while at + 1 < lexemes.len() {
        let words = longest_phrase(&lexemes[at..], NOT)
            .filter(|words| longest(lexemes.get(at + words..).unwrap_or_default(), &WAYS).is_some());
        if let Some(words) = words.filter(|_| ends_which(lexemes, at)) {
            let place = lexemes[at].clone();
            let plain: Vec<Lexeme> = words_at(&place, "except the ones").collect();
            lexemes.splice(at..at + words, plain);
        }
        at += 1;
    }
}

/// "By the scooter, the green scooter" is by the green scooter.
fn named_twice(lexemes: &mut Vec<Lexeme>) {
    let found = (2..lexemes.len().saturating_sub(3)).find(|at| {
        let noun = word(lexemes, at - 1);
        lexemes[*at].token == Token::Comma
            && !noun.is_empty()
            && word(lexemes, at - 2) == "the"
            && word(lexemes, at + 1) == "the"
            && word(lexemes, at + 3) == noun
            && lexemes.get(at + 4).is_none_or(is_mark)
            && longest(&lexemes[at + 2..at + 3], super::super::paint::PAINTS).is_some()
    });
    if let Some(at) = found {
        lexemes.drain(at - 2..=at);
    }
}

/// "Is that mailbox tiny!" says that it is.
fn exclaimed(words: &str, lexemes: &mut Vec<Lexeme>) {
    let starts = |at: usize| at == 0 || is_mark(&lexemes[at - 1]);
    let found = (0..lexemes.len()).filter(|at| starts(*at)).find_map(|at| {
        let is_said = word(lexemes, at) == "is" && matches!(word(lexemes, at + 1), "that" | "this" | "the");
        let end = at + lexemes[at..].iter().position(is_mark)?;
        let cries = words.get(lexemes[end].start..).is_some_and(|mark| mark.starts_with('!'));
        let (_, noun) = category(lexemes.get(at + 2..end)?).filter(|_| is_said && cries)?;
        (at + 2 + noun < end).then_some((at, at + 2 + noun))
    });
    if let Some((at, behind)) = found {
        let is = lexemes[at].clone();
        lexemes.insert(behind, is);
        lexemes.remove(at);
    }
}

/// "The robot needs a charger: a charging point two metres west of it", "Dmitri deserves a seat, so stick a chair next to him": one thing is
/// asked for, by its place.
fn needed_for(lexemes: &mut Vec<Lexeme>) {
    #[rustfmt::skip]
    const NEEDS: &Phrases = &Phrases::of(&["needs a", "needs an", "wants a", "wants an", "could use a", "could do with a", "requires a", "is missing a", "lacks a", "deserves a", "deserves an", "wants something", "needs something", "wants somewhere", "needs somewhere", "deserves something"]);
    let Some(mark) = lexemes.iter().position(is_mark) else { return };
    let is_way = |at: usize| longest(&lexemes[at..], &WAYS);
    let needs = (1..mark).find(|at| longest_phrase(&lexemes[*at..mark], NEEDS).is_some());
    let Some(needs) = needs.filter(|needs| !(needs + 2..mark).any(|at| is_way(at).is_some())) else { return };
    let tail =
        mark + 1 + longest_phrase(&lexemes[mark + 1..], &["so", "so please", "please", "then"]).unwrap_or(0);
    let Some(rest) = lexemes.get(tail..).filter(|rest| !rest.is_empty()) else { return };
    let is_new = longest_phrase(rest, &["a", "an"]).is_some()
        || numbers::count(rest).is_some()
        || longest(rest, &VERBS).is_some_and(|(verb, _)| matches!(verb, Verb::Add | Verb::Put));
    let it = (tail + 1..lexemes.len()).find(|at| {
        matches!(word(lexemes, *at), "it" | "him" | "her" | "them")
            && (at.saturating_sub(4)..*at)
                .any(|from| is_way(from).is_some_and(|(_, count)| from + count == *at))
    });
    let says_one = (tail..lexemes.len()).any(|at| matches!(word(lexemes, at), "one" | "another"));
    let Some(it) = it.filter(|_| is_new && !says_one) else { return };
    let whose = lexemes[..needs].to_vec();
    lexemes.splice(it..=it, whose);
    lexemes.drain(..tail);
}

/// Whether a thing is named from here on.
fn is_begun(lexeme: &Lexeme) -> bool {
    matches!(&lexeme.token, Token::Word(word) if ["the", "a", "an", "my", "our", "that", "this"].contains(&word.as_str()))
}

/// "The one that sells salad", "the building with the ice cream", "the stand where you get coffee": the building that sells what is known to be
/// sold here.
fn offers(lexemes: &mut Vec<Lexeme>, names: &Names<'_>) {
    #[rustfmt::skip]
    const PLACES: &[&str] = &["building", "shop", "store", "house", "place", "one", "stand", "stall", "spot", "booth", "kiosk", "counter", "joint", "outlet"];
    #[rustfmt::skip]
    const OFFERS: &Phrases = &Phrases::of(&["that sells", "which sells", "that sell", "selling", "that has", "which has", "that offers", "which offers", "offering", "that serves", "which serves", "serving", "that makes", "which makes", "that does", "which does", "that bakes", "which bakes",
        "where they sell", "where they have", "where they serve", "where they make", "where they offer", "where they do", "where they bake", "where you get", "where you can get", "where you buy", "where you can buy", "where you find", "where you can find", "where i get", "where i can get", "where i buy",
        "where i can buy", "where we get", "where we can get", "where we buy", "where we can buy", "where one gets", "where one can get", "where one buys", "where one can buy", "where people get", "where people buy", "where people can get", "where people can buy", "where there is", "where theres", "you get", "i get"]);
    const WITH: &Phrases = &Phrases::of(&["with", "with all", "for"]);
    #[rustfmt::skip]
    const ARTICLES: &Phrases = &Phrases::of(&["a", "an", "some", "the", "their", "your", "my", "our", "a cup of", "a piece of", "a slice of", "a loaf of", "a bottle of", "a bowl of", "a mug of", "good", "fresh", "the good", "the fresh", "the best", "cold", "hot", "the cold", "the hot"]);
    let mut at = 1;
    while at + 2 < lexemes.len() {
        let noun = word(lexemes, at);
        let is_the = |at: usize| matches!(word(lexemes, at), "the" | "that" | "this" | "our" | "your");
        let is_led = is_the(at - 1) || noun != "one" && at > 1 && is_the(at - 2);
        // "The Kiosk that sells newspapers" is called so, and so is "the Corner Shop".
        let is_name = || names.exact(&lexemes[at..]).or_else(|| names.exact(&lexemes[at - 1..])).is_some();
        let is_place = is_led && PLACES.contains(&noun) && !is_name();
        let behind = &lexemes[at + 1..];
        let with = || longest_phrase(behind, WITH).filter(|_| noun != "one");
        let goods = longest_phrase(behind, OFFERS)
            .or_else(|| buyers::where_they_buy(behind))
            .or_else(with)
            .filter(|_| is_place)
            .and_then(|words| {
                let sold = &behind[words..];
                let article = longest_phrase(sold, ARTICLES).unwrap_or(0);
                let (goods, _) = names.goods(&sold[article..])?;
                // Where only one sells it, it is meant, whatever kind of building it is.
                let is_class = matches!(noun, "shop" | "store") && names.sellers(&goods).len() > 1;
                let class = if is_class { noun } else { "building" };
                Some((at + 1 + words + article, format!("{class} that sells")))
            });
        if let Some((from, plainly)) = goods {
            let place = lexemes[at].clone();
            let plain: Vec<Lexeme> = words_at(&place, &plainly).collect();
            lexemes.splice(at..from, plain);
        }
        at += 1;
    }
}

/// "The place that sells cake" is a building that does, and "where one can buy" is where you can.
fn sellers(lexemes: &mut Vec<Lexeme>) {
    #[rustfmt::skip]
    const SELLS: &Phrases = &Phrases::of(&["that sells", "which sells", "selling", "where they sell", "where you can buy", "where you can get", "where you get", "where you buy"]);
    #[rustfmt::skip]
    const BUY: &Phrases = &Phrases::of(&["where one can buy", "where one can get", "where people can buy", "where people buy", "where i can buy", "where we can buy", "where you buy", "where one buys", "where you can get", "where i buy", "where we buy", "where i get", "where you get"]);
    let mut at = 1;
    while at + 1 < lexemes.len() {
        let behind = &lexemes[at + 1..];
        if word(lexemes, at) == "place"
            && matches!(word(lexemes, at - 1), "the" | "that" | "this")
            && (longest_phrase(behind, SELLS).is_some() || longest_phrase(behind, BUY).is_some())
        {
            lexemes[at] = word_at(&lexemes[at].clone(), "building");
        }
        let noun = matches!(word(lexemes, at - 1), "building" | "shop" | "store" | "house" | "one");
        if let Some(words) = longest_phrase(&lexemes[at..], BUY).filter(|_| noun) {
            let place = lexemes[at].clone();
            let plain: Vec<Lexeme> = words_at(&place, "where you can buy").collect();
            lexemes.splice(at..at + words, plain);
        }
        at += 1;
    }
}

/// "The white and the black car" are the white car and the black car.
fn of_one_noun(lexemes: &mut Vec<Lexeme>) {
    #[rustfmt::skip]
    const WHICH: &[&str] = &["big", "small", "bigger", "smaller", "larger", "tall", "short", "taller", "shorter", "left", "right", "old", "first", "second", "last"];
    let which = |at: usize| {
        let rest = lexemes.get(at..).unwrap_or_default();
        longest(rest, super::super::paint::PAINTS)
            .map(|(_, words)| words)
            .or_else(|| longest_phrase(rest, WHICH))
    };
    let found = (0..lexemes.len()).find_map(|at| {
        (word(lexemes, at) == "the").then_some(())?;
        let and = at + 1 + which(at + 1)?;
        let is_both = word(lexemes, and) == "and" && word(lexemes, and + 1) == "the";
        let noun = and + 2 + which(and + 2).filter(|_| is_both)?;
        let (_, words) = category(&lexemes[noun..])?;
        Some((and, noun..noun + words))
    });
    let Some((and, noun)) = found else { return };
    let noun = lexemes[noun].to_vec();
    lexemes.splice(and..and, noun);
}

/// "By his side" is next to him.
fn beside_somebody(lexemes: &mut Vec<Lexeme>) {
    let found = (1..lexemes.len().saturating_sub(2)).find(|at| {
        matches!(word(lexemes, *at), "by" | "at" | "to" | "on")
            && matches!(word(lexemes, at + 1), "his" | "her" | "their" | "its")
            && word(lexemes, at + 2) == "side"
    });
    let Some(at) = found else { return };
    let who = match word(lexemes, at + 1) {
        "his" => "him",
        "her" => "her",
        "its" => "it",
        _ => "them",
    };
    let place = lexemes[at].clone();
    let plain: Vec<Lexeme> = words_at(&place, "next to").chain([word_at(&place, who)]).collect();
    lexemes.splice(at..at + 3, plain);
}

/// "The tree in the park that's closest to Ada" is the tree closest to Ada in the park.
fn nearest_of_place(lexemes: &mut Vec<Lexeme>) {
    const THAT_IS: &Phrases = &Phrases::of(&["thats", "that is", "which is", "that stands", "which stands"]);
    const LONGEST_PLACE: usize = 6;
    let found = (3..lexemes.len().saturating_sub(3)).find_map(|at| {
        let that = longest_phrase(&lexemes[at..], THAT_IS)?;
        let nearest =
            matches!(word(lexemes, at + that), "closest" | "nearest") && word(lexemes, at + that + 1) == "to";
        let from = (at.saturating_sub(LONGEST_PLACE)..at - 1).find(|from| {
            longest(&lexemes[*from..], &WAYS).is_some_and(|(_, words)| from + words < at)
                && ends_which(lexemes, *from)
        })?;
        let behind = at + that + 2;
        let end = (behind + 1..lexemes.len())
            .find(|end| is_mark(&lexemes[*end]) || matches!(word(lexemes, *end), "and" | "please"))
            .unwrap_or(lexemes.len());
        (nearest && end - behind <= 3).then_some((from, at, at + that, end))
    });
    let Some((from, at, nearest, end)) = found else { return };
    let plain: Vec<Lexeme> = lexemes[nearest..end].iter().chain(&lexemes[from..at]).cloned().collect();
    lexemes.splice(from..end, plain);
}

/// "The two of them" are both of them.
fn both_of_them(lexemes: &mut Vec<Lexeme>) {
    #[rustfmt::skip]
    const BOTH: &Phrases = &Phrases::of(&["the two of them", "the pair of them", "the both of them", "both of those", "both of these", "the two of these", "the two of those", "them both", "each of the two"]);
    let found =
        (0..lexemes.len()).find_map(|at| longest_phrase(&lexemes[at..], BOTH).map(|words| (at, words)));
    let Some((at, words)) = found else { return };
    let place = lexemes[at].clone();
    let plain: Vec<Lexeme> = if word(lexemes, at) == "each" {
        vec![word_at(&place, "each"), word_at(&place, "of"), word_at(&place, "the")]
    } else {
        words_at(&place, "both of them").collect()
    };
    lexemes.splice(at..at + words, plain);
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    WHICH.iter().chain(TOO_MUCH).copied().chain(EXCEPT.iter().flat_map(|phrase| phrase.split(' ')))
}
