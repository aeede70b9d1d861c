//! Sentences about the scene itself: "add a red sports car next to the hospital near a museum".
//!
//! The same words, names and noun phrases as in orders to a body; other verbs. A sentence is read whole first; each wish is
//! then worked out in the scene as the wishes before it leave it, so that "it" may be what was just made.

mod ask;
mod change;
mod complaints;
mod dressed;
mod follow;
mod forms;
mod frames;
mod given;
mod ground;
mod make;
mod offsets;
mod orders;
mod parse;
mod parts;
mod passage;
mod places;
mod resolve;
mod rows;
mod says;
pub(super) mod sky;
mod slips;
mod stated;
mod turn;
mod wish;
pub(super) mod words;

use std::sync::Arc;

use parse::{Reader, UNDERSTOOD};
use simworld_core::geometry::Point2;
use simworld_core::id::{EntityId, RoadId};
use simworld_core::scene::Scene;
use simworld_core::seam::PlanError;
use wish::Wish;

use super::names::Names;
use super::parser::shortened;
use super::resolve::View;
use super::streets::StreetNames;
use super::{AmbiguityPolicy, LONGEST_SENTENCE, hearing};
use crate::editing::{EditError, Stock};

/// From where the scene is looked at, and what was spoken of.
#[derive(Clone, Debug)]
pub(crate) struct Focus {
    /// m.
    pub(crate) from: Point2,
    /// Who looks, if somebody in the scene does.
    pub(crate) who: Option<EntityId>,
    /// What "it" stands for.
    pub(crate) it: Option<EntityId>,
    /// What "there" stands for.
    pub(crate) place: Option<Point2>,
    /// The streets that were spoken of last.
    pub(crate) roads: Vec<RoadId>,
    /// What streets are called.
    pub(crate) streets: Arc<StreetNames>,
}

/// A sentence that was read.
#[derive(Clone, Debug)]
pub(crate) struct Reading {
    words: String,
    /// Each wish in all its readings.
    wishes: Vec<Vec<Wish>>,
}

impl Reading {
    /// The number of wishes.
    pub(crate) fn len(&self) -> usize {
        self.wishes.len()
    }
}

/// Reads a sentence; names are those of the scene.
pub(crate) fn read(
    words: &str,
    scene: &dyn Scene,
    stock: &Stock,
    focus: &Focus,
) -> Result<Reading, EditError> {
    if words.chars().count() > LONGEST_SENTENCE {
        let hint = format!("say it in at most {LONGEST_SENTENCE} characters");
        return Err(EditError::NotUnderstood { words: shortened(words), fragment: String::new(), hint });
    }
    let view = view_of(scene, focus);
    let names = Names::new(scene, focus.from, super::RANGE);
    let mut lexemes = hearing::hear(words, None);
    slips::correct(words, &mut lexemes, &names, stock, &focus.streets);
    orders::in_plain_words(&mut lexemes);
    let reader = Reader { words, lexemes: &lexemes, names: &names, view: &view, at: 0, depth: 0 };
    Ok(Reading { words: words.to_owned(), wishes: wishes_of(reader, stock)? })
}

/// The wishes of a sentence: as it stands or, if that is not understood or asks for what nobody has, part by part.
fn wishes_of(reader: Reader<'_>, stock: &Stock) -> Result<Vec<Vec<Wish>>, PlanError> {
    let is_new = |thing: &wish::NewThing| thing.make(stock).is_ok();
    let is_known = |wish: &Wish| match wish {
        Wish::Add { things, .. } => things.iter().all(is_new),
        Wish::Replace { with: thing, .. } | Wish::Row { thing, .. } => is_new(thing),
        _ => true,
    };
    let are_known = |wishes: &Vec<Vec<Wish>>| wishes.iter().flatten().all(is_known);
    let plain = Reader { ..reader }.sentence();
    if plain.as_ref().is_ok_and(are_known) {
        return plain;
    }
    let in_parts = reader.in_parts().or_else(|| reader.complaint());
    match (plain, in_parts) {
        (_, Some(wishes)) if are_known(&wishes) => Ok(wishes),
        (Ok(wishes), _) | (Err(_), Some(wishes)) => Ok(wishes),
        (Err(error), None) => Err(error),
    }
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
        them: it.filter(|it| scene.entity(*it).is_some_and(|it| super::lexicon::is_animate(it.kind))),
        gone: Vec::new(),
        policy: AmbiguityPolicy::Nearest,
        streets: Some(&focus.streets),
    }
}

/// Edits are about the whole scene, m.
const EVERYWHERE: f64 = 1.0e5;

/// The words of the parts, so that none is taken for a misspelling.
fn more_words() -> impl Iterator<Item = &'static str> {
    says::words()
        .chain(frames::words())
        .chain(follow::words())
        .chain(parts::words())
        .chain(orders::words())
        .chain(complaints::words())
        .chain(offsets::words())
        .chain(passage::words())
        .chain(rows::words())
        .chain(dressed::words())
        .chain(given::words())
}
