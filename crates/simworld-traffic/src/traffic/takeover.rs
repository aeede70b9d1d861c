//! Vehicles that somebody else takes over, drives or moves, and gives back.

use simworld_core::geometry::{Pose, Twist, Vector2, direction, planar, yaw_of};

use super::bodies::Body;
use super::{Foreign, State, Traffic};
use crate::takeover::{Control, ControlError, Drive, finite};
use crate::vehicle::FreeVehicle;

impl Traffic {
    /// Drives a vehicle from the next step on, until it is [given back](Self::give_back) or told otherwise: somebody else is its
    /// driver, and the traffic keeps it in its lane, behind who is ahead, before people on crossings, and before a stop
    /// line that it has no leave to pass. Where it was told to halt it stays.
    ///
    /// ```
    /// use std::sync::Arc;
    /// use simworld_core::net::{NetworkConfig, RoadNetwork, StreetPlan};
    /// use simworld_core::seed::Seed;
    /// use simworld_traffic::{Drive, Traffic, TrafficConfig};
    /// let network = RoadNetwork::derive(&StreetPlan::grid(3, 3, 120.0), &NetworkConfig::default())?;
    /// let mut traffic = Traffic::new(Arc::new(network), &TrafficConfig::default(), Seed(1))?;
    /// traffic.drive(7, Drive { acceleration: -3.0, ..Drive::default() })?;
    /// for _ in 0..100 { traffic.step(0.1); }
    /// assert_eq!(traffic.vehicle(7).unwrap().twist.ground_speed(), 0.0);
    /// traffic.give_back(7)?;
    /// for _ in 0..600 { traffic.step(0.1); }
    /// assert!(traffic.counters().crossings > 20);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// No vehicle of that number on a lane, an acceleration that is not finite, or a leg to which it cannot turn; it is driven
    /// as before then.
    pub fn drive(&mut self, id: u32, drive: Drive) -> Result<(), ControlError> {
        self.state.vehicles.drive(&self.tracks, &self.driving, id, drive)
    }

    /// Lifts a vehicle off its lane: it is a free body from now on that stands where [`place`](Self::place) puts it. Drivers
    /// and walkers mind it as they mind the bodies of others. Stops that it was to make are given up.
    ///
    /// # Errors
    /// No vehicle of that number, or one that is free already.
    pub fn free(&mut self, id: u32) -> Result<Body, ControlError> {
        if self.state.vehicles.free_body(id).is_some() {
            let (wanted, mend) = ("on a lane", "it is a free body already");
            return Err(ControlError::NotSo { what: "vehicle", id, wanted, mend });
        }
        let body = self.vehicle(id).ok_or(ControlError::Nobody { what: "vehicle", id })?;
        self.state.vehicles.lift(&self.tracks, &self.driving, id, body.pose, body.twist);
        Ok(body)
    }

    /// Puts a free body somewhere, in the world's frame; it stays there until it is put elsewhere, whatever its velocity.
    ///
    /// # Errors
    /// It is not free, or a number is not finite; nothing is changed then.
    pub fn place(&mut self, id: u32, pose: Pose, twist: Twist) -> Result<(), ControlError> {
        let at = pose.translation.vector;
        finite("position", [at.x, at.y, at.z])?;
        let turn = pose.rotation.coords;
        finite("rotation", [turn.x, turn.y, turn.z, turn.w])?;
        finite("velocity", [twist.linear.x, twist.linear.y, twist.linear.z])?;
        finite("angular velocity", [twist.angular.x, twist.angular.y, twist.angular.z])?;
        let (wanted, mend) = ("a free body", "take it over by Traffic::free first");
        let not_free = ControlError::NotSo { what: "vehicle", id, wanted, mend };
        self.state.vehicles.free_body_mut(id).ok_or(not_free)?.move_to(pose, twist);
        Ok(())
    }

    /// Gives a vehicle back to its own driver. A free body joins the nearest lane that leads on, to the end of its route if it
    /// has one: it must be over that lane, face where it leads, and have room there.
    ///
    /// # Errors
    /// Nobody else drives it, or why a free body cannot join; it stays as it is then.
    pub fn give_back(&mut self, id: u32) -> Result<(), ControlError> {
        let State { vehicles, .. } = &mut self.state;
        if let Some(free) = vehicles.free_body(id) {
            let (at, lanes) = (planar(&free.pose), self.tracks.lanes as u32);
            let near = self.finder.tracks_at(at).filter(|track| *track < lanes);
            let streams = self.streams.named("vehicles");
            return vehicles.join(&self.tracks, &self.driving, streams, near, id);
        }
        if vehicles.let_drive(id) {
            return Ok(());
        }
        vehicles.find(&self.tracks, id).ok_or(ControlError::Nobody { what: "vehicle", id })?;
        let (wanted, mend) = ("under control", "it drives by itself already");
        Err(ControlError::NotSo { what: "vehicle", id, wanted, mend })
    }

    /// Who drives a vehicle; `None` if nobody has the number.
    pub fn control(&self, id: u32) -> Option<Control<Drive>> {
        let vehicles = &self.state.vehicles;
        if vehicles.free_body(id).is_some() {
            return Some(Control::Free);
        }
        vehicles.find(&self.tracks, id)?;
        Some(vehicles.driven(id).map_or(Control::Own, |drive| Control::Guided(*drive)))
    }

    /// The free bodies of vehicles.
    pub(super) fn free_vehicles(&self) -> impl Iterator<Item = Body> {
        self.state.vehicles.free_bodies().map(|(_, free)| self.free_vehicle(free))
    }

    pub(super) fn free_vehicle(&self, free: &FreeVehicle) -> Body {
        let vehicle = free.vehicle();
        let row = self.driving.vehicle_type(vehicle.row);
        Body {
            id: vehicle.id,
            kind: row.kind,
            vehicle_type: usize::from(vehicle.row),
            shape: row.shape(),
            pose: free.pose,
            twist: free.twist,
        }
    }

    /// Gathers the bodies that are on no track: those of others, free vehicles, and at the end free walkers, who are people
    /// among people; returns how many come before these.
    pub(super) fn gather(&mut self, foreign: &[Foreign]) -> usize {
        let mut gathered = std::mem::take(&mut self.gathered);
        gathered.clear();
        let free = self.free_vehicles().map(|body| Foreign::of(&body));
        gathered.extend(foreign.iter().copied().chain(free).filter(Foreign::is_sound));
        let count = gathered.len();
        let radius = self.config.walking.radius;
        let walkers = self.state.pedestrians.free_bodies();
        let walkers = walkers.map(|(walker, height)| Foreign {
            velocity: walker.velocity(),
            height,
            ..Foreign::standing(walker.position, radius)
        });
        gathered.extend(walkers.filter(Foreign::is_sound));
        self.gathered = gathered;
        count
    }
}

impl Foreign {
    /// A vehicle as a body that is on no track.
    fn of(body: &Body) -> Self {
        let size = body.shape.size() * 0.5;
        let linear = body.twist.linear;
        Self {
            position: planar(&body.pose),
            radius: size.x,
            half_width: size.y,
            direction: direction(yaw_of(&body.pose)),
            velocity: Vector2::new(linear.x, linear.y),
            height: body.pose.translation.z,
        }
    }
}
