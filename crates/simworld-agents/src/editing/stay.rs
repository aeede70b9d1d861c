//! Edits of what stays in its place, or takes that of another: turns, sizes and swaps. They are refused where the thing would run into
//! something, or where the ground bears it no longer.

use simworld_core::command::Command;
use simworld_core::geometry::Point3;
use simworld_core::ground::Ground;
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityDesc, EntityKind, EntityRef, Scene, Shape};

use super::apply::{Applier, check_factor};
use super::carry::Load;
use super::check::SUPPORT_GAP;
use super::describe::called;
use super::error::EditError;
use super::land::Streets;
use super::place::{doors_before, doorway, in_the_way, land_carries, under};
use super::rest::{carries, support_of};
use super::solid::Solid;
use super::suits::Site;

/// A thing as it stands, or would.
#[derive(Clone, Copy)]
struct Body {
    kind: EntityKind,
    /// Where one stands to enter it, in its own frame.
    access: Option<Point3>,
    solid: Solid,
}

impl Body {
    fn of(entity: &EntityRef<'_>) -> Self {
        Self { kind: entity.kind, access: entity.info.access, solid: Solid::of(entity) }
    }

    /// The same as another solid in the place of one that stood there: on land that rises and falls it stands as high as that bears it.
    fn placed(&self, scene: &dyn Scene, solid: Solid, was: &Self) -> Self {
        let stood = |land: &Ground| (under(land, was.kind, &was.solid).1 - was.solid.base()).abs();
        match scene.ground() {
            Some(land) if stood(land) <= SUPPORT_GAP => {
                let by = under(land, self.kind, &solid).1 - solid.base();
                Self { solid: solid.raised(by), ..*self }
            }
            _ => Self { solid, ..*self },
        }
    }
}

/// How a thing would stand, and how things stood before: what was amiss then is no fault of the edit.
struct Change<'a> {
    body: Body,
    /// What it would stand on, if that is no ground.
    support: Option<EntityId>,
    /// The thing itself, and who it changes places with.
    before: &'a [Body],
    /// What is as good as gone meanwhile.
    lifted: &'a [EntityId],
}

impl Change<'_> {
    /// Why the thing may not stand so although nothing is in the way.
    fn fault(&self, scene: &dyn Scene, streets: Option<&Streets>) -> Option<String> {
        let label = |id: EntityId| {
            scene.entity(id).map_or_else(String::new, |it| called(scene, &it).replace('_', " "))
        };
        if let Some(support) = self.support.and_then(|id| scene.entity(id)) {
            let held = self.before.iter().any(|before| carries(&support, &before.solid));
            let slips = held && !carries(&support, &self.body.solid);
            return slips.then(|| format!("{} does not hold all of it", label(support.id)));
        }
        let doors = |body: &Body| doors_before(scene, &body.solid, self.lifted);
        let open = |door: &EntityId| !self.before.iter().any(|before| doors(before).contains(door));
        if let Some(door) = doors(&self.body).into_iter().find(open) {
            return Some(format!("the door of {} would be blocked", label(door)));
        }
        let blocks = |body: &Body| {
            let door = body.access.filter(|_| body.kind == EntityKind::Building)?;
            in_the_way(scene, &doorway(&body.solid, door), self.lifted)
        };
        if let Some(with) = blocks(&self.body)
            && !self.before.iter().any(|before| blocks(before).is_some())
        {
            return Some(format!("{} would stand before its door", label(with)));
        }
        let site = Site { scene, streets, gone: self.lifted, asked: &[] };
        let street = |body: &Body| site.suits(body.kind, &body.solid).err();
        let land = |body: &Body| land_carries(scene, body.kind, &body.solid, false).err();
        self.worse(&street).or_else(|| self.worse(&land)).map(str::to_owned)
    }

    /// What speaks against it that did not speak against what stood there, or against itself where it stood.
    fn worse(&self, fault: &dyn Fn(&Body) -> Option<&'static str>) -> Option<&'static str> {
        let why = fault(&self.body)?;
        (!self.before.iter().any(|before| fault(before) == Some(why))).then_some(why)
    }
}

