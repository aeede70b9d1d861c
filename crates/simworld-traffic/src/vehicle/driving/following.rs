//! The car-following models: which of them a type of vehicle drives by, and how they answer to what is ahead.
//!
//! All of them take the parameters of [`Idm`]; what one calls otherwise means the same: Krauss' reaction time is the time gap,
//! his minimum gap the gap at rest. Several things may be ahead at once (a leader, a stop line, somebody who leaves the lane);
//! each model keeps one or two numbers of all of them together, so that nothing has to be remembered one by one.

use serde::{Deserialize, Serialize};
use simworld_core::ops::{self, greater, lesser};

use super::lookahead::BEFORE_LINE;
use crate::vehicle::Idm;

/// A car-following model.
///
/// ```
/// use simworld_traffic::vehicle::{CarFollowing, Idm, Leader};
/// let (driver, krauss) = (Idm::default(), CarFollowing::Krauss { sigma: 0.5 });
/// // In equilibrium Krauss' driver keeps the gap at rest and the way of one reaction time: 2 + 10 · 1 m.
/// let leader = Leader { gap: krauss.equilibrium_gap(&driver, 10.0), speed: 10.0, acceleration: 0.0 };
/// assert_eq!(leader.gap, 12.0);
/// assert!(krauss.acceleration(&driver, 10.0, 13.9, Some(leader), 0.1).abs() < 1e-9);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum CarFollowing {
    /// The Intelligent Driver Model (Treiber, Hennecke and Helbing 2000): gaps and speeds change smoothly.
    #[default]
    Idm,
    /// The safe speed of Krauß (1998), with the emergency braking and the imperfection of SUMO's model of that name
    /// (`MSCFModel_Krauss`): in every step one takes the greatest speed from which one can still stop comfortably behind a
    /// leader that does, after one time gap without a reaction.
    Krauss {
        /// Imperfection, in [0, 1]: in every step a driver falls short of the acceleration that the model gives by up to this
        /// share of the comfortable one, drawn evenly. SUMO's default is 0.5.
        sigma: f64,
    },
    /// Adaptive cruise control (Kesting, Treiber and Helbing 2010; Treiber and Kesting 2013, section 11.3): the improved IDM,
    /// which at all speeds below the desired one keeps the gap `s0 + v T`, tempered by the constant-acceleration heuristic, which
    /// does not fear the worst of a leader that cuts in. Leaders behind a junction are seen without their acceleration; there it
    /// is the improved IDM.
    Acc {
        /// Coolness, in [0, 1]: 0 is the improved IDM; the authors take 0.99.
        coolness: f64,
    },
}

/// What is ahead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Leader {
    /// The gap between its rear and one's front, m.
    pub gap: f64,
    /// Its speed, m/s.
    pub speed: f64,
    /// Its acceleration, m/s²; minus infinity if it cannot be seen.
    pub acceleration: f64,
}

impl CarFollowing {
    /// Acceleration at speed `v` m/s with the free speed `free` m/s behind a leader, or on a free road, in a step of `dt` s; for
    /// Krauss without the imperfection. Never below minus the emergency braking.
    pub fn acceleration(&self, driver: &Idm, v: f64, free: f64, leader: Option<Leader>, dt: f64) -> f64 {
        let mut ahead = Ahead::NOTHING;
        if let Some(leader) = leader {
            ahead.see(self, driver, v, &leader, dt);
        }
        ahead.respond(self, driver, v, (free, free), dt)
    }

    /// The gap at which one follows at constant speed, m, by Krauss without imperfection; infinite at the desired speed.
    pub fn equilibrium_gap(&self, driver: &Idm, v: f64) -> f64 {
        match self {
            Self::Idm => driver.equilibrium_gap(v),
            _ if v >= driver.desired_speed => f64::INFINITY,
            Self::Krauss { .. } | Self::Acc { .. } => driver.gap + v * driver.headway,
        }
    }

    /// What a driver who is not perfect makes of an acceleration; `draw` is random in [0, 1).
    ///
    /// SUMO's `dawdle2`: below one second of acceleration it is a share of the speed, so that everybody gets under way; and
    /// nobody dawdles into harder than comfortable braking.
    #[inline]
    pub(crate) fn dawdle(&self, driver: &Idm, v: f64, wanted: f64, draw: f64) -> f64 {
        let Self::Krauss { sigma } = self else { return wanted };
        let short = wanted - sigma * draw * driver.acceleration.min(v);
        short.max(-driver.deceleration).min(wanted)
    }

