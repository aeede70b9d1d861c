//! Following: gaps in equilibrium, and how a wave runs along a platoon.

use nalgebra::Complex;
use simworld_core::ops;

use super::streets::LENGTH;
use super::{Effort, Figure, Figures, ValidationError};
use crate::vehicle::{CarFollowing, Idm, Leader, Perception, advance};

const DT: f64 = 0.05;
/// Followers.
const COUNT: usize = 8;

/// A file of cars that begins in equilibrium behind a leader.
struct File {
    driver: Idm,
    model: CarFollowing,
    /// Time from one decision to the next, s; 0 for every step.
    reaction_time: f64,
    steps: u64,
    /// Place of the front, speed and last acceleration, the leader first.
    cars: Vec<(f64, f64, f64)>,
}

impl File {
    fn new(driver: Idm, model: CarFollowing, v: f64) -> Self {
        let step = model.equilibrium_gap(&driver, v) + LENGTH;
        let cars = (0..=COUNT).map(|rank| (-step * rank as f64, v, 0.0)).collect();
        Self { driver, model, reaction_time: 0.0, steps: 0, cars }
    }

    fn gap(&self, rank: usize) -> f64 {
        self.cars[rank - 1].0 - LENGTH - self.cars[rank].0
    }

    /// A step in which the leader takes up a speed.
    fn step(&mut self, leader: f64) {
        let late = Perception { reaction_time: self.reaction_time, ..Perception::default() };
        let asked: Vec<f64> = (1..=COUNT)
            .map(|rank| {
                let (_, v, held) = self.cars[rank];
                if !late.decides(rank as u32, self.steps, DT) {
                    return held;
                }
                let (_, speed, acceleration) = self.cars[rank - 1];
                let leader = Leader { gap: self.gap(rank), speed, acceleration };
                self.model.acceleration(&self.driver, v, self.driver.desired_speed, Some(leader), DT)
            })
            .collect();
        self.steps += 1;
        let (at, before, _) = self.cars[0];
        self.cars[0] = (at + (before + leader) * 0.5 * DT, leader, (leader - before) / DT);
        for (car, acceleration) in self.cars[1..].iter_mut().zip(asked) {
            let (v, way) = advance(car.1, acceleration, DT);
            *car = (car.0 + way, v, acceleration);
        }
    }
}

/// The models that are measured; Krauss without imperfection, of which the theory knows nothing.
const MODELS: [(&str, CarFollowing); 3] = [
    ("IDM", CarFollowing::Idm),
    ("Krauss", CarFollowing::Krauss { sigma: 0.0 }),
    ("ACC", CarFollowing::Acc { coolness: 0.99 }),
];

const SOURCE: &str = "Treiber, Hennecke and Helbing 2000; Treiber and Kesting 2013, chapter 15";

