//! Bodies steered by what a camera shows: a camera that paints posts, and a model that finds the red ones in the pixels.
#![cfg(feature = "thought")]

mod field;

use std::sync::Arc;

use self::field::{BLUE_POST, DOG, DRIVER, PERSON, POST, RADIUS, RED_POST, VEHICLE, bodies, field, to_red};
use crate::thought_common::{Asked, answering, model, text};
use simworld_agents::model::{ChatRequest, ModelError, NoModel, Part, Recorded, Tape};
use simworld_agents::observer::Frame;
use simworld_agents::thought::{VisualConfig, VisualExecutor};
use simworld_core::action::Action;
use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::command::Command;
use simworld_core::geometry::{Pose, Vector3, pose_facing, yaw_of};
use simworld_core::hash::StateHasher;
use simworld_core::id::EntityId;
use simworld_core::ops::{atan2, hypot};
use simworld_core::scene::{Attachment, Role, Scene};
use simworld_core::seam::{
    Condition, Executor, ExecutorError, Goal, ObserveError, Observer, Plan, PlanStep, Progress, Which,
};
use simworld_core::simulation::Simulation;
use simworld_core::testing::check_executor;

/// Paints what is coloured as upright bars, the farthest first.
struct Painter;

fn optics() -> Intrinsics {
    Intrinsics::from_fov(160, 90, std::f64::consts::FRAC_PI_2).expect("a camera like this can be")
}

impl Observer for Painter {
    type Observation = Frame;

    fn observe(&mut self, scene: &dyn Scene, who: EntityId, out: &mut Frame) -> Result<(), ObserveError> {
        let me = scene.entity(who).ok_or(ObserveError::Missing { id: who })?;
        *out = Frame::black(optics().width, optics().height);
        let eye = me.position() + Vector3::new(0.0, 0.0, 1.5);
        let camera = Camera::looking_along(&pose_facing(eye, yaw_of(me.pose)), optics());
        let mut bars = Vec::new();
        for index in 0..16 {
            let Some(post) = scene.entity(EntityId::new(index, 0)).filter(|post| post.id != who) else {
                continue;
            };
            let (Some(color), foot) = (post.info.color, post.position()) else { continue };
            let top = camera.project(&(foot + Vector3::new(0.0, 0.0, 2.5)));
            if let (Some((low, depth)), Some((high, _))) = (camera.project(&foot), top) {
                bars.push((depth, low, high, color));
            }
        }
        bars.sort_by(|a, b| b.0.total_cmp(&a.0));
        for (depth, low, high, color) in bars {
            let half = RADIUS * optics().fx / depth;
            for y in (high.y.max(0.0) as u32)..(low.y.min(f64::from(out.height)) as u32) {
                let from = (low.x - half).clamp(0.0, f64::from(out.width)) as u32;
                let to = (low.x + half).clamp(0.0, f64::from(out.width)) as u32;
                for x in from..to {
                    let at = (y * out.width + x) as usize * 3;
                    out.rgb[at..at + 3].copy_from_slice(&color.map(|part| (part * 400.0).min(255.0) as u8));
                }
            }
        }
        Ok(())
    }
}

/// Sees nothing.
struct Blind;

impl Observer for Blind {
    type Observation = Frame;

    fn observe(&mut self, _: &dyn Scene, _: EntityId, out: &mut Frame) -> Result<(), ObserveError> {
        *out = Frame::black(16, 9);
        Ok(())
    }
}

/// What the newest picture of a request shows of a colour: its bearing, radians to the left, and its distance, m.
fn seen(request: &ChatRequest, is_it: fn(&[u8]) -> bool) -> Option<(f64, f64)> {
    let mut images = request.messages[1].content.iter().filter_map(|part| match part {
        Part::Image(image) => Some(image.bytes.clone()),
        _ => None,
    });
    let file = images.next_back().expect("a picture is shown");
    let mut reader = png::Decoder::new(std::io::Cursor::new(file)).read_info().expect("it is a PNG");
    let mut rgb = vec![0; reader.output_buffer_size().expect("it has a size")];
    let info = reader.next_frame(&mut rgb).expect("it is whole");
    let width = info.width as usize;
    let is_column = |x: &usize| (0..info.height as usize).any(|y| is_it(&rgb[(y * width + x) * 3..][..3]));
    let columns: Vec<usize> = (0..width).filter(is_column).collect();
    let (first, last) = (columns.first()?, columns.last()?);
    let middle = (first + last + 1) as f64 / 2.0;
    let across = (middle - width as f64 / 2.0) / optics().fx;
    let depth = 2.0 * RADIUS * optics().fx / (last + 1 - first) as f64;
    Some((-atan2(across, 1.0), depth * hypot(1.0, across)))
}

