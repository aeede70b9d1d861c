//! How the parts of models take light, and the pictures on them, as shaders/models.wgsl reads both: a table, and rows of texels.
//!
//! Table and texels follow from the models that are drawn of a scene, and from nothing that came before. Pictures that are too many bytes
//! together for the memory that they are given lose their finest levels, the largest pictures first.

use std::collections::BTreeMap;
use std::sync::Arc;

use simworld_core::asset::{LONGEST_IMAGE, Model, ModelImage, ModelPart, Wrap};

use crate::RenderError;
use crate::gpu::{Gpu, LAYER, ROW, Texels};
use crate::mesh::ModelId;
use crate::sources::{Source, Sources};
use crate::threads;

/// Entries of the table that a part has.
const ENTRIES: usize = 3;

/// What stands for the row of a part without a picture.
const NO_PICTURE: f32 = -1.0;

/// The table, and the pictures on the device.
pub(crate) struct Coats {
    texels: Texels,
    /// Rows that pictures may take.
    most: u32,
    models: Vec<(Source, Arc<Model>)>,
    table: Vec<[f32; 4]>,
    /// The longest side of a picture on the device.
    side: u32,
    /// The first row of each picture of its model.
    rows: BTreeMap<Source, (Arc<Model>, Vec<u32>)>,
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
            rows: BTreeMap::new(),
            next: 0,
        }
    }

    /// By [head](Source::head), where its parts begin in the table; then the parts.
    pub(crate) fn table(&self) -> &[[f32; 4]] {
        &self.table
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
        Ok(())
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
        let missing = |rows: &BTreeMap<Source, (Arc<Model>, Vec<u32>)>| -> Vec<(Source, Arc<Model>)> {
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
            let rows = self.send(gpu, &model);
            self.rows.insert(id, (model, rows));
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

    /// Sends the pictures of a model; their first rows.
    fn send(&mut self, gpu: &Gpu, model: &Model) -> Vec<u32> {
        let side = self.side;
        let shares: Vec<&ModelImage> = model.images.iter().collect();
        // Pictures are few, and each is worth a thread.
        let chains = threads::each(shares, |image| texels_of(image, side));
        let mut rows = Vec::with_capacity(chains.len());
        for texels in chains {
            rows.push(self.next);
            self.texels.write(gpu, self.next, &texels);
            self.next += texels.len() as u32 / ROW;
        }
        rows
    }

    fn fill_table(&mut self) {
        self.table.clear();
        let heads = self.models.iter().map(|(id, _)| id.head() + 1).max().unwrap_or(0);
        self.table.resize(heads, [0.0; 4]);
        for (id, model) in &self.models {
            self.table[id.head()][0] = self.table.len() as f32;
            let rows = self.rows.get(id).map_or(&[][..], |(_, rows)| rows);
            for part in &model.parts {
                self.table.extend(entries_of(part, model, rows, self.side));
            }
        }
    }
}

/// What the table says of a part.
fn entries_of(part: &ModelPart, model: &Model, rows: &[u32], side: u32) -> [[f32; 4]; ENTRIES] {
    let finish = &part.finish;
    let [red, green, blue] = finish.emission;
    let picture = part.texture.and_then(|texture| {
        let index = texture.image as usize;
        Some((texture.wrap, *rows.get(index)?, shrunk(model.images.get(index)?, side)))
    });
    let (row, wraps, [width, height]) = match picture {
        Some(([right, down], row, size)) => (row as f32, code(right) | code(down) << 2, size),
        None => (NO_PICTURE, 0, [1, 1]),
    };
    let levels = levels_of([width, height]).count();
    [
        [finish.roughness, finish.metallic, row, wraps as f32],
        [red, green, blue, 0.0],
        [width as f32, height as f32, levels as f32, 0.0],
    ]
}

/// As shaders/models.wgsl has it.
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
        texels.extend(image.pixels.as_chunks::<3>().0.iter().map(|[r, g, b]| [*r, *g, *b, 255]));
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
    use super::*;

    fn image(width: u32, height: u32) -> ModelImage {
        let pixels = (0..width * height * 3).map(|k| (k % 251) as u8).collect();
        ModelImage { width, height, pixels }
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
                    let [r, g, b, _] = texels[first + last];
                    assert_eq!([r, g, b], level.pixels[last * 3..], "{size:?}");
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
        let [first, _, third] = entries_of(&part, &model, &[0, 7], 256);
        assert_eq!((first[2], first[3]), (7.0, 6.0));
        assert_eq!(third, [150.0, 75.0, 8.0, 0.0]);
        let [first, ..] = entries_of(&plain, &model, &[0, 7], 256);
        assert_eq!(first, [0.85, 0.0, NO_PICTURE, 0.0]);
    }
}
