//! A town whose streets a red car drives through, told by a sentence, and what went worst on its way.

use std::sync::Arc;

use simworld_agents::executor::RuleExecutor;
use simworld_agents::language::GrammarPlanner;
use simworld_core::command::Command;
use simworld_core::geometry::{Point2, Point3, direction, pose_facing, yaw_of};
use simworld_core::id::EntityId;
use simworld_core::intent::Intent;
use simworld_core::net::{
    Aspect, NetworkConfig, RoadNetwork, StreetPlan, WaypointConfig, WaypointGraph, polyline,
};
use simworld_core::scene::{EntityDesc, EntityKind, Place, Scene, Shape, World};
use simworld_core::seam::{Executor, Planner, Progress};
use simworld_core::seed::Seed;
use simworld_core::simulation::Simulation;
use simworld_physics::{HumanoidConfig, PhysicsConfig, PhysicsDynamics, VehicleClass};
use simworld_traffic::{TrafficConfig, TrafficDynamics};

const RED: [f32; 3] = [0.55, 0.03, 0.02];

/// A town of nine blocks, a red car at the kerb of its southern street, and a person beside it.
pub(crate) struct Town {
    pub(crate) world: World,
    pub(crate) network: Arc<RoadNetwork>,
    pub(crate) person: EntityId,
    pub(crate) car: EntityId,
    pub(crate) hospital: EntityId,
}

impl Town {
    pub(crate) fn new() -> Self {
        let network = RoadNetwork::derive(&StreetPlan::grid(4, 4, 120.0), &NetworkConfig::default());
        let network = Arc::new(network.expect("a grid is sound"));
        let mut world = World::new();
        world.set_roads(Arc::clone(&network));
        let mut put = |desc: EntityDesc| world.spawn(desc).expect("a sound entity");
        let at = |x, y, yaw| pose_facing(Point3::new(x, y, 0.0), yaw);
        let car =
            EntityDesc::new(EntityKind::Car, at(50.0, -2.2, 0.0), Shape::cuboid(4.3, 1.8, 1.5)).colored(RED);
        let car = put(car);
        let person = Shape::Capsule { radius: 0.25, height: 1.8 };
        let person = put(EntityDesc::new(EntityKind::Person, at(40.0, -6.0, 0.0), person));
        let mut house =
            EntityDesc::new(EntityKind::Building, at(300.0, 260.0, 0.0), Shape::cuboid(20.0, 20.0, 9.0));
        house =
            house.used_as(Place::Hospital).named("Town Hospital").accessed_at(Point3::new(300.0, 246.5, 0.0));
        let hospital = put(house);
        Self { world, network, person, car, hospital }
    }

    /// The run of what is said to somebody.
    pub(crate) fn run(self, who: EntityId, words: &str) -> Run {
        let plan = GrammarPlanner::default().plan(&Intent::Words(words.to_owned()), &self.world, who);
        let plan = plan.unwrap_or_else(|error| panic!("{words}: {error}"));
        let mut world = self.world;
        let quiet = TrafficConfig { vehicles: 0, pedestrians: 0, ..TrafficConfig::default() };
        let traffic = TrafficDynamics::new(&mut world, &quiet, Seed(1)).expect("signals alone");
        let mut physics = PhysicsDynamics::new(PhysicsConfig::default()).expect("sound settings");
        physics.add_humanoid(&world, self.person, HumanoidConfig::default()).expect("a person has a body");
        physics.add_vehicle(&world, self.car, VehicleClass::Sedan.parameters()).expect("a car has a body");
        let ways =
            WaypointGraph::walkable(&self.network, &WaypointConfig::default()).expect("sound settings");
        let mut simulation = Simulation::new(world);
        simulation.add_dynamics("traffic", Box::new(traffic));
        simulation.add_dynamics("physics", Box::new(physics));
        simulation.set_trail_interval(0);
        let mut executor = RuleExecutor::new(Arc::new(ways));
        executor.start(plan, simulation.world(), who).expect("the plan can be begun");
        let start = self.network;
        Run {
            simulation,
            executor,
            network: start,
            who,
            car: self.car,
            recent: Vec::new(),
            worst: Worst::default(),
        }
    }
}

