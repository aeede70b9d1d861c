//! Traffic alone, watched: what the `traffic` example does.

mod pictures;
mod report;
mod watch;

pub use pictures::{Picture, pictures};
pub use report::report;
pub use watch::Watched;
