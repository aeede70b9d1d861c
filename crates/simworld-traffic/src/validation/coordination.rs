//! Green waves: who must stop on a street of three signals.

use std::sync::Arc;

use simworld_core::geometry::Point2;
use simworld_core::id::{IntersectionId, RoadId};
use simworld_core::net::{LaneDirection, RoadNetwork, Street, StreetPlan};
use simworld_core::seed::Seed;

use super::streets::{CAR, derive, empty};
use super::{Effort, Figure, Figures, ValidationError};
use crate::signal::green_wave;
use crate::{Leg, Route, Traffic};

const DT: f64 = 0.1;
/// Between two signals, m.
const BLOCK: f64 = 260.0;
/// Speed of the wave, m/s.
const WAVE: f64 = 11.5;

/// A street of four blocks with a crossing between any two.
fn street() -> Result<RoadNetwork, ValidationError> {
    let nodes = (0..5).map(|i| Point2::new(f64::from(i) * BLOCK, 0.0)).collect();
    let mut plan = StreetPlan { nodes, ..StreetPlan::default() };
    plan.streets.extend((0..4).map(|i| Street::simple(i, i + 1)));
    for i in 1..4 {
        for y in [-120.0, 120.0] {
            plan.nodes.push(Point2::new(i as f64 * BLOCK, y));
            plan.streets.push(Street::simple(i, plan.nodes.len() - 1));
        }
    }
    Ok(derive(&plan)?)
}

/// The share of a platoon of five a cycle that stops behind the first signal, which meters it; the offset of each signal is
/// moved by a share of the cycle against the one before.
fn stops(network: &Arc<RoadNetwork>, moved: f64) -> Result<f64, ValidationError> {
    let route = Route((0..4).map(|road| Leg::new(RoadId(road), LaneDirection::Forward)).collect());
    let way: Vec<IntersectionId> = (0..4).map(IntersectionId).collect();
    let mut traffic = Traffic::new(Arc::clone(network), &empty(), Seed(2))?;
    let mut plans = traffic.plans().to_vec();
    let tuned = green_wave(network, &way, WAVE, &mut plans);
    if tuned != 3 {
        return Err(ValidationError::Nothing {
            measure: "green wave",
            reason: format!("{tuned} signals in the wave"),
        });
    }
    let cycle = plans[0].cycle();
    for (rank, plan) in plans.iter_mut().enumerate() {
        plan.offset += moved * rank as f64 * cycle;
    }
    traffic.set_plans(plans)?;
    let (mut standing, mut stopped, mut sent, mut next) = (Vec::new(), 0, 0, 0.0);
    while traffic.seconds() < 900.0 {
        if traffic.seconds() >= next && next < 800.0 {
            // As the first green sends them on.
            next += cycle;
            for _ in 0..5 {
                traffic.insert(route.clone(), CAR)?;
                sent += 1;
            }
        }
        traffic.step(DT);
        for id in traffic.entered() {
            standing.resize(standing.len().max(*id as usize + 1), false);
            standing[*id as usize] = false;
        }
        for (id, track, _, v) in traffic.stations() {
            let lane = network.lanes.get(track as usize);
            if v < 0.1 && lane.is_some_and(|lane| lane.road.0 == 1 || lane.road.0 == 2) {
                stopped += u32::from(!std::mem::replace(&mut standing[id as usize], true));
            }
        }
    }
    Ok(f64::from(stopped) / f64::from(sent))
}

pub(super) fn measure(_: Effort) -> Figures {
    let network = Arc::new(street()?);
    let (tuned, against) = (stops(&network, 0.0)?, stops(&network, 0.5)?);
    Ok(vec![
        Figure::within("share that passes without a stop, in the wave", 1.0 - tuned, (0.9, 1.0), ""),
        Figure::within("share that passes without a stop, in anti-phase", 1.0 - against, (0.0, 0.2), ""),
    ])
}