    /// What the model has beside the shared parameters: name, value, least and greatest that it may be, and that in words.
    pub(crate) fn own_range(&self) -> Option<(&'static str, f64, f64, f64, &'static str)> {
        match self {
            Self::Idm => None,
            Self::Krauss { sigma } => Some(("model.krauss.sigma", *sigma, 0.0, 1.0, "0 to 1")),
            Self::Acc { coolness } => Some(("model.acc.coolness", *coolness, 0.0, 1.0, "0 to 1")),
        }
    }
}

/// All that is ahead, as far as a model asks.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Ahead {
    /// IDM: the gap that one would like over the gap that there is, of what presses most.
    pressure: f64,
    /// Krauss: the least of the safe accelerations. Adaptive cruise control: the least that the heuristic allows.
    bound: f64,
}

impl Ahead {
    pub(crate) const NOTHING: Self = Self { pressure: 0.0, bound: f64::INFINITY };

    /// Takes one more thing into account that presses so much, by the IDM.
    #[inline]
    pub(crate) fn press(&mut self, pressure: f64) {
        self.pressure = greater(pressure, self.pressure);
    }

    /// The same by any model.
    pub(crate) fn see(&mut self, model: &CarFollowing, driver: &Idm, v: f64, leader: &Leader, dt: f64) {
        self.press(driver.pressure(v, leader.gap, leader.speed));
        let bound = match model {
            CarFollowing::Idm => return,
            CarFollowing::Krauss { .. } => safe_acceleration(driver, v, leader, dt),
            CarFollowing::Acc { .. } => constant_acceleration(driver, v, leader),
        };
        self.bound = self.bound.min(bound);
    }

    /// The acceleration by the IDM, m/s², with the speeds that the road and its bends allow.
    #[inline]
    pub(crate) fn respond_by_idm(&self, driver: &Idm, v: f64, (free, bend): (f64, f64)) -> f64 {
        let following = driver.respond(v, free, self.pressure);
        if bend < free { lesser(driver.alone(v, bend), following) } else { following }
    }

    /// The acceleration by any model, m/s².
    pub(crate) fn respond(
        &self,
        model: &CarFollowing,
        driver: &Idm,
        v: f64,
        allowed: (f64, f64),
        dt: f64,
    ) -> f64 {
        let free = allowed.0.min(allowed.1);
        let wanted = match model {
            CarFollowing::Idm => self.respond_by_idm(driver, v, allowed),
            CarFollowing::Krauss { .. } => {
                let road = ((free - v) / dt).clamp(-driver.deceleration, driver.acceleration);
                road.min(self.bound)
            }
            CarFollowing::Acc { coolness } => {
                let improved = improved(driver, v, free, self.pressure);
                if improved >= self.bound || self.bound.is_infinite() {
                    improved
                } else {
                    let b = driver.deceleration;
                    let cool = self.bound + b * tanh((improved - self.bound) / b);
                    (1.0 - coolness) * improved + coolness * cool
                }
            }
        };
        wanted.max(-driver.emergency_deceleration)
    }
}

/// Krauss: the acceleration to the safe speed, or the braking that it takes if comfortable braking is past (SUMO's
/// `KraussOrig1::vsafe`, `maximumSafeFollowSpeed` and `calculateEmergencyDeceleration`).
fn safe_acceleration(driver: &Idm, v: f64, leader: &Leader, dt: f64) -> f64 {
    /// SUMO's `EMERGENCY_DECEL_AMPLIFIER`: an emergency is answered by a little more than it takes.
    const AMPLIFIER: f64 = 1.2;
    let (b, tau) = (driver.deceleration, driver.headway);
    let gap = leader.gap - driver.gap;
    // It may come to a stand within the gap and the braking distance of the leader.
    let room = gap.max(0.0) + leader.speed * leader.speed / (2.0 * b);
    let safe = (b * tau * b * tau + 2.0 * b * room).sqrt() - b * tau;
    let wanted = (safe - v) / dt;
    if wanted >= -b {
        return wanted;
    }
    let comfortable = v * v / (2.0 * room);
    let needed = if gap <= 0.0 {
        driver.emergency_deceleration
    } else if comfortable <= b {
        AMPLIFIER * comfortable
    } else {
        AMPLIFIER * (v * v - leader.speed * leader.speed) / (2.0 * gap)
    };
    -needed.max(b).min(-wanted)
}

