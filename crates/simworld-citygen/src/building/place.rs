//! One lot and what is built on it.

use simworld_core::geometry::Point2;
use simworld_core::id::RoadId;
use simworld_core::net::{RoadNetwork, Side};
use simworld_core::scene::Place;
use simworld_core::seed::{Stream, StreamRng};

use super::site::{Site, Spot};
use super::weights::Weights;
use super::{ARCHETYPES, Archetype, Building, Footprint};
use crate::BuildingConfig;
use crate::lot::{Land, Lot};
use crate::occupancy::overlap;

/// Kinds tried at random before the greedy filling.
const TRIES: usize = 5;
/// Unused front that ends the search for a kind that fits better, m.
const TOLERATED: f64 = 1.0;
/// How far the search moves on along a front where something stands, m.
const STEP: f64 = 2.5;
/// Distance kept from the edges of the lot, against rounding, m.
const CLEARANCE: f64 = 1e-3;
/// Land kept free behind a building, m.
const REAR: f64 = 1.0;
/// The narrowest and the shallowest building, m.
const LEAST: f64 = 5.0;
/// A façade farther from a street than its setback and this does not count as standing at it, m.
const AT_STREET: f64 = 4.0;

/// Buildings that would like to stand, and the ground of each.
#[derive(Default)]
pub(super) struct Plans {
    pub(super) buildings: Vec<Building>,
    pub(super) grounds: Vec<[Point2; 4]>,
}

/// Plans buildings lot by lot.
pub(super) struct Planner<'a> {
    network: &'a RoadNetwork,
    land: &'a Land,
    config: &'a BuildingConfig,
    streams: Stream,
    weights: &'a Weights,
    /// Room for the corners of a lot.
    corners: Vec<Point2>,
    plans: Plans,
    /// The first plan on the lot at hand.
    first: usize,
}

impl<'a> Planner<'a> {
    pub(super) fn new(
        network: &'a RoadNetwork,
        land: &'a Land,
        config: &'a BuildingConfig,
        weights: &'a Weights,
        streams: Stream,
    ) -> Self {
        Self {
            network,
            land,
            config,
            streams,
            weights,
            corners: Vec::new(),
            plans: Plans::default(),
            first: 0,
        }
    }

    /// Plans what stands on some lots.
    pub(super) fn plan_all(mut self, lots: &[Lot]) -> Plans {
        self.plans.buildings.reserve(lots.len() * 4 / 3);
        self.plans.grounds.reserve(lots.len() * 4 / 3);
        for lot in lots {
            self.first = self.plans.grounds.len();
            self.plan(lot);
        }
        self.plans
    }

    /// Plans what stands on a lot: along its front a kind drawn by its zone, then what fits into the gaps beside it;
    /// along its other streets what has room next to that.
    fn plan(&mut self, lot: &Lot) {
        let borders = self.land.borders(lot);
        let origin = self.land.outline(lot)[0];
        let key = |x: f64| (x * 100.0).round() as i64 as u64;
        let mut rng = self.streams.indexed(key(origin.x)).indexed(key(origin.y)).rng();
        if !rng.chance(self.config.density) {
            return;
        }
        for (edge, border) in borders.iter().enumerate() {
            if let Some(street) = border.as_street() {
                self.line(lot, edge, street, &mut rng);
            }
        }
    }

    /// Plans what stands along one street of a lot.
    fn line(&mut self, lot: &Lot, edge: usize, street: (RoadId, Side), rng: &mut StreamRng) {
        let corners = std::mem::take(&mut self.corners);
        let Some(site) = Site::of(self.land, lot, edge, street, self.config.setback, corners) else { return };
        self.fill(&site, edge == 0, rng);
        self.corners = site.local;
    }

    /// Fills the room along the street of a site from its beginning to its end.
    fn fill(&mut self, site: &Site<'_>, mut is_first: bool, rng: &mut StreamRng) {
        let Some((mut start, end)) = self.room(site, LEAST) else { return };
        while end - start >= LEAST {
            let Some((kind, spot)) = self.choose(site, (start, end), is_first, rng) else { break };
            if self.is_free(site, spot) {
                self.raise(site, kind, spot, rng);
                start = spot.x + spot.width + self.config.gap;
            } else {
                start += STEP;
            }
            is_first = false;
        }
    }

    /// Whether a spot keeps its distance from what was planned on the lot so far.
    fn is_free(&self, site: &Site<'_>, spot: Spot) -> bool {
        let gap = self.config.gap;
        let wide = Spot { x: spot.x - gap, width: spot.width + 2.0 * gap, depth: spot.depth + gap };
        let corners = site.corners(wide);
        self.plans.grounds[self.first..].iter().all(|ground| !overlap(ground, &corners))
    }

