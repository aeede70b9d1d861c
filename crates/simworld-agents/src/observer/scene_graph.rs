//! The scene as an agent may know it: things around with kind, label, bearing and distance, and who holds what.

use std::ops::ControlFlow;

use serde::{Deserialize, Serialize};
use simworld_core::geometry::{Aabb, Point2, Vector2, direction, heading, yaw_of};
use simworld_core::id::EntityId;
use simworld_core::ops::{cos, wrap_angle};
use simworld_core::scene::{EntityKind, EntityRef, OPEN, Role, Scene};
use simworld_core::seam::{ObserveError, Observer};

use super::gps::{GpsFix, GpsObserver};
use super::nearest::{Nearest, planar_gap};
use super::screens::Screens;
use crate::executor::{eyes, hides, looked_at};

/// One thing in sight.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Sighting {
    /// Which.
    pub id: EntityId,
    /// What it is.
    pub kind: EntityKind,
    /// What people call it.
    pub label: String,
    /// Distance in the plane to its footprint, m.
    pub distance: f64,
    /// Direction of its middle, radians to the left of where one looks.
    pub bearing: f64,
    /// Speed over ground, m/s.
    pub speed: f64,
    /// What it hangs on, and how.
    pub bond: Option<(EntityId, Role)>,
    /// Whether it stands open, if it is a door or was opened and closed.
    pub is_open: Option<bool>,
    /// How far above the horizon it looks, radians; zero for what has no eyes.
    pub gaze: f64,
}

/// The agent itself, as it knows of itself.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Oneself {
    /// Where the receiver says it is.
    pub fix: GpsFix,
    /// What it hangs on, and how: the chair it sits on, the car it is in.
    pub on: Option<(EntityId, Role)>,
    /// What hangs on it, and how: what it holds, the scooter it rides; ascending.
    pub with: Vec<(EntityId, Role)>,
}

/// What is around, nearest first, and how the agent itself is.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SceneGraph {
    /// The agent.
    pub oneself: Oneself,
    /// The things in sight; of two at the same distance the lower id comes first.
    pub sightings: Vec<Sighting>,
    /// What became of what it did, what it was told, and what those in sight did, the oldest first; see
    /// [`hear`](Self::hear).
    pub feedback: Vec<String>,
}

/// Sees what is within a radius and a field of view; flat surfaces are left out.
#[derive(Clone, Debug)]
pub struct SceneGraphObserver {
    radius: f64,
    field_of_view: f64,
    most: usize,
    through: bool,
    gps: GpsObserver,
    /// What hides things and what is seen, kept from one observation to the next for their memory alone.
    screens: Screens,
    nearest: Nearest,
}

impl SceneGraphObserver {
    /// Sees all round and through walls, within `radius` m, the 64 nearest things; knows exactly where it is.
    pub fn new(radius: f64) -> Self {
        Self {
            radius,
            field_of_view: std::f64::consts::TAU,
            most: 64,
            through: true,
            gps: GpsObserver::exact(),
            screens: Screens::default(),
            nearest: Nearest::default(),
        }
    }

    /// With a field of view, radians across.
    #[must_use]
    pub fn with_field_of_view(mut self, radians: f64) -> Self {
        self.field_of_view = radians;
        self
    }

    /// With at most that many things, the nearest.
    #[must_use]
    pub fn with_most(mut self, most: usize) -> Self {
        self.most = most;
        self
    }

    /// Sees only what no building, vehicle or shelter hides from the eyes.
    #[must_use]
    pub fn with_occlusion(mut self) -> Self {
        self.through = false;
        self
    }

    /// With a receiver whose fix it takes for its own position. What it sees it sees from where it really is.
    #[must_use]
    pub fn with_gps(mut self, gps: GpsObserver) -> Self {
        self.gps = gps;
        self
    }
}

impl Observer for SceneGraphObserver {
    type Observation = SceneGraph;

    fn observe(
        &mut self,
        scene: &dyn Scene,
        who: EntityId,
        out: &mut SceneGraph,
    ) -> Result<(), ObserveError> {
        let me = scene.entity(who).ok_or(ObserveError::Missing { id: who })?;
        self.gps.observe(scene, who, &mut out.oneself.fix)?;
        out.oneself.on = me.attachment.map(|bond| (bond.parent, bond.role));
        out.oneself.with.clear();
        scene.visit_attached(who, &mut |load| {
            out.oneself.with.extend(load.attachment.map(|bond| (load.id, bond.role)));
        });
        out.oneself.with.sort_unstable();
        out.feedback.clear();
        let view = View::new(&me, self.field_of_view);
        self.look(scene, &me, &view);
        let mut spare = std::mem::take(&mut out.sightings);
        let mut kept = 0;
        while kept < self.most
            && let Some((distance, id)) = self.nearest.next(scene, me.planar(), self.radius)
        {
            let Some(entity) = scene.entity(id) else { continue };
            if !self.through && self.is_hidden(&me, &entity) {
                continue;
            }
            let bearing = view.bearing(&entity);
            match spare.get_mut(kept) {
                Some(place) => place.set(&entity, distance, bearing),
                None => spare.push(Sighting::of(&entity, distance, bearing)),
            }
            kept += 1;
        }
        spare.truncate(kept);
        out.sightings = spare;
        Ok(())
    }
}

