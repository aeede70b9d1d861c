//! Far from what is of interest people walk by looks alone: as far as near by, on the same ground, off the same walls.

use crate::common::{PERSON, Stage, at, ramp};
use simworld_core::action::{Action, StepDirection};
use simworld_core::event::EventKind;
use simworld_core::geometry::{Point3, Ray, Twist, Vector3};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityKind, RayCast, Scene, Shape};
use simworld_core::seam::Dynamics;
use simworld_core::seed::Seed;
use simworld_physics::{Detail, HumanoidConfig, PhysicsConfig};

/// Nothing here is near it.
const ELSEWHERE: Point3 = Point3::new(1e5, 0.0, 0.0);

/// A stage of which nothing is of interest.
fn far() -> Stage {
    let mut stage = Stage::new();
    stage.physics.set_interest(&[ELSEWHERE]);
    stage
}

/// A stage where everything is, and one where nothing is, set up alike.
fn both(set_up: impl Fn(&mut Stage) -> EntityId) -> [(Box<Stage>, EntityId); 2] {
    [Box::new(Stage::new()), Box::new(far())].map(|mut stage| {
        let who = set_up(&mut stage);
        (stage, who)
    })
}

/// What it is called, and what stands in the way.
type Walk = (&'static str, fn(&mut Stage));

fn heading_east(stage: &mut Stage, x: f64, speed: f64) -> EntityId {
    let who = stage.person(at(x, 0.0, 0.0));
    stage.tell(who, Action::MoveForward { speed });
    who
}

#[test]
fn who_comes_near_goes_on_without_a_jump() {
    let mut stage = Stage::new();
    let who = heading_east(&mut stage, 0.0, 1.4);
    let radius = stage.physics.config().detail_radius;
    let (mut changes, mut before) = (0, None);
    let hip = |stage: &Stage| stage.world.joints(who).map_or(0.0, |joints| joints.left_leg.hip_flexion);
    let mut held = hip(&stage);
    for step in 0..100 {
        // Interest comes up from behind.
        let x = -radius - 20.0 + f64::from(step);
        stage.physics.set_interest(&[Point3::new(x, 0.0, 0.0)]);
        let from = stage.position(who);
        let facing = stage.world.entity(who).unwrap().pose.rotation;
        stage.step();
        let (to, velocity) = (stage.position(who), stage.velocity(who));
        let says = ((to - from) / 0.1 - velocity).norm();
        assert!(step == 0 || says < 1e-9, "step {step}: it moves as it says");
        assert!((0.139..=0.141).contains(&(to - from).norm()), "step {step}: {}", (to - from).norm());
        assert!(to.z.abs() < 1e-9, "step {step}: {to}");
        assert!(facing.angle_to(&stage.world.entity(who).unwrap().pose.rotation) < 0.41, "step {step}");
        let now = stage.physics.detail(who);
        changes += usize::from(before.is_some() && before != now);
        before = now;
        let holds = hip(&stage);
        assert!(
            step < 10 || (holds - held).abs() < 1.0,
            "step {step}: the leg goes on in its stride: {held}, {holds}"
        );
        held = holds;
    }
    assert_eq!(changes, 1, "it came near");
    assert_eq!(stage.events.len(), 0, "{:?}", stage.events);
}

#[test]
fn far_and_near_lead_to_the_same_places() {
    let walks: [Walk; 4] = [
        ("level", |_| {}),
        ("a kerb", |stage| {
            stage.building(6.0, 0.0, (4.0, 6.0, 0.15));
        }),
        ("a ramp", |stage| {
            let (pose, shape) = ramp(4.0, 0.2);
            stage.spawn(EntityKind::Building, pose, shape);
        }),
        ("a wall", |stage| {
            stage.building(8.0, 0.0, (1.0, 6.0, 3.0));
        }),
    ];
    for (name, set_up) in walks {
        let [near, far] = both(|stage| {
            set_up(stage);
            heading_east(stage, 0.0, 1.34)
        })
        .map(|(mut stage, who)| {
            stage.run(70);
            (stage.position(who), stage.physics.detail(who))
        });
        assert_eq!((near.1, far.1), (Some(Detail::Full), Some(Detail::Reduced)));
        let apart = far.0 - near.0;
        // A step up or down is seen within a pace.
        assert!(apart.xy().norm() < 0.45 && apart.z.abs() < 0.18, "{name}: {} near, {} far", near.0, far.0);
    }
}

#[test]
fn walls_are_walked_along_and_left_again() {
    let mut stage = far();
    stage.building(6.0, 0.0, (1.0, 8.0, 3.0));
    let who = stage.person(at(0.0, 0.0, 0.6));
    stage.tell(who, Action::MoveForward { speed: 1.34 });
    stage.run(100);
    let place = stage.position(who);
    assert!(place.y > 4.0 && place.x > 6.0, "round the end of the wall: {place}");
}

#[test]
fn nobody_walks_into_what_stands_fixed() {
    let mut rng = Seed(11).stream("test/far").rng();
    for radius in [0.2, 0.25, 0.35] {
        let mut stage = far();
        let walls: Vec<EntityId> = (0..60)
            .map(|_| {
                let size = (rng.uniform(0.3, 5.0), rng.uniform(0.3, 5.0), rng.uniform(0.3, 4.0));
                let yaw = rng.uniform(-3.0, 3.0);
                let place = at(rng.uniform(-20.0, 20.0), rng.uniform(-20.0, 20.0), yaw);
                stage.spawn(EntityKind::Building, place, Shape::cuboid(size.0, size.1, size.2))
            })
            .collect();
        stage.step();
        let mut people = Vec::new();
        while people.len() < 30 {
            let place = at(rng.uniform(-20.0, 20.0), rng.uniform(-20.0, 20.0), rng.uniform(-3.0, 3.0));
            let mut met = Vec::new();
            stage.physics.overlapping(
                &Shape::Cylinder { radius: radius + 0.1, height: 1.8 },
                &place,
                &mut met,
            );
            if met.iter().any(|id| walls.contains(id)) {
                continue;
            }
            let who = stage.spawn(EntityKind::Person, place, Shape::Capsule { radius, height: 1.75 });
            stage.physics.add_humanoid(&stage.world, who, HumanoidConfig::default()).unwrap();
            stage.tell(who, Action::MoveForward { speed: rng.uniform(0.5, 2.5) });
            people.push(who);
        }
        let mut gone = 0.0;
        for step in 0..400 {
            if step % 10 == 0 {
                let who = people[rng.below(people.len())];
                stage.tell(who, Action::Rotate { angle: rng.uniform(-3.0, 3.0) });
            }
            if step % 35 == 0 {
                let who = people[rng.below(people.len())];
                stage.tell(who, Action::Step { direction: StepDirection::Left, distance: 1.0 });
            }
            let before: Vec<Point3> = people.iter().map(|who| stage.position(*who)).collect();
            stage.step();
            for (who, before) in people.iter().zip(before) {
                gone += (stage.position(*who) - before).norm();
                let middle = stage.position(*who) + Vector3::z() * 1.0;
                for wall in &walls {
                    let wall = stage.world.entity(*wall).unwrap();
                    let inside = wall.pose.inverse() * middle;
                    let half = wall.info.shape.size() * 0.5;
                    let out = [inside.x.abs() - half.x, inside.y.abs() - half.y].map(|gap| gap.max(0.0));
                    let gap = (out[0] * out[0] + out[1] * out[1]).sqrt();
                    let is_beside = inside.z < 2.0 * half.z - 0.8;
                    assert!(!is_beside || gap > radius - 1e-6, "step {step}: {who} is {gap} m from a wall");
                }
            }
        }
        assert!(gone > 30.0 * 400.0 * 0.1 * 0.5, "people get on: {gone} m");
    }
}

#[test]
fn where_the_ground_ends_one_falls_and_goes_on_below() {
    let mut stage = far();
    stage.building(0.0, 0.0, (6.0, 6.0, 2.0));
    let who = stage.person(simworld_core::geometry::pose_facing(Point3::new(0.0, 0.0, 2.0), 0.0));
    stage.tell(who, Action::MoveForward { speed: 1.34 });
    stage.run(15);
    assert!((stage.position(who).z - 2.0).abs() < 0.03, "on the roof: {}", stage.position(who));
    stage.run(60);
    let place = stage.position(who);
    assert!(place.z.abs() < 1e-3 && place.x > 5.0, "on the ground: {place}");
}

#[test]
fn steep_slopes_are_not_climbed() {
    let mut stage = far();
    let (pose, shape) = ramp(4.0, 1.0);
    stage.spawn(EntityKind::Building, pose, shape);
    let who = heading_east(&mut stage, 0.0, 1.34);
    stage.run(80);
    let place = stage.position(who);
    assert!(place.x < 4.6 && place.z < 0.5, "{place}");
}

#[test]
fn rays_and_shapes_meet_who_is_far_where_it_is() {
    let mut stage = far();
    let who = heading_east(&mut stage, 0.0, 1.4);
    let other = heading_east(&mut stage, 30.0, 1.4);
    stage.run(50);
    let place = stage.position(who);
    assert!(place.x > 6.5, "{place}");
    let ray = Ray { origin: Point3::new(place.x - 5.0, 0.0, 1.0), direction: Vector3::x() };
    let hit = stage.physics.cast_ray(&ray, 100.0, &|_| true).unwrap();
    assert_eq!(hit.entity, who, "the nearer of two");
    assert!((hit.distance - 4.75).abs() < 1e-6 && (hit.normal + Vector3::x()).norm() < 1e-6, "{hit:?}");
    let hit = stage.physics.cast_ray(&ray, 100.0, &|id| id != who).unwrap();
    assert_eq!(hit.entity, other);
    let mut met = Vec::new();
    stage.physics.overlapping(&Shape::cuboid(1.0, 1.0, 1.0), &at(place.x, 0.3, 0.0), &mut met);
    assert_eq!(met, [who]);
    stage.physics.overlapping(&Shape::cuboid(1.0, 1.0, 1.0), &at(0.0, 0.0, 0.0), &mut met);
    assert_eq!(met, [], "nobody is where it went off");
}

#[test]
fn who_is_moved_or_carried_far_away_is_where_it_was_put() {
    let mut stage = far();
    let who = heading_east(&mut stage, 0.0, 1.0);
    stage.run(10);
    stage.world.set_motion(who, at(0.0, 50.0, 0.0), Twist::ZERO).unwrap();
    stage.run(20);
    let place = stage.position(who);
    assert!((place.y - 50.0).abs() < 1e-9 && (1.8..2.05).contains(&place.x), "{place}");
    assert!((stage.physics.momentum(who).unwrap() - Vector3::x() * 75.0).norm() < 1e-6);
    stage.physics.set_interest(&[]);
    stage.step();
    let after = stage.position(who);
    assert!((after.x - place.x - 0.1).abs() < 1e-9, "{place} to {after}");
}

#[test]
fn a_car_that_comes_near_strikes_who_was_far() {
    let mut stage = far();
    let who = stage.person(at(0.0, 0.0, 0.0));
    stage.run(5);
    stage.physics.set_interest(&[Point3::origin()]);
    let car = stage.spawn(EntityKind::Car, at(-6.0, 0.0, 0.0), Shape::cuboid(4.3, 1.8, 1.5));
    for step in 1..=15 {
        stage.world.set_motion(car, at(-6.0 + 0.8 * f64::from(step), 0.0, 0.0), Twist::ZERO).unwrap();
        stage.step();
    }
    assert!(stage.events.iter().any(|event| matches!(event, EventKind::Fell { who: it, .. } if *it == who)));
}

#[test]
fn saved_far_away_it_goes_on_to_the_bit_on_any_number_of_threads() {
    let run = |threshold: usize, saves: bool| {
        let make = || {
            let mut stage =
                Stage::with(PhysicsConfig { parallel_threshold: threshold, ..PhysicsConfig::default() });
            stage.physics.set_interest(&[ELSEWHERE]);
            stage
        };
        let mut rng = Seed(3).stream("test/far").rng();
        let mut stage = make();
        for _ in 0..20 {
            stage.building(rng.uniform(-15.0, 15.0), rng.uniform(-15.0, 15.0), (2.0, 1.0, 3.0));
            stage.building(rng.uniform(-15.0, 15.0), rng.uniform(-15.0, 15.0), (2.0, 3.0, 0.15));
        }
        let people: Vec<EntityId> = (0..60)
            .map(|_| {
                let place = at(rng.uniform(-15.0, 15.0), rng.uniform(-15.0, 15.0), rng.uniform(-3.0, 3.0));
                let who = stage.spawn(EntityKind::Person, place, PERSON);
                stage.physics.add_humanoid(&stage.world, who, HumanoidConfig::default()).unwrap();
                stage.tell(who, Action::MoveForward { speed: 1.34 });
                who
            })
            .collect();
        stage.run(33);
        if saves {
            let saved = stage.physics.save().unwrap();
            let world = stage.world.clone();
            let mut resumed = make();
            resumed.world = world;
            for who in &people {
                resumed.physics.add_humanoid(&resumed.world, *who, HumanoidConfig::default()).unwrap();
            }
            resumed.physics.restore(&resumed.world, &saved).unwrap();
            stage = resumed;
        }
        stage.run(40);
        let states: Vec<_> = people.iter().map(|who| stage.physics.state(*who)).collect();
        (states, stage.physics.save().unwrap())
    };
    let straight = run(1, false);
    assert!(straight == run(1, true), "saved and taken up");
    assert!(straight.0 == run(usize::MAX, false).0, "on one thread");
}

/// Ten stairs of 0.17 m that rise towards east from x = 6 m, with a landing, and as many down behind it.
fn flight(stage: &mut Stage, tread: f64) -> f64 {
    for index in 0..10 {
        let height = 0.17 * f64::from(index + 1);
        for x in [6.0 + tread * f64::from(index), 6.0 + tread * f64::from(23 - index) + 3.0] {
            stage.building(x + 0.5 * tread, 0.0, (tread, 14.0, height));
        }
    }
    stage.building(7.5 + 10.0 * tread + 2.0 * tread, 0.0, (3.0 + 4.0 * tread, 14.0, 1.7));
    6.0 + 10.0 * tread
}

#[test]
fn stairs_are_walked_up_and_down_and_what_is_no_stair_is_a_wall() {
    for tread in [0.26, 0.3, 0.4] {
        for aslant in [0.0, 0.25] {
            let mut stage = far();
            let top = flight(&mut stage, tread);
            let who = stage.person(at(0.0, -1.5, aslant));
            stage.tell(who, Action::MoveForward { speed: 1.34 });
            let (mut highest, mut arrives) = (0.0_f64, None);
            for step in 0..400 {
                let from = stage.position(who);
                stage.step();
                let to = stage.position(who);
                highest = highest.max(to.z);
                assert!((to.z - from.z).abs() < 0.35, "treads of {tread} m: {from} to {to}");
                if arrives.is_none() && to.x > top + 0.3 {
                    arrives = Some(step);
                }
            }
            let place = stage.position(who);
            assert!(
                (highest - 1.7).abs() < 0.02 && arrives.is_some(),
                "treads of {tread} m: up to {highest} m, {place}"
            );
            assert!(place.z.abs() < 0.01 && place.x > top + 8.0, "treads of {tread} m: down again: {place}");
            assert_eq!(stage.physics.detail(who), Some(Detail::Reduced));
        }
    }
    // Risers of 0.3 m are no stairs, a shelf over the treads leaves no room, and neither does a wall at their end.
    for (name, risers, ceiling) in [("risers", 0.3, false), ("a ceiling", 0.17, true)] {
        let mut stage = far();
        for index in 0..6 {
            let height = risers * f64::from(index + 1);
            stage.building(6.0 + 0.3 * f64::from(index), 0.0, (0.3, 14.0, height));
        }
        if ceiling {
            let shelf = simworld_core::geometry::pose_facing(Point3::new(8.0, 0.0, 2.0), 0.0);
            stage.spawn(EntityKind::Building, shelf, Shape::cuboid(3.6, 6.0, 0.3));
        }
        let who = heading_east(&mut stage, 0.0, 1.34);
        stage.run(150);
        let place = stage.position(who);
        assert!(place.x < 6.5 && place.z < 0.55, "{name}: {place}");
    }
}

#[test]
fn who_goes_from_near_to_far_and_back_again_neither_jumps_nor_ends_up_in_something() {
    for phase in [7, 13, 29] {
        let mut stage = Stage::new();
        flight(&mut stage, 0.3);
        stage.building(3.0, 0.0, (1.0, 6.0, 0.15));
        let walls = [stage.building(22.0, 2.4, (1.0, 3.0, 3.0)), stage.building(22.0, -2.6, (1.0, 3.0, 3.0))];
        let people: Vec<EntityId> = [-2.0, -0.4, 1.0, 2.2]
            .into_iter()
            .map(|y| {
                let who = stage.person(at(-0.4 * y, y, 0.03));
                stage.tell(who, Action::MoveForward { speed: 1.4 });
                who
            })
            .collect();
        let mut changes = 0;
        for step in 0..450 {
            let is_near = (step / phase) % 2 == 0;
            stage.physics.set_interest(&[if is_near { Point3::origin() } else { ELSEWHERE }]);
            let before: Vec<(Point3, Option<Detail>)> =
                people.iter().map(|who| (stage.position(*who), stage.physics.detail(*who))).collect();
            stage.step();
            for (who, (from, detail)) in people.iter().zip(before) {
                let to = stage.position(*who);
                changes += usize::from(detail != stage.physics.detail(*who));
                assert!((to - from).xy().norm() < 0.23, "step {step}: {who} goes from {from} to {to}");
                assert!((to.z - from.z).abs() < 0.36, "step {step}: {who} goes from {from} to {to}");
                let mut met = Vec::new();
                let pose = simworld_core::geometry::pose_facing(to + Vector3::z() * 0.4, 0.0);
                stage.physics.overlapping(&Shape::Cylinder { radius: 0.2, height: 1.2 }, &pose, &mut met);
                assert!(!met.iter().any(|id| walls.contains(id)), "step {step}: {who} is in a wall at {to}");
            }
        }
        assert!(changes > 4 * 300 / phase, "{changes} times from one to the other");
        assert!(
            stage.events.iter().all(|event| !matches!(event, EventKind::Fell { .. })),
            "{:?}",
            stage.events
        );
        for who in &people {
            assert!(stage.position(*who).x > 16.0, "everybody is over the stairs: {}", stage.position(*who));
        }
    }
}
