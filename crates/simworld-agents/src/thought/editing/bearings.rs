//! Directions by name: those of the compass, and those of a thing by its front.

use std::f64::consts::{FRAC_PI_2, PI};

use simworld_core::geometry::yaw_of;
use simworld_core::id::EntityId;
use simworld_core::ops::wrap_angle;
use simworld_core::scene::Scene;

use crate::language::winds;

/// The sides of a thing, and how far each is from its front, radians.
const OWN: [(&str, f64); 4] = [("front", 0.0), ("left", FRAC_PI_2), ("back", PI), ("right", -FRAC_PI_2)];
/// Directions that differ by less are the same, radians.
const SAME: f64 = 1e-9;

/// The eight directions of the compass.
pub(super) fn compass() -> impl Iterator<Item = &'static str> {
    winds().map(|(name, _)| name)
}

/// The sides of a thing.
pub(super) fn own_sides() -> impl Iterator<Item = &'static str> {
    OWN.into_iter().map(|(name, _)| name)
}

/// Where a direction of the compass leads, radians from east.
pub(super) fn by_compass(name: &str) -> Option<f64> {
    winds().find(|(own, _)| *own == name).map(|(_, heading)| heading)
}

/// The direction of the compass that leads there.
pub(super) fn compass_of(heading: f64) -> Option<&'static str> {
    winds().find(|(_, own)| is_same(*own, heading)).map(|(name, _)| name)
}

/// Where a side of a thing looks, radians from east.
pub(super) fn by_side(name: &str, thing: EntityId, scene: &dyn Scene) -> Option<f64> {
    let (_, turn) = OWN.into_iter().find(|(own, _)| *own == name)?;
    Some(wrap_angle(yaw_of(scene.entity(thing)?.pose) + turn))
}

/// The side of a thing that looks there.
pub(super) fn side_of(heading: f64, thing: EntityId, scene: &dyn Scene) -> Option<&'static str> {
    own_sides().find(|side| by_side(side, thing, scene).is_some_and(|own| is_same(own, heading)))
}

pub(super) fn is_same(one: f64, other: f64) -> bool {
    wrap_angle(one - other).abs() < SAME
}
