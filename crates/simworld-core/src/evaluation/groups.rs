//! One accumulator a key: an agent, a policy, a place.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::Accumulator;

/// Accumulators by key, in the order of keys.
///
/// ```
/// use simworld_core::evaluation::Groups;
/// let mut profits: Groups<&str> = Groups::default();
/// for (policy, profit) in [("low", 3.0), ("high", 1.0), ("low", 5.0)] { profits.push(policy, profit); }
/// assert_eq!(profits.get(&"low").map(|low| low.mean()), Some(4.0));
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Groups<K: Ord>(BTreeMap<K, Accumulator>);

impl<K: Ord> Default for Groups<K> {
    fn default() -> Self {
        Self(BTreeMap::new())
    }
}

impl<K: Ord> Groups<K> {
    /// Adds a value to the group of a key.
    pub fn push(&mut self, key: K, value: f64) {
        self.0.entry(key).or_default().push(value);
    }

    /// Adds all groups of another, key by key.
    pub fn merge(&mut self, other: Self) {
        for (key, values) in other.0 {
            self.0.entry(key).or_default().merge(&values);
        }
    }

    /// The group of a key.
    pub fn get(&self, key: &K) -> Option<&Accumulator> {
        self.0.get(key)
    }

    /// Every key with its group, in order.
    pub fn iter(&self) -> impl Iterator<Item = (&K, &Accumulator)> {
        self.0.iter()
    }

    /// All groups in one.
    pub fn total(&self) -> Accumulator {
        self.0.values().fold(Accumulator::default(), |mut total, group| {
            total.merge(group);
            total
        })
    }
}
