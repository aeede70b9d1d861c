//! Roads that only got another number: the last ones take those of what is gone. What stands at them stays, and is filed
//! under the new number.

use std::collections::BTreeSet;

use simworld_core::geometry::bounds;
use simworld_core::id::{LaneId, RoadId, SidewalkId};
use simworld_core::net::{NetworkPatch, Road, RoadNetwork};
use simworld_core::patch::{ArrayPatch, Book};

use super::CityEditor;
use super::cells::inflated;
use super::index::now_at;
use super::outskirts::IN_THE_WAY;
use super::streets::with_neighbours;
use crate::block::{Block, Border, sides_round};
use crate::building::Building;
use crate::element::{self, Element, Extent, Setting};
use crate::lot::Land;
use crate::zoning::Zoning;

/// The roads of a change that only got another number: what they had before it, and what they have after it.
#[derive(Clone, Debug, Default)]
pub(super) struct Moved(Vec<[usize; 2]>);

impl Moved {
    /// Those of a change that is done; `back` takes it back.
    fn of(back: &NetworkPatch, network: &RoadNetwork) -> Self {
        let mut moved = Self::default();
        let count = network.roads.len();
        let numbers = || back.roads.set.iter().map(|(road, _)| *road as usize);
        for once in numbers().filter(|road| *road >= count) {
            let is_it = |now: &usize| !moved.has(1, *now) && keeps_its_course(back, network, (once, *now));
            let now = numbers().filter(|road| *road < count).find(is_it);
            moved.0.extend(now.map(|now| [once, now]));
        }
        moved
    }

    /// Whether one of them has a number at one time, 0 before the change and 1 after it.
    fn has(&self, time: usize, road: usize) -> bool {
        self.0.iter().any(|numbers| numbers[time] == road)
    }

    /// The number of a road at one time by that at the other; for one that did not change.
    pub(super) fn number_at(&self, time: usize, other: usize) -> usize {
        let found = self.0.iter().find(|numbers| numbers[1 - time] == other);
        found.map_or(other, |numbers| numbers[time])
    }
}

/// The roads that a change altered, by their numbers before and after it, and those that only got another number.
pub(super) struct Altered {
    pub(super) roads: [BTreeSet<usize>; 2],
    pub(super) moved: Moved,
}

impl CityEditor {
    /// What a change of the roads, which is done, altered; `back` takes it back.
    pub(super) fn altered(&self, back: &NetworkPatch) -> Altered {
        let network = &self.city.network;
        let all = Moved::of(back, network);
        let once: Vec<u32> = back.roads.set.iter().map(|(road, _)| *road).collect();
        let mut roads = [once, now_at(&back.roads, network.roads.len())].map(|roads| {
            let roads = roads.into_iter().map(|road| road as usize);
            roads.filter(|road| !keeps_its_course(back, network, (*road, *road))).collect::<BTreeSet<usize>>()
        });
        for (time, roads) in roads.iter_mut().enumerate() {
            roads.retain(|road| !all.has(time, *road));
        }
        let is_reordered = |numbers: &[usize; 2]| {
            self.leads_open_land(numbers[1]) || self.is_contested(numbers[1], &roads[0], &all)
        };
        let (reordered, moved): (Vec<_>, Vec<_>) = all.0.iter().copied().partition(is_reordered);
        for (time, roads) in roads.iter_mut().enumerate() {
            roads.extend(reordered.iter().map(|numbers| numbers[time]));
        }
        Altered { roads, moved: Moved(moved) }
    }

    /// Whether a road is the first round open land: that is divided in the order of those.
    fn leads_open_land(&self, road: usize) -> bool {
        let network = &self.city.network;
        let leads = |side: &usize| sides_round(network, [*side]).first() == Some(side);
        let is_open = |side: &usize| {
            let faces = Block::of_sides(network, [*side]);
            faces.iter().any(|block| block.area.is_none())
        };
        [2 * road, 2 * road + 1].iter().any(|side| leads(side) && is_open(side))
    }

    /// Whether something behind the sidewalks of a road that got another number, this one, would like to stand where something of a
    /// road near by would: that at the first road has the place.
    fn is_contested(&self, road: usize, altered: &BTreeSet<usize>, moved: &Moved) -> bool {
        let network = &self.city.network;
        let Some(around) = bounds(&network.roads[road].centerline) else { return true };
        let around = inflated(around, IN_THE_WAY);
        let near = self.index.roads.near(around).into_iter().filter(|road| !altered.contains(road));
        let near: BTreeSet<usize> = near.map(|road| moved.number_at(1, road)).collect();
        // How far a junction reaches into a street depends on the streets at the other end.
        let part = self.city.plan.part(with_neighbours(network, with_neighbours(network, near.clone())));
        let local = |road: usize| part.street(road).map(RoadId::from_index);
        let Some(own) = local(road) else { return true };
        let Ok(network) = RoadNetwork::derive(&part.plan, &self.city.config.network) else { return true };
        let at = |road: &usize| self.index.buildings_at(moved.number_at(0, *road));
        let buildings = near.iter().flat_map(|road| at(road).iter().map(move |number| (*road, *number)));
        let buildings: Vec<Building> = buildings
            .filter_map(|(road, number)| {
                Some(Building { road: local(road)?, ..self.city.buildings[number as usize].clone() })
            })
            .collect();
        let (provenance, config) = (&self.city.provenance, &self.city.config);
        let zoning = Zoning::new(&config.zoning, provenance.seed);
        let sides = part.streets.iter().map(|street| [near.contains(street); 2]).collect();
        let setting = Setting {
            plan: &part.plan,
            network: &network,
            zoning: &zoning,
            land: &Land::default(),
            buildings: &buildings,
            within: Some(&Extent { streets: part.streets.len(), sides }),
        };
        element::is_contested(&setting, &config.elements, provenance.seed, own)
    }

