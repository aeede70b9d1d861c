//! Colours of vertices: the factor of their material, its texture and their own, in linear light.

use std::collections::BTreeMap;

use simworld_core::ops;

use super::accessor::{Column, Data, Normalized, Number, get};
use super::document::{Material, Primitive, Sampler, TextureInfo, TextureTransform};
use super::error::GlbError;
use super::picture::{Picture, Undecoded};

/// Decodes pictures once, within a budget.
pub(super) struct Painter<'a> {
    data: Data<'a>,
    pictures: BTreeMap<usize, Picture>,
    pixels: u64,
    limit: u64,
    linear: Vec<f32>,
}

/// The colours of a primitive's vertices.
pub(super) struct Coat {
    /// Linear-light sRGB in [0, 1].
    pub(super) colors: Vec<[f32; 3]>,
    /// Whether the file says of what colour it is.
    pub(super) says: Says,
}

/// Whether a file says of what colour something is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Says {
    Color,
    Nothing,
}

impl<'a> Painter<'a> {
    pub(super) fn new(data: Data<'a>, limit: u64) -> Self {
        let linear = (0..256u32).map(|value| linear_light(f64::from(value) / 255.0) as f32).collect();
        Self { data, pictures: BTreeMap::new(), pixels: 0, limit, linear }
    }

    /// The colours of so many vertices of a primitive with these triangles.
    pub(super) fn coat(
        &mut self,
        primitive: &Primitive,
        vertices: usize,
        triangles: &[[u32; 3]],
    ) -> Result<Coat, GlbError> {
        let none = Material::default();
        let material = match primitive.material {
            Some(index) => get("material", &self.data.document.materials, index)?,
            None => &none,
        };
        let pbr = &material.pbr_metallic_roughness;
        let factor = pbr.base_color_factor.unwrap_or([1.0; 4]);
        let base = [factor[0], factor[1], factor[2]].map(|channel| channel.clamp(0.0, 1.0) as f32);
        let mut says = if base == [1.0; 3] { Says::Nothing } else { Says::Color };
        let mut colors = vec![base; vertices];
        if let Some(column) = self.own(primitive, vertices)? {
            says = Says::Color;
            for (row, color) in colors.iter_mut().enumerate() {
                let own: [f64; 3] = column.reals(row);
                *color = std::array::from_fn(|which| color[which] * own[which].clamp(0.0, 1.0) as f32);
            }
        }
        if let Some(info) = &pbr.base_color_texture {
            says = Says::Color;
            self.texture(info, primitive, triangles, &mut colors)?;
        }
        if colors.iter().flatten().all(|channel| channel.is_finite()) {
            Ok(Coat { colors, says })
        } else {
            Err(GlbError::Number { what: "material", index: primitive.material.unwrap_or(0) })
        }
    }

