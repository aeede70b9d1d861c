//! Robot dogs on twelve motors walk: the acceptance list for legged robots, but for falls.
//!
//! Sampled by default; under `SIMWORLD_SOAK=1` they walk for the whole minute.
#![allow(clippy::unwrap_used)]

use std::f64::consts::FRAC_PI_2;

use crate::common::{Stage, at, ramp};
use simworld_core::action::{Action, StepDirection};
use simworld_core::geometry::{Point3, Pose, Vector3, yaw_of};
use simworld_core::id::EntityId;
use simworld_core::ops;
use simworld_core::scene::{EntityKind, Footing, Scene};
use simworld_physics::{
    Command, JointCommand, PhysicsConfig, PhysicsError, QuadrupedConfig, QuadrupedControl, QuadrupedState,
};

fn forward(speed: f64) -> Command {
    Command { forward: speed, ..Command::default() }
}

/// Seconds to walk in a test: the whole minute only on demand.
fn minute() -> usize {
    if std::env::var("SIMWORLD_SOAK").is_ok_and(|value| value == "1") { 60 } else { 12 }
}

/// What is seen of a walk.
#[derive(Debug)]
struct Walk {
    /// Mean velocity, world frame, m/s.
    velocity: Vector3,
    /// The least upward part of the trunk's upward axis.
    least_up: f64,
    /// Least and greatest height of the trunk over the ground under its feet, m.
    height: [f64; 2],
    /// How often each foot was found in the air.
    lifted: [usize; 4],
}

/// Lets it take up the command for two seconds, and then looks at it for some more.
fn watch(stage: &mut Stage, dog: EntityId, command: Command, seconds: usize) -> Walk {
    stage.command(dog, command);
    stage.run(20);
    let start = stage.position(dog);
    let mut walk =
        Walk { velocity: Vector3::zeros(), least_up: 1.0, height: [f64::INFINITY, 0.0], lifted: [0; 4] };
    for _ in 0..seconds * 10 {
        stage.run(1);
        let body = stage.quadruped(dog);
        assert_eq!(body.footing(), Footing::Upright);
        let height = body.trunk_height();
        walk.height = [walk.height[0].min(height), walk.height[1].max(height)];
        for (lifted, load) in walk.lifted.iter_mut().zip(body.readings().feet) {
            *lifted += usize::from(load == 0.0);
        }
        walk.least_up = walk.least_up.min(stage.up(dog));
    }
    walk.velocity = (stage.position(dog) - start) / seconds as f64;
    walk
}

#[test]
fn it_stands_still_on_four_feet_that_carry_its_weight() {
    let mut stage = Stage::new();
    let dog = stage.legged_dog(at(1.0, 2.0, 0.5));
    stage.run(20);
    let start = stage.position(dog);
    stage.run(50);
    assert!((stage.position(dog) - start).norm() < 0.005);
    let body = stage.quadruped(dog);
    let (readings, weight) = (body.readings(), body.config().model.mass() * 9.81);
    let borne: f64 = readings.feet.iter().sum();
    assert!((borne - weight).abs() < 0.02 * weight, "{borne} N of {weight} N");
    assert!(readings.feet.iter().all(|load| *load > 0.15 * weight), "{:?}", readings.feet);
    let felt = readings.imu.acceleration;
    // The trunk hangs its nose by less than a degree.
    assert!((felt - Vector3::z() * 9.81).norm() < 0.17, "{felt}");
    let standing = body.config().model.standing_height();
    assert!((body.trunk_height() - standing).abs() < 0.01, "{} of {standing}", body.trunk_height());
    assert!((yaw_of(stage.world.entity(dog).unwrap().pose) - 0.5).abs() < 0.02);
}

#[test]
fn it_walks_for_a_minute_as_fast_as_it_is_told() {
    for speed in [0.5, 0.75, 1.0] {
        let mut stage = Stage::new();
        let dog = stage.legged_dog(at(0.0, 0.0, 0.0));
        let walk = watch(&mut stage, dog, forward(speed), minute());
        println!("{speed} m/s: {walk:?}");
        assert!((walk.velocity.x - speed).abs() < 0.1 * speed, "{walk:?}");
        assert!(walk.velocity.y.abs() < 0.02, "it keeps its heading: {walk:?}");
        assert!(walk.least_up > 0.98, "{walk:?}");
        let standing = stage.quadruped(dog).config().model.standing_height();
        assert!(walk.height[0] > standing - 0.02 && walk.height[1] < standing + 0.02, "{walk:?}");
        // It steps: a foot swings for 45 % of the time.
        let looks = (minute() * 10) as f64;
        for lifted in walk.lifted {
            assert!((0.2..0.6).contains(&(lifted as f64 / looks)), "{walk:?}");
        }
    }
}

