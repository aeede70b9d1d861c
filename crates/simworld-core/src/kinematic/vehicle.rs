//! A vehicle whose wheels roll where they point: the kinematic single-track model, driven by pedals and wheel.
//!
//! Rajamani, Vehicle Dynamics and Control (2012), section 2.2, about the middle between the axles. Without slip it is right
//! up to some 5 m/s² across, which careful drivers do not reach.

use crate::action::{Action, ActionSet};
use crate::control::WHEELBASE;
use crate::geometry::{Pose, Twist, Vector3, direction, pose_facing, yaw_of};
use crate::ops::{atan2, cos, tan};
use crate::scene::Shape;
use crate::seam::{BodyState, Embodiment, EmbodimentError};

use super::numbers;

/// Acceleration at full throttle, m/s²: 100 km/h in ten seconds, as the mean car.
const THROTTLE: f64 = 2.8;
/// Deceleration at full brake, m/s²: dry asphalt.
const BRAKE: f64 = 8.0;
/// What rolling and air take away, 1/s.
const DRAG: f64 = 0.02;
/// How fast the front wheels turn, rad/s: a steering wheel by 600° a second at 16 to 1.
const STEERING: f64 = 0.65;
/// Greatest angle of the front wheels, radians.
const LOCK: f64 = 0.6;
/// Reverse gear goes no faster, m/s.
const REVERSE: f64 = 4.0;

/// A car, bus, truck, motorcycle or bicycle on wheels that do not slip; it passes through walls.
///
/// ```
/// use simworld_core::action::Action;
/// use simworld_core::geometry::Pose;
/// use simworld_core::kinematic::KinematicVehicle;
/// use simworld_core::scene::Shape;
/// use simworld_core::seam::Embodiment;
/// let mut car = KinematicVehicle::new(Pose::identity(), &Shape::cuboid(4.5, 1.8, 1.5));
/// car.apply(&Action::Throttle { level: 0.5 })?;
/// for _ in 0..20 { car.advance(0.1); }
/// assert!((car.state().twist.linear.x - 2.8).abs() < 0.1); // two seconds of 1.4 m/s²
/// # Ok::<(), simworld_core::seam::EmbodimentError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct KinematicVehicle {
    state: BodyState,
    wheelbase: f64,
    /// m/s, negative backwards.
    speed: f64,
    /// In [-1, 1], and in [0, 1].
    throttle: f64,
    brake: f64,
    /// Of the front wheels: where they are, and where they are to be, radians.
    angle: f64,
    wanted: f64,
}

impl KinematicVehicle {
    /// A vehicle at rest, of a solid's length.
    pub fn new(pose: Pose, solid: &Shape) -> Self {
        Self {
            state: BodyState { pose, twist: Twist::ZERO },
            wheelbase: (solid.size().x * WHEELBASE).max(0.5),
            speed: 0.0,
            throttle: 0.0,
            brake: 0.0,
            angle: 0.0,
            wanted: 0.0,
        }
    }

    /// Goes on at the speed that it has along its front: for one that somebody else moved before.
    fn take_up(&mut self, state: &BodyState) {
        self.state = *state;
        self.speed = state.twist.linear.xy().dot(&direction(yaw_of(&state.pose)));
    }
}

impl Embodiment for KinematicVehicle {
    fn supports(&self) -> ActionSet {
        ActionSet::vehicle()
    }

    fn apply(&mut self, action: &Action) -> Result<(), EmbodimentError> {
        let refused = |field, value, allowed| {
            Err(EmbodimentError::Argument { action: action.kind(), field, value, allowed })
        };
        match *action {
            Action::Throttle { level } if (-1.0..=1.0).contains(&level) => {
                (self.throttle, self.brake) = (level, 0.0);
            }
            Action::Throttle { level } => return refused("level", level, "-1 to 1"),
            Action::Brake { level } if (0.0..=1.0).contains(&level) => {
                (self.throttle, self.brake) = (0.0, level);
            }
            Action::Brake { level } => return refused("level", level, "0 to 1"),
            Action::Steer { angle } if angle.is_finite() => self.wanted = angle.clamp(-LOCK, LOCK),
            Action::Steer { angle } => return refused("angle", angle, "a finite angle"),
            Action::Stop => (self.throttle, self.brake) = (0.0, 1.0),
            // What the camera makes of it is the world's business.
            Action::TakePhoto => {}
            ref other => return Err(EmbodimentError::unsupported(other.kind(), self.supports())),
        }
        Ok(())
    }

