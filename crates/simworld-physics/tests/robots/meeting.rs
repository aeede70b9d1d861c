//! Links of one robot meet one another, as far as its description says.
#![allow(clippy::unwrap_used)]

use std::f64::consts::PI;

use crate::common::Stage;
use simworld_core::geometry::{Point3, Pose, Vector3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::ops;
use simworld_core::scene::{EntityKind, Shape};
use simworld_core::seam::{Dynamics, Embodiment};
use simworld_physics::robot::{
    Base, Form, JointDescription, JointKind, Kinds, LinkDescription, RobotDescription,
};
use simworld_physics::{JointCommand, Material, Robot, RobotConfig};

fn add(stage: &mut Stage, config: RobotConfig) -> EntityId {
    let pose = pose_facing(Point3::new(0.0, 0.0, 2.0), 0.0);
    let id = stage.spawn(EntityKind::Robot, pose, Shape::cuboid(0.5, 0.5, 0.5));
    stage.physics.add_robot(&stage.world, id, config).unwrap();
    id
}

fn robot(stage: &Stage, id: EntityId) -> &Robot {
    stage.physics.body_as(id).unwrap()
}

fn angle(stage: &Stage, id: EntityId, joint: usize) -> f64 {
    robot(stage, id).reading(joint).unwrap().angle
}

/// A post, an arm before it and a hand that folds back: by hand it stops at an edge of the post.
fn folding() -> RobotDescription {
    let beam = |name: &str| {
        LinkDescription::new(name)
            .with_mass(1.0, Vector3::new(0.25, 0.0, 0.0), [0.002, 0.02, 0.02])
            .with_solid(
                Form::Box { size: Vector3::new(0.4, 0.04, 0.04) },
                Pose::translation(0.25, 0.0, 0.0),
                Material::Metal,
            )
    };
    let post = LinkDescription::new("post").with_solid(
        Form::Box { size: Vector3::new(0.2, 0.2, 0.5) },
        Pose::identity(),
        Material::Metal,
    );
    let shoulder =
        JointDescription::new("shoulder", JointKind::Revolute, ["post", "arm"]).about(Vector3::z());
    let elbow = JointDescription::new("elbow", JointKind::Revolute, ["arm", "hand"]).about(Vector3::z());
    RobotDescription {
        name: "folding".to_owned(),
        base: Base::Fixed,
        links: vec![post, beam("arm"), beam("hand")],
        joints: vec![
            shoulder.within([-1.0, 1.0]).with_motor(500.0, 0.01),
            elbow.at(Vector3::new(0.5, 0.0, 0.0)).within([-3.1, 3.1]).with_motor(5.0, 0.01),
        ],
        ..RobotDescription::default()
    }
}

/// The angle at which the elbow comes to rest that is folded with all of its torque, after checking how it got there.
fn fold(description: RobotDescription) -> (f64, Stage, EntityId) {
    let mut stage = Stage::new();
    let id = add(&mut stage, RobotConfig::from(description));
    stage.tick(0.01);
    for _ in 0..150 {
        let body: &mut Robot = stage.physics.body_as_mut(id).unwrap();
        body.command(0, body.servo(0, 0.0, 8.0)).unwrap();
        body.command(1, JointCommand { torque: 2.0, damping: 0.5, ..JointCommand::default() }).unwrap();
        stage.tick(0.02);
    }
    (angle(&stage, id, 1), stage, id)
}

/// Where the hand meets the edge of the post: its side is 2 cm from its axis, and the edge 41 cm from the elbow.
fn folded() -> f64 {
    let reach = ops::hypot(0.4, 0.1);
    PI - ops::atan2(0.1, 0.4) - ops::asin(0.02 / reach)
}

#[test]
fn an_arm_that_is_folded_stops_at_its_own_base() {
    let (stopped, ..) = fold(folding());
    println!("the elbow stops at {stopped:.4} rad, by hand at {:.4}", folded());
    assert!((stopped - folded()).abs() < 0.01, "{stopped}, not {}", folded());
    // Links that are set apart, and kinds that do not meet, pass through one another.
    let apart = RobotDescription { apart: vec![["hand".to_owned(), "post".to_owned()]], ..folding() };
    assert!(fold(apart).0 > 3.09);
    let mut unlike = folding();
    for link in &mut unlike.links {
        link.solids[0].kinds = Kinds { own: 1, met: 0 };
    }
    assert!(fold(unlike).0 > 3.09);
    // The links on one joint meet where the joint says so: the arm is put out of the post, and the hand stops all the same.
    let mut meeting = folding();
    meeting.joints[0].meets = true;
    meeting.joints[0].parent_from_joint = Pose::translation(0.2, 0.0, 0.0);
    meeting.joints[0].limits = Some([-3.0, 3.0]);
    let mut stage = Stage::new();
    let id = add(&mut stage, RobotConfig::from(meeting));
    for _ in 0..100 {
        let body: &mut Robot = stage.physics.body_as_mut(id).unwrap();
        body.command(0, JointCommand { torque: 3.0, damping: 1.0, ..JointCommand::default() }).unwrap();
        stage.tick(0.02);
    }
    let stopped = angle(&stage, id, 0);
    assert!(stopped > 1.5 && stopped < 2.9, "{stopped}");
}

#[test]
fn what_presses_on_itself_goes_on_to_the_bit_after_saving() {
    // With a pair that is set apart, so that the engine has to ask.
    let mut description = folding();
    description.links.push(
        LinkDescription::new("flag").with_mass(0.1, Vector3::zeros(), [1e-4; 3]).with_solid(
            Form::Sphere { radius: 0.05 },
            Pose::identity(),
            Material::Plastic,
        ),
    );
    let mast = JointDescription::new("mast", JointKind::Continuous, ["hand", "flag"]).about(Vector3::x());
    description.joints.push(mast.at(Vector3::new(0.5, 0.0, 0.0)));
    description.apart = vec![["flag".to_owned(), "post".to_owned()]];
    let (stopped, mut one, id) = fold(description.clone());
    assert!((stopped - folded()).abs() < 0.01, "{stopped}");
    let saved = one.physics.save().unwrap();
    let mut other = Stage::new();
    add(&mut other, RobotConfig::from(description));
    other.world = one.world.clone();
    other.physics.restore(&other.world, &saved).unwrap();
    for _ in 0..20 {
        one.tick(0.02);
        other.tick(0.02);
    }
    assert_eq!(one.physics.save().unwrap(), other.physics.save().unwrap());
    assert_eq!(robot(&one, id).save(), robot(&other, id).save());
}

#[test]
fn links_that_overlap_at_rest_are_found_and_those_that_meet_through_a_bare_link_are_not() {
    let mut description = folding();
    assert_eq!(description.part_at_rest().unwrap(), Vec::<[String; 2]>::new());
    description.joints[1].parent_from_joint = Pose::translation(-0.1, 0.0, 0.0);
    let found = description.part_at_rest().unwrap();
    assert_eq!(found, [["post".to_owned(), "hand".to_owned()]]);
    assert_eq!(description.apart, found);
    assert_eq!(description.part_at_rest().unwrap(), Vec::<[String; 2]>::new(), "once");
    // Without a solid the arm is nothing but a joint, and the hand hangs on the post.
    let mut bare = folding();
    bare.links[1].solids.clear();
    assert!(fold(bare).0 > 3.09);
    let wrong = RobotDescription { apart: vec![["hand".to_owned(), "foot".to_owned()]], ..folding() };
    assert!(wrong.validate().unwrap_err().to_string().contains("\"foot\""));
}
