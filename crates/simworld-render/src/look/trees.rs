//! Trees: their species by what they are called or by their seed, and what the season leaves of them. What grows shows its own season, or
//! else that of its scene.

use nalgebra::UnitQuaternion;
use simworld_core::asset::{Asset, Season};
use simworld_core::geometry::{Pose, Vector3};
use simworld_core::scene::{EntityRef, Scene};
use simworld_core::value::Value;

use super::{Detail, Look, Part, pick};
use crate::mesh::{CROWN_RADIUS, MeshId};

type Color = [f32; 3];

const LEAVES: [Color; 5] =
    [[0.085, 0.17, 0.045], [0.12, 0.2, 0.05], [0.065, 0.14, 0.05], [0.16, 0.22, 0.055], [0.1, 0.16, 0.065]];
const FRESH: [Color; 3] = [[0.16, 0.3, 0.07], [0.2, 0.32, 0.08], [0.13, 0.26, 0.06]];
const GOLD: [Color; 4] = [[0.4, 0.2, 0.03], [0.5, 0.3, 0.04], [0.42, 0.1, 0.025], [0.3, 0.2, 0.05]];
const TWIGS: [Color; 2] = [[0.14, 0.11, 0.08], [0.17, 0.12, 0.075]];
const NEEDLES: [Color; 3] = [[0.03, 0.08, 0.04], [0.045, 0.1, 0.045], [0.04, 0.075, 0.05]];

/// The season that a plant shows: its attribute `season`, the one in whose colour it was planted, or that of its scene.
fn season_of(entity: &EntityRef<'_>, scene: &dyn Scene) -> Option<Season> {
    let told = match entity.info.attributes.get("season") {
        Some(Value::Text(season)) => Season::from_name(season),
        _ => None,
    };
    told.or_else(|| planted_in(entity, asset_of(entity, scene)?)).or(scene.environment().season)
}

fn asset_of<'a>(entity: &EntityRef<'_>, scene: &'a dyn Scene) -> Option<&'a Asset> {
    scene.assets()?.get(entity.info.asset?)
}

/// The season whose colour it has, unless that is the one that all of its asset have.
fn planted_in(entity: &EntityRef<'_>, asset: &Asset) -> Option<Season> {
    let (seasons, color) = (asset.seasons?, entity.info.color?);
    let is_own = asset.color != Some(color);
    Season::ALL.into_iter().find(|season| is_own && seasons.color(*season) == color)
}

/// The colour that somebody gave to it, or that its asset has in this season; none where nobody says.
fn given_color(entity: &EntityRef<'_>, scene: &dyn Scene, season: Option<Season>) -> Option<Color> {
    let own = entity.info.color;
    let Some(asset) = asset_of(entity, scene) else { return own };
    let is_painted = own.is_some() && own != asset.color && planted_in(entity, asset).is_none();
    let of_season = season.and_then(|season| Some(asset.seasons?.color(season)));
    if is_painted { own } else { of_season.or(own) }
}

/// Leaves of nobody's colour.
fn leaves(season: Option<Season>, bits: u64) -> Color {
    match season {
        Some(Season::Spring) => pick(&FRESH, bits),
        Some(Season::Autumn) => pick(&GOLD, bits),
        Some(Season::Winter) => pick(&TWIGS, bits),
        Some(Season::Summer) | None => pick(&LEAVES, bits),
    }
}

/// The colour of a shrub.
pub(super) fn shrub_color(entity: &EntityRef<'_>, scene: &dyn Scene, bits: u64) -> Color {
    let season = season_of(entity, scene);
    given_color(entity, scene, season).unwrap_or_else(|| leaves(season, bits))
}

/// What is told of a tree by its name and its asset.
struct Species<'a> {
    name: &'a str,
    /// Whether it keeps its needles.
    is_conifer: bool,
    /// Whether it has lost its leaves.
    is_bare: bool,
}

impl<'a> Species<'a> {
    fn of(entity: &EntityRef<'_>, scene: &'a dyn Scene, season: Option<Season>, bits: u64) -> Self {
        let asset = asset_of(entity, scene);
        let name = asset.map_or("", |asset| asset.name.as_str());
        let is = |words: &[&str]| words.iter().any(|word| name.contains(word));
        let is_conifer = is(&["pine", "spruce", "christmas", "fir", "cypress"])
            || name.is_empty() && bits.is_multiple_of(9);
        // Whose colour of winter is green keeps its leaves.
        let falls = match asset.and_then(|asset| asset.seasons) {
            Some(seasons) => seasons.winter[0] > seasons.winter[1],
            None => !is_conifer && !is(&["palm"]),
        };
        let is_bare = is(&["dead"]) || falls && season == Some(Season::Winter);
        Self { name, is_conifer, is_bare }
    }

    fn mesh(&self, bits: u64, detail: Detail) -> MeshId {
        let is = |words: &[&str]| words.iter().any(|word| self.name.contains(word));
        match detail {
            Detail::Near if self.is_bare => MeshId::Bare,
            Detail::Middle if self.is_bare => MeshId::CoarseBare,
            Detail::Far if self.is_bare => MeshId::FarBare,
            _ if is(&["palm"]) => MeshId::Palm,
            Detail::Far if is(&["cypress", "poplar"]) => MeshId::FarColumn,
            _ if is(&["cypress", "poplar"]) => MeshId::Column,
            Detail::Far if self.is_conifer => MeshId::FarConifer,
            _ if self.is_conifer => MeshId::Conifer,
            Detail::Far => MeshId::FarCrown,
            _ if is(&["willow"]) => MeshId::Willow,
            Detail::Middle => MeshId::MiddleCrown,
            Detail::Near if is(&["birch"]) || bits.is_multiple_of(4) => MeshId::Slender,
            Detail::Near => MeshId::Broadleaf,
        }
    }
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
    let season = season_of(entity, scene);
    let species = Species::of(entity, scene, season, bits);
    let [x, y, z] = look.scale;
    // A thin solid is the trunk alone; a wide one holds the crown.
    let crown = if x.max(y) > 0.3 * z { x.max(y) * 0.5 } else { CROWN_RADIUS * z };
    let wide = (crown / CROWN_RADIUS).min(z * 1.4).max(z);
    let mesh = species.mesh(bits, detail);
    let ordinary =
        matches!(mesh, MeshId::Broadleaf | MeshId::Slender | MeshId::MiddleCrown | MeshId::FarCrown);
    let usual = || if species.is_conifer { pick(&NEEDLES, bits >> 8) } else { leaves(season, bits >> 8) };
    let color = given_color(entity, scene, season).unwrap_or_else(usual);
    let unit = if ordinary { wide } else { z };
    // No two stand the same way round.
    let turn =
        UnitQuaternion::from_axis_angle(&Vector3::z_axis(), std::f64::consts::TAU * f64::from(look.seed));
    let place = Pose::from_parts(Vector3::zeros().into(), turn);
    parts.push(Part { look: Look { mesh, unit, color, ..*look }, place });
}
