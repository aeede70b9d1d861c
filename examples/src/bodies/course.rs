//! An obstacle course: a ramp, kerbs, posts to go round and a flight of stairs, in a lane for every embodiment. All start at once and
//! go by the same physics; who is on wheels passes beside the stairs, and so does a robot dog on legs; that and a scooter pass beside
//! the kerbs.

use std::f64::consts::PI;

use nalgebra::UnitQuaternion;
use simworld_core::action::Action;
use simworld_core::control::Driver;
use simworld_core::event::EventKind;
use simworld_core::exertion::Exertion;
use simworld_core::geometry::{Point2, Point3, Pose, Vector3, heading, pose_facing, yaw_of};
use simworld_core::id::EntityId;
use simworld_core::net::polyline;
use simworld_core::ops::{self, wrap_angle};
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
use simworld_core::seam::Dynamics;
use simworld_physics::proving::ProvingError;
use simworld_physics::{HumanoidConfig, PhysicsConfig, PhysicsDynamics, QuadrupedConfig, VehicleClass};

/// From the middle of a lane to that of the next, m.
const LANE: f64 = 12.0;
/// The stations, m from the start: the foot of the ramp, the first of three kerbs, the first of three posts, the foot of the
/// stairs, and the finish.
const RAMP: f64 = 6.0;
const KERBS: f64 = 42.0;
const POSTS: f64 = 66.0;
const STAIRS: f64 = 128.0;
const FINISH: f64 = 150.0;
/// The ramp's slope and height, a kerb's height, the rise and the run of a step, radians and m.
const SLOPE: f64 = 0.1;
const DECK: f64 = 1.0;
const KERB: f64 = 0.12;
const RISE: f64 = 0.17;
const RUN: f64 = 0.3;
const STEPS: u32 = 5;
/// From post to post, m.
const APART: f64 = 20.0;
/// Who takes longer is taken out, s.
pub const PATIENCE: f64 = 240.0;

/// The parts of the course, and where each ends, m from the start.
pub const SECTIONS: [(&str, f64); 5] = [
    ("ramp", KERBS - 4.0),
    ("kerbs", POSTS - 10.0),
    ("posts", STAIRS - 8.0),
    ("stairs", FINISH - 8.0),
    ("finish", FINISH),
];

/// Who runs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Embodiment {
    /// A person at the usual pace.
    Walker,
    /// A person at a run.
    Runner,
    /// A robot dog as a cylinder that is led, as those of crowds are.
    Dog,
    /// A robot dog on its twelve motors.
    Quadruped,
    /// A vehicle on its tyres.
    Vehicle(VehicleClass),
}

impl Embodiment {
    /// Everybody, from the slowest lane to the widest.
    pub const ALL: [Self; 9] = [
        Self::Walker,
        Self::Runner,
        Self::Dog,
        Self::Quadruped,
        Self::Vehicle(VehicleClass::Scooter),
        Self::Vehicle(VehicleClass::SmallCar),
        Self::Vehicle(VehicleClass::Suv),
        Self::Vehicle(VehicleClass::Van),
        Self::Vehicle(VehicleClass::Bus),
    ];

    /// What it is called in the table.
    pub fn name(self) -> String {
        match self {
            Self::Walker => "person, walking".to_owned(),
            Self::Runner => "person, running".to_owned(),
            Self::Dog => "robot dog, led".to_owned(),
            Self::Quadruped => "robot dog, on legs".to_owned(),
            Self::Vehicle(class) => class.to_string().replace('_', " "),
        }
    }

    const fn has_legs(self) -> bool {
        !matches!(self, Self::Vehicle(_))
    }

    const fn takes_stairs(self) -> bool {
        !matches!(self, Self::Vehicle(_) | Self::Quadruped)
    }

    /// Wheels as small as a scooter's do not, nor do legs that lift their feet by 10 cm.
    const fn takes_kerbs(self) -> bool {
        !matches!(self, Self::Vehicle(VehicleClass::Scooter) | Self::Quadruped)
    }

