//! The light of a cloudless sky: Rayleigh, aerosol and ozone, single scattering and an estimate of all further ones.
//!
//! After S. Hillaire, A Scalable and Production Ready Sky and Atmosphere Rendering Technique, Computer Graphics Forum 39(4)
//! (2020): its coefficients, and its geometric series for multiple scattering (equations 5 to 10), summed on the CPU into a
//! small table each time that the light changes. Heights in m above the ground, cosines from the zenith, RGB linear sRGB.

use std::sync::OnceLock;

use nalgebra::Vector3 as V;
use simworld_core::ops;

/// Radius of the earth and of the top of its air, m.
const GROUND: f64 = 6_360_000.0;
const TOP: f64 = 6_460_000.0;
/// Scattering at the ground, 1/m.
const RAYLEIGH: [f64; 3] = [5.802e-6, 13.558e-6, 33.1e-6];
/// Absorption at the height where there is most ozone, 1/m.
const OZONE: [f64; 3] = [0.650e-6, 1.881e-6, 0.085e-6];
/// Heights at which air and aerosol have fallen to 1/e, m.
const RAYLEIGH_HEIGHT: f64 = 8000.0;
const AEROSOL_HEIGHT: f64 = 1200.0;
/// Share of what aerosol takes that it scatters.
const AEROSOL_ALBEDO: f64 = 0.9;
/// Asymmetry of the aerosol's phase function.
pub(crate) const ASYMMETRY: f64 = 0.8;
/// What the ground throws back.
const GROUND_ALBEDO: f64 = 0.3;
/// Steps along a path.
const STEPS: usize = 20;

/// Columns of air, aerosol and ozone from a height towards a direction up to the top, m of air as dense as at the ground.
struct Columns {
    entries: Vec<[f64; 3]>,
}

const HEIGHTS: usize = 24;
const COSINES: usize = 64;
/// Lowest cosine of the table; below it everything is behind the earth.
const LEAST: f64 = -0.2;

fn densities(height: f64) -> [f64; 3] {
    let height = height.max(0.0);
    [
        ops::exp(-height / RAYLEIGH_HEIGHT),
        ops::exp(-height / AEROSOL_HEIGHT),
        (1.0 - (height - 25_000.0).abs() / 15_000.0).max(0.0),
    ]
}

/// Distance to a sphere around the earth's middle, from inside of it.
fn to_sphere(radius: f64, cosine: f64, sphere: f64) -> f64 {
    let inside = radius * radius * (cosine * cosine - 1.0) + sphere * sphere;
    -radius * cosine + inside.max(0.0).sqrt()
}

/// Whether a ray from a radius meets the ground.
fn meets_ground(radius: f64, cosine: f64) -> bool {
    cosine < 0.0 && radius * radius * (cosine * cosine - 1.0) + GROUND * GROUND >= 0.0
}

