//! How things stand to each other, as geometric tests.

use simworld_core::geometry::{Aabb, Point2, Twist, direction, heading as heading_of};
use simworld_core::id::{EntityId, RoadId};
use simworld_core::net::{Road, polyline};
use simworld_core::ops::wrap_angle;
use simworld_core::scene::{EntityInfo, EntityKind, EntityRef, Scene};

use super::edit::Stand;
use super::land::{Streets, offset_along};
use super::solid::Solid;

/// A gap that still counts as near, m: that of [`Relation::Near`](simworld_core::scene::Relation::Near).
pub(super) const NEAR: f64 = 30.0;
/// How far "across the street" and "north of" reach, m.
pub(super) const FAR_SIDE: f64 = 60.0;
/// Across from a thing without a street one stands at least so far off, m.
pub(super) const OPPOSITE: f64 = 5.0;
/// As far from a long side as "along" it, m.
pub(super) const ALONG: f64 = 4.0;
/// As far from a kerb as "along" a street, m.
pub(super) const ROADSIDE: f64 = 6.0;
/// As far from a corner as "at" it, m.
pub(super) const CORNER: f64 = 3.0;
/// As far from where streets meet as "at the junction", m.
pub(super) const JUNCTION: f64 = 20.0;
/// As far from an edge as "at" it, m.
pub(super) const EDGE: f64 = 2.0;
/// As far as things on one block are from each other, m.
pub(super) const BLOCK: f64 = 250.0;
/// Half the width of a direction that is named with a distance, radians.
pub(super) const AIM: f64 = 0.105;
/// As far from a point as "here", m.
pub(super) const AROUND: f64 = 25.0;

/// A thing that stands somewhere, or may stand there.
#[derive(Clone, Copy)]
pub(super) struct Subject<'a> {
    /// Its id, if it is in the scene.
    pub(super) id: Option<EntityId>,
    pub(super) kind: EntityKind,
    pub(super) info: &'a EntityInfo,
}

impl Subject<'_> {
    /// The thing as it would stand.
    fn placed<'a>(&'a self, solid: &'a Solid, bounds: &'a Aabb) -> EntityRef<'a> {
        EntityRef {
            // No entity has this id, so that a thing which is not there yet is nobody else.
            id: self.id.unwrap_or(EntityId::new(u32::MAX, u32::MAX)),
            kind: self.kind,
            pose: &solid.pose,
            twist: &Twist::ZERO,
            bounds,
            info: self.info,
            attachment: None,
        }
    }
}

impl Stand {
    /// Whether a thing of the scene stands so; never if it, or what it should stand to, is not there.
    ///
    /// ```
    /// use simworld_agents::editing::Stand;
    /// use simworld_core::geometry::{Point3, pose_facing};
    /// use simworld_core::scene::{EntityDesc, EntityKind, Shape, World};
    /// let mut world = World::new();
    /// let mut put = |kind, x: f64| {
    ///     let pose = pose_facing(Point3::new(x, 0.0, 0.0), 0.0);
    ///     world.spawn(EntityDesc::new(kind, pose, Shape::cuboid(1.0, 1.0, 1.0)))
    /// };
    /// let (one, bench, other) = (put(EntityKind::Tree, 0.0)?, put(EntityKind::Bench, 4.0)?, put(EntityKind::Tree, 9.0)?);
    /// assert!(Stand::Between { one, other }.holds(&world, bench));
    /// assert!(!Stand::Between { one: bench, other }.holds(&world, one));
    /// # Ok::<(), simworld_core::scene::WorldError>(())
    /// ```
    pub fn holds(&self, scene: &dyn Scene, thing: EntityId) -> bool {
        scene.entity(thing).is_some_and(|entity| {
            let subject = Subject { id: Some(thing), kind: entity.kind, info: entity.info };
            let asks = matches!(
                self,
                Self::AcrossFrom { .. }
                    | Self::AlongRoad { .. }
                    | Self::OnSide { .. }
                    | Self::OnBlockOf { .. }
                    | Self::AtJunction { .. }
            );
            let streets = scene.roads().filter(|_| asks).map(Streets::of);
            self.would_hold(scene, streets.as_ref(), subject, &Solid::of(&entity))
        })
    }

