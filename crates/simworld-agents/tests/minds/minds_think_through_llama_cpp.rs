//! A real llama.cpp thinks for minds and steers by eyes, with a model of random weights: deeds, or errors that are told.
//!
//! What lies between a mind and a server is tried, nothing of thought. `ci/model-server` installs what this needs.
#![cfg(all(feature = "http", feature = "thought"))]

use crate::car_common::Bicycle;
use crate::minds_think_and_act::{TakeTheFarChair, alone};
use crate::model_server::ModelServer;
use crate::model_server::watch::{Exchange, Watch, as_asked, make_easy, without_pictures, words_of};
use simworld_agents::episode::Episode;
use simworld_agents::model::ChatRequest;
use simworld_agents::observer::Frame;
use simworld_agents::thought::{
    ModelReasoner, ReactConfig, ReactMind, Reasoner, VisualConfig, VisualExecutor,
};
use simworld_core::command::Command;
use simworld_core::event::EventKind;
use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::kinematic::{KinematicBody, KinematicDynamics};
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
use simworld_core::seam::{
    Embodiment, Executor, ExecutorError, Goal, ObserveError, Observer, Plan, Progress,
};
use simworld_core::simulation::Simulation;

/// Steps of an episode: more than all turns take.
const STEPS: usize = 2500;
const UNUSABLE: &str = "each first answer that does not conform is asked for again, and no other";

/// Asks the server, with answers of at most that many tokens.
fn reasoner(
    server: &ModelServer,
    watch: &Watch,
    seed: i64,
    tokens: u32,
    change: fn(&mut ChatRequest),
) -> Box<dyn Reasoner> {
    let reasoner = ModelReasoner::new(watch.model(server, change));
    Box::new(reasoner.with_temperature(1.0, Some(seed)).with_max_tokens(tokens))
}

/// What a mind came to.
#[derive(Debug, Default)]
struct Life {
    turns: usize,
    deeds: usize,
    faults: usize,
}

/// How the turn ended that an event is about, as the mind is to be told.
fn outcome_of(event: &EventKind, me: EntityId) -> Option<&'static str> {
    match event {
        EventKind::PlanDone { who } if *who == me => Some("→ done"),
        EventKind::PlanFailed { who, .. } if *who == me => Some("→ failed: "),
        EventKind::IntentRefused { who, .. } if *who == me => Some("→ refused: "),
        _ => None,
    }
}

/// Every step succeeds, and each turn is told in the next one how the last ended: its deed, or its unusable answer.
fn run_and_hear(episode: &mut Episode<TakeTheFarChair>, watch: &Watch) {
    let me = episode.agents()[0];
    let mut acts = false;
    let mut to_tell: Option<&str> = None;
    for _ in 0..STEPS {
        if episode.is_over() {
            return;
        }
        let before = watch.count();
        episode.step().expect("the episode goes on, whatever the model says");
        if watch.count() > before {
            let all = watch.all();
            let told = words_of(&all[before].request.messages[1]);
            let last = to_tell.take().unwrap_or_default();
            assert!(told.contains(last), "{last:?} is not told: {told}");
            acts = all.last().and_then(Exchange::value).is_some();
            to_tell = (!acts).then_some("no usable answer");
        }
        for event in episode.events() {
            // What an earlier deed comes to after a turn without one belongs to no turn.
            if acts && to_tell.is_none() {
                to_tell = outcome_of(&event.kind, me);
            }
        }
    }
}

/// A mind of so many turns in an episode; what it wanted is in the recording, and nothing else.
fn live(server: &ModelServer, seed: i64, most_turns: u32, change: fn(&mut ChatRequest)) -> Life {
    let watch = Watch::default();
    let config = ReactConfig {
        most_turns,
        tokens: 200,
        patience: 20.0,
        faults: 1000,
        rest: 1.0,
        ..ReactConfig::default()
    };
    let reasoner = reasoner(server, &watch, seed, 300, change);
    let mind = ReactMind::with_reasoner("Find a place to rest.", reasoner).with_config(config);
    let mut episode = alone(mind.expect("the settings are sound"));
    run_and_hear(&mut episode, &watch);

    let (turns, repairs) = watch.settled();
    assert_eq!(repairs, watch.faulty(), "{UNUSABLE}");
    let answers: Vec<_> = watch.all().iter().filter_map(Exchange::value).collect();
    let ends = answers.iter().filter(|answer| answer["deed"]["act"] == "finish").count();
    let deeds = answers.len() - ends;
    let me = episode.agents()[0];
    let recording = episode.recording();
    let wanted = recording
        .commands
        .iter()
        .filter(|stamped| matches!(&stamped.command, Command::Intend { who, .. } if *who == me));
    assert_eq!(wanted.count(), deeds, "each deed is wanted once, and nothing is wanted without an answer");
    let had_all = turns == most_turns as usize;
    assert!(had_all || ends == 1 || episode.is_over(), "{turns} turns of {most_turns}");
    Life { turns, deeds, faults: turns - answers.len() }
}

#[test]
fn a_mind_that_asks_a_real_server_acts_or_is_told_why_it_did_not() {
    let Some(server) = ModelServer::start() else { return };
    let rounds = if std::env::var_os("SIMWORLD_SOAK").is_some() { 30 } else { 3 };
    let mut all = Life::default();
    for seed in 0..rounds {
        // by the mind's own schema, or by what is easy of it
        let own = seed % 3 == 0;
        let (turns, change): (u32, fn(&mut ChatRequest)) = if own { (3, as_asked) } else { (5, make_easy) };
        let life = live(&server, seed, turns, change);
        println!("seed {seed}: {life:?}");
        all = Life {
            turns: all.turns + life.turns,
            deeds: all.deeds + life.deeds,
            faults: all.faults + life.faults,
        };
    }
    assert!(all.turns >= 3 && all.deeds + all.faults > 0, "{all:?}");
}

