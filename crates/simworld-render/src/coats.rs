//! How the parts of models take light, and the pictures on them, as shaders/pictures.wgsl reads both: a table, and rows of texels.
//!
//! Table and texels follow from the models that are drawn of a scene, and from nothing that came before. Pictures that are too many bytes
//! together for the memory that they are given lose their finest levels, the largest pictures first.

use std::collections::BTreeMap;
use std::sync::Arc;

use simworld_core::asset::{LONGEST_IMAGE, Model, ModelImage, ModelPart, ModelTexture, ModelVertex, Wrap};

use crate::RenderError;
use crate::coverage::{Cutoffs, Level, MOST_LEVELS, cutoffs, cuttable};
use crate::gpu::{Gpu, LAYER, Matter, ROW, Texels};
use crate::mesh::ModelId;
use crate::models::{cutoff_of, matter_of};
use crate::sources::{Source, Sources};
use crate::threads;

/// Entries of the table that a part has.
const ENTRIES: usize = 12;
/// Of these, those of its pictures: of colour, metal, light, shade and bumps.
const PICTURES: usize = 5;

/// What stands for the row of a picture that is not there, and for the cutoff of a part that is whole.
const NO_PICTURE: f32 = -1.0;
const WHOLE: f32 = -1.0;

/// What is on the device of the pictures of a model.
#[derive(Clone, Default)]
struct Laid {
    /// The first row of each picture.
    rows: Vec<u32>,
    /// By part, how much has to be there of it.
    cutoffs: Vec<Cutoffs>,
}

/// The table, and the pictures on the device.
pub(crate) struct Coats {
    texels: Texels,
    /// Rows that pictures may take.
    most: u32,
    models: Vec<(Source, Arc<Model>)>,
    table: Vec<[f32; 4]>,
    /// The longest side of a picture on the device.
    side: u32,
    /// Whether anything of the models is cut out, and whether anything is blended.
    are_cut: bool,
    are_films: bool,
    /// What is on the device of each model.
    rows: BTreeMap<Source, (Arc<Model>, Laid)>,
    /// Behind all of them.
    next: u32,
}

impl Coats {
    /// None yet, and so many bytes for pictures.
    pub(crate) fn new(gpu: &Gpu, memory: u64) -> Self {
        Self {
            texels: Texels::new(gpu),
            most: (memory / LAYER) as u32 * ROW,
            models: Vec::new(),
            table: Vec::new(),
            side: LONGEST_IMAGE,
            are_cut: false,
            are_films: false,
            rows: BTreeMap::new(),
            next: 0,
        }
    }

    /// Whether there are any.
    pub(crate) fn is_empty(&self) -> bool {
        self.table.is_empty()
    }

    /// Whether anything of them is cut out, or blended.
    pub(crate) const fn are_cut(&self) -> bool {
        self.are_cut
    }

    /// Whether anything of them is blended.
    pub(crate) const fn are_films(&self) -> bool {
        self.are_films
    }

    pub(crate) const fn texels(&self) -> &Texels {
        &self.texels
    }

    /// Follows the models that are drawn of a scene.
    pub(crate) fn hold(
        &mut self,
        gpu: &Gpu,
        sources: Sources<'_>,
        drawn: &BTreeMap<ModelId, u32>,
    ) -> Result<(), RenderError> {
        let mut wanted: Vec<Source> = drawn.keys().map(|id| id.source).collect();
        wanted.dedup();
        let there = || wanted.iter().filter_map(|id| Some((*id, sources.find(*id)?.model)));
        let known = self.models.iter().map(|(id, model)| (*id, model));
        if there()
            .map(|(id, model)| (id, Arc::as_ptr(&model)))
            .eq(known.map(|(id, model)| (id, Arc::as_ptr(model))))
        {
            return Ok(());
        }
        self.models = there().collect();
        self.lay_out(gpu)?;
        self.fill_table();
        self.texels.tell(gpu, &self.table);
        gpu.check()
    }

