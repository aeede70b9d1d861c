//! The kinds of elements: their solids, where on a sidewalk they stand, and how often in each zone.

use simworld_core::scene::{EntityKind, Shape};
use simworld_core::seed::StreamRng;

use crate::zoning::Zone;

/// Where an element stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Row {
    /// On the sidewalk, at the kerb.
    Kerb,
    /// Behind the sidewalk.
    Back,
}

/// The solid of an element.
pub(super) fn shape_of(kind: EntityKind, rng: &mut StreamRng) -> Shape {
    match kind {
        EntityKind::Tree => Shape::Cylinder { radius: 0.18, height: rng.uniform(5.0, 9.0) },
        EntityKind::StreetLamp => Shape::Cylinder { radius: 0.09, height: 6.0 },
        EntityKind::Bench => Shape::cuboid(0.6, 1.8, 0.85),
        EntityKind::TrashBin => Shape::Cylinder { radius: 0.25, height: 0.9 },
        EntityKind::Mailbox => Shape::cuboid(0.4, 0.5, 1.2),
        EntityKind::Hydrant => Shape::Cylinder { radius: 0.15, height: 0.8 },
        EntityKind::Sign => Shape::Cylinder { radius: 0.05, height: 2.4 },
        EntityKind::BusStop => Shape::cuboid(1.4, 4.0, 2.5),
        EntityKind::Cone => Shape::Cylinder { radius: 0.18, height: 0.7 },
        EntityKind::Table => Shape::cuboid(0.8, 0.8, 0.75),
        EntityKind::Shrub => Shape::cuboid(0.7, 1.6, 0.9),
        _ => Shape::cuboid(0.5, 0.5, 0.9),
    }
}

/// The kinds of furniture, their rows, and how often each is drawn in a residential, commercial, industrial and civic
/// zone and in a park.
pub(super) const FURNITURE: [(EntityKind, Row, [f64; 5]); 7] = [
    (EntityKind::Bench, Row::Back, [1.5, 2.5, 0.2, 3.0, 5.0]),
    (EntityKind::TrashBin, Row::Kerb, [2.0, 3.5, 1.0, 3.0, 3.0]),
    (EntityKind::Mailbox, Row::Back, [1.2, 0.8, 0.4, 0.5, 0.1]),
    (EntityKind::Hydrant, Row::Kerb, [1.2, 1.0, 1.5, 1.0, 0.5]),
    (EntityKind::Sign, Row::Kerb, [1.5, 2.0, 2.0, 1.5, 0.5]),
    (EntityKind::Cone, Row::Kerb, [0.3, 0.5, 1.5, 0.2, 0.1]),
    (EntityKind::Shrub, Row::Back, [2.5, 0.3, 0.2, 1.0, 1.0]),
];

/// How many trees and how much furniture a zone has, against what is configured.
pub(super) const fn abundance(zone: Zone) -> (f64, f64) {
    match zone {
        Zone::Residential => (1.0, 0.8),
        Zone::Commercial => (0.8, 1.4),
        Zone::Industrial => (0.4, 0.6),
        Zone::Civic => (1.2, 1.1),
        Zone::Park => (1.4, 1.2),
    }
}
