//! Tests by ranks: they ask for nothing but that values can be ordered.

use serde::{Deserialize, Serialize};

use crate::ops;

/// Up to so many values in all the probabilities are counted out, beyond it they are those of the normal distribution.
const COUNTED: usize = 60;

/// The ranks of values, from 1; equal ones share the mean of theirs. `None` if one is NaN.
///
/// The ranks of 10, 20, 20, 5 are 2, 3.5, 3.5, 1.
pub fn ranks(values: &[f64]) -> Option<Vec<f64>> {
    doubled_ranks(values).map(|ranks| ranks.into_iter().map(|rank| rank as f64 * 0.5).collect())
}

/// Twice the ranks: whole numbers, also of equal values.
fn doubled_ranks(values: &[f64]) -> Option<Vec<usize>> {
    if values.iter().any(|value| value.is_nan()) {
        return None;
    }
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|a, b| values[*a].total_cmp(&values[*b]));
    let mut ranks = vec![0; values.len()];
    let mut rest = order.as_slice();
    while let Some(first) = rest.first() {
        let below = values.len() - rest.len();
        // Zeros of either sign are equal.
        let equal = rest.iter().take_while(|index| values[**index] == values[*first]).count();
        for index in &rest[..equal] {
            ranks[*index] = 2 * below + equal + 1;
        }
        rest = &rest[equal..];
    }
    Some(ranks)
}

/// What the rank-sum test says of two sets.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct RankSum {
    /// The statistic U of the first set: pairs in which its value is the greater, equal ones counted half.
    pub u: f64,
    /// U over the number of pairs: how likely a value of the first set beats one of the second (Vargha and Delaney 2000);
    /// 0.5 if neither is better.
    pub superiority: f64,
    /// Two-sided probability of so great a difference by chance.
    pub p: f64,
}

/// The rank-sum test of two independent sets (Mann and Whitney 1947): whether values of one tend to be greater. Exact up to
/// 60 values in all, equal ones included; beyond by the normal distribution with correction for equal values and
/// continuity. `None` if a set is empty or holds NaN.
pub fn rank_sum(first: &[f64], second: &[f64]) -> Option<RankSum> {
    if first.is_empty() || second.is_empty() {
        return None;
    }
    let (n, m) = (first.len() as f64, second.len() as f64);
    let all: Vec<f64> = first.iter().chain(second).copied().collect();
    let ranks = doubled_ranks(&all)?;
    let sum: usize = ranks[..first.len()].iter().sum();
    let u = sum as f64 * 0.5 - n * (n + 1.0) * 0.5;
    let p = if all.len() <= COUNTED {
        two_sided(&sums_of_choices(&ranks, first.len()), sum)
    } else {
        let total = n + m;
        let variance = n * m / 12.0 * (total + 1.0 - tied(&ranks) / (total * (total - 1.0)));
        normal_two_sided(u - n * m * 0.5, variance)
    };
    Some(RankSum { u, superiority: u / (n * m), p })
}

/// What the signed-rank test says of differences.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SignedRank {
    /// Sum of the ranks of positive differences.
    pub positive: f64,
    /// Sum of the ranks of negative differences.
    pub negative: f64,
    /// Two-sided probability of so one-sided a result by chance.
    pub p: f64,
}

/// The signed-rank test of paired differences (Wilcoxon 1945): whether they tend to one side of zero. Differences of zero
/// are left out. Exact up to 60 differences, beyond by the normal distribution. `None` if all are zero or one is NaN.
pub fn signed_rank(differences: &[f64]) -> Option<SignedRank> {
    let nonzero: Vec<f64> = differences.iter().copied().filter(|value| *value != 0.0).collect();
    let sizes: Vec<f64> = nonzero.iter().map(|value| value.abs()).collect();
    let ranks = doubled_ranks(&sizes).filter(|ranks| !ranks.is_empty())?;
    let total: usize = ranks.iter().sum();
    let positive: usize =
        ranks.iter().zip(&nonzero).filter(|(_, value)| **value > 0.0).map(|(rank, _)| rank).sum();
    let p = if ranks.len() <= COUNTED {
        two_sided(&sums_of_subsets(&ranks), positive)
    } else {
        let squares: f64 = ranks.iter().map(|rank| (rank * rank) as f64 * 0.25).sum();
        let variance = squares * 0.25;
        normal_two_sided((positive as f64 - total as f64 * 0.5) * 0.5, variance)
    };
    Some(SignedRank { positive: positive as f64 * 0.5, negative: (total - positive) as f64 * 0.5, p })
}

/// How many of the values are equal to others: the sum of t³ - t over sets of t equal ones.
fn tied(doubled: &[usize]) -> f64 {
    let mut sorted = doubled.to_vec();
    sorted.sort_unstable();
    let sizes = sorted.chunk_by(|a, b| a == b).map(|equal| equal.len() as f64);
    sizes.map(|size| size * size * size - size).sum()
}

