//! What moves fast enough to knock somebody over, by place. It is looked for once a substep, for all who may be struck: few things
//! are so fast, and each of many walkers would else ask the engine's tree of everything solid.

use rapier3d_f64::prelude::{PhysicsWorld, RigidBody, RigidBodyHandle};
use simworld_core::geometry::Point2;

use crate::cells::Cells;

/// Width of the cells in which movers are looked for, m: a car and its way in a substep fit into it.
const CELL: f64 = 8.0;

/// How far the middle of somebody who is touched may be from what touches it, m.
const TOUCHED: f64 = 2.0;

/// A body and the disc around everything that it may touch in this substep.
#[derive(Clone, Copy, Debug)]
struct Mover {
    rigid: RigidBodyHandle,
    center: Point2,
    /// m.
    radius: f64,
}

/// All of a substep.
#[derive(Debug)]
pub(crate) struct Movers {
    cells: Cells<Mover>,
    /// The greatest radius of any, m.
    widest: f64,
}

impl Default for Movers {
    fn default() -> Self {
        Self { cells: Cells::new(CELL), widest: 0.0 }
    }
}

impl Movers {
    /// Forgets those of the last substep.
    pub(crate) fn clear(&mut self) {
        self.cells.clear();
        self.widest = 0.0;
    }

    /// Takes in a body if it moves at `slowest` m/s or faster, as somebody beside it sees it.
    pub(crate) fn note(&mut self, handle: RigidBodyHandle, slowest: f64, dt: f64, physics: &PhysicsWorld) {
        let Some(rigid) = physics.bodies.get(handle).filter(|rigid| rigid.is_enabled()) else { return };
        let (speed, turning) = (rigid.linvel().length(), rigid.angvel().length());
        if speed < slowest && turning == 0.0 {
            return;
        }
        let extent = extent(rigid, physics);
        // The velocity is that of the body, taken as rigid, in the middle of who is touched.
        let greatest = speed + turning * (2.0 * extent + TOUCHED);
        if greatest < slowest {
            return;
        }
        let at = rigid.translation();
        let mover = Mover { rigid: handle, center: Point2::new(at.x, at.y), radius: extent + greatest * dt };
        self.widest = self.widest.max(mover.radius);
        self.cells.insert(mover.center, mover);
    }

    /// The bodies that may touch something within `reach` m of a place; in no order that means anything.
    pub(crate) fn near(&self, at: Point2, reach: f64) -> impl Iterator<Item = RigidBodyHandle> + '_ {
        let near = self.cells.near(at, reach + self.widest);
        let touches = move |mover: &&Mover| (mover.center - at).norm() <= mover.radius + reach;
        near.filter(touches).map(|mover| mover.rigid)
    }
}

/// The distance from a body's origin to the farthest point of its colliders, or a little more, m.
fn extent(rigid: &RigidBody, physics: &PhysicsWorld) -> f64 {
    let colliders = rigid.colliders().iter().filter_map(|handle| physics.colliders.get(*handle));
    let reach = colliders.map(|collider| {
        let sphere = collider.shape().compute_local_bounding_sphere();
        let center = collider.position() * sphere.center;
        (center - rigid.translation()).length() + sphere.radius
    });
    reach.fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use rapier3d_f64::math::Vector;
    use rapier3d_f64::prelude::{ColliderBuilder, RigidBodyBuilder};

    use super::*;

    fn insert(physics: &mut PhysicsWorld, x: f64, speed: f64, turning: f64) -> RigidBodyHandle {
        let body = RigidBodyBuilder::dynamic()
            .translation(Vector::new(x, 0.0, 0.5))
            .linvel(Vector::new(0.0, speed, 0.0))
            .angvel(Vector::new(0.0, 0.0, turning));
        physics.insert(body, ColliderBuilder::cuboid(2.0, 0.5, 0.5)).0
    }

    #[test]
    fn what_is_fast_and_near_is_found() {
        let mut physics = PhysicsWorld::new();
        let slow = insert(&mut physics, 0.0, 0.5, 0.0);
        let fast = insert(&mut physics, 10.0, 10.0, 0.0);
        let turning = insert(&mut physics, 20.0, 0.0, 2.0);
        let mut movers = Movers::default();
        for handle in [slow, fast, turning] {
            movers.note(handle, 2.0, 0.05, &physics);
        }
        let near = |movers: &Movers, x: f64, y: f64| movers.near(Point2::new(x, y), 0.3).collect::<Vec<_>>();
        assert!(near(&movers, 0.0, 0.6).is_empty(), "too slow");
        assert_eq!(near(&movers, 10.0, 2.0), [fast]);
        assert!(near(&movers, 10.0, 3.2).is_empty(), "out of its reach");
        assert_eq!(near(&movers, 20.0, -2.0), [turning]);
        movers.clear();
        assert!(near(&movers, 10.0, 2.0).is_empty());
    }
}
