//! A city from its source to its files: what the `city` example does.

mod export;
mod extract;
mod size;
mod source;

pub use export::{ExportError, Format, Interrupt, Written, export};
pub use extract::as_extract;
pub use size::{Size, SizeError};
pub use source::{Made, Source, SourceError, make};