    /// How fast it wants to be at a station, m/s.
    fn pace(self, station: f64) -> f64 {
        let is_careful = (KERBS - 8.0..POSTS - 10.0).contains(&station);
        match self {
            Self::Walker | Self::Dog => 1.34,
            Self::Runner => 3.0,
            Self::Quadruped => 0.9,
            Self::Vehicle(_) if station > FINISH - 1.0 => 0.0,
            Self::Vehicle(_) if is_careful => 2.5,
            Self::Vehicle(_) => 5.0,
        }
    }

    /// How far beside a post it passes, m.
    fn berth(self) -> f64 {
        match self {
            Self::Vehicle(class) => class.parameters().chassis.width * 0.5 + 0.9,
            _ => 0.9,
        }
    }
}

/// What somebody did on the course.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// Who.
    pub embodiment: Embodiment,
    /// When it was through each of [`SECTIONS`], s from the start, as far as it came.
    pub times: Vec<f64>,
    /// How fast it was at most over ground within a step of the world, m/s.
    pub fastest: f64,
    /// How high its origin came, m.
    pub highest: f64,
    /// The greatest tilt of its upright axis, radians.
    pub tilt: f64,
    /// How often it fell.
    pub falls: u32,
    /// Steps in which it touched a post.
    pub touches: u32,
    /// What a person spent, J.
    pub energy: Option<f64>,
}

struct Competitor {
    id: EntityId,
    path: Vec<Point2>,
    station: f64,
    driver: Driver,
    outcome: Outcome,
}

/// The course with everybody on it.
pub struct Course {
    world: World,
    physics: PhysicsDynamics,
    posts: Vec<EntityId>,
    competitors: Vec<Competitor>,
}

impl Course {
    /// A course with a lane for each.
    ///
    /// # Errors
    /// Settings of a body out of range.
    pub fn new(embodiments: &[Embodiment]) -> Result<Self, ProvingError> {
        let mut world = World::new();
        let mut physics = PhysicsDynamics::new(PhysicsConfig::default())?;
        let (mut posts, mut competitors) = (Vec::new(), Vec::new());
        for (rank, embodiment) in embodiments.iter().enumerate() {
            let middle = -LANE * rank as f64;
            for (pose, shape) in solids(middle) {
                world.spawn(EntityDesc::new(EntityKind::Prop, pose, shape).colored([0.45, 0.44, 0.42]))?;
            }
            for post in 0..3 {
                let pose = level(POSTS + APART * f64::from(post), middle);
                let shape = Shape::Cylinder { radius: 0.12, height: 1.6 };
                posts.push(
                    world.spawn(EntityDesc::new(EntityKind::Prop, pose, shape).colored([0.8, 0.2, 0.02]))?,
                );
            }
            let id = embody(*embodiment, middle, &mut world, &mut physics)?;
            competitors.push(Competitor::new(id, *embodiment, middle));
        }
        Ok(Self { world, physics, posts, competitors })
    }

    /// The world as it is.
    pub const fn world(&self) -> &World {
        &self.world
    }

    /// Who runs, in the order of the lanes.
    pub fn runners(&self) -> impl Iterator<Item = EntityId> + '_ {
        self.competitors.iter().map(|competitor| competitor.id)
    }

    /// Seconds since the start.
    pub fn time(&self) -> f64 {
        self.world.clock().seconds()
    }

    /// Whether everybody is through, or out of patience.
    pub fn is_over(&self) -> bool {
        self.time() > PATIENCE || self.competitors.iter().all(|one| one.outcome.times.len() == SECTIONS.len())
    }

    /// One step of the world.
    ///
    /// # Errors
    /// The physics cannot go on.
    pub fn step(&mut self) -> Result<(), ProvingError> {
        let dt = self.world.clock().dt();
        let before: Vec<Option<Point3>> =
            self.runners().map(|id| self.world.entity(id).map(|one| one.position())).collect();
        for competitor in &mut self.competitors {
            for action in competitor.next(&self.world, dt) {
                // Who lies on the ground is told in vain, and told again when it stands.
                let _ = self.world.actuate(competitor.id, action);
            }
        }
        self.world.begin_step();
        self.physics.step(&mut self.world, dt)?;
        self.world.finish_step();
        let time = self.time();
        for (competitor, before) in self.competitors.iter_mut().zip(before) {
            competitor.note(&self.world, &self.posts, before, (time, dt));
        }
        Ok(())
    }

    /// What everybody did so far.
    pub fn outcomes(&self) -> impl Iterator<Item = &Outcome> {
        self.competitors.iter().map(|competitor| &competitor.outcome)
    }
}

