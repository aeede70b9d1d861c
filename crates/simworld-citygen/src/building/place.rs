//! One lot and what is built on it.

use simworld_core::geometry::Point2;
use simworld_core::id::RoadId;
use simworld_core::net::{RoadNetwork, Side};
use simworld_core::seed::{Stream, StreamRng};

use super::blocked::Blocked;
use super::site::{Site, Spot};
use super::weights::Weights;
use super::{ARCHETYPES, Archetype, Building, Footprint, access};
use crate::BuildingConfig;
use crate::key::stream_at;
use crate::lot::{Land, Lot};
use crate::occupancy::{least, most, overlap};

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
/// The deepest building, m.
const DEEPEST: f64 = deepest_kind();
/// A façade farther from a street than its setback and this does not count as standing at it, m.
const AT_STREET: f64 = 4.0;

/// Buildings that would like to stand, and the ground of each.
#[derive(Default)]
pub(super) struct Plans {
    pub(super) buildings: Vec<Building>,
    pub(super) grounds: Vec<[Point2; 4]>,
}

/// What is to stand along a street.
enum Choice {
    Nothing,
    /// A kind, and where it fits.
    Spot(&'static Archetype, Spot),
    /// Something that would meet what was planned on the lot before.
    Blocked,
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
    /// Where along the street at hand something stands already.
    blocked: Blocked,
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
            blocked: Blocked::default(),
        }
    }

    /// Plans what stands on some lots.
    pub(super) fn plan_all(mut self, lots: &[Lot]) -> Plans {
        self.plans.buildings.reserve(lots.len() * 4 / 3);
        self.plans.grounds.reserve(lots.len() * 4 / 3);
        // To begin a stream takes long, but many at once hardly longer.
        let rngs: Vec<StreamRng> = lots.iter().map(|lot| self.rng(lot)).collect();
        for (lot, mut rng) in lots.iter().zip(rngs) {
            self.first = self.plans.grounds.len();
            self.plan(lot, &mut rng);
        }
        access::lay(self.network, &mut self.plans.buildings);
        self.plans
    }

    /// The stream of a lot: a function of where it lies.
    fn rng(&self, lot: &Lot) -> StreamRng {
        stream_at(self.land.outline(lot)[0], 100.0, self.streams).rng()
    }

    /// Plans what stands on a lot: along its front a kind drawn by its zone, then what fits into the gaps beside it;
    /// along its other streets what has room next to that.
    fn plan(&mut self, lot: &Lot, rng: &mut StreamRng) {
        let borders = self.land.borders(lot);
        if !rng.chance(self.config.density) {
            return;
        }
        for (edge, border) in borders.iter().enumerate() {
            if let Some(street) = border.as_street() {
                self.line(lot, edge, street, rng);
            }
        }
    }

    /// Plans what stands along one street of a lot.
    fn line(&mut self, lot: &Lot, edge: usize, street: (RoadId, Side), rng: &mut StreamRng) {
        let Some(site) = self.look(lot, edge, street) else { return };
        self.fill(&site, edge == 0, rng);
        self.corners = site.local;
    }

    /// Looks at a lot from one of its streets, and at what stands there; `None` if that has no length.
    fn look<'l>(&mut self, lot: &'l Lot, edge: usize, street: (RoadId, Side)) -> Option<Site<'l>> {
        let corners = std::mem::take(&mut self.corners);
        let site = Site::of(self.land, lot, edge, street, self.config.setback, corners)?;
        let mut blocked = std::mem::take(&mut self.blocked);
        let gaps = (self.config.gap, self.most_spare());
        let depths = (LEAST, self.deepest(&site).min(DEEPEST));
        blocked.look(&site, &self.plans.grounds[self.first..], depths, gaps, |depth| self.room(&site, depth));
        self.blocked = blocked;
        Some(site)
    }

    /// Fills the room along the street of a site from its beginning to its end.
    fn fill(&mut self, site: &Site<'_>, mut is_first: bool, rng: &mut StreamRng) {
        let Some((mut start, end)) = self.room(site, LEAST) else { return };
        while end - start >= LEAST {
            match self.choose(site, (start, end), is_first, rng) {
                Choice::Nothing => break,
                Choice::Spot(kind, spot) if self.is_free(site, spot) => {
                    self.raise(site, kind, spot, rng);
                    start = spot.x + spot.width + self.config.gap;
                }
                Choice::Spot(..) | Choice::Blocked => start += STEP,
            }
            is_first = false;
        }
    }

    /// Whether a spot keeps its distance from what was planned on the lot so far.
    fn is_free(&self, site: &Site<'_>, spot: Spot) -> bool {
        !self.blocked.meets(spot) && self.is_apart(site, spot)
    }

    /// The same, whatever is known beforehand.
    fn is_apart(&self, site: &Site<'_>, spot: Spot) -> bool {
        let planned = &self.plans.grounds[self.first..];
        if planned.is_empty() {
            return true;
        }
        let gap = self.config.gap;
        let wide = Spot { x: spot.x - gap, width: spot.width + 2.0 * gap, depth: spot.depth + gap };
        let corners = site.corners(wide);
        planned.iter().all(|ground| !overlap(ground, &corners))
    }

    /// A kind that fits between two stations of the front, and where: of some drawn by their weights the one that
    /// leaves least of the front unused.
    fn choose(&self, site: &Site<'_>, room: (f64, f64), is_first: bool, rng: &mut StreamRng) -> Choice {
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
            return Choice::Spot(kind, spot);
        }
        self.filler(site, room, rng)
    }

    /// Greedy filling: each kind gets its chance to be first, so that no filler dominates.
    fn filler(&self, site: &Site<'_>, room: (f64, f64), rng: &mut StreamRng) -> Choice {
        let (width, deepest) = (room.1 - room.0, self.deepest(site));
        for kind in self.weights.fillers(site.lot, (width, deepest), rng.below(ARCHETYPES.len())) {
            if kind.width.0 > width
                || kind.depth.0 > deepest
                || kind.weight(site.lot.zone, site.lot.density) <= 0.0
            {
                continue;
            }
            if self.blocked.is_sure(room, kind.width) {
                // It would fit at the first depth that is drawn, and stand where something stands.
                rng.bits();
                return Choice::Blocked;
            }
            if let Some(spot) = self.fit(site, kind, room, rng) {
                return Choice::Spot(kind, spot);
            }
        }
        Choice::Nothing
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
        let deepest = least(self.deepest(site), kind.depth.1);
        if end - start < kind.width.0 || deepest < kind.depth.0 {
            return None;
        }
        for depth in [rng.uniform(kind.depth.0, deepest), kind.depth.0] {
            let Some((low, high)) = self.room(site, depth) else { continue };
            let (low, high) = (most(low, start), least(high, end));
            let room = high - low;
            if room >= kind.width.0 {
                let width = least(room, kind.width.1);
                // What is too little for a neighbour is left on both sides.
                let spare = room - width;
                let x = if spare < self.most_spare() { low + spare * 0.5 } else { low };
                return Some(Spot { x, width, depth });
            }
        }
        None
    }

    /// How deep a building may be, m.
    fn deepest(&self, site: &Site<'_>) -> f64 {
        site.deep - self.config.setback - REAR
    }

    /// Room that is too little for a neighbour, m.
    fn most_spare(&self) -> f64 {
        LEAST + self.config.gap
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
            facing: site.facing(),
            width: spot.width,
            depth: spot.depth,
            footprint,
            storeys,
            roof,
            zone: lot.zone,
            // Where one stands before the door is looked up for all of them together.
            access: door,
            road: site.road,
            side: site.side,
            frontage,
            given: false,
        });
    }
}

/// The greatest depth of all kinds, m.
const fn deepest_kind() -> f64 {
    let (mut deepest, mut index) = (LEAST, 0);
    while index < ARCHETYPES.len() {
        deepest = deepest.max(ARCHETYPES[index].depth.1);
        index += 1;
    }
    deepest
}

#[cfg(test)]
mod tests;
