//! What is where: the [`Scene`] seam, the [`World`] store that implements it, and the entities in it.

mod classes;
mod entity;
mod footing;
mod gesture;
mod interaction;
mod kind;
mod naming;
mod playing;
pub(crate) mod quadtree;
mod ray;
mod relation;
mod shape;
mod stride;
mod world;

use std::ops::ControlFlow;
use std::sync::Arc;

pub use classes::ClassIndex;
pub use entity::{Attachment, EntityDesc, EntityInfo, EntityRef, MATERIAL, Role, Solidity, Visibility};
pub use footing::{CROUCHED, FOOTING, FallCause, Footing};
pub use gesture::{GESTURE, GESTURE_END, Gesture, POINTING};
pub use interaction::{
    ARM_REACH, CARRY_LIMIT, EARSHOT, FIELD_OF_VIEW, GAZE, HAND_LIMIT, InteractionError, LOCKED, MOST_THROWN,
    OPEN, SELLS, check_action,
};
pub use kind::{EntityKind, Place};
pub use naming::NameIndex;
pub use playing::{CLIP, CLIP_ONCE, CLIP_RATE, CLIP_SINCE};
pub use relation::Relation;
pub use shape::{Shape, ShapeError};
pub use stride::Stride;
pub use world::{Mark, World, WorldError, WorldSnapshot};

use crate::asset::Catalogue;
use crate::clock::Clock;
use crate::environment::Environment;
use crate::geometry::{Aabb, Point2, Ray, Vector3};
use crate::ground::Ground;
use crate::id::EntityId;
use crate::limbs::JointAngles;
use crate::links::Links;
use crate::net::{Aspect, RoadNetwork};
use crate::traffic::RoadLeg;

/// What is where: the seam through which observers, planners, executors and tasks read a world.
///
/// A reader sees the frozen state of the last finished step; several threads may read at once.
///
/// # Implementing it
///
/// Three methods are required; everything else follows from them. A scene of one's own, without a `World`:
///
/// ```
/// use std::ops::ControlFlow;
/// use simworld_core::environment::Environment;
/// use simworld_core::geometry::{Aabb, Point2, Point3, Pose, Twist, pose_facing};
/// use simworld_core::id::EntityId;
/// use simworld_core::scene::{EntityDesc, EntityInfo, EntityKind, EntityRef, Scene, Shape};
///
/// /// A row of lamps along a street, computed instead of stored.
/// struct LampRow { lamps: Vec<(Pose, Aabb)>, info: EntityInfo, environment: Environment }
///
/// impl LampRow {
///     fn new(count: u32) -> Self {
///         let shape = Shape::Cylinder { radius: 0.1, height: 6.0 };
///         let stand = |i| pose_facing(Point3::new(f64::from(i) * 30.0, 0.0, 0.0), 0.0);
///         Self {
///             lamps: (0..count).map(|i| (stand(i), shape.aabb(&stand(i)))).collect(),
///             info: EntityDesc::new(EntityKind::StreetLamp, Pose::identity(), shape).info,
///             environment: Environment::default(),
///         }
///     }
/// }
///
/// impl Scene for LampRow {
///     fn entity(&self, id: EntityId) -> Option<EntityRef<'_>> {
///         let (pose, bounds) = self.lamps.get(id.index())?;
///         let kind = EntityKind::StreetLamp;
///         Some(EntityRef { id, kind, pose, twist: &Twist::ZERO, bounds, info: &self.info, attachment: None })
///     }
///
///     fn visit(
///         &self,
///         region: &Aabb,
///         visitor: &mut dyn FnMut(EntityRef<'_>) -> ControlFlow<()>,
///     ) -> ControlFlow<()> {
///         for index in 0..self.lamps.len() {
///             let lamp = self.entity(EntityId::new(index as u32, 0)).expect("index is in range");
///             if lamp.bounds.intersects(region) { visitor(lamp)?; }
///         }
///         ControlFlow::Continue(())
///     }
///
///     fn environment(&self) -> &Environment { &self.environment }
/// }
///
/// let row = LampRow::new(10);
/// simworld_core::testing::check_scene(&row);
/// let lamp = row.nearest(Point2::new(95.0, 4.0), 50.0, &|_| true).unwrap();
/// assert_eq!(lamp.id.index(), 3);
/// ```
pub trait Scene: Sync {
    /// The entity of that id, if it lives.
    fn entity(&self, id: EntityId) -> Option<EntityRef<'_>>;

