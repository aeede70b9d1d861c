//! One new thing: how many, of what colour and size, the words of its noun, and what it is to be called.

use simworld_core::seam::PlanError;

use super::super::lexer::{Lexeme, Token};
use super::super::lexicon::{longest, longest_phrase};
use super::super::numbers;
use super::super::paint::PAINTS;
use super::super::phrases::Phrases;
use super::parse::{Reader, joint};
use super::things::{ARTICLES, begins_another};
use super::wish::NewThing;
use super::words::{FACTORS, HARMLESS, SIZES};

/// What ends the noun of a new thing: what it is called.
const CALLED: &[&str] = &["called", "named", "with the name", "with the name of", "by the name of"];
/// Some, and not many.
const FEW: &Phrases = &Phrases::of(&[
    "a few",
    "several",
    "a handful of",
    "a number of",
    "a few more",
    "several more",
    "quite a few",
    "a bunch of",
    "a group of",
    "a cluster of",
    "a small group of",
]);
/// How something is to be where it stands.
#[rustfmt::skip]
const POSTURES: &Phrases = &Phrases::of(&["standing", "sitting", "waiting", "parked", "placed", "located", "leaning", "lying", "planted", "installed", "that stands", "which stands",
    "that is", "that are", "which is", "positioned", "situated", "that sits", "resting", "put", "hanging", "set up", "lined up", "to stand", "to be", "to go", "to sit", "to wait",
    "that goes", "to be placed", "to put", "growing", "built", "set", "to be put", "to be parked", "to park", "to place", "mounted", "stood", "right", "directly", "somewhere", "just",
    "exactly", "only", "who stands", "who waits", "perched", "balanced", "going", "ready", "and place it", "and put it", "and park it", "and set it", "and stick it", "and put them",
    "and place them", "and park them", "and leave it", "and plant it", "and stand it", "and drop it", "and put that", "and have it", "and get it"]);
/// What something new is for, which tells it from nothing else.
#[rustfmt::skip]
const PURPOSES: &Phrases = &Phrases::of(&["for company", "for fun", "for shade", "for decoration", "for safety", "for comfort", "for light", "for show", "for rest", "for good luck", "for luck", "for emergencies", "for lunch", "for dinner", "for breakfast",
    "for the night", "for the day", "for the evening", "for the kids", "for the children", "for the visitors", "for visitors", "for guests", "for the guests", "for tourists", "for the tourists", "for customers", "for the customers", "for patients",
    "for the patients", "for students", "for the students", "for people", "for staff", "for the staff", "for everyone", "for everybody", "for pedestrians", "for cyclists", "for commuters", "for the commuters", "for the neighbours", "for the residents",
    "for reading", "for sitting", "for resting", "for parking", "for eating", "for waiting", "to sit on", "to sit down on", "to rest on", "to eat at", "to play with", "to play on", "to lean on", "to look at", "to admire", "to read", "to drink",
    "for the weekend", "for the party", "for the parade", "for the festival", "for the fair", "for the market", "for the wedding", "for the show", "for the concert", "for the photo", "for the picture", "for christmas", "for the summer", "for the winter",
    "for him", "for her", "for them", "for his birthday", "for her birthday", "for deliveries", "for the rubbish", "for rubbish", "for litter", "for bikes", "for bicycles", "for mail", "for letters", "for tonight", "for tomorrow", "or something",
    "or something like that", "or so", "of some sort", "of some kind", "of sorts", "or whatever", "if possible", "please", "as well", "too", "delivered", "put up", "set up", "installed", "standing", "put"]);
/// Words that are in the name of no thing.
#[rustfmt::skip]
const NO_NOUNS: &[&str] = &["is", "are", "was", "were", "has", "have", "needs", "need", "wants", "want", "loves", "should", "must", "would", "could", "i", "you", "he", "she",
    "we", "they", "them", "it", "my", "your", "nobody", "everybody", "everyone", "there", "ones", "twice", "many", "copy", "copies", "clone", "duplicate", "because", "if",
    "let", "be", "do", "does", "dont", "not", "never", "gets", "goes", "same", "us", "me", "make", "paint", "move", "remove", "delete", "her", "him",
    "than", "as", "which", "who", "why", "what", "where", "nowhere", "somewhere", "wouldnt", "isnt", "arent", "doesnt", "cant", "to", "keeps", "keep", "until", "unless",
    "while", "instead", "except", "but", "only", "into", "also", "too", "these", "those", "put", "add", "erect", "install", "no", "ya", "work", "trouble", "effort", "bother"];

