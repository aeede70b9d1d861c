//! The physics of a world: which bodies it has, and the step.

use std::any::Any;
use std::sync::Arc;

use rapier3d_f64::math::{Pose as RapierPose, Vector};
use rapier3d_f64::prelude::{ColliderHandle, PhysicsWorld, RigidBodyHandle, RigidBodySet};
use rayon::prelude::*;
use simworld_core::event::EventKind;
use simworld_core::geometry::{Point2, Point3, Pose, Twist};
use simworld_core::ground::Ground;
use simworld_core::hash::StateHasher;
use simworld_core::id::EntityId;
use simworld_core::scene::{Mark, Scene, World};
use simworld_core::seam::{BodyState, Dynamics, DynamicsError, Embodiment};

use crate::body::{BodyContext, Bonds, Detail, PhysicsBody, Surroundings};
use crate::cells::Cells;
use crate::claims::Claims;
use crate::contact::Contacts;
use crate::convert::{from_point, from_pose, from_vector, to_pose, to_vector};
use crate::grasp::Grasps;
use crate::ground;
use crate::humanoid::{Humanoid, Shove, least_blow};
use crate::mirror::Moving;
use crate::movers::Movers;
use crate::roam::Roamers;
use crate::roster::Roster;
use crate::slot_set::SlotSet;
use crate::solid::Solids;
use crate::stream::Districts;
use crate::surface::Conditions;
use crate::sync::Slot;
use crate::{PhysicsConfig, PhysicsError};

/// More substeps than this in a step are not taken, however finely a body would like to move.
const MOST_SUBSTEPS: f64 = 1000.0;

/// How many times the solver goes over a substep, as its makers set it.
const ITERATIONS: usize = 4;
/// The longest substep in which joints hold, s.
pub(crate) const LONGEST_JOINTED_SUBSTEP: f64 = 1.0 / 120.0;
/// In substeps up to this length it does so once, s.
const SHORT_SUBSTEP: f64 = 0.0051;

/// The bodies of a world under the laws of physics.
///
/// Solid things that do not move by themselves become fixed colliders, by the hulls of their asset's model if it has
/// one; traffic near a body of this physics becomes a moving obstacle; the entities that were given a body here are moved by it. A saved state
/// is taken up by a physics with the same settings in which the same entities have bodies of the same kinds.
///
/// ```
/// use simworld_core::action::Action;
/// use simworld_core::geometry::{Point3, pose_facing};
/// use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
/// use simworld_core::seam::Dynamics;
/// use simworld_physics::{HumanoidConfig, PhysicsConfig, PhysicsDynamics};
///
/// let mut world = World::new();
/// let wall = pose_facing(Point3::new(5.0, 0.0, 0.0), 0.0);
/// world.spawn(EntityDesc::new(EntityKind::Building, wall, Shape::cuboid(2.0, 20.0, 6.0)))?;
/// let shape = Shape::Capsule { radius: 0.25, height: 1.8 };
/// let start = pose_facing(Point3::origin(), 0.0);
/// let walker = world.spawn(EntityDesc::new(EntityKind::Person, start, shape))?;
/// let mut physics = PhysicsDynamics::new(PhysicsConfig::default())?;
/// physics.add_humanoid(&world, walker, HumanoidConfig::default())?;
/// world.actuate(walker, Action::MoveForward { speed: 1.4 })?;
/// for _ in 0..50 {
///     world.begin_step();
///     physics.step(&mut world, 0.1)?;
///     world.finish_step();
/// }
/// let x = world.entity(walker).unwrap().position().x;
/// assert!(x > 3.7 && x < 3.75); // the face of the wall is at 4 m, half a body away
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct PhysicsDynamics {
    pub(crate) config: PhysicsConfig,
    pub(crate) physics: PhysicsWorld,
    /// The collider of the ground, and the surface that it is, if the world has one.
    pub(crate) ground: ColliderHandle,
    pub(crate) surface: Option<Arc<Ground>>,
    /// What the physics makes of each slot of the world.
    pub(crate) slots: Vec<Slot>,
    /// Where fixed solids stand, while not all of them are in the engine.
    pub(crate) districts: Option<Districts>,
    /// The slots of what others move.
    pub(crate) traffic: SlotSet,
    /// The slots to be looked at in the next step, beside those that the world says.
    pub(crate) stale: SlotSet,
    /// When the world was looked at last; `None` to look at all of it.
    pub(crate) seen: Option<Mark>,
    /// By ascending id.
    pub(crate) bodies: Vec<Owned>,
    pub(crate) contacts: Contacts,
    /// What is held by hands.
    pub(crate) grasps: Grasps,
    /// What bodies meet of assets with a model.
    pub(crate) solids: Solids,
    /// What the air and the roads are like.
    pub(crate) conditions: Conditions,
    /// Where bodies move in full detail; everywhere, if there are none.
    pub(crate) interest: Vec<Point3>,
    /// Whether any body may be in reduced detail.
    pub(crate) detail_varies: bool,
    /// An empty set, lent to queries that must not know rigid bodies.
    pub(crate) nobody: RigidBodySet,
    /// Who of the bodies has a say between the engine's steps.
    pub(crate) roster: Roster,
    // Scratch space of a step.
    /// Where those bodies are in the list to which something may have been done in the world, ascending.
    pub(crate) displaced: Vec<usize>,
    pub(crate) moving: Vec<Moving>,
    /// Where the bodies of this physics are, and whether that was looked up in this step.
    pub(crate) near: Cells<Point2>,
    pub(crate) near_is_known: bool,
    /// Whether somebody may lose the footing, and what may knock somebody over.
    may_fall: bool,
    pub(crate) movers: Movers,
    /// Who moves by itself, for who asks.
    pub(crate) roamers: Roamers,
    claims: Claims,
    /// Who pushed whom in the last substep.
    pub(crate) shoves: Vec<Shove>,
    pub(crate) failures: Vec<EventKind>,
}

