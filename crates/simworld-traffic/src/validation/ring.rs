//! The fundamental diagram of a ring: flow over density against the equilibrium of the car-following model, and beyond the
//! density at which that equilibrium is unstable against the model alone, cars on a circle without lanes and junctions.

use std::sync::Arc;

use simworld_core::geometry::{Point2, direction};
use simworld_core::net::{CrossSection, RoadNetwork, Street, StreetPlan};
use simworld_core::seed::Seed;

use super::streets::{LENGTH, derive, empty, mean};
use super::{Effort, Figure, Figures, ValidationError};
use crate::vehicle::{CarFollowing, Idm, Perception, VehicleType, advance};
use crate::{Traffic, TrafficConfig};

const DT: f64 = 0.1;
const STABLE: &str =
    "linear theory: the default driver is stable up to 72 vehicles a km, above 7 m/s (see platoon)";
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

/// What was seen of a ring.
struct Seen {
    /// veh/m.
    density: f64,
    /// veh/s.
    flow: f64,
    /// Standard deviation of the speeds over their mean.
    spread: f64,
}

/// Mean flow and spread of speeds, looked at every five seconds of the second half of a run of so many steps.
fn watch(steps: u32, density: f64, mut speeds_after: impl FnMut(u32) -> Vec<f64>) -> Seen {
    let (mut means, mut squares) = (Vec::new(), Vec::new());
    for step in 0..steps {
        let speeds = speeds_after(step);
        if step % 50 == 0 && step > steps / 2 {
            means.push(mean(speeds.iter().copied()));
            squares.push(mean(speeds.iter().map(|v| v * v)));
        }
    }
    let (v, square) = (mean(means), mean(squares));
    Seen { density, flow: density * v, spread: (square - v * v).max(0.0).sqrt() / v }
}

/// The traffic on a ring with so many vehicles, and where they stood at the start, m along the ring.
fn driven(network: &Arc<RoadNetwork>, per_km: f64, steps: u32) -> Result<(Seen, Vec<f64>), ValidationError> {
    let length = ring_length(network);
    let vehicles = (per_km * length / 1000.0) as u32;
    let mut traffic = Traffic::new(Arc::clone(network), &TrafficConfig { vehicles, ..empty() }, Seed(3))?;
    let begins = |track: u32| -> f64 {
        let before = &network.lanes[..track as usize];
        before.iter().map(|lane| lane.length + network.connections[lane.outgoing[0].index()].length).sum()
    };
    let mut places: Vec<f64> = traffic.stations().map(|(_, track, s, _)| begins(track) + s).collect();
    places.sort_by(|a, b| b.total_cmp(a));
    let seen = watch(steps, f64::from(traffic.placed().vehicles) / length, |_| {
        traffic.step(DT);
        traffic.stations().map(|vehicle| vehicle.3).collect()
    });
    Ok((seen, places))
}

/// The model alone: cars on a circle of that length, at rest at these places, front to back.
fn ideal(idm: &Idm, length: f64, places: &[f64], steps: u32) -> Seen {
    let mut cars: Vec<(f64, f64)> = places.iter().map(|place| (*place, 0.0)).collect();
    let mut asked = vec![0.0; cars.len()];
    watch(steps, cars.len() as f64 / length, |_| {
        for (rank, asked) in asked.iter_mut().enumerate() {
            let (s, v) = cars[rank];
            // The last of them leads the first, once round.
            let (leader, speed) = if rank == 0 { cars[cars.len() - 1] } else { cars[rank - 1] };
            let ahead = if rank == 0 { leader + length } else { leader };
            *asked = idm.acceleration(v, idm.desired_speed, ahead - LENGTH - s, speed);
        }
        for (car, acceleration) in cars.iter_mut().zip(&asked) {
            let (v, way) = advance(car.1, *acceleration, DT);
            *car = (car.0 + way, v);
        }
        cars.iter().map(|car| car.1).collect()
    })
}

fn ring_length(network: &RoadNetwork) -> f64 {
    network.lanes.iter().map(|lane| lane.length).sum::<f64>()
        + network.connections.iter().map(|way| way.length).sum::<f64>()
}

pub(super) fn measure(effort: Effort) -> Figures {
    let network = Arc::new(derive(&plan())?);
    let idm = Idm::default();
    let steps = effort.pick(12_000, 36_000);
    let mut figures = Vec::new();
    let all = [5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 35.0, 40.0, 50.0, 60.0];
    for per_km in effort.pick(&all[3..9], &all[..]) {
        let (seen, _) = driven(&network, *per_km, steps)?;
        let expected = equilibrium(&idm, seen.density) * 3600.0;
        let name = format!("flow at {:.0} vehicles a km", seen.density * 1000.0);
        let source = "s_e = (s0 + v T) / √(1 - (v / v0)⁴), Treiber, Hennecke and Helbing 2000";
        figures.push(Figure::near(name, seen.flow * 3600.0, expected, 0.02, "veh/h").cited(source));
        let name = format!("spread of speeds at {:.0} vehicles a km", seen.density * 1000.0);
        figures.push(Figure::within(name, seen.spread, (0.0, 0.02), "").cited(STABLE));
    }
    for per_km in effort.pick(&[90.0][..], &[80.0, 90.0, 105.0]) {
        let (seen, places) = driven(&network, *per_km, steps)?;
        let alone = ideal(&idm, ring_length(&network), &places, steps);
        let name = format!("flow at {:.0} vehicles a km, in waves", seen.density * 1000.0);
        let source =
            "the model alone, on a circle from the same places; a ring in equilibrium would be at the curve";
        figures
            .push(Figure::near(name, seen.flow * 3600.0, alone.flow * 3600.0, 0.02, "veh/h").cited(source));
        let name = format!("spread of speeds at {:.0} vehicles a km", seen.density * 1000.0);
        figures.push(Figure::within(name, seen.spread, (0.3, f64::INFINITY), "").cited(STABLE));
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
