//! Robots from files are the robots that the files describe; files that describe none are refused by name and place.
#![cfg(all(feature = "mjcf", feature = "urdf"))]
#![allow(clippy::unwrap_used)]

use std::fs;

use crate::common::Stage;
use simworld_core::geometry::{Point3, Vector3, pose_facing};
use simworld_core::id::EntityId;
use simworld_core::scene::{EntityKind, Scene, Shape};
use simworld_physics::robot::{Base, Form, ImportLimits, ImportOptions, Imported, JointKind, mjcf, urdf};
use simworld_physics::{JointCommand, Robot, RobotConfig, RobotDescription, RobotError};

/// A trunk with a leg that turns and a foot that slides, by URDF.
pub(super) const LEG_URDF: &str = r#"<?xml version="1.0"?>
<robot name="leg">
  <link name="trunk">
    <inertial><origin xyz="0.02 0 0.01"/><mass value="5"/>
      <inertia ixx="0.05" ixy="0" ixz="0.001" iyy="0.06" iyz="0" izz="0.07"/></inertial>
    <collision><geometry><box size="0.4 0.2 0.1"/></geometry></collision>
  </link>
  <link name="thigh">
    <inertial><origin xyz="0 0 -0.1"/><mass value="1.5"/>
      <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.011" iyz="0" izz="0.002"/></inertial>
    <collision><origin xyz="0 0 -0.1"/><geometry><capsule radius="0.03" length="0.2"/></geometry></collision>
  </link>
  <link name="foot">
    <inertial><mass value="0.5"/><inertia ixx="0.001" ixy="0" ixz="0" iyy="0.001" iyz="0" izz="0.001"/></inertial>
    <collision><geometry><sphere radius="0.04"/></geometry></collision>
  </link>
  <joint name="hip" type="revolute">
    <origin xyz="0.1 0.05 -0.05" rpy="0.2 0 0"/><parent link="trunk"/><child link="thigh"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="0.8" effort="20" velocity="15"/><dynamics damping="0.1" friction="0.05"/>
  </joint>
  <joint name="shin" type="prismatic">
    <origin xyz="0 0 -0.25"/><parent link="thigh"/><child link="foot"/><axis xyz="0 0 1"/>
    <limit lower="-0.05" upper="0.1" effort="100" velocity="2"/><dynamics damping="5"/>
  </joint>
</robot>"#;

/// The same by MJCF, with the frame of the foot's body elsewhere than its joint.
pub(super) const LEG_MJCF: &str = r#"<mujoco model="leg">
  <compiler angle="radian"/>
  <default>
    <geom friction="0.4"/>
    <default class="leg"><joint damping="0.1" frictionloss="0.05"/></default>
  </default>
  <worldbody>
    <body name="trunk" childclass="leg">
      <freejoint/>
      <inertial pos="0.02 0 0.01" mass="5" fullinertia="0.05 0.06 0.07 0 0.001 0"/>
      <geom type="box" size="0.2 0.1 0.05"/>
      <body name="thigh" pos="0.1 0.05 -0.05" euler="0.2 0 0">
        <joint name="hip" axis="0 1 0" range="-1 0.8"/>
        <inertial pos="0 0 -0.1" mass="1.5" diaginertia="0.01 0.011 0.002"/>
        <geom type="capsule" fromto="0 0 0 0 0 -0.2" size="0.03"/>
        <body name="foot" pos="0 0 -0.3">
          <joint name="shin" type="slide" pos="0 0 0.05" axis="0 0 1" range="-0.05 0.1" damping="5" frictionloss="0"/>
          <inertial pos="0 0 0.05" mass="0.5" diaginertia="0.001 0.001 0.001"/>
          <geom size="0.04" pos="0 0 0.05"/>
        </body>
      </body>
    </body>
  </worldbody>
  <actuator>
    <motor joint="hip" forcerange="-10 10" gear="2"/>
    <position joint="shin" kp="500" kv="20" forcerange="-100 100"/>
  </actuator>
</mujoco>"#;

pub(super) fn read_urdf(text: &str) -> Result<Imported, RobotError> {
    urdf::from_str(text, &ImportOptions::default())
}

pub(super) fn read_mjcf(text: &str) -> Result<Imported, RobotError> {
    mjcf::from_str(text, &ImportOptions::default())
}

