//! On land that rises and falls people land hard, trip, push and are carried as on level ground.

use std::sync::Arc;

use crate::common::{PERSON, Stage, land};
use simworld_core::action::Action;
use simworld_core::event::EventKind;
use simworld_core::geometry::{Point2, Point3, Pose, Twist, Vector3, pose_facing};
use simworld_core::ground::Ground;
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityDesc, EntityKind, FallCause, Footing, MATERIAL, Scene, Shape};
use simworld_core::seed::Seed;

/// A plane that rises towards east by a grade.
fn plane(grade: f64) -> Arc<Ground> {
    land(|at| grade * at.x)
}

fn hills() -> Arc<Ground> {
    land(|at| 1.2 * simworld_core::ops::sin(at.x * 0.31 + 0.01 * at.y * at.y) + 0.05 * at.y)
}

fn upon(ground: &Ground, x: f64, y: f64) -> Pose {
    pose_facing(ground.point(Point2::new(x, y)), 0.0)
}

fn footing(stage: &Stage, who: EntityId) -> Footing {
    stage.world.entity(who).unwrap().footing()
}

fn falls(stage: &Stage) -> Vec<FallCause> {
    let cause = |event: &EventKind| match event {
        EventKind::Fell { cause, .. } => Some(*cause),
        _ => None,
    };
    stage.events.iter().filter_map(cause).collect()
}

/// Moves something by a velocity, m/s, for so many steps.
fn lead(stage: &mut Stage, id: EntityId, velocity: Vector3, steps: usize) {
    for _ in 0..steps {
        let mut pose = *stage.world.entity(id).unwrap().pose;
        pose.translation.vector += velocity * 0.1;
        stage.world.set_motion(id, pose, Twist { linear: velocity, angular: Vector3::zeros() }).unwrap();
        stage.step();
    }
}

#[test]
fn who_lands_hard_lies_where_it_came_down_and_gets_up() {
    // Level as a height field, where a normal may be longer than one; and steeper than it holds nobody.
    for ground in [land(|_| 0.0), plane(0.2), hills()] {
        let mut rng = Seed(3).stream("places").rng();
        for trial in 0..24 {
            let mut at = Point2::new(rng.uniform(-30.0, 30.0), rng.uniform(-20.0, 20.0));
            // On an edge of two triangles, on a corner of six, in the middle of one.
            at.x = if trial % 3 == 0 { at.x } else { (at.x * 0.5).round() * 2.0 };
            at.y = if trial % 3 == 1 { at.y } else { (at.y * 0.5).round() * 2.0 };
            let mut stage = Stage::on(&ground);
            let height = ground.height(at) + rng.uniform(2.0, 6.0);
            let who = stage.person(pose_facing(Point3::new(at.x, at.y, height), rng.uniform(-3.0, 3.0)));
            let (mut steps, mut lay) = (0, None);
            while steps < 15 || footing(&stage, who) != Footing::Upright {
                stage.step();
                steps += 1;
                if footing(&stage, who) == Footing::Down {
                    lay = Some(stage.position(who));
                }
                assert!(steps < 300, "{trial} at {at}: {:?} {}", footing(&stage, who), stage.position(who));
            }
            assert_eq!(falls(&stage), [FallCause::Landed], "{trial} at {at}");
            let lay = lay.expect("it lay");
            let off = lay.z - ground.height(lay.xy());
            assert!((lay.xy() - at).norm() < 4.0 && off.abs() < 1.0, "{trial} at {at} it lay at {lay}");
            let stands = stage.position(who);
            assert!((stands.z - ground.height(stands.xy())).abs() < 1e-6, "{trial} at {at}: {stands}");
        }
    }
}

#[test]
fn who_lands_softly_stays_on_its_feet() {
    let ground = hills();
    for (height, fallen) in [(1.0, false), (1.2, false), (2.0, true)] {
        let mut stage = Stage::on(&ground);
        stage.person(pose_facing(ground.point(Point2::new(3.0, 1.7)) + Vector3::z() * height, 0.0));
        stage.run(20);
        assert_eq!(falls(&stage).contains(&FallCause::Landed), fallen, "from {height} m");
    }
}

