//! One of several things that words may mean, as a policy took it.

use simworld_core::id::EntityId;

use crate::language::AmbiguityPolicy;

/// A thing that was taken where several fit and nothing said which.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Taken {
    /// What was looked for, in the words that leave it open.
    pub wanted: String,
    /// What was taken.
    pub thing: EntityId,
    /// What it is called.
    pub label: String,
    /// How many fit.
    pub of: usize,
    /// By which policy.
    pub policy: AmbiguityPolicy,
}

impl Taken {
    /// The choice in words: "of 3 that \"the bench\" may mean Bench (#4) was taken, the nearest".
    pub fn told(&self) -> String {
        let Self { wanted, thing, label, of, policy } = self;
        let how = match policy {
            AmbiguityPolicy::First => "the first",
            AmbiguityPolicy::Nearest => "the nearest",
            AmbiguityPolicy::Ask => "as asked",
        };
        format!("of {of} that {wanted:?} may mean {label} ({thing}) was taken, {how}")
    }
}
