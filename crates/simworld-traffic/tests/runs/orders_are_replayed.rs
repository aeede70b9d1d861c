//! What the outside asks of the traffic of a world is recorded, and a replay of it takes the same way to the bit.

use std::sync::Arc;

use simworld_core::command::Command;
use simworld_core::environment::{Environment, Weather};
use simworld_core::event::EventKind;
use simworld_core::geometry::{Point2, Twist, direction, planar, pose_facing, yaw_of};
use simworld_core::hash::StateHash;
use simworld_core::id::{EntityId, LaneId, RoadId};
use simworld_core::net::{
    CrossSection, LaneDirection, NetworkConfig, RoadNetwork, SignalGroup, Street, StreetPlan, polyline,
};
use simworld_core::ops::wrap_angle;
use simworld_core::record::Recording;
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
use simworld_core::seam::Dynamics;
use simworld_core::seed::Seed;
use simworld_core::simulation::Simulation;
use simworld_core::traffic::{ClosedWay, LaneChoice, SignalTiming, TrafficOrder};
use simworld_traffic::vehicle::VehicleKind;
use simworld_traffic::{Leg, Route, Traffic, TrafficConfig, TrafficDynamics, TripEnd};

const STEPS: u64 = 1500;
const TIMING: SignalTiming = SignalTiming { green: 12.0, yellow: 4.0, walk: 9.0 };

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
        350 => vec![
            TrafficOrder::HoldSignal { group: SignalGroup(2), seconds: Some(20.0) },
            TrafficOrder::HoldSignal { group: SignalGroup(9), seconds: None },
            TrafficOrder::TimeSignal { group: SignalGroup(20), timing: TIMING },
            TrafficOrder::TurnRound { who: vehicles[14] },
            TrafficOrder::Reroute { who: vehicles[15], through: vec![(RoadId(3), LaneDirection::Forward)] },
        ],
        600 => vec![
            TrafficOrder::FreeSignal { group: SignalGroup(9) },
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
            TrafficOrder::HoldSignal { group: SignalGroup(7000), seconds: None },
            TrafficOrder::HoldSignal { group: SignalGroup(2), seconds: Some(f64::NAN) },
            TrafficOrder::FreeSignal { group: SignalGroup(2) },
            TrafficOrder::TimeSignal {
                group: SignalGroup(2),
                timing: SignalTiming { yellow: 0.0, ..TIMING },
            },
            TrafficOrder::TurnRound { who: walkers[1] },
            TrafficOrder::Reroute { who: vehicles[12], through: vec![] },
            TrafficOrder::Reroute {
                who: vehicles[12],
                through: vec![(RoadId(7000), LaneDirection::Forward)],
            },
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
    assert_eq!((refused, closed.len()), (17, 2), "{closed:?}");
    let world = simulation.world();
    assert!(world.entity(vehicles[7]).is_none() && world.entity(walkers[7]).is_none());
    assert!(most >= 120, "somebody entered: {most}");
    assert!(world.entity(vehicles[4]).is_some_and(|broken| broken.twist.ground_speed() == 0.0));
    let recording: Recording = simulation.recording().clone();
    assert_eq!(recording.commands.len(), 42);
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

/// The leg on whose lanes a vehicle stands or drives; none in a junction.
fn leg_of(traffic: &Traffic, id: u32) -> Option<Leg> {
    let body = traffic.vehicle(id)?;
    let network = traffic.network();
    let lane = (0..network.lanes.len()).map(LaneId::from_index).find(|lane| {
        let path = &network.lanes[lane.index()].path;
        polyline::closest(path, &planar(&body.pose)).is_some_and(|near| {
            let along = polyline::at(path, near.station).1;
            near.distance < 0.5 && wrap_angle(along - yaw_of(&body.pose)).abs() < 0.3
        })
    });
    lane.map(|lane| Leg::of(network, lane))
}

fn opposite(leg: Leg) -> Leg {
    let backward = Leg::new(leg.road(), LaneDirection::Backward);
    if leg == backward { Leg::new(leg.road(), LaneDirection::Forward) } else { backward }
}

#[test]
fn vehicles_turn_round_and_drive_on() {
    let network = RoadNetwork::derive(&StreetPlan::grid(3, 3, 120.0), &NetworkConfig::default());
    let network = Arc::new(network.expect("a grid is a network"));
    let config = TrafficConfig { vehicles: 20, pedestrians: 0, ..TrafficConfig::default() };
    let mut traffic =
        Traffic::new(Arc::clone(&network), &config, Seed(6)).expect("the settings are in range");
    for _ in 0..100 {
        traffic.step(0.1);
    }
    let mut turning: Vec<(u32, Leg)> = (0..20).filter_map(|id| Some((id, leg_of(&traffic, id)?))).collect();
    assert!(turning.len() >= 10, "most are between junctions");
    // Who has leave to cross already turns round on the road to which it comes.
    for (id, _) in &turning {
        traffic.turn_round(*id).expect("every road of a grid has two directions");
    }
    // And one that has a way to go, first straight on.
    let east = Leg::new(RoadId(0), LaneDirection::Forward);
    let router = simworld_traffic::Router::new(&network);
    let goal = Leg::new(RoadId(1), LaneDirection::Forward);
    let route = router.quickest(east, goal).unwrap_or(Route(vec![east]));
    traffic.insert(route, VehicleKind::Truck).expect("it can be driven");
    let (mut truck, mut truck_turned, mut truck_end) = (None, false, None);
    for step in 0..4000 {
        traffic.step(0.1);
        if let (None, [id]) = (truck, traffic.entered()) {
            truck = Some(*id);
            traffic.turn_round(*id).expect("its road has two directions");
        }
        if step % 5 == 0 {
            turning.retain(|(id, leg)| leg_of(&traffic, *id) != Some(opposite(*leg)));
            truck_turned |= truck.and_then(|id| leg_of(&traffic, id)) == Some(opposite(east));
        }
        truck_end =
            truck_end.or(traffic.ended().iter().find(|trip| Some(trip.id) == truck).map(|trip| trip.end));
    }
    assert!(turning.len() <= 3, "they never came back: {turning:?}");
    assert!((0..20).all(|id| traffic.vehicle(id).is_some()), "who drives as it likes drives on");
    assert!(truck_turned, "the truck turned round before it went on");
    assert_eq!(truck_end, Some(TripEnd::Arrived), "and came where it was going");
}

#[test]
fn nobody_turns_round_in_a_street_of_one_direction() {
    let mut plan =
        StreetPlan { nodes: vec![Point2::new(0.0, 0.0), Point2::new(300.0, 0.0)], ..StreetPlan::default() };
    let section = plan.add_section(CrossSection::two_way(1, 0));
    plan.streets.push(Street { section, ..Street::simple(0, 1) });
    let network = RoadNetwork::derive(&plan, &NetworkConfig::default()).expect("a street is a network");
    let config = TrafficConfig { vehicles: 0, pedestrians: 0, ..TrafficConfig::default() };
    let mut traffic = Traffic::new(Arc::new(network), &config, Seed(6)).expect("the settings are in range");
    let leg = Leg::new(RoadId(0), LaneDirection::Forward);
    traffic.insert(Route(vec![leg]), VehicleKind::Car).expect("it can be driven");
    traffic.step(0.1);
    let error = traffic.turn_round(traffic.entered()[0]).expect_err("there is no way back");
    assert_eq!(error.to_string(), "vehicle 0 cannot be sent there: its road has no lanes the other way");
}