impl SceneGraphObserver {
    /// Gathers what is near and within the field of view, and what could hide it, by the boxes around them alone.
    fn look(&mut self, scene: &dyn Scene, me: &EntityRef<'_>, view: &View) {
        let (here, through) = (me.planar(), self.through);
        let Self { nearest, screens, radius, .. } = self;
        nearest.clear();
        screens.clear();
        let _ = scene.visit(&Aabb::column_around(here, *radius), &mut |entity| {
            if entity.id == me.id || !is_thing(entity.kind) {
                return ControlFlow::Continue(());
            }
            if !through && hides(&entity) && entity.is_visible() && planar_gap(&entity, here) <= *radius {
                screens.push(&entity, here);
            }
            if view.holds(&entity) {
                nearest.push(&entity, here);
            }
            ControlFlow::Continue(())
        });
        screens.sort();
    }

    /// Whether something large stands between the eyes and the middle of a thing, and the eyes and its top.
    fn is_hidden(&self, me: &EntityRef<'_>, other: &EntityRef<'_>) -> bool {
        if other.attachment.is_some_and(|bond| bond.parent == me.id) {
            return false;
        }
        let eye = eyes(me);
        let (middle, top) = looked_at(other, eye.xy());
        let carrier = me.attachment.map(|bond| bond.parent);
        self.screens.hide(&eye, [middle, top], [Some(other.id), carrier])
    }
}

/// The field of view; an angle is worked out only for what is near its edge.
struct View {
    from: Point2,
    yaw: f64,
    half: f64,
    edge: f64,
    ahead: Vector2,
}

impl View {
    fn new(me: &EntityRef<'_>, across: f64) -> Self {
        let (half, yaw) = (across * 0.5, yaw_of(me.pose));
        let edge = if half < std::f64::consts::PI { cos(half.max(0.0)) } else { -2.0 };
        Self { from: me.planar(), yaw, half, edge, ahead: direction(yaw) }
    }

    fn holds(&self, other: &EntityRef<'_>) -> bool {
        /// The cosine of an angle so near to the edge may be on the wrong side of it.
        const CLOSE: f64 = 1e-9;
        let offset = other.bounds.center().xy() - self.from;
        let length = offset.norm();
        let beyond = offset.dot(&self.ahead) - self.edge * length;
        if beyond.abs() > CLOSE * length { beyond > 0.0 } else { self.bearing(other).abs() <= self.half }
    }

    /// The direction of the middle of a thing, radians to the left of where one looks.
    fn bearing(&self, other: &EntityRef<'_>) -> f64 {
        let offset = other.bounds.center().xy() - self.from;
        if offset.norm() < 1e-9 { 0.0 } else { wrap_angle(heading(&offset) - self.yaw) }
    }
}

/// Surfaces are where things stand, not things.
const fn is_thing(kind: EntityKind) -> bool {
    !matches!(kind, EntityKind::Ground | EntityKind::Road | EntityKind::Sidewalk | EntityKind::Crosswalk)
}

/// Whether a door stands open; `None` of what has none that was ever turned.
fn leaf(entity: &EntityRef<'_>) -> Option<bool> {
    let may_turn = matches!(entity.kind, EntityKind::Door | EntityKind::Building);
    let is_turned = || entity.kind == EntityKind::Door || entity.info.attributes.contains_key(OPEN);
    (may_turn && is_turned()).then(|| entity.is_open())
}

fn gaze(entity: &EntityRef<'_>) -> f64 {
    if matches!(entity.kind, EntityKind::Person | EntityKind::Dog | EntityKind::Robot) {
        entity.gaze()
    } else {
        0.0
    }
}

impl Sighting {
    fn of(entity: &EntityRef<'_>, distance: f64, bearing: f64) -> Self {
        Self {
            id: entity.id,
            kind: entity.kind,
            label: entity.label().to_owned(),
            distance,
            bearing,
            speed: entity.twist.ground_speed(),
            bond: entity.attachment.map(|bond| (bond.parent, bond.role)),
            is_open: leaf(entity),
            gaze: gaze(entity),
        }
    }

    /// Becomes another sighting in place, without allocating anew.
    fn set(&mut self, entity: &EntityRef<'_>, distance: f64, bearing: f64) {
        let mut label = std::mem::take(&mut self.label);
        label.clear();
        label.push_str(entity.label());
        *self = Self {
            id: entity.id,
            kind: entity.kind,
            label,
            distance,
            bearing,
            speed: entity.twist.ground_speed(),
            bond: entity.attachment.map(|bond| (bond.parent, bond.role)),
            is_open: leaf(entity),
            gaze: gaze(entity),
        };
    }
}