    /// Puts the pictures of all models on the device that are not there yet.
    fn lay_out(&mut self, gpu: &Gpu) -> Result<(), RenderError> {
        let side = self.affordable()?;
        let models = &self.models;
        // Those of others keep their rows until these are wanted.
        self.rows.retain(|id, (model, _)| {
            let at = models.binary_search_by_key(id, |(other, _)| *other);
            at.is_ok_and(|at| Arc::ptr_eq(&models[at].1, model))
        });
        let missing = |rows: &BTreeMap<Source, (Arc<Model>, Laid)>| -> Vec<(Source, Arc<Model>)> {
            models.iter().filter(|(id, _)| !rows.contains_key(id)).cloned().collect()
        };
        let mut wanted = missing(&self.rows);
        let more = rows_of_all(&wanted, side);
        if side != self.side || u64::from(self.next) + more > u64::from(self.texels.rows()) {
            // Everything anew, without what nobody has any more.
            (self.side, self.next) = (side, 0);
            self.rows.clear();
            wanted = missing(&self.rows);
            let rows = rows_of_all(&wanted, side);
            if rows > u64::from(self.texels.rows()) {
                // What is affordable are so few.
                self.texels.replace(gpu, rows as u32);
                gpu.check()?;
            }
        }
        for (id, model) in wanted {
            let laid = self.send(gpu, &model);
            self.rows.insert(id, (model, laid));
        }
        Ok(())
    }

    /// The longest side at which all pictures have room together.
    fn affordable(&self) -> Result<u32, RenderError> {
        let most = u64::from(self.most);
        let sides = std::iter::successors(Some(LONGEST_IMAGE), |side| (*side > 1).then(|| side / 2));
        let mut fitting = sides.filter(|side| rows_of_all(&self.models, *side) <= most);
        fitting.next().ok_or_else(|| RenderError::Pictures {
            count: self.models.iter().map(|(_, model)| model.images.len()).sum(),
            limit: self.most as usize,
        })
    }

    /// Sends the pictures of a model.
    fn send(&mut self, gpu: &Gpu, model: &Model) -> Laid {
        let side = self.side;
        let shares: Vec<&ModelImage> = model.images.iter().collect();
        // Pictures are few, and each is worth a thread.
        let chains = threads::each(shares, |image| texels_of(image, side));
        let mut rows = Vec::with_capacity(chains.len());
        for texels in &chains {
            rows.push(self.next);
            self.texels.write(gpu, self.next, texels);
            self.next += texels.len() as u32 / ROW;
        }
        let parts = model.runs().collect();
        let cutoffs =
            threads::each(parts, |(part, triangles)| cutoffs_of(model, part, triangles, &chains, side));
        Laid { rows, cutoffs }
    }

    fn fill_table(&mut self) {
        self.table.clear();
        (self.are_cut, self.are_films) = (false, false);
        let heads = self.models.iter().map(|(id, _)| id.head() + 1).max().unwrap_or(0);
        self.table.resize(heads, [0.0; 4]);
        for (id, model) in &self.models {
            self.table[id.head()][0] = self.table.len() as f32;
            let none = Laid::default();
            let laid = self.rows.get(id).map_or(&none, |(_, laid)| laid);
            for (number, part) in model.parts.iter().enumerate() {
                self.are_cut |= cutoff_of(part).is_some();
                self.are_films |= matter_of(part) == Matter::Film;
                self.table.extend(entries_of(part, number, model, laid, self.side));
            }
        }
    }
}

/// What the table says of a part, which is that one of its model.
fn entries_of(part: &ModelPart, number: usize, model: &Model, laid: &Laid, side: u32) -> [[f32; 4]; ENTRIES] {
    let (finish, pictures) = (&part.finish, &part.pictures);
    let [red, green, blue] = finish.emission;
    let cutoff = cutoff_of(part);
    let mut entries = [[0.0; 4]; ENTRIES];
    entries[1] = [red, green, blue, 0.0];
    let textures: [Option<ModelTexture>; PICTURES] =
        [part.texture, pictures.metal, pictures.emission, pictures.shade, pictures.bumps];
    // Which of them there are, beside that of colour.
    let kinds: u32 =
        (0..).zip(&textures[1..]).map(|(bit, texture)| u32::from(texture.is_some()) << bit).sum();
    entries[0] = [finish.roughness, finish.metallic, kinds as f32, cutoff.unwrap_or(WHOLE)];
    for (entry, texture) in entries[2..].iter_mut().zip(textures) {
        *entry = picture_entry(texture, model, laid, side);
    }
    let cutoffs = laid.cutoffs.get(number).filter(|_| cutoff.is_some());
    if let Some(Cutoffs { levels, .. }) = cutoffs {
        entries[2] = with_levels(entries[2], *levels);
    }
    entries[7] = [pictures.shade_strength, pictures.bump_scale, 0.0, 0.0];
    let values = cutoffs.map_or([cutoff.unwrap_or(WHOLE); MOST_LEVELS], |cutoffs| cutoffs.values);
    entries[8..].copy_from_slice(values.as_chunks::<4>().0);
    entries
}