fn put(stage: &mut Stage, description: RobotDescription) -> EntityId {
    let pose = pose_facing(Point3::new(0.0, 0.0, 6.0), 0.4);
    let id = stage.spawn(EntityKind::Robot, pose, Shape::cuboid(0.4, 0.2, 0.4));
    stage.physics.add_robot(&stage.world, id, RobotConfig::from(description)).unwrap();
    id
}

#[test]
fn the_numbers_of_a_urdf_are_those_of_the_robot() {
    let read = read_urdf(LEG_URDF).unwrap();
    assert_eq!(read.report, []);
    let description = read.description;
    assert_eq!((description.mass(), description.base), (7.0, Base::Free));
    let hip = &description.joints[0];
    assert_eq!((hip.kind, hip.limits, hip.effort), (JointKind::Revolute, Some([-1.0, 0.8]), Some(20.0)));
    assert_eq!((hip.velocity, hip.damping, hip.friction), (Some(15.0), 0.1, 0.05));
    assert_eq!(description.links[0].inertia[(0, 2)], 0.001);
    assert_eq!(description.links[1].solids[0].form, Form::Capsule { radius: 0.03, length: 0.2 });
}

#[test]
fn the_same_robot_by_urdf_and_by_mjcf_falls_the_same_way() {
    let (one, other) = (read_urdf(LEG_URDF).unwrap(), read_mjcf(LEG_MJCF).unwrap());
    assert_eq!(other.gains["shin"], [500.0, 20.0]);
    assert_eq!(other.description.joints[0].effort, Some(20.0));
    let mut stages: Vec<Stage> = (0..2).map(|_| Stage::new()).collect();
    let ids = [put(&mut stages[0], one.description), put(&mut stages[1], other.description)];
    for step in 0..100 {
        let seen = [0, 1].map(|which| {
            let stage = &mut stages[which];
            stage.tick(0.01);
            let body: &Robot = stage.physics.body_as(ids[which]).unwrap();
            let joints: Vec<f64> = body.readings().map(|joint| joint.angle).collect();
            (*stage.world.entity(ids[which]).unwrap().pose, joints)
        });
        let away = (seen[0].0.translation.vector - seen[1].0.translation.vector).norm();
        let apart = seen[0].1.iter().zip(&seen[1].1).map(|(a, b)| (a - b).abs()).fold(away, f64::max);
        assert!(apart < 1e-7, "step {step}: {apart}, {seen:?}");
    }
}

#[test]
fn a_free_fall_of_a_file_is_a_free_fall() {
    let mut stage = Stage::new();
    let id = put(&mut stage, read_urdf(LEG_URDF).unwrap().description);
    let before = stage.physics.momentum(id).unwrap();
    stage.tick(0.5);
    let gained = stage.physics.momentum(id).unwrap() - before;
    // A new articulation feels gravity from its second substep of 2 ms on.
    assert!((gained + Vector3::z() * (7.0 * 9.81 * 0.498)).norm() < 1e-9, "{gained}");
}

pub(super) fn error_of(read: Result<Imported, RobotError>, of: &str) -> String {
    match read {
        Ok(_) => panic!("{of} is no robot, and was read"),
        Err(error) => error.to_string(),
    }
}

