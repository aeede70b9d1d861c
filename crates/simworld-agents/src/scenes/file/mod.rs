//! Hand-written scenes as files (feature `scene-files`): what stands where, to the centimetre, in a place that a generator makes or on
//! streets and ground of one's own, and what is said about it when it is there.
//!
//! `docs/scenes.md` has every key. [`SceneFile`] is the file as data: [`read`](SceneFile::read) from a file and [`save`](SceneFile::save)d
//! to one, or put together by a program. [`SceneFile::load`] makes the world of it. What is written is law: things are put where the file
//! says. What cannot be is refused all at once, with the file, the line, the row and how to mend it ([`SceneFileError::Refused`]); what
//! stands in something else, or in the air, stands there, and is told of ([`Loaded::problems`]).
//!
//! A thing is known by the exact name of its asset, and by no other words: a file means the same when the library grows. Words are for
//! the sentences of `[[say]]`.

mod aside;
mod check;
mod colour;
mod error;
mod facing;
mod inspect;
mod items;
mod load;
mod near;
mod numbers;
mod overlap;
mod place;
mod rows;
mod scene;
mod sky;
mod streets;

pub use aside::Aside;
pub use check::{FARTHEST, MOST_SAYS, MOST_THINGS};
pub use colour::Colour;
pub use error::{Fault, MOST_LISTED, Problem, Problems, SceneFileError, Where};
pub use facing::Facing;
pub use load::Loaded;
pub use numbers::{At, Pair};
pub use place::{NoPlaces, PlaceError, PlaceMaker};
pub use rows::{EmptyGround, Say, StreetRow, Thing};
pub use scene::{MOST_BYTES, Origin, SceneFile, VERSION};
pub use sky::{Date, Sky};
pub use streets::{MOST_POINTS, MOST_STREETS};
