//! What somebody who looks on has chosen: where from, after whom, and what a picture shows.

use std::collections::BTreeSet;

use simworld_core::id::EntityId;

use super::{Flight, Layer, Panes};

/// What is looked at, and how.
#[derive(Clone, Debug, PartialEq)]
pub struct Outlook {
    /// Where from.
    pub flight: Flight,
    /// Whom the camera follows; it flies freely otherwise.
    pub follow: Option<EntityId>,
    /// Who was asked about.
    pub picked: Option<EntityId>,
    /// What a picture shows.
    pub panes: Panes,
    /// The layers that are drawn.
    pub layers: BTreeSet<Layer>,
    /// Whether all that is known of who was asked about stands on the picture, or a line of it.
    pub card: bool,
    /// Whether the keys stand on the picture.
    pub help: bool,
}

impl Outlook {
    /// From there, freely, in colour alone.
    pub fn from(flight: Flight) -> Self {
        Self {
            flight,
            follow: None,
            picked: None,
            panes: Panes::default(),
            layers: BTreeSet::new(),
            card: false,
            help: false,
        }
    }

    /// Draws a layer that was not drawn, and no longer one that was.
    pub fn toggle(&mut self, layer: Layer) {
        if !self.layers.remove(&layer) {
            self.layers.insert(layer);
        }
    }
}
