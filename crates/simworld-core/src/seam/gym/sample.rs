//! Random members of spaces.

use super::space::{Bounds, Space, SpaceValue, entries};
use crate::seed::StreamRng;

/// Texts, sequences and graphs are drawn no longer than this.
const LONGEST: usize = 32;

impl Space {
    /// A random member, as Gymnasium draws it: uniform between finite bounds, exponential (rate 1) from the only finite
    /// one, standard normal where there is none. Text is drawn from lower-case letters; texts, sequences and graphs
    /// have at most 32 parts.
    pub fn sample(&self, rng: &mut StreamRng) -> SpaceValue {
        match self {
            Self::Discrete { n, start } => SpaceValue::Discrete(integer(*n, *start, rng)),
            Self::Box { low, high, shape } => {
                let count = entries(shape).unwrap_or(0);
                SpaceValue::Box((0..count).map(|index| number(low, high, index, rng)).collect())
            }
            Self::MultiBinary { n } => SpaceValue::MultiBinary((0..*n).map(|_| rng.chance(0.5)).collect()),
            Self::MultiDiscrete { n, start } => {
                let each = n.iter().zip(start).map(|(n, start)| integer(*n, *start, rng));
                SpaceValue::MultiDiscrete(each.collect())
            }
            Self::Text { max_length } => {
                let length = rng.below((*max_length).min(LONGEST) + 1);
                SpaceValue::Text((0..length).map(|_| char::from(b'a' + rng.below(26) as u8)).collect())
            }
            Self::Dict(spaces) => {
                SpaceValue::Dict(spaces.iter().map(|(key, space)| (key.clone(), space.sample(rng))).collect())
            }
            Self::Tuple(spaces) => SpaceValue::Tuple(spaces.iter().map(|space| space.sample(rng)).collect()),
            Self::Sequence { of, max_length } => {
                let length = rng.below((*max_length).min(LONGEST) + 1);
                SpaceValue::Sequence((0..length).map(|_| of.sample(rng)).collect())
            }
            Self::Graph { node, edge, max_nodes, max_edges } => {
                let count = rng.below((*max_nodes).min(LONGEST) + 1);
                let nodes: Vec<_> = (0..count).map(|_| node.sample(rng)).collect();
                let most = if count == 0 { 0 } else { (*max_edges).min(LONGEST) };
                let links: Vec<[u32; 2]> = (0..rng.below(most + 1))
                    .map(|_| [rng.below(count) as u32, rng.below(count) as u32])
                    .collect();
                let edges = edge.iter().flat_map(|edge| vec![edge; links.len()]);
                let edges = edges.map(|edge| edge.sample(rng)).collect();
                SpaceValue::Graph { nodes, edges, links }
            }
        }
    }
}

fn integer(n: u64, start: i64, rng: &mut StreamRng) -> i64 {
    start.wrapping_add(rng.below(n as usize) as i64)
}

fn number(low: &Bounds, high: &Bounds, index: usize, rng: &mut StreamRng) -> f64 {
    let low = low.at(index).unwrap_or(f64::NEG_INFINITY);
    let high = high.at(index).unwrap_or(f64::INFINITY);
    match (low.is_finite(), high.is_finite()) {
        (true, true) => {
            // weighted instead of stepped, so that bounds at the ends of f64 do not overflow
            let part = rng.unit();
            (low * (1.0 - part) + high * part).clamp(low, high.max(low))
        }
        (true, false) => low + rng.exponential(1.0),
        (false, true) => high - rng.exponential(1.0),
        (false, false) => rng.normal(0.0, 1.0),
    }
}
