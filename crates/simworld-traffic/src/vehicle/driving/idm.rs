//! Car following: the Intelligent Driver Model (Treiber, Hennecke and Helbing 2000).

use serde::{Deserialize, Serialize};
use simworld_core::ops::{greater, lesser};

use crate::TrafficConfig;
use crate::vehicle::VehicleType;

/// The hardest braking of a car, m/s²: tyres on dry asphalt.
pub const HARDEST_BRAKING: f64 = 9.0;

/// The parameters of the model; the default is an urban driver.
///
/// ```
/// use simworld_traffic::vehicle::Idm;
/// let driver = Idm::default();
/// // In equilibrium at 10 m/s the gap is (2 + 10 · 1) / √(1 − (10/13.9)⁴) = 14.02 m.
/// let gap = driver.equilibrium_gap(10.0);
/// assert!((gap - 14.02).abs() < 0.01);
/// assert!(driver.acceleration(10.0, 13.9, gap, 10.0).abs() < 1e-9);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Idm {
    /// Speed on a free road, m/s; the speed limit holds beside it.
    pub desired_speed: f64,
    /// Time gap to the leader, s.
    pub headway: f64,
    /// Gap to the leader at rest, m.
    pub gap: f64,
    /// Comfortable acceleration, m/s².
    pub acceleration: f64,
    /// Comfortable braking, m/s².
    pub deceleration: f64,
    /// The hardest braking that brakes and tyres give, m/s².
    pub emergency_deceleration: f64,
}

impl Default for Idm {
    fn default() -> Self {
        Self {
            desired_speed: 13.9,
            headway: 1.0,
            gap: 2.0,
            acceleration: 1.5,
            deceleration: 2.0,
            emergency_deceleration: HARDEST_BRAKING,
        }
    }
}

impl Idm {
    /// Acceleration at speed `v` m/s with the free speed `free` m/s, `gap` m behind a leader at `leader` m/s; an infinite gap
    /// is a free road. Never below minus the emergency braking.
    #[inline]
    pub fn acceleration(&self, v: f64, free: f64, gap: f64, leader: f64) -> f64 {
        self.respond(v, free, self.pressure(v, gap, leader))
    }

    /// How much a leader presses: the gap that one would like over the gap that there is. Of several leaders, the one that
    /// presses most decides; that need not be the nearest.
    #[inline]
    pub(crate) fn pressure(&self, v: f64, gap: f64, leader: f64) -> f64 {
        self.pressure_by(self.closes_by(), v, gap, leader)
    }

    /// The speed of a driver with that share of the limit on a road, m/s.
    #[inline]
    pub(crate) fn free_speed(&self, config: &TrafficConfig, factor: f32, limit: f64) -> f64 {
        lesser(f64::from(factor) * config.conditions.speed * limit, self.desired_speed)
    }

    /// What the speed at which one comes nearer is measured by: twice the mean of one's accelerations, m/s².
    #[inline]
    pub(crate) fn closes_by(&self) -> f64 {
        2.0 * (self.acceleration * self.deceleration).sqrt()
    }

    /// How much a leader presses one who knows by what he measures how he comes nearer.
    #[inline]
    pub(crate) fn pressure_by(&self, closes_by: f64, v: f64, gap: f64, leader: f64) -> f64 {
        let closing = v * (v - leader) / closes_by;
        let wanted = self.gap + greater(v * self.headway + closing, 0.0);
        wanted / greater(gap, 0.01)
    }

    /// The acceleration under such a pressure.
    #[inline]
    pub(crate) fn respond(&self, v: f64, free: f64, pressure: f64) -> f64 {
        let interaction = self.acceleration * pressure * pressure;
        greater(self.alone(v, free) - interaction, -self.emergency_deceleration)
    }

    /// The acceleration with nobody ahead: above its free speed a vehicle brakes comfortably, however far above.
    #[inline]
    pub(crate) fn alone(&self, v: f64, free: f64) -> f64 {
        let ratio = v / free;
        let square = ratio * ratio;
        greater(self.acceleration * (1.0 - square * square), -self.deceleration)
    }

