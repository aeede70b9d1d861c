//! Streets of one name, joined road to road into lines long enough to letter.

use std::collections::{BTreeMap, BTreeSet};

use simworld_core::geometry::Point2;
use simworld_core::net::{RoadClass, polyline};

use crate::City;

/// A line of roads of one name.
pub(super) struct Chain {
    pub(super) name: u32,
    pub(super) class: RoadClass,
    pub(super) line: Vec<Point2>,
    pub(super) length: f64,
}

/// The longest chain of every name, the most important first.
pub(super) fn of(city: &City) -> Vec<Chain> {
    let network = &city.network;
    // Names repeat: every road has its own entry where streets come from a map.
    let mut by_name: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    for (index, road) in network.roads.iter().enumerate() {
        if let Some(name) = road.name.and_then(|name| network.names.get(name as usize)) {
            by_name.entry(name).or_default().push(index);
        }
    }
    let mut chains: Vec<Chain> = by_name.into_values().filter_map(|roads| longest(city, &roads)).collect();
    chains
        .sort_by(|a, b| b.class.cmp(&a.class).then(b.length.total_cmp(&a.length)).then(a.name.cmp(&b.name)));
    chains
}

fn longest(city: &City, roads: &[usize]) -> Option<Chain> {
    let mut ends: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
    for index in roads {
        let road = &city.network.roads[*index];
        ends.entry(road.from.0).or_default().push(*index);
        ends.entry(road.to.0).or_default().push(*index);
    }
    let mut used: BTreeSet<usize> = BTreeSet::new();
    let mut best: Option<Vec<Point2>> = None;
    for start in roads {
        if !used.insert(*start) {
            continue;
        }
        let road = &city.network.roads[*start];
        let mut line = road.centerline.clone();
        grow(city, &ends, road.to.0, &mut line, &mut used);
        line.reverse();
        grow(city, &ends, road.from.0, &mut line, &mut used);
        if best.as_ref().is_none_or(|best| polyline::length(&line) > polyline::length(best)) {
            best = Some(line);
        }
    }
    let line = best?;
    let first = &city.network.roads[*roads.first()?];
    Some(Chain { name: first.name?, class: first.class, length: polyline::length(&line), line })
}

/// Goes on from the end of a line, each time along the unused road that bends least.
fn grow(
    city: &City,
    ends: &BTreeMap<u32, Vec<usize>>,
    mut node: u32,
    line: &mut Vec<Point2>,
    used: &mut BTreeSet<usize>,
) {
    loop {
        let [.., before, last] = line.as_slice() else { return };
        let ahead = (last - before).normalize();
        let next = ends.get(&node).into_iter().flatten().filter(|road| !used.contains(road));
        let straightness = |index: &usize| {
            let (_, line) = leaving(city, *index, node);
            (line[1] - line[0]).normalize().dot(&ahead)
        };
        let Some(road) =
            next.copied().max_by(|a, b| straightness(a).total_cmp(&straightness(b)).then(b.cmp(a)))
        else {
            return;
        };
        if straightness(&road) < 0.7 {
            return;
        }
        used.insert(road);
        let (to, path) = leaving(city, road, node);
        line.extend_from_slice(&path[1..]);
        node = to;
    }
}

/// A road as it leaves a node: the other end and the centreline.
fn leaving(city: &City, road: usize, node: u32) -> (u32, Vec<Point2>) {
    let road = &city.network.roads[road];
    if road.from.0 == node {
        (road.to.0, road.centerline.clone())
    } else {
        (road.from.0, polyline::reversed(&road.centerline))
    }
}
