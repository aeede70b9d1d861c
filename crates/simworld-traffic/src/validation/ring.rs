//! The fundamental diagram of a ring: flow over density against the equilibrium of the car-following model.

use std::sync::Arc;

use simworld_core::geometry::{Point2, direction};
use simworld_core::net::{CrossSection, Street, StreetPlan};
use simworld_core::seed::Seed;

use super::streets::{LENGTH, derive, empty, mean};
use super::{Effort, Figure, Figures};
use crate::vehicle::Idm;
use crate::{Traffic, TrafficConfig};

const DT: f64 = 0.1;
const RADIUS: f64 = 160.0;
/// Streets of which the ring is made, and pieces of each.
const STREETS: usize = 4;
const PIECES: usize = 24;

/// A ring of one lane without crossings, on which nothing but the driver limits the speed.
fn plan() -> StreetPlan {
    let mut plan = StreetPlan::default();
    let section = plan.add_section(CrossSection::plain(1, 0, 3.5, 0.0));
    let at = |piece: usize| {
        let turn = std::f64::consts::TAU * piece as f64 / (STREETS * PIECES) as f64;
        Point2::origin() + direction(turn) * RADIUS
    };
    plan.nodes.extend((0..STREETS).map(|street| at(street * PIECES)));
    plan.streets.extend((0..STREETS).map(|street| Street {
        section,
        via: (1..PIECES).map(|piece| at(street * PIECES + piece)).collect(),
        speed_limit: Some(20.0),
        ..Street::simple(street, (street + 1) % STREETS)
    }));
    plan
}

/// Flow in equilibrium at a density, veh/s, by the model: the speed at which the gap is what the density leaves.
fn equilibrium(idm: &Idm, density: f64) -> f64 {
    let gap = 1.0 / density - LENGTH;
    let (mut low, mut high) = (0.0, idm.desired_speed);
    for _ in 0..60 {
        let middle = (low + high) * 0.5;
        if idm.equilibrium_gap(middle) < gap { low = middle } else { high = middle }
    }
    density * low
}

pub(super) fn measure(effort: Effort) -> Figures {
    let network = Arc::new(derive(&plan())?);
    let length: f64 = network.lanes.iter().map(|lane| lane.length).sum::<f64>()
        + network.connections.iter().map(|way| way.length).sum::<f64>();
    let config = empty();
    let mut figures = Vec::new();
    let all = [5.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 75.0, 90.0, 105.0];
    for per_km in effort.pick(&all[1..7], &all[..]) {
        let vehicles = (per_km * length / 1000.0) as u32;
        let mut traffic =
            Traffic::new(Arc::clone(&network), &TrafficConfig { vehicles, ..config.clone() }, Seed(3))?;
        let placed = traffic.placed().vehicles;
        let mut speeds = Vec::new();
        for step in 0..effort.pick(6_000, 18_000) {
            traffic.step(DT);
            if step % 50 == 0 && step > effort.pick(3_000, 9_000) {
                speeds.push(mean(traffic.stations().map(|vehicle| vehicle.3)));
            }
        }
        let density = f64::from(placed) / length;
        let flow = density * mean(speeds) * 3600.0;
        let expected = equilibrium(&Idm::default(), density) * 3600.0;
        let name = format!("flow at {:.0} vehicles a km", density * 1000.0);
        let source = "s_e = (s0 + v T) / √(1 - (v / v0)⁴), Treiber, Hennecke and Helbing 2000";
        figures.push(Figure::near(name, flow, expected, 0.02, "veh/h").cited(source));
    }
    Ok(figures)
}
