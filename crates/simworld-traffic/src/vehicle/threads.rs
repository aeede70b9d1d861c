//! Work on the parts of a network, each by one thread at a time.

use std::array;
use std::sync::{Mutex, PoisonError};

use simworld_core::net::Workers;

use super::tracks::layout::MOST_PARTS;

/// In which order the parts have their turn; what comes out does not depend on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sweep {
    Up,
    Down,
}

impl Sweep {
    /// That of a phase of a step: back, in each half, from where the phase before it ended. What was looked at last is still at
    /// hand; in one order for all phases each part would have been put away by the others when it has its turn again.
    pub(super) fn of(step: u64, phase: u64) -> Self {
        if (step + phase).is_multiple_of(2) { Self::Up } else { Self::Down }
    }

    fn turn(self, index: usize, count: usize) -> usize {
        // Of two threads each keeps its half of the parts from phase to phase.
        let half = count / 2;
        match self {
            Self::Down if index < half => half - 1 - index,
            Self::Down if index < count => half + (count - 1 - index),
            Self::Up | Self::Down => index,
        }
    }
}

/// Calls `work` once with each item and its number, on the threads of the workers, and returns when all are done. Asks nothing
/// of the heap for up to [`MOST_PARTS`] items; what is beyond is worked on here.
pub(super) fn each<T: Send>(
    workers: &dyn Workers,
    sweep: Sweep,
    items: &mut [T],
    work: impl Fn(usize, &mut T) + Sync,
) {
    let count = items.len().min(MOST_PARTS);
    let mut rest = items.iter_mut();
    let cells: [Mutex<Option<&mut T>>; MOST_PARTS] = array::from_fn(|_| Mutex::new(rest.next()));
    let run = |turn: usize| {
        let index = sweep.turn(turn, count);
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
            for (workers, sweep) in [
                (&Alone as &dyn Workers, Sweep::Up),
                (&Alone, Sweep::Down),
                (&Careless, Sweep::Up),
                (&Careless, Sweep::Down),
            ] {
                let mut items = vec![0; count];
                each(workers, sweep, &mut items, |index, item| *item += index + 1);
                assert!(items.iter().enumerate().all(|(index, item)| *item == index + 1), "{count}");
            }
        }
    }

    #[test]
    fn each_phase_goes_back_from_where_the_one_before_it_ended() {
        let phases = (0..4).flat_map(|step| (0..3).map(move |phase| Sweep::of(step, phase)));
        let phases: Vec<Sweep> = phases.collect();
        assert!(phases.windows(2).all(|two| two[0] != two[1]), "{phases:?}");
    }

    #[test]
    fn each_half_of_the_parts_is_gone_through_by_itself() {
        for count in [0, 1, 2, 7, 64] {
            let down: Vec<usize> = (0..count).map(|index| Sweep::Down.turn(index, count)).collect();
            let half = count / 2;
            let halves = (0..half).rev().chain((half..count).rev());
            assert_eq!(down, halves.collect::<Vec<_>>());
        }
    }
}