/// A body of this physics.
pub(crate) struct Owned {
    pub(crate) id: EntityId,
    pub(crate) body: Box<dyn PhysicsBody>,
    pub(crate) rigid: RigidBodyHandle,
    /// The pose that the physics wrote last; another one in the world means that somebody moved the entity.
    pub(crate) written: Pose,
    pub(crate) bonds: Bonds,
    /// Whether it only lies and falls.
    pub(crate) is_inert: bool,
    /// Whether the physics gave it its body by itself, and gives it again where a saved state has it.
    pub(crate) is_adopted: bool,
    /// Whether it moves by itself, out of the engine.
    pub(crate) is_roaming: bool,
    /// Velocity at the start of the substep, for the closing speed of contacts.
    pub(crate) before: Twist,
    /// How finely it is to move.
    pub(crate) detail: Detail,
}

impl Owned {
    /// Whether the engine has it: nothing carries it, and it does not roam.
    pub(crate) fn is_in_engine(&self) -> bool {
        self.bonds.carried.is_none() && !self.is_roaming
    }
}

impl PhysicsDynamics {
    /// A physics with a ground at z = 0 and no bodies. Where the world has a ground of its own, the first step takes it up.
    ///
    /// # Errors
    /// A setting out of range.
    pub fn new(config: PhysicsConfig) -> Result<Self, PhysicsError> {
        config.validate()?;
        let mut physics = PhysicsWorld::new();
        physics.gravity = Vector::new(0.0, 0.0, -config.gravity);
        let ground = physics.insert_collider(ground::level(&config), None);
        let near = config.mirror_radius;
        let mut dynamics = Self {
            config,
            physics,
            ground,
            surface: None,
            slots: Vec::new(),
            districts: None,
            traffic: SlotSet::default(),
            stale: SlotSet::default(),
            seen: None,
            bodies: Vec::new(),
            contacts: Contacts::default(),
            grasps: Grasps::default(),
            solids: Solids::default(),
            conditions: Conditions::default(),
            interest: Vec::new(),
            detail_varies: false,
            nobody: RigidBodySet::new(),
            roster: Roster::default(),
            displaced: Vec::new(),
            moving: Vec::new(),
            near: Cells::new(2.0 * near),
            near_is_known: false,
            may_fall: false,
            movers: Movers::default(),
            roamers: Roamers::default(),
            claims: Claims::default(),
            shoves: Vec::new(),
            failures: Vec::new(),
        };
        dynamics.file(ground);
        Ok(dynamics)
    }

    /// The settings.
    pub fn config(&self) -> &PhysicsConfig {
        &self.config
    }

    /// How many substeps `dt` s take, for what bodies need. And how many times the solver goes over one of them: once where a body asks for
    /// substeps so short that as many passes a second are made as with the usual ones.
    fn substeps(&self, dt: f64) -> (u32, usize) {
        let asked = self.minds().filter(|owned| owned.is_in_engine());
        let longest = asked.map(|owned| owned.body.longest_substep()).fold(f64::INFINITY, f64::min);
        let iterations = if longest <= SHORT_SUBSTEP { 1 } else { ITERATIONS };
        let longest =
            if self.grasps.list.is_empty() { longest } else { longest.min(LONGEST_JOINTED_SUBSTEP) };
        let needed = (dt / longest - 1e-9).ceil().clamp(1.0, MOST_SUBSTEPS);
        (needed as u32, iterations)
    }

