//! Ground that is not level: rays, people and things meet the surface that the world has, triangle by triangle.

use std::sync::Arc;

use crate::common::{PERSON, Stage, land};
use simworld_core::action::Action;
use simworld_core::geometry::{Point2, Point3, Ray, Vector3, pose_facing};
use simworld_core::ground::Ground;
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape, World};
use simworld_core::seam::Dynamics;
use simworld_core::seed::Seed;
use simworld_physics::{HumanoidConfig, PhysicsConfig, PhysicsDynamics};

fn hills() -> Arc<Ground> {
    // Every corner another height, so that a cell cut the wrong way, mirrored or turned is met elsewhere.
    land(|at| {
        3.0 * simworld_core::ops::sin(at.x * 0.31 + 0.02 * at.y * at.y)
            + 0.05 * at.y
            + 0.8 * simworld_core::ops::cos(at.x * at.y * 0.7)
    })
}

#[test]
fn rays_meet_the_triangles_of_the_ground() {
    let ground = hills();
    let mut stage = Stage::on(&ground);
    stage.step();
    let mut rng = Seed(3).stream("places").rng();
    for _ in 0..2000 {
        let at = Point2::new(rng.uniform(-39.9, 79.9), rng.uniform(-29.9, 49.9));
        let ray = Ray { origin: Point3::new(at.x, at.y, 100.0), direction: -Vector3::z() };
        let met = 100.0 - stage.physics.cast_at_ground(&ray, 500.0).expect("there is ground");
        assert!((met - ground.height(at)).abs() < 1e-6, "{at}: {met}, not {}", ground.height(at));
    }
    let beyond = Ray { origin: Point3::new(200.0, 0.0, 100.0), direction: -Vector3::z() };
    assert!(stage.physics.cast_at_ground(&beyond, 500.0).is_none(), "the old ground is gone");
}

#[test]
fn what_falls_comes_to_rest_on_the_ground() {
    let ground = land(|at| 0.12 * at.x - 0.05 * at.y);
    let mut stage = Stage::on(&ground);
    let mut ids = Vec::new();
    for index in 0..12 {
        let at = Point2::new(-20.0 + f64::from(index % 4) * 15.0, -15.0 + f64::from(index / 4) * 15.0);
        let pose = pose_facing(Point3::new(at.x, at.y, ground.height(at) + 1.5), 0.4);
        let desc = EntityDesc::new(EntityKind::Prop, pose, Shape::cuboid(0.6, 0.6, 0.4)).weighing(20.0);
        let id = stage.world.spawn(desc).unwrap();
        stage.physics.add_rigid(&stage.world, id).unwrap();
        ids.push(id);
    }
    stage.run(80);
    for id in ids {
        let rest = stage.position(id);
        let off = rest.z - ground.height(rest.xy());
        assert!(off.abs() < 0.05, "{rest} is {off} m off the ground");
    }
}

#[test]
fn people_walk_with_their_soles_on_the_ground_and_slower_on_slopes() {
    let ground = land(|at| 1.5 * simworld_core::ops::sin(at.x * 0.2) + 0.1 * at.y);
    let mut stage = Stage::on(&ground);
    let start = Point2::new(-30.0, 4.3);
    let walker = stage.person(pose_facing(ground.point(start), 0.0));
    stage.run(2);
    stage.tell(walker, Action::MoveForward { speed: 1.4 });
    let (mut way, mut before) = (0.0, stage.position(walker));
    for _ in 0..300 {
        stage.step();
        let now = stage.position(walker);
        assert!((now.z - ground.height(now.xy())).abs() < 1e-6, "{now}");
        way += (now - before).norm();
        before = now;
    }
    // By Tobler's function, over grades of up to 30 %: a half to nine tenths of the speed on the level.
    assert!((0.5..0.9).contains(&(way / (1.4 * 30.0))), "{way} m in 30 s");
    assert!(before.x > -10.0, "{before}");
}

