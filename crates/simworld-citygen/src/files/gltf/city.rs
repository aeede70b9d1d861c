//! What of a city becomes which mesh.

use std::collections::BTreeMap;

use simworld_core::geometry::Point2;
use simworld_core::id::RoadId;
use simworld_core::net::{Intersection, Lane, Road, polyline};
use simworld_core::scene::{EntityKind, Shape};

use super::mesh::{Base, Builder, Mesh};
use super::{bridges, buildings, footbridges, strips};
use crate::City;
use crate::element::Element;
use crate::lot::GreenKind;
use crate::terrain::Ground;

/// Heights of the surfaces, m: people stand at zero, on the sidewalk. Farther apart than in a world, because viewers
/// see cities from afar and must not mix the layers up.
pub(super) const GROUND: f64 = -0.25;
pub(super) const ROAD: f64 = -0.15;
pub(super) const PAINT: f64 = -0.13;
const BLOCK: f64 = -0.04;
const GREEN: f64 = -0.02;
pub(super) const SIDEWALK: f64 = 0.0;
/// Ground beyond the outermost street, m.
const SURROUND: f64 = 120.0;
/// Width of a plate of hilly ground, m, and how much lower it lies, for it is straight between its corners.
const PLATE: f64 = 30.0;
const PLATE_TOP: f64 = -0.35;
/// Width of a line of paint and of a stop line, m.
pub(super) const LINE: f64 = 0.12;
const STOP_LINE: f64 = 0.4;
/// A dash and the gap behind it, m.
const DASH: (f64, f64) = (3.0, 6.0);
/// A stripe of a crossing and the gap behind it, m.
const STRIPE: (f64, f64) = (0.5, 0.5);

/// A colour, linear, and how rough the surface is.
#[derive(Clone, Copy)]
pub(super) struct Material {
    pub(super) name: &'static str,
    pub(super) color: [f32; 3],
    pub(super) roughness: f32,
}

/// The parts of one node.
pub(super) struct Node {
    pub(super) name: &'static str,
    pub(super) parts: Vec<(Material, Mesh)>,
}

/// A city as meshes about its middle.
pub(super) struct Model {
    pub(super) name: String,
    pub(super) middle: Point2,
    pub(super) nodes: Vec<Node>,
}

pub(super) const fn material(name: &'static str, color: [f32; 3], roughness: f32) -> Material {
    Material { name, color, roughness }
}

const EARTH: Material = material("ground", [0.34, 0.38, 0.24], 1.0);
pub(super) const ASPHALT: Material = material("asphalt", [0.075, 0.077, 0.082], 0.95);
pub(super) const PAVING: Material = material("paving", [0.42, 0.41, 0.39], 0.9);
pub(super) const WHITE: Material = material("paint", [0.82, 0.82, 0.8], 0.7);
const SOIL: Material = material("block", [0.4, 0.37, 0.29], 1.0);
pub(super) const GRASS: Material = material("grass", [0.22, 0.33, 0.13], 1.0);

pub(super) fn model(city: &City) -> Model {
    let (low, high) = city.network.bounds().unwrap_or((Point2::origin(), Point2::origin()));
    let middle = nalgebra::center(&low, &high);
    let land = city.terrain();
    let heights = Ground::new(&city.network, &land);
    let mut builder = Builder::at(middle, &city.network, &heights);
    let nodes = vec![
        ground(&mut builder, city, low, high),
        roads(&mut builder, city),
        bridges::node(&mut builder, city),
        footbridges::node(&mut builder, city),
        sidewalks(&mut builder, city),
        strips::node(&mut builder, city),
        markings(&mut builder, city),
        buildings::node(&mut builder, city),
        elements(&mut builder, city),
    ];
    let name = city.provenance.title.clone().unwrap_or_else(|| format!("City {}", city.provenance.seed.0));
    Model { name, middle, nodes }
}

fn ground(builder: &mut Builder<'_>, city: &City, low: Point2, high: Point2) -> Node {
    let (low, high) = (low.map(|x| x - SURROUND), high.map(|x| x + SURROUND));
    let mut mesh = Mesh::default();
    let is_level = builder.ground().is_level();
    for (low, high) in plates(low, high, is_level) {
        let z = if is_level { GROUND } else { GROUND + PLATE_TOP };
        let corners = [low, Point2::new(high.x, low.y), high, Point2::new(low.x, high.y)];
        builder.plate(&mut mesh, &corners, &[], z);
    }
    let (mut blocks, mut greens) = (Mesh::default(), Mesh::default());
    let land = city.land();
    for block in land.blocks.iter().filter(|block| block.area.is_some()) {
        builder.plate(&mut blocks, &block.outline, &[], BLOCK);
    }
    for green in land.greens.iter().filter(|green| green.kind != GreenKind::Leftover) {
        builder.plate(&mut greens, land.green_outline(green), &[], GREEN);
    }
    Node { name: "ground", parts: vec![(EARTH, mesh), (SOIL, blocks), (GRASS, greens)] }
}

