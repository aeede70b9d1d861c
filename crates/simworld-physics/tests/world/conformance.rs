//! The seams' own checks.
#![allow(clippy::unwrap_used)]

use crate::common::{PERSON, Stage, at, ramp};
use simworld_core::action::Action;
use simworld_core::command::Command;
use simworld_core::geometry::{Point3, Pose, Twist, Vector3, pose_facing};
use simworld_core::hash::{StateHash, StateHasher};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityKind, Scene, Shape, World};
use simworld_core::seam::{BodyState, Dynamics, DynamicsError};
use simworld_core::testing::{check_dynamics, check_embodiment};
use simworld_physics::{
    Humanoid, HumanoidConfig, PhysicsConfig, PhysicsDynamics, QuadrupedModel, Robot, RobotConfig, Vehicle,
    VehicleClass,
};

#[test]
fn humanoids_vehicles_and_robots_are_embodiments() {
    let pose = at(1.0, 2.0, 0.5);
    check_embodiment(|| Box::new(Humanoid::new(pose, HumanoidConfig::default()).unwrap()));
    check_embodiment(|| Box::new(Vehicle::new(pose, VehicleClass::Sedan.parameters()).unwrap()));
    let dog = QuadrupedModel::default().description();
    let state = BodyState { pose, twist: Twist::ZERO };
    check_embodiment(|| Box::new(Robot::new(state, RobotConfig::from(dog.clone())).unwrap()));
}

/// Physics whose bodies are told, by the clock alone, to walk, turn and drive; and traffic that passes by.
struct Directed {
    physics: PhysicsDynamics,
    walkers: Vec<EntityId>,
    car: EntityId,
    passer: EntityId,
}

impl Dynamics for Directed {
    fn step(&mut self, world: &mut World, dt: f64) -> Result<(), DynamicsError> {
        let tick = world.clock().tick().0;
        let mut orders = Vec::new();
        for (index, who) in self.walkers.iter().enumerate() {
            if tick.is_multiple_of(7) {
                orders.push((*who, Action::MoveForward { speed: 1.0 + index as f64 * 0.3 }));
                orders.push((*who, Action::Rotate { angle: 0.4 * index as f64 - 0.9 }));
            }
        }
        orders.push((self.car, Action::Throttle { level: 0.5 }));
        orders.push((self.car, Action::Steer { angle: 0.1 }));
        for (who, action) in orders {
            let _ = world.apply(&Command::Actuate { who, action });
        }
        let pose = at(tick as f64 * 0.8 - 14.0, 4.0, 0.0);
        world.set_motion(self.passer, pose, Twist::ZERO)?;
        self.physics.step(world, dt)
    }
    fn save(&self) -> Result<Vec<u8>, DynamicsError> {
        self.physics.save()
    }
    fn restore(&mut self, world: &World, saved: &[u8]) -> Result<(), DynamicsError> {
        self.physics.restore(world, saved)
    }
    fn state_hash(&self, hasher: &mut StateHasher) {
        Dynamics::state_hash(&self.physics, hasher);
    }
}

struct Yard {
    world: World,
    walkers: Vec<EntityId>,
    car: EntityId,
    passer: EntityId,
    boxes: Vec<EntityId>,
}

fn yard() -> Yard {
    let mut stage = Stage::new();
    for (x, y) in [(6.0, 0.0), (-6.0, 2.0), (0.0, 7.0)] {
        stage.building(x, y, (3.0, 5.0, 4.0));
    }
    let (pose, shape) = ramp(2.0, 0.3);
    stage.spawn(
        EntityKind::Building,
        Pose::from_parts((pose.translation.vector - Vector3::y() * 9.0).into(), pose.rotation),
        shape,
    );
    let walkers = (0..6)
        .map(|i| stage.spawn(EntityKind::Person, at(f64::from(i) - 3.0, -1.0, f64::from(i)), PERSON))
        .collect();
    let car = stage.spawn(EntityKind::Car, at(-12.0, -8.0, 0.2), Shape::cuboid(4.3, 1.8, 1.5));
    let passer = stage.spawn(EntityKind::Car, at(-14.0, 4.0, 0.0), Shape::cuboid(4.3, 1.8, 1.5));
    let boxes = (0..4)
        .map(|i| {
            let pose =
                pose_facing(Point3::new(0.1 * f64::from(i), 1.5, 1.0 + f64::from(i)), 0.2 * f64::from(i));
            stage.spawn(EntityKind::Prop, pose, Shape::cuboid(0.5, 0.5, 0.5))
        })
        .collect();
    Yard { world: stage.world, walkers, car, passer, boxes }
}

impl Yard {
    fn physics(&self, config: PhysicsConfig) -> Directed {
        let mut physics = PhysicsDynamics::new(config).unwrap();
        for id in &self.walkers {
            physics.add_humanoid(&self.world, *id, HumanoidConfig::default()).unwrap();
        }
        physics.add_vehicle(&self.world, self.car, VehicleClass::Sedan.parameters()).unwrap();
        for id in &self.boxes {
            physics.add_rigid(&self.world, *id).unwrap();
        }
        Directed { physics, walkers: self.walkers.clone(), car: self.car, passer: self.passer }
    }
}

#[test]
fn physics_repeats_saves_and_continues_bit_for_bit() {
    let yard = yard();
    check_dynamics(&yard.world, || Box::new(yard.physics(PhysicsConfig::default())));
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let yard = yard();
    let run = |threads: usize, parallel_threshold: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut world = yard.world.clone();
            let mut directed = yard.physics(PhysicsConfig { parallel_threshold, ..PhysicsConfig::default() });
            let mut trail = Vec::new();
            for _ in 0..60 {
                world.begin_step();
                directed.step(&mut world, 0.1).unwrap();
                world.finish_step();
                let mut hasher = StateHasher::new();
                world.state_hash(&mut hasher);
                StateHash::state_hash(&directed.physics, &mut hasher);
                trail.push(hasher.finish());
            }
            trail
        })
    };
    let serial = run(1, usize::MAX);
    for threads in [1, 2, 8] {
        assert_eq!(run(threads, 1), serial, "{threads} threads");
    }
}

#[test]
fn foreign_and_damaged_bytes_are_refused() {
    let yard = yard();
    let mut world = yard.world.clone();
    let mut directed = yard.physics(PhysicsConfig::default());
    directed.step(&mut world, 0.1).unwrap();
    let saved = directed.save().unwrap();
    let refusal = |saved: &[u8]| {
        let mut fresh = yard.physics(PhysicsConfig::default());
        fresh.restore(&world, saved).unwrap_err().to_string()
    };
    let mut flipped = saved.clone();
    flipped[saved.len() / 2] ^= 1;
    assert!(refusal(&flipped).contains("damaged"));
    assert!(refusal(&saved[..saved.len() - 1]).contains("damaged"));
    assert!(refusal(b"hello").contains("not this crate's"));
    let mut others = PhysicsDynamics::new(PhysicsConfig { substeps: 3, ..PhysicsConfig::default() }).unwrap();
    assert!(others.restore(&world, &saved).unwrap_err().to_string().contains("settings"));
    let mut empty = PhysicsDynamics::new(PhysicsConfig::default()).unwrap();
    assert!(empty.restore(&world, &saved).unwrap_err().to_string().contains("no body"));
    assert!(world.entity(yard.car).is_some());
}
