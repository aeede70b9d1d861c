//! The same bodies in a loop on the engine that was written by hand, to compare with.

use simworld_core::action::Action;
use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityDesc, EntityKind, Shape, World};
use simworld_core::seam::Dynamics;
use simworld_physics::proving::ProvingError;
use simworld_physics::rapier::control::{CharacterAutostep, CharacterLength, KinematicCharacterController};
use simworld_physics::rapier::math::{Pose as RapierPose, Vector};
use simworld_physics::rapier::prelude::{
    CoefficientCombineRule, ColliderBuilder, ColliderHandle, PhysicsWorld, QueryFilter, RigidBodyBuilder,
    RigidBodyHandle,
};
use simworld_physics::{HumanoidConfig, Material, PhysicsConfig, PhysicsDynamics};

/// Length of a step, s.
const STEP: f64 = 1.0 / 60.0;

/// Where the n-th of many boxes begins to fall: in piles of ten.
fn in_piles(index: usize) -> [f64; 3] {
    let (pile, level) = (index / 10, index % 10);
    let across = pile % 10;
    [across as f64 * 3.0, (pile / 10) as f64 * 3.0, 0.1 + level as f64 * 1.05]
}

/// Boxes of half a metre that fall on one another, in an engine alone.
pub fn plain_boxes(count: usize) -> PhysicsWorld {
    let mut world = PhysicsWorld::new();
    world.gravity = Vector::new(0.0, 0.0, -9.81);
    world.integration_parameters.dt = STEP;
    let ground = ColliderBuilder::cuboid(1e5, 1e5, 50.0).translation(Vector::new(0.0, 0.0, -50.0));
    world.insert_collider(rubbing(ground, Material::Asphalt), None);
    for index in 0..count {
        let [x, y, z] = in_piles(index);
        let body = RigidBodyBuilder::dynamic().translation(Vector::new(x, y, z)).ccd_enabled(true);
        let solid =
            ColliderBuilder::cuboid(0.5, 0.5, 0.5).translation(Vector::new(0.0, 0.0, 0.5)).density(500.0);
        world.insert(body, rubbing(solid, Material::Concrete));
    }
    world
}

/// With the friction of a material, as in our physics: the piles fall the same way.
fn rubbing(solid: ColliderBuilder, material: Material) -> ColliderBuilder {
    let rule = CoefficientCombineRule::GeometricMean;
    solid.friction(material.friction()).friction_combine_rule(rule).restitution(material.restitution())
}

/// A loop on the engine as anybody writes it who does something with the bodies: each step, and then where they are, how they move
/// and which of them touch, in arrays.
pub struct Loop {
    world: PhysicsWorld,
    handles: Vec<RigidBodyHandle>,
    /// Pose, linear and angular velocity of each body.
    motions: Vec<(RapierPose, Vector, Vector)>,
    touching: Vec<(ColliderHandle, ColliderHandle)>,
}

impl Loop {
    /// Over the bodies of an engine.
    pub fn new(world: PhysicsWorld) -> Self {
        let handles: Vec<_> = world.bodies.iter().map(|(handle, _)| handle).collect();
        Self { world, motions: Vec::with_capacity(handles.len()), handles, touching: Vec::new() }
    }

    /// One step.
    pub fn step(&mut self) {
        self.world.step();
        self.motions.clear();
        self.touching.clear();
        let bodies = self.handles.iter().map(|handle| &self.world.bodies[*handle]);
        self.motions.extend(bodies.map(|body| (*body.position(), body.linvel(), body.angvel())));
        let touching = self.world.contact_pairs().filter(|pair| pair.has_any_active_contact());
        self.touching.extend(touching.map(|pair| (pair.collider1, pair.collider2)));
    }
}

/// The same boxes in a world of entities.
///
/// # Errors
/// The physics refuses a box.
pub fn our_boxes(count: usize) -> Result<(World, PhysicsDynamics), ProvingError> {
    let mut world = World::new();
    let mut physics = PhysicsDynamics::new(PhysicsConfig { substeps: 1, ..PhysicsConfig::default() })?;
    for index in 0..count {
        let [x, y, z] = in_piles(index);
        let pose = pose_facing(Point3::new(x, y, z), 0.0);
        let id = world.spawn(EntityDesc::new(EntityKind::Prop, pose, Shape::cuboid(1.0, 1.0, 1.0)))?;
        physics.add_rigid(&world, id)?;
    }
    Ok((world, physics))
}

