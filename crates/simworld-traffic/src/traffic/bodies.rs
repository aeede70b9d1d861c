//! Vehicles as others see them: bodies in the plane.

use simworld_core::geometry::{
    Point2, Point3, Pose, Twist, Vector2, Vector3, direction, heading, pose_facing,
};
use simworld_core::net::polyline;
use simworld_core::scene::Shape;

use super::Traffic;
use crate::vehicle::{FRONT_AXLE, Path, REAR_AXLE, Vehicle, VehicleKind, held};

/// A vehicle as others see it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Body {
    /// Its number, from zero.
    pub id: u32,
    /// Its kind.
    pub kind: VehicleKind,
    /// Its type: a row of [`TrafficConfig::types`](crate::TrafficConfig::types).
    pub vehicle_type: usize,
    /// Its solid.
    pub shape: Shape,
    /// World from body: the origin is the middle of its bottom.
    pub pose: Pose,
    /// Velocity.
    pub twist: Twist,
}

impl Traffic {
    /// The vehicles, track by track, front to back on each; the tracks of one intersection after those of another; then those that
    /// are [free](Self::free), by number.
    pub fn vehicles(&self) -> impl Iterator<Item = Body> {
        let vehicles = self.state.vehicles.iter(&self.tracks);
        vehicles.map(|(track, vehicle, path)| self.body(track, vehicle, path)).chain(self.free_vehicles())
    }

    /// A vehicle by its number; `None` if nobody has it.
    pub fn vehicle(&self, id: u32) -> Option<Body> {
        if let Some(free) = self.state.vehicles.free_body(id) {
            return Some(self.free_vehicle(free));
        }
        let (track, vehicle, path) = self.state.vehicles.find(&self.tracks, id)?;
        Some(self.body(track, vehicle, path))
    }

    /// Where each vehicle is: its number, the lane or connection it is on, its front on it, m, and its speed, m/s. Lanes are
    /// numbered as in the network, connections after them. Free bodies are on none.
    pub fn stations(&self) -> impl Iterator<Item = (u32, u32, f64, f64)> {
        let vehicles = self.state.vehicles.iter(&self.tracks);
        vehicles.map(|(track, vehicle, _)| (vehicle.id, track, vehicle.s, vehicle.v))
    }

    /// The speed on an empty lane or connection, m/s: what the limit, the curve, the weather and the driver of the first type
    /// allow. Numbered as in [`stations`](Self::stations).
    pub fn free_speed(&self, track: u32) -> f64 {
        let allowed = self.tracks.speed.get(track as usize).copied().unwrap_or(f64::INFINITY);
        // Tables of types are never empty; of one that was, nobody drives.
        self.driving.types.first().map_or(allowed, |car| car.free_speed(&self.driving, 1.0, allowed))
    }

    /// The lengths of the vehicles, m, in the order of [`stations`](Self::stations).
    pub(crate) fn lengths(&self) -> impl Iterator<Item = f64> {
        self.state.vehicles.iter(&self.tracks).map(|(_, vehicle, _)| vehicle.length())
    }

    fn body(&self, track: u32, vehicle: &Vehicle, path: &Path) -> Body {
        let length = vehicle.length();
        let row = self.driving.vehicle_type(vehicle.row);
        // The rear may still be on the track before.
        let front = self.point(track, path.before, vehicle.s - FRONT_AXLE * length);
        let rear = self.point(track, path.before, vehicle.s - REAR_AXLE * length);
        let (middle, facing) = held(front, rear);
        let yaw = heading(&facing);
        let ahead = direction(yaw);
        let left = Vector2::new(-ahead.y, ahead.x);
        let middle = middle + left * f64::from(vehicle.shift);
        let ahead = ahead * vehicle.v;
        Body {
            id: vehicle.id,
            kind: row.kind,
            vehicle_type: usize::from(vehicle.row),
            shape: row.shape(),
            pose: pose_facing(Point3::new(middle.x, middle.y, 0.0), yaw),
            twist: Twist { linear: Vector3::new(ahead.x, ahead.y, 0.0), angular: Vector3::zeros() },
        }
    }

    fn point(&self, track: u32, before: u32, station: f64) -> Point2 {
        let path = self.tracks.path(track);
        if station >= 0.0 {
            return polyline::at(path, station).0;
        }
        if before == track {
            // At the start a vehicle has come from nowhere: its lane is continued backwards.
            let (start, yaw) = polyline::at(path, 0.0);
            return start + direction(yaw) * station;
        }
        let length = self.tracks.length[before as usize];
        if station + length >= 0.0 {
            return polyline::at(self.tracks.path(before), station + length).0;
        }
        let (start, yaw) = polyline::at(self.tracks.path(before), 0.0);
        start + direction(yaw) * (station + length)
    }
}
