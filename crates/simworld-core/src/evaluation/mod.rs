//! Evaluation: what figures of merit come to over agents, groups and seeds, and whether two sets of them differ.
//!
//! A [`Task`](crate::seam::Task) gives figures of one run. These tools say what many runs have in common: an
//! [`Accumulator`] keeps mean and deviation of a stream of values without keeping the values, [`Groups`] keeps one a key,
//! [`bootstrap`] puts an interval around any statistic, [`rank_sum`] and [`signed_rank`] compare two sets without asking
//! how values are distributed, [`pearson`] and [`spearman`] measure how two go together, and [`permutation`] says how
//! often chance alone would do as well. Whatever draws takes a [`Stream`](crate::seed::Stream), so a figure is the same on
//! every machine.
//!
//! ```
//! use simworld_core::evaluation::{Accumulator, bootstrap, mean, rank_sum};
//! use simworld_core::seed::Seed;
//! let (bold, shy) = ([12.1, 9.8, 15.2, 11.0, 13.3], [7.9, 8.8, 10.1, 6.5, 9.0]);
//! let summary: Accumulator = bold.into_iter().collect();
//! assert_eq!(format!("{summary:.2}"), "12.28 ± 2.08");
//! let interval = bootstrap(&bold, mean, 2000, 0.95, Seed(1).stream("profit")).unwrap();
//! assert!(interval.contains(12.28) && interval.low > 10.0);
//! let test = rank_sum(&bold, &shy).unwrap();
//! assert!(test.superiority == 0.96 && test.p < 0.05);
//! ```

mod accumulator;
mod correlation;
mod groups;
mod interval;
mod rank;

pub use accumulator::Accumulator;
pub use correlation::{pearson, permutation, spearman};
pub use groups::Groups;
pub use interval::{Interval, bootstrap, mean, quantile};
pub use rank::{RankSum, SignedRank, rank_sum, ranks, signed_rank};
