//! Fixed solids that leave the engine where nobody is change nothing for who is somewhere.

use crate::common::{Stage, at};
use simworld_core::action::Action;
use simworld_core::geometry::{Point3, Pose, Ray, Twist, Vector3, pose_facing};
use simworld_core::hash::{StateDigest, StateHash};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityKind, RayCast, Scene, Shape, World};
use simworld_core::seam::Dynamics;
use simworld_core::seed::Seed;
use simworld_physics::{HumanoidConfig, PhysicsConfig, PhysicsDynamics, VehicleClass};

/// How long the street is, m.
const LENGTH: f64 = 1200.0;

/// A physics that keeps solids around points of interest, or all of them.
fn config(streaming_radius: Option<f64>) -> PhysicsConfig {
    PhysicsConfig { streaming_radius, detail_radius: 1e4, ..PhysicsConfig::default() }
}

/// A raised path along y = 0 of slabs with houses on both sides, and things between them.
fn street(streaming_radius: Option<f64>) -> Stage {
    let mut stage = Stage::with(config(streaming_radius));
    let mut x = -20.0;
    while x < LENGTH {
        stage.building(x, 0.0, (4.0, 5.0, 0.6));
        stage.building(x, 12.0, (3.5, 8.0, 9.0));
        stage.building(x, -12.0, (3.0, 6.0, 12.0));
        x += 4.0;
    }
    stage.physics.set_interest(&[Point3::origin()]);
    stage
}

fn on_path(x: f64, y: f64, up: f64) -> Pose {
    pose_facing(Point3::new(x, y, 0.6 + up), 0.0)
}

/// Who moves in the street: two who walk, a car, a ball that rolls and a pile that lies.
fn populate(stage: &mut Stage) -> Vec<EntityId> {
    let mut all = vec![stage.person(on_path(0.0, 0.0, 0.0)), stage.person(on_path(0.0, 1.5, 0.0))];
    for (index, speed) in [2.0, 2.5].into_iter().enumerate() {
        stage.tell(all[index], Action::MoveForward { speed });
    }
    let car = stage.spawn(EntityKind::Car, at(0.0, 5.5, 0.0), Shape::cuboid(4.5, 1.8, 1.5));
    stage.physics.add_vehicle(&stage.world, car, VehicleClass::Sedan.parameters()).unwrap();
    stage.tell(car, Action::Throttle { level: 0.1 });
    all.push(car);
    all.push(stage.ball(Point3::new(3.0, -1.5, 0.8), Vector3::new(3.0, 0.0, 0.0), 1.0));
    for level in 0..3 {
        let place = Point3::new(5.0, -2.0, 0.65 + 0.5 * f64::from(level));
        let box_ = stage.spawn(EntityKind::Prop, pose_facing(place, 0.0), Shape::cuboid(0.4, 0.4, 0.4));
        stage.physics.add_rigid(&stage.world, box_).unwrap();
        all.push(box_);
    }
    all
}

#[test]
fn everybody_moves_as_among_all_solids_and_nobody_falls_through() {
    let (mut whole, mut streamed) = (street(None), street(Some(30.0)));
    let (all, same) = (populate(&mut whole), populate(&mut streamed));
    assert_eq!(all, same);
    for step in 0..900 {
        for stage in [&mut whole, &mut streamed] {
            let here = stage.position(all[0]);
            stage.physics.set_interest(&[here]);
            stage.step();
        }
        for id in &all {
            let [a, b] = [&whole, &streamed].map(|stage| stage.position(*id));
            assert!((a - b).norm() < 1e-3, "step {step}: {id} is at {b}, and at {a} among all solids");
        }
        for walker in &all[..2] {
            let z = streamed.position(*walker).z;
            assert!((z - 0.6).abs() < 0.05, "step {step}: {walker} is at {z} m");
        }
    }
    assert!(streamed.position(all[0]).x > 170.0 && streamed.position(all[2]).x > 200.0);
    let (inside, count) = streamed.physics.fixed_solids();
    assert_eq!(whole.physics.fixed_solids(), (count, count));
    assert!(inside < count / 2, "{inside} of {count} solids are in the engine");
    // Nobody is interested in anything: everything is there again, and nothing falls.
    streamed.physics.set_interest(&[]);
    streamed.run(5);
    assert_eq!(streamed.physics.fixed_solids(), (count, count));
    assert!((streamed.position(all[0]).z - 0.6).abs() < 0.05);
}

