//! Engine, gears and which wheels they drive: from the accelerator to torque at the wheels.

use serde::{Deserialize, Serialize};

use super::parameters::Check;
use crate::error::PhysicsError;

/// Which axles are driven.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Drive {
    /// The front axle.
    Front,
    /// The rear axle.
    Rear,
    /// Both, half the torque each.
    All,
}

impl Drive {
    /// Share of the torque at the front axle.
    pub fn front_share(self) -> f64 {
        match self {
            Self::Front => 1.0,
            Self::Rear => 0.0,
            Self::All => 0.5,
        }
    }
}

/// Engine and automatic gearbox.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Powertrain {
    /// Torque at full throttle by engine speed, rad/s and N m, by ascending speed; between points it is a straight
    /// line, beyond the last there is none.
    pub torque_curve: Vec<[f64; 2]>,
    /// Torque that the engine takes at closed throttle and its greatest speed, N m, 0 to 5000; less in proportion
    /// below it.
    pub drag_torque: f64,
    /// Engine turns for a turn of the wheels, final drive included, from the first gear to the last; 0.5 to 100.
    pub gears: Vec<f64>,
    /// Share of the torque that arrives at the wheels, 0.1 to 1.
    pub efficiency: f64,
    /// Moment of inertia of what turns with the engine, kg m², 0 to 50.
    pub inertia: f64,
    /// Engine speed below which the clutch slips or the converter turns, rad/s, 0 to 500; 0 for electric motors.
    pub launch_speed: f64,
    /// Time without torque in a change of gears, s, 0 to 3.
    pub shift_time: f64,
    /// Which wheels are driven.
    pub drive: Drive,
    /// Speed at which the torque is cut, m/s, 1 to 100.
    pub top_speed: f64,
    /// The same backward, m/s, 0 to 30; 0 for vehicles without reverse.
    pub reverse_speed: f64,
}

/// What changes in a powertrain.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Gearbox {
    /// Index of the gear.
    pub(crate) gear: u8,
    /// What is left of a change of gears, s.
    pub(crate) shift_left: f64,
}

/// What a powertrain gives in a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Output {
    /// Torque at all driven wheels together, N m, positive forward.
    pub(crate) torque: f64,
    /// Inertia that the driven wheels feel together, kg m².
    pub(crate) inertia: f64,
}

impl Powertrain {
    pub(crate) fn validate(&self, check: &Check) -> Result<(), PhysicsError> {
        check.range("torque_curve.len", self.torque_curve.len() as f64, 2.0..=100.0, "2 to 100 points")?;
        for pair in self.torque_curve.windows(2) {
            let rise = pair[1][0] - pair[0][0];
            check.range("torque_curve (rise of speed)", rise, 1e-6..=1e4, "speeds that rise, in rad/s")?;
        }
        for [speed, torque] in &self.torque_curve {
            check.range("torque_curve (speed)", *speed, 0.0..=5e3, "0 to 5000 rad/s")?;
            check.range("torque_curve (torque)", *torque, 0.0..=1e4, "0 to 10000 N m")?;
        }
        check.range("gears.len", self.gears.len() as f64, 1.0..=20.0, "1 to 20 gears")?;
        for ratio in &self.gears {
            check.range("gears", *ratio, 0.5..=100.0, "0.5 to 100")?;
        }
        check.range("drag_torque", self.drag_torque, 0.0..=5e3, "0 to 5000 N m")?;
        check.range("efficiency", self.efficiency, 0.1..=1.0, "0.1 to 1")?;
        check.range("inertia", self.inertia, 0.0..=50.0, "0 to 50 kg m²")?;
        check.range("launch_speed", self.launch_speed, 0.0..=500.0, "0 to 500 rad/s")?;
        check.range("shift_time", self.shift_time, 0.0..=3.0, "0 to 3 s")?;
        check.range("top_speed", self.top_speed, 1.0..=100.0, "1 to 100 m/s")?;
        check.range("reverse_speed", self.reverse_speed, 0.0..=30.0, "0 to 30 m/s")
    }

    /// Greatest engine speed, rad/s.
    pub fn redline(&self) -> f64 {
        self.torque_curve.last().map_or(0.0, |point| point[0])
    }

    /// Torque of the engine at full throttle, N m, at an engine speed, rad/s.
    pub fn full_torque(&self, speed: f64) -> f64 {
        let after = self.torque_curve.partition_point(|point| point[0] <= speed);
        match (after.checked_sub(1).map(|before| self.torque_curve[before]), self.torque_curve.get(after)) {
            (None, Some(first)) => first[1],
            (Some([x0, y0]), Some([x1, y1])) => y0 + (y1 - y0) * (speed - x0) / (x1 - x0),
            (_, None) => 0.0,
        }
    }

