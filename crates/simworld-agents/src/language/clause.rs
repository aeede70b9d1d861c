//! Sentences to clauses: a verb and the words of its thing.

use super::Fault;

/// What is understood, for error messages.
pub(super) const UNDERSTOOD: &str = "say go to, walk to, run to, pick up, drop off, sit down, stand up, ride, get off, \
                                     stop or wait, joined by \"and\" or \"then\"";

/// What a clause asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Verb {
    Go,
    Run,
    PickUp,
    DropOff,
    Sit,
    StandUp,
    Ride,
    GetOff,
    Stop,
    Wait,
}

/// Verbs by their words; of those that fit, the longest counts.
const VERBS: &[(&[&str], Verb)] = &[
    (&["go"], Verb::Go),
    (&["walk"], Verb::Go),
    (&["navigate"], Verb::Go),
    (&["move"], Verb::Go),
    (&["head"], Verb::Go),
    (&["travel"], Verb::Go),
    (&["drive"], Verb::Go),
    (&["return"], Verb::Go),
    (&["approach"], Verb::Go),
    (&["visit"], Verb::Go),
    (&["run"], Verb::Run),
    (&["jog"], Verb::Run),
    (&["hurry"], Verb::Run),
    (&["pick", "up"], Verb::PickUp),
    (&["take"], Verb::PickUp),
    (&["grab"], Verb::PickUp),
    (&["fetch"], Verb::PickUp),
    (&["get"], Verb::PickUp),
    (&["collect"], Verb::PickUp),
    (&["drop", "off"], Verb::DropOff),
    (&["drop"], Verb::DropOff),
    (&["put", "down"], Verb::DropOff),
    (&["put"], Verb::DropOff),
    (&["release"], Verb::DropOff),
    (&["deliver"], Verb::DropOff),
    (&["sit", "down"], Verb::Sit),
    (&["sit"], Verb::Sit),
    (&["take", "a", "seat"], Verb::Sit),
    (&["stand", "up"], Verb::StandUp),
    (&["stand"], Verb::StandUp),
    (&["get", "up"], Verb::StandUp),
    (&["ride"], Verb::Ride),
    (&["get", "on"], Verb::Ride),
    (&["get", "off"], Verb::GetOff),
    (&["dismount"], Verb::GetOff),
    (&["stop"], Verb::Stop),
    (&["halt"], Verb::Stop),
    (&["wait"], Verb::Wait),
];

/// Words that ask nicely and say nothing.
const NOISE: &[&str] = &[
    "please",
    "could",
    "can",
    "would",
    "will",
    "you",
    "kindly",
    "just",
    "now",
    "i",
    "want",
    "like",
    "id",
    "lets",
    "let",
    "us",
    "should",
    "must",
    "next",
    "first",
    "finally",
    "afterwards",
    "quickly",
    "ok",
    "okay",
];

/// One clause.
#[derive(Clone, Debug)]
pub(super) struct Clause {
    pub(super) verb: Verb,
    /// The words after the verb.
    pub(super) thing: Vec<String>,
    /// As it was said.
    pub(super) text: String,
}

impl Clause {
    /// Whether the thing is the one that was spoken of.
    pub(super) fn means_topic(&self) -> bool {
        matches!(self.thing.last().map(String::as_str), Some("it" | "there" | "them"))
            && self.thing.len() <= 2
    }

    /// How long to wait.
    pub(super) fn seconds(&self) -> Result<f64, Fault> {
        let unclear = || Fault::Unclear("say how long: wait 5 seconds, wait 2 minutes".to_owned());
        let number = self.thing.iter().find_map(|word| word.trim_end_matches('s').parse::<f64>().ok());
        let number = match number {
            Some(number) => number,
            None if self.thing.iter().any(|word| word == "a" || word == "one") => 1.0,
            None => return Err(unclear()),
        };
        let unit = if self.thing.iter().any(|word| word.starts_with("min")) { 60.0 } else { 1.0 };
        let seconds = number * unit;
        if (0.0..=86_400.0).contains(&seconds) { Ok(seconds) } else { Err(unclear()) }
    }

    /// The clause that leads to where something is dropped: "the parcel at the door" leads to "the door".
    pub(super) fn destination(&self) -> Option<Self> {
        let at = self.thing.iter().position(|word| matches!(word.as_str(), "at" | "to" | "in" | "near"))?;
        let thing = self.thing[at + 1..].to_vec();
        Some(Self { verb: Verb::Go, thing, text: self.text.clone() })
    }
}

