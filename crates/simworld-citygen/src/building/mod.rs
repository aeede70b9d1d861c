//! Buildings on lots: sampled by zone, tested against everything that stands, the gaps filled.

mod access;
mod archetype;
mod blocked;
mod footprint;
mod names;
mod place;
mod roof;
mod site;
mod surveyed;
mod uses;
mod weights;

pub use archetype::{ARCHETYPES, Archetype, STOREY};
pub use footprint::{Footprint, FootprintKind, Part};
use nalgebra::Rotation2;
pub use roof::RoofKind;
use serde::{Deserialize, Serialize};
use simworld_core::geometry::{Obb, Point2, Point3, Vector2, Vector3, pose_facing};
use simworld_core::id::RoadId;
use simworld_core::net::{RoadNetwork, Side};
use simworld_core::scene::Place;
use simworld_core::seed::Seed;
pub use surveyed::Surveyed;

use crate::BuildingConfig;
use crate::key::stream_at;
use crate::lot::{Land, Lot};
use crate::occupancy::Occupancy;
use crate::range::{is_place, is_size};
use crate::threads;
use crate::zoning::Zone;
use place::{Planner, Plans};
use rayon::prelude::*;
use weights::Weights;

/// Lots that are planned at once: enough for many threads, few enough that the plans stay small.
const BATCH: usize = 1 << 13;
/// Lots that one thread plans at once.
const CHUNK: usize = 128;
/// Buildings on a map share walls; what overlaps by less than twice this does not overlap, m.
pub const SHARED_WALL: f64 = 0.1;
/// Most storeys.
const MOST_STOREYS: u32 = 500;
/// Height of a wall above the highest ceiling, m.
const PARAPET: f64 = 0.6;

/// A building of a city.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Building {
    /// Its kind.
    #[serde(with = "archetype::by_name")]
    pub archetype: &'static Archetype,
    /// What it is used for; by default its kind's use.
    pub place: Place,
    /// What people call it.
    pub name: Option<String>,
    /// The middle of the rectangle round its footprint, m.
    pub center: Point2,
    /// Direction in which its entrance looks, radians.
    pub facing: f64,
    /// Width along the street, m.
    pub width: f64,
    /// Depth away from the street, m.
    pub depth: f64,
    /// Its outline within that width and depth.
    pub footprint: Footprint,
    /// Number of storeys.
    pub storeys: u32,
    /// Its roof.
    pub roof: RoofKind,
    /// The zone it stands in.
    pub zone: Zone,
    /// Where one stands before its entrance: the middle of the sidewalk, m.
    pub access: Point2,
    /// The road it stands at.
    pub road: RoadId,
    /// The side of that road.
    pub side: Side,
    /// Length of the frontage along which it stands, m.
    pub frontage: f64,
    /// Whether a map or a hand put it here: then it stays when the streets round its block change, as long as it has room.
    pub given: bool,
}

impl Building {
    /// Whether its place and size are possible.
    pub(crate) fn is_sound(&self) -> bool {
        is_place(&self.center)
            && is_place(&self.access)
            && self.facing.is_finite()
            && is_size(self.width)
            && is_size(self.depth)
            && self.storeys <= MOST_STOREYS
            && (self.frontage == 0.0 || is_size(self.frontage))
            && self.footprint.fits(self.width, self.depth)
    }

    /// Height of its walls, m.
    pub fn height(&self) -> f64 {
        f64::from(self.storeys) * STOREY + PARAPET
    }

    /// The box round it; the body's x axis looks out of the entrance. The slopes of its roof rise above.
    pub fn obb(&self) -> Obb {
        let height = self.height();
        Obb {
            pose: pose_facing(Point3::new(self.center.x, self.center.y, height * 0.5), self.facing),
            half_extents: Vector3::new(self.depth * 0.5, self.width * 0.5, height * 0.5),
        }
    }

    /// The corners of its footprint, counter-clockwise, without the courtyard, m.
    pub fn outline(&self) -> Vec<Point2> {
        let mut outline = self.footprint.outline(self.width, self.depth);
        self.to_world(&mut outline);
        outline
    }

    /// The corners of its courtyard, counter-clockwise, if it has one, m.
    pub fn courtyard(&self) -> Option<[Point2; 4]> {
        let mut court = self.footprint.courtyard(self.width, self.depth)?;
        self.to_world(&mut court);
        Some(court)
    }

    /// The corners of all its courtyards, each counter-clockwise, m.
    pub fn courtyards(&self) -> Vec<Vec<Point2>> {
        let mut courts = self.footprint.courtyards(self.width, self.depth);
        for court in &mut courts {
            self.to_world(court);
        }
        courts
    }

    /// Convex pieces of the ground that nothing else may stand on: the rectangle round it, or the triangles of a
    /// surveyed outline, drawn in by [`SHARED_WALL`], m.
    pub fn ground(&self) -> Vec<Vec<Point2>> {
        let Footprint::Surveyed(form) = &self.footprint else { return vec![self.obb().footprint().to_vec()] };
        let mut pieces = Vec::new();
        for triangle in form.triangles() {
            if let Some(mut piece) = drawn_in(triangle, SHARED_WALL) {
                self.to_world(&mut piece);
                pieces.push(piece.to_vec());
            }
        }
        pieces
    }