/// How often each sum comes of all choices of so many numbers.
fn sums_of_choices(numbers: &[usize], count: usize) -> Vec<f64> {
    let most: usize = numbers.iter().sum();
    let mut ways = vec![vec![0.0; most + 1]; count + 1];
    ways[0][0] = 1.0;
    for number in numbers {
        // From many to few, so that no number is chosen twice.
        for chosen in (0..count).rev() {
            let (few, more) = ways.split_at_mut(chosen + 1);
            for (sum, way) in few[chosen][..=most - number].iter().enumerate() {
                more[0][sum + number] += way;
            }
        }
    }
    ways.swap_remove(count)
}

/// How often each sum comes of all subsets of some numbers.
fn sums_of_subsets(numbers: &[usize]) -> Vec<f64> {
    let most: usize = numbers.iter().sum();
    let mut ways = vec![0.0; most + 1];
    ways[0] = 1.0;
    for number in numbers {
        for sum in (*number..=most).rev() {
            ways[sum] += ways[sum - number];
        }
    }
    ways
}

/// Twice the lesser tail at a sum, at most 1.
fn two_sided(ways: &[f64], at: usize) -> f64 {
    let all: f64 = ways.iter().sum();
    let (below, above): (f64, f64) = (ways[..=at].iter().sum(), ways[at..].iter().sum());
    (2.0 * below.min(above) / all).min(1.0)
}

/// Two-sided probability of a deviation of the normal distribution, with half a step for continuity.
fn normal_two_sided(deviation: f64, variance: f64) -> f64 {
    if variance <= 0.0 {
        return 1.0;
    }
    let z = (deviation.abs() - 0.5).max(0.0) / variance.sqrt();
    ops::erfc(z * std::f64::consts::FRAC_1_SQRT_2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_values_share_their_ranks() {
        assert_eq!(ranks(&[10.0, 20.0, 20.0, 5.0]), Some(vec![2.0, 3.5, 3.5, 1.0]));
        assert_eq!(ranks(&[0.0, -0.0]), Some(vec![1.5, 1.5]));
        assert_eq!(ranks(&[f64::NAN]), None);
    }

    // Nine people's ages at a diagnosis: U = 17, and 1/9 by the tables.
    #[test]
    fn the_rank_sum_is_that_of_the_tables() {
        let test = rank_sum(&[19.0, 22.0, 16.0, 29.0, 24.0], &[20.0, 11.0, 17.0, 12.0]).unwrap();
        assert_eq!((test.u, test.superiority), (17.0, 0.85));
        assert!((test.p - 1.0 / 9.0).abs() < 1e-12, "{}", test.p);
    }

    // Darwin's maize, differences in eighths of an inch: 24 against 96, p = 0.04126 by the tables.
    #[test]
    fn the_signed_rank_is_that_of_the_tables() {
        let darwin =
            [49.0, -67.0, 8.0, 16.0, 6.0, 23.0, 28.0, 41.0, 14.0, 29.0, 56.0, 24.0, 75.0, 60.0, -48.0];
        let test = signed_rank(&darwin).unwrap();
        assert_eq!((test.positive, test.negative), (96.0, 24.0));
        assert!((test.p - 0.041_259_765_625).abs() < 1e-12, "{}", test.p);
    }

    #[test]
    fn counted_and_normal_probabilities_agree() {
        let first: Vec<f64> = (0..30).map(|n| f64::from(n * 7 % 31)).collect();
        let second: Vec<f64> = (0..30).map(|n| f64::from(n * 11 % 29) + 4.0).collect();
        let counted = rank_sum(&first, &second).unwrap();
        let ranks = doubled_ranks(&first.iter().chain(&second).copied().collect::<Vec<_>>()).unwrap();
        let variance = 900.0 / 12.0 * (61.0 - tied(&ranks) / (60.0 * 59.0));
        let normal = normal_two_sided(counted.u - 450.0, variance);
        assert!((counted.p - normal).abs() < 0.002, "{} against {normal}", counted.p);
    }

    #[test]
    fn many_values_are_judged_too() {
        let first: Vec<f64> = (0..200).map(f64::from).collect();
        let second: Vec<f64> = first.iter().map(|value| value + 60.0).collect();
        let test = rank_sum(&first, &second).unwrap();
        assert!(test.p < 1e-6 && test.superiority < 0.3, "{test:?}");
        assert!(rank_sum(&first, &first).unwrap().p > 0.99);
        assert!(signed_rank(&second).unwrap().p < 1e-12);
    }

    #[test]
    fn nothing_is_said_of_nothing() {
        assert_eq!(rank_sum(&[], &[1.0]), None);
        assert_eq!(rank_sum(&[1.0], &[f64::NAN]), None);
        assert_eq!(signed_rank(&[0.0, 0.0]), None);
    }
}
