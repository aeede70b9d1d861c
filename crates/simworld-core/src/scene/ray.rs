//! Ray against oriented box, by slabs.

use crate::geometry::{Obb, Ray, Vector3};

/// Distance to the box and the outward normal where the ray enters; zero distance from inside.
pub(super) fn meet_box(ray: &Ray, obb: &Obb) -> Option<(f64, Vector3)> {
    let origin = obb.pose.inverse_transform_point(&ray.origin);
    let direction = obb.pose.inverse_transform_vector(&ray.direction);
    let (mut enter, mut leave) = (0.0, f64::INFINITY);
    let mut normal = -direction;
    for axis in 0..3 {
        let half = obb.half_extents[axis];
        if direction[axis] == 0.0 {
            if origin[axis].abs() > half {
                return None;
            }
            continue;
        }
        let side = direction[axis].signum();
        let near = (-side * half - origin[axis]) / direction[axis];
        let far = (side * half - origin[axis]) / direction[axis];
        if near > enter {
            enter = near;
            normal = Vector3::zeros();
            normal[axis] = -side;
        }
        leave = f64::min(leave, far);
    }
    (enter <= leave).then(|| (enter, obb.pose.rotation * normal))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{Point3, pose_facing};

    #[test]
    fn a_turned_wall_is_met_on_its_face() {
        let wall = Obb {
            pose: pose_facing(Point3::new(10.0, 0.0, 0.0), std::f64::consts::FRAC_PI_4),
            half_extents: Vector3::new(1.0, 5.0, 3.0),
        };
        let ray = Ray { origin: Point3::origin(), direction: Vector3::x() };
        let (distance, normal) = meet_box(&ray, &wall).unwrap();
        assert!((distance - (10.0 - 2f64.sqrt())).abs() < 1e-9, "{distance}");
        assert!((normal.x + 0.5f64.sqrt()).abs() < 1e-9 && (normal.norm() - 1.0).abs() < 1e-9);
        assert!(meet_box(&Ray { origin: Point3::origin(), direction: -Vector3::x() }, &wall).is_none());
        let inside = Ray { origin: Point3::new(10.0, 0.0, 0.0), direction: Vector3::z() };
        assert_eq!(meet_box(&inside, &wall).unwrap().0, 0.0);
    }
}
