//! Assets with a model, as rapier's compounds of their hulls: made once for an asset and a size, and shared.

use std::collections::BTreeMap;
use std::sync::Arc;

use rapier3d_f64::math::{Pose as RapierPose, Vector};
use rapier3d_f64::prelude::{ColliderBuilder, SharedShape};
use simworld_core::asset::Model;
use simworld_core::geometry::Vector3;
use simworld_core::id::AssetId;
use simworld_core::scene::{EntityRef, Scene};

use crate::shape::{collider_for, material_of_entity};

/// Below this volume a hull is no solid, m³: a cube of a tenth of a millimetre.
const LEAST_VOLUME: f64 = 1e-12;

/// The compounds that were made so far. They follow from the world, so nothing of them is saved.
#[derive(Default)]
pub(crate) struct Solids {
    known: BTreeMap<(AssetId, [u64; 3]), Known>,
}

/// One compound, with the model that it was made from: another world may have another one under the same id.
struct Known {
    model: Arc<Model>,
    /// None where no hull of the model is a solid.
    solid: Option<SharedShape>,
}

impl Solids {
    /// What bodies meet of an entity's model, in its body frame; none if its asset has no model.
    pub(crate) fn of(&mut self, entity: &EntityRef<'_>, scene: &dyn Scene) -> Option<SharedShape> {
        let id = entity.info.asset?;
        let asset = scene.assets()?.get(id)?;
        let model = asset.model.as_ref()?;
        let stretch = entity.info.shape.size().component_div(&asset.collider.size());
        let key = (id, [stretch.x, stretch.y, stretch.z].map(f64::to_bits));
        let known = self.known.get(&key).filter(|known| Arc::ptr_eq(&known.model, model));
        if let Some(known) = known {
            return known.solid.clone();
        }
        let solid = compound(model, &stretch);
        self.known.insert(key, Known { model: Arc::clone(model), solid: solid.clone() });
        solid
    }

    /// The collider of an entity, by its model if it has one, and else by its shape; to be hung on a rigid body at the
    /// entity's pose.
    pub(crate) fn collider(&mut self, entity: &EntityRef<'_>, scene: &dyn Scene) -> ColliderBuilder {
        let collider = collider_for(&entity.info.shape, entity.id, material_of_entity(entity, scene));
        match self.of(entity, scene) {
            Some(solid) => with_solid(collider, solid),
            None => collider,
        }
    }
}

/// A collider with another solid, which stands in the body frame.
pub(crate) fn with_solid(collider: ColliderBuilder, solid: SharedShape) -> ColliderBuilder {
    ColliderBuilder { shape: solid, ..collider }.position(RapierPose::IDENTITY)
}

fn compound(model: &Model, stretch: &Vector3) -> Option<SharedShape> {
    let place = |point: &[f32; 3]| {
        let [x, y, z] = point.map(f64::from);
        Vector::new(x * stretch.x, y * stretch.y, z * stretch.z)
    };
    let solid = |points: Vec<Vector>| {
        let hull = SharedShape::convex_hull(&points)?;
        let volume = hull.mass_properties(1.0).mass();
        (volume > LEAST_VOLUME).then_some((RapierPose::IDENTITY, hull))
    };
    let hulls: Vec<_> =
        model.hulls.iter().filter_map(|hull| solid(hull.points.iter().map(place).collect())).collect();
    (!hulls.is_empty()).then(|| SharedShape::compound(hulls))
}
