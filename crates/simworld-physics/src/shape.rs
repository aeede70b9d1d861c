//! Core's shapes as rapier's colliders, and the mark by which a collider names its entity.
//!
//! Core's shapes stand on their origin; rapier's have it in their middle, and its cylinders lie along y. The
//! collider's place in its body makes up for both, so that a rigid body's frame is the entity's body frame.

use std::f64::consts::{FRAC_1_SQRT_2, PI};

use rapier3d_f64::math::{Pose as RapierPose, Rotation, Vector};
use rapier3d_f64::prelude::{CoefficientCombineRule, Collider, ColliderBuilder, SharedShape};
use simworld_core::asset::Material;
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityRef, Scene, Shape};

/// The mark on a collider that says whose it is: rapier's `user_data`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BodyTag {
    /// The ground, which is no entity.
    Ground,
    /// An entity.
    Entity(EntityId),
}

impl BodyTag {
    /// As rapier stores it.
    pub fn to_user_data(self) -> u128 {
        match self {
            Self::Ground => 0,
            Self::Entity(id) => u128::from(u64::from(id)) + 1,
        }
    }

    /// As rapier stored it.
    pub fn from_user_data(data: u128) -> Self {
        match (data & ((1 << MATERIAL_BITS) - 1)).checked_sub(1) {
            Some(id) => Self::Entity(EntityId::from(id as u64)),
            None => Self::Ground,
        }
    }

    /// The entity, if it is one.
    pub fn entity(self) -> Option<EntityId> {
        match self {
            Self::Ground => None,
            Self::Entity(id) => Some(id),
        }
    }
}

/// Where the material stands in a mark, above what names the entity.
const MATERIAL_BITS: u32 = 96;

/// The mark of whose a collider is, with what it is made of.
pub(crate) fn marked(tag: BodyTag, material: Material) -> u128 {
    tag.to_user_data() | (material as u128) << MATERIAL_BITS
}

/// How many bits it has.
const MATERIAL_LENGTH: u32 = 8;

/// Where the number of a solid stands in a mark, above the material.
const NUMBER_BITS: u32 = MATERIAL_BITS + MATERIAL_LENGTH;

/// A mark with the number of the solid among those of its body.
pub(crate) fn numbered(mark: u128, number: u16) -> u128 {
    mark | u128::from(number) << NUMBER_BITS
}

/// The number of a solid among those of its body, by its mark; 0 for what has none.
pub(crate) fn number_of(data: u128) -> u16 {
    (data >> NUMBER_BITS) as u16
}

/// Set in the mark of somebody on foot.
const WALKER: u128 = 1 << 127;

/// Set in the mark of what rolls on wheels of its own.
const ON_WHEELS: u128 = 1 << 126;

/// The mark of what rolls on wheels of its own.
pub(crate) fn on_wheels(mark: u128) -> u128 {
    mark | ON_WHEELS
}

/// Whether something rolls on wheels of its own, by its mark.
pub(crate) fn is_on_wheels(data: u128) -> bool {
    data & ON_WHEELS != 0
}

/// The mark of somebody on foot.
pub(crate) fn walker_mark(id: EntityId) -> u128 {
    marked(BodyTag::Entity(id), Material::Flesh) | WALKER
}

/// Whether a collider is that of somebody on foot, by its mark.
pub(crate) fn is_walker(data: u128) -> bool {
    data & WALKER != 0
}

/// What a collider is made of, by its mark.
pub(crate) fn material_of(data: u128) -> Material {
    let index = ((data >> MATERIAL_BITS) & ((1 << MATERIAL_LENGTH) - 1)) as usize;
    Material::ALL.get(index).copied().unwrap_or_default()
}

/// What an entity is made of: what it says, what its asset says, or else concrete.
pub(crate) fn material_of_entity(entity: &EntityRef<'_>, scene: &dyn Scene) -> Material {
    entity.material(scene).unwrap_or(Material::Concrete)
}

/// A quarter turn about x: rapier's y, the axis of its cylinders, becomes z.
pub(crate) fn upright() -> Rotation {
    Rotation::from_xyzw(FRAC_1_SQRT_2, 0.0, 0.0, FRAC_1_SQRT_2)
}

/// Where a collider sits in its rigid body's frame.
pub(crate) fn body_from(collider: &Collider) -> RapierPose {
    collider.position_wrt_parent().copied().unwrap_or_default()
}

