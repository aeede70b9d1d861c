//! Drivers who are not the perfect one of the IDM: other models, errors, late decisions.

use super::following::{Ahead, CarFollowing, Leader};
use super::perception::Errors;
use crate::vehicle::manager::{STANDING, Vehicle};
use crate::vehicle::scene::Scene;
use crate::vehicle::types::VehicleType;

/// Who is nearer than this share of the way of one decision to where he must stand decides in every step.
const NEAR: f64 = 0.5;

/// How such a driver sees and decides in a step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Otherwise<'a> {
    row: &'a VehicleType,
    errors: Errors,
    /// Time until the next decision, s: Krauss asks for a speed by then.
    interval: f64,
    /// Time until the next step, s.
    dt: f64,
}

impl<'a> Otherwise<'a> {
    #[inline(never)]
    pub(in crate::vehicle) fn new(scene: &Scene<'_>, row: &'a VehicleType, id: u32) -> Self {
        let dt = scene.at.dt;
        let (errors, interval) = row.perception.as_ref().map_or((Errors::NONE, dt), |perception| {
            (perception.errors(scene.streams, id, &scene.at), perception.interval(dt))
        });
        Self { row, errors, interval, dt }
    }

    /// Takes note of one more thing ahead, as he sees it.
    #[inline(never)]
    pub(in crate::vehicle) fn see(&self, ahead: &mut Ahead, v: f64, leader: Leader) {
        let VehicleType { model, driver, .. } = self.row;
        let time = if self.is_near(v, leader.gap) { self.dt } else { self.interval };
        ahead.see(model, driver, v, &self.errors.of(leader), time);
    }

    /// Whether he is so near to where he must stand that he decides in every step.
    fn is_near(&self, v: f64, gap: f64) -> bool {
        gap - self.row.driver.gap < NEAR * v * self.interval
    }

    /// His acceleration, m/s², with the speeds that the road and its bends allow; `gap` is that to the nearest thing ahead. Who is pressed decides at once.
    #[inline(never)]
    pub(super) fn respond(
        &self,
        scene: &Scene<'_>,
        vehicle: &Vehicle,
        ahead: &Ahead,
        allowed: (f64, f64),
        gap: f64,
        is_pressed: bool,
    ) -> f64 {
        let VehicleType { model, driver, perception, .. } = self.row;
        let v = vehicle.v;
        let mut wanted = ahead.respond(model, driver, v, allowed, self.interval);
        if let CarFollowing::Krauss { .. } = model {
            wanted = model.dawdle(driver, v, wanted, scene.draw("dawdle", vehicle.id));
        }
        let Some(perception) = perception else { return wanted };
        let decides = perception.decides(vehicle.id, scene.at.step, scene.at.dt);
        let is_near = v > STANDING && self.is_near(v, gap);
        if decides || is_pressed || is_near || wanted < -driver.deceleration {
            wanted
        } else {
            f64::from(vehicle.acceleration)
        }
    }
}
