//! An episode of bodies under physics goes the same way on any number of threads, whether their queries are spread over them or not, and in
//! any process.

use std::process::Command;

use simworld_agents::episode::{Agent, Episode};
use simworld_agents::executor::RuleExecutor;
use simworld_agents::language::GrammarPlanner;
use simworld_agents::mind::{Mind, MindError};
use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::hash::{StateDigest, StateHasher};
use simworld_core::id::EntityId;
use simworld_core::intent::Intent;
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
use simworld_core::seam::{Metric, Outcome, Task, TaskContext, TaskError, TaskOutput};
use simworld_core::seed::Seed;
use simworld_core::simulation::Simulation;
use simworld_physics::{HumanoidConfig, PhysicsConfig, PhysicsDynamics};

/// Everybody is rewarded by where it is, so that returns tell places apart.
struct Gathering;

impl Task for Gathering {
    fn reset(&mut self, _: &dyn Scene, _: &[EntityId], _: Seed, _: &mut TaskOutput) -> Result<(), TaskError> {
        Ok(())
    }

    fn step(
        &mut self,
        context: &TaskContext<'_>,
        _: &mut TaskOutput,
        outcome: &mut Outcome,
    ) -> Result<(), TaskError> {
        let distance =
            |id: &EntityId| context.scene.entity(*id).map_or(0.0, |one| one.planar().coords.norm());
        outcome.rewards.extend(context.agents.iter().map(distance));
        Ok(())
    }

    fn metrics(&self) -> Vec<Metric> {
        Vec::new()
    }
}

/// Says one sentence, at the very beginning.
struct Says(String);

impl<T: ?Sized> Mind<T> for Says {
    fn decide(
        &mut self,
        _: &T,
        scene: &dyn Scene,
        _: EntityId,
        out: &mut Vec<Intent>,
    ) -> Result<(), MindError> {
        if scene.clock().tick().0 == 0 {
            out.push(Intent::Words(self.0.clone()));
        }
        Ok(())
    }
}

/// The two rows, and how far apart they stand, m.
const ROWS: [f64; 2] = [10.0, 22.0];

/// Two rows of people who change sides, past each other and past what stands in the middle.
fn episode(config: PhysicsConfig) -> Episode<Gathering> {
    let mut world = World::new();
    let at = |x: f64, y: f64| pose_facing(Point3::new(x, y, 0.0), 0.0);
    for (kind, x, size) in
        [(EntityKind::Building, 15.0, [3.0, 0.5, 2.0]), (EntityKind::Bench, 11.0, [0.6, 1.8, 0.8])]
    {
        let shape = Shape::cuboid(size[0], size[1], size[2]);
        world.spawn(EntityDesc::new(kind, at(x, 16.0), shape)).unwrap();
    }
    let mut said = Vec::new();
    for place in 0..12 {
        let (row, x) = (place % 2, 10 + place / 2 * 2);
        let shape = Shape::Capsule { radius: 0.25, height: 1.75 };
        let desc = EntityDesc::new(EntityKind::Person, at(f64::from(x), ROWS[row as usize]), shape);
        let other_side = ROWS[1 - row as usize];
        said.push((world.spawn(desc).unwrap(), format!("go to ({x}, {other_side})")));
    }
    let mut physics = PhysicsDynamics::new(config).unwrap();
    for (id, _) in &said {
        physics.add_humanoid(&world, *id, HumanoidConfig::default()).unwrap();
    }
    let mut simulation = Simulation::new(world);
    simulation.add_dynamics("physics", Box::new(physics));
    let agent = |(id, line)| Agent {
        id,
        mind: Box::new(Says(line)) as Box<dyn Mind<Gathering>>,
        planner: Box::new(GrammarPlanner::default()),
        executor: Box::new(RuleExecutor::straight()),
    };
    let agents = said.into_iter().map(agent).collect();
    let mut episode = Episode::new(simulation, Gathering, agents, Seed(1)).unwrap();
    episode.set_trail_interval(1);
    episode
}

/// The digest of a whole trajectory: the state after each step, and everybody's return.
fn trail(threads: usize, parallel_threshold: usize) -> StateDigest {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    pool.install(|| {
        let mut episode = episode(PhysicsConfig { parallel_threshold, ..PhysicsConfig::default() });
        for _ in 0..150 {
            episode.step().unwrap();
        }
        let world = episode.simulation().world();
        let crossed = episode.agents().iter().enumerate().filter(|(place, id)| {
            let start = ROWS[place % 2];
            world.entity(**id).is_some_and(|one| (one.planar().y - start).abs() > 6.0)
        });
        assert!(crossed.count() > 6, "hardly anybody came to the other side");
        let mut hasher = StateHasher::new();
        for (tick, digest) in episode.trail() {
            hasher.u64(tick.0).u64(digest.0);
        }
        for sum in episode.returns() {
            hasher.f64(*sum);
        }
        hasher.finish()
    })
}

/// Set in a child of this test, which prints its digest and does no more.
const CHILD: &str = "SIMWORLD_TEST_PRINT_TRAIL";

#[test]
fn threads_and_processes_do_not_matter() {
    let own = trail(1, usize::MAX);
    if std::env::var_os(CHILD).is_some() {
        println!("trail={own}");
        return;
    }
    for (threads, threshold) in [(1, 1), (2, 1), (8, 1), (8, 48)] {
        assert_eq!(trail(threads, threshold), own, "{threads} threads from {threshold} bodies on");
    }
    let arguments =
        ["--exact", "episodes_go_the_same_way::threads_and_processes_do_not_matter", "--nocapture"];
    let output =
        Command::new(std::env::current_exe().unwrap()).args(arguments).env(CHILD, "1").output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout);
    let told = text.split("trail=").nth(1).and_then(|rest| rest.split_whitespace().next());
    assert_eq!(told, Some(own.to_string().as_str()), "{text}");
}
