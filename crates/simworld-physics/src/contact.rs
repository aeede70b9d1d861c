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
    /// Those of the substep under examination.
    now: Vec<(EntityId, EntityId)>,
    /// Those that came to touch in this step.
    begun: Vec<Contact>,
}

/// The beginning of a contact.
#[derive(Clone, Copy, Debug)]
struct Contact {
    pair: (EntityId, EntityId),
    point: Point3,
    closing_speed: f64,
    impulse: f64,
}

/// What the solver has in contact with a body.
struct Solved {
    id: EntityId,
    other: ColliderHandle,
    point: Point3,
    towards_other: Vector3,
    impulse: f64,
    dist: f64,
}

impl Contacts {
    /// Reports the contacts that began in this step, by ascending pair, each once.
    pub(crate) fn report(&mut self, world: &mut World) {
        self.begun.sort_by_key(|contact| contact.pair);
        self.begun.dedup_by_key(|contact| contact.pair);
        for Contact { pair: (a, b), point, closing_speed, impulse } in self.begun.drain(..) {
            world.emit(EventKind::Contact { a, b, point, closing_speed, impulse });
        }
    }

    fn touched(&self, pair: (EntityId, EntityId)) -> bool {
        self.touching.binary_search(&pair).is_ok()
    }

    fn note(&mut self, contact: Contact) {
        if self.now.contains(&contact.pair) {
            return; // noted from the other side
        }
        if self.touched(contact.pair) {
            // A contact of this step goes on: a blow takes several substeps.
            if let Some(begun) = self.begun.iter_mut().find(|begun| begun.pair == contact.pair) {
                begun.impulse += contact.impulse;
            }
        } else {
            self.begun.push(contact);
        }
        self.now.push(contact.pair);
    }

    fn finish(&mut self) {
        self.now.sort_unstable();
        self.now.dedup();
        std::mem::swap(&mut self.touching, &mut self.now);
        self.now.clear();
    }
}

impl PhysicsDynamics {
    /// Finds the pairs that touch after a substep.
    pub(crate) fn find_contacts(&mut self) {
        let mut contacts = std::mem::take(&mut self.contacts);
        for owned in self.bodies.iter().filter(|owned| owned.bonds.carried.is_none()) {
            if self.physics.bodies[owned.rigid].is_dynamic() || !owned.body.parts().is_empty() {
                self.find_solved(owned, &mut contacts);
            } else {
                for handle in self.physics.bodies[owned.rigid].colliders() {
                    self.find_close(owned, *handle, &mut contacts);
                }
            }
        }
        contacts.finish();
        self.contacts = contacts;
    }

    /// What the solver has in contact with a dynamic body: each other body once, by its deepest contact, with the impulse of
    /// all of them.
    fn find_solved(&self, owned: &Owned, contacts: &mut Contacts) {
        let mut met: Vec<Solved> = Vec::new();
        let rigids = std::iter::once(&owned.rigid).chain(owned.body.parts());
        let colliders = rigids.filter_map(|handle| self.physics.bodies.get(*handle));
        for handle in colliders.flat_map(RigidBody::colliders) {
            for pair in self.physics.contact_pairs_with(*handle).filter(|pair| pair.has_any_active_contact())
            {
                let Some((manifold, deepest)) = pair.find_deepest_contact() else { continue };
                let is_first = pair.collider1 == *handle;
                let other = if is_first { pair.collider2 } else { pair.collider1 };
                let Some(id) = self.entity_of(other).filter(|id| *id != owned.id) else { continue };
                let collider = &self.physics.colliders[pair.collider1];
                let point = world_point(collider.position(), deepest.local_p1);
                // The manifold's normal points from the first to the second.
                let normal = from_vector(manifold.data.normal);
                let towards_other = if is_first { normal } else { -normal };
                let (impulse, dist) = (pair.total_impulse_magnitude(), deepest.dist);
                match met.iter_mut().find(|solved| solved.id == id) {
                    Some(solved) if solved.dist <= dist => solved.impulse += impulse,
                    Some(solved) => {
                        let impulse = solved.impulse + impulse;
                        *solved = Solved { id, other, point, towards_other, impulse, dist };
                    }
                    None => met.push(Solved { id, other, point, towards_other, impulse, dist }),
                }
            }
        }
        for Solved { other, point, towards_other, impulse, .. } in met {
            self.note(owned, other, point, towards_other, impulse, contacts);
        }
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
                self.note(owned, other, point, from_vector(found.normal1), 0.0, contacts);
            }
        }
    }

    fn note(
        &self,
        owned: &Owned,
        other: ColliderHandle,
        point: Point3,
        towards_other: Vector3,
        impulse: f64,
        contacts: &mut Contacts,
    ) {
        let collider = &self.physics.colliders[other];
        let Some(id) = BodyTag::from_user_data(collider.user_data).entity() else { return };
        let approach = velocity_before(owned, &point) - self.velocity_of(id, other, &point);
        let closing_speed = approach.dot(&towards_other).max(0.0);
        // The engine keeps the impulse of a contact that the bodies have already left.
        let impulse = if closing_speed > 0.0 { impulse } else { 0.0 };
        contacts.note(Contact { pair: ordered(owned.id, id), point, closing_speed, impulse });
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
