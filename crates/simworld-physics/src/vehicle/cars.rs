//! The data of cars and vans; sources stand in `class`.

use super::class::{RPM, curve};
use super::parameters::{
    AxleParameters, BrakeParameters, ChassisParameters, SlipControl, SteeringParameters, VehicleParameters,
};
use super::powertrain::{Drive, Powertrain};
use super::tyre::TyreParameters;

/// The tyre of a car for a load at a wheel, N.
fn car_tyre(nominal_load: f64) -> TyreParameters {
    TyreParameters { nominal_load, friction_y: 1.0, load_sensitivity: 0.14, ..TyreParameters::default() }
}

const CAR_STEERING: SteeringParameters = SteeringParameters { limit: 0.6, rate: 0.7 };
const CAR_BRAKES: BrakeParameters = BrakeParameters {
    deceleration: 13.0,
    front_share: 0.68,
    response: 0.08,
    control: SlipControl::Controlled,
};

pub(super) fn small_car() -> VehicleParameters {
    let front = AxleParameters {
        track: 1.43,
        wheel_radius: 0.28,
        wheel_inertia: 0.7,
        spring_rate: 19_000.0,
        compression_damping: 1300.0,
        rebound_damping: 1900.0,
        travel: 0.08,
        anti_roll_rate: 11_000.0,
        compliance_steer: 1.5e-6,
        tyre: car_tyre(2700.0),
    };
    let rear = AxleParameters {
        spring_rate: 16_000.0,
        anti_roll_rate: 5000.0,
        compliance_steer: 0.0,
        ..front.clone()
    };
    VehicleParameters {
        chassis: ChassisParameters {
            length: 3.6,
            width: 1.64,
            height: 1.5,
            clearance: 0.14,
            mass: 1010.0,
            wheelbase: 2.42,
            front_overhang: 0.65,
            front_share: 0.6,
            center_of_mass: 0.52,
            gyration: [0.6, 1.05, 1.1],
            drag_area: 0.66,
        },
        front,
        rear,
        powertrain: Powertrain {
            torque_curve: curve(&[
                (900.0, 70.0),
                (2000.0, 90.0),
                (3000.0, 95.0),
                (4300.0, 95.0),
                (6200.0, 85.0),
                (6500.0, 70.0),
            ]),
            drag_torque: 25.0,
            gears: vec![14.0, 7.6, 4.95, 3.75, 3.05],
            efficiency: 0.92,
            inertia: 0.1,
            launch_speed: 1800.0 * RPM,
            shift_time: 0.35,
            drive: Drive::Front,
            top_speed: 47.5,
            reverse_speed: 5.0,
        },
        brakes: CAR_BRAKES,
        steering: CAR_STEERING,
        balance: None,
    }
}

pub(super) fn sedan() -> VehicleParameters {
    let front = AxleParameters {
        track: 1.54,
        wheel_radius: 0.31,
        wheel_inertia: 1.0,
        spring_rate: 25_000.0,
        compression_damping: 1700.0,
        rebound_damping: 2500.0,
        travel: 0.09,
        anti_roll_rate: 15_000.0,
        compliance_steer: 1.2e-6,
        tyre: car_tyre(3700.0),
    };
    let rear = AxleParameters {
        spring_rate: 22_000.0,
        anti_roll_rate: 7000.0,
        compliance_steer: 0.0,
        ..front.clone()
    };
    VehicleParameters {
        chassis: ChassisParameters {
            length: 4.3,
            width: 1.8,
            height: 1.5,
            clearance: 0.15,
            mass: 1392.0,
            wheelbase: 2.64,
            front_overhang: 0.86,
            front_share: 0.59,
            center_of_mass: 0.54,
            gyration: [0.65, 1.25, 1.3],
            drag_area: 0.66,
        },
        front,
        rear,
        powertrain: Powertrain {
            torque_curve: curve(&[
                (900.0, 120.0),
                (1500.0, 200.0),
                (3600.0, 200.0),
                (5000.0, 181.0),
                (6000.0, 151.0),
                (6300.0, 120.0),
            ]),
            drag_torque: 35.0,
            gears: vec![13.8, 7.7, 5.0, 3.7, 3.0, 2.5],
            efficiency: 0.92,
            inertia: 0.15,
            launch_speed: 1700.0 * RPM,
            shift_time: 0.3,
            drive: Drive::Front,
            top_speed: 57.0,
            reverse_speed: 5.0,
        },
        brakes: CAR_BRAKES,
        steering: CAR_STEERING,
        balance: None,
    }
}

