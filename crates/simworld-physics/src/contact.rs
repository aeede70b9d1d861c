//! Contacts as events: which pairs came to touch, where, and how fast they approached.
//!
//! Bodies on the solver touch when the solver says so. Walkers keep a small gap to everything, so they touch what
//! is about that gap away.

use parry3d_f64::query::contact;
use rapier3d_f64::math::Vector;
use rapier3d_f64::prelude::{ColliderHandle, QueryFilter, RigidBody};
use simworld_core::event::EventKind;
use simworld_core::geometry::{Point3, Vector3};
use simworld_core::id::EntityId;
use simworld_core::scene::World;

use crate::convert::{from_point, from_vector, to_point};
use crate::dynamics::{Owned, PhysicsDynamics, world_point};
use crate::humanoid::SKIN;
use crate::shape::BodyTag;

/// Gap up to which a walker comes to touch something, m.
const TOUCH: f64 = SKIN + 0.01;
/// Gap beyond which it no longer does, m.
const PART: f64 = SKIN + 0.05;

/// Which pairs touch, and the news of this step.
#[derive(Debug, Default)]
pub(crate) struct Contacts {
    /// Pairs that touch, the lower id first, ascending.
    pub(crate) touching: Vec<(EntityId, EntityId)>,
    /// Which of them still do in the substep under examination.
    still: Vec<bool>,
    /// What each pair of the engine was last, by its turn: what lies in a pile is found there again.
    turns: Vec<Turn>,
    /// Where the bodies are in the list that the solver does not move.
    pub(crate) unsolved: Vec<usize>,
    /// What was looked at closely in it.
    met: Vec<Met>,
    /// Those that came to touch in this step, by ascending pair.
    begun: Vec<Contact>,
}

/// A pair of the engine's colliders that touch, and whose they are: looking that up costs a look at either collider.
#[derive(Clone, Copy, Debug)]
struct Turn {
    colliders: [ColliderHandle; 2],
    /// The entities, the lower id first; none where one of them is the ground, or both are one.
    pair: Option<(EntityId, EntityId)>,
    /// Where the pair was in the list of those that touch.
    place: u32,
}

/// The beginning of a contact.
#[derive(Clone, Copy, Debug)]
struct Contact {
    pair: (EntityId, EntityId),
    point: Point3,
    closing_speed: f64,
    impulse: f64,
}

/// A contact as one of the two finds it.
#[derive(Clone, Copy, Debug)]
struct Met {
    contact: Contact,
    /// Who finds it; of two who do the lower id counts.
    by: EntityId,
}

/// What the solver has in contact with a body.
struct Solved {
    other: ColliderHandle,
    point: Point3,
    towards_other: Vector3,
    impulse: f64,
    dist: f64,
}

impl Contacts {
    /// Reports the contacts that began in this step, by ascending pair, each once.
    pub(crate) fn report(&mut self, world: &mut World) {
        self.begun.dedup_by_key(|contact| contact.pair);
        for Contact { pair: (a, b), point, closing_speed, impulse } in self.begun.drain(..) {
            world.emit(EventKind::Contact { a, b, point, closing_speed, impulse });
        }
    }

    fn touched(&self, pair: (EntityId, EntityId)) -> bool {
        self.touching.binary_search(&pair).is_ok()
    }

    /// Whose two colliders are that the engine has at a turn, the lower id first; they are asked for where others had it before.
    fn pair_at(
        &mut self,
        turn: usize,
        colliders: [ColliderHandle; 2],
        ask: impl FnOnce() -> Option<(EntityId, EntityId)>,
    ) -> Option<(EntityId, EntityId)> {
        match self.turns.get_mut(turn) {
            Some(known) if known.colliders == colliders => known.pair,
            Some(other) => {
                *other = Turn { colliders, pair: ask(), place: 0 };
                other.pair
            }
            None => {
                let pair = ask();
                self.turns.push(Turn { colliders, pair, place: 0 });
                pair
            }
        }
    }

    /// Notes that the pair at a turn touches, if there is nothing to tell of it; says whether that is so.
    fn goes_on(&mut self, pair: (EntityId, EntityId), turn: usize) -> bool {
        let before = self.turns[turn].place as usize;
        let place = if self.touching.get(before) == Some(&pair) {
            before
        } else {
            let Ok(place) = self.touching.binary_search(&pair) else { return false };
            self.turns[turn].place = place as u32;
            place
        };
        self.still[place] = true;
        self.begun.is_empty() || self.begun.binary_search_by_key(&pair, |begun| begun.pair).is_err()
    }

    /// Forgets which colliders were whose: those of another engine may have the same handles.
    pub(crate) fn forget_colliders(&mut self) {
        self.turns.clear();
    }

