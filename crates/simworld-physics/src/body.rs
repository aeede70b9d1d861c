//! The seam by which a body joins the physics: what it implements and what it is given.

use std::any::Any;

use rapier3d_f64::prelude::{
    Collider, ColliderHandle, PhysicsWorld, QueryFilter, QueryPipeline, QueryPipelineMut, RigidBody,
    RigidBodyHandle, RigidBodySet,
};
use serde::{Deserialize, Serialize};
use simworld_core::geometry::Vector3;
use simworld_core::ground::Ground;
use simworld_core::id::EntityId;
use simworld_core::scene::{Role, World, WorldError};
use simworld_core::seam::{BodyState, Embodiment};

use crate::PhysicsConfig;
use crate::claims::{Claim, Claims};
use crate::grasp::Hold;
use crate::humanoid::Shove;
use crate::movers::Movers;
use crate::surface::Conditions;

/// How finely a body is to move.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Detail {
    /// By all the laws it knows.
    #[default]
    Full,
    /// By a simpler model, because it is far from what is of interest: what [can roam](PhysicsBody::can_roam) moves by itself, past
    /// everything else that moves. A body with one model only goes on as it is.
    Reduced,
}

/// What ties a body to other things this step, as the world knows it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bonds {
    /// How it hangs on a carrier (seated, aboard), if it does: then the carrier moves it.
    pub carried: Option<Role>,
    /// The scooter it rides.
    pub scooter: Option<EntityId>,
    /// Mass of what it has in the hand and in both arms, kg.
    pub load: f64,
}

