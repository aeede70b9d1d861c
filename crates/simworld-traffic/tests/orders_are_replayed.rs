//! What the outside asks of the traffic of a world is recorded, and a replay of it takes the same way to the bit.

use std::sync::Arc;

use simworld_core::command::Command;
use simworld_core::environment::{Environment, Weather};
use simworld_core::event::EventKind;
use simworld_core::geometry::{Point2, Twist, direction, pose_facing, yaw_of};
use simworld_core::hash::StateHash;
use simworld_core::id::{EntityId, LaneId, RoadId};
use simworld_core::net::{CrossSection, LaneDirection, NetworkConfig, RoadNetwork, StreetPlan};
use simworld_core::record::Recording;
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
use simworld_core::seam::Dynamics;
use simworld_core::seed::Seed;
use simworld_core::simulation::Simulation;
use simworld_core::traffic::{ClosedWay, LaneChoice, TrafficOrder};
use simworld_traffic::{TrafficConfig, TrafficDynamics};

const STEPS: u64 = 1500;

/// A town with traffic, and the entities of its vehicles and walkers.
fn town() -> (Simulation, Vec<EntityId>, Vec<EntityId>) {
    let mut plan = StreetPlan::grid(3, 3, 160.0);
    plan.sections[0] = CrossSection::two_way(2, 2);
    let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("a grid is a network");
    let mut world = World::new();
    world.set_roads(Arc::new(network));
    let config = TrafficConfig { vehicles: 60, pedestrians: 60, ..TrafficConfig::default() };
    let traffic = TrafficDynamics::new(&mut world, &config, Seed(4)).expect("the settings are in range");
    let (vehicles, walkers) = (traffic.vehicles().to_vec(), traffic.pedestrians().to_vec());
    let mut simulation = Simulation::new(world);
    simulation.add_dynamics("traffic", Box::new(traffic));
    (simulation, vehicles, walkers)
}

/// A trip along the first street, from and to a place at its kerb.
fn kerb_to_kerb(kind: &str, from: f64, to: f64) -> TrafficOrder {
    let route = vec![(RoadId(0), LaneDirection::Forward)];
    TrafficOrder::SendVehicle { kind: kind.to_owned(), route, from: Some(from), to: Some(to) }
}

/// What happens in the town from outside, by step.
fn orders(step: u64, vehicles: &[EntityId], walkers: &[EntityId]) -> Vec<Command> {
    let leg = (RoadId(0), LaneDirection::Forward);
    let orders = match step {
        50 => vec![
            TrafficOrder::Close { what: ClosedWay::Leg(leg), seconds: Some(60.0) },
            TrafficOrder::Close { what: ClosedWay::Lane(LaneId(9)), seconds: None },
        ],
        100 => vec![
            TrafficOrder::Halt { who: vehicles[3], seconds: Some(30.0) },
            TrafficOrder::Halt { who: vehicles[4], seconds: None },
        ],
        150 => vec![
            TrafficOrder::SendVehicle { kind: "van".to_owned(), route: vec![leg], from: None, to: None },
            kerb_to_kerb("emergency", 40.0, 110.0),
        ],
        200 => {
            let weather = Weather { rain: 20.0, ..Weather::default() };
            return vec![
                Command::SetEnvironment(Environment { weather, ..Environment::default() }),
                Command::Remove { id: vehicles[7] },
                Command::Remove { id: walkers[7] },
            ];
        }
        250 => vec![
            TrafficOrder::AddWalker { at: Point2::new(30.0, 9.0), to: Some(Point2::new(160.0, 169.0)) },
            TrafficOrder::SendWalker { who: walkers[2], to: Point2::new(0.0, 9.0), leaves: true },
            TrafficOrder::Guide { who: walkers[3], speed: 0.4, keep_right: 0.2, dares: true },
        ],
        300 => vec![
            TrafficOrder::Drive { who: vehicles[10], acceleration: 2.0, lane: LaneChoice::Left, next: None },
            TrafficOrder::HandOver { who: vehicles[11] },
            TrafficOrder::HandOver { who: walkers[5] },
        ],
        600 => vec![
            TrafficOrder::Reopen { number: 1 },
            TrafficOrder::GiveBack { who: vehicles[10] },
            TrafficOrder::GiveBack { who: vehicles[11] },
            TrafficOrder::GiveBack { who: walkers[5] },
        ],
        // Impossible, all of them.
        700 => vec![
            TrafficOrder::Reopen { number: 77 },
            TrafficOrder::Halt { who: walkers[1], seconds: None },
            TrafficOrder::Drive {
                who: vehicles[12],
                acceleration: f64::NAN,
                lane: LaneChoice::Keep,
                next: None,
            },
            TrafficOrder::SendVehicle { kind: "tank".to_owned(), route: vec![leg], from: None, to: None },
            TrafficOrder::SendVehicle { kind: "car".to_owned(), route: vec![], from: None, to: None },
            kerb_to_kerb("car", 40.0, 159.0),
            TrafficOrder::Siren { who: vehicles[12], is_on: true },
            TrafficOrder::Close { what: ClosedWay::Stretch(LaneId(2), 9.0, 4.0), seconds: None },
            TrafficOrder::GiveBack { who: vehicles[13] },
            TrafficOrder::Guide { who: walkers[1], speed: -1.0, keep_right: 0.0, dares: false },
        ],
        _ => Vec::new(),
    };
    orders.into_iter().map(Command::Traffic).collect()
}

