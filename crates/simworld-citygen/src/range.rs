//! Settings and their ranges.

use crate::CityError;

/// A setting: its path, its value, the least and the greatest that is allowed, and both in words.
pub(crate) type Check = (&'static str, f64, f64, f64, &'static str);

/// The first setting out of its range is the error; NaN always is.
pub(crate) fn check(checks: &[Check]) -> Result<(), CityError> {
    match checks.iter().find(|(_, value, low, high, _)| !(*low..=*high).contains(value)) {
        Some((field, value, _, _, allowed)) => Err(CityError::Config { field, value: *value, allowed }),
        None => Ok(()),
    }
}
