//! Spatial relations between two entities, as geometric tests.

use serde::{Deserialize, Serialize};

use super::{EntityKind, EntityRef};
use crate::geometry::{Aabb, Point3, Vector3};

/// A relation of a subject to a reference entity.
///
/// A gap is that in the plane between the [footprints](EntityRef::footprint) of the two, turned as they are.
///
/// `in front of`, `behind`, `left of` and `right of` are seen from the reference entity itself: in front of a
/// building is where its entrance looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Relation {
    /// A gap of at most 2 m, or a quarter of the larger one's width up to 10 m.
    NextTo,
    /// A gap of at most 30 m.
    Near,
    /// A gap of more than 30 m.
    FarFrom,
    /// Near, in the quarter around the reference's forward axis.
    InFrontOf,
    /// Near, in the quarter opposite to its forward axis.
    Behind,
    /// Near, in the quarter to its left.
    LeftOf,
    /// Near, in the quarter to its right.
    RightOf,
    /// Standing on its top, at most 5 cm off.
    OnTopOf,
    /// Within its footprint and its height; of flat ground, such as a park: with its whole footprint on it.
    Inside,
}

/// A gap that still counts as near, m.
const NEAR: f64 = 30.0;
/// Walls that are so near to each other are flush, m: that much is rounding.
const FLUSH: f64 = 1e-9;

impl Relation {
    /// Every relation.
    pub const ALL: &'static [Self] = &[
        Self::NextTo,
        Self::Near,
        Self::FarFrom,
        Self::InFrontOf,
        Self::Behind,
        Self::LeftOf,
        Self::RightOf,
        Self::OnTopOf,
        Self::Inside,
    ];

    /// Whether the subject stands in this relation to the reference.
    ///
    /// ```
    /// use simworld_core::geometry::{Point3, pose_facing};
    /// use simworld_core::scene::{EntityDesc, EntityKind, Relation, Scene, Shape, World};
    /// let mut world = World::new();
    /// let museum = EntityDesc::new(
    ///     EntityKind::Building, pose_facing(Point3::origin(), 0.0), Shape::cuboid(20.0, 30.0, 12.0));
    /// let car = EntityDesc::new(
    ///     EntityKind::Car, pose_facing(Point3::new(15.0, 3.0, 0.0), 1.6), Shape::cuboid(4.5, 1.8, 1.5));
    /// let (museum, car) = (world.spawn(museum)?, world.spawn(car)?);
    /// let (museum, car) = (world.entity(museum).unwrap(), world.entity(car).unwrap());
    /// assert!(Relation::InFrontOf.holds(&car, &museum));
    /// assert!(!Relation::Behind.holds(&car, &museum));
    /// # Ok::<(), simworld_core::scene::WorldError>(())
    /// ```
    pub fn holds(self, subject: &EntityRef<'_>, reference: &EntityRef<'_>) -> bool {
        if subject.id == reference.id {
            return false;
        }
        match self {
            Self::NextTo => is_within(subject, reference, next_to_gap(subject, reference)),
            Self::Near => is_within(subject, reference, NEAR),
            Self::FarFrom => !is_within(subject, reference, NEAR),
            Self::InFrontOf => is_on_side(subject, reference, Vector3::x()),
            Self::Behind => is_on_side(subject, reference, -Vector3::x()),
            Self::LeftOf => is_on_side(subject, reference, Vector3::y()),
            Self::RightOf => is_on_side(subject, reference, -Vector3::y()),
            Self::OnTopOf => {
                (subject.bounds.min.z - reference.bounds.max.z).abs() <= 0.05
                    && is_within(subject, reference, 0.0)
            }
            Self::Inside if is_flat(reference.kind) => {
                let corners = subject.obb().footprint();
                let is_on = |corner| reference.info.shape.planar_distance(reference.pose, corner) <= FLUSH;
                corners.iter().all(is_on)
            }
            Self::Inside => is_inside(subject, reference),
        }
    }
}

/// Whether it is ground, on which things stand rather than in it.
const fn is_flat(kind: EntityKind) -> bool {
    matches!(kind, EntityKind::Ground | EntityKind::Road | EntityKind::Sidewalk | EntityKind::Crosswalk)
}

/// Whether the gap between the two is at most so wide, m. The boxes around them lie with what says where they are, and tell most of it:
/// they are never farther apart than the footprints, and the middles never nearer.
fn is_within(a: &EntityRef<'_>, b: &EntityRef<'_>, most: f64) -> bool {
    if box_gap(a.bounds, b.bounds) > most {
        return false;
    }
    let way = (b.bounds.center() - a.bounds.center()).xy();
    if way.norm_squared() <= most * most {
        return true;
    }
    let (a, b) = (a.footprint(), b.footprint());
    // What stands along the axes fills its box.
    a.is_along_axes() && b.is_along_axes() || a.gap(&b) <= most
}

/// Least distance in the plane between two boxes, m.
fn box_gap(a: &Aabb, b: &Aabb) -> f64 {
    let apart = |axis: usize| (a.min[axis] - b.max[axis]).max(b.min[axis] - a.max[axis]).max(0.0);
    let (dx, dy) = (apart(0), apart(1));
    (dx * dx + dy * dy).sqrt()
}

/// Whether the subject lies within what a body takes of the ground, and of the height.
fn is_inside(subject: &EntityRef<'_>, reference: &EntityRef<'_>) -> bool {
    let (own, around) = (subject.bounds, reference.bounds);
    // Boxes around what is turned are rounded: what stands on the floor is not below it.
    let is_between = own.min.z >= around.min.z - FLUSH && own.max.z <= around.max.z + FLUSH;
    if !is_between || box_gap(own, around) > 0.0 {
        return false;
    }
    let (inner, outer) = (subject.footprint(), reference.footprint());
    if inner.is_along_axes() && outer.is_along_axes() {
        return around.contains(&own.min) && around.contains(&own.max);
    }
    inner.corners().iter().all(|corner| outer.distance_to(corner) <= FLUSH)
}

fn next_to_gap(a: &EntityRef<'_>, b: &EntityRef<'_>) -> f64 {
    let width = |entity: &EntityRef<'_>| entity.info.shape.size().xy().max();
    (width(a).max(width(b)) * 0.25).clamp(2.0, 10.0)
}

/// Whether the subject is near, and in the quarter around `axis` of the reference's body frame.
fn is_on_side(subject: &EntityRef<'_>, reference: &EntityRef<'_>, axis: Vector3) -> bool {
    in_quarter(subject, reference, axis) && is_within(subject, reference, NEAR)
}

/// Whether the subject's centre lies in the 90° sector around `axis` of the reference's body frame, measured
/// in units of the reference's size so that "in front of" a long façade covers all of it.
fn in_quarter(subject: &EntityRef<'_>, reference: &EntityRef<'_>, axis: Vector3) -> bool {
    let center: Point3 = subject.bounds.center();
    let local = reference.pose.inverse_transform_point(&center);
    let size = reference.info.shape.size();
    let scaled = Vector3::new(local.x / size.x, local.y / size.y, 0.0);
    let along = scaled.dot(&axis);
    along > 0.0 && along * along * 2.0 >= scaled.norm_squared()
}
