//! The manoeuvres.

use simworld_core::action::Action;
use simworld_core::ops::{atan2, sin};

use super::{ProvingError, Run, STEP};
use crate::{RoadCondition, VehicleParameters};

const GRAVITY: f64 = 9.81;

/// Time from rest to a speed, m/s, at full throttle on a dry road, s; none if it is not reached in three minutes.
///
/// # Errors
/// A setting of the vehicle out of range.
pub fn acceleration_time(vehicle: &VehicleParameters, speed: f64) -> Result<Option<f64>, ProvingError> {
    let mut run = Run::new(vehicle, RoadCondition::Dry, 0.0)?;
    run.coast(0.5)?;
    run.tell(Action::Throttle { level: 1.0 })?;
    let mut before = run.speed();
    for step in 0..(180.0 / STEP) as u32 {
        run.step()?;
        let now = run.speed();
        if now >= speed {
            return Ok(Some((f64::from(step) + (speed - before) / (now - before)) * STEP));
        }
        before = now;
    }
    Ok(None)
}

/// Way from a speed, m/s, to rest under full braking, m; by the square of the speed at which the brake was pressed,
/// as road tests correct it. A vehicle that leaves its lane by two metres or does not stop in a minute has none.
///
/// # Errors
/// A setting of the vehicle out of range.
pub fn braking_distance(
    vehicle: &VehicleParameters,
    road: RoadCondition,
    speed: f64,
) -> Result<Option<f64>, ProvingError> {
    let mut run = Run::new(vehicle, road, speed)?;
    run.coast(0.5)?;
    let (start, entry) = (run.position(), run.speed());
    run.tell(Action::Brake { level: 1.0 })?;
    for _ in 0..(60.0 / STEP) as u32 {
        run.step()?;
        if run.speed() < 0.05 {
            let way = run.position() - start;
            let kept = way.y.abs() < 2.0 && run.tilt() < 0.5;
            return Ok(kept.then_some(way.x * (speed / entry) * (speed / entry)));
        }
    }
    Ok(None)
}

/// Speed at full throttle after two minutes, m/s.
///
/// # Errors
/// A setting of the vehicle out of range.
pub fn top_speed(vehicle: &VehicleParameters) -> Result<f64, ProvingError> {
    let mut run = Run::new(vehicle, RoadCondition::Dry, vehicle.powertrain.top_speed * 0.7)?;
    run.tell(Action::Throttle { level: 1.0 })?;
    run.coast(120.0)?;
    Ok(run.speed())
}

/// What a steady turn shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SteadyTurn {
    /// Steering angle of the front wheels, radians.
    pub steering: f64,
    /// m/s.
    pub speed: f64,
    /// rad/s.
    pub yaw_rate: f64,
    /// Tilt of the body, radians.
    pub tilt: f64,
    /// Steering beyond that of a slow turn of the same radius, by lateral acceleration, radians per g; positive is
    /// understeer.
    pub understeer: f64,
}

/// A turn to the left at a speed, m/s, that is steered until the lateral acceleration is `lateral` g.
///
/// # Errors
/// A setting of the vehicle out of range.
pub fn steady_turn(
    vehicle: &VehicleParameters,
    speed: f64,
    lateral: f64,
) -> Result<SteadyTurn, ProvingError> {
    let mut run = Run::new(vehicle, RoadCondition::Dry, speed)?;
    let length = vehicle.chassis.wheelbase;
    let mut steering = atan2(lateral * GRAVITY * length, speed * speed);
    let mut sums = [0.0; 4];
    let steps = (14.0 / STEP) as u32;
    let last = (2.0 / STEP) as u32;
    for step in 0..steps {
        run.hold_speed(speed)?;
        let reached = run.speed() * run.yaw_rate() / GRAVITY;
        steering += 0.6 * steering.max(0.01) * (lateral - reached) / lateral * STEP;
        run.tell(Action::Steer { angle: steering })?;
        run.step()?;
        if step >= steps - last {
            let now = [steering, run.speed(), run.yaw_rate(), run.tilt()];
            sums.iter_mut().zip(now).for_each(|(sum, value)| *sum += value / f64::from(last));
        }
    }
    let [steering, speed, yaw_rate, tilt] = sums;
    let reached = speed * yaw_rate / GRAVITY;
    let understeer = (steering - length * yaw_rate / speed) / reached;
    Ok(SteadyTurn { steering, speed, yaw_rate, tilt, understeer })
}

/// The greatest lateral acceleration in g, as a mean over half a second, while the steering is slowly turned in at a
/// speed, m/s, that is held as well as it goes.
///
/// # Errors
/// A setting of the vehicle out of range.
pub fn lateral_limit(vehicle: &VehicleParameters, speed: f64) -> Result<f64, ProvingError> {
    let mut run = Run::new(vehicle, RoadCondition::Dry, speed)?;
    let (mut best, mut mean) = (0.0f64, 0.0);
    let most = atan2(1.6 * GRAVITY * vehicle.chassis.wheelbase, speed * speed) + 0.1;
    for step in 0..(20.0 / STEP) as u32 {
        run.hold_speed(speed)?;
        run.tell(Action::Steer { angle: most * f64::from(step) * STEP / 20.0 })?;
        run.step()?;
        mean += (run.speed() * run.yaw_rate() / GRAVITY - mean) * STEP / 0.5;
        if run.tilt() < 0.7 {
            best = best.max(mean);
        }
    }
    Ok(best)
}

/// What a double lane change shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LaneChange {
    /// Greatest tilt of the body, radians.
    pub tilt: f64,
    /// Greatest way from the middle of the lanes, m.
    pub deviation: f64,
    /// Speed at the end, m/s.
    pub speed: f64,
}

/// A double lane change of 3.5 m at a speed, m/s, with the lengths of ISO 3888-1: 30 m across, 25 m beside, 25 m back;
/// the driver steers for a point ahead and lets the throttle go.
///
/// # Errors
/// A setting of the vehicle out of range.
pub fn lane_change(vehicle: &VehicleParameters, speed: f64) -> Result<LaneChange, ProvingError> {
    let mut run = Run::new(vehicle, RoadCondition::Dry, speed)?;
    let length = vehicle.chassis.wheelbase;
    // A rider has to lean before the vehicle turns, and so looks farther ahead.
    let preview = if vehicle.balance.is_some() { 1.1 } else { 0.55 };
    let mut shown = LaneChange { tilt: 0.0, deviation: 0.0, speed };
    for _ in 0..(40.0 / STEP) as u32 {
        let (place, yaw) = (run.position(), run.yaw());
        if place.x > 160.0 || run.speed() < 1.0 {
            break;
        }
        let ahead = (preview * run.speed()).max(1.2 * length);
        let aim = lane(place.x + ahead) - place.y;
        let angle = atan2(aim, ahead) - yaw;
        run.tell(Action::Steer { angle: atan2(2.0 * length * sin(angle), ahead) })?;
        run.hold_speed(speed)?;
        run.step()?;
        shown.tilt = shown.tilt.max(run.tilt());
        shown.deviation = shown.deviation.max((run.position().y - lane(run.position().x)).abs());
    }
    shown.speed = run.speed();
    Ok(shown)
}

/// The middle of the lane at a way along the track, m, measured across.
fn lane(x: f64) -> f64 {
    let ease = |share: f64| {
        let s = share.clamp(0.0, 1.0);
        s * s * (3.0 - 2.0 * s)
    };
    3.5 * (ease((x - 15.0) / 30.0) - ease((x - 70.0) / 25.0))
}
