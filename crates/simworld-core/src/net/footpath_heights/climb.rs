//! How ways for walkers climb from the ground to the height that they need.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};

use super::passages::{Passage, sidewalk};
use super::{FOOTBRIDGE_STOREY, LEAST, RAMP_GRADE, STAIRS_GRADE};
use crate::geometry::Point2;
use crate::net::RoadNetwork;

/// What may be missing of a height, m.
const TOLERATED: f64 = 1e-6;
/// On less than this nothing climbs, m.
const SHORTEST: f64 = 0.5;

/// A way between two nodes.
struct Way {
    nodes: [usize; 2],
    length: f64,
    is_deck: bool,
    /// The height that it has where it need not climb, m.
    top: f64,
    /// How steeply one may climb it from its beginning and from its end, rise over run.
    grades: [f64; 2],
}

impl Way {
    /// How far it is from one of its ends to a passage over a street, m.
    fn before(&self, passage: &Passage, end: usize) -> f64 {
        if end == 0 { passage.from } else { (self.length - passage.to).max(0.0) }
    }
}

/// A place where ways end.
#[derive(Default)]
struct Node {
    /// Each with the end that is here.
    ways: Vec<(usize, usize)>,
    at: Point2,
    joins: bool,
    is_on_ground: bool,
    /// Whether it stays at its height: a sidewalk or a subway begins there.
    is_fixed: bool,
    /// The greatest height that it may have, m.
    most: f64,
    /// Its height, m.
    height: f64,
    /// The way and its end from which one climbs to it, unless it is as high as it may be.
    from: Option<(usize, usize)>,
}

/// The ways for walkers as a graph.
pub(super) struct Climb {
    ways: Vec<Way>,
    nodes: Vec<Node>,
}

impl Climb {
    pub(super) fn of(network: &RoadNetwork, passages: &[Passage]) -> Self {
        let mut climb = Self { ways: Vec::new(), nodes: Vec::new() };
        let mut known: BTreeMap<[u64; 2], usize> = BTreeMap::new();
        for (index, footpath) in network.footpaths.iter().enumerate() {
            let ends =
                [footpath.path.first(), footpath.path.last()].map(|end| end.copied().unwrap_or_default());
            let nodes = [0, 1].map(|end| {
                let at: Point2 = ends[end];
                let node = *known.entry([at.x.to_bits(), at.y.to_bits()]).or_insert(climb.nodes.len());
                if node == climb.nodes.len() {
                    climb.nodes.push(Node { at, ..Node::default() });
                }
                let node_here = &mut climb.nodes[node];
                node_here.ways.push((index, end));
                node_here.joins |= footpath.joins[end];
                node_here.is_fixed |= footpath.joins[end] || footpath.level < 0;
                node_here.is_on_ground |= footpath.joins[end] || footpath.level <= 0;
                node
            });
            let grade = if footpath.steps { STAIRS_GRADE } else { RAMP_GRADE };
            climb.ways.push(Way {
                nodes,
                length: super::length(network, index),
                is_deck: footpath.level > 0,
                top: f64::from(footpath.level.max(0)) * FOOTBRIDGE_STOREY,
                grades: [grade; 2],
            });
        }
        for passage in passages {
            let way = &mut climb.ways[passage.way];
            way.top = way.top.max(passage.need);
        }
        climb.bound(network, passages);
        climb
    }

    /// The greatest height of every node: on the ground none but what stairs are short of, elsewhere that of the lowest way.
    fn bound(&mut self, network: &RoadNetwork, passages: &[Passage]) {
        let raised = self.raised(passages);
        let Self { ways, nodes } = self;
        for (node, raised) in nodes.iter_mut().zip(raised) {
            let decks = node.ways.iter().map(|(way, _)| &ways[*way]).filter(|way| way.is_deck);
            let lowest = decks.map(|way| way.top).fold(f64::INFINITY, f64::min);
            node.most = match () {
                // No deck is there.
                () if lowest.is_infinite() => 0.0,
                () if node.joins => sidewalk(network, node.at),
                () if node.is_fixed => 0.0,
                () if node.is_on_ground => raised,
                () => lowest.max(raised),
            };
        }
    }