    /// Greatest power of the engine, W.
    pub fn power(&self) -> f64 {
        let at_points = self.torque_curve.iter().map(|[speed, torque]| speed * torque).fold(0.0, f64::max);
        let between = self.torque_curve.windows(2).map(|pair| {
            let [[x0, y0], [x1, y1]] = [pair[0], pair[1]];
            let slope = (y1 - y0) / (x1 - x0);
            // ω (y0 + slope (ω - x0)) is greatest where its slope is zero.
            let peak = if slope < 0.0 { (x0 - y0 / slope) * 0.5 } else { x1 };
            let speed = peak.clamp(x0, x1);
            speed * (y0 + slope * (speed - x0))
        });
        between.fold(at_points, f64::max)
    }

    /// One step: changes gears, and gives torque for a throttle in [-1, 1] (negative is reverse) at a speed of the
    /// driven wheels, rad/s, of a radius, m.
    pub(crate) fn step(&self, box_: &mut Gearbox, throttle: f64, wheel: f64, radius: f64, dt: f64) -> Output {
        if throttle < 0.0 {
            *box_ = Gearbox::default();
            return self.reverse(-throttle, wheel, radius);
        }
        self.choose_gear(box_, throttle, wheel, dt);
        if box_.shift_left > 0.0 {
            return Output::default();
        }
        let ratio = self.gears[usize::from(box_.gear)];
        let turning = wheel * ratio;
        let is_slipping = turning < self.launch_speed;
        let speed = turning.max(self.launch_speed);
        let limited = throttle * (self.top_speed - wheel * radius).clamp(0.0, 1.0);
        let drag = if is_slipping { 0.0 } else { self.drag_torque * speed / self.redline() };
        let torque = limited * self.full_torque(speed) * self.efficiency - (1.0 - throttle) * drag;
        let inertia = if is_slipping { 0.0 } else { self.inertia * ratio * ratio };
        Output { torque: torque * ratio, inertia }
    }

    fn reverse(&self, throttle: f64, wheel: f64, radius: f64) -> Output {
        let ratio = self.gears[0];
        let limited = throttle * (self.reverse_speed + wheel * radius).clamp(0.0, 1.0);
        let speed = (-wheel * ratio).max(self.launch_speed);
        Output { torque: -limited * self.full_torque(speed) * self.efficiency * ratio, inertia: 0.0 }
    }

    /// Higher when the engine turns fast for the throttle, lower when it would not turn fast in the lower gear.
    fn choose_gear(&self, box_: &mut Gearbox, throttle: f64, wheel: f64, dt: f64) {
        box_.shift_left = (box_.shift_left - dt).max(0.0);
        let top = self.gears.len() - 1;
        let gear = usize::from(box_.gear).min(top);
        let shift_at = self.redline() * (0.4 + 0.57 * throttle);
        let chosen = if gear < top && wheel * self.gears[gear] > shift_at {
            gear + 1
        } else if gear > 0 && wheel * self.gears[gear - 1] < 0.8 * shift_at {
            gear - 1
        } else {
            gear
        };
        if chosen != gear {
            box_.shift_left = self.shift_time;
        }
        box_.gear = chosen as u8; // at most 20 gears
    }

    /// The greatest force at the wheels, N, at a speed, m/s, in the best gear: the tractive effort.
    pub fn tractive_effort(&self, speed: f64, radius: f64) -> f64 {
        let torque = |ratio: f64| {
            self.full_torque((speed / radius * ratio).max(self.launch_speed)) * ratio * self.efficiency
                / radius
        };
        let best = self.gears.iter().map(|ratio| torque(*ratio)).fold(0.0, f64::max);
        best * (self.top_speed - speed).clamp(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::super::VehicleClass;

    #[test]
    fn torque_is_interpolated_and_ends_at_the_redline() {
        let engine = VehicleClass::Sedan.parameters().powertrain;
        let [[x0, y0], [x1, y1]] = [engine.torque_curve[0], engine.torque_curve[1]];
        assert!((engine.full_torque(f64::midpoint(x0, x1)) - f64::midpoint(y0, y1)).abs() < 1e-9);
        assert_eq!(engine.full_torque(0.0), y0);
        assert_eq!(engine.full_torque(engine.redline() + 1.0), 0.0);
    }

    #[test]
    fn tractive_effort_is_never_more_than_the_power_gives() {
        for class in VehicleClass::ALL {
            let parameters = class.parameters();
            let (engine, radius) = (&parameters.powertrain, parameters.front.wheel_radius);
            for speed in 1..60 {
                let speed = f64::from(speed);
                let power = engine.tractive_effort(speed, radius) * speed;
                let most = engine.power() * engine.efficiency;
                assert!(power <= most * (1.0 + 1e-9), "{class}: {power} W at {speed} m/s");
            }
        }
    }
}
