//! Rows of the table: cars and scooters, and who has their pedals.

use simworld_core::action::Action;
use simworld_core::scene::Role;

use super::stage::{Stage, within};

/// Beside the driver's door.
fn at_car(stage: &mut Stage) {
    let at = stage.at(stage.car);
    stage.stand(stage.me, at.x, at.y + 1.6, 0.0);
}

pub(crate) fn enter_car(stage: &mut Stage) {
    let (me, other, car) = (stage.me, stage.other, stage.car);
    stage.refuses(me, Action::EnterCar { car }, "the reach is 2 m");
    stage.refuses(me, Action::Throttle { level: 0.5 }, "cannot throttle");
    at_car(stage);
    stage.does(me, Action::EnterCar { car });
    assert_eq!(stage.sees(me).bond, Some((car, Role::Aboard)));
    // Who drives has the pedals and is carried along.
    let from = stage.at(car);
    stage.does(me, Action::Throttle { level: 0.6 });
    stage.wait(4.0);
    within((stage.at(car) - from).norm(), 5.0..=60.0);
    within((stage.at(me) - stage.at(car)).norm(), 0.0..=0.6);
    assert!(stage.sees(me).speed > 2.0);
    stage.does(me, Action::Stop);
    stage.wait(5.0);
    let at = stage.at(car);
    stage.stand(other, at.x, at.y - 1.6, 0.0);
    stage.refuses(other, Action::EnterCar { car }, &format!("car {car} is taken by {me}"));
}

pub(crate) fn exit_car(stage: &mut Stage) {
    let (me, car) = (stage.me, stage.car);
    stage.refuses(me, Action::ExitCar, "not in a vehicle");
    at_car(stage);
    stage.does(me, Action::EnterCar { car });
    stage.does(me, Action::Throttle { level: 0.6 });
    stage.wait(3.0);
    stage.refuses(me, Action::ExitCar, "moving: stop it first");
    stage.does(me, Action::Stop);
    stage.wait(5.0);
    stage.does(me, Action::ExitCar);
    assert_eq!(stage.sees(me).bond, None);
    let (out, inside) = (stage.at(me), stage.at(car));
    within((out - inside).norm(), 1.0..=2.0);
    stage.does(me, Action::MoveForward { speed: 1.0 });
    let (ahead, _) = stage.way_in(me, 2.0);
    within(ahead, 1.9..=2.1);
    assert_eq!(stage.at(car), inside, "the car stays");
}

pub(crate) fn ride_scooter(stage: &mut Stage) {
    let (me, scooter) = (stage.me, stage.scooter);
    stage.refuses(me, Action::RideScooter { scooter }, "the reach is 2 m");
    stage.stand(me, -10.0, 9.0, 0.0);
    stage.does(me, Action::RideScooter { scooter });
    assert_eq!(stage.sees(scooter).bond, Some((me, Role::Ridden)));
    stage.does(me, Action::MoveForward { speed: 6.0 });
    stage.wait(5.0);
    within(stage.sees(me).speed, 5.9..=6.1);
    within((stage.at(scooter) - stage.at(me)).norm(), 0.0..=0.01);
    let here = stage.at(me);
    stage.does(me, Action::Stop);
    stage.wait(3.0);
    let way = (stage.at(me) - here).norm();
    within(way, 3.0..=9.0); // it brakes, and does not stop at once as who walks
    let (at, other) = (stage.at(me), stage.other);
    stage.stand(other, at.x, at.y + 1.0, 0.0);
    stage.refuses(other, Action::RideScooter { scooter }, &format!("scooter {scooter} is taken by {me}"));
}

pub(crate) fn get_off_scooter(stage: &mut Stage) {
    let (me, scooter) = (stage.me, stage.scooter);
    stage.refuses(me, Action::GetOffScooter, "on foot");
    stage.stand(me, -10.0, 9.0, 0.0);
    stage.does(me, Action::RideScooter { scooter });
    stage.does(me, Action::GetOffScooter);
    assert_eq!(stage.sees(scooter).bond, None);
    let stands = stage.at(scooter);
    stage.does(me, Action::Rotate { angle: 3.0 });
    stage.wait(1.0);
    stage.does(me, Action::MoveForward { speed: 6.0 });
    stage.wait(1.0);
    within(stage.sees(me).speed, 2.4..=2.6); // on foot again
    assert_eq!(stage.at(scooter), stands);
}

pub(crate) fn throttle(stage: &mut Stage) {
    let car = stage.car;
    stage.refuses(car, Action::Throttle { level: 2.0 }, "-1 to 1");
    stage.does(car, Action::Throttle { level: 0.5 });
    let (ahead, left) = stage.way_in(car, 4.0);
    within(ahead, 4.0..=60.0);
    within(left, -0.2..=0.2);
    assert!(stage.sees(car).speed > 2.0);
}

pub(crate) fn brake(stage: &mut Stage) {
    let car = stage.car;
    stage.refuses(car, Action::Brake { level: -1.0 }, "0 to 1");
    stage.does(car, Action::Throttle { level: 0.6 });
    stage.wait(4.0);
    let before = stage.speed(car);
    stage.does(car, Action::Brake { level: 0.3 });
    stage.wait(1.0);
    within(stage.sees(car).speed, 0.0..=before - 1.0);
}

pub(crate) fn steer(stage: &mut Stage) {
    let car = stage.car;
    stage.refuses(car, Action::Steer { angle: f64::NAN }, "a finite angle");
    stage.does(car, Action::Throttle { level: 0.3 });
    stage.does(car, Action::Steer { angle: 0.3 });
    stage.wait(4.0);
    assert!(stage.heading(car) > 0.2, "it turned by {}", stage.heading(car));
}

pub(crate) fn stop(stage: &mut Stage) {
    let car = stage.car;
    stage.does(car, Action::Throttle { level: 0.6 });
    stage.wait(3.0);
    assert!(stage.sees(car).speed > 2.0);
    stage.does(car, Action::Stop);
    stage.wait(5.0);
    within(stage.sees(car).speed, 0.0..=0.05);
}
