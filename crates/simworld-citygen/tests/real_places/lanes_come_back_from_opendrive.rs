//! Real places written as OpenDRIVE and read again: every lane leads where it did, by whatever arrows and signs.
#![cfg(all(feature = "osm", feature = "opendrive"))]

use std::collections::{BTreeMap, BTreeSet};

use simworld_citygen::City;
use simworld_citygen::CityConfig;
use simworld_citygen::files::opendrive::OpenDrive;
use simworld_citygen::osm::PlaceOptions;
use simworld_core::id::LaneId;
use simworld_core::net::{NetworkConfig, RoadNetwork};
use simworld_core::seed::Seed;

use crate::osm_common::all_real;

/// A lane: its road, its list (along, against, bicycles), and its rank there.
type Lane = (usize, usize, usize);

fn lanes(network: &RoadNetwork) -> BTreeMap<LaneId, Lane> {
    let mut places = BTreeMap::new();
    for (index, road) in network.roads.iter().enumerate() {
        for (list, lanes) in [&road.forward, &road.backward, &road.cycle].into_iter().enumerate() {
            places.extend(lanes.iter().enumerate().map(|(rank, lane)| (*lane, (index, list, rank))));
        }
    }
    places
}

/// The road in the file of each street that was read, if that can be told: roads that were left out are told by warnings,
/// and bridges are parts of their own, in order.
fn roads_of(read: &OpenDrive, count: usize) -> Option<Vec<usize>> {
    let plan = &read.plan;
    let is_gone = |road: &usize| {
        let road = road.to_string();
        read.warnings.iter().any(|it| {
            it.road.as_ref() == Some(&road)
                && (it.what.contains("too short") || it.what.contains("joins junctions"))
        })
    };
    let mut left = (0..count).filter(|road| !is_gone(road));
    let mut degrees = vec![0; plan.nodes.len()];
    plan.streets.iter().flat_map(|street| [street.from, street.to]).for_each(|node| degrees[node] += 1);
    let mut roads = Vec::new();
    for (index, street) in plan.streets.iter().enumerate() {
        let before = index.checked_sub(1).map(|before| &plan.streets[before]);
        let goes_on = before.is_some_and(|before| {
            before.to == street.from && before.level != street.level && degrees[street.from] == 2
        });
        roads.push(if goes_on { *roads.last()? } else { left.next()? });
    }
    left.next().is_none().then_some(roads)
}

#[test]
fn every_lane_leads_where_it_did() {
    for (file, place) in all_real() {
        let (city, _) =
            City::from_place(&place, &PlaceOptions::default(), &CityConfig::default(), Seed(1)).unwrap();
        let mut text = Vec::new();
        city.write_opendrive(&mut text).unwrap();
        let read = OpenDrive::from_xml(std::str::from_utf8(&text).unwrap()).unwrap();
        assert_eq!(read.plan.driving_side, city.plan.driving_side, "{file}");
        let network = RoadNetwork::derive(&read.plan, &NetworkConfig::default()).unwrap();
        let Some(roads) = roads_of(&read, city.network.roads.len()) else {
            println!("{file}: roads cannot be told apart");
            continue;
        };
        let places = lanes(&network);
        let there = |lane: LaneId| {
            let (road, list, rank) = places[&lane];
            (roads[road], list, rank)
        };
        let is: BTreeSet<[Lane; 2]> =
            network.connections.iter().map(|way| [there(way.from), there(way.to)]).collect();
        // Where a road is gone its junctions are others.
        let kept: BTreeSet<usize> = roads.iter().copied().collect();
        let gone = (0..city.network.roads.len()).filter(|road| !kept.contains(road));
        let stirred: BTreeSet<_> =
            gone.flat_map(|road| [city.network.roads[road].from, city.network.roads[road].to]).collect();
        let places = lanes(&city.network);
        let own = city.network.connections.iter().filter(|way| !stirred.contains(&way.intersection));
        let own = own.map(|way| [places[&way.from], places[&way.to]]);
        // Where bicycles turn is a rule.
        let own: Vec<[Lane; 2]> = own.filter(|[from, to]| from.1 < 2 && to.1 < 2).collect();
        let lost: Vec<&[Lane; 2]> = own.iter().filter(|way| !is.contains(*way)).collect();
        assert_eq!(lost, [&[(0, 0, 0); 2]; 0], "{file}");
        println!("{file}: {} ways came back", own.len());
    }
}
