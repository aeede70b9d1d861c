//! The trees over what stands and moves in a scene: one over what stands still, which is built once, and one over what moves, refitted after every
//! step. What moves is told by its motion, not by its kind: a parked car is one of those that stand, until it drives off.
//!
//! A leaf is an entity with the instances of all its levels of detail, of which a ray looks through those of one level; what is the same at every
//! level is a leaf of its own. So somebody of one pixel is one box, and one mesh behind it. A body that is dressed as it is seen is one leaf, behind its
//! first instance, whatever of it is dressed: it is in its tree also while nobody sees it, without an instance at any level.

use std::ops::Range;

use bytemuck::{Pod, Zeroable};
use simworld_core::geometry::Vector3;
use simworld_core::scene::Scene;

use super::bvh::{Box3, Child, NONE, Tree, WIDTH};
use super::nodes::{Node, code};
use super::shape::Shapes;
use super::soup::Shape;
use crate::look::Detail;
use crate::mesh::Drawn;
use crate::resident::{Card, Instance, Residents};
use crate::threads;

/// Levels of a tree over instances at most, as in rays.wgsl.
const LEVELS: u32 = 14;
/// What stands and is longer is in its tree piece by piece, m.
const PIECE: f64 = 32.0;
/// Pieces of one instance at most.
const MOST_CUTS: f64 = 64.0;
/// Entities that are worth a thread.
const SHARE: usize = 128;
/// Nodes that are followed together, at most.
const BRANCH: usize = 256;
/// Marks what throws no shadow, in [`Placed::order`].
const NO_SHADOW: u32 = 1 << 31;
/// As many refits, and the tree of what moves is laid out anew.
const REFITS: u32 = 64;
/// As many newcomers among what moves, beside a quarter of what stands still, and everything is laid out anew.
const NEWCOMERS: usize = 4096;

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
    /// The tree of what moves, those nodes of the other that were [patched](Bodies::patched), and the places of whose instances changed.
    Moving,
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
    /// Nodes of the first tree that lost a child.
    pub patched: Vec<u32>,
    /// The leaves of the first tree, by number: four times the node, plus which child of it.
    spots: Vec<(u32, u32)>,
    moving: Tree,
    /// Of the tree of what moves.
    branches: Vec<Range<usize>>,
    movers: Vec<u32>,
    /// How many leaves the first tree was laid out with.
    standing: usize,
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
            patched: Vec::new(),
            spots: Vec::new(),
            moving: Tree::default(),
            branches: Vec::new(),
            movers: Vec::new(),
            standing: 0,
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
        self.patched.clear();
        if self.epoch != residents.epoch || self.newcomers > NEWCOMERS + self.standing / 4 {
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
        let members_changed = self.rehome();
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
        self.code_movers();
        Followed::Moving
    }

    /// Finds the tree of each leaf that came, changed or went: true if others move than before.
    fn rehome(&mut self) -> bool {
        let mut members_changed = false;
        for number in &self.changed {
            let index = *number as usize;
            let is_there = self.boxes[index] != Box3::EMPTY;
            let home = &mut self.homes[index];
            if *home == Home::Fixed {
                // It leaves a hole in its tree, whose boxes stay as they are, and is one of those that move from now on.
                let start = self.spots.partition_point(|(other, _)| other < number);
                for (_, spot) in self.spots[start..].iter().take_while(|(other, _)| other == number) {
                    let (node, child) = (spot / WIDTH as u32, *spot as usize % WIDTH);
                    self.nodes[node as usize].leave(child);
                    self.patched.push(node);
                }
                *home = Home::Nowhere;
            }
            match (*home, is_there) {
                (Home::Nowhere, true) => {
                    (*home, members_changed) = (Home::Moving, true);
                    self.movers.push(*number);
                    self.newcomers += 1;
                }
                (Home::Moving, false) => (*home, members_changed) = (Home::Nowhere, true),
                (Home::Nowhere, false) | (Home::Moving, true) | (Home::Fixed, _) => {}
            }
        }
        members_changed
    }

    fn restart(&mut self, scene: &dyn Scene, shapes: &mut Shapes, residents: &Residents) {
        let count = residents.instances.len();
        let was_moving =
            if self.epoch == residents.epoch { std::mem::take(&mut self.movers) } else { Vec::new() };
        *self = Self { epoch: residents.epoch, ..Self::new() };
        self.origin =
            residents.instances.first().map_or_else(Vector3::zeros, |one| one.place().map(f64::round));
        self.homes = vec![Home::Nowhere; count];
        self.boxes = vec![Box3::EMPTY; count];
        self.placed = vec![Zeroable::zeroed(); count];
        let slots: Vec<u32> = (0..residents.names.len() as u32).collect();
        self.place(scene, shapes, residents, &slots);
        self.changed.clear();
        let is_there = |number: &u32| self.boxes[*number as usize] != Box3::EMPTY;
        self.movers = was_moving.into_iter().filter(is_there).collect();
        // Who is dressed as it is seen has moved.
        let has_moved = |number: &u32| residents.cards[*number as usize].nimble && is_there(number);
        self.movers.extend((0..count as u32).filter(has_moved));
        self.movers.sort_unstable();
        self.movers.dedup();
        for number in &self.movers {
            self.homes[*number as usize] = Home::Moving;
        }
        let stands = |number: &u32| is_there(number) && self.homes[*number as usize] == Home::Nowhere;
        let still: Vec<u32> = (0..count as u32).filter(stands).collect();
        for number in &still {
            self.homes[*number as usize] = Home::Fixed;
        }
        self.standing = still.len();
        self.lay_out_standing(shapes, residents, &still);
        self.lay_out_movers();
        self.code_movers();
    }

    /// Lays out the first tree: what is long is in it piece by piece.
    fn lay_out_standing(&mut self, shapes: &Shapes, residents: &Residents, still: &[u32]) {
        let placer = Placer { shapes, residents, origin: self.origin };
        let mut pieces = Vec::new();
        for number in still {
            placer.cut(*number, self.boxes[*number as usize], &mut pieces);
        }
        let boxes: Vec<Box3> = pieces.iter().map(|(_, piece)| *piece).collect();
        let tree = Tree::build(&boxes, 1, LEVELS);
        let leaf = |position: u32| pieces[tree.order[position as usize] as usize];
        self.nodes.clear();
        code(&tree, &tree.branches(BRANCH), 0, &leaf, &mut self.nodes);
        self.second = self.nodes.len() as u32;
        let spots = (0..).zip(tree.nodes.as_flattened()).filter_map(|(spot, child)| match child {
            Child::Leaf { first, .. } => Some((leaf(*first).0, spot)),
            _ => None,
        });
        self.spots = spots.collect();
        self.spots.sort_unstable();
    }

    fn lay_out_movers(&mut self) {
        let boxes: Vec<Box3> = self.movers.iter().map(|number| self.boxes[*number as usize]).collect();
        self.moving = Tree::build(&boxes, 1, LEVELS);
        self.moving.order.iter_mut().for_each(|position| *position = self.movers[*position as usize]);
        self.branches = self.moving.branches(BRANCH);
        self.refits = 0;
    }

    /// The tree of what moves, where it is now; those who went elsewhere are holes.
    fn code_movers(&mut self) {
        let Self { moving, branches, second, homes, boxes, nodes, .. } = self;
        let leaf = |position: u32| {
            let number = moving.order[position as usize];
            let is_in = homes[number as usize] == Home::Moving;
            if is_in { (number, boxes[number as usize]) } else { (NONE, Box3::EMPTY) }
        };
        code(moving, branches, *second, &leaf, nodes);
    }

    /// Finds where the instances of these slots are, and of which leaves they are.
    fn place(&mut self, scene: &dyn Scene, shapes: &mut Shapes, residents: &Residents, slots: &[u32]) {
        shapes.learn(residents.sources(scene), residents.models.keys());
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
            let (placed, bounds) = match self.residents.cards[number as usize].details {
                0 => (Placed::zeroed(), self.spot(number)),
                _ => self.alone(number).unwrap_or((Placed::zeroed(), Box3::EMPTY)),
            };
            out.push((number, placed, bounds));
        }
        // Those of some levels only are one leaf, behind their first; so is all of a body that is dressed as it is seen.
        let (mut whole, mut next, mut first) = (Box3::EMPTY, [NONE; 3], None);
        for (index, (number, placed, bounds)) in out.iter_mut().enumerate().skip(start).rev() {
            let card = &self.residents.cards[*number as usize];
            let details = card.details;
            if is_leaf(card) || *bounds == Box3::EMPTY {
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

    /// Where a body was that nobody sees: its leaf is a point, and holds nothing.
    fn spot(&self, number: u32) -> Box3 {
        let at = (self.residents.grid.ball(number).center.coords - self.origin)
            .map(|coordinate| coordinate as f32);
        Box3::around([[at.x, at.y, at.z]])
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

    /// What stands as boxes of a tree, with its number: in one, or piece by piece along its longest side, since one box around a street that
    /// goes aslant through the city is half of the city.
    fn cut(&self, number: u32, whole: Box3, out: &mut Vec<(u32, Box3)>) {
        let card = &self.residents.cards[number as usize];
        let alone = is_leaf(card) && card.mesh.speck().is_none();
        let Some(shape) = self.shapes.of(card.mesh).filter(|_| alone) else {
            return out.push((number, whole));
        };
        let instance = &self.residents.instances[number as usize];
        let (low, high) = extent(instance, &shape);
        let axis = (high - low).imax();
        let length = high[axis] - low[axis];
        let count = (length / PIECE).ceil().clamp(1.0, MOST_CUTS);
        for piece in 0..count as u32 {
            let (mut from, mut to) = (low, high);
            from[axis] = low[axis] + length * f64::from(piece) / count;
            to[axis] = low[axis] + length * f64::from(piece + 1) / count;
            out.push((number, self.around(instance, from, to)));
        }
    }

    /// Around an instance, whichever of these shapes it has.
    fn bounds(&self, instance: &Instance, shapes: &[Shape]) -> Box3 {
        shapes.iter().fold(Box3::EMPTY, |bounds, shape| {
            let (low, high) = extent(instance, shape);
            bounds.grown(self.around(instance, low, high))
        })
    }

    /// Around what of an instance lies between two corners of its body frame.
    fn around(&self, instance: &Instance, low: Vector3, high: Vector3) -> Box3 {
        let place = instance.place() - self.origin;
        let axes = instance.turn().to_rotation_matrix();
        let spread = axes.matrix().abs();
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
        Box3 { low: moved(-1.0), high: moved(1.0) }
    }
}

/// Whether an instance is a leaf of its own, and not one of those behind the first of its entity.
fn is_leaf(card: &Card) -> bool {
    card.details == Detail::EVERY && !card.nimble
}

/// The least and the greatest corner of a shape in the body frame of an instance, m.
fn extent(instance: &Instance, shape: &Shape) -> (Vector3, Vector3) {
    let (scale, unit) = instance.measure();
    let end = |which: fn(&Box3) -> [f32; 3]| {
        let (anchors, offsets) = (which(&shape.anchors), which(&shape.offsets));
        Vector3::from_fn(|axis, _| f64::from(anchors[axis] * scale[axis] + offsets[axis] * unit))
    };
    (end(|one| one.low), end(|one| one.high))
}
