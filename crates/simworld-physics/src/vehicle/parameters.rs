//! What a road vehicle is, as data: dimensions, masses, axles, tyres, engine, brakes, steering.

use serde::{Deserialize, Serialize};

use super::powertrain::Powertrain;
use super::tyre::TyreParameters;
use crate::error::{PhysicsError, check_range};

/// The data of a road vehicle. [`VehicleClass`](super::VehicleClass) has sets of them; a single field is changed by
/// `VehicleParameters { field, ..VehicleClass::Sedan.parameters() }`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct VehicleParameters {
    /// Length, width and height and what hangs on them.
    pub chassis: ChassisParameters,
    /// The front axle, which steers.
    pub front: AxleParameters,
    /// The rear axle.
    pub rear: AxleParameters,
    /// Engine and gears.
    pub powertrain: Powertrain,
    /// Brakes.
    pub brakes: BrakeParameters,
    /// Steering.
    pub steering: SteeringParameters,
    /// The rider's balance, of a two-wheeler.
    pub balance: Option<BalanceParameters>,
}

/// Body and masses.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ChassisParameters {
    /// Length over all, m, 0.5 to 30.
    pub length: f64,
    /// Width over all without mirrors, m, 0.1 to 4.
    pub width: f64,
    /// Height over all, m, 0.3 to 6; of a two-wheeler with its rider.
    pub height: f64,
    /// Free height under the chassis, m, 0.02 to 1.
    pub clearance: f64,
    /// Mass with driver and usual load, kg, 50 to 60 000.
    pub mass: f64,
    /// Distance between the axles, m, 0.3 to 20.
    pub wheelbase: f64,
    /// From the front end to the front axle, m, 0 to 5.
    pub front_overhang: f64,
    /// Share of the weight on the front axle at rest, 0.2 to 0.8.
    pub front_share: f64,
    /// Height of the centre of mass, m, 0.1 to 3.
    pub center_of_mass: f64,
    /// Radii of gyration about the longitudinal, lateral and vertical axes through the centre of mass, m, each 0.05
    /// to 10.
    pub gyration: [f64; 3],
    /// Drag coefficient by frontal area, m², 0 to 20.
    pub drag_area: f64,
}

/// One axle: two wheels side by side, or a single one.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AxleParameters {
    /// Distance between the wheels, m, 0.3 to 3; 0 for a single wheel.
    pub track: f64,
    /// Rolling radius, m, 0.05 to 1.
    pub wheel_radius: f64,
    /// Moment of inertia of a wheel about its axle, kg m², 1e-3 to 100.
    pub wheel_inertia: f64,
    /// Spring rate at a wheel, with the tyre's in series, N/m, 1e3 to 1e7.
    pub spring_rate: f64,
    /// Damping at a wheel in compression, N s/m, 0 to 1e6.
    pub compression_damping: f64,
    /// Damping at a wheel in rebound, N s/m, 0 to 1e6.
    pub rebound_damping: f64,
    /// Way of a wheel up from its place at rest, before the bump stop, m, 0.005 to 0.5.
    pub travel: f64,
    /// Force at each wheel for a difference of travel between both, N/m, 0 to 1e6: the anti-roll bar.
    pub anti_roll_rate: f64,
    /// Steering of the axle by its lateral force, rad/N, 0 to 1e-4: bushes and steering column give. At the front it
    /// turns out of the bend, which is most of the understeer of cars (Gillespie, Fundamentals of Vehicle Dynamics,
    /// 1992, chapter 6); the rear turns into the bend.
    pub compliance_steer: f64,
    /// The tyres.
    pub tyre: TyreParameters,
}

/// What keeps wheels from locking and from spinning.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SlipControl {
    /// Anti-lock brakes and traction control, mandatory for new cars in the European Union.
    #[default]
    Controlled,
    /// Wheels lock and spin as the driver has it.
    None,
}

