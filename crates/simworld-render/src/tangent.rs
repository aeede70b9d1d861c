//! Tangents in a word, as shaders/models.wgsl reads them: which way is right on the pictures, in the unit box of a model, and to which side of that their top is.

/// Says that there is one, and that the pictures are mirrored.
const THERE: u32 = 1 << 31;
const MIRRORED: u32 = 1 << 30;
/// Bits of a coordinate, and steps from 0 to 1, so that both are told exactly.
const BITS: u32 = 15;
const STEPS: f32 = 16383.0;

/// A direction of any length, by octahedral coordinates, and the side as [`Model::tangents`](simworld_core::asset::Model::tangents) has it; 0 where there is none.
pub(crate) fn packed_tangent([x, y, z]: [f32; 3], side: f32) -> u32 {
    let sum = x.abs() + y.abs() + z.abs();
    if side == 0.0 || sum < 1e-12 || !sum.is_finite() {
        return 0;
    }
    let (a, b) = (x / sum, y / sum);
    let [a, b] = if z < 0.0 { [fold(b, a), fold(a, b)] } else { [a, b] };
    let step = |value: f32| ((value * STEPS).round() + STEPS) as u32;
    THERE | if side < 0.0 { MIRRORED } else { 0 } | step(b) << BITS | step(a)
}

/// What is below lies beyond the sides of the square of what is above: as far from them, on the side of the coordinate itself.
fn fold(other: f32, own: f32) -> f32 {
    (1.0 - other.abs()) * if own >= 0.0 { 1.0 } else { -1.0 }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// As the shader has it.
    fn unpacked(code: u32) -> ([f32; 3], f32) {
        let part = |bits: u32| ((bits & 32767) as f32 - STEPS) / STEPS;
        let (a, b) = (part(code), part(code >> BITS));
        let z = 1.0 - a.abs() - b.abs();
        let [x, y] = if z < 0.0 { [fold(b, a), fold(a, b)] } else { [a, b] };
        let length = (x * x + y * y + z * z).sqrt();
        ([x, y, z].map(|part| part / length), if code & MIRRORED == 0 { 1.0 } else { -1.0 })
    }

    proptest! {
        #[test]
        fn a_direction_survives_packing(
            way in prop::array::uniform3(-1.0..1.0f32),
            mirrored in any::<bool>(),
        ) {
            let length = way.iter().map(|part| part * part).sum::<f32>().sqrt();
            prop_assume!(length > 0.01);
            let side = if mirrored { -1.0 } else { 1.0 };
            let code = packed_tangent(way, side);
            prop_assert!(code & THERE != 0);
            let (got, got_side) = unpacked(code);
            prop_assert_eq!(got_side, side);
            for (got, part) in got.iter().zip(way) {
                prop_assert!((got - part / length).abs() < 2e-4, "{way:?} came back as {got:?}");
            }
        }
    }

    #[test]
    fn axes_are_exact_and_none_is_none() {
        for axis in 0..3 {
            for sign in [1.0, -1.0] {
                let mut way = [0.0; 3];
                way[axis] = sign;
                assert_eq!(unpacked(packed_tangent(way, -1.0)), (way, -1.0));
            }
        }
        for (way, side) in [([0.0; 3], 1.0), ([1.0, 0.0, 0.0], 0.0), ([f32::NAN, 0.0, 0.0], 1.0)] {
            assert_eq!(packed_tangent(way, side), 0);
        }
    }
}