    /// The solids of which it is made, the one with the entrance first; each stands on the ground. A tower goes through
    /// its base, so the two share walls and no face shows twice.
    pub fn solids(&self) -> impl Iterator<Item = Obb> + '_ {
        self.footprint.parts(self.width, self.depth, self.storeys).map(|part| {
            let mut middle = [part.middle];
            self.to_world(&mut middle);
            let height = f64::from(part.storeys) * STOREY + PARAPET;
            Obb {
                pose: pose_facing(Point3::new(middle[0].x, middle[0].y, height * 0.5), self.facing),
                half_extents: Vector3::new(part.length * 0.5, part.width * 0.5, height * 0.5),
            }
        })
    }

    /// Area on the ground, m².
    pub fn footprint_area(&self) -> f64 {
        self.footprint.area(self.width, self.depth)
    }

    /// Area of all floors, m².
    pub fn floor_area(&self) -> f64 {
        match self.footprint {
            Footprint::Stepped { base, setback } => {
                let tower = (self.width - 2.0 * setback) * (self.depth - 2.0 * setback);
                f64::from(base) * self.footprint_area() + f64::from(self.storeys.saturating_sub(base)) * tower
            }
            Footprint::Rectangle
            | Footprint::L { .. }
            | Footprint::U { .. }
            | Footprint::Courtyard { .. }
            | Footprint::Surveyed(_) => f64::from(self.storeys) * self.footprint_area(),
        }
    }

    fn to_world(&self, points: &mut [Point2]) {
        let (sin, cos) = simworld_core::ops::sin_cos(self.facing);
        let turn = Rotation2::from_matrix_unchecked(nalgebra::Matrix2::new(cos, -sin, sin, cos));
        for point in points {
            *point = self.center + turn * point.coords;
        }
    }
}

/// A triangle with every side moved inwards; `None` if nothing is left.
fn drawn_in(corners: [Point2; 3], distance: f64) -> Option<[Point2; 3]> {
    let sides = [0, 1, 2].map(|corner| (corners[(corner + 2) % 3] - corners[(corner + 1) % 3]).norm());
    let around: f64 = sides.iter().sum();
    let doubled = (corners[1] - corners[0]).perp(&(corners[2] - corners[0])).abs();
    // The middle of the inscribed circle, and its radius.
    let middle =
        corners.iter().zip(sides).fold(Vector2::zeros(), |sum, (corner, side)| sum + corner.coords * side);
    let (middle, radius) = (Point2::from(middle / around), doubled / around);
    (radius > distance).then(|| corners.map(|corner| middle + (corner - middle) * (1.0 - distance / radius)))
}

/// Builds on all lots and gives every place that people need, and its name. `taken` holds the land of the roads and receives
/// the buildings.
pub fn build(
    network: &RoadNetwork,
    land: &Land,
    config: &BuildingConfig,
    seed: Seed,
    taken: &mut Occupancy,
) -> Vec<Building> {
    let mut buildings = raise(network, land, config, seed, taken);
    let streams = seed.stream("citygen/buildings");
    uses::ensure(&mut buildings, &mut streams.named("places").rng());
    uses::name(&mut buildings, &mut streams.named("names").rng());
    buildings
}

/// A name for a building that came later: a function of where it stands, but for the names that are given already.
pub(crate) fn name_for(building: &Building, seed: Seed, is_taken: impl Fn(&str) -> bool) -> Option<String> {
    let streams = seed.stream("citygen/buildings").named("later names");
    let mut rng = stream_at(building.center, 100.0, streams).rng();
    names::free(building.place, &mut rng, is_taken)
}

/// Builds on all lots what their zones say, without names.
pub(crate) fn raise(
    network: &RoadNetwork,
    land: &Land,
    config: &BuildingConfig,
    seed: Seed,
    taken: &mut Occupancy,
) -> Vec<Building> {
    let streams = seed.stream("citygen/buildings");
    let weights = Weights::new();
    let (mut buildings, wanted) = (Vec::new(), land.lots.len() * 4 / 3);
    taken.reserve(wanted);
    let chunk = threads::at_once(land.lots.len(), CHUNK);
    // Plans are functions of their lots, so they are made on all threads; what stands is decided in order.
    let plan = |batch: &[Lot]| -> Vec<Plans> {
        let planned = batch
            .par_chunks(chunk)
            .map(|lots| Planner::new(network, land, config, &weights, streams).plan_all(lots));
        planned.collect()
    };
    threads::in_order(land.lots.chunks(BATCH), plan, |plans| {
        for Plans { buildings: mut planned, grounds } in plans.into_iter().flatten() {
            let mut grounds = grounds.iter();
            // Lots do not overlap, so this refuses only what would stand on a road: nearly all go over as they stand.
            planned.retain(|_| grounds.next().is_some_and(|ground| taken.take(ground)));
            threads::take_over(&mut buildings, planned, wanted);
        }
    });
    buildings
}
