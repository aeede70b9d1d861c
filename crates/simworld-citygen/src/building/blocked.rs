//! Where along a street of a lot something stands already: what would be planned there is never free, and is not planned.
//!
//! Half of all that is planned on lots at corners would meet what stands along the other street. Nothing is refused here
//! that would be free: who asks is told of what is sure alone.

use simworld_core::geometry::Point2;

use super::site::{Site, Spot, span};
use crate::occupancy::{least, most};

/// Distance by which things must meet to meet for sure, whatever is rounded, m.
const SLACK: f64 = 1e-3;
/// How much of what stands there is reckoned with: less than all, so that its middle meets what touches it here.
const SHRUNK: f64 = 0.9999;

/// What stands along a street, as far as it is sure to be met.
#[derive(Default)]
pub(super) struct Blocked {
    /// From where to where something stands at the least depth and the gap behind it.
    stretches: Vec<(f64, f64)>,
    /// From where to where there is room at every depth.
    roomy: (f64, f64),
    /// The gap that is kept, and the most room that is left free on both sides of a building, m.
    gap: f64,
    spare: f64,
}

impl Blocked {
    /// Looks at what stands on a lot along one of its streets, whatever is to be built there: the least and the greatest depth,
    /// the gap that it keeps, and the most of the room that it leaves free on both sides, m.
    pub(super) fn look(
        &mut self,
        site: &Site<'_>,
        grounds: &[[Point2; 4]],
        depths: (f64, f64),
        (gap, spare): (f64, f64),
        room: impl Fn(f64) -> Option<(f64, f64)>,
    ) {
        self.stretches.clear();
        if grounds.is_empty() {
            return;
        }
        // Lots are convex: what has room at two depths has room at every depth between.
        self.roomy = match (room(depths.0), room(depths.1)) {
            (Some(near), Some(far)) => (most(near.0, far.0), least(near.1, far.1)),
            _ => (f64::INFINITY, f64::NEG_INFINITY),
        };
        (self.gap, self.spare) = (gap, spare);
        let strip = site.depths(depths.0 + gap);
        let stretches = grounds.iter().filter_map(|ground| stretch(site, ground, strip));
        self.stretches.extend(stretches);
    }

    /// Whether a building of the least and the greatest width that is fitted between two stations surely fits, at the first
    /// depth that is tried, and surely meets what stands there.
    pub(super) fn is_sure(&self, (start, end): (f64, f64), (narrowest, widest): (f64, f64)) -> bool {
        if self.stretches.is_empty() {
            return false;
        }
        let latest = most(start, self.roomy.0);
        let room = least(end, self.roomy.1) - latest;
        if room < narrowest + SLACK {
            return false;
        }
        // It is as wide as it may be, and what is left of the room is before it by half at most. So with its gaps it takes at
        // least this, wherever it stands.
        let before = most(least(self.spare, end - start - widest), 0.0) * 0.5;
        let (low, high) =
            (latest + before - self.gap + SLACK, start + least(room, widest) + self.gap - SLACK);
        low < high && self.is_within(low, high)
    }

    /// Whether a building at a spot surely meets what stands there.
    pub(super) fn meets(&self, spot: Spot) -> bool {
        self.is_within(spot.x - self.gap + SLACK, spot.x + spot.width + self.gap - SLACK)
    }

    /// Whether something stands between two stations.
    fn is_within(&self, low: f64, high: f64) -> bool {
        self.stretches.iter().any(|(from, to)| *from < high && low < *to)
    }
}

/// From where to where something stands between two distances from the street.
fn stretch(site: &Site<'_>, ground: &[Point2; 4], (near, far): (f64, f64)) -> Option<(f64, f64)> {
    let middle = nalgebra::center(&ground[0], &ground[2]);
    let corner = |index: usize| site.seen(middle + (ground[index] - middle) * SHRUNK);
    let [a, b, c, d] = [0, 1, 2, 3].map(corner);
    let outline = [d, a, b, c, d];
    let (near, far) = (near + SLACK, far - SLACK);
    if outline.iter().all(|corner| corner.y > far) || outline.iter().all(|corner| corner.y < near) {
        return None;
    }
    // It is widest at one of its corners, or where it leaves the strip.
    let ends = [near, far].into_iter().filter_map(|y| span(&outline, y));
    let within = outline.iter().filter(|corner| near <= corner.y && corner.y <= far);
    ends.chain(within.map(|corner| (corner.x, corner.x)))
        .reduce(|all, next| (all.0.min(next.0), all.1.max(next.1)))
}
