//! The numbers of instances: given, kept from change to change, and freed.
//!
//! Those of bodies that are dressed as they are seen are numbers of their own, so that what changes in every step lies together and is sent in few pieces.

use super::bounds::casts;
use super::dressed::{Part, There};
use super::{Card, Instance, NONE, Residents};
use crate::mesh::{Drawn, MeshId};
use crate::sieve::Grain;

/// What has a smaller ball hides little, m.
const LEAST_WALL: f64 = 3.0;

impl Residents {
    /// Gives the parts the numbers that the slot has, and more or fewer if there are more or fewer of them.
    pub(super) fn fill(&mut self, slot: usize, there: &There, parts: &[(Part, Instance)]) {
        let mut last = NONE;
        let mut number = self.heads[slot];
        let nimble = self.wardrobe.holds(slot as u32);
        let (casts, grain) = (casts(there.kind), Grain::of(&there.ball));
        for (index, (part, instance)) in (0..).zip(parts) {
            if number == NONE {
                number = self.take_number(nimble);
                match self.cards.get_mut(last as usize) {
                    Some(card) => card.next = number,
                    None => self.heads[slot] = number,
                }
            }
            let next = self.cards[number as usize].next;
            let mut instance = *instance;
            let is_surface = index == 0 && part.mesh.pattern().is_flat();
            if let (true, Some(layer)) = (is_surface, self.layers.get(&(slot as u32))) {
                instance.put_in_layer(*layer);
            }
            let card = &mut self.cards[number as usize];
            let before = card.slot_there().map(|_| card.mesh);
            let is_same = self.instances[number as usize] == instance
                && self.grains[number as usize] == grain
                && (card.mesh, card.slot, card.part) == (part.mesh, slot as u32, index)
                && (card.casts, card.details) == (casts, part.details);
            *card = Card {
                mesh: part.mesh,
                slot: slot as u32,
                part: index,
                casts,
                mobile: there.kind.is_mobile(),
                details: part.details,
                nimble,
                next,
            };
            self.recount(before, part.mesh);
            if !is_same {
                self.instances[number as usize] = instance;
                self.grains[number as usize] = grain;
                self.note(number);
                self.resurfaced |= is_surface;
            }
            let ball = there.ball;
            self.grid.place(number, ball);
            if ball.radius >= LEAST_WALL && is_closed(part.mesh) {
                self.walls.place(number, ball);
            } else {
                self.walls.remove(number);
            }
            (last, number) = (number, next);
        }
        self.cut(slot, last);
    }

    /// Leaves one number to a body that nobody sees, so that it is the same to the trees of rays when it is seen again: of an instance that is
    /// drawn at no level.
    pub(super) fn keep_place(&mut self, slot: usize, there: &There) {
        if self.heads[slot] == NONE {
            self.heads[slot] = self.take_number(true);
        }
        let number = self.heads[slot];
        self.cut(slot, number);
        let card = &mut self.cards[number as usize];
        if card.slot_there().is_some() && card.details == 0 {
            return;
        }
        let before = card.slot_there().map(|_| card.mesh);
        let mesh = Drawn::Own(MeshId::Cuboid);
        let slot = slot as u32;
        *card =
            Card { mesh, slot, part: 0, casts: false, mobile: true, details: 0, nimble: true, next: NONE };
        self.recount(before, mesh);
        self.note(number);
        // It has a ball, and is in no cell.
        self.grid.place(number, there.ball);
        self.grid.remove(number);
        self.walls.remove(number);
    }

    /// Frees the instances of a slot behind `last`, or all of them.
    pub(super) fn cut(&mut self, slot: usize, last: u32) {
        let start = match self.cards.get_mut(last as usize) {
            Some(card) => std::mem::replace(&mut card.next, NONE),
            None => std::mem::replace(&mut self.heads[slot], NONE),
        };
        let mut number = start;
        while number != NONE {
            self.grid.remove(number);
            self.walls.remove(number);
            self.note(number);
            self.arrangement += 1;
            let card = &mut self.cards[number as usize];
            let before = card.slot_there().map(|_| card.mesh);
            card.slot = NONE;
            let free = &mut self.free[usize::from(card.nimble)];
            let next = std::mem::replace(&mut card.next, std::mem::replace(free, number));
            self.model_goes(before);
            number = next;
        }
    }

    /// Counts the mesh that an instance had out, and the one that it has in, where they are models and not the same.
    fn recount(&mut self, before: Option<Drawn>, mesh: Drawn) {
        if before != Some(mesh) {
            self.model_goes(before);
            self.model_comes(mesh);
        }
    }

    /// Counts an instance in, if its mesh is a model.
    fn model_comes(&mut self, mesh: Drawn) {
        if let Drawn::Model(id) = mesh {
            *self.models.entry(id).or_insert(0) += 1;
        }
    }

    /// Counts an instance out that had this mesh, if that is a model.
    fn model_goes(&mut self, mesh: Option<Drawn>) {
        let Some(Drawn::Model(id)) = mesh else { return };
        if let std::collections::btree_map::Entry::Occupied(mut count) = self.models.entry(id) {
            *count.get_mut() -= 1;
            if *count.get() == 0 {
                count.remove();
            }
        }
    }

    fn note(&mut self, number: u32) {
        self.version += 1;
        self.stamps[number as usize] = self.version;
        self.changed.push(number);
        self.recarded.push(number);
    }

    /// A number that is free; `nimble` ones are of bodies that are dressed as they are seen.
    fn take_number(&mut self, nimble: bool) -> u32 {
        self.arrangement += 1;
        let free = &mut self.free[usize::from(nimble)];
        if let Some(card) = self.cards.get_mut(*free as usize) {
            return std::mem::replace(free, std::mem::replace(&mut card.next, NONE));
        }
        let mesh = Drawn::Own(MeshId::Cuboid);
        let (slot, part, next) = (NONE, 0, NONE);
        self.cards.push(Card { mesh, slot, part, casts: false, mobile: false, details: 0, nimble, next });
        self.instances.push(bytemuck::Zeroable::zeroed());
        self.grains.push(Grain::default());
        self.stamps.push(0);
        self.cards.len() as u32 - 1
    }
}

fn is_closed(mesh: Drawn) -> bool {
    matches!(mesh, Drawn::Own(mesh) if mesh.closed().is_some())
}
