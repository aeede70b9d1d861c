//! Cases of one test that need nothing of one another, on threads of their own, so that no core waits for a long test at the end.

use std::panic::resume_unwind;
use std::thread;

/// What each case gives, in their order; a case that fails fails the test with its own message.
pub(crate) fn at_once<C: Send, T: Send>(
    cases: impl IntoIterator<Item = C>,
    run: impl Fn(C) -> T + Sync,
) -> Vec<T> {
    thread::scope(|scope| {
        let run = &run;
        let threads: Vec<_> = cases.into_iter().map(|case| scope.spawn(move || run(case))).collect();
        threads.into_iter().map(|thread| thread.join().unwrap_or_else(|panic| resume_unwind(panic))).collect()
    })
}