pub(super) fn suv() -> VehicleParameters {
    let base = sedan();
    let front = AxleParameters {
        track: 1.58,
        wheel_radius: 0.34,
        wheel_inertia: 1.5,
        spring_rate: 31_000.0,
        compression_damping: 2200.0,
        rebound_damping: 3200.0,
        travel: 0.1,
        anti_roll_rate: 24_000.0,
        compliance_steer: 1.0e-6,
        tyre: car_tyre(4500.0),
    };
    let rear = AxleParameters {
        spring_rate: 29_000.0,
        anti_roll_rate: 13_000.0,
        compliance_steer: 0.0,
        ..front.clone()
    };
    VehicleParameters {
        chassis: ChassisParameters {
            length: 4.5,
            width: 1.84,
            height: 1.67,
            clearance: 0.19,
            mass: 1750.0,
            wheelbase: 2.68,
            front_overhang: 0.89,
            front_share: 0.57,
            center_of_mass: 0.65,
            gyration: [0.7, 1.28, 1.33],
            drag_area: 0.83,
        },
        front,
        rear,
        powertrain: Powertrain {
            torque_curve: curve(&[
                (900.0, 180.0),
                (1600.0, 320.0),
                (3300.0, 320.0),
                (4000.0, 287.0),
                (4700.0, 220.0),
            ]),
            gears: vec![14.5, 9.5, 6.0, 4.2, 3.1, 2.45, 2.0],
            inertia: 0.2,
            drive: Drive::All,
            top_speed: 56.0,
            ..base.powertrain
        },
        ..base
    }
}

pub(super) fn van() -> VehicleParameters {
    let base = sedan();
    let front = AxleParameters {
        track: 1.71,
        wheel_radius: 0.34,
        wheel_inertia: 2.0,
        spring_rate: 48_000.0,
        compression_damping: 3200.0,
        rebound_damping: 4800.0,
        travel: 0.1,
        anti_roll_rate: 45_000.0,
        compliance_steer: 7e-7,
        tyre: TyreParameters { friction_x: 1.05, friction_y: 0.9, stiffness_y: 16.0, ..car_tyre(7000.0) },
    };
    let rear = AxleParameters {
        spring_rate: 62_000.0,
        anti_roll_rate: 15_000.0,
        compliance_steer: 0.0,
        ..front.clone()
    };
    VehicleParameters {
        chassis: ChassisParameters {
            length: 5.9,
            width: 2.02,
            height: 2.6,
            clearance: 0.18,
            mass: 2700.0,
            wheelbase: 3.66,
            front_overhang: 1.0,
            front_share: 0.48,
            center_of_mass: 0.85,
            gyration: [0.85, 1.75, 1.8],
            drag_area: 1.5,
        },
        front,
        rear,
        powertrain: Powertrain {
            torque_curve: curve(&[
                (900.0, 170.0),
                (1500.0, 340.0),
                (2400.0, 340.0),
                (3800.0, 264.0),
                (4400.0, 190.0),
            ]),
            drag_torque: 50.0,
            gears: vec![20.0, 12.0, 7.8, 5.5, 4.2, 3.3, 2.8],
            inertia: 0.25,
            drive: Drive::Rear,
            top_speed: 44.0,
            ..base.powertrain
        },
        brakes: BrakeParameters { front_share: 0.58, deceleration: 11.0, response: 0.1, ..CAR_BRAKES },
        ..base
    }
}
