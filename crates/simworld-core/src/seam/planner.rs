//! Intent to plan.

use thiserror::Error;

use super::Plan;
use crate::action::ActionKind;
use crate::id::EntityId;
use crate::intent::Intent;
use crate::scene::{EntityKind, Scene};

/// Why no plan was made. Whoever asked gets this, never a silent "do nothing".
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum PlanError {
    /// The words are not understood.
    #[error("cannot understand {words:?} at {fragment:?}: {hint}")]
    NotUnderstood {
        /// The whole sentence.
        words: String,
        /// Where it fails.
        fragment: String,
        /// What would be understood.
        hint: String,
    },
    /// The words are understood, but name nothing that is there.
    #[error("there is no {wanted} here: {near}")]
    NotFound {
        /// What was asked for.
        wanted: String,
        /// What is near instead.
        near: String,
    },
    /// The words fit several things, and nothing says which is meant.
    #[error("which {wanted}? it could be {}: say which", listed(candidates))]
    Ambiguous {
        /// What was asked for.
        wanted: String,
        /// What it could be, the likeliest first, each with how it is described.
        candidates: Vec<(EntityId, String)>,
    },
    /// A body of this kind never does that.
    #[error("a {kind} cannot {action}: {hint}")]
    Unable {
        /// What the agent is.
        kind: EntityKind,
        /// What was asked of it.
        action: ActionKind,
        /// What it can do.
        hint: String,
    },
    /// The call is unknown or its arguments are wrong.
    #[error("{call}: {reason}")]
    Call {
        /// The call.
        call: String,
        /// What is wrong, and what is allowed.
        reason: String,
    },
    /// The agent is not in the scene.
    #[error("there is no entity {id} to plan for")]
    Missing {
        /// The unknown id.
        id: EntityId,
    },
    /// A model answered, and its answer is no plan, not even after it was told why.
    #[error("no plan can be made of the model's answer: {fault}")]
    Answer {
        /// What is wrong with it.
        fault: String,
        /// Its beginning.
        answer: String,
    },
    /// The mind behind the planner failed.
    #[error("{0}")]
    Backend(String),
}

/// "chair #1 at 3 m or chair #2 at 5 m".
fn listed(candidates: &[(EntityId, String)]) -> String {
    let one = |(id, label): &(EntityId, String)| format!("{label} {id}");
    candidates.iter().map(one).collect::<Vec<_>>().join(" or ")
}

/// Turns what somebody wants into what is to be done.
///
/// # Implementing it
///
/// ```
/// use simworld_core::action::Action;
/// use simworld_core::geometry::{Point3, pose_facing};
/// use simworld_core::id::EntityId;
/// use simworld_core::intent::Intent;
/// use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
/// use simworld_core::seam::{Goal, Plan, PlanError, Planner};
///
/// /// Understands one word.
/// struct Sitter;
///
/// impl Planner for Sitter {
///     fn plan(&mut self, intent: &Intent, scene: &dyn Scene, who: EntityId) -> Result<Plan, PlanError> {
///         let me = scene.entity(who).ok_or(PlanError::Missing { id: who })?;
///         match intent {
///             Intent::Words(words) if words == "sit" => {
///                 let seat = scene.nearest(me.planar(), 200.0, &|e| e.kind.is_seat()).ok_or_else(|| {
///                     PlanError::NotFound { wanted: "seat".into(), near: "none within 200 m".into() }
///                 })?;
///                 Ok(Plan::navigate(Goal::Entity(seat.id), 1.0).then(Action::SitDown { seat: seat.id }))
///             }
///             other => Err(PlanError::Call { call: other.to_string(), reason: "say \"sit\"".into() }),
///         }
///     }
/// }
///
/// let mut world = World::new();
/// let bench = EntityDesc::new(
///     EntityKind::Bench, pose_facing(Point3::new(9.0, 0.0, 0.0), 0.0), Shape::cuboid(0.6, 1.8, 0.8));
/// let me = EntityDesc::new(
///     EntityKind::Person, pose_facing(Point3::origin(), 0.0), Shape::Capsule { radius: 0.25, height: 1.8 });
/// world.spawn(bench)?;
/// let me = world.spawn(me)?;
/// simworld_core::testing::check_planner(|| Box::new(Sitter), &world, me, &[Intent::Words("sit".into())]);
/// # Ok::<(), simworld_core::scene::WorldError>(())
/// ```
pub trait Planner {
    /// Plans for `who`.
    ///
    /// # Errors
    /// The intent is not understood, or names nothing that is there.
    fn plan(&mut self, intent: &Intent, scene: &dyn Scene, who: EntityId) -> Result<Plan, PlanError>;
}

macro_rules! forward_planner {
    ($($target:ty),+) => {
        $(impl<P: Planner + ?Sized> Planner for $target {
            fn plan(&mut self, intent: &Intent, scene: &dyn Scene, who: EntityId) -> Result<Plan, PlanError> {
                (**self).plan(intent, scene, who)
            }
        })+
    };
}
forward_planner!(Box<P>, &mut P);