/// What the table says of a picture: its first row, its sides, and behind its ways to wrap how many levels it has.
fn picture_entry(texture: Option<ModelTexture>, model: &Model, laid: &Laid, side: u32) -> [f32; 4] {
    let picture = texture.and_then(|texture| {
        let index = texture.image as usize;
        Some((texture.wrap, *laid.rows.get(index)?, shrunk(model.images.get(index)?, side)))
    });
    let Some(([right, down], row, [width, height])) = picture else { return [NO_PICTURE, 1.0, 1.0, 16.0] };
    let wraps = (code(right) | code(down) << 2) as f32;
    with_levels([row as f32, width as f32, height as f32, wraps], levels_of([width, height]).count())
}

/// The entry of a picture of which that many levels are shown.
fn with_levels([row, width, height, code]: [f32; 4], levels: usize) -> [f32; 4] {
    [row, width, height, code % 16.0 + 16.0 * levels as f32]
}

/// How much has to be there of a part, of whose model these are the texels.
fn cutoffs_of(
    model: &Model,
    part: &ModelPart,
    triangles: &[[u32; 3]],
    chains: &[Vec<[u8; 4]>],
    side: u32,
) -> Cutoffs {
    let all = |value| Cutoffs { values: [value; MOST_LEVELS], levels: 1 };
    let Some(cutoff) = cutoff_of(part) else { return all(WHOLE) };
    let found = part.texture.and_then(|texture| {
        let index = texture.image as usize;
        Some((texture.wrap, model.images.get(index)?, chains.get(index)?))
    });
    let Some((wrap, image, texels)) = found else { return all(cutoff) };
    // What the vertices have, which most files leave at 1, is looked at by its mean.
    let corners = triangles.as_flattened();
    let alpha =
        |corner: &u32| model.vertices.get(*corner as usize).map_or(1.0, |vertex: &ModelVertex| vertex.alpha);
    let own = corners.iter().map(alpha).sum::<f32>() / corners.len().max(1) as f32;
    let mut first = 0;
    let finest = shrunk(image, side);
    let levels = levels_of(finest).take(cuttable(levels_of(finest))).map(|size| {
        let count = (size[0] * size[1]) as usize;
        let alpha = texels[first..first + count].iter().map(|texel| texel[3]).collect();
        first += count;
        Level { size, alpha }
    });
    let levels: Vec<Level> = levels.collect();
    let own = own.max(1e-3);
    let found = cutoffs(&levels, wrap, cutoff / own);
    Cutoffs { values: found.values.map(|value| value * own), ..found }
}

/// As shaders/pictures.wgsl has it.
const fn code(wrap: Wrap) -> u32 {
    match wrap {
        Wrap::Repeat => 0,
        Wrap::Mirror => 1,
        Wrap::Clamp => 2,
    }
}

/// The sides of a picture, halved until none is longer than that.
fn shrunk(image: &ModelImage, side: u32) -> [u32; 2] {
    let mut size = [image.width, image.height];
    while size[0].max(size[1]) > side {
        size = size.map(|side| (side / 2).max(1));
    }
    size
}

/// The sizes of all levels of a picture, from the finest to one pixel.
fn levels_of(finest: [u32; 2]) -> impl Iterator<Item = [u32; 2]> {
    std::iter::successors(Some(finest), |size| {
        (size[0].max(size[1]) > 1).then(|| size.map(|side| (side / 2).max(1)))
    })
}

/// Rows that a picture takes with all its levels.
fn rows_of(image: &ModelImage, side: u32) -> u32 {
    levels_of(shrunk(image, side)).map(|[width, height]| width * height).sum::<u32>().div_ceil(ROW)
}

