//! Driving: what one driver sees, how he answers to it, and which lane he takes.
//!
//! A driver [looks ahead](lookahead) and follows by his [model](following), with what he [gets wrong](perception). He
//! [changes lanes](lane_change), [passes](passing) what stands on his own, and makes way for [sirens].

pub(super) mod following;
pub(super) mod idm;
pub(super) mod lane_change;
pub(super) mod lookahead;
pub(super) mod mobil;
pub(super) mod otherwise;
pub(super) mod passing;
pub(super) mod perception;
pub(super) mod sirens;
