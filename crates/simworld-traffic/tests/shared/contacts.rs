//! Who touches whom in a traffic, by exact rectangles; only those are compared that are near enough to touch.

use simworld_core::geometry::Obb;
use simworld_traffic::{Body, Traffic};

/// A vehicle with its rectangle and how far that reaches from its middle, m.
struct Solid {
    body: Body,
    obb: Obb,
    reach: f64,
}

impl Solid {
    fn of(body: Body) -> Self {
        let obb = body.shape.obb(&body.pose);
        Self { body, obb, reach: obb.half_extents.xy().norm() }
    }

    fn x(&self) -> f64 {
        self.obb.pose.translation.x
    }

    fn touches(&self, other: &Self) -> bool {
        let apart = self.obb.pose.translation.vector.xy() - other.obb.pose.translation.vector.xy();
        let within = self.reach + other.reach;
        apart.norm_squared() < within * within && self.obb.footprints_overlap(&other.obb)
    }
}

/// Pairs of vehicles whose rectangles overlap, found by a sweep along x.
pub(crate) fn touching(traffic: &Traffic) -> Vec<(Body, Body)> {
    let mut solids: Vec<Solid> = traffic.vehicles().map(Solid::of).collect();
    solids.sort_by(|a, b| a.x().total_cmp(&b.x()));
    let longest = solids.iter().map(|solid| solid.reach).fold(0.0, f64::max);
    let mut found = Vec::new();
    for (index, a) in solids.iter().enumerate() {
        let after = solids[index + 1..].iter().take_while(|b| b.x() - a.x() < a.reach + longest);
        found.extend(after.filter(|b| a.touches(b)).map(|b| (a.body, b.body)));
    }
    found
}

/// Panics where two vehicles touch, and says in which step.
pub(crate) fn assert_apart(traffic: &Traffic, step: usize) {
    let touching = touching(traffic);
    assert!(touching.is_empty(), "at step {step} these touch: {touching:?}");
}
