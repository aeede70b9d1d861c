//! Value noise: random values at the points of a lattice, smoothly joined (Perlin's quintic fade, 2002).

use simworld_core::geometry::Point2;
use simworld_core::seed::Stream;

/// A field over the plane: two octaves of value noise.
#[derive(Clone, Debug)]
pub(crate) struct ValueNoise {
    streams: [Stream; 2],
    /// Lattice points a metre, of the coarse octave.
    frequency: f64,
}

/// Weight of the fine octave, of half the distance.
const FINE: f64 = 0.35;
/// Values of the field and the share of the plane that lies below each: measured over 1.5 million points.
const QUANTILES: [(f64, f64); 17] = [
    (0.0, 0.0),
    (0.1068, 0.005),
    (0.161, 0.02),
    (0.2115, 0.05),
    (0.2628, 0.1),
    (0.3355, 0.2),
    (0.3948, 0.3),
    (0.4486, 0.4),
    (0.5, 0.5),
    (0.5514, 0.6),
    (0.6052, 0.7),
    (0.6645, 0.8),
    (0.7372, 0.9),
    (0.7885, 0.95),
    (0.839, 0.98),
    (0.8932, 0.995),
    (1.0, 1.0),
];

impl ValueNoise {
    /// A field whose values change over `scale` m.
    pub(crate) fn new(stream: Stream, scale: f64) -> Self {
        Self { streams: [stream.named("coarse"), stream.named("fine")], frequency: 1.0 / scale }
    }

    /// The value at a point, in [0, 1).
    pub(crate) fn at(&self, point: Point2) -> f64 {
        let coarse = octave(self.streams[0], point.x * self.frequency, point.y * self.frequency);
        let fine = octave(self.streams[1], point.x * self.frequency * 2.0, point.y * self.frequency * 2.0);
        (coarse + FINE * fine) / (1.0 + FINE)
    }

    /// The share of the plane that has a lower value: spread evenly over [0, 1].
    pub(crate) fn uniform_at(&self, point: Point2) -> f64 {
        let value = self.at(point);
        let mut before = QUANTILES[0];
        for after in &QUANTILES[1..] {
            if value < after.0 {
                return before.1 + (after.1 - before.1) * (value - before.0) / (after.0 - before.0);
            }
            before = *after;
        }
        1.0
    }
}

fn octave(stream: Stream, x: f64, y: f64) -> f64 {
    let (column, row) = (x.floor(), y.floor());
    let (u, v) = (fade(x - column), fade(y - row));
    let (column, row) = (column as i64, row as i64);
    let lattice = |dx: i64, dy: i64| {
        let path = stream.indexed((column + dx) as u64).indexed((row + dy) as u64);
        (path.seed().0 >> 11) as f64 * (1.0 / (1_u64 << 53) as f64)
    };
    let south = lattice(0, 0) * (1.0 - u) + lattice(1, 0) * u;
    let north = lattice(0, 1) * (1.0 - u) + lattice(1, 1) * u;
    south * (1.0 - v) + north * v
}

fn fade(t: f64) -> f64 {
    t * t * t * (t * (t * 6.0 - 15.0) + 10.0)
}

#[cfg(test)]
mod tests {
    use simworld_core::seed::Seed;

    use super::*;

    #[test]
    fn the_field_is_smooth_and_evenly_spread() {
        let noise = ValueNoise::new(Seed(1).stream("noise"), 100.0);
        let mut tenths = [0_usize; 10];
        let count = 200_000_usize;
        for index in 0..count {
            let at = Point2::new((index % 447) as f64 * 61.7, (index / 447) as f64 * 73.1);
            let value = noise.uniform_at(at);
            tenths[((value * 10.0) as usize).min(9)] += 1;
            let beside = noise.uniform_at(at + simworld_core::geometry::Vector2::new(0.1, 0.0));
            assert!((value - beside).abs() < 0.02, "a step at {at}");
        }
        for tenth in tenths {
            assert!((tenth as f64 / count as f64 - 0.1).abs() < 0.015, "{tenths:?}");
        }
    }
}