#[test]
fn who_is_pressed_under_the_ground_comes_up_again() {
    let ground = hills();
    let mut stage = Stage::on(&ground);
    let who = stage.person(upon(&ground, 0.0, 0.0));
    stage.run(1);
    // A press as heavy as may be, faster than anything gets out of its way.
    let press = stage.spawn(EntityKind::Truck, upon(&ground, -1.0, 0.0), Shape::cuboid(6.0, 4.0, 2.0));
    let above = pose_facing(ground.point(Point2::new(0.0, 0.0)) + Vector3::z() * 3.0, 0.0);
    stage.world.set_motion(press, above, Twist::ZERO).unwrap();
    stage.run(1);
    lead(&mut stage, press, Vector3::new(0.0, 0.0, -12.0), 4);
    stage.world.remove(press).unwrap();
    assert_ne!(footing(&stage, who), Footing::Upright);
    stage.run(200);
    let there = stage.position(who);
    assert_eq!(footing(&stage, who), Footing::Upright, "{there}");
    assert!((there.z - ground.height(there.xy())).abs() < 1e-6, "{there}");
}

#[test]
fn who_runs_against_a_high_kerb_trips_and_steps_and_walls_trip_nobody() {
    let ground = plane(0.08);
    for (height, expected) in [(0.15, vec![]), (0.4, vec![FallCause::Tripped]), (3.0, vec![])] {
        let mut stage = Stage::on(&ground);
        // So high above the ground at its foremost edge, 10 m ahead.
        let top = ground.height(Point2::new(10.0, 0.0)) + height;
        let kerb = pose_facing(Point3::new(15.0, 0.0, top - 5.0), 0.0);
        stage.spawn(EntityKind::Building, kerb, Shape::cuboid(10.0, 8.0, 5.0));
        let runner = stage.person(upon(&ground, 0.0, 0.0));
        stage.tell(runner, Action::MoveForward { speed: 2.5 });
        stage.run(60);
        assert_eq!(falls(&stage), expected, "{height} m");
        let there = stage.position(runner);
        match expected.is_empty() {
            true if height > 1.0 => assert!((there.x - 9.73).abs() < 0.03, "before the wall: {there}"),
            true => assert!((there.z - top).abs() < 0.03 && there.x > 10.5, "on the kerb: {there}"),
            false => {
                stage.run(100);
                assert_eq!(footing(&stage, runner), Footing::Upright, "{}", stage.position(runner));
            }
        }
    }
}

#[test]
fn a_light_crate_is_pushed_uphill_and_a_heavy_one_stays() {
    let ground = plane(0.1);
    for (mass, moves) in [(10.0, true), (25.0, true), (60.0, false)] {
        let mut stage = Stage::on(&ground);
        let desc = EntityDesc::new(EntityKind::Prop, upon(&ground, 2.0, 0.0), Shape::cuboid(0.8, 0.8, 0.8));
        let thing = stage.world.spawn(desc.weighing(mass).with(MATERIAL, "wood")).unwrap();
        stage.physics.add_rigid(&stage.world, thing).unwrap();
        let walker = stage.person(upon(&ground, 0.0, 0.0));
        stage.run(10);
        stage.tell(walker, Action::MoveForward { speed: 1.0 });
        stage.run(100);
        let (pushed, there) = (stage.position(thing), stage.position(walker));
        assert!(there.x < pushed.x - 0.6, "{mass} kg: {there} behind {pushed}");
        assert_eq!(pushed.x > 4.0, moves, "{mass} kg: {pushed}");
        assert!(moves || (pushed.x - 2.0).abs() < 0.05, "{mass} kg: {pushed}");
        assert!((pushed.z - ground.height(pushed.xy())).abs() < 0.06, "{mass} kg: {pushed}");
        assert!((there.z - ground.height(there.xy())).abs() < 1e-6, "{there}");
        assert_eq!(falls(&stage), []);
    }
}

