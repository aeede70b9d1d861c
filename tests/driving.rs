//! Cars of the ambient traffic that minds drive, among the rest of it, and what went wrong on their ways.

use std::sync::Arc;

use simworld_agents::executor::RuleExecutor;
use simworld_citygen::{City, CityConfig, RoadSource, Style};
use simworld_core::command::Command;
use simworld_core::geometry::{Aabb, Obb, Point2, Point3, direction, yaw_of};
use simworld_core::id::{EntityId, LaneId};
use simworld_core::kinematic::{KinematicDynamics, KinematicVehicle};
use simworld_core::net::{Aspect, Control, RoadNetwork, polyline};
use simworld_core::scene::{EntityKind, EntityRef, Scene, World};
use simworld_core::seam::{Dynamics, Executor, Goal, Plan, PlanStep, Progress};
use simworld_core::seed::{Seed, StreamRng};
use simworld_core::simulation::Simulation;
use simworld_physics::{PhysicsConfig, PhysicsDynamics, VehicleClass};
use simworld_traffic::{TrafficConfig, TrafficDynamics};

use crate::minded::{choose, with_stop_signs};
use crate::traffic::lane_kilometres;

const DT: f64 = 0.1;

/// The bodies under those who drive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wheels {
    /// Wheels that do not slip.
    Rolling,
    /// Tyres of the physics; sedans alone.
    Tyres,
}

/// What is asked of a run.
#[derive(Clone, Debug)]
pub struct Rush {
    /// Which city: its style and its seed.
    pub city: usize,
    /// Roads that it grows from.
    pub segments: u32,
    /// Ambient vehicles a kilometre of lane.
    pub density: f64,
    /// How many are driven by minds, if the city has so many that can be.
    pub minds: usize,
    /// Trips of each, one after another.
    pub trips: usize,
    /// What they drive on.
    pub wheels: Wheels,
    /// Time for all of it, s.
    pub longest: f64,
}

/// What went wrong, with where and when.
#[derive(Debug, Default)]
pub struct Faults {
    /// Touched somebody.
    pub contacts: Vec<String>,
    /// Crossed a line at red.
    pub reds: Vec<String>,
    /// Crossed the line of a stop sign without having stood.
    pub signs: Vec<String>,
    /// Drove close past somebody on a crossing.
    pub cut_off: Vec<String>,
    /// Drove faster than allowed.
    pub too_fast: Vec<String>,
    /// Stood in a junction for long, in the way of others.
    pub boxes: Vec<String>,
    /// Gave up, or was still under way at the end.
    pub lost: Vec<String>,
}

impl Faults {
    /// All of them in words.
    pub fn all(&self) -> Vec<String> {
        let kinds = [
            ("touched", &self.contacts),
            ("at red", &self.reds),
            ("did not stop", &self.signs),
            ("cut off", &self.cut_off),
            ("too fast", &self.too_fast),
            ("in the junction", &self.boxes),
            ("lost", &self.lost),
        ];
        kinds.iter().flat_map(|(kind, list)| list.iter().map(move |what| format!("{kind}: {what}"))).collect()
    }
}

/// What came of a run.
#[derive(Debug, Default)]
pub struct Outcome {
    /// Trips that were to be made.
    pub sent: usize,
    /// Trips that ended at their kerb.
    pub arrived: usize,
    /// m driven by minds.
    pub driven: f64,
    /// Lines with lights that minds crossed.
    pub signals: usize,
    /// Lines with stop signs.
    pub stops: usize,
    /// What went wrong.
    pub faults: Faults,
}

/// Somebody who drives.
struct Driver {
    id: EntityId,
    kind: EntityKind,
    executor: RuleExecutor,
    left: usize,
    goal: Point2,
    /// Where its front was, for lines; and the lines crossed whose ways are not told apart yet.
    front: Point2,
    pending: Option<Pending>,
    /// When it stood last, and since when it stands in a junction, s.
    stood: f64,
    in_box: f64,
    touches: Option<EntityId>,
}

/// A line that was just crossed.
struct Pending {
    lane: LaneId,
    /// The lights of the ways from there, as they were then.
    lights: Vec<Option<Aspect>>,
    at: String,
}

/// A city with its traffic, some of which minds drive.
pub struct Streets {
    simulation: Simulation,
    network: Arc<RoadNetwork>,
    goals: Vec<Point2>,
    drivers: Vec<Driver>,
    rng: StreamRng,
    outcome: Outcome,
}