/// The rectangles of the ground, least and greatest corners: one on level ground.
fn plates(low: Point2, high: Point2, is_level: bool) -> Vec<(Point2, Point2)> {
    if is_level {
        return vec![(low, high)];
    }
    let counts = ((high - low) / PLATE).map(|count| count.ceil().max(1.0));
    let step = (high - low).component_div(&counts);
    let corner = |column: u32, row: u32| {
        low + step.component_mul(&simworld_core::geometry::Vector2::new(f64::from(column), f64::from(row)))
    };
    let rows = 0..counts.y as u32;
    rows.flat_map(|row| {
        (0..counts.x as u32).map(move |column| (corner(column, row), corner(column + 1, row + 1)))
    })
    .collect()
}

fn roads(builder: &mut Builder<'_>, city: &City) -> Node {
    let mut mesh = Mesh::default();
    for road in city.network.roads.iter().filter(|road| road.level <= 0) {
        builder.ribbon(&mut mesh, &road.centerline, (road.left_kerb, road.right_kerb), ROAD);
    }
    for intersection in &city.network.intersections {
        stand_at(builder, city, intersection);
        builder.plate(&mut mesh, &intersection.outline, &[], ROAD);
    }
    builder.stand_on(Base::Ground);
    Node { name: "roads", parts: vec![(ASPHALT, mesh)] }
}

/// A junction at the end of a bridge lies at its own height, whatever the ground does.
fn stand_at(builder: &mut Builder<'_>, city: &City, place: &Intersection) {
    let is_bridge = place.roads.iter().any(|road| city.network.roads[road.index()].level > 0);
    builder.stand_on(if is_bridge { Base::Level(place.height) } else { Base::Ground });
}

fn sidewalks(builder: &mut Builder<'_>, city: &City) -> Node {
    let mut mesh = Mesh::default();
    for sidewalk in &city.network.sidewalks {
        builder.stand_on_road(sidewalk.road);
        builder.kerb(&mut mesh, &sidewalk.path, sidewalk.width, (GROUND, SIDEWALK));
    }
    let usual = city.network.sidewalks.first().map_or(0.0, |sidewalk| sidewalk.width);
    for place in &city.network.intersections {
        stand_at(builder, city, place);
        for (rank, corner) in place.corners.iter().enumerate().filter(|(_, corner)| corner.len() > 1) {
            corner_of(builder, &mut mesh, (place.kerb(rank), corner), usual);
        }
    }
    builder.stand_on(Base::Ground);
    Node { name: "sidewalks", parts: vec![(PAVING, mesh)] }
}

/// The pavement of a corner: from the kerb to the outer edge of the walkway round it.
fn corner_of(builder: &mut Builder<'_>, mesh: &mut Mesh, (kerb, walk): (&[Point2], &[Point2]), width: f64) {
    // Seen along the walkway the junction lies on the left, the land on the right. It ends at a crossing, beyond the
    // rounded part of the kerb.
    let (outer, inner) = (polyline::offset(walk, -width * 0.5), polyline::offset(walk, width * 0.5));
    let mut outline = outer;
    outline.extend(inner.last());
    outline.extend(kerb.iter().rev());
    outline.extend(inner.first());
    outline.dedup_by(|a, b| (*a - *b).norm() < 1e-3);
    builder.prism(mesh, &outline, GROUND, SIDEWALK);
}

fn markings(builder: &mut Builder<'_>, city: &City) -> Node {
    let network = &city.network;
    let mut mesh = Mesh::default();
    for crossing in &network.crossings {
        builder.stand_on_road(crossing.road);
        dashes(builder, &mut mesh, &[crossing.start, crossing.end], STRIPE, crossing.width);
    }
    for (index, road) in network.roads.iter().enumerate() {
        builder.stand_on_road(RoadId::from_index(index));
        let lanes = |ids: &[simworld_core::id::LaneId]| -> Vec<&Lane> {
            ids.iter().map(|id| &network.lanes[id.index()]).collect()
        };
        let (forward, backward) = (lanes(&road.forward), lanes(&road.backward));
        if let (Some(lane), false) = (forward.first(), backward.is_empty()) {
            builder.ribbon(&mut mesh, &between_stops(road, lane), (LINE * 0.5, LINE * 0.5), PAINT);
        }
        for lanes in [&forward, &backward] {
            for pair in lanes.windows(2) {
                let edge = polyline::offset(&pair[0].path, -pair[0].width * 0.5);
                dashes(builder, &mut mesh, &edge, DASH, LINE);
            }
            for lane in
                lanes.iter().filter(|lane| !network.intersections[lane.to.index()].crossings.is_empty())
            {
                stop_line(builder, &mut mesh, lane);
            }
        }
    }
    builder.stand_on(Base::Ground);
    Node { name: "markings", parts: vec![(WHITE, mesh)] }
}

