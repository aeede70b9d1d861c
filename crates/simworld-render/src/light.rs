//! Light from the environment: sun, sky, fog and exposure, as the shaders want them.
//!
//! Photometric units, linear-light sRGB primaries. Exposure follows from the illuminance on the ground, so a picture
//! depends on the environment and never on the pictures before it.

use nalgebra::Vector3 as V;
use simworld_core::environment::Environment;
use simworld_core::geometry::Vector3;
use simworld_core::ops;

/// Everything the shaders know of light; radiances are exposed already.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Light {
    /// Towards the sun, unit length.
    pub sun_direction: Vector3,
    /// What a white surface that faces the sun sends out by sunlight alone.
    pub sun: V<f64>,
    /// What a white surface that faces up sends out by skylight alone.
    pub sky: V<f64>,
    /// What a surface that faces down gets back from the ground.
    pub bounce: V<f64>,
    pub zenith: V<f64>,
    pub horizon: V<f64>,
    /// Extinction of the air, 1/m.
    pub extinction: f64,
    /// 0 by day, 1 by night: how far lamps and windows are lit.
    pub night: f64,
    /// Share of the sky covered by cloud.
    pub clouds: f64,
}

/// Contrast at the meteorological visibility (Koschmieder 1924, WMO: 5 %).
const CONTRAST: f64 = 0.05;
/// Albedo of the ground that throws light back up.
const GROUND_ALBEDO: f64 = 0.2;

fn luminance(color: &V<f64>) -> f64 {
    color.dot(&V::new(0.2126, 0.7152, 0.0722))
}

/// The colour at luminance one.
fn tint(r: f64, g: f64, b: f64) -> V<f64> {
    let color = V::new(r, g, b);
    color / luminance(&color)
}

fn smooth(low: f64, high: f64, x: f64) -> f64 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// The colour of sunlight after its way through the air, luminance one.
///
/// Air mass by Kasten and Young (1989), clear-sky optical depths at 610, 550 and 465 nm. At 30° the air mass is 2.0.
fn sunlight(elevation: f64) -> V<f64> {
    let degrees = elevation.to_degrees().max(0.0);
    let mass = 1.0 / (ops::sin(elevation.max(0.0)) + 0.50572 * ops::pow(degrees + 6.07995, -1.6364));
    let through = |depth: f64| ops::exp(-depth * mass);
    tint(through(0.06), through(0.1), through(0.2))
}

impl Light {
    /// The light of an environment, exposed `compensation` stops over the automatic exposure.
    pub(crate) fn of(environment: &Environment, compensation: f64) -> Self {
        let (sun, weather) = (&environment.sun, &environment.weather);
        let height = ops::sin(sun.elevation);
        let clouds = weather.cloud_cover;
        let day = smooth(-0.02, 0.05, height);
        let direct = sun.illuminance * day * (1.0 - 0.93 * clouds * clouds);
        // Diffuse light: about a fifth of the beam in clear weather, a third of what clouds take, twilight, city glow.
        let scattered = sun.illuminance
            * day
            * (0.22 * (0.35 + 0.65 * height.max(0.0)) + 0.22 * clouds * height.max(0.0));
        let twilight =
            400.0 * ops::exp(0.9 * sun.elevation.to_degrees().min(0.0)) * smooth(0.0, 1.0, sun.illuminance);
        let diffuse = scattered + twilight + 3.0;
        let ground = direct * height.max(0.0) + diffuse;
        // At 60 000 lux an 18 % grey is drawn at 22 %; darker scenes stay darker, but readable.
        let grey = 0.22 * ops::pow((ground / 60_000.0).min(1.5), 0.15);
        let exposure = grey / (0.18 * ground) * ops::pow(2.0, compensation);

        let warm = smooth(0.35, 0.0, height) * day;
        let clear = tint(0.74, 0.84, 1.04);
        let grey_sky = tint(0.9, 0.96, 1.04);
        let sky = clear.lerp(&grey_sky, clouds) * (diffuse * exposure);
        let dusk = tint(1.25, 0.85, 0.62);
        let horizon = tint(0.8, 0.94, 1.06).lerp(&grey_sky, clouds).lerp(&dusk, warm * 0.6 * (1.0 - clouds));
        let zenith = tint(0.26, 0.58, 1.12).lerp(&grey_sky, clouds * 0.9);
        let sun_color = sunlight(sun.elevation);
        let night = 1.0 - smooth(-0.08, 0.1, height);
        // A clear sky is brightest near the horizon, an overcast one is even (CIE), a night sky is dark.
        let sky_radiance = diffuse * exposure * (1.0 - 0.6 * night);
        Self {
            sun_direction: sun.direction(),
            sun: sun_color * (direct * exposure),
            sky,
            bounce: (sun_color * (direct * height.max(0.0)) + clear * diffuse) * (GROUND_ALBEDO * exposure),
            zenith: zenith * (sky_radiance * 1.15),
            horizon: horizon * (sky_radiance * (2.5 - 1.3 * clouds)),
            extinction: -ops::ln(CONTRAST) / weather.visibility,
            night,
            clouds,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn contrast_falls_to_five_percent_at_the_visibility() {
        let mut foggy = Environment::default();
        foggy.weather.visibility = 250.0;
        let light = Light::of(&foggy, 0.0);
        assert!((ops::exp(-light.extinction * 250.0) - 0.05).abs() < 1e-12);
    }

    #[test]
    fn a_stop_is_a_factor_of_two() {
        let environment = Environment::default();
        let (plain, brighter) = (Light::of(&environment, 0.0), Light::of(&environment, 1.0));
        assert!((brighter.sun.x / plain.sun.x - 2.0).abs() < 1e-12);
    }

    #[test]
    fn every_allowed_environment_gives_finite_light() {
        for elevation in [-1.57, -0.3, -0.01, 0.0, 0.02, 0.5, 1.57] {
            for clouds in [0.0, 0.5, 1.0] {
                for illuminance in [0.0, 1.0, 200_000.0] {
                    let mut environment = Environment::default();
                    environment.sun.elevation = elevation;
                    environment.sun.illuminance = illuminance;
                    environment.weather.cloud_cover = clouds;
                    let light = Light::of(&environment, 0.0);
                    for color in [light.sun, light.sky, light.bounce, light.zenith, light.horizon] {
                        assert!(color.iter().all(|c| c.is_finite() && *c >= 0.0), "{environment:?}: {color}");
                    }
                }
            }
        }
    }

    #[test]
    fn the_evening_sun_is_redder() {
        let (noon, evening) = (sunlight(1.2), sunlight(0.05));
        assert!(evening.x / evening.z > 2.0 * noon.x / noon.z);
    }
}
