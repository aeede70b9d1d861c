//! The ends of a row of lots along an open block: what it leaves to the street round the corner.

use simworld_core::geometry::{Point2, Vector2};

use crate::block::{Border, Ring};

/// A corner less sharp than this is a bend of one street; the sine of the angle by which it turns.
const BEND: f64 = 0.3;
/// Where both streets have rows, corners that turn less than this are shared like bends; the cosine of the angle. To the
/// other street less would be left by a row that took such a corner.
const SHARED: f64 = 0.4;
/// A corner of a row nearer than this to a street lies at it, m.
const AT_LINE: f64 = 1e-6;

/// A front as its neighbours see it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Front {
    /// Length, m; zero where there are no lots.
    pub(super) length: f64,
    /// Whether buildings may stand along it.
    pub(super) is_built: bool,
    /// Depths of the first and the last of its lots, m; zero as long as it has none.
    pub(super) depths: [f64; 2],
}

/// One end of a row, at which the land goes on round a corner.
pub(super) struct Corner {
    at: Point2,
    /// Direction of the street round the corner, away from it; a unit vector.
    away: Vector2,
    /// What lies beyond that street.
    border: Border,
    front: Front,
    /// The line up to which the row reaches, and its normal away from the row.
    limit: (Point2, Vector2),
    /// How far the row leans outwards, per metre of depth.
    lean: f64,
}

impl Corner {
    /// The corner at the end (or else at the beginning) of an edge along a unit vector; `None` where the land ends there.
    pub(super) fn of(
        ring: &Ring,
        fronts: &[Front],
        (index, along): (usize, Vector2),
        is_end: bool,
    ) -> Option<Self> {
        let count = ring.len();
        let neighbour = if is_end { (index + 1) % count } else { (index + count - 1) % count };
        let at = if is_end { ring.next(index) } else { ring.corners[index] };
        let next = ring.edge(neighbour).try_normalize(1e-9)?;
        let (sine, cosine) = (if is_end { along.perp(&next) } else { next.perp(&along) }, along.dot(&next));
        if sine <= 1e-6 {
            return None;
        }
        let front = fronts[neighbour];
        let is_front = front.length > 0.0;
        let is_bend = sine < BEND || (is_front && cosine > SHARED);
        let limit = if is_bend {
            let inwards = if is_end { next - along } else { along - next };
            let normal = Vector2::new(inwards.y, -inwards.x);
            (at, if is_end { normal } else { -normal })
        } else {
            let outwards = Vector2::new(next.y, -next.x);
            (at - outwards * front.depths[usize::from(!is_end)], outwards)
        };
        let lean = if is_front && !is_bend { cosine.max(0.0) / sine } else { 0.0 };
        Some(Self {
            at,
            away: if is_end { next } else { -next },
            border: ring.borders[neighbour],
            front,
            limit,
            lean,
        })
    }

    /// How far the row leans outwards, per metre of depth: where the street round the corner leans away, the corner is wider
    /// at its rear.
    pub(super) fn lean(&self) -> f64 {
        self.lean
    }

    /// The line up to which the row reaches, and its normal away from the row.
    pub(super) fn limit(&self) -> (Point2, Vector2) {
        self.limit
    }

    /// Says of the edges of a row that lie along the street round the corner what they are: a corner lot has two streets.
    pub(super) fn label(&self, row: &mut Ring) {
        if !self.front.is_built {
            return;
        }
        let seen =
            |point: Point2| ((point - self.at).dot(&self.away), (point - self.at).perp(&self.away).abs());
        for index in 0..row.len() {
            let (from, to) = (seen(row.corners[index]), seen(row.next(index)));
            if row.borders[index] != Border::LAND
                || from.1 > AT_LINE
                || to.1 > AT_LINE
                || (from.0 - to.0).abs() < AT_LINE
            {
                continue;
            }
            // Not farther than that street goes straight on.
            let length = self.front.length;
            let end = self.at + self.away * length;
            if from.0.max(to.0) <= length {
                row.borders[index] = self.border;
            } else if from.0 < length {
                row.borders[index] = self.border;
                row.insert(index + 1, end, Border::LAND);
            } else if to.0 < length {
                row.insert(index + 1, end, self.border);
            }
            return;
        }
    }
}
