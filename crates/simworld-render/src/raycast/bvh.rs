//! Trees of boxes: the topology by binned surface areas (Wald 2007), with medians where that does not help; the same for the same boxes.

/// A box, least and greatest corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Box3 {
    pub low: [f32; 3],
    pub high: [f32; 3],
}

/// No child.
pub(super) const NONE: u32 = u32::MAX;
/// Bins an axis.
const BINS: usize = 12;
/// Deeper than this, halves are taken, so that the stacks of the shaders suffice.
const SAH_DEPTH: u32 = 12;

/// The two children of a node.
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
    pub nodes: Vec<[Child; 2]>,
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

    fn center(&self, axis: usize) -> f32 {
        (self.low[axis] + self.high[axis]) * 0.5
    }

    /// Half of its surface; 0 for the empty box.
    fn area(&self) -> f32 {
        let [x, y, z] = std::array::from_fn(|axis| (self.high[axis] - self.low[axis]).max(0.0));
        x * y + y * z + z * x
    }
}

impl Tree {
    /// A tree with at most `leaf` boxes a leaf.
    pub(super) fn build(boxes: &[Box3], leaf: usize) -> Self {
        let mut order: Vec<u32> = (0..boxes.len() as u32).collect();
        let mut nodes = vec![[Child::Nothing; 2]];
        // A node to be made, its run of the order, its depth.
        let mut open = vec![(0_usize, 0_usize, boxes.len(), 0_u32)];
        while let Some((node, start, end, depth)) = open.pop() {
            if end - start <= leaf {
                nodes[node][0] = leaf_of(start, end);
                continue;
            }
            let middle = start + split(boxes, &mut order[start..end], depth);
            for (side, (from, to)) in [(start, middle), (middle, end)].into_iter().enumerate() {
                nodes[node][side] = if to - from <= leaf {
                    leaf_of(from, to)
                } else {
                    nodes.push([Child::Nothing; 2]);
                    open.push((nodes.len() - 1, from, to, depth + 1));
                    Child::Node(nodes.len() as u32 - 1)
                };
            }
        }
        Self { nodes, order }
    }
}

fn leaf_of(start: usize, end: usize) -> Child {
    if start == end {
        Child::Nothing
    } else {
        Child::Leaf { first: start as u32, count: (end - start) as u32 }
    }
}

/// Puts a run in order so that its halves belong together; gives the length of the first, from 1 to all but one.
fn split(boxes: &[Box3], run: &mut [u32], depth: u32) -> usize {
    let centers = Box3::around(run.iter().map(|number| {
        let one = &boxes[*number as usize];
        std::array::from_fn(|axis| one.center(axis))
    }));
    let wide = |axis: usize| centers.high[axis] - centers.low[axis];
    let axis = (0..3).fold(0, |best, axis| if wide(axis) > wide(best) { axis } else { best });
    if depth < SAH_DEPTH && wide(axis) > 0.0 {
        let bin = |number: u32| {
            let share = (boxes[number as usize].center(axis) - centers.low[axis]) / wide(axis);
            ((share * BINS as f32) as usize).min(BINS - 1)
        };
        if let Some(border) = best_border(boxes, run, &bin) {
            // Stable, so that the order depends on the boxes alone.
            run.sort_by_key(|number| bin(*number) >= border);
            return run.partition_point(|number| bin(*number) < border);
        }
    }
    run.sort_by(|a, b| {
        let key = |number: &u32| boxes[*number as usize].center(axis);
        key(a).total_cmp(&key(b)).then(a.cmp(b))
    });
    run.len() / 2
}

/// The first bin of the second half, where the surfaces of both halves, times what is in them, are least.
fn best_border(boxes: &[Box3], run: &[u32], bin: &dyn Fn(u32) -> usize) -> Option<usize> {
    let mut bins = [(Box3::EMPTY, 0_u32); BINS];
    for number in run {
        let (all, count) = &mut bins[bin(*number)];
        *all = all.grown(boxes[*number as usize]);
        *count += 1;
    }
    let cost = |half: &[(Box3, u32)]| {
        let (all, count) =
            half.iter().fold((Box3::EMPTY, 0), |(all, count), (one, more)| (all.grown(*one), count + more));
        (count > 0).then(|| all.area() * count as f32)
    };
    let mut best: Option<(f32, usize)> = None;
    for border in 1..BINS {
        let (Some(below), Some(above)) = (cost(&bins[..border]), cost(&bins[border..])) else { continue };
        if best.is_none_or(|(least, _)| below + above < least) {
            best = Some((below + above, border));
        }
    }
    best.map(|(_, border)| border)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn depth(tree: &Tree, node: usize) -> u32 {
        let below = |child: &Child| match child {
            Child::Node(node) => depth(tree, *node as usize),
            _ => 0,
        };
        1 + tree.nodes[node].iter().map(below).max().unwrap_or(0)
    }

    proptest! {
        /// Every box is in one leaf, leaves are small, children come after their parents, and the tree is not deep.
        #[test]
        fn every_box_is_in_one_leaf(
            corners in prop::collection::vec((-50.0..50.0f32, -50.0..50.0f32, 0.0..9.0f32, 0.0..20.0f32), 0..300),
            leaf in 1..5usize,
            same in any::<bool>(),
        ) {
            let one = |(x, y, z, size): (f32, f32, f32, f32)| {
                let low = if same { [1.0; 3] } else { [x, y, z] };
                Box3 { low, high: low.map(|coordinate| coordinate + size) }
            };
            let boxes: Vec<Box3> = corners.into_iter().map(one).collect();
            let tree = Tree::build(&boxes, leaf);
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
            prop_assert!(depth(&tree, 0) <= SAH_DEPTH + 12);
            prop_assert_eq!(&Tree::build(&boxes, leaf).order, &tree.order);
        }
    }
}
