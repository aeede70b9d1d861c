//! Drops and flakes in the air, as sensors of range meet them: how many of which size, and which of them a beam or a pixel strikes.
//!
//! Sizes are those of Marshall and Palmer (The distribution of raindrops with size, Journal of Meteorology 5 (1948) 165-166) for rain, and
//! of Gunn and Marshall (The distribution with size of aggregate snowflakes, Journal of Meteorology 15 (1958) 452-461) for snow: both
//! fall exponentially with the diameter of the drop, melted where it is snow. Places are independent from scan to scan, since what
//! falls is elsewhere by then.

use simworld_core::camera::Camera;
use simworld_core::environment::Weather;
use simworld_core::ops;
use simworld_core::seed::{Stream, StreamRng};

use super::lidar::DARK;
use crate::Frame;
use crate::falling::amounts;

/// Less than that falls unseen, mm/h.
const TRACE: f64 = 0.05;
/// What a drop sends straight back: water of refractive index 1.33 met squarely (Fresnel).
const WATER: f64 = 0.02;
/// What fresh snow reflects near 0.9 µm (Wiscombe and Warren, Journal of the Atmospheric Sciences 37 (1980) 2712-2733).
const SNOW: f64 = 0.8;
/// A flake of 100 kg/m³ is so many times as wide as the drop that it melts to.
const FLUFFY: f64 = 2.154;
/// Radius of a beam as it leaves the scanner, m, and by how much it grows a metre (Velodyne VLP-16, user manual 63-9243).
const APERTURE: f64 = 0.005;
const SPREAD: f64 = 0.0015;
/// Nearer than this a scanner hears no better than there, m: its receiver does not see the whole beam yet.
const OVERLAP: f64 = 5.0;
/// Steps in which echoes along a beam are counted, and in which their powers are.
const STEPS: usize = 256;
const CELLS: usize = 48;
/// Nearer to a camera's eye than this nothing is in focus, m.
const NEAREST: f64 = 0.05;
/// The most drops of a picture.
const MOST: f64 = 2e5;

/// What falls, of one kind.
#[derive(Clone, Copy, Debug)]
struct Kind {
    /// Drops a m³ of air and mm of diameter, at no diameter.
    density: f64,
    /// How fast they get fewer with diameter, 1/mm.
    slope: f64,
    /// Diameter of the body over that of its water.
    width: f64,
    reflectance: f64,
}

impl Kind {
    /// How many a m³ are at least so wide, m.
    fn wider_than(&self, diameter: f64) -> f64 {
        self.density / self.slope * ops::exp(-self.slope * diameter * 1e3 / self.width)
    }

    /// A diameter of at least that, m: what is left of an exponential distribution is one again.
    fn diameter(&self, least: f64, rng: &mut StreamRng) -> f64 {
        least + self.width * 1e-3 * rng.exponential(self.slope)
    }
}

/// Rain and snow of a weather.
fn kinds(weather: &Weather) -> impl Iterator<Item = Kind> + use<> {
    let (rain, snow) = amounts(weather);
    let rain = (rain > TRACE).then(|| Kind {
        density: 8000.0,
        slope: 4.1 * ops::pow(rain, -0.21),
        width: 1.0,
        reflectance: WATER,
    });
    let snow = (snow > TRACE).then(|| Kind {
        density: 3800.0 * ops::pow(snow, -0.87),
        slope: 2.55 * ops::pow(snow, -0.48),
        width: FLUFFY,
        reflectance: SNOW,
    });
    rain.into_iter().chain(snow)
}

/// What a beam struck: how far off, m, and the intensity of its echo.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Struck {
    pub range: f64,
    pub intensity: f64,
}

impl Struck {
    /// What comes back of it, intensity a m²: of several echoes of a beam the scanner reports the strongest.
    pub(super) fn power(&self) -> f64 {
        let far = self.range.max(OVERLAP);
        self.intensity / (far * far)
    }
}

/// The drops and flakes that a scanner hears.
#[derive(Clone, Debug)]
pub(super) struct Clutter {
    nearest: f64,
    step: f64,
    /// Powers, ascending by one factor.
    powers: Vec<f64>,
    /// For each of them, how many echoes at least so strong are to be expected from the nearest range as far as the end of each step.
    expected: Vec<Vec<f64>>,
}

impl Clutter {
    /// What a scanner of those ranges (m) hears in air that takes `extinction` (1/m) of a beam; nothing where nothing falls.
    pub(super) fn new(weather: &Weather, nearest: f64, farthest: f64, extinction: f64) -> Option<Self> {
        let kinds: Vec<Kind> = kinds(weather).collect();
        let step = (farthest - nearest) / STEPS as f64;
        // From what is just heard, a dark surface at the farthest range, to snow that fills the beam.
        let (least, most) = (DARK / (farthest * farthest), SNOW / (OVERLAP * OVERLAP));
        if kinds.is_empty() || least >= most {
            return None;
        }
        let powers: Vec<f64> =
            (0..=CELLS).map(|cell| least * ops::pow(most / least, cell as f64 / CELLS as f64)).collect();
        let row = |power: &f64| -> Vec<f64> {
            let mut sum = 0.0;
            let steps = (0..STEPS).map(|index| {
                let range = nearest + (index as f64 + 0.5) * step;
                let heard = |kind: &Kind| {
                    least_diameter(kind, range, *power, extinction)
                        .map_or(0.0, |least| kind.wider_than(least))
                };
                let radius = beam_radius(range);
                let volume = std::f64::consts::PI * radius * radius * step;
                sum += volume * kinds.iter().map(heard).sum::<f64>();
                sum
            });
            steps.collect()
        };
        let expected = powers.iter().map(row).collect();
        Some(Self { nearest, step, powers, expected })
    }

