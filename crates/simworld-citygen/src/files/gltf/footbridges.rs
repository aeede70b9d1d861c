//! Footbridges: decks, stairs step by step, railings, walls and piers. Heights are those of the world.

use simworld_core::geometry::Vector2;
use simworld_core::net::FOOTBRIDGE_DECK;

use super::bridges::{CONCRETE, beam};
use super::city::{Material, Node, PAVING, SIDEWALK, material};
use super::mesh::{Base, Builder, Mesh};
use crate::City;
use crate::decks::Span;
use crate::footbridges::{Flight, footbridges};
use crate::populate::{PIER, RAILING};

const STEEL: Material = material("railing", [0.2, 0.23, 0.24], 0.6);
/// Height of a step, m (Highways England, CD 353).
const STEP: f64 = 0.15;
/// The covering of a deck is so thick, m.
const COVER: f64 = 0.02;

pub(super) fn node(builder: &mut Builder<'_>, city: &City) -> Node {
    let mut meshes: [Mesh; 3] = Default::default();
    let [paving, concrete, steel] = &mut meshes;
    builder.stand_on(Base::Level(0.0));
    for bridge in footbridges(&city.network, builder.ground()) {
        let half = bridge.half;
        for flight in &bridge.flights {
            let sides = (half, -half);
            let foot = underside(flight);
            if flight.is_stairs() {
                for step in steps(&flight.span) {
                    beam(builder, paving, &step, sides, [[SIDEWALK; 2], [SIDEWALK - STEP; 2]]);
                }
                beam(builder, concrete, &flight.span, sides, [[SIDEWALK - STEP; 2], foot]);
            } else {
                beam(builder, paving, &flight.span, sides, [[SIDEWALK; 2], [SIDEWALK - COVER; 2]]);
                beam(builder, concrete, &flight.span, sides, [[SIDEWALK - COVER; 2], foot]);
            }
            if flight.has_railings {
                let (height, width) = RAILING;
                for sides in [(half, half - width), (width - half, -half)] {
                    beam(builder, steel, &flight.span, sides, [[SIDEWALK + height; 2], [SIDEWALK; 2]]);
                }
            }
        }
        for pier in &bridge.piers {
            let across = pier.across * (half * PIER.1);
            let along = Vector2::new(pier.across.y, -pier.across.x) * (PIER.0 * 0.5);
            let outline = [
                pier.at - along - across,
                pier.at + along - across,
                pier.at + along + across,
                pier.at - along + across,
            ];
            builder.walls(concrete, &outline, pier.heights.0 - 0.5, pier.heights.1);
        }
    }
    builder.stand_on(Base::Ground);
    let materials = [PAVING, CONCRETE, STEEL];
    Node { name: "footbridges", parts: materials.into_iter().zip(meshes).collect() }
}

/// The underside of a piece below its walkway at either end, m: that of the deck, or the ground where a wall closes it.
fn underside(flight: &Flight) -> [f64; 2] {
    let span = &flight.span;
    let deck = -FOOTBRIDGE_DECK;
    if flight.has_wall() {
        [0, 1].map(|end| (span.ground[end] - span.heights[end] - 0.5).min(deck))
    } else {
        [deck; 2]
    }
}

/// The steps of a flight, level, from its lower end to its upper.
fn steps(span: &Span) -> impl Iterator<Item = Span> {
    let ([a, b], [low, high]) = (span.ends, span.heights);
    let count = ((high - low).abs() / STEP).round().max(1.0);
    let span = *span;
    (0..count as u32).map(move |step| {
        let [from, to] = [step, step + 1].map(|end| f64::from(end) / count);
        let ends = [a + (b - a) * from, a + (b - a) * to];
        // Each is as high as the way at its upper edge.
        let height = low + (high - low) * if high > low { to } else { from };
        Span { ends, heights: [height; 2], ..span }
    })
}
