//! Sentences are driven: by a person at the wheel of a car, and by a car that drives itself, as bodies on their own tyres,
//! in lane, within the limits, at green, round what stands in the way and to the kerb.

use simworld_agents::executor::{CannotArrive, RuleExecutor};
use simworld_core::action::Action;
use simworld_core::command::Command;
use simworld_core::geometry::{Point2, Point3, Twist, Vector3, pose_facing, yaw_of};
use simworld_core::id::RoadId;
use simworld_core::kinematic::{KinematicDynamics, KinematicVehicle};
use simworld_core::net::{RoadNetwork, polyline};
use simworld_core::passage::Passage;
use simworld_core::scene::{EntityDesc, EntityKind, Role, Scene, Shape};
use simworld_core::seam::{Executor, Goal, Plan, PlanStep, Progress};
use simworld_core::seed::Seed;
use simworld_core::simulation::Simulation;
use simworld_traffic::{TrafficConfig, TrafficDynamics};

use crate::town::{Run, Town, Worst, put};

#[test]
fn a_person_gets_in_drives_and_gets_out() {
    let town = Town::new();
    let (person, hospital) = (town.person, town.hospital);
    let mut run = town.run(person, "get into the red car, drive to the hospital and get out");
    assert_eq!(run.finish(400), Progress::Done, "{:?}", run.worst);
    let world = run.simulation.world();
    let (door, car) = (world.entity(hospital).unwrap().access().xy(), world.entity(run.car).unwrap());
    assert!((car.planar() - door).norm() < 25.0, "parked {:.0} m away", (car.planar() - door).norm());
    assert!(car.twist.ground_speed() < 0.3 && world.attached(run.car, Role::Aboard).is_none());
    let out = world.entity(person).unwrap();
    assert!(out.attachment.is_none() && (out.planar() - car.planar()).norm() < 3.0);
    let Worst { aside, too_fast, at_red, driven } = run.worst;
    assert!(driven > 350.0, "drove {driven:.0} m");
    assert!(aside < 1.0, "{aside:.2} m beside the lane");
    assert!(too_fast < 1.0, "{too_fast:.2} m/s too fast");
    assert_eq!(at_red, 0, "drove at red");
}

#[test]
fn a_car_drives_itself_and_parks_at_the_kerb() {
    let town = Town::new();
    let car = town.car;
    let mut run = town.run(car, "drive to the hospital and wait for two seconds");
    assert_eq!(run.finish(400), Progress::Done);
    // The northern lane of the street before the hospital goes west; the kerb is 3.5 m from the middle of the street.
    let (at, edge) = (run.car_at(), 0.9 + 0.3);
    let from_middle = (at.y - 240.0).abs();
    assert!((3.5 - from_middle - edge).abs() < 0.4, "{from_middle:.2} m from the middle of the street");
    assert_eq!(run.worst.at_red, 0);
}

#[test]
fn streets_that_close_are_not_entered() {
    let town = Town::new();
    let car = town.car;
    let usual = route_of(town.run(car, "drive to the hospital"), |_| {});
    // The street that the way leads through closes when the car has begun, in both directions.
    let shut = usual[1];
    let town = Town::new();
    let around = route_of(town.run(car, "drive to the hospital"), |run| close(run, &[shut]));
    assert!(!around.contains(&shut), "{around:?} goes through {shut:?}");
    assert_eq!(around.last(), usual.last(), "it comes to the same street");
}

#[test]
fn a_driver_says_that_streets_are_closed() {
    let town = Town::new();
    let car = town.car;
    let mut run = town.run(car, "drive to the hospital");
    let network = run.network.clone();
    let own = road_at(&network, run.car_at()).expect("it is parked in a street");
    let others: Vec<RoadId> =
        (0..network.roads.len()).map(RoadId::from_index).filter(|road| *road != own).collect();
    run.step();
    close(&mut run, &others);
    let Progress::Failed { reason } = run.finish(60) else { panic!("it arrived") };
    assert!(reason.contains("closed"), "{reason}");
}

fn close(run: &mut Run, roads: &[RoadId]) {
    for road in roads {
        for direction in run.network.roads[road.index()].directions() {
            let passage = Passage::Closed;
            run.simulation.submit(Command::SetPassage { leg: (*road, direction), passage });
        }
    }
}

