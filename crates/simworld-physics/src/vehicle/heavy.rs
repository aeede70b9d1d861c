//! The data of trucks and buses, and of the scooter; sources stand in `class`.

use super::class::{RPM, curve};
use super::parameters::{
    AxleParameters, BalanceParameters, BrakeParameters, ChassisParameters, SlipControl, SteeringParameters,
    VehicleParameters,
};
use super::powertrain::{Drive, Powertrain};
use super::tyre::TyreParameters;

/// The tyre of a truck: less friction and stiffness for its load (Pacejka 2012, section 1.2; Fancher, UMTRI 1986).
fn truck_tyre(nominal_load: f64) -> TyreParameters {
    TyreParameters {
        nominal_load,
        friction_x: 0.85,
        friction_y: 0.8,
        load_sensitivity: 0.1,
        stiffness_x: 15.0,
        stiffness_y: 10.0,
        stiffness_peak: 2.5,
        relaxation_x: 0.3,
        relaxation_y: 0.8,
        rolling_resistance: 0.007,
        ..TyreParameters::default()
    }
}

const AIR_BRAKES: BrakeParameters =
    BrakeParameters { deceleration: 6.5, front_share: 0.5, response: 0.25, control: SlipControl::Controlled };

pub(super) fn truck() -> VehicleParameters {
    let front = AxleParameters {
        track: 2.05,
        wheel_radius: 0.45,
        wheel_inertia: 8.0,
        spring_rate: 200_000.0,
        compression_damping: 14_000.0,
        rebound_damping: 22_000.0,
        travel: 0.1,
        anti_roll_rate: 150_000.0,
        compliance_steer: 3e-7,
        tyre: truck_tyre(21_000.0),
    };
    let rear = AxleParameters {
        track: 1.8,
        wheel_inertia: 16.0,
        spring_rate: 400_000.0,
        compression_damping: 24_000.0,
        rebound_damping: 36_000.0,
        anti_roll_rate: 150_000.0,
        compliance_steer: 0.0,
        tyre: truck_tyre(38_000.0),
        ..front.clone()
    };
    VehicleParameters {
        chassis: ChassisParameters {
            length: 8.4,
            width: 2.5,
            height: 3.6,
            clearance: 0.3,
            mass: 12_000.0,
            wheelbase: 4.5,
            front_overhang: 1.35,
            front_share: 0.36,
            center_of_mass: 1.4,
            gyration: [1.05, 2.3, 2.35],
            drag_area: 5.2,
        },
        front,
        rear,
        powertrain: Powertrain {
            torque_curve: curve(&[
                (700.0, 600.0),
                (1200.0, 900.0),
                (1700.0, 900.0),
                (2200.0, 764.0),
                (2500.0, 500.0),
            ]),
            drag_torque: 250.0,
            gears: vec![28.0, 17.0, 11.0, 7.5, 5.2, 4.0],
            efficiency: 0.9,
            inertia: 1.2,
            launch_speed: 1000.0 * RPM,
            shift_time: 0.6,
            drive: Drive::Rear,
            top_speed: 25.0,
            reverse_speed: 3.0,
        },
        brakes: BrakeParameters { front_share: 0.45, ..AIR_BRAKES },
        steering: SteeringParameters { limit: 0.75, rate: 0.5 },
        balance: None,
    }
}

pub(super) fn bus() -> VehicleParameters {
    let base = truck();
    let front = AxleParameters {
        track: 2.1,
        wheel_radius: 0.48,
        wheel_inertia: 10.0,
        spring_rate: 220_000.0,
        compression_damping: 18_000.0,
        rebound_damping: 28_000.0,
        travel: 0.09,
        anti_roll_rate: 180_000.0,
        compliance_steer: 3e-7,
        tyre: truck_tyre(26_000.0),
    };
    let rear = AxleParameters {
        track: 1.85,
        wheel_inertia: 20.0,
        spring_rate: 420_000.0,
        compression_damping: 30_000.0,
        rebound_damping: 44_000.0,
        anti_roll_rate: 150_000.0,
        compliance_steer: 0.0,
        tyre: truck_tyre(45_000.0),
        ..front.clone()
    };
    VehicleParameters {
        chassis: ChassisParameters {
            length: 12.0,
            width: 2.55,
            height: 3.1,
            clearance: 0.25,
            mass: 14_500.0,
            wheelbase: 5.9,
            front_overhang: 2.72,
            front_share: 0.37,
            center_of_mass: 1.2,
            gyration: [1.05, 3.3, 3.35],
            drag_area: 5.0,
        },
        front,
        rear,
        powertrain: Powertrain {
            torque_curve: curve(&[
                (700.0, 750.0),
                (1100.0, 1120.0),
                (1600.0, 1120.0),
                (2200.0, 955.0),
                (2400.0, 700.0),
            ]),
            gears: vec![18.0, 10.8, 7.2, 4.95],
            inertia: 1.5,
            shift_time: 0.4,
            top_speed: 22.8,
            ..base.powertrain
        },
        brakes: BrakeParameters { front_share: 0.42, ..AIR_BRAKES },
        steering: SteeringParameters { limit: 0.85, rate: 0.5 },
        balance: None,
    }
}

pub(super) fn scooter() -> VehicleParameters {
    let axle = AxleParameters {
        track: 0.0,
        wheel_radius: 0.127,
        wheel_inertia: 0.012,
        spring_rate: 28_000.0,
        compression_damping: 700.0,
        rebound_damping: 900.0,
        travel: 0.04,
        anti_roll_rate: 0.0,
        compliance_steer: 0.0,
        tyre: TyreParameters {
            nominal_load: 450.0,
            friction_x: 0.95,
            friction_y: 0.95,
            stiffness_x: 18.0,
            stiffness_y: 18.0,
            relaxation_x: 0.1,
            relaxation_y: 0.15,
            rolling_resistance: 0.015,
            ..TyreParameters::default()
        },
    };
    VehicleParameters {
        chassis: ChassisParameters {
            length: 1.15,
            width: 0.5,
            height: 1.85,
            clearance: 0.08,
            mass: 94.0,
            wheelbase: 0.86,
            front_overhang: 0.13,
            front_share: 0.42,
            center_of_mass: 0.9,
            gyration: [0.42, 0.44, 0.25],
            drag_area: 0.6,
        },
        front: axle.clone(),
        rear: axle,
        powertrain: Powertrain {
            torque_curve: curve(&[(0.0, 17.0), (250.0, 17.0), (550.0, 8.5), (650.0, 4.0)]),
            drag_torque: 0.3,
            gears: vec![1.0],
            efficiency: 0.95,
            inertia: 0.01,
            launch_speed: 0.0,
            shift_time: 0.0,
            drive: Drive::Rear,
            top_speed: 7.15,
            reverse_speed: 0.0,
        },
        brakes: BrakeParameters {
            deceleration: 4.0,
            front_share: 0.55,
            response: 0.15,
            control: SlipControl::Controlled,
        },
        steering: SteeringParameters { limit: 0.7, rate: 6.0 },
        balance: Some(BalanceParameters {
            stiffness: 900.0,
            damping: 300.0,
            torque: 110.0,
            lean_limit: 0.4,
            fall: 1.0,
        }),
    }
}
