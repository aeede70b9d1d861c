//! A scene that is edited by words, and how it looks before and after.

mod plan;
mod view;

pub use plan::Plan;
pub use view::View;
