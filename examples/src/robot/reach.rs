//! An arm that reaches for places with its tip: angles by inverse kinematics, torques by its motors.

use nalgebra::{Matrix3, Matrix3xX};
use simworld_core::geometry::{Point3, Vector3};
use simworld_physics::robot::{ImportOptions, RobotDescription, Weight, urdf};
use simworld_physics::{Robot, RobotConfig};

use super::{Bench, RobotRunError};

/// The arm of the repository.
pub const ARM: &str = include_str!("../../assets/robots/arm.urdf");

/// The link that is to be at the target.
const TIP: &str = "tip";
/// How stiffly the joints are led, Hz.
const STIFF: f64 = 8.0;
/// Time for a target, s, and between two commands.
const TIME: f64 = 3.0;
const DT: f64 = 0.02;
/// How fast the angles that are asked for change, rad/s.
const PACE: f64 = 1.5;

/// What became of a target.
#[derive(Clone, Debug)]
pub struct Reach {
    /// Where the tip was to be, from the foot of the arm, m.
    pub target: Vector3,
    /// Where it came to be, m.
    pub tip: Vector3,
    /// The greatest share of its effort that a motor gave on the way.
    pub effort: f64,
    /// The arm from its foot to its tip at the end, m.
    pub shape: Vec<Vector3>,
    /// The way of the tip, m.
    pub way: Vec<Vector3>,
}

impl Reach {
    /// How far the tip is off, m.
    pub fn off(&self) -> f64 {
        (self.target - self.tip).norm()
    }
}

/// The places that the arm reaches for, m.
fn targets() -> [Vector3; 5] {
    [
        Vector3::new(0.5, 0.0, 0.5),
        Vector3::new(0.45, -0.4, 0.25),
        Vector3::new(0.35, 0.35, 0.3),
        Vector3::new(0.0, 0.55, 0.6),
        Vector3::new(-0.3, 0.3, 0.8),
    ]
}

/// Reads the arm and has it reach for one place after the other.
///
/// # Errors
/// A file that is no robot, or one without a link `tip`.
pub fn reach(text: &str) -> Result<Vec<Reach>, RobotRunError> {
    let description = urdf::from_str(text, &ImportOptions::default())?.description;
    let links: Vec<String> = description.links.iter().skip(1).map(|link| link.name.clone()).collect();
    let efforts = efforts(&description);
    let positions = [("lift".to_owned(), 0.3), ("elbow".to_owned(), 1.2)].into();
    let config = RobotConfig { weight: Weight::Carried, positions, ..RobotConfig::from(description) };
    let mut bench = Bench::new(config, Point3::origin())?;
    bench.step(DT)?;
    let mut reaches = Vec::new();
    for target in targets() {
        let lacks = RobotRunError::Lacks { what: "link", name: TIP };
        let start: Vec<f64> = bench.robot().readings().map(|joint| joint.angle).collect();
        let angles = angles_for(bench.robot(), &target, start.clone()).ok_or(lacks)?;
        reaches.push(go(&mut bench, target, (&start, &angles), (&links, &efforts))?);
    }
    Ok(reaches)
}

/// The greatest torques of the motors, by the order of the joints of the robot.
fn efforts(description: &RobotDescription) -> Vec<(String, f64)> {
    let effort = |effort: Option<f64>| effort.unwrap_or(f64::INFINITY);
    description.joints.iter().map(|joint| (joint.name.clone(), effort(joint.effort))).collect()
}

fn go(
    bench: &mut Bench,
    target: Vector3,
    (start, angles): (&[f64], &[f64]),
    (links, efforts): (&[String], &[(String, f64)]),
) -> Result<Reach, RobotRunError> {
    let mut reach = Reach { target, tip: target, effort: 0.0, shape: Vec::new(), way: Vec::new() };
    for step in 0..(TIME / DT) as u32 {
        let gone = PACE * DT * f64::from(step);
        let robot = bench.robot_mut();
        for (joint, (from, to)) in start.iter().zip(angles).enumerate() {
            let wanted = from + (to - from).clamp(-gone, gone);
            robot.command(joint, robot.servo(joint, wanted, STIFF))?;
        }
        bench.step(DT)?;
        let robot = bench.robot();
        for (name, reading) in robot.joint_names().zip(robot.readings()) {
            let most =
                efforts.iter().find(|(known, _)| known == name).map_or(f64::INFINITY, |(_, most)| *most);
            reach.effort = reach.effort.max(reading.torque.abs() / most);
        }
        reach.way.extend(robot.link_pose(TIP).map(|pose| pose.translation.vector));
    }
    reach.shape = links
        .iter()
        .filter_map(|link| bench.robot().link_pose(link))
        .map(|pose| pose.translation.vector)
        .collect();
    reach.tip = reach.way.last().copied().unwrap_or_default();
    Ok(reach)
}

/// The angles at which the tip is at a place, by damped least squares (Wampler 1986) from where the joints are; none without a
/// tip.
fn angles_for(robot: &Robot, target: &Vector3, mut angles: Vec<f64>) -> Option<Vec<f64>> {
    const DAMPING: f64 = 1e-3;
    const NUDGE: f64 = 1e-6;
    let tip = |angles: &[f64]| Some(robot.link_pose_at(TIP, angles)?.translation.vector);
    let limits = limits(robot);
    for _ in 0..200 {
        let here = tip(&angles)?;
        let missing = target - here;
        if missing.norm() < 1e-6 {
            break;
        }
        let mut jacobian = Matrix3xX::zeros(angles.len());
        for joint in 0..angles.len() {
            let mut nudged = angles.clone();
            nudged[joint] += NUDGE;
            jacobian.set_column(joint, &((tip(&nudged)? - here) / NUDGE));
        }
        let square = &jacobian * jacobian.transpose() + Matrix3::identity() * DAMPING;
        let step = jacobian.transpose() * square.try_inverse()? * missing;
        let step = &step * (0.2 / step.norm().max(0.2));
        for ((angle, step), [low, high]) in angles.iter_mut().zip(step.iter()).zip(&limits) {
            *angle = (*angle + step).clamp(*low, *high);
        }
    }
    Some(angles)
}

/// Where the joints end, by their order.
fn limits(robot: &Robot) -> Vec<[f64; 2]> {
    let joints = &robot.config().description.joints;
    robot
        .joint_names()
        .map(|name| joints.iter().find(|joint| joint.name == name).and_then(|joint| joint.limits))
        .map(|limits| limits.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]))
        .collect()
}
