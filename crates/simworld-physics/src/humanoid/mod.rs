//! A person on foot or on a scooter, or a dog: what it is told and in what state it is. How it moves is in `walk`.

mod actions;
mod surface;
mod walk;

pub(crate) use walk::SKIN;

use serde::{Deserialize, Serialize};
use simworld_core::action::{Action, ActionSet};
use simworld_core::geometry::{Pose, Twist, Vector3, pose_facing, yaw_of};
use simworld_core::scene::{EntityKind, EntityRef, Shape};
use simworld_core::seam::{BodyState, Embodiment, EmbodimentError};

use crate::error::{PhysicsError, check_range};

/// The form of a person's collider; both have the width and height of the entity's shape.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ColliderForm {
    /// A cylinder, which climbs stairs best.
    #[default]
    Cylinder,
    /// A capsule, which slips past edges.
    Capsule,
}

/// What a person can do with legs and on a scooter.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct HumanoidConfig {
    /// The form of the collider.
    pub form: ColliderForm,
    /// Greatest speed on foot, m/s, 0.1 to 12; faster orders are carried out at this speed. People walk at 1.34
    /// m/s with a standard deviation of 0.26 (Weidmann 1993) and jog at 2.5.
    pub top_speed: f64,
    /// Speed of a single step, m/s, 0.1 to 12.
    pub step_speed: f64,
    /// Greatest turning rate, rad/s, 0.1 to 20. At the default an about-turn takes 0.8 s.
    pub turning_rate: f64,
    /// Greatest speed on a scooter, m/s, 0.1 to 20. 6.9 m/s is 25 km/h, the limit of the European type approval.
    pub ride_speed: f64,
    /// Acceleration on a scooter, m/s², 0.1 to 10.
    pub ride_acceleration: f64,
    /// Deceleration on a scooter, m/s², 0.1 to 10; European rules ask for 3.5.
    pub ride_braking: f64,
    /// Greatest lateral acceleration on a scooter, m/s², 0.1 to 10: it limits the turning rate at speed, and a
    /// rider slows down for sharp turns.
    pub ride_lateral: f64,
}

impl Default for HumanoidConfig {
    fn default() -> Self {
        Self {
            form: ColliderForm::Cylinder,
            top_speed: 2.5,
            step_speed: 1.34,
            turning_rate: 4.0,
            ride_speed: 6.9,
            ride_acceleration: 1.5,
            ride_braking: 3.5,
            ride_lateral: 4.0,
        }
    }
}

impl HumanoidConfig {
    /// A robot dog: up to 3 m/s, as small quadrupeds are sold (the Unitree Go1 does 3.5, Spot 1.6), and half a metre a second
    /// in single steps.
    pub fn dog() -> Self {
        Self { top_speed: 3.0, step_speed: 0.5, ..Self::default() }
    }

    /// Checks every field.
    ///
    /// # Errors
    /// The first field out of range, with what is allowed.
    pub fn validate(&self) -> Result<(), PhysicsError> {
        let check =
            |field, value, range, allowed| check_range("HumanoidConfig", field, value, range, allowed);
        check("top_speed", self.top_speed, 0.1..=12.0, "0.1 to 12 m/s")?;
        check("step_speed", self.step_speed, 0.1..=12.0, "0.1 to 12 m/s")?;
        check("turning_rate", self.turning_rate, 0.1..=20.0, "0.1 to 20 rad/s")?;
        check("ride_speed", self.ride_speed, 0.1..=20.0, "0.1 to 20 m/s")?;
        check("ride_acceleration", self.ride_acceleration, 0.1..=10.0, "0.1 to 10 m/s²")?;
        check("ride_braking", self.ride_braking, 0.1..=10.0, "0.1 to 10 m/s²")?;
        check("ride_lateral", self.ride_lateral, 0.1..=10.0, "0.1 to 10 m/s²")
    }
}

/// What a person is doing with the body as a whole.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Posture {
    /// On foot.
    #[default]
    Standing,
    /// On a seat; the seat moves the body.
    Seated,
    /// In a vehicle; the vehicle moves the body.
    Aboard,
    /// On a scooter.
    Riding,
}

/// A person: an upright body on rapier's kinematic character controller.
///
/// It walks and slides along walls, takes steps and slopes within the limits of the
/// [`PhysicsConfig`](crate::PhysicsConfig), falls where there is no ground, and pushes nothing.
#[derive(Clone, Debug)]
pub struct Humanoid {
    config: HumanoidConfig,
    abilities: ActionSet,
    radius: f64,
    height: f64,
    state: BodyState,
    motion: Motion,
}

