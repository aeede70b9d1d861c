//! Bodies follow what is done in the world: removal, moves by command, seats, scooters, things carried away.

use crate::common::{PERSON, Stage, at};
use simworld_core::action::Action;
use simworld_core::alteration::Alteration;
use simworld_core::command::Command;
use simworld_core::event::EventKind;
use simworld_core::geometry::Twist;
use simworld_core::scene::{EntityKind, Scene, Shape, Solidity, Visibility};
use simworld_physics::HumanoidConfig;

#[test]
fn a_removed_entity_loses_its_body_and_a_newcomer_in_its_slot_has_none() {
    let mut stage = Stage::new();
    let person = stage.person(at(0.0, 0.0, 0.0));
    stage.step();
    stage.world.remove(person).unwrap();
    let wall = stage.building(0.0, 0.0, (1.0, 1.0, 1.0));
    assert_eq!(wall.index(), person.index(), "the slot is used again");
    stage.step();
    assert_eq!(stage.physics.state(person), None);
    assert_eq!(stage.physics.bodies().count(), 0);
    let other = stage.person(at(-2.0, 0.0, 0.0));
    stage.tell(other, Action::MoveForward { speed: 2.0 });
    stage.run(30);
    assert!(stage.position(other).x < -0.7, "the newcomer is solid");
}

#[test]
fn a_wall_that_is_removed_or_moved_no_longer_blocks() {
    let mut stage = Stage::new();
    let wall = stage.building(3.0, 0.0, (1.0, 10.0, 3.0));
    let person = stage.person(at(0.0, 0.0, 0.0));
    stage.tell(person, Action::MoveForward { speed: 2.0 });
    stage.run(30);
    assert!(stage.position(person).x < 2.3);
    stage.world.set_motion(wall, at(8.0, 0.0, 0.0), Twist::ZERO).unwrap();
    stage.run(40);
    let there = stage.position(person).x;
    assert!(there > 7.0 && there < 7.3, "stopped where the wall is now: {there}");
    stage.world.remove(wall).unwrap();
    stage.run(20);
    assert!(stage.position(person).x > 9.0);
}

#[test]
fn a_wall_that_is_altered_blocks_as_it_is_now() {
    let mut stage = Stage::new();
    let wall = stage.building(3.0, 0.0, (1.0, 10.0, 3.0));
    let person = stage.person(at(0.0, 0.0, 0.0));
    let alter = |stage: &mut Stage, alteration| {
        stage.world.apply(&Command::Alter { id: wall, alteration }).unwrap();
    };
    alter(&mut stage, Alteration::Shape(Shape::cuboid(3.0, 10.0, 3.0)));
    stage.tell(person, Action::MoveForward { speed: 2.0 });
    stage.run(30);
    let there = stage.position(person).x;
    assert!(there > 1.0 && there < 1.3, "stopped where the thicker wall begins: {there}");
    alter(&mut stage, Alteration::Visibility(Visibility::Hidden));
    stage.run(10);
    assert!(stage.position(person).x < 1.3, "what nobody sees is met all the same");
    alter(&mut stage, Alteration::Solidity(Solidity::Hollow));
    stage.run(40);
    assert!(stage.position(person).x > 5.0, "and what is hollow is walked through");
}

#[test]
fn a_body_moved_by_command_goes_on_from_there() {
    let mut stage = Stage::new();
    let person = stage.person(at(0.0, 0.0, 0.0));
    stage.tell(person, Action::MoveForward { speed: 1.0 });
    stage.run(10);
    stage.world.set_motion(person, at(100.0, 50.0, std::f64::consts::FRAC_PI_2), Twist::ZERO).unwrap();
    stage.run(10);
    let there = stage.position(person);
    assert!((there.x - 100.0).abs() < 1e-6 && (there.y - 51.0).abs() < 0.06, "{there}");
}

#[test]
fn a_seated_person_stays_on_the_seat_until_standing_up() {
    let mut stage = Stage::new();
    let bench = stage.spawn(EntityKind::Bench, at(2.0, 0.0, 0.0), Shape::cuboid(0.6, 1.8, 0.8));
    let person = stage.person(at(0.5, 0.0, 0.0));
    stage.step();
    stage.tell(person, Action::SitDown { seat: bench });
    stage.run(2);
    let seat = stage.position(person);
    assert!((seat.x - 2.0).abs() < 1e-9, "{seat}");
    stage.tell(person, Action::MoveForward { speed: 1.0 });
    stage.run(5);
    assert_eq!(stage.position(person), seat);
    let refused = |event: &&EventKind| matches!(event, EventKind::ActionFailed { .. });
    assert_eq!(stage.events.iter().filter(refused).count(), 1);
    stage.tell(person, Action::StandUp);
    stage.tell(person, Action::MoveForward { speed: 1.0 });
    stage.run(20);
    let there = stage.position(person);
    assert!(there.z.abs() < 0.01 && there.x > 3.0, "walked away from the bench: {there}");
    assert_eq!(stage.events.iter().filter(refused).count(), 1);
}

