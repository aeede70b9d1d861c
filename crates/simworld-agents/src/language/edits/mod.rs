//! Sentences about the scene itself: "add a red sports car next to the hospital near a museum".
//!
//! The same words, names and noun phrases as in orders to a body; other verbs. A sentence is read whole first; each wish is
//! then worked out in the scene as the wishes before it leave it, so that "it" may be what was just made.

mod across;
mod across_turns;
mod afterthoughts;
mod anew;
mod answers;
mod antecedents;
mod apart;
mod aside;
mod ask;
mod asked;
mod attempts;
mod bare;
mod beforehand;
mod bounds;
mod breaks;
mod busy;
mod but_me;
mod buyers;
mod casual;
mod change;
mod chatter;
mod chatty;
mod clock;
mod compared;
mod complaints;
mod conditions;
mod denied;
mod directed;
mod distance;
mod doings;
mod door_states;
mod doubted;
mod dressed;
mod each;
mod ends;
mod everyday;
mod facing;
mod finite;
mod follow;
mod forms;
mod frames;
mod given;
mod goodbye;
mod ground;
mod headings;
mod heard;
mod hesitations;
mod homophones;
mod idle;
mod kin;
mod kin_first;
mod kin_later;
mod kin_later_turns;
mod kin_turns;
mod lastly;
mod likened;
mod loose;
mod lost_spaces;
mod make;
mod margins;
mod meant;
mod measures;
mod memo;
mod misspelt;
mod mistaken;
mod named_in_full;
mod naming;
mod narrowed;
mod nearer;
mod nicknames;
mod noun;
mod nth;
mod occasions;
mod offsets;
mod openings;
mod ordered;
mod orders;
mod originals;
mod others;
mod painted;
mod parse;
mod parts;
mod passage;
mod passing;
mod periphrases;
mod phrased;
mod picked;
mod placed;
mod places;
mod plain;
mod plainly;
mod polite;
mod portions;
mod precautions;
mod predicates;
mod presence;
mod questions;
mod ratios;
mod reconsidered;
mod remaining;
mod remarked;
mod remarks;
mod repairs;
mod replaced;
mod resolve;
mod respelt;
mod restated;
mod retold;
mod rows;
mod said_beside;
mod sayings;
mod says;
mod sells_both;
mod set_scenes;
mod sets_told;
mod settle;
mod several_nearest;
mod shades;
mod shared;
mod shares;
mod sizes;
pub(super) mod sky;
mod sky_come;
mod sky_stated;
mod slips;
mod sounds_like;
mod spared;
mod spoken;
mod spoken_first;
mod stages;
mod standing;
mod stated;
mod statements;
mod stood;
mod strangers;
mod supposed;
mod taken_up;
mod talk;
mod talk_turns;
mod talked;
mod texts;
mod there_before;
mod things;
mod told;
mod told_of;
mod topics;
mod turn;
mod turns;
mod unasked;
mod unusual;
mod unusual_first;
mod weather_told;
mod which;
mod whole;
mod wish;
mod withdrawn;
mod wording;
pub(super) mod words;

use std::sync::Arc;

use attempts::Held;
pub(crate) use heard::read;
use simworld_core::geometry::Point2;
use simworld_core::id::{EntityId, RoadId};
use simworld_core::scene::Scene;
use wish::Wish;

use super::AmbiguityPolicy;
use super::resolve::View;
use super::streets::StreetNames;

/// From where the scene is looked at, and what was spoken of.
#[derive(Clone, Debug)]
pub(crate) struct Focus {
    /// m.
    pub(crate) from: Point2,
    /// Who looks, if somebody in the scene does.
    pub(crate) who: Option<EntityId>,
    /// What "it" stands for.
    pub(crate) it: Option<EntityId>,
    /// What that was put beside, if it was.
    pub(crate) beside: Option<EntityId>,
    /// What the last wish that made anything made, unless something else was moved or taken away since: "them".
    pub(crate) made: Vec<EntityId>,
    /// What "there" stands for.
    pub(crate) place: Option<Point2>,
    /// What was moved or taken away lately, by what it is called and what it is, in small letters, and where it had stood; the last one last.
    pub(crate) left: Vec<(String, Point2)>,
    /// The streets that were spoken of last.
    pub(crate) roads: Vec<RoadId>,
    /// What streets are called.
    pub(crate) streets: Arc<StreetNames>,
    /// Whether of things that are named with an "or" one will be taken.
    pub(crate) any_of: bool,
}

impl Focus {
    /// So many places are remembered.
    const LEFT: usize = 16;