    /// How high each node has to be so that stairs lead from there over all streets.
    fn raised(&self, passages: &[Passage]) -> Vec<f64> {
        let mut raised = vec![0.0; self.nodes.len()];
        let mut queue: BinaryHeap<(Height, Reverse<usize>)> = BinaryHeap::new();
        for passage in passages {
            let way = &self.ways[passage.way];
            queue.extend((0..2).map(|end| {
                let height = passage.need - STAIRS_GRADE * way.before(passage, end);
                (Height(height), Reverse(way.nodes[end]))
            }));
        }
        while let Some((Height(height), Reverse(node))) = queue.pop() {
            if height <= raised[node] || self.nodes[node].is_fixed {
                continue;
            }
            raised[node] = height;
            queue.extend(self.nodes[node].ways.iter().map(|(way, end)| {
                let way = &self.ways[*way];
                (Height(height - STAIRS_GRADE * way.length), Reverse(way.nodes[1 - end]))
            }));
        }
        raised
    }

    /// The profiles of all ways, once they are high enough over all streets.
    pub(super) fn profiles(mut self, passages: &[Passage]) -> Vec<Vec<(f64, f64)>> {
        // A round makes a side of a way steeper, or finds none that is to be; each becomes steeper a few times at most.
        for _ in 0..4 * self.ways.len() + 8 {
            self.climb();
            let mut is_changed = false;
            for passage in passages {
                is_changed |= self.steepen(passage);
            }
            if !is_changed {
                break;
            }
        }
        self.descend();
        self.ways.iter().map(|way| if way.is_deck { self.deck(way) } else { self.stairs(way) }).collect()
    }

    /// The height of every node: as high as it may be and as ways lead up to it.
    fn climb(&mut self) {
        let Self { ways, nodes } = self;
        for node in nodes.iter_mut() {
            (node.height, node.from) = (node.most, None);
        }
        let mut is_changed = true;
        while std::mem::take(&mut is_changed) {
            for (index, way) in ways.iter().enumerate().filter(|(_, way)| way.is_deck) {
                for end in 0..2 {
                    let height = nodes[way.nodes[end]].height + way.grades[end] * way.length;
                    let other = &mut nodes[way.nodes[1 - end]];
                    if height < other.height {
                        (other.height, other.from) = (height, Some((index, end)));
                        is_changed = true;
                    }
                }
            }
        }
    }

    /// Makes what leads to a passage steeper if it is too low: stairs first, and where that is not enough as steep as need be.
    fn steepen(&mut self, passage: &Passage) -> bool {
        let mut is_changed = false;
        for end in 0..2 {
            let way = &self.ways[passage.way];
            let before = way.before(passage, end);
            let height = self.nodes[way.nodes[end]].height + way.grades[end] * before;
            if height >= passage.need - TOLERATED {
                continue;
            }
            let (chain, source) = self.chain((passage.way, end));
            let run: f64 = chain[1..].iter().map(|(way, _)| self.ways[*way].length).sum::<f64>() + before;
            let is_stairs = chain.iter().all(|(way, end)| self.ways[*way].grades[*end] >= STAIRS_GRADE);
            let grade = match () {
                () if !is_stairs => STAIRS_GRADE,
                () if run < SHORTEST => continue,
                () => (passage.need - self.nodes[source].height) / run,
            };
            for (way, end) in chain {
                let own = &mut self.ways[way].grades[end];
                is_changed |= *own < grade;
                *own = own.max(grade);
            }
        }
        is_changed
    }

