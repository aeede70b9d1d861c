//! Assets: the kinds of things that a world is built with, each with its collider, mass, colour and the words by which
//! people ask for it. Metres, kilograms, linear-light sRGB. An asset may bring a model of its own; the others are drawn by a
//! renderer as it draws their kind, and met as their collider. [`sculpt`] makes models from solids.

mod affordance;
mod called;
mod catalogue;
mod digest;
mod finish;
mod image;
mod library;
mod material;
mod model;
mod model_error;
mod rig;
mod row;
pub mod sculpt;
mod season;
mod standard;

use std::sync::Arc;

pub use affordance::{Affordance, AffordanceSet};
pub use catalogue::Catalogue;
pub use digest::{ContentId, ContentIdError};
pub use finish::{BRIGHTEST, Finish, MOST_CUTOFF, ModelTexture, Pictures, STEEPEST, Transparency, Wrap};
pub use image::{Content, LONGEST_IMAGE, MOST_PIXELS, ModelImage, light_of};
pub use material::Material;
pub use model::{FARTHEST_PLACE, Hull, LARGEST_MODEL, Model, ModelPart, ModelVertex, Paint};
pub use model_error::ModelError;
pub use rig::{
    Bone, Channel, Clip, ClipMoment, Curve, Interpolation, Joint, LONGEST_CLIP_NAME, Local, MIX_SECONDS,
    MOMENT_RATE, MOST_WORK, POSE_RATE, Path, PosedModel, Rig, RigDesc, RigError, RigPose, SkinVertex,
};
pub use season::{Season, Seasons};
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::geometry::{Pose, Vector2};
use crate::id::AssetId;
use crate::scene::{EntityDesc, EntityKind, Place, Shape, ShapeError};

/// Why a catalogue refuses an asset.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum AssetError {
    /// The name is no name.
    #[error("{name:?} is no name of an asset: give lower-case letters, digits and underscores")]
    Name {
        /// What was given.
        name: String,
    },
    /// Another asset has the name.
    #[error("there is an asset {name:?} already, and it is another one: give this one another name")]
    Taken {
        /// The name.
        name: String,
    },
    /// The collider is no solid.
    #[error("the collider of asset {name:?}: {error}")]
    Collider {
        /// Of which asset.
        name: String,
        /// What is wrong with it.
        error: ShapeError,
    },
    /// The mass is none.
    #[error(
        "asset {name:?} has a mass of {mass} kg: give 1e-3 to 1e9 kg, or none if it is fixed to the ground"
    )]
    Mass {
        /// Of which asset.
        name: String,
        /// kg.
        mass: f64,
    },
    /// The model is none, or does not fit.
    #[error("the model of asset {name:?}: {error}")]
    Model {
        /// Of which asset.
        name: String,
        /// What is wrong with it.
        error: Box<ModelError>,
    },
    /// The colour is none.
    #[error("asset {name:?} has colour {color:?}: give three numbers from 0 to 1")]
    Color {
        /// Of which asset.
        name: String,
        /// Linear-light sRGB.
        color: [f32; 3],
    },
}

/// A kind of thing that a world is built with.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Asset {
    /// Its name: lower-case letters, digits and underscores; no two in a catalogue share one.
    pub name: String,
    /// What it is.
    pub kind: EntityKind,
    /// What it is used for.
    #[serde(default)]
    pub place: Option<Place>,
    /// Its solid, standing on its origin.
    pub collider: Shape,
    /// Mass, kg; none of what is fixed to the ground.
    #[serde(default)]
    pub mass: Option<f64>,
    /// What its surface is made of, as far as one is known.
    #[serde(default)]
    pub material: Option<Material>,
    /// Surface colour, linear-light sRGB primaries in [0, 1].
    #[serde(default)]
    pub color: Option<[f32; 3]>,
    /// Its colours through the year, if it has any.
    #[serde(default)]
    pub seasons: Option<Seasons>,
    /// What one can do with it; none where [its kind](AffordanceSet::of_kind) says.
    #[serde(default)]
    pub affordances: Option<AffordanceSet>,
    /// Words by which people ask for it, beside those of its name, kind and use.
    #[serde(default)]
    pub tags: Vec<String>,
    /// Where it comes from: a generator, a file, a prompt.
    #[serde(default)]
    pub source: String,
    /// Under which licence, as an SPDX expression; empty where none is known.
    #[serde(default)]
    pub licence: String,
    /// What it looks like and is met as, finer than its collider, in whose box it stands.
    #[serde(default)]
    pub model: Option<Arc<Model>>,
}

