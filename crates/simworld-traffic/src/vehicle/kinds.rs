//! The types of vehicles.

use serde::{Deserialize, Serialize};
use simworld_core::scene::{EntityKind, Shape};
use simworld_core::seed::StreamRng;

use crate::TrafficConfig;

/// A type of vehicle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum VehicleKind {
    /// A passenger car.
    #[default]
    Car,
    /// A delivery van.
    Van,
    /// A city bus.
    Bus,
}

impl VehicleKind {
    /// Draws a type by the shares of a configuration.
    pub(crate) fn draw(config: &TrafficConfig, rng: &mut StreamRng) -> Self {
        match rng.unit() {
            draw if draw < config.buses => Self::Bus,
            draw if draw < config.buses + config.vans => Self::Van,
            _ => Self::Car,
        }
    }

    /// Length, m.
    #[inline]
    pub const fn length(self) -> f64 {
        match self {
            Self::Car => 4.5,
            Self::Van => 5.8,
            Self::Bus => 11.5,
        }
    }

    /// Whether its ends swing out of its lane in a turn.
    #[inline]
    pub const fn is_long(self) -> bool {
        matches!(self, Self::Bus)
    }

    /// Its solid.
    pub fn shape(self) -> Shape {
        match self {
            Self::Car => Shape::cuboid(self.length(), 1.8, 1.5),
            Self::Van => Shape::cuboid(self.length(), 2.0, 2.4),
            Self::Bus => Shape::cuboid(self.length(), 2.5, 3.0),
        }
    }

    /// What it is in a scene.
    pub const fn entity_kind(self) -> EntityKind {
        match self {
            Self::Car => EntityKind::Car,
            Self::Van => EntityKind::Truck,
            Self::Bus => EntityKind::Bus,
        }
    }
}
