//! A generated city with its traffic, in which somebody is put somewhere and told something.

use std::ops::ControlFlow;
use std::sync::Arc;

use simworld_agents::executor::RuleExecutor;
use simworld_agents::language::GrammarPlanner;
use simworld_citygen::{City, CityConfig, Style};
use simworld_core::command::Command;
use simworld_core::geometry::{Aabb, Point2, Point3, direction, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::intent::Intent;
use simworld_core::kinematic::{KinematicBody, KinematicDynamics};
use simworld_core::net::{WaypointConfig, WaypointGraph, polyline};
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
use simworld_core::seam::{Dynamics, Executor, Plan, Planner, Progress};
use simworld_core::seed::{Seed, StreamRng};
use simworld_core::simulation::Simulation;
use simworld_physics::{HumanoidConfig, PhysicsConfig, PhysicsDynamics};
use simworld_traffic::{TrafficConfig, TrafficDynamics};

/// Half the width of those who are put somewhere, m.
const HALF_BODY: f64 = 0.25;

/// A city, and the world that it became.
pub(crate) struct Town {
    pub(crate) city: City,
    world: World,
    ways: Arc<WaypointGraph>,
}

/// Where somebody is put.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Start {
    Sidewalk,
    Lane,
    BesideBuilding,
    Green,
    Anywhere,
}

impl Start {
    pub(crate) const ALL: [Self; 5] =
        [Self::Sidewalk, Self::Lane, Self::BesideBuilding, Self::Green, Self::Anywhere];
}

/// Who is put there, and what moves it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Embodied {
    /// A person under physics.
    Person,
    /// A person that walks without physics, through walls if it must.
    Walker,
    /// A robot as tall as people, under physics.
    Robot,
}

impl Embodied {
    pub(crate) const ALL: [Self; 3] = [Self::Person, Self::Walker, Self::Robot];
}

impl Town {
    pub(crate) fn new(style: Style, roads: u32, seed: u64) -> Self {
        let config = CityConfig { roads: style.roads(roads), ..CityConfig::default() };
        let city = City::generate(&config, Seed(seed)).expect("a sound configuration");
        let mut world = World::new();
        city.populate(&mut world).expect("the world takes its own city");
        let ways = WaypointGraph::walkable(&city.network, &WaypointConfig::default());
        Self { city, world, ways: Arc::new(ways.expect("sound settings")) }
    }

    /// Whether there is anything to sit on.
    pub(crate) fn has_chairs(&self) -> bool {
        self.world.iter().any(|entity| entity.kind == EntityKind::Chair)
    }

    /// A free place of that sort.
    pub(crate) fn place(&self, start: Start, rng: &mut StreamRng) -> Point2 {
        for _ in 0..1000 {
            let place = self.draw(start, rng);
            if self.is_free(place) {
                return place;
            }
        }
        panic!("no free place of the sort {start:?}");
    }

    fn draw(&self, start: Start, rng: &mut StreamRng) -> Point2 {
        let network = &self.city.network;
        let along =
            |path: &[Point2], rng: &mut StreamRng| polyline::at(path, rng.unit() * polyline::length(path));
        match start {
            Start::Sidewalk => {
                let walk = rng.choose(&network.sidewalks).expect("a city has sidewalks");
                let (middle, heading) = along(&walk.path, rng);
                middle + direction(heading + 1.57) * rng.uniform(-0.4, 0.4) * walk.width
            }
            Start::Lane => {
                let lane = rng.choose(&network.lanes).expect("a city has lanes");
                along(&lane.path, rng).0
            }
            Start::BesideBuilding => {
                let building = rng.choose(&self.city.buildings).expect("a city has buildings");
                let outline = building.obb().footprint();
                let side = rng.below(4);
                let (a, b) = (outline[side], outline[(side + 1) % 4]);
                let on_wall = a + (b - a) * rng.unit();
                let out = (on_wall - building.center).normalize();
                on_wall + out * rng.uniform(0.4, 1.2)
            }
            Start::Green => {
                let land = self.city.land();
                let Some(green) = rng.choose(&land.greens) else { return self.draw(Start::Anywhere, rng) };
                let outline = land.green_outline(green);
                let middle =
                    outline.iter().fold(Point2::origin(), |sum, at| sum + at.coords) / outline.len() as f64;
                let corner = outline[rng.below(outline.len())];
                middle + (corner - middle) * rng.unit()
            }
            Start::Anywhere => {
                let (low, high) = network.bounds().expect("a city has an extent");
                Point2::new(rng.uniform(low.x, high.x), rng.uniform(low.y, high.y))
            }
        }
    }

