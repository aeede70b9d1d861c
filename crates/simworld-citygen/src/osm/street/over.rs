//! Signs that forbid a turn over a way: from one street over another, often the crossover of two carriageways, into a third.
//!
//! A plan forbids turns at junctions alone. Where the way between was drawn into one junction with both of its ends the turn
//! is one of that junction, and is forbidden by its word like any other; elsewhere the sign is told and left out.

use std::collections::BTreeMap;

use simworld_core::net::Turn;

use super::turns::Side;
use super::web::Web;
use crate::osm::error::{OsmId, Warning};
use crate::osm::place::Place;

/// A sign over ways.
#[derive(Clone, Debug)]
pub(super) struct Over {
    relation: i64,
    turns: &'static [Turn],
}

/// The numbers of the ways from which a turn is governed, over which it goes, and into which.
pub(super) struct Course {
    pub(super) from: Vec<i64>,
    pub(super) over: Vec<i64>,
    pub(super) to: Vec<i64>,
}

/// Marks the ends of the streets between which a sign over ways stands. A sign for ways that are no streets says nothing here.
pub(super) fn put(
    web: &mut Web,
    extract: &Extract<'_>,
    relation: i64,
    course: &Course,
    turns: &'static [Turn],
) -> Result<(), &'static str> {
    let begins = extract.ends_at(web, &course.from, &course.over);
    let leads = extract.ends_at(web, &course.to, &course.over);
    let node = |ends: &[(u32, usize)]| ends.first().map(|(edge, end)| web.edge(*edge).ends[*end]);
    let (Some(from), Some(to)) = (node(&begins), node(&leads)) else { return Ok(()) };
    if from == to {
        return Err("goes over a way that does not lie between the two others");
    }
    let Ok(sign) = u16::try_from(web.signs_over.len() + 1) else {
        return Err("is one of too many over ways");
    };
    web.signs_over.push(Over { relation, turns });
    for (side, ends) in [(Side::Begins, begins), (Side::Leads, leads)] {
        for (edge, end) in ends {
            web.edges[edge as usize].turns[end].mark(side, sign);
        }
    }
    Ok(())
}

/// Where the streets of an extract stand in a web.
pub(super) struct Extract<'a> {
    pub(super) place: &'a Place,
    /// Nodes of the web at nodes of the place.
    pub(super) vertices: &'a BTreeMap<u32, u32>,
}

impl Extract<'_> {
    /// The nodes of some ways, ascending.
    fn nodes(&self, ways: &[i64]) -> Vec<u32> {
        let raw = &self.place.raw;
        let ways = ways.iter().filter_map(|way| raw.way(*way));
        let mut nodes: Vec<u32> = ways.flat_map(|way| raw.nodes_of(way)).copied().collect();
        nodes.sort_unstable();
        nodes.dedup();
        nodes
    }

    /// The ends of the edges of some ways at nodes of others.
    fn ends_at(&self, web: &Web, ways: &[i64], others: &[i64]) -> Vec<(u32, usize)> {
        let others = self.nodes(others);
        let common = self.nodes(ways).into_iter().filter(|node| others.binary_search(node).is_ok());
        let mut ends = Vec::new();
        for node in common.filter_map(|node| self.vertices.get(&node).copied()) {
            for edge in &web.node(node).edges {
                let found = web.edge(*edge);
                if ways.contains(&found.character.way) {
                    ends.extend((0..2).filter(|end| found.ends[*end] == node).map(|end| (*edge, end)));
                }
            }
        }
        ends
    }
}

/// Forbids the turns of signs over ways whose ends are one junction now; all others are told.
pub(super) fn settle(web: &mut Web, warnings: &mut Vec<Warning>) {
    if web.signs_over.is_empty() {
        return;
    }
    let signs = std::mem::take(&mut web.signs_over);
    let mut begins: Vec<Vec<(u32, usize, u32)>> = vec![Vec::new(); signs.len()];
    let mut leads: Vec<Vec<u32>> = vec![Vec::new(); signs.len()];
    for (index, edge) in web.living() {
        for (end, (node, turns)) in edge.ends.into_iter().zip(&edge.turns).enumerate() {
            turns.marks(Side::Begins).for_each(|sign| begins[usize::from(sign) - 1].push((index, end, node)));
            turns.marks(Side::Leads).for_each(|sign| leads[usize::from(sign) - 1].push(node));
        }
    }
    for ((sign, begins), leads) in signs.iter().zip(begins).zip(leads) {
        let one: Vec<_> = begins.iter().filter(|(.., node)| leads.contains(node)).collect();
        for (edge, end, _) in &one {
            web.edges[*edge as usize].turns[*end].forbid(sign.turns);
        }
        if one.is_empty() {
            let what = "a turn restriction goes over a way that is a street by itself; left out".to_owned();
            warnings.push(Warning { what, element: Some(OsmId::Relation(sign.relation)), at: None });
        }
    }
}