/// Everything about a humanoid that changes and is not in its [`BodyState`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Motion {
    posture: Posture,
    /// Heading, radians.
    yaw: f64,
    /// What is left of the turn it was told, radians.
    turn_left: f64,
    /// The speed it was told, m/s.
    wanted_speed: f64,
    /// Its speed along the heading, m/s.
    speed: f64,
    /// What is left of a single step, body frame, m.
    step_left: Vector3,
    /// Downward speed while airborne, m/s.
    fall_speed: f64,
    /// Whether there is ground under its feet.
    grounded: bool,
    /// Where the controller leads in this substep, world frame, m.
    planned: Vector3,
}

impl Humanoid {
    /// A person 1.75 m tall and 0.5 m wide who stands at a pose; its tilt is ignored.
    ///
    /// # Errors
    /// A setting out of range.
    pub fn new(pose: Pose, config: HumanoidConfig) -> Result<Self, PhysicsError> {
        config.validate()?;
        let mut body = Self {
            config,
            abilities: ActionSet::humanoid(),
            radius: 0.25,
            height: 1.75,
            state: BodyState { pose, twist: Twist::ZERO },
            motion: Motion {
                posture: Posture::Standing,
                yaw: 0.0,
                turn_left: 0.0,
                wanted_speed: 0.0,
                speed: 0.0,
                step_left: Vector3::zeros(),
                fall_speed: 0.0,
                grounded: false,
                planned: Vector3::zeros(),
            },
        };
        body.stand_at(&pose);
        Ok(body)
    }

    /// A person with the pose and the size of an entity: as wide as the narrower side of its shape, as tall as it
    /// is high. A dog's entity does what dogs do.
    ///
    /// # Errors
    /// A setting out of range, or a shape that is no upright body from 0.3 m to 3 m tall and 0.1 m to 2 m wide.
    pub fn of(entity: &EntityRef<'_>, config: HumanoidConfig) -> Result<Self, PhysicsError> {
        let size = match entity.info.shape {
            Shape::Sphere { radius } => Vector3::new(radius, radius, 2.0 * radius) * std::f64::consts::SQRT_2,
            ref upright => upright.size(),
        };
        let (width, height) = (size.x.min(size.y), size.z);
        if !(0.1..=2.0).contains(&width) || !(0.3..=3.0).contains(&height) || height < width {
            let reason = format!(
                "it is {width} m wide and {height} m tall; give 0.1 to 2 m and 0.3 to 3 m, taller than wide"
            );
            return Err(PhysicsError::Shape { id: entity.id, body: "humanoid", reason });
        }
        let abilities = match entity.kind {
            EntityKind::Dog => ActionSet::dog(),
            _ => ActionSet::humanoid(),
        };
        Ok(Self { abilities, radius: width * 0.5, height, ..Self::new(*entity.pose, config)? })
    }

    /// What it is doing with the body as a whole.
    pub fn posture(&self) -> Posture {
        self.motion.posture
    }

    /// Whether there is ground under its feet.
    pub fn is_grounded(&self) -> bool {
        self.motion.grounded
    }

    fn stand_at(&mut self, pose: &Pose) {
        self.motion.yaw = yaw_of(pose);
        self.state.pose = pose_facing(pose.translation.vector.into(), self.motion.yaw);
    }

    fn halt(&mut self) {
        self.motion.wanted_speed = 0.0;
        self.motion.turn_left = 0.0;
        self.motion.step_left = Vector3::zeros();
        if self.motion.posture != Posture::Riding {
            self.motion.speed = 0.0;
        }
    }

    fn top_speed(&self) -> f64 {
        match self.motion.posture {
            Posture::Riding => self.config.ride_speed,
            _ => self.config.top_speed,
        }
    }
}

impl Embodiment for Humanoid {
    fn supports(&self) -> ActionSet {
        self.abilities
    }

    fn apply(&mut self, action: &Action) -> Result<(), EmbodimentError> {
        if self.abilities.contains(action.kind()) {
            self.take(action)
        } else {
            Err(EmbodimentError::unsupported(action.kind(), self.abilities))
        }
    }

    fn state(&self) -> BodyState {
        self.state
    }

    fn save(&self) -> Vec<u8> {
        let Self { config, abilities, radius, height, motion, .. } = self;
        postcard::to_allocvec(&("humanoid", config, abilities, radius, height, motion))
            .expect("plain numbers always serialise")
    }

    fn restore(&mut self, state: &BodyState, saved: &[u8]) -> bool {
        type Saved<'a> = (&'a str, HumanoidConfig, ActionSet, f64, f64, Motion);
        match postcard::from_bytes::<Saved<'_>>(saved) {
            Ok(("humanoid", config, abilities, radius, height, motion)) if config.validate().is_ok() => {
                *self = Self { config, abilities, radius, height, state: *state, motion };
                true
            }
            _ => false,
        }
    }
}
