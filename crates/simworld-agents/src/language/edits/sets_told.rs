//! Things of which one sentence tells and another takes up one or several: "there are two red cars: paint the western one black and remove the
//! other", "of the two trees, the taller one has to be felled", "both cars can go, but leave a rack where the white one was".
//!
//! Which things are told of is found in the scene, and only if as many are there as were told; what several things could be decides nothing.

use simworld_core::geometry::{Vector2, direction};
use simworld_core::id::EntityId;

use super::super::clause::{Reference, Target};
use super::super::compass::{Compass, DIRECTIONS};
use super::super::lexer::{Lexeme, is_mark, word_of};
use super::super::lexicon::{longest, longest_phrase};
use super::super::numbers;
use super::super::paint::PAINTS;
use super::super::phrases::Phrases;
use super::follow::plural_of;
use super::forms::{word_at, words_at};
use super::memo::Memo;
use super::parse::Reader;
use super::resolve::Finder;
use super::words::{VERBS, Verb};
use crate::editing::EditError;

/// Before what is there.
#[rustfmt::skip]
const LEADS: &Phrases = &Phrases::of(&["there are", "there is", "theres", "there stand", "there stands", "i see", "i can see", "you see", "you can see", "we have", "weve got", "we have got", "i have", "ive got", "i have got", "i count", "you will find", "youll find", "i spot", "i notice"]);
/// Before one of them.
const ONE: &Phrases = &Phrases::of(&["a", "an", "one", "this", "that", "a single", "just one"]);
/// Before those of which one is taken up.
const OF: &Phrases = &Phrases::of(&["of the", "of those", "of these", "of our", "among the", "out of the"]);
/// Behind several things, that they are there.
#[rustfmt::skip]
const STAND: &Phrases = &Phrases::of(&["stand", "are", "lie", "sit", "grow", "wait", "are standing", "are parked", "are lying", "are waiting", "are sitting", "are growing"]);
/// Where things are, as far as it tells none of them from the others.
#[rustfmt::skip]
const FILLERS: &Phrases = &Phrases::of(&["here", "there", "somewhere", "around here", "over there", "over here", "nearby", "standing", "parked", "lying", "waiting", "sitting", "growing", "in a row", "in a line", "in line", "side by side", "right", "just", "directly", "near me", "close to me", "not far from me", "not far from here", "not far away", "near us", "around", "about", "in all", "in total",
    "altogether", "in this scene", "in the scene", "not too far from me", "quite close to me"]);
/// Where things are as one looks.
#[rustfmt::skip]
const ASIDE: &[(&[&str], Aside)] = &[
    (&["behind me", "behind us", "behind my back", "at my back", "in my back"], Aside::Behind),
    (&["before me", "in front of me", "ahead of me", "ahead", "before us", "in front of us", "straight ahead", "in front"], Aside::Ahead),
    (&["to my left", "on my left", "to the left of me", "left of me", "on my left hand", "at my left", "to our left"], Aside::Left),
    (&["to my right", "on my right", "to the right of me", "right of me", "on my right hand", "at my right", "to our right"], Aside::Right),
];
/// Before a direction, and behind it.
const TO_THE: &Phrases = &Phrases::of(&["to the", "in the", "off to the", "over to the", "on the", "due"]);
const OF_ME: &Phrases = &Phrases::of(&["of me", "of us", "of here", "from me", "from here"]);
/// That things are to go.
#[rustfmt::skip]
const GO: &Phrases = &Phrases::of(&["can go", "may go", "must go", "should go", "shall go", "have to go", "has to go", "are to go", "need to go", "can be removed", "should be removed", "must be removed", "have to be removed", "can be taken away", "should be taken away", "can disappear", "should disappear", "must disappear", "ought to go", "are to be removed", "can be cleared away"]);
const ALL: &Phrases =
    &Phrases::of(&["both", "both of the", "both the", "all", "all the", "all of the", "the"]);
