//! Whatever people do in a furnished city, nobody ends up inside a wall or under the ground.
//!
//! Sampled by default; whole under `SIMWORLD_SOAK=1`: 10,000 moves, and a million body-seconds in ten cities.

use crate::common::{PERSON, Stage, at, ramp};
use rayon::prelude::*;
use simworld_core::action::{Action, StepDirection};
use simworld_core::environment::Environment;
use simworld_core::event::EventKind;
use simworld_core::geometry::{Point3, Pose, Twist, Vector3, direction, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityDesc, EntityKind, Footing, Scene, Shape};
use simworld_core::seed::{Seed, StreamRng};
use simworld_physics::HumanoidConfig;

const BLOCKS: i32 = 3;
const BLOCK: f64 = 40.0;

fn is_whole() -> bool {
    std::env::var("SIMWORLD_SOAK").is_ok_and(|value| value == "1")
}

struct City {
    stage: Stage,
    people: Vec<EntityId>,
    traffic: Vec<(EntityId, f64)>,
    walls: Vec<EntityId>,
    rng: StreamRng,
}

impl City {
    /// Blocks with a building, a kerb around it, stairs, a ramp, benches, lamps, and crates that are free; and cars that
    /// drive between them without heed.
    fn new(seed: u64, people: usize) -> Self {
        let mut stage = Stage::new();
        let mut walls = Vec::new();
        for (i, j) in (0..BLOCKS).flat_map(|i| (0..BLOCKS).map(move |j| (i, j))) {
            let (x, y) = (f64::from(i) * BLOCK, f64::from(j) * BLOCK);
            walls.push(stage.building(x, y, (14.0, 14.0, 9.0)));
            stage.building(x, y - 12.0, (12.0, 4.0, 0.15)); // a kerb
            stage.building(x, y + 12.0, (12.0, 4.0, 0.4)); // and one too high
            for step in 0..6 {
                let step = f64::from(step);
                stage.building(x + 12.0 + step * 0.15, y, (4.0 - step * 0.3, 3.0, 0.17 * (step + 1.0)));
            }
            let (pose, _) = ramp(0.0, 0.35);
            let pose = Pose::from_parts(
                (pose.translation.vector + Vector3::new(x - 16.0, y + 8.0, 0.0)).into(),
                pose.rotation,
            );
            stage.spawn(EntityKind::Building, pose, Shape::cuboid(5.0, 3.0, 4.0));
            for k in 0..4 {
                let along = f64::from(k) * 4.0 - 6.0;
                stage.spawn(EntityKind::Bench, at(x + along, y - 9.0, 0.3), Shape::cuboid(0.6, 1.8, 0.45));
                stage.spawn(
                    EntityKind::StreetLamp,
                    at(x - 9.0, y + along, 0.0),
                    Shape::Cylinder { radius: 0.1, height: 5.0 },
                );
                let place = pose_facing(Point3::new(x + along, y + 8.5, 0.0), 0.7);
                let free =
                    EntityDesc::new(EntityKind::Prop, place, Shape::cuboid(0.6, 0.6, 0.6)).weighing(15.0);
                let free = stage.world.spawn(free).unwrap();
                stage.physics.add_rigid(&stage.world, free).unwrap();
            }
        }
        let mut rng = Seed(seed).stream("test/crowd").rng();
        let mut traffic = Vec::new();
        for i in 0..BLOCKS {
            let lane = at(-30.0, f64::from(i) * BLOCK + 20.0, 0.0);
            traffic.push((stage.spawn(EntityKind::Car, lane, Shape::cuboid(4.3, 1.8, 1.5)), 8.0));
        }
        let people = (0..people)
            .map(|_| {
                // In the streets between.
                let (x, y) = (
                    rng.uniform(-18.0, 98.0),
                    f64::from(rng.below(3) as i32) * BLOCK + rng.uniform(16.0, 24.0),
                );
                let id = stage.spawn(EntityKind::Person, at(x, y, rng.uniform(-3.0, 3.0)), PERSON);
                stage.physics.add_humanoid(&stage.world, id, HumanoidConfig::default()).unwrap();
                id
            })
            .collect();
        Self { stage, people, traffic, walls, rng }
    }

