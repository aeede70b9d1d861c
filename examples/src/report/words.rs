//! Numbers and names as readers want them.

pub(super) use crate::experiment::escaped;

/// Seconds as minutes and seconds, with hours if there are any.
pub(super) fn clock(seconds: f64) -> String {
    let whole = seconds.max(0.0).floor() as u64;
    let (hours, minutes, rest) = (whole / 3600, whole / 60 % 60, whole % 60);
    if hours > 0 { format!("{hours}:{minutes:02}:{rest:02}") } else { format!("{minutes}:{rest:02}") }
}

/// An amount of money.
pub(super) fn dollars(amount: f64) -> String {
    let sign = if amount < 0.0 { "\u{2212}" } else { "" };
    format!("{sign}${:.2}", amount.abs())
}

/// A number with its noun: `1 bid`, `3 bids`.
pub(super) fn count(number: usize, noun: &str) -> String {
    if number == 1 { format!("1 {noun}") } else { format!("{number} {noun}s") }
}

/// A name that fits into a column; what is cut off is told by dots.
pub(super) fn shortened(name: &str, most: usize) -> String {
    if name.chars().count() <= most {
        return name.to_owned();
    }
    name.chars().take(most.saturating_sub(1)).chain(['\u{2026}']).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_as_readers_want_them() {
        assert_eq!(
            (clock(75.9), clock(3600.0), clock(-1.0)),
            ("1:15".into(), "1:00:00".into(), "0:00".into())
        );
        assert_eq!(
            (dollars(-1.5), count(1, "bid"), count(0, "bid")),
            ("\u{2212}$1.50".into(), "1 bid".into(), "0 bids".into())
        );
        assert_eq!((shortened("Ada", 3), shortened("Adam", 3)), ("Ada".into(), "Ad\u{2026}".into()));
    }
}
