//! What bodies do: an obstacle course, its film, and plots.

mod chart;
mod course;
mod film;
mod gait;
mod plots;

pub use course::{Course, Embodiment, Outcome, PATIENCE, SECTIONS};
pub use film::{Film, FilmError};
pub use gait::gait_chart;
pub use plots::{Curve, braking_chart, energy_chart};
