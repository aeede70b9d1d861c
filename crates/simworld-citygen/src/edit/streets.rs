//! Edits of streets: made on the part of the plan round them, and brought over into the whole.

use std::collections::{BTreeMap, BTreeSet};

use simworld_core::geometry::{Point2, bounds};
use simworld_core::net::{NetworkPatch, PlanChange, PlanPart, RoadNetwork, Street};
use simworld_core::patch::Book;

use super::around::Around;
use super::cells::Bounds;
use super::patch::PlanPatch;
use super::{CityEditor, EditError};
use crate::graph::{Change, GraphError, HalfEdge, StreetGraph, StreetId};
use crate::terrain::{HeightField, Terrain};

/// A change of the streets that is done, and what takes it back.
pub(super) struct StreetsChanged {
    pub(super) plan: PlanPatch,
    pub(super) network: NetworkPatch,
}

impl CityEditor {
    /// Changes the streets round some streets, and the roads that follow from them.
    pub(super) fn change_streets(
        &mut self,
        mut part: PlanPart,
        work: impl FnOnce(&mut StreetGraph) -> Result<Change, GraphError>,
        like: Option<&super::NewStreet>,
    ) -> Result<StreetsChanged, EditError> {
        // What a new street brings with it is numbered after what is there.
        if let Some(new) = like {
            part.plan.sections.push(new.section.clone());
            part.plan.names.extend(new.name.clone());
        }
        let mut graph = StreetGraph::of(&part.plan)?;
        let change = work(&mut graph)?;
        let terrain = self.city.terrain();
        let area = area_of(&graph, &part, &change);
        let carry = Carry::new(&mut self.city.plan, &self.city.network, &part);
        let (mut plan, mut change, nodes) = carry.over(&graph, &change, &terrain);
        let raised = match area {
            Some(area) => {
                let mut around = Around {
                    plan: &mut self.city.plan,
                    patch: &mut plan,
                    change: &mut change,
                    roads: &self.index.roads,
                    nodes,
                    area,
                };
                around.set_turning();
                around.raise(&self.city.config.terrain)
            }
            None => Ok(()),
        };
        let network = std::sync::Arc::make_mut(&mut self.city.network);
        let done =
            raised.and_then(|()| Ok(network.repair(&self.city.plan, &self.city.config.network, &change)?));
        match done {
            Ok(network) => Ok(StreetsChanged { plan, network }),
            Err(error) => {
                plan.put_on(&mut self.city.plan)?;
                Err(error)
            }
        }
    }
}

/// The rectangle round all streets of a part that a change touches, as they were and as they are.
fn area_of(graph: &StreetGraph, part: &PlanPart, change: &Change) -> Option<Bounds> {
    let were = change.streets_removed.iter().chain(&change.streets_changed);
    let were = were.filter_map(|street| part.plan.streets.get(street.index()));
    let lines = were.map(|street| part.plan.centerline(street));
    let are = change.streets_added.iter().chain(&change.streets_changed);
    let points: Vec<Point2> =
        lines.chain(are.map(|street| graph.course(HalfEdge::along(*street)))).flatten().collect();
    bounds(&points)
}

/// Carries a change over from a part of a plan to the whole.
struct Carry<'a> {
    part: &'a PlanPart,
    network: &'a RoadNetwork,
    nodes: Book<'a, simworld_core::geometry::Point2>,
    elevations: Book<'a, f64>,
    streets: Book<'a, Street>,
    sections: Book<'a, simworld_core::net::CrossSection>,
    names: Book<'a, String>,
    controls: &'a mut BTreeMap<usize, simworld_core::net::Control>,
    old_controls: BTreeMap<usize, Option<simworld_core::net::Control>>,
    /// The number in the whole of each street and node of the part's graph.
    street_of: Vec<usize>,
    node_of: Vec<usize>,
    /// Streets that got another number, new by old; and nodes, old by new.
    streets_now: BTreeMap<usize, Option<usize>>,
    nodes_once: BTreeMap<usize, usize>,
    change: PlanChange,
}

impl<'a> Carry<'a> {
    fn new(
        plan: &'a mut simworld_core::net::StreetPlan,
        network: &'a RoadNetwork,
        part: &'a PlanPart,
    ) -> Self {
        Self {
            part,
            network,
            nodes: Book::open(&mut plan.nodes),
            elevations: Book::open(&mut plan.elevations),
            streets: Book::open(&mut plan.streets),
            sections: Book::open(&mut plan.sections),
            names: Book::open(&mut plan.names),
            controls: &mut plan.controls,
            old_controls: BTreeMap::new(),
            street_of: part.streets.clone(),
            node_of: part.nodes.clone(),
            streets_now: BTreeMap::new(),
            nodes_once: BTreeMap::new(),
            change: PlanChange::default(),
        }
    }

