//! The camera of somebody who looks on: it stands somewhere, or stays behind somebody.

use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::{Point3, Vector3, direction, heading, yaw_of};
use simworld_core::ops;
use simworld_core::scene::EntityRef;

/// A place in the air and a direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flight {
    /// World frame, m.
    pub position: Point3,
    /// Radians counter-clockwise from east.
    pub yaw: f64,
    /// Radians above the horizon.
    pub pitch: f64,
}

impl Flight {
    /// From there to here.
    pub fn looking_at(eye: Point3, target: Point3) -> Self {
        let ahead = target - eye;
        let flat = ops::hypot(ahead.x, ahead.y);
        Self { position: eye, yaw: heading(&ahead.xy()), pitch: ops::atan2(ahead.z, flat) }
    }

    /// Behind and above somebody, as far off as it is large.
    pub fn behind(body: &EntityRef<'_>) -> Self {
        let (at, size) = (body.position(), body.info.shape.size());
        let far = 4.0 + 1.3 * size.x.max(size.z);
        let ahead = direction(yaw_of(body.pose));
        let eye = at - Vector3::new(ahead.x, ahead.y, 0.0) * far
            + Vector3::new(0.0, 0.0, 0.6 * size.z + 0.28 * far);
        Self::looking_at(eye, at + Vector3::new(ahead.x * 3.0, ahead.y * 3.0, size.z * 0.6))
    }

    /// Turns to the left and up, radians.
    pub fn turn(&mut self, left: f64, up: f64) {
        self.yaw += left;
        self.pitch = (self.pitch + up).clamp(-1.5, 1.5);
    }

    /// Comes nearer to another place and direction by a share of the way, from 0 to 1, the shorter way round.
    pub fn ease(&mut self, to: &Self, share: f64) {
        self.position += (to.position - self.position) * share;
        let round = ops::atan2(ops::sin(to.yaw - self.yaw), ops::cos(to.yaw - self.yaw));
        self.turn(round * share, (to.pitch - self.pitch) * share);
    }

    /// The camera there.
    pub fn camera(&self, intrinsics: Intrinsics) -> Camera {
        let flat = direction(self.yaw) * ops::cos(self.pitch);
        let ahead = Vector3::new(flat.x, flat.y, ops::sin(self.pitch));
        Camera::looking_at(self.position, self.position + ahead, intrinsics)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_looks_where_it_should_and_eases_the_shorter_way() {
        let mut flight = Flight::looking_at(Point3::new(0.0, 0.0, 5.0), Point3::new(0.0, 10.0, 5.0));
        let camera = flight.camera(Intrinsics::from_fov(90, 60, 1.2).unwrap());
        let (pixel, depth) = camera.project(&Point3::new(0.0, 8.0, 5.0)).unwrap();
        assert!((pixel.x - 45.0).abs() < 1e-9 && (depth - 8.0).abs() < 1e-9, "{pixel} {depth}");
        flight.yaw = 3.0;
        let to = Flight { yaw: -3.0, ..flight };
        flight.ease(&to, 0.5);
        assert!((flight.yaw - std::f64::consts::PI).abs() < 1e-9, "{}", flight.yaw);
    }
}