    /// Files what stands at roads that only got another number under the new one; gives what takes that back.
    pub(super) fn renumber(&mut self, moved: &Moved) -> (ArrayPatch<Building>, ArrayPatch<Element>) {
        let (index, city) = (&self.index, &mut self.city);
        let mut buildings = Book::open(&mut city.buildings);
        let mut elements = Book::open(&mut city.elements);
        for [once, now] in &moved.0 {
            let road = RoadId::from_index(*now);
            for number in index.buildings_at(*once) {
                buildings.edit(*number as usize).road = road;
            }
            for number in index.elements_at(*once) {
                let along = &mut elements.edit(*number as usize).along;
                let side = along.as_street().map(|(_, side)| side);
                *along = side.map_or(*along, |side| Border::street(road, side));
            }
        }
        (buildings.close(), elements.close())
    }
}

/// Whether a road, by its numbers before a change and after it, is as it was but for numbers; `back` takes the change back.
fn keeps_its_course(back: &NetworkPatch, network: &RoadNetwork, (once, now): (usize, usize)) -> bool {
    fn old<T>(patch: &ArrayPatch<T>, index: usize) -> Option<&T> {
        let rank = patch.set.binary_search_by_key(&(index as u32), |(number, _)| *number).ok()?;
        Some(&patch.set[rank].1)
    }
    let (Some(before), Some(now)) = (old(&back.roads, once), network.roads.get(now)) else { return false };
    let path = |walk: Option<SidewalkId>| walk.map(|walk| &network.sidewalks[walk.index()].path);
    let old_path = |walk: Option<SidewalkId>| {
        let walk = walk?.index();
        old(&back.sidewalks, walk).or_else(|| network.sidewalks.get(walk)).map(|walk| &walk.path)
    };
    let same_walks = (0..2).all(|side| old_path(before.sidewalks[side]) == path(now.sidewalks[side]));
    let lane = |lane: LaneId| network.lanes.get(lane.index()).map(|lane| &lane.path);
    let old_lane = |id: LaneId| old(&back.lanes, id.index()).map(|lane| &lane.path).or_else(|| lane(id));
    let same_lanes = before.lanes().count() == now.lanes().count()
        && before.lanes().zip(now.lanes()).all(|(before, now)| old_lane(before) == lane(now));
    // All else of the road, but for the numbers.
    let Road { forward, backward, cycle, sidewalks, from, to, .. } = now.clone();
    same_walks
        && same_lanes
        && Road { forward, backward, cycle, sidewalks, from, to, ..before.clone() } == *now
}

#[cfg(test)]
mod tests {
    use simworld_core::seed::Seed;

    use super::*;
    use crate::graph::StreetId;
    use crate::{City, CityConfig, Style};

    #[test]
    fn a_road_that_takes_a_free_number_is_not_altered() {
        let config = CityConfig { roads: Style::Mixed.roads(400), ..CityConfig::default() };
        let city = City::generate(&config, Seed(3)).expect("presets are valid");
        let last = city.network.roads.len() - 1;
        let mut editor = CityEditor::new(city);
        let mut left_alone = 0;
        for gone in (20..last - 20).step_by(40) {
            let part = editor.city.plan.part(with_neighbours(&editor.city.network, [gone].into()));
            let local = StreetId(part.street(gone).expect("it is one of its part") as u32);
            let changed = editor.change_streets(part, |graph| graph.remove_street(local), None);
            let Ok(changed) = changed else { continue };
            let Altered { roads: [once, now], moved } = editor.altered(&changed.network);
            // The road that is gone, those that met it, and no others.
            assert!(once.contains(&gone) && once.len() <= 10, "{gone}: {once:?}");
            if moved.has(0, last) {
                left_alone += 1;
                assert!(!once.contains(&last) && !now.contains(&moved.number_at(1, last)), "{gone}");
                assert_eq!(moved.number_at(0, moved.number_at(1, last)), last);
            }
            changed.plan.put_on(&mut editor.city.plan).expect("it was taken from there");
            editor.network_mut().put(changed.network).expect("it was taken from there");
        }
        assert!(left_alone >= 4, "the last road came away unaltered {left_alone} times");
    }
}
