//! How the surface of a model's part takes light, and the picture that lies on it.

use serde::{Deserialize, Serialize};

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