/// Brakes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BrakeParameters {
    /// Deceleration that the brakes of all wheels together could give on endless grip, m/s², 0.5 to 20.
    pub deceleration: f64,
    /// Share of the braking torque at the front axle, 0 to 1.
    pub front_share: f64,
    /// Time constant of the build-up of braking, s, 0.01 to 2.
    pub response: f64,
    /// What keeps wheels from locking and spinning.
    pub control: SlipControl,
}

/// Steering.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SteeringParameters {
    /// Greatest angle of the front wheels, radians, 0.05 to 1.4.
    pub limit: f64,
    /// How fast the front wheels turn, rad/s, 0.05 to 20. 0.4 is that of a driver in `CommonRoad`.
    pub rate: f64,
}

/// How a rider balances: a spring and damper between the lean that the turn asks for and the one there is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BalanceParameters {
    /// Torque for lean, N m/rad, 0 to 1e5.
    pub stiffness: f64,
    /// Torque for its rate, N m s/rad, 0 to 1e5.
    pub damping: f64,
    /// Greatest torque, N m, 0 to 1e4: the weight of the rider by how far it shifts.
    pub torque: f64,
    /// Greatest lean that the rider steers for, radians, 0.05 to 1.
    pub lean_limit: f64,
    /// Lean beyond which the vehicle has fallen and is not balanced any more, radians, 0.1 to 1.5.
    pub fall: f64,
}