#[test]
fn who_comes_from_afar_at_once_stands_on_what_is_there() {
    let mut stage = street(Some(30.0));
    let all = populate(&mut stage);
    stage.run(2);
    for x in [1000.0, 64.0 * 9.0, 300.0, 1100.0] {
        stage.world.set_motion(all[0], on_path(x, 0.0, 0.0), Twist::ZERO).unwrap();
        let from = stage.physics.fixed_solids().0;
        stage.tell(all[0], Action::Stop);
        stage.run(10);
        assert!((stage.position(all[0]).z - 0.6).abs() < 0.05, "{}", stage.position(all[0]));
        assert!(stage.physics.fixed_solids().0 > from, "his surroundings come along");
    }
    stage.run(80);
    let (inside, count) = stage.physics.fixed_solids();
    assert!(inside < count / 2, "what he left is given up: {inside} of {count}");
}

#[test]
fn rays_and_overlaps_meet_what_is_away() {
    let (mut whole, mut streamed) = (street(None), street(Some(30.0)));
    for stage in [&mut whole, &mut streamed] {
        // Something wide, which no grid holds, something high, and something tilted.
        stage.building(500.0, 300.0, (900.0, 400.0, 3.0));
        let tilt = nalgebra::UnitQuaternion::from_euler_angles(0.3, 0.4, 0.5);
        let pose = Pose::from_parts(Vector3::new(640.0, 40.0, 30.0).into(), tilt);
        stage.spawn(EntityKind::Building, pose, Shape::cuboid(20.0, 3.0, 60.0));
        stage.run(1);
    }
    let mut rng = Seed(11).stream("test/streaming").rng();
    let (mut met, mut far) = (0, 0);
    for round in 0..4000 {
        let origin =
            Point3::new(rng.uniform(-200.0, 1400.0), rng.uniform(-90.0, 90.0), rng.uniform(0.1, 40.0));
        let mut way = Vector3::new(rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0), rng.uniform(-0.1, 0.05));
        match round % 8 {
            0 => way.x = 0.0,
            1 => way.y = 0.0,
            2 => way = Vector3::new(0.0, 0.0, -1.0),
            _ => {}
        }
        let ray = Ray { origin, direction: way.normalize() };
        let reach = [20.0, 200.0, 2000.0, f64::MAX][round % 4];
        let is_seen = |id: EntityId| !id.index().is_multiple_of(7);
        let [a, b] = [&whole, &streamed].map(|stage| stage.physics.cast_ray(&ray, reach, &is_seen));
        assert_eq!(a.map(|hit| hit.distance), b.map(|hit| hit.distance), "{ray:?} within {reach}");
        met += usize::from(a.is_some());
        far += usize::from(a.is_some_and(|hit| ray.at(hit.distance).x > 200.0));
        let probe = Shape::cuboid(rng.uniform(0.5, 200.0), rng.uniform(0.5, 30.0), 3.0);
        let (mut x, mut y) = (Vec::new(), Vec::new());
        whole.physics.overlapping(&probe, &pose_facing(origin, 0.3), &mut x);
        streamed.physics.overlapping(&probe, &pose_facing(origin, 0.3), &mut y);
        assert_eq!(x, y, "{probe:?} at {origin}");
    }
    assert!(met > 400 && far > 300, "{met} rays met something, {far} of them what is away");
    let (inside, count) = streamed.physics.fixed_solids();
    assert!(inside < count / 4);
}