/// The solid for rapier and where it sits in the body frame, m.
pub fn shape_from(shape: &Shape) -> (SharedShape, RapierPose) {
    let half = shape.size() * 0.5;
    let middle = Vector::new(0.0, 0.0, half.z);
    let level = RapierPose::from_translation(middle);
    match *shape {
        Shape::Cylinder { radius, .. } => {
            (SharedShape::cylinder(half.z, radius), RapierPose::from_parts(middle, upright()))
        }
        Shape::Capsule { radius, .. } => (SharedShape::capsule_z((half.z - radius).max(0.0), radius), level),
        Shape::Sphere { radius } => (SharedShape::ball(radius), level),
        // A shape that core learns later collides as the box around it until it is taught here.
        _ => (SharedShape::cuboid(half.x, half.y, half.z), level),
    }
}

/// Volume of the solid of a shape, m³.
pub(crate) fn volume_of(shape: &Shape) -> f64 {
    let ball = |radius: f64| 4.0 / 3.0 * PI * radius * radius * radius;
    match *shape {
        Shape::Cylinder { radius, height } => PI * radius * radius * height,
        Shape::Capsule { radius, height } => {
            PI * radius * radius * (height - 2.0 * radius).max(0.0) + ball(radius)
        }
        Shape::Sphere { radius } => ball(radius),
        _ => shape.size().product(),
    }
}

/// The collider of an entity's shape, marked as the entity's, with the dry friction of a
/// material, to be hung on a rigid body at the entity's pose.
pub fn collider_for(shape: &Shape, id: EntityId, material: Material) -> ColliderBuilder {
    let (solid, body_from_solid) = shape_from(shape);
    ColliderBuilder::new(solid)
        .position(body_from_solid)
        .friction(material.friction())
        .friction_combine_rule(CoefficientCombineRule::GeometricMean)
        .restitution(material.restitution())
        .user_data(marked(BodyTag::Entity(id), material))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mark_names_its_entity() {
        for id in [EntityId::new(0, 0), EntityId::new(7, 3), EntityId::new(u32::MAX, u32::MAX)] {
            assert_eq!(BodyTag::from_user_data(BodyTag::Entity(id).to_user_data()), BodyTag::Entity(id));
        }
        assert_eq!(BodyTag::from_user_data(0).entity(), None);
        let tag = BodyTag::Entity(EntityId::new(u32::MAX, u32::MAX));
        let mark = marked(tag, Material::Ice);
        assert_eq!((BodyTag::from_user_data(mark), material_of(mark)), (tag, Material::Ice));
        let walker = walker_mark(EntityId::new(u32::MAX, u32::MAX));
        assert_eq!((BodyTag::from_user_data(walker), material_of(walker)), (tag, Material::Flesh));
        assert!(is_walker(walker) && !is_walker(mark));
        let cart = on_wheels(mark);
        assert_eq!((BodyTag::from_user_data(cart), material_of(cart)), (tag, Material::Ice));
        assert!(is_on_wheels(cart) && !is_on_wheels(walker) && !is_walker(cart));
        assert!(Material::ALL.len() < 1 << MATERIAL_LENGTH);
        let last = numbered(mark, u16::MAX);
        assert_eq!((BodyTag::from_user_data(last), material_of(last)), (tag, Material::Ice));
        assert!(number_of(last) == u16::MAX && !is_walker(last) && !is_on_wheels(last));
        assert_eq!((number_of(walker), number_of(cart)), (0, 0));
    }

    #[test]
    fn solids_stand_on_their_origin() {
        let shapes = [
            Shape::cuboid(1.0, 2.0, 3.0),
            Shape::Cylinder { radius: 0.4, height: 3.0 },
            Shape::Capsule { radius: 0.4, height: 3.0 },
            Shape::Sphere { radius: 1.5 },
        ];
        for shape in shapes {
            let (solid, body_from_solid) = shape_from(&shape);
            let aabb = solid.compute_aabb(&body_from_solid);
            assert!(aabb.mins.z.abs() < 1e-12 && (aabb.maxs.z - 3.0).abs() < 1e-12, "{shape:?}: {aabb:?}");
            assert!((aabb.maxs.y - shape.size().y / 2.0).abs() < 1e-12, "{shape:?}: {aabb:?}");
            let volume = solid.mass_properties(1.0).mass();
            assert!((volume_of(&shape) / volume - 1.0).abs() < 1e-9, "{shape:?}: {volume}");
        }
    }
}