/// Names the settings in errors.
pub(crate) struct Check(pub(crate) &'static str);

impl Check {
    pub(crate) fn range(
        &self,
        field: &'static str,
        value: f64,
        range: std::ops::RangeInclusive<f64>,
        allowed: &'static str,
    ) -> Result<(), PhysicsError> {
        check_range(self.0, field, value, range, allowed)
    }
}

impl VehicleParameters {
    /// Checks every field.
    ///
    /// # Errors
    /// The first field out of range, with what is allowed.
    pub fn validate(&self) -> Result<(), PhysicsError> {
        let check = Check("VehicleParameters");
        self.chassis.validate(&check)?;
        self.front.validate(&Check("VehicleParameters.front"))?;
        self.rear.validate(&Check("VehicleParameters.rear"))?;
        self.powertrain.validate(&Check("VehicleParameters.powertrain"))?;
        self.brakes.validate(&check)?;
        check.range("steering.limit", self.steering.limit, 0.05..=1.4, "0.05 to 1.4 rad")?;
        check.range("steering.rate", self.steering.rate, 0.05..=20.0, "0.05 to 20 rad/s")?;
        if let Some(balance) = &self.balance {
            balance.validate(&check)?;
        }
        let (chassis, radius) = (&self.chassis, self.front.wheel_radius.max(self.rear.wheel_radius));
        let room = chassis.length - chassis.front_overhang - radius * 0.5;
        check.range("chassis.wheelbase", chassis.wheelbase, radius..=room, "what fits into the length")?;
        let under = chassis.height - 0.1;
        check.range("chassis.clearance", chassis.clearance, 0.0..=under, "less than the height by 0.1 m")
    }

    /// From the body frame, whose origin is the middle of the length, to the front axle, m.
    pub fn front_axle(&self) -> f64 {
        self.chassis.length * 0.5 - self.chassis.front_overhang
    }

    /// From the body frame to the rear axle, m; negative.
    pub fn rear_axle(&self) -> f64 {
        self.front_axle() - self.chassis.wheelbase
    }

    /// From the body frame to the centre of mass along the vehicle, m.
    pub fn center_of_mass_x(&self) -> f64 {
        self.rear_axle() + self.chassis.wheelbase * self.chassis.front_share
    }

    /// The same vehicle with another length, width and height: what lies along and across grows with it, masses and
    /// heights of axles stay.
    #[must_use]
    pub fn with_size(mut self, length: f64, width: f64, height: f64) -> Self {
        let (along, across) = (length / self.chassis.length, width / self.chassis.width);
        let chassis = &mut self.chassis;
        chassis.wheelbase *= along;
        chassis.front_overhang *= along;
        chassis.gyration[0] *= across;
        chassis.gyration[1] *= along;
        chassis.gyration[2] *= along;
        (chassis.length, chassis.width, chassis.height) = (length, width, height);
        self.front.track *= across;
        self.rear.track *= across;
        self
    }
}

impl ChassisParameters {
    fn validate(&self, check: &Check) -> Result<(), PhysicsError> {
        check.range("chassis.length", self.length, 0.5..=30.0, "0.5 to 30 m")?;
        check.range("chassis.width", self.width, 0.1..=4.0, "0.1 to 4 m")?;
        check.range("chassis.height", self.height, 0.3..=6.0, "0.3 to 6 m")?;
        check.range("chassis.clearance", self.clearance, 0.02..=1.0, "0.02 to 1 m")?;
        check.range("chassis.mass", self.mass, 50.0..=6e4, "50 to 60000 kg")?;
        check.range("chassis.wheelbase", self.wheelbase, 0.3..=20.0, "0.3 to 20 m")?;
        check.range("chassis.front_overhang", self.front_overhang, 0.0..=5.0, "0 to 5 m")?;
        check.range("chassis.front_share", self.front_share, 0.2..=0.8, "0.2 to 0.8")?;
        check.range("chassis.center_of_mass", self.center_of_mass, 0.1..=3.0, "0.1 to 3 m")?;
        for radius in self.gyration {
            check.range("chassis.gyration", radius, 0.05..=10.0, "0.05 to 10 m")?;
        }
        check.range("chassis.drag_area", self.drag_area, 0.0..=20.0, "0 to 20 m²")
    }
}

impl AxleParameters {
    /// How many wheels it has.
    pub fn wheels(&self) -> usize {
        if self.track > 0.0 { 2 } else { 1 }
    }

    fn validate(&self, check: &Check) -> Result<(), PhysicsError> {
        if self.track != 0.0 {
            check.range("track", self.track, 0.3..=3.0, "0.3 to 3 m, or 0 for a single wheel")?;
        }
        check.range("wheel_radius", self.wheel_radius, 0.05..=1.0, "0.05 to 1 m")?;
        check.range("wheel_inertia", self.wheel_inertia, 1e-3..=100.0, "1e-3 to 100 kg m²")?;
        check.range("spring_rate", self.spring_rate, 1e3..=1e7, "1e3 to 1e7 N/m")?;
        check.range("compression_damping", self.compression_damping, 0.0..=1e6, "0 to 1e6 N s/m")?;
        check.range("rebound_damping", self.rebound_damping, 0.0..=1e6, "0 to 1e6 N s/m")?;
        check.range("travel", self.travel, 0.005..=0.5, "0.005 to 0.5 m")?;
        check.range("anti_roll_rate", self.anti_roll_rate, 0.0..=1e6, "0 to 1e6 N/m")?;
        check.range("compliance_steer", self.compliance_steer, 0.0..=1e-4, "0 to 1e-4 rad/N")?;
        self.tyre.validate(check)
    }
}

impl BrakeParameters {
    fn validate(&self, check: &Check) -> Result<(), PhysicsError> {
        check.range("brakes.deceleration", self.deceleration, 0.5..=20.0, "0.5 to 20 m/s²")?;
        check.range("brakes.front_share", self.front_share, 0.0..=1.0, "0 to 1")?;
        check.range("brakes.response", self.response, 0.01..=2.0, "0.01 to 2 s")
    }
}

impl BalanceParameters {
    fn validate(&self, check: &Check) -> Result<(), PhysicsError> {
        check.range("balance.stiffness", self.stiffness, 0.0..=1e5, "0 to 1e5 N m/rad")?;
        check.range("balance.damping", self.damping, 0.0..=1e5, "0 to 1e5 N m s/rad")?;
        check.range("balance.torque", self.torque, 0.0..=1e4, "0 to 1e4 N m")?;
        check.range("balance.lean_limit", self.lean_limit, 0.05..=1.0, "0.05 to 1 rad")?;
        check.range("balance.fall", self.fall, 0.1..=1.5, "0.1 to 1.5 rad")
    }
}
