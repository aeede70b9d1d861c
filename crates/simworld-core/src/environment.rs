//! Sun, moon, light and weather, in physical units.

mod almanac;
mod kelvin;
mod preset;

pub use almanac::{Moment, day_of_year};
pub use kelvin::{black_body_chromaticity, color_of_kelvin};
pub use preset::{NamedTime, NamedWeather, Preset, UnknownPreset};
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::asset::Season;
use crate::geometry::{Vector2, Vector3};
use crate::hash::{StateHash, StateHasher};
use crate::ops;

/// A condition outside what the model covers.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{field} = {value} is out of range: give {allowed}")]
pub struct EnvironmentError {
    /// The field, as a path.
    pub field: &'static str,
    /// The refused value.
    pub value: f64,
    /// The allowed range, in words.
    pub allowed: &'static str,
}

/// Where the sun stands.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Sun {
    /// Angle from north, clockwise, radians.
    pub azimuth: f64,
    /// Angle above the horizon, radians in [-π/2, π/2]; below zero it is night.
    pub elevation: f64,
    /// Illuminance of a surface facing the sun, lux; 100 000 on a clear noon.
    pub illuminance: f64,
}

impl Default for Sun {
    /// A clear mid-morning: south-east, 45° high.
    fn default() -> Self {
        Self { azimuth: 2.356, elevation: 0.785, illuminance: 90_000.0 }
    }
}

impl Sun {
    /// The sun of a clear day at an hour of solar time, 0 to 24, at 40° north on the day of an equinox: up from 6 to 18, 50°
    /// high at noon. Illuminance after the clear-sky model of the IES, 133 100 lux exp(-0.21 / sin of the elevation).
    ///
    /// ```
    /// use simworld_core::environment::Sun;
    /// let noon = Sun::at_hour(12.0);
    /// assert!((noon.elevation.to_degrees() - 50.0).abs() < 1e-9 && (noon.azimuth.to_degrees() - 180.0).abs() < 1e-9);
    /// assert!(Sun::at_hour(20.0).elevation < 0.0);
    /// ```
    pub fn at_hour(hour: f64) -> Self {
        let (sin_latitude, cos_latitude) = ops::sin_cos(40.0_f64.to_radians());
        let (sin_hour, cos_hour) = ops::sin_cos((hour - 12.0) * std::f64::consts::PI / 12.0);
        let height = cos_latitude * cos_hour;
        let azimuth = ops::atan2(-sin_hour, -sin_latitude * cos_hour);
        let illuminance = if height > 0.0 { 133_100.0 * ops::exp(-0.21 / height) } else { 0.0 };
        Self { azimuth: azimuth.rem_euclid(std::f64::consts::TAU), elevation: ops::asin(height), illuminance }
    }

    /// The unit vector from the ground towards the sun, world frame.
    pub fn direction(&self) -> Vector3 {
        towards(self.azimuth, self.elevation)
    }
}

fn towards(azimuth: f64, elevation: f64) -> Vector3 {
    let (sin_az, cos_az) = ops::sin_cos(azimuth);
    let (sin_el, cos_el) = ops::sin_cos(elevation);
    Vector3::new(sin_az * cos_el, cos_az * cos_el, sin_el)
}

/// Where the moon stands.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Moon {
    /// Angle from north, clockwise, radians.
    pub azimuth: f64,
    /// Angle above the horizon, radians in [-π/2, π/2]; below zero it is down.
    pub elevation: f64,
    /// Illuminance of a surface facing the moon, lux; 0.25 when it is full and high.
    pub illuminance: f64,
}

impl Default for Moon {
    /// Below the horizon.
    fn default() -> Self {
        Self { azimuth: 0.0, elevation: -0.785, illuminance: 0.0 }
    }
}

impl Moon {
    /// The unit vector from the ground towards the moon, world frame.
    pub fn direction(&self) -> Vector3 {
        towards(self.azimuth, self.elevation)
    }
}