/// Moves the entity of a vehicle that was handed over on along its way, as another part of the world would.
fn push(simulation: &mut Simulation, step: u64, who: EntityId) {
    if (301..600).contains(&step)
        && let Some(entity) = simulation.world().entity(who)
    {
        let (mut pose, yaw) = (*entity.pose, yaw_of(entity.pose));
        let ahead = direction(yaw) * 0.2;
        pose.translation.vector.x += ahead.x * 0.1;
        pose.translation.vector.y += ahead.y * 0.1;
        let twist = Twist { linear: ahead.push(0.0), ..Twist::ZERO };
        let bond = None;
        simulation.apply(&Command::Reset { id: who, pose, twist, bond }).expect("it is there");
    }
}

#[test]
fn a_replay_takes_the_same_way_and_what_cannot_be_is_reported() {
    let (mut simulation, vehicles, walkers) = town();
    let (mut refused, mut closed, mut most) = (0, Vec::new(), 0);
    for step in 0..STEPS {
        for command in orders(step, &vehicles, &walkers) {
            simulation.submit(command);
        }
        simulation.begin_step();
        push(&mut simulation, step, vehicles[11]);
        simulation.finish_step().expect("traffic goes on");
        for event in simulation.world().events() {
            match &event.kind {
                EventKind::Task { name, .. } if name == "traffic_refused" => {
                    assert!(matches!(step, 600 | 700), "at step {step}: {event:?}");
                    refused += u32::from(step == 700);
                }
                EventKind::Task { name, data, .. } if name == "closed" => closed.push(data["number"].clone()),
                _ => {}
            }
        }
        most = most.max(simulation.world().len());
    }
    assert_eq!((refused, closed.len()), (10, 2), "{closed:?}");
    let world = simulation.world();
    assert!(world.entity(vehicles[7]).is_none() && world.entity(walkers[7]).is_none());
    assert!(most >= 120, "somebody entered: {most}");
    assert!(world.entity(vehicles[4]).is_some_and(|broken| broken.twist.ground_speed() == 0.0));
    let recording: Recording = simulation.recording().clone();
    assert_eq!(recording.commands.len(), 29);
    assert_eq!(recording.trail.len() as u64, STEPS / 10);
    let (mut replay, vehicles, _) = town();
    for step in 0..STEPS {
        let tick = replay.world().clock().tick();
        for command in recording.commands_at(tick) {
            replay.submit(command.clone());
        }
        replay.begin_step();
        push(&mut replay, step, vehicles[11]);
        replay.finish_step().expect("traffic goes on");
        let now = replay.world().clock().tick();
        recording.confirm(now, replay.digest()).expect("the same bits");
    }
    assert_eq!(replay.digest(), simulation.digest());
}

