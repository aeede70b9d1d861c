//! The points of a scan.

use simworld_core::geometry::Point3;

use crate::npy::header;

/// One echo.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LidarPoint {
    /// Where, in the sensor's frame (x forward, y left, z up), m.
    pub position: [f32; 3],
    /// How far, m.
    pub range: f32,
    /// Reflectance times the cosine of the angle at which the surface was met, less what the air takes on both ways.
    pub intensity: f32,
    /// Radians counter-clockwise from forward.
    pub azimuth: f32,
    /// The row of the beam.
    pub ring: u16,
    /// Class: a Cityscapes label id; 0 (unlabeled) for a drop or a flake.
    pub class: u8,
    /// Instance: [`EntityId::index`](simworld_core::id::EntityId::index) plus one; 0 for a drop or a flake.
    pub id: u32,
}

/// What a scanner gave: an echo for each beam that met something, in the order in which they were fired.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PointCloud {
    /// The echoes.
    pub points: Vec<LidarPoint>,
    /// World from sensor, when they were taken.
    pub world_from_sensor: simworld_core::geometry::Pose,
}

impl PointCloud {
    /// No points.
    pub fn new() -> Self {
        Self::default()
    }

    /// The points in the world frame, m.
    pub fn in_world(&self) -> impl Iterator<Item = Point3> + '_ {
        self.points.iter().map(|point| {
            let [x, y, z] = point.position.map(f64::from);
            self.world_from_sensor * Point3::new(x, y, z)
        })
    }

    /// The points as NPY: one axis of records `x`, `y`, `z`, `range`, `intensity`, `azimuth` (`f4`), `id` (`u4`), `ring` (`u2`), `class` (`u1`).
    pub fn npy(&self) -> Vec<u8> {
        let descr = "[('x', '<f4'), ('y', '<f4'), ('z', '<f4'), ('range', '<f4'), ('intensity', '<f4'), \
                     ('azimuth', '<f4'), ('id', '<u4'), ('ring', '<u2'), ('class', '|u1')]";
        let mut file = header(descr, &[self.points.len()]);
        for point in &self.points {
            let [x, y, z] = point.position;
            for number in [x, y, z, point.range, point.intensity, point.azimuth] {
                file.extend(number.to_le_bytes());
            }
            file.extend(point.id.to_le_bytes());
            file.extend(point.ring.to_le_bytes());
            file.push(point.class);
        }
        file
    }
}
