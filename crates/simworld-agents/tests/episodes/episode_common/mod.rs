//! A small field of kinematic walkers, a task of its own and minds that speak, for the tests of the episode driver.

use simworld_agents::episode::{Agent, Episode, EpisodeError};
use simworld_agents::executor::RuleExecutor;
use simworld_agents::language::GrammarPlanner;
use simworld_agents::mind::{Mind, MindError};
use simworld_core::command::Command;
use simworld_core::event::EventKind;
use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::hash::StateHasher;
use simworld_core::id::EntityId;
use simworld_core::intent::Intent;
use simworld_core::kinematic::{KinematicBody, KinematicDynamics};
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
use simworld_core::seam::{Goal, Metric, Outcome, Plan, Task, TaskContext, TaskError, TaskOutput};
use simworld_core::seed::Seed;
use simworld_core::simulation::Simulation;

/// Find the cone: it is put up at a random place, everybody is sent there once, and whoever gets near is rewarded. It
/// ends when as many plans are done as there are agents.
#[derive(Clone, Default)]
pub(crate) struct ConeHunt {
    pub(crate) steps: u64,
    pub(crate) plans_done: u64,
    pub(crate) cheers: u64,
    pub(crate) cone: Option<EntityId>,
    /// The step in which it fails.
    pub(crate) fails_at: Option<u64>,
    /// The step in which it asks for something impossible.
    pub(crate) errs_at: Option<u64>,
    /// The step in which the time is up.
    pub(crate) truncates_at: Option<u64>,
}

impl Task for ConeHunt {
    fn reset(
        &mut self,
        _: &dyn Scene,
        agents: &[EntityId],
        seed: Seed,
        out: &mut TaskOutput,
    ) -> Result<(), TaskError> {
        if agents.is_empty() {
            return Err(TaskError::Other("nobody hunts".into()));
        }
        let mut rng = seed.stream("cone").rng();
        let place = Point3::new(rng.uniform(20.0, 30.0), rng.uniform(-10.0, 10.0), 0.0);
        let cone = Shape::Cylinder { radius: 0.2, height: 0.7 };
        out.commands.push(Command::Spawn(Box::new(EntityDesc::new(
            EntityKind::Cone,
            pose_facing(place, 0.0),
            cone,
        ))));
        out.events.push(EventKind::task("cone_put_up", None));
        Ok(())
    }

    fn step(
        &mut self,
        context: &TaskContext<'_>,
        out: &mut TaskOutput,
        outcome: &mut Outcome,
    ) -> Result<(), TaskError> {
        self.steps += 1;
        if self.fails_at == Some(self.steps) {
            return Err(TaskError::Other("the hunt is called off".into()));
        }
        if self.errs_at == Some(self.steps) {
            out.commands.push(Command::Remove { id: EntityId::new(u32::MAX, 0) });
        }
        if self.steps == 1 {
            self.cone = context.spawned.first().copied();
            let cone = self.cone.ok_or_else(|| TaskError::Other("the cone was not put up".into()))?;
            out.plans.extend(context.agents.iter().map(|id| (*id, Plan::navigate(Goal::Entity(cone), 1.5))));
        }
        let done = |event: &&simworld_core::event::Event| matches!(event.kind, EventKind::PlanDone { .. });
        self.plans_done += context.events.iter().filter(done).count() as u64;
        let cone = self.cone.and_then(|id| context.scene.entity(id)).map(|cone| cone.planar());
        for id in context.agents {
            let near =
                context.scene.entity(*id).zip(cone).is_some_and(|(a, c)| (a.planar() - c).norm() < 2.0);
            let cheered = context.intents.iter().filter(|(who, _)| who == id).count() as u64;
            self.cheers += cheered;
            outcome.rewards.push(f64::from(u8::from(near)) + 10.0 * cheered as f64);
        }
        outcome.terminated = self.plans_done >= context.agents.len() as u64;
        outcome.truncated = self.truncates_at == Some(self.steps);
        Ok(())
    }

    fn metrics(&self) -> Vec<Metric> {
        vec![Metric::new("cheers", self.cheers as f64, "1")]
    }

