//! Where one stands before the entrances of buildings.
//!
//! Streets lie all over the memory, and each is asked for by few buildings. So it is asked for many buildings at once, step by
//! step: what one waits for is fetched while others wait for theirs.

use simworld_core::geometry::Point2;
use simworld_core::net::{RoadNetwork, Sidewalk};

use super::Building;

/// Moves the access of every building from its door to the place on the walkways before it: the middle of the sidewalk or,
/// where that ends before the corner, of the walkway round it.
pub(super) fn lay(network: &RoadNetwork, buildings: &mut [Building]) {
    let walks: Vec<Option<&Sidewalk>> =
        buildings.iter().map(|building| network.sidewalk(building.road, building.side)).collect();
    let paths: Vec<(&[Point2], f64)> = walks
        .into_iter()
        .map(|walk| walk.map_or((&[][..], 0.0), |walk| (&walk.path[..], walk.width)))
        .collect();
    for (building, (path, width)) in buildings.iter_mut().zip(paths) {
        let door = building.access;
        let best = nearest(path, door);
        building.access = if path.is_empty() || (best - door).norm() < width {
            best
        } else {
            round_corners(network, building, best)
        };
    }
}

/// The place nearest to a door on the walkways round the corners at both ends of its street, if it is nearer than another.
fn round_corners(network: &RoadNetwork, building: &Building, mut best: Point2) -> Point2 {
    let door = building.access;
    let road = &network.roads[building.road.index()];
    for intersection in [road.from, road.to] {
        for corner in network.intersections[intersection.index()].corners.iter().filter(|c| c.len() >= 2) {
            let at = nearest(corner, door);
            if (at - door).norm_squared() < (best - door).norm_squared() {
                best = at;
            }
        }
    }
    best
}

/// The point of a path nearest to another; that itself if there is no path.
fn nearest(path: &[Point2], point: Point2) -> Point2 {
    let mut best = (f64::INFINITY, point);
    for pair in path.windows(2) {
        let (step, to) = (pair[1] - pair[0], point - pair[0]);
        let (squared, along) = (step.norm_squared(), to.dot(&step));
        // Divided only where it is nearer; a hair of slack, so that rounding decides nothing.
        let beside = along > 0.0 && along < squared;
        let aside = to.perp(&step);
        if beside && aside * aside > best.0 * squared * (1.0 + 1e-9) {
            continue;
        }
        let share = if squared > 0.0 { (along / squared).clamp(0.0, 1.0) } else { 0.0 };
        let at = pair[0] + step * share;
        let distance = (point - at).norm_squared();
        if distance < best.0 {
            best = (distance, at);
        }
    }
    best.1
}
