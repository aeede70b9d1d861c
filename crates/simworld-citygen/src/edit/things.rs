//! Edits of single buildings and elements.

use std::collections::BTreeSet;

use simworld_core::geometry::{Point2, bounds};
use simworld_core::ops::wrap_angle;
use simworld_core::patch::{ArrayPatch, Book};

use super::cells::{Bounds, inflated};
use super::{CityEditor, CityPatch, EditError, missing};
use crate::block::Border;
use crate::building::Building;
use crate::doors::FARTHEST_DOOR;
use crate::element::Element;
use crate::occupancy::{Occupancy, overlap};
use crate::zoning::Zoning;

/// The rectangle round some pieces of ground.
fn around(ground: &[Vec<Point2>]) -> Option<Bounds> {
    bounds(ground.iter().flatten())
}

fn meet(a: &[Vec<Point2>], b: &[Vec<Point2>]) -> bool {
    a.iter().any(|a| b.iter().any(|b| overlap(a, b)))
}

fn ground_of(element: &Element) -> Vec<Vec<Point2>> {
    vec![element.obb().footprint().to_vec()]
}

fn taken(at: Point2, by: impl Into<String>) -> EditError {
    EditError::Taken { x: at.x, y: at.y, by: by.into() }
}

impl CityEditor {
    pub(super) fn add_building(&mut self, building: &Building) -> Result<CityPatch, EditError> {
        let mut building = self.fitted(building.clone())?;
        let gone = self.room_for(&building, None)?;
        let seed = self.city.provenance.seed;
        if building.name.is_none() {
            let names = &self.index.names;
            building.name = crate::building::name_for(&building, seed, |name| names.contains(name));
        }
        Ok(self.exchange(&[], vec![building], &gone, Vec::new()))
    }

    pub(super) fn move_building(
        &mut self,
        number: usize,
        to: Point2,
        facing: f64,
    ) -> Result<CityPatch, EditError> {
        missing("building", number, self.city.buildings.len())?;
        let moved =
            Building { center: to, facing: wrap_angle(facing), ..self.city.buildings[number].clone() };
        let building = self.fitted(moved)?;
        let gone = self.room_for(&building, Some(number))?;
        Ok(self.exchange(&[number], vec![building], &gone, Vec::new()))
    }

    pub(super) fn remove_building(&mut self, number: usize) -> Result<CityPatch, EditError> {
        missing("building", number, self.city.buildings.len())?;
        Ok(self.exchange(&[number], Vec::new(), &[], Vec::new()))
    }

    pub(super) fn add_element(&mut self, element: Element) -> Result<CityPatch, EditError> {
        let element = self.room_for_element(element, None)?;
        Ok(self.exchange(&[], Vec::new(), &[], vec![element]))
    }

    pub(super) fn move_element(
        &mut self,
        number: usize,
        to: Point2,
        facing: f64,
    ) -> Result<CityPatch, EditError> {
        missing("element", number, self.city.elements.len())?;
        let moved = Element { position: to, facing: wrap_angle(facing), ..self.city.elements[number] };
        let element = self.room_for_element(moved, Some(number))?;
        Ok(self.exchange(&[], Vec::new(), &[number], vec![element]))
    }

    pub(super) fn remove_element(&mut self, number: usize) -> Result<CityPatch, EditError> {
        missing("element", number, self.city.elements.len())?;
        Ok(self.exchange(&[], Vec::new(), &[number], Vec::new()))
    }

    /// A building of possible size, with what follows from where it stands.
    fn fitted(&self, building: Building) -> Result<Building, EditError> {
        // Its door is set below.
        let building =
            Building { access: building.center, frontage: building.width, given: true, ..building };
        if !building.is_sound() || building.storeys == 0 {
            return Err(EditError::Size { what: "building" });
        }
        let (x, y) = (building.center.x, building.center.y);
        let zoning = Zoning::new(&self.city.config.zoning, self.city.provenance.seed);
        let zone = zoning.zone(building.center);
        self.with_door(Building { zone, ..building }).ok_or(EditError::NoStreet {
            x,
            y,
            reach: FARTHEST_DOOR,
        })
    }