impl Streets {
    /// The city of a run, with dense traffic that has been under way for a while.
    pub fn new(rush: &Rush) -> Self {
        let style = Style::ALL[rush.city % Style::ALL.len()];
        let config = CityConfig { roads: style.roads(rush.segments), ..CityConfig::default() };
        let seed = Seed(1 + rush.city as u64);
        let plan = with_stop_signs(config.roads.streets(seed).expect("any seed grows streets"));
        let city = City::from_plan(plan, &config, seed).expect("any streets make a city");
        let mut world = World::new();
        city.populate(&mut world).expect("a city fits into a world");
        let vehicles = (rush.density * lane_kilometres(&city.network)) as u32;
        let config = TrafficConfig { vehicles, pedestrians: vehicles, ..TrafficConfig::default() };
        let mut traffic = TrafficDynamics::new(&mut world, &config, seed).expect("the settings are in range");
        for _ in 0..300 {
            world.begin_step();
            traffic.step(&mut world, DT).expect("traffic flows");
            world.finish_step();
        }
        let network = Arc::clone(&city.network);
        let chosen = choose(&traffic, &network, rush);
        let mut rolling = KinematicDynamics::new();
        let mut tyres = PhysicsDynamics::new(PhysicsConfig::default()).expect("sound settings");
        for id in &chosen {
            traffic.hand_over(*id).expect("it is the traffic's");
            let car = world.entity(*id).expect("it is there");
            match rush.wheels {
                Wheels::Rolling => {
                    rolling.insert(*id, Box::new(KinematicVehicle::new(*car.pose, &car.info.shape)));
                }
                Wheels::Tyres => {
                    let sedan = VehicleClass::Sedan.parameters();
                    tyres.add_vehicle(&world, *id, sedan).expect("a car has a body");
                }
            }
        }
        let drivers = chosen.iter().map(|id| Driver::new(&world, *id, rush.trips)).collect();
        let outcome = Outcome { sent: chosen.len() * rush.trips, ..Outcome::default() };
        let mut simulation = Simulation::new(world);
        simulation.add_dynamics("traffic", Box::new(traffic));
        match rush.wheels {
            Wheels::Rolling => simulation.add_dynamics("wheels", Box::new(rolling)),
            Wheels::Tyres => simulation.add_dynamics("wheels", Box::new(tyres)),
        };
        simulation.set_trail_interval(0);
        let goals = city.buildings.iter().map(|building| building.access).collect();
        let rng = seed.stream("rush").rng();
        Self { simulation, network, goals, drivers, rng, outcome }
    }

    /// Drives until all trips have ended.
    pub fn drive(mut self, rush: &Rush) -> Outcome {
        for index in 0..self.drivers.len() {
            self.send(index);
        }
        let mut tick = 0_u64;
        while self.drivers.iter().any(|driver| driver.left > 0) && self.now() < rush.longest + 30.0 {
            for index in 0..self.drivers.len() {
                self.think(index);
            }
            self.simulation.step().expect("the world goes on");
            tick += 1;
            for index in 0..self.drivers.len() {
                if self.drivers[index].left > 0 {
                    self.look(index, tick);
                }
            }
        }
        for index in 0..self.drivers.len() {
            if self.drivers[index].left > 0 {
                let told = format!("{} still under way", self.tell(index));
                self.outcome.faults.lost.push(told);
            }
        }
        self.outcome
    }

    fn now(&self) -> f64 {
        self.simulation.world().clock().seconds()
    }

    fn tell(&self, index: usize) -> String {
        let driver = &self.drivers[index];
        let car = self.simulation.world().entity(driver.id).expect("it is there");
        let (at, goal) = (car.planar(), driver.goal);
        format!(
            "{} {} at ({:.1}, {:.1}) to ({:.0}, {:.0}), {:.1} m/s, {:.1} s",
            driver.kind,
            driver.id,
            at.x,
            at.y,
            goal.x,
            goal.y,
            car.twist.ground_speed(),
            self.now()
        )
    }

    /// Gives one a new goal.
    fn send(&mut self, index: usize) {
        let goal = self.goals[self.rng.below(self.goals.len())];
        let driver = &mut self.drivers[index];
        driver.goal = goal;
        let to = Goal::Point(Point3::new(goal.x, goal.y, 0.0));
        let plan = Plan { steps: vec![PlanStep::Navigate { to, within: 2.0, speed: None }] };
        driver
            .executor
            .start(plan, self.simulation.world(), driver.id)
            .expect("a plan to drive can be begun");
    }