    /// Visits every entity whose bounds touch the region, each once, in an order that depends on the state alone;
    /// breaks off when the visitor does.
    fn visit(
        &self,
        region: &Aabb,
        visitor: &mut dyn FnMut(EntityRef<'_>) -> ControlFlow<()>,
    ) -> ControlFlow<()>;

    /// Sun and weather.
    fn environment(&self) -> &Environment;

    /// Simulated time.
    fn clock(&self) -> Clock {
        Clock::default()
    }

    /// The roads, if the scene has any.
    fn roads(&self) -> Option<&Arc<RoadNetwork>> {
        None
    }

    /// The surface that everything stands on, if it is not flat at height 0.
    fn ground(&self) -> Option<&Arc<Ground>> {
        None
    }

    /// The assets that entities are made from, if the scene has any.
    fn assets(&self) -> Option<&Arc<Catalogue>> {
        None
    }

    /// What every signal group shows now, indexed by [`SignalGroup`](crate::net::SignalGroup); empty without
    /// signals.
    fn signals(&self) -> &[Aspect] {
        &[]
    }

    /// Whether that direction of a road is closed to traffic.
    fn is_closed(&self, _leg: RoadLeg) -> bool {
        false
    }

    /// How somebody holds its limbs, if whoever moves it says so.
    fn joints(&self, _id: EntityId) -> Option<&JointAngles> {
        None
    }

    /// What of an entity moves for itself, if whoever moves it says so: it is drawn as these links.
    fn links(&self, _id: EntityId) -> Option<Links<'_>> {
        None
    }

    /// How somebody whose model has clips has come to what it shows, if the scene remembers that; the world does, from the end of its first step on.
    fn stride(&self, _id: EntityId) -> Option<&Stride> {
        None
    }

    /// What everything is called, if the scene keeps an index of names; the world does.
    fn names(&self) -> Option<&NameIndex> {
        None
    }

    /// Entities by what they are, if the scene keeps an index of that; the world does.
    fn classes(&self) -> Option<&ClassIndex> {
        None
    }

    /// Now, for a later [`visit_changes`](Self::visit_changes), if the scene keeps account of what changes; the world does.
    fn mark(&self) -> Option<Mark> {
        None
    }

