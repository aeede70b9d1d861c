//! The trees over what stands and moves in a scene: one over what stands still, which is built once, and one over what moves, refitted after every
//! step.
//!
//! A leaf is an entity with the instances of all its levels of detail, of which a ray looks through those of one level; what is the same at every
//! level is a leaf of its own. So somebody of one pixel is one box, and one mesh behind it.

use bytemuck::{Pod, Zeroable};
use simworld_core::geometry::Vector3;
use simworld_core::scene::Scene;

use super::bvh::{Box3, Child, NONE, Tree, WIDTH};
use super::shape::{Shape, Shapes, bound};
use crate::look::Detail;
use crate::mesh::Drawn;
use crate::resident::{Instance, Residents};
use crate::threads;

/// Marks a child as a leaf; beside it stands the number of its first instance.
const IS_LEAF: u32 = 1 << 31;
/// Entities that are worth a thread.
const SHARE: usize = 128;
/// Marks what throws no shadow, in [`Placed::order`].
const NO_SHADOW: u32 = 1 << 31;
/// As many refits, and the tree of what moves is laid out anew.
const REFITS: u32 = 64;
/// As many newcomers among what moves, beside a quarter of what stands still, and everything is laid out anew.
const NEWCOMERS: usize = 4096;

/// The twin of `Node` in rays.wgsl: four children, their boxes axis by axis.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(super) struct Node {
    codes: [u32; WIDTH],
    low: [[f32; WIDTH]; 3],
    high: [[f32; WIDTH]; 3],
}

/// The twin of `Placed` in rays.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
pub(super) struct Placed {
    /// The ball around its entity, from the origin of the trees.
    center: [f32; 3],
    radius: f32,
    /// The box of the instance.
    low: [f32; 3],
    /// Of its mesh.
    root: u32,
    high: [f32; 3],
    /// Of the mesh that stands for it where few pixels are across the ball.
    speck: u32,
    /// Of a leaf, its first instance at each level of detail.
    first: [u32; 3],
    /// Fewer pixels than this are few.
    few: f32,
    /// The next instance of the leaf at each level.
    next: [u32; 3],
    /// Where two lie in one plane, the lower is seen; and whether it throws no shadow.
    order: u32,
}

/// What an instance is in, if it is the first of a leaf.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Home {
    Nowhere,
    Fixed,
    Moving,
}

/// What has to be sent to the device.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Followed {
    /// Nothing.
    Nothing,
    /// What moves, and the places of whose instances changed.
    Moving,
    /// All nodes, and places as before.
    Nodes,
    All,
}

/// Both trees. Coordinates are from `origin`, in floats, so that boxes stay exact to parts of a millimetre.
pub(super) struct Bodies {
    pub origin: Vector3,
    /// First those of the tree of what stands still, then those of what moves.
    pub nodes: Vec<Node>,
    /// Where the second tree begins.
    pub second: u32,
    pub placed: Vec<Placed>,
    /// Numbers whose places changed.
    pub changed: Vec<u32>,
    fixed: Tree,
    moving: Tree,
    movers: Vec<u32>,
    /// By number, what it is in.
    homes: Vec<Home>,
    /// By number, the box of the leaf that it is the first of.
    boxes: Vec<Box3>,
    newcomers: usize,
    refits: u32,
    epoch: u64,
    /// Slots of what changed.
    slots: Vec<u32>,
}

impl Bodies {
    pub(super) fn new() -> Self {
        Self {
            origin: Vector3::zeros(),
            nodes: Vec::new(),
            second: 0,
            placed: Vec::new(),
            changed: Vec::new(),
            fixed: Tree::default(),
            moving: Tree::default(),
            movers: Vec::new(),
            homes: Vec::new(),
            boxes: Vec::new(),
            newcomers: 0,
            refits: 0,
            epoch: 0,
            slots: Vec::new(),
        }
    }

