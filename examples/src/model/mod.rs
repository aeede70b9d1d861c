//! What the example `model` is made of: a mill whose sails turn, a place to stand, and pictures of it.

mod mill;
mod show;

pub use mill::mill;
pub use show::{ShowError, Shown, show};