    /// Gives what takes the change back, the change in the numbers of the whole, and all nodes that it touches.
    fn over(
        mut self,
        graph: &StreetGraph,
        change: &Change,
        terrain: &Terrain,
    ) -> (PlanPatch, PlanChange, BTreeSet<usize>) {
        change.streets_removed.iter().for_each(|street| self.remove_street(street.index()));
        change.nodes_removed.iter().for_each(|node| self.remove_node(node.index()));
        for node in &change.nodes_added {
            let Some(at) = graph.position(*node) else { continue };
            self.node_of.resize(self.node_of.len().max(node.index() + 1), usize::MAX);
            self.node_of[node.index()] = self.nodes.push(at);
            if !self.elevations.is_empty() {
                // A node on a street lies as high as the street there, any other one on the ground.
                let height = graph.elevation(*node).filter(|height| *height != 0.0);
                self.elevations.push(height.unwrap_or_else(|| terrain.height(at)));
            }
        }
        for node in &change.nodes_changed {
            let (whole, at) = (self.node_of[node.index()], graph.position(*node));
            if let Some(at) = at.filter(|at| at != self.nodes.get(whole)) {
                *self.nodes.edit(whole) = at;
                self.change.nodes_changed.push(whole);
            }
        }
        for street in &change.streets_changed {
            let whole = self.street_of[street.index()];
            if let Some(street) = self.brought_over(graph, *street) {
                *self.streets.edit(whole) = street;
                self.change.streets_changed.push(whole);
            }
        }
        for street in &change.streets_added {
            if let Some(street) = self.brought_over(graph, *street) {
                self.streets.push(street);
            }
        }
        let patch = PlanPatch {
            nodes: self.nodes.close(),
            elevations: self.elevations.close(),
            streets: self.streets.close(),
            sections: self.sections.close(),
            names: self.names.close(),
            controls: self.old_controls.into_iter().map(|(node, old)| (node as u32, old)).collect(),
        };
        let touched = change.nodes_added.iter().chain(&change.nodes_changed);
        let touched = touched.map(|node| self.node_of[node.index()]).collect();
        (patch, self.change, touched)
    }

    fn remove_street(&mut self, local: usize) {
        let (gone, last) = (self.street_of[local], self.streets.len() - 1);
        // Whoever had the last number before it was given on.
        let moved =
            self.streets_now.iter().find(|(_, now)| **now == Some(last)).map_or(last, |(old, _)| *old);
        let removed =
            self.streets_now.iter().find(|(_, now)| **now == Some(gone)).map_or(gone, |(old, _)| *old);
        self.streets.swap_remove(gone);
        self.street_of.iter_mut().filter(|street| **street == last).for_each(|street| *street = gone);
        self.streets_now.insert(moved, Some(gone));
        self.streets_now.insert(removed, None);
        self.change.streets_removed.push(gone);
    }

    fn remove_node(&mut self, local: usize) {
        let (gone, last) = (self.node_of[local], self.nodes.len() - 1);
        let once = self.nodes_once.get(&last).copied().unwrap_or(last);
        if gone != last {
            for road in &self.network.intersections[once].roads {
                let street = self.streets_now.get(&road.index()).copied().unwrap_or(Some(road.index()));
                let Some(street) = street else { continue };
                let street = self.streets.edit(street);
                for end in [&mut street.from, &mut street.to] {
                    *end = if *end == last { gone } else { *end };
                }
            }
        }
        self.nodes.swap_remove(gone);
        if !self.elevations.is_empty() {
            self.elevations.swap_remove(gone);
        }
        for node in [gone, last] {
            self.old_controls.entry(node).or_insert_with(|| self.controls.get(&node).copied());
        }
        let control = self.controls.remove(&last);
        self.controls.remove(&gone);
        if let Some(control) = control.filter(|_| gone != last) {
            self.controls.insert(gone, control);
        }
        self.node_of.iter_mut().filter(|node| **node == last).for_each(|node| *node = gone);
        self.nodes_once.insert(gone, once);
        self.change.nodes_removed.push(gone);
    }

    /// A street of the graph in the numbers of the whole.
    fn brought_over(&mut self, graph: &StreetGraph, street: StreetId) -> Option<Street> {
        let mut street = graph.street(street)?.clone();
        (street.from, street.to) = (self.node_of[street.from], self.node_of[street.to]);
        street.section = match self.part.sections.get(street.section as usize) {
            Some(section) => *section,
            None => self.section(street.section as usize),
        };
        street.name = street.name.and_then(|name| match self.part.names.get(name as usize) {
            Some(name) => Some(*name),
            None => self.name(name as usize),
        });
        Some(street)
    }

    /// The number in the whole of a new cross-section, which may be there already.
    fn section(&mut self, local: usize) -> u32 {
        let new = &self.part.plan.sections[local];
        let known = (0..self.sections.len()).find(|index| self.sections.get(*index) == new);
        known.unwrap_or_else(|| self.sections.push(new.clone())) as u32
    }

    /// The number in the whole of a new name: that of the street of the same name, if there is one.
    fn name(&mut self, local: usize) -> Option<u32> {
        let new = self.part.plan.names.get(local)?;
        let known = (0..self.names.len()).find(|index| self.names.get(*index) == new);
        Some(known.unwrap_or_else(|| self.names.push(new.clone())) as u32)
    }
}

/// Streets that have to be known where one of these changes: they and all that meet them.
pub(super) fn with_neighbours(network: &RoadNetwork, streets: BTreeSet<usize>) -> BTreeSet<usize> {
    let at_ends = streets.iter().flat_map(|street| {
        let road = &network.roads[*street];
        [road.from, road.to].into_iter().flat_map(|end| &network.intersections[end.index()].roads)
    });
    let mut all: BTreeSet<usize> = at_ends.map(|road| road.index()).collect();
    all.extend(streets);
    all
}
