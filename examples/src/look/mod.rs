//! What the example `look` does behind its command line: places worth a picture, the view from above, and the sheet.

mod above;
mod place;
mod sheet;

pub use above::{map_around, scan};
pub use place::{crowd, street};
pub use sheet::Sheet;