const HALF: &Phrases = &Phrases::of(&["half of the", "half the", "one half of the", "half of our"]);
const KEEP: &Phrases = &Phrases::of(&[
    "keep",
    "spare",
    "leave",
    "save",
    "retain",
    "i keep",
    "we keep",
    "but keep",
    "only keep",
    "just keep",
]);
/// One of them, and what it is.
const ONE_IS: &Phrases = &Phrases::of(&[
    "one is",
    "one of them is",
    "one stands",
    "one of them stands",
    "one sits",
    "one lies",
    "one of them lies",
]);

/// Where things are from who speaks.
#[derive(Clone, Copy)]
enum Aside {
    Ahead,
    Behind,
    Left,
    Right,
}

/// What becomes of things by the words that told of them.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Role {
    /// They are there.
    Shown,
    /// They go.
    Gone,
}

/// Things of which was told.
pub(super) struct Told {
    /// All that are called so.
    pub(super) all: Vec<EntityId>,
    /// Those that are meant.
    pub(super) things: Vec<EntityId>,
    /// What one of them is called.
    pub(super) noun: String,
    /// Where the words begin that may take them up.
    pub(super) from: usize,
    pub(super) role: Role,
}

/// Things that a noun names, in all.
pub(super) struct Called {
    /// How many there are said to be.
    count: Option<usize>,
    pub(super) things: Vec<EntityId>,
    /// The last word for one of them.
    noun: String,
    /// Where the noun ends.
    pub(super) end: usize,
}