/// The road somewhere between whose junctions a place is.
fn road_at(network: &RoadNetwork, at: Point2) -> Option<RoadId> {
    let found = network.lanes.iter().find(|lane| {
        let near = polyline::closest(&lane.path, &at);
        near.is_some_and(|near| near.distance < 2.5 && (5.0..lane.length - 5.0).contains(&near.station))
    });
    found.map(|lane| lane.road)
}

/// The roads that a car is on while it goes where it was sent, each named when it is entered; something is done after a second.
fn route_of(mut run: Run, after_a_second: impl FnOnce(&mut Run)) -> Vec<RoadId> {
    let mut roads = Vec::new();
    let mut next = Some(after_a_second);
    for tick in 0..4000 {
        if tick == 10
            && let Some(event) = next.take()
        {
            event(&mut run);
        }
        let progress = run.step();
        let road = road_at(&run.network, run.car_at());
        roads.extend(road.filter(|road| roads.last() != Some(road)));
        if !progress.goes_on() {
            assert_eq!(progress, Progress::Done);
            return roads;
        }
    }
    panic!("still under way, over {roads:?}");
}

#[test]
fn what_stands_in_the_lane_is_passed() {
    let mut town = Town::new();
    let crate_at = pose_facing(Point3::new(90.0, -1.9, 0.0), 0.0);
    town.world.spawn(EntityDesc::new(EntityKind::Prop, crate_at, Shape::cuboid(1.2, 1.2, 1.0))).unwrap();
    let car = town.car;
    let mut run = town.run(car, "drive to the hospital");
    let obstacle = Point2::new(90.0, -1.9);
    let mut nearest = f64::INFINITY;
    let mut ended = Progress::Running;
    for _ in 0..4000 {
        ended = run.step();
        nearest = nearest.min((run.car_at() - obstacle).norm());
        if !ended.goes_on() {
            break;
        }
    }
    assert_eq!(ended, Progress::Done);
    assert!(nearest > 1.5, "{nearest:.2} m: through the crate");
    assert!(run.worst.driven > 350.0);
}

#[test]
fn people_in_the_way_are_waited_for_and_a_stop_is_at_once() {
    let mut town = Town::new();
    let body = Shape::Capsule { radius: 0.25, height: 1.8 };
    let in_lane = pose_facing(Point3::new(85.0, -1.75, 0.0), 0.0);
    let stranger = town.world.spawn(EntityDesc::new(EntityKind::Person, in_lane, body)).unwrap();
    let car = town.car;
    let mut run = town.run(car, "drive to the hospital");
    for _ in 0..150 {
        run.step();
    }
    let waiting = run.car_at();
    assert!(
        waiting.x > 70.0 && waiting.x < 82.5,
        "it waits behind the stranger, and stands at {}",
        waiting.x
    );
    run.simulation.submit(Command::Remove { id: stranger });
    for _ in 0..60 {
        run.step();
    }
    assert!(run.car_at().x > waiting.x + 5.0, "it goes on when the lane is free");
    let mut out = Vec::new();
    run.executor.cancel(&mut out);
    assert_eq!(out, [Action::Stop]);
    run.simulation.submit(Command::Actuate { who: car, action: Action::Stop });
    for _ in 0..50 {
        run.simulation.step().unwrap();
    }
    assert!(run.simulation.world().entity(car).unwrap().twist.ground_speed() < 0.1);
}

#[test]
fn a_car_that_broke_down_is_passed_when_nobody_comes() {
    let mut town = Town::new();
    put(&mut town, EntityKind::Car, (80.0, -1.75), (4.5, 1.8));
    let car = town.car;
    let mut run = town.run(car, "drive to the hospital");
    let mut nearest = f64::INFINITY;
    let mut ended = (0..4000).map(|_| {
        let progress = run.step();
        nearest = nearest.min((run.car_at() - Point2::new(80.0, -1.75)).norm());
        progress
    });
    let ended = ended.find(|progress| !progress.goes_on());
    assert_eq!(ended, Some(Progress::Done), "{:?} at {:?}", run.worst, run.car_at());
    assert!(nearest > 2.0 && nearest < 6.0, "{nearest:.2} m from it");
}