impl Columns {
    fn shared() -> &'static Self {
        static TABLE: OnceLock<Columns> = OnceLock::new();
        TABLE.get_or_init(Self::build)
    }

    fn build() -> Self {
        let mut entries = Vec::with_capacity(HEIGHTS * COSINES);
        for row in 0..HEIGHTS {
            let share = row as f64 / (HEIGHTS - 1) as f64;
            let radius = GROUND + (TOP - GROUND) * share * share;
            for column in 0..COSINES {
                let share = column as f64 / (COSINES - 1) as f64;
                entries.push(Self::along(radius, LEAST + (1.0 - LEAST) * share * share));
            }
        }
        Self { entries }
    }

    fn along(radius: f64, cosine: f64) -> [f64; 3] {
        let length = to_sphere(radius, cosine, TOP);
        let mut sum = [0.0; 3];
        let mut from = 0.0;
        for step in 1..=2 * STEPS {
            // Short steps first: the air is densest near the ground.
            let share = step as f64 / (2 * STEPS) as f64;
            let to = length * share * share;
            let at = 0.5 * (from + to);
            let height = (radius * radius + at * at + 2.0 * radius * cosine * at).sqrt() - GROUND;
            for (sum, density) in sum.iter_mut().zip(densities(height)) {
                *sum += density * (to - from);
            }
            from = to;
        }
        sum
    }

    /// Interpolated; `None` behind the earth.
    fn towards(&self, radius: f64, cosine: f64) -> Option<[f64; 3]> {
        if meets_ground(radius, cosine) {
            return None;
        }
        let place = |share: f64, count: usize| {
            let at = share.clamp(0.0, 1.0).sqrt() * (count - 1) as f64;
            let low = (at as usize).min(count - 2);
            (low, at - low as f64)
        };
        let (row, down) = place((radius - GROUND) / (TOP - GROUND), HEIGHTS);
        let (column, right) = place((cosine - LEAST) / (1.0 - LEAST), COSINES);
        let entry = |row: usize, column: usize| V::from(self.entries[row * COSINES + column]);
        let above = entry(row, column).lerp(&entry(row, column + 1), right);
        let below = entry(row + 1, column).lerp(&entry(row + 1, column + 1), right);
        Some(above.lerp(&below, down).into())
    }
}

/// Light of one direction of the sky per illuminance of a surface that faces the source above the air, 1/sr.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Scattered {
    /// By air and by all scatterings but the first: hardly changes around the source.
    pub air: [f64; 3],
    /// By aerosol at the first scattering, to be multiplied by its phase function.
    pub aerosol: [f64; 3],
}

/// Air with an amount of aerosol, and a source of light above it.
pub(crate) struct Atmosphere {
    /// Extinction of aerosol at the ground, 1/m.
    aerosol: f64,
    /// Cosine of the source from the zenith.
    source: f64,
    /// Light scattered more than once, by height.
    multiple: [V<f64>; LEVELS],
}

const LEVELS: usize = 5;
const LEVEL_HEIGHTS: [f64; LEVELS] = [0.0, 2000.0, 8000.0, 20_000.0, 50_000.0];

impl Atmosphere {
    /// The air whose visibility at the ground is `visibility` m, under a source whose sine of elevation is `height`.
    ///
    /// Visibilities below 8 km are those of mist that lies on the ground, not of all the air.
    pub(crate) fn new(visibility: f64, height: f64) -> Self {
        let extinction = 3.0 / visibility.clamp(8_000.0, 200_000.0);
        let mut made = Self {
            aerosol: (extinction - RAYLEIGH[1]).max(1e-6),
            source: height,
            multiple: [V::zeros(); LEVELS],
        };
        made.multiple = LEVEL_HEIGHTS.map(|height| made.multiply(height));
        made
    }

    fn thinned(&self, columns: [f64; 3]) -> V<f64> {
        V::from_fn(|channel, _| {
            let depth =
                RAYLEIGH[channel] * columns[0] + self.aerosol * columns[1] + OZONE[channel] * columns[2];
            ops::exp(-depth)
        })
    }

    /// The share of light that comes down to the ground from a sine of elevation.
    pub(crate) fn transmittance(&self, height: f64) -> V<f64> {
        self.reaching(GROUND + 1.0, height)
    }

    fn reaching(&self, radius: f64, cosine: f64) -> V<f64> {
        Columns::shared().towards(radius, cosine).map_or_else(V::zeros, |columns| self.thinned(columns))
    }

