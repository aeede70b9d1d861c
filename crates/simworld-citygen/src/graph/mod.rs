//! The planar graph of the streets of a plan: nodes, streets, their two sides, and the faces between them.
//!
//! Half-edges in flat arrays: each side of a street knows the side that comes next around the face on its left, the
//! one before, and that face (the doubly connected edge list of Muller and Preparata 1978). A bounded face is a block,
//! walked counterclockwise; each connected part of the streets has one outer face besides, which is all that lies
//! around it. Lengths in m, in the frame of the plan. Streets of one level that touch without a node are refused; the test
//! is exact. Those of different levels pass over one another, and faces then are walks that may cross.

mod build;
mod change;
mod edit;
mod error;
mod face;
mod grid;
mod ids;
mod meet;
mod piece;
mod rotation;

use simworld_core::geometry::Point2;
use simworld_core::net::{Control, CrossSection, DrivingSide, Street, StreetPlan};

pub use change::Change;
pub use error::GraphError;
pub use face::FaceRef;
use grid::PieceGrid;
pub use ids::{FaceId, HalfEdge, NodeId, StreetId};
use piece::{Joint, Piece};

/// No half-edge, no face.
const NONE: u32 = u32::MAX;

/// A place where streets meet or end.
#[derive(Clone, Debug)]
struct Node {
    at: Point2,
    /// One of the half-edges that leave it; none if it is alone.
    out: u32,
    /// Height, m.
    elevation: f64,
    control: Option<Control>,
    lives: bool,
}

/// A closed walk.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Face {
    /// Its first half-edge, by number; none if there is no such face any more.
    first: u32,
    /// Area on its left, m²; not above zero for an outer face.
    area: f64,
    /// Number of its half-edges.
    count: u32,
}

/// Streets as a planar graph, with the blocks that they enclose.
///
/// ```
/// use simworld_citygen::graph::StreetGraph;
/// use simworld_core::geometry::Point2;
/// use simworld_core::net::{Street, StreetPlan};
/// // Two blocks of 100 m by 100 m.
/// let mut graph = StreetGraph::of(&StreetPlan::grid(3, 2, 100.0))?;
/// assert_eq!(graph.blocks().map(|block| block.area()).collect::<Vec<_>>(), [10_000.0, 10_000.0]);
/// // A street through both: it is cut where it crosses, and so are the streets that it meets.
/// let course = [Point2::new(0.0, 50.0), Point2::new(200.0, 50.0)];
/// let change = graph.add_street(&course, &Street::simple(0, 0))?;
/// assert_eq!(graph.blocks().count(), 4);
/// assert_eq!(change.nodes_added.len(), 3);
/// # Ok::<(), simworld_citygen::graph::GraphError>(())
/// ```
#[derive(Clone, Debug)]
pub struct StreetGraph {
    nodes: Vec<Node>,
    streets: Vec<Option<Street>>,
    next: Vec<u32>,
    prev: Vec<u32>,
    face: Vec<u32>,
    faces: Vec<Face>,
    /// Places in the arrays that are free to be used again, last in first out.
    free_nodes: Vec<u32>,
    free_streets: Vec<u32>,
    free_faces: Vec<u32>,
    grid: PieceGrid,
    sections: Vec<CrossSection>,
    names: Vec<String>,
    driving_side: DrivingSide,
}

impl StreetGraph {
    /// The nodes, ascending.
    pub fn nodes(&self) -> impl Iterator<Item = NodeId> {
        (0..self.nodes.len() as u32).map(NodeId).filter(|node| self.nodes[node.index()].lives)
    }

    /// The streets, ascending.
    pub fn streets(&self) -> impl Iterator<Item = StreetId> {
        (0..self.streets.len() as u32).map(StreetId).filter(|street| self.streets[street.index()].is_some())
    }

