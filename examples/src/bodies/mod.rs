//! What bodies do: an obstacle course, its film, plots, crowds whose cost is measured, and a gait beside that in another engine.

mod chart;
mod course;
mod film;
mod gait;
mod mujoco;
mod plain;
mod plots;
mod quarter;
mod trot;

pub use course::{Course, Embodiment, Outcome, PATIENCE, SECTIONS};
pub use film::{Film, FilmError};
pub use gait::gait_chart;
pub use mujoco::{Rival, mujoco_boxes};
pub use plain::{Loop, PlainWalkers, our_boxes, our_step, our_walkers, plain_boxes};
pub use plots::{Curve, braking_chart, energy_chart};
pub use quarter::{BUILDINGS, Crowd, Quarter, SOLIDS, Threads};
pub use trot::{Trot, mujoco_trot, our_trot};