/// Sees nothing.
struct Dark;

impl Observer for Dark {
    type Observation = Frame;

    fn observe(&mut self, _: &dyn Scene, _: EntityId, out: &mut Frame) -> Result<(), ObserveError> {
        *out = Frame::black(16, 9);
        Ok(())
    }
}

/// A body that goes to a sign far out of its reach.
struct Walk {
    simulation: Simulation,
    executor: VisualExecutor,
    me: EntityId,
}

impl Walk {
    fn begin(kind: EntityKind, mut executor: VisualExecutor) -> Self {
        let mut world = World::new();
        let pose = pose_facing(Point3::origin(), 0.5);
        let (shape, body): (Shape, Box<dyn Embodiment>) = match kind {
            EntityKind::Car => (Shape::cuboid(4.5, 1.8, 1.5), Box::new(Bicycle::at(pose))),
            EntityKind::Dog => (Shape::cuboid(0.8, 0.3, 0.6), Box::new(KinematicBody::walker(pose))),
            _ => (Shape::Capsule { radius: 0.25, height: 1.8 }, Box::new(KinematicBody::walker(pose))),
        };
        let me = world.spawn(EntityDesc::new(kind, pose, shape)).expect("there is room");
        let far = pose_facing(Point3::new(500.0, 0.0, 0.0), 0.0);
        let sign = EntityDesc::new(EntityKind::Sign, far, Shape::Cylinder { radius: 0.3, height: 2.5 });
        let sign = world.spawn(sign).expect("there is room");
        let mut bodies = KinematicDynamics::new();
        bodies.insert(me, body);
        let mut simulation = Simulation::new(world);
        simulation.add_dynamics("bodies", Box::new(bodies));
        let plan = Plan::navigate(Goal::Entity(sign), 1.0);
        executor.start(plan, simulation.world(), me).expect("the plan is taken up");
        Self { simulation, executor, me }
    }

    /// Goes on until the plan ends or the steps do. What a body cannot do is refused, with a reason.
    fn end(mut self) -> Result<Progress, ExecutorError> {
        for _ in 0..STEPS {
            let mut actions = Vec::new();
            self.simulation.begin_step();
            let progress = self.executor.advance(self.simulation.world(), self.me, &mut actions)?;
            for action in actions {
                if let Err(error) = self.simulation.apply(&Command::Actuate { who: self.me, action }) {
                    assert!(!error.to_string().is_empty());
                }
            }
            self.simulation.finish_step().expect("bodies move");
            if !progress.goes_on() {
                return Ok(progress);
            }
        }
        Ok(Progress::Running)
    }
}

/// A model that takes no pictures refuses them: the run ends with what the server says, and nothing is taken for rest.
fn pictures_are_refused_by_the_blind(server: &ModelServer) {
    let watch = Watch::default();
    let executor = VisualExecutor::new(watch.model(server, as_asked), Dark);
    let error = Walk::begin(EntityKind::Person, executor).end().expect_err("nobody can see");
    let says = |reason: &str| reason.contains("status 400") && reason.contains("image_url");
    assert!(matches!(&error, ExecutorError::Backend(reason) if says(reason)), "{error}");
    let account = watch.account();
    assert_eq!((watch.count(), account.answered, account.failed), (1, 0, 1));
}

/// What is easy of a question whose pictures are left out.
fn easily_blind(request: &mut ChatRequest) {
    without_pictures(request);
    make_easy(request);
}

/// A body that is steered with its eyes shut; how many movements were asked for, and how many answers were unusable.
fn grope(server: &ModelServer, kind: EntityKind, seed: i64, change: fn(&mut ChatRequest)) -> (usize, usize) {
    let watch = Watch::default();
    let config = VisualConfig { most_movements: 3, claims: 9, faults: 1, ..VisualConfig::default() };
    let reasoner = reasoner(server, &watch, seed, 250, change);
    let executor = VisualExecutor::with_reasoner(reasoner, Dark).with_config(config);
    let walk = Walk::begin(kind, executor.expect("the settings are sound"));
    let ended = walk.end().expect("the executor works");
    let Progress::Failed { reason } = ended else { panic!("{kind}: {ended:?}") };
    let known = ["was not reached in 3 movements", "gave up on", "the answer cannot be used"];
    assert!(known.iter().any(|known| reason.contains(known)), "{reason}");

    let (movements, repairs) = watch.settled();
    assert!((1..=3).contains(&movements), "{movements} movements");
    assert_eq!(repairs, watch.faulty(), "{UNUSABLE}");
    let usable = watch.all().iter().filter_map(Exchange::value).count();
    (movements, movements - usable)
}

#[test]
fn eyes_that_ask_a_real_server_move_the_body_or_say_why_not() {
    let Some(server) = ModelServer::start() else { return };
    pictures_are_refused_by_the_blind(&server);
    let rounds = if std::env::var_os("SIMWORLD_SOAK").is_some() { 20 } else { 1 };
    let (mut movements, mut faults) = (0, 0);
    for kind in [EntityKind::Person, EntityKind::Dog, EntityKind::Car] {
        for seed in 0..rounds {
            for change in [without_pictures as fn(&mut ChatRequest), easily_blind] {
                let (asked, unusable) = grope(&server, kind, seed, change);
                (movements, faults) = (movements + asked, faults + unusable);
            }
        }
    }
    println!("{movements} movements asked for, {faults} without a usable answer");
    assert!(movements >= 6 && movements >= faults);
}
