//! A wheel on the road: its spring, its spin, and the slip that builds up as it rolls.
//!
//! Slip follows the motion of the contact patch through a deflection of the tyre with a relaxation length (Pacejka
//! 2012, section 7.2), which also holds a standing vehicle: the tyre is then a spring. Wheel spin is a hundred times
//! faster than the vehicle and is solved implicitly, so that a step of 1/60 s is stable at any speed.

use serde::{Deserialize, Serialize};
use simworld_core::geometry::Vector3;

use super::parameters::{AxleParameters, SlipControl};
use super::tyre::PatchForce;

/// Speed below which the tyre's own damping counts and its deflection stays short of sliding, m/s.
const CRAWL: f64 = 1.5;
/// Damping ratio of the deflection of a standing tyre.
const CRAWL_DAMPING: f64 = 0.3;
/// How much of the peak an anti-lock brake or traction control asks for.
const CONTROLLED_SHARE: f64 = 0.97;
/// Stiffness of the bump stop as a multiple of the spring's.
const BUMP_STOP: f64 = 10.0;

/// What a wheel stands on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Ground {
    /// Way along the strut from its upper end, m.
    pub(crate) distance: f64,
    /// Normal of the surface, world frame.
    pub(crate) normal: Vector3,
    /// Grip as a share of dry asphalt.
    pub(crate) grip: f64,
    /// Velocity of the surface, world frame, m/s.
    pub(crate) velocity: Vector3,
}

/// The state of a wheel.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Wheel {
    /// Body frame, m: where it is along and across the vehicle.
    pub(crate) x: f64,
    pub(crate) y: f64,
    /// Load at rest, N.
    pub(crate) static_load: f64,
    /// Angular speed, rad/s, positive forward.
    pub(crate) spin: f64,
    /// Deflection of the tyre along and across the wheel, m.
    pub(crate) deflection: [f64; 2],
    /// How far it is up from its place at rest, m.
    pub(crate) compression: f64,
    /// Load in the last step, N.
    pub(crate) load: f64,
    /// Force in the last step, N.
    pub(crate) force: PatchForceState,
    /// What the last look found under it.
    pub(crate) ground: Option<Ground>,
}

/// [`PatchForce`] as it is saved.
pub(crate) type PatchForceState = [f64; 2];

/// How the contact patch moves over the ground, in its own frame, m/s.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PatchMotion {
    pub(crate) along: f64,
    pub(crate) across: f64,
}

/// What turns a wheel and what holds it, N m.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Torques {
    pub(crate) drive: f64,
    /// Not negative.
    pub(crate) brake: f64,
    /// Share of the engine's inertia, kg m².
    pub(crate) inertia: f64,
}

impl Wheel {
    pub(crate) fn new(x: f64, y: f64, static_load: f64) -> Self {
        Self {
            x,
            y,
            static_load,
            spin: 0.0,
            deflection: [0.0; 2],
            compression: 0.0,
            load: static_load,
            force: [0.0; 2],
            ground: None,
        }
    }

    /// How far the wheel hangs down from its place at rest when it is in the air, m.
    pub(crate) fn droop(&self, axle: &AxleParameters) -> f64 {
        self.static_load / axle.spring_rate
    }

    /// Force of spring, damper and bump stop along the strut, N, for a rate of compression, m/s.
    pub(crate) fn spring_force(&self, axle: &AxleParameters, rate: f64) -> f64 {
        let damping = if rate > 0.0 { axle.compression_damping } else { axle.rebound_damping };
        let stop = (self.compression - axle.travel).max(0.0) * BUMP_STOP * axle.spring_rate;
        self.static_load + axle.spring_rate * self.compression + damping * rate + stop
    }

