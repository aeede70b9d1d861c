//! Many minds in one city: what the figures of minds are measured on.

mod crowd;
mod talk;

pub use crowd::{Bodies, Crowd, CrowdError, Promenade, Spent};
pub use talk::{Dawdler, SENTENCES, Speaker};
