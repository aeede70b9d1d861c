//! A four-wheeled vehicle: its data and what it is told. How it moves is in `drive`.

mod drive;

use rapier3d_f64::control::DynamicRayCastVehicleController;
use serde::{Deserialize, Serialize};
use simworld_core::action::{Action, ActionKind, ActionSet};
use simworld_core::geometry::{Pose, Twist, Vector3};
use simworld_core::scene::EntityRef;
use simworld_core::seam::{BodyState, Embodiment, EmbodimentError};

use crate::error::{PhysicsError, check_range};

/// The data of a car. The defaults are those of a mean new car of the European Union: 1392 kg and 95 kW (ICCT
/// pocketbook 2016).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct VehicleConfig {
    /// Mass, kg, 50 to 60 000.
    pub mass: f64,
    /// Power at the wheels, W, 100 to 1e6.
    pub power: f64,
    /// Greatest driving force, N, 100 to 1e6; it is what limits the acceleration from rest.
    pub drive_force: f64,
    /// Deceleration under full braking, m/s², 0.5 to 12.
    pub braking: f64,
    /// Greatest speed forward, m/s, 1 to 100.
    pub top_speed: f64,
    /// Greatest speed backward, m/s, 0 to 30.
    pub reverse_speed: f64,
    /// Greatest angle of the front wheels, radians, 0.05 to 1.2.
    pub steering_limit: f64,
    /// How fast the front wheels turn, rad/s, 0.05 to 20.
    pub steering_rate: f64,
    /// Share of the length between the axles, 0.3 to 0.95.
    pub wheelbase_share: f64,
    /// Wheel radius, m, 0.05 to 1.
    pub wheel_radius: f64,
    /// Free height under the chassis, m, 0.02 to 1.
    pub clearance: f64,
    /// Height of the centre of mass, m, 0.05 to 3.
    pub center_of_mass: f64,
    /// Friction coefficient of the tyres, 0.05 to 1.5; dry asphalt 0.7 to 0.85, ice 0.05 to 0.15.
    pub grip: f64,
    /// Aerodynamic drag, N/(m/s)², that is half the density of air by drag coefficient and frontal area, 0 to 20.
    pub drag: f64,
    /// Rolling resistance as a share of the weight, 0 to 0.1.
    pub rolling_resistance: f64,
}

impl Default for VehicleConfig {
    fn default() -> Self {
        Self {
            mass: 1392.0,
            power: 95e3,
            drive_force: 5000.0,
            braking: 7.0,
            top_speed: 50.0,
            reverse_speed: 5.0,
            steering_limit: 0.6,
            steering_rate: 1.0,
            wheelbase_share: 0.6,
            wheel_radius: 0.31,
            clearance: 0.18,
            center_of_mass: 0.5,
            grip: 0.8,
            drag: 0.4,
            rolling_resistance: 0.012,
        }
    }
}

impl VehicleConfig {
    /// Checks every field.
    ///
    /// # Errors
    /// The first field out of range, with what is allowed.
    pub fn validate(&self) -> Result<(), PhysicsError> {
        let check = |field, value, range, allowed| check_range("VehicleConfig", field, value, range, allowed);
        check("mass", self.mass, 50.0..=6e4, "50 to 60000 kg")?;
        check("power", self.power, 100.0..=1e6, "100 to 1e6 W")?;
        check("drive_force", self.drive_force, 100.0..=1e6, "100 to 1e6 N")?;
        check("braking", self.braking, 0.5..=12.0, "0.5 to 12 m/s²")?;
        check("top_speed", self.top_speed, 1.0..=100.0, "1 to 100 m/s")?;
        check("reverse_speed", self.reverse_speed, 0.0..=30.0, "0 to 30 m/s")?;
        check("steering_limit", self.steering_limit, 0.05..=1.2, "0.05 to 1.2 rad")?;
        check("steering_rate", self.steering_rate, 0.05..=20.0, "0.05 to 20 rad/s")?;
        check("wheelbase_share", self.wheelbase_share, 0.3..=0.95, "0.3 to 0.95")?;
        check("wheel_radius", self.wheel_radius, 0.05..=1.0, "0.05 to 1 m")?;
        check("clearance", self.clearance, 0.02..=1.0, "0.02 to 1 m")?;
        check("center_of_mass", self.center_of_mass, 0.05..=3.0, "0.05 to 3 m")?;
        check("grip", self.grip, 0.05..=1.5, "0.05 to 1.5")?;
        check("drag", self.drag, 0.0..=20.0, "0 to 20 N s²/m²")?;
        check("rolling_resistance", self.rolling_resistance, 0.0..=0.1, "0 to 0.1")
    }
}

/// A car, bus or truck on rapier's ray-cast vehicle controller, driven by throttle, brake and steering.
///
/// The wheels are rays with springs; the tyres have a friction limit and no slip angle.
#[derive(Clone, Debug)]
pub struct Vehicle {
    config: VehicleConfig,
    /// Length, width and height, m.
    size: Vector3,
    state: BodyState,
    controls: Controls,
    /// Wheels on the chassis, once it is in an engine.
    wheels: Option<DynamicRayCastVehicleController>,
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
}

impl Vehicle {
    /// A passenger car 4.3 m long, 1.8 m wide and 1.5 m high at a pose.
    ///
    /// # Errors
    /// A setting out of range.
    pub fn new(pose: Pose, config: VehicleConfig) -> Result<Self, PhysicsError> {
        config.validate()?;
        let state = BodyState { pose, twist: Twist::ZERO };
        let size = Vector3::new(4.3, 1.8, 1.5);
        Ok(Self { config, size, state, controls: Controls::default(), wheels: None })
    }

    /// A vehicle with the pose and the size of an entity.
    ///
    /// # Errors
    /// A setting out of range, or a shape too small to stand on four such wheels: it must be higher than the
    /// clearance, and its axles farther apart than two wheel radii.
    pub fn of(entity: &EntityRef<'_>, config: VehicleConfig) -> Result<Self, PhysicsError> {
        let vehicle = Self::new(*entity.pose, config)?;
        let (size, config) = (entity.info.shape.size(), &vehicle.config);
        let room = size.x * config.wheelbase_share > 2.0 * config.wheel_radius
            && size.z > config.clearance + 0.1
            && size.y > 0.2;
        if !room {
            let reason = format!(
                "{:.2} x {:.2} x {:.2} m is too small for wheels of {} m radius and {} m clearance",
                size.x, size.y, size.z, config.wheel_radius, config.clearance
            );
            return Err(PhysicsError::Shape { id: entity.id, body: "vehicle", reason });
        }
        let state = BodyState { pose: *entity.pose, twist: *entity.twist };
        Ok(Self { size, state, ..vehicle })
    }

    /// The angle of the front wheels now, radians, positive to the left.
    pub fn wheel_angle(&self) -> f64 {
        self.controls.wheel_angle
    }
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
                let limit = self.config.steering_limit;
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
        postcard::to_allocvec(&("vehicle", &self.config, self.size, &self.controls, &self.wheels))
            .expect("plain numbers always serialise")
    }

    fn restore(&mut self, state: &BodyState, saved: &[u8]) -> bool {
        type Saved<'a> = (&'a str, VehicleConfig, Vector3, Controls, Option<DynamicRayCastVehicleController>);
        match postcard::from_bytes::<Saved<'_>>(saved) {
            Ok(("vehicle", config, size, controls, wheels)) if config.validate().is_ok() => {
                *self = Self { config, size, state: *state, controls, wheels };
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
