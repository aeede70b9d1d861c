//! From the world to the picture: lines and labels that go behind what is before them.

use simworld_core::camera::Camera;
use simworld_core::geometry::{Point2, Point3};
use simworld_render::Frame;

use super::canvas::{Canvas, Ink};

/// Nearer than this nothing is drawn, m.
const NEAR: f64 = 0.2;
/// So far behind a surface a line still counts as lying on it: a share of the distance, and m.
const SLACK: (f64, f64) = (0.015, 0.25);

/// A camera and what it saw.
pub(super) struct Sight<'a> {
    pub camera: &'a Camera,
    pub frame: &'a Frame,
}

impl Sight<'_> {
    /// Where a point of the world falls, pixels, and how far it is, m; `None` behind the camera.
    pub(super) fn place(&self, point: &Point3) -> Option<(Point2, f64)> {
        self.camera.project(point).filter(|(_, depth)| *depth > NEAR)
    }

    /// Draws a straight line of the world, where nothing is before it.
    pub(super) fn line(&self, canvas: &mut Canvas, from: &Point3, to: &Point3, ink: Ink) {
        let optical = |point: &Point3| self.camera.world_from_optical.inverse_transform_point(point);
        let (mut a, mut b) = (optical(from), optical(to));
        if a.z < NEAR && b.z < NEAR {
            return;
        }
        if a.z < NEAR {
            a += (b - a) * ((NEAR - a.z) / (b.z - a.z));
        } else if b.z < NEAR {
            b += (a - b) * ((NEAR - b.z) / (a.z - b.z));
        }
        let project = |point: &Point3| self.camera.intrinsics.project(point).map(|(pixel, _)| pixel);
        let (Some(start), Some(end)) = (project(&a), project(&b)) else { return };
        let Some((first, last)) = self.clip(start, end) else { return };
        let (start, along) = (start, end - start);
        let steps = ((last - first) * along.amax()).ceil().max(1.0) as usize;
        for step in 0..=steps {
            let t = first + (last - first) * step as f64 / steps as f64;
            // Inverse depth is linear on the picture.
            let depth = 1.0 / ((1.0 - t) / a.z + t / b.z);
            let pixel = start + along * t;
            self.dot(canvas, pixel, depth, ink);
        }
    }

    /// A dot of a line; near ones are thicker.
    fn dot(&self, canvas: &mut Canvas, pixel: Point2, depth: f64, ink: Ink) {
        let reach = i64::from(depth < 45.0);
        let (x, y) = (pixel.x.floor() as i64, pixel.y.floor() as i64);
        for (dx, dy) in (0..=reach).flat_map(|dx| (0..=reach).map(move |dy| (dx, dy))) {
            if self.is_free(x + dx, y + dy, depth) {
                canvas.dot(x + dx, y + dy, ink, 0.85);
            }
        }
    }

    /// Whether nothing stands before that depth on a pixel of the picture.
    fn is_free(&self, x: i64, y: i64, depth: f64) -> bool {
        let (Ok(x), Ok(y)) = (u32::try_from(x), u32::try_from(y)) else { return false };
        if x >= self.frame.width || y >= self.frame.height {
            return false;
        }
        self.frame.depth_at(x, y).is_none_or(|seen| depth * (1.0 - SLACK.0) - SLACK.1 <= f64::from(seen))
    }

    /// The part of a line from 0 to 1 that lies on the picture (Liang and Barsky).
    fn clip(&self, from: Point2, to: Point2) -> Option<(f64, f64)> {
        let size = [f64::from(self.frame.width), f64::from(self.frame.height)];
        let along = to - from;
        let (mut first, mut last) = (0.0_f64, 1.0_f64);
        for axis in 0..2 {
            if along[axis].abs() < 1e-12 {
                if !(0.0..size[axis]).contains(&from[axis]) {
                    return None;
                }
                continue;
            }
            let (enter, leave) = (-from[axis] / along[axis], (size[axis] - from[axis]) / along[axis]);
            first = first.max(enter.min(leave));
            last = last.min(enter.max(leave));
        }
        (first < last).then_some((first, last))
    }
}

#[cfg(test)]
mod tests {
    use simworld_core::camera::Intrinsics;
    use simworld_core::geometry::pose_facing;

    use super::*;

    /// A line through a wall is seen as far as the wall, and one from behind the camera begins at the picture's edge.
    #[test]
    fn lines_end_at_what_stands_before_them() {
        let intrinsics = Intrinsics::from_fov(60, 40, 1.2).unwrap();
        let camera = Camera::looking_along(&pose_facing(Point3::origin(), 0.0), intrinsics);
        let mut frame = Frame::new();
        frame.resize(60, 40);
        frame.depth.fill(20.0);
        let mut canvas = Canvas::default();
        canvas.load(60, 40, &[]);
        let sight = Sight { camera: &camera, frame: &frame };
        // It runs from the lower left to the middle, which it nears as it goes away.
        sight.line(&mut canvas, &Point3::new(-5.0, 2.0, -1.0), &Point3::new(200.0, 2.0, -1.0), [255; 3]);
        let lit: Vec<usize> = (0..60 * 40).filter(|at| canvas.rgb[3 * at] > 0).map(|at| at % 60).collect();
        let (wall, _) = camera.project(&Point3::new(20.0, 2.0, -1.0)).unwrap();
        let last = *lit.iter().max().unwrap() as f64;
        assert!(lit.len() > 15 && (last - wall.x).abs() < 1.6, "up to {last}, and the wall is at {}", wall.x);
    }
}
