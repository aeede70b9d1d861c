//! Who is told in words to wave has an arm in the air on pictures, as long as it waves.

use simworld_agents::episode::{Agent, Episode};
use simworld_agents::executor::RuleExecutor;
use simworld_agents::language::GrammarPlanner;
use simworld_agents::mind::{Mind, MindError};
use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::{Point2, Point3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::intent::Intent;
use simworld_core::scene::{EntityDesc, EntityKind, Gesture, Scene, Shape, World};
use simworld_core::seam::{Metric, Outcome, Task, TaskContext, TaskError, TaskOutput};
use simworld_core::seed::Seed;
use simworld_core::simulation::Simulation;
use simworld_physics::{HumanoidConfig, PhysicsConfig, PhysicsDynamics};
use simworld_render::{Frame, RenderConfig, RenderError, Renderer};

const HEIGHT: f64 = 1.75;

/// Nothing is to be done, and nothing ends it.
struct Idle;

impl Task for Idle {
    fn reset(&mut self, _: &dyn Scene, _: &[EntityId], _: Seed, _: &mut TaskOutput) -> Result<(), TaskError> {
        Ok(())
    }

    fn step(
        &mut self,
        _: &TaskContext<'_>,
        _: &mut TaskOutput,
        outcome: &mut Outcome,
    ) -> Result<(), TaskError> {
        outcome.rewards.push(0.0);
        Ok(())
    }

    fn metrics(&self) -> Vec<Metric> {
        Vec::new()
    }
}

/// Says one sentence in the tenth step.
struct Once(&'static str);

impl Mind<Idle> for Once {
    fn decide(
        &mut self,
        _: &Idle,
        scene: &dyn Scene,
        _: EntityId,
        out: &mut Vec<Intent>,
    ) -> Result<(), MindError> {
        if scene.clock().tick().0 == 10 {
            out.push(Intent::Words(self.0.to_owned()));
        }
        Ok(())
    }
}

/// The highest point of somebody on a picture from before it, m.
fn highest(renderer: &mut Renderer, world: &World, who: EntityId) -> f64 {
    let intrinsics = Intrinsics::from_fov(160, 160, 0.6).unwrap();
    let camera = Camera::looking_at(Point3::new(6.0, 0.0, 1.2), Point3::new(0.0, 0.0, 1.2), intrinsics);
    let mut frame = Frame::new();
    renderer.render(world, &camera, &mut frame).unwrap();
    let own = who.index() as u32 + 1;
    let heights = frame.ids.iter().zip(&frame.depth).enumerate().filter(|(_, (id, _))| **id == own);
    let height = |(index, (_, depth)): (usize, (&u32, &f32))| {
        let pixel = Point2::new((index % 160) as f64 + 0.5, (index / 160) as f64 + 0.5);
        (camera.world_from_optical * intrinsics.unproject(&pixel, f64::from(*depth))).z
    };
    heights.map(height).fold(0.0, f64::max)
}

#[test]
fn who_is_told_to_wave_at_anna_raises_an_arm_and_lowers_it_again() {
    let mut renderer = match Renderer::new(&RenderConfig::default()) {
        Ok(renderer) => renderer,
        Err(RenderError::NoAdapter { .. }) if std::env::var_os("SIMWORLD_REQUIRE_ADAPTER").is_none() => {
            return println!("skipped: no adapter");
        }
        Err(error) => panic!("{error}"),
    };
    let mut world = World::new();
    let person = |x: f64, y: f64| {
        let shape = Shape::Capsule { radius: 0.25, height: HEIGHT };
        EntityDesc::new(EntityKind::Person, pose_facing(Point3::new(x, y, 0.0), 0.0), shape)
    };
    let ground = Shape::cuboid(60.0, 60.0, 1.0);
    world
        .spawn(EntityDesc::new(EntityKind::Ground, pose_facing(Point3::new(0.0, 0.0, -1.0), 0.0), ground))
        .unwrap();
    let me = world.spawn(person(0.0, 0.0)).unwrap();
    world.spawn(person(8.0, 3.0).named("Anna")).unwrap();
    let mut physics = PhysicsDynamics::new(PhysicsConfig::default()).unwrap();
    physics.add_humanoid(&world, me, HumanoidConfig::default()).unwrap();
    let mut simulation = Simulation::new(world);
    simulation.add_dynamics("physics", Box::new(physics));
    let agent = Agent {
        id: me,
        mind: Box::new(Once("wave at Anna")) as Box<dyn Mind<Idle>>,
        planner: Box::new(GrammarPlanner::default()),
        executor: Box::new(RuleExecutor::straight()),
    };
    let mut episode = Episode::new(simulation, Idle, vec![agent], Seed(1)).unwrap();
    let mut seen = Vec::new();
    for _ in 0..80 {
        episode.step().unwrap();
        let world = episode.simulation().world();
        let waves = world.entity(me).unwrap().gesture() == Some(Gesture::Wave);
        seen.push((waves, highest(&mut renderer, world, me)));
    }
    let waving: Vec<f64> = seen.iter().filter(|(waves, _)| *waves).map(|(_, height)| *height).collect();
    let still: Vec<f64> = seen.iter().filter(|(waves, _)| !*waves).map(|(_, height)| *height).collect();
    assert!((20..30).contains(&waving.len()), "{} steps of waving", waving.len());
    assert!(!seen[5].0 && !seen[79].0, "it begins and ends");
    assert!(waving.iter().all(|height| *height > HEIGHT + 0.05), "a hand over the head: {waving:?}");
    assert!(still.iter().all(|height| *height < HEIGHT + 0.03), "and nothing there without: {still:?}");
}
