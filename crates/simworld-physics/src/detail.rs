//! What changes around bodies: how finely each moves, and what the weather lays on surfaces.

use simworld_core::geometry::Point3;

use crate::body::Detail;
use crate::dynamics::PhysicsDynamics;
use crate::shape::material_of;
use crate::surface::Conditions;

/// How much farther than the radius of detail a body goes before it is reduced, as a factor: none flickers at the rim.
const RIM: f64 = 1.1;

impl PhysicsDynamics {
    /// Says where bodies are to move in full detail: within
    /// [`detail_radius`](crate::PhysicsConfig::detail_radius) of one of these points, and in reduced detail
    /// elsewhere. Without points all of them move in full detail.
    pub fn set_interest(&mut self, points: &[Point3]) {
        self.interest.clear();
        self.interest.extend_from_slice(points);
    }

    /// How finely the body of an entity moves, if it has one.
    pub fn detail(&self, id: simworld_core::id::EntityId) -> Option<Detail> {
        self.position(id).ok().map(|place| self.bodies[place].detail)
    }

    /// What the air and the roads were like in the last step.
    pub fn conditions(&self) -> &Conditions {
        &self.conditions
    }

    pub(crate) fn choose_detail(&mut self) {
        let is_asked = !self.interest.is_empty();
        if !std::mem::replace(&mut self.detail_varies, is_asked) && !is_asked {
            return; // all of them are in full detail since the last step
        }
        let (points, radius) = (&self.interest, self.config.detail_radius);
        for owned in &mut self.bodies {
            let place = owned.written.translation.vector;
            let nearest = points
                .iter()
                .map(|point| (point.coords - place).norm_squared())
                .fold(f64::INFINITY, f64::min);
            let reach = if owned.detail == Detail::Full { radius * RIM } else { radius };
            let is_near = points.is_empty() || nearest <= reach * reach;
            owned.detail = if is_near { Detail::Full } else { Detail::Reduced };
        }
    }

    /// Takes up the weather: what it lays on surfaces changes their friction. Bodies that rest on them wake.
    pub(crate) fn set_conditions(&mut self, conditions: Conditions) {
        let changed = conditions.road != self.conditions.road;
        self.conditions = conditions;
        if !changed {
            return;
        }
        for (_, collider) in self.physics.colliders.iter_mut() {
            if collider.parent().is_none() {
                collider.set_friction(conditions.road.friction(material_of(collider.user_data)));
            }
        }
        self.physics.wake_up_all(true);
    }
}
