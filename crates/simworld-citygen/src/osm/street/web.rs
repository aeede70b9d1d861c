//! Streets while they are made: nodes and edges that can be joined, cut, merged and removed.

use simworld_core::geometry::Point2;
use simworld_core::net::{RoadClass, polyline};

use super::over::Over;
use super::profile::Profile;
use super::turns::Turns;
use crate::simplify::simplified;

/// No name.
pub(super) const UNNAMED: u32 = u32::MAX;
/// How far the line of a street may be from the one that was drawn, m.
const TOLERANCE: f64 = 0.4;

/// What a street is like.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Character {
    /// The way that it was, or the longest of those that it was.
    pub(super) way: i64,
    pub(super) class: RoadClass,
    pub(super) profile: Profile,
    pub(super) name: u32,
    /// Speed limit, m/s; 0 for that of the class.
    pub(super) speed: f64,
    /// Above or below the ground.
    pub(super) level: i8,
    /// Whether something is built above it.
    pub(super) is_covered: bool,
    pub(super) is_roundabout: bool,
    pub(super) is_link: bool,
}

impl Character {
    /// The same, seen from the other end.
    pub(super) fn mirrored(&self) -> Self {
        Self { profile: self.profile.mirrored(), ..*self }
    }

    /// Whether two are one street but for the way that they were.
    fn continues(&self, other: &Self) -> bool {
        Self { way: 0, ..*self } == Self { way: 0, ..*other }
    }
}

/// Where edges meet.
#[derive(Clone, Debug)]
pub(super) struct Node {
    pub(super) at: Point2,
    /// How far the nodes that became this one lie from it, m.
    pub(super) spread: f64,
    /// The edges that begin or end here; one that does both stands here twice.
    pub(super) edges: Vec<u32>,
}

/// A street between two nodes.
#[derive(Clone, Debug)]
pub(super) struct Edge {
    pub(super) ends: [u32; 2],
    pub(super) via: Vec<Point2>,
    pub(super) character: Character,
    /// How far to the right of each end, seen along the course, the street was drawn before that end was moved, m.
    pub(super) aside: [f64; 2],
    /// What is said about the turns from it at each end.
    pub(super) turns: [Turns; 2],
    pub(super) lives: bool,
}

impl Edge {
    /// The node at the other end.
    pub(super) fn other(&self, node: u32) -> u32 {
        if self.ends[0] == node { self.ends[1] } else { self.ends[0] }
    }
}

/// Nodes and edges.
#[derive(Clone, Debug, Default)]
pub(super) struct Web {
    pub(super) nodes: Vec<Node>,
    pub(super) edges: Vec<Edge>,
    pub(super) names: Vec<String>,
    /// Signs that forbid turns over ways.
    pub(super) signs_over: Vec<Over>,
}

impl Web {
    pub(super) fn add_node(&mut self, at: Point2) -> u32 {
        self.nodes.push(Node { at, spread: 0.0, edges: Vec::new() });
        self.nodes.len() as u32 - 1
    }

    pub(super) fn add_edge(&mut self, ends: [u32; 2], via: Vec<Point2>, character: Character) -> u32 {
        let number = self.edges.len() as u32;
        for end in ends {
            self.nodes[end as usize].edges.push(number);
        }
        self.edges.push(Edge {
            ends,
            via,
            character,
            aside: [0.0; 2],
            turns: <[Turns; 2]>::default(),
            lives: true,
        });
        number
    }

    /// Takes an edge away.
    pub(super) fn remove(&mut self, edge: u32) {
        let Edge { ends, lives, .. } = &mut self.edges[edge as usize];
        *lives = false;
        let ends = *ends;
        for end in ends {
            let edges = &mut self.nodes[end as usize].edges;
            if let Some(index) = edges.iter().position(|other| *other == edge) {
                edges.remove(index);
            }
        }
    }

    /// The edges that are there.
    pub(super) fn living(&self) -> impl Iterator<Item = (u32, &Edge)> {
        (0..).zip(&self.edges).filter(|(_, edge)| edge.lives)
    }

    pub(super) fn edge(&self, edge: u32) -> &Edge {
        &self.edges[edge as usize]
    }

    pub(super) fn node(&self, node: u32) -> &Node {
        &self.nodes[node as usize]
    }

    /// The number of edges at a node.
    pub(super) fn degree(&self, node: u32) -> usize {
        self.nodes[node as usize].edges.len()
    }

    /// The points of an edge, ends included.
    pub(super) fn course(&self, edge: u32) -> Vec<Point2> {
        let Edge { ends, via, .. } = self.edge(edge);
        let mut line = Vec::with_capacity(via.len() + 2);
        line.push(self.node(ends[0]).at);
        line.extend_from_slice(via);
        line.push(self.node(ends[1]).at);
        line
    }

    /// Length of an edge, m.
    pub(super) fn length(&self, edge: u32) -> f64 {
        let Edge { ends, via, .. } = self.edge(edge);
        let mut before = self.node(ends[0]).at;
        let mut sum = 0.0;
        for point in via.iter().chain([&self.node(ends[1]).at]) {
            sum += (point - before).norm();
            before = *point;
        }
        sum
    }

