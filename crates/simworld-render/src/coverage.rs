//! How much of a picture is there at each of its levels: what is cut out keeps its area as it grows small.
//!
//! The mean of alpha keeps leaves together at the finest level, and loses them at coarse ones, where hardly a texel is above the cutoff any more.
//! I. Castaño (Computing Alpha Mipmaps, 2010) scales the alpha of each level until as much of it is above the cutoff as at the finest.
//! Here the cutoff of each level is scaled in its place: that is the same comparison, and the texels stay whatever parts with other cutoffs need.

use simworld_core::asset::{MOST_CUTOFF, Wrap};

/// Places at which a level is looked at; those of the plastic number, which lie evenly at any count (M. Roberts, The unreasonable effectiveness
/// of quasirandom sequences, 2018).
const PLACES: u32 = 1 << 13;
const STEPS: [f64; 2] = [0.754_877_666_246_692_8, 0.569_840_290_998_053_3];

/// A level with fewer texels along a side could only be there as a whole, or not at all.
const LEAST_SIDE: u32 = 4;

/// Levels that the table has room for.
pub(crate) const MOST_LEVELS: usize = 16;

/// The alpha of a level.
pub(crate) struct Level {
    pub size: [u32; 2],
    pub alpha: Vec<u8>,
}

/// How many of these levels, the finest first, are fine enough to be cut out of; at least one.
pub(crate) fn cuttable(levels: impl Iterator<Item = [u32; 2]>) -> usize {
    levels.take_while(|[width, height]| *width.min(height) >= LEAST_SIDE).count().max(1)
}

/// How far the share that is there at a level may be off.
const OFF: f64 = 0.04;

/// How much has to be there of something that is cut out.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Cutoffs {
    /// By level, where vertices have an alpha of 1.
    pub values: [f32; MOST_LEVELS],
    /// Levels at which as much can be there as at the finest; coarser ones are not to be looked at.
    pub levels: usize,
}

/// The cutoffs of levels, of the first of which `cutoff` has to be there.
pub(crate) fn cutoffs(levels: &[Level], wrap: [Wrap; 2], cutoff: f32) -> Cutoffs {
    let mut found = Cutoffs { values: [cutoff; MOST_LEVELS], levels: 1 };
    let Some((finest, coarser)) = levels.split_first() else { return found };
    let there = finest.sampled(wrap).iter().filter(|alpha| **alpha >= cutoff).count();
    for level in coarser.iter().take(MOST_LEVELS - 1) {
        let alpha = level.sampled(wrap);
        let value = threshold(&alpha, there, cutoff);
        let got = alpha.iter().filter(|alpha| **alpha >= value).count();
        if got.abs_diff(there) as f64 > OFF * f64::from(PLACES) {
            break;
        }
        found.values[found.levels] = value;
        found.levels += 1;
    }
    let coarsest = found.values[found.levels - 1];
    found.values[found.levels..].fill(coarsest);
    found
}

/// What as many of these numbers reach.
fn threshold(alpha: &[f32], count: usize, cutoff: f32) -> f32 {
    let mut sorted = alpha.to_vec();
    sorted.sort_unstable_by(|a, b| b.total_cmp(a));
    match (count.checked_sub(1).map(|last| sorted[last]), sorted.get(count)) {
        (None, _) => MOST_CUTOFF,
        (Some(least), None) => cutoff.min(least),
        // Between the last of them and the next.
        (Some(last), Some(next)) => (last + next) * 0.5,
    }
}

impl Level {
    /// Its alpha at each of the places.
    fn sampled(&self, wrap: [Wrap; 2]) -> Vec<f32> {
        let place = |index: u32| STEPS.map(|step| (f64::from(index) * step + 0.5).fract());
        (0..PLACES).map(|index| self.at(place(index), wrap)).collect()
    }

