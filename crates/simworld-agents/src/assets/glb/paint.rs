//! How primitives look: colours of vertices, the picture on them, and how they take light.

use std::collections::BTreeMap;

use simworld_core::asset::{
    FARTHEST_PLACE, Finish, MOST_PIXELS, ModelImage, ModelTexture, Pictures, Transparency, Wrap, light_of,
};
use simworld_core::ops;

use super::accessor::{Column, Data, Normalized, Number, get};
use super::document::{Material, Primitive, Sampler, TextureInfo, TextureTransform};
use super::error::GlbError;
use super::finish::{Body, Light, light, transparency};
use super::limits::GlbLimits;
use super::picture::{Undecoded, decode, wrap_of};
use crate::assets::surface::within;

/// Decodes pictures once, within a budget.
pub(super) struct Painter<'a> {
    data: Data<'a>,
    /// Those that are looked up here, by their number in the file.
    pictures: BTreeMap<usize, ModelImage>,
    /// Those that stay pictures, and which they are by their number in the file.
    images: Vec<ModelImage>,
    kept: BTreeMap<(usize, Role), u32>,
    pixels: u64,
    limit: u64,
    /// The longest side of a picture that stays one.
    side: u32,
}

/// How the vertices of a primitive look.
pub(super) struct Coat {
    /// Linear-light sRGB in [0, 1].
    pub(super) colors: Vec<[f32; 3]>,
    /// Where each lies on the pictures.
    pub(super) places: Vec<[f32; 2]>,
    /// How much is there of each, 0 to 1.
    pub(super) alphas: Vec<f32>,
    /// The picture on them.
    pub(super) texture: Option<ModelTexture>,
    /// What becomes of them where they are not all there.
    pub(super) transparency: Transparency,
    /// How it takes light.
    pub(super) finish: Finish,
    /// Place by place.
    pub(super) pictures: Pictures,
    /// Whether they are seen from both sides.
    pub(super) two_sided: bool,
    /// Whether the file says of what colour it is.
    pub(super) says: Says,
}

/// Whether a file says of what colour something is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Says {
    Color,
    Nothing,
}

/// What a picture is used for: as colours, as colours of which some are not there, or as numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Role {
    Color,
    Cut,
    Numbers,
}

/// Where the pictures that stay lie on a primitive, by vertex: all of them where the first of them does.
#[derive(Default)]
pub(super) struct Sheet(Option<Vec<[f64; 2]>>);

impl Sheet {
    /// Whether a picture lies there; the first one does.
    pub(super) fn takes(&mut self, laid: &Laid) -> bool {
        *self.0.get_or_insert_with(|| laid.places.clone()) == laid.places
    }

    /// The places on it of so many vertices.
    fn places(&self, vertices: usize) -> Vec<[f32; 2]> {
        let single = |place: &[f64; 2]| place.map(|part| part as f32);
        self.0.as_ref().map_or_else(|| vec![[0.0; 2]; vertices], |places| places.iter().map(single).collect())
    }
}

/// A picture as it lies on a primitive.
pub(super) struct Laid {
    /// By vertex.
    places: Vec<[f64; 2]>,
    wrap: [Wrap; 2],
    /// Its number in the file.
    image: usize,
}

impl<'a> Painter<'a> {
    pub(super) fn new(data: Data<'a>, limits: &GlbLimits) -> Self {
        Self {
            data,
            pictures: BTreeMap::new(),
            images: Vec::new(),
            kept: BTreeMap::new(),
            pixels: 0,
            limit: limits.pixels,
            side: limits.texture,
        }
    }

    /// The pictures that stay, halved where they are too many pixels together for a model.
    pub(super) fn into_images(mut self) -> Vec<ModelImage> {
        let area = |image: &ModelImage| u64::from(image.width) * u64::from(image.height);
        while self.images.iter().map(area).sum::<u64>() > MOST_PIXELS {
            // The first of the largest; there is one, for the sum is not zero.
            let Some(largest) = self.images.iter_mut().rev().max_by_key(|image| area(image)) else { break };
            *largest = largest.halved();
        }
        self.images
    }

