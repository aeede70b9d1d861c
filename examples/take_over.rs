//! One car of the traffic is driven by somebody else, as a real body: pedals and wheel by the control layer, tyres by the
//! physics, and the traffic around it minds it. After some junctions it is given back and drives on by itself.
//!
//! ```sh
//! cargo run --release --example take_over
//! ```

use std::process::ExitCode;
use std::sync::Arc;

use clap::Parser;
use simworld_core::clock::Clock;
use simworld_core::control::Driver;
use simworld_core::geometry::{Point2, planar};
use simworld_core::id::{EntityId, LaneId};
use simworld_core::net::{Aspect, NetworkConfig, RoadNetwork, StreetPlan, Turn, polyline};
use simworld_core::scene::{Scene, World};
use simworld_core::seam::Dynamics;
use simworld_core::seed::Seed;
use simworld_examples::{Outcome, exit_code};
use simworld_physics::{PhysicsConfig, PhysicsDynamics, VehicleClass};
use simworld_traffic::vehicle::VehicleKind;
use simworld_traffic::{TrafficConfig, TrafficDynamics};

/// Takes a car over, drives it through a town, and gives it back.
#[derive(Parser)]
struct Arguments {
    /// Seed of the traffic.
    #[arg(long, default_value_t = 1)]
    seed: u64,
    /// Vehicles to place.
    #[arg(long, default_value_t = 60)]
    vehicles: u32,
    /// Junctions to cross before the car is given back.
    #[arg(long, default_value_t = 3)]
    junctions: usize,
}

/// Time of a step, s.
const DT: f64 = 0.05;
/// The same, µs.
const STEP: u64 = 50_000;
/// So long does nobody take, s.
const LONGEST: f64 = 600.0;

fn main() -> ExitCode {
    exit_code(job(&Arguments::parse()))
}

fn job(arguments: &Arguments) -> Outcome<()> {
    let network = Arc::new(RoadNetwork::derive(&StreetPlan::grid(4, 4, 150.0), &NetworkConfig::default())?);
    let mut world = World::with_clock(Clock::new(STEP)?);
    world.set_roads(Arc::clone(&network));
    let config = TrafficConfig { vehicles: arguments.vehicles, pedestrians: 40, ..TrafficConfig::default() };
    let mut traffic = TrafficDynamics::new(&mut world, &config, Seed(arguments.seed))?;
    let mut physics = PhysicsDynamics::new(PhysicsConfig::default())?;
    for _ in 0..400 {
        step(&mut world, &mut traffic, &mut physics)?;
    }
    let (car, lane) = choose(&traffic, &network)?;
    traffic.hand_over(car)?;
    physics.add_vehicle(&world, car, VehicleClass::Sedan.parameters())?;
    println!("{car} is somebody else's now, on lane {}", lane.0);
    let trip = Trip::new(&network, lane, arguments.junctions);
    let mut driver = Driver::default();
    let (mut way, mut aside, mut before) = (0.0, 0.0_f64, position(&world, car)?);
    while !trip.is_done(before) {
        let entity = world.entity(car).ok_or("the car is gone")?;
        let (pose, speed) = (*entity.pose, entity.twist.ground_speed());
        let wanted = trip.wanted(&world, &traffic, car, planar(&pose));
        for action in driver.drive(&pose, speed, &trip.path, wanted, DT) {
            world.actuate(car, action)?;
        }
        step(&mut world, &mut traffic, &mut physics)?;
        let now = position(&world, car)?;
        way += (now - before).norm();
        before = now;
        aside = aside.max(polyline::closest(&trip.path, &now).map_or(0.0, |near| near.distance));
        if world.clock().seconds() > LONGEST {
            return Err(format!("it has not come through in {LONGEST} s").into());
        }
    }
    let seconds = world.clock().seconds() - 400.0 * DT;
    println!(
        "{way:.0} m and {} junctions in {seconds:.0} s, at most {aside:.2} m beside its lane",
        trip.junctions
    );
    physics.remove(car)?;
    while let Err(reason) = traffic.give_back(&world, car) {
        println!("not yet: {reason}");
        step(&mut world, &mut traffic, &mut physics)?;
    }
    for _ in 0..1200 {
        step(&mut world, &mut traffic, &mut physics)?;
    }
    let by_itself = (position(&world, car)? - before).norm();
    println!(
        "given back: a minute later it is {by_itself:.0} m away, {} vehicles are present",
        traffic.traffic().vehicles().count()
    );
    Ok(())
}

