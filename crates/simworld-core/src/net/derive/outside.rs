//! The outside of a kerb that goes round a corner: how far from the kerb a point of the carriageway is at least.

use super::pieces::LANES;
use crate::geometry::{Point2, Vector2};
use crate::ops::greater;

/// Lines along some pieces of a kerb that turns to the right all the way, with the carriageway on their left.
///
/// Who is on the left of one of them is as far from the kerb as from that line, or farther, for the kerb is nowhere on its left. And
/// the nearest piece has him on its left: on its right he would be on the far side of the kerb, round one of its ends. Round
/// an end he comes to the left of the line along the piece there alone, and then that end is nearer; to the left of a line that
/// bends away from neither end by more than a right angle he does not come at all.
pub(super) struct Outside {
    /// The directions to their left.
    left_x: [f64; LANES],
    left_y: [f64; LANES],
    /// How far to that side of the origin they lie, m.
    aside: [f64; LANES],
}

impl Outside {
    /// `None` where it is not plain: only of kerbs that never turn to the left, by a right angle at most at each point, by less than
    /// half a turn in all, and neither of whose ends the other parts pass.
    pub(super) fn of(kerb: &[Point2]) -> Option<Self> {
        let last = kerb.len().checked_sub(2)?;
        let step = |piece: usize| kerb[piece + 1] - kerb[piece];
        let ends = [step(0), step(last)];
        let mut before = ends[0];
        let goes_round = kerb.windows(2).all(|piece| {
            let along = piece[1] - piece[0];
            let turned = (before.perp(&along), before.dot(&along));
            let in_all = (ends[0].perp(&along), ends[0].dot(&along));
            before = along;
            turned.0 <= 0.0
                && turned.1 >= 0.0
                && in_all.0 <= 0.0
                && (in_all.0 < 0.0 || in_all.1 > 0.0)
                && (piece[1] - kerb[0]).dot(&ends[0]) >= 0.0
                && (kerb[last + 1] - piece[0]).dot(&ends[1]) >= 0.0
        });
        if !goes_round {
            return None;
        }
        let mut lines = Self { left_x: [0.0; LANES], left_y: [0.0; LANES], aside: [0.0; LANES] };
        for (lane, piece) in [0, last / 3, last - last / 3, last].into_iter().enumerate() {
            let bends_little = ends.iter().all(|end| end.dot(&step(piece)) >= 0.0);
            let piece = if bends_little || piece == last { piece } else { 0 };
            let along = step(piece).try_normalize(1e-9)?;
            let left = Vector2::new(-along.y, along.x);
            (lines.left_x[lane], lines.left_y[lane]) = (left.x, left.y);
            lines.aside[lane] = kerb[piece].coords.dot(&left);
        }
        Some(lines)
    }

    /// The kerb is no nearer to a point than this, m, and has it on its left, if this is more than nothing: but for what is
    /// rounded, some 10 nm ten thousand kilometres from the origin.
    pub(super) fn least(&self, point: &Point2) -> f64 {
        let beside =
            |lane: usize| point.x * self.left_x[lane] + point.y * self.left_y[lane] - self.aside[lane];
        greater(greater(beside(0), beside(1)), greater(beside(2), beside(3)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::direction;
    use crate::net::polyline;
    use crate::seed::Seed;

    #[test]
    fn it_never_says_more_than_the_nearest_point() {
        let mut rng = Seed(7).stream("outside").rng();
        let (mut plain, mut told) = (0, 0);
        for _ in 0..4000 {
            let (mut at, mut heading) = (Point2::origin(), rng.uniform(-3.0, 3.0));
            let sharpest = rng.uniform(0.1, 1.6);
            let mut kerb = vec![at];
            for _ in 0..=(rng.uniform(0.0, 9.0) as usize) {
                at += direction(heading) * rng.uniform(0.1, 4.0);
                heading -= rng.uniform(-0.02, sharpest);
                kerb.push(at);
            }
            let Some(outside) = Outside::of(&kerb) else { continue };
            plain += 1;
            for _ in 0..40 {
                let point = Point2::new(rng.uniform(-25.0, 25.0), rng.uniform(-25.0, 25.0));
                let least = outside.least(&point);
                let near = polyline::closest(&kerb, &point).expect("it has pieces");
                assert!(
                    least <= 0.0 || least <= near.lateral + 1e-9,
                    "{least} of {near:?}: {point} {kerb:?}"
                );
                told += usize::from(least > 0.0);
            }
        }
        assert!(plain > 800 && told > 10 * plain, "{plain} kerbs and {told} points say nothing");
    }
}
