//! How somebody walks far from what is of interest: as it was told, on what lies there, and off what stands fixed.
//!
//! Now and then it looks ahead and down, and goes by what it saw: a look ahead is one cast of its form, a look down one ray. It
//! goes along walls as one does near by, takes what one takes in a step, and does not meet what moves. It cannot trip, slip
//! or be knocked over; where the ground ends it stops to walk so, and falls as one falls.

use parry3d_f64::query::Ray;
use parry3d_f64::query::details::ShapeCastOptions;
use rapier3d_f64::math::{Pose as RapierPose, Vector};
use serde::{Deserialize, Serialize};
use simworld_core::geometry::{Point2, Twist, Vector2, Vector3, direction, pose_facing};
use simworld_core::ops::{self, wrap_angle};
use simworld_core::scene::Footing;
use simworld_core::seam::BodyState;

use super::walk::SKIN;
use super::{Humanoid, Posture};
use crate::body::Surroundings;
use crate::convert::{from_vector, to_point};
use crate::ground::height_at;
use crate::shape::{BodyTag, upright};

/// How far ahead it looks, m.
const SIGHT: f64 = 8.0;
/// After so long it looks anew, for things may have been put there, s.
const MEMORY: f64 = 5.0;
/// Who has come down by so much looks anew, m: from above it looked over what is now in its way.
const LOWER: f64 = 0.12;
/// How far it may come off the line along which it looked, m.
pub(super) const ASIDE: f64 = 0.05;
/// After so long it no longer minds a wall, or tries once more where it could not go, s.
const PATIENCE: f64 = 0.5;
/// Who goes along a wall keeps off it by this share of its way.
const SLANT: f64 = 0.05;
/// Way between two looks at the ground, m: less than two treads.
const TREAD: f64 = 0.4;
/// The same on treads, m: less than one.
const FOOTHOLD: f64 = 0.15;
/// Treads are looked for where something is no farther ahead, m.
const NEAR: f64 = 0.5;
/// What lets one go on by less than this is no tread, m.
const GAIN: f64 = 0.1;
/// Flatter than this is a tread and no slope, as the upward part of its normal.
const FLAT: f64 = 0.99;
/// A rise or drop beyond this on flat ground is a step, m.
const STEP: f64 = 0.08;

/// What it saw when it looked last.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Stroll {
    /// The direction in which it looked ahead, unit length; zero if it did not.
    ahead: Vector2,
    /// What is left of the free way there, m, and whether a wall ends it.
    clear: f64,
    wall: Option<Vector2>,
    /// How far it has come off that line, m.
    aside: f64,
    /// Since the look ahead, s, and the height of the feet then, m.
    since: f64,
    level: f64,
    /// The wall along which it goes, by its normal, and since when, s.
    along: Option<(Vector2, f64)>,
    /// Way from the last look down to the next, and until that, m.
    between: f64,
    until: f64,
    /// How far on there are treads, m.
    treads: f64,
    /// Rise over way that it saw there, in the plane, and whether that was the ground itself.
    grade: Vector2,
    on_ground: bool,
}

impl Default for Stroll {
    fn default() -> Self {
        Self {
            ahead: Vector2::zeros(),
            clear: 0.0,
            wall: None,
            aside: 0.0,
            since: 0.0,
            level: 0.0,
            along: None,
            between: TREAD,
            until: 0.0,
            treads: 0.0,
            grade: Vector2::zeros(),
            on_ground: false,
        }
    }
}

impl Humanoid {
    /// Whether it stands or rides on something that does not move, so that it can walk by looks alone.
    pub(crate) fn can_stroll(&self) -> bool {
        self.motion.grounded
            && self.motion.support.is_none()
            && self.footing() == Footing::Upright
            && !self.motion.crouch.is_any()
            && matches!(self.motion.posture, Posture::Standing | Posture::Riding)
    }

    /// Goes on for `dt` s.
    pub(crate) fn stroll(&mut self, around: &Surroundings<'_>, dt: f64) {
        if !self.can_stroll() {
            self.state.twist = Twist::ZERO;
            return;
        }
        let (from, before) = (self.feet(), self.motion.yaw);
        let wish = self.intend(around, dt).xy();
        let way = self.free_way(wish, around, dt);
        self.motion.feet.x += way.x;
        self.motion.feet.y += way.y;
        self.tread_ground(way, around);
        let moved = self.feet() - from;
        (self.plan.way, self.plan.shifted) = (moved, Vector3::zeros());
        self.motion.balance.follow(way / dt, dt);
        self.tread(&Vector3::zeros(), around, dt);
        self.slow_down(way, dt);
        let turned = wrap_angle(self.motion.yaw - before);
        let twist = Twist { linear: moved / dt, angular: Vector3::z() * (turned / dt) };
        self.state = BodyState { pose: pose_facing(self.feet(), self.motion.yaw), twist };
    }

