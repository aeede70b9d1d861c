//! New things: the noun phrase of what is to be made, and lists of them with their places.

use simworld_core::scene::EntityKind;
use simworld_core::seam::PlanError;

use super::super::clause::{Reference, Target};
use super::super::lexer::Token;
use super::super::lexicon::{longest, longest_phrase};
use super::super::numbers;
use super::super::paint::PAINTS;
use super::parse::{Reader, joint};
use super::wish::{Anchor, NewThing, Where, Wish};
use super::words::{FACTORS, SIZES};

/// What ends the noun of a new thing: what it is called.
const CALLED: &[&str] = &["called", "named", "with the name", "with the name of", "by the name of"];
/// Articles and the like before a new thing.
#[rustfmt::skip]
pub(super) const ARTICLES: &[&str] = &["a", "an", "some", "another", "one", "the", "one more", "a new", "new", "a single",
    "yet another", "a few", "a second", "a third", "a fourth", "a fifth", "a further", "an extra", "an additional", "a pair of", "a couple of", "me", "us", "of", "up", "down", "a row of", "a line of",
    "a group of", "a bunch of", "any", "also", "like", "maybe", "about", "to see", "to have", "in", "also a",
    "around", "see", "please", "yet another", "one more of", "just one", "just a", "possibly", "ideally", "preferably"];
/// Some, and not many.
const FEW: &[&str] = &[
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
];
/// How something is to be where it stands.
#[rustfmt::skip]
const POSTURES: &[&str] = &["standing", "sitting", "waiting", "parked", "placed", "located", "leaning", "lying", "planted", "installed", "that stands", "which stands",
    "that is", "that are", "which is", "positioned", "situated", "that sits", "resting", "put", "hanging", "set up", "lined up", "to stand", "to be", "to go", "to sit", "to wait",
    "that goes", "to be placed", "to put", "growing", "built", "set", "to be put", "to be parked", "to park", "to place", "mounted", "stood", "right", "directly", "somewhere", "just",
    "exactly", "only", "who stands", "who waits", "perched", "balanced", "going", "ready", "and place it", "and put it", "and park it", "and set it", "and stick it", "and put them",
    "and place them", "and park them", "and leave it", "and plant it", "and stand it", "and drop it", "and put that", "and have it", "and get it"];
/// What something new is for, which tells it from nothing else.
#[rustfmt::skip]
const PURPOSES: &[&str] = &["for company", "for fun", "for shade", "for decoration", "for safety", "for comfort", "for light", "for show", "for rest", "for good luck", "for luck", "for emergencies", "for lunch", "for dinner", "for breakfast",
    "for the night", "for the day", "for the evening", "for the kids", "for the children", "for the visitors", "for visitors", "for guests", "for the guests", "for tourists", "for the tourists", "for customers", "for the customers", "for patients",
    "for the patients", "for students", "for the students", "for people", "for staff", "for the staff", "for everyone", "for everybody", "for pedestrians", "for cyclists", "for commuters", "for the commuters", "for the neighbours", "for the residents",
    "for reading", "for sitting", "for resting", "for parking", "for eating", "for waiting", "to sit on", "to sit down on", "to rest on", "to eat at", "to play with", "to play on", "to lean on", "to look at", "to admire", "to read", "to drink",
    "for the weekend", "for the party", "for the parade", "for the festival", "for the fair", "for the market", "for the wedding", "for the show", "for the concert", "for the photo", "for the picture", "for christmas", "for the summer", "for the winter",
    "for him", "for her", "for them", "for his birthday", "for her birthday", "for deliveries", "for the rubbish", "for rubbish", "for litter", "for bikes", "for bicycles", "for mail", "for letters", "for tonight", "for tomorrow", "or something",
    "or something like that", "or so", "of some sort", "of some kind", "of sorts", "or whatever", "if possible", "please", "as well", "too", "delivered", "put up", "set up", "installed", "standing", "put"];
/// Words that are in the name of no thing.
#[rustfmt::skip]
const NO_NOUNS: &[&str] = &["is", "are", "was", "were", "has", "have", "needs", "need", "wants", "want", "loves", "should", "must", "would", "could", "i", "you", "he", "she",
    "we", "they", "them", "it", "my", "your", "nobody", "everybody", "everyone", "there", "ones", "twice", "many", "copy", "copies", "clone", "duplicate", "because", "if",
    "let", "be", "do", "does", "dont", "not", "never", "gets", "goes", "same", "us", "me", "make", "paint", "move", "remove", "delete", "her", "him",
    "than", "as", "which", "who", "why", "what", "where", "nowhere", "somewhere", "wouldnt", "isnt", "arent", "doesnt", "cant", "to", "keeps", "keep", "until", "unless",
    "while", "instead", "except", "but", "only", "into", "also", "too", "these", "those", "put", "add", "erect", "install", "no", "ya"];