#[test]
fn who_stands_on_a_slope_makes_room_for_who_walks() {
    let ground = plane(0.1);
    let mut stage = Stage::on(&ground);
    let (walker, stander) = (stage.person(upon(&ground, 0.0, 0.0)), stage.person(upon(&ground, 2.0, 0.0)));
    stage.tell(walker, Action::MoveForward { speed: 1.2 });
    stage.run(100);
    let (behind, before) = (stage.position(walker), stage.position(stander));
    assert!(behind.x > 5.0 && behind.y.abs() < 0.3, "{behind}");
    assert!(before.x > 2.05 && before.y.abs() > 0.2, "aside: {before}");
    for there in [behind, before] {
        assert!((there.z - ground.height(there.xy())).abs() < 1e-6, "{there}");
    }
}

#[test]
fn a_lift_carries_who_stands_on_it_up_down_and_aside() {
    let ground = hills();
    let base = ground.height(Point2::new(4.0, 2.0));
    let mut stage = Stage::on(&ground);
    let pose = pose_facing(Point3::new(4.0, 2.0, base + 0.6), 0.0);
    let lift = stage.spawn(EntityKind::Prop, pose, Shape::cuboid(3.0, 3.0, 0.2));
    let person = stage.person(pose_facing(Point3::new(4.3, 1.6, base + 0.8), 0.0));
    stage.run(3);
    let on_it = |stage: &Stage| stage.position(person) - stage.position(lift);
    let ways = [Vector3::z() * 0.5, Vector3::z(), Vector3::x(), -Vector3::y(), -Vector3::z() * 0.5];
    for velocity in ways {
        // A start and a stop of 1 m/s² stand people.
        for share in (1..=10).map(|tenth| 0.1 * f64::from(tenth)) {
            lead(&mut stage, lift, velocity * share, 1);
        }
        lead(&mut stage, lift, velocity, 15);
        let there = on_it(&stage);
        assert!((there.z - 0.2).abs() < 0.06, "at {velocity}: {there}");
        assert!((there.xy() - Vector3::new(0.3, -0.4, 0.0).xy()).norm() < 0.06, "at {velocity}: {there}");
        for share in (0..10).rev().map(|tenth| 0.1 * f64::from(tenth)) {
            lead(&mut stage, lift, velocity * share, 1);
        }
    }
    lead(&mut stage, lift, Vector3::zeros(), 5);
    let there = on_it(&stage);
    assert!((there - Vector3::new(0.3, -0.4, 0.2)).norm() < 0.02, "{there}");
    assert_eq!(falls(&stage), []);
    stage.tell(person, Action::MoveForward { speed: 1.0 });
    stage.run(30);
    assert_eq!(falls(&stage), [FallCause::Landed], "who walks off it comes down four metres");
}

#[test]
fn a_truck_that_stops_dead_throws_down_who_stands_on_it() {
    let ground = plane(0.0);
    let mut stage = Stage::on(&ground);
    let truck = stage.spawn(EntityKind::Truck, upon(&ground, -20.0, 0.0), Shape::cuboid(9.0, 2.4, 1.0));
    let desc = EntityDesc::new(EntityKind::Person, pose_facing(Point3::new(-22.0, 0.0, 1.0), 0.0), PERSON);
    let person = stage.world.spawn(desc).unwrap();
    stage.physics.add_humanoid(&stage.world, person, simworld_physics::HumanoidConfig::default()).unwrap();
    stage.run(3);
    for tenth in 1..=80 {
        lead(&mut stage, truck, Vector3::x() * (0.1 * f64::from(tenth)), 1);
    }
    assert_eq!(falls(&stage), [], "at 1 m/s² it stays up");
    let there = stage.position(person) - stage.position(truck);
    assert!((there - Vector3::new(-2.0, 0.0, 1.0)).norm() < 0.45, "{there}");
    lead(&mut stage, truck, Vector3::zeros(), 5);
    assert_eq!(falls(&stage), [FallCause::Slipped]);
}
