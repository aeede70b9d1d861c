//! Roofs.

use serde::{Deserialize, Serialize};

/// The form of a roof.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RoofKind {
    /// Level, behind a low parapet.
    #[default]
    Flat,
    /// Two slopes from a ridge along the longer side.
    Gable,
    /// Four slopes.
    Hip,
    /// One slope.
    Shed,
}

impl RoofKind {
    /// The name in files: the values of `roof:shape` in OpenStreetMap, but for the shed, which is `skillion` there.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Flat => "flat",
            Self::Gable => "gable",
            Self::Hip => "hip",
            Self::Shed => "shed",
        }
    }

    /// Height of the ridge above the eaves over a rectangle of that width and depth, m: slopes of 35°, a shed of 10°.
    pub fn rise(self, width: f64, depth: f64) -> f64 {
        let span = width.min(depth);
        match self {
            Self::Flat => 0.0,
            // tan 35° = 0.700, over half the span
            Self::Gable | Self::Hip => 0.35 * span,
            // tan 10° = 0.176
            Self::Shed => 0.176 * span,
        }
    }
}
