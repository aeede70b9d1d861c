//! From the finished web to a plan.

use std::collections::BTreeMap;

use simworld_core::net::{DrivingSide, SHORTEST_STREET, Street, StreetPlan, TurnLanes, polyline};

use super::Planned;
use super::circle;
use super::collapse::warn;
use super::control;
use super::profile::Profile;
use super::web::{Edge, UNNAMED, Web};
use crate::osm::error::Warning;
use crate::osm::place::Place;

/// Streets at one node; a junction of more is a mistake.
const MOST_STREETS: usize = 24;

/// The plan of all edges that make a street.
pub(super) fn plan(web: &Web, place: &Place, warnings: &mut Vec<Warning>) -> Planned {
    let mut off_ground = Vec::new();
    let mut plan = StreetPlan { sections: Vec::new(), ..StreetPlan::default() };
    let mut numbers: Vec<Option<usize>> = vec![None; web.nodes.len()];
    let mut sections: BTreeMap<Profile, u32> = BTreeMap::new();
    let mut names: BTreeMap<u32, u32> = BTreeMap::new();
    let mut pairs: BTreeMap<(usize, usize), u32> = BTreeMap::new();
    for (index, edge) in web.living() {
        if let Some(what) = fault(web, index, &pairs) {
            warn(web, index, what, place, warnings);
            continue;
        }
        let [from, to] = edge.ends.map(|node| {
            *numbers[node as usize].get_or_insert_with(|| {
                plan.nodes.push(web.node(node).at);
                plan.nodes.len() - 1
            })
        });
        pairs.insert(pair(edge.ends), index);
        let character = edge.character;
        let section = *sections.entry(character.profile).or_insert_with(|| {
            plan.sections.push(character.profile.section());
            plan.sections.len() as u32 - 1
        });
        let name = (character.name != UNNAMED).then(|| {
            *names.entry(character.name).or_insert_with(|| plan.add_name(&web.names[character.name as usize]))
        });
        let speed_limit = (character.speed > 0.0).then_some(character.speed);
        off_ground.push(character.is_covered || character.level != 0);
        plan.streets.push(Street {
            via: edge.via.clone(),
            class: character.class,
            section,
            name,
            speed_limit,
            level: character.level,
            roundabout: character.is_roundabout,
            turns: turns(web, edge).into(),
            ..Street::simple(from, to)
        });
    }
    if plan.sections.is_empty() {
        plan.sections = StreetPlan::default().sections;
    }
    let is_left_hand = web.living().next().is_some_and(|(_, edge)| edge.character.profile.is_left_hand);
    plan.driving_side = if is_left_hand { DrivingSide::Left } else { DrivingSide::Right };
    plan.controls = control::controls(&plan, place);
    circle::set(&mut plan, place);
    Planned { plan, off_ground }
}

/// The arrows on its lanes, where it ends at a junction.
fn turns(web: &Web, edge: &Edge) -> TurnLanes {
    let Profile { forward, backward, .. } = edge.character.profile;
    let at = |end: usize, lanes: u8| {
        if web.degree(edge.ends[end]) > 2 { edge.turns[end].on_lanes(usize::from(lanes)) } else { Vec::new() }
    };
    TurnLanes { forward: at(1, forward), backward: at(0, backward), ..TurnLanes::default() }
}

fn pair(ends: [u32; 2]) -> (usize, usize) {
    (ends[0].min(ends[1]) as usize, ends[0].max(ends[1]) as usize)
}

/// What a plan would not allow about an edge; nothing, after all that was mended.
fn fault(web: &Web, index: u32, pairs: &BTreeMap<(usize, usize), u32>) -> Option<&'static str> {
    let edge = web.edge(index);
    let is_crowded = |node: &u32| web.degree(*node) > MOST_STREETS;
    if edge.ends[0] == edge.ends[1] || pairs.contains_key(&pair(edge.ends)) {
        Some("joins junctions that are joined already; left out")
    } else if polyline::length(&web.course(index)) < SHORTEST_STREET {
        Some("too short for a street; left out")
    } else if edge.ends.iter().any(is_crowded) {
        Some("ends at a junction of more streets than there can be; left out")
    } else {
        None
    }
}