    /// Forgets what it saw, for it walks otherwise now.
    pub(super) fn stop_strolling(&mut self) {
        if std::mem::take(&mut self.plan.strolls) || self.motion.stroll != Stroll::default() {
            self.motion.stroll = Stroll::default();
        }
    }

    /// Of a wish as much as leads into nothing that stands fixed, m.
    fn free_way(&mut self, wish: Vector2, around: &Surroundings<'_>, dt: f64) -> Vector2 {
        let mut stroll = self.motion.stroll;
        stroll.since += dt;
        stroll.along =
            stroll.along.map(|(wall, since)| (wall, since + dt)).filter(|(_, since)| *since < PATIENCE);
        let way = self.way_by(&mut stroll, wish, around);
        self.motion.stroll = stroll;
        way
    }

    fn way_by(&self, stroll: &mut Stroll, wish: Vector2, around: &Surroundings<'_>) -> Vector2 {
        let first = stroll.along.map_or(wish, |(wall, _)| along_wall(wish, wall));
        let (reached, wall) = self.go_by(stroll, first, Vector2::zeros(), around);
        match wall {
            Some(wall) if stroll.along.is_none() => {
                stroll.along = Some((wall, 0.0));
                let rest = along_wall(first - reached, wall);
                reached + self.go_by(stroll, rest, reached, around).0
            }
            // In a corner it stands, until it minds the first wall no longer.
            _ => reached,
        }
    }

    /// How much of a way from a place beside its own is free, and the wall that ends it, if one does.
    fn go_by(
        &self,
        stroll: &mut Stroll,
        way: Vector2,
        from: Vector2,
        around: &Surroundings<'_>,
    ) -> (Vector2, Option<Vector2>) {
        let length = way.norm();
        if length < 1e-9 {
            return (Vector2::zeros(), None);
        }
        let off = cross(way, stroll.ahead).abs();
        let holds = way.dot(&stroll.ahead) > 0.5 * length && stroll.aside + off <= ASIDE;
        let ends = length > stroll.clear && (stroll.wall.is_none() || stroll.since > PATIENCE);
        let is_lower = self.feet().z < stroll.level - LOWER;
        if !holds || ends || is_lower || stroll.since > MEMORY {
            let ahead = way / length;
            (stroll.ahead, stroll.aside, stroll.since) = (ahead, 0.0, 0.0);
            stroll.level = self.feet().z;
            (stroll.clear, stroll.wall) = match self.look_ahead(ahead, from, around) {
                Some((distance, wall)) => self.look_for_treads(stroll, distance, wall, from, around),
                None => (SIGHT, None),
            };
        }
        let share = (stroll.clear / length).clamp(0.0, 1.0);
        stroll.clear -= share * way.dot(&stroll.ahead);
        stroll.aside += share * cross(way, stroll.ahead).abs();
        (way * share, stroll.wall.filter(|_| share < 1.0))
    }

    /// What is free of the way ahead where something stops the form, if that is no more than treads to be taken, and the wall that ends
    /// it.
    fn look_for_treads(
        &self,
        stroll: &mut Stroll,
        distance: f64,
        wall: Vector2,
        from: Vector2,
        around: &Surroundings<'_>,
    ) -> (f64, Option<Vector2>) {
        // Where it goes along a wall in the same step it looks from beside its feet.
        let clear = if from == Vector2::zeros() && distance < NEAR {
            self.climb(stroll.ahead, distance, SIGHT, around)
        } else {
            distance
        };
        if clear <= distance + GAIN {
            return (distance, Some(wall));
        }
        stroll.until = stroll.until.min(FOOTHOLD);
        stroll.treads = clear;
        (clear, (clear < SIGHT).then_some(wall))
    }

    /// How far it is to what stands fixed in a direction, m, and its face, by its normal in the plane.
    fn look_ahead(&self, ahead: Vector2, from: Vector2, around: &Surroundings<'_>) -> Option<(f64, Vector2)> {
        let step = around.config().step_height.min(0.5 * self.height);
        // What is no higher than a step is walked on.
        let half_height = (self.height - step) * 0.5;
        let middle = self.feet() + Vector3::new(from.x, from.y, step + half_height);
        let solid = parry3d_f64::shape::Cylinder::new((half_height - SKIN).max(0.05), self.radius);
        let options = ShapeCastOptions {
            target_distance: SKIN + ASIDE,
            stop_at_penetration: false,
            max_time_of_impact: SIGHT,
            compute_impact_geometry_on_penetration: true,
        };
        let at = RapierPose::from_parts(to_point(&middle), upright());
        let way = Vector::new(ahead.x, ahead.y, 0.0);
        let (_, hit) = around.queries_of_fixed().cast_shape(&at, way, &solid, options)?;
        let wall = from_vector(hit.normal1).xy();
        // Of what is met from above or below there is no face to go along.
        let wall = wall.try_normalize(0.1).unwrap_or(-ahead);
        Some((hit.time_of_impact, if wall.dot(&ahead) > 0.0 { -wall } else { wall }))
    }