#[test]
fn what_changes_while_it_is_away_is_met_as_it_is() {
    let mut stage = street(Some(30.0));
    let away = stage.building(900.0, 0.0, (1.0, 3.0, 3.0));
    let goes = stage.building(910.0, 0.0, (1.0, 3.0, 3.0));
    stage.run(1);
    let down = |stage: &Stage, x: f64| {
        let ray = Ray { origin: Point3::new(x, 0.0, 50.0), direction: -Vector3::z() };
        stage.physics.cast_ray(&ray, 100.0, &|_| true).map(|hit| hit.entity)
    };
    assert_eq!((down(&stage, 900.0), down(&stage, 910.0)), (Some(away), Some(goes)));
    stage.world.set_motion(away, at(800.0, 0.0, 0.0), Twist::ZERO).unwrap();
    stage.world.remove(goes).unwrap();
    stage.run(1);
    assert_eq!(down(&stage, 800.0), Some(away));
    assert!(![Some(away), Some(goes)].contains(&down(&stage, 900.0)));
    assert!(![Some(away), Some(goes)].contains(&down(&stage, 910.0)));
    // Who goes there is stopped by the one where it stands now, and passes where it stood.
    let walker = stage.person(on_path(797.0, 0.0, 0.0));
    stage.tell(walker, Action::MoveForward { speed: 1.4 });
    stage.run(50);
    assert!((stage.position(walker).x - 799.25).abs() < 0.1, "{}", stage.position(walker));
    let other = stage.person(on_path(896.0, 0.0, 0.0));
    stage.tell(other, Action::MoveForward { speed: 1.4 });
    stage.run(130);
    assert!(stage.position(other).x > 912.0, "{}", stage.position(other));
}

#[test]
fn it_goes_on_bit_for_bit_from_a_saved_state() {
    let go = |stage: &mut Stage, who: EntityId, steps: usize| -> StateDigest {
        for _ in 0..steps {
            let here = stage.position(who);
            stage.physics.set_interest(&[here]);
            stage.step();
        }
        stage.physics.digest()
    };
    let mut stage = street(Some(30.0));
    let all = populate(&mut stage);
    go(&mut stage, all[0], 200);
    let (world, saved) = (stage.world.snapshot(), stage.physics.save().unwrap());
    let whole = go(&mut stage, all[0], 300);
    let mut fresh = Stage::with(config(Some(30.0)));
    fresh.world = World::restore(world.clone()).unwrap();
    for id in &all[..2] {
        fresh.physics.add_humanoid(&fresh.world, *id, HumanoidConfig::default()).unwrap();
    }
    fresh.physics.add_vehicle(&fresh.world, all[2], VehicleClass::Sedan.parameters()).unwrap();
    for id in &all[3..] {
        fresh.physics.add_rigid(&fresh.world, *id).unwrap();
    }
    fresh.physics.restore(&fresh.world, &saved).unwrap();
    assert_eq!(go(&mut fresh, all[0], 300), whole, "a fresh physics");
    stage.world = World::restore(world).unwrap();
    stage.physics.restore(&stage.world, &saved).unwrap();
    assert_eq!(go(&mut stage, all[0], 300), whole, "rolled back");
}

#[test]
fn solids_that_come_when_it_freezes_are_as_slippery_as_the_others() {
    let slides = |streaming: Option<f64>, rain: f64| {
        let mut stage = street(streaming);
        stage.run(1);
        let mut environment = *stage.world.environment();
        (environment.weather.rain, environment.weather.temperature) = (rain, -5.0);
        stage.world.set_environment(environment).unwrap();
        stage.run(5);
        let size = Shape::cuboid(0.8, 0.8, 0.1);
        let box_ = stage.spawn(EntityKind::Prop, on_path(600.0, 0.0, 0.0), size);
        stage.physics.add_rigid(&stage.world, box_).unwrap();
        stage.run(5);
        let linear = Vector3::new(3.0, 0.0, 0.0);
        let twist = Twist { linear, angular: Vector3::zeros() };
        stage.world.set_motion(box_, on_path(600.0, 0.0, 0.0), twist).unwrap();
        stage.run(60);
        stage.position(box_).x - 600.0
    };
    let (whole, streamed) = (slides(None, 5.0), slides(Some(30.0), 5.0));
    assert!((whole - streamed).abs() < 0.05 * whole, "{whole} m, and {streamed} m");
    let dry = slides(Some(30.0), 0.0);
    assert!(dry < 0.6 * whole, "{dry} m when it is dry, {whole} m on ice");
}

#[test]
fn a_radius_that_is_none_is_refused() {
    for radius in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = PhysicsDynamics::new(config(Some(radius))).unwrap_err();
        assert!(error.to_string().contains("streaming_radius"), "{error}");
    }
}
