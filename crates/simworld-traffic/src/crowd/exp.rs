//! Two to the power of a number, in single precision, as a few operations that processors do for several numbers at once.

/// Adding this rounds a number of less than 2²² to a whole one, in the low bits of the sum.
const ROUNDING: f32 = 12_582_912.0;

/// 2 to the power of `y` in [-120, 0], within 2·10⁻⁷ of it relatively; the same bits on every processor.
///
/// The polynomial is that of 2ᶠ = e^(f ln 2) around 0 for f in [-½, ½] (Taylor, to the seventh order).
#[inline]
pub(super) fn exp2(y: f32) -> f32 {
    let shifted = y + ROUNDING;
    let f = (y - (shifted - ROUNDING)) * std::f32::consts::LN_2;
    let high = 1.0 / 24.0 + f * (1.0 / 120.0 + f * (1.0 / 720.0 + f * (1.0 / 5040.0)));
    let power = 1.0 + f * (1.0 + f * (0.5 + f * (1.0 / 6.0 + f * high)));
    // The whole part goes to the exponent.
    f32::from_bits(power.to_bits().wrapping_add(shifted.to_bits() << 23))
}

#[cfg(test)]
mod tests {
    use simworld_core::ops;

    use super::*;

    #[test]
    fn it_is_as_exact_as_it_says() {
        for step in 0..=120_000 {
            let y = -(step as f32) / 1000.0;
            let exact = ops::pow(2.0, f64::from(y));
            let off = (f64::from(exp2(y)) / exact - 1.0).abs();
            assert!(off < 2e-7, "2^{y} is off by {off:e}");
        }
        assert_eq!(exp2(0.0), 1.0);
    }
}
