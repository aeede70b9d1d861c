//! What stands in the streets of a place: trees, benches, lamps and the like, from points of the map.

use simworld_core::geometry::{Point2, heading};
use simworld_core::net::{RoadNetwork, Sidewalk};
use simworld_core::scene::{EntityKind, Shape};

use super::error::{OsmId, Warning};
use super::mask::Mask;
use super::place::Place;
use super::tags::{Key, Tags};
use crate::doors::Doors;
use crate::element::Element;
use crate::occupancy::Occupancy;

/// A thing farther than this from every sidewalk looks east, m.
const FARTHEST_STREET: f64 = 60.0;
/// Distance of the trees of a row, m.
const TREE_ROW: f64 = 8.0;
/// Nothing reaches farther from its point, m.
pub(super) const LARGEST: f64 = 3.0;
/// Trees of one row at most.
const MOST_TREES: f64 = 2000.0;

/// The kind and solid of a point, if it is something that stands in streets.
fn thing_of(tags: &Tags<'_>) -> Option<(EntityKind, Shape)> {
    let round = |radius, height| Shape::Cylinder { radius, height };
    let height = || tags.metres(Key::Height).unwrap_or(7.0).clamp(2.0, 60.0);
    let kind = match (tags.get(Key::Natural), tags.get(Key::Amenity), tags.get(Key::Highway)) {
        (Some("tree"), _, _) => (EntityKind::Tree, round(0.18, height())),
        (Some("shrub"), _, _) => (EntityKind::Shrub, Shape::cuboid(0.7, 1.6, 0.9)),
        (_, Some("bench"), _) => (EntityKind::Bench, Shape::cuboid(0.6, 1.8, 0.85)),
        (_, Some("waste_basket" | "recycling"), _) => (EntityKind::TrashBin, round(0.25, 0.9)),
        (_, Some("post_box"), _) => (EntityKind::Mailbox, Shape::cuboid(0.4, 0.5, 1.2)),
        (_, _, Some("street_lamp")) => (EntityKind::StreetLamp, round(0.09, 6.0)),
        (_, _, Some("bus_stop")) => (EntityKind::BusStop, Shape::cuboid(1.4, 4.0, 2.5)),
        (_, _, Some("traffic_sign")) => (EntityKind::Sign, round(0.05, 2.4)),
        _ if tags.is(Key::Emergency, "fire_hydrant") => (EntityKind::Hydrant, round(0.15, 0.8)),
        _ => return None,
    };
    Some(kind)
}

/// Marks the places of all that the map has, and so much round them, m.
pub(super) fn mark(place: &Place, mask: &mut Mask, beside: f64) {
    for (node, tags) in place.raw.tagged_nodes() {
        if let (Some(_), Some(position)) = (thing_of(&tags), place.point(node)) {
            mask.mark(&[position], beside);
        }
    }
    for (_, row) in tree_rows(place) {
        row.windows(2).for_each(|piece| mask.mark(piece, beside));
    }
}

/// The rows of trees: their ways and lines.
fn tree_rows(place: &Place) -> impl Iterator<Item = (i64, Vec<Point2>)> {
    let rows = place.raw.ways().iter().filter(|way| place.raw.way_tags(way).is(Key::Natural, "tree_row"));
    rows.map(|way| (way.id, place.raw.nodes_of(way).iter().filter_map(|node| place.point(*node)).collect()))
}

/// Sets what the map has; what would stand on a carriageway, in a building or in something else is left out.
/// `taken` receives what is set.
pub(super) fn set(
    place: &Place,
    network: &RoadNetwork,
    carriageways: &Occupancy,
    taken: &mut Occupancy,
    warnings: &mut Vec<Warning>,
) -> Vec<Element> {
    let mut mask = Mask::new();
    mark(place, &mut mask, FARTHEST_STREET);
    let is_near = |walk: &Sidewalk| mask.touches_path(&walk.path, 0.0);
    let doors = Doors::of_some(network, FARTHEST_STREET, is_near);
    let mut elements = Vec::new();
    let mut try_to_set = |kind: EntityKind, shape: Shape, position: Point2, element: OsmId| {
        let street = doors.nearest(network, position);
        let facing = street.map_or(0.0, |door| heading(&(door.at - position)));
        let thing = Element { kind, position, facing, shape, along: crate::block::Border::LAND };
        let footprint = thing.obb().footprint();
        if carriageways.is_free(&footprint) && taken.take(&footprint) {
            elements.push(thing);
        } else {
            let what =
                format!("a {kind} stands on a carriageway, in a building or in something else; left out");
            warnings.push(Warning { what, element: Some(element), at: Some(place.geographic(position)) });
        }
    };
    for (node, tags) in place.raw.tagged_nodes() {
        if let (Some((kind, shape)), Some(position)) = (thing_of(&tags), place.point(node)) {
            try_to_set(kind, shape, position, OsmId::Node(place.raw.node_id(node)));
        }
    }
    for (way, line) in tree_rows(place) {
        let length = simworld_core::net::polyline::length(&line);
        let count = (length / TREE_ROW).floor().min(MOST_TREES);
        for index in 0..count as u32 {
            let at = simworld_core::net::polyline::at(&line, (f64::from(index) + 0.5) * TREE_ROW).0;
            let shape = Shape::Cylinder { radius: 0.18, height: 7.0 };
            try_to_set(EntityKind::Tree, shape, at, OsmId::Way(way));
        }
    }
    elements
}