#[test]
fn files_that_are_no_urdf_are_refused_by_name_and_place() {
    let one = "<link name='a'/>";
    let joint = |inner: &str| {
        format!("<robot>{one}<link name='b'/><joint name='j' type='fixed'>{inner}</joint></robot>")
    };
    let ends = "<parent link='a'/><child link='b'/>";
    let inertial = |mass: &str, inertia: &str| {
        format!(
            "<robot><link name='a'><inertial><mass value='{mass}'/><inertia {inertia}/></inertial></link></robot>"
        )
    };
    let geometry = |form: &str| {
        format!("<robot><link name='a'>\n<collision><geometry>{form}</geometry></collision></link></robot>")
    };
    let moving = |kind: &str, rest: &str| {
        format!("<robot>{one}<link name='b'/><joint name='j' type='{kind}'>{ends}{rest}</joint></robot>")
    };
    let unit = "ixx='1' iyy='1' izz='1'";
    let limit = "<limit lower='0' upper='1' effort='1' velocity='1'/>";
    let cases: Vec<(String, &[&str])> = vec![
        (String::new(), &["no XML"]),
        ("<robot>".to_owned(), &["no XML"]),
        ("<mujoco/>".to_owned(), &["<mujoco>", "<robot>"]),
        ("<robot/>".to_owned(), &["0 links hang on nothing"]),
        (format!("<robot>{one}{one}</robot>"), &["two links", "\"a\"", "rename"]),
        (format!("<robot>{one}<link name='b'/></robot>"), &["2 links hang on nothing", "a, b"]),
        ("<robot><link/></robot>".to_owned(), &["line 1:8", "name is missing"]),
        (joint("<parent link='a'/>"), &["<child> is missing", "\"j\""]),
        (joint("<parent link='a'/><child link='c'/>"), &["\"c\"", "not there"]),
        (joint(&format!("{ends}<origin xyz='0 0'/>")), &["xyz", "three numbers"]),
        (joint(&format!("{ends}<origin xyz='0 0 nan'/>")), &["xyz", "finite"]),
        (joint(&format!("{ends}<origin xyz='0 x 0 0'/>")), &["xyz", "numbers"]),
        (joint(&format!("{ends}<origin xyz='0 0 1e9'/>")), &["joint \"j\"", "place", "1e4"]),
        (moving("screw", limit), &["screw", "revolute"]),
        (moving("floating", ""), &["floating", "revolute"]),
        (moving("revolute", ""), &["<limit>", "continuous"]),
        (
            moving("revolute", "<limit lower='1' upper='0' effort='1' velocity='1'/>"),
            &["limits = 0", "joint \"j\""],
        ),
        (moving("revolute", "<limit effort='-1' velocity='1'/>"), &["effort = -1"]),
        (moving("continuous", "<axis xyz='0 0 0'/>"), &["axis", "direction"]),
        (moving("continuous", "<dynamics damping='-1'/>"), &["damping = -1"]),
        (inertial("-1", unit), &["mass = -1", "link \"a\""]),
        (inertial("nan", unit), &["finite"]),
        (inertial("1e300", unit), &["mass", "1e7"]),
        (inertial("1", "ixx='-1' iyy='1' izz='1'"), &["inertia", "positive definite"]),
        (inertial("1", "ixx='1' iyy='1' izz='1' ixy='2'"), &["inertia", "positive definite"]),
        (inertial("0", unit), &["mass = 0", "inertia"]),
        (geometry("<sphere radius='-1'/>"), &["radius = -1"]),
        (geometry("<box size='1 1'/>"), &["line 2:", "three numbers"]),
        (geometry("<cone radius='1'/>"), &["<cone>", "<box>"]),
        (geometry(""), &["a form is missing"]),
        (geometry("<cylinder radius='1'/>"), &["length is missing"]),
    ];
    for (text, words) in cases {
        let error = error_of(read_urdf(&text), &text);
        for word in words {
            assert!(error.contains(word), "{text}\n  {error}\n  lacks {word:?}");
        }
    }
}

#[test]
fn links_that_are_no_tree_are_refused() {
    let robot = |joints: &[(&str, &str)]| {
        let links = "<link name='a'/><link name='b'/><link name='c'/>";
        let joints: Vec<String> = joints
            .iter()
            .enumerate()
            .map(|(at, (parent, child))| {
                format!("<joint name='j{at}' type='fixed'><parent link='{parent}'/><child link='{child}'/></joint>")
            })
            .collect();
        error_of(read_urdf(&format!("<robot>{links}{}</robot>", joints.concat())), "no tree")
    };
    assert!(robot(&[("a", "b"), ("c", "b")]).contains("\"j0\" and \"j1\""));
    assert!(robot(&[("a", "b"), ("b", "c"), ("c", "a")]).contains("hangs on itself"));
    assert!(robot(&[("b", "c"), ("c", "b")]).contains("hangs on itself"));
    assert!(robot(&[("a", "a"), ("a", "b")]).contains("hangs on"));
}

