//! How a material takes light: factors, with pictures of them, or their means over a primitive where they lie otherwise than that of its colour.

use simworld_core::asset::{
    BRIGHTEST, Content, Finish, MOST_CUTOFF, Pictures, STEEPEST, Transparency, light_of,
};

use super::document::{Material, Primitive, TextureInfo};
use super::error::GlbError;
use super::paint::{Painter, Role, Sheet};

/// How a primitive takes light.
pub(super) struct Light {
    pub(super) finish: Finish,
    pub(super) pictures: Pictures,
}

/// A primitive of so many vertices with these triangles.
#[derive(Clone, Copy)]
pub(super) struct Body<'a> {
    pub(super) primitive: &'a Primitive,
    pub(super) vertices: usize,
    pub(super) triangles: &'a [[u32; 3]],
}

/// How a primitive takes light; `sheet` is where its pictures lie. What a file does not say is as glTF 2.0 has it; a material
/// that says nothing of metal and roughness, and one that is not to be lit, is dull. Pictures of shade and bumps that lie otherwise than others are
/// passed over.
pub(super) fn light(
    painter: &mut Painter<'_>,
    material: &Material,
    body: Body<'_>,
    sheet: &mut Sheet,
) -> Result<Light, GlbError> {
    let mut light = Light { finish: Finish::default(), pictures: Pictures::default() };
    let is_lit = material.extensions.unlit.is_none();
    if is_lit {
        metal(painter, material, body, sheet, &mut light)?;
    }
    shine(painter, material, body, sheet, &mut light)?;
    if let Some(info) = material.occlusion_texture.as_ref().filter(|_| is_lit) {
        light.pictures.shade = painter.place(info, body, sheet, Role::Numbers)?.ok();
        light.pictures.shade_strength = info.strength.unwrap_or(1.0).clamp(0.0, 1.0) as f32;
    }
    if let Some(info) = material.normal_texture.as_ref().filter(|_| is_lit) {
        let steepest = f64::from(STEEPEST);
        light.pictures.bumps = painter.place(info, body, sheet, Role::Numbers)?.ok();
        light.pictures.bump_scale = info.scale.unwrap_or(1.0).clamp(-steepest, steepest) as f32;
    }
    Ok(light)
}

fn metal(
    painter: &mut Painter<'_>,
    material: &Material,
    body: Body<'_>,
    sheet: &mut Sheet,
    light: &mut Light,
) -> Result<(), GlbError> {
    let Some(pbr) = &material.pbr_metallic_roughness else { return Ok(()) };
    let factor = |given: Option<f64>| given.unwrap_or(1.0).clamp(0.0, 1.0);
    let (mut metallic, mut roughness) = (factor(pbr.metallic_factor), factor(pbr.roughness_factor));
    if let Some(info) = &pbr.metallic_roughness_texture {
        match painter.place(info, body, sheet, Role::Numbers)? {
            Ok(texture) => light.pictures.metal = Some(texture),
            Err(laid) => {
                let share = |value: u8| f64::from(value) / 255.0;
                let [_, green, blue] = painter.mean(&laid, body.triangles, share)?;
                (metallic, roughness) = (metallic * blue, roughness * green);
            }
        }
    }
    (light.finish.metallic, light.finish.roughness) = (metallic as f32, roughness as f32);
    Ok(())
}

fn shine(
    painter: &mut Painter<'_>,
    material: &Material,
    body: Body<'_>,
    sheet: &mut Sheet,
    light: &mut Light,
) -> Result<(), GlbError> {
    let factor = material.emissive_factor.unwrap_or_default().map(|channel| channel.clamp(0.0, 1.0));
    if factor == [0.0; 3] {
        return Ok(());
    }
    let strength = material.extensions.strength.as_ref().map_or(1.0, |one| one.emissive_strength);
    let mut own = factor.map(|channel| channel * strength);
    if let Some(info) = &material.emissive_texture {
        match painter.place(info, body, sheet, Role::Color)? {
            Ok(texture) => light.pictures.emission = Some(texture),
            Err(laid) => {
                let shown = painter.mean(&laid, body.triangles, |value| f64::from(light_of(value)))?;
                own = std::array::from_fn(|channel| own[channel] * shown[channel]);
            }
        }
    }
    light.finish.emission = own.map(|channel| channel.clamp(0.0, f64::from(BRIGHTEST)) as f32);
    Ok(())
}

/// What becomes of a material, which is that one of the file, where its alpha is below 1.
pub(super) fn transparency(material: &Material, index: usize) -> Result<Transparency, GlbError> {
    let refused = |reason: String| GlbError::Unsupported { what: "material", index, reason };
    let cutoff = material.alpha_cutoff.unwrap_or(0.5);
    if cutoff.is_nan() || cutoff < 0.0 {
        return Err(refused(format!("its alphaCutoff is {cutoff}: give 0 or more")));
    }
    match material.alpha_mode.as_deref() {
        None | Some("OPAQUE") => Ok(Transparency::Opaque),
        // Above 1 all of it is gone, however far above.
        Some("MASK") => Ok(Transparency::Cutout { cutoff: cutoff.min(f64::from(MOST_CUTOFF)) as f32 }),
        Some("BLEND") => Ok(Transparency::Blend),
        Some(other) => {
            let shown: String = other.chars().take(20).collect();
            Err(refused(format!("its alphaMode is {shown:?}: give OPAQUE, MASK or BLEND")))
        }
    }
}

impl Role {
    /// What a picture holds that is used so.
    pub(super) const fn content(self) -> Content {
        match self {
            Self::Color | Self::Cut => Content::Color,
            Self::Numbers => Content::Numbers,
        }
    }
}

impl Painter<'_> {
    /// Keeps a picture, if it lies where others do that are kept on a primitive; else how it lies.
    fn place(
        &mut self,
        info: &TextureInfo,
        body: Body<'_>,
        sheet: &mut Sheet,
        role: Role,
    ) -> Result<Result<simworld_core::asset::ModelTexture, super::paint::Laid>, GlbError> {
        let laid = self.lay(info, body.primitive, body.vertices)?;
        if !self.keeps() || !sheet.takes(&laid) {
            return Ok(Err(laid));
        }
        Ok(Ok(self.keep(&laid, role)?))
    }
}
