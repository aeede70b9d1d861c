//! Classes of road vehicles and their data.
//!
//! Dimensions, masses, engines and gears are rounded from data sheets of the models named beside each class; the
//! mean European car is that of the ICCT pocketbook (2016). Springs follow from the frequency of the ride (cars 1.3
//! Hz, trucks 1.6 Hz: Gillespie 1992, chapter 5), anti-roll bars from a roll of 4 to 6° at 1 g, radii of gyration
//! from shares of width and length that are usual for the class.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::cars::{sedan, small_car, suv, van};
use super::heavy::{bus, scooter, truck};
use super::parameters::VehicleParameters;

/// A class of road vehicles.
///
/// ```
/// use simworld_physics::VehicleClass;
/// let bus = VehicleClass::Bus.parameters();
/// assert!(bus.validate().is_ok() && bus.chassis.mass > 10_000.0);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum VehicleClass {
    /// A city car such as the Volkswagen up.
    SmallCar,
    /// The mean new car of the European Union: 1392 kg and 95 kW.
    #[default]
    Sedan,
    /// A sport utility vehicle such as the Volkswagen Tiguan, all wheels driven.
    Suv,
    /// A delivery van such as the Mercedes Sprinter, half laden.
    Van,
    /// A rigid truck of 12 t such as the MAN TGL, laden.
    Truck,
    /// A city bus of 12 m such as the Mercedes Citaro, half full.
    Bus,
    /// An electric kick scooter and its rider, such as the Ninebot G30; 25 km/h.
    Scooter,
}

impl VehicleClass {
    /// Every class, in the order of declaration.
    pub const ALL: &'static [Self] =
        &[Self::SmallCar, Self::Sedan, Self::Suv, Self::Van, Self::Truck, Self::Bus, Self::Scooter];

    /// The name in files.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::SmallCar => "small_car",
            Self::Sedan => "sedan",
            Self::Suv => "suv",
            Self::Van => "van",
            Self::Truck => "truck",
            Self::Bus => "bus",
            Self::Scooter => "scooter",
        }
    }

    /// The class of that name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|class| class.as_str() == name)
    }

    /// Its data.
    pub fn parameters(self) -> VehicleParameters {
        match self {
            Self::SmallCar => small_car(),
            Self::Sedan => sedan(),
            Self::Suv => suv(),
            Self::Van => van(),
            Self::Truck => truck(),
            Self::Bus => bus(),
            Self::Scooter => scooter(),
        }
    }
}

impl fmt::Display for VehicleClass {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.as_str())
    }
}

/// Turns a minute in radians a second.
pub(super) const RPM: f64 = std::f64::consts::TAU / 60.0;

/// A curve of torque, N m, by turns a minute.
pub(super) fn curve(points: &[(f64, f64)]) -> Vec<[f64; 2]> {
    points.iter().map(|(rpm, torque)| [rpm * RPM, *torque]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_class_is_sound_and_found_by_its_name() {
        for class in VehicleClass::ALL {
            class.parameters().validate().unwrap_or_else(|error| panic!("{class}: {error}"));
            assert_eq!(VehicleClass::from_name(class.as_str()), Some(*class));
        }
    }

    #[test]
    fn the_mean_car_has_its_mass_and_power() {
        let sedan = sedan();
        assert_eq!(sedan.chassis.mass, 1392.0);
        assert!((sedan.powertrain.power() - 95e3).abs() < 1e3, "{}", sedan.powertrain.power());
    }
}