impl Asset {
    /// An asset with a name, a kind and a collider, and nothing else yet.
    pub fn new(name: impl Into<String>, kind: EntityKind, collider: Shape) -> Self {
        Self {
            name: name.into(),
            kind,
            place: None,
            collider,
            mass: None,
            material: None,
            color: None,
            seasons: None,
            affordances: None,
            tags: Vec::new(),
            source: String::new(),
            licence: String::new(),
            model: None,
        }
    }

    /// With words by which people ask for it.
    #[must_use]
    pub fn tagged<W: Into<String>>(mut self, words: impl IntoIterator<Item = W>) -> Self {
        self.tags.extend(words.into_iter().map(Into::into));
        self
    }

    /// Length and width of the rectangle on which it stands, m.
    pub fn footprint(&self) -> Vector2 {
        self.collider.size().xy()
    }

    /// What one can do with it: what it says itself, or its kind.
    pub fn affordances(&self) -> AffordanceSet {
        self.affordances.unwrap_or(AffordanceSet::of_kind(self.kind))
    }

    /// Its colour in a season, or else the one that it always has.
    pub fn color_in(&self, season: Season) -> Option<[f32; 3]> {
        self.seasons.map(|seasons| seasons.color(season)).or(self.color)
    }

    /// The recipe of an entity made from this asset, which has that id in the catalogue of the world.
    pub fn at(&self, id: AssetId, pose: Pose) -> EntityDesc {
        let mut desc = EntityDesc::new(self.kind, pose, self.collider);
        let info = &mut desc.info;
        (info.asset, info.place, info.color, info.mass) = (Some(id), self.place, self.color, self.mass);
        desc
    }

    /// Checks that the asset can be in a catalogue.
    ///
    /// # Errors
    /// A name, collider, mass, colour or model that is none.
    pub fn validate(&self) -> Result<(), AssetError> {
        let name = self.name.clone();
        let is_letter = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
        if name.is_empty() || name.len() > 64 || !name.chars().all(is_letter) {
            return Err(AssetError::Name { name });
        }
        if let Err(error) = self.collider.validate() {
            return Err(AssetError::Collider { name, error });
        }
        if let Some(mass) = self.mass.filter(|mass| !(1e-3..=1e9).contains(mass)) {
            return Err(AssetError::Mass { name, mass });
        }
        if let Some(Err(error)) = self.model.as_ref().map(|model| model.validate(self.collider.size())) {
            return Err(AssetError::Model { name, error: Box::new(error) });
        }
        let is_color = |color: &[f32; 3]| color.iter().all(|channel| (0.0..=1.0).contains(channel));
        let of_seasons = self.seasons.map(|seasons| Season::ALL.map(|season| seasons.color(season)));
        let mut colors = self.color.into_iter().chain(of_seasons.into_iter().flatten());
        match colors.find(|color| !is_color(color)) {
            Some(color) => Err(AssetError::Color { name, color }),
            None => Ok(()),
        }
    }

    /// How many of some words it answers to: words of its name, its kind, its use, its material and its tags.
    pub fn answers<W: AsRef<str>>(&self, words: &[W]) -> usize {
        let is_called = |word: &str| {
            let own = [self.name.as_str(), self.kind.as_str(), self.place.map_or("", Place::as_str)];
            let made_of = self.material.map_or("", Material::as_str);
            let wooden = if self.material == Some(Material::Wood) { "wooden" } else { "" };
            own.into_iter().chain([made_of, wooden]).chain(self.tags.iter().map(String::as_str)).any(|name| {
                name.eq_ignore_ascii_case(word)
                    || name.split(['_', ' ']).any(|part| part.eq_ignore_ascii_case(word))
            })
        };
        words.iter().filter(|word| is_called(word.as_ref())).count()
    }
}
