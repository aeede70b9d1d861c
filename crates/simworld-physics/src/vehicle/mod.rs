//! Road vehicles: what they are, what they are told, and at which level of detail they move.
//!
//! `rigid` moves a vehicle as a body on springs and tyres; `reduced` as a single track on the ground.

mod balance;
mod cars;
mod class;
mod heavy;
mod parameters;
mod physics_body;
mod powertrain;
mod reduced;
mod rigid;
mod single_track;
mod tyre;
mod wheel;

use serde::{Deserialize, Serialize};
use simworld_core::action::{Action, ActionKind, ActionSet};
use simworld_core::geometry::{Pose, Twist, Vector3};
use simworld_core::scene::EntityRef;
use simworld_core::seam::{BodyState, Embodiment, EmbodimentError};

pub use class::VehicleClass;
pub use parameters::{
    AxleParameters, BalanceParameters, BrakeParameters, ChassisParameters, SlipControl, SteeringParameters,
    VehicleParameters,
};
use powertrain::Gearbox;
pub use powertrain::{Drive, Powertrain};
use reduced::Track;
pub use single_track::{SingleTrackInput, SingleTrackParameters, SingleTrackState};
pub use tyre::{PatchForce, TyreParameters};
use wheel::Wheel;

use crate::body::Detail;
use crate::error::PhysicsError;

/// A car, van, truck, bus or scooter, driven by throttle, brake and steering.
///
/// In full detail it is a rigid body on springs, whose tyres have slip and load ([`TyreParameters`]); reduced it is a
/// single track ([`SingleTrackParameters`]) with the same controls. The physics chooses by the distance from what is
/// of interest ([`PhysicsDynamics::set_interest`](crate::PhysicsDynamics::set_interest)), and the vehicle goes over
/// from one to the other with the same pose, velocity and yaw rate.
#[derive(Clone, Debug)]
pub struct Vehicle {
    parameters: VehicleParameters,
    state: BodyState,
    controls: Controls,
    gearbox: Gearbox,
    wheels: Vec<Wheel>,
    detail: Detail,
    track: Track,
}

/// What the driver does.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
struct Controls {
    /// In [-1, 1].
    throttle: f64,
    /// In [0, 1].
    brake: f64,
    /// Angle of the front wheels it was told, radians, positive to the left.
    steering: f64,
    /// Angle of the front wheels now, radians.
    wheel_angle: f64,
    /// How far the brakes are on, in [0, 1].
    braking: f64,
}

/// How much a shape may differ from the vehicle's own size, as a factor.
const FIT: f64 = 1.6;

impl Vehicle {
    /// A vehicle that stands at a pose.
    ///
    /// # Errors
    /// A setting out of range.
    pub fn new(pose: Pose, parameters: VehicleParameters) -> Result<Self, PhysicsError> {
        parameters.validate()?;
        let state = BodyState { pose, twist: Twist::ZERO };
        let wheels = mount_wheels(&parameters);
        Ok(Self {
            parameters,
            state,
            controls: Controls::default(),
            gearbox: Gearbox::default(),
            wheels,
            detail: Detail::Full,
            track: Track::default(),
        })
    }

    /// A vehicle with the pose, velocity and size of an entity, and its mass if it has one.
    ///
    /// # Errors
    /// A setting out of range, or a shape that differs from the vehicle's own length, width or height by more than a
    /// factor of 1.6.
    pub fn of(entity: &EntityRef<'_>, parameters: VehicleParameters) -> Result<Self, PhysicsError> {
        parameters.validate()?;
        let (size, chassis) = (entity.info.shape.size(), &parameters.chassis);
        let fits = |a: f64, b: f64| a <= b * FIT && b <= a * FIT;
        if !(fits(size.x, chassis.length) && fits(size.y, chassis.width) && fits(size.z, chassis.height)) {
            let reason = format!(
                "it is {:.2} x {:.2} x {:.2} m, and the vehicle {:.2} x {:.2} x {:.2} m: choose another class",
                size.x, size.y, size.z, chassis.length, chassis.width, chassis.height
            );
            return Err(PhysicsError::Shape { id: entity.id, body: "vehicle", reason });
        }
        let mut parameters = parameters.with_size(size.x, size.y, size.z);
        if let Some(mass) = entity.info.mass {
            parameters.chassis.mass = mass;
        }
        let mut vehicle = Self::new(*entity.pose, parameters)?;
        vehicle.take_state(&BodyState { pose: *entity.pose, twist: *entity.twist });
        Ok(vehicle)
    }

    /// Its data.
    pub fn parameters(&self) -> &VehicleParameters {
        &self.parameters
    }

    /// The angle of the front wheels now, radians, positive to the left.
    pub fn wheel_angle(&self) -> f64 {
        self.controls.wheel_angle
    }

    /// The level of detail at which it moves now.
    pub fn detail(&self) -> Detail {
        self.detail
    }

    /// The gear that is engaged, from 1.
    pub fn gear(&self) -> usize {
        usize::from(self.gearbox.gear) + 1
    }