    /// How many echoes at least as strong as that are to be expected.
    fn total(&self, cell: usize) -> f64 {
        self.expected[cell].last().copied().unwrap_or_default()
    }

    /// The strongest echo of a drop or a flake on a beam, if one is heard: a Poisson process in range and power.
    pub(super) fn strike(&self, stream: Stream) -> Option<Struck> {
        let mut rng = stream.rng();
        let sum = rng.exponential(1.0);
        if sum >= self.total(0) {
            return None;
        }
        // Fewer are to be expected the stronger they are.
        let cell = (0..CELLS).rev().find(|cell| self.total(*cell) > sum)?;
        let (weak, strong) = (self.total(cell), self.total(cell + 1));
        let share = ((weak - sum) / (weak - strong)).clamp(0.0, 1.0);
        let power = self.powers[cell] * ops::pow(self.powers[cell + 1] / self.powers[cell], share);
        // Where those of about that power are.
        let between = |index: usize| self.expected[cell][index] - self.expected[cell + 1][index];
        let wanted = rng.unit() * (weak - strong);
        let index = (0..STEPS).find(|index| between(*index) >= wanted)?;
        let range = self.nearest + (index as f64 + rng.unit()) * self.step;
        let far = range.max(OVERLAP);
        Some(Struck { range, intensity: (power * far * far).min(1.0) })
    }
}

/// The least diameter whose echo from a range has a power, m; none if it would have to be wider than the beam.
fn least_diameter(kind: &Kind, range: f64, power: f64, extinction: f64) -> Option<f64> {
    let far = range.max(OVERLAP);
    let share = power * far * far * ops::exp(2.0 * extinction * range) / kind.reflectance;
    (share <= 1.0).then(|| 2.0 * beam_radius(range) * share.sqrt())
}

fn beam_radius(range: f64) -> f64 {
    APERTURE + SPREAD * range
}

/// Puts drops and flakes before what a depth camera saw, where one covers a pixel's middle and is at least a pixel wide. Nothing else of the
/// frame changes.
pub(super) fn fall_before(frame: &mut Frame, camera: &Camera, weather: &Weather, stream: Stream) {
    let k = &camera.intrinsics;
    let (width, height) = (f64::from(k.width), f64::from(k.height));
    if frame.depth.len() != k.width as usize * k.height as usize {
        return;
    }
    for (number, kind) in (0..).zip(kinds(weather)) {
        let mut rng = stream.indexed(number).rng();
        let focal = k.fx.min(k.fy);
        // Those a pixel wide at depth z are z / focal wide, so there are density / slope * exp(-fall * z) a m³ of them at depth z, in a slice of
        // area * z².
        let fall = kind.slope * 1e3 / (kind.width * focal);
        let area = width * height / (k.fx * k.fy);
        let mean = kind.density / kind.slope * area * 2.0 / (fall * fall * fall);
        let mut arrived = rng.exponential(1.0);
        while arrived < mean.min(MOST) {
            arrived += rng.exponential(1.0);
            // The depth follows a gamma distribution of shape 3.
            let depth = rng.exponential(fall) + rng.exponential(fall) + rng.exponential(fall);
            let middle = [rng.uniform(0.0, width), rng.uniform(0.0, height)];
            let diameter = kind.diameter(depth / focal, &mut rng);
            if depth >= NEAREST {
                cover(frame, middle, 0.5 * diameter * focal / depth, depth as f32);
            }
        }
    }
}

/// Brings the pixels whose middles lie in a disc to a depth, unless something is nearer.
fn cover(frame: &mut Frame, middle: [f64; 2], radius: f64, depth: f32) {
    let [columns, rows] = [(middle[0], frame.width), (middle[1], frame.height)].map(|(at, size)| {
        let first = (at - radius - 0.5).ceil().max(0.0) as usize;
        first..((at + radius + 0.5).floor().max(0.0) as usize).min(size as usize)
    });
    for (x, y) in rows.flat_map(|y| columns.clone().map(move |x| (x, y))) {
        let off = [x as f64 + 0.5 - middle[0], y as f64 + 0.5 - middle[1]];
        if off[0] * off[0] + off[1] * off[1] <= radius * radius {
            let seen = &mut frame.depth[y * frame.width as usize + x];
            *seen = seen.min(depth);
        }
    }
}

#[cfg(test)]
mod tests {
    use simworld_core::camera::Intrinsics;
    use simworld_core::geometry::{Point3, pose_facing};
    use simworld_core::seed::Seed;

    use super::*;