#[test]
fn files_that_are_no_mjcf_are_refused_by_name_and_place() {
    let body =
        |inner: &str| format!("<mujoco><worldbody><body name='b'>\n{inner}</body></worldbody></mujoco>");
    let cases: Vec<(String, &[&str])> = vec![
        ("<robot/>".to_owned(), &["<robot>", "<mujoco>"]),
        ("<mujoco/>".to_owned(), &["0 links hang on nothing"]),
        ("<mujoco><worldbody><body/><body/></worldbody></mujoco>".to_owned(), &["2 links"]),
        ("<mujoco><include file='/etc/passwd'/></mujoco>".to_owned(), &["<include>", "line 1:9"]),
        ("<mujoco><compiler angle='grad'/></mujoco>".to_owned(), &["angle", "radian"]),
        ("<mujoco><compiler eulerseq='xy'/></mujoco>".to_owned(), &["eulerseq"]),
        (body("<joint type='ball'/>"), &["line 2:1", "ball", "hinge"]),
        (body("<joint axis='0 0 0'/>"), &["axis"]),
        (body("<joint class='none'/>"), &["class", "\"none\""]),
        (body("<joint range='1 -1'/>"), &["limits"]),
        (body("<geom type='blob' size='1'/>"), &["blob"]),
        (body("<geom size='-1'/>"), &["size"]),
        (body("<geom/>"), &["size", "missing"]),
        (body("<geom type='mesh' mesh='m'/>"), &["mesh", "\"m\""]),
        (body("<geom size='1' mass='-1'/>"), &["mass"]),
        (body("<geom type='capsule' size='0.1' fromto='0 0 0 0 0 0'/>"), &["size"]),
        (body("<inertial mass='nan'/>"), &["finite"]),
        (body("<inertial mass='-2'/>"), &["mass = -2"]),
        (body("<body quat='0 0 0 0'/>"), &["quat"]),
        (body("<body><freejoint/></body>"), &["free joint"]),
        (
            "<mujoco><worldbody><body/></worldbody><actuator><motor joint='x'/></actuator></mujoco>"
                .to_owned(),
            &["\"x\"", "joint"],
        ),
    ];
    for (text, words) in cases {
        let error = error_of(read_mjcf(&text), &text);
        for word in words {
            assert!(error.contains(word), "{text}\n  {error}\n  lacks {word:?}");
        }
    }
}

#[test]
fn files_that_are_too_much_are_refused_in_no_time() {
    let deep = |open: &str, close: &str| format!("{}{}", open.repeat(100_000), close.repeat(100_000));
    let urdf = format!("<robot><link name='a'>{}</link></robot>", deep("<x>", "</x>"));
    assert!(error_of(read_urdf(&urdf), "deep").contains("within one another"));
    let mjcf = format!("<mujoco><worldbody>{}</worldbody></mujoco>", deep("<body>", "</body>"));
    assert!(error_of(read_mjcf(&mjcf), "deep").contains("within one another"));
    let many: Vec<String> = (0..2000).map(|at| format!("<link name='{at}'/>")).collect();
    assert!(error_of(read_urdf(&format!("<robot>{}</robot>", many.concat())), "many").contains("2000 links"));
    let limits = ImportLimits { bytes: 100, ..ImportLimits::default() };
    let options = ImportOptions { limits, ..ImportOptions::default() };
    assert!(error_of(urdf::from_str(LEG_URDF, &options), "long").contains("bytes"));
    let bomb = "<!DOCTYPE r [<!ENTITY a \"aaaa\"><!ENTITY b \"&a;&a;\">]><robot name='&b;'/>";
    assert!(error_of(read_urdf(bomb), "bomb").contains("DOCTYPE"));
    assert!(error_of(read_mjcf(bomb), "bomb").contains("DOCTYPE"));
}

#[test]
fn what_is_approximated_stands_in_the_report() {
    let text = "<robot><link name='base'><collision><geometry><box size='1 1 1'/></geometry></collision></link>
        <link name='arm'><inertial><mass value='2'/><inertia ixx='0'/></inertial>
        <collision><geometry><mesh filename='package://arm/arm.dae'/></geometry></collision></link>
        <joint name='j' type='continuous'><parent link='base'/><child link='arm'/><mimic joint='k'/></joint></robot>";
    let read = read_urdf(text).unwrap();
    let report = read.report.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n");
    for word in ["no mass: 1000.000 kg", "ball as dense as water", "no folder", "no <limit>", "followed"] {
        assert!(report.contains(word), "{report}\nlacks {word:?}");
    }
    assert_eq!(read.description.mass(), 1002.0);
}

