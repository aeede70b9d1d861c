//! Parts of a network: all of it, what belongs to a tile, or what an edit touched.

use std::collections::BTreeSet;

use simworld_core::geometry::Point2;
use simworld_core::id::RoadId;
use simworld_core::net::{Crossing, Footpath, Intersection, Road, Side};

use super::Parts;
use crate::element::Extent;
use crate::occupancy::intersection_walk;

/// The part of a network that is meant.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Scope<'a> {
    /// All of it.
    All,
    /// What belongs to a tile.
    Tile(&'a Extent),
    /// What is named.
    Touched(&'a Touched),
}

/// Things of a network by their numbers.
#[derive(Clone, Debug, Default)]
pub(crate) struct Touched {
    pub(crate) roads: BTreeSet<usize>,
    pub(crate) intersections: BTreeSet<usize>,
    pub(crate) sidewalks: BTreeSet<usize>,
    pub(crate) crossings: BTreeSet<usize>,
    pub(crate) footpaths: BTreeSet<usize>,
}

impl Scope<'_> {
    /// The numbers that are named, or all up to a count.
    fn numbers(self, count: usize, named: impl Fn(&Touched) -> &BTreeSet<usize>) -> Vec<usize> {
        match self {
            Scope::Touched(touched) => {
                named(touched).iter().copied().filter(|number| *number < count).collect()
            }
            Scope::All | Scope::Tile(_) => (0..count).collect(),
        }
    }
}

impl Parts<'_> {
    pub(super) fn has_road(&self, road: RoadId) -> bool {
        match self.scope {
            Scope::All => true,
            Scope::Tile(extent) => road.index() < extent.streets,
            Scope::Touched(touched) => touched.roads.contains(&road.index()),
        }
    }

    /// Whether a way for walkers alone is meant; tiles have none.
    pub(super) fn has_footpath(&self, way: usize) -> bool {
        match self.scope {
            Scope::All => true,
            Scope::Tile(_) => false,
            Scope::Touched(touched) => touched.footpaths.contains(&way),
        }
    }

    /// Whether a tile has what lies on one side of a road; true without tiles.
    fn has_side(&self, road: RoadId, side: Side) -> bool {
        match self.scope {
            Scope::Tile(extent) => extent.has_side(road, side),
            Scope::All | Scope::Touched(_) => true,
        }
    }

    pub(super) fn roads(&self) -> impl Iterator<Item = (RoadId, &Road)> {
        let numbers = self.scope.numbers(self.network.roads.len(), |touched| &touched.roads);
        let ids = numbers.into_iter().map(RoadId::from_index).filter(|road| self.has_road(*road));
        ids.map(|road| (road, &self.network.roads[road.index()]))
    }

    /// Intersections of which all roads are meant, or that are named.
    pub(super) fn intersections(&self) -> impl Iterator<Item = &Intersection> {
        let numbers = self.scope.numbers(self.network.intersections.len(), |touched| &touched.intersections);
        let is_named = matches!(self.scope, Scope::Touched(_));
        let places = numbers.into_iter().map(|number| &self.network.intersections[number]);
        places.filter(move |place| is_named || place.roads.iter().all(|road| self.has_road(*road)))
    }

    pub(super) fn crossings(&self) -> impl Iterator<Item = &Crossing> {
        let numbers = self.scope.numbers(self.network.crossings.len(), |touched| &touched.crossings);
        let is_named = matches!(self.scope, Scope::Touched(_));
        let crossings = numbers.into_iter().map(|number| &self.network.crossings[number]);
        crossings.filter(move |crossing| is_named || self.has_road(crossing.road))
    }

    /// The ways for walkers alone that lie on the ground; tiles have none.
    pub(super) fn footpaths(&self) -> impl Iterator<Item = &Footpath> {
        let numbers = self.scope.numbers(self.network.footpaths.len(), |touched| &touched.footpaths);
        numbers.into_iter().map(|number| &self.network.footpaths[number]).filter(|way| way.level == 0)
    }

    /// The walkways along streets and round corners, and the width of each. Decks carry their own.
    pub(super) fn walkways(&self) -> impl Iterator<Item = (&[Point2], f64)> {
        let network = self.network;
        let numbers = self.scope.numbers(network.sidewalks.len(), |touched| &touched.sidewalks);
        let on_ground = move |road: RoadId| network.roads[road.index()].level <= 0;
        let along = numbers
            .into_iter()
            .map(move |number| &network.sidewalks[number])
            .filter(move |walk| self.has_side(walk.road, walk.side) && on_ground(walk.road))
            .map(|walk| (walk.path.as_slice(), walk.width));
        let places = self.scope.numbers(network.intersections.len(), |touched| &touched.intersections);
        let corners = places.into_iter().flat_map(move |index| {
            let place = &network.intersections[index];
            let width = intersection_walk(network, &place.roads);
            let meant = move |rank: usize| {
                place.roads.get(rank).is_none_or(|road| {
                    // A corner begins on the left of its road, seen from the intersection.
                    let leaves = network.roads[road.index()].from.index() == index;
                    self.has_side(*road, if leaves { Side::Left } else { Side::Right })
                })
            };
            let corners = place.corners.iter().enumerate();
            corners.filter(move |(rank, _)| meant(*rank)).map(move |(_, corner)| (corner.as_slice(), width))
        });
        along.chain(corners)
    }
}
