//! A robot on two wheels that drives an eight, by the speeds of its wheels alone.

use simworld_core::geometry::{Point3, Vector3};
use simworld_physics::robot::{ImportOptions, mjcf};
use simworld_physics::{JointCommand, RobotConfig};

use super::{Bench, RobotRunError};

/// The robot of the repository.
pub const ROVER: &str = include_str!("../../assets/robots/rover.xml");

/// The wheels, their radius and how far they are apart, m.
const WHEELS: [&str; 2] = ["left", "right"];
const RADIUS: f64 = 0.1;
const TRACK: f64 = 0.4;
const DT: f64 = 0.02;

/// What became of a stretch.
#[derive(Clone, Debug)]
pub struct Roll {
    /// What it is, in words.
    pub name: &'static str,
    /// Speed, m/s, and rate of turning, rad/s, as told.
    pub told: [f64; 2],
    /// The same as done, over the last second.
    pub done: [f64; 2],
    /// The way of the chassis, m.
    pub way: Vec<Vector3>,
}

/// Reads the robot and drives it straight on, then round to the left, round to the right, and back.
///
/// # Errors
/// A file that is no robot, or one without the wheels.
pub fn roll(text: &str) -> Result<Vec<Roll>, RobotRunError> {
    let read = mjcf::from_str(text, &ImportOptions::default())?;
    let gains = read.gains.clone();
    let mut bench = Bench::new(RobotConfig::from(read.description), Point3::origin())?;
    let round = std::f64::consts::TAU / 0.8;
    let stretches = [
        ("straight on", [0.5, 0.0], 3.0),
        ("round to the left", [0.5, 0.8], round),
        ("round to the right", [0.5, -0.8], round),
        ("back", [-0.3, 0.0], 3.0),
    ];
    let mut rolls = Vec::new();
    for (name, told, time) in stretches {
        let [speed, turning] = told;
        for (wheel, side) in WHEELS.into_iter().zip([-1.0, 1.0]) {
            let robot = bench.robot_mut();
            let lacks = || RobotRunError::Lacks { what: "joint", name: wheel };
            let joint = robot.joint(wheel).ok_or_else(lacks)?;
            let damping = gains.get(wheel).map_or(2.0, |[_, damping]| *damping);
            let speed = (speed + side * turning * 0.5 * TRACK) / RADIUS;
            robot.command(joint, JointCommand { speed, damping, ..JointCommand::default() })?;
        }
        rolls.push(stretch(&mut bench, name, told, time)?);
    }
    Ok(rolls)
}

fn stretch(bench: &mut Bench, name: &'static str, told: [f64; 2], time: f64) -> Result<Roll, RobotRunError> {
    let mut way = Vec::new();
    let mut headings = Vec::new();
    for _ in 0..(time / DT).round() as u32 {
        bench.step(DT)?;
        let lacks = RobotRunError::Lacks { what: "link", name: "chassis" };
        let pose = bench.robot().link_pose("chassis").ok_or(lacks)?;
        let ahead = pose.rotation * Vector3::x();
        way.push(pose.translation.vector);
        headings.push(simworld_core::ops::atan2(ahead.y, ahead.x));
    }
    let last = (1.0 / DT) as usize;
    let from = way.len().saturating_sub(last + 1);
    let length: f64 = way[from..].windows(2).map(|pair| (pair[1] - pair[0]).norm()).sum();
    let turned: f64 =
        headings[from..].windows(2).map(|pair| simworld_core::ops::wrap_angle(pair[1] - pair[0])).sum();
    let seconds = (way.len() - 1 - from) as f64 * DT;
    let done = [length / seconds * told[0].signum(), turned / seconds];
    Ok(Roll { name, told, done, way })
}
