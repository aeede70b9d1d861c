//! Light from the environment: sun or moon, sky, clouds, fog and exposure, as the shaders want them.
//!
//! Photometric: lux and cd/m², in linear sRGB. A radiance is given as π times itself times the exposure, so that a white
//! surface under an even sky of 1 has 1 too. Exposure follows from the illuminance on the ground, so a picture depends on
//! the environment and never on the pictures before it.

use nalgebra::Vector3 as V;
use simworld_core::environment::{Cover, Environment};
use simworld_core::geometry::Vector3;
use simworld_core::ops;

use crate::atmosphere::{Atmosphere, Scattered, phase};

/// Nodes of the table of the sky: by the sine of half the azimuth from the source, and by the root of the sine of elevation.
pub(crate) const SKY_ACROSS: usize = 9;
pub(crate) const SKY_UP: usize = 16;
/// Nodes of the table, as in shaders/bindings.wgsl.
pub(crate) const SKY_NODES: usize = SKY_ACROSS * SKY_UP;

/// Everything the shaders know of light; radiances are exposed already.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Light {
    /// Towards the sun, or at night towards the moon; unit length.
    pub source: Vector3,
    /// What a white surface that faces the source sends out by its light alone.
    pub sun: V<f64>,
    /// Irradiance of the sky and of the ground by normal: coefficients of the first nine real spherical harmonics, with the
    /// constants of basis and cosine in them (R. Ramamoorthi and P. Hanrahan, SIGGRAPH 2001).
    pub ambient: [V<f64>; 9],
    /// The sky without clouds: light of the air, and in the fourth that of the aerosol before its phase function.
    pub sky: Vec<[f32; 4]>,
    /// Colour of what the aerosol scatters, near the horizon and overhead.
    pub aerosol: [V<f64>; 2],
    /// The clouds overhead (CIE overcast sky), times their share.
    pub overcast: V<f64>,
    /// What the sky has without sun: its own glow and that of the city.
    pub night_sky: V<f64>,
    /// What fog scatters towards the eye.
    pub fog: V<f64>,
    /// How much of the haze at the horizon is fog, and its vertical optical depth.
    pub fog_share: f64,
    pub fog_depth: f64,
    /// What a surface that faces down gets back from the ground.
    pub bounce: V<f64>,
    /// Extinction of the air at the eye, 1/m, and how fast it falls upwards, 1/m.
    pub extinction: f64,
    pub thinning: f64,
    /// 0 by day, 1 by night: how far lamps and windows are lit.
    pub night: f64,
    /// The same of the lamps of vehicles, which are lit in rain and fog too.
    pub headlights: f64,
    /// Share of the sky covered by cloud.
    pub clouds: f64,
    /// What lies on surfaces, and rain and snow that fall, mm/h.
    pub cover: Cover,
    pub rain: f64,
    pub snow: f64,
    /// From lux to display light.
    pub exposure: f64,
}

/// Contrast at the meteorological visibility (Koschmieder 1924, WMO: 5 %).
const CONTRAST: f64 = 0.05;
/// Albedo of the ground that throws light back up, and of snow.
const GROUND_ALBEDO: f64 = 0.2;
const SNOW_ALBEDO: f64 = 0.8;
/// Illuminance of sunlight above the air, lux.
const SOLAR: f64 = 128_000.0;
/// What the night sky over a city gives without a moon, lux (C. Kyba et al., Scientific Reports 5 (2015) 8409: from 0.01 in the
/// country to 0.5 over cities under clouds).
const NIGHT_GLOW: f64 = 0.12;
/// What lit streets give on average, lux (EN 13201, class P2: 10).
const LIT_STREET: f64 = 14.0;

