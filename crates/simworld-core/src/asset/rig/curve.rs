//! Curves of clips: a value for each of some times, and how one goes from one to the next (glTF 2.0, 3.11 and C).

use serde::{Deserialize, Serialize};

use crate::ops;

/// A value for each of some times.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Curve {
    /// How one goes from key to key.
    pub interpolation: Interpolation,
    /// When each key is, s, ascending from 0 on; before the first and behind the last the curve stands still.
    pub times: Vec<f32>,
    /// The value at each key, three numbers or four; of a cubic three a key: the tangent that comes in, the value, the tangent that
    /// goes out.
    pub values: Vec<f32>,
}

/// How one goes from key to key.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Interpolation {
    /// Not at all: the value of the last key holds until the next.
    Step,
    /// Straight; rotations along the shorter arc.
    #[default]
    Linear,
    /// A cubic with tangents.
    Cubic,
}

/// What a curve moves about a joint.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Path {
    /// Its place: three numbers.
    Translation,
    /// Its rotation: a unit quaternion, x, y, z, w.
    Rotation,
    /// Its size: three factors.
    Scale,
}

impl Path {
    /// Numbers in a value.
    pub const fn width(self) -> usize {
        match self {
            Self::Translation | Self::Scale => 3,
            Self::Rotation => 4,
        }
    }
}

impl Curve {
    /// When its last key is, s.
    pub fn end(&self) -> f64 {
        self.times.last().map_or(0.0, |time| f64::from(*time))
    }

    /// Why it is no curve of values of so many numbers (see [`Path::width`]), if it is none.
    pub fn fault(&self, width: usize) -> Option<&'static str> {
        let rows = if self.interpolation == Interpolation::Cubic { 3 } else { 1 };
        if self.times.is_empty() {
            return Some("has no keys");
        }
        if self.times.len().checked_mul(rows * width) != Some(self.values.len()) {
            return Some("has not one value for each of its keys");
        }
        let ascends = self.times.windows(2).all(|pair| pair[0] < pair[1]);
        if !ascends || !(0.0..=f32::MAX).contains(&self.times[0]) || !self.end().is_finite() {
            return Some("has times that do not ascend from 0 on");
        }
        let sound = self.values.iter().all(|value| value.is_finite());
        (!sound).then_some("has values that are no numbers")
    }

    /// The value at a time, s; of one with [faults](Self::fault) what is not there is 0.
    pub fn at<const N: usize>(&self, seconds: f64) -> [f64; N] {
        let count = self.times.len();
        let number = |index: usize| self.values.get(index).map_or(0.0, |number| f64::from(*number));
        let value = |row: usize| -> [f64; N] { std::array::from_fn(|axis| number(row * N + axis)) };
        let cubic = self.interpolation == Interpolation::Cubic;
        let key = |row: usize| value(if cubic { row * 3 + 1 } else { row });
        let next = self.times.partition_point(|time| f64::from(*time) <= seconds);
        let Some(before) = next.checked_sub(1) else { return key(0) };
        if next == count {
            return key(before);
        }
        let (from, to) = (f64::from(self.times[before]), f64::from(self.times[next]));
        let (share, span) = ((seconds - from) / (to - from), to - from);
        match self.interpolation {
            Interpolation::Step => key(before),
            Interpolation::Linear if N == 4 => slerp(key(before), key(next), share),
            Interpolation::Linear => line(key(before), key(next), [1.0 - share, share]),
            Interpolation::Cubic => {
                hermite([key(before), value(before * 3 + 2), value(next * 3), key(next)], share, span)
            }
        }
    }
}

pub(super) fn line<const N: usize>(a: [f64; N], b: [f64; N], weights: [f64; 2]) -> [f64; N] {
    std::array::from_fn(|axis| a[axis] * weights[0] + b[axis] * weights[1])
}