fn red(pixel: &[u8]) -> bool {
    pixel[0] > 100 && pixel[2] < 60
}

fn blue(pixel: &[u8]) -> bool {
    pixel[2] > 100 && pixel[0] < 60
}

#[expect(clippy::unnecessary_wraps, reason = "the rule of a model may fail")]
fn deed(deed: &str) -> Result<String, ModelError> {
    Ok(format!(r#"{{"because": "so it looks", "deed": {deed}}}"#))
}

/// Looks for the colour that it is told to look for, turns to it and walks up to it.
fn walker(_: usize, request: &ChatRequest) -> Result<String, ModelError> {
    let aim = text(request, 1);
    let found = seen(request, if aim.contains("the red sign") { red } else { blue });
    match found {
        None => deed(r#"{"act": "turn", "degrees": 60}"#),
        Some((bearing, _)) if bearing.abs() > 0.1 => {
            deed(&format!(r#"{{"act": "turn", "degrees": {:.0}}}"#, bearing.to_degrees()))
        }
        Some((_, distance)) if distance > 1.2 => {
            let ahead = ((distance - 1.0) * 10.0).clamp(1.0, 40.0);
            deed(&format!(r#"{{"act": "forward", "decimetres": {ahead:.0}}}"#))
        }
        Some(_) => deed(r#"{"act": "done"}"#),
    }
}

/// The number that the request says behind some words, the last time that they are there.
fn told(request: &ChatRequest, words: &str) -> Option<f64> {
    text(request, 1).rsplit_once(words)?.1.split(' ').next()?.parse().ok()
}

/// Steers towards what is red, slowly where that is aside or near, and brakes before it.
fn driver(_: usize, request: &ChatRequest) -> Result<String, ModelError> {
    let within = told(request, "come within ").expect("it is told how near it has to come");
    // Its movements last half a second.
    let speed = 2.0 * told(request, "drove ").unwrap_or(0.0);
    let drive = |wheels: f64, wish: f64| {
        let (pedal, wheels) = (if speed < wish { 30 } else { 0 }, wheels.clamp(-35.0, 35.0).round() as i32);
        deed(&format!(r#"{{"act": "drive", "percent": {pedal}, "degrees": {wheels}, "tenths": 5}}"#))
    };
    match seen(request, red) {
        None => drive(35.0, 1.5),
        Some((_, distance)) if distance < within - 1.0 => {
            let stands = text(request, 1).contains("now at 0.0 m/s");
            deed(if stands { r#"{"act": "done"}"# } else { r#"{"act": "brake", "tenths": 20}"# })
        }
        Some((bearing, distance)) => {
            let is_free = bearing.abs() < 0.2 && distance > within + 4.0;
            drive(0.6 * bearing.to_degrees(), if is_free { 3.0 } else { 1.5 })
        }
    }
}

fn schema(request: &ChatRequest) -> String {
    request.schema.as_ref().expect("a schema is sent").json.to_string()
}

/// Drives where it is offered pedals, and walks where it is not.
fn pilot(index: usize, request: &ChatRequest) -> Result<String, ModelError> {
    if schema(request).contains("\"drive\"") { driver(index, request) } else { walker(index, request) }
}

fn step(
    simulation: &mut Simulation,
    executor: &mut dyn Executor,
    me: EntityId,
) -> Result<Progress, ExecutorError> {
    let mut actions = Vec::new();
    simulation.begin_step();
    let progress = executor.advance(simulation.world(), me, &mut actions)?;
    for action in actions {
        simulation.apply(&Command::Actuate { who: me, action }).expect("the body does what it is told");
    }
    simulation.finish_step().expect("bodies move");
    Ok(progress)
}

/// Runs until the plan ends or the steps do; every pose on the way.
fn run(
    simulation: &mut Simulation,
    executor: &mut dyn Executor,
    me: EntityId,
    steps: usize,
) -> (Progress, Vec<Pose>) {
    let mut way = Vec::new();
    for _ in 0..steps {
        let progress = step(simulation, executor, me).expect("the executor works");
        way.push(*simulation.world().entity(me).expect("it is there").pose);
        if !progress.goes_on() {
            return (progress, way);
        }
    }
    (Progress::Running, way)
}

fn distance(simulation: &Simulation, me: EntityId, to: EntityId) -> f64 {
    let place = |id| simulation.world().entity(id).expect("it is there").planar();
    (place(me) - place(to)).norm()
}

fn eyes(rule: fn(usize, &ChatRequest) -> Result<String, ModelError>) -> (VisualExecutor, Asked) {
    let (model, asked) = model(rule);
    (VisualExecutor::new(model, Painter), asked)
}

#[test]
fn every_body_comes_to_the_red_post_by_sight() {
    for body in bodies() {
        let (mut simulation, me) = field(body);
        let (mut executor, asked) = eyes(pilot);
        executor.start(body.plan(), simulation.world(), me).expect("the plan is taken up");
        let (progress, _) = run(&mut simulation, &mut executor, me, 900);
        assert_eq!(progress, Progress::Done, "{body:?} after {:?}", executor.deeds().collect::<Vec<_>>());
        let drives = body.wheels().is_some();
        let moved = if drives && body.on.is_some() { VEHICLE } else { me };
        let (left, within) = (distance(&simulation, moved, RED_POST) - RADIUS, body.within());
        assert!(left <= within, "{body:?} is {left} m away, and not {within} m");
        assert!(text(&asked.last(), 1).contains("the red sign"), "{}", text(&asked.last(), 1));
        let offered = |act: &str| schema(&asked.last()).contains(&format!("\"{act}\""));
        assert_eq!((offered("drive"), offered("turn")), (drives, !drives), "{body:?}");
        let on_foot = !drives && body.on.is_none();
        assert_eq!((offered("step"), offered("look")), (on_foot, !body.kind.is_vehicle()), "{body:?}");
        for _ in 0..10 {
            assert_eq!(step(&mut simulation, &mut executor, me), Ok(Progress::Idle));
        }
        let entity = simulation.world().entity(me).expect("it is there");
        let speed = entity.twist.ground_speed();
        assert!(speed < 0.05, "{body:?} stands when it is done, and does not go on at {speed} m/s");
        let sits_in = entity.attachment.map(|bond| bond.parent);
        let has = sits_in.or_else(|| simulation.world().attached(me, Role::Ridden));
        assert_eq!(has, body.on.map(|_| VEHICLE), "{body:?} is still on what it came with");
    }
}

#[test]
fn who_drives_there_by_sight_gets_out_and_walks_the_rest() {
    let (mut simulation, me) = field(DRIVER);
    let (mut executor, asked) = eyes(pilot);
    let mut plan = DRIVER.plan();
    plan.steps.push(PlanStep::Act(Action::ExitCar));
    plan.steps.extend(to_red(1.0).steps);
    executor.start(plan, simulation.world(), me).expect("the plan is taken up");
    let (progress, _) = run(&mut simulation, &mut executor, me, 900);
    assert_eq!(progress, Progress::Done, "{:?}", executor.deeds().collect::<Vec<_>>());
    let left = [VEHICLE, me].map(|id| distance(&simulation, id, RED_POST) - RADIUS);
    assert!(left[0] <= DRIVER.within() && left[1] <= 1.0, "{left:?} m");
    let pedals: Vec<bool> = asked.all().iter().map(|request| schema(request).contains("\"drive\"")).collect();
    assert!(pedals[0] && pedals.windows(2).filter(|pair| pair[0] != pair[1]).count() == 1, "{pedals:?}");
}

#[test]
fn who_is_interrupted_at_the_wheel_stops_the_car_and_who_only_sits_is_told_to_get_up() {
    let (mut simulation, me) = field(DRIVER);
    let (mut executor, _) = eyes(pilot);
    executor.start(DRIVER.plan(), simulation.world(), me).expect("the plan is taken up");
    let speed = |simulation: &Simulation| simulation.world().entity(VEHICLE).unwrap().twist.ground_speed();
    assert_eq!(run(&mut simulation, &mut executor, me, 60).0, Progress::Running);
    assert!(speed(&simulation) > 0.5, "{} m/s", speed(&simulation));
    let mut rest = Vec::new();
    executor.cancel(&mut rest);
    for action in rest {
        simulation.submit(Command::Actuate { who: me, action });
    }
    (0..20).for_each(|_| simulation.step().expect("bodies move"));
    assert_eq!(speed(&simulation), 0.0);

    let (mut simulation, me) = field(PERSON);
    let bond = Attachment { parent: BLUE_POST, role: Role::Seated, parent_from_body: Pose::identity() };
    simulation.apply(&Command::Attach { child: me, bond: Some(bond) }).expect("it sits");
    executor.start(to_red(1.0), simulation.world(), me).expect("the plan is taken up");
    let (progress, _) = run(&mut simulation, &mut executor, me, 10);
    assert!(matches!(&progress, Progress::Failed { reason } if reason.contains("get up")), "{progress:?}");
}

#[test]
fn without_the_pictures_it_is_not_found_and_that_is_said() {
    let (mut simulation, me) = field(PERSON);
    let (mouth, asked) = model(walker);
    let config = VisualConfig { most_movements: 12, ..VisualConfig::default() };
    let mut executor = VisualExecutor::new(mouth, Blind).with_config(config).expect("the settings are sound");
    executor.start(to_red(1.0), simulation.world(), me).expect("the plan is taken up");
    let (progress, _) = run(&mut simulation, &mut executor, me, 2000);
    let Progress::Failed { reason } = progress else { panic!("{progress:?}") };
    assert!(reason.contains("the red sign") && reason.contains("12 movements"), "{reason}");
    assert_eq!(asked.all().len(), 12);
    assert_eq!(executor.advance(simulation.world(), me, &mut Vec::new()), Ok(Progress::Idle));
}

#[test]
fn it_is_shown_the_last_pictures_and_told_what_it_did() {
    let (mut simulation, me) = field(PERSON);
    let (mut executor, asked) = eyes(walker);
    executor.start(to_red(1.0), simulation.world(), me).expect("the plan is taken up");
    run(&mut simulation, &mut executor, me, 900);
    let pictures = |request: &ChatRequest| {
        request.messages[1].content.iter().filter(|part| matches!(part, Part::Image(_))).count()
    };
    let all = asked.all();
    assert_eq!((pictures(&all[0]), pictures(&all[1]), pictures(&all[4])), (1, 2, 2));
    assert!(!text(&all[0], 1).contains("What you did"));
    assert!(text(&all[1], 1).contains("turned 60° of 60° to the left"), "{}", text(&all[1], 1));
    assert!(text(&asked.last(), 1).contains("m forward"));
}

#[test]
fn rubbish_fails_the_plan_and_silence_ends_the_run() {
    let (mut simulation, me) = field(DOG);
    let (mouth, asked) = model(|_, _| deed(r#"{"act": "sit_down", "seat": 1}"#));
    let mut executor = VisualExecutor::new(mouth, Painter);
    executor.start(to_red(1.0), simulation.world(), me).expect("the plan is taken up");
    let (progress, way) = run(&mut simulation, &mut executor, me, 100);
    let Progress::Failed { reason } = progress else { panic!("{progress:?}") };
    assert!(reason.contains("give one of forward, turn, step, look, done, give_up"), "{reason}");
    assert_eq!((asked.all().len(), way.len()), (4, 2), "two tries, each with one repair");

    let (mouth, _) = answering(&[]);
    let mut executor = VisualExecutor::new(mouth, Painter);
    executor.start(to_red(1.0), simulation.world(), me).expect("the plan is taken up");
    let error = step(&mut simulation, &mut executor, me).expect_err("a script without answers is no model");
    assert!(matches!(&error, ExecutorError::Backend(reason) if reason.contains("no answer")), "{error}");
}

#[test]
fn to_say_done_is_not_to_be_there() {
    let (mut simulation, me) = field(PERSON);
    let (mouth, asked) = model(|_, _| deed(r#"{"act": "done"}"#));
    let mut executor = VisualExecutor::new(mouth, Painter);
    executor.start(to_red(1.0), simulation.world(), me).expect("the plan is taken up");
    let (progress, _) = run(&mut simulation, &mut executor, me, 100);
    assert!(matches!(&progress, Progress::Failed { reason } if reason.contains("not where")), "{progress:?}");
    assert!(text(&asked.last(), 1).contains("it is not reached"));
    let (mouth, _) = model(|_, _| deed(r#"{"act": "give_up", "why": "a wall"}"#));
    let mut executor = VisualExecutor::new(mouth, Painter);
    executor.start(to_red(1.0), simulation.world(), me).expect("the plan is taken up");
    let (progress, _) = run(&mut simulation, &mut executor, me, 100);
    assert!(matches!(&progress, Progress::Failed { reason } if reason.contains("a wall")), "{progress:?}");
}

/// Twice to either post, then a turn if the red one is near, then a wait that a guard cuts short.
fn errand() -> Plan {
    let go = |to| PlanStep::Navigate { to: Goal::Entity(to), within: 1.0, speed: None };
    let near = |id, within| Condition::Near { what: Which::Entity(id), within };
    let turn = vec![PlanStep::Act(Action::Rotate { angle: 1.0 })];
    let rounds = PlanStep::Repeat { times: 2, steps: vec![go(BLUE_POST), go(RED_POST)] };
    let choice = PlanStep::If { condition: near(RED_POST, 3.0), then: turn, otherwise: vec![go(BLUE_POST)] };
    let away = PlanStep::Until { condition: near(BLUE_POST, 8.0), steps: vec![go(BLUE_POST)] };
    Plan {
        steps: vec![
            rounds,
            choice,
            away,
            PlanStep::Face { to: Goal::Entity(BLUE_POST) },
            PlanStep::Wait { seconds: 0.5 },
        ],
    }
}

#[test]
fn blocks_and_guards_hold_for_the_eyes_too() {
    let (mut simulation, me) = field(PERSON);
    let (mut executor, asked) = eyes(|index, request| {
        let aim = text(request, 1);
        let facing = aim.contains("in the middle")
            && seen(request, blue).is_some_and(|(bearing, _)| bearing.abs() < 0.1);
        if facing { deed(r#"{"act": "done"}"#) } else { walker(index, request) }
    });
    executor.start(errand(), simulation.world(), me).expect("the plan is taken up");
    let (progress, way) = run(&mut simulation, &mut executor, me, 4000);
    assert_eq!(progress, Progress::Done, "{:?}", executor.deeds().collect::<Vec<_>>());
    let near = |post: (f64, f64)| {
        let by = |pose: &Pose| hypot(pose.translation.x - post.0, pose.translation.y - post.1) < 1.4;
        way.windows(2).filter(|pair| !by(&pair[0]) && by(&pair[1])).count()
    };
    assert_eq!((near((12.0, -6.0)), near(POST)), (2, 2), "twice to each");
    let left = distance(&simulation, me, BLUE_POST);
    assert!((6.5..8.5).contains(&left), "the guard cut the last way short: {left} m");
    assert!(text(&asked.last(), 1).contains("have the blue sign in the middle"));
}

#[test]
fn a_saved_run_goes_on_and_a_recorded_one_needs_no_model() {
    let folder = tempfile::tempdir().expect("there is a folder");
    let file = folder.path().join("answers.jsonl");
    let (_, whole) = {
        let (mut simulation, me) = field(PERSON);
        let tape = Arc::new(Tape::record(&file).expect("the file is new"));
        let recorded = Recorded::new(model(walker).0, "me", tape);
        let mut executor = VisualExecutor::new(Box::new(recorded), Painter);
        executor.start(to_red(1.0), simulation.world(), me).expect("the plan is taken up");
        run(&mut simulation, &mut executor, me, 900)
    };
    // Without the model: the same way to the bit, and the same hash of the executor on it.
    let (mut simulation, me) = field(PERSON);
    let tape = Arc::new(Tape::replay(&file).expect("the file is read"));
    let mut executor = VisualExecutor::new(Box::new(Recorded::new(NoModel, "me", tape)), Painter);
    executor.start(to_red(1.0), simulation.world(), me).expect("the plan is taken up");
    let (mut way, half) = (Vec::new(), whole.len() / 2);
    way.extend(run(&mut simulation, &mut executor, me, half).1);
    // Half way, another executor takes up what this one saved.
    let hash = |executor: &VisualExecutor| {
        let mut hasher = StateHasher::new();
        executor.state_hash(&mut hasher);
        hasher.finish()
    };
    let (mut other, _) = eyes(walker);
    assert!(!other.restore(&[9, 9, 9]) && other.restore(&executor.save()));
    assert_eq!(hash(&other), hash(&executor));
    way.extend(run(&mut simulation, &mut other, me, 900).1);
    assert_eq!(way, whole);
}

#[test]
fn it_is_an_executor_like_any_other() {
    let (simulation, me) = field(PERSON);
    let wait = Plan { steps: vec![PlanStep::Wait { seconds: 0.5 }] };
    check_executor(|| Box::new(eyes(walker).0), simulation.world(), me, &wait, 20);
    let (mut executor, _) = eyes(walker);
    let endless = PlanStep::Wait { seconds: f64::NAN };
    assert!(executor.start(Plan { steps: vec![endless] }, simulation.world(), me).is_err());
    // Told to follow, it is never offered to be done.
    let (mut executor, asked) = eyes(walker);
    let follow = PlanStep::Follow { whom: RED_POST, gap: 2.0, speed: None };
    executor.start(Plan { steps: vec![follow] }, simulation.world(), me).expect("the plan is taken up");
    executor.advance(simulation.world(), me, &mut Vec::new()).expect("it works");
    assert!(!asked.last().schema.expect("a schema is sent").json.to_string().contains("\"done\""));
    let mut rest = Vec::new();
    executor.cancel(&mut rest);
    assert_eq!(rest, [Action::Stop]);
    let wrong = VisualConfig { frames: 0, ..VisualConfig::default() };
    assert_eq!(executor.with_config(wrong).map(|_| ()).map_err(|error| error.field), Err("frames"));
}
