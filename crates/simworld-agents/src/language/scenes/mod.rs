//! The words of whole scenes: each phrase says one thing of the place, in any order.

mod features;
mod spots;
mod words;

use simworld_core::scene::Place;
use simworld_core::spec::{Amount, Pattern, SceneKind, SceneSpec};

use super::edits::sky::{changed, hour};
use super::edits::words::{SKIES, SKY_ROWS, Sky};
use super::hearing;
use super::lexer::{Lexeme, Token};
use super::lexicon::{CATEGORIES, category, longest, longest_phrase};
use super::numbers;
use super::spelling::is_known;
use crate::scenes::{SceneReading, SceneRemark, suited};
use spots::Spot;
#[cfg(feature = "thought")]
pub(crate) use words::landmark_names;
use words::{AMOUNTS, FACTS, Fact, LANDMARKS, NATURAL, NOISE, SETTLED, SETTLEMENTS};

/// The longest sentence that is read, characters.
const LONGEST: usize = 2000;
/// The longest name of a place, characters.
const LONGEST_TITLE: usize = 60;

/// Reads a sentence; nothing if no word of it is about a scene.
pub(crate) fn read(words: &str) -> Option<SceneReading> {
    let words: String = words.chars().take(LONGEST).collect();
    let mut lexemes = hearing::hear(&words, None);
    correct(&mut lexemes);
    let mut scene = Scene { words: &words, lexemes: &lexemes, ..Scene::default() };
    while scene.at < lexemes.len() {
        scene.step();
    }
    scene.finish()
}

#[derive(Default)]
struct Scene<'a> {
    words: &'a str,
    lexemes: &'a [Lexeme],
    at: usize,
    spec: SceneSpec,
    skies: Vec<Sky>,
    unread: Vec<String>,
    remarks: Vec<SceneRemark>,
    /// The number that was said last and belongs to what comes.
    number: Option<u32>,
    amount: Option<Amount>,
    size: Option<u32>,
    /// What was named last, once for each, so that it may be said where it is.
    last: Vec<String>,
    /// Where what is named next is.
    ahead: Option<Spot>,
    /// Uses of which it was said how many there are.
    numbered: Vec<Place>,
    /// What is known beyond the city alone: how many houses a settlement has, and what the land has anyway. Its words count as
    /// unread until the kind is known.
    settled: Option<u32>,
    natural: Vec<(&'static [SceneKind], String)>,
    /// How many facts were found.
    facts: u32,
}

impl<'a> Scene<'a> {
    /// Reads on by one phrase.
    fn step(&mut self) {
        let lexemes: &'a [Lexeme] = self.lexemes;
        let rest = &lexemes[self.at..];
        if matches!(rest[0].token, Token::Comma | Token::Break) {
            (self.number, self.amount) = (None, None);
            self.last.clear();
            self.at += 1;
            return;
        }
        if self.titled() || self.timed() || self.placed() || self.counted() || self.district() {
            return;
        }
        self.at += self.phrase(rest);
    }

    /// Reads the longest phrase at the start, and says of how many words it is.
    fn phrase(&mut self, rest: &[Lexeme]) -> usize {
        let fact = longest(rest, FACTS);
        let is_longer = |words: usize| fact.is_none_or(|(_, own)| words > own);
        let sky = longest(rest, &SKIES).filter(|(_, words)| is_longer(*words));
        let landmark = longest(rest, LANDMARKS).filter(|(_, words)| is_longer(*words));
        let place = category(rest).and_then(|(class, words)| Some((class.place()?, words)));
        let place = place.filter(|(place, words)| {
            *place != Place::Home
                && is_longer(*words)
                && sky.is_none_or(|(_, own)| *words > own)
                && landmark.is_none_or(|(_, own)| *words > own)
        });
        let amount = longest(rest, AMOUNTS).filter(|(_, words)| fact.is_none_or(|(_, own)| *words >= own));
        if let Some((place, words)) = place {
            let is_adjective = longest_phrase(&rest[words..], SETTLEMENTS).is_some();
            self.place(place, is_adjective);
            words
        } else if let Some((sky, words)) = sky {
            self.skies.push(sky);
            self.facts += 1;
            words
        } else if let Some((name, words)) = landmark {
            self.landmark(name);
            words
        } else if let Some((amount, words)) = amount {
            self.amount = Some(amount);
            words
        } else if let Some((fact, words)) = fact {
            self.settled = self.settled.max(longest(rest, SETTLED).map(|(houses, _)| houses));
            self.fact(fact);
            words
        } else {
            self.other(rest)
        }
    }

