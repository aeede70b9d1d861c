//! A contact is reported once, when it begins, with the speed of approach.

use crate::common::{Stage, at};
use simworld_core::action::Action;
use simworld_core::event::EventKind;
use simworld_core::geometry::{Point3, Pose, Twist, Vector3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityKind, Shape};

fn contacts(stage: &Stage) -> Vec<(EntityId, EntityId, f64)> {
    let read = |event: &EventKind| match event {
        EventKind::Contact { a, b, closing_speed, .. } => (*a, *b, *closing_speed),
        other => panic!("{other:?}"),
    };
    stage.contacts.iter().map(read).collect()
}

#[test]
fn walking_into_a_wall_is_one_contact_at_walking_speed() {
    let mut stage = Stage::new();
    let wall = stage.building(3.0, 0.0, (1.0, 10.0, 3.0));
    let person = stage.person(at(0.0, 0.0, 0.0));
    stage.tell(person, Action::MoveForward { speed: 1.4 });
    stage.run(60);
    let found = contacts(&stage);
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!((found[0].0, found[0].1), (wall, person));
    assert!((found[0].2 - 1.4).abs() < 1e-6, "{found:?}");
    let EventKind::Contact { point, .. } = stage.contacts[0] else { unreachable!() };
    assert!((point.x - 2.5).abs() < 1e-6, "on the face of the wall: {point}");
    stage.tell(person, Action::Rotate { angle: std::f64::consts::PI });
    stage.run(30);
    stage.tell(person, Action::Rotate { angle: std::f64::consts::PI });
    stage.run(60);
    assert_eq!(contacts(&stage).len(), 2, "coming back is another contact");
}

#[test]
fn two_people_who_meet_report_the_sum_of_their_speeds_once() {
    let mut stage = Stage::new();
    let (a, b) = (stage.person(at(-2.0, 0.0, 0.0)), stage.person(at(2.0, 0.0, std::f64::consts::PI)));
    stage.tell(a, Action::MoveForward { speed: 1.0 });
    stage.tell(b, Action::MoveForward { speed: 1.5 });
    stage.run(60);
    let found = contacts(&stage);
    assert_eq!(found.len(), 1, "{found:?}");
    assert_eq!((found[0].0, found[0].1), (a, b));
    assert!(found[0].2 > 0.9 && found[0].2 <= 2.5 + 1e-6, "{found:?}");
}

#[test]
fn standing_apart_is_no_contact_and_traffic_among_itself_is_not_reported() {
    let mut stage = Stage::new();
    stage.person(at(0.0, 0.0, 0.0));
    stage.building(1.0, 0.0, (1.0, 1.0, 1.0));
    stage.spawn(EntityKind::Car, at(8.0, 0.0, 0.0), Shape::cuboid(4.3, 1.8, 1.5));
    stage.spawn(EntityKind::Car, at(9.0, 0.0, 0.0), Shape::cuboid(4.3, 1.8, 1.5));
    stage.run(5);
    assert_eq!(contacts(&stage), []);
}

#[test]
fn a_car_that_runs_into_a_person_reports_its_speed_and_pushes_the_person_aside() {
    let mut stage = Stage::new();
    let person = stage.person(at(0.0, 0.0, 0.0));
    let car = stage.spawn(EntityKind::Car, at(-6.0, 0.0, 0.0), Shape::cuboid(4.3, 1.8, 1.5));
    for step in 1..=60 {
        let pose = at(-6.0 + 0.2 * f64::from(step), 0.0, 0.0);
        stage.world.set_motion(car, pose, Twist::ZERO).unwrap();
        stage.step();
    }
    let found = contacts(&stage);
    assert_eq!((found[0].0, found[0].1), (person, car));
    assert!((found[0].2 - 2.0).abs() < 0.05, "{found:?}");
    // The push comes one substep after the car, which has gone 0.1 m by then.
    let mut overlapping = Vec::new();
    stage.physics.overlapping(&Shape::cuboid(4.0, 1.6, 1.5), &at(6.0, 0.0, 0.0), &mut overlapping);
    assert!(!overlapping.contains(&person), "{}", stage.position(person));
}

#[test]
fn what_sleeps_still_touches_and_waking_begins_no_contact_of_its_own() {
    let mut stage = Stage::new();
    let table = stage.building(0.0, 0.0, (2.0, 2.0, 1.0));
    let on = |height: f64| -> Pose { pose_facing(Point3::new(0.0, 0.0, height), 0.0) };
    let [lower, upper] = [1.0, 1.4].map(|height| {
        let id = stage.spawn(EntityKind::Prop, on(height), Shape::cuboid(0.4, 0.4, 0.4));
        stage.physics.add_rigid(&stage.world, id).unwrap();
        id
    });
    stage.run(60);
    let pairs = |stage: &Stage| contacts(stage).iter().map(|(a, b, _)| (*a, *b)).collect::<Vec<_>>();
    let first = pairs(&stage);
    assert!(first.contains(&(table, lower)) && first.contains(&(lower, upper)), "{first:?}");
    stage.run(40);
    assert_eq!(pairs(&stage), first, "asleep they go on touching");
    let ball = stage.ball(Point3::new(0.0, 0.0, 3.0), Vector3::zeros(), 0.5);
    stage.run(40);
    let woken = pairs(&stage).split_off(first.len());
    assert!(!woken.is_empty() && woken.iter().all(|(a, b)| *a == ball || *b == ball), "{woken:?}");
    let count = |stage: &Stage| pairs(stage).iter().filter(|pair| **pair == (lower, upper)).count();
    let before = count(&stage);
    stage.world.set_motion(upper, at(10.0, 0.0, 0.0), Twist::ZERO).unwrap();
    stage.run(20);
    assert_eq!(count(&stage), before);
    let height = stage.position(lower).z + 0.4;
    stage.world.set_motion(upper, on(height + 0.02), Twist::ZERO).unwrap();
    stage.run(20);
    assert!(count(&stage) > before, "taken away and put back it touches anew");
}
