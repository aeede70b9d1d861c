//! How a humanoid takes the actions of the vocabulary.

use std::f64::consts::PI;

use simworld_core::action::{Action, ActionKind, StepDirection};
use simworld_core::geometry::Vector3;
use simworld_core::ops::wrap_angle;
use simworld_core::seam::{Embodiment, EmbodimentError};

use super::{Balance, Humanoid, Pace, Posture};

/// The longest single step, m.
const LONGEST_STEP: f64 = 10.0;

impl Humanoid {
    pub(super) fn take(&mut self, action: &Action) -> Result<(), EmbodimentError> {
        let kind = action.kind();
        match action {
            Action::MoveForward { speed } | Action::ChangeSpeed { speed } => {
                let speed = checked(kind, "speed", *speed, 0.0..=f64::MAX, "a finite number, not negative")?;
                self.on_the_move(kind)?;
                self.motion.wanted_speed = speed.min(self.top_speed());
                self.motion.step_left = Vector3::zeros();
            }
            Action::Step { direction, distance } => {
                let distance = checked(kind, "distance", *distance, 0.0..=LONGEST_STEP, "0 to 10 m")?;
                self.on_the_move(kind)?;
                let way = match direction {
                    StepDirection::Forward => Vector3::x(),
                    StepDirection::Backward => -Vector3::x(),
                    StepDirection::Left => Vector3::y(),
                    StepDirection::Right => -Vector3::y(),
                };
                self.halt();
                self.motion.step_left = way * distance;
            }
            Action::Rotate { angle } => {
                let angle = checked(kind, "angle", *angle, f64::MIN..=f64::MAX, "a finite angle")?;
                self.on_the_move(kind)?;
                self.motion.turn_left = if angle.abs() <= 2.0 * PI { angle } else { wrap_angle(angle) };
            }
            Action::Stop
            | Action::PickUp { .. }
            | Action::DropOff
            | Action::CarryHeavy { .. }
            | Action::PutDownHeavy
            | Action::OpenDoor { .. }
            | Action::CloseDoor { .. }
            | Action::Give { .. }
            | Action::Buy { .. } => self.halt(),
            Action::SitDown { .. } => self.assume(Posture::Seated),
            Action::EnterCar { .. } => self.assume(Posture::Aboard),
            Action::RideScooter { .. } => self.assume(Posture::Riding),
            Action::StandUp | Action::ExitCar | Action::GetOffScooter => {
                self.crouch(false);
                self.assume(Posture::Standing);
            }
            Action::Crouch => self.crouch(true),
            // Where it looks stands in the world, where others see it.
            Action::LookUp { angle } | Action::LookDown { angle } => {
                checked(kind, "angle", *angle, f64::MIN..=f64::MAX, "a finite angle")?;
            }
            Action::Focus { horizontal_fov } => {
                checked(kind, "horizontal_fov", *horizontal_fov, 0.01..=3.1, "0.01 to 3.1 rad")?;
            }
            Action::PointDirection { heading } => {
                checked(kind, "heading", *heading, f64::MIN..=f64::MAX, "a finite angle")?;
            }
            // What hands do with things the physics carries out; words and gestures move no limb that this body has.
            Action::Throw { .. }
            | Action::ThrowTo { .. }
            | Action::Grasp { .. }
            | Action::LetGo
            | Action::TakePhoto
            | Action::Converse { .. }
            | Action::WaveHand { .. }
            | Action::Argue { .. } => {}
            other => return Err(EmbodimentError::unsupported(other.kind(), self.supports())),
        }
        Ok(())
    }

    /// Comes to rest and changes posture.
    pub(super) fn assume(&mut self, posture: Posture) {
        if self.motion.posture == posture {
            return;
        }
        self.motion.posture = posture;
        self.motion.speed = 0.0;
        self.crouch(false);
        self.motion.balance = Balance::default();
        self.motion.pace = Pace::default();
        self.motion.support = None;
        self.halt();
    }

    /// Refuses locomotion while something else moves the body.
    fn on_the_move(&self, action: ActionKind) -> Result<(), EmbodimentError> {
        let reason = match self.motion.posture {
            Posture::Seated => "it is seated: stand up first",
            Posture::Aboard => "it is in a vehicle: get out first",
            Posture::Standing | Posture::Riding => return Ok(()),
        };
        Err(EmbodimentError::State { action, reason: reason.to_owned() })
    }
}

fn checked(
    action: ActionKind,
    field: &'static str,
    value: f64,
    range: std::ops::RangeInclusive<f64>,
    allowed: &'static str,
) -> Result<f64, EmbodimentError> {
    if range.contains(&value) {
        Ok(value)
    } else {
        Err(EmbodimentError::Argument { action, field, value, allowed })
    }
}
