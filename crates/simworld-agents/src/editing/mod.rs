//! Scenes edited by words: "add a red sports car next to the hospital near a museum".
//!
//! [`SceneEditor::say`] reads a sentence, works out what its words mean in the scene, finds a place where each new thing may
//! stand, and changes the world by [`Command`](simworld_core::command::Command)s: all of the sentence, or nothing. Typed
//! [`Edit`]s do the same without words. Every edit can be taken back and done again, and says why it stands where it stands
//! ([`SceneEditor::last_placings`]).
//!
//! What a relation means is a test, [`Stand::holds`]; the solver draws places from its region and throws out what collides,
//! blocks a door, stands in traffic, or leaves too little of a sidewalk. So are turns, sizes and swaps that would do so, unless it was so
//! before. Of what is left it takes the best ground ([`LandFit`]): vehicles on parking strips and at kerbs, trees on soil; what stands elsewhere
//! for want of it is told ([`Astray`]). What stands on a thing goes along with it, or is set down where it is gone. [`faults`] and
//! [`Difference`] judge the result from outside.

mod anchors;
mod apply;
mod astray;
mod borne;
mod carry;
mod check;
mod describe;
mod edit;
mod editable;
mod editor;
mod error;
mod floor;
mod history;
mod land;
mod made;
mod parking;
mod place;
mod placing;
mod reader;
mod relax;
mod rest;
mod row;
mod sample;
mod solid;
mod stand;
mod stay;
mod stock;
mod suits;
mod surfaces;
mod taken;
mod tracks;
mod workshop;

pub use apply::Edited;
#[cfg(feature = "scene-files")]
pub(crate) use apply::recipe_of;
pub use astray::Astray;
#[cfg(feature = "scene-files")]
pub(crate) use check::SUPPORT_GAP;
pub use check::{Difference, Fault, faults};
pub(crate) use describe::called;
#[cfg(feature = "thought")]
pub(crate) use describe::made_as;
pub use edit::{Edit, Line, Make, Sides, Spacing, Stand};
pub use editable::Editable;
pub use editor::SceneEditor;
pub use error::EditError;
pub use land::{Land, LandFit};
#[cfg(feature = "thought")]
pub(crate) use made::nth_made;
#[cfg(feature = "scene-files")]
pub(crate) use place::{is_surface, land_under};
pub use placing::{Candidate, Outcome, Placing};
pub use reader::{Asked, EditReader, ReadBy};
pub use relax::Relaxed;
pub(crate) use rest::has_flat_top;
pub(crate) use stock::Stock;
#[cfg(feature = "scene-files")]
pub(crate) use stock::called_in;
pub use taken::Taken;