#[test]
fn a_passenger_travels_with_the_car_and_gets_out_beside_it() {
    let mut stage = Stage::new();
    let car = stage.spawn(EntityKind::Car, at(0.0, 2.0, 0.0), Shape::cuboid(4.3, 1.8, 1.5));
    let person = stage.person(at(0.0, 0.0, 0.0));
    let bystander = stage.person(at(20.0, -3.0, 0.0));
    stage.step();
    stage.tell(person, Action::EnterCar { car });
    for step in 1..=40 {
        stage.world.set_motion(car, at(f64::from(step), 2.0, 0.0), Twist::ZERO).unwrap();
        stage.step();
    }
    let gap = stage.position(person) - stage.position(car);
    assert!(gap.norm() < 0.6, "on the seat: {gap}");
    stage.tell(person, Action::ExitCar);
    stage.tell(person, Action::MoveForward { speed: 1.0 });
    stage.run(20);
    let there = stage.position(person);
    assert!((there.x - 42.0).abs() < 0.1 && there.y > 3.0 && there.z.abs() < 0.01, "{there}");
    assert!((stage.position(bystander).x - 20.0).abs() < 1e-9);
}

#[test]
fn a_rider_speeds_up_to_25_km_an_hour_and_loses_it_on_getting_off() {
    let mut stage = Stage::new();
    let scooter = stage.spawn(EntityKind::Scooter, at(0.8, 0.0, 0.0), Shape::cuboid(1.1, 0.5, 1.2));
    let person = stage.person(at(0.0, 0.0, 0.0));
    stage.step();
    stage.tell(person, Action::RideScooter { scooter });
    stage.tell(person, Action::MoveForward { speed: 6.9 });
    stage.run(10);
    let speed = stage.velocity(person).x;
    assert!(speed > 1.2 && speed < 1.8, "1.5 m/s² for a second: {speed}");
    stage.run(60);
    assert!((stage.velocity(person).x - 6.9).abs() < 1e-6);
    let gap = stage.position(scooter) - stage.position(person);
    assert!(gap.norm() < 1e-9, "the scooter comes along");
    stage.tell(person, Action::Stop);
    stage.run(30);
    assert_eq!(stage.velocity(person).norm(), 0.0);
    stage.tell(person, Action::GetOffScooter);
    stage.tell(person, Action::MoveForward { speed: 6.9 });
    stage.run(2);
    let left = stage.position(scooter);
    stage.run(10);
    assert!(stage.velocity(person).norm() <= 2.5 + 1e-9);
    assert_eq!(stage.position(scooter), left, "the scooter stays");
}

#[test]
fn what_is_carried_blocks_nobody() {
    let mut stage = Stage::new();
    let cone = stage.spawn(EntityKind::Cone, at(1.0, 0.0, 0.0), Shape::cuboid(0.4, 0.4, 0.7));
    let person = stage.person(at(0.0, 0.0, 0.0));
    stage.step();
    stage.tell(person, Action::CarryHeavy { item: cone });
    stage.tell(person, Action::MoveForward { speed: 1.0 });
    stage.run(20);
    assert!((stage.position(person).x - 2.0).abs() < 1e-3, "{}", stage.position(person));
    assert!((stage.position(cone).x - 2.5).abs() < 1e-3);
}

#[test]
fn a_body_runs_in_a_simulation_by_commands() {
    let mut stage = Stage::new();
    let person = stage.spawn(EntityKind::Person, at(0.0, 0.0, 0.0), PERSON);
    stage.physics.add_humanoid(&stage.world, person, HumanoidConfig::default()).unwrap();
    let mut simulation = simworld_core::simulation::Simulation::new(stage.world);
    simulation.add_dynamics("physics", Box::new(stage.physics));
    simulation.submit(Command::Actuate { who: person, action: Action::MoveForward { speed: 1.4 } });
    for _ in 0..10 {
        simulation.step().unwrap();
    }
    assert!((simulation.world().entity(person).unwrap().position().x - 1.4).abs() < 1e-6);
}
