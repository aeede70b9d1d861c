//! What walking and running cost a body: metabolic power by speed, slope, load and ground.
//!
//! Walking after Pandolf, Givoni and Goldman, Predicting energy expenditure with loads while standing or walking very
//! slowly, Journal of Applied Physiology 43, 1977; running after the equation of the American College of Sports Medicine
//! (Guidelines for Exercise Testing and Prescription), with 20.1 J to a millilitre of oxygen. People change from the one to
//! the other where the Froude number is a half, about 2 m/s, a little before running becomes cheaper (Hreljac, Medicine
//! and Science in Sports and Exercise 25, 1993), so that the cost rises there at once.
//!
//! The ground counts for both: Pandolf's factor multiplies what moving costs beyond standing. For running it was measured
//! in sand alone, as 1.6 where it is 2.1 to 2.7 for walking (Lejeune, Willems and Heglund, Journal of Experimental Biology 201,
//! 1998); here it is the one of walking, so that nobody escapes from deep snow by running through it.

use serde::{Deserialize, Serialize};

use crate::environment::Cover;
use crate::geometry::Point3;

/// Acceleration of gravity, m/s².
const GRAVITY: f64 = 9.81;
/// Length of a leg, m: 0.53 of a height of 1.75 m.
const LEG: f64 = 0.93;
/// Froude number v²/(g l) at which people change from walking to running (Alexander 1989; Hreljac 1993).
const CHANGE: f64 = 0.5;
/// Who is no more than this above it still walks, m/s: a speed that follows from two places is off by rounding, and somebody who goes at just
/// that speed would walk or run by chance.
const ROUNDING: f64 = 1e-6;
/// J to a millilitre of oxygen.
const OXYGEN: f64 = 20.1;

/// What one walks on, by what it costs in relation to a treadmill (Soule and Goldman, Terrain coefficients for energy cost
/// prediction, Journal of Applied Physiology 32, 1972; snow: Pandolf, Haisman and Goldman, Ergonomics 19, 1976).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Terrain {
    /// Asphalt, concrete, floors.
    #[default]
    Paved,
    /// A dirt road.
    Dirt,
    /// Light brush, grass that is not cut.
    LightBrush,
    /// Heavy brush.
    HeavyBrush,
    /// Swamp.
    Swamp,
    /// Loose sand.
    Sand,
    /// Snow that is packed hard.
    PackedSnow,
    /// Soft snow in which one sinks in 15 cm.
    SoftSnow,
}

impl Terrain {
    /// Cost of walking in relation to a treadmill.
    pub const fn factor(self) -> f64 {
        match self {
            Self::Paved => 1.0,
            Self::Dirt => 1.1,
            Self::LightBrush => 1.2,
            Self::HeavyBrush => 1.5,
            Self::Swamp => 1.8,
            Self::Sand => 2.1,
            Self::PackedSnow => 1.6,
            Self::SoftSnow => 2.5,
        }
    }

    /// What a pavement is under that cover: snow is trodden, until there is as much of it as feet sink into.
    pub fn of_pavement(cover: &Cover) -> Self {
        /// Depth of the snow that the factor of [`SoftSnow`](Self::SoftSnow) was measured in, m.
        const DEEP: f64 = 0.15;
        match cover.snow_depth {
            depth if depth >= DEEP => Self::SoftSnow,
            depth if depth > 0.0 => Self::PackedSnow,
            _ => Self::Paved,
        }
    }
}

/// Who walks with what on what.
///
/// A task that keeps account of effort asks once a step, with where somebody was and where it is:
///
/// ```
/// use simworld_core::exertion::{Exertion, Terrain};
/// use simworld_core::geometry::Point3;
///
/// let courier = Exertion { body: 70.0, load: 15.0, terrain: Terrain::Paved };
/// let mut spent = 0.0;
/// let (dt, mut was) = (0.1, Point3::origin());
/// for step in 1..=600 {
///     let is = Point3::new(0.134 * f64::from(step), 0.0, 0.0); // a minute at 1.34 m/s
///     spent += courier.energy(&was, &is, dt);
///     was = is;
/// }
/// assert!((spent / 60.0 - 342.0).abs() < 1.0); // W
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Exertion {
    /// Mass of the body, kg, more than 0.
    pub body: f64,
    /// Mass of what it carries, kg, at least 0.
    pub load: f64,
    /// What it walks on.
    pub terrain: Terrain,
}

impl Default for Exertion {
    /// Somebody of 70 kg with empty hands on asphalt.
    fn default() -> Self {
        Self { body: 70.0, load: 0.0, terrain: Terrain::Paved }
    }
}

impl Exertion {
    /// Power of standing still, W.
    pub fn standing(&self) -> f64 {
        let share = self.load / self.body;
        1.5 * self.body + 2.0 * (self.body + self.load) * share * share
    }

    /// The speed at which people change from walking to running, m/s.
    pub fn change_to_running() -> f64 {
        (CHANGE * GRAVITY * LEG).sqrt()
    }

