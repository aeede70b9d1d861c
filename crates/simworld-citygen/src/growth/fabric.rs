//! The streets grown so far, with a uniform grid for questions about what is near.

use std::collections::BTreeMap;

use simworld_core::geometry::{Point2, heading};
use simworld_core::net::RoadClass;

use super::proposal::{Arrival, Fitted};
use crate::RoadConfig;

/// A straight piece between two junctions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Segment {
    pub(super) from: usize,
    pub(super) to: usize,
    pub(super) class: RoadClass,
}

/// Junctions and segments; what it holds is planar and connected.
#[derive(Clone, Debug)]
pub(super) struct Fabric {
    nodes: Vec<Point2>,
    /// Segments at each node.
    incident: Vec<Vec<usize>>,
    segments: Vec<Segment>,
    cell: f64,
    /// Nodes and segments by the cells they touch.
    node_cells: BTreeMap<(i32, i32), Vec<usize>>,
    segment_cells: BTreeMap<(i32, i32), Vec<usize>>,
}

impl Fabric {
    pub(super) fn new(config: &RoadConfig) -> Self {
        Self {
            nodes: Vec::new(),
            incident: Vec::new(),
            segments: Vec::new(),
            cell: config.length,
            node_cells: BTreeMap::new(),
            segment_cells: BTreeMap::new(),
        }
    }

    pub(super) fn node_count(&self) -> usize {
        self.nodes.len()
    }

    pub(super) fn segment_count(&self) -> usize {
        self.segments.len()
    }

    pub(super) fn node(&self, node: usize) -> Point2 {
        self.nodes[node]
    }

    pub(super) fn segments(&self) -> &[Segment] {
        &self.segments
    }

    pub(super) fn segment(&self, segment: usize) -> Segment {
        self.segments[segment]
    }

    pub(super) fn degree(&self, node: usize) -> usize {
        self.incident[node].len()
    }

    /// The directions in which segments leave a node.
    pub(super) fn headings(&self, node: usize) -> impl Iterator<Item = f64> {
        self.incident[node].iter().map(move |segment| {
            let Segment { from, to, .. } = self.segments[*segment];
            let other = if from == node { to } else { from };
            heading(&(self.nodes[other] - self.nodes[node]))
        })
    }

    pub(super) fn are_joined(&self, a: usize, b: usize) -> bool {
        self.incident[a].iter().any(|segment| {
            let Segment { from, to, .. } = self.segments[*segment];
            from == b || to == b
        })
    }

    /// Nodes within a distance, ascending.
    pub(super) fn nodes_near(&self, point: Point2, distance: f64) -> Vec<usize> {
        let mut found = Vec::new();
        for cell in self.cells(point, point, distance) {
            let nodes = self.node_cells.get(&cell).into_iter().flatten();
            found.extend(nodes.copied().filter(|node| (self.nodes[*node] - point).norm() <= distance));
        }
        found.sort_unstable();
        found
    }

    /// Segments whose cells touch the box around two points grown by a margin, ascending, each once.
    pub(super) fn segments_near(&self, a: Point2, b: Point2, margin: f64) -> Vec<usize> {
        let mut found: Vec<usize> = Vec::new();
        for cell in self.cells(a, b, margin) {
            found.extend(self.segment_cells.get(&cell).into_iter().flatten());
        }
        found.sort_unstable();
        found.dedup();
        found
    }

    pub(super) fn add_node(&mut self, position: Point2) -> usize {
        let node = self.nodes.len();
        self.nodes.push(position);
        self.incident.push(Vec::new());
        let cell = self.cells(position, position, 0.0).next();
        if let Some(cell) = cell {
            self.node_cells.entry(cell).or_default().push(node);
        }
        node
    }

    /// Builds a fitted proposal and returns the node where it arrives.
    pub(super) fn build(&mut self, fitted: &Fitted) -> usize {
        let node = match fitted.arrival {
            Arrival::New(point) => self.add_node(point),
            Arrival::Node(node) => node,
            Arrival::Interior(segment, point) => self.split(segment, point),
        };
        self.add_segment(Segment { from: fitted.from, to: node, class: fitted.class });
        node
    }

    fn add_segment(&mut self, segment: Segment) {
        let index = self.segments.len();
        self.segments.push(segment);
        self.incident[segment.from].push(index);
        self.incident[segment.to].push(index);
        self.file(index);
    }

    fn file(&mut self, index: usize) {
        let Segment { from, to, .. } = self.segments[index];
        for cell in self.cells(self.nodes[from], self.nodes[to], 0.0).collect::<Vec<_>>() {
            let entries = self.segment_cells.entry(cell).or_default();
            if !entries.contains(&index) {
                entries.push(index);
            }
        }
    }

    /// Puts a node on a segment: the first half keeps its index, the second is new.
    fn split(&mut self, index: usize, point: Point2) -> usize {
        let node = self.add_node(point);
        let Segment { to, class, .. } = self.segments[index];
        self.segments[index].to = node;
        self.incident[to].retain(|segment| *segment != index);
        self.incident[node].push(index);
        self.add_segment(Segment { from: node, to, class });
        node
    }

    fn cells(&self, a: Point2, b: Point2, margin: f64) -> impl Iterator<Item = (i32, i32)> + use<> {
        let cell = self.cell;
        let index = move |x: f64| (x / cell).floor() as i32;
        let columns = index(a.x.min(b.x) - margin)..=index(a.x.max(b.x) + margin);
        let (bottom, top) = (index(a.y.min(b.y) - margin), index(a.y.max(b.y) + margin));
        columns.flat_map(move |column| (bottom..=top).map(move |row| (column, row)))
    }
}
