//! What each view of a batch draws: culled, and ordered by mesh and distance.

use std::ops::Range;

use simworld_core::geometry::Vector3;
use simworld_core::id::EntityId;

use crate::batch::Projection;
use crate::gpu::Casters;
use crate::mesh::{Drawn, Extent, ModelId};
use crate::occlusion::Occlusion;
use crate::resident::{Ball, Residents};
use crate::shadow::ShadowView;
use crate::sieve::Sieve;
use crate::view::{View, slack};

/// Instances of one mesh that are drawn one after the other.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Batch {
    pub mesh: Drawn,
    pub instances: Run,
}

impl Batch {
    /// The model that they are, if they are one.
    pub(crate) const fn model(&self) -> Option<ModelId> {
        match self.mesh {
            Drawn::Model(id) => Some(id),
            Drawn::Own(_) => None,
        }
    }
}

/// Which instances.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Run {
    /// Positions in [`DrawList::picks`].
    Listed(Range<u32>),
    /// What a device found of so many kinds from this one on, all of one pattern: the mesh is that of the first.
    Found(Range<u32>),
}

/// One instance to sort: mesh, bucket of distance, slot and part, so that the order depends on the scene alone; then its number. Near ones come
/// first, so that what they hide is not shaded; flat surfaces keep the order of their entities, because where two lie in one plane the first is
/// seen, and that must not change with the camera.
type Entry = (Drawn, u32, u32, u32, u32);

/// The batches of one view.
#[derive(Clone, Debug, Default)]
pub(crate) struct ViewBatches {
    pub visible: Vec<Batch>,
    /// What throws shadows; none where there are none, or the map is known to be right.
    pub shadows: Option<ShadowList>,
}

impl ViewBatches {
    /// Those of the picture and of its shadow map.
    pub(crate) fn all(&self) -> impl Iterator<Item = &[Batch]> {
        let shadows = self.shadows.iter().flat_map(|shadows| shadows.batches.iter().map(Vec::as_slice));
        std::iter::once(&self.visible[..]).chain(shadows)
    }
}

/// What throws shadows into a map: what stands still, then what moves.
#[derive(Clone, Debug, Default)]
pub(crate) struct ShadowList {
    pub batches: [Vec<Batch>; 2],
    pub casters: [Casters; 2],
}

/// The numbers of instances in the order in which they are drawn, view by view.
#[derive(Default)]
pub(crate) struct DrawList {
    pub picks: Vec<u32>,
    pub views: Vec<ViewBatches>,
    seen: Vec<Entry>,
    shading: Vec<Entry>,
    occlusion: Occlusion,
    /// What stands behind houses is listed too.
    #[cfg(test)]
    pub all: bool,
    /// Blocks that may hide something, with their rank, slot and number.
    blocks: Vec<(u32, u32, u32)>,
    extents: Vec<Extent>,
}

/// As many blocks, the nearest of them, hide what is behind them.
const MOST_BLOCKS: usize = 192;
/// Blocks of fewer pixels across hide nothing.
const LEAST_BLOCK: f64 = 24.0;

impl DrawList {
    pub(crate) fn new(extents: &[Extent]) -> Self {
        Self { extents: extents.to_vec(), ..Self::default() }
    }

    pub(crate) fn clear(&mut self) {
        self.picks.clear();
        self.views.clear();
    }

    /// Adds what a view sees, and what throws shadows into a map that is to be looked at; `hidden` is left out of the picture, and everybody but `only`.
    pub(crate) fn add(
        &mut self,
        residents: &Residents,
        view: &View,
        shadow: Option<&ShadowView>,
        min_pixels: f64,
        [hidden, only]: [Option<EntityId>; 2],
    ) {
        self.seen.clear();
        self.shading.clear();
        let [hidden, only] = [hidden, only].map(|id| id.map(|id| id.index() as u32));
        let from_eye = |ball: &Ball| ball.center - view.eye;
        self.find_blocks(residents, view, min_pixels, hidden, only);
        let (occlusion, extents) = (&self.occlusion, &self.extents);
        let hides = |ball: &Ball| occlusion.hides(view, &from_eye(ball), ball.radius);
        let sees = |cell: &Ball, largest: f64| {
            view.sees_some(&from_eye(cell), cell.radius, largest, min_pixels) && !hides(cell)
        };
        let sieve = Sieve::of_view(view, min_pixels, residents.finest, [hidden, only]);
        residents.grid.visit(sees, |number, ball| {
            let (card, grain) = (&residents.cards[number as usize], &residents.grains[number as usize]);
            if let Some((mesh, bucket)) = sieve.sift(card, grain)
                && !hides(ball)
                && !body_ball(residents, extents, number).is_some_and(|ball| hides(&ball))
            {
                self.seen.push((mesh, bucket, card.slot, card.part, number));
            }
        });
        self.seen.sort_unstable();
        let visible = batches(&self.seen, &mut self.picks);
        let shadows = shadow.map(|shadow| self.shadows(residents, shadow));
        self.views.push(ViewBatches { visible, shadows });
    }

