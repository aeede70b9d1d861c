//! Heights of natural land by kind of scene, from gradient noise; the water stands at 0.
//!
//! Noise: `OpenSimplex2` with fractal sums (Musgrave 1993), by the crate `fastnoise-lite`: basic arithmetic alone, and so the same
//! bits everywhere.

use fastnoise_lite::{FastNoiseLite, FractalType, NoiseType};
use simworld_core::geometry::{Point2, Vector2};
use simworld_core::ops;
use simworld_core::seed::Stream;
use simworld_core::spec::{SceneKind, Water};

use super::grid::Grid;

/// Half the bed of a river from bank to bank, and half the width of its valley, m.
const RIVER_HALF: f64 = 7.0;
const VALLEY: f64 = 110.0;
/// Depth of rivers and lakes below the water, m.
const DEPTH: f64 = 2.5;
/// Radius of a lake, m.
const LAKE: f64 = 62.0;
/// Highest above the water: rolling hills, mountains, the middle of an island, m.
const HILLS: f64 = 24.0;
const MOUNTAINS: f64 = 130.0;
const ISLAND: f64 = 42.0;
/// Deepest water around an island, m.
const SEA: f64 = -9.0;

/// What shapes the land.
pub(super) struct Relief {
    kind: SceneKind,
    half: f64,
    hills: FastNoiseLite,
    ridges: FastNoiseLite,
    bends: FastNoiseLite,
    waters: Vec<Basin>,
}

/// Water that lies in the land.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Basin {
    pub(super) water: Water,
    /// A place in it, m.
    pub(super) middle: Point2,
}

/// Noise of a stream: hills so far apart, m, with so many octaves.
pub(super) fn noise(stream: Stream, wavelength: f64, octaves: i32, fractal: FractalType) -> FastNoiseLite {
    let mut noise = FastNoiseLite::with_seed(stream.seed().0 as i32);
    noise.set_noise_type(Some(NoiseType::OpenSimplex2));
    noise.set_frequency(Some((1.0 / wavelength) as f32));
    noise.set_fractal_type(Some(fractal));
    noise.set_fractal_octaves(Some(octaves));
    noise
}

/// Noise at a place, in [-1, 1] or little beyond.
pub(super) fn at(noise: &FastNoiseLite, place: Point2) -> f64 {
    f64::from(noise.get_noise_2d(place.x, place.y))
}

/// From 0 at `from` to 1 at `to`, without a kink.
pub(super) fn smooth(from: f64, to: f64, x: f64) -> f64 {
    let share = ((x - from) / (to - from)).clamp(0.0, 1.0);
    share * share * (3.0 - 2.0 * share)
}

impl Relief {
    /// The land of a kind with these waters.
    pub(super) fn new(kind: SceneKind, half: f64, waters: &[Water], stream: Stream) -> Self {
        let basins = waters.iter().filter(|water| **water != Water::Harbour).map(|water| {
            // Lakes and rivers lie in the east, roads keep to the west: nothing has to be bridged.
            let middle = match (kind, water) {
                (SceneKind::Island, _) => Point2::new(half * 0.12, -half * 0.05),
                (_, Water::River) => Point2::new(half * 0.72, 0.0),
                _ => Point2::new(half * 0.3, -half * 0.12),
            };
            Basin { water: *water, middle }
        });
        Self {
            kind,
            half,
            hills: noise(stream.named("hills"), half * 0.75, 3, FractalType::FBm),
            ridges: noise(stream.named("ridges"), half * 0.9, 4, FractalType::Ridged),
            bends: noise(stream.named("bends"), half * 0.5, 2, FractalType::FBm),
            waters: basins.collect(),
        }
    }

    /// The waters in the land.
    pub(super) fn waters(&self) -> &[Basin] {
        &self.waters
    }

    /// The land, with one body of water for each that is wished for, and one piece of land around or in it.
    pub(super) fn shape(&self) -> Grid {
        let mut grid = Grid::shaped(self.half, |place| self.height(place));
        let mut wet: Vec<Point2> = self.waters.iter().map(|basin| self.in_water(basin)).collect();
        if self.kind == SceneKind::Island {
            wet.push(Point2::new(-self.half, -self.half));
        }
        grid.settle_water(&wet);
        grid
    }

    /// A place that is under the water of a basin.
    pub(super) fn in_water(&self, basin: &Basin) -> Point2 {
        match basin.water {
            Water::River => Point2::new(self.river_at(basin, 0.0), 0.0),
            _ => basin.middle,
        }
    }

    /// How far east a river is at so far north, m.
    fn river_at(&self, basin: &Basin, north: f64) -> f64 {
        basin.middle.x + 0.16 * self.half * at(&self.bends, Point2::new(0.0, north))
    }

    /// Height of the land with its waters, m.
    fn height(&self, place: Point2) -> f64 {
        let mut height = match self.kind {
            SceneKind::Island => self.island(place),
            SceneKind::Wilderness => self.mountains(place),
            _ => 3.0 + HILLS * 0.5 * (1.0 + at(&self.hills, place)) * 0.9,
        };
        for basin in &self.waters {
            let (shore, valley) = if basin.water == Water::River {
                ((place.x - self.river_at(basin, place.y)).abs() - RIVER_HALF, VALLEY)
            } else {
                let lake = if self.kind == SceneKind::Island { LAKE * 0.55 } else { LAKE };
                let wobble = 1.0 + 0.25 * at(&self.bends, place + Vector2::new(311.0, 97.0));
                let valley = if self.kind == SceneKind::Island { VALLEY * 1.4 } else { VALLEY };
                ((place - basin.middle).norm() - lake * wobble, valley)
            };
            // Down to the bank in the valley, then under the water.
            let bank = 0.8 + shore.max(0.0) * 0.04;
            height = bank + (height - bank) * smooth(0.0, valley, shore);
            if shore < 8.0 {
                height = height.min(-DEPTH + (DEPTH + 0.8) * smooth(-10.0, 8.0, shore));
            }
        }
        height
    }

    fn mountains(&self, place: Point2) -> f64 {
        // Low in the south-east, where the lake is; high in the north-west.
        let rise = (place.y - place.x) / (2.0 * self.half);
        let high = smooth(-0.35, 0.75, rise + 0.15 * at(&self.bends, place));
        let ridge = 0.5 * (1.0 + at(&self.ridges, place));
        let knolls = 0.5 * (1.0 + at(&self.hills, place));
        5.0 + 16.0 * knolls + MOUNTAINS * high * (0.35 + 0.65 * ridge)
    }

    /// A dome with bays and headlands; low and flat near the sea, as behind a beach.
    fn island(&self, place: Point2) -> f64 {
        let off = place.coords.norm() / self.half;
        // The coast lies at half to three quarters of the way to the edge, and never at it.
        let coast = 0.63 + 0.12 * at(&self.bends, place) + 0.05 * at(&self.hills, place);
        let inland = (coast - off) * self.half;
        if inland <= 0.0 {
            return (inland * 0.08).clamp(SEA, -0.02);
        }
        let beach = 0.06 * inland.min(30.0);
        let knolls = 0.5 * (1.0 + at(&self.hills, place));
        let ridge = 0.5 * (1.0 + at(&self.ridges, place));
        beach + ISLAND * smooth(25.0, self.half * 0.62, inland) * (0.35 + 0.4 * knolls + 0.25 * ridge)
    }
}

/// The direction of a bearing in turns from east, for rings around the middle.
pub(super) fn bearing(turns: f64) -> Vector2 {
    let (sin, cos) = ops::sin_cos(turns * std::f64::consts::TAU);
    Vector2::new(cos, sin)
}
