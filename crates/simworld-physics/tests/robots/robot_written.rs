//! Robots written as MJCF are the same robots when they are read again.
#![cfg(all(feature = "mjcf", feature = "urdf"))]
#![allow(clippy::unwrap_used)]

use super::robot_files::{LEG_MJCF, error_of, read_mjcf};
use simworld_core::asset::Material;
use simworld_core::geometry::{Point3, Pose, Vector3, pose_facing};
use simworld_physics::robot::{
    Base, Form, JointDescription, JointKind, Kinds, LinkDescription, LinkSolid, mjcf,
};
use simworld_physics::{QuadrupedModel, RobotDescription};

/// That two robots are the same but for rounding.
fn same(one: &RobotDescription, other: &RobotDescription) {
    assert_eq!((&one.name, one.base), (&other.name, other.base));
    assert_eq!((one.links.len(), one.joints.len()), (other.links.len(), other.joints.len()));
    for (a, b) in one.links.iter().zip(&other.links) {
        assert_eq!((&a.name, a.mass, a.solids.len()), (&b.name, b.mass, b.solids.len()));
        assert!(
            (a.center - b.center).norm() < 1e-12 && (a.inertia - b.inertia).norm() < 1e-15,
            "{a:?} {b:?}"
        );
        for (a, b) in a.solids.iter().zip(&b.solids) {
            let seen = |solid: &LinkSolid| (solid.material.friction(), solid.kinds, solid.color);
            assert_eq!((&a.form, seen(a)), (&b.form, seen(b)));
            assert!((a.link_from_solid.to_homogeneous() - b.link_from_solid.to_homogeneous()).norm() < 1e-12);
        }
    }
    for (a, b) in one.joints.iter().zip(&other.joints) {
        let apart = a.parent_from_joint.to_homogeneous() - b.parent_from_joint.to_homogeneous();
        assert!(apart.norm() < 1e-12, "{a:?} {b:?}");
        let (parent_from_joint, meets) = (a.parent_from_joint, a.meets);
        assert_eq!(*a, JointDescription { parent_from_joint, meets, ..b.clone() });
    }
    same_pairs(one, other);
}

/// That what joints hold together passes through one another in both, or in none, and so do those that are named.
fn same_pairs(one: &RobotDescription, other: &RobotDescription) {
    let has_solids = |name: &str| one.links.iter().any(|link| link.name == name && !link.solids.is_empty());
    let named = |robot: &RobotDescription, pair: [&str; 2]| {
        robot.apart.iter().any(|[a, b]| [a.as_str(), b] == pair || [b.as_str(), a] == pair)
    };
    for (a, b) in one.joints.iter().zip(&other.joints) {
        let pair = [a.parent.as_str(), a.child.as_str()];
        if pair.iter().all(|name| has_solids(name)) {
            let [a, b] = [(one, a), (other, b)].map(|(robot, joint)| !joint.meets || named(robot, pair));
            assert_eq!(a, b, "{pair:?}");
        }
    }
    for [a, b] in one.apart.iter().filter(|pair| pair.iter().all(|name| has_solids(name))) {
        assert!(named(other, [a, b]), "{a} and {b}");
    }
}

fn written_and_read(description: &RobotDescription) -> RobotDescription {
    let text = mjcf::to_string(description).unwrap();
    let read = read_mjcf(&text).unwrap();
    assert_eq!(read.report, [], "{text}");
    read.description
}

/// The robot dog as other engines get it: masses, inertias, forms, limits, torques, armature, friction of the feet.
#[test]
fn the_robot_dog_written_to_a_file_is_the_robot_dog() {
    let mut model = QuadrupedModel::default();
    same(&model.description(), &written_and_read(&model.description()));
    (model.trunk_mass, model.torques, model.limits[2]) = (9.25, [20.0, 0.0, 31.5], [-2.5, -0.5]);
    let read = written_and_read(&model.description());
    same(&model.description(), &read);
    assert_eq!(read.joints.len(), 12);
    assert!((read.mass() - model.mass()).abs() < 1e-12);
    assert_eq!(read.joints[4].effort, Some(0.0), "a thigh without a motor");
}