    /// Whether the subject would stand so at this place.
    pub(super) fn would_hold(
        &self,
        scene: &dyn Scene,
        streets: Option<&Streets>,
        subject: Subject<'_>,
        solid: &Solid,
    ) -> bool {
        let anchor = |id: &EntityId| scene.entity(*id).filter(|found| subject.id != Some(found.id));
        let at = solid.planar();
        match self {
            Self::To { relation, anchor: to } => {
                anchor(to).is_some_and(|to| relation.holds(&subject.placed(solid, &solid.bounds()), &to))
            }
            Self::Between { one, other } => match (anchor(one), anchor(other)) {
                (Some(one), Some(other)) => is_between(at, one.planar(), other.planar()),
                _ => false,
            },
            Self::AcrossFrom { anchor: from } => {
                anchor(from).is_some_and(|from| is_across(streets, &Solid::of(&from), solid))
            }
            Self::Along { anchor: side } => {
                anchor(side).is_some_and(|side| is_along(&Solid::of(&side), solid))
            }
            Self::AlongRoad { roads } => streets.is_some_and(|streets| is_beside(streets, roads, at)),
            Self::OnSide { roads, heading } => {
                streets.is_some_and(|streets| is_on_side(streets, roads, *heading, at))
            }
            Self::AtCornerOf { anchor: of } => anchor(of).is_some_and(|of| {
                let corners = Solid::of(&of).corners();
                corners.into_iter().any(|corner| solid.distance_to(corner) <= CORNER)
            }),
            Self::Towards { heading, anchor: from } => {
                anchor(from).is_some_and(|from| is_towards(*heading, &Solid::of(&from), solid))
            }
            Self::Offset { anchor: from, heading, distance } => {
                anchor(from).is_some_and(|from| is_off(*heading, *distance, &Solid::of(&from), solid))
            }
            Self::Apart { anchor: from, least, most } => {
                anchor(from).is_some_and(|from| (*least..=*most).contains(&Solid::of(&from).gap(solid)))
            }
            Self::OnBlockOf { anchor: of } => anchor(of).is_some_and(|of| {
                let apart = (at - of.planar()).norm();
                apart <= BLOCK && !streets.is_some_and(|streets| streets.crosses(of.planar(), at))
            }),
            Self::InMiddleOf { anchor: of } => anchor(of).is_some_and(|of| {
                let of = Solid::of(&of);
                (at - of.planar()).norm() <= (of.half().min() * 0.2).max(2.0)
            }),
            Self::AtEdgeOf { anchor: of } => {
                anchor(of).is_some_and(|of| Solid::of(&of).edge_distance(at) <= EDGE)
            }
            Self::AtJunction { junction } => streets.is_some_and(|streets| {
                let place = streets.network().intersections.get(junction.index());
                place.is_some_and(|place| solid.distance_to(place.center) <= JUNCTION)
            }),
            Self::At { point } => (at - point).norm() <= 1e-6,
            Self::Around { point } => solid.distance_to(*point) <= AROUND,
        }
    }
}

/// How much more or less a distance may be that was named, m.
pub(super) fn slack(distance: f64) -> f64 {
    (distance * 0.05).max(0.25)
}

fn is_between(at: Point2, one: Point2, other: Point2) -> bool {
    let along = other - one;
    let length = along.norm();
    if length < 1e-6 {
        return false;
    }
    let (way, offset) = (along / length, at - one);
    let (forward, aside) = (offset.dot(&way), way.perp(&offset).abs());
    forward > 0.0 && forward < length && aside <= (length / 3.0).max(2.0)
}

fn is_towards(heading: f64, anchor: &Solid, solid: &Solid) -> bool {
    let way = solid.planar() - anchor.planar();
    let forward = way.dot(&direction(heading));
    // Within 45°: as much forward as aside.
    forward > 0.0 && forward * forward * 2.0 >= way.norm_squared() && anchor.gap(solid) <= FAR_SIDE
}

fn is_off(heading: f64, distance: f64, anchor: &Solid, solid: &Solid) -> bool {
    let way = solid.planar() - anchor.planar();
    let off = wrap_angle(heading_of(&way) - heading).abs();
    (anchor.gap(solid) - distance).abs() <= slack(distance) && off <= AIM
}

fn is_along(anchor: &Solid, solid: &Solid) -> bool {
    let (half, local) = (anchor.half(), anchor.local(solid.planar()));
    let beside = if half.x >= half.y { local.x.abs() <= half.x } else { local.y.abs() <= half.y };
    let off = if half.x >= half.y { local.y.abs() > half.y } else { local.x.abs() > half.x };
    beside && off && anchor.gap(solid) <= ALONG
}

fn is_across(streets: Option<&Streets>, anchor: &Solid, solid: &Solid) -> bool {
    let (gap, from, to) = (anchor.gap(solid), anchor.planar(), solid.planar());
    if gap > FAR_SIDE {
        return false;
    }
    let crosses = |streets: &Streets, road| {
        let pieces = streets.road(road).centerline.windows(2);
        pieces.into_iter().any(|piece| polyline::crossing(from, to, piece[0], piece[1]).is_some())
    };
    match streets.map(|streets| (streets, streets.roads_near(from))) {
        Some((streets, near)) if !near.is_empty() => near.into_iter().any(|road| crosses(streets, road)),
        _ => {
            let (local, half) = (anchor.local(to), anchor.half());
            gap >= OPPOSITE && local.x > 0.0 && local.x * half.y >= local.y.abs() * half.x
        }
    }
}

/// Whether a point lies beside one of some roads, off its carriageway.
fn is_beside(streets: &Streets, roads: &[RoadId], at: Point2) -> bool {
    let beyond = |road: &RoadId| beyond_kerb(streets.road(*road), at);
    roads.iter().any(|road| beyond(road).is_some_and(|beyond| (0.0..=ROADSIDE).contains(&beyond)))
}

/// Whether a point lies to a side of the nearest of some roads.
fn is_on_side(streets: &Streets, roads: &[RoadId], heading: f64, at: Point2) -> bool {
    let nearest = roads
        .iter()
        .filter_map(|road| {
            let line = &streets.road(*road).centerline;
            polyline::closest(line, &at).map(|near| (near.distance, polyline::at(line, near.station).0))
        })
        .min_by(|one, other| one.0.total_cmp(&other.0));
    nearest.is_some_and(|(_, foot)| (at - foot).dot(&direction(heading)) > 0.0)
}

/// How far a point is from the nearer kerb of a road, m, below zero on the carriageway; `None` beyond its ends.
pub(super) fn beyond_kerb(road: &Road, point: Point2) -> Option<f64> {
    let offset = offset_along(&road.centerline, point)?;
    Some(if offset >= 0.0 { offset - road.left_kerb } else { -offset - road.right_kerb })
}
