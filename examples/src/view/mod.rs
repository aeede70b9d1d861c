//! Looking on: a stage that moves, a camera that stands or follows, layers drawn over the picture, and films of it.

mod canvas;
mod film;
mod flight;
mod layers;
mod panes;
mod sight;
mod stage;
mod trails;
mod viewer;

pub use canvas::Canvas;
pub use film::{Film, FilmError};
pub use flight::Flight;
pub use layers::Layer;
pub use panes::Panes;
pub use stage::{Going, Stage};
pub use viewer::{Viewer, ViewerSettings};
