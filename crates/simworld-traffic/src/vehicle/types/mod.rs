//! The types of vehicles: one table of sizes and drivers.

mod kind;
mod table;

pub use kind::VehicleKind;
use serde::{Deserialize, Serialize};
use simworld_core::scene::Shape;
use simworld_core::seed::StreamRng;
pub use table::standard_types;

use super::{CarFollowing, Idm, Leader, Perception};
use crate::{TrafficConfig, TrafficError};

/// Vehicles longer than this swing out of their lane in a turn, m.
const LONG: f64 = 8.0;

/// A type of vehicle: one row of [`TrafficConfig::types`](crate::TrafficConfig::types).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct VehicleType {
    /// What it is.
    pub kind: VehicleKind,
    /// Its weight among those that are placed or drawn, in [0, 1000]; 0 for those that come only when asked for.
    pub share: f64,
    /// Length, m, in [0.5, 30].
    pub length: f64,
    /// Width, m, in [0.3, 3].
    pub width: f64,
    /// Height, m, in [0.5, 5].
    pub height: f64,
    /// The mean of the speeds that drivers choose, as a share of the speed limit, in [0.2, 2]; of emergency vehicles with their
    /// siren on, which without it drive at the limit on average.
    pub speed_factor: f64,
    /// The standard deviation of that share, in [0, 0.3]; it is drawn once a vehicle, within two deviations.
    pub speed_deviation: f64,
    /// Its own highest speed, its gaps, how it accelerates and brakes, by whichever model.
    pub driver: Idm,
    /// The model by which it follows.
    pub model: CarFollowing,
    /// How its driver sees and how quickly he decides; `None` is perfect.
    pub perception: Option<Perception>,
    /// Whether it comes with its siren on; for emergency vehicles only.
    pub siren: bool,
}

impl Default for VehicleType {
    /// A passenger car.
    fn default() -> Self {
        table::car()
    }
}

impl VehicleType {
    /// Its solid.
    pub fn shape(&self) -> Shape {
        Shape::cuboid(self.length, self.width, self.height)
    }

    /// The speed on a road of that limit of a driver with that factor, m/s.
    #[inline]
    pub(crate) fn free_speed(&self, config: &TrafficConfig, factor: f32, limit: f64) -> f64 {
        self.driver.free_speed(config, factor, limit)
    }

    /// Whether there is more to it than the IDM of a perfect driver.
    #[inline]
    pub(crate) fn drives_otherwise(&self) -> bool {
        !matches!(self.model, CarFollowing::Idm) || self.perception.is_some()
    }

    /// The acceleration at a speed, with a free speed, behind something at a gap with a speed, m and m/s; an infinite gap is a
    /// free road.
    #[inline]
    pub(crate) fn drive(&self, v: f64, free: f64, (gap, speed): (f64, f64), dt: f64) -> f64 {
        let leader = Leader { gap, speed, acceleration: f64::NEG_INFINITY };
        self.model.acceleration(&self.driver, v, free, gap.is_finite().then_some(leader), dt)
    }

    /// Draws the factor of one vehicle.
    pub(crate) fn draw_factor(&self, rng: &mut StreamRng) -> f32 {
        let spread = 2.0 * self.speed_deviation;
        let (low, high) = (self.speed_factor - spread, self.speed_factor + spread);
        rng.normal_clamped(self.speed_factor, self.speed_deviation, low, high) as f32
    }

    /// Checks every field against its range.
    pub(crate) fn validate(&self, index: usize) -> Result<(), TrafficError> {
        let Idm { desired_speed, headway, gap, acceleration, deceleration, emergency_deceleration } =
            self.driver;
        let perception = self.perception.as_ref().map(Perception::ranges);
        let checks = [
            ("share", self.share, 0.0, 1000.0, "0 to 1000"),
            ("length", self.length, 0.5, 30.0, "0.5 to 30 m"),
            ("width", self.width, 0.3, 3.0, "0.3 to 3 m"),
            ("height", self.height, 0.5, 5.0, "0.5 to 5 m"),
            ("speed_factor", self.speed_factor, 0.2, 2.0, "0.2 to 2"),
            ("speed_deviation", self.speed_deviation, 0.0, 0.3, "0 to 0.3"),
            (
                "speed_deviation",
                self.speed_deviation,
                0.0,
                self.speed_factor * 0.4,
                "at most 0.4 of the factor",
            ),
            ("driver.desired_speed", desired_speed, 1.0, 70.0, "1 to 70 m/s"),
            ("driver.headway", headway, 0.3, 5.0, "0.3 to 5 s"),
            ("driver.gap", gap, 0.5, 10.0, "0.5 to 10 m"),
            ("driver.acceleration", acceleration, 0.2, 6.0, "0.2 to 6 m/s²"),
            ("driver.deceleration", deceleration, 0.5, 6.0, "0.5 to 6 m/s²"),
            (
                "driver.emergency_deceleration",
                emergency_deceleration,
                deceleration,
                12.0,
                "deceleration to 12 m/s²",
            ),
        ];
        for (field, value, low, high, allowed) in
            checks.into_iter().chain(self.model.own_range()).chain(perception.into_iter().flatten())
        {
            if !(low..=high).contains(&value) {
                return Err(TrafficError::VehicleType { index, field, value, allowed });
            }
        }
        let reaction = self.perception.map_or(0.0, |perception| perception.reaction_time);
        if matches!(self.model, CarFollowing::Krauss { .. }) && reaction > headway {
            let (field, value, allowed) =
                ("perception.reaction_time", reaction, "by Krauss, at most the headway");
            return Err(TrafficError::VehicleType { index, field, value, allowed });
        }
        if self.siren && self.kind != VehicleKind::Emergency {
            let allowed = "a siren to emergency vehicles only";
            return Err(TrafficError::VehicleType { index, field: "siren", value: 1.0, allowed });
        }
        Ok(())
    }
}

