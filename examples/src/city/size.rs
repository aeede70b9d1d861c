//! Sizes as people write them: `3km`, `800m`.

use std::fmt;
use std::str::FromStr;

use thiserror::Error;

/// How far a city reaches from one side to the other.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Size {
    /// m.
    pub metres: f64,
}

/// Smallest and largest city, m.
const RANGE: (f64, f64) = (200.0, 50_000.0);

/// Why a text is no size.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum SizeError {
    /// No number, or no unit that is known.
    #[error("`{0}` is no size: give a number and a unit, such as 3km or 800m")]
    Text(String),
    /// Too small or too large.
    #[error("{0} m is out of range: give 200m to 50km")]
    Range(f64),
}

impl FromStr for Size {
    type Err = SizeError;

    fn from_str(text: &str) -> Result<Self, SizeError> {
        let text = text.trim();
        let (number, unit) = match (text.strip_suffix("km"), text.strip_suffix('m')) {
            (Some(number), _) => (number, 1000.0),
            (None, Some(number)) => (number, 1.0),
            (None, None) => return Err(SizeError::Text(text.to_owned())),
        };
        let number: f64 = number.trim().parse().map_err(|_| SizeError::Text(text.to_owned()))?;
        let metres = number * unit;
        if (RANGE.0..=RANGE.1).contains(&metres) {
            Ok(Self { metres })
        } else {
            Err(SizeError::Range(metres))
        }
    }
}

impl fmt::Display for Size {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.metres < 1000.0 {
            write!(f, "{}m", self.metres)
        } else {
            write!(f, "{}km", self.metres / 1000.0)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_are_read_as_people_write_them() {
        assert_eq!("3km".parse(), Ok(Size { metres: 3000.0 }));
        assert_eq!(" 800 m ".parse(), Ok(Size { metres: 800.0 }));
        assert_eq!("1.5km".parse::<Size>().unwrap().to_string(), "1.5km");
        for wrong in ["3", "", "km", "3 miles", "m", "NaNkm", "-1km", "1e9km", "10m"] {
            assert!(wrong.parse::<Size>().is_err(), "{wrong}");
        }
    }
}