    /// Remembers where something stood that is moved or taken away.
    pub(crate) fn leaves(&mut self, called: &str, at: Point2) {
        if self.left.len() >= Self::LEFT {
            self.left.remove(0);
        }
        self.left.push((called.to_lowercase(), at));
    }
}

/// A sentence that was read.
#[derive(Clone, Debug)]
pub(crate) struct Reading {
    words: String,
    /// Each wish in all its readings.
    wishes: Vec<Vec<Wish>>,
    /// What was found out of the wishes while they were read, if all of them can be granted.
    held: Option<Held>,
    /// Whether of things that are named with an "or" one was to be taken.
    any_of: bool,
}

impl Reading {
    /// The number of wishes.
    pub(crate) fn len(&self) -> usize {
        self.wishes.len()
    }
}

/// "Eight stools round the fountain, and paint them orange": what is said of new things behind them is how they are made.
fn dress_new(wishes: &mut Vec<Vec<Wish>>) {
    let mut at = 1;
    while at < wishes.len() {
        let (before, behind) = wishes.split_at_mut(at);
        let taken = match (before.last_mut().map(Vec::as_mut_slice), behind.first().map(Vec::as_slice)) {
            (Some([Wish::Add { things, .. }]), Some([Wish::Paint { what, paint }]))
                if are_those(what, things) =>
            {
                for thing in things.iter_mut() {
                    thing.paint = Some(*paint);
                }
                true
            }
            (Some([Wish::Add { things, .. }]), Some([Wish::Scale { what, factor }]))
                if are_those(what, things) =>
            {
                for thing in things.iter_mut() {
                    thing.scale *= factor;
                }
                true
            }
            _ => false,
        };
        if taken {
            wishes.remove(at);
        } else {
            at += 1;
        }
    }
}

/// "Make the red bench blue and the blue bench red": which are meant is decided before any is painted.
fn paint_at_once(wishes: &mut [Vec<Wish>], finder: &resolve::Finder<'_>) {
    let all_paint =
        wishes.len() > 1 && wishes.iter().all(|readings| matches!(&readings[..], [Wish::Paint { .. }]));
    if !all_paint {
        return;
    }
    let found: Option<Vec<Vec<EntityId>>> = wishes
        .iter()
        .map(|readings| match &readings[..] {
            [Wish::Paint { what, .. }] if !what.iter().any(says::is_it) => finder.all(what).ok(),
            _ => None,
        })
        .collect();
    for (readings, things) in wishes.iter_mut().zip(found.into_iter().flatten()) {
        if let [Wish::Paint { what, .. }] = &mut readings[..] {
            let id =
                |id: EntityId| super::clause::Reference::to(super::clause::Target::Id(id), id.to_string());
            *what = things.into_iter().map(id).collect();
        }
    }
}

/// "I've no use for it, so delete the crate": "it" is what is named then, where nothing was spoken of before.
fn gone_by_name(wishes: &mut Vec<Vec<Wish>>) {
    if let [first, second, ..] = &wishes[..]
        && matches!(&first[..], [Wish::Remove { what }] if what.iter().all(says::is_it))
        && matches!(&second[..], [Wish::Remove { what }] if !what.iter().any(says::is_it))
    {
        wishes.remove(0);
    }
}

/// "I'm sick of that crate, get it out of here": what goes goes once.
fn gone_once(wishes: &mut Vec<Vec<Wish>>) {
    let removes = |readings: &[Wish]| matches!(readings.first(), Some(Wish::Remove { .. }));
    let it = |readings: &[Wish]| matches!(readings, [Wish::Remove { what }] if what.iter().all(says::is_it));
    let mut at = 1;
    while at < wishes.len() {
        // "Elm Street has to be a play street: close it".
        let is_same_passage = match (wishes[at - 1].first(), wishes[at].as_slice()) {
            (Some(Wish::Passage { passage: before, .. }), [Wish::Passage { which, passage }]) => {
                let is_it = |street: &wish::StreetRef| match street {
                    wish::StreetRef::It => true,
                    wish::StreetRef::Thing(thing) => says::is_it(thing),
                    _ => false,
                };
                before == passage && which.iter().all(is_it)
            }
            _ => false,
        };
        if is_same_passage || removes(&wishes[at - 1]) && it(&wishes[at]) {
            wishes.remove(at);
        } else {
            at += 1;
        }
    }
}