/// The clauses of a sentence; the words that begin with no verb, if there are any.
pub(super) fn clauses(sentence: &str) -> Result<Vec<Clause>, String> {
    let mut found: Vec<Clause> = Vec::new();
    for piece in pieces(sentence) {
        let words: Vec<String> =
            piece.iter().filter(|word| !NOISE.contains(&word.as_str())).cloned().collect();
        if words.is_empty() {
            continue;
        }
        let text = words.join(" ");
        match verb_of(&words) {
            Some((verb, length)) => found.push(Clause { verb, thing: words[length..].to_vec(), text }),
            None => return Err(text),
        }
    }
    Ok(found)
}

/// The verb at the beginning, with the number of its words. A typo of one letter in a long verb is forgiven.
fn verb_of(words: &[String]) -> Option<(Verb, usize)> {
    let fits = |pattern: &[&str], close: bool| {
        words.len() >= pattern.len()
            && pattern.iter().zip(words).all(|(wanted, word)| {
                wanted == word || (close && wanted.len() >= 4 && strsim::osa_distance(wanted, word) == 1)
            })
    };
    [false, true].into_iter().find_map(|close| {
        let matching = VERBS.iter().filter(|(pattern, _)| fits(pattern, close));
        matching.max_by_key(|(pattern, _)| pattern.len()).map(|(pattern, verb)| (*verb, pattern.len()))
    })
}

/// Lower-case words, cut where a new clause begins: at "then", at a full stop, and at "and" or a comma before a verb.
fn pieces(sentence: &str) -> Vec<Vec<String>> {
    let mut pieces: Vec<Vec<String>> = vec![Vec::new()];
    let words = words(sentence);
    for (index, word) in words.iter().enumerate() {
        let rest: Vec<String> = words[index + 1..]
            .iter()
            .filter(|word| !NOISE.contains(&word.as_str()))
            .take(3)
            .cloned()
            .collect();
        let cuts = match word.as_str() {
            "then" | "." | ";" | "!" => true,
            "and" | "," => {
                rest.first().is_some_and(|next| next == "then" || next == "and") || verb_of(&rest).is_some()
            }
            _ => false,
        };
        if cuts {
            pieces.push(Vec::new());
        } else if word != "," {
            let last = pieces.len() - 1;
            pieces[last].push(word.clone());
        }
    }
    for piece in &mut pieces {
        if piece.last().is_some_and(|word| word == "and") {
            piece.pop();
        }
    }
    pieces
}

/// Words and the marks that matter; "(10, -3)" stays one word, "#12" another.
fn words(sentence: &str) -> Vec<String> {
    let mut words = Vec::new();
    let mut word = String::new();
    let mut in_parentheses = false;
    let mut letters = sentence.chars().peekable();
    while let Some(letter) = letters.next() {
        match letter {
            '(' => {
                in_parentheses = true;
                word.push(letter);
            }
            ')' => {
                in_parentheses = false;
                word.push(letter);
            }
            _ if in_parentheses => {
                if !letter.is_whitespace() {
                    word.push(letter);
                }
            }
            // A point between digits belongs to a number.
            '.' if letters.peek().is_some_and(char::is_ascii_digit) => word.push(letter),
            ',' | '.' | ';' | '!' | '?' => {
                flush(&mut word, &mut words);
                words.push(if letter == '?' { '.' } else { letter }.to_string());
            }
            '\'' | '"' | '\u{2019}' => {}
            _ if letter.is_whitespace() => flush(&mut word, &mut words),
            _ => word.extend(letter.to_lowercase()),
        }
    }
    flush(&mut word, &mut words);
    words
}

fn flush(word: &mut String, words: &mut Vec<String>) {
    if !word.is_empty() {
        words.push(std::mem::take(word));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn verbs(sentence: &str) -> Vec<(Verb, String)> {
        clauses(sentence).unwrap().into_iter().map(|clause| (clause.verb, clause.thing.join(" "))).collect()
    }

    #[test]
    fn sentences_fall_into_clauses() {
        let thing = |text: &str| text.to_owned();
        assert_eq!(
            verbs("Could you please walk to the bakery, pick up the parcel and then go to (10, -3)?"),
            [
                (Verb::Go, thing("to the bakery")),
                (Verb::PickUp, thing("the parcel")),
                (Verb::Go, thing("to (10,-3)"))
            ]
        );
        assert_eq!(
            verbs("wait 2.5 seconds. stand up"),
            [(Verb::Wait, thing("2.5 seconds")), (Verb::StandUp, thing(""))]
        );
        assert_eq!(verbs("go to Salt and Pepper Grill"), [(Verb::Go, thing("to salt and pepper grill"))]);
    }

    #[test]
    fn what_is_no_verb_is_named() {
        assert_eq!(clauses("go to the park and juggle fire").unwrap().len(), 1);
        assert_eq!(clauses("juggle fire").unwrap_err(), "juggle fire");
    }
}
