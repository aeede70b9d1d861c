//! After a change of streets: the land on both their sides is divided and built on anew.

use std::collections::{BTreeMap, BTreeSet};

use simworld_core::geometry::{Point2, bounds};
use simworld_core::net::NetworkPatch;

use super::cells::{Bounds, inflated};
use super::faces::{Faces, Given, place_key, side_number};
use super::moved::Altered;
use super::outskirts::Outskirts;
use super::patch::CityPatch;
use super::scope::{Change, Scope};
use super::sides::{Changed, both_faces};
use super::streets::StreetsChanged;
use super::{CityEditor, EditError};
use crate::building::Building;
use crate::doors::{self, FARTHEST_DOOR};
use crate::element::Element;
use crate::occupancy::Occupancy;

/// Given elements as near as this to a road that changed may stand on it, m.
const GIVEN_NEAR: f64 = 100.0;

/// What stood round the streets before they changed.
pub(super) struct Before {
    /// What was built and set along all sides round their faces.
    pub(super) buildings: Vec<usize>,
    pub(super) elements: Vec<usize>,
    /// The given buildings at the roads that changed.
    given: BTreeSet<usize>,
    frontage: f64,
    land: Occupancy,
}

/// What stands now where something was.
#[derive(Default)]
pub(super) struct After {
    pub(super) buildings: Vec<Building>,
    pub(super) elements: Vec<Element>,
    /// Given buildings that moved to another road or door, and those that have no room any more.
    pub(super) doors: Vec<(usize, Building)>,
    pub(super) buildings_gone: BTreeSet<usize>,
    pub(super) elements_gone: BTreeSet<usize>,
    frontage: f64,
}

impl CityEditor {
    /// Repairs what stands at streets that changed; gives the patch that takes all of it back.
    pub(super) fn follow_streets(&mut self, changed: StreetsChanged) -> Result<CityPatch, EditError> {
        let StreetsChanged { plan, network } = changed;
        let altered = self.altered(&network);
        // Back to the streets as they were, for a look at their faces.
        let plan = plan.put_on(&mut self.city.plan)?;
        let (network, [scope, scope_now]) = self.scopes(network, &altered)?;
        let [roads, roads_now] = &altered.roads;
        let before = self.before(roads, &scope);
        let plan = plan.put_on(&mut self.city.plan)?;
        let network = self.network_mut().put(network)?;
        let (buildings, elements) = self.renumber(&altered.moved);
        let mut patch = CityPatch { plan, network, buildings, elements, frontage: self.city.frontage };
        // Roads first, for they are looked for by place.
        self.index.follow(&self.city, &patch);
        let after = before.and_then(|before| Ok((self.after(&before, roads_now, &scope_now)?, before)));
        match after {
            Ok((after, before)) => {
                self.city.frontage += after.frontage - before.frontage;
                let (buildings, elements) = self.replace(&before, after);
                let last = CityPatch { buildings, elements, ..CityPatch::unchanged(&self.city) };
                self.index.follow(&self.city, &last);
                patch.buildings = patch.buildings.after(last.buildings);
                patch.elements = patch.elements.after(last.elements);
                Ok(patch)
            }
            Err(error) => {
                self.put(patch)?;
                Err(error)
            }
        }
    }

    /// What of the land a change of the roads, which has been taken back, has made anew, before and after; leaves the roads as they were.
    pub(super) fn scopes(
        &mut self,
        network: NetworkPatch,
        altered: &Altered,
    ) -> Result<(NetworkPatch, [Scope; 2]), EditError> {
        let [roads, roads_now] = &altered.roads;
        let changed = Changed { roads: [roads, roads_now], moved: &altered.moved, near: &self.index.roads };
        let roads_of_city = std::sync::Arc::make_mut(&mut self.city.network);
        let (network, [sides, sides_now]) = both_faces(roads_of_city, network, &changed)?;
        let mut courses = self.courses(roads);
        let faces = Outskirts::of(&self.city, &sides);
        let network = self.network_mut().put(network)?;
        courses.extend(self.courses(roads_now));
        let faces_now = Outskirts::of(&self.city, &sides_now);
        let network = self.network_mut().put(network)?;
        let change = Change { faces: [faces, faces_now], altered, courses };
        Ok((network, change.scopes()))
    }

    /// Rectangles round the courses of some roads.
    fn courses(&self, roads: &BTreeSet<usize>) -> Vec<Bounds> {
        roads.iter().filter_map(|road| bounds(&self.city.network.roads[*road].centerline)).collect()
    }

    fn before(&self, roads: &BTreeSet<usize>, scope: &Scope) -> Result<Before, EditError> {
        let faces = Faces::of(&self.city, &self.index.roads, scope)?;
        Ok(Before {
            buildings: self.generated_buildings(&scope.sides).collect(),
            elements: self.generated_elements(&scope.sides).collect(),
            given: self.given_at(roads),
            frontage: faces.land.frontage,
            land: faces.land_of_roads(roads),
        })
    }