    fn start(&mut self) {
        self.still.clear();
        self.still.resize(self.touching.len(), false);
    }

    /// Takes in what was met.
    fn finish(&mut self) {
        let Self { touching, still, met, begun, .. } = self;
        met.sort_by_key(|met| (met.contact.pair, met.by));
        met.dedup_by_key(|met| met.contact.pair);
        met.retain(|Met { contact, .. }| {
            let Ok(place) = touching.binary_search(&contact.pair) else { return true };
            still[place] = true;
            // A contact of this step goes on: a blow takes several substeps.
            let first = begun.partition_point(|begun| begun.pair < contact.pair);
            if let Some(begun) = begun.get_mut(first).filter(|begun| begun.pair == contact.pair) {
                begun.impulse += contact.impulse;
            }
            false
        });
        let mut still = still.iter();
        touching.retain(|_| still.next().copied().unwrap_or(false));
        if !met.is_empty() {
            touching.extend(met.iter().map(|met| met.contact.pair));
            touching.sort_unstable();
            begun.extend(met.drain(..).map(|met| met.contact));
            begun.sort_by_key(|begun| begun.pair);
        }
    }
}

impl PhysicsDynamics {
    /// Finds the pairs that touch after a substep.
    pub(crate) fn find_contacts(&mut self) {
        let mut contacts = std::mem::take(&mut self.contacts);
        contacts.start();
        for index in 0..contacts.unsolved.len() {
            let owned = &self.bodies[contacts.unsolved[index]];
            if !self.is_solved(owned) {
                for handle in self.physics.bodies[owned.rigid].colliders() {
                    self.find_close(owned, *handle, &mut contacts);
                }
            }
        }
        self.find_solved(&mut contacts);
        contacts.finish();
        self.contacts = contacts;
    }

    /// Whether the solver knows what a body touches.
    fn is_solved(&self, owned: &Owned) -> bool {
        self.physics.bodies[owned.rigid].is_dynamic() || !owned.body.parts().is_empty()
    }

    /// What the solver has in contact: all pairs of the engine once. What goes on, such as what lies in a pile, is only noted.
    fn find_solved(&self, contacts: &mut Contacts) {
        let touching = self.physics.contact_pairs().filter(|pair| pair.has_any_active_contact());
        for (turn, pair) in touching.enumerate() {
            let colliders = [pair.collider1, pair.collider2];
            let Some((a, b)) = contacts.pair_at(turn, colliders, || self.pair_of(colliders)) else {
                continue;
            };
            if contacts.goes_on((a, b), turn) {
                continue;
            }
            let met = [(a, b), (b, a)].into_iter().find_map(|(by, other)| {
                let owned = &self.bodies[self.position(by).ok()?];
                let is_free = owned.is_in_engine() && self.is_solved(owned);
                let Solved { other, point, towards_other, impulse, .. } =
                    is_free.then(|| self.solved(owned, other))??;
                self.met(owned, other, point, towards_other, impulse)
            });
            contacts.met.extend(met);
        }
    }

    /// How the solver has a body in contact with an entity: by the deepest contact, with the impulse of all of them.
    fn solved(&self, owned: &Owned, with: EntityId) -> Option<Solved> {
        let mut met: Option<Solved> = None;
        let rigids = std::iter::once(&owned.rigid).chain(owned.body.parts());
        let colliders = rigids.filter_map(|handle| self.physics.bodies.get(*handle));
        for handle in colliders.flat_map(RigidBody::colliders) {
            for pair in self.physics.contact_pairs_with(*handle).filter(|pair| pair.has_any_active_contact())
            {
                let is_first = pair.collider1 == *handle;
                let other = if is_first { pair.collider2 } else { pair.collider1 };
                if self.entity_of(other) != Some(with) {
                    continue;
                }
                let Some((manifold, deepest)) = pair.find_deepest_contact() else { continue };
                let collider = &self.physics.colliders[pair.collider1];
                let point = world_point(collider.position(), deepest.local_p1);
                // The manifold's normal points from the first to the second.
                let normal = from_vector(manifold.data.normal);
                let towards_other = if is_first { normal } else { -normal };
                let (impulse, dist) = (pair.total_impulse_magnitude(), deepest.dist);
                match &mut met {
                    Some(solved) if solved.dist <= dist => solved.impulse += impulse,
                    _ => {
                        let impulse = met.map_or(0.0, |solved| solved.impulse) + impulse;
                        met = Some(Solved { other, point, towards_other, impulse, dist });
                    }
                }
            }
        }
        met
    }

    /// Whose two colliders are, the lower id first; none where one of them is the ground, or both are one entity's.
    fn pair_of(&self, [one, other]: [ColliderHandle; 2]) -> Option<(EntityId, EntityId)> {
        let (a, b) = self.entity_of(one).zip(self.entity_of(other))?;
        (a != b).then(|| ordered(a, b))
    }

