//! Junctions: who may cross, in which order, and how those come on who would wait for good.
//!
//! [Leave](junction) to cross goes by [who goes first](precedence). Where lanes are short, who waits at one junction [still stands](trailing) in
//! the one behind, so that one at a time goes into such [clusters]. Whoever waits too long is helped by his [haste], by [courtesy], by his
//! own [patience], and by what undoes [locks](deadlock).

#[cfg(test)]
mod beside_a_stream;
pub(super) mod clusters;
pub(super) mod courtesy;
pub(super) mod deadlock;
pub(crate) mod gaps;
mod haste;
pub(super) mod junction;
pub(super) mod leavers;
pub(super) mod patience;
pub(super) mod precedence;
pub(super) mod rings;
pub(super) mod trailing;
