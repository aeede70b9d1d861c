//! Turning shares against the weights by which they are drawn.

use simworld_core::net::{StreetPlan, Turn};
use simworld_core::seed::Seed;
use std::sync::Arc;

use super::streets::{derive, empty};
use super::{Effort, Figure, Figures};
use crate::{Traffic, TrafficConfig};

/// Weights of straight on, right and left.
const WEIGHTS: [f64; 3] = [0.5, 0.3, 0.2];

pub(super) fn measure(effort: Effort) -> Figures {
    let config = TrafficConfig { vehicles: 40, turns: WEIGHTS, ..empty() };
    let network = Arc::new(derive(&StreetPlan::crossroads(150.0))?);
    let mut traffic = Traffic::new(Arc::clone(&network), &config, Seed(6))?;
    let lanes = network.lanes.len();
    let mut before = vec![u32::MAX; traffic.placed().vehicles as usize];
    let mut turns = [0.0_f64; 3];
    for _ in 0..effort.pick(60_000, 300_000) {
        traffic.step(0.1);
        for (id, track, _, _) in traffic.stations() {
            let old = std::mem::replace(&mut before[id as usize], track);
            if old == track || (track as usize) < lanes {
                continue;
            }
            match network.connections[track as usize - lanes].turn {
                Turn::Straight => turns[0] += 1.0,
                Turn::Right => turns[1] += 1.0,
                Turn::Left => turns[2] += 1.0,
                Turn::UTurn => {}
            }
        }
    }
    let total: f64 = turns.iter().sum();
    let squares = turns.iter().zip(WEIGHTS).map(|(count, share)| {
        let expected = total * share;
        (count - expected) * (count - expected) / expected
    });
    let source = "chi-square with two degrees of freedom: 13.8 at the level of 0.1 %";
    Ok(vec![
        Figure::within("turns", total, (2000.0, f64::INFINITY), ""),
        Figure::within("chi-square of their shares", squares.sum(), (0.0, 13.8), "").cited(source).stated(),
    ])
}