impl Applier<'_> {
    /// Turns a thing where it stands, with what stands on it.
    pub(super) fn turn(&mut self, thing: EntityId, yaw: f64) -> Result<(), EditError> {
        let entity = self.entity(thing)?;
        let (was, at) = (Body::of(&entity), entity.position());
        let turned = Solid::standing(was.solid.shape, at, yaw);
        let body = was.placed(self.scene.world(), turned, &was);
        let what = format!("to turn {}", self.label(thing));
        let load = self.load(thing, &[]);
        let lifted = self.lifted(&[(thing, &load)]);
        let support = support_of(self.scene.world(), thing);
        self.may_stand(&Change { body, support, before: &[was], lifted: &lifted }, &what)?;
        self.change(&Command::Move { id: thing, pose: body.solid.pose })?;
        self.carry(&load, (&was.solid.pose, &body.solid.pose), &lifted, &what)?;
        self.set_down(&load.leaning, load.ground, &what)?;
        self.focus.it = Some(thing);
        Ok(())
    }

    /// Has two things change places, each with what stands on it.
    pub(super) fn swap(&mut self, one: EntityId, other: EntityId) -> Result<(), EditError> {
        let what = "to have the two change places".to_owned();
        let (a, b) = (Body::of(&self.entity(one)?), Body::of(&self.entity(other)?));
        let (on_one, on_other) = (self.load(one, &[]), self.load(other, &[]));
        for (load, above, below) in [(&on_one, other, one), (&on_other, one, other)] {
            if load.things.iter().any(|(id, _)| *id == above) {
                let why = format!("{} stands on {}", self.label(above), self.label(below));
                return Err(EditError::Impossible { what, why });
            }
        }
        let world = self.scene.world();
        let supports = (support_of(world, one), support_of(world, other));
        let there = a.placed(world, Solid { pose: b.solid.pose, shape: a.solid.shape }, &b);
        let here = b.placed(world, Solid { pose: a.solid.pose, shape: b.solid.shape }, &a);
        let lifted = self.lifted(&[(one, &on_one), (other, &on_other)]);
        let before = [a, b];
        for (body, support) in [(there, supports.1), (here, supports.0)] {
            self.may_stand(&Change { body, support, before: &before, lifted: &lifted }, &what)?;
        }
        let moved = |load: &Load, from: &Body, to: &Body| -> Vec<Solid> {
            let load = load.things.iter().map(|(_, it)| it.carried(&from.solid.pose, &to.solid.pose));
            load.chain([to.solid]).collect()
        };
        let (ones, others) = (moved(&on_one, &a, &there), moved(&on_other, &b, &here));
        if ones.iter().any(|solid| others.iter().any(|other| solid.overlaps(other))) {
            let why = "they stand too near to each other; move one of them away first".to_owned();
            return Err(EditError::Impossible { what, why });
        }
        self.change(&Command::Move { id: one, pose: there.solid.pose })?;
        self.change(&Command::Move { id: other, pose: here.solid.pose })?;
        self.carry(&on_one, (&a.solid.pose, &there.solid.pose), &lifted, &what)?;
        self.carry(&on_other, (&b.solid.pose, &here.solid.pose), &lifted, &what)?;
        for load in [&on_one, &on_other] {
            let left = load.leaning.iter().copied().filter(|id| ![one, other].contains(id));
            self.set_down(&left.collect::<Vec<_>>(), load.ground, &what)?;
        }
        self.focus.it = Some(one);
        Ok(())
    }

    /// Makes a thing larger or smaller; what stands on it stands on its new top.
    pub(super) fn scale(&mut self, thing: EntityId, factor: f64) -> Result<(), EditError> {
        check_factor(factor)?;
        let entity = self.entity(thing)?;
        let (was, mut desc) = (Body::of(&entity), entity.to_desc());
        resize(&mut desc, factor);
        let grown = Body { access: desc.info.access, ..was };
        let solid = Solid { pose: desc.pose, shape: desc.info.shape };
        let body = grown.placed(self.scene.world(), solid, &was);
        desc.pose = body.solid.pose;
        let what = format!("to make {} so large", self.label(thing));
        let load = self.load(thing, &[]);
        let lifted = self.lifted(&[(thing, &load)]);
        let support = support_of(self.scene.world(), thing);
        self.may_stand(&Change { body, support, before: &[was], lifted: &lifted }, &what)?;
        // Mass and access change with the shape, which no alteration does.
        self.exchange(thing, desc)?;
        self.lift(thing, &load, body.solid.top() - was.solid.top(), &what)?;
        self.focus.it = Some(thing);
        Ok(())
    }

    /// Puts another in the place of a thing; it keeps the id and what hangs on it.
    fn exchange(&mut self, thing: EntityId, desc: EntityDesc) -> Result<(), EditError> {
        let load = self.scene.world().load(thing);
        self.change(&Command::Remove { id: thing })?;
        self.change(&Command::Respawn { id: thing, desc: Box::new(desc), load })
    }

    /// Refuses what would run into something, or stand where the ground bears it no longer.
    fn may_stand(&self, change: &Change<'_>, what: &str) -> Result<(), EditError> {
        self.is_clear(&change.body.solid, change.lifted, what)?;
        match change.fault(self.scene.world(), self.streets) {
            None => Ok(()),
            Some(why) => Err(EditError::Impossible { what: what.to_owned(), why }),
        }
    }
}

/// Larger in all three directions; the mass grows with the volume.
pub(super) fn resize(desc: &mut EntityDesc, factor: f64) {
    desc.info.shape = match desc.info.shape {
        Shape::Box { size } => Shape::Box { size: size * factor },
        Shape::Cylinder { radius, height } => {
            Shape::Cylinder { radius: radius * factor, height: height * factor }
        }
        Shape::Capsule { radius, height } => {
            Shape::Capsule { radius: radius * factor, height: height * factor }
        }
        Shape::Sphere { radius } => Shape::Sphere { radius: radius * factor },
        other => other,
    };
    desc.info.mass = desc.info.mass.map(|mass| mass * factor * factor * factor);
    desc.info.access = desc.info.access.map(|access| access * factor);
}
