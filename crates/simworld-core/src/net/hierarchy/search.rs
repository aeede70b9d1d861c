//! The search: up from both ends, and through the table where the climbs end.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::table::Table;
use super::{Arcs, Hierarchy, NONE};

/// The memory of searches in hierarchies, kept by the caller, so that a search after the first few allocates nothing. It
/// serves hierarchies of every size.
#[derive(Clone, Debug, Default)]
pub struct HierarchyScratch {
    climbs: [Climb; 2],
    /// Arcs still to be unpacked.
    arcs: Vec<u32>,
    /// The edges of the last path.
    edges: Vec<u32>,
}

/// What a search found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ShortestPath {
    /// What it costs, its beginning and end included.
    pub weight: u64,
    /// Where it begins, an index into the starts that were given.
    pub start: usize,
    /// Where it ends, an index into the ends that were given.
    pub end: usize,
}

/// How one rank was reached.
#[derive(Clone, Copy, Debug)]
struct Label {
    weight: u64,
    /// The search in which it was written; older ones count as unknown.
    search: u32,
    /// The arc that led here, or [`NONE`] where the climb began.
    arc: u32,
}

/// One of the two climbs.
#[derive(Clone, Debug, Default)]
struct Climb {
    labels: Vec<Label>,
    current: u32,
    open: BinaryHeap<Reverse<(u64, u32)>>,
    /// The ranks of the table that it came to.
    tops: Vec<u32>,
}

impl Climb {
    /// Forgets the last search without touching its memory.
    fn begin(&mut self, nodes: usize) {
        if self.labels.len() < nodes || self.current == u32::MAX {
            self.labels.clear();
            self.labels.resize(nodes, Label { weight: 0, search: 0, arc: NONE });
            self.current = 0;
        }
        self.current += 1;
        self.open.clear();
        self.tops.clear();
    }

    fn weight(&self, rank: u32) -> u64 {
        let label = &self.labels[rank as usize];
        if label.search == self.current { label.weight } else { u64::MAX }
    }

    fn reach(&mut self, rank: u32, weight: u64, arc: u32, table: &Table) {
        let label = &mut self.labels[rank as usize];
        let is_new = label.search != self.current;
        if is_new || weight < label.weight {
            *label = Label { weight, search: self.current, arc };
            if !table.has(rank) {
                self.open.push(Reverse((weight, rank)));
            } else if is_new {
                self.tops.push(rank);
            }
        }
    }

    /// Whether a rank was reached from a higher one at less: then no shortest path climbs from it.
    fn is_stalled(&self, rank: u32, weight: u64, against: &Arcs) -> bool {
        against.of(rank).iter().any(|arc| {
            let label = &self.labels[arc.higher as usize];
            label.search == self.current && label.weight.saturating_add(arc.weight) < weight
        })
    }

    /// Climbs until no shorter way than `most` can follow, and shows each rank that it leaves, with its weight.
    fn climb(
        &mut self,
        hierarchy: &Hierarchy,
        way: Way,
        mut most: u64,
        mut meet: impl FnMut(u32, u64) -> u64,
    ) {
        let (along, against) = match way {
            Way::Forth => (&hierarchy.up, &hierarchy.down),
            Way::Back => (&hierarchy.down, &hierarchy.up),
        };
        while let Some(Reverse((weight, rank))) = self.open.pop() {
            if weight >= most {
                return;
            }
            if weight > self.labels[rank as usize].weight || self.is_stalled(rank, weight, against) {
                continue;
            }
            most = meet(rank, weight);
            for arc in along.of(rank) {
                self.reach(arc.higher, weight.saturating_add(arc.weight), arc.number, &hierarchy.table);
            }
        }
    }
}

/// The direction of a climb: with the edges, or against them.
#[derive(Clone, Copy)]
enum Way {
    Forth,
    Back,
}

/// Where the two climbs of the shortest path end: on one rank, or on two of the table.
#[derive(Clone, Copy)]
struct Summit {
    weight: u64,
    forth: u32,
    back: u32,
}

impl HierarchyScratch {
    /// The edges of the path that was found last, first to last, as indices of those given to [`Hierarchy::new`].
    pub fn edges(&self) -> &[u32] {
        &self.edges
    }
}