    /// The faces, ascending: blocks and outer faces.
    pub fn faces(&self) -> impl Iterator<Item = FaceRef<'_>> {
        (0..self.faces.len() as u32).filter_map(|face| self.face(FaceId(face)))
    }

    /// The bounded faces.
    pub fn blocks(&self) -> impl Iterator<Item = FaceRef<'_>> {
        self.faces().filter(|face| !face.is_outer())
    }

    /// Where a node lies, if it exists.
    pub fn position(&self, node: NodeId) -> Option<Point2> {
        self.nodes.get(node.index()).filter(|node| node.lives).map(|node| node.at)
    }

    /// How high a node lies, if it exists, m.
    pub fn elevation(&self, node: NodeId) -> Option<f64> {
        self.nodes.get(node.index()).filter(|node| node.lives).map(|node| node.elevation)
    }

    /// A street, if it exists; `from` and `to` are numbers of nodes of the graph.
    pub fn street(&self, street: StreetId) -> Option<&Street> {
        self.streets.get(street.index())?.as_ref()
    }

    /// A face, if it exists.
    pub fn face(&self, face: FaceId) -> Option<FaceRef<'_>> {
        let found = self.faces.get(face.index()).filter(|face| face.first != NONE)?;
        Some(FaceRef { graph: self, id: face, face: *found })
    }

    /// The half-edges that leave a node, counterclockwise.
    pub fn around(&self, node: NodeId) -> impl Iterator<Item = HalfEdge> {
        let first = self.nodes.get(node.index()).filter(|node| node.lives).map_or(NONE, |node| node.out);
        let mut at = first;
        std::iter::from_fn(move || {
            if at == NONE {
                return None;
            }
            let here = at;
            let following = self.left_of(here);
            at = if following == first { NONE } else { following };
            Some(HalfEdge(here))
        })
    }

    /// The half-edge that follows around the face on the left. The half-edge must be of a street that exists.
    pub fn next(&self, half: HalfEdge) -> HalfEdge {
        HalfEdge(self.next[half.index()])
    }

    /// The half-edge before, around the face on the left. The half-edge must be of a street that exists.
    pub fn prev(&self, half: HalfEdge) -> HalfEdge {
        HalfEdge(self.prev[half.index()])
    }

    /// The face on the left. The half-edge must be of a street that exists.
    pub fn face_of(&self, half: HalfEdge) -> FaceId {
        FaceId(self.face[half.index()])
    }

    /// The node where a half-edge begins, if its street exists.
    pub fn origin(&self, half: HalfEdge) -> Option<NodeId> {
        let street = self.street(half.street())?;
        Some(NodeId(if half.is_along() { street.from } else { street.to } as u32))
    }

    /// The points of a half-edge in the order in which it is walked, both ends included; none if it does not exist.
    pub fn course(&self, half: HalfEdge) -> Vec<Point2> {
        let Some(street) = self.street(half.street()) else { return Vec::new() };
        let mut line: Vec<Point2> =
            (0..street.via.len() as u32 + 2).map(|index| self.point(street, index)).collect();
        if !half.is_along() {
            line.reverse();
        }
        line
    }

    /// The streets as a plan again, without gaps in its numbers.
    pub fn plan(&self) -> StreetPlan {
        let mut plan = StreetPlan {
            sections: self.sections.clone(),
            names: self.names.clone(),
            driving_side: self.driving_side,
            ..StreetPlan::default()
        };
        let mut numbers = vec![0; self.nodes.len()];
        for node in self.nodes() {
            let here = &self.nodes[node.index()];
            numbers[node.index()] = plan.nodes.len();
            plan.controls.extend(here.control.map(|control| (plan.nodes.len(), control)));
            plan.nodes.push(here.at);
            plan.elevations.push(here.elevation);
        }
        // A flat plan has no heights.
        if plan.elevations.iter().all(|height| *height == 0.0) {
            plan.elevations.clear();
        }
        let renumbered =
            |street: &Street| Street { from: numbers[street.from], to: numbers[street.to], ..street.clone() };
        plan.streets = self.streets.iter().flatten().map(renumbered).collect();
        plan
    }

    /// Point `index` of a street's course, ends included.
    fn point(&self, street: &Street, index: u32) -> Point2 {
        match index as usize {
            0 => self.nodes[street.from].at,
            index if index > street.via.len() => self.nodes[street.to].at,
            index => street.via[index - 1],
        }
    }

    /// Piece `index` of a street's course.
    fn piece(&self, number: u32, street: &Street, index: u32) -> Piece {
        let last = street.via.len() as u32;
        let start = if index == 0 { Joint::Node(street.from as u32) } else { Joint::Bend(number, index) };
        let end = if index == last { Joint::Node(street.to as u32) } else { Joint::Bend(number, index + 1) };
        Piece { ends: [self.point(street, index), self.point(street, index + 1)], joints: [start, end] }
    }
}
