//! Spatial relations between two entities, as geometric tests.

use serde::{Deserialize, Serialize};

use super::{EntityKind, EntityRef};
use crate::geometry::{Point3, Vector3};

/// A relation of a subject to a reference entity.
///
/// `in front of`, `behind`, `left of` and `right of` are seen from the reference entity itself: in front of a
/// building is where its entrance looks.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Relation {
    /// A gap of at most 2 m, or a quarter of the larger one's width.
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
    /// Within its bounds; of flat ground, such as a park: with its whole footprint on it.
    Inside,
}

/// A gap that still counts as near, m.
const NEAR: f64 = 30.0;

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
        let gap = planar_gap(subject, reference);
        match self {
            Self::NextTo => gap <= next_to_gap(subject, reference),
            Self::Near => gap <= NEAR,
            Self::FarFrom => gap > NEAR,
            Self::InFrontOf => gap <= NEAR && in_quarter(subject, reference, Vector3::x()),
            Self::Behind => gap <= NEAR && in_quarter(subject, reference, -Vector3::x()),
            Self::LeftOf => gap <= NEAR && in_quarter(subject, reference, Vector3::y()),
            Self::RightOf => gap <= NEAR && in_quarter(subject, reference, -Vector3::y()),
            Self::OnTopOf => gap == 0.0 && (subject.bounds.min.z - reference.bounds.max.z).abs() <= 0.05,
            Self::Inside if is_flat(reference.kind) => {
                let corners = subject.obb().footprint();
                let is_on = |corner| reference.info.shape.planar_distance(reference.pose, corner) <= 1e-9;
                corners.iter().all(is_on)
            }
            Self::Inside => {
                reference.bounds.contains(&subject.bounds.min)
                    && reference.bounds.contains(&subject.bounds.max)
            }
        }
    }
}

/// Whether it is ground, on which things stand rather than in it.
const fn is_flat(kind: EntityKind) -> bool {
    matches!(kind, EntityKind::Ground | EntityKind::Road | EntityKind::Sidewalk | EntityKind::Crosswalk)
}

/// Least distance in the plane between the axis-aligned boxes, m.
fn planar_gap(a: &EntityRef<'_>, b: &EntityRef<'_>) -> f64 {
    let apart = |axis: usize| {
        (a.bounds.min[axis] - b.bounds.max[axis]).max(b.bounds.min[axis] - a.bounds.max[axis]).max(0.0)
    };
    let (dx, dy) = (apart(0), apart(1));
    (dx * dx + dy * dy).sqrt()
}

fn next_to_gap(a: &EntityRef<'_>, b: &EntityRef<'_>) -> f64 {
    let width = |entity: &EntityRef<'_>| entity.info.shape.size().xy().max();
    (width(a).max(width(b)) * 0.25).clamp(2.0, 10.0)
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