    fn state(&self) -> BodyState {
        self.state
    }

    fn advance(&mut self, dt: f64) {
        let turn = STEERING * dt;
        self.angle += (self.wanted - self.angle).clamp(-turn, turn);
        let pushed = self.speed + (THROTTLE * self.throttle - DRAG * self.speed) * dt;
        let slowed = (pushed.abs() - BRAKE * self.brake * dt).max(0.0);
        self.speed = slowed.copysign(pushed).max(-REVERSE);
        let slope = tan(self.angle);
        // The middle goes at an angle to the body, and the body turns about the middle of its rear axle.
        let slip = atan2(slope, 2.0);
        let rate = self.speed * cos(slip) * slope / self.wheelbase;
        let yaw = yaw_of(&self.state.pose);
        let way = direction(yaw + rate * dt * 0.5 + slip) * self.speed;
        let linear = Vector3::new(way.x, way.y, 0.0);
        let at = self.state.pose.translation.vector + linear * dt;
        self.state.pose = pose_facing(at.into(), yaw + rate * dt);
        self.state.twist = Twist { linear, angular: Vector3::z() * rate };
    }

    fn save(&self) -> Vec<u8> {
        let Self { wheelbase, speed, throttle, brake, angle, wanted, .. } = *self;
        [wheelbase, speed, throttle, brake, angle, wanted].iter().flat_map(|x| x.to_le_bytes()).collect()
    }

    fn restore(&mut self, state: &BodyState, saved: &[u8]) -> bool {
        let [wheelbase, speed, throttle, brake, angle, wanted] = numbers(saved)[..] else { return false };
        let moved = *state != self.state;
        *self = Self { state: *state, wheelbase, speed, throttle, brake, angle, wanted };
        // A snapshot tells the speed to the bit, and the world the same one; who was pushed has the world's.
        let told = self.state.twist.ground_speed();
        if moved && (told - speed.abs()).abs() > 1e-6 {
            self.take_up(state);
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::planar;

    fn sedan() -> KinematicVehicle {
        KinematicVehicle::new(Pose::identity(), &Shape::cuboid(4.5, 1.8, 1.5))
    }

    #[test]
    fn it_keeps_to_the_law_of_bodies() {
        crate::testing::check_embodiment(|| Box::new(sedan()));
    }

    #[test]
    fn a_full_circle_has_the_radius_of_its_wheels() {
        let mut car = sedan();
        car.apply(&Action::Steer { angle: 0.5 }).unwrap();
        for _ in 0..20 {
            car.advance(0.05); // the wheels turn before it rolls
        }
        car.apply(&Action::Throttle { level: 0.2 }).unwrap();
        let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
        for _ in 0..400 {
            car.advance(0.05);
            let side = planar(&car.state().pose).y;
            (least, most) = (least.min(side), most.max(side));
        }
        // The rear axle goes round at 2.61 / tan 0.5, the middle half a wheelbase before it.
        let rear = 4.5 * WHEELBASE / tan(0.5);
        let before = 4.5 * WHEELBASE * 0.5;
        let middle = (rear * rear + before * before).sqrt();
        assert!(((most - least) * 0.5 - middle).abs() < 0.1, "{least} to {most}, radius {middle}");
    }

    #[test]
    fn it_brakes_backs_and_refuses_what_is_no_pedal() {
        let mut car = sedan();
        car.apply(&Action::Throttle { level: 1.0 }).unwrap();
        (0..40).for_each(|_| car.advance(0.1));
        let before = car.state().pose.translation.x;
        car.apply(&Action::Stop).unwrap();
        (0..40).for_each(|_| car.advance(0.1));
        let way = car.state().pose.translation.x - before;
        assert!(way > 4.0 && way < 10.0 && car.state().twist.ground_speed() == 0.0, "stops in {way} m");
        car.apply(&Action::Throttle { level: -0.5 }).unwrap();
        (0..100).for_each(|_| car.advance(0.1));
        assert_eq!(car.state().twist.linear.x, -REVERSE);
        assert!(car.apply(&Action::Throttle { level: 2.0 }).is_err());
        assert!(car.apply(&Action::StandUp).is_err());
    }
}