/// The row of a type in the table.
pub(crate) type TypeIndex = u8;

/// Draws a row by the shares of those that are `wanted`; evenly among them if none of them has a share, the first of all if
/// none is wanted.
pub(crate) fn draw_type(
    types: &[VehicleType],
    wanted: impl Fn(&VehicleType) -> bool,
    rng: &mut StreamRng,
) -> TypeIndex {
    let draw = rng.unit();
    let total: f64 = types.iter().filter(|row| wanted(row)).map(|row| row.share).sum();
    let count = types.iter().filter(|row| wanted(row)).count();
    let weight = |row: &VehicleType| if total > 0.0 { row.share / total } else { 1.0 / count.max(1) as f64 };
    let mut left = draw;
    let mut last = 0;
    for (index, row) in types.iter().enumerate().filter(|(_, row)| wanted(row)) {
        if weight(row) <= 0.0 {
            continue;
        }
        last = index;
        left -= weight(row);
        if left < 0.0 {
            break;
        }
    }
    last as TypeIndex
}

/// Whether a vehicle of that length swings out of its lane in a turn.
#[inline]
pub(crate) fn is_long(length: f64) -> bool {
    length > LONG
}

#[cfg(test)]
mod tests {
    use simworld_core::seed::Seed;

    use super::*;

    #[test]
    fn shares_are_those_of_the_table() {
        let types = standard_types();
        let mut rng = Seed(4).stream("types").rng();
        let mut counts = vec![0.0; types.len()];
        for _ in 0..40_000 {
            counts[usize::from(draw_type(&types, |_| true, &mut rng))] += 1.0 / 40_000.0;
        }
        let total: f64 = types.iter().map(|row| row.share).sum();
        for (row, count) in types.iter().zip(&counts) {
            // four standard errors of a share: 4 · √(0.25/40 000) = 0.01
            assert!((count - row.share / total).abs() < 0.01, "{:?}: {count}", row.kind);
            assert_eq!(*count > 0.0, row.share > 0.0, "{:?}", row.kind);
        }
    }

    #[test]
    fn who_has_no_share_comes_when_asked_for() {
        let types = standard_types();
        let mut rng = Seed(4).stream("types").rng();
        for kind in VehicleKind::ALL {
            let row = draw_type(&types, |row| row.kind == kind, &mut rng);
            assert_eq!(types[usize::from(row)].kind, kind);
        }
    }

    #[test]
    fn drivers_spread_about_their_mean_and_no_further_than_two_deviations() {
        let car = VehicleType::default();
        let mut rng = Seed(4).stream("factors").rng();
        let draws: Vec<f64> = (0..20_000).map(|_| f64::from(car.draw_factor(&mut rng))).collect();
        let mean = draws.iter().sum::<f64>() / draws.len() as f64;
        let spread = (draws.iter().map(|d| (d - mean) * (d - mean)).sum::<f64>() / draws.len() as f64).sqrt();
        assert!((mean - car.speed_factor).abs() < 0.004, "{mean}");
        // A normal clamped at two deviations has 0.96 of its deviation.
        assert!((spread / car.speed_deviation - 0.96).abs() < 0.03, "{spread}");
        assert!(draws.iter().all(|d| (d - 1.0).abs() < 2.0 * car.speed_deviation + 1e-6));
    }

    #[test]
    fn a_row_out_of_range_is_named() {
        let row = VehicleType { length: f64::NAN, ..VehicleType::default() };
        let error = row.validate(3).unwrap_err();
        assert!(error.to_string().contains("types[3].length"), "{error}");
        for (index, row) in standard_types().iter().enumerate() {
            row.validate(index).unwrap();
        }
    }
}
