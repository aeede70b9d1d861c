//! Numbers of 16 bits (IEEE 754 binary16), rounded to the side that is asked for, so that a box of them holds the box that they came from.

/// To which side a number is rounded that has no half.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Rounding {
    Down,
    Up,
}

/// The least normal half: smaller ones may be taken for zero by a device.
const LEAST: f32 = 6.103_515_6e-5;
/// The greatest finite half.
const MOST: f32 = 65504.0;

/// Two numbers in a word, the first in the lower half.
pub(super) fn pair(first: f32, second: f32, rounding: Rounding) -> u32 {
    u32::from(half(first, rounding)) | u32::from(half(second, rounding)) << 16
}

/// The bits of a half; beyond the greatest one it is that.
fn half(value: f32, rounding: Rounding) -> u16 {
    let outwards = (rounding == Rounding::Up) == (value > 0.0);
    let sign = u16::from(value < 0.0) << 15;
    let size = value.abs();
    if size < LEAST || value.is_nan() {
        return sign | if outwards && size > 0.0 { 1 << 10 } else { 0 };
    }
    if size >= MOST {
        return sign | 0x7bff;
    }
    // The exponents differ by 112; of 23 places after the point 10 stay.
    let bits = size.to_bits() - (112 << 23);
    let cut = (bits >> 13) as u16;
    let is_more = bits.trailing_zeros() < 13;
    sign | (cut + u16::from(outwards && is_more))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn value(bits: u16) -> f32 {
        let (exponent, places) = (i32::from(bits >> 10 & 31), f32::from(bits & 1023));
        let size = if exponent == 0 {
            places * 2_f32.powi(-24)
        } else {
            (1.0 + places / 1024.0) * 2_f32.powi(exponent - 15)
        };
        if bits >> 15 == 1 { -size } else { size }
    }

    proptest! {
        /// On the side that was asked for, and no farther off than the next half.
        #[test]
        fn halves_are_on_their_side(exponent in -20.0..15.9f32, mantissa in -1.0..1.0f32) {
            let number = mantissa * exponent.exp2();
            let (below, above) = (half(number, Rounding::Down), half(number, Rounding::Up));
            let slack = number.abs() / 1024.0 + LEAST;
            prop_assert!(value(below) <= number && value(above) >= number, "{number}");
            prop_assert!(number - value(below) <= slack && value(above) - number <= slack, "{number}");
            for bits in [below, above] {
                prop_assert!(bits.trailing_zeros() >= 15 || bits & 0x7c00 != 0, "no device has to know numbers below the least");
            }
        }
    }

    #[test]
    fn what_is_a_half_stays() {
        for number in [0.0, 0.5, -0.5, 1.0, -3.25, 1024.0, 65504.0] {
            for rounding in [Rounding::Down, Rounding::Up] {
                assert_eq!(value(half(number, rounding)), number);
            }
        }
        assert_eq!(half(f32::INFINITY, Rounding::Up), 0x7bff);
        assert_eq!(pair(1.0, -2.0, Rounding::Up), 0xc000_3c00);
    }
}
