//! Position, heading and speed, with the noise of a receiver.

use serde::{Deserialize, Serialize};
use simworld_core::geometry::{Point3, Vector3, yaw_of};
use simworld_core::id::EntityId;
use simworld_core::ops::wrap_angle;
use simworld_core::scene::Scene;
use simworld_core::seam::{ObserveError, Observer, Space};
use simworld_core::seed::{Seed, Stream};

/// What a receiver says.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct GpsFix {
    /// Where one is, world frame, m.
    pub position: Point3,
    /// Where one looks, radians counter-clockwise from east.
    pub heading: f64,
    /// Speed over ground, m/s.
    pub speed: f64,
}

/// A receiver whose errors are normal and independent from one tick and one agent to the next.
///
/// The noise of a fix is a function of seed, tick and agent, so observing twice gives the same fix.
#[derive(Clone, Copy, Debug)]
pub struct GpsObserver {
    position_error: f64,
    heading_error: f64,
    noise: Stream,
}

impl GpsObserver {
    /// A receiver with these standard deviations: of each coordinate, m, and of the heading, radians. Zero is exact.
    pub fn new(position_error: f64, heading_error: f64, seed: Seed) -> Self {
        Self { position_error, heading_error, noise: seed.stream("agents/gps") }
    }

    /// A receiver without errors.
    pub fn exact() -> Self {
        Self::new(0.0, 0.0, Seed(0))
    }
}

impl Observer for GpsObserver {
    type Observation = GpsFix;

    fn observe(&mut self, scene: &dyn Scene, who: EntityId, out: &mut GpsFix) -> Result<(), ObserveError> {
        let me = scene.entity(who).ok_or(ObserveError::Missing { id: who })?;
        let mut rng = self.noise.indexed(scene.clock().tick().0).indexed(who.into()).rng();
        let mut error = |deviation: f64| rng.normal(0.0, deviation);
        let at = self.position_error;
        let offset = Vector3::new(error(at), error(at), error(at));
        *out = GpsFix {
            position: me.position() + offset,
            heading: wrap_angle(yaw_of(me.pose) + error(self.heading_error)),
            speed: me.twist.ground_speed(),
        };
        Ok(())
    }

    fn space(&self) -> Option<Space> {
        Some(Space::bounded(-1e7, 1e7, vec![5]))
    }
}

#[cfg(test)]
mod tests {
    use simworld_core::geometry::pose_facing;
    use simworld_core::scene::{EntityDesc, EntityKind, Shape, World};

    use super::*;

    #[test]
    fn errors_have_the_stated_spread() {
        let mut world = World::new();
        let pose = pose_facing(Point3::new(3.0, 4.0, 0.0), 1.0);
        let me = EntityDesc::new(EntityKind::Person, pose, Shape::Capsule { radius: 0.25, height: 1.8 });
        let me = world.spawn(me).unwrap();
        let mut gps = GpsObserver::new(2.0, 0.0, Seed(4));
        let mut fix = GpsFix::default();
        let mut squares = 0.0;
        for _ in 0..2000 {
            gps.observe(&world, me, &mut fix).unwrap();
            squares += (fix.position.x - 3.0) * (fix.position.x - 3.0);
            assert_eq!(fix.heading, yaw_of(&pose));
            world.finish_step();
        }
        let deviation = (squares / 2000.0_f64).sqrt();
        // four standard errors: 4 · 2/√(2 · 2000) = 0.13
        assert!((deviation - 2.0).abs() < 0.13, "deviation {deviation}");
    }
}
