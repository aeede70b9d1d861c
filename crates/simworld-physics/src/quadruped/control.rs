//! From what a quadruped feels to the torques of its motors.

use nalgebra::UnitQuaternion;
use simworld_core::geometry::{Pose, Vector2, Vector3};
use simworld_core::ops;

use super::articulation::PerJoint;
use super::balance::{Aim, hold};
use super::gait::{Gait, Look, Way};
use super::recovery::Task;
use super::{Command, Quadruped, QuadrupedState};

/// Stiffness and damping of a joint that leads a foot through the air, N m/rad and N m s/rad.
const SWING: [f64; 2] = [55.0, 1.3];
/// Damping of a joint of a leg that stands, N m s/rad.
const STANCE: f64 = 0.25;
/// No joint is led faster than this, rad/s.
const QUICK: f64 = 25.0;
/// The greatest stiffness and damping of a joint that is led from outside, N m/rad and N m s/rad.
const GAINS: [f64; 2] = [200.0, 3.0];
/// How fast commands are taken up, m/s² and rad/s².
const TAKE_UP: [f64; 2] = [1.2, 4.0];
/// How far the body may lag behind where it is to be, m and radians.
const LAG: [f64; 2] = [0.06, 0.3];
/// Time in which what is left of a step or a turn is gone, s, and when it is done, m or radians.
const APPROACH: f64 = 0.4;
const DONE: f64 = 0.02;

/// Around a quadruped, as its control sees it.
pub(super) struct Field<'a> {
    pub(super) look: Look<'a>,
    pub(super) gravity: f64,
    pub(super) dt: f64,
}

/// What it follows while it walks.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub(super) struct Walk {
    pub(super) gait: Gait,
    /// The command as far as it is taken up.
    pub(super) command: Command,
    /// The heading it is to have, radians, and where it is to be, m.
    pub(super) heading: f64,
    pub(super) place: Vector2,
}

/// The heading of a trunk, radians.
pub(super) fn heading_of(trunk: &Pose) -> f64 {
    let ahead = trunk.rotation * Vector3::x();
    ops::atan2(ahead.y, ahead.x)
}

impl Quadruped {
    /// Takes in what it feels; the torques of the motors for the coming substep, within what they give, are returned.
    pub(super) fn lead_motors(&mut self, sensed: &QuadrupedState, field: &Field<'_>) -> PerJoint {
        if std::mem::take(&mut self.motion.is_fresh) {
            self.start_walk(sensed);
        }
        let torques = self.think(sensed, field);
        self.read(sensed, &torques, field.gravity, field.dt);
        torques
    }

    fn think(&mut self, sensed: &QuadrupedState, field: &Field<'_>) -> PerJoint {
        let asked = match self.motion.joints {
            Some(joints) => std::array::from_fn(|leg| {
                std::array::from_fn(|joint| {
                    joints[leg][joint].torque_at(sensed.angles[leg][joint], sensed.speeds[leg][joint], GAINS)
                })
            }),
            None => self.act_on_task(sensed, field),
        };
        self.limited(&asked)
    }

    fn limited(&self, asked: &PerJoint) -> PerJoint {
        let most = self.config.model.torques;
        asked.map(|leg| {
            std::array::from_fn(|joint| {
                if leg[joint].is_finite() { leg[joint].clamp(-most[joint], most[joint]) } else { 0.0 }
            })
        })
    }

    /// Where the feet are, world frame, m.
    pub(super) fn feet(&self, sensed: &QuadrupedState) -> [Vector3; 4] {
        std::array::from_fn(|leg| {
            let foot = self.config.model.leg(leg).foot(&sensed.angles[leg]);
            (sensed.trunk * nalgebra::Point3::from(foot)).coords
        })
    }

    /// Begins to walk, or to stand, from where it is.
    pub(super) fn start_walk(&mut self, sensed: &QuadrupedState) {
        self.motion.walk = Walk {
            gait: Gait::standing(self.feet(sensed)),
            command: Command::default(),
            heading: heading_of(&sensed.trunk),
            place: sensed.center.xy(),
        };
        self.motion.task = Task::Walk;
    }

    /// Takes up commands and leads its feet and its trunk accordingly.
    pub(super) fn walk(&mut self, sensed: &QuadrupedState, field: &Field<'_>) -> PerJoint {
        let feet = self.feet(sensed);
        self.take_up(sensed, field.dt);
        let Walk { gait, command, heading, .. } = &mut self.motion.walk;
        let data = (&self.config.model, &self.config.gait);
        gait.advance(data, sensed, &feet, (command, *heading), field.look, field.dt);
        let gait = &self.motion.walk.gait;
        let ways: [Option<Way>; 4] =
            std::array::from_fn(|foot| gait.way(foot, &self.config.gait, &feet, field.dt));
        let bearing = std::array::from_fn(|foot| {
            (feet[foot] - sensed.center, if ways[foot].is_some() { 0.0 } else { 1.0 })
        });
        let mass = (self.config.model.mass(), field.gravity);
        let forces = hold(&self.aim(sensed), sensed, &bearing, &gait.normal(), mass);
        std::array::from_fn(|leg| match &ways[leg] {
            Some(way) => self.lead(leg, way, sensed),
            None => self.press(leg, &forces[leg], sensed),
        })
    }

