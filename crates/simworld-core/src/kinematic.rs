//! Bodies without physics: a point that walks where it is told, and a vehicle on wheels that do not slip. For light use, tests
//! and crowds.

mod vehicle;

use std::collections::BTreeMap;

use crate::action::{Action, ActionKind, ActionSet, StepDirection};
use crate::event::EventKind;
use crate::geometry::{Pose, Twist, Vector3, direction, pose_facing, yaw_of};
use crate::hash::StateHasher;
use crate::id::EntityId;
use crate::ops::wrap_angle;
use crate::scene::{Scene, World, WorldError};
use crate::seam::{BodyState, Dynamics, DynamicsError, Embodiment, EmbodimentError};

pub use self::vehicle::KinematicVehicle;

/// A point that moves forward at a speed and turns at once; it passes through walls.
#[derive(Clone, Debug, PartialEq)]
pub struct KinematicBody {
    state: BodyState,
    speed: f64,
    max_speed: f64,
    step: Vector3,
}

impl KinematicBody {
    /// A walker, up to 2.5 m/s.
    pub fn walker(pose: Pose) -> Self {
        Self::with_max_speed(pose, 2.5)
    }

    /// A body that moves at most `max_speed` m/s.
    pub fn with_max_speed(pose: Pose, max_speed: f64) -> Self {
        Self { state: BodyState { pose, twist: Twist::ZERO }, speed: 0.0, max_speed, step: Vector3::zeros() }
    }

    fn checked(&self, action: ActionKind, field: &'static str, value: f64) -> Result<f64, EmbodimentError> {
        if value.is_finite() && value >= 0.0 {
            Ok(value.min(self.max_speed))
        } else {
            Err(EmbodimentError::Argument { action, field, value, allowed: "a finite number, not negative" })
        }
    }
}

impl Embodiment for KinematicBody {
    fn supports(&self) -> ActionSet {
        use ActionKind::{ChangeSpeed, MoveForward, Rotate, Step, Stop};
        ActionSet::of(&[MoveForward, Step, Rotate, ChangeSpeed, Stop])
    }

    fn apply(&mut self, action: &Action) -> Result<(), EmbodimentError> {
        match action {
            Action::MoveForward { speed } | Action::ChangeSpeed { speed } => {
                self.speed = self.checked(action.kind(), "speed", *speed)?;
            }
            Action::Step { direction, distance } => {
                let distance = self.checked(ActionKind::Step, "distance", *distance)?;
                let way = match direction {
                    StepDirection::Forward => Vector3::x(),
                    StepDirection::Backward => -Vector3::x(),
                    StepDirection::Left => Vector3::y(),
                    StepDirection::Right => -Vector3::y(),
                };
                self.speed = 0.0;
                self.step = way * distance;
            }
            Action::Rotate { angle } if angle.is_finite() => {
                let yaw = wrap_angle(yaw_of(&self.state.pose) + angle);
                self.state.pose = pose_facing(self.state.pose.translation.vector.into(), yaw);
            }
            Action::Rotate { angle } => {
                let (action, allowed) = (ActionKind::Rotate, "a finite angle");
                return Err(EmbodimentError::Argument { action, field: "angle", value: *angle, allowed });
            }
            Action::Stop => self.speed = 0.0,
            other => return Err(EmbodimentError::unsupported(other.kind(), self.supports())),
        }
        Ok(())
    }

    fn state(&self) -> BodyState {
        self.state
    }

    fn advance(&mut self, dt: f64) {
        let ahead = direction(yaw_of(&self.state.pose)) * self.speed * dt;
        let side_step = self.state.pose.rotation * std::mem::take(&mut self.step);
        let moved = Vector3::new(ahead.x, ahead.y, 0.0) + side_step;
        self.state.pose.translation.vector += moved;
        self.state.twist.linear = moved / dt;
    }

    fn save(&self) -> Vec<u8> {
        [self.speed, self.max_speed].iter().chain(self.step.iter()).flat_map(|x| x.to_le_bytes()).collect()
    }

    fn restore(&mut self, state: &BodyState, saved: &[u8]) -> bool {
        let numbers = numbers(saved);
        let [speed, max_speed, x, y, z] = numbers[..] else { return false };
        *self = Self { state: *state, speed, max_speed, step: Vector3::new(x, y, z) };
        true
    }
}

