//! Robots have the colours of their files.
#![cfg(all(feature = "mjcf", feature = "urdf"))]

use super::robot_files::read_mjcf;
use crate::common::Stage;
use simworld_core::asset::light_of;
use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::scene::{EntityKind, Scene, Shape};
use simworld_physics::robot::{ImportOptions, mjcf, urdf};
use simworld_physics::{RobotConfig, RobotDescription, RobotError};

fn light(values: [u8; 3]) -> [f32; 3] {
    values.map(light_of)
}

/// The colours of all solids, link by link.
fn colors(robot: &RobotDescription) -> Vec<Option<[f32; 3]>> {
    robot.links.iter().flat_map(|link| &link.solids).map(|solid| solid.color).collect()
}

fn read_urdf(visuals: [&str; 3], materials: &str) -> Result<RobotDescription, RobotError> {
    let link = |(name, visual): (&str, &str)| {
        format!(
            "<link name=\"{name}\"><collision><geometry><sphere radius=\"0.1\"/></geometry></collision>{visual}</link>"
        )
    };
    let links: String = ["a", "b", "c"].into_iter().zip(visuals).map(link).collect();
    let joint = |pair: [&str; 2]| {
        format!(
            "<joint name=\"{0}{1}\" type=\"fixed\"><parent link=\"{0}\"/><child link=\"{1}\"/></joint>",
            pair[0], pair[1]
        )
    };
    let text =
        format!("<robot name=\"r\">{links}{}{}{materials}</robot>", joint(["a", "b"]), joint(["b", "c"]));
    Ok(urdf::from_str(&text, &ImportOptions::default())?.description)
}

/// A visual's own colour, one by the name of a material anywhere in the file, the first of two, none.
#[test]
fn a_link_of_a_urdf_has_the_colour_of_its_visual() {
    let own = "<visual/><visual><material name=\"x\"><color rgba=\"1 0.2 0 0.5\"/></material></visual>\
               <visual><material><color rgba=\"0 0 0 1\"/></material></visual>";
    let named = "<visual><material name=\"sea\"/></visual>";
    let robot =
        read_urdf([own, named, ""], "<material name=\"sea\"><color rgba=\"0 0 2 1\"/></material>").unwrap();
    assert_eq!(colors(&robot), [Some(light([255, 51, 0])), Some(light([0, 0, 255])), None]);
    let unknown = "<visual><material name=\"nobody's\"/></visual>";
    // What a visual calls its colour others may call it.
    let by_name = "<visual><material name=\"x\"/></visual>";
    let robot = read_urdf([unknown, own, by_name], "").unwrap();
    assert_eq!(colors(&robot), [None, Some(light([255, 51, 0])), Some(light([255, 51, 0]))]);
}

#[test]
fn a_colour_that_is_no_numbers_is_refused_by_place() {
    let visual = "<visual><material><color rgba=\"red\"/></material></visual>";
    let error = read_urdf(["", visual, ""], "").unwrap_err().to_string();
    assert!(error.contains("rgba") && error.contains("numbers"), "{error}");
    let robot = read_urdf(["", "<visual><material><color rgba=\"1 0\"/></material></visual>", ""], "");
    assert_eq!(colors(&robot.unwrap()), [None; 3]);
}

const CART: &str = r#"<mujoco model="cart">
  <default><geom rgba="0 1 0 1"/>
    <default class="plain"><geom rgba=""/></default>
    <default class="shiny"><material rgba="0 0 1 1"/></default>
  </default>
  <asset><material name="paint" rgba="0.2 0.4 0.6 1"/><material name="chrome" class="shiny"/></asset>
  <worldbody><body name="cart"><freejoint/>
    <geom type="sphere" size="0.1"/>
    <geom type="sphere" size="0.1" pos="1 0 0" rgba="1 0 0 1" material="paint"/>
    <body name="box" pos="0 0 1">
      <geom class="plain" type="box" size="0.1 0.1 0.1"/>
      <geom class="plain" type="box" size="0.1 0.1 0.1" contype="0" conaffinity="0" rgba="1 1 0 1"/>
    </body>
  </body></worldbody></mujoco>"#;

/// A geom's own colour before that of its class and of its material; what is only seen lends its colour to what is met.
#[test]
fn a_geom_of_an_mjcf_has_its_colour() {
    let robot = read_mjcf(CART).unwrap().description;
    assert_eq!(
        colors(&robot),
        [Some(light([0, 255, 0])), Some(light([255, 0, 0])), Some(light([255, 255, 0]))]
    );
    let painted = CART.replace("<geom rgba=\"0 1 0 1\"/>", "<geom material=\"chrome\"/>");
    let robot = read_mjcf(&painted.replace("rgba=\"1 0 0 1\" ", "")).unwrap().description;
    assert_eq!(colors(&robot)[..2], [Some(light([0, 0, 255])), Some(light([51, 102, 153]))]);
}

#[test]
fn colours_are_written_and_seen() {
    let robot = read_mjcf(CART).unwrap().description;
    let again = read_mjcf(&mjcf::to_string(&robot).unwrap()).unwrap().description;
    assert_eq!(colors(&robot), colors(&again));
    let mut stage = Stage::new();
    let place = pose_facing(Point3::new(0.0, 0.0, 1.0), 0.0);
    let id = stage.spawn(EntityKind::Robot, place, Shape::cuboid(0.3, 0.3, 1.0));
    let wanted = colors(&robot);
    stage.physics.add_robot(&stage.world, id, RobotConfig::from(robot)).unwrap();
    stage.run(1);
    let seen: Vec<_> = stage.world.links(id).unwrap().iter().map(|(form, _)| form.color).collect();
    assert_eq!(seen, wanted);
}

#[test]
fn a_colour_beyond_white_is_no_colour() {
    let mut robot = read_mjcf(CART).unwrap().description;
    robot.links[0].solids[0].color = Some([0.0, 1.5, 0.0]);
    let error = robot.validate().unwrap_err().to_string();
    assert!(error.contains("color") && error.contains("1.5"), "{error}");
}
