//! Room that bodies have taken in a substep, by place: who moves later keeps out of it.

use simworld_core::geometry::{Point2, Vector2, Vector3};

use crate::cells::Cells;

/// Width of the cells in which claims are looked for, m: twice as far as people look around in a substep.
const CELL: f64 = 2.0;

/// Room that a body takes in this substep: an upright cylinder in the world frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Claim {
    /// Its axis.
    pub center: Point2,
    /// m.
    pub radius: f64,
    /// Height of its lower end, m.
    pub bottom: f64,
    /// Height of its upper end, m.
    pub top: f64,
}

/// All claims of a substep.
#[derive(Debug)]
pub(crate) struct Claims {
    cells: Cells<Claim>,
    /// The greatest radius of any, m.
    widest: f64,
}

impl Default for Claims {
    fn default() -> Self {
        Self { cells: Cells::new(CELL), widest: 0.0 }
    }
}

impl Claims {
    /// Forgets those of the last substep.
    pub(crate) fn clear(&mut self) {
        self.cells.clear();
        self.widest = 0.0;
    }

    /// Adds one.
    pub(crate) fn take(&mut self, claim: Claim) {
        self.widest = self.widest.max(claim.radius);
        self.cells.insert(claim.center, claim);
    }

    /// How much of a displacement leads to within `gap` m of none of them: a share in [0, 1].
    pub(crate) fn free_share(&self, room: &Claim, displacement: &Vector3, gap: f64) -> f64 {
        let (from, to) = (room.center, room.center + displacement.xy());
        let reach = Vector2::repeat(room.radius + self.widest + gap);
        let near = self.cells.around(from.inf(&to) - reach, from.sup(&to) + reach);
        near.map(|claim| share_before(claim, room, displacement, gap)).fold(1.0, f64::min)
    }
}

/// The share of a displacement after which two discs come within `gap` of one another.
fn share_before(claim: &Claim, room: &Claim, displacement: &Vector3, gap: f64) -> f64 {
    let (low, high) =
        (room.bottom.min(room.bottom + displacement.z), room.top.max(room.top + displacement.z));
    if high <= claim.bottom || claim.top <= low {
        return 1.0;
    }
    let reach = room.radius + claim.radius + gap;
    let from = room.center - claim.center;
    // |from + s * move|² = reach², the smaller root s.
    let a = displacement.xy().norm_squared();
    let b = from.dot(&displacement.xy());
    let c = from.norm_squared() - reach * reach;
    if a == 0.0 || b >= 0.0 {
        return 1.0; // standing, or moving apart
    }
    if c <= 0.0 {
        return 0.0;
    }
    let discriminant = b * b - a * c;
    if discriminant <= 0.0 { 1.0 } else { ((-b - discriminant.sqrt()) / a).clamp(0.0, 1.0) }
}

#[cfg(test)]
mod tests {
    use simworld_core::seed::Seed;

    use super::*;

    fn disc(x: f64, y: f64) -> Claim {
        Claim { center: Point2::new(x, y), radius: 0.25, bottom: 0.0, top: 1.8 }
    }

    #[test]
    fn a_step_ends_at_the_gap() {
        let share = share_before(&disc(1.0, 0.0), &disc(0.0, 0.0), &Vector3::new(1.0, 0.0, 0.0), 0.02);
        assert!((share - 0.48).abs() < 1e-12, "{share}");
    }

    /// Against all of them, however the bodies are spread and however wide they are.
    #[test]
    fn what_is_far_away_is_left_out_and_nothing_else() {
        let mut rng = Seed(7).stream("test/claims").rng();
        for _ in 0..200 {
            let mut claims = Claims::default();
            let all: Vec<Claim> = (0..80)
                .map(|_| Claim {
                    radius: rng.uniform(0.1, 1.5),
                    ..disc(rng.uniform(-9.0, 9.0), rng.uniform(-9.0, 9.0))
                })
                .collect();
            for claim in &all {
                claims.take(*claim);
            }
            let room = disc(rng.uniform(-9.0, 9.0), rng.uniform(-9.0, 9.0));
            let step = Vector3::new(rng.uniform(-3.0, 3.0), rng.uniform(-3.0, 3.0), 0.0);
            let expected =
                all.iter().map(|claim| share_before(claim, &room, &step, 0.02)).fold(1.0, f64::min);
            assert_eq!(claims.free_share(&room, &step, 0.02), expected);
        }
    }

    #[test]
    fn passing_by_above_or_away_is_free() {
        let step = Vector3::new(1.0, 0.0, 0.0);
        assert_eq!(share_before(&disc(1.0, 0.6), &disc(0.0, 0.0), &step, 0.02), 1.0);
        assert_eq!(share_before(&disc(-0.3, 0.0), &disc(0.0, 0.0), &step, 0.02), 1.0);
        let below = Claim { bottom: -2.0, top: -0.1, ..disc(1.0, 0.0) };
        assert_eq!(share_before(&below, &disc(0.0, 0.0), &step, 0.02), 1.0);
    }
}