/// A post that stands, an arm on it and a hand that folds back on the post, by both formats.
fn folding(contact: &str, hand: &str) -> [String; 2] {
    let beam = "<inertial><origin xyz='.25 0 0'/><mass value='1'/><inertia ixx='.002' iyy='.02' izz='.02'/></inertial>\
        <collision><origin xyz='.25 0 0'/><geometry><box size='.4 .04 .04'/></geometry></collision>";
    let joint = |name: &str, parent: &str, child: &str, x: f64| {
        format!(
            "<joint name='{name}' type='revolute'><origin xyz='{x} 0 0'/><parent link='{parent}'/><child link='{child}'/>\
             <axis xyz='0 0 1'/><limit lower='-3.1' upper='3.1' effort='5' velocity='50'/></joint>"
        )
    };
    let urdf = format!(
        "<robot name='folding'><link name='world'/><link name='post'><collision><geometry><box size='.2 .2 .5'/></geometry>\
         </collision></link><link name='arm'>{beam}</link><link name='hand'>{beam}</link>\
         <joint name='weld' type='fixed'><parent link='world'/><child link='post'/></joint>{}{}</robot>",
        joint("shoulder", "post", "arm", 0.15),
        joint("elbow", "arm", "hand", 0.35)
    );
    let inertial = "<inertial pos='.25 0 0' mass='1' diaginertia='.002 .02 .02'/>";
    let mjcf = format!(
        "<mujoco><compiler angle='radian'/><worldbody><body name='post'><geom type='box' size='.1 .1 .25'/>\
         <body name='arm' pos='.15 0 0'>{inertial}<joint name='shoulder' range='-3.1 3.1'/>\
         <geom type='box' size='.2 .02 .02' pos='.25 0 0'/>\
         <body name='hand' pos='.35 0 0'>{inertial}<joint name='elbow' range='-3.1 3.1'/>\
         <geom type='box' size='.2 .02 .02' pos='.25 0 0' {hand}/></body></body></body></worldbody>{contact}\
         <actuator><motor joint='shoulder' forcerange='-5 5'/><motor joint='elbow' forcerange='-5 5'/></actuator></mujoco>"
    );
    [urdf, mjcf]
}

/// Where a joint comes to rest that is driven on while the other one is held at 0.
fn driven(read: Imported, joint: &str) -> f64 {
    let mut stage = Stage::new();
    let id = put(&mut stage, read.description);
    stage.tick(0.01);
    for _ in 0..150 {
        let body: &mut Robot = stage.physics.body_as_mut(id).unwrap();
        for name in ["shoulder", "elbow"] {
            let at = body.joint(name).unwrap();
            let driven = JointCommand { torque: 1.0, damping: 0.3, ..JointCommand::default() };
            let command = if name == joint { driven } else { body.servo(at, 0.0, 8.0) };
            body.command(at, command).unwrap();
        }
        stage.tick(0.02);
    }
    let body: &Robot = stage.physics.body_as(id).unwrap();
    body.reading(body.joint(joint).unwrap()).unwrap().angle
}

/// Links without a joint between them meet in URDF; in MJCF those do that contype, conaffinity and exclude let, and what hangs on a
/// body that stands as the world does meets that.
#[test]
fn links_meet_as_their_format_says() {
    let [urdf, mjcf] = folding("", "");
    let stopped = [read_urdf(&urdf).unwrap(), read_mjcf(&mjcf).unwrap()].map(|read| {
        assert_eq!(read.report.iter().filter(|note| note.what.contains("within one another")).count(), 0);
        driven(read, "elbow")
    });
    assert!(stopped.iter().all(|angle| *angle > 1.5 && *angle < 3.0), "{stopped:?}");
    assert!((stopped[0] - stopped[1]).abs() < 1e-3, "{stopped:?}");
    // The arm against the post, on which it hangs.
    let shoulder =
        [read_urdf(&urdf).unwrap(), read_mjcf(&mjcf).unwrap()].map(|read| driven(read, "shoulder"));
    assert!(shoulder[0] > 3.0 && shoulder[1] < 2.5 && shoulder[1] > 1.5, "{shoulder:?}");
    for (contact, hand) in [
        ("<contact><exclude body1='post' body2='hand'/></contact>", ""),
        ("", "contype='0' conaffinity='0'"),
        ("", "contype='2' conaffinity='4'"),
    ] {
        let through = driven(read_mjcf(&folding(contact, hand)[1]).unwrap(), "elbow");
        assert!(through > 3.09, "{contact}{hand}: {through}");
    }
    let meets = driven(read_mjcf(&folding("", "contype='2' conaffinity='1'")[1]).unwrap(), "elbow");
    assert!((meets - stopped[1]).abs() < 1e-3, "{meets}");
    let none = folding("<contact><exclude body1='post' body2='foot'/></contact>", "");
    assert!(error_of(read_mjcf(&none[1]), "no foot").contains("\"foot\""));
    let half = folding("", "contype='0.5'");
    assert!(error_of(read_mjcf(&half[1]), "half a bit").contains("contype"));
}