    fn think(&mut self, index: usize) {
        if self.drivers[index].left == 0 {
            return;
        }
        let (mut actions, driver) = (Vec::new(), &mut self.drivers[index]);
        let progress = driver.executor.advance(self.simulation.world(), driver.id, &mut actions);
        for action in actions {
            self.simulation.submit(Command::Actuate { who: driver.id, action });
        }
        match progress.expect("it is there") {
            Progress::Running | Progress::Begun { .. } | Progress::Rerouted { .. } => {}
            Progress::Failed { reason } => {
                self.drivers[index].left = 0;
                let told = format!("{}: {reason}", self.tell(index));
                self.simulation.submit(Command::Remove { id: self.drivers[index].id });
                self.outcome.faults.lost.push(told);
            }
            _ => self.arrive(index),
        }
    }

    fn arrive(&mut self, index: usize) {
        let driver = &self.drivers[index];
        let car = self.simulation.world().entity(driver.id).expect("it is there");
        let (away, speed) = ((car.planar() - driver.goal).norm(), car.twist.ground_speed());
        if away > 100.0 || speed > 0.3 {
            let told = format!("{} says that it is there, {away:.0} m away", self.tell(index));
            self.outcome.faults.lost.push(told);
        } else {
            self.outcome.arrived += 1;
        }
        let driver = &mut self.drivers[index];
        driver.left -= 1;
        if driver.left > 0 {
            self.send(index);
        } else {
            // Who has arrived for good makes room for others.
            self.simulation.submit(Command::Remove { id: driver.id });
        }
    }

    /// Watches one after a step.
    fn look(&mut self, index: usize, tick: u64) {
        let told = self.tell(index);
        let now = self.now();
        let world = self.simulation.world();
        let driver = &mut self.drivers[index];
        let car = world.entity(driver.id).expect("it is there");
        let speed = car.twist.ground_speed();
        self.outcome.driven += speed * DT;
        if speed < 0.3 {
            driver.stood = now;
        }
        let faults = &mut self.outcome.faults;
        let touched = touched(world, &car);
        if let Some(other) = touched.filter(|other| driver.touches != Some(*other)) {
            let other = world.entity(other).expect("it is there");
            let (at, v) = (other.planar(), other.twist.ground_speed());
            // Who walks brushes along a car that stands.
            let walks = other.kind == EntityKind::Person && speed < 0.2;
            let told =
                format!("{told}, {} {} at ({:.1}, {:.1}) with {v:.1} m/s", other.kind, other.id, at.x, at.y);
            if !walks {
                faults.contacts.push(told);
            }
        }
        driver.touches = touched;
        if speed > 1.0 && cuts_off(world, &self.network, &car) {
            faults.cut_off.push(told.clone());
        }
        if tick.is_multiple_of(5) && speed > limit(&self.network, &car) + 1.0 {
            faults.too_fast.push(told.clone());
        }
        let in_box = speed < 0.1 && is_in_junction(&self.network, car.planar());
        driver.in_box = if in_box { driver.in_box + DT } else { 0.0 };
        if (30.0..30.0 + DT).contains(&driver.in_box) {
            faults.boxes.push(told.clone());
        }
        driver.mind_lines(world, &self.network, &told, now, &mut self.outcome);
    }
}

impl Driver {
    fn new(world: &World, id: EntityId, trips: usize) -> Self {
        let car = world.entity(id).expect("it is there");
        Self {
            id,
            kind: car.kind,
            executor: RuleExecutor::straight(),
            left: trips,
            goal: car.planar(),
            front: front(&car),
            pending: None,
            stood: f64::NEG_INFINITY,
            in_box: 0.0,
            touches: None,
        }
    }