#[test]
fn a_cliff_is_not_climbed_and_a_fall_ends_on_the_ground() {
    let ground = land(|at| if at.x < 10.0 { 0.0 } else { 6.0 });
    let mut stage = Stage::on(&ground);
    let walker = stage.person(pose_facing(Point3::new(4.0, 1.0, 0.0), 0.0));
    let above = stage.person(pose_facing(Point3::new(20.0, 1.0, 9.0), 0.0));
    stage.run(2);
    stage.tell(walker, Action::MoveForward { speed: 1.4 });
    // Who comes down three metres falls, and is on its feet again after that.
    stage.run(200);
    let (there, fallen) = (stage.position(walker), stage.position(above));
    assert!(there.x < 8.3 && there.z < 0.3, "{there}");
    assert!((fallen.z - 6.0).abs() < 1e-6, "{fallen}");
}

#[test]
fn walls_and_steps_on_a_slope_are_what_they_are_on_the_level() {
    let ground = land(|at| 0.15 * at.x);
    let mut stage = Stage::on(&ground);
    let shape = Shape::cuboid(1.0, 8.0, 3.0);
    stage.spawn(EntityKind::Building, pose_facing(Point3::new(10.0, 0.0, 1.0), 0.0), shape);
    let low = Shape::cuboid(4.0, 4.0, 0.5);
    // 0.2 m above the ground at its edge.
    let top = ground.height(Point2::new(-2.0, 20.0)) + 0.2;
    stage.spawn(EntityKind::Building, pose_facing(Point3::new(0.0, 20.0, top - 0.5), 0.0), low);
    let blocked = stage.person(pose_facing(ground.point(Point2::new(0.0, 0.0)), 0.0));
    let stepping = stage.person(pose_facing(ground.point(Point2::new(-5.0, 20.0)), 0.0));
    stage.run(2);
    for walker in [blocked, stepping] {
        stage.tell(walker, Action::MoveForward { speed: 1.0 });
    }
    stage.run(63);
    let on = stage.position(stepping);
    assert!(on.x > -1.9 && on.x < 0.0 && (on.z - top).abs() < 0.03, "{on} on {top}");
    stage.run(120);
    let there = stage.position(blocked);
    assert!(there.x < 9.5 && there.x > 9.0, "{there}");
}

#[test]
fn saved_on_its_ground_it_goes_on_and_on_another_it_is_refused() {
    let ground = hills();
    let build = |ground: &Arc<Ground>| {
        let mut world = World::new();
        world.set_ground(Arc::clone(ground));
        let start = pose_facing(ground.point(Point2::new(3.0, 2.0)), 0.3);
        let id = world.spawn(EntityDesc::new(EntityKind::Person, start, PERSON)).unwrap();
        let mut physics = PhysicsDynamics::new(PhysicsConfig::default()).unwrap();
        physics.add_humanoid(&world, id, HumanoidConfig::default()).unwrap();
        (world, physics, id)
    };
    let step = |world: &mut World, physics: &mut PhysicsDynamics| {
        world.begin_step();
        physics.step(world, 0.1).unwrap();
        world.finish_step();
    };
    let (mut world, mut physics, id) = build(&ground);
    world.actuate(id, Action::MoveForward { speed: 1.2 }).unwrap();
    for _ in 0..20 {
        step(&mut world, &mut physics);
    }
    let (saved, snapshot) = (physics.save().unwrap(), world.snapshot());
    let (_, mut again, _) = build(&ground);
    let mut world_again = World::restore(snapshot).unwrap();
    again.restore(&world_again, &saved).unwrap();
    for _ in 0..20 {
        step(&mut world, &mut physics);
        step(&mut world_again, &mut again);
    }
    assert_eq!(world.entity(id).unwrap().pose, world_again.entity(id).unwrap().pose);
    let (other, mut physics, _) = build(&land(|at| at.x * 0.1));
    assert!(physics.restore(&other, &saved).unwrap_err().to_string().contains("ground"));
}
