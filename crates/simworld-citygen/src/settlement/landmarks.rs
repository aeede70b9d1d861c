//! Landmarks: single buildings of the library that stand where houses would.

use simworld_core::asset::Asset;
use simworld_core::geometry::{Obb, Point2, Point3, Vector2, Vector3, pose_facing};
use simworld_core::id::AssetId;
use simworld_core::scene::{EntityDesc, EntityKind, Shape};

use super::areas::GROUND;
use crate::landscape::scaled;
use crate::populate::MARGIN;

/// Ground goes on so far around a landmark that stands outside, m, and is so thick, m.
const BORDER: f64 = 15.0;
const LAYER: f64 = 0.05;

/// A building of the library that was asked for by its name.
#[derive(Clone, Debug, PartialEq)]
pub struct Landmark {
    /// The asset of the library.
    pub asset: String,
    /// What it is called.
    pub name: String,
    /// Its middle, m.
    pub middle: Point2,
    /// Direction in which its front looks, radians from east.
    pub facing: f64,
    /// How large it is beside its asset.
    pub scale: f64,
    /// Where one stands to use it, on the sidewalk before it, m.
    pub access: Option<Point2>,
}

impl Landmark {
    /// As an entity made from its asset, which has that id in the world.
    pub(super) fn desc(&self, asset: &Asset, id: AssetId) -> EntityDesc {
        let pose = pose_facing(Point3::new(self.middle.x, self.middle.y, 0.0), self.facing);
        let mut desc = asset.at(id, pose).named(self.name.as_str());
        desc.info.shape = scaled(&desc.info.shape, self.scale);
        match self.access {
            Some(point) => desc.accessed_at(Point3::new(point.x, point.y, 0.0)),
            None => desc,
        }
    }

    /// The ground under it as an entity, where that of the city ends before, whose streets lie between two corners.
    pub(super) fn ground(&self, asset: &Asset, streets: Option<(Point2, Point2)>) -> Option<EntityDesc> {
        let (low, high) = streets?;
        let margin = Vector2::repeat(MARGIN);
        let size = asset.footprint() * self.scale;
        if lies_within(&ground_box(self.middle, self.facing, size), low - margin, high + margin) {
            return None;
        }
        let pose = pose_facing(Point3::new(self.middle.x, self.middle.y, GROUND - LAYER), self.facing);
        let shape = Shape::cuboid(size.x + 2.0 * BORDER, size.y + 2.0 * BORDER, LAYER);
        Some(EntityDesc::new(EntityKind::Ground, pose, shape))
    }
}

/// "Cathedral", "Cathedral 2".
pub(super) fn name_of(asset: &str, rank: u32) -> String {
    let mut word = asset.replace('_', " ");
    if let Some(first) = word.get_mut(..1) {
        first.make_ascii_uppercase();
    }
    if rank == 0 { word } else { format!("{word} {}", rank + 1) }
}

/// A box on the ground.
pub(super) fn ground_box(middle: Point2, facing: f64, size: Vector2) -> Obb {
    let pose = pose_facing(Point3::new(middle.x, middle.y, 0.0), facing);
    Obb { pose, half_extents: Vector3::new(size.x * 0.5, size.y * 0.5, 1.0) }
}

/// Whether a box on the ground lies in the rectangle between two corners.
pub(super) fn lies_within(taken: &Obb, low: Point2, high: Point2) -> bool {
    let is_within = |at: Point2| low.x <= at.x && at.x <= high.x && low.y <= at.y && at.y <= high.y;
    taken.footprint().into_iter().all(is_within)
}