impl Reader<'_> {
    /// The things of which the first part of a sentence tells.
    pub(super) fn told_of(&self, finder: &Finder<'_>) -> Option<Told> {
        let mark = self.lexemes.iter().position(is_mark).filter(|mark| mark + 1 < self.lexemes.len())?;
        self.shown_there(mark, finder)
            .or_else(|| self.of_several(mark, finder))
            .or_else(|| self.standing_there(mark, finder))
            .or_else(|| self.all_gone(mark, finder))
    }

    /// "There are two red cars:", "there's a lamp to the west of me.", "not far from me there is a cone."
    fn shown_there(&self, mark: usize, finder: &Finder<'_>) -> Option<Told> {
        let (lead, at) = (0..mark)
            .find_map(|at| longest_phrase(&self.lexemes[at..mark], LEADS).map(|words| (at, at + words)))?;
        let one = longest_phrase(&self.lexemes[at..mark], ONE);
        let called = self.all_called(at + one.unwrap_or(0), finder)?;
        let count = if one.is_some() { Some(1) } else { called.count };
        let things = self.narrowed((0, lead), called.things.clone(), finder)?;
        let things = self.narrowed((called.end, mark), things, finder)?;
        (count == Some(things.len())).then_some(())?;
        Some(Told { all: called.things, things, noun: called.noun, from: mark + 1, role: Role::Shown })
    }

    /// "Of the two trees, ...", "of the two cars, one is parked nearer to the chair."
    fn of_several(&self, mark: usize, finder: &Finder<'_>) -> Option<Told> {
        let of = longest_phrase(self.lexemes, OF)?;
        let called = self.all_called(of, finder).filter(|called| called.end == mark)?;
        let count = called.things.len();
        (count > 1 && called.count.is_none_or(|said| said == count)).then_some(())?;
        let Called { things, noun, .. } = called;
        let one = self.one_of_them(mark + 1, &things, finder);
        let (meant, from) = one.map_or_else(|| (things.clone(), mark + 1), |(one, from)| (vec![one], from));
        Some(Told { all: things, things: meant, noun, from, role: Role::Shown })
    }

    /// "One is parked nearer to the chair.": which, and where the next sentence begins.
    fn one_of_them(
        &self,
        from: usize,
        things: &[EntityId],
        finder: &Finder<'_>,
    ) -> Option<(EntityId, usize)> {
        let is = from + longest_phrase(self.lexemes.get(from..)?, ONE_IS)?;
        let at = is + longest_phrase(self.lexemes.get(is..)?, &["parked", "standing", "lying"]).unwrap_or(0);
        let (by, end) = self.said_to_be(at, finder)?;
        self.lexemes.get(end).filter(|mark| is_mark(mark))?;
        (end + 1 < self.lexemes.len()).then_some(())?;
        finder.picked(things, by).map(|one| (one, end + 1))
    }

    /// "Three cars stand in a row."
    fn standing_there(&self, mark: usize, finder: &Finder<'_>) -> Option<Told> {
        let called = self.all_called(0, finder)?;
        let stand = called.end + longest_phrase(self.lexemes.get(called.end..mark)?, STAND)?;
        let things = self.narrowed((stand, mark), called.things.clone(), finder)?;
        (called.count == Some(things.len())).then_some(())?;
        Some(Told { all: called.things, things, noun: called.noun, from: mark + 1, role: Role::Shown })
    }

    /// "Remove both parcels.", "both cars can go, but ..."
    fn all_gone(&self, mark: usize, finder: &Finder<'_>) -> Option<Told> {
        let verb = longest(self.lexemes, &VERBS)
            .filter(|(verb, _)| matches!(verb, Verb::Remove | Verb::Take))
            .map(|(verb, words)| (words, verb == Verb::Take));
        let at = verb.map_or(0, |(words, _)| words);
        let all = longest_phrase(self.lexemes.get(at..)?, ALL)?;
        let called = self.all_called(at + all, finder)?;
        let rest = self.lexemes.get(called.end..mark)?;
        let away = longest_phrase(rest, &["away", "out", "off"]).unwrap_or(0);
        let goes = match verb {
            Some((_, takes)) => away == rest.len() && (away > 0 || !takes),
            None => longest_phrase(rest, GO) == Some(rest.len()),
        };
        let count = called.things.len();
        let both = self.word(at) != Some("both") || count == 2;
        if !goes || !both || count < 2 || called.count.is_some_and(|said| said != count) {
            return None;
        }
        let Called { things, noun, .. } = called;
        Some(Told { all: things.clone(), things, noun, from: mark + 1, role: Role::Gone })
    }

    /// "Half of the birches can go: keep the western one": those that go.
    pub(super) fn halved(&self, finder: &Finder<'_>) -> Option<Vec<Lexeme>> {
        let half = longest_phrase(self.lexemes, HALF)?;
        let called = self.all_called(half, finder)?;
        let go = called.end + longest_phrase(self.lexemes.get(called.end..)?, GO)?;
        self.lexemes.get(go).filter(|mark| is_mark(mark))?;
        let kept = go + 1 + longest_phrase(self.lexemes.get(go + 1..)?, KEEP)?;
        let (one, words) = self.which_of(kept, (&called.things[..], called.noun.as_str()), finder)?;
        let ends = self.lexemes.get(kept + words..)?.iter().all(is_mark);
        let left: Vec<EntityId> = called.things.iter().copied().filter(|thing| Some(*thing) != one).collect();
        let is_half = one.is_some() && called.things.len() == 2 * left.len();
        let place = self.lexemes.first()?;
        (ends && is_half).then(|| vec![word_at(place, "remove"), super::taken_up::those(place, &left)])
    }

    /// "The southernmost of the three street lamps": the lamps, of which another may be spoken of behind it; and the two that are compared.
    pub(super) fn told_within(&self, finder: &Finder<'_>) -> Option<Told> {
        if let Some(pair) = self.compared_pair(finder) {
            return Some(pair);
        }
        (0..self.lexemes.len()).find_map(|at| {
            (self.word(at) == Some("the")).then_some(())?;
            let (_, next) = self.said_to_be(at, finder)?;
            let of = next + longest_phrase(self.lexemes.get(next..)?, OF)?;
            let Called { count, things, noun, .. } = self.all_called(of, finder)?;
            (things.len() > 1 && count.is_none_or(|said| said == things.len())).then_some(())?;
            Some(Told { all: things.clone(), things, noun, from: at, role: Role::Shown })
        })
    }

    /// "If the pine is taller than the oak, ...": the two.
    fn compared_pair(&self, finder: &Finder<'_>) -> Option<Told> {
        (self.word(0) == Some("if")).then_some(())?;
        let than = (3..self.lexemes.len()).find(|at| self.word(*at) == Some("than"))?;
        let is = (2..than).find(|at| self.word(*at) == Some("is"))?;
        let mark = (than + 1..self.lexemes.len()).find(|at| is_mark(&self.lexemes[*at]))?;
        let one = finder.one(&self.one_of(1, is).ok()?).ok()?;
        let other = finder.one(&self.one_of(than + 1, mark).ok()?).ok()?;
        let things = vec![one, other];
        (one != other).then(|| Told {
            all: things.clone(),
            things,
            noun: String::new(),
            from: mark + 1,
            role: Role::Shown,
        })
    }

    /// "Of the two birches, the taller one": which is asked, if they are as tall as each other. None of two is the middle one.
    pub(super) fn undecided(&self, finder: &Finder<'_>) -> Option<EditError> {
        let Told { all, noun, from, .. } = self.told_of(finder)?;
        let is_open = |at: usize| matches!(self.which_of(at, (&all[..], noun.as_str()), finder), Some((None, words)) if words > 0);
        (from..self.lexemes.len()).any(is_open).then(|| {
            let what = Reference::to(Target::Named(all.clone()), noun.clone());
            finder.ambiguous(&what, &all)
        })
    }

    /// All that a noun names, with how many there are said to be and its colour before it.
    pub(super) fn all_called(&self, at: usize, finder: &Finder<'_>) -> Option<Called> {
        let counted = numbers::count(self.lexemes.get(at..)?);
        let from = at + counted.map_or(0, |(_, words)| words);
        let paint = longest(self.lexemes.get(from..)?, PAINTS).map_or(0, |(_, words)| words);
        let noun = from + paint;
        let end = noun + self.noun_at(noun)?;
        let singular = self.last_noun(noun, end)?;
        let (last, head) = singular.split_last()?;
        let plural = plural_of(word_of(last));
        let all: Vec<Lexeme> = words_at(last, "all the")
            .chain(self.lexemes[from..noun].iter().cloned())
            .chain(head.iter().cloned())
            .chain([word_at(last, &plural)])
            .collect();
        let memo = Memo::default();
        let all = Reader { memo: &memo, ..self.over(&all) }.one_of(0, all.len()).ok()?;
        let things = finder.all(&[all]).ok()?;
        let count = counted.map(|(count, _)| count as usize);
        Some(Called { count, things, noun: word_of(last).to_owned(), end })
    }

    /// Those of some things that are where the words say, if all of these are understood.
    fn narrowed(
        &self,
        (from, end): (usize, usize),
        mut things: Vec<EntityId>,
        finder: &Finder<'_>,
    ) -> Option<Vec<EntityId>> {
        let mut at = from;
        while at < end {
            let rest = &self.lexemes[at..end];
            if let Some((way, words)) = aside(rest, finder) {
                let lies = |thing: &EntityId| {
                    let entity = finder.scene.entity(*thing);
                    entity.is_some_and(|entity| (entity.planar() - finder.focus.from).dot(&way) > 0.0)
                };
                things.retain(lies);
                at += words;
            } else {
                at += longest_phrase(rest, FILLERS)?;
            }
        }
        Some(things)
    }
}

/// "Behind me", "to the west of me": in which direction from who speaks, world frame.
fn aside(rest: &[Lexeme], finder: &Finder<'_>) -> Option<(Vector2, usize)> {
    if let Some((aside, words)) = longest(rest, ASIDE) {
        let ahead = finder.focus.who.map(|_| direction(finder.view.heading))?;
        let way = match aside {
            Aside::Ahead => ahead,
            Aside::Behind => -ahead,
            Aside::Left => finder.hand(true)?,
            Aside::Right => finder.hand(false)?,
        };
        return Some((way, words));
    }
    let to = longest_phrase(rest, TO_THE).unwrap_or(0);
    let (compass, words): (Compass, usize) = longest(&rest[to..], DIRECTIONS)?;
    let of = to + words;
    Some((compass.step(), of + longest_phrase(&rest[of..], OF_ME)?))
}

/// Every word of these tables, for the spelling.
pub(super) fn words() -> impl Iterator<Item = &'static str> {
    let phrases = [LEADS, OF, STAND, FILLERS, GO, HALF, KEEP, ONE_IS].into_iter().flatten();
    phrases.flat_map(|phrase| phrase.split(' '))
}
