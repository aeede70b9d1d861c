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
        let best = nearest(path, door, (f64::INFINITY, door));
        building.access = if path.is_empty() || best.0.sqrt() < width {
            best.1
        } else {
            round_corners(network, building, best)
        };
    }
}

/// The place nearest to a door on the walkways round the corners at both ends of its street, if it is nearer than another at
/// that squared distance.
fn round_corners(network: &RoadNetwork, building: &Building, mut best: (f64, Point2)) -> Point2 {
    let road = &network.roads[building.road.index()];
    for intersection in [road.from, road.to] {
        for corner in network.intersections[intersection.index()].corners.iter().filter(|c| c.len() >= 2) {
            best = nearest(corner, building.access, best);
        }
    }
    best.1
}

/// The squared distance to the point of a path that is nearest to another, and that point; those of another one if the path
/// is no nearer.
fn nearest(path: &[Point2], point: Point2, mut best: (f64, Point2)) -> (f64, Point2) {
    for pair in path.windows(2) {
        let (step, to) = (pair[1] - pair[0], point - pair[0]);
        let (squared, along) = (step.norm_squared(), to.dot(&step));
        let at = if along <= 0.0 || squared <= 0.0 {
            pair[0]
        } else if along >= squared {
            pair[0] + step
        } else {
            // Divided only where it is nearer; a hair of slack, so that rounding decides nothing.
            let aside = to.perp(&step);
            if aside * aside > best.0 * squared * (1.0 + 1e-9) {
                continue;
            }
            pair[0] + step * (along / squared)
        };
        let distance = (point - at).norm_squared();
        if distance < best.0 {
            best = (distance, at);
        }
    }
    best
}