pub(super) fn equilibrium(effort: Effort) -> Figures {
    let driver = Idm::default();
    let mut figures = Vec::new();
    for (word, model) in MODELS {
        for v in [2.0, 5.0, 8.0, 11.0, 13.0] {
            // It begins elsewhere and settles.
            let mut file = File::new(driver, model, v * 0.7);
            for _ in 0..effort.pick(24_000, 60_000) {
                file.step(v);
            }
            let name = format!("gap of the last follower by {word} at {v} m/s");
            let expected = model.equilibrium_gap(&driver, v);
            figures.push(Figure::near(name, file.gap(COUNT), expected, 0.01, "m").cited(SOURCE));
        }
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
    fn at(driver: &Idm, model: CarFollowing, v: f64) -> Self {
        const H: f64 = 1e-4;
        let (s, free) = (model.equilibrium_gap(driver, v), driver.desired_speed);
        let a = |gap: f64, v: f64, speed: f64| {
            model.acceleration(driver, v, free, Some(Leader { gap, speed, acceleration: 0.0 }), DT)
        };
        let slope = |high: f64, low: f64| (high - low) / (2.0 * H);
        Self {
            gap: slope(a(s + H, v, v), a(s - H, v, v)),
            own: slope(a(s, v + H, v), a(s, v - H, v)),
            leader: slope(a(s, v, v + H), a(s, v, v - H)),
        }
    }

    /// By how much each follower amplifies a wave of so many radians a second, in steps of [`DT`]: speeds change by
    /// `dt (f_s s + f_v v + f_l v_l)`, gaps by the mean of the speeds at both ends of a step. As the step goes to nothing it is
    /// the formula of the book.
    ///
    /// Who decides every so many steps goes on as he last decided: in the mean over these steps, `1/n (1 + z⁻¹ + ...)` of what
    /// perfect drivers do. What the sampling brings in from other frequencies is left out.
    fn amplification(&self, omega: f64, reaction_time: f64) -> f64 {
        let z = Complex::from_polar(1.0, omega * DT);
        let steps = (reaction_time / DT).round().max(1.0) as i32;
        let held = (0..steps).map(|step| z.powi(-step)).sum::<Complex<f64>>() / f64::from(steps);
        let sum = (z + 1.0) / (z - 1.0) * (DT * 0.5);
        let above = held * (sum * self.gap + self.leader);
        let below = (z - 1.0) / DT - held * (Complex::from(self.own) - sum * self.gap);
        (above / below).norm()
    }

    /// Whether all long waves fade.
    fn is_stable(&self) -> bool {
        self.own * self.own - self.leader * self.leader > 2.0 * self.gap
    }
}

/// By how much each follower amplifies a small wave of the leader, measured from the second to the last.
fn measured(mut file: File, v: f64, omega: f64) -> f64 {
    const SMALL: f64 = 0.01;
    let period = (std::f64::consts::TAU / omega / DT) as u32;
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
    let own = MODELS.map(|(word, model)| (word, Idm::default(), model));
    let others = [
        ("sluggish IDM, 0.5 m/s²", sluggish, CarFollowing::Idm),
        ("sluggish ACC, 0.5 m/s²", sluggish, CarFollowing::Acc { coolness: 0.99 }),
    ];
    for (name, driver, model) in own.into_iter().chain(others) {
        for v in [4.0, 8.0, 12.0] {
            let linear = Linear::at(&driver, model, v);
            let mut grows = false;
            for seconds in [30.0, 60.0] {
                let omega = std::f64::consts::TAU / seconds;
                let found = measured(File::new(driver, model, v), v, omega);
                grows |= found > 1.0;
                let label = format!("growth a follower, {name} at {v} m/s, waves of {seconds} s");
                let expected = linear.amplification(omega, 0.0);
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

/// Late decisions: a platoon that is stable when everybody decides at once is not when they decide late.
pub(super) fn late_decisions(_: Effort) -> Figures {
    const V: f64 = 8.0;
    let (driver, model) = (Idm::default(), CarFollowing::Idm);
    let linear = Linear::at(&driver, model, V);
    let mut figures = Vec::new();
    for reaction_time in [0.4, 0.8, 1.2, 1.6] {
        let (mut grows, mut should) = (false, false);
        for seconds in [10.0, 15.0, 30.0] {
            let omega = std::f64::consts::TAU / seconds;
            let found = measured(File { reaction_time, ..File::new(driver, model, V) }, V, omega);
            let expected = linear.amplification(omega, reaction_time);
            (grows, should) = (grows || found > 1.0, should || expected > 1.0);
            let label = format!("growth a follower, deciding every {reaction_time} s, waves of {seconds} s");
            // With less than ten decisions a wave what the sampling brings in from other frequencies begins to count.
            let share = if seconds < 10.0 * reaction_time { 0.08 } else { 0.03 };
            figures.push(Figure::near(label, found, expected, share, "").cited(SOURCE));
        }
        let agrees = if grows == should { 1.0 } else { 0.0 };
        let word = if should { "unstable" } else { "stable" };
        let label = format!("deciding every {reaction_time} s is {word}, as the theory says");
        figures.push(Figure::within(label, agrees, (1.0, 1.0), "").cited(SOURCE));
    }
    if figures.iter().any(|figure| figure.value.is_nan()) {
        let reason = "nobody followed".to_owned();
        return Err(ValidationError::Nothing { measure: "late decisions", reason });
    }
    Ok(figures)
}