/// An [`Embodiment`] that moves under the laws of a physics world.
///
/// Once a substep, [`sense`](Self::sense) lets every body look at the same frozen state, side by side on several
/// threads; then [`drive`](Self::drive) lets one after the other act on the engine, by ascending id. The engine
/// steps, and [`settle`](Self::settle) tells each body what became of it.
///
/// # Implementing it
///
/// A drone whose rotors carry its weight, and which climbs as fast as it is told:
///
/// ```
/// use simworld_core::action::{Action, ActionKind, ActionSet};
/// use simworld_core::geometry::{Pose, Twist, Vector3, pose_facing, Point3};
/// use simworld_core::id::EntityId;
/// use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
/// use simworld_core::seam::{BodyState, Dynamics, Embodiment, EmbodimentError};
/// use simworld_physics::rapier::prelude::{PhysicsWorld, RigidBodyBuilder, RigidBodyHandle};
/// use simworld_physics::{BodyContext, Material, PhysicsBody, PhysicsConfig, PhysicsDynamics, collider_for, convert};
///
/// struct Drone { state: BodyState, climb: f64 }
///
/// impl Embodiment for Drone {
///     fn supports(&self) -> ActionSet { ActionSet::of(&[ActionKind::MoveForward, ActionKind::Stop]) }
///     fn apply(&mut self, action: &Action) -> Result<(), EmbodimentError> {
///         self.climb = match action {
///             Action::MoveForward { speed } if (0.0..=20.0).contains(speed) => *speed,
///             Action::Stop => 0.0,
///             other => return Err(EmbodimentError::unsupported(other.kind(), self.supports())),
///         };
///         Ok(())
///     }
///     fn state(&self) -> BodyState { self.state }
/// }
///
/// impl PhysicsBody for Drone {
///     fn attach(&mut self, id: EntityId, physics: &mut PhysicsWorld) -> RigidBodyHandle {
///         let frame = RigidBodyBuilder::dynamic().pose(convert::to_pose(&self.state.pose)).gravity_scale(0.0);
///         let hull = collider_for(&Shape::Sphere { radius: 0.2 }, id, Material::Metal).mass(2.0);
///         physics.insert(frame, hull).0
///     }
///     fn drive(&mut self, context: &mut BodyContext<'_>, _: f64) {
///         let wanted = Vector3::z() * self.climb - self.state.twist.linear;
///         let rigid = context.rigid_body();
///         rigid.apply_impulse(convert::to_vector(&(wanted * rigid.mass())), true);
///     }
///     fn settle(&mut self, state: &BodyState) { self.state = *state; }
/// }
///
/// let mut world = World::new();
/// let start = pose_facing(Point3::new(0.0, 0.0, 5.0), 0.0);
/// let id = world.spawn(EntityDesc::new(EntityKind::Robot, start, Shape::Sphere { radius: 0.2 }))?;
/// let mut physics = PhysicsDynamics::new(PhysicsConfig::default())?;
/// let state = BodyState { pose: start, twist: Twist::ZERO };
/// physics.insert(&world, id, Box::new(Drone { state, climb: 0.0 }))?;
/// world.actuate(id, Action::MoveForward { speed: 1.0 })?;
/// for _ in 0..10 {
///     world.begin_step();
///     physics.step(&mut world, 0.1)?;
///     world.finish_step();
/// }
/// assert!((world.entity(id).unwrap().position().z - 6.0).abs() < 1e-3); // 1 m up in 1 s
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub trait PhysicsBody: Embodiment + Send + Any {
    /// Puts its rigid body and colliders into the engine at its present state. The frame of the rigid body is
    /// the entity's body frame, or [`settle`](Self::settle) undoes the difference; colliders carry the entity's mark
    /// ([`collider_for`](crate::collider_for) sets it).
    fn attach(&mut self, id: EntityId, physics: &mut PhysicsWorld) -> RigidBodyHandle;

    /// The rigid bodies that it has in the engine beside the first; none for most bodies. They have the entity's mark, and are
    /// its own business: it puts them in and takes them out.
    fn parts(&self) -> &[RigidBodyHandle] {
        &[]
    }

    /// Draws itself together into its first rigid body, without parts, because it is about to be carried, moved from
    /// outside or taken away.
    fn gather(&mut self, _physics: &mut PhysicsWorld, _rigid: RigidBodyHandle) {}

    /// Tells the world, once a step, what is to be seen of it beside pose and velocity; nothing by default.
    ///
    /// # Errors
    /// The world refuses.
    fn report(&mut self, _id: EntityId, _world: &mut World) -> Result<(), WorldError> {
        Ok(())
    }

    /// Whether it can hold on to things now; a body of most kinds always can.
    fn can_hold(&self) -> bool {
        true
    }

    /// Learns what it is tied to, once a step before it moves; of no interest to most bodies.
    fn bind(&mut self, _bonds: Bonds) {}

    /// The longest substep in which it moves well, s; the physics takes as many substeps as its bodies ask for, and
    /// at least those of the [`PhysicsConfig`]. Any length by default.
    fn longest_substep(&self) -> f64 {
        f64::INFINITY
    }

    /// Whether it only lies, falls and tumbles, as a crate does. What is inert is never bound, asked for a substep, sensed, driven, observed or
    /// let report, so that a heap of it costs next to nothing beside the engine; and it is inert for as long as the physics has it.
    fn is_inert(&self) -> bool {
        false
    }

    /// Looks around before anybody moves and makes up its mind; reads, and changes only itself.
    fn sense(&mut self, _around: &Surroundings<'_>, _dt: f64) {}

    /// Whether it can move on by [`roam`](Self::roam) now, where reduced detail will do; a body of most kinds cannot.
    fn can_roam(&self) -> bool {
        false
    }

    /// Moves on by a whole step of `dt` s by itself, far from what is of interest: it keeps off
    /// [what stands fixed](Surroundings::queries_of_fixed), and its own rigid body is out of the engine meanwhile. It takes the place of all
    /// substeps, and of [`sense`](Self::sense), [`drive`](Self::drive) and [`settle`](Self::settle) in them; its
    /// [state](Embodiment::state) says where it came to.
    fn roam(&mut self, _around: &Surroundings<'_>, _dt: f64) {}

    /// Acts on the engine for the coming substep of `dt` s: sets a kinematic target, applies impulses.
    fn drive(&mut self, context: &mut BodyContext<'_>, dt: f64);

    /// Looks at its parts after the engine's step, before it [settles](Self::settle); of no interest to a body of one part.
    fn observe(&mut self, _physics: &PhysicsWorld, _rigid: RigidBodyHandle) {}

    /// Takes up the state that the engine reached.
    fn settle(&mut self, state: &BodyState);

    /// Is put somewhere else from outside; by default it takes the state as it is given.
    fn place(&mut self, state: &BodyState) {
        self.settle(state);
    }
}

/// The frozen state around a body, for [`PhysicsBody::sense`].
#[derive(Clone, Copy)]
pub struct Surroundings<'a> {
    pub(crate) physics: &'a PhysicsWorld,
    pub(crate) nobody: &'a RigidBodySet,
    pub(crate) rigid: RigidBodyHandle,
    pub(crate) config: &'a PhysicsConfig,
    pub(crate) conditions: &'a Conditions,
    pub(crate) detail: Detail,
    pub(crate) ground: ColliderHandle,
    pub(crate) surface: Option<&'a Ground>,
    /// What moves so fast that it may knock somebody over.
    pub(crate) movers: &'a Movers,
    /// Who pushed whom in the last substep.
    pub(crate) shoves: &'a [Shove],
    /// What the body holds, as it feels it.
    pub(crate) holds: &'a [Hold],
}

impl Surroundings<'_> {
    /// Queries against every solid but the body's own.
    ///
    /// The pipeline knows colliders and not their rigid bodies, so that a character controller standing beside a
    /// passing car is blocked by it and not swept along, as it would be on a moving platform.
    pub fn queries(&self) -> QueryPipeline<'_> {
        let filter = QueryFilter::new().exclude_rigid_body(self.rigid);
        QueryPipeline { bodies: self.nobody, ..self.physics.query_pipeline_with_filter(filter) }
    }

    /// Queries against every solid but the body's own and the ground: for who stands on the
    /// [surface](Self::surface) by its heights.
    pub fn queries_above_ground(&self) -> QueryPipeline<'_> {
        let filter = QueryFilter::new().exclude_rigid_body(self.rigid).exclude_collider(self.ground);
        QueryPipeline { bodies: self.nobody, ..self.physics.query_pipeline_with_filter(filter) }
    }

    /// Queries against what stands fixed, and the ground.
    pub fn queries_of_fixed(&self) -> QueryPipeline<'_> {
        self.physics.query_pipeline_with_filter(QueryFilter::only_fixed())
    }

    /// The surface that everything stands on, if the ground is not level at z = 0.
    pub fn surface(&self) -> Option<&Ground> {
        self.surface
    }

    /// The body's own collider, the first if it has several.
    pub fn collider(&self) -> Option<&Collider> {
        let first = self.physics.bodies.get(self.rigid)?.colliders().first()?;
        self.physics.colliders.get(*first)
    }

    /// Whether the engine has put the body to sleep because it rests.
    pub fn is_sleeping(&self) -> bool {
        self.physics.bodies.get(self.rigid).is_some_and(RigidBody::is_sleeping)
    }

    /// What the air and the roads are like.
    pub fn conditions(&self) -> &Conditions {
        self.conditions
    }

    /// How finely the body is to move in this substep.
    pub fn detail(&self) -> Detail {
        self.detail
    }

    /// The settings of the physics.
    pub fn config(&self) -> &PhysicsConfig {
        self.config
    }
}

