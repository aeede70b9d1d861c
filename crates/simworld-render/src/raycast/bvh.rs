//! Trees of boxes with four children a node: the topology by binned surface areas (Wald 2007) of halves, of which two levels at a time are joined
//! where their boxes are largest; the same for the same boxes.

use std::ops::Range;

/// A box, least and greatest corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Box3 {
    pub low: [f32; 3],
    pub high: [f32; 3],
}

/// No child.
pub(super) const NONE: u32 = u32::MAX;
/// Children of a node.
pub(super) const WIDTH: usize = 4;
/// Bins an axis. With half as many, rays through a city walk a seventh more nodes.
const BINS: usize = 32;

/// A child of a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Child {
    Node(u32),
    /// A run of [`Tree::order`].
    Leaf {
        first: u32,
        count: u32,
    },
    Nothing,
}

/// Nodes in which every child comes after its parent; the first is the root.
#[derive(Clone, Debug, Default)]
pub(super) struct Tree {
    pub nodes: Vec<[Child; WIDTH]>,
    /// The numbers of the boxes, leaf by leaf.
    pub order: Vec<u32>,
}

impl Box3 {
    pub(super) const EMPTY: Self = Self { low: [f32::INFINITY; 3], high: [f32::NEG_INFINITY; 3] };

    pub(super) fn grown(self, other: Self) -> Self {
        Self {
            low: std::array::from_fn(|axis| self.low[axis].min(other.low[axis])),
            high: std::array::from_fn(|axis| self.high[axis].max(other.high[axis])),
        }
    }

    pub(super) fn around(points: impl IntoIterator<Item = [f32; 3]>) -> Self {
        points.into_iter().fold(Self::EMPTY, |all, point| all.grown(Self { low: point, high: point }))
    }

    pub(super) fn around_all<'a>(boxes: impl IntoIterator<Item = &'a Self>) -> Self {
        boxes.into_iter().fold(Self::EMPTY, |all, one| all.grown(*one))
    }

    fn center(&self, axis: usize) -> f32 {
        (self.low[axis] + self.high[axis]) * 0.5
    }

    /// Half of its surface; 0 for the empty box.
    fn area(&self) -> f32 {
        let [x, y, z] = std::array::from_fn(|axis| (self.high[axis] - self.low[axis]).max(0.0));
        x * y + y * z + z * x
    }
}

/// Halves of halves, before they are joined.
struct Halves {
    nodes: Vec<[Child; 2]>,
    /// Surfaces of both halves.
    areas: Vec<[f32; 2]>,
    order: Vec<u32>,
}

impl Tree {
    /// A tree with at most `leaf` boxes a leaf, and at most so many levels as long as there are no more boxes than `leaf` times four to the power of that.
    pub(super) fn build(boxes: &[Box3], leaf: usize, levels: u32) -> Self {
        let tree = Halves::build(boxes, leaf, None).joined(true);
        if tree.levels() <= levels {
            return tree;
        }
        // Of halves that are not too deep any two levels are one.
        Halves::build(boxes, leaf, Some(2 * levels)).joined(false)
    }

    /// Runs of nodes that lead to none but their own, each of at most so many, in ascending order: what several threads may follow at once. What is in
    /// none of them leads to these.
    pub(super) fn branches(&self, most: usize) -> Vec<Range<usize>> {
        // What is below a node lies together, since it is laid out before anything else is.
        let below = |node: usize| {
            self.nodes[node].iter().filter_map(|child| match child {
                Child::Node(child) => Some(*child as usize),
                _ => None,
            })
        };
        let mut ends: Vec<usize> = (1..=self.nodes.len()).collect();
        for node in (0..ends.len()).rev() {
            ends[node] = below(node).fold(node + 1, |end, child| end.max(ends[child]));
        }
        let (mut branches, mut open) = (Vec::new(), Vec::new());
        open.extend((!self.nodes.is_empty()).then_some(0));
        while let Some(node) = open.pop() {
            let Some(first) = below(node).min() else { continue };
            if ends[node] - first <= most {
                branches.push(first..ends[node]);
            } else {
                open.extend(below(node));
            }
        }
        branches.sort_unstable_by_key(|branch| branch.start);
        branches
    }

    /// Nodes on the longest way from the root, itself among them: a walk puts one entry aside for each.
    fn levels(&self) -> u32 {
        let mut levels = vec![1; self.nodes.len()];
        for (node, children) in self.nodes.iter().enumerate().rev() {
            let below = children.iter().map(|child| match child {
                Child::Node(child) => levels[*child as usize],
                _ => 0,
            });
            levels[node] = 1 + below.max().unwrap_or(0);
        }
        levels.first().copied().unwrap_or(0)
    }
}