    /// Looks whether it crossed a line, and what the light of the way that it takes said then.
    fn mind_lines(&mut self, world: &World, network: &RoadNetwork, told: &str, now: f64, out: &mut Outcome) {
        let before = std::mem::replace(&mut self.front, front(&world.entity(self.id).expect("it is there")));
        let crossed = network.lanes.iter().position(|lane| {
            let Some(end) = lane.path.last() else { return false };
            if (end - self.front).norm() > 4.0 || lane.outgoing.is_empty() || !lane.is_driven() {
                return false;
            }
            let way = direction(polyline::at(&lane.path, lane.length).1);
            let (a, b) = ((before - end).dot(&way), (self.front - end).dot(&way));
            a < 0.0 && b >= 0.0 && way.perp(&(self.front - end)).abs() < 1.5
        });
        if let Some(lane) = crossed {
            let ways = network.lanes[lane].outgoing.iter().map(|id| network.connections[id.index()].signal);
            let lights = ways.map(|signal| signal.map(|group| world.signals()[group.index()])).collect();
            let id = LaneId::from_index(lane);
            self.pending = Some(Pending { lane: id, lights, at: told.to_owned() });
            if network.stops_at(id)
                && network.lanes[lane]
                    .outgoing
                    .iter()
                    .all(|way| network.connections[way.index()].signal.is_none())
            {
                out.stops += 1;
                // One stands a metre before the line, and then starts.
                if now - self.stood > 3.0 {
                    out.faults.signs.push(told.to_owned());
                }
            }
        }
        let Some(pending) = &self.pending else { return };
        let lane = &network.lanes[pending.lane.index()];
        if (self.front - lane.path[lane.path.len() - 1]).norm() < 7.0 {
            return;
        }
        let beside = |id: &simworld_core::id::ConnectionId| {
            let near = polyline::closest(&network.connections[id.index()].path, &self.front);
            near.map_or(f64::INFINITY, |near| near.distance)
        };
        let taken =
            lane.outgoing.iter().zip(&pending.lights).min_by(|a, b| beside(a.0).total_cmp(&beside(b.0)));
        if let Some((_, Some(light))) = taken {
            out.signals += 1;
            if *light == Aspect::Red {
                out.faults.reds.push(pending.at.clone());
            }
        }
        self.pending = None;
    }
}

fn solid(entity: &EntityRef<'_>) -> Obb {
    entity.info.shape.obb(entity.pose)
}

fn front(car: &EntityRef<'_>) -> Point2 {
    car.planar() + direction(yaw_of(car.pose)) * (car.info.shape.size().x * 0.5)
}

/// Who or what a vehicle touches.
fn touched(world: &World, car: &EntityRef<'_>) -> Option<EntityId> {
    let (own, mut found) = (solid(car), None);
    let _ = world.visit(&Aabb::column_around(car.planar(), 15.0), &mut |other| {
        let counts = other.id != car.id
            && other.attachment.is_none()
            && other.kind.is_solid()
            && other.kind != EntityKind::Building;
        if counts && own.footprints_overlap(&solid(&other)) {
            found = Some(other.id);
        }
        std::ops::ControlFlow::Continue(())
    });
    found
}

/// Whether somebody on a crossing is right before or beside a vehicle that drives over it.
fn cuts_off(world: &World, network: &RoadNetwork, car: &EntityRef<'_>) -> bool {
    let (own, mut found) = (solid(car), false);
    let grown =
        Obb { pose: own.pose, half_extents: own.half_extents + nalgebra::Vector3::new(0.6, 0.6, 0.0) };
    let _ = world.visit(&Aabb::column_around(car.planar(), 8.0), &mut |other| {
        if other.kind == EntityKind::Person
            && other.attachment.is_none()
            && grown.footprints_overlap(&solid(&other))
        {
            let at = other.planar();
            found |= network.crossings.iter().any(|crossing| {
                let strip = [crossing.start, crossing.end];
                let length = (crossing.end - crossing.start).norm();
                polyline::closest(&strip, &at).is_some_and(|near| {
                    near.distance < crossing.width * 0.5 && near.station > 0.3 && near.station < length - 0.3
                })
            });
        }
        std::ops::ControlFlow::Continue(())
    });
    found
}

/// The limit where a vehicle is, of all lanes and ways across that it may be on, m/s.
fn limit(network: &RoadNetwork, car: &EntityRef<'_>) -> f64 {
    let (at, ahead) = (car.planar(), direction(yaw_of(car.pose)));
    let is_on = |path: &[Point2]| {
        polyline::closest(path, &at).is_some_and(|near| {
            near.distance < 2.0 && direction(polyline::at(path, near.station).1).dot(&ahead) > 0.5
        })
    };
    let lanes = network.lanes.iter().filter(|lane| is_on(&lane.path)).map(|lane| lane.speed_limit);
    let ways = network.connections.iter().filter(|way| is_on(&way.path));
    let ways = ways.map(|way| network.lanes[way.from.index()].speed_limit);
    let most = lanes.chain(ways).fold(0.0, f64::max);
    if most > 0.0 { most } else { f64::INFINITY }
}

fn is_in_junction(network: &RoadNetwork, at: Point2) -> bool {
    let near = network.intersections.iter().filter(|place| place.control != Control::None);
    near.filter(|place| (place.center - at).norm() < 40.0).any(|place| {
        let corners = &place.outline;
        let mut inside = false;
        for (a, b) in corners.iter().zip(corners.iter().cycle().skip(1)) {
            if (a.y > at.y) != (b.y > at.y) && at.x < (b.x - a.x) * (at.y - a.y) / (b.y - a.y) + a.x {
                inside = !inside;
            }
        }
        inside
    })
}
