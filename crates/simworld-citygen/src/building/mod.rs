//! Buildings along both sides of every street: sampled, tested against everything that stands, the gaps filled.

mod archetype;
mod names;

use std::collections::BTreeSet;

pub use archetype::{ARCHETYPES, Archetype, STOREY};
use serde::{Deserialize, Serialize};
use simworld_core::geometry::{Obb, Point2, Point3, Vector2, Vector3, direction, pose_facing};
use simworld_core::id::RoadId;
use simworld_core::net::{RoadNetwork, Side, polyline};
use simworld_core::ops;
use simworld_core::scene::Place;
use simworld_core::seed::{Seed, StreamRng};

use crate::BuildingConfig;
use crate::occupancy::Occupancy;
use crate::strips::lane_reach;

/// A building of a city.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Building {
    /// Its kind; in files, its name.
    #[serde(with = "archetype::by_name")]
    pub archetype: &'static Archetype,
    /// What it is used for; by default its kind's use.
    pub place: Place,
    /// What people call it.
    pub name: Option<String>,
    /// The middle of its footprint, m.
    pub center: Point2,
    /// Direction in which its entrance looks, radians.
    pub facing: f64,
    /// Width along the street, m.
    pub width: f64,
    /// Depth away from the street, m.
    pub depth: f64,
    /// Number of storeys.
    pub storeys: u32,
    /// Where one stands before its entrance: the middle of the sidewalk, m.
    pub access: Point2,
    /// The road it stands at.
    pub road: RoadId,
    /// The side of that road.
    pub side: Side,
}

impl Building {
    /// Height, m.
    pub fn height(&self) -> f64 {
        f64::from(self.storeys) * STOREY + 0.6
    }

    /// Its solid as an oriented box; the body's x axis looks out of the entrance.
    pub fn obb(&self) -> Obb {
        footprint(self.center, self.facing, self.width, self.depth, self.height())
    }
}

fn footprint(center: Point2, facing: f64, width: f64, depth: f64, height: f64) -> Obb {
    Obb {
        pose: pose_facing(Point3::new(center.x, center.y, height * 0.5), facing),
        half_extents: Vector3::new(depth * 0.5, width * 0.5, height * 0.5),
    }
}

/// What was built, and how much of the frontage that there was it took.
#[derive(Clone, Debug, Default)]
pub(crate) struct Built {
    pub(crate) buildings: Vec<Building>,
    pub(crate) frontage: f64,
    pub(crate) frontage_used: f64,
}

/// Builds along all streets. `taken` holds the land of the roads and receives the buildings.
pub(crate) fn build(
    network: &RoadNetwork,
    config: &BuildingConfig,
    seed: Seed,
    taken: &mut Occupancy,
) -> Built {
    let streams = seed.stream("citygen/buildings");
    let (low, high) = network.bounds().unwrap_or((Point2::origin(), Point2::origin()));
    let site = Site {
        network,
        config,
        middle: nalgebra::center(&low, &high),
        radius: ((high - low).norm() * 0.5).max(1.0),
    };
    let mut built = Built::default();
    for (index, _) in network.roads.iter().enumerate() {
        for (rank, side) in [Side::Left, Side::Right].into_iter().enumerate() {
            let rng = streams.indexed(index as u64 * 2 + rank as u64).rng();
            let front = Front { site: &site, road: RoadId::from_index(index), side };
            front.build(rng, taken, &mut built);
        }
    }
    ensure_places(&mut built.buildings, &mut streams.named("places").rng());
    name_all(&mut built.buildings, &mut streams.named("names").rng());
    built
}

struct Site<'a> {
    network: &'a RoadNetwork,
    config: &'a BuildingConfig,
    middle: Point2,
    radius: f64,
}

/// One side of one road.
struct Front<'a> {
    site: &'a Site<'a>,
    road: RoadId,
    side: Side,
}

/// A building that would like to stand.
struct Candidate {
    archetype: &'static Archetype,
    width: f64,
    depth: f64,
}

