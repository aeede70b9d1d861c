//! One kinematic walker that carries out a plan, for the tests of the rule-based executor.

use simworld_agents::executor::RuleExecutor;
use simworld_core::action::Action;
use simworld_core::command::Command;
use simworld_core::geometry::{Point2, Point3, Pose, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::kinematic::{KinematicBody, KinematicDynamics};
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
use simworld_core::seam::{Executor, Goal, Plan, Progress};
use simworld_core::simulation::Simulation;

pub(crate) fn at(x: f64, y: f64) -> Pose {
    pose_facing(Point3::new(x, y, 0.0), 0.0)
}

pub(crate) fn thing(world: &mut World, kind: EntityKind, x: f64, y: f64, shape: Shape) -> EntityId {
    world.spawn(EntityDesc::new(kind, at(x, y), shape)).unwrap()
}

pub(crate) fn person(world: &mut World, x: f64, y: f64) -> EntityId {
    thing(world, EntityKind::Person, x, y, Shape::Capsule { radius: 0.25, height: 1.8 })
}

pub(crate) fn to(x: f64, y: f64) -> Plan {
    Plan::navigate(Goal::Point(Point3::new(x, y, 0.0)), 0.5)
}

/// A walker in a world, with what tells it.
pub(crate) struct Walk {
    pub(crate) simulation: Simulation,
    pub(crate) executor: RuleExecutor,
    pub(crate) me: EntityId,
    /// What it was told in the last step.
    pub(crate) told: Vec<Action>,
}

impl Walk {
    pub(crate) fn new(world: World, me: EntityId, executor: RuleExecutor, plan: Plan) -> Self {
        let mut bodies = KinematicDynamics::new();
        bodies.insert(me, Box::new(KinematicBody::walker(*world.entity(me).unwrap().pose)));
        let mut simulation = Simulation::new(world);
        simulation.add_dynamics("bodies", Box::new(bodies));
        let mut walk = Self { simulation, executor, me, told: Vec::new() };
        walk.executor.start(plan, walk.simulation.world(), me).unwrap();
        walk
    }

    /// One step; what the executor says of it.
    pub(crate) fn step(&mut self) -> Progress {
        self.told.clear();
        let progress = self.executor.advance(self.simulation.world(), self.me, &mut self.told).unwrap();
        for action in &self.told {
            self.simulation.submit(Command::Actuate { who: self.me, action: action.clone() });
        }
        self.simulation.step().unwrap();
        progress
    }

    /// Steps until the plan is done or given up, looking at every step; fails if it takes too long.
    pub(crate) fn finish(&mut self, most: usize, mut look: impl FnMut(&Self)) -> Progress {
        for _ in 0..most {
            let progress = self.step();
            look(self);
            if !progress.goes_on() {
                return progress;
            }
        }
        panic!("still under way after {most} steps, at {}", self.here());
    }

    pub(crate) fn here(&self) -> Point2 {
        self.simulation.world().entity(self.me).unwrap().planar()
    }

    /// The gap between the walker's middle and another thing's footprint, m.
    pub(crate) fn gap(&self, other: EntityId) -> f64 {
        let other = self.simulation.world().entity(other).unwrap();
        other.info.shape.planar_distance(other.pose, &self.here())
    }
}
