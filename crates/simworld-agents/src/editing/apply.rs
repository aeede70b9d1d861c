//! Typed edits to commands, one after another, each in the scene as the ones before leave it.

use std::f64::consts::TAU;

use simworld_core::alteration::Alteration;
use simworld_core::asset::Asset;
use simworld_core::command::Command;
use simworld_core::geometry::{Pose, heading, yaw_of};
use simworld_core::id::{AssetId, EntityId, RoadId};
use simworld_core::ops::wrap_angle;
use simworld_core::passage::Passage;
use simworld_core::scene::{EntityDesc, EntityRef, Relation, Scene};
use simworld_core::seed::Stream;

use super::Placing;
use super::astray::Astray;
use super::carry::Load;
use super::describe::{describe, listed, made_as};
use super::edit::{Edit, Make, Stand};
use super::editable::Editable;
use super::error::EditError;
use super::land::Streets;
use super::place::Placer;
use super::reader::ReadBy;
use super::relax::relaxed;
use super::rest::with_what_hangs_on;
use super::row::tell;
use super::solid::Solid;
use super::stand::Subject;
use super::stay::resize;
use super::stock::{Stock, door_of};
use super::taken::Taken;
use crate::language::edits::Focus;

/// Sizes beyond these are no longer the thing, as a factor.
const FACTORS: std::ops::RangeInclusive<f64> = 0.05..=20.0;
/// More new things at once are refused.
const MOST: u32 = 1000;

/// What a sentence did.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Edited {
    /// What it was understood as, in order.
    pub edits: Vec<Edit>,
    /// Things that it made, in order.
    pub made: Vec<EntityId>,
    /// The answer to a question.
    pub answer: Option<String>,
    /// Who understood it.
    pub read_by: ReadBy,
    /// What was taken where several things fit, under a policy that does not ask
    /// ([`SceneEditor::with_policy`](super::SceneEditor::with_policy)).
    pub taken: Vec<Taken>,
    /// What stands on ground that is for something else, for nothing better was found where it was asked for; the answer says so.
    pub astray: Vec<Astray>,
}

/// What an editor keeps of a sentence.
pub(super) struct Memory {
    pub(super) focus: Option<Focus>,
    pub(super) placed: u64,
    pub(super) tried: Vec<Placing>,
}

/// Carries out edits, and can take all of them back.
pub(super) struct Applier<'a> {
    pub(super) scene: &'a mut dyn Editable,
    pub(super) stock: &'a Stock,
    pub(super) streets: Option<&'a Streets>,
    pub(super) stream: Stream,
    pub(super) placed: u64,
    pub(super) focus: Focus,
    pub(super) edited: Edited,
    /// The commands that take back what was done, the last first to be carried out last.
    pub(super) back: Vec<Command>,
    pub(super) tried: Vec<Placing>,
}