    fn own(&self, primitive: &Primitive, vertices: usize) -> Result<Option<Column<'a>>, GlbError> {
        let Some(index) = primitive.attributes.get("COLOR_0") else { return Ok(None) };
        let column = self.data.column(*index, &[("VEC3", 3), ("VEC4", 4)], is_share)?;
        same_length(*index, column.count, vertices)?;
        Ok(Some(column))
    }

    /// Multiplies in what a texture has at each vertex. Islands of a texture end at their edges, and beyond lies another
    /// colour: so a vertex takes the mean of points a little within each of its triangles.
    fn texture(
        &mut self,
        info: &TextureInfo,
        primitive: &Primitive,
        triangles: &[[u32; 3]],
        colors: &mut [[f32; 3]],
    ) -> Result<(), GlbError> {
        const INWARD: f64 = 0.2;
        let transform = info.extensions.transform.unwrap_or_default();
        let name = format!("TEXCOORD_{}", transform.tex_coord.unwrap_or(info.tex_coord));
        let Some(index) = primitive.attributes.get(&name) else {
            return Err(GlbError::Unsupported {
                what: "texture",
                index: info.index,
                reason: format!("its vertices have no {name}: export the file with texture coordinates"),
            });
        };
        let places = self.data.column(*index, &[("VEC2", 2)], |number, normalized| {
            is_share(number, normalized) || (number != Number::U32 && self.data.is_quantized())
        })?;
        same_length(*index, places.count, colors.len())?;
        let texture = get("texture", &self.data.document.textures, info.index)?;
        let sampler = match texture.sampler {
            Some(sampler) => *get("sampler", &self.data.document.samplers, sampler)?,
            None => Sampler::default(),
        };
        let image = texture.source.ok_or_else(|| GlbError::Unsupported {
            what: "texture",
            index: info.index,
            reason: "it has no picture as PNG or JPEG: export the textures as one of both".to_owned(),
        })?;
        self.decode(image)?;
        let (picture, linear) = (&self.pictures[&image], &self.linear);
        let mut sums = vec![([0.0f32; 3], 0u32); colors.len()];
        for triangle in triangles {
            let corners = triangle.map(|vertex| transform.of(places.reals::<2>(vertex as usize)));
            let middle: [f64; 2] =
                std::array::from_fn(|axis| corners.iter().map(|corner| corner[axis]).sum::<f64>() / 3.0);
            for (vertex, corner) in triangle.iter().zip(corners) {
                let place = std::array::from_fn(|axis| corner[axis] + (middle[axis] - corner[axis]) * INWARD);
                let pixel = picture.at(place, sampler);
                let (sum, count) = &mut sums[*vertex as usize];
                *sum = std::array::from_fn(|which| sum[which] + linear[usize::from(pixel[which])]);
                *count += 1;
            }
        }
        for (color, (sum, count)) in colors.iter_mut().zip(sums).filter(|(_, (_, count))| *count > 0) {
            *color = std::array::from_fn(|which| color[which] * sum[which] / count as f32);
        }
        Ok(())
    }

    fn decode(&mut self, index: usize) -> Result<(), GlbError> {
        if self.pictures.contains_key(&index) {
            return Ok(());
        }
        let image = get("image", &self.data.document.images, index)?;
        let Some(view) = image.buffer_view else {
            return Err(GlbError::Picture { index, reason: "the file does not hold it".to_owned() });
        };
        let left = self.limit - self.pixels;
        let picture = Picture::decode(self.data.view(view)?, left).map_err(|error| match error {
            Undecoded::Broken(reason) => GlbError::Picture { index, reason },
            Undecoded::Large(got) => {
                GlbError::TooMany { what: "pixels", got: got + self.pixels, most: self.limit }
            }
        })?;
        self.pixels += picture.len();
        self.pictures.insert(index, picture);
        Ok(())
    }
}

impl TextureTransform {
    /// Where a texture is looked up: scaled, then turned, then shifted (`KHR_texture_transform`).
    fn of(self, [u, v]: [f64; 2]) -> [f64; 2] {
        let (sin, cos) = ops::sin_cos(self.rotation);
        let [u, v] = [u * self.scale[0], v * self.scale[1]];
        [cos * u + sin * v + self.offset[0], cos * v - sin * u + self.offset[1]]
    }
}

/// Real numbers, or whole ones that stand for shares.
pub(super) fn is_share(number: Number, normalized: Normalized) -> bool {
    number == Number::F32 || (number != Number::U32 && normalized == Normalized::Yes)
}

/// Columns of one primitive have a row for each vertex.
pub(super) fn same_length(index: usize, got: usize, vertices: usize) -> Result<(), GlbError> {
    if got == vertices {
        return Ok(());
    }
    let reason = format!("it has {got} rows, and its primitive {vertices} vertices: export the file again");
    Err(GlbError::Unsupported { what: "accessor", index, reason })
}

/// Light of an sRGB value (IEC 61966-2-1), both in [0, 1].
fn linear_light(value: f64) -> f64 {
    if value <= 0.040_45 { value / 12.92 } else { ops::pow((value + 0.055) / 1.055, 2.4) }
}
