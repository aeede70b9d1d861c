//! Scenes edited by words: "add a red sports car next to the hospital near a museum".
//!
//! [`SceneEditor::say`] reads a sentence, works out what its words mean in the scene, finds a place where each new thing may
//! stand, and changes the world by [`Command`](simworld_core::command::Command)s: all of the sentence, or nothing. Typed
//! [`Edit`]s do the same without words. Every edit can be taken back and done again, and says why it stands where it stands
//! ([`SceneEditor::last_placings`]).
//!
//! What a relation means is a test, [`Stand::holds`]; the solver draws places from its region and throws out what collides,
//! blocks a door, stands in traffic, or leaves too little of a sidewalk. Of what is left it takes the best ground ([`LandFit`]): vehicles
//! on parking strips and at kerbs, trees on soil; what stands elsewhere for want of it is told ([`Astray`]). [`faults`] and
//! [`Difference`] judge the result from outside.

mod apply;
mod astray;
mod check;
mod describe;
mod edit;
mod editable;
mod editor;
mod error;
mod history;
mod land;
mod parking;
mod place;
mod placing;
mod reader;
mod relax;
mod row;
mod sample;
mod solid;
mod stand;
mod stock;
mod suits;
mod surfaces;
mod taken;
mod workshop;

pub use apply::Edited;
pub use astray::Astray;
pub use check::{Difference, Fault, faults};
pub use edit::{Edit, Line, Make, Sides, Spacing, Stand};
pub use editable::Editable;
pub use editor::SceneEditor;
pub use error::EditError;
pub use land::{Land, LandFit};
pub(crate) use place::has_flat_top;
pub use placing::{Candidate, Outcome, Placing};
pub use reader::{Asked, EditReader, ReadBy};
pub use relax::Relaxed;
pub(crate) use stock::Stock;
pub use taken::Taken;
