//! Whose entities are whose: the traffic's own, and bodies of others that its drivers and walkers have to mind: whatever moves, and
//! what stands in the way of vehicles.

use simworld_core::id::EntityId;
use simworld_core::scene::{EntityRef, Mark, Scene, World};

use super::handed::Who;

/// Whether something stands where vehicles drive.
pub(super) type InTheWay<'a> = &'a dyn Fn(&EntityRef<'_>) -> bool;

/// Kept in step with the world by what changed in it, so that a step costs nothing for a city in which nobody comes or goes.
#[derive(Default)]
pub(super) struct Others {
    /// The traffic's own entities, by slot; one that is gone stays until its slot is another's.
    own: Vec<Option<(EntityId, Who)>>,
    /// Those whose slot became another own one's before it was seen that they are gone.
    replaced: Vec<(EntityId, Who)>,
    /// Whether something that is another's and has to be minded is in a slot.
    is_other: Vec<bool>,
    /// Whether what is in a slot is of a kind that moves: that it has moved is nothing new.
    moves: Vec<bool>,
    /// The slots of those, ascending.
    slots: Vec<u32>,
    revision: Option<u64>,
    /// When the world was looked at last.
    mark: Option<Mark>,
}

impl Others {
    /// Notes an entity of the traffic's own.
    pub(super) fn claim(&mut self, id: EntityId, who: Who) {
        let slot = id.index();
        if self.own.len() <= slot {
            self.own.resize(slot + 1, None);
        }
        self.replaced.extend(self.own[slot].replace((id, who)).filter(|(before, _)| *before != id));
    }

    /// Everything is looked at anew: the traffic is another than it was.
    pub(super) fn forget(&mut self) {
        *self = Self::default();
    }

    /// Bodies of others, by ascending slot.
    pub(super) fn iter<'a>(&'a self, world: &'a World) -> impl Iterator<Item = EntityRef<'a>> {
        self.slots.iter().filter_map(|slot| world.slot(*slot as usize))
    }

    /// Looks at what changed in the world since the last step; gives those of the traffic's own entities that are not in it any
    /// more, ascending. `own` are all of its entities: they are gone through when too much happened to follow.
    pub(super) fn look(
        &mut self,
        world: &World,
        own: impl Iterator<Item = (EntityId, Who)>,
        in_the_way: InTheWay<'_>,
    ) -> Vec<(EntityId, Who)> {
        let mut gone = Vec::new();
        // Who is in which slot, and of which kind, changes with the revision alone.
        if self.revision == Some(world.revision()) {
            self.look_at_what_was_moved(world, in_the_way);
        } else {
            self.revision = Some(world.revision());
            self.own.resize(world.slots().max(self.own.len()), None);
            self.is_other.resize(world.slots(), false);
            self.moves.resize(world.slots(), false);
            if let Some(touched) = self.mark.and_then(|mark| world.touched_since(mark)) {
                gone.append(&mut self.replaced);
                touched.for_each(|slot| self.look_at(slot, world, in_the_way, &mut gone));
            } else {
                self.own.fill(None);
                self.replaced.clear();
                for (id, who) in own {
                    if world.entity(id).is_some() { self.claim(id, who) } else { gone.push((id, who)) }
                }
                (0..world.slots()).for_each(|slot| self.look_at(slot, world, in_the_way, &mut gone));
            }
            gone.sort_unstable_by_key(|(_, who)| *who);
        }
        self.mark = Some(world.mark());
        gone
    }

    /// A cone that is put elsewhere is in the way there, and no more where it was.
    fn look_at_what_was_moved(&mut self, world: &World, in_the_way: InTheWay<'_>) {
        let mut stands = Vec::new();
        let moves = &self.moves;
        let mut add = |slot: usize| stands.extend((!moves[slot]).then_some(slot));
        if let Some(touched) = self.mark.and_then(|mark| world.touched_since(mark)) {
            touched.for_each(&mut add);
        } else if let Some(changed) = self.mark.and_then(|mark| world.changed_since(mark)) {
            changed.for_each(&mut add);
        }
        for slot in stands {
            self.look_at(slot, world, in_the_way, &mut Vec::new());
        }
    }

    fn look_at(
        &mut self,
        slot: usize,
        world: &World,
        in_the_way: InTheWay<'_>,
        gone: &mut Vec<(EntityId, Who)>,
    ) {
        let entity = world.slot(slot);
        let is_own = match self.own[slot] {
            Some((id, who)) if entity.as_ref().is_none_or(|entity| entity.id != id) => {
                gone.push((id, who));
                self.own[slot] = None;
                false
            }
            own => own.is_some(),
        };
        self.moves[slot] = is_own || entity.as_ref().is_some_and(|entity| entity.kind.is_mobile());
        let is_other = !is_own && entity.is_some_and(|entity| self.moves[slot] || in_the_way(&entity));
        if is_other != self.is_other[slot] {
            self.is_other[slot] = is_other;
            match self.slots.binary_search(&(slot as u32)) {
                Ok(place) => {
                    self.slots.remove(place);
                }
                Err(place) => self.slots.insert(place, slot as u32),
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use simworld_core::geometry::{Point3, Twist, pose_facing};
    use simworld_core::scene::{EntityDesc, EntityKind, Shape};
    use simworld_core::seed::Seed;

    use super::*;

    fn spawn(world: &mut World, kind: EntityKind) -> EntityId {
        let pose = pose_facing(Point3::origin(), 0.0);
        world.spawn(EntityDesc::new(kind, pose, Shape::cuboid(1.0, 1.0, 1.0))).expect("a box at the origin")
    }

    /// What stands east of the origin is in the way.
    fn east(entity: &EntityRef<'_>) -> bool {
        entity.position().x > 0.0
    }

    /// However entities come, go and are moved, and however many steps pass unseen: the same as if everything had been looked at.
    #[test]
    fn what_changed_is_enough() {
        let (mut removed, mut moved_in) = (0, 0);
        for seed in 0..30 {
            let mut rng = Seed(seed).stream("test/others").rng();
            let (mut world, mut others) = (World::new(), Others::default());
            let mut own: BTreeMap<Who, EntityId> = BTreeMap::new();
            let mut numbers = 0..;
            for step in 0..120 {
                for _ in 0..rng.below(4) {
                    let ids: Vec<EntityId> = world.iter().map(|entity| entity.id).collect();
                    match rng.below(5) {
                        4 if !ids.is_empty() => {
                            let x = rng.uniform(-9.0, 9.0);
                            let pose = pose_facing(Point3::new(x, 0.0, 0.0), 0.0);
                            world.set_motion(ids[rng.below(ids.len())], pose, Twist::ZERO).expect("it lives");
                        }
                        0 => drop(spawn(&mut world, EntityKind::Bench)),
                        1 => drop(spawn(&mut world, EntityKind::Person)),
                        2 => {
                            let id = spawn(&mut world, EntityKind::Car);
                            let who = numbers.next().map(Who::Vehicle).expect("numbers do not end");
                            others.claim(id, who);
                            own.insert(who, id);
                        }
                        _ if ids.is_empty() => {}
                        _ => world.remove(ids[rng.below(ids.len())]).map(drop).expect("it lives"),
                    }
                }
                (0..rng.below(3)).for_each(|_| world.finish_step());
                if rng.below(3) == 0 {
                    continue;
                }
                let gone = others.look(&world, own.iter().map(|(who, id)| (*id, *who)), &east);
                let expected: Vec<(EntityId, Who)> = own
                    .iter()
                    .filter(|(_, id)| world.entity(**id).is_none())
                    .map(|(who, id)| (*id, *who))
                    .collect();
                own.retain(|_, id| world.entity(*id).is_some());
                assert_eq!(gone, expected, "seed {seed}, step {step}");
                removed += gone.len();
                let found: Vec<EntityId> = others.iter(&world).map(|entity| entity.id).collect();
                let is_other = |entity: &EntityRef<'_>| {
                    (entity.kind.is_mobile() || east(entity)) && !own.values().any(|id| *id == entity.id)
                };
                let all: Vec<EntityId> = world.iter().filter(is_other).map(|entity| entity.id).collect();
                assert_eq!(found, all, "seed {seed}, step {step}");
                moved_in += all.len();
            }
        }
        assert!(removed > 100 && moved_in > 1000, "{removed} and {moved_in}: nothing was tried");
    }
}