/// One step of our physics.
///
/// # Errors
/// The physics cannot go on.
pub fn our_step(world: &mut World, physics: &mut PhysicsDynamics) -> Result<(), ProvingError> {
    world.begin_step();
    physics.step(world, STEP)?;
    world.finish_step();
    Ok(())
}

/// Where the n-th walker of many begins, and where the n-th post stands: rows with a post every 3 m beside the way.
fn in_rows(index: usize) -> [f64; 2] {
    [(index % 40) as f64 * 4.0, (index / 40) as f64 * 4.0]
}

/// Walkers on the character controller of an engine alone.
pub struct PlainWalkers {
    world: PhysicsWorld,
    walkers: Vec<RigidBodyHandle>,
    controller: KinematicCharacterController,
}

impl PlainWalkers {
    /// So many, each with a post beside its way.
    pub fn new(count: usize) -> Self {
        let mut world = PhysicsWorld::new();
        world.gravity = Vector::new(0.0, 0.0, -9.81);
        world.integration_parameters.dt = STEP;
        world.insert_collider(
            ColliderBuilder::cuboid(1e3, 1e3, 5.0).translation(Vector::new(0.0, 0.0, -5.0)),
            None,
        );
        let walkers = (0..count).map(|index| {
            let [x, y] = in_rows(index);
            let post = ColliderBuilder::cuboid(0.2, 0.2, 2.0).translation(Vector::new(x, y + 0.7, 2.0));
            world.insert_collider(post, None);
            let body = RigidBodyBuilder::kinematic_position_based().translation(Vector::new(x, y, 0.0));
            let solid = ColliderBuilder::cuboid(0.22, 0.22, 0.86).translation(Vector::new(0.0, 0.0, 0.89));
            world.insert(body, solid).0
        });
        let walkers = walkers.collect();
        let controller = KinematicCharacterController {
            up: Vector::Z,
            offset: CharacterLength::Absolute(0.02),
            autostep: Some(CharacterAutostep {
                max_height: CharacterLength::Absolute(0.25),
                min_width: CharacterLength::Absolute(0.1),
                include_dynamic_bodies: true,
            }),
            ..KinematicCharacterController::default()
        };
        world.step();
        Self { world, walkers, controller }
    }

    /// All go on for a step.
    pub fn step(&mut self) {
        for handle in &self.walkers {
            let body = &self.world.bodies[*handle];
            let at = *body.position();
            let collider = &self.world.colliders[body.colliders()[0]];
            let (solid, place) = (collider.shape(), *collider.position());
            let queries =
                self.world.query_pipeline_with_filter(QueryFilter::new().exclude_rigid_body(*handle));
            let wish = Vector::new(1.34 * STEP, 0.0, 0.0);
            let moved = self.controller.move_shape(STEP, &queries, solid, &place, wish, |_| {});
            let target = at.translation + moved.translation;
            if let Some(body) = self.world.bodies.get_mut(*handle) {
                body.set_next_kinematic_translation(target);
            }
        }
        self.world.step();
    }
}

/// The same walkers in a world of entities.
///
/// # Errors
/// The physics refuses somebody.
pub fn our_walkers(count: usize) -> Result<(World, PhysicsDynamics), ProvingError> {
    let mut world = World::new();
    let config = PhysicsConfig { substeps: 1, parallel_threshold: usize::MAX, ..PhysicsConfig::default() };
    let mut physics = PhysicsDynamics::new(config)?;
    let mut walkers: Vec<EntityId> = Vec::new();
    for index in 0..count {
        let [x, y] = in_rows(index);
        let post = pose_facing(Point3::new(x, y + 0.7, 0.0), 0.0);
        world.spawn(EntityDesc::new(EntityKind::Building, post, Shape::cuboid(0.4, 0.4, 4.0)))?;
        let pose = pose_facing(Point3::new(x, y, 0.0), 0.0);
        let shape = Shape::Capsule { radius: 0.25, height: 1.75 };
        walkers.push(world.spawn(EntityDesc::new(EntityKind::Person, pose, shape))?);
    }
    for id in walkers {
        physics.add_humanoid(&world, id, HumanoidConfig::default())?;
        world.actuate(id, Action::MoveForward { speed: 1.34 })?;
    }
    Ok((world, physics))
}
