//! What the example `look` does behind its command line: places worth a picture, and the sheet.

mod place;
mod sheet;

pub use place::{crowd, street};
pub use sheet::Sheet;
