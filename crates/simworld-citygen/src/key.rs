//! Streams of places: functions of where something lies, so that a change elsewhere changes nothing there.

use simworld_core::geometry::Point2;
use simworld_core::seed::Stream;

/// The stream of a place, by so many parts of a metre.
pub(crate) fn stream_at(place: Point2, per_metre: f64, streams: Stream) -> Stream {
    let key = |x: f64| nearest(x * per_metre) as u64;
    streams.indexed(key(place.x)).indexed(key(place.y))
}

/// The nearest whole number, of two the one farther from zero: that of [`f64::round`], which calls a function.
fn nearest(x: f64) -> i64 {
    let whole = x as i64;
    let rest = x - whole as f64;
    whole.saturating_add(i64::from(rest >= 0.5) - i64::from(rest <= -0.5))
}

#[cfg(test)]
mod tests {
    use simworld_core::ops::pow;
    use simworld_core::seed::Seed;

    use super::*;

    #[test]
    fn it_rounds_as_the_standard_library_does() {
        let mut rng = Seed(2).stream("keys").rng();
        let limits =
            [0.0, 0.5, 0.499_999_999_999_999_94, 1.5, 4e15, 4_503_599_627_370_495.5, 1e19, 1e300, f64::NAN];
        let drawn = (0..10_000).map(|step| rng.uniform(-1.0, 1.0) * pow(10.0, f64::from(step % 18)));
        for x in limits.into_iter().chain(drawn).flat_map(|x| [x, -x, x.trunc() + 0.5]) {
            assert_eq!(nearest(x), x.round() as i64, "{x}");
        }
    }
}
