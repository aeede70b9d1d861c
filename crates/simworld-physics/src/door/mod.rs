//! A door on its hinge: a leaf that swings under what pushes it, is opened and closed at its handle, and latches.
//!
//! Angles are radians from the closed leaf, positive counterclockwise seen from above; lengths are m.

mod physics_body;

use nalgebra::UnitQuaternion;
use rapier3d_f64::prelude::RigidBodyHandle;
use serde::{Deserialize, Serialize};
use simworld_core::action::{Action, ActionSet};
use simworld_core::geometry::{Point3, Pose, Vector3};
use simworld_core::id::EntityId;
use simworld_core::ops;
use simworld_core::scene::{EntityRef, Shape};
use simworld_core::seam::{BodyState, Embodiment, EmbodimentError};

use crate::error::{PhysicsError, check_range};

/// Mass of a leaf that says nothing of it, kg/m²: a solid wooden one of 4 cm.
const AREA_DENSITY: f64 = 20.0;
/// The handle is so far from the free edge, m.
const BACKSET: f64 = 0.07;

/// Which edge of the leaf is hung, seen along the way that its thinner side faces (x, or y if that is thinner).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum HingeSide {
    /// The one on the left.
    #[default]
    Left,
    /// The one on the right.
    Right,
}

/// What holds a door closed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Latch {
    /// A latch, which the handle draws: nobody pushes it open.
    #[default]
    Handle,
    /// Nothing: a swing door.
    Nothing,
}

/// How a door hangs and moves.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct DoorConfig {
    /// Which edge is hung.
    pub hinge: HingeSide,
    /// How far it swings, from and to, radians, -3.1 to 0 and 0 to 3.1. The hand opens it to the farther end.
    pub swing: [f64; 2],
    /// What holds it closed.
    pub latch: Latch,
    /// Stiffness of the spring that closes it, N m/rad, 0 to 200; 0 is none.
    pub closer: f64,
    /// What brakes it, N m s/rad, 0 to 500.
    pub damping: f64,
    /// The force of the hand at the handle, N, 1 to 200. Doors that anybody is to open take at most 22 N (ADA standards 404.2.9).
    pub hand: f64,
    /// How long the hand holds it open, s, 0 to 600.
    pub hold: f64,
}

impl Default for DoorConfig {
    fn default() -> Self {
        Self {
            hinge: HingeSide::Left,
            swing: [0.0, 1.5],
            latch: Latch::Handle,
            closer: 0.0,
            damping: 1.0,
            hand: 22.0,
            hold: 4.0,
        }
    }
}

impl DoorConfig {
    /// Checks every field.
    ///
    /// # Errors
    /// The first field out of range, with what is allowed.
    pub fn validate(&self) -> Result<(), PhysicsError> {
        let check = |field, value, range, allowed| check_range("DoorConfig", field, value, range, allowed);
        check("swing", self.swing[0], -3.1..=0.0, "-3.1 to 0 rad, then 0 to 3.1")?;
        check("swing", self.swing[1], 0.0..=3.1, "-3.1 to 0 rad, then 0 to 3.1")?;
        check("closer", self.closer, 0.0..=200.0, "0 to 200 N m/rad")?;
        check("damping", self.damping, 0.0..=500.0, "0 to 500 N m s/rad")?;
        check("hand", self.hand, 1.0..=200.0, "1 to 200 N")?;
        check("hold", self.hold, 0.0..=600.0, "0 to 600 s")
    }

    /// The end to which the hand opens it.
    fn open_end(&self) -> f64 {
        let [low, high] = self.swing;
        if -low > high { low } else { high }
    }

    /// Where the handle of a leaf is, in its frame, m: to be the entity's access point, so that it is opened from there.
    pub fn handle(&self, leaf: &Shape) -> Point3 {
        let leaf = Leaf::of(leaf, self.hinge);
        let place = leaf.across * (leaf.width * 0.5 - BACKSET) * leaf.free;
        Point3::new(place.x, place.y, (leaf.height * 0.5).min(1.05))
    }
}

