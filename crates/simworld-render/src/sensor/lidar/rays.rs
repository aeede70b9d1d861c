//! Scans by rays: the ray-cast backend casts the beams themselves, out of a table.

use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::{Pose, Vector3};
use simworld_core::id::EntityId;

use super::{Beam, BeamTable};
use crate::{ViewRequest, Views};

/// Rays in a row; rows are what a picture of them would have.
const ROW: usize = 1024;

/// The beams of a scanner as the device reads them.
#[derive(Clone, Debug)]
pub(super) struct Rays {
    /// Directions of length one in the optical frame; the last row is filled up with its last ray.
    pub table: Vec<[f32; 4]>,
    intrinsics: Intrinsics,
}

impl Rays {
    pub(super) fn new(beams: &BeamTable) -> Self {
        let width = beams.beams().len().clamp(1, ROW);
        // From forward, left, up to right, down, forward.
        let optical = |d: Vector3| [-d.y as f32, -d.z as f32, d.x as f32, 0.0];
        let mut table: Vec<[f32; 4]> = beams.beams().iter().map(|beam| optical(beam.direction())).collect();
        let last = table.last().copied().unwrap_or([0.0, 0.0, 1.0, 0.0]);
        table.resize(table.len().next_multiple_of(width).max(width), last);
        // Where pixels lie; the focal length says nothing of rays that a table gives.
        let (width, height) = (width as u32, (table.len() / width) as u32);
        let intrinsics = Intrinsics { width, height, fx: 1.0, fy: 1.0, cx: 0.0, cy: 0.0 };
        Self { table, intrinsics }
    }

    /// The picture that they make, from a sensor there.
    pub(super) fn request(&self, world_from_sensor: &Pose, hidden: EntityId) -> ViewRequest {
        let camera = Camera::looking_along(world_from_sensor, self.intrinsics);
        ViewRequest { hidden: Some(hidden), ..ViewRequest::from(camera) }
    }

    /// The range at which a beam meets something, and the cosine of the angle there.
    pub(super) fn meet(
        views: &Views,
        number: usize,
        world_from_sensor: &Pose,
        beam: &Beam,
    ) -> Option<(f64, f64)> {
        let range = f64::from(*views.depth.get(number)?);
        let normal = Vector3::from(views.normals.get(number)?.map(f64::from));
        let cosine = (world_from_sensor.rotation * beam.direction()).dot(&normal).abs();
        range.is_finite().then_some((range, cosine.min(1.0)))
    }
}
