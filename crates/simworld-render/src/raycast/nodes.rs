//! The nodes of a tree over instances as rays read them, and how they follow the boxes of its leaves: branch by branch, by as many threads as that is
//! worth, with the same bits whoever does which.

use std::ops::Range;

use bytemuck::{Pod, Zeroable};

use super::bvh::{Box3, Child, NONE, Tree, WIDTH};
use crate::threads;

/// Marks a child as a leaf; beside it stands the number of its first instance.
const IS_LEAF: u32 = 1 << 31;
/// Nodes that are worth a thread.
const SHARE: usize = 1024;

/// A node as in rays.wgsl: four children, their boxes axis by axis; where there is no child the box is inside out.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub(super) struct Node {
    codes: [u32; WIDTH],
    low: [[f32; WIDTH]; 3],
    high: [[f32; WIDTH]; 3],
}

/// Says which instance is at a position of the order of a tree, and in what box.
pub(super) type Leaf<'a> = &'a (dyn Fn(u32) -> (u32, Box3) + Sync);

impl Node {
    /// Makes a child a hole.
    pub(super) fn leave(&mut self, child: usize) {
        self.codes[child] = NONE;
        for axis in 0..3 {
            // Inside out, as an empty box.
            (self.low[axis][child], self.high[axis][child]) = (f32::INFINITY, f32::NEG_INFINITY);
        }
    }

    /// Around all its children.
    fn whole(&self) -> Box3 {
        let of = |child: usize| Box3 {
            low: self.low.map(|sides| sides[child]),
            high: self.high.map(|sides| sides[child]),
        };
        (0..WIDTH).fold(Box3::EMPTY, |all, child| all.grown(of(child)))
    }
}

/// Makes the nodes of a tree, from number `first` on and to the end of all; `branches` are its [branches](Tree::branches).
pub(super) fn code(
    tree: &Tree,
    branches: &[Range<usize>],
    first: u32,
    leaf: Leaf<'_>,
    nodes: &mut Vec<Node>,
) {
    let count = threads::worth(tree.nodes.len(), SHARE);
    code_by(count, tree, branches, first, leaf, nodes);
}

/// The same by so many threads.
fn code_by(
    count: usize,
    tree: &Tree,
    branches: &[Range<usize>],
    first: u32,
    leaf: Leaf<'_>,
    nodes: &mut Vec<Node>,
) {
    let begin = first as usize;
    nodes.resize(begin + tree.nodes.len(), Node::zeroed());
    let (coder, out) = (Coder { tree, first, leaf }, &mut nodes[begin..]);
    if count < 2 {
        return coder.make(0, out);
    }
    let all: usize = branches.iter().map(ExactSizeIterator::len).sum();
    threads::each(shares(out, branches, all.div_ceil(count)), |share| {
        for (start, run) in share {
            coder.make(start, run);
        }
    });
    // The trunk, which leads to these.
    let mut end = out.len();
    for branch in branches.iter().rev() {
        coder.make_some(branch.end..end, out);
        end = branch.start;
    }
    coder.make_some(0..end, out);
}

/// The branches, each with where it starts, in shares of about so many nodes.
fn shares<'a>(
    mut rest: &'a mut [Node],
    branches: &[Range<usize>],
    most: usize,
) -> Vec<Vec<(usize, &'a mut [Node])>> {
    let mut shares = vec![Vec::new()];
    let (mut gone, mut taken) = (0, 0);
    for branch in branches {
        let (_, from) = rest.split_at_mut(branch.start - gone);
        let (own, behind) = from.split_at_mut(branch.len());
        (rest, gone) = (behind, branch.end);
        if taken >= most {
            shares.push(Vec::new());
            taken = 0;
        }
        taken += own.len();
        if let Some(share) = shares.last_mut() {
            share.push((branch.start, own));
        }
    }
    shares
}

/// What nodes are made from.
struct Coder<'a> {
    tree: &'a Tree,
    first: u32,
    leaf: Leaf<'a>,
}

impl Coder<'_> {
    /// Makes a run of nodes, which begins at a number of the tree and leads to no others.
    fn make(&self, start: usize, run: &mut [Node]) {
        // Children come after their parents.
        for place in (0..run.len()).rev() {
            run[place] = self.node(start + place, |child| run[child - start].whole());
        }
    }

    /// Makes some of all nodes.
    fn make_some(&self, some: Range<usize>, all: &mut [Node]) {
        for place in some.rev() {
            all[place] = self.node(place, |child| all[child].whole());
        }
    }

    fn node(&self, number: usize, whole: impl Fn(usize) -> Box3) -> Node {
        let children = &self.tree.nodes[number];
        let boxes = children.map(|child| match child {
            Child::Node(child) => whole(child as usize),
            Child::Leaf { first, count } => {
                (first..first + count).fold(Box3::EMPTY, |all, position| all.grown((self.leaf)(position).1))
            }
            Child::Nothing => Box3::EMPTY,
        });
        let code = |child: Child| match child {
            Child::Node(child) => self.first + child,
            // NONE has the mark of leaves too.
            Child::Leaf { first, .. } => IS_LEAF | (self.leaf)(first).0,
            Child::Nothing => NONE,
        };
        Node {
            codes: children.map(code),
            low: std::array::from_fn(|axis| boxes.map(|one| one.low[axis])),
            high: std::array::from_fn(|axis| boxes.map(|one| one.high[axis])),
        }
    }
}

#[cfg(test)]
mod tests {
    use simworld_core::seed::Seed;

    use super::*;
    use crate::raycast::soup::bound;

    /// Trees of many sizes, by one thread and by several: each box is that of what is below, and not a bit depends on how many threads there are.
    #[test]
    fn many_threads_make_the_nodes_of_one() {
        let mut rng = Seed(31).stream("tests/nodes").rng();
        for count in [0, 1, 5, 300, 6000] {
            let one = |_: u32| {
                let low = [0.0; 3].map(|_: f64| rng.uniform(-400.0, 400.0) as f32);
                Box3 { low, high: low.map(|coordinate| coordinate + 1.5) }
            };
            let boxes: Vec<Box3> = (0..count).map(one).collect();
            let tree = Tree::build(&boxes, 1, 14);
            let leaf = |position: u32| {
                let number = tree.order[position as usize];
                (number, boxes[number as usize])
            };
            let leaves: Vec<Box3> = (0..count).map(|position| leaf(position).1).collect();
            let expected = bound(&tree, &leaves);
            for most in [1, 7, 100, 10_000] {
                let branches = tree.branches(most);
                let mut outcomes = [1, 2, 5].map(|threads| {
                    let mut nodes = vec![Node::zeroed(); 3];
                    code_by(threads, &tree, &branches, 3, &leaf, &mut nodes);
                    nodes
                });
                let [alone, two, five] = &mut outcomes;
                assert!(alone == two && alone == five, "{count} leaves, branches of {most}");
                let own = alone.split_off(3);
                assert_eq!(own.len(), expected.len());
                for (node, boxes) in own.iter().zip(&expected) {
                    assert_eq!(node.whole(), Box3::around_all(boxes));
                }
            }
        }
    }
}