/// The leaf, in its own frame.
#[derive(Clone, Copy, Debug)]
struct Leaf {
    width: f64,
    thickness: f64,
    height: f64,
    /// Along the wider side.
    across: Vector3,
    /// On which end of that the free edge is, 1 or -1.
    free: f64,
}

impl Leaf {
    fn of(shape: &Shape, hinge: HingeSide) -> Self {
        let size = shape.size();
        // Seen along x, y points to the left; seen along y, x points to the right.
        let (width, thickness, across, left) = if size.x <= size.y {
            (size.y, size.x, Vector3::y(), 1.0)
        } else {
            (size.x, size.y, Vector3::x(), -1.0)
        };
        let free = match hinge {
            HingeSide::Left => -left,
            HingeSide::Right => left,
        };
        Self { width, thickness, height: size.z, across, free }
    }

    /// The foot of the hinge.
    fn hinge(&self) -> Vector3 {
        self.across * (-self.free * 0.5 * self.width)
    }

    /// Moment of inertia about the hinge, kg m².
    fn inertia(&self, mass: f64) -> f64 {
        mass * (self.width * self.width / 3.0 + self.thickness * self.thickness / 12.0)
    }
}

/// A door under the laws of mechanics, made by [`PhysicsDynamics::add_door`](crate::PhysicsDynamics::add_door).
///
/// The pose of the entity is that of the leaf, and swings with it. `OpenDoor` and `CloseDoor` of whoever is at the handle set the
/// entity's attribute `open`; the door sees that, and the hand swings the leaf, with no more than its force, and holds it open for
/// a while. A door that closes by itself, or is pushed to, latches, and says so in the attribute.
#[derive(Clone, Debug)]
pub struct Door {
    config: DoorConfig,
    shape: Shape,
    mass: f64,
    id: Option<EntityId>,
    state: BodyState,
    /// Where the leaf is when it is closed.
    closed: Pose,
    motion: Motion,
}

/// Everything about a door that changes and is not in its [`BodyState`].
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Motion {
    /// What it hangs on, in the engine; none while it was just put somewhere.
    post: Vec<RigidBodyHandle>,
    angle: f64,
    speed: f64,
    /// Whether the latch holds it.
    latched: bool,
    /// Whether the world says that it is open, as it was seen last.
    is_open: bool,
    hand: Option<Hand>,
    /// Whether it closed by itself, which the world does not know yet.
    fell_shut: bool,
}

/// A hand at the handle.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Hand {
    /// Where it takes the leaf to.
    to: f64,
    /// For how long it has done so, s.
    since: f64,
}

impl Door {
    /// A closed door at the pose of an entity, of its shape and mass.
    ///
    /// # Errors
    /// A setting out of range, or a shape that is no leaf.
    pub fn of(entity: &EntityRef<'_>, config: DoorConfig) -> Result<Self, PhysicsError> {
        config.validate()?;
        let shape = entity.info.shape;
        let leaf = Leaf::of(&shape, config.hinge);
        if !matches!(shape, Shape::Box { .. }) || leaf.thickness > 0.5 * leaf.width {
            let reason = "give a box at most half as thick as it is wide".to_owned();
            return Err(PhysicsError::Shape { id: entity.id, body: "door", reason });
        }
        let own = entity.info.mass.filter(|mass| mass.is_finite() && *mass > 0.0);
        let mass = own.unwrap_or(AREA_DENSITY * leaf.width * leaf.height);
        let state = BodyState { pose: *entity.pose, twist: *entity.twist };
        let latched = config.latch == Latch::Handle;
        let motion = Motion { latched, ..Motion::default() };
        Ok(Self { config, shape, mass, id: None, state, closed: state.pose, motion })
    }

    /// How far it is open, radians.
    pub fn angle(&self) -> f64 {
        self.motion.angle
    }

    /// How fast it swings, rad/s.
    pub fn speed(&self) -> f64 {
        self.motion.speed
    }