/// What begins like a new thing and is none that stands anywhere: "a bit of drama".
#[rustfmt::skip]
const NO_THING: &[&str] = &["a bit of", "a little bit of", "a touch of", "a dash of", "a breath of", "a hint of"];
impl Reader<'_> {
    /// The name of a new thing, up to its place.
    fn new_name(&mut self, end: usize) -> String {
        let from = self.at;
        while self.at < end && !self.is_place(self.at) && joint(self.rest(end)).is_none() {
            self.at += 1;
        }
        self.written(from, self.at)
    }

    /// "Three tall red sports cars".
    pub(super) fn new_thing(&mut self, end: usize) -> Result<NewThing, PlanError> {
        let start = self.at;
        // "A bit of drama" is nothing that stands anywhere.
        if longest_phrase(self.rest(end), NO_THING).is_some() {
            return Err(self.not_understood("say what to add"));
        }
        let mut thing = NewThing {
            words: Vec::new(),
            count: 1,
            many: false,
            paint: None,
            scale: 1.0,
            size: None,
            name: None,
            text: String::new(),
        };
        while self.at < end {
            if let Some(words) = self.how_many_new(&mut thing, end) {
                self.at += words;
            } else if self.at > start
                && matches!(self.word(self.at), Some("in" | "around"))
                && self.is_place(self.at)
            {
                // "One in front".
                break;
            } else if let Some(words) =
                longest_phrase(self.rest(end), ARTICLES).filter(|_| thing.words.is_empty())
            {
                self.at += words;
            } else if let Some(words) =
                longest_phrase(self.rest(end), CALLED).filter(|_| self.word(start) != Some("the"))
            {
                self.at += words;
                thing.name = Some(self.new_name(end));
                break;
            } else if let Some(words) = self.purpose_of_new(&thing, end) {
                self.at += words;
            } else if self.ends_thing(&thing, start, end) {
                break;
            } else if let Some(words) = longest_phrase(self.rest(end), POSTURES)
                .filter(|words| !thing.words.is_empty() && self.is_place((self.at + words).min(end)))
            {
                self.at += words;
                break;
            } else if let Some(words) = self.said_of_new(&mut thing, end) {
                self.at += words;
            } else {
                break;
            }
        }
        thing.text = self.written(start, self.at);
        thing.many = thing.count == 1 && self.is_of_many(start, &thing);
        if is_mass(&thing) && !self.says_one(start) || !thing.has_noun() {
            self.at = start;
            return Err(self.not_understood("say what to add"));
        }
        Ok(thing)
    }

    /// How many new things there are to be, or how large: how many words say so.
    fn how_many_new(&self, thing: &mut NewThing, end: usize) -> Option<usize> {
        let rest = self.rest(end);
        // "A three-legged stool" is one.
        let is_part = |words: usize| self.words[rest[words - 1].end..].starts_with('-');
        let is_first = thing.words.is_empty();
        if let Some((size, words)) = self.new_size(is_first, end) {
            thing.size = Some(size);
            return Some(words);
        }
        if let Some((count, words)) = numbers::count(rest).filter(|(_, words)| is_first && !is_part(*words)) {
            thing.count = count;
            return Some(words);
        }
        if self.word(self.at) == Some("please") && self.at + 1 < end && self.is_place(self.at + 1) {
            return Some(1);
        }
        if let Some((count, words)) = times_behind(rest) {
            thing.count = count;
            return Some(words);
        }
        let few = longest_phrase(rest, FEW).filter(|_| is_first)?;
        thing.count = super::ground::ROW;
        Some(few)
    }

    /// What a new thing is for, behind its noun: how many words say so.
    fn purpose_of_new(&self, thing: &NewThing, end: usize) -> Option<usize> {
        let rest = self.rest(end);
        longest_phrase(rest, PURPOSES).filter(|words| {
            !thing.words.is_empty()
                && (self.at + words >= end
                    || self.is_place(self.at + words)
                    || joint(&rest[*words..]).is_some())
        })
    }

    /// The colour of a new thing, its size, or a word of its noun: how many words say so.
    fn said_of_new(&self, thing: &mut NewThing, end: usize) -> Option<usize> {
        let rest = self.rest(end);
        if let Some((paint, words)) = longest(rest, PAINTS).filter(|_| thing.paint.is_none()) {
            thing.paint = Some(paint);
            return Some(words);
        }
        // "A bench twice as big".
        let factor = if thing.words.is_empty() { longest(rest, &SIZES) } else { longest(rest, &FACTORS) };
        if let Some((factor, words)) = factor {
            thing.scale = factor;
            return Some(words);
        }
        let Token::Word(word) = &rest[0].token else { return None };
        if word != "more" || thing.words.is_empty() {
            thing.words.push(word.clone());
        }
        Some(1)
    }

    /// Whether an article says that it is one.
    fn says_one(&self, start: usize) -> bool {
        #[rustfmt::skip]
        const ONE: &Phrases = &Phrases::of(&["a", "an", "one", "another", "a single", "one more", "yet another", "a new", "a further", "an extra", "an additional", "just one", "the", "also a", "just a"]);
        longest_phrase(&self.lexemes[start..], ONE).is_some()
    }

    /// "Benches", "some trees": in the plural, and nobody says how many.
    fn is_of_many(&self, start: usize, thing: &NewThing) -> bool {
        const NONE: [&str; 5] = ["ss", "us", "is", "as", "os"];
        let said: Vec<&str> = thing.words.iter().map(String::as_str).collect();
        let head =
            said.iter().position(|word| ["of", "with", "for", "in"].contains(word)).unwrap_or(said.len());
        let is_people = said.last().is_some_and(|word| ["people", "children", "men", "women"].contains(word));
        let is_plural = is_people
            || head.checked_sub(1).and_then(|last| said.get(last)).is_some_and(|word| {
                word.len() > 3 && word.ends_with('s') && !NONE.iter().any(|ending| word.ends_with(ending))
            });
        is_plural && !self.says_one(start)
    }

    /// Whether the noun of a new thing ends here.
    fn ends_thing(&self, thing: &NewThing, start: usize, end: usize) -> bool {
        let rest = self.rest(end);
        // "A tent a picnic table and two chairs".
        let is_next = thing.words.last().is_some_and(|word| !OF.contains(word)) && begins_another(rest);
        is_next
            || joint(rest).is_some()
            || self.is_place(self.at)
            || self.word(self.at) == Some("for") && !thing.words.is_empty() && self.is_certain(self.at + 1)
            || self.before_politeness(start, end) <= self.at
    }
}

