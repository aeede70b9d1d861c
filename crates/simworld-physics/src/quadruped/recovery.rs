//! Lying down, falling, turning over and standing up.

use serde::{Deserialize, Serialize};
use simworld_core::geometry::Vector3;
use simworld_core::scene::{FallCause, Footing};

use super::articulation::PerJoint;
use super::control::Field;
use super::{Quadruped, QuadrupedState};

/// A trunk whose upward axis points less upward than this has fallen (60° of tilt).
const FALLEN: f64 = 0.5;
/// A level acceleration of the trunk that comes from outside, m/s², and for how long a blow is why it falls, s.
const JOLT: f64 = 60.0;
const MEMORY: f64 = 1.0;
/// From this on a body can rise on its legs.
const UPRIGHT: f64 = 0.8;
/// Damping of a limp joint, N m s/rad.
const LIMP: f64 = 0.5;
/// Stiffness and damping of joints that hold a posture, N m/rad and N m s/rad.
const HOLD: [f64; 2] = [80.0, 2.0];
/// Stiffness and damping for turning over.
const TURN: [f64; 2] = [60.0, 1.5];
/// Slower than this, m/s and rad/s, for so long, s, a fallen body rests.
const RESTING: [f64; 2] = [0.15, 0.6];
const REST: f64 = 0.4;
/// After so long it gets up even if it does not rest, s.
const PATIENCE: f64 = 4.0;
/// Times of folding the legs, of one push to turn over, and of rising from folded legs, s.
const FOLDING: f64 = 0.7;
const PUSHING: f64 = 1.2;
const RISING: f64 = 0.9;
/// Of a push, the times of swinging the legs over the back and of stretching them, s; the knees before and after, and the
/// abduction of the legs towards the ground, radians.
const SWINGING: f64 = 0.5;
const STRETCHING: f64 = 0.25;
const TUCKED: f64 = -2.5;
const STRETCHED: f64 = -0.97;
const LEANING: f64 = 0.79;
/// A trunk whose upward axis points less upward than this lies on its back rather than on its side.
const BACK: f64 = -0.55;
/// Height of the trunk over the soles with folded legs, m.
const FOLDED: f64 = 0.11;

/// What a quadruped does with its body as a whole.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(super) enum Task {
    /// It stands or walks.
    #[default]
    Walk,
    /// It lets itself down since so long, s, from where its joints were.
    Lower { since: f64, from: PerJoint },
    /// It lies on its folded legs.
    Lie,
    /// It has fallen and lies limp; at rest for so long and down for so long, s.
    Fallen { rests: f64, since: f64 },
    /// It folds its legs, to rise or to turn over.
    Fold { since: f64, from: PerJoint },
    /// It turns over by a push of the legs of one side.
    Push { since: f64, from: PerJoint, way: Push },
    /// It rises from folded legs since so long, s.
    Rise { since: f64 },
}

/// A push that turns a lying body over.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Push {
    /// Whose legs push: 0 those on the left, 1 those on the right.
    side: usize,
    /// 1 to turn to the left over the right side, -1 the other way round.
    lean: f64,
}

fn mixed(from: &PerJoint, to: &PerJoint, share: f64) -> PerJoint {
    let share = share.clamp(0.0, 1.0);
    let share = share * share * (3.0 - 2.0 * share);
    std::array::from_fn(|leg| {
        std::array::from_fn(|joint| from[leg][joint] + (to[leg][joint] - from[leg][joint]) * share)
    })
}

impl Quadruped {
    /// Whether it has fallen, lies after a fall or gets up from one.
    pub(super) fn footing_of_task(&self) -> Footing {
        match self.motion.task {
            Task::Fallen { rests, .. } if rests > 0.0 => Footing::Down,
            Task::Fallen { .. } => Footing::Falling,
            _ if self.motion.is_down => Footing::Rising,
            _ => Footing::Upright,
        }
    }

    /// The torques that its task asks for.
    pub(super) fn act_on_task(&mut self, sensed: &QuadrupedState, field: &Field<'_>) -> PerJoint {
        let up = (sensed.trunk.rotation * Vector3::z()).z;
        let stands =
            matches!(self.motion.task, Task::Walk | Task::Lie | Task::Lower { .. } | Task::Rise { .. });
        if stands && up < FALLEN {
            self.fall();
        }
        let dt = field.dt;
        self.feel_blows(sensed, dt);
        match self.motion.task.clone() {
            Task::Walk if self.motion.lies => {
                self.motion.task = Task::Lower { since: 0.0, from: sensed.angles };
                hold_angles(&sensed.angles, sensed, HOLD)
            }
            Task::Walk => self.walk(sensed, field),
            Task::Lower { since, from } => {
                self.motion.task =
                    if since > RISING { Task::Lie } else { Task::Lower { since: since + dt, from } };
                hold_angles(&mixed(&from, &self.standing(FOLDED), since / RISING), sensed, HOLD)
            }
            Task::Lie => {
                if !self.motion.lies {
                    self.motion.task = Task::Rise { since: 0.0 };
                }
                hold_angles(&self.standing(FOLDED), sensed, HOLD)
            }
            Task::Rise { since } => self.rise(since, sensed, field),
            Task::Fallen { rests, since } => self.lie_limp(rests, since, sensed, dt),
            Task::Fold { since, from } => {
                self.motion.task = if since < FOLDING {
                    Task::Fold { since: since + dt, from }
                } else {
                    turn_over(sensed, up)
                };
                let folded = self.standing(FOLDED);
                hold_angles(&mixed(&from, &folded, since / FOLDING), sensed, TURN)
            }
            Task::Push { since, from, way } => {
                self.motion.task = if since < PUSHING {
                    Task::Push { since: since + dt, from, way }
                } else {
                    Task::Fold { since: 0.0, from: sensed.angles }
                };
                hold_angles(&self.pushed(way, &from, since), sensed, TURN)
            }
        }
    }

