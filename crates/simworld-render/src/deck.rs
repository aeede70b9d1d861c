//! What a device that culls knows of the instances: what kind of thing each is, and where; kept up with the residents change by change.

use std::collections::BTreeMap;
use std::ops::Range;

use bytemuck::{Pod, Zeroable};

use crate::gpu::Matter;
use crate::mesh::{Drawn, MeshId, ModelId};
use crate::resident::Residents;
use crate::sieve::{NO_SPECK, threshold_of};

/// Whether it throws shadows, in [`Token::traits`].
const CASTS: u32 = 8;
const NONE: u32 = u32::MAX;

/// An instance; the twin of `Card` in shaders/sift.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(crate) struct Token {
    center: [i32; 3],
    radius: u32,
    size: f32,
    slot: u32,
    kind: u32,
    traits: u32,
}

/// A kind of thing; its twin is in shaders/sift.wgsl.
#[repr(C)]
#[derive(Clone, Copy, Debug, Pod, Zeroable)]
pub(crate) struct Kind {
    speck: u32,
    threshold: u32,
    is_flat: u32,
    spare: u32,
    whole: [u32; 2],
    cut: [u32; 2],
    film: [u32; 2],
}

/// Kinds have numbers: those of the meshes of this crate are [`MeshId`]s, those of models follow.
#[derive(Default)]
pub(crate) struct Deck {
    /// By number of an instance, its kind.
    kinds: Vec<u32>,
    /// By kind, how many instances it has.
    counts: Vec<u32>,
    models: Vec<Option<ModelId>>,
    numbers: BTreeMap<ModelId, u32>,
    epoch: u64,
    /// Whether changes were passed over.
    stale: bool,
}

impl Deck {
    /// Passes over what changed; everything is looked at when it is followed again.
    pub(crate) fn pass_over(&mut self, residents: &mut Residents) {
        self.stale = true;
        residents.recarded.clear();
    }

    /// Takes in what changed of the residents; true if everything did. Their list of changes is left to whoever sends them.
    pub(crate) fn follow(&mut self, residents: &Residents) -> bool {
        let everything = self.stale || self.epoch != residents.epoch;
        if everything {
            *self = Self { epoch: residents.epoch, ..Self::default() };
        }
        self.kinds.resize(residents.cards.len(), NONE);
        let count = residents.cards.len() as u32;
        let all = if everything { 0..count } else { 0..0 };
        let some = if everything { &[][..] } else { &residents.recarded[..] };
        for number in all.chain(some.iter().copied()) {
            let card = &residents.cards[number as usize];
            let kind = card.slot_there().map(|_| self.number_of(card.mesh));
            // Counted in first, so that a model that goes and comes keeps its number.
            if let Some(kind) = kind {
                self.counts[kind as usize] += 1;
            }
            let before = std::mem::replace(&mut self.kinds[number as usize], kind.unwrap_or(NONE));
            self.take_out(before);
        }
        everything
    }

    fn take_out(&mut self, kind: u32) {
        let Some(count) = self.counts.get_mut(kind as usize) else { return };
        *count -= 1;
        if let (0, Some(model)) = (*count, (kind as usize).checked_sub(MeshId::ALL.len()))
            && let Some(id) = self.models[model].take()
        {
            self.numbers.remove(&id);
        }
    }

    /// The number of a kind; one that is free, if it has none yet.
    fn number_of(&mut self, mesh: Drawn) -> u32 {
        let own = MeshId::ALL.len();
        if self.counts.is_empty() {
            self.counts.resize(own, 0);
        }
        let id = match mesh {
            Drawn::Own(mesh) => return mesh as u32,
            Drawn::Model(id) => id,
        };
        *self.numbers.entry(id).or_insert_with(|| {
            let free = self.models.iter().position(Option::is_none).unwrap_or(self.models.len());
            if free == self.models.len() {
                self.models.push(None);
                self.counts.push(0);
            }
            self.models[free] = Some(id);
            (own + free) as u32
        })
    }

    /// How many numbers kinds have.
    pub(crate) fn count(&self) -> u32 {
        (MeshId::ALL.len() + self.models.len()) as u32
    }

    /// The instances of a run of numbers.
    pub(crate) fn tokens(&self, residents: &Residents, run: Range<u32>) -> Vec<Token> {
        let token = |number: usize| {
            let (card, grain) = (&residents.cards[number], &residents.grains[number]);
            Token {
                center: grain.center,
                radius: grain.radius,
                size: grain.size,
                slot: card.slot,
                kind: self.kinds[number],
                traits: u32::from(card.details) | if card.casts { CASTS } else { 0 },
            }
        };
        (run.start as usize..run.end as usize).map(token).collect()
    }

    /// All kinds; `corners` says which of a mesh are of which matter.
    pub(crate) fn table(&self, corners: impl Fn(Drawn, Matter) -> Option<Range<u32>>) -> Vec<Kind> {
        let own = MeshId::ALL.iter().map(|mesh| Some(Drawn::Own(*mesh)));
        let models = self.models.iter().map(|id| id.map(Drawn::Model));
        let kind = |mesh: Option<Drawn>| {
            let speck = mesh.and_then(Drawn::speck);
            let lies = |matter| {
                let range = mesh.and_then(|mesh| corners(mesh, matter)).unwrap_or_default();
                [range.start, range.end - range.start]
            };
            Kind {
                speck: match speck {
                    Some((_, Drawn::Own(speck))) => speck as u32,
                    _ => NONE,
                },
                threshold: speck.map_or(NO_SPECK, |(few, _)| threshold_of(few)),
                is_flat: u32::from(mesh.is_some_and(|mesh| mesh.pattern().is_flat())),
                spare: 0,
                whole: lies(Matter::Whole),
                cut: lies(Matter::Cut),
                film: lies(Matter::Film),
            }
        };
        own.chain(models).map(kind).collect()
    }

    /// What may be drawn, in the order in which it is: runs of kinds of one pattern, and the mesh of the first.
    pub(crate) fn runs(&self) -> Vec<(Drawn, Range<u32>)> {
        let there = |kind: u32| self.counts.get(kind as usize).is_some_and(|count| *count > 0);
        let mut runs: Vec<(Drawn, Range<u32>)> =
            self.numbers.iter().map(|(id, kind)| (Drawn::Model(*id), *kind..kind + 1)).collect();
        // Whoever is there may be a speck.
        let specks: Vec<MeshId> = MeshId::ALL
            .iter()
            .filter(|mesh| there(**mesh as u32))
            .filter_map(|mesh| mesh.speck())
            .map(|(_, speck)| speck)
            .collect();
        for mesh in MeshId::ALL {
            let kind = *mesh as u32;
            if !there(kind) && !specks.contains(mesh) {
                continue;
            }
            match runs.last_mut() {
                // Between them nobody is.
                Some((Drawn::Own(first), run)) if first.pattern() == mesh.pattern() => run.end = kind + 1,
                _ => runs.push((Drawn::Own(*mesh), kind..kind + 1)),
            }
        }
        runs
    }
}