    /// The gap at which one follows at constant speed, m; infinite at the desired speed.
    pub fn equilibrium_gap(&self, v: f64) -> f64 {
        let ratio = v / self.desired_speed;
        let square = ratio * ratio;
        (self.gap + v * self.headway) / (1.0 - square * square).max(0.0).sqrt()
    }
}

/// What a step asks of the drivers of a type: a line of the cache.
#[repr(align(64))]
#[derive(Clone, Copy, Debug)]
pub(crate) struct Driver {
    pub(crate) idm: Idm,
    /// By what they measure how they come nearer, m/s².
    pub(crate) closes_by: f64,
    /// Whether there is no more to them than the IDM.
    pub(crate) is_perfect: bool,
}

const _: () = assert!(size_of::<Driver>() == 64);

impl Driver {
    pub(crate) fn of(row: &VehicleType) -> Self {
        Self { idm: row.driver, closes_by: row.driver.closes_by(), is_perfect: !row.drives_otherwise() }
    }
}

/// Speed and way after `dt` s at constant acceleration, without ever going backwards.
#[inline]
pub(crate) fn advance(v: f64, acceleration: f64, dt: f64) -> (f64, f64) {
    let after = v + acceleration * dt;
    if after >= 0.0 {
        (after, (v + after) * 0.5 * dt)
    } else {
        // It comes to rest within the step.
        (0.0, v * v / (-2.0 * acceleration))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A leader brakes as hard as it can; the follower starts from any state that respects its own gap.
    #[test]
    fn it_never_hits_a_leader_that_brakes_as_hard_as_it_can() {
        let driver = Idm::default();
        for dt in [0.05, 0.1, 0.2] {
            for own in 0..28 {
                for leading in 0..28 {
                    let (mut v, mut leader) = (f64::from(own) * 0.5, f64::from(leading) * 0.5);
                    let mut gap = driver.gap + v * driver.headway;
                    for _ in 0..600 {
                        let a = driver.acceleration(v, driver.desired_speed, gap, leader);
                        let (next_leader, leader_way) = advance(leader, -HARDEST_BRAKING, dt);
                        let (next, way) = advance(v, a, dt);
                        gap += leader_way - way;
                        (v, leader) = (next, next_leader);
                        assert!(gap > 0.0, "hit from {own}/2 m/s behind {leading}/2 m/s at dt {dt}");
                    }
                }
            }
        }
    }

    /// Queue discharge at 1900 ± 5 % veh/h per lane, the standard saturation flow of the Highway Capacity Manual.
    #[test]
    fn a_queue_discharges_at_the_saturation_flow() {
        let driver = Idm::default();
        let (dt, length) = (0.1, 4.5);
        let mut queue: Vec<(f64, f64)> =
            (0..22).map(|i| (-f64::from(i) * (length + driver.gap), 0.0)).collect();
        let mut passed: Vec<f64> = Vec::new();
        let mut time = 0.0;
        while passed.len() < 22 && time < 200.0 {
            let frozen = queue.clone();
            for (index, (s, v)) in queue.iter_mut().enumerate() {
                let (gap, leader) = match index.checked_sub(1).map(|i| frozen[i]) {
                    Some((leader_s, leader_v)) => (leader_s - length - *s, leader_v),
                    None => (f64::INFINITY, 0.0),
                };
                let (next, way) = advance(*v, driver.acceleration(*v, 13.9, gap, leader), dt);
                (*s, *v) = (*s + way, next);
            }
            time += dt;
            let count = queue.iter().filter(|(s, _)| *s > 0.0).count();
            while passed.len() < count {
                passed.push(time);
            }
        }
        let headway = (passed[21] - passed[9]) / 12.0;
        let flow = 3600.0 / headway;
        assert!((flow - 1900.0).abs() < 95.0, "saturation flow {flow:.0} veh/h");
    }
}
