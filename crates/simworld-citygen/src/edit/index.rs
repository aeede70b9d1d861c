//! What stands where, kept beside a city while it is edited.

use std::collections::BTreeSet;

use simworld_core::geometry::{Point2, bounds};

use super::cells::{Bounds, Cells, inflated};
use super::patch::CityPatch;
use crate::City;
use crate::building::Building;
use crate::element::Element;

/// Farthest distance of the middle of a thing from its street that is looked at, m.
const FARTHEST: f64 = 260.0;

/// Buildings and elements by their roads, roads and all else by their places, names that are given.
#[derive(Clone, Debug)]
pub(super) struct Index {
    pub(super) roads: Cells,
    /// By road.
    buildings: Vec<Vec<u32>>,
    elements: Vec<Vec<u32>>,
    /// Elements that were given.
    given: Cells,
    pub(super) names: BTreeSet<String>,
    /// How many buildings were given, and how many follow from the land.
    given_buildings: usize,
    raised_buildings: usize,
}

fn road_bounds(city: &City, road: usize) -> Option<Bounds> {
    bounds(&city.network.roads[road].centerline)
}

fn around(point: Point2) -> Bounds {
    (point, point)
}

impl Index {
    pub(super) fn of(city: &City) -> Self {
        let count = city.network.roads.len();
        let mut index = Self {
            roads: Cells::default(),
            buildings: vec![Vec::new(); count],
            elements: vec![Vec::new(); count],
            given: Cells::default(),
            names: BTreeSet::new(),
            given_buildings: 0,
            raised_buildings: 0,
        };
        (0..count).for_each(|road| index.file_road(city, road));
        (0..).zip(&city.buildings).for_each(|(number, building)| index.file_building(number, building));
        (0..).zip(&city.elements).for_each(|(number, element)| index.file_element(number, element));
        index
    }

    fn file_road(&mut self, city: &City, road: usize) {
        if let Some(bounds) = road_bounds(city, road) {
            self.roads.insert(road, bounds);
        }
    }

    fn file_building(&mut self, number: u32, building: &Building) {
        self.names.extend(building.name.clone());
        *self.count_of(building) += 1;
        list_of(&mut self.buildings, building.road.index()).push(number);
    }

    fn count_of(&mut self, building: &Building) -> &mut usize {
        if building.given { &mut self.given_buildings } else { &mut self.raised_buildings }
    }

    /// Whether the buildings are those of a map: where it has none the land is empty.
    pub(super) fn has_mapped_buildings(&self) -> bool {
        self.given_buildings > 0 && self.raised_buildings == 0
    }

    fn file_element(&mut self, number: u32, element: &Element) {
        match element.along.as_street() {
            Some((road, _)) => list_of(&mut self.elements, road.index()).push(number),
            None => self.given.insert(number as usize, around(element.position)),
        }
    }

    /// Follows a change of a city that is done; `back` is what takes it back.
    pub(super) fn follow(&mut self, city: &City, back: &CityPatch) {
        for (road, old) in &back.network.roads.set {
            if let Some(bounds) = bounds(&old.centerline) {
                self.roads.remove(*road as usize, bounds);
            }
        }
        for (number, old) in &back.buildings.set {
            if let Some(name) = &old.name {
                self.names.remove(name);
            }
            *self.count_of(old) -= 1;
            list_of(&mut self.buildings, old.road.index()).retain(|other| other != number);
        }
        for (number, old) in &back.elements.set {
            match old.along.as_street() {
                Some((road, _)) => list_of(&mut self.elements, road.index()).retain(|other| other != number),
                None => self.given.remove(*number as usize, around(old.position)),
            }
        }
        for road in now_at(&back.network.roads, city.network.roads.len()) {
            self.file_road(city, road as usize);
        }
        for number in now_at(&back.buildings, city.buildings.len()) {
            self.file_building(number, &city.buildings[number as usize]);
        }
        for number in now_at(&back.elements, city.elements.len()) {
            self.file_element(number, &city.elements[number as usize]);
        }
    }

    /// The buildings at a road.
    pub(super) fn buildings_at(&self, road: usize) -> &[u32] {
        self.buildings.get(road).map_or(&[], Vec::as_slice)
    }

    /// The generated elements along a road.
    pub(super) fn elements_at(&self, road: usize) -> &[u32] {
        self.elements.get(road).map_or(&[], Vec::as_slice)
    }

    /// The buildings that may stand near a rectangle, ascending.
    pub(super) fn buildings_near(&self, bounds: Bounds) -> BTreeSet<usize> {
        let roads = self.roads.near(inflated(bounds, FARTHEST));
        roads.iter().flat_map(|road| self.buildings_at(*road)).map(|number| *number as usize).collect()
    }

    /// The elements that may stand near a rectangle, ascending.
    pub(super) fn elements_near(&self, bounds: Bounds) -> BTreeSet<usize> {
        let roads = self.roads.near(inflated(bounds, FARTHEST));
        let along = roads.iter().flat_map(|road| self.elements_at(*road)).map(|number| *number as usize);
        along.chain(self.given_near(bounds)).collect()
    }

    /// The given elements that may stand near a rectangle.
    pub(super) fn given_near(&self, bounds: Bounds) -> BTreeSet<usize> {
        self.given.near(bounds)
    }
}

/// The numbers of the entries that a change set, as they are after it.
pub(super) fn now_at<T>(back: &simworld_core::patch::ArrayPatch<T>, len: usize) -> Vec<u32> {
    let overwritten = back.set.iter().map(|(number, _)| *number).filter(|number| (*number as usize) < len);
    overwritten.chain(back.len..len as u32).collect()
}

fn list_of(lists: &mut Vec<Vec<u32>>, road: usize) -> &mut Vec<u32> {
    if road >= lists.len() {
        lists.resize(road + 1, Vec::new());
    }
    &mut lists[road]
}