    /// Follows the ground over a way that it has gone, m; where there is none within a step it no longer stands.
    fn tread_ground(&mut self, way: Vector2, around: &Surroundings<'_>) {
        let mut stroll = self.motion.stroll;
        stroll.until -= way.norm();
        if stroll.until <= 0.0 {
            self.look_at_ground(&mut stroll, way, around);
        } else {
            self.motion.feet.z += stroll.grade.dot(&way);
        }
        let place = Point2::new(self.motion.feet.x, self.motion.feet.y);
        let surface = around.surface().filter(|_| stroll.on_ground);
        if let Some(height) = surface.and_then(|surface| height_at(surface, place)) {
            self.motion.feet.z = height;
        }
        self.motion.stroll = stroll;
    }

    fn look_at_ground(&mut self, stroll: &mut Stroll, way: Vector2, around: &Surroundings<'_>) {
        let reach = around.config().step_height + SKIN;
        let top = self.feet() + Vector3::z() * reach;
        let ray = Ray::new(to_point(&top), -Vector::Z);
        // Down two risers, which may lie between two looks.
        let met = around.queries_of_fixed().cast_ray_and_get_normal(&ray, 3.0 * reach, true);
        let Some((handle, hit)) = met.filter(|(_, hit)| hit.normal.z > 0.1) else {
            self.motion.grounded = false;
            return;
        };
        let normal = from_vector(hit.normal);
        let grade = -normal.xy() / normal.z;
        if normal.z < ops::cos(around.config().max_slope) && grade.dot(&way) > 0.0 {
            // Too steep: it stays where it was.
            self.motion.feet.x -= way.x;
            self.motion.feet.y -= way.y;
            (stroll.clear, stroll.since, stroll.wall) =
                (0.0, 0.0, Some(-way.try_normalize(1e-9).unwrap_or(-stroll.ahead)));
            return;
        }
        let height = top.z - hit.time_of_impact;
        let rise = height - self.motion.feet.z;
        let walked = (stroll.between - stroll.until).min(2.0 * TREAD);
        stroll.treads -= walked;
        match way.try_normalize(1e-9) {
            Some(_) if normal.z > FLAT && rise.abs() > STEP => {
                stroll.treads = stroll.treads.max(2.0 * TREAD);
                self.motion.pace.go(1e-3, rise);
            }
            Some(ahead) => self.motion.pace.go(walked, walked * grade.dot(&ahead)),
            None => {}
        }
        self.motion.feet.z = height;
        stroll.between = if stroll.treads > 0.0 { FOOTHOLD } else { TREAD };
        (stroll.until, stroll.grade) = (stroll.between, grade);
        let ground = around.physics.colliders.get(handle);
        stroll.on_ground = ground.is_some_and(|it| BodyTag::from_user_data(it.user_data) == BodyTag::Ground);
    }

    /// A rider who was stopped has to pick up speed again.
    pub(super) fn slow_down(&mut self, way: Vector2, dt: f64) {
        if self.motion.posture == Posture::Riding {
            let achieved = way.dot(&direction(self.motion.yaw)) / dt;
            self.motion.speed = self.motion.speed.min(achieved.max(0.0) + 1e-9);
        }
    }
}

fn cross(a: Vector2, b: Vector2) -> f64 {
    a.x * b.y - a.y * b.x
}

/// The part of a way along a wall, by its normal, and a little off it; all of a way that leads off it.
fn along_wall(way: Vector2, wall: Vector2) -> Vector2 {
    let into = way.dot(&wall);
    if into >= 0.0 {
        return way;
    }
    let along = way - wall * into;
    along + wall * (SLANT * along.norm())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn along_a_wall_goes_what_does_not_go_into_it() {
        let wall = Vector2::new(-1.0, 0.0);
        let along = along_wall(Vector2::new(1.0, 2.0), wall);
        assert!((along - Vector2::new(-0.1, 2.0)).norm() < 1e-12, "{along}");
        let off = Vector2::new(-1.0, 0.5);
        assert_eq!(along_wall(off, wall), off);
    }
}
