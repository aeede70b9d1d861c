//! Worlds in which the behaviour tests take place.
#![allow(dead_code, unreachable_pub, clippy::unwrap_used)]

use std::sync::Arc;

use nalgebra::UnitQuaternion;
use simworld_core::action::Action;
use simworld_core::event::EventKind;
use simworld_core::geometry::{Point2, Point3, Pose, Vector2, Vector3, pose_facing};
use simworld_core::ground::{Cover, Ground, GroundData};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
use simworld_core::seam::Dynamics;
use simworld_physics::{Command, HumanoidConfig, PhysicsConfig, PhysicsDynamics, Quadruped, QuadrupedConfig};

/// A person's shape.
pub const PERSON: Shape = Shape::Capsule { radius: 0.25, height: 1.75 };

/// A world with its physics, stepped together.
pub struct Stage {
    pub world: World,
    pub physics: PhysicsDynamics,
    /// The contacts of all steps so far.
    pub contacts: Vec<EventKind>,
    /// Other events of all steps so far.
    pub events: Vec<EventKind>,
}

impl Stage {
    pub fn new() -> Self {
        Self::with(PhysicsConfig::default())
    }

    pub fn with(config: PhysicsConfig) -> Self {
        let physics = PhysicsDynamics::new(config).unwrap();
        Self { world: World::new(), physics, contacts: Vec::new(), events: Vec::new() }
    }

    /// On land that rises and falls.
    pub fn on(ground: &Arc<Ground>) -> Self {
        let mut stage = Self::new();
        stage.world.set_ground(Arc::clone(ground));
        stage
    }

    pub fn spawn(&mut self, kind: EntityKind, pose: Pose, shape: Shape) -> EntityId {
        self.world.spawn(EntityDesc::new(kind, pose, shape)).unwrap()
    }

    /// A box standing at (x, y) with its sizes along the axes.
    pub fn building(&mut self, x: f64, y: f64, size: (f64, f64, f64)) -> EntityId {
        let shape = Shape::cuboid(size.0, size.1, size.2);
        self.spawn(EntityKind::Building, at(x, y, 0.0), shape)
    }

    /// A person with a body.
    pub fn person(&mut self, pose: Pose) -> EntityId {
        let id = self.spawn(EntityKind::Person, pose, PERSON);
        self.physics.add_humanoid(&self.world, id, HumanoidConfig::default()).unwrap();
        id
    }

    /// A robot dog on legs.
    pub fn legged_dog(&mut self, pose: Pose) -> EntityId {
        let id = self.spawn(EntityKind::Dog, pose, Shape::cuboid(0.7, 0.35, 0.5));
        self.physics.add_quadruped(&self.world, id, QuadrupedConfig::default()).unwrap();
        id
    }

    pub fn quadruped(&self, id: EntityId) -> &Quadruped {
        self.physics.body_as(id).unwrap()
    }

    pub fn quadruped_mut(&mut self, id: EntityId) -> &mut Quadruped {
        self.physics.body_as_mut(id).unwrap()
    }

    pub fn command(&mut self, id: EntityId, command: Command) {
        self.quadruped_mut(id).command(command);
    }

    /// How far upward the trunk's upward axis points.
    pub fn up(&self, id: EntityId) -> f64 {
        (self.world.entity(id).unwrap().pose.rotation * Vector3::z()).z
    }

    /// A ball of 0.1 m that flies from a place with a velocity.
    pub fn ball(&mut self, place: Point3, velocity: Vector3, mass: f64) -> EntityId {
        let shape = Shape::Sphere { radius: 0.1 };
        let mut desc = EntityDesc::new(EntityKind::Prop, pose_facing(place, 0.0), shape).weighing(mass);
        desc.twist.linear = velocity;
        let id = self.world.spawn(desc).unwrap();
        self.physics.add_rigid(&self.world, id).unwrap();
        id
    }

    /// One step of `dt` s, whatever the clock says.
    pub fn tick(&mut self, dt: f64) {
        self.world.begin_step();
        self.physics.step(&mut self.world, dt).unwrap();
        self.world.finish_step();
    }

    pub fn tell(&mut self, who: EntityId, action: Action) {
        self.world.actuate(who, action).unwrap();
    }

    pub fn step(&mut self) {
        self.world.begin_step();
        let dt = self.world.clock().dt();
        self.physics.step(&mut self.world, dt).unwrap();
        self.world.finish_step();
        for event in self.world.events() {
            match &event.kind {
                EventKind::Contact { .. } => self.contacts.push(event.kind.clone()),
                other => self.events.push(other.clone()),
            }
        }
    }

    /// Steps of 0.1 s.
    pub fn run(&mut self, steps: usize) {
        (0..steps).for_each(|_| self.step());
    }

    pub fn position(&self, id: EntityId) -> Point3 {
        self.world.entity(id).unwrap().position()
    }

    pub fn velocity(&self, id: EntityId) -> Vector3 {
        self.world.entity(id).unwrap().twist.linear
    }
}

/// Land of these heights, 2 m from point to point, not square and not in the middle.
pub fn land(height: impl Fn(Point2) -> f64) -> Arc<Ground> {
    let (columns, rows, origin) = (61, 41, Point2::new(-40.0, -30.0));
    let at = |index: u32| origin + Vector2::new(f64::from(index % columns), f64::from(index / columns)) * 2.0;
    let heights = (0..columns * rows).map(|index| height(at(index)) as f32).collect();
    let covers = vec![Cover::Grass; (columns * rows) as usize];
    Arc::new(
        Ground::new(GroundData { origin, spacing: 2.0, columns, rows, heights, covers, water: None })
            .expect("such heights are a ground"),
    )
}

/// Standing at a point, facing `yaw` radians from east.
pub fn at(x: f64, y: f64, yaw: f64) -> Pose {
    pose_facing(Point3::new(x, y, 0.0), yaw)
}

/// A long box whose upper face rises towards east at `slope` radians and meets the ground at x = `foot`.
pub fn ramp(foot: f64, slope: f64) -> (Pose, Shape) {
    let (length, thickness) = (20.0, 4.0);
    let tilt = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), -slope);
    // The middle of the upper face's lower edge is the body point (-length / 2, 0, thickness).
    let edge = tilt * Vector3::new(-length / 2.0, 0.0, thickness);
    let pose = Pose::from_parts((Vector3::new(foot, 0.0, 0.0) - edge).into(), tilt);
    (pose, Shape::cuboid(length, 10.0, thickness))
}