#[test]
fn who_is_parked_beside_the_lane_is_no_queue() {
    let mut town = Town::new();
    // Before the junction, where others stand who wait for it.
    let parked = put(&mut town, EntityKind::Car, (98.0, -2.85), (4.5, 1.8));
    let car = town.car;
    let mut run = town.run(car, "drive to the hospital");
    let (mut stood, mut least) = (0, f64::INFINITY);
    while run.car_at().x < 103.0 {
        assert!(run.step().goes_on());
        let world = run.simulation.world();
        let [own, other] = [car, parked].map(|id| world.entity(id).expect("it is there"));
        stood += usize::from(own.twist.ground_speed() < 0.1);
        least = least.min(own.info.shape.planar_distance(own.pose, &other.planar()));
        assert!(!own.obb().footprints_overlap(&other.obb()), "it drove into it");
        assert!(stood < 100, "it waits behind it at {:?}", run.car_at());
    }
    assert!(least < 1.6, "{least:.2} m: nothing was parked beside the lane");
    assert_eq!(run.finish(400), Progress::Done);
}

/// A car has swung out past a parked one when a bus comes up beside its nose: the bus does not go on past a corner that is so near, and
/// the car does not into the bus. The car backs, and then the bus is gone.
#[test]
fn who_has_swung_out_makes_way_for_who_stands_beside_it() {
    let mut town = Town::new();
    put(&mut town, EntityKind::Car, (57.8, -2.9), (4.5, 1.8));
    let bus = put(&mut town, EntityKind::Bus, (46.5, 0.3), (11.5, 2.5));
    let car = town.car;
    let swung = pose_facing(Point3::new(50.0, -2.2, 0.0), 0.1);
    town.world.set_motion(car, swung, Twist::ZERO).expect("it is there");
    let mut run = town.run(car, "drive to the hospital");
    let (mut waited, mut least) = (0, f64::INFINITY);
    while run.car_at().x < 60.0 {
        assert!(run.step().goes_on(), "{:?}", run.executor.cannot_arrive());
        let world = run.simulation.world();
        let [own, other] = [car, bus].map(|id| world.entity(id).expect("it is there"));
        assert!(!own.obb().footprints_overlap(&other.obb()), "it drove into the bus");
        let mut way = other.obb();
        way.half_extents += Vector3::new(0.5, 0.2, 0.0);
        let at = other.planar();
        if way.footprints_overlap(&own.obb()) {
            waited += 1;
        } else if at.x < 300.0 {
            let pose = pose_facing(Point3::new(at.x + 0.3, at.y, 0.0), 0.0);
            run.simulation.submit(Command::Move { id: bus, pose });
        }
        least = least.min(run.car_at().x);
        assert!(waited < 400, "they wait for one another at {:?}", run.car_at());
    }
    assert!(waited > 10, "the bus had room all the time");
    assert!(least < 49.0, "it went no farther back than to {least:.1} m");
    assert_eq!(run.finish(400), Progress::Done);
}

#[test]
fn a_blocked_street_is_left_by_turning_round_in_it() {
    let mut town = Town::new();
    // From kerb to kerb, before the next junction.
    put(&mut town, EntityKind::Prop, (85.0, 0.0), (1.0, 7.0));
    let car = town.car;
    let mut run = town.run(car, "drive to the hospital");
    let mut least = f64::INFINITY;
    let mut ended = (0..6000).map(|_| {
        let progress = run.step();
        least = least.min(run.car_at().x);
        progress
    });
    let ended = ended.find(|progress| !progress.goes_on());
    assert_eq!(ended, Some(Progress::Done), "{:?} at {:?}", run.worst, run.car_at());
    assert!(least < 5.0, "it left by the other end of the street, as far as x = {least:.1} m");
}

