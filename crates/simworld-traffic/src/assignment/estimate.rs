//! Demand from counts: generalised least squares with demand that is not negative (Cascetta 1984, Transportation Research B
//! 18; the active set after Lawson and Hanson 1974, chapter 23).

use nalgebra::{Cholesky, DMatrix, DVector};

use super::AssignmentError;

/// How far the counts and the demand that one believed before are trusted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EstimateConfig {
    /// Weight of the demand from before against that of the counts; 0 is no knowledge, and then counts must say all.
    pub prior_weight: f64,
}

impl Default for EstimateConfig {
    fn default() -> Self {
        Self { prior_weight: 0.01 }
    }
}

/// Estimates the demand of pairs, vehicles an hour, from counts on links.
///
/// `proportions` holds, a row a count, the share of each pair that passes there, as
/// [`Equilibrium::proportions`](super::Equilibrium::proportions) says; `prior` what one believed before. The result makes
/// `|P x - counts|² + weight |x - prior|²` least among all `x` that are not negative.
///
/// ```
/// use simworld_traffic::assignment::{EstimateConfig, estimate};
/// // Two pairs; the first count sees both, the second one only the second.
/// let demand = estimate(&[1.0, 1.0, 0.0, 1.0], &[500.0, 200.0], &[100.0, 100.0],
///     EstimateConfig { prior_weight: 0.0 })?;
/// assert!((demand[0] - 300.0).abs() < 1e-6 && (demand[1] - 200.0).abs() < 1e-6);
/// # Ok::<(), simworld_traffic::assignment::AssignmentError>(())
/// ```
///
/// # Errors
/// Lists whose sizes do not fit one another, or numbers that are none or negative.
pub fn estimate(
    proportions: &[f64],
    counts: &[f64],
    prior: &[f64],
    config: EstimateConfig,
) -> Result<Vec<f64>, AssignmentError> {
    let (rows, columns) = (counts.len(), prior.len());
    if proportions.len() != rows * columns {
        return Err(AssignmentError::Size {
            what: "proportions",
            given: proportions.len(),
            wanted: rows * columns,
        });
    }
    let lists = [
        ("proportions", proportions),
        ("counts", counts),
        ("prior", prior),
        ("prior_weight", &[config.prior_weight]),
    ];
    for (what, list) in lists {
        if let Some(index) = list.iter().position(|value| !(*value >= 0.0 && value.is_finite())) {
            return Err(AssignmentError::Number { what, index, value: list[index] });
        }
    }
    Ok(Problem::new(proportions, counts, prior, config.prior_weight).solve())
}

/// The normal equations: `matrix x = wanted` where the error is least.
struct Problem {
    matrix: DMatrix<f64>,
    wanted: DVector<f64>,
}

impl Problem {
    fn new(proportions: &[f64], counts: &[f64], prior: &[f64], weight: f64) -> Self {
        let shares = DMatrix::from_row_slice(counts.len(), prior.len(), proportions);
        let mut matrix = shares.tr_mul(&shares);
        let mut wanted = shares.tr_mul(&DVector::from_column_slice(counts));
        for (column, volume) in prior.iter().enumerate() {
            matrix[(column, column)] += weight;
            wanted[column] += weight * volume;
        }
        Self { matrix, wanted }
    }

    /// Columns are freed while that helps, and bound again where they would fall below nothing.
    fn solve(&self) -> Vec<f64> {
        let columns = self.wanted.len();
        let mut demand = DVector::zeros(columns);
        let mut free: Vec<usize> = Vec::new();
        // Columns that say the same of all counts as others that are free: they stay at nothing.
        let mut idle = vec![false; columns];
        let least = 1e-9 * self.wanted.amax().max(1.0);
        // Each turn frees one column; three for each is the usual bound.
        for _ in 0..3 * columns {
            let gain = &self.wanted - &self.matrix * &demand;
            let bound = (0..columns).filter(|column| !idle[*column] && !free.contains(column));
            let best = bound.max_by(|a, b| gain[*a].total_cmp(&gain[*b]).then(b.cmp(a)));
            let Some(best) = best.filter(|best| gain[*best] > least) else { break };
            free.push(best);
            if !self.settle(&mut demand, &mut free) {
                idle[best] = true;
                free.retain(|column| *column != best);
            }
        }
        demand.iter().copied().collect()
    }

    /// The best values of the free columns, none of them negative; false if they have none of their own.
    fn settle(&self, demand: &mut DVector<f64>, free: &mut Vec<usize>) -> bool {
        while !free.is_empty() {
            let part = DMatrix::from_fn(free.len(), free.len(), |i, j| self.matrix[(free[i], free[j])]);
            let wanted = DVector::from_fn(free.len(), |i, _| self.wanted[free[i]]);
            let Some(factor) = Cholesky::new(part) else { return false };
            let wish = factor.solve(&wanted);
            // How far from the old values towards the new ones before one is less than nothing.
            let falls = free.iter().zip(wish.iter()).filter(|(_, wish)| **wish < 0.0);
            let share =
                falls.map(|(column, wish)| demand[*column] / (demand[*column] - wish)).fold(1.0, f64::min);
            for (column, wish) in free.iter().zip(wish.iter()) {
                demand[*column] += share * (wish - demand[*column]);
            }
            let before = free.len();
            free.retain(|column| {
                let stays = share >= 1.0 || demand[*column] > 1e-12;
                if !stays {
                    demand[*column] = 0.0;
                }
                stays
            });
            if free.len() == before {
                break;
            }
        }
        true
    }
}
