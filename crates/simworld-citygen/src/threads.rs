//! Work on all threads whose results come in order.

use rayon::prelude::*;
use simworld_core::net::Workers;

/// The threads of rayon's pool, for [`RoadNetwork::derive_with`](simworld_core::net::RoadNetwork::derive_with) and whatever else
/// asks for workers, as traffic does.
#[derive(Clone, Copy, Debug, Default)]
pub struct AllThreads;

impl Workers for AllThreads {
    fn run(&self, parts: usize, work: &(dyn Fn(usize) + Sync)) {
        (0..parts).into_par_iter().for_each(work);
    }
}

/// So many things, and what is made of them, stay in the caches.
const FEW: usize = 2048;

/// How many of some things one thread works on at once: as many as is usual, or all of them where there is one thread and they are
/// few. What is made of them stands in one piece then, and is taken over without being moved.
pub(crate) fn at_once(count: usize, usual: usize) -> usize {
    if count <= FEW && rayon::current_num_threads() == 1 { count.max(1) } else { usual }
}

/// Adds a part to what is to be so many things, more or less. The first part stays where it is.
pub(crate) fn take_over<T>(all: &mut Vec<T>, mut part: Vec<T>, count: usize) {
    if all.is_empty() {
        *all = part;
        all.reserve_exact(count.saturating_sub(all.len()));
    } else {
        all.append(&mut part);
    }
}

/// Makes something of each batch on all threads, and takes what was made in the order of the batches, while the next is
/// being made: `take` is called as if there were one thread. It is called with nothing first, while the first batch is being
/// made.
pub(crate) fn in_order<T: Sync, M: Send>(
    batches: std::slice::Chunks<'_, T>,
    make: impl Fn(&[T]) -> M + Sync,
    mut take: impl FnMut(Option<M>) + Send,
) {
    let mut made = None;
    for batch in batches {
        let before = made.take();
        made = Some(rayon::join(|| take(before), || make(batch)).1);
    }
    take(made);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn batches_are_taken_in_order() {
        let items: Vec<u32> = (0..1000).collect();
        for threads in [1, 3] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
            let mut taken = Vec::new();
            pool.install(|| {
                in_order(
                    items.chunks(17),
                    |batch| batch.par_iter().map(|item| item * 2).collect::<Vec<_>>(),
                    |made| taken.extend(made.into_iter().flatten()),
                );
            });
            assert!(taken.iter().zip(&items).all(|(taken, item)| *taken == item * 2), "{threads}");
            assert_eq!(taken.len(), items.len());
        }
    }
}
