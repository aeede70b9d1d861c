//! Elementary functions that give the same bits on every platform.
//!
//! `f64::sin` and its kin call the platform's libm, whose last bit differs between systems and versions; one
//! such bit changes a replay hash. Everything in simworld that reaches simulation state calls these instead.
//! `sqrt`, `abs`, `floor`, `ceil`, `round`, `min`, `max` are exact by IEEE 754 and may be called directly.

/// Sine of an angle in radians.
#[inline]
pub fn sin(x: f64) -> f64 {
    libm::sin(x)
}

/// Cosine of an angle in radians.
#[inline]
pub fn cos(x: f64) -> f64 {
    libm::cos(x)
}

/// Sine and cosine of an angle in radians.
#[inline]
pub fn sin_cos(x: f64) -> (f64, f64) {
    libm::sincos(x)
}

/// Tangent of an angle in radians.
#[inline]
pub fn tan(x: f64) -> f64 {
    libm::tan(x)
}

/// Arcsine in radians, in [-π/2, π/2].
#[inline]
pub fn asin(x: f64) -> f64 {
    libm::asin(x)
}

/// Arccosine in radians, in [0, π].
#[inline]
pub fn acos(x: f64) -> f64 {
    libm::acos(x)
}

/// Angle of the vector (x, y) in radians, in (-π, π].
#[inline]
pub fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

/// e to the power `x`.
#[inline]
pub fn exp(x: f64) -> f64 {
    libm::exp(x)
}

/// The complementary error function: twice the upper tail of the normal distribution at `x` times the square root of two.
#[inline]
pub fn erfc(x: f64) -> f64 {
    libm::erfc(x)
}

/// Natural logarithm.
#[inline]
pub fn ln(x: f64) -> f64 {
    libm::log(x)
}

/// `x` to the power `y`.
#[inline]
pub fn pow(x: f64, y: f64) -> f64 {
    libm::pow(x, y)
}

/// Length of the vector (x, y), without overflow.
#[inline]
pub fn hypot(x: f64, y: f64) -> f64 {
    libm::hypot(x, y)
}

/// The lesser of two numbers, the second where they cannot be compared: one instruction, where `f64::min` has to look for NaN
/// on both sides.
#[inline]
pub fn lesser(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// The greater of two numbers, the second where they cannot be compared.
#[inline]
pub fn greater(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// The same angle in (-π, π]; the input is in radians and may be any finite number.
///
/// ```
/// use std::f64::consts::PI;
/// use simworld_core::ops::wrap_angle;
/// assert!((wrap_angle(3.0 * PI) - PI).abs() < 1e-12);
/// assert!((wrap_angle(-0.5) + 0.5).abs() < 1e-12);
/// ```
#[inline]
pub fn wrap_angle(angle: f64) -> f64 {
    use std::f64::consts::{PI, TAU};
    // Most are in it already: that takes no division, and the sum is no negative zero.
    if -PI < angle && angle < PI {
        return angle + 0.0;
    }
    let wrapped = angle - TAU * (angle / TAU).round();
    if wrapped <= -PI { wrapped + TAU } else { wrapped }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{PI, TAU};

    use super::*;
    use crate::seed::Seed;

    #[test]
    fn angles_that_are_in_already_stay_what_they_are_to_the_bit() {
        let the_long_way = |angle: f64| {
            let wrapped = angle - TAU * (angle / TAU).round();
            if wrapped <= -PI { wrapped + TAU } else { wrapped }
        };
        let mut rng = Seed(6).stream("angles").rng();
        let edges =
            [0.0, -0.0, PI, -PI, PI.next_down(), (-PI).next_up(), PI.next_up(), (-PI).next_down(), 1e-300];
        for angle in edges.into_iter().chain((0..10_000).map(|_| rng.uniform(-9.0, 9.0))) {
            assert_eq!(wrap_angle(angle).to_bits(), the_long_way(angle).to_bits(), "{angle}");
        }
    }
}