    /// Moves the command that is followed towards the one that was given, and the place and heading with it.
    fn take_up(&mut self, sensed: &QuadrupedState, dt: f64) {
        let wanted = self.wanted(sensed, dt);
        let Walk { command, heading, place, gait } = &mut self.motion.walk;
        let towards = |is: f64, to: f64, rate: f64| is + (to - is).clamp(-rate * dt, rate * dt);
        command.forward = towards(command.forward, wanted.forward, TAKE_UP[0]);
        command.lateral = towards(command.lateral, wanted.lateral, TAKE_UP[0]);
        command.turning = towards(command.turning, wanted.turning, TAKE_UP[1]);
        command.pitch = towards(command.pitch, wanted.pitch, 0.6);
        command.crouch = towards(command.crouch, wanted.crouch, 0.2);
        let is = heading_of(&sensed.trunk);
        let ahead = ops::wrap_angle(*heading + command.turning * dt - is);
        *heading = ops::wrap_angle(is + ahead.clamp(-LAG[1], LAG[1]));
        let (sin, cos) = ops::sin_cos(*heading);
        let velocity = Vector2::new(
            cos * command.forward - sin * command.lateral,
            sin * command.forward + cos * command.lateral,
        );
        let lead = *place + velocity * dt - sensed.center.xy();
        let lead = lead * (LAG[0] / lead.norm().max(LAG[0]));
        *place = sensed.center.xy() + lead;
        if !gait.trots {
            // Who stands has its middle over its feet.
            let middle = gait.feet.iter().fold(Vector3::zeros(), |sum, foot| sum + foot.grip.coords) * 0.25;
            *place += (middle.xy() - *place) * (dt / 0.2).min(1.0);
        }
    }

    /// The command that follows from what it was told; what is left of steps and turns goes down by what was done.
    fn wanted(&mut self, sensed: &QuadrupedState, dt: f64) -> Command {
        let speeds = self.config.speeds;
        if let Some(command) = self.motion.command {
            return command.within(speeds);
        }
        let mut orders = self.cheap.orders();
        let mut wanted = Command { forward: orders.speed, pitch: self.motion.look, ..Command::default() };
        if orders.step != Vector3::zeros() {
            let back = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), -heading_of(&sensed.trunk));
            let done = (back * sensed.linear).component_mul(&Vector3::new(1.0, 1.0, 0.0)) * dt;
            orders.step -= done;
            if orders.step.norm() < DONE || orders.step.dot(&(orders.step + done)) < 0.0 {
                orders.step = Vector3::zeros();
            }
            let way = orders.step / APPROACH;
            let way = way * (orders.step_speed / way.norm().max(orders.step_speed));
            (wanted.forward, wanted.lateral) = (way.x, way.y);
        }
        if orders.turn != 0.0 {
            let done = sensed.angular.z * dt;
            let left = orders.turn - done;
            orders.turn = if left.abs() < DONE || left * orders.turn < 0.0 { 0.0 } else { left };
            wanted.turning = orders.turn / APPROACH;
        }
        self.cheap.set_orders(&orders);
        wanted.within(speeds)
    }

    /// Where trunk and centre of mass are to be.
    fn aim(&self, sensed: &QuadrupedState) -> Aim {
        let Walk { gait, command, heading, place } = &self.motion.walk;
        let model = &self.config.model;
        let trunk = sensed.trunk.translation.vector;
        let height = gait.height_below(&trunk) + model.standing_height() - model.foot_radius - command.crouch;
        let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), *heading);
        // The trunk lies along the slope under the feet.
        let slope = UnitQuaternion::rotation_between(&Vector3::z(), &gait.normal()).unwrap_or_default();
        let nose = UnitQuaternion::from_axis_angle(&Vector3::y_axis(), -command.pitch);
        let level = turn * Vector3::new(command.forward, command.lateral, 0.0);
        Aim {
            place: Vector3::new(place.x, place.y, height + sensed.center.z - trunk.z),
            velocity: Vector3::new(level.x, level.y, gait.rise.dot(&level.xy())),
            attitude: slope * turn * nose,
            turning: Vector3::z() * command.turning,
        }
    }

    /// Leads a foot through the air.
    fn lead(&self, leg: usize, (place, velocity): &Way, sensed: &QuadrupedState) -> [f64; 3] {
        let geometry = self.config.model.leg(leg);
        let foot = sensed.trunk.inverse_transform_point(&nalgebra::Point3::from(*place)).coords;
        let mut angles = geometry.reach(&foot);
        let arm = place - sensed.trunk.translation.vector;
        let over = velocity - sensed.linear - sensed.angular.cross(&arm);
        let over = sensed.trunk.rotation.inverse() * over;
        let jacobian = geometry.jacobian(&sensed.angles[leg]);
        let speeds = jacobian.try_inverse().map_or_else(Vector3::zeros, |inverse| inverse * over);
        std::array::from_fn(|joint| {
            let [low, high] = self.config.model.limits_of(leg, joint);
            angles[joint] = angles[joint].clamp(low, high);
            let missing = speeds[joint].clamp(-QUICK, QUICK) - sensed.speeds[leg][joint];
            SWING[0] * (angles[joint] - sensed.angles[leg][joint]) + SWING[1] * missing
        })
    }

    /// Presses a foot on the ground so that the ground answers with a force.
    pub(super) fn press(&self, leg: usize, force: &Vector3, sensed: &QuadrupedState) -> [f64; 3] {
        let force = sensed.trunk.rotation.inverse() * force;
        let jacobian = self.config.model.leg(leg).jacobian(&sensed.angles[leg]);
        let torque = -(jacobian.transpose() * force);
        std::array::from_fn(|joint| torque[joint] - STANCE * sensed.speeds[leg][joint])
    }
}