#[test]
fn a_snapshot_in_the_middle_goes_on_to_the_bit() {
    let (mut simulation, vehicles, walkers) = town();
    let run = |simulation: &mut Simulation, steps: std::ops::Range<u64>| {
        for step in steps {
            for command in orders(step, &vehicles, &walkers) {
                simulation.submit(command);
            }
            simulation.begin_step();
            push(simulation, step, vehicles[11]);
            simulation.finish_step().expect("traffic goes on");
        }
    };
    run(&mut simulation, 0..400);
    let saved = simulation.save().expect("it can be saved");
    run(&mut simulation, 400..900);
    let mut resumed = town().0;
    resumed.restore(saved).expect("it is its own");
    run(&mut resumed, 400..900);
    assert_eq!(resumed.digest(), simulation.digest());
}

#[test]
fn who_is_put_in_the_way_by_another_is_minded_and_joins_from_where_it_is() {
    let (mut simulation, vehicles, _) = town();
    for _ in 0..20 {
        simulation.step().expect("traffic goes on");
    }
    let who = vehicles[20];
    simulation.submit(Command::Traffic(TrafficOrder::HandOver { who }));
    simulation.step().expect("traffic goes on");
    let at = *simulation.world().entity(who).expect("it is there").pose;
    for _ in 0..300 {
        simulation.step().expect("traffic goes on");
    }
    let still = *simulation.world().entity(who).expect("it is there").pose;
    assert_eq!(at, still, "nobody moves it, so it stays");
    // A wall in its place changes nothing of the others: it is theirs to mind as any other body.
    let shape = Shape::cuboid(0.5, 0.5, 1.0);
    let pose = pose_facing(at.translation.vector.into(), 0.0);
    simulation.submit(Command::Spawn(Box::new(EntityDesc::new(EntityKind::Prop, pose, shape))));
    simulation.submit(Command::Traffic(TrafficOrder::GiveBack { who }));
    for _ in 0..600 {
        simulation.step().expect("traffic goes on");
    }
    let gone = *simulation.world().entity(who).expect("it is there").pose;
    assert!((gone.translation.vector - at.translation.vector).norm() > 5.0, "it drives on");
}

#[test]
fn an_ambulance_leaves_the_kerb_by_order_and_its_siren_is_switched() {
    let mut world = World::new();
    let network = RoadNetwork::derive(&StreetPlan::grid(3, 3, 160.0), &NetworkConfig::default());
    world.set_roads(Arc::new(network.expect("a grid is a network")));
    let config = TrafficConfig { vehicles: 0, pedestrians: 0, ..TrafficConfig::default() };
    let mut traffic = TrafficDynamics::new(&mut world, &config, Seed(4)).expect("the settings are in range");
    let order = |world: &mut World, order| {
        world.apply(&Command::Traffic(order)).expect("orders are taken");
    };
    let step = |world: &mut World, traffic: &mut TrafficDynamics| {
        world.begin_step();
        traffic.step(world, 0.1).expect("traffic goes on");
        world.finish_step();
    };
    order(&mut world, kerb_to_kerb("emergency", 40.0, 110.0));
    step(&mut world, &mut traffic);
    assert_eq!(traffic.vehicles().len(), 1, "it stands at the kerb at once");
    let who = traffic.vehicles()[0];
    for is_on in [false, true] {
        order(&mut world, TrafficOrder::Siren { who, is_on });
        step(&mut world, &mut traffic);
        assert_eq!(!traffic.traffic().sirens().is_empty(), is_on);
    }
    for _ in 0..900 {
        step(&mut world, &mut traffic);
    }
    assert!(world.entity(who).is_none(), "it came to its place and is gone");
}