    /// Whether the latch holds it.
    pub fn is_latched(&self) -> bool {
        self.motion.latched
    }

    /// Moment of inertia of the leaf about its hinge, kg m².
    pub fn inertia(&self) -> f64 {
        self.leaf().inertia(self.mass)
    }

    fn leaf(&self) -> Leaf {
        Leaf::of(&self.shape, self.config.hinge)
    }

    /// Where the leaf is at an angle.
    fn pose_at(&self, angle: f64) -> Pose {
        let (sin, cos) = ops::sin_cos(angle * 0.5);
        let turn = UnitQuaternion::new_unchecked(nalgebra::Quaternion::new(cos, 0.0, 0.0, sin));
        let hinge = self.leaf().hinge();
        let turned = Pose::from_parts((hinge - turn * hinge).into(), turn);
        self.closed * turned
    }

    /// The angle of the leaf at a pose.
    fn angle_of(&self, pose: &Pose) -> f64 {
        let turn = self.closed.rotation.inverse() * pose.rotation;
        let ahead = turn * Vector3::x();
        ops::atan2(ahead.y, ahead.x)
    }

    /// The torque of the hand, of the closer and of what brakes, N m.
    fn torque(&mut self, dt: f64) -> f64 {
        /// How fast a hand swings a leaf, rad/s, and how it slows down towards the end, 1/s.
        const PACE: [f64; 2] = [1.2, 3.0];
        /// How fast the hand makes good a speed that is missing, 1/s.
        const FIRM: f64 = 8.0;
        const THERE: f64 = 0.03;
        let inertia = self.inertia();
        let Motion { angle, speed, .. } = self.motion;
        // An explicit brake must not turn the motion round within a substep.
        let damping = self.config.damping.min(0.5 * inertia / dt);
        let own = -self.config.closer * angle - damping * speed;
        let most = self.config.hand * (self.leaf().width - BACKSET);
        let Some(hand) = &mut self.motion.hand else { return own };
        hand.since += dt;
        let missing = hand.to - angle;
        let is_done = if hand.to == 0.0 { missing.abs() < THERE } else { hand.since > self.config.hold };
        let wanted = (PACE[1] * missing).clamp(-PACE[0], PACE[0]);
        let given = (inertia * FIRM * (wanted - speed) - own).clamp(-most, most);
        if is_done || hand.since > self.config.hold + 10.0 {
            self.motion.hand = None;
        }
        own + given
    }

    /// Whether the latch falls in now.
    fn latches(&self) -> bool {
        const CLOSE: [f64; 2] = [0.03, 1.5];
        let is_opened = self.motion.hand.is_some_and(|hand| hand.to != 0.0);
        self.config.latch == Latch::Handle
            && !is_opened
            && self.motion.angle.abs() < CLOSE[0]
            && self.motion.speed.abs() < CLOSE[1]
    }
}

impl Embodiment for Door {
    fn supports(&self) -> ActionSet {
        ActionSet::NONE
    }

    fn apply(&mut self, action: &Action) -> Result<(), EmbodimentError> {
        let supported = "swing: whoever is at its handle opens and closes it".to_owned();
        Err(EmbodimentError::Unsupported { action: action.kind(), supported })
    }

    fn state(&self) -> BodyState {
        self.state
    }

    fn save(&self) -> Vec<u8> {
        let Self { config, mass, id, closed, motion, .. } = self;
        postcard::to_allocvec(&("door", config, mass, id, closed, motion))
            .expect("plain numbers always serialise")
    }

    fn restore(&mut self, state: &BodyState, saved: &[u8]) -> bool {
        type Saved<'a> = (&'a str, DoorConfig, f64, Option<EntityId>, Pose, Motion);
        match postcard::from_bytes::<Saved<'_>>(saved) {
            Ok(("door", config, mass, id, closed, motion)) if config.validate().is_ok() => {
                (self.config, self.mass, self.id, self.closed, self.motion) =
                    (config, mass, id, closed, motion);
                self.state = *state;
                true
            }
            _ => false,
        }
    }
}
