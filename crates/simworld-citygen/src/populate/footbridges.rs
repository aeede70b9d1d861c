//! Footbridges as entities: decks and stairs that one walks on, railings, walls and piers. Stairs are inclined slabs.

use simworld_core::geometry::Vector2;
use simworld_core::net::FOOTBRIDGE_DECK;
use simworld_core::scene::{EntityDesc, EntityKind};

use super::bridges::{beam, upright};
use super::{GROUND_TOP, LAYER, Parts, SIDEWALK_TOP};
use crate::decks::Pier;
use crate::footbridges::{Flight, footbridges};
use crate::strips::strip;

/// Height of a railing above the deck, m: 42 inches (AASHTO LRFD Bridge Design Specifications 2012, 13.8), and its thickness.
pub(crate) const RAILING: (f64, f64) = (1.07, 0.08);
/// Thickness of a pier along the bridge, m, and its share of the width of the deck.
pub(crate) const PIER: (f64, f64) = (0.6, 0.5);
/// A wall stands so far within the edges of the deck above it, m.
const INSET: f64 = 0.05;

impl Parts<'_> {
    pub(super) fn footbridges(&self, descs: &mut Vec<EntityDesc>) {
        let all = footbridges(self.network, self.heights);
        for bridge in all.iter().filter(|bridge| self.has_footpath(bridge.way)) {
            bridge.flights.iter().for_each(|flight| add(flight, bridge.half, descs));
            descs.extend(bridge.piers.iter().map(|pier| column(pier, bridge.half)));
        }
    }
}

/// A piece of a footbridge.
fn add(flight: &Flight, half: f64, descs: &mut Vec<EntityDesc>) {
    let mut add = |kind, sides, top, thickness| {
        descs.push(beam(kind, &flight.span, sides, (top, thickness)));
    };
    add(EntityKind::Sidewalk, (half, -half), SIDEWALK_TOP, LAYER);
    // Surfaces are flat: it is the deck below that bears.
    add(EntityKind::Prop, (half, -half), GROUND_TOP, FOOTBRIDGE_DECK);
    if flight.has_railings {
        let (height, width) = RAILING;
        add(EntityKind::Prop, (half, half - width), SIDEWALK_TOP + height, height);
        add(EntityKind::Prop, (width - half, -half), SIDEWALK_TOP + height, height);
    }
    if flight.has_wall() {
        // Upright, from the ground to the lower end of the deck.
        let ([a, b], heights, ground) = (flight.span.ends, flight.span.heights, flight.span.ground);
        let (foot, top) = (ground[0].min(ground[1]), heights[0].min(heights[1]) - FOOTBRIDGE_DECK);
        let box_ = strip(a, b, half - INSET, half - INSET, 0.0);
        descs.extend((top - foot > INSET).then(|| upright(&box_, (foot, top))));
    }
}

fn column(pier: &Pier, half: f64) -> EntityDesc {
    let along = Vector2::new(pier.across.y, -pier.across.x) * (PIER.0 * 0.5);
    let box_ = strip(pier.at - along, pier.at + along, half * PIER.1, half * PIER.1, 0.0);
    upright(&box_, pier.heights)
}
