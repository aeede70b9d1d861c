//! Which buildings of the map stand: those with a way in, out of the way of traffic and of each other.

use std::sync::LazyLock;

use rayon::prelude::*;
use simworld_core::geometry::Point2;
use simworld_core::net::RoadNetwork;

use super::{Outline, raise};
use crate::building::Building;
use crate::doors::{Doors, FARTHEST_DOOR};
use crate::occupancy::Occupancy;
use crate::osm::error::Warning;
use crate::osm::place::Place;

/// Most are nearer than this to one, m.
const USUAL_DOOR: f64 = 40.0;

/// A building that may stand, and the convex pieces of the ground under it.
pub(in crate::osm) struct Raised {
    pub(in crate::osm) building: Building,
    pub(in crate::osm) pieces: Vec<Vec<Point2>>,
}

/// Raises a building on each outline, the largest first: what overlaps it is a part of it. `None` where no sidewalk is
/// near.
pub(in crate::osm) fn raise_all(outlines: &mut [Outline], network: &RoadNetwork) -> Vec<Option<Raised>> {
    if outlines.is_empty() {
        return Vec::new();
    }
    outlines.sort_by(|a, b| b.area.total_cmp(&a.area).then(a.element.cmp(&b.element)));
    // Most doors are near: the wide search is for the others, and in most towns for none.
    let near = Doors::of(network, USUAL_DOOR);
    let far = LazyLock::new(|| Doors::of(network, FARTHEST_DOOR));
    let raised = outlines.par_iter().with_min_len(32).map(|outline| {
        let door = |at| near.nearest(network, at).or_else(|| far.nearest(network, at));
        let building = raise(outline, door)?;
        let pieces = building.ground();
        Some(Raised { building, pieces })
    });
    raised.collect()
}

/// The buildings that stand neither on a carriageway nor in each other; what stands is added to `taken`.
pub(in crate::osm) fn stand(
    place: &Place,
    outlines: &[Outline],
    raised: Vec<Option<Raised>>,
    carriageways: &Occupancy,
    taken: &mut Occupancy,
    warnings: &mut Vec<Warning>,
) -> Vec<Building> {
    let mut standing = Occupancy::with_capacity(raised.len() * 4);
    let mut buildings = Vec::with_capacity(raised.len());
    for (outline, raised) in outlines.iter().zip(raised) {
        let mut leave_out = |what: &str| {
            let at = outline.corners.first().map(|corner| place.geographic(*corner));
            let what = format!("a building {what}; left out");
            warnings.push(Warning { what, element: Some(outline.element), at });
        };
        let Some(Raised { building, pieces }) = raised else {
            leave_out("has no sidewalk within 150 m");
            continue;
        };
        if pieces.iter().any(|piece| !carriageways.is_free(piece)) {
            leave_out("stands on a carriageway");
        } else if pieces.iter().any(|piece| !standing.is_free(piece)) {
            leave_out("stands in another one");
        } else {
            for piece in &pieces {
                standing.add(piece);
                taken.add(piece);
            }
            buildings.push(building);
        }
    }
    buildings
}
