//! Who has nothing to mind but the speed limit and who is ahead on his lane: most drivers, most of the time. What they do comes out
//! as it would if they looked at everything.

use super::super::following::Ahead;
use super::super::idm::Driver;
use super::{CHANGES, LONGEST, Lane, Vehicle, horizon};
use crate::vehicle::manager::{NONE, STANDING};

/// What is ahead of the first of a lane: nobody, ever.
const NOBODY: Vehicle = Vehicle {
    s: f64::INFINITY,
    v: 0.0,
    stood: 0.0,
    id: NONE,
    next: NONE,
    holding: NONE,
    granted: 0,
    row: 0,
    length: 0.0,
    factor: 1.0,
    halt: f32::INFINITY,
    shift: 0.0,
    acceleration: 0.0,
};

impl Lane<'_> {
    /// Whether there is nothing on the lane but its queue, nor does anybody close up there.
    #[inline]
    pub(super) fn is_plain(&self) -> bool {
        self.way.is_none()
            && self.ghosts.is_empty()
            && !self.closes_up
            && self.scene.passings.is_empty()
            && self.scene.sight.obstacles.is_empty()
    }

    /// The acceleration on a plain lane of one who has nothing to mind but who is ahead of him there, m/s²; `None` for others.
    #[inline]
    #[expect(
        clippy::needless_bitwise_bool,
        reason = "asked one by one, each of the answers would be hard to foretell"
    )]
    pub(super) fn follow_on(&self, vehicle: &Vehicle, leader: Option<&Vehicle>) -> Option<f64> {
        let driver = &self.scene.drivers[usize::from(vehicle.row)];
        let v = vehicle.v;
        // Whose front has left the lane and whose rear has not is looked for by the first alone.
        let beyond = if leader.is_none() { LONGEST } else { 0.0 };
        let (is_lost, beyond) = if vehicle.next == NONE { (true, CHANGES) } else { (false, beyond) };
        let leader = leader.unwrap_or(&NOBODY);
        let is_plain = driver.is_perfect
            & (self.end - vehicle.s > horizon(v) + beyond)
            & (is_lost | (vehicle.holding != vehicle.next))
            & (vehicle.shift == 0.0)
            & (vehicle.halt == f32::INFINITY)
            & (leader.halt == f32::INFINITY);
        is_plain.then(|| self.respond_to(driver, vehicle, leader))
    }

    #[inline]
    fn respond_to(&self, Driver { idm, closes_by, .. }: &Driver, vehicle: &Vehicle, leader: &Vehicle) -> f64 {
        let v = vehicle.v;
        let gap = leader.s - leader.length() - vehicle.s;
        let mut ahead = Ahead::NOTHING;
        ahead.press(idm.pressure_by(*closes_by, v, gap, leader.v));
        let free = idm.free_speed(self.scene.config, vehicle.factor, self.limit);
        let acceleration = ahead.respond_by_idm(idm, v, (free, free));
        let stands_close = v < STANDING && gap < idm.gap;
        if stands_close { acceleration.min(0.0) } else { acceleration }
    }
}
