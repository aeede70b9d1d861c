//! What a remark is about, which is what "it" stands for behind it: "the van is ugly; paint it", "they left a bike here, remove it".

use simworld_core::id::{EntityId, RoadId};
use simworld_core::net::polyline;

use super::super::clause::{Choice, Count, Reference, Stands, Target};
use super::super::compass::{DIRECTIONS, MOST};
use super::super::lexer::{Lexeme, Token, is_mark};
use super::super::lexicon::{Category, category, longest, longest_phrase};
use super::super::phrases::Phrases;
use super::super::resolve::Purpose;
use super::super::streets::StreetNames;
use super::parse::Reader;
use super::wish::{Anchor, Where};

impl Reader<'_> {
    /// The things of the scene that a remark names.
    pub(super) fn spoken_of(&self, from: usize, end: usize) -> Vec<Reference> {
        let (first, mut at) = match self.shown(from, end) {
            Some((thing, after)) => (Some(thing), after),
            None => (None, from),
        };
        let mut things: Vec<Reference> = first.into_iter().collect();
        if self.asks_who(from, end) || self.is_of_a_species(from, end) && !self.one_begins(from, end) {
            return things;
        }
        // "They have dumped a car by the shop": it is the car.
        if let Some(thing) = self.left_there(from, end) {
            return vec![thing];
        }
        // "Eve says the van is ugly": it is the van of which she speaks.
        if let Some(what) = self.reported(from, end) {
            at = what;
        }
        while at < end {
            match self.named_at(at, end) {
                Some((thing, after)) => {
                    things.push(thing);
                    at = after;
                }
                None => at += 1,
            }
        }
        things
    }

    /// "There's a hydrant by the fountain": of that one it is spoken; and where that ends.
    fn shown(&self, from: usize, end: usize) -> Option<(Reference, usize)> {
        #[rustfmt::skip]
        const SHOWS: &Phrases = &Phrases::of(&["theres", "there is", "there are", "you see", "you can see", "i see", "we have", "i can see", "there stands", "why is there", "why are there", "whys there",
            "who put", "who parked", "who left", "why do we have", "why have we", "what is", "whats", "who needs"]);
        let at = from + longest_phrase(&self.lexemes[from..end], SHOWS)?;
        let mut parser = self.parser(at, end);
        let thing = parser.reference(0).ok().filter(|_| parser.at > at)?;
        Some((Reference { indefinite: false, ..thing }, parser.at))
    }

    /// "That old pine takes the light": it is the pine, which is not here.
    fn is_of_a_species(&self, from: usize, end: usize) -> bool {
        let that = longest_phrase(&self.lexemes[from..end], &["that", "this", "the"]);
        let is_species = |at: usize| super::follow::species(&self.lexemes[at]).is_some();
        that.is_some_and(|words| {
            is_species((from + words).min(end - 1)) || from + words + 1 < end && is_species(from + words + 1)
        })
    }

    /// "Who is that next to the statue?"
    fn asks_who(&self, from: usize, end: usize) -> bool {
        longest_phrase(&self.lexemes[from..end], &["who is that", "whos that", "what is that", "whats that"])
            .is_some_and(|words| from + words < end && self.is_place(from + words))
    }

    /// A thing of the scene that is named here, and where its name ends.
    pub(super) fn named_at(&self, at: usize, end: usize) -> Option<(Reference, usize)> {
        let says_which =
            longest_phrase(&self.lexemes[at..end], &["the", "that", "this", "my", "those", "our", "these"])
                .is_some();
        let named = self.names.exact(&self.lexemes[at..end]);
        let is_certain = says_which || named.is_some();
        let mut parser = self.parser(at, end);
        if let Ok(thing) = parser.reference(0)
            && is_certain
            && parser.at > at
            && !matches!(thing.target, Target::It | Target::Them | Target::Here | Target::There)
        {
            return Some((group_at(&thing).unwrap_or(thing), parser.at));
        }
        // "Dmitri is waiting for the bus": a name, whatever is said behind it.
        match named {
            Some((ids, words)) => {
                Some((Reference::to(Target::Named(ids), self.written(at, at + words)), at + words))
            }
            None => self.shortest_named(at, end).filter(|_| is_certain),
        }
    }

    /// "The green bench is facing the wrong way": the thing, where what is said behind it makes no sense.
    fn shortest_named(&self, at: usize, end: usize) -> Option<(Reference, usize)> {
        const LONGEST: usize = 6;
        (at + 2..end.min(at + LONGEST)).find_map(|cut| {
            // "The bus stop is facing the wrong way" is not about the bus.
            let is_within =
                |from: usize| category(&self.lexemes[from..end]).is_some_and(|(_, words)| from + words > cut);
            if (at..cut).any(is_within) {
                return None;
            }
            let thing = self.one_of(at, cut).ok().filter(|thing| !super::says::is_it(thing))?;
            Some((thing, cut))
        })
    }

    /// What a remark says somebody left somewhere.
    fn left_there(&self, from: usize, end: usize) -> Option<Reference> {
        const LEFT: &[&str] =
            &["dumped", "left", "parked", "put", "placed", "forgot", "dropped", "abandoned", "forgotten"];
        (from + 1..end).find_map(|at| {
            self.word(at).filter(|word| LEFT.contains(word))?;
            longest_phrase(&self.lexemes[at + 1..end], &["a", "an", "another", "their", "his", "her"])?;
            let mut parser = self.parser(at + 1, end);
            let mut thing = parser.reference(0).ok()?;
            thing.indefinite = false;
            Some(thing)
        })
    }

    /// Where begins what somebody says or thinks.
    fn reported(&self, from: usize, end: usize) -> Option<usize> {
        #[rustfmt::skip]
        const SAYS: &[&str] = &["says", "said", "thinks", "thought", "complains", "complained", "told", "hates", "likes", "dislikes", "believes", "reckons", "finds", "found", "noticed", "saw", "loves", "wants", "asked", "claims", "insists",
            "mentioned", "wonders", "stole", "broke", "hit", "crashed", "prefers", "knows", "sees", "needs", "painted", "bought", "sold", "trips", "tripped"];
        let mut parser = self.parser(from, end);
        let somebody = parser.reference(0).ok()?;
        let at = parser.at;
        let says = at > from && at + 1 < end && self.word(at).is_some_and(|word| SAYS.contains(&word));
        let named = says
            && longest_phrase(&self.lexemes[at + 1..end], &["it", "them", "him", "her"]).is_none()
            && !super::follow::is_open(&somebody)
            && (at + 1..end).any(|at| self.is_certain(at));
        (says && named).then_some(at + 1)
    }

    /// The first place that a remark names: "by the fountain" of "there is nowhere to sit by the fountain".
    pub(super) fn place_spoken_of(&self, from: usize, end: usize) -> Option<Vec<super::wish::Where>> {
        (from..end).filter(|at| self.is_place(*at)).find_map(|at| {
            let mut reader = Reader { at, ..self.up_to(end) };
            let found = reader.place(end).ok();
            let found = found.or_else(|| self.place_before_remark(at, end).map(|(place, _)| place));
            let place = found.filter(|place| {
                // "Looks empty to me" says nothing of where.
                place.anchor().is_some_and(|anchor| !anchor.is_it() && anchor != Anchor::Viewer)
            })?;
            Some(vec![place])
        })
    }
}

