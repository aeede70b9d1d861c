//! How a robot dog trots under our physics and, led by the same control, in `MuJoCo`.

use std::fmt;
use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use nalgebra::{Quaternion, UnitQuaternion};
use simworld_core::asset::Material;
use simworld_core::geometry::{Point3, Pose, Vector3, pose_facing};
use simworld_core::scene::{EntityDesc, EntityKind, Shape, World};
use simworld_core::seam::Dynamics;
use simworld_physics::proving::ProvingError;
use simworld_physics::robot::{JointKind, mjcf};
use simworld_physics::{
    LEGS, PhysicsConfig, PhysicsDynamics, Quadruped, QuadrupedConfig, QuadrupedControl, QuadrupedState,
};

use super::mujoco::{Rival, absent_or};

/// The time of one turn of the control, s; in `MuJoCo` so many steps pass in it.
const STEP: f64 = 1.0 / 200.0;
const SUBSTEPS: usize = 5;
/// It takes so long to take up the command before it is looked at, s.
const SETTLING: f64 = 3.0;
/// The numbers that the script tells of what is felt: place and turn of the trunk, its velocities, the centre of mass, angles and
/// speeds of twelve joints, loads of four feet.
const FELT: usize = 7 + 6 + 3 + 24 + 4;

/// A trot on level asphalt, seen once it is steady.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Trot {
    /// Mean speed forward, m/s.
    pub speed: f64,
    /// How far it comes from its way in a second, m, positive to the left.
    pub aside: f64,
    /// Mean height of the middle of the trunk over the ground, m.
    pub height: f64,
    /// Between its least and its greatest height, m.
    pub sway: f64,
    /// The greatest tilt of the trunk, radians.
    pub tilt: f64,
}

impl Trot {
    /// What is seen of a walk, whose trunk was there after each turn of the control; none of no walk.
    fn of(trunks: &[Pose]) -> Option<Self> {
        let (first, last) = (trunks.first()?.translation.vector, trunks.last()?.translation.vector);
        let time = (trunks.len() - 1) as f64 * STEP;
        let heights = trunks.iter().map(|trunk| trunk.translation.z);
        let [low, high] =
            [heights.clone().fold(f64::INFINITY, f64::min), heights.clone().fold(0.0, f64::max)];
        let tilts = trunks.iter().map(|trunk| (trunk.rotation * Vector3::z()).angle(&Vector3::z()));
        let way = (last - first) / time;
        Some(Self {
            speed: way.x,
            aside: way.y,
            height: heights.sum::<f64>() / trunks.len() as f64,
            sway: high - low,
            tilt: tilts.fold(0.0, f64::max),
        })
    }
}

impl fmt::Display for Trot {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { speed, aside, height, sway, tilt } = self;
        let (aside, sway, tilt) = (aside * 1e3, sway * 1e3, tilt.to_degrees());
        write!(
            f,
            "{speed:.3} m/s and {aside:.1} mm/s aside, the trunk {height:.4} m high, {sway:.1} mm up and down, tilted by {tilt:.1}° at most"
        )
    }
}

fn forward(speed: f64) -> simworld_physics::Command {
    simworld_physics::Command { forward: speed, ..Default::default() }
}

/// The turns of the control in so many seconds.
fn turns(seconds: f64) -> usize {
    (seconds / STEP).round() as usize
}

/// A dog under our physics that was told to go at a speed, m/s, for so many seconds.
///
/// # Errors
/// The physics refuses it.
pub fn our_trot(speed: f64, seconds: f64) -> Result<Trot, ProvingError> {
    let mut world = World::new();
    let mut physics = PhysicsDynamics::new(PhysicsConfig { substeps: 1, ..PhysicsConfig::default() })?;
    let pose = pose_facing(Point3::origin(), 0.0);
    let dog = world.spawn(EntityDesc::new(EntityKind::Dog, pose, Shape::cuboid(0.7, 0.35, 0.5)))?;
    physics.add_quadruped(&world, dog, QuadrupedConfig::default())?;
    physics.body_as_mut::<Quadruped>(dog).ok_or("the dog has no body")?.command(forward(speed));
    let middle = Pose::translation(0.0, 0.0, QuadrupedConfig::default().model.standing_height());
    let mut trunks = Vec::new();
    for _ in 0..turns(SETTLING + seconds) {
        world.begin_step();
        physics.step(&mut world, STEP)?;
        world.finish_step();
        trunks.push(physics.state(dog).ok_or("the dog has no state")?.pose * middle);
    }
    Ok(Trot::of(&trunks[turns(SETTLING)..]).ok_or("there was no time to walk in")?)
}

/// The same dog, led by the same control, in `MuJoCo` on the same ground.
pub fn mujoco_trot(speed: f64, seconds: f64) -> Rival<Trot> {
    let child = Command::new("python3")
        .args(["-c", include_str!("dog_in_mujoco.py")])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn();
    let Ok(mut child) = child else { return Rival::Absent };
    let trot = walk_there(&mut child, speed, seconds);
    match (trot, child.wait_with_output()) {
        (Ok(trot), Ok(output)) if output.status.success() => Rival::Measured(trot),
        (Ok(_), Err(error)) => Rival::Failed(error.to_string()),
        (Err(error), Err(_)) => Rival::Failed(error.to_string()),
        (trot, Ok(output)) => {
            absent_or(&output, &trot.err().map_or_else(String::new, |error| error.to_string()))
        }
    }
}

