//! Whatever stands in a file of a robot, it is refused or is a robot that can be used.
#![cfg(all(feature = "mjcf", feature = "urdf"))]
#![allow(clippy::unwrap_used)]

use super::robot_files::{LEG_MJCF, LEG_URDF, read_mjcf, read_urdf};
use crate::common::Stage;
use proptest::prelude::*;
use simworld_core::geometry::{Point3, pose_facing};
use simworld_core::scene::{EntityKind, Shape};
use simworld_physics::robot::mjcf;
use simworld_physics::{RobotConfig, RobotError};

/// Any text is refused, or is a robot that can be put into a world and steps without trouble, and that is written to a file that is read
/// again unless it is told why not.
fn survives(text: &str) {
    for read in [read_urdf(text), read_mjcf(text)] {
        let Ok(read) = read else { continue };
        read.description.validate().unwrap();
        match mjcf::to_string(&read.description) {
            Ok(written) => assert!(
                (read_mjcf(&written).unwrap().description.mass() - read.description.mass()).abs() < 1e-6,
                "{written}"
            ),
            Err(refusal) => assert!(matches!(refusal, RobotError::Unsupported { .. }), "{refusal}"),
        }
        if read.description.joints.len() <= 8 {
            let mut stage = Stage::new();
            let shape = Shape::cuboid(0.4, 0.2, 0.4);
            let id = stage.spawn(EntityKind::Robot, pose_facing(Point3::new(0.0, 0.0, 3.0), 0.0), shape);
            if stage.physics.add_robot(&stage.world, id, RobotConfig::from(read.description)).is_ok() {
                stage.world.begin_step();
                // An absurd robot may come to absurd speeds, which the physics says.
                let _ = simworld_core::seam::Dynamics::step(&mut stage.physics, &mut stage.world, 0.01);
                stage.world.finish_step();
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn damaged_files_are_survived(
        cuts in prop::collection::vec((any::<prop::sample::Index>(), any::<prop::sample::Index>()), 1..4),
        put in prop::sample::select(vec!["", "nan", "-1", "0", "1e308", "1e3", "1e-9", "0.5", "<", "'", "\"/>", "world", "trunk", "1 2 3", "free", "-0"]),
        which in 0..3,
    ) {
        let mut text = if which == 0 { LEG_URDF.to_owned() } else { LEG_MJCF.to_owned() };
        if which == 0 {
            let seen = r#"<visual><origin xyz="0 0 0.1"/><geometry><box size="0.1 0.2 0.1"/></geometry></visual></link>"#;
            text = text.replace("</link>", seen);
        }
        if which == 2 {
            let mesh = r#"<asset><mesh name="m" scale="1 1 2" vertex="0 0 0 0.1 0 0 0 0.1 0 0 0 0.1"/></asset>"#;
            text = text.replace("<worldbody>", &format!("{mesh}<worldbody>"));
            text = text.replace(r#"<geom size="0.04""#, r#"<geom type="mesh" mesh="m" group="1""#);
        }
        for (from, to) in cuts {
            // A value, from quote to quote; now and then more than that.
            let quotes: Vec<usize> = text.match_indices('"').map(|(at, _)| at).collect();
            if quotes.len() < 4 { break; }
            let at = 2 * from.index(quotes.len() / 2);
            let end = if to.index(8) == 0 { (at + 1 + to.index(3)).min(quotes.len() - 1) } else { at + 1 };
            if end < quotes.len() {
                text.replace_range(quotes[at] + 1..quotes[end], put);
            }
        }
        survives(&text);
    }

    #[test]
    fn any_text_is_survived(text in "\\PC{0,200}") {
        survives(&text);
    }
}
