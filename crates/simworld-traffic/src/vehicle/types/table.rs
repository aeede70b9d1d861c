//! The standard table.
//!
//! Sizes and highest speeds are those of SUMO's vehicle classes (its page "Vehicle Type Parameter Defaults", 1.20), but for
//! the car, the van and the bus, which are a little shorter here. The car's driver is the urban one of Treiber and Kesting,
//! Traffic Flow Dynamics (2013), table 11.2, with the gaps that give the Highway Capacity Manual's saturation flow; that
//! of heavy vehicles is their truck driver. Riders accelerate and brake as measured by Parkin and Rotheram (2010), Transport
//! Policy 17: 0.3 to 1.4 m/s², desired 6.0 m/s on the level. Emergency braking is that of SUMO's classes. Desired speeds
//! spread by a tenth about the limit (SUMO's `speedDev` of passenger cars), less among professional drivers.

use super::{VehicleKind, VehicleType};
use crate::vehicle::{CarFollowing, Idm};

/// The types that there are if nobody says otherwise: one a kind, in the order of [`VehicleKind::ALL`]. Riders and emergency
/// vehicles have no share: who has them asks for them.
///
/// ```
/// use simworld_traffic::vehicle::{VehicleKind, standard_types};
/// let types = standard_types();
/// assert!(types.iter().map(|row| row.kind).eq(VehicleKind::ALL));
/// let total: f64 = types.iter().map(|row| row.share).sum();
/// assert!((total - 1.0).abs() < 1e-9);
/// ```
pub fn standard_types() -> Vec<VehicleType> {
    vec![car(), van(), truck(), bus(), motorcycle(), bicycle(), scooter(), emergency()]
}

/// Speeds in km/h as they stand in the sources.
const fn kmh(speed: f64) -> f64 {
    speed / 3.6
}

pub(super) fn car() -> VehicleType {
    VehicleType {
        kind: VehicleKind::Car,
        share: 0.8,
        length: 4.5,
        width: 1.8,
        height: 1.5,
        speed_factor: 1.0,
        speed_deviation: 0.1,
        driver: Idm { desired_speed: kmh(180.0), ..Idm::default() },
        model: CarFollowing::Idm,
        perception: None,
        siren: false,
    }
}

fn van() -> VehicleType {
    VehicleType {
        kind: VehicleKind::Van,
        share: 0.1,
        length: 5.8,
        width: 2.0,
        height: 2.4,
        driver: Idm { desired_speed: kmh(150.0), acceleration: 1.3, ..Idm::default() },
        ..car()
    }
}

fn truck() -> VehicleType {
    VehicleType {
        kind: VehicleKind::Truck,
        share: 0.03,
        length: 7.1,
        width: 2.4,
        height: 2.4,
        speed_deviation: 0.05,
        driver: Idm {
            desired_speed: kmh(90.0),
            headway: 1.5,
            acceleration: 1.0,
            deceleration: 1.8,
            emergency_deceleration: 7.0,
            ..Idm::default()
        },
        ..car()
    }
}

fn bus() -> VehicleType {
    VehicleType {
        kind: VehicleKind::Bus,
        share: 0.04,
        length: 11.5,
        width: 2.5,
        height: 3.0,
        driver: Idm { desired_speed: kmh(85.0), headway: 1.3, ..truck().driver },
        ..truck()
    }
}

fn motorcycle() -> VehicleType {
    VehicleType {
        kind: VehicleKind::Motorcycle,
        share: 0.03,
        length: 2.2,
        width: 0.9,
        height: 1.5,
        driver: Idm { acceleration: 2.5, emergency_deceleration: 10.0, ..car().driver },
        ..car()
    }
}

fn bicycle() -> VehicleType {
    VehicleType {
        kind: VehicleKind::Bicycle,
        share: 0.0,
        length: 1.6,
        width: 0.65,
        height: 1.7,
        driver: Idm {
            desired_speed: 6.0,
            gap: 1.0,
            acceleration: 1.0,
            deceleration: 1.5,
            emergency_deceleration: 7.0,
            ..Idm::default()
        },
        ..car()
    }
}

fn scooter() -> VehicleType {
    VehicleType {
        kind: VehicleKind::Scooter,
        length: 1.2,
        width: 0.5,
        // 20 km/h is the law in Germany and many other countries.
        driver: Idm { desired_speed: kmh(20.0), emergency_deceleration: 5.0, ..bicycle().driver },
        ..bicycle()
    }
}

fn emergency() -> VehicleType {
    VehicleType {
        kind: VehicleKind::Emergency,
        share: 0.0,
        length: 6.5,
        width: 2.2,
        height: 2.9,
        // SUMO's default for emergency vehicles: half as fast again as the limit.
        speed_factor: 1.5,
        speed_deviation: 0.05,
        driver: Idm { acceleration: 2.0, deceleration: 2.5, ..car().driver },
        ..car()
    }
}