fn step(world: &mut World, traffic: &mut TrafficDynamics, physics: &mut PhysicsDynamics) -> Outcome<()> {
    world.begin_step();
    traffic.step(world, DT)?;
    physics.step(world, DT)?;
    world.finish_step();
    Ok(())
}

fn position(world: &World, id: EntityId) -> Outcome<Point2> {
    Ok(world.entity(id).ok_or("the car is gone")?.planar())
}

/// A car with some road before it, and its lane.
fn choose(traffic: &TrafficDynamics, network: &RoadNetwork) -> Outcome<(EntityId, LaneId)> {
    let own = traffic.traffic();
    let is_car = |id: u32| own.vehicle(id).is_some_and(|body| body.kind == VehicleKind::Car);
    let found = own.stations().find(|(id, track, s, _)| {
        network.lanes.get(*track as usize).is_some_and(|lane| (15.0..lane.length - 60.0).contains(s))
            && is_car(*id)
    });
    let (id, track, ..) = found.ok_or("no car has sixty metres before it: try another seed")?;
    Ok((traffic.vehicles()[id as usize], LaneId(track)))
}

/// The way through some junctions: straight on, or else as the first way leads.
struct Trip<'a> {
    network: &'a RoadNetwork,
    path: Vec<Point2>,
    /// Stop lines: the station and the signal group.
    lines: Vec<(f64, Option<usize>)>,
    junctions: usize,
    end: f64,
}

impl<'a> Trip<'a> {
    fn new(network: &'a RoadNetwork, mut lane: LaneId, junctions: usize) -> Self {
        let mut path = network.lanes[lane.index()].path.clone();
        let (mut lines, mut station) = (Vec::new(), network.lanes[lane.index()].length);
        for _ in 0..junctions {
            let ways =
                network.lanes[lane.index()].outgoing.iter().map(|way| &network.connections[way.index()]);
            let Some(way) =
                ways.clone().find(|way| way.turn == Turn::Straight).or_else(|| ways.clone().next())
            else {
                break;
            };
            lines.push((station, way.signal.map(simworld_core::net::SignalGroup::index)));
            lane = way.to;
            path.extend(way.path.iter().chain(&network.lanes[lane.index()].path));
            station += way.length + network.lanes[lane.index()].length;
        }
        // It is given back in the middle of the last lane.
        let end = station - network.lanes[lane.index()].length * 0.5;
        let junctions = lines.len();
        Self { network, path, lines, junctions, end }
    }

    fn station(&self, at: Point2) -> f64 {
        polyline::closest(&self.path, &at).map_or(0.0, |near| near.station)
    }

    fn is_done(&self, at: Point2) -> bool {
        self.station(at) >= self.end
    }

    /// The speed of a careful driver: that allows it to stop behind who is ahead and before a line that is not green, m/s.
    fn wanted(&self, world: &World, traffic: &TrafficDynamics, own: EntityId, at: Point2) -> f64 {
        let here = self.station(at);
        let stopping = |room: f64| (2.0 * 1.5 * room.max(0.0)).sqrt();
        let mut wanted = 7.0_f64;
        for (line, group) in &self.lines {
            let room = line - here - 3.5;
            let is_green = group.is_none_or(|group| world.signals()[group] == Aspect::Green);
            if !is_green && room > -1.0 {
                wanted = wanted.min(stopping(room));
            }
        }
        for id in traffic.vehicles().iter().chain(traffic.pedestrians()).filter(|id| **id != own) {
            let Some(entity) = world.entity(*id).filter(|entity| (entity.planar() - at).norm() < 35.0) else {
                continue;
            };
            let size = entity.info.shape.size() * 0.5;
            let near = polyline::closest(&self.path, &entity.planar());
            if let Some(near) = near.filter(|near| near.distance < 1.2 + size.y && near.station > here) {
                wanted = wanted.min(stopping(near.station - here - size.x - 4.5));
            }
        }
        wanted.min(self.network.lanes[0].speed_limit)
    }
}
