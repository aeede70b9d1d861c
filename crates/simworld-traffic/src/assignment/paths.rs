//! Quickest paths over links whose times change.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use simworld_core::lists::Lists;

use super::Link;

/// Links by the node that they leave.
pub(super) struct Graph {
    links: Lists<u32>,
    heads: Vec<u32>,
    // Kept from search to search.
    best: Vec<f64>,
    via: Vec<u32>,
    heap: BinaryHeap<Reverse<(u64, u32)>>,
}

const NONE: u32 = u32::MAX;

impl Graph {
    pub(super) fn new(links: &[Link], nodes: usize) -> Self {
        let heads = links.iter().map(|link| link.to).collect();
        Self {
            links: Lists::of(nodes, links.iter().map(|link| link.from as usize).zip(0..)),
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
            for link in &self.links[node as usize] {
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
