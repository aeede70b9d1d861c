//! Shortest paths by a contraction hierarchy (Geisberger and others 2008) with a table at its top: a graph is prepared
//! once, and every path after that is found by looking at some dozens of its nodes, however long it is.
//!
//! Nodes are ranked. Contracting them one by one, lowest first, leaves arcs between higher ones that keep all distances;
//! so a shortest path exists that first only climbs in rank and then only descends. The last thousand are not contracted:
//! a table says how far they are from each other. So two short climbs end where the table begins, and all that a search
//! reads lies in flat arrays in the order of ranks.

mod contract;
mod search;
mod table;
#[cfg(test)]
mod tests;

pub use search::{HierarchyScratch, ShortestPath};

use contract::{Contraction, Link};
use table::Table;

const NONE: u32 = u32::MAX;
/// Most nodes in the table, which takes twelve bytes for each pair of them.
const LARGEST_TABLE: usize = 1024;
/// Of so many nodes one comes into the table.
const NODES_A_PLACE: usize = 8;

/// A way from one node of a graph to another.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WeightedEdge {
    /// Where it begins, an index.
    pub from: u32,
    /// Where it leads, an index.
    pub to: u32,
    /// What it costs. Whole numbers, so that a sum does not depend on its order.
    pub weight: u64,
}

/// A directed graph, prepared for shortest paths.
///
/// ```
/// use simworld_core::net::{Hierarchy, HierarchyScratch, WeightedEdge};
/// let edge = |from, to, weight| WeightedEdge { from, to, weight };
/// let hierarchy = Hierarchy::new(3, &[edge(0, 1, 3), edge(1, 2, 4), edge(0, 2, 9)]);
/// let mut scratch = HierarchyScratch::default();
/// let path = hierarchy.shortest(&[(0, 0)], &[(2, 0)], &mut scratch).expect("edges lead there");
/// assert_eq!(path.weight, 7);
/// assert_eq!(scratch.edges(), [0, 1]);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Hierarchy {
    /// The rank of each node.
    ranks: Vec<u32>,
    /// From each rank below the table to higher ones.
    up: Arcs,
    /// To each rank below the table from higher ones.
    down: Arcs,
    /// Of each arc, the two arcs that it stands for, or the edge that it is and nothing.
    parts: Vec<[u32; 2]>,
    /// Of each arc, the ranks that it leads from and to.
    ends: Vec<[u32; 2]>,
    /// The ways between the highest ranks.
    table: Table,
}

/// The arcs of rank i are `all[starts[i]..starts[i + 1]]`.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Arcs {
    starts: Vec<u32>,
    all: Vec<Arc>,
}

/// An arc between a node and a higher one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Arc {
    /// The rank of the higher one.
    higher: u32,
    /// Its number among all arcs.
    number: u32,
    weight: u64,
}

impl Arcs {
    fn of(&self, rank: u32) -> &[Arc] {
        &self.all[self.starts[rank as usize] as usize..self.starts[rank as usize + 1] as usize]
    }

    /// Lays the links of nodes one after another, in the order of ranks.
    fn laid_out(links: &[Vec<Link>], order: &[u32], ranks: &[u32]) -> Self {
        let (mut starts, mut all) = (vec![0], Vec::new());
        for node in order {
            all.extend(links[*node as usize].iter().map(|link| Arc {
                higher: ranks[link.node as usize],
                number: link.arc,
                weight: link.weight,
            }));
            starts.push(all.len() as u32);
        }
        Self { starts, all }
    }
}

impl Hierarchy {
    /// Prepares a graph of so many nodes. The same graph gives the same hierarchy. Edges from a node to itself, or of nodes
    /// that are not there, are left out. A path that weighs 2⁶⁴ - 1 or more counts as none.
    pub fn new(nodes: usize, edges: &[WeightedEdge]) -> Self {
        Self::with_table(nodes, edges, (nodes / NODES_A_PLACE).min(LARGEST_TABLE))
    }

    fn with_table(nodes: usize, edges: &[WeightedEdge], places: usize) -> Self {
        let mut contraction = Contraction::of(nodes, edges);
        let low = contraction.contract_all_but(places);
        let mut order = low.clone();
        order.extend((0..nodes as u32).filter(|node| !contraction.is_gone(*node)));
        let mut ranks = vec![0; nodes];
        for (rank, node) in order.iter().enumerate() {
            ranks[*node as usize] = rank as u32;
        }
        Self {
            up: Arcs::laid_out(&contraction.out, &low, &ranks),
            down: Arcs::laid_out(&contraction.into, &low, &ranks),
            table: Table::of(&contraction, &order, &ranks, low.len()),
            ends: contraction.ends.iter().map(|ends| ends.map(|node| ranks[node as usize])).collect(),
            parts: contraction.parts,
            ranks,
        }
    }

    /// How many nodes it has.
    pub fn nodes(&self) -> usize {
        self.ranks.len()
    }
}
