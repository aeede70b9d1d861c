//! A leg of three hinges: where its foot is, which angles put it somewhere, and how it moves with them.
//!
//! Frames and signs are those of the trunk: x forward, y left, z up. The first joint turns about x, the others about y, so
//! that a positive angle of the thigh swings a hanging leg backward, and knees, whose angles are negative, point backward.

use nalgebra::Matrix3;
use simworld_core::geometry::Vector3;
use simworld_core::ops;

/// Closer than this below the hip a foot is not brought, m.
const LEAST_DEPTH: f64 = 0.03;
/// A leg is never quite straight: the longest reach as a share of its length.
const STRETCH: f64 = 0.99;

/// The lengths of one leg and where it hangs, trunk frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Leg {
    /// The first joint, m.
    pub(super) hip: Vector3,
    /// From the first joint to the plane of thigh and shank, positive to the left, m.
    pub(super) offset: f64,
    /// m.
    pub(super) thigh: f64,
    /// From the knee to the middle of the foot, m.
    pub(super) shank: f64,
}

/// Turns about x by an angle given by its sine and cosine.
fn roll(v: &Vector3, (sin, cos): (f64, f64)) -> Vector3 {
    Vector3::new(v.x, cos * v.y - sin * v.z, sin * v.y + cos * v.z)
}

impl Leg {
    /// The knee and the foot before the first joint turns them, from that joint.
    fn hanging(&self, q: &[f64; 3]) -> (Vector3, Vector3) {
        let ((sin, cos), (sin_low, cos_low)) = (ops::sin_cos(q[1]), ops::sin_cos(q[1] + q[2]));
        let knee = Vector3::new(-self.thigh * sin, self.offset, -self.thigh * cos);
        (knee, knee - Vector3::new(self.shank * sin_low, 0.0, self.shank * cos_low))
    }

    /// Where the foot is at three angles, trunk frame, m.
    pub(super) fn foot(&self, q: &[f64; 3]) -> Vector3 {
        self.hip + roll(&self.hanging(q).1, ops::sin_cos(q[0]))
    }

    /// Where the centres of mass of hip, thigh and shank are at three angles, trunk frame, m; those of the limbs are so far down them,
    /// as shares of their lengths.
    pub(super) fn centers(&self, q: &[f64; 3], [thigh, shank]: [f64; 2]) -> [Vector3; 3] {
        let offset = Vector3::new(0.0, self.offset, 0.0);
        let (knee, foot) = self.hanging(q);
        let hanging = [offset * 0.5, offset.lerp(&knee, thigh), knee.lerp(&foot, shank)];
        hanging.map(|center| self.hip + roll(&center, ops::sin_cos(q[0])))
    }

    /// The angles that put the foot there, or as near as the leg reaches; the foot stays below the hip.
    pub(super) fn reach(&self, foot: &Vector3) -> [f64; 3] {
        let p = foot - self.hip;
        let across = self.offset * self.offset;
        let depth = (p.y * p.y + p.z * p.z - across).max(LEAST_DEPTH * LEAST_DEPTH).sqrt();
        let first = ops::wrap_angle(ops::atan2(p.z, p.y) - ops::atan2(-depth, self.offset));
        let (low, high) = ((self.thigh - self.shank).abs() + 1e-3, STRETCH * (self.thigh + self.shank));
        let way = ops::hypot(p.x, depth).clamp(low, high);
        let cosine =
            (way * way - self.thigh * self.thigh - self.shank * self.shank) / (2.0 * self.thigh * self.shank);
        let knee = -ops::acos(cosine.clamp(-1.0, 1.0));
        let (sin, cos) = ops::sin_cos(knee);
        let bend = ops::atan2(self.shank * sin, self.thigh + self.shank * cos);
        [first, ops::atan2(-p.x, depth) - bend, knee]
    }

    /// How the foot moves with the angles, trunk frame, m/rad: a column a joint.
    pub(super) fn jacobian(&self, q: &[f64; 3]) -> Matrix3<f64> {
        let turn = ops::sin_cos(q[0]);
        let (knee, foot) = self.hanging(q);
        let (knee, foot) = (roll(&knee, turn), roll(&foot, turn));
        let across = roll(&Vector3::new(0.0, self.offset, 0.0), turn);
        let axis = roll(&Vector3::y(), turn);
        Matrix3::from_columns(&[
            Vector3::x().cross(&foot),
            axis.cross(&(foot - across)),
            axis.cross(&(foot - knee)),
        ])
    }
}

#[cfg(test)]
mod tests {
    use simworld_core::seed::Seed;

    use super::*;

    fn legs() -> [Leg; 2] {
        [1.0, -1.0].map(|side| Leg {
            hip: Vector3::new(0.19, 0.05 * side, 0.0),
            offset: 0.08 * side,
            thigh: 0.213,
            shank: 0.213,
        })
    }

    #[test]
    fn a_foot_comes_where_the_angles_were_asked_for() {
        let mut rng = Seed(3).stream("test/legs").rng();
        for leg in legs() {
            for _ in 0..2000 {
                let q = [rng.uniform(-0.8, 0.8), rng.uniform(-0.6, 1.4), rng.uniform(-2.7, -0.9)];
                let foot = leg.foot(&q);
                let below = roll(&(foot - leg.hip), ops::sin_cos(-q[0])).z;
                if below > -LEAST_DEPTH {
                    continue; // above the hip there is another leg that reaches it
                }
                let found = leg.reach(&foot);
                for (a, b) in q.iter().zip(found) {
                    assert!((a - b).abs() < 1e-9, "{q:?} {found:?}");
                }
            }
        }
    }

    #[test]
    fn what_is_out_of_reach_is_reached_for() {
        for leg in legs() {
            let q = leg.reach(&(leg.hip + Vector3::new(0.4, leg.offset, -3.0)));
            assert!(q.iter().all(|angle| angle.is_finite()));
            let foot = leg.foot(&q) - leg.hip;
            assert!((foot.x * foot.x + foot.z * foot.z).sqrt() > 0.42, "{foot}");
        }
    }

    #[test]
    fn the_jacobian_is_the_derivative() {
        let step = 1e-6;
        for leg in legs() {
            let q = [0.3, 0.7, -1.6];
            let jacobian = leg.jacobian(&q);
            for joint in 0..3 {
                let (mut low, mut high) = (q, q);
                (low[joint], high[joint]) = (q[joint] - step, q[joint] + step);
                let column = (leg.foot(&high) - leg.foot(&low)) / (2.0 * step);
                assert!((column - jacobian.column(joint)).norm() < 1e-8, "{joint}");
            }
        }
    }

    #[test]
    fn the_foot_of_a_straight_leg_is_straight_below() {
        for leg in legs() {
            let foot = leg.foot(&[0.0; 3]);
            assert!((foot - leg.hip - Vector3::new(0.0, leg.offset, -0.426)).norm() < 1e-12);
        }
    }
}
