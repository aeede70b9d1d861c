//! Work on the parts of a network, each by one thread at a time.

use std::array;
use std::sync::{Mutex, PoisonError};

use simworld_core::net::Workers;

use super::tracks::layout::MOST_PARTS;

/// Calls `work` once with each item and its number, on the threads of the workers, and returns when all are done. Asks nothing
/// of the heap for up to [`MOST_PARTS`] items; what is beyond is worked on here.
pub(super) fn each<T: Send>(workers: &dyn Workers, items: &mut [T], work: impl Fn(usize, &mut T) + Sync) {
    let count = items.len().min(MOST_PARTS);
    let mut rest = items.iter_mut();
    let cells: [Mutex<Option<&mut T>>; MOST_PARTS] = array::from_fn(|_| Mutex::new(rest.next()));
    let run = |index: usize| {
        let item = cells.get(index).and_then(|cell| {
            // No lock is held while anything can panic, so a poisoned one holds nothing broken.
            cell.lock().unwrap_or_else(PoisonError::into_inner).take()
        });
        if let Some(item) = item {
            work(index, item);
        }
    };
    workers.run(count, &run);
    // A part that was left out is done here: the result does not depend on the workers.
    (0..count).for_each(run);
    for (index, item) in rest.enumerate() {
        work(MOST_PARTS + index, item);
    }
}

#[cfg(test)]
mod tests {
    use simworld_core::net::Alone;

    use super::*;

    /// Leaves out every third part and does others twice.
    struct Careless;

    impl Workers for Careless {
        fn run(&self, parts: usize, work: &(dyn Fn(usize) + Sync)) {
            for part in (0..parts + 5).filter(|part| !part.is_multiple_of(3)) {
                work(part);
                work(part);
            }
        }
    }

    #[test]
    fn every_item_is_worked_on_once() {
        for count in [0, 1, 100, MOST_PARTS, MOST_PARTS + 7] {
            for workers in [&Alone as &dyn Workers, &Careless] {
                let mut items = vec![0; count];
                each(workers, &mut items, |index, item| *item += index + 1);
                assert!(items.iter().enumerate().all(|(index, item)| *item == index + 1), "{count}");
            }
        }
    }
}
