//! Scans by views: a quarter turn is a picture, and each beam reads the pixel that it goes through.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};

use nalgebra::UnitQuaternion;
use simworld_core::camera::{Camera, Intrinsics};
use simworld_core::geometry::{Point2, Point3, Pose, Vector3};
use simworld_core::id::EntityId;
use simworld_core::ops;

use super::{Beam, BeamTable};
use crate::{ViewRequest, Views};

/// A quarter turn, and the beams in it.
#[derive(Clone, Debug)]
pub(super) struct Face {
    /// Sensor from the frame of the quarter.
    pub turned: Pose,
    pub intrinsics: Intrinsics,
    /// Beams with the pixel that each goes through.
    pub beams: Vec<(u32, u32, u32)>,
}

impl Face {
    pub(super) fn new(table: &BeamTable, quarter: u32, resolution: u32) -> Option<Self> {
        let turn = f64::from(quarter) * FRAC_PI_2;
        let focal = f64::from(resolution) * 0.5;
        let mut found: Vec<(u32, f64, f64)> = Vec::new();
        for (index, beam) in (0..).zip(table.beams()) {
            let aside = ops::atan2(ops::sin(beam.azimuth - turn), ops::cos(beam.azimuth - turn));
            // The end of one quarter is the beginning of the next.
            if (-FRAC_PI_4..FRAC_PI_4).contains(&aside) {
                let across = -ops::tan(aside) * focal;
                found.push((index, across, -ops::tan(beam.elevation) / ops::cos(aside) * focal));
            }
        }
        let (first, last) =
            found.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), (.., down)| {
                (low.min(*down), high.max(*down))
            });
        if found.is_empty() {
            return None;
        }
        // A pixel to spare on each side.
        let (top, bottom) = (first.floor() - 1.0, last.floor() + 2.0);
        let intrinsics = Intrinsics {
            width: resolution + 2,
            height: (bottom - top) as u32,
            fx: focal,
            fy: focal,
            cx: focal + 1.0,
            cy: -top,
        };
        let place = |(index, across, down): (u32, f64, f64)| {
            let (x, y) = ((across + intrinsics.cx).floor(), (down + intrinsics.cy).floor());
            (
                index,
                (x.max(0.0) as u32).min(intrinsics.width - 1),
                (y.max(0.0) as u32).min(intrinsics.height - 1),
            )
        };
        let rotation = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), turn);
        Some(Self {
            turned: Pose::from_parts(nalgebra::Translation3::identity(), rotation),
            intrinsics,
            beams: found.into_iter().map(place).collect(),
        })
    }

    /// The view of this quarter from a sensor there.
    pub(super) fn request(&self, world_from_sensor: &Pose, hidden: EntityId) -> ViewRequest {
        let camera = Camera::looking_along(&(world_from_sensor * self.turned), self.intrinsics);
        ViewRequest { hidden: Some(hidden), ..ViewRequest::from(camera) }
    }

    /// The range at which a beam meets what is on its pixel, and the cosine of the angle there.
    pub(super) fn meet(
        &self,
        views: &Views,
        pixel: (u32, u32),
        index: usize,
        rotation: &UnitQuaternion<f64>,
        beam: &Beam,
    ) -> Option<(f64, f64)> {
        let depth = f64::from(*views.depth.get(index)?);
        if !depth.is_finite() {
            return None;
        }
        let middle = Point2::new(f64::from(pixel.0) + 0.5, f64::from(pixel.1) + 0.5);
        let in_optical = self.intrinsics.unproject(&middle, depth);
        // The face's frame is the body's of its camera: forward, left, up.
        let in_sensor: Point3 = self.turned * Point3::new(in_optical.z, -in_optical.x, -in_optical.y);
        let normal = Vector3::from(views.normals.get(index)?.map(f64::from));
        let normal = rotation.inverse() * normal;
        let direction = beam.direction();
        let slant = direction.dot(&normal);
        let there = in_sensor.coords.norm();
        let range = in_sensor.coords.dot(&normal) / slant;
        // A surface that is seen edgewise has no plane to meet.
        let sound = slant.abs() > 1e-3 && (range - there).abs() < 0.2 * there;
        Some((if sound { range } else { there }, slant.abs().min(1.0)))
    }
}