    /// Metabolic power, W, at a speed in m/s on a grade (rise over way in the plane, positive uphill). Downhill the equation
    /// of walking is beyond what was measured, and no less than standing costs is counted.
    pub fn power(&self, speed: f64, grade: f64) -> f64 {
        let mass = self.body + self.load;
        if speed > Self::change_to_running() + ROUNDING {
            // ml of oxygen for each kg and minute, from m/min.
            let per_minute = speed * 60.0;
            let oxygen = 3.5 + self.terrain.factor() * (0.2 * per_minute + 0.9 * per_minute * grade);
            return (oxygen.max(3.5) / 60.0 * OXYGEN * mass).max(self.standing());
        }
        let moving = mass * (1.5 * speed * speed + 0.35 * speed * (100.0 * grade));
        self.standing() + (self.terrain.factor() * moving).max(0.0)
    }

    /// Energy of a move within `dt` s from one place to another, J.
    pub fn energy(&self, from: &Point3, to: &Point3, dt: f64) -> f64 {
        let way = (to - from).xy().norm();
        let grade = if way > 0.0 { (to.z - from.z) / way } else { 0.0 };
        self.power(way / dt, grade) * dt
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn person(load: f64) -> Exertion {
        Exertion { load, ..Exertion::default() }
    }

    #[test]
    fn the_four_rows_of_pandolf() {
        let rows = [(0.0, 0.0, 294.0), (5.0, 0.0, 308.0), (15.0, 0.0, 342.0), (0.0, 0.05, 458.0)];
        for (load, grade, watts) in rows {
            let power = person(load).power(1.34, grade);
            assert!((power - watts).abs() < 1.0, "{load} kg, grade {grade}: {power} W and not {watts}");
        }
    }

    #[test]
    fn running_costs_a_kilocalorie_for_each_kilogram_and_kilometre() {
        for speed in [2.5, 3.0, 4.0] {
            let net = person(0.0).power(speed, 0.0) - 3.5 / 60.0 * OXYGEN * 70.0;
            let per_kg_km = net / 70.0 / speed * 1000.0 / 4184.0;
            assert!((per_kg_km - 1.0).abs() < 0.05, "{per_kg_km} kcal/kg/km at {speed} m/s");
        }
        let change = Exertion::change_to_running();
        assert!((1.9..2.3).contains(&change), "{change}");
        let (below, above) =
            (person(0.0).power(change, 0.0), person(0.0).power(change + 2.0 * ROUNDING, 0.0));
        assert!(above > below && above < 1.25 * below, "{below} to {above} W");
        let (from, to) = (Point3::new(512.3, 77.1, 0.0), Point3::new(512.3 + 0.1 * change, 77.1, 0.0));
        assert!(
            (person(0.0).energy(&from, &to, 0.1) - 0.1 * below).abs() < 1e-6,
            "rounding makes nobody run"
        );
    }

    #[test]
    fn power_never_falls_with_speed_load_or_slope() {
        for step in 0..60 {
            let speed = 0.05 * f64::from(step);
            assert!(person(0.0).power(speed + 0.05, 0.0) > person(0.0).power(speed, 0.0));
            assert!(person(5.0).power(speed, 0.0) > person(0.0).power(speed, 0.0));
            assert!(person(0.0).power(speed, 0.1) >= person(0.0).power(speed, 0.0));
            assert!(person(0.0).power(speed, -0.5) >= person(0.0).standing());
        }
        let sand = Exertion { terrain: Terrain::Sand, ..Exertion::default() };
        assert!(sand.power(1.34, 0.0) > 1.6 * person(0.0).power(1.34, 0.0));
    }

    #[test]
    fn nobody_escapes_from_deep_snow_by_running() {
        let snow = Exertion { terrain: Terrain::SoftSnow, ..Exertion::default() };
        for step in 0..60 {
            let speed = 0.05 * f64::from(step);
            assert!(snow.power(speed + 0.05, 0.0) > snow.power(speed, 0.0), "{speed} m/s");
        }
        // 70 kg · (3.5 + 2.5 · 0.2 · 150 m/min) ml of oxygen a minute.
        assert!((snow.power(2.5, 0.0) - 70.0 * 78.5 / 60.0 * OXYGEN).abs() < 1e-9);
    }

    #[test]
    fn snow_on_a_pavement_is_trodden_until_it_is_deep() {
        let under = |snow_depth| Terrain::of_pavement(&Cover { snow_depth, ..Cover::default() });
        assert_eq!(
            [0.0, 0.01, 0.08, 0.15, 1.0].map(under),
            [Terrain::Paved, Terrain::PackedSnow, Terrain::PackedSnow, Terrain::SoftSnow, Terrain::SoftSnow]
        );
        assert_eq!(Terrain::of_pavement(&Cover { wetness: 1.0, ..Cover::default() }), Terrain::Paved);
    }
}
