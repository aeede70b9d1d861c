//! Control: throttle, brake and steering that make a body follow the behaviour's speed and lane.
//!
//! Car following decides what a vehicle should do; these controllers decide which pedals do it. They serve vehicles with
//! physical bodies; the fast bodies on lanes need none.

use crate::action::Action;
use crate::geometry::{Point2, Pose, direction, planar, yaw_of};
use crate::net::polyline;
use crate::ops::{atan2, wrap_angle};
use serde::{Deserialize, Serialize};

/// A proportional-integral-derivative controller with a clamped integral.
///
/// ```
/// use simworld_core::control::Pid;
/// let mut cruise = Pid::new(0.5, 0.1, 0.0, 1.0);
/// assert_eq!(cruise.update(2.0, 0.1), 0.5 * 2.0 + 0.1 * 0.2);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Pid {
    proportional: f64,
    integral: f64,
    derivative: f64,
    /// Bound of the integral term's contribution.
    windup: f64,
    sum: f64,
    last: Option<f64>,
}

impl Pid {
    /// A controller with these gains; the integral term contributes at most `windup` to either side.
    pub const fn new(proportional: f64, integral: f64, derivative: f64, windup: f64) -> Self {
        Self { proportional, integral, derivative, windup, sum: 0.0, last: None }
    }

    /// The output for an error that has stood for `dt` s; nothing is made of an error that is not finite, or has stood for no time.
    pub fn update(&mut self, error: f64, dt: f64) -> f64 {
        if !(error.is_finite() && dt > 0.0 && dt.is_finite()) {
            return 0.0;
        }
        let bound = if self.integral > 0.0 { self.windup / self.integral } else { 0.0 };
        self.sum = (self.sum + error * dt).clamp(-bound, bound);
        let slope = self.last.map_or(0.0, |last| (error - last) / dt);
        self.last = Some(error);
        self.proportional * error + self.integral * self.sum + self.derivative * slope
    }

    /// Lets the integral term contribute at most so much upwards from here on, in the unit of the output.
    pub fn cap(&mut self, most: f64) {
        if self.integral > 0.0 {
            self.sum = self.sum.min(most / self.integral);
        }
    }

    /// Forgets what was.
    pub fn reset(&mut self) {
        self.sum = 0.0;
        self.last = None;
    }
}

/// Drives a body along a path at a speed: PID on the pedals, pure pursuit with a PID on what is left on the wheel.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Driver {
    pedals: Pid,
    wheel: Pid,
    /// Distance between the axles, m.
    pub wheelbase: f64,
    /// Greatest angle of the front wheels, radians.
    pub lock: f64,
}

impl Default for Driver {
    /// A passenger car.
    fn default() -> Self {
        Self {
            pedals: Pid::new(0.35, 0.05, 0.0, 0.3),
            wheel: Pid::new(0.25, 0.02, 0.02, 0.05),
            wheelbase: 2.7,
            lock: 0.6,
        }
    }
}

impl Driver {
    /// The pedal and the wheel for a body at a pose and a speed, to follow `path` at `wanted` m/s. A body of which any of these is
    /// not finite is braked.
    pub fn drive(&mut self, pose: &Pose, speed: f64, path: &[Point2], wanted: f64, dt: f64) -> [Action; 2] {
        let at = planar(pose);
        if ![at.x, at.y, yaw_of(pose), speed, wanted].iter().all(|number| number.is_finite()) {
            return [Action::Brake { level: 1.0 }, Action::Steer { angle: 0.0 }];
        }
        [self.pedal(speed, wanted, dt), Action::Steer { angle: self.steer(pose, speed, path, dt) }]
    }

    fn pedal(&mut self, speed: f64, wanted: f64, dt: f64) -> Action {
        /// Below this the foot changes pedals for nothing.
        const DEAD_BAND: f64 = 0.05;
        /// From this speed on all of the integral term may be needed, m/s.
        const FULL_DRAG: f64 = 2.0;
        if wanted <= 0.0 && speed < 0.3 {
            self.pedals.reset();
            return Action::Brake { level: 1.0 };
        }
        // What drag takes grows with the speed: a foot that held a speed lets go of the pedal when one is to roll to a line.
        if speed > wanted {
            self.pedals.cap(self.pedals.windup * (wanted / FULL_DRAG).clamp(0.0, 1.0));
        }
        let demand = self.pedals.update(wanted - speed, dt);
        if demand < -DEAD_BAND {
            Action::Brake { level: (-demand).min(1.0) }
        } else {
            Action::Throttle { level: demand.clamp(0.0, 1.0) }
        }
    }