/// What went worst on the way.
#[derive(Debug, Default)]
pub(crate) struct Worst {
    /// m beside the nearest lane or way across a junction, at speed.
    pub(crate) aside: f64,
    /// m/s above the limit.
    pub(crate) too_fast: f64,
    /// Ways across that were begun at red.
    pub(crate) at_red: usize,
    /// m driven.
    pub(crate) driven: f64,
}

pub(crate) struct Run {
    pub(crate) simulation: Simulation,
    pub(crate) executor: RuleExecutor,
    pub(crate) network: Arc<RoadNetwork>,
    pub(crate) who: EntityId,
    pub(crate) car: EntityId,
    recent: Vec<Vec<Aspect>>,
    pub(crate) worst: Worst,
}

impl Run {
    pub(crate) fn step(&mut self) -> Progress {
        let mut actions = Vec::new();
        let progress =
            self.executor.advance(self.simulation.world(), self.who, &mut actions).expect("it works");
        for action in actions {
            self.simulation.submit(Command::Actuate { who: self.who, action });
        }
        self.simulation.step().expect("the world goes on");
        self.look();
        progress
    }

    pub(crate) fn finish(&mut self, seconds: usize) -> Progress {
        for _ in 0..seconds * 10 {
            let progress = self.step();
            if !progress.goes_on() {
                return progress;
            }
        }
        panic!("still under way after {seconds} s at {:?}, {:?}", self.car_at(), self.worst);
    }

    pub(crate) fn car_at(&self) -> Point2 {
        self.simulation.world().entity(self.car).expect("the car is there").planar()
    }

    pub(crate) fn look(&mut self) {
        let world = self.simulation.world();
        let car = world.entity(self.car).expect("the car is there");
        let (at, speed, ahead) = (car.planar(), car.twist.ground_speed(), direction(yaw_of(car.pose)));
        self.worst.driven += speed * 0.1;
        self.recent.push(world.signals().to_vec());
        // The line is a car's length before the junction.
        self.recent.drain(..self.recent.len().saturating_sub(40));
        if speed < 3.0 {
            return;
        }
        let along = |path: &[Point2]| {
            let near = polyline::closest(path, &at)?;
            let way = direction(polyline::at(path, near.station).1);
            (way.dot(&ahead) > 0.7).then_some(near)
        };
        let lanes = self.network.lanes.iter().filter_map(|lane| Some((along(&lane.path)?, lane.speed_limit)));
        let (near, limit) =
            lanes.min_by(|a, b| a.0.distance.total_cmp(&b.0.distance)).expect("there are lanes");
        let across = self.network.connections.iter().filter_map(|way| Some((along(&way.path)?, way)));
        let across =
            across.min_by(|a, b| a.0.distance.total_cmp(&b.0.distance)).expect("there are junctions");
        self.worst.aside = self.worst.aside.max(near.distance.min(across.0.distance));
        self.worst.too_fast = self.worst.too_fast.max(speed - limit);
        let is_on = across.0.distance < 0.5 && (1.0..3.0).contains(&across.0.station);
        if let Some(group) = across.1.signal.filter(|_| is_on) {
            let may = self.recent.iter().any(|aspects| aspects[group.index()] != Aspect::Red);
            self.worst.at_red += usize::from(!may);
        }
    }
}

/// Puts something solid that nobody moves into a town.
pub(crate) fn put(
    town: &mut Town,
    kind: EntityKind,
    (x, y): (f64, f64),
    (long, wide): (f64, f64),
) -> EntityId {
    let pose = pose_facing(Point3::new(x, y, 0.0), 0.0);
    town.world.spawn(EntityDesc::new(kind, pose, Shape::cuboid(long, wide, 1.5))).expect("a sound entity")
}