impl Halves {
    /// With so many levels at most, if that is enough for halves of equal numbers.
    fn build(boxes: &[Box3], leaf: usize, levels: Option<u32>) -> Self {
        let mut order: Vec<u32> = (0..boxes.len() as u32).collect();
        let mut nodes = vec![[Child::Nothing; 2]];
        let mut areas = vec![[0.0; 2]];
        // A node to be made, its run of the order, and on which level it is.
        let mut open = vec![(0_usize, 0_usize, boxes.len(), 1_u32)];
        while let Some((node, start, end, level)) = open.pop() {
            if end - start <= leaf {
                nodes[node][0] = leaf_of(start, end);
                continue;
            }
            // What either half may hold at most.
            let room = levels.map_or(usize::MAX, |levels| {
                leaf.saturating_mul(1_usize.checked_shl(levels.saturating_sub(level)).unwrap_or(usize::MAX))
            });
            let middle = start + split(boxes, &mut order[start..end], room);
            for (side, (from, to)) in [(start, middle), (middle, end)].into_iter().enumerate() {
                let bounds = Box3::around_all(order[from..to].iter().map(|number| &boxes[*number as usize]));
                areas[node][side] = bounds.area();
                nodes[node][side] = if to - from <= leaf {
                    leaf_of(from, to)
                } else {
                    nodes.push([Child::Nothing; 2]);
                    areas.push([0.0; 2]);
                    open.push((nodes.len() - 1, from, to, level + 1));
                    Child::Node(nodes.len() as u32 - 1)
                };
            }
        }
        Self { nodes, areas, order }
    }

    /// Nodes of four: the largest halves are taken apart first, or, for a flat tree, all of them once.
    fn joined(self, by_area: bool) -> Tree {
        let mut nodes = vec![[Child::Nothing; WIDTH]];
        let mut open = vec![(0_usize, 0_u32)];
        while let Some((place, half)) = open.pop() {
            let mut children: Vec<(Child, f32, bool)> = self.children(half).collect();
            while children.len() < WIDTH {
                let splits = |one: &(Child, f32, bool)| matches!(one.0, Child::Node(_)) && (by_area || one.2);
                let largest =
                    (0..children.len()).filter(|index| splits(&children[*index])).reduce(|best, index| {
                        if children[index].1 > children[best].1 { index } else { best }
                    });
                let Some(largest) = largest else { break };
                let (Child::Node(half), ..) = children.remove(largest) else { break };
                let halves = self.children(half).map(|(child, area, _)| (child, area, false));
                children.extend(halves);
            }
            for (side, (child, ..)) in children.into_iter().enumerate() {
                nodes[place][side] = match child {
                    Child::Node(half) => {
                        nodes.push([Child::Nothing; WIDTH]);
                        open.push((nodes.len() - 1, half));
                        Child::Node(nodes.len() as u32 - 1)
                    }
                    other => other,
                };
            }
        }
        Tree { nodes, order: self.order }
    }

    /// What is in a node, with its surface; true, since it is the node's own.
    fn children(&self, node: u32) -> impl Iterator<Item = (Child, f32, bool)> + '_ {
        let node = node as usize;
        let pairs = self.nodes[node].iter().zip(&self.areas[node]);
        pairs.filter(|(child, _)| **child != Child::Nothing).map(|(child, area)| (*child, *area, true))
    }
}

fn leaf_of(start: usize, end: usize) -> Child {
    if start == end {
        Child::Nothing
    } else {
        Child::Leaf { first: start as u32, count: (end - start) as u32 }
    }
}

/// Puts a run in order so that its halves belong together; gives the length of the first, from 1 to all but one. Where the best halves by surface are larger than
/// `room`, they are of equal numbers.
fn split(boxes: &[Box3], run: &mut [u32], room: usize) -> usize {
    let centers = Box3::around(run.iter().map(|number| {
        let one = &boxes[*number as usize];
        std::array::from_fn(|axis| one.center(axis))
    }));
    let wide = |axis: usize| centers.high[axis] - centers.low[axis];
    let bin = |number: u32, axis: usize| {
        let share = (boxes[number as usize].center(axis) - centers.low[axis]) / wide(axis);
        ((share * BINS as f32) as usize).min(BINS - 1)
    };
    let mut best: Option<(f32, usize, usize)> = None;
    for axis in (0..3).filter(|axis| wide(*axis) > 0.0) {
        let border = best_border(boxes, run, &|number| bin(number, axis));
        if let Some((cost, border)) = border
            && best.is_none_or(|(least, ..)| cost < least)
        {
            best = Some((cost, axis, border));
        }
    }
    if let Some((_, axis, border)) = best {
        let first = run.iter().filter(|number| bin(**number, axis) < border).count();
        if first.max(run.len() - first) <= room {
            // Stable, so that the order depends on the boxes alone.
            run.sort_by_key(|number| bin(*number, axis) >= border);
            return first;
        }
    }
    let axis = (0..3).fold(0, |best, axis| if wide(axis) > wide(best) { axis } else { best });
    run.sort_by(|a, b| {
        let key = |number: &u32| boxes[*number as usize].center(axis);
        key(a).total_cmp(&key(b)).then(a.cmp(b))
    });
    run.len() / 2
}