    /// What joins and adorns, what the land has anyway, or what is not understood.
    fn other(&mut self, rest: &[Lexeme]) -> usize {
        if let Some(words) = longest_phrase(rest, NOISE) {
            if longest_phrase(rest, &["and", "with", "plus", "also"]).is_some() {
                self.last.clear();
            }
            return words;
        }
        (self.number, self.ahead) = (None, None);
        self.last.clear();
        let natural = longest(rest, NATURAL);
        let words = natural.map_or(1, |(_, words)| words);
        let said = self.words[rest[0].start..rest[words - 1].end].to_owned();
        if let Some((kinds, _)) = natural {
            self.amount = None;
            self.settled = self.settled.max(longest(rest, SETTLED).map(|(houses, _)| houses));
            self.natural.push((kinds, said.clone()));
        }
        self.unread.push(said);
        words
    }

    /// Takes up what depends on the kind of place, now that it is known.
    fn settle(&mut self) {
        let kind = self.spec.kind;
        for (kinds, said) in std::mem::take(&mut self.natural) {
            if !kinds.contains(&kind) {
                let instead = kinds.first().map_or("", |kind| kind.as_str());
                self.remarks.push(SceneRemark::Unsuited { what: said, kind: kind.as_str(), instead });
            } else if let Some(index) = self.unread.iter().position(|word| *word == said) {
                self.unread.remove(index);
            }
        }
        if matches!(kind, SceneKind::Countryside | SceneKind::Island) && self.spec.buildings.count.is_none() {
            self.spec.buildings.count = self.settled;
        }
        self.remarks.extend(suited(&mut self.spec));
    }

    /// "Called Little Haven".
    fn titled(&mut self) -> bool {
        let rest = &self.lexemes[self.at..];
        let Some(words) = longest_phrase(rest, &["called", "named", "by the name of", "with the name"])
        else {
            return false;
        };
        let ends = |lexeme: &Lexeme| match &lexeme.token {
            Token::Word(word) => ["with", "that", "which", "and", "where", "in", "by", "on", "at", "of"]
                .contains(&word.as_str()),
            Token::Number(_) => false,
            _ => true,
        };
        let from = self.at + words;
        let count = self.lexemes[from..].iter().take_while(|lexeme| !ends(lexeme)).count();
        if let Some([first, .., last] | [first @ last]) = self.lexemes.get(from..from + count) {
            let said = &self.words[first.start..last.end];
            let title = said.split_whitespace().collect::<Vec<_>>().join(" ");
            self.spec.title =
                Some(title.chars().take(LONGEST_TITLE).collect::<String>().trim_end().to_owned());
        }
        self.at = from + count;
        true
    }

    /// "At 8 pm".
    fn timed(&mut self) -> bool {
        let rest = &self.lexemes[self.at..];
        let is_number = numbers::number(rest).is_some();
        let Some((sky, words)) = hour(rest).filter(|_| is_number) else { return false };
        let at = self.at.checked_sub(1).map(|before| &self.lexemes[before].token);
        let said = matches!(at, Some(Token::Word(word)) if ["at", "by", "around"].contains(&word.as_str()));
        let bare = numbers::number(rest).is_some_and(|(_, count)| count == words);
        if bare && !(said && self.lexemes.get(self.at + words).is_none()) {
            return false;
        }
        self.skies.push(sky);
        self.facts += 1;
        self.at += words;
        true
    }

