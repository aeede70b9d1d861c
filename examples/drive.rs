//! A sentence is driven through the rush hour of a generated city: one car of the traffic is a mind's from now on, and the way
//! that it takes is drawn on the map.
//!
//! ```sh
//! cargo run --release --example drive -- --say "drive to the hospital and park" --map drive.svg
//! ```

use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::Arc;

use clap::{Parser, ValueEnum};
use simworld_agents::executor::RuleExecutor;
use simworld_agents::language::GrammarPlanner;
use simworld_citygen::map::MapDrawing;
use simworld_citygen::{City, CityConfig};
use simworld_core::command::Command;
use simworld_core::geometry::Point2;
use simworld_core::id::EntityId;
use simworld_core::intent::Intent;
use simworld_core::kinematic::{KinematicDynamics, KinematicVehicle};
use simworld_core::net::RoadNetwork;
use simworld_core::scene::{Scene, World};
use simworld_core::seam::{Dynamics, Executor, Planner, Progress};
use simworld_core::seed::Seed;
use simworld_core::simulation::Simulation;
use simworld_examples::{Outcome, exit_code};
use simworld_physics::{PhysicsConfig, PhysicsDynamics, VehicleClass};
use simworld_traffic::vehicle::VehicleKind;
use simworld_traffic::{TrafficConfig, TrafficDynamics};

/// Drives a sentence through dense traffic.
#[derive(Parser)]
struct Arguments {
    /// What the driver is told.
    #[arg(long, default_value = "drive to the hospital and park")]
    say: String,
    /// Seed of the city and its traffic.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Roads from which the city grows.
    #[arg(long, default_value_t = 80)]
    roads: u32,
    /// Vehicles a kilometre of lane.
    #[arg(long, default_value_t = 10.0)]
    density: f64,
    /// What the car rolls on.
    #[arg(long, value_enum, default_value_t = Wheels::Tyres)]
    wheels: Wheels,
    /// Where to write the map with the way; nowhere by default.
    #[arg(long)]
    map: Option<PathBuf>,
}

/// The body of the car.
#[derive(Clone, Copy, ValueEnum)]
enum Wheels {
    /// Wheels that do not slip.
    Rolling,
    /// Tyres of the physics.
    Tyres,
}

/// Time of a step, s; and of the traffic before anybody drives.
const DT: f64 = 0.1;
const BEFORE: u32 = 300;
/// So long does nobody take, s.
const LONGEST: f64 = 1800.0;

fn main() -> ExitCode {
    exit_code(job(&Arguments::parse()))
}

fn job(arguments: &Arguments) -> Outcome<()> {
    let config = CityConfig::with_roads(arguments.roads);
    let city = City::generate(&config, Seed(arguments.seed))?;
    let (mut simulation, car) = rush_hour(arguments, &city)?;
    let plan =
        GrammarPlanner::default().plan(&Intent::Words(arguments.say.clone()), simulation.world(), car)?;
    println!("\"{}\" is, for {car}: {:?}", arguments.say, plan.steps);
    let mut executor = RuleExecutor::straight();
    executor.start(plan, simulation.world(), car)?;
    let (mut trail, mut actions, mut told) = (Vec::new(), Vec::new(), 0.0);
    let begun = simulation.world().clock().seconds();
    let (progress, seconds) = loop {
        let progress = executor.advance(simulation.world(), car, &mut actions)?;
        for action in actions.drain(..) {
            simulation.submit(Command::Actuate { who: car, action });
        }
        simulation.step()?;
        let seconds = simulation.world().clock().seconds() - begun;
        let entity = simulation.world().entity(car).ok_or("the car is gone")?;
        trail.push(entity.planar());
        if seconds >= told {
            let (at, speed) = (entity.planar(), entity.twist.ground_speed() * 3.6);
            println!("{seconds:6.0} s  ({:7.1}, {:7.1})  {speed:4.0} km/h", at.x, at.y);
            told += 20.0;
        }
        if !progress.goes_on() || seconds > LONGEST {
            break (progress, seconds);
        }
    };
    let way: f64 = trail.windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum();
    println!("{way:.0} m in {seconds:.0} s, {:.0} km/h on average", way / seconds * 3.6);
    draw(arguments, &city, &trail)?;
    match progress {
        Progress::Done => Ok(()),
        Progress::Failed { reason } => Err(reason.into()),
        _ => Err(format!("it is still under way after {LONGEST} s").into()),
    }
}

/// The city with its traffic, and the car that a mind drives.
fn rush_hour(arguments: &Arguments, city: &City) -> Outcome<(Simulation, EntityId)> {
    let mut world = World::new();
    city.populate(&mut world)?;
    let lanes = city.network.lanes.iter().filter(|lane| lane.is_driven());
    let kilometres = lanes.map(|lane| lane.length).sum::<f64>() / 1000.0;
    let vehicles = (kilometres * arguments.density).max(1.0) as u32;
    let config = TrafficConfig { vehicles, pedestrians: vehicles, ..TrafficConfig::default() };
    let mut traffic = TrafficDynamics::new(&mut world, &config, Seed(arguments.seed))?;
    for _ in 0..BEFORE {
        world.begin_step();
        traffic.step(&mut world, DT)?;
        world.finish_step();
    }
    let car = choose(&traffic, &city.network).ok_or("no car is in the middle of a lane: try another seed")?;
    traffic.hand_over(car)?;
    let wheels: Box<dyn Dynamics> = match arguments.wheels {
        Wheels::Rolling => {
            let entity = world.entity(car).ok_or("the car is gone")?;
            let mut rolling = KinematicDynamics::new();
            rolling.insert(car, Box::new(KinematicVehicle::new(*entity.pose, &entity.info.shape)));
            Box::new(rolling)
        }
        Wheels::Tyres => {
            let mut tyres = PhysicsDynamics::new(PhysicsConfig::default())?;
            tyres.add_vehicle(&world, car, VehicleClass::Sedan.parameters())?;
            Box::new(tyres)
        }
    };
    let mut simulation = Simulation::new(world);
    simulation.add_dynamics("traffic", Box::new(traffic));
    simulation.add_dynamics("wheels", wheels);
    println!("{vehicles} vehicles on {kilometres:.1} km of lanes, and as many people");
    Ok((simulation, car))
}

/// A car with some road behind it and before.
fn choose(traffic: &TrafficDynamics, network: &Arc<RoadNetwork>) -> Option<EntityId> {
    let own = traffic.traffic();
    let is_car = |id: u32| own.vehicle(id).is_some_and(|body| body.kind == VehicleKind::Car);
    let mut fitting = own.stations().filter(|(id, track, s, _)| {
        let lane = network.lanes.get(*track as usize);
        lane.is_some_and(|lane| (15.0..lane.length - 20.0).contains(s)) && is_car(*id)
    });
    fitting.next().map(|(id, ..)| traffic.vehicles()[id as usize])
}

/// Writes the map with the way.
fn draw(arguments: &Arguments, city: &City, trail: &[Point2]) -> std::io::Result<()> {
    let Some(path) = &arguments.map else { return Ok(()) };
    let mut drawing = MapDrawing::of(city).title(&arguments.say).trail(trail, "#b3261e", "the way");
    if let Some(last) = trail.last() {
        drawing = drawing.marker(last, "#1f4e9c", "parked");
    }
    std::fs::write(path, drawing.to_string())?;
    println!("the way is on {}", path.display());
    Ok(())
}
