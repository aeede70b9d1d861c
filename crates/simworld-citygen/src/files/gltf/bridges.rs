//! Bridges: decks with their carriageways, parapets, abutments and piers. Heights are those of the world.

use simworld_core::geometry::{Point2, Vector2};

use super::city::{ASPHALT, Material, Node, ROAD, SIDEWALK, material};
use super::mesh::{Base, Builder, Mesh};
use crate::City;
use crate::decks::{Span, bridges};
use crate::terrain::DECK;

pub(super) const CONCRETE: Material = material("concrete", [0.36, 0.355, 0.34], 0.9);
/// Height of a parapet above the sidewalk and its thickness, m, as in a world.
const PARAPET: (f64, f64) = (1.07, 0.3);
/// Thickness of a pier along the bridge, m, and its share of the width of the deck.
const PIER: (f64, f64) = (1.2, 0.6);

pub(super) fn node(builder: &mut Builder<'_>, city: &City) -> Node {
    let (mut asphalt, mut concrete) = (Mesh::default(), Mesh::default());
    builder.stand_on(Base::Level(0.0));
    for bridge in bridges(&city.network, builder.ground()) {
        let (left, right) = bridge.sides;
        for span in &bridge.spans {
            let road = &city.network.roads[bridge.road.index()];
            let lanes = (road.left_kerb, -road.right_kerb);
            beam(builder, &mut asphalt, span, lanes, [[ROAD + 0.01; 2], [ROAD; 2]]);
            let foot = if span.is_on_ground() {
                [0, 1].map(|end| (span.ground[end] - span.heights[end] - 0.5).min(-DECK))
            } else {
                [-DECK; 2]
            };
            if span.is_raised() {
                beam(builder, &mut concrete, span, (left, -right), [[ROAD - 0.005; 2], foot]);
            }
            if span.is_carried() {
                let (height, width) = PARAPET;
                for sides in [(left, left - width), (width - right, -right)] {
                    beam(builder, &mut concrete, span, sides, [[SIDEWALK + height; 2], [ROAD; 2]]);
                }
            }
        }
        for pier in &bridge.piers {
            let half = pier.across * ((left + right) * 0.5 * PIER.1);
            let middle = pier.at + pier.across * ((left - right) * 0.5);
            let along = Vector2::new(pier.across.y, -pier.across.x) * (PIER.0 * 0.5);
            let outline =
                [middle - along - half, middle + along - half, middle + along + half, middle - along + half];
            builder.walls(&mut concrete, &outline, pier.heights.0 - 0.5, pier.heights.1);
        }
    }
    builder.stand_on(Base::Ground);
    Node { name: "bridges", parts: vec![(ASPHALT, asphalt), (CONCRETE, concrete)] }
}

/// A beam along a span between two distances to the left of the centreline, from its top down to its foot, both above the
/// carriageway at either end of the span, m.
pub(super) fn beam(
    builder: &mut Builder<'_>,
    mesh: &mut Mesh,
    span: &Span,
    (left, right): (f64, f64),
    [top, foot]: [[f64; 2]; 2],
) {
    let [a, b] = span.ends;
    let along = (b - a).normalize();
    let across = Vector2::new(-along.y, along.x);
    let corner = |end: usize, side: f64, above: [f64; 2]| -> (Point2, f64) {
        ([a, b][end] + across * side, span.heights[end] + above[end])
    };
    let ring = |above| {
        [corner(0, right, above), corner(1, right, above), corner(1, left, above), corner(0, left, above)]
    };
    let (top, foot) = (ring(top), ring(foot));
    builder.face(mesh, &top);
    builder.face(mesh, &[foot[3], foot[2], foot[1], foot[0]]);
    for (one, next) in [(0, 1), (1, 2), (2, 3), (3, 0)] {
        builder.face(mesh, &[foot[one], foot[next], top[next], top[one]]);
    }
}
