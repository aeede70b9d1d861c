//! Buildings: walls by use, flat and pitched roofs.

use std::collections::BTreeMap;

use simworld_core::geometry::Point2;
use simworld_core::scene::Place;

use super::city::{GROUND, Material, Node, material};
use super::mesh::{Base, Builder, Mesh};
use crate::City;
use crate::building::{Building, Footprint, RoofKind};

const FLAT: Material = material("flat roof", [0.3, 0.29, 0.28], 0.95);
const TILES: Material = material("pitched roof", [0.36, 0.15, 0.09], 0.9);
/// How far a flat roof lies below the top of its walls, m.
const PARAPET: f64 = 0.5;

pub(super) fn node(builder: &mut Builder<'_>, city: &City) -> Node {
    let mut walls: BTreeMap<Place, Mesh> = BTreeMap::new();
    let (mut flat, mut tiles) = (Mesh::default(), Mesh::default());
    for building in &city.buildings {
        let walls = walls.entry(building.place).or_default();
        // Its threshold is level with the sidewalk.
        builder.stand_on(Base::Level(builder.ground().height(building.access)));
        match (building.roof, &building.footprint) {
            (RoofKind::Flat, Footprint::Stepped { .. }) => stepped(builder, walls, &mut flat, building),
            // A pitched roof over an outline of any form is a subject of its own.
            (RoofKind::Flat, _) | (_, Footprint::Surveyed(_)) => level(builder, walls, &mut flat, building),
            _ => pitched(builder, walls, &mut tiles, building),
        }
    }
    builder.stand_on(Base::Ground);
    let mut parts: Vec<(Material, Mesh)> =
        walls.into_iter().map(|(place, mesh)| (facade(place), mesh)).collect();
    parts.extend([(FLAT, flat), (TILES, tiles)]);
    Node { name: "buildings", parts }
}

fn level(builder: &mut Builder<'_>, walls: &mut Mesh, roofs: &mut Mesh, building: &Building) {
    let (outline, height) = (building.outline(), building.height());
    builder.walls(walls, &outline, GROUND, height);
    let mut courts = building.courtyards();
    for court in &mut courts {
        // The walls round a courtyard look into it.
        court.reverse();
        builder.walls(walls, court, GROUND, height);
    }
    builder.plate(roofs, &outline, &courts, height - PARAPET);
}

/// Boxes that stand in one another.
fn stepped(builder: &mut Builder<'_>, walls: &mut Mesh, roofs: &mut Mesh, building: &Building) {
    for solid in building.solids() {
        let (outline, height) = (solid.footprint(), solid.half_extents.z * 2.0);
        builder.walls(walls, &outline, GROUND, height);
        builder.plate(roofs, &outline, &[], height - PARAPET);
    }
}

/// A roof on each wing.
fn pitched(builder: &mut Builder<'_>, walls: &mut Mesh, roofs: &mut Mesh, building: &Building) {
    for solid in building.solids() {
        let size = solid.half_extents * 2.0;
        let (outline, eaves) = (solid.footprint(), size.z - PARAPET);
        builder.walls(walls, &outline, GROUND, eaves);
        let rise = building.roof.rise(size.y, size.x);
        roof(builder, walls, roofs, &Plan { outline, eaves, ridge: eaves + rise }, building.roof);
    }
}

/// A rectangle to be roofed, counter-clockwise, and the heights of its eaves and its ridge, m.
struct Plan {
    outline: [Point2; 4],
    eaves: f64,
    ridge: f64,
}

fn roof(builder: &mut Builder<'_>, walls: &mut Mesh, roofs: &mut Mesh, on: &Plan, kind: RoofKind) {
    let mut corners = on.outline;
    if (corners[1] - corners[0]).norm() < (corners[2] - corners[1]).norm() {
        corners.rotate_left(1);
    }
    // The ridge runs along a to b.
    let [a, b, c, d] = corners;
    let low = |point: Point2| (point, on.eaves);
    let high = |point: Point2| (point, on.ridge);
    let (begin, end) = (nalgebra::center(&d, &a), nalgebra::center(&b, &c));
    match kind {
        RoofKind::Shed => {
            builder.face(roofs, &[low(a), low(b), high(c), high(d)]);
            builder.face(walls, &[low(c), low(d), high(d), high(c)]);
            builder.face(walls, &[low(b), low(c), high(c)]);
            builder.face(walls, &[low(d), low(a), high(d)]);
        }
        RoofKind::Hip => {
            let inset = (b - a).normalize() * ((c - b).norm() * 0.5);
            let (begin, end) = (begin + inset, end - inset);
            builder.face(roofs, &[low(a), low(b), high(end), high(begin)]);
            builder.face(roofs, &[low(c), low(d), high(begin), high(end)]);
            builder.face(roofs, &[low(b), low(c), high(end)]);
            builder.face(roofs, &[low(d), low(a), high(begin)]);
        }
        RoofKind::Gable | RoofKind::Flat => {
            builder.face(roofs, &[low(a), low(b), high(end), high(begin)]);
            builder.face(roofs, &[low(c), low(d), high(begin), high(end)]);
            builder.face(walls, &[low(b), low(c), high(end)]);
            builder.face(walls, &[low(d), low(a), high(begin)]);
        }
    }
}

fn facade(place: Place) -> Material {
    let color = match place {
        Place::Home => [0.62, 0.5, 0.38],
        Place::Restaurant => [0.55, 0.22, 0.14],
        Place::Store => [0.66, 0.46, 0.16],
        Place::Hospital => [0.78, 0.76, 0.75],
        Place::Museum => [0.5, 0.44, 0.56],
        Place::School => [0.3, 0.42, 0.55],
        Place::Office => [0.36, 0.42, 0.47],
        Place::Factory => [0.3, 0.28, 0.26],
        Place::ChargingStation => [0.18, 0.42, 0.4],
        Place::RestArea => [0.3, 0.42, 0.22],
        _ => [0.5, 0.48, 0.45],
    };
    material(place.as_str(), color, 0.85)
}
