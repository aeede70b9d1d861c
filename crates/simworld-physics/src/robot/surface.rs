//! Surfaces of triangles, and the models that they are drawn as: rounded where their faces go on, sharp where they break off.

use simworld_core::asset::{Model, ModelPart, ModelVertex, Paint};
use simworld_core::geometry::Vector3;
use simworld_core::lists::Lists;
use simworld_core::ops;

/// Faces that lean against one another by less than this are one rounded surface, rad: 40°.
const CREASE: f64 = 0.698;

/// A surface of triangles, m.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surface {
    /// Its corners.
    pub points: Vec<Vector3>,
    /// Three corners each, counter-clockwise from outside.
    pub triangles: Vec<[u32; 3]>,
}

impl Surface {
    /// As a model in the colour of whom it belongs to, which stands on its origin, and where that origin is. None without a triangle that has
    /// an area.
    pub fn model(&self) -> Option<(Model, Vector3)> {
        let faces: Vec<([u32; 3], Vector3)> =
            self.triangles.iter().filter_map(|corners| Some((*corners, self.normal(*corners)?))).collect();
        let (low, high) = self.bounds(&faces)?;
        let origin = Vector3::new((low.x + high.x) * 0.5, (low.y + high.y) * 0.5, low.z);
        let round = Rounding::of(&faces, self.points.len());
        let (mut vertices, mut triangles) =
            (Vec::with_capacity(3 * faces.len()), Vec::with_capacity(faces.len()));
        for (corners, face) in &faces {
            let first = vertices.len() as u32;
            triangles.push([first, first + 1, first + 2]);
            vertices.extend(corners.map(|corner| ModelVertex {
                position: (self.points[corner as usize] - origin).cast::<f32>().into(),
                normal: round.normal(corner, face, &faces).cast::<f32>().into(),
                color: [1.0; 3],
                ..ModelVertex::default()
            }));
        }
        let part = ModelPart { triangles: faces.len() as u32, paint: Paint::Entity, ..ModelPart::default() };
        Some((Model { vertices, triangles, parts: vec![part], ..Model::default() }, origin))
    }

    /// The normal of a triangle; none where it has no area or a corner that is not there.
    fn normal(&self, corners: [u32; 3]) -> Option<Vector3> {
        let [a, b, c] = corners.map(|corner| self.points.get(corner as usize));
        let (a, b, c) = (a?, b?, c?);
        (b - a).cross(&(c - a)).try_normalize(1e-15)
    }

    fn bounds(&self, faces: &[([u32; 3], Vector3)]) -> Option<(Vector3, Vector3)> {
        let mut points = faces.iter().flat_map(|(corners, _)| corners).map(|at| self.points[*at as usize]);
        let first = points.next()?;
        Some(points.fold((first, first), |(low, high), point| (low.inf(&point), high.sup(&point))))
    }
}

/// Which faces meet at each corner.
struct Rounding(Lists<u32>);

impl Rounding {
    fn of(faces: &[([u32; 3], Vector3)], corners: usize) -> Self {
        let around =
            faces.iter().zip(0..).flat_map(|((at, _), face)| at.map(|corner| (corner as usize, face)));
        Self(Lists::of(corners, around))
    }

    /// The normal of a face at one of its corners: the mean of those that go on round it there, or its own.
    fn normal(&self, corner: u32, own: &Vector3, faces: &[([u32; 3], Vector3)]) -> Vector3 {
        let least = ops::cos(CREASE);
        // At a fan of very many faces the mean of some of them says as much.
        let met = self.0[corner as usize].iter().take(64).map(|face| faces[*face as usize].1);
        let sum: Vector3 = met.filter(|normal| normal.dot(own) >= least).sum();
        sum.try_normalize(1e-9).unwrap_or(*own)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cube() -> Surface {
        let points = (0..8).map(|k| Vector3::from_fn(|axis, _| f64::from(k >> axis & 1) + 2.0)).collect();
        let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let triangles = quads.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).collect();
        Surface { points, triangles }
    }

    #[test]
    fn a_surface_stands_on_its_origin_with_sharp_edges() {
        let (model, origin) = cube().model().unwrap();
        assert_eq!(origin, Vector3::new(2.5, 2.5, 2.0));
        assert_eq!(model.bounds(), Some([[-0.5, -0.5, 0.0], [0.5, 0.5, 1.0]]));
        assert_eq!(model.validate_surface(Vector3::repeat(1.0)), Ok(()));
        for vertex in &model.vertices {
            let straight = vertex.normal.iter().filter(|part| part.abs() > 1.0 - 1e-6).count();
            assert_eq!(straight, 1, "{:?}", vertex.normal);
            let outward = Vector3::from(vertex.position.map(f64::from)) - Vector3::new(0.0, 0.0, 0.5);
            assert!(outward.dot(&Vector3::from(vertex.normal.map(f64::from))) > 0.4);
        }
    }

    #[test]
    fn a_ball_of_triangles_is_round() {
        let mut surface = Surface::default();
        let (rings, slices) = (24, 48);
        for ring in 0..=rings {
            for slice in 0..slices {
                let (down, round) = (
                    std::f64::consts::PI * f64::from(ring) / 24.0,
                    std::f64::consts::TAU * f64::from(slice) / 48.0,
                );
                let (sin, cos) = (ops::sin(down), ops::cos(down));
                surface.points.push(Vector3::new(sin * ops::cos(round), sin * ops::sin(round), cos));
            }
        }
        let at = |ring: u32, slice: u32| ring * slices as u32 + slice % slices as u32;
        for ring in 0..rings as u32 {
            for slice in 0..slices as u32 {
                surface.triangles.push([at(ring, slice), at(ring + 1, slice), at(ring + 1, slice + 1)]);
                surface.triangles.push([at(ring, slice), at(ring + 1, slice + 1), at(ring, slice + 1)]);
            }
        }
        let (model, origin) = surface.model().unwrap();
        for ModelVertex { position, normal, .. } in &model.vertices {
            let out = (Vector3::from(position.map(f64::from)) + origin).normalize();
            let lean = out.dot(&Vector3::from(normal.map(f64::from)));
            assert!(lean > 0.99, "{lean} at {position:?}");
        }
    }

    #[test]
    fn what_cannot_be_seen_is_no_model() {
        assert!(Surface::default().model().is_none());
        let line = Surface {
            points: vec![Vector3::zeros(), Vector3::x(), Vector3::x() * 2.0],
            triangles: vec![[0, 1, 2]],
        };
        assert!(line.model().is_none());
        let lost = Surface { triangles: vec![[0, 1, 9]], ..cube() };
        assert!(lost.model().is_none());
    }
}
