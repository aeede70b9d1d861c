//! Somebody in a city who does what one says: the city, its traffic, bodies, and the run of one plan after another.

mod pictures;
mod stage;
mod tally;
mod tell;

pub use pictures::Pictures;
pub use stage::{Stage, StageError};
pub use tally::Tally;
pub use tell::{step_in_words, steps_in_words};
