//! How two figures go together.

use super::interval::mean;
use super::rank::ranks;
use crate::seed::Stream;

/// The correlation of pairs by Pearson, in [-1, 1]; `None` for fewer than two pairs, lists of different length, or a list
/// that does not vary.
pub fn pearson(x: &[f64], y: &[f64]) -> Option<f64> {
    if x.len() != y.len() || x.len() < 2 {
        return None;
    }
    let (middle_x, middle_y) = (mean(x), mean(y));
    let (mut both, mut square_x, mut square_y) = (0.0, 0.0, 0.0);
    for (x, y) in x.iter().zip(y) {
        let (x, y) = (x - middle_x, y - middle_y);
        (both, square_x, square_y) = (both + x * y, square_x + x * x, square_y + y * y);
    }
    let scale = (square_x * square_y).sqrt();
    (scale > 0.0 && scale.is_finite()).then(|| (both / scale).clamp(-1.0, 1.0))
}

/// The correlation of their ranks (Spearman 1904), in [-1, 1]; `None` as [`pearson`].
pub fn spearman(x: &[f64], y: &[f64]) -> Option<f64> {
    pearson(&ranks(x)?, &ranks(y)?)
}

/// How likely pairs drawn at random would be as far from zero in a statistic, two-sided: the share of `rounds` shuffles of
/// `y` that reach it, never zero (Phipson and Smyth 2010). `None` if the statistic says nothing of the pairs themselves.
///
/// ```
/// use simworld_core::evaluation::{permutation, spearman};
/// use simworld_core::seed::Seed;
/// let (x, y) = ([1.0, 2.0, 3.0, 4.0, 5.0, 6.0], [1.5, 2.5, 2.0, 4.5, 4.0, 7.0]);
/// assert!(permutation(&x, &y, spearman, 1000, Seed(1).stream("pairs")).unwrap() < 0.05);
/// ```
pub fn permutation(
    x: &[f64],
    y: &[f64],
    statistic: impl Fn(&[f64], &[f64]) -> Option<f64>,
    rounds: u32,
    stream: Stream,
) -> Option<f64> {
    // A hair less, so that rounding in another order of sums does not decide.
    let seen = statistic(x, y)?.abs() * (1.0 - 1e-12);
    let mut rng = stream.rng();
    let mut shuffled = y.to_vec();
    let mut reached = 0;
    for _ in 0..rounds {
        rng.shuffle(&mut shuffled);
        reached += u32::from(statistic(x, &shuffled).is_some_and(|value| value.abs() >= seen));
    }
    Some(f64::from(reached + 1) / f64::from(rounds + 1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::seed::Seed;

    #[test]
    fn lines_correlate_wholly() {
        let x = [1.0, 2.0, 3.0, 4.0];
        assert_eq!(pearson(&x, &[2.0, 4.0, 6.0, 8.0]), Some(1.0));
        assert_eq!(pearson(&x, &[3.0, 2.0, 1.0, 0.0]), Some(-1.0));
        assert_eq!(spearman(&x, &[1.0, 8.0, 27.0, 64.0]), Some(1.0));

        let other = pearson(&x, &[1.0, 3.0, 2.0, 5.5]).unwrap();
        assert!((other - 6.25 / (5.0_f64 * 11.1875).sqrt()).abs() < 1e-12, "{other}");
    }

    #[test]
    fn nothing_is_said_of_lists_that_do_not_vary() {
        assert_eq!(pearson(&[1.0, 1.0], &[1.0, 2.0]), None);
        assert_eq!(pearson(&[1.0], &[1.0]), None);
        assert_eq!(spearman(&[1.0, 2.0], &[1.0]), None);
    }

    #[test]
    fn chance_reaches_what_is_chance() {
        let mut small = 0;
        for trial in 0..200 {
            let mut rng = Seed(trial).stream("pairs").rng();
            let mut draw = || (0..12).map(|_| rng.unit()).collect::<Vec<f64>>();
            let (x, y) = (draw(), draw());
            let p = permutation(&x, &y, pearson, 199, Seed(trial).stream("shuffles")).unwrap();
            small += u32::from(p <= 0.1);
        }
        // A tenth of 200, with a deviation of 4.
        assert!((7..=35).contains(&small), "{small} of 200");
    }
}
