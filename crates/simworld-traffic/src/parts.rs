//! A slice in parts, each worked on by one of the threads that are lent.

use std::array;
use std::mem;
use std::sync::{Mutex, PoisonError};

use simworld_core::net::Workers;

/// At most so many parts: enough for eight threads to end together, and so few that they need no memory from the heap.
pub(crate) const PARTS: usize = 64;
/// Fewer items than this are not worth a part of their own.
const LEAST: usize = 64;

/// How many items are in each part of so many; the last may have fewer.
fn size(count: usize) -> usize {
    count.div_ceil(PARTS).max(LEAST)
}

/// Works on all parts: `work` gets the number of the part, that of its first item, and its items.
///
/// A part that the workers leave out is done here, and none is done twice, so what comes of it depends on the work alone.
pub(crate) fn in_parts<T: Send>(
    workers: &dyn Workers,
    items: &mut [T],
    work: &(impl Fn(usize, usize, &mut [T]) + Sync),
) {
    let size = size(items.len());
    let parts = items.len().div_ceil(size);
    let mut rest = items;
    let slots: [Mutex<&mut [T]>; PARTS] = array::from_fn(|_| {
        let count = size.min(rest.len());
        let (part, others) = mem::take(&mut rest).split_at_mut(count);
        rest = others;
        Mutex::new(part)
    });
    let take = |part: usize| {
        let Some(slot) = slots.get(part) else { return };
        let items = mem::take(&mut *slot.lock().unwrap_or_else(PoisonError::into_inner));
        if !items.is_empty() {
            work(part, part * size, items);
        }
    };
    workers.run(parts, &take);
    (0..parts).for_each(take);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Works backwards, on some parts twice, on others not at all, and on one too many.
    struct Careless;

    impl Workers for Careless {
        fn run(&self, parts: usize, work: &(dyn Fn(usize) + Sync)) {
            (0..=parts).rev().filter(|part| part % 3 != 1).for_each(work);
            (0..parts).step_by(4).for_each(work);
        }
    }

    #[test]
    fn every_item_has_its_turn_once() {
        for count in [0, 1, 63, 64, 65, 4096, 10_007] {
            let mut items = vec![0_usize; count];
            in_parts(&Careless, &mut items, &|_, first, items| {
                for (rank, item) in items.iter_mut().enumerate() {
                    *item += first + rank + 1;
                }
            });
            assert!(items.iter().enumerate().all(|(index, item)| *item == index + 1), "{count} items");
        }
    }
}