impl Applier<'_> {
    /// What was done and how to take it back; where it failed, all of it is taken back.
    pub(super) fn finish(self, kept: bool) -> (Edited, Vec<Command>, Memory) {
        let Self { scene, mut back, focus, placed, tried, edited, .. } = self;
        back.reverse();
        if !kept {
            for command in &back {
                // Nothing else changed the scene since.
                let _ = scene.change(command);
            }
            back.clear();
        }
        (edited, back, Memory { focus: kept.then_some(focus), placed, tried })
    }

    pub(super) fn apply(&mut self, edit: &Edit) -> Result<(), EditError> {
        match edit {
            Edit::Add { make, count, stands } => self.add(make, *count, stands),
            Edit::Row { make, line, spacing } => self.row(make, line, *spacing),
            Edit::Remove { things } => self.remove_all(things),
            Edit::Move { things, stands } => self.move_all(things, stands),
            Edit::Rotate { things, angle } => things.iter().try_for_each(|thing| {
                let pose = *self.entity(*thing)?.pose;
                self.turn(*thing, wrap_angle(yaw_of(&pose) + angle % TAU))
            }),
            Edit::Face { things, towards } => {
                let target = self.entity(*towards)?.planar();
                things.iter().try_for_each(|thing| {
                    let way = target - self.entity(*thing)?.planar();
                    self.turn(*thing, heading(&way))
                })
            }
            Edit::Swap { one, other } => self.swap(*one, *other),
            Edit::Paint { things, color } => {
                things.iter().try_for_each(|thing| self.alter(*thing, Alteration::Color(Some(*color))))
            }
            Edit::Scale { things, factor } => things.iter().try_for_each(|thing| self.scale(*thing, *factor)),
            Edit::Copy { thing, count, stands } => self.copy(*thing, *count, stands),
            Edit::Name { thing, name } => self.alter(*thing, Alteration::Name(Some(name.clone()))),
            Edit::SetEnvironment(environment) => self.change(&Command::SetEnvironment(*environment)),
            Edit::SetPassage { roads, passage } => self.pass(roads, *passage),
            Edit::Leave { why } => {
                tell(&mut self.edited.answer, why);
                Ok(())
            }
            Edit::Count { what, things } => {
                self.edited.answer = Some(format!("{} {what}", things.len()));
                Ok(())
            }
            Edit::List { things } => {
                self.focus.it = things.first().copied().or(self.focus.it);
                self.edited.answer = Some(listed(self.scene.world(), things, self.focus.from));
                Ok(())
            }
            Edit::Describe { thing } => {
                self.entity(*thing)?;
                self.focus.it = Some(*thing);
                self.edited.answer = Some(describe(self.scene.world(), *thing));
                Ok(())
            }
        }
    }

    // ---- the edits ----

    fn add(&mut self, make: &Make, count: u32, stands: &[Stand]) -> Result<(), EditError> {
        let desc = self.recipe(make)?;
        self.put_new(&desc, count, stands)?;
        self.focus.beside = beside(stands);
        if count > 1 {
            // "Plant three trees behind the school and put a goal in front of it."
            self.focus.it = self.focus.beside.or(self.focus.it);
        }
        Ok(())
    }

    fn put_new(&mut self, desc: &EntityDesc, count: u32, stands: &[Stand]) -> Result<(), EditError> {
        if count > MOST {
            let what = format!("to add {count} things at once");
            return Err(EditError::Impossible { what, why: format!("add at most {MOST}") });
        }
        for rank in 0..count {
            let subject = Subject { id: None, kind: desc.kind, info: &desc.info };
            let pose = self.place(subject, (rank, count), stands, (&[], &[]))?;
            self.spawn(EntityDesc { pose, ..desc.clone() })?;
        }
        Ok(())
    }

    /// Puts a recipe into the world, where its pose says.
    pub(super) fn spawn(&mut self, desc: EntityDesc) -> Result<(), EditError> {
        let at = simworld_core::geometry::planar(&desc.pose);
        let applied = self.scene.change(&Command::Spawn(Box::new(desc)))?;
        self.back.extend(applied.undo);
        self.edited.made.extend(applied.spawned);
        self.focus.it = applied.spawned.or(self.focus.it);
        self.focus.place = Some(at);
        Ok(())
    }

    /// Closes or opens streets both ways; what is so already is left.
    fn pass(&mut self, roads: &[RoadId], passage: Passage) -> Result<(), EditError> {
        let network = self.scene.world().roads().cloned();
        let mut legs = Vec::new();
        for road in roads {
            let known = network.as_ref().and_then(|network| network.roads.get(road.index()));
            let missing =
                || EditError::NotFound { wanted: format!("road {}", road.0), near: "it is gone".to_owned() };
            legs.extend(known.ok_or_else(missing)?.directions().map(|direction| (*road, direction)));
        }
        legs.retain(|leg| self.scene.world().is_closed(*leg) != (passage == Passage::Closed));
        if legs.is_empty() {
            let is = if passage == Passage::Open { "open" } else { "closed" };
            let what = format!("to have that street {is}");
            return Err(EditError::Impossible { what, why: format!("it is {is} already") });
        }
        self.focus.roads = roads.to_vec();
        legs.into_iter().try_for_each(|leg| self.change(&Command::SetPassage { leg, passage }))
    }

    /// The recipe of a new thing, still without a place. What it is made from is an asset of the world.
    pub(super) fn recipe(&mut self, make: &Make) -> Result<EntityDesc, EditError> {
        let unknown = || EditError::UnknownThing {
            wanted: make.asset.clone(),
            near: "name one of the catalogue".to_owned(),
        };
        check_factor(make.scale)?;
        let stock = self.stock;
        let catalogue = &stock.catalogue;
        let found = catalogue.find(&make.asset).and_then(|id| Some((id, catalogue.get(id)?)));
        let (id, asset) = found.ok_or_else(unknown)?;
        let mut desc = recipe_of(asset, id, make);
        desc.info.asset = self.stocked(asset)?;
        Ok(desc)
    }

    /// Takes things out; what stood on them, or hung on them, is set down.
    fn remove_all(&mut self, things: &[EntityId]) -> Result<(), EditError> {
        // Looked at before anything is gone, for what stands on two of them falls past both.
        let loads: Vec<Load> = things.iter().map(|thing| self.load(*thing, things)).collect();
        let mut told = Vec::new();
        for thing in things {
            let at = self.entity(*thing)?.planar();
            let called = self.kind_and_label(*thing);
            told.push(format!("to remove {}", self.label(*thing)));
            self.change(&Command::Remove { id: *thing })?;
            self.focus.leaves(&called, at);
            self.focus.place = Some(at);
            self.focus.it = self.focus.it.filter(|it| it != thing);
        }
        for (load, what) in loads.iter().zip(&told) {
            self.set_down(&load.left_in_the_air(), load.ground, what)?;
        }
        Ok(())
    }

    /// Puts things elsewhere, each with what stands on it. What lay on several of them falls past all when all are gone.
    fn move_all(&mut self, things: &[EntityId], stands: &[Stand]) -> Result<(), EditError> {
        let is_first = |(at, thing): &(usize, &EntityId)| !things[..*at].contains(thing);
        let once: Vec<EntityId> =
            things.iter().enumerate().filter(is_first).map(|(_, thing)| *thing).collect();
        let (things, count) = (&once[..], once.len() as u32);
        let mut left = with_what_hangs_on(self.scene.world(), things);
        let loads: Vec<Load> = things.iter().map(|thing| self.load(*thing, things)).collect();
        let mut told = Vec::new();
        for (rank, (thing, load)) in things.iter().zip(&loads).enumerate() {
            let desc = self.entity(*thing)?.to_desc();
            self.stands_to_no_load_of_its_own(*thing, load, stands)?;
            let mut lifted = self.lifted(&[(*thing, load)]);
            lifted.extend(&left);
            let subject = Subject { id: Some(*thing), kind: desc.kind, info: &desc.info };
            let on_it = load.seen_from(&desc.pose);
            let pose = self.place(subject, (rank as u32, count), stands, (&lifted, &on_it))?;
            let what = format!("to move {}", self.label(*thing));
            let called = self.kind_and_label(*thing);
            self.change(&Command::Move { id: *thing, pose })?;
            self.focus.leaves(&called, simworld_core::geometry::planar(&desc.pose));
            self.carry(load, (&desc.pose, &pose), &lifted, &what)?;
            told.push(what);
            left.retain(|id| id != thing);
            self.focus.it = Some(*thing);
            self.focus.place = Some(simworld_core::geometry::planar(&pose));
        }
        for (load, what) in loads.iter().zip(&told) {
            self.set_down(&load.leaning, load.ground, what)?;
        }
        self.focus.beside = beside(stands);
        Ok(())
    }

    fn copy(&mut self, thing: EntityId, count: u32, stands: &[Stand]) -> Result<(), EditError> {
        let mut desc = self.entity(thing)?.to_desc();
        desc.attachment = None;
        desc.twist = simworld_core::geometry::Twist::ZERO;
        let beside = [Stand::To { relation: Relation::Near, anchor: thing }];
        self.put_new(&desc, count, if stands.is_empty() { &beside } else { stands })
    }

    // ---- how it is done ----

    /// Finds a place, or says what was in the way and what would be possible. What is lifted is as good as gone; the load goes along.
    fn place(
        &mut self,
        subject: Subject<'_>,
        rank: (u32, u32),
        stands: &[Stand],
        (lifted, load): (&[EntityId], &[Solid]),
    ) -> Result<Pose, EditError> {
        let world = self.scene.world();
        let stream = self.stream.indexed(self.placed);
        self.placed += 1;
        let placer = Placer { scene: world, streets: self.streets, from: self.focus.from, lifted, load };
        let placing = placer.place(subject, rank, stands, stream);
        let pose = placing.pose();
        let made = || made_as(world, subject.info);
        let what = || {
            let name = subject.info.name.clone().or_else(made);
            name.unwrap_or_else(|| subject.kind.to_string().replace('_', " "))
        };
        let place = || stands.iter().map(|stand| stand.told(world)).collect::<Vec<_>>().join(" and ");
        let refused = pose.is_none().then(|| {
            let instead = relaxed(&placer, subject, stands, stream);
            EditError::NoRoom {
                what: what(),
                place: place(),
                why: placing.reasons(world),
                relaxed: instead.told(world),
                instead: Box::new(instead),
            }
        });
        let astray = placing.fit().filter(|fit| fit.astray);
        let astray = astray.map(|fit| Astray { what: what(), land: fit.land, place: place(), count: 1 });
        if let Some(astray) = astray {
            astray.add_to(&mut self.edited.astray);
        }
        self.tried.push(placing);
        match (pose, refused) {
            (Some(pose), _) => Ok(pose),
            (None, Some(error)) => Err(error),
            (None, None) => unreachable!("a thing without a place is refused"),
        }
    }

    fn alter(&mut self, thing: EntityId, alteration: Alteration) -> Result<(), EditError> {
        self.entity(thing)?;
        self.change(&Command::Alter { id: thing, alteration })?;
        self.focus.it = Some(thing);
        Ok(())
    }

    pub(super) fn change(&mut self, command: &Command) -> Result<(), EditError> {
        let applied = self.scene.change(command)?;
        self.back.extend(applied.undo);
        Ok(())
    }

    pub(super) fn entity(&self, id: EntityId) -> Result<EntityRef<'_>, EditError> {
        let missing = || EditError::NotFound { wanted: format!("thing {id}"), near: "it is gone".to_owned() };
        self.scene.world().entity(id).ok_or_else(missing)
    }
}

pub(super) fn check_factor(factor: f64) -> Result<(), EditError> {
    if FACTORS.contains(&factor) {
        return Ok(());
    }
    let why = format!("give a factor from {} to {}", FACTORS.start(), FACTORS.end());
    Err(EditError::Impossible { what: format!("a size of {factor} times"), why })
}

/// The recipe of a thing that is made from an asset, which has that id, still without a place.
pub(crate) fn recipe_of(asset: &Asset, id: AssetId, make: &Make) -> EntityDesc {
    let mut desc = asset.at(id, Pose::identity());
    desc.info.access = door_of(&desc);
    desc.info.color = make.color.or(desc.info.color);
    desc.info.name.clone_from(&make.name);
    resize(&mut desc, make.scale);
    desc
}

/// The one thing that stands are about.
fn beside(stands: &[Stand]) -> Option<EntityId> {
    match stands {
        [Stand::To { anchor, .. }] => Some(*anchor),
        _ => None,
    }
}
