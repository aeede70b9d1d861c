//! The top of a hierarchy: how far its nodes are from each other, and the first step on the way.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::NONE;
use super::contract::Contraction;

/// The ways between the highest ranks, from `lowest` on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Table {
    lowest: u32,
    /// How many ranks there are.
    count: usize,
    /// The weight from the rank of each row to that of each column; the greatest number where there is no way.
    weights: Vec<u64>,
    /// The first arc on the way to the rank of each row from that of each column: who follows a way stays in one row.
    first: Vec<u32>,
}

/// The memory of the searches that fill a table.
#[derive(Default)]
struct Search {
    /// How many arcs lead to each column.
    steps: Vec<u32>,
    open: BinaryHeap<Reverse<(u64, u32, usize)>>,
}

impl Table {
    /// Measures the ways between the nodes that were not contracted; `order` and `ranks` are of all.
    pub(super) fn of(graph: &Contraction, order: &[u32], ranks: &[u32], lowest: usize) -> Self {
        let count = order.len() - lowest;
        let mut table = Self {
            lowest: lowest as u32,
            count,
            weights: vec![u64::MAX; count * count],
            first: vec![NONE; count * count],
        };
        let mut search = Search::default();
        for row in 0..count {
            table.fill(row, graph, &order[lowest..], ranks, &mut search);
        }
        table
    }

    /// Dijkstra's search from one node. Of ways of the same weight it takes one of the fewest arcs: each step of a way is
    /// then one towards its end, even where arcs weigh nothing.
    fn fill(&mut self, row: usize, graph: &Contraction, nodes: &[u32], ranks: &[u32], search: &mut Search) {
        let (count, first) = (self.count, &mut self.first);
        let weights = &mut self.weights[row * count..(row + 1) * count];
        let Search { steps, open } = search;
        steps.clear();
        steps.resize(count, 0);
        weights[row] = 0;
        open.push(Reverse((0, 0, row)));
        while let Some(Reverse((weight, step, at))) = open.pop() {
            if (weight, step) > (weights[at], steps[at]) {
                continue;
            }
            for link in &graph.out[nodes[at] as usize] {
                let next = (ranks[link.node as usize] - self.lowest) as usize;
                let beyond = (weight.saturating_add(link.weight), step + 1);
                if beyond < (weights[next], steps[next]) {
                    (weights[next], steps[next]) = beyond;
                    first[next * count + row] = if at == row { link.arc } else { first[at * count + row] };
                    open.push(Reverse((beyond.0, beyond.1, next)));
                }
            }
        }
    }

    pub(super) fn has(&self, rank: u32) -> bool {
        rank >= self.lowest
    }

    /// The weights from a rank of the table to each, by the number of the latter.
    pub(super) fn row(&self, from: u32) -> &[u64] {
        let row = (from - self.lowest) as usize * self.count;
        &self.weights[row..row + self.count]
    }

    /// The number of a rank in a row.
    pub(super) fn column(&self, rank: u32) -> usize {
        (rank - self.lowest) as usize
    }

    /// The first arc on the way from one rank to another; [`NONE`] if they are the same or there is no way.
    pub(super) fn first(&self, from: u32, to: u32) -> u32 {
        self.first[self.column(to) * self.count + self.column(from)]
    }
}
