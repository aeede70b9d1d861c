//! The tree over instances: one over what stands still, which is built once, and one over what moves, refitted after every step.

use bytemuck::{Pod, Zeroable};
use simworld_core::geometry::Vector3;
use simworld_core::scene::Scene;

use super::bvh::{Box3, Child, NONE, Tree};
use super::shape::{Shapes, bound};
use crate::mesh::Drawn;
use crate::resident::Residents;

/// Marks a child as an instance.
const IS_LEAF: u32 = 1 << 31;
/// As many refits, and the tree of what moves is laid out anew.
const REFITS: u32 = 64;
/// As many newcomers among what moves, beside a quarter of what stands still, and everything is laid out anew.
const NEWCOMERS: usize = 4096;

/// The twin of `Node` in raycast.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(super) struct Node {
    low: [f32; 3],
    child: u32,
    high: [f32; 3],
    other: u32,
    other_low: [f32; 3],
    pad: u32,
    other_high: [f32; 3],
    pad_too: u32,
}

/// The twin of `Placed` in raycast.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub(super) struct Placed {
    /// The ball around it, from the origin of the trees.
    center: [f32; 3],
    radius: f32,
    root: u32,
    pattern: u32,
    /// Where two lie in one plane, the lower is seen.
    order: u32,
    casts: u32,
}

/// What an instance is in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Home {
    Nowhere,
    Fixed,
    Moving,
}

/// Both trees. Coordinates are from `origin`, in floats, so that boxes stay exact to parts of a millimetre.
pub(super) struct Bodies {
    pub origin: Vector3,
    /// First those of the tree of what stands still, then those of what moves.
    pub nodes: Vec<Node>,
    /// Where the second tree begins.
    pub second: u32,
    pub placed: Vec<Placed>,
    fixed: Tree,
    moving: Tree,
    movers: Vec<u32>,
    homes: Vec<Home>,
    boxes: Vec<Box3>,
    newcomers: usize,
    refits: u32,
    epoch: u64,
}

impl Bodies {
    pub(super) fn new() -> Self {
        Self {
            origin: Vector3::zeros(),
            nodes: Vec::new(),
            second: 0,
            placed: Vec::new(),
            fixed: Tree::default(),
            moving: Tree::default(),
            movers: Vec::new(),
            homes: Vec::new(),
            boxes: Vec::new(),
            newcomers: 0,
            refits: 0,
            epoch: 0,
        }
    }

    /// Follows the residents; `changed` are the numbers whose instances did since the last time. True if what stands still changed.
    pub(super) fn follow(
        &mut self,
        scene: &dyn Scene,
        shapes: &mut Shapes,
        residents: &Residents,
        changed: &[u32],
    ) -> bool {
        let count = residents.instances.len();
        if self.epoch != residents.epoch || self.newcomers > NEWCOMERS + self.fixed.order.len() / 4 {
            self.restart(scene, shapes, residents);
            return true;
        }
        self.homes.resize(count, Home::Nowhere);
        self.boxes.resize(count, Box3::EMPTY);
        self.placed.resize(count, Zeroable::zeroed());
        let (mut fixed_changed, mut members_changed) = (false, false);
        for number in changed {
            let index = *number as usize;
            let is_there = residents.cards[index].is_met();
            match (self.homes[index], is_there) {
                (Home::Nowhere, true) => {
                    (self.homes[index], members_changed) = (Home::Moving, true);
                    self.movers.push(*number);
                    self.newcomers += 1;
                }
                (Home::Fixed, _) => {
                    // It leaves a hole in its tree, and is one of those that move from now on.
                    fixed_changed = true;
                    self.homes[index] = if is_there { Home::Moving } else { Home::Nowhere };
                    if is_there {
                        self.movers.push(*number);
                        (members_changed, self.newcomers) = (true, self.newcomers + 1);
                    }
                }
                (Home::Moving, false) => (self.homes[index], members_changed) = (Home::Nowhere, true),
                (Home::Nowhere, false) | (Home::Moving, true) => {}
            }
            if is_there {
                self.place(scene, shapes, residents, *number);
            }
        }
        if members_changed {
            let homes = &self.homes;
            self.movers.retain(|number| homes[*number as usize] == Home::Moving);
            self.movers.sort_unstable();
            self.movers.dedup();
        }
        if members_changed || self.refits >= REFITS {
            self.lay_out_movers();
        }
        self.refits += 1;
        if fixed_changed {
            self.nodes.clear();
            self.nodes.extend(self.coded(&self.fixed, 0, Home::Fixed));
        }
        self.nodes.truncate(self.second as usize);
        let moving = self.coded(&self.moving, self.second, Home::Moving);
        self.nodes.extend(moving);
        fixed_changed
    }

