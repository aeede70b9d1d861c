//! Control: throttle, brake and steering that make a body follow the behaviour's speed and lane.
//!
//! Car following decides what a vehicle should do; these controllers decide which pedals do it. They serve vehicles with
//! physical bodies; the fast bodies on lanes need none.

use crate::action::Action;
use crate::geometry::{Point2, Pose, Vector2, direction, planar, yaw_of};
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

/// Drives a body along a path at a speed: PID on the pedals, Stanley's law on the wheel.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Driver {
    pedals: Pid,
    /// Distance between the axles, m.
    pub wheelbase: f64,
    /// Greatest angle of the front wheels, radians.
    pub lock: f64,
}

/// Axles stand so much of the length apart: a sedan's 2.6 of 4.5 m, a bus's 7 of 12 m.
pub(crate) const WHEELBASE: f64 = 0.58;

impl Default for Driver {
    /// Of a passenger car.
    fn default() -> Self {
        Self::of_length(4.65)
    }
}

impl Driver {
    /// Of a vehicle of a length, m, whose axles stand where they do on cars, buses and motorcycles.
    ///
    /// ```
    /// use simworld_core::control::Driver;
    /// assert!((Driver::of_length(12.0).wheelbase - 7.0).abs() < 0.1);
    /// ```
    pub fn of_length(length: f64) -> Self {
        Self { pedals: Pid::new(0.35, 0.05, 0.0, 0.3), wheelbase: (length * WHEELBASE).max(0.5), lock: 0.6 }
    }

    /// The pedal and the wheel for a body at a pose and a speed, to follow `path` at `wanted` m/s. A body of which any of these is
    /// not finite is braked.
    pub fn drive(&mut self, pose: &Pose, speed: f64, path: &[Point2], wanted: f64, dt: f64) -> [Action; 2] {
        let at = planar(pose);
        if ![at.x, at.y, yaw_of(pose), speed, wanted].iter().all(|number| number.is_finite()) {
            return [Action::Brake { level: 1.0 }, Action::Steer { angle: 0.0 }];
        }
        [self.pedal(speed, wanted, dt), Action::Steer { angle: self.steer(pose, speed, path) }]
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

    /// The bend of the path, and beside it Stanley's law (Hoffmann et al. 2007): a point of the vehicle is to go along the path,
    /// and towards it the faster the farther it is beside.
    fn steer(&self, pose: &Pose, speed: f64, path: &[Point2]) -> f64 {
        /// The point, of the wheelbase before the rear axle. The front axle leaves the rear far inside of a bend, the rear axle
        /// the front outside; here both share it.
        const SHARE: f64 = 0.75;
        /// How fast what is beside the path is taken out, 1/s, and the speed from which on it is, m/s.
        const GAIN: f64 = 1.0;
        const SOFT: f64 = 2.0;
        /// The body turns to where it should at most so fast, 1/s: with wheels and a mind that follow later it swings beyond.
        const TURNING: f64 = 3.0;
        /// The wheels follow what they are told so much later, s.
        const LAG: f64 = 0.15;
        /// The steepest that one goes towards the path, radians, and what tyres give across, m/s².
        const STEEPEST: f64 = 1.2;
        const GRIP: f64 = 6.0;
        let yaw = yaw_of(pose);
        let point = planar(pose) + direction(yaw) * ((SHARE - 0.5) * self.wheelbase);
        let Some(near) = polyline::closest(path, &point) else { return 0.0 };
        // Before its begin one is as far beside the path as beside its first piece made longer.
        let (place, first) = polyline::at(path, near.station);
        let is_before = near.station <= 0.0;
        let aside = if is_before { direction(first).perp(&(point - place)) } else { near.lateral };
        let (along, curvature) = bend(path, near.station + LAG * speed.max(0.0)).unwrap_or((first, 0.0));
        let (turned, bent) = (SHARE * self.wheelbase * curvature, self.wheelbase * curvature);
        let wanted = wrap_angle(along - yaw) - atan2(turned, 1.0) - atan2(GAIN * aside, speed.abs() + SOFT);
        let gain = (TURNING * self.wheelbase / speed.abs().max(0.1)).min(1.0 / SHARE);
        let held = atan2(GRIP * self.wheelbase, speed * speed).min(self.lock);
        (atan2(bent, 1.0) + gain * wanted.clamp(-STEEPEST, STEEPEST)).clamp(-held, held)
    }
}

/// The heading of a path at a station, radians, and how it bends there, 1/m: over a piece so long that its corners are none.
fn bend(path: &[Point2], station: f64) -> Option<(f64, f64)> {
    const PIECE: f64 = 2.0;
    let [before, here, after] = [-PIECE, 0.0, PIECE].map(|offset| polyline::at(path, station + offset).0);
    let bearing = |way: Vector2| (way.norm() > 0.1).then(|| atan2(way.y, way.x));
    let along = bearing(after - before)?;
    let turn =
        bearing(here - before).zip(bearing(after - here)).map_or(0.0, |(from, to)| wrap_angle(to - from));
    Some((along, turn / PIECE))
}

#[cfg(test)]
mod tests {
    use crate::geometry::{Point3, pose_facing};
    use crate::kinematic::KinematicVehicle;
    use crate::ops::tan;
    use crate::scene::Shape;
    use crate::seam::Embodiment;

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

