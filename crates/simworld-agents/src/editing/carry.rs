//! What stands on a thing that an edit moves, turns, resizes or takes away: it goes along, or is set down on what is below.

use simworld_core::command::Command;
use simworld_core::geometry::Pose;
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityKind, Scene};

use super::apply::Applier;
use super::borne::{is_borne, rest_below, surface_below};
use super::check::SUPPORT_GAP;
use super::describe::called;
use super::edit::Stand;
use super::error::EditError;
use super::place::{in_the_way, under};
use super::rest::{bearer_of, foot_of, load_of, middle_of, touching, with_what_hangs_on};
use super::row::tell;
use super::solid::Solid;

/// So many things that were set down are told one by one.
const TOLD: usize = 4;
/// Ground that lies so much deeper than who carries is below who flies, m.
const DEEP: f64 = 0.5;

/// What stands on a thing before an edit touches that.
pub(super) struct Load {
    /// All that goes where the thing goes, each behind what it stands on, as it stands.
    pub(super) things: Vec<(EntityId, Solid)>,
    /// Those of them that stand on the thing itself.
    pub(super) direct: Vec<EntityId>,
    /// What touches the top of the thing, and has its middle on something else, or between.
    pub(super) leaning: Vec<EntityId>,
    /// What hangs on the thing: what somebody holds, who sits on it.
    held: Vec<EntityId>,
    /// The height of the ground below, where the scene has no land, m.
    pub(super) ground: f64,
}

impl Load {
    /// The same in the frame of the thing, whose pose that is.
    pub(super) fn seen_from(&self, pose: &Pose) -> Vec<Solid> {
        self.things.iter().map(|(_, solid)| solid.carried(pose, &Pose::identity())).collect()
    }

    /// The things that lose what holds them up where the thing is taken away.
    pub(super) fn left_in_the_air(&self) -> Vec<EntityId> {
        self.held.iter().chain(&self.direct).chain(&self.leaning).copied().collect()
    }
}

