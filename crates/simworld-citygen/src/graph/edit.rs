//! Edits: streets come, go and bend, and only what they touch is repaired.
//!
//! An edit takes streets out of the graph and puts streets in. Each step is written down, so that an edit that turns
//! out to be impossible is taken back step by step. In the end the faces of all half-edges whose next one changed are
//! walked anew; every other face is as it was.

use simworld_core::geometry::Point2;
use simworld_core::net::{Street, StreetPlan};

use super::{Change, FaceId, GraphError, HalfEdge, NONE, Node, NodeId, StreetGraph, StreetId};

/// Pieces of a course that an edit cuts are no shorter, m.
pub(super) const LEAST_PIECE: f64 = 1e-3;

/// A step that was done, and what undoes it.
#[derive(Clone, Debug)]
enum Step {
    StreetIn(u32),
    StreetOut(u32, Street),
    NodeIn(u32),
    NodeOut(u32),
    NodeMoved(u32, Point2),
}

/// An edit under way.
#[derive(Debug)]
pub(super) struct Edit<'a> {
    pub(super) graph: &'a mut StreetGraph,
    steps: Vec<Step>,
    /// Half-edges whose next one changed.
    changed: Vec<u32>,
}

impl StreetGraph {
    /// Builds a street along a course, in everything else like a street given; `from`, `to` and `via` of that one are
    /// not looked at.
    ///
    /// The course joins what it meets: a node within 1 m of an end or of a crossing, or else the street there, which is
    /// cut in two; the part from its beginning keeps its number. The course itself is cut at every crossing. Streets of
    /// other levels are joined at nodes and at the ends of the course, and passed over or under elsewhere.
    ///
    /// # Errors
    /// A course that is no line, crosses itself or runs along a street; a part of a street shorter than can be built;
    /// two nodes that are joined already.
    pub fn add_street(&mut self, course: &[Point2], like: &Street) -> Result<Change, GraphError> {
        if course.len() < 2 || !course.iter().all(is_near) {
            return Err(GraphError::Course { points: course.len() });
        }
        self.edit(|edit| edit.build_along(course, like))
    }

    /// Moves a node; the first and last pieces of its streets follow, the rest of their courses stays.
    ///
    /// # Errors
    /// No such node, a place beyond ±1e7 m, or a street that would touch another one or be too short.
    pub fn move_node(&mut self, node: NodeId, to: Point2) -> Result<Change, GraphError> {
        if self.position(node).is_none() {
            return Err(GraphError::NoNode(node));
        }
        if !is_near(&to) {
            return Err(GraphError::Course { points: 1 });
        }
        self.edit(|edit| edit.pull(node, to))
    }

    /// Takes a street away, and those of its nodes that have no other.
    ///
    /// # Errors
    /// No such street.
    pub fn remove_street(&mut self, street: StreetId) -> Result<Change, GraphError> {
        if self.street(street).is_none() {
            return Err(GraphError::NoStreet(street));
        }
        self.edit(|edit| {
            let Some(gone) = edit.take_out(street.0) else { return Ok(()) };
            for node in [gone.from as u32, gone.to as u32] {
                if edit.graph.nodes[node as usize].out == NONE {
                    edit.graph.nodes[node as usize].lives = false;
                    edit.steps.push(Step::NodeOut(node));
                }
            }
            Ok(())
        })
    }

    fn edit(
        &mut self,
        work: impl FnOnce(&mut Edit<'_>) -> Result<(), GraphError>,
    ) -> Result<Change, GraphError> {
        let mut edit = Edit { graph: self, steps: Vec::new(), changed: Vec::new() };
        match work(&mut edit) {
            Ok(()) => Ok(edit.finish()),
            Err(error) => {
                edit.take_back();
                Err(error)
            }
        }
    }

    /// Puts a street into a place that is free; its pieces are in the grid.
    fn attach(&mut self, number: u32, street: Street, changed: &mut Vec<u32>) {
        let ends = [street.from as u32, street.to as u32];
        self.streets[number as usize] = Some(street);
        for (half, node) in [(2 * number, ends[0]), (2 * number + 1, ends[1])] {
            self.splice_in(half, node, changed);
        }
    }

    /// Takes a street out of its place, and its pieces out of the grid.
    fn detach(&mut self, number: u32, changed: &mut Vec<u32>) -> Option<Street> {
        let street = self.streets[number as usize].as_ref()?;
        let ends = [street.from as u32, street.to as u32];
        for (half, node) in [(2 * number, ends[0]), (2 * number + 1, ends[1])] {
            self.splice_out(half, node, changed);
        }
        let street = self.streets[number as usize].take()?;
        self.dismiss(number, &street);
        Some(street)
    }
}

impl Edit<'_> {
    pub(super) fn add_node(&mut self, at: Point2) -> u32 {
        let node = Node { at, out: NONE, elevation: 0.0, control: None, lives: true };
        let number = if let Some(number) = self.graph.free_nodes.pop() {
            self.graph.nodes[number as usize] = node;
            number
        } else {
            self.graph.nodes.push(node);
            self.graph.nodes.len() as u32 - 1
        };
        self.steps.push(Step::NodeIn(number));
        number
    }