impl Reader<'_> {
    /// New things and where they stand, in groups: "two benches and a bin next to the fountain and a tree behind it".
    pub(super) fn additions(&mut self, end: usize) -> Result<Vec<Vec<Wish>>, PlanError> {
        let mut wishes = Vec::new();
        let mut anchor: Option<Anchor> = None;
        let mut last: Option<NewThing> = None;
        let there = self.there_first(end);
        while self.at < end {
            if anchor.is_some() && self.is_bare_singular(end) {
                return Err(self.not_understood("say \"next to\" again, or \"a\" before what is to be made"));
            }
            let things = self.listed(last.as_ref(), end)?;
            let whose = self.for_whom(end);
            let from = self.at;
            if joint(self.rest(end)).is_some() && !self.is_place(self.at) {
                self.skip_joints_to(end);
                // "A tent and a bench, both by the tree".
                let all =
                    longest_phrase(self.rest(end), &["all", "both", "all of them", "both of them", "each"])
                        .unwrap_or(0);
                self.at += if self.is_place((self.at + all).min(end)) { all } else { 0 };
            }
            if whose.is_some() {
                anchor.clone_from(&whose);
            }
            if let Some(each) = self.each_place(end) {
                let one = |thing: &NewThing| NewThing { many: false, ..thing.clone() };
                let things: Vec<NewThing> = things.iter().map(one).collect();
                last = things.last().cloned();
                wishes.extend(
                    each.into_iter().map(|place| vec![Wish::Add { things: things.clone(), at: vec![place] }]),
                );
                self.skip_joints_to(end);
                continue;
            }
            let at = if let Some(whose) = whose.filter(|_| self.at >= end || !self.is_place(self.at)) {
                self.at = from;
                vec![Where::By(whose)]
            } else if self.at < end && self.is_place(self.at) {
                let mut at = self.places(end)?;
                // "A tree behind the school and a bench in front of it": of the school.
                for place in &mut at {
                    if !super::places::is_of_the_new(place, anchor.as_ref(), |thing| self.is_large(thing)) {
                        place.means(&mut anchor);
                    }
                }
                at
            } else {
                self.at = from;
                there.clone().unwrap_or_default()
            };
            // "Three barrels next to the kiosk in red, white and blue".
            let things = match &things[..] {
                [only] if self.at < end => self.in_colours(only, end).unwrap_or(things),
                _ => things,
            };
            if at.iter().any(Where::is_step) {
                return Err(self.not_understood("say from what it is so far"));
            }
            last = things.last().cloned();
            // "Deliveries to the hall: a pallet behind it" asks for no deliveries.
            let colon =
                self.at > 0 && self.words[self.lexemes[self.at - 1].end..].trim_start().starts_with(':');
            if wishes.is_empty() && !at.is_empty() && things.iter().all(|thing| thing.many) && colon {
                return Err(self.not_understood("say how many"));
            }
            // "Benches: one by the fountain, one by the kiosk".
            let is_topic =
                wishes.is_empty() && at.is_empty() && things.len() == 1 && self.is_topic(last.as_ref(), end);
            if is_topic {
                last = last.map(|thing| NewThing { count: 1, many: false, ..thing });
                self.skip_joints_to(end);
                continue;
            }
            if super::shared::is_one_each(&things, &at) {
                let one = |thing: &NewThing| NewThing { many: false, ..thing.clone() };
                let things: Vec<NewThing> = things.iter().map(one).collect();
                wishes.extend(
                    at.into_iter().map(|place| vec![Wish::Add { things: things.clone(), at: vec![place] }]),
                );
            } else {
                wishes.push(vec![Wish::Add { things, at }]);
            }
            self.skip_joints_to(end);
        }
        super::shared::share_back(&mut wishes);
        if wishes.is_empty() { Err(self.not_understood("say what to add")) } else { Ok(wishes) }
    }

    /// New things that share a place: "two benches, a bin and a lamp", "a table a lamp and a bin".
    pub(super) fn listed(&mut self, last: Option<&NewThing>, end: usize) -> Result<Vec<NewThing>, PlanError> {
        let mut things = match self.coloured_each(end) {
            Some(things) => things,
            None => vec![self.another(end, last).map_or_else(|| self.new_thing(end), Ok)?],
        };
        if let [only] = &things[..]
            && let Some(each) = self.in_colours(&only.clone(), end)
        {
            things = each;
        }
        while let Some(count) = joint(self.rest(end)).or_else(|| begins_another(self.rest(end)).then_some(0))
        {
            // "With a gap of ten metres" is where.
            if self.is_place(self.at) {
                break;
            }
            let start = self.at;
            self.at += count;
            self.skip_joints_to(end);
            let is_more = || Reader { ..*self }.another(end, things.last()).is_some();
            if self.at >= end || self.is_place(self.at) || is_more() {
                self.at = start;
                break;
            }
            things.push(self.new_thing(end)?);
        }
        Ok(things)
    }

    /// "Plant there two palm trees": the place before them, which it passes.
    fn there_first(&mut self, end: usize) -> Option<Vec<Where>> {
        let is_there = matches!(self.word(self.at), Some("there" | "here"))
            && (!self.is_definite(self.at + 1) || self.is_bare_plural(self.at + 1, end));
        let there = if is_there { self.places_to(self.at, self.at + 1) } else { None };
        self.at += usize::from(there.is_some());
        there
    }

    /// Whether a thing is a building or an area.
    fn is_large(&self, thing: &Reference) -> bool {
        match &thing.target {
            Target::Any(class) => class.is_place() || class.is_area(),
            Target::Named(ids) => ids
                .iter()
                .filter_map(|id| self.view.scene.entity(*id))
                .any(|entity| matches!(entity.kind, EntityKind::Building | EntityKind::Ground)),
            _ => false,
        }
    }

    /// Whether what was named is only what "one" stands for behind it.
    fn is_topic(&self, last: Option<&NewThing>, end: usize) -> bool {
        let mut next = *self;
        next.skip_joints_to(end);
        next.at > self.at && next.another(end, last).is_some()
    }

    /// "Another one": as the thing before.
    pub(super) fn another(&mut self, end: usize, last: Option<&NewThing>) -> Option<NewThing> {
        let last = last?;
        let count = longest_phrase(
            self.rest(end),
            &[
                "another one",
                "one more",
                "another",
                "a second one",
                "one",
                "a third one",
                "the other one",
                "the other",
            ],
        )
        .map(|words| (1, words));
        // "Benches: ten along the museum".
        let (number, count) = count.or_else(|| numbers::count(self.rest(end)))?;
        if !self.is_place(self.at + count) {
            return None;
        }
        self.at += count;
        Some(NewThing { count: number, many: false, ..last.clone() })
    }

    /// "A parasol for the café": whose it is to be, if that is a thing of the scene.
    fn for_whom(&mut self, end: usize) -> Option<Anchor> {
        if self.word(self.at) != Some("for") || !self.is_certain(self.at + 1) {
            return None;
        }
        let mut parser = self.parser(self.at + 1, self.before_politeness(self.at, end));
        let thing = parser.reference(0).ok()?;
        let after = parser.at;
        let ends =
            after >= self.before_politeness(self.at, end) || self.is_joint(after) || self.is_place(after);
        ends.then(|| {
            self.at = after;
            Anchor::Thing(thing)
        })
    }

    /// "Next to the fountain, statue and kiosk": a noun without an article, behind a place, is no new thing.
    fn is_bare_singular(&self, end: usize) -> bool {
        let rest = self.rest(end);
        longest_phrase(rest, ARTICLES).is_none()
            && numbers::number(rest).is_none()
            && longest(rest, PAINTS).is_none()
            && longest(rest, SIZES).is_none()
            && !self.is_bare_plural(self.at, end)
    }

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
        let mut thing = NewThing {
            words: Vec::new(),
            count: 1,
            many: false,
            paint: None,
            scale: 1.0,
            height: None,
            name: None,
            text: String::new(),
        };
        while self.at < end {
            let rest = self.rest(end);
            // "A three-legged stool" is one.
            let is_part = |words: usize| self.words[rest[words - 1].end..].starts_with('-');
            if let Some((metres, words)) = self.new_height(end) {
                (thing.height, self.at) = (Some(metres), self.at + words);
            } else if let Some((count, words)) =
                numbers::count(rest).filter(|(_, words)| thing.words.is_empty() && !is_part(*words))
            {
                (thing.count, self.at) = (count, self.at + words);
            } else if self.word(self.at) == Some("please") && self.at + 1 < end && self.is_place(self.at + 1)
            {
                self.at += 1;
            } else if let Some((count, words)) = times_behind(rest) {
                (thing.count, self.at) = (count, self.at + words);
            } else if let Some(words) = longest_phrase(rest, FEW).filter(|_| thing.words.is_empty()) {
                (thing.count, self.at) = (super::ground::ROW, self.at + words);
            } else if self.at > start
                && matches!(self.word(self.at), Some("in" | "around"))
                && self.is_place(self.at)
            {
                // "One in front".
                break;
            } else if let Some(words) = longest_phrase(rest, ARTICLES).filter(|_| thing.words.is_empty()) {
                self.at += words;
            } else if let Some(words) =
                longest_phrase(rest, CALLED).filter(|_| self.word(start) != Some("the"))
            {
                self.at += words;
                thing.name = Some(self.new_name(end));
                break;
            } else if let Some(words) = longest_phrase(rest, PURPOSES).filter(|words| {
                !thing.words.is_empty()
                    && (self.at + words >= end
                        || self.is_place(self.at + words)
                        || joint(&rest[*words..]).is_some())
            }) {
                self.at += words;
            } else if self.ends_thing(&thing, start, end) {
                break;
            } else if let Some(words) = longest_phrase(rest, POSTURES)
                .filter(|words| !thing.words.is_empty() && self.is_place((self.at + words).min(end)))
            {
                self.at += words;
                break;
            } else if let Some((paint, words)) = longest(rest, PAINTS).filter(|_| thing.paint.is_none()) {
                (thing.paint, self.at) = (Some(paint), self.at + words);
            } else if let Some((factor, words)) = longest(rest, FACTORS).filter(|_| !thing.words.is_empty()) {
                // "A bench twice as big".
                (thing.scale, self.at) = (factor, self.at + words);
            } else if let Some((factor, words)) = longest(rest, SIZES).filter(|_| thing.words.is_empty()) {
                (thing.scale, self.at) = (factor, self.at + words);
            } else if self.word(self.at) == Some("more") && !thing.words.is_empty() {
                self.at += 1;
            } else if let Token::Word(word) = &rest[0].token {
                thing.words.push(word.clone());
                self.at += 1;
            } else {
                break;
            }
        }
        thing.text = self.written(start, self.at);
        thing.many = thing.count == 1 && self.is_of_many(start, &thing);
        if is_mass(&thing) && !self.says_one(start)
            || thing.words.is_empty()
            || matches!(&thing.words[..], [only] if ["place", "spot", "thing", "town", "city", "scene", "way", "one"].contains(&only.as_str()))
            || thing.words.iter().any(|word| NO_NOUNS.contains(&word.as_str()))
        {
            self.at = start;
            return Err(self.not_understood("say what to add"));
        }
        Ok(thing)
    }

    /// Whether an article says that it is one.
    fn says_one(&self, start: usize) -> bool {
        #[rustfmt::skip]
        const ONE: &[&str] = &["a", "an", "one", "another", "a single", "one more", "yet another", "a new", "a further", "an extra", "an additional", "just one", "the", "also a", "just a"];
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
        let is_next =
            thing.words.last().is_some_and(|word| !OF.contains(&word.as_str())) && begins_another(rest);
        is_next
            || joint(rest).is_some()
            || self.is_place(self.at)
            || self.word(self.at) == Some("for") && !thing.words.is_empty() && self.is_certain(self.at + 1)
            || self.before_politeness(start, end) <= self.at
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

/// Whether one more thing is named, with nothing between it and the one before.
fn begins_another(lexemes: &[super::super::lexer::Lexeme]) -> bool {
    let in_words = lexemes.first().is_some_and(|lexeme| matches!(lexeme.token, Token::Word(_)));
    let is_size = longest(lexemes, FACTORS).is_some()
        || longest_phrase(
            lexemes,
            &["a bit", "a little", "a lot", "a tad", "a metre", "a meter", "a bit of"],
        )
        .is_some();
    in_words
        && !is_size
        && numbers::length(lexemes).is_none()
        && (longest_phrase(lexemes, &["a", "an"]).is_some() || numbers::count(lexemes).is_some())
}

/// Behind these an article belongs to the same noun: "a statue of a dog".
const OF: &[&str] = &["of", "with", "for", "in", "on", "like", "as", "half", "from", "than", "at"];

/// "x 4" behind a noun: how many, and how many words say so.
fn times_behind(lexemes: &[super::super::lexer::Lexeme]) -> Option<(u32, usize)> {
    let times = longest_phrase(lexemes, &["x", "times"])?;
    let number = lexemes.get(times..times + 1)?;
    let Token::Number(_) = number.first()?.token else { return None };
    numbers::number(number)
        .map(|(count, words)| (count as u32, times + words))
        .filter(|(count, _)| (1..=1000).contains(count))
}
