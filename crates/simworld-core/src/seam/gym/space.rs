//! Spaces: which observations and actions there are, and values of them.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::written;
use crate::hash::{StateHash, StateHasher};

/// A set of observations or actions.
///
/// A space is plain data: serde writes it to JSON, infinite bounds as `"inf"` and `"-inf"`.
///
/// ```
/// use simworld_core::seam::{Space, SpaceValue};
/// let steering = Space::bounded(-1.0, 1.0, vec![1]);
/// assert!(steering.check(&SpaceValue::Box(vec![0.3])).is_ok());
/// assert!(steering.check(&SpaceValue::Box(vec![f64::NAN])).is_err());
/// let text = serde_json::to_string(&Space::bounded(0.0, f64::INFINITY, vec![2]))?;
/// assert_eq!(text, r#"{"box":{"low":{"all":0.0},"high":{"all":"inf"},"shape":[2]}}"#);
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Space {
    /// The integers start..start + n.
    Discrete {
        /// Their number, at least 1.
        n: u64,
        /// The least of them.
        start: i64,
    },
    /// Arrays of numbers within bounds.
    Box {
        /// Least value of each entry.
        low: Bounds,
        /// Greatest value of each entry.
        high: Bounds,
        /// Length of each axis.
        shape: Vec<usize>,
    },
    /// Arrays of zeros and ones.
    MultiBinary {
        /// Their length.
        n: usize,
    },
    /// Arrays of integers, each with a range of its own.
    MultiDiscrete {
        /// How many values each entry has, at least 1.
        n: Vec<u64>,
        /// The least value of each entry, as many as `n` has.
        start: Vec<i64>,
    },
    /// Words.
    Text {
        /// The greatest number of characters.
        max_length: usize,
    },
    /// Named parts.
    Dict(BTreeMap<String, Space>),
    /// Parts in order.
    Tuple(Vec<Space>),
    /// As many values of one space as there happen to be.
    Sequence {
        /// The space of each.
        of: Box<Space>,
        /// The greatest number of them.
        max_length: usize,
    },
    /// Nodes with values, and links between them.
    Graph {
        /// The space of a node's value.
        node: Box<Space>,
        /// The space of a link's value; links have none if there is no space.
        edge: Option<Box<Space>>,
        /// The greatest number of nodes.
        max_nodes: usize,
        /// The greatest number of links.
        max_edges: usize,
    },
}