    /// Passes on what bodies were told; what they refuse becomes an event.
    fn take_actions(&mut self, world: &mut World) {
        self.grasp_as_told(world);
        self.call_the_roll();
        for (who, action) in world.actuations() {
            let Ok(place) = self.position(*who) else { continue };
            if let Err(error) = self.bodies[place].body.apply(action) {
                let (action, reason) = (action.kind(), error.to_string());
                self.failures.push(EventKind::ActionFailed { who: *who, action, reason });
            }
        }
        for failure in self.failures.drain(..) {
            world.emit(failure);
        }
        for place in &self.roster.minds {
            let owned = &mut self.bodies[*place];
            owned.body.bind(owned.bonds);
        }
    }

    /// Lets every body look around; the state is frozen, so the order and the thread do not matter.
    fn sense(&mut self, dt: f64) {
        self.note_movers(dt);
        let (physics, nobody, config, conditions) =
            (&self.physics, &self.nobody, &self.config, &self.conditions);
        let (ground, surface) = (self.ground, self.surface.as_deref());
        let (movers, shoves, holds) = (&self.movers, &*self.shoves, &*self.grasps.holds);
        let sense = |owned: &mut Owned| {
            if !owned.is_inert && owned.is_in_engine() {
                let (rigid, detail) = (owned.rigid, owned.detail);
                let first = holds.partition_point(|hold| hold.who < owned.id);
                let count = holds[first..].partition_point(|hold| hold.who == owned.id);
                let around = Surroundings {
                    physics,
                    nobody,
                    rigid,
                    config,
                    conditions,
                    detail,
                    ground,
                    surface,
                    movers,
                    shoves,
                    holds: &holds[first..first + count],
                };
                owned.body.sense(&around, dt);
            }
        };
        let in_engine = |place: &&usize| self.bodies[**place].is_in_engine();
        if self.roster.minds.iter().filter(in_engine).nth(config.parallel_threshold - 1).is_some() {
            self.bodies.par_iter_mut().with_min_len(4).for_each(sense);
        } else {
            self.roster.minds.iter().for_each(|place| sense(&mut self.bodies[*place]));
        }
    }

    /// Notes what moves so fast that it may knock somebody over.
    fn note_movers(&mut self, dt: f64) {
        let slowest = least_blow(self.config.gravity);
        self.movers.clear();
        let may_fall = |owned: &Owned| owned.is_in_engine() && (&*owned.body as &dyn Any).is::<Humanoid>();
        let may_fall = self.minds().any(may_fall);
        self.may_fall = may_fall;
        if !self.may_fall {
            return;
        }
        let own = self.bodies.iter().filter(|owned| owned.is_in_engine());
        let own = own.flat_map(|owned| std::iter::once(&owned.rigid).chain(owned.body.parts()));
        let mirrored = self.moving.iter().map(|moving| &moving.rigid);
        for rigid in own.chain(mirrored) {
            self.movers.note(*rigid, slowest, dt, &self.physics);
        }
    }

    /// All substeps of a step of `dt` s: as many as the settings say, or more if a body needs it. Who falls in one of them needs finer ones
    /// from then on.
    fn take_substeps(&mut self, dt: f64) -> Result<(), PhysicsError> {
        let (needed, mut iterations) = self.substeps(dt);
        let mut count = needed.max(self.config.substeps);
        let (mut taken, mut begun, mut substep) = (0, 0.0, dt / f64::from(count));
        while taken < count {
            self.physics.integration_parameters.dt = substep;
            self.physics.integration_parameters.num_solver_iterations = iterations;
            taken += 1;
            let passed = if taken == count { dt } else { begun + substep * f64::from(taken) };
            self.substep(substep, passed / dt)?;
            if taken < count && self.may_fall {
                let (needed, finer) = self.substeps(dt - passed);
                if needed > count - taken {
                    (count, taken, iterations) = (needed, 0, finer);
                    (begun, substep) = (passed, (dt - passed) / f64::from(needed));
                }
            }
        }
        Ok(())
    }