impl Applier<'_> {
    /// What stands on a thing, but for what is edited itself, with what stands on that.
    pub(super) fn load(&self, thing: EntityId, besides: &[EntityId]) -> Load {
        let world = self.scene.world();
        let ids = load_of(world, thing, besides);
        let solid = |id: &EntityId| world.entity(*id).map(|entity| (*id, Solid::of(&entity)));
        let direct = ids.iter().copied().filter(|id| bearer_of(world, *id) == Some(thing)).collect();
        let mut leaning = touching(world, thing);
        leaning.retain(|id| !ids.contains(id) && !besides.contains(id));
        let mut held = Vec::new();
        world.visit_attached(thing, &mut |part| held.push(part.id));
        held.retain(|id| !besides.contains(id));
        let ground = world.entity(foot_of(world, thing)).map_or(0.0, |foot| foot.position().z);
        Load { things: ids.iter().filter_map(solid).collect(), direct, leaning, held, ground }
    }

    /// Things that are as good as gone while an edit moves these with their loads: all of them, and what hangs on any.
    pub(super) fn lifted(&self, things: &[(EntityId, &Load)]) -> Vec<EntityId> {
        let with_load = things
            .iter()
            .flat_map(|(thing, load)| std::iter::once(*thing).chain(load.things.iter().map(|(id, _)| *id)));
        with_what_hangs_on(self.scene.world(), &with_load.collect::<Vec<_>>())
    }

    /// Refuses to put a thing in relation to what stands on it, for that goes along.
    pub(super) fn stands_to_no_load_of_its_own(
        &self,
        thing: EntityId,
        load: &Load,
        stands: &[Stand],
    ) -> Result<(), EditError> {
        let mut anchors = stands.iter().flat_map(Stand::anchors);
        let is_on_it = |anchor: &EntityId| load.things.iter().any(|(id, _)| id == anchor);
        let Some(anchor) = anchors.find(is_on_it) else { return Ok(()) };
        let told: Vec<String> = stands.iter().map(|stand| stand.told(self.scene.world())).collect();
        let what = format!("to put {} {}", self.label(thing), told.join(" and "));
        let why = format!("{} stands on it; move that first", self.label(anchor));
        Err(EditError::Impossible { what, why })
    }

    /// Puts a load where it stands on a thing that went from one pose to another.
    pub(super) fn carry(
        &mut self,
        load: &Load,
        (from, to): (&Pose, &Pose),
        lifted: &[EntityId],
        what: &str,
    ) -> Result<(), EditError> {
        for (id, solid) in &load.things {
            self.put(*id, &solid.carried(from, to), lifted, what)?;
        }
        Ok(())
    }

    /// Puts what stands on a thing on its new top, which is so much higher; sets down what no longer has its middle there.
    pub(super) fn lift(
        &mut self,
        thing: EntityId,
        load: &Load,
        by: f64,
        what: &str,
    ) -> Result<(), EditError> {
        let lifted = self.lifted(&[(thing, load)]);
        let mut fallen = load.leaning.clone();
        for id in &load.direct {
            let world = self.scene.world();
            let (below, above) = (self.entity(thing)?, self.entity(*id)?);
            if by < -SUPPORT_GAP && is_borne(world, &above) {
                // The top that sinks is not all that it stands on.
                continue;
            }
            if Solid::of(&below).distance_to(middle_of(&above)) > 0.0 {
                fallen.push(*id);
                continue;
            }
            let mut group = vec![*id];
            group.extend(load_of(world, *id, &[]));
            self.raise(&group, by, &lifted, what)?;
        }
        self.set_down(&fallen, load.ground, what)
    }

    /// Sets things down that nothing holds up any more, with all that stands on them: on the highest thing below each, or on the ground.
    /// What still stands stays. Where a thing would slip off what is below, the edit is refused. The answer says what was set down.
    pub(super) fn set_down(&mut self, things: &[EntityId], ground: f64, what: &str) -> Result<(), EditError> {
        let mut told = Vec::new();
        for thing in things {
            let world = self.scene.world();
            let entity = self.entity(*thing)?;
            let (middle, solid, low) = (middle_of(&entity), Solid::of(&entity), entity.bounds.min.z);
            if is_borne(world, &entity) {
                continue;
            }
            let mut group = vec![*thing];
            group.extend(load_of(world, *thing, &[]));
            let lifted = with_what_hangs_on(world, &group);
            let below = rest_below(world, &solid, middle, &lifted);
            if let Some(rest) = below.filter(|rest| !rest.stays) {
                let (label, on) = (self.label(*thing), self.label(rest.on));
                let why = format!("{label} would slip off {on}, which is below it; move {label} first");
                return Err(EditError::Impossible { what: what.to_owned(), why });
            }
            let height =
                below.map_or_else(|| self.ground_under(entity.kind, &solid, ground), |rest| rest.top);
            if (height - low).abs() <= SUPPORT_GAP {
                continue;
            }
            let on = below.map_or_else(|| "the ground".to_owned(), |rest| self.label(rest.on));
            told.push(format!("{} ({thing}) was set down on {on}", self.label(*thing)));
            self.raise(&group, height - low, &lifted, what)?;
        }
        match told.len() {
            0 => {}
            1..=TOLD => tell(&mut self.edited.answer, &told.join("; ")),
            count => tell(&mut self.edited.answer, &format!("{count} things were set down on what is below")),
        }
        Ok(())
    }

    /// Whether nothing is where a thing would be.
    pub(super) fn is_clear(&self, solid: &Solid, lifted: &[EntityId], what: &str) -> Result<(), EditError> {
        match in_the_way(self.scene.world(), solid, lifted) {
            None => Ok(()),
            Some(other) => {
                let why = format!("{} is in the way; move it first", self.label(other));
                Err(EditError::Impossible { what: what.to_owned(), why })
            }
        }
    }

    /// What a thing is called, and what it is: "Bruno dog".
    pub(super) fn kind_and_label(&self, thing: EntityId) -> String {
        let kind = self.scene.world().entity(thing).map(|entity| entity.kind.as_str().replace('_', " "));
        format!("{} {}", self.label(thing), kind.unwrap_or_default())
    }

    /// What a thing is called.
    pub(super) fn label(&self, thing: EntityId) -> String {
        let world = self.scene.world();
        let entity = world.entity(thing);
        entity.map_or_else(|| thing.to_string(), |entity| called(world, &entity).replace('_', " "))
    }

    fn raise(
        &mut self,
        things: &[EntityId],
        by: f64,
        lifted: &[EntityId],
        what: &str,
    ) -> Result<(), EditError> {
        for id in things {
            let solid = Solid::of(&self.entity(*id)?).raised(by);
            self.put(*id, &solid, lifted, what)?;
        }
        Ok(())
    }

    fn put(&mut self, id: EntityId, solid: &Solid, lifted: &[EntityId], what: &str) -> Result<(), EditError> {
        self.is_clear(solid, lifted, what)?;
        self.change(&Command::Move { id, pose: solid.pose })
    }

    /// The height of the ground on which a thing would stand, m: that of the land or, without land, that on which its carrier stood, if
    /// that did not fly.
    fn ground_under(&self, kind: EntityKind, solid: &Solid, ground: f64) -> f64 {
        let world = self.scene.world();
        let deeper = || surface_below(world, solid).filter(|surface| surface + DEEP < ground);
        world.ground().map_or_else(|| deeper().unwrap_or(ground), |land| under(land, kind, solid).1)
    }
}