    /// How far beside a path the ends of a vehicle of a length are, of which `begin` tells the place and the heading: at each
    /// tenth of a second that which is farther.
    fn driven(length: f64, path: &[Point2], begin: (f64, f64, f64), speed: f64) -> Vec<f64> {
        let (x, y, yaw) = begin;
        let solid = Shape::cuboid(length, 2.0, 2.0);
        let mut body = KinematicVehicle::new(pose_facing(Point3::new(x, y, 0.0), yaw), &solid);
        let (mut driver, mut beside) = (Driver::of_length(length), Vec::new());
        loop {
            let state = body.state();
            let near = polyline::closest(path, &planar(&state.pose)).unwrap();
            if near.station > polyline::length(path) - length || beside.len() > 2000 {
                return beside;
            }
            let ends = [-0.5, 0.5]
                .map(|share| planar(&state.pose) + direction(yaw_of(&state.pose)) * (share * length));
            let lateral = ends.map(|end| polyline::closest(path, &end).unwrap().lateral.abs());
            beside.push(lateral[0].max(lateral[1]));
            for action in driver.drive(&state.pose, state.twist.ground_speed(), path, speed, 0.1) {
                body.apply(&action).unwrap();
            }
            body.advance(0.1);
        }
    }

    #[test]
    fn no_vehicle_swings_about_its_path() {
        let path = [Point2::new(0.0, 0.0), Point2::new(300.0, 0.0)];
        for length in [1.8, 2.1, 4.5, 6.0, 8.5, 12.0] {
            for (speed, yaw) in [(3.0, 0.6), (5.0, 0.5), (8.0, 0.5), (11.0, 0.3), (15.0, 0.2)] {
                let beside = driven(length, &path, (5.0, 1.2, yaw), speed);
                let late = beside
                    .iter()
                    .rev()
                    .take(beside.len() / 2)
                    .fold(0.0, |most: f64, aside| most.max(aside.abs()));
                assert!(late < 0.15, "{length} m at {speed} m/s is {late:.2} m beside its path for good");
            }
        }
    }

    #[test]
    fn long_vehicles_keep_to_the_lane_in_a_turn() {
        for (length, radius, most) in [(2.1, 8.0, 0.5), (4.5, 8.0, 0.65), (8.5, 12.0, 1.1), (12.0, 20.0, 1.4)]
        {
            let mut path = vec![Point2::new(0.0, 0.0), Point2::new(40.0, 0.0)];
            path.extend((1..=24).map(|i| {
                let (sin, cos) = crate::ops::sin_cos(f64::from(i) * core::f64::consts::FRAC_PI_2 / 24.0);
                Point2::new(40.0 + radius * sin, radius - radius * cos)
            }));
            path.push(Point2::new(40.0 + radius, radius + 60.0));
            let beside = driven(length, &path, (6.0, 0.0, 0.0), 4.0);
            let worst = beside.iter().fold(0.0, |most: f64, aside| most.max(aside.abs()));
            assert!(worst < most, "{length} m in a bend of {radius} m is {worst:.2} m beside its path");
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