    /// Whether a building has room; gives the generated elements that stand in its way.
    fn room_for(&self, building: &Building, but: Option<usize>) -> Result<Vec<usize>, EditError> {
        let ground = building.ground();
        let Some(near) = around(&ground) else { return Err(EditError::Size { what: "building" }) };
        if !self.roads_free(near, &ground) {
            return Err(taken(building.center, "a road"));
        }
        for number in self.index.buildings_near(near).into_iter().filter(|number| Some(*number) != but) {
            let other = &self.city.buildings[number];
            if meet(&other.ground(), &ground) {
                let name = other.name.as_deref().unwrap_or(other.archetype.name);
                return Err(taken(other.center, format!("building {number}, {name}")));
            }
        }
        let mut gone = Vec::new();
        for number in self.index.elements_near(near) {
            let element = &self.city.elements[number];
            if meet(&ground_of(element), &ground) {
                if !element.along.is_street() {
                    return Err(taken(element.position, format!("element {number}, a {}", element.kind)));
                }
                gone.push(number);
            }
        }
        Ok(gone)
    }

    /// An element that has room, in no lane that is driven on.
    fn room_for_element(&self, element: Element, but: Option<usize>) -> Result<Element, EditError> {
        if !element.is_sound() {
            return Err(EditError::Size { what: "element" });
        }
        let element = Element { along: Border::LAND, ..element };
        let ground = ground_of(&element);
        let Some(near) = around(&ground) else { return Err(EditError::Size { what: "element" }) };
        if !self.lanes_free(near, &ground) {
            return Err(taken(element.position, "a lane that is driven on"));
        }
        for number in self.index.buildings_near(near) {
            if meet(&self.city.buildings[number].ground(), &ground) {
                return Err(taken(element.position, format!("building {number}")));
            }
        }
        for number in self.index.elements_near(near).into_iter().filter(|number| Some(*number) != but) {
            let other = &self.city.elements[number];
            if meet(&ground_of(other), &ground) {
                return Err(taken(other.position, format!("element {number}, a {}", other.kind)));
            }
        }
        Ok(element)
    }

    /// Whether no road, with its sidewalks, lies on a piece of ground.
    fn roads_free(&self, near: Bounds, ground: &[Vec<Point2>]) -> bool {
        let network = &self.city.network;
        let mut roads = self.index.roads.near(inflated(near, 60.0));
        roads.retain(|road| network.roads[*road].level == 0);
        let land = Occupancy::of_few_roads(network, &roads);
        ground.iter().all(|piece| land.is_free(piece))
    }

    /// Whether no lane that is driven on lies on a piece of ground.
    fn lanes_free(&self, near: Bounds, ground: &[Vec<Point2>]) -> bool {
        let network = &self.city.network;
        let mut lanes = Occupancy::default();
        let mut junctions = BTreeSet::new();
        for road in self.index.roads.near(inflated(near, 30.0)) {
            let road = &network.roads[road];
            junctions.extend([road.from, road.to]);
            for lane in road.forward.iter().chain(&road.backward) {
                let lane = &network.lanes[lane.index()];
                lanes.add_path(&lane.path, (lane.width * 0.5, lane.width * 0.5));
            }
        }
        for way in junctions.iter().flat_map(|place| &network.intersections[place.index()].connections) {
            let way = &network.connections[way.index()];
            let half = network.lanes[way.from.index()].width * 0.5;
            lanes.add_path(&way.path, (half, half));
        }
        ground.iter().all(|piece| lanes.is_free(piece))
    }

    /// Takes some things out and puts others in.
    fn exchange(
        &mut self,
        buildings_out: &[usize],
        buildings_in: Vec<Building>,
        elements_out: &[usize],
        elements_in: Vec<Element>,
    ) -> CityPatch {
        let nothing = CityPatch::unchanged(&self.city);
        let patch = CityPatch {
            buildings: exchanged(&mut self.city.buildings, buildings_out, buildings_in),
            elements: exchanged(&mut self.city.elements, elements_out, elements_in),
            ..nothing
        };
        self.index.follow(&self.city, &patch);
        patch
    }
}

fn exchanged<T: Clone>(array: &mut Vec<T>, out: &[usize], new: Vec<T>) -> ArrayPatch<T> {
    let mut book = Book::open(array);
    for number in out {
        book.vacate(*number);
    }
    for thing in new {
        book.fill(thing);
    }
    while book.close_gap().is_some() {}
    book.close()
}
