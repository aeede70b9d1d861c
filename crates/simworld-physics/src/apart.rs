//! Which solids of one body meet one another: the engine asks for each pair of those that are marked for it.
//!
//! The engine itself knows of two bodies on one joint whether they meet, and of an articulation whether its bodies do; what goes
//! beyond that is asked here. Nothing of it is state: it follows from what a body is.

use std::any::Any;
use std::sync::Arc;

use rapier3d_f64::prelude::{ColliderHandle, PairFilterContext, PhysicsHooks, SolverFlags};
use serde::{Deserialize, Serialize};
use simworld_core::id::EntityId;

use crate::dynamics::Owned;
use crate::quadruped::Quadruped;
use crate::robot::Robot;
use crate::shape::{BodyTag, number_of};

/// Of which kinds a solid of a robot is, and which kinds of its own robot's solids it meets, as bits: two solids meet if one of
/// them is of a kind that the other meets (`contype` and `conaffinity` of MJCF). By default all are of the first kind and meet it.
///
/// ```
/// use simworld_physics::robot::Kinds;
///
/// let (hand, skirt) = (Kinds { own: 0b01, met: 0b11 }, Kinds { own: 0b10, met: 0 });
/// assert!(hand.meets(skirt) && !skirt.meets(skirt));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Kinds {
    /// Of which kinds it is.
    pub own: u32,
    /// Which kinds it meets.
    pub met: u32,
}

impl Default for Kinds {
    fn default() -> Self {
        Self { own: 1, met: 1 }
    }
}

impl Kinds {
    /// Whether two solids of one robot meet, as far as it is for their kinds.
    pub fn meets(self, other: Self) -> bool {
        self.own & other.met != 0 || other.own & self.met != 0
    }
}

/// The solids of a body by number, and which of them meet.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct Apart {
    /// Of each solid the link that it belongs to, and its kinds.
    pub(crate) solids: Vec<(u16, Kinds)>,
    /// Links that pass through one another, the lower first, ascending.
    pub(crate) links: Vec<(u16, u16)>,
}

impl Apart {
    /// Whether two links pass through one another, whatever their solids.
    pub(crate) fn has(&self, one: u16, other: u16) -> bool {
        self.links.binary_search(&(one.min(other), one.max(other))).is_ok()
    }

    /// Whether two solids meet; what is not known does.
    fn meet(&self, one: u16, other: u16) -> bool {
        let (Some(one), Some(other)) =
            (self.solids.get(usize::from(one)), self.solids.get(usize::from(other)))
        else {
            return true;
        };
        one.1.meets(other.1) && !self.has(one.0, other.0)
    }
}

/// What the engine asks, by ascending id.
#[derive(Clone, Debug, Default)]
pub(crate) struct Filter(Vec<(EntityId, Arc<Apart>)>);

impl Filter {
    /// Takes in what the bodies say of themselves, which come by ascending id.
    pub(crate) fn follow<'a>(&mut self, bodies: impl Iterator<Item = &'a Owned>) {
        self.0.clear();
        for owned in bodies {
            let body = &*owned.body as &dyn Any;
            let robot = body.downcast_ref::<Robot>().and_then(Robot::apart).cloned();
            let apart = robot.or_else(|| body.downcast_ref::<Quadruped>().and_then(Quadruped::apart));
            self.0.extend(apart.map(|apart| (owned.id, apart)));
        }
    }
}

impl PhysicsHooks for Filter {
    fn filter_contact_pair(&self, pair: &PairFilterContext<'_>) -> Option<SolverFlags> {
        let met = Some(SolverFlags::COMPUTE_RIGID_IMPULSES);
        let mark = |handle: ColliderHandle| pair.colliders.get(handle).map(|collider| collider.user_data);
        let Some((one, other)) = mark(pair.collider1).zip(mark(pair.collider2)) else { return met };
        let Some(whose) = BodyTag::from_user_data(one).entity() else { return met };
        if BodyTag::from_user_data(other).entity() != Some(whose) {
            return met;
        }
        let Ok(place) = self.0.binary_search_by_key(&whose, |(id, _)| *id) else { return met };
        if self.0[place].1.meet(number_of(one), number_of(other)) { met } else { None }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn links_and_kinds_decide_together() {
        let (plain, odd) = (Kinds::default(), Kinds { own: 2, met: 0 });
        let apart = Apart { solids: vec![(0, plain), (1, plain), (2, plain), (2, odd)], links: vec![(0, 1)] };
        assert!(!apart.meet(0, 1) && !apart.meet(1, 0), "links that are apart");
        assert!(apart.meet(0, 2) && apart.meet(2, 1), "others");
        assert!(!apart.meet(0, 3), "of a kind that nobody meets");
        assert!(apart.meet(0, 9), "what is not known");
    }
}