/// What a body may act on, for [`PhysicsBody::drive`].
pub struct BodyContext<'a> {
    pub(crate) physics: &'a mut PhysicsWorld,
    pub(crate) rigid: RigidBodyHandle,
    pub(crate) config: &'a PhysicsConfig,
    pub(crate) conditions: &'a Conditions,
    pub(crate) detail: Detail,
    pub(crate) claims: &'a mut Claims,
    pub(crate) shoves: &'a mut Vec<Shove>,
}

impl BodyContext<'_> {
    /// The body's own rigid body.
    pub fn rigid_body(&mut self) -> &mut RigidBody {
        self.physics.bodies.get_mut(self.rigid).expect("a body in the list has its rigid body in the engine")
    }

    /// The handle of the body's own rigid body.
    pub fn handle(&self) -> RigidBodyHandle {
        self.rigid
    }

    /// Queries that may change bodies, against every solid but the body's own.
    pub fn queries_mut(&mut self) -> QueryPipelineMut<'_> {
        let world = &mut *self.physics;
        world.broad_phase.as_query_pipeline_mut(
            world.narrow_phase.query_dispatcher(),
            &mut world.bodies,
            &mut world.colliders,
            QueryFilter::new().exclude_rigid_body(self.rigid),
        )
    }

    /// What the air and the roads are like.
    pub fn conditions(&self) -> &Conditions {
        self.conditions
    }

    /// How finely the body is to move in this substep.
    pub fn detail(&self) -> Detail {
        self.detail
    }

    /// The settings of the physics.
    pub fn config(&self) -> &PhysicsConfig {
        self.config
    }

    /// How much of a displacement leads to no overlap with the room that bodies before this one have taken in
    /// this substep: a share in [0, 1]. Moving away from an overlap is free.
    pub fn free_share(&self, room: &Claim, displacement: &Vector3, gap: f64) -> f64 {
        self.claims.free_share(room, displacement, gap)
    }

    /// Takes room for this substep, which bodies after this one then respect.
    pub fn claim(&mut self, room: Claim) {
        self.claims.take(room);
    }
}
