//! Volume and centre of what a closed surface encloses.

use simworld_core::geometry::{Point3, Vector3};

/// Volume and its centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bulk {
    /// In cubes of the surface's unit; below zero if it is inside out.
    pub(super) volume: f64,
    pub(super) center: Point3,
}

/// What closed triangles enclose, by the divergence theorem: each spans a tetrahedron with one point, and what the
/// tetrahedra count too much on one side they take away on the other.
pub(super) fn enclosed(about: Point3, triangles: impl Iterator<Item = [Point3; 3]>) -> Bulk {
    let (mut volume, mut moment) = (0.0, Vector3::zeros());
    for corners in triangles {
        let [a, b, c] = corners.map(|corner| corner - about);
        let part = a.dot(&b.cross(&c)) / 6.0;
        volume += part;
        moment += (a + b + c) * (part / 4.0);
    }
    let center = if volume == 0.0 { about } else { about + moment / volume };
    Bulk { volume, center }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tetrahedron_has_a_sixth_of_its_box() {
        let [o, x, y, z] =
            [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 4.0]].map(Point3::from);
        let faces = [[o, y, x], [o, x, z], [o, z, y], [x, y, z]];
        for about in [o, Point3::new(7.0, -5.0, 3.0)] {
            let bulk = enclosed(about, faces.into_iter());
            assert!((bulk.volume - 4.0).abs() < 1e-12, "{bulk:?}");
            assert!((bulk.center - Point3::new(0.5, 0.75, 1.0)).norm() < 1e-12, "{bulk:?}");
        }
    }
}
