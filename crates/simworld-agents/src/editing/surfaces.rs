//! What the pieces of ground in a scene are for, and what covers its land.

use std::ops::ControlFlow;

use simworld_core::asset::Material;
use simworld_core::geometry::{Aabb, Point2, Point3};
use simworld_core::ground::Cover;
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityKind, EntityRef, MATERIAL, Scene};
use simworld_core::value::Value;

use super::land::{Land, leaves_width};
use super::place::is_surface;
use super::solid::Solid;

/// The attribute of a piece of ground that says what it is used as: `park`, `square`, `river` and the like.
const AREA: &str = "area";
/// Ground that lies so much higher or lower than a thing stands is not under it, m.
const DEPTH: f64 = 1.0;

/// A piece of ground with a use.
struct Piece {
    kind: EntityKind,
    land: Land,
    solid: Solid,
}

/// The pieces of ground under a thing, that which counts most first.
pub(super) struct Surfaces(Vec<Piece>);

impl Surfaces {
    /// Those under a thing. Those of `asked` are where it was asked for, and those of `gone` as good as not there; carriageways,
    /// sidewalks and crossings are left to the streets, where the scene `has_streets` there.
    pub(super) fn under(
        scene: &dyn Scene,
        solid: &Solid,
        asked: &[EntityId],
        gone: &[EntityId],
        has_streets: bool,
    ) -> Self {
        let Aabb { min, max } = solid.bounds();
        let region = Aabb {
            min: Point3::new(min.x, min.y, solid.base() - DEPTH),
            max: Point3::new(max.x, max.y, solid.base() + DEPTH),
        };
        let mut pieces = Vec::new();
        let _ = scene.visit(&region, &mut |piece| {
            let is_meant = is_surface(piece.kind) && !(has_streets && piece.kind != EntityKind::Ground);
            if is_meant && !gone.contains(&piece.id) {
                let is_asked = asked.contains(&piece.id);
                let land = if is_asked { Some(Land::Asked) } else { use_of(&piece) };
                let solid = Solid::of(&piece);
                pieces.extend(land.map(|land| Piece { kind: piece.kind, land, solid }));
            }
            ControlFlow::Continue(())
        });
        pieces.sort_by(|a, b| {
            let size = |piece: &Piece| piece.solid.half().x * piece.solid.half().y;
            rank(a.kind).cmp(&rank(b.kind)).then(size(a).total_cmp(&size(b)))
        });
        Self(pieces)
    }

    /// What a point is for, if a piece says so.
    pub(super) fn at(&self, point: Point2) -> Option<Land> {
        self.0.iter().find(|piece| piece.solid.distance_to(point) == 0.0).map(|piece| piece.land)
    }

    /// Whether a thing that stands on sidewalks leaves room to walk past it on each of them.
    pub(super) fn leave_way(&self, thing: &Solid) -> bool {
        self.0.iter().filter(|piece| piece.land == Land::Sidewalk).all(|piece| {
            let half = piece.solid.half();
            let across = |corner| {
                let local = piece.solid.local(corner);
                if half.x >= half.y { local.y } else { local.x }
            };
            leaves_width(half.min(), thing.corners().into_iter().map(across))
        })
    }
}

/// What lies upon what: the smaller of two of a rank lies upon the larger.
const fn rank(kind: EntityKind) -> u8 {
    match kind {
        EntityKind::Crosswalk => 0,
        EntityKind::Sidewalk => 1,
        EntityKind::Road => 2,
        _ => 3,
    }
}

/// What a piece of ground is for, if it is known.
fn use_of(piece: &EntityRef<'_>) -> Option<Land> {
    let said = |key: &str| piece.info.attributes.get(key).and_then(Value::as_str);
    match (said(AREA), piece.kind) {
        (Some("park" | "garden" | "lawn" | "meadow" | "forest"), _) => Some(Land::Green),
        (Some("square"), _) => Some(Land::Paving),
        (Some("parking"), _) => Some(Land::ParkingLot),
        (Some("river" | "lake" | "harbour" | "sea"), _) => Some(Land::Water),
        (_, EntityKind::Road) => Some(Land::Road),
        (_, EntityKind::Sidewalk) => Some(Land::Sidewalk),
        (_, EntityKind::Crosswalk) => Some(Land::Junction),
        _ => match said(MATERIAL).and_then(Material::from_name)? {
            Material::Grass => Some(Land::Green),
            Material::Asphalt
            | Material::Concrete
            | Material::Cobblestone
            | Material::Gravel
            | Material::Stone => Some(Land::Paving),
            _ => None,
        },
    }
}

