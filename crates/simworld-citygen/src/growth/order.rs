//! The order in which grown streets are numbered.

use simworld_core::geometry::Point2;
use simworld_core::lists::Lists;

/// Towns of no more streets than this are numbered as they grew: all that is known of them fits into the caches.
const SMALL: usize = 4096;
/// Squares are at least so many mean lengths of a street wide: a dozen streets or two lie in one.
const WIDTH: f64 = 2.5;
/// The land is no more than 2 to this power squares wide.
const MOST_BITS: u32 = 10;

/// Puts segments in the order of the land: square by square along a curve that fills the plane (Morton 1966), and within
/// a square as they grew. What lies side by side then stands side by side in memory in all that is made of the streets:
/// growth itself goes round and round the edge of the town.
pub(super) fn by_land(segments: Vec<u32>, reach: f64, length: f64, at: impl Fn(u32) -> Point2) -> Vec<u32> {
    if segments.len() <= SMALL {
        return segments;
    }
    let wide = (2.0 * reach / (WIDTH * length)).ceil() as u32;
    let bits = wide.clamp(2, 1 << MOST_BITS).next_power_of_two().trailing_zeros();
    let side = 2.0 * reach / f64::from(1_u32 << bits);
    let column = |metres: f64| (((metres + reach) / side) as u32).min((1 << bits) - 1);
    let squares: Vec<u32> = segments
        .iter()
        .map(|segment| {
            let at = at(*segment);
            spread(column(at.x)) | spread(column(at.y)) << 1
        })
        .collect();
    sorted(&segments, &squares, 1 << (2 * bits))
}

/// Sorts by counting: numbers by their keys, which are below `keys`, and in their order where those are the same.
fn sorted(numbers: &[u32], by: &[u32], keys: usize) -> Vec<u32> {
    Lists::of(keys, by.iter().map(|key| *key as usize).zip(numbers.iter().copied())).into_values()
}

/// The bits of a number of ten bits, with a zero between each two.
fn spread(number: u32) -> u32 {
    let mut bits = number;
    bits = (bits | bits << 8) & 0x00ff_00ff;
    bits = (bits | bits << 4) & 0x0f0f_0f0f;
    bits = (bits | bits << 2) & 0x3333_3333;
    (bits | bits << 1) & 0x5555_5555
}

#[cfg(test)]
mod tests {
    use super::*;
    use simworld_core::seed::Seed;

    #[test]
    fn neighbours_have_near_numbers_and_none_is_lost() {
        let mut rng = Seed(1).stream("order").rng();
        let places: Vec<Point2> = (0..20_000)
            .map(|_| Point2::new(rng.uniform(-9000.0, 9000.0), rng.uniform(-9000.0, 9000.0)))
            .collect();
        let numbers: Vec<u32> = (0..20_000).collect();
        let ordered = by_land(numbers.clone(), 9000.0, 100.0, |number| places[number as usize]);
        let mut again = ordered.clone();
        again.sort_unstable();
        assert_eq!(again, numbers);
        let stride = |order: &[u32]| {
            let steps =
                order.windows(2).map(|two| (places[two[0] as usize] - places[two[1] as usize]).norm());
            steps.sum::<f64>() / order.len() as f64
        };
        assert!(stride(&ordered) < 0.05 * stride(&numbers), "{} m", stride(&ordered));
        // Beyond the land is its edge.
        assert_eq!(by_land(vec![0; 5000], 9000.0, 100.0, |_| Point2::new(1e9, -1e9)).len(), 5000);
    }

    #[test]
    fn towns_and_squares_keep_the_order_of_growth() {
        let few: Vec<u32> = (0..4096).rev().collect();
        assert_eq!(by_land(few.clone(), 5000.0, 100.0, |number| Point2::new(f64::from(number), 0.0)), few);
        let many: Vec<u32> = (0..5000).collect();
        assert_eq!(by_land(many.clone(), 5000.0, 100.0, |_| Point2::new(3.0, 4.0)), many);
    }
}
