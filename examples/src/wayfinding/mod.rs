//! Learning to find a place in a generated block: the environment, a policy as a table, and pictures of how it learns.

mod chart;
mod env;
mod field;
mod learner;

pub use chart::{Run, curve_chart};
pub use env::{Wayfinding, WayfindingError};
pub use field::Field;
pub use learner::{Judged, Lesson, Many, Point, Policy, Table, judge, learn};
