//! How somebody who walks by looks alone sees stairs: what stops its form at the height of a step may be treads that it takes one
//! after the other.

use std::collections::VecDeque;

use parry3d_f64::query::Ray;
use rapier3d_f64::math::{Pose as RapierPose, Vector};
use simworld_core::geometry::{Point3, Vector2, Vector3};
use simworld_core::ops;

use super::Humanoid;
use super::stroll::ASIDE;
use super::walk::SKIN;
use crate::body::Surroundings;
use crate::convert::{from_vector, to_point};
use crate::shape::upright;

/// From one look at the treads to the next, m: less than a tread, so that two risers never come together.
const GLANCE: f64 = 0.1;

impl Humanoid {
    /// How far one gets by steps in a direction, m, at most `sight`, from where the form is stopped `from` m ahead: while what is under its
    /// front rises by no more than a step at a time, and there is room for the body over the treads that it stands above.
    pub(super) fn climb(&self, ahead: Vector2, from: f64, sight: f64, around: &Surroundings<'_>) -> f64 {
        let step = around.config().step_height.min(0.5 * self.height);
        let feet = self.feet();
        let place = |distance: f64, height: f64| {
            Point3::new(feet.x + ahead.x * distance, feet.y + ahead.y * distance, height)
        };
        let tread = |distance: f64, before: f64| {
            let top = place(distance, before + step + SKIN);
            let ray = Ray::new(to_point(&top), -Vector::Z);
            let reach = 2.0 * (step + SKIN);
            let (_, hit) = around.queries_of_fixed().cast_ray_and_get_normal(&ray, reach, true)?;
            let flat = from_vector(hit.normal).z >= ops::cos(around.config().max_slope);
            flat.then_some(top.z - hit.time_of_impact)
        };
        let form = self.form();
        let mut under = VecDeque::new();
        let mut front = feet.z;
        let mut clear = from;
        // From behind the form to before it, and on while there are treads.
        let count = ((sight - from + 2.0 * form) / GLANCE).ceil() as usize;
        for glance in 0..=count {
            let distance = from - form + glance as f64 * GLANCE;
            let Some(height) = tread(distance, front) else { break };
            front = height;
            under.push_back((distance, height));
            let middle = distance - form;
            if middle <= from {
                continue;
            }
            while under.front().is_some_and(|(behind, _)| *behind < middle - form - GLANCE) {
                under.pop_front();
            }
            let highest = under.iter().map(|(_, height)| *height).fold(f64::MIN, f64::max);
            if !self.has_room(&place(middle, highest), around) {
                break;
            }
            clear = middle;
        }
        clear.min(sight)
    }

    /// Its radius with the room that it leaves to walls, m.
    fn form(&self) -> f64 {
        self.radius + SKIN + ASIDE
    }

    /// Whether nothing that stands fixed is where the body would stand.
    fn has_room(&self, feet: &Point3, around: &Surroundings<'_>) -> bool {
        let half_height = 0.5 * self.height - SKIN;
        let solid = parry3d_f64::shape::Cylinder::new(half_height.max(0.05), self.form());
        let middle = feet + Vector3::z() * (0.5 * self.height + 2.0 * SKIN);
        let at = RapierPose::from_parts(to_point(&middle), upright());
        around.queries_of_fixed().intersect_shape(at, &solid).next().is_none()
    }
}