/// The street is blocked, and along its other side stands a row that leaves no room to come round: one begins to turn, gives it up,
/// looks ahead again, and drives on when the street is free.
#[test]
fn who_has_no_room_to_turn_round_goes_on_when_the_way_is_free() {
    let mut town = Town::new();
    let wall = put(&mut town, EntityKind::Prop, (85.0, 0.0), (1.0, 7.0));
    for place in 0..8 {
        put(&mut town, EntityKind::Prop, (48.0 + 4.8 * f64::from(place), 2.45), (4.5, 2.1));
    }
    let car = town.car;
    let mut run = town.run(car, "drive to the hospital");
    let (mut ended, mut most_turned, mut looks_ahead) = (Progress::Running, 0.0_f64, false);
    for _ in 0..9000 {
        ended = run.step();
        let world = run.simulation.world();
        let own = world.entity(car).expect("it is there");
        let turned = yaw_of(own.pose).abs();
        if !looks_ahead {
            most_turned = most_turned.max(turned);
            looks_ahead = most_turned > 0.5 && turned < 0.4;
        }
        let touched = world
            .iter()
            .find(|other| other.kind == EntityKind::Prop && own.obb().footprints_overlap(&other.obb()));
        assert!(
            touched.is_none(),
            "it touches {:?} at {:?}",
            touched.map(|other| other.planar()),
            run.car_at()
        );
        if looks_ahead && world.entity(wall).is_some() {
            run.simulation.submit(Command::Remove { id: wall });
        }
        if !ended.goes_on() {
            break;
        }
    }
    assert!(looks_ahead, "it never looked ahead again, and had turned by {most_turned:.2}");
    assert_eq!(ended, Progress::Done, "{:?} at {:?}", run.executor.cannot_arrive(), run.car_at());
}

#[test]
fn who_is_walled_in_says_by_what() {
    let mut town = Town::new();
    let walls = [85.0, 15.0].map(|x| put(&mut town, EntityKind::Prop, (x, 0.0), (1.0, 7.0)));
    let car = town.car;
    let mut run = town.run(car, "drive to the hospital");
    let ended = (0..9000).map(|_| run.step()).find(|progress| !progress.goes_on());
    let Some(Progress::Failed { reason }) = ended else { panic!("{ended:?} at {:?}", run.car_at()) };
    let why = run.executor.cannot_arrive().expect("it says why");
    assert_eq!(reason, why.to_string());
    let CannotArrive::Blocked { by, at, .. } = why else { panic!("{why:?}") };
    assert!(walls.contains(by) && at.x > 15.0 && at.x < 85.0, "{why:?}");
}

#[test]
fn a_motorcycle_is_ridden_to_the_kerb_by_who_got_on_it() {
    let mut town = Town::new();
    let bike = put(&mut town, EntityKind::Motorcycle, (41.0, -2.6), (2.1, 0.8));
    let mut wheels = KinematicDynamics::new();
    let entity = town.world.entity(bike).expect("it is there");
    wheels.insert(bike, Box::new(KinematicVehicle::new(*entity.pose, &entity.info.shape)));
    let (rider, hospital) = (town.person, town.hospital);
    let beside = pose_facing(Point3::new(41.0, -3.6, 0.0), 0.0);
    let quiet = TrafficConfig { vehicles: 0, pedestrians: 0, ..TrafficConfig::default() };
    let lights = TrafficDynamics::new(&mut town.world, &quiet, Seed(1)).expect("signals alone");
    let mut simulation = Simulation::new(town.world);
    simulation.add_dynamics("traffic", Box::new(lights));
    simulation.add_dynamics("wheels", Box::new(wheels));
    simulation.submit(Command::Move { id: rider, pose: beside });
    simulation.step().expect("it moves");
    let ride = PlanStep::Navigate { to: Goal::Entity(hospital), within: 2.0, speed: None };
    let steps = vec![PlanStep::Act(Action::EnterCar { car: bike }), ride, PlanStep::Act(Action::ExitCar)];
    let mut executor = RuleExecutor::straight();
    executor.start(Plan { steps }, simulation.world(), rider).expect("it can be begun");
    let mut ended = Progress::Running;
    for _ in 0..4000 {
        let mut actions = Vec::new();
        ended = executor.advance(simulation.world(), rider, &mut actions).expect("it works");
        for action in actions {
            simulation.submit(Command::Actuate { who: rider, action });
        }
        simulation.step().expect("the world goes on");
        if !ended.goes_on() {
            break;
        }
    }
    assert_eq!(ended, Progress::Done);
    let (at, bike) = (simulation.world().entity(rider).unwrap(), simulation.world().entity(bike).unwrap());
    assert!(at.attachment.is_none() && (bike.planar() - Point2::new(300.0, 246.5)).norm() < 25.0);
}
