//! Where nobody lays a way for walkers: on the land of roads and in buildings.

use simworld_core::geometry::{Point2, Vector2};
use simworld_core::id::RoadId;
use simworld_core::net::{Road, RoadNetwork};

use crate::building::{Building, Surveyed};
use crate::occupancy::{Occupancy, intersection_walk};
use crate::osm::mask::Mask;
use crate::osm::near::Near;

/// Half the width in which a way is tested, m: its middle, for maps are not that exact.
const HALF: f64 = 0.1;
/// A way that is nowhere farther beyond a sidewalk than this follows it, m.
const FOLLOWS: f64 = 3.0;

/// What is taken on the ground.
pub(super) struct Land {
    /// By roads, sidewalks included.
    roads: Occupancy,
    /// By what is driven on: carriageways and junctions.
    driven: Occupancy,
    /// By buildings.
    walls: Occupancy,
    /// By sidewalks and what lies right beside them.
    beside: Occupancy,
}

impl Land {
    /// The land of a level that somebody who walks where the mask says may come to. Buildings are in nobody's way but on the
    /// ground, and so are junctions at the ends of bridges and tunnels.
    pub(super) fn of(network: &RoadNetwork, buildings: &[Building], mask: &Mask, level: i8) -> Self {
        let (mut driven, mut beside, mut walls) =
            (Occupancy::default(), Occupancy::default(), Occupancy::default());
        let is_level = |road: &RoadId| network.roads[road.index()].level == level;
        let mut near = Near::of(network, |road| is_level(&road), mask, FOLLOWS + HALF);
        if level != 0 {
            for (is_near, place) in near.junctions.iter_mut().zip(&network.intersections) {
                *is_near &= place.roads.iter().all(is_level);
            }
        }
        for (road, _) in network.roads.iter().zip(&near.roads).filter(|(_, is_near)| **is_near) {
            take_carriageway(road, &mut driven);
            for walk in road.sidewalks.iter().flatten().map(|walk| &network.sidewalks[walk.index()]) {
                let reach = walk.width * 0.5 + FOLLOWS;
                beside.add_path(&walk.path, (reach, reach));
            }
        }
        for (place, _) in network.intersections.iter().zip(&near.junctions).filter(|(_, is_near)| **is_near) {
            let paved = Surveyed { outline: place.outline.clone(), courts: Vec::new() };
            paved.triangles().iter().for_each(|triangle| driven.add(triangle));
            let reach = intersection_walk(network, &place.roads) * 0.5 + FOLLOWS;
            place.corners.iter().for_each(|corner| beside.add_path(corner, (reach, reach)));
        }
        let on_ground = if level == 0 { buildings } else { &[] };
        on_ground.iter().flat_map(Building::ground).for_each(|piece| walls.add(&piece));
        Self { roads: near.land(network), driven, walls, beside }
    }

    /// What is taken near a box, as convex outlines.
    pub(super) fn near(&self, low: Point2, high: Point2) -> impl Iterator<Item = &[Point2]> {
        [&self.roads, &self.driven, &self.walls].into_iter().flat_map(move |taken| taken.near(low, high))
    }

    /// Whether a straight piece lies beside the roads.
    pub(super) fn is_off_roads(&self, a: Point2, b: Point2) -> bool {
        is_free(&[&self.roads, &self.driven], a, b)
    }

    /// Whether a straight piece lies in no building.
    pub(super) fn is_outside(&self, a: Point2, b: Point2) -> bool {
        is_free(&[&self.walls], a, b)
    }

    /// Whether a straight piece crosses nothing that is driven on.
    pub(super) fn is_clear(&self, a: Point2, b: Point2) -> bool {
        is_free(&[&self.driven], a, b)
    }

    /// Whether a straight piece lies right beside a sidewalk, at least in part.
    pub(super) fn is_beside_road(&self, a: Point2, b: Point2) -> bool {
        !is_free(&[&self.beside], a, b)
    }
}

/// Takes what lies between the kerbs of a road, round the outside of its bends too.
fn take_carriageway(road: &Road, taken: &mut Occupancy) {
    let (left, right) = (road.left_kerb.max(0.0), road.right_kerb.max(0.0));
    taken.add_path(&road.centerline, (left, right));
    for three in road.centerline.windows(3) {
        let normals = [three[1] - three[0], three[2] - three[1]]
            .map(|along| Vector2::new(-along.y, along.x).try_normalize(1e-9).unwrap_or_else(Vector2::zeros));
        let bend = normals[0].perp(&normals[1]);
        // The outside of a bend to the left is on the right.
        let reach = if bend > 0.0 { -right } else { left };
        if bend.abs() < 1e-3 {
            continue;
        }
        let Some(between) = (normals[0] + normals[1]).try_normalize(1e-6) else { continue };
        // As far as the kerbs of both pieces meet, but of a sharp bend no farther than twice as wide as the road.
        let corner = between * (reach / between.dot(&normals[0]).max(0.5));
        taken.add(&[
            three[1],
            three[1] + normals[0] * reach,
            three[1] + corner,
            three[1] + normals[1] * reach,
        ]);
    }
}

fn is_free(all: &[&Occupancy], a: Point2, b: Point2) -> bool {
    let along = b - a;
    let length = along.norm();
    if length < 1e-6 {
        return true;
    }
    let across = Vector2::new(-along.y, along.x) * (HALF / length);
    let strip = [b - across, b + across, a + across, a - across];
    all.iter().all(|taken| taken.is_free(&strip))
}
