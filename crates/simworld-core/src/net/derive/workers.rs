//! Work that falls into parts, and who does it: core starts no threads, but takes those that are lent.

use std::sync::{Mutex, OnceLock};

/// So many streets or intersections are a part of the work.
pub(super) const PART: usize = 256;

/// Who works on the parts of something.
///
/// ```
/// use simworld_core::net::{Alone, NetworkConfig, RoadNetwork, StreetPlan, Workers};
/// /// Two threads that take every other part.
/// struct Two;
/// impl Workers for Two {
///     fn run(&self, parts: usize, work: &(dyn Fn(usize) + Sync)) {
///         std::thread::scope(|scope| {
///             for first in 0..2 {
///                 scope.spawn(move || (first..parts).step_by(2).for_each(work));
///             }
///         });
///     }
/// }
/// let (plan, config) = (StreetPlan::grid(5, 4, 100.0), NetworkConfig::default());
/// assert_eq!(RoadNetwork::derive_with(&plan, &config, &Two)?, RoadNetwork::derive_with(&plan, &config, &Alone)?);
/// # Ok::<(), simworld_core::net::NetworkError>(())
/// ```
pub trait Workers {
    /// Calls `work` with each number below `parts`, in any order and on any threads, and returns when all are done.
    fn run(&self, parts: usize, work: &(dyn Fn(usize) + Sync));
}

/// The thread that asks: one part after another.
#[derive(Clone, Copy, Debug, Default)]
pub struct Alone;

impl Workers for Alone {
    fn run(&self, parts: usize, work: &(dyn Fn(usize) + Sync)) {
        (0..parts).for_each(work);
    }
}

/// What is made of each part, in their order, whoever works in whatever order.
pub(super) fn collect<T: Send + Sync>(
    workers: &dyn Workers,
    parts: usize,
    make: impl Fn(usize) -> T + Sync,
) -> Vec<T> {
    let slots: Vec<OnceLock<T>> = (0..parts).map(|_| OnceLock::new()).collect();
    workers.run(parts, &|part| {
        if let Some(slot) = slots.get(part) {
            slot.get_or_init(|| make(part));
        }
    });
    // A part that was left out is made here: the result does not depend on the workers.
    slots
        .into_iter()
        .enumerate()
        .map(|(part, slot)| slot.into_inner().unwrap_or_else(|| make(part)))
        .collect()
}

/// Has some things worked on, each once, whoever works in whatever order.
pub(super) fn hand_out<T: Send>(
    workers: &dyn Workers,
    things: impl Iterator<Item = T>,
    work: impl Fn(T) + Sync,
) {
    let slots: Vec<Mutex<Option<T>>> = things.map(|thing| Mutex::new(Some(thing))).collect();
    let take_up = |slot: &Mutex<Option<T>>| {
        let thing = slot.lock().ok().and_then(|mut slot| slot.take());
        if let Some(thing) = thing {
            work(thing);
        }
    };
    workers.run(slots.len(), &|part| slots.get(part).into_iter().for_each(take_up));
    // What was left out is done here.
    slots.iter().for_each(take_up);
}

/// What is made of each number below `count`, in their order, whoever works in whatever order.
pub(super) fn each<T: Send + Sync>(
    workers: &dyn Workers,
    count: usize,
    make: impl Fn(usize) -> T + Sync,
) -> Vec<T> {
    let parts = collect(workers, count.div_ceil(PART), |part| -> Vec<T> {
        (part * PART..count.min((part + 1) * PART)).map(&make).collect()
    });
    let mut all = Vec::new();
    for part in parts {
        take_over(&mut all, part, count);
    }
    all
}

/// Adds a part to what is to be so many things. The first part stays where it is: small plans have no other.
pub(super) fn take_over<T>(all: &mut Vec<T>, mut part: Vec<T>, count: usize) {
    if all.is_empty() {
        *all = part;
        all.reserve_exact(count - all.len());
    } else {
        all.append(&mut part);
    }
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
    fn parts_come_in_their_order_from_any_workers() {
        let made = |workers: &dyn Workers| collect(workers, 20, |part| part * part);
        let expected: Vec<usize> = (0..20).map(|part| part * part).collect();
        assert_eq!(made(&Alone), expected);
        assert_eq!(made(&Careless), expected);
    }

    #[test]
    fn each_thing_is_worked_on_once() {
        let mut numbers: Vec<usize> = (0..20).collect();
        hand_out(&Careless, numbers.iter_mut(), |number| *number += 100);
        assert!((100..120).eq(numbers));
    }

    #[test]
    fn each_number_is_worked_on_in_its_place() {
        for count in [0, 1, PART, 5 * PART + 3] {
            let expected: Vec<usize> = (0..count).map(|number| 2 * number).collect();
            assert_eq!(each(&Careless, count, |number| 2 * number), expected);
        }
    }
}