    /// Between the four texels around a place within it, as shaders/pictures.wgsl has it.
    fn at(&self, place: [f64; 2], wrap: [Wrap; 2]) -> f32 {
        let ends = |axis: usize| {
            let count = i64::from(self.size[axis]);
            let at = place[axis] * count as f64 - 0.5;
            let low = at.floor();
            let texel = |texel: i64| match wrap[axis] {
                Wrap::Repeat => texel.rem_euclid(count),
                Wrap::Mirror | Wrap::Clamp => texel.clamp(0, count - 1),
            };
            ([texel(low as i64), texel(low as i64 + 1)], (at - low) as f32)
        };
        let ([columns, rows], [right, down]) = {
            let (across, along) = (ends(0), ends(1));
            ([across.0, along.0], [across.1, along.1])
        };
        let alpha = |column: i64, row: i64| {
            let index = row as usize * self.size[0] as usize + column as usize;
            f32::from(self.alpha.get(index).copied().unwrap_or(u8::MAX)) / 255.0
        };
        let mix = |a: f32, b: f32, share: f32| a + (b - a) * share;
        let row = |row: i64| mix(alpha(columns[0], row), alpha(columns[1], row), right);
        mix(row(rows[0]), row(rows[1]), down)
    }
}

#[cfg(test)]
mod tests {
    use simworld_core::asset::ModelImage;

    use super::*;

    /// The levels of a picture of leaves: dots that are there on a ground that is not.
    fn leaves(side: u32, within: f64) -> Vec<Level> {
        let dot = |k: u32| {
            let [x, y] = [k % side, k / side].map(|at| f64::from(at % 16) - 7.5);
            if (x * x + y * y).sqrt() < within { 255 } else { 0 }
        };
        let alpha = (0..side * side).map(dot).collect();
        let pixels = vec![90; (side * side * 3) as usize];
        let first = ModelImage { width: side, height: side, pixels, alpha, ..ModelImage::default() };
        let all = std::iter::successors(Some(first), |image| (image.width > 4).then(|| image.halved()));
        all.map(|image| Level { size: [image.width, image.height], alpha: image.alpha }).collect()
    }

    #[test]
    fn as_much_is_there_at_every_level() {
        for within in [3.0, 5.0, 7.0] {
            let levels = leaves(128, within);
            let all = cutoffs(&levels, [Wrap::Repeat; 2], 0.5);
            let share = |level: &Level, cutoff: f32| {
                let found = level.sampled([Wrap::Repeat; 2]);
                found.iter().filter(|alpha| **alpha >= cutoff).count() as f64 / found.len() as f64
            };
            let wanted = share(&levels[0], 0.5);
            // Down to where all texels are alike.
            assert!(all.levels >= 3, "{all:?}");
            for (level, cutoff) in levels.iter().zip(all.values).take(all.levels) {
                let got = share(level, cutoff);
                assert!((got - wanted).abs() < 0.05, "{got} of {wanted} at {:?}", level.size);
            }
        }
        let small = leaves(128, 3.0);
        let plain = small[3].sampled([Wrap::Repeat; 2]).iter().filter(|alpha| **alpha >= 0.5).count();
        assert_eq!(plain, 0, "and without that nothing would be left of small ones");
    }

    #[test]
    fn nothing_and_everything_stay_so() {
        let level =
            |side: u32, alpha: u8| Level { size: [side; 2], alpha: vec![alpha; (side * side) as usize] };
        let pair = |alpha| [level(8, alpha), level(4, alpha)];
        assert!(cutoffs(&pair(0), [Wrap::Repeat; 2], 0.5).values[1] > 1.0);
        assert!(cutoffs(&pair(200), [Wrap::Repeat; 2], 0.5).values[1] <= 200.0 / 255.0);
        let none = cutoffs(&[], [Wrap::Repeat; 2], 0.3);
        assert_eq!(none, Cutoffs { values: [0.3; MOST_LEVELS], levels: 1 });
        assert_eq!(cuttable([[64, 16], [32, 8], [16, 4], [8, 2]].into_iter()), 3);
        assert_eq!(cuttable(std::iter::once([2, 2])), 1);
    }
}
