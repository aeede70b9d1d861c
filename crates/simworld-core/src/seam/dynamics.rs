//! The glue by which a crate moves a world.

use thiserror::Error;

use crate::hash::StateHasher;
use crate::scene::World;

/// Why a part of the simulation could not go on.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum DynamicsError {
    /// The world refused what the dynamics wrote.
    #[error(transparent)]
    World(#[from] crate::scene::WorldError),
    /// Saved bytes that are not this part's.
    #[error("its saved state cannot be read: {0}")]
    Saved(String),
    /// Anything else, in words.
    #[error("{0}")]
    Other(String),
}

/// Something that moves a world by one step: traffic, physics, a crowd, the tide.
///
/// It reads the world as it was at the start of the step, reads what bodies were told
/// ([`World::actuations`]), and writes poses and events. Implementations hold their own arrays; the seam is
/// crossed once a step, never once a body.
///
/// # Implementing it
///
/// ```
/// use simworld_core::geometry::{Pose, Twist};
/// use simworld_core::id::EntityId;
/// use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
/// use simworld_core::seam::{Dynamics, DynamicsError};
///
/// /// A balloon that rises at a constant speed; all its state is in the world.
/// struct Balloon(EntityId);
///
/// impl Dynamics for Balloon {
///     fn step(&mut self, world: &mut World, dt: f64) -> Result<(), DynamicsError> {
///         let Some(balloon) = world.entity(self.0) else { return Ok(()) };
///         let (mut pose, mut twist) = (*balloon.pose, Twist::ZERO);
///         twist.linear.z = 0.5;
///         pose.translation.z += 0.5 * dt;
///         Ok(world.set_motion(self.0, pose, twist)?)
///     }
///
///     fn save(&self) -> Result<Vec<u8>, DynamicsError> { Ok(Vec::new()) }
///
///     fn restore(&mut self, _: &World, _: &[u8]) -> Result<(), DynamicsError> { Ok(()) }
/// }
///
/// let mut world = World::new();
/// let id = world.spawn(EntityDesc::new(EntityKind::Prop, Pose::identity(), Shape::Sphere { radius: 0.2 }))?;
/// simworld_core::testing::check_dynamics(&world, || Box::new(Balloon(id)));
/// # Ok::<(), simworld_core::scene::WorldError>(())
/// ```
pub trait Dynamics {
    /// Moves the world on by `dt` s.
    ///
    /// # Errors
    /// It cannot go on; the episode ends with this error and the state is kept.
    fn step(&mut self, world: &mut World, dt: f64) -> Result<(), DynamicsError>;

    /// The inner state as bytes, such that [`restore`](Self::restore) continues bit for bit.
    ///
    /// # Errors
    /// It cannot be saved.
    fn save(&self) -> Result<Vec<u8>, DynamicsError>;

    /// Takes up a saved state; `world` is already the one it was saved with.
    ///
    /// # Errors
    /// The bytes are damaged or somebody else's.
    fn restore(&mut self, world: &World, saved: &[u8]) -> Result<(), DynamicsError>;

    /// Feeds inner state that influences the future and is not in the world; nothing by default.
    fn state_hash(&self, _hasher: &mut StateHasher) {}
}

macro_rules! forward_dynamics {
    ($($target:ty),+) => {
        $(impl<D: Dynamics + ?Sized> Dynamics for $target {
            fn step(&mut self, world: &mut World, dt: f64) -> Result<(), DynamicsError> {
                (**self).step(world, dt)
            }
            fn save(&self) -> Result<Vec<u8>, DynamicsError> {
                (**self).save()
            }
            fn restore(&mut self, world: &World, saved: &[u8]) -> Result<(), DynamicsError> {
                (**self).restore(world, saved)
            }
            fn state_hash(&self, hasher: &mut StateHasher) {
                (**self).state_hash(hasher);
            }
        })+
    };
}
forward_dynamics!(Box<D>, &mut D);
