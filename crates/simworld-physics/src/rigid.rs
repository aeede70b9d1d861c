//! A free rigid body: it falls, tumbles and comes to rest, and takes no orders.

use rapier3d_f64::prelude::{PhysicsWorld, RigidBodyBuilder, RigidBodyHandle, SharedShape};
use simworld_core::action::{Action, ActionSet};
use simworld_core::asset::Material;
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityRef, Shape};
use simworld_core::seam::{BodyState, Embodiment, EmbodimentError};

use crate::body::{BodyContext, PhysicsBody};
use crate::convert::{to_pose, to_vector};
use crate::shape::{collider_for, volume_of};
use crate::solid::with_solid;

/// Density of things whose mass nobody gave, kg/m³: about that of seasoned softwood.
const DENSITY: f64 = 500.0;

/// A free rigid body with the shape and mass of an entity.
#[derive(Clone)]
pub struct Rigid {
    state: BodyState,
    shape: Shape,
    mass: Option<f64>,
    material: Material,
    /// What bodies meet instead of the shape, in the body frame.
    solid: Option<SharedShape>,
}

impl Rigid {
    /// A body with the pose, velocity, shape and mass of an entity, and a material; without a mass it
    /// weighs what softwood would, 500 kg/m³.
    pub fn of(entity: &EntityRef<'_>, material: Material) -> Self {
        let state = BodyState { pose: *entity.pose, twist: *entity.twist };
        let mass = given_mass(entity);
        Self { state, shape: entity.info.shape, mass, material, solid: None }
    }

    /// With a solid of its own in the body frame, which bodies meet instead of the shape.
    #[must_use]
    pub fn with_solid(mut self, solid: SharedShape) -> Self {
        self.solid = Some(solid);
        self
    }
}

fn given_mass(entity: &EntityRef<'_>) -> Option<f64> {
    entity.info.mass.filter(|mass| mass.is_finite() && *mass > 0.0)
}

/// What an entity weighs as a free body, kg; by its shape where nobody gave it a mass.
pub(crate) fn mass_of(entity: &EntityRef<'_>) -> f64 {
    given_mass(entity).unwrap_or_else(|| DENSITY * volume_of(&entity.info.shape))
}

impl std::fmt::Debug for Rigid {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Rigid")
            .field("state", &self.state)
            .field("shape", &self.shape)
            .field("mass", &self.mass)
            .field("material", &self.material)
            .finish_non_exhaustive()
    }
}

impl Embodiment for Rigid {
    fn supports(&self) -> ActionSet {
        ActionSet::NONE
    }

    fn apply(&mut self, action: &Action) -> Result<(), EmbodimentError> {
        Err(EmbodimentError::Unsupported {
            action: action.kind(),
            supported: "only fall and tumble".to_owned(),
        })
    }

    fn state(&self) -> BodyState {
        self.state
    }

    fn restore(&mut self, state: &BodyState, saved: &[u8]) -> bool {
        self.state = *state;
        saved.is_empty()
    }
}

impl PhysicsBody for Rigid {
    fn attach(&mut self, id: EntityId, physics: &mut PhysicsWorld) -> RigidBodyHandle {
        let body = RigidBodyBuilder::dynamic()
            .pose(to_pose(&self.state.pose))
            .linvel(to_vector(&self.state.twist.linear))
            .angvel(to_vector(&self.state.twist.angular))
            .ccd_enabled(true);
        let collider = collider_for(&self.shape, id, self.material);
        let collider = match &self.solid {
            Some(solid) => with_solid(collider, solid.clone()),
            None => collider,
        };
        let collider = match self.mass {
            Some(mass) => collider.mass(mass),
            None => collider.density(DENSITY),
        };
        physics.insert(body, collider).0
    }

    fn is_inert(&self) -> bool {
        true
    }

    fn drive(&mut self, _: &mut BodyContext<'_>, _: f64) {}

    fn settle(&mut self, state: &BodyState) {
        self.state = *state;
    }
}
