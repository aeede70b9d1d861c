//! A person on foot or on a scooter, or a dog: what it is told and in what state it is. How it moves is in `walk`, how it
//! falls and gets up in `balance`, `ragdoll` and `recovery`.

mod actions;
mod balance;
mod burial;
mod crouch;
mod gait;
mod gap;
mod hold;
mod pace;
mod physics_body;
mod push;
mod ragdoll;
mod recovery;
mod stairs;
mod stroll;
mod surface;
mod walk;

pub(crate) use balance::least_blow;
pub(crate) use push::Shove;
pub(crate) use walk::SKIN;

use balance::Balance;
use crouch::Crouch;
use gait::Gait;
use pace::Pace;
use push::Push;
use ragdoll::Build;
use rapier3d_f64::prelude::ColliderHandle;
use recovery::Recovery;
use serde::{Deserialize, Serialize};
use simworld_core::action::{Action, ActionSet};
use simworld_core::geometry::{Point3, Pose, Twist, Vector2, Vector3, pose_facing, yaw_of};
use simworld_core::limbs::JointAngles;
use simworld_core::scene::{EntityKind, EntityRef, FallCause, Footing, Shape};
use simworld_core::seam::{BodyState, Embodiment, EmbodimentError};
use stroll::Stroll;

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

/// Whether somebody can fall.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Surefootedness {
    /// As people: who trips, slips or is run into falls, and gets up again.
    #[default]
    Human,
    /// It stays on its feet whatever happens.
    Unfailing,
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
    /// Whether it can fall.
    pub balance: Surefootedness,
    /// The greatest force with which it pushes things that are in the way, and pushes and pulls what it holds, N, 0 to 1000. Half of all men push a cart
    /// with 250 N at the start and hold 150 N (Snook and Ciriello, Ergonomics 34, 1991, rounded).
    pub push_force: f64,
    /// What it gives a throw at most, as energy of the thing, the hand and the forearm, J, 0 to 1000: with 200 a ball of 0.15 kg
    /// leaves the hand at 22 m/s, a parcel of a kilogram at 15.6, a load of 15 kg at 5.
    pub throw_energy: f64,
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
            balance: Surefootedness::Human,
            push_force: 200.0,
            throw_energy: 200.0,
        }
    }
}

impl HumanoidConfig {
    /// A robot dog: up to 3 m/s, as small quadrupeds are sold (the Unitree Go1 does 3.5, Spot 1.6), and half a metre a second
    /// in single steps. It does not fall.
    pub fn dog() -> Self {
        let balance = Surefootedness::Unfailing;
        Self { top_speed: 3.0, step_speed: 0.5, balance, push_force: 50.0, ..Self::default() }
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
        check("ride_lateral", self.ride_lateral, 0.1..=10.0, "0.1 to 10 m/s²")?;
        check("push_force", self.push_force, 0.0..=1000.0, "0 to 1000 N")?;
        check("throw_energy", self.throw_energy, 0.0..=1000.0, "0 to 1000 J")
    }
}

/// What is left of what somebody was told, for bodies that go by it in a way of their own.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Orders {
    /// Speed along the heading, m/s.
    pub(crate) speed: f64,
    /// What is left of a single step, body frame, m, and its speed, m/s.
    pub(crate) step: Vector3,
    pub(crate) step_speed: f64,
    /// What is left of a turn, radians.
    pub(crate) turn: f64,
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

/// Mass of a person whose mass nobody gave, kg.
const MASS: f64 = 75.0;

/// A person: an upright body on rapier's kinematic character controller, and limbs on joints when it falls.
///
/// It walks and slides along walls, takes steps and slopes within the limits of the
/// [`PhysicsConfig`](crate::PhysicsConfig), slower where they are steep, and falls where there is no ground. It pushes
/// what is light, makes room for who pushes, and is carried by what it stands on. It trips, slips and is knocked over
/// (see [`Surefootedness`]); then it is a body of ten limbs with the velocity it had, until it rests, gets up and does what
/// it was told last.
#[derive(Clone, Debug)]
pub struct Humanoid {
    config: HumanoidConfig,
    abilities: ActionSet,
    radius: f64,
    height: f64,
    mass: f64,
    state: BodyState,
    motion: Motion,
    plan: Plan,
}