    /// A number that counts what is named next, or what was named before: "about 60 of them".
    fn counted(&mut self) -> bool {
        let rest = &self.lexemes[self.at..];
        let is_article =
            matches!(&rest[0].token, Token::Word(word) if ["a", "an", "one"].contains(&word.as_str()));
        let Some((mut number, mut words)) = numbers::number(rest) else { return false };
        if is_article && number <= 1.0 && !matches!(&rest[0].token, Token::Word(word) if word == "one") {
            self.number = Some(1);
            self.at += 1;
            return true;
        }
        // "One hundred and twenty".
        if number >= 100.0
            && longest_phrase(&rest[words..], &["and"]).is_some()
            && let Some((more, count)) =
                numbers::number(&rest[words + 1..]).filter(|(more, _)| *more >= 1.0 && *more < 100.0)
        {
            (number, words) = (number + more, words + 1 + count);
        }
        if !(number >= 0.0 && number.fract() == 0.0) {
            return false;
        }
        let number = number.min(f64::from(u32::MAX)) as u32;
        self.at += words;
        if let Some(words) =
            longest_phrase(&self.lexemes[self.at..], &["of them", "of those", "in total", "altogether"])
        {
            self.spec.buildings.count = Some(number);
            self.facts += 1;
            self.at += words;
        } else {
            self.number = Some(number);
        }
        true
    }

    fn fact(&mut self, fact: Fact) {
        self.facts += 1;
        let (number, amount) = (self.number, self.amount);
        let mut uses = true;
        match fact {
            Fact::Kind(kind) => {
                // A town on an island is an island.
                if kind != SceneKind::City {
                    self.spec.kind = kind;
                }
            }
            Fact::Size(size) => {
                self.size = Some(size);
                uses = false;
            }
            Fact::Pattern(pattern) => {
                self.spec.streets.pattern = pattern;
                uses = false;
            }
            Fact::Width(width) => self.spec.streets.width = width,
            Fact::PatternAndWidth(pattern, width) => {
                (self.spec.streets.pattern, self.spec.streets.width) = (pattern, width);
            }
            Fact::Suburb => self.spec.streets.pattern = Pattern::Suburb,
            Fact::Houses | Fact::HousesOf(_) => {
                if let Fact::HousesOf(height) = fact {
                    self.spec.buildings.height = height;
                }
                self.spec.buildings.count = number.filter(|count| *count > 1).or(self.spec.buildings.count);
            }
            Fact::Streets => {
                self.spec.streets.count = number.filter(|count| *count > 1).or(self.spec.streets.count);
            }
            Fact::Trees => self.spec.streets.trees = amount.unwrap_or(self.spec.streets.trees),
            Fact::TreesOf(amount) => self.spec.streets.trees = amount,
            Fact::Cars => self.spec.streets.parked = amount.unwrap_or(self.spec.streets.parked),
            Fact::Water(water) if amount != Some(Amount::None) => self.water(water),
            Fact::Water(_) => {}
            Fact::Square(name) => return self.open_ground(name, false),
            Fact::Park => return self.open_ground("Park", true),
        }
        if uses {
            (self.number, self.amount, self.ahead) = (None, None, None);
            self.last.clear();
        }
    }

    fn finish(mut self) -> Option<SceneReading> {
        let is_sky_alone = self.facts as usize == self.skies.len();
        if self.facts == 0 || is_sky_alone {
            return None;
        }
        if !self.skies.is_empty() {
            self.spec.environment = changed(self.spec.environment, &self.skies);
        }
        self.settle();
        if self.spec.kind == SceneKind::City && self.spec.buildings.count.is_none() {
            self.spec.streets.count = self.spec.streets.count.or(self.size);
        }
        Some(SceneReading { spec: self.spec, unread: self.unread, remarks: self.remarks })
    }
}

/// Puts words right that are one slip away from one word of scenes.
fn correct(lexemes: &mut [Lexeme]) {
    let own = || {
        let skies = SKY_ROWS.iter().flat_map(|(words, _)| *words);
        let places = CATEGORIES.iter().filter(|class| class.is_place()).flat_map(|class| class.words);
        let phrases = words::phrases().chain(spots::phrases());
        phrases.chain(skies).chain(places).flat_map(|phrase| phrase.split(' '))
    };
    for lexeme in lexemes {
        let Token::Word(word) = &lexeme.token else { continue };
        if word.chars().count() < 4
            || own().any(|own| own == word)
            || is_known(word)
            || numbers::number(std::slice::from_ref(lexeme)).is_some()
        {
            continue;
        }
        let mut near: Vec<&str> =
            own().filter(|own| own.chars().count() >= 4 && strsim::osa_distance(own, word) == 1).collect();
        near.sort_unstable();
        near.dedup();
        if let [right] = near[..] {
            lexeme.token = Token::Word(right.to_owned());
        }
    }
}