/// The centreline from where lanes begin to where they end.
fn between_stops(road: &Road, lane: &Lane) -> Vec<Point2> {
    let station = |point: Option<&Point2>| {
        point.and_then(|point| polyline::closest(&road.centerline, point)).map_or(0.0, |near| near.station)
    };
    polyline::slice(&road.centerline, station(lane.path.first()), station(lane.path.last()))
}

fn stop_line(builder: &mut Builder<'_>, mesh: &mut Mesh, lane: &Lane) {
    let length = polyline::length(&lane.path);
    let last = polyline::slice(&lane.path, length - STOP_LINE, length);
    builder.ribbon(mesh, &last, (lane.width * 0.46, lane.width * 0.46), PAINT);
}

/// Pieces of a line with gaps between.
fn dashes(builder: &mut Builder<'_>, mesh: &mut Mesh, line: &[Point2], (dash, gap): (f64, f64), width: f64) {
    let length = polyline::length(line);
    let count = ((length + gap) / (dash + gap)).floor();
    let start = (length - count * (dash + gap) + gap) * 0.5;
    for index in 0..count as u32 {
        let from = start + f64::from(index) * (dash + gap);
        let piece = polyline::slice(line, from, from + dash);
        if let [first, .., last] = piece.as_slice() {
            builder.stripe(mesh, *first, *last, width, PAINT);
        }
    }
}

fn elements(builder: &mut Builder<'_>, city: &City) -> Node {
    let mut crowns = Mesh::default();
    let mut solids: BTreeMap<EntityKind, Mesh> = BTreeMap::new();
    for element in &city.elements {
        let mesh = solids.entry(element.kind).or_default();
        builder.stand_on(Base::Level(builder.ground().height(element.position)));
        match element.kind {
            EntityKind::Tree => tree(builder, mesh, &mut crowns, element),
            _ => solid(builder, mesh, element),
        }
    }
    let mut parts: Vec<(Material, Mesh)> =
        solids.into_iter().map(|(kind, mesh)| (substance(kind), mesh)).collect();
    parts.push((material("leaves", [0.12, 0.24, 0.07], 1.0), crowns));
    Node { name: "elements", parts }
}

fn tree(builder: &mut Builder<'_>, trunk: &mut Mesh, crowns: &mut Mesh, element: &Element) {
    let Shape::Cylinder { radius, height } = element.shape else {
        return solid(builder, trunk, element);
    };
    builder.column(trunk, element.position, radius, (GROUND, height * 0.5));
    builder.crown(crowns, element.position, height * 0.3, (height * 0.35, height));
}

fn solid(builder: &mut Builder<'_>, mesh: &mut Mesh, element: &Element) {
    let height = element.shape.size().z;
    match element.shape {
        Shape::Cylinder { radius, .. } => builder.column(mesh, element.position, radius, (GROUND, height)),
        _ => builder.prism(mesh, &element.obb().footprint(), GROUND, height),
    }
}

fn substance(kind: EntityKind) -> Material {
    let (color, roughness) = match kind {
        EntityKind::Tree => ([0.16, 0.1, 0.06], 1.0),
        EntityKind::StreetLamp | EntityKind::Sign => ([0.2, 0.21, 0.22], 0.5),
        EntityKind::Bench | EntityKind::Table | EntityKind::Chair => ([0.33, 0.2, 0.1], 0.8),
        EntityKind::Hydrant => ([0.55, 0.05, 0.03], 0.5),
        EntityKind::Cone => ([0.85, 0.25, 0.03], 0.7),
        EntityKind::Mailbox => ([0.05, 0.12, 0.4], 0.5),
        EntityKind::TrashBin => ([0.08, 0.16, 0.1], 0.7),
        EntityKind::BusStop => ([0.35, 0.45, 0.5], 0.3),
        EntityKind::Car => ([0.3, 0.32, 0.36], 0.4),
        _ => ([0.4, 0.4, 0.4], 0.8),
    };
    material(kind.as_str(), color, roughness)
}
