//! A city from its source to its files: what the `city` example does.

mod export;
mod size;
mod source;

pub use export::{ExportError, Format, Interrupt, Written, export};
pub use size::{Size, SizeError};
pub use source::{Made, Source, SourceError, make};
