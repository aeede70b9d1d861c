//! Entities: what is spawned, and what a reader sees.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::{EntityKind, FIELD_OF_VIEW, GAZE, OPEN, Place, Scene, Shape};
use crate::asset::{AffordanceSet, Material};
use crate::geometry::{Aabb, Obb, Point2, Point3, Pose, Rectangle, Twist, planar};
use crate::hash::StateHasher;
use crate::id::{AssetId, EntityId};
use crate::value::Value;

/// The attribute of an entity that names what it is made of, in place of what its asset is made of.
pub const MATERIAL: &str = "material";

/// How one entity hangs on another.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Role {
    /// In the parent's hand.
    Held,
    /// In both of the parent's arms.
    Carried,
    /// Under the parent, who rides it: a scooter hangs on its rider, whose body moves both.
    Ridden,
    /// Sitting on the parent.
    Seated,
    /// Aboard the parent, as its driver or passenger.
    Aboard,
    /// A fixed part of the parent.
    Part,
}

/// The bond of an entity to the one that carries it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Attachment {
    /// Who carries.
    pub parent: EntityId,
    /// In what way.
    pub role: Role,
    /// Parent's body frame from this body frame.
    pub parent_from_body: Pose,
}

/// Whether eyes and cameras see something.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Visibility {
    /// They do.
    #[default]
    Shown,
    /// Nobody sees it, and it throws no shadow; bodies collide with it as before.
    Hidden,
}

/// Whether bodies collide with something.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Solidity {
    /// As [its kind](EntityKind::is_solid) says.
    #[default]
    OfItsKind,
    /// They do, whatever it is.
    Solid,
    /// They pass through it, whatever it is.
    Hollow,
}

/// What an entity is made of, apart from where it is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EntityInfo {
    /// Its solid.
    pub shape: Shape,
    /// The asset it was made from, if any.
    pub asset: Option<AssetId>,
    /// What people call it, such as "St Mary's Hospital".
    pub name: Option<String>,
    /// What it is used for.
    pub place: Option<Place>,
    /// Where one stands to use it (a door, the front of a seat), in its own frame, so that it goes where the thing goes.
    pub access: Option<Point3>,
    /// Surface colour, linear-light sRGB primaries in [0, 1].
    pub color: Option<[f32; 3]>,
    /// Mass, kg; `None` lets physics derive it from the shape.
    pub mass: Option<f64>,
    /// Whether eyes and cameras see it.
    #[serde(default)]
    pub visibility: Visibility,
    /// Whether bodies collide with it.
    #[serde(default)]
    pub solidity: Solidity,
    /// Anything else, by name.
    pub attributes: BTreeMap<String, Value>,
}

/// The recipe of an entity: everything a [`Command::Spawn`](crate::command::Command::Spawn) needs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EntityDesc {
    /// What it is.
    pub kind: EntityKind,
    /// World from body.
    pub pose: Pose,
    /// Velocity at the start.
    pub twist: Twist,
    /// What it is made of.
    pub info: EntityInfo,
    /// The bond to a carrier, if it has one.
    pub attachment: Option<Attachment>,
}

impl EntityDesc {
    /// An entity with a kind, a pose and a shape, and nothing else yet.
    pub fn new(kind: EntityKind, pose: Pose, shape: Shape) -> Self {
        Self { kind, pose, twist: Twist::ZERO, info: EntityInfo::of(shape), attachment: None }
    }

    /// With a name.
    #[must_use]
    pub fn named(mut self, name: impl Into<String>) -> Self {
        self.info.name = Some(name.into());
        self
    }

    /// With a use.
    #[must_use]
    pub fn used_as(mut self, place: Place) -> Self {
        self.info.place = Some(place);
        self
    }

    /// With a point where one stands to use it, world frame, while it stands at the pose it has by now.
    #[must_use]
    pub fn accessed_at(mut self, point: Point3) -> Self {
        self.info.access = Some(self.pose.inverse_transform_point(&point));
        self
    }

    /// With a surface colour, linear-light sRGB primaries in [0, 1].
    #[must_use]
    pub fn colored(mut self, rgb: [f32; 3]) -> Self {
        self.info.color = Some(rgb);
        self
    }

    /// With a mass in kg.
    #[must_use]
    pub fn weighing(mut self, mass: f64) -> Self {
        self.info.mass = Some(mass);
        self
    }

    /// Seen by eyes and cameras, or not.
    #[must_use]
    pub fn seen(mut self, visibility: Visibility) -> Self {
        self.info.visibility = visibility;
        self
    }

    /// Met by bodies, or not.
    #[must_use]
    pub fn met(mut self, solidity: Solidity) -> Self {
        self.info.solidity = solidity;
        self
    }

    /// With an attribute.
    #[must_use]
    pub fn with(mut self, key: impl Into<String>, value: impl Into<Value>) -> Self {
        self.info.attributes.insert(key.into(), value.into());
        self
    }
}

/// One entity as a reader sees it: the state of the last finished step.
#[derive(Clone, Copy, Debug)]
pub struct EntityRef<'a> {
    /// Its handle.
    pub id: EntityId,
    /// What it is.
    pub kind: EntityKind,
    /// World from body.
    pub pose: &'a Pose,
    /// Velocity.
    pub twist: &'a Twist,
    /// The axis-aligned box around it.
    pub bounds: &'a Aabb,
    /// What it is made of.
    pub info: &'a EntityInfo,
    /// The bond to a carrier, if it has one.
    pub attachment: Option<&'a Attachment>,
}

