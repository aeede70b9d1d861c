//! The gap to walls, where a cast has missed one.
//!
//! A cast that starts at the very gap that it looks for misses now and then: its rays on the difference of two solids begin on the
//! surface of that. The character controller stops people at that gap, so that all the casts of who goes along a wall begin there; the one
//! by which it looks whether there is room on a step was seen to miss a wall of seven metres, and put people 4 cm into it. So
//! where a way ends is looked at once more.

use parry3d_f64::query::contact;
use parry3d_f64::shape::Shape;
use rapier3d_f64::math::{Pose as RapierPose, Vector};
use rapier3d_f64::prelude::QueryPipeline;

use super::walk::SKIN;
use crate::shape::BodyTag;

/// No cast that finds a wall ends closer to it than this, m.
const CLOSE: f64 = 0.5 * SKIN;
/// A surface whose normal points less upward or downward than this is a wall.
const WALL: f64 = 0.5;
/// How often who is put off one wall is looked at again, for another one.
const PASSES: usize = 4;
/// What rounding leaves of a gap, m.
const HAIR: f64 = 1e-6;

/// The way of a solid from a pose, put off the walls that it leads into; none where it does not come off them.
pub(super) fn kept(
    solid: &dyn Shape,
    start: &RapierPose,
    way: Vector,
    queries: &QueryPipeline<'_>,
) -> Vector {
    let mut kept = way;
    for _ in 0..PASSES {
        match intrusion(solid, start, kept, queries) {
            Some(back) => kept += back,
            None => return kept,
        }
    }
    if intrusion(solid, start, kept, queries).is_none() { kept } else { Vector::ZERO }
}

/// What is missing from the end of a way to the gap that is kept to walls, or was before, if it leads into one.
fn intrusion(
    solid: &dyn Shape,
    start: &RapierPose,
    way: Vector,
    queries: &QueryPipeline<'_>,
) -> Option<Vector> {
    let end = RapierPose::from_translation(way) * *start;
    let mut aabb = solid.compute_aabb(&end);
    aabb.mins -= Vector::splat(CLOSE);
    aabb.maxs += Vector::splat(CLOSE);
    queries.intersect_aabb_conservative(aabb).find_map(|(_, other)| {
        if BodyTag::from_user_data(other.user_data) == BodyTag::Ground {
            return None;
        }
        let gap =
            |pose: &RapierPose, reach| contact(pose, solid, other.position(), other.shape(), reach).ok()?;
        let found = gap(&end, CLOSE).filter(|found| found.normal1.z.abs() < WALL)?;
        let before = gap(start, SKIN).map_or(SKIN, |before| before.dist);
        (found.dist < before - HAIR).then(|| found.normal1 * (found.dist - before))
    })
}
