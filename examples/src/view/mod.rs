//! Looking on: a stage that moves, a camera that stands, flies or follows, layers drawn over the picture; on films, and (feature
//! `window`) in a window.

mod canvas;
mod card;
mod controls;
mod film;
mod flight;
mod layers;
mod outlook;
mod panes;
mod sight;
mod stage;
mod trails;
#[cfg(feature = "mp4")]
mod video;
mod viewer;
#[cfg(feature = "window")]
mod window;

pub use canvas::Canvas;
pub use card::card;
pub use controls::{Controls, Input, Motion, Press, Wish};
pub use film::{Film, FilmError};
pub use flight::Flight;
pub use layers::Layer;
pub use outlook::Outlook;
pub use panes::Panes;
pub use stage::{Going, Stage};
pub use viewer::Viewer;
#[cfg(feature = "window")]
pub use window::{Shown, WindowError, show};