fn walk_there(child: &mut Child, speed: f64, seconds: f64) -> Result<Trot, ProvingError> {
    let (input, output) = (child.stdin.take(), child.stdout.take());
    let (input, output) = input.zip(output).ok_or("no way to talk to the script")?;
    let gravity = PhysicsConfig::default().gravity;
    let mut control = QuadrupedControl::new(QuadrupedConfig::default())?;
    control.command(forward(speed));
    let mut there = There::begin(input, output, control.config(), gravity)?;
    let (mut felt, mut trunks) = (there.feel()?, Vec::new());
    for _ in 0..turns(SETTLING + seconds) {
        there.act(&control.torques(&felt, &|_| Some(0.0), gravity, STEP)?)?;
        felt = there.feel()?;
        trunks.push(felt.trunk);
    }
    Ok(Trot::of(&trunks[turns(SETTLING)..]).ok_or("there was no time to walk in")?)
}

/// The dog in the other engine. It ends with this.
struct There {
    input: ChildStdin,
    output: BufReader<ChildStdout>,
}

impl There {
    fn begin(
        mut input: ChildStdin,
        output: ChildStdout,
        config: &QuadrupedConfig,
        gravity: f64,
    ) -> Result<Self, ProvingError> {
        let model = &config.model;
        let description = model.description();
        let joints = description.joints.iter().filter(|joint| joint.kind != JointKind::Fixed);
        let joints: Vec<&str> = joints.map(|joint| joint.name.as_str()).collect();
        let friction = (Material::Rubber.friction() * PhysicsConfig::default().ground.friction()).sqrt();
        let job = serde_json::json!({
            "mjcf": mjcf::to_string(&description)?,
            "trunk": description.links[0].name,
            "joints": joints,
            "shanks": LEGS.map(|leg| format!("{leg} knee")),
            "friction": friction,
            "gravity": gravity,
            "step": STEP,
            "substeps": SUBSTEPS,
            "height": model.standing_height(),
            "angles": model.standing_angles().as_flattened(),
        });
        writeln!(input, "{job}")?;
        Ok(Self { input, output: BufReader::new(output) })
    }

    fn feel(&mut self) -> Result<QuadrupedState, ProvingError> {
        let mut line = String::new();
        self.output.read_line(&mut line)?;
        let numbers: Vec<f64> = serde_json::from_str(&line)?;
        let numbers =
            <[f64; FELT]>::try_from(numbers).map_err(|_| "the script told too much or too little")?;
        let vector = |at: usize| Vector3::new(numbers[at], numbers[at + 1], numbers[at + 2]);
        let joints =
            |at: usize| std::array::from_fn(|leg| std::array::from_fn(|joint| numbers[at + 3 * leg + joint]));
        let turn = UnitQuaternion::new_normalize(Quaternion::from_parts(numbers[3], vector(4)));
        Ok(QuadrupedState {
            trunk: Pose::from_parts(vector(0).into(), turn),
            linear: vector(7),
            angular: vector(10),
            center: vector(13),
            angles: joints(16),
            speeds: joints(28),
            loads: std::array::from_fn(|foot| numbers[40 + foot]),
        })
    }

    fn act(&mut self, torques: &[[f64; 3]; 4]) -> Result<(), ProvingError> {
        Ok(writeln!(self.input, "{}", serde_json::to_string(torques.as_flattened())?)?)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_trot_is_told_by_its_trunk() {
        let trunks: Vec<Pose> = (0..=200)
            .map(|turn| {
                let height = if turn % 2 == 0 { 0.3 } else { 0.28 };
                pose_facing(Point3::new(f64::from(turn) * 0.004, 0.0, height), 0.0)
            })
            .collect();
        let trot = Trot::of(&trunks).unwrap();
        assert!((trot.speed - 0.8).abs() < 1e-9 && trot.aside.abs() < 1e-9, "{trot:?}");
        assert!((trot.height - 0.29).abs() < 1e-3 && (trot.sway - 0.02).abs() < 1e-9, "{trot:?}");
        assert!(Trot::of(&[]).is_none());
    }

    #[test]
    fn it_trots_here_as_it_is_told() {
        let trot = our_trot(0.5, 2.0).unwrap();
        assert!((trot.speed - 0.5).abs() < 0.05 && (trot.height - 0.29).abs() < 0.02, "{trot:?}");
    }

    /// The whole way through the other engine, where that is there; without it, it says so.
    #[test]
    fn the_other_engine_is_led_by_the_same_control_where_it_is_there() {
        match mujoco_trot(0.5, 2.0) {
            Rival::Measured(trot) => assert!((trot.speed - 0.5).abs() < 0.15, "{trot:?}"),
            Rival::Absent => println!("skipped: the Python package mujoco is not there"),
            Rival::Failed(why) => panic!("{why}"),
        }
    }
}
