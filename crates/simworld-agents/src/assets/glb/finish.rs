//! How a material takes light: factors, times the mean of their pictures over a primitive.

use simworld_core::asset::{BRIGHTEST, Finish, light_of};

use super::document::{Material, Primitive, TextureInfo};
use super::error::GlbError;
use super::paint::Painter;

/// How a primitive of so many vertices with these triangles takes light. What a file does not say is as glTF 2.0 has it; a material
/// that says nothing of metal and roughness, and one that is not to be lit, is dull.
pub(super) fn finish_of(
    painter: &mut Painter<'_>,
    material: &Material,
    primitive: &Primitive,
    vertices: usize,
    triangles: &[[u32; 3]],
) -> Result<Finish, GlbError> {
    let mut finish = Finish::default();
    if let Some(pbr) =
        material.pbr_metallic_roughness.as_ref().filter(|_| material.extensions.unlit.is_none())
    {
        let factor = |given: Option<f64>| given.unwrap_or(1.0).clamp(0.0, 1.0);
        let (mut metallic, mut roughness) = (factor(pbr.metallic_factor), factor(pbr.roughness_factor));
        if let Some(info) = &pbr.metallic_roughness_texture {
            let share = |value: u8| f64::from(value) / 255.0;
            let [_, green, blue] = mean(painter, info, primitive, vertices, triangles, share)?;
            (metallic, roughness) = (metallic * blue, roughness * green);
        }
        (finish.metallic, finish.roughness) = (metallic as f32, roughness as f32);
    }
    let factor = material.emissive_factor.unwrap_or_default().map(|channel| channel.clamp(0.0, 1.0));
    if factor != [0.0; 3] {
        let strength = material.extensions.strength.as_ref().map_or(1.0, |one| one.emissive_strength);
        let mut light = factor.map(|channel| channel * strength);
        if let Some(info) = &material.emissive_texture {
            let shown =
                mean(painter, info, primitive, vertices, triangles, |value| f64::from(light_of(value)))?;
            light = std::array::from_fn(|channel| light[channel] * shown[channel]);
        }
        finish.emission = light.map(|channel| channel.clamp(0.0, f64::from(BRIGHTEST)) as f32);
    }
    Ok(finish)
}

/// The mean of a picture at the corners of triangles.
fn mean(
    painter: &mut Painter<'_>,
    info: &TextureInfo,
    primitive: &Primitive,
    vertices: usize,
    triangles: &[[u32; 3]],
    part: impl Fn(u8) -> f64,
) -> Result<[f64; 3], GlbError> {
    let laid = painter.lay(info, primitive, vertices)?;
    let mut sum = [0.0; 3];
    painter.visit(&laid, triangles, |_, pixel| {
        sum = std::array::from_fn(|channel| sum[channel] + part(pixel[channel]));
    })?;
    // A primitive has a triangle.
    Ok(sum.map(|channel: f64| channel / (3 * triangles.len()) as f64))
}