    /// A kind that fits between two stations of the front, and where: of some drawn by their weights the one that
    /// leaves least of the front unused.
    fn choose(
        &self,
        site: &Site<'_>,
        room: (f64, f64),
        is_first: bool,
        rng: &mut StreamRng,
    ) -> Option<(&'static Archetype, Spot)> {
        let mut best: Option<(f64, &'static Archetype, Spot)> = None;
        if is_first {
            for _ in 0..TRIES {
                let kind = self.weights.draw(site.lot, rng);
                let Some(spot) = self.fit(site, kind, room, rng) else { continue };
                let unused = self.unused(room, spot);
                if best.as_ref().is_none_or(|best| unused < best.0) {
                    best = Some((unused, kind, spot));
                }
                if unused < TOLERATED {
                    break;
                }
            }
        }
        if let Some((_, kind, spot)) = best {
            return Some((kind, spot));
        }
        // Greedy filling: each kind gets its chance to be first, so that no filler dominates.
        let first = rng.below(ARCHETYPES.len());
        (0..ARCHETYPES.len()).find_map(|step| {
            let at = first + step;
            let kind = &ARCHETYPES[if at < ARCHETYPES.len() { at } else { at - ARCHETYPES.len() }];
            let is_filler = kind.width.0 <= room.1 - room.0
                && is_filler(kind.place)
                && kind.weight(site.lot.zone, site.lot.density) > 0.0;
            is_filler.then(|| self.fit(site, kind, room, rng)).flatten().map(|spot| (kind, spot))
        })
    }

    /// How much of the room between two stations a spot leaves to nobody, m.
    fn unused(&self, (start, end): (f64, f64), spot: Spot) -> f64 {
        let right = end - (spot.x + spot.width) - self.config.gap;
        // A neighbour takes what is left, but for what it leaves in turn.
        if right >= LEAST { spot.x - start + 2.0 } else { end - start - spot.width }
    }

    /// Where a kind fits between two stations, as wide as it may be.
    fn fit(
        &self,
        site: &Site<'_>,
        kind: &Archetype,
        (start, end): (f64, f64),
        rng: &mut StreamRng,
    ) -> Option<Spot> {
        let deepest = (site.deep - self.config.setback - REAR).min(kind.depth.1);
        if end - start < kind.width.0 || deepest < kind.depth.0 {
            return None;
        }
        for depth in [rng.uniform(kind.depth.0, deepest), kind.depth.0] {
            let Some((low, high)) = self.room(site, depth) else { continue };
            let (low, high) = (low.max(start), high.min(end));
            let room = high - low;
            if room >= kind.width.0 {
                let width = room.min(kind.width.1);
                // What is too little for a neighbour is left on both sides.
                let spare = room - width;
                let x = if spare < LEAST + self.config.gap { low + spare * 0.5 } else { low };
                return Some(Spot { x, width, depth });
            }
        }
        None
    }

    /// The room along a street for that depth, see [`Site::room`].
    fn room(&self, site: &Site<'_>, depth: f64) -> Option<(f64, f64)> {
        site.room(depth, self.config.gap * 0.5 + CLEARANCE)
    }

    fn raise(&mut self, site: &Site<'_>, archetype: &'static Archetype, spot: Spot, rng: &mut StreamRng) {
        let near = self.config.setback;
        let corners = site.corners(spot);
        let span = (archetype.storeys.1 - archetype.storeys.0 + 1) as usize;
        let storeys = archetype.storeys.0 + rng.below(span) as u32;
        let plan = archetype.plans[rng.below(archetype.plans.len())];
        let footprint = Footprint::fitted(plan, spot.width, spot.depth, storeys, rng);
        let roof = archetype.roofs[rng.below(archetype.roofs.len())];
        let middle = spot.x + spot.width * 0.5;
        let door = site.at(middle, 0.0);
        let lot = site.lot;
        let frontage = site.frontage(self.land, &corners, near + AT_STREET);
        self.plans.grounds.push(corners);
        self.plans.buildings.push(Building {
            archetype,
            place: archetype.place,
            name: None,
            center: site.at(middle, near + spot.depth * 0.5),
            facing: site.facing,
            width: spot.width,
            depth: spot.depth,
            footprint,
            storeys,
            roof,
            zone: lot.zone,
            access: site.access(self.network, door),
            road: site.road,
            side: site.side,
            frontage,
            given: false,
        });
    }
}

/// Whether a gap may be filled with such a place; large institutions are sampled, never fillers.
const fn is_filler(place: Place) -> bool {
    matches!(
        place,
        Place::Home | Place::Store | Place::Restaurant | Place::Office | Place::RestArea | Place::Factory
    )
}