/// Moves bodies that move themselves: any [`Embodiment`] with its own [`advance`](Embodiment::advance).
///
/// A body that was moved from outside goes on from where it was put, if it can be restored; one that hangs on a
/// carrier rests.
#[derive(Default)]
pub struct KinematicDynamics {
    bodies: BTreeMap<EntityId, Box<dyn Embodiment>>,
}

impl KinematicDynamics {
    /// Without bodies.
    pub fn new() -> Self {
        Self::default()
    }

    /// Gives an entity a body; an earlier one is returned.
    pub fn insert(&mut self, id: EntityId, body: Box<dyn Embodiment>) -> Option<Box<dyn Embodiment>> {
        self.bodies.insert(id, body)
    }

    /// Takes up where bodies were put since the last step, before any of them acts.
    fn follow(&mut self, world: &World) {
        for (id, body) in &mut self.bodies {
            let Some(entity) = world.entity(*id) else { continue };
            let found = BodyState { pose: *entity.pose, twist: *entity.twist };
            if found != body.state() {
                let saved = body.save();
                body.restore(&found, &saved);
            }
        }
    }
}

impl Dynamics for KinematicDynamics {
    fn step(&mut self, world: &mut World, dt: f64) -> Result<(), DynamicsError> {
        self.bodies.retain(|id, _| world.entity(*id).is_some());
        self.follow(world);
        let mut failures = Vec::new();
        for (who, action) in world.actuations() {
            if let Some(body) = self.bodies.get_mut(who)
                && let Err(error) = body.apply(action)
                && body.supports().contains(action.kind())
            {
                let (action, reason) = (action.kind(), error.to_string());
                failures.push(EventKind::ActionFailed { who: *who, action, reason });
            }
        }
        for failure in failures {
            world.emit(failure);
        }
        for (id, body) in &mut self.bodies {
            let Some(entity) = world.entity(*id) else { continue };
            if entity.attachment.is_some() {
                continue; // its carrier moves it
            }
            body.advance(dt);
            let BodyState { pose, twist } = body.state();
            world.set_motion(*id, pose, twist)?;
        }
        Ok(())
    }

    fn save(&self) -> Result<Vec<u8>, DynamicsError> {
        let mut bytes = Vec::new();
        for (id, body) in &self.bodies {
            let saved = body.save();
            bytes.extend(u64::from(*id).to_le_bytes());
            bytes.extend((saved.len() as u64).to_le_bytes());
            bytes.extend(saved);
        }
        Ok(bytes)
    }

    fn restore(&mut self, world: &World, saved: &[u8]) -> Result<(), DynamicsError> {
        let damaged = || DynamicsError::Saved("the list of kinematic bodies is cut short".to_owned());
        let mut rest = saved;
        let mut present = Vec::new();
        while !rest.is_empty() {
            let id = EntityId::from(take_u64(&mut rest).ok_or_else(damaged)?);
            let length = take_u64(&mut rest).ok_or_else(damaged)? as usize;
            let (body_bytes, left) = rest.split_at_checked(length).ok_or_else(damaged)?;
            rest = left;
            let entity = world.entity(id).ok_or(WorldError::Missing { id })?;
            let body = self.bodies.get_mut(&id).ok_or_else(|| {
                DynamicsError::Saved(format!("{id} has no body here: insert one before restoring"))
            })?;
            if !body.restore(&BodyState { pose: *entity.pose, twist: *entity.twist }, body_bytes) {
                return Err(DynamicsError::Saved(format!("the body of {id} is of another kind")));
            }
            present.push(id);
        }
        self.bodies.retain(|id, _| present.binary_search(id).is_ok());
        Ok(())
    }

    fn state_hash(&self, hasher: &mut StateHasher) {
        for (id, body) in &self.bodies {
            hasher.u64((*id).into()).bytes(&body.save());
        }
    }
}

/// The numbers of which so many bytes are made.
fn numbers(saved: &[u8]) -> Vec<f64> {
    let (chunks, _) = saved.as_chunks::<8>();
    chunks.iter().map(|chunk| f64::from_le_bytes(*chunk)).collect()
}

fn take_u64(bytes: &mut &[u8]) -> Option<u64> {
    let (head, rest) = bytes.split_first_chunk::<8>()?;
    *bytes = rest;
    Some(u64::from_le_bytes(*head))
}