/// What it found in a substep and does in the same; never saved.
#[derive(Clone, Debug, Default)]
struct Plan {
    /// Where the controller leads, world frame, m.
    way: Vector3,
    /// The part of that by which it is only put out of what shares its room, m: feet have no share in it.
    shifted: Vector3,
    /// What it stands on.
    stand: Stand,
    /// Why it loses its footing.
    upset: Option<FallCause>,
    /// What is in the way.
    pushes: Vec<Push>,
    /// What pushing and pulling asks of the ground, as an acceleration of its own mass, m/s².
    effort: Vector2,
    /// Mass of what it has in its hands, kg: the world says it anew every step.
    load: f64,
    /// What of the weight of things that it holds hangs on it, kg: they say it anew every substep.
    hung: f64,
    /// Whether it goes down, or up again.
    goes_low: Option<bool>,
    /// How its limbs lie while it is limp.
    limp: Option<JointAngles>,
    /// How far it has to be lifted out of the ground, m.
    lift: Option<f64>,
    /// Whether it walks by looks alone.
    strolls: bool,
    /// The share of its stride at which it told how it holds its limbs, last while it does; below zero for standing, and before.
    told: f64,
    /// What it has to tell at the end of the step: why it fell, and whether it stands again.
    fell: Option<FallCause>,
    got_up: bool,
}

/// What somebody stands on.
#[derive(Clone, Copy, Debug)]
struct Stand {
    /// The slope under the feet, unit length.
    normal: Vector3,
    /// Grip as tyres have it, as a share of that of dry asphalt.
    grip: f64,
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
    /// Where the soles are while it stands or gets up; what is seen of it may lie.
    feet: Point3,
    /// What it stands on, if that can move.
    support: Option<ColliderHandle>,
    crouch: Crouch,
    balance: Balance,
    pace: Pace,
    gait: Gait,
    /// How it fares since it fell.
    recovery: Recovery,
    /// What it goes by far from what is of interest.
    stroll: Stroll,
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
            mass: MASS,
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
                feet: Point3::origin(),
                support: None,
                crouch: Crouch::default(),
                balance: Balance::default(),
                pace: Pace::default(),
                gait: Gait::default(),
                recovery: Recovery::default(),
                stroll: Stroll::default(),
            },
            plan: Plan::default(),
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
        let mass = entity.info.mass.filter(|mass| (1.0..=1000.0).contains(mass)).unwrap_or(MASS);
        Ok(Self { abilities, radius: width * 0.5, height, mass, ..Self::new(*entity.pose, config)? })
    }

    /// What it is doing with the body as a whole.
    pub fn posture(&self) -> Posture {
        self.motion.posture
    }

    /// Whether there is ground under its feet.
    pub fn is_grounded(&self) -> bool {
        self.motion.grounded
    }

    /// How it fares on its feet.
    pub fn footing(&self) -> Footing {
        self.motion.recovery.footing()
    }

    /// What it gives a throw, J.
    pub(crate) fn throw_energy(&self) -> f64 {
        self.config.throw_energy
    }

    /// What is left of what it was told.
    pub(crate) fn orders(&self) -> Orders {
        let Motion { wanted_speed, step_left, turn_left, .. } = self.motion;
        Orders { speed: wanted_speed, step: step_left, step_speed: self.config.step_speed, turn: turn_left }
    }

    /// Notes how much of a step and a turn is left.
    pub(crate) fn set_orders(&mut self, orders: &Orders) {
        (self.motion.step_left, self.motion.turn_left) = (orders.step, orders.turn);
    }

    /// The middle of the soles of who stands.
    fn feet(&self) -> Point3 {
        self.motion.feet
    }

    fn build(&self) -> Build {
        Build { height: self.height, mass: self.mass }
    }

    fn stand_at(&mut self, pose: &Pose) {
        self.motion.yaw = yaw_of(pose);
        self.motion.feet = pose.translation.vector.into();
        self.state.pose = pose_facing(self.motion.feet, self.motion.yaw);
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

    /// Mass of what it has in its hands, kg, as of the last step, with what hangs on them of things that it
    /// [holds](crate::PhysicsDynamics::grasp): all of the mass where they hang free, nothing where they stand.
    pub fn load(&self) -> f64 {
        self.plan.load + self.plan.hung
    }

    /// The mass that its feet carry, kg.
    fn laden_mass(&self) -> f64 {
        self.mass + self.load()
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
        let Self { config, abilities, radius, height, mass, motion, .. } = self;
        postcard::to_allocvec(&("humanoid", config, abilities, [radius, height, mass], motion))
            .expect("plain numbers always serialise")
    }

    fn restore(&mut self, state: &BodyState, saved: &[u8]) -> bool {
        type Saved<'a> = (&'a str, HumanoidConfig, ActionSet, [f64; 3], Motion);
        match postcard::from_bytes::<Saved<'_>>(saved) {
            Ok(("humanoid", config, abilities, [radius, height, mass], motion))
                if config.validate().is_ok() =>
            {
                let plan = Plan::default();
                *self = Self { config, abilities, radius, height, mass, state: *state, motion, plan };
                true
            }
            _ => false,
        }
    }
}