    /// Rolls for `dt` s under its load and returns the force of the road, N, in the frame of the patch.
    pub(crate) fn roll(
        &mut self,
        axle: &AxleParameters,
        control: SlipControl,
        patch: PatchMotion,
        torques: Torques,
        dt: f64,
    ) -> PatchForce {
        let (tyre, radius, load) = (&axle.tyre, axle.wheel_radius, self.load);
        let grip = self.ground.map_or(0.0, |ground| ground.grip);
        if load <= 0.0 || grip <= 0.0 {
            return self.fly(axle, torques, dt);
        }
        let speed = patch.along.abs();
        let fade = [1.0 + dt * speed / tyre.relaxation_x, 1.0 + dt * speed / tyre.relaxation_y];
        self.deflection[1] = (self.deflection[1] + dt * patch.across) / fade[1];
        let limits = self.deflection_limits(axle, grip, speed);
        self.deflection[1] = self.deflection[1].clamp(-limits[1], limits[1]);
        let tangent = self.deflection[1] / tyre.relaxation_y;

        let slip_after = |spin: f64| {
            let ahead = self.deflection[0] + dt * (spin * radius - patch.along);
            (ahead / fade[0]).clamp(-limits[0], limits[0]) / tyre.relaxation_x
        };
        let guess = slip_after(self.spin);
        let stiffness = if guess.abs() > 1e-6 {
            tyre.force(load, grip, guess, tangent).x / guess
        } else {
            tyre.slip_stiffness(load)
        };
        let Torques { drive, brake, inertia } = self.controlled(axle, control, grip, torques);
        let inertia = (axle.wheel_inertia + inertia) / dt;
        let coupling = radius * stiffness / (tyre.relaxation_x * fade[0]);
        let whole = inertia + coupling * radius * dt;
        let free = (inertia * self.spin + drive - coupling * (self.deflection[0] - dt * patch.along)) / whole;
        let held = (brake + tyre.rolling_resistance * load * radius) / whole;
        self.spin = free.signum() * (free.abs() - held).max(0.0);
        let slip = slip_after(self.spin);
        self.deflection[0] = slip * tyre.relaxation_x;
        let force = tyre.force(load, grip, slip, tangent);
        let force = self.damped(axle, grip, force, patch);
        self.force = [force.x, force.y];
        force
    }

    /// In the air.
    fn fly(&mut self, axle: &AxleParameters, torques: Torques, dt: f64) -> PatchForce {
        self.deflection = [0.0; 2];
        self.force = [0.0; 2];
        let inertia = (axle.wheel_inertia + torques.inertia) / dt;
        let free = self.spin + torques.drive / inertia;
        self.spin = free.signum() * (free.abs() - torques.brake / inertia).max(0.0);
        PatchForce::default()
    }

    /// How far the tyre deflects at most, m: to the slip of the peak when it stands, well into sliding when it rolls.
    fn deflection_limits(&self, axle: &AxleParameters, grip: f64, speed: f64) -> [f64; 2] {
        let tyre = &axle.tyre;
        let rolling = (speed / CRAWL).min(1.0);
        let peak = if rolling < 1.0 { tyre.slip_of_peak(self.load, grip) } else { 0.0 };
        let between = |most: f64| peak + (most - peak).max(0.0) * rolling;
        [tyre.relaxation_x * between(1.0), tyre.relaxation_y * between(1.5)]
    }

    /// Torques as anti-lock brakes and traction control let them through: no more than the road takes up beside the
    /// present lateral force.
    fn controlled(
        &self,
        axle: &AxleParameters,
        control: SlipControl,
        grip: f64,
        torques: Torques,
    ) -> Torques {
        if control == SlipControl::None {
            return torques;
        }
        let tyre = &axle.tyre;
        let lateral = self.force[1] / tyre.peak_y(self.load, grip);
        let left = (1.0 - lateral * lateral).max(0.05).sqrt();
        let most = CONTROLLED_SHARE * left * tyre.peak_x(self.load, grip) * axle.wheel_radius;
        // A wheel that slid past the peak is let go until it rolls again.
        let slid = self.deflection[0].abs() > 1.5 * tyre.relaxation_x * tyre.slip_of_peak(self.load, grip);
        let most = if slid { 0.3 * most } else { most };
        Torques { drive: torques.drive.clamp(-most, most), brake: torques.brake.min(most), ..torques }
    }

    /// With the damping of a standing tyre, within what the road takes up.
    fn damped(&self, axle: &AxleParameters, grip: f64, force: PatchForce, patch: PatchMotion) -> PatchForce {
        let share = 1.0 - patch.along.abs() / CRAWL;
        if share <= 0.0 {
            return force;
        }
        let tyre = &axle.tyre;
        let mass = self.load / 9.81;
        let damping = |stiffness: f64| 2.0 * CRAWL_DAMPING * share * (stiffness * mass).sqrt();
        let along = damping(tyre.slip_stiffness(self.load) / tyre.relaxation_x);
        let across = damping(tyre.cornering_stiffness(self.load) / tyre.relaxation_y);
        let creep = patch.along - self.spin * axle.wheel_radius;
        let (x, y) = (force.x - along * creep, force.y - across * patch.across);
        let (share_x, share_y) = (x / tyre.peak_x(self.load, grip), y / tyre.peak_y(self.load, grip));
        let total = (share_x * share_x + share_y * share_y).sqrt().max(1.0);
        PatchForce { x: x / total, y: y / total }
    }
}