impl Reader<'_> {
    /// What a remark says how it is, if there is only one of it: "Rose Park feels empty" asks for something in the park.
    pub(super) fn subject_place(&self, from: usize, end: usize) -> Option<Vec<Where>> {
        let small = longest_phrase(
            &self.lexemes[from..end],
            &["oh", "well", "how", "poor", "also", "i think", "i feel", "honestly"],
        );
        let from = from + small.unwrap_or(0);
        if !self.is_certain(from) || self.reported(from, end).is_some() {
            return None;
        }
        let mut parser = self.parser(from, end);
        let thing =
            parser.reference(0).ok().filter(|thing| parser.at > from && !super::follow::is_open(thing))?;
        let found = self.view.candidates(&thing, Purpose::Any).ok()?;
        (found.len() == 1).then(|| vec![Where::By(Anchor::Thing(thing))])
    }
}

/// "The kids at the school": nobody asks anything of them, but of the school.
pub(super) fn group_at(thing: &Reference) -> Option<Reference> {
    let Target::Any(class) = &thing.target else { return None };
    let are_people = !class.kinds().is_empty()
        && class.kinds().iter().all(|kind| *kind == simworld_core::scene::EntityKind::Person);
    match &thing.relation {
        Some(Stands::To(_, anchor) | Stands::Of(anchor)) if are_people && thing.text.contains('s') => {
            let first =
                thing.text.split_whitespace().find(|word| !["the", "those", "our", "my"].contains(word));
            first.is_some_and(|word| word.ends_with('s') || word == "people").then(|| (**anchor).clone())
        }
        _ => None,
    }
}

