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
        self.by(point, |octave, column, row| corners(self.streams[octave], column, row))
    }

    /// The share of the plane that has a lower value: spread evenly over [0, 1].
    pub(crate) fn uniform_at(&self, point: Point2) -> f64 {
        share_below(self.at(point))
    }

    /// The value at a point from the random values at the corners of its squares.
    fn by(&self, point: Point2, mut corners: impl FnMut(usize, i64, i64) -> Corners) -> f64 {
        let (x, y) = (point.x * self.frequency, point.y * self.frequency);
        let coarse = octave(x, y, |column, row| corners(0, column, row));
        let fine = octave(x * 2.0, y * 2.0, |column, row| corners(1, column, row));
        (coarse + FINE * fine) / (1.0 + FINE)
    }
}

/// The share of the plane that has a lower value than this one.
fn share_below(value: f64) -> f64 {
    // Counted without a branch: values do not foretell each other.
    let rank = QUANTILES[1..].iter().map(|(least, _)| usize::from(value >= *least)).sum::<usize>();
    let (before, Some(after)) = (QUANTILES[rank], QUANTILES.get(rank + 1)) else { return 1.0 };
    before.1 + (after.1 - before.1) * (value - before.0) / (after.0 - before.0)
}

/// Random values at the corners of a square of the lattice: south-west, south-east, north-west, north-east.
type Corners = [f64; 4];

fn corners(stream: Stream, column: i64, row: i64) -> Corners {
    let value = |path: Stream, row: i64| {
        (path.indexed(row as u64).seed().0 >> 11) as f64 * (1.0 / (1_u64 << 53) as f64)
    };
    let (west, east) = (stream.indexed(column as u64), stream.indexed((column + 1) as u64));
    [value(west, row), value(east, row), value(west, row + 1), value(east, row + 1)]
}

fn octave(x: f64, y: f64, corners: impl FnOnce(i64, i64) -> Corners) -> f64 {
    let (column, row) = (floor(x), floor(y));
    let (u, v) = (fade(x - column as f64), fade(y - row as f64));
    let [southwest, southeast, northwest, northeast] = corners(column, row);
    let south = southwest * (1.0 - u) + southeast * u;
    let north = northwest * (1.0 - u) + northeast * u;
    south * (1.0 - v) + north * v
}

/// The greatest whole number that is not above a number: no call of a function, which `f64::floor` may be.
pub(crate) fn floor(x: f64) -> i64 {
    let whole = x as i64;
    whole - i64::from(whole as f64 > x)
}

fn fade(t: f64) -> f64 {
    t * t * t * (t * (t * 6.0 - 15.0) + 10.0)
}

/// Value noise that remembers the corners of the squares that it was asked of last: the same values, for one who asks
/// of many places beside each other.
#[derive(Clone, Debug)]
pub(crate) struct RememberedNoise {
    noise: ValueNoise,
    /// For squares of the same lowest bits of their key, the last one of each octave.
    squares: [Vec<(i64, i64, Corners)>; 2],
}

impl RememberedNoise {
    /// Remembers so many squares of each octave, about.
    pub(crate) fn new(noise: ValueNoise, squares: usize) -> Self {
        let nowhere = vec![(i64::MAX, i64::MAX, [0.0; 4]); squares.next_power_of_two()];
        Self { noise, squares: [nowhere.clone(), nowhere] }
    }

    /// [`ValueNoise::at`].
    pub(crate) fn at(&mut self, point: Point2) -> f64 {
        let Self { noise, squares } = self;
        noise.by(point, |octave, column, row| {
            let known = &mut squares[octave];
            // Squares that lie together have keys of their own: thirty-two to a row.
            let key = (column + row * 32) as usize & (known.len() - 1);
            if (known[key].0, known[key].1) != (column, row) {
                known[key] = (column, row, corners(noise.streams[octave], column, row));
            }
            known[key].2
        })
    }

    /// [`ValueNoise::uniform_at`].
    pub(crate) fn uniform_at(&mut self, point: Point2) -> f64 {
        share_below(self.at(point))
    }
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
    #[test]
    fn what_is_remembered_is_what_it_was() {
        let noise = ValueNoise::new(Seed(1).stream("noise"), 100.0);
        let mut remembered = RememberedNoise::new(noise.clone(), 50);
        let mut rng = Seed(1).stream("places").rng();
        for _ in 0..10_000 {
            let at = Point2::new(rng.uniform(-3000.0, 3000.0), rng.uniform(-3000.0, 3000.0));
            assert_eq!(noise.uniform_at(at), remembered.uniform_at(at));
        }
    }
}