    /// Follows the residents; `noted` are the numbers whose instances changed since the last time.
    pub(super) fn follow(
        &mut self,
        scene: &dyn Scene,
        shapes: &mut Shapes,
        residents: &Residents,
        noted: &[u32],
    ) -> Followed {
        self.changed.clear();
        if self.epoch != residents.epoch || self.newcomers > NEWCOMERS + self.fixed.order.len() / 4 {
            self.restart(scene, shapes, residents);
            return Followed::All;
        }
        if noted.is_empty() {
            return Followed::Nothing;
        }
        let count = residents.instances.len();
        self.homes.resize(count, Home::Nowhere);
        self.boxes.resize(count, Box3::EMPTY);
        self.placed.resize(count, Zeroable::zeroed());
        let mut slots = std::mem::take(&mut self.slots);
        slots.clear();
        for number in noted {
            if let Some(slot) = residents.cards[*number as usize].slot_there() {
                slots.push(slot);
            } else {
                self.boxes[*number as usize] = Box3::EMPTY;
                self.changed.push(*number);
            }
        }
        slots.sort_unstable();
        slots.dedup();
        self.place(scene, shapes, residents, &slots);
        self.slots = slots;
        let (fixed_changed, members_changed) = self.rehome();
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
        if fixed_changed { Followed::Nodes } else { Followed::Moving }
    }

    /// Finds the tree of each leaf that came, changed or went: true if one left the tree of what stands still, and if others move than before.
    fn rehome(&mut self) -> (bool, bool) {
        let (mut fixed_changed, mut members_changed) = (false, false);
        for number in &self.changed {
            let index = *number as usize;
            let is_there = self.boxes[index] != Box3::EMPTY;
            let home = &mut self.homes[index];
            match (*home, is_there) {
                (Home::Nowhere, true) => {
                    (*home, members_changed) = (Home::Moving, true);
                    self.movers.push(*number);
                    self.newcomers += 1;
                }
                (Home::Fixed, _) => {
                    // It leaves a hole in its tree, and is one of those that move from now on.
                    fixed_changed = true;
                    *home = if is_there { Home::Moving } else { Home::Nowhere };
                    if is_there {
                        self.movers.push(*number);
                        (members_changed, self.newcomers) = (true, self.newcomers + 1);
                    }
                }
                (Home::Moving, false) => (*home, members_changed) = (Home::Nowhere, true),
                (Home::Nowhere, false) | (Home::Moving, true) => {}
            }
        }
        (fixed_changed, members_changed)
    }

    fn restart(&mut self, scene: &dyn Scene, shapes: &mut Shapes, residents: &Residents) {
        let count = residents.instances.len();
        *self = Self { epoch: residents.epoch, ..Self::new() };
        self.origin =
            residents.instances.first().map_or_else(Vector3::zeros, |one| one.place().map(f64::round));
        self.homes = vec![Home::Nowhere; count];
        self.boxes = vec![Box3::EMPTY; count];
        self.placed = vec![Zeroable::zeroed(); count];
        let slots: Vec<u32> = (0..residents.names.len() as u32).collect();
        self.place(scene, shapes, residents, &slots);
        self.changed.clear();
        let mut still: Vec<u32> = Vec::new();
        for (number, card) in (0..).zip(&residents.cards) {
            if self.boxes[number as usize] == Box3::EMPTY {
                continue;
            }
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
        let node = |(children, boxes): (&[Child; WIDTH], &[Box3; WIDTH])| Node {
            codes: children.map(code),
            low: std::array::from_fn(|axis| boxes.map(|one| one.low[axis])),
            high: std::array::from_fn(|axis| boxes.map(|one| one.high[axis])),
        };
        tree.nodes.iter().zip(&boxes).map(node).collect()
    }

    /// Finds where the instances of these slots are, and of which leaves they are.
    fn place(&mut self, scene: &dyn Scene, shapes: &mut Shapes, residents: &Residents, slots: &[u32]) {
        let numbers = slots.iter().flat_map(|slot| residents.numbers_of(*slot));
        numbers.for_each(|number| shapes.learn(scene, residents.cards[number as usize].mesh));
        let count = threads::worth(slots.len(), SHARE);
        let wide = slots.len().div_ceil(count).max(1);
        let placer = Placer { shapes, residents, origin: self.origin };
        let found = threads::each(slots.chunks(wide).collect(), |share: &[u32]| {
            let mut found = Vec::new();
            for slot in share {
                placer.place(*slot, &mut found);
            }
            found
        });
        for (number, placed, bounds) in found.into_iter().flatten() {
            self.placed[number as usize] = placed;
            self.boxes[number as usize] = bounds;
            self.changed.push(number);
        }
    }
}

/// Finds where instances are.
struct Placer<'a> {
    shapes: &'a Shapes,
    residents: &'a Residents,
    origin: Vector3,
}

