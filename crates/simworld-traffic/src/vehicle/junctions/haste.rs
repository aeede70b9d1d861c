//! Haste: who has stood long at his line for want of a gap takes shorter ones, at last any before which those with priority need but ease
//! off.
//!
//! Beside a stream without the gaps that he first asks for one would stand for good, and with him whoever is behind. Drivers accept shorter gaps the
//! longer they have waited (Pollatschek, Polus and Livneh, Transportation Research B 36, 2002), and SUMO's drivers have an impatience that grows so.
//! He still goes only before those who can stop for him at their lines without effort, so nobody is ever in danger.

/// Who has stood for so long, s, begins to be in haste, and is in full haste after so long.
const CALM_FOR: f64 = 60.0;
const AFTER: f64 = 180.0;
/// Time by which one in full haste delays those with priority more than others do, s.
const DELAYS: f64 = 3.0;

/// How much in haste one is, from 0 to 1.
#[derive(Clone, Copy, Debug)]
pub(super) struct Haste(f64);

impl Haste {
    pub(super) const NONE: Self = Self(0.0);

    /// Of one who has stood at his line for so long, s.
    pub(super) fn of(stood: f64) -> Self {
        Self(((stood - CALM_FOR) / (AFTER - CALM_FOR)).clamp(0.0, 1.0))
    }

    /// What becomes of a critical gap, s.
    pub(super) fn shortens(self, critical: f64) -> f64 {
        critical * (1.0 - self.0)
    }

    /// By how much more one delays those with priority, at most, s.
    pub(super) fn delays(self) -> f64 {
        DELAYS * self.0
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use super::super::beside_a_stream::waits;
    use super::*;

    #[test]
    fn who_has_waited_long_takes_gaps_that_he_did_not_take_at_first() {
        // One in two seconds and in two and a half: less than the gaps that the manual asks for.
        for every in [20, 25] {
            let wait = waits(0.0, every, FRAC_PI_2, false);
            let goes = wait.goes.expect("his haste grows");
            assert!((CALM_FOR..AFTER).contains(&goes), "he goes after {goes} s");
            assert!(wait.counters.crossings > 30, "the stream goes: {:?}", wait.counters);
            let goes =
                waits(AFTER, every, FRAC_PI_2, false).goes.expect("there are gaps for one in full haste");
            assert!(goes < 30.0, "he goes after {goes} s");
        }
    }

    #[test]
    fn nobody_brakes_hard_for_one_in_haste() {
        for every in 15..40 {
            let wait = waits(AFTER, every, FRAC_PI_2, false);
            assert_eq!(wait.counters.forced_stops, 0);
            assert!(wait.braking < 2.5, "one in {every} tenths of a second brakes by {} m/s²", wait.braking);
        }
    }
}