    fn steer(&mut self, pose: &Pose, speed: f64, path: &[Point2], dt: f64) -> f64 {
        let here = planar(pose);
        let Some(near) = polyline::closest(path, &here) else { return 0.0 };
        let ahead = (0.6 * speed).clamp(4.0, 15.0);
        let target = polyline::at(path, near.station + ahead).0 - here;
        let bearing = wrap_angle(atan2(target.y, target.x) - yaw_of(pose));
        // Pure pursuit (Coulter 1992): the arc through the target; the PID takes out what is left beside the path.
        let arc = atan2(2.0 * self.wheelbase * crate::ops::sin(bearing), target.norm().max(1.0));
        // Before its begin one is as far beside the path as beside its first piece made longer.
        let (point, heading) = polyline::at(path, near.station);
        let is_before = near.station <= 0.0;
        let aside = if is_before { direction(heading).perp(&(here - point)) } else { near.lateral };
        let correction = self.wheel.update(-aside, dt) / (1.0 + speed);
        (arc + correction).clamp(-self.lock, self.lock)
    }
}

#[cfg(test)]
mod tests {
    use crate::geometry::{Point3, pose_facing};
    use crate::ops::tan;

    use super::*;

    /// A kinematic bicycle with a first-order drive line: full throttle is 3 m/s², full brake 8 m/s².
    struct Bicycle {
        at: Point2,
        yaw: f64,
        v: f64,
    }

    impl Bicycle {
        fn step(&mut self, actions: &[Action; 2], dt: f64) {
            let acceleration = match actions[0] {
                Action::Throttle { level } => 3.0 * level - 0.02 * self.v,
                Action::Brake { level } => -8.0 * level,
                _ => 0.0,
            };
            self.v = (self.v + acceleration * dt).max(0.0);
            if let Action::Steer { angle } = actions[1] {
                self.yaw += self.v / 2.7 * tan(angle) * dt;
            }
            self.at += direction(self.yaw) * (self.v * dt);
        }
    }

    #[test]
    fn who_stands_before_the_begin_of_a_path_goes_straight_on_to_it() {
        let path = [Point2::new(0.0, 0.0), Point2::new(40.0, 0.0)];
        let mut body = Bicycle { at: Point2::new(-6.0, 0.05), yaw: 0.0, v: 0.0 };
        let mut driver = Driver::default();
        for _ in 0..50 {
            let pose = pose_facing(Point3::new(body.at.x, body.at.y, 0.0), body.yaw);
            let actions = driver.drive(&pose, body.v, &path, 3.0, 0.1);
            body.step(&actions, 0.1);
            assert!(body.at.y.abs() < 0.15, "{}", body.at);
        }
        assert!(body.at.x > 0.0);
    }

    #[test]
    fn a_foot_that_held_a_speed_rolls_to_a_line_and_not_over_it() {
        let path = [Point2::new(0.0, 0.0), Point2::new(200.0, 0.0)];
        let mut body = Bicycle { at: path[0], yaw: 0.0, v: 0.0 };
        let mut driver = Driver::default();
        let (line, lag) = (120.0, 0.8);
        for _ in 0..600 {
            let left = line - body.at.x;
            let wanted = (2.0 * 2.0 * left.max(0.0)).sqrt().min(left / lag).clamp(0.0, 12.0);
            let pose = pose_facing(Point3::new(body.at.x, body.at.y, 0.0), body.yaw);
            let actions = driver.drive(&pose, body.v, &path, wanted, 0.1);
            body.step(&actions, 0.1);
        }
        assert!(body.v < 0.05, "{} m/s", body.v);
        assert!((line - 1.0..line + 0.2).contains(&body.at.x), "it stands at {}", body.at.x);
    }

    #[test]
    fn a_bicycle_follows_a_turn_of_eight_metres() {
        let mut path = vec![Point2::new(0.0, 0.0), Point2::new(40.0, 0.0)];
        path.extend((1..=10).map(|i| {
            let angle = f64::from(i) * 0.157;
            let (sin, cos) = crate::ops::sin_cos(angle);
            Point2::new(40.0 + 8.0 * sin, 8.0 - 8.0 * cos)
        }));
        path.push(Point2::new(48.0, 60.0));
        let mut driver = Driver::default();
        let mut body = Bicycle { at: Point2::new(0.0, 0.4), yaw: 0.0, v: 0.0 };
        let (mut worst, mut settled) = (0.0_f64, Vec::new());
        for step in 0..400 {
            let pose = pose_facing(Point3::new(body.at.x, body.at.y, 0.0), body.yaw);
            let actions = driver.drive(&pose, body.v, &path, 5.0, 0.05);
            body.step(&actions, 0.05);
            if let Some(near) = polyline::closest(&path, &body.at).filter(|near| near.station > 15.0) {
                worst = worst.max(near.distance);
            }
            if step > 200 {
                settled.push(body.v - 5.0);
            }
            if body.at.y > 55.0 {
                break;
            }
        }
        assert!(worst < 0.8, "{worst} m beside the lane");
        let rms = (settled.iter().map(|e| e * e).sum::<f64>() / settled.len().max(1) as f64).sqrt();
        assert!(rms < 0.3, "speed off by {rms} m/s");
        assert!(body.at.y > 50.0, "it never came round the corner: {}", body.at);
    }
}
