//! How far an entity reaches, whatever is drawn of it, and whether it throws shadows.

use std::sync::Arc;

use simworld_core::asset::{Asset, Model};
use simworld_core::scene::{EntityKind, EntityRef, Scene};

use super::Ball;
use crate::look::overhang;
use crate::sources::model_of;

/// The ball around an entity, the same for all its instances: that around the bounds, and what overhangs them; links may reach farther, and so may what a rig moves.
pub(super) fn ball_of(entity: &EntityRef<'_>, scene: &dyn Scene) -> Ball {
    let (center, half) = (entity.bounds.center(), entity.bounds.half_extents().norm());
    let aside = (entity.position() - center).norm();
    let of_links = scene.links(entity.id).map_or(0.0, |links| links.radius() + aside);
    let of_rig = entity
        .info
        .asset
        .and_then(|id| rig_radius(entity, model_of(scene, id)?))
        .map_or(0.0, |far| far + aside);
    Ball { center, radius: (half + overhang(entity.kind)).max(of_links).max(of_rig) }
}

/// How far the rig of its model may lead from the origin of an entity, m, whatever it plays, and on the way from that to anything else.
fn rig_radius(entity: &EntityRef<'_>, (asset, model): (&Asset, &Arc<Model>)) -> Option<f64> {
    let reach = model.rig.as_ref()?.reach();
    let (own, collider) = (entity.info.shape.size(), asset.collider.size());
    Some(reach * own.component_div(&collider).max())
}

/// Whether it throws a shadow that one would miss; surfaces lie flat.
pub(super) fn casts(kind: EntityKind) -> bool {
    !matches!(kind, EntityKind::Ground | EntityKind::Road | EntityKind::Sidewalk | EntityKind::Crosswalk)
}
