//! Static assignment: which routes people take when everybody knows how long each takes, and, backwards, how many go from
//! where to where when counts on roads are known.
//!
//! [`equilibrium`] finds Wardrop's user equilibrium: on every pair of zones the used paths take equally long, and no other
//! is quicker. [`LegGraph`] makes the graph of a road network, whose paths are [`Route`](crate::Route)s. [`estimate`]
//! finds the demand that explains counts.

mod equilibrium;
mod estimate;
mod legs;
mod paths;

pub use equilibrium::{Equilibrium, EquilibriumConfig, PathFlow, equilibrium};
pub use estimate::{EstimateConfig, estimate};
pub use legs::LegGraph;
use thiserror::Error;

/// A link of a graph for assignment: how long it takes at a volume `x` is
/// `free_time + delay * (x / capacity) ^ power`, s.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    /// The node that it leaves.
    pub from: u32,
    /// The node to which it leads.
    pub to: u32,
    /// Time without others, s.
    pub free_time: f64,
    /// What is lost at capacity, s.
    pub delay: f64,
    /// Capacity, vehicles an hour.
    pub capacity: f64,
    /// How sharply the loss rises, at least 1.
    pub power: f64,
}

impl Link {
    /// A link after the Bureau of Public Roads: `free_time * (1 + 0.15 (x / capacity)^4)` (Traffic Assignment Manual, 1964).
    pub const fn bpr(from: u32, to: u32, free_time: f64, capacity: f64) -> Self {
        Self { from, to, free_time, delay: 0.15 * free_time, capacity, power: 4.0 }
    }

    /// A link that takes the same time at any volume.
    pub const fn constant(from: u32, to: u32, time: f64) -> Self {
        Self { from, to, free_time: time, delay: 0.0, capacity: 1.0, power: 1.0 }
    }

    /// How long it takes, s.
    pub fn time(&self, volume: f64) -> f64 {
        self.free_time + self.delay * power(volume / self.capacity, self.power)
    }

    /// How much longer it takes for one more, s per vehicle an hour.
    pub fn slope(&self, volume: f64) -> f64 {
        self.delay * self.power * power(volume / self.capacity, self.power - 1.0) / self.capacity
    }
}

/// Whole powers, which are usual, by multiplication; the same bits everywhere.
fn power(x: f64, power: f64) -> f64 {
    if power == 0.0 {
        1.0
    } else if power.fract() == 0.0 && power <= 16.0 {
        (1..power as u32).fold(x, |product, _| product * x)
    } else {
        simworld_core::ops::pow(x, power)
    }
}

/// So many go from a node to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pair {
    /// Where they begin.
    pub from: u32,
    /// Where they want to be.
    pub to: u32,
    /// How many, vehicles an hour.
    pub volume: f64,
}

/// Why nothing is assigned.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum AssignmentError {
    /// A link that cannot be.
    #[error("link {link}: {reason}")]
    Link {
        /// Its index.
        link: usize,
        /// What is wrong with it.
        reason: &'static str,
    },
    /// A pair that cannot be.
    #[error("pair {pair}: {reason}")]
    Pair {
        /// Its index.
        pair: usize,
        /// What is wrong with it.
        reason: &'static str,
    },
    /// Lists that do not fit one another.
    #[error("{what} has {given} numbers: give {wanted}")]
    Size {
        /// Which list.
        what: &'static str,
        /// How many it has.
        given: usize,
        /// How many it should have.
        wanted: usize,
    },
    /// A number that is none, or negative.
    #[error("{what} {index} is {value}: give a number of at least 0")]
    Number {
        /// Which list.
        what: &'static str,
        /// Its place.
        index: usize,
        /// The number.
        value: f64,
    },
}