    /// One substep: `share` of the world's step will have passed at its end.
    fn substep(&mut self, dt: f64, share: f64) -> Result<(), PhysicsError> {
        self.feel_grasps();
        self.sense(dt);
        self.claims.clear();
        self.shoves.clear();
        for place in &self.roster.minds {
            let owned = &mut self.bodies[*place];
            if owned.is_roaming {
                continue;
            }
            owned.before = owned.body.state().twist;
            if owned.bonds.carried.is_none() {
                let (physics, rigid, detail) = (&mut self.physics, owned.rigid, owned.detail);
                let (config, conditions) = (&self.config, &self.conditions);
                let (claims, shoves) = (&mut self.claims, &mut self.shoves);
                let mut context = BodyContext { physics, rigid, config, conditions, detail, claims, shoves };
                owned.body.drive(&mut context, dt);
            }
        }
        self.advance_mirrors(share);
        self.physics.step_with_events(&self.roster.filter, &());
        self.check_finite()?;
        self.strain_grasps(dt);
        self.contacts.unsolved.clear();
        for (place, owned) in self.bodies.iter_mut().enumerate().filter(|(_, owned)| owned.is_in_engine()) {
            let rigid = &self.physics.bodies[owned.rigid];
            if !rigid.is_dynamic() {
                self.contacts.unsolved.push(place);
            }
            let linear = from_vector(rigid.velocity_at_point(rigid.translation()));
            let twist = Twist { linear, angular: from_vector(rigid.angvel()) };
            if owned.is_inert {
                owned.before = owned.body.state().twist;
            } else {
                owned.body.observe(&self.physics, owned.rigid);
            }
            owned.body.settle(&BodyState { pose: from_pose(rigid.position()), twist });
        }
        self.find_contacts();
        Ok(())
    }

    fn check_finite(&self) -> Result<(), PhysicsError> {
        let quarantine = self.physics.quarantine();
        if quarantine.bodies().is_empty() && quarantine.colliders().is_empty() {
            return Ok(());
        }
        let caught = |owned: &&Owned| {
            let handles = std::iter::once(&owned.rigid).chain(owned.body.parts());
            let mut rigids = handles.filter_map(|handle| Some((handle, self.physics.bodies.get(*handle)?)));
            rigids.any(|(handle, rigid)| {
                quarantine.bodies().contains(handle)
                    || rigid.colliders().iter().any(|handle| quarantine.colliders().contains(handle))
            })
        };
        match self.bodies.iter().find(caught) {
            Some(owned) => Err(PhysicsError::NotFinite { id: owned.id }),
            None => Ok(()),
        }
    }

    /// Writes poses and velocities of whatever moved.
    fn write_back(&mut self, world: &mut World) -> Result<(), DynamicsError> {
        for owned in &mut self.bodies {
            if owned.bonds.carried.is_none() {
                let BodyState { pose, twist } = owned.body.state();
                owned.written = pose;
                world.set_motion(owned.id, pose, twist)?;
            }
            if !owned.is_inert {
                owned.body.report(owned.id, world)?;
            }
        }
        Ok(())
    }

    /// Puts a body somewhere else from outside.
    pub(crate) fn place(&mut self, index: usize, state: &BodyState) {
        let id = self.bodies[index].id;
        self.release(|grasp| grasp.who == id || grasp.thing == id);
        let owned = &mut self.bodies[index];
        owned.body.gather(&mut self.physics, owned.rigid);
        owned.body.place(state);
        let state = owned.body.state();
        owned.written = state.pose;
        let rigid = owned.rigid;
        let body = &mut self.physics.bodies[rigid];
        body.set_position(to_pose(&state.pose), true);
        // The engine's velocity is that of the centre of mass.
        let arm = from_vector(body.center_of_mass()) - state.pose.translation.vector;
        body.set_linvel(to_vector(&(state.twist.linear + state.twist.angular.cross(&arm))), true);
        body.set_angvel(to_vector(&state.twist.angular), true);
        self.file_body(rigid);
    }
}

impl Dynamics for PhysicsDynamics {
    fn step(&mut self, world: &mut World, dt: f64) -> Result<(), DynamicsError> {
        if !(dt.is_finite() && dt > 0.0) {
            return Err(DynamicsError::Other(format!("physics cannot step by {dt} s: give a positive time")));
        }
        self.set_conditions(Conditions::of(&world.environment().weather));
        self.throw_as_told(world);
        self.synchronise(world);
        self.choose_detail();
        self.take_actions(world);
        self.choose_roamers();
        self.roam(dt);
        self.take_substeps(dt)?;
        self.write_back(world)?;
        self.part_fallen_riders(world)?;
        self.contacts.report(world);
        self.report_grasps(world);
        Ok(())
    }

    fn save(&self) -> Result<Vec<u8>, DynamicsError> {
        Ok(self.to_bytes()?)
    }

    fn restore(&mut self, world: &World, saved: &[u8]) -> Result<(), DynamicsError> {
        Ok(self.take_up(world, saved)?)
    }

    fn state_hash(&self, hasher: &mut StateHasher) {
        self.hash_state(hasher);
    }
}

impl std::fmt::Debug for PhysicsDynamics {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("PhysicsDynamics")
            .field("config", &self.config)
            .field("bodies", &self.bodies.len())
            .field("colliders", &self.physics.colliders.len())
            .finish_non_exhaustive()
    }
}

/// A point of a collider in the world frame, given in the collider's own frame.
pub(crate) fn world_point(collider: &RapierPose, local: Vector) -> simworld_core::geometry::Point3 {
    from_point(*collider * local)
}