#[test]
fn it_walks_backward_and_aside_and_turns() {
    let mut stage = Stage::new();
    let dog = stage.legged_dog(at(0.0, 0.0, 0.0));
    let back = watch(&mut stage, dog, forward(-0.5), 6);
    assert!((back.velocity.x + 0.5).abs() < 0.05 && back.velocity.y.abs() < 0.03, "{back:?}");
    let aside = watch(&mut stage, dog, Command { lateral: 0.3, ..Command::default() }, 6);
    assert!((aside.velocity.y - 0.3).abs() < 0.04 && aside.velocity.x.abs() < 0.03, "{aside:?}");
    stage.command(dog, Command { turning: 0.8, ..Command::default() });
    stage.run(20);
    let (place, mut turned) = (stage.position(dog), 0.0);
    for _ in 0..50 {
        stage.run(1);
        turned += stage.world.entity(dog).unwrap().twist.angular.z * 0.1;
    }
    assert!((turned / 5.0 - 0.8).abs() < 0.08, "{turned} rad in 5 s");
    assert!((stage.position(dog) - place).norm() < 0.1, "it turns on the spot");
}

#[test]
fn it_climbs_ten_and_twenty_degrees_and_comes_down_again() {
    for degrees in [10.0f64, 20.0] {
        let (mut stage, slope) = (Stage::new(), degrees.to_radians());
        let (pose, shape) = ramp(0.6, slope);
        stage.spawn(EntityKind::Building, pose, shape);
        let dog = stage.legged_dog(at(0.0, 0.0, 0.0));
        stage.command(dog, forward(0.5));
        stage.run(40);
        let up = watch(&mut stage, dog, forward(0.5), 8);
        let speed = ops::hypot(up.velocity.x, up.velocity.z);
        println!("{degrees}° up: {speed:.3} m/s, {up:?}");
        assert!((up.velocity.z / up.velocity.x - ops::tan(slope)).abs() < 0.02, "{up:?}");
        assert!((0.35..0.6).contains(&speed), "{speed} m/s along the slope");
        assert!(up.least_up > ops::cos(slope) - 0.05, "it lies along the slope: {up:?}");
        let down = watch(&mut stage, dog, forward(-0.5), 4);
        assert!(down.velocity.x < -0.35 && down.velocity.z < 0.0, "{down:?}");
    }
}

#[test]
fn it_takes_steps_of_five_and_ten_centimetres_up_and_down() {
    for height in [0.05, 0.1] {
        let mut stage = Stage::new();
        stage.building(2.5, 0.0, (3.0, 4.0, height));
        let dog = stage.legged_dog(at(0.0, 0.0, 0.0));
        stage.command(dog, forward(0.5));
        let mut highest = 0.0f64;
        for _ in 0..120 {
            stage.run(1);
            assert_eq!(stage.quadruped(dog).footing(), Footing::Upright);
            assert!(stage.up(dog) > 0.9, "{}", stage.up(dog));
            highest = highest.max(stage.position(dog).z);
        }
        println!("step of {height} m: {:?}", stage.position(dog));
        assert!((highest - height).abs() < 0.03, "{highest}");
        let place = stage.position(dog);
        assert!(place.x > 4.9 && place.y.abs() < 0.3 && place.z.abs() < 0.02, "{place}");
    }
}

#[test]
fn pushed_from_any_side_it_steps_and_stands_again() {
    for (x, y) in [(0.0, 0.45), (0.0, -0.45), (0.75, 0.0), (-0.75, 0.0)] {
        for speed in [0.0, 0.5] {
            let mut stage = Stage::new();
            let dog = stage.legged_dog(at(0.0, 0.0, 0.0));
            stage.command(dog, forward(speed));
            stage.run(20);
            let middle = stage.position(dog);
            let from = Point3::new(middle.x + x, middle.y + y, 0.2);
            let push = Vector3::new(-x, -y, 0.0).normalize() * 3.0 + Vector3::z() * 0.4;
            // 9 N s on 12.7 kg.
            let ball = stage.ball(from, push + Vector3::x() * speed, 3.0);
            stage.run(4);
            assert!(stage.contacts.iter().any(|event| format!("{event:?}").contains(&format!("{ball:?}"))));
            stage.run(40);
            assert_eq!(stage.quadruped(dog).footing(), Footing::Upright, "from {x}, {y} at {speed} m/s");
            assert!(stage.up(dog) > 0.97, "from {x}, {y} at {speed} m/s: {}", stage.up(dog));
            let height = stage.quadruped(dog).trunk_height();
            assert!(height > 0.28, "from {x}, {y} at {speed} m/s: {height}");
        }
    }
}