    /// Steps along a ray from a height: calls with the radius in the middle, length, cosine of the source there, and
    /// transmittance from the start. Returns the transmittance of the whole way.
    fn march(
        &self,
        height: f64,
        cosine: f64,
        to_source: f64,
        steps: usize,
        mut visit: impl FnMut(f64, f64, f64, V<f64>),
    ) -> V<f64> {
        let radius = GROUND + height.max(1.0);
        let length = if meets_ground(radius, cosine) {
            let inside = radius * radius * (cosine * cosine - 1.0) + GROUND * GROUND;
            -radius * cosine - inside.max(0.0).sqrt()
        } else {
            to_sphere(radius, cosine, TOP)
        };
        let mut passed = [0.0; 3];
        let mut from = 0.0;
        for step in 1..=steps {
            let share = step as f64 / steps as f64;
            let to = length * share * share;
            let (at, stride) = (0.5 * (from + to), to - from);
            let here = (radius * radius + at * at + 2.0 * radius * cosine * at).sqrt();
            let dense = densities(here - GROUND);
            let half: [f64; 3] = std::array::from_fn(|kind| passed[kind] + 0.5 * dense[kind] * stride);
            let source = ((radius * self.source + at * to_source) / here).clamp(-1.0, 1.0);
            visit(here, stride, source, self.thinned(half));
            for (passed, dense) in passed.iter_mut().zip(dense) {
                *passed += dense * stride;
            }
            from = to;
        }
        self.thinned(passed)
    }

    /// Light that comes to a point from all sides after two scatterings and more, per illuminance (Hillaire, equation 10).
    fn multiply(&self, height: f64) -> V<f64> {
        // Sixteen directions of equal weight: four heights, four sides.
        let (mut second, mut share) = (V::zeros(), V::zeros());
        let across = (1.0 - self.source * self.source).max(0.0).sqrt();
        for ring in [-0.75_f64, -0.25, 0.25, 0.75] {
            let flat = (1.0 - ring * ring).sqrt();
            for side in [0.924, 0.383, -0.383, -0.924] {
                let to_source = ring * self.source + flat * across * side;
                let through = self.march(height, ring, to_source, 10, |here, stride, source, through| {
                    let scattering = self.scattering(here - GROUND);
                    let lit = self.reaching(here, source);
                    let passing = through.component_mul(&scattering) * (stride / 16.0);
                    second += passing.component_mul(&lit) / (4.0 * std::f64::consts::PI);
                    share += passing;
                });
                if meets_ground(GROUND + height.max(1.0), ring) {
                    let lit = self.transmittance(self.source) * (self.source.max(0.0) * GROUND_ALBEDO);
                    second += through.component_mul(&lit) / (16.0 * std::f64::consts::PI);
                }
            }
        }
        V::from_fn(|channel, _| second[channel] / (1.0 - share[channel].min(0.95)))
    }

    fn scattering(&self, height: f64) -> V<f64> {
        let [air, aerosol, _] = densities(height);
        V::from(RAYLEIGH) * air + V::repeat(self.aerosol * AEROSOL_ALBEDO * aerosol)
    }

    fn multiple_at(&self, height: f64) -> V<f64> {
        let above = LEVEL_HEIGHTS.iter().position(|level| *level > height).unwrap_or(LEVELS - 1).max(1);
        let (low, high) = (LEVEL_HEIGHTS[above - 1], LEVEL_HEIGHTS[above]);
        self.multiple[above - 1].lerp(&self.multiple[above], ((height - low) / (high - low)).clamp(0.0, 1.0))
    }

    /// What comes from a direction with a sine of elevation, whose cosine from the source is `to_source`.
    pub(crate) fn toward(&self, height: f64, to_source: f64) -> Scattered {
        let rayleigh = 3.0 / (16.0 * std::f64::consts::PI) * (1.0 + to_source * to_source);
        let (mut air, mut aerosol) = (V::zeros(), V::zeros());
        self.march(1.0, height.max(0.0), to_source, STEPS, |here, stride, source, through| {
            let [thin, haze, _] = densities(here - GROUND);
            let lit = self.reaching(here, source);
            let further = self.multiple_at(here - GROUND).component_mul(&self.scattering(here - GROUND));
            let first = V::from(RAYLEIGH).component_mul(&lit) * (thin * rayleigh);
            air += through.component_mul(&(first + further)) * stride;
            aerosol += through.component_mul(&lit) * (self.aerosol * AEROSOL_ALBEDO * haze * stride);
        });
        Scattered { air: air.into(), aerosol: aerosol.into() }
    }
}