    fn restart(&mut self, scene: &dyn Scene, shapes: &mut Shapes, residents: &Residents) {
        let count = residents.instances.len();
        *self = Self { epoch: residents.epoch, ..Self::new() };
        self.origin =
            residents.instances.first().map_or_else(Vector3::zeros, |one| one.place().map(f64::round));
        self.homes = vec![Home::Nowhere; count];
        self.boxes = vec![Box3::EMPTY; count];
        self.placed = vec![Zeroable::zeroed(); count];
        let mut still: Vec<u32> = Vec::new();
        for (number, card) in (0..).zip(&residents.cards) {
            if !card.is_met() {
                continue;
            }
            self.place(scene, shapes, residents, number);
            self.homes[number as usize] = if card.mobile { Home::Moving } else { Home::Fixed };
            if card.mobile { self.movers.push(number) } else { still.push(number) }
        }
        self.fixed = self.tree_over(&still);
        self.nodes = self.coded(&self.fixed, 0, Home::Fixed);
        self.second = self.nodes.len() as u32;
        self.lay_out_movers();
        let moving = self.coded(&self.moving, self.second, Home::Moving);
        self.nodes.extend(moving);
    }

    fn lay_out_movers(&mut self) {
        self.moving = self.tree_over(&self.movers);
        self.refits = 0;
    }

    /// A tree whose order holds the numbers of instances.
    fn tree_over(&self, members: &[u32]) -> Tree {
        let boxes: Vec<Box3> = members.iter().map(|number| self.boxes[*number as usize]).collect();
        let mut tree = Tree::build(&boxes, 1);
        tree.order.iter_mut().for_each(|position| *position = members[*position as usize]);
        tree
    }

    /// The nodes of a tree with the boxes of now; those who went elsewhere are holes.
    fn coded(&self, tree: &Tree, first: u32, home: Home) -> Vec<Node> {
        let is_in = |number: u32| self.homes[number as usize] == home;
        let leaf = |number: &u32| if is_in(*number) { self.boxes[*number as usize] } else { Box3::EMPTY };
        let boxes = bound(tree, &tree.order.iter().map(leaf).collect::<Vec<_>>());
        let code = |child: Child| match child {
            Child::Node(node) => first + node,
            Child::Leaf { first, .. } => {
                let number = tree.order[first as usize];
                if is_in(number) { IS_LEAF | number } else { NONE }
            }
            Child::Nothing => NONE,
        };
        let node = |([child, other], [near, far]): (&[Child; 2], &[Box3; 2])| Node {
            low: near.low,
            child: code(*child),
            high: near.high,
            other: code(*other),
            other_low: far.low,
            pad: 0,
            other_high: far.high,
            pad_too: 0,
        };
        tree.nodes.iter().zip(&boxes).map(node).collect()
    }

    /// Finds where an instance is.
    fn place(&mut self, scene: &dyn Scene, shapes: &mut Shapes, residents: &Residents, number: u32) {
        let index = number as usize;
        let (card, instance, ball) =
            (&residents.cards[index], &residents.instances[index], residents.grid.ball(number));
        let center = ball.center.coords - self.origin;
        let Some(shape) = shapes.of(scene, card.mesh) else {
            (self.boxes[index], self.placed[index]) = (Box3::EMPTY, Zeroable::zeroed());
            return;
        };
        let turn = instance.turn();
        let place = instance.place() - self.origin;
        let (scale, unit) = instance.measure();
        let mut whole = Box3::EMPTY;
        for corner in 0..8_u32 {
            let local = Vector3::from_fn(|axis, _| {
                let of = |one: &Box3| if corner >> axis & 1 == 0 { one.low[axis] } else { one.high[axis] };
                f64::from(of(&shape.anchors) * scale[axis] + of(&shape.offsets) * unit)
            });
            let at = place + turn * local;
            // What floats lose is made up for.
            let loss = |coordinate: f64| 1e-4 + 1e-6 * coordinate.abs();
            let moved = |sign: f64| std::array::from_fn(|axis| (at[axis] + sign * loss(at[axis])) as f32);
            whole = whole.grown(Box3 { low: moved(-1.0), high: moved(1.0) });
        }
        self.boxes[index] = whole;
        let rank = match card.mesh {
            Drawn::Model(_) => 0,
            Drawn::Own(mesh) => 1 + mesh as u32,
        };
        let order = rank << 8 | instance.layer(card.mesh);
        self.placed[index] = Placed {
            center: [center.x as f32, center.y as f32, center.z as f32],
            radius: ball.radius as f32,
            root: shape.root,
            pattern: card.mesh.pattern() as u32,
            order,
            casts: u32::from(card.casts),
        };
    }
}
