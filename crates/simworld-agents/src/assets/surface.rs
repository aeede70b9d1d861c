//! Surfaces: triangles with their looks, before they are known to be a solid.

use nalgebra::Matrix4;
use simworld_core::asset::{Local, ModelImage, ModelPart, RigDesc, light_of};
use simworld_core::geometry::{Point3, Vector3};

/// Triangles with their looks. Body axes (x forward, y left, z up); unit and origin are those of where it came from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surface {
    /// The corners of the triangles.
    pub points: Vec<Point3>,
    /// Outward, of length 1, one for each point; zero where none is known.
    pub normals: Vec<Vector3>,
    /// Linear-light sRGB primaries in [0, 1], one for each point; times the picture on its part, if there is one.
    pub colors: Vec<[f32; 3]>,
    /// Where each point lies on the pictures of its part, as [`ModelVertex::place`](simworld_core::asset::ModelVertex::place).
    pub places: Vec<[f32; 2]>,
    /// How much is there of each point, 0 to 1, as [`ModelVertex::alpha`](simworld_core::asset::ModelVertex::alpha).
    pub alphas: Vec<f32>,
    /// Which way is right on the pictures, one for each point, as [`Model::tangents`](simworld_core::asset::Model::tangents) has them; zeros where none is known.
    pub tangents: Vec<[f32; 4]>,
    /// Three points each, counter-clockwise from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Runs of triangles of one look, in order; together they are all of them.
    pub parts: Vec<ModelPart>,
    /// The pictures that lie on its parts.
    pub images: Vec<ModelImage>,
    /// How its points move, if they do: one vertex of the rig for each. Its first joint is all of it.
    pub rig: Option<RigDesc>,
}

impl Surface {
    /// The lowest and the highest corner of the box around the points of its triangles; none without triangles.
    pub fn bounds(&self) -> Option<[Point3; 2]> {
        let mut points = self.triangles.as_flattened().iter().map(|point| self.points[*point as usize]);
        let first = points.next()?;
        Some(points.fold([first, first], |[low, high], point| [low.inf(&point), high.sup(&point)]))
    }

    /// The corners of a triangle.
    pub(super) fn corners(&self, triangle: [u32; 3]) -> [Point3; 3] {
        triangle.map(|point| self.points[point as usize])
    }

    /// Twice the area of a triangle, along its normal.
    pub(super) fn cross(&self, triangle: [u32; 3]) -> Vector3 {
        let [a, b, c] = self.corners(triangle);
        (b - a).cross(&(c - a))
    }

    /// The light that the picture of its part has at the corners of a triangle, a little within; white without a picture.
    pub(super) fn shown(&self, part: &ModelPart, triangle: [u32; 3]) -> [[f32; 3]; 3] {
        let image =
            part.texture.and_then(|texture| Some((self.images.get(texture.image as usize)?, texture.wrap)));
        let Some((image, wrap)) = image else { return [[1.0; 3]; 3] };
        let places = triangle.map(|point| self.places[point as usize].map(f64::from));
        within(places).map(|place| image.pixel_at(place, wrap).map(light_of))
    }

    /// Keeps the triangles that a rule keeps, and of the parts those that have some left.
    pub(super) fn retain(&mut self, keeps: impl Fn(usize) -> bool) {
        let mut first = 0;
        for part in &mut self.parts {
            let last = first + part.triangles as usize;
            part.triangles = (first..last).filter(|triangle| keeps(*triangle)).count() as u32;
            first = last;
        }
        self.parts.retain(|part| part.triangles > 0);
        let mut index = 0;
        self.triangles.retain(|_| {
            index += 1;
            keeps(index - 1)
        });
    }

    /// Drops the points that no triangle has.
    pub(super) fn compact(&mut self) {
        let mut places = vec![u32::MAX; self.points.len()];
        let mut kept = Vec::new();
        for point in self.triangles.as_flattened_mut() {
            let place = &mut places[*point as usize];
            if *place == u32::MAX {
                *place = kept.len() as u32;
                kept.push(*point as usize);
            }
            *point = *place;
        }
        self.points = kept.iter().map(|point| self.points[*point]).collect();
        self.normals = kept.iter().map(|point| self.normals[*point]).collect();
        self.colors = kept.iter().map(|point| self.colors[*point]).collect();
        self.places = kept.iter().map(|point| self.places[*point]).collect();
        self.alphas = kept.iter().map(|point| self.alphas[*point]).collect();
        self.tangents = kept.iter().map(|point| self.tangents[*point]).collect();
        self.pick_rig(&kept);
    }

    /// Of the rig, those vertices are left that belong to these of the former points.
    pub(super) fn pick_rig(&mut self, kept: &[usize]) {
        if let Some(rig) = &mut self.rig {
            rig.vertices = kept.iter().map(|point| rig.vertices[*point]).collect();
        }
    }

    /// Moves the rig along with its points: everything hangs on the first joint.
    pub(super) fn carry_rig(&mut self, map: &Matrix4<f64>) {
        if let Some(joint) = self.rig.as_mut().and_then(|rig| rig.joints.first_mut())
            && let Local::Matrix(columns) = &mut joint.rest
        {
            let moved = map * Matrix4::from_column_slice(columns);
            columns.copy_from_slice(moved.as_slice());
        }
    }
}

/// Places on a picture a little within a triangle, near its corners: islands of a picture end at their edges, and beyond lies another
/// colour.
pub(super) fn within(corners: [[f64; 2]; 3]) -> [[f64; 2]; 3] {
    const INWARD: f64 = 0.2;
    let middle: [f64; 2] =
        std::array::from_fn(|axis| corners.iter().map(|corner| corner[axis]).sum::<f64>() / 3.0);
    corners.map(|corner| std::array::from_fn(|axis| corner[axis] + (middle[axis] - corner[axis]) * INWARD))
}
