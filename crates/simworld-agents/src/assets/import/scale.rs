//! How large a model is: by what is asked for, or by what things of its class are.

use super::config::Unit;
use super::error::ImportError;
use crate::assets::prior::SizePrior;
use crate::generation::SizeHint;

/// How many times farther than the spread of its class the proportions of a thing may be off that is of any unit.
const ODD: f64 = 1.6;

/// How far a size that is asked for may be off, where another one decides.
const LENIENT: f64 = 1.5;

/// By how much a box of that length, width and height, in units of a file, is to be scaled to metres.
pub(super) fn scale(
    extent: [f64; 3],
    asked: SizeHint,
    class: Option<&SizePrior>,
    unit: Unit,
    words: &str,
) -> Result<f64, ImportError> {
    if let Some(scale) = as_asked(extent, asked)? {
        return Ok(scale);
    }
    if unit == Unit::Metres {
        return Ok(1.0);
    }
    let Some(class) = class else {
        let example = SizePrior::nearest(words).name.to_owned();
        return Err(ImportError::NoSize { words: words.to_owned(), example });
    };
    let is_such = |scale: f64, spread: f64| {
        let pairs = sorted(extent).into_iter().zip(sorted(class.size));
        pairs.into_iter().all(|(got, typical)| {
            let ratio = got * scale / typical;
            ratio <= spread && ratio >= 1.0 / spread
        })
    };
    let found = if unit == Unit::Any {
        let scale = sorted(class.size)[2] / sorted(extent)[2];
        is_such(scale, class.spread * ODD).then_some(scale)
    } else {
        // Metres first, then the nearer powers of ten: centimetres before millimetres.
        const UNITS: [f64; 7] = [1.0, 0.01, 0.001, 0.1, 10.0, 100.0, 1000.0];
        UNITS.into_iter().find(|scale| is_such(*scale, class.spread))
    };
    found.ok_or_else(|| ImportError::Size { got: extent, class: class.name.to_owned(), typical: class.size })
}

fn as_asked(extent: [f64; 3], asked: SizeHint) -> Result<Option<f64>, ImportError> {
    let sides = [("height", asked.height, 2), ("length", asked.length, 0), ("width", asked.width, 1)];
    let given = || sides.into_iter().filter_map(|(what, value, axis)| Some((what, value?, axis)));
    // The largest side decides: what is wrong with it by the same share is least.
    let Some((what, value, axis)) = given().reduce(|a, b| if b.1 > a.1 { b } else { a }) else {
        return Ok(None);
    };
    let scale = value / extent[axis];
    let shape = extent.map(|side| side * scale);
    if !(0.01..=1000.0).contains(&value) || !scale.is_finite() {
        return Err(ImportError::Asked { what, value, shape });
    }
    let off = given().find(|(_, value, axis)| {
        let ratio = shape[*axis] / value;
        !(1.0 / LENIENT..=LENIENT).contains(&ratio)
    });
    match off {
        Some((what, value, _)) => Err(ImportError::Asked { what, value, shape }),
        None => Ok(Some(scale)),
    }
}

fn sorted(mut sides: [f64; 3]) -> [f64; 3] {
    sides.sort_by(f64::total_cmp);
    sides
}

#[cfg(test)]
mod tests {
    use super::*;

    fn car(extent: [f64; 3], unit: Unit) -> Result<f64, ImportError> {
        scale(extent, SizeHint::default(), SizePrior::of("car").as_ref(), unit, "car")
    }

    #[test]
    fn a_car_of_450_units_is_in_centimetres() {
        assert_eq!(car([450.0, 180.0, 150.0], Unit::Guess), Ok(0.01));
        assert_eq!(car([4.5, 1.8, 1.5], Unit::Guess), Ok(1.0));
        assert_eq!(car([4500.0, 1800.0, 1500.0], Unit::Guess), Ok(0.001));
        assert_eq!(car([450.0, 180.0, 150.0], Unit::Metres), Ok(1.0));
        let any = car([0.9, 0.36, 0.3], Unit::Any).unwrap();
        assert!((any - 4.4 / 0.9).abs() < 1e-12);
    }

    #[test]
    fn what_is_no_car_in_any_unit_is_refused() {
        for extent in [[4.5, 4.5, 4.5], [1.0, 1.0, 30.0], [1e-9, 1e-9, 1e-9]] {
            assert!(matches!(car(extent, Unit::Guess), Err(ImportError::Size { .. })), "{extent:?}");
        }
        assert!(matches!(car([1.0, 1.0, 30.0], Unit::Any), Err(ImportError::Size { .. })));
        let unknown = scale([1.0; 3], SizeHint::default(), None, Unit::Guess, "a bensh");
        assert!(matches!(unknown, Err(ImportError::NoSize { example, .. }) if example == "bench"));
    }

    #[test]
    fn what_is_asked_for_decides() {
        let asked = |length, height| {
            scale([2.0, 1.0, 4.0], SizeHint { length, width: None, height }, None, Unit::Guess, "?")
        };
        assert_eq!(asked(None, Some(8.0)), Ok(2.0));
        assert_eq!(asked(Some(3.6), Some(8.0)), Ok(2.0));
        assert!(matches!(asked(Some(7.9), Some(8.0)), Err(ImportError::Asked { what: "length", .. })));
        assert!(matches!(asked(None, Some(f64::NAN)), Err(ImportError::Asked { .. })));
        assert!(matches!(asked(None, Some(-1.0)), Err(ImportError::Asked { .. })));
    }
}