    /// Adds a view of which the device finds what it sees, and what throws shadows into its map if that is to be drawn.
    pub(crate) fn add_found(&mut self, batches: &[Batch], is_shaded: bool) {
        let shadows = is_shaded
            .then(|| ShadowList { batches: [batches.to_vec(), Vec::new()], casters: Default::default() });
        self.views.push(ViewBatches { visible: batches.to_vec(), shadows });
    }

    /// What throws shadows into a map, as finely as its texels show: the same for every eye.
    fn shadows(&mut self, residents: &Residents, shadow: &ShadowView) -> ShadowList {
        let sieve = Sieve::of_shadow(shadow, residents.finest);
        let mut layers = [std::mem::take(&mut self.seen), std::mem::take(&mut self.shading)];
        layers.iter_mut().for_each(Vec::clear);
        let reaches = |cell: &Ball, largest: f64| {
            let away = (cell.center - shadow.center).norm();
            shadow.reaches(&cell.center, cell.radius + slack(away, cell.radius.max(largest)))
        };
        residents.grid.visit(reaches, |number, _| {
            let (card, grain) = (&residents.cards[number as usize], &residents.grains[number as usize]);
            if let Some((mesh, _)) = sieve.sift(card, grain) {
                layers[usize::from(card.mobile)].push((mesh, 0, card.slot, card.part, number));
            }
        });
        for layer in &mut layers {
            layer.sort_unstable();
        }
        let casters = layers.each_ref().map(|layer| {
            layer.iter().map(|(.., number)| (*number, residents.stamps[*number as usize])).collect()
        });
        let batches = layers.each_ref().map(|layer| batches(layer, &mut self.picks));
        [self.seen, self.shading] = layers;
        ShadowList { batches, casters }
    }

    /// Finds the walls that hide what is behind them from the view.
    fn find_blocks(
        &mut self,
        residents: &Residents,
        view: &View,
        min_pixels: f64,
        hidden: Option<u32>,
        only: Option<u32>,
    ) {
        self.occlusion.begin(view);
        #[cfg(test)]
        if self.all {
            return;
        }
        if only.is_some() || view.projection != Projection::Pinhole {
            return;
        }
        self.blocks.clear();
        let least = LEAST_BLOCK.max(min_pixels);
        residents.walls.visit(
            |cell, largest| view.sees_some(&(cell.center - view.eye), cell.radius, largest, least),
            |number, ball| {
                let center = ball.center - view.eye;
                let slot = residents.cards[number as usize].slot;
                if hidden != Some(slot) && view.sees(&center, ball.radius, least) {
                    self.blocks.push(((center.norm() as f32).to_bits(), slot, number));
                }
            },
        );
        self.blocks.sort_unstable();
        // Levels of detail of one building are one block.
        self.blocks.dedup_by_key(|(_, slot, _)| *slot);
        self.blocks.truncate(MOST_BLOCKS);
        for (.., number) in &self.blocks {
            if let Some(block) = residents.block(*number, &view.eye) {
                self.occlusion.cover(view, &block);
            }
        }
    }
}

/// The ball around the mesh of an instance, which may be much smaller than that of its entity; none for models of assets.
fn body_ball(residents: &Residents, extents: &[Extent], number: u32) -> Option<Ball> {
    let Drawn::Own(mesh) = residents.cards[number as usize].mesh else { return None };
    let Extent { anchors, offsets } = extents.get(mesh as usize)?;
    let instance = &residents.instances[number as usize];
    let (scale, unit) = instance.measure();
    let point = |side: usize| {
        Vector3::from_fn(|axis, _| f64::from(anchors[side][axis] * scale[axis] + offsets[side][axis] * unit))
    };
    let (low, high) = (point(0), point(1));
    // What floats lose is made up for.
    let radius = (high - low).norm() * 0.5 + 1e-3;
    Some(Ball { center: instance.at(&((low + high) * 0.5)).into(), radius })
}

fn batches(sorted: &[Entry], picks: &mut Vec<u32>) -> Vec<Batch> {
    let mut batches: Vec<Batch> = Vec::new();
    for (mesh, .., number) in sorted {
        let position = picks.len() as u32;
        picks.push(*number);
        match batches.last_mut() {
            Some(Batch { mesh: known, instances: Run::Listed(run) }) if known == mesh => {
                run.end = position + 1;
            }
            _ => batches.push(Batch { mesh: *mesh, instances: Run::Listed(position..position + 1) }),
        }
    }
    batches
}
