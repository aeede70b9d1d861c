//! Driving conditions: what weather does to grip, sight, speeds and gaps.

use serde::{Deserialize, Serialize};
use simworld_core::environment::Weather;

use crate::vehicle::VehicleType;
use crate::{TrafficConfig, TrafficError};

/// Peak friction of dry asphalt (Wong, Theory of Ground Vehicles, 4th edition 2008, table 1.2: 0.8 to 0.9).
const DRY: f64 = 0.85;
/// Of wet asphalt (the same: 0.5 to 0.7).
const WET: f64 = 0.6;
/// Of packed snow (Wallman and Åström, VTI 2001: 0.20 to 0.35).
const SNOW: f64 = 0.3;
/// Millimetres in an inch: the manuals give intensities in inches an hour.
const INCH: f64 = 25.4;
/// Reaction time and braking for which drivers choose their speed by how far they see (AASHTO's stopping sight distance,
/// Green Book 2018, section 3.2.2), s and m/s².
const REACTION: f64 = 2.5;
const SIGHT_BRAKING: f64 = 3.4;
/// The speed at which a queue passes its stop line, m/s.
const QUEUE_SPEED: f64 = 10.0;

/// What the road and the air do to driving.
///
/// ```
/// use simworld_core::environment::Weather;
/// use simworld_traffic::DrivingConditions;
/// let downpour = DrivingConditions::from_weather(&Weather { rain: 20.0, ..Weather::default() });
/// // Highway Capacity Manual 2010, exhibit 10-15: more than 0.25 in/h takes 14.13 % of the capacity.
/// assert_eq!((downpour.capacity, downpour.speed), (0.8587, 0.94));
/// assert_eq!(DrivingConditions::from_weather(&Weather::default()), DrivingConditions::default());
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct DrivingConditions {
    /// Peak friction between tyre and road, in [0.05, 1.2]; dry asphalt has 0.85.
    pub friction: f64,
    /// How far drivers see, m, in [1, 500 000].
    pub visibility: f64,
    /// What drivers keep of their speed on a free road, in [0.2, 1].
    pub speed: f64,
    /// What a lane keeps of its capacity, in [0.2, 1]; time gaps grow as it falls.
    pub capacity: f64,
}

impl Default for DrivingConditions {
    /// Dry and clear.
    fn default() -> Self {
        Self { friction: DRY, visibility: 20_000.0, speed: 1.0, capacity: 1.0 }
    }
}

impl DrivingConditions {
    /// The conditions of a weather. Where rain, snow, cold and fog come together the worst of them decides, factor by factor.
    ///
    /// Capacities are those of the Highway Capacity Manual 2010, exhibit 10-15; free speeds those of SHRP 2 report L08 for a
    /// road of 55 mph (the Manual's sixth edition, exhibit 11-21), the slowest that was measured, and in light rain those of
    /// the Manual of 2000, chapter 22. Snow is taken as its water.
    pub fn from_weather(weather: &Weather) -> Self {
        let (capacity, speed) = worst([
            rain(weather.rain / INCH),
            snow(weather.snow / INCH),
            cold(weather.temperature),
            fog(weather.visibility),
        ]);
        let lies = weather.cover();
        let is_wet = weather.rain > 0.0 || lies.wetness > 0.05;
        let friction = match (is_wet, weather.snow > 0.0 || lies.snow_depth > 0.0) {
            (_, true) => SNOW,
            (true, false) if weather.temperature < 0.0 => SNOW,
            (true, false) => WET,
            (false, false) => DRY,
        };
        Self { friction, visibility: weather.visibility, speed, capacity }
    }

    /// Checks every field against its range.
    ///
    /// # Errors
    /// The first field out of range; NaN always is.
    pub fn validate(&self) -> Result<(), TrafficError> {
        let checks = [
            ("conditions.friction", self.friction, 0.05, 1.2, "0.05 to 1.2"),
            ("conditions.visibility", self.visibility, 1.0, 500_000.0, "1 to 500 000 m"),
            ("conditions.speed", self.speed, 0.2, 1.0, "0.2 to 1"),
            ("conditions.capacity", self.capacity, 0.2, 1.0, "0.2 to 1"),
        ];
        for (field, value, low, high, allowed) in checks {
            if !(low..=high).contains(&value) {
                return Err(TrafficError::Config { field, value, allowed });
            }
        }
        Ok(())
    }

    /// The speed at which one can stop within sight, m/s: `d = 2.5 v + v²/(2 · 3.4)`, solved for the speed.
    pub fn sight_speed(&self) -> f64 {
        let before = SIGHT_BRAKING * REACTION;
        (before * before + 2.0 * SIGHT_BRAKING * self.visibility).sqrt() - before
    }