impl Front<'_> {
    /// Samples from one end of the sidewalk to the other, then fills the gaps with what is small enough.
    fn build(&self, mut rng: StreamRng, taken: &mut Occupancy, built: &mut Built) {
        let length = self.length();
        if length <= 0.0 {
            return;
        }
        built.frontage += length;
        let mut free = Vec::new();
        let mut station = 0.0;
        let mut gap_start = 0.0;
        while station < length {
            let candidate = self.sample(station, &mut rng);
            let fits = station + candidate.width <= length && rng.chance(self.site.config.density);
            if fits && self.place(station, &candidate, &mut rng, taken, built) {
                free.push((gap_start, station));
                station += candidate.width + self.site.config.gap;
                gap_start = station;
            } else {
                station += 3.0;
            }
        }
        free.push((gap_start, length));
        for (start, end) in free {
            self.fill(start, end, &mut rng, taken, built);
        }
    }

    /// Greedy filling: at each station of a gap the largest kind that still fits.
    fn fill(&self, start: f64, end: f64, rng: &mut StreamRng, taken: &mut Occupancy, built: &mut Built) {
        let mut station = start;
        while station + 5.0 <= end && rng.chance(self.site.config.density) {
            let room = end - station;
            let mut placed = None;
            let offset = rng.below(ARCHETYPES.len());
            // Every kind gets its chance to be first among those that fit, so that no filler dominates.
            let mut order: Vec<&'static Archetype> =
                ARCHETYPES.iter().filter(|kind| kind.width.0 <= room && is_filler(kind.place)).collect();
            let len = order.len().max(1);
            order.rotate_left(offset % len);
            for archetype in order {
                let width = rng.uniform(archetype.width.0, archetype.width.1.min(room));
                let candidate = Candidate { archetype, width, depth: archetype.depth.0 };
                if self.place(station, &candidate, rng, taken, built) {
                    placed = Some(candidate.width);
                    break;
                }
            }
            station += placed.map_or(2.5, |width| width + self.site.config.gap);
        }
    }

    fn sample(&self, station: f64, rng: &mut StreamRng) -> Candidate {
        let (spot, _) = polyline::at(&self.line().path, station);
        let centrality = (1.0 - (spot - self.site.middle).norm() / self.site.radius).clamp(0.0, 1.0);
        let weights: Vec<f64> = ARCHETYPES.iter().map(|kind| kind.weight(centrality)).collect();
        let archetype = &ARCHETYPES[rng.weighted(&weights).unwrap_or(0)];
        Candidate {
            archetype,
            width: rng.uniform(archetype.width.0, archetype.width.1),
            depth: rng.uniform(archetype.depth.0, archetype.depth.1),
        }
    }

    fn line(&self) -> &simworld_core::net::Sidewalk {
        // Buildings are made only where the network has sidewalks, see `length`.
        self.site.network.sidewalk(self.road, self.side).expect("a front is built along a sidewalk")
    }

    fn length(&self) -> f64 {
        self.site
            .network
            .sidewalk(self.road, self.side)
            .map_or(0.0, |sidewalk| polyline::length(&sidewalk.path))
    }

    /// Puts a building at a station if nothing stands there.
    fn place(
        &self,
        station: f64,
        candidate: &Candidate,
        rng: &mut StreamRng,
        taken: &mut Occupancy,
        built: &mut Built,
    ) -> bool {
        let sidewalk = self.line();
        let (access, along) = polyline::at(&sidewalk.path, station + candidate.width * 0.5);
        let outwards = if self.side == Side::Left { along } else { along + std::f64::consts::PI };
        let away = Vector2::new(-ops::sin(outwards), ops::cos(outwards));
        let distance = sidewalk.width * 0.5 + self.site.config.setback + candidate.depth * 0.5;
        let center = access + away * distance;
        let facing = ops::wrap_angle(outwards - std::f64::consts::FRAC_PI_2);
        debug_assert!((direction(facing) + away).norm() < 1e-9, "a building faces its street");
        let archetype = candidate.archetype;
        let span = (archetype.storeys.1 - archetype.storeys.0 + 1) as usize;
        let building = Building {
            archetype,
            place: archetype.place,
            name: None,
            center,
            facing,
            width: candidate.width,
            depth: candidate.depth,
            storeys: archetype.storeys.0 + rng.below(span) as u32,
            access,
            road: self.road,
            side: self.side,
        };
        let obb = building.obb();
        if !taken.is_free_box(&obb) || self.reaches_a_road(&obb) {
            return false;
        }
        taken.add_box(&obb);
        built.frontage_used += candidate.width;
        built.buildings.push(building);
        true
    }

    /// A bent road may come nearer than its strip says; the carriageway itself is tested once more.
    fn reaches_a_road(&self, obb: &Obb) -> bool {
        let road = &self.site.network.roads[self.road.index()];
        let reach = lane_reach(road);
        obb.footprint().iter().any(|corner| {
            polyline::closest(&road.centerline, corner).is_some_and(|closest| closest.distance < reach)
        })
    }
}

/// Whether a gap may be filled with such a place; large institutions are sampled, never fillers.
const fn is_filler(place: Place) -> bool {
    matches!(place, Place::Home | Place::Store | Place::Restaurant | Place::Office | Place::RestArea)
}

/// The places that every city of some size has: one of each for so many buildings, and at least so many.
const NEEDED: [(Place, usize, usize); 8] = [
    (Place::Restaurant, 9, 3),
    (Place::Store, 20, 2),
    (Place::ChargingStation, 60, 1),
    (Place::RestArea, 60, 1),
    (Place::Hospital, 200, 1),
    (Place::Museum, 200, 1),
    (Place::School, 150, 1),
    (Place::Office, 30, 1),
];

/// Gives other uses to homes where sampling left a needed place out.
fn ensure_places(buildings: &mut [Building], rng: &mut StreamRng) {
    for (place, one_in, least) in NEEDED {
        let needed = (buildings.len() / one_in).max(least);
        let present = buildings.iter().filter(|building| building.place == place).count();
        let mut homes: Vec<usize> =
            (0..buildings.len()).filter(|index| buildings[*index].place == Place::Home).collect();
        rng.shuffle(&mut homes);
        // At least half of the homes stay homes.
        let spare = homes.len().div_ceil(2);
        for index in homes.into_iter().take(needed.saturating_sub(present).min(spare)) {
            buildings[index].place = place;
        }
    }
}

fn name_all(buildings: &mut [Building], rng: &mut StreamRng) {
    let mut used = BTreeSet::new();
    for building in buildings {
        building.name = names::draw(building.place, &mut used, rng);
    }
}