impl EntityRef<'_> {
    /// Where its origin is.
    pub fn position(&self) -> Point3 {
        self.pose.translation.vector.into()
    }

    /// Where its origin is in the plane.
    pub fn planar(&self) -> Point2 {
        planar(self.pose)
    }

    /// The oriented box around it.
    pub fn obb(&self) -> Obb {
        self.info.shape.obb(self.pose)
    }

    /// What it takes of the ground, turned as it is.
    pub fn footprint(&self) -> Rectangle {
        self.obb().rectangle()
    }

    /// Where one stands to use it, world frame: its access point, or its origin.
    pub fn access(&self) -> Point3 {
        self.access_point().unwrap_or_else(|| self.position())
    }

    /// Where one stands to use it, world frame, if it says so.
    pub fn access_point(&self) -> Option<Point3> {
        self.info.access.map(|own| self.pose * own)
    }

    /// Whether bodies collide with things of its kind as it stands: a door only while it is closed.
    pub fn is_solid_by_kind(&self) -> bool {
        self.kind.is_solid() || self.kind == EntityKind::Door && !self.is_open()
    }

    /// Whether bodies collide with it now: as its [`Solidity`] says, or [its kind](Self::is_solid_by_kind).
    pub fn is_solid(&self) -> bool {
        match self.info.solidity {
            Solidity::OfItsKind => self.is_solid_by_kind(),
            Solidity::Solid => true,
            Solidity::Hollow => false,
        }
    }

    /// Whether eyes and cameras see it.
    pub fn is_visible(&self) -> bool {
        self.info.visibility == Visibility::Shown
    }

    /// Whether it is a door, or something with one, that stands open.
    pub fn is_open(&self) -> bool {
        self.info.attributes.get(OPEN) == Some(&Value::Bool(true))
    }

    /// The elevation of the gaze above the horizon, radians in [-π/2, π/2].
    pub fn gaze(&self) -> f64 {
        self.info.attributes.get(GAZE).and_then(Value::as_f64).unwrap_or(0.0)
    }

    /// The horizontal field of view that it focuses on, radians; `None` while it is relaxed.
    pub fn field_of_view(&self) -> Option<f64> {
        self.info.attributes.get(FIELD_OF_VIEW).and_then(Value::as_f64)
    }

    /// Its mass, or that of the asset it was made from, kg; `None` if neither is known.
    pub fn mass(&self, scene: &dyn Scene) -> Option<f64> {
        let of_asset = || scene.assets()?.get(self.info.asset?)?.mass;
        self.info.mass.or_else(of_asset)
    }

    /// What it is made of: what its attribute `material` names, or what its asset is made of; `None` if neither is known.
    pub fn material(&self, scene: &dyn Scene) -> Option<Material> {
        let named = match self.info.attributes.get(MATERIAL) {
            Some(Value::Text(name)) => Material::from_name(name),
            _ => None,
        };
        let of_asset = || scene.assets()?.get(self.info.asset?)?.material;
        named.or_else(of_asset)
    }

    /// What one can do with it: what its asset says, or its kind.
    pub fn affordances(&self, scene: &dyn Scene) -> AffordanceSet {
        let of_asset = || scene.assets()?.get(self.info.asset?)?.affordances;
        of_asset().unwrap_or(AffordanceSet::of_kind(self.kind))
    }

    /// What people call it: its name, or its use, or its kind.
    pub fn label(&self) -> &str {
        match (&self.info.name, self.info.place) {
            (Some(name), _) => name,
            (None, Some(place)) => place.as_str(),
            (None, None) => self.kind.as_str(),
        }
    }

    /// The recipe that would make this entity again.
    pub fn to_desc(&self) -> EntityDesc {
        EntityDesc {
            kind: self.kind,
            pose: *self.pose,
            twist: *self.twist,
            info: self.info.clone(),
            attachment: self.attachment.copied(),
        }
    }

    pub(crate) fn state_hash(&self, hasher: &mut StateHasher) {
        hasher.u64(self.id.into()).u64(self.kind as u64).pose(self.pose).twist(self.twist);
        if let Some(bond) = self.attachment {
            hasher.u64(bond.parent.into()).u64(bond.role as u64).pose(&bond.parent_from_body);
        }
        self.info.state_hash(hasher);
    }
}

impl EntityInfo {
    /// A shape, and nothing else yet.
    pub(super) const fn of(shape: Shape) -> Self {
        Self {
            shape,
            asset: None,
            name: None,
            place: None,
            access: None,
            color: None,
            mass: None,
            visibility: Visibility::Shown,
            solidity: Solidity::OfItsKind,
            attributes: BTreeMap::new(),
        }
    }

    fn state_hash(&self, hasher: &mut StateHasher) {
        self.shape.state_hash(hasher);
        hasher.u64(self.asset.map_or(u64::MAX, |asset| u64::from(asset.0)));
        hasher.str(self.name.as_deref().unwrap_or_default());
        hasher.u64(self.place.map_or(u64::MAX, |place| place as u64));
        if let Some(access) = &self.access {
            hasher.point(access);
        }
        for channel in self.color.iter().flatten() {
            hasher.f64(f64::from(*channel));
        }
        hasher.f64(self.mass.unwrap_or(0.0)).u64(self.attributes.len() as u64);
        for (key, value) in &self.attributes {
            hasher.str(key);
            value.state_hash(hasher);
        }
        // Only what differs from its kind: digests of worlds without such things stay what they were.
        if self.visibility != Visibility::Shown {
            hasher.str("hidden");
        }
        if self.solidity != Solidity::OfItsKind {
            hasher.str("solidity").u64(self.solidity as u64);
        }
    }
}