    /// The angles at which all legs stand with the trunk so high, m.
    pub(super) fn standing(&self, height: f64) -> PerJoint {
        std::array::from_fn(|leg| self.config.model.standing(leg, height))
    }

    fn fall(&mut self) {
        let struck = self.motion.shaken > 0.0;
        self.motion.news.fell = Some(if struck { FallCause::Struck } else { FallCause::Slipped });
        self.motion.is_down = true;
        self.motion.lies = false;
        self.motion.task = Task::Fallen { rests: 0.0, since: 0.0 };
    }

    /// Remembers blows: jolts harder than its own legs can give it.
    fn feel_blows(&mut self, sensed: &QuadrupedState, dt: f64) {
        let jolt = (sensed.linear - self.motion.before).xy().norm();
        self.motion.shaken = if jolt > JOLT * dt { MEMORY } else { (self.motion.shaken - dt).max(0.0) };
    }

    fn lie_limp(&mut self, rests: f64, since: f64, sensed: &QuadrupedState, dt: f64) -> PerJoint {
        let slow = sensed.linear.norm() < RESTING[0] && sensed.angular.norm() < RESTING[1];
        let rests = if slow { rests + dt } else { 0.0 };
        self.motion.task = if rests > REST || since > PATIENCE {
            Task::Fold { since: 0.0, from: sensed.angles }
        } else {
            Task::Fallen { rests, since: since + dt }
        };
        sensed.speeds.map(|leg| leg.map(|speed| -LIMP * speed))
    }

    /// Straightens the legs under the trunk, which its weight is shared by.
    fn rise(&mut self, since: f64, sensed: &QuadrupedState, field: &Field<'_>) -> PerJoint {
        let share = (since / RISING).min(1.0);
        let height = FOLDED + (self.config.model.standing_height() - FOLDED) * share;
        self.motion.task = Task::Rise { since: since + field.dt };
        if since > RISING + 0.2 {
            self.start_walk(sensed);
            self.motion.news.got_up = std::mem::take(&mut self.motion.is_down);
        }
        let hold = hold_angles(&self.standing(height), sensed, HOLD);
        let weight = Vector3::z() * (self.config.model.mass() * field.gravity * 0.25);
        std::array::from_fn(|leg| {
            let press = self.press(leg, &weight, sensed);
            std::array::from_fn(|joint| hold[leg][joint] + press[joint])
        })
    }

    /// Where the legs go to turn a lying body over: those that push swing over the back and then stretch.
    fn pushed(&self, way: Push, from: &PerJoint, since: f64) -> PerJoint {
        let (swung, stretched) = (self.over_the_back(way, TUCKED), self.over_the_back(way, STRETCHED));
        if since < SWINGING {
            mixed(from, &swung, since / SWINGING)
        } else {
            mixed(&swung, &stretched, (since - SWINGING) / STRETCHING)
        }
    }

    fn over_the_back(&self, way: Push, knee: f64) -> PerJoint {
        let mut legs = self.standing(FOLDED);
        for (leg, angles) in legs.iter_mut().enumerate() {
            if leg % 2 == way.side {
                *angles = [way.lean * LEANING, std::f64::consts::PI - 0.5 * knee, knee];
            }
        }
        legs
    }
}

/// Torques that bring the joints to angles and keep them there.
fn hold_angles(angles: &PerJoint, sensed: &QuadrupedState, [stiffness, damping]: [f64; 2]) -> PerJoint {
    std::array::from_fn(|leg| {
        std::array::from_fn(|joint| {
            stiffness * (angles[leg][joint] - sensed.angles[leg][joint]) - damping * sensed.speeds[leg][joint]
        })
    })
}

/// What to do with folded legs: rise, or push.
fn turn_over(sensed: &QuadrupedState, up: f64) -> Task {
    if up > UPRIGHT {
        return Task::Rise { since: 0.0 };
    }
    // The left axis points up on a body that lies on its right side.
    let lean = if (sensed.trunk.rotation * Vector3::y()).z > 0.0 { 1.0 } else { -1.0 };
    // From the back the upper legs push, from the side the lower ones: either way on the side of the back.
    let side = usize::from((lean > 0.0) != (up < BACK));
    Task::Push { since: 0.0, from: sensed.angles, way: Push { side, lean } }
}