/// Rows that the pictures of models take.
fn rows_of_all(models: &[(Source, Arc<Model>)], side: u32) -> u64 {
    let images = models.iter().flat_map(|(_, model)| &model.images);
    images.map(|image| u64::from(rows_of(image, side))).sum()
}

/// The texels of all levels of a picture behind one another, filled up to whole rows.
fn texels_of(image: &ModelImage, side: u32) -> Vec<[u8; 4]> {
    let mut texels: Vec<[u8; 4]> = Vec::new();
    let mut add = |image: &ModelImage| {
        let alpha = image.alpha.iter().copied().chain(std::iter::repeat(u8::MAX));
        let colors = image.pixels.as_chunks::<3>().0;
        texels.extend(colors.iter().zip(alpha).map(|([r, g, b], alpha)| [*r, *g, *b, alpha]));
    };
    let mut smaller: Option<ModelImage> = None;
    loop {
        let level = smaller.as_ref().unwrap_or(image);
        let longest = level.width.max(level.height);
        if longest <= side {
            add(level);
        }
        if longest <= 1 {
            break;
        }
        smaller = Some(level.halved());
    }
    texels.resize(texels.len().next_multiple_of(ROW as usize), [0; 4]);
    texels
}

#[cfg(test)]
mod tests {
    use simworld_core::asset::Transparency;

    use super::*;

    fn image(width: u32, height: u32) -> ModelImage {
        let pixels = (0..width * height * 3).map(|k| (k % 251) as u8).collect();
        let alpha = (0..width * height).map(|k| (k % 241) as u8).collect();
        ModelImage { width, height, pixels, alpha, ..ModelImage::default() }
    }

    #[test]
    fn levels_lie_where_the_shader_looks_for_them() {
        for (width, height) in [(1, 1), (5, 3), (64, 64), (100, 7), (1, 900), (2000, 40)] {
            for side in [LONGEST_IMAGE, 256, 16, 1] {
                let image = image(width, height);
                let texels = texels_of(&image, side);
                assert_eq!(texels.len() as u32, rows_of(&image, side) * ROW, "{width} x {height} at {side}");
                let finest = shrunk(&image, side);
                assert!(finest.iter().all(|length| (1..=side).contains(length)));
                let mut level = image.clone();
                while level.width.max(level.height) > side {
                    level = level.halved();
                }
                let mut first = 0;
                for size in levels_of(finest) {
                    assert_eq!(size, [level.width, level.height]);
                    let last = (size[0] * size[1]) as usize - 1;
                    let [r, g, b, a] = texels[first + last];
                    assert_eq!([r, g, b], level.pixels[last * 3..], "{size:?}");
                    assert_eq!(a, level.alpha[last], "{size:?}");
                    first += last + 1;
                    level = level.halved();
                }
            }
        }
    }

    #[test]
    fn the_table_names_the_picture_of_a_part() {
        let texture = simworld_core::asset::ModelTexture { image: 1, wrap: [Wrap::Clamp, Wrap::Mirror] };
        let plain = ModelPart::default();
        let part = ModelPart { texture: Some(texture), ..plain.clone() };
        let model = Model { images: vec![image(4, 4), image(600, 300)], ..Model::default() };
        let cutoffs = vec![Cutoffs { values: [0.4; MOST_LEVELS], levels: 5 }];
        let laid = Laid { rows: vec![0, 7], cutoffs };
        let entries = entries_of(&part, 0, &model, &laid, 256);
        // 8 levels, clamped across and mirrored downwards.
        assert_eq!(entries[2], [7.0, 150.0, 75.0, 128.0 + 6.0]);
        assert_eq!(entries[3][0], NO_PICTURE);
        let entries = entries_of(&plain, 0, &model, &laid, 256);
        assert_eq!((entries[0], entries[2][0]), ([0.85, 0.0, 0.0, WHOLE], NO_PICTURE));
        // Of what is cut out, levels at which too much or too little would be there are not shown.
        let cut = ModelPart { transparency: Transparency::Cutout { cutoff: 0.5 }, ..part };
        let entries = entries_of(&cut, 0, &model, &laid, 256);
        assert_eq!((entries[0][3], entries[2][3], entries[11][3]), (0.5, 80.0 + 6.0, 0.4));
    }
}
