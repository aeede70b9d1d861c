//! Rain and snow in the air around the eye: how much, where it has fallen to by the clock, and how clouds have drifted.

use simworld_core::environment::{Environment, Weather};
use simworld_core::geometry::{Point3, Vector3};

/// Side of the box that drops and flakes fill around the eye, m; BOX of shaders/precipitation.wgsl.
const BOX: f64 = 16.0;
/// Terminal speeds: drops of 2.5 mm (R. Gunn and G. Kinzer, Journal of Meteorology 6 (1949) 243-248), and flakes.
const RAIN_SPEED: f64 = 7.4;
const SNOW_SPEED: f64 = 1.3;
/// The most that are drawn.
const MOST: f64 = 7000.0;
/// How far clouds drift in the plane of the sky for each metre of wind.
const DRIFT: f64 = 0.002;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Precipitation {
    Rain,
    Snow,
}

/// What falls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Falling {
    pub kind: Precipitation,
    /// How many drops or flakes are drawn.
    pub count: u32,
    pub velocity: Vector3,
    /// How far they have come relative to the eye, modulo their box, m.
    pub place: Vector3,
    /// Time of the clock, modulo its hour, s.
    pub seconds: f64,
    /// Drift of the clouds.
    pub clouds: [f64; 2],
}

/// How much rain and snow come down, mm/h of water: below 2 °C snow stays snow, above it melts on its way.
pub(crate) fn amounts(weather: &Weather) -> (f64, f64) {
    if weather.temperature > 2.0 { (weather.rain + weather.snow, 0.0) } else { (weather.rain, weather.snow) }
}

impl Falling {
    /// What falls around an eye at a time in s.
    pub(crate) fn of(environment: &Environment, eye: &Point3, seconds: f64) -> Self {
        let weather = &environment.weather;
        let (rain, snow) = amounts(weather);
        let kind = if snow > rain { Precipitation::Snow } else { Precipitation::Rain };
        let (count, speed) = match kind {
            Precipitation::Snow => (1800.0 * snow, SNOW_SPEED),
            Precipitation::Rain if rain > 0.05 => (700.0 + 200.0 * rain, RAIN_SPEED),
            Precipitation::Rain => (0.0, RAIN_SPEED),
        };
        let velocity = Vector3::new(weather.wind.x, weather.wind.y, -speed);
        let place = (velocity * seconds - eye.coords).map(|way| way.rem_euclid(BOX));
        let clouds =
            [-weather.wind.x, -weather.wind.y].map(|wind| (wind * seconds * DRIFT).rem_euclid(4096.0));
        Self {
            kind,
            count: count.min(MOST) as u32,
            velocity,
            place,
            seconds: seconds.rem_euclid(3600.0),
            clouds,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn under(change: impl Fn(&mut Environment)) -> Falling {
        let mut environment = Environment::default();
        change(&mut environment);
        Falling::of(&environment, &Point3::new(1e5, -3.0, 2.0), 86_400.0)
    }

    #[test]
    fn rain_grows_and_snow_melts() {
        assert_eq!(under(|_| {}).count, 0);
        let (soft, hard) = (under(|e| e.weather.rain = 1.0), under(|e| e.weather.rain = 500.0));
        assert!(soft.count < hard.count && f64::from(hard.count) <= MOST);
        let cold = under(|e| (e.weather.snow, e.weather.temperature) = (2.0, -4.0));
        assert_eq!(cold.kind, Precipitation::Snow);
        let warm = under(|e| (e.weather.snow, e.weather.temperature) = (2.0, 8.0));
        assert!(warm.kind == Precipitation::Rain && warm.count > 0);
    }

    #[test]
    fn what_falls_stays_in_its_box() {
        let falling = under(|e| (e.weather.rain, e.weather.wind) = (9.0, [-7.0, 3.0].into()));
        assert!(falling.place.iter().all(|way| (0.0..=BOX).contains(way)), "{falling:?}");
    }
}
