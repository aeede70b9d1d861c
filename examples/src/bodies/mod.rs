//! What bodies do: an obstacle course, its film, plots, and crowds whose cost is measured.

mod chart;
mod course;
mod film;
mod gait;
mod mujoco;
mod plain;
mod plots;
mod quarter;

pub use course::{Course, Embodiment, Outcome, PATIENCE, SECTIONS};
pub use film::{Film, FilmError};
pub use gait::gait_chart;
pub use mujoco::{Rival, mujoco_boxes};
pub use plain::{Loop, PlainWalkers, our_boxes, our_step, our_walkers, plain_boxes};
pub use plots::{Curve, braking_chart, energy_chart};
pub use quarter::{BUILDINGS, Crowd, Quarter, SOLIDS, Threads};
