//! Numbers as they stand in OSM XML, read without a detour over floating point.

/// A whole number with an optional sign.
pub(super) fn integer(text: &str) -> Option<i64> {
    let digits = text.strip_prefix('-');
    let mut value: i64 = 0;
    let body = digits.unwrap_or(text).as_bytes();
    if body.is_empty() {
        return None;
    }
    for byte in body {
        if !byte.is_ascii_digit() {
            return None;
        }
        value = value.checked_mul(10)?.checked_add(i64::from(byte - b'0'))?;
    }
    Some(if digits.is_some() { -value } else { value })
}

/// An angle in degrees, as tenths of microdegrees, rounded to the nearest.
pub(super) fn angle(text: &str) -> Option<i32> {
    let digits = text.strip_prefix('-');
    let (mut value, mut places, mut seen_point, mut count): (i64, u32, bool, u32) = (0, 0, false, 0);
    for byte in digits.unwrap_or(text).bytes() {
        match byte {
            b'.' if !seen_point => seen_point = true,
            b'0'..=b'9' => {
                count += 1;
                // Digits beyond the eighth place are far below a millimetre.
                if places < 8 {
                    value = value * 10 + i64::from(byte - b'0');
                    places += u32::from(seen_point);
                }
                if value > 1_000_000_000_000 {
                    return None;
                }
            }
            _ => return scientific(text),
        }
    }
    if count == 0 {
        return None;
    }
    while places < 8 {
        value *= 10;
        places += 1;
    }
    let rounded = (value + 5) / 10;
    i32::try_from(if digits.is_some() { -rounded } else { rounded }).ok()
}

/// Numbers such as `4.2e1`, which some programs write.
fn scientific(text: &str) -> Option<i32> {
    let degrees: f64 = text.parse().ok()?;
    (degrees.abs() <= 200.0).then(|| (degrees * 1e7).round() as i32)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn angles_are_read_to_the_last_place() {
        assert_eq!(angle("43.7370125"), Some(437_370_125));
        assert_eq!(angle("-0.1"), Some(-1_000_000));
        assert_eq!(angle("7"), Some(70_000_000));
        assert_eq!(angle("1.23456785"), Some(12_345_679));
        assert_eq!(angle("4.2e1"), Some(420_000_000));
        for nonsense in ["", "-", ".", "1.2.3", "x", "99999999999999", "NaN", "inf", "1e30"] {
            assert_eq!(angle(nonsense), None, "{nonsense}");
        }
        assert_eq!((integer("-12"), integer("007")), (Some(-12), Some(7)));
        for nonsense in ["", "-", "+1", "1.0", "92233720368547758080"] {
            assert_eq!(integer(nonsense), None, "{nonsense}");
        }
    }

    proptest! {
        #[test]
        fn every_angle_comes_back(tenths in -1_800_000_000..=1_800_000_000_i32) {
            let text = format!("{:.7}", f64::from(tenths) / 1e7);
            prop_assert_eq!(angle(&text), Some(tenths));
        }

        #[test]
        fn every_whole_number_comes_back(number in -i64::MAX..i64::MAX) {
            prop_assert_eq!(integer(&number.to_string()), Some(number));
        }
    }
}
