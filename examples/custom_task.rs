//! Your own task: visit as many named places of a city as you can in two minutes, told in plain words.
//!
//! ```sh
//! cargo run --release --example custom_task
//! ```

use std::collections::BTreeSet;
use std::sync::Arc;

use simworld_agents::episode::{Agent, Episode};
use simworld_agents::executor::RuleExecutor;
use simworld_agents::language::GrammarPlanner;
use simworld_agents::mind::{Mind, MindError};
use simworld_citygen::{City, CityConfig};
use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::intent::Intent;
use simworld_core::net::{WaypointConfig, WaypointGraph};
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
use simworld_core::seam::{Metric, Outcome, Task, TaskContext, TaskError, TaskOutput};
use simworld_core::seed::Seed;
use simworld_core::simulation::Simulation;
use simworld_physics::{HumanoidConfig, PhysicsConfig, PhysicsDynamics};

/// A tour: one point for every named place reached for the first time.
#[derive(Default)]
struct Tour {
    steps: u32,
    visited: BTreeSet<EntityId>,
}

impl Task for Tour {
    fn reset(
        &mut self,
        _: &dyn Scene,
        agents: &[EntityId],
        _: Seed,
        _: &mut TaskOutput,
    ) -> Result<(), TaskError> {
        *self = Self::default();
        if agents.is_empty() { Err(TaskError::Other("a tour needs a tourist".to_owned())) } else { Ok(()) }
    }

    fn step(
        &mut self,
        context: &TaskContext<'_>,
        _: &mut TaskOutput,
        outcome: &mut Outcome,
    ) -> Result<(), TaskError> {
        self.steps += 1;
        let Some(tourist) = context.scene.entity(context.agents[0]) else { return Ok(()) };
        let here = context
            .scene
            .nearest(tourist.planar(), 12.0, &|place| place.info.name.is_some() && place.id != tourist.id);
        let arrived = here.filter(|place| (place.access().xy() - tourist.planar()).norm() < 2.0);
        let is_new = arrived.is_some_and(|place| self.visited.insert(place.id));
        outcome.rewards.push(f64::from(u8::from(is_new)));
        outcome.truncated = self.steps >= 1200;
        Ok(())
    }

    fn metrics(&self) -> Vec<Metric> {
        vec![Metric::new("places_visited", self.visited.len() as f64, "1")]
    }
}

/// Says where to go next, in words; waits until it is there.
struct Guide {
    sights: Vec<String>,
    next_decision: u64,
}

impl Mind<Tour> for Guide {
    fn decide(
        &mut self,
        _: &Tour,
        scene: &dyn Scene,
        _: EntityId,
        out: &mut Vec<Intent>,
    ) -> Result<(), MindError> {
        if scene.clock().tick().0 >= self.next_decision
            && let Some(sight) = self.sights.pop()
        {
            self.next_decision = scene.clock().tick().0 + 300;
            println!("{:5.1} s: go to {sight}", scene.clock().seconds());
            out.push(Intent::Words(format!("go to {sight}")));
        }
        Ok(())
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    if std::env::args().any(|argument| argument == "--help" || argument == "-h") {
        println!("Plays a task of one's own: a tour of named places, told in words. It takes no options.");
        return Ok(());
    }
    let city = City::generate(&CityConfig::with_roads(20), Seed(5))?;
    let mut world = World::new();
    city.populate(&mut world)?;
    let start = city.buildings.first().ok_or("a city without buildings")?.access;
    let pose = pose_facing(Point3::new(start.x, start.y, 0.0), 0.0);
    let person = EntityDesc::new(EntityKind::Person, pose, Shape::Capsule { radius: 0.25, height: 1.8 });
    let tourist = world.spawn(person)?;
    let mut physics = PhysicsDynamics::new(PhysicsConfig::default())?;
    physics.add_humanoid(&world, tourist, HumanoidConfig::default())?;
    let mut near: Vec<_> = city.buildings.iter().filter(|building| building.name.is_some()).collect();
    near.sort_by(|a, b| (b.access - start).norm().total_cmp(&(a.access - start).norm()));
    let sights = near.iter().filter_map(|building| building.name.clone()).collect();
    let mut simulation = Simulation::new(world);
    simulation.add_dynamics("physics", Box::new(physics));
    let ways = Arc::new(WaypointGraph::walkable(&city.network, &WaypointConfig::default())?);
    let agent = Agent {
        id: tourist,
        mind: Box::new(Guide { sights, next_decision: 0 }) as Box<dyn Mind<Tour>>,
        planner: Box::new(GrammarPlanner::default()),
        executor: Box::new(RuleExecutor::new(ways)),
    };
    let mut episode = Episode::new(simulation, Tour::default(), vec![agent], Seed(1))?;
    while !episode.is_over() {
        episode.step()?;
    }
    for metric in episode.task().metrics() {
        println!("{}: {}", metric.name, metric.value);
    }
    Ok(())
}
