//! What the outside sees of a run, and how it stops one.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// Called with the number of finished steps and a word on the state.
pub type Progress = Box<dyn Fn(u64, &str) + Send>;

type Begin = Box<dyn Fn(&str, u64) -> Progress + Send + Sync>;

/// Shows progress and carries the wish to stop.
pub struct Watch {
    stop: Arc<AtomicBool>,
    begin: Begin,
}

impl Watch {
    /// A watch that asks `begin` for a display whenever a part of the run begins (its name, its steps).
    pub fn new(stop: Arc<AtomicBool>, begin: impl Fn(&str, u64) -> Progress + Send + Sync + 'static) -> Self {
        Self { stop, begin: Box::new(begin) }
    }

    /// A watch that shows nothing and never stops.
    pub fn silent() -> Self {
        Self::new(Arc::new(AtomicBool::new(false)), |_, _| Box::new(|_, _| {}))
    }

    /// Whether somebody asked to stop; the run then ends after its step.
    pub fn is_stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    pub(super) fn begin(&self, name: &str, steps: u64) -> Progress {
        (self.begin)(name, steps)
    }
}
