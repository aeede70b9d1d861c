//! What houses are used for: exactly so many of each use that is named, and those of which it is said where they are.

use std::collections::BTreeMap;

use simworld_core::geometry::Point2;
use simworld_core::scene::Place;
use simworld_core::spec::FeatureWish;

use super::SettlementRemark;
use super::aim::Aim;
use super::extent::{Extent, middle_of};
use super::layout::{Laid, remarks};
use crate::City;
use crate::building::Building;

/// A small house is as bad a place as one so much farther off: as many metres as this over its area, m².
const SMALL: f64 = 1500.0;

/// Gives houses their uses; gives what is otherwise than it was asked for.
pub(super) fn use_as(city: &mut City, wish: &FeatureWish, laid: &Laid) -> Vec<SettlementRemark> {
    let extent = Extent::of(&city.buildings, None);
    let mut uses = Uses { fixed: vec![false; city.buildings.len()], city, wanted: &wish.places };
    let mut told = Vec::new();
    for site in &wish.sites {
        let Some(place) = Place::from_name(&site.what) else { continue };
        let aim = Aim::of(site, extent, &wish.waters, &uses.city.buildings, laid);
        if let Some((name, at)) = uses.put(place, &aim) {
            told.extend(remarks(&name, Some(site), &aim, at));
        }
    }
    uses.count();
    told
}

struct Uses<'a> {
    city: &'a mut City,
    wanted: &'a BTreeMap<Place, u32>,
    /// Houses of which it was said where they are.
    fixed: Vec<bool>,
}

impl Uses<'_> {
    /// Gives the best house for an aim a use; what it is called then, and where it stands.
    fn put(&mut self, place: Place, aim: &Aim) -> Option<(String, Point2)> {
        let cost = |one: &Building| aim.cost(one.center) + SMALL / one.footprint_area().max(1.0);
        let free = self.city.buildings.iter().enumerate().filter(|(index, _)| !self.fixed[*index]);
        let (index, _) = free.min_by(|a, b| cost(a.1).total_cmp(&cost(b.1)).then(a.0.cmp(&b.0)))?;
        let before = self.city.buildings.iter().zip(&self.fixed);
        let before = before.filter(|(one, fixed)| **fixed && one.place == place).count();
        let name = name_of(place, before, self.city.provenance.title.as_deref());
        self.fixed[index] = true;
        let building = &mut self.city.buildings[index];
        (building.place, building.name) = (place, Some(name.clone()));
        Some((name, building.center))
    }

    /// Has exactly so many houses of each use that is named: the largest near the middle take it on, and what is too much is lived
    /// in.
    fn count(&mut self) {
        let middle = middle_of(&self.city.buildings);
        for (place, count) in self.wanted {
            let mut have: Vec<usize> = (0..self.city.buildings.len())
                .filter(|index| self.city.buildings[*index].place == *place)
                .collect();
            // Of those that are too many none goes of which it was said where it is.
            have.sort_by_key(|index| (!self.fixed[*index], *index));
            for index in have.split_off(have.len().min(*count as usize)) {
                let building = &mut self.city.buildings[index];
                (building.place, building.name) = (Place::Home, None);
            }
            for number in have.len()..*count as usize {
                let fit = |one: &Building| one.footprint_area() / (50.0 + (one.center - middle).norm());
                let houses = self.city.buildings.iter().enumerate();
                let free = houses.filter(|(_, one)| !self.wanted.contains_key(&one.place));
                let best = free.max_by(|a, b| fit(a.1).total_cmp(&fit(b.1)).then(b.0.cmp(&a.0)));
                let Some(index) = best.map(|(index, _)| index) else { return };
                let name = name_of(*place, number, self.city.provenance.title.as_deref());
                let building = &mut self.city.buildings[index];
                (building.place, building.name) = (*place, Some(name));
            }
        }
    }
}

/// "Little Haven Museum", "Second Museum".
fn name_of(place: Place, number: usize, title: Option<&str>) -> String {
    let mut word = place.as_str().replace('_', " ");
    if let Some(first) = word.get_mut(..1) {
        first.make_ascii_uppercase();
    }
    match number {
        0 => format!("{} {word}", title.unwrap_or("Town")),
        1 => format!("Second {word}"),
        2 => format!("Third {word}"),
        more => format!("{word} {}", more + 1),
    }
}