    /// The settings under these conditions.
    pub(crate) fn applied(self, config: &TrafficConfig) -> TrafficConfig {
        let mut config = TrafficConfig { conditions: self, ..config.clone() };
        config.types.iter_mut().for_each(|row| self.apply(row));
        config.mobil.safe_braking *= (self.friction / DRY).min(1.0);
        config
    }

    /// Drivers see and grip as the conditions allow. On a slippery road they use half the grip at most, for either pedal.
    fn apply(self, row: &mut VehicleType) {
        let driver = &mut row.driver;
        driver.emergency_deceleration *= (self.friction / DRY).min(1.0);
        let half = driver.emergency_deceleration * 0.5;
        driver.deceleration = driver.deceleration.min(half);
        driver.acceleration = driver.acceleration.min(half);
        // A queue passes a point with a headway of the time gap and the time of length and gap at rest. Of both together the
        // capacity is the inverse; the second grows by itself as speeds fall.
        let own = (row.length + driver.gap) / QUEUE_SPEED;
        driver.headway +=
            (driver.headway + own) * (1.0 / self.capacity - 1.0) - own * (1.0 / self.speed - 1.0);
        driver.desired_speed = driver.desired_speed.min(self.sight_speed());
    }
}

/// Capacity and free speed, as shares.
type Factors = (f64, f64);

/// Rain, inches an hour.
fn rain(intensity: f64) -> Factors {
    match intensity {
        i if i > 0.25 => (1.0 - 0.1413, 0.94),
        i if i > 0.10 => (1.0 - 0.0724, 0.96),
        i if i > 0.0 => (1.0 - 0.0201, 0.98),
        _ => (1.0, 1.0),
    }
}

/// Snow, inches of water an hour.
fn snow(intensity: f64) -> Factors {
    match intensity {
        i if i > 0.50 => (1.0 - 0.2243, 0.88),
        i if i > 0.10 => (1.0 - 0.1104, 0.90),
        i if i > 0.05 => (1.0 - 0.0866, 0.92),
        i if i > 0.0 => (1.0 - 0.0429, 0.94),
        _ => (1.0, 1.0),
    }
}

/// Cold below -20 °C.
fn cold(temperature: f64) -> Factors {
    if temperature < -20.0 { (1.0 - 0.0845, 0.95) } else { (1.0, 1.0) }
}

/// Visibility below a mile, a half and a quarter of it.
fn fog(visibility: f64) -> Factors {
    const MILE: f64 = 1609.344;
    match visibility {
        d if d < MILE * 0.25 => (1.0 - 0.1049, 0.95),
        d if d < MILE * 0.5 => (1.0 - 0.1167, 0.95),
        d if d < MILE => (1.0 - 0.0967, 0.96),
        _ => (1.0, 1.0),
    }
}

fn worst(factors: [Factors; 4]) -> Factors {
    factors.into_iter().fold((1.0, 1.0), |a, b| (a.0.min(b.0), a.1.min(b.1)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_gets_better_as_it_rains_or_snows_more() {
        let of = |rain, snow| DrivingConditions::from_weather(&Weather { rain, snow, ..Weather::default() });
        for step in 1..200 {
            let (less, more) = (f64::from(step - 1) * 0.2, f64::from(step) * 0.2);
            for (a, b) in [(of(less, 0.0), of(more, 0.0)), (of(0.0, less), of(0.0, more))] {
                assert!(b.speed <= a.speed && b.capacity <= a.capacity && b.friction <= a.friction);
                b.validate().unwrap();
            }
        }
    }

    #[test]
    fn one_stops_within_sight() {
        for visibility in [10.0, 50.0, 200.0, 1000.0] {
            let v = DrivingConditions { visibility, ..DrivingConditions::default() }.sight_speed();
            let needed = v * REACTION + v * v / (2.0 * SIGHT_BRAKING);
            assert!((needed - visibility).abs() < 1e-9, "{needed} m of {visibility} m");
        }
    }

    #[test]
    fn dry_and_clear_changes_nothing() {
        let config = TrafficConfig::default();
        assert_eq!(DrivingConditions::default().applied(&config), config);
    }

    #[test]
    fn nobody_brakes_harder_than_the_road_grips() {
        let snow = DrivingConditions::from_weather(&Weather { snow: 5.0, ..Weather::default() });
        for row in snow.applied(&TrafficConfig::default()).types {
            assert!(row.driver.emergency_deceleration <= 10.0 * SNOW / DRY + 1e-9);
            assert!(row.driver.deceleration <= row.driver.emergency_deceleration * 0.5);
        }
    }
}
