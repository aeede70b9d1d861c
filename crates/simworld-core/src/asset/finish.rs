//! How the surface of a model's part takes light, and the pictures that lie on it.

use serde::{Deserialize, Serialize};

use super::image::Content;
use super::material::Material;

/// The brightest light that a part may have of its own, in each channel of [`Finish::emission`].
pub const BRIGHTEST: f32 = 1000.0;

/// How a surface takes light: the metal-rough material of glTF 2.0 (3.9), but for its colour.
///
/// ```
/// use simworld_core::asset::Finish;
/// let chrome = Finish { metallic: 1.0, roughness: 0.1, ..Finish::default() };
/// assert!(Finish::default().metallic == 0.0 && chrome.emission == [0.0; 3]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Finish {
    /// How far it is metal, 0 to 1: metals mirror in their colour and scatter nothing.
    pub metallic: f32,
    /// Perceptual roughness, 0 (a mirror) to 1: its square is the slope of the facets in the distribution GGX.
    pub roughness: f32,
    /// Light of its own, linear-light sRGB primaries from 0 to [`BRIGHTEST`]. 1 is as bright as the glass of a lit lamp.
    pub emission: [f32; 3],
}

/// How much the channels of a grey may differ, and how many times as light or dark as bare metal it may be to be taken for that.
const GREY: f32 = 0.06;
const LIKE: f32 = 1.3;
/// Perceptual roughness of paint on metal, as renderers set it; not measured.
const PAINT: f32 = 0.5;

impl Finish {
    /// How a surface of a material in a colour (linear-light sRGB) takes light: as rough as the [material](Material::roughness) is, and as metal
    /// where the colour is that of bare metal, a grey about as light as its [reflectance](Material::reflectance). Metal of another colour is
    /// painted.
    ///
    /// ```
    /// use simworld_core::asset::{Finish, Material};
    /// let [steel, red] = [[0.55, 0.56, 0.58], [0.5, 0.04, 0.03]].map(|color| Finish::of(Material::Metal, color));
    /// assert!(steel.metallic == 1.0 && red.metallic == 0.0 && steel.roughness < red.roughness);
    /// assert!(Finish::of(Material::Glass, [0.3; 3]).roughness < Finish::of(Material::Brick, [0.3; 3]).roughness);
    /// ```
    pub fn of(material: Material, color: [f32; 3]) -> Self {
        let roughness = material.roughness() as f32;
        if material != Material::Metal {
            return Self { roughness, ..Self::default() };
        }
        let [low, high] = color
            .iter()
            .fold([f32::MAX, 0.0], |[low, high], channel| [low.min(*channel), high.max(*channel)]);
        let lightness = (low + high) * 0.5 / material.reflectance() as f32;
        if high - low <= GREY && (1.0 / LIKE..=LIKE).contains(&lightness) {
            Self { metallic: 1.0, roughness, ..Self::default() }
        } else {
            Self { roughness: PAINT, ..Self::default() }
        }
    }
}

impl Default for Finish {
    /// Dull, like wood, paint and stone.
    fn default() -> Self {
        Self { metallic: 0.0, roughness: 0.85, emission: [0.0; 3] }
    }
}

/// A picture on a part, by which the colours of its vertices are multiplied.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ModelTexture {
    /// Which of the model's [images](super::Model::images).
    pub image: u32,
    /// What lies beyond its sides, and beyond its top and bottom.
    pub wrap: [Wrap; 2],
}

/// The pictures on a part beside that of its colour, which say place by place how it takes light. All of them lie as that one does. Those of
/// metal, shade and bumps hold [numbers](super::Content::Numbers).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Pictures {
    /// Green is a factor of [`Finish::roughness`], blue one of [`Finish::metallic`].
    pub metal: Option<ModelTexture>,
    /// A factor of [`Finish::emission`].
    pub emission: Option<ModelTexture>,
    /// Red is the share of the sky's light that comes there.
    pub shade: Option<ModelTexture>,
    /// How far the picture of shade counts, 0 (not at all) to 1.
    pub shade_strength: f32,
    /// Normals in the frame of the picture: red is to its right, green to its top, blue out of the surface, each from -1 to 1.
    pub bumps: Option<ModelTexture>,
    /// What the first two of a normal are multiplied by, at most [`STEEPEST`] either way.
    pub bump_scale: f32,
}

impl Default for Pictures {
    fn default() -> Self {
        Self { metal: None, emission: None, shade: None, shade_strength: 1.0, bumps: None, bump_scale: 1.0 }
    }
}

impl Pictures {
    /// Those that are there, with what each has to hold.
    pub fn all(&self) -> impl Iterator<Item = (ModelTexture, Content)> {
        let kinds = [Content::Numbers, Content::Color, Content::Numbers, Content::Numbers];
        let textures = [self.metal, self.emission, self.shade, self.bumps];
        textures.into_iter().zip(kinds).filter_map(|(texture, kind)| Some((texture?, kind)))
    }

    /// Whether its factors are within their ranges.
    pub(super) fn is_sound(&self) -> bool {
        (0.0..=1.0).contains(&self.shade_strength) && (-STEEPEST..=STEEPEST).contains(&self.bump_scale)
    }
}

/// The most by which bumps may be made steeper.
pub const STEEPEST: f32 = 100.0;

/// Above this nothing may stand in [`Transparency::Cutout`]; above 1 nothing of a part is there.
pub const MOST_CUTOFF: f32 = 2.0;

/// What becomes of a part where its alpha is below 1: that of its vertices times that of its picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Transparency {
    /// Nothing: alpha is passed over.
    #[default]
    Opaque,
    /// Where it is below the cutoff there is nothing: nothing is seen, and light goes through.
    Cutout {
        /// 0 to [`MOST_CUTOFF`].
        cutoff: f32,
    },
    /// As much is seen of what is behind as is lacking to 1. It has depth, is who is met and throws shadows where it is a half or more.
    Blend,
}

/// What lies beyond the edge of a picture.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Wrap {
    /// The picture again.
    #[default]
    Repeat,
    /// The picture again, mirrored each time.
    Mirror,
    /// The colour of its edge.
    Clamp,
}
