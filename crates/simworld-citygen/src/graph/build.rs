//! A graph from a plan.

use simworld_core::geometry::Point2;
use simworld_core::lists::Lists;
use simworld_core::net::{Street, StreetPlan};

use super::{FaceId, GraphError, NONE, Node, PieceGrid, StreetGraph, StreetId};

impl StreetGraph {
    /// The graph of a plan: nodes and streets keep their numbers. The time grows with n log n for n streets of like
    /// lengths.
    ///
    /// # Errors
    /// A plan that is not valid, or two streets that touch where they have no node in common.
    pub fn of(plan: &StreetPlan) -> Result<Self, GraphError> {
        plan.validate()?;
        let mut graph = Self::unlinked(plan);
        for number in 0..graph.streets.len() {
            if let Some(street) = graph.streets[number].take() {
                graph.admit(number as u32, &street)?;
                graph.streets[number] = Some(street);
            }
        }
        graph.link_nodes();
        for half in 0..graph.next.len() as u32 {
            if graph.face[half as usize] == NONE {
                graph.walk(half);
            }
        }
        for face in 0..graph.faces.len() as u32 {
            graph.measure(FaceId(face));
        }
        Ok(graph)
    }

    fn unlinked(plan: &StreetPlan) -> Self {
        let count = plan.streets.len();
        let nodes = plan.nodes.iter().enumerate().map(|(index, at)| Node {
            at: *at,
            out: NONE,
            elevation: plan.elevation(index),
            control: plan.controls.get(&index).copied(),
            lives: true,
        });
        let mut graph = Self {
            nodes: nodes.collect(),
            streets: plan.streets.iter().cloned().map(Some).collect(),
            next: vec![NONE; 2 * count],
            prev: vec![NONE; 2 * count],
            face: vec![NONE; 2 * count],
            faces: Vec::with_capacity(count),
            free_nodes: Vec::new(),
            free_streets: Vec::new(),
            free_faces: Vec::new(),
            grid: grid_for(plan),
            sections: plan.sections.clone(),
            names: plan.names.clone(),
            driving_side: plan.driving_side,
        };
        for index in 0..count {
            if let Some(mut street) = graph.streets[index].take() {
                graph.tidy(&mut street);
                graph.streets[index] = Some(street);
            }
        }
        graph
    }

    /// Takes out points that repeat the one before, which have no direction.
    pub(super) fn tidy(&self, street: &mut Street) {
        let (from, to) = (self.nodes[street.from].at, self.nodes[street.to].at);
        street.via.dedup();
        if street.via.first() == Some(&from) {
            street.via.remove(0);
        }
        if street.via.last() == Some(&to) {
            street.via.pop();
        }
    }

    /// Puts a street's pieces into the grid; none, if one touches a street that is there or the street itself.
    pub(super) fn admit(&mut self, number: u32, street: &Street) -> Result<(), GraphError> {
        for index in 0..=street.via.len() as u32 {
            let piece = self.piece(number, street, index);
            let [a, b] = piece.ends;
            let mut found: Option<(u32, Point2)> = None;
            self.grid.visit(a, b, |other, part| {
                if found.is_some_and(|(least, _)| least <= other) {
                    return;
                }
                let present =
                    if other == number { Some(street) } else { self.streets[other as usize].as_ref() };
                let touched = present.and_then(|present| {
                    let there = self.piece(other, present, part);
                    // Streets of different levels pass over one another.
                    let passes = present.level != street.level && !piece.has_common(&there);
                    if passes { None } else { piece.touches(&there) }
                });
                found = touched.map(|at| (other, at)).or(found);
            });
            if let Some((other, at)) = found {
                for before in 0..index {
                    let [a, b] = self.piece(number, street, before).ends;
                    self.grid.remove(number, before, a, b);
                }
                let (first, second) = (StreetId(other), StreetId(number));
                return Err(GraphError::Touching { first, second, x: at.x, y: at.y });
            }
            self.grid.insert(number, index, a, b);
        }
        Ok(())
    }

    /// Puts the pieces of a street back into the grid that stood there before.
    pub(super) fn readmit(&mut self, number: u32, street: &Street) {
        for index in 0..=street.via.len() as u32 {
            let [a, b] = self.piece(number, street, index).ends;
            self.grid.insert(number, index, a, b);
        }
    }

    /// Takes a street's pieces out of the grid.
    pub(super) fn dismiss(&mut self, number: u32, street: &Street) {
        for index in 0..=street.via.len() as u32 {
            let [a, b] = self.piece(number, street, index).ends;
            self.grid.remove(number, index, a, b);
        }
    }

    /// Orders the streets around every node, by counting and then by direction.
    fn link_nodes(&mut self) {
        let halves = self.streets.iter().zip((0..).step_by(2)).filter_map(|(street, half)| {
            let street = street.as_ref()?;
            Some([(street.from, half), (street.to, half + 1)])
        });
        let mut leaving = Lists::of(self.nodes.len(), halves.flatten());
        for node in 0..self.nodes.len() {
            self.link_all(node as u32, &mut leaving[node]);
        }
    }
}

/// A grid that suits the pieces of a plan.
fn grid_for(plan: &StreetPlan) -> PieceGrid {
    let (mut low, mut high) = (Point2::new(f64::MAX, f64::MAX), Point2::new(f64::MIN, f64::MIN));
    let (mut pieces, mut length) = (0, 0.0);
    for street in &plan.streets {
        let mut before = plan.nodes[street.from];
        for point in street.via.iter().copied().chain([plan.nodes[street.to]]) {
            length += (point - before).norm();
            pieces += 1;
            for end in [before, point] {
                low = low.inf(&end);
                high = high.sup(&end);
            }
            before = point;
        }
    }
    if pieces == 0 {
        (low, high) = (Point2::origin(), Point2::origin());
    }
    PieceGrid::new(low, high, pieces, length)
}
