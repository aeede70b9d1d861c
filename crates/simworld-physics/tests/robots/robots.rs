//! Robots are moved by the laws of mechanics and by what their motors give, and by nothing else.
#![allow(clippy::unwrap_used)]

use std::f64::consts::{PI, TAU};

use crate::common::Stage;
use nalgebra::UnitQuaternion;
use simworld_core::geometry::{Point3, Pose, Twist, Vector3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::ops;
use simworld_core::scene::{EntityDesc, EntityKind, Scene, Shape};
use simworld_core::seam::{Dynamics, Embodiment};
use simworld_physics::robot::{
    Base, Form, JointDescription, JointKind, LinkDescription, RobotDescription, Weight,
};
use simworld_physics::{JointCommand, Material, QuadrupedModel, Robot, RobotConfig};

const G: f64 = 9.81;

fn add(stage: &mut Stage, place: Point3, config: RobotConfig) -> EntityId {
    let shape = Shape::cuboid(0.5, 0.5, 0.5);
    let id = stage.spawn(EntityKind::Robot, pose_facing(place, 0.0), shape);
    stage.physics.add_robot(&stage.world, id, config).unwrap();
    id
}

fn robot(stage: &Stage, id: EntityId) -> &Robot {
    stage.physics.body_as(id).unwrap()
}

fn angle(stage: &Stage, id: EntityId, joint: usize) -> f64 {
    robot(stage, id).reading(joint).unwrap().angle
}

/// Rods without mass, of a metre each, with a kilogram at the end of each.
fn chain(count: usize) -> RobotDescription {
    let mut links = vec![LinkDescription::new("stand")];
    let mut joints = Vec::new();
    for rod in 0..count {
        let (name, parent) = (format!("rod {rod}"), links[rod].name.clone());
        let down = Vector3::new(0.0, 0.0, -1.0);
        let place = if rod == 0 { Vector3::zeros() } else { down };
        let hinge = JointDescription::new(&format!("hinge {rod}"), JointKind::Continuous, [&parent, &name]);
        joints.push(hinge.at(place).about(Vector3::y()));
        links.push(LinkDescription::new(&name).with_mass(1.0, down, [1e-7; 3]));
    }
    RobotDescription {
        name: "chain".to_owned(),
        base: Base::Fixed,
        links,
        joints,
        ..RobotDescription::default()
    }
}

fn starting_at(description: RobotDescription, positions: &[(&str, f64)]) -> RobotConfig {
    let positions = positions.iter().map(|(name, position)| ((*name).to_owned(), *position)).collect();
    RobotConfig { positions, substep: 1e-3, ..RobotConfig::from(description) }
}

#[test]
fn a_pendulum_swings_with_the_period_of_its_formula() {
    for amplitude in [0.1, 1.0] {
        let mut stage = Stage::new();
        let id =
            add(&mut stage, Point3::new(0.0, 0.0, 5.0), starting_at(chain(1), &[("hinge 0", amplitude)]));
        // By the series of the period in the amplitude (Nelson and Olsson 1986): 2.0076 s and 2.1390 s.
        let a = amplitude * amplitude;
        let period =
            TAU * (1.0 / G).sqrt() * (1.0 + a / 16.0 + 11.0 * a * a / 3072.0 + 173.0 * a * a * a / 737_280.0);
        let (mut before, mut crossings) = (amplitude, Vec::new());
        for step in 1..=1000 {
            stage.tick(0.01);
            let now = angle(&stage, id, 0);
            if before < 0.0 && now >= 0.0 {
                crossings.push(f64::from(step) * 0.01 - 0.01 * now / (now - before));
            }
            before = now;
        }
        let measured = (crossings[crossings.len() - 1] - crossings[0]) / (crossings.len() - 1) as f64;
        assert!((measured / period - 1.0).abs() < 2e-3, "{amplitude} rad: {measured} s, not {period} s");
    }
}

#[test]
fn a_double_pendulum_keeps_its_energy() {
    let mut stage = Stage::new();
    let config = starting_at(chain(2), &[("hinge 0", 1.5), ("hinge 1", 0.5)]);
    let id = add(&mut stage, Point3::new(0.0, 0.0, 5.0), config);
    let energy = |stage: &Stage| {
        let [one, two] = [0, 1].map(|joint| robot(stage, id).reading(joint).unwrap());
        let (first, second) = (one.angle, one.angle + two.angle);
        let (w1, w2) = (one.speed, one.speed + two.speed);
        let still = -2.0 * G * ops::cos(first) - G * ops::cos(second);
        still + w1 * w1 + 0.5 * w2 * w2 + w1 * w2 * ops::cos(first - second)
    };
    let start = energy(&stage);
    let mut worst: f64 = 0.0;
    for _ in 0..500 {
        stage.tick(0.01);
        worst = worst.max((energy(&stage) - start).abs());
    }
    println!("energy off by at most {worst:.3} J of {:.1}", 3.0 * G);
    assert!(worst < 0.02 * 3.0 * G, "{worst}");
}

/// A slide, an elbow and a wrist, with limits and motors.
fn crane() -> RobotDescription {
    let unit = Pose::identity();
    let beam = |name: &str, mass| {
        LinkDescription::new(name)
            .with_mass(mass, Vector3::new(0.25, 0.0, 0.0), [0.01, 0.05, 0.05])
            .with_solid(
                Form::Box { size: Vector3::new(0.5, 0.06, 0.06) },
                Pose::translation(0.25, 0.0, 0.0),
                Material::Metal,
            )
    };
    let lift = JointDescription::new("lift", JointKind::Prismatic, ["stand", "arm"]).about(Vector3::z());
    let elbow =
        JointDescription::new("elbow", JointKind::Revolute, ["arm", "hand"]).about(Vector3::z() * 2.0);
    let wrist = JointDescription::new("wrist", JointKind::Revolute, ["hand", "tip"]).about(-Vector3::y());
    RobotDescription {
        name: "crane".to_owned(),
        base: Base::Fixed,
        links: vec![
            LinkDescription::new("stand").with_solid(Form::Sphere { radius: 0.02 }, unit, Material::Metal),
            beam("arm", 4.0),
            beam("hand", 2.0),
            beam("tip", 1.0),
        ],
        joints: vec![
            lift.within([0.0, 1.0]).with_motor(120.0, 0.1),
            elbow.at(Vector3::new(0.5, 0.0, 0.0)).within([-1.0, 1.5]).with_motor(8.0, 0.01),
            wrist.at(Vector3::new(0.5, 0.0, 0.0)).within([-0.5, 0.5]).with_motor(6.0, 0.01),
        ],
        ..RobotDescription::default()
    }
}

#[test]
fn limits_and_efforts_are_held_in_every_step() {
    let mut stage = Stage::new();
    let id = add(&mut stage, Point3::new(0.0, 0.0, 2.0), RobotConfig::from(crane()));
    let ends = [[0.0, 1.0], [-1.0, 1.5], [-0.5, 0.5]];
    let efforts = [120.0, 8.0, 6.0];
    let (mut reached, mut past) = ([[false; 2]; 3], 0.0_f64);
    for step in 0..400 {
        // Full torque one way, then the other, at another pace for each joint.
        let body: &mut Robot = stage.physics.body_as_mut(id).unwrap();
        for joint in 0..3 {
            let way = if (step / (30 + 10 * joint)) % 2 == 0 { 1e6 } else { -1e6 };
            let command = JointCommand { angle: way, stiffness: 1e6, ..JointCommand::default() };
            body.command(joint, command).unwrap();
        }
        stage.tick(0.02);
        for (joint, reading) in robot(&stage, id).readings().enumerate() {
            let [low, high] = ends[joint];
            past = past.max(reading.angle - high).max(low - reading.angle);
            assert!(reading.torque.abs() <= efforts[joint], "joint {joint}: {reading:?}");
            reached[joint][0] |= reading.angle < low + 0.01;
            reached[joint][1] |= reading.angle > high - 0.01;
        }
    }
    println!("past the limits by at most {past:.5}");
    assert!(past < 1e-3, "{past}");
    assert_eq!(reached, [[true; 2]; 3]);
}

#[test]
fn what_is_carried_is_carried_and_targets_are_reached() {
    let mut stage = Stage::new();
    let config = RobotConfig { weight: Weight::Carried, ..RobotConfig::from(crane()) };
    let id = add(&mut stage, Point3::new(0.0, 0.0, 2.0), config);
    stage.tick(0.1);
    let load = robot(&stage, id).load(0).unwrap();
    assert!((load - 7.0 * G).abs() < 1e-3, "the lift carries {load} N");
    let targets = [0.6, -0.7, 0.3];
    for _ in 0..60 {
        let body: &mut Robot = stage.physics.body_as_mut(id).unwrap();
        for (joint, target) in targets.into_iter().enumerate() {
            body.command(joint, body.servo(joint, target, 2.0)).unwrap();
        }
        stage.tick(0.1);
    }
    for (joint, target) in targets.into_iter().enumerate() {
        let is = angle(&stage, id, joint);
        assert!((is - target).abs() < 2e-3, "joint {joint} is at {is}, not {target}");
    }
    // By hand: half a metre ahead, then half a metre turned by -0.7, with the tip 0.3 up.
    let tip = robot(&stage, id).link_pose("tip").unwrap().translation.vector;
    let elbow = Vector3::new(0.5 + 0.5 * ops::cos(0.7), -0.5 * ops::sin(0.7), 2.6);
    assert!((tip - elbow).norm() < 5e-3, "{tip}");
}

#[test]
fn absurd_gains_are_taken_as_far_as_the_joints_bear_them() {
    let mut description = crane();
    for joint in &mut description.joints {
        joint.effort = None;
    }
    let mut stage = Stage::new();
    let id = add(&mut stage, Point3::new(0.0, 0.0, 2.0), RobotConfig::from(description));
    let targets = [0.6, -0.7, 0.3];
    let mut fastest: f64 = 0.0;
    for _ in 0..200 {
        let body: &mut Robot = stage.physics.body_as_mut(id).unwrap();
        for (joint, angle) in targets.into_iter().enumerate() {
            let command = JointCommand { angle, stiffness: 1e9, damping: 1e9, ..JointCommand::default() };
            body.command(joint, command).unwrap();
        }
        stage.tick(0.02);
        fastest = robot(&stage, id).readings().map(|joint| joint.speed.abs()).fold(fastest, f64::max);
    }
    for (joint, target) in targets.into_iter().enumerate() {
        let reading = robot(&stage, id).reading(joint).unwrap();
        assert!((reading.angle - target).abs() < 1e-2 && reading.speed.abs() < 1e-3, "{joint}: {reading:?}");
    }
    println!("{fastest:.1} at most");
}

#[test]
fn sliding_joints_fall_as_anything_does_and_springs_swing_by_their_formula() {
    let bob = LinkDescription::new("bob").with_mass(2.0, Vector3::zeros(), [0.01; 3]);
    let slide = JointDescription::new("slide", JointKind::Prismatic, ["stand", "bob"]).about(Vector3::z());
    let make = |spring| RobotDescription {
        name: "drop".to_owned(),
        base: Base::Fixed,
        links: vec![LinkDescription::new("stand"), bob.clone()],
        joints: vec![JointDescription { spring, ..slide.clone() }],
        ..RobotDescription::default()
    };
    let mut stage = Stage::new();
    let free = add(&mut stage, Point3::new(0.0, 0.0, 20.0), starting_at(make([0.0; 2]), &[]));
    let sprung = add(&mut stage, Point3::new(3.0, 0.0, 20.0), starting_at(make([200.0, 0.0]), &[]));
    stage.tick(1.0);
    assert!((angle(&stage, free, 0) + 0.5 * G).abs() < 0.01, "{}", angle(&stage, free, 0));
    // z = -m g / k (1 - cos(w t)), w = sqrt(k / m) = 10 rad/s; an implicit spring loses some of its swing.
    let formula = -2.0 * G / 200.0 * (1.0 - ops::cos(10.0));
    assert!((angle(&stage, sprung, 0) - formula).abs() < 5e-3, "{} {formula}", angle(&stage, sprung, 0));
}

#[test]
fn dry_friction_holds_up_to_its_torque() {
    let still = |friction| {
        let mut description = chain(1);
        description.joints[0].friction = friction;
        let mut stage = Stage::new();
        let config = starting_at(description, &[("hinge 0", 0.5 * PI)]);
        let id = add(&mut stage, Point3::new(0.0, 0.0, 5.0), config);
        stage.tick(0.5);
        (angle(&stage, id, 0) - 0.5 * PI).abs() < 1e-3
    };
    assert!(still(1.05 * G) && !still(0.95 * G));
}

#[test]
fn a_free_robot_falls_keeps_its_momentum_and_comes_to_rest_on_its_lowest_point() {
    let mut description = crane();
    description.base = Base::Free;
    let mut stage = Stage::new();
    let pose = Pose::from_parts(
        Vector3::new(0.0, 0.0, 30.0).into(),
        UnitQuaternion::from_euler_angles(0.3, 0.4, 0.5),
    );
    let mut desc = EntityDesc::new(EntityKind::Robot, pose, Shape::cuboid(0.5, 0.5, 0.5));
    desc.twist.linear = Vector3::new(1.0, 0.0, 0.0);
    desc.twist.angular = Vector3::new(0.0, 0.5, 1.0);
    let id = stage.world.spawn(desc).unwrap();
    let config = RobotConfig { height: Some(0.0), substep: 1e-3, ..RobotConfig::from(description) };
    stage.physics.add_robot(&stage.world, id, config).unwrap();
    let before = stage.physics.momentum(id).unwrap();
    stage.tick(1.0);
    let gained = stage.physics.momentum(id).unwrap() - before;
    let mass = 7.0 + 1e-6;
    assert!((gained + Vector3::z() * (mass * G)).norm() < 0.02 * mass * G, "{gained}");
    for _ in 0..80 {
        stage.tick(0.1);
    }
    let entity = stage.world.entity(id).unwrap();
    assert!(entity.twist.linear.norm() < 0.05 && entity.position().z.abs() < 0.2, "{:?}", entity.pose);
}

#[test]
fn mass_and_inertia_in_the_engine_are_those_of_the_description() {
    // Two links on a fixed joint are one part: by Steiner's rule about the common centre.
    let lower = LinkDescription::new("lower").with_mass(1.0, Vector3::zeros(), [0.1, 0.2, 0.3]);
    let upper = LinkDescription::new("upper").with_mass(3.0, Vector3::zeros(), [0.1, 0.1, 0.1]);
    let weld =
        JointDescription::new("weld", JointKind::Fixed, ["lower", "upper"]).at(Vector3::new(0.0, 0.0, 0.4));
    let hinge = JointDescription::new("hinge", JointKind::Continuous, ["stand", "lower"]).about(Vector3::x());
    let description = RobotDescription {
        name: "two".to_owned(),
        base: Base::Fixed,
        links: vec![LinkDescription::new("stand"), lower, upper],
        joints: vec![weld, hinge],
        ..RobotDescription::default()
    };
    assert_eq!(description.mass(), 4.0);
    let mut stage = Stage::new();
    let id = add(&mut stage, Point3::new(0.0, 0.0, 5.0), RobotConfig::from(description));
    stage.tick(0.01);
    // About x through the hinge: 0.1 + 0.1 + 3 * 0.4².
    let inertia = robot(&stage, id).inertia(0).unwrap();
    assert!((inertia - 0.68).abs() < 1e-9, "{inertia}");
}

#[test]
fn the_robot_dog_is_a_robot_too() {
    let model = QuadrupedModel::default();
    let description = model.description();
    description.validate().unwrap();
    assert!((description.mass() - model.mass()).abs() < 1e-9);
    let mut stage = Stage::new();
    let stand: Vec<(String, f64)> = description
        .joints
        .iter()
        .map(|joint| {
            let part = joint.name.rsplit(' ').next().unwrap();
            (
                joint.name.clone(),
                match part {
                    "thigh" => 0.9,
                    "knee" => -1.8,
                    _ => 0.0,
                },
            )
        })
        .collect();
    let config =
        RobotConfig { positions: stand.clone().into_iter().collect(), ..RobotConfig::from(description) };
    let id = add(&mut stage, Point3::origin(), config);
    for _ in 0..30 {
        let body: &mut Robot = stage.physics.body_as_mut(id).unwrap();
        for (name, angle) in &stand {
            let joint = body.joint(name).unwrap();
            let command =
                JointCommand { angle: *angle, stiffness: 80.0, damping: 2.0, ..JointCommand::default() };
            body.command(joint, command).unwrap();
        }
        stage.tick(0.1);
    }
    let entity = stage.world.entity(id).unwrap();
    let up = (entity.pose.rotation * Vector3::z()).z;
    assert!(up > 0.99 && entity.position().z.abs() < 0.06, "{:?}", entity.pose);
}

/// A robot that swings, is commanded, saved and restored.
#[test]
fn the_same_bits_over_runs_and_over_snapshot_and_restore() {
    let make = || {
        let mut stage = Stage::new();
        let mut description = crane();
        description.base = Base::Free;
        let id = add(&mut stage, Point3::new(0.0, 0.0, 0.5), RobotConfig::from(description));
        let body: &mut Robot = stage.physics.body_as_mut(id).unwrap();
        let command = JointCommand { speed: 1.0, damping: 3.0, ..JointCommand::default() };
        body.command(1, command).unwrap();
        (stage, id)
    };
    let (mut one, id) = make();
    let (mut two, _) = make();
    for _ in 0..10 {
        one.tick(0.1);
        two.tick(0.1);
    }
    let (saved, world) = (one.physics.save().unwrap(), one.world.clone());
    assert_eq!(saved, two.physics.save().unwrap());
    for _ in 0..10 {
        one.tick(0.1);
    }
    let (mut other, _) = make();
    other.world = world;
    other.physics.restore(&other.world, &saved).unwrap();
    for _ in 0..10 {
        other.tick(0.1);
    }
    assert_eq!(one.physics.save().unwrap(), other.physics.save().unwrap());
    assert_eq!(robot(&one, id).save(), robot(&other, id).save());
}

#[test]
fn a_robot_that_is_put_elsewhere_goes_on_there_with_its_joints() {
    let mut stage = Stage::new();
    let config = starting_at(chain(2), &[("hinge 0", 1.0), ("hinge 1", -0.4)]);
    let id = add(&mut stage, Point3::new(0.0, 0.0, 5.0), config);
    stage.tick(0.2);
    let (one, two) = (angle(&stage, id, 0), angle(&stage, id, 1));
    let there = pose_facing(Point3::new(10.0, 2.0, 5.0), 1.0);
    stage.world.set_motion(id, there, Twist::ZERO).unwrap();
    stage.tick(0.002);
    assert!((angle(&stage, id, 0) - one).abs() < 1e-3 && (angle(&stage, id, 1) - two).abs() < 1e-3);
    let stand = robot(&stage, id).link_pose("stand").unwrap().translation.vector;
    assert!((stand - Vector3::new(10.0, 2.0, 5.0)).norm() < 1e-9);
    stage.tick(0.3);
    assert!((angle(&stage, id, 0) - one).abs() > 0.05);
}