impl NewThing {
    /// As many as were said, and one where nobody said so.
    pub(super) fn not_many(&self) -> Self {
        Self { many: false, ..self.clone() }
    }

    /// Whether it is named by something that can be the name of a thing.
    fn has_noun(&self) -> bool {
        const OPEN: &[&str] = &[
            "place", "spot", "thing", "town", "city", "scene", "way", "one", "name", "look", "chance",
            "rest", "break", "treat",
        ];
        let mut plain = self.words.iter().filter(|word| !HARMLESS.contains(&word.as_str()));
        let is_open =
            plain.next().is_some_and(|word| OPEN.contains(&word.as_str())) && plain.next().is_none();
        !is_open && !self.words.is_empty() && !self.words.iter().any(|word| NO_NOUNS.contains(&word.as_str()))
    }
}

/// Whether it is nothing that can be made, but what for: "more light", "some shade".
fn is_mass(thing: &NewThing) -> bool {
    const MASS: &[&str] = &[
        "light",
        "lighting",
        "shade",
        "seating",
        "greenery",
        "life",
        "parking",
        "room",
        "space",
        "traffic",
        "fun",
        "order",
        "peace",
        "quiet",
        "safety",
        "comfort",
        "illumination",
        "decoration",
        "shelter",
        "privacy",
        "snow",
        "rain",
        "fog",
        "mist",
        "sunshine",
        "sun",
        "sunlight",
        "wind",
        "rainfall",
        "snowfall",
        "darkness",
        "weather",
        "colour",
        "charm",
        "atmosphere",
        "green",
        "entertainment",
        "company",
        "attention",
        "protection",
        "security",
        "storage",
        "help",
    ];
    let mut words = thing.words.iter().filter(|word| {
        !["more", "some", "better", "extra", "of", "for", "less", "fewer"].contains(&word.as_str())
    });
    thing.paint.is_none()
        && words.next().is_some_and(|word| MASS.contains(&word.as_str()))
        && words.next().is_none()
}

/// Behind these an article belongs to the same noun: "a statue of a dog".
const OF: &Phrases =
    &Phrases::of(&["of", "with", "for", "in", "on", "like", "as", "half", "from", "than", "at"]);

/// "x 4" behind a noun: how many, and how many words say so.
fn times_behind(lexemes: &[Lexeme]) -> Option<(u32, usize)> {
    let times = longest_phrase(lexemes, &["x", "times"])?;
    let number = lexemes.get(times..times + 1)?;
    let Token::Number(_) = number.first()?.token else { return None };
    numbers::number(number)
        .map(|(count, words)| (count as u32, times + words))
        .filter(|(count, _)| (1..=1000).contains(count))
}