    /// The load on each wheel, N: front left, front right, rear left, rear right; front and rear of a two-wheeler.
    pub fn wheel_loads(&self) -> impl Iterator<Item = f64> + '_ {
        self.wheels.iter().map(|wheel| wheel.load)
    }

    /// The centre of mass, body frame, m.
    fn center_of_mass(&self) -> Vector3 {
        Vector3::new(self.parameters.center_of_mass_x(), 0.0, self.parameters.chassis.center_of_mass)
    }

    /// Speed along the vehicle, m/s.
    fn speed(&self) -> f64 {
        self.state.twist.linear.dot(&(self.state.pose.rotation * Vector3::x()))
    }

    /// Takes up a pose and velocity from outside; the wheels roll with it.
    fn take_state(&mut self, state: &BodyState) {
        self.state = *state;
        self.track = Track::default();
        self.roll_freely();
    }

    /// Lets the wheels turn with the ground.
    fn roll_freely(&mut self) {
        let (speed, parameters) = (self.speed(), &self.parameters);
        for wheel in &mut self.wheels {
            wheel.spin = speed / axle_of(parameters, wheel).wheel_radius;
            wheel.deflection = [0.0; 2];
        }
    }

    /// Moves steering and brakes towards what they were told.
    fn follow_controls(&mut self, steering: f64, dt: f64) {
        let limits = &self.parameters.steering;
        let (most, target) = (limits.rate * dt, steering.clamp(-limits.limit, limits.limit));
        let controls = &mut self.controls;
        controls.wheel_angle += (target - controls.wheel_angle).clamp(-most, most);
        let speed = self.state.twist.linear.dot(&(self.state.pose.rotation * Vector3::x()));
        // A throttle against the motion brakes first.
        let against =
            if controls.throttle * speed < 0.0 && speed.abs() > 0.5 { controls.throttle.abs() } else { 0.0 };
        let wanted = controls.brake.max(against);
        let share = dt / (self.parameters.brakes.response + dt);
        controls.braking += (wanted - controls.braking) * share;
        if wanted == 0.0 && controls.braking < 1e-4 {
            controls.braking = 0.0;
        }
    }

    /// The throttle that reaches the engine: none while it brakes.
    fn engine_throttle(&self) -> f64 {
        let (throttle, speed) = (self.controls.throttle, self.speed());
        let against = throttle * speed < 0.0 && speed.abs() > 0.5;
        if against || self.controls.brake > 0.0 { 0.0 } else { throttle }
    }
}

/// Wheels of both axles with their loads at rest under standard gravity; `attach` sets them for another one.
fn mount_wheels(parameters: &VehicleParameters) -> Vec<Wheel> {
    let chassis = &parameters.chassis;
    let weight = chassis.mass * 9.81;
    let mut wheels = Vec::with_capacity(4);
    let axles = [
        (&parameters.front, parameters.front_axle(), chassis.front_share),
        (&parameters.rear, parameters.rear_axle(), 1.0 - chassis.front_share),
    ];
    for (axle, x, share) in axles {
        match axle.wheels() {
            1 => wheels.push(Wheel::new(x, 0.0, weight * share)),
            _ => {
                wheels.extend([0.5, -0.5].map(|side| Wheel::new(x, side * axle.track, weight * share * 0.5)));
            }
        }
    }
    wheels
}

/// The axle that a wheel is on.
fn axle_of<'a>(parameters: &'a VehicleParameters, wheel: &Wheel) -> &'a AxleParameters {
    if wheel.x > parameters.center_of_mass_x() { &parameters.front } else { &parameters.rear }
}

impl Embodiment for Vehicle {
    fn supports(&self) -> ActionSet {
        ActionSet::vehicle()
    }

    fn apply(&mut self, action: &Action) -> Result<(), EmbodimentError> {
        let controls = &mut self.controls;
        match action {
            Action::Throttle { level } => {
                controls.throttle = checked(action.kind(), "level", *level, -1.0, 1.0, "-1 to 1")?;
                controls.brake = 0.0;
            }
            Action::Brake { level } => {
                controls.brake = checked(action.kind(), "level", *level, 0.0, 1.0, "0 to 1")?;
                controls.throttle = 0.0;
            }
            Action::Steer { angle } => {
                let angle = checked(action.kind(), "angle", *angle, f64::MIN, f64::MAX, "a finite angle")?;
                let limit = self.parameters.steering.limit;
                controls.steering = angle.clamp(-limit, limit);
            }
            Action::Stop => {
                controls.throttle = 0.0;
                controls.brake = 1.0;
            }
            Action::TakePhoto => {}
            other => return Err(EmbodimentError::unsupported(other.kind(), self.supports())),
        }
        Ok(())
    }

    fn state(&self) -> BodyState {
        self.state
    }

    fn save(&self) -> Vec<u8> {
        let Self { parameters, controls, gearbox, wheels, detail, track, .. } = self;
        postcard::to_allocvec(&("vehicle", parameters, controls, gearbox, wheels, detail, track))
            .expect("plain numbers always serialise")
    }

    fn restore(&mut self, state: &BodyState, saved: &[u8]) -> bool {
        type Saved<'a> = (&'a str, VehicleParameters, Controls, Gearbox, Vec<Wheel>, Detail, Track);
        match postcard::from_bytes::<Saved<'_>>(saved) {
            Ok(("vehicle", parameters, controls, gearbox, wheels, detail, track))
                if parameters.validate().is_ok() && wheels.len() == mount_wheels(&parameters).len() =>
            {
                *self = Self { parameters, state: *state, controls, gearbox, wheels, detail, track };
                true
            }
            _ => false,
        }
    }
}

fn checked(
    action: ActionKind,
    field: &'static str,
    value: f64,
    least: f64,
    most: f64,
    allowed: &'static str,
) -> Result<f64, EmbodimentError> {
    if (least..=most).contains(&value) {
        Ok(value)
    } else {
        Err(EmbodimentError::Argument { action, field, value, allowed })
    }
}