/// What the air does.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Weather {
    /// Rainfall, mm/h; 2.5 is light, 50 is violent.
    pub rain: f64,
    /// Snowfall as water, mm/h.
    pub snow: f64,
    /// Meteorological visibility, m: the distance at which contrast falls to 5 % (Koschmieder). 20 000 is clear,
    /// below 1000 it is fog.
    pub visibility: f64,
    /// Share of the sky covered by cloud, in [0, 1].
    pub cloud_cover: f64,
    /// Wind velocity in the plane (where it blows to), m/s.
    pub wind: Vector2,
    /// Air temperature, °C.
    pub temperature: f64,
    /// How wet surfaces are, from 0 (dry) to 1 (a film of water everywhere), by what fell before. [`Weather::cover`] adds
    /// what falls now.
    pub wetness: f64,
    /// Share of the hollows of level ground that are filled with water, in [0, 1], by what fell before.
    pub puddles: f64,
    /// Snow that lies on level ground, m, by what fell before.
    pub snow_depth: f64,
}

/// What lies on the ground: what fell before and what falls now.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cover {
    /// From 0 (dry) to 1 (a film of water everywhere).
    pub wetness: f64,
    /// Share of the hollows of level ground that are filled with water, in [0, 1].
    pub puddles: f64,
    /// Snow on level ground, m.
    pub snow_depth: f64,
}

impl Weather {
    /// What lies on the ground. What falls now lies at once: rain above a trace (0.05 mm/h) wets, snow lies up to 2 °C and is
    /// rain above. The looks of surfaces and their grip follow from this.
    pub fn cover(&self) -> Cover {
        const TRACE: f64 = 0.05;
        const LEAST: f64 = 0.01; // m: snow that falls covers at once
        let (snows, rains) = (self.snow > TRACE, self.rain > TRACE);
        let lies = snows && self.temperature <= 2.0;
        let water = if rains { self.rain } else { 0.0 } + if snows && !lies { self.snow } else { 0.0 };
        let (film, hollows) = if water > 0.0 { (0.5 + 0.1 * water, 0.07 * water) } else { (0.0, 0.0) };
        Cover {
            wetness: self.wetness.max(film.min(1.0)),
            puddles: self.puddles.max(hollows.min(1.0)),
            snow_depth: self.snow_depth.max(if lies { LEAST } else { 0.0 }),
        }
    }
}

impl Default for Weather {
    /// Clear, calm and 15 °C.
    fn default() -> Self {
        Self {
            rain: 0.0,
            snow: 0.0,
            visibility: 20_000.0,
            cloud_cover: 0.1,
            wind: Vector2::zeros(),
            temperature: 15.0,
            wetness: 0.0,
            puddles: 0.0,
            snow_depth: 0.0,
        }
    }
}

/// Sun, moon, weather and season of a world.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Environment {
    /// Where the sun stands.
    pub sun: Sun,
    /// What the air does.
    pub weather: Weather,
    /// Where the moon stands.
    pub moon: Moon,
    /// What plants show that say nothing themselves; none where nobody said, and they look as they were planted.
    pub season: Option<Season>,
}

/// The first of fields that is out of its range: name, value, least, most, and the range in words.
fn within(checks: &[(&'static str, f64, f64, f64, &'static str)]) -> Result<(), EnvironmentError> {
    for &(field, value, low, high, allowed) in checks {
        if !(low..=high).contains(&value) {
            return Err(EnvironmentError { field, value, allowed });
        }
    }
    Ok(())
}

impl Environment {
    /// Checks every field against its range.
    ///
    /// # Errors
    /// The first field out of range, with what is allowed; NaN is always out of range.
    pub fn validate(&self) -> Result<(), EnvironmentError> {
        let Self { sun, weather, moon, season: _ } = self;
        let half_turn = std::f64::consts::FRAC_PI_2;
        let checks = [
            ("sun.azimuth", sun.azimuth, -10.0, 10.0, "an angle within ±10 rad"),
            ("sun.elevation", sun.elevation, -half_turn, half_turn, "-π/2 to π/2 rad"),
            ("sun.illuminance", sun.illuminance, 0.0, 200_000.0, "0 to 200 000 lux"),
            ("weather.rain", weather.rain, 0.0, 500.0, "0 to 500 mm/h"),
            ("weather.snow", weather.snow, 0.0, 100.0, "0 to 100 mm/h"),
            ("weather.visibility", weather.visibility, 1.0, 500_000.0, "1 to 500 000 m"),
            ("weather.cloud_cover", weather.cloud_cover, 0.0, 1.0, "0 to 1"),
            ("weather.wind.x", weather.wind.x, -120.0, 120.0, "-120 to 120 m/s"),
            ("weather.wind.y", weather.wind.y, -120.0, 120.0, "-120 to 120 m/s"),
            ("weather.temperature", weather.temperature, -90.0, 60.0, "-90 to 60 °C"),
            ("weather.wetness", weather.wetness, 0.0, 1.0, "0 to 1"),
            ("weather.puddles", weather.puddles, 0.0, 1.0, "0 to 1"),
            ("weather.snow_depth", weather.snow_depth, 0.0, 5.0, "0 to 5 m"),
            ("moon.azimuth", moon.azimuth, -10.0, 10.0, "an angle within ±10 rad"),
            ("moon.elevation", moon.elevation, -half_turn, half_turn, "-π/2 to π/2 rad"),
            ("moon.illuminance", moon.illuminance, 0.0, 10.0, "0 to 10 lux"),
        ];
        within(&checks)
    }
}