/// "She would love an olive tree next to the diner, can you add one?": what is asked for twice is made once.
fn made_once(wishes: &mut Vec<Vec<Wish>>) {
    let mut at = 1;
    while at < wishes.len() {
        // "A gazebo, yes, put one behind the school": the first is the one.
        let is_named_first = match (wishes[at - 1].as_slice(), wishes[at].as_slice()) {
            ([Wish::Add { things: named, at: nowhere }], [Wish::Add { things, at: place }, ..]) => {
                let said = |one: &wish::NewThing| {
                    one.count == 1 && ["one", "it"].contains(&one.text.to_lowercase().as_str())
                };
                let [thing] = &named[..] else {
                    at += 1;
                    continue;
                };
                nowhere.is_empty()
                    && thing.count == 1
                    && !place.is_empty()
                    && matches!(&things[..], [one] if said(one) && one.words == thing.words)
            }
            _ => false,
        };
        if is_named_first {
            wishes.remove(at - 1);
            continue;
        }
        let is_again = match (wishes[at - 1].first(), wishes[at].as_slice()) {
            (Some(Wish::Add { things: made, at: place }), [Wish::Add { things, at: own }, ..]) => {
                let said_again = |one: &wish::NewThing| {
                    one.count == 1 && ["one", "it"].contains(&one.text.to_lowercase().as_str())
                };
                let is_there = own.is_empty() || matches!(own[..], [wish::Where::There]);
                !place.is_empty() && made.len() == 1 && is_there && things.iter().all(said_again)
            }
            _ => false,
        };
        if is_again {
            wishes.remove(at);
        } else {
            at += 1;
        }
    }
}

/// Whether what is spoken of are several new things, and nothing else.
fn are_those(what: &[super::clause::Reference], things: &[wish::NewThing]) -> bool {
    let several = things.len() > 1 || things.iter().any(|thing| thing.count > 1);
    several && matches!(what, [only] if only.target == super::clause::Target::Them)
}

fn view_of<'a>(scene: &'a dyn Scene, focus: &'a Focus) -> View<'a> {
    let it = focus.it;
    View {
        scene,
        // Nobody has this id, so that nothing is left out where nobody looks.
        who: focus.who.unwrap_or(EntityId::new(u32::MAX, u32::MAX)),
        speaker: focus.who,
        from: focus.from,
        origin: focus.from,
        heading: focus
            .who
            .and_then(|who| scene.entity(who))
            .map_or(0.0, |me| simworld_core::geometry::yaw_of(me.pose)),
        range: EVERYWHERE,
        it,
        item: None,
        them: it.filter(|it| scene.entity(*it).is_some_and(|it| super::lexicon::is_animate(it.kind))),
        gone: Vec::new(),
        policy: AmbiguityPolicy::Nearest,
        streets: Some(&focus.streets),
        any_of: focus.any_of,
        told: std::cell::OnceCell::new(),
    }
}

/// Edits are about the whole scene, m.
const EVERYWHERE: f64 = 1.0e5;

/// The words of turns and remarks: none of them is a misspelling, and none is taken for what was meant by one.
fn other_words() -> impl Iterator<Item = &'static str> {
    says::words()
        .chain(frames::words())
        .chain(follow::words())
        .chain(parts::words())
        .chain(remarks::words())
        .chain(apart::words())
        .chain(predicates::words())
        .chain(complaints::words())
        .chain(repairs::words())
        .chain(facing::words())
        .chain(shares::words())
        .chain(supposed::words())
        .chain(stated::words())
        .chain(goodbye::words())
        .chain(plain::words())
        .chain(respelt::words())
        .chain(asked::words())
        .chain(others::words())
        .chain(shared::words())
        .chain(conditions::words())
        .chain(afterthoughts::words())
        .chain(whole::words())
        .chain(passing::words())
        .chain(idle::words())
        .chain(retold::words())
        .chain(breaks::words())
        .chain(told::words())
        .chain(doubted::words())
        .chain(phrased::words())
        .chain(sayings::words())
        .chain(spared::words())
        .chain(likened::words())
        .chain(chatty::words())
        .chain(chatter::words())
        .chain(mistaken::words())
        .chain(loose::words())
        .chain(talk::words())
        .chain(casual::words())
        .chain(wording::words())
        .chain(topics::words())
        .chain(originals::words())
        .chain(texts::words())
        .chain(periphrases::words())
        .chain(clock::words())
        .chain(nicknames::words())
        .chain(across::words())
        .chain(sets_told::words())
        .chain(taken_up::words())
        .chain(picked::words())
}

/// The words of the parts, so that none is taken for a misspelling.
fn more_words() -> impl Iterator<Item = &'static str> {
    offsets::words()
        .chain(passage::words())
        .chain(rows::words())
        .chain(dressed::words())
        .chain(given::words())
        .chain(measures::words())
        .chain(nearer::words())
        .chain(nth::words())
        .chain(ends::words())
        .chain(portions::words())
        .chain(remaining::words())
        .chain(bare::words())
        .chain(narrowed::words())
}
