//! The land round some streets, divided and built on anew: by the same rules, and from the same streams, as in the whole city.

use std::collections::{BTreeMap, BTreeSet};

use simworld_core::geometry::{Point2, bounds};
use simworld_core::id::RoadId;
use simworld_core::net::{PlanPart, RoadNetwork, Side};

use super::EditError;
use super::cells::{Cells, inflated};
use super::scope::Scope;
use super::streets::with_neighbours;
use crate::City;
use crate::block::Border;
use crate::building::{self, Building};
use crate::element::{self, Element, Extent, Setting};
use crate::lot::Land;
use crate::occupancy::Occupancy;
use crate::zoning::Zoning;

/// Streets as near as this to a face may reach into its lots, m.
pub(super) const NEAR: f64 = 100.0;

/// The side of a road as a number: 2i is the left of road i, 2i + 1 its right.
pub(super) fn side_number(road: RoadId, side: Side) -> usize {
    2 * road.index() + usize::from(side == Side::Right)
}

/// Bits of a place, to find what stands there.
pub(super) fn place_key(at: Point2) -> [u64; 2] {
    [at.x.to_bits(), at.y.to_bits()]
}

/// The faces of a city that some sides of streets bound, with as much around as their land depends on.
pub(super) struct Faces<'a> {
    city: &'a City,
    sides: &'a BTreeSet<usize>,
    part: PlanPart,
    extent: Extent,
    pub(super) network: RoadNetwork,
    zoning: Zoning,
    pub(super) land: Land,
    taken: Occupancy,
}

/// What stands there already, given by a map or a hand.
pub(super) struct Given<'a> {
    /// Whether a map says what stands everywhere.
    pub(super) is_mapped: bool,
    pub(super) buildings: Vec<&'a Building>,
    pub(super) elements: Vec<&'a Element>,
}

impl<'a> Faces<'a> {
    /// The faces of a scope, divided into lots.
    pub(super) fn of(city: &'a City, near: &Cells, scope: &'a Scope) -> Result<Self, EditError> {
        let own: BTreeSet<usize> = scope.all.iter().map(|side| side / 2).collect();
        let beside = |road: &usize| bounds(&city.network.roads[*road].centerline);
        let around = own.iter().filter_map(beside).map(|bounds| inflated(bounds, NEAR));
        let mut streets = near.near_any(around);
        // How far a junction reaches into a street depends on the streets at the other end.
        streets.extend(with_neighbours(&city.network, with_neighbours(&city.network, own)));
        let part = city.plan.part(streets);
        let network = RoadNetwork::derive(&part.plan, &city.config.network)?;
        let flag = |side: usize| scope.furnished.contains(&side);
        let flags = part.streets.iter().map(|street| [0, 1].map(|side| flag(2 * street + side)));
        let extent = Extent { streets: part.streets.len(), sides: flags.collect() };
        let seed = city.provenance.seed;
        let zoning = Zoning::new(&city.config.zoning, seed);
        // In a real place houses stand below bridges and above tunnels.
        let is_place = city.provenance.origin.is_some();
        let is_land = |road: RoadId| !is_place || network.roads[road.index()].level == 0;
        let taken = Occupancy::of_roads_where(&network, is_land);
        let is_fitted = |block, edge| scope.fitted.contains(&(block, edge));
        let blocks = scope.outskirts.blocks.clone();
        let land = Land::of_fronts(blocks, &zoning, &city.config.lots, seed, (&taken, &is_fitted));
        let land = land.in_part(|border| match border.as_street() {
            Some((road, side)) => part
                .street(road.index())
                .map_or(Border::LAND, |road| Border::street(RoadId::from_index(road), side)),
            None => border,
        });
        Ok(Self { city, sides: &scope.sides, part, extent, network, zoning, land, taken })
    }

    /// The land of some of the roads, in the numbers of the city.
    pub(super) fn land_of_roads(&self, roads: &BTreeSet<usize>) -> Occupancy {
        Occupancy::of_roads_where(&self.network, |road| roads.contains(&self.part.streets[road.index()]))
    }

    fn whole(&self, road: RoadId) -> RoadId {
        RoadId::from_index(self.part.streets[road.index()])
    }

    /// Builds on the lots what leaves the given things room; `uses` says what the buildings that stand already are used for.
    pub(super) fn build(
        &mut self,
        given: &Given<'_>,
        uses: &BTreeMap<[u64; 2], &Building>,
    ) -> (Vec<Building>, Vec<Element>) {
        let (config, seed) = (&self.city.config, self.city.provenance.seed);
        given
            .buildings
            .iter()
            .flat_map(|building| building.ground())
            .for_each(|piece| self.taken.add(&piece));
        let mut buildings = if given.is_mapped {
            Vec::new()
        } else {
            building::raise(&self.network, &self.land, &config.buildings, seed, &mut self.taken)
        };
        for element in &given.elements {
            self.taken.add(&element.obb().footprint());
        }
        for building in &mut buildings {
            if let Some(present) = uses.get(&place_key(building.center)) {
                building.place = present.place;
            }
        }
        let count = buildings.len();
        buildings.extend(given.buildings.iter().filter_map(|building| {
            let road = RoadId::from_index(self.part.street(building.road.index())?);
            Some(Building { road, ..(*building).clone() })
        }));
        let setting = Setting {
            plan: &self.part.plan,
            network: &self.network,
            zoning: &self.zoning,
            land: &self.land,
            buildings: &buildings,
            within: Some(&self.extent),
        };
        let mut elements = element::furnish(&setting, &config.elements, seed, &mut self.taken);
        buildings.truncate(count);
        for building in &mut buildings {
            building.road = self.whole(building.road);
        }
        for element in &mut elements {
            if let Some((road, side)) = element.along.as_street() {
                element.along = Border::street(self.whole(road), side);
            }
        }
        buildings.retain(|building| self.sides.contains(&side_number(building.road, building.side)));
        // Cars are parked street by street, on both sides.
        elements.retain(|element| {
            element
                .along
                .as_street()
                .is_some_and(|(road, side)| self.sides.contains(&side_number(road, side)))
        });
        (buildings, elements)
    }
}