    /// Visits every slot (the [index](EntityId::index) of ids) in which anything may have changed since a mark, with who is there now;
    /// some may come twice. False if the scene cannot say: then look at everything.
    fn visit_changes(&self, _since: Mark, _visitor: &mut dyn FnMut(usize, Option<EntityRef<'_>>)) -> bool {
        false
    }

    /// The entity nearest to a point in the plane, by distance to its footprint, that passes the filter and lies
    /// within `max_distance` m. Of two at the same distance the lower id is taken.
    fn nearest(
        &self,
        point: Point2,
        max_distance: f64,
        filter: &dyn Fn(&EntityRef<'_>) -> bool,
    ) -> Option<EntityRef<'_>> {
        let mut radius = 16.0_f64.min(max_distance);
        loop {
            let mut best: Option<(f64, EntityId)> = None;
            let _ = self.visit(&Aabb::column_around(point, radius), &mut |entity| {
                let distance = entity.info.shape.planar_distance(entity.pose, &point);
                let closer = best.is_none_or(|(least, id)| (distance, entity.id) < (least, id));
                if distance <= radius && closer && filter(&entity) {
                    best = Some((distance, entity.id));
                }
                ControlFlow::Continue(())
            });
            match best {
                Some((_, id)) => return self.entity(id),
                None if radius >= max_distance => return None,
                None => radius = (radius * 2.0).min(max_distance),
            }
        }
    }

    /// Visits the carried, seated, riding and part entities of a carrier; by default it searches around it.
    fn visit_attached(&self, parent: EntityId, visitor: &mut dyn FnMut(EntityRef<'_>)) {
        let Some(carrier) = self.entity(parent) else { return };
        let _ = self.visit(&carrier.bounds.inflated(3.0), &mut |entity| {
            if entity.attachment.is_some_and(|bond| bond.parent == parent) {
                visitor(entity);
            }
            ControlFlow::Continue(())
        });
    }

    /// What hangs on the carrier in that role; the lowest id, should there be several.
    fn attached(&self, parent: EntityId, role: Role) -> Option<EntityId> {
        let mut found: Option<EntityId> = None;
        self.visit_attached(parent, &mut |entity| {
            if entity.attachment.is_some_and(|bond| bond.role == role)
                && found.is_none_or(|id| entity.id < id)
            {
                found = Some(entity.id);
            }
        });
        found
    }
}

macro_rules! forward_scene {
    ($($target:ty),+) => {
        $(impl<S: Scene + ?Sized> Scene for $target {
            fn entity(&self, id: EntityId) -> Option<EntityRef<'_>> {
                (**self).entity(id)
            }
            fn visit(
                &self,
                region: &Aabb,
                visitor: &mut dyn FnMut(EntityRef<'_>) -> ControlFlow<()>,
            ) -> ControlFlow<()> {
                (**self).visit(region, visitor)
            }
            fn environment(&self) -> &Environment {
                (**self).environment()
            }
            fn clock(&self) -> Clock {
                (**self).clock()
            }
            fn roads(&self) -> Option<&Arc<RoadNetwork>> {
                (**self).roads()
            }
            fn ground(&self) -> Option<&Arc<Ground>> {
                (**self).ground()
            }
            fn assets(&self) -> Option<&Arc<Catalogue>> {
                (**self).assets()
            }
            fn signals(&self) -> &[Aspect] {
                (**self).signals()
            }
            fn is_closed(&self, leg: RoadLeg) -> bool {
                (**self).is_closed(leg)
            }
            fn joints(&self, id: EntityId) -> Option<&JointAngles> {
                (**self).joints(id)
            }
            fn links(&self, id: EntityId) -> Option<Links<'_>> {
                (**self).links(id)
            }
            fn stride(&self, id: EntityId) -> Option<&Stride> {
                (**self).stride(id)
            }
            fn names(&self) -> Option<&NameIndex> {
                (**self).names()
            }
            fn classes(&self) -> Option<&ClassIndex> {
                (**self).classes()
            }
            fn mark(&self) -> Option<Mark> {
                (**self).mark()
            }
            fn visit_changes(&self, since: Mark, visitor: &mut dyn FnMut(usize, Option<EntityRef<'_>>)) -> bool {
                (**self).visit_changes(since, visitor)
            }
            fn visit_attached(&self, parent: EntityId, visitor: &mut dyn FnMut(EntityRef<'_>)) {
                (**self).visit_attached(parent, visitor);
            }
        })+
    };
}
forward_scene!(Box<S>, &S, &mut S);

/// Where a ray met something.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RayHit {
    /// What it met.
    pub entity: EntityId,
    /// How far from the origin, m.
    pub distance: f64,
    /// The outward normal of the surface there, unit length.
    pub normal: Vector3,
}

/// The capability of answering rays exactly; a scene that has colliders implements it.
pub trait RayCast {
    /// The first solid thing on the ray within `max_distance` m that passes the filter.
    ///
    /// A ray that starts inside a solid meets it at distance zero.
    fn cast_ray(&self, ray: &Ray, max_distance: f64, filter: &dyn Fn(EntityId) -> bool) -> Option<RayHit>;
}