/// The phase function of Henyey and Greenstein, 1/sr; its twin is in sky.wgsl.
pub(crate) fn phase(cosine: f64) -> f64 {
    let g = ASYMMETRY;
    let below = 1.0 + g * g - 2.0 * g * cosine;
    (1.0 - g * g) / (4.0 * std::f64::consts::PI * below * below.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn luminance(color: V<f64>) -> f64 {
        color.dot(&V::new(0.2126, 0.7152, 0.0722))
    }

    /// Vertical optical depths: Rayleigh 0.1085 at the green coefficient and scale height, as integrals of the profiles.
    #[test]
    fn the_columns_are_those_of_the_profiles() {
        let [air, aerosol, ozone] = Columns::along(GROUND, 1.0);
        assert!((air / RAYLEIGH_HEIGHT - 1.0).abs() < 0.01, "{air}");
        assert!((aerosol / AEROSOL_HEIGHT - 1.0).abs() < 0.02, "{aerosol}");
        assert!((ozone / 15_000.0 - 1.0).abs() < 0.02, "{ozone}");
        for (height, cosine) in [(1.0, 0.9), (900.0, 0.31), (1.0, 0.05), (12_000.0, -0.02)] {
            let (exact, table) =
                (Columns::along(GROUND + height, cosine), Columns::shared().towards(GROUND + height, cosine));
            let table = table.expect("above the ground");
            let share = table[0] / exact[0];
            assert!((share - 1.0).abs() < 0.06, "{height} {cosine}: {share}");
        }
    }

    #[test]
    fn the_zenith_is_blue_and_the_sunset_red() {
        let noon = Atmosphere::new(30_000.0, 0.9).toward(1.0, 0.9);
        assert!(noon.air[2] > 2.0 * noon.air[0], "{noon:?}");
        let low = Atmosphere::new(30_000.0, 0.03).transmittance(0.03);
        assert!(low.x > 4.0 * low.z && low.x > low.y, "{low}");
    }

    /// A clear sky sends an eighth to a third of what the high sun does, and at dusk three magnitudes less (IES, CIE: 8 to
    /// 20 klx of 100 klx; 400 lux as the sun sets, 3.4 lux at the end of civil twilight).
    #[test]
    fn the_sky_is_as_bright_as_skies_are() {
        let level = |height: f64| {
            let air = Atmosphere::new(30_000.0, height);
            let across = (1.0 - height * height).sqrt();
            let mut sum = V::zeros();
            for ring in 0..8 {
                let z = (f64::from(ring) + 0.5) / 8.0;
                for side in 0..16 {
                    let angle = (f64::from(side) + 0.5) * std::f64::consts::PI / 16.0;
                    let cosine = z * height + (1.0 - z * z).sqrt() * across * ops::cos(angle);
                    let light = air.toward(z, cosine);
                    sum += (V::from(light.air) + V::from(light.aerosol) * phase(cosine)) * z;
                }
            }
            luminance(sum) * 2.0 * std::f64::consts::PI / 128.0 * 128_000.0
        };
        let noon = level(0.8);
        assert!((8_000.0..32_000.0).contains(&noon), "{noon}");
        let set = level(0.0);
        assert!((150.0..1_500.0).contains(&set), "{set}");
        let civil = level(ops::sin(-0.105));
        assert!((0.5..20.0).contains(&civil), "{civil}");
    }

    #[test]
    fn every_air_gives_finite_light() {
        for visibility in [1.0, 500.0, 20_000.0, 500_000.0] {
            for height in [-1.0, -0.2, -0.01, 0.0, 0.01, 1.0] {
                let air = Atmosphere::new(visibility, height);
                for toward in [0.0, 0.01, 0.5, 1.0] {
                    let light = air.toward(toward, toward * height);
                    assert!(light.air.iter().chain(&light.aerosol).all(|c| c.is_finite() && *c >= 0.0));
                }
            }
        }
    }
}