/// Along the shorter arc between unit quaternions.
pub(super) fn slerp<const N: usize>(a: [f64; N], b: [f64; N], share: f64) -> [f64; N] {
    let cosine: f64 = a.iter().zip(&b).map(|(a, b)| a * b).sum();
    let side = if cosine < 0.0 { -1.0 } else { 1.0 };
    let angle = ops::acos((cosine * side).min(1.0));
    let sine = ops::sin(angle);
    if sine < 1e-6 {
        return line(a, b, [1.0 - share, share * side]);
    }
    let weight = |part: f64| ops::sin(part * angle) / sine;
    line(a, b, [weight(1.0 - share), weight(share) * side])
}

/// A cubic between two keys with the tangents that leave the one and come into the other (glTF 2.0, C.5).
fn hermite<const N: usize>([a, out, into, b]: [[f64; N]; 4], t: f64, span: f64) -> [f64; N] {
    let (square, cube) = (t * t, t * t * t);
    std::array::from_fn(|axis| {
        (2.0 * cube - 3.0 * square + 1.0) * a[axis]
            + span * (cube - 2.0 * square + t) * out[axis]
            + (3.0 * square - 2.0 * cube) * b[axis]
            + span * (cube - square) * into[axis]
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ramp(interpolation: Interpolation) -> Curve {
        let values = match interpolation {
            // Tangents of 2 a second: a straight line.
            Interpolation::Cubic => [2.0, 0.0, 2.0, 2.0, 2.0, 2.0].into_iter().flat_map(|x| [x; 3]).collect(),
            _ => [0.0, 2.0].into_iter().flat_map(|x| [x; 3]).collect(),
        };
        Curve { interpolation, times: vec![1.0, 2.0], values }
    }

    #[test]
    fn a_curve_goes_from_key_to_key_and_stands_outside() {
        for (interpolation, half) in
            [(Interpolation::Step, 0.0), (Interpolation::Linear, 0.5), (Interpolation::Cubic, 0.5)]
        {
            let curve = ramp(interpolation);
            assert_eq!(curve.fault(3), None, "{interpolation:?}");
            for (seconds, wanted) in [(0.0, 0.0), (1.0, 0.0), (1.25, half), (2.0, 2.0), (9.0, 2.0)] {
                let [x, ..] = curve.at::<3>(seconds);
                assert!((x - wanted).abs() < 1e-12, "{interpolation:?} at {seconds} s: {x}");
            }
        }
    }

    #[test]
    fn rotations_take_the_shorter_arc() {
        // A quarter about z, and the same told by the other sign.
        let half = std::f32::consts::FRAC_1_SQRT_2;
        for sign in [1.0, -1.0] {
            let values = vec![0.0, 0.0, 0.0, 1.0, 0.0, 0.0, sign * half, sign * half];
            let curve = Curve { interpolation: Interpolation::Linear, times: vec![0.0, 1.0], values };
            let [_, _, z, w] = curve.at::<4>(0.5);
            let angle = 2.0 * ops::atan2(z, w);
            assert!((angle - std::f64::consts::FRAC_PI_4).abs() < 1e-6, "{angle}");
        }
    }

    #[test]
    fn what_is_no_curve_says_so() {
        let spoilt = |spoil: fn(&mut Curve)| {
            let mut curve = ramp(Interpolation::Linear);
            spoil(&mut curve);
            curve.fault(3)
        };
        assert!(spoilt(|curve| curve.times.clear()).is_some());
        assert!(spoilt(|curve| curve.values.truncate(5)).is_some());
        assert!(spoilt(|curve| curve.interpolation = Interpolation::Cubic).is_some());
        assert!(spoilt(|curve| curve.times[0] = 2.0).is_some());
        assert!(spoilt(|curve| curve.times[0] = -1.0).is_some());
        assert!(spoilt(|curve| curve.times[1] = f32::NAN).is_some());
        assert!(spoilt(|curve| curve.times[1] = f32::INFINITY).is_some());
        assert!(spoilt(|curve| curve.values[4] = f32::INFINITY).is_some());
        assert!(ramp(Interpolation::Linear).fault(4).is_some());
    }
}