impl Hierarchy {
    /// The least weight of a path from one of some nodes to one of some others, each with what it costs to begin or end
    /// there; `None` if there is none. The path itself is then [`HierarchyScratch::edges`]. Nodes that are not there are
    /// passed over.
    pub fn shortest(
        &self,
        starts: &[(u32, u64)],
        ends: &[(u32, u64)],
        scratch: &mut HierarchyScratch,
    ) -> Option<ShortestPath> {
        scratch.edges.clear();
        let [forth, back] = &mut scratch.climbs;
        for (climb, places) in [(&mut *forth, starts), (&mut *back, ends)] {
            climb.begin(self.nodes());
            for (node, weight) in places {
                if let Some(rank) = self.ranks.get(*node as usize) {
                    climb.reach(*rank, *weight, NONE, &self.table);
                }
            }
        }
        let mut summit = Summit { weight: u64::MAX, forth: NONE, back: NONE };
        forth.climb(self, Way::Forth, u64::MAX, |_, _| u64::MAX);
        back.climb(self, Way::Back, u64::MAX, |rank, weight| {
            let sum = weight.saturating_add(forth.weight(rank));
            if sum < summit.weight {
                summit = Summit { weight: sum, forth: rank, back: rank };
            }
            summit.weight
        });
        self.look_up(forth, back, &mut summit);
        if summit.forth == NONE {
            return None;
        }
        let [first, last] = self.unpack(summit, scratch);
        let used = |places: &[(u32, u64)], rank: u32| {
            let here = places
                .iter()
                .enumerate()
                .filter(|(_, (node, _))| self.ranks.get(*node as usize) == Some(&rank));
            here.min_by_key(|(_, (_, weight))| *weight).map(|(index, _)| index)
        };
        Some(ShortestPath { weight: summit.weight, start: used(starts, first)?, end: used(ends, last)? })
    }

    /// Betters a summit by the ways through the table.
    fn look_up(&self, forth: &Climb, back: &Climb, summit: &mut Summit) {
        for from in &forth.tops {
            let (weight, row) = (forth.labels[*from as usize].weight, self.table.row(*from));
            if weight >= summit.weight {
                continue;
            }
            for to in &back.tops {
                let between = row[self.table.column(*to)];
                let sum = between.saturating_add(weight).saturating_add(back.labels[*to as usize].weight);
                if sum < summit.weight {
                    *summit = Summit { weight: sum, forth: *from, back: *to };
                }
            }
        }
    }

    /// Writes the edges of the path over a summit; the ranks at which it begins and ends.
    fn unpack(&self, summit: Summit, scratch: &mut HierarchyScratch) -> [u32; 2] {
        let HierarchyScratch { climbs: [forth, back], arcs, edges } = scratch;
        arcs.clear();
        let first = self.trace(summit.forth, forth, 0, arcs);
        self.unpack_arcs(arcs, edges);
        let mut at = summit.forth;
        while at != summit.back {
            let arc = self.table.first(at, summit.back);
            arcs.push(arc);
            self.unpack_arcs(arcs, edges);
            at = self.ends[arc as usize][1];
        }
        let last = self.trace(summit.back, back, 1, arcs);
        arcs.reverse();
        self.unpack_arcs(arcs, edges);
        [first, last]
    }

    /// Takes all arcs, the last one first, and adds the edges for which they stand.
    fn unpack_arcs(&self, arcs: &mut Vec<u32>, edges: &mut Vec<u32>) {
        while let Some(arc) = arcs.pop() {
            let [first, second] = self.parts[arc as usize];
            if second == NONE {
                edges.push(first);
            } else {
                arcs.extend([second, first]);
            }
        }
    }

    /// Collects the arcs of a climb from its summit down to the rank at which it began, which it returns; a climb began
    /// at the given end of its arcs.
    fn trace(&self, summit: u32, climb: &Climb, end: usize, arcs: &mut Vec<u32>) -> u32 {
        let mut rank = summit;
        loop {
            let arc = climb.labels[rank as usize].arc;
            if arc == NONE {
                return rank;
            }
            arcs.push(arc);
            rank = self.ends[arc as usize][end];
        }
    }
}
