//! How many requests a client may make in a second.

use std::time::{Duration, Instant};

/// Fills with allowances at a constant rate and holds those of a second.
pub(super) struct Bucket {
    rate: f64,
    filled: f64,
    at: Instant,
}

impl Bucket {
    /// A full bucket of so many requests a second.
    pub(super) fn new(rate: f64, now: Instant) -> Self {
        Self { rate, filled: rate.max(1.0), at: now }
    }

    /// Takes an allowance, or says after what time there is one.
    pub(super) fn take(&mut self, now: Instant) -> Result<(), Duration> {
        let passed = now.saturating_duration_since(self.at).as_secs_f64();
        self.filled = (self.filled + passed * self.rate).min(self.rate.max(1.0));
        self.at = now;
        if self.filled >= 1.0 {
            self.filled -= 1.0;
            return Ok(());
        }
        Err(Duration::from_secs_f64((1.0 - self.filled) / self.rate))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::remote::clock::now;

    #[test]
    fn a_second_gives_as_many_as_the_rate_and_no_more() {
        let start = now();
        let mut bucket = Bucket::new(10.0, start);
        let taken = |bucket: &mut Bucket, at| (0..100).take_while(|_| bucket.take(at).is_ok()).count();
        assert_eq!(taken(&mut bucket, start), 10, "a second's worth is there at the start");
        assert_eq!(taken(&mut bucket, start + Duration::from_millis(500)), 5);
        assert_eq!(taken(&mut bucket, start + Duration::from_mins(1)), 10, "nothing is hoarded");
        let wait = bucket.take(start + Duration::from_mins(1)).unwrap_err();
        assert!((wait.as_secs_f64() - 0.1).abs() < 1e-6, "{wait:?}");
    }
}
