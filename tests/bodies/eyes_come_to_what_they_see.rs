//! Bodies under physics are steered by drawn pictures to what a model finds in their pixels, and in the dark come nowhere.

use std::io::Cursor;
use std::sync::{Arc, Mutex};

use simworld_agents::model::{ChatReply, ChatRequest, Part, Scripted};
use simworld_agents::observer;
use simworld_agents::thought::{VisualConfig, VisualExecutor};
use simworld_core::action::Action;
use simworld_core::camera::Intrinsics;
use simworld_core::command::Command;
use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::ops::{atan2, hypot};
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
use simworld_core::seam::{Executor, Goal, ObserveError, Observer, Plan, PlanStep, Progress};
use simworld_core::simulation::Simulation;
use simworld_physics::{HumanoidConfig, PhysicsConfig, PhysicsDynamics, QuadrupedConfig, VehicleClass};
use simworld_render::{CameraSensor, Channels, Frame, RenderConfig, RenderError, Renderer};

/// Radius of a pillar, m.
const RADIUS: f64 = 0.5;
const RED: [f32; 3] = [0.7, 0.0, 0.0];
const BLUE: [f32; 3] = [0.0, 0.05, 0.7];
const GREY: [f32; 3] = [0.25; 3];
/// Where everybody looks at first, radians.
const HEADING: f64 = 0.5;
/// The most movements of who sees nothing.
const GROPING: u32 = 6;

fn optics() -> Intrinsics {
    Intrinsics::from_fov(128, 72, std::f64::consts::FRAC_PI_2).expect("a camera like this can be")
}

/// What is before somebody's own eyes, drawn; black without a camera.
struct Eyes {
    camera: Option<CameraSensor>,
    drawn: Frame,
}

impl Observer for Eyes {
    type Observation = observer::Frame;

    fn observe(
        &mut self,
        scene: &dyn Scene,
        who: EntityId,
        out: &mut observer::Frame,
    ) -> Result<(), ObserveError> {
        let (width, height) = (optics().width, optics().height);
        *out = observer::Frame::black(width, height);
        if let Some(camera) = &mut self.camera {
            camera.observe(scene, who, &mut self.drawn)?;
            out.rgb.clone_from(&self.drawn.rgb);
        }
        Ok(())
    }
}

fn is_red(pixel: &[u8]) -> bool {
    let [red, green, blue] = [0, 1, 2].map(|part| u32::from(pixel[part]));
    red > 60 && red > 2 * green && red > 2 * blue
}

/// Where the newest picture of a request shows something red, if it does: its bearing, radians to the left, and its distance, m.
fn pillar(request: &ChatRequest) -> Option<(f64, f64)> {
    let newest = request.messages[1].content.iter().rev().find_map(|part| match part {
        Part::Image(image) => Some(image.bytes.clone()),
        _ => None,
    });
    let file = Cursor::new(newest.expect("a picture is shown"));
    let mut reader = png::Decoder::new(file).read_info().expect("it is a PNG");
    let mut rgb = vec![0; reader.output_buffer_size().expect("it has a size")];
    let info = reader.next_frame(&mut rgb).expect("it is whole");
    let width = info.width as usize;
    let is_column = |x: &usize| (0..info.height as usize).any(|y| is_red(&rgb[(y * width + x) * 3..][..3]));
    let columns: Vec<usize> = (0..width).filter(is_column).collect();
    let (first, last) = (columns.first()?, columns.last()?);
    let middle = (first + last + 1) as f64 / 2.0;
    let across = (middle - width as f64 / 2.0) / optics().fx;
    let depth = 2.0 * RADIUS * optics().fx / (last + 1 - first) as f64;
    Some((-atan2(across, 1.0), depth * hypot(1.0, across)))
}