#[test]
fn it_looks_up_and_down_with_its_trunk() {
    let mut stage = Stage::new();
    let dog = stage.legged_dog(at(0.0, 0.0, 0.0));
    let nose = |stage: &Stage| ops::asin((stage.world.entity(dog).unwrap().pose.rotation * Vector3::x()).z);
    stage.tell(dog, Action::LookUp { angle: 0.25 });
    stage.run(20);
    assert!((nose(&stage) - 0.25).abs() < 0.05, "{}", nose(&stage));
    stage.tell(dog, Action::LookDown { angle: 0.5 });
    stage.run(20);
    assert!((nose(&stage) + 0.25).abs() < 0.05, "{}", nose(&stage));
    assert!(stage.events.is_empty(), "{:?}", stage.events);
}

#[test]
fn single_steps_and_turns_end_where_they_should() {
    let mut stage = Stage::new();
    let dog = stage.legged_dog(at(0.0, 0.0, 0.0));
    stage.tell(dog, Action::Step { direction: StepDirection::Left, distance: 0.5 });
    stage.run(50);
    let place = stage.position(dog);
    assert!((place - Point3::new(0.0, 0.5, 0.0)).norm() < 0.06, "{place}");
    stage.tell(dog, Action::Rotate { angle: FRAC_PI_2 });
    stage.run(50);
    let yaw = yaw_of(stage.world.entity(dog).unwrap().pose);
    assert!((yaw - FRAC_PI_2).abs() < 0.06, "{yaw}");
    stage.tell(dog, Action::MoveForward { speed: 0.5 });
    stage.run(50);
    stage.tell(dog, Action::Stop);
    stage.run(30);
    let there = stage.position(dog);
    assert!((1.9..2.8).contains(&(there.y - place.y)), "{there}");
    assert!(stage.velocity(dog).norm() < 0.02, "it has stopped: {}", stage.velocity(dog));
}

#[test]
fn it_lies_down_and_stands_up() {
    let mut stage = Stage::new();
    let dog = stage.legged_dog(at(0.0, 0.0, 0.0));
    stage.quadruped_mut(dog).lie_down();
    stage.run(20);
    assert!(stage.quadruped(dog).trunk_height() < 0.13, "{}", stage.quadruped(dog).trunk_height());
    assert!(stage.velocity(dog).norm() < 0.1);
    stage.tell(dog, Action::MoveForward { speed: 0.5 });
    stage.run(60);
    assert!(stage.position(dog).x > 0.8, "an order to move lets it rise first: {}", stage.position(dog));
    assert!(stage.events.is_empty(), "{:?}", stage.events);
}

#[test]
fn its_joints_are_led_one_by_one() {
    let mut stage = Stage::new();
    let dog = stage.legged_dog(at(0.0, 0.0, 0.0));
    let mut wanted: [[JointCommand; 3]; 4] = Default::default();
    for leg in &mut wanted {
        for (joint, angle) in leg.iter_mut().zip([0.0, 1.1, -2.2]) {
            *joint = JointCommand { angle, stiffness: 150.0, damping: 3.0, ..JointCommand::default() };
        }
    }
    stage.quadruped_mut(dog).control_joints(wanted).unwrap();
    stage.run(15);
    for leg in stage.quadruped(dog).readings().joints {
        for (reading, angle) in leg.iter().zip([0.0, 1.1, -2.2]) {
            assert!((reading.angle - angle).abs() < 0.1, "{reading:?}, {angle}");
            let asked = 150.0 * (angle - reading.angle) - 3.0 * reading.speed;
            assert!((reading.torque - asked).abs() < 1e-9, "{reading:?}");
        }
    }
    // A motor gives no more than it has, whatever it is asked for.
    wanted[0][2].torque = 1e4;
    stage.quadruped_mut(dog).control_joints(wanted).unwrap();
    stage.run(1);
    assert_eq!(stage.quadruped(dog).readings().joints[0][2].torque, 36.0);
    wanted[1][1].angle = f64::NAN;
    assert!(stage.quadruped_mut(dog).control_joints(wanted).is_err());
    stage.quadruped_mut(dog).release_joints();
    stage.run(100);
    assert!(stage.quadruped(dog).trunk_height() > 0.27 && stage.up(dog) > 0.99);
}