    /// A place for a street.
    fn vacancy(&mut self) -> u32 {
        self.graph.free_streets.pop().unwrap_or_else(|| {
            let graph = &mut *self.graph;
            graph.streets.push(None);
            for links in [&mut graph.next, &mut graph.prev, &mut graph.face] {
                links.extend([NONE; 2]);
            }
            graph.streets.len() as u32 - 1
        })
    }

    /// Puts in a street, at the place of one that was taken out or at a new one, if it may stand there.
    pub(super) fn put_in(&mut self, mut street: Street, place: Option<u32>) -> Result<(), GraphError> {
        self.graph.tidy(&mut street);
        self.check_alone(&street)?;
        let (from, to) = (NodeId(street.from as u32), NodeId(street.to as u32));
        let joins = |half: &HalfEdge| self.graph.origin(half.twin()) == Some(to);
        if let Some(present) = self.graph.around(from).find(joins) {
            return Err(GraphError::Joined { from, to, present: present.street() });
        }
        let number = place.unwrap_or_else(|| self.vacancy());
        if let Err(error) = self.graph.admit(number, &street) {
            // A place that was free stays free; one that was taken out is filled again by the way back.
            if place.is_none() {
                self.graph.free_streets.push(number);
            }
            return Err(error);
        }
        self.graph.attach(number, street, &mut self.changed);
        self.steps.push(Step::StreetIn(number));
        Ok(())
    }

    /// Whether a street could be built if it were the only one.
    fn check_alone(&self, street: &Street) -> Result<(), GraphError> {
        let graph = &self.graph;
        let alone = StreetPlan {
            nodes: vec![graph.nodes[street.from].at, graph.nodes[street.to].at],
            streets: vec![Street { from: 0, to: usize::from(street.from != street.to), ..street.clone() }],
            sections: graph.sections.clone(),
            names: graph.names.clone(),
            ..StreetPlan::default()
        };
        Ok(alone.validate()?)
    }

    pub(super) fn take_out(&mut self, number: u32) -> Option<Street> {
        let street = self.graph.detach(number, &mut self.changed)?;
        self.steps.push(Step::StreetOut(number, street.clone()));
        Some(street)
    }

    /// Cuts a street at a point of its course, which becomes a node.
    pub(super) fn cut(&mut self, number: u32, station: f64, at: Point2) -> Result<u32, GraphError> {
        let node = self.add_node(at);
        let Some(street) = self.take_out(number) else { return Err(GraphError::NoStreet(StreetId(number))) };
        let [from, to] = [street.from, street.to].map(|end| self.graph.nodes[end].elevation);
        let mut course = vec![self.graph.nodes[street.from].at];
        course.extend(&street.via);
        let mut passed = 0;
        let mut walked = 0.0;
        for pair in course.windows(2) {
            walked += (pair[1] - pair[0]).norm();
            passed += usize::from(walked < station);
        }
        let mut first = street.clone();
        let mut second = street;
        second.via = first.via.split_off(passed);
        // A point at the cut would leave a piece without a direction of its own.
        first.via.retain(|point| (point - at).norm() > LEAST_PIECE);
        second.via.retain(|point| (point - at).norm() > LEAST_PIECE);
        (first.to, second.from) = (node as usize, node as usize);
        // Arrows, and ways that are known, are at the ends that were.
        first.turns.forward.clear();
        first.turns.forward_ways.clear();
        second.turns.backward.clear();
        second.turns.backward_ways.clear();
        // Room to turn is at a dead end, and heights on the way stay where they are.
        (first.turning[1], second.turning[0]) = (0.0, 0.0);
        (first.hammerhead[1], second.hammerhead[0]) = (false, false);
        let kept = first.profile.partition_point(|(at, _)| *at < station);
        let beyond = first.profile.split_off(kept);
        let before = first.profile.last().copied().unwrap_or((0.0, from));
        let moved = beyond.iter().map(|(at, height)| (at - station, *height));
        second.profile = moved.collect::<Vec<_>>().into();
        let rest: f64 = course.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum::<f64>()
            + (self.graph.nodes[second.to].at - course[course.len() - 1]).norm();
        let after = beyond.first().copied().unwrap_or((rest, to));
        let span = after.0 - before.0;
        let share = if span > 0.0 { ((station - before.0) / span).clamp(0.0, 1.0) } else { 0.0 };
        self.graph.nodes[node as usize].elevation = before.1 + (after.1 - before.1) * share;
        self.put_in(first, Some(number))?;
        self.put_in(second, None)?;
        Ok(node)
    }

    fn pull(&mut self, node: NodeId, to: Point2) -> Result<(), GraphError> {
        let halves: Vec<HalfEdge> = self.graph.around(node).collect();
        let streets: Vec<(u32, Option<Street>)> =
            halves.iter().map(|half| half.street().0).map(|number| (number, self.take_out(number))).collect();
        let here = &mut self.graph.nodes[node.index()];
        self.steps.push(Step::NodeMoved(node.0, here.at));
        here.at = to;
        for (number, street) in streets {
            if let Some(street) = street {
                self.put_in(street, Some(number))?;
            }
        }
        Ok(())
    }