    /// Joins the two edges of a node of two into one; it is like the longer of them. Says whether that was possible.
    pub(super) fn dissolve(&mut self, node: u32) -> Option<u32> {
        let [first, second] = self.nodes[node as usize].edges[..] else { return None };
        if first == second {
            return None;
        }
        let (before, after) = (self.edge(first).other(node), self.edge(second).other(node));
        if before == after {
            return None;
        }
        // Both edges run from `before` over the node to `after`.
        let turned = [self.edge(first).ends[1] != node, self.edge(second).ends[0] != node];
        let longer = usize::from(self.length(second) > self.length(first));
        let like = [first, second][longer];
        let mut character = self.edge(like).character;
        if turned[longer] {
            character = character.mirrored();
        }
        let aside = |edge: u32, is_turned: bool| {
            let [start, end] = self.edge(edge).aside;
            if is_turned { [-end, -start] } else { [start, end] }
        };
        let aside = [aside(first, turned[0])[0], aside(second, turned[1])[1]];
        let far = |edge: u32, end: usize| self.edge(edge).turns[end];
        let mut turns = [far(first, usize::from(turned[0])), far(second, usize::from(!turned[1]))];
        let mut via = std::mem::take(&mut self.edges[first as usize].via);
        if turned[0] {
            via.reverse();
        }
        via.push(self.node(node).at);
        let mut rest = std::mem::take(&mut self.edges[second as usize].via);
        if turned[1] {
            rest.reverse();
        }
        via.append(&mut rest);
        self.remove(first);
        self.remove(second);
        // A street driven one way runs the way it is driven.
        let is_against = character.profile.forward == 0;
        let (ends, aside, character) = if is_against {
            via.reverse();
            turns.swap(0, 1);
            ([after, before], [-aside[1], -aside[0]], character.mirrored())
        } else {
            ([before, after], aside, character)
        };
        let joined = self.add_edge(ends, via, character);
        self.edges[joined as usize].aside = aside;
        self.edges[joined as usize].turns = turns;
        Some(joined)
    }

    /// Joins edges that are alike at all nodes where only two meet.
    pub(super) fn join_all(&mut self) {
        for node in 0..self.nodes.len() as u32 {
            let [first, second] = self.nodes[node as usize].edges[..] else { continue };
            let (a, b) = (self.edge(first), self.edge(second));
            // Seen along one line through the node.
            let leads_on = a.ends[1] == node;
            let goes_on = b.ends[0] == node;
            let other = if leads_on == goes_on { b.character } else { b.character.mirrored() };
            if first != second && a.character.continues(&other) {
                self.dissolve(node);
            }
        }
    }

    /// Cuts an edge at a station of its course, m; gives the node there and the new second part.
    pub(super) fn cut(&mut self, edge: u32, station: f64) -> (u32, u32) {
        let course = self.course(edge);
        let at = polyline::at(&course, station).0;
        let node = self.add_node(at);
        let (mut before, mut after, mut walked) = (Vec::new(), Vec::new(), 0.0);
        let count = course.len();
        for (index, pair) in course.windows(2).enumerate() {
            walked += (pair[1] - pair[0]).norm();
            if index + 2 < count {
                if walked < station { before.push(pair[1]) } else { after.push(pair[1]) }
            }
        }
        let Edge { ends, character, aside, turns, .. } = *self.edge(edge);
        self.edges[edge as usize].via = before;
        self.edges[edge as usize].aside[1] = 0.0;
        self.edges[edge as usize].turns[1] = Turns::default();
        self.edges[edge as usize].ends[1] = node;
        let there = &mut self.nodes[ends[1] as usize].edges;
        // A loop stands there twice; its end is the later.
        if let Some(index) = there.iter().rposition(|other| *other == edge) {
            there.remove(index);
        }
        self.nodes[node as usize].edges.push(edge);
        let second = self.add_edge([node, ends[1]], after, character);
        self.edges[second as usize].aside[1] = aside[1];
        self.edges[second as usize].turns[1] = turns[1];
        (node, second)
    }

    /// Moves all edges of one node to another, which then lies at a point.
    pub(super) fn merge(&mut self, from: u32, into: u32, at: Point2) {
        for node in [from, into] {
            self.note_move(node, at);
        }
        for edge in std::mem::take(&mut self.nodes[from as usize].edges) {
            for end in &mut self.edges[edge as usize].ends {
                if *end == from {
                    *end = into;
                }
            }
            self.nodes[into as usize].edges.push(edge);
        }
        let (a, b) = (self.node(from), self.node(into));
        let spread = (a.spread + (a.at - at).norm()).max(b.spread + (b.at - at).norm());
        let node = &mut self.nodes[into as usize];
        (node.at, node.spread) = (at, spread);
    }

    /// Notes how far the edges of a node move sideways when it moves.
    fn note_move(&mut self, node: u32, to: Point2) {
        let was = self.node(node).at;
        for edge in self.node(node).edges.clone() {
            let Edge { ends, via, .. } = self.edge(edge);
            let [start, end] = ends.map(|end| self.node(end).at);
            let first = via.first().copied().unwrap_or(end) - start;
            let last = end - via.last().copied().unwrap_or(start);
            let is_end = ends.map(|end| end == node);
            for (index, along) in [first, last].into_iter().enumerate().filter(|(index, _)| is_end[*index]) {
                if let Some(along) = along.try_normalize(1e-6) {
                    self.edges[edge as usize].aside[index] += (was - to).perp(&along);
                }
            }
        }
    }

    /// Takes points out of all courses that say nothing.
    pub(super) fn simplify(&mut self) {
        for edge in 0..self.edges.len() as u32 {
            if self.edge(edge).lives && !self.edge(edge).via.is_empty() {
                let course = self.course(edge);
                let kept = simplified(&course, TOLERANCE);
                self.edges[edge as usize].via = kept[1..kept.len() - 1].to_vec();
            }
        }
    }
}