/// A bound of each entry of a [`Space::Box`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Bounds {
    /// The same for all.
    All(#[serde(with = "written::number")] f64),
    /// One for each entry, row-major.
    Each(#[serde(with = "written::numbers")] Vec<f64>),
}

impl Bounds {
    /// The bound of an entry; none beyond the last.
    pub fn at(&self, index: usize) -> Option<f64> {
        match self {
            Self::All(bound) => Some(*bound),
            Self::Each(bounds) => bounds.get(index).copied(),
        }
    }
}

impl From<f64> for Bounds {
    fn from(bound: f64) -> Self {
        Self::All(bound)
    }
}

impl From<Vec<f64>> for Bounds {
    fn from(bounds: Vec<f64>) -> Self {
        Self::Each(bounds)
    }
}

/// A member of a [`Space`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum SpaceValue {
    /// Of a discrete space.
    Discrete(i64),
    /// Of a box, row-major.
    Box(#[serde(with = "written::numbers")] Vec<f64>),
    /// Of a multi-binary space.
    MultiBinary(Vec<bool>),
    /// Of a multi-discrete space.
    MultiDiscrete(Vec<i64>),
    /// Of a text space.
    Text(String),
    /// Of a dictionary.
    Dict(BTreeMap<String, SpaceValue>),
    /// Of a tuple.
    Tuple(Vec<SpaceValue>),
    /// Of a sequence.
    Sequence(Vec<SpaceValue>),
    /// Of a graph.
    Graph {
        /// The values of nodes.
        nodes: Vec<SpaceValue>,
        /// The values of links, in the order of `links`; empty if links have none.
        edges: Vec<SpaceValue>,
        /// From which node to which, as indices into `nodes`.
        links: Vec<[u32; 2]>,
    },
}

/// Why a value is not in a space, or a space is none.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{path}: {reason}")]
pub struct SpaceError {
    /// Where, as a path of keys and indices.
    pub path: String,
    /// What is wrong.
    pub reason: String,
}

impl SpaceError {
    /// Something wrong at the place itself.
    pub(super) fn here(reason: impl Into<String>) -> Self {
        Self { path: String::new(), reason: reason.into() }
    }

    /// The same, seen from one level further out.
    pub(super) fn under(mut self, part: &str) -> Self {
        self.path.insert_str(0, part);
        self
    }
}

impl Space {
    /// The integers 0..n.
    pub const fn discrete(n: u64) -> Self {
        Self::Discrete { n, start: 0 }
    }

    /// Arrays of that shape with a bound for all entries, or one for each.
    pub fn bounded(low: impl Into<Bounds>, high: impl Into<Bounds>, shape: Vec<usize>) -> Self {
        Self::Box { low: low.into(), high: high.into(), shape }
    }

    /// Arrays of integers from 0 to below `n`, entry by entry.
    pub fn multi_discrete(n: Vec<u64>) -> Self {
        let start = vec![0; n.len()];
        Self::MultiDiscrete { n, start }
    }

    /// Named parts.
    pub fn dict<K: Into<String>>(parts: impl IntoIterator<Item = (K, Self)>) -> Self {
        Self::Dict(parts.into_iter().map(|(key, part)| (key.into(), part)).collect())
    }
}

/// How many entries an array of that shape has; none if that is more than can be counted.
pub(super) fn entries(shape: &[usize]) -> Option<usize> {
    shape.iter().try_fold(1_usize, |product, axis| product.checked_mul(*axis))
}

impl SpaceValue {
    /// The entries, of a box.
    pub fn as_box(&self) -> Option<&[f64]> {
        if let Self::Box(entries) = self { Some(entries) } else { None }
    }

    /// The integer, of a discrete space.
    pub fn as_discrete(&self) -> Option<i64> {
        if let Self::Discrete(value) = self { Some(*value) } else { None }
    }
}

impl StateHash for SpaceValue {
    fn state_hash(&self, hasher: &mut StateHasher) {
        match self {
            Self::Discrete(value) => numbers(hasher, 0, std::iter::once(*value as u64)),
            Self::Box(entries) => numbers(hasher, 1, entries.iter().map(|entry| entry.to_bits())),
            Self::MultiBinary(bits) => numbers(hasher, 2, bits.iter().map(|bit| u64::from(*bit))),
            Self::MultiDiscrete(values) => numbers(hasher, 3, values.iter().map(|value| *value as u64)),
            Self::Text(text) => {
                hasher.u64(4).str(text);
            }
            Self::Dict(parts) => {
                hasher.u64(5).u64(parts.len() as u64);
                for (key, part) in parts {
                    part.state_hash(hasher.str(key));
                }
            }
            Self::Tuple(parts) => all(hasher, 6, parts),
            Self::Sequence(values) => all(hasher, 7, values),
            Self::Graph { nodes, edges, links } => {
                all(hasher, 8, nodes);
                all(hasher, 9, edges);
                numbers(hasher, 10, links.iter().map(|[from, to]| u64::from(*from) << 32 | u64::from(*to)));
            }
        }
    }
}

fn numbers(hasher: &mut StateHasher, kind: u64, numbers: impl ExactSizeIterator<Item = u64>) {
    hasher.u64(kind).u64(numbers.len() as u64);
    for number in numbers {
        hasher.u64(number);
    }
}

fn all(hasher: &mut StateHasher, kind: u64, values: &[SpaceValue]) {
    hasher.u64(kind).u64(values.len() as u64);
    for value in values {
        value.state_hash(hasher);
    }
}
