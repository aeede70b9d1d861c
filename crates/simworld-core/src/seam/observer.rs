//! What an agent perceives.

use thiserror::Error;

use super::Space;
use crate::id::EntityId;
use crate::scene::Scene;

/// Why there is nothing to perceive.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ObserveError {
    /// The observed agent does not exist.
    #[error("there is no entity {id} to look through: it was removed, or never spawned")]
    Missing {
        /// The unknown id.
        id: EntityId,
    },
    /// The sensor failed.
    #[error("{0}")]
    Sensor(String),
}

/// A sense: it turns a scene, seen by somebody, into an observation.
///
/// The caller owns the output and passes the same buffer every step, so that a sense allocates only while its
/// buffer grows. Noise comes from streams indexed by tick and agent, so an observation depends on the scene and on
/// nothing that was observed before.
///
/// # Implementing it
///
/// ```
/// use std::ops::ControlFlow;
/// use simworld_core::geometry::Aabb;
/// use simworld_core::id::EntityId;
/// use simworld_core::scene::{EntityKind, Scene};
/// use simworld_core::seam::{ObserveError, Observer, Space};
///
/// /// How many people stand within ten metres.
/// struct Crowding;
///
/// impl Observer for Crowding {
///     type Observation = u32;
///
///     fn observe(&mut self, scene: &dyn Scene, who: EntityId, out: &mut u32) -> Result<(), ObserveError> {
///         let me = scene.entity(who).ok_or(ObserveError::Missing { id: who })?;
///         *out = 0;
///         let _ = scene.visit(&Aabb::column_around(me.planar(), 10.0), &mut |other| {
///             *out += u32::from(other.kind == EntityKind::Person && other.id != who);
///             ControlFlow::Continue(())
///         });
///         Ok(())
///     }
///
///     fn space(&self) -> Option<Space> { Some(Space::discrete(1000)) }
/// }
/// ```
pub trait Observer {
    /// What it yields; make a buffer of it once and pass it every step.
    type Observation;

    /// Writes what `who` perceives of the scene.
    ///
    /// # Errors
    /// Nobody is there, or the sensor failed; `out` is then unspecified.
    fn observe(
        &mut self,
        scene: &dyn Scene,
        who: EntityId,
        out: &mut Self::Observation,
    ) -> Result<(), ObserveError>;

    /// The space in which observations lie, for learners; `None` if they are no arrays.
    fn space(&self) -> Option<Space> {
        None
    }
}

macro_rules! forward_observer {
    ($($target:ty),+) => {
        $(impl<O: Observer + ?Sized> Observer for $target {
            type Observation = O::Observation;
            fn observe(
                &mut self,
                scene: &dyn Scene,
                who: EntityId,
                out: &mut Self::Observation,
            ) -> Result<(), ObserveError> {
                (**self).observe(scene, who, out)
            }
            fn space(&self) -> Option<Space> {
                (**self).space()
            }
        })+
    };
}
forward_observer!(Box<O>, &mut O);