#[test]
fn robots_of_all_kinds_of_parts_come_back_from_their_files() {
    let mut robot = read_mjcf(LEG_MJCF).unwrap().description;
    robot.name = "a <leg> & a \"foot\"\n".to_owned();
    robot.joints[0].spring = [3.0, 0.2];
    robot.joints[1].effort = None;
    let corners = [[0.1, 0.0, 0.0], [-0.1, 0.1, 0.0], [0.0, -0.2, 0.0], [0.0, 0.0, 0.3]];
    let lid = LinkDescription::new("lid")
        .with_mass(0.2, Vector3::new(0.01, 0.0, 0.0), [1e-3, 2e-3, 2.5e-3])
        .with_solid(
            Form::Convex { points: corners.map(Vector3::from).to_vec() },
            pose_facing(Point3::new(0.0, 0.1, 0.2), 1.1),
            Material::Wood,
        )
        .with_solid(Form::Cylinder { radius: 0.02, length: 0.3 }, Pose::identity(), Material::Ice);
    robot.links.push(lid);
    let fixed = JointDescription::new("lid (fixed)", JointKind::Fixed, ["foot", "lid"]);
    robot.joints.push(fixed.at(Vector3::new(0.0, 0.0, 0.05)));
    let wheel = LinkDescription::new("wheel").with_mass(0.5, Vector3::zeros(), [1e-3; 3]);
    robot.links.push(wheel);
    let axle = JointDescription::new("axle", JointKind::Continuous, ["trunk", "wheel"]);
    robot.joints.push(axle.about(Vector3::y()).with_motor(2.5, 0.001));
    robot.links[0].solids[0].kinds = Kinds { own: 2, met: 5 };
    robot.apart.push(["foot".to_owned(), "trunk".to_owned()]);
    assert_eq!(robot.part_at_rest().unwrap().len(), 1, "the lid stands in the trunk");
    same(&robot, &written_and_read(&robot));

    robot.base = Base::Fixed;
    let held = written_and_read(&robot);
    assert_eq!((held.base, held.links[0].name.as_str(), held.mass()), (Base::Fixed, "world", robot.mass()));
    same(&held, &written_and_read(&held));

    robot.apart.clear();
    let mut taken = robot.clone();
    taken.links[3].name = "world".to_owned();
    taken.joints[2].child = "world".to_owned();
    let refusal = mjcf::to_string(&taken).unwrap_err().to_string();
    assert!(refusal.contains("world") && refusal.contains("rename"), "{refusal}");

    robot.links[0].name = "trunk\u{1}".to_owned();
    assert!(mjcf::to_string(&robot).is_err(), "no link is called so any more");
    for joint in &mut robot.joints {
        joint.parent = joint.parent.replace("trunk", "trunk\u{1}");
    }
    let refusal = mjcf::to_string(&robot).unwrap_err().to_string();
    assert!(refusal.contains("XML") && refusal.contains("rename"), "{refusal}");
}

/// What has mass but no inertia is a ball of water here; other engines are told its inertia.
#[test]
fn a_link_without_inertia_is_written_with_that_of_a_ball() {
    let bob = LinkDescription::new("bob").with_mass(1000.0, Vector3::zeros(), [0.0; 3]);
    let robot = RobotDescription { links: vec![bob], ..RobotDescription::default() };
    let read = written_and_read(&robot);
    // A ball of a cubic metre: radius 0.6204 m.
    assert!((read.links[0].inertia[(1, 1)] - 153.9).abs() < 0.1, "{}", read.links[0].inertia);
}

#[test]
fn meshes_whose_corners_stand_in_the_file_are_their_hulls() {
    let with = |attributes: &str| {
        read_mjcf(&format!(
            "<mujoco><asset><mesh name='m' {attributes}/></asset><worldbody><body name='b'><freejoint/>\
             <inertial pos='0 0 0' mass='1' diaginertia='1 1 1'/><geom type='mesh' mesh='m'/></body></worldbody></mujoco>"
        ))
    };
    let read = with("vertex='0 0 0 1 0 0 0 1 0 0 0 1' scale='2 1 1'").unwrap();
    let Form::Convex { points } = &read.description.links[0].solids[0].form else { panic!("{read:?}") };
    assert_eq!(points[1], Vector3::new(2.0, 0.0, 0.0));
    let flat = with("vertex='0 0 0 1 0 0 0 1 0 1 1 0'").unwrap();
    assert!(flat.description.links[0].solids.is_empty() && flat.report[0].what.contains("flat"), "{flat:?}");
    let corner = |at: usize| format!("{} {} {}", at % 10, at / 10 % 10, at / 100);
    let many = (0..900).map(corner).collect::<Vec<_>>().join(" ");
    let read = with(&format!("vertex='{many}'")).unwrap();
    let Form::Convex { points } = &read.description.links[0].solids[0].form else { panic!("{read:?}") };
    assert!((8..=256).contains(&points.len()), "{}", points.len());
    for (wrong, word) in [("0 0 0 1", "three numbers"), ("0 0 1e300 1 0 0", "1e4"), ("0 0 x", "numbers")] {
        assert!(error_of(with(&format!("vertex='{wrong}'")), wrong).contains(word), "{wrong}");
    }
}