    /// The ways by which one climbs, the last first, each with the end from which one comes, and the node where that begins.
    fn chain(&self, last: (usize, usize)) -> (Vec<(usize, usize)>, usize) {
        let mut chain = vec![last];
        let mut node = self.ways[last.0].nodes[last.1];
        // Every way leads from a lower node, so that this ends.
        while let Some((way, end)) = self.nodes[node].from.filter(|_| chain.len() <= self.ways.len()) {
            chain.push((way, end));
            node = self.ways[way].nodes[end];
        }
        (chain, node)
    }

    /// Stairs lead down from nodes that stairs above were short of.
    fn descend(&mut self) {
        let Self { ways, nodes } = self;
        let mut queue: BinaryHeap<(Height, Reverse<usize>)> = BinaryHeap::new();
        for (index, node) in nodes.iter().enumerate().filter(|(_, node)| node.is_on_ground) {
            queue.push((Height(node.height), Reverse(index)));
        }
        let mut is_done = vec![false; nodes.len()];
        while let Some((Height(height), Reverse(index))) = queue.pop() {
            if height <= LEAST || std::mem::replace(&mut is_done[index], true) {
                continue;
            }
            // Where a deck begins the height is known.
            let has_deck = nodes[index].ways.iter().any(|(way, _)| ways[*way].is_deck);
            if !has_deck && !nodes[index].is_fixed {
                nodes[index].height = nodes[index].height.max(height);
            }
            let height = nodes[index].height;
            let ground = nodes[index].ways.iter().map(|(way, end)| (&ways[*way], end));
            queue.extend(
                ground.filter(|(way, _)| !way.is_deck).map(|(way, end)| {
                    (Height(height - STAIRS_GRADE * way.length), Reverse(way.nodes[1 - end]))
                }),
            );
        }
    }

    /// A way above the ground: up from either end as steeply as is allowed, and level between.
    fn deck(&self, way: &Way) -> Vec<(f64, f64)> {
        let [a, b] = way.nodes.map(|node| self.nodes[node].height);
        let (top, [up, down], length) = (way.top.max(a).max(b), way.grades, way.length);
        let (rise, fall) = ((top - a) / up, length - (top - b) / down);
        let between = if rise <= fall {
            vec![(rise, top), (fall, top)]
        } else {
            let peak = ((b + down * length - a) / (up + down)).clamp(0.0, length);
            vec![(peak, a + up * peak)]
        };
        profile(a, &between, b, length)
    }

    /// A way on the ground: stairs down from where a bridge ends.
    fn stairs(&self, way: &Way) -> Vec<(f64, f64)> {
        let [a, b] = way.nodes.map(|node| self.nodes[node].height);
        let length = way.length;
        let (foot, next) = (a / STAIRS_GRADE, length - b / STAIRS_GRADE);
        let between = if foot <= next {
            vec![(foot, 0.0), (next, 0.0)]
        } else {
            // From both ends to a landing between, if it is not all the way down.
            let low = ((a - b) / STAIRS_GRADE + length) * 0.5;
            if (0.0..=length).contains(&low) { vec![(low, a - STAIRS_GRADE * low)] } else { Vec::new() }
        };
        profile(a, &between, b, length)
    }
}

/// A profile with its bends between the ends; none on the ground.
fn profile(a: f64, between: &[(f64, f64)], b: f64, length: f64) -> Vec<(f64, f64)> {
    if a.max(b).max(between.iter().map(|(_, height)| *height).fold(0.0, f64::max)) <= LEAST {
        return Vec::new();
    }
    let mut bends = vec![(0.0, a)];
    for (station, height) in between {
        if *station > bends[bends.len() - 1].0 + LEAST && *station < length - LEAST {
            bends.push((*station, *height));
        }
    }
    bends.push((length, b));
    bends
}

/// A height in a queue, the highest first.
#[derive(PartialEq)]
struct Height(f64);

impl Eq for Height {}

impl Ord for Height {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.0.total_cmp(&other.0)
    }
}

impl PartialOrd for Height {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}
