//! What each view of a batch draws: culled, and ordered by mesh and distance.

use std::ops::Range;

use simworld_core::geometry::Vector3;
use simworld_core::id::EntityId;

use crate::look::Detail;
use crate::mesh::Drawn;
use crate::resident::{Ball, Residents};
use crate::shadow::ShadowView;
use crate::view::View;

/// A run of instances of one mesh, as positions in [`DrawList::picks`].
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Batch {
    pub mesh: Drawn,
    pub instances: Range<u32>,
}

/// One instance to sort: mesh, rank, slot and part, so that the order depends on the scene alone; then its number.
type Entry = (Drawn, u32, u32, u32, u32);

/// The batches of one view.
#[derive(Clone, Debug, Default)]
pub(crate) struct ViewBatches {
    pub visible: Vec<Batch>,
    pub casters: Vec<Batch>,
}

/// The numbers of instances in the order in which they are drawn, view by view.
#[derive(Default)]
pub(crate) struct DrawList {
    pub picks: Vec<u32>,
    pub views: Vec<ViewBatches>,
    seen: Vec<Entry>,
    shading: Vec<Entry>,
}

impl DrawList {
    pub(crate) fn clear(&mut self) {
        self.picks.clear();
        self.views.clear();
    }

    /// Adds what a view sees, and what throws shadows on it; `hidden` is left out of the picture, and everybody but `only`.
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
        let detail = |ball: &Ball| {
            if residents.finest {
                return Detail::Near.bit();
            }
            let distance = from_eye(ball).norm().max(ball.radius);
            Detail::of(ball.radius, view.pixels(ball.radius, distance)).bit()
        };
        let sees =
            |cell: &Ball, largest: f64| view.sees_some(&from_eye(cell), cell.radius, largest, min_pixels);
        let entry = |number: u32, rank: u32| {
            let card = &residents.cards[number as usize];
            (card.mesh, rank, card.slot, card.part, number)
        };
        residents.grid.visit(sees, |number, ball| {
            let center = from_eye(ball);
            let card = &residents.cards[number as usize];
            let wanted = hidden != Some(card.slot)
                && only.is_none_or(|slot| slot == card.slot)
                && card.details & detail(ball) != 0;
            if wanted && view.sees(&center, ball.radius, min_pixels) {
                self.seen.push(entry(number, rank(card.mesh, &center)));
            }
        });
        if let Some(shadow) = shadow {
            let reaches = |ball: &Ball| shadow.reaches(&from_eye(ball), ball.radius);
            residents.grid.visit(
                |cell, _| reaches(cell),
                |number, ball| {
                    let card = &residents.cards[number as usize];
                    if card.casts && card.details & detail(ball) != 0 && reaches(ball) {
                        self.shading.push(entry(number, 0));
                    }
                },
            );
        }
        self.seen.sort_unstable();
        self.shading.sort_unstable();
        let visible = batches(&self.seen, &mut self.picks);
        let casters = batches(&self.shading, &mut self.picks);
        self.views.push(ViewBatches { visible, casters });
    }
}

fn batches(sorted: &[Entry], picks: &mut Vec<u32>) -> Vec<Batch> {
    let mut batches: Vec<Batch> = Vec::new();
    for (mesh, .., number) in sorted {
        let position = picks.len() as u32;
        picks.push(*number);
        match batches.last_mut() {
            Some(last) if last.mesh == *mesh => last.instances.end = position + 1,
            _ => batches.push(Batch { mesh: *mesh, instances: position..position + 1 }),
        }
    }
    batches
}

/// Near ones first, so that what they hide is not shaded; flat surfaces keep the order of their entities, because where two
/// lie in one plane the first is seen, and that must not change with the camera.
fn rank(mesh: Drawn, center: &Vector3) -> u32 {
    // The bits of positive floats sort as the floats do.
    if mesh.pattern().is_flat() { 0 } else { (center.norm_squared() as f32).to_bits() }
}
