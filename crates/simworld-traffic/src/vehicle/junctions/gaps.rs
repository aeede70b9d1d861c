//! Gap acceptance: which critical gaps can be set.

use simworld_core::net::CriticalGaps;

use crate::TrafficError;

/// Refuses critical gaps out of [1, 20] s.
pub(crate) fn validate(gaps: &CriticalGaps) -> Result<(), TrafficError> {
    let fields = [
        ("gaps.across_from_major", gaps.across_from_major),
        ("gaps.across_at_signal", gaps.across_at_signal),
        ("gaps.with_from_minor", gaps.with_from_minor),
        ("gaps.straight_from_minor", gaps.straight_from_minor),
        ("gaps.across_from_minor", gaps.across_from_minor),
        ("gaps.roundabout", gaps.roundabout),
    ];
    let wrong = fields.into_iter().find(|(_, value)| !(1.0..=20.0).contains(value));
    wrong.map_or(Ok(()), |(field, value)| {
        Err(TrafficError::Config { field, value, allowed: "a critical gap of 1 to 20 s" })
    })
}