impl StateHash for Environment {
    fn state_hash(&self, hasher: &mut StateHasher) {
        let Self { sun, weather, moon, season } = self;
        hasher.f64(sun.azimuth).f64(sun.elevation).f64(sun.illuminance);
        hasher.f64(weather.rain).f64(weather.snow).f64(weather.visibility).f64(weather.cloud_cover);
        hasher.f64(weather.wind.x).f64(weather.wind.y).f64(weather.temperature);
        hasher.f64(weather.wetness).f64(weather.puddles).f64(weather.snow_depth);
        hasher.f64(moon.azimuth).f64(moon.elevation).f64(moon.illuminance);
        // Without one the digest is what it was before there were seasons.
        if let Some(season) = season {
            hasher.u64(*season as u64 + 1);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_default_sun_stands_in_the_south_east() {
        let towards = Sun::default().direction();
        assert!(towards.x > 0.4 && towards.y < -0.4 && towards.z > 0.6, "{towards}");
    }

    #[test]
    fn no_number_slips_through() {
        let mut foggy = Environment::default();
        foggy.weather.visibility = f64::NAN;
        let error = foggy.validate().unwrap_err();
        assert_eq!(error.field, "weather.visibility");
        assert!(Environment::default().validate().is_ok());
    }

    /// What was saved before there were a moon, wet ground and lying snow is still read.
    #[test]
    fn an_older_environment_is_read_with_defaults() {
        let old = r#"{"sun":{"azimuth":1.0,"elevation":0.5,"illuminance":50000.0},
            "weather":{"rain":1.0,"snow":0.0,"visibility":9000.0,"cloud_cover":0.5,"wind":[1.0,0.0],"temperature":8.0}}"#;
        let read: Environment = serde_json::from_str(old).unwrap();
        assert_eq!((read.weather.snow_depth, read.moon, read.season), (0.0, Moon::default(), None));
        assert_eq!(read.sun.elevation, 0.5);
    }

    #[test]
    fn every_field_counts_in_the_digest() {
        let digest = |environment: &Environment| {
            let mut hasher = StateHasher::new();
            environment.state_hash(&mut hasher);
            hasher.finish()
        };
        let plain = digest(&Environment::default());
        let changes: [fn(&mut Environment); 8] = [
            |e| e.weather.wetness = 0.5,
            |e| e.weather.puddles = 0.5,
            |e| e.weather.snow_depth = 0.5,
            |e| e.moon.azimuth = 0.5,
            |e| e.moon.elevation = 0.5,
            |e| e.moon.illuminance = 0.2,
            |e| e.season = Some(Season::Spring),
            |e| e.season = Some(Season::Winter),
        ];
        for change in changes {
            let mut environment = Environment::default();
            change(&mut environment);
            assert_ne!(digest(&environment), plain);
        }
    }

    #[test]
    fn what_falls_lies_at_once_and_what_fell_stays() {
        let weather = Weather::default();
        assert_eq!(weather.cover(), Cover::default());
        let rain = Weather { rain: 3.0, ..weather }.cover();
        assert!(rain.wetness > 0.7 && rain.puddles > 0.1 && rain.snow_depth == 0.0);
        let snow = |temperature| Weather { snow: 1.0, temperature, ..weather }.cover();
        assert!(snow(-1.0).snow_depth > 0.0 && snow(-1.0).wetness == 0.0);
        assert!(snow(4.0).snow_depth == 0.0 && snow(4.0).wetness > 0.5);
        assert_eq!(Weather { wetness: 0.3, ..weather }.cover().wetness, 0.3);
    }
}
