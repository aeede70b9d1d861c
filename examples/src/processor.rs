//! What this process has taken of the processors, to the nanosecond; it does not count what others do on the same machine.

/// Time that all threads of this process have run so far, s, where the system tells it.
#[cfg(unix)]
pub fn of_process() -> Option<f64> {
    Some(seconds(rustix::time::ClockId::ProcessCPUTime))
}

/// Time that this thread has run so far, s, where the system tells it.
#[cfg(unix)]
pub fn of_thread() -> Option<f64> {
    Some(seconds(rustix::time::ClockId::ThreadCPUTime))
}

#[cfg(unix)]
fn seconds(clock: rustix::time::ClockId) -> f64 {
    let time = rustix::time::clock_gettime(clock);
    time.tv_sec as f64 + time.tv_nsec as f64 * 1e-9
}

/// Time that all threads of this process have run so far, s: not known here.
#[cfg(not(unix))]
pub fn of_process() -> Option<f64> {
    None
}

/// Time that this thread has run so far, s: not known here.
#[cfg(not(unix))]
pub fn of_thread() -> Option<f64> {
    None
}

#[cfg(all(test, unix))]
mod tests {
    #[test]
    fn work_takes_time_and_rest_takes_none() {
        let taken = |work: &dyn Fn()| {
            let before = super::of_thread().unwrap_or_default();
            work();
            super::of_thread().unwrap_or_default() - before
        };
        let rest = taken(&|| std::thread::sleep(std::time::Duration::from_millis(50)));
        let work = taken(&|| {
            std::hint::black_box(
                (0..20_000_000_u64)
                    .fold(1_u64, |value, turn| std::hint::black_box(value.rotate_left(7) ^ turn)),
            );
        });
        assert!(work > 0.0 && rest < 0.025, "{work} s of work, {rest} s of rest");
        assert!(super::of_process() >= super::of_thread());
    }
}