/// What a point is for by what covers the land there. What is built says nothing: the grid of covers is coarse, and yards are
/// filed under their houses.
pub(super) fn covered(scene: &dyn Scene, point: Point2) -> Option<Land> {
    let cover = scene.ground()?.cover(point);
    let is_green = matches!(cover, Cover::Grass | Cover::Meadow | Cover::Wood | Cover::Crop | Cover::Soil);
    let is_bare = matches!(cover, Cover::Sand | Cover::Rock);
    let of_both = is_green.then_some(Land::Green).or(is_bare.then_some(Land::Bare));
    of_both.or((cover == Cover::Path).then_some(Land::Path))
}

#[cfg(test)]
mod tests {
    use simworld_core::geometry::pose_facing;
    use simworld_core::scene::{EntityDesc, Shape, World};

    use super::*;

    fn put(world: &mut World, kind: EntityKind, size: [f64; 2], key: &str, value: &str) -> EntityId {
        let pose = pose_facing(Point3::new(0.0, 0.0, -0.03), 0.0);
        let desc = EntityDesc::new(kind, pose, Shape::cuboid(size[0], size[1], 0.02));
        world.spawn(desc.with(key, value)).unwrap()
    }

    fn at(world: &World, asked: &[EntityId], has_streets: bool, x: f64) -> Option<Land> {
        let thing = Solid::standing(Shape::cuboid(0.5, 0.5, 1.0), Point3::new(x, 0.0, 0.0), 0.0);
        Surfaces::under(world, &thing, asked, &[], has_streets).at(thing.planar())
    }

    #[test]
    fn the_smaller_piece_lies_upon_the_larger_and_streets_upon_both() {
        let mut world = World::new();
        let park = put(&mut world, EntityKind::Ground, [80.0, 80.0], AREA, "park");
        put(&mut world, EntityKind::Ground, [40.0, 40.0], AREA, "square");
        put(&mut world, EntityKind::Road, [7.0, 200.0], "lanes", "two");
        assert_eq!(at(&world, &[], false, 0.0), Some(Land::Road));
        assert_eq!(at(&world, &[], true, 0.0), Some(Land::Paving), "streets are known by their network");
        assert_eq!(at(&world, &[], false, 10.0), Some(Land::Paving));
        assert_eq!(at(&world, &[], false, 30.0), Some(Land::Green));
        assert_eq!(at(&world, &[park], false, 30.0), Some(Land::Asked));
        assert_eq!(at(&world, &[], false, 60.0), None);
    }

    #[test]
    fn a_plate_is_what_it_is_made_of() {
        for (material, land) in
            [("grass", Some(Land::Green)), ("cobblestone", Some(Land::Paving)), ("ice", None)]
        {
            let mut world = World::new();
            put(&mut world, EntityKind::Ground, [80.0, 80.0], MATERIAL, material);
            assert_eq!(at(&world, &[], false, 0.0), land, "{material}");
        }
    }

    #[test]
    fn on_a_sidewalk_without_streets_a_width_is_kept_too() {
        let mut world = World::new();
        put(&mut world, EntityKind::Sidewalk, [50.0, 3.0], "lit", "yes");
        let leaves_way = |y: f64| {
            let thing = Solid::standing(Shape::cuboid(1.8, 0.6, 0.8), Point3::new(0.0, y, 0.0), 0.0);
            Surfaces::under(&world, &thing, &[], &[], false).leave_way(&thing)
        };
        assert!(leaves_way(-1.1), "2.3 m are left");
        assert!(!leaves_way(0.0), "1.2 m are left on either side");
    }
}
