//! The ground as entities: plates.

use simworld_core::geometry::{Point2, Vector2};
use simworld_core::scene::{EntityDesc, EntityKind};

use super::{GROUND_TOP, Parts, Stripe, layer};

/// Width of a plate of hilly ground, and its top: a little lower, for between its ends it is straight, m.
const PLATE: f64 = 30.0;
const PLATE_TOP: f64 = -0.35;

impl Parts<'_> {
    /// One level plate, or many that follow the hills.
    pub(super) fn plates(&self, descs: &mut Vec<EntityDesc>) {
        let Some((low, high)) = self.ground else { return };
        if self.heights.is_level() {
            let middle = (low.y + high.y) * 0.5;
            let (a, b) = (Point2::new(low.x, middle), Point2::new(high.x, middle));
            let half = (high.y - low.y) * 0.5 + self.margin;
            let stripe = Stripe { a, b, half, extend: self.margin };
            descs.push(layer(EntityKind::Ground, &stripe, GROUND_TOP));
            return;
        }
        let margin = Vector2::repeat(self.margin);
        let (low, high) = (low - margin, high + margin);
        let count = ((high - low) / PLATE).map(f64::ceil);
        for row in 0..count.y as u32 {
            let y = low.y + (f64::from(row) + 0.5) * PLATE;
            if self.rows.is_some_and(|(from, to)| y + PLATE < from || y - PLATE > to) {
                continue;
            }
            self.row((low.x, y), count.x as u32, descs);
        }
    }

    /// A row of plates that follow the hills, from a point on to the east; where it is level, as beside a bridge in a level
    /// city, one for all of it.
    fn row(&self, (west, y): (f64, f64), count: u32, descs: &mut Vec<EntityDesc>) {
        let x = |column: u32| west + f64::from(column) * PLATE;
        let is_level = |column: u32| {
            let places = [(0.0, 0.5), (0.0, -0.5), (0.5, 0.0), (1.0, 0.5), (1.0, -0.5)];
            let place = |(along, up): (f64, f64)| Point2::new(x(column) + along * PLATE, y + up * PLATE);
            places.into_iter().all(|at| self.heights.height(place(at)) == 0.0)
        };
        let mut column = 0;
        while column < count {
            let level = (column..count).take_while(|next| is_level(*next)).count() as u32;
            let next = column + level.max(1);
            let (a, b) = (Point2::new(x(column), y), Point2::new(x(next), y));
            let stripe = Stripe { a, b, half: PLATE * 0.5, extend: 0.0 };
            let top = if level > 0 { GROUND_TOP } else { PLATE_TOP };
            descs.push(self.layer(EntityKind::Ground, &stripe, top));
            column = next;
        }
    }
}