/// The constant-acceleration heuristic: what just avoids a collision if the leader goes on to accelerate or brake as it does.
fn constant_acceleration(driver: &Idm, v: f64, leader: &Leader) -> f64 {
    let (gap, speed) = (leader.gap.max(0.01), leader.speed);
    if speed <= 0.0 {
        // Lines are told as leaders a standing gap beyond them: one stops where one is to stand.
        return -v * v / (2.0 * (gap - driver.gap + BEFORE_LINE).max(0.01));
    }
    let its = leader.acceleration.min(driver.acceleration);
    if its == f64::NEG_INFINITY {
        return its;
    }
    let closing = v - speed;
    if speed * closing <= -2.0 * gap * its && its < 0.0 {
        // It stands before one reaches it.
        v * v * its / (speed * speed - 2.0 * gap * its)
    } else {
        its - closing.max(0.0) * closing.max(0.0) / (2.0 * gap)
    }
}

/// The hyperbolic tangent; for the large negative values here the exponential just vanishes.
fn tanh(x: f64) -> f64 {
    1.0 - 2.0 / (ops::exp(2.0 * x) + 1.0)
}

/// The improved IDM: of gap and speed whichever asks for less decides, and does not add to the other.
fn improved(driver: &Idm, v: f64, free: f64, pressure: f64) -> f64 {
    let (a, b) = (driver.acceleration, driver.deceleration);
    let ratio = v / free;
    if ratio <= 1.0 {
        let road = a * (1.0 - ratio * ratio * ratio * ratio);
        if pressure >= 1.0 {
            a * (1.0 - pressure * pressure)
        } else if road > 1e-9 && pressure > 0.0 {
            road * (1.0 - ops::pow(pressure, 2.0 * a / road))
        } else {
            road
        }
    } else {
        let road = -b * (1.0 - ops::pow(1.0 / ratio, 4.0 * a / b));
        if pressure >= 1.0 { road + a * (1.0 - pressure * pressure) } else { road }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MODELS: [CarFollowing; 3] =
        [CarFollowing::Idm, CarFollowing::Krauss { sigma: 0.0 }, CarFollowing::Acc { coolness: 0.99 }];

    #[test]
    fn in_equilibrium_nobody_accelerates() {
        let driver = Idm::default();
        for model in MODELS {
            for speed in [0.5, 3.0, 8.0, 13.0] {
                let gap = model.equilibrium_gap(&driver, speed);
                let leader = Leader { gap, speed, acceleration: 0.0 };
                let a = model.acceleration(&driver, speed, driver.desired_speed, Some(leader), 0.1);
                assert!(a.abs() < 1e-9, "{model:?} at {speed} m/s: {a} m/s²");
            }
        }
    }

    #[test]
    fn on_a_free_road_everybody_comes_to_the_free_speed_and_back_to_it() {
        let driver = Idm::default();
        for model in MODELS {
            let mut v = 0.0;
            for free in [10.0, 6.0] {
                for _ in 0..1000 {
                    let a = model.acceleration(&driver, v, free, None, 0.1);
                    assert!((-driver.deceleration..=driver.acceleration).contains(&a), "{model:?}: {a} m/s²");
                    v += a * 0.1;
                }
                assert!((v - free).abs() < 0.01, "{model:?} at {v} m/s");
            }
        }
    }

    #[test]
    fn the_heuristic_does_not_fear_who_cuts_in() {
        // Ten metres ahead and as fast: the improved IDM brakes hard, who is cool hardly at all.
        let (driver, v) = (Idm::default(), 25.0);
        let driver = Idm { desired_speed: 33.0, ..driver };
        let leader = Leader { gap: 10.0, speed: v, acceleration: 0.0 };
        let brake = |coolness| {
            CarFollowing::Acc { coolness }.acceleration(&driver, v, driver.desired_speed, Some(leader), 0.1)
        };
        assert!(brake(0.0) < -7.0, "{}", brake(0.0));
        assert!((-2.2..-1.5).contains(&brake(0.99)), "{}", brake(0.99));
    }

    #[test]
    fn dawdling_takes_half_of_sigma_on_average_and_never_adds() {
        let (driver, model) = (Idm::default(), CarFollowing::Krauss { sigma: 0.5 });
        let mean =
            (0..1000).map(|n| model.dawdle(&driver, 10.0, 0.4, f64::from(n) / 1000.0)).sum::<f64>() / 1000.0;
        assert!((mean - (0.4 - 0.25 * driver.acceleration)).abs() < 1e-3, "{mean}");
        assert_eq!(model.dawdle(&driver, 0.0, 1.5, 0.9), 1.5);
        assert_eq!(model.dawdle(&driver, 10.0, -5.0, 0.9), -5.0);
        assert_eq!(CarFollowing::Idm.dawdle(&driver, 10.0, 0.4, 0.9), 0.4);
    }
}
