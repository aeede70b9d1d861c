//! The rows of a scene file: things, streets and sentences.

use serde::{Deserialize, Serialize};

use super::aside::Aside;
use super::colour::Colour;
use super::facing::Facing;
use super::numbers::{At, Pair};

/// A thing, or a row of alike things: `[[thing]]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Thing {
    /// The name of an asset of the library, exactly.
    pub asset: String,
    /// What people call it, and other rows of the file; of several it is followed by their number, from 1: `lamp 1`, `lamp 2`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Where the middle of its bottom is; without it the middle of the top of what it stands on.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at: Option<At>,
    /// Which way its front looks; east without it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub facing: Option<Facing>,
    /// The name of the thing of this file on whose top it stands; the ground without it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub on: Option<String>,
    /// Another colour than the asset's.
    #[serde(default, alias = "color", skip_serializing_if = "Option::is_none")]
    pub colour: Option<Colour>,
    /// Its size over the asset's, 0.05 to 20; 1 without it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub scale: Option<f64>,
    /// How many there are, 1 to 1000; 1 without it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub count: Option<u32>,
    /// From each of several to the next, m; within ±1000.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub step: Option<Pair>,
    /// The line on which it was read, from 1.
    #[serde(skip)]
    pub line: Aside<Option<usize>>,
}

impl Thing {
    /// A thing as the asset is, at a point, looking east.
    pub fn new(asset: impl Into<String>, at: At) -> Self {
        Self { at: Some(at), ..Self::nowhere(asset.into()) }
    }

    /// A thing as the asset is, in the middle of the top of another, looking east.
    pub fn on(asset: impl Into<String>, support: impl Into<String>) -> Self {
        Self { on: Some(support.into()), ..Self::nowhere(asset.into()) }
    }

    fn nowhere(asset: String) -> Self {
        Self {
            asset,
            name: None,
            at: None,
            facing: None,
            on: None,
            colour: None,
            scale: None,
            count: None,
            step: None,
            line: Aside(None),
        }
    }

    /// How many it is.
    pub(super) fn many(&self) -> u32 {
        self.count.unwrap_or(1)
    }
}

/// A street: `[[street]]`. It meets others where they have a point in common.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StreetRow {
    /// What people call it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Its middle from end to end, at least two points a metre and more apart, m.
    pub points: Vec<Pair>,
    /// Lanes each way, 1 to 4; 1 without it. With more than one it is an arterial.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lanes: Option<u32>,
    /// Width of the sidewalks on both sides, 1 to 20 m, or 0 for none; 3 m without it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sidewalk: Option<f64>,
    /// The line on which it was read, from 1.
    #[serde(skip)]
    pub line: Aside<Option<usize>>,
}

impl StreetRow {
    /// A street of one lane each way.
    pub fn new(points: impl IntoIterator<Item = Pair>) -> Self {
        let points = points.into_iter().collect();
        Self { name: None, points, lanes: None, sidewalk: None, line: Aside(None) }
    }
}

/// A sentence that is carried out when all rows stand, in the order of the file: `[[say]]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Say {
    /// What is said, as to the editor of scenes.
    pub words: String,
    /// From where the scene is looked at from here on, m: what "here" and "the nearest" mean. The origin at first.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub from: Option<Pair>,
    /// The line on which it was read, from 1.
    #[serde(skip)]
    pub line: Aside<Option<usize>>,
}

impl Say {
    /// A sentence.
    pub fn new(words: impl Into<String>) -> Self {
        Self { words: words.into(), from: None, line: Aside(None) }
    }
}

/// Empty ground, level at height 0, with its middle at the origin: `[ground]`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct EmptyGround {
    /// From west to east and from south to north, 1 to 20 000 m each; 100 by 100 m without it.
    pub size: Pair,
    /// Its colour; as a renderer draws ground without it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub colour: Option<Colour>,
}

impl Default for EmptyGround {
    fn default() -> Self {
        Self { size: Pair::new(100.0, 100.0), colour: None }
    }
}
