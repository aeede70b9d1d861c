//! What it means to take a vehicle or a walker over: what may be asked of it, and why it may be refused.

use serde::{Deserialize, Serialize};
use simworld_core::geometry::{Point2, Vector2};
use simworld_core::id::EntityId;
use thiserror::Error;

use crate::Leg;

/// In which lane a vehicle is wanted that somebody else drives.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LaneWish {
    /// In the one where it is.
    #[default]
    Keep,
    /// In the next to the left, as soon as nobody is in the way.
    Left,
    /// In the next to the right.
    Right,
    /// Wherever the traffic's own driver would drive.
    AsDriven,
}

/// How somebody else drives a vehicle that stays on its lane.
///
/// ```
/// use simworld_traffic::{Drive, LaneWish};
/// let overtake = Drive { acceleration: 1.0, lane: LaneWish::Left, ..Drive::default() };
/// assert!(overtake.validate().is_ok());
/// assert!(Drive { acceleration: f64::NAN, ..overtake }.validate().is_err());
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Drive {
    /// Acceleration, m/s²; negative is braking. The vehicle gives what it can, and no more than keeps it behind who is ahead,
    /// before people on a crossing, and before a stop line that it has no leave to pass.
    pub acceleration: f64,
    /// The lane.
    pub lane: LaneWish,
    /// The leg to take at the end of this one, once; its route goes on from there, and is given up if that leads it no more to
    /// its end. With none it follows its route, or turns at random.
    pub next: Option<Leg>,
}

impl Drive {
    /// Checks that its acceleration is a number.
    ///
    /// # Errors
    /// It is not finite.
    pub fn validate(&self) -> Result<(), ControlError> {
        finite("acceleration", [self.acceleration])
    }
}

/// How somebody else walks a walker among the others.
///
/// Where it goes is said by [`Traffic::send_walker`](crate::Traffic::send_walker).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stroll {
    /// How fast it would walk alone, m/s, in [0, 3]; on a crossing nobody is slower than 1.25 m/s.
    pub speed: f64,
    /// How far to the right of the middle of its way it keeps, m; negative is to the left.
    pub keep_right: f64,
    /// Whether it crosses at red where there is a gap.
    pub dares: bool,
}

impl Stroll {
    /// Checks every field against its range.
    ///
    /// # Errors
    /// The first that is out of it.
    pub fn validate(&self) -> Result<(), ControlError> {
        finite("keep_right", [self.keep_right])?;
        if !(0.0..=3.0).contains(&self.speed) {
            return Err(ControlError::Range { field: "speed", value: self.speed, allowed: "0 to 3 m/s" });
        }
        Ok(())
    }
}

/// How a vehicle is driven, or a walker walks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Control<T> {
    /// By the traffic.
    Own,
    /// By somebody else, on its way.
    Guided(T),
    /// By somebody else, as a free body.
    Free,
}

/// Why something cannot be taken over, moved so, or given back; nothing has changed then.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ControlError {
    /// Nobody has the number.
    #[error("there is no {what} of number {id}: it may have left")]
    Nobody {
        /// A vehicle or a walker.
        what: &'static str,
        /// The number.
        id: u32,
    },
    /// No vehicle or walker has the entity.
    #[error(
        "{entity} is neither a vehicle nor a walker of the traffic as asked for: it may have left, or be another's"
    )]
    NoEntity {
        /// The entity.
        entity: EntityId,
    },
    /// It is not under that control.
    #[error("{what} {id} is not {wanted}: {mend}")]
    NotSo {
        /// A vehicle or a walker.
        what: &'static str,
        /// Its number.
        id: u32,
        /// How it would have to be.
        wanted: &'static str,
        /// What to do first.
        mend: &'static str,
    },
    /// A number that is infinite or not a number.
    #[error("{field} = {value} is not finite: give a finite number")]
    NotFinite {
        /// Which.
        field: &'static str,
        /// Its value.
        value: f64,
    },
    /// A number out of range.
    #[error("{field} = {value} is out of range: give {allowed}")]
    Range {
        /// Which.
        field: &'static str,
        /// Its value.
        value: f64,
        /// What is allowed, in words.
        allowed: &'static str,
    },
    /// The leg is none to which one can turn.
    #[error("vehicle {id} cannot take that leg next: {reason}")]
    Turn {
        /// Its number.
        id: u32,
        /// Why not.
        reason: &'static str,
    },
    /// No way leads where a vehicle is sent.
    #[error("vehicle {id} cannot be sent there: {reason}")]
    NoWay {
        /// Its number.
        id: u32,
        /// Why not.
        reason: &'static str,
    },
    /// The body cannot go back among the others from where it is.
    #[error("{what} {id} at ({x:.1}, {y:.1}) cannot be given back: {reason}", x = at.x, y = at.y)]
    NoPlace {
        /// A vehicle or a walker.
        what: &'static str,
        /// Its number.
        id: u32,
        /// Where it is, m.
        at: Point2,
        /// Why not, and what to do.
        reason: &'static str,
    },
}

/// Refuses what is not finite.
pub(crate) fn finite<const N: usize>(field: &'static str, values: [f64; N]) -> Result<(), ControlError> {
    match values.into_iter().find(|value| !value.is_finite()) {
        Some(value) => Err(ControlError::NotFinite { field, value }),
        None => Ok(()),
    }
}

/// The same for a place or a direction.
pub(crate) fn finite_in_plane(field: &'static str, at: Vector2) -> Result<(), ControlError> {
    finite(field, [at.x, at.y])
}