    /// Builds on the faces round the roads that changed.
    fn after(&self, before: &Before, roads: &BTreeSet<usize>, scope: &Scope) -> Result<After, EditError> {
        let city = &self.city;
        let mut faces = Faces::of(city, &self.index.roads, scope)?;
        let land = faces.land_of_roads(roads);
        // What overlapped a road before may do so again.
        let has_room = |ground: &[Vec<Point2>]| {
            ground.iter().all(|piece| land.is_free(piece) || !before.land.is_free(piece))
        };
        let mut after = After { frontage: faces.land.frontage, ..After::default() };
        self.set_doors(before, roads, has_room, &mut after);
        let courses = self.courses(roads).into_iter();
        let given: BTreeSet<usize> =
            courses.flat_map(|around| self.index.given_near(inflated(around, GIVEN_NEAR))).collect();
        let (stay, gone): (Vec<usize>, Vec<usize>) = given
            .into_iter()
            .partition(|number| has_room(&[city.elements[*number].obb().footprint().to_vec()]));
        after.elements_gone.extend(gone);
        let moved: BTreeMap<usize, &Building> =
            after.doors.iter().map(|(number, there)| (*number, there)).collect();
        let round = self.given_round(&scope.all, &before.given);
        let round = round.iter().filter(|number| !after.buildings_gone.contains(number));
        let given = Given {
            is_mapped: city.provenance.origin.is_some() && self.index.has_mapped_buildings(),
            buildings: round
                .map(|number| moved.get(number).copied().unwrap_or(&city.buildings[*number]))
                .collect(),
            elements: stay.into_iter().map(|number| &city.elements[number]).collect(),
        };
        let present = before.buildings.iter().copied().chain(self.generated_buildings(&scope.all));
        let uses: BTreeMap<[u64; 2], &Building> = present
            .map(|number| &city.buildings[number])
            .map(|building| (place_key(building.center), building))
            .collect();
        (after.buildings, after.elements) = faces.build(&given, &uses);
        Ok(after)
    }

    /// Finds the given buildings that have no room any more, and the doors of those whose roads changed.
    fn set_doors(
        &self,
        before: &Before,
        roads: &BTreeSet<usize>,
        has_room: impl Fn(&[Vec<Point2>]) -> bool,
        after: &mut After,
    ) {
        let mut near = before.given.clone();
        near.extend(self.courses(roads).into_iter().flat_map(|around| self.index.buildings_near(around)));
        for number in near.into_iter().filter(|number| self.city.buildings[*number].given) {
            let building = &self.city.buildings[number];
            let is_lost = before.given.contains(&number);
            let door = if is_lost { self.with_door(building.clone()) } else { Some(building.clone()) };
            match door.filter(|building| has_room(&building.ground())) {
                Some(there) if is_lost => after.doors.push((number, there)),
                Some(_) => {}
                None => {
                    after.buildings_gone.insert(number);
                }
            }
        }
    }

    /// The generated buildings on some sides of streets.
    fn generated_buildings<'a>(&'a self, sides: &'a BTreeSet<usize>) -> impl Iterator<Item = usize> + 'a {
        at_roads(sides).flat_map(|road| self.index.buildings_at(road)).map(|number| *number as usize).filter(
            |number| {
                let building = &self.city.buildings[*number];
                !building.given && sides.contains(&side_number(building.road, building.side))
            },
        )
    }

    /// The generated elements on some sides of streets.
    fn generated_elements<'a>(&'a self, sides: &'a BTreeSet<usize>) -> impl Iterator<Item = usize> + 'a {
        at_roads(sides).flat_map(|road| self.index.elements_at(road)).map(|number| *number as usize).filter(
            |number| {
                let along = self.city.elements[*number].along.as_street();
                along.is_some_and(|(road, side)| sides.contains(&side_number(road, side)))
            },
        )
    }

    fn given_at(&self, roads: &BTreeSet<usize>) -> BTreeSet<usize> {
        let all = roads.iter().flat_map(|road| self.index.buildings_at(*road));
        all.map(|number| *number as usize).filter(|number| self.city.buildings[*number].given).collect()
    }

    /// The given buildings near enough to some faces to take room there, and those that lost their roads.
    fn given_round(&self, sides: &BTreeSet<usize>, lost: &BTreeSet<usize>) -> BTreeSet<usize> {
        let near = self
            .courses(&at_roads(sides).collect())
            .into_iter()
            .flat_map(|around| self.index.buildings_near(around));
        let given = near.filter(|number| self.city.buildings[*number].given);
        given.chain(lost.iter().copied()).collect()
    }

    /// A building with the door at the nearest sidewalk; `None` if there is none within reach.
    pub(super) fn with_door(&self, mut building: Building) -> Option<Building> {
        let network = &self.city.network;
        let near = self.index.roads.near(inflated((building.center, building.center), FARTHEST_DOOR));
        let walks = near.into_iter().flat_map(|road| network.roads[road].sidewalks).flatten();
        let walks = walks.map(|walk| walk.index() as u32);
        let door = doors::nearest_of(network, walks, building.center, FARTHEST_DOOR)?;
        (building.access, building.road, building.side) = (door.at, door.road, door.side);
        Some(building)
    }
}

/// The roads of some sides, each once.
fn at_roads(sides: &BTreeSet<usize>) -> impl Iterator<Item = usize> + '_ {
    let mut last = None;
    sides.iter().map(|side| side / 2).filter(move |road| last.replace(*road) != Some(*road))
}
