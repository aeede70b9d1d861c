//! Contraction: a node goes, and arcs between its neighbours keep the distances that led over it.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::{NONE, WeightedEdge};

/// So many nodes are looked at for a way round the one that goes. A way round that is missed costs an arc, nothing else.
const LOOK: u32 = 200;

/// One end of an arc, kept at the other.
#[derive(Clone, Copy, Debug)]
pub(super) struct Link {
    pub(super) node: u32,
    pub(super) arc: u32,
    pub(super) weight: u64,
}

/// An arc that keeps a distance: from, to, weight, parts.
type Shortcut = (u32, u32, u64, [u32; 2]);

/// A graph that is being contracted. The links of nodes that went stay as they were at that moment: all lead to nodes
/// that went later, or not at all.
pub(super) struct Contraction {
    pub(super) out: Vec<Vec<Link>>,
    pub(super) into: Vec<Vec<Link>>,
    /// Of each arc, the two arcs that it stands for, or the edge that it is and nothing.
    pub(super) parts: Vec<[u32; 2]>,
    /// Of each arc, the nodes that it leads from and to.
    pub(super) ends: Vec<[u32; 2]>,
    gone: Vec<bool>,
    /// How many that went stand below each node, one above another.
    depths: Vec<i64>,
    around: Around,
}

impl Contraction {
    pub(super) fn of(nodes: usize, edges: &[WeightedEdge]) -> Self {
        let mut graph = Self {
            out: vec![Vec::new(); nodes],
            into: vec![Vec::new(); nodes],
            parts: Vec::new(),
            ends: Vec::new(),
            gone: vec![false; nodes],
            depths: vec![0; nodes],
            around: Around { search: vec![0; nodes], weight: vec![0; nodes], ..Around::default() },
        };
        for (index, edge) in edges.iter().enumerate() {
            if edge.from != edge.to && (edge.from.max(edge.to) as usize) < nodes {
                graph.join((edge.from, edge.to, edge.weight, [index as u32, NONE]));
            }
        }
        graph
    }

    pub(super) fn is_gone(&self, node: u32) -> bool {
        self.gone[node as usize]
    }

    /// An arc, unless there is one that costs no more; one that costs more gives way.
    fn join(&mut self, (from, to, weight, parts): Shortcut) {
        let known = self.out[from as usize].iter_mut().find(|link| link.node == to);
        if let Some(known) = known {
            if known.weight <= weight {
                return;
            }
            let arc = known.arc;
            known.weight = weight;
            // No arc has this one as its part: only the arcs of nodes that went are parts.
            self.parts[arc as usize] = parts;
            if let Some(back) = self.into[to as usize].iter_mut().find(|link| link.arc == arc) {
                back.weight = weight;
            }
            return;
        }
        let arc = self.parts.len() as u32;
        self.parts.push(parts);
        self.ends.push([from, to]);
        self.out[from as usize].push(Link { node: to, arc, weight });
        self.into[to as usize].push(Link { node: from, arc, weight });
    }

    /// Contracts nodes, the least costly first, until so many are left; those that went, in order.
    pub(super) fn contract_all_but(&mut self, left: usize) -> Vec<u32> {
        let mut shortcuts = Vec::new();
        let mut queue: BinaryHeap<Reverse<(i64, u32)>> =
            (0..self.out.len() as u32).map(|node| Reverse((self.cost(node, &mut shortcuts), node))).collect();
        let mut order = Vec::new();
        while queue.len() > left
            && let Some(Reverse((_, node))) = queue.pop()
        {
            // What went since may have changed its cost.
            let cost = self.cost(node, &mut shortcuts);
            if queue.peek().is_some_and(|Reverse((least, _))| cost > *least) {
                queue.push(Reverse((cost, node)));
                continue;
            }
            self.contract(node, &shortcuts);
            order.push(node);
        }
        order
    }

    /// What it costs to contract a node: the arcs to be added, twice, less those that go; and its depth, so that nodes go
    /// evenly all over the graph. Writes the arcs to be added over `shortcuts`.
    fn cost(&mut self, node: u32, shortcuts: &mut Vec<Shortcut>) -> i64 {
        self.shortcuts(node, shortcuts);
        let arcs = self.out[node as usize].len() + self.into[node as usize].len();
        2 * shortcuts.len() as i64 - arcs as i64 + self.depths[node as usize]
    }

    /// The arcs that must be added where a node goes.
    fn shortcuts(&mut self, node: u32, shortcuts: &mut Vec<Shortcut>) {
        shortcuts.clear();
        let out = &self.out[node as usize];
        for first in &self.into[node as usize] {
            let others = || out.iter().filter(|second| second.node != first.node);
            let Some(farthest) = others().map(|second| second.weight).max() else { continue };
            self.around.search(&self.out, first.node, node, first.weight.saturating_add(farthest));
            for second in others() {
                let weight = first.weight.saturating_add(second.weight);
                if self.around.weight(second.node) > weight {
                    shortcuts.push((first.node, second.node, weight, [first.arc, second.arc]));
                }
            }
        }
    }

    /// Takes a node out of what is left.
    fn contract(&mut self, node: u32, shortcuts: &[Shortcut]) {
        self.gone[node as usize] = true;
        let depth = self.depths[node as usize] + 1;
        let links = [&self.out, &self.into].into_iter().flat_map(|links| &links[node as usize]);
        for other in links.map(|link| link.node as usize).collect::<Vec<_>>() {
            self.out[other].retain(|link| link.node != node);
            self.into[other].retain(|link| link.node != node);
            self.depths[other] = self.depths[other].max(depth);
        }
        for shortcut in shortcuts {
            self.join(*shortcut);
        }
    }
}

/// Dijkstra's search for ways round a node.
#[derive(Default)]
struct Around {
    /// The search in which the weight of each node was written.
    search: Vec<u32>,
    weight: Vec<u64>,
    current: u32,
    open: BinaryHeap<Reverse<(u64, u32)>>,
}

impl Around {
    fn weight(&self, node: u32) -> u64 {
        if self.search[node as usize] == self.current { self.weight[node as usize] } else { u64::MAX }
    }

    fn reach(&mut self, node: u32, weight: u64) {
        self.search[node as usize] = self.current;
        self.weight[node as usize] = weight;
        self.open.push(Reverse((weight, node)));
    }

    /// Weighs the ways from a node that do not pass another, as far as `most`.
    fn search(&mut self, out: &[Vec<Link>], from: u32, without: u32, most: u64) {
        self.current += 1;
        self.open.clear();
        self.reach(from, 0);
        let mut seen = 0;
        while let Some(Reverse((weight, node))) = self.open.pop() {
            if weight > self.weight(node) {
                continue;
            }
            seen += 1;
            if seen > LOOK {
                return;
            }
            for link in out[node as usize].iter().filter(|link| link.node != without) {
                let beyond = weight.saturating_add(link.weight);
                if beyond <= most && beyond < self.weight(link.node) {
                    self.reach(link.node, beyond);
                }
            }
        }
    }
}
