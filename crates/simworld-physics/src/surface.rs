//! How surfaces hold tyres and what slides, and how weather changes it.
//!
//! Two figures describe a surface: the friction coefficient of a solid that slides on it, and the grip it gives to
//! rubber tyres as a share of what clean dry asphalt gives. The bands of road friction are those of accident
//! reconstruction (dry 0.70 to 0.85, wet 0.45 to 0.65, packed snow 0.20 to 0.35, ice 0.05 to 0.15: Noon, Engineering
//! Analysis of Vehicular Accidents, 1994; Bosch Automotive Handbook).

use serde::{Deserialize, Serialize};
use simworld_core::asset::Material;
use simworld_core::environment::Weather;
use simworld_core::geometry::Vector3;

/// Grip of a material on a rubber tyre, dry, as a share of that of asphalt.
const fn grip(material: Material) -> f64 {
    match material {
        Material::Asphalt | Material::Rubber => 1.0,
        Material::Concrete => 0.95,
        Material::Brick => 0.9,
        Material::Cobblestone | Material::Stone => 0.75,
        Material::Wood => 0.7,
        Material::Gravel | Material::Soil | Material::Fabric => 0.6,
        Material::Metal => 0.55,
        Material::Glass | Material::Foliage => 0.4,
        Material::Ice | Material::Water => 0.1,
        // Grass, sand, smooth plastic, and what a road is not made of.
        _ => 0.5,
    }
}

/// What weather has laid on the surfaces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RoadCondition {
    /// Nothing.
    #[default]
    Dry,
    /// A film of water.
    Wet,
    /// Packed snow.
    Snow,
    /// Ice.
    Ice,
}

impl RoadCondition {
    /// Every condition, from the best grip to the least.
    pub const ALL: &'static [Self] = &[Self::Dry, Self::Wet, Self::Snow, Self::Ice];

    /// What lies by core's [`Weather::cover`]: snow before water, and water below 0 °C is ice.
    pub fn of(weather: &Weather) -> Self {
        const FILM: f64 = 0.05; // a share of wetness: less is no film
        let cover = weather.cover();
        if cover.snow_depth > 0.0 {
            Self::Snow
        } else if cover.wetness < FILM {
            Self::Dry
        } else if weather.temperature < 0.0 {
            Self::Ice
        } else {
            Self::Wet
        }
    }

    /// The grip of a material as a share of that of dry asphalt: for the good tyres of the braking tests, which stop
    /// from 100 km/h in 36 m on a dry road and in 48 m on a wet one (Continental, CAR South Africa 2018-10).
    pub fn grip(self, material: Material) -> f64 {
        let (dry, wet) = (grip(material), grip(material) * 0.75);
        match self {
            Self::Dry => dry,
            Self::Wet => wet,
            Self::Snow => wet.min(0.28),
            Self::Ice => wet.min(0.1),
        }
    }

    /// The coefficient of sliding friction of a material.
    pub fn friction(self, material: Material) -> f64 {
        let (dry, wet) = (material.friction(), material.friction() * 0.75);
        match self {
            Self::Dry => dry,
            Self::Wet => wet,
            Self::Snow => wet.min(0.28),
            Self::Ice => wet.min(0.08),
        }
    }
}

/// What the air and the roads are like in a step.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Conditions {
    /// What lies on surfaces.
    pub road: RoadCondition,
    /// Velocity of the air, world frame, m/s.
    pub wind: Vector3,
}

impl Default for Conditions {
    /// Dry and calm.
    fn default() -> Self {
        Self { road: RoadCondition::Dry, wind: Vector3::zeros() }
    }
}

impl Conditions {
    /// Those of a weather.
    pub fn of(weather: &Weather) -> Self {
        Self { road: RoadCondition::of(weather), wind: Vector3::new(weather.wind.x, weather.wind.y, 0.0) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weather_lies_on_the_road() {
        let condition = |rain, snow, temperature| {
            RoadCondition::of(&Weather { rain, snow, temperature, ..Weather::default() })
        };
        assert_eq!(condition(0.0, 0.0, -10.0), RoadCondition::Dry);
        assert_eq!(condition(2.0, 0.0, 10.0), RoadCondition::Wet);
        assert_eq!(condition(2.0, 0.0, -3.0), RoadCondition::Ice);
        assert_eq!(condition(0.0, 1.0, -3.0), RoadCondition::Snow);
        assert_eq!(condition(0.0, 1.0, 8.0), RoadCondition::Wet);
    }

    #[test]
    fn worse_conditions_never_grip_better() {
        for material in Material::ALL {
            for pair in RoadCondition::ALL.windows(2) {
                assert!(pair[0].grip(*material) >= pair[1].grip(*material), "{material:?}: {pair:?}");
                assert!(pair[0].friction(*material) >= pair[1].friction(*material), "{material:?}: {pair:?}");
            }
        }
    }
}
