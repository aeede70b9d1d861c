//! Work in shares, by as many threads as are worth it. Who does a share changes nothing: outcomes come in the order of the shares.

use std::num::NonZeroUsize;
use std::sync::{Mutex, OnceLock, PoisonError};

/// More threads are no use to anything here.
const MOST: usize = 12;

/// How many threads work on so much, each on at least `least` of it.
pub(crate) fn worth(amount: usize, least: usize) -> usize {
    static PROCESSORS: OnceLock<usize> = OnceLock::new();
    // It reads files, so it is asked once.
    let there = PROCESSORS.get_or_init(|| std::thread::available_parallelism().map_or(1, NonZeroUsize::get));
    (amount / least.max(1)).clamp(1, MOST).min(*there)
}

/// What becomes of each share.
pub(crate) fn each<I: Send, O: Send>(shares: Vec<I>, work: impl Fn(I) -> O + Sync) -> Vec<O> {
    let threads = shares.len();
    if threads < 2 {
        return shares.into_iter().map(work).collect();
    }
    let mut outcomes: Vec<Option<O>> = shares.iter().map(|_| None).collect();
    let queue = Mutex::new(shares.into_iter().zip(&mut outcomes));
    let next = || queue.lock().unwrap_or_else(PoisonError::into_inner).next();
    let go_on = || {
        while let Some((share, outcome)) = next() {
            *outcome = Some(work(share));
        }
    };
    std::thread::scope(|scope| {
        for _ in 1..threads {
            // Where the system gives no thread, the others do its share.
            let _ = std::thread::Builder::new().spawn_scoped(scope, go_on);
        }
        go_on();
    });
    outcomes.into_iter().flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outcomes_come_in_the_order_of_their_shares() {
        for count in [0, 1, 2, 40] {
            let shares: Vec<u64> = (0..count).collect();
            let expected: Vec<u64> = shares.iter().map(|share| share * share).collect();
            assert_eq!(each(shares, |share| share * share), expected);
        }
        assert_eq!(worth(0, 10), 1);
        assert!(worth(1_000_000, 10) <= MOST);
    }
}
