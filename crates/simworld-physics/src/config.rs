//! The settings of a physics world.

use serde::{Deserialize, Serialize};
use simworld_core::asset::Material;

use crate::error::{PhysicsError, check_range};

/// How finely and in what surroundings bodies move.
///
/// ```
/// use simworld_physics::{PhysicsConfig, PhysicsDynamics};
/// let on_the_moon = PhysicsConfig { gravity: 1.62, ..PhysicsConfig::default() };
/// assert!(PhysicsDynamics::new(on_the_moon).is_ok());
/// let absurd = PhysicsConfig { substeps: 0, ..PhysicsConfig::default() };
/// assert!(PhysicsDynamics::new(absurd).unwrap_err().to_string().contains("substeps"));
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PhysicsConfig {
    /// Physics steps within one step of the world, at least, 1 to 100. At the usual 0.1 s a step, 2 suits walkers;
    /// with vehicles it is 6 or more whatever stands here, and stacks of boxes stand better on 6.
    pub substeps: u32,
    /// Downward acceleration, m/s², 0 to 100.
    pub gravity: f64,
    /// Half the side of the square ground whose surface is z = 0, m, 1 to 1e6; beyond it bodies fall.
    pub ground_half_extent: f64,
    /// What the ground is made of.
    pub ground: Material,
    /// Bodies farther than this from every point of interest move in reduced detail, m, 1 to 1e6.
    pub detail_radius: f64,
    /// Where [points of interest](crate::PhysicsDynamics::set_interest) are named, fixed solids farther than this from all of them, in the
    /// plane, and from every body leave the engine, m, 1 to 1e6; without it, or without points, all of them are in it. Bodies move the same way
    /// either way.
    pub streaming_radius: Option<f64>,
    /// The steepest slope a person walks up, radians, 0 to 1.4. The default of 45° is the usual limit of
    /// character controllers.
    pub max_slope: f64,
    /// The highest step a person takes without being told, m, 0 to 1. Kerbs and stairs rise 0.12 to 0.18 m.
    pub step_height: f64,
    /// Traffic within this distance of a body of this physics, in the plane, becomes solid for it, m, 1 to 1e4.
    /// Rays meet all traffic at any distance.
    pub mirror_radius: f64,
    /// From this number of bodies on, their queries are spread over rayon's threads, at least 1. The results are
    /// the same bits either way.
    pub parallel_threshold: usize,
}

impl Default for PhysicsConfig {
    fn default() -> Self {
        Self {
            substeps: 2,
            gravity: 9.81,
            ground_half_extent: 1e5,
            ground: Material::Asphalt,
            detail_radius: 150.0,
            streaming_radius: Some(250.0),
            max_slope: std::f64::consts::FRAC_PI_4,
            step_height: 0.25,
            mirror_radius: 15.0,
            parallel_threshold: 48,
        }
    }
}

impl PhysicsConfig {
    /// Checks every field.
    ///
    /// # Errors
    /// The first field out of range, with what is allowed.
    pub fn validate(&self) -> Result<(), PhysicsError> {
        let check = |field, value, range, allowed| check_range("PhysicsConfig", field, value, range, allowed);
        check("substeps", f64::from(self.substeps), 1.0..=100.0, "1 to 100")?;
        check("gravity", self.gravity, 0.0..=100.0, "0 to 100 m/s²")?;
        check("ground_half_extent", self.ground_half_extent, 1.0..=1e6, "1 to 1e6 m")?;
        check("detail_radius", self.detail_radius, 1.0..=1e6, "1 to 1e6 m")?;
        check("streaming_radius", self.streaming_radius.unwrap_or(1.0), 1.0..=1e6, "1 to 1e6 m")?;
        check("max_slope", self.max_slope, 0.0..=1.4, "0 to 1.4 rad")?;
        check("step_height", self.step_height, 0.0..=1.0, "0 to 1 m")?;
        check("mirror_radius", self.mirror_radius, 1.0..=1e4, "1 to 1e4 m")?;
        check("parallel_threshold", self.parallel_threshold as f64, 1.0..=f64::MAX, "at least 1")
    }
}
