//! Conditions on the sky and on room, and how far the wishes reach that stand on a condition: "if it rains, put an umbrella next
//! to Fay", "put a bench there if there is room".

use simworld_core::seam::PlanError;

use super::super::clause::{Count, Reference, Target};
use super::super::lexer::{Token, is_mark};
use super::super::lexicon::{longest, longest_phrase};
use super::super::phrases::Phrases;
use super::parse::Reader;
use super::wish::Wish;
use super::words::VERBS;

/// What begins a condition.
#[rustfmt::skip]
const IF: &Phrases = &Phrases::of(&["if", "unless", "only if", "but only if", "in case", "provided", "provided that", "as long as", "assuming", "assuming that", "so long as", "should"]);
/// Of a condition on room, which is one of everything that is placed.
#[rustfmt::skip]
const ROOM: &Phrases = &Phrases::of(&["if there is room", "if there is space", "if there is enough room", "if there is enough space", "if theres room", "if theres space", "if theres enough room", "if theres enough space", "if there is any room",
    "if theres any room", "if you find room", "if you find space", "if there is still room", "if theres still room", "if there is a free spot", "if theres a free spot", "if it fits", "if they fit", "if room allows",
    "if space allows", "if there is room for it", "if theres room for it", "if there is room there", "if theres room there", "if there is place", "if it fits there", "provided it fits", "as long as it fits", "if you can find room",
    "if theres any space", "if there is any space", "as long as there is room", "provided there is room", "space permitting", "room permitting", "provided theres room", "as long as theres room"]);