impl Competitor {
    fn new(id: EntityId, embodiment: Embodiment, middle: f64) -> Self {
        let is_person = matches!(embodiment, Embodiment::Walker | Embodiment::Runner);
        let outcome = Outcome {
            embodiment,
            times: Vec::new(),
            fastest: 0.0,
            highest: 0.0,
            tilt: 0.0,
            falls: 0,
            touches: 0,
            energy: is_person.then_some(0.0),
        };
        let driver = match embodiment {
            Embodiment::Vehicle(class) => Driver::of_length(class.parameters().chassis.length),
            _ => Driver::default(),
        };
        Self { id, path: path(embodiment, middle), station: 0.0, driver, outcome }
    }

    /// What it is told now.
    fn next(&mut self, world: &World, dt: f64) -> Vec<Action> {
        let Some(me) = world.entity(self.id) else { return Vec::new() };
        let at = me.planar();
        let window = polyline::slice(&self.path, (self.station - 4.0).max(0.0), self.station + 25.0);
        if let Some(near) = polyline::closest(&window, &at) {
            self.station = self.station.max((self.station - 4.0).max(0.0) + near.station);
        }
        let pace = self.outcome.embodiment.pace(at.x);
        if self.outcome.embodiment.has_legs() {
            let ahead = polyline::at(&self.path, self.station + 1.0).0;
            let aside = wrap_angle(heading(&(ahead - at)) - yaw_of(me.pose));
            let turn = (aside.abs() > 0.02).then_some(Action::Rotate { angle: aside });
            return turn.into_iter().chain([Action::MoveForward { speed: pace }]).collect();
        }
        let mut window = polyline::slice(&self.path, self.station - 5.0, self.station + 25.0);
        window.dedup_by(|a, b| (*a - *b).norm() < 1e-6);
        let along = me.twist.linear.dot(&(me.pose * Vector3::x()));
        self.driver.drive(me.pose, along, &window, pace, dt).into()
    }

    /// Keeps account of a step.
    fn note(&mut self, world: &World, posts: &[EntityId], before: Option<Point3>, (time, dt): (f64, f64)) {
        let Some((me, before)) = world.entity(self.id).zip(before) else { return };
        let (at, outcome) = (me.position(), &mut self.outcome);
        while SECTIONS.get(outcome.times.len()).is_some_and(|(_, end)| at.x >= *end - 1.5) {
            outcome.times.push(time);
        }
        outcome.fastest = outcome.fastest.max((at - before).xy().norm() / dt);
        outcome.highest = outcome.highest.max(at.z);
        outcome.tilt = outcome.tilt.max(ops::acos((me.pose * Vector3::z()).z.clamp(-1.0, 1.0)));
        if let Some(energy) = outcome.energy.as_mut().filter(|_| outcome.times.len() < SECTIONS.len()) {
            *energy += Exertion::default().energy(&before, &at, dt);
        }
        for event in world.events() {
            match &event.kind {
                EventKind::Fell { who, .. } if *who == self.id => outcome.falls += 1,
                EventKind::Contact { a, b, .. } => {
                    let other = if *a == self.id { Some(b) } else { (*b == self.id).then_some(a) };
                    outcome.touches += u32::from(other.is_some_and(|other| posts.contains(other)));
                }
                _ => {}
            }
        }
    }
}