/// What is within something else at rest passes through it for good, and the report says so.
#[test]
fn links_that_overlap_at_rest_pass_through_one_another_and_stand_in_the_report() {
    let [urdf, mjcf] = folding("", "");
    let urdf = urdf.replace("0.35 0 0'/><parent link='arm'", "-0.2 0 0'/><parent link='arm'");
    let mjcf = mjcf.replace("name='hand' pos='.35 0 0'", "name='hand' pos='-.2 0 0'");
    for read in [read_urdf(&urdf).unwrap(), read_mjcf(&mjcf).unwrap()] {
        let pairs: Vec<&[String; 2]> =
            read.description.apart.iter().filter(|pair| pair.contains(&"hand".to_owned())).collect();
        assert!(pairs.iter().any(|pair| pair.contains(&"post".to_owned())), "{pairs:?}");
        let report = read.report.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n");
        assert!(report.contains("links \"post\" and \"hand\": are within one another"), "{report}");
    }
}

/// A cube of a metre as STL, and an angle of two boxes as OBJ.
#[test]
fn meshes_are_met_as_convex_solids_and_lie_in_their_folder() {
    let folder = tempfile::tempdir().unwrap();
    let inside = folder.path().join("arm/meshes");
    fs::create_dir_all(&inside).unwrap();
    fs::write(folder.path().join("secret.stl"), "solid").unwrap();
    let obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n\
        f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
    fs::write(inside.join("cube.obj"), obj).unwrap();
    let angle = "v 0 0 0\nv 2 0 0\nv 2 0 .2\nv .2 0 .2\nv .2 0 2\nv 0 0 2\n\
        v 0 1 0\nv 2 1 0\nv 2 1 .2\nv .2 1 .2\nv .2 1 2\nv 0 1 2\n\
        f 1 2 3 4\nf 1 4 5 6\nf 10 9 8 7\nf 12 11 10 7\n\
        f 2 1 7 8\nf 3 2 8 9\nf 4 3 9 10\nf 5 4 10 11\nf 6 5 11 12\nf 1 6 12 7\n";
    fs::write(inside.join("angle.obj"), angle).unwrap();
    let options = ImportOptions { folder: Some(folder.path().join("arm")), ..ImportOptions::default() };
    let read = |name: &str| {
        let text = format!(
            "<robot><link name='a'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1'/></inertial>\
             <collision><geometry><mesh filename='{name}' scale='.5 .5 .5'/></geometry></collision></link></robot>"
        );
        urdf::from_str(&text, &options)
    };
    for name in ["package://arm/meshes/cube.obj", "meshes/cube.obj", "./meshes/../meshes/cube.obj"] {
        let read = read(name).unwrap();
        let solids = &read.description.links[0].solids;
        let [Form::Convex { points }] = [&solids[0].form] else { panic!("{solids:?}") };
        assert_eq!((solids.len(), points.len()), (1, 8), "{name}");
        assert!(points.iter().all(|point| point.iter().all(|part| *part == 0.0 || *part == 0.5)));
    }
    let apart = read("meshes/angle.obj").unwrap().description.links[0].solids.len();
    assert!((2..=8).contains(&apart), "{apart}");
    for name in [
        "../secret.stl",
        "package://../secret.stl",
        "/etc/passwd",
        "file:///etc/passwd",
        "meshes/../../secret.stl",
    ] {
        let error = error_of(read(name), name);
        assert!(error.contains("leads out of the folder"), "{name}: {error}");
    }
    assert!(error_of(read("meshes/none.obj"), "none").contains("no file"));
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(folder.path().join("secret.stl"), inside.join("link.stl")).unwrap();
        assert!(error_of(read("meshes/link.stl"), "link").contains("leads out"));
    }
    let bytes: Vec<u8> = [vec![0; 80], 2_u32.to_le_bytes().to_vec(), vec![0xff; 100]].concat();
    fs::write(inside.join("nan.stl"), bytes).unwrap();
    assert!(error_of(read("meshes/nan.stl"), "nan").contains("1e4 m"));
    fs::write(inside.join("short.stl"), [0xff; 90]).unwrap();
    assert!(error_of(read("meshes/short.stl"), "short").contains("no STL"));
    fs::write(inside.join("bad.obj"), "v 0 0 0\nf 1 2 3\n").unwrap();
    assert!(error_of(read("meshes/bad.obj"), "bad").contains("line 2"));
}