impl Reader<'_> {
    /// "Add one": of what was just asked for, and where.
    pub(super) fn one_of_those(&mut self, what: &Reference, end: usize) -> Option<Wish> {
        let stop = self.before_politeness(self.at, end);
        let removes = longest_phrase(
            self.rest(stop),
            &[
                "remove one",
                "delete one",
                "take one away",
                "remove one of them",
                "get rid of one",
                "take away one",
                "remove any one of them",
            ],
        );
        if removes.is_some_and(|words| self.at + words == stop) {
            self.at = end;
            let one = Reference { count: Count::Exactly(1), indefinite: true, ..what.clone() };
            return Some(Wish::Remove { what: vec![one] });
        }
        let adds = longest_phrase(
            self.rest(stop),
            &["add", "put", "place", "build", "make", "create", "plant", "set up", "add me"],
        )?;
        let words = longest_phrase(
            &self.lexemes[self.at + adds..stop],
            &["one", "one there", "one here", "a new one"],
        )?;
        // "Put one in": where one was looked for.
        let last = self.at + adds + words;
        let is_particle = last + 1 == stop && matches!(self.word(last), Some("in" | "up" | "down" | "out"));
        let words = words + usize::from(is_particle);
        let Target::Any(class) = &what.target else { return None };
        // "If there is no picnic table, add one": a picnic table, and no table.
        let said = super::super::lexer::lex(&what.text.to_lowercase());
        let article = longest_phrase(&said, &["a", "an", "any", "no", "the"]).unwrap_or(0);
        let asset = self.names.asset_words(&said[article..]).filter(|words| *words > 1);
        let asset: Option<Vec<String>> = asset.map(|words| {
            said[article..article + words]
                .iter()
                .filter_map(|lexeme| match &lexeme.token {
                    Token::Word(word) => Some(word.clone()),
                    _ => None,
                })
                .collect()
        });
        let noun = asset.unwrap_or_else(|| class.words[0].split(' ').map(str::to_owned).collect());
        let from = self.at + adds + words;
        let at = if from < stop {
            let mut reader = Reader { at: from, ..*self };
            reader.places(stop).ok().filter(|_| reader.at >= stop)?
        } else {
            let Some(super::super::clause::Stands::To(relation, anchor)) = &what.relation else {
                return None;
            };
            vec![super::wish::Where::To(*relation, super::wish::Anchor::Thing((**anchor).clone()))]
        };
        let thing = super::wish::NewThing {
            text: noun.join(" "),
            words: noun,
            count: 1,
            many: false,
            paint: what.traits.paint,
            scale: 1.0,
            size: None,
            name: None,
        };
        self.at = end;
        Some(Wish::Add { things: vec![thing], at })
    }

    /// Whether the wish that begins here stands on a condition that is told first.
    pub(super) fn begins_condition(&self) -> bool {
        longest_phrase(&self.lexemes[self.at..], IF).is_some()
            && self.word(self.at) != Some("should")
            && longest_phrase(&self.lexemes[self.at..], super::polite::POLITE).is_none()
    }

    /// Whether what follows a mark still belongs to a condition: "otherwise ...".
    pub(super) fn goes_on_otherwise(&self, at: usize) -> bool {
        longest_phrase(
            &self.lexemes[at..],
            &["otherwise", "else", "or else", "if not", "if there is none", "if none"],
        )
        .is_some()
    }

    /// A wish if there is room, which is the wish itself.
    ///
    /// # Errors
    /// What the wish is about is not there.
    pub(super) fn given_room(&mut self, end: usize) -> Result<Option<Vec<Vec<Wish>>>, PlanError> {
        let start = self.at;
        let found = (start..end)
            .find_map(|at| longest_phrase(&self.lexemes[at..end], ROOM).map(|words| (at, at + words)));
        let Some((at, after)) = found else { return Ok(None) };
        let (from, stop) = if at > start {
            let closes = self.before_politeness(after.saturating_sub(1), end) <= after;
            (start, if closes { at } else { return Ok(None) })
        } else {
            (after, end)
        };
        let wishes = self.wishes_between(from, stop)?;
        self.at = end;
        Ok(Some(wishes))
    }

    /// A wish if the sky is so, told before or behind.
    pub(super) fn given_sky(&mut self, end: usize) -> Option<Vec<Vec<Wish>>> {
        let start = self.at;
        (start..end).find_map(|at| {
            let words = longest_phrase(&self.lexemes[at..end], IF)?;
            // "It should be evening and it should rain" is none.
            if self.word(at) == Some("should") && at > start && !is_mark(&self.lexemes[at - 1]) {
                return None;
            }
            let so = self.word(at) != Some("unless");
            let from = at + words;
            let ends = |cut: &usize| {
                is_mark(&self.lexemes[*cut])
                    || longest_phrase(&self.lexemes[*cut..end], &["then"]).is_some()
                    || at == start && longest(&self.lexemes[*cut..end], &VERBS).is_some()
            };
            let cut = (from + 1..end).find(ends).unwrap_or(end);
            // "If it isn't raining".
            let denied = longest_phrase(
                &self.lexemes[from..cut],
                &["it isnt", "it is not", "its not", "it does not", "it doesnt", "there is no", "theres no"],
            );
            let (so, from) = (so == denied.is_none(), from + denied.unwrap_or(0));
            let sky = Reader { at: from, ..self.up_to(cut) }.sky(cut)?;
            let (from, stop) = if at == start { (cut, end) } else { (start, at) };
            if at > start && self.before_politeness(cut.saturating_sub(1), end) > cut {
                return None;
            }
            let wishes = self.wishes_between(from, stop).ok()?;
            let when = |wish| Wish::When { sky: sky.clone(), so, then: Box::new(wish) };
            self.at = end;
            Some(vec![at_once(wishes).into_iter().map(when).collect()])
        })
    }

    /// A wish if a street is closed or open, told before or behind.
    pub(super) fn given_passage(&mut self, end: usize) -> Option<Vec<Vec<Wish>>> {
        let start = self.at;
        (start..end).find_map(|at| {
            let words = longest_phrase(&self.lexemes[at..end], IF)?;
            let is_it = self.word(at + words) == Some("it") && at > start;
            let own = || (super::wish::StreetRef::It, at + words + 1);
            let (street, after) = if is_it { own() } else { self.street_ref(at + words, end)? };
            let (said, closed) = self.passable(after, end)?;
            let closed = closed == (self.word(at) != Some("unless"));
            let cut = after + said;
            let (from, stop) = if at == start { (cut, end) } else { (start, at) };
            if at > start && self.before_politeness(cut.saturating_sub(1), end) > cut {
                return None;
            }
            let wishes = self.wishes_between(from, stop).ok()?;
            let which = match wishes.first().and_then(|readings| readings.first()) {
                Some(Wish::Passage { which, .. }) if is_it => which.clone(),
                _ if is_it => return None,
                _ => vec![street],
            };
            let when = |wish| Wish::WhenPassage { which: which.clone(), closed, then: Box::new(wish) };
            self.at = end;
            Some(vec![at_once(wishes).into_iter().map(when).collect()])
        })
    }

    /// All wishes between two places.
    pub(super) fn wishes_between(&self, from: usize, stop: usize) -> Result<Vec<Vec<Wish>>, PlanError> {
        let mut stop = stop;
        while stop > from && is_mark(&self.lexemes[stop - 1]) {
            stop -= 1;
        }
        let mut reader = Reader { at: from, ..self.up_to(stop) };
        while reader.lexemes.get(reader.at).is_some_and(is_mark) {
            reader.at += 1;
        }
        reader.sentence()
    }

    /// "Theyre red", "its red": who is meant, if it is said in one word with what is said of it.
    pub(super) fn contracted(&self, at: usize) -> bool {
        matches!(self.word(at), Some("its" | "theyre")) && matches!(self.lexemes[at].token, Token::Word(_))
    }
}

/// Several wishes as one, in all its readings if it is alone.
pub(super) fn at_once(mut wishes: Vec<Vec<Wish>>) -> Vec<Wish> {
    if wishes.len() == 1 {
        return wishes.remove(0);
    }
    vec![Wish::All(wishes.into_iter().filter_map(|readings| readings.into_iter().next()).collect())]
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    IF.iter().chain(ROOM).flat_map(|phrase| phrase.split(' '))
}
