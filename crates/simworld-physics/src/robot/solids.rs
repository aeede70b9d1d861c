//! The forms of links as the engine's solids.

use std::panic::{AssertUnwindSafe, catch_unwind};

use rapier3d_f64::math::{Pose as RapierPose, Vector};
use rapier3d_f64::prelude::SharedShape;

use super::description::Form;
use super::surface::Surface;
use crate::convert::{from_vector, to_vector};
use crate::shape::upright;

/// The engine's solid, and where it sits in the frame of the form; none for points that span no solid.
pub(super) fn solid(form: &Form) -> Option<(SharedShape, RapierPose)> {
    let level = RapierPose::IDENTITY;
    Some(match form {
        Form::Box { size } => (SharedShape::cuboid(size.x * 0.5, size.y * 0.5, size.z * 0.5), level),
        Form::Cylinder { radius, length } => {
            let turned = RapierPose::from_parts(Vector::ZERO, upright());
            (SharedShape::cylinder(length * 0.5, *radius), turned)
        }
        Form::Sphere { radius } => (SharedShape::ball(*radius), level),
        Form::Capsule { radius, length } => (SharedShape::capsule_z(length * 0.5, *radius), level),
        Form::Convex { points } => {
            let points: Vec<Vector> = points.iter().map(to_vector).collect();
            // The engine answers a hull that it cannot find by a panic; what it may have left half done is dropped with it.
            let hull = || catch_unwind(AssertUnwindSafe(|| SharedShape::convex_hull(&points)));
            (if points.len() < 4 { None } else { hull().ok().flatten() }?, level)
        }
    })
}

/// The surface of a convex solid as the engine has it; none for points that span no solid.
pub(super) fn surface(form: &Form) -> Option<Surface> {
    let (solid, _) = solid(form)?;
    let (points, triangles) = solid.as_convex_polyhedron()?.to_trimesh();
    Some(Surface { points: points.iter().map(|point| from_vector(*point)).collect(), triangles })
}

/// Its volume, m³; 0 for points that span no solid.
pub(super) fn volume(form: &Form) -> f64 {
    let volume = solid(form).map_or(0.0, |(solid, _)| solid.mass_properties(1.0).mass());
    if volume.is_finite() { volume } else { 0.0 }
}
