//! A scene that is edited by words, and how it looks before and after.

mod made;
mod plan;
mod relief;
mod sheet;
mod view;

pub use made::made_sheet;
pub use plan::Plan;
pub use sheet::contact_sheet;
pub use view::View;