/// Puts somebody before the start of a lane.
fn embody(
    embodiment: Embodiment,
    middle: f64,
    world: &mut World,
    physics: &mut PhysicsDynamics,
) -> Result<EntityId, ProvingError> {
    let person = Shape::Capsule { radius: 0.25, height: 1.75 };
    let (kind, shape) = match embodiment {
        Embodiment::Walker | Embodiment::Runner => (EntityKind::Person, person),
        Embodiment::Dog | Embodiment::Quadruped => (EntityKind::Dog, Shape::cuboid(0.7, 0.35, 0.5)),
        Embodiment::Vehicle(class) => {
            let chassis = class.parameters().chassis;
            let kind = match class {
                VehicleClass::Scooter => EntityKind::Scooter,
                VehicleClass::Bus => EntityKind::Bus,
                VehicleClass::Truck => EntityKind::Truck,
                _ => EntityKind::Car,
            };
            (kind, Shape::cuboid(chassis.length, chassis.width, chassis.height))
        }
    };
    let start = -shape.size().x * 0.5;
    let id = world.spawn(EntityDesc::new(kind, level(start, middle), shape).named(embodiment.name()))?;
    match embodiment {
        Embodiment::Walker | Embodiment::Runner => {
            physics.add_humanoid(world, id, HumanoidConfig::default())?;
        }
        Embodiment::Dog => physics.add_dog(world, id)?,
        Embodiment::Quadruped => physics.add_quadruped(world, id, QuadrupedConfig::default())?,
        Embodiment::Vehicle(class) => physics.add_vehicle(world, id, class.parameters())?,
    }
    Ok(id)
}

/// The way to go: round the posts by turns on either side, and beside the stairs and the kerbs for who cannot take them.
fn path(embodiment: Embodiment, middle: f64) -> Vec<Point2> {
    let berth = embodiment.berth();
    let beside_kerbs = if embodiment.takes_kerbs() { 0.0 } else { 3.4 };
    let aside = |x: f64| {
        let (first, last) = (POSTS, POSTS + 2.0 * APART);
        if (first..last).contains(&x) {
            return berth * ops::cos(PI * (x - first) / APART);
        }
        let eased = |from: f64, to: f64| {
            let share = ((x - from) / (to - from)).clamp(0.0, 1.0);
            0.5 - 0.5 * ops::cos(PI * share)
        };
        let bypass = if embodiment.takes_stairs() { 0.0 } else { 4.6 };
        if x < first {
            berth * eased(first - 10.0, first) + beside_kerbs * (eased(33.0, 40.0) - eased(53.0, 63.0))
        } else {
            berth + (bypass - berth) * eased(last, last + 14.0) - bypass * eased(FINISH - 14.0, FINISH)
        }
    };
    let points = (0..=340).map(|step| f64::from(step) * 0.5);
    points.map(|x| Point2::new(x, middle + aside(x))).collect()
}

/// What stands in a lane besides its posts.
fn solids(middle: f64) -> Vec<(Pose, Shape)> {
    let rise = DECK / ops::tan(SLOPE);
    let mut solids = vec![
        slab(RAMP, 0.0, middle, SLOPE),
        (level(RAMP + rise + 3.0, middle), Shape::cuboid(6.0, 5.0, DECK)),
        slab(RAMP + rise + 6.0, DECK, middle, -SLOPE),
    ];
    for kerb in 0..3 {
        let pose = level(KERBS + 5.0 * f64::from(kerb), middle);
        solids.push((pose, Shape::cuboid(1.6, 5.0, KERB)));
    }
    let whole = f64::from(2 * STEPS) * RUN + 1.2;
    for step in 0..STEPS {
        let length = whole - 2.0 * RUN * f64::from(step);
        let shape = Shape::cuboid(length, 3.0, RISE * f64::from(step + 1));
        solids.push((level(STAIRS + whole * 0.5, middle), shape));
    }
    solids
}

/// A slab whose upper face begins at a place at a height, and rises or falls until it has gone up or down by a deck.
fn slab(from: f64, height: f64, middle: f64, slope: f64) -> (Pose, Shape) {
    const THICK: f64 = 0.5;
    let length = DECK / ops::sin(slope.abs());
    let tilt = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), -slope);
    let edge = tilt * Vector3::new(-length * 0.5, 0.0, THICK);
    let pose = Pose::from_parts((Vector3::new(from, middle, height) - edge).into(), tilt);
    (pose, Shape::cuboid(length, 5.0, THICK))
}

fn level(x: f64, y: f64) -> Pose {
    pose_facing(Point3::new(x, y, 0.0), 0.0)
}