    fn entity_of(&self, collider: ColliderHandle) -> Option<EntityId> {
        BodyTag::from_user_data(self.physics.colliders.get(collider)?.user_data).entity()
    }

    /// What is about one skin away from a walker.
    fn find_close(&self, owned: &Owned, handle: ColliderHandle, contacts: &mut Contacts) {
        let collider = &self.physics.colliders[handle];
        let (pose, solid) = (*collider.position(), collider.shape());
        let mut aabb = collider.compute_aabb();
        aabb.mins -= Vector::splat(PART);
        aabb.maxs += Vector::splat(PART);
        let filter = QueryFilter::new().exclude_rigid_body(owned.rigid);
        for (other, met) in self.physics.intersect_aabb_conservative(aabb, filter) {
            let Some(id) = BodyTag::from_user_data(met.user_data).entity() else { continue };
            let Ok(Some(found)) = contact(&pose, solid, met.position(), met.shape(), PART) else { continue };
            let reach = if contacts.touched(ordered(owned.id, id)) { PART } else { TOUCH };
            if found.dist <= reach {
                let point = from_point(found.point2);
                contacts.met.extend(self.met(owned, other, point, from_vector(found.normal1), 0.0));
            }
        }
    }

    fn met(
        &self,
        owned: &Owned,
        other: ColliderHandle,
        point: Point3,
        towards_other: Vector3,
        impulse: f64,
    ) -> Option<Met> {
        let id = self.entity_of(other)?;
        let approach = velocity_before(owned, &point) - self.velocity_of(id, other, &point);
        let closing_speed = approach.dot(&towards_other).max(0.0);
        // The engine keeps the impulse of a contact that the bodies have already left.
        let impulse = if closing_speed > 0.0 { impulse } else { 0.0 };
        let contact = Contact { pair: ordered(owned.id, id), point, closing_speed, impulse };
        Some(Met { contact, by: owned.id })
    }

    fn velocity_of(&self, id: EntityId, collider: ColliderHandle, point: &Point3) -> Vector3 {
        if let Ok(place) = self.position(id) {
            return velocity_before(&self.bodies[place], point);
        }
        let parent = self.physics.colliders[collider].parent();
        let rigid = parent.and_then(|handle| self.physics.bodies.get(handle));
        rigid.map_or_else(Vector3::zeros, |rigid| from_vector(rigid.velocity_at_point(to_point(point))))
    }
}

/// Velocity of a point of a body before the substep, which the solver has not yet braked.
fn velocity_before(owned: &Owned, point: &Point3) -> Vector3 {
    let arm = point.coords - owned.body.state().pose.translation.vector;
    owned.before.linear + owned.before.angular.cross(&arm)
}

fn ordered(a: EntityId, b: EntityId) -> (EntityId, EntityId) {
    if a <= b { (a, b) } else { (b, a) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn met(by: u32, impulse: f64) -> Met {
        let pair = (EntityId::new(1, 0), EntityId::new(2, 0));
        let contact = Contact { pair, point: Point3::origin(), closing_speed: 1.0, impulse };
        Met { contact, by: EntityId::new(by, 0) }
    }

    fn substep(contacts: &mut Contacts, found: &[Met]) {
        contacts.start();
        for (turn, met) in found.iter().enumerate() {
            let pair = contacts.pair_at(turn, [ColliderHandle::invalid(); 2], || Some(met.contact.pair));
            assert_eq!(pair, Some(met.contact.pair));
            if !contacts.goes_on(met.contact.pair, turn) {
                contacts.met.push(*met);
            }
        }
        contacts.finish();
    }

    #[test]
    fn a_contact_begins_once_adds_up_goes_on_and_ends() {
        let mut contacts = Contacts::default();
        substep(&mut contacts, &[met(2, 5.0), met(1, 3.0)]);
        assert_eq!(contacts.touching, [met(1, 0.0).contact.pair]);
        assert_eq!(contacts.begun.len(), 1);
        assert_eq!(contacts.begun[0].impulse, 3.0, "of two who find it the lower counts");
        substep(&mut contacts, &[met(1, 2.0)]);
        assert_eq!(contacts.begun[0].impulse, 5.0, "a blow of two substeps");
        contacts.begun.clear();
        substep(&mut contacts, &[met(1, 2.0)]);
        assert!(contacts.begun.is_empty() && contacts.touching.len() == 1, "it goes on");
        substep(&mut contacts, &[]);
        assert!(contacts.touching.is_empty(), "it ended");
        substep(&mut contacts, &[met(1, 2.0)]);
        assert_eq!(contacts.begun.len(), 1, "it begins anew");
    }
}
