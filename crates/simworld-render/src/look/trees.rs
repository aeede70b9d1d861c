//! Trees: their species by what they are called or by their seed, and what the season leaves of them.

use nalgebra::UnitQuaternion;
use simworld_core::geometry::{Pose, Vector3};
use simworld_core::scene::{EntityRef, Scene};
use simworld_core::value::Value;

use super::{Detail, Look, Part, pick};
use crate::mesh::{CROWN_RADIUS, MeshId};

type Color = [f32; 3];

const LEAVES: [Color; 5] =
    [[0.085, 0.17, 0.045], [0.12, 0.2, 0.05], [0.065, 0.14, 0.05], [0.16, 0.22, 0.055], [0.1, 0.16, 0.065]];
const NEEDLES: [Color; 3] = [[0.03, 0.08, 0.04], [0.045, 0.1, 0.045], [0.04, 0.075, 0.05]];

/// Whether it has lost its leaves: the attribute `season` says winter, or it has the winter colour of its asset, unless that is
/// the green of needles.
fn is_bare(entity: &EntityRef<'_>, scene: &dyn Scene, name: &str) -> bool {
    if name.contains("dead") {
        return true;
    }
    let asset = entity.info.asset.and_then(|id| scene.assets()?.get(id));
    let Some(seasons) = asset.and_then(|asset| asset.seasons) else { return false };
    let [red, green, _] = seasons.winter;
    let told =
        matches!(entity.info.attributes.get("season"), Some(Value::Text(season)) if season == "winter");
    red > green && (told || entity.info.color == Some(seasons.winter))
}

/// A tree as it is drawn at that detail.
pub(super) fn dress(
    entity: &EntityRef<'_>,
    scene: &dyn Scene,
    look: &Look,
    bits: u64,
    detail: Detail,
    parts: &mut Vec<Part>,
) {
    let name = super::asset_name(entity, scene).unwrap_or_default();
    let is = |words: &[&str]| words.iter().any(|word| name.contains(word));
    let [x, y, z] = look.scale;
    // A thin solid is the trunk alone; a wide one holds the crown.
    let crown = if x.max(y) > 0.3 * z { x.max(y) * 0.5 } else { CROWN_RADIUS * z };
    let wide = (crown / CROWN_RADIUS).min(z * 1.4).max(z);
    let evergreen =
        is(&["pine", "spruce", "christmas", "fir", "cypress"]) || name.is_empty() && bits.is_multiple_of(9);
    let mesh = match detail {
        _ if is_bare(entity, scene, name) => {
            if detail == Detail::Near {
                MeshId::Bare
            } else {
                MeshId::CoarseBare
            }
        }
        _ if is(&["palm"]) => MeshId::Palm,
        _ if is(&["cypress", "poplar"]) => {
            if detail == Detail::Far {
                MeshId::FarColumn
            } else {
                MeshId::Column
            }
        }
        _ if evergreen => {
            if detail == Detail::Far {
                MeshId::FarConifer
            } else {
                MeshId::Conifer
            }
        }
        Detail::Far => MeshId::FarCrown,
        _ if is(&["willow"]) => MeshId::Willow,
        Detail::Middle => MeshId::MiddleCrown,
        Detail::Near if is(&["birch"]) || bits.is_multiple_of(4) => MeshId::Slender,
        Detail::Near => MeshId::Broadleaf,
    };
    let ordinary =
        matches!(mesh, MeshId::Broadleaf | MeshId::Slender | MeshId::MiddleCrown | MeshId::FarCrown);
    let leaves = if evergreen { pick(&NEEDLES, bits >> 8) } else { pick(&LEAVES, bits >> 8) };
    let color = entity.info.color.unwrap_or(leaves);
    let unit = if ordinary { wide } else { z };
    // No two stand the same way round.
    let turn =
        UnitQuaternion::from_axis_angle(&Vector3::z_axis(), std::f64::consts::TAU * f64::from(look.seed));
    let place = Pose::from_parts(Vector3::zeros().into(), turn);
    parts.push(Part { look: Look { mesh, unit, color, ..*look }, place });
}