    /// Takes all steps back, the last one first. The links are then as before, for the order around nodes follows from
    /// where streets lie; faces were not touched.
    fn take_back(&mut self) {
        let mut unused = Vec::new();
        let mut filled: Vec<u32> = Vec::new();
        while let Some(step) = self.steps.pop() {
            match step {
                Step::StreetIn(number) => {
                    self.graph.detach(number, &mut unused);
                    filled.push(number);
                }
                Step::StreetOut(number, street) => {
                    self.graph.readmit(number, &street);
                    self.graph.attach(number, street, &mut unused);
                }
                Step::NodeIn(number) => {
                    self.graph.nodes[number as usize].lives = false;
                    self.graph.free_nodes.push(number);
                }
                Step::NodeOut(number) => self.graph.nodes[number as usize].lives = true,
                Step::NodeMoved(number, at) => self.graph.nodes[number as usize].at = at,
            }
        }
        filled.retain(|number| self.graph.streets[*number as usize].is_none());
        self.graph.free_streets.extend(filled);
    }

    /// Walks the faces anew that changed, and tells what did.
    fn finish(self) -> Change {
        let mut change = Change::default();
        let Self { graph, steps, changed } = self;
        sort_streets(graph, &steps, &mut change);
        sort_nodes(graph, &steps, &mut change);
        let mut dirty = changed;
        for street in
            change.streets_added.iter().chain(&change.streets_changed).chain(&change.streets_removed)
        {
            dirty.extend([HalfEdge::along(*street).0, HalfEdge::against(*street).0]);
        }
        dirty.sort_unstable();
        dirty.dedup();
        for half in &dirty {
            let face = std::mem::replace(&mut graph.face[*half as usize], NONE);
            change.faces_removed.extend((face != NONE).then_some(FaceId(face)));
        }
        change.faces_removed.sort_unstable();
        change.faces_removed.dedup();
        for face in change.faces_removed.iter().rev() {
            graph.faces[face.index()].first = NONE;
            graph.free_faces.push(face.0);
        }
        for half in dirty {
            let stands = graph.streets[HalfEdge(half).street().index()].is_some();
            if stands && graph.face[half as usize] == NONE {
                change.faces_added.push(graph.walk(half));
            }
        }
        for face in &change.faces_added {
            graph.measure(*face);
        }
        change.faces_added.sort_unstable();
        graph.free_streets.extend(change.streets_removed.iter().rev().map(|street| street.0));
        graph.free_nodes.extend(change.nodes_removed.iter().rev().map(|node| node.0));
        change
    }
}

/// Sorts the streets of an edit by whether they stood before it and whether they do after.
fn sort_streets(graph: &StreetGraph, steps: &[Step], change: &mut Change) {
    let mut seen: Vec<(u32, bool)> = Vec::new();
    for step in steps {
        let (number, stood) = match step {
            Step::StreetIn(number) => (*number, false),
            Step::StreetOut(number, _) => (*number, true),
            _ => continue,
        };
        if !seen.iter().any(|(known, _)| *known == number) {
            seen.push((number, stood));
        }
    }
    seen.sort_unstable();
    for (number, stood) in seen {
        let list = match (stood, graph.streets[number as usize].is_some()) {
            (true, true) => &mut change.streets_changed,
            (true, false) => &mut change.streets_removed,
            (false, true) => &mut change.streets_added,
            (false, false) => continue,
        };
        list.push(StreetId(number));
    }
}

/// Sorts the nodes of an edit, likewise; those at the ends of its streets have changed.
fn sort_nodes(graph: &StreetGraph, steps: &[Step], change: &mut Change) {
    for step in steps {
        match step {
            Step::NodeIn(node) => change.nodes_added.push(NodeId(*node)),
            Step::NodeOut(node) => change.nodes_removed.push(NodeId(*node)),
            Step::NodeMoved(node, _) => change.nodes_changed.push(NodeId(*node)),
            Step::StreetIn(number) => {
                let ends = graph.streets[*number as usize].iter().flat_map(|street| [street.from, street.to]);
                change.nodes_changed.extend(ends.map(|node| NodeId(node as u32)));
            }
            Step::StreetOut(_, street) => {
                change.nodes_changed.extend([street.from, street.to].map(|node| NodeId(node as u32)));
            }
        }
    }
    for list in [&mut change.nodes_added, &mut change.nodes_removed, &mut change.nodes_changed] {
        list.sort_unstable();
        list.dedup();
    }
    let (added, removed) = (&change.nodes_added, &change.nodes_removed);
    change
        .nodes_changed
        .retain(|node| added.binary_search(node).is_err() && removed.binary_search(node).is_err());
}

fn is_near(point: &Point2) -> bool {
    point.x.abs() <= 1e7 && point.y.abs() <= 1e7
}