impl Placer<'_> {
    /// The instances of a slot, each with the box of the leaf that it is the first of.
    fn place(&self, slot: u32, out: &mut Vec<(u32, Placed, Box3)>) {
        let start = out.len();
        for number in self.residents.numbers_of(slot) {
            let (placed, bounds) = self.alone(number).unwrap_or((Placed::zeroed(), Box3::EMPTY));
            out.push((number, placed, bounds));
        }
        // Those of some levels only are one leaf, behind their first.
        let (mut whole, mut next, mut first) = (Box3::EMPTY, [NONE; 3], None);
        for (index, (number, placed, bounds)) in out.iter_mut().enumerate().skip(start).rev() {
            let details = self.residents.cards[*number as usize].details;
            if details == Detail::EVERY || *bounds == Box3::EMPTY {
                continue;
            }
            whole = whole.grown(std::mem::replace(bounds, Box3::EMPTY));
            placed.next = next;
            for (level, next) in next.iter_mut().enumerate() {
                if details >> level & 1 == 1 {
                    *next = *number;
                }
            }
            first = Some(index);
        }
        if let Some((_, placed, bounds)) = first.and_then(|index| out.get_mut(index)) {
            (placed.first, *bounds) = (next, whole);
        }
    }

    /// An instance that is a leaf of its own; `None` if it has no mesh.
    fn alone(&self, number: u32) -> Option<(Placed, Box3)> {
        let index = number as usize;
        let residents = self.residents;
        let (card, instance, ball) =
            (&residents.cards[index], &residents.instances[index], residents.grid.ball(number));
        let shape = self.shapes.of(card.mesh).filter(|shape| shape.anchors != Box3::EMPTY)?;
        let (few, speck) = match card.mesh.speck() {
            Some((few, mesh)) => (few as f32, self.shapes.of(mesh)?),
            None => (0.0, shape),
        };
        let shapes = [shape, speck];
        let bounds = self.bounds(instance, &shapes[..if few > 0.0 { 2 } else { 1 }]);
        let rank = match card.mesh {
            Drawn::Model(_) => 0,
            Drawn::Own(mesh) => 1 + mesh as u32,
        };
        let order = rank << 8 | instance.layer(card.mesh);
        let center = ball.center.coords - self.origin;
        let placed = Placed {
            center: [center.x as f32, center.y as f32, center.z as f32],
            radius: ball.radius as f32,
            low: bounds.low,
            root: shape.root,
            high: bounds.high,
            speck: speck.root,
            first: [number; 3],
            few,
            next: [NONE; 3],
            order: if card.casts { order } else { order | NO_SHADOW },
        };
        Some((placed, bounds))
    }

    /// Around an instance, whichever of these shapes it has.
    fn bounds(&self, instance: &Instance, shapes: &[Shape]) -> Box3 {
        let place = instance.place() - self.origin;
        let (scale, unit) = instance.measure();
        let axes = instance.turn().to_rotation_matrix();
        let spread = axes.matrix().abs();
        shapes.iter().fold(Box3::EMPTY, |bounds, shape| {
            let end = |which: fn(&Box3) -> [f32; 3]| {
                let (anchors, offsets) = (which(&shape.anchors), which(&shape.offsets));
                Vector3::from_fn(|axis, _| f64::from(anchors[axis] * scale[axis] + offsets[axis] * unit))
            };
            let (low, high) = (end(|one| one.low), end(|one| one.high));
            let middle = place + axes * ((low + high) * 0.5);
            let half = spread * ((high - low) * 0.5);
            // What floats lose is made up for.
            let loss = |coordinate: f64| 1e-4 + 1e-6 * coordinate.abs();
            let moved = |sign: f64| {
                std::array::from_fn(|axis| {
                    let at = middle[axis] + sign * half[axis];
                    (at + sign * loss(at)) as f32
                })
            };
            bounds.grown(Box3 { low: moved(-1.0), high: moved(1.0) })
        })
    }
}