/// "The kids race on Elm Street, so close it": the one street that is spoken of, where it is closed or opened by a pronoun.
pub(super) fn name_streets(lexemes: &mut Vec<Lexeme>, streets: &StreetNames) {
    const VERBS: &Phrases = &Phrases::of(&[
        "close",
        "shut",
        "open",
        "reopen",
        "block",
        "unblock",
        "close off",
        "block off",
        "shut off",
        "seal off",
    ]);
    const IT: &Phrases = &Phrases::of(&[
        "it",
        "the street",
        "the road",
        "that street",
        "this street",
        "that road",
        "this road",
    ]);
    #[rustfmt::skip]
    const SHALL_BE: &Phrases = &Phrases::of(&["has to be closed", "must be closed", "should be closed", "needs to be closed", "has to be shut", "must be shut", "should be shut", "needs to be shut", "needs closing", "has to close", "must close",
        "can be opened", "should be opened", "must be opened", "has to be opened", "can be reopened", "should be reopened"]);
    let found = (1..lexemes.len()).find_map(|at| {
        // "They're digging up Oak Street, so it has to be closed".
        let told = longest_phrase(&lexemes[at..], IT)
            .filter(|words| longest_phrase(&lexemes[at + words..], SHALL_BE).is_some());
        let (verb, it) = if let Some(words) = told {
            (0, words)
        } else {
            let verb = longest_phrase(&lexemes[at..], VERBS)?;
            (verb, longest_phrase(&lexemes[at + verb..], IT)?)
        };
        let end = at + verb + it;
        // "Oak Street goes car-free, shut it" says it twice.
        let is_said = (0..at).any(|at| {
            longest_phrase(
                &lexemes[at..],
                &["car free", "free", "off limits", "banned", "close", "shut", "goes"],
            )
            .is_some()
        });
        if is_said {
            return None;
        }
        let is_whole = told.is_some()
            || lexemes.get(end).is_none_or(is_mark)
            || longest_phrase(
                &lexemes[end..],
                &[
                    "for", "again", "off", "please", "to", "so", "because", "down", "up", "now", "and",
                    "already", "then",
                ],
            )
            .is_some();
        let mut named = (0..at).filter_map(|from| Some((from, streets.at(&lexemes[from..at])?.words)));
        let street = named.next().filter(|_| is_whole)?;
        let is_only = named.all(|(from, _)| from < street.0 + street.1);
        let begin = half_before(lexemes, street.0);
        is_only.then_some((at + verb, end, (begin, street.1 + street.0 - begin)))
    });
    if let Some((from, end, (street, words))) = found {
        let name = lexemes[street..street + words].to_vec();
        lexemes.splice(from..end, name);
    }
}

/// Where "the western half of" begins before a street; the street itself, where nothing of the kind stands there.
fn half_before(lexemes: &[Lexeme], street: usize) -> usize {
    /// So many words it takes at most.
    const LONGEST: usize = 6;
    #[rustfmt::skip]
    const PARTS: &Phrases = &Phrases::of(&["half of", "part of", "end of", "bit of", "section of", "stretch of", "piece of", "side of", "portion of", "half of the", "part of the", "end of the"]);
    let is_half = |from: &usize| {
        let said = &lexemes[*from..street];
        let the = longest_phrase(said, &["the"]).unwrap_or(0);
        let rest = &said[the..];
        let compass = longest(rest, MOST).or_else(|| longest(rest, DIRECTIONS));
        compass.is_some_and(|(_, words)| {
            the > 0 && longest_phrase(&rest[words..], PARTS) == Some(rest.len() - words)
        })
    };
    (street.saturating_sub(LONGEST)..street).find(is_half).unwrap_or(street)
}

