//! What a loaded city must fulfil so that nothing built on it can fail: the checks that types cannot make.

use simworld_core::net::{RoadNetwork, StreetPlan};

use super::SaveError;
use crate::building::Building;
use crate::element::Element;

/// Streets at one node: the work at a junction grows with the square of its streets.
const MOST_STREETS_A_NODE: usize = 32;

/// Roads are indexed as the streets of the plan, intersections as its nodes.
pub(super) fn streets(plan: &StreetPlan, network: &RoadNetwork) -> Result<(), SaveError> {
    let sizes = (plan.nodes.len(), plan.streets.len());
    if sizes != (network.intersections.len(), network.roads.len()) {
        return Err(SaveError::Unsound { what: "plan", index: 0, fault: "has other streets than the roads" });
    }
    let pairs = plan.streets.iter().zip(&network.roads);
    let stray = pairs.map(|(street, road)| (street.from, street.to) != (road.from.index(), road.to.index()));
    fail("road", stray.into_iter().position(|stray| stray), "joins other places than its street")?;
    let crowded = network.intersections.iter().position(|place| place.roads.len() > MOST_STREETS_A_NODE);
    fail("intersection", crowded, "joins more than 32 streets")
}

pub(super) fn buildings(buildings: &[Building], network: &RoadNetwork) -> Result<(), SaveError> {
    let unsound = buildings.iter().position(|building| !building.is_sound());
    fail("building", unsound, "has no possible place or size")?;
    let lost = buildings.iter().position(|building| building.road.index() >= network.roads.len());
    fail("building", lost, "stands at a road that is not there")
}

pub(super) fn elements(elements: &[Element]) -> Result<(), SaveError> {
    let unsound = elements.iter().position(|element| !element.is_sound());
    fail("element", unsound, "has no possible place or size")
}

/// What stands along a road stands along one that is there.
pub(super) fn anchors(elements: &[Element], network: &RoadNetwork) -> Result<(), SaveError> {
    let is_lost = |element: &Element| {
        element.along.as_street().is_some_and(|(road, _)| road.index() >= network.roads.len())
    };
    fail("element", elements.iter().position(is_lost), "stands along a road that is not there")
}

fn fail(what: &'static str, at: Option<usize>, fault: &'static str) -> Result<(), SaveError> {
    at.map_or(Ok(()), |index| Err(SaveError::Unsound { what, index, fault }))
}
