//! Quickest paths over links whose times change.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::Link;

/// Links by the node that they leave.
pub(super) struct Graph {
    starts: Vec<u32>,
    links: Vec<u32>,
    heads: Vec<u32>,
    // Kept from search to search.
    best: Vec<f64>,
    via: Vec<u32>,
    heap: BinaryHeap<Reverse<(u64, u32)>>,
}

const NONE: u32 = u32::MAX;

impl Graph {
    pub(super) fn new(links: &[Link], nodes: usize) -> Self {
        let mut starts = vec![0; nodes + 1];
        for link in links {
            starts[link.from as usize + 1] += 1;
        }
        for node in 0..nodes {
            starts[node + 1] += starts[node];
        }
        let mut order: Vec<u32> = (0..links.len() as u32).collect();
        order.sort_by_key(|link| links[*link as usize].from);
        let heads = links.iter().map(|link| link.to).collect();
        Self {
            starts,
            links: order,
            heads,
            best: vec![f64::INFINITY; nodes],
            via: vec![NONE; nodes],
            heap: BinaryHeap::new(),
        }
    }

    /// Searches from a node (Dijkstra); then ask for paths.
    pub(super) fn search(&mut self, from: u32, times: &[f64]) {
        self.best.fill(f64::INFINITY);
        self.via.fill(NONE);
        self.heap.clear();
        self.best[from as usize] = 0.0;
        self.heap.push(Reverse((0, from)));
        while let Some(Reverse((bits, node))) = self.heap.pop() {
            let time = f64::from_bits(bits);
            if time > self.best[node as usize] {
                continue;
            }
            let range = self.starts[node as usize] as usize..self.starts[node as usize + 1] as usize;
            for link in &self.links[range] {
                let head = self.heads[*link as usize] as usize;
                let there = time + times[*link as usize];
                // Times are not negative, so their bits are in their order.
                if there < self.best[head] {
                    self.best[head] = there;
                    self.via[head] = *link;
                    self.heap.push(Reverse((there.to_bits(), head as u32)));
                }
            }
        }
    }

    /// Time to a node, infinite if there is no way.
    pub(super) fn time(&self, to: u32) -> f64 {
        self.best[to as usize]
    }

    /// The links of the quickest path to a node, in their order.
    pub(super) fn path(&self, to: u32, links: &[Link]) -> Vec<u32> {
        let (mut path, mut node) = (Vec::new(), to);
        while let Some(via) = Some(self.via[node as usize]).filter(|via| *via != NONE) {
            path.push(via);
            node = links[via as usize].from;
        }
        path.reverse();
        path
    }
}