impl Reader<'_> {
    /// The words with what "that bench" stands for in its place, where a bench was told of more closely before: "there is one bench in
    /// the park, so put a lamp next to that bench".
    pub(super) fn with_what_was_pointed_at(&self) -> Option<Vec<Lexeme>> {
        (2..self.lexemes.len()).find_map(|at| {
            longest_phrase(&self.lexemes[at..], &["that", "this", "the same"])?;
            let (class, words) = category(self.lexemes.get(at + 1..)?)?;
            let after = at + 1 + words;
            // "That bench by the fountain" says itself which.
            if self.is_place(after) || !self.is_place_before(at) {
                return None;
            }
            let told = (0..at).find_map(|from| self.told_before(from, at, class))?;
            let mut lexemes = self.lexemes.to_vec();
            lexemes.splice(at..after, told);
            Some(lexemes)
        })
    }

    /// Whether a word of place ends before a word.
    fn is_place_before(&self, at: usize) -> bool {
        (at.saturating_sub(4)..at).any(|from| {
            longest(&self.lexemes[from..], &super::words::WAYS).is_some_and(|(_, words)| from + words == at)
        })
    }

    /// A thing of a class that is told of more closely than by its noun, with an article that says which.
    fn told_before(&self, from: usize, stop: usize, class: &Category) -> Option<Vec<Lexeme>> {
        let article = longest_phrase(&self.lexemes[from..stop], &["the", "a", "an", "one", "this", "that"])?;
        let mut parser = self.parser(from, stop);
        let thing = parser.reference(0).ok()?;
        let is_closer =
            thing.relation.is_some() || thing.choice != Choice::Open || thing.traits.paint.is_some();
        let is_it = matches!(&thing.target, Target::Any(own) if **own == *class) && is_closer;
        if !is_it || parser.at <= from + article {
            return None;
        }
        let the = super::forms::word_at(&self.lexemes[from], "the");
        Some(std::iter::once(the).chain(self.lexemes[from + article..parser.at].iter().cloned()).collect())
    }
}

impl Reader<'_> {
    /// The words with the thing itself for "the street lamp closest to Oak Street": of such things the nearest to a street, if one is
    /// nearer than all others.
    pub(super) fn with_nearest_to_street(&self) -> Option<Vec<Lexeme>> {
        #[rustfmt::skip]
        const NEAREST: &Phrases = &Phrases::of(&["closest to", "nearest to", "nearest", "that is closest to", "thats closest to", "which is closest to", "that is nearest to", "thats nearest to", "which is nearest to", "that stands closest to",
            "standing closest to", "that stands nearest to"]);
        let streets = self.view.streets?;
        (2..self.lexemes.len()).find_map(|at| {
            let words = longest_phrase(&self.lexemes[at..], NEAREST)?;
            let behind = at + words;
            let the = longest_phrase(self.lexemes.get(behind..)?, &["the"]).unwrap_or(0);
            let street = streets.at(self.lexemes.get(behind + the..)?)?;
            let (from, thing) = (at.saturating_sub(LONGEST_NAMED)..at).find_map(|from| {
                let mut parser = self.parser(from, at);
                let thing = parser.reference(0).ok()?;
                (self.word(from) == Some("the") && parser.at == at).then_some((from, thing))
            })?;
            let nearest = self.nearest_to(&thing, street.roads)?;
            let end = behind + the + street.words;
            let mut lexemes = self.lexemes.to_vec();
            let one = Lexeme {
                token: Token::Id(nearest),
                lemma: None,
                end: lexemes[end - 1].end,
                ..lexemes[from].clone()
            };
            lexemes.splice(from..end, [one]);
            Some(lexemes)
        })
    }

    /// Of all such things the nearest to the middle of any of some roads; none if two are as near.
    fn nearest_to(&self, thing: &Reference, roads: &[RoadId]) -> Option<EntityId> {
        /// As near is what differs by less, m.
        const ALIKE: f64 = 0.5;
        let network = self.view.scene.roads()?;
        let all = Reference { count: Count::One, choice: Choice::Farthest, ..thing.clone() };
        let found = self.view.candidates(&all, Purpose::Any).ok()?;
        let distance = |id: EntityId| {
            let point = self.view.scene.entity(id)?.planar();
            let to = |road: &RoadId| polyline::closest(&network.roads.get(road.index())?.centerline, &point);
            roads.iter().filter_map(to).map(|near| near.distance).min_by(f64::total_cmp)
        };
        let mut near: Vec<(f64, EntityId)> =
            found.into_iter().filter_map(|(_, id)| Some((distance(id)?, id))).collect();
        near.sort_by(|one, other| one.0.total_cmp(&other.0));
        match near[..] {
            [(_, only)] => Some(only),
            [(one, nearest), (other, _), ..] if other - one > ALIKE => Some(nearest),
            _ => None,
        }
    }
}

/// A thing before "closest to" has no more words than that.
const LONGEST_NAMED: usize = 5;
