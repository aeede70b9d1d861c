//! Settings and their ranges; what places and sizes are possible.

use simworld_core::geometry::Point2;

use crate::CityError;

/// Farthest coordinate, m.
const FARTHEST: f64 = 1e7;
/// Largest thing, m.
const LARGEST: f64 = 2000.0;

/// A setting: its path, its value, the least and the greatest that is allowed, and both in words.
pub(crate) type Check = (&'static str, f64, f64, f64, &'static str);

/// The first setting out of its range is the error; NaN always is.
pub(crate) fn check(checks: &[Check]) -> Result<(), CityError> {
    match checks.iter().find(|(_, value, low, high, _)| !(*low..=*high).contains(value)) {
        Some((field, value, _, _, allowed)) => Err(CityError::Config { field, value: *value, allowed }),
        None => Ok(()),
    }
}

/// Whether a point lies where a city may be; NaN never does.
pub(crate) fn is_place(point: &Point2) -> bool {
    point.x.abs() <= FARTHEST && point.y.abs() <= FARTHEST
}

/// Whether a thing may be that long, wide or high, m.
pub(crate) fn is_size(size: f64) -> bool {
    size > 0.0 && size <= LARGEST
}