    fn calls(&self) -> &'static [&'static str] {
        &["cheer"]
    }

    fn save(&self) -> Vec<u8> {
        let cone = self.cone.map_or(u64::MAX, u64::from);
        [self.steps, self.plans_done, self.cheers, cone].iter().flat_map(|n| n.to_le_bytes()).collect()
    }

    fn restore(&mut self, saved: &[u8]) -> bool {
        let numbers: Vec<u64> =
            saved.chunks_exact(8).map(|chunk| u64::from_le_bytes(chunk.try_into().unwrap())).collect();
        let [steps, plans_done, cheers, cone] = numbers[..] else { return false };
        let cone = (cone != u64::MAX).then(|| EntityId::from(cone));
        *self = Self { steps, plans_done, cheers, cone, ..self.clone() };
        true
    }

    fn state_hash(&self, hasher: &mut StateHasher) {
        hasher.bytes(&self.save());
    }
}

/// Says a sentence at certain ticks.
#[derive(Clone, Default)]
pub(crate) struct Speaker {
    pub(crate) lines: Vec<(u64, Intent)>,
    pub(crate) fails_at: Option<u64>,
}

impl<T: ?Sized> Mind<T> for Speaker {
    fn decide(
        &mut self,
        _: &T,
        scene: &dyn Scene,
        who: EntityId,
        out: &mut Vec<Intent>,
    ) -> Result<(), MindError> {
        let now = scene.clock().tick().0;
        if self.fails_at == Some(now) {
            return Err(MindError { who, reason: "nothing comes to mind".into() });
        }
        out.extend(self.lines.iter().filter(|(tick, _)| *tick == now).map(|(_, intent)| intent.clone()));
        Ok(())
    }
}

pub(crate) fn words(words: &str) -> Intent {
    Intent::Words(words.to_owned())
}

/// What the first walker says: a sentence, a call to the task, and nonsense.
pub(crate) fn script() -> Speaker {
    let lines = vec![
        (30, words("go to the nearest chair and sit down, wait 2 seconds, then stand up")),
        (35, Intent::call("cheer")),
        (40, words("abracadabra")),
    ];
    Speaker { lines, fails_at: None }
}

/// A field with a chair and two walkers.
pub(crate) fn field() -> (Simulation, Vec<EntityId>) {
    let mut world = World::new();
    let chair = pose_facing(Point3::new(5.0, -6.0, 0.0), 0.0);
    world.spawn(EntityDesc::new(EntityKind::Chair, chair, Shape::cuboid(0.5, 0.5, 0.9))).unwrap();
    let mut bodies = KinematicDynamics::new();
    let mut ids = Vec::new();
    for y in [0.0, 4.0] {
        let pose = pose_facing(Point3::new(0.0, y, 0.0), 0.0);
        let shape = Shape::Capsule { radius: 0.25, height: 1.8 };
        let id = world.spawn(EntityDesc::new(EntityKind::Person, pose, shape)).unwrap();
        bodies.insert(id, Box::new(KinematicBody::walker(pose)));
        ids.push(id);
    }
    let mut simulation = Simulation::new(world);
    simulation.add_dynamics("bodies", Box::new(bodies));
    (simulation, ids)
}

pub(crate) fn agent(id: EntityId, mind: impl Mind<ConeHunt> + 'static) -> Agent<ConeHunt> {
    let (planner, executor) = (Box::new(GrammarPlanner::default()), Box::new(RuleExecutor::straight()));
    Agent { id, mind: Box::new(mind), planner, executor }
}

/// The hunt on the field; the first walker says what `mind` does, the second nothing.
pub(crate) fn hunt(
    task: ConeHunt,
    mind: impl Mind<ConeHunt> + 'static,
    seed: Seed,
) -> Result<Episode<ConeHunt>, EpisodeError> {
    let (simulation, ids) = field();
    let agents = vec![agent(ids[0], mind), agent(ids[1], Speaker::default())];
    let mut episode = Episode::new(simulation, task, agents, seed)?;
    episode.set_trail_interval(1);
    Ok(episode)
}