    /// How so many vertices of a primitive with these triangles look.
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
        let pbr = material.pbr_metallic_roughness.as_ref();
        let factor = pbr.and_then(|pbr| pbr.base_color_factor).unwrap_or([1.0; 4]);
        let base = [factor[0], factor[1], factor[2]].map(|channel| channel.clamp(0.0, 1.0) as f32);
        let mut says = if base == [1.0; 3] { Says::Nothing } else { Says::Color };
        let transparency = transparency(material, primitive.material.unwrap_or(0))?;
        let (mut colors, mut alphas) = (vec![base; vertices], vec![1.0; vertices]);
        if transparency != Transparency::Opaque {
            alphas.fill(factor[3].clamp(0.0, 1.0) as f32);
        }
        if let Some(column) = self.own(primitive, vertices)? {
            says = Says::Color;
            let has_alpha = column.wide() == 4 && transparency != Transparency::Opaque;
            for (row, (color, alpha)) in colors.iter_mut().zip(&mut alphas).enumerate() {
                let own: [f64; 3] = column.reals(row);
                *color = std::array::from_fn(|which| color[which] * own[which].clamp(0.0, 1.0) as f32);
                if has_alpha {
                    *alpha *= column.real(row, 3).clamp(0.0, 1.0) as f32;
                }
            }
        }
        let (mut sheet, mut texture) = (Sheet::default(), None);
        if let Some(info) = pbr.and_then(|pbr| pbr.base_color_texture.as_ref()) {
            says = Says::Color;
            let laid = self.lay(info, primitive, vertices)?;
            if sheet.takes(&laid) && self.keeps() {
                let role = if transparency == Transparency::Opaque { Role::Color } else { Role::Cut };
                texture = Some(self.keep(&laid, role)?);
            } else {
                self.dye(&laid, triangles, &mut colors)?;
            }
        }
        let body = Body { primitive, vertices, triangles };
        let Light { finish, pictures } = light(self, material, body, &mut sheet)?;
        let places = if self.keeps() { sheet.places(vertices) } else { vec![[0.0; 2]; vertices] };
        let numbers = colors.iter().flatten().chain(&alphas);
        if numbers.into_iter().all(|number| number.is_finite()) {
            let two_sided = material.double_sided;
            Ok(Coat { colors, places, alphas, texture, transparency, finish, pictures, two_sided, says })
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

    /// Where a picture lies on a primitive.
    pub(super) fn lay(
        &self,
        info: &TextureInfo,
        primitive: &Primitive,
        vertices: usize,
    ) -> Result<Laid, GlbError> {
        let transform = info.extensions.transform.unwrap_or_default();
        let name = format!("TEXCOORD_{}", transform.tex_coord.unwrap_or(info.tex_coord));
        let Some(index) = primitive.attributes.get(&name) else {
            return Err(GlbError::Unsupported {
                what: "texture",
                index: info.index,
                reason: format!("its vertices have no {name}: export the file with texture coordinates"),
            });
        };
        let column = self.data.column(*index, &[("VEC2", 2)], |number, normalized| {
            is_share(number, normalized) || (number != Number::U32 && self.data.is_quantized())
        })?;
        same_length(*index, column.count, vertices)?;
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
        let places: Vec<[f64; 2]> = (0..vertices).map(|row| transform.of(column.reals::<2>(row))).collect();
        let is_near = |part: &f64| part.abs() <= f64::from(FARTHEST_PLACE);
        if places.iter().flatten().all(is_near) {
            Ok(Laid { places, wrap: [sampler.wrap_s, sampler.wrap_t].map(wrap_of), image })
        } else {
            Err(GlbError::Number { what: "accessor", index: *index })
        }
    }

    /// Multiplies in what a picture has at each vertex: the mean of what its triangles have there.
    fn dye(&mut self, laid: &Laid, triangles: &[[u32; 3]], colors: &mut [[f32; 3]]) -> Result<(), GlbError> {
        let mut sums = vec![([0.0f32; 3], 0u32); colors.len()];
        self.visit(laid, triangles, |vertex, pixel| {
            let (sum, count) = &mut sums[vertex as usize];
            *sum = std::array::from_fn(|which| sum[which] + light_of(pixel[which]));
            *count += 1;
        })?;
        for (color, (sum, count)) in colors.iter_mut().zip(sums).filter(|(_, (_, count))| *count > 0) {
            *color = std::array::from_fn(|which| color[which] * sum[which] / count as f32);
        }
        Ok(())
    }

    /// Visits the pixels at the corners of triangles, a little [within].
    fn visit(
        &mut self,
        laid: &Laid,
        triangles: &[[u32; 3]],
        mut visitor: impl FnMut(u32, [u8; 3]),
    ) -> Result<(), GlbError> {
        if !self.pictures.contains_key(&laid.image) {
            let image = self.decoded(laid.image)?;
            self.pictures.insert(laid.image, image);
        }
        let picture = &self.pictures[&laid.image];
        for triangle in triangles {
            let places = within(triangle.map(|vertex| laid.places[vertex as usize]));
            for (vertex, place) in triangle.iter().zip(places) {
                visitor(*vertex, picture.pixel_at(place, laid.wrap));
            }
        }
        Ok(())
    }

    /// Whether pictures stay pictures.
    pub(super) const fn keeps(&self) -> bool {
        self.side > 0
    }

    /// The mean of a picture at the corners of triangles.
    pub(super) fn mean(
        &mut self,
        laid: &Laid,
        triangles: &[[u32; 3]],
        part: impl Fn(u8) -> f64,
    ) -> Result<[f64; 3], GlbError> {
        let mut sum = [0.0; 3];
        self.visit(laid, triangles, |_, pixel| {
            sum = std::array::from_fn(|channel| sum[channel] + part(pixel[channel]));
        })?;
        // A primitive has a triangle.
        Ok(sum.map(|channel: f64| channel / (3 * triangles.len()) as f64))
    }

    /// Keeps a picture that lies on a primitive among those that stay.
    pub(super) fn keep(&mut self, laid: &Laid, role: Role) -> Result<ModelTexture, GlbError> {
        let image = self.number(laid.image, role)?;
        Ok(ModelTexture { image, wrap: laid.wrap })
    }

    /// The number of a picture among those that stay.
    fn number(&mut self, index: usize, role: Role) -> Result<u32, GlbError> {
        if let Some(number) = self.kept.get(&(index, role)) {
            return Ok(*number);
        }
        let mut image = self.decoded(index)?;
        // Before it is halved, which is by what it holds.
        image.content = role.content();
        if role != Role::Cut {
            image.alpha.clear();
        }
        while image.width.max(image.height) > self.side {
            image = image.halved();
        }
        let number = self.images.len() as u32;
        self.images.push(image);
        self.kept.insert((index, role), number);
        Ok(number)
    }

    fn decoded(&mut self, index: usize) -> Result<ModelImage, GlbError> {
        let image = get("image", &self.data.document.images, index)?;
        let Some(view) = image.buffer_view else {
            return Err(GlbError::Picture { index, reason: "the file does not hold it".to_owned() });
        };
        let left = self.limit - self.pixels;
        let picture = decode(self.data.view(view)?, left).map_err(|error| match error {
            Undecoded::Broken(reason) => GlbError::Picture { index, reason },
            Undecoded::Large(got) => {
                GlbError::TooMany { what: "pixels", got: got.saturating_add(self.pixels), most: self.limit }
            }
        })?;
        self.pixels += u64::from(picture.width) * u64::from(picture.height);
        Ok(picture)
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
