//! Street elements: trees and lamps on the kerb side of the sidewalk, furniture on its building side.
//!
//! The middle of the sidewalk stays free: kerb-side elements stand within 0.6 m of the kerb, building-side ones behind
//! the sidewalk, and none near a corner or a crossing.

use serde::{Deserialize, Serialize};
use simworld_core::geometry::{Obb, Point2, Point3, Vector2, pose_facing};
use simworld_core::net::{RoadNetwork, Side, Sidewalk, polyline};
use simworld_core::ops;
use simworld_core::scene::{EntityKind, Shape};
use simworld_core::seed::{Seed, StreamRng};

use crate::ElementConfig;
use crate::occupancy::Occupancy;

/// Distance kept from the ends of a sidewalk, where people turn and cross, m.
const CORNER_CLEARANCE: f64 = 5.0;
/// Distance of the middle of a kerb-side element from the kerb, m.
const KERB_DISTANCE: f64 = 0.35;
/// Gap between the sidewalk and a building-side element, m.
const BACK_GAP: f64 = 0.15;

/// A thing that stands in the street.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Element {
    /// What it is.
    pub kind: EntityKind,
    /// Where it stands, m.
    pub position: Point2,
    /// Where it looks, radians: the street.
    pub facing: f64,
    /// Its solid; a tree's is its trunk.
    pub shape: Shape,
}

impl Element {
    /// Its solid as an oriented box.
    pub fn obb(&self) -> Obb {
        self.shape.obb(&pose_facing(Point3::new(self.position.x, self.position.y, 0.0), self.facing))
    }
}

/// Where an element stands on its sidewalk.
#[derive(Clone, Copy, PartialEq)]
enum Zone {
    Kerb,
    Building,
}

/// The kinds of furniture with their zones and how often each is drawn.
const FURNITURE: [(EntityKind, Zone, f64); 9] = [
    (EntityKind::Bench, Zone::Building, 3.0),
    (EntityKind::TrashBin, Zone::Kerb, 3.0),
    (EntityKind::Mailbox, Zone::Building, 1.0),
    (EntityKind::Hydrant, Zone::Kerb, 1.0),
    (EntityKind::Sign, Zone::Kerb, 2.0),
    (EntityKind::BusStop, Zone::Building, 0.4),
    (EntityKind::Cone, Zone::Kerb, 0.5),
    (EntityKind::Table, Zone::Building, 0.8),
    (EntityKind::Chair, Zone::Building, 1.5),
];

fn shape_of(kind: EntityKind, rng: &mut StreamRng) -> Shape {
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
        _ => Shape::cuboid(0.5, 0.5, 0.9),
    }
}

/// Sets elements along every sidewalk; `taken` holds the buildings and receives the building-side elements.
pub(crate) fn furnish(
    network: &RoadNetwork,
    config: &ElementConfig,
    seed: Seed,
    taken: &mut Occupancy,
) -> Vec<Element> {
    let streams = seed.stream("citygen/elements");
    let mut elements = Vec::new();
    // Kerb-side elements stand on road land, so they are tested among themselves and against buildings by place.
    let mut kerb = Occupancy::default();
    for (index, sidewalk) in network.sidewalks.iter().enumerate() {
        let mut rng = streams.indexed(index as u64).rng();
        let walk = Walk { sidewalk, length: polyline::length(&sidewalk.path) };
        walk.line_up(EntityKind::StreetLamp, config.lamps, &mut rng, &mut kerb, &mut elements);
        walk.line_up(EntityKind::Tree, config.trees, &mut rng, &mut kerb, &mut elements);
        let weights = FURNITURE.map(|(_, _, weight)| weight);
        for _ in 0..count(walk.usable() * config.furniture, &mut rng) {
            let (kind, zone, _) = FURNITURE[rng.weighted(&weights).unwrap_or(0)];
            let station = CORNER_CLEARANCE + rng.unit() * walk.usable();
            let element = walk.element(kind, zone, station, &mut rng);
            let land = if zone == Zone::Kerb { &mut kerb } else { &mut *taken };
            add_if_free(element, land, &mut elements);
        }
    }
    elements
}

/// A whole number with that mean.
fn count(mean: f64, rng: &mut StreamRng) -> u64 {
    (mean + rng.unit()).floor() as u64
}

fn add_if_free(element: Element, land: &mut Occupancy, elements: &mut Vec<Element>) {
    let obb = element.obb();
    if land.is_free_box(&obb) {
        land.add_box(&obb);
        elements.push(element);
    }
}

struct Walk<'a> {
    sidewalk: &'a Sidewalk,
    length: f64,
}

impl Walk<'_> {
    fn usable(&self) -> f64 {
        (self.length - 2.0 * CORNER_CLEARANCE).max(0.0)
    }

    /// Sets elements of one kind along the kerb at even distances.
    fn line_up(
        &self,
        kind: EntityKind,
        density: f64,
        rng: &mut StreamRng,
        land: &mut Occupancy,
        elements: &mut Vec<Element>,
    ) {
        let number = count(self.usable() * density, rng);
        for rank in 0..number {
            let share = (rank as f64 + 0.5) / number as f64;
            let station = CORNER_CLEARANCE + share * self.usable();
            add_if_free(self.element(kind, Zone::Kerb, station, rng), land, elements);
        }
    }

    fn element(&self, kind: EntityKind, zone: Zone, station: f64, rng: &mut StreamRng) -> Element {
        let shape = shape_of(kind, rng);
        let (middle, along) = polyline::at(&self.sidewalk.path, station);
        // Away from the road: to the left of a left sidewalk, to the right of a right one.
        let outwards = if self.sidewalk.side == Side::Left { 1.0 } else { -1.0 };
        let away = Vector2::new(-ops::sin(along), ops::cos(along)) * outwards;
        let half = self.sidewalk.width * 0.5;
        let offset = match zone {
            Zone::Kerb => -half + KERB_DISTANCE,
            Zone::Building => half + BACK_GAP + shape.size().x * 0.5,
        };
        let facing = ops::wrap_angle(along - outwards * std::f64::consts::FRAC_PI_2);
        Element { kind, position: middle + away * offset, facing, shape }
    }
}