/// The first bin of the second half, where the surfaces of both halves, times what is in them, are least; with that sum.
fn best_border(boxes: &[Box3], run: &[u32], bin: &dyn Fn(u32) -> usize) -> Option<(f32, usize)> {
    let mut bins = [(Box3::EMPTY, 0_u32); BINS];
    for number in run {
        let (all, count) = &mut bins[bin(*number)];
        *all = all.grown(boxes[*number as usize]);
        *count += 1;
    }
    let cost = |all: &Box3, count: u32| all.area() * count as f32;
    // Of all bins from each on.
    let mut above = [(Box3::EMPTY, 0_u32); BINS];
    let mut behind = (Box3::EMPTY, 0);
    for (sum, (one, count)) in above.iter_mut().zip(&bins).rev() {
        behind = (behind.0.grown(*one), behind.1 + count);
        *sum = behind;
    }
    let mut below = (Box3::EMPTY, 0);
    let mut best: Option<(f32, usize)> = None;
    for border in 1..BINS {
        let (one, count) = bins[border - 1];
        below = (below.0.grown(one), below.1 + count);
        let rest = above[border];
        if below.1 == 0 || rest.1 == 0 {
            continue;
        }
        let sum = cost(&below.0, below.1) + cost(&rest.0, rest.1);
        if best.is_none_or(|(least, _)| sum < least) {
            best = Some((sum, border));
        }
    }
    best
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// Enough for 1,024 leaves, and fewer than boxes that lie apart like powers of two would have.
    const LEVELS: u32 = 5;

    proptest! {
        /// Every box is in one leaf, leaves are small, children come after their parents, and there are no more levels than were asked for.
        #[test]
        fn every_box_is_in_one_leaf(
            corners in prop::collection::vec((-50.0..50.0f32, -50.0..50.0f32, 0.0..9.0f32, 0.0..20.0f32), 0..300),
            leaf in 1..5usize,
            arrangement in 0..3u32,
        ) {
            let one = |(number, (x, y, z, size)): (usize, (f32, f32, f32, f32))| {
                let low = match arrangement {
                    0 => [x, y, z],
                    1 => [1.0; 3],
                    // Each apart from all before by far more than these from each other: halves by surfaces are one and the rest.
                    _ => [(number as f32 * 0.25).exp2(), 0.0, 0.0],
                };
                Box3 { low, high: low.map(|coordinate| coordinate + size) }
            };
            let boxes: Vec<Box3> = corners.into_iter().enumerate().map(one).collect();
            let tree = Tree::build(&boxes, leaf, LEVELS);
            let mut seen: Vec<u32> = Vec::new();
            for (index, children) in tree.nodes.iter().enumerate() {
                for child in children {
                    match child {
                        Child::Node(node) => prop_assert!(*node as usize > index),
                        Child::Leaf { first, count } => {
                            prop_assert!((1..=leaf as u32).contains(count));
                            seen.extend(&tree.order[*first as usize..(first + count) as usize]);
                        }
                        Child::Nothing => {}
                    }
                }
            }
            seen.sort_unstable();
            prop_assert_eq!(seen, (0..boxes.len() as u32).collect::<Vec<_>>());
            prop_assert!(tree.levels() <= LEVELS, "{}", tree.levels());
            prop_assert_eq!(&Tree::build(&boxes, leaf, LEVELS).order, &tree.order);
        }

        /// Branches lie one behind the other, lead to none but their own nodes, and are as small as was asked for; what is in none of them leads nowhere else than
        /// to the beginnings of theirs and to one another.
        #[test]
        fn branches_lead_to_their_own(
            corners in prop::collection::vec((-50.0..50.0f32, -50.0..50.0f32, 0.0..9.0f32), 0..400),
            most in 1..60usize,
        ) {
            let boxes: Vec<Box3> =
                corners.into_iter().map(|(x, y, z)| Box3 { low: [x, y, z], high: [x + 1.0, y + 1.0, z + 1.0] }).collect();
            let tree = Tree::build(&boxes, 1, 14);
            let branches = tree.branches(most);
            let mut end = 0;
            for branch in &branches {
                prop_assert!(branch.start >= end && branch.len() <= most && !branch.is_empty());
                end = branch.end;
                for children in &tree.nodes[branch.clone()] {
                    for child in children {
                        let stays = !matches!(child, Child::Node(node) if !branch.contains(&(*node as usize)));
                        prop_assert!(stays, "{branch:?} leads to {child:?}");
                    }
                }
            }
            prop_assert!(end <= tree.nodes.len());
            // Of a tree that is small enough all that is below the root is one.
            let whole = 1..tree.nodes.len();
            prop_assert_eq!(tree.branches(400), if whole.is_empty() { Vec::new() } else { vec![whole] });
        }
    }

    /// Of very many boxes too, in a row or in one place.
    #[test]
    fn many_boxes_have_few_levels() {
        for apart in [0.0, 1.0] {
            let at = |number: u32| [number as f32 * apart, 0.0, 0.0];
            let boxes: Vec<Box3> =
                (0..100_000).map(|number| Box3 { low: at(number), high: at(number) }).collect();
            assert!(Tree::build(&boxes, 1, 9).levels() <= 9, "four to the power of nine are more");
        }
    }
}
