//! Threads that are lent to a traffic.

use std::sync::atomic::{AtomicUsize, Ordering};

use simworld_core::net::Workers;

/// So many threads, each of which takes the next part that nobody has.
pub(crate) struct Threads(pub(crate) usize);

impl Workers for Threads {
    fn run(&self, parts: usize, work: &(dyn Fn(usize) + Sync)) {
        let next = AtomicUsize::new(0);
        std::thread::scope(|scope| {
            for _ in 0..self.0 {
                scope.spawn(|| {
                    loop {
                        let part = next.fetch_add(1, Ordering::Relaxed);
                        if part >= parts {
                            break;
                        }
                        work(part);
                    }
                });
            }
        });
    }
}