/// Turns until there is something red, turns to it and walks up to it.
fn walked(seen: Option<(f64, f64)>) -> String {
    match seen {
        None => r#"{"act": "turn", "degrees": 60}"#.to_owned(),
        Some((bearing, _)) if bearing.abs() > 0.12 => {
            format!(r#"{{"act": "turn", "degrees": {}}}"#, bearing.to_degrees().round() as i32)
        }
        Some((_, distance)) if distance > 1.3 => {
            let ahead = (distance - 1.1).clamp(0.1, 3.0) * 10.0;
            format!(r#"{{"act": "forward", "decimetres": {}}}"#, ahead.round() as i32)
        }
        Some(_) => r#"{"act": "done"}"#.to_owned(),
    }
}

/// Steers towards what is red, slowly where that is aside or near, and brakes before it.
fn driven(said: &str, seen: Option<(f64, f64)>) -> String {
    let number = |words: &str| said.rsplit_once(words)?.1.split(' ').next()?.parse::<f64>().ok();
    let within = number("come within ").expect("it is told how near it has to come");
    // Its movements last half a second.
    let speed = 2.0 * number("drove ").unwrap_or(0.0);
    let drive = |wheels: f64, wish: f64| {
        let (pedal, wheels) = (if speed < wish { 30 } else { 0 }, wheels.clamp(-35.0, 35.0).round() as i32);
        format!(r#"{{"act": "drive", "percent": {pedal}, "degrees": {wheels}, "tenths": 5}}"#)
    };
    match seen {
        None => drive(35.0, 1.5),
        Some((_, distance)) if distance < within - 1.0 => {
            let stands = said.contains("now at 0.0 m/s");
            (if stands { r#"{"act": "done"}"# } else { r#"{"act": "brake", "tenths": 20}"# }).to_owned()
        }
        Some((bearing, distance)) => {
            let is_free = bearing.abs() < 0.2 && distance > within + 4.0;
            drive(0.6 * bearing.to_degrees(), if is_free { 3.0 } else { 1.5 })
        }
    }
}

/// What the model says to a request that shows the pillar there: it drives where it is offered pedals.
fn answer(request: &ChatRequest, seen: Option<(f64, f64)>) -> String {
    let said: String = request.messages[1]
        .content
        .iter()
        .filter_map(|part| match part {
            Part::Text(text) => Some(text.as_str()),
            _ => None,
        })
        .collect();
    let schema = request.schema.as_ref().expect("a schema is sent").json.to_string();
    let deed = if schema.contains("\"drive\"") { driven(&said, seen) } else { walked(seen) };
    format!(r#"{{"because": "so it looks", "deed": {deed}}}"#)
}

/// Whether each picture that a model was shown had something red on it.
type Sightings = Arc<Mutex<Vec<bool>>>;

fn executor(camera: Option<CameraSensor>, most_movements: u32) -> (VisualExecutor, Sightings) {
    let sightings = Sightings::default();
    let noted = Arc::clone(&sightings);
    let model = Scripted::rule(move |request| {
        let seen = pillar(request);
        noted.lock().unwrap().push(seen.is_some());
        Ok(ChatReply::of(answer(request, seen)))
    });
    let config = VisualConfig { most_movements, ..VisualConfig::default() };
    let executor = VisualExecutor::new(Box::new(model), Eyes { camera, drawn: Frame::new() });
    (executor.with_config(config).expect("the settings are sound"), sightings)
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Who {
    Person,
    /// A robot dog on twelve motors.
    Dog,
    /// A person who gets into a car first and out of it in the end.
    Driver,
}

impl Who {
    const ALL: [Self; 3] = [Self::Person, Self::Dog, Self::Driver];

    /// How near the middle of what moves is to come to the pillar, m.
    fn within(self) -> f64 {
        if self == Self::Driver { 6.0 } else { 1.0 }
    }
}

/// A red pillar behind somebody, and a blue one before it.
struct Course {
    simulation: Simulation,
    me: EntityId,
    car: Option<EntityId>,
    pillar: EntityId,
    plan: Plan,
}

impl Course {
    fn new(who: Who) -> Self {
        let mut world = World::new();
        let mut put = |kind, [x, y, z]: [f64; 3], shape: Shape, color| {
            let pose = pose_facing(Point3::new(x, y, z), HEADING);
            world.spawn(EntityDesc::new(kind, pose, shape).colored(color)).expect("there is room")
        };
        put(EntityKind::Ground, [0.0, 0.0, -1.0], Shape::cuboid(120.0, 120.0, 1.0), GREY);
        let column = || Shape::Cylinder { radius: RADIUS, height: 2.0 };
        let behind = if who == Who::Driver { [-14.0, 9.4, 0.0] } else { [-5.0, 3.3, 0.0] };
        let pillar = put(EntityKind::Prop, behind, column(), RED);
        put(EntityKind::Prop, [9.0, 5.0, 0.0], column(), BLUE);
        let person = Shape::Capsule { radius: 0.25, height: 1.75 };
        let door = pose_facing(Point3::origin(), HEADING) * Point3::new(0.0, 1.6, 0.0);
        let me = match who {
            Who::Person => put(EntityKind::Person, [0.0; 3], person, GREY),
            Who::Dog => put(EntityKind::Dog, [0.0; 3], Shape::cuboid(0.7, 0.35, 0.5), GREY),
            Who::Driver => put(EntityKind::Person, [door.x, door.y, 0.0], person, GREY),
        };
        let sedan = Shape::cuboid(4.3, 1.8, 1.5);
        let car = (who == Who::Driver).then(|| put(EntityKind::Car, [0.0; 3], sedan, GREY));
        let mut physics = PhysicsDynamics::new(PhysicsConfig::default()).expect("sound settings");
        let added = match who {
            Who::Dog => physics.add_quadruped(&world, me, QuadrupedConfig::default()),
            Who::Person | Who::Driver => physics.add_humanoid(&world, me, HumanoidConfig::default()),
        };
        added.expect("an upright body");
        let mut go = vec![PlanStep::Navigate { to: Goal::Entity(pillar), within: who.within(), speed: None }];
        if let Some(car) = car {
            physics.add_vehicle(&world, car, VehicleClass::Sedan.parameters()).expect("a sedan's size");
            go.insert(0, PlanStep::Act(Action::EnterCar { car }));
            go.push(PlanStep::Act(Action::ExitCar));
        }
        let mut simulation = Simulation::new(world);
        simulation.add_dynamics("physics", Box::new(physics));
        simulation.set_trail_interval(0);
        Self { simulation, me, car, pillar, plan: Plan { steps: go } }
    }

    /// Carries out the plan, and says how that ended.
    fn run(&mut self, executor: &mut VisualExecutor) -> Progress {
        let Self { simulation, me: who, plan, .. } = self;
        executor.start(plan.clone(), simulation.world(), *who).expect("the plan is taken up");
        let mut actions = Vec::new();
        for _ in 0..600 {
            simulation.begin_step();
            let progress =
                executor.advance(simulation.world(), *who, &mut actions).expect("the executor works");
            for action in actions.drain(..) {
                simulation.apply(&Command::Actuate { who: *who, action }).expect("it can be told that");
            }
            simulation.finish_step().expect("bodies move");
            if !progress.goes_on() {
                return progress;
            }
        }
        Progress::Running
    }

    /// How far what moves is from the pillar, m.
    fn left(&self) -> f64 {
        let entity = |id| self.simulation.world().entity(id).expect("it is there");
        let (moved, pillar) = (entity(self.car.unwrap_or(self.me)), entity(self.pillar));
        pillar.info.shape.planar_distance(pillar.pose, &moved.planar())
    }
}

#[test]
fn bodies_under_physics_come_to_the_red_pillar_that_is_drawn_before_their_eyes() {
    let renderer = match Renderer::new(&RenderConfig { shadow_resolution: 0, ..RenderConfig::default() }) {
        Ok(renderer) => Arc::new(Mutex::new(renderer)),
        Err(RenderError::NoAdapter { .. }) if std::env::var_os("SIMWORLD_REQUIRE_ADAPTER").is_none() => {
            return println!("skipped: no adapter");
        }
        Err(error) => panic!("{error}"),
    };
    for who in Who::ALL {
        let mut course = Course::new(who);
        let camera = CameraSensor::sharing(Arc::clone(&renderer), optics()).measuring(Channels::RGB);
        let (mut executor, sightings) = executor(Some(camera), 60);
        let progress = course.run(&mut executor);
        let sightings = sightings.lock().unwrap().clone();
        let deeds: Vec<&str> = executor.deeds().collect();
        assert_eq!(progress, Progress::Done, "{who:?}, {} m away: {sightings:?}, {deeds:?}", course.left());
        assert!(course.left() <= who.within(), "{who:?} is {} m away", course.left());
        // It was looked for, found, and in sight to the end; that it is red was in the pixels alone.
        let first = sightings.iter().position(|seen| *seen).expect("it came into sight");
        assert!(first > 0 && sightings.last() == Some(&true), "{who:?}: {sightings:?}");
        let entity = course.simulation.world().entity(course.me).expect("it is there");
        assert!(entity.attachment.is_none() && entity.twist.ground_speed() < 0.3, "{who:?} stands there");
    }
}

#[test]
fn in_the_dark_the_same_bodies_come_nowhere_and_say_so() {
    for who in Who::ALL {
        let mut course = Course::new(who);
        let before = course.left();
        let (mut executor, sightings) = executor(None, GROPING);
        let Progress::Failed { reason } = course.run(&mut executor) else { panic!("{who:?} found it") };
        assert!(reason.contains(&format!("not reached in {GROPING} movements")), "{who:?}: {reason}");
        assert_eq!(*sightings.lock().unwrap(), [false; GROPING as usize], "{who:?}");
        assert!(course.left() > who.within() + 1.0, "{who:?}: {} m away, before {before} m", course.left());
    }
}