    /// Somebody is told something.
    fn order(&mut self, who: EntityId) {
        let rng = &mut self.rng;
        let action = match rng.below(8) {
            0 | 1 => Action::Rotate { angle: rng.uniform(-3.0, 3.0) },
            2 => Action::Stop,
            3 => Action::Step { direction: StepDirection::Left, distance: rng.uniform(0.0, 2.0) },
            4 => Action::MoveForward { speed: rng.uniform(0.2, 1.4) },
            _ => Action::MoveForward { speed: rng.uniform(1.0, 2.5) },
        };
        // Who walks out of the city is turned round.
        let there = self.stage.position(who);
        if !(-40.0..120.0).contains(&there.x) || !(-40.0..120.0).contains(&there.y) {
            self.stage.world.set_motion(who, at(20.0, 20.0, 0.0), Twist::ZERO).unwrap();
        }
        self.stage.tell(who, action);
    }

    fn step(&mut self) {
        for (car, speed) in &mut self.traffic {
            let entity = self.stage.world.entity(*car).unwrap();
            let mut pose = *entity.pose;
            pose.translation.x += *speed * 0.1;
            if !(-40.0..120.0).contains(&pose.translation.x) {
                *speed = -*speed;
            }
            let way = direction(0.0) * *speed;
            let twist = Twist { linear: Vector3::new(way.x, way.y, 0.0), angular: Vector3::zeros() };
            self.stage.world.set_motion(*car, pose, twist).unwrap();
        }
        self.stage.step();
    }

    /// Nobody is in a wall or under the ground; who stands is upright.
    fn check(&self) {
        for who in &self.people {
            let entity = self.stage.world.entity(*who).unwrap();
            let middle = entity.pose * Point3::new(0.0, 0.0, 1.1);
            let stands = entity.footing() == Footing::Upright;
            let (depth, floor) = if stands { (0.02, -0.05) } else { (0.3, -0.2) };
            assert!(
                middle.z > floor + if stands { 1.1 } else { 0.0 },
                "{who}, {}, is under the ground: {middle}",
                entity.footing()
            );
            for wall in &self.walls {
                let wall = self.stage.world.entity(*wall).unwrap();
                let inside = wall.pose.inverse() * middle;
                let half = wall.info.shape.size() * 0.5;
                let in_wall = inside.x.abs() < half.x - depth
                    && inside.y.abs() < half.y - depth
                    && inside.z < 2.0 * half.z - depth
                    && inside.z > 0.0;
                assert!(!in_wall, "{who}, {}, is in a wall: {middle}", entity.footing());
            }
        }
    }

    /// Weather as it comes.
    fn weather(&mut self) {
        let mut environment = Environment::default();
        let weather = &mut environment.weather;
        (weather.rain, weather.snow, weather.temperature) = match self.rng.below(5) {
            0 => (5.0, 0.0, 10.0),
            1 => (0.0, 2.0, -5.0),
            2 => (1.0, 0.0, -3.0),
            _ => (0.0, 0.0, 15.0),
        };
        self.stage.world.set_environment(environment).unwrap();
    }

    fn falls(&self) -> usize {
        self.stage.events.iter().filter(|event| matches!(event, EventKind::Fell { .. })).count()
    }
}

#[test]
fn nobody_stands_inside_a_wall_after_random_moves_in_a_furnished_city() {
    let moves = if is_whole() { 10_000 } else { 600 };
    let mut city = City::new(1, 12);
    for turn in 0..moves {
        if turn % 200 == 0 {
            city.weather();
        }
        let who = city.people[turn % city.people.len()];
        city.order(who);
        for _ in 0..3 {
            city.step();
            city.check();
        }
    }
    println!("{moves} moves, {} falls", city.falls());
    assert!(city.falls() > moves / 200, "people fall here: {}", city.falls());
}

#[test]
fn nobody_falls_through_the_ground() {
    let (cities, people, seconds) = if is_whole() { (10, 250, 400) } else { (1, 40, 50) };
    let falls: usize = (0..cities).into_par_iter().map(|city| live(2 + city, people, seconds)).sum();
    println!("{} body-seconds in {cities} cities, {falls} falls", cities as usize * people * seconds);
    assert!(falls > 0, "people fall here");
}

/// So many people live so many seconds in a city of their own, above its ground and outside its walls; how often they fell.
fn live(seed: u64, people: usize, seconds: usize) -> usize {
    let mut city = City::new(seed, people);
    for second in 0..seconds {
        if second % 50 == 0 {
            city.weather();
        }
        for who in city.people.clone() {
            if city.rng.below(4) == 0 {
                city.order(who);
            }
        }
        for _ in 0..10 {
            city.step();
        }
        city.check();
    }
    city.falls()
}