pub(crate) fn luminance(color: &V<f64>) -> f64 {
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

/// Sun or moon: which of them lights the scene.
struct Source {
    direction: Vector3,
    /// Illuminance above the air, lux.
    above: f64,
}

impl Source {
    /// The sun until it is 8° below the horizon and gives less than the night does; then the moon.
    fn of(environment: &Environment) -> Self {
        let (sun, moon) = (&environment.sun, &environment.moon);
        let clear = |height: f64| if height > 0.0 { ops::exp(-0.21 / height) } else { 0.0 };
        if sun.elevation > -0.14 {
            // What was asked for, beside what a clear sky lets through; nothing can be told from a sun on the horizon.
            let expected = 133_100.0 * clear(ops::sin(sun.elevation));
            let asked = if sun.elevation > 0.05 { (sun.illuminance / expected).min(4.0) } else { 1.0 };
            return Self { direction: sun.direction(), above: SOLAR * asked };
        }
        let height = ops::sin(moon.elevation);
        let above = if height > 0.02 { (moon.illuminance / clear(height)).min(1.0) } else { 0.0 };
        Self { direction: moon.direction(), above }
    }
}

/// The sky as the table has it, before exposure.
struct Sky {
    nodes: Vec<Scattered>,
}

impl Sky {
    fn of(air: &Atmosphere, height: f64) -> Self {
        let across = (1.0 - height * height).max(0.0).sqrt();
        let mut nodes = Vec::with_capacity(SKY_NODES);
        for row in 0..SKY_UP {
            let share = row as f64 / (SKY_UP - 1) as f64;
            // The lowest row lies a little above the horizon, beyond which no ray leaves the air.
            let z = (share * share).max(0.004);
            for column in 0..SKY_ACROSS {
                let half = column as f64 / (SKY_ACROSS - 1) as f64;
                let around = 1.0 - 2.0 * half * half;
                nodes.push(air.toward(z, z * height + (1.0 - z * z).sqrt() * across * around));
            }
        }
        Self { nodes }
    }

    /// As the shaders interpolate it; `around` is the cosine of the azimuth from the source.
    fn toward(&self, z: f64, around: f64, to_source: f64) -> V<f64> {
        let place = |share: f64, count: usize| {
            let at = share.clamp(0.0, 1.0) * (count - 1) as f64;
            let low = (at as usize).min(count - 2);
            (low, at - low as f64)
        };
        let (row, up) = place(z.max(0.0).sqrt(), SKY_UP);
        let (column, right) = place((0.5 - 0.5 * around).max(0.0).sqrt(), SKY_ACROSS);
        let node = |row: usize, column: usize| {
            let node = &self.nodes[row * SKY_ACROSS + column];
            V::from(node.air) + V::from(node.aerosol) * phase(to_source)
        };
        let low = node(row, column).lerp(&node(row, column + 1), right);
        low.lerp(&node(row + 1, column).lerp(&node(row + 1, column + 1), right), up)
    }
}

/// Directions of equal weight over the whole sphere: calls with the direction and the cosine of the azimuth from +x.
fn over_sphere(mut visit: impl FnMut(V<f64>, f64, f64)) {
    const RINGS: u32 = 24;
    const SIDES: u32 = 24;
    for ring in 0..RINGS {
        let z = (f64::from(ring) + 0.5) / f64::from(RINGS) * 2.0 - 1.0;
        let flat = (1.0 - z * z).sqrt();
        for side in 0..SIDES {
            let (sin, cos) = ops::sin_cos((f64::from(side) + 0.5) * std::f64::consts::TAU / f64::from(SIDES));
            visit(
                V::new(flat * cos, flat * sin, z),
                cos,
                4.0 * std::f64::consts::PI / f64::from(RINGS * SIDES),
            );
        }
    }
}

/// Coefficients of the irradiance of a radiance over the sphere.
fn harmonics(radiance: impl Fn(V<f64>, f64) -> V<f64>) -> [V<f64>; 9] {
    const BASIS: [f64; 9] =
        [0.282_095, 0.488_603, 0.488_603, 0.488_603, 1.092_548, 1.092_548, 0.315_392, 1.092_548, 0.546_274];
    let mut sums = [V::zeros(); 9];
    over_sphere(|d, around, weight| {
        let light = radiance(d, around) * weight;
        for (sum, value) in sums.iter_mut().zip(basis(&d)) {
            *sum += light * value;
        }
    });
    // The constants of the basis once more, and those of the cosine: π, 2π/3 and π/4, of which π goes to the unit.
    std::array::from_fn(|index| {
        let cosine = match index {
            0 => 1.0,
            1..=3 => 2.0 / 3.0,
            _ => 0.25,
        };
        sums[index] * (BASIS[index] * cosine)
    })
}

/// The first nine real spherical harmonics.
fn basis(d: &V<f64>) -> [f64; 9] {
    [
        0.282_095,
        0.488_603 * d.y,
        0.488_603 * d.z,
        0.488_603 * d.x,
        1.092_548 * d.x * d.y,
        1.092_548 * d.y * d.z,
        0.315_392 * (3.0 * d.z * d.z - 1.0),
        1.092_548 * d.x * d.z,
        0.546_274 * (d.x * d.x - d.y * d.y),
    ]
}

/// Illuminances in lux before exposure.
struct Levels {
    direct: V<f64>,
    overcast: V<f64>,
    fog: V<f64>,
    night: V<f64>,
    /// Of the ground, by all together.
    ground: V<f64>,
    fog_share: f64,
    fog_depth: f64,
    extinction: f64,
    thinning: f64,
}

impl Levels {
    fn of(environment: &Environment, source: &Source, air: &Atmosphere, sky: &Sky) -> Self {
        let weather = &environment.weather;
        let (height, clouds) = (source.direction.z, weather.cloud_cover);
        let extinction = -ops::ln(CONTRAST) / weather.visibility;
        // Mist below 8 km of visibility lies on the ground: in fog 150 m deep, else as aerosol does.
        let fog_share = 1.0 - smooth(800.0, 8_000.0, weather.visibility);
        let depth = 1200.0 + (150.0 - 1200.0) * fog_share;
        let excess = (extinction - 3.0 / 8_000.0).max(0.0) * depth;

        let beam = air.transmittance(height) * source.above;
        let mut clear_sky = V::zeros();
        over_sphere(|d, around, weight| {
            if d.z > 0.0 {
                let to_source = d.z * height
                    + (1.0 - d.z * d.z).sqrt() * (1.0 - height * height).max(0.0).sqrt() * around;
                clear_sky += sky.toward(d.z, around, to_source) * (weight * d.z);
            }
        });
        clear_sky *= source.above;
        // F. Kasten and G. Czeplak, Solar Energy 24 (1980) 177-189: what clouds leave of all light, and of the beam.
        let left = 1.0 - 0.75 * ops::pow(clouds, 3.4);
        let through = left * (1.0 - clouds * clouds) * ops::exp(-excess / height.max(0.1));
        let direct = beam * through;
        let global = (beam * height.max(0.0) + clear_sky) * left;
        let diffuse = luminance(&(global - direct * height.max(0.0))).max(0.0);
        let covered = (diffuse - luminance(&clear_sky) * (1.0 - clouds)).max(0.0);
        let grey = tint(0.93, 0.98, 1.06);
        let color = if luminance(&beam) > 0.0 {
            let beam = beam / luminance(&beam);
            // Clouds take the colour of a low sun, as far as it reaches them.
            grey.lerp(&beam, 0.35 * smooth(0.35, 0.02, height))
        } else {
            grey
        };
        let night = tint(0.62, 0.8, 1.35) * (NIGHT_GLOW * (1.0 - clouds))
            + tint(1.0, 0.8, 0.58) * (NIGHT_GLOW * 3.0 * clouds);
        let overcast = color * covered;
        let all_sky = clear_sky * (1.0 - clouds) + overcast + night;
        Self {
            direct,
            overcast,
            fog: all_sky * 0.5 + grey * (0.5 * luminance(&all_sky)),
            night,
            ground: direct * height.max(0.0) + all_sky,
            fog_share,
            fog_depth: excess,
            extinction,
            thinning: 1.0 / depth,
        }
    }
}

impl Light {
    /// The light of an environment, exposed `compensation` stops over the automatic exposure.
    pub(crate) fn of(environment: &Environment, compensation: f64) -> Self {
        let source = Source::of(environment);
        let air = Atmosphere::new(environment.weather.visibility, source.direction.z);
        let sky = Sky::of(&air, source.direction.z);
        let levels = Levels::of(environment, &source, &air, &sky);
        let natural = luminance(&levels.ground);
        let night = 1.0 - smooth(20.0, 160.0, natural);
        // At 60 000 lux an 18 % grey is drawn at 29 %; darker scenes stay darker, but readable, and where clouds or fog shine
        // as white paper does there must be room for them.
        let seen = natural + LIT_STREET * night;
        let covered = environment.weather.cloud_cover * environment.weather.cloud_cover;
        let lies = smooth(0.0, 0.05, environment.weather.cover().snow_depth);
        let grey = (0.29 - 0.13 * covered.max(levels.fog_share).max(lies) - 0.03 * lies)
            * ops::pow((seen / 60_000.0).min(1.5), 0.10);
        let exposure = grey / (0.18 * seen) * ops::pow(2.0, compensation);
        Self::exposed(environment, &source, &sky, &levels, exposure, night)
    }

    fn exposed(
        environment: &Environment,
        source: &Source,
        sky: &Sky,
        levels: &Levels,
        exposure: f64,
        night: f64,
    ) -> Self {
        let weather = &environment.weather;
        let cover = weather.cover();
        let wet = weather.rain > 0.5 || weather.snow > 0.2 || weather.visibility < 600.0;
        // From illuminance above the air to π times an exposed radiance.
        let scale = std::f64::consts::PI * source.above * exposure;
        let (low, high) = (&sky.nodes[0].aerosol, &sky.nodes[(SKY_UP - 1) * SKY_ACROSS].aerosol);
        let colored = |color: &[f64; 3]| {
            let color = V::from(*color);
            let level = luminance(&color);
            if level > 0.0 { color / level } else { V::repeat(1.0) }
        };
        let albedo = if cover.snow_depth > 0.0 { SNOW_ALBEDO } else { GROUND_ALBEDO };
        let mut light = Self {
            source: source.direction,
            sun: levels.direct * exposure,
            ambient: [V::zeros(); 9],
            sky: sky.nodes.iter().map(|node| entry(node, scale)).collect(),
            aerosol: [colored(low), colored(high)],
            overcast: levels.overcast * (9.0 / 7.0 * exposure),
            night_sky: levels.night * exposure,
            fog: levels.fog * exposure,
            fog_share: levels.fog_share,
            fog_depth: levels.fog_depth,
            bounce: levels.ground * (albedo * exposure),
            extinction: levels.extinction,
            thinning: levels.thinning,
            night,
            headlights: if wet { 1.0 } else { smooth(2_500.0, 400.0, luminance(&levels.ground)) },
            clouds: weather.cloud_cover,
            cover,
            rain: weather.rain,
            snow: weather.snow,
            exposure,
        };
        light.ambient = light.irradiance(sky, scale);
        light
    }

    /// The unit vector in the plane towards the source.
    pub(crate) fn flat(&self) -> nalgebra::Vector2<f64> {
        self.source.xy().try_normalize(1e-9).unwrap_or_else(nalgebra::Vector2::x)
    }

    fn irradiance(&self, sky: &Sky, scale: f64) -> [V<f64>; 9] {
        let flat = self.flat();
        harmonics(|d, _| {
            if d.z < 0.0 {
                return self.bounce;
            }
            let across = d.xy().norm().max(1e-9);
            let around = d.xy().dot(&flat) / across;
            let clear = sky.toward(d.z, around, d.dot(&self.source)) * scale;
            let clouded =
                clear * (1.0 - self.clouds) + self.overcast * ((1.0 + 2.0 * d.z) / 3.0) + self.night_sky;
            let veil = 1.0 - ops::exp(-self.fog_depth / d.z.max(0.01));
            clouded.lerp(&self.fog, veil)
        })
    }
}

/// A node as the shaders read it.
fn entry(node: &Scattered, scale: f64) -> [f32; 4] {
    let [r, g, b] = node.air.map(|channel| (channel * scale) as f32);
    [r, g, b, (luminance(&V::from(node.aerosol)) * scale) as f32]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(elevation: f64, change: impl Fn(&mut Environment)) -> Light {
        let mut environment = Environment::default();
        environment.sun.elevation = elevation;
        environment.sun.illuminance = 133_100.0 * ops::exp(-0.21 / ops::sin(elevation).max(0.01));
        change(&mut environment);
        Light::of(&environment, 0.0)
    }

    /// Irradiance of a normal, as the shaders reckon it.
    fn irradiance(light: &Light, n: V<f64>) -> V<f64> {
        let plain = [
            1.0,
            n.y,
            n.z,
            n.x,
            n.x * n.y,
            n.y * n.z,
            3.0 * n.z * n.z - 1.0,
            n.x * n.z,
            n.x * n.x - n.y * n.y,
        ];
        light.ambient.iter().zip(plain).map(|(coefficient, value)| coefficient * value).sum()
    }

    #[test]
    fn contrast_falls_to_five_percent_at_the_visibility() {
        let light = at(0.7, |environment| environment.weather.visibility = 250.0);
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
        for elevation in [-1.57, -0.3, -0.139, -0.01, 0.0, 0.02, 0.5, 1.57] {
            for clouds in [0.0, 0.5, 1.0] {
                for illuminance in [0.0, 1.0, 200_000.0] {
                    let light = at(elevation, |environment| {
                        environment.sun.illuminance = illuminance;
                        environment.weather.cloud_cover = clouds;
                        environment.weather.visibility = 1.0 + 1e4 * (elevation + 1.57);
                        environment.moon.elevation = -elevation;
                        environment.moon.illuminance = 0.2;
                    });
                    for color in [light.sun, light.overcast, light.bounce, light.fog, light.night_sky] {
                        assert!(
                            color.iter().all(|c| c.is_finite() && *c >= 0.0),
                            "{elevation} {clouds}: {color}"
                        );
                    }
                    assert!(light.ambient.iter().all(|c| c.iter().all(|c| c.is_finite())));
                    assert!(light.sky.iter().flatten().all(|c| c.is_finite() && *c >= 0.0));
                    assert!(light.exposure.is_finite() && light.exposure > 0.0);
                }
            }
        }
    }

    #[test]
    fn the_evening_sun_is_redder_and_the_shade_bluer() {
        let (noon, evening) = (at(1.2, |_| {}), at(0.05, |_| {}));
        assert!(evening.sun.x / evening.sun.z > 2.0 * noon.sun.x / noon.sun.z);
        let shade = irradiance(&noon, V::new(0.0, 0.0, 1.0));
        assert!(shade.z / shade.x > 1.3 * noon.sun.z / noon.sun.x, "{shade} {}", noon.sun);
    }

    /// Nine coefficients hold the irradiance of an even sky to a few percent: 1 facing up, the bounce facing down.
    #[test]
    fn the_harmonics_hold_the_irradiance() {
        let light = at(0.8, |environment| environment.weather.cloud_cover = 1.0);
        let (up, down) = (irradiance(&light, V::z()), irradiance(&light, -V::z()));
        let expected = luminance(&(light.overcast * (7.0 / 9.0) + light.night_sky));
        assert!((luminance(&up) / expected - 1.0).abs() < 0.05, "{} {expected}", luminance(&up));
        assert!((luminance(&down) / luminance(&light.bounce) - 1.0).abs() < 0.25, "{down} {}", light.bounce);
    }

    #[test]
    fn clouds_take_the_beam_and_fog_does() {
        let clear = luminance(&at(0.8, |_| {}).sun);
        assert!(luminance(&at(0.8, |environment| environment.weather.cloud_cover = 0.95).sun) < 0.3 * clear);
        assert!(luminance(&at(0.8, |environment| environment.weather.visibility = 60.0).sun) < 0.1 * clear);
    }

    #[test]
    fn a_moon_lights_the_night_a_little() {
        let moonlit = at(-0.6, |environment| {
            (environment.moon.elevation, environment.moon.illuminance) = (0.8, 0.25);
        });
        let dark = at(-0.6, |_| {});
        assert!(luminance(&moonlit.sun) > 0.001 && luminance(&dark.sun) == 0.0);
        assert!(moonlit.night > 0.99 && dark.night > 0.99);
    }
}
