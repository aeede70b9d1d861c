//! The control of a quadruped for a body that no physics of ours holds: one in another engine, or a real one.

use simworld_core::geometry::{Point3, Pose, Vector3};
use simworld_core::scene::Footing;

use super::control::Field;
use super::{Command, Quadruped, QuadrupedConfig, QuadrupedState, Readings};
use crate::error::{PhysicsError, check_range};

/// The control of a [`Quadruped`] without its body: from what a body feels of itself to the torques of its motors.
///
/// It stands, trots, lies down, turns over and gets up as the body in our physics does, which is led by the same code. The body is
/// elsewhere, as [`QuadrupedModel::description`](super::QuadrupedModel::description) has it; the module `robot::mjcf` (a feature)
/// writes that to a file for `MuJoCo`.
///
/// ```
/// use simworld_core::geometry::{Point3, Pose, Vector3};
/// use simworld_physics::{Command, QuadrupedConfig, QuadrupedControl, QuadrupedState};
///
/// let mut control = QuadrupedControl::new(QuadrupedConfig::default())?;
/// control.command(Command { forward: 0.5, ..Command::default() });
/// let model = &control.config().model;
/// let (trunk, angles) = (Pose::translation(0.0, 0.0, model.standing_height()), model.standing_angles());
/// let felt = QuadrupedState {
///     trunk,
///     linear: Vector3::zeros(),
///     angular: Vector3::zeros(),
///     center: (trunk * Point3::from(model.center_of_mass(&angles))).coords,
///     angles,
///     speeds: [[0.0; 3]; 4],
///     loads: [30.0; 4],
/// };
/// // Every 5 ms, on level ground:
/// let torques = control.torques(&felt, &|_| Some(0.0), 9.81, 0.005)?;
/// // All four still stand, and the knees bear the weight.
/// assert!(torques.iter().all(|[_, _, knee]| (3.0..8.0).contains(knee)), "{torques:?}");
/// # Ok::<(), simworld_physics::PhysicsError>(())
/// ```
#[derive(Clone, Debug)]
pub struct QuadrupedControl {
    /// A body that is never put on legs of ours.
    dog: Quadruped,
}

impl QuadrupedControl {
    /// The control of a body that stands, with nothing to do.
    ///
    /// # Errors
    /// A setting out of range.
    pub fn new(config: QuadrupedConfig) -> Result<Self, PhysicsError> {
        let mut dog = Quadruped::new(Pose::identity(), config)?;
        dog.motion.is_fresh = true;
        Ok(Self { dog })
    }

    /// The data of the body.
    pub fn config(&self) -> &QuadrupedConfig {
        self.dog.config()
    }

    /// Goes as commanded from now on; values beyond what it can do are carried out as far as it can.
    pub fn command(&mut self, command: Command) {
        self.dog.command(command);
    }

    /// Lies down on folded legs, and stays so until [`stand_up`](Self::stand_up) or another command.
    pub fn lie_down(&mut self) {
        self.dog.lie_down();
    }

    /// Stands up if it lies.
    pub fn stand_up(&mut self) {
        self.dog.stand_up();
    }

    /// How it fares on its feet, as of the last torques.
    pub fn footing(&self) -> Footing {
        self.dog.footing_of_task()
    }

    /// What was felt when the last torques were asked for, and those torques.
    pub fn readings(&self) -> &Readings {
        self.dog.readings()
    }

    /// The torques of the motors for the coming `dt` s, N m, within what they give; legs as in [`LEGS`](super::LEGS), the joints of
    /// each as abduction, thigh and knee. To be asked for every `dt` s, with what is felt at its start.
    ///
    /// `ground` tells how high the ground is below a place, m, if it is known there and a foot can stand on it; `gravity` is in m/s²,
    /// 0 to 100, and `dt` 1e-4 to 0.0051 s.
    ///
    /// # Errors
    /// A number that is not finite or out of range; the control is as before then.
    pub fn torques(
        &mut self,
        felt: &QuadrupedState,
        ground: &dyn Fn(&Point3) -> Option<f64>,
        gravity: f64,
        dt: f64,
    ) -> Result<[[f64; 3]; 4], PhysicsError> {
        check_range("QuadrupedControl", "gravity", gravity, 0.0..=100.0, "0 to 100 m/s²")?;
        check_range("QuadrupedControl", "dt", dt, 1e-4..=0.0051, "1e-4 to 0.0051 s")?;
        if !felt.is_finite() {
            let (config, field, allowed) = ("QuadrupedState", "felt", "finite numbers");
            return Err(PhysicsError::Config { config, field, value: f64::NAN, allowed });
        }
        if self.dog.motion.is_fresh {
            self.dog.motion.before = felt.linear;
        }
        let look = |place: &Vector3| ground(&Point3::from(*place)).filter(|height| height.is_finite());
        Ok(self.dog.lead_motors(felt, &Field { look: &look, gravity, dt }))
    }
}
