//! Turning circles where the map has them.

use simworld_core::geometry::Point2;
use simworld_core::net::StreetPlan;

use crate::osm::place::Place;
use crate::osm::tags::Key;

/// A circle this near to a dead end is its, m: streets are drawn up to its middle or up to its rim.
const NEAR: f64 = 15.0;

/// Gives dead ends at which the map has a turning circle or loop the widest that has room, or a hammerhead where none has;
/// others have none.
/// <https://wiki.openstreetmap.org/wiki/Tag:highway%3Dturning_circle>
pub(super) fn set(plan: &mut StreetPlan, place: &Place) {
    const KINDS: [&str; 2] = ["turning_circle", "turning_loop"];
    let drawn = place.raw.tagged_nodes().filter(|(_, tags)| tags.is_any(Key::Highway, &KINDS));
    let mut circles: Vec<Point2> = drawn.filter_map(|(node, _)| place.point(node)).collect();
    if circles.is_empty() {
        return;
    }
    circles.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    plan.make_turning_room();
    for street in &mut plan.streets {
        for (end, node) in [street.from, street.to].into_iter().enumerate() {
            let at = plan.nodes[node];
            let from = circles.partition_point(|circle| circle.x < at.x - NEAR);
            let mut near = circles[from..].iter().take_while(|circle| circle.x <= at.x + NEAR);
            if !near.any(|circle| (circle - at).norm() <= NEAR) {
                (street.turning[end], street.hammerhead[end]) = (0.0, false);
            }
        }
    }
}