    fn is_free(&self, place: Point2) -> bool {
        let mut free = true;
        let _ = self.world.visit(&Aabb::column_around(place, HALF_BODY + 0.1), &mut |entity| {
            let gap = entity.info.shape.planar_distance(entity.pose, &place);
            free = !(entity.is_solid() && gap < HALF_BODY + 0.05);
            if free { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
        });
        free
    }

    /// Somebody who stands there, with the traffic of the city round it.
    pub(crate) fn put(&self, who: Embodied, place: Point2, seed: Seed) -> Told {
        let mut world = self.world.clone();
        let pose =
            pose_facing(Point3::new(place.x, place.y, 0.0), seed.stream("heading").rng().uniform(-3.0, 3.0));
        let kind = if who == Embodied::Robot { EntityKind::Robot } else { EntityKind::Person };
        let body = EntityDesc::new(kind, pose, Shape::Capsule { radius: HALF_BODY, height: 1.75 });
        let me = world.spawn(body).expect("a sound body");
        let few = TrafficConfig { vehicles: 12, pedestrians: 16, ..TrafficConfig::default() };
        let traffic = TrafficDynamics::new(&mut world, &few, seed).expect("sound settings");
        let bodies: Box<dyn Dynamics> = if who == Embodied::Walker {
            let mut walkers = KinematicDynamics::new();
            walkers.insert(me, Box::new(KinematicBody::walker(pose)));
            Box::new(walkers)
        } else {
            let mut physics = PhysicsDynamics::new(PhysicsConfig::default()).expect("sound settings");
            physics.add_humanoid(&world, me, HumanoidConfig::default()).expect("an upright body");
            Box::new(physics)
        };
        let mut simulation = Simulation::new(world);
        simulation.add_dynamics("traffic", Box::new(traffic));
        simulation.add_dynamics("bodies", bodies);
        simulation.set_trail_interval(0);
        Told { simulation, executor: RuleExecutor::new(Arc::clone(&self.ways)), me }
    }
}

/// Somebody in a town who is told things.
pub(crate) struct Told {
    simulation: Simulation,
    executor: RuleExecutor,
    pub(crate) me: EntityId,
}

impl Told {
    pub(crate) fn world(&self) -> &World {
        self.simulation.world()
    }

    pub(crate) fn here(&self) -> Point2 {
        self.world().entity(self.me).expect("nobody takes it out").planar()
    }

    /// Does what is said; how it ends, at the latest after so many minutes.
    pub(crate) fn hears(&mut self, words: &str, minutes: u32) -> Result<(), String> {
        let plan = GrammarPlanner::default().plan(&Intent::Words(words.to_owned()), self.world(), self.me);
        self.does(plan.map_err(|error| error.to_string())?, minutes)
    }

    /// Carries out a plan; how it ends, at the latest after so many minutes.
    pub(crate) fn does(&mut self, plan: Plan, minutes: u32) -> Result<(), String> {
        self.executor.start(plan, self.simulation.world(), self.me).expect("the plan can be begun");
        for _ in 0..minutes * 600 {
            let mut actions = Vec::new();
            let progress = self.executor.advance(self.simulation.world(), self.me, &mut actions);
            for action in actions {
                self.simulation.submit(Command::Actuate { who: self.me, action });
            }
            self.simulation.step().expect("the world goes on");
            match progress.expect("the executor works") {
                Progress::Done => return Ok(()),
                Progress::Failed { reason } => return Err(reason),
                _ => {}
            }
        }
        Err(format!("still under way after {minutes} min at {}", self.here()))
    }
}