/// What the tests above see is due to the motors: without torque it sinks to the ground.
#[test]
fn without_its_motors_it_sinks_down() {
    let mut stage = Stage::new();
    let dog = stage.legged_dog(at(0.0, 0.0, 0.0));
    stage.run(10);
    stage.quadruped_mut(dog).control_joints([[JointCommand::default(); 3]; 4]).unwrap();
    stage.run(15);
    assert!(stage.position(dog).z < -0.1, "{}", stage.position(dog).z);
}

/// What a dog will feel at the start of the coming substep of its trunk; its joints and feet tell that afterwards.
fn trunk_of(stage: &Stage, dog: EntityId) -> QuadrupedState {
    let state = stage.physics.state(dog).unwrap();
    let arm = state.pose.rotation * Vector3::z() * QuadrupedConfig::default().model.standing_height();
    let trunk = Pose::from_parts((state.pose.translation.vector + arm).into(), state.pose.rotation);
    let (linear, angular) = (state.twist.linear + state.twist.angular.cross(&arm), state.twist.angular);
    let (angles, speeds, loads) = ([[0.0; 3]; 4], [[0.0; 3]; 4], [0.0; 4]);
    QuadrupedState { trunk, linear, angular, center: Vector3::zeros(), angles, speeds, loads }
}

/// The control that is lent to bodies elsewhere is the one that leads the body here, told what that feels.
#[test]
fn its_control_alone_gives_the_torques_that_it_gives_here() {
    // Every step is one substep, in which the control is asked once.
    let mut stage = Stage::with(PhysicsConfig { substeps: 1, ..PhysicsConfig::default() });
    let dog = stage.legged_dog(at(1.0, 2.0, 0.5));
    let mut control = QuadrupedControl::new(QuadrupedConfig::default()).unwrap();
    let command = Command { forward: 0.6, turning: 0.3, ..Command::default() };
    let mut greatest = 0.0f64;
    for turn in 0..600 {
        if turn == 100 {
            stage.command(dog, command);
            control.command(command);
        }
        let mut felt = trunk_of(&stage, dog);
        stage.tick(0.005);
        let readings = stage.quadruped(dog).readings();
        felt.angles = readings.joints.map(|leg| leg.map(|joint| joint.angle));
        felt.speeds = readings.joints.map(|leg| leg.map(|joint| joint.speed));
        felt.loads = readings.feet;
        let center = control.config().model.center_of_mass(&felt.angles);
        felt.center = (felt.trunk * Point3::from(center)).coords;
        let torques = control.torques(&felt, &|_| Some(0.0), 9.81, 0.005).unwrap();
        let given = readings.joints.map(|leg| leg.map(|joint| joint.torque));
        for (ours, theirs) in torques.as_flattened().iter().zip(given.as_flattened()) {
            assert!((ours - theirs).abs() < 1e-6, "turn {turn}: {torques:?}, {given:?}");
            greatest = greatest.max(ours.abs());
        }
    }
    assert!(greatest > 10.0, "it has walked: {greatest}");
    assert_eq!(control.footing(), Footing::Upright);
}

#[test]
fn a_control_refuses_what_no_body_feels() {
    let mut control = QuadrupedControl::new(QuadrupedConfig::default()).unwrap();
    let angles = control.config().model.standing_angles();
    let felt = QuadrupedState {
        trunk: Pose::translation(0.0, 0.0, 0.3),
        linear: Vector3::zeros(),
        angular: Vector3::zeros(),
        center: Vector3::new(0.0, 0.0, 0.25),
        angles,
        speeds: [[0.0; 3]; 4],
        loads: [30.0; 4],
    };
    let refused = |felt: &QuadrupedState, gravity, dt| {
        let refusal = control.clone().torques(felt, &|_| None, gravity, dt).unwrap_err();
        assert!(matches!(refusal, PhysicsError::Config { .. }));
        refusal.to_string()
    };
    assert!(refused(&felt, f64::NAN, 0.005).contains("gravity"));
    assert!(refused(&felt, 9.81, 0.1).contains("dt"));
    let mut mad = felt;
    mad.speeds[3][1] = f64::INFINITY;
    assert!(refused(&mad, 9.81, 0.005).contains("finite"));
    let torques = control.torques(&felt, &|_| Some(f64::NAN), 9.81, 0.005).unwrap();
    assert!(torques.as_flattened().iter().all(|torque| torque.is_finite()));
}
