//! People are blocked by buildings and by one another, and slide along walls.

use crate::common::{Stage, at};
use proptest::prelude::*;
use simworld_core::action::Action;
use simworld_core::geometry::Twist;
use simworld_core::scene::{EntityKind, Shape};

#[test]
fn a_building_stops_a_person() {
    let mut stage = Stage::new();
    stage.building(5.0, 0.0, (2.0, 20.0, 6.0));
    let walker = stage.person(at(0.0, 0.0, 0.0));
    stage.tell(walker, Action::MoveForward { speed: 2.5 });
    stage.run(60);
    let there = stage.position(walker);
    assert!(there.x < 4.0 - 0.25 && there.x > 4.0 - 0.25 - 0.05, "{there}");
    assert!(there.y.abs() < 0.01, "{there}");
}

#[test]
fn a_person_slides_along_a_wall() {
    let mut stage = Stage::new();
    stage.building(5.0, 0.0, (2.0, 60.0, 6.0));
    let walker = stage.person(at(3.0, 0.0, std::f64::consts::FRAC_PI_4));
    stage.tell(walker, Action::MoveForward { speed: 1.4 });
    stage.run(100);
    let there = stage.position(walker);
    assert!(there.x < 3.75, "{there}");
    // All of the speed along the wall is kept: 1.4 cos 45° for 10 s.
    let expected = 1.4 * 0.5f64.sqrt() * 10.0;
    assert!((there.y - expected).abs() < 0.05 * expected, "{there} and not {expected}");
}

#[test]
fn two_people_do_not_interpenetrate() {
    let mut stage = Stage::new();
    let (a, b) = (stage.person(at(-2.0, 0.0, 0.0)), stage.person(at(2.0, 0.1, std::f64::consts::PI)));
    for who in [a, b] {
        stage.tell(who, Action::MoveForward { speed: 2.5 });
    }
    for _ in 0..60 {
        stage.step();
        let apart = (stage.position(a) - stage.position(b)).xy().norm();
        assert!(apart >= 0.5, "{apart} m between the axes of two bodies half a metre wide");
    }
    assert!(stage.position(a).x > -0.5, "they came close");
}

#[test]
fn people_are_blocked_by_traffic() {
    let mut stage = Stage::new();
    let car = stage.spawn(EntityKind::Car, at(4.0, 0.0, 1.57), Shape::cuboid(4.3, 1.8, 1.5));
    let walker = stage.person(at(0.0, 0.0, 0.0));
    stage.tell(walker, Action::MoveForward { speed: 2.0 });
    stage.run(40);
    assert!(stage.position(walker).x < 4.0 - 0.9 - 0.25);
    let pose = at(40.0, 0.0, 1.57);
    stage.world.set_motion(car, pose, Twist::ZERO).unwrap();
    stage.run(20);
    assert!(stage.position(walker).x > 4.0, "the car has gone, so the way is free");
}

#[test]
fn passing_traffic_does_not_carry_people_along() {
    let mut stage = Stage::new();
    let car = stage.spawn(EntityKind::Bus, at(-30.0, 1.6, 0.0), Shape::cuboid(12.0, 2.5, 3.0));
    // It comes to the side of the bus while that passes; in front of it, it would be run over.
    let walker = stage.person(at(0.0, -2.6, std::f64::consts::FRAC_PI_2));
    stage.tell(walker, Action::MoveForward { speed: 1.0 });
    for step in 1..60 {
        let pose = at(-30.0 + f64::from(step), 1.6, 0.0);
        stage.world.set_motion(car, pose, Twist::ZERO).unwrap();
        stage.step();
        let there = stage.position(walker);
        assert!(there.x.abs() < 0.01, "dragged to {there}");
        assert!(!(28..=36).contains(&step) || there.y < 0.11, "held up by the bus: {there}");
    }
    assert!(stage.position(walker).y > 1.0, "once the bus has passed it goes on");
}

/// Eight people in a yard with a pillar, who turn by these angles, radians, and go on at a speed, m/s, six times, on the ground or on a
/// floor over it: nobody comes into a wall or into one another, and all stay on the floor.
fn keep_apart(turns: &[f64], speed: f64, floor: f64) -> Result<(), TestCaseError> {
    let mut stage = Stage::new();
    if floor > 0.0 {
        stage.building(0.0, 0.0, (30.0, 30.0, floor));
    }
    for (x, y, size) in [
        (6.0, 0.0, (2.0, 12.0, 7.0)),
        (-6.0, 0.0, (2.0, 12.0, 7.0)),
        (0.0, 6.0, (12.0, 2.0, 7.0)),
        (0.0, -6.0, (12.0, 2.0, 7.0)),
        (0.0, 0.0, (2.0, 2.0, 7.0)),
    ] {
        stage.building(x, y, size);
    }
    let crowd: Vec<_> = (0..8)
        .map(|i| {
            let mut pose = at(f64::from(i % 4) * 2.0 - 3.0, if i < 4 { 3.0 } else { -3.0 }, f64::from(i));
            pose.translation.z = floor;
            stage.person(pose)
        })
        .collect();
    for leg in turns.chunks(8) {
        for (who, angle) in crowd.iter().zip(leg) {
            stage.tell(*who, Action::Rotate { angle: *angle });
            stage.tell(*who, Action::MoveForward { speed });
        }
        for _ in 0..12 {
            stage.step();
            let places: Vec<_> = crowd.iter().map(|id| stage.position(*id)).collect();
            for (i, a) in places.iter().enumerate() {
                prop_assert!(a.x.abs() < 4.76 && a.y.abs() < 4.76, "in a wall: {a}");
                prop_assert!(a.x.abs().max(a.y.abs()) > 1.15, "in the pillar: {a}");
                prop_assert!((a.z - floor).abs() < 0.01, "off the floor at {floor} m: {a}");
                for b in &places[i + 1..] {
                    prop_assert!((a - b).xy().norm() > 0.499, "{a} and {b} overlap");
                }
            }
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, ..ProptestConfig::default() })]
    #[test]
    fn a_crowd_in_a_yard_stays_apart_and_outside_of_walls(
        turns in proptest::collection::vec(-3.0..3.0f64, 8 * 6),
        speed in 0.5..2.5f64,
        floor in prop_oneof![Just(0.0), Just(3.0)],
    ) {
        keep_apart(&turns, speed, floor)?;
    }
}

/// What the above found once: somebody who was pushed along a wall, on a floor.
#[test]
fn who_is_jostled_beside_a_wall_is_not_pressed_into_it() {
    let mut turns = [0.0; 48];
    for (place, angle) in [
        (1, -2.616_186_785_119_267_3),
        (2, 0.040_453_266_968_315_436),
        (10, -2.109_635_962_499_765),
        (18, 0.578_945_316_275_105_3),
    ] {
        turns[place] = angle;
    }
    keep_apart(&turns, 1.574_329_135_022_980_7, 3.0).unwrap();
}
