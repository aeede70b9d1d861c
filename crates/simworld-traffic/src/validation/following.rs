//! Following: gaps in equilibrium, and how a wave runs along a platoon.

use simworld_core::ops;

use super::streets::LENGTH;
use super::{Effort, Figure, Figures, ValidationError};
use crate::vehicle::{Idm, advance};

const DT: f64 = 0.05;
/// Followers.
const COUNT: usize = 8;

/// A file of cars that begins in equilibrium behind a leader.
struct File {
    idm: Idm,
    /// Place of the front and speed, the leader first.
    cars: Vec<(f64, f64)>,
}

impl File {
    fn new(idm: Idm, v: f64) -> Self {
        let step = idm.equilibrium_gap(v) + LENGTH;
        Self { idm, cars: (0..=COUNT).map(|rank| (-step * rank as f64, v)).collect() }
    }

    fn gap(&self, rank: usize) -> f64 {
        self.cars[rank - 1].0 - LENGTH - self.cars[rank].0
    }

    /// A step in which the leader takes up a speed.
    fn step(&mut self, leader: f64) {
        let asked: Vec<f64> = (1..=COUNT)
            .map(|rank| {
                let (_, v) = self.cars[rank];
                self.idm.acceleration(v, self.idm.desired_speed, self.gap(rank), self.cars[rank - 1].1)
            })
            .collect();
        let (_, before) = self.cars[0];
        self.cars[0] = (self.cars[0].0 + (before + leader) * 0.5 * DT, leader);
        for (car, acceleration) in self.cars[1..].iter_mut().zip(asked) {
            let (v, way) = advance(car.1, acceleration, DT);
            *car = (car.0 + way, v);
        }
    }
}

const SOURCE: &str = "Treiber, Hennecke and Helbing 2000; Treiber and Kesting 2013, chapter 15";

pub(super) fn equilibrium(effort: Effort) -> Figures {
    let idm = Idm::default();
    let mut figures = Vec::new();
    for v in [2.0, 5.0, 8.0, 11.0, 13.0] {
        // It begins elsewhere and settles.
        let mut file = File::new(idm, v * 0.7);
        for _ in 0..effort.pick(24_000, 60_000) {
            file.step(v);
        }
        let name = format!("gap of the last follower at {v} m/s");
        figures.push(Figure::near(name, file.gap(COUNT), idm.equilibrium_gap(v), 0.01, "m").cited(SOURCE));
    }
    if figures.iter().any(|figure| figure.value.is_nan()) {
        return Err(ValidationError::Nothing {
            measure: "equilibrium gap",
            reason: "nobody followed".to_owned(),
        });
    }
    Ok(figures)
}

/// The model near an equilibrium: how its acceleration changes with gap, own speed and leader's speed.
struct Linear {
    gap: f64,
    own: f64,
    leader: f64,
}

impl Linear {
    fn at(idm: &Idm, v: f64) -> Self {
        const H: f64 = 1e-4;
        let (s, free) = (idm.equilibrium_gap(v), idm.desired_speed);
        let a = |s: f64, v: f64, leader: f64| idm.acceleration(v, free, s, leader);
        let slope = |high: f64, low: f64| (high - low) / (2.0 * H);
        Self {
            gap: slope(a(s + H, v, v), a(s - H, v, v)),
            own: slope(a(s, v + H, v), a(s, v - H, v)),
            leader: slope(a(s, v, v + H), a(s, v, v - H)),
        }
    }

    /// By how much each follower amplifies a wave of so many radians a second.
    fn amplification(&self, omega: f64) -> f64 {
        let above = ops::hypot(self.gap, omega * self.leader);
        above / ops::hypot(self.gap - omega * omega, -omega * self.own)
    }

    /// Whether all long waves fade.
    fn is_stable(&self) -> bool {
        self.own * self.own - self.leader * self.leader > 2.0 * self.gap
    }
}

/// By how much each follower amplifies a small wave of the leader, measured from the second to the last.
fn measured(idm: Idm, v: f64, omega: f64) -> f64 {
    const SMALL: f64 = 0.01;
    let period = (std::f64::consts::TAU / omega / DT) as u32;
    let mut file = File::new(idm, v);
    let mut reach = [(f64::INFINITY, f64::NEG_INFINITY); COUNT + 1];
    let periods = 400.0 / (f64::from(period) * DT) + 12.0;
    for step in 0..(f64::from(period) * periods) as u32 {
        file.step(v + SMALL * ops::sin(omega * f64::from(step) * DT));
        if f64::from(step) > f64::from(period) * (periods - 3.0) {
            for (reach, car) in reach.iter_mut().zip(&file.cars) {
                *reach = (reach.0.min(car.1), reach.1.max(car.1));
            }
        }
    }
    let size = |rank: usize| reach[rank].1 - reach[rank].0;
    ops::pow(size(COUNT) / size(2), 1.0 / (COUNT - 2) as f64)
}

pub(super) fn platoon(_: Effort) -> Figures {
    let sluggish = Idm { acceleration: 0.5, ..Idm::default() };
    let mut figures = Vec::new();
    for (name, idm) in [("default", Idm::default()), ("sluggish, 0.5 m/s²", sluggish)] {
        for v in [4.0, 8.0, 12.0] {
            let linear = Linear::at(&idm, v);
            let mut grows = false;
            for seconds in [30.0, 60.0] {
                let omega = std::f64::consts::TAU / seconds;
                let found = measured(idm, v, omega);
                grows |= found > 1.0;
                let label = format!("growth a follower, {name} at {v} m/s, waves of {seconds} s");
                let expected = linear.amplification(omega);
                figures.push(Figure::near(label, found, expected, 0.02, "").cited(SOURCE));
            }
            let agrees = if grows == linear.is_stable() { 0.0 } else { 1.0 };
            let word = if linear.is_stable() { "stable" } else { "unstable" };
            let label = format!("{name} at {v} m/s is {word}, as the criterion says");
            figures.push(Figure::within(label, agrees, (1.0, 1.0), "").cited(SOURCE));
        }
    }
    if figures.iter().any(|figure| figure.value.is_nan()) {
        return Err(ValidationError::Nothing { measure: "platoon", reason: "nobody followed".to_owned() });
    }
    Ok(figures)
}