    fn rain(amount: f64) -> Weather {
        Weather { rain: amount, snow: 0.0, temperature: 12.0, ..Weather::default() }
    }

    #[test]
    fn as_much_water_falls_as_the_weather_says() {
        // By the sizes of drops and their speeds, 9.65 - 10.3 exp(-0.6 D) m/s (Atlas, Srivastava and Sekhon 1973), it rains 10 mm/h within
        // what the fit of Marshall and Palmer is good for.
        let kind = kinds(&rain(10.0)).next().unwrap();
        let step = 0.01;
        let flux: f64 = (1..800)
            .map(|index| {
                let d = f64::from(index) * step;
                let volume = std::f64::consts::PI / 6.0 * (d * 1e-3) * (d * 1e-3) * (d * 1e-3);
                let speed = (9.65 - 10.3 * ops::exp(-0.6 * d)).max(0.0);
                kind.density * ops::exp(-kind.slope * d) * step * volume * speed
            })
            .sum();
        let amount = flux * 3600.0 * 1e3;
        assert!((8.0..13.0).contains(&amount), "{amount} mm/h");
        assert!((kind.wider_than(0.0) - 8000.0 / (4.1 * ops::pow(10.0, -0.21))).abs() < 1e-6);
    }

    #[test]
    fn echoes_are_as_many_as_are_expected_and_heard_and_more_where_more_falls() {
        assert!(Clutter::new(&rain(0.0), 0.5, 120.0, 0.0).is_none());
        let count = |weather: &Weather| {
            let clutter = Clutter::new(weather, 0.5, 120.0, 0.0).unwrap();
            let beams = 20_000_u32;
            let stream = Seed(5).stream("tests/drops");
            let struck: Vec<Struck> =
                (0..beams).filter_map(|beam| clutter.strike(stream.indexed(beam.into()))).collect();
            let expected = 1.0 - ops::exp(-clutter.total(0));
            let share = struck.len() as f64 / f64::from(beams);
            let spread = (expected / f64::from(beams)).sqrt();
            assert!((share - expected).abs() < 5.0 * spread, "{share} of {expected}");
            // So are the strong ones among them.
            let strong = clutter.powers[10];
            let found = struck.iter().filter(|struck| struck.power() > strong).count();
            let expected = 1.0 - ops::exp(-clutter.total(10));
            let off = (found as f64 / f64::from(beams) - expected).abs();
            assert!(off < 5.0 * (expected.max(1e-4) / f64::from(beams)).sqrt(), "{found}, {expected}");
            for struck in &struck {
                assert!((0.5..=120.0).contains(&struck.range), "{struck:?}");
                assert!(struck.power() >= DARK / 14_400.0 * 0.999 && struck.intensity <= 1.0, "{struck:?}");
            }
            let near = struck.iter().filter(|struck| struck.range < 12.0).count();
            assert!(weather.snow > 0.0 || near * 10 > struck.len() * 9, "rain is heard near the scanner");
            share
        };
        let snow = Weather { snow: 2.0, temperature: -5.0, ..rain(0.0) };
        let (drizzle, shower) = (count(&rain(1.0)), count(&rain(30.0)));
        assert!(drizzle > 0.0 && shower > 3.0 * drizzle && shower < 0.5, "{drizzle} {shower}");
        assert!(count(&snow) > drizzle);
        // Snow that melts on its way is rain.
        let melting = Weather { temperature: 6.0, ..snow };
        assert_eq!(amounts(&melting), amounts(&rain(2.0)));
    }

    #[test]
    fn drops_stand_before_what_is_behind_them_and_are_the_same_every_time() {
        let camera = Camera::looking_along(
            &pose_facing(Point3::origin(), 0.0),
            Intrinsics::from_fov(640, 480, 1.0).unwrap(),
        );
        let fallen = |weather: &Weather, behind: f32, tick: u64| {
            let mut frame = Frame::new();
            frame.resize(640, 480);
            frame.depth.fill(behind);
            fall_before(&mut frame, &camera, weather, Seed(1).stream("tests/drops").indexed(tick));
            frame.depth
        };
        let covered = |depth: &[f32]| depth.iter().filter(|depth| **depth < 30.0).count();
        let heavy = fallen(&rain(30.0), 30.0, 4);
        assert!(heavy == fallen(&rain(30.0), 30.0, 4) && heavy != fallen(&rain(30.0), 30.0, 5));
        assert_eq!(covered(&fallen(&rain(0.0), 30.0, 4)), 0);
        let many: usize = (0..8).map(|tick| covered(&fallen(&rain(30.0), 30.0, tick))).sum();
        let few: usize = (0..8).map(|tick| covered(&fallen(&rain(2.0), 30.0, tick))).sum();
        assert!(many > 2 * few && few > 0 && many < 8 * 30_000, "{few} {many}");
        assert!(heavy.iter().all(|depth| f64::from(*depth) >= NEAREST));
        // A wall before the drops hides them.
        assert_eq!(covered(&fallen(&rain(30.0), 0.04, 4)), 640 * 480);
        assert!(fallen(&rain(30.0), 0.04, 4).iter().all(|depth| *depth == 0.04));
    }
}
