//! A cart on wheels, which moves as hands at its handle, slopes and blows move it.
//!
//! The chassis is a box that clears the ground, with a wheel under each corner, round as a ball; a castor rolls whichever way it is led,
//! without the trail of a real one, and wheels have no inertia of their own. Lengths are m.

mod physics_body;

use serde::{Deserialize, Serialize};
use simworld_core::action::{Action, ActionSet};
use simworld_core::geometry::{Point3, Vector3};
use simworld_core::scene::{EntityRef, Shape};
use simworld_core::seam::{BodyState, Embodiment, EmbodimentError};

use crate::error::{PhysicsError, check_range};

/// Mass of a cart that says nothing of it, kg: shopping trolleys weigh 20 to 30 kg.
const MASS: f64 = 25.0;

/// Which of the wheels swivel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Castors {
    /// Those in front; the others keep the cart to its way.
    #[default]
    Front,
    /// All of them: it goes sideways as well.
    All,
    /// None: it goes straight on.
    None,
}

/// How a cart runs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct CartConfig {
    /// Which wheels swivel.
    pub castors: Castors,
    /// Radius of the wheels, m, 0.02 to 0.5.
    pub wheel_radius: f64,
    /// Force that keeps it rolling on the level as a share of its weight, 0 to 0.5. Rubber castors on smooth floors take 0.01 to 0.03.
    pub rolling_resistance: f64,
    /// Height of the handle over the ground, m, 0.1 to 2; hands push best between hip and elbow.
    pub handle: f64,
}

impl Default for CartConfig {
    fn default() -> Self {
        Self { castors: Castors::Front, wheel_radius: 0.0625, rolling_resistance: 0.02, handle: 1.0 }
    }
}

impl CartConfig {
    /// Checks every field.
    ///
    /// # Errors
    /// The first field out of range, with what is allowed.
    pub fn validate(&self) -> Result<(), PhysicsError> {
        let check = |field, value, range, allowed| check_range("CartConfig", field, value, range, allowed);
        check("wheel_radius", self.wheel_radius, 0.02..=0.5, "0.02 to 0.5 m")?;
        check("rolling_resistance", self.rolling_resistance, 0.0..=0.5, "0 to 0.5")?;
        check("handle", self.handle, 0.1..=2.0, "0.1 to 2 m")
    }
}

/// A cart, made by [`PhysicsDynamics::add_cart`](crate::PhysicsDynamics::add_cart).
///
/// It runs ahead along x and has its handle behind. Who takes [hold](crate::PhysicsDynamics::grasp) of that pushes, pulls and steers it;
/// what lies on it rides by friction. It rolls down slopes by itself and stops at what its wheels do not climb.
#[derive(Clone, Debug)]
pub struct Cart {
    config: CartConfig,
    size: Vector3,
    mass: f64,
    state: BodyState,
    /// With how much force the ground holds each wheel, N.
    loads: [f64; 4],
    /// Whether it stands, so that its joints need no short substeps.
    rests: bool,
}

impl Cart {
    /// A cart with the pose, velocity, size and mass of an entity.
    ///
    /// # Errors
    /// A setting out of range, or a shape without room for the wheels.
    pub fn of(entity: &EntityRef<'_>, config: CartConfig) -> Result<Self, PhysicsError> {
        config.validate()?;
        let size = entity.info.shape.size();
        let wide = 4.0 * config.wheel_radius;
        let fits = size.x > wide && size.y > wide && size.z > wide;
        if !matches!(entity.info.shape, Shape::Box { .. }) || !fits {
            let reason = format!("give a box longer, wider and taller than {wide} m, four radii of a wheel");
            return Err(PhysicsError::Shape { id: entity.id, body: "cart", reason });
        }
        let mass = entity.info.mass.filter(|mass| (0.1..=1e5).contains(mass)).unwrap_or(MASS);
        let state = BodyState { pose: *entity.pose, twist: *entity.twist };
        Ok(Self { config, size, mass, state, loads: [0.0; 4], rests: false })
    }

    /// Where its handle is, world frame, m.
    pub fn handle(&self) -> Point3 {
        self.state.pose * Point3::new(-0.5 * self.size.x, 0.0, self.config.handle)
    }

    /// With how much force the ground held each wheel in the last substep, N: front left, front right, rear left, rear right.
    pub fn loads(&self) -> [f64; 4] {
        self.loads
    }

    /// Where the middles of the wheels are, body frame: front left, front right, rear left, rear right.
    fn axles(&self) -> [Vector3; 4] {
        let radius = self.config.wheel_radius;
        let (x, y) = (0.5 * self.size.x - radius, 0.5 * self.size.y - radius);
        [[x, y], [x, -y], [-x, y], [-x, -y]].map(|[x, y]| Vector3::new(x, y, radius))
    }
}

impl Embodiment for Cart {
    fn supports(&self) -> ActionSet {
        ActionSet::NONE
    }

    fn apply(&mut self, action: &Action) -> Result<(), EmbodimentError> {
        let supported = "roll: whoever holds its handle pushes and pulls it".to_owned();
        Err(EmbodimentError::Unsupported { action: action.kind(), supported })
    }

    fn state(&self) -> BodyState {
        self.state
    }

    fn save(&self) -> Vec<u8> {
        let Self { config, size, mass, loads, rests, .. } = self;
        postcard::to_allocvec(&("cart", config, size, mass, (loads, rests)))
            .expect("plain numbers always serialise")
    }

    fn restore(&mut self, state: &BodyState, saved: &[u8]) -> bool {
        type Inner = ([f64; 4], bool);
        type Saved<'a> = (&'a str, CartConfig, Vector3, f64, Inner);
        match postcard::from_bytes::<Saved<'_>>(saved) {
            Ok(("cart", config, size, mass, (loads, rests))) if config.validate().is_ok() => {
                *self = Self { config, size, mass, state: *state, loads, rests };
                true
            }
            _ => false,
        }
    }
}
