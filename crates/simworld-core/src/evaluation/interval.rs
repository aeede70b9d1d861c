//! Intervals of confidence without a model of the values.

use serde::{Deserialize, Serialize};

use crate::seed::Stream;

/// From where to where a statistic may lie.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Interval {
    /// Its lower end.
    pub low: f64,
    /// Its upper end.
    pub high: f64,
}

impl Interval {
    /// Whether a value lies in it, its ends included.
    pub fn contains(&self, value: f64) -> bool {
        (self.low..=self.high).contains(&value)
    }
}

/// The mean; NaN without values.
pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// The quantile of values, `share` in [0, 1], by linear interpolation (type 7 of Hyndman and Fan 1996); `None` without
/// values, or if one is NaN.
///
/// The median of 1, 2, 3, 4 is 2.5.
pub fn quantile(values: &[f64], share: f64) -> Option<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    of_sorted(&sorted, share)
}

fn of_sorted(sorted: &[f64], share: f64) -> Option<f64> {
    let last = sorted.len().checked_sub(1)?;
    if !(0.0..=1.0).contains(&share) || sorted.iter().any(|value| value.is_nan()) {
        return None;
    }
    let at = share * last as f64;
    let (below, part) = (at as usize, at.fract());
    Some(sorted[below] + (sorted[(below + 1).min(last)] - sorted[below]) * part)
}

/// The interval that holds a statistic with some confidence in (0, 1), by the percentile bootstrap (Efron 1979): the
/// statistic of `rounds` samples drawn from the values with replacement. `None` without values or rounds, or if the
/// statistic of a sample is NaN.
///
/// With fewer than about ten values the interval is too narrow; it never reaches beyond what was seen.
pub fn bootstrap(
    values: &[f64],
    statistic: impl Fn(&[f64]) -> f64,
    rounds: usize,
    confidence: f64,
    stream: Stream,
) -> Option<Interval> {
    if values.is_empty() {
        return None;
    }
    let mut rng = stream.rng();
    let mut sample = vec![0.0; values.len()];
    let mut statistics: Vec<f64> = (0..rounds)
        .map(|_| {
            sample.fill_with(|| values[rng.below(values.len())]);
            statistic(&sample)
        })
        .collect();
    statistics.sort_by(f64::total_cmp);
    let tail = (1.0 - confidence) * 0.5;
    Some(Interval { low: of_sorted(&statistics, tail)?, high: of_sorted(&statistics, 1.0 - tail)? })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::seed::Seed;

    #[test]
    fn quantiles_lie_between_values() {
        let values = [4.0, 1.0, 3.0, 2.0];
        assert_eq!(quantile(&values, 0.5), Some(2.5));
        assert_eq!((quantile(&values, 0.0), quantile(&values, 1.0)), (Some(1.0), Some(4.0)));
        assert_eq!(quantile(&[], 0.5), None);
        assert_eq!(quantile(&[1.0, f64::NAN], 0.5), None);
        assert_eq!(quantile(&values, 1.5), None);
    }

    #[test]
    fn the_bootstrap_holds_the_mean_as_often_as_it_says() {
        let mut held = 0;
        for trial in 0..400 {
            let mut rng = Seed(trial).stream("values").rng();
            let values: Vec<f64> = (0..40).map(|_| rng.normal(3.0, 2.0)).collect();
            let stream = Seed(trial).stream("bootstrap");
            let interval = bootstrap(&values, mean, 400, 0.9, stream).unwrap();
            held += u32::from(interval.contains(3.0));
        }
        // 360 of 400 in the mean, with a deviation of 6; the percentile interval is a little narrow.
        assert!((335..=380).contains(&held), "{held} of 400");
    }

    #[test]
    fn the_same_stream_gives_the_same_interval() {
        let values = [1.0, 5.0, 2.0, 8.0];
        let of = |seed| bootstrap(&values, mean, 100, 0.95, Seed(seed).stream("x"));
        assert_eq!(of(1), of(1));
        assert_ne!(of(1), of(2));
        assert_eq!(bootstrap(&[], mean, 100, 0.95, Seed(1).stream("x")), None);
    }
}
