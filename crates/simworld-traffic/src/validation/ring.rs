//! The fundamental diagram of a ring: flow over density against the equilibrium of the car-following model.

use std::sync::Arc;

use simworld_core::geometry::{Point2, direction};
use simworld_core::net::{CrossSection, RoadNetwork, Street, StreetPlan};
use simworld_core::seed::Seed;

use super::streets::{LENGTH, derive, empty, mean};
use super::{Effort, Figure, Figures, ValidationError};
use crate::vehicle::{CarFollowing, Idm, Perception, VehicleType};
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

/// How much speeds on the ring differ from their mean, m/s, with drivers of a type: over time and vehicles.
fn deviation(network: &Arc<RoadNetwork>, car: VehicleType, effort: Effort) -> Result<f64, ValidationError> {
    let length: f64 = network.lanes.iter().map(|lane| lane.length).sum();
    let vehicles = (25.0 * length / 1000.0) as u32;
    let config = TrafficConfig { vehicles, types: vec![car], ..empty() };
    let mut traffic = Traffic::new(Arc::clone(network), &config, Seed(4))?;
    let mut speeds = Vec::new();
    for step in 0..effort.pick(18_000, 36_000) {
        traffic.step(DT);
        if step % 20 == 0 && step > 12_000 {
            speeds.extend(traffic.stations().map(|vehicle| vehicle.3));
        }
    }
    let middle = mean(speeds.iter().copied());
    Ok(mean(speeds.iter().map(|speed| (speed - middle) * (speed - middle))).sqrt())
}

/// Errors: speeds that are steady with perfect drivers are not with others, the less the worse they see.
pub(super) fn errors(effort: Effort) -> Figures {
    let network = Arc::new(derive(&plan())?);
    let of = |gap_error: f64| {
        let none = Perception { reaction_time: 0.0, speed_error: 0.0, gap_error, ..Perception::default() };
        let car = VehicleType { perception: Some(none), ..empty().types[0].clone() };
        deviation(&network, car, effort)
    };
    let (none, small, large) = (of(0.0)?, of(0.05)?, of(0.1)?);
    let krauss = |sigma: f64| {
        let car = VehicleType { model: CarFollowing::Krauss { sigma }, ..empty().types[0].clone() };
        deviation(&network, car, effort)
    };
    let (calm, half, whole) = (krauss(0.0)?, krauss(0.5)?, krauss(1.0)?);
    Ok(vec![
        Figure::within("deviation of speeds, perfect drivers", none, (0.0, 0.02), "m/s"),
        Figure::within("with gaps misjudged by 5 %", small, (0.03, 1.0), "m/s"),
        Figure::within("with 10 %, over that with 5 %", large / small, (1.7, 2.3), ""),
        Figure::within("by Krauss with sigma 0", calm, (0.0, 0.02), "m/s"),
        Figure::within("by Krauss with sigma 0.5", half, (0.01, 2.0), "m/s"),
        Figure::within("with sigma 1, over that with 0.5", whole / half, (1.7, 2.3), ""),
    ])
}
